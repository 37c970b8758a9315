//! Notation profiles: marks that differ between textbooks, as data.

use crate::lang::Lang;
use serde::Deserialize;

/// A notation profile (table in method.md), read from `crates/base/src/notation/*.json`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Notation {
    /// The name.
    pub name: String,
    /// The pole, before the prime of the acceleration polygon.
    pub pole: String,
    /// Superscript of the Coriolis part.
    pub coriolis: String,
    /// Superscript of tangential parts.
    pub tangential: String,
    /// Superscript of sliding parts.
    pub sliding: String,
    /// The sign for "known" in tables, in the label language.
    pub known: String,
    /// The sign for "unknown".
    pub unknown: String,
    /// The sign between similar triangles.
    pub similar: String,
    /// The end of a normal part if a point is called N, so that n′ is the image of N. In italics ν
    /// is read as v, η is not.
    pub normal_end: String,
    /// The end of the Coriolis part if a point is called K.
    pub coriolis_end: String,
    /// The end of a tangential part if a point is called T.
    pub tangential_end: String,
    /// The end of a sliding part if a point is called R.
    pub sliding_end: String,
    /// Symbol of a reaction before the numbers of its links: F_{R12}. May be empty.
    pub reaction: String,
    /// The first row of an equation table: `magnitude` or `direction`.
    pub first_row: String,
    /// The form of vectors in vector equations, as opposed to their magnitudes.
    pub vectors: Vectors,
}

/// The form of vectors in vector equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Vectors {
    /// The symbol of the magnitude.
    Plain,
    /// In bold italics.
    Bold,
}

impl Vectors {
    /// All forms, with their words in files.
    pub const ALL: [(&'static str, Vectors); 2] =
        [("plain", Vectors::Plain), ("bold", Vectors::Bold)];

    /// Returns the symbol of a vector in the label language: its first letter is the symbol of the
    /// quantity.
    pub fn write(self, symbol: String) -> String {
        match (self, symbol.chars().next()) {
            (Vectors::Bold, Some(letter @ ('a'..='z' | 'A'..='Z'))) => {
                format!("\\bm{{{letter}}}{}", &symbol[1..])
            }
            (Vectors::Plain | Vectors::Bold, _) => symbol,
        }
    }
}

const PROFILES: &[&str] = &[include_str!("notation/en.json"), include_str!("notation/cn.json")];

impl Notation {
    /// Returns the names of the bundled profiles.
    pub fn names() -> Vec<String> {
        all().into_iter().map(|n| n.name).collect()
    }

    /// Returns a bundled profile by name.
    pub fn named(name: &str) -> Option<Notation> {
        all().into_iter().find(|n| n.name == name)
    }

    /// Returns the profile of the textbooks of a language.
    pub fn of_language(lang: Lang) -> Notation {
        Notation::named(match lang {
            Lang::En => "en",
            Lang::Zh => "cn",
        })
        .expect("both languages have a bundled profile")
    }
}

fn all() -> Vec<Notation> {
    PROFILES
        .iter()
        .map(|p| serde_json::from_str(p).expect("bundled profiles are read by a test"))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bundled_profiles_are_complete() {
        assert_eq!(Notation::names(), ["en", "cn"]);
        assert_eq!(Notation::of_language(Lang::Zh).coriolis, "k");
    }
}
