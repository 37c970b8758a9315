//! What a question means, whichever way its vectors were found: the definitions that drawing and analysis are both held to.
//!
//! A [`Source`] gives vectors of points and turning rates; [`evaluate`] combines them as the question says. Nothing is
//! solved here.

use crate::geom::Vec2;
use crate::mechanism::Level;
use crate::number::Real;
use crate::position::Configuration;
use crate::scene::{Asked, Axis, GuideId, LinkId, OnLink, PointId, Scene};

/// The value of an answer, in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value<N = f64> {
    /// A vector.
    Vector(Vec2<N>),
    /// A number (ω, α, an angle, a distance); counter-clockwise plus.
    Scalar(N),
}

impl Value {
    /// Length of a vector, absolute value of a number.
    pub fn magnitude(&self) -> f64 {
        match self {
            Value::Vector(v) => v.norm(),
            Value::Scalar(s) => s.abs(),
        }
    }
}

/// Where both ways of solving look a question up: the drawing in its polygons, the analysis in its solution.
pub trait Source<N = f64> {
    /// Vector of the point of a link (or of the pin itself).
    fn vector(&self, level: Level, p: PointId, on: Option<LinkId>) -> Option<Vec2<N>>;
    /// Turning rate.
    fn turning(&self, level: Level, link: LinkId) -> Option<N>;
}

/// The level of a question.
pub fn level_of(what: &Asked) -> Level {
    match what {
        Asked::Coordinate(..) | Asked::LinkAngle(_) | Asked::Distance(..) => Level::Position,
        Asked::Velocity(_) | Asked::RelativeVelocity(..) | Asked::SlidingVelocity(..) | Asked::Omega(_) | Asked::RelativeOmega(..) => {
            Level::Velocity
        }
        _ => Level::Acceleration,
    }
}

/// Evaluates a question on any source of vectors and rates.
pub fn evaluate<N: Real>(scene: &Scene, at: &Configuration<N>, source: &impl Source<N>, what: &Asked) -> Option<Value<N>> {
    use Level::{Acceleration, Velocity};
    let vector = |level, p: &OnLink| source.vector(level, p.point, p.link);
    let relative = |level, a: &OnLink, b: &OnLink| Some(vector(level, a)? - vector(level, b)?);
    let line = |a: &OnLink, b: &OnLink| (at.points[a.point.0]? - at.points[b.point.0]?).unit();
    Some(match what {
        Asked::Coordinate(p, Axis::X) => Value::Scalar(at.points[p.0]?.x),
        Asked::Coordinate(p, Axis::Y) => Value::Scalar(at.points[p.0]?.y),
        Asked::LinkAngle(l) => Value::Scalar(at.link_direction(scene, *l).or_else(|| at.poses[l.0].map(|p| p.axis))?.angle()),
        Asked::Distance(a, b) => Value::Scalar(at.points[a.0]?.distance(at.points[b.0]?)),
        Asked::Velocity(p) => Value::Vector(vector(Velocity, p)?),
        Asked::Acceleration(p) => Value::Vector(vector(Acceleration, p)?),
        Asked::RelativeVelocity(a, b) | Asked::SlidingVelocity(a, b) => Value::Vector(relative(Velocity, a, b)?),
        Asked::RelativeAcceleration(a, b) => Value::Vector(relative(Acceleration, a, b)?),
        Asked::NormalAcceleration(a, b) => {
            let u = line(a, b)?;
            Value::Vector(u * u.dot(relative(Acceleration, a, b)?))
        }
        Asked::TangentialAcceleration(a, b) => {
            let u = line(a, b)?.perp();
            Value::Vector(u * u.dot(relative(Acceleration, a, b)?))
        }
        Asked::Coriolis(a, b) => Value::Vector(coriolis(scene, source, a, b)?),
        Asked::SlidingAcceleration(a, b) => Value::Vector(relative(Acceleration, a, b)? - coriolis(scene, source, a, b)?),
        Asked::Omega(l) => Value::Scalar(source.turning(Velocity, *l)?),
        Asked::Alpha(l) => Value::Scalar(source.turning(Acceleration, *l)?),
        Asked::RelativeOmega(a, b) => Value::Scalar(source.turning(Velocity, *a)? - source.turning(Velocity, *b)?),
        Asked::RelativeAlpha(a, b) => Value::Scalar(source.turning(Acceleration, *a)? - source.turning(Acceleration, *b)?),
    })
}

/// 2 ω × v_r, ω that of the link that carries the guide between the two points.
fn coriolis<N: Real>(scene: &Scene, source: &impl Source<N>, a: &OnLink, b: &OnLink) -> Option<Vec2<N>> {
    let v = source.vector(Level::Velocity, a.point, a.link)? - source.vector(Level::Velocity, b.point, b.link)?;
    let carrier = guide_between(scene, a, b).map(|g| scene.guides[g.0].on).or(b.link)?;
    Some(v.perp() * (N::from_f64(2.0) * source.turning(Level::Velocity, carrier)?))
}

/// The guide along which one of two coincident points slides against the other.
pub fn guide_between(scene: &Scene, a: &OnLink, b: &OnLink) -> Option<GuideId> {
    let joins = |g: &crate::scene::Guide| {
        let here = g.pin.is_none() || g.pin == Some(a.point) || g.pin == Some(b.point);
        here && (Some(g.on) == a.link || Some(g.on) == b.link)
    };
    scene.guides.iter().position(joins).map(GuideId)
}
