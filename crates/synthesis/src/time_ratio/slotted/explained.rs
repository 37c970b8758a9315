//! The slotted lever, the shaper and Whitworth's linkage as problems, and the formulas of their
//! proofs.

use super::{Slotted, SlottedKind};
use crate::candidate::Draft;
use crate::statement::{angle, angle_of_limits, length, number, of};
use crate::{Proof, Statement};
use hodograph_base::diag::both;

impl Slotted {
    pub(super) fn stated(&self) -> Statement {
        let mut given =
            vec![both!("time ratio $K = {}$", "行程速度变化系数 $K = {}$", number(self.ratio.k))];
        given.push(match self.by_crank {
            true => both!("crank $l_{{AB}} = {}$", "曲柄 $l_{{AB}} = {}$", length(self.crank)),
            false => both!("frame $l_{{AC}} = {}$", "机架 $l_{{AC}} = {}$", length(self.frame)),
        });
        let stroke = |h: f64| both!("stroke $H = {}$", "行程 $H = {}$", length(h));
        let link = |l: f64| both!("link $l_{{DE}} = {}$", "连杆 $l_{{DE}} = {}$", length(l));
        let mut wanted = vec![match self.by_crank {
            true => both!("the frame $l_{{AC}}$", "机架 $l_{{AC}}$"),
            false => both!("the crank $l_{{AB}}$", "曲柄 $l_{{AB}}$"),
        }];
        let task = match self.kind {
            SlottedKind::Lever { lever } => {
                given
                    .extend(lever.map(|l| {
                        both!("lever $l_{{CD}} = {}$", "导杆 $l_{{CD}} = {}$", length(l))
                    }));
                both!(
                    "Design a slotted lever: the crank $AB$ turns fully, its pin $B$ slides on the lever, which swings about $C$.",
                    "设计摆动导杆机构：曲柄 $AB$ 整周转动，滑块 $B$ 沿导杆滑动，导杆绕 $C$ 摆动。"
                )
            }
            SlottedKind::Shaper { stroke: h, link: l } => {
                given.extend([stroke(h), link(l)]);
                wanted.push(both!(
                    "the lever $l_{{CD}}$ and the height $y$ of the ram's guide over $C$ with the least pressure angle",
                    "导杆 $l_{{CD}}$ 及使压力角最小的滑枕导路高度 $y$（距 $C$）"
                ));
                both!(
                    "Design the linkage of a shaper: slotted lever $CD$ driven by the crank $AB$, link $DE$, ram $E$.",
                    "设计牛头刨床机构：曲柄 $AB$ 驱动导杆 $CD$，经连杆 $DE$ 带动滑枕 $E$。"
                )
            }
            SlottedKind::Whitworth { stroke: h, link: l } => {
                given.extend([stroke(h), link(l)]);
                wanted.push(both!("the arm $l_{{CD}}$ of the lever", "导杆上的臂长 $l_{{CD}}$"));
                both!(
                    "Design Whitworth's quick return: the lever turns fully about $C$, which lies inside the circle of the crank $AB$.",
                    "设计转动导杆机构：导杆绕 $C$ 整周转动，$C$ 在曲柄 $AB$ 的圆内。"
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
                    "In its limits the lever touches the crank's circle: the crank is square to it, and its swing is $\\psi = \\theta$:",
                    "极限位置上导杆与曲柄圆相切，曲柄垂直于导杆，摆角 $\\psi = \\theta$："
                ),
                [format!("l_{{AB}} = l_{{AC}}\\sin\\frac{{\\theta}}{{2}} ,\\quad l_{{AB}} = {ab} ,\\quad l_{{AC}} = {ac}")],
            ));
        }
        match self.kind {
            SlottedKind::Lever { .. } => {}
            SlottedKind::Shaper { .. } => out.push(Proof::new(
                both!(
                    "The chord of $D$ is the stroke; a guide in the middle of the rise of its arc makes the greatest pressure angle least:",
                    "$D$ 的弦长等于行程；导路取在 $D$ 点圆弧高的中点时最大压力角最小："
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
                    "While the lever turns by $180\\degree$ from one dead line to the other, the crank turns by $360\\degree/(K + 1)$ on the quick stroke:",
                    "导杆转过 $180\\degree$ 时，快行程的曲柄转角为 $360\\degree/(K + 1)$："
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
