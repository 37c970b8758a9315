//! The extreme positions of one output, from its positions and rates at samples of the driver's
//! whole motion.
//!
//! Between two samples with rates of opposite signs Newton's method locates the zero of the rate,
//! with the acceleration as derivative. Where the rate vanishes on a whole stretch the output
//! dwells: the stretch is one extreme, and its ends are junctions of the cam that makes it.

use super::extreme::{DrivenOutput, OutputExtreme, Swing};
use super::limit::DriverRange;
use super::station::Stations;
use hodograph_base::diag::Faults;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// The part of the largest position or rate below which a value is zero.
const ROUNDING: f64 = 1e-12;

/// The multiple of the mechanism's size beyond which a slider is at infinity, within rounding.
const FAR: f64 = 1e9;

/// The part of a step below which zeros of a rate are one: between two samples there is one at
/// most, and more come from rounding.
const ONE: f64 = 1e-3;

/// The samples of a driver's motion.
pub(super) struct DriverSamples<'a> {
    /// The driver's values at the samples.
    pub stations: &'a Stations,
    /// The range of the driver.
    pub range: &'a DriverRange,
    /// The size of the mechanism (m).
    pub extent: f64,
    /// The driver's angle after which the first station recurs, if the stations cover all of it.
    pub period: Option<f64>,
    /// The driver's positions at which cams pass from one stage or piece to the next, each with the
    /// period after which it recurs.
    pub joints: &'a [[f64; 2]],
}

impl DriverSamples<'_> {
    /// The distance from one station to the next.
    fn step(&self) -> f64 {
        self.stations.values.windows(2).next().map_or(0.0, |w| (w[1] - w[0]).abs())
    }

    /// A position of the driver, or the cam's junction less than a step from it.
    fn at_joint(&self, x: f64) -> f64 {
        let near = self
            .joints
            .iter()
            .map(|[joint, period]| joint + libm::rint((x - joint) / period) * period);
        let nearest = near.min_by(|a, b| (a - x).abs().total_cmp(&(b - x).abs()));
        nearest.filter(|joint| (joint - x).abs() < self.step()).unwrap_or(x)
    }
}

/// The swing of an output. `[s, v]` are its positions and rates at the stations, `missing` the
/// stations without them, and `at` returns position, rate and acceleration at any driver value.
pub(super) fn swing(
    output: DrivenOutput,
    [s, v]: [&[f64]; 2],
    missing: &BTreeMap<usize, Faults>,
    course: &DriverSamples,
    at: &dyn Fn(f64) -> Option<[f64; 3]>,
) -> Swing {
    let far = if matches!(output, DrivenOutput::Sliding(_)) && course.extent > 0.0 {
        FAR * course.extent
    } else {
        f64::INFINITY
    };
    let there = |i: usize| !missing.contains_key(&i) && s[i].abs() <= far && v[i].is_finite();
    // Angles are made continuous.
    let mut position = s.to_vec();
    if matches!(output, DrivenOutput::Turning(_)) {
        // Also across a missing row, such as that of a change point.
        let mut last = None;
        for i in (0..position.len()).filter(|i| there(*i)) {
            if let Some(last) = last {
                position[i] -= libm::rint((position[i] - last) / TAU) * TAU;
            }
            last = Some(position[i]);
        }
    }
    // A position in the same turn as the sample next to it.
    let near = |here: f64, i: usize| match output {
        DrivenOutput::Turning(_) => here - libm::rint((here - position[i]) / TAU) * TAU,
        DrivenOutput::Sliding(_) => here,
    };
    let (x, period) = (&course.stations.values, course.period);
    // Next to a limit a rate grows beyond all bounds: the typical rate of the output follows from
    // its positions.
    let gone = |i: usize| {
        if there(i) && there(i - 1) { (position[i] - position[i - 1]).abs() } else { 0.0 }
    };
    let rounding = ROUNDING * (1..x.len()).map(gone).fold(0.0, f64::max) / course.step();
    // Samples with a rate; one that meets a zero is passed over. After a full turn the first
    // recurs.
    let mut moving: Vec<(f64, usize)> =
        (0..x.len()).filter(|&i| there(i) && v[i].abs() > rounding).map(|i| (x[i], i)).collect();
    if let (Some(period), Some(&(first, i))) = (period, moving.first()) {
        moving.push((first + period, i));
    }
    let mut extremes: Vec<OutputExtreme> = Vec::new();
    for pair in moving.windows(2) {
        let ((a, i), (b, k)) = (pair[0], pair[1]);
        // A missing row between the two separates the motion.
        let joined = k < i || (i..=k).all(there);
        if joined && (v[i] > 0.0) != (v[k] > 0.0) {
            let driver = zero(a, b, v[i], at);
            let [driver, until] =
                dwell([a, driver, b], rounding, course, at).unwrap_or([driver; 2]);
            let Some([here, ..]) = at(driver) else { continue };
            extremes.push(OutputExtreme {
                driver,
                until: (until > driver).then_some(until),
                output: near(here, i),
                at_limit: false,
            });
        }
    }
    once(&mut extremes, ONE * course.step(), period);
    let known: Vec<usize> = (0..x.len()).filter(|&i| there(i)).collect();
    let time_ratio = match (&extremes[..], period) {
        ([a, b], Some(TAU)) => {
            let stroke = |from: &OutputExtreme, to: &OutputExtreme| {
                (to.driver - from.until.unwrap_or(from.driver)).rem_euclid(TAU)
            };
            let [out, back] = [stroke(a, b), stroke(b, a)];
            Some(out.max(back) / out.min(back))
        }
        _ => None,
    };
    let range = course.range;
    if !range.full() {
        let way = range.bounds()[1] - range.bounds()[0];
        for ((event, end), inward) in
            range.ends.iter().zip([known.first(), known.last()]).zip([way, -way])
        {
            if let (Some(event), Some(&i)) = (event, end) {
                let there = at_limit(event.value, inward, &|x| Some(near(at(x)?[0], i)))
                    .unwrap_or(position[i]);
                // Where a rate grows beyond all bounds, rounding gives it either sign.
                extremes.retain(|e| (e.driver - event.value).abs() > ONE * course.step());
                extremes.push(OutputExtreme {
                    driver: event.value,
                    until: None,
                    output: there,
                    at_limit: true,
                });
            }
        }
    }
    // A value that is zero within the rounding of the positions is set to zero.
    let most = known.iter().map(|&i| position[i].abs()).fold(0.0, f64::max);
    extremes.iter_mut().filter(|e| e.output.abs() < ROUNDING * most).for_each(|e| e.output = 0.0);
    extremes.sort_by(|a, b| a.driver.total_cmp(&b.driver));
    let least = extremes.iter().map(|e| e.output).fold(f64::INFINITY, f64::min);
    let most = extremes.iter().map(|e| e.output).fold(f64::NEG_INFINITY, f64::max);
    // A range that is known on one side only, or on none, has no stroke; nor has one with more
    // missing rows than those at its ends.
    let whole =
        (period.is_some() || range.ends.iter().all(Option::is_some)) && known.len() + 4 >= x.len();
    // A position beyond the extremes belongs to a motion through infinity.
    let held = known.iter().all(|&i| {
        (least - ONE * (most - least)..=most + ONE * (most - least)).contains(&position[i])
    });
    Swing {
        output,
        stroke: (whole && held && most >= least).then_some(most - least),
        extremes,
        time_ratio,
    }
}

/// The stretch about a zero of the rate on which the output dwells, if it does. The argument is a
/// position before the zero, the zero, and a position after it.
fn dwell(
    [a, zero, b]: [f64; 3],
    rounding: f64,
    course: &DriverSamples,
    at: &dyn Fn(f64) -> Option<[f64; 3]>,
) -> Option<[f64; 2]> {
    let still = |x: f64| at(x).is_some_and(|[_, v, _]| v.abs() <= rounding);
    let beside = ONE * course.step();
    if !still(zero - beside) && !still(zero + beside) {
        return None;
    }
    let edge = |outside: f64| {
        let (mut inside, mut outside) = (zero, outside);
        loop {
            let middle = 0.5 * (inside + outside);
            // No double remains between.
            if middle == inside || middle == outside {
                return course.at_joint(inside);
            }
            if still(middle) { inside = middle } else { outside = middle }
        }
    };
    let [from, until] = [edge(a), edge(b)];
    // A rate of a high order vanishes about its zero within rounding.
    Some(if until - from > beside { [from, until] } else { [course.at_joint(zero); 2] })
}

/// Removes pairs of adjacent extremes, which rounding makes: an odd number of them leaves one.
fn once(extremes: &mut Vec<OutputExtreme>, near: f64, period: Option<f64>) {
    let mut out: Vec<OutputExtreme> = Vec::new();
    let end = |e: &OutputExtreme| e.until.unwrap_or(e.driver);
    for e in extremes.drain(..) {
        match out.last() {
            Some(last) if e.driver - end(last) <= near => drop(out.pop()),
            _ => out.push(e),
        }
    }
    // The last may be next to the first of the next turn.
    if let (Some(period), [first, .., last]) = (period, &out[..])
        && first.driver + period - end(last) <= near
    {
        out.pop();
        out.remove(0);
    }
    *extremes = out;
}

/// The position at a limit of the driver, where the two branches meet: near it the position is a
/// smooth function of the root of the distance from it. The polynomial through a few places in the
/// direction `inward` is extrapolated to the limit itself.
fn at_limit(limit: f64, inward: f64, at: &dyn Fn(f64) -> Option<f64>) -> Option<f64> {
    // With six places within this part of the whole range, the polynomial's error is 1e-14 of the
    // travel.
    const NEAR: f64 = 1e-4;
    const PLACES: [(f64, f64); 6] =
        [(1.0, 6.0), (2.0, -15.0), (3.0, 20.0), (4.0, -15.0), (5.0, 6.0), (6.0, -1.0)];
    let place = |root: f64| at(limit + inward * NEAR * root * root / 36.0);
    PLACES.iter().map(|(root, weight)| Some(weight * place(*root)?)).sum()
}

/// A zero of a rate between two positions: Newton's method with the acceleration, kept between the
/// bounds.
fn zero(a: f64, b: f64, rate_at_a: f64, at: &dyn Fn(f64) -> Option<[f64; 3]>) -> f64 {
    let (mut inside, mut outside) = (a, b);
    let mut x = 0.5 * (a + b);
    for _ in 0..100 {
        let Some([_, v, acceleration]) = at(x) else { return x };
        if (v > 0.0) == (rate_at_a > 0.0) && v != 0.0 {
            inside = x;
        } else {
            outside = x;
        }
        let newton = x - v / acceleration;
        let within = (newton - inside) * (newton - outside) <= 0.0;
        let next = if within { newton } else { 0.5 * (inside + outside) };
        if next == x || (next - x).abs() <= 2.0 * f64::EPSILON * x.abs() {
            return next;
        }
        x = next;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Zeros that rounding makes of one: an odd number counts as one and an even number as none,
    /// also from one turn to the next.
    #[test]
    fn an_extreme_is_listed_once() {
        let left = |places: &[f64]| {
            let extreme = |driver: &f64| OutputExtreme {
                driver: *driver,
                until: None,
                output: 0.0,
                at_limit: false,
            };
            let mut all: Vec<OutputExtreme> = places.iter().map(extreme).collect();
            once(&mut all, 1e-5, Some(TAU));
            all.iter().map(|e| e.driver).collect::<Vec<_>>()
        };
        assert_eq!(left(&[1.0, 1.000_001, 1.000_002, 4.0]), [1.000_002, 4.0]);
        assert_eq!(left(&[1.0, 2.0, 2.000_001, 4.0]), [1.0, 4.0]);
        assert_eq!(left(&[1e-6, 1.0, 4.0, TAU - 1e-6]), [1.0, 4.0]);
    }
}
