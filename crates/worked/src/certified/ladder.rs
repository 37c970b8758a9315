//! The precision ladder: every answer as a ball, in `f64` first and in longer numbers as far as the
//! digits require it.
//!
//! The certificate is for the mathematics of the scene *as written*: positions by the closed forms
//! (or a proof of the root), motions group by group. Neither the drawing nor the loop equations
//! take part; their agreement is a separate statement.

use super::apart::apart;
pub use super::printed::AnswerPart;
use super::printed::with_printed;
use crate::accuracy::{Climb, Rung};
use crate::worked::{Outcome, Worked};
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::digits;
use hodograph_base::geom::Vec2;
use hodograph_base::lang::{say, tr};
use hodograph_base::number::Real;
use hodograph_base::number::decimal::{Certain, Enclosure};
use hodograph_board::construct::scale;
use hodograph_mechanism::answer::{AnswerValue, evaluate};
use hodograph_mechanism::mechanism::Demand;
use hodograph_mechanism::motion::MotionNumber;
use hodograph_mechanism::position::Configuration;
use hodograph_mechanism::{motion, position};
use hodograph_scene::{Kind, Lang, Scene};

/// A number with an interval that certainly contains it.
#[derive(Clone, Debug, PartialEq)]
pub struct CertifiedNumber {
    enclosure: Enclosure,
    /// True if it is zero, or so small a part of its reference size that it is printed as zero.
    pub zero: bool,
}

impl CertifiedNumber {
    pub(super) fn new(enclosure: Enclosure) -> CertifiedNumber {
        CertifiedNumber { enclosure, zero: false }
    }

    /// Returns the number, marked as zero if `zero` is true.
    pub(super) fn or_zero(self, zero: bool) -> CertifiedNumber {
        CertifiedNumber { zero, ..self }
    }

    /// Returns the number with at most `digits` significant digits, all of them true, in common
    /// notation, and the count of digits; `None` if not even one is certain.
    pub fn text(&self, digits: usize) -> Option<(String, usize)> {
        let (e, digits) = self.scientific(digits)?;
        Some((digits::plain(&e), digits))
    }

    /// Returns the number in e notation, and the count of digits.
    fn scientific(&self, digits: usize) -> Option<(String, usize)> {
        if self.zero {
            return Some(("0e0".into(), digits));
        }
        // An exact tie never resolves; with a digit or two more it is no tie.
        let more = [digits, digits + 1, digits + 2].into_iter();
        more.chain((1..digits).rev()).find_map(|k| self.enclosure.rounded(k).map(|e| (e, k)))
    }

    /// Returns true if all of `digits` are certain.
    pub(super) fn holds(&self, digits: usize, last: bool) -> bool {
        self.zero || self.enclosure.holds(digits) || (last && self.enclosure.holds(digits + 1))
    }

    /// Returns the number with at most `digits` true digits, in a unit 10^`shift` times smaller
    /// (millimetres for metres: 3).
    pub fn text_scaled(&self, digits: usize, shift: i32) -> Option<(String, usize)> {
        let (e, digits) = self.scientific(digits)?;
        let (mantissa, exponent) = e.split_once('e')?;
        let exponent: i32 = exponent.parse().ok()?;
        Some((
            digits::plain(&format!("{mantissa}e{}", if self.zero { 0 } else { exponent + shift })),
            digits,
        ))
    }

    /// Returns the sign: −1, 0 or 1.
    pub fn sign(&self) -> f64 {
        if self.zero { 0.0 } else { self.enclosure.approx.signum() }
    }

    /// Returns the interval.
    pub fn enclosure(&self) -> &Enclosure {
        &self.enclosure
    }
}

/// The certificate of one answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Certified {
    /// The rung that sufficed, or the last.
    pub rung: Rung,
    /// The numbers of the answer; empty if no rung gave any.
    pub parts: Vec<(AnswerPart, CertifiedNumber)>,
    /// The reading of the ruler on the drawing.
    pub reading: Option<CertifiedReading>,
    /// The reason why not all requested digits are certain; `None` if they are.
    pub why: Option<MissingDigits>,
}

/// A length on the drawing: the answer through its scale.
#[derive(Clone, Debug, PartialEq)]
pub struct CertifiedReading {
    /// The length on the polygon (mm).
    pub length_mm: CertifiedNumber,
    /// The arm of an angular rate, in the unit in which lengths are printed (m, or that of the
    /// book).
    pub arm: Option<CertifiedNumber>,
}

/// The number of digits to which readings are printed: one more than a ruler gives.
pub const READING_DIGITS: usize = 4;

/// The reason why digits are missing.
#[derive(Clone, Debug, PartialEq)]
pub enum MissingDigits {
    /// The rung has too few digits for this pose.
    TooClose,
    /// A tie, or a value that cannot be distinguished from zero, even in the longest numbers.
    Tie,
    /// The equations of these links may be singular.
    Singular(Both),
    /// The pose is singular, and the answer comes from the next order of the loop equations: in
    /// `f64` only, true to this many digits.
    NextOrder(usize),
    /// The answer has no value in this pose.
    NoValue,
    /// The answer has a value in `f64` only: one that depends on the profile of a cam.
    Double,
    /// The message of the position solver.
    Refused(Diagnostic),
}

impl MissingDigits {
    /// Returns the reason in words, for brackets after the number.
    pub fn words(&self, lang: Lang) -> String {
        match self {
            MissingDigits::TooClose => {
                tr!(lang, "the pose is too close to a dead centre for more").into()
            }
            MissingDigits::Tie => {
                tr!(lang, "the next digit is a tie, or the value cannot be told from zero").into()
            }
            MissingDigits::Singular(links) => {
                say!(lang, "the equations of links {} may be singular in this pose", links)
            }
            MissingDigits::NextOrder(_) => {
                tr!(lang, "singular pose, from the next order of the loop equations").into()
            }
            MissingDigits::NoValue => tr!(lang, "it has no value in this pose").into(),
            MissingDigits::Double => tr!(lang, "it is computed in double precision only").into(),
            MissingDigits::Refused(d) => say!(lang, "proof refused" => "{}", d.message),
        }
    }
}

impl Certified {
    /// Returns one of the answer's numbers.
    pub fn part(&self, part: AnswerPart) -> Option<&CertifiedNumber> {
        self.parts.iter().find(|(p, _)| *p == part).map(|(_, n)| n)
    }

    /// Returns the number of digits to which the `f64` value is printed if nothing is certified
    /// (two, or those that the next order of the loop equations is known to give), and `true` in
    /// the latter case.
    pub fn rough_digits(&self, digits: usize) -> (usize, bool) {
        match self.why {
            Some(MissingDigits::NextOrder(known)) => (digits.min(known), true),
            _ => (2, false),
        }
    }
}

/// The greatest number of digits that may be requested: the last rung has some 230, and a reader
/// needs no more than this.
pub const MOST_DIGITS: usize = 30;

/// Certifies every answer of a worked scene to `digits` significant digits (at most
/// [`MOST_DIGITS`]), climbing only for answers that require it.
pub fn certify(scene: &Scene, worked: &Worked, digits: usize) -> Vec<Certified> {
    let digits = digits.clamp(1, MOST_DIGITS);
    let bounded = scene.bounded();
    let scene = bounded.as_ref().unwrap_or(scene);
    let mut out: Vec<Certified> = worked
        .results
        .iter()
        .map(|_| Certified {
            rung: Rung::Double,
            parts: Vec::new(),
            reading: None,
            why: Some(MissingDigits::NoValue),
        })
        .collect();
    // Longer numbers do not help in a singular pose; if it is singular within the rounding of its
    // lengths, the ladder would give the motion of another pose.
    for (c, known) in
        out.iter_mut().zip(&worked.results).filter_map(|(c, r)| Some((c, r.next_order?)))
    {
        c.why = Some(MissingDigits::NextOrder(known));
    }
    let m = &worked.mechanism;
    let mut open: Vec<usize> = (0..out.len())
        .filter(|i| !matches!(out[*i].why, Some(MissingDigits::NextOrder(_))))
        .collect();
    for rung in Rung::LADDER {
        let last = rung == Rung::LAST;
        let find = |i: &usize| &scene.find[worked.results[*i].find];
        // Only the open answers, and only their groups: the other groups are neither placed nor
        // solved again.
        let demand = |open: &[usize]| Demand::of_questions(scene, m, open.iter().map(find));
        let look = |open: &[usize]| {
            rung.climb(&RungEvaluation { scene, worked, demand: &demand(open), open, digits })
        };
        let closes = |demand: &Demand| rung.climb(&Closes { scene, worked, demand });
        let seen = apart(&open, &look, &demand, &closes);
        for (i, seen) in open.iter().zip(seen) {
            let c = &mut out[*i];
            c.rung = rung;
            match seen {
                Ok((parts, reading)) => {
                    let mut read =
                        reading.iter().flat_map(|r| std::iter::once(&r.length_mm).chain(&r.arm));
                    let whole = parts.iter().all(|(_, n)| n.holds(digits, last))
                        && read.all(|n| n.holds(READING_DIGITS, last));
                    c.why = match whole {
                        true => None,
                        false if last => Some(MissingDigits::Tie),
                        false => Some(MissingDigits::TooClose),
                    };
                    (c.parts, c.reading) = (parts, reading);
                }
                Err(why) => c.why = Some(why),
            }
        }
        // A group that does not close on this rung may close on the next: an angle of many turns
        // uses up the short ones.
        open.retain(|i| out[*i].why.is_some());
        if open.is_empty() {
            break;
        }
    }
    // An answer that does not close as written, in the longest numbers, has no digits, whatever a
    // shorter rung gave.
    for c in &mut out {
        if let Some(MissingDigits::Refused(Diagnostic { code: "cannot-assemble", .. })) = c.why {
            (c.parts, c.reading) = (Vec::new(), None);
        }
    }
    out
}

/// The check that the groups of a demand close, in one kind of number.
struct Closes<'a> {
    scene: &'a Scene,
    worked: &'a Worked,
    demand: &'a Demand,
}

impl Climb for Closes<'_> {
    type Found = Result<(), Diagnostic>;

    fn with<N: Certain + MotionNumber>(&self) -> Self::Found {
        let placed = position::recompute::<N>(
            self.scene,
            &self.worked.mechanism,
            self.demand,
            &self.worked.configuration,
        );
        placed.map(drop).map_err(not_closed)
    }
}

/// The reason why a group does not close.
fn not_closed(faults: Faults) -> Diagnostic {
    faults.list.into_iter().next().unwrap_or_else(|| {
        Diagnostic::error("not-closed", both!("a group does not close in longer numbers"))
    })
}

/// The evaluation of some answers in one kind of number.
struct RungEvaluation<'a> {
    scene: &'a Scene,
    worked: &'a Worked,
    demand: &'a Demand,
    /// The answers, as indices of results.
    open: &'a [usize],
    digits: usize,
}

impl Climb for RungEvaluation<'_> {
    type Found = Result<Vec<CertifiedParts>, Diagnostic>;

    fn with<N: Certain + MotionNumber>(&self) -> Self::Found {
        let (scene, m) = (self.scene, &self.worked.mechanism);
        let at = position::recompute::<N>(scene, m, self.demand, &self.worked.configuration)
            .map_err(not_closed)?;
        let motion = motion::solve(scene, m, &at, self.demand);
        let seen = |i: &usize| {
            let r = &self.worked.results[*i];
            let find = &scene.find[r.find];
            match evaluate(scene, &at, &motion, &find.what) {
                Some(value) => parts(find.what.kind(), value, r.scale, self.digits)
                    .map(|list| none_of_nothing(is_nothing(r.noise, value), list))
                    .and_then(|list| with_printed(&scene.book, &find.what, value, list))
                    .map(|list| (list, reading(scene, &at, r, value))),
                None => Err(match motion.singular.first() {
                    Some(&g) => {
                        let names: Vec<_> =
                            m.groups[g].links.iter().map(|l| scene.link_name(*l)).collect();
                        MissingDigits::Singular(Both::names(&names))
                    }
                    None => MissingDigits::Double,
                }),
            }
        };
        Ok(self.open.iter().map(seen).collect())
    }
}

/// The parts of an answer, or the reason why it has none.
pub type AnswerParts = Result<Vec<(AnswerPart, CertifiedNumber)>, MissingDigits>;

/// The parts of an answer with the reading.
type CertifiedParts =
    Result<(Vec<(AnswerPart, CertifiedNumber)>, Option<CertifiedReading>), MissingDigits>;

/// True if an answer is certainly no more than the size that drawing and loop equations cannot
/// distinguish from zero next to the largest of its kind. A place has no such size: it is counted
/// from a chosen origin.
fn is_nothing<N: Certain>(noise: f64, value: AnswerValue<N>) -> bool {
    let size = match value {
        AnswerValue::Vector(v) => v.norm(),
        AnswerValue::Scalar(s) => s,
        AnswerValue::Point(_) => return false,
    };
    size.enclosure().is_some_and(|e| e.largest() <= noise)
}

/// The numbers of an answer, all zero if the answer is; a zero vector has no direction.
fn none_of_nothing(
    nothing: bool,
    mut list: Vec<(AnswerPart, CertifiedNumber)>,
) -> Vec<(AnswerPart, CertifiedNumber)> {
    if nothing {
        list.retain(|(part, _)| *part != AnswerPart::Direction);
        list.iter_mut().for_each(|(_, n)| n.zero = true);
    }
    list
}

/// The reading of the ruler: |v|/μ, or |ω| l/μ for an angular rate measured on a line of length l.
fn reading<N: Certain>(
    scene: &Scene,
    at: &Configuration<N>,
    r: &Outcome,
    value: AnswerValue<N>,
) -> Option<CertifiedReading> {
    let m = r.drawn.as_ref()?.measured.as_ref()?;
    let mu: N = scale::number(m.mu);
    let number = |x: N| x.enclosure().map(CertifiedNumber::new);
    let (size, arm) = match (value, m.arm_m) {
        (AnswerValue::Vector(v), None) => (v.norm(), None),
        (AnswerValue::Scalar(s), Some(_)) => {
            let (a, b) = m.arm_of?;
            let arm = at.points[a.0]?.distance(at.points[b.0]?);
            (s.magnitude() * arm, Some(arm))
        }
        _ => return None,
    };
    let mut length_mm = number(size / mu)?;
    // Less than a thousandth of a millimetre is no reading of a ruler; if the interval excludes
    // zero, it is given.
    length_mm.zero = length_mm.enclosure.contains_zero() && length_mm.enclosure.largest() < 1e-3
        || is_nothing(r.noise, value);
    Some(CertifiedReading {
        length_mm,
        arm: arm.and_then(|arm| number(scene.book.in_chosen(Kind::Length, arm))),
    })
}

/// Returns the numbers of one answer in their printed form; `scale` is the size against which it is
/// judged to be zero.
///
/// # Errors
/// An answer whose equations may be singular.
pub fn parts<N: Certain>(
    kind: Kind,
    value: AnswerValue<N>,
    scale: f64,
    digits: usize,
) -> AnswerParts {
    // Ten digits below the last requested one.
    let nothing = libm::exp10(-(digits as f64 + 10.0));
    let number = |x: N, against: f64| -> Result<CertifiedNumber, MissingDigits> {
        let enclosure = x.enclosure().ok_or(MissingDigits::TooClose)?;
        // Without a driver in motion nothing moves: a possible zero is zero.
        let zero = enclosure.contains_zero()
            && (against == 0.0 || enclosure.largest() <= nothing * against);
        Ok(CertifiedNumber { enclosure, zero })
    };
    match value {
        AnswerValue::Scalar(s) => {
            let mut list = vec![(AnswerPart::Scalar, number(s, scale)?)];
            if kind == Kind::Angle {
                list.push((AnswerPart::Degrees, number(s * N::from_f64(180.0) / N::pi(), 360.0)?));
            }
            Ok(list)
        }
        AnswerValue::Point(p) => {
            Ok(vec![(AnswerPart::X, number(p.x, scale)?), (AnswerPart::Y, number(p.y, scale)?)])
        }
        AnswerValue::Vector(v) => {
            let magnitude = number(v.norm(), scale)?;
            let size = magnitude.enclosure.approx;
            let mut list =
                vec![(AnswerPart::X, number(v.x, size)?), (AnswerPart::Y, number(v.y, size)?)];
            if magnitude.zero {
                for (_, n) in &mut list {
                    n.zero = true;
                }
            } else if let Some(direction) = direction_degrees(v) {
                let mut direction = number(direction, 1.0)?;
                // A direction is relative to the whole turn: one that is certainly below its last
                // decimal is zero.
                direction.zero = direction.enclosure.contains_zero()
                    && direction.enclosure.largest() <= libm::exp10(-(digits as f64 + 4.0));
                list.push((AnswerPart::Direction, direction));
            }
            list.push((AnswerPart::Magnitude, magnitude));
            Ok(list)
        }
    }
}

/// The direction of a vector in degrees, in (−180, 180], counted from the nearest axis, so that a
/// vector along an axis is known to be there. `None` if the vector may be zero.
fn direction_degrees<N: Real>(v: Vec2<N>) -> Option<N> {
    let quarter = libm::rint(v.approx().angle().to_degrees() / 90.0);
    let (x, y) = match quarter as i32 {
        0 => (v.x, v.y),
        1 => (v.y, -v.x),
        -1 => (-v.y, v.x),
        _ => (-v.x, -v.y),
    };
    let rest = y.atan2(x) * N::from_f64(180.0) / N::pi();
    if !rest.is_decided() {
        return None;
    }
    // Just beyond the half turn the count begins from the other side.
    let beyond = quarter.abs() == 2.0 && rest.approx() > 0.0 && rest.approx().abs() > rest.radius();
    let base = if beyond {
        -180.0
    } else if quarter == -2.0 {
        180.0
    } else {
        90.0 * quarter
    };
    Some(if base == 0.0 { rest } else { N::from_f64(base) + rest })
}
