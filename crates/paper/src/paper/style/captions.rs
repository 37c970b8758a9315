//! Names under drawings and over what is written that a style gives in place of the usual ones, for each language.

use crate::diag::{Diagnostic, Faults, both};
use crate::json::fields::{Fields, word};
use crate::json::{Kind, Node};
use crate::mechanism::Level;
use crate::paper::phrase::Phrase;
use crate::paper::text;
use crate::paper::words::{Words, words};
use crate::scene::Lang;

/// Longest caption: a line of A4.
const LONGEST: usize = 80;

/// What has a caption or a heading on a sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Captioned {
    /// The drawing of a level: the kinematic diagram, or a polygon.
    Drawing(Level),
    /// The equations of a level of rates.
    Equations(Level),
    /// The results.
    Results,
}

/// What is captioned, by the words of files.
const ALL: [(&str, Captioned); 6] = [
    ("mechanism", Captioned::Drawing(Level::Position)),
    ("velocity", Captioned::Drawing(Level::Velocity)),
    ("acceleration", Captioned::Drawing(Level::Acceleration)),
    ("velocity_equations", Captioned::Equations(Level::Velocity)),
    ("acceleration_equations", Captioned::Equations(Level::Acceleration)),
    ("results", Captioned::Results),
];
const LANGS: [(&str, Lang); 2] = [("en", Lang::En), ("zh", Lang::Zh)];

/// The captions that a style gives.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Captions(Vec<(Captioned, Lang, String)>);

impl Captions {
    /// What is written at a drawing or a list: the style's words, else the usual ones.
    pub fn of(&self, what: Captioned, lang: Lang) -> &str {
        let own = self.0.iter().find(|(w, l, _)| (*w, *l) == (what, lang));
        own.map_or_else(|| usual(words(lang), what), |(.., text)| text)
    }

    /// Reads the section of a style file; a text counts for both languages, `{"en": ..., "zh": ...}` for each its own.
    pub(super) fn read(&mut self, node: &Node, faults: &mut Faults) {
        let keys = ALL.map(|(key, _)| key);
        let Some(f) = Fields::open(node, "\"captions\"", &keys, faults) else { return };
        for (key, what) in ALL {
            let Some(node) = f.get(key) else { continue };
            let told = format!("`{key}`");
            if matches!(node.kind, Kind::Text(_)) {
                let text = caption(node, &told, faults);
                LANGS.iter().for_each(|(_, lang)| self.put(what, *lang, text.clone()));
            } else if let Some(each) = Fields::open(node, told.as_str(), &LANGS.map(|(l, _)| l), faults) {
                for (name, lang) in LANGS {
                    let text = each.get(name).and_then(|n| caption(n, &told, faults));
                    self.put(what, lang, text);
                }
            }
        }
    }

    fn put(&mut self, what: Captioned, lang: Lang, text: Option<String>) {
        let Some(text) = text else { return };
        self.0.retain(|(w, l, _)| (*w, *l) != (what, lang));
        self.0.push((what, lang, text));
    }
}

fn usual(words: &'static Words, what: Captioned) -> &'static str {
    match what {
        Captioned::Drawing(Level::Position) => words.diagram,
        Captioned::Drawing(level) => words.polygon(level),
        Captioned::Equations(level) => words.equations(level),
        Captioned::Results => words.results,
    }
}

/// A caption that can be set.
fn caption(node: &Node, told: &str, faults: &mut Faults) -> Option<String> {
    let word = word(node, told, faults)?;
    let fault = |message| Diagnostic::error("caption", message).at(word.span).help(both!("write another caption", "请换一个图名"));
    if word.text.chars().count() > LONGEST {
        faults.push(fault(both!("{told} has more than {LONGEST} characters", "{told} 超过 {LONGEST} 个字符")));
        return None;
    }
    match text::set(&Phrase::new(&word.text).label()).faults.first() {
        Some(found) => {
            faults.push(fault(found.message.clone()));
            None
        }
        None => Some(word.text),
    }
}
