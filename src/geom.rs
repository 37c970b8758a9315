//! Points and vectors of the plane, x to the right, y up, angles counter-clockwise plus.
//!
//! A [`Point`] is a place, a [`Vec2`] a displacement (or a velocity, an acceleration): `Point − Point = Vec2`,
//! there is no `Point + Point`. The unit is that of the caller (SI metres, or millimetres of paper) and is said in
//! the names there. Nothing here knows of tolerances: parallel lines are judged by the sine that [`cross_lines`]
//! hands back, not by a test inside.

use std::ops::{Add, AddAssign, Mul, Neg, Sub};

/// A place in the plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    /// To the right.
    pub x: f64,
    /// Up.
    pub y: f64,
}

/// A displacement, velocity or acceleration in the plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vec2 {
    /// To the right.
    pub x: f64,
    /// Up.
    pub y: f64,
}

impl Point {
    /// The origin.
    pub const ORIGIN: Point = Point { x: 0.0, y: 0.0 };

    /// The point (x, y).
    pub const fn new(x: f64, y: f64) -> Self {
        Point { x, y }
    }

    /// The vector from the origin to this point.
    pub const fn to_vec2(self) -> Vec2 {
        Vec2::new(self.x, self.y)
    }

    /// Distance to another point.
    pub fn distance(self, other: Point) -> f64 {
        (other - self).norm()
    }

    /// Whether both coordinates are finite.
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }
}

impl Vec2 {
    /// The zero vector.
    pub const ZERO: Vec2 = Vec2 { x: 0.0, y: 0.0 };

    /// The vector (x, y).
    pub const fn new(x: f64, y: f64) -> Self {
        Vec2 { x, y }
    }

    /// The unit vector at `angle` radians, counter-clockwise from the x axis.
    pub fn from_angle(angle_rad: f64) -> Self {
        Vec2::new(libm::cos(angle_rad), libm::sin(angle_rad))
    }

    /// The point that this vector leads to from the origin.
    pub const fn to_point(self) -> Point {
        Point::new(self.x, self.y)
    }

    /// Scalar product.
    pub fn dot(self, other: Vec2) -> f64 {
        self.x * other.x + self.y * other.y
    }

    /// Cross product's z component: positive when `other` lies counter-clockwise of `self`.
    pub fn cross(self, other: Vec2) -> f64 {
        self.x * other.y - self.y * other.x
    }

    /// Length, without overflow for large components.
    pub fn norm(self) -> f64 {
        libm::hypot(self.x, self.y)
    }

    /// Square of the length.
    pub fn norm2(self) -> f64 {
        self.dot(self)
    }

    /// Turned by +90° (counter-clockwise): ω k × r = ω · r.perp().
    pub const fn perp(self) -> Vec2 {
        Vec2::new(-self.y, self.x)
    }

    /// Angle from the x axis, in (−π, π].
    pub fn angle(self) -> f64 {
        libm::atan2(self.y, self.x)
    }

    /// The unit vector of the same direction; `None` for the zero vector, which has none.
    pub fn unit(self) -> Option<Vec2> {
        let n = self.norm();
        (n > 0.0 && n.is_finite()).then(|| Vec2::new(self.x / n, self.y / n))
    }

    /// Turned by the angle of the unit vector `by`, scaled by its length (complex product).
    pub fn rotate_by(self, by: Vec2) -> Vec2 {
        Vec2::new(self.x * by.x - self.y * by.y, self.x * by.y + self.y * by.x)
    }

    /// Complex quotient self / by: the turn and stretch that takes `by` to `self`.
    pub fn divide_by(self, by: Vec2) -> Vec2 {
        let d = by.norm2();
        Vec2::new(self.dot(by) / d, by.cross(self) / d)
    }

    /// Whether both components are finite.
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }
}

impl Sub for Point {
    type Output = Vec2;
    fn sub(self, o: Point) -> Vec2 {
        Vec2::new(self.x - o.x, self.y - o.y)
    }
}
impl Add<Vec2> for Point {
    type Output = Point;
    fn add(self, v: Vec2) -> Point {
        Point::new(self.x + v.x, self.y + v.y)
    }
}
impl Sub<Vec2> for Point {
    type Output = Point;
    fn sub(self, v: Vec2) -> Point {
        Point::new(self.x - v.x, self.y - v.y)
    }
}
impl Add for Vec2 {
    type Output = Vec2;
    fn add(self, o: Vec2) -> Vec2 {
        Vec2::new(self.x + o.x, self.y + o.y)
    }
}
impl AddAssign for Vec2 {
    fn add_assign(&mut self, o: Vec2) {
        *self = *self + o;
    }
}
impl Sub for Vec2 {
    type Output = Vec2;
    fn sub(self, o: Vec2) -> Vec2 {
        Vec2::new(self.x - o.x, self.y - o.y)
    }
}
impl Neg for Vec2 {
    type Output = Vec2;
    fn neg(self) -> Vec2 {
        Vec2::new(-self.x, -self.y)
    }
}
impl Mul<f64> for Vec2 {
    type Output = Vec2;
    fn mul(self, k: f64) -> Vec2 {
        Vec2::new(self.x * k, self.y * k)
    }
}
impl Mul<Vec2> for f64 {
    type Output = Vec2;
    fn mul(self, v: Vec2) -> Vec2 {
        v * self
    }
}

/// Where two lines cross.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The crossing point; not finite when the lines are parallel.
    pub at: Point,
    /// Sine of the angle from the first line to the second, in [−1, 1]. The caller judges it.
    pub sine: f64,
}

/// Crosses the line through `p` along `u` with the line through `q` along `w` (neither needs to be a unit vector).
pub fn cross_lines(p: Point, u: Vec2, q: Point, w: Vec2) -> Crossing {
    let det = u.cross(w);
    let sine = det / (u.norm() * w.norm());
    let t = (q - p).cross(w) / det;
    Crossing { at: p + u * t, sine }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn perp_is_a_quarter_turn_counter_clockwise() {
        assert_eq!(Vec2::new(1.0, 0.0).perp(), Vec2::new(0.0, 1.0));
        assert_eq!(Vec2::new(1.0, 0.0).cross(Vec2::new(0.0, 1.0)), 1.0);
    }

    #[test]
    fn crossing_of_the_axes() {
        let c = cross_lines(Point::new(3.0, 0.0), Vec2::new(2.0, 0.0), Point::new(0.0, 4.0), Vec2::new(0.0, 5.0));
        assert_eq!(c.at, Point::ORIGIN);
        assert_eq!(c.sine, 1.0);
    }

    #[test]
    fn quotient_undoes_product() {
        let (a, b) = (Vec2::new(3.0, 4.0), Vec2::new(0.0, 2.0));
        assert_eq!(a.rotate_by(b).divide_by(b), a);
    }
}
