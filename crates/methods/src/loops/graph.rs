//! Links and joints as a graph, and its loops in the order of solution.
//!
//! A node is a rigid body: a link, the radius of a curved slot, or a cylinder. The nodes of each
//! group join those that are known; every joint that closes a loop of known and new nodes gives one
//! loop. A group of n new bodies and p joints has p − n loops.

use hodograph_base::diag::{Diagnostic, both};
use hodograph_mechanism::mechanism::{Mechanism, Passive};
use hodograph_scene::{GuideId, GuidePath, LinkId, PointId, Scene};
use std::collections::VecDeque;

/// A rigid body of the loops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Body {
    /// A link.
    Link(LinkId),
    /// The radius from the centre of a curved slot to the pin in it.
    Radius(GuideId),
    /// The line between the ends of a cylinder, with the driver that sets its length.
    Cylinder(usize),
}

/// A joint of two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joint {
    /// A pin.
    Pin(PointId),
    /// A straight slide; the first body carries the guide.
    Slide(GuideId),
}

/// An edge of the graph.
#[derive(Clone, Copy, Debug)]
pub struct Edge {
    /// The two bodies, as indices.
    pub bodies: [usize; 2],
    /// Their joint.
    pub joint: Joint,
}

/// Bodies and joints.
#[derive(Clone, Debug)]
pub struct Graph {
    /// The bodies; links come first, in the order of the scene.
    pub bodies: Vec<Body>,
    /// The joints.
    pub edges: Vec<Edge>,
}

/// A closed way: bodies, each with the edge by which the way enters it.
pub struct Cycle {
    /// The bodies and edges from the base to the joint that closes the loop.
    pub left: Vec<(usize, usize)>,
    /// The bodies and edges on the other side.
    pub right: Vec<(usize, usize)>,
    /// The body at which both sides begin.
    pub base: usize,
    /// The joint at which both sides end.
    pub closing: usize,
}

/// The loops of one group.
pub struct GroupCycles {
    /// The group, an index into the mechanism's.
    pub group: usize,
    /// Its loops.
    pub cycles: Vec<Cycle>,
}

/// The order in which bodies became known: ground is 0.
type Ranks = Vec<Option<usize>>;

impl Graph {
    /// # Errors
    /// `loops` for pairs that no closed vectors describe: rolling contacts, belts.
    pub fn of(scene: &Scene) -> Result<Graph, Diagnostic> {
        if let Some(pair) = scene.rolling.first() {
            let [a, b] = pair.links.map(|l| scene.link_name(l));
            let message = both!(
                "links {a} and {b} roll on each other: their rotations are related by their radii, not by a loop of vectors"
            );
            let help = both!("`hodograph solve` and `hodograph draw` take such pairs");
            return Err(Diagnostic::error("loops", message).help(help));
        }
        let mut g = Graph {
            bodies: (0..scene.links.len()).map(|l| Body::Link(LinkId(l))).collect(),
            edges: Vec::new(),
        };
        for (i, guide) in scene.guides.iter().enumerate() {
            let id = GuideId(i);
            match (&guide.path, guide.slider) {
                (GuidePath::Line { .. }, Some(slider)) => {
                    g.join(guide.on.0, slider.0, Joint::Slide(id));
                    let pinned = guide.pin.filter(|p| !scene.links[slider.0].points.contains(p));
                    if let Some(pin) = pinned {
                        g.pin_to_carriers(scene, pin, slider.0);
                    }
                }
                (GuidePath::Line { .. }, None) => {
                    let runner = guide.pin.and_then(|p| scene.carriers(p).find(|l| *l != guide.on));
                    if let Some(runner) = runner {
                        g.join(guide.on.0, runner.0, Joint::Slide(id));
                    }
                }
                (GuidePath::Arc { centre, .. }, slider) => {
                    let body = slider.map_or_else(|| g.body(Body::Radius(id)), |l| l.0);
                    g.join(guide.on.0, body, Joint::Pin(*centre));
                    if let Some(pin) = guide.pin {
                        g.pin_to_carriers(scene, pin, body);
                    }
                }
            }
        }
        for (d, driver) in scene.drivers.iter().enumerate() {
            if let Some(ends) = driver.kind.ends() {
                let body = g.body(Body::Cylinder(d));
                ends.into_iter().for_each(|p| g.pin_to_carriers(scene, p, body));
            }
        }
        for p in (0..scene.points.len()).map(PointId) {
            let all: Vec<LinkId> = scene.carriers(p).collect();
            for other in all.iter().skip(1) {
                g.join(all[0].0, other.0, Joint::Pin(p));
            }
        }
        Ok(g)
    }

    fn body(&mut self, body: Body) -> usize {
        self.bodies.push(body);
        self.bodies.len() - 1
    }

    fn join(&mut self, a: usize, b: usize, joint: Joint) {
        self.edges.push(Edge { bodies: [a, b], joint });
    }

    /// Pins a body to the first link that carries a point.
    fn pin_to_carriers(&mut self, scene: &Scene, p: PointId, body: usize) {
        if let Some(link) = scene.carriers(p).find(|l| l.0 != body) {
            self.join(link.0, body, Joint::Pin(p));
        }
    }

    /// Returns the edges of a body with the bodies at their other ends.
    fn around(&self, body: usize) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.edges.iter().enumerate().filter_map(move |(e, edge)| match edge.bodies {
            [a, b] if a == body => Some((e, b)),
            [a, b] if b == body => Some((e, a)),
            _ => None,
        })
    }

    /// Returns the loops of all groups in solving order.
    pub fn cycles(&self, scene: &Scene, m: &Mechanism) -> Vec<GroupCycles> {
        let mut ranks: Ranks = vec![None; self.bodies.len()];
        ranks[scene.ground.0] = Some(0);
        let mut out = Vec::new();
        for (g, group) in m.groups.iter().enumerate() {
            let mut new: Vec<usize> =
                group.links.iter().map(|l| l.0).filter(|b| ranks[*b].is_none()).collect();
            // A body that no group lists (a block on a pin, a radius, a cylinder) belongs to the first
            // group that holds it at two joints.
            for b in 0..self.bodies.len() {
                let listed =
                    matches!(self.bodies[b], Body::Link(l) if m.group_of_link[l.0].is_some());
                // A link that only repeats others would close a loop with too few unknowns.
                let repeats = matches!(self.bodies[b], Body::Link(l)
                    if matches!(m.passive[l.0], Some(Passive::Held(..))));
                let held =
                    self.around(b).filter(|(_, o)| ranks[*o].is_some() || new.contains(o)).count();
                if ranks[b].is_none() && !listed && !repeats && held > 1 {
                    new.push(b);
                }
            }
            new.sort_unstable();
            new.dedup();
            let cycles = self.closed(&ranks, &new);
            new.iter().for_each(|b| ranks[*b] = Some(g + 1));
            if !cycles.is_empty() {
                out.push(GroupCycles { group: g, cycles });
            }
        }
        out
    }

    /// Returns one loop for each joint that a tree of the new bodies on the known ones leaves out.
    fn closed(&self, ranks: &[Option<usize>], new: &[usize]) -> Vec<Cycle> {
        let mut entry: Vec<Option<(usize, usize)>> = vec![None; self.bodies.len()];
        let mut tree = vec![false; self.edges.len()];
        let mut queue: VecDeque<usize> =
            (0..self.bodies.len()).filter(|b| ranks[*b].is_some()).collect();
        while let Some(at) = queue.pop_front() {
            for (e, other) in self.around(at) {
                if new.contains(&other) && entry[other].is_none() {
                    entry[other] = Some((e, at));
                    tree[e] = true;
                    queue.push_back(other);
                }
            }
        }
        let mut out = Vec::new();
        for (e, edge) in self.edges.iter().enumerate() {
            let inside = |b: usize| new.contains(&b) && entry[b].is_some();
            let [a, b] = edge.bodies;
            let closes = (inside(a) || inside(b))
                && [a, b].iter().all(|x| inside(*x) || ranks[*x].is_some());
            if tree[e] || !closes {
                continue;
            }
            let (from_a, root_a) = self.way_down(a, &entry);
            let (from_b, root_b) = self.way_down(b, &entry);
            out.extend(self.cycle(ranks, e, (from_a, root_a), (from_b, root_b)));
        }
        out
    }

    /// Returns the bodies from a known one to `body`, each with its entry, and the known one.
    fn way_down(
        &self,
        mut body: usize,
        entry: &[Option<(usize, usize)>],
    ) -> (Vec<(usize, usize)>, usize) {
        let mut way = Vec::new();
        while let Some((e, from)) = entry[body] {
            way.push((body, e));
            body = from;
        }
        way.reverse();
        (way, body)
    }

    /// Joins two ways to one loop through the known bodies. Bodies that both ways share are left
    /// out.
    fn cycle(
        &self,
        ranks: &[Option<usize>],
        closing: usize,
        (mut a, root_a): (Vec<(usize, usize)>, usize),
        (mut b, root_b): (Vec<(usize, usize)>, usize),
    ) -> Option<Cycle> {
        let mut shared = root_a;
        while let (Some(first), Some(second)) = (a.first(), b.first())
            && first == second
        {
            shared = first.0;
            a.remove(0);
            b.remove(0);
        }
        if shared != root_a {
            return Some(Cycle { left: a, right: b, base: shared, closing });
        }
        // The way through known bodies from one root to the other.
        let mut before: Vec<Option<(usize, usize)>> = vec![None; self.bodies.len()];
        let mut queue = VecDeque::from([root_a]);
        while let Some(at) = queue.pop_front() {
            for (e, other) in self.around(at) {
                if ranks[other].is_some() && other != root_a && before[other].is_none() {
                    before[other] = Some((e, at));
                    queue.push_back(other);
                }
            }
        }
        let mut bodies = vec![root_b];
        let mut edges = Vec::new();
        let mut at = root_b;
        while at != root_a {
            let (e, from) = before[at]?;
            edges.push(e);
            bodies.push(from);
            at = from;
        }
        // From root_a to root_b; the base is the body that was known first.
        bodies.reverse();
        edges.reverse();
        let base = (0..bodies.len()).min_by_key(|k| ranks[bodies[*k]]).unwrap_or_default();
        let mut left: Vec<(usize, usize)> =
            (0..base).rev().map(|k| (bodies[k], edges[k])).collect();
        let mut right: Vec<(usize, usize)> =
            (base + 1..bodies.len()).map(|k| (bodies[k], edges[k - 1])).collect();
        left.extend(a);
        right.extend(b);
        let base = bodies[base];
        // The longer side, with the driven bodies, is on the left.
        if left.len() < right.len() {
            std::mem::swap(&mut left, &mut right);
        }
        Some(Cycle { left, right, base, closing })
    }
}
