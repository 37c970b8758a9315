//! The motion through a pose with a singular Jacobian: dead point, change point, limit of a driver.
//!
//! The unknown motion is a power series in time ([`MotionSeries`]). A block whose Jacobian has a
//! left null vector l and a right null vector z leaves one number open in every order, q̇ = p + y
//! z, and its equations must satisfy a condition before they can be solved:
//! - first order: l·Φ_t = 0, otherwise no velocity is finite: a *dead point*;
//! - second order: A y² + B y + C = 0: a *change point* if it has two roots (two motions go
//!   through the pose), no motion if it has none;
//! - each further order is linear with the slope 2 A y + B and gives the acceleration, the jerk
//!   etc.
//!
//! The same equation applies to a driver that is momentarily at rest at its own limit and turns
//! back (B = 0, C its acceleration), and to one that stays at rest (C = 0: all links rest).
//!
//! # Source
//! K. Wohlhart, *Degrees of shakiness*, Mech. Mach. Theory 34 (1999); A. Müller, *Higher-order
//! analysis of kinematic singularities of lower pair linkages and serial manipulators*, J. Mech.
//! Robotics 10 (2018).

use super::blocks::{EquationBlock, blocks};
use super::factor::Factor;
use super::relation::EquationRow;
use super::series::MotionSeries;
use nalgebra::{DMatrix, DVector};

/// The system in its blocks, each factored.
pub(super) struct Blocks {
    n: usize,
    pub list: Vec<FactoredBlock>,
}

/// A block with its factors and its rank.
pub(super) struct FactoredBlock {
    pub block: EquationBlock,
    pub factor: Factor,
    /// Number of its equations that follow from the others, within rounding.
    pub deficiency: usize,
    /// The accumulated rounding of the coefficients.
    data: f64,
}

/// The reason why a pose has no finite motion, or no unique one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RefusalReason {
    /// The motion of the drivers contradicts the pose: velocities grow without bound.
    DeadPoint,
    /// The pose can be assembled, but not left in the given sense.
    Locked,
    /// The links can move while the drivers rest.
    Loose,
    /// More than one freedom is open at once.
    Several,
    /// Velocities exist, but accelerations do not follow from the next order.
    NoAcceleration,
}

/// A block without a motion; blocks that depend on it have none either.
#[derive(Clone, Debug)]
pub(super) struct Refusal {
    pub block: usize,
    pub why: RefusalReason,
}

/// Two possible motions of a block.
pub(super) struct Fork<'a> {
    pub block: usize,
    /// Rates of all unknowns on each; zero for those that are not solved yet.
    pub ways: [DVector<f64>; 2],
    /// The motion solved so far, including the block.
    pub motion: &'a MotionSeries,
    /// True if the drivers are at rest, so that the motions differ by the sense of time only.
    pub turning: bool,
}

/// A singular block through which the motion is continued.
#[derive(Clone, Debug)]
pub(super) struct Passed {
    pub block: usize,
    /// True if everything in the block is at rest.
    pub rest: bool,
    /// True if the drivers are at rest, so that the motions differ by the sense of time only.
    pub turning: bool,
    /// Distance of the pose from one that is exactly singular (radians, or parts of the mechanism's
    /// size).
    pub off: f64,
}

/// The motion and the singular blocks that it passes.
pub(super) struct ContinuedMotion {
    pub motion: MotionSeries,
    pub passed: Vec<Passed>,
    pub refused: Vec<Refusal>,
}

impl Blocks {
    /// Decomposes and factors a system. `data` is the relative rounding of the coefficients;
    /// `bound_of` may return a larger bound for a block with a less accurate pose.
    pub fn new(
        rows: &[EquationRow],
        n: usize,
        data: f64,
        bound_of: impl Fn(&EquationBlock) -> f64,
    ) -> Blocks {
        let list = blocks(rows, n)
            .into_iter()
            .map(|block| {
                let size = block.unknowns.len();
                let mut a = DMatrix::zeros(size, size);
                for (i, r) in block.rows.iter().enumerate() {
                    for &(u, c) in &rows[*r].coefficients {
                        if let Ok(k) = block.unknowns.binary_search(&u) {
                            a[(i, k)] += c;
                        }
                    }
                }
                let reach = |u: usize| {
                    block.rows.iter().map(|r| rows[*r].relation.reach(u)).fold(0.0, f64::max)
                };
                let reach: Vec<f64> = block.unknowns.iter().map(|u| reach(*u)).collect();
                let factor = Factor::new(a, &reach);
                // A few rounding units of each coefficient add up over the unknowns.
                let data = 4.0 * size as f64 * data * factor.magnified;
                let deficiency = factor.deficiency(data.max(bound_of(&block)));
                FactoredBlock { block, factor, deficiency, data }
            })
            .collect();
        Blocks { n, list }
    }

    /// Returns true if any block is singular.
    pub fn singular(&self) -> bool {
        self.list.iter().any(|p| p.deficiency > 0)
    }

    /// Continues the motion through all blocks, up to `terms` terms (1: velocities, 2:
    /// accelerations too). The drives of the equations may differ from those of the factored
    /// equations. If two motions are possible, `pick` returns the index of the selected one.
    ///
    /// A block without a motion is refused and left without terms, as is everything that depends on
    /// it; the other blocks continue.
    pub fn carry(
        &self,
        rows: &[EquationRow],
        terms: usize,
        mut pick: impl FnMut(&Fork) -> usize,
    ) -> ContinuedMotion {
        let singular = self.list.iter().filter(|p| p.deficiency > 0).count();
        let mut out = ContinuedMotion {
            motion: MotionSeries::new(self.n),
            passed: Vec::new(),
            refused: Vec::new(),
        };
        for (i, part) in self.list.iter().enumerate() {
            let known = known_before(rows, part, &out.motion).unwrap_or(terms + singular);
            if known == 0 {
                continue;
            }
            let done = if part.deficiency == 0 {
                follow(rows, part, known, &mut out.motion)
            } else {
                self.pass(rows, i, known, &mut out.motion, &mut pick).and_then(|passed| {
                    out.passed.push(passed);
                    if out.motion.order(part.block.unknowns[0]) < terms {
                        Err(RefusalReason::NoAcceleration)
                    } else {
                        Ok(())
                    }
                })
            };
            if let Err(why) = done {
                // Velocities remain valid if only the accelerations do not follow.
                if why != RefusalReason::NoAcceleration {
                    part.block.unknowns.iter().for_each(|u| out.motion.forget(*u));
                }
                out.refused.push(Refusal { block: i, why });
            }
        }
        out
    }

    fn pass(
        &self,
        rows: &[EquationRow],
        index: usize,
        known: usize,
        motion: &mut MotionSeries,
        pick: &mut impl FnMut(&Fork) -> usize,
    ) -> Result<Passed, RefusalReason> {
        let part = &self.list[index];
        if part.deficiency > 1 {
            return Err(RefusalReason::Several);
        }
        if known < 2 {
            return Err(RefusalReason::NoAcceleration);
        }
        let z = part.factor.right().ok_or(RefusalReason::Several)?;
        let l = part.factor.left();
        let first = residuals(rows, part, motion, 1);
        let p = part.factor.solve(&-&first, true).ok_or(RefusalReason::Several)?;
        let still = first.amax() == 0.0;

        // Rates of the size of the driving rates; if nothing moves yet, of the size that the
        // acceleration produces.
        let at_p = second(rows, part, motion, &p);
        let unit = match p.amax().max(first.amax()) {
            0.0 if at_p.amax() == 0.0 => 1.0,
            0.0 => at_p.amax().sqrt(),
            rate => rate,
        };
        let (up, down) = (
            second(rows, part, motion, &(&p + &z * unit)),
            second(rows, part, motion, &(&p - &z * unit)),
        );
        let quadratic = (&up + &down - &at_p * 2.0) / (2.0 * unit * unit);
        let linear = (&up - &down) / (2.0 * unit);
        let (a, b, c) = (l.dot(&quadratic), l.dot(&linear), l.dot(&at_p));
        // l and z are as accurate as the pose, and a pose given by lengths is accurate at a limit
        // to the square root of their rounding.
        let blur = 16.0 * part.data.sqrt();
        // A form that consists of rounding errors has no size of its own: it is judged by the rates
        // from which it is computed.
        let zero = |value: f64, of: &DVector<f64>, made_of: f64| {
            value.abs() <= (blur * of.amax()).max(part.data * made_of)
        };
        let (no_a, no_b) = (zero(a, &quadratic, 1.0), zero(b, &linear, unit));
        let no_c = zero(c, &at_p, unit * unit);

        if still
            && at_p.amax() == 0.0
            && (3..=known).all(|n| residuals(rows, part, motion, n).amax() == 0.0)
        {
            if no_a {
                return Err(RefusalReason::Loose);
            }
            for n in 1..=known {
                set(part, motion, n, &DVector::zeros(z.len()));
            }
            return Ok(Passed { block: index, rest: true, turning: true, off: 0.0 });
        }
        // F(Y, t) = g t + A Y² + B Y t + C t²: the nearest pose at which both derivatives vanish is
        // at Y = −g B/D with the remainder g² A/D, D = B² − 4 A C. The pose is a change point only
        // if the remainder is rounding.
        let g = l.dot(&first);
        let d = b * b - 4.0 * a * c;
        let size = b * b + 4.0 * (a * c).abs();
        let agrees = g.abs() <= part.data * first.amax()
            || (d.abs() > blur * size
                && (g * g * a / d).abs() <= part.data
                && (g * b / d).abs() <= blur);
        if !agrees {
            return Err(RefusalReason::DeadPoint);
        }
        let mut rates = |y: f64| {
            set(part, motion, 1, &(&p + &z * y));
            DVector::from_iterator(self.n, (0..self.n).map(|u| motion.term(u, 1)))
        };
        let y = if no_a {
            match (no_b, no_c) {
                (false, _) => -c / b,
                (true, false) => return Err(RefusalReason::DeadPoint),
                (true, true) => return Err(RefusalReason::Loose),
            }
        } else if d.abs() <= blur * size {
            -b / (2.0 * a)
        } else if d < 0.0 {
            return Err(RefusalReason::Locked);
        } else {
            // The larger sum first, so that no digits cancel.
            let s = -0.5 * (b + d.sqrt().copysign(b));
            let roots = [s / a, c / s];
            let ways = roots.map(&mut rates);
            roots[pick(&Fork { block: index, ways, motion, turning: still }).min(1)]
        };
        set(part, motion, 1, &(&p + &z * y));
        let slope = 2.0 * a * y + b;
        if slope.abs() > blur * (a * y).abs().max(b.abs()) {
            for n in 2..known {
                let p = part
                    .factor
                    .solve(&-residuals(rows, part, motion, n), true)
                    .ok_or(RefusalReason::Several)?;
                set(part, motion, n, &p);
                let y = -l.dot(&residuals(rows, part, motion, n + 1)) / slope;
                set(part, motion, n, &(p + &z * y));
            }
        }
        let aside = if d == 0.0 { 0.0 } else { (g * b / d).abs() };
        Ok(Passed { block: index, rest: false, turning: still, off: part.factor.ratio.max(aside) })
    }
}

/// Continues the motion through a block that determines it.
fn follow(
    rows: &[EquationRow],
    part: &FactoredBlock,
    known: usize,
    motion: &mut MotionSeries,
) -> Result<(), RefusalReason> {
    for n in 1..=known {
        let c = part
            .factor
            .solve(&-residuals(rows, part, motion, n), false)
            .ok_or(RefusalReason::Several)?;
        set(part, motion, n, &c);
    }
    Ok(())
}

fn set(part: &FactoredBlock, motion: &mut MotionSeries, n: usize, c: &DVector<f64>) {
    for (u, value) in part.block.unknowns.iter().zip(c.iter()) {
        motion.set(*u, n, *value);
    }
}

/// Returns the number of known terms of the unknowns on which a block depends; `None` if it depends
/// on none.
fn known_before(
    rows: &[EquationRow],
    part: &FactoredBlock,
    motion: &MotionSeries,
) -> Option<usize> {
    let of = part.block.rows.iter().flat_map(|r| &rows[*r].coefficients).map(|c| c.0);
    of.filter(|u| part.block.unknowns.binary_search(u).is_err()).map(|u| motion.order(u)).min()
}

/// Returns the residuals of the block's equations in t^n.
fn residuals(
    rows: &[EquationRow],
    part: &FactoredBlock,
    motion: &MotionSeries,
    n: usize,
) -> DVector<f64> {
    DVector::from_iterator(
        part.block.rows.len(),
        part.block.rows.iter().map(|r| motion.residual(&rows[*r].relation, n)),
    )
}

/// Returns the residuals of the block in t² with the rates `c` and no acceleration of its own.
fn second(
    rows: &[EquationRow],
    part: &FactoredBlock,
    motion: &mut MotionSeries,
    c: &DVector<f64>,
) -> DVector<f64> {
    set(part, motion, 1, c);
    let left = residuals(rows, part, motion, 2);
    for u in &part.block.unknowns {
        motion.forget(*u);
    }
    left
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LoopSystem;
    use crate::rows::UnknownLayout;
    use hodograph_mechanism::mechanism::{Demand, Level, Mechanism};
    use hodograph_mechanism::position::configure;
    use hodograph_scene as scene;

    /// Returns the result for a four-bar in line whose pin C is offset by `off` from the line, with
    /// poses known to 1e-6.
    fn carried(link: u8, d: f64, off: f64) -> ContinuedMotion {
        carried_in(&format!(
            r#"{{"links": {{"1": ["A", "B"], "2": ["B", "C"], "3": ["D", "C"], "0": ["A", "D"]}}, "ground": "0", "units": {{"length": "m"}},
            "points": {{"A": [0, 0], "B": [1, 0], "C": [4, {off:e}], "D": [3, {d}]}}, "driver": {{"link": "{link}", "omega": "1 rad/s"}}, "find": ["omega_2"]}}"#
        ))
    }

    fn carried_in(text: &str) -> ContinuedMotion {
        let scene = scene::read(text).unwrap().value;
        let m = Mechanism::new(&scene).unwrap().value;
        let demand = Demand::of(&scene, &m);
        let at = configure(&scene, &m, &demand).unwrap().value;
        let layout = UnknownLayout::new(&scene, &m, &at, &demand, Level::Velocity);
        let Ok(system) = LoopSystem::new(&scene, &at, &layout) else { panic!("{text}") };
        Blocks::new(&system.rows, layout.unknowns, 1e-15, |_| 1e-6).carry(&system.rows, 2, |_| 0)
    }

    /// A change point is still recognized in a pose that deviates within its uncertainty; a dead
    /// point is refused.
    #[test]
    fn a_pose_that_is_known_roughly_is_passed_where_both_ways_lead_on() {
        for off in [0.0, 1e-14, -1e-11, 1e-9, -1e-9, 4e-9] {
            // A parallelogram: A, B, C and D in line.
            let through = carried(1, 0.0, off);
            assert!(
                through.refused.is_empty() && through.passed.len() == 1,
                "{off}: {:?}",
                through.refused.first().map(|r| r.why)
            );
            assert!(off == 0.0 || through.passed[0].off > 0.0, "{off}");
            // The rocker's drive at its limit: only A, B and C are in line.
            let dead = carried(3, -2.0, off);
            assert_eq!(
                dead.refused.iter().map(|r| r.why).collect::<Vec<_>>(),
                [RefusalReason::DeadPoint],
                "{off}"
            );
        }
    }

    /// Two sliders on parallel guides, joined by a rod square to them: both motions coincide, and
    /// accelerations do not follow.
    #[test]
    fn two_ways_that_are_one_within_what_is_known() {
        for off in [0.0, 1e-13, -1e-11, 1e-10, -1e-10, 1e-9] {
            let one = carried_in(&format!(
                r#"{{"links": {{"1": ["A", "B"], "0": ["O"]}}, "ground": "0", "units": {{"length": "m"}}, "points": {{"O": [-1, 0], "A": [0, 0], "B": [{off:e}, 3]}},
                "guides": [{{"pin": "A", "on": "0", "angle": "0 deg"}}, {{"pin": "B", "on": "0", "angle": "0 deg"}}],
                "driver": {{"slide": "A", "velocity": "1 m/s"}}, "find": ["v_B", "a_B"]}}"#
            ));
            assert_eq!(
                (one.passed.len(), one.refused.iter().map(|r| r.why).collect::<Vec<_>>()),
                (1, vec![RefusalReason::NoAcceleration]),
                "{off}"
            );
        }
    }
}
