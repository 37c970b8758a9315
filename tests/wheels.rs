//! Redundant wheels 虚约束: further planets, further wheels of a cart, two gear pairs of one ratio;
//! wheels that are nearly redundant, redundant in one pose only, or that lock. And the phase of
//! wheels neither of which is known before the other.

#[path = "wheels/belts.rs"]
mod belts;
#[path = "wheels/ropes.rs"]
mod ropes;

use hodograph::answer::AnswerValue;
use hodograph::certified::ladder::certify;
use hodograph::diag::{Diagnostic, Faults, Severity};
use hodograph::mechanism::{Mechanism, MobilitySurvey, Opened};
use hodograph::position::redundant::{RedundancyVerdict, RepeatReason, check};
use hodograph::report::mobility;
use hodograph::scene::{self, Scene};
use hodograph::worked::{Scope, Worked, work};

fn read(text: &str) -> Scene {
    scene::read(text).unwrap_or_else(|f| panic!("{f}\n{text}")).value
}

fn errors(f: &Faults) -> Vec<&'static str> {
    f.list.iter().filter(|d| d.severity == Severity::Error).map(|d| d.code).collect()
}

fn scalar(scene: &Scene, worked: &Worked, find: &str) -> f64 {
    let i = scene.find.iter().position(|f| f.text == find).unwrap();
    match worked.results.iter().find(|r| r.find == i).unwrap_or_else(|| panic!("{find}")).computed {
        AnswerValue::Scalar(s) => s,
        other @ (AnswerValue::Vector(_) | AnswerValue::Point(_)) => panic!("{find} = {other:?}"),
    }
}

fn agree(scene: &Scene, worked: &Worked) {
    assert!(worked.unanswered.is_empty());
    for r in &worked.results {
        assert!(
            r.agreement.is_none_or(|a| a.holds()),
            "{}: {:?}",
            scene.find[r.find].text,
            r.agreement
        );
    }
}

/// A sun, a ring and planets of these radii (mm) on circles without play, at even distances.
fn planetary(planets: &[f64]) -> String {
    let (sun, ring) = (50.0, 100.0);
    let (mut on_arm, mut links, mut points, mut gears, mut find) =
        (String::new(), String::new(), String::new(), Vec::new(), String::new());
    for (k, r) in planets.iter().enumerate() {
        let (p, l) = (format!("P{k}"), 4 + k);
        let (d, angle) =
            (0.5 * (sun + ring), 0.3 + k as f64 * std::f64::consts::TAU / planets.len() as f64);
        on_arm.push_str(&format!(r#", "{p}""#));
        links.push_str(&format!(r#", "{l}": ["{p}"]"#));
        points.push_str(&format!(r#", "{p}": [{:?}, {:?}]"#, d * angle.cos(), d * angle.sin()));
        gears.push(format!(r#"{{"links": ["2", "{l}"], "centres": ["O", "{p}"], "radii": ["{:?} mm", "{r:?} mm"]}}"#, d - r));
        gears.push(format!(r#"{{"links": ["{l}", "1"], "centres": ["{p}", "O"], "radii": ["{r:?} mm", "{:?} mm"], "ring": "1"}}"#, d + r));
        find.push_str(&format!(r#", "omega_{l}", "alpha_{l}""#));
    }
    format!(
        r#"{{"units": {{"length": "mm"}}, "links": {{"1": ["O"], "2": ["O"], "3": ["O"{on_arm}]{links}}}, "ground": "1", "points": {{"O": [0, 0]{points}}},
        "gears": [{}], "driver": {{"link": "2", "omega": "9 rad/s", "alpha": "6 rad/s^2"}}, "find": ["omega_3", "alpha_3"{find}]}}"#,
        gears.join(", ")
    )
}

#[test]
fn further_planets_are_solved_and_reported() {
    for count in [2, 3, 4, 5] {
        let text = planetary(&vec![25.0; count]);
        let scene = read(&text);
        let worked = work(&scene, Scope::Figure).unwrap_or_else(|f| panic!("{count}: {f}"));
        assert_eq!(worked.value.redundant.len(), count - 1);
        for r in &worked.value.redundant {
            assert_eq!((r.verdict, r.positions), (RedundancyVerdict::Virtual, 5));
            assert!(matches!(r.reason, RepeatReason::RepeatedPlanets(_)), "{r:?}");
        }
        agree(&scene, &worked.value);
        // Willis: the arm makes a third of the sun's turns, a planet as many as the sun the other
        // way.
        for (find, exact) in [("omega_3", 3.0), ("alpha_3", 2.0)] {
            assert!((scalar(&scene, &worked.value, find) - exact).abs() < 1e-12);
        }
        for k in 0..count {
            assert!(
                (scalar(&scene, &worked.value, &format!("omega_{}", 4 + k)) + 9.0).abs() < 1e-12
            );
        }
        let survey = MobilitySurvey::of(&scene);
        assert_eq!(
            survey.counts.freedom(count - 1, survey.local.len()),
            1,
            "{count}: {:?}",
            survey.counts
        );
    }
}

/// A planet with ratios other than those of the others.
#[test]
fn a_planet_that_nearly_fits_warns_and_another_locks() {
    for (last, code) in [(25.000001, None), (25.5, Some("locked"))] {
        let text = planetary(&[25.0, 25.0, last]);
        match (work(&read(&text), Scope::Questions), code) {
            (Ok(done), None) => {
                let warned =
                    |d: &&Diagnostic| d.code == "almost-virtual" && d.severity == Severity::Warning;
                assert!(done.notes.iter().any(|d| warned(&d)), "{:?}", done.notes);
            }
            (Err(faults), Some(code)) => assert_eq!(errors(&faults), [code], "{faults}"),
            (done, code) => panic!("{last}: {code:?} {:?}", done.map(|_| ())),
        }
    }
}

/// A cart on wheels of these radii (mm) along a line, with the axle of the last raised by `high`.
fn cart(radii: &[f64], high: f64) -> String {
    let (mut axles, mut links, mut points, mut rolling, mut find) =
        (Vec::new(), String::new(), String::new(), Vec::new(), String::new());
    for (k, r) in radii.iter().enumerate() {
        let (p, l, last) = (format!("A{k}"), 2 + k, k + 1 == radii.len());
        axles.push(format!(r#""{p}""#));
        links.push_str(&format!(r#", "{l}": ["{p}"]"#));
        points.push_str(&format!(
            r#", "{p}": [{:?}, {:?}]"#,
            130.0 * k as f64,
            r + if last { high } else { 0.0 }
        ));
        let wheel = r + if last && high < 0.0 { high } else { 0.0 };
        rolling.push(format!(r#"{{"wheel": "{l}", "centre": "{p}", "radius": "{wheel:?} mm", "through": [0, 0], "angle": "0 deg"}}"#));
        find.push_str(&format!(r#", "omega_{l}""#));
    }
    format!(
        r#"{{"units": {{"length": "mm"}}, "links": {{"1": ["O"]{links}, "c": [{}]}}, "ground": "1", "points": {{"O": [0, 0]{points}}},
        "rolling": [{}], "driver": {{"link": "2", "omega": "-2 rad/s", "alpha": "-1 rad/s^2"}}, "find": ["v_A0", "a_A0", "omega_c"{find}]}}"#,
        axles.join(", "),
        rolling.join(", ")
    )
}

/// The third wheel of a cart touches because its axle keeps it there; its rolling condition stays.
#[test]
fn further_wheels_of_a_cart_touch_by_themselves() {
    for radii in [&[100.0, 100.0, 100.0][..], &[100.0, 60.0, 80.0], &[50.0, 60.0, 70.0, 80.0]] {
        let scene = read(&cart(radii, 0.0));
        let m = Mechanism::new(&scene).unwrap().value;
        assert_eq!(m.redundant.len(), radii.len() - 2);
        for r in &m.redundant {
            assert!(
                matches!(r.opened, Opened::Guide(g) if scene.guides[g.0].rolling.is_some()),
                "{r:?}"
            );
        }
        for c in check(&scene, &m).unwrap_or_else(|f| panic!("{f}")) {
            assert_eq!((c.verdict, c.positions), (RedundancyVerdict::Virtual, 5), "{c:?}");
            assert!(matches!(c.reason, RepeatReason::ParallelGuides(_)), "{c:?}");
        }
        let worked = work(&scene, Scope::Figure).unwrap_or_else(|f| panic!("{radii:?}: {f}")).value;
        agree(&scene, &worked);
        for (k, r) in radii.iter().enumerate() {
            let omega = scalar(&scene, &worked, &format!("omega_{}", 2 + k));
            assert!((omega + 2.0 * radii[0] / r).abs() < 1e-12, "{radii:?}: {omega}");
        }
        let (survey, checked) = mobility::surveyed(&scene);
        let json = mobility::json(&scene, &survey, &checked);
        assert_eq!(
            (json["F"].as_i64(), json["p_virtual"].as_u64()),
            (Some(1), Some(radii.len() as u64 - 2)),
            "{json}"
        );
        let s = &json["substituted"];
        assert_eq!(3 * s["n"].as_i64().unwrap() - 2 * s["p_l"].as_i64().unwrap(), 1, "{s}");
    }
}

/// A last wheel on the top of a round track: in the pose, and to first order, it touches; slightly
/// farther on it does not.
#[test]
fn a_wheel_on_the_top_of_a_hump_only_shakes() {
    let text = r#"{"units": {"length": "mm"}, "links": {"1": ["O", "K"], "2": ["A"], "3": ["B"], "4": ["C"], "5": ["A", "B", "C"]}, "ground": "1",
        "points": {"O": [0, 0], "K": [300, -400], "A": [0, 100], "B": [150, 100], "C": [300, 100]},
        "rolling": [{"wheel": "2", "centre": "A", "radius": "100 mm", "through": [0, 0], "angle": "0 deg"},
        {"wheel": "3", "centre": "B", "radius": "100 mm", "through": [0, 0], "angle": "0 deg"},
        {"wheel": "4", "centre": "C", "radius": "100 mm", "on": "1", "track": "K", "track_radius": "400 mm"}],
        "driver": {"link": "2", "omega": "-2 rad/s"}, "find": ["v_A"]}"#;
    assert_eq!(errors(&work(&read(text), Scope::Questions).unwrap_err()), ["shaky"]);
}

/// Two pairs of gears on the same two shafts: with one ratio the second is redundant, with another
/// it locks; so do three gears that mesh in a ring.
#[test]
fn gears_side_by_side_repeat_or_lock() {
    let pair = |second: [u32; 2]| {
        format!(
            r#"{{"units": {{"length": "mm"}}, "links": {{"1": ["O", "A"], "2": ["O"], "3": ["A"]}}, "ground": "1", "points": {{"O": [0, 0], "A": [100, 0]}},
            "gears": [{{"links": ["2", "3"], "centres": ["O", "A"], "teeth": [20, 40]}}, {{"links": ["2", "3"], "centres": ["O", "A"], "teeth": {second:?}}}],
            "driver": {{"link": "2", "omega": "2 rad/s"}}, "find": ["omega_3"]}}"#
        )
    };
    assert!(
        work(&read(&pair([30, 60])), Scope::Questions)
            .is_ok_and(|w| w.value.redundant[0].verdict == RedundancyVerdict::Virtual)
    );
    assert_eq!(errors(&work(&read(&pair([30, 61])), Scope::Questions).unwrap_err()), ["locked"]);
    let ring = r#"{"units": {"length": "mm"}, "links": {"1": ["O", "A", "B"], "2": ["O"], "3": ["A"], "4": ["B"]}, "ground": "1",
        "points": {"O": [0, 0], "A": [100, 0], "B": [50, 80]}, "gears": [{"links": ["2", "3"], "centres": ["O", "A"], "teeth": [20, 20]},
        {"links": ["3", "4"], "centres": ["A", "B"], "teeth": [20, 20]}, {"links": ["4", "2"], "centres": ["B", "O"], "teeth": [20, 20]}],
        "driver": {"link": "2", "omega": "2 rad/s"}, "find": ["omega_4"]}"#;
    assert_eq!(errors(&work(&read(ring), Scope::Questions).unwrap_err()), ["locked"]);
}

/// Two links of a group that roll on one another while neither is known, on pivots of a crank and
/// of the ground: external and internal mesh on a floating arm, a wheel on a moving circle, a wheel
/// on a moving line.
fn rolling_on_one_another(kind: &str) -> Scene {
    let (c, d, links, rolls, find) = match kind {
        "gears" => (
            [60, 150],
            [180, 130],
            r#""4": ["C", "D"],"#,
            r#""gears": [{"links": ["3", "5"], "centres": ["C", "D"], "teeth": [20, 30]}]"#,
            r#", "omega_4", "alpha_4""#,
        ),
        "ring" => (
            [120, 150],
            [150, 150],
            r#""4": ["C", "D"],"#,
            r#""gears": [{"links": ["3", "5"], "centres": ["C", "D"], "teeth": [20, 60], "ring": "5"}]"#,
            r#", "omega_4", "alpha_4""#,
        ),
        "circle" => (
            [60, 150],
            [180, 150],
            "",
            r#""rolling": [{"wheel": "3", "centre": "C", "radius": "50 mm", "on": "5", "track": "D", "track_radius": "70 mm"}]"#,
            "",
        ),
        _ => (
            [70, 150],
            [200, 100],
            "",
            r#""rolling": [{"wheel": "3", "centre": "C", "radius": "130 mm", "on": "5", "line": "ED"}]"#,
            "",
        ),
    };
    read(&format!(
        r#"{{"units": {{"length": "mm"}}, "links": {{"1": ["A", "E"], "2": ["A", "B"], "3": ["B", "C"], {links} "5": ["D", "E"]}}, "ground": "1",
        "points": {{"A": [0, 0], "E": [200, 0], "B": [25, 43], "C": {c:?}, "D": {d:?}}}, {rolls},
        "driver": {{"link": "2", "omega": "5 rad/s", "alpha": "2 rad/s^2"}}, "find": ["omega_3", "omega_5", "alpha_3", "alpha_5", "v_C", "a_C"{find}]}}"#
    ))
}

/// They are drawn from their common contact; drawing and loop equations agree on everything.
#[test]
fn wheels_that_wait_for_one_another_are_drawn_from_their_contact() {
    for kind in ["gears", "ring", "circle", "line"] {
        let scene = rolling_on_one_another(kind);
        let worked = work(&scene, Scope::Figure).unwrap_or_else(|f| panic!("{kind}: {f}"));
        let note = worked
            .notes
            .iter()
            .find(|d| d.code == "higher-group")
            .unwrap_or_else(|| panic!("{kind}: {:?}", worked.notes));
        assert!(note.message.en.contains("the special point method"), "{kind}: {note:?}");
        agree(&scene, &worked.value);
        for r in &worked.value.results {
            assert!(r.drawn.is_some(), "{kind}: {} is not drawn", scene.find[r.find].text);
        }
        // Relative to the arm the two turn in the ratio of their teeth.
        let ratio = match kind {
            "gears" => -20.0 / 30.0,
            "ring" => 20.0 / 60.0,
            _ => continue,
        };
        let [three, arm, five] =
            ["omega_3", "omega_4", "omega_5"].map(|find| scalar(&scene, &worked.value, find));
        assert!((five - arm - ratio * (three - arm)).abs() < 1e-10, "{kind}: {three} {five} {arm}");
    }
}

/// A closed train that splits the power over sun and ring, given by numbers of teeth alone: by
/// Willis' formula.
#[test]
fn a_closed_train_needs_neither_sizes_nor_places() {
    let text = r#"{"links": {"0": ["X", "O"], "1": ["X"], "2": ["O"], "3": ["O"], "4": ["O", "P"], "5": ["P"]}, "ground": "0",
        "gears": [{"links": ["1", "2"], "centres": ["X", "O"], "teeth": [20, 50]}, {"links": ["1", "3"], "centres": ["X", "O"], "teeth": [18, 90]},
        {"links": ["2", "5"], "centres": ["O", "P"], "teeth": [24, 30]}, {"links": ["5", "3"], "centres": ["P", "O"], "teeth": [30, 84], "ring": "3"}],
        "driver": {"link": "1", "omega": "90 rad/s"}, "find": ["omega_2", "omega_3", "omega_4", "omega_5", "i_14"]}"#;
    let scene = read(text);
    let worked = work(&scene, Scope::Figure).unwrap_or_else(|f| panic!("{f}")).value;
    agree(&scene, &worked);
    let [sun, ring] = [-90.0 * 20.0 / 50.0, -90.0 * 18.0 / 90.0];
    // (sun − arm)/(ring − arm) = −84/24, and the planet against the arm as the sun by −24/30.
    let arm = (24.0 * sun + 84.0 * ring) / 108.0;
    let planet = arm - 24.0 / 30.0 * (sun - arm);
    for (find, exact) in [
        ("omega_2", sun),
        ("omega_3", ring),
        ("omega_4", arm),
        ("omega_5", planet),
        ("i_14", 90.0 / arm),
    ] {
        let got = scalar(&scene, &worked, find);
        assert!((got - exact).abs() < 1e-12 * exact.abs(), "{find} = {got}, not {exact}");
    }
}

/// A rack on a rocker, held to its pinion by the mesh only: drawn as pinned at the pitch point.
#[test]
fn a_rack_held_by_its_mesh_is_drawn_from_the_pitch_point() {
    let text = r#"{"links": {"1": ["O", "A"], "2": ["A", "B"], "3": ["B"], "4": ["O"]}, "ground": "1",
        "points": {"O": [0, 0], "A": ["-300 mm", "-80 mm"], "B": ["-220 mm", "100 mm"]},
        "gears": [{"links": ["4", "3"], "centres": ["O"], "radii": ["40 mm"], "rack": "3", "angle": "10 deg", "at": "Q"}],
        "driver": {"link": "4", "omega": "3 rad/s", "alpha": "1 rad/s^2"}, "find": ["omega_2", "alpha_2", "omega_3", "alpha_3", "v_B", "a_B"]}"#;
    let scene = read(text);
    let worked = work(&scene, Scope::Figure).unwrap_or_else(|f| panic!("{f}")).value;
    agree(&scene, &worked);
    assert!(worked.plan.specials.is_empty() && worked.results.iter().all(|r| r.drawn.is_some()));
}

/// The pitch line of a rack that slides in the ground: the pair takes one freedom, with a driver
/// named or not.
#[test]
fn a_rack_in_its_guide_is_held_by_the_guide() {
    let text = r#"{"links": {"1": ["O"], "2": ["O"]}, "ground": "1", "points": {"O": [0, 0]}, "guides": [{"slider": "3", "on": "1", "angle": "0 deg"}],
        "gears": [{"links": ["2", "3"], "centres": ["O"], "radii": ["30 mm"], "rack": "3", "angle": "0 deg"}]}"#;
    let survey = MobilitySurvey::of(&scene::read_topology(text).unwrap().value);
    assert_eq!((survey.counts.higher, survey.counts.freedom(0, 0)), (1, 1));
    let lever = r#"{"links": {"1": ["O"], "2": ["O"]}, "ground": "1", "points": {"O": [0, 0]}, "guides": [{"pin": "B", "slider": "3", "on": "2", "through": "O"},
        {"pin": "B", "slider": "4", "on": "1", "through": ["300 mm", 0], "angle": "90 deg"}], "driver": {"link": "2", "angle": "25 deg", "omega": "2 rad/s"}}"#;
    assert_eq!(
        MobilitySurvey::of(&scene::read_topology(lever).unwrap().value).counts.freedom(0, 0),
        1
    );
}

/// Gears on the two floating links of a five-bar: their pose is found as a whole, near the sketch.
fn waiting_for_one_another(teeth: [u32; 2], phase: Option<f64>) -> Scene {
    let phase = phase.map_or(String::new(), |p| format!(r#", "phase": "{p} deg""#));
    read(&format!(
        r#"{{"links": {{"1": ["O", "D"], "2": ["O", "A"], "3": ["A", "B"], "4": ["B", "C"], "5": ["C", "D"]}}, "ground": "1",
        "points": {{"O": [0, 0], "D": ["200 mm", 0]}}, "lengths": {{"OA": "50 mm", "AB": "120 mm", "BC": "100 mm", "CD": "110 mm"}},
        "sketch": {{"B": [0.1, 0.11], "C": [0.19, 0.1]}}, "gears": [{{"links": ["3", "5"], "centres": ["B", "C"], "teeth": {teeth:?}, "at": "K"{phase}}}],
        "driver": {{"link": "2", "angle": "60 deg", "omega": "10 rad/s"}}, "find": ["omega_3", "omega_5"]}}"#
    ))
}

/// Angle of the second wheel's line from the line of centres when the first, rolled back, is on it
/// (degrees).
fn phase_of(worked: &Worked, scene: &Scene, [z3, z5]: [u32; 2]) -> f64 {
    let at = |name: &str| {
        worked.configuration.points[scene.points.iter().position(|p| p.name == name).unwrap()]
            .unwrap()
    };
    let line = (at("C") - at("B")).angle();
    let from_line = |angle: f64| (angle - line).sin().atan2((angle - line).cos());
    let [of_3, of_5] = [at("B") - at("A"), at("D") - at("C")].map(|link| from_line(link.angle()));
    (of_5 + of_3 * f64::from(z3) / f64::from(z5)).to_degrees()
}

#[test]
fn the_phase_of_wheels_that_wait_for_one_another_is_kept() {
    for teeth in [[40, 40], [30, 45]] {
        // Without a phase the sketch decides.
        let free = waiting_for_one_another(teeth, None);
        let sketched = work(&free, Scope::Questions).unwrap().value;
        let (own, rate) = (phase_of(&sketched, &free, teeth), scalar(&free, &sketched, "omega_3"));
        for more in [0.0, 4.0, 11.0, -3.0] {
            let scene = waiting_for_one_another(teeth, Some(own + more));
            let worked = work(&scene, Scope::Questions).unwrap().value;
            agree(&scene, &worked);
            for c in certify(&scene, &worked, 20) {
                assert!(c.why.is_none(), "{teeth:?}: {:?}", c.why);
            }
            let off =
                (phase_of(&worked, &scene, teeth) - own - more + 180.0).rem_euclid(360.0) - 180.0;
            assert!(off.abs() < 1e-9, "{teeth:?}: the phase {} is missed by {off}°", own + more);
            let changed = (scalar(&scene, &worked, "omega_3") - rate).abs();
            assert_eq!(changed > 1e-3, more != 0.0, "{teeth:?}: {changed}");
        }
    }
}

/// A train given by its numbers of teeth alone is laid out along the x axis, at any length.
#[test]
fn a_train_by_teeth_is_as_long_as_one_likes() {
    for count in [3, 66, 67, 100, 200, 480] {
        let teeth = |k: usize| 17 + 7 * k % 23;
        let name = |k: usize| (k + 1).to_string();
        let mut links = serde_json::Map::new();
        links.insert("0".into(), (0..count).map(|k| format!("G{k}")).collect());
        (0..count).for_each(|k| drop(links.insert(name(k), serde_json::json!([format!("G{k}")]))));
        let gears: Vec<serde_json::Value> = (1..count)
            .map(|k| {
                serde_json::json!({"links": [name(k - 1), name(k)], "centres": [format!("G{}", k - 1), format!("G{k}")], "teeth": [teeth(k - 1), teeth(k)]})
            })
            .collect();
        let scene = serde_json::json!({"links": links, "ground": "0", "gears": gears, "driver": {"link": "1", "omega": "10 rad/s"},
            "find": [format!("omega_{count}")]});
        let scene =
            scene::read(scene.to_string()).unwrap_or_else(|f| panic!("{count} gears: {f}")).value;
        let done =
            work(&scene, Scope::Questions).unwrap_or_else(|f| panic!("{count} gears: {f}")).value;
        let sign = if count % 2 == 0 { -1.0 } else { 1.0 };
        let due = sign * 10.0 * teeth(0) as f64 / teeth(count - 1) as f64;
        let AnswerValue::Scalar(found) = done.results[0].value() else { panic!("no number") };
        assert!((found - due).abs() < 1e-9 * due.abs(), "{count} gears: {found} {due}");
    }
}

/// A faulty pair causes no further faults: with any name of its contact and any driver of its
/// centre, its own fault is reported.
#[test]
fn the_contact_of_a_wheel_with_any_name() {
    for at in ["C", "S", "P", "1", "2", "4", "Q", "X", "A'"] {
        for driven in ["C", "P", "S", "4", "Q"] {
            let text = format!(
                r#"{{"units": {{"length": "mm"}}, "links": {{"2": ["C", "P"], "3": ["P", "S"]}}, "ground": "1",
                "rolling": [{{"wheel": "2", "centre": "C", "radius": 50, "angle": "0 deg", "at": "{at}"}}],
                "guides": [{{"pin": "S", "slider": "4", "angle": "0 deg"}}], "points": {{"C": [0, 0], "P": [0, 30], "S": [90, 0]}},
                "driver": {{"slide": "{driven}", "velocity": "1 m/s"}}, "find": ["v_C"]}}"#
            );
            let told = scene::read(&text);
            let reused = ["C", "S", "P"].contains(&at);
            assert!(
                !reused
                    || told
                        .as_ref()
                        .is_err_and(|f| f.list.iter().any(|d| d.code == "contact-point")),
                "{at} {driven}: {told:?}"
            );
            // Parts that the faulty pair would have defined are not reported as missing.
            let missed = told.err().is_some_and(|f| f.list.iter().any(|d| d.code == "driver"));
            assert!(
                !(reused && driven == "C" && missed),
                "{at}: the wheel's centre is said to run nowhere"
            );
        }
    }
}

/// Gears with a distance that other pairs change are refused, those with a constant distance are
/// not: racks at an angle to their guides, and gears on the pins of a rocking coupler.
#[test]
fn gears_whose_distance_changes_lock_the_mechanism() {
    let rack = |angle: f64| {
        format!(
            r#"{{"units": {{"length": "mm"}}, "links": {{"1": ["A"], "2": ["A", "B"], "3": ["B", "C"], "4": ["C"]}}, "ground": "1",
            "points": {{"A": [0, 0], "B": [60, 80], "C": [210, 0]}}, "guides": [{{"slider": "5", "on": "1", "angle": "0 deg"}}],
            "rolling": [{{"wheel": "4", "centre": "C", "radius": 40, "angle": "0 deg", "at": "Q"}}],
            "gears": [{{"links": ["4", "5"], "centres": ["C"], "radii": [40], "rack": "5", "angle": "{angle:?} deg", "at": "S"}}],
            "driver": {{"link": "2", "omega": "10 rad/s"}}, "find": ["v_S5"]}}"#
        )
    };
    let coupler = |on: &str| {
        format!(
            r#"{{"units": {{"length": "mm"}}, "links": {{"1": ["A", "D"], "2": ["A", "B"], "3": ["B", "C"], "4": ["D", "C"], "5": ["B"], "6": ["{on}"]}},
            "ground": "1", "points": {{"A": [0, 0], "B": [0, 40], "C": [90, 60], "D": [100, 0]}},
            "gears": [{{"links": ["5", "6"], "centres": ["B", "{on}"], "radii": [null, 30], "at": "S"}}],
            "driver": [{{"link": "2", "omega": "10 rad/s"}}, {{"link": "6", "omega": "2 rad/s"}}], "find": ["omega_5"]}}"#
        )
    };
    let between = |on: &str| {
        coupler(on).replace(
            "null",
            &format!(
                "{:?}",
                f64::hypot(
                    if on == "C" { 90.0 } else { 100.0 },
                    if on == "C" { 20.0 } else { 40.0 }
                ) - 30.0
            ),
        )
    };
    let scenes = [
        (rack(0.0), true),
        (rack(180.0), true),
        (rack(150.0), false),
        (rack(1.0), false),
        (between("C"), true),
        (between("D"), false),
    ];
    for (text, holds) in scenes {
        let scene = read(&text);
        let count = mobility::Counted::of(&scene);
        assert_eq!(count.survey.choices.is_empty(), !holds, "{text}");
        match work(&scene, Scope::Questions) {
            Ok(worked) => {
                assert!(holds, "{text}");
                agree(&scene, &worked.value);
            }
            Err(f) => assert!(!holds && errors(&f) == ["locked"], "{f}\n{text}"),
        }
    }
}
