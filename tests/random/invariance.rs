//! Changes that must not affect an answer: place and direction of the mechanism, units, names, and
//! the order of lists. Shifts and rotations are written into the scene as arithmetic
//! (`(0.3 m) + 1e6 m`, `x*cos(37.3 deg) - ...`), so that they are exact: the certified intervals
//! must intersect, and the printed digits be equal.

use crate::emit::{self, Ask, Pose, Style, scene as emitted};
use crate::mech::Mech;
use crate::properties::{mechanism, seeds, style};
use crate::wide::every;
use hodograph::answer::AnswerValue;
use hodograph::certified::ladder::{AnswerPart, Certified, certify};
use hodograph::scene::{Scene, read};
use hodograph::worked::{Scope, Worked, work};
use serde_json::Value as Json;

const DIGITS: usize = 6;
const TURN: &str = "37.3 deg";

fn solved(text: &str, what: &str) -> (Scene, Worked) {
    let scene = read(text).unwrap_or_else(|f| panic!("{what}: {f}\n{text}")).value;
    let worked =
        work(&scene, Scope::Questions).unwrap_or_else(|f| panic!("{what}: {f}\n{text}")).value;
    (scene, worked)
}

fn certified(text: &str, what: &str) -> Vec<(String, Certified)> {
    let (scene, worked) = solved(text, what);
    let list = certify(&scene, &worked, DIGITS);
    worked.results.iter().zip(list).map(|(r, c)| (scene.find[r.find].text.clone(), c)).collect()
}

/// Numbers that do not depend on the frame.
fn same(seed: u64, what: &str, a: &Certified, b: &Certified) -> usize {
    let mut compared = 0;
    for part in [AnswerPart::Magnitude, AnswerPart::Scalar] {
        let (Some(m), Some(n)) = (a.part(part), b.part(part)) else { continue };
        assert!(
            m.enclosure().meets(n.enclosure()),
            "seed {seed}, {what}: {m:?} and {n:?} have no number in common"
        );
        if a.why.is_none() && b.why.is_none() {
            assert_eq!(m.text(DIGITS), n.text(DIGITS), "seed {seed}, {what}");
        }
        compared += 1;
    }
    compared
}

/// Applies `f` to every pair of absolute coordinates of a scene.
fn each_place(scene: &mut Json, f: &dyn Fn(&str, &str) -> [String; 2]) {
    let pair = |v: &mut Json| {
        if let Some([x, y]) = v.as_array().map(Vec::as_slice) {
            let [x, y] = f(x.as_str().unwrap(), y.as_str().unwrap());
            *v = serde_json::json!([x, y]);
        }
    };
    for key in ["points", "sketch"] {
        if let Some(map) = scene[key].as_object_mut() {
            map.values_mut().for_each(pair);
        }
    }
    for guide in scene["guides"].as_array_mut().into_iter().flatten() {
        if guide["through"].is_array() {
            pair(&mut guide["through"]);
        }
    }
}

fn shifted(text: &str) -> String {
    let mut scene: Json = serde_json::from_str(text).unwrap();
    each_place(&mut scene, &|x, y| [format!("({x}) + 1000000 m"), format!("({y}) - 2000000 m")]);
    scene.to_string()
}

fn turned(text: &str) -> String {
    let mut scene: Json = serde_json::from_str(text).unwrap();
    each_place(&mut scene, &|x, y| {
        [
            format!("({x})*cos({TURN}) - ({y})*sin({TURN})"),
            format!("({x})*sin({TURN}) + ({y})*cos({TURN})"),
        ]
    });
    let further = |v: &mut Json| *v = format!("({}) + {TURN}", v.as_str().unwrap()).into();
    for guide in scene["guides"].as_array_mut().into_iter().flatten() {
        if guide["angle"].is_string() && guide["line"].is_null() {
            further(&mut guide["angle"]);
        }
    }
    let ground = scene["ground"].clone();
    let several = if scene["drivers"].is_null() { "driver" } else { "drivers" };
    let drivers = match &mut scene[several] {
        Json::Array(list) => list.iter_mut().collect(),
        one => vec![one],
    };
    for driver in drivers {
        if driver["angle"].is_string()
            && (driver["against"].is_null() || driver["against"] == ground)
        {
            further(&mut driver["angle"]);
        }
    }
    scene.to_string()
}

fn each(own: u64, mut check: impl FnMut(u64, &Mech, &str)) {
    for seed in seeds(own) {
        // A driver along an arc counts from an axis of the plane: rotating the plane moves it.
        let Some(m) = mechanism(seed).filter(|m| !m.coordinates_only && m.groups.len() <= 8) else {
            continue;
        };
        check(seed, &m, &emitted(&m, &style(Pose::Lengths, Ask::Everything, seed)));
    }
}

#[test]
fn neither_place_nor_turn_changes_a_digit() {
    let mut compared = 0;
    each(60, |seed, m, text| {
        let arcs = text.contains("\"radius\"") && text.contains("\"position\"");
        let here = certified(text, "as it is");
        for (what, other) in [("shifted by 1e6 m", shifted(text)), ("turned", turned(text))] {
            if what == "turned" && arcs {
                continue;
            }
            for ((name, a), (_, b)) in
                here.iter().zip(certified(&other, &format!("seed {seed} {what} {:?}", m.groups)))
            {
                // Places and angles of links refer to the frame.
                if !name.starts_with(['x', 'y', 'p']) {
                    compared += same(seed, &format!("{name} {what}"), a, &b);
                }
            }
        }
    });
    println!("{compared} certified numbers shifted and turned");
    assert!(compared > 2000 / every(8), "{compared}");
}

#[test]
fn neither_names_nor_order_change_a_digit() {
    let mut compared = 0;
    each(40, |seed, m, text| {
        let renamed = Style { renamed: true, ..style(Pose::Lengths, Ask::Everything, seed) };
        let here = certified(text, "as it is");
        let there = certified(&emit::scene(m, &renamed), &format!("seed {seed} renamed"));
        if here.len() != there.len() {
            return;
        }
        // The questions may be in another order: every number must be found again.
        let all: Vec<_> = there
            .iter()
            .filter_map(|(_, c)| {
                c.part(AnswerPart::Magnitude).or(c.part(AnswerPart::Scalar))?.text(DIGITS)
            })
            .collect();
        for (name, c) in &here {
            let Some(text) = c
                .part(AnswerPart::Magnitude)
                .or(c.part(AnswerPart::Scalar))
                .and_then(|n| n.text(DIGITS))
            else {
                continue;
            };
            assert!(
                all.contains(&text),
                "seed {seed}: {name} = {} is not among the answers of the renamed scene",
                text.0
            );
            compared += 1;
        }
    });
    println!("{compared} certified numbers renamed and reordered");
    assert!(compared > 1000 / every(8), "{compared}");
}

/// Lengths, coordinates and speeds times 2^±40, written as a product: equal bit for bit, except for
/// the exponent.
#[test]
fn scaling_by_a_power_of_two_changes_no_bit() {
    let mut compared = 0;
    each(40, |seed, _, text| {
        let (scene, here) = solved(text, "as it is");
        let sure = certify(&scene, &here, DIGITS);
        for (factor, k) in [
            ("1099511627776", 2f64.powi(40)),
            ("0.0000000000009094947017729282379150390625", 2f64.powi(-40)),
        ] {
            let mut json: Json = serde_json::from_str(text).unwrap();
            scale(&mut json, factor);
            let (other, there) = solved(&json.to_string(), &format!("seed {seed} times {k:e}"));
            let surely = certify(&other, &there, DIGITS);
            for (i, (a, b)) in here.results.iter().zip(&there.results).enumerate() {
                let name = &scene.find[a.find].text;
                let angular = name.starts_with("omega")
                    || name.starts_with("alpha")
                    || name.starts_with("phi");
                let k = if angular { 1.0 } else { k };
                let same = match (a.computed, b.computed) {
                    (AnswerValue::Vector(a), AnswerValue::Vector(b)) => {
                        (a.x * k, a.y * k) == (b.x, b.y)
                    }
                    (AnswerValue::Scalar(a), AnswerValue::Scalar(b)) => a * k == b,
                    _ => false,
                };
                assert!(
                    same,
                    "seed {seed}: {name} = {:?}, scaled by {k:e} {:?}",
                    a.computed, b.computed
                );
                // Other decimals may call for another rung.
                if sure[i].rung != surely[i].rung {
                    continue;
                }
                for ((part, n), (_, o)) in sure[i].parts.iter().zip(&surely[i].parts) {
                    let k = if *part == AnswerPart::Direction { 1.0 } else { k };
                    assert_eq!(
                        n.enclosure().approx * k,
                        o.enclosure().approx,
                        "seed {seed}: {} of {name} certified",
                        part.key()
                    );
                    compared += 1;
                }
            }
        }
    });
    println!("{compared} numbers scaled by 2^40 and 2^-40");
    assert!(compared > 2000 / every(8), "{compared}");
}

/// Multiplies every quantity with a metre in it.
fn scale(v: &mut Json, factor: &str) {
    match v {
        Json::String(s) if s.ends_with(" m") || s.contains(" m/s") => {
            *s = format!("({s})*{factor}")
        }
        Json::Array(list) => list.iter_mut().for_each(|v| scale(v, factor)),
        Json::Object(map) => map.values_mut().for_each(|v| scale(v, factor)),
        _ => {}
    }
}
