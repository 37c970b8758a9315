//! Every printed digit is true: the ladder's output compared with differences of positions in
//! 640-bit arithmetic.

use crate::emit::{Ask, Pose, scene as emitted};
use crate::properties::{mechanism, seeds, style};
use crate::rng::Rng;
use crate::step_numbers::told;
use crate::wide::every;
use hodograph::answer::AnswerValue;
use hodograph::certified::ladder::{AnswerPart, certify, parts};
use hodograph::certified::steps;
use hodograph::effort::truth;
use hodograph::number::{Ball, Big, Real, within};
use hodograph::scene::{Asked, Kind, Scene, driver_position, read, templates, with_driver_at};
use hodograph::sweep::extreme::ends;
use hodograph::worked::{Scope, Worked, work};

/// Counts of the comparison.
#[derive(Default)]
struct Tally {
    scenes: usize,
    printed: usize,
    /// Numbers among these from the steps of the construction.
    told: usize,
    /// Numbers printed with fewer digits than requested.
    short: usize,
    wrong: Vec<String>,
    by_rung: std::collections::BTreeMap<String, usize>,
    /// Numbers that plain `f64` would have printed wrong.
    plain: usize,
}

const DIGITS: [usize; 3] = [4, 6, 12];

impl Tally {
    fn check(&mut self, name: &str, scene: &Scene) {
        let Ok(worked) = work(scene, Scope::Questions) else { return };
        let worked = worked.value;
        let printed = DIGITS.map(|d| certify(scene, &worked, d));
        within(truth::BITS, || {
            let Ok(truth) = truth::answers(scene, &worked) else { return };
            self.scenes += 1;
            self.steps(name, scene, &worked);
            for (i, (r, t)) in worked.results.iter().zip(truth).enumerate() {
                let find = &scene.find[r.find];
                // Differences of positions give no force.
                if matches!(find.what, Asked::Force(_)) {
                    continue;
                }
                let Some(t) = t else {
                    self.wrong.push(format!("{name}: {} has no true value", find.text));
                    continue;
                };
                let ball = |x: Big| Ball::new(x, 1e-60 * r.scale);
                let t = t.map(ball);
                for (digits, printed) in DIGITS.iter().zip(&printed) {
                    let Ok(expected) = parts(find.what.kind(), t, r.scale, *digits) else {
                        continue;
                    };
                    let c = &printed[i];
                    *self.by_rung.entry(c.rung.name()).or_default() += c.parts.len();
                    for (part, n) in &c.parts {
                        let Some((text, certain)) = n.text(*digits) else {
                            self.short += 1;
                            continue;
                        };
                        let Some((_, e)) = expected.iter().find(|(p, _)| p == part) else {
                            self.wrong.push(format!("{name}: {} has no {}", find.text, part.key()));
                            continue;
                        };
                        self.printed += 1;
                        self.short += usize::from(certain < *digits);
                        // Values below this part of their reference may be printed as zero.
                        let whole = if matches!(part, AnswerPart::Direction) {
                            1e6
                        } else if matches!(part, AnswerPart::Degrees) {
                            360.0
                        } else {
                            r.scale
                        };
                        let nothing = (10f64.powi(-(*digits as i32 + 10)) * whole).max(r.noise);
                        if n.zero && e.enclosure().largest() <= nothing {
                            continue;
                        }
                        let truth = e.text(certain).map_or_else(|| format!("{e:?}"), |t| t.0);
                        if truth != text {
                            self.wrong.push(format!(
                                "{name}: {} {} is printed {text}, it is {truth} ({})",
                                find.text,
                                part.key(),
                                c.rung.name()
                            ));
                        }
                        let f64s = match (r.value(), part.key()) {
                            (AnswerValue::Scalar(s), "value") => Some(s),
                            (AnswerValue::Vector(v), "magnitude") => Some(v.norm()),
                            _ => None,
                        };
                        self.plain +=
                            usize::from(f64s.is_some_and(|x| {
                                hodograph::digits::significant(x, certain) != text
                            }));
                    }
                }
            }
        });
    }

    /// Compares the numbers in the steps of the construction.
    fn steps(&mut self, name: &str, scene: &Scene, worked: &Worked) {
        const PENCIL_MM: f64 = 0.1;
        let printed = steps(scene, worked, Some(PENCIL_MM));
        let Ok(differences) = truth::differences(scene, worked) else { return };
        for t in told(scene, worked, &differences, PENCIL_MM) {
            let place = || format!("{name}: {:?} step {} {:?}", t.level, t.action + 2, t.what);
            let digits = t.what.digits();
            let Some((n, (text, certain))) =
                printed.number(t.level, t.action, t.what).and_then(|n| Some((n, n.text(digits)?)))
            else {
                self.short += 1;
                continue;
            };
            self.printed += 1;
            self.told += 1;
            self.short += usize::from(certain < digits);
            if n.zero {
                // The differences themselves are true to some 80 digits.
                if t.value.approx().abs() > t.nothing + 1e-60 {
                    self.wrong.push(format!(
                        "{} is told as zero, it is {:e}",
                        place(),
                        t.value.approx()
                    ));
                }
                continue;
            }
            let ball = Ball::new(t.value, 1e-60 * t.value.approx().abs());
            let expected = parts(Kind::Omega, AnswerValue::Scalar(ball), 0.0, digits).ok();
            let truth = expected
                .and_then(|e| e[0].1.text(certain))
                .map_or_else(|| format!("{:e}", t.value.approx()), |t| t.0);
            if truth != text {
                self.wrong.push(format!("{} is told as {text}, it is {truth}", place()));
            }
        }
    }

    fn done(&self, least: usize) {
        println!(
            "{} scenes, {} printed numbers ({} of them told by steps) against {} bit: {} wrong; {} with fewer digits than asked; plain f64 would print {} wrong; {:?}",
            self.scenes,
            self.printed,
            self.told,
            truth::BITS,
            self.wrong.len(),
            self.short,
            self.plain,
            self.by_rung
        );
        for w in self.wrong.iter().take(20) {
            println!("  {w}");
        }
        assert!(
            self.wrong.is_empty(),
            "{} printed digits are wrong, first {}",
            self.wrong.len(),
            self.wrong[0]
        );
        assert!(self.printed >= least / every(8), "only {} numbers were compared", self.printed);
    }
}

#[test]
fn printed_digits_are_true_on_templates() {
    let mut tally = Tally::default();
    let mut rng = Rng::new(7);
    for t in templates::list() {
        let scene = in_si(read(templates::get(t.name).unwrap()).unwrap().value);
        tally.check(t.name, &scene);
        let Some(start) = driver_position(&scene, 0) else { continue };
        for _ in seeds(3) {
            // Anywhere in its range, as the shortest decimal of a double.
            let at = if start.abs() > 0.0 {
                start * rng.between(0.6, 1.4)
            } else {
                rng.between(-0.5, 0.5)
            };
            tally.check(&format!("{} at {at}", t.name), &with_driver_at(&scene, 0, at));
        }
    }
    tally.done(1500);
}

#[test]
fn printed_digits_are_true_on_random_mechanisms() {
    let mut tally = Tally::default();
    for seed in seeds(40) {
        let Some(m) = mechanism(seed).filter(|m| !m.coordinates_only) else { continue };
        let scene = read(emitted(&m, &style(Pose::Lengths, Ask::Everything, seed))).unwrap().value;
        tally.check(&format!("seed {seed}"), &scene);
    }
    tally.done(2000);
}

/// `HODOGRAPH_SEEDS=20 cargo test --test random gears_and_cams` compares more than 10⁵ numbers.
#[test]
fn printed_digits_are_true_of_gears_and_cams() {
    let mut tally = Tally::default();
    for seed in seeds(60) {
        let Some((_, scene)) = crate::grown::scene(seed) else { continue };
        tally.check(&format!("grown {seed}"), &in_si(scene));
    }
    tally.done(4000);
}

#[test]
fn printed_digits_are_true_next_to_a_toggle() {
    let mut tally = Tally::default();
    for t in templates::list().iter().step_by(every(8)) {
        let scene = in_si(read(templates::get(t.name).unwrap()).unwrap().value);
        tally.toward(t.name, &scene);
    }
    // Rocker driven: every four-bar with a driver that is no crank has a toggle.
    for seed in seeds(6) {
        let mut rng = Rng::new(seed + 100);
        let (a, b, c) = (rng.between(0.2, 0.5), rng.between(0.3, 0.9), rng.between(0.3, 0.9));
        let text = format!(
            r#"{{"links": {{"1": ["A","B"], "2": ["B","C"], "3": ["C","D"], "4": ["A","D"]}}, "ground": "4",
            "lengths": {{"AB": "{a} m", "BC": "{b} m", "CD": "{c} m", "AD": "{} m"}},
            "driver": {{"link": "1", "angle": "20 deg", "omega": "3.7 rad/s", "alpha": "1.3 rad/s^2"}}}}"#,
            b + c - 0.5 * a
        );
        if let Ok(scene) = read(&text) {
            tally.toward(&format!("four-bar {seed}"), &scene.value);
        }
    }
    tally.done(1500);
}

/// Poses by lengths so close to a dead centre that `f64` cannot distinguish them: the printed
/// digits are true of the input as written.
#[test]
fn printed_digits_are_true_closer_than_f64_can_tell() {
    let mut tally = Tally::default();
    let mut longer = 0;
    for side in ["left", "right"] {
        for nines in 4..=26 {
            let text = format!(
                r#"{{"links": {{"1": ["A","B"], "2": ["B","C","E"], "3": ["C","D"], "4": ["A","D"]}}, "ground": "4",
                "lengths": {{"AB": "3 m", "BC": "2 m", "CD": "3 m", "AD": "4 m", "BE": "1 m", "CE": "1.5 m"}}, "side": {{"C": "{side} of BD"}},
                "driver": {{"link": "1", "angle": "89.{} deg", "omega": "1.1 rad/s", "alpha": "0.3 rad/s^2"}}}}"#,
                "9".repeat(nines)
            );
            let scene = read(&text).unwrap_or_else(|f| panic!("{f}")).value;
            let worked =
                work(&scene, Scope::Questions).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
            assert!(worked.unanswered.is_empty(), "{text}");
            longer += usize::from(worked.results.iter().any(|r| r.longer.is_some()));
            tally.check(&format!("89.9({nines}) {side}"), &scene);
        }
        // At the limit as written, there are no digits to print.
        let text = format!(
            r#"{{"links": {{"1": ["A","B"], "2": ["B","C"], "3": ["C","D"], "4": ["A","D"]}}, "ground": "4", "find": ["omega_3", "v_B"],
            "lengths": {{"AB": "3 m", "BC": "2 m", "CD": "3 m", "AD": "4 m"}}, "side": {{"C": "{side} of BD"}},
            "driver": {{"link": "1", "angle": "90 deg", "omega": "1.1 rad/s"}}}}"#
        );
        let scene = read(&text).unwrap().value;
        let worked = work(&scene, Scope::Questions).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
        assert_eq!((worked.results.len(), worked.unanswered.len()), (1, 1), "{text}");
    }
    assert!(longer > 20 / every(8), "{longer}");
    tally.done(1500);
}

/// An angle with any number of full turns added gives the same pose, the same certified digits, and
/// the same drawing.
#[test]
fn angles_of_many_turns_are_those_within_one() {
    let mut compared = 0;
    let names = ["phi_1", "phi_2", "phi", "theta"];
    let all = templates::list();
    for (t, name) in all.iter().flat_map(|t| names.map(|name| (t, name))) {
        for at in ["30", "47.25", "-12.3"] {
            let scene = |angle: &str| {
                read(&templates::instantiate(t.name, &[(name, angle)]).ok()?)
                    .ok()
                    .map(|s| in_si(s.value))
            };
            let (Some(one), whole) = (scene(at), at.split_once('.').map_or(at, |p| p.0)) else {
                continue;
            };
            let Ok(here) = work(&one, Scope::Questions) else { continue };
            let printed = |scene: &Scene, w: &Worked| -> Vec<Option<String>> {
                let all = certify(scene, w, 12);
                all.iter()
                    .flat_map(|c| c.parts.iter().map(|(_, n)| n.text(12).map(|t| t.0)))
                    .collect()
            };
            let expected = printed(&one, &here.value);
            for turns in [1_000_000u128, 300_000_000_000_000, 10u128.pow(24), 10u128.pow(34) + 7] {
                let many = 360 * turns;
                // A wheel with another number of teeth is in another position after a turn of the
                // driver.
                if !one.rolling.is_empty() {
                    let told = templates::instantiate(t.name, &[(name, &many.to_string())])
                        .and_then(|text| read(&text));
                    let refused =
                        told.is_err_and(|f| f.list.iter().any(|d| d.code == "out-of-range"));
                    assert_eq!(
                        refused,
                        many > 1 << 53 && one.drivers.iter().any(|d| d.kind.turns()),
                        "{} after {turns} turns",
                        t.name
                    );
                    continue;
                }
                let sum = whole
                    .parse::<i64>()
                    .map(|w| if w < 0 { many - w.unsigned_abs() as u128 } else { many + w as u128 })
                    .unwrap();
                let text = match at.split_once('.') {
                    // −12.3 is a turn less 12.3.
                    Some((_, broken)) if at.starts_with('-') => {
                        format!("-{}.{broken}", many + whole[1..].parse::<u128>().unwrap())
                    }
                    Some((_, broken)) => format!("{sum}.{broken}"),
                    None => sum.to_string(),
                };
                let there = scene(&text).unwrap_or_else(|| panic!("{} at {text}", t.name));
                let worked = work(&there, Scope::Questions)
                    .unwrap_or_else(|f| panic!("{} at {text}: {f}", t.name))
                    .value;
                assert_eq!(printed(&there, &worked), expected, "{} at {text}", t.name);
                for (a, b) in here.value.results.iter().zip(&worked.results) {
                    let scale = a.scale;
                    let (a, b) = (a.value().magnitude(), b.value().magnitude());
                    assert!(
                        (a - b).abs() <= 1e-9 * a.max(1e-3 * scale),
                        "{} at {text}: {b:e}, within a turn {a:e}",
                        t.name
                    );
                }
                compared += 1;
            }
        }
    }
    assert!(compared > 50 / every(8), "{compared}");
}

impl Tally {
    /// Poses down to 1e-12 (radians, or of the travel) before both toggles.
    fn toward(&mut self, name: &str, scene: &Scene) {
        for up in [true, false] {
            let Some(limit) = ends(scene, 0).unwrap_or_default()[usize::from(up)] else { continue };
            for k in (2..=12).step_by(2) {
                let at =
                    limit + if up { -1.0 } else { 1.0 } * 10f64.powi(-k) * limit.abs().min(1.0);
                self.check(&format!("{name} 1e-{k} before {limit}"), &with_driver_at(scene, 0, at));
            }
        }
    }
}

/// The scene without a book's units: the reference is in SI only. (Printed numbers times their
/// units: `tests/cli/units.rs`.)
fn in_si(mut scene: Scene) -> Scene {
    scene.book = Default::default();
    scene
}
