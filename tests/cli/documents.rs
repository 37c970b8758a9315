//! Runs the contents of the documents: their commands, and the scene of the README.

use super::hodograph;
use assert_cmd::Command;
use hodograph::paper::style::{self, Style};
use hodograph::scene;
use serde_json::Value;
use std::path::Path;

/// Every command line in a `sh` block of the README and the guide runs unchanged, in order, in an
/// empty folder.
#[test]
fn commands_of_the_documents_run() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for (document, at_least) in [("README.md", 10), ("docs/guide.md", 40), ("docs/cluster.md", 5)] {
        let page = std::fs::read_to_string(root.join(document)).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let mut ran = 0;
        for block in page.split("```sh\n").skip(1) {
            for line in block.split("```").next().unwrap().lines() {
                let line = line.split('#').next().unwrap().trim();
                let words: Vec<&str> = line.split_whitespace().collect();
                let words = match words[..] {
                    ["cargo", "run", "--", ..] => &words[3..],
                    ["hodograph", ..] => &words[1..],
                    // The tests themselves, the benchmarks.
                    ["cargo", ..] | [] => continue,
                    _ => panic!("{document} has a command that nothing runs: {line}"),
                };
                let words: Vec<String> = words
                    .iter()
                    .map(|w| {
                        if ["templates/", "docs/", "tests/"].iter().any(|f| w.starts_with(f)) {
                            root.join(w).display().to_string()
                        } else {
                            (*w).to_string()
                        }
                    })
                    .collect();
                Command::cargo_bin("hodograph")
                    .unwrap()
                    .current_dir(folder.path())
                    .args(words)
                    .assert()
                    .success();
                ran += 1;
            }
        }
        assert!(ran >= at_least, "{document}: only {ran} commands found");
    }
}

/// The scene in the README is read and solved.
#[test]
fn the_scene_of_the_readme_is_solved() {
    let readme =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/README.md")).unwrap();
    let scene = readme.split("```json\n").nth(1).unwrap().split("```").next().unwrap().to_string();
    hodograph().args(["solve", "-"]).write_stdin(scene).assert().success();
}

/// The JSON blocks of the format's description: the first is a whole scene, the others are sections
/// that fit the schema.
#[test]
fn the_description_shows_what_can_be_read() {
    let text = include_str!("../../docs/scene.md");
    let blocks = text.split("```json\n").skip(1).filter_map(|b| b.split("```").next());
    // A file without links is not a scene; the tests of motions read it.
    let blocks: Vec<&str> =
        blocks.filter(|b| !b.starts_with('{') || b.contains("\"links\"")).collect();
    assert_eq!(scene::read(blocks[0]).unwrap().notes, []);
    let schema: Value = serde_json::from_str(scene::schema::schema()).unwrap();
    let validator = jsonschema::validator_for(&schema).unwrap();
    let base: Value = serde_json::from_str(blocks[0]).unwrap();
    let sections = blocks[1..]
        .iter()
        .flat_map(|b| if b.contains("[\n") { vec![*b] } else { b.lines().collect() });
    for section in sections {
        let part: Value = serde_json::from_str(&format!("{{{section}}}"))
            .unwrap_or_else(|e| panic!("{section}: {e}"));
        let mut all = base.clone();
        all.as_object_mut().unwrap().extend(part.as_object().unwrap().clone());
        let faults: Vec<String> =
            validator.iter_errors(&all).map(|e| format!("{}: {e}", e.instance_path())).collect();
        assert!(faults.is_empty(), "{section}: {faults:#?}");
        // The reader accepts its shape too; names in it need not be in the first scene.
        let said =
            scene::read(all.to_string()).map_or_else(|faults| faults.list, |read| read.notes);
        let of_shape = |code: &str| {
            ["duplicate-key", "empty", "too-many", "unknown-key", "wrong-count", "wrong-type"]
                .contains(&code)
        };
        let faults: Vec<_> = said.iter().filter(|d| of_shape(d.code)).collect();
        assert!(faults.is_empty(), "{section}: {faults:#?}");
    }
}

#[test]
fn the_style_in_the_guide_is_read() {
    let guide = include_str!("../../docs/guide.md");
    let sample = guide
        .split("```json")
        .skip(1)
        .filter_map(|rest| rest.split("```").next())
        .find(|s| s.contains("\"base\""));
    let read = style::read(sample.expect("the guide shows a style").as_bytes()).unwrap();
    assert_ne!(read, Style::default());
}

/// Counting needs neither velocities nor profiles; with a pose there are drawings, else links and
/// pairs are listed.
#[test]
fn worksheets_on_mobility_need_no_rates() {
    let folder = tempfile::tempdir().unwrap();
    let posed = r#"{"links": {"1": ["A", "D"], "2": ["A", "B"], "3": ["B", "C"], "4": ["C", "D"]}, "ground": "1",
        "points": {"A": [0, 0], "B": ["30 mm", "40 mm"], "C": ["120 mm", "60 mm"], "D": ["100 mm", 0]}, "driver": {"link": "2"}}"#;
    let undriven = posed.replace(r#", "driver": {"link": "2"}"#, "");
    let pairs = r#"{"links": {"1": ["O","P"], "2": ["O"], "3": ["P","B"], "4": ["B"]}, "ground": "1", "cams": [{"cam": "2", "follower": "3", "roller": {"pin": "B"}}]}"#;
    for (scene, drawings) in [(posed, 2), (undriven.as_str(), 2), (pairs, 0)] {
        for lang in ["en", "zh"] {
            let out = folder.path().join("count.md");
            let run = |args: &[&str]| {
                hodograph()
                    .current_dir(folder.path())
                    .args(args)
                    .write_stdin(scene.to_owned())
                    .assert()
            };
            run(&["worksheet", "-", "--mobility", "--lang", lang, "-o", "count.md"]).success();
            let text = std::fs::read_to_string(&out).unwrap();
            assert_eq!(text.matches(".svg").count(), drawings, "{text}");
            assert!(text.contains("=1$$"), "{text}");
            assert!(!text.contains("rad/s"), "a rate that nothing tells: {text}");
            let groups = run(&["mobility", "-", "-o", "groups.svg"]);
            if drawings > 0 {
                groups.success()
            } else {
                groups.code(2)
            };
        }
    }
}
