//! The table of docs/course.md: every command runs, and shows what its row claims.

use assert_cmd::Command;
use std::collections::BTreeMap;
use std::path::Path;

/// A row of the table.
struct Item {
    notes: String,
    item: String,
    commands: Vec<String>,
    shows: Vec<String>,
    state: String,
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn page() -> String {
    std::fs::read_to_string(root().join("docs/course.md")).unwrap()
}

/// Texts in backquotes, with their bars unescaped.
fn quoted(cell: &str) -> Vec<String> {
    cell.split('`').skip(1).step_by(2).map(|text| text.replace("\\|", "|")).collect()
}

fn items() -> Vec<Item> {
    let page = page();
    let rows = page.lines().skip_while(|line| !line.starts_with("|---")).skip(1);
    rows.take_while(|line| line.starts_with('|'))
        .map(|line| {
            // A bar within a cell has a backslash before it, a bar between cells a space.
            let cells: Vec<&str> = line.split(" | ").collect();
            assert_eq!(cells.len(), 7, "{line}");
            Item {
                notes: cells[0].trim_start_matches('|').trim().to_owned(),
                item: cells[2].to_owned(),
                commands: quoted(cells[4]),
                shows: quoted(cells[5]),
                state: cells[6].trim_end_matches('|').trim().to_owned(),
            }
        })
        .collect()
}

/// All text of a command: of its streams and of the files that it writes; or why it failed.
fn text_of(command: &str) -> Result<String, String> {
    let folder = tempfile::tempdir().unwrap();
    let (scene, command) = match command.strip_prefix("jq .scene ") {
        Some(rest) => {
            let (file, rest) = rest.split_once(" | ").expect("jq is piped into the program");
            let case = std::fs::read_to_string(root().join(file)).unwrap();
            let case: serde_json::Value = serde_json::from_str(&case).unwrap();
            (case["scene"].to_string(), rest)
        }
        None => (String::new(), command),
    };
    let words = command.strip_prefix("hodograph ").expect("the command is one of the program");
    let words = words.split_whitespace().map(|word| {
        if word.starts_with("templates/") || word.starts_with("tests/") {
            root().join(word).display().to_string()
        } else {
            word.to_owned()
        }
    });
    let ran = Command::cargo_bin("hodograph")
        .unwrap()
        .current_dir(folder.path())
        .args(words)
        .write_stdin(scene)
        .output()
        .unwrap();
    let mut text = [ran.stdout, ran.stderr].map(|t| String::from_utf8(t).unwrap()).concat();
    if !ran.status.success() {
        return Err(format!("{command}: {}\n{text}", ran.status));
    }
    let mut folders = vec![folder.path().to_owned()];
    let mut written = 0;
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if entry.is_dir() {
                folders.push(entry);
                continue;
            }
            let bytes = std::fs::read(&entry).unwrap();
            written += bytes.len();
            // Pictures of points have no text.
            text += std::str::from_utf8(&bytes).unwrap_or_default();
        }
    }
    if text.trim().is_empty() || (command.contains(" -o ") && written == 0) {
        return Err(format!("{command}: no output"));
    }
    Ok(text)
}

/// Runs the commands of some notes, each once, and looks for what the rows claim.
fn rows_show_what_they_claim(notes: &[&str]) {
    let items: Vec<Item> =
        items().into_iter().filter(|item| notes.contains(&&*item.notes)).collect();
    assert!(items.len() > 10, "{notes:?}: only {} rows", items.len());
    let mut texts: BTreeMap<&str, Result<String, String>> = BTreeMap::new();
    let mut faults = Vec::new();
    for Item { item, commands, shows, .. } in &items {
        let mut all = String::new();
        for command in commands {
            match texts.entry(command).or_insert_with(|| text_of(command)) {
                Ok(text) => all += text,
                Err(why) => faults.push(format!("{item}: {why}")),
            }
        }
        let lacking = shows.iter().filter(|shown| !all.contains(&**shown));
        faults.extend(lacking.map(|shown| format!("{item}: the output has no `{shown}`")));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn the_analysis_by_vectors_and_centres_is_shown() {
    rows_show_what_they_claim(&["000"]);
}

#[test]
fn the_course_designs_are_shown() {
    rows_show_what_they_claim(&["001"]);
}

#[test]
fn the_graphical_equations_are_shown() {
    rows_show_what_they_claim(&["002"]);
}

#[test]
fn the_composite_motion_is_shown() {
    rows_show_what_they_claim(&["004"]);
}

/// Each row has a state of its own: whole, or what lacks; a command and its claim unless missing.
#[test]
fn the_states_are_counted_and_say_what_lacks() {
    let items = items();
    let count = |state: &str| {
        items.iter().filter(|item| item.state.split(": ").next() == Some(state)).count()
    };
    let (whole, part, missing) = (count("whole"), count("in part"), count("missing"));
    assert_eq!((items.len(), whole + part + missing), (117, 117));
    let of = |count: usize| format!("{count} {}", if count == 1 { "is" } else { "are" });
    let sentence = format!(
        "{whole} of {} rows are whole,\n{} there in part, {} missing.",
        items.len(),
        of(part),
        of(missing)
    );
    assert!(page().contains(&sentence), "docs/course.md does not say: {sentence}");
    for Item { item, commands, shows, state, .. } in &items {
        assert_eq!(state == "whole", !state.contains(": "), "{item}: {state}");
        assert_eq!(state.starts_with("missing"), commands.is_empty(), "{item}: {state}");
        assert_eq!(commands.is_empty(), shows.is_empty(), "{item}: a claim needs a command");
    }
}
