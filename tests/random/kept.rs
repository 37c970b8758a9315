//! The promises of a result: either a value is within its own certificate to the digits on which
//! drawing and analysis are said to agree, or no agreement is claimed; and a pose next to a
//! singular one, however near, is distinguished from it by the input as written.

use crate::emit::{Ask, Pose, scene as emitted};
use crate::properties::{mechanism, seeds, style};
use crate::singular::{FOUR_BAR, FRAMES, RATES, drive, scene_in};
use crate::wide::every;
use hodograph::accuracy::Agreement;
use hodograph::answer::AnswerValue;
use hodograph::certified::ladder::{AnswerPart, Certified, MissingDigits, certify};
use hodograph::geom::Vec2;
use hodograph::mechanism::Level;
use hodograph::scene::{Scene, read, templates, with_driver_at};
use hodograph::sweep::extreme::ends;
use hodograph::worked::{Outcome, Scope, Worked, work};

/// Counts of the examined results.
#[derive(Default, Debug)]
struct Seen {
    answers: usize,
    agreed: usize,
    longer: usize,
    computed: usize,
    broken: Vec<String>,
}

/// The middle of a certificate, if it is known far better than in `f64`.
fn certified(c: &Certified) -> Option<AnswerValue> {
    let number = |part: AnswerPart| {
        let e = c.part(part)?.enclosure();
        Some((e.approx, e.radius))
    };
    let (value, radius) = match number(AnswerPart::Scalar) {
        Some((x, r)) => (AnswerValue::Scalar(x), r),
        None => {
            let ((x, a), (y, b)) = (number(AnswerPart::X)?, number(AnswerPart::Y)?);
            (AnswerValue::Vector(Vec2::new(x, y)), a.max(b))
        }
    };
    (radius <= 1e-13 * value.magnitude()).then_some(value)
}

fn apart(a: AnswerValue, b: AnswerValue) -> f64 {
    match (a, b) {
        (AnswerValue::Scalar(a), AnswerValue::Scalar(b)) => (a - b).abs(),
        (AnswerValue::Vector(a), AnswerValue::Vector(b)) => (a - b).norm(),
        // The true value of a place is given as the vector to it.
        (AnswerValue::Point(a), AnswerValue::Vector(b))
        | (AnswerValue::Vector(b), AnswerValue::Point(a)) => (a.to_vec2() - b).norm(),
        (AnswerValue::Point(a), AnswerValue::Point(b)) => (a - b).norm(),
        _ => f64::INFINITY,
    }
}

impl Seen {
    fn check(&mut self, name: &str, scene: &Scene) {
        let Ok(done) = work(scene, Scope::Questions) else { return };
        let done = done.value;
        for (r, c) in done.results.iter().zip(certify(scene, &done, 12)) {
            let find = &scene.find[r.find];
            if find.what.level() == Level::Position
                || matches!(c.why, Some(MissingDigits::NextOrder(_)))
            {
                continue;
            }
            let Some(truth) = certified(&c) else { continue };
            self.answers += 1;
            if let Some(words) = self.broken_by(r, truth) {
                self.broken.push(format!(
                    "{name}: {} = {:?}, certified {truth:?}: {words}",
                    find.text,
                    r.value()
                ));
            }
        }
    }

    fn broken_by(&mut self, r: &Outcome, truth: AnswerValue) -> Option<String> {
        let size = truth.magnitude().max(1e-3 * r.scale);
        let off = apart(r.value(), truth) / size;
        match (r.agreement, r.longer) {
            (Some(a), _) => {
                self.agreed += 1;
                // The drawing may differ from the analysis by the bound, and the analysis from the
                // truth by half of it.
                let promised = 2.0 * a.bound.min(Agreement::MOST);
                if !a.holds() {
                    return Some(format!("they disagree: {a:?}"));
                }
                (off > promised).then(|| format!("off by {off:e}, promised {promised:e}"))
            }
            (None, Some(rung)) => {
                self.longer += 1;
                let last = 4.0 * f64::EPSILON * truth.magnitude();
                (apart(r.value(), truth) > last)
                    .then(|| format!("off by {off:e} though from {}", rung.name()))
            }
            (None, None) => {
                self.computed += 1;
                (off > Agreement::MOST).then(|| format!("off by {off:e}"))
            }
        }
    }

    fn done(&self, least: usize) {
        println!(
            "{} answers with a certificate: {} agreed upon, {} from longer numbers, {} from the loop equations alone; {} broken",
            self.answers,
            self.agreed,
            self.longer,
            self.computed,
            self.broken.len()
        );
        self.broken.iter().take(30).for_each(|b| println!("  {b}"));
        assert!(
            self.broken.is_empty(),
            "{} promises are broken, first: {}",
            self.broken.len(),
            self.broken[0]
        );
        assert!(self.answers >= least, "only {} answers were looked at", self.answers);
    }
}

fn scene_of(text: &str) -> Scene {
    read(text).unwrap_or_else(|f| panic!("{f}\n{text}")).value
}

#[test]
fn promises_are_kept_in_hard_cases() {
    let mut seen = Seen::default();
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cases");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|f| f.unwrap().path()).collect();
    files.sort();
    for path in files {
        let case: serde_json::Value =
            serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
        // A case that only counts has no solution.
        if case["expect"].as_array().unwrap().iter().any(|e| !e["find"].is_null()) {
            seen.check(
                &path.file_stem().unwrap().to_string_lossy(),
                &scene_of(&case["scene"].to_string()),
            );
        }
    }
    seen.done(250);
}

#[test]
fn promises_are_kept_next_to_toggles() {
    let mut seen = Seen::default();
    for t in templates::list().iter().step_by(every(8)) {
        let scene = scene_of(templates::get(t.name).unwrap());
        seen.check(t.name, &scene);
        for up in [true, false] {
            let Some(limit) = ends(&scene, 0).unwrap_or_default()[usize::from(up)] else {
                continue;
            };
            for k in 2..=14 {
                let at =
                    limit + if up { -1.0 } else { 1.0 } * 10f64.powi(-k) * limit.abs().min(1.0);
                seen.check(
                    &format!("{} 1e-{k} before {limit}", t.name),
                    &with_driver_at(&scene, 0, at),
                );
            }
        }
    }
    // The templates differ in their number of poses.
    seen.done(if every(8) == 1 { 500 } else { 30 });
}

/// Change points by lengths, where positions come from tangent circles and accelerations cancel;
/// dead centres by coordinates.
#[test]
fn promises_are_kept_next_to_singular_poses() {
    let mut seen = Seen::default();
    for k in 1..=15 {
        let h = format!("1e-{k}");
        for side in ["left", "right"] {
            // A parallelogram or an antiparallelogram near its change point; a four-bar that folds
            // flat.
            for (ab, bc, cd, ad) in [(1, 2, 1, 2), (2, 3, 5, 4), (1, 3, 3, 1)] {
                let text = format!(
                    r#"{{"links": {FOUR_BAR}, "ground": "0", "lengths": {{"AB": "{ab} m", "BC": "{bc} m", "CD": "{cd} m", "AD": "{ad} m"}},
                    "side": {{"C": "{side} of BD"}}, "driver": {{"link": "1", "angle": "{h} rad", "omega": "1 rad/s"}}, {RATES}}}"#
                );
                seen.check(&format!("{ab} {bc} {cd} {ad} at {h} rad, {side}"), &scene_of(&text));
            }
            // Crank equal to the rod: x = 2 cos θ.
            let text = format!(
                r#"{{"links": {{"1": ["A"], "2": ["A", "B"], "3": ["B", "C"]}}, "ground": "1", "points": {{"A": [0, 0]}},
                "lengths": {{"AB": "1 m", "BC": "1 m"}}, "guides": [{{"pin": "C", "slider": "4", "on": "1", "through": "A", "angle": "0 deg"}}],
                "driver": {{"link": "2", "angle": "90 deg - {h} deg", "omega": "1 rad/s"}}, "side": {{"C": "{side} of AB"}},
                "find": ["v_C", "a_C", "omega_3", "alpha_3"]}}"#
            );
            if let Ok(scene) = read(&text) {
                seen.check(&format!("r = l at {h} deg, {side}"), &scene.value);
            }
        }
        for f in FRAMES {
            let points = [
                ("A", 0.0, 0.0),
                ("B", 2.0, 0.0),
                ("C", 7.0, 5.0 * 10f64.powi(-k)),
                ("D", 4.0, -4.0),
            ];
            let text = scene_in(f, FOUR_BAR, &points, &format!("{}, {RATES}", drive(3, 1.0, 0.5)));
            seen.check(&format!("dead point at {h}, {}", f.angle), &scene_of(&text));
        }
    }
    seen.done(500);
}

#[test]
fn promises_are_kept_of_random_mechanisms() {
    let mut seen = Seen::default();
    for seed in seeds(60) {
        let Some(m) = mechanism(seed) else { continue };
        for pose in [Pose::Lengths, Pose::Coordinates] {
            if pose == Pose::Lengths && m.coordinates_only {
                continue;
            }
            let text = emitted(&m, &style(pose, Ask::Everything, seed));
            seen.check(&format!("seed {seed} {pose:?}"), &scene_of(&text));
        }
    }
    seen.done(1000);
}

/// Followers where they leave their cam, and a pin where it leaves the reach of its curved guide:
/// `{h}` rad before that, with the cam at `{w}` rad/s. The angle of the transition is written as
/// found: no text of limited digits gives it exactly.
const LEAVING: [(&str, &str); 5] = [
    (
        "knife edge",
        r#"{"links": {"1": ["O"], "2": ["O", "C"], "3": ["P"]}, "ground": "1", "points": {"O": [0, 0]}, "lengths": {"OC": "31 mm"},
        "guides": [{"pin": "P", "slider": "3", "on": "1", "through": "O", "angle": "90 deg"}], "sketch": {"P": ["0 mm", "15 mm"]},
        "driver": {"link": "2", "angle": "acos(28/31) + {h} rad", "omega": "{w} rad/s"}, "find": ["v_P", "a_P"],
        "cams": [{"cam": "2", "follower": "3", "edge": "P", "profile": {"centre": "C", "radius": "28 mm"}, "at": "E"}]}"#,
    ),
    (
        "offset knife edge",
        r#"{"links": {"1": ["O", "Q"], "2": ["O", "C"], "3": ["P"]}, "ground": "1", "points": {"O": [0, 0], "Q": ["3 mm", 0]},
        "lengths": {"OC": "31 mm"}, "guides": [{"pin": "P", "slider": "3", "on": "1", "through": "Q", "angle": "90 deg"}],
        "sketch": {"P": ["3 mm", "15 mm"]}, "driver": {"link": "2", "angle": "acos(28/31) + {h} rad", "omega": "{w} rad/s"},
        "find": ["v_P", "a_P"], "cams": [{"cam": "2", "follower": "3", "edge": "P", "profile": {"centre": "C", "radius": "25 mm"}, "at": "E"}]}"#,
    ),
    (
        "roller",
        r#"{"links": {"1": ["O"], "2": ["O", "C"], "3": ["P"]}, "ground": "1", "points": {"O": [0, 0]}, "lengths": {"OC": "40.5 mm"},
        "guides": [{"pin": "P", "slider": "3", "on": "1", "through": "O", "angle": "90 deg"}], "sketch": {"P": ["0 mm", "34 mm"]},
        "driver": {"link": "2", "angle": "acos(25/40.5) + {h} rad", "omega": "{w} rad/s"}, "find": ["v_P", "a_P"],
        "cams": [{"cam": "2", "follower": "3", "roller": {"pin": "P", "radius": "5 mm"}, "profile": {"centre": "C", "radius": "20 mm"}, "at": "E"}]}"#,
    ),
    (
        "arm",
        r#"{"links": {"1": ["O", "D"], "2": ["O", "C"], "3": ["D", "P"]}, "ground": "1", "points": {"O": [0, 0], "D": ["60 mm", 0]},
        "lengths": {"OC": "20 mm", "DP": "25 mm"}, "side": {"P": "left of DC"},
        "driver": {"link": "2", "angle": "acos((400+3600-2809)/2400) - {h} rad", "omega": "{w} rad/s"}, "find": ["v_P", "omega_3", "alpha_3"],
        "cams": [{"cam": "2", "follower": "3", "edge": "P", "profile": {"centre": "C", "radius": "28 mm"}, "at": "E"}]}"#,
    ),
    (
        "curved guide",
        r#"{"links": {"1": ["O"], "2": ["O", "C"], "3": ["P"]}, "ground": "1", "points": {"O": [0, 0]}, "lengths": {"OC": "40.5 mm"},
        "guides": [{"pin": "P", "slider": "3", "on": "1", "through": "O", "angle": "90 deg"}, {"pin": "P", "on": "2", "centre": "C", "radius": "25 mm"}],
        "sketch": {"P": ["0 mm", "33 mm"]}, "driver": {"link": "2", "angle": "acos(25/40.5) + {h} rad", "omega": "{w} rad/s"}, "find": ["v_P", "a_P"]}"#,
    ),
];

/// Next to a transition, a pose is answered for either sense of the cam, with the promised
/// agreement of drawing and analysis, or the answer states that it has no motion.
#[test]
fn followers_beside_their_transitions() {
    for (name, text) in LEAVING {
        let mut seen = Seen::default();
        for k in 1..=30 {
            let mut first: Option<f64> = None;
            for w in ["10", "-10"] {
                let text = text.replace("{h}", &format!("1e-{k}")).replace("{w}", w);
                let scene = read(&text)
                    .unwrap_or_else(|f| panic!("{name}, 1e-{k} rad, {w} rad/s: {f}"))
                    .value;
                let done = work(&scene, Scope::Figure)
                    .unwrap_or_else(|f| panic!("{name}, 1e-{k} rad, {w} rad/s: {f}"))
                    .value;
                for r in &done.results {
                    let find = &scene.find[r.find].text;
                    assert!(
                        r.agreement.is_none_or(|a| a.holds()),
                        "{name}, 1e-{k} rad, {w} rad/s: {find} {:?}",
                        r.agreement
                    );
                }
                // As written, no pose is the dead centre; the velocity reverses with the cam.
                assert!(done.unanswered.is_empty(), "{name}, 1e-{k} rad: {:?}", done.unanswered);
                let speed = done.results[0].value().magnitude();
                assert!(
                    first.is_none_or(|f| (f - speed).abs() <= 1e-6 * speed),
                    "{name}, 1e-{k} rad: {first:?} {speed}"
                );
                first = Some(speed);
                seen.check(&format!("{name}, 1e-{k} rad, {w} rad/s"), &scene);
            }
        }
        seen.done(100);
    }
}

/// Poses by coordinates at a distance `{H}` of being singular.
const BESIDE: [(&str, &str, &str); 5] = [
    (
        "rocker drives in the dead point",
        "omega_1",
        r#"{"links": {"1": ["A", "B"], "2": ["B", "C"], "3": ["D", "C"], "0": ["A", "D"]}, "ground": "0", "units": {"length": "m"},
        "points": {"A": [0, 0], "B": [2, 0], "C": [7, "{H}"], "D": [4, -4]},
        "driver": {"link": "3", "omega": "1 rad/s"}, "find": ["omega_1", "omega_2", "alpha_1"]}"#,
    ),
    (
        "coupler and rocker in line",
        "omega_3",
        r#"{"links": {"1": ["A", "D"], "2": ["A", "B"], "3": ["B", "C"], "4": ["D", "C"]}, "ground": "1", "units": {"length": "m"},
        "points": {"A": [0, 0], "B": [0, 1], "C": [4, 2], "D": [8, "3 + {H}"]},
        "driver": {"link": "2", "omega": "1 rad/s"}, "find": ["omega_3", "omega_4", "alpha_3", "alpha_4"]}"#,
    ),
    (
        "three legs through one point",
        "omega_4",
        r#"{"links": {"1": ["O", "G1", "G2"], "2": ["O", "A"], "3": ["A", "P"], "4": ["P", "Q", "R"], "5": ["G1", "Q"], "6": ["G2", "R"]},
        "ground": "1", "units": {"length": "m"}, "points": {"O": [0, 0], "A": [1, 2], "P": [4, "14/3 - {H}"], "Q": [7, 4], "R": [6, 8],
        "G1": [4, -2], "G2": [2, 6]}, "driver": {"link": "2", "omega": "1 rad/s"}, "find": ["omega_4", "omega_3", "alpha_4"]}"#,
    ),
    (
        "trammel along a guide",
        "v_B",
        r#"{"links": {"1": ["A", "B"], "0": ["O"]}, "ground": "0", "units": {"length": "m"},
        "points": {"O": [0, 0], "A": [1, 0], "B": [0, "{H}"]},
        "guides": [{"pin": "A", "slider": "2", "on": "0", "through": "O", "angle": "0 deg"},
        {"pin": "B", "slider": "3", "on": "0", "through": "O", "angle": "90 deg"}],
        "driver": {"slide": "A", "velocity": "1 m/s"}, "find": ["v_B", "omega_1", "a_B"]}"#,
    ),
    (
        "pin in a slot by its pivot",
        "omega_4",
        r#"{"links": {"1": ["O2", "O1"], "2": ["O1", "B"], "4": ["O2"]}, "ground": "1", "units": {"length": "m"},
        "points": {"O2": [0, 0], "O1": [0, 1], "B": ["0.3*{H}", "{H}"]}, "guides": [{"pin": "B", "slider": "3", "on": "4", "through": "O2"}],
        "driver": {"link": "2", "omega": "1 rad/s"}, "find": ["omega_4", "alpha_4"]}"#,
    ),
];

#[test]
fn what_is_written_is_distinguished_from_the_exact_dead_centre() {
    for (name, first, text) in BESIDE {
        let mut last: Option<f64> = None;
        for k in 8..=30 {
            let h = 10f64.powi(-k);
            let text = text.replace("{H}", &format!("1e-{k}"));
            let scene = scene_of(&text);
            let done = work(&scene, Scope::Questions)
                .unwrap_or_else(|f| panic!("{name}: {f}\n{text}"))
                .value;
            assert!(done.unanswered.is_empty(), "{name} at {h:e}: {:?}", done.unanswered);
            for (r, c) in done.results.iter().zip(certify(&scene, &done, 12)) {
                assert!(c.why.is_none(), "{name} at {h:e}: {} {c:?}", scene.find[r.find].text);
            }
            assert_eq!(scene.find[done.results[0].find].text, first);
            // Velocities are proportional to 1/h.
            let first = certified(&certify(&scene, &done, 15)[0])
                .unwrap_or_else(|| panic!("{name} at {h:e}: no certificate"));
            let product = first.magnitude() * h;
            if let Some(last) = last {
                assert!(
                    (product - last).abs() <= (100.0 * h + 1e-13) * last,
                    "{name} at {h:e}: {product:e} after {last:e}"
                );
            }
            last = Some(product);
        }
        let exact = text.replace("{H}", "0");
        let answered =
            work(&scene_of(&exact), Scope::Questions).is_ok_and(|w| w.value.unanswered.is_empty());
        assert!(!answered, "{name}: answered where it is singular\n{exact}");
    }
}

/// The triad of a report, digit for digit.
#[test]
fn a_triad_twelve_sixes_from_its_dead_centre() {
    let text = BESIDE[2].2.replace("14/3 - {H}", "4.666666666666");
    let scene = scene_of(&text);
    let done = work(&scene, Scope::Questions).unwrap().value;
    let AnswerValue::Scalar(omega) = done.results[0].value() else { panic!("no number") };
    assert!((omega + 555_555_555_555.67).abs() < 0.006, "{omega:?}");
}

/// The pin of a slotted lever less than a unit in the last place from the lever's pivot: the lever
/// turns at half the crank's angular velocity.
#[test]
fn a_pin_within_rounding_of_its_pivot() {
    for beside in ["1e-14", "1e-16", "1e-20", "1e-40"] {
        let text = templates::instantiate(
            "slotted-lever",
            &[("l_AB", "250 mm"), ("phi_1", &format!("-90 deg + {beside} deg"))],
        )
        .unwrap();
        let scene = scene_of(&text);
        let done = work(&scene, Scope::Questions).unwrap_or_else(|f| panic!("{beside}: {f}")).value;
        let omega = done.results.iter().find(|r| scene.find[r.find].text == "omega_3").unwrap();
        assert_eq!(omega.value(), AnswerValue::Scalar(5.0), "{beside}");
        let mut seen = Seen::default();
        seen.check(beside, &scene);
        seen.done(5);
    }
    // On the pivot as written, the program says so.
    let text = templates::instantiate("slotted-lever", &[("l_AB", "250 mm"), ("phi_1", "-90 deg")])
        .unwrap();
    let faults = work(&scene_of(&text), Scope::Questions).expect_err("no direction");
    assert!(faults.to_string().contains("lies on the pivot"), "{faults}");
}

/// True if positions were found again in longer numbers.
pub fn settled(scene: &Scene, w: &Worked) -> bool {
    let again =
        hodograph::position::recompute::<f64>(scene, &w.mechanism, &w.demand, &w.configuration);
    again.is_ok_and(|at| at != w.configuration)
}
