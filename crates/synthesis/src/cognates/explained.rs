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
                "Find the two other four-bars that carry the coupler point $E$ of the four-bar $ABCD$ along the same path (Roberts-Chebyshev)."
            ),
            given: vec![
                both!(
                    "$l_{{AB}} = {}$, $l_{{BC}} = {}$, $l_{{CD}} = {}$, $l_{{AD}} = {}$",
                    length(l[0]),
                    length(l[1]),
                    length(l[2]),
                    length(l[3])
                ),
                both!(
                    "$E$ on the coupler: $l_{{BE}} = {}$, $l_{{CE}} = {}$",
                    length(b.distance(e)),
                    length(c.distance(e))
                ),
                both!("drawn with $A = {}$, $D = {}$, $B = {}$", place(a), place(d), place(b)),
            ],
            wanted: vec![both!("the third pivot $F$ and the lengths of both cognates")],
            open_steps: 1,
        }
    }

    pub(super) fn proved(&self, draft: &Draft) -> Vec<Proof> {
        let c = &self.cognates;
        let ratio = (c.e - c.given.b).divide_by(c.given.c - c.given.b);
        vec![
            Proof::new(
                both!("With the turn and stretch that carries $BC$ over to $BE$,"),
                [format!(
                    "\\lambda = \\frac{{BE}}{{BC}} = {}\\,\\angle\\,{}",
                    number(ratio.norm()),
                    angle(ratio.angle())
                )],
            ),
            Proof::new(
                both!(
                    "the third pivot is $F$, and $A_1$, $P_1$ are pins of the left cognate $AA_1P_1F$ (parallelogram $ABEA_1$, triangle $A_1EP_1$ similar to $BCE$):"
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
                both!("With $\\lambda' = CE/CB$ the right cognate $FP_2D_1D$ likewise:"),
                [format!(
                    "D_1 = D + CE = {} ,\\quad P_2 = D_1 + \\lambda'\\,DC = {}",
                    place(c.right[0]),
                    place(c.right[1])
                )],
            ),
            Proof::new(
                both!("The linkage of this candidate, in its own letters:"),
                [["AB", "BC", "CD", "AD", "BE", "CE"]
                    .map(|n| format!("l_{{{n}}} = {}", length(of(draft, n))))
                    .join(" ,\\quad ")],
            ),
        ]
    }
}
