//! Singular poses: each has its answer or its diagnosis, for any rotation, scale and shift of the
//! scene.

use hodograph::analytic::SingularKind;
use hodograph::answer::AnswerValue;
use hodograph::diag::Faults;
use hodograph::geom::Vec2;
use hodograph::scene::quantity::Meaning;
use hodograph::scene::{self, DriverKind, Scene};
use hodograph::worked::{Scope, Worked, work};

/// A rotation, a scale and a shift of all coordinates as written: products and sums of short
/// decimals, so that a singular pose stays singular to the last digit of any number.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// Cosine and sine of the rotation.
    turn: [&'static str; 2],
    /// The rotation angle.
    pub angle: &'static str,
    pub scale: f64,
    pub shift: Vec2,
}

/// The frame as written, and others (rotated, scaled and shifted) in which `f64` leaves the pose
/// singular only to its last digits.
pub const FRAMES: [Frame; 4] = [
    Frame { turn: ["1", "0"], angle: "0 rad", scale: 1.0, shift: Vec2::ZERO },
    Frame { turn: ["0.8", "0.6"], angle: "atan(0.75)", scale: 0.37, shift: Vec2::new(0.3, -1.1) },
    Frame {
        turn: ["(-0.6)", "(-0.8)"],
        angle: "atan(4/3) + 180 deg",
        scale: 3.1e-7,
        shift: Vec2::ZERO,
    },
    Frame {
        turn: ["(5/13)", "(12/13)"],
        angle: "atan(2.4)",
        scale: 4.7e5,
        shift: Vec2::new(-2e5, 7e4),
    },
];

impl Frame {
    /// The frame to another scale, not rotated.
    pub fn scaled(scale: f64) -> Frame {
        Frame { scale, ..FRAMES[0] }
    }

    fn place(&self, x: f64, y: f64) -> [String; 2] {
        let [c, s] = self.turn;
        let of = |u: &str, v: &str, sign: &str, shift: f64| {
            format!("({:?}*({u}*({x:?}) {sign} {v}*({y:?})) + ({shift:?}))*1 m", self.scale)
        };
        [of(c, s, "-", self.shift.x), of(s, c, "+", self.shift.y)]
    }
}

/// A scene by coordinates: links and the rest as text, each point's place before the frame.
pub fn scene_in(f: Frame, links: &str, points: &[(&str, f64, f64)], rest: &str) -> String {
    let places: Vec<String> = points
        .iter()
        .map(|(n, x, y)| {
            let [x, y] = f.place(*x, *y);
            format!(r#""{n}": ["{x}", "{y}"]"#)
        })
        .collect();
    format!(r#"{{"links": {links}, "ground": "0", "points": {{{}}}, {rest}}}"#, places.join(", "))
}

pub const FOUR_BAR: &str =
    r#"{"1": ["A", "B"], "2": ["B", "C"], "3": ["D", "C"], "0": ["A", "D"]}"#;
pub const RATES: &str =
    r#""find": ["omega_1", "omega_2", "omega_3", "alpha_1", "alpha_2", "alpha_3"]"#;

pub fn drive(link: u8, omega: f64, alpha: f64) -> String {
    format!(
        r#""driver": {{"link": "{link}", "omega": "{omega} rad/s", "alpha": "{alpha} rad/s^2"}}"#
    )
}

pub fn run(text: &str) -> Result<(Scene, Worked, Vec<hodograph::diag::Diagnostic>), Faults> {
    let scene = scene::read(text)?.value;
    let done = work(&scene, Scope::Figure)?;
    let Worked { unanswered, results, .. } = &done.value;
    if unanswered.is_empty() {
        return Ok((scene, done.value, done.notes));
    }
    // Reported as such, every question in one list or the other, and the quantities given by the
    // drivers are answered.
    assert_eq!(unanswered.len() + results.len(), scene.find.len(), "{text}");
    for u in unanswered {
        let refused = u.refused().expect("it rests on a part without a motion");
        assert!(done.notes.contains(&refused.diagnostic), "no word of {refused:?}\n{text}");
        let given =
            |d: &scene::Driver| match (d.kind.clone(), scene.find[u.find].what.meaning(&scene)) {
                (DriverKind::Turn { link, against, .. }, Some(Meaning::Turning(l, None))) => {
                    l == link && against == scene.ground
                }
                _ => false,
            };
        assert!(!scene.drivers.iter().any(given), "{} is given\n{text}", scene.find[u.find].text);
    }
    Err(Faults { list: done.notes })
}

pub fn number(v: AnswerValue) -> f64 {
    match v {
        AnswerValue::Scalar(s) => s,
        AnswerValue::Vector(_) | AnswerValue::Point(_) => v.magnitude(),
    }
}

/// The expected result of a scene of the table.
enum Verdict {
    /// Answers to the questions in order; also on the other motion, if there is one.
    Answers(Option<SingularKind>, [f64; 6], Option<[f64; 6]>),
    /// A diagnosis with this code and these words.
    Says(&'static str, &'static [&'static str]),
}

pub fn close(a: f64, b: f64, size: f64) -> bool {
    (a - b).abs() <= 1e-9 * size
}

fn check(what: &str, text: &str, verdict: &Verdict) {
    match (run(text), verdict) {
        (Ok((scene, done, notes)), Verdict::Answers(kind, expected, others)) => {
            assert_eq!(done.solution.singular.first().map(|s| s.kind), *kind, "{what}\n{text}");
            if kind.is_some() {
                assert!(!notes.is_empty(), "{what}: no word of it\n{text}");
            }
            let size = |all: &[f64; 6], i: usize| {
                all[i / 3 * 3..i / 3 * 3 + 3].iter().fold(1e-300f64, |m, v| m.max(v.abs()))
            };
            for (i, o) in done.results.iter().enumerate() {
                let find = &scene.find[o.find].text;
                let got = number(o.value());
                assert!(
                    close(got, expected[i], size(expected, i)),
                    "{what}: {find} is {got:e}, not {:e}\n{text}",
                    expected[i]
                );
                assert!(
                    expected[i] != 0.0 || got == 0.0,
                    "{what}: {find} is {got:e}, not zero\n{text}"
                );
                assert_eq!(o.others.len(), usize::from(others.is_some()), "{what}: {find}\n{text}");
                if let Some(others) = others {
                    let other = number(o.others[0]);
                    assert!(
                        close(other, others[i], size(others, i)),
                        "{what}: on the other motion {find} is {other:e}\n{text}"
                    );
                }
            }
        }
        (Err(f), Verdict::Says(code, words)) => {
            let said = f.to_string();
            assert!(f.list.iter().any(|d| d.code == *code), "{what}: no {code} in {said}\n{text}");
            assert!(
                words.iter().all(|w| said.contains(w)),
                "{what}: not all of {words:?} in {said}\n{text}"
            );
        }
        (Ok((_, done, _)), Verdict::Says(code, _)) => {
            panic!("{what}: no {code} but {:?}\n{text}", done.results)
        }
        (Err(f), Verdict::Answers(..)) => panic!("{what}: {f}\n{text}"),
    }
}

type Four = [(&'static str, f64, f64); 4];

/// Crank 2 and coupler 5 in line, rocker 5 by a 3-4-5 triangle.
const LIMIT: Four = [("A", 0.0, 0.0), ("B", 2.0, 0.0), ("C", 7.0, 0.0), ("D", 4.0, -4.0)];
const PARALLELOGRAM: Four = [("A", 0.0, 0.0), ("B", 1.0, 0.0), ("C", 4.0, 0.0), ("D", 3.0, 0.0)];
const PARALLELOGRAM_180: Four =
    [("A", 0.0, 0.0), ("B", -1.0, 0.0), ("C", 2.0, 0.0), ("D", 3.0, 0.0)];
const RHOMBUS: Four = [("A", 0.0, 0.0), ("B", -1.0, 0.0), ("C", 0.0, 0.0), ("D", 1.0, 0.0)];
const KITE: Four = [("A", 0.0, 0.0), ("B", 1.0, 0.0), ("C", 0.0, 0.0), ("D", 3.0, 0.0)];
const KITE_FOLDED: Four = [("A", 0.0, 0.0), ("B", 1.0, 0.0), ("C", 4.0, 0.0), ("D", 1.0, 0.0)];
const COINCIDENT: Four = [("A", 0.0, 0.0), ("B", 1.0, 0.0), ("C", 1.0, 3.0), ("D", 1.0, 0.0)];
const STRETCHED: Four = [("A", 0.0, 0.0), ("B", 1.0, 0.0), ("C", 3.0, 0.0), ("D", 6.0, 0.0)];

#[test]
fn four_bars_in_line() {
    use SingularKind::{ChangePoint, Limit, Rest};
    use Verdict::{Answers, Says};
    let dead: &[&str] =
        &["link 1 (AB)", "link 2 (BC)", "lie in line at B", "driver link 3", "unbounded"];
    let omega = (1.0f64 / 0.7).sqrt();
    let table: Vec<(&str, Four, u8, f64, f64, Verdict)> = vec![
        // a_C along the line: −2·100·(1 + 2/5) = −280, over the arm perpendicular to it, 4.
        (
            "rocker at its limit",
            LIMIT,
            1,
            10.0,
            0.0,
            Answers(None, [10.0, -4.0, 0.0, 0.0, 42.0, 70.0], None),
        ),
        ("rocker drives in the dead point", LIMIT, 3, 1.0, 0.0, Says("dead-centre", dead)),
        (
            "rocker at rest in the dead point",
            LIMIT,
            3,
            0.0,
            0.0,
            Answers(Some(Rest), [0.0; 6], None),
        ),
        // ω₁ as with the crank driving, where α₃ = 1: 10 √(1/70); ω₂ = −0.4 ω₁. α₁: the rocker's
        // jerk vanishes.
        (
            "rocker turns back at its limit",
            LIMIT,
            3,
            0.0,
            1.0,
            Answers(
                Some(Limit),
                [omega, -0.4 * omega, 0.0, 3.0 / 7.0, 3.0 / 7.0, 1.0],
                Some([-omega, 0.4 * omega, 0.0, 3.0 / 7.0, 3.0 / 7.0, 1.0]),
            ),
        ),
        (
            "rocker driven beyond its limit",
            LIMIT,
            3,
            0.0,
            -1.0,
            Says("locked", &["link 1 (AB)", "link 2 (BC)", "driver link 3"]),
        ),
        (
            "parallelogram",
            PARALLELOGRAM,
            1,
            1.0,
            2.0,
            Answers(
                Some(ChangePoint),
                [1.0, 0.0, 1.0, 2.0, 0.0, 2.0],
                Some([1.0, -1.0, -2.0, 2.0, -2.0, -4.0]),
            ),
        ),
        (
            "parallelogram, the other way in line",
            PARALLELOGRAM_180,
            1,
            -3.0,
            0.0,
            Answers(
                Some(ChangePoint),
                [-3.0, 0.0, -3.0, 0.0, 0.0, 0.0],
                Some([-3.0, -1.5, 1.5, 0.0, 0.0, 0.0]),
            ),
        ),
        (
            "parallelogram from rest",
            PARALLELOGRAM,
            1,
            0.0,
            2.0,
            Answers(
                Some(ChangePoint),
                [0.0, 0.0, 0.0, 2.0, 0.0, 2.0],
                Some([0.0, 0.0, 0.0, 2.0, -2.0, -4.0]),
            ),
        ),
        ("parallelogram at rest", PARALLELOGRAM, 1, 0.0, 0.0, Answers(Some(Rest), [0.0; 6], None)),
        (
            "rhombus folded",
            RHOMBUS,
            1,
            1.0,
            0.0,
            Answers(
                Some(ChangePoint),
                [1.0, 0.0, 1.0, 0.0, 0.0, 0.0],
                Some([1.0, 1.0, 0.0, 0.0, 0.0, 0.0]),
            ),
        ),
        (
            "kite",
            KITE,
            1,
            1.0,
            0.0,
            Answers(
                Some(ChangePoint),
                [1.0, -2.0, -1.0, 0.0, 0.0, 0.0],
                Some([1.0, 1.0, 0.0, 0.0, 0.0, 0.0]),
            ),
        ),
        // In the other motion, coupler and rocker turn as one about B and D while the crank is at
        // rest: impossible with this driver.
        (
            "kite folded",
            KITE_FOLDED,
            1,
            3.0,
            0.0,
            Answers(Some(ChangePoint), [3.0, 1.0, 2.0, 0.0, 0.0, 0.0], None),
        ),
        (
            "kite folded off the line",
            COINCIDENT,
            1,
            1.0,
            0.0,
            Says("dead-centre", &["B and D coincide", "driver link 1"]),
        ),
        (
            "kite folded off the line, at rest",
            COINCIDENT,
            1,
            0.0,
            0.0,
            Says("undetermined", &["link 2 and link 3 can move"]),
        ),
        (
            "stretched",
            STRETCHED,
            1,
            1.0,
            0.0,
            Says("locked", &["link 1 (AB), link 2 (BC) and link 3 (DC) lie in line"]),
        ),
        ("stretched and at rest", STRETCHED, 1, 0.0, 0.0, Answers(Some(Rest), [0.0; 6], None)),
    ];
    for (what, points, link, omega, alpha, verdict) in &table {
        for f in FRAMES {
            let text = scene_in(
                f,
                FOUR_BAR,
                points,
                &format!("{}, {RATES}", drive(*link, *omega, *alpha)),
            );
            check(&format!("{what} in {f:?}"), &text, verdict);
        }
    }
}

/// Four-bars in line by lengths and angles: circles that touch, exactly or to the last digit.
#[test]
fn four_bars_in_line_by_lengths() {
    use SingularKind::ChangePoint;
    use Verdict::{Answers, Says};
    let scene = |ab: f64, bc: f64, cd: f64, ad: f64, rest: &str| {
        format!(
            r#"{{"links": {FOUR_BAR}, "ground": "0", "lengths": {{"AB": "{ab} m", "BC": "{bc} m", "CD": "{cd} m", "AD": "{ad} m"}}, {rest}, {RATES}}}"#
        )
    };
    let two = |o: [f64; 3], p: [f64; 3]| {
        Answers(
            Some(ChangePoint),
            [o[0], o[1], o[2], 0.0, 0.0, 0.0],
            Some([p[0], p[1], p[2], 0.0, 0.0, 0.0]),
        )
    };
    let crank = |angle: &str, rest: &str| {
        format!(r#""driver": {{"link": "1", "angle": "{angle}", "omega": "1 rad/s"}}{rest}"#)
    };
    check(
        "by default",
        &scene(1.0, 3.0, 1.0, 3.0, &crank("0 deg", "")),
        &two([1.0, 0.0, 1.0], [1.0, -1.0, -2.0]),
    );
    let (para, anti) = ([1.0, 0.0, 1.0], [1.0, 0.5, -0.5]);
    let half = |rest: &str| scene(0.1, 0.3, 0.1, 0.3, &crank("180 deg", rest));
    check("by default", &half(""), &two(para, anti));
    // Just after half a turn the parallelogram's C is to the right of BD.
    check("by side", &half(r#", "side": {"C": "right of BD"}"#), &two(para, anti));
    check("by the other side", &half(r#", "side": {"C": "left of BD"}"#), &two(anti, para));
    check("by sketch", &half(r#", "sketch": {"C": ["0.2 m", "-0.05 m"]}"#), &two(para, anti));
    check(
        "by the other sketch",
        &half(r#", "sketch": {"C": ["0.2 m", "0.05 m"]}"#),
        &two(anti, para),
    );
    // Lengths and angle that are singular only up to rounding: 3 cot and the like.
    let rocker = r#""driver": {"link": "3", "angle": "acos((1.1^2 + 0.83^2 - 0.9^2)/(2*1.1*0.83)) * (-1) + 180 deg", "omega": "1 rad/s"}"#;
    let dead = Says("dead-centre", &["link 1 (AB)", "link 2 (BC)"]);
    check("dead point by lengths", &scene(0.3, 0.6, 0.83, 1.1, rocker), &dead);
}

/// Crank equal to the rod: at a quarter turn the rod is perpendicular to the guide, and the slider
/// may move on or stay.
#[test]
fn an_isosceles_slider_crank() {
    for f in FRAMES {
        let rest = format!(
            r#""guides": [{{"pin": "C", "slider": "3", "on": "0", "through": "A", "angle": "{}"}}], {}, "find": ["omega_1", "omega_2", "v_C"]"#,
            f.angle,
            drive(1, 1.0, 0.0)
        );
        let links = r#"{"1": ["A", "B"], "2": ["B", "C"], "0": ["A"]}"#;
        let text = scene_in(f, links, &[("A", 0.0, 0.0), ("B", 0.0, 1.0), ("C", 0.0, 0.0)], &rest);
        let (_, done, _) = run(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
        let values: Vec<f64> = done.results.iter().map(|o| number(o.value())).collect();
        let others: Vec<f64> = done.results.iter().map(|o| number(o.others[0])).collect();
        assert!(
            close(values[1], -1.0, 1.0) && close(values[2], 2.0 * f.scale, f.scale),
            "{values:?}\n{text}"
        );
        assert!(close(others[1], 1.0, 1.0) && others[2] == 0.0, "{others:?}\n{text}");
        assert!(
            done.solution.singular[0]
                .words
                .en
                .contains("link 2 (BC) lies square to the guide of C"),
            "{:?}",
            done.solution.singular
        );
        // Driven by the slider, it is the dead centre of crank and rod.
        let text = text.replace(
            r#""driver": {"link": "1", "omega": "1 rad/s", "alpha": "0 rad/s^2"}"#,
            r#""driver": {"slide": "C", "velocity": "1 m/s"}"#,
        );
        let turned = text.replace("\"find\"", "\"title\": \"\", \"find\"");
        assert!(
            run(&turned).is_ok_and(|r| r.1.results[0].computed.magnitude() > 0.0)
                || run(&turned).is_err(),
            "{turned}"
        );
        let in_line =
            scene_in(f, links, &[("A", 0.0, 0.0), ("B", 1.0, 0.0), ("C", 5.0, 0.0)], &rest)
                .replace(
                    r#""driver": {"link": "1", "omega": "1 rad/s", "alpha": "0 rad/s^2"}"#,
                    r#""driver": {"slide": "C", "velocity": "1 m/s"}"#,
                );
        check(
            "slider drives",
            &in_line,
            &Verdict::Says(
                "dead-centre",
                &["link 1 (AB) and link 2 (BC) lie in line at B", "the drive of C"],
            ),
        );
    }
}

/// A second parallelogram behind the first: each change point keeps its kind, and each may be
/// passed in the other way.
#[test]
fn two_parallelograms_in_line() {
    let links = r#"{"1": ["A", "B"], "2": ["B", "C"], "3": ["D", "C"], "5": ["C", "F"], "6": ["G", "F"], "0": ["A", "D", "G"]}"#;
    let points = [
        ("A", 0.0, 0.0),
        ("B", 1.0, 0.0),
        ("C", 4.0, 0.0),
        ("D", 3.0, 0.0),
        ("F", 6.0, 0.0),
        ("G", 5.0, 0.0),
    ];
    for f in FRAMES {
        let text = scene_in(
            f,
            links,
            &points,
            &format!(
                r#"{}, "find": ["omega_3", "omega_5", "omega_6", "alpha_6"]"#,
                drive(1, 2.0, 3.0)
            ),
        );
        let (_, done, _) = run(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
        let values: Vec<f64> = done.results.iter().map(|o| number(o.value())).collect();
        let expected = [2.0, 0.0, 2.0, 3.0];
        assert!(values.iter().zip(expected).all(|(a, b)| close(*a, b, 3.0)), "{values:?}\n{text}");
        assert_eq!(done.solution.singular.len(), 2);
        // The first, passed in the other way, turns the third link at −2 times the angular
        // velocity; the second then keeps that.
        let first: Vec<f64> = done.results.iter().map(|o| number(o.others[0])).collect();
        assert!(
            close(first[0], -4.0, 4.0) && close(first[2], -4.0, 4.0) && close(first[3], -6.0, 6.0),
            "{first:?}\n{text}"
        );
        let second: Vec<f64> = done.results.iter().map(|o| number(o.others[1])).collect();
        // A, B of the second are D, C: a = 1, b = d = 2, so that ω₅ = 2/(1 − 2) and ω₆ = (1 + 2)/(1
        // − 2) of ω₃.
        assert!(
            close(second[0], 2.0, 2.0)
                && close(second[1], -4.0, 4.0)
                && close(second[2], -6.0, 6.0),
            "{second:?}\n{text}"
        );
    }
}

/// The three legs of a triad's link intersect in one point (5, 0).
#[test]
fn a_triad_whose_legs_meet_in_a_point() {
    let links = r#"{"1": ["O", "A"], "2": ["A", "P"], "3": ["P", "Q", "R"], "4": ["G", "Q"], "5": ["H", "R"], "0": ["O", "G", "H"]}"#;
    let legs = [
        ("A", 4.8, 1.0),
        ("P", 4.0, 5.0),
        ("Q", 7.0, 4.0),
        ("R", 6.0, 7.0),
        ("G", 5.5, 1.0),
        ("H", 5.2, 1.4),
    ];
    let find = r#""find": ["omega_2", "omega_3", "alpha_3"]"#;
    for f in FRAMES {
        let mut points = vec![("O", 3.0, 0.0)];
        points.extend(legs);
        let text = scene_in(f, links, &points, &format!("{}, {find}", drive(1, 1.0, 0.0)));
        check(
            "crank across",
            &text,
            &Verdict::Says(
                "dead-centre",
                &["link 2 (AP)", "link 4 (GQ)", "link 5 (HR)", "driver link 1"],
            ),
        );
        // The crank in line with its leg moves A perpendicular to it: the pose is not a limit, two
        // motions pass through.
        points[0] = ("O", 5.2, -1.0);
        let text = scene_in(f, links, &points, &format!("{}, {find}", drive(1, 1.0, 0.0)));
        match run(&text) {
            Ok((_, done, _)) => {
                assert_eq!(done.solution.singular[0].kind, SingularKind::ChangePoint);
                assert!(
                    done.results.iter().all(|o| number(o.value()).abs() < 100.0),
                    "{:?}",
                    done.results
                );
            }
            Err(e) => assert!(e.list.iter().any(|d| d.code == "locked"), "{e}\n{text}"),
        }
    }
}

/// A singular scene scaled by a power of two: the same digits.
#[test]
fn scaling_by_a_power_of_two_changes_no_digit() {
    let solve = |k: f64| {
        let text = scene_in(
            Frame::scaled(k),
            FOUR_BAR,
            &PARALLELOGRAM,
            &format!(r#"{}, "find": ["omega_3", "alpha_3", "omega_2"]"#, drive(1, 1.3, 0.7)),
        );
        let (_, done, _) = run(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
        done.results.iter().map(|o| (o.value(), o.others.clone())).collect::<Vec<_>>()
    };
    assert_eq!(solve(1.0), solve(libm::ldexp(1.0, -40)));
    assert_eq!(solve(1.0), solve(libm::ldexp(1.0, 40)));
}
