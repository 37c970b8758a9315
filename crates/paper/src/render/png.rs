//! Converts SVG to PNG, on white paper, with the same bytes on every run.

use resvg::{tiny_skia, usvg};

use hodograph_base::diag::{Diagnostic, both};

/// Millimetres per inch.
const INCH_MM: f64 = 25.4;
/// CSS pixels per inch: the unit of a document in usvg.
const CSS_DPI: f64 = 96.0;
/// Largest side in pixels: an A4 sheet at 1200 dpi has 14 031. At 4 bytes each, 16 384² is 1 GiB.
const SIDE_MAX: f64 = 16384.0;

/// Draws an SVG document (from [`super::svg::write`]) at `dpi` pixels per inch.
///
/// The PNG has 8-bit grey if every pixel is grey, 8-bit RGB otherwise; it records the resolution,
/// so that a printed page has its size in millimetres.
///
/// # Errors
///
/// `png-size` if `dpi` gives no picture or one with a side above 16 384 pixels, `png-svg` if the
/// document cannot be read.
pub fn render(svg: &str, dpi: f64) -> Result<Vec<u8>, Diagnostic> {
    let pixmap = pixels(svg, dpi)?;
    encode(&pixmap, dpi)
        .map_err(|e| Diagnostic::error("png-size", both!("the picture cannot be encoded: {e}")))
}

/// Returns the pixels of a document on white paper, all of them opaque.
pub(super) fn pixels(svg: &str, dpi: f64) -> Result<tiny_skia::Pixmap, Diagnostic> {
    let tree = usvg::Tree::from_str(svg, &usvg::Options::default())
        .map_err(|e| Diagnostic::error("png-svg", both!("the SVG document cannot be read: {e}")))?;
    let scale = dpi / CSS_DPI;
    let (w, h) = (
        (f64::from(tree.size().width()) * scale).round(),
        (f64::from(tree.size().height()) * scale).round(),
    );
    let size_fault = || {
        Diagnostic::error(
            "png-size",
            both!(
                "at {dpi} dpi the picture would be {w} by {h} pixels; each side may be 1 to {SIDE_MAX}"
            ),
        )
        .help(both!("choose another resolution"))
    };
    if !(w >= 1.0 && h >= 1.0 && w <= SIDE_MAX && h <= SIDE_MAX) {
        return Err(size_fault());
    }
    let mut pixmap = tiny_skia::Pixmap::new(w as u32, h as u32).ok_or_else(size_fault)?;
    pixmap.fill(tiny_skia::Color::WHITE);
    let transform = tiny_skia::Transform::from_scale(
        w as f32 / tree.size().width(),
        h as f32 / tree.size().height(),
    );
    resvg::render(&tree, transform, &mut pixmap.as_mut());
    Ok(pixmap)
}

pub(super) fn encode(pixmap: &tiny_skia::Pixmap, dpi: f64) -> Result<Vec<u8>, png::EncodingError> {
    // All pixels are opaque because the white paper covers everything, so the premultiplied
    // components are the colours.
    let pixels = pixmap.data().as_chunks::<4>().0;
    // Many pixels are compared before the result is looked at.
    let grey = pixels
        .chunks(4096)
        .all(|some| some.iter().fold(0, |off, [r, g, b, _]| off | (r ^ g) | (g ^ b)) == 0);
    let mut samples = vec![0; pixels.len() * if grey { 1 } else { 3 }];
    if grey {
        samples.iter_mut().zip(pixels).for_each(|(sample, pixel)| *sample = pixel[0]);
    } else {
        let samples = samples.as_chunks_mut::<3>().0;
        samples.iter_mut().zip(pixels).for_each(|(sample, [r, g, b, _])| *sample = [*r, *g, *b]);
    }
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, pixmap.width(), pixmap.height());
    encoder.set_color(if grey { png::ColorType::Grayscale } else { png::ColorType::Rgb });
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Balanced);
    // Lines on white compress best as they are.
    encoder.set_filter(png::Filter::NoFilter);
    let per_metre = (dpi / INCH_MM * 1000.0).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: per_metre,
        yppu: per_metre,
        unit: png::Unit::Meter,
    }));
    encoder.write_header()?.write_image_data(&samples)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    const DISC: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" width="25.4mm" height="50.8mm" viewBox="0 0 25.4 50.8">
        <circle cx="12.7" cy="10" r="5" fill="#COLOUR"/></svg>"##;

    fn decode(bytes: &[u8]) -> (png::OutputInfo, Vec<u8>) {
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut samples = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut samples).unwrap();
        (info, samples)
    }

    #[test]
    fn grey_when_grey_and_colour_when_not() {
        let (info, samples) = decode(&render(&DISC.replace("COLOUR", "000000"), 100.0).unwrap());
        assert_eq!(
            (info.width, info.height, info.color_type),
            (100, 200, png::ColorType::Grayscale)
        );
        // The disc is in the upper part of the sheet, the rest is white paper.
        assert_eq!((samples[39 * 100 + 50], samples[160 * 100 + 50]), (0, 255));
        let (info, _) = decode(&render(&DISC.replace("COLOUR", "c00000"), 100.0).unwrap());
        assert_eq!(info.color_type, png::ColorType::Rgb);
    }

    #[test]
    fn same_bytes_twice() {
        let svg = DISC.replace("COLOUR", "333333");
        assert_eq!(render(&svg, 150.0).unwrap(), render(&svg, 150.0).unwrap());
    }

    #[test]
    fn faults_name_the_numbers() {
        assert_eq!(render("<svg", 100.0).unwrap_err().code, "png-svg");
        for dpi in [0.0, -3.0, f64::NAN, 1e9] {
            assert_eq!(
                render(&DISC.replace("COLOUR", "000000"), dpi).unwrap_err().code,
                "png-size",
                "{dpi}"
            );
        }
    }
}
