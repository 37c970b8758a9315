//! Fewer questions: never more work, and the same answers.

use crate::emit::{self, Ask, Pose};
use crate::properties::{mechanism, seeds, style, worked};
use crate::rng::Rng;
use hodograph::answer::{AnswerValue, evaluate};
use hodograph::effort::{MotionWork, Work};
use hodograph::scene::Scene;
use hodograph::worked::Worked;
use hodograph::{motion, scene};
use serde_json::json;

struct Pair {
    seed: u64,
    text: String,
    whole: (Scene, Worked),
    part: (Scene, Worked),
}

/// Random mechanisms with all questions, and with a few of them.
fn pairs(own: u64, mut check: impl FnMut(&Pair)) {
    for seed in seeds(own) {
        let Some(m) = mechanism(seed) else { continue };
        let pose = if m.coordinates_only || seed.is_multiple_of(2) {
            Pose::Coordinates
        } else {
            Pose::Lengths
        };
        let text = emit::scene(&m, &style(pose, Ask::Everything, seed));
        let mut json: serde_json::Value = serde_json::from_str(&text).unwrap();
        let all: Vec<String> = serde_json::from_value(json["find"].clone()).unwrap();
        let mut rng = Rng::new(seed ^ 0xa5ced);
        let few: Vec<&String> = (0..1 + rng.below(3)).map(|_| &all[rng.below(all.len())]).collect();
        json["find"] = json!(few);
        let text_of_part = json.to_string();
        if scene::read(&text_of_part).is_err() {
            continue; // the same question twice
        }
        let solve =
            |text: &str| worked(seed, text).unwrap_or_else(|f| panic!("seed {seed}: {f}\n{text}"));
        check(&Pair { seed, whole: solve(&text), part: solve(&text_of_part), text: text_of_part });
    }
}

fn counters(w: &Worked) -> Vec<(&'static str, usize)> {
    let done = Work::of(w);
    let motion = |m: MotionWork| {
        [
            ("groups", m.groups),
            ("equations planned", m.equations_planned),
            ("equations closed", m.equations_closed),
            // A point may be found by an equation in one case and by its image in the other.
            ("points found", m.equations_closed + m.images),
            ("vectors", m.vectors),
            ("rates", m.rates),
            ("unknowns", m.unknowns),
        ]
    };
    let placed = [
        ("groups placed", done.groups_placed),
        ("levels", done.levels()),
        ("answers", done.answers),
    ];
    placed.into_iter().chain(motion(done.velocity)).chain(motion(done.acceleration)).collect()
}

#[test]
fn asking_less_never_does_more() {
    let (mut compared, mut less) = (0, 0);
    pairs(400, |p| {
        for ((what, few), (_, all)) in counters(&p.part.1).into_iter().zip(counters(&p.whole.1)) {
            compared += 1;
            less += usize::from(few < all);
            assert!(
                few <= all,
                "seed {}: {few} {what} for a few questions, {all} for all of them\n{}",
                p.seed,
                p.text
            );
        }
    });
    println!("{compared} counters compared, {less} smaller where less is asked");
    assert!(less * 2 > compared, "asking less saves next to nothing: {less} of {compared}");
}

/// Positions, and motions group by group, agree to the last bit; drawing and loop equations, with
/// paper and matrix as large as the questions need, agree within their tolerance.
#[test]
fn what_else_is_asked_changes_no_answer() {
    let mut answers = 0;
    pairs(400, |p| {
        let fail = |what: String| -> ! { panic!("seed {}: {what}\n{}", p.seed, p.text) };
        let ((scene, few), (whole, all)) = (&p.part, &p.whole);
        for (i, at) in few.configuration.points.iter().enumerate() {
            if at.is_some() && *at != all.configuration.points[i] {
                fail(format!(
                    "{} is at {at:?}, asked with others at {:?}",
                    scene.points[i].name, all.configuration.points[i]
                ));
            }
        }
        let alone = motion::solve(scene, &few.mechanism, &few.configuration, &few.demand);
        let together = motion::solve(whole, &all.mechanism, &all.configuration, &all.demand);
        for o in &few.results {
            let find = &scene.find[o.find];
            let a = evaluate(scene, &few.configuration, &alone, &find.what);
            let b = evaluate(scene, &all.configuration, &together, &find.what);
            if a != b {
                fail(format!("{} alone is {a:?}, with others {b:?}", find.text));
            }
            let other = all
                .results
                .iter()
                .find(|r| whole.find[r.find].text == find.text)
                .expect("all questions hold it");
            let off = match (o.computed, other.computed) {
                (AnswerValue::Vector(a), AnswerValue::Vector(b)) => (a - b).norm(),
                (AnswerValue::Scalar(a), AnswerValue::Scalar(b)) => (a - b).abs(),
                _ => f64::INFINITY,
            };
            let bound = [o.agreement, other.agreement]
                .into_iter()
                .flatten()
                .map(|a| a.bound)
                .fold(0.0, f64::max);
            if off > bound * other.scale.max(o.scale).max(o.computed.magnitude()) {
                fail(format!(
                    "{} by the loop equations: alone {:?}, with others {:?}",
                    find.text, o.computed, other.computed
                ));
            }
            answers += 1;
        }
    });
    println!("{answers} answers the same");
}
