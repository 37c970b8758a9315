//! The embedded fonts: which character comes from which font, how a run of characters becomes glyphs, and what these look like.
//!
//! Decided here: the order in which the five fonts are asked, after the author's own ([`own::Fonts`]) where there are any. Not decided here: what is italic (the label
//! language, [`super::label`]) and where scripts go ([`super::text`]). No system font is ever asked: the same
//! label gives the same outline on every machine, and a character that none of the fonts has is reported by the
//! caller, never drawn as a box.

use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::{Arc, LazyLock};

use harfrust::{ShapeOptions, ShaperData, UnicodeBuffer};
use skrifa::raw::TableProvider;
use skrifa::{FontRef, GlyphId, MetadataProvider};

mod outline;
pub mod own;
mod plans;

pub use outline::{Ink, Outline, Segment};

use own::{Fonts, Own};
use plans::Plans;

/// The file of a font; copies share it.
pub type Bytes = Arc<dyn AsRef<[u8]> + Send + Sync>;

/// How a character is to look, before a font is chosen for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Slant {
    /// Letters of quantities and points.
    Italic,
    /// Letters of vectors, where these are told from their magnitudes.
    Bold,
    /// Digits, units, words.
    Upright,
    /// Operators, relations and primes: the mathematical font first, so that all of them share one weight and axis.
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

/// One of the fonts.
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
    /// One of the author's own.
    Own(Own),
}

/// Stands for a font where fonts are looked up: it holds no file. Bundled fonts come before the author's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FaceKey(u8, u64);

const ITALIC_FIRST: [Face; 4] = [Face::Italic, Face::Roman, Face::Math, Face::Song];
const BOLD_FIRST: [Face; 5] = [Face::Bold, Face::Italic, Face::Roman, Face::Math, Face::Song];
const ROMAN_FIRST: [Face; 4] = [Face::Roman, Face::Math, Face::Song, Face::Italic];
const MATH_FIRST: [Face; 4] = [Face::Math, Face::Roman, Face::Song, Face::Italic];

struct Loaded {
    bytes: Bytes,
    shaper: ShaperData,
    plans: Plans,
    /// Units of the font.
    em: f64,
}

impl Loaded {
    fn new(face: &Face) -> Loaded {
        Loaded::try_new(face.bytes()).expect("an embedded font is readable: a test shapes with each of them")
    }

    fn try_new(bytes: Bytes) -> Option<Loaded> {
        let font = FontRef::from_index((*bytes).as_ref(), 0).ok()?;
        let (shaper, em) = (ShaperData::new(&font), f64::from(font.head().ok()?.units_per_em().max(1)));
        Some(Loaded { bytes, shaper, plans: Plans::default(), em })
    }

    /// The font: a view of its file, whose directory of tables is all that is read here.
    fn font(&self) -> FontRef<'_> {
        FontRef::from_index((*self.bytes).as_ref(), 0).expect("the same bytes have been read before")
    }

    /// The glyph of a character.
    fn glyph(&self, c: char) -> Option<GlyphId> {
        self.font().charmap().map(c)
    }

    /// The outline of a glyph; `None` where it is damaged.
    fn outline(&self, glyph: u32) -> Option<Outline> {
        Outline::of(&self.font(), GlyphId::new(glyph), self.em)
    }

    /// A run of characters as glyphs; `ink_of` tells what each of them covers, for it may be known already.
    fn shape(&self, run: &str, ink_of: impl Fn(u32) -> Ink) -> Run {
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
            // Scripts run from left to right here, so the characters of a glyph end where those of the next begin.
            if let Some(before) = glyphs.last_mut().filter(|g| g.text.start < start) {
                before.text.end = start;
            }
            let offset_em = [f64::from(pos.x_offset) / em, f64::from(pos.y_offset) / em];
            ink = ink.union(ink_of(info.glyph_id).placed(1.0, pen + offset_em[0], offset_em[1]));
            let advance_em = f64::from(pos.x_advance) / em;
            glyphs.push(Glyph { id: info.glyph_id, advance_em, offset_em, text: start..run.len() });
            pen += advance_em;
        }
        Run { ink, advance_em: pen, glyphs }
    }
}

static ROMAN: LazyLock<Loaded> = LazyLock::new(|| Loaded::new(&Face::Roman));
static ITALIC: LazyLock<Loaded> = LazyLock::new(|| Loaded::new(&Face::Italic));
static BOLD: LazyLock<Loaded> = LazyLock::new(|| Loaded::new(&Face::Bold));
static MATH: LazyLock<Loaded> = LazyLock::new(|| Loaded::new(&Face::Math));
static SONG: LazyLock<Loaded> = LazyLock::new(|| Loaded::new(&Face::Song));

/// The upright letters of pages of HTML as WOFF2, with the constants by which browsers set formulas.
pub const PAGE_UPRIGHT: &[u8] = include_bytes!("../../fonts/page-upright.woff2");
/// The italic letters of pages of HTML as WOFF2.
pub const PAGE_ITALIC: &[u8] = include_bytes!("../../fonts/page-italic.woff2");

/// Runs kept: a few sheets' worth, about a megabyte; a batch of thousands of sheets must not grow without bound.
const MOST_RUNS: usize = 2048;
/// No letter of a sound font reaches so far (em).
const MOST_EM: f64 = 8.0;
/// Glyphs kept, of about a kilobyte each: more than two languages' sheets ever use at once.
const MOST_OUTLINES: usize = 2048;

thread_local! {
    /// Only looked up in, never iterated.
    static RUNS: RefCell<HashMap<(FaceKey, String), Rc<Run>>> = RefCell::default();
    static KNOWN: RefCell<HashMap<(FaceKey, char), bool>> = RefCell::default();
    static OUTLINES: RefCell<HashMap<(FaceKey, u32), Rc<Outline>>> = RefCell::default();
}

impl Face {
    /// What it is looked up by.
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

    /// The font file, for formats that carry their fonts.
    pub fn bytes(&self) -> Bytes {
        let embedded: &'static [u8] = match self {
            Face::Roman => include_bytes!("../../fonts/tinos-normal.ttf"),
            Face::Italic => include_bytes!("../../fonts/tinos-italic.ttf"),
            Face::Bold => include_bytes!("../../fonts/tinos-bold-italic.ttf"),
            Face::Math => include_bytes!("../../fonts/stix-math-sub.ttf"),
            Face::Song => include_bytes!("../../fonts/song-gb1-cff.otf"),
            Face::Own(own) => return own.bytes(),
        };
        Arc::new(embedded)
    }

    fn loaded(&self) -> &Loaded {
        match self {
            Face::Roman => &ROMAN,
            Face::Italic => &ITALIC,
            Face::Bold => &BOLD,
            Face::Math => &MATH,
            Face::Song => &SONG,
            Face::Own(own) => own.loaded(),
        }
    }

    /// The font for a character of that slant: of the author's, else of the embedded ones; `None` when none has it.
    pub fn of(c: char, slant: Slant, fonts: &Fonts) -> Option<Face> {
        let order: &[Face] = match slant {
            Slant::Italic => &ITALIC_FIRST,
            Slant::Bold => &BOLD_FIRST,
            Slant::Upright => &ROMAN_FIRST,
            Slant::Symbol => &MATH_FIRST,
        };
        fonts.face_of(c, slant).or_else(|| order.iter().find(|face| face.known(c, |loaded| loaded.glyph(c).is_some())).cloned())
    }

    /// Shapes a run of characters (kerning included).
    ///
    /// A sheet measures the same few runs many times over while it looks for places: they are kept.
    pub fn shaped(&self, run: &str) -> Rc<Run> {
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

    fn shape(&self, run: &str) -> Run {
        // Outlines are kept: what a letter covers is read from its font once.
        let ink_of = |glyph| self.outline(glyph).ink;
        let whole = self.loaded().shape(run, ink_of);
        if !matches!(self, Face::Own(_)) || sound(&whole, run) {
            return whole;
        }
        // A damaged font: what goes wrong between letters does not where each stands alone.
        let mut out = Run { ink: Ink::NONE, advance_em: 0.0, glyphs: Vec::new() };
        for (at, c) in run.char_indices() {
            let one = self.loaded().shape(c.encode_utf8(&mut [0; 4]), ink_of);
            out.ink = out.ink.union(one.ink.placed(1.0, out.advance_em, 0.0));
            out.advance_em += one.advance_em;
            out.glyphs.extend(one.glyphs.into_iter().map(|g| Glyph { text: at..at + c.len_utf8(), ..g }));
        }
        out
    }

    /// What is found of a character once: of a bundled font whether it has it, of one of the author's whether it can draw it too.
    fn known(&self, c: char, find: impl FnOnce(&Loaded) -> bool) -> bool {
        KNOWN.with_borrow_mut(|known| {
            if known.len() >= MOST_RUNS {
                known.clear();
            }
            *known.entry((self.key(), c)).or_insert_with(|| find(self.loaded()))
        })
    }

    /// What a glyph looks like.
    pub fn outline(&self, glyph: u32) -> Rc<Outline> {
        OUTLINES.with_borrow_mut(|outlines| {
            if outlines.len() >= MOST_OUTLINES {
                outlines.clear();
            }
            Rc::clone(outlines.entry((self.key(), glyph)).or_insert_with(|| Rc::new(self.draw(glyph))))
        })
    }

    fn draw(&self, glyph: u32) -> Outline {
        // A character that cannot be drawn has been taken from another font.
        self.loaded().outline(glyph).unwrap_or(Outline { segments: Vec::new(), ink: Ink::NONE })
    }
}

/// How a font draws a character; `None` where it does not have it, or only a damaged one.
fn drawn(loaded: &Loaded, c: char) -> Option<Outline> {
    let glyph = loaded.glyph(c)?;
    let text = String::from(c);
    let run = loaded.shape(&text, |g| loaded.outline(g).map_or(Ink::NONE, |o| o.ink));
    let all = sound(&run, &text) && run.glyphs.iter().all(|g| loaded.outline(g.id).is_some());
    let outline = loaded.outline(glyph.to_u32()).filter(|_| all)?;
    // A letter without ink is a hole in the sentence.
    (outline.ink.any() || c.is_whitespace()).then_some(outline)
}

/// Whether a run's measures are those of letters.
fn sound(run: &Run, text: &str) -> bool {
    let within = |v: f64, most: f64| v.is_finite() && v.abs() <= most;
    let glyph = |g: &Glyph| {
        let place = text.is_char_boundary(g.text.start) && text.is_char_boundary(g.text.end) && g.text.start <= g.text.end;
        place && within(g.advance_em, MOST_EM) && g.offset_em.iter().all(|v| within(*v, MOST_EM))
    };
    run.glyphs.len() <= 4 * text.len() + 4 && run.glyphs.iter().all(glyph) && run.advance_em >= 0.0
}

/// A shaped run of one font.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// The box around all glyphs, the first one's origin at 0.
    pub ink: Ink,
    /// Where the next run begins, in em.
    pub advance_em: f64,
    /// The glyphs by number.
    pub glyphs: Vec<Glyph>,
}

/// A glyph of a shaped run.
#[derive(Clone, Debug, PartialEq)]
pub struct Glyph {
    /// Its number in the font.
    pub id: u32,
    /// From its origin to that of the next one.
    pub advance_em: f64,
    /// From the pen to where it is drawn, y up.
    pub offset_em: [f64; 2],
    /// The bytes of the run's text that it stands for: more than one character for a ligature.
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
            assert!((run.advance_em - advance_em).abs() < 1e-3, "{face:?} {text}: {} em", run.advance_em);
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
