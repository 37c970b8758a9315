//! Straight-line linkages as problems, with their proportions and the results of sweeping the
//! finished scene.

use super::{Linkage, StraightLineTask};
use crate::candidate::Draft;
use crate::statement::{angle, length, number, of};
use crate::{Proof, Statement};
use hodograph_base::diag::{Both, both};

impl StraightLineTask {
    pub(super) fn stated(&self) -> Statement {
        let mut given = vec![both!(
            "length of the straight stretch $l = {}$",
            "直线段长 $l = {}$",
            length(self.length)
        )];
        match self.linkage {
            Linkage::Watt | Linkage::ScottRussell | Linkage::Peaucellier => {
                given.push(both!(
                    "swing of the driver ${}$",
                    "原动件摆角 ${}$",
                    angle(2.0 * self.swing)
                ));
            }
            Linkage::Chebyshev | Linkage::Roberts | Linkage::Hoeken => {}
        }
        Statement {
            task: both!(
                "Design {}'s straight-line linkage, whose point $E$ runs straight over a given length.",
                "设计{}直线机构，使其点 $E$ 在给定长度上作直线运动。",
                self.name()
            ),
            given,
            wanted: vec![both!(
                "the lengths, and how far $E$ is from a straight line",
                "各杆长及 $E$ 偏离直线的大小"
            )],
            open_steps: 0,
        }
    }

    pub(super) fn proved(&self, draft: &Draft) -> Vec<Proof> {
        let lengths: Vec<String> = draft
            .numbers
            .iter()
            .take_while(|n| n.name != "length")
            .map(|n| format!("l_{{{}}} = {}", n.name, length(n.value)))
            .collect();
        vec![
            Proof::new(self.proportions(), lengths.chunks(4).map(|c| c.join(" ,\\quad "))),
            Proof::new(
                both!(
                    "Swept, with the extremes located, the finished scene has",
                    "对所得机构连续计算并求出极值："
                ),
                [
                    format!(
                        "l = {} ,\\quad \\Delta = {}",
                        length(of(draft, "length")),
                        length(of(draft, "deviation"))
                    ),
                    format!("\\frac{{\\Delta}}{{l}} = {}", number(of(draft, "relative"))),
                ],
            ),
        ]
    }

    fn proportions(&self) -> Both {
        let [frame, rod] = self.ratios.map(number);
        match self.linkage {
            Linkage::Watt => both!(
                "Watt: both rods to the coupler as $5 : 2$, $E$ in its middle; scaled to the wanted length:",
                "瓦特机构：两摇杆与连杆之比为 $5 : 2$，$E$ 在连杆中点；按所求长度放大："
            ),
            Linkage::Chebyshev => both!(
                "Chebyshev: frame, crossed rods and coupler as $4 : 5 : 2$, $E$ in the middle of the coupler; scaled to the wanted length:",
                "切比雪夫机构：机架、交叉杆、连杆之比为 $4 : 5 : 2$，$E$ 在连杆中点；按所求长度放大："
            ),
            Linkage::Roberts => both!(
                "Roberts: frame, rods and coupler as $2 : 1.2 : 1$, $l_{{BE}} = l_{{CE}} = l_{{AB}}$; $E$ goes from pivot to pivot; scaled to the wanted length:",
                "罗伯茨机构：机架、摇杆、连杆之比为 $2 : 1.2 : 1$，$l_{{BE}} = l_{{CE}} = l_{{AB}}$；$E$ 由一固定铰链到另一固定铰链；按所求长度放大："
            ),
            Linkage::Hoeken => both!(
                "Hoeken: crank, frame and rods as $1 : {frame} : {rod}$, $l_{{BE}} = 2\\,l_{{BC}}$; the half turn of the crank away from the rocker is straight; scaled:",
                "霍肯机构：曲柄、机架、杆之比为 $1 : {frame} : {rod}$，$l_{{BE}} = 2\\,l_{{BC}}$；曲柄背离摇杆的半转为直线段；放大："
            ),
            Linkage::ScottRussell => both!(
                "Scott-Russell: the crank is half the rod and holds its middle; $E$ runs on the square to the slider's guide, $y_E = 2\\,l_{{AB}}\\sin\\varphi$:",
                "斯科特–罗素机构：曲柄为连杆之半，铰接于其中点；$E$ 沿垂直于滑块导路的直线运动，$y_E = 2\\,l_{{AB}}\\sin\\varphi$："
            ),
            Linkage::Peaucellier => both!(
                "Peaucellier: $OC \\cdot OE = l_{{OX}}^2 − l_{{CX}}^2$ is constant, and $C$ runs on a circle through $O$, which inversion makes a straight line:",
                "波塞利耶机构：$OC \\cdot OE = l_{{OX}}^2 − l_{{CX}}^2$ 为常数，$C$ 的圆过 $O$，反演后成为直线："
            ),
        }
    }
}
