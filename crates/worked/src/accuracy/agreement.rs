//! Drawing against analysis, question by question.

use hodograph_mechanism::answer::Value;
use hodograph_scene::quantity::Form;

/// How one question's two answers compare.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement {
    /// Difference of the two, relative to the answer, or to a thousandth of the largest vector of its polygon where the
    /// answer is smaller than that (an answer of zero has no relative error).
    pub difference: f64,
    /// What double precision lets one expect: 1e-11 for well-conditioned scenes, more where crossings lie under bad angles.
    pub bound: f64,
    /// A value of no more than this (SI) cannot be told from zero: rounding of the largest vector makes as much.
    pub noise: f64,
}

impl Agreement {
    /// The most that two ways may differ by and still be said to agree: the digits that answers are printed to. What rounding
    /// explains beyond that is no agreement but a loss of both.
    pub const MOST: f64 = 1e-6;

    /// The same where the loop equations themselves may be off by as much as `loss`, relative, in a single operation.
    pub fn no_better_than(self, loss: f64) -> Agreement {
        Agreement { bound: self.bound.max(STEPS * loss), ..self }
    }

    /// Whether the difference is within what rounding explains; if not, the error is ours.
    pub fn holds(&self) -> bool {
        self.difference <= self.bound.min(Agreement::MOST)
    }
}

/// Well-conditioned scenes agree to this.
const WELL_CONDITIONED: f64 = 1e-11;

/// Units in the last place that a handful of operations per step may lose, before the crossings magnify them.
const STEPS: f64 = 32.0;

/// What those operations make of a value, relative to the largest of its kind: less than that cannot be told from zero.
pub const ROUNDING: f64 = STEPS * f64::EPSILON;

/// Compares two values of one question.
///
/// `scale` is the largest vector (or rate) of its level; `magnification` is by how much the worst crossing magnifies
/// rounding there (see [`hodograph_board::construct::Drawing::magnified`]).
pub fn compare(drawn: Value, computed: Value, scale: f64, magnification: f64) -> Agreement {
    let difference = drawn.apart(&computed).unwrap_or(f64::INFINITY);
    // A place is counted from a chosen origin: how near it lies to that says nothing of its error.
    let least = if computed.form() == Form::Point { scale } else { scale * 1e-3 };
    let reference = computed.magnitude().max(least);
    let difference = if difference == 0.0 { 0.0 } else { difference / reference };
    Agreement { difference, bound: WELL_CONDITIONED.max(STEPS * f64::EPSILON * magnification), noise: ROUNDING * scale }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hodograph_base::geom::Point;

    #[test]
    fn zero_answers_are_judged_by_their_polygon() {
        let a = compare(Value::Scalar(1e-15), Value::Scalar(0.0), 1.0, 1.0);
        assert!(a.holds() && (a.difference - 1e-12).abs() < 1e-20);
        assert!(!compare(Value::Scalar(1.0), Value::Scalar(1.0 + 1e-9), 1.0, 10.0).holds());
        // However bad the crossing, no digit in common is no agreement.
        assert!(!compare(Value::Scalar(1.0), Value::Scalar(1.1), 1.0, 1e18).holds());
        assert!(!compare(Value::Scalar(f64::NAN), Value::Scalar(1.0), 1.0, 10.0).holds());
    }

    #[test]
    fn places_agree_by_their_distance() {
        let agree = |off: f64| {
            let (a, b) = (Value::Point(Point::new(1e-9, off)), Value::Point(Point::new(1e-9, 0.0)));
            compare(a, b, 0.5, 1.0)
        };
        // Near the origin a place is no less certain than elsewhere.
        assert!(agree(1e-13).holds() && !agree(1e-10).holds());
        assert_eq!(agree(1e-3).difference, 2e-3);
        assert!(!compare(Value::Point(Point::ORIGIN), Value::Scalar(0.0), 1.0, 1.0).holds());
    }
}
