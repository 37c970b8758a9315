//! The slider-crank as a problem, and the formulas of its proof.

use super::{SliderCrank, ThirdGiven};
use crate::candidate::Draft;
use crate::statement::{angle, angle_of_limits, length, number, of};
use crate::{Proof, Statement};
use hodograph_base::diag::both;

impl SliderCrank {
    pub(super) fn stated(&self) -> Statement {
        let third = match self.third {
            ThirdGiven::Offset(e) => both!("offset $e = {}$", length(e)),
            ThirdGiven::Crank(a) => {
                both!("crank $l_{{AB}} = {}$", length(a))
            }
            ThirdGiven::Rod(b) => both!("rod $l_{{BC}} = {}$", length(b)),
            ThirdGiven::Best => both!("the greatest pressure angle is to be as small as possible"),
        };
        let wanted = match self.third {
            ThirdGiven::Offset(_) => {
                both!("the lengths of crank $l_{{AB}}$ and rod $l_{{BC}}$")
            }
            ThirdGiven::Crank(_) => {
                both!("the rod $l_{{BC}}$ and the offset $e$")
            }
            ThirdGiven::Best => {
                both!("the crank $l_{{AB}}$, the rod $l_{{BC}}$ and the offset $e$")
            }
            ThirdGiven::Rod(_) => {
                both!("the crank $l_{{AB}}$ and the offset $e$")
            }
        };
        Statement {
            task: both!(
                "Design an offset slider-crank with a quick return: crank $AB$, rod $BC$, slider $C$."
            ),
            given: vec![
                both!("time ratio $K = {}$", number(self.ratio.k)),
                both!("stroke $H = {}$", length(self.stroke)),
                third,
            ],
            wanted: vec![wanted, both!("the greatest pressure angle $\\alpha_{{\\text{{max}}}}$")],
            open_steps: 1,
        }
    }

    pub(super) fn proved(&self, draft: &Draft) -> Vec<Proof> {
        let (a, b, e) = (of(draft, "AB"), of(draft, "BC"), of(draft, "e"));
        let pressure = Proof::new(
            both!("The pressure angle is greatest when the crank is square to the guide:"),
            [format!(
                "\\sin\\alpha_{{\\text{{max}}}} = \\frac{{l_{{AB}} + e}}{{l_{{BC}}}} ,\\quad \\alpha_{{\\text{{max}}}} = {}",
                angle(of(draft, "alpha_max"))
            )],
        );
        if self.ratio.theta == 0.0 {
            let centric =
                both!("Without a quick return the offset is zero and the crank half the stroke:");
            return vec![
                Proof::new(centric, [format!("l_{{AB}} = \\frac{{H}}{{2}} = {}", length(a))]),
                pressure,
            ];
        }
        vec![
            angle_of_limits(self.ratio.k, self.ratio.theta),
            Proof::new(
                both!(
                    "Twice the area of the triangle $AC_1C_2$ is $He$, and also $l_{{AC_1}}l_{{AC_2}}\\sin\\theta$ with $l_{{AC_1}} = l_{{BC}} + l_{{AB}}$, $l_{{AC_2}} = l_{{BC}} − l_{{AB}}$; the law of cosines gives the sum of the squares:"
                ),
                [
                    "l_{BC}^2 − l_{AB}^2 = \\frac{He}{\\sin\\theta} ,\\quad l_{AB}^2 + l_{BC}^2 = \\frac{H^2}{2} + \\frac{He}{\\tan\\theta}".to_owned(),
                    format!("e = {} ,\\quad l_{{AB}} = {} ,\\quad l_{{BC}} = {}", length(e), length(a), length(b)),
                ],
            ),
            pressure,
        ]
    }
}
