//! Cams through their whole turn: in each pose, drawing and loop equations of the equivalent
//! linkage agree with the geometry of the cam, on every piece and on both sides of every joint; so
//! do sweeps.

use hodograph::analytic::third;
use hodograph::answer::AnswerValue;
use hodograph::cam::{CamJet, MotionLaw, PieceSide, PreparedDisc};
use hodograph::mechanism::Mechanism;
use hodograph::scene::{self, Angle, Scene};
use hodograph::sweep::{self, PlacedScene, Stations, Width};
use hodograph::worked::{Scope, work};

mod cams {
    pub mod asked;
    pub mod compiled;
    pub mod geared;
    pub mod posed;
    pub mod replaced;
    pub mod touch;
}

const OMEGA: f64 = 3.0;
const ALPHA: f64 = -2.0;

/// A scene with a cam 2 about O and a follower 3, the cam at an angle in degrees.
fn scene(kind: &str, angle: &str) -> Scene {
    let text = text(kind, angle);
    scene::read(&text).unwrap_or_else(|f| panic!("{kind} at {angle}: {f}\n{text}")).value
}

fn text(kind: &str, angle: &str) -> String {
    let translating = r#""guides": [{"pin": "B", "slider": "3", "on": "1", "through": ["6 mm", "3 mm"], "angle": "80 deg"}],"#;
    let tangent = r#""profile": [{"centre": "O", "radius": "30 mm"}, "tangent", {"centre": "Q", "radius": "14 mm"}, "tangent"]"#;
    let hollow = r#""profile": [{"centre": "O", "radius": "30 mm"}, {"radius": "-90 mm"}, {"centre": "Q", "radius": "14 mm"}, {"radius": "80 mm"}]"#;
    let convex = r#""profile": [{"centre": "O", "radius": "30 mm"}, {"radius": "70 mm"}, {"centre": "Q", "radius": "4 mm"}, {"radius": "75 mm"}]"#;
    let roller = r#""roller": {"pin": "B", "radius": "9 mm"}"#;
    let law = |law: MotionLaw, gain: &str| {
        let name = law.name();
        format!(
            r#""profile": {{"base": "40 mm", "start": "15 deg", "law": [{{"dwell": "40 deg"}}, {{"rise": "{gain}", "over": "130 deg", "law": "{name}"}},
            {{"dwell": "70 deg"}}, {{"return": "{gain}", "over": "120 deg", "law": "{name}"}}]}}"#
        )
    };
    let (follower, cam) = match kind {
        "tangent" => (translating, format!("{roller}, {tangent}")),
        "hollow" => (translating, format!("{roller}, {hollow}")),
        "edge" => (translating, format!(r#""edge": "B", {convex}"#)),
        "flat" => (translating, format!(r#""face": {{"through": "B"}}, {convex}"#)),
        "rocker" => ("", format!("{roller}, {tangent}")),
        "mushroom" => ("", format!(r#""arc": {{"pin": "B", "radius": "25 mm"}}, {convex}"#)),
        "swinging flat" => {
            ("", format!(r#""face": {{"through": "P", "line": "PB", "cam": "left"}}, {convex}"#))
        }
        "swinging offset flat" => (
            "",
            format!(
                r#""face": {{"through": "P", "line": "PB", "cam": "left", "offset": "5 mm"}}, {convex}"#
            ),
        ),
        other => {
            let (of, name) = other.rsplit_once(' ').unwrap();
            let named = MotionLaw::named(name).unwrap();
            match of {
                "law" => (translating, format!("{roller}, {}", law(named, "18 mm"))),
                "steep law" => (translating, format!("{roller}, {}", law(named, "60 mm"))),
                "swing" => ("", format!("{roller}, {}", law(named, "17 deg"))),
                _ => ("", format!("{roller}, {}", law(named, "40 deg"))),
            }
        }
    };
    let swings = follower.is_empty();
    let (links, lengths, side, find) = if swings {
        (
            r#""3": ["P", "B"]"#,
            r#", "PB": "75 mm""#,
            if kind.ends_with("flat") {
                r#""sketch": {"B": ["40 mm", "60 mm"]},"#
            } else {
                r#""side": {"B": "right of PO"},"#
            },
            r#"["omega_3", "alpha_3"]"#,
        )
    } else {
        (r#""3": ["B"]"#, "", "", r#"["v_B", "a_B"]"#)
    };
    let ground = if swings { r#"["O", "P"]"# } else { r#"["O"]"# };
    let pivot = if swings { r#", "P": ["95 mm", "10 mm"]"# } else { "" };
    format!(
        r#"{{"links": {{"1": {ground}, "2": ["O", "Q"], {links}}}, "ground": "1", "points": {{"O": [0, 0]{pivot}}}, "lengths": {{"OQ": "35 mm"{lengths}}},
        {follower} {side} "cams": [{{"cam": "2", "follower": "3", {cam}}}],
        "driver": {{"link": "2", "angle": "{angle}", "omega": "{OMEGA} rad/s", "alpha": "{ALPHA} rad/s^2"}}, "find": {find}}}"#
    )
}

/// Velocity and acceleration of the follower by the geometry of the cam, positive outward.
fn expected(scene: &Scene) -> [f64; 2] {
    let t = scene.cams[0].disc.as_ref().unwrap();
    let CamJet([_, d, dd, _]) = t.disc.coordinate(t.phi, t.side).unwrap();
    let (w, a) = (OMEGA * t.disc.sense, ALPHA * t.disc.sense);
    [d * w, dd * w * w + d * a].map(|v| v * t.outward)
}

fn component(v: AnswerValue) -> f64 {
    match v {
        AnswerValue::Scalar(s) => s,
        AnswerValue::Vector(v) => v.dot(hodograph::geom::Vec2::from_angle(80.0_f64.to_radians())),
        AnswerValue::Point(_) => f64::NAN,
    }
}

fn agree(kind: &str, angle: f64) {
    let scene = scene(kind, &format!("{angle:?} deg"));
    let worked =
        work(&scene, Scope::Questions).unwrap_or_else(|f| panic!("{kind} at {angle}: {f}")).value;
    let expected = expected(&scene);
    let size = expected.map(f64::abs);
    for (k, r) in worked.results.iter().enumerate() {
        let most = size[k].max(1e-3 * size[0].max(size[1]) * OMEGA).max(1e-3);
        for (way, value) in
            r.drawn.iter().map(|d| ("drawn", d.value)).chain([("computed", r.computed)])
        {
            let off = (component(value) - expected[k]).abs() / most;
            assert!(
                off < 1e-9,
                "{kind} at {angle}, {} {way}: {value:?}, the cam says {}: {off:e}",
                scene.find[k].text,
                expected[k]
            );
        }
        assert!(r.agreement.is_none_or(|a| a.holds()), "{kind} at {angle}");
    }
    assert_eq!(worked.results.len(), 2, "{kind} at {angle}");
}

/// A roller that rolls without slip: in the frame of the cam it turns by the angle of the normal,
/// less the rolled arc divided by its radius. Checked by differences of the contact.
#[test]
fn rollers_spin_as_they_roll() {
    let kinds = ["tangent", "hollow", "rocker", "law cycloidal", "swing 3-4-5"];
    for kind in kinds {
        for k in 0..12 {
            let angle = format!("{:?} deg", 30.0 * k as f64 + 4.3);
            let mut scene = scene(kind, &angle);
            let asking = scene::read_asking(text(kind, &angle), "spin_3")
                .unwrap_or_else(|f| panic!("{kind}: {f}"))
                .value;
            scene.find = asking.find;
            let t = scene.cams[0].disc.clone().unwrap();
            let radius = 9e-3;
            let h = 1e-6;
            let [low, high] = [-h, h].map(|d| t.disc.station(t.phi + d, t.side).unwrap());
            let normal = t.disc.station(t.phi, t.side).unwrap().normal;
            let along = -normal.perp();
            let turned = low.normal.cross(high.normal).atan2(low.normal.dot(high.normal));
            let rolled = (high.contact - low.contact).dot(along) / radius;
            // Per φ, which grows with the sense of the cam; and together with the cam.
            let expected = OMEGA + (turned - rolled) / (2.0 * h) * t.disc.sense * OMEGA;
            let worked = work(&scene, Scope::Questions)
                .unwrap_or_else(|f| panic!("{kind} at {angle}: {f}"))
                .value;
            let AnswerValue::Scalar(spin) = worked.results[0].computed else { panic!("{kind}") };
            assert!(
                (spin - expected).abs() < 1e-6 * expected.abs().max(1.0),
                "{kind} at {angle}: {spin}, by differences {expected}"
            );
        }
    }
}

/// A roller may be a link of the file, by the pair's keyword or by its points alone. It is solved
/// as without it, can be asked for like any link, and is counted with its local freedom; a link
/// that is more than a roller is refused.
#[test]
fn a_roller_may_be_a_link() {
    let plain = text("law cycloidal", "40 deg");
    let spin = |text: &str, asked: &str| {
        let scene = scene::read_asking(text, asked).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
        let worked = work(&scene, Scope::Questions).unwrap().value;
        (scene.find[0].text.clone(), worked.results[0].computed)
    };
    let (_, expected) = spin(&plain, "spin_3");
    let by_word = plain.replace(r#""roller": {"#, r#""roller": {"link": "7", "#);
    let by_points = plain.replace(r#""links": {"#, r#""links": {"7": ["B"], "#);
    for text in [&by_word, &by_points] {
        assert_ne!(text, &plain);
        assert_eq!(spin(text, "omega_7"), ("omega_7".to_owned(), expected));
        let counted =
            hodograph::mechanism::MobilitySurvey::of(&scene::read_topology(text).unwrap().value);
        assert_eq!(
            (counted.counts.moving, counted.local.len(), counted.counts.freedom(0, 1)),
            (3, 1, 1)
        );
    }
    for link in ["1", "2", "3"] {
        let faults =
            scene::read(by_word.replace(r#""link": "7""#, &format!(r#""link": "{link}""#)))
                .unwrap_err();
        assert!(faults.list.iter().any(|d| d.code == "roller-link"), "{faults}");
    }
    let faults = scene::read(
        by_points
            .replace(r#""7": ["B"]"#, r#""7": ["B", "Z"]"#)
            .replace(r#""roller": {"#, r#""roller": {"link": "7", "#),
    );
    assert!(faults.unwrap_err().list.iter().any(|d| d.code == "roller-link"));
}

const PROFILES: [&str; 8] = [
    "tangent",
    "hollow",
    "edge",
    "flat",
    "rocker",
    "mushroom",
    "swinging flat",
    "swinging offset flat",
];

#[test]
fn every_piece_of_a_profile_is_right_in_every_pose() {
    for kind in PROFILES {
        let mut touched = std::collections::BTreeSet::new();
        for k in 0..36 {
            let angle = 10.0 * k as f64 + 3.7;
            agree(kind, angle);
            touched.extend(
                scene(kind, &format!("{angle} deg")).cams[0].disc.as_ref().unwrap().touched,
            );
        }
        assert_eq!(touched.len(), 4, "{kind} touches {touched:?} only");
    }
}

#[test]
fn laws_are_right_in_every_pose() {
    for law in MotionLaw::ALL {
        for of in ["law", "swing"] {
            for k in 0..18 {
                agree(&format!("{of} {}", law.name()), 20.0 * k as f64 + 1.3);
            }
        }
    }
}

/// Next to an inflection of the pitch curve no arc replaces the profile, from some degrees on one
/// does: the answers are those of the law throughout.
#[test]
fn a_law_is_right_through_the_inflections_of_its_pitch_curve() {
    let mut found = 0;
    for kind in ["steep law cycloidal", "steep swing harmonic"] {
        let bend = |angle: f64| {
            let scene = scene(kind, &format!("{angle:?} deg"));
            let t = scene.cams[0].disc.as_ref().unwrap();
            1.0 / t.disc.station(t.phi, t.side).unwrap().rho_pitch
        };
        for start in (60..180).step_by(5).map(f64::from) {
            let [mut low, mut high] = [start, start + 5.0];
            if bend(low) * bend(high) > 0.0 || (bend(low) - bend(high)).abs() > 100.0 {
                continue;
            }
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                if bend(middle) * bend(low) > 0.0 { low = middle } else { high = middle }
            }
            let stands =
                |angle: f64| scene(kind, &format!("{angle:?} deg")).cams[0].contact.is_some();
            if stands(low) || !stands(low - 4.0) {
                continue; // The sign changes in a jump of the law.
            }
            [-4.0, -0.1, -1e-3, 0.0, 1e-3, 0.1, 4.0]
                .into_iter()
                .for_each(|beside| agree(kind, low + beside));
            found += 1;
        }
    }
    assert!(found >= 2, "{found}");
}

/// ȧ = ω da/dφ + 2α dv/dφ, by differences of the loop equations' own velocities and accelerations
/// in neighbouring poses.
#[test]
fn the_third_derivative_of_a_follower_is_that_of_its_law() {
    for kind in ["law cycloidal", "law harmonic", "swing 3-4-5", "swing cycloidal"] {
        for angle in [70.0, 200.5, 290.0] {
            let rates = |angle: f64| {
                let scene = scene(kind, &format!("{angle:?} deg"));
                let worked = work(&scene, Scope::Questions).unwrap().value;
                [0, 1].map(|k| component(worked.results[k].computed))
            };
            let h: f64 = 1e-3;
            let (after, before) = (rates(angle + h.to_degrees()), rates(angle - h.to_degrees()));
            let slope = |k: usize| (after[k] - before[k]) / (2.0 * h);
            let due = OMEGA * slope(1) + 2.0 * ALPHA * slope(0);
            let scene = scene(kind, &format!("{angle:?} deg"));
            let w = work(&scene, Scope::Figure).unwrap().value;
            let cam = &scene.cams[0];
            let place = w.configuration.points[cam.follows.point().0].unwrap();
            let all = third(&scene, &w.mechanism, &w.configuration, &w.demand, &w.solution, place);
            let (jerk, turning) = all[cam.follower.0].unwrap();
            let got = if kind.starts_with("law") {
                component(AnswerValue::Vector(jerk))
            } else {
                turning
            };
            assert!(
                (got - due).abs() < 1e-4 * due.abs().max(0.1),
                "{kind} at {angle}: {got}, by differences {due}"
            );
        }
    }
}

#[test]
fn at_a_joint_one_velocity_and_two_accelerations() {
    for kind in ["tangent", "edge", "flat"] {
        let disc = scene(kind, "10 deg").cams[0].disc.clone().unwrap().disc;
        let joints = PreparedDisc::of(&disc).corners();
        assert!(joints.len() >= 4, "{kind}: {joints:?}");
        for phi in joints {
            let [before, after] = [PieceSide::Before, PieceSide::After]
                .map(|side| disc.coordinate(phi, side).unwrap().0);
            assert!(
                (before[0] - after[0]).abs() < 1e-9 && (before[1] - after[1]).abs() < 1e-7,
                "{kind}: {before:?} {after:?}"
            );
            assert!((before[2] - after[2]).abs() > 1e-4, "{kind}: {before:?} {after:?}");
            let here = scene(kind, &format!("{:?} rad", phi));
            let t = here.cams[0].disc.as_ref().unwrap();
            assert_eq!(t.touched, disc.touched(phi, PieceSide::After), "{kind}");
        }
    }
}

#[test]
fn a_sweep_says_what_each_pose_says() {
    let laws = ["law cycloidal", "swing modified-sine"];
    for kind in PROFILES.into_iter().chain(laws) {
        let swept = scene(kind, "10 deg").over_a_turn();
        let mechanism = Mechanism::new(&swept).unwrap().value;
        let placed = PlacedScene::new(&swept, &mechanism).unwrap();
        let stations = Stations::turned(Angle::Deg(2.0), Angle::Deg(722.0), 40);
        let table = sweep::run(&placed, 0, &stations, Width::Widest).unwrap();
        assert_eq!(table.rows(), 41, "{kind}: {:?}", table.notes);
        for k in 0..41 {
            let there = scene(kind, &format!("{:?} deg", 2.0 + 18.0 * k as f64));
            let expected = expected(&there);
            let row: Vec<f64> = table.columns.iter().map(|c| c.values[k]).collect();
            // v_B.x, v_B.y, v_B, a_B.x, ...; or ω, α.
            let up = hodograph::geom::Vec2::from_angle(80.0_f64.to_radians());
            let got = if row.len() == 3 {
                [row[1], row[2]]
            } else {
                [row[1] * up.x + row[2] * up.y, row[4] * up.x + row[5] * up.y]
            };
            for (got, exact) in got.into_iter().zip(expected) {
                assert!(
                    (got - exact).abs() < 1e-9 * exact.abs().max(1e-3),
                    "{kind} row {k}: {got} {exact}"
                );
            }
        }
    }
}

/// A roller on an arm, at 12 mm from a disc of 40 mm about Q, which turns about O at 20 mm.
fn eccentric(angle: f64, told: &str, find: &[&str]) -> Scene {
    let text = format!(
        r#"{{"units": {{"length": "mm"}}, "links": {{"1": ["O", "P"], "2": ["O", "Q"], "3": ["P", "B"]}}, "ground": "1", "points": {{"O": [0, 0], "P": [100, 60]}},
        "lengths": {{"OQ": 20, "PB": 110}}, "cams": [{{"cam": "2", "follower": "3", "roller": {{"pin": "B", "radius": 12}}, "profile": {{"centre": "Q", "radius": 40}}}}],
        {told}, "driver": {{"link": "2", "angle": "{angle:?} deg", "omega": "14 rad/s"}}, "find": {find:?}}}"#
    );
    scene::read(&text).unwrap_or_else(|f| panic!("{f}\n{text}")).value
}

/// The roller's centre (mm): the circle of 52 mm about Q intersected with that of 110 mm about P,
/// left or right of the line PQ.
fn roller(angle: f64, left: bool) -> hodograph::geom::Vec2 {
    use hodograph::geom::Vec2;
    let (p, q) = (Vec2::new(100.0, 60.0), Vec2::from_angle(angle.to_radians()) * 20.0);
    let (way, d) = (q - p, (q - p).norm());
    let foot = (110.0f64.powi(2) - 52.0f64.powi(2) + d * d) / (2.0 * d);
    let height = (110.0f64.powi(2) - foot * foot).sqrt();
    p + way * (foot / d) + way.perp() * (if left { height / d } else { -height / d })
}

/// The side of the cam on which an arm lies may be given by a sketch, by the line of the pivots, or
/// by the line to the centre of the disc; the rise takes the angle through which the cam turns
/// while the roller moves outward.
#[test]
fn an_arm_lies_on_its_side_however_that_is_written() {
    let find = ["Phi_3", "pressure_3", "psi_3", "phi_3"];
    for left in [true, false] {
        let out = |k: usize| roller(0.1 * k as f64, left).norm();
        let by = |better: &dyn Fn(f64, f64) -> bool| {
            (0..3600).fold(0, |b, k| if better(out(k), out(b)) { k } else { b })
        };
        let (near, far) = (by(&|a, b| a < b), by(&|a, b| a > b));
        let rise = (0.1 * (far as f64 - near as f64)).rem_euclid(360.0);
        for angle in [10.0, 100.0, 200.0, 310.0] {
            let b = roller(angle, left);
            let side = if left { "left" } else { "right" };
            let pivots = if hodograph::geom::Vec2::new(-100.0, -60.0)
                .cross(b - hodograph::geom::Vec2::new(100.0, 60.0))
                > 0.0
            {
                "left"
            } else {
                "right"
            };
            let ways = [
                format!(r#""side": {{"B": "{side} of PQ"}}"#),
                format!(r#""side": {{"B": "{pivots} of PO"}}"#),
                format!(r#""sketch": {{"B": [{:?}, {:?}]}}"#, b.x, b.y),
            ];
            let told = ways.map(|told| {
                let worked = work(&eccentric(angle, &told, &find), Scope::Questions)
                    .unwrap_or_else(|f| panic!("{told}: {f}"))
                    .value;
                worked.results.iter().map(|r| component(r.value())).collect::<Vec<f64>>()
            });
            for other in &told[1..] {
                assert!(
                    told[0].iter().zip(other).all(|(a, b)| (a - b).abs() < 1e-9),
                    "{angle} {side}: {told:?}"
                );
            }
            assert!(
                (told[0][0].to_degrees() - rise).abs() < 0.3,
                "{angle} {side}: {:?}, not {rise}",
                told[0]
            );
        }
    }
}
