//! Approximations of a function drawn by the overlay method 图解试凑法: the compasses' results against
//! the wanted directions of the follower.
//!
//! With the computed lengths, the arcs about the crank's positions intersect the follower's arc
//! beside the wanted rays, as they do when a tracing of the rays is laid over the crank's
//! positions; the follower's actual angles are read.

use super::freudenstein::Generator;
use super::{Function, FunctionTarget};
use crate::board::{PaperLine, SynthesisBoard, Weight};
use crate::candidate::{DesignNumber, Draft};
use crate::laid::{LaidFourBar, numbered, shown, side};
use crate::statement::of;
use hodograph_base::diag::both;
use hodograph_base::geom::{Point, Vec2};

/// Length of a ray over the radius of the follower's arc.
const BEYOND: f64 = 1.15;

impl Function {
    /// The drawn positions with their numbers: the pairs, or the places of a curve's extreme
    /// deviations.
    fn compared(&self, numbers: &[DesignNumber]) -> Vec<(usize, [f64; 2])> {
        let all: Vec<(usize, [f64; 2])> = match &self.target {
            FunctionTarget::Curve { .. } => {
                let place =
                    |k: usize| numbers.iter().find(|n| n.name == format!("x_{k}")).map(|n| n.value);
                (0..).map_while(|k| Some((k, self.target.step(place(k)?)?))).collect()
            }
            FunctionTarget::Pairs { .. } => {
                self.steps.iter().enumerate().map(|(k, s)| (k + 1, *s)).collect()
            }
        };
        shown(all.len()).into_iter().map(|k| all[k]).collect()
    }

    /// The follower's actual angles at the drawn positions.
    pub(super) fn outputs(&self, g: &Generator, numbers: &[DesignNumber]) -> Vec<DesignNumber> {
        let what = both!("real angle of the follower");
        let real = |(k, s): &(usize, [f64; 2])| {
            Some(DesignNumber::angle(
                &format!("psi{k}"),
                what.clone(),
                g.output(s[0], g.start[1] + s[1])?,
            ))
        };
        self.compared(numbers).iter().filter_map(real).collect()
    }

    /// Draws crank positions, wanted rays, and the intersections of the arcs.
    pub(super) fn laid_on(&self, draft: &Draft, board: &mut SynthesisBoard) -> Option<()> {
        let d = Point::new(of(draft, "AD"), 0.0);
        let laid = LaidFourBar::off(board, draft, [Point::ORIGIN, d], None);
        let (alpha, phi) = (of(draft, "alpha0"), of(draft, "phi0"));
        let all = self.compared(&draft.numbers);
        let which: Vec<usize> = all.iter().map(|p| p.0).collect();
        board.step(both!(
            "Lay off the computed lengths: the frame AD, and the crank in its positions {}",
            numbered("AB", &which)
        ));
        board
            .line(laid.a, laid.d, Weight::Given)
            .circle(laid.a, laid.crank, Weight::Thin)
            .mark("A", laid.a)
            .mark("D", laid.d);
        for (k, s) in &all {
            let b = laid.b(alpha + s[0]);
            board.line(laid.a, b, Weight::Given).mark(&format!("B_{k}"), b);
        }
        board.step(both!(
            "Lay the tracing on D: the wanted directions of the follower as rays, and the arc of its length CD"
        ));
        board.circle(laid.d, laid.follower, Weight::Thin);
        for (_, s) in &all {
            board.line(
                laid.d,
                PaperLine::ray(laid.d, phi + s[1]).place(BEYOND * laid.follower),
                Weight::Given,
            );
        }
        board.step(both!(
            "With BC as opening cut that arc about {}: {}; read the angles of DC, which miss the rays by the deviations",
            numbered("B", &which),
            numbered("C", &which)
        ));
        let mut drawn = Vec::new();
        for (k, s) in &all {
            let near = draft.wanted.iter().min_by(|p, q| {
                (p.driver - alpha - s[0]).abs().total_cmp(&(q.driver - alpha - s[0]).abs())
            })?;
            let pins = laid.at(board, alpha + s[0], side(near, d)?)?;
            board
                .arc(pins.b, pins.c)
                .line(laid.d, pins.c, Weight::Thin)
                .mark(&format!("C_{k}"), pins.c);
            let (wanted, off) =
                (phi + s[1], Vec2::from_angle((pins.c - laid.d).angle() - phi - s[1]).angle());
            board.read_angle(&format!("psi{k}"), wanted + off);
            drawn.push(pins);
        }
        let (k, first) = (which.first()?, drawn.first()?);
        board.step(both!("Draw the linkage AB{k}C{k}D"));
        laid.draw(board, first, Weight::Result);
        Some(())
    }
}
