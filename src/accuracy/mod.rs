//! How far drawing and analysis are apart.

mod agreement;

pub use agreement::{Agreement, ROUNDING, compare};
