//! Mutated scenes through every command that takes one: the work after reading and solving, over a
//! whole turn or on paper, is fuzzed too.

use super::{SOON, corpus, finite, fuzz, root};
use serde_json::Value as Json;
use std::fs;

/// Commands on `s.json`, with few steps: many inputs find more than long ones.
const COMMANDS: [&str; 29] = [
    "solve s.json --steps",
    "curves s.json --steps 24 -o c.svg",
    "draw s.json --format svg -o out/",
    "limits s.json",
    "compare s.json s.json -o c.svg",
    "cycle s.json --form straight -o c.svg",
    "sweep s.json --steps 6 -o t.csv",
    "draw s.json --steps --format svg -o out/",
    "cam s.json --steps 24 --profile p.csv",
    "animate s.json --frames 3 -o a.svg",
    "lesson s.json --positions 8 -o l.html",
    "worksheet s.json -o w.md",
    "variants s.json --to moodle,qti2,canvas,prairielearn -o set",
    "mobility s.json",
    "centres s.json",
    "composite s.json",
    "loops s.json",
    "curvature s.json --steps",
    "draw s.json --figure centres,curvature,composite --format svg -o out/",
    "inversions s.json",
    "attempts s.json --all",
    "solve s.json --json --digits 12",
    "plan s.json",
    "path s.json -o p.svg",
    "export s.json -o e.dxf",
    "export s.json -o e.ggb",
    "export s.json -o e.py",
    "export s.json -o e.txt",
    "worksheet s.json --frame -o f.pdf",
];

/// The scenes of the collected cases, in the order of their files.
fn cases() -> Vec<String> {
    let of = |text: String| {
        let case: Json = serde_json::from_str(&text).unwrap();
        format!("{:#}", case["scene"])
    };
    corpus(&["tests/cases"]).into_iter().map(of).collect()
}

/// For any scene a command ends by itself, without a panic and without a disagreement of drawing
/// and analysis; its output contains only finite numbers, and a run without output gives a reason.
#[test]
fn fuzz_commands() {
    let mut seeds = corpus(&["templates", "tests/bad", "tests/repro"]);
    seeds.extend(cases());
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fuzz("commands", &seeds, 60, &|input, k| {
        let line = COMMANDS[k as usize % COMMANDS.len()];
        fs::write(at("s.json"), input).unwrap();
        let mut run = assert_cmd::Command::new(env!("CARGO_BIN_EXE_hodograph"));
        let run = run
            .current_dir(folder.path())
            .env("LC_ALL", "C")
            .args(line.split(' '))
            .timeout(SOON)
            .output()
            .unwrap();
        let (out, said) =
            (String::from_utf8_lossy(&run.stdout), String::from_utf8_lossy(&run.stderr));
        let code = run.status.code();
        assert!(matches!(code, Some(0 | 2 | 4)), "{line}: {code:?} {said}");
        assert!(!said.contains("panicked"), "{line}: {said}");
        assert!(code != Some(2) || !said.is_empty(), "{line}: refused without a word");
        if code != Some(2) {
            finite(&out);
            let written =
                ["t.csv", "p.csv"].map(|name| fs::read_to_string(at(name)).unwrap_or_default());
            written.iter().for_each(|table| finite(table));
            // Each named file exists, and a command with an output names one.
            let names: Vec<&str> = out
                .lines()
                .filter(|l| l.ends_with(".svg") || l.ends_with(".html") || l.ends_with(".md"))
                .collect();
            assert!(names.iter().all(|n| folder.path().join(n).exists()), "{line}: {out}");
            assert!(
                !line.contains(" -o ") || fs::read_dir(folder.path()).unwrap().count() > 1,
                "{line}: no file and no word"
            );
        }
        for entry in fs::read_dir(folder.path()).unwrap().flatten() {
            let path = entry.path();
            if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) }.unwrap();
        }
        code != Some(2)
    });
    assert!(root("tests/repro").exists());
}
