//! An axis, linear or in powers of ten: its range, its ticks and their labels.

use hodograph_report::amount::number;

/// Easily read steps between ticks, times a power of ten; and the steps for degrees.
const STEPS: [f64; 4] = [1.0, 2.0, 2.5, 5.0];
const DEGREES: [f64; 8] = [1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 60.0];
/// With more decades than this, only every fifth has a tick.
const DECADES_MAX: f64 = 12.0;
/// A curve stays at a place if more values than this, and more than a tenth of all, are there.
const STAYS: usize = 8;
/// Relative difference below which values are equal: between their rounded numbers there is no
/// space for ticks.
const ONE_VALUE: f64 = 1e-9;
/// Limit of an axis, so that its length is a finite number.
const FARTHEST: f64 = 1e307;
/// A shorter axis has no numbers at its ticks.
const SHORTEST: f64 = 1e-290;

/// A range with ticks.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PlotAxis {
    /// The value at the start, on the left or below; the value at the end may be less.
    pub from: f64,
    /// The value at the end.
    pub to: f64,
    /// The step between ticks: of the values, or of their powers of ten.
    step: f64,
    powers: bool,
}

impl PlotAxis {
    /// Returns the range of these values, extended to ticks, with at most `most` steps.
    pub fn of(values: &[f64], degrees: bool, most: usize) -> PlotAxis {
        let finite = || {
            values.iter().copied().filter(|v| v.is_finite()).map(|v| v.clamp(-FARTHEST, FARTHEST))
        };
        let lo = finite().fold(f64::INFINITY, f64::min);
        let hi = finite().fold(f64::NEG_INFINITY, f64::max);
        // Without values, or with only one: a range around it.
        let (lo, hi) = if hi - lo > (ONE_VALUE * lo.abs().max(hi.abs())).max(SHORTEST) {
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
        let steps =
            (decade..=decade + 1).flat_map(|e| STEPS.map(|s| s * libm::pow(10.0, f64::from(e))));
        let step = own.or_else(|| steps.into_iter().find(|s| round(*s))).unwrap_or(least);
        // A rounding error beyond a tick counts as the tick: 360.00000000000006° ends at 360°.
        let (from, to) =
            (libm::floor(lo / step + 1e-9) * step, libm::ceil(hi / step - 1e-9) * step);
        // A curve that stays at an end would coincide with the frame; at zero the frame is
        // intended.
        let stays = |end: f64| {
            let there = values.iter().filter(|v| (**v - end).abs() < step * 1e-6).count();
            end != 0.0 && there > STAYS.max(values.len() / 10)
        };
        let (from, to) =
            (if stays(from) { from - step } else { from }, if stays(to) { to + step } else { to });
        PlotAxis { from, to, step, powers: false }
    }

    /// Returns an axis from one power of ten to another.
    pub fn powers(from: f64, to: f64) -> PlotAxis {
        let step = if (to - from).abs() > DECADES_MAX { 5.0 } else { 1.0 };
        PlotAxis { from: libm::pow(10.0, from), to: libm::pow(10.0, to), step, powers: true }
    }

    /// A value in the units of the axis: itself, or its power of ten.
    fn scaled(&self, value: f64) -> f64 {
        if self.powers { libm::log10(value) } else { value }
    }

    /// Returns the position of a value, from 0 to 1. Values outside are at the ends; zero on an
    /// axis of powers is at the start.
    pub fn part(&self, value: f64) -> f64 {
        let [from, to, value] = [self.from, self.to, value].map(|v| self.scaled(v));
        let part = (value - from) / (to - from);
        if part.is_nan() { 0.0 } else { part.clamp(0.0, 1.0) }
    }

    /// Returns the values at the ticks, in increasing order.
    pub fn ticks(&self) -> impl Iterator<Item = f64> + '_ {
        let [from, to] = [self.from, self.to].map(|v| self.scaled(v) / self.step);
        // A rounding error beyond a tick counts as the tick.
        let (first, last) = (libm::ceil(from.min(to) - 1e-9), libm::floor(from.max(to) + 1e-9));
        let value = |k: f64| if self.powers { libm::pow(10.0, k) } else { k };
        (0..=(last - first) as usize).map(move |k| value((first + k as f64) * self.step))
    }

    /// Returns true if the value is strictly between the ends.
    pub fn holds(&self, value: f64) -> bool {
        self.from.min(self.to) < value && value < self.from.max(self.to)
    }

    /// Returns a tick's number, with no more decimals than the step needs.
    pub fn name(&self, tick: f64) -> String {
        if self.powers {
            let power = libm::round(libm::log10(tick));
            return if power == 0.0 {
                "1".into()
            } else {
                format!("10^{{{power}}}").replace('-', "−")
            };
        }
        let places = (-libm::floor(libm::log10(self.step)) + 1.0).clamp(0.0, 12.0) as usize;
        let tick = if tick.abs() < self.step * 1e-6 { 0.0 } else { tick };
        let large = self.from.abs().max(self.to.abs());
        if large >= 1e5 || self.step < 1e-5 {
            return number(tick, 3);
        }
        let text = format!("{tick:.places$}");
        let text = if text.contains('.') {
            text.trim_end_matches('0').trim_end_matches('.')
        } else {
            &text
        };
        text.replace('-', "−")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_ten() {
        let names = |axis: &PlotAxis| axis.ticks().map(|t| axis.name(t)).collect::<Vec<_>>();
        let few = PlotAxis::powers(-2.0, 1.0);
        assert_eq!(names(&few), ["10^{−2}", "10^{−1}", "1", "10^{1}"]);
        assert!(
            (few.part(0.1) - 1.0 / 3.0).abs() < 1e-12
                && few.part(0.0) == 0.0
                && few.part(1e9) == 1.0
        );
        // Decreasing to the right.
        let back = PlotAxis::powers(0.0, -14.0);
        assert_eq!(names(&back), ["10^{−10}", "10^{−5}", "1"]);
        assert!(
            back.part(1.0) == 0.0
                && back.part(1e-14) == 1.0
                && back.holds(1e-3)
                && !back.holds(2.0)
        );
    }

    #[test]
    fn ticks_that_people_read() {
        let degrees = PlotAxis::of(&[0.0, 360.000_000_000_000_06], true, 12);
        assert_eq!((degrees.from, degrees.to, degrees.step), (0.0, 360.0, 30.0));
        let y = PlotAxis::of(&[-0.31, 0.58], false, 6);
        assert_eq!(
            (y.name(y.from), y.name(y.to), y.ticks().count()),
            ("−0.4".into(), "0.6".into(), 6)
        );
        assert_eq!(PlotAxis::of(&[2.0], false, 6).ticks().count(), 5);
        let constant: Vec<f64> = (0..20).map(|k| 0.06 * f64::from(k)).chain([1.2; 20]).collect();
        assert!((PlotAxis::of(&constant, false, 6).to - 1.4).abs() < 1e-12);
        assert_eq!(PlotAxis::of(&[[0.0; 20], [1.2; 20]].concat()[..21], false, 6).from, 0.0);
        assert!(PlotAxis::of(&[], false, 6).ticks().all(f64::is_finite));
        // Values that differ by rounding only, numbers at the ends of their range, and no numbers.
        for [a, b] in [
            [7.000000000007, 7.000000000007001],
            [-1e308, 1e308],
            [0.0, 5e-324],
            [f64::INFINITY, 1.0],
            [f64::NAN, f64::NAN],
            [1e300, 1.0000000000000002e300],
            [f64::MIN, f64::MIN],
        ] {
            let axis = PlotAxis::of(&[a, b], false, 6);
            let all = [a, b, axis.from, axis.to, 0.0].map(|v| axis.part(v));
            assert!(
                axis.from < axis.to && all.iter().all(|p| (0.0..=1.0).contains(p)),
                "{a} {b}: {axis:?} {all:?}"
            );
            assert!(
                (2..20).contains(&axis.ticks().count()) && axis.ticks().all(f64::is_finite),
                "{a} {b}: {axis:?}"
            );
        }
        assert_eq!(PlotAxis::of(&[0.0, 1e-9], false, 5).name(4e-10), "4.00 \\times 10^{−10}");
    }
}
