//! The whole motion of mechanisms without a compiled form: Newton's method follows it from pose to
//! pose, and the loop equations solve each pose.
//!
//! It gives [`crate::extreme`] the same results as a program: the range of the driver, and
//! position, rate and acceleration of every output at samples of the range and between them.

use super::poses::{PoseFollower, PoseSweep};
use super::whole::{DrivenMechanism, event};
use crate::PlacedScene;
use crate::extreme::DrivenOutput;
use crate::limit::DriverRange;
use hodograph_analytic as analytic;
use hodograph_mechanism::answer::MotionSource;
use hodograph_mechanism::mechanism::{Demand, Level};
use hodograph_mechanism::position::{Configuration, Path};
use hodograph_scene::{LinkId, PointId, Scene};
use std::borrow::Cow;

/// The number of samples through a turn, between which a rate changes its sign at most once: one
/// for each degree.
const SAMPLES: usize = 360;

/// A mechanism followed through the whole travel of a driver.
pub(crate) struct TravelWalk<'a> {
    placed: &'a PlacedScene<'a>,
    driver: usize,
    follower: &'a PoseFollower<'a>,
    sweep: PoseSweep,
    now: f64,
}

impl<'a> TravelWalk<'a> {
    /// Follows the mechanism. The scene's driver runs at unit speed, the others are at rest.
    pub fn new(
        placed: &'a PlacedScene<'a>,
        driver: usize,
        follower: &'a PoseFollower<'a>,
        now: f64,
    ) -> TravelWalk<'a> {
        TravelWalk { placed, driver, follower, sweep: follower.sweep(SAMPLES), now }
    }

    /// Returns the range of the driver. Where a joint leaves the paper the search ends, and this is
    /// no limit.
    pub fn range(&self) -> DriverRange {
        let (scene, poses) = (self.placed.scene, &self.sweep.poses);
        let reach = if scene.drivers[self.driver].kind.turns() {
            self.sweep.period()
        } else {
            2.0 * self.placed.at.extent()
        };
        let mut ends = [None, None];
        for (end, (limit, pose)) in
            ends.iter_mut().zip(self.sweep.limits.iter().zip([poses.first(), poses.last()]))
        {
            let (Some(travel), Some(pose)) = (limit, pose) else { continue };
            if !self.sweep.far(pose) {
                let (moved, value) =
                    (DrivenMechanism::new(self.placed, self.driver), self.now + travel);
                // Halving comes as near to the fold as the root of the rounding.
                let located = moved.limit(value, &pose.configuration);
                *end =
                    Some(located.unwrap_or_else(|| {
                        event(self.placed.mechanism, value, &pose.configuration)
                    }));
            }
        }
        DriverRange { now: self.now, ends, changes: Vec::new(), reach }
    }

    /// Returns the first and last position of the driver that was reached.
    pub fn span(&self) -> [f64; 2] {
        let poses = &self.sweep.poses;
        let travel = |pose: Option<&super::TravelPose>| self.now + pose.map_or(0.0, |p| p.travel);
        if self.sweep.full {
            [self.now, self.now + self.sweep.period()]
        } else {
            [travel(poses.first()), travel(poses.last())]
        }
    }

    /// Returns the driver's angle after which the pose recurs, if all of it was followed.
    pub fn period(&self) -> Option<f64> {
        self.sweep.full.then(|| self.sweep.period())
    }

    /// Returns the number of turns followed.
    pub fn turns(&self) -> u64 {
        self.sweep.turns
    }

    /// Returns the number of turns after which the pose recurs; 0 if it never does.
    pub fn returns(&self) -> u64 {
        self.follower.returns()
    }

    /// Returns the pose and the motion at a position of the driver; `None` where it has none.
    pub fn at(&self, value: f64) -> Option<WalkedMotion<'a>> {
        let travel = value - self.now;
        let poses = &self.sweep.poses;
        if let Some(pose) = poses.iter().find(|p| p.travel == travel) {
            return self.moving(pose.configuration.clone(), travel);
        }
        // At a limit two assemblies meet: from there Newton's method may go to either, from this
        // side of it only to its own.
        let inner = poses
            .iter()
            .enumerate()
            .filter(|(k, _)| !self.sweep.is_limit(*k))
            .map(|(_, pose)| pose);
        let near = inner
            .min_by(|a, b| self.apart(a.travel, travel).total_cmp(&self.apart(b.travel, travel)))?;
        self.moving(self.follower.at(&near.configuration, travel)?, travel)
    }

    /// The distance of two positions of the driver; on a full turn the end is the beginning.
    fn apart(&self, a: f64, b: f64) -> f64 {
        let d = (a - b).abs();
        let period = self.sweep.period();
        if self.sweep.full { (d % period).min(period - d % period) } else { d }
    }

    fn moving(&self, at: Configuration, travel: f64) -> Option<WalkedMotion<'a>> {
        let mechanism = self.placed.mechanism;
        let scene = if self.placed.scene.has_laws(self.driver) {
            Cow::Owned(self.follower.scene_at(self.placed.scene, travel))
        } else {
            Cow::Borrowed(self.placed.scene)
        };
        let demand = Demand {
            groups: vec![Some(Level::Acceleration); mechanism.groups.len()],
            level: Level::Acceleration,
            needs: Vec::new(),
        };
        let solution = analytic::solve(&scene, mechanism, &at, &demand).ok()?;
        Some(WalkedMotion { scene, at, solution })
    }
}

/// The pose and the motion of the whole mechanism at one position of its driver.
pub(crate) struct WalkedMotion<'a> {
    scene: Cow<'a, Scene>,
    at: Configuration,
    solution: analytic::Solution,
}

impl WalkedMotion<'_> {
    /// Returns position, rate and acceleration of an output; `None` if it has none.
    pub fn of(&self, output: DrivenOutput) -> Option<[f64; 3]> {
        let WalkedMotion { scene, at, solution } = self;
        let all = match output {
            DrivenOutput::Turning(l) => {
                let angle = at.direction(scene, l)?.angle();
                [
                    angle,
                    solution.turning(Level::Velocity, l)?,
                    solution.turning(Level::Acceleration, l)?,
                ]
            }
            DrivenOutput::Sliding(g) => {
                let guide = &scene.guides[g.0];
                let Some(Path::Line { through, direction }) = at.guides[g.0] else { return None };
                let slider = guide.slider.filter(|_| guide.pin.is_none());
                let (place, runner) = match guide.pin.or_else(|| runner(scene, g.0)) {
                    Some(p) => (at.points[p.0]?, p),
                    // A link without points moves as its part under a pin that glides on it.
                    None => (at.poses[slider?.0]?.origin, gliding(scene, slider?)?),
                };
                let along = |level| Some(direction.dot(solution.vector(level, runner, slider)?));
                [
                    direction.dot(place - through),
                    along(Level::Velocity)?,
                    along(Level::Acceleration)?,
                ]
            }
        };
        all.iter().all(|x| x.is_finite()).then_some(all)
    }
}

/// A point of the link that glides along a guide: it moves as the link does.
fn runner(scene: &Scene, guide: usize) -> Option<PointId> {
    scene.links[scene.guides[guide].slider?.0].points.first().copied()
}

/// A pin that glides on a guide of a link.
fn gliding(scene: &Scene, link: LinkId) -> Option<PointId> {
    scene.guides.iter().find(|g| g.on == link).and_then(|g| g.pin)
}

#[cfg(test)]
mod tests {
    use crate::extreme::{MotionLimits, limits, limits_walked};
    use hodograph_mechanism::mechanism::Mechanism;
    use hodograph_scene::{read, templates};

    fn close(name: &str, a: f64, b: f64, tolerance: f64) {
        assert!((a - b).abs() <= tolerance, "{name}: {a} against {b}");
    }

    /// Mechanisms with a compiled form: full turns, bounded ones, sliders, a link on three legs.
    #[test]
    fn walking_finds_what_the_compiled_program_finds() {
        for name in ["crank-rocker", "slider-crank", "shaper", "class-iii-six-bar", "five-bar"] {
            let scene = read(templates::get(name).unwrap()).unwrap().value;
            let m = Mechanism::new(&scene).unwrap().value;
            let [compiled, walked]: [MotionLimits; 2] =
                [limits(&scene, &m, 0).unwrap(), limits_walked(&scene, &m, 0).unwrap()];
            for (a, b) in compiled.range.ends.iter().zip(&walked.range.ends) {
                match (a, b) {
                    (None, None) => {}
                    (Some(a), Some(b)) => {
                        close(name, a.value, b.value, 1e-13);
                        assert_eq!(a.toggle.is_some(), b.toggle.is_some(), "{name}");
                    }
                    _ => panic!("{name}: {a:?} against {b:?}"),
                }
            }
            for (a, b) in compiled.swings.iter().zip(&walked.swings) {
                assert_eq!(
                    (a.output, a.extremes.len()),
                    (b.output, b.extremes.len()),
                    "{name}: {a:?}\n{b:?}"
                );
                if let (Some(a), Some(b)) = (a.stroke, b.stroke) {
                    close(name, a, b, 1e-6);
                }
                if let (Some(a), Some(b)) = (a.time_ratio, b.time_ratio) {
                    close(name, a, b, 1e-9);
                }
            }
        }
    }
}
