//! Compares the list of modules in the crate's documentation with the files: their crates and their
//! imports.

use super::{code, finish, is_word, root, sources, word};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

/// Imports that no table may ever allow, with the reason.
const NEVER: &[(&str, &str, &str)] = &[
    (
        "construct",
        "analytic",
        "their agreement is evidence only because the drawing does not know the loop equations",
    ),
    (
        "analytic",
        "construct",
        "their agreement is evidence only because the loop equations do not know the drawing",
    ),
    (
        "analytic",
        "plan",
        "the loop equations share the mechanism and its positions with the drawing, nothing else",
    ),
    ("stated", "motion", "what proves positions shares nothing with what finds them"),
    ("plan", "number", "a plan holds no numbers"),
    ("plan", "position", "a plan holds no numbers"),
];

/// A file's path in its crate: `module/...` or `module.rs`; any path in a crate that is a single
/// module.
fn in_crate(file: &str) -> &str {
    file.split_once("src/").expect("a file of a library").1
}

/// The crate of a file, by its folder; that of the root package is `.`.
pub fn crate_of(file: &str) -> &str {
    match file.strip_prefix("crates/").unwrap_or(file).split_once('/') {
        Some((name, _)) if name != "src" => name,
        _ => ".",
    }
}

/// The module of a file.
fn room_of(file: &str) -> &str {
    if whole().contains(crate_of(file)) { crate_of(file) } else { word(in_crate(file)) }
}

/// The modules in paths to the root of a crate, its own or another; braces hold several.
fn imports(file: &str, code: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    for (i, _) in code.match_indices("hodograph_") {
        let (line, name) =
            (code[..i].matches('\n').count() + 1, word(&code[i + "hodograph_".len()..]));
        let rest = &code[i + "hodograph_".len() + name.len()..];
        match rest.strip_prefix("::") {
            _ if whole().contains(name) => found.push((line, name.to_owned())),
            Some(rest) => found.extend(first_words(rest).map(|room| (line, room.to_owned()))),
            None => found.push((line, name.to_owned())),
        }
    }
    if whole().contains(crate_of(file)) {
        return found;
    }
    // A module's own file is one step below the root.
    let depth = 1 + in_crate(file).matches('/').count() - usize::from(file.ends_with("/mod.rs"));
    let to_root = "super::".repeat(depth);
    for door in ["crate::", to_root.as_str()] {
        for (i, _) in code.match_indices(door) {
            if code[..i].ends_with(is_word) || code[..i].ends_with("::") || code[..i].ends_with('$')
            {
                continue;
            }
            let line = code[..i].matches('\n').count() + 1;
            found.extend(first_words(&code[i + door.len()..]).map(|room| (line, room.to_owned())));
        }
    }
    found
}

/// The first word of a path, or of each path of a list in braces.
fn first_words(path: &str) -> impl Iterator<Item = &str> {
    let (mut level, mut at_start, mut found) = (0, true, Vec::new());
    let Some(list) = path.strip_prefix('{') else { return vec![word(path)].into_iter() };
    for (k, c) in list.char_indices() {
        match c {
            '{' => level += 1,
            '}' if level == 0 => break,
            '}' => level -= 1,
            ',' if level == 0 => at_start = true,
            c if is_word(c) && at_start => {
                found.push(word(&list[k..]));
                at_start = false;
            }
            _ => {}
        }
    }
    found.into_iter()
}

/// The modules of each crate by the documentation, by the crate's folder.
fn told_crates() -> BTreeMap<String, BTreeSet<String>> {
    let chapter = chapter("# Crates");
    let block = chapter
        .split("```")
        .nth(1)
        .expect("a block with the table")
        .strip_prefix("text\n")
        .expect("text");
    let row = |line: &str| {
        let mut words = line.split_whitespace().map(str::to_owned);
        (words.next().expect("a crate"), words.collect())
    };
    block.lines().map(row).collect()
}

/// Crates that are a single module, with their submodules at the top.
pub fn whole() -> &'static BTreeSet<String> {
    static WHOLE: OnceLock<BTreeSet<String>> = OnceLock::new();
    WHOLE.get_or_init(|| {
        told_crates()
            .into_iter()
            .filter(|(name, rooms)| rooms.iter().eq([name]))
            .map(|(name, _)| name)
            .collect()
    })
}

/// The modules of each crate: those that its `src/lib.rs` declares, or itself; the root package is
/// `.`.
fn crates() -> BTreeMap<String, BTreeSet<String>> {
    let mut all = BTreeMap::new();
    for (name, text) in
        sources(&["rs"]).into_iter().filter(|(name, _)| name.ends_with("src/lib.rs"))
    {
        let folder = crate_of(&name).to_owned();
        let declared =
            text.lines().filter_map(|l| l.strip_prefix("pub mod ").or(l.strip_prefix("mod ")));
        let declared = declared.map(|l| l.trim_end_matches(';').to_owned());
        let rooms = if whole().contains(&folder) {
            BTreeSet::from([folder.clone()])
        } else {
            declared.collect()
        };
        all.insert(folder, rooms);
    }
    all
}

fn rooms() -> BTreeSet<String> {
    crates().into_values().flatten().collect()
}

/// The part of the crate's documentation under a heading.
fn chapter(heading: &str) -> String {
    let lib = std::fs::read_to_string(root().join("src/lib.rs")).unwrap();
    let doc: Vec<&str> = lib
        .lines()
        .map_while(|l| l.strip_prefix("//!"))
        .map(|l| l.strip_prefix(' ').unwrap_or(l))
        .collect();
    let from = doc
        .iter()
        .position(|l| *l == heading)
        .unwrap_or_else(|| panic!("src/lib.rs has no chapter {heading:?}"));
    let length =
        doc[from + 1..].iter().position(|l| l.starts_with("# ")).unwrap_or(doc.len() - from - 1);
    doc[from + 1..from + 1 + length].join("\n")
}

/// The table of the crate's documentation: modules from the bottom up, each with its imports.
fn table() -> Vec<(String, BTreeSet<String>)> {
    let chapter = chapter("# Who may import whom");
    let block = chapter
        .split("```")
        .nth(1)
        .expect("a block with the table")
        .strip_prefix("text\n")
        .expect("text")
        .to_owned();
    let row = |line: &str| {
        let mut words = line.split_whitespace();
        let room = words.next().expect("a room").to_owned();
        (room, words.filter(|w| *w != "-").map(str::to_owned).collect())
    };
    block.lines().map(row).collect()
}

#[test]
fn imports_are_those_of_the_map() {
    let rooms = rooms();
    let mut actual: BTreeMap<(String, String), String> = BTreeMap::new();
    let mut faults = Vec::new();
    for (file, text) in code() {
        let room = room_of(&file);
        for (line, other) in imports(&file, &text) {
            if !rooms.contains(&other) {
                faults.push(format!("{file}:{line}: {other} is no room of any crate; import from the room that has it"));
            } else if other != room {
                actual.entry((room.to_owned(), other)).or_insert_with(|| format!("{file}:{line}"));
            }
        }
    }
    let table = table();
    let place = |room: &str| table.iter().position(|(r, _)| r == room);
    let allowed: BTreeSet<(String, String)> = table
        .iter()
        .flat_map(|(room, list)| list.iter().map(move |other| (room.clone(), other.clone())))
        .collect();
    for ((room, other), at) in &actual {
        if !allowed.contains(&(room.clone(), other.clone())) {
            faults.push(format!("{at}: {room} imports {other}, which the table does not allow"));
        }
        if let Some((_, _, why)) = NEVER.iter().find(|(r, o, _)| r == room && o == other) {
            faults.push(format!("{at}: {room} must never import {other}: {why}"));
        }
    }
    for (room, other) in &allowed {
        if !actual.contains_key(&(room.clone(), other.clone())) {
            faults.push(format!(
                "the table allows {room} to import {other}, and no file does: strike it off"
            ));
        }
        if place(room) <= place(other) {
            faults.push(format!("{room} imports {other}, which does not stand below it: a circle"));
        }
    }
    finish(
        &faults,
        "Imports follow the table under \"Who may import whom\" in src/lib.rs, from the bottom up.",
    );
}

#[test]
fn the_map_lists_every_room() {
    let rooms = rooms();
    let mut faults = Vec::new();
    let map = chapter("# Modules");
    let listed: BTreeSet<String> =
        map.split("[`").skip(1).filter_map(|l| l.split("`]").next()).map(str::to_owned).collect();
    faults.extend(
        rooms
            .iter()
            .filter(|r| !listed.contains(*r))
            .map(|r| format!("{r} is not in the list of rooms")),
    );
    let names: Vec<String> = table().into_iter().map(|(room, _)| room).collect();
    let in_table: BTreeSet<String> = names.iter().cloned().collect();
    assert_eq!(names.len(), in_table.len(), "a room stands in the table twice: {names:?}");
    faults.extend(
        rooms.difference(&in_table).map(|r| format!("{r} has no row in the table of imports")),
    );
    faults.extend(
        in_table
            .difference(&rooms)
            .map(|r| format!("the table of imports has a row for {r}, which is no room")),
    );
    finish(
        &faults,
        "The crate's documentation in src/lib.rs lists every room that it and the crates under it declare.",
    );
}

/// The proof of positions takes from the position solver only the value to be proved.
#[test]
fn the_proof_of_positions_shares_nothing_with_their_solver() {
    let (mut files, mut faults) = (0, Vec::new());
    for (name, text) in code().into_iter().filter(|(name, _)| room_of(name) == "stated") {
        files += 1;
        for (i, _) in text.match_indices("position::") {
            let rest = text[i + "position::".len()..].split([';', '\n']).next().unwrap_or_default();
            if rest != "Configuration" {
                faults.push(format!("{name}: position::{rest}"));
            }
        }
        faults.extend(
            ["guides[", "guide(", "closures", ".shapes"]
                .iter()
                .filter(|word| text.contains(&format!("at.{word}")))
                .map(|word| format!("{name} reads `{word}` of the configuration: that is the solver's, the scene states it")),
        );
    }
    assert!(files > 1, "{files}");
    finish(
        &faults,
        "What proves positions reads the scene, and of the configuration places and directions of links alone.",
    );
}

/// Cargo refuses imports between crates without a dependency; the documentation says which modules
/// share a crate.
#[test]
fn crates_hold_the_rooms_that_the_map_says() {
    let mut crates = crates();
    crates.remove(".");
    assert_eq!(told_crates(), crates);
}
