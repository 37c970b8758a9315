//! Centres from the loop equations: P_ij = i (v_i − v_j)/(ω_i − ω_j), v of the links' points at one
//! place.

use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::answer::MotionSource;
use hodograph_mechanism::mechanism::Level;
use hodograph_scene::{Find, LinkId, PointId, Scene};
use hodograph_worked::certified::certify;
use hodograph_worked::certified::ladder::AnswerPart;
use hodograph_worked::worked::{Scope, Worked, work};

use super::lines::{CentrePlace, ProjectiveFrame};
use super::omega;
use super::rounds::LinkPair;

/// A difference of angular velocities below this fraction of the largest is computed as an
/// interval.
const DOUBTFUL: f64 = 1e-7;
/// Relative motions below this fraction of the largest are rounding.
pub(super) const RESTING: f64 = 1e-11;
/// Digits to which a difference is certified to be zero.
const DIGITS: usize = 12;

/// The motion of every link, from the loop equations.
pub(super) struct Velocities<'a> {
    scene: &'a Scene,
    pub frame: ProjectiveFrame,
    /// The velocity of each link's point at the frame's middle (m/s), and ω (rad/s).
    links: Vec<Option<(Vec2, f64)>>,
    /// The largest of ω and v/size (rad/s).
    pub largest: f64,
}

impl<'a> Velocities<'a> {
    pub fn of(scene: &'a Scene, worked: &'a Worked) -> Velocities<'a> {
        let places = || {
            worked
                .configuration
                .points
                .iter()
                .enumerate()
                .filter_map(|(p, at)| Some((PointId(p), (*at)?)))
        };
        let count = places().count().max(1) as f64;
        let anchor = places().next();
        let first = anchor.map_or(Point::ORIGIN, |(_, at)| at);
        let middle =
            first + places().fold(Vec2::ZERO, |sum, (_, at)| sum + (at - first)) * (1.0 / count);
        let size = Some(worked.configuration.extent()).filter(|s| *s > 0.0).unwrap_or(1.0);
        let motion = |l: LinkId| {
            let (p, at) = anchor?;
            let omega = worked.solution.turning(Level::Velocity, l)?;
            let v = worked.solution.vector(Level::Velocity, p, Some(l))?;
            Some((v + (middle - at).perp() * omega, omega))
        };
        let links: Vec<Option<(Vec2, f64)>> =
            (0..scene.links.len()).map(|l| motion(LinkId(l))).collect();
        let largest = links
            .iter()
            .flatten()
            .map(|(v, omega)| omega.abs().max(v.norm() / size))
            .fold(0.0, f64::max);
        Velocities { scene, frame: ProjectiveFrame { middle, size }, links, largest }
    }

    /// Returns the motion of the first link of a pair relative to the second: velocity at the
    /// frame's middle, and ω.
    pub fn relative(&self, pair: LinkPair) -> Option<(Vec2, f64)> {
        let ((v, omega), (w, other)) = (self.links[pair.i.0]?, self.links[pair.j.0]?);
        Some((v - w, omega - other))
    }

    /// True if two links have no relative motion, to rounding.
    pub fn rests(&self, pair: LinkPair) -> bool {
        let still = RESTING * self.largest;
        self.relative(pair)
            .is_some_and(|(v, omega)| omega.abs() <= still && v.norm() <= still * self.frame.size)
    }

    /// True if two links certainly do not turn relative to one another in this pose: a small
    /// difference is computed as an interval.
    pub fn surely_translate(&self, pair: LinkPair) -> bool {
        let Some((_, turning)) = self.relative(pair) else { return false };
        if turning.abs() > DOUBTFUL * self.largest {
            return false;
        }
        let mut asking = self.scene.clone();
        let what = match (pair.i == self.scene.ground, pair.j == self.scene.ground) {
            (true, _) => omega(pair.j, None),
            (_, true) => omega(pair.i, None),
            _ => omega(pair.i, Some(pair.j)),
        };
        asking.find = vec![Find { what, text: "omega".into(), span: Default::default() }];
        let Ok(worked) = work(&asking, Scope::Questions) else { return false };
        let certified = certify(&asking, &worked.value, DIGITS);
        certified.first().is_some_and(|c| c.part(AnswerPart::Scalar).is_some_and(|n| n.zero))
    }

    /// Returns the centre of two links by their velocities; `None` if they have no relative motion
    /// or their motion is not known.
    pub fn centre(&self, pair: LinkPair, infinite: bool) -> Option<CentrePlace> {
        let (v, omega) = self.relative(pair)?;
        if self.rests(pair) {
            return None;
        }
        let still = f64::EPSILON * 16.0 * self.largest;
        if infinite || omega.abs() <= DOUBTFUL * self.largest && self.surely_translate(pair) {
            return CentrePlace::infinity(v.perp()).filter(|_| v.norm() > still * self.frame.size);
        }
        let at = self.frame.middle + v.perp() * (1.0 / omega);
        (omega.abs() > still && at.is_finite()).then_some(CentrePlace::At(at))
    }

    /// Returns the velocity of one link relative to the other at their centre, divided by the
    /// largest velocities at its distance: 0 at a true centre. `None` if the motion is not known.
    pub fn residual(&self, pair: LinkPair, place: CentrePlace) -> Option<f64> {
        let (v, omega) = self.relative(pair)?;
        if self.largest == 0.0 {
            return None;
        }
        let ProjectiveFrame { middle, size } = self.frame;
        Some(match place {
            CentrePlace::At(p) => {
                let r = p - middle;
                (v + r.perp() * omega).norm() / (self.largest * (size + r.norm()))
            }
            CentrePlace::Infinity(u) => (u.dot(v).abs() / size).max(omega.abs()) / self.largest,
        })
    }
}
