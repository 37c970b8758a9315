//! The problem as its author states it: paragraphs of words and formulas.

use super::Lang;
use hodograph_base::diag::Span;

/// A piece of a statement.
#[derive(Clone, Debug, PartialEq)]
pub enum Run {
    /// Words as they stand.
    Words(String),
    /// A formula in the label language, with its place in the file: written between dollar signs, or the value of a parameter.
    Formula(String, Span),
}

/// A statement in both languages; a scene that gives one gets it in both. Each line is a paragraph.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Statement {
    /// English.
    pub en: Vec<Vec<Run>>,
    /// Chinese.
    pub zh: Vec<Vec<Run>>,
}

impl Statement {
    /// The paragraphs in one language.
    pub fn get(&self, lang: Lang) -> &[Vec<Run>] {
        match lang {
            Lang::En => &self.en,
            Lang::Zh => &self.zh,
        }
    }
}
