//! Gears under loads: the direction of the tooth force.

use super::answer;
use super::template_reactions::asked;
use hodograph::answer::AnswerValue;
use hodograph::force::pressure_angle;
use hodograph::scene::{RollingId, Scene, driver_position, with_driver_at};
use hodograph::worked::{Scope, Worked, work};

/// Difference of two tangents: of the angle between tooth force and common tangent, and of the
/// pressure angle.
fn off_the_line_of_action(scene: &Scene, worked: &Worked, r: RollingId) -> Option<f64> {
    let pair = &scene.rolling[r.0];
    if !pair.kind.is_toothed() || pair.guide().is_some() {
        return None;
    }
    let [a, b] = pair.links;
    let names =
        [(a, b), (b, a)].map(|(a, b)| format!("F_{},{}", scene.link_name(a), scene.link_name(b)));
    let AnswerValue::Vector(force) = names.iter().find_map(|find| answer(scene, worked, find))?
    else {
        return None;
    };
    let n = worked.configuration.normal(scene, r)?;
    let along = force.dot(n.perp()).abs();
    (along > 1e-6).then(|| force.dot(n).abs() / along - pressure_angle(pair).tan())
}

#[test]
fn teeth_press_along_their_line_of_action() {
    let names = [
        "gear-linkage",
        "geared-five-bar",
        "planetary-gear",
        "hypocycloid",
        "sun-and-planet",
        "wheel-in-groove",
    ];
    let mut pressed = 0;
    let mut failures = Vec::new();
    for name in names {
        let scene = asked(name).unwrap_or_else(|| panic!("{name}"));
        for turned in [0.0, 0.7, 2.1, -1.3] {
            let Some(start) = driver_position(&scene, 0) else { continue };
            let there = with_driver_at(&scene, 0, start + turned);
            let Ok(worked) = work(&there, Scope::Questions) else { continue };
            let worked = worked.value;
            for r in (0..there.rolling.len()).map(RollingId) {
                let Some(off) = off_the_line_of_action(&there, &worked, r) else { continue };
                pressed += 1;
                if off.abs() > 1e-9 {
                    failures.push(format!(
                        "{name} at {turned}: teeth {r:?} press {off} off their line of action"
                    ));
                }
            }
        }
    }
    assert!(failures.is_empty(), "{} failures\n{}", failures.len(), failures.join("\n"));
    assert!(pressed >= 12, "{pressed} pressed");
}
