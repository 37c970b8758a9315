//! Straight-line linkages as problems, with their proportions and the results of sweeping the
//! finished scene.

use super::{Linkage, StraightLineTask};
use crate::candidate::Draft;
use crate::statement::{angle, length, number, of};
use crate::{Proof, Statement};
use hodograph_base::diag::{Both, both};

impl StraightLineTask {
    pub(super) fn stated(&self) -> Statement {
        let mut given = vec![both!("length of the straight stretch $l = {}$", length(self.length))];
        match self.linkage {
            Linkage::Watt | Linkage::ScottRussell | Linkage::Peaucellier => {
                given.push(both!("swing of the driver ${}$", angle(2.0 * self.swing)));
            }
            Linkage::Chebyshev | Linkage::Roberts | Linkage::Hoeken => {}
        }
        Statement {
            task: both!(
                "Design {}'s straight-line linkage, whose point $E$ runs straight over a given length.",
                self.name()
            ),
            given,
            wanted: vec![both!("the lengths, and how far $E$ is from a straight line")],
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
                both!("Swept, with the extremes located, the finished scene has"),
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
                "Watt: both rods to the coupler as $5 : 2$, $E$ in its middle; scaled to the wanted length:"
            ),
            Linkage::Chebyshev => both!(
                "Chebyshev: frame, crossed rods and coupler as $4 : 5 : 2$, $E$ in the middle of the coupler; scaled to the wanted length:"
            ),
            Linkage::Roberts => both!(
                "Roberts: frame, rods and coupler as $2 : 1.2 : 1$, $l_{{BE}} = l_{{CE}} = l_{{AB}}$; $E$ goes from pivot to pivot; scaled to the wanted length:"
            ),
            Linkage::Hoeken => both!(
                "Hoeken: crank, frame and rods as $1 : {frame} : {rod}$, $l_{{BE}} = 2\\,l_{{BC}}$; the half turn of the crank away from the rocker is straight; scaled:"
            ),
            Linkage::ScottRussell => both!(
                "Scott-Russell: the crank is half the rod and holds its middle; $E$ runs on the square to the slider's guide, $y_E = 2\\,l_{{AB}}\\sin\\varphi$:"
            ),
            Linkage::Peaucellier => both!(
                "Peaucellier: $OC \\cdot OE = l_{{OX}}^2 − l_{{CX}}^2$ is constant, and $C$ runs on a circle through $O$, which inversion makes a straight line:"
            ),
        }
    }
}
