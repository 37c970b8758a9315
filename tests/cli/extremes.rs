//! Extreme positions, transmission angles, and zeros of quantities over the whole motion.

use super::{hodograph, text};
use serde_json::Value as Json;

/// The words of a drawing in SVG.
fn drawn(scene: &str, figure: &str) -> String {
    let run = hodograph()
        .args(["draw", scene, "--figure", figure, "-o", "-", "--format", "svg"])
        .assert()
        .success();
    text(&run.get_output().stdout)
}

#[test]
fn the_extremes_of_a_quick_return_bear_its_angles_stroke_and_ratio() {
    let svg = drawn("templates/shaper.json", "extremes");
    for words in ["θ = 33.65°", "= 376.3", "K = (180° + θ)/(180° − θ) = 213.7°/146.3° = 1.460"]
    {
        assert!(svg.contains(words), "{words}");
    }
}

#[test]
fn the_transmission_angle_is_drawn_with_the_law_of_cosines() {
    let svg = drawn("templates/crank-rocker.json", "transmission");
    // acos((250² + 200² − 200²)/(2·250·200)) and 180° − acos((250² + 200² − 400²)/(2·250·200)).
    for words in ["0.6250", "51.32°", "−0.5750", "54.90°", "71.03°"] {
        assert!(svg.contains(words), "{words}");
    }
}

#[test]
fn without_extremes_or_transmission_angles_the_reason_is_told() {
    for (template, figure, code, reason) in [
        ("drag-link", "extremes", "no-extremes", "turns fully"),
        ("slotted-lever", "transmission", "no-transmission", "lever with a slide"),
        ("class-iii-six-bar", "transmission", "no-transmission", "above class II"),
    ] {
        let scene = format!("templates/{template}.json");
        let run = hodograph()
            .args(["draw", &scene, "--figure", figure, "-o", "-", "--errors", "json"])
            .args(["--format", "svg"])
            .assert()
            .code(2);
        let said = text(&run.get_output().stderr);
        assert!(said.contains(code) && said.contains(reason), "{template}: {said}");
    }
}

/// The Coriolis acceleration of a shaper's block vanishes where the lever is at rest, its extreme
/// positions, and where crank and lever are in line.
#[test]
fn zeros_of_a_quantity_are_listed_beside_its_extremes() {
    let shaper = "templates/shaper.json";
    let run = hodograph()
        .args(["limits", shaper, "--find", "ak_A3A2,omega_3", "--json"])
        .assert()
        .success();
    let json: Json = serde_json::from_slice(&run.get_output().stdout).unwrap();
    let zeros = |k: usize| -> Vec<f64> {
        let all = json["quantities"][k]["zeros"].as_array().unwrap();
        all.iter().map(|z| z["driver"].as_f64().unwrap().to_degrees()).collect()
    };
    let (coriolis, [lever, _]) =
        if json["quantities"][0]["quantity"] == "omega_3" { (1, [0, 1]) } else { (0, [1, 0]) };
    let (coriolis, lever) = (zeros(coriolis), zeros(lever));
    let run = hodograph().args(["limits", shaper, "--json"]).assert().success();
    let limits: Json = serde_json::from_slice(&run.get_output().stdout).unwrap();
    let extreme =
        |k: usize| limits["outputs"][0]["extremes"][k]["driver"].as_f64().unwrap().to_degrees();
    let wanted = [90.0, extreme(0), 270.0, extreme(1)];
    assert_eq!(coriolis.len(), 4, "{coriolis:?}");
    coriolis.iter().zip(wanted).for_each(|(a, b)| assert!((a - b).abs() < 1e-9, "{a} {b}"));
    assert!(lever.len() == 2 && (lever[0] - wanted[1]).abs() < 1e-9, "{lever:?}");
    for (lang, words) in [("en", "zero at phi_1 = 90.0000°"), ("zh", "零点：φ_1 = 90.0000°")]
    {
        let args = ["limits", shaper, "--find", "ak_A3A2", "--lang", lang];
        let said = text(&hodograph().args(args).assert().success().get_output().stdout);
        assert!(said.contains(words), "{said}");
    }
}

/// The three motions are named in the report, for programs, and in a worksheet.
#[test]
fn the_three_motions_and_the_transport_point_are_named() {
    let scene = "templates/lathe.json";
    let wanted = [
        ("en", ["transport motion: rotation about O", "transport point: the point of link 2"]),
        ("zh", ["牵连运动：绕 O 的定轴转动", "牵连点：构件 2 上与 T 重合的点"]),
    ];
    for (lang, words) in wanted {
        let run = hodograph().args(["composite", scene, "--lang", lang]).assert().success();
        let said = text(&run.get_output().stdout);
        words.iter().for_each(|w| assert!(said.contains(w), "{w}: {said}"));
    }
    let run = hodograph().args(["composite", scene, "--json"]).assert().success();
    let json: Json = serde_json::from_slice(&run.get_output().stdout).unwrap();
    let choices = json["choices"].as_array().unwrap();
    let named = choices.iter().find(|c| c["named"] == true).unwrap();
    assert_eq!(named["motions"]["transport"], "rotation about O");
    let args = ["worksheet", scene, "-o", "-", "--format", "html", "--lang", "zh"];
    let sheet = text(&hodograph().args(args).assert().success().get_output().stdout);
    assert!(sheet.contains("牵连点") && sheet.contains("绝对运动"), "{sheet}");
}

#[test]
fn a_point_has_no_path_on_its_own_link() {
    let path = |link: &str| {
        let args = ["path", "templates/crank-rocker.json", "--point", "E", "--against", link];
        hodograph().args(args).args(["-o", "-", "--format", "svg"]).assert()
    };
    let svg = text(&path("1").success().get_output().stdout);
    assert!(svg.contains("seen from link 1"), "{svg}");
    let said = text(&path("2").code(2).get_output().stderr);
    assert!(said.contains("point E belongs to link 2"), "{said}");
    let said = text(&path("9").code(2).get_output().stderr);
    assert!(said.contains("no link `9`"), "{said}");
}
