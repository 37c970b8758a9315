//! Wrong gears and wheels.

use super::*;

const GEARS: &str = r#"{
 "units": {"length": "mm", "angle": "deg"},
 "links": {"1": ["A", "D"], "2": ["A", "B"], "3": ["D", "C"]},
 "ground": "1",
 "points": {"A": [0, 0], "D": [90, 0]},
 "lengths": {"AB": 20, "CD": 40},
 "gears": [PAIRS],
 "driver": {"link": "2", "angle": "60 deg", "omega": "10 rad/s"},
 "find": ["omega_3"]}"#;

const WHEEL: &str = r#"{
 "units": {"length": "m", "angle": "deg"},
 "links": {"1": ["O", "K"], "2": ["O", "A"], "3": ["A", "B"], "4": ["B"]},
 "ground": "1",
 "points": {"O": [0, 0], "A": [0.3, 0.4], "B": [1.1, 1], "K": [0.524, 0.832]},
 "rolling": [PAIRS],
 "driver": {"link": "2", "omega": "2 rad/s"},
 "find": ["omega_4"]}"#;

/// Returns a pair with other values of some keys: `null` omits one.
fn pair(of: &str, other: &str) -> String {
    let mut pair: serde_json::Map<String, serde_json::Value> = serde_json::from_str(of).unwrap();
    let other: serde_json::Map<String, serde_json::Value> =
        serde_json::from_str(&format!("{{{other}}}")).unwrap();
    for (key, value) in other {
        if value.is_null() {
            pair.remove(&key);
        } else {
            pair.insert(key, value);
        }
    }
    serde_json::Value::Object(pair).to_string()
}

fn gears(others: &[&str]) -> String {
    let usual =
        r#"{"links": ["2", "3"], "centres": ["A", "D"], "teeth": [20, 40], "phase": "0 deg"}"#;
    GEARS.replace("PAIRS", &others.iter().map(|o| pair(usual, o)).collect::<Vec<_>>().join(","))
}

fn wheels(others: &[&str]) -> String {
    let usual = r#"{"wheel": "4", "centre": "B", "radius": 0.2, "on": "1", "track": "K", "track_radius": 0.8, "inside": true}"#;
    WHEEL.replace("PAIRS", &others.iter().map(|o| pair(usual, o)).collect::<Vec<_>>().join(","))
}

/// The scenes, each with its name in the golden text.
pub(super) fn bad() -> Vec<(&'static str, String)> {
    let straight = r#""track": null, "track_radius": null, "inside": null"#;
    let on_line = |more: &str| format!("{straight}, {more}");
    let of_lines = [
        "\"line\": \"AB\"",
        "\"line\": \"O\"",
        "\"angle\": \"0 mm\"",
        "\"angle\": 0, \"phase\": 0",
    ]
    .map(on_line);
    let through = [
        "\"angle\": 0, \"through\": \"A\"",
        "\"angle\": 0, \"through\": [1]",
        "\"angle\": 0, \"on\": \"3\", \"through\": [1, 1]",
    ]
    .map(on_line);
    let through: Vec<&str> =
        through.iter().map(String::as_str).chain(["\"through\": \"O\""]).collect();
    let of_lines: Vec<&str> = of_lines.iter().map(String::as_str).chain([straight]).collect();
    let rack = |more: &str| {
        format!(r#""rack": "3", "centres": ["A"], "teeth": null, "phase": null, {more}"#)
    };
    let racks = [
        r#""radii": [20]"#,
        r#""radii": [20], "angle": "3 mm""#,
        r#""radii": [20], "line": "AB""#,
        r#""radii": [20, 30], "angle": 0"#,
        r#""teeth": [20], "angle": 0"#,
        r#""radii": [20], "angle": 0, "phase": 0"#,
        r#""radii": [20], "angle": 0, "ring": "2""#,
        r#""radii": [20], "angle": 0, "centres": ["D"]"#,
        r#""radii": [20], "angle": 0, "centres": ["A", "D"]"#,
    ]
    .map(rack);
    let racks: Vec<&str> = racks.iter().map(String::as_str).collect();
    vec![
        (
            "gears by name",
            gears(&[
                r#""links": ["2", "9"]"#,
                r#""centres": ["A", "X"]"#,
                r#""ring": "7""#,
                r#""rack": "1""#,
                r#""centers": ["A", "D"]"#,
            ]),
        ),
        (
            "gears by type",
            gears(&[
                r#""links": "23""#,
                r#""centres": [1, 2]"#,
                r#""teeth": "20""#,
                r#""teeth": null, "radii": 30"#,
                r#""ring": 3"#,
                r#""phase": "1 mm""#,
                r#""at": 5"#,
            ]),
        ),
        ("gears as one", GEARS.replace("[PAIRS]", r#"{"links": ["2", "3"]}"#)),
        (
            "gears by count",
            gears(&[
                r#""links": ["2"]"#,
                r#""links": ["2", "3", "1"]"#,
                r#""centres": ["A"]"#,
                r#""centres": ["A", "D", "B"]"#,
                r#""teeth": [20]"#,
                r#""teeth": null, "radii": [30]"#,
            ]),
        ),
        (
            "gears by size",
            gears(&[
                r#""radii": [30, 60]"#,
                r#""teeth": null"#,
                r#""teeth": null, "module": 2"#,
                r#""teeth": [0, 40]"#,
                r#""teeth": [20.5, "-20"]"#,
                r#""teeth": ["20 mm", 200000]"#,
                r#""module": "-2 mm""#,
                r#""teeth": null, "radii": [-30, 0]"#,
                r#""teeth": null, "radii": ["30 deg", 60]"#,
            ]),
        ),
        (
            "gears elsewhere",
            gears(&[r#""centres": ["D", "A"]"#, r#""links": ["2", "2"], "centres": ["A", "B"]"#]),
        ),
        (
            "rings",
            gears(&[
                r#""ring": "2""#,
                r#""ring": "3", "teeth": [20, 20]"#,
                r#""angle": 0"#,
                r#""line": "AD""#,
            ]),
        ),
        ("racks", gears(&racks)),
        ("contacts", gears(&[r#""at": "A""#, r#""at": "C""#, r#""at": "K,""#, r#""at": """#])),
        (
            "questions at a contact",
            gears(&[""]).replace(r#""omega_3""#, r#""v_Q", "a_QD", "v_Q9", "x_Q", "v_Q3""#),
        ),
        (
            "a phase too many",
            gears(&[""]).replace(r#""D": [90, 0]"#, r#""D": [90, 0], "C": [90, 40]"#),
        ),
        (
            "wheels by name",
            wheels(&[
                r#""wheel": "9""#,
                r#""centre": "X""#,
                r#""on": "8""#,
                r#""track": "Y""#,
                r#""raduis": 0.2"#,
            ]),
        ),
        (
            "wheels by type",
            wheels(&[
                r#""wheel": 4"#,
                r#""centre": ["B"]"#,
                r#""radius": "big""#,
                r#""inside": "yes""#,
                r#""track_radius": "80 deg""#,
            ]),
        ),
        ("wheels without", wheels(&[r#""wheel": null"#, r#""centre": null"#, r#""radius": null"#])),
        (
            "wheels by size",
            wheels(&[
                r#""radius": -0.2"#,
                r#""radius": 0"#,
                r#""track_radius": -0.8"#,
                r#""radius": 0.9"#,
            ]),
        ),
        (
            "wheels elsewhere",
            wheels(&[r#""centre": "A""#, r#""track": "B""#, r#""on": "4", "track": "B""#]),
        ),
        (
            "round tracks",
            wheels(&[
                r#""track_radius": null"#,
                r#""track": null"#,
                r#""track": null, "track_radius": null"#,
                r#""angle": 0"#,
            ]),
        ),
        ("straight tracks", wheels(&of_lines)),
        ("tracks through", wheels(&through)),
        ("wheels in a list of two kinds", WHEEL.replace("PAIRS", "3, \"4\", {}")),
        ("wheels in no list", WHEEL.replace("[PAIRS]", "\"4\"")),
        (
            "a wheel that is driven",
            wheels(&[""]).replace(
                r#""link": "2", "omega": "2 rad/s""#,
                r#""slide": "A", "velocity": "1 m/s""#,
            ),
        ),
    ]
}

/// The note on a train given by its numbers of teeth, and the conditions for it.
#[test]
fn free_centres_are_told() {
    let train = r#"{"links": {"1": ["O"], "2": ["O", "P"], "3": ["P"], "4": ["O"]}, "ground": "1",
      "gears": [{"links": ["4", "3"], "centres": ["O", "P"], "teeth": ["z", 21]}, {"links": ["3", "1"], "centres": ["P", "O"], "teeth": [21, 62], "ring": "1"}],
      "parameters": {"z": 20}, "driver": {"link": "4", "omega": "1 rad/s"}, "find": ["omega_2"]}"#;
    let scene = read(train).unwrap();
    let place =
        |name: &str| match &scene.value.points.iter().find(|p| p.name == name).unwrap().place {
            PointPlace::At([x, y]) => [x.value, y.value],
            other => panic!("{other:?}"),
        };
    // (20 + 21)/2 times 1 mm.
    assert_eq!((place("O"), place("P")), ([0.0, 0.0], [0.0205, 0.0]));
    let code = |source: &str| {
        read(source).map_or_else(|f| f.list, |s| s.notes).iter().map(|d| d.code).collect::<Vec<_>>()
    };
    assert_eq!(code(train), ["free-centre"]);
    // A question that depends on the place gets no assumed place; an arm with a given place keeps
    // it.
    assert_eq!(code(&train.replace("\"omega_2\"", "\"omega_2\", \"v_P\"")), [""; 0]);
    assert_eq!(
        code(&train.replace(
            "\"parameters\"",
            "\"points\": {\"O\": [0, 0], \"P\": [\"30 mm\", 0]}, \"parameters\""
        )),
        [""; 0]
    );
    // The place of a planet that moves another link, or of an arm with a further point, has an
    // effect.
    assert_eq!(code(&train.replace("\"3\": [\"P\"]", "\"3\": [\"P\", \"M\"]")), [""; 0]);
    assert_eq!(
        code(&train.replace("\"2\": [\"O\", \"P\"]", "\"2\": [\"O\", \"P\", \"M\"]")),
        [""; 0]
    );
    // The angle of a driven arm is kept; its length is free.
    let arm = train
        .replace(
            "\"driver\": {\"link\": \"4\"",
            "\"driver\": {\"link\": \"2\", \"angle\": \"50 deg\"",
        )
        .replace("omega_2\"]", "omega_4\"]");
    let scene = read(&arm).unwrap().value;
    assert!(scene.points.iter().filter(|p| matches!(p.place, PointPlace::At(_))).count() == 1);
    assert!((scene.lengths[0].value.value - 0.0205).abs() < 1e-15);
}

/// A track through a point keeps the wheel's centre at its radius, to the left.
#[test]
fn a_track_runs_through_its_point() {
    let source = wheels(&[
        r#""track": null, "track_radius": null, "inside": null, "angle": 0, "through": [0, 1]"#,
    ]);
    let scene = read(&source).unwrap().value;
    let GuidePath::Line { through: Through::At([_, y]), offset: Some(offset), .. } =
        &scene.guides[0].path
    else {
        panic!("{:?}", scene.guides[0].path)
    };
    assert_eq!((y.value, offset.value), (1.0, 0.2));
    let anywhere = read(source.replace(r#","through":[0,1]"#, "")).unwrap().value;
    assert!(
        matches!(
            anywhere.guides[0].path,
            GuidePath::Line { through: Through::Pin, offset: None, .. }
        ),
        "{source}"
    );
}
