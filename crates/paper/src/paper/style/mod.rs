//! Styles of figures: widths and sizes in millimetres, and colours.
//!
//! Styles are data: the bundled ones are the JSON files in this directory; a user's style is a file
//! of the same form with the differences from a base (the `file` module reads both).

use super::arrow::ArrowHead;
use super::font::own::Fonts;
use super::item::{Colour, LineStroke};
use super::memory::LabelMemory;
use hodograph_base::notation::{Notation, Vectors};

mod captions;
mod file;
mod palette;

pub use captions::{Captioned, Captions};
pub use file::{FontOpener, read, read_with};
pub use palette::Palette;

/// The style of a figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Style {
    /// Its name.
    pub name: String,
    /// Links: the thick line of ISO 128, the darkest on the page, because the mechanism is the
    /// subject.
    pub link: LineStroke,
    /// Outlines of joints, blocks and supports: thinner than the links and thicker than the
    /// auxiliary lines.
    pub outline: LineStroke,
    /// Hatching, dimensions, angles, centre lines: half the outline's width, so that hatched areas
    /// stay grey.
    pub thin: LineStroke,
    /// Vectors: their length is read with a ruler to 0.2 mm, so the line may be at most twice as
    /// wide.
    pub vector: LineStroke,
    /// Head of a vector.
    pub head: ArrowHead,
    /// Head of an angle's or dimension's arrow.
    pub thin_head: ArrowHead,
    /// Radius of a revolute joint's circle, to the middle of its line: its white area must be
    /// visible between links of 0.7 mm.
    pub pin_radius_mm: f64,
    /// Radius of the dot at a pole: larger than a line's width, smaller than a joint.
    pub dot_radius_mm: f64,
    /// Height of a fixed pivot's triangle, from the joint's centre to the ground line.
    pub pivot_height_mm: f64,
    /// Half the triangle's base.
    pub pivot_half_base_mm: f64,
    /// Half the length of a fixed pivot's ground line.
    pub ground_half_mm: f64,
    /// Distance between hatch strokes: closer than 1 mm they fill in at 150 dpi.
    pub hatch_pitch_mm: f64,
    /// Depth of the hatching, across the ground line.
    pub hatch_depth_mm: f64,
    /// Length of a slider's block, along its guide.
    pub block_length_mm: f64,
    /// Width of a slider's block, across its guide: the joint's circle has a gap on both sides.
    pub block_width_mm: f64,
    /// Clear width of a slot and distance of a pair of guide lines: the joint's circle fits between
    /// them.
    pub slot_width_mm: f64,
    /// Fill of a link with more than two joints: light enough for a label on it to be legible.
    pub plate: Colour,
    /// Size of the type at points and vectors.
    pub label_mm: f64,
    /// Size of the type in tables and captions.
    pub caption_mm: f64,
    /// Size of the type at scales and dimensions: its scripts (70 %) stay above 2.2 mm, the
    /// smallest size that prints.
    pub small_mm: f64,
    /// The colours of the ink.
    pub palette: Palette,
    /// Marks that replace those of the notation profile.
    pub marks: Marks,
    /// Captions and headings that replace the default ones.
    pub captions: Captions,
    /// The author's fonts, which take precedence over the embedded ones.
    pub fonts: Fonts,
    /// The places of labels in the figure before, for a figure that is drawn again while something
    /// moves.
    pub memory: Option<LabelMemory>,
}

/// Marks of a notation profile that a style replaces; `None` for marks that it keeps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Marks {
    /// The pole.
    pub pole: Option<String>,
    /// Superscript of the Coriolis component.
    pub coriolis: Option<String>,
    /// Superscript of tangential components.
    pub tangential: Option<String>,
    /// Superscript of sliding (relative) components.
    pub sliding: Option<String>,
    /// The sign for "known" in tables.
    pub known: Option<String>,
    /// The sign for "unknown".
    pub unknown: Option<String>,
    /// The sign between similar triangles.
    pub similar: Option<String>,
    /// Suffix of the end of a normal component if n′ is the image of a point N.
    pub normal_end: Option<String>,
    /// Suffix of the end of a Coriolis component if k′ is the image of a point K.
    pub coriolis_end: Option<String>,
    /// Notation of vectors in vector equations.
    pub vectors: Option<Vectors>,
}

impl Marks {
    /// Returns the marks of a notation profile.
    pub fn of(notation: Notation) -> Marks {
        Marks {
            pole: Some(notation.pole),
            coriolis: Some(notation.coriolis),
            tangential: Some(notation.tangential),
            sliding: Some(notation.sliding),
            known: Some(notation.known),
            unknown: Some(notation.unknown),
            similar: Some(notation.similar),
            normal_end: Some(notation.normal_end),
            coriolis_end: Some(notation.coriolis_end),
            vectors: Some(notation.vectors),
        }
    }

    /// Returns the profile with these marks in place of its own.
    pub fn over(&self, profile: &Notation) -> Notation {
        let or = |own: &Option<String>, old: &String| own.clone().unwrap_or_else(|| old.clone());
        Notation {
            pole: or(&self.pole, &profile.pole),
            coriolis: or(&self.coriolis, &profile.coriolis),
            tangential: or(&self.tangential, &profile.tangential),
            sliding: or(&self.sliding, &profile.sliding),
            known: or(&self.known, &profile.known),
            similar: or(&self.similar, &profile.similar),
            unknown: or(&self.unknown, &profile.unknown),
            normal_end: or(&self.normal_end, &profile.normal_end),
            coriolis_end: or(&self.coriolis_end, &profile.coriolis_end),
            vectors: self.vectors.unwrap_or(profile.vectors),
            ..profile.clone()
        }
    }
}

/// The bundled styles, the default one first.
const BUNDLED: [(&str, &str); 3] = [
    ("print", include_str!("print.json")),
    ("slides", include_str!("slides.json")),
    ("dark", include_str!("dark.json")),
];

impl Style {
    /// Returns the names of the bundled styles.
    pub fn names() -> [&'static str; 3] {
        BUNDLED.map(|(name, _)| name)
    }

    /// Returns a bundled style: `print` (black on white, as in Chinese and German textbooks),
    /// `slides` (a colour for each link, larger type) or `dark` (as `slides`, on a dark ground).
    pub fn named(name: &str) -> Option<Style> {
        let (_, source) = BUNDLED.iter().find(|(n, _)| *n == name)?;
        let print = name == BUNDLED[0].0;
        let read = if print {
            file::read_onto(source.as_bytes(), Style::blank(), &mut file::nothing)
        } else {
            read(source.as_bytes())
        };
        Some(read.expect("bundled styles are read by a test"))
    }

    /// Returns a style without measures, the base of `print`: its file sets all of them (a test
    /// checks each).
    fn blank() -> Style {
        let (none, head) =
            (LineStroke::new(0.0), |notch| ArrowHead { length_mm: 0.0, width_mm: 0.0, notch });
        Style {
            name: String::new(),
            link: none.round(),
            outline: none,
            thin: none,
            vector: none,
            head: head(ArrowHead::VECTOR.notch),
            thin_head: head(ArrowHead::THIN.notch),
            pin_radius_mm: 0.0,
            dot_radius_mm: 0.0,
            pivot_height_mm: 0.0,
            pivot_half_base_mm: 0.0,
            ground_half_mm: 0.0,
            hatch_pitch_mm: 0.0,
            hatch_depth_mm: 0.0,
            block_length_mm: 0.0,
            block_width_mm: 0.0,
            slot_width_mm: 0.0,
            plate: Colour::WHITE,
            label_mm: 0.0,
            caption_mm: 0.0,
            small_mm: 0.0,
            palette: Palette::default(),
            marks: Marks::default(),
            captions: Captions::default(),
            fonts: Fonts::default(),
            memory: None,
        }
    }
}

/// Smallest type of a figure: its scripts (70 %) are then 2.2 mm, the smallest size that prints.
const LEAST_TYPE_MM: f64 = 2.2 / 0.7;
/// Smallest reduction of lines and symbols, which shrink less than drawings: below it, a pin can no
/// longer be recognized as a circle.
const LEAST_INK: f64 = 0.7;

/// Caption size for which row heights are given: that of `print`.
const USUAL_CAPTION_MM: f64 = 4.1;

impl Style {
    /// Returns a line distance in proportion to the type; `mm` is for the default caption size.
    pub fn leading(&self, mm: f64) -> f64 {
        mm * self.caption_mm / USUAL_CAPTION_MM
    }

    /// Returns the style for a drawing reduced to this fraction: type only as far as it stays
    /// legible, symbols and lines only as far as they can be distinguished.
    pub fn reduced(&self, part: f64) -> Style {
        let mut style = self.clone();
        for mm in [&mut style.label_mm, &mut style.caption_mm, &mut style.small_mm] {
            *mm = mm.min((*mm * part).max(LEAST_TYPE_MM));
        }
        style.scale_ink(part.clamp(LEAST_INK, 1.0));
        style
    }

    /// Returns the style with labels of this size (points, 1/72 in); all other type and the symbols
    /// in proportion, as in [`Style::reduced`] and [`Style::enlarged`].
    pub fn typeset(&self, label_pt: f64) -> Style {
        let part = label_pt * 25.4 / 72.0 / self.label_mm;
        if part < 1.0 { self.reduced(part) } else { self.enlarged(part) }
    }

    /// Returns the style for a drawing whose type and symbols are larger by this factor: for a
    /// screen that shows the drawing smaller than it is.
    pub fn enlarged(&self, by: f64) -> Style {
        let mut style = self.clone();
        for mm in [&mut style.label_mm, &mut style.caption_mm, &mut style.small_mm] {
            *mm *= by;
        }
        style.scale_ink(by);
        style
    }

    /// Scales symbols by a factor, and widths of lines by its root.
    fn scale_ink(&mut self, k: f64) {
        for stroke in [&mut self.link, &mut self.outline, &mut self.thin, &mut self.vector] {
            stroke.width_mm *= k.sqrt();
        }
        for mm in [
            &mut self.pin_radius_mm,
            &mut self.dot_radius_mm,
            &mut self.pivot_height_mm,
            &mut self.pivot_half_base_mm,
            &mut self.ground_half_mm,
            &mut self.hatch_pitch_mm,
            &mut self.hatch_depth_mm,
            &mut self.block_length_mm,
            &mut self.block_width_mm,
            &mut self.slot_width_mm,
            &mut self.head.length_mm,
            &mut self.head.width_mm,
            &mut self.thin_head.length_mm,
            &mut self.thin_head.width_mm,
        ] {
            *mm *= k;
        }
    }
}

impl Default for Style {
    /// Returns the `print` style.
    fn default() -> Style {
        Style::named("print").expect("the usual style is bundled")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bundled_styles_are_readable_and_named_after_their_file() {
        for name in Style::names() {
            assert_eq!(Style::named(name).unwrap().name, name);
        }
        assert_eq!(Style::default().name, "print");
        assert_eq!(Style::default().caption_mm, USUAL_CAPTION_MM);
        assert_eq!(Style::named("nosuch"), None);
    }

    #[test]
    fn marks_replace_those_of_the_profile() {
        let marks = Marks { pole: Some("P".into()), ..Marks::default() };
        let en = Notation::named("en").unwrap();
        let own = marks.over(&en);
        assert_eq!((own.pole.as_str(), &own.coriolis), ("P", &en.coriolis));
    }
}
