//! Where a cam and its follower touch, from the pair that stands for the contact; of a law from the geometry of the cam.
//!
//! Radii are kept in double precision, so that no more digits of the place are vouched for than those.

use super::Path;
use crate::geom::{Point, Vec2};
use crate::number::Real;
use crate::scene::{Cam, GuideId, PointId, Scene};

/// What double precision keeps of a length that is computed from given ones, relative to it.
const LOST: f64 = 1e-12;

/// The place of contact.
pub(super) fn place<N: Real>(scene: &Scene, cam: &Cam, points: &[Option<Point<N>>], guides: &[Option<Path<N>>]) -> Option<Point<N>> {
    match cam.contact {
        Some(guide) => by_pair(scene, cam, guide, points, guides),
        None => by_station(scene, cam, points),
    }
}

fn by_pair<N: Real>(scene: &Scene, cam: &Cam, guide: GuideId, points: &[Option<Point<N>>], guides: &[Option<Path<N>>]) -> Option<Point<N>> {
    let pin = points[scene.guides[guide.0].pin?.0]?;
    match (guides[guide.0]?, cam.follows.radius()) {
        // The end's centre runs about that of the arc: outside it, in a hollow between it and the arc.
        (Path::Arc { centre, .. }, Some(end)) => {
            let hollow = cam.touched_radius()? < 0.0;
            Some(pin + (pin - centre).unit()? * number(if hollow { end } else { -end })?)
        }
        // Lines of a profile run counter-clockwise round the cam, which lies to their left.
        (Path::Line { direction, .. }, Some(end)) => Some(pin + direction.perp() * number(end)?),
        // The arc's centre runs beside the face.
        (Path::Line { direction, .. }, None) => {
            let radius = cam.touched_radius()?;
            Some(pin + direction.perp() * number(if cam.left { -radius } else { radius })?)
        }
        (Path::Arc { .. }, None) => None,
    }
}

fn by_station<N: Real>(scene: &Scene, cam: &Cam, points: &[Option<Point<N>>]) -> Option<Point<N>> {
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
    let at = |p: PointId| points[p.0];
    match cam.follows.radius() {
        Some(0.0) => at(cam.follows.point()),
        Some(end) => Some(at(cam.follows.point())? + in_plane(station.normal * -end)?),
        None => Some(at(turning.pivot)? + in_plane(station.contact)?),
    }
}

fn number<N: Real>(x: f64) -> Option<N> {
    N::from_bounded(x, x.abs() * LOST)
}
