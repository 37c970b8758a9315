//! The broken scenes of `tests/bad`: each is refused with the message that its README demands.

use hodograph::diag::Faults;
use hodograph::report::diagnostics::render;
use hodograph::scene;
use hodograph::worked::{Scope, work};
use std::fmt::Write;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/bad");

fn messages() -> String {
    let mut files: Vec<_> = std::fs::read_dir(FOLDER)
        .unwrap()
        .map(|f| f.unwrap().path())
        .filter(|p| p.extension().is_some_and(|e| e == "json"))
        .collect();
    files.sort();
    let mut out = String::new();
    for path in files {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let text = std::fs::read_to_string(&path).unwrap();
        let faults = match scene::read(&text) {
            Err(f) => f,
            Ok(s) => match work(&s.value, Scope::Figure) {
                Err(f) => f,
                Ok(done) if !done.value.unanswered.is_empty() => Faults { list: done.notes },
                Ok(_) => panic!("{name} is broken, and was solved all the same"),
            },
        };
        writeln!(out, "=== {name}\n{}", render(&faults, &name, &text)).unwrap();
    }
    out
}

/// The README's demands on each message, in any wording.
const DEMANDS: &[(&str, &[&str])] = &[
    ("misspelt-key", &["lenghts", "lengths"]),
    ("unknown-point", &["F", "K"]),
    ("missing-length", &["link 2", "BC"]),
    ("contradictory-lengths", &["252.", "250"]),
    ("not-assemblable", &["164.6", "link 2", "link 3"]),
    ("dead-centre", &["link 1", "link 2", "B", "drive"]),
    ("locked", &["link 1 (AB)", "link 2 (BC)", "link 3", "in line", "driver link 1"]),
    ("undetermined", &["link 2 and link 3", "B and D coincide"]),
    ("two-drivers-too-many", &["2 conditions", "F = 1", "3 drivers"]),
    ("no-driver", &["driver"]),
    ("wrong-unit", &["kg", "rad/s", "mm/s"]),
    ("several-faults", &["100", "CE", "7", "w_3", "colour"]),
    ("negative-length", &["-250"]),
    ("mobility-zero", &["driver", "F = 0"]),
    ("gear-radii", &["80.00 mm", "90.00 mm", "AD", "radius"]),
    ("ring-radii", &["100.0 mm", "90.00 mm", "inside"]),
    ("gear-no-phase", &["wheel 3", "phase"]),
    ("gear-no-contact", &["A and D", "apart"]),
    ("gear-twice", &["locks", "gear pair", "2 and 3"]),
    ("wheel-off-track", &["1.184 m", "link 3", "B"]),
    ("wheel-off-centre", &["1.000 m", "0.6000 m", "KB", "\"inside\""]),
    ("wheel-beside-track", &["0.1000 m", "B", "links 1 and 4"]),
];

#[test]
fn broken_scenes_are_explained() {
    let now = messages();
    let sections: Vec<&str> = now.split("=== ").skip(1).collect();
    let names: Vec<&str> = sections.iter().filter_map(|s| s.split('.').next()).collect();
    let lost = DEMANDS.iter().filter(|d| !names.contains(&d.0));
    let mut missing: Vec<String> =
        lost.map(|d| format!("{}: its scene is not in tests/bad", d.0)).collect();
    for section in &sections {
        let name = section.split('.').next().unwrap();
        // The quoted source contains the words too: only the messages and the advice count.
        let said: String = section
            .lines()
            .filter(|l| !l.trim_start().starts_with(|c: char| c.is_ascii_digit()))
            .collect::<Vec<_>>()
            .join("\n");
        match DEMANDS.iter().find(|d| d.0 == name) {
            None => missing.push(format!("{name}: nothing is demanded of it; add it to DEMANDS")),
            Some((_, words)) => missing.extend(
                words
                    .iter()
                    .filter(|w| !said.contains(**w))
                    .map(|w| format!("{name}: does not say {w:?}")),
            ),
        }
    }
    let file = format!("{FOLDER}/messages.txt");
    let golden = std::fs::read_to_string(&file).unwrap_or_default();
    if golden != now {
        // A run that accepts fails as well: nothing is accepted unseen.
        if std::env::var("HODOGRAPH_ACCEPT").is_ok_and(|v| v == "1") {
            std::fs::write(&file, &now).unwrap();
            panic!(
                "tests/bad/messages.txt: accepted. Read it (git diff tests/bad/messages.txt) and run without HODOGRAPH_ACCEPT:\n  cargo test --test random broken_scenes"
            );
        }
        let at = golden
            .lines()
            .zip(now.lines())
            .position(|(a, b)| a != b)
            .unwrap_or(golden.lines().count().min(now.lines().count()));
        let line = |t: &str| t.lines().nth(at).unwrap_or("(end)").to_string();
        panic!(
            "the messages for tests/bad changed, first in line {}:\n  expected {}\n  actual   {}\nRead them all with `git diff tests/bad/messages.txt` after accepting them:\n  HODOGRAPH_ACCEPT=1 cargo test --test random broken_scenes",
            at + 1,
            line(&golden),
            line(&now)
        );
    }
    assert!(missing.is_empty(), "{}\nin\n{now}", missing.join("\n"));
}

/// All diagnostics of a scene: its faults, or the notes of its answers.
fn said(text: &str) -> Vec<hodograph::diag::Diagnostic> {
    match scene::read(text) {
        Err(faults) => faults.list,
        Ok(read) => match work(&read.value, Scope::Figure) {
            Err(faults) => [read.notes, faults.list].concat(),
            Ok(done) => [read.notes, done.notes].concat(),
        },
    }
}

#[test]
fn the_chinese_has_no_english() {
    let (mut told, mut faults) = (0, Vec::new());
    for folder in ["tests/bad", "tests/repro", "tests/cases", "templates"] {
        for file in std::fs::read_dir(format!("{}/{folder}", env!("CARGO_MANIFEST_DIR"))).unwrap() {
            let path = file.unwrap().path();
            if path.extension().is_none_or(|e| e != "json") {
                continue;
            }
            for d in said(&std::fs::read_to_string(&path).unwrap()) {
                told += 1;
                faults.extend(
                    d.english_in_chinese()
                        .map(|left| format!("{}: {left:?} in {d:?}", path.display())),
                );
            }
        }
    }
    assert!(told > 20, "only {told} messages were looked at");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
