//! Points and vectors of the plane, x to the right, y up, angles counter-clockwise positive.
//!
//! A [`Point`] is a position, a [`Vec2`] a displacement (or a velocity, an acceleration): `Point −
//! Point = Vec2`, there is no `Point + Point`. The caller chooses the unit (SI metres, or
//! millimetres of paper) and states it in its names. This module has no tolerances: the caller
//! judges parallel lines by the sine that [`cross_lines`] returns.

use crate::number::{Real, Ring};
use std::ops::{Add, AddAssign, Mul, Neg, Sub};

/// A position in the plane.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Point<N = f64> {
    /// The coordinate to the right.
    pub x: N,
    /// The coordinate upward.
    pub y: N,
}

/// A displacement, velocity or acceleration in the plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vec2<N = f64> {
    /// The component to the right.
    pub x: N,
    /// The component upward.
    pub y: N,
}

impl Point {
    /// The origin.
    pub const ORIGIN: Point = Point { x: 0.0, y: 0.0 };
}

impl<N: Copy> Point<N> {
    /// Returns the point (x, y).
    pub const fn new(x: N, y: N) -> Self {
        Point { x, y }
    }

    /// Returns the vector from the origin to this point.
    pub const fn to_vec2(self) -> Vec2<N> {
        Vec2::new(self.x, self.y)
    }

    /// Returns the point with both coordinates changed by the same function.
    pub fn map<M>(self, number: impl Fn(N) -> M) -> Point<M> {
        Point { x: number(self.x), y: number(self.y) }
    }
}

impl<N: Real> Point<N> {
    /// Returns the origin.
    pub fn origin() -> Self {
        Vec2::zero().to_point()
    }

    /// Returns the distance to another point.
    pub fn distance(self, other: Point<N>) -> N {
        (other - self).norm()
    }

    /// Returns true if both coordinates have a value.
    pub fn is_finite(self) -> bool {
        self.x.is_decided() && self.y.is_decided()
    }

    /// Returns the nearest point with `f64` coordinates.
    pub fn approx(self) -> Point {
        self.map(N::approx)
    }
}

impl Vec2 {
    /// The zero vector.
    pub const ZERO: Vec2 = Vec2 { x: 0.0, y: 0.0 };
}

impl<N: Copy> Vec2<N> {
    /// Returns the vector (x, y).
    pub const fn new(x: N, y: N) -> Self {
        Vec2 { x, y }
    }

    /// Returns the point with this vector as position vector.
    pub const fn to_point(self) -> Point<N> {
        Point::new(self.x, self.y)
    }

    /// Returns the vector with both components changed by the same function.
    pub fn map<M>(self, number: impl Fn(N) -> M) -> Vec2<M> {
        Vec2 { x: number(self.x), y: number(self.y) }
    }
}

// Always inlined: the lanes of a sweep stay in wide registers only within one function.
impl<N: Ring> Vec2<N> {
    /// Returns the scalar product.
    #[inline(always)]
    pub fn dot(self, other: Vec2<N>) -> N {
        self.x * other.x + self.y * other.y
    }

    /// Returns the z component of the cross product: positive if `other` points counter-clockwise
    /// of `self`.
    #[inline(always)]
    pub fn cross(self, other: Vec2<N>) -> N {
        self.x * other.y - self.y * other.x
    }

    /// Returns the square of the length.
    #[inline(always)]
    pub fn norm2(self) -> N {
        self.dot(self)
    }

    /// Returns the vector turned by +90° (counter-clockwise): ω k × r = ω · r.perp().
    #[inline(always)]
    pub fn perp(self) -> Vec2<N> {
        Vec2::new(-self.y, self.x)
    }

    /// Returns the vector turned by the angle of the unit vector `by` and scaled by its length
    /// (complex product).
    #[inline(always)]
    pub fn rotate_by(self, by: Vec2<N>) -> Vec2<N> {
        Vec2::new(self.x * by.x - self.y * by.y, self.x * by.y + self.y * by.x)
    }
}

impl<N: Real> Vec2<N> {
    /// Returns the zero vector.
    pub fn zero() -> Self {
        Vec2::new(N::from_f64(0.0), N::from_f64(0.0))
    }

    /// Returns the unit vector of the x axis.
    pub fn unit_x() -> Self {
        Vec2::new(N::from_f64(1.0), N::from_f64(0.0))
    }

    /// Returns the unit vector at `angle_rad`, counter-clockwise from the x axis.
    pub fn from_angle(angle_rad: N) -> Self {
        let (s, c) = angle_rad.sin_cos();
        Vec2::new(c, s)
    }

    /// Returns the length, without overflow for large components.
    pub fn norm(self) -> N {
        self.x.hypot(self.y)
    }

    /// Returns the angle from the x axis, in (−π, π].
    pub fn angle(self) -> N {
        self.y.atan2(self.x)
    }

    /// Returns the unit vector of the same direction; `None` for the zero vector.
    pub fn unit(self) -> Option<Vec2<N>> {
        let n = self.norm();
        (n.approx() > 0.0 && n.is_decided()).then(|| Vec2::new(self.x / n, self.y / n))
    }

    /// Returns the complex quotient self / by: the rotation and stretch that turns `by` into
    /// `self`.
    pub fn divide_by(self, by: Vec2<N>) -> Vec2<N> {
        let d = by.norm2();
        Vec2::new(self.dot(by) / d, by.cross(self) / d)
    }

    /// Returns true if both components have a value.
    pub fn is_finite(self) -> bool {
        self.x.is_decided() && self.y.is_decided()
    }

    /// Returns the nearest vector with `f64` components.
    pub fn approx(self) -> Vec2 {
        self.map(N::approx)
    }
}

impl Vec2 {
    /// Converts the components to another number type.
    pub fn lift<N: Real>(self) -> Vec2<N> {
        self.map(N::from_f64)
    }
}

impl Point {
    /// Converts the coordinates to another number type.
    pub fn lift<N: Real>(self) -> Point<N> {
        self.map(N::from_f64)
    }
}

impl<N: Ring> Sub for Point<N> {
    type Output = Vec2<N>;
    #[inline(always)]
    fn sub(self, o: Point<N>) -> Vec2<N> {
        Vec2::new(self.x - o.x, self.y - o.y)
    }
}
impl<N: Ring> Add<Vec2<N>> for Point<N> {
    type Output = Point<N>;
    #[inline(always)]
    fn add(self, v: Vec2<N>) -> Point<N> {
        Point::new(self.x + v.x, self.y + v.y)
    }
}
impl<N: Ring> Sub<Vec2<N>> for Point<N> {
    type Output = Point<N>;
    #[inline(always)]
    fn sub(self, v: Vec2<N>) -> Point<N> {
        Point::new(self.x - v.x, self.y - v.y)
    }
}
impl<N: Ring> Add for Vec2<N> {
    type Output = Vec2<N>;
    #[inline(always)]
    fn add(self, o: Vec2<N>) -> Vec2<N> {
        Vec2::new(self.x + o.x, self.y + o.y)
    }
}
impl<N: Ring> AddAssign for Vec2<N> {
    #[inline(always)]
    fn add_assign(&mut self, o: Vec2<N>) {
        *self = *self + o;
    }
}
impl<N: Ring> Sub for Vec2<N> {
    type Output = Vec2<N>;
    #[inline(always)]
    fn sub(self, o: Vec2<N>) -> Vec2<N> {
        Vec2::new(self.x - o.x, self.y - o.y)
    }
}
impl<N: Ring> Neg for Vec2<N> {
    type Output = Vec2<N>;
    #[inline(always)]
    fn neg(self) -> Vec2<N> {
        Vec2::new(-self.x, -self.y)
    }
}
impl<N: Ring> Mul<N> for Vec2<N> {
    type Output = Vec2<N>;
    #[inline(always)]
    fn mul(self, k: N) -> Vec2<N> {
        Vec2::new(self.x * k, self.y * k)
    }
}
impl Mul<Vec2> for f64 {
    type Output = Vec2;
    fn mul(self, v: Vec2) -> Vec2 {
        v * self
    }
}

/// The intersection of two lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing<N = f64> {
    /// The point of intersection; not finite if the lines are parallel.
    pub at: Point<N>,
    /// Sine of the angle from the first line to the second, in [−1, 1]. The caller judges it.
    pub sine: N,
}

/// Intersects the line through `p` along `u` with the line through `q` along `w` (neither needs to
/// be a unit vector).
pub fn cross_lines<N: Real>(p: Point<N>, u: Vec2<N>, q: Point<N>, w: Vec2<N>) -> Crossing<N> {
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
        let c = cross_lines(
            Point::new(3.0, 0.0),
            Vec2::new(2.0, 0.0),
            Point::new(0.0, 4.0),
            Vec2::new(0.0, 5.0),
        );
        assert_eq!(c.at, Point::ORIGIN);
        assert_eq!(c.sine, 1.0);
    }

    #[test]
    fn quotient_undoes_product() {
        let (a, b) = (Vec2::new(3.0, 4.0), Vec2::new(0.0, 2.0));
        assert_eq!(a.rotate_by(b).divide_by(b), a);
    }
}
