//! The point of contact of a cam and its follower as a point of one of them, at the instant.
//!
//! In the next instant another point is in contact, so that the scene has no such point. In a
//! solved pose it can be added, with a known place in the link, and its motion can be asked for as
//! that of any other point.

use crate::worked::{Worked, work_placed};
use hodograph_base::geom::Point;
use hodograph_mechanism::mechanism::{Demand, Mechanism};
use hodograph_mechanism::position::Configuration;
use hodograph_scene::{LinkId, PointId, PointPlace, Scene};

/// Returns the name of the point of contact: that of the scene, or E, or the next free letter.
pub fn name(scene: &Scene, cam: usize) -> String {
    // The point that represents the contact in questions may keep its name.
    let own = |i: usize| scene.cams[cam].touch == Some(PointId(i));
    let taken = |n: &str| scene.points.iter().enumerate().any(|(i, p)| p.name == n && !own(i));
    let own = scene.cams[cam].at.clone().filter(|n| !taken(n));
    let free =
        || ["E", "K", "T", "U", "W"].into_iter().find(|n| !taken(n)).unwrap_or("E_").to_owned();
    own.unwrap_or_else(free)
}

/// Returns the scene with the point of contact of a cam as a point of one of its links, its pose,
/// and the number of that point. Questions that name the contact refer to it.
pub fn with_contact(
    scene: &Scene,
    at: &Configuration,
    index: usize,
    owner: LinkId,
    place: Point,
) -> Option<(Scene, Configuration, PointId)> {
    let (mut scene, mut at) = (scene.clone(), at.clone());
    let pose = at.poses[owner.0]?;
    let (name, span) = (name(&scene, index), scene.cams[index].span);
    let own = scene.cams[index].touch.take().unwrap_or_else(|| {
        scene.points.push(hodograph_scene::NamedPoint {
            name,
            place: PointPlace::Unknown,
            sketch: None,
            span,
        });
        at.points.push(None);
        PointId(scene.points.len() - 1)
    });
    scene.links[owner.0].points.push(own);
    at.points[own.0] = Some(place);
    at.shapes.points[owner.0].push((own, pose.to_local(place)));
    Some((scene, at, own))
}

/// Works a scene through in a known pose.
pub fn work_at(scene: &Scene, at: Configuration) -> Option<Worked> {
    let mechanism = Mechanism::new(scene).ok()?.value;
    let demand = Demand::of(scene, &mechanism).with_all_positions();
    work_placed(scene, mechanism, demand, at).ok().map(|w| w.value)
}
