//! Disc cams as plane geometry: motion laws, profiles of arcs and lines, and the resulting motion
//! of the follower over a turn.
//!
//! This module computes s(φ) with its first three derivatives ([`law`], [`program`], [`outline`]);
//! the profile by inversion, pressure angle and radius of curvature ([`Disc`]); extremes, undercut
//! and jumps of a whole turn ([`CamSurvey`]). All functions are pure functions of numbers. Other
//! modules decide how a scene writes a cam, which kinematic pairs replace its contact, and which
//! items are drawn.
//!
//! Conventions: lengths in metres, angles in radians, the origin at the centre of the cam. φ is the
//! rotation of the cam from the start of its law, in the cam's own sense. The frame of the cam is
//! that of the ground at φ = 0.

pub mod allowed;
mod contact;
pub mod disc;
pub mod enclosed;
pub mod exact;
pub mod jet;
pub mod law;
pub mod least;
pub mod outline;
pub mod prepared;
pub mod program;
mod round;
pub mod survey;
#[cfg(test)]
mod tests;
mod turn;

pub use allowed::{AllowedPressure, LeastCam, PressureDiagram, PressureWedge};
pub use disc::{Branch, CamMotion, CamStation, Disc, Follower, FollowerTip};
pub use enclosed::CamExtreme;
pub use exact::{ExactCam, ExactDisc};
pub use jet::CamJet;
pub use law::MotionLaw;
pub use least::least_base;
pub use outline::ProfileSegment;
pub use prepared::PreparedDisc;
pub use program::{Jump, Shock, Stage, StageMotion, StageProgram, in_turn_of};
pub use round::{round, stations};
pub use survey::{CamSurvey, Fault, Surveyed};
pub use turn::Peak;

use crate::number::Real;

/// The side of a joint of two pieces from which a value is taken, in the direction of growing φ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PieceSide {
    /// The value as φ approaches the joint from below.
    Before,
    /// The value after the joint.
    After,
}

/// Returns an angle reduced to [0, 2π).
pub fn in_turn(angle: f64) -> f64 {
    let turns = libm::floor(angle / std::f64::consts::TAU);
    let rest = angle - turns * std::f64::consts::TAU;
    if rest >= std::f64::consts::TAU { 0.0 } else { rest.max(0.0) }
}

/// Returns an angle reduced to half a turn on either side of zero.
pub fn in_half_turns<N: Real>(angle: N) -> N {
    angle - whole_turns(libm::rint(angle.approx() / std::f64::consts::TAU))
}

/// Returns the angle of `turns` whole turns (rad).
pub fn whole_turns<N: Real>(turns: f64) -> N {
    if turns == 0.0 { N::from_f64(0.0) } else { (N::pi() + N::pi()) * N::from_f64(turns) }
}
