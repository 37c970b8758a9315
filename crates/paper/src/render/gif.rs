//! Writes figures of one size as an endless GIF animation, with the same bytes on every run.
//!
//! Greys, and small numbers of colours, are kept exactly in one palette for all frames; if there
//! are more than 256 colours, each frame has its own palette (NeuQuant).

use std::collections::BTreeMap;

use gif::{Encoder, Frame, Repeat};

use hodograph_base::diag::{Diagnostic, both};

use super::png;

/// Number of colours in a palette.
const COLOURS: usize = 256;
/// Sampling step of NeuQuant: it examines every tenth pixel.
const SPEED: i32 = 10;
/// Largest memory for the frames in bytes: all are kept until their colours are known.
const BYTES_MAX: usize = 1 << 30;
/// The time unit of a GIF: hundredths of a second.
const TICKS: f64 = 100.0;
/// Shortest duration of a frame: for shorter ones, viewers wait a tenth of a second instead.
const SHORTEST_TICKS: f64 = 2.0;

/// Writes documents (from [`super::svg::write`]) as the frames of one period of `seconds` seconds.
///
/// # Errors
/// As [`png::render`]; `gif-size` if a side is above 65 535 pixels or the frames differ in size.
pub fn write(frames: &[String], dpi: f64, seconds: f64) -> Result<Vec<u8>, Diagnostic> {
    let mut pictures = Vec::with_capacity(frames.len());
    let mut size = None;
    for svg in frames {
        let pixmap = png::pixels(svg, dpi)?;
        let here = [pixmap.width(), pixmap.height()].map(|v| u16::try_from(v).ok());
        let ([Some(w), Some(h)], true) = (here, size.is_none_or(|s| s == here)) else {
            return Err(fault(both!("the frames are not of one size that a GIF can have")));
        };
        let bytes = usize::from(w) * usize::from(h) * 3 * frames.len();
        if bytes > BYTES_MAX {
            let message = both!(
                "{} frames of {} by {} pixels are more than a GIF is made for",
                frames.len(),
                w,
                h
            );
            return Err(fault(message).help(both!("choose a lower --dpi, fewer --frames, or .svg")));
        }
        size = Some([Some(w), Some(h)]);
        pictures
            .push(pixmap.data().chunks_exact(4).map(|p| [p[0], p[1], p[2]]).collect::<Vec<_>>());
    }
    let Some([Some(w), Some(h)]) = size else {
        return Err(fault(both!("there is no frame")));
    };
    let delay = (seconds * TICKS / frames.len() as f64)
        .round()
        .clamp(SHORTEST_TICKS, f64::from(u16::MAX)) as u16;
    encode(&pictures, [w, h], delay).map_err(|e| fault(both!("the picture cannot be encoded: {e}")))
}

fn fault(message: hodograph_base::diag::Both) -> Diagnostic {
    Diagnostic::error("gif-size", message)
}

fn encode(
    pictures: &[Vec<[u8; 3]>],
    [w, h]: [u16; 2],
    delay: u16,
) -> Result<Vec<u8>, gif::EncodingError> {
    let palette = palette(pictures);
    let colours: Vec<u8> = palette.iter().flat_map(|p| p.keys().flatten().copied()).collect();
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, w, h, &colours)?;
    encoder.set_repeat(Repeat::Infinite)?;
    for picture in pictures {
        let mut frame = match &palette {
            Some(palette) => {
                let indices: Vec<u8> =
                    picture.iter().map(|c| palette.get(c).copied().unwrap_or(0)).collect();
                Frame::from_indexed_pixels(w, h, indices, None)
            }
            None => Frame::from_rgb_speed(w, h, picture.as_flattened(), SPEED),
        };
        if palette.is_some() {
            frame.palette = None;
        }
        frame.delay = delay;
        encoder.write_frame(&frame)?;
    }
    drop(encoder);
    Ok(bytes)
}

/// Returns all colours with their palette indices if they fit into one palette.
fn palette(pictures: &[Vec<[u8; 3]>]) -> Option<BTreeMap<[u8; 3], u8>> {
    let mut all = BTreeMap::new();
    for picture in pictures {
        let mut last = None;
        for colour in picture.iter().filter(|c| last.replace(**c) != Some(**c)) {
            all.insert(*colour, 0);
            if all.len() > COLOURS {
                return None;
            }
        }
    }
    for (place, index) in all.values_mut().zip(0..=u8::MAX) {
        *place = index;
    }
    Some(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn disc(x: f64, colour: &str) -> String {
        format!(
            r##"<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="10mm" viewBox="0 0 20 10"><circle cx="{x}" cy="5" r="3" fill="{colour}"/></svg>"##
        )
    }

    #[test]
    fn frames_come_back_with_their_colours_and_their_time() {
        let frames = [4.0, 8.0, 12.0].map(|x| disc(x, "#c00000"));
        let bytes = write(&frames, 127.0, 1.5).unwrap();
        assert_eq!(bytes, write(&frames, 127.0, 1.5).unwrap());
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let mut reader = options.read_info(bytes.as_slice()).unwrap();
        assert_eq!((reader.width(), reader.height(), reader.repeat()), (100, 50, Repeat::Infinite));
        for x in [20, 40, 60] {
            let frame = reader.read_next_frame().unwrap().unwrap();
            let pixel = (25 * 100 + x) * 4;
            assert_eq!((frame.delay, &frame.buffer[pixel..pixel + 3]), (50, &[0xc0, 0, 0][..]));
        }
        assert!(reader.read_next_frame().unwrap().is_none());
    }

    #[test]
    fn frames_of_two_sizes_are_refused() {
        let other = disc(4.0, "#000000").replace("20mm", "21mm");
        assert_eq!(write(&[disc(4.0, "#000000"), other], 100.0, 1.0).unwrap_err().code, "gif-size");
        assert_eq!(write(&[], 100.0, 1.0).unwrap_err().code, "gif-size");
    }
}
