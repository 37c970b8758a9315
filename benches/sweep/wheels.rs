//! What cams cost: one circle, which is compiled like a linkage, beside arcs and lines and laws, whose follower is put to its place at every position.

use super::{Variant, chunk_of, scene};
use hodograph::mechanism::Mechanism;
use hodograph::scene::{Angle, Scene};
use hodograph::sweep::{self, Placed, Stations, Width};
use std::hint::black_box;

/// Positions of a sweep that is not compiled.
const TURN: usize = 360;

/// A cam with a roller on a translating follower, its velocity and acceleration asked.
fn cam(profile: &str) -> Scene {
    let text = format!(
        r#"{{"links": {{"1": ["O"], "2": ["O", "Q"], "3": ["B"]}}, "ground": "1", "points": {{"O": [0, 0]}}, "lengths": {{"OQ": "20 mm"}},
        "guides": [{{"pin": "B", "slider": "3", "on": "1", "through": "O", "angle": "90 deg"}}], "sketch": {{"B": [0, "50 mm"]}},
        "cams": [{{"cam": "2", "follower": "3", "roller": {{"pin": "B", "radius": "8 mm"}}, "profile": {profile}}}],
        "driver": {{"link": "2", "angle": "40 deg", "omega": "10 rad/s"}}, "find": ["v_B", "a_B"]}}"#
    );
    scene(&text).over_a_turn()
}

/// A whole turn, as `sweep` computes it.
fn turn(scene: Scene) -> (Box<dyn FnMut()>, usize) {
    let stations = Stations::turned(Angle::Deg(0.0), Angle::Deg(359.0), TURN - 1);
    let run = move || {
        let m = Mechanism::new(&scene).unwrap().value;
        let placed = Placed::new(&scene, &m).unwrap();
        black_box(sweep::run(&placed, 0, &stations, Width::Widest).unwrap());
    };
    (Box::new(run), TURN)
}

pub fn variants() -> Vec<Variant> {
    let tangent = r#"[{"centre": "O", "radius": "25 mm"}, "tangent", {"centre": "Q", "radius": "10 mm"}, "tangent"]"#;
    let law = r#"{"base": "25 mm", "law": [{"rise": "20 mm", "over": "120 deg", "law": "cycloidal"}, {"dwell": "60 deg"},
        {"return": "20 mm", "over": "120 deg", "law": "3-4-5"}, {"dwell": "60 deg"}]}"#;
    vec![
        ("cam of one circle, all three".into(), chunk_of(&cam(r#"{"centre": "Q", "radius": "30 mm"}"#), Width::Widest)),
        ("cam of arcs and lines, a whole turn".into(), turn(cam(tangent))),
        ("cam by a law, a whole turn".into(), turn(cam(law))),
    ]
}
