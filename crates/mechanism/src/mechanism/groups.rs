//! Assur groups in solving order, each with its core.
//!
//! A perfect matching of equations to nodes defines a directed graph: a node depends on the other
//! node of each of its equations. The groups are the strongly connected components of this graph
//! (Tarjan), independent of the matching found. The solving order is a topological order of the
//! groups, with the first in the scene first. Pins are separate nodes, so that several links on one
//! pin need no choice of pairs.
//!
//! # Source
//! Sljoka, Shai, Whiteley, *Checking mobility and decomposition of linkages via pebble game
//! algorithm*, ASME DETC 2011.

use super::leg::{CoreLoci, Hold, Leg};
use super::mobility::Assignment;
use super::{GraphNode, Mechanism, PairForm, Passive, Runner};
use hodograph_scene::{GuideId, LinkId, PointId, Scene};
use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap, HashMap};

/// The core of a group: the point or link whose motion is solved first.
#[derive(Clone, Debug, PartialEq)]
pub enum Core {
    /// A pin held by legs that take its two freedoms.
    Pin {
        /// The pin.
        pin: PointId,
        /// Its legs.
        legs: Vec<Leg>,
    },
    /// A link held by legs that take its three freedoms.
    Link {
        /// The link.
        link: LinkId,
        /// Its legs.
        legs: Vec<Leg>,
    },
    /// Neither: a group above class III.
    Higher,
}

/// One Assur group (or a driven link, or a pin carried by a known link).
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// Its links, in the order of the scene.
    pub links: Vec<LinkId>,
    /// Its pins.
    pub pins: Vec<PointId>,
    /// Its core.
    pub core: Core,
    /// Groups on which it depends (indices into [`Mechanism::groups`]).
    pub upstream: Vec<usize>,
    /// The constraints that belong to it.
    pub constraints: Vec<usize>,
}

impl Group {
    /// Returns the Assur class in roman numerals, or `None` for driven links and carried pins,
    /// which are no groups.
    ///
    /// Dyads of every kind are class II, a link on three legs is class III; anything else is called
    /// "IV or higher".
    pub fn class(&self) -> Option<&'static str> {
        match &self.core {
            Core::Higher => Some("IV or higher"),
            // A single leg takes both freedoms: the pin is carried or driven.
            Core::Pin { legs, .. } => (legs.len() > 1).then_some("II"),
            Core::Link { legs, .. } => {
                if legs.len() <= 2 && legs.iter().any(Leg::drives) {
                    None
                } else if legs.len() >= 3 && legs.iter().all(|l| l.hold().is_some()) {
                    Some("III")
                } else {
                    Some("II")
                }
            }
        }
    }

    /// Returns the kind of a dyad (`RRR`, `RRP`, `RPR`, `PRP`, `RPP`), `triad`, or a description of
    /// another group.
    pub fn kind(&self) -> String {
        let kind = match &self.core {
            Core::Higher => "higher group",
            Core::Pin { legs, .. } => match legs[..] {
                [leg] if leg.drives() => "driven slider",
                [_] => "carried pin",
                _ => match legs.iter().filter(|l| l.letter() == "R").count() {
                    2 => "RRR",
                    1 => "RRP",
                    _ => "PRP",
                },
            },
            Core::Link { legs, .. } => match self.class() {
                None => "driven link",
                Some("III") => "triad",
                _ => match CoreLoci::of(legs) {
                    CoreLoci { angle: Some(_), pivot: Some(_), .. } => "RP",
                    CoreLoci { angle: Some(_), pivot: None, holds, .. } => sliding_dyad(&holds),
                    CoreLoci { angle: None, .. } => "RPR",
                },
            },
        };
        kind.into()
    }

    /// Returns true if it is a pin on a known link: the pin follows that link, there is nothing to
    /// solve, and lists of groups omit it.
    pub fn is_carried(&self) -> bool {
        match &self.core {
            Core::Pin { legs, .. } => CoreLoci::of(legs).carrier.is_some(),
            Core::Link { .. } | Core::Higher => false,
        }
    }
}

/// Returns the kind of a dyad whose core slides on a known link without relative rotation. The
/// other leg decides: a bar is RRP, a pin of the core in a further guide PRP, a slot of the core
/// over a known pin RPP.
fn sliding_dyad(holds: &[Hold]) -> &'static str {
    let distances = holds.iter().filter(|h| matches!(h, Hold::Distance { .. })).count();
    let guides = holds.iter().filter(|h| matches!(h, Hold::Guide { .. })).count();
    let glides = holds.iter().any(|h| matches!(h, Hold::Glide { .. }));
    match (distances, guides) {
        (1.., _) => "RRP",
        (0, 2..) => "PRP",
        // If one of two holds is a guide of the ground for a pin of the core, that may be the slide
        // itself.
        (0, 1) if glides => "PRP",
        (0, _) => "RPP",
    }
}

/// Splits the mechanism into groups in solving order.
pub(crate) fn find(scene: &Scene, m: &mut Mechanism, assignment: &Assignment) {
    let nodes: Vec<GraphNode> = (0..scene.links.len())
        .map(LinkId)
        .filter(|l| *l != scene.ground && m.passive[l.0].is_none())
        .map(GraphNode::Link)
        .chain(m.pins.iter().map(|p| GraphNode::Pin(*p)))
        .collect();
    // Used for look-up only, never iterated: the order of the scene decides every output.
    let index: HashMap<GraphNode, usize> = nodes.iter().enumerate().map(|(i, n)| (*n, i)).collect();
    let mut graph = petgraph::graph::DiGraph::<usize, ()>::with_capacity(
        nodes.len(),
        assignment.equations.len(),
    );
    let handles: Vec<_> = (0..nodes.len()).map(|i| graph.add_node(i)).collect();
    for (_, at, other) in &assignment.equations {
        if let (Some(&a), Some(&b)) = (index.get(at), index.get(other)) {
            graph.update_edge(handles[a], handles[b], ());
        }
    }
    let mut parts: Vec<Vec<usize>> = petgraph::algo::tarjan_scc(&graph)
        .into_iter()
        .map(|c| c.into_iter().map(|h| graph[h]).collect::<Vec<_>>())
        .collect();
    for p in &mut parts {
        p.sort_unstable();
    }
    let mut part_of = vec![0; nodes.len()];
    for (i, p) in parts.iter().enumerate() {
        for &n in p {
            part_of[n] = i;
        }
    }
    let order = topological(&parts, &part_of, &graph);
    let mut position = vec![0; parts.len()];
    for (rank, &p) in order.iter().enumerate() {
        position[p] = rank;
    }
    for (n, node) in nodes.iter().enumerate() {
        let g = position[part_of[n]];
        match node {
            GraphNode::Link(l) => m.group_of_link[l.0] = Some(g),
            GraphNode::Pin(p) => m.group_of_pin[p.0] = Some(g),
        }
    }
    let mut constraints_of: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); parts.len()];
    for (c, at, _) in &assignment.equations {
        constraints_of[position[part_of[index[at]]]].insert(*c);
    }
    for (rank, &p) in order.iter().enumerate() {
        let mut links: Vec<LinkId> = Vec::new();
        let mut pins: Vec<PointId> = Vec::new();
        for &n in &parts[p] {
            match nodes[n] {
                GraphNode::Link(l) => links.push(l),
                GraphNode::Pin(q) => pins.push(q),
            }
        }
        let mut upstream: Vec<usize> = parts[p]
            .iter()
            .flat_map(|&n| graph.neighbors(handles[n]).map(|h| position[part_of[graph[h]]]))
            .filter(|&g| g != rank)
            .collect();
        upstream.sort_unstable();
        upstream.dedup();
        let constraints: Vec<usize> = constraints_of[rank].iter().copied().collect();
        let core = find_core(scene, m, &links, &pins, &constraints);
        m.groups.push(Group { links, pins, core, upstream, constraints });
    }
}

/// Returns an order in which every part comes after those that it needs; of the ready parts, the
/// first in the scene comes first.
fn topological(
    parts: &[Vec<usize>],
    part_of: &[usize],
    graph: &petgraph::graph::DiGraph<usize, ()>,
) -> Vec<usize> {
    let mut needs: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); parts.len()];
    let mut feeds: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); parts.len()];
    for e in graph.raw_edges() {
        let (a, b) = (part_of[graph[e.source()]], part_of[graph[e.target()]]);
        if a != b {
            needs[a].insert(b);
            feeds[b].insert(a);
        }
    }
    let mut ready: BinaryHeap<Reverse<(usize, usize)>> = (0..parts.len())
        .filter(|&p| needs[p].is_empty())
        .map(|p| Reverse((parts[p][0], p)))
        .collect();
    let mut order = Vec::with_capacity(parts.len());
    while let Some(Reverse((_, p))) = ready.pop() {
        order.push(p);
        for &f in &feeds[p] {
            needs[f].remove(&p);
            if needs[f].is_empty() {
                ready.push(Reverse((parts[f][0], f)));
            }
        }
    }
    order
}

fn find_core(
    scene: &Scene,
    m: &Mechanism,
    links: &[LinkId],
    pins: &[PointId],
    constraints: &[usize],
) -> Core {
    let cs: Vec<PairForm> = constraints.iter().map(|&i| m.constraints[i].form()).collect();
    if let [pin] = pins[..]
        && let Some(legs) = legs_of_pin(links, pin, &cs)
    {
        return Core::Pin { pin, legs };
    }
    for &link in links {
        if let Some(legs) = legs_of_link(scene, links, pins, link, &cs) {
            return Core::Link { link, legs };
        }
    }
    Core::Higher
}

/// Returns the driver of the runner along a guide, if the group has one.
fn slide_of(cs: &[PairForm], guide: GuideId) -> Option<usize> {
    cs.iter().find(|c| c.path() == Some(guide) && c.driver().is_some())?.driver()
}

/// Returns the pins that forms put on a link.
fn on_link<'a>(
    cs: impl IntoIterator<Item = &'a PairForm>,
    l: LinkId,
) -> impl Iterator<Item = PointId> {
    cs.into_iter()
        .filter_map(PairForm::meets)
        .filter(move |(_, link)| *link == l)
        .map(|(pin, _)| pin)
}

/// Returns the legs of a pin, if every link of the group is a bar from a known pin to it.
fn legs_of_pin(links: &[LinkId], pin: PointId, cs: &[PairForm]) -> Option<Vec<Leg>> {
    let mut legs = Vec::new();
    let mut used = 0;
    for &l in links {
        let mine: Vec<&PairForm> = cs.iter().filter(|c| c.joins(l)).collect();
        let far = on_link(mine.iter().copied(), l).find(|p| *p != pin)?;
        let near = mine.contains(&&PairForm::Meet { pin, link: l });
        if near && mine.len() == 2 {
            legs.push(Leg::Bar { link: l, near: pin, far });
            used += 2;
        } else if let Some(guide) = mine.iter().find_map(|c| {
            c.path().filter(|_| c.driver().is_none() && c.ends().0 == GraphNode::Pin(pin))
        }) && let Some(driver) = slide_of(cs, guide)
            && mine.len() == 3
        {
            legs.push(Leg::Ram { link: l, far, guide, driver, near: pin });
            used += 3;
        } else {
            return None;
        }
    }
    for c in cs {
        match *c {
            PairForm::Meet { pin: p, link } if p == pin && !links.contains(&link) => {
                legs.push(Leg::Carried { link });
                used += 1;
            }
            PairForm::OnPath { runner: Runner::Pin(p), guide, on }
                if p == pin && !links.contains(&on) =>
            {
                if let Some(driver) = slide_of(cs, guide) {
                    legs.push(Leg::Driven { guide, driver, pin });
                    used += 2;
                } else {
                    legs.push(Leg::OnGuide { pin, guide });
                    used += 1;
                }
            }
            PairForm::Distance { from, to, driver } => {
                legs.push(Leg::Cylinder {
                    driver,
                    near: pin,
                    far: if from == pin { to } else { from },
                });
                used += 1;
            }
            // The forms of bars and rams are counted with them, a driver along a guide with its
            // guide. The others are no leg of a pin; a form that stays uncounted means that the
            // group is no dyad of one pin.
            PairForm::Meet { .. }
            | PairForm::OnPath { .. }
            | PairForm::AlongPath { .. }
            | PairForm::Angles { .. }
            | PairForm::Related { .. } => {}
        }
    }
    let freedoms: usize = legs.iter().map(Leg::freedoms).sum();
    (used == cs.len() && freedoms == 2).then_some(legs)
}

/// Returns the legs of a link, if every other link of the group is a bar from a known pin to one of
/// the core's pins.
fn legs_of_link(
    scene: &Scene,
    links: &[LinkId],
    pins: &[PointId],
    core: LinkId,
    cs: &[PairForm],
) -> Option<Vec<Leg>> {
    let mut legs = Vec::new();
    let mut used = 0;
    // Every pin of the group must be on the core.
    for &pin in pins {
        if !cs.contains(&PairForm::Meet { pin, link: core }) {
            return None;
        }
        used += 1;
    }
    for &l in links.iter().filter(|l| **l != core) {
        let on: Vec<PointId> = on_link(cs, l).collect();
        let (near, far) = match on[..] {
            [a, b] if pins.contains(&a) && !pins.contains(&b) => (a, b),
            [a, b] if pins.contains(&b) && !pins.contains(&a) => (b, a),
            _ => return None,
        };
        legs.push(Leg::Bar { link: l, near, far });
        used += 2;
    }
    // The other one of two links, if it is known.
    let known =
        |a: LinkId, b: LinkId| Some(if a == core { b } else { a }).filter(|l| !links.contains(l));
    for c in cs {
        match *c {
            PairForm::Meet { pin, link } if link == core && !pins.contains(&pin) => {
                legs.push(Leg::Pinned { pin });
                used += 1;
            }
            // The pins of the core and of bars are counted; a driver along a guide is counted with
            // its guide.
            PairForm::Meet { .. } | PairForm::AlongPath { .. } => {}
            PairForm::OnPath { runner: Runner::Pin(pin), guide, on } => {
                if slide_of(cs, guide).is_some() {
                    return None;
                }
                if pins.contains(&pin) && !links.contains(&on) {
                    legs.push(Leg::OnGuide { pin, guide });
                } else if on == core && !pins.contains(&pin) {
                    legs.push(Leg::InSlot { pin, guide });
                } else {
                    return None;
                }
                used += 1;
            }
            PairForm::Angles { of, against, driver } => {
                legs.push(Leg::Angle { of: known(of, against)?, driver });
                used += 1;
            }
            PairForm::Related { pair, .. } => {
                let rolling = &scene.rolling[pair.0];
                let other = rolling.other(core).filter(|l| !links.contains(l))?;
                legs.push(Leg::Rolls { pair, other, at: rolling.at_of(core) });
                used += 1;
            }
            PairForm::OnPath { runner: Runner::Link(slider), guide, on } => {
                let other = known(slider, on)?;
                if let Some(driver) = slide_of(cs, guide) {
                    legs.push(Leg::DrivenGlide { guide, other, driver });
                    used += 2;
                } else {
                    legs.push(Leg::Glide { guide, other });
                    used += 1;
                }
            }
            PairForm::Distance { from, to, driver } => {
                let (near, far) = match (pins.contains(&from), pins.contains(&to)) {
                    (true, false) => (from, to),
                    (false, true) => (to, from),
                    (true, true) | (false, false) => return None,
                };
                legs.push(Leg::Cylinder { driver, near, far });
                used += 1;
            }
        }
    }
    let freedoms: usize = legs.iter().map(Leg::freedoms).sum();
    (used == cs.len() && freedoms == 3).then_some(legs)
}

impl Mechanism {
    /// Returns the nodes whose motion a passive link follows: the carrier of a block, or the pins
    /// of a driver's numbered links; `None` if the link is not passive.
    pub fn passive_carrier(&self, scene: &Scene, l: LinkId) -> Option<Vec<GraphNode>> {
        Some(match self.passive[l.0]? {
            Passive::Block(g) => {
                vec![GraphNode::Link(scene.guides[g.0].on), GraphNode::Pin(scene.guides[g.0].pin?)]
            }
            Passive::Cylinder(d) => scene.drivers[d].kind.ends()?.map(GraphNode::Pin).to_vec(),
            Passive::Held(a, b) => vec![GraphNode::Pin(a), GraphNode::Pin(b)],
        })
    }
}
