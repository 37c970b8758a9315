//! Positions as accurate as `f64` can hold them: where the closed forms lost digits (circles that
//! barely cross), they are found again in longer numbers and rounded once.
//!
//! Drawing and analysis share the positions: neither way can notice digits that the positions have
//! lost.

use super::rung::{Climb, Rung};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_base::number::decimal::Certain;
use hodograph_mechanism::mechanism::{Demand, Mechanism};
use hodograph_mechanism::motion::MotionNumber;
use hodograph_mechanism::position::{self, Configuration, Path, Pose};
use hodograph_scene::Scene;

/// The bound, as a part of the mechanism's size, within which positions are left unchanged. A
/// crossing under the angle φ magnifies rounding by 1/sin φ: a bound of 6e-14 belongs to a crossing
/// under a degree or two, or to a chain of many dyads.
const PLAIN: f64 = 256.0 * f64::EPSILON;

/// The part of the size to which a rounded position must be known, to be within a unit in the last
/// place of the true one.
const KNOWN: f64 = f64::EPSILON / 8.0;

/// The least error at which positions are replaced: the bound of a long chain is far larger than
/// its error, and other questions must not change a digit of it.
const OFF: f64 = 64.0 * f64::EPSILON;

/// Returns the configuration of a scene at its instant with every position rounded from its
/// certified value, if `f64` has lost digits of any. It is unchanged if `f64` has not, or if no
/// rung can decide (a group that is not proved, one that closes only within rounding).
pub fn settled(scene: &Scene, m: &Mechanism, demand: &Demand, at: Configuration) -> Configuration {
    settled_beyond(scene, m, demand, at, [PLAIN, OFF])
}

/// Returns the configuration to the last digit, for a pose in which even rounding is magnified
/// beyond the allowed error.
pub fn settled_finely(
    scene: &Scene,
    m: &Mechanism,
    demand: &Demand,
    at: Configuration,
) -> Configuration {
    settled_beyond(scene, m, demand, at, [0.0, f64::EPSILON / 4.0])
}

/// The configuration for the thresholds `plain` and `least`, see [`PLAIN`] and [`OFF`].
fn settled_beyond(
    scene: &Scene,
    m: &Mechanism,
    demand: &Demand,
    at: Configuration,
    [plain, least]: [f64; 2],
) -> Configuration {
    let extent = at.extent();
    let places = PlaceRounding { scene, m, demand, at: &at, extent };
    let mut last = None;
    for rung in Rung::LADDER {
        let Some(found) = rung.climb(&places) else { continue };
        if rung == Rung::Double && found.bound <= plain * extent {
            return at;
        }
        let known = found.bound <= KNOWN * extent;
        last = Some(found);
        if known {
            break;
        }
    }
    match last {
        // A position that is no better known than that is no correction.
        Some(found) if found.bound <= PLAIN * extent && found.off > least * extent => found.at,
        _ => at,
    }
}

/// The positions of a rung.
struct RoundedPlaces {
    /// The rounded positions; a number of `f64` that the rung does not contradict is kept.
    at: Configuration,
    /// The largest bound of a place's error, with directions counted at the mechanism's size (m).
    bound: f64,
    /// The error of `f64` (m).
    off: f64,
}

struct PlaceRounding<'a> {
    scene: &'a Scene,
    m: &'a Mechanism,
    demand: &'a Demand,
    at: &'a Configuration,
    extent: f64,
}

impl Climb for PlaceRounding<'_> {
    type Found = Option<RoundedPlaces>;

    fn with<N: Certain + MotionNumber>(&self) -> Self::Found {
        let there = position::recompute::<N>(self.scene, self.m, self.demand, self.at).ok()?;
        let mut r = Rounding { bound: 0.0, off: 0.0, extent: self.extent };
        let mut at = self.at.clone();
        for (here, there) in at.points.iter_mut().zip(&there.points) {
            r.option(here, there, Rounding::point)?;
        }
        for (here, there) in at.poses.iter_mut().zip(&there.poses) {
            r.option(here, there, Rounding::pose)?;
        }
        for (here, there) in at.guides.iter_mut().zip(&there.guides) {
            r.option(here, there, Rounding::path)?;
        }
        for (here, there) in at.shapes.points.iter_mut().zip(&there.shapes.points) {
            for ((_, here), (_, there)) in here.iter_mut().zip(there) {
                r.point(here, there)?;
            }
        }
        for (here, there) in at.shapes.guides.iter_mut().zip(&there.shapes.guides) {
            r.option(here, there, Rounding::path)?;
        }
        at.closures = there.closures;
        Some(RoundedPlaces { at, bound: r.bound, off: r.off })
    }
}

/// Rounds numbers of a rung to `f64`, and records the differences.
struct Rounding {
    bound: f64,
    off: f64,
    extent: f64,
}

impl Rounding {
    /// Rounds one number; `unit` is the length of its unit (m).
    fn number<N: Real>(&mut self, here: &mut f64, there: N, unit: f64) -> Option<()> {
        if !there.is_decided() {
            return None;
        }
        let off = (there.approx() - *here).abs();
        self.bound = self.bound.max(there.radius() * unit);
        if off > there.radius() {
            self.off = self.off.max(off * unit);
            *here = there.approx();
        }
        Some(())
    }

    fn point<N: Real>(&mut self, here: &mut Point, there: &Point<N>) -> Option<()> {
        self.number(&mut here.x, there.x, 1.0)?;
        self.number(&mut here.y, there.y, 1.0)
    }

    fn direction<N: Real>(&mut self, here: &mut Vec2, there: &Vec2<N>) -> Option<()> {
        let unit = self.extent;
        self.number(&mut here.x, there.x, unit)?;
        self.number(&mut here.y, there.y, unit)
    }

    fn pose<N: Real>(&mut self, here: &mut Pose, there: &Pose<N>) -> Option<()> {
        self.point(&mut here.origin, &there.origin)?;
        self.direction(&mut here.axis, &there.axis)
    }

    fn path<N: Real>(&mut self, here: &mut Path, there: &Path<N>) -> Option<()> {
        match (here, there) {
            (Path::Line { through, direction }, Path::Line { through: t, direction: d }) => {
                self.point(through, t)?;
                self.direction(direction, d)
            }
            (Path::Arc { centre, radius }, Path::Arc { centre: c, radius: r }) => {
                self.point(centre, c)?;
                self.number(radius, *r, 1.0)
            }
            (Path::Line { .. }, Path::Arc { .. }) | (Path::Arc { .. }, Path::Line { .. }) => None,
        }
    }

    /// Rounds an optional value; both options must have a value, or neither.
    fn option<A, B>(
        &mut self,
        here: &mut Option<A>,
        there: &Option<B>,
        each: impl Fn(&mut Self, &mut A, &B) -> Option<()>,
    ) -> Option<()> {
        match (here, there) {
            (Some(here), Some(there)) => each(self, here, there),
            (None, None) => Some(()),
            _ => None,
        }
    }
}
