//! What double precision keeps of the answers in a pose that is nearly singular: measured against longer numbers, not estimated.
//!
//! The loss depends on how the pose is written: coordinates along an axis keep all digits next to a dead centre, the same turned by
//! an angle keep few, and accelerations may cancel. No condition number tells that.

use super::agreement::{Agreement, compare};
use super::written::{Regular, regular};
use hodograph_analytic::{Near, Solution};
use hodograph_base::diag::{Diagnostic, both};
use hodograph_base::digits::significant;
use hodograph_mechanism::answer::Value;
use hodograph_mechanism::mechanism::{Demand, Level, Mechanism};
use hodograph_mechanism::position::Configuration;
use hodograph_scene::Scene;

/// How many digits text answers print unless more are asked for; where fewer are kept, a warning is due.
const PRINTED: f64 = 6.0;

/// The answers of longer numbers, and how far the loop equations are from them.
#[derive(Clone, Debug, PartialEq)]
pub struct Kept {
    /// The answers.
    pub truth: Regular,
    /// For each question how far the loop equations are off, or the drawing where that is more, relative as
    /// [`Agreement::difference`]; `None` for positions.
    pub errors: Vec<Option<f64>>,
    /// The same of the loop equations alone.
    computed: Vec<Option<f64>>,
}

/// What there is to be measured: the two ways, and the size against which an answer is judged.
pub struct Ways<'a, S> {
    /// The loop equations.
    pub solution: &'a Solution,
    /// What was read off the paper, for each question.
    pub drawn: &'a [Option<Value>],
    /// The size of what an answer of a level is measured against.
    pub scale: S,
}

/// Measures what the two ways keep of a scene's answers; `None` where no rung of the ladder has them all. `truth`: the answers, where
/// they are known already.
pub fn kept<S: Fn(Level, &Value) -> f64>(
    scene: &Scene,
    (m, demand): (&Mechanism, &Demand),
    at: &Configuration,
    ways: &Ways<S>,
    truth: Option<Regular>,
) -> Option<Kept> {
    let truth = truth.or_else(|| regular(scene, m, demand, at, &scene.find))?;
    let error = |i: usize, value: Option<Value>| {
        let (level, true_value) = (scene.find[i].what.level(), truth.values[i]?);
        (level > Level::Position).then_some(compare(value?, true_value, (ways.scale)(level, &true_value), 1.0).difference)
    };
    let computed: Vec<Option<f64>> =
        (0..scene.find.len()).map(|i| error(i, ways.solution.answer(scene, at, &scene.find[i].what))).collect();
    let errors = (0..scene.find.len()).map(|i| computed[i].into_iter().chain(error(i, ways.drawn[i])).reduce(f64::max)).collect();
    Some(Kept { truth, errors, computed })
}

impl Kept {
    /// What the agreement of a question's two ways promises: no more than what the loop equations keep of it.
    pub fn promised(&self, question: usize, agreement: Agreement) -> Agreement {
        let off = self.errors[question].unwrap_or(0.0);
        Agreement { bound: agreement.bound.max(2.0 * off), ..agreement }
    }

    /// Whether double precision has lost an answer: the loop equations are farther off than any agreement may promise, or the
    /// drawing is, by what its crossings explain.
    pub fn lost(&self, question: usize, agreement: Option<Agreement>) -> bool {
        let off = self.computed[question].is_some_and(|e| e.is_nan() || e > Agreement::MOST);
        off || agreement.is_some_and(|a| !a.holds() && a.difference <= a.bound)
    }

    /// What is said of the pose where all answers are kept: of how many digits.
    pub fn note(&self, near: &Near, condition: f64) -> Diagnostic {
        let worst = self.errors.iter().flatten().copied().fold(f64::EPSILON, f64::max);
        let digits = (-libm::log10(worst)).floor();
        let said = both!(
            "{} but for a hair: the condition number is {}; double precision keeps about {digits} digits of the answers, in the drawing and in the loop equations",
            "几乎是{}：条件数为 {}；作图和封闭矢量方程（解析法）用双精度约保留结果的 {digits} 位数字",
            near.words,
            significant(condition, 2)
        );
        if digits < PRINTED {
            Diagnostic::warning("near-singular", said).help(both!(
                "choose a pose further off; the certified digits are those of longer numbers",
                "请取离该位置较远的位置；已验证的数字由高精度计算得到"
            ))
        } else {
            Diagnostic::note("near-singular", said)
        }
    }
}

/// What is said where nothing but an estimate is at hand; nothing where it leaves the digits that are printed.
pub fn estimated(near: &Near, condition: f64) -> Option<Diagnostic> {
    let digits = (-libm::log10(10.0 * near.loss)).floor();
    let left = if digits < 1.0 { both!("no digit", "不到一位") } else { both!("about {digits} digits", "约 {digits} 位") };
    (digits < PRINTED).then(|| {
        Diagnostic::warning(
            "near-singular",
            both!(
                "{} but for a hair: the condition number is {}, and double precision may keep {} of the velocities there in the drawing and in the loop equations, fewer of the accelerations",
                "几乎是{}：条件数为 {}；作图和封闭矢量方程（解析法）用双精度，速度可能只保留{}数字，加速度更少",
                near.words,
                significant(condition, 2),
                left
            ),
        )
        .help(both!("choose a pose further off", "请取离该位置较远的位置"))
    })
}
