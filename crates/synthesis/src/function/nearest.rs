//! The nearest feasible task where no four-bar generates the function.

use super::freudenstein::Generator;
use super::{Function, FunctionTarget};
use crate::nearest::{roughly, told};
use hodograph_base::diag::{Both, both};

impl Function {
    /// The nearest feasible task: another starting angle, output swing or last pair, or crank.
    pub(super) fn nearest(&self) -> Both {
        let free = both!("leave a starting angle free, or take fewer points");
        self.of_output().or_else(|| self.of_crank()).unwrap_or(free)
    }

    /// The output angles with which a linkage exists.
    fn of_output(&self) -> Option<Both> {
        let degrees = |at: f64, scale: f64, with: &dyn Fn(f64) -> Function| {
            roughly(at, scale, |v| with(v).works()).map(told)
        };
        match (&self.target, self.start[1]) {
            (FunctionTarget::Curve { .. }, Some(from)) if !self.minimax => {
                let with = |v: f64| Function {
                    start: [self.start[0], Some(v.to_radians())],
                    ..self.clone()
                };
                let from = degrees(from.to_degrees(), 90.0, &with)?;
                Some(both!("\"output\": {{\"from\": \"{} deg\"}} has one", from))
            }
            (FunctionTarget::Curve { swings, .. }, _) => {
                let own = swings[1].to_degrees();
                let with = |v: f64| self.swung(v / own);
                let swing = degrees(own, own.abs(), &with)?;
                Some(both!("\"output\": {{\"swing\": \"{} deg\"}} has one", swing))
            }
            (FunctionTarget::Pairs { zero }, _) => {
                let last = self.steps.len() - 1;
                let own = (self.steps[last][1] + zero).to_degrees();
                let with = |v: f64| {
                    let mut other = self.clone();
                    other.steps[last][1] = v.to_radians() - zero;
                    other
                };
                let angle = degrees(own, 90.0, &with)?;
                Some(both!("with {}° as the last output angle there is one", angle))
            }
        }
    }

    /// The crank with which a linkage exists, if it is given together with the frame.
    fn of_crank(&self) -> Option<Both> {
        let own = self.crank? * 1e3;
        let works =
            |mm: f64| mm > 0.0 && Function { crank: Some(mm * 1e-3), ..self.clone() }.works();
        let mm = roughly(own, own, works)?;
        Some(both!("\"crank\": \"{} mm\" has one", told(mm)))
    }

    /// The function with the output's swing multiplied by a factor.
    fn swung(&self, times: f64) -> Function {
        let mut other = self.clone();
        other.steps.iter_mut().for_each(|s| s[1] *= times);
        if let FunctionTarget::Curve { swings, .. } = &mut other.target {
            swings[1] *= times;
        }
        other
    }

    /// True if some four-bar closes at all points.
    fn works(&self) -> bool {
        let closes = |g: &Generator| {
            let up = g.upright();
            up.lengths().is_some_and(|l| l.iter().all(|l| *l < MOST))
                && self.steps.iter().all(|s| up.output(s[0], 0.0).is_some())
        };
        self.generators().is_ok_and(|all| all.iter().any(|(_, g)| closes(g)))
    }
}

/// The greatest ratio of a link to the frame.
const MOST: f64 = 100.0;
