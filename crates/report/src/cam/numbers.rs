//! Certified numbers of a cam: enclosed, and printed to as many digits as are certain.

use super::{DIGITS, Report};
use hodograph_base::cam::{
    CamExtreme, CamMotion, ExactCam, ExactDisc, Follower, FollowerTip, StageMotion, whole_turns,
};
use hodograph_base::digits::{legible, minus};
use hodograph_base::number::decimal::{Certain, Enclosure};
use hodograph_base::number::{Ball, Big, Real};
use hodograph_scene::{Kind, Scene, TurningCam};
use hodograph_worked::accuracy::{Climb, Rung};
use serde_json::{Value as Json, json};
use std::any::{Any, TypeId};
use std::cell::RefCell;
use std::collections::HashMap;
use std::sync::Arc;

/// A number of a cam.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CamNumber {
    /// Radius of the base circle.
    Base,
    /// Radius of a round end.
    End,
    /// Offset of a guide.
    Offset,
    /// Distance of the pivots.
    Distance,
    /// Length of the arm of an oscillating follower.
    Arm,
    /// Largest lift.
    Stroke,
    /// Total angle of all phases of a kind: direction of the follower's motion, and true for an
    /// outer dwell.
    Phase(i8, bool),
    /// Angle at the start of a stage of the law.
    Start(usize),
    /// Rise or return of a stage of the law.
    Gain(usize),
    /// Angle of an extreme.
    At(CamExtreme),
    /// Value of an extreme, rates by time; a pressure angle without its sign.
    Most(CamExtreme),
    /// Value of an extreme, rates by the cam angle.
    ByPhi(CamExtreme),
    /// Angle of a shock.
    JumpAt(usize),
    /// Rate before (0) or after (1) a shock, by time.
    Jump(usize, usize),
    /// [`CamNumber::Jump`] by the cam angle.
    JumpByPhi(usize, usize),
    /// Smallest radius of curvature of a concave part, without its sign.
    Hollow,
    /// Cam angle of the first contact with that concave part.
    HollowAt,
    /// Smallest base circle without undercut.
    LeastBase,
    /// A number at the instant.
    Now(Now),
}

/// A number at the instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Now {
    /// Cam angle.
    Phi,
    /// Lift, or its first or second time derivative.
    Lift(usize),
    /// Pressure angle.
    Pressure,
    /// Radius of curvature of the profile.
    Rho,
    /// Radius of curvature of the pitch curve.
    Pitch,
}

/// Unit of a printed number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PrintedUnit {
    /// SI unit.
    Si,
    /// Unit of lengths.
    Length,
    /// Degrees.
    Degrees,
    /// Unit of the follower's coordinate (0), of its rate (1) or of its second derivative (2).
    Lift(usize),
}

/// Returns an angle reduced to one turn from 0.
fn in_turn<N: Real>(angle: N) -> N {
    angle - whole_turns(libm::floor(angle.approx() / std::f64::consts::TAU + 1e-13))
}

impl CamNumber {
    /// Returns the number in SI; cam angles are reduced to one turn.
    fn of<N: Certain>(self, report: &Report, known: &KnownCam<N>) -> Option<N> {
        let turning = report.turning;
        let (phi, [w, a]) = (known.phi, known.rates);
        let cam = ExactCam::new(&turning.disc, &turning.survey, Arc::clone(&known.exact));
        let speed = |order: usize| (0..order).fold(N::from_f64(1.0), |s, _| s * w.magnitude());
        let disc = cam.disc();
        let program = || match &disc.motion {
            CamMotion::Law { program, .. } => Some(program),
            CamMotion::Profile(_) => None,
        };
        match self {
            CamNumber::Base => cam.base(),
            CamNumber::End => match disc.touch {
                FollowerTip::Point { radius } => Some(radius),
                FollowerTip::Flat { .. } => None,
            },
            CamNumber::Offset => match disc.follower {
                Follower::Translating { offset, .. } => {
                    Some(if disc.sense < 0.0 { -offset } else { offset })
                }
                Follower::Oscillating { .. } => None,
            },
            CamNumber::Distance | CamNumber::Arm => match disc.follower {
                Follower::Oscillating { pivot, .. } if self == CamNumber::Distance => {
                    Some(pivot.norm())
                }
                Follower::Oscillating { arm, .. } => Some(arm),
                Follower::Translating { .. } => None,
            },
            CamNumber::Stroke => cam.stroke(),
            CamNumber::Phase(way, out) => cam.angle(way, out),
            CamNumber::Start(k) => program()?.joints().get(k).copied(),
            CamNumber::Gain(k) => match program()?.stages().get(k)?.way {
                StageMotion::Rise(h, _) | StageMotion::Return(h, _) => Some(h),
                StageMotion::Dwell => None,
            },
            CamNumber::At(mark) => cam.mark(mark).map(|[place, _]| in_turn(place)),
            CamNumber::Most(mark) => {
                let [_, value] = cam.mark(mark)?;
                Some(match mark {
                    CamExtreme::Rate(_) => value * speed(1),
                    CamExtreme::Bend(_) => value * speed(2),
                    CamExtreme::Pressure(_) => value.magnitude(),
                    CamExtreme::Radius => value,
                })
            }
            CamNumber::ByPhi(mark) => cam.mark(mark).map(|[_, value]| value),
            CamNumber::JumpByPhi(k, side) => Some(cam.jump(k)?[1 + side]),
            CamNumber::Hollow => cam.hollow().map(|[_, rho]| -rho),
            CamNumber::HollowAt => cam.hollow().map(|[place, _]| in_turn(place)),
            CamNumber::JumpAt(k) => cam.jump(k).map(|j| in_turn(j[0])),
            CamNumber::Jump(k, side) => {
                let (jump, order) =
                    (cam.jump(k)?, turning.survey.of(&turning.disc).jumps[k].shock.order());
                Some(jump[1 + side] * speed(order))
            }
            CamNumber::LeastBase => cam.least_base(),
            CamNumber::Now(now) => at_the_instant(now, &cam, (turning, phi), [w, a]),
        }
    }

    /// Returns the numbers that are enclosed together with this one: those of all shocks that have
    /// this unit, of all stages, or this one alone. A cam is read once for all of them.
    fn together(self, unit: PrintedUnit, report: &Report) -> Vec<CamNumber> {
        let jumps = || report.survey.jumps.iter().enumerate();
        let stages = match &report.disc().motion {
            CamMotion::Law { program, .. } => program.stages().len(),
            CamMotion::Profile(_) => 0,
        };
        match self {
            CamNumber::JumpAt(_) => jumps().map(|(k, _)| CamNumber::JumpAt(k)).collect(),
            CamNumber::Jump(..) => jumps()
                .filter(|(_, j)| unit == PrintedUnit::Lift(j.shock.order()))
                .flat_map(|(k, _)| [0, 1].map(|side| CamNumber::Jump(k, side)))
                .collect(),
            CamNumber::JumpByPhi(..) => jumps()
                .flat_map(|(k, _)| [0, 1].map(|side| CamNumber::JumpByPhi(k, side)))
                .collect(),
            CamNumber::Start(_) => (0..=stages).map(CamNumber::Start).collect(),
            CamNumber::Gain(_) => (0..stages).map(CamNumber::Gain).collect(),
            CamNumber::Base
            | CamNumber::End
            | CamNumber::Offset
            | CamNumber::Distance
            | CamNumber::Arm
            | CamNumber::Stroke
            | CamNumber::Phase(..)
            | CamNumber::At(_)
            | CamNumber::Most(_)
            | CamNumber::ByPhi(_)
            | CamNumber::Hollow
            | CamNumber::HollowAt
            | CamNumber::LeastBase
            | CamNumber::Now(_) => vec![self],
        }
    }
}

fn at_the_instant<N: Real>(
    now: Now,
    cam: &ExactCam<N>,
    (turning, phi): (&TurningCam, N),
    [w, a]: [N; 2],
) -> Option<N> {
    let here = (turning.phi, turning.side);
    let station = || cam.station(here, phi);
    Some(match now {
        Now::Phi => in_turn(phi),
        Now::Lift(0) => cam.lift(here, phi)?,
        Now::Lift(1) => station()?.q.0[1] * w,
        Now::Lift(_) => {
            let [_, dq, ddq, _] = station()?.q.0;
            ddq * w * w + dq * a
        }
        Now::Pressure => station()?.pressure,
        Now::Rho => station()?.rho,
        Now::Pitch => station()?.rho_pitch,
    })
}

/// A cam in one kind of number at the instant: the disc, φ, and the rate and acceleration of φ.
struct KnownCam<N> {
    exact: Arc<ExactDisc<N>>,
    phi: N,
    rates: [N; 2],
}

/// The cam of a report in the kinds of number that its numbers need: the texts of a long law are
/// read once for each kind. Long numbers are not kept, since they have no meaning outside the work
/// in which they are made.
#[derive(Default)]
pub(super) struct KnownCams(RefCell<Vec<Box<dyn Any>>>);

impl KnownCams {
    fn of<N: Certain>(&self, scene: &Scene, turning: &TurningCam) -> Option<KnownCam<N>> {
        let copied = |known: &KnownCam<N>| KnownCam { exact: Arc::clone(&known.exact), ..*known };
        if let Some(known) = self.0.borrow().iter().find_map(|k| k.downcast_ref()) {
            return Some(copied(known));
        }
        let (cam, phi) = turning.exact::<N>(scene)?;
        let known = KnownCam { exact: cam.exact(), phi, rates: turning.rates_in(scene) };
        if TypeId::of::<N>() == TypeId::of::<Ball<Big>>() {
            return Some(known);
        }
        let out = copied(&known);
        self.0.borrow_mut().push(Box::new(known));
        Some(out)
    }
}

/// Numbers of a report, to be evaluated in any number format, in their unit.
struct EnclosedNumbers<'a, 'b> {
    report: &'b Report<'a>,
    which: &'b [CamNumber],
    unit: PrintedUnit,
}

impl Climb for EnclosedNumbers<'_, '_> {
    type Found = Vec<Option<Enclosure>>;

    fn with<N: Certain + hodograph_mechanism::motion::MotionNumber>(&self) -> Self::Found {
        let report = self.report;
        let Some(known) = report.exact.of::<N>(report.scene, report.turning) else {
            return vec![None; self.which.len()];
        };
        let one =
            |which: &CamNumber| report.in_unit(self.unit, which.of(report, &known)?).enclosure();
        self.which.iter().map(one).collect()
    }
}

/// A number of a report in its unit, and the digits for which it is enclosed.
type EnclosureRequest = (CamNumber, PrintedUnit, usize);

/// The numbers of a report that are enclosed.
pub(super) type KnownNumbers = RefCell<HashMap<EnclosureRequest, Option<Enclosure>>>;

/// Largest magnitude that counts as zero relative to the size of a cam.
const NOTHING: f64 = 1e-25;

/// The number formats tried, up to the longest: six digits of an extreme need no more.
const RUNGS: [Rung; 3] = [Rung::Double, Rung::DoubleDouble, Rung::Long(384)];

impl Report<'_> {
    /// Returns a number in the unit in which it is printed.
    fn in_unit<N: Real>(&self, unit: PrintedUnit, si: N) -> N {
        let book = &self.scene.book;
        match unit {
            PrintedUnit::Si => si,
            PrintedUnit::Degrees => si * N::from_f64(180.0) / N::pi(),
            PrintedUnit::Lift(0) if self.swings() => self.in_unit(PrintedUnit::Degrees, si),
            PrintedUnit::Length | PrintedUnit::Lift(0) => match book.chosen(Kind::Length) {
                Some(chosen) => chosen.of(si),
                None => {
                    si * N::from_f64(self.scene.length_unit.denominator)
                        / N::from_f64(self.scene.length_unit.numerator)
                }
            },
            PrintedUnit::Lift(order) => book.in_chosen(self.kind_of(order), si),
        }
    }

    /// Returns an interval around a number, narrow enough for `digits` digits if possible; `None`
    /// if there is no such number.
    pub fn enclosed(
        &self,
        which: CamNumber,
        unit: PrintedUnit,
        digits: usize,
    ) -> Option<Enclosure> {
        if let Some(known) = self.numbers.borrow().get(&(which, unit, digits)) {
            return known.clone();
        }
        let mut open = which.together(unit, self);
        if !open.contains(&which) {
            open.push(which);
        }
        for rung in RUNGS {
            let found = rung.climb(&EnclosedNumbers { report: self, which: &open, unit });
            let mut numbers = self.numbers.borrow_mut();
            let mut found = found.into_iter();
            open.retain(|which| {
                let last = numbers.entry((*which, unit, digits)).or_default();
                *last = found.next().flatten().or_else(|| last.take());
                !last.as_ref().is_some_and(|e| e.holds(digits))
            });
            if open.is_empty() {
                break;
            }
        }
        self.numbers.borrow().get(&(which, unit, digits)).cloned().flatten()
    }

    /// Returns a number to at most `digits` digits, all of them correct; `None` if no digit is
    /// certain.
    pub fn told(&self, which: CamNumber, unit: PrintedUnit, digits: usize) -> Option<String> {
        let e = self.enclosed(which, unit, digits)?;
        if e.contains_zero() {
            return (e.largest() <= NOTHING).then(|| "0".to_owned());
        }
        // An exact tie at one digit is resolved with one digit more.
        let all = [digits, digits + 1, digits + 2].into_iter().chain((1..digits).rev());
        all.into_iter().find_map(|k| e.rounded(k)).map(|text| hodograph_base::digits::plain(&text))
    }

    /// Returns [`Report::told`] to the digits of the report; if nothing is certain, the approximate
    /// value from double precision.
    pub(super) fn digits(&self, which: CamNumber, unit: PrintedUnit, rough_si: f64) -> String {
        self.told(which, unit, DIGITS).map_or_else(
            || format!("≈ {}", legible(self.in_unit(unit, rough_si), 2)),
            |text| minus(&text),
        )
    }

    /// Returns the nearest double of a number in SI, as JSON; the value of double precision if it
    /// is not enclosed.
    pub(super) fn nearest(&self, which: CamNumber, rough: f64) -> Json {
        // Longer numbers have no infinity: the radius of a straight flank is not climbed for.
        if !rough.is_finite() {
            return Json::Null;
        }
        let told = self
            .enclosed(which, PrintedUnit::Si, 17)
            .filter(|e| e.radius <= 1e-15 * e.approx.abs().max(NOTHING));
        let value = told.map_or(rough, |e| if e.contains_zero() { 0.0 } else { e.approx });
        if value.is_finite() { json!(value) } else { Json::Null }
    }
}
