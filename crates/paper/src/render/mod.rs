//! Output of figures: numbers, SVG, PNG, PDF, TikZ; animations as GIF and SVG;
//! formulas as MathML, TeX and Typst.

use hodograph_base::diag::{Both, Diagnostic};

#[cfg(feature = "png")]
pub mod diff;
pub mod dxf;
#[cfg(feature = "png")]
pub mod gif;
pub mod math;
pub mod moving;
pub mod number;
pub mod pages;
#[cfg(feature = "pdf")]
pub mod pdf;
#[cfg(feature = "png")]
pub mod png;
pub mod svg;
pub mod tikz;

/// Returns the error for a figure that cannot be written because one of its numbers is not finite.
pub fn not_finite(message: Both) -> Diagnostic {
    Diagnostic::error("not-finite", message)
}

/// Escapes a text for markup.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
