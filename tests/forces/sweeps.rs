//! Forces over a turn and over parameters.

use super::{answer, loaded, near};
use hodograph::answer::AnswerValue;
use hodograph::mechanism::Mechanism;
use hodograph::scene::quantity::contacts;
use hodograph::scene::{self, LinkId, templates};
use hodograph::sweep::vary::Variation;
use hodograph::sweep::{self, PlacedScene, station};
use hodograph::worked::{Scope, work};
use serde_json::{Value as Json, json};

/// A sweep over a parameter agrees with the file with that value, also for parameters of loads,
/// friction and strokes.
#[test]
fn sweeps_over_parameters_of_loads_are_their_scenes() {
    let cases = [
        ("engine-forces", "r", "50 mm"),
        ("engine-forces", "F_z", "10 kN"),
        ("compressor-friction", "rho_B", "1 mm"),
        ("shaper-forces", "l_O2A", "100 mm"),
    ];
    for (name, parameter, value) in cases {
        let text = templates::instantiate(name, &[(parameter, value)]).unwrap();
        let scene = scene::read(&text).unwrap().value;
        let worked = work(&scene, Scope::Questions).unwrap().value;
        let Some(AnswerValue::Scalar(expected)) = answer(&scene, &worked, "M_b") else {
            panic!("{name}: no moment")
        };
        let own = scene::read(templates::get(name).unwrap()).unwrap().value;
        let variation = Variation::new(&own, &[parameter]).unwrap();
        let mut varied = own.clone();
        variation.set(&mut varied, &[variation.value(&own, parameter, value).unwrap()]).unwrap();
        let worked = work(&varied, Scope::Questions).unwrap().value;
        let Some(AnswerValue::Scalar(found)) = answer(&varied, &worked, "M_b") else {
            panic!("{name}: no moment")
        };
        near(found, expected);
    }
}

/// The balancing moment of a sweep has a compiled form, by the work of the loads. Together with a
/// reaction, which has none, each row is solved alone: both give the same values.
#[test]
fn compiled_balancing_moments_are_those_of_each_position() {
    let (mut failures, mut compiled) = (Vec::new(), 0);
    for template in templates::list() {
        let (name, text) = (template.name, templates::get(template.name).unwrap());
        let Ok(plain) = scene::read(text) else { continue };
        let [driver] = &plain.value.drivers[..] else { continue };
        // It is followed by Newton's method, in seconds.
        if name == "double-butterfly" {
            continue;
        }
        let mut json = if plain.value.loads.is_empty() {
            loaded(text, &plain.value).0
        } else {
            serde_json::from_str(text).unwrap()
        };
        json.as_object_mut().unwrap().remove("friction");
        if driver.kind.angle().is_some() {
            let link = plain.value.link_name(driver.kind.turned().unwrap().0);
            let points = json!([
                ["0 deg", "10 N*m"],
                ["90 deg", "20 N*m"],
                ["90 deg", "-5 N*m"],
                ["200 deg", "7 N*m"],
                ["360 deg", "10 N*m"]
            ]);
            let forces = json["forces"].as_array_mut().unwrap();
            forces.push(json!({"on": link, "diagram": {"turn": link, "points": points}}));
            forces.push(json!({"on": link, "M": "3 N*m", "against": "motion"}));
        }
        let balance = if driver.kind.turns() { "M_b" } else { "F_b" };
        let name_of = |l: usize| plain.value.link_name(LinkId(l));
        let pairs = (0..plain.value.links.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let joined = |(i, j): &(usize, usize)| {
            matches!(contacts(&plain.value, LinkId(*i), LinkId(*j))[..], [_])
        };
        let Some((i, j)) = pairs.into_iter().find(joined) else { continue };
        let reaction = format!("F_{},{}", name_of(i), name_of(j));
        let mut run = |find: Json| {
            json["find"] = find;
            let scene =
                scene::read(json.to_string()).unwrap_or_else(|f| panic!("{name}: {f}")).value;
            let mechanism = Mechanism::new(&scene).unwrap().value;
            let placed =
                PlacedScene::new(&scene, &mechanism).unwrap_or_else(|f| panic!("{name}: {f}"));
            let now = station::position_now(&scene, &placed.at, 0);
            let step = if driver.kind.turns() { 0.37 } else { 0.01 * placed.at.extent() };
            let values = (-4..=4).map(|k| now + step * f64::from(k)).collect();
            sweep::of_values(&placed, 0, values).unwrap()
        };

        let fast = run(json!([balance, "P"]));
        if fast.notes.iter().any(|n| n.code == "no-kernel") {
            continue;
        }
        let slow = run(json!([balance, "P", reaction]));
        compiled += 1;
        for k in 1..=2 {
            let (a, b) = (&fast.columns[k].values, &slow.columns[k].values);
            let size =
                a.iter().chain(b).filter(|x| x.is_finite()).fold(0.0, |m: f64, x| m.max(x.abs()));
            for (row, (a, b)) in a.iter().zip(b).enumerate() {
                // A row with an undetermined reaction has no numbers.
                if b.is_finite() && (a.is_nan() || (a - b).abs() > 1e-9 * size) {
                    failures
                        .push(format!("{name}: column {k}, row {row}: compiled {a}, solved {b}"));
                }
            }
        }
    }
    println!("{compiled} templates");
    assert!(compiled > 30, "{compiled} templates");
    assert!(failures.is_empty(), "{} failures:\n{}", failures.len(), failures.join("\n"));
}
