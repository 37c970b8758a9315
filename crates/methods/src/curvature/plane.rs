//! Points and lines of the plane with what lies at infinity, for ruler constructions: joined and crossed without asking which is which.
//!
//! Homogeneous coordinates: a point (x, y, w), a line (a, b, c) with ax + by + cw = 0; both operations are the cross product.

use hodograph_base::geom::{Point, Vec2};
use hodograph_board::construct::pencil::Hand;

/// A point of the plane, or one at infinity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    /// In the plane (m).
    At(Point),
    /// At infinity in this direction, and in the opposite one.
    Infinity(Vec2),
}

impl End {
    /// The place, if it is one.
    pub fn at(self) -> Option<Point> {
        match self {
            End::At(p) => Some(p),
            End::Infinity(_) => None,
        }
    }

    /// Returns the place as a hand marks it; a point at infinity needs no mark.
    pub fn marked(self, hand: &Hand) -> End {
        match self {
            End::At(p) => End::At(hand.mark(p)),
            End::Infinity(_) => self,
        }
    }

    /// The line through both.
    pub fn join(self, other: End) -> Line {
        match (self, other) {
            (End::At(p), End::At(q)) => Line { through: Some(p), along: q - p },
            (End::At(p), End::Infinity(u)) | (End::Infinity(u), End::At(p)) => Line { through: Some(p), along: u },
            (End::Infinity(u), End::Infinity(_)) => Line { through: None, along: u },
        }
    }
}

/// A line; without a place the one at infinity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// A place on it.
    pub through: Option<Point>,
    /// Its direction, of any length; zero where it is not determined.
    pub along: Vec2,
}

impl Line {
    /// The sine of the angle to another.
    pub fn sine(self, other: Line) -> f64 {
        match (self.along.unit(), other.along.unit()) {
            (Some(u), Some(w)) => u.cross(w),
            _ => 0.0,
        }
    }

    /// Its unit direction.
    pub fn unit(self) -> Option<Vec2> {
        self.along.unit()
    }

    /// How far a point is from it; `None` for a point at infinity.
    pub fn distance(self, from: End) -> Option<f64> {
        Some((from.at()? - self.through?).cross(self.along.unit()?).abs())
    }
}

/// Lines nearer to being parallel than this (sine) cross at infinity.
const PARALLEL: f64 = 1e-12;

/// Where two lines cross; `None` where they are one, or undetermined.
pub fn meet(a: Line, b: Line) -> Option<End> {
    match (a.through, b.through) {
        (Some(p), Some(q)) => {
            let (u, w) = (a.unit()?, b.unit()?);
            if u.cross(w).abs() > PARALLEL {
                return Some(End::At(hodograph_base::geom::cross_lines(p, u, q, w).at));
            }
            let apart = (q - p).cross(u).abs();
            (apart > PARALLEL * (q - p).norm() && apart > 0.0).then_some(End::Infinity(u))
        }
        (Some(_), None) => Some(End::Infinity(a.unit()?)),
        (None, Some(_)) => Some(End::Infinity(b.unit()?)),
        (None, None) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_at_infinity_are_joined_and_crossed() {
        let (o, p) = (End::At(Point::ORIGIN), End::At(Point::new(0.0, 2.0)));
        let right = End::Infinity(Vec2::new(3.0, 0.0));
        assert_eq!(meet(o.join(right), p.join(right)), Some(End::Infinity(Vec2::new(1.0, 0.0))));
        assert_eq!(meet(o.join(p), End::At(Point::new(5.0, 1.0)).join(right)), Some(End::At(Point::new(0.0, 1.0))));
        assert_eq!(meet(o.join(p), o.join(p)), None);
        assert_eq!(meet(right.join(End::Infinity(Vec2::new(0.0, 1.0))), o.join(p)), Some(End::Infinity(Vec2::new(0.0, 1.0))));
    }
}
