//! Pixels of two pictures, and their comparison.

use std::io::Cursor;

use super::Pixels;
use crate::render::png as ours;
use hodograph_base::diag::{Diagnostic, both};

/// The first bytes of a PNG.
pub const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";
/// Largest number of pixels that is read, 120 MB: an A4 page at 600 dpi has 35 million.
const MOST_READ: u64 = 40_000_000;
/// Largest number of pixels that is drawn: above it the resolution is lowered.
const MOST_DRAWN: f64 = 16_000_000.0;
/// Default resolution, at which the thinnest line is wider than a pixel.
pub const DPI: f64 = 200.0;
const INCH_MM: f64 = 25.4;

/// A pixel image, opaque on white.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Raster {
    /// Pixels per row.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
    /// Red, green, blue of each pixel, row by row.
    pub rgb: Vec<u8>,
}

/// Returns the resolution at which pages of these sizes are drawn.
pub fn dpi(sizes_mm: &[[f64; 2]]) -> f64 {
    let area = |[w, h]: &[f64; 2]| (w / INCH_MM) * (h / INCH_MM);
    let most = sizes_mm.iter().map(area).fold(0.0, f64::max);
    DPI.min((MOST_DRAWN / most).sqrt())
}

impl Raster {
    /// Draws a figure's SVG as pixels.
    pub(super) fn of_svg(svg: &str, dpi: f64) -> Result<Raster, Diagnostic> {
        let pixmap = ours::pixels(svg, dpi)?;
        let rgb = pixmap.data().chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
        Ok(Raster { width: pixmap.width(), height: pixmap.height(), rgb })
    }

    /// Reads the pixels of a PNG of any kind.
    pub(super) fn of_png(bytes: &[u8]) -> Result<Raster, Diagnostic> {
        let bad = |e: png::DecodingError| super::refused(both!("the PNG cannot be read: {e}"));
        let mut decoder = png::Decoder::new(Cursor::new(bytes));
        decoder.set_transformations(png::Transformations::normalize_to_color8());
        let mut reader = decoder.read_info().map_err(bad)?;
        let (width, height) = (reader.info().width, reader.info().height);
        if u64::from(width) * u64::from(height) > MOST_READ {
            return Err(super::refused(both!(
                "the PNG has {width} by {height} pixels; at most {} million are compared",
                MOST_READ / 1_000_000
            )));
        }
        let too_large = || super::refused(both!("the PNG is too large"));
        let mut samples = vec![0; reader.output_buffer_size().ok_or_else(too_large)?];
        let info = reader.next_frame(&mut samples).map_err(bad)?;
        let channels = info.color_type.samples();
        let over_white = |c: u8, alpha: u8| {
            ((u32::from(c) * u32::from(alpha) + 255 * (255 - u32::from(alpha)) + 127) / 255) as u8
        };
        let pixel = |p: &[u8]| match *p {
            [grey] => [grey; 3],
            [grey, alpha] => [over_white(grey, alpha); 3],
            [r, g, b] => [r, g, b],
            [r, g, b, alpha, ..] => [r, g, b].map(|c| over_white(c, alpha)),
            [] => [255; 3],
        };
        let rgb = samples[..info.buffer_size()].chunks_exact(channels).flat_map(pixel).collect();
        Ok(Raster { width, height, rgb })
    }

    /// Returns a pixel; white outside the picture.
    pub fn at(&self, x: u32, y: u32) -> [u8; 3] {
        if x >= self.width || y >= self.height {
            return [255; 3];
        }
        let k = 3 * (y as usize * self.width as usize + x as usize);
        [self.rgb[k], self.rgb[k + 1], self.rgb[k + 2]]
    }
}

/// Returns the largest difference of two pixels in a channel.
pub fn apart(a: [u8; 3], b: [u8; 3]) -> u8 {
    (0..3).map(|k| a[k].abs_diff(b[k])).max().unwrap_or(0)
}

/// Counts the pixels that differ by more than `channel`.
pub fn compare(a: &Raster, b: &Raster, channel: u8) -> Pixels {
    let mut out = Pixels { sizes: [[a.width, a.height], [b.width, b.height]], ..Pixels::default() };
    for y in 0..a.height.max(b.height) {
        for x in 0..a.width.max(b.width) {
            let by = apart(a.at(x, y), b.at(x, y));
            if by <= channel {
                continue;
            }
            out.over += 1;
            out.largest = out.largest.max(by);
            let [left, top, right, bottom] = out.bounds.unwrap_or([x, y, x + 1, y + 1]);
            out.bounds = Some([left.min(x), top.min(y), right.max(x + 1), bottom.max(y + 1)]);
        }
    }
    out
}
