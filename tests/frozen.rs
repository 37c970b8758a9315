//! Compares every output of the program with that of another build, for a refactoring that must
//! change nothing.
//!
//! `HODOGRAPH_PROGRAM=/path/of/the/other cargo test --test frozen` compares the output and the
//! files of each command for each template, design task, motion and near-singular scene, in both
//! languages, byte for byte (about half an hour; `HODOGRAPH_FROZEN=cam` takes the files with this
//! in their names). Without the other build nothing is compared.

use hodograph::problem::templates;
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::Mutex;

/// Commands, each on `s.json` in a folder of its own.
const COMMANDS: [&str; 25] = [
    "solve s.json --steps --drafting",
    "solve s.json --json --digits 12",
    "solve s.json --steps --notation cn",
    "plan s.json",
    "plan s.json --json",
    "mobility s.json --json",
    "centres s.json",
    "curvature s.json --steps",
    "composite s.json",
    "attempts s.json --all",
    "inversions s.json",
    "limits s.json",
    "cam s.json --format svg -o cam",
    "sweep s.json --steps 12",
    "draw s.json --format svg -o sheet",
    "draw s.json --steps --format svg -o steps",
    "draw s.json --figure mechanism --poses 3 --dimensions --format svg -o m",
    "draw s.json --width 80mm --format svg -o narrow",
    "curves s.json --steps 24 -o c.svg",
    "worksheet s.json -o w.md",
    "worksheet s.json -o w.html",
    "worksheet s.json --find-the-mistake -o m.html",
    "lesson s.json --positions 8 -o l.html",
    "lesson s.json --reveal -o r.html",
    "synth s.json --steps",
];

/// The files, each with its name.
fn files() -> Vec<(String, String)> {
    let text = |name: &str| templates::text(name, &[]).unwrap_or_else(|f| panic!("{name}: {f}"));
    let near = fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/repro"))
        .unwrap()
        .map(|e| e.unwrap().path());
    let mut all: Vec<(String, String)> =
        templates::all().iter().map(|t| (t.name.to_owned(), text(t.name))).collect();
    all.extend(near.map(|p| {
        (p.file_stem().unwrap().to_str().unwrap().to_owned(), fs::read_to_string(&p).unwrap())
    }));
    all
}

/// Exit code, standard output and error, and the files that a command leaves, by name.
fn output(program: &OsStr, text: &str, line: &str, lang: &str) -> BTreeMap<String, Vec<u8>> {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("s.json"), text).unwrap();
    let mut run = Command::new(program);
    let run = run
        .current_dir(folder.path())
        .env("LC_ALL", "C")
        .args(line.split(' '))
        .args(["--lang", lang])
        .output()
        .unwrap();
    let mut all = written(folder.path());
    all.insert("exit code".into(), run.status.to_string().into_bytes());
    all.insert("standard output".into(), run.stdout);
    all.insert("standard error".into(), run.stderr);
    all
}

fn written(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut all = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        if path.is_dir() {
            all.extend(
                written(&path).into_iter().map(|(inner, bytes)| (format!("{name}/{inner}"), bytes)),
            );
        } else {
            all.insert(name, fs::read(&path).unwrap());
        }
    }
    all
}

/// For every file, every command prints and writes the same as another build.
#[test]
fn every_output_is_that_of_another_build() {
    let Some(other) = std::env::var_os("HODOGRAPH_PROGRAM") else { return };
    let only = std::env::var("HODOGRAPH_FROZEN").unwrap_or_default();
    let all = files();
    let wanted: Vec<_> = all
        .iter()
        .filter(|(name, _)| name.contains(&only))
        .flat_map(|f| ["en", "zh"].map(|lang| (f, lang)))
        .collect();
    assert!(!wanted.is_empty(), "no file has {only} in its name");
    let (next, wrong) = (Mutex::new(wanted.iter()), Mutex::new(Vec::new()));
    std::thread::scope(|s| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            s.spawn(|| {
                while let Some(((name, text), lang)) = { next.lock().unwrap().next() } {
                    for line in COMMANDS {
                        let [own, before] =
                            [env!("CARGO_BIN_EXE_hodograph").as_ref(), other.as_os_str()]
                                .map(|p| output(p, text, line, lang));
                        let differ = own
                            .iter()
                            .find(|(part, bytes)| before.get(*part) != Some(*bytes))
                            .map(|(part, _)| part.clone());
                        let differ = differ.or_else(|| {
                            before.keys().find(|part| !own.contains_key(*part)).cloned()
                        });
                        wrong
                            .lock()
                            .unwrap()
                            .extend(differ.map(|part| format!("{name} {lang}: {line}: {part}")));
                    }
                }
            });
        }
    });
    let wrong = wrong.into_inner().unwrap();
    assert!(
        wrong.is_empty(),
        "{} of {} outputs differ:\n{}",
        wrong.len(),
        wanted.len() * COMMANDS.len(),
        wrong.join("\n")
    );
}
