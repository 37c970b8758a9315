//! Sentences that mix words and formulas, in one of the two languages.

use crate::paper::label::Label;
use hodograph_base::lang::Lang;

/// A sentence: words as they stand, formulas in the label language.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Phrase {
    pieces: Vec<Piece>,
}

/// A piece of a sentence.
#[derive(Clone, Debug, PartialEq)]
pub enum Piece {
    /// Words.
    Words(String),
    /// A formula.
    Formula(String),
}

impl Phrase {
    /// A sentence with formulas between dollar signs: `through $b$ draw a line $\perp BC$`.
    pub fn new(source: &str) -> Phrase {
        let pieces = source
            .split('$')
            .enumerate()
            .filter(|(_, s)| !s.is_empty())
            .map(|(i, s)| if i % 2 == 0 { Piece::Words(s.into()) } else { Piece::Formula(s.into()) })
            .collect();
        Phrase { pieces }
    }

    /// Words as they stand, dollar signs too: no formula begins in them.
    pub fn of_words(words: &str) -> Phrase {
        Phrase { pieces: vec![Piece::Words(words.into())] }
    }

    /// A sentence of these pieces.
    pub fn of_pieces(pieces: Vec<Piece>) -> Phrase {
        Phrase { pieces }
    }

    /// The sentence with its formulas between dollar signs, as [`Phrase::new`] reads it.
    pub fn source(&self) -> String {
        let piece = |p: &Piece| match p {
            Piece::Words(w) => w.clone(),
            Piece::Formula(f) => format!("${f}$"),
        };
        self.pieces.iter().map(piece).collect()
    }

    /// Its pieces.
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// As a label for figures.
    pub fn label(&self) -> Label {
        self.pieces.iter().fold(Label::text(""), |l, p| {
            l.then(match p {
                Piece::Words(w) => Label::text(w.clone()),
                Piece::Formula(f) => Label::math(f.clone()),
            })
        })
    }

    /// In plain characters, for terminals and golden texts.
    pub fn plain(&self) -> String {
        self.pieces
            .iter()
            .map(|p| match p {
                Piece::Words(w) => w.clone(),
                Piece::Formula(f) => formula(f),
            })
            .collect()
    }
}

/// A formula in plain characters: `ω_1^2 l_AB`.
pub fn formula(source: &str) -> String {
    Label::math(source).plain().trim().to_string()
}

/// A sentence with its places filled: `{1}` by the value of `1`, `{}` by that of the empty name.
///
/// All at once: a value may hold braces of its own (`$O_{2}B$`), which are no places.
pub fn fill(sentence: &str, values: &[(&str, &str)]) -> String {
    let mut out = String::with_capacity(sentence.len());
    let mut rest = sentence;
    while let Some(open) = rest.find('{') {
        let (before, from) = rest.split_at(open);
        let close = from.find('}').unwrap_or(0);
        let value = values.iter().find(|(name, _)| from.get(1..close) == Some(name)).map(|(_, value)| value);
        out.push_str(before);
        match value {
            Some(value) => out.push_str(value),
            None => out.push('{'),
        }
        rest = &from[if value.is_some() { close + 1 } else { 1 }..];
    }
    out + rest
}

/// One of two texts by language.
pub fn tr(lang: Lang, en: &'static str, zh: &'static str) -> &'static str {
    match lang {
        Lang::En => en,
        Lang::Zh => zh,
    }
}

/// A text that begins with a capital.
pub fn capital(text: &str) -> String {
    let mut rest = text.chars();
    let first = rest.next().map(|c| c.to_ascii_uppercase());
    first.into_iter().chain(rest).collect()
}

/// The words for a sense of turning.
pub fn sense(lang: Lang, value: f64) -> &'static str {
    if value > 0.0 {
        tr(lang, "counter-clockwise", "逆时针")
    } else if value < 0.0 {
        tr(lang, "clockwise", "顺时针")
    } else {
        tr(lang, "zero", "为零")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_filled_at_once() {
        let values = [("1", "$O_{2}P_{1}$"), ("2", "{1}"), ("", "{2}")];
        assert_eq!(fill("{} where {1} and {2} meet; {3}", &values), "{2} where $O_{2}P_{1}$ and {1} meet; {3}");
        assert_eq!(fill("{} {", &values), "{2} {");
        assert_eq!(fill("}{", &[]), "}{");
    }
}
