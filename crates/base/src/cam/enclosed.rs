//! Extremes, shocks and least sizes over a turn in any kind of number: the angles found in double
//! precision are solved again as roots, and the values follow from them.

use super::exact::{ExactDisc, is_at, root};
use super::survey::LeastBase;
use super::turn::Peak;
use super::{
    Branch, CamMotion, CamStation, Disc, ExactCam, Follower, FollowerTip, PieceSide,
    ProfileSegment, stations,
};
use crate::number::Real;

/// An extreme of a turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CamExtreme {
    /// Least (0) or greatest (1) s′.
    Rate(usize),
    /// Least (0) or greatest (1) s″.
    Bend(usize),
    /// The greatest pressure angle as the follower goes out (0) or comes back (1).
    Pressure(usize),
    /// The least radius of curvature: of the pitch curve, for a flat face of the profile.
    Radius,
}

/// Relative distance from the double-precision value within which the least base circle is sought.
const BESIDE: f64 = 1e-9;

/// Number of samples of a turn, and the relative amount by which the least distance may lie below
/// that of the nearest sample.
const SAMPLES: usize = 720;
const BETWEEN_SAMPLES: f64 = 1e-3;

impl<N: Real> ExactCam<'_, N> {
    /// Returns the cam in these numbers.
    pub fn disc(&self) -> &Disc<N> {
        &self.exact.disc
    }

    /// Returns the angle and the value of an extreme.
    pub fn mark(&self, mark: CamExtreme) -> Option<[N; 2]> {
        let survey = self.survey();
        match mark {
            CamExtreme::Rate(k) => self.peak(survey.fastest[0][k]?, &|s| s.q.0[2], &|s| s.q.0[1]),
            CamExtreme::Bend(k) => self.peak(survey.fastest[1][k]?, &|s| s.q.0[3], &|s| s.q.0[2]),
            CamExtreme::Pressure(k) => {
                let peak = survey.steepest[k]?;
                // The rate is zero where a phase of the follower begins or ends.
                let ends = survey
                    .phases
                    .iter()
                    .flat_map(|p| [p.from, p.to])
                    .any(|end| is_at(end, peak.phi));
                let slope: &dyn Fn(&CamStation<N>) -> N =
                    if ends { &|s| s.q.0[1] } else { &|s| s.pressure_slope };
                self.peak(peak, slope, &|s| s.pressure)
            }
            CamExtreme::Radius => self.peak(survey.sharpest?, &|s| s.rho_slope, &|s| s.rho_pitch),
        }
    }

    fn peak(
        &self,
        peak: Peak,
        slope: &dyn Fn(&CamStation<N>) -> N,
        value: &dyn Fn(&CamStation<N>) -> N,
    ) -> Option<[N; 2]> {
        let place = self.located(peak.phi, peak.side, slope)?;
        let station =
            self.exact.disc.station_on(self.double.branch(peak.phi, peak.side)?, place)?;
        Some([place, value(&station)])
    }

    /// Returns the angle of a shock, and s′ or s″ before and after it.
    pub fn jump(&self, index: usize) -> Option<[N; 3]> {
        let jump = self.survey().jumps.get(index)?;
        let place = self.joint(jump.phi)?;
        let on = |side: PieceSide| {
            Some(
                self.exact.disc.coordinate_on(self.double.branch(jump.phi, side)?, place)?.0
                    [jump.shock.order()],
            )
        };
        Some([place, on(PieceSide::Before)?, on(PieceSide::After)?])
    }

    /// Returns the angle of the first contact with a hollow that is too narrow for the follower's
    /// end, and the radius of the hollow (negative).
    pub fn hollow(&self) -> Option<[N; 2]> {
        let (CamMotion::Profile(segments), FollowerTip::Point { radius }) =
            (&self.exact.disc.motion, self.exact.disc.touch)
        else {
            return None;
        };
        let narrow = |rho: &N| rho.approx() < 0.0 && -rho.approx() <= radius.approx();
        let rho = segments.iter().map(ProfileSegment::radius).find(narrow)?;
        Some([self.located(self.survey().hollow?.0, PieceSide::After, &|s| s.rho_slope)?, rho])
    }

    /// Returns the radius of the base circle; for a profile, the least distance of the touched
    /// points from the axis.
    pub fn base(&self) -> Option<N> {
        let segments = match &self.exact.disc.motion {
            CamMotion::Law { base, .. } => return Some(*base),
            CamMotion::Profile(segments) => segments,
        };
        let near = stations(self.double, SAMPLES)
            .into_iter()
            .map(|(s, side)| (s.contact.norm(), s.phi, side));
        let (least, phi, side) = near.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let Branch::Piece(piece) = self.double.branch(phi, side)? else { return None };
        // On the normal through the axis, or at an end of the piece.
        let (distance, radius) = match segments[piece] {
            ProfileSegment::Arc { centre, radius, .. } => (centre.norm(), radius),
            ProfileSegment::Line { distance, .. } => (distance, N::from_f64(0.0)),
        };
        let (sum, difference) = (distance + radius, distance - radius);
        let all = [sum, -sum, difference, -difference].into_iter().filter(|x| x.approx() > 0.0);
        let is = |x: &N| {
            x.approx() <= least * (1.0 + 1e-12) && x.approx() >= least * (1.0 - BETWEEN_SAMPLES)
        };
        all.into_iter().find(is).or_else(|| {
            let branch = self.double.branch(phi, side)?;
            Some(
                self.exact
                    .disc
                    .station_on(branch, self.located(phi, side, &|s| s.q.0[1])?)?
                    .contact
                    .norm(),
            )
        })
    }

    /// Returns the pressure angle at the start of the rise.
    pub fn pressure_at_start(&self) -> Option<N> {
        let from = self.survey().phases.iter().find(|p| p.way == 1)?.from;
        let peak = Peak { phi: from, side: PieceSide::After, value: 0.0 };
        self.peak(peak, &|s| s.q.0[1], &|s| s.pressure).map(|[_, pressure]| pressure)
    }

    /// Returns the least half width of a flat face about its point: max |s′|, since the contact is
    /// at the distance s′ from the point.
    pub fn face_half(&self) -> Option<N> {
        let both = [self.mark(CamExtreme::Rate(0))?[1], self.mark(CamExtreme::Rate(1))?[1]];
        let [low, high] = both.map(N::magnitude);
        Some(if low.approx() > high.approx() { low } else { high })
    }

    /// Returns the radius of the least base circle whose profile is not undercut. There the least
    /// radius of the pitch curve equals that of the follower's end, or the follower just reaches
    /// its cam.
    pub fn least_base(&self) -> Option<N> {
        let LeastBase { base: near, sharpest: peak } = self.survey.least_base(self.double)?;
        let zero = N::from_f64(0.0);
        let (radius, reach) = match (self.exact.disc.touch, self.exact.disc.follower) {
            (FollowerTip::Flat { .. }, _) => (zero, None),
            (FollowerTip::Point { radius }, Follower::Translating { offset, .. }) => {
                (radius, Some(offset))
            }
            (FollowerTip::Point { radius }, Follower::Oscillating { pivot, arm, .. }) => {
                (radius, Some(pivot.norm() - arm))
            }
        };
        let reach = reach.map(|r| r.magnitude() - radius);
        if let Some(reach) = reach.filter(|r| (r.approx() - near).abs() <= BESIDE * near) {
            return Some(reach);
        }
        let peak = peak?;
        root(near, BESIDE * near, &|base| {
            let disc = with_base(&self.exact.disc, base)?;
            let place = ExactCam { exact: ExactDisc::new(disc.clone()), ..*self }.located(
                peak.phi,
                peak.side,
                &|s| s.rho_slope,
            )?;
            Some(
                disc.station_on(self.double.branch(peak.phi, peak.side)?, place)?.rho_pitch
                    - radius,
            )
        })
    }
}

/// Returns the cam with the same law on another base circle.
pub(super) fn with_base<N: Real>(disc: &Disc<N>, base: N) -> Option<Disc<N>> {
    let CamMotion::Law { program, .. } = &disc.motion else { return None };
    Some(Disc { motion: CamMotion::Law { base, program: program.clone() }, ..disc.clone() })
}
