//! Wrong solutions: the number of each wrong equation is reckoned here by another way, from the formulas of the wrong equation written out.

use hodograph::answer::Value;
use hodograph::attempts::{Attempt, sites, wanted};
use hodograph::scene::{self, Mistake, templates};
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

fn answer(scene: &scene::Scene, worked: &Worked, a: &Attempt, find: &str) -> [Value; 2] {
    let row =
        a.rows.iter().find(|r| scene.find[worked.results[r.result].find].text == find).unwrap_or_else(|| panic!("{find} is not changed"));
    [worked.results[row.result].value(), row.wrong.unwrap()]
}

fn scalar(v: Value) -> f64 {
    match v {
        Value::Scalar(s) => s,
        other => panic!("{other:?} is no scalar"),
    }
}

/// a_E3 = a_E2 + 2ω₂ × v_E3E2 + aʳ with aʳ along the face: on the normal only the known parts are left.
#[test]
fn printed_flat_face_comes_from_its_equation() {
    for (name, [ax, ay], omega, truth, lacks) in [
        ("flat-face-mistake", [-0.02, 0.0], 10.0, 25.6600119639834, 16.0 / 3.0),
        ("flat-face-mistake-2", [0.01, -0.02 * 3_f64.sqrt() / 2.0], -10.0, 0.0, 4.0),
    ] {
        let (scene, worked, all) = all(name);
        let a = all.iter().find(|a| a.site.mistake() == Mistake::ContactPoint).expect("it is named");
        let [right, wrong] = answer(&scene, &worked, a, "alpha_3").map(scalar);
        // B in the origin, C 60 mm to the right, E on the rim under 60 degrees.
        let (e, c) = ([0.015, 0.03 * 3_f64.sqrt() / 2.0], [0.06, 0.0]);
        let n = [0.5, 3_f64.sqrt() / 2.0];
        let dot = |p: [f64; 2], q: [f64; 2]| p[0] * q[0] + p[1] * q[1];
        let from = |p: [f64; 2], q: [f64; 2]| [p[0] - q[0], p[1] - q[1]];
        let turned = |w: f64, p: [f64; 2]| [-w * p[1], w * p[0]];
        let (ae, ce) = (from(e, [ax, ay]), from(e, c));
        // Velocities agree along the normal.
        let omega3 = dot(turned(omega, ae), n) / dot(turned(1.0, ce), n);
        let slide = from(turned(omega3, ce), turned(omega, ae));
        let coriolis = turned(2.0 * omega, slide);
        let known = dot([-omega * omega * ae[0] + coriolis[0], -omega * omega * ae[1] + coriolis[1]], n);
        let normal = dot([-omega3 * omega3 * ce[0], -omega3 * omega3 * ce[1]], n);
        let alpha = (known - normal) / dot(turned(1.0, ce), n);
        assert!((wrong - alpha).abs() < 1e-9 && (wrong + 76.98003589195).abs() < 1e-8, "{name}: {wrong} against {alpha}");
        assert!((right - truth).abs() < 1e-9, "{name}: {right}");
        assert!((a.gap.vector.norm() - lacks).abs() < 1e-9, "{name}: {}", a.gap.vector.norm());
    }
}

/// Without its normal part the acceleration of a crank-rocker's pin is a linear equation of two unknowns.
#[test]
fn a_rocker_without_its_normal_part() {
    let (scene, worked, all) = all("crank-rocker");
    let link = scene.links.iter().position(|l| l.name == "3").unwrap();
    let a = all.iter().find(|a| a.site.mistake() == Mistake::NoNormal && a.site.link(&scene).unwrap().0 == link).unwrap();
    let place = |n: &str| worked.configuration.points[scene.points.iter().position(|p| p.name == n).unwrap()].unwrap();
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

/// With the wrong angular velocity the Coriolis part is longer by the ratio of the two.
#[test]
fn coriolis_by_the_wrong_link() {
    let (scene, worked, all) = all("whitworth");
    let of = |m: Mistake| all.iter().find(|a| a.site.mistake() == m).unwrap();
    let find = scene.find.iter().position(|f| f.text == "omega_3").unwrap();
    let omega3 = scalar(worked.results.iter().find(|r| r.find == find).unwrap().value());
    let omega1 = scene.drivers[0].rate.value;
    let gaps = [Mistake::NoCoriolis, Mistake::CoriolisWrongOmega].map(|m| of(m).gap.vector);
    // The gaps are −2ω₃×v and 2(ω₁−ω₃)×v.
    let expected = gaps[0] * -((omega1 - omega3) / omega3);
    assert!((gaps[1] - expected).norm() < 1e-9 * expected.norm(), "{:?} against {expected:?}", gaps[1]);
}

/// Every known mistake can be made in some template, is drawn at one pole to one scale, and differs from the right solution.
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
            let mu = |s: &hodograph::attempts::Stage| s.worked.construction.polygon(a.gap.level).unwrap().mu;
            assert_eq!(mu(&a.right).to_bits(), mu(&a.wrong).to_bits(), "{told}");
            assert!(!a.rows.is_empty() && a.gap.vector.norm() > 0.0, "{told}");
            let why = a.site.why(&scene);
            assert!(!why.en.is_empty() && !why.zh.is_empty(), "{told}");
        }
    }
    assert_eq!(met.into_iter().collect::<Vec<_>>(), Mistake::ALL.to_vec());
}

#[test]
fn a_mistake_that_cannot_be_made_is_refused() {
    let text = templates::get("crank-rocker").unwrap();
    let with = |attempt: &str| text.trim_end().trim_end_matches('}').to_owned() + &format!(", \"attempts\": [{attempt}]}}");
    let (scene, right) = worked(&with("{\"mistake\": \"no-coriolis\"}"));
    let faults = wanted(&scene, &right, false).unwrap_err();
    assert!(faults.list.len() == 1 && faults.list[0].code == "attempt" && faults.list[0].span.is_some(), "{faults:?}");
    let (scene, right) = worked(&with("{\"mistake\": \"no-normal\"}"));
    assert!(wanted(&scene, &right, false).is_err(), "two links offer it");
    let (scene, right) = worked(&with("{\"mistake\": \"no-normal\", \"link\": \"2\"}"));
    assert_eq!(wanted(&scene, &right, false).unwrap().len(), 1);
    for wrong in ["{\"mistake\": \"no-corolis\"}", "{\"mistake\": \"no-normal\", \"printed\": {\"alpha_3\": \"5 m\"}}", "{\"pair\": \"B\"}"]
    {
        let faults = scene::read(with(wrong)).unwrap_err();
        assert!(faults.list.iter().all(|d| d.span.is_some()), "{faults}");
    }
}
