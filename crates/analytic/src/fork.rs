//! Selection between the two motions through a change point.
//!
//! 1. The scene decides: a `side` that the pose just after the change point determines (at the pose
//!    itself the points are in line), then the sketch.
//! 2. Otherwise the assembly keeps its kind. A motion with joints at rest (two links fold onto
//!    each other and turn as one) is taken last. Of the other motions, that one is taken in which
//!    the angular velocities of the links, ground included, differ least from their mean. A
//!    parallelogram stays a parallelogram: with crank rate 1 and the coupler rate u of the other
//!    motion, its rates 0, 1, 0, 1 have squares about the mean of 1, those of the
//!    antiparallelogram (0, 1, u, u − 1) have 1 + (u − 1)²; if u = 1 (a folded rhombus), the
//!    criterion of joints at rest decides.
//! 3. If the motions differ by the sense of time only (a driver that turns back at its limit): the
//!    motion in which the first link that turns does so counter-clockwise.

use super::Solution;
use hodograph_base::geom::Vec2;
use hodograph_mechanism::answer::MotionSource;
use hodograph_mechanism::mechanism::Level;
use hodograph_mechanism::position::Configuration;
use hodograph_scene::{LinkId, PointId, Scene};

/// The criterion that decides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Decided {
    /// A `side` of the scene.
    Side,
    /// The sketch.
    Sketch,
    /// The assembly keeps its kind.
    Kind,
    /// The sense of rotation.
    Sense,
}

/// Relative difference below which velocities count as equal: rates at a pose given by lengths are
/// accurate to the square root of its rounding.
const SAME: f64 = 1e-6;

/// Returns the index of the selected motion, of two solutions of the same velocities, and the
/// criterion; `of` are the links of the singular block.
pub(super) fn choose(
    scene: &Scene,
    at: &Configuration,
    ways: &[Solution; 2],
    of: &[LinkId],
    turning: bool,
) -> (usize, Decided) {
    if let Some(i) = by_side(scene, at, ways) {
        return (i, Decided::Side);
    }
    if let Some(i) = by_sketch(scene, at, ways) {
        return (i, Decided::Sketch);
    }
    if turning {
        return (usize::from(first_turning(ways, of) < 0.0), Decided::Sense);
    }
    let scores =
        ways.each_ref().map(|w| (resting_joints(scene, at, w, of), spread(scene, at, w, of)));
    let (a, b) = (&scores[0], &scores[1]);
    let second = b.0 < a.0 || (b.0 == a.0 && b.1 < a.1 * (1.0 - SAME));
    (usize::from(second), Decided::Kind)
}

fn velocity(way: &Solution, p: PointId) -> Option<Vec2> {
    way.vector(Level::Velocity, p, None)
}

/// Selects by the first side that is undecided at the pose and that only one of the motions keeps.
fn by_side(scene: &Scene, at: &Configuration, ways: &[Solution; 2]) -> Option<usize> {
    scene.sides.iter().find_map(|side| {
        let place = |p: PointId| at.points[p.0];
        let (a, b, p) = (place(side.from)?, place(side.to)?, place(side.point)?);
        let (base, arm) = (b - a, p - a);
        if base.cross(arm).abs() > SAME * base.norm() * arm.norm() {
            return None;
        }
        let keeps = ways.each_ref().map(|w| {
            let v = [side.from, side.to, side.point].map(|q| velocity(w, q));
            let [Some(va), Some(vb), Some(vp)] = v else { return false };
            let after = (vb - va).cross(arm) + base.cross(vp - va);
            let size = base.norm().max(arm.norm()) * va.norm().max(vb.norm()).max(vp.norm());
            after.abs() > SAME * size && (after > 0.0) == side.left
        });
        match keeps {
            [true, false] => Some(0),
            [false, true] => Some(1),
            _ => None,
        }
    })
}

/// Selects by the sum of (sketch − position)·v over the sketched points: the motion that leads
/// toward the sketch.
fn by_sketch(scene: &Scene, at: &Configuration, ways: &[Solution; 2]) -> Option<usize> {
    let mut sums = [0.0; 2];
    let mut size = 0.0f64;
    for (i, point) in scene.points.iter().enumerate() {
        let (Some([x, y]), Some(place)) = (point.sketch, at.points[i]) else { continue };
        let off = Vec2::new(x, y) - place.to_vec2();
        for (sum, way) in sums.iter_mut().zip(ways) {
            let v = velocity(way, PointId(i)).unwrap_or(Vec2::ZERO);
            *sum += off.dot(v);
            size = size.max(off.norm() * v.norm());
        }
    }
    let difference = sums[1] - sums[0];
    (difference.abs() > SAME * size).then(|| usize::from(difference > 0.0))
}

fn turning(way: &Solution, l: LinkId) -> f64 {
    way.turning(Level::Velocity, l).unwrap_or(0.0)
}

/// Returns ω of the first link that turns, in the first motion.
fn first_turning(ways: &[Solution; 2], of: &[LinkId]) -> f64 {
    let largest = of.iter().map(|l| turning(&ways[0], *l).abs()).fold(0.0, f64::max);
    of.iter().map(|l| turning(&ways[0], *l)).find(|w| w.abs() > SAME * largest).unwrap_or(0.0)
}

/// Returns the links joined to one of the block, including the block's own, in the order of the
/// scene.
fn joined(scene: &Scene, at: &Configuration, way: &Solution, of: &[LinkId]) -> Vec<LinkId> {
    let known = |l: LinkId| way.links[l.0].is_some();
    let near = |l: LinkId| {
        of.contains(&l)
            || scene.links[l.0]
                .points
                .iter()
                .any(|p| at.points[p.0].is_some() && scene.carriers(*p).any(|k| of.contains(&k)))
            || scene
                .guides
                .iter()
                .any(|g| g.on == l && scene_runner(scene, g).any(|k| of.contains(&k)))
    };
    (0..scene.links.len()).map(LinkId).filter(|l| known(*l) && near(*l)).collect()
}

/// Returns the links that run in a guide: its slider, and the links that carry its pin.
fn scene_runner<'a>(
    scene: &'a Scene,
    g: &'a hodograph_scene::Guide,
) -> impl Iterator<Item = LinkId> + 'a {
    g.slider.into_iter().chain(g.pin.into_iter().flat_map(|p| scene.carriers(p)))
}

/// Returns the number of joints at which a link of the block neither turns nor slides relative to
/// any other link.
fn resting_joints(scene: &Scene, at: &Configuration, way: &Solution, of: &[LinkId]) -> usize {
    let links = joined(scene, at, way, of);
    let fastest = links.iter().map(|l| turning(way, *l).abs()).fold(0.0, f64::max);
    let mut rest = 0;
    for link in of {
        for p in &scene.links[link.0].points {
            // If several links meet, one of them may turn with the same rate as another.
            let mut there =
                scene.carriers(*p).filter(|k| k != link && links.contains(k)).peekable();
            let same = |k: LinkId| (turning(way, k) - turning(way, *link)).abs() <= SAME * fastest;
            rest += usize::from(there.peek().is_some() && there.all(same));
        }
    }
    for guide in &scene.guides {
        let Some(pin) = guide
            .pin
            .filter(|_| scene_runner(scene, guide).chain([guide.on]).any(|l| of.contains(&l)))
        else {
            continue;
        };
        let (Some(v), Some(under)) =
            (velocity(way, pin), way.vector(Level::Velocity, pin, Some(guide.on)))
        else {
            continue;
        };
        if (v - under).norm() <= SAME * fastest * at.extent() {
            rest += 1;
        }
    }
    rest
}

/// Returns Σ (ω − mean)² over the links of the block and those joined to them.
fn spread(scene: &Scene, at: &Configuration, way: &Solution, of: &[LinkId]) -> f64 {
    let rates: Vec<f64> = joined(scene, at, way, of).into_iter().map(|l| turning(way, l)).collect();
    let mean = rates.iter().sum::<f64>() / rates.len().max(1) as f64;
    rates.iter().map(|w| (w - mean) * (w - mean)).sum()
}
