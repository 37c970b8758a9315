//! Web fonts of the HTML pages. Each page carries a subset of Tinos, so that words and formulas
//! look the same on every machine and as in the figures.
//!
//! Fallback fonts for signs that the subset lacks are named by each page's own style sheet.

use std::sync::LazyLock;

use crate::paper::font::{PAGE_ITALIC, PAGE_UPRIGHT};
use base64::prelude::{BASE64_STANDARD, Engine};

/// CSS rules with the two faces of the family `Hodograph`, fonts included. The upright face has the
/// constants by which browsers set formulas.
pub fn faces() -> &'static str {
    static FACES: LazyLock<String> = LazyLock::new(|| {
        let face = |style: &str, font: &[u8]| {
            let font = BASE64_STANDARD.encode(font);
            format!(
                "@font-face {{ font-family: Hodograph; font-style: {style}; src: url(data:font/woff2;base64,{font}) format(\"woff2\") }}\n"
            )
        };
        face("normal", PAGE_UPRIGHT) + &face("italic", PAGE_ITALIC)
    });
    &FACES
}
