//! Cost of cams: profiles of one circle, of arcs and lines, and by laws, each compiled; and a whole
//! turn of each, including the search for its joints and its placing.

use super::{Variant, chunk_of, scene};
use hodograph::mechanism::Mechanism;
use hodograph::scene::{Angle, Scene};
use hodograph::sweep::{self, PlacedScene, Stations, Width};
use std::hint::black_box;

/// Positions of a turn.
const TURN: usize = 360;

/// A cam with this number of translating roller followers; the velocity and acceleration of each
/// are asked for.
fn cam(profile: &str, followers: usize) -> Scene {
    let each =
        |text: &dyn Fn(usize) -> String| (1..=followers).map(text).collect::<Vec<_>>().join(", ");
    let links = each(&|k| format!(r#""f{k}": ["B{k}"]"#));
    let angle = |k: usize| 90 - 20 * (k as i32 - 1);
    let guides = each(&|k| {
        format!(
            r#"{{"pin": "B{k}", "slider": "f{k}", "on": "1", "through": "O", "angle": "{} deg"}}"#,
            angle(k)
        )
    });
    let sketch = each(&|k| {
        let (s, c) = libm::sincos(f64::from(angle(k)).to_radians());
        format!(r#""B{k}": ["{} mm", "{} mm"]"#, 50.0 * c, 50.0 * s)
    });
    let cams = each(&|k| {
        format!(
            r#"{{"cam": "2", "follower": "f{k}", "roller": {{"pin": "B{k}", "radius": "8 mm"}}, "profile": {profile}}}"#
        )
    });
    let find = each(&|k| format!(r#""v_B{k}", "a_B{k}""#));
    let text = format!(
        r#"{{"links": {{"1": ["O"], "2": ["O", "Q"], {links}}}, "ground": "1", "points": {{"O": [0, 0]}}, "lengths": {{"OQ": "20 mm"}},
        "guides": [{guides}], "sketch": {{{sketch}}}, "cams": [{cams}],
        "driver": {{"link": "2", "angle": "40 deg", "omega": "10 rad/s"}}, "find": [{find}]}}"#
    );
    scene(&text).over_a_turn()
}

/// A whole turn, as `sweep` computes it.
fn turn(scene: Scene) -> (Box<dyn FnMut()>, usize) {
    let stations = Stations::turned(Angle::Deg(0.0), Angle::Deg(359.0), TURN - 1);
    let run = move || {
        let m = Mechanism::new(&scene).unwrap().value;
        let placed = PlacedScene::new(&scene, &m).unwrap();
        black_box(sweep::run(&placed, 0, &stations, Width::Widest).unwrap());
    };
    (Box::new(run), TURN)
}

pub fn variants() -> Vec<Variant> {
    let circle = r#"{"centre": "Q", "radius": "30 mm"}"#;
    let tangent = r#"[{"centre": "O", "radius": "25 mm"}, "tangent", {"centre": "Q", "radius": "10 mm"}, "tangent"]"#;
    let law = |law: &str| {
        format!(
            r#"{{"base": "25 mm", "law": [{{"rise": "20 mm", "over": "120 deg", "law": "{law}"}}, {{"dwell": "60 deg"}},
        {{"return": "20 mm", "over": "120 deg", "law": "{law}"}}, {{"dwell": "60 deg"}}]}}"#
        )
    };
    let mut out: Vec<Variant> = Vec::new();
    for (name, profile) in [
        ("of one circle", circle.to_owned()),
        ("of arcs and lines", tangent.to_owned()),
        ("by the cycloidal law", law("cycloidal")),
        ("by the 3-4-5 law", law("3-4-5")),
    ] {
        out.extend([1, 3, 10].map(|n| {
            (format!("cam {name}, {n} followers"), chunk_of(&cam(&profile, n), Width::Widest))
        }));
        out.push((format!("cam {name}, a whole turn, placing included"), turn(cam(&profile, 1))));
    }
    out
}
