//! A linear axis: its range and its ticks.

use crate::figure::results::number;

/// Steps between the ticks of an axis that people read without thinking, of a power of ten; for degrees their own.
const STEPS: [f64; 4] = [1.0, 2.0, 2.5, 5.0];
const DEGREES: [f64; 8] = [1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 60.0];
/// A range with ticks.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    pub from: f64,
    pub to: f64,
    step: f64,
}

impl Axis {
    /// The range of these values, widened to ticks; at most `most` steps.
    pub fn of(values: &[f64], degrees: bool, most: usize) -> Axis {
        let lo = values.iter().copied().fold(f64::INFINITY, f64::min);
        let hi = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        // Nothing, or one value alone: a range around it.
        let (lo, hi) = if lo < hi {
            (lo, hi)
        } else if lo.is_finite() {
            (lo - 0.5 * lo.abs().max(1.0), lo + 0.5 * lo.abs().max(1.0))
        } else {
            (0.0, 1.0)
        };
        let least = (hi - lo) / most as f64;
        let round = |step: f64| step >= least * (1.0 - 1e-9);
        let own = degrees.then(|| DEGREES.into_iter().find(|s| round(*s))).flatten();
        let decade = libm::floor(libm::log10(least)) as i32;
        let steps = (decade..=decade + 1).flat_map(|e| STEPS.map(|s| s * libm::pow(10.0, f64::from(e))));
        let step = own.or_else(|| steps.into_iter().find(|s| round(*s))).unwrap_or(least);
        // A hair beyond a tick is at the tick: 360.00000000000006° ends at 360°.
        Axis { from: libm::floor(lo / step + 1e-9) * step, to: libm::ceil(hi / step - 1e-9) * step, step }
    }

    pub fn part(&self, value: f64) -> f64 {
        ((value - self.from) / (self.to - self.from)).clamp(0.0, 1.0)
    }

    pub fn ticks(&self) -> impl Iterator<Item = f64> + '_ {
        let first = libm::round(self.from / self.step);
        let count = libm::round((self.to - self.from) / self.step) as usize;
        (0..=count).map(move |k| (first + k as f64) * self.step)
    }

    /// A tick's number, with no more places than the step has.
    pub fn name(&self, tick: f64) -> String {
        let places = (-libm::floor(libm::log10(self.step)) + 1.0).clamp(0.0, 12.0) as usize;
        let tick = if tick.abs() < self.step * 1e-6 { 0.0 } else { tick };
        let large = self.from.abs().max(self.to.abs());
        if large >= 1e5 || self.step < 1e-5 {
            return number(tick, 3);
        }
        let text = format!("{tick:.places$}");
        let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
        text.replace('-', "−")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_that_people_read() {
        let degrees = Axis::of(&[0.0, 360.000_000_000_000_06], true, 12);
        assert_eq!((degrees.from, degrees.to, degrees.step), (0.0, 360.0, 30.0));
        let y = Axis::of(&[-0.31, 0.58], false, 6);
        assert_eq!((y.name(y.from), y.name(y.to), y.ticks().count()), ("−0.4".into(), "0.6".into(), 6));
        assert_eq!(Axis::of(&[2.0], false, 6).ticks().count(), 5);
        assert!(Axis::of(&[], false, 6).ticks().all(f64::is_finite));
        assert_eq!(Axis::of(&[0.0, 1e-9], false, 5).name(4e-10), "4.00 \\times 10^{−10}");
    }
}
