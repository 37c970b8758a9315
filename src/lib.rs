//! hodograph solves planar mechanisms the way they are solved at the drawing board.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod analytic;
pub mod answer;
pub mod construct;
pub mod diag;
pub mod figure;
pub mod geom;
pub mod mechanism;
pub mod plan;
pub mod position;
pub mod quantity;
pub mod render;
pub mod report;
pub mod scene;
pub mod trig;
