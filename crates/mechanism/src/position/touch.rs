//! Where a cam and its follower touch, from the pair that stands for the contact; of a law from the geometry of the cam.
//!
//! Radii are in double precision: no more digits of the place are certain than they have.

use super::{Configuration, Path};
use crate::geom::{Point, Vec2};
use crate::number::Real;
use crate::scene::{Cam, GuideId, Scene};

/// What double precision keeps of a length that is computed from given ones, relative to it.
const LOST: f64 = 1e-12;

/// Where two contours touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch<N = f64> {
    /// The place.
    pub at: Point<N>,
    /// Unit normal, out of the cam.
    pub normal: Vec2<N>,
}

impl<N: Real> Configuration<N> {
    /// Where a cam and its follower touch in this pose; `None` where they are not placed.
    pub fn touch(&self, scene: &Scene, cam: &Cam) -> Option<Touch<N>> {
        touch(scene, cam, &self.points, &self.guides)
    }
}

/// The contact by what is placed.
pub(super) fn touch<N: Real>(scene: &Scene, cam: &Cam, points: &[Option<Point<N>>], guides: &[Option<Path<N>>]) -> Option<Touch<N>> {
    match cam.contact {
        Some(guide) => by_pair(scene, cam, guide, points, guides),
        None => {
            let on_course = cam.touched_on_course(&|p| points[p.0]).map(|(at, normal)| Touch { at, normal });
            on_course.or_else(|| by_station(scene, cam, points))
        }
    }
}

fn by_pair<N: Real>(scene: &Scene, cam: &Cam, guide: GuideId, points: &[Option<Point<N>>], guides: &[Option<Path<N>>]) -> Option<Touch<N>> {
    let pin = points[scene.guides[guide.0].pin?.0]?;
    match (guides[guide.0]?, cam.follows.radius()) {
        // The end's centre runs about that of the arc: outside it, in a hollow between it and the arc.
        (Path::Arc { centre, .. }, Some(end)) => {
            let away = (pin - centre).unit()?;
            let normal = if cam.touched_radius()? + end < 0.0 { -away } else { away };
            Some(Touch { at: pin - normal * number(end)?, normal })
        }
        // Lines of a profile run counter-clockwise round the cam, which lies to their left.
        (Path::Line { direction, .. }, Some(end)) => {
            let normal = -direction.perp();
            Some(Touch { at: pin - normal * number(end)?, normal })
        }
        // The arc's centre runs beside the face, behind which the cam lies.
        (Path::Line { direction, .. }, None) => {
            let normal = if cam.left { -direction.perp() } else { direction.perp() };
            Some(Touch { at: pin + normal * number(cam.touched_radius()?)?, normal })
        }
        (Path::Arc { .. }, None) => None,
    }
}

fn by_station<N: Real>(scene: &Scene, cam: &Cam, points: &[Option<Point<N>>]) -> Option<Touch<N>> {
    let turning = cam.disc.as_ref()?;
    let station = turning.disc.station(turning.phi, turning.side)?;
    let in_plane = |v: Vec2| -> Option<Vec2<N>> {
        let v = v.rotate_by(Vec2::from_angle(turning.disc.sense * turning.phi));
        let v = Vec2 { x: number(v.x)?, y: number(v.y)? };
        Some(match turning.axis(scene) {
            Some([a, b]) => v.rotate_by((points[b.0]? - points[a.0]?).unit()?),
            None => v,
        })
    };
    let normal = in_plane(station.normal)?;
    let at = match cam.follows.radius() {
        Some(0.0) => points[cam.follows.point().0]?,
        Some(end) => points[cam.follows.point().0]? - normal * number(end)?,
        None => points[turning.pivot.0]? + in_plane(station.contact)?,
    };
    Some(Touch { at, normal })
}

fn number<N: Real>(x: f64) -> Option<N> {
    N::from_bounded(x, x.abs() * LOST)
}
