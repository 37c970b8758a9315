//! Draws two figures over each other: ink of the old one only in red, of the new one only in blue,
//! common ink in grey.

use resvg::tiny_skia;

use super::raster::{DPI, apart};
use super::{Options, Picture, rasters};
use crate::render::png::encode;
use hodograph_base::diag::{Diagnostic, both};

/// Darkness of the common ink: enough for orientation, and less than that of differences.
const COMMON: f64 = 0.35;
/// Colour of ink that differs in colour but not in brightness.
const RECOLOURED: [u8; 3] = [230, 140, 0];

/// Returns the picture as a PNG.
///
/// # Errors
/// As [`super::compare()`].
pub fn picture(old: &Picture, new: &Picture, options: &Options) -> Result<Vec<u8>, Diagnostic> {
    let ([a, b], _) = rasters(old, new)?;
    let (width, height) = (a.width.max(b.width), a.height.max(b.height));
    let failed =
        |why: String| Diagnostic::error("png-size", both!("the picture cannot be made: {why}"));
    let mut pixmap = tiny_skia::Pixmap::new(width, height)
        .ok_or_else(|| failed(format!("{width} × {height}")))?;
    let papers = [&a, &b].map(|r| brightness(r.at(0, 0)));
    for (k, out) in pixmap.data_mut().chunks_exact_mut(4).enumerate() {
        let (x, y) = ((k % width as usize) as u32, (k / width as usize) as u32);
        let [r, g, b] = mixed([a.at(x, y), b.at(x, y)], papers, options.channel);
        out.copy_from_slice(&[r, g, b, 255]);
    }
    encode(&pixmap, DPI).map_err(|e| failed(e.to_string()))
}

/// Mixes two pixels. Ink is the difference from the paper, light or dark.
fn mixed(pixels: [[u8; 3]; 2], papers: [f64; 2], channel: u8) -> [u8; 3] {
    let ink = |k: usize| (brightness(pixels[k]) - papers[k]).abs().min(255.0);
    let (old, new) = (ink(0), ink(1));
    let common = old.min(new);
    let (old, new) = (old - common, new - common);
    if apart(pixels[0], pixels[1]) > channel && old.max(new) < 1.0 {
        return RECOLOURED;
    }
    let base = 255.0 - COMMON * common;
    [base - new, base - old - 0.5 * new, base - old].map(|c| c.clamp(0.0, 255.0) as u8)
}

fn brightness([r, g, b]: [u8; 3]) -> f64 {
    0.299 * f64::from(r) + 0.587 * f64::from(g) + 0.114 * f64::from(b)
}
