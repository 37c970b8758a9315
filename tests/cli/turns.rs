//! Tables of a whole motion and of a function, in the units of the book.

use super::{hodograph, text};
use serde_json::Value as Json;

fn csv(args: &[&str]) -> (Vec<String>, Vec<Vec<f64>>) {
    let run = hodograph().args(args).assert().success();
    let all = text(&run.get_output().stdout);
    let mut lines = all.lines().filter(|l| !l.starts_with('#'));
    let head = lines.next().unwrap().split(',').map(str::to_owned).collect();
    let row = |l: &str| l.split(',').map(|x| x.parse().unwrap()).collect();
    (head, lines.map(row).collect())
}

const SHAPER: &str = "templates/shaper.json";

/// Each number is that of the table in SI, in the unit of its label; positions of the crank are
/// whole degrees.
#[test]
fn a_table_in_units_of_the_book_is_the_table_in_si() {
    let find = ["--find", "x_C,v_C,a_C,omega_3,phi_3", "--steps", "36"];
    let (_, si) = csv(&[&["sweep", SHAPER], &find[..]].concat());
    let (labels, book) = csv(&[&["sweep", SHAPER, "--units", "book"], &find[..]].concat());
    let units: Vec<&str> =
        labels.iter().map(|l| l.split_once('[').unwrap().1.trim_end_matches(']')).collect();
    for (row, (a, b)) in si.iter().zip(&book).enumerate() {
        assert_eq!(b[0], 10.0 * row as f64);
        for ((unit, si), book) in units.iter().zip(a).zip(b) {
            let per_si = match *unit {
                "mm" | "mm/s" | "mm/s²" => 1e3,
                "°" => 180.0 / std::f64::consts::PI,
                "rad/s" => 1.0,
                other => panic!("{other}"),
            };
            let wanted = si * per_si;
            assert!((book - wanted).abs() <= 1e-12 * wanted.abs().max(1e-9), "{book} {wanted}");
        }
    }
    let (labels, mixed) =
        csv(&["sweep", SHAPER, "--units", "r/min,mm", "--find", "omega_3,x_C", "--steps", "4"]);
    assert_eq!(labels, ["phi_1 [rad]", "omega_3 [r/min]", "x_C [mm]"]);
    let quarter = mixed[1][0];
    assert!((quarter - std::f64::consts::FRAC_PI_2).abs() < 1e-15, "{quarter}");
}

/// A scene's own units go before those of the table; JSON names them too.
#[test]
fn units_that_the_scene_chooses_are_those_of_its_table() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.json").display().to_string();
    let mut scene: Json =
        serde_json::from_str(&std::fs::read_to_string("templates/crank-rocker.json").unwrap())
            .unwrap();
    scene["answers"] = serde_json::json!({"omega": "r/min", "velocity": "m/s"});
    let file = folder.path().join("s.json");
    std::fs::write(&file, scene.to_string()).unwrap();
    let file = file.display().to_string();
    let args = ["sweep", &file, "--units", "book", "--find", "v_C,omega_3", "-o", &path];
    hodograph().args(args).assert().success();
    let table: Json = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
    let units: Vec<&str> =
        table["columns"].as_array().unwrap().iter().map(|c| c["unit"].as_str().unwrap()).collect();
    assert!(
        units.contains(&"r/min") && units.contains(&"m/s") && units.contains(&"°"),
        "{units:?}"
    );
    let run = hodograph().args(["sweep", &file, "--units", "parsec"]).assert().code(2);
    assert!(text(&run.get_output().stderr).contains("is no unit of an answer"));
}

/// The table of a worksheet has the numbers of the sweep, rounded, in both languages.
#[test]
fn a_worksheet_has_the_results_of_a_turn() {
    let (_, rows) =
        csv(&["sweep", SHAPER, "--units", "book", "--steps", "12", "--find", "x_C,v_C"]);
    for (lang, heading) in [("en", "Results over the motion"), ("zh", "各位置的结果")] {
        let args = ["worksheet", SHAPER, "--table", "12", "--lang", lang, "--solution"];
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("w.md").display().to_string();
        hodograph().args(args).args(["-o", &path]).assert().success();
        let sheet = std::fs::read_to_string(&path).unwrap();
        let (_, table) = sheet.split_once(heading).expect(heading);
        for row in &rows {
            let line = format!("| ${}$ | ${:.2}$ |", row[0], row[1]);
            assert!(table.contains(&line), "{line}");
            assert!(table.contains(&format!("${:.1}$", row[2])), "{row:?}");
        }
        assert!(table.contains("/\\text{mm}") && table.contains("\\text{mm/s}"));
    }
    let args = ["worksheet", SHAPER, "--table", "12", "--problem-only", "-o", "-"];
    hodograph().args(args).assert().code(2);
}

/// The course design y = ln x: the table at every half degree closes the four-bar of the design,
/// whose lengths the program prints.
#[test]
fn the_table_of_a_function_has_the_step_of_the_file_and_closes_the_loop() {
    let (head, rows) = csv(&["synth", "tests/course/function-step.json", "--table", "-"]);
    assert_eq!((head.len(), rows.len()), (5, 121));
    let [a, b, c, d]: [f64; 4] = [74.4980, 147.200, 44.9876, 100.0];
    for (k, row) in rows.iter().enumerate() {
        let (x, alpha) = (1.0 + k as f64 / 120.0, 86.0 + 0.5 * k as f64);
        assert!((row[0] - x).abs() < 1e-11 && (row[1] - alpha).abs() < 1e-9, "{row:?}");
        let wanted = 24.0 + 85.0 * x.ln() / 2.0_f64.ln();
        assert!((row[2] - wanted).abs() < 1e-9, "{row:?} {wanted}");
        let [alpha, real] = [row[1], row[3]].map(f64::to_radians);
        let bc = (d + c * real.cos() - a * alpha.cos()).hypot(c * real.sin() - a * alpha.sin());
        assert!((bc - b).abs() < 2e-4 * b, "{bc} {b}");
        assert!((row[4] - (row[3] - row[2])).abs() < 1e-9, "{row:?}");
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("w.md").display().to_string();
    let args = ["worksheet", "tests/course/function-step.json", "-o", &path];
    hodograph().args(args).assert().success();
    let sheet = std::fs::read_to_string(&path).unwrap();
    // α and φ are turns, α₀ and φ₀ where they begin: no letter has two meanings.
    assert!(!sheet.contains("\\psi"), "{sheet}");
    let table = sheet.split_once("wanted function").unwrap().1;
    let rows = table.lines().skip(2).take_while(|l| l.starts_with('|')).count();
    assert_eq!(rows, 121);
}

/// The published numbers of the lecture notes: P₀, P₁, P₂ and m, n, l.
#[test]
fn the_constants_of_the_course_design_are_those_of_the_notes() {
    let task = r#"{"synthesis": "function",
        "pairs": [["4.02 deg", "7.97 deg"], ["30 deg", "49.68 deg"], ["55.98 deg", "80.83 deg"]],
        "input": {"from": "86 deg"}, "output": {"from": "24 deg"}, "crank": "1 m"}"#;
    let run = hodograph().args(["synth", "-", "--json"]).write_stdin(task).assert().success();
    let json: Json = serde_json::from_slice(&run.get_output().stdout).unwrap();
    let numbers = &json["candidates"][0]["numbers"];
    for (name, published) in [
        ("P0", 0.601242),
        ("P1", -0.461061),
        ("P2", -0.266414),
        ("m", 0.601242),
        ("n", 1.304040),
        ("l", 1.938257),
    ] {
        let value = numbers[name].as_f64().unwrap();
        assert!((value - published).abs() < 1.1e-6, "{name} {value}");
    }
}
