//! The independent check: all constraint equations and their Jacobian at once.
//!
//! Unknown are the velocities (and accelerations) of every moving link, three numbers each, and of every pin that sits on
//! no link. The rows come from differentiating the constraint equations once and twice ([`rows`]); groups, legs, plan and
//! paper are not known here, and no relative-motion term (normal, Coriolis) is ever written down.
//!
//! # Source
//! Φ_q q̇ = −Φ_t, Φ_q q̈ = γ: E. J. Haug, *Computer Aided Kinematics and Dynamics of Mechanical Systems*, ch. 3.

mod blocks;
mod factor;
mod fork;
mod jet;
mod pose;
mod relation;
mod rows;
mod series;
mod singular;
mod words;

pub use fork::Decided;
pub use pose::{SingularKind, Singularity};

use crate::answer::Source;
use crate::diag::{Diagnostic, Faults};
use crate::geom::Vec2;
use crate::mechanism::{Demand, Level, Mechanism, Passive};
use crate::position::Configuration;
use crate::scene::{DriverKind, LinkId, PointId, Scene};
use nalgebra::{DMatrix, DVector, Dyn, LU};
use pose::Pose;
use singular::Blocks;

/// Velocities and accelerations of all links that the demand reaches.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// For each link: velocity and acceleration of its frame's origin, ω, α.
    links: Vec<Option<LinkMotion>>,
    /// For pins that sit on no link.
    bare: Vec<(PointId, Vec2, Vec2)>,
    /// Whether accelerations were asked for.
    level: Level,
    /// Places, for the vectors of further points.
    points: Vec<Option<crate::geom::Point>>,
    origins: Vec<Option<crate::geom::Point>>,
    ground: LinkId,
    carriers: Vec<Vec<LinkId>>,
    /// Estimated condition number of the scaled Jacobian (1-norm); infinite where it is singular.
    pub condition: f64,
    /// The parts that are singular in this pose and were answered by the next order of the equations, in solving order.
    pub singular: Vec<Singularity>,
    /// What the reader should know of the pose.
    pub notes: Vec<Diagnostic>,
    /// Number of unknowns.
    pub size: usize,
}

/// Motion of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkMotion {
    /// Velocity of the frame's origin (m/s).
    pub v: Vec2,
    /// ω (rad/s).
    pub omega: f64,
    /// Acceleration of the origin (m/s²).
    pub a: Vec2,
    /// α (rad/s²).
    pub alpha: f64,
}

/// Solves the loop equations of everything the demand reaches.
///
/// Where the Jacobian is singular the equations are carried to the next order ([`Singularity`]): a change point is answered
/// on the way that is meant, a driver at its limit by the way back.
///
/// # Errors
/// - `dead-centre`: the drivers cannot move the links through the pose, velocities are unbounded;
/// - `locked`: the pose can be assembled but not left as asked;
/// - `undetermined`: links can move while the drivers stand; `singular`: more than one freedom is open;
/// - `acceleration-undetermined`: velocities are finite, accelerations are not;
/// - `overflow`: numbers out of range.
pub fn solve(scene: &Scene, m: &Mechanism, at: &Configuration, demand: &Demand) -> Result<Solution, Faults> {
    let layout = rows::Layout::new(scene, m, at, demand);
    let n = layout.unknowns;
    let carriers = (0..scene.points.len()).map(|p| scene.carriers(PointId(p)).collect()).collect();
    let mut solution = Solution {
        links: vec![None; scene.links.len()],
        bare: Vec::new(),
        level: demand.level,
        points: at.points.clone(),
        origins: layout.origins.clone(),
        ground: scene.ground,
        carriers,
        condition: 1.0,
        singular: Vec::new(),
        notes: Vec::new(),
        size: n,
    };
    solution.links[scene.ground.0] = Some(LinkMotion { v: Vec2::ZERO, omega: 0.0, a: Vec2::ZERO, alpha: 0.0 });
    if demand.level == Level::Position || n == 0 {
        return Ok(solution);
    }
    let system = layout.rows(scene, at);
    if system.len() != n {
        return Err(Diagnostic::error("not-square", format!("{} equations for {n} unknowns", system.len())).into());
    }
    let mut jacobian = DMatrix::zeros(n, n);
    let mut rhs = DVector::zeros(n);
    for (i, row) in system.iter().enumerate() {
        for &(k, c) in &row.coefficients {
            jacobian[(i, k)] += c;
        }
        rhs[i] = row.rate;
    }
    let norm = one_norm(&jacobian);
    let lu = jacobian.clone().lu();
    let inverse_norm = inverse_one_norm(&lu, n);
    solution.condition = norm * inverse_norm;
    let pose = Pose { scene, at, demand, layout: &layout };
    if solution.condition > SUSPECT || solution.condition.is_nan() {
        let rounding = layout.rounding(at);
        let blocks = Blocks::new(&system, n, rounding, |b| pose.blur(b, rounding));
        if blocks.singular() {
            return pose.singular(&system, &blocks, solution).map_err(Faults::from);
        }
        solution.notes.extend(pose.near_singular(&system, &blocks, rounding, solution.condition));
    }
    let rates = refined(&jacobian, &lu, &rhs).ok_or_else(|| overflow(scene, &layout))?;
    let accelerations = if demand.level >= Level::Acceleration {
        let gamma = DVector::from_iterator(n, system.iter().map(|r| r.acceleration(&rates)));
        refined(&jacobian, &lu, &gamma).ok_or_else(|| overflow(scene, &layout))?
    } else {
        DVector::zeros(n)
    };
    layout.unpack(&rates, &accelerations, &mut solution);
    Ok(solution)
}

/// Above this condition number the blocks are looked at one by one: below it, double precision leaves ten digits even where
/// it counts twice (a pose by lengths near its limit), which is more than is printed.
const SUSPECT: f64 = 1e4;

impl Solution {
    /// The largest vector (m/s, m/s²) or the largest turning (rad/s, rad/s²) of a level among all links, for accelerations
    /// the normal ones included: what a small answer is judged by where nothing was drawn.
    pub fn largest(&self, level: Level, turning: bool) -> f64 {
        let moving = || self.links.iter().flatten();
        let acceleration = level == Level::Acceleration;
        if turning {
            let of = |m: &LinkMotion| if acceleration { m.alpha.abs().max(m.omega * m.omega) } else { m.omega.abs() };
            return moving().map(of).fold(0.0, f64::max);
        }
        let of_points = (0..self.points.len()).filter_map(|p| self.vector(level, PointId(p), None)).map(Vec2::norm);
        let of_links = moving().map(|m| if acceleration { m.a.norm() } else { m.v.norm() });
        of_points.chain(of_links).fold(0.0, f64::max)
    }
}

fn one_norm(m: &DMatrix<f64>) -> f64 {
    m.column_iter().map(|c| c.iter().map(|x| x.abs()).sum::<f64>()).fold(0.0, f64::max)
}

/// ‖J⁻¹‖₁ by Hager's estimate.
///
/// # Source
/// W. W. Hager, *Condition estimates*, SIAM J. Sci. Stat. Comput. 5 (1984); N. J. Higham, *Accuracy and Stability*, §15.
fn inverse_one_norm(lu: &LU<f64, Dyn, Dyn>, n: usize) -> f64 {
    let (l, u, p) = (lu.l(), lu.u(), lu.p());
    let solve = |b: &DVector<f64>| lu.solve(b);
    let solve_transposed = |b: &DVector<f64>| -> Option<DVector<f64>> {
        let mut y = u.tr_solve_upper_triangular(b).and_then(|y| l.tr_solve_lower_triangular(&y))?;
        p.inv_permute_rows(&mut y);
        Some(y)
    };
    let mut x = DVector::from_element(n, 1.0 / n as f64);
    let mut estimate = 0.0f64;
    for _ in 0..5 {
        let Some(y) = solve(&x) else { return f64::INFINITY };
        let norm = y.iter().map(|v| v.abs()).sum::<f64>();
        if !norm.is_finite() {
            return f64::INFINITY;
        }
        let Some(z) = solve_transposed(&y.map(|v| if v >= 0.0 { 1.0 } else { -1.0 })) else { return f64::INFINITY };
        let (best, big) = z.iter().enumerate().fold((0, 0.0), |(i, b), (k, v)| if v.abs() > b { (k, v.abs()) } else { (i, b) });
        if norm <= estimate || big <= z.dot(&x) {
            return estimate.max(norm);
        }
        estimate = norm;
        x = DVector::zeros(n);
        x[best] = 1.0;
    }
    estimate
}

/// Solves and refines once, which makes the result as good as the data where the matrix is badly scaled.
fn refined(a: &DMatrix<f64>, lu: &LU<f64, Dyn, Dyn>, b: &DVector<f64>) -> Option<DVector<f64>> {
    let mut x = lu.solve(b)?;
    let r = b - a * &x;
    x += lu.solve(&r)?;
    x.iter().all(|v| v.is_finite()).then_some(x)
}

fn overflow(scene: &Scene, layout: &rows::Layout) -> Diagnostic {
    let names: Vec<_> = layout.links.iter().map(|l| scene.link_name(*l)).collect();
    Diagnostic::error("overflow", format!("the numbers of links {} are too large or too small to be solved", names.join(", ")))
}

impl Source for Solution {
    fn vector(&self, level: Level, p: PointId, on: Option<LinkId>) -> Option<Vec2> {
        if level > self.level {
            return None;
        }
        if let Some((_, v, a)) = self.bare.iter().find(|b| b.0 == p)
            && on.is_none()
        {
            return Some(if level == Level::Velocity { *v } else { *a });
        }
        let link = match on {
            Some(l) => l,
            None => *self.carriers[p.0].iter().find(|l| self.links[l.0].is_some())?,
        };
        if link == self.ground {
            return Some(Vec2::ZERO);
        }
        let motion = self.links[link.0]?;
        let r = self.points[p.0]? - self.origins[link.0]?;
        Some(match level {
            Level::Velocity => motion.v + r.perp() * motion.omega,
            _ => motion.a + r.perp() * motion.alpha - r * (motion.omega * motion.omega),
        })
    }

    fn turning(&self, level: Level, link: LinkId) -> Option<f64> {
        let m = self.links[link.0]?;
        Some(if level == Level::Velocity { m.omega } else { m.alpha })
    }
}

/// Which links take part: those of demanded groups, and the numbered ones that follow them.
fn taking_part(scene: &Scene, m: &Mechanism, at: &Configuration, demand: &Demand) -> Vec<LinkId> {
    let reached = |l: LinkId| m.group_of_link[l.0].is_some_and(|g| demand.wants(g, Level::Velocity));
    (0..scene.links.len())
        .map(LinkId)
        .filter(|&l| l != scene.ground && at.poses[l.0].is_some())
        .filter(|&l| match m.passive[l.0] {
            None => reached(l),
            Some(Passive::Block(g)) => {
                let guide = &scene.guides[g.0];
                let pin = guide.pin.is_some_and(|p| m.group_of_pin[p.0].is_some_and(|g| demand.wants(g, Level::Velocity)));
                pin && (guide.on == scene.ground || reached(guide.on))
            }
            Some(Passive::Cylinder(d)) => match scene.drivers[d].kind {
                DriverKind::Cylinder { a, b, .. } => {
                    [a, b].iter().all(|p| m.group_of_pin[p.0].is_some_and(|g| demand.wants(g, Level::Velocity)))
                }
                _ => false,
            },
        })
        .collect()
}
