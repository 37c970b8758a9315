//! Fonts of the author's own: read once when the program starts, then asked before the embedded ones.
//!
//! Decided here: what is accepted (a font whose letters can be drawn), and that a character that a font does not have, or draws
//! in a damaged way, comes from the embedded fonts; [`lacking`] says which. Fonts are the same for all figures of a process.

use std::collections::BTreeSet;
use std::sync::{Mutex, OnceLock, PoisonError};

use skrifa::font::attribute::Style;
use skrifa::font::name::NameId;

use super::{Cut, Face, Loaded, Slant};
use crate::diag::Diagnostic;

/// The largest font file that is read: whole Chinese fonts are smaller.
pub const LARGEST: usize = 64 << 20;
/// Characters named in [`lacking`]'s note.
const NAMED_MAX: usize = 12;

/// A font of the author's.
pub(super) struct Own {
    pub loaded: Loaded,
    pub bytes: &'static [u8],
    family: String,
}

/// Upright and slanted.
static FONTS: OnceLock<[Option<Own>; 2]> = OnceLock::new();
/// Characters that were wanted of them in vain.
static LACKING: Mutex<BTreeSet<char>> = Mutex::new(BTreeSet::new());

pub(super) fn font(cut: Cut) -> Option<&'static Own> {
    FONTS.get()?[cut as usize].as_ref()
}

/// Reads fonts, each a file's name and its bytes, and sets all figures of the process in them: an upright one for digits, words and
/// upright letters, a slanted one for the letters of quantities and points. Call it before any label is set.
///
/// # Errors
/// `font` for a file that is none or whose letters cannot be drawn, for two of one cut, and when called again.
pub fn install(files: Vec<(String, Vec<u8>)>) -> Result<(), Diagnostic> {
    let mut fonts = [None, None];
    for (name, bytes) in files {
        let (cut, own) = read(&name, bytes)?;
        if fonts[cut as usize].replace(own).is_some() {
            let d = Diagnostic::error("font", format!("{name} is the second {} font", cut.name()));
            return Err(d.help("give one upright and one slanted (italic) font at most"));
        }
    }
    FONTS.set(fonts).map_err(|_| Diagnostic::error("font", "the fonts of this process are chosen already"))
}

/// The font in a file, and whether it is a slanted one.
pub(super) fn read(name: &str, bytes: Vec<u8>) -> Result<(Cut, Own), Diagnostic> {
    let fault = |what: String| Diagnostic::error("font", what);
    if bytes.len() > LARGEST {
        return Err(fault(format!("{name} is larger than {} MiB", LARGEST >> 20)).help("give a font of the usual size"));
    }
    // It is kept as long as the process, as the embedded ones are.
    let bytes: &'static [u8] = Box::leak(bytes.into_boxed_slice());
    let Some(loaded) = Loaded::try_new(bytes) else {
        return Err(fault(format!("{name} is no font that can be read")).help("give an OpenType or TrueType file (.otf, .ttf)"));
    };
    let cut = match loaded.font.default_attributes().style {
        Style::Normal => Cut::Upright,
        _ => Cut::Slanted,
    };
    let sound = |c: &char| super::drawn(&loaded, *c).is_some();
    if !('a'..='z').chain('A'..='Z').chain('0'..='9').chain("的速度".chars()).any(|c| sound(&c)) {
        return Err(fault(format!("{name} has no letter and no digit that can be drawn")).help("give a text font"));
    }
    // A name goes into files as it is: nothing in it may end an attribute.
    let named = loaded.font.names().get(NameId::FAMILY_NAME).and_then(|n| n.english_or_first());
    let letters = named.iter().flat_map(|n| n.name().chars().take(64)).filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-'));
    let family = letters.collect::<String>();
    Ok((cut, Own { loaded, bytes, family }))
}

/// The cut of the author's fonts that writes a character of a slant.
pub(super) fn face_of(c: char, slant: Slant) -> Option<Face> {
    let cuts: &[Cut] = match slant {
        _ if FONTS.get().is_none() => return None,
        // Signs share the axis and weight of the mathematical font.
        Slant::Symbol => return None,
        // Chinese letters are never slanted.
        Slant::Italic if c as u32 >= 0x2E80 => &[Cut::Upright],
        Slant::Italic => &[Cut::Slanted],
        Slant::Upright => &[Cut::Upright],
    };
    let known = cuts.iter().copied().filter(|cut| font(*cut).is_some());
    let mut wanted = known.clone().peekable();
    wanted.peek()?;
    let found = wanted.find(|cut| Face::Own(*cut).draws(c));
    if found.is_none() && !c.is_whitespace() {
        LACKING.lock().unwrap_or_else(PoisonError::into_inner).insert(c);
    }
    found.map(Face::Own)
}

/// The family's name, for text that stays text; empty where the font does not tell.
pub fn family(cut: Cut) -> &'static str {
    font(cut).map_or("", |own| &own.family)
}

/// What the author's fonts did not have, so far; `None` where they had everything.
pub fn lacking() -> Option<Diagnostic> {
    let lacking = LACKING.lock().unwrap_or_else(PoisonError::into_inner);
    let named: Vec<String> = lacking.iter().take(NAMED_MAX).map(char::to_string).collect();
    let more = lacking.len().saturating_sub(NAMED_MAX);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    let message = format!("the font has no {}{more}: set in the bundled fonts", named.join(" "));
    (!named.is_empty()).then(|| Diagnostic::note("font-lacks", message))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_font_is_read_with_its_cut_and_name() {
        let (cut, own) = read("tinos-italic.ttf", Face::Italic.bytes().to_vec()).unwrap();
        assert_eq!((cut, own.family.as_str()), (Cut::Slanted, "Tinos"));
        assert_eq!(read("tinos.ttf", Face::Roman.bytes().to_vec()).unwrap().0, Cut::Upright);
    }

    #[test]
    fn what_is_no_font_is_refused() {
        for bytes in [Vec::new(), b"no font".to_vec(), vec![0; 4096]] {
            assert_eq!(read("x.ttf", bytes).err().unwrap().code, "font");
        }
    }

    #[test]
    fn a_damaged_font_is_refused_or_drawn_in_bounds() {
        // A linear congruential generator (Knuth, MMIX): the same damage every time.
        let mut state: u64 = 1;
        let mut random = |n: usize| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as usize % n
        };
        for face in [Face::Roman, Face::Song] {
            for _ in 0..24 {
                let mut bytes = face.bytes().to_vec();
                let reach = if random(2) == 0 { 2048 } else { bytes.len() };
                for _ in 0..=random(40) {
                    let at = random(reach);
                    bytes[at] = random(256) as u8;
                }
                bytes.truncate(bytes.len() - if random(4) == 0 { random(bytes.len()) } else { 0 });
                let Ok((_, own)) = read("damaged.ttf", bytes) else { continue };
                for c in ('!'..='~').chain("αβω速度".chars()) {
                    if let Some(outline) = super::super::drawn(&own.loaded, c) {
                        assert!(!outline.ink.any() || outline.ink.max.iter().chain(&outline.ink.min).all(|v| v.abs() <= 8.0));
                    }
                }
            }
        }
    }
}
