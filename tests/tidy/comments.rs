//! Doc comments in the form of the standard library, and type names with one meaning.

use super::{files, finish, sources};
use std::collections::BTreeMap;

/// Openings of a doc comment that do not say what an item is or returns.
const OPENINGS: &[&str] = &[
    "What ",
    "Whether ",
    "The same",
    "Of ",
    "That ",
    "How ",
    "Where ",
    "Those ",
    "Which ",
    "By which ",
    "As ",
    "So ",
];

/// Words that are no terms of the field or of programming.
const DIALECT: &[&str] = &["told", "room", "rooms", "house", "door", "doors", "pricked"];

/// The greatest number of type names that are defined more than once, each in a module of its own.
const NAMES_TWICE: usize = 80;

/// A comment without code in backticks and without links.
fn words_only(comment: &str) -> String {
    comment.split('`').step_by(2).collect::<Vec<_>>().join("X")
}

/// The text of a doc comment's line.
fn doc(line: &str) -> Option<&str> {
    let line = line.trim_start();
    line.strip_prefix("///").or_else(|| line.strip_prefix("//!"))
}

/// The sources of the crates and the program.
fn product() -> impl Iterator<Item = (String, String)> {
    sources(&["rs"])
        .into_iter()
        .filter(|(name, _)| name.starts_with("src/") || name.starts_with("crates/"))
}

#[test]
fn doc_comments_say_what_an_item_is() {
    let (mut faults, mut seen) = (Vec::new(), 0);
    for (file, text) in product() {
        let (mut before, mut code) = (false, false);
        for (n, line) in text.lines().enumerate() {
            let Some(said) = doc(line) else {
                before = false;
                continue;
            };
            code ^= said.trim_start().starts_with("```");
            let (first, said) = (!std::mem::replace(&mut before, true), words_only(said.trim()));
            if code {
                continue;
            }
            seen += 1;
            let opening = OPENINGS.iter().find(|o| first && said.starts_with(**o));
            let dialect = DIALECT
                .iter()
                .find(|d| said.split(|c: char| !c.is_alphanumeric()).any(|w| w == **d));
            faults.extend(
                opening
                    .or(dialect)
                    .map(|word| format!("{file}:{}: `{}` in: {said}", n + 1, word.trim())),
            );
        }
    }
    assert!(seen > 10_000, "only {seen} lines");
    finish(
        &faults,
        "A doc comment begins with a verb or a noun: what the item returns or is. Its words are those of the field.",
    );
}

/// The type that a line at the top of a module, or within one, defines.
fn defined(line: &str) -> Option<&str> {
    let item = line.trim_start();
    let item = item
        .strip_prefix("pub(")
        .and_then(|rest| rest.split_once(") "))
        .map_or(item, |(_, rest)| rest);
    let item = item.strip_prefix("pub ").unwrap_or(item);
    let (keyword, rest) = item.split_once(' ')?;
    let associated = keyword == "type" && line.starts_with(' ');
    let name = super::word(rest);
    (["struct", "enum", "trait", "type"].contains(&keyword)
        && !associated
        && name.starts_with(|c: char| c.is_uppercase()))
    .then_some(name)
}

#[test]
fn type_names_have_one_meaning() {
    let mut places: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (file, text) in product() {
        for (n, line) in text.lines().enumerate() {
            if let Some(name) = defined(line) {
                places.entry(name.to_owned()).or_default().push(format!("{file}:{}", n + 1));
            }
        }
    }
    assert!(places.len() > 600, "only {} types", places.len());
    let twice: Vec<String> = places
        .into_iter()
        .filter(|(_, at)| at.len() > 1)
        .map(|(name, at)| format!("{name}: {}", at.join(" ")))
        .collect();
    let faults = if twice.len() > NAMES_TWICE { twice } else { Vec::new() };
    finish(&faults, "A type's name says of what it is: at most 80 names have two definitions.");
}

/// Comments and documents tell no history.
#[test]
fn no_document_tells_history() {
    let mut faults = Vec::new();
    for (file, text) in files("docs", &["md"]) {
        for (n, line) in text.lines().enumerate() {
            let found = ["no longer", "used to be", "in earlier versions"]
                .into_iter()
                .find(|w| line.contains(w));
            faults.extend(found.map(|w| format!("{file}:{}: `{w}`", n + 1)));
        }
    }
    finish(&faults, "Documents say how things are.");
}
