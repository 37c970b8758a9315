//! How far drawing and analysis are apart, and what the drawing would be worth on paper.

mod agreement;
mod bad_angle;
mod drafting;
mod larger;
mod simulate;

pub use agreement::{Agreement, compare};
pub use bad_angle::{BAD_DEG, BadAngle, NearbyPose, OtherPoint, bad_angles};
pub use drafting::{CrossingTolerance, Drafting, Drawn, Tolerance, crossings, drafting};
pub use larger::Larger;
pub use simulate::{Errors, simulate};
