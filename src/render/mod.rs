//! Ink: numbers, SVG, PNG.

pub mod number;
pub mod png;
pub mod svg;
