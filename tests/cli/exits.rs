//! Exit codes do not depend on whether the output is read; every command that solves a scene gives
//! the same.

use super::wide::every;
use super::{hodograph, templates_path, text};
use std::fs::{self, OpenOptions};
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// A dead centre, a broken scene, a sound one with a note, a file that cannot be written, invalid
/// arguments.
const RUNS: [(&str, i32); 9] = [
    ("solve tests/bad/dead-centre.json", 4),
    ("solve tests/bad/no-driver.json", 2),
    ("solve templates/shaper.json --steps", 0),
    ("sweep templates/crank-rocker.json --find v_C", 0),
    ("plan templates/shaper.json", 0),
    ("new crank-rocker -o tests/bad/README.md/x", 1),
    ("templates", 0),
    ("solve", 2),
    ("frobnicate", 2),
];

#[test]
fn the_exit_code_is_due_whoever_listens() {
    let full = || Stdio::from(OpenOptions::new().write(true).open("/dev/full").unwrap());
    let program = || {
        let mut c = Command::new(env!("CARGO_BIN_EXE_hodograph"));
        c.current_dir(env!("CARGO_MANIFEST_DIR"));
        c
    };
    for (command, due) in RUNS {
        let words: Vec<&str> = command.split(' ').collect();
        let run = program().args(&words).stdout(Stdio::null()).stderr(full()).status().unwrap();
        assert_eq!(run.code(), Some(due), "{command} 2>/dev/full");
        // A reader that has closed before the first byte, for both streams.
        for both in [false, true] {
            let (reader, writer) = std::io::pipe().unwrap();
            drop(reader);
            let mut run = program();
            run.args(&words).stdout(Stdio::from(writer.try_clone().unwrap()));
            let run =
                if both { run.stderr(Stdio::from(writer)) } else { run.stderr(Stdio::null()) };
            assert_eq!(run.status().unwrap().code(), Some(due), "{command} | head -c0");
        }
        // Output printed there is lost: it counts as an output that could not be written, unless
        // there is a worse fault.
        let run = program().args(&words).stdout(full()).output().unwrap();
        let said = text(&run.stderr);
        let told = if due == 0 || due == 4 { 1 } else { due };
        assert_eq!(run.status.code(), Some(told), "{command} >/dev/full: {said}");
        assert!(!said.contains("panicked"), "{command}: {said}");
        let run = program().args(&words).stdout(full()).stderr(full()).status().unwrap();
        assert_eq!(run.code(), Some(told), "{command} >/dev/full 2>/dev/full");
    }
    for command in ["--help", "--version", "draw --help"] {
        let run = program()
            .args(command.split(' '))
            .stdout(full())
            .stderr(Stdio::null())
            .status()
            .unwrap();
        assert_eq!(run.code(), Some(1), "{command} >/dev/full");
    }
}

/// Scenes in unusual poses: scenes of past faults, broken scenes, templates at their limits.
fn strange(folder: &std::path::Path) -> Vec<PathBuf> {
    let mut all: Vec<PathBuf> = ["tests/repro", "tests/bad"]
        .iter()
        .flat_map(|f| fs::read_dir(format!("{}/{f}", env!("CARGO_MANIFEST_DIR"))).unwrap())
        .map(|f| f.unwrap().path())
        .filter(|p| p.extension().is_some_and(|e| e == "json"))
        .collect();
    for (name, sets) in [
        ("parallelogram", &["phi_1=0"][..]),
        ("crank-rocker", &["phi_1=0", "l_AB=100", "l_BC=200"]),
        ("slider-crank", &["phi_1=0"]),
        ("toggle-press", &["phi_1=0"]),
        ("scotch-yoke", &["phi_1=90"]),
    ] {
        let out = folder.join(format!("{name}.json"));
        let sets = sets.iter().flat_map(|s| ["--set", s]);
        hodograph().args(["new", name, "-o"]).arg(&out).args(sets).assert().success();
        all.extend(out.exists().then_some(out));
    }
    all.push(templates_path("shaper").into());
    all.sort();
    all
}

#[test]
fn what_draws_ends_as_what_solves() {
    let folder = tempfile::tempdir().unwrap();
    let mut seen = std::collections::BTreeSet::new();
    for scene in strange(folder.path()).into_iter().step_by(every(2)) {
        let code = |command: &[&str], out: Option<&str>| {
            let mut run = hodograph();
            run.args(command).arg(&scene);
            if let Some(out) = out {
                run.arg("-o").arg(folder.path().join(out));
            }
            let run = run.output().unwrap();
            (run.status.code().unwrap(), text(&run.stderr))
        };
        let (due, _) = code(&["solve"], None);
        seen.insert(due);
        for (command, out) in [
            (&["draw"][..], "a.svg"),
            (&["draw", "--steps", "--format", "svg"], "steps"),
            (&["worksheet"], "a.html"),
            (&["lesson", "--positions", "8"], "l.html"),
            (&["lesson", "--reveal"], "r.html"),
        ] {
            let (found, said) = code(command, Some(out));
            assert_eq!(found, due, "{command:?} {}: {said}", scene.display());
        }
    }
    assert!([0, 2, 4].iter().all(|c| seen.contains(c)), "{seen:?}");
}
