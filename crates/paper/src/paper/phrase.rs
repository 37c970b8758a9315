//! Sentences with words and formulas, in one of the two languages.

use crate::paper::label::Label;
use hodograph_base::lang::{Lang, tr};

/// A sentence: words that are printed unchanged, and formulas in the label language.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Phrase {
    pieces: Vec<PhrasePiece>,
}

/// A piece of a sentence.
#[derive(Clone, Debug, PartialEq)]
pub enum PhrasePiece {
    /// Words.
    Words(String),
    /// A formula.
    Formula(String),
}

impl Phrase {
    /// Reads a sentence with formulas between dollar signs: `through $b$ draw a line $\perp BC$`.
    pub fn new(source: &str) -> Phrase {
        let pieces = source
            .split('$')
            .enumerate()
            .filter(|(_, s)| !s.is_empty())
            .map(|(i, s)| {
                if i % 2 == 0 {
                    PhrasePiece::Words(s.into())
                } else {
                    PhrasePiece::Formula(s.into())
                }
            })
            .collect();
        Phrase { pieces }
    }

    /// Returns a sentence of words only; dollar signs do not start a formula.
    pub fn of_words(words: &str) -> Phrase {
        Phrase { pieces: vec![PhrasePiece::Words(words.into())] }
    }

    /// Returns a sentence of these pieces.
    pub fn of_pieces(pieces: Vec<PhrasePiece>) -> Phrase {
        Phrase { pieces }
    }

    /// Returns the sentence with its formulas between dollar signs, as [`Phrase::new`] reads it.
    pub fn source(&self) -> String {
        let piece = |p: &PhrasePiece| match p {
            PhrasePiece::Words(w) => w.clone(),
            PhrasePiece::Formula(f) => format!("${f}$"),
        };
        self.pieces.iter().map(piece).collect()
    }

    /// The pieces of the sentence.
    pub fn pieces(&self) -> &[PhrasePiece] {
        &self.pieces
    }

    /// Returns the sentence as a label for figures.
    pub fn label(&self) -> Label {
        self.pieces.iter().fold(Label::text(""), |l, p| {
            l.then(match p {
                PhrasePiece::Words(w) => Label::text(w.clone()),
                PhrasePiece::Formula(f) => Label::math(f.clone()),
            })
        })
    }

    /// Returns the sentence in plain characters, for terminals and golden texts.
    pub fn plain(&self) -> String {
        self.pieces
            .iter()
            .map(|p| match p {
                PhrasePiece::Words(w) => w.clone(),
                PhrasePiece::Formula(f) => formula(f),
            })
            .collect()
    }
}

/// Returns a formula in plain characters: `ω_1^2 l_AB`.
pub fn formula(source: &str) -> String {
    Label::math(source).plain().trim().to_string()
}

/// Fills the placeholders of a sentence: `{1}` with the value of `1`, `{}` with that of the empty
/// name.
///
/// All are filled in one pass: braces in a value (`$O_{2}B$`) are not placeholders.
pub fn fill(sentence: &str, values: &[(&str, &str)]) -> String {
    let mut out = String::with_capacity(sentence.len());
    let mut rest = sentence;
    while let Some(open) = rest.find('{') {
        let (before, from) = rest.split_at(open);
        let close = from.find('}').unwrap_or(0);
        let value = values
            .iter()
            .find(|(name, _)| from.get(1..close) == Some(name))
            .map(|(_, value)| value);
        out.push_str(before);
        match value {
            Some(value) => out.push_str(value),
            None => out.push('{'),
        }
        rest = &from[if value.is_some() { close + 1 } else { 1 }..];
    }
    out + rest
}

/// Returns the text with a capital first letter.
pub fn capital(text: &str) -> String {
    let mut rest = text.chars();
    let first = rest.next().map(|c| c.to_ascii_uppercase());
    first.into_iter().chain(rest).collect()
}

/// Returns the words for a sense of rotation.
pub fn sense(lang: Lang, value: f64) -> &'static str {
    if value > 0.0 {
        tr!(lang, "counter-clockwise")
    } else if value < 0.0 {
        tr!(lang, "clockwise")
    } else {
        tr!(lang, "zero")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_filled_at_once() {
        let values = [("1", "$O_{2}P_{1}$"), ("2", "{1}"), ("", "{2}")];
        assert_eq!(
            fill("{} where {1} and {2} meet; {3}", &values),
            "{2} where $O_{2}P_{1}$ and {1} meet; {3}"
        );
        assert_eq!(fill("{} {", &values), "{2} {");
        assert_eq!(fill("}{", &[]), "}{");
    }
}
