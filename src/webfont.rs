//! The letters of pages: a subset of Tinos in each, so that words and formulas look alike on every machine and as in the figures.
//!
//! Not decided here: in what they are set where the subset has no sign; each page's style names what follows.

use std::sync::LazyLock;

use crate::paper::font::{PAGE_ITALIC, PAGE_UPRIGHT};
use base64::prelude::{BASE64_STANDARD, Engine};

/// The two faces of the family `Hodograph`, as rules of CSS that carry the fonts; the upright one has the constants by which browsers set formulas.
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
