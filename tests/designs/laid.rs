//! Calculated designs are laid off on paper: each has a drawing, and the readings are the numbers
//! of the formula.

use hodograph::synthesis::{construct, read, solve};
use serde_json::{Value as Json, json};

/// Asserts that each candidate is drawn, and that this number of values is read off its drawing.
fn drawn(task: &Json, readings: usize) {
    let read = read(task.to_string()).unwrap_or_else(|f| panic!("{task}: {f}")).value;
    for c in &solve(&read).unwrap_or_else(|f| panic!("{task}: {f}")).candidates {
        let board = construct(&read, c, 0.002)
            .unwrap_or_else(|f| panic!("{task}: {f}"))
            .unwrap_or_else(|| panic!("{task}: no drawing"));
        assert_eq!(board.readings.len(), readings, "{task}");
        for r in &board.readings {
            let number =
                c.number(&r.name).unwrap_or_else(|| panic!("{task}: no formula for {}", r.name));
            assert!((board.value(r) - number.abs()).abs() < 1e-8, "{task}: {}", r.name);
        }
    }
}

#[test]
fn straight_line_linkages_are_drawn_and_measured() {
    let wish = |linkage: &str| json!({"synthesis": "straight-line", "linkage": linkage, "length": "200 mm"});
    for linkage in ["watt", "chebyshev", "roberts", "hoeken", "scott-russell", "peaucellier"] {
        drawn(&wish(linkage), 2);
    }
    let swung = |linkage: &str, swing: f64| {
        let mut wish = wish(linkage);
        wish["swing"] = json!(format!("{swing} deg"));
        wish
    };
    drawn(&swung("watt", 1.0), 2);
    // The widest value named in a refusal is accepted.
    for linkage in ["watt", "scott-russell", "peaucellier"] {
        let refused = read(swung(linkage, 200.0).to_string()).unwrap_err().to_string();
        let most = refused
            .split("at most ")
            .nth(1)
            .and_then(|rest| rest.split('°').next())
            .unwrap_or_else(|| panic!("{refused}"));
        drawn(&swung(linkage, most.parse().unwrap()), 2);
    }
    // The ratio named in a refusal is accepted.
    for refused in [[4.0, 2.0], [0.5, 0.2], [1.0, 3.0]] {
        let mut other = wish("hoeken");
        other["ratios"] = json!(refused);
        let told = read(other.to_string()).unwrap_err().to_string();
        let named = told
            .split("write ")
            .nth(1)
            .and_then(|rest| rest.split_inclusive(']').next())
            .unwrap_or_else(|| panic!("{told}"));
        other["ratios"] = serde_json::from_str(named).unwrap();
        drawn(&other, 2);
    }
    for ratios in [[1.01, 1.01], [2.0, 9.0], [3.0, 2.1]] {
        let mut other = wish("hoeken");
        other["ratios"] = json!(ratios);
        drawn(&other, 2);
    }
}

#[test]
fn approximations_of_functions_are_drawn_and_measured() {
    let ln = json!({"synthesis": "function", "function": {"y": "ln(x)", "from": 1, "to": 2}, "fit": "minimax",
        "input": {"swing": "60 deg"}, "output": {"swing": "85 deg"}});
    drawn(&ln, 6);
    let pairs: Vec<Json> = (0..30)
        .map(|k| {
            json!([format!("{} deg", 40 + 3 * k), format!("{} deg", 60.0 + 2.5 * f64::from(k))])
        })
        .collect();
    // Of more positions than can be distinguished, twelve are drawn.
    for (count, shown) in [(6, 6), (30, 12)] {
        drawn(&json!({"synthesis": "function", "pairs": pairs[..count]}), shown);
    }
    // Arms rotated by 180°, negative angles.
    let power = json!({"synthesis": "function", "function": {"y": "x^1.5", "from": 1, "to": 4}, "points": 7,
        "input": {"from": "30 deg", "swing": "90 deg"}, "output": {"from": "60 deg", "swing": "90 deg"}});
    drawn(&power, 4);
}

#[test]
fn what_a_search_finds_is_drawn_at_its_places() {
    let points = ["100 0", "71 71", "0 90", "-71 71", "-100 0", "-71 -51", "0 -60", "71 -61"]
        .map(|p| p.split(' ').map(|v| json!(format!("{v} mm"))).collect::<Vec<Json>>());
    let timing: Vec<String> = (0..8).map(|k| format!("{} deg", 45 * k)).collect();
    drawn(&json!({"synthesis": "path", "points": points, "timing": timing}), 8);
}
