//! Limits and places from random linkages: both limits of C, three places at given rotations of the
//! crank, four and five places, places of two points of the coupler. The linkage is among the
//! candidates.

use crate::{Mixed, angle, at, crank_rocker, design, found, is, mm};
use hodograph::synthesis::{construct, read, solve};
use serde_json::{Value as Json, json};
use std::f64::consts::PI;

#[test]
fn crank_rockers_and_slider_cranks_are_found_from_their_limits() {
    let mut r = Mixed(61);
    for _ in 0..20 {
        let [a, b, c, d] = crank_rocker(&mut r);
        // Stretched and folded: the triangles A C D; the rocker is above AD.
        let limits = [b + a, b - a].map(|reach| angle(c, d, reach));
        let lengths = [("AB", a), ("BC", b), ("CD", c), ("AD", d)];
        let by_angles = json!({"synthesis": "limits", "linkage": "crank-rocker", "rocker": mm(c), "frame": mm(d),
            "angles": limits.map(|q| format!("{q} rad"))});
        found(&by_angles, &lengths);
        let turn = r.between(0.0, 6.0);
        let place = |x: f64, y: f64| {
            json!([
                mm(x * turn.cos() - y * turn.sin() + 12.0),
                mm(x * turn.sin() + y * turn.cos() - 7.0)
            ])
        };
        let [c1, c2] = limits.map(|q| place(d - c * q.cos(), c * q.sin()));
        let places = json!({"A": place(0.0, 0.0), "D": place(d, 0.0), "C1": c1, "C2": c2});
        found(
            &json!({"synthesis": "limits", "linkage": "crank-rocker", "places": places}),
            &lengths,
        );
        let mut free = places.clone();
        free.as_object_mut().unwrap().remove("D");
        found(
            &json!({"synthesis": "limits", "linkage": "crank-rocker", "places": free, "rocker": mm(c)}),
            &lengths,
        );
        // A slider-crank with its guide at the offset e.
        let e = r.between(5.0, (b - a) * 0.9);
        let [x1, x2] = [b + a, b - a].map(|reach| (reach * reach - e * e).sqrt());
        let places = json!({"A": place(0.0, 0.0), "C1": place(x1, e), "C2": place(x2, e)});
        found(
            &json!({"synthesis": "limits", "linkage": "slider-crank", "places": places}),
            &[("AB", a), ("BC", b), ("e", e), ("H", x1 - x2)],
        );
    }
}

/// E of a coupler with its place in the coupler's frame.
fn coupler_point(l: [f64; 4], crank: f64, [u, v]: [f64; 2]) -> Json {
    let [b, c] = at(l, crank);
    let w = [(c[0] - b[0]) / l[1], (c[1] - b[1]) / l[1]];
    json!([mm(b[0] + w[0] * u - w[1] * v), mm(b[1] + w[1] * u + w[0] * v)])
}

#[test]
fn linkages_are_found_from_three_places_at_given_turns() {
    let mut r = Mixed(62);
    for _ in 0..20 {
        let (l, e, start) = (
            crank_rocker(&mut r),
            [r.between(20.0, 100.0), r.between(20.0, 80.0)],
            r.between(0.0, 6.0),
        );
        let cranks = [start, start + r.between(0.3, 0.9), start + r.between(1.2, 2.0)];
        let task = json!({"synthesis": "path", "points": cranks.map(|t| coupler_point(l, t, e)),
            "timing": cranks.map(|t| format!("{} rad", t - start + 0.7)), "ground": {"A": [mm(0.0), mm(0.0)], "D": [mm(l[3]), mm(0.0)]}});
        found(&task, &[("AB", l[0]), ("BC", l[1]), ("CD", l[2]), ("BE", e[0].hypot(e[1]))]);
    }
}

/// For four places at given rotations of the crank, lines for A and D are given, for five nothing
/// more; every linkage found does the task, and its construction measures the values of the
/// formula.
#[test]
fn linkages_are_found_from_four_and_five_places_at_given_turns() {
    let mut r = Mixed(64);
    for _ in 0..8 {
        let (l, e, start) = (
            crank_rocker(&mut r),
            [r.between(20.0, 100.0), r.between(20.0, 80.0)],
            r.between(0.0, 6.0),
        );
        let turns = [
            0.0,
            r.between(0.4, 0.9),
            r.between(1.3, 2.0),
            r.between(2.6, 3.4),
            r.between(4.0, 5.2),
        ];
        let task = |count: usize| {
            json!({"synthesis": "path", "points": turns[..count].iter().map(|t| coupler_point(l, start + t, e)).collect::<Vec<_>>(),
                "timing": turns[..count].iter().map(|t| format!("{t} rad")).collect::<Vec<_>>()})
        };
        let wanted =
            [("AB", l[0]), ("BC", l[1]), ("CD", l[2]), ("AD", l[3]), ("BE", e[0].hypot(e[1]))];
        found(&task(5), &wanted);
        let mut four = task(4);
        four["line"] = json!({"through": [mm(l[3]), mm(0.0)], "angle": "70 deg"});
        four["line_A"] = json!({"through": [mm(0.0), mm(0.0)], "angle": "-20 deg"});
        found(&four, &wanted);
        for task in [task(5), four] {
            let read = read(task.to_string()).unwrap().value;
            let best = &solve(&read).unwrap().candidates[0];
            let board = construct(&read, best, 0.002).unwrap().expect("what is met is constructed");
            let off = board
                .readings
                .iter()
                .map(|m| (board.value(m) - best.number(&m.name).unwrap()).abs());
            assert!(board.readings.len() >= 5 && off.fold(0.0, f64::max) < 1e-9, "{task}");
        }
    }
}

#[test]
fn linkages_are_found_from_four_and_five_places_with_crank_and_be() {
    let mut r = Mixed(63);
    for count in [4, 5] {
        for _ in 0..8 {
            let (l, e, start) = (
                crank_rocker(&mut r),
                [r.between(20.0, 100.0), r.between(20.0, 80.0)],
                r.between(0.0, 6.0),
            );
            let points: Vec<Json> =
                (0..count).map(|k| coupler_point(l, start + 0.5 * f64::from(k), e)).collect();
            let mut task = json!({"synthesis": "path", "points": points, "ground": {"A": [mm(0.0), mm(0.0)]}, "crank": mm(l[0]),
                "BE": mm(e[0].hypot(e[1]))});
            if count == 4 {
                task["line"] = json!({"through": [mm(l[3]), mm(0.0)], "angle": "70 deg"});
            }
            let design = design(&task);
            let lengths = [("AB", l[0]), ("BC", l[1]), ("CD", l[2]), ("AD", l[3])];
            let near = |n: &str, v: f64, c: &hodograph::synthesis::DesignCandidate| {
                (c.number(n).unwrap() * 1e3 - v).abs() < 1e-6 * v
            };
            assert!(
                design.candidates.iter().any(|c| lengths.iter().all(|(n, v)| near(n, *v, c))),
                "{task}: {l:?}"
            );
        }
    }
}

#[test]
fn positions_by_two_points_are_those_by_angles() {
    let mut r = Mixed(64);
    for _ in 0..10 {
        let l = crank_rocker(&mut r);
        let of = |count: i32| -> Vec<Json> {
            let place = |p: [f64; 2]| json!([mm(p[0]), mm(p[1])]);
            let one = |k: i32| {
                let [b, c] = at(l, 0.4 + 0.5 * f64::from(k));
                json!({"B": place(b), "C": place(c)})
            };
            (0..count).map(one).collect()
        };
        let lengths = [("AB", l[0]), ("BC", l[1]), ("CD", l[2]), ("AD", l[3])];
        found(&json!({"synthesis": "body", "positions": of(3)}), &lengths);
        let four = design(
            &json!({"synthesis": "body", "positions": of(4), "line": {"through": [mm(0.0), mm(0.0)]}}),
        );
        assert!(
            four.candidates.iter().any(|c| lengths.iter().all(|(n, v)| (c.number(n).unwrap()
                * 1e3
                - v)
                .abs()
                < 1e-6 * v)),
            "{l:?}"
        );
    }
    // Coordinates rounded as in a book are accepted with a note; points that do not fit are
    // refused.
    let with = |x: &str| {
        json!({"synthesis": "body", "positions": [{"B": [mm(0.0), mm(0.0)], "C": [mm(60.0), mm(0.0)]},
        {"B": [mm(60.0), mm(35.0)], "C": ["116.38 mm", "55.52 mm"]}, {"B": [mm(95.0), mm(95.0)], "C": [x, "144.15 mm"]}]})
    };
    assert!(read(with("129.41 mm").to_string()).unwrap().notes.iter().any(|d| d.code == "rounded"));
    let faults = read(with("120 mm").to_string()).unwrap_err();
    assert!(faults.list.iter().any(|d| d.code == "wrong-given" && d.span.is_some()), "{faults}");
}

/// Each of these is refused, with the possible input, in both languages.
#[test]
fn limits_and_places_that_cannot_be_are_reported() {
    let zero = json!([mm(0.0), mm(0.0)]);
    let places = json!([
        coupler_point([40.0, 120.0, 100.0, 130.0], 0.5, [30.0, 40.0]),
        zero,
        [mm(50.0), mm(20.0)],
        [mm(10.0), mm(90.0)]
    ]);
    for (task, code) in [
        (
            json!({"synthesis": "limits", "linkage": "crank-rocker", "rocker": mm(50.0), "frame": mm(100.0), "angles": ["80 deg", "80 deg"]}),
            "out-of-range",
        ),
        (
            json!({"synthesis": "limits", "linkage": "crank-rocker", "places": {"A": zero, "C1": [mm(60.0), mm(50.0)], "C2": [mm(60.0), mm(-50.0)],
            "D": [mm(90.0), mm(0.0)]}}),
            "no-real-solution",
        ),
        (
            json!({"synthesis": "limits", "linkage": "crank-rocker", "places": {"A": zero, "C1": [mm(60.0), mm(50.0)], "C2": [mm(90.0), mm(50.0)],
            "D": [mm(0.0), mm(20.0)]}}),
            "wrong-given",
        ),
        (
            json!({"synthesis": "limits", "linkage": "slider-crank", "places": {"A": zero, "C1": [mm(60.0), mm(50.0)]}}),
            "missing-key",
        ),
        (
            json!({"synthesis": "path", "points": places, "ground": {"A": zero}, "crank": mm(30.0), "BE": mm(60.0)}),
            "missing-key",
        ),
        (
            json!({"synthesis": "path", "points": places, "ground": {"A": zero, "D": [mm(90.0), mm(0.0)]}, "crank": mm(30.0), "BE": mm(60.0)}),
            "wrong-given",
        ),
        (
            json!({"synthesis": "path", "points": [places[0], places[1], places[2], places[3]], "timing": ["0 deg", "30 deg", "60 deg", "90 deg"],
            "crank": mm(30.0), "line": {"through": zero}}),
            "wrong-given",
        ),
        (
            json!({"synthesis": "path", "points": [places[0], places[1], places[2]], "timing": ["0 deg", "30 deg", "60 deg"], "crank": mm(30.0),
            "ground": {"A": zero, "D": [mm(90.0), mm(0.0)]}}),
            "wrong-given",
        ),
        (
            json!({"synthesis": "path", "points": [places[0], places[1], places[2]], "side": {"B": ["left of AE", "right of AE"]}, "crank": mm(30.0),
            "BE": mm(60.0), "ground": {"A": zero, "D": [mm(90.0), mm(0.0)]}}),
            "wrong-count",
        ),
    ] {
        let faults = read(task.to_string())
            .and_then(|t| solve(&t.value))
            .err()
            .unwrap_or_else(|| panic!("{task} has a solution"));
        assert!(faults.list.iter().any(|d| d.code == code), "{task}: {faults}");
        faults.list.iter().for_each(|d| assert_eq!(d.english_in_chinese(), None, "{d}"));
    }
}

/// θ = ∠C₁AC₂, and K from it, agree with the whole motion.
#[test]
fn the_treadle_of_a_course() {
    let design = design(
        &json!({"synthesis": "limits", "linkage": "crank-rocker", "rocker": mm(500.0), "frame": mm(1000.0), "angles": ["80 deg", "100 deg"]}),
    );
    let far = [80.0_f64, 100.0]
        .map(|q| (500.0_f64.powi(2) + 1000.0_f64.powi(2) - 1e6 * q.to_radians().cos()).sqrt());
    let c = &design.candidates[0];
    assert!(
        is(c, &[("AB", (far[1] - far[0]) / 2.0), ("BC", (far[0] + far[1]) / 2.0)])
            && c.judged.defects.is_empty()
    );
    let theta = c.number("theta").unwrap();
    assert!((c.judged.time_ratio.unwrap() - (PI + theta) / (PI - theta)).abs() < 1e-9);
}

/// Lengths have the unit of the file's answers, and so do those of the scene.
#[test]
fn answers_have_the_units_of_the_file() {
    let text =
        json!({"synthesis": "limits", "linkage": "crank-rocker", "rocker": "5 in", "frame": "10 in", "angles": ["80 deg", "100 deg"],
        "answers": {"length": "in"}})
        .to_string();
    let task = read(&text).unwrap().value;
    let design = solve(&task).unwrap();
    let told = hodograph::report::synthesis::text(&task, &design, hodograph::scene::Lang::En);
    assert!(told.contains("CD = 5.00000 in"), "{told}");
    let stated = task.statement();
    assert!(stated.given.iter().any(|g| g.en.contains("l_{CD} = 5 in")), "{stated:?}");
    assert!(
        task.proof(&design.candidates[0])
            .iter()
            .all(|p| p.formulas.iter().all(|f| !f.contains(" mm") && !f.contains('\u{2983}')))
    );
    assert!(design.candidates[0].scene_text().contains(r#""answers": {"length": "in"}"#));
}

/// K, swing and the least transmission angle of a random crank-rocker lead back to it, whichever of
/// its lengths gives the size.
#[test]
fn crank_rockers_are_found_from_their_least_transmission_angle() {
    let mut r = Mixed(65);
    for _ in 0..12 {
        let [a, b, c, d] = crank_rocker(&mut r);
        let theta = (angle(b + a, d, c) - angle(b - a, d, c)).abs();
        let swing = (angle(c, d, b + a) - angle(c, d, b - a)).abs();
        let gamma = [d - a, d + a]
            .map(|e| angle(b, c, e))
            .map(|m| m.min(PI - m))
            .into_iter()
            .fold(PI, f64::min);
        for (key, length) in [("rocker", c), ("frame", d), ("crank", a)] {
            let mut task = json!({"synthesis": "time-ratio", "linkage": "crank-rocker", "K": (PI + theta) / (PI - theta),
                "swing": format!("{swing} rad"), "gamma": format!("{gamma} rad")});
            task[key] = mm(length);
            let design = design(&task);
            let lengths = [("AB", a), ("BC", b), ("CD", c), ("AD", d)];
            let same = |c: &hodograph::synthesis::DesignCandidate| {
                lengths.iter().all(|(n, v)| (c.number(n).unwrap() * 1e3 - v).abs() < 1e-6 * v)
            };
            assert!(design.candidates.iter().any(same), "{task}: {lengths:?}");
            for c in &design.candidates {
                assert!(
                    (c.judged.transmission.unwrap().0 - gamma).abs() < 1e-9,
                    "{task}: {:?}",
                    c.judged.transmission
                );
            }
        }
    }
    let far = json!({"synthesis": "time-ratio", "linkage": "crank-rocker", "K": 1.4, "swing": "50 deg", "gamma": "70 deg", "rocker": mm(50.0)});
    let faults = read(far.to_string()).and_then(|t| solve(&t.value)).unwrap_err();
    assert!(
        faults.list.iter().any(|d| d.code == "no-real-solution" && d.help.is_some()),
        "{faults}"
    );
}
