//! Forces on the drawing board: the reactions of each group by moments and a force polygon, group
//! after group in the reverse of the kinematic order.
//!
//! The links of a dyad give parts of their outer reactions by moments, with arms measured on the
//! mechanism; the polygon of all forces on both links crosses the other two parts. The forces on
//! one link are adjacent in the polygon, so that the inner reaction is a diagonal. The reactions of
//! a group are loads of the links that hold it. The driver comes last, with the balancing moment.
//!
//! Methods: RRR, RRP, RPR, PRP and RPP dyads, a ram that moves a link, a link with a pivot or a
//! slide and one line of action (a pin in a slot, teeth, a cylinder), a link on three legs, two
//! links that two bars join, and drivers. A group of another kind is not drawn, and neither are
//! groups that bear its reactions; [`Equilibrium::undrawn`] names it.
//!
//! # Source
//! 孙桓, 陈作模, 葛文杰: 机械原理, ch. 4; R. L. Norton, *Design of Machinery*, ch. 11.

mod acts;
mod answers;
mod ground;
mod joints;
mod legs;
mod lever;
mod methods;
mod one_link;
mod posed;
mod ram;
mod ring;
mod scribe;
mod two_bars;

use posed::LoadedPose;

pub use acts::Act;
pub use ground::ForceTotals;
pub use lever::{Lever, LeverForce};

use crate::construct::scale::fitted;
use crate::construction::pencil::{Exact, Pencil};
use crate::construction::{Construction, DiagramId, DrawnPlaces, MarkId, NumberId, VectorId, draw};
use hodograph_base::diag::Both;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::kind::{ByKind, Kind};
use hodograph_base::number::Real;
use hodograph_mechanism::answer::MotionSource;
use hodograph_mechanism::force::{
    Cause, Load, Rubbing, completed, is_determined, loads, rubbing, settled, unit_balance,
    with_friction,
};
use hodograph_mechanism::mechanism::Mechanism;
use hodograph_mechanism::position::Configuration;
use hodograph_scene::quantity::{Forces, Wrench, parties};
use hodograph_scene::{GuideId, LinkId, PointId, RollingId, Scene};

/// A force in an equation of equilibrium.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForceTerm {
    /// A load: its index in [`Equilibrium::loads`].
    Load(usize),
    /// A reaction, or a part of it.
    Reaction {
        /// The party that presses.
        of: Party,
        /// The link on which it presses.
        on: LinkId,
        /// The part of the reaction.
        part: ReactionComponent,
    },
}

/// A party that presses on a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Party {
    /// A link.
    Link(LinkId),
    /// A pin that joins more than two links.
    Pin(PointId),
    /// A cylinder: its driver.
    Cylinder(usize),
    /// A driver that pushes.
    Driver(usize),
}

/// A part of a reaction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReactionComponent {
    /// The whole reaction.
    Whole,
    /// Along the bar; for a slide, square to the guide.
    Normal,
    /// Square to the bar; for a slide, along the guide.
    Tangential,
}

/// A force drawn from vertex to vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceEdge {
    /// The force.
    pub term: ForceTerm,
    /// A point on its line of action; for a guide, the reference point of its force.
    pub at: PointId,
    /// The vector.
    pub vector: VectorId,
    /// True if its magnitude is known before the polygon closes.
    pub known: bool,
}

/// The point about which moments are taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum About {
    /// A point of the scene.
    Point(PointId),
    /// The crossing of the lines of action of two forces.
    Crossing {
        /// The mark on the mechanism.
        at: MarkId,
        /// The forces.
        of: [ForceTerm; 2],
    },
}

/// An equation of moments about a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Moments {
    /// The links in equilibrium.
    pub links: Vec<LinkId>,
    /// The point about which moments are taken.
    pub about: About,
    /// The forces with a moment, each with its point of application and its moment (N·m).
    pub of: Vec<(ForceTerm, PointId, NumberId)>,
    /// The couples (N·m).
    pub couples: Vec<(ForceTerm, NumberId)>,
    /// The result.
    pub gives: MomentResult,
    /// The value of the result: a force (N), a couple or moment (N·m).
    pub value: NumberId,
}

/// The result of an equation of moments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MomentResult {
    /// A force on a link, at a point.
    Force(ForceTerm, PointId),
    /// The couple of a guide on its slider, which gives the line of action of its force.
    Offset(GuideId),
    /// The balancing moment of a driver.
    Driver(usize),
    /// A force that is assumed twice; the remaining moment is linear in it.
    Trial {
        /// The force.
        force: ForceTerm,
        /// The assumed magnitudes (N).
        tried: [NumberId; 2],
        /// The remaining moments (N·m).
        left: [NumberId; 2],
    },
}

/// The equilibrium of a group.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupForces {
    /// The links.
    pub links: Vec<LinkId>,
    /// The kind: `RRR`, `driver`.
    pub kind: &'static str,
    /// The polygon.
    pub diagram: DiagramId,
    /// The vertices in the order of the equation; each occurs once.
    pub vertices: Vec<MarkId>,
    /// The sides in the order of the equation.
    pub sides: Vec<ForceEdge>,
    /// Reactions that are diagonals of the polygon, and whole reactions of which parts are drawn.
    pub diagonals: Vec<ForceEdge>,
    /// The moments, in the order of drawing: those before the polygon, then those after it.
    pub moments: Vec<Moments>,
    /// The force along a driver's guide or cylinder: the driver and the number (N).
    pub drivers: Vec<(usize, NumberId)>,
}

/// A group that is not drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Undrawn {
    /// The links.
    pub links: Vec<LinkId>,
    /// The reason.
    pub why: Both,
}

/// The forces of a scene, written for the board and drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium {
    /// The loads; inertia follows from the accelerations of the polygon.
    pub loads: Vec<Load>,
    /// The acts.
    pub construction: Construction,
    /// The groups, the last group of the mechanism first.
    pub groups: Vec<GroupForces>,
    /// Groups that are not drawn.
    pub undrawn: Vec<Undrawn>,
    /// The scales of the plane and of the polygons.
    pub scales: ByKind,
    /// The places of marks and lines.
    pub drawn: DrawnPlaces,
    /// Reactions and balancing moments that the drawing gives.
    pub forces: Forces,
    /// The marks of the points on the plane.
    pub places: Vec<Option<MarkId>>,
    /// The numbers that the construction finds, by their meaning.
    answers: Answers,
    /// The sense in which each rolling pair presses along its tangent.
    senses: Vec<f64>,
    /// The pairs with friction.
    rubbing: Vec<Rubbing>,
}

/// The numbers that a construction of forces finds, by their meaning.
#[derive(Clone, Debug, Default, PartialEq)]
struct Answers {
    pins: Vec<(PointId, LinkId, NumberId)>,
    guides: Vec<(GuideId, NumberId, Option<NumberId>)>,
    rolling: Vec<(RollingId, NumberId)>,
    drivers: Vec<(usize, NumberId)>,
    balance: Option<NumberId>,
}

impl Equilibrium {
    /// Draws the forces of a scene: `motion` has the accelerations and velocities read from the
    /// polygons, `mu_l` is the scale of the mechanism, `room` the space (mm) for the largest
    /// polygon.
    ///
    /// `None` if a load is unknown because its motion is not drawn.
    pub fn of(
        scene: &Scene,
        m: &Mechanism,
        at: &Configuration,
        motion: &impl MotionSource<f64>,
        mu_l: f64,
        room: [f64; 2],
    ) -> Option<Equilibrium> {
        if !m.redundant.is_empty() {
            return None;
        }
        let given = loads(scene, at, motion)?;
        // A trial at 1 N/mm gives the size of the polygons.
        let trial_scales: ByKind = [(Kind::Length, mu_l), (Kind::Force, 1.0)].into_iter().collect();
        let tried = |loads: Vec<Load>| {
            let written = scribe::written(scene, m, at, &loads);
            let mut senses = vec![1.0; scene.rolling.len()];
            // Teeth press on one flank or the other; the load that a group puts on its teeth does
            // not depend on the previous groups.
            for _ in 0..=scene.rolling.len() {
                let givens =
                    LoadedPose { scene, at, loads: &loads, senses: &senses, extent: at.extent() };
                let drawn = draw(&written.construction, &givens, &trial_scales, &mut Exact).ok()?;
                let forces = read(scene, m, at, &loads, &written.answers, &drawn)?;
                let pressed = senses_of(scene, at, &forces);
                if pressed == senses {
                    return Some(ForceTrial { loads, written, senses, drawn, forces });
                }
                senses = pressed;
            }
            None
        };
        if !scene.loads.friction.is_empty() && !is_determined(scene, m) {
            return None;
        }
        let smooth = tried(given.clone())?;
        let (rubbing, _) = rubbing(scene, at, motion)?;
        let (power, ForceTrial { loads, written, senses, drawn: trial, .. }) = if rubbing.is_empty()
        {
            ((!scene.loads.friction.is_empty()).then_some(smooth.forces.power), smooth)
        } else {
            // Iteration: friction from the reactions of one polygon, then the next polygon with
            // this friction, until both agree.
            let under = |friction: &[Load]| {
                tried(given.iter().chain(friction).copied().collect()).ok_or(())
            };
            let read = |t: &ForceTrial| (t.forces.pins.clone(), t.forces.guides.clone());
            (Some(smooth.forces.power), settled(scene, &rubbing, under, read).ok()??)
        };
        let givens = LoadedPose { scene, at, loads: &loads, senses: &senses, extent: at.extent() };
        let extent = largest(&written.groups, &trial);
        let mu = fitted(&scene.paper, Kind::Force, extent, room);
        let scales: ByKind = [(Kind::Length, mu_l), (Kind::Force, mu)].into_iter().collect();
        let drawn = draw(&written.construction, &givens, &scales, &mut Exact).ok()?;
        // A division by an arm of zero leaves no drawing.
        if drawn.marks.iter().flatten().any(|mark| !mark.is_finite()) {
            return None;
        }
        let forces = read(scene, m, at, &loads, &written.answers, &drawn)?;
        let forces = Forces {
            guides: with_friction(forces.guides.clone(), &rubbing),
            smooth: power,
            ..forces
        };
        let scribe::ForceConstruction { construction, groups, undrawn, places, answers } = written;
        Some(Equilibrium {
            loads,
            construction,
            groups,
            undrawn,
            scales,
            drawn,
            forces,
            places,
            answers,
            senses,
            rubbing,
        })
    }

    /// Draws the forces once more with a pencil, under the loads of a motion that was read from
    /// polygons drawn with it. Friction keeps its forces.
    ///
    /// `None` if a load is unknown, or if the pencil made two lines parallel.
    pub fn by_hand<N: Real, P: Pencil<N>>(
        &self,
        scene: &Scene,
        m: &Mechanism,
        at: &Configuration<N>,
        motion: &impl MotionSource<N>,
        pencil: &mut P,
    ) -> Option<Forces<N>> {
        let mut given = loads(scene, at, motion)?.into_iter();
        let kept = |l: &Load| matches!(l.cause, Cause::Friction(_)).then(|| l.lift());
        let loads: Vec<Load<N>> =
            self.loads.iter().map(|l| kept(l).or_else(|| given.next())).collect::<Option<_>>()?;
        let rubbing: Vec<Rubbing<N>> = self.rubbing.iter().map(Rubbing::lift).collect();
        let givens =
            LoadedPose { scene, at, loads: &loads, senses: &self.senses, extent: at.extent() };
        let drawn = draw(&self.construction, &givens, &self.scales, pencil).ok()?;
        let forces = read(scene, m, at, &loads, &self.answers, &drawn)?;
        Some(Forces {
            guides: with_friction(forces.guides.clone(), &rubbing),
            smooth: self.forces.smooth.map(N::from_f64),
            ..forces
        })
    }

    /// Returns width and height of the largest polygon (mm).
    pub fn size_mm(&self) -> [f64; 2] {
        largest(&self.groups, &self.drawn)
    }

    /// Returns the scale of the polygons (N per mm).
    pub fn mu(&self) -> f64 {
        self.scales.get(Kind::Force).unwrap_or(1.0)
    }

    /// Returns a vector on its paper (mm): tail and tip.
    pub fn vector_mm(&self, vector: VectorId) -> Option<[Point; 2]> {
        let v = &self.construction.vectors[vector.index()];
        Some([self.drawn.marks[v.from.index()]?, self.drawn.marks[v.to.index()]?])
    }

    /// Returns a vector in N.
    pub fn force(&self, vector: VectorId) -> Option<Vec2> {
        let [from, to] = self.vector_mm(vector)?;
        Some((to - from) * self.mu())
    }

    /// Returns the drawing with its polygons at another scale (N per mm).
    pub fn to_scale(&self, mu: f64) -> Equilibrium {
        self.scaled(Kind::Force, self.mu() / mu)
    }

    /// Returns the drawing with the mechanism `times` times as large.
    pub fn enlarged(&self, times: f64) -> Equilibrium {
        self.scaled(Kind::Length, times)
    }

    fn scaled(&self, kind: Kind, times: f64) -> Equilibrium {
        let mut out = self.clone();
        let c = &self.construction;
        for (mark, at) in c.marks.iter().zip(&mut out.drawn.marks) {
            if c.diagrams[mark.on.index()].kind() == kind {
                *at = at.map(|p| (p.to_vec2() * times).to_point());
            }
        }
        out.scales.set(kind, self.scales.get(kind).map(|mu| mu / times));
        out
    }

    /// Returns the vertices of a group's polygon, relative to the first (N).
    pub fn vertices<'a>(&'a self, group: &'a GroupForces) -> impl Iterator<Item = Point> + 'a {
        group
            .vertices
            .iter()
            .filter_map(|v| Some((self.drawn.marks[v.index()]?.to_vec2() * self.mu()).to_point()))
    }

    /// Returns the group of some links.
    pub fn group_of(&self, links: &[LinkId]) -> Option<&GroupForces> {
        self.groups.iter().find(|g| g.links == links)
    }

    /// Returns the largest factor by which a crossing magnifies rounding errors.
    pub fn magnified(&self) -> f64 {
        self.drawn
            .met
            .iter()
            .map(|met| met.rounding / (met.sine.abs() * met.sine.abs()))
            .fold(1.0, f64::max)
    }
}

impl MotionSource<f64> for Equilibrium {
    fn vector(
        &self,
        _: hodograph_mechanism::mechanism::Level,
        _: PointId,
        _: Option<LinkId>,
    ) -> Option<Vec2> {
        None
    }

    fn turning(&self, _: hodograph_mechanism::mechanism::Level, _: LinkId) -> Option<f64> {
        None
    }

    fn forces(&self) -> Option<&Forces> {
        Some(&self.forces)
    }
}

/// The polygons at 1 N/mm under some loads.
struct ForceTrial {
    loads: Vec<Load>,
    written: scribe::ForceConstruction,
    senses: Vec<f64>,
    drawn: DrawnPlaces,
    forces: Forces,
}

/// Returns width and height of the largest polygon.
fn largest(groups: &[GroupForces], drawn: &DrawnPlaces) -> [f64; 2] {
    groups
        .iter()
        .map(|g| extent_of(g, drawn))
        .fold([0.0, 0.0], |[w, h], [x, y]| [f64::max(w, x), f64::max(h, y)])
}

/// Returns width and height of a polygon.
fn extent_of(group: &GroupForces, drawn: &DrawnPlaces) -> [f64; 2] {
    crate::construct::scale::extent(group.vertices.iter().filter_map(|v| drawn.marks[v.index()]))
}

/// Returns the forces that the drawing gives. Reactions of groups that are not drawn are missing.
fn read<N: Real>(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration<N>,
    loads: &[Load<N>],
    answers: &Answers,
    drawn: &DrawnPlaces<N>,
) -> Option<Forces<N>> {
    let zero = N::from_f64(0.0);
    let vector = |n: &NumberId| drawn.vector(*n);
    let mut pins: Vec<(PointId, LinkId, Vec2<N>)> =
        answers.pins.iter().filter_map(|(p, l, n)| Some((*p, *l, vector(n)?))).collect();
    // The last link on a pin of several links bears the forces of the others on the pin.
    for p in (0..scene.points.len())
        .map(PointId)
        .filter(|p| parties(scene, *p) > 2 && parties(scene, *p) == scene.carriers(*p).count())
    {
        let force = |l: LinkId| {
            pins.iter().find(|(at, on, _)| (*at, *on) == (p, l)).map(|(.., force)| *force)
        };
        let missing: Vec<LinkId> = scene.carriers(p).filter(|l| force(*l).is_none()).collect();
        if let [last] = missing[..] {
            let sum =
                scene.carriers(p).filter_map(force).fold(Vec2::zero(), |sum, force| sum - force);
            pins.push((p, last, sum));
        }
    }
    let guides: Vec<(GuideId, Wrench<N>)> = answers
        .guides
        .iter()
        .filter_map(|(g, force, couple)| {
            let couple = couple.map_or(Some(zero), |c| drawn.number(c))?;
            Some((*g, Wrench { force: vector(force)?, couple }))
        })
        .collect();
    // A path that keeps a wheel in contact presses at the same contact as the teeth or the
    // friction: both are one force.
    let held = |r: RollingId| match m.path_of(scene, r) {
        Some(guide) => guides.iter().find(|(own, _)| *own == guide).map(|(_, w)| w.force),
        None => Some(Vec2::zero()),
    };
    let pressed: Vec<(RollingId, Vec2<N>)> =
        answers.rolling.iter().filter_map(|(r, n)| Some((*r, vector(n)?))).collect();
    let rolling = pressed.iter().filter_map(|(r, force)| Some((*r, *force + held(*r)?))).collect();
    let mut drivers = Vec::new();
    for d in 0..scene.drivers.len() {
        let Some((_, n)) = answers.drivers.iter().find(|(own, _)| *own == d) else { break };
        drivers.push(drawn.number(*n)?);
    }
    let whole = drivers.len() == scene.drivers.len();
    let powers = scene.drivers.iter().zip(&drivers).map(|(d, x)| *x * N::from_f64(d.rate.value));
    let power = if whole { powers.fold(-zero, |sum, x| sum + x) } else { N::from_f64(f64::NAN) };
    let balance = answers.balance.and_then(|n| drawn.number(n));
    let mut loads = loads.to_vec();
    if let Some((unit, size)) = unit_balance(scene, at).zip(balance) {
        loads.push(Load {
            wrench: Wrench { force: unit.wrench.force * size, couple: unit.wrench.couple * size },
            ..unit
        });
        // With a balancing force the drivers exert no force.
        drivers.fill(zero);
    }
    let reactions = Forces {
        determinate: is_determined(scene, m),
        pins,
        guides,
        rolling,
        drivers,
        power,
        balance,
        ..Forces::none()
    };
    Some(completed(scene, at, &loads, reactions))
}

/// Returns the sense in which each pair presses along its tangent.
fn senses_of(scene: &Scene, at: &Configuration, forces: &Forces) -> Vec<f64> {
    let sense = |r: RollingId| {
        let (_, force) = forces.rolling.iter().find(|(own, _)| *own == r)?;
        Some(if force.dot(at.normal(scene, r)?.perp()) < 0.0 { -1.0 } else { 1.0 })
    };
    (0..scene.rolling.len()).map(|r| sense(RollingId(r)).unwrap_or(1.0)).collect()
}
