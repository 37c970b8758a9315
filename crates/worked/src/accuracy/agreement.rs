//! The agreement of drawing and analysis, question by question.

use hodograph_mechanism::answer::AnswerValue;
use hodograph_scene::quantity::ValueForm;

/// The comparison of one question's two answers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement {
    /// The difference of the two, relative to the answer, or to a thousandth of the largest vector
    /// of its polygon if the answer is smaller than that (an answer of zero has no relative error).
    pub difference: f64,
    /// The difference to expect in double precision: 1e-11 for well-conditioned scenes, more with
    /// crossings under bad angles.
    pub bound: f64,
    /// The value (SI) up to which an answer cannot be distinguished from zero: the rounding of the
    /// largest vector is as large.
    pub noise: f64,
}

impl Agreement {
    /// The greatest difference at which two ways still agree: the digits to which answers are
    /// printed. Beyond that rounding explains no agreement, but a loss of both.
    pub const MOST: f64 = 1e-6;

    /// Widens the bound for loop equations that may be off by `loss`, relative, in a single
    /// operation.
    pub fn no_better_than(self, loss: f64) -> Agreement {
        Agreement { bound: self.bound.max(STEPS * loss), ..self }
    }

    /// Returns true if rounding explains the difference; if not, the error is in the program.
    pub fn holds(&self) -> bool {
        self.difference <= self.bound.min(Agreement::MOST)
    }
}

/// The bound for well-conditioned scenes.
const WELL_CONDITIONED: f64 = 1e-11;

/// The units in the last place that a handful of operations per step may lose, before the crossings
/// magnify them.
const STEPS: f64 = 32.0;

/// The effect of those operations on a value, relative to the largest of its kind: smaller values
/// cannot be distinguished from zero.
pub const ROUNDING: f64 = STEPS * f64::EPSILON;

/// Compares two values of one question.
///
/// `scale` is the largest vector (or rate) of its level; `magnification` is the factor by which the
/// worst crossing magnifies rounding there (see
/// [`hodograph_board::construct::PlanDrawing::magnified`]).
pub fn compare(
    drawn: AnswerValue,
    computed: AnswerValue,
    scale: f64,
    magnification: f64,
) -> Agreement {
    let difference = drawn.apart(&computed).unwrap_or(f64::INFINITY);
    // A place is counted from a chosen origin: its distance from there has no relation to its
    // error.
    let least = if computed.form() == ValueForm::Point { scale } else { scale * 1e-3 };
    let reference = computed.magnitude().max(least);
    let difference = if difference == 0.0 { 0.0 } else { difference / reference };
    Agreement {
        difference,
        bound: WELL_CONDITIONED.max(STEPS * f64::EPSILON * magnification),
        noise: ROUNDING * scale,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hodograph_base::geom::Point;

    #[test]
    fn zero_answers_are_judged_by_their_polygon() {
        let a = compare(AnswerValue::Scalar(1e-15), AnswerValue::Scalar(0.0), 1.0, 1.0);
        assert!(a.holds() && (a.difference - 1e-12).abs() < 1e-20);
        assert!(
            !compare(AnswerValue::Scalar(1.0), AnswerValue::Scalar(1.0 + 1e-9), 1.0, 10.0).holds()
        );
        // Without a common digit there is no agreement, for any crossing.
        assert!(!compare(AnswerValue::Scalar(1.0), AnswerValue::Scalar(1.1), 1.0, 1e18).holds());
        assert!(
            !compare(AnswerValue::Scalar(f64::NAN), AnswerValue::Scalar(1.0), 1.0, 10.0).holds()
        );
    }

    #[test]
    fn places_agree_by_their_distance() {
        let agree = |off: f64| {
            let (a, b) = (
                AnswerValue::Point(Point::new(1e-9, off)),
                AnswerValue::Point(Point::new(1e-9, 0.0)),
            );
            compare(a, b, 0.5, 1.0)
        };
        // A place near the origin is as certain as elsewhere.
        assert!(agree(1e-13).holds() && !agree(1e-10).holds());
        assert_eq!(agree(1e-3).difference, 2e-3);
        assert!(
            !compare(AnswerValue::Point(Point::ORIGIN), AnswerValue::Scalar(0.0), 1.0, 1.0).holds()
        );
    }
}
