//! What a question means where vectors of points and turning rates are given: the formulas of relative motion.
//!
//! A [`Source`] gives vectors and rates; [`evaluate`] combines them as the question says. The drawing does not use it (it reads edges,
//! [`crate::construct::read`]), nor does the analysis ([`crate::analytic::Solution::answer`] takes the parts of a relative motion from rows
//! of its own), so that a wrong definition shows as a disagreement.

use crate::geom::Vec2;
pub use crate::mechanism::level_of;
use crate::mechanism::{Joined, Level, joined};
use crate::number::Real;
use crate::position::Configuration;
use crate::scene::{Asked, Axis, LinkId, OnLink, PointId, Scene};

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

/// Where vectors and rates are looked up.
pub trait Source<N = f64> {
    /// Vector of the point of a link (or of the pin itself).
    fn vector(&self, level: Level, p: PointId, on: Option<LinkId>) -> Option<Vec2<N>>;
    /// Turning rate.
    fn turning(&self, level: Level, link: LinkId) -> Option<N>;
}

/// The value of a question of places; `None` for a question of motion, and where a place is not known.
pub fn place<N: Real>(scene: &Scene, at: &Configuration<N>, what: &Asked) -> Option<Value<N>> {
    Some(Value::Scalar(match what {
        Asked::Coordinate(p, Axis::X) => at.points[p.0]?.x,
        Asked::Coordinate(p, Axis::Y) => at.points[p.0]?.y,
        Asked::LinkAngle(l) => at.link_direction(scene, *l).or_else(|| at.poses[l.0].map(|p| p.axis))?.angle(),
        Asked::Distance(a, b) => at.points[a.0]?.distance(at.points[b.0]?),
        Asked::Velocity(_)
        | Asked::Acceleration(_)
        | Asked::RelativeVelocity(..)
        | Asked::RelativeAcceleration(..)
        | Asked::NormalAcceleration(..)
        | Asked::TangentialAcceleration(..)
        | Asked::SlidingVelocity(..)
        | Asked::SlidingAcceleration(..)
        | Asked::Coriolis(..)
        | Asked::Omega(_)
        | Asked::Alpha(_)
        | Asked::RelativeOmega(..)
        | Asked::RelativeAlpha(..) => return None,
    }))
}

/// Evaluates a question on a source of vectors and rates by the formulas of relative motion: what the group-by-group solution means by it.
pub fn evaluate<N: Real>(scene: &Scene, at: &Configuration<N>, source: &impl Source<N>, what: &Asked) -> Option<Value<N>> {
    use Level::{Acceleration, Velocity};
    let vector = |level, p: &OnLink| source.vector(level, p.point, p.link);
    let relative = |level, a: &OnLink, b: &OnLink| Some(vector(level, a)? - vector(level, b)?);
    let two = N::from_f64(2.0);
    // The line of two points, as the unit vector along it, its length, and the velocity of the one against the other.
    let line = |a: &OnLink, b: &OnLink| {
        let d = at.points[a.point.0]? - at.points[b.point.0]?;
        Some((d.unit()?, d.norm(), relative(Velocity, a, b)?))
    };
    let coriolis = |a: &OnLink, b: &OnLink| match joined(scene, a, b)? {
        Joined::Guide(g) => Some(relative(Velocity, a, b)?.perp() * (two * source.turning(Velocity, scene.guides[g.0].on)?)),
        // v_r along the line, ω that of the line.
        Joined::Cylinder(_) => {
            let (u, l, v) = line(a, b)?;
            Some(u.perp() * (two * u.dot(v) * u.cross(v) / l))
        }
        Joined::Link(_) => None,
    };
    Some(match what {
        Asked::Coordinate(..) | Asked::LinkAngle(_) | Asked::Distance(..) => return place(scene, at, what),
        Asked::Velocity(p) => Value::Vector(vector(Velocity, p)?),
        Asked::Acceleration(p) => Value::Vector(vector(Acceleration, p)?),
        Asked::RelativeVelocity(a, b) => Value::Vector(relative(Velocity, a, b)?),
        Asked::RelativeAcceleration(a, b) => Value::Vector(relative(Acceleration, a, b)?),
        Asked::NormalAcceleration(a, b) => match joined(scene, a, b)? {
            Joined::Link(_) => {
                let u = (at.points[a.point.0]? - at.points[b.point.0]?).unit()?;
                Value::Vector(u * u.dot(relative(Acceleration, a, b)?))
            }
            Joined::Cylinder(_) => {
                let (u, l, v) = line(a, b)?;
                let across = u.cross(v);
                Value::Vector(u * -(across * across / l))
            }
            Joined::Guide(_) => return None,
        },
        Asked::TangentialAcceleration(a, b) => match joined(scene, a, b)? {
            Joined::Link(_) => {
                let u = (at.points[a.point.0]? - at.points[b.point.0]?).unit()?.perp();
                Value::Vector(u * u.dot(relative(Acceleration, a, b)?))
            }
            Joined::Cylinder(_) => {
                let u = (at.points[a.point.0]? - at.points[b.point.0]?).unit()?.perp();
                Value::Vector(u * u.dot(relative(Acceleration, a, b)?) - coriolis(a, b)?)
            }
            Joined::Guide(_) => return None,
        },
        Asked::SlidingVelocity(a, b) => match joined(scene, a, b)? {
            Joined::Guide(_) => Value::Vector(relative(Velocity, a, b)?),
            Joined::Cylinder(_) => {
                let (u, _, v) = line(a, b)?;
                Value::Vector(u * u.dot(v))
            }
            Joined::Link(_) => return None,
        },
        Asked::Coriolis(a, b) => Value::Vector(coriolis(a, b)?),
        Asked::SlidingAcceleration(a, b) => match joined(scene, a, b)? {
            Joined::Guide(_) => Value::Vector(relative(Acceleration, a, b)? - coriolis(a, b)?),
            Joined::Cylinder(_) => {
                let (u, l, v) = line(a, b)?;
                let across = u.cross(v);
                Value::Vector(u * (u.dot(relative(Acceleration, a, b)?) + across * across / l))
            }
            Joined::Link(_) => return None,
        },
        Asked::Omega(l) => Value::Scalar(source.turning(Velocity, *l)?),
        Asked::Alpha(l) => Value::Scalar(source.turning(Acceleration, *l)?),
        Asked::RelativeOmega(a, b) => Value::Scalar(source.turning(Velocity, *a)? - source.turning(Velocity, *b)?),
        Asked::RelativeAlpha(a, b) => Value::Scalar(source.turning(Acceleration, *a)? - source.turning(Acceleration, *b)?),
    })
}
