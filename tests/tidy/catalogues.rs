//! The catalogues of Chinese texts, `po/zh.po` of each crate. That each text has a translation the
//! compiler sees; here the catalogues are checked to be in order, without leftovers, and to hold
//! all Chinese of the program.

use super::{code, files, finish, root, sources};
use std::collections::BTreeSet;

/// Files with Chinese of their own, each with the reason.
const CHINESE_ALLOWED: &[(&str, &str)] = &[
    ("src/cli/help.rs", "errors of the argument parser, whose English is clap's"),
    ("src/cli/template.rs", "kinds of templates, in both languages at once"),
    ("src/lesson/player.rs", "the name of the language to switch to"),
    ("src/lesson/words.rs", "the name of the language to switch to"),
    ("src/homework/", "columns and words accepted in files of answers"),
    ("crates/base/src/json/mod.rs", "errors of the JSON reader, whose English is the reader's"),
    ("crates/paper/src/paper/font/own.rs", "sample characters of a font"),
    ("crates/scene/src/expr/read.rs", "words accepted in scenes"),
];

/// The line of `lib.rs` that makes the catalogue a source of the crate.
const INCLUDED: &str = concat!("const _: &str = include", "_str!(\"../po/zh.po\");");

/// A text of a catalogue.
pub struct CatalogueEntry {
    pub file: String,
    pub line: usize,
    pub context: String,
    pub en: String,
    pub zh: String,
}

/// All texts of all catalogues, as they are written, with escapes.
pub fn entries() -> Vec<CatalogueEntry> {
    let folders = ["po", "python/po", "web/engine/po", "crates"];
    let mut catalogues = folders.map(|folder| files(folder, &["po"])).concat();
    // The texts of the help, whose English is in attributes of the arguments, have tests in src/cli/help.rs.
    catalogues.retain(|(file, _)| file != "po/help.zh.po");
    assert!(catalogues.len() > 10, "only {} catalogues", catalogues.len());
    let of = |(file, text): (String, String)| {
        let mut found = Vec::new();
        let (mut context, mut en) = (String::new(), String::new());
        for (line, at) in text.lines().zip(1..) {
            let quoted = |word: &str| {
                Some(line.strip_prefix(word)?.strip_prefix('"')?.strip_suffix('"')?.to_owned())
            };
            if let Some(text) = quoted("msgctxt ") {
                context = text;
            } else if let Some(text) = quoted("msgid ") {
                en = text;
            } else if let Some(zh) = quoted("msgstr ") {
                let (context, en) = (std::mem::take(&mut context), std::mem::take(&mut en));
                found.push(CatalogueEntry { file: file.clone(), line: at, context, en, zh });
            }
        }
        // The first entry is the header.
        found.remove(0);
        found
    };
    catalogues.into_iter().flat_map(of).collect()
}

/// A text without its escapes.
fn value(text: &str) -> String {
    text.replace("\\n", "\n").replace("\\\"", "\"").replace("\\\\", "\\")
}

fn is_chinese(c: char) -> bool {
    ('\u{4e00}'..='\u{9fff}').contains(&c)
}

#[test]
fn what_is_said_in_english_is_said_in_chinese() {
    // Words outside of quotations and placeholders.
    let english = |text: &str| {
        let kept: String = text
            .split('`')
            .step_by(2)
            .flat_map(|t| t.split('{').map(|t| t.split_once('}').map_or(t, |t| t.1)))
            .collect();
        super::words(&kept)
            .any(|(_, w, _)| w.len() > 2 && w.chars().all(|c| c.is_ascii_lowercase()))
    };
    let faults: Vec<String> = entries()
        .iter()
        .filter(|e| english(&e.en) && !e.zh.contains(is_chinese) && !e.zh.contains('{'))
        .map(|e| format!("{}:{}: {:?} has no Chinese but {:?}", e.file, e.line, e.en, e.zh))
        .collect();
    finish(&faults, "Every text is in both languages.");
}

#[test]
fn catalogues_are_sorted_and_have_no_leftovers() {
    let mut faults = Vec::new();
    let mut last: Option<CatalogueEntry> = None;
    let mut source = (String::new(), String::new());
    for e in entries() {
        let folder = e.file.trim_end_matches("po/zh.po");
        if source.0 != e.file {
            let texts = files(&format!("{folder}src"), &["rs"]).into_iter().map(|(_, text)| text);
            // A literal that is continued on the next line has the spaces of neither.
            let joined = |text: String| {
                let mut parts = text.split("\\\n");
                let first = parts.next().unwrap_or_default().to_owned();
                parts.fold(first, |all, part| all + part.trim_start())
            };
            source = (e.file.clone(), texts.map(joined).collect());
        }
        let place = format!("{}:{}: {:?}", e.file, e.line, e.en);
        if !source.1.contains(&format!("\"{}\"", e.en)) {
            faults.push(format!("{place} is not in the sources of {folder}src"));
        }
        if let Some(before) = last.as_ref().filter(|b| b.file == e.file)
            && (value(&before.en), &before.context) >= (value(&e.en), &e.context)
        {
            faults.push(format!("{place} comes before {:?}", before.en));
        }
        last = Some(e);
    }
    finish(&faults, "Texts of a catalogue are sorted; a text that is not used is removed.");
}

#[test]
fn chinese_is_in_the_catalogues() {
    let mut used = BTreeSet::new();
    let mut faults = Vec::new();
    for (file, text) in code() {
        let allowed = CHINESE_ALLOWED.iter().find(|(of, _)| file.starts_with(of));
        for (line, at) in text.lines().zip(1..).filter(|(l, _)| l.contains(is_chinese)) {
            match allowed {
                Some((of, _)) => drop(used.insert(*of)),
                None => faults.push(format!("{file}:{at}: {}", line.trim())),
            }
        }
    }
    faults.extend(
        CHINESE_ALLOWED
            .iter()
            .filter(|(of, _)| !used.contains(of))
            .map(|(of, _)| format!("{of} has no Chinese: remove it from CHINESE_ALLOWED")),
    );
    finish(
        &faults,
        "A text is written in English, `both!(\"...\")`, `say!`, `tr!` or `each!`; its Chinese is in po/zh.po of the crate.",
    );
}

#[test]
fn each_crate_is_compiled_again_when_its_catalogue_changes() {
    let mut faults = Vec::new();
    for file in entries().iter().map(|e| e.file.clone()).collect::<BTreeSet<_>>() {
        let lib = file.replace("po/zh.po", "src/lib.rs");
        let text = std::fs::read_to_string(root().join(&lib)).unwrap();
        if !text.contains(INCLUDED) {
            faults.push(format!("{lib} lacks {INCLUDED}"));
        }
    }
    finish(&faults, "Cargo knows of a catalogue by a line in lib.rs.");
    assert!(sources(&["po"]).len() > 10);
}
