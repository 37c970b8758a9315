//! The table of quantities: what every line of it promises.

use super::*;
use crate::geom::Point;
use crate::scene::{Scene, read, templates};
use crate::worked::{Scope, work};

/// A four-bar with a coupler point that asks these questions.
fn asking(find: &str) -> Scene {
    let text = format!(
        r#"{{"links": {{"1": ["A", "B"], "2": ["B", "C", "E"], "3": ["C", "D"], "4": ["A", "D"]}}, "ground": "4",
 "lengths": {{"AB": "100 mm", "BC": "250 mm", "CD": "200 mm", "AD": "300 mm", "BE": "150 mm", "CE": "140 mm"}},
 "driver": {{"link": "1", "angle": "60 deg", "omega": "10 rad/s"}}, "find": [{find}]}}"#
    );
    read(text).unwrap_or_else(|f| panic!("{f}")).value
}

#[test]
fn every_line_is_read_from_its_example() {
    let lines: Vec<&Entry> = TABLES.iter().copied().flatten().collect();
    assert!(lines.len() >= 15, "only {} lines", lines.len());
    for line in lines {
        let scene = asking(&format!("\"{}\"", line.example));
        assert_eq!(scene.find[0].what.entry(), line, "{}", line.example);
        assert_eq!(line.example.split_once('_').map(|e| e.0), Some(line.symbol));
    }
}

#[test]
fn lines_of_one_symbol_are_of_one_kind() {
    for line in TABLES.iter().copied().flatten() {
        let first = symbols().into_iter().find(|e| e.symbol == line.symbol).unwrap();
        assert_eq!((line.kind, line.form, line.letter, line.over), (first.kind, first.form, first.letter, first.over), "{}", line.example);
    }
}

#[test]
fn answers_have_the_form_that_the_table_says() {
    for t in templates::list() {
        let scene = read(templates::get(t.name).unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Questions).unwrap_or_else(|f| panic!("{}: {f}", t.name)).value;
        for r in &worked.results {
            let find = &scene.find[r.find];
            let entry = find.what.entry();
            for value in r.drawn.iter().map(|d| d.value).chain([r.computed]) {
                assert_eq!(value.form(), entry.form, "{} {}", t.name, find.text);
                assert_eq!(value.columns().len(), entry.form.columns().len());
            }
            // What is answered by a formula is known to be wanted.
            assert!(find.what.needs().iter().any(|n| n.1 == entry.level), "{} {}", t.name, find.text);
        }
    }
}

#[test]
fn places_agree_by_their_distance() {
    let agree = |off: f64| {
        let (a, b) = (Value::Point(Point::new(1e-9, off)), Value::Point(Point::new(1e-9, 0.0)));
        crate::accuracy::compare(a, b, 0.5, 1.0)
    };
    // Near the origin a place is no less certain than elsewhere.
    assert!(agree(1e-13).holds() && !agree(1e-10).holds());
    assert_eq!(agree(1e-3).difference, 2e-3);
    assert!(!crate::accuracy::compare(Value::Point(Point::ORIGIN), Value::Scalar(0.0), 1.0, 1.0).holds());
}

#[test]
fn ratios_are_those_of_the_teeth() {
    // Sun 2 of 40 teeth, planet 4 of 20, ring 1 of 80 fixed, arm 3.
    let text = templates::get("planetary-gear").unwrap();
    let asking = |find: &str| text.replace(r#""find": ["#, &format!(r#""find": ["{find}", "#));
    for (find, expected) in
        [("i_2,3", 3.0), ("i_3/2", 1.0 / 3.0), ("i_24", -1.0), ("i_24/3", -0.5), ("i_21/3", -2.0), ("i_41/3", 4.0), ("i_14/3", 0.25)]
    {
        let scene = read(asking(find)).unwrap_or_else(|f| panic!("{find}: {f}")).value;
        let worked = work(&scene, Scope::Questions).unwrap().value;
        let outcome = worked.results.iter().find(|r| r.find == 0).unwrap_or_else(|| panic!("{find} is not answered"));
        for value in [outcome.drawn.as_ref().map(|d| d.value), Some(outcome.computed)] {
            let Some(Value::Scalar(i)) = value else { panic!("{find}: {value:?}") };
            assert!((i - expected).abs() < 1e-13, "{find}: {i}");
        }
    }
    for wrong in ["i_22", "i_1,2", "i_24/4", "i_3", "i_24/9"] {
        let faults = read(asking(wrong)).unwrap_err();
        assert!(faults.list.iter().all(|d| d.code == "find" || d.help.is_some()), "{wrong}: {faults}");
    }
    // A link that stands still divides nothing.
    let still = text.replace("240 rpm", "0 rpm").replace(r#""find": ["#, r#""find": ["i_24", "#);
    let scene = read(still).unwrap().value;
    let worked = work(&scene, Scope::Questions).unwrap().value;
    assert!(worked.results.iter().all(|r| r.find != 0));
    assert!(worked.unanswered.iter().any(|u| u.find == 0));
}
