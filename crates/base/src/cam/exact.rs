//! Results over a turn in any kind of number: the angles found in double precision are solved again
//! as roots of their equations and enclosed.
//!
//! Double precision takes the decisions: which piece is touched, between which samples a derivative
//! passes through zero, which extreme is the largest. Longer numbers solve: a joint has a closed
//! form, or is the angle at which two pieces hold the follower equally far out; an extreme is a
//! zero of a derivative. The secant method finds the zero; it lies surely between two angles at
//! which the signs of the function differ.

use super::survey::FollowerPhase;
use super::turn::Peak;
use super::{
    Branch, CamMotion, CamStation, CamSurvey, Disc, FollowerTip, PieceSide, Surveyed,
    in_half_turns, whole_turns,
};
use crate::number::Real;
use std::f64::consts::TAU;
use std::sync::{Arc, OnceLock};

/// A cam in one kind of number, with the same cam in double precision.
pub struct ExactCam<'a, N> {
    pub(super) double: &'a Disc,
    pub(super) survey: &'a Surveyed,
    pub(super) exact: Arc<ExactDisc<N>>,
}

/// A disc in one kind of number, with the angles of its joints once they are asked for.
pub struct ExactDisc<N> {
    pub(super) disc: Disc<N>,
    ends: OnceLock<Vec<(f64, N)>>,
}

impl<N: Real> ExactDisc<N> {
    /// Creates the disc.
    pub fn new(disc: Disc<N>) -> Arc<Self> {
        Arc::new(ExactDisc { disc, ends: OnceLock::new() })
    }

    /// Returns the angles at which stages and pieces of their laws begin, or at which the follower's
    /// position matches an end of a piece of the profile, each after its nearest double.
    fn ends(&self) -> &[(f64, N)] {
        self.ends.get_or_init(|| {
            let ends: Vec<N> = match &self.disc.motion {
                CamMotion::Law { program, .. } => program.corners(),
                CamMotion::Profile(segments) => {
                    segments.iter().flat_map(|s| self.disc.ends(s)).collect()
                }
            };
            ends.into_iter().filter(|x| x.is_decided()).map(|x| (x.approx(), x)).collect()
        })
    }
}

/// An angle closer to a joint than this (rad) is the joint: both are found in double precision.
const ON_THE_JOINT: f64 = 1e-12;

/// An end of a piece closer than this (rad) to a joint is the end that makes the joint: joints are
/// found to some units in the last place, and crossings of pieces this close to an end occur only
/// by chance.
const THE_SAME: f64 = 1e-8;

impl<'a, N: Real> ExactCam<'a, N> {
    /// Creates a cam in one kind of number; `double` is the same cam in double precision, with its
    /// survey.
    pub fn new(double: &'a Disc, survey: &'a Surveyed, exact: Arc<ExactDisc<N>>) -> Self {
        ExactCam { double, survey, exact }
    }

    /// Returns the disc, to be kept for the same cam.
    pub fn exact(&self) -> Arc<ExactDisc<N>> {
        Arc::clone(&self.exact)
    }

    /// The survey in double precision.
    pub(super) fn survey(&self) -> &'a CamSurvey {
        self.survey.of(self.double)
    }

    /// Returns the state at an angle, seen from a side, by the formula that applies there in double
    /// precision.
    pub fn station(&self, (near, side): (f64, PieceSide), phi: N) -> Option<CamStation<N>> {
        self.exact.disc.station_on(self.double.branch(near, side)?, phi)
    }

    /// Returns the lift: the follower's coordinate less its value on the base circle.
    pub fn lift(&self, (near, side): (f64, PieceSide), phi: N) -> Option<N> {
        match (&self.exact.disc.motion, self.double.branch(near, side)?) {
            (CamMotion::Law { program, .. }, Branch::Stage(stage, piece)) => {
                program.lift_in((stage, piece), phi).map(|s| s.value())
            }
            (_, branch) => Some(self.exact.disc.coordinate_on(branch, phi)?.value() - self.end(0)?),
        }
    }

    /// Returns the greatest lift.
    pub fn stroke(&self) -> Option<N> {
        match &self.exact.disc.motion {
            CamMotion::Law { program, .. } => Some(program.stroke()),
            CamMotion::Profile(_) => Some(self.end(1)? - self.end(0)?),
        }
    }

    /// Returns the least (0) or greatest (1) coordinate of the follower on a profile.
    fn end(&self, which: usize) -> Option<N> {
        let Peak { phi, side, .. } = self.survey().ends?[which];
        let place = self.located(phi, side, &|s| s.q.0[1])?;
        self.exact.disc.coordinate_on(self.double.branch(phi, side)?, place).map(|q| q.value())
    }

    /// Returns the sum of the angles of the phases of a kind: see [`CamSurvey::angle`].
    pub fn angle(&self, way: i8, out: bool) -> Option<N> {
        let reversal = |phi: f64, side: PieceSide| self.located(phi, side, &|s| s.q.0[1]);
        // Double precision may take the ends of a phase in the wrong order if the profile hardly
        // lifts the follower.
        let of = |p: &FollowerPhase| {
            Some(reversal(p.to, PieceSide::Before)? - reversal(p.from, PieceSide::After)?)
                .filter(|a| a.approx() >= 0.0)
        };
        self.survey().phases_of(way, out).try_fold(N::from_f64(0.0), |sum, p| Some(sum + of(p)?))
    }

    /// Returns the least radius of curvature of the profile: see [`CamSurvey::sharpest`].
    pub fn least_rho(&self) -> Option<N> {
        let Peak { phi, side, .. } = self.survey().sharpest?;
        let branch = self.double.branch(phi, side)?;
        if let (CamMotion::Profile(segments), Branch::Piece(piece)) =
            (&self.exact.disc.motion, branch)
        {
            return segments.get(piece).map(|s| s.radius());
        }
        let station =
            self.exact.disc.station_on(branch, self.located(phi, side, &|s| s.rho_slope)?)?;
        Some(match self.exact.disc.touch {
            FollowerTip::Point { radius } => station.rho_pitch - radius,
            FollowerTip::Flat { .. } => station.rho,
        })
    }

    /// Returns the exact angle of a result of double precision: a joint, or the zero of a
    /// derivative.
    pub(super) fn located(
        &self,
        phi: f64,
        side: PieceSide,
        slope: &dyn Fn(&CamStation<N>) -> N,
    ) -> Option<N> {
        if self.survey().corners.iter().any(|c| is_at(*c, phi)) {
            return self.joint(phi);
        }
        let branch = self.double.branch(phi, side)?;
        // A derivative that is zero throughout has no isolated root: the angle is taken as it is.
        root(phi, STEP, &|x| self.exact.disc.station_on(branch, x).map(|s| slope(&s))).or_else(
            || {
                let station = self.exact.disc.station_on(branch, N::from_f64(phi))?;
                let still = slope(&station);
                (still.approx() == 0.0 && still.radius() == 0.0).then(|| N::from_f64(phi))
            },
        )
    }

    /// Returns the exact angle of a joint: an end of a stage, of a piece of its law, or of a piece
    /// of the profile; otherwise the angle at which two pieces hold the follower equally far out.
    pub(super) fn joint(&self, phi: f64) -> Option<N> {
        let off = |(near, _): &&(f64, N)| in_half_turns(near - phi).abs();
        let ends = self.exact.ends().iter();
        let end = ends.filter(|x| off(x) <= THE_SAME).min_by(|a, b| off(a).total_cmp(&off(b)));
        if let Some(&(near, x)) = end {
            return Some(x - whole_turns(libm::rint((near - phi) / TAU)));
        }
        let [before, after] =
            [PieceSide::Before, PieceSide::After].map(|side| self.double.branch(phi, side));
        let (before, after) = (before?, after?);
        let of = |branch: Branch, x: N| self.exact.disc.coordinate_on(branch, x).map(|q| q.value());
        root(phi, STEP, &|x| Some(of(before, x)? - of(after, x)?))
    }
}

/// True if two angles are the same angle of the cam.
pub(super) fn is_at(corner: f64, phi: f64) -> bool {
    in_half_turns(corner - phi).abs() <= ON_THE_JOINT
}

/// Distance (rad) of the first two points of the secant method from the double-precision value, on
/// either side.
const STEP: f64 = 1e-6;

/// Greatest number of secant steps: each step nearly doubles the number of digits, so this suffices
/// for the longest numbers.
const ROUNDS: usize = 24;

/// Returns the zero of a function within `step` of `near`. If the number type keeps account of its
/// error, the result encloses all numbers between two points at which the signs of the function
/// surely differ; `None` if no such points are found.
pub(super) fn root<N: Real>(near: f64, step: f64, f: &dyn Fn(N) -> Option<N>) -> Option<N> {
    let (mut a, mut b) = (N::from_f64(near - step), N::from_f64(near + step));
    let (mut fa, mut fb) = (f(a)?, f(b)?);
    let mut slope = f64::NAN;
    for _ in 0..ROUNDS {
        let (way, gain) = ((b - a).mid(), (fb - fa).mid());
        if way.approx() == 0.0 || gain.approx() == 0.0 {
            break;
        }
        slope = gain.approx() / way.approx();
        let next = (b - fb.mid() * way / gain).mid();
        if !next.is_decided() || (next.approx() - near).abs() > step {
            break;
        }
        let (last, there) = (fb, f(next)?);
        (a, fa, b, fb) = (b, fb, next, there);
        // A value that cannot be distinguished from zero, or that does not decrease, is not
        // improved by further steps.
        if !is_surely_nonzero(fb) || fb.approx().abs() >= last.approx().abs() {
            break;
        }
    }
    if !N::knows_its_error() {
        return Some(b);
    }
    let mut r = 2.0 * (fb.approx().abs() + fb.radius()) / slope.abs();
    while r <= step {
        let [low, high] = [-r, r].map(|r| f(b + N::from_f64(r)));
        let (low, high) = (low?, high?);
        if is_surely_nonzero(low)
            && is_surely_nonzero(high)
            && low.approx().signum() != high.approx().signum()
        {
            return Some(b.widened(r));
        }
        r *= 4.0;
    }
    None
}

/// Returns true if a number is surely not zero.
fn is_surely_nonzero<N: Real>(x: N) -> bool {
    x.is_decided() && x.approx().abs() * (1.0 - 1e-15) > x.radius()
}
