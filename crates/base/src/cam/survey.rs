//! A whole turn of a cam: strokes and their angles, extremes, shocks, least radius of curvature, undercut and the base circle that avoids it.

use super::program::{Jump, Shock};
use super::{Disc, Motion, Side, Station, Touch};
use std::f64::consts::TAU;
use std::sync::{Arc, OnceLock};

/// Something that keeps a cam from working as it is meant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// The profile crosses itself 运动失真: the least convex radius of the pitch curve is not more than the roller's, or a flat face would need
    /// a hollow. With the place, the radius there (m) and the least base circle that avoids it, where there is one.
    Undercut {
        /// The angle of the cam (rad).
        phi: f64,
        /// The radius of curvature of the pitch curve, or of the profile of a flat face (m).
        rho: f64,
        /// Base circle (m).
        least_base: Option<f64>,
    },
    /// The roller does not go into a hollow of the profile: radius of the hollow (m, less than zero).
    RollerTooLarge {
        /// The angle of the cam (rad).
        phi: f64,
        /// The radius of the hollow (m).
        rho: f64,
    },
    /// The pressure angle is greater than is usual.
    Pressure {
        /// The angle of the cam (rad).
        phi: f64,
        /// The pressure angle (rad).
        angle: f64,
        /// What is usual (rad).
        usual: f64,
        /// Whether the follower goes out there.
        rising: bool,
    },
    /// Nothing is touched there.
    NoContact {
        /// The angle of the cam (rad).
        phi: f64,
    },
}

/// An extreme of a quantity: where and how much.
pub type Extreme = (f64, f64);

/// A piece of the turn in which the follower goes out, rests, or comes back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phase {
    /// +1 out, 0 at rest, −1 back.
    pub way: i8,
    /// From where to where (rad).
    pub from: f64,
    /// Where it ends (rad); more than 2π where it goes over the start.
    pub to: f64,
    /// Whether the follower is out, of a dwell.
    pub out: bool,
}

/// What a turn shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Survey {
    /// The least coordinate of the follower, from which the lift is counted.
    pub rest: f64,
    /// The greatest lift h.
    pub stroke: f64,
    /// Rises, dwells and returns, in order from the first rise on.
    pub phases: Vec<Phase>,
    /// Places where s′ or s″ jump.
    pub jumps: Vec<Jump>,
    /// Least and greatest s′.
    pub velocity: [Extreme; 2],
    /// Least and greatest s″ between jumps.
    pub acceleration: [Extreme; 2],
    /// Greatest magnitude of the pressure angle as the follower goes out and as it comes back; of a face none.
    pub pressure: [Option<Extreme>; 2],
    /// The least convex radius of the pitch curve (of the profile, for a flat face).
    pub least_rho: Option<Extreme>,
    /// The sharpest hollow: the greatest radius less than zero.
    pub hollow: Option<Extreme>,
    /// What does not work.
    pub faults: Vec<Fault>,
}

/// Samples between two corners.
const SAMPLES: usize = 240;
/// A jump is one of more than this part of the largest value of its kind.
const JUMP: f64 = 1e-7;

/// The survey of one disc, made when it is first asked for and shared by all copies. What of a scene holds a disc keeps one beside it: the
/// disc is the same at every position of a motion.
#[derive(Clone, Debug, Default)]
pub struct Surveyed(Arc<OnceLock<Survey>>);

/// It says nothing that the disc does not say.
impl PartialEq for Surveyed {
    fn eq(&self, _: &Surveyed) -> bool {
        true
    }
}

impl Surveyed {
    /// The survey of the disc beside which it stands.
    pub fn of(&self, disc: &Disc) -> &Survey {
        self.0.get_or_init(|| Survey::of(disc))
    }
}

impl Survey {
    /// Surveys a turn.
    pub fn of(disc: &Disc) -> Survey {
        let mut faults = Vec::new();
        let spans = spans(disc);
        let lift = |phi: f64, side: Side| disc.coordinate(phi, side);
        let samples: Vec<(f64, Side)> = spans.iter().flat_map(|s| sampled(*s)).collect();
        let known: Vec<Station> = samples.iter().filter_map(|(phi, side)| disc.station(*phi, *side)).collect();
        if let Some((phi, _)) = samples.iter().find(|(phi, side)| disc.station(*phi, *side).is_none()) {
            faults.push(Fault::NoContact { phi: *phi });
        }
        let most = |k: usize| known.iter().fold(0.0f64, |m, s| m.max(s.q.0[k].abs()));
        let (v_most, a_most) = (most(1), most(2));
        let extreme = |k: usize, sign: f64| {
            best(&spans, |phi, side| lift(phi, side).map(|q| sign * q.0[k])).map_or((0.0, 0.0), |(phi, v)| (phi, sign * v))
        };
        let rest = match &disc.motion {
            Motion::Law { base, .. } => disc.rest(*base),
            Motion::Profile(_) => extreme(0, -1.0).1,
        };
        let stroke = extreme(0, 1.0).1 - rest;
        let jumps = jumps(disc, [v_most, a_most]);
        let pressure = [1.0, -1.0].map(|way| match disc.touch {
            Touch::Flat { .. } => None,
            Touch::Point { .. } => greatest_pressure(disc, &spans, way, JUMP * v_most),
        });
        let least_rho = least_convex(disc, &spans);
        let hollow = best(&spans, |phi, side| disc.station(phi, side).map(|s| s.rho_pitch).filter(|r| *r < 0.0));
        let mut survey = Survey {
            rest,
            stroke,
            phases: phases(&known, &spans, v_most),
            jumps,
            velocity: [extreme(1, -1.0), extreme(1, 1.0)],
            acceleration: [extreme(2, -1.0), extreme(2, 1.0)],
            pressure,
            least_rho,
            hollow,
            faults,
        };
        survey.judge(disc);
        survey
    }

    /// The lift and its derivatives at an angle.
    pub fn lift(&self, disc: &Disc, phi: f64, side: Side) -> Option<[f64; 4]> {
        let mut q = disc.coordinate(phi, side)?.0;
        q[0] -= self.rest;
        Some(q)
    }

    /// Looks for what does not work.
    fn judge(&mut self, disc: &Disc) {
        let law = matches!(disc.motion, Motion::Law { .. });
        match disc.touch {
            Touch::Point { radius } if law => {
                if let Some((phi, rho)) = self.least_rho.filter(|(_, rho)| *rho <= radius) {
                    self.faults.push(Fault::Undercut { phi, rho, least_base: least_base(disc) });
                }
            }
            Touch::Flat { .. } if law => {
                let worst = self.hollow.map(|_| most_hollow(disc)).unwrap_or(self.least_rho.filter(|(_, rho)| *rho <= 0.0));
                if let Some((phi, rho)) = worst {
                    self.faults.push(Fault::Undercut { phi, rho, least_base: least_base(disc) });
                }
            }
            Touch::Point { radius } => {
                if let Motion::Profile(segments) = &disc.motion
                    && let Some(rho) = segments.iter().map(super::Segment::radius).find(|rho| *rho < 0.0 && -rho <= radius)
                {
                    let phi = self.hollow.map_or(0.0, |h| h.0);
                    self.faults.push(Fault::RollerTooLarge { phi, rho });
                }
            }
            Touch::Flat { .. } => {}
        }
        // 孙桓: [α] = 30° for a translating follower, 45° for an oscillating one, 70° to 80° on the return.
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

    /// The angle of the first phase of a kind: the rise Φ, the outer dwell Φs, the return Φ′, the inner dwell Φs′.
    pub fn angle(&self, way: i8, out: bool) -> f64 {
        self.phases.iter().filter(|p| p.way == way && (way != 0 || p.out == out)).map(|p| p.to - p.from).sum()
    }
}

/// A turn cut at its corners.
fn spans(disc: &Disc) -> Vec<[f64; 2]> {
    let mut at = disc.corners();
    if at.is_empty() {
        at.push(0.0);
    }
    at.dedup_by(|a, b| (*a - *b).abs() < 1e-10);
    let ends: Vec<f64> = at.iter().skip(1).copied().chain([at[0] + TAU]).collect();
    at.into_iter().zip(ends).map(|(a, b)| [a, b]).filter(|[a, b]| b - a > 1e-10).collect()
}

/// Angles through a span, its ends seen from within.
fn sampled([from, to]: [f64; 2]) -> impl Iterator<Item = (f64, Side)> {
    (0..=SAMPLES).map(move |k| match k {
        0 => (from, Side::After),
        SAMPLES => (to, Side::Before),
        k => (from + (to - from) * k as f64 / SAMPLES as f64, Side::After),
    })
}

/// The greatest value of a function, its place found by golden section between samples; ends count as they are seen from within.
fn best(spans: &[[f64; 2]], f: impl Fn(f64, Side) -> Option<f64>) -> Option<Extreme> {
    let mut most: Option<Extreme> = None;
    for span in spans {
        let samples: Vec<(f64, Option<f64>)> = sampled(*span).map(|(phi, side)| (phi, f(phi, side))).collect();
        for k in 0..samples.len() {
            let Some(here) = samples[k].1 else { continue };
            let beside = |j: Option<usize>| j.and_then(|j| samples.get(j)).and_then(|s| s.1);
            let (low, high) = (beside(k.checked_sub(1)), beside(Some(k + 1)));
            let top = low.is_some_and(|l| l <= here) && high.is_some_and(|h| h <= here);
            let found = if top {
                golden([samples[k - 1].0, samples[k + 1].0], |phi| f(phi, Side::After).unwrap_or(f64::NEG_INFINITY))
            } else {
                (samples[k].0, here)
            };
            let found = if found.1 >= here { found } else { (samples[k].0, here) };
            // The first of equals.
            if most.is_none_or(|m| found.1 > m.1 + 1e-13 * m.1.abs()) {
                most = Some(found);
            }
        }
    }
    most.map(|(phi, v)| (super::in_turn(phi), v))
}

/// The maximum of a function with one between the ends, by golden section, its last digits by a parabola through three points.
fn golden([mut a, mut b]: [f64; 2], f: impl Fn(f64) -> f64) -> Extreme {
    const PART: f64 = 0.618_033_988_749_894_9;
    let (mut c, mut d) = (b - PART * (b - a), a + PART * (b - a));
    let (mut fc, mut fd) = (f(c), f(d));
    for _ in 0..60 {
        if fc >= fd {
            (b, d, fd) = (d, c, fc);
            c = b - PART * (b - a);
            fc = f(c);
        } else {
            (a, c, fc) = (c, d, fd);
            d = a + PART * (b - a);
            fd = f(d);
        }
        // Below the root of the rounding values no longer tell the places apart.
        if b - a < 1e-4 {
            break;
        }
    }
    let m = 0.5 * (a + b);
    let h = 5e-4;
    let (low, here, high) = (f(m - h), f(m), f(m + h));
    let bend = low - 2.0 * here + high;
    let at = if bend < 0.0 { m + 0.5 * h * (low - high) / bend } else { m };
    let value = f(at);
    if value >= here { (at, value) } else { (m, here) }
}

/// The pressure angle of the greatest magnitude as the follower goes one way; where it sets out and where it arrives belong to its way.
fn greatest_pressure(disc: &Disc, spans: &[[f64; 2]], way: f64, rest: f64) -> Option<Extreme> {
    let rate = |s: &Station| way * s.q.0[1];
    let moves = |span: &&[f64; 2]| sampled(**span).filter_map(|(phi, side)| disc.station(phi, side)).any(|s| rate(&s) > rest);
    let moving: Vec<[f64; 2]> = spans.iter().filter(moves).copied().collect();
    let there = |phi: f64, side: Side| disc.station(phi, side).filter(|s| rate(s) >= -rest);
    let (phi, most) = best(&moving, |phi, side| there(phi, side).map(|s| s.pressure.abs()))?;
    // At a joint the side is that on which it is so great.
    let sides = [Side::After, Side::Before].into_iter().filter_map(|side| there(phi, side));
    sides.map(|s| s.pressure).min_by(|a, b| (a.abs() - most).abs().total_cmp(&(b.abs() - most).abs())).map(|angle| (phi, angle))
}

/// The least convex radius.
fn least_convex(disc: &Disc, spans: &[[f64; 2]]) -> Option<Extreme> {
    best(spans, |phi, side| disc.station(phi, side).map(|s| s.rho_pitch).filter(|r| r.is_finite() && *r > 0.0).map(|r| -r))
        .map(|(phi, v)| (phi, -v))
}

/// The deepest hollow that a flat face would need: the least radius.
fn most_hollow(disc: &Disc) -> Option<Extreme> {
    best(&spans(disc), |phi, side| disc.station(phi, side).map(|s| -s.rho)).map(|(phi, v)| (phi, -v))
}

/// The least base circle whose profile is not undercut, by bisection: radii of curvature grow with it.
fn least_base(disc: &Disc) -> Option<f64> {
    let Motion::Law { base, program } = &disc.motion else { return None };
    let with = |base: f64| Disc { motion: Motion::Law { base, program: program.clone() }, ..disc.clone() };
    let good = |base: f64| {
        let disc = with(base);
        let spans = spans(&disc);
        match disc.touch {
            Touch::Point { radius } => least_convex(&disc, &spans).is_none_or(|(_, rho)| rho >= radius),
            Touch::Flat { .. } => most_hollow(&disc).is_none_or(|(_, rho)| rho >= 0.0),
        }
    };
    let mut high = *base;
    for _ in 0..40 {
        high *= 1.5;
        if disc_holds(&with(high)) && good(high) {
            let mut low = *base;
            for _ in 0..44 {
                let middle = 0.5 * (low + high);
                if disc_holds(&with(middle)) && good(middle) { high = middle } else { low = middle }
            }
            return Some(high);
        }
    }
    None
}

/// Whether the follower reaches the base circle.
fn disc_holds(disc: &Disc) -> bool {
    match &disc.motion {
        Motion::Law { base, .. } => disc.rest(*base).is_finite(),
        Motion::Profile(_) => true,
    }
}

/// Where s′ or s″ jump.
fn jumps(disc: &Disc, most: [f64; 2]) -> Vec<Jump> {
    let mut out = Vec::new();
    for phi in disc.corners() {
        let sides = [Side::Before, Side::After].map(|side| disc.coordinate(phi, side));
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

/// Rises, dwells and returns, in the order of the first rise.
fn phases(known: &[Station], spans: &[[f64; 2]], v_most: f64) -> Vec<Phase> {
    let mut out: Vec<Phase> = Vec::new();
    let way = |s: &Station| if s.q.0[1].abs() <= JUMP * v_most { 0 } else { s.q.0[1].signum() as i8 };
    for window in known.windows(2) {
        let [a, b] = window else { continue };
        if b.phi <= a.phi {
            continue;
        }
        // The middle of the step tells its way: at its ends the follower may rest for an instant.
        let rate = 0.5 * (b.q.value() - a.q.value()) / (b.phi - a.phi);
        let here = if rate.abs() <= 0.1 * JUMP * v_most && way(a) == 0 && way(b) == 0 { 0 } else { rate.signum() as i8 };
        match out.last_mut() {
            Some(last) if last.way == here => last.to = b.phi,
            _ => out.push(Phase { way: here, from: a.phi, to: b.phi, out: false }),
        }
    }
    // Over the start.
    if out.len() > 1 && out[0].way == out[out.len() - 1].way && (spans[0][0] + TAU - out[out.len() - 1].to).abs() < 1e-9 {
        let last = out.pop().unwrap_or(out[0]);
        out[0].from = last.from - TAU;
    }
    // Reversals between samples: where the velocity passes through zero.
    for k in 0..out.len() {
        let next = (k + 1) % out.len();
        if out[k].way * out[next].way == -1 {
            let at = turning(known, out[k].to);
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

/// The zero of the velocity next to an angle, by one step of the secant through the samples around it.
fn turning(known: &[Station], near: f64) -> f64 {
    let around = known.windows(2).filter(|w| w[1].phi > w[0].phi && w[0].q.0[1] * w[1].q.0[1] <= 0.0);
    let closest = around.min_by(|a, b| (a[0].phi - near).abs().total_cmp(&(b[0].phi - near).abs()));
    closest.map_or(near, |w| {
        let (a, b) = (&w[0], &w[1]);
        // Newton's method with the exact derivatives from the nearer end.
        let s = if a.q.0[1].abs() < b.q.0[1].abs() { a } else { b };
        if s.q.0[2] == 0.0 { s.phi } else { (s.phi - s.q.0[1] / s.q.0[2]).max(a.phi).min(b.phi) }
    })
}
