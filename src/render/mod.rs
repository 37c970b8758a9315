//! Ink: numbers, SVG, PNG, PDF.

pub mod number;
pub mod pdf;
pub mod png;
pub mod svg;

/// A text as it stands in markup.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
