//! The balancing moment over a turn of the driver: its mean, the surplus of energy, the flywheel.
//!
//! A constant moment on the driver equal to the mean of the balancing moment M_b does the work of a
//! whole period; the surplus is E(φ) = ∫ (mean − M_b) dφ. A flywheel absorbs and returns its
//! greatest difference ΔW, J_F = ΔW / (ω² δ).
//!
//! Loads that act over a part of a stroke make M_b jump, and diagrams give it corners. These places
//! are located first, and Gauss' rule of eight points integrates the stretches between them.
//!
//! # Source
//! 孙桓, 陈作模, 葛文杰: 机械原理, ch. 7; R. L. Norton, *Design of Machinery*, ch. 11.

use super::PlacedScene;
use super::extreme::limits;
use super::follow::whole::DrivenMechanism;
use super::general::General;
use super::station::{Stations, angle_per_value, position_now};
use hodograph_analytic as analytic;
use hodograph_base::budget::spend;
use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_mechanism::answer::MotionSource;
use hodograph_mechanism::force::stretches;
use hodograph_mechanism::position;
use hodograph_scene::with_driver_at;
use std::f64::consts::TAU;

/// The work of the balancing moment over a period.
#[derive(Clone, Debug, PartialEq)]
pub struct Energy {
    /// The period of the driver (rad).
    pub period: f64,
    /// The mean balancing moment (N·m).
    pub mean: f64,
    /// The driver's angle at which the surplus is least, so that the driver runs slowest (rad).
    pub slowest: f64,
    /// The driver's angle at which it runs fastest (rad).
    pub fastest: f64,
    /// The greatest difference of the surplus, ΔW (J).
    pub surplus: f64,
}

impl Energy {
    /// Returns the moment of inertia (kg·m²) of the flywheel on the driver's shaft that keeps the
    /// coefficient of speed fluctuation δ at a mean speed ω (rad/s).
    pub fn flywheel(&self, omega: f64, delta: f64) -> f64 {
        self.surplus / (omega * omega * delta)
    }
}

/// The number of stretches in a turn before jumps are located.
const PANELS: usize = 72;

/// The tolerance to which an angle is located (rad).
const NARROW: f64 = 1e-14 * TAU;

/// Nodes and weights of Gauss' rule of eight points on −1..1.
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

/// The nodes in a stretch, in order, each with its weight.
fn nodes(a: f64, b: f64) -> [(f64, f64); 8] {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    std::array::from_fn(|i| {
        let (k, sign) = if i < 4 { (3 - i, -1.0) } else { (i - 4, 1.0) };
        (middle + sign * half * GAUSS[k].0, half * GAUSS[k].1)
    })
}

/// The angle up to which a condition holds, between one at which it does and one at which it does
/// not.
fn halved(
    [mut low, mut high]: [f64; 2],
    holds: impl Fn(f64) -> Result<bool, Faults>,
) -> Result<f64, Faults> {
    while high - low > NARROW {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if holds(middle)? { low = middle } else { high = middle }
    }
    Ok(0.5 * (low + high))
}

/// The balancing moment, and the stretches of the loads, as functions of the driver's angle.
struct BalancingMoment<'a> {
    placed: &'a PlacedScene<'a>,
    driver: usize,
    per_value: f64,
}

impl BalancingMoment<'_> {
    fn at(&self, angle: f64) -> Result<(f64, Vec<i32>), Faults> {
        spend();
        let p = self.placed;
        let general = General::new(p, self.driver);
        let stations = Stations::of_values(vec![angle], self.per_value);
        let scene = with_driver_at(p.scene, self.driver, stations.place(0, p.scene, self.driver));
        let at = match general.is_closed_everywhere() {
            true => position::recompute::<f64>(&scene, p.mechanism, &p.demand, &p.at)?,
            false => DrivenMechanism::new(p, self.driver).standing(angle)?,
        };
        let solution = analytic::solve(&scene, p.mechanism, &at, &p.demand)?;
        let none = || {
            let message = both!("the balancing moment has no value at {}°", angle.to_degrees());
            Diagnostic::error("no-moment", message)
        };
        let forces = solution.forces().ok_or_else(none)?;
        let moment = match forces.balance {
            Some(_) => forces.power / scene.drivers[self.driver].rate.value,
            None => *forces.drivers.get(self.driver).ok_or_else(none)?,
        };
        let stretches = stretches(&scene, &at, &solution).ok_or_else(none)?;
        if moment.is_finite() { Ok((moment, stretches)) } else { Err(none().into()) }
    }

    /// The stretches of a period in which M_b is smooth, none longer than a panel.
    fn parts(&self, start: f64, period: f64, count: usize) -> Result<Vec<[f64; 2]>, Faults> {
        let edge = |k: usize| start + period * k as f64 / count as f64;
        let mut edges: Vec<f64> = (0..=count).map(edge).collect();
        let places: Vec<f64> =
            (0..count).flat_map(|k| nodes(edge(k), edge(k + 1)).map(|n| n.0)).collect();
        let kinds =
            places.iter().map(|x| Ok(self.at(*x)?.1)).collect::<Result<Vec<_>, Faults>>()?;
        for k in 0..places.len() {
            // The first place follows the last.
            let next = (k + 1) % places.len();
            let to = places[next] + if next == 0 { period } else { 0.0 };
            if kinds[next] != kinds[k] {
                let change = halved([places[k], to], |x| Ok(self.at(x)?.1 == kinds[k]))?;
                edges.push(if change > start + period { change - period } else { change });
            }
        }
        edges.sort_by(f64::total_cmp);
        Ok(edges.windows(2).map(|w| [w[0], w[1]]).filter(|[a, b]| b > a).collect())
    }

    /// The integral of M_b.
    fn work(&self, [a, b]: [f64; 2]) -> Result<f64, Faults> {
        nodes(a, b).iter().try_fold(0.0, |sum, (x, weight)| Ok(sum + weight * self.at(*x)?.0))
    }
}

/// Returns the mean balancing moment and the surplus of energy over a period of a driver that turns
/// fully; `None` for a driver that does not.
///
/// # Errors
/// The errors of [`limits`]; a position in which the moment has no value.
pub fn energy(placed: &PlacedScene, driver: usize) -> Result<Option<Energy>, Faults> {
    let PlacedScene { scene, mechanism, .. } = placed;
    let all = limits(scene, mechanism, driver)?;
    if !scene.drivers[driver].kind.turns() || !all.range.full() || all.turns == 0 {
        return Ok(None);
    }
    let moment =
        BalancingMoment { placed, driver, per_value: angle_per_value(scene, &placed.at, driver) };
    let (start, period) = (position_now(scene, &placed.at, driver), TAU * all.seen as f64);
    let count = PANELS * all.seen as usize;
    let parts = moment.parts(start, period, count)?;
    let works = parts.iter().map(|part| moment.work(*part)).collect::<Result<Vec<f64>, _>>()?;
    let mean = works.iter().sum::<f64>() / period;
    // The surplus at the ends of the parts, and where M_b passes its mean.
    let mut surplus: Vec<(f64, f64)> = Vec::new();
    let mut so_far = 0.0;
    for ([a, b], work) in parts.iter().zip(&works) {
        surplus.push((*a, so_far));
        let inside = nodes(*a, *b);
        let mut last = (inside[0].0, moment.at(inside[0].0)?.0 - mean);
        for (x, _) in &inside[1..] {
            let here = moment.at(*x)?.0 - mean;
            if here * last.1 < 0.0 {
                let at = halved([last.0, *x], |x| Ok((moment.at(x)?.0 - mean) * last.1 > 0.0))?;
                let done = moment.work([*a, at])?;
                surplus.push((at, so_far + mean * (at - a) - done));
            }
            last = (*x, here);
        }
        so_far += mean * (b - a) - work;
    }
    let by = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
    let (Some(low), Some(high)) = (surplus.iter().min_by(by), surplus.iter().max_by(by)) else {
        return Ok(None);
    };
    Ok(Some(Energy { period, mean, slowest: low.0, fastest: high.0, surplus: high.1 - low.1 }))
}
