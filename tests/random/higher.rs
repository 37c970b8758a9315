//! A group of class IV: named, not drawn, answered from the loop equations, which differences of positions confirm.

use hodograph::answer::Value;
use hodograph::certified::certify;
use hodograph::certified::ladder::Part;
use hodograph::digits::significant;
use hodograph::effort::truth;
use hodograph::geom::Point;
use hodograph::number::{Real, within};
use hodograph::position::newton::{driver_values, moved};
use hodograph::scene::{self, DiagramKind, PointId, Scene};
use hodograph::worked::{Scope, Worked, work};

const LINKS: &str = r#""links": {"1": ["O","A"], "2": ["A","B","C"], "3": ["B","D"], "4": ["C","E"], "5": ["D","E","G"], "6": ["O","G"]}, "ground": "6",
  "find": ["v_D", "a_D", "omega_5", "v_A"]"#;

fn by_coordinates() -> String {
    format!(
        r#"{{{LINKS}, "units": {{"length": "m"}}, "driver": {{"link": "1", "omega": "2 rad/s"}},
        "points": {{"O": [0,0], "A": [1,2], "B": [3,4], "C": [4,1.5], "D": [6,5], "E": [7,2], "G": [9,1]}}}}"#
    )
}

fn by_lengths() -> String {
    format!(
        r#"{{{LINKS}, "units": {{"length": "m"}}, "driver": {{"link": "1", "angle": "atan(2)", "omega": "2 rad/s"}},
        "points": {{"O": [0,0], "G": [9,1]}},
        "lengths": {{"OA": "sqrt(5)", "AB": "sqrt(8)", "BC": "sqrt(7.25)", "AC": "sqrt(9.25)", "BD": "sqrt(10)", "CE": "sqrt(9.25)",
          "DE": "sqrt(10)", "EG": "sqrt(5)", "DG": 5}},
        "sketch": {{"A": [1,2], "B": [3.1,4], "C": [4,1.4], "D": [6,5.2], "E": [7,2]}}}}"#
    )
}

/// With a slider inside: link 5 keeps its direction on a ground guide and carries the slot of E, which runs in another ground
/// guide. The sketch is rough; nothing of it must be left in the answer.
fn with_slider() -> String {
    r#"{"links": {"1": ["O","A"], "2": ["A","B","C"], "3": ["B","D"], "4": ["C","E"], "5": ["D"], "6": ["O"]}, "ground": "6",
      "find": ["v_D", "a_D", "omega_2", "alpha_2", "v_E", "x_D"], "units": {"length": "m"},
      "driver": {"link": "1", "angle": "atan(2)", "omega": "2 rad/s"}, "points": {"O": [0,0]},
      "guides": [{"slider": "5", "on": "6", "through": [0, 5], "angle": "0 deg"},
        {"pin": "E", "on": "5", "through": "D", "angle": "90 deg", "offset": "-1 m"},
        {"pin": "E", "on": "6", "through": [0, 2], "angle": "0 deg"}],
      "lengths": {"OA": "sqrt(5)", "AB": "sqrt(8)", "BC": "sqrt(7.25)", "AC": "sqrt(9.25)", "BD": "sqrt(10)", "CE": "sqrt(9.25)"},
      "sketch": {"A": [1,2], "B": [3.1,4], "C": [4,1.4], "D": [6.1,5.2], "E": [7,2]}}"#
        .into()
}

#[test]
fn a_slider_inside_a_higher_group_is_proved() {
    let (scene, done) = worked(&with_slider());
    let places = [("D", 6.0, 5.0), ("E", 7.0, 2.0), ("B", 3.0, 4.0)];
    for (name, x, y) in places {
        let at = done.configuration.point(PointId(scene.points.iter().position(|p| p.name == name).unwrap()));
        assert!((at - Point::new(x, y)).norm() < 1e-13, "{name} is at {at:?}");
    }
    let certified = certify(&scene, &done, 12);
    within(truth::BITS, || {
        for ((c, r), t) in certified.iter().zip(&done.results).zip(truth::answers(&scene, &done).unwrap()) {
            let find = &scene.find[r.find];
            assert_eq!(c.why, None, "{}", find.text);
            let t = match t.unwrap() {
                Value::Scalar(s) => s.approx(),
                Value::Vector(v) => v.norm().approx(),
                Value::Point(_) => panic!("{} is no place", find.text),
            };
            let part = c.part(Part::Scalar).or(c.part(Part::Magnitude)).unwrap();
            assert_eq!(part.text(12).unwrap().0, significant(t, 12), "{}", find.text);
        }
    });
}

/// Two points by lengths give a slider a direction of its own, and nothing says how it stands against its guide: the rough
/// sketch must not.
#[test]
fn the_direction_of_a_slider_is_not_taken_from_the_sketch() {
    let text = with_slider().replace(r#""5": ["D"]"#, r#""5": ["D", "K"]"#).replace(r#""OA":"#, r#""DK": 1, "OA":"#);
    let text = text
        .replace(r#""E": [7,2]}"#, r#""E": [7,2], "K": [7,5.1]}"#)
        .replace(r#""through": "D", "angle": "90 deg""#, r#""line": "DK", "angle": "90 deg""#);
    let scene = scene::read(&text).unwrap_or_else(|f| panic!("{f}")).value;
    let faults = work(&scene, Scope::Figure).map(|_| ()).unwrap_err();
    assert!(faults.list.iter().any(|d| d.code == "angle-not-given"), "{faults}");
}

fn worked(text: &str) -> (Scene, Worked) {
    let scene = scene::read(text).unwrap_or_else(|f| panic!("{f}")).value;
    let done = work(&scene, Scope::Figure).unwrap_or_else(|f| panic!("{f}"));
    assert!(done.notes.iter().any(|d| d.code == "higher-group" && d.message.en.contains("2, 3, 4, 5")), "{:?}", done.notes);
    (scene, done.value)
}

#[test]
fn a_higher_group_is_answered_though_not_drawn() {
    let (scene, done) = worked(&by_coordinates());
    let (_, again) = worked(&by_lengths());
    assert!(!done.plan.undrawable.is_empty());
    let d = PointId(scene.points.iter().position(|p| p.name == "D").unwrap());
    let place = |h: f64| {
        let mut drivers = driver_values(&scene, &done.configuration);
        drivers.0[0] += h * 2.0;
        moved(&scene, &done.mechanism, &done.configuration, &drivers).unwrap().point(d)
    };
    let h = 1e-4;
    let velocity = (place(h) - place(-h)) * (0.5 / h);
    let acceleration = ((place(h) - place(0.0)) - (place(0.0) - place(-h))) * (1.0 / (h * h));
    for (o, p) in done.results.iter().zip(&again.results) {
        let drawn = scene.find[o.find].text == "v_A";
        assert_eq!(o.drawn.is_some(), drawn, "{}", scene.find[o.find].text);
        let off = match (o.computed, p.computed) {
            (Value::Vector(a), Value::Vector(b)) => (a - b).norm() / a.norm(),
            (Value::Scalar(a), Value::Scalar(b)) => (a - b).abs() / a.abs(),
            _ => panic!("the same question has the same kind of answer"),
        };
        assert!(off < 1e-11, "{}: the two poses differ by {off:e}", scene.find[o.find].text);
    }
    let Value::Vector(v) = done.results[0].computed else { panic!("v_D is a vector") };
    let Value::Vector(a) = done.results[1].computed else { panic!("a_D is a vector") };
    assert!((v - velocity).norm() < 1e-6 * v.norm(), "{v:?} {velocity:?}");
    assert!((a - acceleration).norm() < 1e-4 * a.norm(), "{a:?} {acceleration:?}");
}

/// The double butterfly has no link on three legs: two of its links are held by two lines each, and in between lies a dyad. Whatever the
/// places of its joints, what is drawn by the special points is what the loop equations say, or the note says that it is not drawn.
#[test]
fn a_double_butterfly_is_drawn_by_special_points() {
    let (mut drawn, mut left) = (0, 0);
    for seed in 0..60 {
        let mut rng = crate::rng::Rng::new(seed);
        let places =
            [(0.0, 0.0), (1.0, 6.0), (-5.0, 1.0), (-4.0, 5.0), (6.0, 0.0), (7.0, 4.0), (-2.0, 3.0), (-1.0, 5.0), (3.0, 2.0), (4.0, 7.0)];
        let points: Vec<String> = places
            .iter()
            .zip("ABCDEFGHKL".chars())
            .map(|((x, y), name)| format!("\"{name}\": [{}, {}]", x + rng.between(-1.0, 1.0), y + rng.between(-1.0, 1.0)))
            .collect();
        let text = format!(
            r#"{{"units": {{"length": "mm"}}, "links": {{"1": ["A","C","E"], "2": ["A","G","K"], "3": ["B","D","H"], "4": ["B","F","L"], "5": ["C","D"], "6": ["E","F"],
               "7": ["G","H"], "8": ["K","L"]}}, "ground": "1", "points": {{{}}}, "driver": {{"link": "2", "omega": "1 rad/s", "alpha": "2 rad/s^2"}},
               "find": ["v_B", "a_B", "omega_3", "alpha_3", "omega_8", "alpha_8", "v_L", "a_H"]}}"#,
            points.join(", ")
        );
        let scene = scene::read(&text).unwrap_or_else(|f| panic!("{f}")).value;
        let done = work(&scene, Scope::Figure).unwrap_or_else(|f| panic!("seed {seed}: {f}"));
        let w = done.value;
        let not_drawn = done.notes.iter().any(|d| d.code == "higher-group" && d.message.en.contains("not drawn"));
        assert_eq!(w.plan.undrawable.is_empty(), !not_drawn, "seed {seed}");
        for r in &w.results {
            let Some(d) = &r.drawn else {
                assert!(not_drawn, "seed {seed}: {}", scene.find[r.find].text);
                continue;
            };
            let off = match (d.value, r.computed) {
                (Value::Vector(a), Value::Vector(b)) => (a - b).norm() / b.norm(),
                (Value::Scalar(a), Value::Scalar(b)) => (a - b).abs() / b.abs(),
                _ => f64::INFINITY,
            };
            assert!(
                off < 1e-12 * w.construction.magnified(DiagramKind::Acceleration).max(1e3),
                "seed {seed}: {} is off by {off:e}",
                scene.find[r.find].text
            );
        }
        if not_drawn { left += 1 } else { drawn += 1 }
    }
    assert!(drawn > 55, "{drawn} drawn, {left} left");
}
