//! The author's own fonts, which take precedence over the embedded ones.
//!
//! A font is accepted if its letters can be drawn. A character that the font does not have, or
//! draws in a damaged way, comes from the embedded fonts; [`Fonts::lacking`] lists these
//! characters. The fonts are part of a style; a label carries its own copy
//! ([`Label::in_fonts`](crate::paper::label::Label::in_fonts)), because it is measured and drawn
//! where no style is available.

use std::collections::BTreeSet;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use skrifa::MetadataProvider;
use skrifa::attribute::Style;
use skrifa::string::StringId;

use super::{Bytes, Cut, Face, LoadedFont, Slant};
use hodograph_base::diag::{Both, Diagnostic, both};

/// Largest size of a font file in bytes: complete Chinese fonts are smaller.
pub const LARGEST: usize = 64 << 20;
/// Largest number of characters listed in the note of [`Fonts::lacking`].
const NAMED_MAX: usize = 12;

/// A font of the author; two fonts are equal if their files are equal.
#[derive(Clone)]
pub struct Own(Arc<FontFile>);

struct FontFile {
    cut: Cut,
    loaded: LoadedFont,
    bytes: Bytes,
    family: String,
    key: u64,
}

impl Own {
    /// Reads a font file.
    ///
    /// # Errors
    /// `font` for a file that is not a font or whose letters cannot be drawn.
    fn read(name: &str, bytes: Vec<u8>) -> Result<Own, Diagnostic> {
        let fault = |what: Both| Diagnostic::error("font", what);
        if bytes.len() > LARGEST {
            return Err(fault(both!("{name} is larger than {} MiB", LARGEST >> 20))
                .help(both!("give a font of the usual size")));
        }
        let key = fingerprint(&bytes);
        let bytes: Bytes = Arc::new(bytes);
        let Some(loaded) = LoadedFont::try_new(Arc::clone(&bytes)) else {
            return Err(fault(both!("{name} is no font that can be read"))
                .help(both!("give an OpenType or TrueType file (.otf, .ttf)")));
        };
        let cut = match loaded.font().attributes().style {
            Style::Normal => Cut::Upright,
            _ => Cut::Slanted,
        };
        let sound = |c: &char| super::drawn(&loaded, *c).is_some();
        if !('a'..='z').chain('A'..='Z').chain('0'..='9').chain("的速度".chars()).any(|c| sound(&c))
        {
            return Err(fault(both!("{name} has no letter and no digit that can be drawn"))
                .help(both!("give a text font")));
        }
        // The name is written to files unescaped: only characters that cannot end an attribute are
        // kept.
        let named = loaded.font().localized_strings(StringId::FAMILY_NAME).english_or_first();
        let letters = named
            .iter()
            .flat_map(|n| n.chars().take(64))
            .filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-'));
        let family = letters.collect::<String>();
        Ok(Own(Arc::new(FontFile { cut, loaded, bytes, family, key })))
    }

    /// Returns the cut of the font: upright or slanted.
    pub fn cut(&self) -> Cut {
        self.0.cut
    }

    /// Returns the name of the font family, for text that is written as text; empty if the font has
    /// none.
    pub fn family(&self) -> &str {
        &self.0.family
    }

    /// Returns a hash of the file, equal on every machine.
    pub fn key(&self) -> u64 {
        self.0.key
    }

    pub(super) fn bytes(&self) -> Bytes {
        Arc::clone(&self.0.bytes)
    }

    pub(super) fn loaded(&self) -> &LoadedFont {
        &self.0.loaded
    }
}

/// Returns the FNV-1a hash in 64 bits (Fowler, Noll, Vo), which distinguishes the few fonts of a
/// program.
fn fingerprint(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, b| {
        (hash ^ u64::from(*b)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

impl fmt::Debug for Own {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{} ({})", self.0.family, self.0.cut.name())
    }
}

impl PartialEq for Own {
    fn eq(&self, other: &Own) -> bool {
        self.0.key == other.0.key
    }
}

impl Eq for Own {}

/// The author's fonts: an upright font for digits, words and upright letters, and a slanted one for
/// the letters of quantities and points; either or both may be absent. Copies share the fonts.
#[derive(Clone, Default)]
pub struct Fonts(Option<Arc<AuthorFonts>>);

#[derive(Default)]
struct AuthorFonts {
    /// The upright and the slanted font.
    cuts: [Option<Own>; 2],
    /// Characters that were requested but are missing in these fonts.
    lacking: Mutex<BTreeSet<char>>,
}

impl fmt::Debug for Fonts {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_list().entries(self.cuts().into_iter().flatten()).finish()
    }
}

impl PartialEq for Fonts {
    fn eq(&self, other: &Fonts) -> bool {
        self.cuts() == other.cuts()
    }
}

impl Fonts {
    fn cuts(&self) -> [Option<&Own>; 2] {
        self.0.as_ref().map_or([None, None], |chosen| chosen.cuts.each_ref().map(Option::as_ref))
    }

    fn of(cuts: [Option<Own>; 2]) -> Fonts {
        let any = cuts.iter().any(Option::is_some);
        Fonts(any.then(|| Arc::new(AuthorFonts { cuts, ..AuthorFonts::default() })))
    }

    /// Returns true if there are no such fonts, so that all text uses the embedded ones.
    pub fn is_empty(&self) -> bool {
        self.0.is_none()
    }

    /// Returns these fonts with the font of a file added.
    ///
    /// # Errors
    /// `font` for a file that is not a font or whose letters cannot be drawn, and for a second font
    /// of the same cut.
    pub fn with(&self, name: &str, bytes: Vec<u8>) -> Result<Fonts, Diagnostic> {
        let own = Own::read(name, bytes)?;
        let cut = own.cut();
        let mut cuts = self.cuts().map(Option::<&Own>::cloned);
        if cuts[cut as usize].replace(own).is_some() {
            let d = Diagnostic::error("font", both!("{name} is the second {} font", cut.name()));
            return Err(d.help(both!("give one upright and one slanted (italic) font at most")));
        }
        Ok(Fonts::of(cuts))
    }

    /// Returns these fonts, with the missing cuts taken from `others`.
    pub fn over(&self, others: &Fonts) -> Fonts {
        let [mut upright, mut slanted] = self.cuts();
        let [other_upright, other_slanted] = others.cuts();
        upright = upright.or(other_upright);
        slanted = slanted.or(other_slanted);
        Fonts::of([upright.cloned(), slanted.cloned()])
    }

    /// Returns the author's font for a character of a slant; `None` if it cannot draw it.
    pub(super) fn face_of(&self, c: char, slant: Slant) -> Option<Face> {
        let chosen = self.0.as_ref()?;
        let cut = match slant {
            // Signs share the axis and weight of the mathematical font.
            Slant::Symbol => return None,
            // A text font file contains no bold of the same design.
            Slant::Bold => return None,
            // Chinese letters are never slanted.
            Slant::Italic if c as u32 >= 0x2E80 => Cut::Upright,
            Slant::Italic => Cut::Slanted,
            Slant::Upright => Cut::Upright,
        };
        let face = Face::Own(chosen.cuts[cut as usize].clone()?);
        if face.known(c, |loaded| super::drawn(loaded, c).is_some()) {
            return Some(face);
        }
        if !c.is_whitespace() {
            chosen.lacking.lock().unwrap_or_else(PoisonError::into_inner).insert(c);
        }
        None
    }

    /// Returns a note that lists the characters missing in these fonts in the text set so far;
    /// `None` if none is missing.
    pub fn lacking(&self) -> Option<Diagnostic> {
        let lacking = self.0.as_ref()?.lacking.lock().unwrap_or_else(PoisonError::into_inner);
        let named: Vec<String> = lacking.iter().take(NAMED_MAX).map(char::to_string).collect();
        let more = lacking.len().saturating_sub(NAMED_MAX);
        let more = if more > 0 { both!(" and {more} more") } else { Both::default() };
        let message =
            both!("the font has no {}{}: set in the bundled fonts", named.join(" "), more);
        (!named.is_empty()).then(|| Diagnostic::note("font-lacks", message))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(face: &Face) -> Vec<u8> {
        (*face.bytes()).as_ref().to_vec()
    }

    #[test]
    fn a_font_is_read_with_its_cut_and_name() {
        let own = Own::read("tinos-italic.ttf", bytes(&Face::Italic)).unwrap();
        assert_eq!((own.cut(), own.family()), (Cut::Slanted, "Tinos"));
        assert_eq!(Own::read("tinos.ttf", bytes(&Face::Roman)).unwrap().cut(), Cut::Upright);
    }

    #[test]
    fn fonts_of_two_styles_do_not_meet() {
        let italic = Fonts::default().with("tinos-italic.ttf", bytes(&Face::Italic)).unwrap();
        let song = Fonts::default().with("song.otf", bytes(&Face::Song)).unwrap();
        assert_ne!(italic, song);
        assert!(matches!(Face::of('v', Slant::Italic, &italic), Some(Face::Own(_))));
        assert_eq!(
            Face::of('v', Slant::Italic, &song),
            Some(Face::Italic),
            "an upright font writes no quantities"
        );
        assert_eq!(Face::of('α', Slant::Upright, &song), Some(Face::Roman));
        assert!(song.lacking().unwrap().message.en.contains('α') && italic.lacking().is_none());
        let both = italic.over(&song);
        assert_eq!(both.cuts(), [song.cuts()[0], italic.cuts()[1]]);
        assert_eq!(both.over(&Fonts::default()), both);
        assert_eq!(both.with("song.otf", bytes(&Face::Song)).unwrap_err().code, "font");
    }

    #[test]
    fn what_is_no_font_is_refused() {
        for bytes in [Vec::new(), b"no font".to_vec(), vec![0; 4096]] {
            assert_eq!(Own::read("x.ttf", bytes).err().unwrap().code, "font");
        }
    }

    #[test]
    fn a_damaged_font_is_refused_or_drawn_in_bounds() {
        // A linear congruential generator (Knuth, MMIX): the same damage on every run.
        let mut state: u64 = 1;
        let mut random = |n: usize| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as usize % n
        };
        for face in [Face::Roman, Face::Song] {
            for _ in 0..24 {
                let mut bytes = bytes(&face);
                let reach = if random(2) == 0 { 2048 } else { bytes.len() };
                for _ in 0..=random(40) {
                    let at = random(reach);
                    bytes[at] = random(256) as u8;
                }
                bytes.truncate(bytes.len() - if random(4) == 0 { random(bytes.len()) } else { 0 });
                let Ok(own) = Own::read("damaged.ttf", bytes) else { continue };
                for c in ('!'..='~').chain("αβω速度".chars()) {
                    if let Some(outline) = super::super::drawn(own.loaded(), c) {
                        assert!(
                            !outline.ink.any()
                                || outline
                                    .ink
                                    .max
                                    .iter()
                                    .chain(&outline.ink.min)
                                    .all(|v| v.abs() <= 8.0)
                        );
                    }
                }
            }
        }
    }
}
