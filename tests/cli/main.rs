//! The program as seen by its user: exit codes, files, help, and the commands of the documents.

mod asked;
mod cams;
mod compare;
mod cycle;
mod designs;
mod documents;
mod edit;
mod errors;

#[cfg(target_os = "linux")]
mod exits;
mod extremes;
mod figures;
#[cfg(target_os = "linux")]
mod files;
mod languages;
mod questions;
mod scene;
#[cfg(target_os = "linux")]
mod shards;
mod streams;
mod teeth;
mod text;
mod turns;
mod units;
#[path = "../wide/mod.rs"]
mod wide;

use assert_cmd::Command;
use std::path::Path;

fn hodograph() -> Command {
    let mut c = Command::cargo_bin("hodograph").unwrap();
    // The tests must not depend on the language of the system.
    c.current_dir(env!("CARGO_MANIFEST_DIR")).env("LC_ALL", "C");
    c
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A batch of this number of mechanisms, each at 200 positions.
fn batch(count: &str, out: &Path) -> Vec<String> {
    let words = format!(
        "batch templates/crank-rocker.json --vary l_AB=60..260 --vary l_BC=200..300 --random {count} --steps 199 --find a_C -o"
    );
    words.split_whitespace().map(str::to_owned).chain([out.display().to_string()]).collect()
}

/// Starts a run without waiting for it.
fn started(arguments: &[String]) -> std::process::Child {
    let mut run = std::process::Command::new(env!("CARGO_BIN_EXE_hodograph"));
    let run = run.args(arguments).current_dir(env!("CARGO_MANIFEST_DIR"));
    run.stdout(std::process::Stdio::null()).stderr(std::process::Stdio::null()).spawn().unwrap()
}

fn templates_path(name: &str) -> String {
    format!("{}/templates/{name}.json", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn bad_scenes_exit_with_2_and_write_nothing() {
    let out = tempfile::tempdir().unwrap();
    for file in std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/bad")).unwrap() {
        let path = file.unwrap().path();
        if path.extension().is_none_or(|e| e != "json") {
            continue;
        }
        // A pose in which some parts have no motion is drawn as far as possible.
        let stem = path.file_stem().unwrap().to_str().unwrap().to_owned();
        let partly = ["dead-centre", "locked", "undetermined"].contains(&stem.as_str());
        let run =
            hodograph().arg("draw").arg(&path).arg("-o").arg(out.path()).assert().code(if partly {
                4
            } else {
                2
            });
        for written in ["svg", "png"].map(|kind| out.path().join(format!("{stem}.{kind}"))) {
            assert_eq!(written.exists(), partly, "{}", written.display());
            let _ = std::fs::remove_file(written);
        }
        assert!(!text(&run.get_output().stderr).is_empty(), "{}", path.display());
    }
    assert_eq!(std::fs::read_dir(out.path()).unwrap().count(), 0);
    hodograph().args(["solve", "no-such-file.json"]).assert().code(2);
}

#[test]
fn an_unwritable_place_exits_with_1() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a-file");
    std::fs::write(&file, "kept").unwrap();
    // The output needs a folder in place of a file.
    hodograph()
        .args(["draw", "templates/crank-rocker.json", "-o"])
        .arg(file.join("inside"))
        .assert()
        .code(1);
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "kept");
}

#[test]
fn scenes_come_from_standard_input_too() {
    let scene = hodograph()
        .args(["new", "crank-rocker", "--set", "l_AB=80"])
        .assert()
        .success()
        .get_output()
        .stdout
        .clone();
    assert!(text(&scene).contains("\"80 mm\""));
    let solved = hodograph()
        .args(["solve", "-", "--json"])
        .write_stdin(scene)
        .assert()
        .success()
        .get_output()
        .stdout
        .clone();
    let json: serde_json::Value = serde_json::from_slice(&solved).unwrap();
    assert!(
        json["answers"]
            .as_array()
            .unwrap()
            .iter()
            .all(|a| a["agrees"] == true || a["agrees"].is_null())
    );
}

#[test]
fn a_plan_as_json_counts_the_work() {
    let json = |args: &[&str]| -> serde_json::Value {
        let run = hodograph()
            .args(["plan", "templates/shaper.json", "--json"])
            .args(args)
            .assert()
            .success();
        serde_json::from_slice(&run.get_output().stdout).unwrap()
    };
    let plain = json(&[]);
    assert_eq!(plain["work"]["velocity"]["equations_closed"], 3);
    assert_eq!(
        (&plain["work"]["answers"], &plain["work"]["certified_values"]),
        (&10.into(), &16.into())
    );
    assert_eq!((&plain["work"]["labels_placed"], &plain["language"]), (&0.into(), &"en".into()));
    assert!(json(&["--figure"])["work"]["labels_placed"].as_u64().unwrap() > 20);
    let chinese = json(&["--lang", "zh"]);
    assert_eq!((&chinese["language"], &chinese["notation"]), (&"zh".into(), &"cn".into()));
    assert_eq!(json(&["--notation", "cn"])["language"], "en");
    hodograph().args(["plan", "templates/shaper.json", "--figure"]).assert().code(2);
    // A plan needs no numbers: if the pose cannot be assembled it is printed alone, and the notes
    // give the reason.
    let scene = text(
        &hodograph()
            .args(["new", "crank-rocker", "--set", "l_BC=20"])
            .assert()
            .success()
            .get_output()
            .stdout,
    );
    let run = hodograph().args(["plan", "-", "--json"]).write_stdin(scene).assert().success();
    let alone: serde_json::Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
    assert!(alone["work"].is_null() && !alone["velocity"].as_array().unwrap().is_empty());
    assert_eq!(alone["notes"][0]["code"], "cannot-assemble");
}

#[test]
fn unknown_template_and_parameter_are_reported_with_the_nearest_name() {
    let run = hodograph().args(["new", "shapper"]).assert().code(2);
    assert!(text(&run.get_output().stderr).contains("shaper"));
    let run = hodograph().args(["new", "shaper", "--set", "l_AC"]).assert().code(2);
    assert!(text(&run.get_output().stderr).contains("NAME=VALUE"));
}

/// A collinear parallelogram is answered, with the other motion beside it, and drawn as far as
/// lines intersect.
#[test]
fn a_change_point_is_answered_and_drawn() {
    let out = tempfile::tempdir().unwrap();
    let scene = out.path().join("in-line.json");
    hodograph()
        .args(["new", "parallelogram", "--set", "phi_1=0", "-o"])
        .arg(&scene)
        .assert()
        .success();
    let run = hodograph().args(["solve", "--json"]).arg(&scene).assert().success();
    let json: serde_json::Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
    assert_eq!(json["singular"][0]["kind"], "change-point");
    assert_eq!(json["singular"][0]["decided"], "side");
    assert_eq!(json["singular"][0]["links"], serde_json::json!(["1", "2", "3"]));
    assert!(json["condition"].is_null());
    let answer = |find: &str| {
        json["answers"].as_array().unwrap().iter().find(|a| a["find"] == find).unwrap().clone()
    };
    assert!((answer("omega_3")["value"]["value"].as_f64().unwrap() - 6.0).abs() < 1e-12);
    assert_eq!(answer("omega_2")["value"]["value"], 0.0);
    // Crank 150, coupler 300: the antiparallelogram's rocker turns at (1 + 2)/(1 − 2) times the
    // crank's rate.
    assert!((answer("omega_3")["others"][0]["value"].as_f64().unwrap() + 18.0).abs() < 1e-12);
    let said = text(
        &hodograph()
            .args(["draw", "-o"])
            .arg(out.path())
            .arg(&scene)
            .assert()
            .success()
            .get_output()
            .stderr,
    );
    assert!(said.contains("change-point") && said.contains("link 2 (BC)"), "{said}");
    let svg = std::fs::read_to_string(out.path().join("in-line.svg")).unwrap();
    assert!(svg.contains("Change point of links"), "the sheet says what is singular");
    hodograph().arg("plan").arg(&scene).assert().success();
}

#[test]
fn a_dead_point_leaves_the_rest_and_has_its_own_exit_code() {
    let out = tempfile::tempdir().unwrap();
    let scene = out.path().join("dead.json");
    std::fs::write(
        &scene,
        r#"{"links": {"1": ["A","B"], "2": ["B","C"], "3": ["C","D"], "4": ["A","D"]}, "ground": "4", "units": {"length": "m"},
          "points": {"A": [0,0], "B": [2,0], "C": [7,0], "D": [4,-4]}, "driver": {"link": "3", "omega": "1 rad/s"}, "find": ["omega_1", "v_C"]}"#,
    )
    .unwrap();
    let run =
        |args: &[&str]| hodograph().args(args).arg(&scene).assert().code(4).get_output().clone();
    let told = text(&run(&["solve"]).stdout);
    assert!(
        told.contains(
            "omega_1 = unbounded (dead centre: link 1 (AB) and link 2 (BC) lie in line at B)"
        ),
        "{told}"
    );
    assert!(told.contains("v_C     = 5.00000 m/s ∠ 143.13°"), "{told}");
    assert!(
        text(&run(&["solve", "--lang", "zh"]).stdout)
            .contains("omega_1 = 无界 (构件 1、2 处于死点位置)")
    );
    let json: serde_json::Value =
        serde_json::from_slice(&run(&["solve", "--json"]).stdout).unwrap();
    let [omega, v] = [0, 1].map(|i| json["answers"][i].clone());
    assert_eq!(
        (&omega["unbounded"], &omega["value"], &omega["why"]["links"]),
        (&true.into(), &serde_json::Value::Null, &serde_json::json!(["1", "2"]))
    );
    assert_eq!((&v["unbounded"], &v["value"]["magnitude"]), (&false.into(), &5.0.into()));
    assert!(
        text(&run(&["draw", "-o", out.path().to_str().unwrap()]).stderr).contains("dead-centre")
    );
    assert!(std::fs::read_to_string(out.path().join("dead.svg")).unwrap().contains("unbounded"));
    assert!(
        text(&hodograph().arg("--help").assert().success().get_output().stdout).contains("4 done")
    );
}

#[test]
fn help_names_every_command() {
    let help = text(&hodograph().arg("--help").assert().success().get_output().stdout);
    for command in ["draw", "solve", "plan", "worksheet", "new", "templates", "schema"] {
        assert!(help.contains(command), "{command}");
        hodograph().args([command, "--help"]).assert().success();
    }
}

#[test]
fn drafting_tells_tolerances_crossings_and_scales() {
    let solve = |args: &[&str]| {
        hodograph()
            .arg("solve")
            .arg("templates/shaper.json")
            .args(args)
            .assert()
            .success()
            .get_output()
            .stdout
            .clone()
    };
    let plain = text(&solve(&[]));
    assert!(!plain.contains('±'));
    let told = text(&solve(&["--drafting", "0.1mm", "--steps"]));
    let guide =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/guide.md")).unwrap();
    let shown = guide.split("## Drawing by hand").nth(1).unwrap().split("```").nth(1).unwrap();
    for line in shown
        .lines()
        .skip(1)
        .chain(["at 59.6°, where a pencil error of 0.1 mm moves it by 0.12 mm"])
    {
        assert!(told.contains(line), "no {line:?} in\n{told}");
    }
    assert_eq!(
        solve(&["--drafting"]),
        solve(&["--drafting=0.05 * 2 mm"]),
        "0.1 mm is the usual pencil"
    );
    let json: serde_json::Value =
        serde_json::from_slice(&solve(&["--json", "--drafting", "0.2mm"])).unwrap();
    let answer =
        json["answers"].as_array().unwrap().iter().find(|a| a["find"] == "alpha_4").unwrap();
    let (tolerance, relative) =
        (answer["tolerance"].as_f64().unwrap(), answer["relative"].as_f64().unwrap());
    assert!((tolerance / relative - answer["analysis"]["value"].as_f64().unwrap()).abs() < 1e-9);
    assert!(
        (answer["scale_for_1_percent"]["factor"].as_f64().unwrap() - relative * 100.0).abs() < 1e-9
    );
    assert_eq!(json["drafting"]["pencil_mm"], 0.2);
    let crossing = &json["drafting"]["crossings"][1];
    assert_eq!(
        (&crossing["point"], &crossing["drawing"]),
        (&"C".into(), &"velocity polygon".into())
    );
    let (sine, mm) =
        (crossing["sine"].as_f64().unwrap(), crossing["tolerance_mm"].as_f64().unwrap());
    assert!((mm * sine.abs() - 0.2).abs() < 1e-12);
    let plain: serde_json::Value = serde_json::from_slice(&solve(&["--json"])).unwrap();
    assert!(plain.get("drafting").is_none() && plain["answers"][0].get("tolerance").is_none());
}

#[test]
fn a_pencil_is_a_length() {
    for (length, words) in [
        ("9 mm", "blunter"),
        ("0 mm", "greater than zero"),
        ("3 deg", "an angle"),
        ("0.1", "no unit"),
    ] {
        let run = hodograph()
            .args(["solve", "templates/shaper.json", "--drafting", length])
            .assert()
            .code(2);
        let said = text(&run.get_output().stderr);
        assert!(said.contains(words) && said.contains("--drafting"), "{length}: {said}");
    }
    // Before the scene, a bare `--drafting` would take its name.
    let run = hodograph().args(["solve", "--drafting", "templates/shaper.json"]).assert().code(2);
    assert!(text(&run.get_output().stderr).contains("after the scene"));
    let out = tempfile::tempdir().unwrap();
    hodograph()
        .args(["draw", "templates/shaper.json", "--drafting", "-o"])
        .arg(out.path().join("sheet.svg"))
        .assert()
        .success();
    assert!(
        std::fs::read_to_string(out.path().join("sheet.svg"))
            .unwrap()
            .contains("result-v-C-tolerance")
    );
}

#[test]
fn a_bad_angle_is_a_warning_with_help() {
    let sets = ["--set", "phi_1=180", "--set", "l_BC=201", "--set", "l_CD=200"];
    let scene = hodograph()
        .args(["new", "crank-rocker"])
        .args(sets)
        .assert()
        .success()
        .get_output()
        .stdout
        .clone();
    let run = hodograph().args(["solve", "-"]).write_stdin(scene).assert().success();
    // Long lines are broken.
    let said = text(&run.get_output().stderr)
        .replace('│', " ")
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ");
    for words in ["bad-angle", "C is found under 8.1°", "8.8 times as large", "at phi_1 = 205 deg"]
    {
        assert!(said.contains(words), "no {words:?} in\n{said}");
    }
}

/// Fewer digits than requested cause a remark, never a wrong digit; programs get value, radius and
/// rung.
#[test]
fn digits_are_printed_as_far_as_they_are_certain() {
    let near = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/near-toggle.json");
    let out = hodograph().args(["solve", near, "--digits", "20"]).assert().success();
    let text = String::from_utf8(out.get_output().stdout.clone()).unwrap();
    let omega = text.lines().find(|l| l.trim_start().starts_with("omega_3")).unwrap();
    // Twenty digits and the point.
    assert!(omega.split_whitespace().nth(2).is_some_and(|n| n.len() == 21), "{omega}");
    assert!(!text.contains("certain"), "{text}");
    let out = hodograph().args(["solve", near, "--digits", "6", "--json"]).assert().success();
    let json: serde_json::Value = serde_json::from_slice(&out.get_output().stdout).unwrap();
    for answer in json["answers"].as_array().unwrap() {
        let c = &answer["certified"];
        assert_eq!(c["complete"], true, "{answer}");
        assert!(["f64", "double-double"].contains(&c["rung"].as_str().unwrap()), "{c}");
        for n in c["numbers"].as_object().unwrap().values() {
            assert!(
                n["radius"].as_f64().unwrap() >= 0.0 && n["digits"] == 6 && n["text"].is_string(),
                "{n}"
            );
        }
    }
    hodograph().args(["solve", near, "--digits", "31"]).assert().code(2);
}

/// The cost of accuracy: a table of all methods, a series toward the toggle, a figure; a crank has
/// no toggle.
#[test]
fn accuracy_tells_every_way_and_what_it_costs() {
    let folder = tempfile::tempdir().unwrap();
    let near = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/near-toggle.json");
    let figure = folder.path().join("costs.svg");
    let run = |extra: &[&str]| {
        let out =
            hodograph().args(["accuracy", near, "--patience", "1"]).args(extra).assert().success();
        String::from_utf8(out.get_output().stdout.clone()).unwrap()
    };
    let json: serde_json::Value =
        serde_json::from_str(&run(&["--json", "--toward-toggle", "-o", figure.to_str().unwrap()]))
            .unwrap();
    let ways = json["ways"].as_array().unwrap();
    let way =
        |name: &str| ways.iter().find(|w| w["way"] == name).unwrap_or_else(|| panic!("no {name}"));
    let error = |w: &serde_json::Value| w["acceleration"].as_f64().unwrap_or(f64::INFINITY);
    // A bound is a bound, longer numbers are more accurate, and paper is worst here.
    assert!(error(way("closed form, f64")) <= error(way("certified, f64")));
    assert!(error(way("closed form, double-double")) <= error(way("certified, double-double")));
    assert!(
        error(way("certified, double-double")) < 1e-15
            && error(way("closed form, 256 bit")) < 1e-55
    );
    assert!(way("paper, pencil 0.1 mm")["seconds"].is_null());
    assert_eq!(json["toward_toggle"].as_array().unwrap().len(), 12);
    let svg = std::fs::read_to_string(figure).unwrap();
    assert!(svg.starts_with("<svg") && svg.contains("What accuracy costs"));
    assert!(run(&["--lang", "zh"]).contains("有限差分"));
    let crank = concat!(env!("CARGO_MANIFEST_DIR"), "/templates/crank-rocker.json");
    let out = hodograph()
        .args(["accuracy", crank, "--patience", "1", "--toward-toggle"])
        .assert()
        .code(2);
    assert!(String::from_utf8_lossy(&out.get_output().stderr).contains("the driver turns fully"));
    hodograph().args(["accuracy", near, "--patience", "1", "-o", "costs.txt"]).assert().code(2);
}

/// A group of class IV has a range and strokes; a link on three legs stops where its legs intersect
/// in one point.
#[test]
fn limits_of_higher_groups_are_reported() {
    let scene = r#"{"links": {"1": ["O","A"], "2": ["A","B","C"], "3": ["B","D"], "4": ["C","E"], "5": ["D","E","G"], "6": ["O","G"]},
        "ground": "6", "find": ["v_D"], "units": {"length": "m"}, "driver": {"link": "1", "omega": "2 rad/s"},
        "points": {"O": [0,0], "A": [1,2], "B": [3,4], "C": [4,1.5], "D": [6,5], "E": [7,2], "G": [9,1]}}"#;
    let run = hodograph().args(["limits", "-"]).write_stdin(scene).assert().success();
    let said = text(&run.get_output().stdout);
    assert!(said.contains("phi_1 goes") && said.contains("phi_5 swings"), "{said}");
    let run = hodograph().args(["limits", &templates_path("class-iii-six-bar")]).assert().success();
    let said = text(&run.get_output().stdout);
    assert!(said.contains("the legs of link"), "{said}");
    let run = hodograph()
        .args(["limits", &templates_path("class-iii-six-bar"), "--lang", "zh"])
        .assert()
        .success();
    assert!(text(&run.get_output().stdout).contains("三条支链"));
}

#[test]
fn curvature_and_inversions_are_reported() {
    let scene = templates_path("crank-rocker");
    let run = hodograph().args(["curvature", &scene, "--steps", "--point", "E"]).assert().success();
    let said = text(&run.get_output().stdout);
    for line in [
        "inflection pole",
        "acceleration pole",
        "Ball's point",
        "collineation axis (Bobillier)",
        "at E_0, the centre of the path of E",
    ] {
        assert!(said.contains(line), "{line} is not in\n{said}");
    }
    let run = hodograph().args(["curvature", &scene, "--steps", "--lang", "zh"]).assert().success();
    let said = text(&run.get_output().stdout);
    assert!(said.contains("拐点圆") && said.contains("鲍尔点") && !said.contains("pole"), "{said}");
    let run = hodograph().args(["curvature", &scene, "--json", "--centrodes"]).assert().success();
    let json: serde_json::Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
    assert!(
        json["links"][0]["apart"].as_f64().unwrap() < 1e-11
            && json["links"][0]["centrodes"]["fixed"].as_array().unwrap().len() >= 720
    );
    // All missing names are reported at once.
    let run = hodograph()
        .args(["curvature", &scene, "--link", "9", "--point", "Z", "--against", "8"])
        .assert()
        .code(2);
    let said = text(&run.get_output().stderr);
    assert!(
        ["no link `9`", "no link `8`", "no point `Z`"].iter().all(|w| said.contains(w)),
        "{said}"
    );
    hodograph().args(["curvature", &scene, "--link", "4"]).assert().code(2);
    let run = hodograph().args(["inversions", &scene]).assert().success();
    let said = text(&run.get_output().stdout);
    assert!(
        said.contains("link 1 fixed: double crank (drag link); links 2, 4 turn fully")
            && said.contains("(as in the scene): crank-rocker"),
        "{said}"
    );
    let run = hodograph().args(["inversions", &scene, "--pick", "7"]).assert().code(2);
    assert!(text(&run.get_output().stderr).contains("the grounds are"));
    // A written inversion is a scene like any other.
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("inverted.json");
    hodograph()
        .args(["inversions", &scene, "--pick", "1", "-o", out.to_str().unwrap()])
        .assert()
        .success();
    hodograph().args(["solve", out.to_str().unwrap()]).assert().success();
    hodograph()
        .args(["inversions", &scene, "-o", folder.path().to_str().unwrap()])
        .assert()
        .success();
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 5);
    let run =
        hodograph().args(["inversions", &templates_path("planetary-gear")]).assert().success();
    let said = text(&run.get_output().stdout);
    // The arm held: an ordinary train, −z_2/z_1; the sun held: ω_1/ω_3 = 1 + z_2/z_1; the ring
    // held: ω_2/ω_3 = 1 + z_1/z_2.
    for line in ["gear train with fixed axes", "= −0.5", "= 1.5", "= 3"] {
        assert!(said.contains(line), "{line} is not in\n{said}");
    }
    hodograph().args(["inversions", &templates_path("cam-offset-roller")]).assert().code(2);
}

#[test]
fn cognates_take_a_scene_file_beside_the_task() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::copy(templates_path("crank-rocker"), folder.path().join("linkage.json")).unwrap();
    let task = folder.path().join("task.json");
    std::fs::write(&task, r#"{"synthesis": "cognates", "scene": "linkage.json", "point": "E"}"#)
        .unwrap();
    let run = hodograph().args(["synth", task.to_str().unwrap()]).assert().success();
    assert!(text(&run.get_output().stdout).contains("right cognate"));
    std::fs::write(&task, r#"{"synthesis": "cognates", "scene": "not-there.json"}"#).unwrap();
    hodograph().args(["synth", task.to_str().unwrap()]).assert().code(2);
}

#[test]
fn centres_are_reported_with_how_they_are_found() {
    let shaper = templates_path("shaper");
    let run = hodograph().args(["centres", &shaper]).assert().success();
    let said = text(&run.get_output().stdout);
    for line in [
        "15 centres: 7 at the pairs, 8 by the theorem",
        "P13     relative  1      12·23 × 16·36",
        "at infinity",
        "the same sense",
        "loop equations",
    ] {
        assert!(said.contains(line), "{line} is not in\n{said}");
    }
    let run = hodograph().args(["centres", &shaper, "--lang", "zh"]).assert().success();
    let said = text(&run.get_output().stdout);
    assert!(
        said.contains("15 个瞬心") && said.contains("转向相同") && !said.contains("centre"),
        "{said}"
    );
    let run =
        hodograph().args(["centres", &shaper, "--json", "--set", "phi_1=200"]).assert().success();
    let json: serde_json::Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
    assert_eq!(
        ["count", "primary", "by_theorem", "by_velocities"].map(|key| json[key].as_u64()),
        [15, 7, 8, 0].map(Some),
        "the counts of the three ways add up to all centres"
    );
    assert_eq!(json["stalled"].as_bool(), Some(false));
    let found = json["centres"].as_array().unwrap();
    assert!(found.iter().all(|c| c["at"].is_array() != c["infinity_deg"].is_number()), "{found:?}");
    // A scene without angular velocities has the same centres.
    let scene = std::fs::read_to_string(&shaper).unwrap();
    let rate = scene.lines().find(|l| l.contains("\"driver\"")).unwrap();
    let without = scene.replace(rate, &rate.replace(", \"omega\": \"omega_1\"", ""));
    assert!(without != scene, "{rate}");
    let run = hodograph()
        .args(["centres", "-", "--json", "--set", "phi_1=200"])
        .write_stdin(without)
        .assert()
        .success();
    let bare: serde_json::Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
    for (a, b) in bare["centres"].as_array().unwrap().iter().zip(found) {
        assert_eq!((&a["name"], &a["how"], &a["at"]), (&b["name"], &b["how"], &b["at"]));
    }
}
