//! Cams with pivot and follower on a moving link, and cams that are the ground with a carrier
//! driven round them: compared with the same cam on the ground, with differences of positions, and
//! over a sweep; and the message where a law has no meaning.

#[path = "cams/matrix/mod.rs"]
mod matrix;
mod wide;

use hodograph::answer::AnswerValue;
use hodograph::certified::ladder::{certify, parts};
use hodograph::effort::truth;
use hodograph::mechanism::Mechanism;
use hodograph::number::{Ball, Real, within};
use hodograph::problem;
use hodograph::scene::{self, Angle, Scene, with_driver_at};
use hodograph::sweep::follow::course::over_a_turn;
use hodograph::sweep::timed::TimedSweep;
use hodograph::sweep::{self, PlacedScene, Stations, Table, Width};
use hodograph::worked::{Scope, instant, work};
use wide::every;

/// Angles (rad) and rates of cam and carrier at the instant.
const CAM: [f64; 3] = [0.0, 3.0, -2.0];
const ARM: [f64; 3] = [0.4, 1.7, 0.6];

/// A driver's text at a time (s) from the instant.
fn driver(link: &str, against: &str, start: [f64; 3], t: f64) -> String {
    let [angle, w, a] = start;
    let (angle, rate) = (angle + w * t + 0.5 * a * t * t, w + a * t);
    format!(
        r#"{{"link": "{link}", "against": "{against}", "angle": "{angle:?} rad", "omega": "{rate:?} rad/s", "alpha": "{a:?} rad/s^2"}}"#
    )
}

/// The contact and the profile.
fn cam(kind: &str) -> &'static str {
    match kind {
        "law slide" => {
            r#""roller": {"pin": "B", "radius": "9 mm"}, "profile": {"base": "40 mm", "start": "15 deg", "law": [{"dwell": "40 deg"},
            {"rise": "18 mm", "over": "130 deg", "law": "cycloidal"}, {"dwell": "70 deg"}, {"return": "18 mm", "over": "120 deg", "law": "3-4-5"}]}"#
        }
        "law flat" => {
            r#""face": {}, "profile": {"base": "60 mm", "turns": "clockwise", "law": [{"rise": "12 mm", "over": "130 deg", "law": "harmonic"},
            {"dwell": "110 deg"}, {"return": "12 mm", "over": "120 deg", "law": "modified-sine"}]}"#
        }
        "law swing" => {
            r#""roller": {"pin": "B", "radius": "9 mm"}, "profile": {"base": "40 mm", "law": [{"dwell": "40 deg"},
            {"rise": "17 deg", "over": "130 deg", "law": "modified-trapezoidal"}, {"dwell": "70 deg"}, {"return": "17 deg", "over": "120 deg", "law": "4-5-6-7"}]}"#
        }
        "arcs slide" => {
            r#""roller": {"pin": "B", "radius": "9 mm"}, "profile": [{"centre": "O", "radius": "30 mm"}, "tangent", {"centre": "Q", "radius": "14 mm"}, "tangent"]"#
        }
        "arcs swing" => {
            r#""roller": {"pin": "B", "radius": "9 mm"}, "profile": [{"centre": "O", "radius": "30 mm"}, "tangent", {"centre": "Q", "radius": "14 mm"}, "tangent"]"#
        }
        "arcs swinging face" => {
            r#""face": {"through": "P", "cam": "left"}, "profile": [{"centre": "O", "radius": "30 mm"}, {"radius": "70 mm"}, {"centre": "Q", "radius": "4 mm"}, {"radius": "75 mm"}]"#
        }
        other => panic!("{other}"),
    }
}

const KINDS: [&str; 6] =
    ["law slide", "law flat", "law swing", "arcs slide", "arcs swing", "arcs swinging face"];

/// The carrier of the cam.
#[derive(Clone, Copy, Debug, PartialEq)]
enum On {
    /// Cam 2 and follower 3 on the ground.
    Ground,
    /// On link 4, which turns about G on the ground.
    Arm,
    /// Link 4 turns about the cam, which is the ground.
    Still,
}

/// The scene at an angle of the cam in its carrier, at a time from the instant.
fn text(kind: &str, on: On, angle: f64, t: f64, find: &str) -> String {
    let (slides, face) = (!kind.contains("swing"), kind.ends_with("face"));
    let carrier = if on == On::Ground { "1" } else { "4" };
    let guide = match on {
        On::Ground => r#""through": "T", "angle": "80 deg""#,
        On::Arm => r#""through": "T", "line": "GH", "angle": "80 deg""#,
        On::Still => r#""through": "T", "line": "OH", "angle": "80 deg""#,
    };
    let guides = if slides {
        format!(r#""guides": [{{"pin": "B", "slider": "3", "on": "{carrier}", {guide}}}],"#)
    } else {
        String::new()
    };
    let third = match (slides, face) {
        (true, _) => "",
        (false, true) => r#", "3": ["P"]"#,
        (false, false) => r#", "3": ["P", "B"]"#,
    };
    let with = if slides { r#""T""# } else { r#""P""# };
    let (x, y) = if slides { (6.0, 3.0) } else { (95.0, 10.0) };
    let name = if slides { "T" } else { "P" };
    let arm = if slides || face { "" } else { r#", "PB": "75 mm""# };
    let cam_of = if on == On::Still { "1" } else { "2" };
    let cam_driver = [angle, CAM[1], CAM[2]];
    let (links, points, drivers) = match on {
        On::Ground => (
            format!(r#""1": ["O", {with}], "2": ["O", "Q"]"#),
            format!(r#""O": [0, 0], "{name}": ["{x} mm", "{y} mm"]"#),
            driver("2", "1", cam_driver, t),
        ),
        On::Arm => (
            format!(r#""1": ["G"], "4": ["G", "H", "O", {with}], "2": ["O", "Q"]"#),
            format!(
                r#""G": [0, 0], "O": {{"base": "GH", "x": "50 mm", "y": "20 mm"}}, "{name}": {{"base": "GH", "x": "{} mm", "y": "{} mm"}}"#,
                50.0 + x,
                20.0 + y
            ),
            format!("[{}, {}]", driver("2", "4", cam_driver, t), driver("4", "1", ARM, t)),
        ),
        On::Still => (
            format!(r#""1": ["O", "Q"], "4": ["O", "H", {with}]"#),
            format!(
                r#""O": [0, 0], "Q": ["35 mm", 0], "{name}": {{"base": "OH", "x": "{x} mm", "y": "{y} mm"}}"#
            ),
            // In its carrier, the cam turns against the carrier's own sense.
            driver("4", "1", [-angle, -CAM[1], -CAM[2]], t),
        ),
    };
    let mut lengths: Vec<&str> = Vec::new();
    lengths.extend((on == On::Arm).then_some(r#""GH": "200 mm""#));
    lengths.extend((on == On::Still).then_some(r#""OH": "120 mm""#));
    lengths.extend((on != On::Still).then_some(r#""OQ": "35 mm""#));
    let side = if slides || face { "" } else { r#""side": {"B": "right of PO"},"# };
    format!(
        r#"{{"links": {{{links}{third}}}, "ground": "1", "points": {{{points}}}, "lengths": {{{}{arm}}}, {guides} {side}
        "cams": [{{"cam": "{cam_of}", "follower": "3", {}}}], "driver": {drivers}, "find": [{find}]}}"#,
        lengths.join(", "),
        cam(kind)
    )
}

fn read(kind: &str, on: On, angle: f64, t: f64, find: &str) -> Scene {
    let text = text(kind, on, angle, t, find);
    scene::read(&text).unwrap_or_else(|f| panic!("{kind} {on:?} at {angle}: {f}\n{text}")).value
}

/// All answers, by the loop equations, and as drawn.
fn answers(kind: &str, on: On, angle: f64, t: f64, find: &str) -> Vec<f64> {
    let scene = read(kind, on, angle, t, find);
    let worked = work(&scene, Scope::Questions)
        .unwrap_or_else(|f| panic!("{kind} {on:?} at {angle}: {f}"))
        .value;
    assert!(worked.unanswered.is_empty(), "{kind} {on:?} at {angle}");
    for r in &worked.results {
        assert!(
            r.agreement.is_none_or(|a| a.holds()),
            "{kind} {on:?} at {angle}: {}",
            scene.find[r.find].text
        );
    }
    let numbers = |v: AnswerValue| match v {
        AnswerValue::Scalar(s) => vec![s],
        AnswerValue::Vector(v) => vec![v.x, v.y],
        AnswerValue::Point(p) => vec![p.x, p.y],
    };
    worked.results.iter().flat_map(|r| numbers(r.computed)).collect()
}

/// The point of the follower that is examined.
fn point(kind: &str) -> &'static str {
    if kind.ends_with("face") { "W" } else { "B" }
}

/// In its carrier, a follower moves as on the ground.
#[test]
fn a_carried_follower_swings_in_its_carrier_as_on_the_ground() {
    for kind in KINDS.into_iter().filter(|k| k.contains("swing")) {
        for k in (0..12).step_by(every(8)) {
            let angle = 0.05 + 0.5 * k as f64;
            let still = answers(kind, On::Ground, angle, 0.0, r#""omega_3", "alpha_3""#);
            for on in [On::Arm, On::Still] {
                let carried = answers(kind, on, angle, 0.0, r#""omega_3/4", "alpha_3/4""#);
                for (a, b) in still.iter().zip(&carried) {
                    assert!(
                        (a - b).abs() < 1e-11 * a.abs().max(1.0),
                        "{kind} {on:?} at {angle}: {still:?} {carried:?}"
                    );
                }
            }
        }
    }
}

/// Velocities and accelerations agree with differences of positions.
#[test]
fn carried_followers_move_as_differences_say() {
    let h = 1e-4;
    for kind in KINDS {
        for on in [On::Arm, On::Still] {
            for k in (0..12).step_by(every(8)) {
                let angle = 0.05 + 0.5 * k as f64;
                let p = point(kind);
                let exact = answers(kind, on, angle, 0.0, &format!(r#""v_{p}", "a_{p}""#));
                let at = |t: f64| answers(kind, on, angle, t, &format!(r#""x_{p}", "y_{p}""#));
                let (low, now, high) = (at(-h), at(0.0), at(h));
                for i in 0..2 {
                    let v = (high[i] - low[i]) / (2.0 * h);
                    let a = (high[i] - 2.0 * now[i] + low[i]) / (h * h);
                    assert!((v - exact[i]).abs() < 1e-6, "{kind} {on:?} at {angle}: {v} {exact:?}");
                    assert!(
                        (a - exact[2 + i]).abs() < 1e-4,
                        "{kind} {on:?} at {angle}: {a} {exact:?}"
                    );
                }
            }
        }
    }
}

/// A sweep over the cam's driver, from piece to piece, agrees with each single pose.
#[test]
fn sweeps_of_carried_cams_say_what_each_pose_says() {
    for kind in KINDS {
        let p = point(kind);
        let find = format!(r#""v_{p}", "a_{p}""#);
        for on in [On::Ground, On::Arm, On::Still] {
            let swept = read(kind, on, 0.3, 0.0, &find).over_a_turn();
            assert_eq!(swept.kept_cams().count(), 0, "{kind} {on:?}");
            let mechanism = Mechanism::new(&swept).unwrap().value;
            let placed = PlacedScene::new(&swept, &mechanism)
                .unwrap_or_else(|f| panic!("{kind} {on:?}: {f}"));
            let way = if on == On::Still { -1.0 } else { 1.0 };
            let stations = Stations::turned(Angle::Deg(2.0), Angle::Deg(362.0), 20);
            let table = sweep::run(&placed, 0, &stations, Width::Widest).unwrap();
            assert_eq!(table.rows(), 21, "{kind} {on:?}: {:?}", table.notes);
            for k in 0..21 {
                let angle = (2.0 + 18.0 * k as f64).to_radians() * way;
                let exact = answers(kind, on, angle, 0.0, &find);
                let row: Vec<f64> = table.columns.iter().skip(1).map(|c| c.values[k]).collect();
                // After the driver: v_B.x, v_B.y, v_B, a_B.x, ...
                for (got, exact) in [row[0], row[1], row[3], row[4]].into_iter().zip(exact) {
                    assert!(
                        (got - exact).abs() < 1e-9 * exact.abs().max(1e-2),
                        "{kind} {on:?} row {k}: {got} {exact}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_law_without_a_carrier_says_why_it_has_no_meaning() {
    let whole = text("law slide", On::Arm, 0.3, 0.0, "\"v_B\"");
    let cases = [
        // The follower slides on the ground, the cam turns on the arm.
        (
            r#""on": "4", "through": "T", "line": "GH", "angle": "80 deg""#,
            r#""on": "1", "through": [0, 0], "angle": "80 deg""#,
            "no link carries both",
        ),
        (r#""against": "4""#, r#""against": "1""#, "no driver turns cam"),
        (
            r#""line": "GH", "angle": "80 deg""#,
            r#""angle": "80 deg""#,
            "not a straight one that is fixed",
        ),
        (
            r#""T": {"base": "GH", "x": "56 mm", "y": "23 mm"}"#,
            r#""T": {"base": "GO", "x": "56 mm", "y": "23 mm"}"#,
            "not told",
        ),
    ];
    for (from, to, said) in cases {
        assert!(whole.contains(from), "{from}");
        let changed = whole.replacen(from, to, 1);
        match scene::read(&changed) {
            Ok(_) => assert!(said.is_empty(), "{to} is taken"),
            Err(faults) => {
                let all = faults.list.iter().map(|d| d.message.en.clone()).collect::<Vec<_>>();
                assert!(!said.is_empty() && all.iter().any(|m| m.contains(said)), "{to}: {all:?}");
                assert!(faults.list.iter().all(|d| !d.message.zh.is_empty()));
            }
        }
    }
}

/// Cams of several pieces on another link than their followers, with two drivers giving the pose: a
/// roller on an arm, a face on an arm, a slider with a cam carried round it.
fn apart(kind: &str, [cam, crank]: [f64; 2], rates: [f64; 2], find: &str) -> String {
    let swings = r#""links": {"1": ["O", "G"], "2": ["O", "Q"], "3": ["P", "B"], "4": ["G", "P"]},
        "points": {"O": [0, 0], "G": ["-100 mm", "-30 mm"]}, "lengths": {"OQ": "30 mm", "GP": "30 mm", "PB": "110 mm"}"#;
    let mechanism = match kind {
        "roller" => format!(
            r#"{swings}, "side": {{"B": "right of OP"}}, "cams": [{{"cam": "2", "follower": "3", "roller": {{"pin": "B", "radius": "10 mm"}},
            "profile": [{{"centre": "O", "radius": "25 mm"}}, "tangent", {{"centre": "Q", "radius": "12 mm"}}, "tangent"]}}]"#
        ),
        "face" => format!(
            r#"{swings}, "cams": [{{"cam": "2", "follower": "3", "face": {{"through": "P", "line": "PB", "cam": "right"}},
            "profile": [{{"centre": "O", "radius": "25 mm"}}, {{"radius": "80 mm"}}, {{"centre": "Q", "radius": "12 mm"}}, {{"radius": "80 mm"}}]}}]"#
        ),
        _ => r#""links": {"1": ["G", "S"], "2": ["O", "Q"], "3": ["B"], "4": ["G", "O"]}, "points": {"G": [0, 0], "S": ["20 mm", 0]},
            "guides": [{"pin": "B", "slider": "3", "on": "1", "through": "S", "angle": "90 deg"}], "lengths": {"OQ": "30 mm", "GO": "15 mm"},
            "cams": [{"cam": "2", "follower": "3", "roller": {"pin": "B", "radius": "10 mm"},
            "profile": [{"centre": "O", "radius": "25 mm"}, {"radius": "90 mm"}, {"centre": "Q", "radius": "12 mm"}, "tangent"]}]"#
            .to_owned(),
    };
    let [w, u] = rates;
    format!(
        r#"{{{mechanism}, "ground": "1", "find": [{find}], "driver": [{{"link": "2", "angle": "{cam:?} rad", "omega": "{w} rad/s"}},
        {{"link": "4", "angle": "{crank:?} rad", "omega": "{u} rad/s"}}]}}"#
    )
}

/// A turn of either driver, and both through time, pass from piece to piece where cam and follower
/// are on different links: each row agrees with its single pose, in which the piece is found
/// without any motion.
#[test]
fn motions_over_pieces_of_cams_on_other_links_say_what_each_pose_says() {
    for (kind, find) in [
        ("roller", r#""a_B", "omega_3""#),
        ("face", r#""alpha_3", "omega_3""#),
        ("slide", r#""a_B", "y_B""#),
    ] {
        let start = [0.9, if kind == "slide" { 1.4 } else { 2.1 }];
        let read = |at: [f64; 2]| {
            scene::read(apart(kind, at, [10.0, 3.0], find))
                .unwrap_or_else(|f| panic!("{kind}: {f}"))
                .value
        };
        let swept = over_a_turn(&read(start));
        assert_eq!(swept.kept_cams().count(), 0, "{kind}");
        let mechanism = Mechanism::new(&swept).unwrap().value;
        let placed = PlacedScene::new(&swept, &mechanism).unwrap();
        let check = |row: Vec<f64>, at: [f64; 2]| {
            let scene = read(at);
            let worked = work(&scene, Scope::Questions).unwrap().value;
            let exact: Vec<f64> =
                worked.results.iter().flat_map(|r| r.computed.columns()).collect();
            assert_eq!(row.len(), exact.len(), "{kind}");
            for (got, exact) in row.iter().zip(exact) {
                assert!(
                    (got - exact).abs() < 1e-8 * exact.abs().max(1e-2),
                    "{kind} at {at:?}: {got} {exact}"
                );
            }
        };
        let row = |table: &Table, k: usize| {
            table.columns.iter().skip(1).map(|c| c.values[k]).collect::<Vec<f64>>()
        };
        for driver in 0..2 {
            // The crank rocks, so that the arm does not leave the cam.
            let stations = if driver == 0 {
                Stations::turned(Angle::Deg(3.0), Angle::Deg(363.0), 12)
            } else {
                Stations::turned(Angle::Deg(60.0), Angle::Deg(130.0), 7)
            };
            let table = sweep::run(&placed, driver, &stations, Width::Widest).unwrap();
            assert_eq!(table.rows(), stations.len(), "{kind}: {:?}", table.notes);
            for k in 0..stations.len() {
                let mut at = start;
                at[driver] = stations.values[k];
                check(row(&table, k), at);
            }
        }
        let (timed, _) = TimedSweep::new(&placed, [Some(0.0), Some(0.3)]).unwrap();
        let table = timed.table(vec![0.0, 0.11, 0.3]);
        for (k, t) in [0.0, 0.11, 0.3].into_iter().enumerate() {
            check(row(&table, k), [start[0] + 10.0 * t, start[1] + 3.0 * t]);
        }
    }
}

/// At a joint of two pieces the contact passes to the piece that follows in the direction of its
/// motion round the cam, and both accelerations are reported; differences of the exact contact
/// agree (the nose of the tangent cam begins at φ₂, and the follower's pivot moves).
#[test]
fn a_joint_of_a_cam_on_another_link_tells_both_accelerations() {
    let joint = r#"{"links": {"1": ["O", "G"], "2": ["O", "Q"], "3": ["P", "B"], "4": ["G", "P"]}, "ground": "1",
        "points": {"O": [0, 0], "G": ["-120 mm", "20 mm"]}, "lengths": {"OQ": "40 mm", "GP": "50 mm", "PB": "90 mm"},
        "cams": [{"cam": "2", "follower": "3", "roller": {"pin": "B", "radius": "10 mm"},
            "profile": [{"centre": "O", "radius": "25 mm"}, "tangent", {"centre": "Q", "radius": "10 mm"}, "tangent"]}],
        "driver": [{"link": "2", "angle": "2.450057173713829 rad", "omega": "10 rad/s"}, {"link": "4", "angle": "80 deg", "omega": "3 rad/s"}],
        "side": {"B": "right of OP"}, "find": ["omega_3", "alpha_3"]}"#;
    let mut refused = 0;
    for (rate, alpha, words) in [
        ("10", 13.5609, "from -11.34 rad/s² to 13.56"),
        ("-10", -64.6442, "from 80.04 rad/s² to -64.64"),
    ] {
        let text = joint.replace(r#""omega": "10 rad/s""#, &format!(r#""omega": "{rate} rad/s""#));
        // The call for files of every kind takes the piece that follows.
        let read = problem::read(&text).unwrap();
        let solved = problem::solve(&read.value, &problem::Options::default()).unwrap();
        let Some(AnswerValue::Scalar(told)) =
            solved.answer("alpha_3", &problem::Look::default()).unwrap().value
        else {
            panic!("alpha_3")
        };
        assert!(read.notes[0].code == "joint" && (told - alpha).abs() < 1e-3, "{rate}: {told}");
        let scene = scene::read(&text).unwrap().value;
        refused += work(&scene, Scope::Questions)
            .is_err_and(|faults| faults.list[0].code == "joint") as usize;
        let hodograph::diag::Warned { value: scene, notes } = instant(scene);
        let note = &notes[0];
        assert!(note.code == "joint" && note.message.en.contains(words), "{}", note.message.en);
        let worked = work(&scene, Scope::Questions).unwrap().value;
        let AnswerValue::Scalar(found) = worked.results[1].value() else { panic!("alpha_3") };
        assert!((found - alpha).abs() < 1e-3, "{rate}: {found}");
        // The driven follower knows the neighbouring pieces.
        assert_eq!(over_a_turn(&scene).kept_cams().count(), 0);
    }
    assert_eq!(refused, 1, "of the two senses one leaves the piece that was read");
    assert!(
        instant(scene::read(joint.replace("2.45005", "2.46005")).unwrap().value).notes.is_empty()
    );
}

/// Certifies the answers of a scene with a driver in place of the follower's pair, and compares
/// each printed number with that of the scene with the pair, in 640-bit arithmetic; returns the
/// number of answers, and of those with fewer digits than requested.
fn told(name: &str, led: &Scene, pair: &Scene) -> [usize; 2] {
    let [led_worked, worked] = [led, pair]
        .map(|s| work(s, Scope::Questions).unwrap_or_else(|f| panic!("{name}: {f}")).value);
    let (mut told, mut short) = (0, 0);
    for digits in [4, 6, 12] {
        let certified = certify(led, &led_worked, digits);
        within(truth::BITS, || {
            let all = truth::answers(pair, &worked).unwrap_or_else(|f| panic!("{name}: {f}"));
            for ((c, r), t) in certified.iter().zip(&led_worked.results).zip(all) {
                let find = &led.find[r.find];
                // A direction given in double precision has no longer number.
                let Some(t) = t else { continue };
                let t = t.map(|x| Ball::new(x, 1e-45 * x.approx().abs().max(1.0)));
                let Ok(expected) = parts(find.what.kind(), t, r.scale, digits) else { continue };
                for (part, n) in &c.parts {
                    let Some((text, certain)) = n.text(digits) else {
                        short += 1;
                        continue;
                    };
                    (told, short) = (told + 1, short + usize::from(certain < digits));
                    let (_, e) = expected.iter().find(|(p, _)| p == part).unwrap();
                    let nothing = n.zero && e.enclosure().largest() <= 1e-9;
                    let truth = e.text(certain).map_or_else(|| format!("{e:?}"), |t| t.0);
                    assert!(
                        nothing || truth == text,
                        "{name}: {} {} is printed {text}, it is {truth}",
                        find.text,
                        part.key()
                    );
                }
            }
        });
    }
    [told, short]
}

/// A follower replaced by a driver has its double-precision place, within a computed bound: no
/// digit is printed that the pair does not have.
#[test]
fn digits_of_followers_that_are_led_are_those_of_their_pairs() {
    let mut all = [0, 0];
    let mut add = |[told, short]: [usize; 2]| all = [all[0] + told, all[1] + short];
    for (kind, find) in [
        ("roller", r#""a_B", "omega_3", "alpha_3", "pressure_3", "rho_2/3""#),
        ("slide", r#""a_B", "v_B", "y_B", "pressure_3""#),
    ] {
        let start = [0.9, if kind == "slide" { 1.4 } else { 2.1 }];
        let read = |at: [f64; 2]| {
            scene::read(apart(kind, at, [10.0, 3.0], find))
                .unwrap_or_else(|f| panic!("{kind}: {f}"))
                .value
        };
        let swept = over_a_turn(&read(start));
        for k in 0..24 / every(4) {
            let at = [0.1 + 0.26 * k as f64, start[1]];
            let pair = read(at);
            // On a straight piece ρ is infinite.
            if pair.cams[0].is_touched_straight() && find.contains("rho") {
                continue;
            }
            add(told(&format!("{kind} {k}"), &with_driver_at(&swept, 0, at[0]), &pair));
        }
    }
    for (kind, on) in KINDS.iter().flat_map(|kind| [On::Ground, On::Arm].map(|on| (*kind, on))) {
        if kind.ends_with("face") || on == On::Arm && kind.contains("flat") {
            continue;
        }
        for k in 0..12 / every(4) {
            let pair = read(kind, on, 0.13 + 0.5 * k as f64, 0.0, r#""v_B", "a_B", "x_B", "y_B""#);
            add(told(&format!("{kind} {on:?} {k}"), &pair.over_a_turn(), &pair));
        }
    }
    println!(
        "{} numbers of followers that are led, {} with fewer digits than asked",
        all[0], all[1]
    );
    assert!(all[0] >= 1200 / every(4) && all[1] * 4 <= all[0], "{all:?}");
}
