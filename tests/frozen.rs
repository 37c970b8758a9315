//! Frozen output: a hash of everything that each command says and writes for each template, design task, motion and near-singular scene, in both
//! languages.
//!
//! Goldens are few files that a person looks at; these are all of them, so that a change of structure is seen to change nothing. Of the files a
//! fortieth is compared, with `HODOGRAPH_WIDE=1` a fifth, with
//! `HODOGRAPH_FROZEN=all` all. `tests/frozen/hashes.txt` has a row for each file and language and a column for each command. To
//! accept what the program now prints, with the goldens looked at: `HODOGRAPH_ACCEPT=1 cargo test --release --test frozen`. `HODOGRAPH_PROGRAM` names
//! another build of the program.

mod wide;

use hodograph::{particle, scene, synthesis};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::Mutex;
use wide::every;

const HASHES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/frozen/hashes.txt");

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

/// Files that are frozen, each with its name.
fn files() -> Vec<(String, String)> {
    let mut all: Vec<(String, String)> =
        scene::templates::list().iter().map(|t| (t.name.to_owned(), scene::templates::get(t.name).unwrap().to_owned())).collect();
    all.extend(synthesis::templates::names().map(|name| (name.to_owned(), synthesis::templates::get(name).unwrap().to_owned())));
    all.extend(particle::templates::names().map(|name| (name.to_owned(), particle::templates::get(name).unwrap().to_owned())));
    let near = fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/repro")).unwrap().map(|e| e.unwrap().path());
    all.extend(near.map(|p| (format!("repro/{}", p.file_stem().unwrap().to_str().unwrap()), fs::read_to_string(&p).unwrap())));
    all.sort();
    all
}

/// FNV-1a, folded to the digits that a column shows.
fn fold(hash: u64, bytes: &[u8]) -> u64 {
    bytes.iter().fold(hash, |h, b| (h ^ u64::from(*b)).wrapping_mul(0x100_0000_01b3))
}

/// Hash of the exit code, of standard output and error, and of the files that a command leaves.
fn hash(text: &str, line: &str, lang: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("s.json"), text).unwrap();
    let program = std::env::var_os("HODOGRAPH_PROGRAM").unwrap_or_else(|| env!("CARGO_BIN_EXE_hodograph").into());
    let mut run = Command::new(program);
    let run = run.current_dir(folder.path()).env("LC_ALL", "C").args(line.split(' ')).args(["--lang", lang]).output().unwrap();
    let mut hash = fold(0xcbf2_9ce4_8422_2325, run.status.to_string().as_bytes());
    hash = fold(fold(hash, &run.stdout), &run.stderr);
    for (name, bytes) in written(folder.path()) {
        hash = fold(fold(hash, name.as_bytes()), &bytes);
    }
    format!("{:06x}", (hash ^ (hash >> 24)) & 0xff_ffff)
}

fn written(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut all = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        if path.is_dir() {
            all.extend(written(&path).into_iter().map(|(inner, bytes)| (format!("{name}/{inner}"), bytes)));
        } else {
            all.insert(name, fs::read(&path).unwrap());
        }
    }
    all
}

/// The rows of a table of hashes by their names.
fn rows(table: &str) -> BTreeMap<String, Vec<String>> {
    let words = |line: &str| line.split(' ').map(str::to_owned).collect::<Vec<_>>();
    table.lines().filter(|l| !l.starts_with('#')).map(words).map(|mut w| (w.remove(0), w)).collect()
}

/// Every command says and writes for every file what it did when it was last accepted.
#[test]
fn every_output_is_as_it_was() {
    let accept = std::env::var_os("HODOGRAPH_ACCEPT").is_some();
    let all = files();
    let all_of_them = std::env::var("HODOGRAPH_FROZEN").is_ok_and(|v| v == "all");
    let langs = ["en", "zh"];
    let kept = rows(&fs::read_to_string(HASHES).unwrap_or_default());
    let wanted: Vec<(String, &str, &str)> = all
        .iter()
        .enumerate()
        .flat_map(|(i, (name, text))| langs.iter().enumerate().map(move |(k, lang)| (2 * i + k, name, text, *lang)))
        .filter(|(i, ..)| accept || all_of_them || i % every(40).max(5) == 0)
        .map(|(_, name, text, lang)| (format!("{name}.{lang}"), text.as_str(), lang))
        .collect();
    assert!(!wanted.is_empty());
    let made = Mutex::new(BTreeMap::new());
    let next = Mutex::new(wanted.iter());
    std::thread::scope(|s| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            s.spawn(|| {
                while let Some((key, text, lang)) = { next.lock().unwrap().next() } {
                    let row: Vec<String> = COMMANDS.iter().map(|line| hash(text, line, lang)).collect();
                    made.lock().unwrap().insert(key.clone(), row);
                }
            });
        }
    });
    let made = made.into_inner().unwrap();
    let mut wrong = Vec::new();
    for (key, row) in &made {
        let before = kept.get(key);
        let other = |(i, new): (usize, &String)| before.and_then(|b| b.get(i)) != Some(new);
        wrong.extend(row.iter().enumerate().filter(|(i, new)| other((*i, new))).map(|(i, _)| format!("{key}: {}", COMMANDS[i])));
    }
    let names: Vec<String> = all.iter().flat_map(|(name, _)| langs.map(|lang| format!("{name}.{lang}"))).collect();
    wrong.extend(kept.keys().filter(|k| !names.contains(k)).map(|k| format!("{k}: no such file")));
    if accept {
        let head = COMMANDS.iter().map(|c| format!("# {c}\n")).collect::<String>();
        let table: String = made.iter().map(|(key, row)| format!("{key} {}\n", row.join(" "))).collect();
        fs::write(HASHES, head + &table).unwrap();
    }
    assert!(
        wrong.is_empty(),
        "{} outputs changed{}:\n{}\nLook at them beside those of the commit before; to accept them: HODOGRAPH_ACCEPT=1 cargo test --release --test frozen",
        wrong.len(),
        if accept { " and were accepted" } else { "" },
        wrong[..wrong.len().min(40)].join("\n")
    );
}
