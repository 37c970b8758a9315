//! Synthesis: designs compared with answers that were computed without this project, random
//! linkages found again, impossible tasks.

use hodograph::synthesis::{Design, DesignCandidate, read, solve};
use serde_json::{Value as Json, json};

fn design(task: &Json) -> Result<Design, String> {
    let task = read(task.to_string()).map_err(|f| f.to_string())?.value;
    solve(&task).map_err(|f| f.to_string())
}

/// A number of a candidate, of the task, or of the judgement.
fn number(design: &Design, c: &DesignCandidate, name: &str) -> Option<f64> {
    let of_task = || design.numbers.iter().find(|n| n.name == name).map(|n| n.value);
    match name {
        "transmission" => c.judged.transmission.map(|t| t.0),
        _ => c.number(name).or_else(of_task),
    }
}

/// The deviations of a candidate from the answers, divided by the tolerance.
fn off(
    design: &Design,
    c: &DesignCandidate,
    wanted: &serde_json::Map<String, Json>,
) -> Vec<(String, f64)> {
    let scale = wanted.values().filter_map(Json::as_f64).map(f64::abs).fold(0.0, f64::max);
    let of = |(name, exact): (&String, &Json)| {
        let exact = exact.as_f64().unwrap();
        let real = number(design, c, name).unwrap_or(f64::NAN);
        (name.clone(), (real - exact).abs() / exact.abs().max(1e-3 * scale))
    };
    wanted.iter().map(of).collect()
}

#[test]
fn cases_are_met() {
    let cases: Vec<Json> = serde_json::from_str(include_str!("synthesis/cases.json")).unwrap();
    assert!(cases.len() > 10);
    met(&cases);
}

/// All kinds with other numbers, computed from the linkages and formulas with complex numbers,
/// outside this project.
#[test]
fn further_cases_are_met() {
    let cases: Vec<Json> = serde_json::from_str(include_str!("synthesis/further.json")).unwrap();
    assert!(cases.len() > 15);
    met(&cases);
}

fn met(cases: &[Json]) {
    for case in cases {
        let id = case["id"].as_str().unwrap();
        let design = design(&case["task"]).unwrap_or_else(|e| panic!("{id}: {e}"));
        let wanted = case["numbers"].as_object().unwrap();
        let tolerance = case["tolerance"].as_f64().unwrap();
        let worst = |c: &DesignCandidate| {
            off(&design, c, wanted)
                .iter()
                .map(|o| if o.1.is_nan() { f64::INFINITY } else { o.1 })
                .fold(0.0, f64::max)
        };
        let best = design.candidates.iter().min_by(|a, b| worst(a).total_cmp(&worst(b))).unwrap();
        assert!(worst(best) <= tolerance, "{id}: {:?}", off(&design, best, wanted));
        for code in case["defects"].as_array().unwrap() {
            let all: Vec<&str> = best.judged.defects.iter().map(|d| d.code).collect();
            assert!(all.contains(&code.as_str().unwrap()), "{id}: {all:?}");
        }
        pairs_are_found(&design, case);
        reached(&design, id);
    }
}

/// All Burmester pairs are found, in any order.
fn pairs_are_found(design: &Design, case: &Json) {
    for pair in case["pairs"].as_array().into_iter().flatten() {
        let exact: Vec<f64> =
            pair.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
        let of = |k: usize, name: &str| {
            design
                .numbers
                .iter()
                .find(|n| {
                    n.name == format!("{}_{k}_{}", &name[..name.len() - 2], &name[name.len() - 1..])
                })
                .map(|n| n.value)
        };
        let size = exact.iter().map(|v| v.abs()).fold(0.0, f64::max);
        let near = (1..=4).any(|k| {
            let found: Option<Vec<f64>> =
                ["pin_x", "pin_y", "centre_x", "centre_y"].iter().map(|n| of(k, n)).collect();
            found.is_some_and(|f| f.iter().zip(&exact).all(|(f, e)| (f - e).abs() <= 1e-10 * size))
        });
        assert!(near, "{}: {exact:?}", case["id"]);
    }
}

/// A scene performs its task to 1e-12 of its size, except for positions that are reported as
/// defects.
fn reached(design: &Design, id: &str) {
    for c in &design.candidates {
        assert!(
            c.judged.off_m <= 1e-12 * c.judged.size_m,
            "{id}: {} of {}",
            c.judged.off_m,
            c.judged.size_m
        );
        for d in c.notes() {
            assert_eq!(d.english_in_chinese(), None, "{id}: {d}");
        }
    }
}

/// A pseudo-random generator (splitmix64).
struct Mixed(u64);

impl Mixed {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

/// A random crank-rocker: its lengths in mm, and B, C at crank angles.
struct Linkage([f64; 4]);

impl Linkage {
    fn random(r: &mut Mixed) -> Linkage {
        loop {
            let l = [
                r.between(20.0, 60.0),
                r.between(80.0, 250.0),
                r.between(80.0, 250.0),
                r.between(80.0, 250.0),
            ];
            let longest = l[1].max(l[2]).max(l[3]);
            if 2.0 * (l[0] + longest) < 0.97 * l.iter().sum::<f64>() {
                return Linkage(l);
            }
        }
    }

    /// B, C in mm, A at the origin, D on the x axis, C left of BD.
    fn at(&self, crank: f64) -> [[f64; 2]; 2] {
        let [a, b, c, d] = self.0;
        let p = [a * crank.cos(), a * crank.sin()];
        let (x, y) = (d - p[0], -p[1]);
        let l = x.hypot(y);
        let along = (l * l + b * b - c * c) / (2.0 * l);
        let high = (b * b - along * along).sqrt();
        [p, [p[0] + (x * along - y * high) / l, p[1] + (y * along + x * high) / l]]
    }

    /// The follower's angle, C left (1) or right (−1) of BD.
    fn follower(&self, crank: f64, side: f64) -> f64 {
        let [_, b, c, d] = self.0;
        let [p, _] = self.at(crank);
        let (x, y) = (d - p[0], -p[1]);
        let l = x.hypot(y);
        let along = (l * l + b * b - c * c) / (2.0 * l);
        let high = side * (b * b - along * along).sqrt();
        (p[1] + (y * along + x * high) / l).atan2(p[0] + (x * along - y * high) / l - d)
    }
}

fn is(c: &DesignCandidate, lengths: [f64; 4]) -> bool {
    ["AB", "BC", "CD", "AD"]
        .iter()
        .zip(lengths)
        .all(|(n, l)| c.number(n).is_some_and(|v| (v * 1e3 - l).abs() < 1e-7 * l))
}

#[test]
fn a_random_linkage_is_found_from_what_it_does() {
    let mut r = Mixed(20);
    for _ in 0..12 {
        let linkage = Linkage::random(&mut r);
        let start = r.between(0.0, 6.0);
        let cranks: Vec<f64> =
            (0..5).map(|k| start + 0.35 * k as f64 * r.between(0.8, 1.2)).collect();
        let at: Vec<[[f64; 2]; 2]> = cranks.iter().map(|t| linkage.at(*t)).collect();
        let position = |[b, c]: &[[f64; 2]; 2]| {
            json!([
                format!("{} mm", b[0]),
                format!("{} mm", b[1]),
                format!("{} rad", (c[1] - b[1]).atan2(c[0] - b[0]))
            ])
        };
        let positions: Vec<Json> = at.iter().map(position).collect();
        let d = linkage.0[3];
        for (count, extra) in [
            (
                3,
                json!({"moving": {"B": ["0 mm", "0 mm"], "C": [format!("{} mm", linkage.0[1]), "0 mm"]}}),
            ),
            (3, json!({"ground": {"A": ["0 mm", "0 mm"], "D": [format!("{d} mm"), "0 mm"]}})),
            (4, json!({"line": {"through": ["0 mm", "0 mm"], "angle": "0 deg"}})),
            (5, json!({})),
        ] {
            let mut task = json!({"synthesis": "body", "positions": positions[..count]});
            task.as_object_mut().unwrap().extend(extra.as_object().unwrap().clone());
            let design = design(&task).unwrap_or_else(|e| panic!("{task}: {e}"));
            assert!(
                design.candidates.iter().any(|c| is(c, linkage.0)),
                "{:?} {count}: {task}",
                linkage.0
            );
            reached(&design, "random");
        }
        let angles = |k: usize| {
            json!([
                format!("{} rad", cranks[k]),
                format!("{} rad", (at[k][1][1]).atan2(at[k][1][0] - d))
            ])
        };
        for (count, relative) in [(3, "none"), (4, "output"), (5, "both")] {
            let mut task = json!({"synthesis": "function", "frame": format!("{d} mm"), "pairs": (0..count).map(angles).collect::<Vec<_>>()});
            if relative != "none" {
                task["relative"] = json!(relative);
            }
            let design = design(&task).unwrap_or_else(|e| panic!("{task}: {e}"));
            assert!(
                design.candidates.iter().any(|c| is(c, linkage.0)),
                "{:?} {relative}: {task}",
                linkage.0
            );
        }
    }
}

#[test]
fn bad_wishes_are_reported_with_the_nearest_that_works() {
    let mm = |p: &[[f64; 3]]| {
        p.iter()
            .map(|[x, y, a]| json!([format!("{x} mm"), format!("{y} mm"), format!("{a} deg")]))
            .collect::<Vec<_>>()
    };
    for (task, code, help) in [
        (
            json!({"synthesis": "time-ratio", "linkage": "crank-rocker", "K": 12, "rocker": "50 mm", "swing": "10 deg"}),
            "no-real-solution",
            "K is below",
        ),
        (
            json!({"synthesis": "time-ratio", "linkage": "slider-crank", "K": 1.5, "stroke": "50 mm", "offset": "90 mm"}),
            "no-real-solution",
            "lies between",
        ),
        (
            json!({"synthesis": "body", "positions": mm(&[[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [25.0, 0.0, 30.0]]), "moving": {"B": [0, 0], "C": ["30 mm", 0]}}),
            "no-real-solution",
            "straight",
        ),
        (
            json!({"synthesis": "body", "positions": mm(&[[0.0, 0.0, 0.0], [10.0, 0.0, 5.0], [0.0, 0.0, 0.0]]), "moving": {"B": [0, 0], "C": ["30 mm", 0]}}),
            "precision-points-coincide",
            "leave one",
        ),
        (
            json!({"synthesis": "function", "pairs": [["10 deg", "0 deg"], ["10 deg", "9 deg"], ["40 deg", "20 deg"]]}),
            "precision-points-coincide",
            "leave one",
        ),
        (
            json!({"synthesis": "path", "points": [["500 mm", 0], ["400 mm", "10 mm"], ["300 mm", 0]], "ground": {"A": [0, 0], "D": ["100 mm", 0]}, "crank": "30 mm", "BE": "60 mm"}),
            "no-real-solution",
            "\"BE\": \"",
        ),
        (json!({"synthesis": "function", "points": 3}), "missing-key", "function"),
        (json!({"synthesis": "bodies"}), "unknown-kind", "did you mean"),
        (
            json!({"synthesis": "time-ratio", "linkage": "crank-rocker", "K": -1, "rocker": "0 mm"}),
            "not-positive",
            "",
        ),
    ] {
        let found = read(task.to_string()).and_then(|t| solve(&t.value));
        let faults = found.err().unwrap_or_else(|| panic!("{task} has a solution"));
        let d = faults
            .list
            .iter()
            .find(|d| d.code == code)
            .unwrap_or_else(|| panic!("{task}: {faults}"));
        assert!(d.to_string().contains(help), "{task}: {d}");
        faults.list.iter().for_each(|d| assert_eq!(d.english_in_chinese(), None, "{d}"));
    }
}

#[test]
fn a_hopeless_time_ratio_is_reported_with_one_that_works() {
    let task = json!({"synthesis": "time-ratio", "linkage": "crank-rocker", "K": 3, "rocker": "50 mm", "swing": "10 deg"});
    let notes = design(&task).unwrap().notes;
    let note = notes.iter().find(|n| n.code == "poor-transmission").unwrap();
    assert!(note.to_string().contains("and less has one"), "{note}");
}

/// The course design y = ln x: three pairs of angles from given starts. The ratios and the output's
/// angles are those of longer arithmetic; the printed ones come from single precision.
#[test]
fn the_course_design_of_ln_x() {
    let pairs =
        json!([["4.02 deg", "7.97 deg"], ["30 deg", "49.68 deg"], ["55.98 deg", "80.83 deg"]]);
    let task = json!({"synthesis": "function", "pairs": pairs, "input": {"from": "86 deg"}, "output": {"from": "24 deg"}, "crank": "1 m"});
    let design = design(&task).unwrap();
    let [c] = design.candidates.as_slice() else {
        panic!("{} candidates", design.candidates.len())
    };
    let length = |name: &str| c.number(name).unwrap();
    let [a, coupler, follower, frame] = ["AB", "BC", "CD", "AD"].map(length);
    for (value, exact) in
        [(follower / a, 0.601242463656), (frame / a, 1.30404030807), (coupler / a, 1.93825795144)]
    {
        assert!((value - exact).abs() < 1e-11 * exact, "{value} {exact}");
    }
    // Freudenstein's p₀ = m, p₁ = −m/n, p₂ = (m² + n² + 1 − l²)/(2n) with the crank as unit.
    let (m, n, l) = (follower / a, frame / a, coupler / a);
    for (value, exact) in [
        (m, 0.601242463656),
        (-m / n, -0.461061257028),
        ((m * m + n * n + 1.0 - l * l) / (2.0 * n), -0.266414410979),
    ] {
        assert!((value - exact).abs() < 1e-11, "{value} {exact}");
    }
    for (turn, exact) in
        [(0.0, -0.296148174806), (4.02, 7.97), (30.0, 49.68), (55.98, 80.83), (60.0, 84.9091472051)]
    {
        let linkage = Linkage([a, coupler, follower, frame]);
        // The assembly of the design: with C left or right of BD, one of the two gives the
        // follower's angle.
        let near = [1.0, -1.0].map(|side| {
            linkage.follower((86.0f64 + turn).to_radians(), side).to_degrees() - 24.0 - exact
        });
        let off = near
            .map(|o| (o + 180.0).rem_euclid(360.0) - 180.0)
            .into_iter()
            .map(f64::abs)
            .fold(f64::MAX, f64::min);
        assert!(off < 1e-8, "{turn}: {off}");
    }
    let both = json!({"synthesis": "function", "pairs": pairs, "input": {"from": "86 deg"}, "relative": "input"});
    assert!(self::design(&both).unwrap_err().contains("leave out"));
    let count = json!({"synthesis": "function", "pairs": pairs, "points": 3});
    assert!(self::design(&count).unwrap_err().contains("`points` has no meaning beside `pairs`"));
}

/// Precision points by Chebyshev's spacing, with their values and rotations.
#[test]
fn precision_points_are_reported_with_their_turns() {
    let told = |y: &str, [from, to]: [f64; 2], swings: [&str; 2]| {
        let task = json!({"synthesis": "function", "function": {"y": y, "from": from, "to": to}, "points": 3,
            "input": {"from": "86 deg", "swing": swings[0]}, "output": {"from": "24 deg", "swing": swings[1]}});
        design(&task).unwrap()
    };
    let off = |design: &Design, name: &str, exact: f64, unit: f64| {
        let value = design
            .numbers
            .iter()
            .find(|n| n.name == name)
            .unwrap_or_else(|| panic!("{name}"))
            .value
            / unit;
        assert!((value - exact).abs() < 1e-11 * exact.abs(), "{name}: {value}, {exact}");
    };
    let degree = 1f64.to_radians();
    let ln = told("ln(x)", [1.0, 2.0], ["60 deg", "85 deg"]);
    for (name, exact, unit) in [
        ("x1", 1.06698729811, 1.0),
        ("x2", 1.5, 1.0),
        ("x3", 1.93301270189, 1.0),
        ("alpha1", 4.01923788647, degree),
        ("alpha2", 30.0, degree),
        ("alpha3", 55.9807621135, degree),
    ] {
        off(&ln, name, exact, unit);
    }
    let power = told("x^1.5", [1.0, 4.0], ["90 deg", "90 deg"]);
    let turns = [
        36.0288568297 - 30.0,
        75.0 - 30.0,
        113.971143170 - 30.0,
        94.0643358218 - 90.0,
        127.965176681 - 90.0,
        172.346801968 - 90.0,
    ];
    let names = ["alpha1", "alpha2", "alpha3", "phi1", "phi2", "phi3"];
    for (name, exact, unit) in [
        ("x1", 1.20096189432, 1.0),
        ("x3", 3.79903810568, 1.0),
        ("y1", 1.31611500836, 1.0),
        ("y2", 3.95284707521, 1.0),
        ("y3", 7.40475126421, 1.0),
    ]
    .into_iter()
    .chain(names.into_iter().zip(turns).map(|(n, t)| (n, t, degree)))
    {
        off(&power, name, exact, unit);
    }
}

/// Two pairs with crank and frame: C₁ on the bisector of B₁B₂′ and on the follower's direction, as
/// course books construct it.
#[test]
fn two_pairs_with_crank_and_frame_have_one_linkage() {
    let pairs = json!([["45 deg", "60 deg"], ["90 deg", "100 deg"]]);
    let task =
        json!({"synthesis": "function", "pairs": pairs, "frame": "100 mm", "crank": "40 mm"});
    let found = design(&task).unwrap();
    let c = &found.candidates[0];
    // By hand: B₁ and the inverted B₂′ are at the same distance from C₁.
    let (sin, cos) = (|d: f64| d.to_radians().sin(), |d: f64| d.to_radians().cos());
    let b1 = [40.0 * cos(45.0), 40.0 * sin(45.0)];
    let [x, y] = [40.0 * cos(90.0) - 100.0, 40.0 * sin(90.0)];
    let back = [100.0 + x * cos(40.0) + y * sin(40.0), -x * sin(40.0) + y * cos(40.0)];
    let off = |t: f64, p: [f64; 2]| (100.0 + t * cos(60.0) - p[0]).hypot(t * sin(60.0) - p[1]);
    let (mut low, mut high) = (1.0, 400.0);
    for _ in 0..200 {
        let t = 0.5 * (low + high);
        let same = (off(t, b1) > off(t, back)) == (off(low, b1) > off(low, back));
        (low, high) = if same { (t, high) } else { (low, t) };
    }
    assert!((number(&found, c, "CD").unwrap() * 1e3 - low).abs() < 1e-9, "{low}");
    assert!((number(&found, c, "BC").unwrap() * 1e3 - off(low, b1)).abs() < 1e-9);
    let short = json!({"synthesis": "function", "pairs": pairs, "frame": "100 mm"});
    assert!(design(&short).unwrap_err().contains("two pairs leave more"));
    let three = json!({"synthesis": "function", "pairs": [["20 deg", "35 deg"], ["50 deg", "60 deg"], ["95 deg", "90 deg"]], "frame": "100 mm", "crank": "40 mm"});
    assert!(design(&three).unwrap_err().contains("leave only the size free"));
}

/// Links with equal rotations form a parallelogram; roots at infinity are not linkages.
#[test]
fn links_that_turn_alike_are_a_parallelogram() {
    for (n, swing) in
        [(3, json!({"from": "30 deg", "swing": "60 deg"})), (5, json!({"swing": "60 deg"}))]
    {
        let task = json!({"synthesis": "function", "function": {"y": "x", "from": 1, "to": 2}, "points": n, "input": swing, "output": swing, "frame": "100 mm"});
        let found = design(&task).unwrap();
        let c = &found.candidates[0];
        assert!(
            (number(&found, c, "AB").unwrap() - number(&found, c, "CD").unwrap()).abs() < 1e-15,
            "{n}"
        );
        assert!(
            (number(&found, c, "BC").unwrap() - 0.1).abs() < 1e-15
                && number(&found, c, "error_0").is_none()
        );
    }
}

/// If the linear least-squares solution does not close at a pair, that of the angles is still
/// found.
#[test]
fn least_squares_go_on_where_the_linear_ones_do_not_close() {
    let pairs = [[20, 35], [35, 48], [50, 60], [65, 71], [80, 81], [95, 90]]
        .map(|p| p.map(|a| format!("{a} deg")));
    let found =
        design(&json!({"synthesis": "function", "pairs": pairs, "frame": "120 mm"})).unwrap();
    let worst = number(&found, &found.candidates[0], "max_error").unwrap().abs().to_degrees();
    assert!(worst < 0.7529, "{worst}");
}

/// A crank in addition to K, rocker and swing (CD = 290 mm, ψ = 32°, K = 1.25, AB = 75 mm): the
/// coupler by the law of cosines, the frame on both sides of C₁C₂.
#[test]
fn a_crank_fixes_the_linkage_of_a_time_ratio() {
    let task = json!({"synthesis": "time-ratio", "linkage": "crank-rocker", "K": 1.25, "rocker": "290 mm", "swing": "32 deg", "crank": "75 mm"});
    let found = design(&task).unwrap();
    let mut frames: Vec<f64> =
        found.candidates.iter().map(|c| number(&found, c, "AD").unwrap() * 1e3).collect();
    frames.sort_by(f64::total_cmp);
    for (frame, exact) in frames.iter().zip([278.716821600, 371.713146288]) {
        assert!((frame - exact).abs() < 1e-8, "{frames:?}");
    }
    for c in &found.candidates {
        assert!((number(&found, c, "AB").unwrap() * 1e3 - 75.0).abs() < 1e-10);
        assert!((number(&found, c, "BC").unwrap() * 1e3 - 176.014260774).abs() < 1e-8);
    }
    let long = json!({"synthesis": "time-ratio", "linkage": "crank-rocker", "K": 1.25, "rocker": "290 mm", "swing": "32 deg", "crank": "120 mm"});
    assert!(design(&long).unwrap_err().contains("no coupler closes"));
}
