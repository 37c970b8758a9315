//! Cams behind gears, belts and chains: the same numbers as for the cam driven directly with the
//! train's angular velocity and acceleration, in every pose and in sweeps over several turns.

use crate::{ALPHA, OMEGA, PROFILES, component, text};
use hodograph::mechanism::Mechanism;
use hodograph::scene::{self, Angle, Scene};
use hodograph::sweep::{self, PlacedScene, Stations, Width};
use hodograph::worked::{Scope, work};
use serde_json::{Value as Json, json};

/// The angle of the driver (deg).
const DRIVER: f64 = 50.0;

/// Trains from wheel 8 about A to the cam 2 about O, with the wheels between the two, and the ratio
/// ω₂/ω₈.
fn trains() -> Vec<(&'static str, Json, f64)> {
    let pair = |links: [&str; 2], centres: [&str; 2], more: Json| {
        let mut entry = json!({"links": links, "centres": centres});
        entry.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        entry
    };
    let to_cam = |more: Json| pair(["8", "2"], ["A", "O"], more);
    vec![
        ("teeth", json!({"gears": [to_cam(json!({"teeth": [20, 41]}))]}), -20.0 / 41.0),
        (
            "cam first",
            json!({"gears": [pair(["2", "8"], ["O", "A"], json!({"teeth": [41, 20]}))]}),
            -20.0 / 41.0,
        ),
        ("radii", json!({"gears": [to_cam(json!({"radii": ["25 mm", "125 mm"]}))]}), -0.2),
        (
            "in a ring",
            json!({"gears": [to_cam(json!({"teeth": [61, 20], "ring": "8"}))]}),
            61.0 / 20.0,
        ),
        (
            "round a ring",
            json!({"gears": [pair(["2", "8"], ["O", "A"], json!({"teeth": [61, 20], "ring": "2"}))]}),
            20.0 / 61.0,
        ),
        (
            "idler",
            json!({"gears": [pair(["8", "9"], ["A", "D"], json!({"teeth": [20, 30]})), pair(["9", "2"], ["D", "O"], json!({"teeth": [30, 40]}))]}),
            0.5,
        ),
        (
            "idler with a phase",
            json!({"gears": [pair(["2", "9"], ["O", "D"], json!({"teeth": [40, 30]})), pair(["8", "9"], ["A", "D"], json!({"teeth": [20, 30], "phase": "20 deg"}))]}),
            0.5,
        ),
        (
            "belt",
            json!({"belts": [{"pulleys": ["8", "2"], "centres": ["A", "O"], "radii": ["30 mm", "60 mm"]}]}),
            0.5,
        ),
        (
            "crossed belt",
            json!({"belts": [{"pulleys": ["2", "8"], "centres": ["O", "A"], "radii": ["60 mm", "30 mm"], "crossed": true}]}),
            -0.5,
        ),
        (
            "chain",
            json!({"chains": [{"sprockets": ["8", "2"], "centres": ["A", "O"], "teeth": [19, 38], "pitch": "5 mm"}]}),
            0.5,
        ),
    ]
}

/// The scene of a kind of cam, driven by a wheel, with the cam at an angle.
fn geared(kind: &str, train: &Json, angle: f64) -> Scene {
    let mut scene: Json = serde_json::from_str(&text(kind, "0 deg")).unwrap();
    scene.as_object_mut().unwrap().extend(train.as_object().unwrap().clone());
    scene["links"]["8"] = json!(["A"]);
    scene["links"]["1"].as_array_mut().unwrap().push(json!("A"));
    scene["points"]["A"] = json!(["-120 mm", "90 mm"]);
    let third = train.to_string().contains("\"9\"");
    if third {
        scene["links"]["9"] = json!(["D", "U"]);
        scene["links"]["1"].as_array_mut().unwrap().push(json!("D"));
        scene["points"]["D"] = json!(["-100 mm", "-10 mm"]);
        scene["lengths"]["DU"] = json!("10 mm");
        if !train.to_string().contains("phase") {
            scene["links"]["9"] = json!(["D"]);
            scene["lengths"].as_object_mut().unwrap().remove("DU");
        }
    }
    scene["driver"]["link"] = json!("8");
    scene["driver"]["angle"] = json!(format!("{DRIVER} deg"));
    scene["cams"][0]["angle"] = json!(format!("{angle:?} deg"));
    scene::read(scene.to_string()).unwrap_or_else(|f| panic!("{kind}: {f}\n{scene}")).value
}

/// The cam of [`geared`] driven directly, with the train's angular velocity and acceleration.
fn direct(kind: &str, ratio: f64, angle: f64) -> Scene {
    let mut scene: Json = serde_json::from_str(&text(kind, &format!("{angle:?} deg"))).unwrap();
    scene["driver"]["omega"] = json!(format!("{:?} rad/s", OMEGA * ratio));
    scene["driver"]["alpha"] = json!(format!("{:?} rad/s^2", ALPHA * ratio));
    scene::read(scene.to_string()).unwrap_or_else(|f| panic!("{kind}: {f}\n{scene}")).value
}

fn answers(what: &str, scene: &Scene) -> Vec<f64> {
    let worked = work(scene, Scope::Questions).unwrap_or_else(|f| panic!("{what}: {f}")).value;
    for r in &worked.results {
        assert!(r.agreement.is_none_or(|a| a.holds()), "{what}: {r:?}");
    }
    worked.results.iter().map(|r| component(r.computed)).collect()
}

fn kinds() -> impl Iterator<Item = &'static str> {
    PROFILES.into_iter().chain(["law cycloidal", "swing 3-4-5"])
}

#[test]
fn a_cam_behind_wheels_is_the_cam_with_their_rates() {
    for kind in kinds() {
        for (name, train, ratio) in trains() {
            for angle in [-200.0, 13.7, 131.3] {
                let what = format!("{kind}, {name}, at {angle}");
                let (got, meant) = (
                    answers(&what, &geared(kind, &train, angle)),
                    answers(&what, &direct(kind, ratio, angle)),
                );
                for (got, meant) in got.iter().zip(&meant) {
                    assert!(
                        (got - meant).abs() < 1e-9 * meant.abs().max(1e-2),
                        "{what}: {got}, driven by itself {meant}"
                    );
                }
            }
        }
    }
}

#[test]
fn sweeps_take_a_cam_behind_wheels_through_all_turns() {
    let up = hodograph::geom::Vec2::from_angle(80.0_f64.to_radians());
    for kind in kinds() {
        for (name, train, ratio) in trains() {
            let what = format!("{kind}, {name}");
            let swept = geared(kind, &train, 13.7).over_a_turn();
            let mechanism = Mechanism::new(&swept).unwrap().value;
            let placed = PlacedScene::new(&swept, &mechanism).unwrap();
            assert!(
                sweep::compile(&swept, &mechanism, &placed.at, Some(0), &swept.find).is_ok(),
                "{what} is not compiled"
            );
            let stations = Stations::turned(Angle::Deg(-500.0), Angle::Deg(1500.0), 25);
            let table = sweep::run(&placed, 0, &stations, Width::Widest).unwrap();
            assert_eq!(table.rows(), 26, "{what}: {:?}", table.notes);
            for k in 0..26 {
                let at = -500.0 + 80.0 * k as f64;
                let meant = answers(&what, &direct(kind, ratio, 13.7 + ratio * (at - DRIVER)));
                let row: Vec<f64> = table.columns.iter().map(|c| c.values[k]).collect();
                let got = if row.len() == 3 {
                    [row[1], row[2]]
                } else {
                    [row[1] * up.x + row[2] * up.y, row[4] * up.x + row[5] * up.y]
                };
                for (got, meant) in got.into_iter().zip(meant) {
                    assert!(
                        (got - meant).abs() < 1e-9 * meant.abs().max(1e-2),
                        "{what} at {at}: {got}, driven by itself {meant}"
                    );
                }
            }
        }
    }
}

/// Input that gives the angle of a cam twice, or not at all.
#[test]
fn an_angle_of_a_cam_is_for_wheels() {
    let refused = |scene: &Json, code: &str, word: &str| {
        let faults = scene::read(scene.to_string()).map(|_| ()).unwrap_err();
        assert!(
            faults.list.iter().any(|d| d.code == code && d.to_string().contains(word)),
            "{faults}"
        );
    };
    let mut own: Json = serde_json::from_str(&text("law cycloidal", "20 deg")).unwrap();
    own["cams"][0]["angle"] = json!("20 deg");
    refused(&own, "cam-angle", "driver");
    let mut wheels: Json = own.clone();
    wheels["links"]["8"] = json!(["A"]);
    wheels["links"]["1"] = json!(["O", "A"]);
    wheels["points"]["A"] = json!(["-120 mm", 0]);
    wheels["driver"]["link"] = json!("8");
    wheels["gears"] =
        json!([{"links": ["8", "2"], "centres": ["A", "O"], "teeth": [20, 40], "phase": "10 deg"}]);
    refused(&wheels, "cam-angle", "phase");
    wheels["gears"][0].as_object_mut().unwrap().remove("phase");
    assert!(scene::read(wheels.to_string()).is_ok());
    wheels["cams"][0].as_object_mut().unwrap().remove("angle");
    refused(&wheels, "cam-pose", "angle");
}

/// Coordinates of two points of a cam give its angle as its driver does, in all quadrants.
#[test]
fn coordinates_tell_the_angle_of_a_cam() {
    for kind in ["law cycloidal", "swing 3-4-5", "tangent"] {
        for angle in [25.0, 115.0, 205.0, 295.0] {
            let what = format!("{kind} at {angle}");
            let told = direct(kind, 1.0, angle);
            let mut placed: Json = serde_json::from_str(&text(kind, "0 deg")).unwrap();
            placed["driver"].as_object_mut().unwrap().remove("angle");
            placed["lengths"].as_object_mut().unwrap().remove("OQ");
            if kind == "tangent" {
                placed["lengths"]["OQ"] = json!("35 mm");
            }
            placed["points"]["Q"] =
                json!([format!("35 mm*cos({angle} deg)"), format!("35 mm*sin({angle} deg)")]);
            let placed =
                scene::read(placed.to_string()).unwrap_or_else(|f| panic!("{what}: {f}")).value;
            for (got, meant) in answers(&what, &placed).into_iter().zip(answers(&what, &told)) {
                assert!(
                    (got - meant).abs() < 1e-9 * meant.abs().max(1e-2),
                    "{what}: {got} by coordinates, {meant} by the driver"
                );
            }
        }
    }
}
