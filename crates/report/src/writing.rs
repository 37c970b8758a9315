//! How points are written in a sentence: in the plain text of a terminal by their names, in figures and documents as letters of a formula.

use hodograph_board::plan::names::{name_label, point_label};

/// How points are written in a sentence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Writing {
    /// By their names.
    Plain,
    /// As letters of a formula, between dollar signs ([`hodograph_paper::paper::phrase::Phrase::new`]).
    Marked,
}

impl Writing {
    /// A point.
    pub(super) fn point(self, name: &str) -> String {
        match self {
            Writing::Plain => name.to_owned(),
            Writing::Marked => format!("${}$", point_label(name)),
        }
    }

    /// A letter with an index run on: `P24`.
    pub(super) fn letter(self, letter: &str, index: &str) -> String {
        match self {
            Writing::Plain => format!("{letter}{index}"),
            Writing::Marked => format!("${letter}_{{{}}}$", name_label(index)),
        }
    }

    /// A letter with its index: `ω_4`.
    pub(super) fn indexed(self, letter: &str, index: &str) -> String {
        match self {
            Writing::Plain => format!("{letter}_{index}"),
            Writing::Marked => format!("${}_{{{}}}$", if letter == "ω" { "\\omega" } else { letter }, name_label(index)),
        }
    }
}
