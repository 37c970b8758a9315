//! The form of points in a sentence: names in the plain text of a terminal, letters of a formula in
//! figures and documents.

use hodograph_board::plan::names::{name_label, point_label};

/// The form of points in a sentence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Writing {
    /// Names.
    Plain,
    /// Letters of a formula between dollar signs ([`hodograph_paper::paper::phrase::Phrase::new`]).
    Marked,
}

impl Writing {
    /// Returns a point.
    pub(super) fn point(self, name: &str) -> String {
        match self {
            Writing::Plain => name.to_owned(),
            Writing::Marked => format!("${}$", point_label(name)),
        }
    }

    /// Returns a letter with an index directly after it: `P24`.
    pub(super) fn letter(self, letter: &str, index: &str) -> String {
        match self {
            Writing::Plain => format!("{letter}{index}"),
            Writing::Marked => format!("${letter}_{{{}}}$", name_label(index)),
        }
    }

    /// Returns a letter with its index: `ω_4`.
    pub(super) fn indexed(self, letter: &str, index: &str) -> String {
        match self {
            Writing::Plain => format!("{letter}_{index}"),
            Writing::Marked => format!("${}_{{{}}}$", if letter == "ω" { "\\omega" } else { letter }, name_label(index)),
        }
    }
}
