//! The least base circle for an allowed pressure angle, by the s′–s diagram 类速度图解法.
//!
//! The follower is kept where it is, and a place C is sought for the centre of the cam. Let B be
//! the follower's point at a lift and I the instantaneous centre of cam and follower: the normal of
//! the contact is BI. With D on the line through B
//!
//! - D = B + s′ square to the lift, for a translating follower;
//! - D = P + (1 − ψ′)(B − P), for one that turns about P in the sense of the cam (1 + ψ′ against it),
//!
//! CD is parallel to BI. The pressure angle at this lift is therefore the angle at D between DC and
//! the direction of motion, and the places with at most an allowed angle are a wedge with its apex
//! at D. The wedges of all lifts have a convex region in common; its place nearest to B at the
//! start of the rise has the least base circle of the pitch curve.
//!
//! # Source
//! 孙桓等, 机械原理, ch. 9; G. Flocke, *Zur Konstruktion von Kurvengetrieben* (VDI-Forschungsheft
//! 345, 1931).

use super::{CamMotion, Disc, Follower, FollowerTip, PieceSide, stations};
use crate::geom::Vec2;
use std::f64::consts::FRAC_PI_2;

/// Samples of a turn, before those next to the angles that decide.
const SAMPLES: usize = 720;
/// Times that samples are added, each time this many times denser.
const ROUNDS: usize = 7;
const DENSER: usize = 8;
/// Greatest number of angles on each side that are considered closer.
const CRESTS: usize = 4;
/// A wedge farther from the place than this part of the size of the drawing cannot decide it.
const NEAR: f64 = 1e-3;

/// The greatest allowed pressure angles (rad), between 0 and 90°.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AllowedPressure {
    /// Angle allowed while the follower goes out.
    pub rise: f64,
    /// Angle allowed while it comes back.
    pub back: f64,
}

/// The state of the diagram at an angle of the cam, in the frame of the follower, with the origin at
/// the centre of the given cam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PressureWedge {
    /// The angle of the cam (rad).
    pub phi: f64,
    /// The follower's point B.
    pub at: Vec2,
    /// The apex D.
    pub apex: Vec2,
    /// Unit vector from the apex into the wedge: against the motion outward.
    pub inward: Vec2,
    /// The allowed pressure angle (rad).
    pub most: f64,
    /// True if the follower goes out.
    pub rising: bool,
}

impl PressureWedge {
    /// Returns the unit normals of both sides, away from the wedge; the first is that of the side to
    /// the left of the direction inward.
    pub fn sides(&self) -> [Vec2; 2] {
        let turn = FRAC_PI_2 + self.most;
        [turn, -turn].map(|turn| self.inward.rotate_by(Vec2::from_angle(turn)))
    }

    /// Returns how far a place is outside one of the sides (m).
    fn outside(&self, side: usize, place: Vec2) -> f64 {
        self.sides()[side].dot(place - self.apex)
    }

    /// Returns the pressure angle with the centre of the cam at a place (rad).
    pub fn pressure(&self, place: Vec2) -> f64 {
        let way = place - self.apex;
        libm::atan2(self.inward.cross(way).abs(), self.inward.dot(way))
    }
}

/// A centre of the cam with the least base circle.
#[derive(Clone, Debug, PartialEq)]
pub struct LeastCam {
    /// The place of the centre, in the frame of the follower, from the centre of the given cam (m).
    pub centre: Vec2,
    /// Radius of the base circle of the pitch curve 理论廓线基圆半径 (m).
    pub pitch_base: f64,
    /// The angles of the cam at which the pressure angle is the allowed one, with the side of the
    /// wedge.
    pub touched: Vec<(PressureWedge, usize)>,
    /// The cam on this centre, with the follower's end of the given one as a point: base circle and
    /// profile are those of the pitch curve.
    pub pitch: Disc,
}

impl LeastCam {
    /// Returns the radius of the base circle of the profile (m) for an end of this radius; it may be
    /// negative, if the end is larger than the base circle of the pitch curve.
    pub fn base(&self, end: f64) -> f64 {
        self.pitch_base - end
    }
}

/// The diagram of a cam by a law with a round end.
#[derive(Clone, Debug)]
pub struct PressureDiagram<'a> {
    disc: &'a Disc,
    /// The wedges at the sampled angles, in order.
    pub wedges: Vec<PressureWedge>,
}

impl<'a> PressureDiagram<'a> {
    /// Returns the diagram; `None` for a flat face, which has no pressure angle of this kind, and
    /// for a cam whose profile is given.
    pub fn of(disc: &'a Disc, allowed: AllowedPressure) -> Option<Self> {
        let CamMotion::Law { .. } = disc.motion else { return None };
        let FollowerTip::Point { .. } = disc.touch else { return None };
        let mut diagram = PressureDiagram { disc, wedges: Vec::new() };
        for (s, side) in stations(disc, SAMPLES) {
            diagram.wedges.extend(diagram.wedge(s.phi, side, allowed));
        }
        (!diagram.wedges.is_empty()).then_some(diagram)
    }

    /// Returns the follower's point at the start of the rise.
    pub fn start(&self) -> Vec2 {
        let CamMotion::Law { base, .. } = self.disc.motion else { return Vec2::ZERO };
        self.disc.follower.point(super::CamJet::constant(self.disc.rest(base))).order(0)
    }

    /// Returns the wedge at an angle; `None` in a dwell, in which nothing is pushed.
    fn wedge(&self, phi: f64, side: PieceSide, allowed: AllowedPressure) -> Option<PressureWedge> {
        let CamMotion::Law { program, .. } = &self.disc.motion else { return None };
        let (stage, ..) = program.stage(phi, side)?;
        let stage = &program.stages()[stage];
        stage.law()?;
        let rising = stage.gain() > 0.0;
        let q = self.disc.coordinate(phi, side)?;
        let [at, rate] = [0, 1].map(|order| self.disc.follower.point(q).order(order));
        let (apex, inward) = match self.disc.follower {
            // The rate of B by φ is s′ along the lift: square to it, in the sense of the cam.
            Follower::Translating { direction, .. } => {
                (at + rate.perp() * self.disc.sense, -direction)
            }
            Follower::Oscillating { pivot, sense, .. } => {
                let turned = q.0[1] * sense * self.disc.sense;
                let arm = at - pivot;
                // Where the arm turns faster than the cam, D is beyond P.
                let way = if turned > 1.0 { sense } else { -sense };
                (pivot + arm * (1.0 - turned), arm.perp().unit()? * way)
            }
        };
        let most = if rising { allowed.rise } else { allowed.back };
        Some(PressureWedge { phi, at, apex, inward, most, rising })
    }

    /// Returns the centre with the least base circle; with `offset` (m), the one at this distance
    /// from the path of a translating follower, positive to the right of the lift. `None` if no
    /// centre keeps the allowed angles.
    pub fn least(mut self, allowed: AllowedPressure, offset: Option<f64>) -> Option<LeastCam> {
        let start = self.start();
        let line = match (offset, self.disc.follower) {
            (None, _) => None,
            (Some(e), Follower::Translating { direction, .. }) => {
                Some((start + direction.perp() * e, -direction))
            }
            (Some(_), Follower::Oscillating { .. }) => return None,
        };
        let mut centre = nearest(&self.wedges, start, line)?;
        let mut step = std::f64::consts::TAU / SAMPLES as f64;
        for _ in 0..ROUNDS {
            let size = (centre - start).norm();
            let near: Vec<f64> =
                (0..2).flat_map(|side| crests(&self.wedges, side, centre, NEAR * size)).collect();
            step /= DENSER as f64;
            let around = |phi: &f64| {
                let phi = *phi;
                (-(DENSER as i32)..=DENSER as i32).map(move |k| phi + f64::from(k) * step)
            };
            let more: Vec<PressureWedge> = near
                .iter()
                .flat_map(around)
                .flat_map(|phi| {
                    [PieceSide::Before, PieceSide::After].map(|side| (super::in_turn(phi), side))
                })
                .filter_map(|(phi, side)| self.wedge(phi, side, allowed))
                .collect();
            self.wedges.extend(more);
            self.wedges.sort_by(|a, b| a.phi.total_cmp(&b.phi));
            centre = nearest(&self.wedges, start, line)?;
        }
        let size = (centre - start).norm();
        let on = |w: &PressureWedge, side: usize| w.outside(side, centre).abs() <= 1e-9 * size;
        let mut touched: Vec<(PressureWedge, usize)> = Vec::new();
        for w in &self.wedges {
            for side in 0..2 {
                let known = touched.iter().any(|(t, s)| {
                    *s == side && t.rising == w.rising && (t.phi - w.phi).abs() < 0.05
                });
                if on(w, side) && !known {
                    touched.push((*w, side));
                }
            }
        }
        let follower = match self.disc.follower {
            Follower::Translating { direction, .. } => {
                Follower::Translating { direction, offset: (centre - start).dot(direction.perp()) }
            }
            Follower::Oscillating { pivot, arm, sense } => {
                Follower::Oscillating { pivot: pivot - centre, arm, sense }
            }
        };
        let CamMotion::Law { program, .. } = &self.disc.motion else { return None };
        let motion = CamMotion::Law { base: size, program: program.clone() };
        let touch = FollowerTip::Point { radius: 0.0 };
        let pitch = Disc { follower, touch, motion, sense: self.disc.sense };
        Some(LeastCam { centre, pitch_base: size, touched, pitch })
    }

    /// Returns the part of a disc of this radius about a place that lies in all wedges, as the
    /// corners of a polygon (m).
    pub fn region(&self, about: Vec2, radius: f64) -> Vec<Vec2> {
        let corner = |x: f64, y: f64| about + Vec2::new(x, y) * radius;
        let mut polygon =
            vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        for w in &self.wedges {
            for side in 0..2 {
                polygon = clipped(&polygon, |p| w.outside(side, p));
            }
        }
        polygon
    }
}

/// Returns the angles at which a side of the wedges is a local maximum of the distance outside, if
/// it is not farther inside than `near`.
fn crests(wedges: &[PressureWedge], side: usize, place: Vec2, near: f64) -> Vec<f64> {
    let off = |k: usize| wedges.get(k).map_or(f64::NEG_INFINITY, |w| w.outside(side, place));
    let before = |k: usize| k.checked_sub(1).map_or(f64::NEG_INFINITY, off);
    let is_crest = |k: &usize| off(*k) > -near && off(*k) > before(*k) && off(*k) >= off(k + 1);
    let mut crests: Vec<usize> = (0..wedges.len()).filter(is_crest).collect();
    // Along a straight stretch rounding makes crests without end.
    crests.sort_by(|a, b| off(*b).total_cmp(&off(*a)));
    crests.into_iter().take(CRESTS).map(|k| wedges[k].phi).collect()
}

/// Returns the place of all wedges that is nearest to another place, on a line if there is one:
/// each side that is broken becomes the line on which the place is sought among those before it.
fn nearest(wedges: &[PressureWedge], to: Vec2, line: Option<(Vec2, Vec2)>) -> Option<Vec2> {
    let sides: Vec<(Vec2, Vec2)> =
        wedges.iter().flat_map(|w| w.sides().map(|n| (n, w.apex))).collect();
    if let Some(line) = line {
        return on_line(&sides, line, to);
    }
    let mut place = to;
    let slack = 1e-13 * wedges.iter().map(|w| (w.apex - to).norm()).fold(0.0, f64::max);
    for (k, &(normal, apex)) in sides.iter().enumerate() {
        if normal.dot(place - apex) > slack {
            let foot = to - normal * normal.dot(to - apex);
            place = on_line(&sides[..k], (foot, normal.perp()), to)?;
        }
    }
    Some(place)
}

/// Returns the place of a line that is nearest to another one and in all half-planes (outward
/// normal, a place of the edge).
fn on_line(sides: &[(Vec2, Vec2)], (through, along): (Vec2, Vec2), to: Vec2) -> Option<Vec2> {
    let [mut low, mut high] = [f64::NEG_INFINITY, f64::INFINITY];
    let mut size = 0.0f64;
    for &(normal, apex) in sides {
        let (slope, off) = (normal.dot(along), normal.dot(apex - through));
        size = size.max((apex - through).norm());
        // A side along the line either holds everywhere on it or nowhere.
        if slope.abs() <= 1e-15 {
            if off < -1e-12 * size {
                return None;
            }
        } else if slope > 0.0 {
            high = high.min(off / slope);
        } else {
            low = low.max(off / slope);
        }
    }
    if low > high + 1e-12 * size {
        return None;
    }
    Some(through + along * along.dot(to - through).max(low).min(high))
}

/// Returns the part of a convex polygon in which a function that is linear is not positive.
fn clipped(polygon: &[Vec2], off: impl Fn(Vec2) -> f64) -> Vec<Vec2> {
    let mut out = Vec::new();
    for (k, a) in polygon.iter().enumerate() {
        let b = polygon[(k + 1) % polygon.len()];
        let (here, there) = (off(*a), off(b));
        if here <= 0.0 {
            out.push(*a);
        }
        if here * there < 0.0 {
            out.push(*a + (b - *a) * (here / (here - there)));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cam::{CamSurvey, MotionLaw, Stage, StageMotion, StageProgram};

    fn program(law: MotionLaw, gain: f64) -> StageProgram {
        let stage = |way, degrees: f64| Stage { way, over: degrees.to_radians() };
        StageProgram::new(vec![
            stage(StageMotion::Rise(gain, law), 110.0),
            stage(StageMotion::Dwell, 70.0),
            stage(StageMotion::Return(gain, law), 90.0),
            stage(StageMotion::Dwell, 90.0),
        ])
    }

    fn translating(law: MotionLaw, sense: f64) -> Disc {
        let direction = Vec2::from_angle(1.3);
        Disc {
            follower: Follower::Translating { direction, offset: 0.01 },
            touch: FollowerTip::Point { radius: 0.008 },
            motion: CamMotion::Law { base: 0.05, program: program(law, 0.03) },
            sense,
        }
    }

    fn oscillating(law: MotionLaw, [sense, turn]: [f64; 2]) -> Disc {
        let pivot = Vec2::new(0.1, 0.02);
        Disc {
            follower: Follower::Oscillating { pivot, arm: 0.09, sense: turn },
            touch: FollowerTip::Point { radius: 0.008 },
            motion: CamMotion::Law { base: 0.05, program: program(law, 0.35) },
            sense,
        }
    }

    const ALLOWED: AllowedPressure = AllowedPressure { rise: 0.55, back: 1.1 };

    /// The part by which the greatest pressure angles of a survey exceed the allowed ones.
    fn excess(disc: &Disc) -> f64 {
        let survey = CamSurvey::of(disc);
        let [out, back] = survey.pressure.map(|p| p.map_or(f64::INFINITY, |(_, a)| a.abs()));
        (out - ALLOWED.rise).max(back - ALLOWED.back)
    }

    /// The pitch curve's cam with its centre at a place.
    fn centred(disc: &Disc, start: Vec2, centre: Vec2) -> Disc {
        let CamMotion::Law { program, .. } = &disc.motion else { panic!() };
        let follower = match disc.follower {
            Follower::Translating { direction, .. } => {
                Follower::Translating { direction, offset: (centre - start).dot(direction.perp()) }
            }
            Follower::Oscillating { pivot, arm, sense } => {
                Follower::Oscillating { pivot: pivot - centre, arm, sense }
            }
        };
        let base = (centre - start).norm();
        let motion = CamMotion::Law { base, program: program.clone() };
        Disc { follower, motion, touch: FollowerTip::Point { radius: 0.0 }, sense: disc.sense }
    }

    /// The pressure angles of the found cam, by the survey of its normals, are the allowed ones; no
    /// cam with its centre a little nearer keeps them, whatever the direction.
    #[test]
    fn no_smaller_cam_keeps_the_allowed_pressure_angle() {
        let laws = [MotionLaw::Harmonic, MotionLaw::Cycloidal, MotionLaw::Uniform];
        let translating = laws.iter().flat_map(|l| [1.0, -1.0].map(|s| translating(*l, s)));
        let senses = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
        let oscillating = senses.map(|s| oscillating(MotionLaw::Cycloidal, s));
        for disc in translating.chain(oscillating) {
            let diagram = PressureDiagram::of(&disc, ALLOWED).unwrap();
            let start = diagram.start();
            let found = diagram.least(ALLOWED, None).unwrap();
            let off = excess(&found.pitch);
            assert!(off.abs() < 1e-8, "{disc:?}: {off}");
            assert_eq!(centred(&disc, start, found.centre), found.pitch);
            let around = (0..72).map(|k| f64::from(k) * 5.0);
            for turn in around {
                let way = Vec2::from_angle(turn.to_radians()) * (found.pitch_base * (1.0 - 1e-4));
                let near = centred(&disc, start, start + way);
                let good = near.rest(found.pitch_base * (1.0 - 1e-4)).is_finite()
                    && (near
                        .follower
                        .point(super::super::CamJet::constant(
                            near.rest(found.pitch_base * (1.0 - 1e-4)),
                        ))
                        .order(0)
                        + way)
                        .norm()
                        < 1e-9;
                assert!(!good || excess(&near) > 0.0, "{disc:?} at {turn}°");
            }
        }
    }

    /// At constant velocity the wedges of the rise have their apices on one vertical: the least base
    /// circle is (h/Φ) cos [α], with the offset (h/Φ) cos² [α].
    #[test]
    fn closed_forms_at_constant_velocity() {
        let disc = translating(MotionLaw::Uniform, 1.0);
        let allowed = AllowedPressure { rise: 30f64.to_radians(), back: 85f64.to_radians() };
        let of = || PressureDiagram::of(&disc, allowed).unwrap();
        let rate = 0.03 / 110f64.to_radians();
        let found = of().least(allowed, None).unwrap();
        let (cos, tan) = (libm::cos(allowed.rise), libm::tan(allowed.rise));
        assert!((found.pitch_base - rate * cos).abs() < 1e-12, "{}", found.pitch_base / rate);
        let Follower::Translating { offset, .. } = found.pitch.follower else { panic!() };
        assert!((offset.abs() - rate * cos * cos).abs() < 1e-12, "{offset}");
        let central = of().least(allowed, Some(0.0)).unwrap();
        assert!((central.pitch_base - rate / tan).abs() < 1e-12, "{}", central.pitch_base);
    }

    /// With a given offset the base circle is that of the limit s₀ = max ((s′ − e)/tan [α] − s).
    #[test]
    fn a_given_offset_is_kept() {
        let disc = translating(MotionLaw::Harmonic, 1.0);
        let found =
            PressureDiagram::of(&disc, ALLOWED).unwrap().least(ALLOWED, Some(-0.01)).unwrap();
        assert!(excess(&found.pitch).abs() < 1e-8);
        let (h, over) = (0.03, 110f64.to_radians());
        let per = std::f64::consts::PI / over;
        let limit = |phi: f64| {
            let (s, rate) =
                (0.5 * h * (1.0 - libm::cos(per * phi)), 0.5 * h * per * libm::sin(per * phi));
            // The cam turns counter-clockwise: an offset to the left of the lift is on the far side.
            (rate + 0.01) / libm::tan(ALLOWED.rise) - s
        };
        let most = (0..=100_000).map(|k| limit(over * f64::from(k) / 1e5)).fold(0.0, f64::max);
        let radius = libm::sqrt(most * most + 1e-4);
        assert!((found.pitch_base - radius).abs() < 1e-9, "{} {radius}", found.pitch_base);
    }
}
