//! Equilibrium of all links together: the ground bears the loads of the mechanism.

use super::Equilibrium;
use hodograph_base::geom::Vec2;
use hodograph_mechanism::force::{Cause, unit_balance};
use hodograph_mechanism::position::{Configuration, Path};
use hodograph_scene::{GuideId, PointId, Scene};

/// Forces on all links together (N).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceTotals {
    /// The sum of all loads, including inertia and the balancing force.
    pub loads: Vec2,
    /// The sum of the forces of the ground, and of the drivers on it, on the links.
    pub ground: Vec2,
}

impl ForceTotals {
    /// Returns the sums of a drawing; `None` if a reaction of the ground is not drawn.
    pub fn of(scene: &Scene, at: &Configuration, of: &Equilibrium) -> Option<ForceTotals> {
        let forces = &of.forces;
        let balance = unit_balance(scene, at)
            .map_or(Some(Vec2::ZERO), |unit| Some(unit.wrench.force * forces.balance?))?;
        // Friction is a part of a reaction.
        let given = of.loads.iter().filter(|l| !matches!(l.cause, Cause::Friction(_)));
        let loads = given.fold(balance, |sum, load| sum + load.wrench.force);
        let on_ground = |p: &PointId| scene.links[scene.ground.0].points.contains(p);
        let mut ground = Vec2::ZERO;
        for &p in &scene.links[scene.ground.0].points {
            let presses = scene.carriers(p).any(|l| l != scene.ground && at.poses[l.0].is_some());
            match forces.pins.iter().find(|(own, on, _)| (*own, *on) == (p, scene.ground)) {
                Some((.., force)) => ground += -*force,
                None if presses => return None,
                None => {}
            }
        }
        for (g, guide) in scene
            .guides
            .iter()
            .enumerate()
            .filter(|(g, guide)| guide.rolling.is_none() && at.guides[*g].is_some())
        {
            let Some(sign) = side_of_ground(scene, GuideId(g), on_ground) else { continue };
            let runs = guide.slider.is_none_or(|s| s == scene.ground || at.poses[s.0].is_some());
            if runs {
                ground += forces.guides.iter().find(|(own, _)| own.0 == g)?.1.force * sign;
            }
        }
        for (r, pair) in
            scene.rolling.iter().enumerate().filter(|(_, pair)| pair.links.contains(&scene.ground))
        {
            if pair.links.iter().all(|l| at.poses[l.0].is_some()) {
                let force = forces.rolling.iter().find(|(own, _)| own.0 == r)?.1;
                ground += if pair.links[0] == scene.ground { force } else { -force };
            }
        }
        for (d, driver) in scene.drivers.iter().enumerate() {
            if let (Some(guide), Some(size)) = (driver.kind.guide(), forces.drivers.get(d)) {
                let along = match at.guides[guide.0]? {
                    Path::Line { direction, .. } => direction,
                    Path::Arc { centre, .. } => {
                        (at.points[scene.guides[guide.0].pin?.0]? - centre).perp().unit()?
                    }
                };
                ground += side_of_ground(scene, guide, on_ground)
                    .map_or(Vec2::ZERO, |sign| along * (sign * size));
            }
            // A cylinder pushes its second end away from its first.
            let Some([a, b]) = driver.kind.ends() else { continue };
            let along = (at.points[b.0]? - at.points[a.0]?).unit()?;
            for (end, sign) in [(a, 1.0), (b, -1.0)] {
                if on_ground(&end) && scene.carriers(end).count() == 1 {
                    ground += along * (sign * forces.drivers.get(d)?);
                }
            }
        }
        Some(ForceTotals { loads, ground })
    }
}

/// Returns the sign of the ground's force at a guide: +1 along the force on the runner, −1 against
/// it; `None` for a guide between moving links.
fn side_of_ground(
    scene: &Scene,
    guide: GuideId,
    on_ground: impl Fn(&PointId) -> bool,
) -> Option<f64> {
    let g = &scene.guides[guide.0];
    if g.on == scene.ground {
        return Some(1.0);
    }
    let runs = g.slider.map_or_else(|| g.pin.is_some_and(|p| on_ground(&p)), |s| s == scene.ground);
    runs.then_some(-1.0)
}
