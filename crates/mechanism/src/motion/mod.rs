//! The Assur program: velocities and accelerations group after group, for any number type.
//!
//! The links and pins of a group are the unknowns of one small linear system ([`conditions`]);
//! everything upstream is known. The cost grows linearly with the number of groups, and only the
//! groups that the demand covers are solved. The formulas are written over [`Real`]: in numbers
//! that know their error every answer has an error bound.
//!
//! This module and the loop equations of `analytic` do not use each other: all rows at once in
//! `f64` check the drawing, and the solution group by group in the precision ladder certifies the
//! printed digits.

pub(crate) mod conditions;
mod forces;

use crate::answer::MotionSource;
use crate::mechanism::{Demand, Level, Mechanism, Passive};
use crate::position::{AssemblyNumber, Configuration};
use conditions::Conditions;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::{Ball, Big, Dd, Real};
use hodograph_scene::exact::Inputs;
use hodograph_scene::quantity::Forces;
use hodograph_scene::{LinkId, PointId, Scene};

/// Motion of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkMotion<N = f64> {
    /// A point of the link (m).
    pub at: Point<N>,
    /// Velocity of the point (m/s).
    pub v: Vec2<N>,
    /// ω (rad/s), counter-clockwise positive.
    pub omega: N,
    /// Acceleration of the point (m/s²).
    pub a: Vec2<N>,
    /// α (rad/s²), counter-clockwise positive.
    pub alpha: N,
}

impl<N: Real> LinkMotion<N> {
    /// Returns a motion at rest.
    pub fn rest(at: Point<N>) -> Self {
        let zero = N::from_f64(0.0);
        LinkMotion { at, v: Vec2::zero(), omega: zero, a: Vec2::zero(), alpha: zero }
    }

    /// Returns the velocity of the link's point at a position: v + ω × r.
    pub fn velocity_at(&self, place: Point<N>) -> Vec2<N> {
        self.v + (place - self.at).perp() * self.omega
    }

    /// Returns the acceleration of the link's point at a position: a + α × r − ω² r.
    pub fn acceleration_at(&self, place: Point<N>) -> Vec2<N> {
        let r = place - self.at;
        self.a + r.perp() * self.alpha - r * (self.omega * self.omega)
    }
}

/// Motion of everything that the demand covers.
#[derive(Clone, Debug, PartialEq)]
pub struct MechanismMotion<N = f64> {
    links: Vec<Option<LinkMotion<N>>>,
    /// For each pin velocity and acceleration (m/s, m/s²).
    pins: Vec<Option<(Vec2<N>, Vec2<N>)>>,
    points: Vec<Option<Point<N>>>,
    carriers: Vec<Vec<LinkId>>,
    /// Number of groups solved, for velocities and for accelerations.
    pub groups: [usize; 2],
    /// Groups (indices into [`Mechanism::groups`]) without a unique solution in these numbers.
    pub singular: Vec<usize>,
    /// Reactions and balancing moments, if requested and determined.
    forces: Option<Forces<N>>,
    /// The group that has no equilibrium in the pose, if forces are requested: its reactions are
    /// unbounded, or not determined.
    pub unbalanced: Option<usize>,
}

/// A number type in which motions are solved: [`solve`] as a method of it, compiled here once and
/// not in every calling crate (see [`AssemblyNumber`]).
pub trait MotionNumber: AssemblyNumber {
    /// See [`solve`].
    fn solve(
        scene: &Scene,
        m: &Mechanism,
        at: &Configuration<Self>,
        demand: &Demand,
    ) -> MechanismMotion<Self>;
}

macro_rules! compiled {
    ($($number:ty),*) => {$(
        impl MotionNumber for $number {
            fn solve(scene: &Scene, m: &Mechanism, at: &Configuration<Self>, demand: &Demand) -> MechanismMotion<Self> {
                solved(scene, m, at, demand)
            }
        }
    )*};
}

compiled!(f32, f64, Dd, Big, Ball<f64>, Ball<Dd>, Ball<Big>);

/// Solves the groups that the demand covers, each up to its requested level.
///
/// A group with a pivot that may be zero (a dead centre, a change point, or a pose too close to one
/// for the number type) stays without motion and is listed in [`MechanismMotion::singular`], as is
/// everything that depends on it.
pub fn solve<N: MotionNumber>(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration<N>,
    demand: &Demand,
) -> MechanismMotion<N> {
    N::solve(scene, m, at, demand)
}

fn solved<N: Real>(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration<N>,
    demand: &Demand,
) -> MechanismMotion<N> {
    let mut motion = MechanismMotion {
        links: vec![None; scene.links.len()],
        pins: vec![None; scene.points.len()],
        points: at.points.clone(),
        carriers: (0..scene.points.len()).map(|p| scene.carriers(PointId(p)).collect()).collect(),
        groups: [0, 0],
        singular: Vec::new(),
        forces: None,
        unbalanced: None,
    };
    let mut missing = vec![false; m.groups.len()];
    motion.links[scene.ground.0] = Some(LinkMotion::rest(Point::origin()));
    let inputs = Inputs::of(scene);
    for (g, group) in m.groups.iter().enumerate() {
        if !demand.wants(g, Level::Velocity) {
            continue;
        }
        missing[g] = group.upstream.iter().any(|u| missing[*u]);
        if missing[g] {
            continue;
        }
        let conditions = Conditions::of_group(scene, m, at, &inputs, group, &motion);
        let Some(both) = conditions.solve(demand.wants(g, Level::Acceleration)) else {
            missing[g] = true;
            motion.singular.push(g);
            continue;
        };
        motion.groups[0] += 1;
        motion.groups[1] += usize::from(demand.wants(g, Level::Acceleration));
        conditions.store(&both, &mut motion);
    }
    for l in (0..scene.links.len()).map(LinkId) {
        if let Some(passive) = m.passive[l.0] {
            motion.links[l.0] = motion.following(scene, at, (l, passive));
        }
    }
    if demand.wants_forces() {
        match forces::forces(scene, m, at, demand, &motion) {
            Ok(forces) => motion.forces = Some(forces),
            Err(group) => motion.unbalanced = group,
        }
    }
    motion
}

impl<N: Real> MechanismMotion<N> {
    /// Returns the motion of a pose at rest.
    fn at_rest(scene: &Scene, at: &Configuration<N>) -> MechanismMotion<N> {
        MechanismMotion {
            links: vec![Some(LinkMotion::rest(Point::origin())); scene.links.len()],
            pins: vec![Some((Vec2::zero(), Vec2::zero())); scene.points.len()],
            points: at.points.clone(),
            carriers: Vec::new(),
            groups: [0, 0],
            singular: Vec::new(),
            forces: None,
            unbalanced: None,
        }
    }

    /// Returns velocity and acceleration of a pin, or of a point that only one link carries.
    fn at_point(&self, p: PointId) -> Option<(Vec2<N>, Vec2<N>)> {
        self.pins[p.0].or_else(|| {
            let place = self.points[p.0]?;
            let link = self.carriers[p.0].iter().find_map(|l| self.links[l.0])?;
            Some((link.velocity_at(place), link.acceleration_at(place)))
        })
    }

    /// Returns the motion of a passive link: a block turns with its guide, or with the radius to
    /// its pin; barrel and rod turn with the line of their cylinder, each about its own pin.
    fn following(
        &self,
        scene: &Scene,
        at: &Configuration<N>,
        (l, passive): (LinkId, Passive),
    ) -> Option<LinkMotion<N>> {
        match passive {
            Passive::Block(g) => {
                let guide = &scene.guides[g.0];
                let pin = guide.pin?;
                let ((v, a), place, on) =
                    (self.at_point(pin)?, at.points[pin.0]?, self.links[guide.on.0]?);
                let (omega, alpha) = match at.guides[g.0]? {
                    crate::position::Path::Line { .. } => (on.omega, on.alpha),
                    crate::position::Path::Arc { centre, .. } => turning_of_line(
                        place - centre,
                        v - on.velocity_at(centre),
                        a - on.acceleration_at(centre),
                    ),
                };
                Some(LinkMotion { at: place, v, omega, a, alpha })
            }
            Passive::Cylinder(d) => {
                let [a, b] = scene.drivers[d].kind.ends_of(l)?;
                self.of_line(at, a, b)
            }
            Passive::Held(a, b) => self.of_line(at, a, b),
        }
    }

    /// Returns the motion of the line of two points.
    fn of_line(&self, at: &Configuration<N>, a: PointId, b: PointId) -> Option<LinkMotion<N>> {
        let ((va, aa), (vb, ab)) = (self.at_point(a)?, self.at_point(b)?);
        let place = at.points[a.0]?;
        let (omega, alpha) = turning_of_line(at.points[b.0]? - place, vb - va, ab - aa);
        Some(LinkMotion { at: place, v: va, omega, a: aa, alpha })
    }
}

/// Returns (ω, α) of the line d whose end moves with v and a relative to its start: ω d² = d × v, α
/// d² = d × a − 2 ω d·v.
fn turning_of_line<N: Real>(d: Vec2<N>, v: Vec2<N>, a: Vec2<N>) -> (N, N) {
    let d2 = d.norm2();
    let omega = d.cross(v) / d2;
    let two = N::from_f64(2.0);
    (omega, (d.cross(a) - two * omega * d.dot(v)) / d2)
}

impl<N: Real> MotionSource<N> for MechanismMotion<N> {
    fn vector(&self, level: Level, p: PointId, on: Option<LinkId>) -> Option<Vec2<N>> {
        let (v, a) = match on {
            None => self.at_point(p)?,
            Some(l) => {
                let (link, place) = (self.links[l.0]?, self.points[p.0]?);
                (link.velocity_at(place), link.acceleration_at(place))
            }
        };
        Some(if level == Level::Velocity { v } else { a })
    }

    fn turning(&self, level: Level, link: LinkId) -> Option<N> {
        let m = self.links[link.0]?;
        Some(if level == Level::Velocity { m.omega } else { m.alpha })
    }

    fn forces(&self) -> Option<&Forces<N>> {
        self.forces.as_ref()
    }
}
