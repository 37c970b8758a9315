//! Questions about cams where double precision has no digits: next to the start of a law, next to
//! an inflection, at a reversal, on a straight flank, at rest.

use crate::OMEGA;
use hodograph::certified::ladder::{AnswerPart, certify};
use hodograph::report::answers;
use hodograph::scene::{Angle, Lang, Scene, read};
use hodograph::sweep::long::LongSweep;
use hodograph::sweep::pieces::gather;
use hodograph::sweep::station::DriverSpan;
use hodograph::sweep::{PlacedScene, StationSteps};
use hodograph::worked::{NoAnswer, Scope, Worked, work};
use serde_json::Value as Json;

/// A follower on a vertical guide, with cam 2 at an angle.
fn translating(offset: &str, cam: &str, profile: &str, angle: &str, find: &str) -> Scene {
    let guide = match cam {
        r#""face": {}"# => {
            r#"{"slider": "3", "on": "1", "angle": "90 deg", "through": "O"}"#.to_owned()
        }
        _ => format!(
            r#"{{"pin": "B", "slider": "3", "on": "1", "through": ["{offset}", 0], "angle": "90 deg"}}"#
        ),
    };
    let three = if cam.contains("face") { "" } else { r#", "3": ["B"]"# };
    let (two, lengths) = if profile.contains('Q') {
        (r#""O", "Q""#, r#""lengths": {"OQ": "28 mm"},"#)
    } else {
        (r#""O""#, "")
    };
    let text = format!(
        r#"{{"links": {{"1": ["O"], "2": [{two}]{three}}}, "ground": "1", "points": {{"O": [0, 0]}}, {lengths} "guides": [{guide}],
        "cams": [{{"cam": "2", "follower": "3", {cam}, "profile": {profile}}}],
        "driver": {{"link": "2", "angle": "{angle}", "omega": "{OMEGA} rad/s"}}, "find": ["{find}"]}}"#
    );
    read(&text).unwrap_or_else(|f| panic!("{f}\n{text}")).value
}

fn law(base: &str, gain: &str, rise: &str, dwell: &str, back: &str) -> String {
    let rest = 360.0 - [rise, dwell, back].map(|x| x.parse::<f64>().unwrap()).iter().sum::<f64>();
    format!(
        r#"{{"base": "{base} mm", "law": [{{"rise": "{gain} mm", "over": "{rise} deg", "law": "3-4-5"}}, {{"dwell": "{dwell} deg"}},
        {{"return": "{gain} mm", "over": "{back} deg", "law": "3-4-5"}}, {{"dwell": "{rest} deg"}}]}}"#
    )
}

const ROLLER: &str = r#""roller": {"pin": "B", "radius": "10 mm"}"#;
const TANGENT: &str = r#"[{"centre": "O", "radius": "20 mm"}, "tangent", {"centre": "Q", "radius": "8 mm"}, "tangent"]"#;

fn worked(scene: &Scene) -> (Worked, Vec<String>) {
    let worked = work(scene, Scope::Questions).unwrap_or_else(|f| panic!("{f}"));
    let codes = worked.notes.iter().map(|d| format!("{}: {}", d.code, d.message.en)).collect();
    (worked.value, codes)
}

/// Reference values by 60-digit arithmetic.
#[test]
fn digits_are_true_where_double_precision_has_none() {
    let asked = law("30", "20", "120", "60", "120");
    for (scene, part, exact) in [
        (
            translating("10 mm", ROLLER, &asked, "0.12 deg", "s_3"),
            AnswerPart::Scalar,
            "1.997001200e-10",
        ),
        (
            translating("10 mm", ROLLER, &asked, "29.84035450934882243 deg", "pressure_3"),
            AnswerPart::Degrees,
            "7.561534953e-11",
        ),
        (
            translating(
                "15 mm",
                r#""roller": {"pin": "B", "radius": "5 mm"}"#,
                TANGENT,
                "60 deg",
                "Phi_3",
            ),
            AnswerPart::Degrees,
            "80.03283637",
        ),
    ] {
        let (worked, _) = worked(&scene);
        let certified = certify(&scene, &worked, 10);
        assert_eq!(
            certified[0].part(part).and_then(|n| n.text(10)).map(|t| t.0).as_deref(),
            Some(exact),
            "{}",
            scene.find[0].text
        );
    }
}

#[test]
fn a_straight_flank_has_an_infinite_radius() {
    let scene = translating(
        "6 mm",
        r#""roller": {"pin": "B", "radius": "5 mm"}"#,
        TANGENT,
        "31.7 deg",
        "rho_2/3",
    );
    let (worked, _) = worked(&scene);
    assert!(
        matches!(worked.unanswered[..], [ref u] if matches!(u.why, NoAnswer::Infinite(_))),
        "{:?}",
        worked.results
    );
    let certified = certify(&scene, &worked, 6);
    let text = |lang| answers::text(&scene, &worked, &certified, 6, lang);
    assert!(
        text(Lang::En).contains("rho_2/3 = ∞ (the profile of cam 2 is straight there)"),
        "{}",
        text(Lang::En)
    );
    assert!(
        text(Lang::Zh).contains("rho_2/3 = ∞（") || text(Lang::Zh).contains("rho_2/3 = ∞ ("),
        "{}",
        text(Lang::Zh)
    );
    let json = answers::json(&scene, &worked, &certified, 6, &[]);
    let answer = &json["answers"][0];
    assert_eq!((&answer["value"], &answer["unbounded"]), (&Json::Null, &Json::Bool(true)));
    assert_eq!(answer["why"]["code"], "infinite");
}

/// In a sweep no row is missing, as in a single pose; a note gives the range of infinite radius.
#[test]
fn a_sweep_has_rows_on_a_straight_flank() {
    let at = |angle: f64, find| {
        translating(
            "6 mm",
            r#""roller": {"pin": "B", "radius": "5 mm"}"#,
            TANGENT,
            &format!("{angle:?} deg"),
            find,
        )
    };
    let swept = at(0.0, "rho_2/3").over_a_turn();
    let mechanism = hodograph::sweep::mechanism(&swept).unwrap();
    let placed = PlacedScene::new(&swept, &mechanism).unwrap();
    let steps =
        StationSteps { way: DriverSpan::Turn(Angle::Deg(0.5), Angle::Deg(360.5)), steps: 60 };
    let table = gather(&mut LongSweep::new(&placed, 0, steps).unwrap());
    let rho = &table.column("rho_2/3").unwrap().values;
    assert_eq!(rho.len(), 61, "{:?}", table.notes);
    let mut straight = 0;
    for (k, rho) in rho.iter().enumerate() {
        let (single, _) = worked(&at(0.5 + 6.0 * k as f64, "rho_2/3"));
        match (&single.unanswered[..], &single.results[..]) {
            ([none], []) => {
                assert!(
                    matches!(none.why, NoAnswer::Infinite(_)) && *rho == f64::INFINITY,
                    "row {k}: {rho}"
                );
                straight += 1;
            }
            ([], [one]) => assert!(
                (one.value().magnitude() - rho).abs() < 1e-12,
                "row {k}: {rho}, not {:?}",
                one.value()
            ),
            other => panic!("row {k}: {other:?}"),
        }
    }
    let notes: Vec<&str> = table
        .notes
        .iter()
        .filter(|d| d.code == "infinite")
        .map(|d| d.message.en.as_str())
        .collect();
    assert!(
        straight > 4
            && notes.len() == 2
            && notes.iter().all(|n| n.starts_with("rho_2/3 is infinite from phi_2 = ")),
        "{notes:?}"
    );
    assert!(table.notes.iter().all(|d| d.code != "no-position"), "{:?}", table.notes);
}

/// If ρ changes sign, the least radius is negative, and a warning gives the place.
#[test]
fn an_undercut_profile_is_said_to_be_one() {
    for (base, undercut) in [("20", true), ("30", false)] {
        let scene = translating(
            "0 mm",
            r#""face": {}"#,
            &law(base, "25", "100", "80", "100"),
            "40 deg",
            "rho_min_2",
        );
        let (worked, notes) = worked(&scene);
        let certified = certify(&scene, &worked, 8);
        let text = certified[0].part(AnswerPart::Scalar).and_then(|n| n.text(8)).unwrap().0;
        // r + s + s″ is least where s′ + s‴ is zero, at φ = 77.497 928°.
        assert_eq!(text, if undercut { "-0.0041993171" } else { "0.0058006829" });
        let said = notes.iter().any(|n| n.starts_with("undercut") && n.contains("φ = 77.4979°"));
        assert_eq!(said, undercut, "{notes:?}");
    }
}

/// A follower at rest has a lift and a velocity of zero, in every form of the input.
#[test]
fn what_is_zero_is_printed_as_zero() {
    for kind in ["law harmonic", "law 3-4-5", "tangent", "rocker", "hollow"] {
        let scene = crate::scene(kind, "200 deg");
        for cam in &scene.cams {
            let t = cam.disc.as_ref().unwrap();
            let survey = t.survey.of(&t.disc);
            let rest = survey.phases.iter().find(|p| p.way == 0 && !p.out).unwrap();
            for k in 1..20 {
                let phi = rest.from + (rest.to - rest.from) * f64::from(k) / 20.0;
                let lift = survey.lift(&t.disc, phi, t.side).unwrap();
                assert_eq!(lift[..3], [0.0; 3], "{kind} at {phi}");
            }
        }
    }
    // A press at its limit, with rounded lengths: the velocity is a rounding residue and is
    // reported as such.
    let scene = read(include_str!("press-at-its-limit.json")).unwrap().value;
    let (worked, _) = worked(&scene);
    let certified = certify(&scene, &worked, 6);
    let text = answers::text(&scene, &worked, &certified, 6, Lang::En);
    let line =
        |name: &str| text.lines().find(|l| l.trim_start().starts_with(name)).unwrap().to_owned();
    for name in ["v_F", "omega_3"] {
        assert!(line(name).contains("= 0 ") && !line(name).contains("e-"), "{text}");
    }
}
