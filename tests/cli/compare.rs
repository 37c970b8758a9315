//! Several designs side by side.

use super::{hodograph, text};
use serde_json::Value as Json;
use std::f64::consts::{PI, TAU};

/// The comparison of scenes as JSON.
fn compared(args: &[&str]) -> Json {
    let run = hodograph().arg("compare").args(args).arg("--json").assert().success();
    serde_json::from_slice(&run.get_output().stdout).unwrap()
}

/// A result of a design and the place of the driver that has it.
fn of(table: &Json, quantity: &str, result: &str, design: usize) -> (f64, Option<f64>) {
    let rows = table["rows"].as_array().unwrap();
    let row = rows.iter().find(|r| r["quantity"] == quantity && r["result"] == result);
    let cell = &row.unwrap_or_else(|| panic!("{quantity}: {result}"))["designs"][design];
    (cell["value"].as_f64().unwrap(), cell["driver"].as_f64())
}

fn near(found: f64, wanted: f64) {
    assert!((found - wanted).abs() <= 1e-9 * wanted.abs().max(1.0), "{found} {wanted}");
}

/// Writes four-bars with other cranks into a folder; returns their paths.
fn cranks(folder: &std::path::Path, lengths: &[u32]) -> Vec<String> {
    let one = |mm: &u32| {
        let path = folder.join(format!("{mm}.json")).display().to_string();
        let set = format!("l_AB={mm}");
        hodograph().args(["new", "crank-rocker", "--set", &set, "-o", &path]).assert().success();
        path
    };
    lengths.iter().map(one).collect()
}

/// Strokes, time ratios and transmission angles by the law of cosines; the mean speed of the
/// rocker's pin by its way in a turn.
#[test]
fn four_bars_are_compared_by_closed_formulas() {
    let folder = tempfile::tempdir().unwrap();
    let cranks_mm = [70, 100];
    let scenes = cranks(folder.path(), &cranks_mm);
    let table = compared(&[&scenes[0], &scenes[1], "--find", "v_C,omega_3"]);
    let [b, c, d] = [250.0, 200.0, 300.0];
    for (k, a) in cranks_mm.map(f64::from).into_iter().enumerate() {
        // Triangles A D C with AC = b ± a: the angles at D and at A.
        let at_d = |e: f64| ((c * c + d * d - e * e) / (2.0 * c * d)).acos();
        let at_a = |e: f64| ((e * e + d * d - c * c) / (2.0 * e * d)).acos();
        let stroke = at_d(b + a) - at_d(b - a);
        let theta = at_a(b - a) - at_a(b + a);
        near(of(&table, "phi_3", "stroke", k).0, stroke);
        let ratio = (PI + theta.abs()) / (PI - theta.abs());
        near(of(&table, "phi_3", "time ratio", k).0, ratio);
        let gamma = |e: f64| ((b * b + c * c - e * e) / (2.0 * b * c)).acos();
        let least = gamma(d - a).min(PI - gamma(d + a));
        near(of(&table, "", "least transmission angle", k).0, least);
        let mean = 2.0 * stroke * c * 1e-3 / (TAU / 10.0);
        let found = of(&table, "v_C", "mean", k).0;
        assert!((found - mean).abs() < 2e-5 * mean, "{found} {mean}");
        near(of(&table, "omega_3", "mean", k).0, 0.0);
    }
}

/// The course task 压床: three designs for strokes of 150, 180 and 210 mm.
#[test]
fn the_designs_of_the_press_have_the_strokes_of_the_task() {
    let scenes = [1, 2, 3].map(|k| format!("tests/course/press-{k}.json"));
    let table = compared(&[&scenes[0], &scenes[1], &scenes[2]]);
    for (k, mm) in [150.0, 180.0, 210.0].into_iter().enumerate() {
        near(of(&table, "s_F", "stroke", k).0, mm * 1e-3);
        near(of(&table, "phi_3", "stroke", k).0, PI / 3.0);
        // The way of the slider in both strokes is that of its mean speed.
        let [high, low] = ["highest", "lowest"].map(|r| of(&table, "y_F", r, k).0);
        near(high - low, mm * 1e-3);
    }
}

/// A slider moves along x, the pin of a rocker on a circle: their velocities are compared by
/// magnitudes, and a zero is the lowest.
#[test]
fn a_component_and_a_magnitude_are_compared_as_magnitudes() {
    let scenes = ["templates/slider-crank.json", "templates/crank-rocker.json"];
    let table = compared(&[scenes[0], scenes[1], "--find", "v_C,omega_2"]);
    near(of(&table, "v_C", "lowest", 0).0, 0.0);
    // The mean speed of the slider: two strokes of 2r in a turn.
    let mean = 4.0 * 0.1 / (TAU / 20.0);
    let found = of(&table, "v_C", "mean", 0).0;
    assert!((found - mean).abs() < 2e-5 * mean, "{found} {mean}");
    let swings = table["rows"].as_array().unwrap().iter();
    let phi = swings.clone().find(|r| r["quantity"] == "phi_3").unwrap();
    assert_eq!(phi["designs"][0], Json::Null);
    // The greatest angular velocity of the rod: ω r/l where the crank is in line with the guide.
    let [high, low] = ["highest", "lowest"].map(|r| of(&table, "omega_2", r, 0).0);
    near(high, 20.0 * 100.0 / 280.0);
    near(low, -20.0 * 100.0 / 280.0);
    near(of(&table, "omega_2", "greatest magnitude", 0).0, high);
}

#[test]
fn the_table_is_written_in_both_languages_and_for_spreadsheets() {
    let folder = tempfile::tempdir().unwrap();
    let scenes = cranks(folder.path(), &[90, 100]);
    for (lang, words) in [
        ("en", ["Comparison of designs", "1  Crank-rocker", "least transmission angle γ", "mean"]),
        ("zh", ["方案比较", "2  曲柄摇杆机构", "最小传动角 γ", "平均值"]),
    ] {
        let run = hodograph().arg("compare").args(&scenes).args(["--lang", lang]).assert();
        let said = text(&run.success().get_output().stdout);
        words.iter().for_each(|w| assert!(said.contains(w), "{w}: {said}"));
    }
    let base = folder.path().join("both").display().to_string();
    let args = ["--format", "svg,csv", "-o", &base];
    hodograph().arg("compare").args(&scenes).args(args).assert().success();
    let csv = std::fs::read_to_string(format!("{base}.csv")).unwrap();
    let rows: Vec<Vec<&str>> = csv.lines().map(|l| l.split(',').collect()).collect();
    assert_eq!(rows[0][..4], ["quantity", "result", "unit", "1 90.json"], "{csv}");
    assert!(rows.iter().all(|r| r.len() == rows[0].len()), "{csv}");
    let stroke = rows.iter().find(|r| r[..2] == ["phi_3", "stroke"]).unwrap();
    let degrees: Vec<f64> = [3, 5].map(|k| stroke[k].parse().unwrap()).to_vec();
    assert!(stroke[2] == "°" && degrees[0] < degrees[1], "{stroke:?}");
    // One curve for each scene in each panel, and a line of the legend for each.
    let svg = std::fs::read_to_string(format!("{base}.svg")).unwrap();
    let panels = svg.matches("-unit-").count();
    let curves = (0..panels).map(|k| svg.matches(&format!("panel-{k}-curve-")).count());
    assert!(panels >= 8 && curves.clone().all(|n| n == 2), "{:?}", curves.collect::<Vec<_>>());
    assert!(svg.contains("legend-name-0") && svg.contains("legend-name-1"));
}

#[test]
fn a_crank_and_a_cylinder_have_no_common_axis() {
    let scenes = ["templates/crank-rocker.json", "templates/elliptic-trammel.json"];
    let args = ["--errors", "json", "--find", "v_B"];
    let run = hodograph().arg("compare").args(scenes).args(args).assert().code(2);
    let said = text(&run.get_output().stderr);
    assert!(said.contains("other-driver"), "{said}");
}
