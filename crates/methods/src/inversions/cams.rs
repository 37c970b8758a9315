//! Cams of an inversion: a profile of one circle touches its follower for every ground, so it is
//! written unchanged. With a profile of several pieces or a law, the contact follows from the
//! driver's angle: such cams are refused.

use super::pairs::metres;
use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_mechanism::position::{Configuration, Path};
use hodograph_scene::cams::{Cam, Follows};
use hodograph_scene::{Guide, PointId, Scene};
use serde_json::{Value as Json, json};

/// Adds a fault for every cam that cannot be inverted.
pub(super) fn refused(scene: &Scene, faults: &mut Faults) {
    for c in scene.cams.iter().filter(|c| c.circle.is_none()) {
        let [cam, follower] = [c.cam, c.follower].map(|l| scene.link_name(l));
        let message = both!(
            "cam {cam} drives follower {follower} by a profile whose touched piece follows from the angle that a driver gives the cam"
        );
        let help = both!(
            "replace it by the lower pair at the instant, a circle about the centre of curvature: \"profile\": {{\"centre\", \"radius\"}}"
        );
        faults.push(Diagnostic::error("inversion-pairs", message).at(c.span).help(help));
    }
}

/// True if a guide represents the contact of a cam.
pub(super) fn is_contact(scene: &Scene, guide: &Guide) -> bool {
    scene.cams.iter().any(|c| c.contact.is_some_and(|g| std::ptr::eq(&scene.guides[g.0], guide)))
}

/// True if a point is a point of contact, on no link.
pub(super) fn is_touch(scene: &Scene, p: PointId) -> bool {
    scene.cams.iter().any(|c| c.touch == Some(p))
}

/// Returns the section `cams`.
pub(super) fn section(scene: &Scene, at: &Configuration) -> Vec<Json> {
    scene.cams.iter().filter_map(|c| entry(scene, at, c)).collect()
}

fn entry(scene: &Scene, at: &Configuration, c: &Cam) -> Option<Json> {
    let (centre, radius) = c.circle?;
    let name = |p: PointId| scene.point_name(p);
    let mut out = json!({
        "cam": scene.link_name(c.cam), "follower": scene.link_name(c.follower), "profile": {"centre": name(centre), "radius": metres(radius)},
    });
    match c.follows {
        Follows::Edge(p) => out["edge"] = json!(name(p)),
        Follows::Roller(p, r) => out["roller"] = json!({"pin": name(p), "radius": metres(r)}),
        Follows::Arc(p, r) => out["arc"] = json!({"pin": name(p), "radius": metres(r)}),
        Follows::Face(p) => out["face"] = face(scene, at, c, p, radius)?,
    }
    if let Some(at) = &c.at {
        out["at"] = json!(at);
    }
    Some(out)
}

/// Returns a face by its direction in the pose and its distance from its point: the centre of the
/// profile runs on a parallel to it.
fn face(scene: &Scene, at: &Configuration, c: &Cam, p: PointId, radius: f64) -> Option<Json> {
    let Some(Path::Line { through, direction }) = at.guides[c.contact?.0] else { return None };
    let own = at.points[p.0]?;
    let side = if c.left { 1.0 } else { -1.0 };
    let offset = direction.cross(through - own) - side * radius;
    let mut out = json!({"through": scene.point_name(p), "angle": format!("{:?} rad", direction.angle()), "cam": if c.left { "left" } else { "right" }});
    if offset.abs() > 1e-12 * radius {
        out["offset"] = json!(metres(offset));
    }
    Some(out)
}
