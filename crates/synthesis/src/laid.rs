//! A four-bar of computed lengths drawn in positions of its crank, and measured.
//!
//! Least squares, the exchange, searches and given proportions end in lengths that no crossing of circles gives. A draughtsman proves them
//! by laying them off: B on the crank's circle, C where the arcs about B and D cross, E by the set square from BC; what the points miss is
//! read off the paper. The assembly of a position is the design's, all places are the compasses'.

use super::board::{Board, Line, Weight};
use super::candidate::{Draft, Wanted};
use super::told::of;
use hodograph_base::diag::Both;
use hodograph_base::geom::{Point, Vec2};

/// Positions that one drawing shows: more would hide one another.
const SHOWN: usize = 12;
/// Circles that miss one another by no more touch in a dead point (mm).
const TOUCH_MM: f64 = 1e-6;

/// The indices of the positions that are drawn: all, or so many evenly taken with the first and the last.
pub fn shown(count: usize) -> Vec<usize> {
    if count <= SHOWN { (0..count).collect() } else { (0..SHOWN).map(|k| k * (count - 1) / (SHOWN - 1)).collect() }
}

/// A letter with numbers of positions: `E1, E2, E3`.
pub fn numbered(letter: &str, of: &[usize]) -> Both {
    let all: Vec<String> = of.iter().map(|k| format!("{letter}{k}")).collect();
    Both::names(&all)
}

/// The pivots and openings of the compasses, in millimetres of paper.
#[derive(Clone, Copy, Debug)]
pub struct Laid {
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
    /// E along BC from B, and to the left of it.
    e: Option<Vec2>,
}

/// The pins of a position on paper.
#[derive(Clone, Copy, Debug)]
pub struct Pins {
    /// Pin of crank and coupler.
    pub b: Point,
    /// Pin of coupler and follower.
    pub c: Point,
    /// Coupler point; C where there is none.
    pub e: Point,
}

impl Laid {
    /// The pivots and the design's lengths laid off (m).
    pub fn off(board: &Board, draft: &Draft, [a, d]: [Point; 2], e: Option<Vec2>) -> Laid {
        let opening = |name: &str| board.mm(of(draft, name));
        Laid {
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

    /// The position at an angle of the crank, C on a side of BD.
    pub fn at(&self, board: &Board, crank: f64, left: bool) -> Option<Pins> {
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
        let along = Line::through(b, c)?.along;
        Some(Pins { b, c, e: self.e.map_or(c, |e| b + e.rotate_by(along)) })
    }

    /// C in a dead point, on the line DB.
    fn touching(&self, b: Point) -> Option<Point> {
        let line = Line::through(self.d, b)?;
        let apart = self.d.distance(b);
        let miss = (apart - self.coupler - self.follower).max((self.coupler - self.follower).abs() - apart);
        let beyond = apart < self.coupler && self.follower < self.coupler;
        (miss < TOUCH_MM).then(|| line.place(if beyond { -self.follower } else { self.follower }))
    }

    /// Draws the links of a position.
    pub fn draw(&self, board: &mut Board, pins: &Pins, weight: Weight) {
        board.line(self.a, pins.b, weight).line(pins.b, pins.c, weight).line(pins.c, self.d, weight);
        if self.e.is_some() {
            board.line(pins.b, pins.e, weight).line(pins.e, pins.c, weight);
        }
    }
}

/// On which side of BD a wanted position has C.
pub fn side(wanted: &Wanted, d: Point) -> Option<bool> {
    let place = |name: &str| wanted.places.iter().find(|p| p.0 == name).map(|p| p.1);
    let (b, c) = (place("B")?, place("C")?);
    Some((d - b).cross(c - b) > 0.0)
}
