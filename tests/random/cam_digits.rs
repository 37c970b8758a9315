//! Every printed digit of a cam's answers is true: compared with formulas of this file in 640-bit
//! arithmetic, with derivatives by differences and angles of phases from triangles.
//!
//! `HODOGRAPH_SEEDS=10 HODOGRAPH_WIDE=1 cargo test --test random of_cams -- --nocapture` compares
//! more than 10⁵ numbers.

use crate::cam_truth::{ByLaw, Cam, Profile};
use crate::properties::seeds;
use crate::wide::every;
use hodograph::answer::AnswerValue;
use hodograph::certified::ladder::{AnswerPart, certify, parts};
use hodograph::effort::truth::BITS;
use hodograph::number::{Ball, Big, Real, within};
use hodograph::scene::read;
use hodograph::worked::{NoAnswer, Scope, work};

#[test]
fn printed_digits_are_true_of_cams() {
    const DIGITS: [usize; 3] = [4, 6, 12];
    let (mut scenes, mut printed, mut short, mut wrong, mut open) =
        (0, 0, 0, Vec::new(), std::collections::BTreeMap::<String, usize>::new());
    for seed in seeds(600) {
        let cam = Cam::of(seed);
        let text = cam.text();
        let scene = match read(&text) {
            Ok(scene) => scene.value,
            Err(f) => {
                *open.entry(f.list[0].code.to_owned()).or_default() += 1;
                continue;
            }
        };
        let Ok(worked) = work(&scene, Scope::Questions) else { continue };
        let worked = worked.value;
        let certified = DIGITS.map(|d| certify(&scene, &worked, d));
        scenes += 1;
        within(BITS, || {
            let truth: [Option<Big>; 6] = match &cam.profile {
                Profile::Law(stages) => {
                    let law = ByLaw { cam: &cam, stages, base: cam.base.metres() };
                    // The search for the least radius takes the longest.
                    law.answers(seed % 8 == 0)
                }
                Profile::Arcs { .. } => {
                    cam.of_arcs(scene.cams[0].disc.as_ref().unwrap().touched.unwrap())
                }
            };
            for u in &worked.unanswered {
                let infinite = matches!(u.why, NoAnswer::Infinite(_));
                if !infinite || truth[u.find].is_some() {
                    wrong.push(format!(
                        "seed {seed}: {} has no answer\n{text}",
                        scene.find[u.find].text
                    ));
                }
            }
            for (i, r) in worked.results.iter().enumerate() {
                let find = &scene.find[r.find];
                let Some(t) = truth[r.find] else { continue };
                let t = AnswerValue::Scalar(Ball::new(t, 1e-45 * t.approx().abs().max(1e-3)));
                for (digits, certified) in DIGITS.iter().zip(&certified) {
                    let Ok(expected) = parts(find.what.kind(), t, r.scale, *digits) else {
                        // A nose that touches the base circle from within gives no lift: no rise
                        // may be printed.
                        if certified[i].parts.iter().any(|(_, n)| n.text(*digits).is_some()) {
                            wrong.push(format!(
                                "seed {seed}: {} is told and has no true value\n{text}",
                                find.text
                            ));
                        }
                        continue;
                    };
                    if certified[i].parts.is_empty() {
                        *open
                            .entry(format!("{}: {:?}", find.text, certified[i].why))
                            .or_default() += 1;
                    }
                    for (part, n) in &certified[i].parts {
                        let Some((told, certain)) = n.text(*digits) else {
                            short += 1;
                            continue;
                        };
                        printed += 1;
                        short += usize::from(certain < *digits);
                        let (_, e) = expected.iter().find(|(p, _)| p == part).unwrap();
                        let whole =
                            if matches!(part, AnswerPart::Degrees) { 360.0 } else { r.scale };
                        if n.zero
                            && e.enclosure().largest() <= 10f64.powi(-(*digits as i32 + 10)) * whole
                        {
                            continue;
                        }
                        let truth = e.text(certain).map_or_else(|| format!("{e:?}"), |t| t.0);
                        if truth != told {
                            wrong.push(format!(
                                "seed {seed}: {} {} is printed {told}, it is {truth} ({})\n{text}",
                                find.text,
                                part.key(),
                                certified[i].rung.name()
                            ));
                        }
                    }
                }
            }
        });
    }
    println!(
        "{scenes} scenes, {printed} printed numbers against {BITS} bit: {} wrong; {short} with fewer digits than asked; {open:?}",
        wrong.len()
    );
    assert!(
        wrong.is_empty(),
        "{} are wrong, first {}",
        wrong.len(),
        wrong[..wrong.len().min(3)].join("\n")
    );
    assert!(
        printed >= 8000 / every(8) && short * 100 <= printed,
        "only {printed} numbers were compared, {short} with fewer digits"
    );
}
