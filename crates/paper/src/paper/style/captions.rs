//! Captions of drawings and headings of tables that a style sets in place of the default ones, for
//! each language.

use crate::paper::phrase::Phrase;
use crate::paper::text;
use crate::paper::words::words;
use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_base::diagram::DiagramKind;
use hodograph_base::json::fields::Fields;
use hodograph_base::json::fields::localized;
use hodograph_base::json::{Node, Word};
use hodograph_base::lang::Lang;

/// Longest caption in characters: a line of A4.
const LONGEST: usize = 80;

/// A part of a sheet with a caption or a heading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Captioned {
    /// A diagram: the mechanism, or a polygon.
    Drawing(DiagramKind),
    /// The equations of a polygon.
    Equations(DiagramKind),
    /// The results.
    Results,
}

/// The captioned parts and their keys in style files.
const ALL: [(&str, Captioned); 6] = [
    ("mechanism", Captioned::Drawing(DiagramKind::Plane)),
    ("velocity", Captioned::Drawing(DiagramKind::Velocity)),
    ("acceleration", Captioned::Drawing(DiagramKind::Acceleration)),
    ("velocity_equations", Captioned::Equations(DiagramKind::Velocity)),
    ("acceleration_equations", Captioned::Equations(DiagramKind::Acceleration)),
    ("results", Captioned::Results),
];

/// The captions that a style gives.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Captions(Vec<(Captioned, Lang, String)>);

impl Captions {
    /// Returns the caption of a drawing or the heading of a list: the style's, else the default.
    pub fn of(&self, what: Captioned, lang: Lang) -> &str {
        let own = self.0.iter().find(|(w, l, _)| (*w, *l) == (what, lang));
        own.map_or_else(|| usual(lang, what), |(.., text)| text)
    }

    /// Reads the section of a style file; a plain text applies to both languages,
    /// `{"en": ..., "zh": ...}` to each its own.
    pub(super) fn read(&mut self, node: &Node, faults: &mut Faults) {
        let keys = ALL.map(|(key, _)| key);
        let Some(f) = Fields::open(node, "\"captions\"", &keys, faults) else { return };
        for (key, what) in ALL {
            let Some(node) = f.get(key) else { continue };
            let texts = localized(node, key, LONGEST, faults)
                .unwrap_or_default()
                .map(|word| word.and_then(|w| sound(w, faults)));
            for (lang, text) in [Lang::En, Lang::Zh].into_iter().zip(texts) {
                let Some(text) = text else { continue };
                self.0.retain(|(w, l, _)| (*w, *l) != (what, lang));
                self.0.push((what, lang, text));
            }
        }
    }
}

fn usual(lang: Lang, what: Captioned) -> &'static str {
    let words = words(lang);
    match what {
        Captioned::Drawing(on) => on.caption(lang),
        Captioned::Equations(on) => words.equations(on),
        Captioned::Results => words.results,
    }
}

/// Returns the caption if it can be typeset, and reports it otherwise.
fn sound(word: Word, faults: &mut Faults) -> Option<String> {
    let Some(fault) = text::set(&Phrase::new(&word.text).label()).faults.first().cloned() else {
        return Some(word.text);
    };
    // A text for both languages is reported once.
    let told = |d: &Diagnostic| d.code == "caption" && d.span == Some(word.span);
    if faults.list.iter().any(told) {
        return None;
    }
    faults.push(
        Diagnostic::error("caption", fault.message)
            .at(word.span)
            .help(both!("write another caption")),
    );
    None
}
