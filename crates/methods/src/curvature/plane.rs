//! Points and lines of the plane, including those at infinity, for constructions with the ruler:
//! join and crossing need no case distinctions.
//!
//! Homogeneous coordinates: a point (x, y, w), a line (a, b, c) with ax + by + cw = 0; both
//! operations are the cross product.

use hodograph_base::geom::{Point, Vec2};
use hodograph_board::construct::pencil::Hand;

/// A point of the plane, or a point at infinity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlanePoint {
    /// In the plane (m).
    At(Point),
    /// At infinity in this direction, and in the opposite one.
    Infinity(Vec2),
}

impl PlanePoint {
    /// Returns the place, if the point is not at infinity.
    pub fn at(self) -> Option<Point> {
        match self {
            PlanePoint::At(p) => Some(p),
            PlanePoint::Infinity(_) => None,
        }
    }

    /// Returns the place as a hand marks it; a point at infinity needs no mark.
    pub fn marked(self, hand: &Hand) -> PlanePoint {
        match self {
            PlanePoint::At(p) => PlanePoint::At(hand.mark(p)),
            PlanePoint::Infinity(_) => self,
        }
    }

    /// Returns the line through both points.
    pub fn join(self, other: PlanePoint) -> PlaneLine {
        match (self, other) {
            (PlanePoint::At(p), PlanePoint::At(q)) => PlaneLine { through: Some(p), along: q - p },
            (PlanePoint::At(p), PlanePoint::Infinity(u))
            | (PlanePoint::Infinity(u), PlanePoint::At(p)) => {
                PlaneLine { through: Some(p), along: u }
            }
            (PlanePoint::Infinity(u), PlanePoint::Infinity(_)) => {
                PlaneLine { through: None, along: u }
            }
        }
    }
}

/// A line; without a place, the line at infinity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneLine {
    /// A place on the line.
    pub through: Option<Point>,
    /// The direction, of any length; zero if it is not determined.
    pub along: Vec2,
}

impl PlaneLine {
    /// Returns the sine of the angle to another line.
    pub fn sine(self, other: PlaneLine) -> f64 {
        match (self.along.unit(), other.along.unit()) {
            (Some(u), Some(w)) => u.cross(w),
            _ => 0.0,
        }
    }

    /// Returns the unit direction.
    pub fn unit(self) -> Option<Vec2> {
        self.along.unit()
    }

    /// Returns the distance of a point from the line; `None` for a point at infinity.
    pub fn distance(self, from: PlanePoint) -> Option<f64> {
        Some((from.at()? - self.through?).cross(self.along.unit()?).abs())
    }
}

/// Lines with a smaller sine between them cross at infinity.
const PARALLEL: f64 = 1e-12;

/// Returns the crossing of two lines; `None` if they coincide or are undetermined.
pub fn meet(a: PlaneLine, b: PlaneLine) -> Option<PlanePoint> {
    match (a.through, b.through) {
        (Some(p), Some(q)) => {
            let (u, w) = (a.unit()?, b.unit()?);
            if u.cross(w).abs() > PARALLEL {
                return Some(PlanePoint::At(hodograph_base::geom::cross_lines(p, u, q, w).at));
            }
            let apart = (q - p).cross(u).abs();
            (apart > PARALLEL * (q - p).norm() && apart > 0.0).then_some(PlanePoint::Infinity(u))
        }
        (Some(_), None) => Some(PlanePoint::Infinity(a.unit()?)),
        (None, Some(_)) => Some(PlanePoint::Infinity(b.unit()?)),
        (None, None) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_at_infinity_are_joined_and_crossed() {
        let (o, p) = (PlanePoint::At(Point::ORIGIN), PlanePoint::At(Point::new(0.0, 2.0)));
        let right = PlanePoint::Infinity(Vec2::new(3.0, 0.0));
        assert_eq!(
            meet(o.join(right), p.join(right)),
            Some(PlanePoint::Infinity(Vec2::new(1.0, 0.0)))
        );
        assert_eq!(
            meet(o.join(p), PlanePoint::At(Point::new(5.0, 1.0)).join(right)),
            Some(PlanePoint::At(Point::new(0.0, 1.0)))
        );
        assert_eq!(meet(o.join(p), o.join(p)), None);
        assert_eq!(
            meet(right.join(PlanePoint::Infinity(Vec2::new(0.0, 1.0))), o.join(p)),
            Some(PlanePoint::Infinity(Vec2::new(0.0, 1.0)))
        );
    }
}
