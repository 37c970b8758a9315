//! The letters of a label in an SVG: used from definitions, or as text. Integers of 1/1000 em make
//! all digits independent of the position of a label.

use std::fmt::Write as _;

use crate::paper::font::{Cut, Face, FaceKey, OutlineSegment};
use crate::paper::text::Typeset;
use crate::render::escaped;
use crate::render::number::mm;

/// The lookup key of a letter: font, glyph number and size.
pub(super) type LetterKey = (FaceKey, u32, i32);

/// A glyph of a font at a fraction of the label's size (in 1/1000).
#[derive(Clone)]
pub(super) struct LetterGlyph {
    face: Face,
    glyph: u32,
    size: i32,
}

/// Returns the visible letters of a label with their positions, in 1/1000 em, y up.
pub(super) fn letters(set: &Typeset) -> Vec<(LetterGlyph, [i32; 2])> {
    let mut out = Vec::new();
    for run in &set.runs {
        let mut pen = run.x_em;
        for glyph in &run.glyphs {
            let at = [
                pen + glyph.offset_em[0] * run.size_em,
                run.y_em + glyph.offset_em[1] * run.size_em,
            ]
            .map(milli);
            pen += glyph.advance_em * run.size_em;
            if run.face.outline(glyph.id).ink.any() {
                out.push((
                    LetterGlyph {
                        face: run.face.clone(),
                        glyph: glyph.id,
                        size: milli(run.size_em),
                    },
                    at,
                ));
            }
        }
    }
    out
}

/// Returns a label as text that a drawing program can edit; sizes and positions in mm.
pub(super) fn editable(set: &Typeset, size_mm: f64) -> String {
    let mut out = format!("<text xml:space=\"preserve\" font-family=\"{}\">", family(&Face::Roman));
    for run in &set.runs {
        let (x, y, size) =
            (mm(run.x_em * size_mm), mm(-run.y_em * size_mm), mm(run.size_em * size_mm));
        let _ = write!(out, "<tspan x=\"{x}\" y=\"{y}\" font-size=\"{size}\"");
        match &run.face {
            Face::Roman => {}
            Face::Italic => out.push_str(" font-style=\"italic\""),
            Face::Bold => out.push_str(" font-style=\"italic\" font-weight=\"bold\""),
            Face::Math | Face::Song => {
                let _ = write!(out, " font-family=\"{}\"", family(&run.face));
            }
            Face::Own(own) => {
                let style = if own.cut() == Cut::Slanted { " font-style=\"italic\"" } else { "" };
                let _ =
                    write!(out, " font-family=\"'{}',{}\"{style}", own.family(), family(&run.face));
            }
        }
        let _ = write!(out, ">{}</tspan>", escaped(&run.text));
    }
    out.push_str("</text>");
    out
}

/// Returns font families similar to the embedded font, the font itself first.
fn family(face: &Face) -> &'static str {
    match face {
        Face::Roman | Face::Italic | Face::Bold | Face::Own(_) => {
            "Tinos,'Times New Roman','Liberation Serif',serif"
        }
        Face::Math => "'STIX Two Math','Cambria Math',Tinos,'Times New Roman',serif",
        Face::Song => "'Noto Serif CJK SC','Source Han Serif SC',SimSun,serif",
    }
}

impl LetterGlyph {
    /// Returns the lookup key: letters with the same key are equal; those of embedded fonts sort
    /// first.
    pub fn key(&self) -> LetterKey {
        (self.face.key(), self.glyph, self.size)
    }

    /// Returns the outline, in 1/1000 em of the label.
    pub fn contours(&self) -> Vec<OutlineSegment<i32>> {
        let size = f64::from(self.size) / 1000.0;
        self.face
            .outline(self.glyph)
            .segments
            .iter()
            .map(|s| s.map(|p| p.map(|em| milli(em * size))))
            .collect()
    }

    pub fn name(&self) -> String {
        let face = match &self.face {
            Face::Roman => 'r',
            Face::Italic => 'i',
            Face::Bold => 'b',
            Face::Math => 'm',
            Face::Song => 's',
            Face::Own(own) if own.cut() == Cut::Upright => 'o',
            Face::Own(_) => 'p',
        };
        // Two figures of a page may have different author's fonts.
        let own = if let Face::Own(own) = &self.face {
            format!("{:08x}-", own.key() as u32)
        } else {
            String::new()
        };
        let size = if self.size == 1000 { String::new() } else { format!("-{}", self.size) };
        format!("g{face}{own}{}{size}", self.glyph)
    }
}

fn milli(em: f64) -> i32 {
    (em * 1000.0).round() as i32
}

/// Returns the factor from 1/1000 em to mm: three more decimals than a coordinate, because it
/// multiplies numbers of up to some thousands.
pub(super) fn scale(size_mm: f64) -> String {
    ((size_mm * 1000.0).round() / 1e6).to_string()
}

/// Returns the path data of an outline in integers and relative commands, with y turned over.
pub(super) fn outline_data(outline: Vec<OutlineSegment<i32>>) -> String {
    let mut d = String::new();
    let mut digits = itoa::Buffer::new();
    let (mut here, mut start) = ([0, 0], [0, 0]);
    for segment in outline {
        let origin = here;
        let mut write = |letter: char, points: &[[i32; 2]]| {
            d.push(letter);
            for (i, p) in points.iter().enumerate() {
                let (dx, dy) = (p[0] - origin[0], origin[1] - p[1]);
                // A minus sign is a separator by itself.
                if i > 0 && dx >= 0 {
                    d.push(' ');
                }
                d.push_str(digits.format(dx));
                if dy >= 0 {
                    d.push(' ');
                }
                d.push_str(digits.format(dy));
            }
            here = points[points.len() - 1];
        };
        match segment {
            OutlineSegment::Move(a) => {
                write('m', &[a]);
                start = a;
            }
            OutlineSegment::Line(a) => write('l', &[a]),
            OutlineSegment::Quad(a, b) => write('q', &[a, b]),
            OutlineSegment::Cubic(a, b, c) => write('c', &[a, b, c]),
            OutlineSegment::Close => {
                d.push('z');
                here = start;
            }
        }
    }
    d
}
