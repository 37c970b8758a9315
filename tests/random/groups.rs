//! The Assur program compared with the loop equations: group by group against all at once.

use crate::emit::{Ask, Pose};
use crate::properties::{mechanism, seeds, solve, style};
use hodograph::answer::{AnswerValue, evaluate};
use hodograph::{motion, position};

#[test]
fn group_by_group_as_all_at_once() {
    let (mut worst, mut answers, mut settled, mut placed) = (0.0f64, 0, 0, 0);
    for pose in [Pose::Coordinates, Pose::Lengths] {
        for seed in seeds(300) {
            let Some(m) = mechanism(seed) else { continue };
            let pose = if m.coordinates_only { Pose::Coordinates } else { pose };
            let c = solve(seed, &m, &style(pose, Ask::Everything, seed));
            let w = &c.worked;
            let again =
                position::recompute::<f64>(&c.scene, &w.mechanism, &w.demand, &w.configuration)
                    .unwrap_or_else(|f| panic!("seed {seed}: {f}\n{}", c.text));
            // The same numbers, or, where the closed forms had lost digits, numbers rounded from
            // longer ones.
            let size = w.configuration.extent();
            let off = again
                .points
                .iter()
                .zip(&w.configuration.points)
                .filter_map(|(a, b)| Some((*a)?.distance((*b)?)));
            let off = off.fold(0.0, f64::max);
            assert_eq!(
                again.closures, w.configuration.closures,
                "seed {seed}: another assembly in the same numbers\n{}",
                c.text
            );
            assert!(
                off <= 1e-9 * size,
                "seed {seed}: {off:e} m off in the same numbers\n{}",
                c.text
            );
            settled += usize::from(again != w.configuration);
            placed += 1;
            let again = w.configuration.clone();
            let motion = motion::solve(&c.scene, &w.mechanism, &again, &w.demand);
            assert_eq!(motion.singular, [0; 0], "seed {seed}: {:?}\n{}", m.groups, c.text);
            let largest = |a: AnswerValue, b: AnswerValue| a.magnitude().max(b.magnitude());
            for o in w.results.iter().filter(|o| o.agreement.is_some()) {
                let find = &c.scene.find[o.find];
                let value = evaluate(&c.scene, &again, &motion, &find.what)
                    .unwrap_or_else(|| panic!("seed {seed}: {}", find.text));
                let off = match (value, o.computed) {
                    (AnswerValue::Vector(a), AnswerValue::Vector(b)) => (a - b).norm(),
                    (AnswerValue::Scalar(a), AnswerValue::Scalar(b)) => (a - b).abs(),
                    _ => panic!("seed {seed}: {} is a vector and a number", find.text),
                };
                let agreement = o.agreement.expect("filtered");
                let size = largest(value, o.computed).max(agreement.noise * 1e13);
                answers += 1;
                if off > 1e-9f64.max(100.0 * agreement.bound) * size {
                    panic!(
                        "seed {seed}: {} of {:?} is {value:?}, loop equations {:?}\n{}",
                        find.text, m.groups, o.computed, c.text
                    );
                }
                worst = worst.max(off / size);
            }
        }
    }
    println!(
        "{answers} answers group by group against all at once: worst {worst:.1e}; {settled} of {placed} poses found again in longer numbers"
    );
    assert!(
        settled * 10 < placed,
        "{settled} of {placed} ordinary poses count as ones that lost digits"
    );
}

/// `f32` gives the same results with half the digits.
#[test]
fn single_precision_goes_the_same_way() {
    let scene = hodograph::scene::read(hodograph::scene::templates::get("crank-rocker").unwrap())
        .unwrap()
        .value;
    let w = hodograph::worked::work(&scene, hodograph::worked::Scope::Questions).unwrap().value;
    let at = position::recompute::<f32>(&scene, &w.mechanism, &w.demand, &w.configuration).unwrap();
    let motion = motion::solve(&scene, &w.mechanism, &at, &w.demand);
    for r in &w.results {
        let (Some(AnswerValue::Vector(a)), AnswerValue::Vector(b)) =
            (evaluate(&scene, &at, &motion, &scene.find[r.find].what), r.computed)
        else {
            continue;
        };
        let off = (a.approx() - b).norm() / b.norm();
        assert!(off < 1e-5 && off > 1e-10, "{}: {off:e}", scene.find[r.find].text);
    }
}
