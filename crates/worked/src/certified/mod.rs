//! The number of true digits of every answer and of every step of the drawing, and the numbers to
//! print.

mod apart;
pub mod ladder;
#[doc(hidden)]
pub mod printed;
pub mod steps;

pub use ladder::{Certified, certify};
pub use steps::{CertifiedSteps, steps};
