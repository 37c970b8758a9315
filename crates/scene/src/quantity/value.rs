//! What an answer is, and what a formula may use to find one.

use super::{Forces, Form, Level};
use crate::model::{GuideId, LinkId, OnLink, PointId, Scene};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;

/// The value of an answer, in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value<N = f64> {
    /// A vector.
    Vector(Vec2<N>),
    /// A number (ω, α, an angle, a distance); counter-clockwise plus.
    Scalar(N),
    /// A place in the plane (m).
    Point(Point<N>),
}

impl<N: Real> Value<N> {
    /// Which form it has.
    pub fn form(&self) -> Form {
        match self {
            Value::Vector(_) => Form::Vector,
            Value::Scalar(_) => Form::Scalar,
            Value::Point(_) => Form::Point,
        }
    }

    /// Its numbers: a scalar's one; the components of a vector, the coordinates of a place.
    pub fn numbers(&self) -> (N, Option<N>) {
        match *self {
            Value::Vector(v) => (v.x, Some(v.y)),
            Value::Scalar(s) => (s, None),
            Value::Point(p) => (p.x, Some(p.y)),
        }
    }

    /// A value of the same form, each number put through `f`.
    pub fn map<M>(self, mut f: impl FnMut(N) -> M) -> Value<M> {
        match self {
            Value::Vector(v) => Value::Vector(Vec2 { x: f(v.x), y: f(v.y) }),
            Value::Scalar(s) => Value::Scalar(f(s)),
            Value::Point(p) => Value::Point(Point { x: f(p.x), y: f(p.y) }),
        }
    }
}

impl Value {
    /// Length of a vector, absolute value of a number; of a place its distance from the origin.
    pub fn magnitude(&self) -> f64 {
        match self {
            Value::Vector(v) => v.norm(),
            Value::Scalar(s) => s.abs(),
            Value::Point(p) => (*p - Point::origin()).norm(),
        }
    }

    /// Its numbers in a table, as [`Form::columns`] names them.
    pub fn columns(&self) -> Vec<f64> {
        match *self {
            Value::Vector(v) => vec![v.x, v.y, v.norm()],
            Value::Scalar(s) => vec![s],
            Value::Point(p) => vec![p.x, p.y],
        }
    }

    /// The same, or zero where it is no more than `noise`; of a place each coordinate by itself.
    pub fn above(&self, noise: f64) -> Value {
        match *self {
            Value::Point(_) => self.map(|x| if x.abs() > noise { x } else { 0.0 }),
            Value::Vector(_) | Value::Scalar(_) if self.magnitude() > noise => *self,
            Value::Vector(_) | Value::Scalar(_) => self.map(|_| 0.0),
        }
    }

    /// How far two values of one form are apart; `None` where their forms differ.
    pub fn apart(&self, other: &Value) -> Option<f64> {
        match (self, other) {
            (Value::Vector(a), Value::Vector(b)) => Some((*a - *b).norm()),
            (Value::Scalar(a), Value::Scalar(b)) => Some((a - b).abs()),
            (Value::Point(a), Value::Point(b)) => Some((*a - *b).norm()),
            (Value::Vector(_) | Value::Scalar(_) | Value::Point(_), _) => None,
        }
    }
}

/// The part of the largest number of its kind in the mechanism that rounding leaves of a difference.
pub const ROUNDING: f64 = 1e-13;

/// True for a difference that plain numbers do not tell from none, beside what it comes from.
pub(super) fn vanishes<N: Real>(value: N, beside: f64) -> bool {
    !N::refines() && value.approx().abs() <= ROUNDING * beside
}

/// The largest angular velocity that is known, or that of the mechanism's size with the largest velocity: a link that turns by rounding alone
/// does not turn beside it.
pub(super) fn fastest<N: Real, K: Known<N>>(known: &K) -> f64 {
    let turning = (0..known.scene().links.len()).filter_map(|l| known.turning(Level::Velocity, LinkId(l)));
    let omega = turning.map(|omega| omega.approx().abs()).fold(0.0, f64::max);
    let mut places = (0..known.scene().points.len()).filter_map(|p| Some(known.point(PointId(p))?.approx()));
    let size = places.next().map_or(0.0, |first| places.map(|p| p.distance(first)).fold(0.0, f64::max));
    if size > 0.0 { omega.max(largest(known, Level::Velocity) / size) } else { omega }
}

/// The largest velocity or acceleration of a point that is known.
pub(super) fn largest<N: Real, K: Known<N>>(known: &K, level: Level) -> f64 {
    let points = (0..known.scene().points.len()).map(|p| OnLink { point: PointId(p), link: None });
    points.filter_map(|p| known.vector(level, &p)).map(|v| v.norm().approx()).fold(0.0, f64::max)
}

/// What a formula may use: the scene, the places of a pose, and its motion.
pub trait Known<N> {
    /// The scene.
    fn scene(&self) -> &Scene;
    /// The place of a point.
    fn point(&self, p: PointId) -> Option<Point<N>>;
    /// A straight guide in the plane: where its coordinate is zero, and its direction.
    fn guide(&self, g: GuideId) -> Option<(Point<N>, Vec2<N>)>;
    /// The direction from which a link's angle is counted.
    fn direction(&self, link: LinkId) -> Option<Vec2<N>>;
    /// The vector of the point of a link (or of the pin itself).
    fn vector(&self, level: Level, p: &OnLink) -> Option<Vec2<N>>;
    /// The angular velocity or acceleration of a link.
    fn turning(&self, level: Level, link: LinkId) -> Option<N>;
    /// The forces.
    fn forces(&self) -> Option<&Forces<N>>;
}
