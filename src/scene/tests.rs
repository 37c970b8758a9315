//! Whole scenes, good and bad: what the reader makes of them, and what it says.

use super::*;
use crate::scene::units::radians;

/// Reads a scene that must be good and without remarks.
fn good(source: &str) -> Scene {
    match read(source) {
        Ok(scene) => {
            assert_eq!(scene.notes, []);
            scene.value
        }
        Err(faults) => panic!("{}", crate::report::diagnostics::render(&faults, "scene.json", source)),
    }
}

/// A scene with a section replaced or added.
fn with(section: &str, value: &str) -> String {
    let sections = [
        ("links", r#"{"1": ["A", "B"], "2": ["B", "C", "E"], "3": ["C", "D"], "4": ["A", "D"]}"#),
        ("ground", r#""4""#),
        ("lengths", r#"{"AB": "100 mm", "BC": "250 mm", "CD": "200 mm", "AD": "300 mm", "BE": "150 mm", "CE": "140 mm"}"#),
        ("driver", r#"{"link": "1", "angle": "60 deg", "omega": "10 rad/s"}"#),
    ];
    let mut parts: Vec<String> = sections.iter().filter(|(k, _)| *k != section).map(|(k, v)| format!("\"{k}\": {v}")).collect();
    if !value.is_empty() {
        parts.push(format!("\"{section}\": {value}"));
    }
    format!("{{{}}}", parts.join(",\n "))
}

/// The faults of a scene: the text under each span, then the message and the help.
fn faults(source: &str) -> String {
    let list = match read(source) {
        Ok(scene) => scene.notes,
        Err(faults) => faults.list,
    };
    let place =
        |d: &crate::diag::Diagnostic| d.span.map_or("", |s| source.get(s.start..s.end).expect("a span between characters")).to_owned();
    list.iter().map(|d| format!("[{}] {d}\n", place(d))).collect()
}

#[test]
fn the_first_example() {
    let scene = good(&with("find", r#"["v_E", "a_E", "omega_3", "alpha_3"]"#));
    let names: Vec<_> = scene.points.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["A", "B", "C", "E", "D"]);
    assert_eq!(scene.ground, LinkId(3));
    let lengths: Vec<_> = scene.lengths.iter().map(|l| l.value.value).collect();
    assert_eq!(lengths, [0.1, 0.25, 0.2, 0.3, 0.15, 0.14]);
    let Place::At([x, y]) = &scene.points[4].place else { panic!("{:?}", scene.points[4]) };
    assert_eq!((x.value, y.value, x.text.as_str()), (0.3, 0.0, "300 mm"));
    let Place::At([x, y]) = &scene.points[0].place else { panic!("{:?}", scene.points[0]) };
    assert_eq!((x.value, y.value), (0.0, 0.0));
    let DriverKind::Turn { link: LinkId(0), against: LinkId(3), line: None, angle: Some(angle), .. } = &scene.drivers[0].kind else {
        panic!("{:?}", scene.drivers)
    };
    assert_eq!(angle.value, Angle::Deg(60.0));
    assert_eq!(scene.drivers[0].rate.value, 10.0);
    assert_eq!(scene.find[2].what, Asked::Omega(LinkId(2)));
}
