//! Drawing against analysis, question by question.

use crate::answer::Value;
use crate::mechanism::Level;

/// How one question's two answers compare.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement {
    /// Difference of the two, relative to the answer, or to a thousandth of the largest vector of its polygon where the
    /// answer is smaller than that (an answer of zero has no relative error).
    pub difference: f64,
    /// What double precision lets one expect: 1e-11 for well-conditioned scenes, more as the condition number grows.
    pub bound: f64,
}

impl Agreement {
    /// Whether the difference is within what rounding explains; if not, the error is ours.
    pub fn holds(&self) -> bool {
        self.difference <= self.bound
    }
}

/// Well-conditioned scenes agree to this.
const WELL_CONDITIONED: f64 = 1e-11;

/// Compares two values of one question. `scale` is the largest vector (or rate) of its level.
pub fn compare(drawn: Value, computed: Value, scale: f64, condition: f64, level: Level) -> Agreement {
    let (difference, size) = match (drawn, computed) {
        (Value::Vector(a), Value::Vector(b)) => ((a - b).norm(), b.norm()),
        (Value::Scalar(a), Value::Scalar(b)) => ((a - b).abs(), b.abs()),
        _ => (f64::INFINITY, 1.0),
    };
    let reference = size.max(scale * 1e-3);
    // Velocities lose the condition number's digits, accelerations up to its cube (they go with 1/S³ of the crossing).
    let lost = match level {
        Level::Acceleration => condition * condition * condition.min(1e3),
        _ => condition * condition,
    };
    let bound = WELL_CONDITIONED.max(64.0 * f64::EPSILON * lost);
    let relative = if difference == 0.0 { 0.0 } else { difference / reference };
    Agreement { difference: relative, bound }
}
