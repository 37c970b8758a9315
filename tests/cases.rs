//! The reference problems: each scene of `tests/cases` is solved by drawing and by the loop
//! equations, and compared with answers that were computed without this project.

#[path = "problems/mod.rs"]
mod problems;

use hodograph::answer::AnswerValue;
use hodograph::certified::ladder::{AnswerPart, Certified, certify};
use hodograph::geom::Vec2;
use hodograph::mechanism::Counts;
use hodograph::report::mobility;
use hodograph::scene;
use hodograph::worked::{Scope, work};
use serde_json::Value as Json;
use std::collections::BTreeMap;
use std::path::PathBuf;

struct Row {
    id: String,
    name: String,
    drawn: f64,
    computed: f64,
    /// By the precision ladder to twelve digits.
    certified: f64,
    rung: String,
    tolerance: f64,
}

/// The ladder's value of an answer; NaN unless it certifies all digits.
fn certified(c: &Certified) -> AnswerValue {
    let part = |p| {
        c.part(p)
            .filter(|_| c.why.is_none())
            .map_or(f64::NAN, |n| if n.zero { 0.0 } else { n.enclosure().approx })
    };
    match c.part(AnswerPart::Scalar) {
        Some(_) => AnswerValue::Scalar(part(AnswerPart::Scalar)),
        None => AnswerValue::Vector(Vec2::new(part(AnswerPart::X), part(AnswerPart::Y))),
    }
}

/// Digits requested from the ladder.
const DIGITS: usize = 12;

fn number(v: &Json) -> f64 {
    match v {
        Json::Number(n) => n.as_f64().unwrap(),
        Json::String(s) => s.parse().unwrap(),
        other => panic!("not a number: {other}"),
    }
}

fn component(v: AnswerValue, which: Option<&str>, along: Option<Vec2>) -> f64 {
    match (v, which) {
        (AnswerValue::Scalar(s), _) => s,
        (AnswerValue::Vector(v), Some("x")) => v.x,
        (AnswerValue::Vector(v), Some("y")) => v.y,
        (AnswerValue::Vector(v), Some("along")) => v.dot(along.expect("along needs two points")),
        (AnswerValue::Vector(v), Some("perp")) => {
            v.dot(along.expect("perp needs two points").perp())
        }
        (AnswerValue::Vector(v), _) => v.norm(),
        (AnswerValue::Point(p), Some("x")) => p.x,
        (AnswerValue::Point(p), Some("y")) => p.y,
        (AnswerValue::Point(_), other) => panic!("a place has no {other:?}"),
    }
}

/// The files of the cases, by name.
fn files() -> Vec<PathBuf> {
    files_of("tests/cases")
}

fn files_of(folder: &str) -> Vec<PathBuf> {
    let folder = format!("{}/{folder}", env!("CARGO_MANIFEST_DIR"));
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|f| f.unwrap().path())
        .filter(|p| p.is_file())
        .collect();
    files.sort();
    files
}

#[test]
fn reference_cases() {
    let mut rows = Vec::new();
    let mut failures = Vec::new();
    let mut solved = 0;
    for path in files() {
        let id = path.file_stem().unwrap().to_string_lossy().into_owned();
        let text = std::fs::read_to_string(&path).unwrap();
        let case: Json = serde_json::from_str(&text).unwrap();
        if case["expect"].as_array().unwrap().iter().all(|e| e["find"].is_null()) {
            continue;
        }
        let scene = match scene::read(case["scene"].to_string()) {
            Ok(s) => s.value,
            Err(f) => {
                failures.push(format!("{id}: {f}"));
                continue;
            }
        };
        let worked = match std::panic::catch_unwind(|| work(&scene, Scope::Questions)) {
            Ok(Ok(w)) => w.value,
            Err(_) => {
                failures.push(format!("{id}: panic"));
                continue;
            }
            Ok(Err(f)) => {
                failures.push(format!("{id}: {f}"));
                continue;
            }
        };
        let ladder = certify(&scene, &worked, DIGITS);
        solved += 1;
        for r in worked.results.iter().filter(|r| r.agreement.is_some_and(|a| !a.holds())) {
            failures.push(format!(
                "{id}: {} drawing and analysis disagree: {:?}",
                scene.find[r.find].text, r.agreement
            ));
        }
        for e in case["expect"].as_array().unwrap().iter().filter(|e| !e["find"].is_null()) {
            let find = e["find"].as_str().unwrap();
            let Some(i) = scene.find.iter().position(|f| f.text == find) else {
                failures.push(format!("{id}: {find} is not asked for"));
                continue;
            };
            let along = e["along"].as_array().map(|a| {
                let at = |k: usize| -> hodograph::geom::Point {
                    let name = a[k].as_str().unwrap();
                    scene
                        .points
                        .iter()
                        .position(|p| p.name == name)
                        .and_then(|i| worked.configuration.points[i])
                        .unwrap_or_else(|| panic!("{id}: no place for {name}"))
                };
                (at(1) - at(0)).unit().unwrap()
            });
            let Some(at) = worked.results.iter().position(|r| r.find == i) else {
                failures.push(format!("{id}: {find} is not answered"));
                continue;
            };
            let outcome = &worked.results[at];
            let exact = number(&e["exact"]);
            let scale = number(&e["scale"]);
            let tolerance = number(&e["tolerance"]);
            let miss = |v: AnswerValue| {
                let got = component(v, e["component"].as_str(), along) * scale;
                let difference = if e["compare"] == "signed" {
                    (got - exact).abs()
                } else {
                    (got.abs() - exact.abs()).abs()
                };
                // An answer of exactly zero has no relative error: its case gives the size for the
                // comparison.
                difference / if e["size"].is_null() { exact.abs() } else { number(&e["size"]) }
            };
            // A group that is not drawn is marked as such in its case; once it is drawn, the mark
            // must go.
            let undrawn = e["drawn"] == false;
            if undrawn && outcome.drawn.is_some() {
                failures.push(format!("{id}: {find} is drawn; its case says that it is not"));
            }
            let missing = if undrawn { 0.0 } else { f64::INFINITY };
            let drawn = outcome.drawn.as_ref().map_or(missing, |a| miss(a.value));
            let computed = miss(outcome.computed);
            let sure = miss(certified(&ladder[at]));
            rows.push(Row {
                id: id.clone(),
                name: e["name"].as_str().unwrap_or(find).into(),
                drawn,
                computed,
                certified: sure,
                rung: ladder[at].rung.name(),
                tolerance,
            });
        }
    }
    for r in &rows {
        let hard = r.id.starts_with("hard") || r.id.starts_with("triad");
        let sure = if hard { 1e-12 } else { r.tolerance };
        let bad = !(r.drawn <= r.tolerance && r.computed <= r.tolerance && r.certified <= sure);
        println!(
            "{} {:32} {:24} drawn {:9.1e} computed {:9.1e} allowed {:7.0e} certified {:9.1e} by {}",
            if bad { "X" } else { " " },
            r.id,
            r.name,
            r.drawn,
            r.computed,
            r.tolerance,
            r.certified,
            r.rung
        );
        if bad {
            failures.push(format!(
                "{} {}: drawing off by {:e}, analysis by {:e}, allowed {:e}; the ladder by {:e}, allowed {sure:e}",
                r.id, r.name, r.drawn, r.computed, r.tolerance, r.certified
            ));
        }
    }
    println!("{solved} cases, {} answers", rows.len());
    assert!(solved > 0, "tests/cases is empty");
    assert!(failures.is_empty(), "{} failures:\n{}", failures.len(), failures.join("\n"));
}

/// The statement of a section of `docs/cases.md` about its collection.
#[derive(Default)]
struct Told {
    all: usize,
    /// Number of cases that are scenes of the folder, of their files and of their expected values.
    scenes: usize,
    files: usize,
    values: usize,
    elsewhere: usize,
    not_yet: usize,
}

/// Mobility counts: of a scene (`count`, a place in the JSON of `hodograph mobility`), or from
/// counts alone (`of`).
#[test]
fn freedoms_are_counted() {
    let (mut failures, mut counted) = (Vec::new(), 0);
    for path in files() {
        let id = path.file_stem().unwrap().to_string_lossy().into_owned();
        let case: Json = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
        let mut found: Option<Json> = None;
        for e in case["expect"].as_array().unwrap().iter().filter(|e| e["find"].is_null()) {
            let got = match (e["count"].as_str(), &e["of"]) {
                (Some(place), _) => {
                    let all = found.get_or_insert_with(|| {
                        let scene = scene::read_topology(case["scene"].to_string())
                            .unwrap_or_else(|f| panic!("{id}: {f}"))
                            .value;
                        let (survey, checked) = mobility::surveyed(&scene);
                        mobility::json(&scene, &survey, &checked)
                    });
                    all.pointer(place).and_then(Json::as_i64)
                }
                (None, of) => {
                    let n = |key: &str| {
                        of[key].as_u64().unwrap_or_else(|| panic!("{id}: no {key}")) as usize
                    };
                    Some(
                        Counts { moving: n("n"), lower: n("p_l"), higher: n("p_h") }
                            .freedom(n("repeated"), n("local")),
                    )
                }
            };
            counted += 1;
            if got != Some(number(&e["exact"]) as i64) {
                failures.push(format!("{id}: {} is {}, counted {got:?}", e["name"], e["exact"]));
            }
        }
    }
    assert!(counted > 30, "only {counted} counts in tests/cases");
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// The folder agrees with the documents: an empty folder, a lost file or a lost expected value is a
/// fault.
#[test]
fn the_list_of_cases_is_true() {
    let read = |path: &str| {
        std::fs::read_to_string(format!("{}/{path}", env!("CARGO_MANIFEST_DIR"))).unwrap()
    };
    // The files of each case, and their expected values.
    let mut found: BTreeMap<String, (usize, usize)> = BTreeMap::new();
    // Cases without a mechanism are solved in tests/particle.rs.
    for file in files().into_iter().chain(files_of("tests/motions")) {
        let case: Json = serde_json::from_str(&std::fs::read_to_string(&file).unwrap()).unwrap();
        let centres = case["centres"].as_array().map_or(0, Vec::len);
        let expected = case["expect"].as_array().unwrap().len() + centres;
        assert!(expected > 0, "{} expects nothing", file.display());
        // Those of the collection on synthesis, and those of this project's own, are listed by
        // name.
        if ["curvature", "jets", "forces"].iter().any(|c| case["category"] == *c) {
            let name = format!("`{}`", case["case"].as_str().unwrap());
            assert!(read("docs/cases.md").contains(&name), "{name} is not named in docs/cases.md");
            continue;
        }
        let entry = found.entry(case["case"].as_str().unwrap().to_owned()).or_default();
        *entry = (entry.0 + 1, entry.1 + expected);
    }
    // Tests of cases without a file.
    let page = read("docs/cases.md");
    let sweeps = [
        "tests/sweep.rs",
        "tests/centres.rs",
        "tests/synthesis.rs",
        "crates/base/src/cam/tests.rs",
        "crates/base/src/cam/law/mod.rs",
    ]
    .map(read)
    .concat();
    let mut faults = Vec::new();
    let (mut tested, mut all) = (0, 0);
    let (first, second) = page.split_once("\n## ").expect("two collections");
    for (section, collection) in [(first, "reference.json"), (second, "beyond.json")] {
        let told = told(section, &mut found, &sweeps, &mut faults);
        let head = format!(
            "{} cases in `{collection}`; {} are scenes in `tests/cases/` ({} files, {} expected values), \
             {} are tests of the whole motion or of synthesis, {} are not yet.",
            told.all, told.scenes, told.files, told.values, told.elsewhere, told.not_yet
        );
        if !section.contains(&head) {
            faults.push(format!("docs/cases.md should say: {head}"));
        }
        tested += told.scenes + told.elsewhere;
        all += told.all;
    }
    faults.extend(
        found.keys().map(|name| format!("{name}: has a file, and no row in docs/cases.md")),
    );
    assert!(faults.is_empty(), "docs/cases.md against tests/cases:\n{}", faults.join("\n"));
    let claim = format!("{tested} of {all} reference problems");
    assert!(read("README.md").contains(&claim), "README.md should say: {claim}");
}

/// Compares the rows of a section with the folder, and removes their cases from `found`.
fn told(
    section: &str,
    found: &mut BTreeMap<String, (usize, usize)>,
    sweeps: &str,
    faults: &mut Vec<String>,
) -> Told {
    let mut out = Told::default();
    for row in section.lines().filter(|l| l.starts_with("| `")) {
        let cells: Vec<&str> = row.split(" | ").map(|c| c.trim_matches([' ', '|'])).collect();
        let (name, told, remarks) = (cells[0].trim_matches('`'), cells[2], cells[4..].join(" | "));
        out.all += 1;
        let has = found.remove(name);
        if let Some((files, values)) = has {
            (out.scenes, out.files, out.values) =
                (out.scenes + 1, out.files + files, out.values + values);
        }
        match (has, told.parse::<usize>()) {
            (None, Err(_)) if told == "not yet" => out.not_yet += 1,
            (None, Ok(_)) => {
                out.elsewhere += 1;
                let test = remarks.split('`').find(|word| sweeps.contains(&format!("fn {word}()")));
                if test.is_none() {
                    faults.push(format!(
                        "{name}: has no file, and its row names no test of tests/sweep.rs"
                    ));
                }
            }
            (Some((1, n)), Ok(told)) if n == told => {}
            // One value of one case may be asked for in several poses.
            (Some((n, _)), Ok(_)) if n > 1 && remarks.starts_with(&format!("{n} files")) => {}
            (found, _) => faults.push(format!(
                "{name}: {told} in the table, (files, values) in the folder: {found:?}"
            )),
        }
    }
    out
}
