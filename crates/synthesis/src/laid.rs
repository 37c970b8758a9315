//! Drawings of a four-bar of computed lengths in positions of its crank, and measurements on them.
//!
//! Least squares, the exchange, searches and given proportions result in lengths that no
//! intersection of circles gives. They are checked by laying them off: B on the crank's circle, C
//! where the arcs about B and D intersect, E by the set square from BC; the distances of the points
//! from the wanted places are read from the paper. The assembly of a position is the design's; all
//! places are constructed.

use super::board::{PaperLine, SynthesisBoard, Weight};
use super::candidate::{Draft, WantedPosition};
use super::statement::of;
use hodograph_base::diag::Both;
use hodograph_base::geom::{Point, Vec2};

/// Greatest number of positions in one drawing, so that they do not hide one another.
const SHOWN: usize = 12;
/// Circles that miss one another by no more than this touch in a dead centre (mm).
const TOUCH_MM: f64 = 1e-6;

/// The indices of the positions to draw: all, or [`SHOWN`] evenly distributed ones including the
/// first and the last.
pub fn shown(count: usize) -> Vec<usize> {
    if count <= SHOWN {
        (0..count).collect()
    } else {
        (0..SHOWN).map(|k| k * (count - 1) / (SHOWN - 1)).collect()
    }
}

/// A letter with position numbers: `E1, E2, E3`.
pub fn numbered(letter: &str, of: &[usize]) -> Both {
    let all: Vec<String> = of.iter().map(|k| format!("{letter}{k}")).collect();
    Both::names(&all)
}

/// The pivots and openings of the compasses, in millimetres of paper.
#[derive(Clone, Copy, Debug)]
pub struct LaidFourBar {
    /// Crank pivot.
    pub a: Point,
    /// Follower pivot.
    pub d: Point,
    /// AB.
    pub crank: f64,
    /// BC.
    pub coupler: f64,
    /// CD.
    pub follower: f64,
    /// E along BC from B, and to the left of BC.
    e: Option<Vec2>,
}

/// The pins of a position on paper.
#[derive(Clone, Copy, Debug)]
pub struct Pins {
    /// Pin of crank and coupler.
    pub b: Point,
    /// Pin of coupler and follower.
    pub c: Point,
    /// The coupler point; C if there is none.
    pub e: Point,
}

impl LaidFourBar {
    /// Lays off the pivots and the lengths of a design (m).
    pub fn off(
        board: &SynthesisBoard,
        draft: &Draft,
        [a, d]: [Point; 2],
        e: Option<Vec2>,
    ) -> LaidFourBar {
        let opening = |name: &str| board.mm(of(draft, name));
        LaidFourBar {
            a: board.at(a),
            d: board.at(d),
            crank: opening("AB"),
            coupler: opening("BC"),
            follower: opening("CD"),
            e: e.map(|e| Vec2::new(board.mm(e.x), board.mm(e.y))),
        }
    }

    /// The pin of the crank at an angle (rad).
    pub fn b(&self, crank: f64) -> Point {
        self.a + Vec2::from_angle(crank) * self.crank
    }

    /// The position at a crank angle (rad), C on one side of BD.
    pub fn at(&self, board: &SynthesisBoard, crank: f64, left: bool) -> Option<Pins> {
        let b = self.b(crank);
        let c = match board.circles(b, self.coupler, self.d, self.follower) {
            Some([on_left, on_right]) => {
                if left {
                    on_left
                } else {
                    on_right
                }
            }
            None => self.touching(b)?,
        };
        let along = PaperLine::through(b, c)?.along;
        Some(Pins { b, c, e: self.e.map_or(c, |e| b + e.rotate_by(along)) })
    }

    /// C in a dead centre, on the line DB.
    fn touching(&self, b: Point) -> Option<Point> {
        let line = PaperLine::through(self.d, b)?;
        let apart = self.d.distance(b);
        let miss = (apart - self.coupler - self.follower)
            .max((self.coupler - self.follower).abs() - apart);
        let beyond = apart < self.coupler && self.follower < self.coupler;
        (miss < TOUCH_MM).then(|| line.place(if beyond { -self.follower } else { self.follower }))
    }

    /// Draws the links of a position.
    pub fn draw(&self, board: &mut SynthesisBoard, pins: &Pins, weight: Weight) {
        board
            .line(self.a, pins.b, weight)
            .line(pins.b, pins.c, weight)
            .line(pins.c, self.d, weight);
        if self.e.is_some() {
            board.line(pins.b, pins.e, weight).line(pins.e, pins.c, weight);
        }
    }
}

/// True if C of a wanted position is left of BD.
pub fn side(wanted: &WantedPosition, d: Point) -> Option<bool> {
    let place = |name: &str| wanted.places.iter().find(|p| p.0 == name).map(|p| p.1);
    let (b, c) = (place("B")?, place("C")?);
    Some((d - b).cross(c - b) > 0.0)
}
