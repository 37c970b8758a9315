//! The contact of cams with their followers: on both faces of a yoke, with every end of a follower,
//! compared with the motion of the mechanism there.

use crate::{PROFILES, scene as of_kind};
use hodograph::composite::{ChoicePlace, ContactScene};
use hodograph::geom::Vec2;
use hodograph::mechanism::Level;
use hodograph::scene::quantity::composite::CompositePart;
use hodograph::scene::{self, Scene};
use hodograph::worked::{Scope, Worked, work};

/// An eccentric between two faces of a yoke: the cam is to the left of the lower one and to the
/// right of the other, or in the order given by `turned`.
fn yoke(angle: f64, turned: bool) -> Scene {
    let (lower, upper) = if turned { ("180 deg", "180 deg") } else { ("0 deg", "0 deg") };
    let [below, above] = if turned { ["right", "left"] } else { ["left", "right"] };
    let text = format!(
        r#"{{"links": {{"1": ["O"], "2": ["O", "B"], "3": ["C"]}}, "ground": "1", "points": {{"O": [0, 0]}}, "lengths": {{"OB": "20 mm"}},
        "guides": [{{"slider": "3", "pin": "C", "on": "1", "through": [0, 0], "angle": "90 deg"}}],
        "cams": [{{"cam": "2", "follower": "3", "face": {{"through": "C", "angle": "{lower}", "cam": "{below}"}}, "profile": {{"centre": "B", "radius": "30 mm"}}, "at": "E"}},
          {{"cam": "2", "follower": "3", "face": {{"through": "C", "angle": "{upper}", "offset": "{off}60 mm", "cam": "{above}"}}, "profile": {{"centre": "B", "radius": "30 mm"}}, "at": "F"}}],
        "driver": {{"link": "2", "angle": "{angle} deg", "omega": "5 rad/s", "alpha": "3 rad/s^2"}}, "find": ["v_C", "a_C"]}}"#,
        off = if turned { "-" } else { "" }
    );
    scene::read(&text).unwrap_or_else(|f| panic!("{f}\n{text}")).value
}

fn worked(scene: &Scene) -> Worked {
    work(scene, Scope::Figure).unwrap_or_else(|f| panic!("{f}")).value
}

/// Both bodies have the same velocity along the normal, and the normal points from the cam to the
/// follower.
fn check(what: &str, scene: &Scene, index: usize, outward: Vec2) {
    let w = worked(scene);
    let cam = &scene.cams[index];
    let touch = w.configuration.touch(scene, cam).unwrap_or_else(|| panic!("{what}"));
    assert!(
        (touch.normal.norm() - 1.0).abs() < 1e-12 && touch.normal.dot(outward) > 0.0,
        "{what}: {touch:?}"
    );
    let [own, other] =
        [cam.cam, cam.follower].map(|l| w.solution.of_link(Level::Velocity, l, touch.at).unwrap());
    assert!(
        (own - other).dot(touch.normal).abs() < 1e-9 * own.norm().max(1e-3),
        "{what}: {own:?} {other:?}"
    );
    if let Some((centre, radius)) = cam.circle {
        let centre = w.configuration.points[centre.0].unwrap();
        assert!((touch.at - centre - touch.normal * radius).norm() < 1e-12, "{what}: {touch:?}");
    }
}

#[test]
fn both_faces_of_a_yoke_touch_where_they_are() {
    for angle in [10.0, 100.0, 200.0, 290.0] {
        for turned in [false, true] {
            let scene = yoke(angle, turned);
            check(&format!("lower face at {angle}, {turned}"), &scene, 0, Vec2::new(0.0, -1.0));
            check(&format!("upper face at {angle}, {turned}"), &scene, 1, Vec2::new(0.0, 1.0));
            // A point of the yoke seen from the cam has the curvature given by the contours, on
            // either face.
            let staged = ContactScene::new(&scene);
            assert_eq!(staged.contacts.len(), 2);
            let choices: Vec<_> = staged
                .choices(&scene)
                .into_iter()
                .filter(|c| matches!(c.place, ChoicePlace::Cam(_)))
                .collect();
            let (_, solved) = staged.solved(&choices, Level::Acceleration).unwrap().value;
            for s in &solved {
                let slip = s.slip.expect("it is a contact");
                let bent = s
                    .acceleration
                    .iter()
                    .find(|(p, _)| *p == Some(CompositePart::RelativeNormal))
                    .unwrap()
                    .1
                    .dot(slip.normal);
                assert!(
                    (bent - slip.acceleration()).abs() < 1e-9,
                    "{angle}, {turned}, {:?}: {bent} {slip:?}",
                    s.choice
                );
            }
            assert_eq!(solved.len(), 6);
        }
    }
}

#[test]
fn every_end_touches_square_to_the_contour() {
    for kind in PROFILES {
        for k in 0..12 {
            let angle = 30.0 * k as f64 + 3.7;
            let scene = of_kind(kind, &format!("{angle} deg"));
            let w = worked(&scene);
            let cam = &scene.cams[0];
            let t = cam.disc.as_ref().unwrap();
            // The geometry of the cam, in the plane.
            let station = t.disc.station(t.phi, t.side).unwrap();
            let outward = station.normal.rotate_by(Vec2::from_angle(t.disc.sense * t.phi));
            let touch = w.configuration.touch(&scene, cam).unwrap();
            assert!(
                (touch.normal - outward).norm() < 1e-9,
                "{kind} at {angle}: {touch:?} {outward:?}"
            );
            let pivot = w.configuration.points[t.pivot.0].unwrap();
            let meant = pivot + station.contact.rotate_by(Vec2::from_angle(t.disc.sense * t.phi));
            assert!((touch.at - meant).norm() < 1e-9, "{kind} at {angle}: {touch:?} {meant:?}");
        }
    }
}
