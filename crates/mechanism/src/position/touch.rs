//! The contact of a cam and its follower, from the pair that represents the contact; for a law from
//! the geometry of the cam.

use super::{Configuration, Path};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_scene::{Cam, GuideId, Scene};

/// The contact of two contours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContourContact<N = f64> {
    /// The point of contact.
    pub at: Point<N>,
    /// Unit normal, out of the cam.
    pub normal: Vec2<N>,
}

impl<N: Real> Configuration<N> {
    /// Returns the contact of a cam and its follower in this pose; `None` if they are not placed.
    pub fn touch(&self, scene: &Scene, cam: &Cam) -> Option<ContourContact<N>> {
        touch(scene, cam, &self.points, &self.guides)
    }
}

/// Returns the contact from the placed parts.
pub(super) fn touch<N: Real>(
    scene: &Scene,
    cam: &Cam,
    points: &[Option<Point<N>>],
    guides: &[Option<Path<N>>],
) -> Option<ContourContact<N>> {
    match cam.contact {
        Some(guide) => by_pair(scene, cam, guide, points, guides),
        None => {
            let on_course = cam
                .touched_on_course(scene, &|p| points[p.0])
                .map(|(at, normal)| ContourContact { at, normal });
            on_course.or_else(|| by_station(scene, cam, points))
        }
    }
}

fn by_pair<N: Real>(
    scene: &Scene,
    cam: &Cam,
    guide: GuideId,
    points: &[Option<Point<N>>],
    guides: &[Option<Path<N>>],
) -> Option<ContourContact<N>> {
    let pin = points[scene.guides[guide.0].pin?.0]?;
    let end = || cam.end_in::<N>(scene);
    match (guides[guide.0]?, cam.follows.radius()) {
        // The centre of the round end moves about that of the arc: outside it, or in a hollow
        // between it and the arc.
        (Path::Arc { centre, .. }, Some(round)) => {
            let away = (pin - centre).unit()?;
            let normal = if cam.touched_radius()? + round < 0.0 { -away } else { away };
            Some(ContourContact { at: pin - normal * end()?, normal })
        }
        // Lines of a profile run counter-clockwise round the cam, which is on their left.
        (Path::Line { direction, .. }, Some(_)) => {
            let normal = -direction.perp();
            Some(ContourContact { at: pin - normal * end()?, normal })
        }
        // The centre of the arc moves parallel to the face; the cam is behind the face.
        (Path::Line { direction, .. }, None) => {
            let normal = if cam.left { -direction.perp() } else { direction.perp() };
            Some(ContourContact { at: pin + normal * cam.touched_radius_in(scene)?, normal })
        }
        (Path::Arc { .. }, None) => None,
    }
}

fn by_station<N: Real>(
    scene: &Scene,
    cam: &Cam,
    points: &[Option<Point<N>>],
) -> Option<ContourContact<N>> {
    let turning = cam.disc.as_ref()?;
    let [contact, normal] = turning.contact_in::<N>(scene)?;
    let axis = match turning.axis(scene) {
        Some([a, b]) => Some((points[b.0]? - points[a.0]?).unit()?),
        None => None,
    };
    let in_plane = |v: Vec2<N>| axis.map_or(v, |axis| v.rotate_by(axis));
    let normal = in_plane(normal);
    let at = match cam.follows.radius() {
        Some(_) => points[cam.follows.point().0]? - normal * cam.end_in(scene)?,
        None => points[turning.pivot.0]? + in_plane(contact),
    };
    Some(ContourContact { at, normal })
}
