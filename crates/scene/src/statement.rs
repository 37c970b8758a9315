//! The problem statement of the author: paragraphs of words and formulas.

use super::Lang;
use hodograph_base::diag::Span;

/// A piece of a statement.
#[derive(Clone, Debug, PartialEq)]
pub enum Run {
    /// Plain words.
    Words(String),
    /// A formula in the label language, with its place in the file: text between dollar signs, or
    /// the value of a parameter.
    Formula(String, Span),
}

/// A statement in both languages; a text given in one language serves for both. Each line is a
/// paragraph.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Statement {
    /// English.
    pub en: Vec<Vec<Run>>,
    /// Chinese.
    pub zh: Vec<Vec<Run>>,
}

impl Statement {
    /// Returns the paragraphs in one language.
    pub fn get(&self, lang: Lang) -> &[Vec<Run>] {
        match lang {
            Lang::En => &self.en,
            Lang::Zh => &self.zh,
        }
    }
}
