//! Hostile input: for any bytes there is soon an answer or a diagnosis, and every number is finite.

use crate::emit::{self, Ask, Pose};
use crate::properties::{mechanism, seeds, style};
use crate::rng::Rng;
use hodograph::certified::{certify, steps};
use hodograph::notation::Notation;
use hodograph::plan::text::PlanWriter;
use hodograph::report::diagnostics::render;
use hodograph::report::{answers, construction};
use hodograph::scene::{self, Lang, templates};
use hodograph::worked::{Scope, work};
use serde_json::{Value as Json, json};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

/// Time limit of a scene within the reader's limits (measured: the worst takes a tenth of this
/// unoptimised).
const SOON: Duration = Duration::from_secs(20);

/// Reads and solves an input; true if it was solved. A panic, a non-finite number or an error
/// without a message prints the input.
fn survive(input: &[u8], what: &str) -> bool {
    let shown = || String::from_utf8_lossy(&input[..input.len().min(4000)]).into_owned();
    let start = Instant::now();
    let run = || {
        let scene = match scene::read(input) {
            Ok(s) => s.value,
            Err(f) => return Err(f),
        };
        let done = work(
            &scene,
            if input.len().is_multiple_of(2) { Scope::Figure } else { Scope::Questions },
        )?
        .value;
        for o in &done.results {
            for v in o.drawn.iter().map(|d| d.value).chain([o.computed]) {
                let (x, y) = v.numbers();
                assert!(
                    x.is_finite() && y.is_none_or(f64::is_finite),
                    "{} is {v:?}",
                    scene.find[o.find].text
                );
            }
        }
        // Everything that `solve --steps --drafting` prints.
        let certified = certify(&scene, &done, answers::DIGITS);
        let told = steps(&scene, &done, Some(0.1));
        let notation = Notation::of_language(Lang::Zh);
        let w = PlanWriter { scene: &scene, plan: &done.plan, notation: &notation, lang: Lang::Zh };
        let printed = [
            answers::text(&scene, &done, &certified, answers::DIGITS, Lang::En),
            construction::text(&w, &done.construction, &told),
            answers::json(&scene, &done, &certified, answers::DIGITS, &[])["answers"].to_string(),
        ];
        for text in &printed {
            let number = |w: &str| {
                matches!(w.trim_matches(|c: char| !c.is_ascii_alphabetic()), "NaN" | "inf")
            };
            // A title may contain anything.
            let told = text.lines().filter(|l| l.contains('=') || l.starts_with('['));
            assert!(!told.flat_map(str::split_whitespace).any(number), "{text}");
        }
        Ok(())
    };
    let result = catch_unwind(AssertUnwindSafe(run));
    let took = start.elapsed();
    assert!(took < SOON, "{what}: took {took:?} on\n{}", shown());
    match result {
        Err(e) => {
            let words = e
                .downcast_ref::<String>()
                .cloned()
                .or(e.downcast_ref::<&str>().map(|s| s.to_string()))
                .unwrap_or_default();
            panic!("{what}: {words}\non\n{}", shown())
        }
        Ok(Ok(())) => true,
        Ok(Err(f)) => {
            assert!(f.has_errors(), "{what}: refused without an error: {f:?}\n{}", shown());
            let _ = render(&f, "scene.json", &String::from_utf8_lossy(input));
            false
        }
    }
}

/// Valid scenes to be damaged: the templates and some random mechanisms.
fn sources() -> Vec<String> {
    let mut all: Vec<String> =
        templates::list().iter().map(|t| templates::get(t.name).unwrap().to_string()).collect();
    for seed in 0..40 {
        if let Some(m) = mechanism(seed).filter(|m| m.groups.len() < 8) {
            let pose =
                if m.coordinates_only || seed % 2 == 0 { Pose::Coordinates } else { Pose::Lengths };
            all.push(emit::scene(&m, &style(pose, Ask::Everything, seed)));
        }
    }
    all
}

#[test]
fn random_bytes() {
    for seed in seeds(300) {
        let mut rng = Rng::new(seed);
        let n = rng.below(300);
        let bytes: Vec<u8> = match seed % 3 {
            0 => (0..n).map(|_| rng.next() as u8).collect(),
            1 => (0..n)
                .map(|_| *b"{}[]\",:0123456789 abcAB.eE-+u\\\n".get(rng.below(31)).unwrap())
                .collect(),
            _ => (0..n)
                .flat_map(|_| {
                    rng.pick(&[
                        "\"links\":",
                        "{",
                        "}",
                        "[",
                        "]",
                        ",",
                        "\"A\"",
                        "\"1\"",
                        ":",
                        "\"ground\"",
                        "null",
                    ])
                    .bytes()
                })
                .collect(),
        };
        survive(&bytes, &format!("random bytes, seed {seed}"));
    }
}

#[test]
fn flipped_bytes() {
    let sources = sources();
    for seed in seeds(1500) {
        let mut rng = Rng::new(seed);
        let mut bytes = sources[rng.below(sources.len())].clone().into_bytes();
        for _ in 0..1 + rng.below(3) {
            let i = rng.below(bytes.len());
            match rng.below(4) {
                0 => bytes[i] = rng.next() as u8,
                1 => bytes[i] ^= 1 << rng.below(7),
                2 => drop(bytes.remove(i)),
                // Replacing a digit by a digit keeps the text a scene.
                _ => {
                    let digits: Vec<usize> =
                        (0..bytes.len()).filter(|i| bytes[*i].is_ascii_digit()).collect();
                    if !digits.is_empty() {
                        bytes[digits[rng.below(digits.len())]] = b'0' + rng.below(10) as u8;
                    }
                }
            }
        }
        survive(&bytes, &format!("flipped bytes, seed {seed}"));
    }
}

/// All places in a tree, as paths.
fn paths(v: &Json, at: &mut Vec<String>, out: &mut Vec<String>) {
    out.push(at.iter().map(|s| format!("/{}", s.replace('~', "~0").replace('/', "~1"))).collect());
    let inner: Vec<(String, &Json)> = match v {
        Json::Object(o) => o.iter().map(|(k, v)| (k.clone(), v)).collect(),
        Json::Array(a) => a.iter().enumerate().map(|(i, v)| (i.to_string(), v)).collect(),
        _ => return,
    };
    for (k, v) in inner {
        at.push(k);
        paths(v, at, out);
        at.pop();
    }
}

const NUMBERS: [&str; 22] = [
    "1e308", "1e-300", "5e-324", "-1", "0", "NaN", "inf", "1e999", "1/0", "0/0", "1e154", "1e-154",
    "1e16", "1e-12", "0.1", "1", "2", "3", "90", "180", "360", "1e400",
];
const UNITS: [&str; 8] = ["m", "mm", "deg", "rad", "rad/s", "m/s", "m/s^2", "rad/s^2"];

/// One change to a scene that leaves it valid JSON.
fn spoil(scene: &mut Json, rng: &mut Rng) {
    let mut all = Vec::new();
    paths(scene, &mut Vec::new(), &mut all);
    all.remove(0);
    let path = all[rng.below(all.len())].clone();
    let (parent, key) = path.rsplit_once('/').unwrap();
    let (parent, key) = (parent.to_string(), key.replace("~1", "/").replace("~0", "~"));
    let other = all[rng.below(all.len())].clone();
    let other = scene.pointer(&other).cloned().unwrap_or(Json::Null);
    let names = |scene: &Json| -> Vec<String> {
        let links = scene["links"].as_object();
        let mut n: Vec<String> = links.iter().flat_map(|o| o.keys().cloned()).collect();
        n.extend(
            links
                .iter()
                .flat_map(|o| o.values())
                .filter_map(|v| v.as_array())
                .flatten()
                .filter_map(|v| v.as_str())
                .map(str::to_string),
        );
        n
    };
    match rng.below(9) {
        // Replaces a quantity, or any value, by an extreme one.
        0 | 1 => {
            let unit =
                match scene.pointer(&path).and_then(Json::as_str).and_then(|t| t.split_once(' ')) {
                    Some((_, unit)) if rng.chance(0.9) => unit.to_string(),
                    _ => rng.pick(&UNITS).to_string(),
                };
            *scene.pointer_mut(&path).unwrap() = json!(format!("{} {unit}", rng.pick(&NUMBERS)));
        }
        // Removes an entry.
        2 | 3 => match scene.pointer_mut(&parent) {
            Some(Json::Object(o)) => drop(o.shift_remove(&key)),
            Some(Json::Array(a)) => drop(a.remove(key.parse().unwrap())),
            _ => {}
        },
        // Renames it.
        4 | 5 => {
            let n = names(scene);
            if !n.is_empty() && scene.pointer(&path).is_some_and(Json::is_string) {
                *scene.pointer_mut(&path).unwrap() = json!(n[rng.below(n.len())]);
            }
        }
        // Replaces it by a part from elsewhere.
        6 => *scene.pointer_mut(&path).unwrap() = other,
        // Duplicates it.
        7 => {
            if let Some(Json::Array(a)) = scene.pointer_mut(&path) {
                a.extend(a.clone());
                if rng.chance(0.5) {
                    a.push(other);
                }
            }
        }
        // Adds a link, guide or driver with existing names.
        _ => {
            let n = names(scene);
            if n.is_empty() {
                return;
            }
            let mut name = || n[rng.below(n.len())].clone();
            let (a, b, c) = (name(), name(), name());
            match rng.below(4) {
                0 => {
                    if let Some(o) = scene["links"].as_object_mut() {
                        o.insert("extra".into(), json!([a, b]));
                    }
                }
                1 => {
                    let g = json!({"pin": a, "slider": b, "on": c, "angle": "30 deg"});
                    match scene.get_mut("guides") {
                        Some(Json::Array(list)) => list.push(g),
                        _ => scene["guides"] = json!([g]),
                    }
                }
                2 => {
                    let d = match rng.below(3) {
                        0 => json!({"link": a, "against": b, "omega": "1 rad/s"}),
                        1 => json!({"slide": a, "velocity": "0 m/s"}),
                        _ => json!({"cylinder": format!("{a},{b}"), "rate": "1 m/s"}),
                    };
                    scene["driver"] = match scene["driver"].take() {
                        Json::Array(mut list) => {
                            list.push(d);
                            Json::Array(list)
                        }
                        Json::Null => d,
                        one if rng.chance(0.5) => json!([one, d]),
                        _ => d,
                    };
                }
                _ => {
                    // Two points in one place.
                    let at = scene["points"][&b].clone();
                    if at.is_array() {
                        scene["points"][&a] = at;
                    }
                }
            }
        }
    }
}

#[test]
fn spoilt_scenes() {
    let sources: Vec<Json> = sources().iter().map(|s| serde_json::from_str(s).unwrap()).collect();
    let mut solved = 0;
    let all = seeds(3000);
    let n = all.end;
    for seed in all {
        let mut rng = Rng::new(seed);
        let mut scene = sources[rng.below(sources.len())].clone();
        for _ in 0..1 + rng.below(3) {
            if scene.as_object().is_some_and(|o| !o.is_empty()) {
                spoil(&mut scene, &mut rng);
            }
        }
        solved += usize::from(survive(
            scene.to_string().as_bytes(),
            &format!("spoilt scene, seed {seed}"),
        ));
    }
    println!("{solved} of {n} spoilt scenes were solved all the same");
}

#[test]
fn nested_and_huge() {
    for open in ["[", "{\"links\":", "{\"a\":[", "\"\\u"] {
        survive(open.repeat(20_000).as_bytes(), "nested");
    }
    survive(format!("{}{}", "[".repeat(5000), "]".repeat(5000)).as_bytes(), "nested and closed");
    for n in [400usize, 501, 10_000] {
        let mut links = serde_json::Map::new();
        for i in 0..n {
            links.insert(format!("{i}"), json!([format!("A{i}"), format!("A{}", i + 1)]));
        }
        let scene = json!({"links": links, "ground": "0", "driver": {"link": "1", "omega": "1 rad/s"}, "find": ["omega_2"]});
        assert!(!survive(scene.to_string().as_bytes(), &format!("an open chain of {n} links")));
        // All links on one pin.
        let links: serde_json::Map<_, _> =
            (0..n).map(|i| (format!("{i}"), json!(["A", format!("B{i}")]))).collect();
        let scene = json!({"links": links, "ground": "0", "driver": {"link": "1", "omega": "1 rad/s"}, "find": ["omega_2"]});
        assert!(!survive(scene.to_string().as_bytes(), &format!("{n} links on one pin")));
        // All points on all links.
        let all: Vec<String> = (0..n.min(400)).map(|i| format!("A{i}")).collect();
        let links: serde_json::Map<_, _> = (0..20).map(|i| (format!("{i}"), json!(all))).collect();
        let scene = json!({"links": links, "ground": "0", "driver": {"link": "1", "omega": "1 rad/s"}, "find": ["omega_2"]});
        assert!(!survive(scene.to_string().as_bytes(), &format!("{n} points on twenty links")));
    }
}
