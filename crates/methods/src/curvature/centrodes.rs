//! Centrodes (瞬心线): the paths of a pole in the fixed and in the moving plane, through the travel of
//! a driver.
//!
//! A pole may run to infinity and return from the other side. Each pole is kept as it is computed,
//! P = B + i v/ω, as a ratio with its denominator ω: if ω changes its sign between two poses, the
//! path passes through infinity, and a figure draws it to the edge of the paper on both sides.

use hodograph_analytic as analytic;
use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::answer::MotionSource;
use hodograph_mechanism::mechanism::{Demand, Level, Need};
use hodograph_mechanism::position::Configuration;
use hodograph_scene::{GivenQuantity, LinkId, PointId, Scene};
use hodograph_sweep::follow::PoseFollower;
use hodograph_worked::worked::Worked;

/// The number of positions along a centrode: half degrees of one revolution, because the path bends
/// sharply where it runs through infinity.
pub const STEPS: usize = 720;

/// A pole at one position of the driver, in homogeneous coordinates: each place is a vector divided
/// by `omega`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoleStation {
    /// The travel of the driver from the scene's position (rad or m).
    pub travel: f64,
    /// ω relative to the other link, for a unit rate of the driver.
    pub omega: f64,
    /// ω times the place in the fixed plane (from the origin, m·rad/s).
    pub fixed: Vec2,
    /// ω times the place in the moving plane, in the pose of the scene.
    pub moving: Vec2,
    /// ω times the place in the axes of the link: from its first point, x toward its second.
    pub own: Vec2,
}

impl PoleStation {
    /// Returns the pole in the fixed plane; not finite if the link translates.
    pub fn pole(&self) -> Point {
        (self.fixed * (1.0 / self.omega)).to_point()
    }

    /// Returns the pole in the axes of the link.
    pub fn in_link(&self) -> Point {
        (self.own * (1.0 / self.omega)).to_point()
    }
}

/// The paths of the pole of a link.
#[derive(Clone, Debug, PartialEq)]
pub struct Centrodes {
    /// The link.
    pub link: LinkId,
    /// The reference link.
    pub against: LinkId,
    /// The poles in the order of the travel; `None` if no motion is determined (dead centres).
    pub stations: Vec<Option<PoleStation>>,
    /// True if the first station follows the last.
    pub closed: bool,
}

/// Follows the pole of a link through the travel of the first driver.
///
/// # Errors
/// `no-driver`, and `no-pole` if the link never turns.
pub fn centrodes(
    scene: &Scene,
    worked: &Worked,
    link: LinkId,
    against: LinkId,
    steps: usize,
) -> Result<Centrodes, Faults> {
    if scene.drivers.is_empty() {
        return Err(Diagnostic::error("no-driver", both!("the scene has no driver")).into());
    }
    let mut alone = scene.clone();
    for (d, of) in alone.drivers.iter_mut().enumerate() {
        let rate = if d == 0 { 1.0 } else { 0.0 };
        of.rate =
            GivenQuantity { value: rate, radius: 0.0, text: format!("{rate}"), span: of.rate.span };
        of.acceleration = None;
    }
    let mut demand = Demand::of_questions(&alone, &worked.mechanism, []);
    let links: Vec<LinkId> = [link, against].into_iter().filter(|l| *l != scene.ground).collect();
    for l in &links {
        demand.add(&alone, &worked.mechanism, Need::Turning(*l), Level::Velocity);
        for p in &scene.links[l.0].points {
            demand.add(&alone, &worked.mechanism, Need::Point(*p, None), Level::Velocity);
        }
    }
    let demand = demand.with_all_positions();
    let follower =
        PoseFollower::new(&alone, &worked.mechanism, &worked.demand, &worked.configuration, 0);
    let sweep = follower.sweep(steps);
    let own: Vec<PointId> = scene.links[link.0].points.clone();
    let station = |travel: f64, at: &Configuration| {
        let solution = analytic::solve(&alone, &worked.mechanism, at, &demand)
            .ok()
            .filter(|s| s.refused.is_empty())?;
        let turning = |l: LinkId| {
            if l == scene.ground { Some(0.0) } else { solution.turning(Level::Velocity, l) }
        };
        let omega = turning(link)? - turning(against)?;
        let base = own.first().and_then(|p| at.points[p.0])?;
        let of = |l| solution.of_link(Level::Velocity, l, base);
        // ω (P − B) = i v in the plane; both links carry it back into the pose of the scene.
        let arm = (of(link)? - of(against)?).perp();
        let seen = |l: LinkId| Some((at.poses[l.0]?, worked.configuration.poses[l.0]?));
        let carried = |l: LinkId| {
            if l == scene.ground {
                return Some(arm + base.to_vec2() * omega);
            }
            let (now, then) = seen(l)?;
            let turn = then.axis.divide_by(now.axis);
            Some(
                (arm + (base - now.origin) * omega).rotate_by(turn) + then.origin.to_vec2() * omega,
            )
        };
        let axis = own
            .get(1)
            .and_then(|p| (at.points[p.0]? - base).unit())
            .or(at.poses[link.0].map(|p| p.axis))?;
        Some(PoleStation {
            travel,
            omega,
            fixed: carried(against)?,
            moving: carried(link)?,
            own: arm.divide_by(axis),
        })
    };
    let stations: Vec<Option<PoleStation>> =
        sweep.poses.iter().map(|p| station(p.travel, &p.configuration)).collect();
    if stations.iter().flatten().all(|s| s.omega == 0.0) {
        let name = scene.link_name(link);
        let d = Diagnostic::error(
            "no-pole",
            both!("link {name} does not turn: its pole lies at infinity"),
        );
        return Err(d.help(both!("choose a link that turns")).into());
    }
    Ok(Centrodes { link, against, stations, closed: sweep.full })
}
