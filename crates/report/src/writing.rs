//! The form of points in a sentence: names in the plain text of a terminal, letters of a formula in
//! figures and documents.

use hodograph_board::plan::names::{name_label, point_label};

/// The form of points in a sentence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum PointForm {
    /// Names.
    Plain,
    /// Letters of a formula between dollar signs ([`hodograph_paper::paper::phrase::Phrase::new`]).
    Marked,
}

impl PointForm {
    /// Returns a point.
    pub(super) fn point(self, name: &str) -> String {
        match self {
            PointForm::Plain => name.to_owned(),
            PointForm::Marked => format!("${}$", point_label(name)),
        }
    }

    /// Returns a letter with an index directly after it: `P24`.
    pub(super) fn letter(self, letter: &str, index: &str) -> String {
        match self {
            PointForm::Plain => format!("{letter}{index}"),
            PointForm::Marked => format!("${letter}_{{{}}}$", name_label(index)),
        }
    }

    /// Returns a letter with its index: `ω_4`.
    pub(super) fn indexed(self, letter: &str, index: &str) -> String {
        match self {
            PointForm::Plain => format!("{letter}_{index}"),
            PointForm::Marked => format!(
                "${}_{{{}}}$",
                if letter == "ω" { "\\omega" } else { letter },
                name_label(index)
            ),
        }
    }
}
