//! The press as a problem, and the formulas of its proof.

use super::{Press, from_vertical};
use crate::candidate::Draft;
use crate::statement::{angle, half_difference, length, number, of};
use crate::{Proof, Statement};
use hodograph_base::diag::both;

impl Press {
    pub(super) fn stated(&self) -> Statement {
        let [p, q] = self.angles;
        Statement {
            task: both!(
                "Design a press: the crank $AB$ swings the rocker $DCE$ by the coupler $BC$; the link $EF$ moves the ram $F$ on an upright guide."
            ),
            given: vec![
                both!(
                    "$A$ lies $x_1 = {}$ right of $D$ and $y = {}$ below it; the guide lies $x_2 = {}$ right of $D$",
                    length(self.a.x),
                    length(-self.a.y),
                    length(self.x2)
                ),
                both!(
                    "limits of the rocker, from the upright: $\\psi' = {}$, $\\psi'' = {}$",
                    angle(p),
                    angle(q)
                ),
                both!("stroke $H = {}$", length(self.stroke)),
                both!(
                    "$l_{{CE}}/l_{{CD}} = {}$, $l_{{EF}}/l_{{DE}} = {}$",
                    number(self.ce_cd),
                    number(self.ef_de)
                ),
            ],
            wanted: vec![both!(
                "the lengths $l_{{AB}}$, $l_{{BC}}$, $l_{{CD}}$, $l_{{DE}}$, $l_{{EF}}$ and the time ratio $K$"
            )],
            open_steps: 0,
        }
    }

    pub(super) fn proved(&self, draft: &Draft) -> Vec<Proof> {
        let [p, q] = self.angles;
        let even = (p + q - std::f64::consts::PI).abs() < 1e-9;
        let stroke = match even {
            true => Proof::new(
                both!(
                    "The limits lie alike above and below the level: $EF$ stands alike in both, and the chord of $E$ is the stroke:"
                ),
                [format!(
                    "l_{{DE}} = \\frac{{H}}{{2\\sin((\\psi'' − \\psi')/2)}} = {}",
                    length(of(draft, "DE"))
                )],
            ),
            false => Proof::new(
                both!(
                    "$F$ lies on its guide in both limits; the difference of its heights is the stroke, an equation for $l_{{DE}}$:"
                ),
                [
                    "y_F = l_{DE}\\cos\\psi − \\sqrt{l_{EF}^2 − (x_2 − l_{DE}\\sin\\psi)^2}"
                        .to_owned(),
                    format!("l_{{DE}} = {}", length(of(draft, "DE"))),
                ],
            ),
        };
        let ac =
            self.angles.map(|a| self.a.distance((from_vertical(a) * of(draft, "CD")).to_point()));
        vec![
            stroke,
            Proof::new(
                both!("The given ratios divide it:"),
                [format!(
                    "l_{{CD}} = {} ,\\quad l_{{EF}} = {}",
                    length(of(draft, "CD")),
                    length(of(draft, "EF"))
                )],
            ),
            half_difference(ac, of(draft, "AB"), of(draft, "BC")),
            Proof::new(
                both!("The crank angle between the limits and the time ratio:"),
                [format!(
                    "\\theta = \\angle C_1AC_2 = {} ,\\quad K = \\frac{{180\\degree + \\theta}}{{180\\degree − \\theta}} = {}",
                    angle(of(draft, "theta")),
                    number(of(draft, "K"))
                )],
            ),
        ]
    }
}
