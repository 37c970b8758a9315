//! Wrong solutions: the number of each wrong equation is recalculated here, from the formulas of
//! the wrong equation.

use hodograph::answer::AnswerValue;
use hodograph::attempts::{Attempt, sites, wanted};
use hodograph::certified::certify;
use hodograph::composite::{ChoicePlace, ContactScene};
use hodograph::mechanism::Level;
use hodograph::notation::Notation;
use hodograph::report::attempts::{AttemptWords, text};
use hodograph::scene::quantity::composite::CompositePart;
use hodograph::scene::{self, Lang, Mistake, PointId, templates};
use hodograph::worked::{Scope, Worked, work};
use std::collections::BTreeSet;

fn worked(text: &str) -> (scene::Scene, Worked) {
    let scene = scene::read(text).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
    let worked = work(&scene, Scope::Figure).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
    (scene, worked)
}

fn all(name: &str) -> (scene::Scene, Worked, Vec<Attempt>) {
    let (scene, worked) = worked(templates::get(name).unwrap());
    let all = wanted(&scene, &worked, true).unwrap_or_else(|f| panic!("{name}: {f:?}"));
    (scene, worked, all)
}

fn answer(scene: &scene::Scene, worked: &Worked, a: &Attempt, find: &str) -> [AnswerValue; 2] {
    let row = a
        .rows
        .iter()
        .find(|r| scene.find[worked.results[r.result].find].text == find)
        .unwrap_or_else(|| panic!("{find} is not changed"));
    [worked.results[row.result].value(), row.wrong.unwrap()]
}

fn scalar(v: AnswerValue) -> f64 {
    match v {
        AnswerValue::Scalar(s) => s,
        other => panic!("{other:?} is no scalar"),
    }
}

/// a_E3 = a_E2 + 2ω₂ × v_E3E2 + aʳ with aʳ along the face: along the normal only the known parts
/// remain.
#[test]
fn printed_flat_face_comes_from_its_equation() {
    for (name, [ax, ay], omega, truth, lacks) in [
        ("flat-face-mistake", [-0.02, 0.0], 10.0, 25.6600119639834, 16.0 / 3.0),
        ("flat-face-mistake-2", [0.01, -0.02 * 3_f64.sqrt() / 2.0], -10.0, 0.0, 4.0),
    ] {
        let (scene, worked, all) = all(name);
        let a =
            all.iter().find(|a| a.site.mistake() == Mistake::ContactPoint).expect("it is named");
        let [right, wrong] = answer(&scene, &worked, a, "alpha_3").map(scalar);
        // B is the origin, C is 60 mm to the right, E is on the rim at 60 degrees.
        let (e, c) = ([0.015, 0.03 * 3_f64.sqrt() / 2.0], [0.06, 0.0]);
        let n = [0.5, 3_f64.sqrt() / 2.0];
        let dot = |p: [f64; 2], q: [f64; 2]| p[0] * q[0] + p[1] * q[1];
        let from = |p: [f64; 2], q: [f64; 2]| [p[0] - q[0], p[1] - q[1]];
        let turned = |w: f64, p: [f64; 2]| [-w * p[1], w * p[0]];
        let (ae, ce) = (from(e, [ax, ay]), from(e, c));
        // The normal components of the velocities are equal.
        let omega3 = dot(turned(omega, ae), n) / dot(turned(1.0, ce), n);
        let slide = from(turned(omega3, ce), turned(omega, ae));
        let coriolis = turned(2.0 * omega, slide);
        let known =
            dot([-omega * omega * ae[0] + coriolis[0], -omega * omega * ae[1] + coriolis[1]], n);
        let normal = dot([-omega3 * omega3 * ce[0], -omega3 * omega3 * ce[1]], n);
        let alpha = (known - normal) / dot(turned(1.0, ce), n);
        assert!(
            (wrong - alpha).abs() < 1e-9 && (wrong + 76.98003589195).abs() < 1e-8,
            "{name}: {wrong} against {alpha}"
        );
        assert!((right - truth).abs() < 1e-9, "{name}: {right}");
        assert!((a.gap.vector.norm() - lacks).abs() < 1e-9, "{name}: {}", a.gap.vector.norm());
    }
}

/// Without the normal part, the acceleration of a crank-rocker's pin is a linear equation in two
/// unknowns.
#[test]
fn a_rocker_without_its_normal_part() {
    let (scene, worked, all) = all("crank-rocker");
    let link = scene.links.iter().position(|l| l.name == "3").unwrap();
    let a = all
        .iter()
        .find(|a| a.site.mistake() == Mistake::NoNormal && a.site.link(&scene).unwrap().0 == link)
        .unwrap();
    let place = |n: &str| {
        worked.configuration.points[scene.points.iter().position(|p| p.name == n).unwrap()].unwrap()
    };
    let (b, c, d) = (place("B"), place("C"), place("D"));
    let rate = |n: &str| {
        let find = scene.find.iter().position(|f| f.text == n).unwrap();
        scalar(worked.results.iter().find(|r| r.find == find).unwrap().value())
    };
    let omega1 = scene.drivers[0].rate.value;
    let (w2, a_b) = (rate("omega_2"), (b - place("A")) * -(omega1 * omega1));
    // α₃ perp(DC) = a_B − ω₂² BC + α₂ perp(BC): crossed with perp(BC).
    let (bc, dc) = (c - b, c - d);
    let known = a_b - bc * (w2 * w2);
    let alpha3 = known.cross(bc.perp()) / dc.perp().cross(bc.perp());
    let [_, wrong] = answer(&scene, &worked, a, "alpha_3").map(scalar);
    assert!((wrong - alpha3).abs() < 1e-9 * alpha3.abs(), "{wrong} against {alpha3}");
}

/// With the wrong angular velocity, the Coriolis part is larger by the ratio of the two angular
/// velocities.
#[test]
fn coriolis_by_the_wrong_link() {
    let (scene, worked, all) = all("whitworth");
    let of = |m: Mistake| all.iter().find(|a| a.site.mistake() == m).unwrap();
    let find = scene.find.iter().position(|f| f.text == "omega_3").unwrap();
    let omega3 = scalar(worked.results.iter().find(|r| r.find == find).unwrap().value());
    let omega1 = scene.drivers[0].rate.value;
    let gaps = [Mistake::NoCoriolis, Mistake::CoriolisWrongOmega].map(|m| of(m).gap.vector);
    // The missing terms are −2ω₃×v and 2(ω₁−ω₃)×v.
    let expected = gaps[0] * -((omega1 - omega3) / omega3);
    assert!(
        (gaps[1] - expected).norm() < 1e-9 * expected.norm(),
        "{:?} against {expected:?}",
        gaps[1]
    );
}

/// Every known mistake is possible in some template, is drawn from one pole to one scale, and
/// differs from the right solution.
#[test]
fn every_mistake_is_there() {
    let mut met = BTreeSet::new();
    for t in templates::list() {
        let (scene, worked) = worked(templates::get(t.name).unwrap());
        let offered = sites(&scene, &worked).len();
        let all = wanted(&scene, &worked, true).unwrap_or_else(|f| panic!("{}: {f:?}", t.name));
        assert!(all.len() <= offered, "{}", t.name);
        for a in &all {
            let told = format!("{} {:?}", t.name, a.site);
            met.insert(a.site.mistake());
            let mu = |s: &hodograph::attempts::AttemptScene| {
                s.worked.construction.polygon(a.gap.on).unwrap().mu
            };
            assert_eq!(mu(&a.right).to_bits(), mu(&a.wrong).to_bits(), "{told}");
            assert!(!a.rows.is_empty() && a.gap.vector.norm() > 0.0, "{told}");
            let why = a.site.why(&scene);
            assert!(!why.en.is_empty() && !why.zh.is_empty(), "{told}");
        }
    }
    assert_eq!(met.into_iter().collect::<Vec<_>>(), Mistake::ALL.to_vec());
}

/// A text without frames says what its brackets mean.
#[test]
fn brackets_of_a_text_are_explained() {
    let (scene, worked, all) = all("shaper");
    let notation = Notation::of_language(Lang::En);
    let certified = certify(&scene, &worked, 6);
    let words = AttemptWords {
        scene: &scene,
        worked: &worked,
        certified: &certified,
        notation: &notation,
        digits: 6,
        lang: Lang::En,
    };
    let said = text(&words, &all);
    let equation = "    a_A3^n + a_A3^t = a_A2 + [a_A3A2^c] + a_A3A2^rel\n";
    assert!(said.contains(&format!("{equation}    in brackets: often left out\n")), "{said}");
    assert!(!said.contains("framed"), "{said}");
}

#[test]
fn a_mistake_that_cannot_be_made_is_refused() {
    let text = templates::get("crank-rocker").unwrap();
    let with = |attempt: &str| {
        text.trim_end().trim_end_matches('}').to_owned() + &format!(", \"attempts\": [{attempt}]}}")
    };
    let (scene, right) = worked(&with("{\"mistake\": \"no-coriolis\"}"));
    let faults = wanted(&scene, &right, false).unwrap_err();
    assert!(
        faults.list.len() == 1 && faults.list[0].code == "attempt" && faults.list[0].span.is_some(),
        "{faults:?}"
    );
    let (scene, right) = worked(&with("{\"mistake\": \"no-normal\"}"));
    assert!(wanted(&scene, &right, false).is_err(), "two links offer it");
    let (scene, right) = worked(&with("{\"mistake\": \"no-normal\", \"link\": \"2\"}"));
    assert_eq!(wanted(&scene, &right, false).unwrap().len(), 1);
    for wrong in [
        "{\"mistake\": \"no-corolis\"}",
        "{\"mistake\": \"no-normal\", \"printed\": {\"alpha_3\": \"5 m\"}}",
        "{\"pair\": \"B\"}",
    ] {
        let faults = scene::read(with(wrong)).unwrap_err();
        assert!(faults.list.iter().all(|d| d.span.is_some()), "{faults}");
    }
}

/// a_E2 = a_E3 + 2ω₃ × v_E2E3 + aʳ with aʳ along the face: the other printed equation, for E of the
/// disc, which slides on the face.
#[test]
fn the_contact_of_the_disc_seen_from_the_face() {
    let text = templates::get("flat-face-mistake")
        .unwrap()
        .replace(r#""mistake": "contact-point", "#, r#""mistake": "contact-point", "link": "3", "#);
    let (scene, worked) = worked(&text);
    let all = wanted(&scene, &worked, false).unwrap();
    let [_, wrong] = answer(&scene, &worked, &all[0], "alpha_3").map(scalar);
    // A is the origin; E is at 60 degrees on the rim about B, C is 80 mm to the right; the normal
    // points out of the disc.
    let (e, c, n) = ([0.035, 0.03 * 3_f64.sqrt() / 2.0], [0.08, 0.0], [0.5, 3_f64.sqrt() / 2.0]);
    let dot = |p: [f64; 2], q: [f64; 2]| p[0] * q[0] + p[1] * q[1];
    let ce = [e[0] - c[0], e[1] - c[1]];
    let turned = |w: f64, p: [f64; 2]| [-w * p[1], w * p[0]];
    let omega3 = dot(turned(10.0, e), n) / dot(turned(1.0, ce), n);
    let slide = [0, 1].map(|i| turned(10.0, e)[i] - turned(omega3, ce)[i]);
    let known = dot([-100.0 * e[0], -100.0 * e[1]], n) - dot(turned(2.0 * omega3, slide), n);
    let alpha = (known + omega3 * omega3 * dot(ce, n)) / dot(turned(1.0, ce), n);
    assert!(
        (wrong - alpha).abs() < 1e-9 && (alpha - 128.3).abs() < 0.01,
        "{wrong} against {alpha}"
    );
}

/// The point of contact may be asked for together with a wrong equation: its motion is then that of
/// the wrong equation.
#[test]
fn the_contact_may_be_asked_for_in_every_attempt() {
    let rocker = templates::get("flat-face-mistake").unwrap();
    let alphas = |asked: &[&str]| -> Vec<(f64, f64, Option<[f64; 2]>)> {
        let text = scene::edit::with_find(rocker, asked).unwrap();
        let (scene, worked) = worked(&text);
        let all = wanted(&scene, &worked, true).unwrap();
        let row = |a: &Attempt, find: &str| {
            a.rows.iter().any(|r| scene.find[worked.results[r.result].find].text == find)
        };
        let of = |a: &Attempt| {
            let [right, wrong] = answer(&scene, &worked, a, "alpha_3").map(scalar);
            let contact = row(a, "a_E3").then(|| {
                let [_, AnswerValue::Vector(wrong)] = answer(&scene, &worked, a, "a_E3") else {
                    panic!("a_E3 is no vector")
                };
                [wrong.x, wrong.y]
            });
            (right, wrong, contact)
        };
        all.iter().filter(|a| row(a, "alpha_3")).map(of).collect()
    };
    let alone = alphas(&["alpha_3"]);
    assert!(alone.len() >= 3, "{alone:?}");
    for asked in ["v_E3", "a_E3", "v_E2", "a_E2", "x_E", "vr_E3E2"] {
        let beside = alphas(&["alpha_3", asked]);
        assert_eq!(beside.len(), alone.len(), "{asked}");
        for ((right, wrong, contact), (_, before, _)) in beside.into_iter().zip(&alone) {
            assert!((wrong - before).abs() < 1e-9, "{asked}: {wrong} against {before}");
            // E of the rocker moves on a circle about C: its part perpendicular to CE is α₃ CE,
            // right or wrong.
            let [x, y] = [0.035 - 0.08, 0.03 * 3_f64.sqrt() / 2.0];
            if let Some([ax, ay]) = contact {
                let told = (x * ay - y * ax) / (x * x + y * y);
                assert!(
                    (told - wrong).abs() < 1e-9 && (told - right).abs() > 1.0,
                    "{asked}: {told}, {wrong}, {right}"
                );
            }
            assert_eq!(contact.is_some(), asked == "a_E3", "{asked}");
        }
    }
}

/// a_M = aⁿ_MN + aᵗ_MN with the right ω and α, as if N had no acceleration.
#[test]
fn the_rolling_point_as_base_of_another() {
    let text = r#"{"links": {"1": ["O"], "2": ["O", "A"], "3": ["A", "B"], "4": ["B", "M"]}, "ground": "1",
        "points": {"O": ["-0.6 m", "0.15 m"], "A": ["-0.6 m+0.2 m*cos(70 deg)", "0.15 m+0.2 m*sin(70 deg)"], "B": ["0.1427 m", "0.15 m"], "M": ["0.0463 m", "0.2649 m"]},
        "rolling": [{"wheel": "4", "centre": "B", "radius": "0.15 m", "through": [0, 0], "angle": "0 deg", "at": "N"}],
        "driver": {"link": "2", "omega": "3 rad/s"}, "find": ["a_M", "omega_4", "alpha_4"], "attempts": [{"mistake": "rolling-point-a-zero", "pair": "M"}]}"#;
    let (scene, worked) = worked(text);
    let all = wanted(&scene, &worked, false).unwrap();
    let of = |k: usize| scalar(worked.results.iter().find(|r| r.find == k).unwrap().value());
    let (omega, alpha, arm) = (of(1), of(2), [0.0463 - 0.1427, 0.2649]);
    let [_, wrong] = answer(&scene, &worked, &all[0], "a_M");
    let AnswerValue::Vector(wrong) = wrong else { panic!("{wrong:?} is no vector") };
    let expected =
        [-omega * omega * arm[0] - alpha * arm[1], -omega * omega * arm[1] + alpha * arm[0]];
    assert!(
        (wrong.x - expected[0]).hypot(wrong.y - expected[1]) < 1e-9,
        "{wrong:?} against {expected:?}"
    );
}

/// The flat face solved in three ways: the centre of the disc on the bar, the contact on the disc,
/// the contact in axes that translate with the centre. Each equation, projected on the normal with
/// its known parts, gives one α.
#[test]
fn three_right_ways_agree() {
    for (name, alpha) in [("flat-face-mistake", 25.6600119639834), ("flat-face-mistake-2", 0.0)] {
        let scene = scene::read(templates::get(name).unwrap()).unwrap().value;
        let staged = ContactScene::new(&scene);
        let shown = staged.shown(&scene, 3);
        assert_eq!(shown.len(), 3, "{name}");
        let (worked, each) = staged.solved(&shown, Level::Acceleration).unwrap().value;
        let place = |p: PointId| worked.configuration.points[p.0].unwrap();
        let named =
            |n: &str| place(PointId(staged.scene.points.iter().position(|p| p.name == n).unwrap()));
        let (b, c, e) = (named("B"), named("C"), named("E"));
        let normal = (e - b).unit().unwrap();
        for s in &each {
            let told = s.turning.unwrap();
            assert!(
                (told.alpha.unwrap() - alpha).abs() < 1e-9,
                "{name}: {:?} gives {:?}",
                s.choice,
                told.alpha
            );
            let part = |p: CompositePart| {
                s.acceleration
                    .iter()
                    .find(|(q, _)| *q == Some(p))
                    .map_or(0.0, |(_, v)| v.dot(normal))
            };
            let (transport, coriolis) = (
                part(CompositePart::TransportNormal) + part(CompositePart::TransportTangential),
                part(CompositePart::Coriolis),
            );
            let arm = if s.slip.is_some() { e - c } else { b - c };
            let (square, turned) =
                (-(arm * (told.omega * told.omega)).dot(normal), arm.perp().dot(normal));
            let alone = match s.slip {
                // a_E3 = a_e + a_k + a_rⁿ: only the parts of E3 are unknown.
                Some(slip) => (transport + coriolis + slip.acceleration() - square) / turned,
                // a_B = a_eⁿ + a_eᵗ + a_k, a_r along the face: only the parts of the bar's point
                // are unknown.
                None => (s.acceleration[0].1.dot(normal) - coriolis - square) / turned,
            };
            assert!((alone - alpha).abs() < 1e-9, "{name}: {:?} by itself gives {alone}", s.choice);
        }
    }
}

/// At any contact the relative acceleration along the normal follows from the velocities: flat
/// faces and round ends, seen from the cam, from the follower, and from axes with the centre.
#[test]
fn relative_accelerations_at_contacts_follow_from_the_velocities() {
    let flat = |k: i32| {
        format!(
            r#"{{"links": {{"1": ["A", "C"], "2": ["A", "B"], "3": ["C", "F"]}}, "ground": "1", "points": {{"A": [0, 0], "C": ["90 mm", "10 mm"]}},
            "lengths": {{"AB": "20 mm", "CF": "100 mm"}}, "sketch": {{"F": [-7, 50]}},
            "cams": [{{"cam": "2", "follower": "3", "face": {{"through": "C", "line": "CF", "cam": "left"}}, "profile": {{"centre": "B", "radius": "30 mm"}}, "at": "E"}}],
            "driver": {{"link": "2", "angle": "{} deg", "omega": "7 rad/s", "alpha": "-11 rad/s^2"}}, "find": ["alpha_3"]}}"#,
            37 * k
        )
    };
    let round = |k: i32| {
        format!(
            r#"{{"links": {{"1": ["O"], "2": ["O", "C"], "3": ["K"]}}, "ground": "1", "points": {{"O": [0, 0]}}, "lengths": {{"OC": "15 mm"}},
            "guides": [{{"pin": "K", "slider": "3", "on": "1", "through": ["5 mm", 0], "angle": "80 deg"}}], "sketch": {{"K": [5, 60]}},
            "cams": [{{"cam": "2", "follower": "3", "arc": {{"pin": "K", "radius": "25 mm"}}, "profile": {{"centre": "C", "radius": "40 mm"}}}}],
            "driver": {{"link": "2", "angle": "{} deg", "omega": "-9 rad/s", "alpha": "4 rad/s^2"}}, "find": ["a_K"]}}"#,
            41 * k
        )
    };
    for text in (0..9).flat_map(|k| [flat(k), round(k)]) {
        let scene = scene::read(&text).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
        let staged = ContactScene::new(&scene);
        let contacts: Vec<_> = staged
            .choices(&scene)
            .into_iter()
            .filter(|c| matches!(c.place, ChoicePlace::Cam(_)))
            .collect();
        assert_eq!(contacts.len(), 3, "{text}");
        let (_, each) = staged.solved(&contacts, Level::Acceleration).unwrap().value;
        assert_eq!(each.len(), 3, "{text}");
        for s in &each {
            let slip = s.slip.expect("it is a contact");
            let part = |p: CompositePart| {
                s.acceleration.iter().find(|(q, _)| *q == Some(p)).map(|(_, v)| *v)
            };
            let real = part(CompositePart::RelativeNormal).unwrap().dot(slip.normal);
            let size = s.acceleration.iter().map(|a| a.1.norm()).fold(0.0, f64::max);
            assert!(
                (real - slip.acceleration()).abs() < 1e-9 * size,
                "{text}\n{:?}: {real} against {}",
                s.choice,
                slip.acceleration()
            );
            assert!(
                s.velocity[2].dot(slip.normal).abs()
                    < 1e-9 * s.velocity[0].norm().max(s.velocity[1].norm()),
                "{text}: v_r leaves the tangent"
            );
        }
    }
}
