//! Motions of scenes with cams. Each pose has its own replacement of the cams, as [`work`] has that
//! of the instant.

use super::{Scope, Worked, instant, work, work_placed};
use hodograph_base::diag::Faults;
use hodograph_mechanism::mechanism::{Demand, Mechanism};
use hodograph_mechanism::position::{self, Configuration};
use hodograph_scene::cams::ReplacedScene;
use hodograph_scene::{PointId, Scene};
use hodograph_sweep::follow::course::over_a_turn;

/// The distance, as a part of the extent, up to which points of two readings of a scene coincide:
/// another assembly differs by more, rounding by less.
const SAME_PLACE: f64 = 1e-7;

/// Works the scene for its whole motion through at the instant; `None` if the given scene serves
/// for the motion.
///
/// # Errors
/// The errors of [`work`].
pub fn work_motion(scene: &Scene) -> Result<Option<(Scene, Worked)>, Faults> {
    if is_of_motion(scene) || !scene.has_momentary_cams() {
        return Ok(None);
    }
    let motion = over_a_turn(scene);
    let worked = work(&motion, Scope::Figure)?.value;
    Ok(Some((motion, worked)))
}

/// Works through the linkage in place of a mechanism with cams 高副低代, in the pose and to the scale
/// of the mechanism. `None` without cams, and with contacts that no lower pairs replace
/// ([`Scene::replaced`]).
///
/// # Errors
/// The errors of [`work`].
pub fn work_replaced(
    scene: &Scene,
    worked: &Worked,
) -> Result<Option<(ReplacedScene, Worked)>, Faults> {
    let Some(mut replaced) = scene.replaced(|p| worked.configuration.points[p.0]) else {
        return Ok(None);
    };
    worked.hold_scales(&mut replaced.scene);
    let linkage = work(&replaced.scene, Scope::Figure)?.value;
    Ok(Some((replaced, linkage)))
}

/// True if drivers of their own move the followers of cams.
fn is_of_motion(scene: &Scene) -> bool {
    scene.own_drivers() < scene.drivers.len()
}

/// Works a pose of a motion through, and returns the scene read for it. `scene` is that of the
/// motion with its drivers in the pose, `at` the places of all its points there.
///
/// A follower that the motion moves as a driver is moved by its cam again: by the arc or line that
/// replaces the contact in the pose. If there is none, near an inflection of the profile, the
/// follower remains a driver.
///
/// # Errors
/// The errors of [`work_placed`].
pub fn work_pose(
    scene: &Scene,
    of: (&Mechanism, &Demand),
    at: &Configuration,
) -> Result<(Scene, Worked), Faults> {
    if let Some(read) = read_again(scene, at) {
        return Ok(read);
    }
    Ok((scene.clone(), work_placed(scene, of.0.clone(), of.1.clone(), at.clone())?.value))
}

/// The scene as its file reads in the pose, if its assembly is that of the motion.
///
/// Points of the cam alone are not compared: the centre of curvature is one of them, and differs in
/// each pose.
fn read_again(scene: &Scene, at: &Configuration) -> Option<(Scene, Worked)> {
    if !is_of_motion(scene) {
        return None;
    }
    let mut there =
        instant(scene.read_again(&|name| at.named(scene, name).map(|p| [p.x, p.y])).ok()?).value;
    there.paper = scene.paper.clone();
    let mechanism = Mechanism::new(&there).ok()?.value;
    let demand = Demand::of(&there, &mechanism).with_all_positions();
    let placed = position::configure(&there, &mechanism, &demand).ok()?.value;
    let near = SAME_PLACE * at.extent();
    let of_cam = |p: PointId| {
        there.cams.iter().any(|c| {
            there
                .links
                .iter()
                .enumerate()
                .all(|(l, link)| c.cam.0 == l || !link.points.contains(&p))
        })
    };
    let is_same = |p: PointId| {
        let [one, other] = [at.named(scene, there.point_name(p)), placed.points[p.0]];
        one.zip(other).is_none_or(|(a, b)| a.distance(b) <= near)
    };
    if !(0..there.points.len()).map(PointId).all(|p| of_cam(p) || is_same(p)) {
        return None;
    }
    let worked = work_placed(&there, mechanism, demand, placed).ok()?.value;
    Some((there, worked))
}
