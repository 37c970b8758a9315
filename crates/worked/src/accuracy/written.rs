//! The pose as it is written, where `f64` cannot distinguish it from a singular one, or loses the
//! digits of the answers.
//!
//! Within some 1e-8 of a dead point or a limit (a pose by lengths, known in `f64` to the root of
//! its rounding), or within 1e-13 of it (a pose by coordinates), the loop equations must take a
//! pose for a singular one. Longer numbers hold lengths and coordinates as written, and a group
//! with pivots that are certainly not zero has one motion.

use super::rung::{Climb, Rung};
use hodograph_base::number::Real;
use hodograph_base::number::decimal::Certain;
use hodograph_mechanism::answer::{AnswerValue, evaluate};
use hodograph_mechanism::mechanism::{Demand, Mechanism};
use hodograph_mechanism::motion::{self, MotionNumber};
use hodograph_mechanism::position::{self, Configuration};
use hodograph_scene::{Find, PointPlace, Scene};

/// A pose that is not singular as written.
#[derive(Clone, Debug, PartialEq)]
pub struct Regular {
    /// The answer to each question, to `f64`; `None` if it has none.
    pub values: Vec<Option<AnswerValue>>,
    /// The rung that distinguished the pose from a singular one, or the one that gave the answers
    /// to the last digit of an `f64`.
    pub rung: Rung,
}

/// Returns the answers to some questions with the given demand, if on some rung every group
/// certainly has one motion. Returns `None` if the pose is singular as written, does not close, or
/// is not the written one but one to which the mechanism was followed.
pub fn regular(
    scene: &Scene,
    m: &Mechanism,
    demand: &Demand,
    at: &Configuration,
    questions: &[Find],
) -> Option<Regular> {
    let extent = at.extent();
    let given = |p: usize| match &scene.points[p].place {
        PointPlace::At([x, y]) => at.points[p].is_none_or(|here| {
            libm::hypot(here.x - x.value, here.y - y.value) <= SAME_POSE * extent
        }),
        PointPlace::Unknown | PointPlace::InLink { .. } | PointPlace::Polar { .. } => true,
    };
    if !(0..scene.points.len()).all(given) {
        return None;
    }
    let written = RungAnswers { scene, m, demand, at, questions, extent };
    let mut found = None;
    for rung in Rung::LADDER {
        let Some((values, known)) = rung.climb(&written) else { continue };
        found = Some(Regular { values, rung });
        if known {
            break;
        }
    }
    found
}

/// The distance, as a part of the mechanism's size, beyond which a pose is another one: near a
/// limit `f64` knows the pose to some 1e-8 of the size.
const SAME_POSE: f64 = 1e-6;

/// The part of an answer to which it must be known, to be the nearest `f64` within a unit in the
/// last place.
const KNOWN: f64 = f64::EPSILON / 2.0;

/// The part of the largest answer of its kind below which a possible zero is zero.
const NOTHING: f64 = 1e-30;

struct RungAnswers<'a> {
    scene: &'a Scene,
    m: &'a Mechanism,
    demand: &'a Demand,
    at: &'a Configuration,
    questions: &'a [Find],
    extent: f64,
}

impl Climb for RungAnswers<'_> {
    /// The answers, and `true` if all are known to the last digit.
    type Found = Option<(Vec<Option<AnswerValue>>, bool)>;

    fn with<N: Certain + MotionNumber>(&self) -> Self::Found {
        let at = position::recompute::<N>(self.scene, self.m, self.demand, self.at).ok()?;
        let near = |p: usize| match (at.points[p], self.at.points[p]) {
            (Some(there), Some(here)) => (there.approx() - here).norm() <= SAME_POSE * self.extent,
            _ => true,
        };
        if !(0..self.scene.points.len()).all(near) {
            return None;
        }
        let motion = motion::solve(self.scene, self.m, &at, self.demand);
        if !motion.singular.is_empty() {
            return None;
        }
        let answers: Vec<Option<AnswerValue<N>>> =
            self.questions.iter().map(|f| evaluate(self.scene, &at, &motion, &f.what)).collect();
        let form = |i: usize| answers[i].map(|v| v.form());
        let largest = |i: usize| {
            let of_kind = (0..answers.len()).filter(|k| form(*k) == form(i));
            of_kind.filter_map(|k| Some(approx(&answers[k]?).magnitude())).fold(0.0, f64::max)
        };
        let mut known = true;
        let mut values = Vec::with_capacity(answers.len());
        for (i, answer) in answers.iter().enumerate() {
            let nothing = NOTHING * largest(i);
            let mut number = |x: N, size: f64| {
                // A number that cannot be distinguished from zero has no sign and no digit.
                let zero = x.approx().abs() <= x.radius();
                known &= x.is_decided() && x.radius() <= if zero { nothing } else { KNOWN * size };
                if zero { 0.0 } else { x.approx() }
            };
            // The components of a vector are known relative to its length, other numbers each by
            // itself.
            values.push(answer.map(|value| match value {
                AnswerValue::Vector(v) => value.map(|x| number(x, v.approx().norm())),
                AnswerValue::Scalar(_) | AnswerValue::Point(_) => {
                    value.map(|x| number(x, x.approx().abs()))
                }
            }));
        }
        let decided = values.iter().flatten().all(|v| v.magnitude().is_finite());
        decided.then_some((values, known))
    }
}

fn approx<N: Real>(value: &AnswerValue<N>) -> AnswerValue {
    value.map(|x| x.approx())
}

/// Returns the groups that a question depends on.
pub fn groups_of_question(scene: &Scene, m: &Mechanism, find: &Find) -> Vec<usize> {
    let asked = Demand::of_questions(scene, m, [find]);
    (0..m.groups.len()).filter(|g| asked.groups[*g].is_some()).collect()
}
