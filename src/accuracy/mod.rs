//! How far drawing and analysis are apart, and how many digits of an answer are true.

mod agreement;
pub mod ladder;

pub use agreement::{Agreement, compare};
pub use ladder::{Certified, certify};
