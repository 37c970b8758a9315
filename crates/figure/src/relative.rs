//! The path of a point as it is seen from a moving link (相对运动轨迹).
//!
//! The places of the point in the frame of the link are drawn on the link in the pose of the scene.

use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_base::geom::Point;
use hodograph_scene::{Driver, LinkId, PointId, Scene, Swept};
use hodograph_sweep::follow::{PoseFollower, TravelPose};
use hodograph_sweep::points::{PathMotion, PointMoment, alone, at_equal_steps, seen_from};
use hodograph_sweep::station;
use hodograph_worked::worked::{Scope, Worked, work, work_motion};
use std::f64::consts::TAU;

use super::path::PathContent;

/// Poses of a turn through which a relative path is followed.
const STEPS: usize = 360;
/// A relative path shorter than this part of the mechanism's size is none.
const STILL: f64 = 1e-6;

/// Refuses points of the link itself.
///
/// # Errors
/// `no-path`.
pub(super) fn check(scene: &Scene, wanted: &PathContent, link: LinkId) -> Result<(), Faults> {
    let mut faults = Faults::default();
    for p in wanted.points.iter().filter(|p| scene.links[link.0].points.contains(p)) {
        let (point, name) = (scene.point_name(*p), scene.link_name(link));
        let d = Diagnostic::error(
            "no-path",
            both!("point {point} belongs to link {name}: it does not move on it"),
        );
        faults.push(d.help(both!("name a point of another link")));
    }
    if faults.has_errors() { Err(faults) } else { Ok(()) }
}

/// Returns the poses of a motion, through time for at least a turn of the slowest turning driver,
/// without velocities.
pub(super) fn travelled(
    scene: &Scene,
    worked: &Worked,
    wanted: &PathContent,
    marks: usize,
) -> PathMotion {
    let Worked { mechanism, demand, configuration, .. } = worked;
    let follower = PoseFollower::new(scene, mechanism, demand, configuration, wanted.swept);
    let sweep = follower.through(turned_reach(scene, &follower, wanted.swept), STEPS);
    let now = station::now(scene, configuration, wanted.swept);
    let moment = |pose: &TravelPose| PointMoment {
        travel: pose.travel,
        place: now + pose.travel,
        configuration: pose.configuration.clone(),
        vectors: vec![[None; 2]; wanted.points.len()],
    };
    let last = sweep.poses.len().saturating_sub(1);
    PathMotion {
        points: wanted.points.clone(),
        moments: sweep.poses.iter().map(moment).collect(),
        marks: at_equal_steps(&follower, &sweep, marks).iter().map(moment).collect(),
        full: sweep.full,
        limits: [0, last].map(|k| sweep.is_limit(k)),
    }
}

/// Returns the reach of a motion; through time the end is put off until the slowest turning driver
/// has made a turn since the beginning.
fn turned_reach(scene: &Scene, follower: &PoseFollower, swept: Swept) -> [f64; 2] {
    let [before, after] = follower.reach();
    let turn = |d: &Driver| TAU / d.rate.value.abs();
    let turning = scene.drivers.iter().filter(|d| d.kind.turns() && d.rate.value != 0.0);
    let slowest = turning.map(turn).fold(0.0, f64::max);
    match swept {
        Swept::Time => [before, after.max(slowest - before)],
        Swept::Driver(_) => [before, after],
    }
}

/// Returns a point's path as it is seen from a link, on the link in the pose of the scene; `None` if
/// it has none, or does not move on the link.
pub(super) fn track_on(scene: &Scene, point: &str, link: &str) -> Option<Vec<Point>> {
    let worked = work(scene, Scope::Figure).ok()?.value;
    let motion_of_cams = work_motion(scene).ok()?;
    let (scene, worked) =
        motion_of_cams.as_ref().map_or((scene, &worked), |(scene, worked)| (scene, worked));
    let point = PointId(scene.points.iter().position(|p| p.name == point)?);
    let link = scene.links_in_order().into_iter().find(|l| scene.link_name(*l) == link)?;
    let swept = Swept::usual(scene);
    let wanted = PathContent { points: vec![point], swept, marks: 1, poses: 0 };
    let moved = travelled(&alone(scene, swept), worked, &wanted, 1);
    let base = &worked.configuration;
    let places: Vec<Point> = moved
        .moments
        .iter()
        .filter_map(|m| seen_from(&m.configuration, base, point, link))
        .collect();
    let first = places.first()?;
    let far = places.iter().map(|p| p.distance(*first)).fold(0.0, f64::max);
    (far > STILL * base.extent()).then_some(places)
}

#[cfg(test)]
mod tests {
    use super::*;
    use hodograph_base::geom::Vec2;
    use hodograph_mechanism::mechanism::Mechanism;
    use hodograph_scene::{read, read_asking, templates};
    use hodograph_sweep::{PlacedScene, of_values};

    /// x′² + (y′ + b/2)² = b²/4 in the frame of the work, swept through a turn of it.
    #[test]
    fn a_tool_that_swings_with_the_work_cuts_a_circle() {
        let scene = read(templates::get("lathe").unwrap()).unwrap().value;
        let track = track_on(&scene, "T", "2").unwrap();
        // The work stands at 30 degrees in the pose.
        let (b, back) = (0.07, Vec2::from_angle(-std::f64::consts::PI / 6.0));
        let mut turned = 0.0;
        let centre = Vec2::new(0.0, -b / 2.0);
        let arms: Vec<Vec2> = track.iter().map(|p| p.to_vec2().rotate_by(back) - centre).collect();
        for pair in arms.windows(2) {
            assert!((pair[0].norm() - b / 2.0).abs() < 1e-12, "{:?}", pair[0]);
            turned += pair[0].cross(pair[1]).atan2(pair[0].dot(pair[1]));
        }
        // In a turn of the work the tool runs twice round the circle.
        assert!((turned.abs() - 2.0 * TAU).abs() < 1e-9, "{turned}");
    }

    /// The places of a coupler point in a table of positions, turned back by the crank's angle.
    #[test]
    fn a_relative_path_is_the_table_of_positions_turned_back() {
        let scene = read_asking(templates::get("crank-rocker").unwrap(), "x_E,y_E").unwrap().value;
        let mechanism = Mechanism::new(&scene).unwrap().value;
        let placed = PlacedScene::new(&scene, &mechanism).unwrap();
        let track = track_on(&scene, "E", "1").unwrap();
        let now = std::f64::consts::PI / 3.0;
        let rows: Vec<f64> = (0..track.len()).map(|k| now + TAU * k as f64 / 360.0).collect();
        let table = of_values(&placed, 0, rows.clone()).unwrap();
        let [x, y] = ["x_E", "y_E"].map(|name| &table.column(name).unwrap().values);
        assert_eq!(track.len(), 360);
        for (k, place) in track.iter().enumerate() {
            // A is the origin.
            let seen = Vec2::new(x[k], y[k]).rotate_by(Vec2::from_angle(now - rows[k]));
            assert!(place.distance(seen.to_point()) < 1e-12, "{k}: {place:?} {seen:?}");
        }
    }
}
