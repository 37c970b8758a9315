//! Drawings of the crank-rocker: the second limit on a turned ray, or A on the circle with the
//! inscribed angle; then the halving.

use super::super::bar::GivenBar;
use super::{CrankRocker, RockerGivens};
use crate::board::{PaperLine, SynthesisBoard, Weight};
use crate::candidate::Draft;
use crate::statement::of;
use hodograph_base::diag::both;
use hodograph_base::digits::significant;
use hodograph_base::geom::Point;
use std::f64::consts::{FRAC_PI_2, PI};

/// The given that determines A on the circle.
#[derive(Clone, Copy)]
enum Fixed {
    Frame(f64),
    Bar(GivenBar),
    Line([Point; 2]),
    Beta(f64),
}

impl CrankRocker {
    pub(super) fn drawn(&self, draft: &Draft, board: &mut SynthesisBoard) -> Option<()> {
        match self.way {
            RockerGivens::Limit { frame, angle } => {
                let ray = |sense: f64, k: usize| {
                    move |board: &mut SynthesisBoard| self.by_ray(board, [frame, angle], sense, k)
                };
                let (a, b, c, d) = (ray(1.0, 0), ray(1.0, 1), ray(-1.0, 0), ray(-1.0, 1));
                board.meant(draft, &[&a, &b, &c, &d])
            }
            RockerGivens::Swing { swing, frame } => {
                self.on_arc(draft, board, swing, Fixed::Frame(frame))
            }
            RockerGivens::Bar { swing, bar } => self.on_arc(draft, board, swing, Fixed::Bar(bar)),
            RockerGivens::Line { swing, line } => {
                self.on_arc(draft, board, swing, Fixed::Line(line))
            }
            RockerGivens::Best { swing, .. } | RockerGivens::Gamma { swing, .. } => {
                self.on_arc(draft, board, swing, Fixed::Beta(of(draft, "beta")))
            }
        }
    }

    /// Draws C₂ at the intersection of the ray AC₁, turned by θ, with the rocker's circle.
    fn by_ray(
        &self,
        board: &mut SynthesisBoard,
        [frame, angle]: [f64; 2],
        sense: f64,
        k: usize,
    ) -> Option<()> {
        let (a, d, radius) =
            (Point::ORIGIN, Point::new(board.mm(frame), 0.0), board.mm(self.rocker));
        let c1 = PaperLine::ray(d, PI - angle).place(radius);
        board.step(both!(
            "Lay off the frame AD and the rocker DC1 under the given angle; draw the circle about D through C1"
        ));
        board
            .line(a, d, Weight::Given)
            .line(d, c1, Weight::Given)
            .circle(d, radius, Weight::Thin)
            .mark("A", a)
            .mark("D", d)
            .mark("C_1", c1);
        let ray = PaperLine::ray(a, (c1 - a).angle() + sense * self.ratio.theta);
        let c2 = board.cut(&ray, d, radius)?[k];
        if (c2 - a).dot(ray.along) <= 0.0 {
            return None;
        }
        let theta = significant(self.ratio.theta.to_degrees(), 4);
        board.step(both!(
            "Draw AC1 and turn it about A by θ = {theta}°: the ray meets the circle at C2"
        ));
        board
            .line(a, c1, Weight::Thin)
            .line(a, c2, Weight::Thin)
            .line(d, c2, Weight::Given)
            .mark("C_2", c2);
        board.halve(a, [c1, c2])
    }

    /// Draws A on the circle over C₁C₂ with the inscribed angle θ: at the frame's length from D, on
    /// a line, by a bar, or under the chosen angle β.
    fn on_arc(
        &self,
        draft: &Draft,
        board: &mut SynthesisBoard,
        swing: f64,
        fixed: Fixed,
    ) -> Option<()> {
        // Where another length determines the size, the rocker follows from the shape.
        let (d, radius) = (Point::ORIGIN, board.mm(of(draft, "CD")));
        let [c1, c2] =
            [1.0, -1.0].map(|s| PaperLine::ray(d, FRAC_PI_2 + s * swing / 2.0).place(radius));
        board.step(both!("Lay off the rocker in its limits DC1 and DC2 under the swing ψ"));
        board
            .line(d, c1, Weight::Given)
            .line(d, c2, Weight::Given)
            .angle(d, [c1, c2], "\\psi")
            .mark("D", d)
            .mark("C_1", c1)
            .mark("C_2", c2);
        let way = |beyond: bool, k: usize| {
            move |board: &mut SynthesisBoard| self.arc(board, [d, c1, c2], fixed, beyond, k)
        };
        let (p, q, r, s) = (way(true, 0), way(true, 1), way(false, 0), way(false, 1));
        board.meant(draft, &[&p, &q, &r, &s])
    }

    fn arc(
        &self,
        board: &mut SynthesisBoard,
        [d, c1, c2]: [Point; 3],
        fixed: Fixed,
        beyond: bool,
        k: usize,
    ) -> Option<()> {
        let theta = self.ratio.theta;
        let named = significant(theta.to_degrees(), 4);
        if theta == 0.0 {
            let line = PaperLine::through(c1, c2)?;
            let a = match fixed {
                Fixed::Frame(frame) => {
                    let a = board.cut(&line, d, board.mm(frame))?[k];
                    board.step(both!(
                        "θ = 0: A lies on the line C1C2, at the frame's length from D"
                    ));
                    board.circle(d, d.distance(a), Weight::Thin);
                    a
                }
                Fixed::Line(given) => {
                    let a = line.cross(&through(board, given)?)?;
                    board.step(both!("θ = 0: A lies where the line C1C2 meets the given line"));
                    board.line(board.at(given[0]), a, Weight::Thin);
                    a
                }
                // Any A on the line is a solution: the crank is half the chord.
                Fixed::Beta(_) | Fixed::Bar(_) => return None,
            };
            board.line(c1, a, Weight::Thin).mark("A", a);
            return board.halve(a, [c1, c2]);
        }
        board.step(both!(
            "Over C1C2 draw the circle with the inscribed angle θ = {named}°: 90° − θ from the chord at both ends gives its centre"
        ));
        board.line(c1, c2, Weight::Thin);
        let (centre, radius) = board.inscribed(c1, c2, theta, beyond)?;
        board.mark("O", centre);
        let a = match fixed {
            Fixed::Frame(frame) => {
                let opening = board.mm(frame);
                board.step(both!("With the frame AD as opening about D cut the circle: A"));
                board.circle(d, opening, Weight::Thin);
                board.circles(d, opening, centre, radius)?[k]
            }
            Fixed::Bar(bar) => bar.place(board, [c1, c2], (theta, beyond), (centre, radius), k)?,
            Fixed::Line(given) => {
                board.step(both!("The given line cuts the circle: A"));
                let a = board.cut(&through(board, given)?, centre, radius)?[k];
                board.line(board.at(given[0]), a, Weight::Given);
                a
            }
            Fixed::Beta(beta) => {
                let side = if beyond { -1.0 } else { 1.0 };
                let ray = PaperLine::ray(c2, (c1 - c2).angle() + side * beta);
                let text = significant(beta.to_degrees(), 5);
                let why = match self.way {
                    RockerGivens::Gamma { .. } => {
                        both!("the wanted transmission angle")
                    }
                    RockerGivens::Limit { .. }
                    | RockerGivens::Swing { .. }
                    | RockerGivens::Bar { .. }
                    | RockerGivens::Line { .. }
                    | RockerGivens::Best { .. } => {
                        both!("the best transmission angle")
                    }
                };
                board.step(both!("On the ray under β = {text}° from C2C1 ({}) lies A", why));
                let crossings = board.cut(&ray, centre, radius)?;
                let far = crossings
                    .into_iter()
                    .max_by(|p, q| p.distance(c2).total_cmp(&q.distance(c2)))?;
                (k == 0).then_some(far)?
            }
        };
        // From A the chord must appear under θ, not under its supplement.
        if (c1 - a).dot(c2 - a) * libm::cos(theta) < 0.0 {
            return None;
        }
        board
            .line(d, a, Weight::Given)
            .line(a, c1, Weight::Thin)
            .line(a, c2, Weight::Thin)
            .mark("A", a)
            .read("AD", a, d);
        board.halve(a, [c1, c2])
    }
}

/// The line through two places of the file, on the paper.
fn through(board: &SynthesisBoard, [p, q]: [Point; 2]) -> Option<PaperLine> {
    Some(PaperLine { at: board.at(p), along: (q - p).unit()? })
}
