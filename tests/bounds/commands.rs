//! Every command ends within 5 s of processor time and 300 MB on every template, case and scene of
//! `tests/attack`, and on a ladder of 301 links, or refuses at once; [`BEYOND`] lists the
//! exceptions.
//!
//! `cargo test` tries a part of all pairs of a command and a scene, a wide run four times as many.
//! `HODOGRAPH_BOUNDS=all` tries all of them, `HODOGRAPH_BOUNDS=cam` the commands and scenes with
//! these letters, and `HODOGRAPH_PROGRAM=target/release/hodograph` measures that program:
//!
//! `HODOGRAPH_BOUNDS=all HODOGRAPH_PROGRAM=target/release/hodograph cargo test --test bounds
//! every_command -- --nocapture` prints the table of docs/performance.md.

use crate::scenes::chain;
use crate::signals::{AT_ONCE, commands, taken};
use crate::wide::every;
use crate::written;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

/// Longest processor time of a command (s), in the `release` profile.
const MOST_S: f64 = 5.0;
/// The `dev` profile, which is slower at what it does not optimise.
const DEV: f64 = 4.0;
/// Largest memory of a command (MB).
const MOST_MB: f64 = 300.0;

/// Every command with its outputs that cost most, each also as JSON. Work whose size the user
/// states (steps, frames, positions, mechanisms) is small here.
const COMMANDS: [&str; 57] = [
    "draw SCENE -o a.svg",
    "draw SCENE --page a4 -o a.pdf",
    "draw SCENE --format pdf,svg --figure mechanism,velocity,acceleration,equations,results -o o/",
    "draw SCENE --format svg --figure forces,lever -o o/",
    "draw SCENE --format svg --figure plates -o o/",
    "draw SCENE --format svg --figure centres,kutzbach,gears,composite,attempts,curvature -o o/",
    "draw SCENE --format svg --figure centrodes -o o/",
    "draw SCENE --format svg --figure inversions -o o/",
    "draw SCENE --format svg --figure cognates -o o/",
    "draw SCENE --format svg --poses 12 -o o/",
    "draw SCENE --format svg --figure mechanism --dimensions --vectors velocity -o o/",
    "draw SCENE --format svg --steps -o o/",
    "lesson SCENE --positions 8 -o l.html",
    "lesson SCENE --reveal -o l.html",
    "solve SCENE --steps --digits 30",
    "solve SCENE --json --drafting",
    "plan SCENE --json --figure",
    "worksheet SCENE -o w.pdf",
    "worksheet SCENE --find-the-mistake -o w.md",
    "worksheet SCENE --mobility -o w.typ",
    "variants SCENE --to moodle,qti3,qti2,canvas,prairielearn -o set/",
    "worksheet SCENE --frame -o f.pdf",
    "export SCENE -o e.dxf",
    "export SCENE -o e.ggb",
    "export SCENE -o e.pptx",
    "export SCENE --to pmks -o -",
    "accuracy SCENE --json --patience 1",
    "sweep SCENE -o s.json",
    "sweep SCENE --steps 36 -o s.csv",
    "sweep SCENE --over t -o s.npy",
    "sweep SCENE --units book --steps 36 -o s.csv",
    "worksheet SCENE --table 36 -o t.md",
    "worksheet SCENE --questions -o q.md",
    "batch SCENE --random 4 -o b.csv",
    "curves SCENE -o c.svg",
    "curves SCENE --polar -o c.pdf",
    "path SCENE --point POINT -o p.svg",
    "path SCENE --point POINT --poses 12 -o p.svg",
    "animate SCENE --frames 6 -o a.svg",
    "cam SCENE --json",
    "cam SCENE --steps 90 --format svg --profile p.dxf -o cam/",
    "compare SCENE SCENE -o c.svg",
    "cycle SCENE --form straight -o c.svg",
    "limits SCENE --json",
    "limits SCENE --ranges --flywheel 1/30",
    "mobility SCENE --json",
    "mobility SCENE -o m.svg",
    "centres SCENE --json --drafting",
    "inversions SCENE --json",
    "curvature SCENE --json --centrodes",
    "curvature SCENE --steps --drafting",
    "composite SCENE --json",
    "loops SCENE --json",
    "worksheet SCENE --loops -o l.md",
    "attempts SCENE --all --json",
    "readings SCENE --json",
    "synth SCENE --json",
];

/// Commands that take longer on a scene, by letters of both: they are not tried there. The search
/// for places of labels is slow on the plates of a hundred gears; the centrodes of a ladder are
/// those of 150 links.
const BEYOND: [(&str, &str); 2] =
    [("train", "plates"), ("ladder", "curvature SCENE --json --centrodes")];

/// Time and memory of a command.
#[derive(Clone, Copy)]
struct Cost {
    seconds: f64,
    mb: f64,
}

/// The largest memory of a running program until now (MB).
fn peak(id: u32) -> Option<f64> {
    let status = fs::read_to_string(format!("/proc/{id}/status")).ok()?;
    let kb = status.lines().find_map(|l| l.strip_prefix("VmHWM:"))?.trim().strip_suffix(" kB")?;
    kb.trim().parse::<f64>().ok().map(|kb| kb / 1000.0)
}

/// Runs a command until its end, or until it has taken more than it may. Returns its exit code,
/// which is `None` if it was stopped, and what it took.
fn run(program: &Path, folder: &Path, arguments: &[&str], most_s: f64) -> (Option<i32>, Cost) {
    let to = |name: &str| File::create(folder.join(name)).unwrap();
    let mut child = Command::new(program)
        .current_dir(folder)
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(to(".out"))
        .stderr(to(".said"))
        .spawn()
        .unwrap();
    let mut cost = Cost { seconds: 0.0, mb: 0.0 };
    let stopped = loop {
        // A program that has ended keeps its times until it is waited for, and no memory.
        cost.seconds = taken(&child).unwrap_or(cost.seconds);
        let mb = peak(child.id());
        cost.mb = cost.mb.max(mb.unwrap_or_default());
        if cost.seconds > most_s || cost.mb > MOST_MB {
            child.kill().unwrap();
            break true;
        }
        if mb.is_none() {
            break false;
        }
        std::thread::sleep(Duration::from_millis(3));
    };
    let status = child.wait().unwrap();
    (status.code().filter(|_| !stopped), cost)
}

/// The files to try, each with its name: first those with which `cargo test` tries many commands.
fn scenes(folder: &Path) -> (Vec<(String, PathBuf)>, usize) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let of = |part: &str| {
        let mut files: Vec<_> =
            fs::read_dir(root.join(part)).unwrap().map(|f| f.unwrap().path()).collect();
        files.retain(|f| f.extension().is_some_and(|e| e == "json"));
        files.sort();
        assert!(!files.is_empty(), "{part}");
        files
    };
    let name = |f: &Path| f.file_stem().unwrap().to_str().unwrap().to_owned();
    let mut all: Vec<_> = of("tests/attack").into_iter().map(|f| (name(&f), f)).collect();
    all.push(("ladder".into(), written(folder, "ladder.json", &chain(150))));
    let many = all.len();
    for part in ["templates", "templates/particle", "templates/synthesis", "tests/repro"] {
        all.extend(of(part).into_iter().map(|f| (name(&f), f)));
    }
    for file in of("tests/cases") {
        let case: Value = serde_json::from_str(&fs::read_to_string(&file).unwrap()).unwrap();
        if let Some(scene) = case.get("scene") {
            let name = format!("case {}", name(&file));
            let path = written(folder, &format!("{name}.json").replace(' ', "-"), scene);
            all.push((name, path));
        }
    }
    (all, many)
}

/// The last point of a scene, for commands that take one.
fn point(scene: &Path) -> String {
    let json: Value = serde_json::from_str(&fs::read_to_string(scene).unwrap()).unwrap_or_default();
    let links = json["links"].as_object().into_iter().flatten();
    let points = links.flat_map(|(_, points)| points.as_array().into_iter().flatten());
    points.filter_map(Value::as_str).max().unwrap_or("A").to_owned()
}

#[test]
fn every_command_ends_within_its_bounds() {
    for command in commands() {
        let tried = AT_ONCE.contains(&command.as_str())
            || COMMANDS.iter().any(|line| line.split(' ').next() == Some(&command));
        assert!(tried, "`{command}` is measured on no scene: add a command line");
    }
    let other = std::env::var_os("HODOGRAPH_PROGRAM").map(PathBuf::from);
    let most_s = if other.is_none() && cfg!(debug_assertions) { DEV * MOST_S } else { MOST_S };
    let program = other.unwrap_or_else(|| env!("CARGO_BIN_EXE_hodograph").into());
    let program = fs::canonicalize(program).unwrap();
    let only = std::env::var("HODOGRAPH_BOUNDS").unwrap_or_default();
    let folder = tempfile::tempdir().unwrap();
    let (scenes, many) = scenes(folder.path());
    let mut slowest: BTreeMap<&str, [(Cost, &str); 2]> = BTreeMap::new();
    let mut wrong = Vec::new();
    for (k, (name, path)) in scenes.iter().enumerate() {
        for (n, line) in COMMANDS.iter().enumerate() {
            let part = every(4) * if k < many { 5 } else { COMMANDS.len() };
            let beyond = |(file, words): &(&str, &str)| name.contains(file) && line.contains(words);
            if BEYOND.iter().any(beyond) {
                continue;
            }
            let wanted = match only.as_str() {
                "" => (k + n) % part == 0,
                "all" => true,
                letters => line.contains(letters) || name.contains(letters),
            };
            if !wanted {
                continue;
            }
            let at = tempfile::tempdir_in(folder.path()).unwrap();
            let (scene, point) = (path.to_str().unwrap(), point(path));
            let words = line.split(' ').map(|word| match word {
                "SCENE" => scene,
                "POINT" => &point,
                word => word,
            });
            let (code, cost) = run(&program, at.path(), &words.collect::<Vec<_>>(), most_s);
            let text = |file: &str| fs::read_to_string(at.path().join(file)).unwrap_or_default();
            let (out, said) = (text(".out"), text(".said"));
            let fault = match code {
                None => "is out of bounds".to_owned(),
                Some(0 | 4) if line.contains("--json") => serde_json::from_str::<Value>(&out)
                    .err()
                    .map_or_else(String::new, |e| format!("prints what is no JSON: {e}")),
                Some(0 | 4) => String::new(),
                Some(2) if !said.is_empty() => String::new(),
                Some(code) => format!("ends with {code}: {said}"),
            };
            let Cost { seconds, mb } = cost;
            if !fault.is_empty() {
                wrong.push(format!("{name}: {line}: {fault} ({seconds:.1} s, {mb:.0} MB)"));
                println!("{}", wrong.last().unwrap());
            }
            let [time, memory] = slowest.entry(line).or_insert([(cost, name); 2]);
            if seconds > time.0.seconds {
                *time = (cost, name);
            }
            if mb > memory.0.mb {
                *memory = (cost, name);
            }
        }
    }
    println!("| command | s | scene | MB | scene |\n|---|---|---|---|---|");
    for (line, [(time, slow), (memory, large)]) in slowest {
        println!("| `{line}` | {:.2} | {slow} | {:.0} | {large} |", time.seconds, memory.mb);
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The polygons of a group of class VI have the most vectors: pages and frames try several sizes of
/// them.
#[test]
fn pages_of_crowded_polygons_end_within_their_bounds() {
    let folder = tempfile::tempdir().unwrap();
    let (scenes, _) = scenes(folder.path());
    let is_ring = |scene: &&(String, PathBuf)| scene.0 == "case higher-class6-ring";
    let (_, ring) = scenes.iter().find(is_ring).unwrap();
    for line in ["draw SCENE --page a4 -o a.pdf", "worksheet SCENE --frame -o f.pdf"] {
        let line = line.replace("SCENE", ring.to_str().unwrap());
        let words: Vec<&str> = line.split(' ').collect();
        let program = Path::new(env!("CARGO_BIN_EXE_hodograph"));
        let (code, cost) = run(program, folder.path(), &words, MOST_S);
        assert_eq!(code, Some(0), "{line}: {:.1} s", cost.seconds);
    }
}
