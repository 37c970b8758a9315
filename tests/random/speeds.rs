//! Singular poses with any driver: at all speeds, from rest and at rest, where both motions
//! coincide, and where the pose is singular only to the root of its rounding.

use crate::singular::{FOUR_BAR, FRAMES, Frame, RATES, close, drive, number, run, scene_in};
use hodograph::analytic::SingularKind;
use hodograph::scene;
use hodograph::worked::{Scope, Worked, work};

type Four = [(&'static str, f64, f64); 4];

/// Two motions pass through each: parallelograms both ways in line, a rhombus, a kite, 2 + 5 = 3 +
/// 4.
const CHANGE_POINTS: [Four; 5] = [
    [("A", 0.0, 0.0), ("B", 1.0, 0.0), ("C", 4.0, 0.0), ("D", 3.0, 0.0)],
    [("A", 0.0, 0.0), ("B", -1.0, 0.0), ("C", 2.0, 0.0), ("D", 3.0, 0.0)],
    [("A", 0.0, 0.0), ("B", -1.0, 0.0), ("C", 0.0, 0.0), ("D", 1.0, 0.0)],
    [("A", 0.0, 0.0), ("B", 1.0, 0.0), ("C", 0.0, 0.0), ("D", 3.0, 0.0)],
    [("A", 0.0, 0.0), ("B", 2.0, 0.0), ("C", 5.0, 0.0), ("D", 4.0, 0.0)],
];

fn worked(text: &str) -> Worked {
    run(text).unwrap_or_else(|e| panic!("{e}\n{text}")).1
}

/// The values, and those of the other motion.
fn rates(done: &Worked) -> Vec<[f64; 2]> {
    done.results
        .iter()
        .map(|o| [number(o.value()), o.others.first().map_or(f64::NAN, |v| number(*v))])
        .collect()
}

/// At any speed: velocities are proportional to the driver's, accelerations to its square.
#[test]
fn change_points_are_the_same_at_every_speed() {
    for points in CHANGE_POINTS {
        for f in FRAMES {
            let at = |k: f64| {
                let text = scene_in(
                    f,
                    FOUR_BAR,
                    &points,
                    &format!("{}, {RATES}", drive(1, k, 2.0 * k * k)),
                );
                let done = worked(&text);
                assert_eq!(
                    done.solution.singular.first().map(|s| s.kind),
                    Some(SingularKind::ChangePoint),
                    "speed {k:e}\n{text}"
                );
                rates(&done)
            };
            let usual = at(1.0);
            assert!(usual.iter().flatten().all(|x| x.is_finite()), "{usual:?}");
            for k in [1e-12, 1e-7, 1e-3, 1e3, 1e7, 1e12] {
                for (i, (there, here)) in at(k).iter().zip(&usual).enumerate() {
                    let unit = if i < 3 { k } else { k * k };
                    for (a, b) in there.iter().zip(here) {
                        assert!(
                            close(a / unit, *b, 10.0),
                            "{points:?} at speed {k:e}: {there:?}, at 1 {here:?}"
                        );
                    }
                }
            }
        }
    }
}

/// Two sliders on parallel guides, joined by a rod as long as the distance of the guides: (x − t)²
/// = 0. The rod can only translate; this second-order condition gives velocities, but no
/// acceleration.
#[test]
fn two_motions_that_are_one() {
    for turn in 0..40 {
        let angle = format!("{} deg", 7.3 * f64::from(turn));
        for k in [1e-9, 1.0, 1e9] {
            let text = |find: &str| {
                let guide =
                    |pin: &str| format!(r#"{{"pin": "{pin}", "on": "0", "angle": "{angle}"}}"#);
                format!(
                    r#"{{"links": {{"1": ["A", "B"], "0": ["O"]}}, "ground": "0", "points": {{"O": ["-1 m", 0], "A": [0, 0], "B": ["-0.3*sin({angle})*1 m", "0.3*cos({angle})*1 m"]}},
                    "guides": [{}, {}], "driver": {{"slide": "A", "velocity": "{k:e} m/s"}}, "find": [{find}]}}"#,
                    guide("A"),
                    guide("B")
                )
            };
            let all = text(r#""v_B", "v_A", "omega_1""#);
            let values: Vec<f64> = worked(&all).results.iter().map(|o| number(o.value())).collect();
            assert!(
                close(values[0], k, k) && close(values[1], k, k) && values[2].abs() < 1e-6 * k,
                "{values:?}\n{all}"
            );
            // Accelerations do not follow; velocities are answered.
            let both = text(r#""v_B", "a_B""#);
            let scene = scene::read(&both).unwrap().value;
            let done = work(&scene, Scope::Figure).unwrap_or_else(|e| panic!("{e}\n{both}")).value;
            let [o] = &done.results[..] else { panic!("{:?}\n{both}", done.results) };
            assert!(
                scene.find[o.find].text == "v_B" && close(number(o.value()), k, k),
                "{o:?}\n{both}"
            );
            assert_eq!(done.unanswered.len(), 1, "{both}");
        }
    }
}

/// Lengths with equal sums except for the rounding of their roots: the pose is accurate to the root
/// of that rounding, and so are both motions.
#[test]
fn change_points_by_lengths_that_are_rounded() {
    let mut rounded = 0;
    for (i, a) in [2.0f64, 0.3, 7.0, 1.9].into_iter().enumerate() {
        for (b, c) in [(3.0f64, 5.0f64), (11.0, 0.7), (0.2, 0.07), (13.0, 6.0), (5.3, 4.1)] {
            let (root_a, root_b, root_c) = (a.sqrt(), b.sqrt(), c.sqrt());
            // A and D on one side of B and C, or between them.
            let ad = root_a + root_b - root_c;
            if ad < 0.1 {
                continue;
            }
            let lengths = format!(
                r#"{{"links": {FOUR_BAR}, "ground": "0", "lengths": {{"AB": "sqrt({a})*1 m", "BC": "sqrt({b})*1 m", "CD": "sqrt({c})*1 m",
                "AD": "(sqrt({a}) + sqrt({b}) - sqrt({c}))*1 m"}}, "driver": {{"link": "1", "angle": "{} deg", "omega": "1 rad/s"}}, {RATES}}}"#,
                360 * i
            );
            let points =
                [("A", 0.0, 0.0), ("B", root_a, 0.0), ("C", root_a + root_b, 0.0), ("D", ad, 0.0)];
            let exact = rates(&worked(&scene_in(
                FRAMES[0],
                FOUR_BAR,
                &points,
                &format!("{}, {RATES}", drive(1, 1.0, 0.0)),
            )));
            let done = worked(&lengths);
            let size = exact.iter().flatten().fold(1.0f64, |m, v| m.max(v.abs()));
            for (got, exact) in rates(&done).iter().zip(&exact) {
                // The other motion may have changed places with the intended one.
                let off = |k: usize| (got[k] - exact[k]).abs();
                assert!(
                    off(0) < 1e-5 * size && off(1) < 1e-5 * size,
                    "{got:?}, by coordinates {exact:?}\n{lengths}"
                );
            }
            rounded += usize::from(done.solution.singular[0].off > 0.0);
        }
    }
    assert!(rounded > 3, "{rounded} poses are rounded");
}

/// Without a driving motion nothing moves, at any order.
#[test]
fn at_rest_nothing_moves() {
    for points in CHANGE_POINTS {
        let text =
            scene_in(FRAMES[1], FOUR_BAR, &points, &format!("{}, {RATES}", drive(1, 0.0, 0.0)));
        let done = worked(&text);
        assert_eq!(
            done.solution.singular.first().map(|s| s.kind),
            Some(SingularKind::Rest),
            "{text}"
        );
        assert!(
            done.results.iter().all(|o| number(o.value()) == 0.0 && o.others.is_empty()),
            "{:?}\n{text}",
            done.results
        );
    }
}

/// A sketch near a change point selects the motion.
#[test]
fn the_sketch_tells_the_motions_apart() {
    let frame = Frame::scaled(1.0);
    for points in CHANGE_POINTS {
        let all = rates(&worked(&scene_in(
            frame,
            FOUR_BAR,
            &points,
            &format!("{}, {RATES}", drive(1, 1.0, 0.0)),
        )));
        let length = |a: usize, b: usize| (points[a].1 - points[b].1).abs();
        let (c, d) = (points[2].1, points[3].1);
        for way in [0, 1] {
            // C has moved farther this way than the other.
            let ahead = 0.05 * (all[2][way] - all[2][1 - way]) * (c - d);
            let text = format!(
                r#"{{"links": {FOUR_BAR}, "ground": "0", "lengths": {{"AB": "{} m", "BC": "{} m", "CD": "{} m", "AD": "{} m"}},
                "driver": {{"link": "1", "angle": "{} deg", "omega": "1 rad/s"}}, "sketch": {{"C": ["{c} m", "{ahead} m"]}}, {RATES}}}"#,
                length(0, 1),
                length(1, 2),
                length(2, 3),
                length(0, 3),
                if points[1].1 < 0.0 { 180 } else { 0 },
            );
            let values = rates(&worked(&text));
            let meant: Vec<f64> = all[..3].iter().map(|v| v[way]).collect();
            assert!(
                values.iter().zip(&meant).all(|(v, m)| close(v[0], *m, 10.0)),
                "way {way}: {values:?}, {meant:?}\n{text}"
            );
        }
    }
}
