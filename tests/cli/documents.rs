//! What the documents show is run: their commands, and the scene of the README.

use super::hodograph;
use assert_cmd::Command;
use std::path::Path;

/// Every command line in a `sh` block of the README and the guide runs as it stands, in order, in an empty
/// folder.
#[test]
fn commands_of_the_documents_run() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for (document, at_least) in [("README.md", 10), ("docs/guide.md", 40)] {
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
                        if w.starts_with("templates/") || w.starts_with("docs/") {
                            root.join(w).display().to_string()
                        } else {
                            (*w).to_string()
                        }
                    })
                    .collect();
                Command::cargo_bin("hodograph").unwrap().current_dir(folder.path()).args(words).assert().success();
                ran += 1;
            }
        }
        assert!(ran >= at_least, "{document}: only {ran} commands found");
    }
}

/// The scene that the README shows is read and solved.
#[test]
fn the_scene_of_the_readme_is_solved() {
    let readme = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/README.md")).unwrap();
    let scene = readme.split("```json\n").nth(1).unwrap().split("```").next().unwrap().to_string();
    hodograph().args(["solve", "-"]).write_stdin(scene).assert().success();
}

/// Counting asks neither for rates nor for profiles; where the pose is told there are drawings, else links and pairs are listed.
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
            let run = |args: &[&str]| hodograph().current_dir(folder.path()).args(args).write_stdin(scene.to_owned()).assert();
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
