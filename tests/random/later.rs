//! A while later: the closed forms of a mechanism that has moved, rolling and all, against Newton's method; what a drawing keeps of
//! pairs that repeat others; which assembly is meant where nothing is said.

use hodograph::construct::conditions;
use hodograph::geom::Point;
use hodograph::mechanism::Level;
use hodograph::position::{later, newton};
use hodograph::scene::{self, templates};
use hodograph::worked::{Scope, work};

/// All templates, and the reference cases in which anything rolls: racks that turn, wheels on tracks that turn.
fn sources() -> Vec<(String, String)> {
    let mut all: Vec<(String, String)> =
        templates::list().iter().map(|t| (t.name.to_owned(), templates::get(t.name).unwrap().to_owned())).collect();
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cases");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|f| f.unwrap().path()).collect();
    files.sort();
    for file in files {
        let case: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(&file).unwrap()).unwrap();
        if ["gears", "rolling"].iter().any(|key| case["scene"][key].is_array()) && case["scene"]["driver"] != serde_json::Value::Null {
            all.push((file.file_stem().unwrap().to_string_lossy().into_owned(), case["scene"].to_string()));
        }
    }
    all
}

/// Both start from the pose of the scene and go the way of the drivers; one by circles and lines group after group, with the turning of
/// wheels counted from the instant, the other by all equations at once.
#[test]
fn closed_forms_go_where_newton_goes() {
    let (mut seen, mut rolled) = (0, 0);
    for (name, text) in sources() {
        let scene = scene::read(text).unwrap().value;
        let Ok(w) = work(&scene, Scope::Figure) else { continue };
        let w = w.value;
        let rate = scene.drivers.iter().map(|d| d.rate.value.abs()).fold(0.0, f64::max);
        let sliding = newton::driver_values(&scene, &w.configuration);
        if rate == 0.0 {
            continue;
        }
        for turned in [0.05, -0.11, 0.2, 1.3, -2.6] {
            let time = turned / rate;
            let mut drivers = sliding.clone();
            for (value, d) in drivers.0.iter_mut().zip(&scene.drivers) {
                *value += d.rate.value * time + 0.5 * d.acceleration.as_ref().map_or(0.0, |a| a.value) * time * time;
            }
            let Some(meant) = newton::moved(&scene, &w.mechanism, &w.configuration, &drivers) else { continue };
            let Ok(at) = later::<f64>(&scene, &w.mechanism, &w.demand, &meant, &w.configuration, time) else { continue };
            let size = w.configuration.extent();
            for (i, p) in scene.points.iter().enumerate() {
                let (Some(a), Some(b)) = (at.points[i], meant.points[i]) else { continue };
                assert!(a.distance(b) < 1e-8 * size, "{} turned {turned}: {} is at {a:?}, by Newton's method at {b:?}", name, p.name);
            }
            for (l, link) in scene.links.iter().enumerate() {
                let (Some(a), Some(b)) = (at.poses[l], meant.poses[l]) else { continue };
                let axis = (a.axis - b.axis).norm();
                assert!(
                    axis < 1e-8,
                    "{} turned {turned}: link {} lies along {:?}, by Newton's method {:?}",
                    name,
                    link.name,
                    a.axis,
                    b.axis
                );
            }
            seen += 1;
            rolled += usize::from(!scene.rolling.is_empty());
        }
    }
    assert!(seen > 120 && rolled >= 80, "{seen} poses, {rolled} of them with rolling pairs");
}

/// What holds by itself is kept by a sound drawing too, at both levels, whatever the rates and so the scales are.
#[test]
fn a_sound_drawing_keeps_the_conditions_of_opened_links() {
    let base = r#"{"units": {"length": "m"}, "ground": "1",
      "links": {"1": ["A", "D", "F"], "2": ["A", "B"], "3": ["B", "C", "E", "X"], "4": ["C", "D"], "5": ["E", "F"]},
      "points": {"A": [0, 0], "B": [3, 4], "C": [13, 4], "D": [10, 0], "E": [8, 4], "F": [5, 0], "X": [9, 7]},
      "driver": {"link": "2", "omega": "OMEGA rad/s", "alpha": "ALPHA rad/s^2"}, "find": ["v_X", "a_X", "omega_5", "alpha_5"]}"#;
    let mut levels = [0, 0];
    for (omega, alpha) in [("5", "3"), ("0.02", "0"), ("-40", "900"), ("1", "-7")] {
        let scene = scene::read(base.replace("OMEGA", omega).replace("ALPHA", alpha)).unwrap().value;
        let w = work(&scene, Scope::Figure).unwrap().value;
        for c in conditions(&scene, &w.mechanism, &w.configuration, &w.plan, &w.construction) {
            assert!(c.off_mm < 1e-9, "{omega} rad/s, {alpha} rad/s²: {c:?}");
            levels[usize::from(c.level == Level::Acceleration)] += 1;
        }
    }
    assert!(levels.iter().all(|n| *n > 0), "{levels:?}");
}

/// Of two assemblies of which one lays a joint on another one the other is taken, whichever of them the closed form finds first and
/// however large the mechanism is.
#[test]
fn an_assembly_that_falls_together_is_not_meant() {
    for size in [1e-3, 1.0, 250.0] {
        for (degrees, mirrored) in [(60.0f64, 1.0), (100.0, 1.0), (60.0, -1.0), (130.0, -1.0)] {
            let angle = mirrored * degrees;
            // A rhombus OABC: the other place of B is O.
            let text = format!(
                r#"{{"units": {{"length": "m"}}, "ground": "1", "links": {{"1": ["O", "C"], "2": ["O", "A"], "3": ["A", "B"], "4": ["B", "C"]}},
                "points": {{"O": [0, 0], "C": [{size}, 0]}}, "lengths": {{"OA": {size}, "AB": {size}, "BC": {size}}},
                "driver": {{"link": "2", "angle": "{angle} deg", "omega": "1 rad/s"}}, "find": ["x_B", "y_B"]}}"#
            );
            let scene = scene::read(&text).unwrap().value;
            let w = work(&scene, Scope::Questions).unwrap().value;
            let b = w.configuration.points[scene.points.iter().position(|p| p.name == "B").unwrap()].unwrap();
            let (s, c) = angle.to_radians().sin_cos();
            assert!(b.distance(Point::new(size * (1.0 + c), size * s)) < 1e-9 * size, "{size} m, {angle}°: B is at {b:?}");
        }
    }
}
