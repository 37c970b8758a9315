//! Drawn groups, compared with the rows.

use hodograph::figure::sheet::SheetOptions;
use hodograph::lesson::reveal;
use hodograph::scene::{self, Lang, templates};
use hodograph::worked::{Scope, work};
use serde_json::{Value as Json, json};

/// A leg from a pin X of link 4 to the ground, as parts of a scene: links, guides and a driver. `G`
/// and `H` are its points on the ground.
fn leg(kind: &str, x: &str, g: &str, link: &str) -> (Json, Json, Json) {
    let (none, slot) = (json!([]), if x == "Q" { "QV" } else { "RW" });
    match kind {
        "bar" => (json!({link: [x, g]}), none.clone(), none),
        "block" => (
            json!({link: [x]}),
            json!([{"slider": link, "on": "1", "pin": x, "angle": "25 deg"}]),
            none,
        ),
        "sleeve" => {
            (json!({link: [g]}), json!([{"pin": g, "slider": link, "on": "4", "line": slot}]), none)
        }
        "slot" => (json!({}), json!([{"pin": g, "on": "4", "line": slot}]), none),
        _ => (json!({}), none, json!([{"cylinder": format!("{x}{g}"), "rate": "0.3 m/s"}])),
    }
}

/// A link on three legs of all kinds, loaded everywhere: the drawing gives all reactions, equal to
/// those of the rows.
#[test]
fn a_link_on_three_legs_is_drawn() {
    let kinds = ["bar", "block", "sleeve", "slot", "cylinder"];
    let mut failures = Vec::new();
    for (a, b) in kinds.iter().flat_map(|a| kinds.iter().map(move |b| (a, b))) {
        let (to_q, to_r) = (leg(a, "Q", "G", "5"), leg(b, "R", "H", "6"));
        let mut links = json!({"1": ["O", "G", "H"], "2": ["O", "A"], "3": ["A", "P"], "4": ["P", "Q", "V", "R", "W", "T"]});
        for part in [&to_q.0, &to_r.0] {
            links.as_object_mut().unwrap().extend(part.as_object().unwrap().clone());
        }
        let list = |a: &Json, b: &Json| -> Vec<Json> {
            [a, b].into_iter().flat_map(|l| l.as_array().unwrap().clone()).collect()
        };
        let crank = json!([{"link": "2", "omega": "2 rad/s", "alpha": "1 rad/s^2"}]);
        let drivers = list(&crank, &json!(list(&to_q.2, &to_r.2)));
        let named: Vec<String> =
            links.as_object().unwrap().keys().filter(|l| *l != "1").cloned().collect();
        // A block that slides on the link carries couples only.
        let sleeve = |l: &str| (l == "5" && *a == "sleeve") || (l == "6" && *b == "sleeve");
        let forces = named.iter().enumerate().flat_map(|(k, l)| {
            let point = links[l].as_array().unwrap().last().unwrap().clone();
            let force = json!({"on": l, "at": point, "F": [format!("{} N", 40 + 13 * k), format!("{} N", 17 * k as i32 - 50)]});
            let couple = json!({"on": l, "M": format!("{} N*m", 7 + 3 * k)});
            if sleeve(l) { vec![couple] } else { vec![force, couple] }
        });
        let mut find = vec!["F_12".to_owned(), "F_23".into(), "F_34".into(), "M_b".into()];
        for (kind, l) in [(a, "5"), (b, "6")] {
            find.extend(match *kind {
                "slot" => vec!["F_14".to_owned()],
                "cylinder" => vec![],
                "bar" => vec![format!("F_{l}4"), format!("F_1{l}")],
                _ => vec![
                    format!("F_{l}4"),
                    format!("F_1{l}"),
                    format!("h_{}{l}", if *kind == "block" { "1" } else { "4" }),
                ],
            });
        }
        if (*a, *b) == ("slot", "slot") {
            find.retain(|f| f != "F_14");
        }
        let scene = json!({
            "links": links, "ground": "1", "driver": drivers, "guides": list(&to_q.1, &to_r.1),
            "points": {
                "O": ["0 m", "0 m"], "A": ["1 m", "2 m"], "P": ["4 m", "5 m"], "Q": ["7 m", "4.2 m"], "R": ["6.1 m", "7.3 m"], "T": ["5.5 m", "5.7 m"],
                "G": ["9 m", "0.3 m"], "H": ["2 m", "10 m"], "V": ["8 m", "2.25 m"], "W": ["4.05 m", "8.65 m"]
            },
            "gravity": ["0", "-9.81 m/s^2"], "masses": {"4": {"m": "5 kg", "J": "4 kg*m^2", "at": "T"}, "3": {"m": "2 kg", "J": "1 kg*m^2", "at": "A"}},
            "forces": forces.collect::<Vec<_>>(), "find": find
        });
        let scene = scene::read(scene.to_string()).unwrap_or_else(|f| panic!("{a} {b}: {f}")).value;
        let worked =
            work(&scene, Scope::Questions).unwrap_or_else(|f| panic!("{a} {b}: {f}")).value;
        for r in &worked.results {
            let find = &scene.find[r.find].text;
            match r.agreement {
                None => failures.push(format!("{a} {b}: {find} is not drawn")),
                Some(agreement) if !agreement.holds() => {
                    failures.push(format!("{a} {b}: {find}: {agreement:?}"))
                }
                Some(_) => {}
            }
        }
    }
    assert!(failures.is_empty(), "{} failures:\n{}", failures.len(), failures.join("\n"));
}

/// The link on which a pin rubs does not depend on the order: for a pin of several links the file
/// names it.
#[test]
fn a_rough_pin_of_three_links_tells_where_it_is_fast() {
    let mut scene: Json = serde_json::from_str(templates::get("toggle-clamp").unwrap()).unwrap();
    let pin =
        scene["friction"].as_array_mut().unwrap().iter_mut().find(|f| f["pin"] == "B").unwrap();
    pin.as_object_mut().unwrap().remove("on");
    let faults = scene::read(scene.to_string()).unwrap_err().to_string();
    assert!(
        faults.contains(
            "`B` joins 3 links: in which of them is the pin fast? (write \"on\", one of 2, 3, 4)"
        ),
        "{faults}"
    );
}

/// Two links joined by two bars, with any of them loaded, in many places: the drawing gives all
/// reactions, equal to those of the rows.
#[test]
fn two_links_on_two_bars_are_drawn() {
    let places = [
        ("O", 0, 0),
        ("A", 20, 10),
        ("B", 35, 36),
        ("C", 52, 19),
        ("D", 64, 51),
        ("E", 83, 26),
        ("F", 90, 60),
    ];
    let links = json!({"1": ["O", "A"], "2": ["A", "B", "C"], "3": ["B", "D"], "4": ["C", "E"], "5": ["D", "E", "F"], "6": ["O", "F"]});
    let mut failures = Vec::new();
    for n in 0..64usize {
        // Places that differ by fixed steps; the bits of a number choose the loaded links.
        let moved = |k: usize, side: usize| ((n * 7 + k * 5 + side * 3) % 11) as i32 - 5;
        let points: serde_json::Map<String, Json> = places
            .iter()
            .enumerate()
            .map(|(k, (name, x, y))| {
                (
                    (*name).into(),
                    json!([format!("{} cm", x + moved(k, 0)), format!("{} cm", y + moved(k, 1))]),
                )
            })
            .collect();
        let loaded = (2..=5).filter(|l| (n % 16) >> (l - 2) & 1 == 1);
        let forces: Vec<Json> = loaded
            .flat_map(|l| {
                let at = links[l.to_string()].as_array().unwrap().last().unwrap().clone();
                let force = json!({"on": l.to_string(), "at": at, "F": [format!("{} N", 60 - 25 * l), format!("{} N", 31 * l - 80)]});
                [force, json!({"on": l.to_string(), "M": format!("{} N*m", 4 * l - 9)})]
            })
            .collect();
        let scene = json!({
            "links": links, "ground": "6", "driver": {"link": "1", "omega": "2 rad/s"}, "points": points, "forces": forces,
            "masses": {"1": {"m": "1 kg", "J": "1 kg*m^2", "at": "A"}},
            "find": ["F_12", "F_65", "F_23", "F_24", "F_35", "F_45", "M_b"]
        });
        let scene = scene::read(scene.to_string()).unwrap_or_else(|f| panic!("{n}: {f}")).value;
        let done = work(&scene, Scope::Figure).unwrap_or_else(|f| panic!("{n}: {f}")).value;
        for r in &done.results {
            match (&r.drawn, r.agreement) {
                (Some(_), Some(a)) if a.holds() => {}
                (drawn, agreement) => failures
                    .push(format!("{n}: {} {drawn:?} {agreement:?}", scene.find[r.find].text)),
            }
        }
    }
    assert!(failures.is_empty(), "{} failures\n{}", failures.len(), failures.join("\n"));
}

/// Drawn answers with their names; none of them differs from the rows.
fn drawn(scene: Json) -> Vec<String> {
    let scene = scene::read(scene.to_string()).unwrap().value;
    let worked = work(&scene, Scope::Questions).unwrap().value;
    let all =
        worked.results.iter().filter_map(|r| Some((scene.find[r.find].text.clone(), r.agreement?)));
    all.inspect(|(text, a)| assert!(a.holds(), "{text}: {a:?}")).map(|(text, _)| text).collect()
}

/// A cylinder on the pin of another: its force is a load of that pin.
#[test]
fn two_cylinders_on_one_pin_press_on_each_other() {
    let found = drawn(json!({
        "links": {"1": ["A", "B", "D"], "2": ["A", "C"], "3": ["D", "E"]}, "ground": "1",
        "points": {"A": [0, 0], "B": ["0.5 m", "-0.4 m"], "D": ["1.6 m", "0 m"], "C": ["0.6 m", "0.3 m"], "E": ["1.5 m", "0.7 m"]},
        "driver": [{"cylinder": "BC", "rate": "0.2 m/s"}, {"cylinder": "CE", "rate": "0.1 m/s"}],
        "forces": [{"on": "3", "at": "E", "F": ["40 N", "-90 N"]}, {"on": "2", "M": "7 N*m"}],
        "find": ["F_12", "F_13", "F_b", "F_b2", "P"]
    }));
    assert_eq!(found, ["F_12", "F_13", "F_b", "F_b2", "P"]);
}

/// A pin on no link runs in slots of three links: if one of them is not drawn, neither are the
/// others.
#[test]
fn a_pin_between_slots_hands_its_force_on() {
    let found = drawn(json!({
        "links": {"1": ["A", "B"], "2": ["A", "C"], "3": ["B", "D"]}, "ground": "1",
        "points": {"A": [0, 0], "B": ["1 m", "0 m"], "C": ["0.5 m", "0.5 m"], "D": ["0.2 m", "1.2 m"], "P": ["0.6 m", "0.6 m"]},
        "guides": [{"pin": "P", "on": "2", "line": "AC"}, {"pin": "P", "on": "1", "through": [0, "0.6 m"], "angle": "0 deg"}, {"pin": "P", "on": "3", "line": "BD"}],
        "driver": {"link": "2", "omega": "2 rad/s"},
        "forces": [{"on": "3", "at": "D", "F": ["10 N", "-20 N"]}],
        "find": ["F_12", "M_b", "P"]
    }));
    assert!(found.is_empty() || found.len() == 3, "{found:?}");
}

/// A block in a curved guide turns about the centre of the arc: with the guide on the ground, on a
/// rocker, and driven.
#[test]
fn blocks_in_curved_guides_are_drawn() {
    let loads = json!({"3": {"m": "4 kg", "J": "0.01 kg*m^2", "at": "C"}, "2": {"m": "2 kg", "J": "0.02 kg*m^2", "at": "B"}});
    let on_ground = drawn(json!({
        "links": {"1": ["A", "B"], "2": ["B", "C"], "4": ["A", "K"]}, "ground": "4",
        "points": {"A": [0, 0], "K": ["180 mm", "-140 mm"]}, "lengths": {"AB": "60 mm", "BC": "170 mm"},
        "guides": [{"pin": "C", "slider": "3", "on": "4", "centre": "K", "radius": "170 mm"}],
        "driver": {"link": "1", "angle": "50 deg", "omega": "10 rad/s"}, "sketch": {"C": ["200 mm", "25 mm"]},
        "forces": [{"on": "2", "at": "C", "F": "300 N", "angle": "200 deg"}, {"on": "3", "M": "5 N*m"}],
        "masses": loads.clone(), "gravity": [0, "-9.81 m/s^2"],
        "find": ["F_43", "F_23", "F_12", "F_41", "M_b"]
    }));
    assert_eq!(on_ground.len(), 5, "{on_ground:?}");
    let on_rocker = drawn(json!({
        "links": {"1": ["A", "B"], "2": ["D", "K"], "4": ["A", "D"]}, "ground": "4",
        "points": {"A": [0, 0], "D": ["200 mm", "-20 mm"]}, "lengths": {"AB": "60 mm", "DK": "90 mm"},
        "guides": [{"pin": "B", "slider": "3", "on": "2", "centre": "K", "radius": "150 mm"}],
        "driver": {"link": "1", "angle": "70 deg", "omega": "10 rad/s"}, "sketch": {"K": ["160 mm", "70 mm"]},
        "forces": [{"on": "2", "M": "20 N*m"}, {"on": "3", "at": "B", "F": ["30 N", "-80 N"]}],
        "find": ["F_42", "F_23", "F_13", "F_41", "M_b"]
    }));
    assert_eq!(on_rocker.len(), 5, "{on_rocker:?}");
    let driven = drawn(json!({
        "links": {"1": ["A", "B"], "2": ["B", "C"], "4": ["A", "K"]}, "ground": "4",
        "points": {"A": [0, 0], "K": ["180 mm", "-140 mm"]}, "lengths": {"AB": "60 mm", "BC": "170 mm"},
        "guides": [{"pin": "C", "slider": "3", "on": "4", "centre": "K", "radius": "170 mm"}],
        "driver": {"slide": "C", "position": "250 mm", "velocity": "0.3 m/s"}, "sketch": {"B": ["40 mm", "45 mm"], "C": ["200 mm", "29 mm"]},
        "forces": [{"on": "1", "M": "8 N*m"}], "masses": loads,
        "find": ["F_43", "F_23", "F_12", "F_41", "F_b", "P"]
    }));
    assert_eq!(driven.len(), 6, "{driven:?}");
}

/// A fragment for slides has a step for every item of the forces, after those of the motion.
#[test]
fn fragments_reveal_forces() {
    let scene = scene::read(templates::get("press-forces").unwrap()).unwrap().value;
    let worked = work(&scene, Scope::Figure).unwrap().value;
    let svg = reveal(&scene, &worked, &SheetOptions::of_language(Lang::En)).unwrap().value;
    let fragments: Vec<(usize, &str)> = svg
        .split("data-fragment-index=\"")
        .skip(1)
        .map(|part| {
            let (index, rest) = part.split_once('"').unwrap();
            (index.parse().unwrap(), rest.split("</g>").next().unwrap())
        })
        .collect();
    let steps = |of: &str| -> Vec<usize> {
        fragments.iter().filter(|(_, part)| part.contains(of)).map(|(n, _)| *n).collect()
    };
    let (motion, forces) = (steps("class=\"acceleration "), steps("class=\"force"));
    let groups = worked.equilibrium.as_ref().unwrap().groups.len();
    assert!(
        groups == 3 && forces.len() > 3 * groups && !motion.is_empty(),
        "{} and {}",
        motion.len(),
        forces.len()
    );
    assert!(motion.iter().max() < forces.iter().min(), "{motion:?} {forces:?}");
}

/// Links that bars join in a ring, loaded everywhere: two with parallel bars, or with a bar and a
/// block (class IV), three (class VI). The force along one bar is found by two trials.
#[test]
fn rings_of_bars_are_drawn() {
    for (name, count) in [("class4-parallel", 8), ("class4-slot", 8), ("class6-ring", 11)] {
        let file = std::fs::read_to_string(format!("tests/cases/higher-{name}.json")).unwrap();
        let mut scene = serde_json::from_str::<Json>(&file).unwrap()["scene"].clone();
        let links = scene["links"].as_object().unwrap().clone();
        let points = |link: &str| -> Vec<&str> {
            links[link].as_array().unwrap().iter().filter_map(Json::as_str).collect()
        };
        let names: Vec<&str> = links.keys().map(String::as_str).collect();
        let moving: Vec<&str> = names.iter().copied().filter(|l| scene["ground"] != **l).collect();
        let forces = moving.iter().enumerate().flat_map(|(k, l)| {
            let force = json!({"on": l, "at": points(l).last(), "F": [format!("{} N", 40 + 13 * k), format!("{} N", 17 * k as i32 - 50)]});
            [force, json!({"on": l, "M": format!("{} N*m", 5 + 3 * k)})]
        });
        let mut forces: Vec<Json> = forces.collect();
        let joined = |a: &str, b: &str| points(a).iter().any(|p| points(b).contains(p));
        let pairs = names
            .iter()
            .enumerate()
            .flat_map(|(k, a)| names[k + 1..].iter().map(move |b| (*a, *b)));
        let mut find: Vec<String> =
            pairs.filter(|(a, b)| joined(a, b)).map(|(a, b)| format!("F_{a},{b}")).collect();
        find.push("P".into());
        if scene["guides"].is_array() {
            forces.extend([
                json!({"on": "4", "at": "C", "F": ["33 N", "-71 N"]}),
                json!({"on": "4", "M": "9 N*m"}),
            ]);
            find.extend(["F_54".into(), "h_54".into()]);
        }
        scene["forces"] = json!(forces);
        scene["find"] = json!(find);
        assert_eq!(drawn(scene), find, "{name}");
        assert_eq!(find.len(), count, "{name}");
    }
}
