//! The digits that double precision keeps of the answers in a nearly singular pose: measured
//! against longer numbers, not estimated.
//!
//! The loss depends on the notation of the pose: coordinates along an axis keep all digits next to
//! a dead centre, the same coordinates turned by an angle keep few, and accelerations may cancel.
//! No condition number shows that.

use super::agreement::{Agreement, compare};
use super::written::{Regular, regular};
use hodograph_analytic::{NearSingular, Solution};
use hodograph_base::diag::{Diagnostic, both};
use hodograph_base::digits::significant;
use hodograph_mechanism::answer::AnswerValue;
use hodograph_mechanism::mechanism::{Demand, Level, Mechanism};
use hodograph_mechanism::position::Configuration;
use hodograph_scene::Scene;

/// The number of digits that text answers print by default; if fewer are kept, a warning is due.
const PRINTED: f64 = 6.0;

/// The answers of longer numbers, and the errors of the loop equations relative to them.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptDigits {
    /// The answers of longer numbers.
    pub truth: Regular,
    /// The error of the loop equations for each question, or that of the drawing if it is greater,
    /// relative as [`Agreement::difference`]; `None` for positions.
    pub errors: Vec<Option<f64>>,
    /// The error of the loop equations alone.
    computed: Vec<Option<f64>>,
}

/// The two ways to measure, and the size against which an answer is judged.
pub struct ComparedMethods<'a, S> {
    /// The solution of the loop equations.
    pub solution: &'a Solution,
    /// The values read off the paper, for each question.
    pub drawn: &'a [Option<AnswerValue>],
    /// The function that returns the reference size for an answer of a level.
    pub scale: S,
}

/// Measures the digits that the two ways keep of a scene's answers; `None` if no rung of the ladder
/// has them all. `truth` are the answers, if they are known already.
pub fn kept<S: Fn(Level, &AnswerValue) -> f64>(
    scene: &Scene,
    (m, demand): (&Mechanism, &Demand),
    at: &Configuration,
    ways: &ComparedMethods<S>,
    truth: Option<Regular>,
) -> Option<KeptDigits> {
    let truth = truth.or_else(|| regular(scene, m, demand, at, &scene.find))?;
    let error = |i: usize, value: Option<AnswerValue>| {
        let (level, true_value) = (scene.find[i].what.level(), truth.values[i]?);
        (level > Level::Position).then_some(
            compare(value?, true_value, (ways.scale)(level, &true_value), 1.0).difference,
        )
    };
    let computed: Vec<Option<f64>> = (0..scene.find.len())
        .map(|i| error(i, ways.solution.answer(scene, at, &scene.find[i].what)))
        .collect();
    let errors = (0..scene.find.len())
        .map(|i| computed[i].into_iter().chain(error(i, ways.drawn[i])).reduce(f64::max))
        .collect();
    Some(KeptDigits { truth, errors, computed })
}

impl KeptDigits {
    /// Limits the agreement of a question's two ways to the digits that they were measured to keep.
    pub fn promised(&self, question: usize, agreement: Agreement) -> Agreement {
        let off = self.errors[question].unwrap_or(0.0);
        Agreement { bound: agreement.bound.max(2.0 * off), ..agreement }
    }

    /// Returns true if double precision has lost an answer: the loop equations are farther off than
    /// any agreement allows, or the drawing is, by as much as its crossings explain.
    pub fn lost(&self, question: usize, agreement: Option<Agreement>) -> bool {
        let off = self.computed[question].is_some_and(|e| e.is_nan() || e > Agreement::MOST);
        off || agreement.is_some_and(|a| !a.holds() && a.difference <= a.bound)
    }

    /// Returns the note of a pose in which all answers are kept, with the number of their digits.
    pub fn note(&self, near: &NearSingular, condition: f64) -> Diagnostic {
        let worst = self.errors.iter().flatten().copied().fold(f64::EPSILON, f64::max);
        let digits = (-libm::log10(worst)).floor();
        let said = both!(
            "{} but for a hair: the condition number is {}; double precision keeps about {digits} digits of the answers, in the drawing and in the loop equations",
            near.words,
            significant(condition, 2)
        );
        if digits < PRINTED {
            Diagnostic::warning("near-singular", said).help(both!(
                "choose a pose further off; the certified digits are those of longer numbers"
            ))
        } else {
            Diagnostic::note("near-singular", said)
        }
    }
}

/// Returns the warning if only an estimate is available; `None` if the estimate leaves the digits
/// that are printed.
pub fn estimated(near: &NearSingular, condition: f64) -> Option<Diagnostic> {
    let digits = (-libm::log10(10.0 * near.loss)).floor();
    let left = if digits < 1.0 { both!("no digit") } else { both!("about {digits} digits") };
    (digits < PRINTED).then(|| {
        Diagnostic::warning(
            "near-singular",
            both!(
                "{} but for a hair: the condition number is {}, and double precision may keep {} of the velocities there in the drawing and in the loop equations, fewer of the accelerations",
                near.words,
                significant(condition, 2),
                left
            ),
        )
        .help(both!("choose a pose further off"))
    })
}
