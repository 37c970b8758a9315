//! How far drawing and analysis are apart, and how many digits of an answer are true.

mod agreement;
pub mod ladder;
pub mod toggle;
pub mod truth;

pub use agreement::{Agreement, compare};
pub use ladder::{Certified, certify};
