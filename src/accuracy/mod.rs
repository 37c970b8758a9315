//! How far drawing and analysis are apart, how many digits of an answer are true, and what the drawing is worth on paper.

mod agreement;
mod apart;
mod bad_angle;
mod drafting;
pub mod ladder;
mod larger;
mod near;
mod places;
pub(crate) mod printed;
mod simulate;
pub mod steps;
pub mod toggle;
pub mod truth;
pub mod ways;
mod written;

pub use agreement::{Agreement, ROUNDING, compare};
pub use bad_angle::{BAD_DEG, BadAngle, NearbyPose, OtherPoint, bad_angles};
pub use drafting::{CrossingTolerance, Drafting, Drawn, Tolerance, crossings, drafting};
pub use ladder::{Certified, certify};
pub use larger::Larger;
pub use near::{Kept, Ways, estimated, kept};
pub use places::{settled, settled_finely};
pub use simulate::{Errors, simulate};
pub use steps::{Steps, steps};
pub use written::{Regular, groups_of_question, regular};
