//! Paths with prescribed timing: random linkages are found from places of their coupler point at
//! given rotations of the crank.

use crate::{Mixed, at, crank_rocker, design, is, mm};
use hodograph::synthesis::{read, solve};
use serde_json::{Value as Json, json};

/// Places of a random coupler point at these rotations (degrees) from a random start, with any
/// position of the frame.
fn task(r: &mut Mixed, l: [f64; 4], turns: &[f64]) -> Json {
    let (u, v) = (r.between(20.0, 100.0), r.between(-80.0, 80.0));
    let (start, tilt) = (r.between(0.0, 6.0), r.between(0.0, 6.0));
    let (x, y) = (r.between(-50.0, 50.0), r.between(-50.0, 50.0));
    let place = |turn: &f64| {
        let [b, c] = at(l, start + turn.to_radians());
        let w = [(c[0] - b[0]) / l[1], (c[1] - b[1]) / l[1]];
        let e = [b[0] + w[0] * u - w[1] * v, b[1] + w[1] * u + w[0] * v];
        json!([
            mm(x + e[0] * tilt.cos() - e[1] * tilt.sin()),
            mm(y + e[0] * tilt.sin() + e[1] * tilt.cos())
        ])
    };
    // Only differences of the angles count.
    let timing: Vec<String> = turns.iter().map(|t| format!("{} deg", t + 77.0)).collect();
    json!({"synthesis": "path", "points": turns.iter().map(place).collect::<Vec<_>>(), "timing": timing})
}

#[test]
fn linkages_are_found_from_timed_places() {
    let mut r = Mixed(31);
    for count in [8, 10, 12, 18, 24, 9] {
        // A frame close to the sum of the others passes near its dead centres: no course uses such
        // a linkage.
        let l = crank_rocker(&mut r);
        let turns: Vec<f64> = (0..count)
            .map(|k| 360.0 * f64::from(k) / f64::from(count) + r.between(-5.0, 5.0))
            .collect();
        let task = task(&mut r, l, &turns);
        let design = design(&task);
        let lengths = [("AB", l[0]), ("BC", l[1]), ("CD", l[2]), ("AD", l[3])];
        assert!(design.candidates.iter().any(|c| is(c, &lengths)), "{task}: {l:?}");
        // The cognate with the same crank rotation does the same, at the same angles.
        assert!(design.candidates.len() >= 2, "{task}");
        for c in design.candidates.iter().filter(|c| c.draft.error < 1e-12) {
            assert_eq!(c.judged.defects, [], "{task}");
            assert!(c.judged.off_m <= 1e-12 * c.judged.size_m, "{task}");
            let first = c.draft.wanted[0].driver;
            for (w, turn) in c.draft.wanted.iter().zip(&turns) {
                assert!(
                    (w.driver - first - (turn - turns[0]).to_radians()).abs() < 1e-12,
                    "{task}"
                );
            }
        }
    }
}

/// Also clockwise rotation; and more unknowns than the places determine: some linkage reaches five
/// places.
#[test]
fn the_crank_may_turn_clockwise() {
    let mut r = Mixed(32);
    let l = crank_rocker(&mut r);
    let task = task(&mut r, l, &[0.0, -35.0, -80.0, -120.0, -160.0, -230.0, -270.0, -310.0]);
    let design = design(&task);
    assert!(
        design
            .candidates
            .iter()
            .any(|c| is(c, &[("AB", l[0]), ("BC", l[1]), ("CD", l[2]), ("AD", l[3])])),
        "{task}: {l:?}"
    );
}

#[test]
fn a_timing_that_cannot_be_is_reported() {
    let points: Vec<Json> =
        (0..6).map(|k| json!([mm(10.0 * f64::from(k)), mm(f64::from(k * k))])).collect();
    let with = |points: &[Json], timing: Json| json!({"synthesis": "path", "points": points, "timing": timing});
    let six = ["0 deg", "20 deg", "40 deg", "60 deg", "80 deg", "100 deg"];
    let mut three = with(&points[..3], json!(six[..3]));
    three.as_object_mut().unwrap().extend(
        json!({"ground": {"A": [0, 0], "D": ["100 mm", 0]}, "crank": "30 mm", "BE": "60 mm"})
            .as_object()
            .unwrap()
            .clone(),
    );
    for (task, code) in [
        (with(&points, json!(six[..4])), "wrong-count"),
        (
            with(&points, json!(["0 deg", "20 deg", "40 deg", "380 deg", "80 deg", "100 deg"])),
            "precision-points-coincide",
        ),
        (
            with(&points, json!(["0 deg", "20 mm", "40 deg", "60 deg", "80 deg", "100 deg"])),
            "dimension",
        ),
        (three, "wrong-given"),
    ] {
        let faults = read(task.to_string())
            .and_then(|t| solve(&t.value))
            .err()
            .unwrap_or_else(|| panic!("{task} has a solution"));
        assert!(faults.list.iter().any(|d| d.code == code), "{task}: {faults}");
        faults.list.iter().for_each(|d| assert_eq!(d.english_in_chinese(), None, "{d}"));
    }
}
