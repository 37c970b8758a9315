//! hodograph solves planar mechanisms the way they are solved at the drawing board.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod diag;
pub mod figure;
pub mod geom;
pub mod render;
pub mod report;
pub mod scene;
pub mod trig;
