//! Notation profiles: marks that differ between textbooks, as data.

use crate::lang::Lang;
use serde::Deserialize;

/// A notation profile (method.md's table): read from `crates/base/src/notation/*.json`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Notation {
    /// Its name.
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
    /// The end of a normal part where a point is called N, so that n′ is its image. In italics ν is read as v: η is not.
    pub normal_end: String,
    /// The same for the Coriolis part and a point K.
    pub coriolis_end: String,
    /// For a tangential part and a point T.
    pub tangential_end: String,
    /// For a sliding part and a point R.
    pub sliding_end: String,
    /// Index of a reaction before the numbers of its links: F_{R12}. May be empty.
    pub reaction: String,
    /// Which row of an equation table comes first: `magnitude` or `direction`.
    pub first_row: String,
    /// How vectors are told from their magnitudes in vector equations.
    pub vectors: Vectors,
}

/// How vectors are written in vector equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Vectors {
    /// As their magnitudes.
    Plain,
    /// In bold italics.
    Bold,
}

impl Vectors {
    /// All of them, by the words of files.
    pub const ALL: [(&'static str, Vectors); 2] = [("plain", Vectors::Plain), ("bold", Vectors::Bold)];

    /// The symbol of a vector, in the label language: its first letter is that of the quantity.
    pub fn write(self, symbol: String) -> String {
        match (self, symbol.chars().next()) {
            (Vectors::Bold, Some(letter @ ('a'..='z' | 'A'..='Z'))) => format!("\\bm{{{letter}}}{}", &symbol[1..]),
            (Vectors::Plain | Vectors::Bold, _) => symbol,
        }
    }
}

const PROFILES: &[&str] = &[include_str!("notation/en.json"), include_str!("notation/cn.json")];

impl Notation {
    /// The names of the bundled profiles.
    pub fn names() -> Vec<String> {
        all().into_iter().map(|n| n.name).collect()
    }

    /// A bundled profile by name.
    pub fn named(name: &str) -> Option<Notation> {
        all().into_iter().find(|n| n.name == name)
    }

    /// The profile that a language's textbooks use.
    pub fn of_language(lang: Lang) -> Notation {
        Notation::named(match lang {
            Lang::En => "en",
            Lang::Zh => "cn",
        })
        .expect("both languages have a bundled profile")
    }
}

fn all() -> Vec<Notation> {
    PROFILES.iter().map(|p| serde_json::from_str(p).expect("bundled profiles are read by a test")).collect()
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
