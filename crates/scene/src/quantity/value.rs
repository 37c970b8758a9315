//! The value of an answer, and the data that its formula may use.

use super::{Forces, Level, ValueForm};
use crate::model::{GuideId, LinkId, OnLink, PointId, Scene};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;

/// The value of an answer, in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnswerValue<N = f64> {
    /// A vector.
    Vector(Vec2<N>),
    /// A number (ω, α, an angle, a distance); positive counter-clockwise.
    Scalar(N),
    /// A place in the plane (m).
    Point(Point<N>),
}

impl<N: Real> AnswerValue<N> {
    /// Returns its form.
    pub fn form(&self) -> ValueForm {
        match self {
            AnswerValue::Vector(_) => ValueForm::Vector,
            AnswerValue::Scalar(_) => ValueForm::Scalar,
            AnswerValue::Point(_) => ValueForm::Point,
        }
    }

    /// Returns its numbers: one for a scalar; the components of a vector, the coordinates of a
    /// place.
    pub fn numbers(&self) -> (N, Option<N>) {
        match *self {
            AnswerValue::Vector(v) => (v.x, Some(v.y)),
            AnswerValue::Scalar(s) => (s, None),
            AnswerValue::Point(p) => (p.x, Some(p.y)),
        }
    }

    /// Applies `f` to each number; the form remains.
    pub fn map<M>(self, mut f: impl FnMut(N) -> M) -> AnswerValue<M> {
        match self {
            AnswerValue::Vector(v) => AnswerValue::Vector(Vec2 { x: f(v.x), y: f(v.y) }),
            AnswerValue::Scalar(s) => AnswerValue::Scalar(f(s)),
            AnswerValue::Point(p) => AnswerValue::Point(Point { x: f(p.x), y: f(p.y) }),
        }
    }
}

impl AnswerValue {
    /// Returns the magnitude of a vector, the absolute value of a number, or the distance of a
    /// place from the origin.
    pub fn magnitude(&self) -> f64 {
        match self {
            AnswerValue::Vector(v) => v.norm(),
            AnswerValue::Scalar(s) => s.abs(),
            AnswerValue::Point(p) => (*p - Point::origin()).norm(),
        }
    }

    /// Returns its numbers in a table, as [`ValueForm::columns`] names them.
    pub fn columns(&self) -> Vec<f64> {
        match *self {
            AnswerValue::Vector(v) => vec![v.x, v.y, v.norm()],
            AnswerValue::Scalar(s) => vec![s],
            AnswerValue::Point(p) => vec![p.x, p.y],
        }
    }

    /// Returns the value, or zero if it is at most `noise`; for a place, each coordinate
    /// separately.
    pub fn above(&self, noise: f64) -> AnswerValue {
        match *self {
            AnswerValue::Point(_) => self.map(|x| if x.abs() > noise { x } else { 0.0 }),
            AnswerValue::Vector(_) | AnswerValue::Scalar(_) if self.magnitude() > noise => *self,
            AnswerValue::Vector(_) | AnswerValue::Scalar(_) => self.map(|_| 0.0),
        }
    }

    /// Returns the distance of two values of one form; `None` if their forms differ.
    pub fn apart(&self, other: &AnswerValue) -> Option<f64> {
        match (self, other) {
            (AnswerValue::Vector(a), AnswerValue::Vector(b)) => Some((*a - *b).norm()),
            (AnswerValue::Scalar(a), AnswerValue::Scalar(b)) => Some((a - b).abs()),
            (AnswerValue::Point(a), AnswerValue::Point(b)) => Some((*a - *b).norm()),
            (AnswerValue::Vector(_) | AnswerValue::Scalar(_) | AnswerValue::Point(_), _) => None,
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
pub(super) fn fastest<N: Real, K: FormulaInputs<N>>(known: &K) -> f64 {
    let turning =
        (0..known.scene().links.len()).filter_map(|l| known.turning(Level::Velocity, LinkId(l)));
    let omega = turning.map(|omega| omega.approx().abs()).fold(0.0, f64::max);
    let mut places =
        (0..known.scene().points.len()).filter_map(|p| Some(known.point(PointId(p))?.approx()));
    let size =
        places.next().map_or(0.0, |first| places.map(|p| p.distance(first)).fold(0.0, f64::max));
    if size > 0.0 { omega.max(largest(known, Level::Velocity) / size) } else { omega }
}

/// Returns the largest known velocity or acceleration of a point.
pub(super) fn largest<N: Real, K: FormulaInputs<N>>(known: &K, level: Level) -> f64 {
    let points = (0..known.scene().points.len()).map(|p| OnLink { point: PointId(p), link: None });
    points.filter_map(|p| known.vector(level, &p)).map(|v| v.norm().approx()).fold(0.0, f64::max)
}

/// The data that a formula may use: the scene, the places of a pose, and its motion.
pub trait FormulaInputs<N> {
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
