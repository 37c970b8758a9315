//! Ink: numbers, SVG, PNG, PDF.

pub mod number;
pub mod pdf;
pub mod png;
pub mod svg;
