//! Scenes of any size.

use serde_json::{Value, json};

/// A crank and `n` dyads, each moved by the one before it: parallelograms side by side.
pub fn chain(n: usize) -> Value {
    let mut links = json!({"1": ["O0", "P0"]});
    let mut points = json!({"O0": ["0 mm", "0 mm"]});
    let mut lengths = json!({"O0,P0": "50 mm"});
    let mut side = json!({});
    for i in 1..=n {
        let (before, pin, pivot) = (format!("P{}", i - 1), format!("P{i}"), format!("O{i}"));
        links[format!("{}", 2 * i)] = json!([before, pin]);
        links[format!("{}", 2 * i + 1)] = json!([pin, pivot]);
        points[&pivot] = json!([format!("{} mm", 100 * i), "0 mm"]);
        lengths[format!("{before},{pin}")] = json!("100 mm");
        lengths[format!("{pin},{pivot}")] = json!("50 mm");
        side[&pin] = json!(format!("left of {before},{pivot}"));
    }
    let ground = format!("{}", 2 * n + 2);
    links[&ground] = (0..=n).map(|i| json!(format!("O{i}"))).collect();
    json!({
        "title": format!("{n} dyads"), "links": links, "ground": ground, "points": points, "lengths": lengths, "side": side,
        "driver": {"link": "1", "angle": "60 deg", "omega": "10 rad/s"}
    })
}

/// A crank-rocker with `n` further points on its coupler.
pub fn points_on_a_link(n: usize) -> Value {
    let mut coupler = json!(["B", "C"]);
    let mut points = json!({});
    for i in 0..n {
        let (x, y) = (5.0 + 240.0 * i as f64 / n as f64, 20.0 + 60.0 * (0.7 * i as f64).sin());
        coupler.as_array_mut().unwrap().push(json!(format!("P{i}")));
        points[format!("P{i}")] =
            json!({"base": "BC", "x": format!("{x:.3} mm"), "y": format!("{y:.3} mm")});
    }
    json!({
        "title": format!("{n} points"), "links": {"1": ["A", "B"], "2": coupler, "3": ["C", "D"], "4": ["A", "D"]}, "ground": "4",
        "points": points, "lengths": {"AB": "100 mm", "BC": "250 mm", "CD": "200 mm", "AD": "300 mm"},
        "driver": {"link": "1", "angle": "60 deg", "omega": "10 rad/s"}
    })
}
