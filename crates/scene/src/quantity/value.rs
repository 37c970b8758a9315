//! The value of an answer, and the data that its formula may use.

use super::{Forces, Form, Level};
use crate::model::{GuideId, LinkId, OnLink, PointId, Scene};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;

/// The value of an answer, in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value<N = f64> {
    /// A vector.
    Vector(Vec2<N>),
    /// A number (ω, α, an angle, a distance); positive counter-clockwise.
    Scalar(N),
    /// A place in the plane (m).
    Point(Point<N>),
}

impl<N: Real> Value<N> {
    /// Returns its form.
    pub fn form(&self) -> Form {
        match self {
            Value::Vector(_) => Form::Vector,
            Value::Scalar(_) => Form::Scalar,
            Value::Point(_) => Form::Point,
        }
    }

    /// Returns its numbers: one for a scalar; the components of a vector, the coordinates of a
    /// place.
    pub fn numbers(&self) -> (N, Option<N>) {
        match *self {
            Value::Vector(v) => (v.x, Some(v.y)),
            Value::Scalar(s) => (s, None),
            Value::Point(p) => (p.x, Some(p.y)),
        }
    }

    /// Applies `f` to each number; the form remains.
    pub fn map<M>(self, mut f: impl FnMut(N) -> M) -> Value<M> {
        match self {
            Value::Vector(v) => Value::Vector(Vec2 { x: f(v.x), y: f(v.y) }),
            Value::Scalar(s) => Value::Scalar(f(s)),
            Value::Point(p) => Value::Point(Point { x: f(p.x), y: f(p.y) }),
        }
    }
}

impl Value {
    /// Returns the magnitude of a vector, the absolute value of a number, or the distance of a
    /// place from the origin.
    pub fn magnitude(&self) -> f64 {
        match self {
            Value::Vector(v) => v.norm(),
            Value::Scalar(s) => s.abs(),
            Value::Point(p) => (*p - Point::origin()).norm(),
        }
    }

    /// Returns its numbers in a table, as [`Form::columns`] names them.
    pub fn columns(&self) -> Vec<f64> {
        match *self {
            Value::Vector(v) => vec![v.x, v.y, v.norm()],
            Value::Scalar(s) => vec![s],
            Value::Point(p) => vec![p.x, p.y],
        }
    }

    /// Returns the value, or zero if it is at most `noise`; for a place, each coordinate
    /// separately.
    pub fn above(&self, noise: f64) -> Value {
        match *self {
            Value::Point(_) => self.map(|x| if x.abs() > noise { x } else { 0.0 }),
            Value::Vector(_) | Value::Scalar(_) if self.magnitude() > noise => *self,
            Value::Vector(_) | Value::Scalar(_) => self.map(|_| 0.0),
        }
    }

    /// Returns the distance of two values of one form; `None` if their forms differ.
    pub fn apart(&self, other: &Value) -> Option<f64> {
        match (self, other) {
            (Value::Vector(a), Value::Vector(b)) => Some((*a - *b).norm()),
            (Value::Scalar(a), Value::Scalar(b)) => Some((a - b).abs()),
            (Value::Point(a), Value::Point(b)) => Some((*a - *b).norm()),
            (Value::Vector(_) | Value::Scalar(_) | Value::Point(_), _) => None,
        }
    }
}

/// Rounding error of a difference, as a fraction of the largest number of its kind in the
/// mechanism.
pub const ROUNDING: f64 = 1e-13;

/// Returns true if a difference is within rounding errors relative to `beside`; never for number
/// types that refine their values.
pub(super) fn vanishes<N: Real>(value: N, beside: f64) -> bool {
    !N::refines() && value.approx().abs() <= ROUNDING * beside
}

/// Returns the largest known angular velocity, or the quotient of the largest velocity and the size
/// of the mechanism if it is larger: relative to it, a link that turns by rounding errors alone is
/// at rest.
pub(super) fn fastest<N: Real, K: Known<N>>(known: &K) -> f64 {
    let turning = (0..known.scene().links.len()).filter_map(|l| known.turning(Level::Velocity, LinkId(l)));
    let omega = turning.map(|omega| omega.approx().abs()).fold(0.0, f64::max);
    let mut places = (0..known.scene().points.len()).filter_map(|p| Some(known.point(PointId(p))?.approx()));
    let size = places.next().map_or(0.0, |first| places.map(|p| p.distance(first)).fold(0.0, f64::max));
    if size > 0.0 { omega.max(largest(known, Level::Velocity) / size) } else { omega }
}

/// Returns the largest known velocity or acceleration of a point.
pub(super) fn largest<N: Real, K: Known<N>>(known: &K, level: Level) -> f64 {
    let points = (0..known.scene().points.len()).map(|p| OnLink { point: PointId(p), link: None });
    points.filter_map(|p| known.vector(level, &p)).map(|v| v.norm().approx()).fold(0.0, f64::max)
}

/// The data that a formula may use: the scene, the places of a pose, and its motion.
pub trait Known<N> {
    /// The scene.
    fn scene(&self) -> &Scene;
    /// The place of a point.
    fn point(&self, p: PointId) -> Option<Point<N>>;
    /// A straight guide in the fixed plane: the place at which its coordinate is zero, and its
    /// direction.
    fn guide(&self, g: GuideId) -> Option<(Point<N>, Vec2<N>)>;
    /// The zero direction of a link's angle.
    fn direction(&self, link: LinkId) -> Option<Vec2<N>>;
    /// The vector of the point of a link (or of the pin itself).
    fn vector(&self, level: Level, p: &OnLink) -> Option<Vec2<N>>;
    /// The angular velocity or acceleration of a link.
    fn turning(&self, level: Level, link: LinkId) -> Option<N>;
    /// The forces.
    fn forces(&self) -> Option<&Forces<N>>;
}
