//! A survey of a whole turn of a cam: strokes and their angles, extremes, shocks, least radius of
//! curvature, undercut and the base circle that avoids it.

use super::enclosed::with_base;
use super::least::{least_base, least_base_of};
use super::program::{Jump, Shock};
use super::turn::{DividedTurn, Ends, Peak, greatest, zero};
use super::{CamMotion, CamStation, Disc, FollowerTip, PieceSide, PreparedDisc};
use std::f64::consts::TAU;
use std::sync::{Arc, OnceLock};

/// A fault that keeps a cam from working as intended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// The profile crosses itself 运动失真: the least convex radius of the pitch curve is not more
    /// than the roller's radius, or a flat face would need a hollow.
    Undercut {
        /// The angle of the cam (rad).
        phi: f64,
        /// The radius of curvature of the pitch curve, or of the profile of a flat face (m).
        rho: f64,
        /// The least base circle that avoids the undercut (m), if there is one.
        least_base: Option<f64>,
    },
    /// The roller does not fit into a hollow of the profile.
    RollerTooLarge {
        /// The angle of the cam (rad).
        phi: f64,
        /// The radius of the hollow (m), negative.
        rho: f64,
    },
    /// The pressure angle exceeds the usual limit.
    Pressure {
        /// The angle of the cam (rad).
        phi: f64,
        /// The pressure angle (rad).
        angle: f64,
        /// The usual limit (rad).
        usual: f64,
        /// True if the follower goes out there.
        rising: bool,
    },
    /// The follower touches nothing there.
    NoContact {
        /// The angle of the cam (rad).
        phi: f64,
    },
}

/// An extreme of a quantity: the angle of the cam (rad) and the value.
pub type PhiExtreme = (f64, f64);

/// A part of the turn in which the follower goes out, rests, or comes back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FollowerPhase {
    /// +1 out, 0 at rest, −1 back.
    pub way: i8,
    /// Angle at which the phase begins (rad).
    pub from: f64,
    /// Angle at which the phase ends (rad); more than 2π if the phase passes the start of the turn.
    pub to: f64,
    /// True for a dwell with the follower out.
    pub out: bool,
}

/// The results of a whole turn.
#[derive(Clone, Debug, PartialEq)]
pub struct CamSurvey {
    /// The least coordinate of the follower, from which the lift is counted.
    pub rest: f64,
    /// The greatest lift h.
    pub stroke: f64,
    /// Rises, dwells and returns, in order from the first rise on.
    pub phases: Vec<FollowerPhase>,
    /// Angles at which s′ or s″ jumps.
    pub jumps: Vec<Jump>,
    /// Least and greatest s′.
    pub velocity: [PhiExtreme; 2],
    /// Least and greatest s″ between jumps.
    pub acceleration: [PhiExtreme; 2],
    /// Greatest magnitude of the pressure angle on the way out and on the way back; `None` for a
    /// flat face.
    pub pressure: [Option<PhiExtreme>; 2],
    /// The least convex radius of the pitch curve; for a flat face the least radius of the profile,
    /// negative if a hollow is needed.
    pub least_rho: Option<PhiExtreme>,
    /// The least radius of [`CamSurvey::least_rho`] with the side of a joint.
    pub sharpest: Option<Peak>,
    /// Least and greatest s′, least and greatest s″, with the side of a joint.
    pub fastest: [[Option<Peak>; 2]; 2],
    /// The greatest pressure angles, with the side of a joint.
    pub steepest: [Option<Peak>; 2],
    /// Least and greatest coordinate of the follower.
    pub ends: Option<[Peak; 2]>,
    /// Angles at which pieces of the law or of the profile meet.
    pub corners: Vec<f64>,
    /// The sharpest hollow: the greatest negative radius.
    pub hollow: Option<PhiExtreme>,
    /// The faults of the cam.
    pub faults: Vec<Fault>,
}

/// Rounding error of some ten operations, relative to the largest number among them.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// A change greater than this part of the largest value of its kind counts as a jump.
const JUMP: f64 = 1e-7;

/// The survey of one disc, computed on first use and shared by all copies. A part of a scene that
/// holds a disc keeps its survey beside it, since the disc is the same at every position of a
/// motion.
#[derive(Clone, Debug, Default)]
pub struct Surveyed(Arc<SurveyParts>);

/// The parts of a survey, each computed on first use.
#[derive(Debug, Default)]
struct SurveyParts {
    survey: OnceLock<CamSurvey>,
    least_base: OnceLock<Option<LeastBase>>,
}

/// The least base circle without undercut.
#[derive(Clone, Copy, Debug)]
pub(super) struct LeastBase {
    /// Its radius (m).
    pub base: f64,
    /// The least radius of the pitch curve or of the profile on it, see [`CamSurvey::sharpest`].
    pub sharpest: Option<Peak>,
}

/// The survey follows from the disc and adds no information: two of them compare equal.
impl PartialEq for Surveyed {
    fn eq(&self, _: &Surveyed) -> bool {
        true
    }
}

impl Surveyed {
    /// Returns the survey of the disc to which this value belongs.
    pub fn of(&self, disc: &Disc) -> &CamSurvey {
        self.0.survey.get_or_init(|| CamSurvey::of(disc))
    }

    /// Returns the least base circle of the disc; `None` as in [`least_base`].
    pub(super) fn least_base(&self, disc: &Disc) -> Option<LeastBase> {
        let found = || {
            // An undercut is told with it.
            let undercut = self.of(disc).faults.iter().find_map(|fault| match fault {
                Fault::Undercut { least_base, .. } => Some(*least_base),
                Fault::RollerTooLarge { .. } | Fault::Pressure { .. } | Fault::NoContact { .. } => {
                    None
                }
            });
            let base = undercut.unwrap_or_else(|| least_base(disc))?;
            let there = with_base(disc, base)?;
            let sharpest = sharpest(&DividedTurn::of(&PreparedDisc::of(&there)));
            Some(LeastBase { base, sharpest })
        };
        *self.0.least_base.get_or_init(found)
    }
}

impl CamSurvey {
    /// Surveys a whole turn.
    pub fn of(disc: &Disc) -> CamSurvey {
        let mut faults = Vec::new();
        let prepared = PreparedDisc::of(disc);
        let turn = DividedTurn::of(&prepared);
        let known: Vec<&CamStation> =
            turn.samples().filter_map(|(.., station)| station.as_ref()).collect();
        if let Some((phi, ..)) = turn.samples().find(|(.., station)| station.is_none()) {
            faults.push(Fault::NoContact { phi: *phi });
        }
        let most = |k: usize| known.iter().fold(0.0f64, |m, s| m.max(s.q.0[k].abs()));
        let (v_most, a_most) = (most(1), most(2));
        let peak = |k: usize, sign: f64| {
            let found = turn.best(&|s| Some([sign * s.q.0[k], sign * s.q.0[k + 1]]))?;
            Some(Peak { value: sign * found.value, ..found })
        };
        let fastest = [1, 2].map(|k| [-1.0, 1.0].map(|sign| peak(k, sign)));
        let extremes = |k: usize| fastest[k - 1].map(|p| p.map_or((0.0, 0.0), Peak::extreme));
        let ends = peak(0, -1.0).zip(peak(0, 1.0)).map(|(low, high)| [low, high]);
        let [low, high] = ends.map_or([0.0; 2], |ends| ends.map(|p| p.value));
        let rest = match &disc.motion {
            CamMotion::Law { base, .. } => disc.rest(*base),
            CamMotion::Profile(_) => low,
        };
        let jumps = jumps(&prepared, &turn.corners, [v_most, a_most]);
        let phases = phases(&turn, &known, v_most);
        let steepest = [1, -1].map(|way| match disc.touch {
            FollowerTip::Flat { .. } => None,
            FollowerTip::Point { .. } => {
                greatest_pressure(&turn, phases.iter().filter(|p| p.way == way))
            }
        });
        let sharpest = sharpest(&turn);
        let of_hollow = |s: &CamStation| Some([s.rho_pitch, s.rho_slope]).filter(|r| r[0] < 0.0);
        let hollow = turn.best(&of_hollow).map(Peak::extreme);
        let mut survey = CamSurvey {
            rest,
            stroke: high - rest,
            phases,
            jumps,
            velocity: extremes(1),
            acceleration: extremes(2),
            pressure: steepest.map(|p| p.map(Peak::extreme)),
            least_rho: sharpest.map(Peak::extreme),
            sharpest,
            fastest,
            steepest,
            ends,
            corners: turn.corners.clone(),
            hollow,
            faults,
        };
        survey.judge(disc, &turn);
        survey
    }

    /// Returns the lift and its derivatives at an angle; values within the rounding error of the
    /// follower's coordinate are zero.
    pub fn lift(&self, disc: &Disc, phi: f64, side: PieceSide) -> Option<[f64; 4]> {
        let mut q = disc.coordinate(phi, side)?.0;
        let (lift, rounding) = match &disc.motion {
            CamMotion::Law { program, .. } => {
                (program.lift(phi, side).value(), ROUNDING * self.stroke)
            }
            CamMotion::Profile(_) => {
                (q[0] - self.rest, ROUNDING * self.rest.abs().max(self.stroke))
            }
        };
        q[0] = lift;
        let most = [
            rounding,
            ROUNDING * self.greatest(&self.velocity),
            ROUNDING * self.greatest(&self.acceleration),
        ];
        q.iter_mut()
            .zip(most)
            .filter(|(x, rounding)| x.abs() <= *rounding)
            .for_each(|(x, _)| *x = 0.0);
        Some(q)
    }

    fn greatest(&self, [low, high]: &[PhiExtreme; 2]) -> f64 {
        low.1.abs().max(high.1.abs())
    }

    /// Collects the faults.
    fn judge(&mut self, disc: &Disc, turn: &DividedTurn) {
        let law = matches!(disc.motion, CamMotion::Law { .. });
        match disc.touch {
            FollowerTip::Point { radius } if law => {
                if let Some((phi, rho)) = self.least_rho.filter(|(_, rho)| *rho <= radius) {
                    self.faults.push(Fault::Undercut { phi, rho, least_base: least_base_of(turn) });
                }
            }
            FollowerTip::Flat { .. } if law => {
                if let Some((phi, rho)) = self.least_rho.filter(|(_, rho)| *rho <= 0.0) {
                    self.faults.push(Fault::Undercut { phi, rho, least_base: least_base_of(turn) });
                }
            }
            FollowerTip::Point { radius } => {
                if let CamMotion::Profile(segments) = &disc.motion
                    && let Some(rho) = segments
                        .iter()
                        .map(super::ProfileSegment::radius)
                        .find(|rho| *rho < 0.0 && -rho <= radius)
                {
                    let phi = self.hollow.map_or(0.0, |h| h.0);
                    self.faults.push(Fault::RollerTooLarge { phi, rho });
                }
            }
            FollowerTip::Flat { .. } => {}
        }
        // 孙桓: [α] = 30° for a translating follower, 45° for an oscillating one, 70° to 80° on the
        // return.
        let out = match disc.follower {
            super::Follower::Translating { .. } => 30.0f64,
            super::Follower::Oscillating { .. } => 45.0,
        };
        for (k, usual) in [out.to_radians(), 80.0f64.to_radians()].into_iter().enumerate() {
            if let Some((phi, angle)) = self.pressure[k].filter(|(_, angle)| angle.abs() > usual) {
                self.faults.push(Fault::Pressure { phi, angle, usual, rising: k == 0 });
            }
        }
    }

    /// Returns the sum of the angles of the phases of a kind: the rise Φ, the outer dwell Φs, the
    /// return Φ′, the inner dwell Φs′.
    pub fn angle(&self, way: i8, out: bool) -> f64 {
        self.phases_of(way, out).map(|p| p.to - p.from).sum()
    }

    /// Returns the phases of a kind.
    pub(super) fn phases_of(&self, way: i8, out: bool) -> impl Iterator<Item = &FollowerPhase> {
        self.phases.iter().filter(move |p| p.way == way && (way != 0 || p.out == out))
    }
}

/// Returns the pressure angle of the greatest magnitude in some phases; the start and the end of a
/// phase belong to it.
fn greatest_pressure<'p>(
    turn: &DividedTurn,
    phases: impl Iterator<Item = &'p FollowerPhase>,
) -> Option<Peak> {
    // A phase may pass the start of the turn.
    let corners: Vec<f64> =
        turn.corners.iter().copied().chain(turn.corners.iter().map(|c| c + TAU)).collect();
    let magnitude =
        |s: &CamStation| Some([s.pressure.abs(), s.pressure_slope * s.pressure.signum()]);
    let mut most = None;
    let mut any = false;
    for p in phases {
        let first = corners.partition_point(|c| *c <= p.from + 1e-10);
        let within = corners[first..].iter().copied().take_while(|c| *c < p.to - 1e-10);
        let mut from = p.from;
        for to in within.chain([p.to]) {
            let samples = turn.samples_of([from, to]);
            // The ends of a phase count as ends, with or without corners.
            most = greatest(turn.disc, &samples, Ends::Apart, &magnitude, most);
            (from, any) = (to, true);
        }
    }
    let found = most.or_else(|| any.then(|| turn.first(&magnitude)).flatten())?;
    turn.disc.station(found.phi, found.side).map(|s| Peak { value: s.pressure, ..found })
}

/// Returns the least convex radius of the pitch curve for a round end, the least radius of the
/// profile for a flat face.
pub(super) fn sharpest(turn: &DividedTurn) -> Option<Peak> {
    let found = turn.best(&|s| sharpness(turn.disc.disc().touch, s))?;
    Some(Peak { value: -found.value, ..found })
}

/// Returns the negative radius of curvature that counts for [`sharpest`], with its derivative.
pub(super) fn sharpness(touch: FollowerTip, s: &CamStation) -> Option<[f64; 2]> {
    let convex = match touch {
        FollowerTip::Point { .. } => s.rho_pitch > 0.0,
        FollowerTip::Flat { .. } => true,
    };
    (convex && s.rho_pitch.is_finite()).then_some([-s.rho_pitch, -s.rho_slope])
}

/// Returns the jumps of s′ and s″.
fn jumps(disc: &PreparedDisc, corners: &[f64], most: [f64; 2]) -> Vec<Jump> {
    let mut out = Vec::new();
    for &phi in corners {
        let sides = [PieceSide::Before, PieceSide::After].map(|side| disc.coordinate(phi, side));
        let [Some(before), Some(after)] = sides else { continue };
        for (k, shock) in [(1, Shock::Rigid), (2, Shock::Soft)] {
            let values = [before.0[k], after.0[k]];
            if (values[1] - values[0]).abs() > JUMP * most[k - 1] {
                out.push(Jump { phi, shock, sides: values });
                break;
            }
        }
    }
    out
}

/// Returns rises, dwells and returns, in order from the first rise.
fn phases(turn: &DividedTurn, known: &[&CamStation], v_most: f64) -> Vec<FollowerPhase> {
    let mut out: Vec<FollowerPhase> = Vec::new();
    let way =
        |s: &CamStation| if s.q.0[1].abs() <= JUMP * v_most { 0 } else { s.q.0[1].signum() as i8 };
    for window in known.windows(2) {
        let [a, b] = window else { continue };
        if b.phi <= a.phi {
            continue;
        }
        // The middle of the step determines the direction: at its ends the follower may rest for an
        // instant.
        let rate = 0.5 * (b.q.value() - a.q.value()) / (b.phi - a.phi);
        let here = if rate.abs() <= 0.1 * JUMP * v_most && way(a) == 0 && way(b) == 0 {
            0
        } else {
            rate.signum() as i8
        };
        match out.last_mut() {
            Some(last) if last.way == here => last.to = b.phi,
            _ => out.push(FollowerPhase { way: here, from: a.phi, to: b.phi, out: false }),
        }
    }
    // A phase across the start of the turn.
    if out.len() > 1
        && out[0].way == out[out.len() - 1].way
        && (turn.spans[0].0[0] + TAU - out[out.len() - 1].to).abs() < 1e-9
    {
        let last = out.pop().unwrap_or(out[0]);
        out[0].from = last.from - TAU;
    }
    // Reversals between samples are the zeros of the velocity.
    for k in 0..out.len() {
        let next = (k + 1) % out.len();
        if out[k].way * out[next].way == -1 {
            let at = turning(turn.disc, known, out[k].to);
            let shift = out[next].from - out[k].to;
            (out[k].to, out[next].from) = (at, at + shift);
        }
    }
    let first = out.iter().position(|p| p.way == 1).unwrap_or(0);
    out.rotate_left(first);
    let mut outside = false;
    for p in &mut out {
        if p.way != 0 {
            outside = p.way == 1;
        }
        p.out = p.way == 0 && outside;
        if p.from < -1e-12 {
            (p.from, p.to) = (p.from + TAU, p.to + TAU);
        }
    }
    out
}

/// Returns the zero of the velocity next to an angle, between the surrounding samples.
fn turning(disc: &PreparedDisc, known: &[&CamStation], near: f64) -> f64 {
    let reverses = |w: &&[&CamStation]| w[1].phi > w[0].phi && w[0].q.0[1] * w[1].q.0[1] <= 0.0;
    let k = known.partition_point(|s| s.phi < near);
    let before = known[..(k + 1).min(known.len())].windows(2).rev().find(reverses);
    let after = known[k..].windows(2).find(reverses);
    let off = |w: &&[&CamStation]| (w[0].phi - near).abs();
    let closest = before.into_iter().chain(after).min_by(|a, b| off(a).total_cmp(&off(b)));
    closest.map_or(near, |w| {
        let sign = if w[0].q.0[1] > 0.0 || w[1].q.0[1] < 0.0 { 1.0 } else { -1.0 };
        zero([w[0].phi, w[1].phi], |phi| {
            disc.coordinate(phi, PieceSide::After).map(|q| sign * q.0[1])
        })
    })
}
