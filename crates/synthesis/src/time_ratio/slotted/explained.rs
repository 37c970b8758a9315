//! The slotted lever, the shaper and Whitworth's linkage as problems, and the formulas of their
//! proofs.

use super::{Slotted, SlottedKind};
use crate::candidate::Draft;
use crate::statement::{angle, angle_of_limits, length, number, of};
use crate::{Proof, Statement};
use hodograph_base::diag::both;

impl Slotted {
    pub(super) fn stated(&self) -> Statement {
        let mut given = vec![both!("time ratio $K = {}$", number(self.ratio.k))];
        given.push(match self.by_crank {
            true => both!("crank $l_{{AB}} = {}$", length(self.crank)),
            false => both!("frame $l_{{AC}} = {}$", length(self.frame)),
        });
        let stroke = |h: f64| both!("stroke $H = {}$", length(h));
        let link = |l: f64| both!("link $l_{{DE}} = {}$", length(l));
        let mut wanted = vec![match self.by_crank {
            true => both!("the frame $l_{{AC}}$"),
            false => both!("the crank $l_{{AB}}$"),
        }];
        let task = match self.kind {
            SlottedKind::Lever { lever } => {
                given.extend(lever.map(|l| both!("lever $l_{{CD}} = {}$", length(l))));
                both!(
                    "Design a slotted lever: the crank $AB$ turns fully, its pin $B$ slides on the lever, which swings about $C$."
                )
            }
            SlottedKind::Shaper { stroke: h, link: l } => {
                given.extend([stroke(h), link(l)]);
                wanted.push(both!(
                    "the lever $l_{{CD}}$ and the height $y$ of the ram's guide over $C$ with the least pressure angle"
                ));
                both!(
                    "Design the linkage of a shaper: slotted lever $CD$ driven by the crank $AB$, link $DE$, ram $E$."
                )
            }
            SlottedKind::Whitworth { stroke: h, link: l } => {
                given.extend([stroke(h), link(l)]);
                wanted.push(both!("the arm $l_{{CD}}$ of the lever"));
                both!(
                    "Design Whitworth's quick return: the lever turns fully about $C$, which lies inside the circle of the crank $AB$."
                )
            }
        };
        Statement { task, given, wanted, open_steps: 0 }
    }

    pub(super) fn proved(&self, draft: &Draft) -> Vec<Proof> {
        let (ab, ac) = (length(self.crank), length(self.frame));
        let mut out = Vec::new();
        if let SlottedKind::Lever { .. } | SlottedKind::Shaper { .. } = self.kind {
            out.push(angle_of_limits(self.ratio.k, self.ratio.theta));
            out.push(Proof::new(
                both!(
                    "In its limits the lever touches the crank's circle: the crank is square to it, and its swing is $\\psi = \\theta$:"
                ),
                [format!("l_{{AB}} = l_{{AC}}\\sin\\frac{{\\theta}}{{2}} ,\\quad l_{{AB}} = {ab} ,\\quad l_{{AC}} = {ac}")],
            ));
        }
        match self.kind {
            SlottedKind::Lever { .. } => {}
            SlottedKind::Shaper { .. } => out.push(Proof::new(
                both!(
                    "The chord of $D$ is the stroke; a guide in the middle of the rise of its arc makes the greatest pressure angle least:"
                ),
                [
                    format!("l_{{CD}} = \\frac{{H}}{{2\\sin(\\theta/2)}} = {}", length(of(draft, "CD"))),
                    format!("y = \\frac{{l_{{CD}}(1 + \\cos(\\theta/2))}}{{2}} = {}", length(of(draft, "y"))),
                    format!(
                        "\\sin\\alpha_{{\\text{{max}}}} = \\frac{{l_{{CD}} − y}}{{l_{{DE}}}} ,\\quad \\alpha_{{\\text{{max}}}} = {}",
                        angle(of(draft, "alpha_max"))
                    ),
                ],
            )),
            SlottedKind::Whitworth { .. } => out.push(Proof::new(
                both!(
                    "While the lever turns by $180\\degree$ from one dead line to the other, the crank turns by $360\\degree/(K + 1)$ on the quick stroke:"
                ),
                [
                    format!("\\alpha = \\frac{{360\\degree}}{{K + 1}} = {}", angle(of(draft, "alpha_return"))),
                    format!("l_{{AC}} = l_{{AB}}\\cos\\frac{{\\alpha}}{{2}} ,\\quad l_{{AB}} = {ab} ,\\quad l_{{AC}} = {ac}"),
                    format!("l_{{CD}} = \\frac{{H}}{{2}} = {}", length(of(draft, "CD"))),
                ],
            )),
        }
        out
    }
}
