//! The nearest feasible task: one number of a task without a solution is varied from its given
//! value until there is a solution.
//!
//! Steps grow to either side. Between the last number that fails and the first that works the limit
//! is bisected, and rounded to the working side, so that the printed number works as it is.

use hodograph_base::digits::significant;

/// The first step and the bound of the steps, as shares of the scale.
const STEPS: [f64; 2] = [1e-3, 30.0];
/// The growth of the steps: fine where a trial costs little, so that narrow ranges are found; else
/// coarse.
const FINE: f64 = 1.04;
const COARSE: f64 = 1.25;
/// Significant digits of a proposed number.
const DIGITS: i32 = 4;

/// The number nearest to the given one with which a task works; `scale` is the size of a large
/// change.
pub fn number(given: f64, scale: f64, works: impl Fn(f64) -> bool) -> Option<f64> {
    by_steps(given, scale, FINE, &works)
}

/// Searches like [`number()`] but in coarse steps, for tasks with expensive trials.
pub fn roughly(given: f64, scale: f64, works: impl Fn(f64) -> bool) -> Option<f64> {
    by_steps(given, scale, COARSE, &works)
}

fn by_steps(given: f64, scale: f64, growth: f64, works: &dyn Fn(f64) -> bool) -> Option<f64> {
    let toward = |side: f64| {
        let (mut fails, mut step) = (given, STEPS[0]);
        while step < STEPS[1] {
            let here = given + side * step * scale;
            if works(here) {
                return Some(border(fails, here, works));
            }
            (fails, step) = (here, step * growth);
        }
        None
    };
    [-1.0, 1.0]
        .into_iter()
        .filter_map(toward)
        .min_by(|a, b| (a - given).abs().total_cmp(&(b - given).abs()))
}

fn border(mut fails: f64, mut good: f64, works: &dyn Fn(f64) -> bool) -> f64 {
    for _ in 0..24 {
        let middle = (fails + good) / 2.0;
        if works(middle) { good = middle } else { fails = middle }
    }
    // Rounded towards the working side; a few units further where rounding alone does not suffice.
    let unit =
        libm::pow(10.0, libm::floor(libm::log10(good.abs().max(1e-12))) + 1.0 - f64::from(DIGITS));
    let away = if good > fails { 1.0 } else { -1.0 };
    let round = if good > fails { libm::ceil(good / unit) } else { libm::floor(good / unit) };
    (0..8).map(|k| (round + away * f64::from(k)) * unit).find(|v| works(*v)).unwrap_or(good)
}

/// Returns a number with all of its digits, without trailing zeros.
pub fn told(value: f64) -> String {
    let text = significant(value, 12);
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearer_side_is_taken_and_rounded_to_where_it_works() {
        let outside = |x: f64| !(2.0..=5.123_456).contains(&x);
        assert_eq!(number(4.5, 4.5, outside), Some(5.124));
        assert_eq!(number(2.1, 2.1, outside).map(|x| (x * 1e3).round() / 1e3), Some(1.999));
        assert_eq!(number(1.0, 1.0, |_| false), None);
        let narrow = |x: f64| (3.0..3.9).contains(&x);
        assert!(number(-1.0, 1.0, narrow).is_some_and(narrow));
    }
}
