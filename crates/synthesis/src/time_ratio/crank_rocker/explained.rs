//! The crank-rocker as a problem, and the formulas of its proof.

use super::super::bar::GivenBar;
use super::{CrankRocker, RockerGivens, SizeBasis};
use crate::candidate::Draft;
use crate::statement::{angle, angle_of_limits, half_difference, length, number, of, place};
use crate::{Proof, Statement};
use hodograph_base::diag::both;
use hodograph_base::geom::Point;

impl CrankRocker {
    pub(super) fn stated(&self) -> Statement {
        let mut given = vec![
            both!("time ratio $K = {}$", number(self.ratio.k)),
            match self.size {
                SizeBasis::Rocker => {
                    both!("rocker $l_{{CD}} = {}$", length(self.rocker))
                }
                SizeBasis::Frame(frame) => {
                    both!("frame $l_{{AD}} = {}$", length(frame))
                }
                SizeBasis::Crank(crank) => {
                    both!("crank $l_{{AB}} = {}$", length(crank))
                }
            },
        ];
        match self.way {
            RockerGivens::Limit { frame, angle: limit } => {
                given.push(both!("frame $l_{{AD}} = {}$", length(frame)));
                given.push(both!(
                    "angle of the rocker with the frame in one limit position $\\angle ADC_1 = {}$",
                    angle(limit)
                ));
            }
            RockerGivens::Swing { swing, frame } => {
                given.push(both!("swing of the rocker $\\psi = {}$", angle(swing)));
                given.push(both!("frame $l_{{AD}} = {}$", length(frame)));
            }
            RockerGivens::Bar { swing, bar } => {
                given.push(both!("swing of the rocker $\\psi = {}$", angle(swing)));
                given.push(bar.told());
            }
            RockerGivens::Line { swing, line: [through, end] } => {
                given.push(both!("swing of the rocker $\\psi = {}$", angle(swing)));
                given.push(both!(
                    "$A$ on the line through ${}$ under ${}$ ($D$ the origin, the swing even about the upward axis)",
                    place(through),
                    angle((end - through).angle())
                ));
            }
            RockerGivens::Gamma { swing, gamma } => {
                given.push(both!("swing of the rocker $\\psi = {}$", angle(swing)));
                given.push(both!(
                    "least transmission angle $\\gamma_{{\\text{{min}}}} = {}$",
                    angle(gamma)
                ));
            }
            RockerGivens::Best { swing, .. } => {
                given.push(both!("swing of the rocker $\\psi = {}$", angle(swing)));
                given.push(both!(
                    "the least transmission angle $\\gamma_{{\\text{{min}}}}$ is to be as great as possible"
                ));
            }
        }
        let crank_given = matches!(self.way, RockerGivens::Bar { bar: GivenBar::Crank(_), .. })
            || matches!(self.size, SizeBasis::Crank(_));
        let mut wanted =
            vec![if let RockerGivens::Bar { bar: GivenBar::Coupler(_), .. } = self.way {
                both!("the length of the crank $l_{{AB}}$")
            } else if crank_given {
                both!("the length of the coupler $l_{{BC}}$")
            } else {
                both!("the lengths of crank $l_{{AB}}$ and coupler $l_{{BC}}$")
            }];
        if self.size != SizeBasis::Rocker {
            wanted.push(both!("the rocker $l_{{CD}}$"));
        }
        let framed = matches!(self.way, RockerGivens::Limit { .. } | RockerGivens::Swing { .. })
            || matches!(self.size, SizeBasis::Frame(_));
        if !framed {
            wanted.push(both!("the frame $l_{{AD}}$"));
        }
        if !matches!(self.way, RockerGivens::Gamma { .. }) {
            wanted.push(both!("the least transmission angle $\\gamma_{{\\text{{min}}}}$"));
        }
        let task = both!(
            "Design a crank-rocker $ABCD$ with a quick return: crank $AB$, coupler $BC$, rocker $CD$, frame $AD$."
        );
        Statement { task, given, wanted, open_steps: 1 }
    }

    pub(super) fn proved(&self, draft: &Draft) -> Vec<Proof> {
        let mut out = vec![angle_of_limits(self.ratio.k, self.ratio.theta)];
        // The frame lies along x, A at the origin.
        let limits: Vec<Point> = draft
            .wanted
            .iter()
            .flat_map(|w| &w.places)
            .filter(|(n, _)| n == "C")
            .map(|(_, p)| *p)
            .collect();
        let [c1, c2] = limits[..] else { return out };
        let ac = [c1, c2].map(|c| c.to_vec2().norm());
        out.push(self.second_limit(draft, ac));
        out.push(half_difference(ac, of(draft, "AB"), of(draft, "BC")));
        if let RockerGivens::Gamma { gamma, .. } = self.way {
            out.push(Proof::new(
                both!(
                    "At the greatest and the least $l_{{BD}}$ the transmission angle is extreme; with varying $\\beta$ its least value is the wanted one for"
                ),
                [format!("\\gamma_{{\\text{{min}}}} = {} ,\\quad \\beta = {}", angle(gamma), angle(of(draft, "beta")))],
            ));
        }
        if matches!(self.way, RockerGivens::Best { .. }) {
            out.push(Proof::new(
                both!(
                    "At the greatest and the least $l_{{BD}}$ the transmission angle is extreme; with varying $\\beta$ its least value is greatest for"
                ),
                [format!("\\beta = {} ,\\quad l_{{AD}} = {}", angle(of(draft, "beta")), length(of(draft, "AD")))],
            ));
        }
        out
    }

    /// The proof of C₂ or A.
    fn second_limit(&self, draft: &Draft, [ac1, ac2]: [f64; 2]) -> Proof {
        match self.way {
            RockerGivens::Limit { .. } => Proof::new(
                both!(
                    "$C_2$ lies on the ray $AC_1$ turned by $\\theta$ and on the circle of the rocker: with $\\delta = \\angle C_2AD$ the law of cosines is a quadratic equation for $l_{{AC_2}}$,"
                ),
                [
                    "l_{AC_2}^2 − 2\\,l_{AC_2}\\,l_{AD}\\cos\\delta + l_{AD}^2 = l_{CD}^2"
                        .to_owned(),
                    format!("l_{{AC_1}} = {} ,\\quad l_{{AC_2}} = {}", length(ac1), length(ac2)),
                ],
            ),
            RockerGivens::Bar { bar, .. } => {
                let [other, formula] = bar.formula();
                let chord = 2.0 * of(draft, "CD") * libm::sin(of(draft, "psi") / 2.0);
                Proof::new(
                    both!(
                        "With $l_{{AC}} = l_{{BC}} \\pm l_{{AB}}$ in the two limit positions the law of cosines in $AC_1C_2$ gives the other bar"
                    ),
                    [
                        format!(
                            "l_{{C_1C_2}} = 2\\,l_{{CD}}\\sin\\frac{{\\psi}}{{2}} = {}",
                            length(chord)
                        ),
                        format!("{formula} ,\\quad l_{{{other}}} = {}", length(of(draft, other))),
                        format!(
                            "l_{{AC_1}} = {} ,\\quad l_{{AC_2}} = {}",
                            length(ac1),
                            length(ac2)
                        ),
                    ],
                )
            }
            RockerGivens::Swing { .. }
            | RockerGivens::Line { .. }
            | RockerGivens::Best { .. }
            | RockerGivens::Gamma { .. } => {
                let chord = 2.0 * of(draft, "CD") * libm::sin(of(draft, "psi") / 2.0);
                Proof::new(
                    both!(
                        "$A$ lies on the circle over $C_1C_2$ with the inscribed angle $\\theta$; with $\\beta = \\angle C_1C_2A$ the law of sines gives"
                    ),
                    [
                        format!(
                            "l_{{C_1C_2}} = 2\\,l_{{CD}}\\sin\\frac{{\\psi}}{{2}} = {}",
                            length(chord)
                        ),
                        format!(
                            "l_{{AC_1}} = \\frac{{l_{{C_1C_2}}\\sin\\beta}}{{\\sin\\theta}} = {} ,\\quad l_{{AC_2}} = \\frac{{l_{{C_1C_2}}\\sin(\\beta + \\theta)}}{{\\sin\\theta}} = {}",
                            length(ac1),
                            length(ac2)
                        ),
                    ],
                )
            }
        }
    }
}
