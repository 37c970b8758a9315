//! The few meanings to which all questions reduce, and their formulas of relative motion.
//!
//! A module with its own way to answer (the drawing, the compiled sweep) matches [`Meaning`], not
//! the families of quantities.

use super::value::{fastest, vanishes};
use super::{AnswerValue, FormulaInputs, Frame, Level, ObservedPart, Place, PointJoint, joined};
use crate::model::{GuidePath, LinkId, OnLink, PointId};
use hodograph_base::number::Real;

/// The meaning of a question; [`Asked::level`](super::Asked::level) is its level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Meaning {
    /// The place of something.
    Place(Place),
    /// The vector of a point, drawn from the pole.
    Vector(OnLink),
    /// A part of the motion of the first point relative to the second.
    Relative(RelativeComponent, OnLink, OnLink),
    /// A part of the motion of a point observed from a frame, without a guide that gives it; the
    /// last field is the centre of the relative path, if it is a circle.
    Seen(ObservedPart, OnLink, Frame, Option<PointId>),
    /// The angular velocity or acceleration of a link; with a second link, relative to it.
    Turning(LinkId, Option<LinkId>),
    /// The ratio of the first link's angular velocity to the second's; with an arm, both relative
    /// to it.
    Ratio([LinkId; 2], Option<LinkId>),
}

/// The parts of the motion of one point relative to another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RelativeComponent {
    /// The whole.
    Whole,
    /// Along the line of the two, with the rotation of that line.
    Along,
    /// Perpendicular to that line.
    Across,
    /// Along the guide or the cylinder.
    Sliding,
    /// The part of an acceleration along a guide that is perpendicular to the guide: v_r²/ρ for an
    /// arc.
    SlidingNormal,
    /// The part of that acceleration along the guide.
    SlidingTangential,
    /// Coriolis acceleration 2 ω × v_r.
    Coriolis,
}

impl Meaning {
    /// Returns the point whose vector from the pole is asked for.
    pub fn vector_of(self) -> Option<OnLink> {
        if let Meaning::Vector(p) = self { Some(p) } else { None }
    }

    /// Returns the link whose turning relative to the ground is asked for.
    pub fn turning_of(self) -> Option<LinkId> {
        if let Meaning::Turning(l, None) = self { Some(l) } else { None }
    }

    /// Returns the value by the formulas of relative motion; `None` if data are unknown, or if no
    /// joint of the two points fits the part.
    pub(super) fn value<N: Real, K: FormulaInputs<N>>(
        self,
        level: Level,
        known: &K,
    ) -> Option<AnswerValue<N>> {
        match self {
            Meaning::Place(place) => place.value(known),
            Meaning::Vector(p) => known.vector(level, &p).map(AnswerValue::Vector),
            Meaning::Relative(split, a, b) => relative(split, level, known, &a, &b),
            Meaning::Seen(seen, of, frame, about) => seen.value(known, &of, frame, about),
            Meaning::Turning(l, None) => known.turning(level, l).map(AnswerValue::Scalar),
            Meaning::Ratio(links, arm) => {
                let of = |l| known.turning(level, l);
                let arm = arm.map_or(Some(N::from_f64(0.0)), of)?;
                ratio([of(links[0])?, of(links[1])?], arm, fastest(known)).map(AnswerValue::Scalar)
            }
            Meaning::Turning(l, Some(against)) => {
                Some(AnswerValue::Scalar(known.turning(level, l)? - known.turning(level, against)?))
            }
        }
    }
}

/// Returns (ω₁ − ω_h)/(ω₂ − ω_h); `None` if the second link does not turn relative to the arm.
/// `fastest` is the largest angular velocity of the mechanism.
pub fn ratio<N: Real>([a, b]: [N; 2], arm: N, fastest: f64) -> Option<N> {
    if vanishes(b - arm, [a, b, arm].map(|w| w.approx().abs()).into_iter().fold(fastest, f64::max))
    {
        return None;
    }
    let ratio = (a - arm) / (b - arm);
    ratio.is_decided().then_some(ratio)
}

fn relative<N: Real, K: FormulaInputs<N>>(
    split: RelativeComponent,
    level: Level,
    known: &K,
    a: &OnLink,
    b: &OnLink,
) -> Option<AnswerValue<N>> {
    use Level::{Acceleration, Position, Velocity};
    let joint = joined(known.scene(), a, b);
    let whole = |level| Some(known.vector(level, a)? - known.vector(level, b)?);
    let line = || Some(known.point(a.point)? - known.point(b.point)?);
    // Along the line of two points: the unit vector, the length, and the velocity of one point
    // relative to the other, along and perpendicular to it.
    let split_velocity = || {
        let (d, v) = (line()?, whole(Velocity)?);
        let u = d.unit()?;
        Some((u, d.norm(), u.dot(v), u.cross(v)))
    };
    let two = N::from_f64(2.0);
    let coriolis = || match joint? {
        PointJoint::Guide(g) => Some(
            whole(Velocity)?.perp()
                * (two * known.turning(Velocity, known.scene().guides[g.0].on)?),
        ),
        // v_r along the line, ω of the line.
        PointJoint::Cylinder(_) => {
            let (u, l, along, across) = split_velocity()?;
            Some(u.perp() * (two * along * across / l))
        }
        PointJoint::Link(_) => None,
    };
    Some(AnswerValue::Vector(match (split, level, joint) {
        (RelativeComponent::Whole, level, _) => whole(level)?,
        (RelativeComponent::Along, _, Some(PointJoint::Link(_))) => {
            let u = line()?.unit()?;
            u * u.dot(whole(Acceleration)?)
        }
        (RelativeComponent::Along, _, Some(PointJoint::Cylinder(_))) => {
            let (u, l, _, across) = split_velocity()?;
            u * -(across * across / l)
        }
        (RelativeComponent::Across, _, Some(PointJoint::Link(_))) => {
            let u = line()?.unit()?.perp();
            u * u.dot(whole(Acceleration)?)
        }
        (RelativeComponent::Across, _, Some(PointJoint::Cylinder(_))) => {
            let u = line()?.unit()?.perp();
            u * u.dot(whole(Acceleration)?) - coriolis()?
        }
        (RelativeComponent::Sliding, Acceleration, Some(PointJoint::Guide(_))) => {
            whole(Acceleration)? - coriolis()?
        }
        (RelativeComponent::Sliding, Acceleration, Some(PointJoint::Cylinder(_))) => {
            let (u, l, _, across) = split_velocity()?;
            u * (u.dot(whole(Acceleration)?) + across * across / l)
        }
        (RelativeComponent::Sliding, Position | Velocity, Some(PointJoint::Guide(_))) => {
            whole(Velocity)?
        }
        (RelativeComponent::Sliding, Position | Velocity, Some(PointJoint::Cylinder(_))) => {
            let (u, _, along, _) = split_velocity()?;
            u * along
        }
        (RelativeComponent::Coriolis, _, _) => coriolis()?,
        (
            RelativeComponent::SlidingNormal | RelativeComponent::SlidingTangential,
            _,
            Some(PointJoint::Guide(g)),
        ) => {
            let whole = whole(Acceleration)? - coriolis()?;
            let tangential = match known.scene().guides[g.0].path {
                GuidePath::Line { .. } => whole,
                GuidePath::Arc { centre, .. } => {
                    let along = (known.point(centre)? - known.point(a.point)?).perp().unit()?;
                    along * along.dot(whole)
                }
            };
            if split == RelativeComponent::SlidingTangential {
                tangential
            } else {
                whole - tangential
            }
        }
        (
            RelativeComponent::SlidingNormal | RelativeComponent::SlidingTangential,
            _,
            Some(PointJoint::Link(_) | PointJoint::Cylinder(_)) | None,
        ) => return None,
        (
            RelativeComponent::Along | RelativeComponent::Across,
            _,
            Some(PointJoint::Guide(_)) | None,
        )
        | (RelativeComponent::Sliding, _, Some(PointJoint::Link(_)) | None) => {
            return None;
        }
    }))
}
