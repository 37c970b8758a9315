//! Cognates as a problem, and the formulas of their proof.

use super::CognatesTask;
use crate::candidate::Draft;
use crate::fourbar::FourBar;
use crate::statement::{angle, length, number, of, place};
use crate::{Proof, Statement};
use hodograph_base::diag::both;

impl CognatesTask {
    pub(super) fn stated(&self) -> Statement {
        let FourBar { a, b, c, d, .. } = self.cognates.given;
        let l = self.cognates.given.lengths();
        let e = self.cognates.e;
        Statement {
            task: both!(
                "Find the two other four-bars that carry the coupler point $E$ of the four-bar $ABCD$ along the same path (Roberts-Chebyshev).",
                "求与四杆机构 $ABCD$ 的连杆点 $E$ 轨迹相同的另外两个四杆机构（罗伯茨–切比雪夫定理）。"
            ),
            given: vec![
                both!(
                    "$l_{{AB}} = {}$, $l_{{BC}} = {}$, $l_{{CD}} = {}$, $l_{{AD}} = {}$",
                    "$l_{{AB}} = {}$，$l_{{BC}} = {}$，$l_{{CD}} = {}$，$l_{{AD}} = {}$",
                    length(l[0]),
                    length(l[1]),
                    length(l[2]),
                    length(l[3])
                ),
                both!(
                    "$E$ on the coupler: $l_{{BE}} = {}$, $l_{{CE}} = {}$",
                    "连杆上 $E$：$l_{{BE}} = {}$，$l_{{CE}} = {}$",
                    length(b.distance(e)),
                    length(c.distance(e))
                ),
                both!(
                    "drawn with $A = {}$, $D = {}$, $B = {}$",
                    "作图位置 $A = {}$，$D = {}$，$B = {}$",
                    place(a),
                    place(d),
                    place(b)
                ),
            ],
            wanted: vec![both!(
                "the third pivot $F$ and the lengths of both cognates",
                "第三个固定铰链 $F$ 及两个同源机构的杆长"
            )],
            open_steps: 1,
        }
    }

    pub(super) fn proved(&self, draft: &Draft) -> Vec<Proof> {
        let c = &self.cognates;
        let ratio = (c.e - c.given.b).divide_by(c.given.c - c.given.b);
        vec![
            Proof::new(
                both!(
                    "With the turn and stretch that carries $BC$ over to $BE$,",
                    "记由 $BC$ 到 $BE$ 的旋转与伸缩为 $\\lambda$："
                ),
                [format!(
                    "\\lambda = \\frac{{BE}}{{BC}} = {}\\,\\angle\\,{}",
                    number(ratio.norm()),
                    angle(ratio.angle())
                )],
            ),
            Proof::new(
                both!(
                    "the third pivot is $F$, and $A_1$, $P_1$ are pins of the left cognate $AA_1P_1F$ (parallelogram $ABEA_1$, triangle $A_1EP_1$ similar to $BCE$):",
                    "则第三个固定铰链为 $F$，左同源机构 $AA_1P_1F$ 的铰链为 $A_1$、$P_1$（平行四边形 $ABEA_1$，三角形 $A_1EP_1$ 与 $BCE$ 相似）："
                ),
                [
                    format!("F = A + \\lambda\\,AD = {}", place(c.f)),
                    format!(
                        "A_1 = A + BE = {} ,\\quad P_1 = A_1 + \\lambda\\,AB = {}",
                        place(c.left[0]),
                        place(c.left[1])
                    ),
                ],
            ),
            Proof::new(
                both!(
                    "With $\\lambda' = CE/CB$ the right cognate $FP_2D_1D$ likewise:",
                    "同理，由 $\\lambda' = CE/CB$ 得右同源机构 $FP_2D_1D$："
                ),
                [format!(
                    "D_1 = D + CE = {} ,\\quad P_2 = D_1 + \\lambda'\\,DC = {}",
                    place(c.right[0]),
                    place(c.right[1])
                )],
            ),
            Proof::new(
                both!(
                    "The linkage of this candidate, in its own letters:",
                    "本方案的机构（按其自身的字母）："
                ),
                [["AB", "BC", "CD", "AD", "BE", "CE"]
                    .map(|n| format!("l_{{{n}}} = {}", length(of(draft, n))))
                    .join(" ,\\quad ")],
            ),
        ]
    }
}
