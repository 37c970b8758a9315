//! The fonts: the choice of a font for each character, the shaping of runs into glyphs, and the
//! outlines of glyphs.
//!
//! The author's fonts ([`own::Fonts`]), if any, come first, then the five embedded fonts in a fixed
//! order. Italics are decided by the label language ([`super::label`]), the places of scripts by
//! [`super::text`]. System fonts are never used: the same label gives the same outline on every
//! machine. The caller reports a character that no font has; it is never drawn as a box.

use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::{Arc, LazyLock, OnceLock};

use harfrust::{ShapeOptions, ShaperData, UnicodeBuffer};
use skrifa::raw::TableProvider;
use skrifa::{FontRef, GlyphId, MetadataProvider};

mod outline;
pub mod own;
mod plans;

pub use outline::{Ink, Outline, OutlineSegment};

use own::{Fonts, Own};
use plans::Plans;

/// The bytes of a font file; copies share them.
pub type Bytes = Arc<dyn AsRef<[u8]> + Send + Sync>;

/// The style of a character, before a font is chosen for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "wire", derive(serde::Serialize, serde::Deserialize))]
pub enum Slant {
    /// Letters of quantities and points.
    Italic,
    /// Letters of vectors, where a vector and its magnitude have different letters.
    Bold,
    /// Digits, units, words.
    Upright,
    /// Operators, relations and primes: the mathematical font comes first, so that all of them have
    /// one weight and axis.
    Symbol,
}

/// A cut of the author's own font.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Cut {
    /// For digits and words.
    Upright,
    /// For letters of quantities and points.
    Slanted,
}

impl Cut {
    fn name(self) -> &'static str {
        match self {
            Cut::Upright => "upright",
            Cut::Slanted => "slanted",
        }
    }
}

/// A font.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Face {
    /// Tinos Regular: Latin and Greek with the metrics of Times.
    Roman,
    /// Tinos Italic.
    Italic,
    /// Tinos Bold Italic (subset): letters of vectors.
    Bold,
    /// STIX Two Math (subset): arrows, ⊥ ∥ ∠ √ ✓, primes, circled numbers.
    Math,
    /// Noto Serif CJK SC (subset): Song-style Chinese.
    Song,
    /// A font of the author.
    Own(Own),
}

/// The lookup key of a font, without its file. Embedded fonts sort before the author's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FaceKey(u8, u64);

const ITALIC_FIRST: [Face; 4] = [Face::Italic, Face::Roman, Face::Math, Face::Song];
const BOLD_FIRST: [Face; 5] = [Face::Bold, Face::Italic, Face::Roman, Face::Math, Face::Song];
const ROMAN_FIRST: [Face; 4] = [Face::Roman, Face::Math, Face::Song, Face::Italic];
const MATH_FIRST: [Face; 4] = [Face::Math, Face::Roman, Face::Song, Face::Italic];

struct LoadedFont {
    bytes: Bytes,
    shaper: ShaperData,
    plans: Plans,
    /// Font units per em.
    em: f64,
}

impl LoadedFont {
    fn new(face: &Face) -> LoadedFont {
        LoadedFont::try_new(face.bytes())
            .expect("an embedded font is readable: a test shapes with each of them")
    }

    fn try_new(bytes: Bytes) -> Option<LoadedFont> {
        let font = FontRef::from_index((*bytes).as_ref(), 0).ok()?;
        let (shaper, em) =
            (ShaperData::new(&font), f64::from(font.head().ok()?.units_per_em().max(1)));
        Some(LoadedFont { bytes, shaper, plans: Plans::default(), em })
    }

    /// Returns the font as a view of its file; only the table directory is parsed.
    fn font(&self) -> FontRef<'_> {
        FontRef::from_index((*self.bytes).as_ref(), 0)
            .expect("the same bytes have been read before")
    }

    /// Returns the glyph of a character.
    fn glyph(&self, c: char) -> Option<GlyphId> {
        self.font().charmap().map(c)
    }

    /// Returns the outline of a glyph; `None` if it is damaged.
    fn outline(&self, glyph: u32) -> Option<Outline> {
        Outline::of(&self.font(), GlyphId::new(glyph), self.em)
    }

    /// Shapes a run of characters; `ink_of` returns the ink box of a glyph, which may be cached.
    fn shape(&self, run: &str, ink_of: impl Fn(u32) -> Ink) -> GlyphRun {
        let em = self.em;
        let mut buffer = UnicodeBuffer::new();
        buffer.push_str(run);
        buffer.guess_segment_properties();
        let font = self.font();
        let shaper = self.shaper.shaper(&font).build();
        let plan = self.plans.of(&shaper, &buffer);
        let buffer = shaper.shape(buffer, ShapeOptions::new().plan(Some(&plan)));
        let mut glyphs: Vec<Glyph> = Vec::new();
        let mut ink = Ink::NONE;
        let mut pen = 0.0;
        for (info, pos) in buffer.glyph_infos().iter().zip(buffer.glyph_positions()) {
            let start = info.cluster as usize;
            // All scripts run from left to right, so the characters of a glyph end where those of
            // the next one begin.
            if let Some(before) = glyphs.last_mut().filter(|g| g.text.start < start) {
                before.text.end = start;
            }
            let offset_em = [f64::from(pos.x_offset) / em, f64::from(pos.y_offset) / em];
            ink = ink.union(ink_of(info.glyph_id).placed(1.0, pen + offset_em[0], offset_em[1]));
            let advance_em = f64::from(pos.x_advance) / em;
            glyphs.push(Glyph { id: info.glyph_id, advance_em, offset_em, text: start..run.len() });
            pen += advance_em;
        }
        GlyphRun { ink, advance_em: pen, glyphs }
    }
}

static ROMAN: LazyLock<LoadedFont> = LazyLock::new(|| LoadedFont::new(&Face::Roman));
static ITALIC: LazyLock<LoadedFont> = LazyLock::new(|| LoadedFont::new(&Face::Italic));
static BOLD: LazyLock<LoadedFont> = LazyLock::new(|| LoadedFont::new(&Face::Bold));
static MATH: LazyLock<LoadedFont> = LazyLock::new(|| LoadedFont::new(&Face::Math));
/// The Chinese font, once it is there ([`song`]).
static SONG: OnceLock<LoadedFont> = OnceLock::new();

/// Returns the Chinese font; `None` where it is not embedded and [`give_song`] has not given it.
fn song() -> Option<&'static LoadedFont> {
    #[cfg(feature = "fonts-cjk")]
    return Some(SONG.get_or_init(|| LoadedFont::new(&Face::Song)));
    #[cfg(not(feature = "fonts-cjk"))]
    SONG.get()
}

/// Takes the file of the Chinese font, `fonts/song-gb1-cff.otf`, which is not embedded without the
/// feature `fonts-cjk`. Returns false if it is no font. Only the first font is used.
pub fn give_song(bytes: Vec<u8>) -> bool {
    let read = LoadedFont::try_new(Arc::new(bytes));
    read.is_some_and(|font| SONG.set(font).is_ok() || song().is_some())
}

/// Returns true if there is a Chinese font.
pub(super) fn has_song() -> bool {
    cfg!(feature = "fonts-cjk") || SONG.get().is_some()
}

/// The upright font of HTML pages as WOFF2, with the constants that browsers use to lay out
/// formulas.
pub const PAGE_UPRIGHT: &[u8] = include_bytes!("../../fonts/page-upright.woff2");
/// The italic font of HTML pages as WOFF2.
pub const PAGE_ITALIC: &[u8] = include_bytes!("../../fonts/page-italic.woff2");

/// Largest number of cached runs: a few sheets' worth, about a megabyte. The bound keeps memory
/// constant in a batch of thousands of sheets.
const MOST_RUNS: usize = 2048;
/// Largest extent of a letter in an undamaged font (em).
const MOST_EM: f64 = 8.0;
/// Largest number of cached glyph outlines, of about a kilobyte each: more than the sheets of two
/// languages use at once.
const MOST_OUTLINES: usize = 2048;

thread_local! {
    /// Only looked up in, never iterated.
    static RUNS: RefCell<HashMap<(FaceKey, String), Rc<GlyphRun>>> = RefCell::default();
    static KNOWN: RefCell<HashMap<(FaceKey, char), bool>> = RefCell::default();
    static OUTLINES: RefCell<HashMap<(FaceKey, u32), Rc<Outline>>> = RefCell::default();
}

impl Face {
    /// Returns the lookup key of the font.
    pub fn key(&self) -> FaceKey {
        match self {
            Face::Roman => FaceKey(0, 0),
            Face::Italic => FaceKey(1, 0),
            Face::Math => FaceKey(2, 0),
            Face::Song => FaceKey(3, 0),
            Face::Bold => FaceKey(4, 0),
            Face::Own(own) => FaceKey(5 + own.cut() as u8, own.key()),
        }
    }

    /// Returns the font file, for formats that embed their fonts.
    pub fn bytes(&self) -> Bytes {
        let embedded: &'static [u8] = match self {
            Face::Roman => include_bytes!("../../fonts/tinos-normal.ttf"),
            Face::Italic => include_bytes!("../../fonts/tinos-italic.ttf"),
            Face::Bold => include_bytes!("../../fonts/tinos-bold-italic.ttf"),
            Face::Math => include_bytes!("../../fonts/stix-math-sub.ttf"),
            #[cfg(feature = "fonts-cjk")]
            Face::Song => include_bytes!("../../fonts/song-gb1-cff.otf"),
            #[cfg(not(feature = "fonts-cjk"))]
            Face::Song => {
                return SONG.get().map_or_else(|| Face::Roman.bytes(), |f| Arc::clone(&f.bytes));
            }
            Face::Own(own) => return own.bytes(),
        };
        Arc::new(embedded)
    }

    fn loaded(&self) -> &LoadedFont {
        match self {
            Face::Roman => &ROMAN,
            Face::Italic => &ITALIC,
            Face::Bold => &BOLD,
            Face::Math => &MATH,
            Face::Song => song().unwrap_or(&ROMAN),
            Face::Own(own) => own.loaded(),
        }
    }

    /// Returns the font for a character of that slant: one of the author's if it has the character,
    /// else an embedded one; `None` if no font has it.
    pub fn of(c: char, slant: Slant, fonts: &Fonts) -> Option<Face> {
        let order: &[Face] = match slant {
            Slant::Italic => &ITALIC_FIRST,
            Slant::Bold => &BOLD_FIRST,
            Slant::Upright => &ROMAN_FIRST,
            Slant::Symbol => &MATH_FIRST,
        };
        fonts.face_of(c, slant).or_else(|| {
            let has = |face: &&Face| {
                (**face != Face::Song || song().is_some())
                    && face.known(c, |loaded| loaded.glyph(c).is_some())
            };
            order.iter().find(has).cloned()
        })
    }

    /// Shapes a run of characters (kerning included).
    ///
    /// Results are cached: the placement of labels measures the same few runs many times.
    pub fn shaped(&self, run: &str) -> Rc<GlyphRun> {
        RUNS.with_borrow_mut(|runs| {
            if let Some(known) = runs.get(&(self.key(), run.to_owned())) {
                return Rc::clone(known);
            }
            if runs.len() >= MOST_RUNS {
                runs.clear();
            }
            let shaped = Rc::new(self.shape(run));
            runs.insert((self.key(), run.to_owned()), Rc::clone(&shaped));
            shaped
        })
    }

    fn shape(&self, run: &str) -> GlyphRun {
        // Outlines are cached: the ink of a letter is read from its font once.
        let ink_of = |glyph| self.outline(glyph).ink;
        let whole = self.loaded().shape(run, ink_of);
        if !matches!(self, Face::Own(_)) || sound(&whole, run) {
            return whole;
        }
        // The font is damaged and the measures of the run are wrong: its letters are shaped one by
        // one.
        let mut out = GlyphRun { ink: Ink::NONE, advance_em: 0.0, glyphs: Vec::new() };
        for (at, c) in run.char_indices() {
            let one = self.loaded().shape(c.encode_utf8(&mut [0; 4]), ink_of);
            out.ink = out.ink.union(one.ink.placed(1.0, out.advance_em, 0.0));
            out.advance_em += one.advance_em;
            out.glyphs
                .extend(one.glyphs.into_iter().map(|g| Glyph { text: at..at + c.len_utf8(), ..g }));
        }
        out
    }

    /// Returns the cached result of `find` for a character: for an embedded font, true if it has
    /// the character; for one of the author's, true if it can also draw it.
    fn known(&self, c: char, find: impl FnOnce(&LoadedFont) -> bool) -> bool {
        KNOWN.with_borrow_mut(|known| {
            if known.len() >= MOST_RUNS {
                known.clear();
            }
            *known.entry((self.key(), c)).or_insert_with(|| find(self.loaded()))
        })
    }

    /// Returns the outline of a glyph.
    pub fn outline(&self, glyph: u32) -> Rc<Outline> {
        OUTLINES.with_borrow_mut(|outlines| {
            if outlines.len() >= MOST_OUTLINES {
                outlines.clear();
            }
            Rc::clone(
                outlines.entry((self.key(), glyph)).or_insert_with(|| Rc::new(self.draw(glyph))),
            )
        })
    }

    fn draw(&self, glyph: u32) -> Outline {
        // A character that cannot be drawn was taken from another font.
        self.loaded().outline(glyph).unwrap_or(Outline { segments: Vec::new(), ink: Ink::NONE })
    }
}

/// Returns the outline of a character; `None` if the font does not have it or has a damaged glyph.
fn drawn(loaded: &LoadedFont, c: char) -> Option<Outline> {
    let glyph = loaded.glyph(c)?;
    let text = String::from(c);
    let run = loaded.shape(&text, |g| loaded.outline(g).map_or(Ink::NONE, |o| o.ink));
    let all = sound(&run, &text) && run.glyphs.iter().all(|g| loaded.outline(g.id).is_some());
    let outline = loaded.outline(glyph.to_u32()).filter(|_| all)?;
    // A letter without ink would leave a gap in the sentence.
    (outline.ink.any() || c.is_whitespace()).then_some(outline)
}

/// Returns true if the measures of a run are plausible for letters.
fn sound(run: &GlyphRun, text: &str) -> bool {
    let within = |v: f64, most: f64| v.is_finite() && v.abs() <= most;
    let glyph = |g: &Glyph| {
        let place = text.is_char_boundary(g.text.start)
            && text.is_char_boundary(g.text.end)
            && g.text.start <= g.text.end;
        place && within(g.advance_em, MOST_EM) && g.offset_em.iter().all(|v| within(*v, MOST_EM))
    };
    run.glyphs.len() <= 4 * text.len() + 4 && run.glyphs.iter().all(glyph) && run.advance_em >= 0.0
}

/// A shaped run of one font.
#[derive(Clone, Debug, PartialEq)]
pub struct GlyphRun {
    /// The box around all glyphs, with the origin of the first one at 0.
    pub ink: Ink,
    /// Distance to the origin of the next run, in em.
    pub advance_em: f64,
    /// The glyphs in order.
    pub glyphs: Vec<Glyph>,
}

/// A glyph of a shaped run.
#[derive(Clone, Debug, PartialEq)]
pub struct Glyph {
    /// Glyph number in the font.
    pub id: u32,
    /// Distance from its origin to that of the next glyph.
    pub advance_em: f64,
    /// Offset of the glyph from the pen position, y up.
    pub offset_em: [f64; 2],
    /// Byte range of the glyph's characters in the run's text: more than one character for a
    /// ligature.
    pub text: std::ops::Range<usize>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_embedded_font_shapes() {
        // Advances as printed by `ttx -t hmtx`, in em.
        for (face, text, advance_em) in [
            (Face::Roman, "1", 0.5),
            (Face::Italic, "v", 0.444),
            (Face::Bold, "v", 0.444),
            (Face::Math, "⊥", 0.720),
            (Face::Song, "速", 1.0),
        ] {
            let run = face.shaped(text);
            assert!(face.outline(run.glyphs[0].id).segments.len() > 3, "{face:?} draws {text}");
            assert!(
                (run.advance_em - advance_em).abs() < 1e-3,
                "{face:?} {text}: {} em",
                run.advance_em
            );
        }
    }

    #[test]
    fn faces_by_slant() {
        let none = Fonts::default();
        assert_eq!(Face::of('v', Slant::Italic, &none), Some(Face::Italic));
        assert_eq!(Face::of('v', Slant::Bold, &none), Some(Face::Bold));
        assert_eq!(Face::of('ω', Slant::Bold, &none), Some(Face::Italic));
        assert_eq!(Face::of('v', Slant::Upright, &none), Some(Face::Roman));
        assert_eq!(Face::of('=', Slant::Symbol, &none), Some(Face::Math));
        assert_eq!(Face::of('→', Slant::Italic, &none), Some(Face::Math));
        assert_eq!(Face::of('度', Slant::Italic, &none), Some(Face::Song));
        assert_eq!(Face::of('\u{1F600}', Slant::Upright, &none), None);
    }
}
