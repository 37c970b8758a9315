//! The motion cycle of the outputs.

use super::{hodograph, text};
use serde_json::Value as Json;

fn cycle(scene: &str, more: &[&str]) -> Json {
    let run = hodograph().args(["cycle", scene, "--json"]).args(more).assert().success();
    serde_json::from_slice(&run.get_output().stdout).unwrap()
}

/// The phases of an output: name, and the driver's position at both ends in degrees.
fn phases(cycle: &Json, output: usize) -> Vec<(String, f64, f64)> {
    let of = |p: &Json| {
        let [from, to] = ["from", "to"].map(|end| p[end].as_f64().unwrap().to_degrees());
        (p["phase"].as_str().unwrap().to_owned(), from, to)
    };
    cycle["outputs"][output]["phases"].as_array().unwrap().iter().map(of).collect()
}

/// The rise, dwells and return of a cam's follower are those of its law.
#[test]
fn the_phases_of_a_cam_are_those_of_its_law() {
    let found = phases(&cycle("templates/cam-offset-roller.json", &[]), 0);
    let wanted = [
        ("forward", 0.0, 120.0),
        ("dwell", 120.0, 180.0),
        ("return", 180.0, 300.0),
        ("dwell", 300.0, 0.0),
    ];
    assert_eq!(found.len(), wanted.len(), "{found:?}");
    for ((name, from, to), (word, a, b)) in found.iter().zip(wanted) {
        assert!(name == word && (from - a).abs() < 1e-4 && (to - b).abs() < 1e-4, "{found:?}");
    }
}

/// The angles of a swept output rise and fall between the places at which the phases change.
#[test]
fn phases_change_where_a_swept_output_turns_back() {
    for template in ["watt-six-bar", "jansen-leg", "shaper"] {
        let scene = format!("templates/{template}.json");
        let cycle = cycle(&scene, &[]);
        let name = cycle["outputs"][0]["output"].as_str().unwrap();
        let args = ["sweep", &scene, "--find", name, "--steps", "3600"];
        let run = hodograph().args(args).assert().success();
        let csv = text(&run.get_output().stdout);
        let rows: Vec<Vec<f64>> = csv
            .lines()
            .filter(|l| l.starts_with(|c: char| c.is_ascii_digit()))
            .map(|l| l.split(',').map(|x| x.parse().unwrap()).collect())
            .collect();
        let rises: Vec<bool> = rows.windows(2).map(|w| (w[1][1] - w[0][1]).sin() > 0.0).collect();
        let turns: Vec<f64> = (1..rises.len())
            .filter(|k| rises[*k] != rises[k - 1])
            .map(|k| rows[k][0].to_degrees())
            .collect();
        let mut changes: Vec<f64> = phases(&cycle, 0).iter().map(|(_, from, _)| *from).collect();
        changes.sort_by(f64::total_cmp);
        assert_eq!(changes.len(), turns.len(), "{template}: {changes:?} {turns:?}");
        for (a, b) in changes.iter().zip(&turns) {
            assert!((a - b).abs() <= 0.11, "{template}: {changes:?} {turns:?}");
        }
    }
}

/// A tool cuts in the slower stroke: 180° + θ of the crank. A crank that turns back has the other
/// stroke for it.
#[test]
fn the_slower_stroke_is_the_working_stroke_in_either_sense() {
    let shaper = "templates/shaper.json";
    let slow = |found: &[(String, f64, f64)]| {
        let (name, from, to) = &found[0];
        assert_eq!(name, "forward");
        (to - from).rem_euclid(360.0)
    };
    let found = phases(&cycle(shaper, &[]), 1);
    let theta = 2.0 * (110.0_f64 / 380.0).asin().to_degrees();
    assert!((slow(&found) - 180.0 - theta).abs() < 1e-6, "{found:?}");
    let back = phases(&cycle(shaper, &["--set", "omega_1=-10"]), 1);
    assert!((360.0 - slow(&back) - 180.0 - theta).abs() < 1e-6, "{back:?}");
    assert!((back[0].1 - found[0].2).abs() < 1e-6, "{back:?}");
}

#[test]
fn the_three_forms_have_a_part_for_each_phase_in_both_languages() {
    let scene = "templates/cam-valve-train.json";
    for (form, parts) in [("bars", 4 + 1), ("straight", 8 + 1), ("polar", 4 + 1)] {
        for (lang, words) in [("en", "motion cycle"), ("zh", "运动循环图")] {
            let args = ["cycle", scene, "--form", form, "--lang", lang, "-o", "-"];
            let run = hodograph().args(args).assert().success();
            let svg = text(&run.get_output().stdout);
            assert!(svg.contains(words), "{form} {lang}");
            let drawn = svg.matches("class=\"phase\"").count();
            assert!(drawn >= parts, "{form}: {drawn}");
        }
    }
    let run = hodograph().args(["cycle", scene, "--lang", "zh"]).assert().success();
    let said = text(&run.get_output().stdout);
    assert!(said.contains("停歇 143.130° … 36.8699°（253.740°）"), "{said}");
}

#[test]
fn an_output_that_the_mechanism_lacks_is_refused_with_the_list() {
    let args = ["cycle", "templates/shaper.json", "--find", "phi_9", "--errors", "json"];
    let run = hodograph().args(args).assert().code(2);
    let said = text(&run.get_output().stderr);
    assert!(said.contains("no-output") && said.contains("phi_3, s_C"), "{said}");
    let one = cycle("templates/shaper.json", &["--find", "s_C"]);
    assert_eq!(one["outputs"].as_array().unwrap().len(), 1);
}
