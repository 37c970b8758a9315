//! Every code of a diagnostic has its explanation (`hodograph explain`), and every explanation
//! belongs to a code.

use super::{code, files, finish};
use std::collections::{BTreeMap, BTreeSet};

/// Calls in the sources that make a diagnostic with a code, up to the quotation mark.
const MADE: [&str; 3] = ["Diagnostic::error(", "Diagnostic::warning(", "Diagnostic::note("];

/// Files with a function or constant of their own for diagnostics: the text before the code there.
const OWN: &[(&str, &[&str])] = &[
    ("crates/figure/src/gears.rs", &["fault(", "note("]),
    ("crates/mechanism/src/stated/mod.rs", &["const UNPROVEN: &str = "]),
    ("crates/methods/src/equation/read.rs", &["self.fault("]),
    ("crates/methods/src/particle/pursuit.rs", &["const LOST: &str = "]),
    ("crates/methods/src/particle/read.rs", &["self.fault("]),
    ("crates/synthesis/src/judge.rs", &["== Demand::FullTurn { ", "} else { "]),
];

/// The word in quotation marks at the beginning of a text.
pub fn quoted(text: &str) -> Option<&str> {
    text.trim_start().strip_prefix('"')?.split('"').next()
}

/// The codes of the sources, each with a place, and the places without a literal code.
fn codes() -> (BTreeMap<String, String>, Vec<String>) {
    let (mut all, mut open) = (BTreeMap::new(), Vec::new());
    for (file, text) in code() {
        let own = OWN.iter().find(|(name, _)| *name == file).map(|(_, marks)| *marks);
        for mark in MADE.iter().chain(own.unwrap_or_default()) {
            for (at, _) in text.match_indices(mark) {
                let place = format!("{file}:{}", text[..at].lines().count());
                match quoted(&text[at + mark.len()..]) {
                    Some(code) => drop(all.entry(code.to_owned()).or_insert(place)),
                    None if own.is_none() && file != "crates/base/src/diag.rs" => open.push(place),
                    None => {}
                }
            }
        }
    }
    (all, open)
}

#[test]
fn every_code_is_explained() {
    let (codes, open) = codes();
    let texts = files("src/cli/explain", &["txt"]);
    let mut faults: Vec<String> = open
        .iter()
        .map(|at| {
            format!("{at}: the code stands elsewhere: add the file to OWN in tests/tidy/codes.rs")
        })
        .collect();
    let mut explained = BTreeSet::new();
    for (file, text) in &texts {
        let lines: Vec<&str> = text.lines().collect();
        for (n, line) in lines.iter().enumerate() {
            let Some(code) = line.strip_prefix('[').and_then(|l| l.strip_suffix(']')) else {
                continue;
            };
            if !explained.insert(code) {
                faults.push(format!("{file}:{}: {code} is explained twice", n + 1));
            }
            // Title, cause, cure, the three in Chinese, and perhaps an example.
            let chinese = |l: &str| l.chars().any(|c| ('\u{4e00}'..='\u{9fff}').contains(&c));
            let told = |k: usize, mark: &str, zh: bool| {
                lines.get(n + k).is_some_and(|l| {
                    l.starts_with(mark)
                        && l.len() > mark.len() + 2
                        && chinese(l) == zh
                        && !l.starts_with('[')
                })
            };
            let whole =
                [("", false), ("- ", false), ("+ ", false), ("", true), ("- ", true), ("+ ", true)];
            if let Some(k) = (0..6).find(|k| !told(k + 1, whole[*k].0, whole[*k].1)) {
                faults.push(format!("{file}:{}: {code}: title, - cause, + cure, and the three in Chinese are wanted", n + 2 + k));
            }
            let rest = lines.get(n + 7).copied().unwrap_or_default();
            if !(rest.is_empty() || rest.starts_with("> ")) {
                faults.push(format!("{file}:{}: {code}: an example begins with `> `", n + 8));
            }
        }
    }
    faults.extend(
        codes
            .iter()
            .filter(|(code, _)| !explained.contains(code.as_str()))
            .map(|(code, at)| format!("{at}: {code} is not explained")),
    );
    faults.extend(
        explained
            .iter()
            .filter(|code| !codes.contains_key(**code))
            .map(|code| format!("{code} is explained, and no diagnostic has it")),
    );
    assert!(codes.len() > 200, "only {} codes were found", codes.len());
    finish(
        &faults,
        "`hodograph explain` tells cause and cure of every code: src/cli/explain/*.txt.",
    );
}
