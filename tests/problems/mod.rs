//! Further problems in the manner of the textbooks, each written from its statement with the documents at hand and solved by a program of
//! its own that shares nothing with this one: Newton's method on the loops and implicit differentiation, jets of closed forms, counting.
//!
//! `motion.json`: what `hodograph solve` answers; `centres.json`: places of instantaneous centres; `mobility.json`: counts.

use hodograph::answer::Value;
use hodograph::centres::{Place, centres};
use hodograph::report::mobility;
use hodograph::scene::{self, Kind};
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

fn name(problem: &Json) -> &str {
    problem["name"].as_str().unwrap()
}

/// How far a value is from what is expected, and how large that is. Angles are the same where they differ by whole turns.
fn miss(kind: Kind, value: Value, expected: &Json) -> Option<[f64; 2]> {
    let pair = || Some([expected[0].as_f64()?, expected[1].as_f64()?]);
    let two = |x: f64, y: f64| pair().map(|[a, b]| [(x - a).hypot(y - b), a.hypot(b)]);
    let turns = |off: f64| if kind == Kind::Angle { off - (off / TAU).round() * TAU } else { off };
    match value {
        Value::Scalar(s) => expected.as_f64().map(|e| [turns(s - e).abs(), e.abs()]),
        Value::Vector(v) => two(v.x, v.y),
        Value::Point(p) => two(p.x, p.y),
    }
}

fn size(value: Value) -> f64 {
    match value {
        Value::Scalar(s) => s.abs(),
        Value::Vector(v) => v.norm(),
        Value::Point(p) => p.x.hypot(p.y),
    }
}

#[test]
fn motions_of_further_problems() {
    let (mut faults, mut answers) = (Vec::new(), 0);
    for problem in problems("motion") {
        let id = name(&problem);
        let solved = scene::read(problem["scene"].to_string())
            .and_then(|read| work(&read.value, Scope::Questions).map(|worked| (read.value, worked.value)));
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
                // What vanishes is judged by the largest answer of its kind.
                let kind = scene.find[r.find].what.kind();
                let others = worked.results.iter().filter(|o| scene.find[o.find].what.kind() == kind);
                let largest = others.map(|o| size(o.computed)).fold(0.0, f64::max);
                match miss(kind, value, expected) {
                    Some([off, size]) if off <= ALLOWED * size.max(largest * 1e-3) + 1e-15 => {}
                    off => faults.push(format!("{id}: {find} by {way} is {value:?}, expected {expected}: {off:?}")),
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
        let scene = scene::read(problem["scene"].to_string()).unwrap_or_else(|f| panic!("{id}: {f}")).value;
        let found = centres(&scene).unwrap_or_else(|f| panic!("{id}: {f}")).value;
        let extent = found.worked.configuration.extent();
        for (pair, expected) in problem["expect"].as_object().unwrap() {
            if pair == "count" {
                assert_eq!(found.list.len() as i64, expected.as_i64().unwrap(), "{id}");
                continue;
            }
            let place = found.list.iter().find(|c| c.step.pair.name(&scene) == *pair).and_then(|c| c.place);
            let off = match place {
                Some(Place::At(p)) => miss(Kind::Length, Value::Point(p), expected).map(|[off, size]| off / size.max(extent)),
                // A direction without a sense.
                Some(Place::Infinity(u)) => expected["inf_deg"].as_f64().map(|e| (u.angle() - e.to_radians()).sin().abs()),
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
        let scene = scene::read_topology(problem["scene"].to_string()).unwrap_or_else(|f| panic!("{id}: {f}")).value;
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
