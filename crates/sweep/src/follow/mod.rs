//! Follows mechanisms: each position is found from the one before it, so that no pose jumps to
//! another assembly.
//!
//! - [`poses`]: all poses of the travel of one driver, to the full turn or to the limits.
//! - `triad`: a class III group inside a program, by predictor and corrector; `compiled`: all such
//!   groups through a table's positions.
//! - `step`: the predicted pose, and the limit that distinguishes a step from a jump.
//! - `whole`: a mechanism that has no program, by Newton's method; `extremes`: the range, extremes
//!   and periods of its motion.
//! - [`clock`]: all drivers through time, by their laws.
//! - [`course`]: cams of several pieces with followers that move with other links.
//! - `chains`: states that do not depend on the part of a table that is computed.

pub(super) mod chains;
pub mod clock;
pub(super) mod compiled;
pub mod course;
pub(super) mod extremes;
pub mod poses;
mod step;
pub mod triad;
pub(super) mod whole;

pub use poses::{PoseFollower, PoseSweep, between};
pub use step::TravelPose;
