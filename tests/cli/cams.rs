//! `hodograph cam`: report, figures, the profile for milling.

use super::{hodograph, text};

#[test]
fn a_cam_is_reported_drawn_and_written_out() {
    let out = tempfile::tempdir().unwrap();
    let run = hodograph()
        .args(["cam", "templates/cam-offset-roller.json", "--lang", "zh", "--dpi", "40", "-o"])
        .arg(out.path())
        .assert()
        .success();
    let said = text(&run.get_output().stdout);
    assert!(said.contains("偏距 e = 10.0000 mm") && said.contains("柔性冲击"), "{said}");
    let mut names: Vec<String> = std::fs::read_dir(out.path())
        .unwrap()
        .map(|f| f.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    let expected = ["motion.png", "motion.svg", "profile.png", "profile.svg"]
        .map(|n| format!("cam-offset-roller-cam-{n}"));
    assert_eq!(names, expected);

    let csv = out.path().join("cam.csv");
    hodograph()
        .args(["cam", "templates/cam-offset-roller.json", "--steps", "360", "--profile"])
        .arg(&csv)
        .assert()
        .success();
    let table = std::fs::read_to_string(csv).unwrap();
    assert!(table.starts_with("phi [deg],s [mm],ds [mm/rad]"), "{table}");
    // A row for each degree, and the end of the turn.
    assert_eq!(table.lines().count(), 362);

    let dxf = out.path().join("cam.dxf");
    hodograph()
        .args(["cam", "templates/cam-valve-train.json", "--profile"])
        .arg(&dxf)
        .assert()
        .success();
    let drawing = std::fs::read_to_string(dxf).unwrap();
    let count = |what: &str| drawing.lines().filter(|l| *l == what).count();
    // Two arcs and two flanks are kept; the centre is a cross.
    assert_eq!((count("ARC"), count("LINE"), count("POLYLINE")), (2, 4, 0), "{drawing}");
}

/// The radius of a straight flank is not a number: an empty field, null, and infinity in binary
/// tables; the row exists.
#[test]
fn an_infinite_radius_has_a_row_in_every_table() {
    let out = tempfile::tempdir().unwrap();
    let sweep = |name: &str| {
        let path = out.path().join(name);
        let asked = [
            "sweep",
            "templates/cam-valve-train.json",
            "--steps",
            "36",
            "--find",
            "rho_2/3",
            "--lang",
            "zh",
            "-o",
        ];
        hodograph().args(asked).arg(&path).assert().success();
        std::fs::read(path).unwrap()
    };
    let csv = String::from_utf8(sweep("rho.csv")).unwrap();
    let rows: Vec<&str> =
        csv.lines().filter(|l| l.starts_with(|c: char| c.is_ascii_digit())).collect();
    let empty = rows.iter().filter(|l| l.ends_with(',')).count();
    assert!(
        rows.len() == 37
            && empty > 0
            && csv.contains("# rho_2/3 在 phi_2 = ")
            && csv.contains("为无穷大"),
        "{csv}"
    );
    assert!(!rows.iter().any(|l| l.contains("inf")), "{csv}");
    let json: serde_json::Value = serde_json::from_slice(&sweep("rho.json")).unwrap();
    let values = json["columns"][1]["values"].as_array().unwrap();
    assert_eq!((values.len(), values.iter().filter(|v| v.is_null()).count()), (37, empty));
    let npy = sweep("rho.npy");
    let number = |k: usize| f64::from_le_bytes(npy[npy.len() - 8 * k..][..8].try_into().unwrap());
    assert_eq!((0..37).filter(|row| number(2 * row + 1) == f64::INFINITY).count(), empty);
}

#[test]
fn a_cam_for_programs() {
    let run =
        hodograph().args(["cam", "templates/cam-offset-roller.json", "--json"]).assert().success();
    let list: serde_json::Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
    let cam = &list[0];
    let number = |path: &str| {
        cam.pointer(path)
            .and_then(serde_json::Value::as_f64)
            .unwrap_or_else(|| panic!("no {path} in {cam}"))
    };
    assert!(
        (number("/stroke") - 0.02).abs() < 1e-15
            && (number("/least_rho/value") - 0.037_257_387_229_340_7).abs() < 1e-12
    );
    assert!((number("/now/pressure_angle").to_degrees() - 8.553_423_323_410_39).abs() < 1e-10);
    assert_eq!(cam["shocks"].as_array().unwrap().len(), 2);
}

#[test]
fn what_does_not_work_is_reported() {
    let run = |args: &[&str]| text(&hodograph().arg("cam").args(args).output().unwrap().stderr);
    // Case cam-undercut: the pitch curve has a radius of 19 mm at the end of the rise, the roller
    // one of 25 mm.
    let sharp = std::fs::read_to_string(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/templates/cam-offset-roller.json"
    ))
    .unwrap();
    let sharp = sharp.replace(
        "\"over\": \"120 deg\", \"law\": \"cycloidal\"}, {\"dwell\": \"60 deg\"",
        "\"over\": \"50 deg\", \"law\": \"harmonic\"}, {\"dwell\": \"130 deg\"",
    );
    let mut cam = hodograph();
    let undercut = cam
        .args(["cam", "-", "--set", "r0=15", "--set", "rr=25", "--set", "e=0"])
        .write_stdin(sharp)
        .output()
        .unwrap();
    let undercut = text(&undercut.stderr);
    assert!(
        undercut.contains("undercut")
            && undercut.contains("18.9873 mm")
            && undercut.contains("least base circle"),
        "{undercut}"
    );
    let steep = run(&["templates/cam-offset-roller.json", "--set", "h=60", "--lang", "zh"]);
    assert!(steep.contains("压力角"), "{steep}");
    for (args, said) in [
        (vec!["templates/crank-rocker.json"], "the scene has no cam"),
        (vec!["templates/cam-offset-roller.json", "--cam", "2"], "there is no cam 2"),
        (vec!["templates/cam-offset-roller.json", "-o", "cam.svg"], "would be a folder"),
        (
            vec!["templates/cam-offset-roller.json", "--profile", "cam.step"],
            "neither a .csv nor a .dxf",
        ),
    ] {
        let out = hodograph().arg("cam").args(&args).output().unwrap();
        assert_eq!(out.status.code(), Some(2), "{args:?}");
        assert!(text(&out.stderr).contains(said), "{args:?}: {}", text(&out.stderr));
    }
}

/// A swinging flat face on a profile of several pieces: in a sweep the contact passes from piece to
/// piece, whether the face is given by a line or by the pivot alone.
#[test]
fn a_swinging_face_goes_over_its_joints_with_a_line_and_without() {
    let scene = |points: &str, face: &str| {
        format!(
            r#"{{"links": {{"1": ["O", "P"], "2": ["O", "Q"], "3": [{points}]}}, "ground": "1", "points": {{"O": [0, 0], "P": ["95 mm", "10 mm"]}},
            "lengths": {{"OQ": "35 mm"{}}}, "sketch": {{{}}}, "cams": [{{"cam": "2", "follower": "3", "face": {{"through": "P", {face} "cam": "left"}},
            "profile": [{{"centre": "O", "radius": "30 mm"}}, {{"radius": "70 mm"}}, {{"centre": "Q", "radius": "4 mm"}}, {{"radius": "75 mm"}}]}}],
            "driver": {{"link": "2", "angle": "30 deg", "omega": "3 rad/s"}}, "find": ["omega_3"]}}"#,
            if face.is_empty() { "" } else { r#", "PB": "90 mm""# },
            if face.is_empty() { "" } else { r#""B": ["40 mm", "60 mm"]"# },
        )
    };
    let run = |text: String| {
        hodograph().args(["sweep", "-", "--steps", "8"]).write_stdin(text).output().unwrap()
    };
    let rows = |out: &std::process::Output| -> Vec<Vec<f64>> {
        assert!(!text(&out.stderr).contains("cam-piece"), "{}", text(&out.stderr));
        let told = text(&out.stdout);
        let rows = told.lines().filter(|l| !l.starts_with('#')).skip(1);
        rows.map(|l| l.split(',').map(|cell| cell.parse().unwrap()).collect()).collect()
    };
    let bare = rows(&run(scene("\"P\"", "")));
    let lined = rows(&run(scene("\"P\", \"B\"", "\"line\": \"PB\",")));
    assert_eq!((bare.len(), lined.len()), (9, 9));
    for (a, b) in bare.iter().flatten().zip(lined.iter().flatten()) {
        assert!((a - b).abs() <= 1e-9 * b.abs().max(1.0), "{bare:?}\n{lined:?}");
    }
}

/// Every field of a profile is a number or empty: a straight flank has no radius.
#[test]
fn profiles_have_no_infinite_numbers() {
    let out = tempfile::tempdir().unwrap();
    let csv = out.path().join("p.csv");
    let (mut tables, mut straight) = (0, 0);
    for t in hodograph::scene::templates::list() {
        let scene = super::templates_path(t.name);
        let mut run = hodograph();
        if !run
            .args(["cam", &scene, "--cam", "1", "--steps", "90", "--profile"])
            .arg(&csv)
            .output()
            .unwrap()
            .status
            .success()
        {
            continue;
        }
        tables += 1;
        let table = std::fs::read_to_string(&csv).unwrap();
        for field in table.lines().skip(1).flat_map(|l| l.split(',')) {
            straight += usize::from(field.is_empty());
            assert!(
                field.is_empty() || field.parse::<f64>().is_ok_and(f64::is_finite),
                "{}: {field}",
                t.name
            );
        }
    }
    assert!(tables > 3 && straight > 0, "{tables} {straight}");
}

/// The least base circle for an allowed pressure angle; by hand, with the given offset e = 10 mm the
/// start of the rise decides: r = e/sin 30°.
#[test]
fn the_least_base_circle_for_an_allowed_pressure_angle() {
    let cam = ["cam", "templates/cam-offset-roller.json", "--alpha"];
    let out = hodograph().args(cam).args(["30deg", "--json"]).output().unwrap();
    let json: serde_json::Value = serde_json::from_slice(&out.stdout).unwrap();
    let of = |way: &str, key: &str| json[0]["least"][way][key].as_f64().unwrap();
    assert!((of("kept", "pitch_base") - 0.02).abs() < 1e-12, "{json}");
    assert!((of("kept", "base") - 0.01).abs() < 1e-12);
    assert!(of("best", "pitch_base") < 0.0141 && of("best", "offset") > 0.0);
    assert!((of("best", "greatest_roller") - 0.8 * of("best", "least_rho")).abs() < 1e-12);

    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().to_str().unwrap();
    let out = hodograph()
        .args(cam)
        .args(["30deg", "--lang", "zh", "--format", "svg", "-o", place])
        .output()
        .unwrap();
    let told = text(&out.stdout);
    assert!(told.contains("许用压力角：推程 [α] = 30°，回程 [α′] = 75°"), "{told}");
    let svg = std::fs::read_to_string(folder.path().join("cam-offset-roller-cam-alpha.svg"));
    assert!(svg.unwrap().contains("按许用压力角确定基圆半径"));

    for wrong in ["0deg", "90deg", "120deg"] {
        let out = hodograph().args(cam).arg(wrong).output().unwrap();
        assert!(text(&out.stderr).contains("cam-alpha"), "{wrong}");
    }
}

/// The valve has no points: its stroke is that of the end of the rocker arm, 50 mm from its pivot.
#[test]
fn a_slider_without_points_has_its_stroke() {
    let output = hodograph().args(["limits", "templates/cam-valve-train.json"]).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let after = |words: &str| -> f64 {
        let rest = text.split(words).nth(1).unwrap_or_else(|| panic!("{words}: {text}"));
        rest.split([' ', '°']).next().unwrap().parse().unwrap()
    };
    let arm = [130.137_f64, 121.906].map(|angle| 50.0 * angle.to_radians().sin());
    assert!(text.contains("phi_5 = 130.137°") && text.contains("phi_5 = 121.906°"), "{text}");
    assert!((after("s_6 has a stroke of ") - (arm[0] - arm[1]).abs()).abs() < 1e-3, "{text}");
}

/// A follower that a cam leads by its law is no second driver.
#[test]
fn a_path_has_one_driver_where_a_cam_leads_its_follower() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("path.svg");
    hodograph()
        .args([
            "path",
            "templates/cam-offset-roller.json",
            "--point",
            "B",
            "-o",
            path.to_str().unwrap(),
        ])
        .assert()
        .success();
    assert!(!std::fs::read_to_string(path).unwrap().contains("stand still"));
}

/// The list of a mechanism with a cam names the link in place of the contact, as its figure does.
#[test]
fn lists_and_figure_name_the_link_in_place_of_a_contact() {
    let scene = "templates/cam-eccentric.json";
    let words = "link 4: block pinned at B, the centre of curvature of cam 2";
    for command in ["mobility", "plan"] {
        let out = hodograph().args([command, scene]).output().unwrap();
        let told = text(&out.stdout);
        assert!(told.contains(words) && told.contains("links 3, 4: class II, RPR"), "{told}");
    }
    let folder = tempfile::tempdir().unwrap();
    let svg = folder.path().join("replaced.svg");
    hodograph()
        .args(["draw", scene, "--figure", "replaced", "-o", svg.to_str().unwrap()])
        .assert()
        .success();
    assert!(std::fs::read_to_string(svg).unwrap().contains(words));
    let out = hodograph()
        .args(["draw", "templates/shaper.json", "--figure", "replaced", "-o", "-"])
        .output()
        .unwrap();
    assert!(text(&out.stderr).contains("no-replacement"));
}
