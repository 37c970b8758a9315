//! Wanted and actual output angle over the range of a function, and the extremes of the deviation.

use super::freudenstein::{Generator, extremes};
use super::{Function, FunctionTarget};
use crate::candidate::{Compared, DesignNumber};
use hodograph_base::diag::both;

/// Deviations (rad) and residuals below this are rounding.
const NOTHING: f64 = 1e-12;
/// Parts of a step below this are rounding.
const ROUNDING: f64 = 1e-9;

impl Function {
    /// Wanted and actual output angle over the range: at the step of the file and at the end, else
    /// at every half degree of the input, as course designs require, 40 to 720 places.
    pub(super) fn sampled(&self, g: &Generator) -> Vec<Compared> {
        let FunctionTarget::Curve { range, swings, table, .. } = &self.target else {
            return Vec::new();
        };
        let parts: Vec<f64> = match table {
            Some(step) => {
                let count = swings[0].abs() / step;
                let whole = libm::floor(count + ROUNDING) as usize;
                let end = (count - whole as f64 > ROUNDING).then_some(1.0);
                (0..=whole).map(|k| (k as f64 / count).min(1.0)).chain(end).collect()
            }
            None => {
                let count = libm::round(swings[0].abs().to_degrees() * 2.0).clamp(40.0, 720.0);
                (0..=count as usize).map(|k| k as f64 / count).collect()
            }
        };
        let compared = |part: f64| {
            let x = range[0] + (range[1] - range[0]) * part;
            let step = self.target.step(x)?;
            let wanted = g.start[1] + step[1];
            let (input, real) = (g.start[0] + step[0], wanted + g.deviation(step)?);
            Some(Compared { x, input, wanted, real })
        };
        parts.into_iter().filter_map(compared).collect()
    }

    /// Adds the greatest deviation, which is also returned, and the places of the extremes; for
    /// pairs, the deviations at them.
    pub(super) fn deviations(&self, g: &Generator, numbers: &mut Vec<DesignNumber>) -> f64 {
        let deviation = both!("structural error");
        match &self.target {
            FunctionTarget::Curve { range, .. } => {
                let step_of = |x: f64| self.target.step(x);
                let places = extremes(g, *range, &step_of);
                let value = |x: f64| self.target.step(x).and_then(|s| g.deviation(s));
                let all: Vec<(f64, f64)> =
                    places.iter().filter_map(|x| Some((*x, value(*x)?))).collect();
                // A function that is met everywhere has extremes of rounding only.
                if all.iter().all(|(_, e)| e.abs() < NOTHING) {
                    numbers.push(DesignNumber::angle(
                        "max_error",
                        both!("greatest structural error"),
                        0.0,
                    ));
                    return 0.0;
                }
                if let Some((x, e)) = all.iter().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())) {
                    numbers.push(DesignNumber::angle(
                        "max_error",
                        both!("greatest structural error"),
                        *e,
                    ));
                    numbers.push(DesignNumber::ratio("x_max", both!("where it is"), *x));
                }
                for (k, (x, e)) in all.iter().enumerate() {
                    numbers.push(DesignNumber::ratio(
                        &format!("x_{k}"),
                        both!("place of an extreme deviation"),
                        *x,
                    ));
                    numbers.push(DesignNumber::angle(&format!("error_{k}"), deviation.clone(), *e));
                }
            }
            FunctionTarget::Pairs { .. } => {
                let all: Vec<f64> = self.steps.iter().filter_map(|s| g.deviation(*s)).collect();
                let rest = self.steps.iter().map(|s| g.rest(*s)).map(|r| r * r).sum::<f64>().sqrt();
                numbers.push(DesignNumber::angle(
                    "max_error",
                    both!("greatest deviation at the pairs"),
                    all.iter()
                        .copied()
                        .fold(0.0, |m: f64, e| if e.abs() > m.abs() { e } else { m }),
                ));
                numbers.push(DesignNumber::ratio(
                    "residual",
                    both!("norm of the rests of Freudenstein's equation"),
                    if rest < NOTHING { 0.0 } else { rest },
                ));
            }
        }
        numbers.iter().find(|n| n.name == "max_error").map_or(0.0, |n| n.value.abs())
    }
}
