//! Tasks made from random linkages: the linkage is among the candidates; and free choices of the
//! program are the best possible.

mod laid;
mod nearest;
mod places;
mod timed;
mod wishes;

use hodograph::synthesis::{Design, DesignCandidate, construct, read, solve};
use serde_json::{Value as Json, json};
use std::f64::consts::PI;

fn design(task: &Json) -> Design {
    let read = read(task.to_string()).unwrap_or_else(|f| panic!("{task}: {f}"));
    solve(&read.value).unwrap_or_else(|f| panic!("{task}: {f}"))
}

/// Pseudo-random numbers (splitmix64).
struct Mixed(u64);

impl Mixed {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        low + (high - low) * ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn mm(v: f64) -> Json {
    json!(format!("{v} mm"))
}

/// True if a candidate has these numbers (mm).
fn is(c: &DesignCandidate, wanted: &[(&str, f64)]) -> bool {
    wanted
        .iter()
        .all(|(n, v)| c.number(n).is_some_and(|found| (found * 1e3 - v).abs() < 1e-7 * v.abs()))
}

fn found(task: &Json, wanted: &[(&str, f64)]) {
    let design = design(task);
    assert!(design.candidates.iter().any(|c| is(c, wanted)), "{task}: {wanted:?}");
    for c in &design.candidates {
        assert!(
            c.judged.off_m <= 1e-12 * c.judged.size_m,
            "{task}: {} of {}",
            c.judged.off_m,
            c.judged.size_m
        );
    }
}

/// Crank, coupler, rocker, frame of a random crank-rocker (mm).
fn crank_rocker(r: &mut Mixed) -> [f64; 4] {
    loop {
        let l = [
            r.between(20.0, 60.0),
            r.between(80.0, 250.0),
            r.between(80.0, 250.0),
            r.between(80.0, 250.0),
        ];
        let longest = l[1].max(l[2]).max(l[3]);
        if 2.0 * (l[0] + longest) < 0.97 * l.iter().sum::<f64>() {
            return l;
        }
    }
}

/// The angle between two sides of a triangle.
fn angle(one: f64, other: f64, opposite: f64) -> f64 {
    ((one * one + other * other - opposite * opposite) / (2.0 * one * other)).acos()
}

#[test]
fn crank_rockers_are_found_from_their_time_ratio() {
    let mut r = Mixed(4);
    for _ in 0..20 {
        let [a, b, c, d] = crank_rocker(&mut r);
        // Stretched and folded: the triangles A C D.
        let (long, short) = (b + a, b - a);
        let theta = (angle(long, d, c) - angle(short, d, c)).abs();
        let ratio = (PI + theta) / (PI - theta);
        let swing = (angle(c, d, long) - angle(c, d, short)).abs();
        let lengths = [("AB", a), ("BC", b), ("CD", c), ("AD", d)];
        let by_limit = json!({"synthesis": "time-ratio", "linkage": "crank-rocker", "K": ratio, "rocker": mm(c), "frame": mm(d),
            "limit": format!("{} rad", angle(c, d, long))});
        found(&by_limit, &lengths);
        let by_swing = json!({"synthesis": "time-ratio", "linkage": "crank-rocker", "K": ratio, "rocker": mm(c), "frame": mm(d),
            "swing": format!("{swing} rad")});
        found(&by_swing, &lengths);
        for (key, bar) in [("crank", a), ("coupler", b)] {
            let mut by_bar = json!({"synthesis": "time-ratio", "linkage": "crank-rocker", "K": ratio, "rocker": mm(c), "swing": format!("{swing} rad")});
            by_bar[key] = mm(bar);
            let read = read(by_bar.to_string()).unwrap().value;
            let design = solve(&read).unwrap();
            let own = design
                .candidates
                .iter()
                .find(|c| is(c, &lengths))
                .unwrap_or_else(|| panic!("{by_bar}"));
            let board = construct(&read, own, 0.002).unwrap().expect("it is drawn");
            assert!(
                board
                    .readings
                    .iter()
                    .all(|m| (board.value(m) - own.number(&m.name).unwrap()).abs() < 1e-9),
                "{by_bar}"
            );
        }
    }
}

#[test]
fn slider_cranks_and_slotted_levers_are_found_from_their_time_ratio() {
    let mut r = Mixed(5);
    for _ in 0..20 {
        let (a, e) = (r.between(20.0, 60.0), r.between(5.0, 40.0));
        let b = a + e + r.between(20.0, 200.0);
        let at = |reach: f64| (reach * reach - e * e).sqrt();
        let (stroke, theta) = (at(b + a) - at(b - a), (e / (b - a)).asin() - (e / (b + a)).asin());
        let ratio = (PI + theta) / (PI - theta);
        for given in [("offset", e), ("crank", a), ("rod", b)] {
            let mut task = json!({"synthesis": "time-ratio", "linkage": "slider-crank", "K": ratio, "stroke": mm(stroke)});
            task[given.0] = mm(given.1);
            found(&task, &[("AB", a), ("BC", b), ("e", e)]);
        }
        let frame = a * r.between(1.3, 4.0);
        let theta = 2.0 * (a / frame).asin();
        let ratio = (PI + theta) / (PI - theta);
        let task = json!({"synthesis": "time-ratio", "linkage": "slotted-lever", "K": ratio, "frame": mm(frame)});
        found(&task, &[("AB", a), ("AC", frame)]);
        let inner = a * r.between(0.3, 0.8);
        // While the lever turns from one limit to the other, the crank turns by twice the angle
        // with the cosine AC/AB.
        let quick = 2.0 * (inner / a).acos();
        let task = json!({"synthesis": "time-ratio", "linkage": "whitworth", "K": 2.0 * PI / quick - 1.0, "crank": mm(a), "stroke": "100 mm"});
        found(&task, &[("AB", a), ("AC", inner)]);
        // Left to the program: the slider's stroke and link, the link to the ram.
        found(
            &json!({"synthesis": "time-ratio", "linkage": "whitworth", "K": 2.0 * PI / quick - 1.0, "frame": mm(inner)}),
            &[("AB", a), ("H", 2.0 * a)],
        );
        let task = json!({"synthesis": "time-ratio", "linkage": "shaper", "K": ratio, "frame": mm(frame), "stroke": mm(a)});
        found(&task, &[("AB", a), ("CD", a / (2.0 * (theta / 2.0).sin()))]);
    }
}

/// No offset has a smaller maximum pressure angle.
#[test]
fn the_best_slider_crank_is_the_best() {
    for (ratio, stroke) in [(1.1, 40.0), (1.2, 80.0), (1.4, 100.0)] {
        let of = |key: &str, value: Json| {
            let mut task = json!({"synthesis": "time-ratio", "linkage": "slider-crank", "K": ratio, "stroke": mm(stroke)});
            task[key] = value;
            design(&task).candidates.remove(0)
        };
        let best = of("best", json!("transmission"));
        let (alpha, e) = (best.number("alpha_max").unwrap(), best.number("e").unwrap() * 1e3);
        assert_eq!(best.judged.defects, []);
        for k in [0.7, 0.9, 0.99, 1.01, 1.1, 1.3] {
            assert!(of("offset", mm(e * k)).number("alpha_max").unwrap() > alpha, "{ratio}: {k}");
        }
    }
}

/// B and C of a crank-rocker at a crank angle, A at the origin, D on the x axis, C left of BD.
fn at([a, b, c, d]: [f64; 4], crank: f64) -> [[f64; 2]; 2] {
    let p = [a * crank.cos(), a * crank.sin()];
    let (x, y) = (d - p[0], -p[1]);
    let l = x.hypot(y);
    let along = (l * l + b * b - c * c) / (2.0 * l);
    let high = (b * b - along * along).sqrt();
    [p, [p[0] + (x * along - y * high) / l, p[1] + (y * along + x * high) / l]]
}

#[test]
fn linkages_are_found_from_three_places_of_their_coupler_point() {
    let mut r = Mixed(6);
    for _ in 0..20 {
        let l = crank_rocker(&mut r);
        let (u, v, start) = (r.between(20.0, 100.0), r.between(20.0, 80.0), r.between(0.0, 6.0));
        let place = |k: usize| {
            let [b, c] = at(l, start + 0.4 * k as f64);
            let w = [(c[0] - b[0]) / l[1], (c[1] - b[1]) / l[1]];
            json!([mm(b[0] + w[0] * u - w[1] * v), mm(b[1] + w[1] * u + w[0] * v)])
        };
        let task = json!({"synthesis": "path", "points": [place(0), place(1), place(2)],
            "ground": {"A": [mm(0.0), mm(0.0)], "D": [mm(l[3]), mm(0.0)]}, "crank": mm(l[0]), "BE": mm(u.hypot(v))});
        // B may be on either side of AE in each place, and change sides from one to the next.
        assert!(
            design(&task)
                .candidates
                .iter()
                .any(|c| is(c, &[("AB", l[0]), ("BC", l[1]), ("CD", l[2])])),
            "{task}: {l:?}"
        );
    }
}

fn four(l: [f64; 4]) -> Vec<Json> {
    let position = |k: usize| {
        let [b, c] = at(l, 0.3 + 0.4 * k as f64);
        json!([mm(b[0]), mm(b[1]), format!("{} rad", (c[1] - b[1]).atan2(c[0] - b[0]))])
    };
    (0..4).map(position).collect()
}

/// Pivots are found within their box, and all positions are reached; the best transmission angle is
/// that of the first candidate without defect.
#[test]
fn four_positions_choose_their_pivots_in_a_box() {
    let mut r = Mixed(7);
    for _ in 0..6 {
        let l = crank_rocker(&mut r);
        let task = json!({"synthesis": "body", "positions": four(l), "box": {"from": [mm(-120.0), mm(-120.0)], "to": [mm(300.0), mm(150.0)]}});
        let design = design(&task);
        for c in &design.candidates {
            for (x, y) in [("A_x", "A_y"), ("D_x", "D_y")] {
                let (x, y) = (c.number(x).unwrap() * 1e3, c.number(y).unwrap() * 1e3);
                assert!(
                    (-120.0..=300.0).contains(&x) && (-120.0..=150.0).contains(&y),
                    "{task}: {x} {y}"
                );
            }
            assert!(c.judged.off_m <= 1e-12 * c.judged.size_m, "{task}: {}", c.judged.off_m);
        }
    }
}

/// The inscribed angles of the linkage's own pivots lead to the linkage.
#[test]
fn four_positions_find_a_linkage_by_the_inscribed_angles_of_its_pivots() {
    let mut r = Mixed(8);
    for _ in 0..8 {
        let l = crank_rocker(&mut r);
        let by_line = json!({"synthesis": "body", "positions": four(l), "line": {"through": [mm(0.0), mm(0.0)], "angle": "0 deg"}});
        let poles = design(&by_line).numbers;
        let of = |n: &str| poles.iter().find(|p| p.name == n).unwrap().value * 1e3;
        let seen = |m: [f64; 2]| {
            let [p, q] = ["P12", "P23"]
                .map(|n| [of(&format!("{n}_x")) - m[0], of(&format!("{n}_y")) - m[1]]);
            (p[0] * q[1] - p[1] * q[0]).atan2(p[0] * q[0] + p[1] * q[1]).rem_euclid(PI)
        };
        let angles = [seen([0.0, 0.0]), seen([l[3], 0.0])].map(|a| format!("{a} rad"));
        let task = json!({"synthesis": "body", "positions": four(l), "angles": angles});
        let design = design(&task);
        let lengths = [("AB", l[0]), ("BC", l[1]), ("CD", l[2]), ("AD", l[3])];
        assert!(
            design.candidates.iter().any(|c| lengths.iter().all(|(n, v)| (c.number(n).unwrap()
                * 1e3
                - v)
                .abs()
                < 1e-6 * v)),
            "{task}: {l:?}"
        );
    }
}

/// Impossible demands on pivots are reported.
#[test]
fn boxes_and_angles_that_cannot_be_are_reported() {
    let l = [40.0, 120.0, 100.0, 130.0];
    for (extra, code) in [
        (
            json!({"box": {"from": [mm(900.0), mm(900.0)], "to": [mm(910.0), mm(910.0)]}}),
            "no-real-solution",
        ),
        (json!({"box": {"from": [mm(0.0), mm(0.0)], "to": [mm(0.0), mm(50.0)]}}), "out-of-range"),
        (json!({"box": {"from": [mm(0.0), mm(0.0)]}}), "missing-key"),
        (json!({"angles": ["0 deg", "50 deg"]}), "out-of-range"),
        (
            json!({"angles": ["40 deg", "50 deg"], "line": {"through": [mm(0.0), mm(0.0)]}}),
            "wrong-given",
        ),
        (
            json!({"angles": ["40 deg", "50 deg"], "box": {"from": [mm(0.0), mm(0.0)], "to": [mm(9.0), mm(9.0)]}}),
            "wrong-given",
        ),
    ] {
        let mut task = json!({"synthesis": "body", "positions": four(l)});
        task.as_object_mut().unwrap().extend(extra.as_object().unwrap().clone());
        let faults = read(task.to_string())
            .and_then(|t| solve(&t.value))
            .err()
            .unwrap_or_else(|| panic!("{task} has a solution"));
        assert!(faults.list.iter().any(|d| d.code == code), "{task}: {faults}");
        faults.list.iter().for_each(|d| assert_eq!(d.english_in_chinese(), None, "{d}"));
    }
}
