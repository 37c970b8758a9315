//! Sentences as HTML.

use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::phrase::{Phrase, PhrasePiece};
use hodograph_paper::render::escaped;

use hodograph_paper::render::math::mathml;

/// Word joiner between a formula and its punctuation: browsers may otherwise break a line beside
/// any formula (CSS Text, 5.1).
const JOINER: &str = "&#x2060;";

/// Returns a sentence as HTML, with its formulas written by `formula`.
pub fn sentence_with(phrase: &Phrase, mut formula: impl FnMut(&str) -> String) -> String {
    let pieces = phrase.pieces();
    let is_formula = |k: Option<usize>| {
        k.and_then(|k| pieces.get(k)).is_some_and(|p| matches!(p, PhrasePiece::Formula(_)))
    };
    let mut out = String::new();
    for (k, piece) in pieces.iter().enumerate() {
        match piece {
            PhrasePiece::Formula(source) => out.push_str(&formula(source)),
            PhrasePiece::Words(words) => {
                let closes = words.starts_with([
                    ',', '.', ';', ':', '?', '!', ')', ']', '”', '’', '，', '。', '、', '；', '：',
                    '）', '》', '」',
                ]);
                let opens = words.ends_with(['(', '[', '“', '‘', '（', '《', '「']);
                out.extend((closes && is_formula(k.checked_sub(1))).then_some(JOINER));
                out.push_str(&escaped(words));
                out.extend((opens && is_formula(Some(k + 1))).then_some(JOINER));
            }
        }
    }
    out
}

/// Returns a sentence as HTML with MathML.
pub fn sentence(phrase: &Phrase) -> String {
    sentence_with(phrase, |source| mathml(&Label::math(source)))
}
