//! How many digits are true: of every answer, of every step of the drawing, and what is printed with them.

mod apart;
pub mod ladder;
#[doc(hidden)]
pub mod printed;
pub mod steps;

pub use ladder::{Certified, certify};
pub use steps::{Steps, steps};
