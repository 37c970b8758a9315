//! Cams compiled into a sweep give the numbers of each position solved alone, in every stretch and
//! at every joint, in both senses and after many turns.

use crate::{PROFILES, scene};
use hodograph::analytic;
use hodograph::answer::AnswerValue;
use hodograph::cam::{CamMotion, MotionLaw, PreparedDisc};
use hodograph::mechanism::{Demand, Mechanism};
use hodograph::position;
use hodograph::scene::{Scene, with_driver_at};
use hodograph::sweep::{self, PlacedScene, Stations, Width};
use std::f64::consts::TAU;

/// Every follower of every face, by arcs and lines and by all laws.
fn kinds() -> Vec<String> {
    let laws = MotionLaw::ALL
        .into_iter()
        .flat_map(|l| ["law", "swing"].map(|of| format!("{of} {}", l.name())));
    PROFILES.into_iter().map(str::to_owned).chain(laws).collect()
}

/// The scene with the cam turning in the opposite sense.
fn reversed(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    scene.drivers[0].rate.value = -scene.drivers[0].rate.value;
    scene
}

/// The angles of the driver at the joints of the cam, and in each stretch at a third and at four
/// fifths of it.
fn angles(scene: &Scene) -> Vec<f64> {
    let t = scene.cams[0].disc.as_ref().unwrap();
    let mut joints = PreparedDisc::of(&t.disc).corners();
    if matches!(t.disc.motion, CamMotion::Profile(_)) {
        assert_eq!(joints, t.disc.stretches().iter().map(|s| s.0).collect::<Vec<_>>());
    }
    joints.push(joints[0] + TAU);
    let within =
        joints.windows(2).flat_map(|w| [0.0, 1.0 / 3.0, 0.8].map(|k| w[0] + k * (w[1] - w[0])));
    within.map(|phi| t.way * (t.disc.sense * phi + t.start)).collect()
}

/// One position by closed forms and loop equations.
fn alone(scene: &Scene, m: &Mechanism, placed: &PlacedScene, at: f64) -> Vec<f64> {
    let moved = with_driver_at(scene, 0, at);
    let pose = position::recompute::<f64>(&moved, m, &placed.demand, &placed.at).unwrap();
    let solution = analytic::solve(&moved, m, &pose, &Demand::of(scene, m)).unwrap();
    let numbers = |v: AnswerValue| match v {
        AnswerValue::Scalar(s) => vec![s],
        AnswerValue::Vector(v) => vec![v.x, v.y, v.norm()],
        AnswerValue::Point(p) => vec![p.x, p.y],
    };
    scene
        .find
        .iter()
        .flat_map(|f| numbers(solution.answer(&moved, &pose, &f.what).unwrap()))
        .collect()
}

fn compare(name: &str, scene: &Scene) {
    let m = Mechanism::new(scene).unwrap().value;
    let placed = PlacedScene::new(scene, &m).unwrap();
    assert!(
        sweep::compile(scene, &m, &placed.at, Some(0), &scene.find).is_ok(),
        "{name} is not compiled"
    );
    let once = angles(scene);
    let values: Vec<f64> = once.iter().flat_map(|a| [*a, a + TAU]).collect();
    let table =
        sweep::run(&placed, 0, &Stations::of_values(values.clone(), 1.0), Width::Widest).unwrap();
    assert_eq!(table.rows(), values.len(), "{name}: {:?}", table.notes);
    let expected: Vec<Vec<f64>> =
        once.iter().flat_map(|a| [*a, *a]).map(|a| alone(scene, &m, &placed, a)).collect();
    for (k, column) in table.columns[1..].iter().enumerate() {
        let size = expected.iter().fold(0.0f64, |m, row| m.max(row[k].abs()));
        for (i, row) in expected.iter().enumerate() {
            let off = (column.values[i] - row[k]).abs();
            assert!(
                off <= 1e-12 * size,
                "{name}, {} at {:?}: {} compiled, {} alone, {off:e} of {size}",
                column.name,
                values[i],
                column.values[i],
                row[k]
            );
        }
    }
}

#[test]
fn a_compiled_cam_is_each_position_by_itself() {
    for kind in kinds() {
        let scene = scene(&kind, "10 deg").over_a_turn();
        compare(&kind, &scene);
        compare(&format!("{kind}, backward"), &reversed(&scene));
    }
}
