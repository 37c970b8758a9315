//! Tests of positions in the plane as text.

use super::*;
use crate::amount::amount;
use hodograph_base::geom::Point;
use hodograph_base::number::Ball;
use hodograph_scene::read;
use hodograph_worked::accuracy::Rung;
use hodograph_worked::certified::ladder::parts;
use hodograph_worked::certified::printed::with_printed;

/// Returns a crank with its answers in this unit.
fn asking(units: &str) -> Scene {
    let text = format!(
        r#"{{"links": {{"1": ["A", "B"], "2": ["A"]}}, "ground": "2", "lengths": {{"AB": "100 mm"}},
 "driver": {{"link": "1", "angle": "60 deg", "omega": "10 rad/s"}}, "find": ["x_B"]{units}}}"#
    );
    read(text).unwrap_or_else(|f| panic!("{f}")).value
}

/// Returns a position, certified to six digits.
fn certified(scene: &Scene, place: Point) -> Certified {
    let ball = |x: f64| Ball::new(x, 1e-15);
    let value = AnswerValue::Point(Point::new(ball(place.x), ball(place.y)));
    let what = &scene.find[0].what;
    let list =
        parts(what.kind(), value, 1.0, 6).and_then(|l| with_printed(&scene.book, what, value, l));
    Certified { rung: Rung::Double, parts: list.unwrap(), reading: None, why: None }
}

#[test]
fn a_place_is_told_by_its_coordinates() {
    let place = Point::new(-0.123456789, 6.83);
    let near = |scene: &Scene| {
        let (find, c, value) = (&scene.find[0], certified(scene, place), AnswerValue::Point(place));
        let text = value_words(&scene.book, find, value, &c, 6, Lang::En);
        let json = in_unit(&scene.book, find, value, &c, 6);
        (text, amount(&scene.book, find, value, &c, 4), json.to_string())
    };
    let told =
        |text: &str, sheet: &str, json: &str| (text.to_owned(), sheet.to_owned(), json.to_owned());
    assert_eq!(
        near(&asking("")),
        told("(−0.123457, 6.83000) m", "(−123.5, 6830)\\,\\text{mm}", "null")
    );
    let inches = asking(r#", "answers": {"length": "in"}"#);
    let json = r#"{"unit":"in","x":-4.860503503937008,"y":268.8976377952756,"text":"(-4.86050, 268.898)"}"#;
    assert_eq!(near(&inches), told("(−4.86050, 268.898) in", "(−4.861, 268.9)\\,\\text{in}", json));
    assert_eq!(value(AnswerValue::Point(place)).to_string(), r#"{"x":-0.123456789,"y":6.83}"#);
}
