//! Bounds: work grows no faster than about in proportion to the scene, input that cannot be bounded
//! is refused with its limit, and a signal is handled in the middle of a computation.
//!
//! [`commands`] measures time and memory of every command. Each other test has a deadline that only
//! faster growth can miss; the growth itself is counted in its module (`paper::place::coarse`,
//! `sweep::changes`, `certified::apart`).

#[cfg(target_os = "linux")]
mod commands;
mod scenes;
#[cfg(target_os = "linux")]
mod signals;
#[path = "../wide/mod.rs"]
mod wide;

use assert_cmd::Command;
use scenes::{chain, points_on_a_link};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::time::Duration;
use wide::every;

/// More time than any test takes on a busy machine in a debug build, less than with faster growth.
const DEADLINE: Duration = Duration::from_secs(240);

fn hodograph() -> Command {
    let mut command = Command::cargo_bin("hodograph").unwrap();
    command.timeout(DEADLINE);
    command
}

fn written(folder: &Path, name: &str, scene: &Value) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, format!("{scene:#}")).unwrap();
    path
}

fn template(folder: &Path, name: &str, set: &[&str]) -> PathBuf {
    let path = folder.join("scene.json");
    hodograph()
        .args(["new", name, "-o"])
        .arg(&path)
        .args(set.iter().flat_map(|s| ["--set", s]))
        .assert()
        .success();
    path
}

/// Returns the exit code and the text on standard error.
fn run(arguments: &[&str], scene: &Path, output: &Path) -> (Option<i32>, String) {
    let out = hodograph()
        .arg(arguments[0])
        .arg(scene)
        .args(&arguments[1..])
        .arg("-o")
        .arg(output)
        .output()
        .unwrap();
    (out.status.code(), String::from_utf8_lossy(&out.stderr).into_owned())
}

/// Its scenes stay in `target/tmp`, to measure the largest sizes of `docs/reliability.md`.
#[test]
fn large_mechanisms_are_drawn_and_coarse_labels_are_reported() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    for (name, scene, coarse) in [
        ("chain-8", chain(8), false),
        ("chain-60", chain(60), true),
        ("chain-200", chain(200), true),
        ("points-30", points_on_a_link(30), false),
        ("points-1900", points_on_a_link(1900), true),
        ("points-400", points_on_a_link(400), true),
    ]
    .into_iter()
    .step_by(every(2))
    {
        let scene = written(folder, &format!("{name}.json"), &scene);
        let output = folder.join(format!("{name}.svg"));
        let (code, said) = run(&["draw"], &scene, &output);
        assert_eq!(code, Some(0), "{name}: {said}");
        assert_eq!(said.contains("coarse-labels"), coarse, "{name}: {said}");
        let figure = std::fs::read_to_string(output).unwrap();
        assert!(figure.matches("label").count() > 30, "{name}");
    }
}

/// A problem's figure with many dimensions places them coarsely, which a note reports; all
/// documents contain them.
#[test]
fn worksheets_over_many_points_are_written_and_reported() {
    let folder = tempfile::tempdir().unwrap();
    for (n, coarse) in [(3, false), (60, true), (400, true)] {
        let scene = written(folder.path(), "points.json", &points_on_a_link(n));
        let output = folder.path().join(format!("{n}.md"));
        let (code, said) = run(&["worksheet", "--problem-only"], &scene, &output);
        assert_eq!((code, said.contains("coarse-labels")), (Some(0), coarse), "{n}: {said}");
        let figure =
            std::fs::read_to_string(folder.path().join(format!("{n}-mechanism.svg"))).unwrap();
        assert!(figure.matches("dimension-").count() > 5, "{n}");
    }
}

/// A lesson places the labels of every position: one that would take minutes is refused at once,
/// all others are written.
#[test]
fn lessons_have_a_limit() {
    let folder = tempfile::tempdir().unwrap();
    for (name, scene, code) in [
        ("chain", chain(30), 2),
        ("points", points_on_a_link(200), 2),
        ("fair", points_on_a_link(40), 0),
    ] {
        let scene = written(folder.path(), &format!("{name}.json"), &scene);
        let output = folder.path().join(format!("{name}.html"));
        let (got, said) = run(&["lesson", "--positions", "8"], &scene, &output);
        assert_eq!(got, Some(code), "{name}: {said}");
        assert_eq!(said.contains("120"), code == 2, "{name}: {said}");
        assert_eq!(output.exists(), code == 0, "{name}");
    }
}

#[test]
fn more_than_can_be_drawn_is_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    for (name, scene, limit) in
        [("chain", chain(300), "500"), ("points", points_on_a_link(2100), "2000")]
    {
        let scene = written(folder.path(), &format!("{name}.json"), &scene);
        let (code, said) = run(&["draw"], &scene, &folder.path().join("o.svg"));
        assert_eq!(code, Some(2), "{name}: {said}");
        assert!(said.contains(limit), "{name}: {said}");
    }
}

#[test]
fn turns_through_change_points_cost_no_more_than_a_few() {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("o.csv");
    for (set, arguments, output) in [
        ("phi_1=1e5", &["curves"][..], "o.svg"),
        ("phi_1=1e7", &["sweep", "--steps", "4"], "o.csv"),
        ("phi_1=60", &["curves", "--to", "72000deg"], "o.svg"),
        ("phi_1=60", &["sweep", "--to", "3600000deg", "--steps", "1000"], "o.csv"),
    ] {
        let scene = template(folder.path(), "parallelogram", &[set]);
        let (code, said) = run(arguments, &scene, &folder.path().join(output));
        assert_eq!(code, Some(0), "{arguments:?}: {said}");
        assert!(said.len() < 5000, "{arguments:?}: {said}");
    }
    assert_eq!(
        std::fs::read_to_string(table).unwrap().lines().filter(|l| !l.starts_with('#')).count(),
        1002
    );
}

#[test]
fn ranges_and_steps_beyond_their_limits_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let scene = template(folder.path(), "crank-rocker", &[]);
    for (arguments, output, limit) in [
        (&["curves", "--steps", "10000000"][..], "o.svg", "100000"),
        (&["batch", "--vary", "l_AB=90..100:3", "--steps", "10000000"], "o.csv", "100000"),
        (&["sweep", "--to", "1e12deg"], "o.csv", "10000"),
        (&["curves", "--from", "-1e12deg"], "o.svg", "10000"),
    ] {
        let output = folder.path().join(output);
        let (code, said) = run(arguments, &scene, &output);
        assert_eq!(code, Some(2), "{arguments:?}: {said}");
        assert!(said.contains(limit), "{arguments:?}: {said}");
        assert!(!output.exists(), "{arguments:?}");
    }
}

#[test]
fn long_texts_and_names_are_refused_and_not_echoed() {
    let folder = tempfile::tempdir().unwrap();
    let huge = "w".repeat(200_000);
    let with = |edit: &dyn Fn(&mut Value)| {
        let mut scene = points_on_a_link(1);
        edit(&mut scene);
        written(folder.path(), "scene.json", &scene)
    };
    let edits: [&dyn Fn(&mut Value); 9] = [
        &|s| s["title"] = json!(huge),
        &|s| s["title"] = json!("a\n".repeat(20_000)),
        &|s| s["statement"] = json!({"en": huge}),
        &|s| s["find"] = json!([format!("v_{huge}")]),
        &|s| s["links"][&huge] = json!(["A", "B"]),
        &|s| s["links"]["5"] = json!([huge]),
        &|s| s["lengths"][&huge] = json!("1 mm"),
        &|s| s["parameters"] = json!({huge.as_str(): huge}),
        &|s| s[&huge] = json!(1),
    ];
    for (k, edit) in edits.into_iter().enumerate() {
        let scene = with(edit);
        for (arguments, output) in [(&["draw"][..], "o.svg"), (&["worksheet"], "o.pdf")] {
            let (code, said) = run(arguments, &scene, &folder.path().join(output));
            assert_eq!(code, Some(2), "edit {k}, {arguments:?}: {}", &said[..said.len().min(2000)]);
            assert!(said.len() < 20_000, "edit {k}, {arguments:?}: {} bytes are said", said.len());
        }
    }
    // The longest permitted texts are drawn.
    let scene = with(&|s| {
        (s["title"], s["statement"]) = (json!("速".repeat(500)), json!("wide word ".repeat(1000)))
    });
    for (arguments, output) in [(&["draw"][..], "o.svg"), (&["worksheet"], "o.pdf")] {
        assert_eq!(run(arguments, &scene, &folder.path().join(output)).0, Some(0), "{arguments:?}");
    }
}
