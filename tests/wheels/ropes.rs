//! Ropes from a drum: the wound length compared with the radius, on ground and on an arm, with drum
//! or load driven; and messages on impossible ropes.

use super::belts::{near, read, scalar, solved, vector};
use hodograph::geom::Vec2;
use hodograph::mechanism::Mechanism;
use hodograph::scene::build::{Builder, Driver, Guide, Rope, deg, mm, rad_per_s, rad_per_s2};
use hodograph::scene::{self, Angle, templates};
use hodograph::sweep::{self, PlacedScene, Stations, Width};

#[test]
fn a_load_rises_by_the_angle_times_the_radius() {
    let text = templates::get("hoist").unwrap();
    let scene = read(&scene::edit::with_find(text, &["y_A", "y_B"]).unwrap());
    let m = Mechanism::new(&scene).unwrap().value;
    let placed = PlacedScene::new(&scene, &m).unwrap();
    let table = sweep::run(
        &placed,
        0,
        &Stations::turned(Angle::Deg(0.0), Angle::Deg(900.0), 25),
        Width::Widest,
    )
    .unwrap();
    let column = |k: usize| &table.columns[k].values;
    for i in 0..table.rows() {
        let turned = column(0)[i] - column(0)[0];
        near(column(1)[i] - column(1)[0], -0.3 * turned, "y_A");
        near(column(2)[i] - column(2)[0], 0.15 * turned, "y_B");
    }
}

/// The load drives the drum: ω = v/r, and the point of the drum also has ω²r toward the axis.
#[test]
fn a_falling_load_turns_the_drum() {
    let text = templates::get("hoist").unwrap();
    let driver = r#""driver": {"link": "2", "omega": "omega_2", "alpha": "alpha_2"}"#;
    let fall = r#""driver": {"slide": "A", "velocity": "-0.9 m/s", "acceleration": "-0.6 m/s^2"}"#;
    let scene = read(
        &scene::edit::with_find(
            &text.replace(driver, fall),
            &["omega_2", "alpha_2", "v_B", "a_M2"],
        )
        .unwrap(),
    );
    let worked = solved(&scene);
    near(scalar(&scene, &worked, "omega_2"), 3.0, "omega_2");
    near(scalar(&scene, &worked, "alpha_2"), 2.0, "alpha_2");
    near((vector(&scene, &worked, "v_B") - Vec2::new(0.0, 0.45)).norm(), 0.0, "v_B");
    near((vector(&scene, &worked, "a_M2") - Vec2::new(2.7, -0.6)).norm(), 0.0, "a_M2");
}

/// A crane's jib 2 turns with drum 3 at its end; the load 4 moves along the jib: relative to the
/// jib at r (ω₃ − ω₂).
#[test]
fn on_an_arm_the_rope_winds_the_turning_against_the_arm() {
    let scene = read(
        r#"{"units": {"length": "mm"}, "links": {"1": ["O"], "2": ["O", "P"], "3": ["P"], "4": ["W"]}, "ground": "1",
        "points": {"O": [0, 0], "P": [400, 300], "W": [240, 180]},
        "guides": [{"slider": "4", "pin": "W", "on": "2", "line": "OP"}],
        "ropes": [{"drum": "3", "centre": "P", "radius": 50, "load": "4", "angle": "3.7850937623830774 rad", "at": "M"}],
        "driver": [{"link": "2", "omega": "2 rad/s", "alpha": "1 rad/s^2"}, {"link": "3", "omega": "-3 rad/s", "alpha": "4 rad/s^2"}],
        "find": ["vr_W4W2", "ar_W4W2", "v_W", "a_W", "v_M3", "a_M3"]}"#,
    );
    let worked = solved(&scene);
    let along = Vec2::new(0.8, 0.6);
    near(vector(&scene, &worked, "vr_W4W2").dot(along).abs(), 0.05 * 5.0, "vr");
    near(vector(&scene, &worked, "ar_W4W2").dot(along).abs(), 0.05 * 3.0, "ar");
}

#[test]
fn the_builder_writes_what_a_person_would() {
    let guide = Guide::slider("3", "A").on("1").angle(deg(90.0));
    let scene = Builder::new()
        .link("1", ["O"])
        .link("2", ["O"])
        .link("3", ["A"])
        .ground("1")
        .point("O", mm(0.0), mm(0.0))
        .point("A", mm(-200.0), mm(-500.0))
        .guide(guide)
        .rope(Rope::wound("2", "O", mm(200.0), "3", deg(-90.0)).at("M"))
        .driver(Driver::turning("2").omega(rad_per_s(2.0)).alpha(rad_per_s2(1.0)))
        .find(["v_A", "a_M2"]);
    let scene = scene.build().unwrap_or_else(|f| panic!("{f}")).value;
    let worked = solved(&scene);
    near((vector(&scene, &worked, "v_A") - Vec2::new(0.0, -0.4)).norm(), 0.0, "v_A");
}

#[test]
fn ropes_that_cannot_be_are_named() {
    let text = templates::get("hoist").unwrap();
    let fourth = r#""load": "4", "angle": "90 deg""#;
    for (from, to, code) in [
        (fourth, r#""load": "4", "angle": "60 deg""#, "rope-direction"),
        (fourth, r#""load": "4""#, "no-direction"),
        (fourth, r#""load": "2", "angle": "90 deg""#, "rolling"),
        (fourth, r#""load": "4", "angle": "90 deg", "phase": "0 deg""#, "unknown-key"),
        (
            r#"{"slider": "4", "pin": "B", "on": "1", "angle": "90 deg"}"#,
            r#"{"pin": "B", "on": "1", "angle": "90 deg"}"#,
            "rope-load",
        ),
    ] {
        assert!(text.contains(from), "{from}");
        let faults = match scene::read(text.replace(from, to)) {
            Err(faults) => faults,
            Ok(scene) => {
                hodograph::worked::work(&scene.value, hodograph::worked::Scope::Figure).unwrap_err()
            }
        };
        assert!(faults.list.iter().any(|d| d.code == code), "{code}: {faults}");
    }
}
