//! Drawings of the slotted lever, the shaper and Whitworth's linkage.

use super::{Slotted, SlottedKind};
use crate::board::{PaperLine, SynthesisBoard, Weight};
use hodograph_base::diag::both;
use hodograph_base::digits::significant;
use hodograph_base::geom::Point;
use std::f64::consts::{FRAC_PI_2, PI};

/// Name of the half of the angle θ.
const HALF: &str = "\\theta/2";

impl Slotted {
    pub(super) fn drawn(&self, board: &mut SynthesisBoard) -> Option<()> {
        match self.kind {
            SlottedKind::Lever { .. } => self.swinging(board).map(|_| ()),
            SlottedKind::Shaper { stroke, .. } => {
                let (c, b) = self.swinging(board)?;
                ram(board, c, b, stroke)
            }
            SlottedKind::Whitworth { stroke, .. } => self.turning(board, stroke),
        }
    }

    /// Draws A above C; the lever in its limit is tangent to the crank's circle. Returns C and the
    /// right B.
    fn swinging(&self, board: &mut SynthesisBoard) -> Option<(Point, Point)> {
        let half = self.ratio.theta / 2.0;
        let named = significant(half.to_degrees(), 4);
        let (a, lever) = (Point::ORIGIN, FRAC_PI_2 - half);
        if self.by_crank {
            let radius = board.mm(self.crank);
            let b = PaperLine::ray(a, -half).place(radius);
            let c = PaperLine::ray(b, lever).cross(&PaperLine::ray(a, -FRAC_PI_2))?;
            board.step(both!("Draw the crank circle about A; lay off θ/2 = {named}° below the horizontal: B1; the tangent there meets the vertical through A at C"));
            board
                .circle(a, radius, Weight::Given)
                .line(a, b, Weight::Given)
                .line(c, b, Weight::Thin)
                .line(a, c, Weight::Thin);
            board.angle(a, [PaperLine::ray(a, 0.0).place(radius), b], HALF);
            board.mark("A", a).mark("B_1", b).mark("C", c).read("AC", a, c);
            return Some((c, b));
        }
        let c = Point::new(0.0, -board.mm(self.frame));
        let ray = PaperLine::ray(c, lever);
        let b = ray.cross(&ray.square(a))?;
        board.step(both!(
            "Lay off the frame AC; under θ/2 = {named}° from it draw the lever's limit; the perpendicular from A meets it at B1"
        ));
        board
            .line(a, c, Weight::Given)
            .line(c, b, Weight::Thin)
            .line(a, b, Weight::Result)
            .angle(c, [a, b], HALF)
            .mark("A", a)
            .mark("B_1", b)
            .mark("C", c);
        board.step(both!("The crank circle about A touches the lever in B1"));
        board.circle(a, a.distance(b), Weight::Thin).read("AB", a, b);
        Some((c, b))
    }

    /// Draws Whitworth's linkage: while the lever's dead-centre line turns by 180° the crank turns
    /// by 360°/(K + 1).
    fn turning(&self, board: &mut SynthesisBoard, stroke: f64) -> Option<()> {
        let half = PI / (self.ratio.k + 1.0);
        let a = Point::ORIGIN;
        let named = significant(half.to_degrees(), 4);
        let down = |side: f64| PaperLine::ray(a, -FRAC_PI_2 + side * half);
        let (b, c) = if self.by_crank {
            let radius = board.mm(self.crank);
            let b = [1.0, -1.0].map(|s| down(s).place(radius));
            let c = PaperLine::through(b[0], b[1])?.cross(&PaperLine::ray(a, -FRAC_PI_2))?;
            board.step(both!(
                "Draw the crank circle about A; B1 and B2 lie under 180°/(K + 1) = {named}° from the downward line; their chord meets it at C"
            ));
            board.circle(a, radius, Weight::Given);
            (b, c)
        } else {
            let c = Point::new(0.0, -board.mm(self.frame));
            let level = PaperLine::ray(c, 0.0);
            let b = [down(1.0).cross(&level)?, down(-1.0).cross(&level)?];
            board.step(both!(
                "Lay off the frame AC; rays from A under 180°/(K + 1) = {named}° to both sides meet the level line through C at B1, B2"
            ));
            board.circle(a, a.distance(b[0]), Weight::Thin);
            (b, c)
        };
        board
            .line(a, b[0], Weight::Thin)
            .line(a, b[1], Weight::Thin)
            .line(b[0], b[1], Weight::Thin)
            .line(a, c, Weight::Given);
        board
            .mark("A", a)
            .mark("B_1", b[0])
            .mark("B_2", b[1])
            .mark("C", c)
            .read("AB", a, b[0])
            .read("AC", a, c);
        let [p, q] = [0.0, board.mm(stroke)].map(|x| Point::new(c.x + x, c.y));
        board.step(both!("Lay the stroke off from C and halve it: the arm CD of the lever"));
        board.line(p, q, Weight::Thin);
        let d = board.middle(p, q)?;
        board.line(c, d, Weight::Result).mark("D", d).read("CD", c, d);
        Some(())
    }
}

/// Draws the shaper's lever by the stroke, and the ram's guide in the middle of the rise of D's
/// arc.
fn ram(board: &mut SynthesisBoard, c: Point, b: Point, stroke: f64) -> Option<()> {
    let half = board.mm(stroke) / 2.0;
    let lever = PaperLine::through(c, b)?;
    let d1 = lever.cross(&PaperLine::ray(Point::new(c.x + half, c.y), FRAC_PI_2))?;
    let d2 = Point::new(2.0 * c.x - d1.x, d1.y);
    board.step(both!(
        "At H/2 beside the vertical through C draw a parallel: it meets the lever at D1; D2 is its mirror image"
    ));
    board.line(c, d1, Weight::Result).line(c, d2, Weight::Thin).line(d1, d2, Weight::Thin).line(
        Point::new(c.x + half, c.y),
        d1,
        Weight::Thin,
    );
    board.mark("D_1", d1).mark("D_2", d2).read("CD", c, d1);
    let top = PaperLine::ray(c, FRAC_PI_2).place(c.distance(d1));
    let foot = Point::new(c.x, d1.y);
    board.step(both!(
        "D's arc about C; halve its rise over the chord D1D2: through the middle, y over C, runs the ram's guide"
    ));
    board.circle(c, c.distance(d1), Weight::Thin);
    let middle = board.middle(foot, top)?;
    board.line(
        Point::new(middle.x - 1.3 * half, middle.y),
        Point::new(middle.x + 1.3 * half, middle.y),
        Weight::Result,
    );
    board.mark("E", middle).read("y", c, middle);
    Some(())
}
