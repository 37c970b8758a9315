//! Ink: numbers, SVG, PNG, PDF; moving pictures as GIF and SVG.

use hodograph_base::diag::{Both, Diagnostic};

#[cfg(feature = "png")]
pub mod diff;
pub mod dxf;
#[cfg(feature = "png")]
pub mod gif;
pub mod moving;
pub mod number;
pub mod pages;
#[cfg(feature = "pdf")]
pub mod pdf;
#[cfg(feature = "png")]
pub mod png;
pub mod svg;

/// A figure that cannot be written, because a number of it is none.
pub fn not_finite(message: Both) -> Diagnostic {
    Diagnostic::error("not-finite", message)
}

/// A text as it stands in markup.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
