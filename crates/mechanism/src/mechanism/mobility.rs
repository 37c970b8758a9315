//! Check that pairs and drivers determine every link: a bipartite b-matching by augmenting paths.
//!
//! Each equation is assigned to one of its two nodes, so that a link gets three and a pin two. A
//! node that lacks equations is free; an equation without a node depends on others. The diagnosis
//! reports both.

use super::{Constraint, GraphNode, PairItem, Passive};
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_scene::{LinkId, PointId, Scene};
use std::collections::BTreeSet;

/// Mobility F = 3n − 2P_L − P_H with its counts.
///
/// # Source
/// Chebychev–Grübler–Kutzbach criterion for planar mechanisms (e.g. Norton, *Design of Machinery*,
/// §2.5).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mobility {
    /// Moving links.
    pub moving: usize,
    /// Lower pairs; a pin that joins k links counts k − 1.
    pub lower: usize,
    /// Pairs that take one freedom (bare pins in slots, gears, cams).
    pub higher: usize,
    /// Degrees of freedom.
    pub freedom: i64,
}

/// For each equation (constraint index, its two ends): the end to which it is assigned.
pub(crate) struct Assignment {
    /// (constraint, assigned node, other node), one entry per scalar equation.
    pub equations: Vec<(usize, GraphNode, GraphNode)>,
}

struct Nodes {
    links: usize,
}

impl Nodes {
    fn index(&self, n: GraphNode) -> usize {
        match n {
            GraphNode::Link(l) => l.0,
            GraphNode::Pin(p) => self.links + p.0,
        }
    }

    fn at(&self, index: usize) -> GraphNode {
        match index.checked_sub(self.links) {
            None => GraphNode::Link(LinkId(index)),
            Some(p) => GraphNode::Pin(PointId(p)),
        }
    }
}

/// A matching of as many equations as possible with the freedoms of the nodes.
pub(super) struct Matched {
    nodes: Nodes,
    /// One entry per scalar equation: its constraint and the two ends of the constraint.
    units: Vec<(usize, GraphNode, GraphNode)>,
    owner: Vec<Option<usize>>,
    held: Vec<Vec<usize>>,
    capacity: Vec<usize>,
    /// Equations assigned to no node.
    unmatched: Vec<usize>,
}

impl Matched {
    /// Matches equations with freedoms, in the order of the constraints.
    pub fn new(
        scene: &Scene,
        passive: &[Option<Passive>],
        pins: &[PointId],
        constraints: &[Constraint],
    ) -> Matched {
        let nodes = Nodes { links: scene.links.len() };
        let mut capacity = vec![0usize; scene.links.len() + scene.points.len()];
        for (l, p) in passive.iter().enumerate() {
            if l != scene.ground.0 && p.is_none() {
                capacity[l] = 3;
            }
        }
        for p in pins {
            capacity[nodes.links + p.0] = 2;
        }
        let units: Vec<(usize, GraphNode, GraphNode)> = constraints
            .iter()
            .enumerate()
            .flat_map(|(i, c)| {
                let (a, b) = c.ends();
                std::iter::repeat_n((i, a, b), c.form().equations())
            })
            .collect();
        let (owner, held) = (vec![None; units.len()], vec![Vec::new(); capacity.len()]);
        let mut m = Matched { nodes, owner, held, capacity, unmatched: Vec::new(), units };
        for u in 0..m.units.len() {
            if augment(u, &m.units, &m.nodes, &m.capacity, &mut m.owner, &mut m.held) {
                continue;
            }
            m.unmatched.push(u);
        }
        m
    }

    /// Returns the number of scalar equations.
    pub fn equations(&self) -> usize {
        self.units.len()
    }

    /// Returns the number of unmatched equations.
    pub fn unmatched(&self) -> usize {
        self.unmatched.len()
    }

    /// Returns the number of freedoms without an equation.
    pub fn free(&self) -> usize {
        self.capacity.iter().zip(&self.held).map(|(c, h)| c - h.len()).sum()
    }

    /// Returns, for each unmatched equation, the constraints that depend on one another with it
    /// (those that hold the nodes that could take it, and so on): without any one of them it is
    /// matched.
    pub fn circuits(&self) -> impl Iterator<Item = BTreeSet<usize>> + '_ {
        self.unmatched.iter().map(|u| self.circuit(*u))
    }

    fn circuit(&self, unmatched: usize) -> BTreeSet<usize> {
        let mut seen = vec![false; self.capacity.len()];
        let mut found = BTreeSet::new();
        let mut stack = vec![unmatched];
        while let Some(u) = stack.pop() {
            let (constraint, a, b) = self.units[u];
            found.insert(constraint);
            for n in [a, b].map(|n| self.nodes.index(n)) {
                if self.capacity[n] > 0 && !std::mem::replace(&mut seen[n], true) {
                    stack.extend(&self.held[n]);
                }
            }
        }
        found
    }

    /// Returns the assignment of a perfect matching.
    fn assignment(self) -> Assignment {
        let nodes = self.nodes;
        let equations = self.units.into_iter().zip(self.owner);
        let told = equations.filter_map(|((c, a, b), o)| {
            Some(if nodes.index(a) == o? { (c, a, b) } else { (c, b, a) })
        });
        Assignment { equations: told.collect() }
    }
}

/// Returns true if every equation can be assigned to a node: no pair repeats others.
pub(super) fn all_matched(
    scene: &Scene,
    passive: &[Option<Passive>],
    pins: &[PointId],
    constraints: &[Constraint],
) -> bool {
    Matched::new(scene, passive, pins, constraints).unmatched.is_empty()
}

/// Assigns every equation to a node.
///
/// # Errors
/// Names the links that stay free, or the redundant pairs.
pub(super) fn assign(
    scene: &Scene,
    passive: &[Option<Passive>],
    pins: &[PointId],
    constraints: &[Constraint],
) -> Result<Assignment, Faults> {
    let m = Matched::new(scene, passive, pins, constraints);
    let mut faults = Faults::default();
    let free: Vec<GraphNode> = (0..m.capacity.len())
        .filter(|&n| m.held[n].len() < m.capacity[n])
        .map(|n| m.nodes.at(n))
        .collect();
    if !free.is_empty() {
        faults.push(too_free(scene, constraints, m.free(), &free));
    }
    if !m.unmatched.is_empty() {
        faults.push(too_tight(scene, constraints, &m.units, &m.unmatched));
    }
    if faults.has_errors() {
        return Err(faults);
    }
    Ok(m.assignment())
}

/// Matches equation `u` along a shortest augmenting path (breadth-first); returns true if there is
/// one.
fn augment(
    u: usize,
    units: &[(usize, GraphNode, GraphNode)],
    nodes: &Nodes,
    capacity: &[usize],
    owner: &mut [Option<usize>],
    held: &mut [Vec<usize>],
) -> bool {
    // came[n] = the equation that would move to node n.
    let mut came: Vec<Option<usize>> = vec![None; capacity.len()];
    let mut queue = std::collections::VecDeque::new();
    for end in [units[u].1, units[u].2] {
        let n = nodes.index(end);
        if capacity[n] > 0 && came[n].is_none() {
            came[n] = Some(u);
            queue.push_back(n);
        }
    }
    while let Some(n) = queue.pop_front() {
        if held[n].len() < capacity[n] {
            let mut at = n;
            loop {
                let e = came[at].expect("every node on the path was reached by an equation");
                let from = owner[e];
                if let Some(f) = from {
                    held[f].retain(|x| *x != e);
                }
                owner[e] = Some(at);
                held[at].push(e);
                match from {
                    Some(f) if e != u => at = f,
                    _ => return true,
                }
            }
        }
        for &e in &held[n] {
            for end in [units[e].1, units[e].2] {
                let m = nodes.index(end);
                if capacity[m] > 0 && came[m].is_none() {
                    came[m] = Some(e);
                    queue.push_back(m);
                }
            }
        }
    }
    false
}

fn describe(scene: &Scene, n: GraphNode) -> Both {
    match n {
        GraphNode::Link(l) => both!("link {}", scene.link_name(l)),
        GraphNode::Pin(p) => both!("pin {}", scene.point_name(p)),
    }
}

fn too_free(
    scene: &Scene,
    constraints: &[Constraint],
    missing: usize,
    free: &[GraphNode],
) -> Diagnostic {
    let names: Vec<_> = free.iter().map(|n| describe(scene, *n)).collect();
    let drivers = scene.own_drivers();
    let span = match free[0] {
        GraphNode::Link(l) => scene.links[l.0].span,
        GraphNode::Pin(p) => scene.points[p.0].span,
    };
    Diagnostic::error(
        "too-few-constraints",
        both!(
            "mobility F = {}: the pairs and the {drivers} driver{} leave {missing} freedom{} open, at {}",
            count(scene, constraints).freedom,
            if drivers == 1 { "" } else { "s" },
            if missing == 1 { "" } else { "s" },
            Both::join(&names, [", ", "、"])
        ),
    )
    .at(span)
    .help(match unlisted_pivots(scene) {
        Some(names) => both!(
            "if {} are fixed pivots, list them under the ground link; otherwise give the joint, guide or driver that is missing",
            names
        ),
        None => both!(
            "give {missing} more driver{}, or the joint or guide that is missing there",
            if missing == 1 { "" } else { "s" }
        ),
    })
}

/// Returns the points with coordinates on a single moving link: often pivots that are missing in
/// the list of the ground.
fn unlisted_pivots(scene: &Scene) -> Option<Both> {
    let names: Vec<&str> = scene
        .points
        .iter()
        .enumerate()
        .filter(|(i, p)| {
            let carriers: Vec<_> = scene.carriers(PointId(*i)).collect();
            let runs = scene.guides.iter().any(|g| g.pin == Some(PointId(*i)));
            matches!(p.place, hodograph_scene::PointPlace::At(_))
                && !runs
                && carriers.len() == 1
                && carriers[0] != scene.ground
        })
        .map(|(_, p)| p.name.as_str())
        .collect();
    (!names.is_empty()).then(|| Both::names(&names))
}

fn too_tight(
    scene: &Scene,
    constraints: &[Constraint],
    units: &[(usize, GraphNode, GraphNode)],
    unmatched: &[usize],
) -> Diagnostic {
    let mut names: Vec<Both> = Vec::new();
    let mut span = None;
    for &u in unmatched {
        let c = &constraints[units[u].0];
        let text = c.words(scene);
        if !names.contains(&text) {
            names.push(text);
        }
        span = span.or(Some(c.span(scene)));
    }
    let d = Diagnostic::error(
        "too-many-constraints",
        both!(
            "{} condition{} too many: mobility F = {}, {} driver{}; no freedom is left for {}",
            unmatched.len(),
            if unmatched.len() == 1 { "" } else { "s" },
            count(scene, constraints).freedom,
            scene.own_drivers(),
            if scene.own_drivers() == 1 { "" } else { "s" },
            Both::join(&names, [", ", "、"])
        ),
    )
    .help(both!("leave out a driver, or a link or joint that only repeats what others fix"));
    match span {
        Some(s) => d.at(s),
        None => d,
    }
}

/// Counts links and pairs. Drivers do not count: they use the freedoms. A cylinder counts as
/// barrel, rod and sliding pair, so that its driver has a freedom too.
///
/// A belt or chain takes one freedom of two neighbours, as a mesh does; it is no link. A wheel that
/// rolls on its track takes two freedoms, as a lower pair does. A mesh takes one, and one more if
/// only its flanks hold the distance of the centres, which the constraints show.
pub(super) fn count(scene: &Scene, constraints: &[Constraint]) -> Mobility {
    let mut moving = scene.links.len() - 1;
    let mut lower = 0;
    let mut on_pin = vec![0usize; scene.points.len()];
    for l in &scene.links {
        for p in &l.points {
            on_pin[p.0] += 1;
        }
    }
    let mut higher = 0;
    for d in &scene.drivers {
        if let (Some([a, b]), links) = (d.kind.ends(), d.kind.parts()) {
            // Unnumbered barrels and rods count as links too.
            moving += 2 - links.len().min(2);
            lower += 1;
            on_pin[a.0] += 1;
            on_pin[b.0] += 1;
            for l in links {
                for p in &scene.links[l.0].points {
                    on_pin[p.0] -= 1;
                }
            }
        }
    }
    for pair in &scene.rolling {
        let own =
            pair.guide().filter(|g| constraints.iter().any(|c| c.item() == PairItem::Guide(*g)));
        match pair.kind.is_lower() {
            // The contact is part of the pair.
            true => lower += 1,
            false => higher += 1 + usize::from(own.is_some()),
        }
    }
    for g in scene.guides.iter().filter(|g| g.rolling.is_none()) {
        if g.slider.is_some() {
            lower += 1;
        } else {
            higher += 1;
            if let Some(p) = g.pin
                && on_pin[p.0] == 0
            {
                // A bare pin in two slots is a body; its rotation does not count.
                on_pin[p.0] = 1;
                moving += 1;
                higher += 1;
            }
        }
    }
    lower += on_pin.iter().map(|n| n.saturating_sub(1)).sum::<usize>();
    // A follower moved by a cam with a law is no driver: the two are in contact.
    higher += (0..scene.drivers.len()).filter(|d| scene.is_led(*d)).count();
    let freedom = 3 * moving as i64 - 2 * lower as i64 - higher as i64;
    Mobility { moving, lower, higher, freedom }
}
