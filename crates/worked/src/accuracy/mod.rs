//! The difference of drawing and analysis, the final positions of a pose, and the accuracy of the
//! drawing on paper.

mod agreement;
mod bad_angle;
mod drafting;
mod larger;
mod near;
mod places;
mod rung;
mod simulate;
mod written;

pub use agreement::{Agreement, ROUNDING, compare};
pub use bad_angle::{BAD_DEG, BadAngle, NearbyPose, OtherPoint, bad_angles};
pub use drafting::{
    CrossingTolerance, DraftedConstruction, Drafting, Tolerance, crossings, drafting,
    relative_tolerances,
};
pub use larger::Larger;
pub use near::{ComparedMethods, KeptDigits, estimated, kept};
pub use places::{settled, settled_finely};
pub use rung::{Climb, Rung};
pub use simulate::{DrawingErrors, simulate};
pub use written::{Regular, groups_of_question, regular};
