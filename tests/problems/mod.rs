//! Further problems in textbook style, each written from its statement with the documents at hand
//! and solved by a program of its own that shares nothing with this one: Newton's method on the
//! loops and implicit differentiation, jets of closed forms, counting.
//!
//! `motion.json`: answers of `hodograph solve`; `centres.json`: places of instantaneous centres;
//! `mobility.json`: counts.

use hodograph::answer::AnswerValue;
use hodograph::centres::{CentrePlace, centres};
use hodograph::mechanism::Mechanism;
use hodograph::report::mobility;
use hodograph::scene::{self, Kind, templates};
use hodograph::sweep::station::angle_per_value;
use hodograph::sweep::{self, PlacedScene, Stations, Width};
use hodograph::worked::{Scope, work};
use serde_json::Value as Json;
use std::f64::consts::TAU;

/// Allowed error, as a part of the value or of the largest value of its problem and unit.
const ALLOWED: f64 = 1e-9;

fn problems(file: &str) -> Vec<Json> {
    let path = format!("{}/tests/problems/{file}.json", env!("CARGO_MANIFEST_DIR"));
    let list: Json = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let list = list.as_array().unwrap().clone();
    assert!(!list.is_empty(), "{file}.json is empty");
    list
}

#[test]
fn the_readme_counts_the_problems() {
    let counts = ["motion", "centres", "mobility"].map(|file| problems(file).len());
    let read = |path: &str| {
        std::fs::read_to_string(format!("{}/{path}", env!("CARGO_MANIFEST_DIR"))).unwrap()
    };
    let all = format!("{} further problems", counts.iter().sum::<usize>());
    assert!(read("README.md").contains(&all), "README.md should say: {all}");
    let [motion, centres, mobility] = counts;
    let parts = format!(
        "{motion} scenes with the answers of `hodograph solve`, {centres} with the places of instantaneous centres, {mobility} with the counts"
    );
    assert!(read("docs/cases.md").contains(&parts), "docs/cases.md should say: {parts}");
}

fn name(problem: &Json) -> &str {
    problem["name"].as_str().unwrap()
}

/// Difference between a value and the expected one, and the size of the expected one. Angles are
/// equal if they differ by whole turns.
fn miss(kind: Kind, value: AnswerValue, expected: &Json) -> Option<[f64; 2]> {
    let pair = || Some([expected[0].as_f64()?, expected[1].as_f64()?]);
    let two = |x: f64, y: f64| pair().map(|[a, b]| [(x - a).hypot(y - b), a.hypot(b)]);
    let turns = |off: f64| if kind == Kind::Angle { off - (off / TAU).round() * TAU } else { off };
    match value {
        AnswerValue::Scalar(s) => expected.as_f64().map(|e| [turns(s - e).abs(), e.abs()]),
        AnswerValue::Vector(v) => two(v.x, v.y),
        AnswerValue::Point(p) => two(p.x, p.y),
    }
}

fn size(value: AnswerValue) -> f64 {
    match value {
        AnswerValue::Scalar(s) => s.abs(),
        AnswerValue::Vector(v) => v.norm(),
        AnswerValue::Point(p) => p.x.hypot(p.y),
    }
}

#[test]
fn motions_of_further_problems() {
    let (mut faults, mut answers) = (Vec::new(), 0);
    for problem in problems("motion") {
        let id = name(&problem);
        let solved = scene::read(problem["scene"].to_string()).and_then(|read| {
            work(&read.value, Scope::Questions).map(|worked| (read.value, worked.value))
        });
        let (scene, worked) = match solved {
            Ok(solved) => solved,
            Err(f) => {
                faults.push(format!("{id}: {f}"));
                continue;
            }
        };
        for (find, expected) in problem["expect"].as_object().unwrap() {
            let asked = |r: &&hodograph::worked::Outcome| scene.find[r.find].text == *find;
            let Some(r) = worked.results.iter().find(asked) else {
                faults.push(format!("{id}: {find} is not answered"));
                continue;
            };
            answers += 1;
            let drawn = r.drawn.as_ref().map(|d| d.value);
            for (way, value) in [("drawing", drawn), ("analysis", Some(r.computed))] {
                let Some(value) = value else { continue };
                // A value of zero is judged by the largest answer of its kind.
                let kind = scene.find[r.find].what.kind();
                let others =
                    worked.results.iter().filter(|o| scene.find[o.find].what.kind() == kind);
                let largest = others.map(|o| size(o.computed)).fold(0.0, f64::max);
                match miss(kind, value, expected) {
                    Some([off, size]) if off <= ALLOWED * size.max(largest * 1e-3) + 1e-15 => {}
                    off => faults.push(format!(
                        "{id}: {find} by {way} is {value:?}, expected {expected}: {off:?}"
                    )),
                }
            }
        }
    }
    println!("{answers} answers");
    assert!(answers > 600, "only {answers} answers");
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn centres_of_further_problems() {
    let mut faults = Vec::new();
    for problem in problems("centres") {
        let id = name(&problem);
        let scene =
            scene::read(problem["scene"].to_string()).unwrap_or_else(|f| panic!("{id}: {f}")).value;
        let found = centres(&scene).unwrap_or_else(|f| panic!("{id}: {f}")).value;
        let extent = found.worked.configuration.extent();
        for (pair, expected) in problem["expect"].as_object().unwrap() {
            if pair == "count" {
                assert_eq!(found.list.len() as i64, expected.as_i64().unwrap(), "{id}");
                continue;
            }
            let place =
                found.list.iter().find(|c| c.step.pair.name(&scene) == *pair).and_then(|c| c.place);
            let off = match place {
                Some(CentrePlace::At(p)) => miss(Kind::Length, AnswerValue::Point(p), expected)
                    .map(|[off, size]| off / size.max(extent)),
                // A direction without a sense.
                Some(CentrePlace::Infinity(u)) => {
                    expected["inf_deg"].as_f64().map(|e| (u.angle() - e.to_radians()).sin().abs())
                }
                None => None,
            };
            if off.is_none_or(|off| off.is_nan() || off > ALLOWED) {
                faults.push(format!("{id}: {pair} is {place:?}, expected {expected}"));
            }
        }
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn mobility_of_further_problems() {
    let mut faults = Vec::new();
    for problem in problems("mobility") {
        let id = name(&problem);
        let scene = scene::read_topology(problem["scene"].to_string())
            .unwrap_or_else(|f| panic!("{id}: {f}"))
            .value;
        let (survey, checked) = mobility::surveyed(&scene);
        let told = mobility::json(&scene, &survey, &checked);
        for (count, expected) in problem["expect"].as_object().unwrap() {
            let place = match count.as_str() {
                "n" => "/counts/n",
                "pl" => "/counts/p_l",
                "ph" => "/counts/p_h",
                "F" => "/F",
                "F'" => "/F_local",
                "p'" => "/p_virtual",
                other => panic!("{id}: {other} is no count"),
            };
            let got = told.pointer(place);
            if got != Some(expected) {
                faults.push(format!("{id}: {count} is {got:?}, expected {expected}"));
            }
        }
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

/// The lists and tables of a scene in another order. The order of entries has no meaning, except
/// for the points of a link and for parameters, which use those before them.
fn shuffled(scene: &Json, seed: usize) -> Json {
    let mut scene = scene.clone();
    let order = |n: usize| -> Vec<usize> {
        // A step coprime to the length, and another start.
        let step = (1..n.max(2))
            .filter(|s| (2..=*s).all(|d| s % d > 0 || !n.is_multiple_of(d)))
            .nth_back(seed % 2)
            .unwrap_or(1);
        (0..n).map(|k| (seed + 1 + k * step) % n).collect()
    };
    for (key, value) in scene.as_object_mut().unwrap() {
        match value {
            _ if key == "parameters" => {}
            Json::Array(list) if list.iter().all(Json::is_object) => {
                *list = order(list.len()).into_iter().map(|k| list[k].clone()).collect()
            }
            Json::Object(table) => {
                let entries: Vec<_> = table.iter().map(|(k, v)| (k.clone(), v.clone())).collect();
                *table = order(entries.len()).into_iter().map(|k| entries[k].clone()).collect();
            }
            _ => {}
        }
    }
    scene
}

#[test]
fn the_order_of_entries_decides_nothing() {
    let (mut faults, mut compared) = (Vec::new(), 0);
    let given = problems("motion");
    let own = templates::list().into_iter().map(|t| {
        (t.name.to_owned(), serde_json::from_str(templates::get(t.name).unwrap()).unwrap())
    });
    let all = given.iter().map(|p| (name(p).to_owned(), p["scene"].clone())).chain(own);
    for (id, scene) in all {
        // Several drivers are distinguished by their order.
        if scene["driver"].is_array() || scene["drivers"].is_array() {
            continue;
        }
        let answers = |scene: &Json| {
            let read = scene::read(scene.to_string())?.value;
            let worked = work(&read, Scope::Questions)?.value;
            Ok::<_, hodograph::diag::Faults>(
                worked
                    .results
                    .iter()
                    .map(|r| (read.find[r.find].text.clone(), r.computed))
                    .collect::<Vec<_>>(),
            )
        };
        // Of several assemblies that the scene does not distinguish one is taken, with a note.
        let open = |scene: &Json| {
            let told = scene::read(scene.to_string())
                .and_then(|s| work(&s.value, Scope::Questions))
                .map(|w| w.notes);
            told.is_ok_and(|notes| {
                notes.iter().any(|n| ["side-undecided", "assembly-by-default"].contains(&n.code))
            })
        };
        let Ok(first) = answers(&scene) else { continue };
        if open(&scene) {
            continue;
        }
        compared += 1;
        for seed in 0..2 {
            let again = match answers(&shuffled(&scene, seed)) {
                Ok(again) => again,
                Err(f) => {
                    faults.push(format!("{id}, order {seed}: {f}"));
                    continue;
                }
            };
            for (find, value) in &first {
                let Some((_, other)) = again.iter().find(|(f, _)| f == find) else {
                    faults.push(format!("{id}, order {seed}: {find} is not answered"));
                    continue;
                };
                let off = match (*value, *other) {
                    (AnswerValue::Scalar(a), AnswerValue::Scalar(b)) => (a - b).abs(),
                    (AnswerValue::Vector(a), AnswerValue::Vector(b)) => (a - b).norm(),
                    (AnswerValue::Point(a), AnswerValue::Point(b)) => a.distance(b),
                    _ => f64::INFINITY,
                };
                let largest = first.iter().map(|(_, v)| size(*v)).fold(0.0, f64::max);
                if off.is_nan() || off > ALLOWED * size(*value).max(largest * 1e-3) {
                    faults
                        .push(format!("{id}, order {seed}: {find} is {other:?} and was {value:?}"));
                }
            }
        }
    }
    assert!(compared > 120, "only {compared} scenes");
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

/// A sweep that begins at the driver's position agrees there with the pose.
#[test]
fn sweeps_of_further_problems_begin_with_their_poses() {
    let (mut faults, mut compared) = (Vec::new(), 0);
    for problem in problems("motion") {
        let id = name(&problem);
        let scene = scene::read(problem["scene"].to_string())
            .unwrap_or_else(|f| panic!("{id}: {f}"))
            .value
            .over_a_turn();
        let mechanism = Mechanism::new(&scene).unwrap().value;
        let (Some(now), Ok(placed)) =
            (scene::driver_position(&scene, 0), PlacedScene::new(&scene, &mechanism))
        else {
            continue;
        };
        let stations = Stations::of_values(vec![now], angle_per_value(&scene, &placed.at, 0));
        let table = match sweep::run(&placed, 0, &stations, Width::Widest) {
            Ok(table) if table.rows() == 1 => table,
            other => {
                faults.push(format!("{id}: {other:?}"));
                continue;
            }
        };
        let value =
            |name: String| table.columns[1..].iter().find(|c| c.name == name).map(|c| c.values[0]);
        let expect = problem["expect"].as_object().unwrap();
        let of = |e: &Json| {
            e.as_f64()
                .map_or_else(|| e[0].as_f64().unwrap().hypot(e[1].as_f64().unwrap()), f64::abs)
        };
        let largest = expect.values().map(of).fold(0.0, f64::max);
        for (find, expected) in expect {
            let off = match expected.as_f64() {
                Some(e) => value(find.clone())
                    .map(|x| if find.starts_with("phi") { ((x - e) / 2.0).sin() } else { x - e }),
                None => value(format!("{find}.x")).zip(value(format!("{find}.y"))).map(|(x, y)| {
                    (x - expected[0].as_f64().unwrap()).hypot(y - expected[1].as_f64().unwrap())
                }),
            };
            // Some are named as in the drawing.
            let Some(off) = off else { continue };
            compared += 1;
            if off.is_nan() || off.abs() > 10.0 * ALLOWED * of(expected).max(1e-3 * largest) {
                faults.push(format!("{id}: {find} is off by {off:e} of {expected} in a sweep"));
            }
        }
    }
    println!("{compared} answers");
    assert!(compared > 300, "only {compared} answers");
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}
