//! Printed results can be asked for in the words in which they are printed; drawn results are in
//! the JSON.

use super::{hodograph, text};
use serde_json::Value;

/// The answers of a scene as JSON, its `find` replaced.
fn answers(template: &str, find: &[&str]) -> Vec<Value> {
    let scene = hodograph::scene::templates::get(template).unwrap();
    asked(&hodograph::scene::edit::with_find(scene, find).unwrap())
}

fn asked(scene: &str) -> Vec<Value> {
    let run = hodograph().args(["solve", "-", "--json"]).write_stdin(scene).assert().success();
    let all: Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
    all["answers"].as_array().unwrap().clone()
}

fn json(arguments: &[&str], scene: &str) -> Value {
    let run = hodograph().args(arguments).write_stdin(scene).assert().success();
    serde_json::from_slice(&run.get_output().stdout).unwrap()
}

fn number(answer: &Value) -> f64 {
    let value = &answer["value"];
    value["value"]
        .as_f64()
        .or_else(|| value["magnitude"].as_f64())
        .unwrap_or_else(|| panic!("no number in {answer}"))
}

fn near(got: f64, expected: f64, what: &str) {
    assert!(
        (got - expected).abs() <= 1e-9 * expected.abs().max(1e-6),
        "{what}: {got} for {expected}"
    );
}

#[test]
fn sums_differences_and_ratios_are_those_of_their_operands() {
    let parts = ["omega_2", "omega_3", "alpha_2", "v_C", "v_B", "a_C", "l_AB"];
    let known = answers("crank-rocker", &parts);
    let of = |name: &str| number(&known[parts.iter().position(|p| *p == name).unwrap()]);
    let expected = [
        ("omega_2 + omega_3", of("omega_2") + of("omega_3")),
        ("omega_2-omega_3", of("omega_2") - of("omega_3")),
        ("ω_3/ω_2", of("omega_3") / of("omega_2")),
        ("v_C/v_B", of("v_C") / of("v_B")),
        ("v_B/omega_2", of("v_B") / of("omega_2")),
        ("a_C/l_AB", of("a_C") / of("l_AB")),
    ];
    let found = answers("crank-rocker", &expected.map(|e| e.0));
    for (answer, (text, value)) in found.iter().zip(expected) {
        near(number(answer), value, text);
        assert!(text.contains("l_AB") || !answer["drawing"].is_null(), "{answer}");
    }
    let sum = &answers("crank-rocker", &["v_B + v_C", "v_B", "v_C"]);
    for axis in ["x", "y"] {
        let of = |k: usize| sum[k]["value"][axis].as_f64().unwrap();
        near(of(0), of(1) + of(2), axis);
    }
    // Quantities without a common unit are reported, and a frame after a stroke is read like any
    // frame.
    let scene = hodograph::scene::edit::with_find(
        hodograph::scene::templates::get("crank-rocker").unwrap(),
        &["omega_2 + v_C"],
    )
    .unwrap();
    let run = hodograph().args(["solve", "-"]).write_stdin(scene).assert().code(2);
    assert!(
        text(&run.get_output().stderr).contains("combines rad/s with m/s"),
        "{}",
        text(&run.get_output().stderr)
    );
    near(
        number(&answers("crank-rocker", &["omega_3/2"])[0]),
        of("omega_3") - of("omega_2"),
        "omega_3/2",
    );
}

/// v_C : v_B is the ratio of their distances from the pole of the coupler.
#[test]
fn distances_from_centres_divide_speeds() {
    let found = answers("crank-rocker", &["P24C/P24B", "v_C/v_B", "P_24C", "P_24", "x_C", "y_C"]);
    near(number(&found[0]), number(&found[1]), "P24C/P24B");
    let [x, y] = ["x", "y"].map(|axis| found[3]["value"][axis].as_f64().unwrap());
    let far = (x - number(&found[4])).hypot(y - number(&found[5]));
    near(number(&found[2]), far, "P_24C");
    for k in [0, 2, 3] {
        assert!(!found[k]["drawing"].is_null(), "{}", found[k]);
    }
}

#[test]
fn a_coordinate_along_a_guide_is_that_of_limits() {
    let scene = hodograph::scene::templates::get("slider-crank").unwrap();
    let found = answers("slider-crank", &["s_C", "x_C"]);
    near(number(&found[0]), number(&found[1]), "s_C");
    let limits = json(&["limits", "-", "--json"], scene);
    let stroke = limits["outputs"]
        .as_array()
        .unwrap()
        .iter()
        .find(|o| o["output"] == "s_C")
        .unwrap()["stroke"]
        .as_f64()
        .unwrap();
    let scene = hodograph::scene::edit::with_find(scene, &["s_C"]).unwrap();
    let run =
        hodograph().args(["sweep", "-", "--steps", "360"]).write_stdin(scene).assert().success();
    let table = text(&run.get_output().stdout);
    let values: Vec<f64> =
        table.lines().filter_map(|l| l.rsplit(',').next()?.parse().ok()).collect();
    let [low, high] = [f64::min, f64::max].map(|f| values.iter().copied().reduce(f).unwrap());
    assert!((high - low - stroke).abs() < 1e-6 * stroke.max(1.0), "{low} {high} {stroke}");
}

#[test]
fn a_cam_answers_what_its_report_prints() {
    let find = [
        "Phi_3",
        "Phi_far_3",
        "Phi_back_3",
        "Phi_near_3",
        "pressure_out_3",
        "pressure_back_3",
        "pressure_start_3",
        "rb_min_2",
    ];
    let found = answers("cam-offset-roller", &find);
    let cam = &json(
        &["cam", "-", "--json"],
        hodograph::scene::templates::get("cam-offset-roller").unwrap(),
    )[0];
    let of = |path: &str| cam.pointer(path).and_then(Value::as_f64).unwrap().abs();
    let paths = [
        "/angles/rise",
        "/angles/outer_dwell",
        "/angles/return",
        "/angles/inner_dwell",
        "/pressure_angle/rise/value",
        "/pressure_angle/return/value",
    ];
    for (k, path) in paths.iter().enumerate() {
        near(number(&found[k]), of(path), find[k]);
    }
    // The follower slides in a guide, and its lift is still that of the cam.
    near(number(&answers("cam-offset-roller", &["s_3"])[0]), of("/now/s"), "s_3");
    // tan α = e/(s₀) at rest: the offset over √((r₀ + r_r)² − e²).
    near(number(&found[6]).abs().tan(), 10.0 / (40f64 * 40.0 - 100.0).sqrt(), find[6]);
    // A cam with this base circle is not undercut, one with a smaller one is.
    let least = number(&found[7]) * 1e3;
    let undercut = |base: f64| {
        let run = hodograph()
            .args(["cam", "templates/cam-offset-roller.json", "--set", &format!("r0={base}")])
            .output()
            .unwrap();
        text(&run.stderr).contains("undercut")
    };
    assert!(undercut(least * 0.999) && !undercut(least * 1.001), "{least}");
}

/// The distance of the contact from the follower's axis is s′, over a turn at most h/(2·Φ/π) for a
/// harmonic law.
#[test]
fn the_half_length_of_a_face_is_the_greatest_rate() {
    let scene = r#"{"units": {"length": "mm"}, "links": {"1": ["O"], "2": ["O"], "3": ["B"]}, "ground": "1", "points": {"O": [0, 0]},
        "guides": [{"pin": "B", "slider": "3", "on": "1", "through": [0, 0], "angle": "90 deg"}],
        "cams": [{"cam": "2", "follower": "3", "face": {}, "profile": {"base": 40, "law": [
            {"rise": 20, "over": "90 deg", "law": "harmonic"}, {"dwell": "90 deg"}, {"return": 20, "over": "180 deg", "law": "harmonic"}]}}],
        "driver": {"link": "2", "angle": "30 deg", "omega": "5 rad/s"}, "find": ["face_half_3"]}"#;
    near(number(&asked(scene)[0]), 0.02, "face_half_3");
}

/// `centres` and `solve` give a centre at infinity the same direction.
#[test]
fn a_centre_at_infinity_has_one_direction() {
    let mut compared = 0;
    for name in [
        "parallelogram",
        "slider-crank",
        "shaper",
        "scotch-yoke",
        "elliptic-trammel",
        "turning-plate",
    ] {
        let scene = hodograph::scene::templates::get(name).unwrap();
        let all = json(&["centres", "-", "--json"], scene);
        for c in all["centres"].as_array().unwrap().iter().filter(|c| !c["infinity_deg"].is_null())
        {
            let links: Vec<&str> =
                c["links"].as_array().unwrap().iter().map(|l| l.as_str().unwrap()).collect();
            let find = format!("P_{}", links.join(","));
            let Some(answer) = answers(name, &[&find]).into_iter().next() else { continue };
            let Some(direction) = answer["direction_deg"].as_f64() else { continue };
            near(direction, c["infinity_deg"].as_f64().unwrap(), &format!("{name} {find}"));
            compared += 1;
        }
    }
    assert!(compared > 5, "only {compared}");
}

/// Results at a pole are drawn by the ruler and are in the JSON.
#[test]
fn what_a_figure_draws_is_a_drawing_in_the_json() {
    let find = ["P_24", "J_2", "d_2", "K_2", "u_2", "rho_E", "O_E"];
    for answer in answers("crank-rocker", &find) {
        let drawn = &answer["drawing"];
        assert!(!drawn.is_null(), "{answer}");
        for key in ["value", "x", "y"] {
            if let (Some(a), Some(b)) = (drawn[key].as_f64(), answer["value"][key].as_f64()) {
                assert!((a.abs() - b.abs()).abs() < 1e-8 * b.abs().max(1e-3), "{answer}");
            }
        }
    }
}

/// The parts of a relative acceleration are drawn along and perpendicular to the drawn v_r.
#[test]
fn parts_along_a_path_that_no_pair_gives_are_drawn() {
    for (template, frame) in
        [("lathe", "T/2"), ("cam-offset-roller", "B3/2"), ("cam-eccentric", "E3/2")]
    {
        let find = ["ve", "vr", "ar", "arn", "art"].map(|symbol| format!("{symbol}_{frame}"));
        let find: Vec<&str> = find.iter().map(String::as_str).collect();
        for answer in answers(template, &find) {
            let drawn = &answer["drawing"];
            assert!(!drawn.is_null(), "{template}: {answer}");
            for axis in ["x", "y"] {
                let [a, b] = [drawn, &answer["value"]].map(|v| v[axis].as_f64().unwrap());
                assert!((a - b).abs() < 1e-9 * b.abs().max(1.0), "{template}: {answer}");
            }
        }
    }
}

/// The construction of a design as JSON: each point with its place.
#[test]
fn the_construction_of_a_design_for_programs() {
    let folder = tempfile::tempdir().unwrap();
    let task = folder.path().join("task.json");
    std::fs::write(&task, hodograph::synthesis::templates::get("time-ratio").unwrap()).unwrap();
    let run = hodograph().args(["synth", "--json", "--steps"]).arg(&task).assert().success();
    let all: Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
    let steps = all["construction"]["steps"].as_array().unwrap();
    let marks = steps.iter().flat_map(|s| s["marks"].as_array().unwrap()).count();
    assert!(steps.len() > 2 && marks > 3, "{all:#}");
    let told = text(
        &hodograph().args(["synth", "--steps"]).arg(&task).assert().success().get_output().stdout,
    );
    assert!(told.contains("[A (") || told.contains("A ("), "{told}");
}

#[test]
fn a_function_beside_pairs_is_reported_as_what_it_is() {
    let task = r#"{"synthesis": "function", "function": {"y": "ln(x)", "from": 1, "to": 2}, "points": 3, "pairs": [["0 deg", "0 deg"]],
        "input": {"from": "86 deg", "swing": "60 deg"}, "output": {"from": "24 deg", "swing": "85 deg"}, "frame": "100 mm"}"#;
    let run = hodograph().args(["synth", "-"]).write_stdin(task).assert().code(2);
    let said = text(&run.get_output().stderr);
    assert!(
        said.contains("`function` and `pairs` are both given") && !said.contains("missing-key"),
        "{said}"
    );
}

/// The lever of a disc on a coupler, given by its pivot alone.
fn lever(face: &str, more: &str) -> String {
    format!(
        r#"{{"units": {{"length": "mm"}}, "links": {{"1": ["A", "D", "F"], "2": ["A", "B"], "3": ["B", "C", "G"], "4": ["C", "D"], "5": ["F"]}},
        "ground": "1", "points": {{"A": [0, 0], "B": [24, 32], "C": [120, 60], "D": [100, 0], "G": [70, 70], "F": [160, 110]}},
        "cams": [{{"cam": "3", "follower": "5", "face": {{"through": "F", {face}, "cam": "right"}}, "profile": {{"centre": "G", "radius": "20 mm"}}, "at": "E"}}],
        "driver": {{"link": "2", "omega": "9 rad/s"}}, "find": ["omega_5"]{more}}}"#
    )
}

#[test]
fn the_point_of_a_face_says_on_which_side_it_lies() {
    let of = |more: &str| number(&asked(&lever(r#""offset": "6.8 mm""#, more))[0]);
    let run = hodograph()
        .args(["solve", "-"])
        .write_stdin(lever(r#""offset": "6.8 mm""#, ""))
        .assert()
        .success();
    let note = text(&run.get_output().stderr);
    assert!(note.contains("the one with W at") && note.contains("a rough place of W"), "{note}");
    let sides = [r#", "side": {"W": "left of FD"}"#, r#", "side": {"W": "right of FD"}"#].map(of);
    assert!((sides[0] - sides[1]).abs() > 1e-3, "{sides:?}");
    let sketched = [r#", "sketch": {"W": [64, 89]}"#, r#", "sketch": {"W": [180, 150]}"#].map(of);
    for value in sketched {
        assert!(sides.iter().any(|s| (s - value).abs() < 1e-9), "{sketched:?} {sides:?}");
    }
}

/// A contact that does not occur is reported as a contact, not as the pin and guide that replace
/// it.
#[test]
fn a_missed_contact_is_reported_in_the_words_of_the_scene() {
    let run = hodograph()
        .args(["solve", "-"])
        .write_stdin(lever(r#""angle": "atan(7/24)", "offset": "6.7 mm""#, ""))
        .assert()
        .code(2);
    let said = text(&run.get_output().stderr);
    assert!(said.contains("the contact of cam 3 and follower 5 is missed by 0.1000 mm"), "{said}");
    assert!(!said.contains("guide"), "{said}");
}

#[test]
fn a_shaky_mechanism_is_called_so() {
    let scene = r#"{"units": {"length": "m"}, "links": {"1": ["A", "D", "F"], "2": ["A", "B"], "3": ["B", "C", "E"], "4": ["C", "D"], "5": ["E", "F"]},
        "ground": "1", "points": {"A": [0, 0], "B": [3, 4], "C": [13, 4], "D": [10, 0], "E": [8, 4], "F": [6.5, 2]},
        "driver": {"link": "2", "omega": "5 rad/s"}}"#;
    for (lang, word) in
        [("en", "shaky, mobile to first order, it locks at a finite turn"), ("zh", "瞬时可动")]
    {
        let run = hodograph().args(["mobility", "-", "--lang", lang]).write_stdin(scene).assert();
        let said = text(&run.get_output().stdout);
        assert!(said.contains(word), "{said}");
    }
}

/// Ball's point is constructed: each letter used by a step is introduced by an earlier step.
#[test]
fn the_point_of_ball_is_constructed() {
    let run = hodograph()
        .args(["curvature", "templates/crank-rocker.json", "--steps"])
        .assert()
        .success();
    let said = text(&run.get_output().stdout);
    let steps =
        said.lines().filter(|l| l.contains("G_B") || l.contains("Ball's point U_2")).count();
    assert!(steps >= 2 && said.contains("is Ball's point U_2"), "{said}");
}

#[test]
fn inversions_of_the_slider_crank_have_their_names() {
    let run = hodograph().args(["inversions", "templates/slider-crank.json"]).assert().success();
    let said = text(&run.get_output().stdout);
    for name in ["crank-slider", "guide", "swinging block", "fixed slider"] {
        assert!(said.contains(name), "{name}:\n{said}");
    }
}

/// Tangential parts have the mark of the notation.
#[test]
fn tangential_parts_bear_the_mark_of_the_notation() {
    let folder = tempfile::tempdir().unwrap();
    let (style, out) = (folder.path().join("style.json"), folder.path().join("sheet.svg"));
    std::fs::write(&style, r#"{"base": "print", "notation": {"tangential": "\\tau"}}"#).unwrap();
    hodograph()
        .args(["draw", "templates/crank-rocker.json", "--style"])
        .arg(&style)
        .arg("-o")
        .arg(&out)
        .assert()
        .success();
    let sheet = std::fs::read_to_string(&out).unwrap();
    assert!(sheet.contains('τ'), "no tau");
    // Composite motion, in its figure and in its text, and a plate that turns in space, in
    // formulas, steps and answers.
    let lever = ["draw", "templates/slotted-lever.json", "--figure", "composite", "--style"];
    hodograph().args(lever).arg(&style).arg("-o").arg(&out).assert().success();
    let figure = std::fs::read_to_string(&out).unwrap();
    assert!(
        figure.contains("a_e^τ + a_r^n + a_r^τ")
            && !figure.contains("_r^t")
            && figure.contains("α_3 = a_e^τ/l_CB"),
        "{figure}"
    );
    let plate = folder.path().join("plate.md");
    hodograph()
        .args(["worksheet", "templates/particle/plate-in-space.json", "--style"])
        .arg(&style)
        .arg("-o")
        .arg(&plate)
        .assert()
        .success();
    let sheet = std::fs::read_to_string(&plate).unwrap();
    assert!(
        sheet.contains("a_{e}^{\\tau}+a_{r}^{n}+a_{r}^{\\tau}+a_{c}") && !sheet.contains("^{t}"),
        "{sheet}"
    );
    for (notation, letter) in [("cn", "a_k = 2ω"), ("en", "a_c = 2ω")] {
        for lang in ["en", "zh"] {
            let asked = [
                "solve",
                "templates/particle/plate-in-space.json",
                "--steps",
                "--notation",
                notation,
                "--lang",
                lang,
            ];
            let said = text(&hodograph().args(asked).assert().success().get_output().stdout);
            assert!(said.contains(letter), "{notation} {lang}: {said}");
        }
    }
    let run = hodograph()
        .args(["composite", "templates/slotted-lever.json", "--notation", "cn"])
        .assert()
        .success();
    let said = text(&run.get_output().stdout);
    assert!(said.contains("a_r^t + a_k") && !said.contains("a_c"), "{said}");
}
