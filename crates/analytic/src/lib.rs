//! The independent check: all constraint equations and their Jacobian at once.
//!
//! The unknowns are the velocities (and accelerations) of every moving link, three numbers each,
//! and of every pin that is on no link. The rows come from differentiating the constraint equations
//! once and twice ([`rows`]). This crate does not use groups, legs, the construction plan or the
//! paper, and contains no formula of a relative-motion term (normal, Coriolis): [`asked`] derives
//! requested terms from rows of the same kinds.
//!
//! # Source
//! Φ_q q̇ = −Φ_t, Φ_q q̈ = γ: E. J. Haug, *Computer Aided Kinematics and Dynamics of Mechanical
//! Systems*, ch. 3.

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// The compiler then reports every match that an added kind affects.
#![warn(clippy::wildcard_enum_match_arm)]
// clippy.toml lists the functions of f64 whose last bit depends on the platform; tests may use
// them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The module overviews name private modules too; `cargo doc --document-private-items` follows those
// links.
#![allow(rustdoc::private_intra_doc_links)]

mod asked;
mod blocks;
mod cams;
mod factor;
mod forces;
mod fork;
mod jet;
mod pose;
mod relation;
mod rows;
mod series;
mod singular;
mod staged;
mod third;
mod words;

pub use fork::Decided;
pub use pose::{NearSingular, RefusedPart, SingularKind, Singularity};
pub use singular::RefusalReason;
pub use third::third;

use hodograph_base::budget::spend;
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::linear::LinearSystem;
use hodograph_mechanism::answer::MotionSource;
use hodograph_mechanism::mechanism::{Demand, Level, Mechanism, Passive};
use hodograph_mechanism::position::Configuration;
use hodograph_scene::quantity::Forces;
use hodograph_scene::{LinkId, PointId, Scene};
use nalgebra::{DMatrix, DVector};
use pose::PosedLayout;
use singular::Blocks;
use staged::{LARGE, StagedFactors};

// Compiled again when its Chinese texts change.
const _: &str = include_str!("../po/zh.po");

/// Velocities and accelerations of all links that the demand covers, each up to its requested
/// level.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    links: Vec<Option<LinkRates>>,
    /// Velocities and accelerations of pins that are on no link.
    bare: [Vec<(PointId, Vec2)>; 2],
    /// For velocities and for accelerations, the first solved link that carries each point.
    point_links: [Vec<Option<LinkId>>; 2],
    /// Positions, for the vectors of further points.
    points: Vec<Option<Point>>,
    origins: Vec<Option<Point>>,
    ground: LinkId,
    /// Estimated condition number of the scaled Jacobian (1-norm); infinite if it is singular.
    pub condition: f64,
    /// The parts that are singular in this pose and are solved by the next order of the equations,
    /// in solving order.
    pub singular: Vec<Singularity>,
    /// The parts without a motion in this pose (dead centres and the like), in solving order.
    pub refused: Vec<RefusedPart>,
    /// The parts that are nearly singular, the worst first; singular parts are not included.
    pub near: Vec<NearSingular>,
    /// Notes on the pose for the reader.
    pub notes: Vec<Diagnostic>,
    /// Number of unknowns, at velocity and at acceleration level.
    pub size: [usize; 2],
    /// Reactions and balancing moments, if requested and determined.
    forces: Option<Forces>,
}

/// Motion of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
struct LinkRates {
    /// Velocity of the frame's origin (m/s).
    v: Vec2,
    /// ω (rad/s).
    omega: f64,
    /// Acceleration of the origin (m/s²) and α (rad/s²), if requested.
    second: Option<(Vec2, f64)>,
}

/// Solves the loop equations of everything that the demand covers; accelerations only where
/// requested.
///
/// If the Jacobian is singular, the equations are continued to the next order ([`Singularity`]): a
/// change point is passed on the selected motion, a driver at its limit turns back. A part without
/// a motion, and everything that depends on it, stays unsolved and is listed in
/// [`Solution::refused`], with a note of one of these codes:
/// - `dead-centre`: the drivers cannot move the links through the pose, velocities are unbounded;
/// - `locked`: the pose can be assembled but not left in the requested sense;
/// - `undetermined`: links can move while the drivers rest;
/// - `singular`: more than one freedom is open;
/// - `acceleration-undetermined`: velocities are finite, accelerations are not.
///
/// # Errors
/// `overflow`: numbers out of range.
pub fn solve(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration,
    demand: &Demand,
) -> Result<Solution, Faults> {
    let mut solution = motion(scene, m, at, demand)?;
    if demand.wants_forces() {
        solution.forces = forces::forces(scene, m, at, demand, &solution);
    }
    Ok(solution)
}

/// Solves velocities and accelerations.
fn motion(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration,
    demand: &Demand,
) -> Result<Solution, Faults> {
    spend();
    let mut solution = Solution {
        links: vec![None; scene.links.len()],
        bare: [Vec::new(), Vec::new()],
        point_links: [Vec::new(), Vec::new()],
        points: Vec::new(),
        origins: Vec::new(),
        ground: scene.ground,
        condition: 1.0,
        singular: Vec::new(),
        refused: Vec::new(),
        near: Vec::new(),
        notes: Vec::new(),
        size: [0; 2],
        forces: None,
    };
    solution.links[scene.ground.0] =
        Some(LinkRates { v: Vec2::ZERO, omega: 0.0, second: Some((Vec2::ZERO, 0.0)) });
    if demand.level == Level::Position {
        return Ok(solution);
    }
    let layout = rows::UnknownLayout::new(scene, m, at, demand, Level::Velocity);
    solution.points.clone_from(&at.points);
    if layout.unknowns > 0 {
        let system = LoopSystem::new(scene, at, &layout)?;
        solution.condition = system.condition;
        solution.size[0] = layout.unknowns;
        if system.condition > SUSPECT || system.condition.is_nan() {
            let pose = PosedLayout { scene, at, demand, layout: &layout };
            let rounding = layout.rounding(at);
            let blocks =
                Blocks::new(&system.rows, layout.unknowns, rounding, |b| pose.blur(b, rounding));
            solution.near = pose.near(&system.rows, &blocks, rounding);
            if blocks.singular() {
                return Ok(pose.singular(&system.rows, &blocks, solution));
            }
        }
        let rhs = DVector::from_iterator(layout.unknowns, system.rows.iter().map(|r| r.rate));
        let rates = system.solve(&rhs).ok_or_else(|| overflow(scene, &layout))?;
        layout.unpack_rates(&rates, &mut solution);
        if layout.second {
            let gamma = system.solve(&system.gamma(&rates));
            layout.unpack_accelerations(
                &gamma.ok_or_else(|| overflow(scene, &layout))?,
                &mut solution,
            );
            solution.size[1] = layout.unknowns;
        } else if demand.level >= Level::Acceleration {
            // Parts for which only the velocity is requested are not in the second system.
            let part = rows::UnknownLayout::new(scene, m, at, demand, Level::Acceleration);
            if part.unknowns > 0 {
                let system = LoopSystem::new(scene, at, &part)?;
                let gamma = part
                    .rates_from(scene, at, &layout, &rates)
                    .and_then(|q| system.solve(&system.gamma(&q)));
                part.unpack_accelerations(
                    &gamma.ok_or_else(|| overflow(scene, &part))?,
                    &mut solution,
                );
                solution.size[1] = part.unknowns;
            }
        }
    }
    solution.settle(scene, &layout);
    Ok(solution)
}

/// Above this condition number the blocks are examined one by one: below it, double precision
/// leaves eleven digits, the accuracy promised if both methods agree.
const SUSPECT: f64 = 1e3;

/// The rows of a layout and its decomposed Jacobian.
struct LoopSystem {
    rows: Vec<relation::EquationRow>,
    factors: Factors,
    condition: f64,
}

/// A decomposed Jacobian.
enum Factors {
    Whole(LinearSystem),
    Staged(StagedFactors),
}

impl LoopSystem {
    /// Creates the system of a layout.
    ///
    /// # Errors
    /// The number of rows differs from the number of unknowns.
    fn new(
        scene: &Scene,
        at: &Configuration,
        layout: &rows::UnknownLayout,
    ) -> Result<LoopSystem, Faults> {
        LoopSystem::of_rows(layout.rows(scene, at), layout.unknowns)
    }

    /// Creates the system of some rows in `n` unknowns.
    ///
    /// # Errors
    /// The number of rows differs from the number of unknowns.
    fn of_rows(rows: Vec<relation::EquationRow>, n: usize) -> Result<LoopSystem, Faults> {
        if rows.len() != n {
            return Err(Diagnostic::error(
                "not-square",
                both!("{} equations for {n} unknowns", rows.len()),
            )
            .into());
        }
        if n >= LARGE {
            let staged = StagedFactors::new(&rows, n);
            let condition = staged.one_norm()
                * inverse_one_norm(&|b| staged.solve(b), &|b| staged.solve_transposed(b), n);
            return Ok(LoopSystem { rows, factors: Factors::Staged(staged), condition });
        }
        let mut jacobian = DMatrix::zeros(n, n);
        for (i, row) in rows.iter().enumerate() {
            for &(k, c) in &row.coefficients {
                jacobian[(i, k)] += c;
            }
        }
        let system = LinearSystem::new(jacobian);
        let condition = one_norm(system.matrix())
            * inverse_one_norm(&|b| system.solve(b), &|b| system.solve_transposed(b), n);
        Ok(LoopSystem { rows, factors: Factors::Whole(system), condition })
    }

    /// Solves and refines once; the result is then as accurate as the data even if the matrix is
    /// badly scaled.
    fn solve(&self, b: &DVector<f64>) -> Option<DVector<f64>> {
        let x = match &self.factors {
            Factors::Whole(system) => {
                let x = system.solve(b)?;
                let r = b - system.matrix() * &x;
                x + system.solve(&r)?
            }
            Factors::Staged(staged) => {
                let x = staged.solve(b)?;
                let r = staged.residual(&x, b);
                x + staged.solve(&r)?
            }
        };
        x.iter().all(|v| v.is_finite()).then_some(x)
    }

    /// Solves Jᵀ y = b, refined once.
    fn solve_transposed(&self, b: &DVector<f64>) -> Option<DVector<f64>> {
        let y = match &self.factors {
            Factors::Whole(system) => {
                let y = system.solve_transposed(b)?;
                let r = b - system.matrix().tr_mul(&y);
                y + system.solve_transposed(&r)?
            }
            Factors::Staged(staged) => staged.solve_transposed(b)?,
        };
        y.iter().all(|v| v.is_finite()).then_some(y)
    }

    /// Returns the right-hand side of the accelerations at the given rates.
    fn gamma(&self, rates: &DVector<f64>) -> DVector<f64> {
        DVector::from_iterator(self.rows.len(), self.rows.iter().map(|r| r.acceleration(rates)))
    }
}

fn one_norm(m: &DMatrix<f64>) -> f64 {
    m.column_iter().map(|c| c.iter().map(|x| x.abs()).sum::<f64>()).fold(0.0, f64::max)
}

/// A function that solves J x = b or Jᵀ x = b.
type LinearSolve<'a> = &'a dyn Fn(&DVector<f64>) -> Option<DVector<f64>>;

/// Returns ‖J⁻¹‖₁ by Hager's estimate.
///
/// # Source
/// W. W. Hager, *Condition estimates*, SIAM J. Sci. Stat. Comput. 5 (1984); N. J. Higham, *Accuracy
/// and Stability*, §15.
fn inverse_one_norm(solve: LinearSolve, solve_transposed: LinearSolve, n: usize) -> f64 {
    let mut x = DVector::from_element(n, 1.0 / n as f64);
    let mut estimate = 0.0f64;
    for _ in 0..5 {
        let Some(y) = solve(&x) else { return f64::INFINITY };
        let norm = y.iter().map(|v| v.abs()).sum::<f64>();
        if !norm.is_finite() {
            return f64::INFINITY;
        }
        let Some(z) = solve_transposed(&y.map(|v| if v >= 0.0 { 1.0 } else { -1.0 })) else {
            return f64::INFINITY;
        };
        let (best, big) = z
            .iter()
            .enumerate()
            .fold((0, 0.0), |(i, b), (k, v)| if v.abs() > b { (k, v.abs()) } else { (i, b) });
        if norm <= estimate || big <= z.dot(&x) {
            return estimate.max(norm);
        }
        estimate = norm;
        x = DVector::zeros(n);
        x[best] = 1.0;
    }
    estimate
}

fn overflow(scene: &Scene, layout: &rows::UnknownLayout) -> Diagnostic {
    let names: Vec<_> = layout.links.iter().map(|l| scene.link_name(*l)).collect();
    Diagnostic::error(
        "overflow",
        both!(
            "the numbers of links {} are too large or too small to be solved",
            Both::names(&names)
        ),
    )
}

impl Solution {
    /// Stores the origins of the links' vectors, and the link used for each point.
    fn settle(&mut self, scene: &Scene, layout: &rows::UnknownLayout) {
        self.origins.clone_from(&layout.origins);
        self.point_links = [false, true].map(|second| self.links_of_points(scene, second));
    }

    /// Returns the largest vector (m/s, m/s²) or the largest angular velocity or acceleration
    /// (rad/s, rad/s²) among all links; for accelerations the normal ones are included. Small
    /// answers without a drawing are judged by this value.
    pub fn largest(&self, level: Level, turning: bool) -> f64 {
        let moving = || self.links.iter().flatten();
        let acceleration = level == Level::Acceleration;
        if turning {
            let of = |m: &LinkRates| {
                if acceleration {
                    m.second.map_or(0.0, |s| s.1.abs()).max(m.omega * m.omega)
                } else {
                    m.omega.abs()
                }
            };
            return moving().map(of).fold(0.0, f64::max);
        }
        let of_points = (0..self.points.len())
            .filter_map(|p| self.vector(level, PointId(p), None))
            .map(Vec2::norm);
        let of_links = moving()
            .map(|m| if acceleration { m.second.map_or(0.0, |s| s.0.norm()) } else { m.v.norm() });
        of_points.chain(of_links).fold(0.0, f64::max)
    }

    /// Removes the singular and refused parts, if longer numbers show that they are not singular,
    /// and replaces the notes by those that `note` returns for the links in words.
    pub fn taken_for_singular(&mut self, note: impl Fn(&Both) -> Diagnostic) {
        let words =
            self.singular.drain(..).map(|s| s.words).chain(self.refused.drain(..).map(|r| r.words));
        self.notes = words.map(|w| note(&w)).collect();
    }

    fn links_of_points(&self, scene: &Scene, second: bool) -> Vec<Option<LinkId>> {
        let mut home = vec![None; scene.points.len()];
        // Points of the ground are exactly at rest.
        if self.links[scene.ground.0].is_some() {
            scene.links[scene.ground.0].points.iter().for_each(|p| home[p.0] = Some(scene.ground));
        }
        for (l, motion) in self.links.iter().enumerate() {
            if motion.is_some_and(|m| !second || m.second.is_some()) {
                for p in &scene.links[l].points {
                    home[p.0].get_or_insert(LinkId(l));
                }
            }
        }
        home
    }

    /// Returns true if the motion of a pin is solved up to a level.
    pub fn reaches_pin(&self, level: Level, p: PointId) -> bool {
        let slot = usize::from(level == Level::Acceleration);
        self.bare[slot].iter().any(|b| b.0 == p)
            || self.point_links[slot].get(p.0).is_some_and(|l| l.is_some())
    }

    /// Returns true if the motion of a link is solved up to a level.
    pub fn reaches(&self, level: Level, link: LinkId) -> bool {
        self.links[link.0].is_some_and(|m| level < Level::Acceleration || m.second.is_some())
    }
}

impl Solution {
    /// Returns the vector of the point of a moving link at a position.
    fn of_place(&self, level: Level, link: LinkId, place: Point) -> Option<Vec2> {
        let motion = self.links[link.0]?;
        let r = place - self.origins[link.0]?;
        Some(match level {
            Level::Velocity => motion.v + r.perp() * motion.omega,
            Level::Position | Level::Acceleration => {
                let (a, alpha) = motion.second?;
                a + r.perp() * alpha - r * (motion.omega * motion.omega)
            }
        })
    }
}

impl MotionSource for Solution {
    fn vector(&self, level: Level, p: PointId, on: Option<LinkId>) -> Option<Vec2> {
        let slot = usize::from(level == Level::Acceleration);
        if on.is_none()
            && let Some((_, v)) = self.bare[slot].iter().find(|b| b.0 == p)
        {
            return Some(*v);
        }
        let link = match on {
            Some(l) => l,
            None => (*self.point_links[slot].get(p.0)?)?,
        };
        if link == self.ground {
            return Some(Vec2::ZERO);
        }
        self.of_place(level, link, (*self.points.get(p.0)?)?)
    }

    fn turning(&self, level: Level, link: LinkId) -> Option<f64> {
        let m = self.links[link.0]?;
        if level == Level::Velocity { Some(m.omega) } else { m.second.map(|s| s.1) }
    }

    fn forces(&self) -> Option<&Forces> {
        self.forces.as_ref()
    }
}

/// Returns the links that take part at a level: those of groups requested so far, and the passive
/// links that follow them.
fn taking_part(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration,
    demand: &Demand,
    level: Level,
) -> Vec<LinkId> {
    let reached = |l: LinkId| m.group_of_link[l.0].is_some_and(|g| demand.wants(g, level));
    (0..scene.links.len())
        .map(LinkId)
        .filter(|&l| l != scene.ground && at.poses[l.0].is_some())
        .filter(|&l| match m.passive[l.0] {
            None => reached(l),
            Some(Passive::Block(g)) => {
                let guide = &scene.guides[g.0];
                let pin = guide
                    .pin
                    .is_some_and(|p| m.group_of_pin[p.0].is_some_and(|g| demand.wants(g, level)));
                pin && (guide.on == scene.ground || reached(guide.on))
            }
            Some(Passive::Cylinder(_) | Passive::Held(..)) => {
                let ends = m.line_of(scene, l).map(<[PointId; 2]>::from);
                ends.is_some_and(|ends| {
                    ends.iter().all(|p| m.group_of_pin[p.0].is_some_and(|g| demand.wants(g, level)))
                })
            }
        })
        .collect()
}
