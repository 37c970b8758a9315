//! Motion observed from a frame if no guide gives its parts: a_r = a − a_e − 2 ω_e × v_r, along and
//! perpendicular to the relative path.

use super::value::{largest, vanishes};
use super::{AnswerValue, FormulaInputs, Frame, Level};
use crate::model::{OnLink, PointId};
use hodograph_base::geom::Vec2;
use hodograph_base::number::Real;

/// A part of the motion of a point observed from a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObservedPart {
    /// The relative acceleration a_r.
    Relative,
    /// a_rⁿ: perpendicular to the relative path.
    RelativeNormal,
    /// a_rᵗ: along it.
    RelativeTangential,
    /// a_k = 2 ω_e × v_r.
    Coriolis,
    /// a_eⁿ: perpendicular to the path of the transport point.
    TransportNormal,
    /// a_eᵗ: along it.
    TransportTangential,
}

impl ObservedPart {
    /// Returns the value by the formulas; `about` is the centre of the relative path, if it is a
    /// circle.
    pub(super) fn value<N: Real, K: FormulaInputs<N>>(
        self,
        known: &K,
        of: &OnLink,
        frame: Frame,
        about: Option<PointId>,
    ) -> Option<AnswerValue<N>> {
        use Level::{Acceleration, Velocity};
        let seat = frame.transport_point(*of);
        let relative = |level| Some(known.vector(level, of)? - known.vector(level, &seat)?);
        let coriolis = || {
            Some(match frame {
                Frame::Link(l) => {
                    relative(Velocity)?.perp() * (N::from_f64(2.0) * known.turning(Velocity, l)?)
                }
                Frame::Point(_) => Vec2 { x: N::from_f64(0.0), y: N::from_f64(0.0) },
            })
        };
        let fastest = || largest(known, Velocity);
        // Unit vector along the relative path.
        let along = || {
            Some(match about {
                Some(k) => (known.point(k)? - known.point(of.point)?).perp().unit(),
                None => heading(relative(Velocity)?, fastest()),
            })
        };
        let seen = || Some(relative(Acceleration)? - coriolis()?);
        let transport = || {
            Some((
                heading(known.vector(Velocity, &seat)?, fastest()),
                known.vector(Acceleration, &seat)?,
            ))
        };
        let [tangential, normal] = match self {
            ObservedPart::Relative => return seen().map(AnswerValue::Vector),
            ObservedPart::Coriolis => return coriolis().map(AnswerValue::Vector),
            ObservedPart::RelativeNormal | ObservedPart::RelativeTangential => {
                split(along()?, seen()?)
            }
            ObservedPart::TransportNormal | ObservedPart::TransportTangential => {
                let (along, whole) = transport()?;
                split(along, whole)
            }
        };
        Some(AnswerValue::Vector(match self {
            ObservedPart::RelativeTangential | ObservedPart::TransportTangential => tangential,
            ObservedPart::RelativeNormal
            | ObservedPart::TransportNormal
            | ObservedPart::Relative
            | ObservedPart::Coriolis => normal,
        }))
    }
}

/// Returns the direction of a velocity; `None` if its magnitude is within rounding errors relative
/// to `fastest`, the largest velocity of the mechanism.
pub fn heading<N: Real>(velocity: Vec2<N>, fastest: f64) -> Option<Vec2<N>> {
    if vanishes(velocity.norm(), fastest) { None } else { velocity.unit() }
}

/// Returns the parts of an acceleration along a unit vector and perpendicular to it. A point
/// momentarily at rest has no normal part: v²/ρ = 0.
pub fn split<N: Real>(along: Option<Vec2<N>>, whole: Vec2<N>) -> [Vec2<N>; 2] {
    let tangential = along.map_or(whole, |u| u * u.dot(whole));
    [tangential, whole - tangential]
}
