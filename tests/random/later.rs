//! At later times: the closed forms of a mechanism that has moved, including rolling, compared with
//! Newton's method; drawings with redundant pairs; the default assembly.

use hodograph::analytic::{Solution, solve, third};
use hodograph::answer::MotionSource;
use hodograph::construct::conditions;
use hodograph::geom::Point;
use hodograph::mechanism::Level;
use hodograph::position::{later, newton};
use hodograph::scene::{self, DiagramKind, LinkId, templates};
use hodograph::worked::{Scope, work};

/// Wheels and racks with poses given by lengths and an angle at every time.
const ROLLING: [(&str, &str); 5] = [
    (
        "wheel on a coupler",
        r#"{"units": {"length": "mm", "angle": "deg"}, "links": {"1": ["A","D","F"], "2": ["A","B"], "3": ["B","C"], "4": ["C","D"], "5": ["E"],
        "6": ["E","F"]}, "ground": "1", "points": {"A": [0,0], "D": [140,0], "F": [20,190]},
        "lengths": {"AB": 60, "BC": 140, "CD": 95, "EF": 118}, "sketch": {"C": [160,90], "E": [74,120]},
        "rolling": [{"wheel": "5", "centre": "E", "radius": 25, "on": "3", "line": "BC", "through": "B"}],
        "driver": {"link": "2", "angle": "70 deg", "omega": "4 rad/s", "alpha": "5 rad/s^2"}, "find": ["omega_5", "v_E"]}"#,
    ),
    (
        "rack on a crank over a pinion",
        r#"{"units": {"length": "mm", "angle": "deg"}, "links": {"1": ["A","D"], "2": ["A","B"], "3": ["B","P"], "4": ["D"]}, "ground": "1",
        "points": {"A": [0,0], "D": [100,20]}, "lengths": {"AB": 30, "BP": 150}, "sketch": {"P": [150,10]},
        "gears": [{"links": ["4","3"], "centres": ["D"], "radii": [25], "rack": "3", "line": "BP", "through": "B"}],
        "driver": {"link": "2", "angle": "60 deg", "omega": "4 rad/s"}, "find": ["omega_3", "omega_4"]}"#,
    ),
    (
        "rack under a wheel on the ground",
        r#"{"units": {"length": "mm", "angle": "deg"}, "links": {"1": ["A"], "2": ["A","B"], "3": ["B","C"], "4": ["C"]}, "ground": "1",
        "points": {"A": [0,0]}, "lengths": {"AB": 100, "BC": 170}, "guides": [{"slider": "5", "on": "1", "angle": "0 deg"}],
        "sketch": {"C": [210,0]},
        "rolling": [{"wheel": "4", "centre": "C", "radius": 40, "on": "1", "through": [0, -40], "angle": "0 deg"}],
        "gears": [{"links": ["4","5"], "centres": ["C"], "radii": [40], "rack": "5", "angle": "180 deg"}],
        "driver": {"link": "2", "angle": "53 deg", "omega": "10 rad/s"}, "find": ["omega_4", "v_C"]}"#,
    ),
    (
        "rack in a guide on a driven gear",
        r#"{"units": {"length": "mm", "angle": "deg"}, "links": {"1": ["A"], "2": ["A","B"]}, "ground": "1", "points": {"A": [0,0]},
        "lengths": {"AB": 40}, "guides": [{"slider": "3", "on": "1", "angle": "30 deg"}],
        "gears": [{"links": ["2","3"], "centres": ["A"], "radii": [50], "rack": "3", "angle": "30 deg"}],
        "driver": {"link": "2", "angle": "20 deg", "omega": "3 rad/s"}, "find": ["v_A3", "v_B"]}"#,
    ),
    (
        "wheel on a track that a crank turns",
        r#"{"units": {"length": "mm", "angle": "deg"}, "links": {"1": ["A","F"], "2": ["A","B"], "5": ["E"], "6": ["E","F"]}, "ground": "1",
        "points": {"A": [0,0], "F": [60,150]}, "lengths": {"AB": 160, "EF": 135}, "sketch": {"E": [80,45]},
        "rolling": [{"wheel": "5", "centre": "E", "radius": 20, "on": "2", "line": "AB", "through": "A"}],
        "driver": {"link": "2", "angle": "10 deg", "omega": "-2 rad/s"}, "find": ["omega_5", "v_E"]}"#,
    ),
];

/// All templates, and these.
fn sources() -> impl Iterator<Item = (&'static str, &'static str)> {
    templates::list().into_iter().map(|t| (t.name, templates::get(t.name).unwrap())).chain(ROLLING)
}

/// Both start from the pose of the scene and follow the drivers: one by circles and lines group
/// after group, with the rotation of wheels counted from the instant, the other by all equations at
/// once.
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
        // Wheels are followed farther, in steps over which Newton's method keeps the assembly.
        let far: &[f64] = if scene.rolling.is_empty() { &[] } else { &[1.3, -2.6] };
        for turned in [0.05, -0.11, 0.2].into_iter().chain(far.iter().copied()) {
            let time = turned / rate;
            let after = |time: f64| {
                let mut drivers = sliding.clone();
                for (value, d) in drivers.0.iter_mut().zip(&scene.drivers) {
                    *value += d.rate.value * time
                        + 0.5 * d.acceleration.as_ref().map_or(0.0, |a| a.value) * time * time;
                }
                drivers
            };
            let steps = (turned.abs() / 0.2).ceil() as usize;
            let step = |at: hodograph::position::Configuration, k: usize| {
                newton::moved(&scene, &w.mechanism, &at, &after(time * k as f64 / steps as f64))
            };
            let Some(meant) = (1..=steps).try_fold(w.configuration.clone(), step) else { continue };
            let Ok(at) =
                later::<f64>(&scene, &w.mechanism, &w.demand, &meant, &w.configuration, time)
            else {
                continue;
            };
            let size = w.configuration.extent();
            for (i, p) in scene.points.iter().enumerate() {
                let (Some(a), Some(b)) = (at.points[i], meant.points[i]) else { continue };
                assert!(
                    a.distance(b) < 1e-8 * size,
                    "{} turned {turned}: {} is at {a:?}, by Newton's method at {b:?}",
                    name,
                    p.name
                );
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
    assert!(seen > 120 && rolled >= 30, "{seen} poses, {rolled} of them with rolling pairs");
}

/// Redundant conditions are satisfied by a correct drawing too, at both levels, for any velocities
/// and scales.
#[test]
fn a_sound_drawing_keeps_the_conditions_of_opened_links() {
    let base = r#"{"units": {"length": "m"}, "ground": "1",
      "links": {"1": ["A", "D", "F"], "2": ["A", "B"], "3": ["B", "C", "E", "X"], "4": ["C", "D"], "5": ["E", "F"]},
      "points": {"A": [0, 0], "B": [3, 4], "C": [13, 4], "D": [10, 0], "E": [8, 4], "F": [5, 0], "X": [9, 7]},
      "driver": {"link": "2", "omega": "OMEGA rad/s", "alpha": "ALPHA rad/s^2"}, "find": ["v_X", "a_X", "omega_5", "alpha_5"]}"#;
    let mut levels = [0, 0];
    for (omega, alpha) in [("5", "3"), ("0.02", "0"), ("-40", "900"), ("1", "-7")] {
        let scene =
            scene::read(base.replace("OMEGA", omega).replace("ALPHA", alpha)).unwrap().value;
        let w = work(&scene, Scope::Figure).unwrap().value;
        for c in conditions(&scene, &w.mechanism, &w.configuration, &w.plan, &w.construction) {
            assert!(c.off_mm < 1e-9, "{omega} rad/s, {alpha} rad/s²: {c:?}");
            levels[usize::from(c.on == DiagramKind::Acceleration)] += 1;
        }
    }
    assert!(levels.iter().all(|n| *n > 0), "{levels:?}");
}

/// If one of two assemblies places a joint on another, the other assembly is taken, whichever of
/// the two the closed form finds first and at any size of the mechanism.
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
            let b = w.configuration.points
                [scene.points.iter().position(|p| p.name == "B").unwrap()]
            .unwrap();
            let (s, c) = angle.to_radians().sin_cos();
            assert!(
                b.distance(Point::new(size * (1.0 + c), size * s)) < 1e-9 * size,
                "{size} m, {angle}°: B is at {b:?}"
            );
        }
    }
}

/// If the scene does not choose an assembly, a note names the one taken and another one, by a point
/// and its two places.
#[test]
fn an_assembly_by_default_is_reported_beside_another_one() {
    let four_bar = r#"{"links": {"1": ["A", "B"], "2": ["B", "C"], "3": ["D", "C"], "0": ["A", "D"]}, "ground": "0", "units": {"length": "m"},
        "lengths": {"AB": 1, "BC": 2.5, "CD": 2, "AD": 3}, "driver": {"link": "1", "angle": "60 deg", "omega": "1 rad/s"}, "find": ["x_C", "y_C"]}"#;
    let slider = r#"{"links": {"1": ["A", "B"], "2": ["B", "C"], "0": ["A"]}, "ground": "0", "units": {"length": "m"}, "points": {"A": [0, 0]},
        "lengths": {"AB": 1, "BC": 2.5}, "guides": [{"pin": "C", "slider": "3", "through": "A", "angle": "0 deg"}],
        "driver": {"link": "1", "angle": "60 deg", "omega": "1 rad/s"}, "find": ["x_C", "y_C"]}"#;
    let triad = r#"{"links": {"1": ["O", "A"], "2": ["A", "P"], "3": ["P", "Q", "R"], "4": ["G", "Q"], "5": ["H", "R"], "0": ["O", "G", "H"]}, "ground": "0",
        "units": {"length": "m"}, "points": {"O": [0, 0], "G": [4, 0.3], "H": [8, 1]}, "lengths": {"OA": 1, "AP": 3, "PQ": 2, "QR": 2.2, "PR": 4, "GQ": 3, "HR": 4},
        "driver": {"link": "1", "angle": "60 deg", "omega": "1 rad/s"}, "find": ["x_Q", "y_Q"]}"#;
    for (name, text, ways) in
        [("four-bar", four_bar, 2), ("slider-crank", slider, 2), ("triad", triad, 3)]
    {
        let scene = scene::read(text).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
        let done = work(&scene, Scope::Questions).unwrap_or_else(|f| panic!("{f}\n{text}"));
        let notes: Vec<&str> = done
            .notes
            .iter()
            .filter(|d| d.code == "assembly-by-default")
            .map(|d| d.message.en.as_str())
            .collect();
        let [said] = notes[..] else { panic!("{name}: {:?}", done.notes) };
        let count: usize =
            said.split(" ways").next().unwrap().rsplit(' ').next().unwrap().parse().unwrap();
        assert!(count >= ways, "{name}: {said}");
        // "the one with C at (x, y) was taken, not the one with C at (x, y)".
        let places: Vec<&str> =
            said.split(" at ").skip(1).map(|s| s.split(')').next().unwrap()).collect();
        assert!(places.len() == 2 && places[0] != places[1], "{name}: {said}");
    }
}

/// The third derivatives of all links are the time derivatives of their accelerations, at constant
/// driver speed.
#[test]
fn third_derivatives_are_the_slopes_of_the_accelerations() {
    let mut seen = 0;
    for (name, text) in sources() {
        let mut scene = scene::read(text).unwrap().value;
        scene.drivers.iter_mut().for_each(|d| d.acceleration = None);
        let Ok(w) = work(&scene, Scope::Figure) else { continue };
        let w = w.value;
        let rate = scene.drivers.iter().map(|d| d.rate.value.abs()).fold(0.0, f64::max);
        // Their followers have the third derivative of their law, see `tests/cams.rs`; Newton's
        // method continues along an arc.
        let by_law = |c: &hodograph::scene::Cam| {
            c.disc
                .as_ref()
                .is_some_and(|t| matches!(t.disc.motion, hodograph::cam::CamMotion::Law { .. }))
        };
        if scene.cams.iter().any(by_law)
            || rate == 0.0
            || w.demand.level < Level::Acceleration
            || !w.solution.singular.is_empty()
        {
            continue;
        }
        let start = newton::driver_values(&scene, &w.configuration);
        let step = 1e-4 / rate;
        let beside = |time: f64| {
            let mut drivers = start.clone();
            drivers
                .0
                .iter_mut()
                .zip(&scene.drivers)
                .for_each(|(value, d)| *value += d.rate.value * time);
            let at = newton::moved_to(&scene, &w.mechanism, &w.configuration, &drivers, 1e-15)
                .or_else(|| newton::moved(&scene, &w.mechanism, &w.configuration, &drivers))?;
            solve(&scene, &w.mechanism, &at, &w.demand).ok()
        };
        let (Some(after), Some(before)) = (beside(step), beside(-step)) else { continue };
        for (l, link) in scene.links.iter().enumerate() {
            for p in &link.points {
                let Some(place) = w.configuration.points[p.0] else { continue };
                let Some((jerk, turning)) =
                    third(&scene, &w.mechanism, &w.configuration, &w.demand, &w.solution, place)[l]
                else {
                    continue;
                };
                let rate_of = |s: &Solution| s.turning(Level::Acceleration, LinkId(l));
                let of = |s: &Solution| s.vector(Level::Acceleration, *p, None);
                if let (Some(a), Some(b)) = (rate_of(&after), rate_of(&before)) {
                    let (slope, unit) = ((a - b) / (2.0 * step), rate.powi(3));
                    assert!(
                        (slope - turning).abs() < 1e-4 * (turning.abs() + unit * 1e-2),
                        "{name}, link {}: {turning}, slope {slope}",
                        link.name
                    );
                }
                if let (Some(a), Some(b)) = (of(&after), of(&before)) {
                    let (slope, size) =
                        ((a - b) * (0.5 / step), rate.powi(3) * w.configuration.extent());
                    assert!(
                        (slope - jerk).norm() < 1e-4 * (jerk.norm() + size * 1e-2),
                        "{name}, {} of link {}: {jerk:?}, slope {slope:?}",
                        scene.point_name(*p),
                        link.name
                    );
                    seen += 1;
                }
            }
        }
    }
    assert!(seen > 100, "{seen}");
}
