//! Cognates and straight-line linkages against reference values, and cognates of random linkages
//! against their own sweep.

#![allow(clippy::excessive_precision)] // The digits of the reference.
use hodograph::synthesis::{Design, DesignCandidate, read, solve};

fn design(task: &str) -> Design {
    let task = read(task).unwrap_or_else(|f| panic!("{f}\n{task}")).value;
    solve(&task).unwrap_or_else(|f| panic!("{f}"))
}

fn near(got: f64, expected: f64, size: f64, what: &str) {
    assert!((got - expected).abs() < 1e-10 * size, "{what}: {got}, expected {expected}");
}

const FOUR_BAR: &str = r#"{"units": {"length": "mm", "angle": "deg"}, "links": {"1": ["A", "B"], "2": ["B", "C", "E"], "3": ["C", "D"], "4": ["A", "D"]},
  "ground": "4", "lengths": {"AB": 100, "BC": 250, "CD": 200, "AD": 300, "BE": 150, "CE": 140}, "side": {"C": "left of BD", "E": "left of BC"},
  "driver": {"link": "1", "angle": 60, "omega": "10 rad/s"}, "find": ["v_E"]}"#;

#[test]
fn cognates_of_the_reference_case() {
    let design =
        design(&format!(r#"{{"synthesis": "cognates", "scene": {FOUR_BAR}, "point": "E"}}"#));
    let number = |name: &str| design.numbers.iter().find(|n| n.name == name).unwrap().value * 1e3;
    for (name, exact) in [
        ("F_x", 156.96),
        ("F_y", 88.111057194883321863),
        ("A1_x", 84.234752116908111749),
        ("A1_y", 124.11489248193805846),
        ("P1_x", 84.959280821883912808),
        ("P1_y", 184.11051780708710877),
        ("D1_x", 160.55529764947537564),
        ("D1_y", 12.456925237537243190),
        ("P2_x", 206.23547129502419894),
        ("P2_y", 114.71797224817813623),
    ] {
        near(number(name), exact, 100.0, name);
    }
    let lengths =
        |c: &DesignCandidate| ["AB", "BC", "CD", "BE", "CE"].map(|n| c.number(n).unwrap() * 1e3);
    let all: Vec<[f64; 5]> = ["given", "left", "right"]
        .iter()
        .map(|which| {
            lengths(design.candidates.iter().find(|c| c.draft.which.en.contains(which)).unwrap())
        })
        .collect();
    // A A1, A1 P1, P1 F, E A1, E P1; and F P2, P2 D1, D1 D, E P2, E D1.
    for (got, exact) in all[1].iter().zip([150.0, 60.0, 120.0, 100.0, 56.0]) {
        near(*got, exact, 100.0, "left");
    }
    for (got, exact) in all[2].iter().zip([56.0, 112.0, 140.0, 120.0, 200.0]) {
        near(*got, exact, 100.0, "right");
    }
    // The scene of the right one, swept, moves E through all positions of the given one.
    let right = design.candidates.iter().find(|c| c.draft.which.en.contains("right")).unwrap();
    assert_eq!(right.draft.wanted.len(), 8);
    assert!(
        right.judged.defects.is_empty() && right.judged.rotates && right.judged.off_m < 1e-12,
        "{:?}",
        right.judged
    );
}

/// Random four-bars: the cognate with the same crank rotation traces every point that the given one
/// traces.
#[test]
fn cognates_of_random_linkages_carry_the_same_curve() {
    let mut state = 11_u64;
    let mut random = |from: f64, to: f64| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        from + (state >> 11) as f64 / (1u64 << 53) as f64 * (to - from)
    };
    let mut seen = 0;
    for _ in 0..30 {
        let (ab, bc, cd, ad) =
            (random(20.0, 40.0), random(80.0, 120.0), random(70.0, 110.0), random(90.0, 120.0));
        let (x, y, angle) = (random(20.0, 90.0), random(-60.0, 60.0), random(0.0, 360.0));
        let scene = format!(
            r#"{{"units": {{"length": "mm", "angle": "deg"}}, "links": {{"1": ["A", "B"], "2": ["B", "C", "E"], "3": ["D", "C"], "4": ["A", "D"]}},
            "ground": "4", "points": {{"A": [0, 0], "D": [{ad}, 0], "E": {{"base": "BC", "x": {x}, "y": {y}}}}}, "lengths": {{"AB": {ab}, "BC": {bc}, "CD": {cd}}},
            "side": {{"C": "left of BD"}}, "driver": {{"link": "1", "angle": {angle}, "omega": "1 rad/s"}}, "find": ["v_E"]}}"#
        );
        let design = design(&format!(r#"{{"synthesis": "cognates", "scene": {scene}}}"#));
        let turns = design
            .candidates
            .iter()
            .find(|c| c.draft.which.en.contains("given"))
            .unwrap()
            .judged
            .rotates;
        let right = design.candidates.iter().find(|c| c.draft.which.en.contains("right")).unwrap();
        if turns {
            assert!(
                right.judged.rotates && right.judged.defects.is_empty(),
                "{scene}\n{:?}",
                right.judged
            );
            assert!(right.judged.off_m < 1e-11 * right.judged.size_m, "{:?}", right.judged);
            seen += 1;
        }
    }
    assert!(seen > 10, "{seen}");
}

#[test]
fn hoeken_by_the_reference_case() {
    let made = design(r#"{"synthesis": "straight-line", "linkage": "hoeken", "length": "4 m"}"#);
    let c = &made.candidates[0];
    let of = |name: &str| c.number(name).unwrap();
    near(of("AB"), 1.0, 1.0, "crank");
    near(of("length"), 4.0, 4.0, "length");
    near(of("least"), 4.0, 4.0, "least");
    near(of("greatest"), 4.0097537330863600058, 4.0, "greatest");
    assert!(
        c.judged.defects.is_empty() && c.judged.rotates && c.judged.off_m < 1e-12 * c.judged.size_m
    );
    let made = design(
        r#"{"synthesis": "straight-line", "linkage": "hoeken", "length": "4.6378487100506737047 m", "ratios": [2.975, 3.963]}"#,
    );
    let of = |name: &str| made.candidates[0].number(name).unwrap();
    near(of("AB"), 1.0, 1.0, "crank");
    near(of("least"), 6.8571684950489790280, 7.0, "least");
    near(of("greatest"), 6.8987999562003771358, 7.0, "greatest");
    near(of("relative") * 100.0, 0.89764595083014765603, 1.0, "deviation");
}

/// The place of E with the driver at an angle, by the finished scene.
fn place(c: &DesignCandidate, degrees: f64) -> [f64; 2] {
    use hodograph::mechanism::Mechanism;
    use hodograph::sweep::{PlacedScene, Stations, Width, run};
    let scene = hodograph::scene::read_asking(c.scene_text(), "x_E, y_E").unwrap().value;
    let m = Mechanism::new(&scene).unwrap().value;
    let placed = PlacedScene::new(&scene, &m).unwrap();
    let table =
        run(&placed, 0, &Stations::of_values(vec![degrees.to_radians()], 1.0), Width::One).unwrap();
    ["x_E", "y_E"].map(|n| table.column(n).unwrap().values[0])
}

#[test]
fn watt_and_peaucellier_by_the_reference_cases() {
    let unit = 2.0 * 1.3114319190192082402;
    let exact = design(&format!(
        r#"{{"synthesis": "straight-line", "linkage": "peaucellier", "length": "{unit} m", "swing": "40 deg"}}"#
    ));
    let c = &exact.candidates[0];
    for (angle, y) in [
        (20.0, 1.3114319190192082402),
        (45.0, 3.0807133701498944255),
        (-30.0, -1.9928721187064751294),
    ] {
        let at = place(c, angle);
        near(at[0], 7.4375, 1.0, "x");
        near(at[1], y, 1.0, "y");
    }
    assert_eq!(c.draft.which.en, "exact");
    assert!(c.number("relative").unwrap() < 1e-12);
    // Watt's linkage, with rods of 5: the length over 40° gives the scale.
    let made = design(r#"{"synthesis": "straight-line", "linkage": "watt", "length": "1 m"}"#);
    let c = &made.candidates[0];
    let k = c.number("AB").unwrap() / 5.0;
    for (angle, x, y) in [
        (10.0, 5.0005182307454824390, -0.12883026826783579799),
        (20.0, 5.0200153533020288269, 0.76320887965672102213),
        (25.0, 5.0861442829534192078, 1.2809777898704418883),
        (-25.0, 4.9578949694496102575, -3.0176467420765227399),
    ] {
        let at = place(c, angle);
        near(at[0] / k, x, 1.0, "x");
        near(at[1] / k, y, 1.0, "y");
    }
    near(c.number("length").unwrap(), 1.0, 1.0, "length");
}

#[test]
fn the_others_have_the_wanted_length() {
    for (name, relative) in [("chebyshev", 0.02), ("scott-russell", 1e-12)] {
        let made = design(&format!(
            r#"{{"synthesis": "straight-line", "linkage": "{name}", "length": "200 mm"}}"#
        ));
        let c = &made.candidates[0];
        assert!(
            (c.number("length").unwrap() - 0.2).abs() < 1e-6
                && c.number("relative").unwrap() < relative,
            "{name}: {:?}",
            c.draft.numbers
        );
        assert!(c.judged.off_m < 1e-9 && c.judged.defects.is_empty(), "{name}: {:?}", c.judged);
    }
}

#[test]
fn bad_wishes_are_reported() {
    for (task, code) in [
        (
            r#"{"synthesis": "straight-line", "linkage": "hoecken", "length": "1 m"}"#,
            "unknown-word",
        ),
        (
            r#"{"synthesis": "straight-line", "linkage": "hoeken", "length": "1 m", "ratios": [4, 2]}"#,
            "out-of-range",
        ),
        (
            r#"{"synthesis": "straight-line", "linkage": "hoeken", "length": "1 m", "swing": "20 deg"}"#,
            "out-of-range",
        ),
        (
            r#"{"synthesis": "straight-line", "linkage": "watt", "length": "1 m", "swing": "200 deg"}"#,
            "out-of-range",
        ),
        (r#"{"synthesis": "straight-line", "linkage": "watt", "length": "-1 m"}"#, "not-positive"),
        (r#"{"synthesis": "cognates", "scene": "slider-crank"}"#, "not-a-four-bar"),
        (r#"{"synthesis": "cognates", "scene": "no-such"}"#, "unknown-template"),
        (r#"{"synthesis": "cognates", "scene": "crank-rocker", "point": "X"}"#, "unknown-point"),
        (r#"{"synthesis": "cognates", "scene": {"links": {}}}"#, "missing-key"),
        (r#"{"synthesis": "cognates", "scene": [1]}"#, "wrong-type"),
    ] {
        let faults = read(task).map(|_| ()).unwrap_err();
        assert!(
            faults.list.iter().all(|d| d.span.is_some() && d.english_in_chinese().is_none()),
            "{task}: {faults:?}"
        );
        assert!(
            faults.list.iter().any(|d| d.code == code) || code == "missing-key",
            "{task}: {faults:?}"
        );
    }
}
