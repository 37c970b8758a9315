//! The slider-crank as a problem, and the formulas of its proof.

use super::{SliderCrank, ThirdGiven};
use crate::candidate::Draft;
use crate::statement::{angle, angle_of_limits, length, number, of};
use crate::{Proof, Statement};
use hodograph_base::diag::both;

impl SliderCrank {
    pub(super) fn stated(&self) -> Statement {
        let third = match self.third {
            ThirdGiven::Offset(e) => both!("offset $e = {}$", "偏距 $e = {}$", length(e)),
            ThirdGiven::Crank(a) => {
                both!("crank $l_{{AB}} = {}$", "曲柄 $l_{{AB}} = {}$", length(a))
            }
            ThirdGiven::Rod(b) => both!("rod $l_{{BC}} = {}$", "连杆 $l_{{BC}} = {}$", length(b)),
            ThirdGiven::Best => both!(
                "the greatest pressure angle is to be as small as possible",
                "最大压力角应尽可能小"
            ),
        };
        let wanted = match self.third {
            ThirdGiven::Offset(_) => {
                both!(
                    "the lengths of crank $l_{{AB}}$ and rod $l_{{BC}}$",
                    "曲柄 $l_{{AB}}$ 与连杆 $l_{{BC}}$ 的长度"
                )
            }
            ThirdGiven::Crank(_) => {
                both!("the rod $l_{{BC}}$ and the offset $e$", "连杆 $l_{{BC}}$ 与偏距 $e$")
            }
            ThirdGiven::Best => {
                both!(
                    "the crank $l_{{AB}}$, the rod $l_{{BC}}$ and the offset $e$",
                    "曲柄 $l_{{AB}}$、连杆 $l_{{BC}}$ 与偏距 $e$"
                )
            }
            ThirdGiven::Rod(_) => {
                both!("the crank $l_{{AB}}$ and the offset $e$", "曲柄 $l_{{AB}}$ 与偏距 $e$")
            }
        };
        Statement {
            task: both!(
                "Design an offset slider-crank with a quick return: crank $AB$, rod $BC$, slider $C$.",
                "设计具有急回特性的偏置曲柄滑块机构：曲柄 $AB$，连杆 $BC$，滑块 $C$。"
            ),
            given: vec![
                both!("time ratio $K = {}$", "行程速度变化系数 $K = {}$", number(self.ratio.k)),
                both!("stroke $H = {}$", "行程 $H = {}$", length(self.stroke)),
                third,
            ],
            wanted: vec![
                wanted,
                both!(
                    "the greatest pressure angle $\\alpha_{{\\text{{max}}}}$",
                    "最大压力角 $\\alpha_{{\\text{{max}}}}$"
                ),
            ],
            open_steps: 1,
        }
    }

    pub(super) fn proved(&self, draft: &Draft) -> Vec<Proof> {
        let (a, b, e) = (of(draft, "AB"), of(draft, "BC"), of(draft, "e"));
        let pressure = Proof::new(
            both!(
                "The pressure angle is greatest when the crank is square to the guide:",
                "曲柄垂直于导路时压力角最大："
            ),
            [format!(
                "\\sin\\alpha_{{\\text{{max}}}} = \\frac{{l_{{AB}} + e}}{{l_{{BC}}}} ,\\quad \\alpha_{{\\text{{max}}}} = {}",
                angle(of(draft, "alpha_max"))
            )],
        );
        if self.ratio.theta == 0.0 {
            let centric = both!(
                "Without a quick return the offset is zero and the crank half the stroke:",
                "无急回时偏距为零，曲柄长为行程之半："
            );
            return vec![
                Proof::new(centric, [format!("l_{{AB}} = \\frac{{H}}{{2}} = {}", length(a))]),
                pressure,
            ];
        }
        vec![
            angle_of_limits(self.ratio.k, self.ratio.theta),
            Proof::new(
                both!(
                    "Twice the area of the triangle $AC_1C_2$ is $He$, and also $l_{{AC_1}}l_{{AC_2}}\\sin\\theta$ with $l_{{AC_1}} = l_{{BC}} + l_{{AB}}$, $l_{{AC_2}} = l_{{BC}} − l_{{AB}}$; the law of cosines gives the sum of the squares:",
                    "三角形 $AC_1C_2$ 面积的二倍为 $He$，又等于 $l_{{AC_1}}l_{{AC_2}}\\sin\\theta$，其中 $l_{{AC_1}} = l_{{BC}} + l_{{AB}}$，$l_{{AC_2}} = l_{{BC}} − l_{{AB}}$；由余弦定理得平方和："
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
