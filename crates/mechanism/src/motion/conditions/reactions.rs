//! Equilibrium of one group: the transposed system.
//!
//! Row i of the system is the condition c_i·q̇ = rate. Without friction its pair does work by that
//! rate only, so its reaction on the unknown k is λ_i c_ik, and equilibrium is Cᵀ λ = −Q with the
//! loads Q of the group.

use super::{ConditionPoint, Conditions, Lu, MotionCondition, own_point};
use crate::mechanism::GraphNode;
use crate::position::Configuration;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_scene::quantity::Wrench;
use hodograph_scene::{LinkId, PointId, Scene};

/// Forces that act on links and pins.
#[derive(Clone)]
pub(in crate::motion) struct ActingForces<N> {
    /// For each link one of its own points, about which its couple is taken.
    base: Vec<Point<N>>,
    pub links: Vec<Wrench<N>>,
    pub pins: Vec<Vec2<N>>,
}

impl<N: Real> ActingForces<N> {
    /// Returns zero forces.
    pub fn none(scene: &Scene, at: &Configuration<N>) -> ActingForces<N> {
        let base = |l: usize| match LinkId(l) == scene.ground || at.poses[l].is_none() {
            true => Point::origin(),
            false => own_point(scene, at, LinkId(l)),
        };
        ActingForces {
            base: (0..scene.links.len()).map(base).collect(),
            links: vec![Wrench::zero(); scene.links.len()],
            pins: vec![Vec2::zero(); scene.points.len()],
        }
    }

    /// Adds a force at a position of a link, with its couple about that position.
    pub fn on_link(&mut self, link: LinkId, place: Point<N>, wrench: Wrench<N>) {
        let moved = wrench.seen_at(place - self.base[link.0]);
        self.links[link.0] = self.links[link.0].plus(moved);
    }

    /// Returns the sum of the forces on a link, with its couple about a position.
    pub fn about(&self, link: LinkId, place: Point<N>) -> Wrench<N> {
        self.links[link.0].seen_at(self.base[link.0] - place)
    }

    /// Adds a force at a pin.
    pub fn on_pin(&mut self, pin: PointId, force: Vec2<N>) {
        self.pins[pin.0] += force;
    }
}

/// Reaction of one condition: the force (N) on its first point, or the couple on its first body.
#[derive(Clone, Copy)]
pub(in crate::motion) enum Reaction<N> {
    Force(Vec2<N>),
    /// The couple, for a factor of one.
    Couple(N),
}

impl<N: Real> Conditions<N> {
    /// Returns the constraint of each condition, and its reaction under the loads; the effect of
    /// the reactions upstream is added to `acting`.
    ///
    /// `None` if a pivot may be zero: the reactions are unbounded or not determined.
    pub(in crate::motion) fn reactions(
        &self,
        acting: &mut ActingForces<N>,
    ) -> Option<Vec<(usize, Reaction<N>)>> {
        let (n, zero, scale) = (self.unknowns, N::from_f64(0.0), N::from_f64(self.scale));
        if self.list.len() != n {
            return None;
        }
        let still = |x: &N| x.approx() == 0.0 && x.radius() == 0.0;
        let loads = self.loads(acting);
        let lambda = if loads.iter().all(still) {
            vec![zero; n]
        } else {
            let mut matrix = vec![zero; n * n];
            let mut row = vec![zero; n];
            for (i, condition) in self.list.iter().enumerate() {
                row.fill(zero);
                condition.row(&mut row);
                row.iter().enumerate().for_each(|(k, c)| matrix[k * n + i] = *c);
            }
            let mut lambda = loads;
            Lu::of(matrix, n)?.solve(&mut lambda);
            lambda
        };
        let mut out = Vec::with_capacity(n);
        for ((condition, of), l) in self.list.iter().zip(&self.of).zip(lambda) {
            let reaction = match condition {
                MotionCondition::Along { p, q, k: u, .. }
                | MotionCondition::Distance { p, q, u, .. } => {
                    let force = *u * (l * scale);
                    p.passed_on(force, acting);
                    q.passed_on(-force, acting);
                    Reaction::Force(force)
                }
                MotionCondition::Turning { bodies, .. } => {
                    for (body, factor) in bodies {
                        if let ConditionPoint::Known(_, GraphNode::Link(link)) = body {
                            acting.links[link.0].couple = acting.links[link.0].couple + *factor * l;
                        }
                    }
                    Reaction::Couple(l)
                }
            };
            out.push((*of, reaction));
        }
        Some(out)
    }

    /// Returns −Q, in the order of the unknowns: a force divided by the scale of lengths, a couple
    /// about the reference point of its link.
    fn loads(&self, acting: &ActingForces<N>) -> Vec<N> {
        let back = N::from_f64(1.0 / self.scale);
        let of_links = self.links.iter().flat_map(|(l, at)| {
            let wrench = acting.about(*l, *at);
            [-(wrench.force.x * back), -(wrench.force.y * back), -wrench.couple]
        });
        let of_pins = self
            .pins
            .iter()
            .flat_map(|p| [-(acting.pins[p.0].x * back), -(acting.pins[p.0].y * back)]);
        of_links.chain(of_pins).collect()
    }
}

impl<N: Real> ConditionPoint<N> {
    /// Adds a force on the point to the forces that act upstream.
    fn passed_on(&self, force: Vec2<N>, acting: &mut ActingForces<N>) {
        match *self {
            ConditionPoint::Known(at, GraphNode::Link(link)) => {
                acting.on_link(link, at.at, Wrench { force, ..Wrench::zero() })
            }
            ConditionPoint::Known(_, GraphNode::Pin(pin)) => acting.on_pin(pin, force),
            ConditionPoint::Link(..) | ConditionPoint::Pin(_) => {}
        }
    }
}
