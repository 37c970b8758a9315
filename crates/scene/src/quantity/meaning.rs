//! The few meanings that all questions reduce to, and the formulas of relative motion that belong to them.
//!
//! A room that answers by a way of its own (the drawing, the compiled sweep) matches [`Meaning`], not the families of quantities.

use super::value::{fastest, vanishes};
use super::{Frame, Joined, Known, Level, Place, Seen, Value, joined};
use crate::model::{GuidePath, LinkId, OnLink, PointId};
use hodograph_base::number::Real;

/// What a question comes down to; its level is told by [`Asked::level`](super::Asked::level).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Meaning {
    /// Where something is.
    Place(Place),
    /// The vector of a point, from the pole.
    Vector(OnLink),
    /// A part of the motion of the first point against the second.
    Relative(Split, OnLink, OnLink),
    /// A part of the motion of a point seen from a frame that no guide shows; the centre of the relative path, where it is a circle.
    Seen(Seen, OnLink, Frame, Option<PointId>),
    /// The angular velocity or acceleration of a link; with a second one, against that.
    Turning(LinkId, Option<LinkId>),
    /// The angular velocity of the first link over that of the second; with an arm, both against it.
    Ratio([LinkId; 2], Option<LinkId>),
}

/// The parts of the motion of one point against another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Split {
    /// All of it.
    Whole,
    /// Along the line of the two, as they turn with it.
    Along,
    /// Square to that line.
    Across,
    /// Along the guide or the cylinder.
    Sliding,
    /// Of an acceleration along a guide, what is square to the guide: v_r²/ρ of an arc.
    SlidingNormal,
    /// And what is along it.
    SlidingTangential,
    /// 2 ω × v_r.
    Coriolis,
}

impl Meaning {
    /// The value by the formulas of relative motion; `None` where something is not known, or nothing joins two points as the part demands.
    pub(super) fn value<N: Real, K: Known<N>>(self, level: Level, known: &K) -> Option<Value<N>> {
        match self {
            Meaning::Place(place) => place.value(known),
            Meaning::Vector(p) => known.vector(level, &p).map(Value::Vector),
            Meaning::Relative(split, a, b) => relative(split, level, known, &a, &b),
            Meaning::Seen(seen, of, frame, about) => seen.value(known, &of, frame, about),
            Meaning::Turning(l, None) => known.turning(level, l).map(Value::Scalar),
            Meaning::Ratio(links, arm) => {
                let of = |l| known.turning(level, l);
                let arm = arm.map_or(Some(N::from_f64(0.0)), of)?;
                ratio([of(links[0])?, of(links[1])?], arm, fastest(known)).map(Value::Scalar)
            }
            Meaning::Turning(l, Some(against)) => Some(Value::Scalar(known.turning(level, l)? - known.turning(level, against)?)),
        }
    }
}

/// (ω₁ − ω_h)/(ω₂ − ω_h); `None` where the second does not turn against the arm. `fastest` is the largest angular velocity of the mechanism.
pub fn ratio<N: Real>([a, b]: [N; 2], arm: N, fastest: f64) -> Option<N> {
    if vanishes(b - arm, [a, b, arm].map(|w| w.approx().abs()).into_iter().fold(fastest, f64::max)) {
        return None;
    }
    let ratio = (a - arm) / (b - arm);
    ratio.is_decided().then_some(ratio)
}

fn relative<N: Real, K: Known<N>>(split: Split, level: Level, known: &K, a: &OnLink, b: &OnLink) -> Option<Value<N>> {
    use Level::{Acceleration, Position, Velocity};
    let joint = joined(known.scene(), a, b);
    let whole = |level| Some(known.vector(level, a)? - known.vector(level, b)?);
    let line = || Some(known.point(a.point)? - known.point(b.point)?);
    // Along the line of two points: the unit vector, the length, and the velocity of the one against the other, along and square to it.
    let split_velocity = || {
        let (d, v) = (line()?, whole(Velocity)?);
        let u = d.unit()?;
        Some((u, d.norm(), u.dot(v), u.cross(v)))
    };
    let two = N::from_f64(2.0);
    let coriolis = || match joint? {
        Joined::Guide(g) => Some(whole(Velocity)?.perp() * (two * known.turning(Velocity, known.scene().guides[g.0].on)?)),
        // v_r along the line, ω that of the line.
        Joined::Cylinder(_) => {
            let (u, l, along, across) = split_velocity()?;
            Some(u.perp() * (two * along * across / l))
        }
        Joined::Link(_) => None,
    };
    Some(Value::Vector(match (split, level, joint) {
        (Split::Whole, level, _) => whole(level)?,
        (Split::Along, _, Some(Joined::Link(_))) => {
            let u = line()?.unit()?;
            u * u.dot(whole(Acceleration)?)
        }
        (Split::Along, _, Some(Joined::Cylinder(_))) => {
            let (u, l, _, across) = split_velocity()?;
            u * -(across * across / l)
        }
        (Split::Across, _, Some(Joined::Link(_))) => {
            let u = line()?.unit()?.perp();
            u * u.dot(whole(Acceleration)?)
        }
        (Split::Across, _, Some(Joined::Cylinder(_))) => {
            let u = line()?.unit()?.perp();
            u * u.dot(whole(Acceleration)?) - coriolis()?
        }
        (Split::Sliding, Acceleration, Some(Joined::Guide(_))) => whole(Acceleration)? - coriolis()?,
        (Split::Sliding, Acceleration, Some(Joined::Cylinder(_))) => {
            let (u, l, _, across) = split_velocity()?;
            u * (u.dot(whole(Acceleration)?) + across * across / l)
        }
        (Split::Sliding, Position | Velocity, Some(Joined::Guide(_))) => whole(Velocity)?,
        (Split::Sliding, Position | Velocity, Some(Joined::Cylinder(_))) => {
            let (u, _, along, _) = split_velocity()?;
            u * along
        }
        (Split::Coriolis, _, _) => coriolis()?,
        (Split::SlidingNormal | Split::SlidingTangential, _, Some(Joined::Guide(g))) => {
            let whole = whole(Acceleration)? - coriolis()?;
            let tangential = match known.scene().guides[g.0].path {
                GuidePath::Line { .. } => whole,
                GuidePath::Arc { centre, .. } => {
                    let along = (known.point(centre)? - known.point(a.point)?).perp().unit()?;
                    along * along.dot(whole)
                }
            };
            if split == Split::SlidingTangential { tangential } else { whole - tangential }
        }
        (Split::SlidingNormal | Split::SlidingTangential, _, Some(Joined::Link(_) | Joined::Cylinder(_)) | None) => return None,
        (Split::Along | Split::Across, _, Some(Joined::Guide(_)) | None) | (Split::Sliding, _, Some(Joined::Link(_)) | None) => {
            return None;
        }
    }))
}
