//! Every printed digit of instantaneous centres, of curvature and of composite motion is true:
//! compared with geometry in 640-bit arithmetic ([`crate::poses`]).
//!
//! `HODOGRAPH_SEEDS=5 cargo test --test random pose_digits -- --nocapture` compares some 36 000
//! numbers.

use crate::compared::{Compared, asking};
use crate::emit::{Ask, Pose, scene as emitted};
use crate::poses::Oracle;
use crate::properties::{mechanism, seeds, style};
use crate::rng::Rng;
use crate::wide::every;
use hodograph::composite::{ChoiceVerdict, choices, name_of};
use hodograph::effort::truth;
use hodograph::scene::quantity::Frame;
use hodograph::scene::{Scene, read};
use hodograph::worked::{Scope, work};

/// The error of differences, as a part of their value.
const OFF: f64 = 1e-45;

/// Scenes of all kinds with a complete motion: random linkages, and mechanisms with gears, cams and
/// rolling wheels.
fn texts(own: u64) -> impl Iterator<Item = (String, String)> {
    seeds(own).filter_map(|seed| match seed % 4 {
        0 => crate::grown::text(seed / 4).map(|text| (format!("grown {}", seed / 4), text)),
        _ => {
            let m = mechanism(seed).filter(|m| !m.coordinates_only && m.groups.len() <= 8)?;
            Some((format!("seed {seed}"), emitted(&m, &style(Pose::Lengths, Ask::Positions, seed))))
        }
    })
}

/// Compares the answers to some questions about each scene.
fn compare(
    own: u64,
    what: &str,
    least: usize,
    questions: impl Fn(&Scene, &mut Rng) -> Vec<String>,
) {
    let mut all = Compared::default();
    for (seed, (name, text)) in texts(own).enumerate() {
        let Ok(bare) = read(&text) else { continue };
        let asked = questions(&bare.value, &mut Rng::new(seed as u64 + 99));
        let text = asking(&text, &asked);
        let scene = read(&text).unwrap_or_else(|f| panic!("{name}: {f}\n{text}")).value;
        let run = || work(&scene, Scope::Questions);
        let run = std::panic::catch_unwind(std::panic::AssertUnwindSafe(run));
        let Ok(worked) = run.unwrap_or_else(|_| panic!("{name}: a panic on\n{text}")) else {
            continue;
        };
        let (worked, mut refused) = (worked.value, None);
        all.scene(&name, &scene, &worked, OFF, || match truth::differences(&scene, &worked) {
            Ok(d) => {
                let oracle = Oracle { scene: &scene, d: &d };
                scene.find.iter().map(|f| oracle.answer(&f.what)).collect()
            }
            Err(f) => {
                refused = Some(f.list[0].code);
                vec![None; scene.find.len()]
            }
        });
        refused.into_iter().for_each(|code| *all.open.entry(code.to_owned()).or_default() += 1);
    }
    all.done(what, least);
}

/// Two different links by their names.
fn pair(scene: &Scene, rng: &mut Rng) -> [String; 2] {
    let i = rng.below(scene.links.len());
    let j = (i + 1 + rng.below(scene.links.len() - 1)) % scene.links.len();
    [i, j].map(|l| scene.links[l].name.clone())
}

/// Some of a list, each once.
fn some(rng: &mut Rng, mut all: Vec<String>, most: usize) -> Vec<String> {
    all.sort();
    all.dedup();
    rng.shuffle(&mut all);
    all.truncate(most);
    all
}

/// Points on moving links.
fn movers(scene: &Scene) -> Vec<String> {
    let fixed = &scene.links[scene.ground.0].points;
    let moving = |l: usize| l != scene.ground.0;
    let all = (0..scene.links.len()).filter(|l| moving(*l)).flat_map(|l| &scene.links[l].points);
    all.filter(|p| !fixed.contains(p)).map(|p| scene.points[p.0].name.clone()).collect()
}

#[test]
fn printed_digits_are_true_of_centres() {
    compare(60, "centres", 400 / every(8), |scene, rng| {
        let points = movers(scene);
        let one = |k: usize, rng: &mut Rng| {
            let [i, j] = pair(scene, rng);
            let centre = if i < j { format!("P_{i},{j}") } else { format!("P_{j},{i}") };
            if k.is_multiple_of(3) {
                format!("{centre},{}", points[rng.below(points.len())])
            } else {
                centre
            }
        };
        let all = (0..12).map(|k| one(k, rng)).collect();
        some(rng, all, 12)
    });
}

#[test]
fn printed_digits_are_true_of_curvature() {
    compare(60, "curvature", 600 / every(8), |scene, rng| {
        let points = movers(scene);
        let ground = scene.link_name(scene.ground).to_owned();
        let has_points =
            |name: &String| scene.links.iter().any(|l| l.name == *name && !l.points.is_empty());
        let one = |k: usize, rng: &mut Rng| {
            if k.is_multiple_of(3) {
                return Some(format!(
                    "{}_{}",
                    rng.pick(&["rho", "O"]),
                    points[rng.below(points.len())]
                ));
            }
            let [i, j] = pair(scene, rng);
            let (i, j) = if i == ground { (j, i) } else { (i, j) };
            let symbol = rng.pick(&["J", "d", "K", "u", "p"]);
            let seen =
                if j == ground { format!("{symbol}_{i}") } else { format!("{symbol}_{i}/{j}") };
            [&i, &j].into_iter().all(|l| *l == ground || has_points(l)).then_some(seen)
        };
        let all = (0..14).filter_map(|k| one(k, rng)).collect();
        some(rng, all, 14)
    });
}

#[test]
fn printed_digits_are_true_of_composite_motion() {
    compare(60, "composite motion", 1500 / every(8), |scene, rng| {
        let usable = choices(scene)
            .into_iter()
            .filter(|c| !matches!(c.verdict, ChoiceVerdict::SameBody | ChoiceVerdict::FrameFixed));
        let all = usable.flat_map(|c| {
            let (frame, turns) = match c.frame {
                Frame::Link(l) => (scene.link_name(l).to_owned(), true),
                Frame::Point(p) => (name_of(scene, &p), false),
            };
            let symbols = ["ve", "vr", "ae", "aen", "aet", "ar", "arn", "art", "ak"];
            let symbols = if turns { &symbols[..] } else { &symbols[..8] };
            let of = name_of(scene, &c.of);
            symbols.iter().map(|s| format!("{s}_{of}/{frame}")).collect::<Vec<_>>()
        });
        let all = all.collect();
        some(rng, all, 16)
    });
}
