//! Ink: numbers, SVG, PNG.
