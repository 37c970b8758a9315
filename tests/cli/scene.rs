//! Scenes as input of the commands: with other parameters, from standard input, without data that a
//! command does not need.

use super::{hodograph, text};

const SCENE: &str = r#"{"parameters": {"r": "100 mm", "w": "10 rad/s"}, "links": {"1": ["A", "O2"], "4": ["A"]}, "ground": "4",
 "lengths": {"A,O2": "r"}, "driver": {"link": "1", "angle": "30 deg", "omega": "w"}, "find": ["v_O2"]}"#;

/// Every command that takes a scene takes `--set`, and a scene from standard input.
#[test]
fn parameters_are_set_and_scenes_piped_everywhere() {
    let out = tempfile::tempdir().unwrap();
    let file = |name: &str| out.path().join(name).to_string_lossy().into_owned();
    let crank = hodograph::scene::templates::get("crank-rocker").unwrap();
    for arguments in [
        vec!["solve"],
        vec!["plan"],
        vec!["plan", "--json", "--figure"],
        vec!["limits"],
        vec!["centres"],
        vec!["curvature", "--steps"],
        vec!["inversions"],
        vec!["draw", "--figure", "curvature", "-o", &file("curvature.svg")],
        vec!["draw", "--figure", "centres", "-o", &file("centres.svg")],
        vec!["accuracy", "--patience", "1"],
        vec!["draw", "-o", &file("sheet.svg")],
        vec!["lesson", "--positions", "8", "-o", &file("lesson.html")],
        vec!["worksheet", "-o", &file("sheet.md")],
        vec!["sweep", "--steps", "4"],
        vec!["curves", "--steps", "4", "-o", &file("curves.svg")],
        vec!["path", "--point", "E", "-o", &file("path.svg")],
        vec!["batch", "--vary", "l_AB=80..100:2", "-o", &file("batch.csv")],
    ] {
        let run = |set: &str| {
            let mut all = arguments.clone();
            all.insert(1, "-");
            hodograph().args(all).args(["--set", set]).write_stdin(crank).assert()
        };
        run("l_BC=260").success();
        let failed = run("l_bc=260").code(2);
        let said = text(&failed.get_output().stderr);
        assert!(
            said.contains("the scene has no parameter `l_bc`")
                && said.contains("did you mean `l_BC`?"),
            "{arguments:?}: {said}"
        );
    }
}

#[test]
fn a_parameter_of_ones_own_scene() {
    let solve = |set: &[&str]| {
        let run = hodograph()
            .args(["solve", "-"])
            .args(set.iter().flat_map(|s| ["--set", s]))
            .write_stdin(SCENE)
            .assert();
        let output = run.get_output();
        (output.status.code(), text(&output.stdout), text(&output.stderr))
    };
    assert!(solve(&[]).1.contains("v_O2 = 1.00000 m/s"));
    assert!(
        solve(&["r=120", "w=60 rpm/2"]).1.contains("v_O2 = 0.376991 m/s"),
        "{:?}",
        solve(&["r=120", "w=60 rpm/2"])
    );
    let (code, _, said) = solve(&["r"]);
    assert!(code == Some(2) && said.contains("`--set r` has no `=`"), "{said}");
    let (code, _, said) = solve(&["r=1 s"]);
    assert!(code == Some(2) && said.contains("a length is wanted here"), "{said}");
}

/// Names of points may be separated by a comma, like the questions of a list.
#[test]
fn a_list_of_questions_may_hold_commas() {
    let sweep = |find: &str| {
        let run = hodograph()
            .args(["sweep", "-", "--steps", "2", "--find", find])
            .write_stdin(SCENE)
            .assert()
            .success();
        text(&run.get_output().stdout)
            .lines()
            .find(|l| !l.starts_with('#'))
            .unwrap_or_default()
            .to_owned()
    };
    let head = sweep("v_A,O2,omega_1,x_O2");
    for column in ["v_A,O2", "omega_1", "x_O2"] {
        assert!(head.contains(column), "{head}");
    }
    // A question with a comma is asked again for its curves.
    let out = tempfile::tempdir().unwrap();
    let with_comma = SCENE.replace("\"v_O2\"", "\"v_O2,A\", \"omega_1\"");
    hodograph()
        .args(["curves", "-", "--steps", "4", "-o"])
        .arg(out.path().join("c.svg"))
        .write_stdin(with_comma)
        .assert()
        .success();
}

/// The range of a driver depends neither on its speed nor on its angle.
#[test]
fn limits_need_neither_rate_nor_angle() {
    let limits = |scene: &str| {
        let run = hodograph().args(["limits", "-"]).write_stdin(scene).assert().success();
        // The start of the motion decides which of its extremes is printed first.
        let mut lines: Vec<String> =
            text(&run.get_output().stdout).lines().map(str::to_owned).collect();
        lines.sort();
        lines
    };
    for name in ["crank-rocker", "crossed-four-bar", "offset-slider-crank"] {
        let whole = hodograph::scene::templates::get(name).unwrap();
        let mut scene: serde_json::Value = serde_json::from_str(whole).unwrap();
        let driver = scene["driver"].as_object_mut().unwrap();
        driver.retain(|key, _| key == "link");
        let bare = scene.to_string();
        assert_eq!(limits(&bare), limits(whole), "{name}");
        hodograph().args(["solve", "-"]).write_stdin(bare).assert().code(2);
    }
}

/// A missing answer has the keys of an existing one.
#[test]
fn refused_answers_keep_their_keys() {
    for drafting in [&[][..], &["--drafting"]] {
        let dead = r#"{"links": {"1": ["A","B"], "2": ["B","C"], "3": ["C","D"], "4": ["A","D"]}, "ground": "4", "units": {"length": "m"},
 "points": {"A": [0,0], "B": [2,0], "C": [7,0], "D": [4,-4]}, "driver": {"link": "3", "omega": "1 rad/s"}, "find": ["v_C", "omega_1"]}"#;
        let run = hodograph()
            .args(["solve", "-", "--json"])
            .args(drafting)
            .write_stdin(dead)
            .assert()
            .code(4);
        let json: serde_json::Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
        let keys = |k: usize| {
            let mut keys: Vec<_> =
                json["answers"][k].as_object().unwrap().keys().cloned().collect();
            keys.sort();
            keys
        };
        assert_eq!(keys(0), keys(1));
        assert!(
            json["answers"][1]["drawing"].is_null()
                && json["answers"][1]["why"].is_object()
                && json["answers"][0]["why"].is_null()
        );
    }
}

#[test]
fn an_unknown_ending_is_refused() {
    let out = tempfile::tempdir().unwrap();
    for (command, name, right) in
        [("draw", "x.gif", ".png"), ("draw", "deep/x.jpeg", ".pdf"), ("lesson", "x.gif", ".html")]
    {
        let path = out.path().join(name);
        let run = hodograph()
            .args([command, "templates/crank-rocker.json", "-o"])
            .arg(&path)
            .assert()
            .code(2);
        let said = text(&run.get_output().stderr);
        assert!(said.contains(name) && said.contains(right), "{said}");
        assert!(!path.exists());
    }
    assert_eq!(std::fs::read_dir(out.path()).unwrap().count(), 0);
    // A folder is an existing one, or a name that ends like a folder's.
    let folder = format!("{}/v1.2/", out.path().display());
    for _ in 0..2 {
        let draw = ["draw", "templates/crank-rocker.json", "--format", "svg", "-o"];
        hodograph()
            .args(draw)
            .arg(folder.trim_end_matches('/').to_owned() + "/")
            .assert()
            .success();
    }
    hodograph()
        .args(["draw", "templates/crank-rocker.json", "--format", "svg", "-o"])
        .arg(folder.trim_end_matches('/'))
        .assert()
        .success();
}
