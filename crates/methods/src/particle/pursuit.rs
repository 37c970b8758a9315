//! Pursuit: a point that always runs toward another point, at a given speed. For a general target
//! the course has no closed form: it is integrated. No other motion in the program is found by
//! integration.
//!
//! The vector D from pursuer to target satisfies D′ = v_B(t) − v(t) D/|D|. The steps are those of
//! Gragg, Bulirsch and Stoer: the modified midpoint rule with 2, 4, 6, ... parts, extrapolated in
//! the square of the step. D/|D| is the gradient of a convex function, so two solutions never
//! diverge: the error of a step never grows, and the sum of all step errors bounds the error of the
//! place. The error of a step is taken as the difference of its last two extrapolations, which is
//! the error of the worse one.

use super::law::{PathLaw, jet};
use hodograph_base::diag::{Diagnostic, both};
use hodograph_base::number::{Ball, Dd, Real};
use hodograph_scene::folded::Folded;
use hodograph_scene::front::Law;

/// The code of the diagnostic for a course that the steps do not follow to its end.
pub const LOST: &str = "pursuit-lost";
/// The largest number of steps to an instant, and of rejected steps.
const MOST_STEPS: usize = 4000;
/// The largest number of steps to a meeting: a pursuer that is faster by one percent needs some
/// hundred.
const MOST_TO_MEET: usize = 1200;
/// The largest number of steps in which the target is as fast or faster: it is met early, if it
/// runs toward the pursuer, or never.
const MOST_SLOWER: usize = 800;
/// The largest number of steps to a meeting for which longer numbers are used: each of their steps
/// takes fifty times as long.
pub const MOST_LONGER: usize = 200;
/// The horizon for a meeting, in multiples of the time that the pursuer needs to reach the first
/// place of the target.
const HORIZON: f64 = 1e4;
/// The smallest closing speed used for the step size, as a fraction of the pursuer's speed.
const SLOWEST: f64 = 1e-6;
/// Half the number of parts of the finest midpoint rule.
const COLUMNS: usize = 10;

/// A pursuer and its target.
#[derive(Clone, Copy, Debug)]
pub struct Chase<'a> {
    /// The place of the pursuer at t = 0.
    pub from: &'a [Law; 2],
    /// The speed of the pursuer.
    pub speed: &'a Law,
    /// The motion of the target.
    pub target: &'a PathLaw,
}

/// A chase in one kind of number, with laws that are evaluated at every step.
struct PursuitLaws<N> {
    speed: Folded<N>,
    target: PathLaw<Folded<N>>,
}

/// The vector from pursuer to target at a time.
#[derive(Clone, Copy, Debug)]
pub struct PursuitState<N> {
    /// The time (s).
    pub t: N,
    /// From the pursuer to the target (m).
    pub d: [N; 2],
    /// An error bound of d (m).
    pub error: f64,
}

/// The end of a pursuit.
#[derive(Clone, Copy, Debug)]
pub enum PursuitEnd {
    /// The two meet.
    Meet {
        /// The time (s).
        time: Ball<Dd>,
        /// The place (m).
        place: [Ball<Dd>; 2],
    },
    /// The two do not meet up to a time.
    Apart {
        /// The time to which they are followed (s).
        until: f64,
        /// Their distance at that time (m).
        distance: f64,
    },
}

impl<N: Real> PursuitState<N> {
    /// Returns |D|.
    pub fn distance(&self) -> f64 {
        self.d[0].hypot(self.d[1]).approx()
    }

    /// Returns D as numbers with error bounds.
    pub fn enclosed(&self) -> [Ball<Dd>; 2]
    where
        N: Into<Dd>,
    {
        self.d.map(|x| Ball::new(x.into(), self.error))
    }
}

/// Returns the resolution of the numbers, and the distance at which the two count as met, both as
/// fractions of the first distance.
fn fineness<N: Real>() -> (f64, f64) {
    // Numbers longer than f64 resolve more digits.
    let third = N::from_f64(1.0) / N::from_f64(3.0);
    let longer = (third - N::from_f64(third.approx())).approx() != 0.0;
    if longer { (1e-29, 1e-22) } else { (2e-16, 1e-14) }
}

impl<N: Real> PursuitLaws<N> {
    /// Returns the speed of the pursuer and the velocity of the target at a time.
    fn rates(&self, t: N) -> Result<(N, [N; 2]), Diagnostic> {
        let b = self.target.at(t)?;
        Ok((self.speed.at(t)?.si().0[0], [b[0].0[1], b[1].0[1]]))
    }

    fn slope(&self, t: N, d: [N; 2]) -> Result<[N; 2], Diagnostic> {
        let (v, b) = self.rates(t)?;
        let l = d[0].hypot(d[1]);
        Ok([b[0] - v * d[0] / l, b[1] - v * d[1] / l])
    }

    /// Performs the modified midpoint rule with `n` parts.
    fn midpoint(&self, from: &PursuitState<N>, h: N, n: usize) -> Result<[N; 2], Diagnostic> {
        let part = h / N::from_f64(n as f64);
        let two = N::from_f64(2.0);
        let ahead = |d: [N; 2], by: N, s: [N; 2]| [d[0] + by * s[0], d[1] + by * s[1]];
        let mut before = from.d;
        let mut here = ahead(from.d, part, self.slope(from.t, from.d)?);
        for k in 1..n {
            let next =
                ahead(before, two * part, self.slope(from.t + part * N::from_f64(k as f64), here)?);
            (before, here) = (here, next);
        }
        let last = ahead(before, part, self.slope(from.t + h, here)?);
        Ok([0, 1].map(|k| (here[k] + last[k]) / two))
    }

    /// Performs one step of Gragg, Bulirsch and Stoer, and returns it with its error; `None` if the
    /// extrapolation has not converged.
    fn step(
        &self,
        from: &PursuitState<N>,
        h: N,
        tolerance: f64,
    ) -> Result<Option<([N; 2], f64)>, Diagnostic> {
        let mut row: Vec<[N; 2]> = Vec::new();
        for k in 0..COLUMNS {
            let n = 2 * (k + 1);
            let mut next = vec![self.midpoint(from, h, n)?];
            for j in 0..k {
                // (n_k / n_{k−j−1})² − 1
                let ratio = N::from_f64(n as f64) / N::from_f64((2 * (k - j)) as f64);
                let over = ratio * ratio - N::from_f64(1.0);
                let (fine, coarse) = (next[j], row[j]);
                next.push([0, 1].map(|c| fine[c] + (fine[c] - coarse[c]) / over));
            }
            if k > 1 {
                let (one, other) = (next[k], next[k - 1]);
                let error = (one[0] - other[0]).hypot(one[1] - other[1]).approx();
                if error <= tolerance {
                    return Ok(Some((one, error)));
                }
            }
            row = next;
        }
        Ok(None)
    }
}

impl Chase<'_> {
    /// Returns the state at t = 0.
    ///
    /// # Errors
    /// If a law has no value.
    pub fn start<N: Real>(&self) -> Result<PursuitState<N>, Diagnostic> {
        let zero = N::from_f64(0.0);
        let b = self.target.at(zero)?;
        let place = |k: usize| Ok(b[k].0[0] - jet(&self.from[k], zero)?.0[0]);
        Ok(PursuitState { t: zero, d: [place(0)?, place(1)?], error: 0.0 })
    }

    fn folded<N: Real>(&self) -> Result<PursuitLaws<N>, Diagnostic> {
        Ok(PursuitLaws { speed: self.speed.folded()?, target: self.target.folded()? })
    }

    /// Integrates to a time, or until the two have almost met; `seen` gets every state on the way.
    ///
    /// # Errors
    /// Laws without a value, and a course that the steps do not follow.
    pub fn follow<N: Real>(
        &self,
        start: PursuitState<N>,
        until: Option<N>,
        seen: &mut dyn FnMut(&PursuitState<N>),
    ) -> Result<(PursuitState<N>, bool), Diagnostic> {
        let (unit, near) = fineness::<N>();
        let (first, laws) = (self.start::<N>()?.distance(), self.folded::<N>()?);
        let mut here = start;
        let mut wish: Option<f64> = None;
        // The number of steps that may be rejected as too long, in total.
        let mut budget = MOST_STEPS;
        let mut slower = 0;
        seen(&here);
        for _ in 0..if until.is_some() { MOST_STEPS } else { MOST_TO_MEET } {
            let l = here.distance();
            let left = until.map_or(f64::INFINITY, |u| (u - here.t).approx());
            if l <= near * first || left <= 0.0 {
                return Ok((here, l <= near * first));
            }
            let (v, b) = laws.rates(here.t)?;
            let (v, w) = (v.approx(), b[0].hypot(b[1]).approx());
            if v.is_nan() || v <= 0.0 {
                let t = here.t.approx();
                let message = both!("the pursuer's speed is {v} m/s at t = {t} s");
                return Err(Diagnostic::error("pursuit", message)
                    .help(both!("it must be greater than zero")));
            }
            if !(l.is_finite() && v.is_finite() && w.is_finite()) {
                break;
            }
            slower += usize::from(until.is_none() && v <= w);
            if slower > MOST_SLOWER {
                return Ok((here, false));
            }
            if until.is_none() && here.t.approx() > HORIZON * first / v {
                return Ok((here, false));
            }
            // Limits the step so that the two do not pass one another: at this rate they approach,
            // or the line between them turns.
            let [x, y] = here.d.map(|c| c.approx() / l);
            let (bx, by) = (b[0].approx(), b[1].approx());
            let most =
                0.5 * l / (v - bx * x - by * y).abs().max((bx * y - by * x).abs()).max(SLOWEST * v);
            let mut h = wish.unwrap_or(0.1 * l / v).min(most);
            let mut halved = false;
            let made = loop {
                // The last step ends exactly at the given time.
                let (by, last) = if h >= left * (1.0 - 1e-9) {
                    (until.map_or(N::from_f64(h), |u| u - here.t), true)
                } else {
                    (N::from_f64(h), false)
                };
                if let Some((d, error)) = laws.step(&here, by, 32.0 * unit * l.max(near * first))? {
                    let t = if last { until.unwrap_or(here.t + by) } else { here.t + by };
                    break Some(PursuitState {
                        t,
                        d,
                        error: here.error + error + 64.0 * unit * first,
                    });
                }
                h *= 0.5;
                halved = true;
                budget -= 1;
                if h < 1e-9 * most || budget == 0 {
                    break None;
                }
            };
            let Some(next) = made else { break };
            wish = Some(if halved { h } else { 2.0 * h });
            here = next;
            seen(&here);
        }
        let t = here.t.approx();
        let message = both!(
            "the pursuit is not followed beyond t = {t:.4e} s, where the two are {:.4e} m apart",
            here.distance()
        );
        let help = both!(
            "the steps of the integration become too small or too many; what holds at an earlier \"time\" can be asked"
        );
        Err(Diagnostic::error(LOST, message).help(help))
    }

    /// Returns the end of the pursuit: time and place of the meeting, if the two meet.
    ///
    /// # Errors
    /// The errors of [`Chase::follow`].
    pub fn end<N: Real + Into<Dd>>(&self) -> Result<PursuitEnd, Diagnostic> {
        self.end_seen::<N>(&mut |_| {})
    }

    /// Returns the end of the pursuit; `seen` gets every state on the way.
    ///
    /// # Errors
    /// The errors of [`Chase::follow`].
    pub fn end_seen<N: Real + Into<Dd>>(
        &self,
        seen: &mut dyn FnMut(&PursuitState<N>),
    ) -> Result<PursuitEnd, Diagnostic> {
        let (last, met) = self.follow(self.start::<N>()?, None, seen)?;
        if !met {
            return Ok(PursuitEnd::Apart { until: last.t.approx(), distance: last.distance() });
        }
        // The two meet after the rest of the way within these times, independent of the target's
        // motion.
        let (v, b) = self.folded()?.rates(last.t)?;
        let (v, w) = (v.approx(), b[0].hypot(b[1]).approx());
        let [low, high] = [
            (last.distance() - last.error).max(0.0) / (v + w),
            (last.distance() + last.error) / closing(v, w, last.d, b),
        ];
        let [low, high] = [low * 0.999, high * 1.001];
        let time = Ball::new(
            last.t.into() + Dd::from_f64(0.5 * (low + high)),
            0.5 * (high - low) + last.t.approx() * fineness::<N>().0 * 64.0,
        );
        let b = self.target.at(last.t)?;
        let place = [0, 1].map(|k| {
            Ball::new(
                b[k].0[0].into(),
                w * high + b[k].0[0].approx().abs() * fineness::<N>().0 * 64.0,
            )
        });
        Ok(PursuitEnd::Meet { time, place })
    }
}

/// Returns the least closing speed: a faster pursuer gains in any case; a slower one meets only a
/// target that runs toward it.
fn closing<N: Real>(v: f64, w: f64, d: [N; 2], b: [N; 2]) -> f64 {
    if v > w {
        return v - w;
    }
    let (x, y, l) = (d[0].approx(), d[1].approx(), d[0].hypot(d[1]).approx());
    0.5 * (v - (b[0].approx() * x + b[1].approx() * y) / l).abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particle::read;

    /// A pursuit on a circle of a target that is faster, as fast, or slower: after a bounded number
    /// of steps the result is a meeting, or the time to which the two have been followed.
    #[test]
    fn a_pursuit_without_an_end_is_told_soon() {
        for (speed, meets) in [(5.0, false), (8.99, false), (9.0, false), (12.0, true)] {
            let text = format!(
                r#"{{"points": {{"A": [0, 0]}}, "motions": [{{"point": "B", "centre": [0, 0], "radius": "100 m", "s": "9 m/s*t"}},
                {{"point": "A", "toward": "B", "speed": "{speed} m/s"}}], "find": ["T_AB", "l_AB"]}}"#
            );
            let problem = read(&text).unwrap_or_else(|f| panic!("{f}")).value;
            let (chase, _) = problem.motions.iter().find_map(|m| problem.chase(m)).unwrap();
            let mut steps = 0;
            let end = chase.end_seen::<f64>(&mut |_| steps += 1);
            assert!(steps <= MOST_TO_MEET + 1, "{speed} m/s: {steps} steps");
            assert_eq!(matches!(end, Ok(PursuitEnd::Meet { .. })), meets, "{speed} m/s: {end:?}");
        }
    }
}
