//! The answers to far more digits than anyone prints, found in another way: velocities and
//! accelerations as differences of positions over a time so short that the difference formula is
//! exact.
//!
//! Only the positions are shared with the other ways. With 640 bits and a time of 2^-180 s the
//! formula's own error is near 1e-108 of the third derivative, and rounding near 1e-84: no formula
//! for a velocity or an acceleration is trusted.

use crate::worked::Worked;
use hodograph_base::diag::Faults;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::{Big, Real};
use hodograph_mechanism::answer::{AnswerValue, MotionSource, evaluate};
use hodograph_mechanism::mechanism::Level;
use hodograph_mechanism::position::{self, Configuration};
use hodograph_scene::{LinkId, PointId, Scene};

/// The bits of the numbers in which [`answers`] must run: see [`hodograph_base::number::within`].
pub const BITS: usize = 640;

/// The exponent of the time step.
const STEP: f64 = -180.0;

/// Three configurations in equal steps of time: a source of vectors by difference quotients.
pub struct Differences<N> {
    /// The configuration a step before the scene's instant.
    pub before: Configuration<N>,
    /// The configuration at the instant.
    pub now: Configuration<N>,
    /// The configuration a step after it.
    pub after: Configuration<N>,
    /// The time between two of them (s).
    pub step: N,
}

impl<N: Real> Differences<N> {
    /// The first or second difference quotient of a place.
    fn quotient(&self, level: Level, [a, b, c]: [Point<N>; 3]) -> Vec2<N> {
        let one = N::from_f64(1.0);
        match level {
            Level::Acceleration => ((c - b) - (b - a)) * (one / (self.step * self.step)),
            Level::Position | Level::Velocity => (c - a) * (one / (self.step + self.step)),
        }
    }

    fn each<T>(&self, f: impl Fn(&Configuration<N>) -> Option<T>) -> Option<[T; 3]> {
        Some([f(&self.before)?, f(&self.now)?, f(&self.after)?])
    }
}

impl<N: Real> MotionSource<N> for Differences<N> {
    fn vector(&self, level: Level, p: PointId, on: Option<LinkId>) -> Option<Vec2<N>> {
        let places = match on {
            None => self.each(|c| c.points[p.0])?,
            Some(l) => {
                let local = self.now.poses[l.0]?.to_local(self.now.points[p.0]?);
                self.each(|c| Some(c.poses[l.0]?.to_world(local)))?
            }
        };
        Some(self.quotient(level, places))
    }

    fn turning(&self, level: Level, link: LinkId) -> Option<N> {
        // Angles are counted from the pose at the instant, so that no turn is lost and none is
        // large.
        let start = self.now.poses[link.0]?.axis;
        let angles = self.each(|c| {
            let axis = c.poses[link.0]?.axis;
            Some(Point::new(start.cross(axis).atan2(start.dot(axis)), N::from_f64(0.0)))
        })?;
        Some(self.quotient(level, angles).x)
    }
}

/// Returns all answers of a worked scene; `None` for those without a value. It must be called
/// within a region of [`BITS`] bits.
///
/// # Errors
/// Scenes whose pose is given by coordinates, or that do not close in longer numbers: see
/// [`position::later`].
pub fn answers(scene: &Scene, worked: &Worked) -> Result<Vec<Option<AnswerValue<Big>>>, Faults> {
    let source = differences(scene, worked)?;
    Ok(worked
        .results
        .iter()
        .map(|r| evaluate(scene, &source.now, &source, &scene.find[r.find].what))
        .collect())
}

/// Returns the configurations for [`answers`]; it must be called within such a region too.
///
/// # Errors
/// The errors of [`answers`].
pub fn differences(scene: &Scene, worked: &Worked) -> Result<Differences<Big>, Faults> {
    let (m, demand, meant) = (&worked.mechanism, &worked.demand, &worked.configuration);
    let step = Big::from_f64(libm::exp2(STEP));
    let now = position::recompute::<Big>(scene, m, demand, meant)?;
    let at = |t: Big| position::later(scene, m, demand, meant, &now, t);
    let (before, after) = (at(-step)?, at(step)?);
    Ok(Differences { before, now, after, step })
}
