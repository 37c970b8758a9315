//! Assur groups as books count them: links and whole pairs.
//!
//! The groups of [`super::groups`] are the steps of the solution. If a direction is known before
//! the position (two sliders square to one another lock the halves of an Oldham coupling together),
//! one step holds one equation of a sliding pair and a later step the other. A pair belongs to one
//! group: steps that share a pair are one group, as are steps that then depend on one another.

use super::{Core, Group, Mechanism, PairItem, Passive};
use hodograph_scene::{GuideId, LinkId, PointId, Scene};

/// One group, or a driven part, or a pin carried by a known link.
#[derive(Clone, Debug)]
pub struct Assur<'a> {
    /// The steps of its solution, in order.
    pub steps: Vec<&'a Group>,
    /// Its links, including blocks, barrels and rods, in the order of their numbers.
    pub links: Vec<LinkId>,
    kind: String,
}

impl Assur<'_> {
    /// Returns the Assur class in roman numerals, see [`Group::class`]; `None` if a driver or a
    /// carrier belongs to it.
    pub fn class(&self) -> Option<&'static str> {
        let classes: Option<Vec<_>> =
            self.steps.iter().filter(|g| !g.is_carried()).map(|g| g.class()).collect();
        let classes = classes?;
        ["IV or higher", "III", "II"].into_iter().find(|c| classes.contains(c))
    }

    /// Returns the kind of a dyad (`RRR`, `RRP`, `RPR`, `PRP`, `RPP`) or of another group, see
    /// [`Group::kind`].
    pub fn kind(&self) -> &str {
        &self.kind
    }

    /// Returns true if it is only a pin on a known link.
    pub fn is_carried(&self) -> bool {
        self.steps.iter().all(|g| g.is_carried())
    }

    /// Returns its pins.
    pub fn pins(&self) -> Vec<PointId> {
        let mut pins: Vec<PointId> =
            self.steps.iter().flat_map(|g| g.pins.iter().copied()).collect();
        pins.sort_unstable();
        pins
    }

    /// Returns its inner joints: the points at which it turns or slides inside.
    pub fn inner(&self) -> Vec<PointId> {
        let at = |g: &&Group| match &g.core {
            Core::Pin { pin, .. } => vec![*pin],
            Core::Link { legs, .. } => legs.iter().filter_map(|l| Some(l.line()?.pin())).collect(),
            Core::Higher => Vec::new(),
        };
        self.steps.iter().flat_map(at).collect()
    }

    /// Returns the drivers that belong to it.
    pub fn drivers<'b>(&'b self, m: &'b Mechanism) -> impl Iterator<Item = usize> + 'b {
        self.steps
            .iter()
            .flat_map(|g| &g.constraints)
            .filter_map(|c| m.constraints[*c].form().driver())
    }
}

impl Mechanism {
    /// Returns the groups as books count them, in solving order.
    pub fn assur(&self, scene: &Scene) -> Vec<Assur<'_>> {
        self.joined()
            .into_iter()
            .map(|part| {
                let steps: Vec<&Group> = part.iter().map(|&g| &self.groups[g]).collect();
                let links = self.with_blocks(scene, &part);
                let kind = self.kind_of(scene, &steps, &links);
                Assur { steps, links, kind }
            })
            .collect()
    }

    /// Returns the group of a step.
    pub fn assur_of(&self, scene: &Scene, step: usize) -> Option<Assur<'_>> {
        self.assur(scene)
            .into_iter()
            .find(|a| a.steps.iter().any(|g| std::ptr::eq(*g, &self.groups[step])))
    }

    /// Returns the steps of each group: Tarjan's components of the graph in which a step depends on
    /// those upstream, and the steps of a pair on one another. The groups are in solving order; of
    /// several possible next groups, the first in the scene comes first.
    fn joined(&self) -> Vec<Vec<usize>> {
        let mut graph = petgraph::graph::DiGraph::<usize, ()>::new();
        let nodes: Vec<_> = (0..self.groups.len()).map(|g| graph.add_node(g)).collect();
        let mut seat: Vec<(GuideId, usize)> = Vec::new();
        for (g, group) in self.groups.iter().enumerate() {
            for &u in &group.upstream {
                graph.update_edge(nodes[g], nodes[u], ());
            }
            for &c in &group.constraints {
                let PairItem::Guide(guide) = self.constraints[c].item() else { continue };
                for (_, other) in seat.iter().filter(|(of, at)| *of == guide && *at != g) {
                    graph.update_edge(nodes[g], nodes[*other], ());
                    graph.update_edge(nodes[*other], nodes[g], ());
                }
                seat.push((guide, g));
            }
        }
        let mut parts: Vec<Vec<usize>> = petgraph::algo::tarjan_scc(&graph)
            .into_iter()
            .map(|c| c.into_iter().map(|n| graph[n]).collect())
            .collect();
        parts.iter_mut().for_each(|p| p.sort_unstable());
        parts.sort_by_key(|p| p[p.len() - 1]);
        let (mut order, mut done) = (Vec::new(), vec![false; self.groups.len()]);
        let ready = |part: &[usize], done: &[bool]| {
            part.iter()
                .flat_map(|g| &self.groups[*g].upstream)
                .all(|u| done[*u] || part.contains(u))
        };
        while let Some(next) = parts.iter().position(|p| ready(p, &done)) {
            let part = parts.remove(next);
            part.iter().for_each(|g| done[*g] = true);
            order.push(part);
        }
        order
    }

    /// Returns the links of steps with their blocks: a block belongs to the group of its guide or
    /// of its pin, whichever is solved later; barrel and rod belong to the group that the cylinder
    /// moves.
    fn with_blocks(&self, scene: &Scene, part: &[usize]) -> Vec<LinkId> {
        let mut links: Vec<LinkId> =
            part.iter().flat_map(|g| self.groups[*g].links.iter().copied()).collect();
        for l in (0..scene.links.len()).map(LinkId) {
            let Some(Passive::Block(guide)) = self.passive[l.0] else { continue };
            let guide = &scene.guides[guide.0];
            let holds = |h: &Group| {
                h.links.contains(&guide.on) || guide.pin.is_some_and(|p| h.pins.contains(&p))
            };
            if self.groups.iter().rposition(holds).is_some_and(|home| part.contains(&home)) {
                links.push(l);
            }
        }
        for g in part {
            let legs = match &self.groups[*g].core {
                Core::Pin { legs, .. } | Core::Link { legs, .. } => legs.as_slice(),
                Core::Higher => &[],
            };
            for l in legs
                .iter()
                .filter_map(super::Leg::cylinder)
                .flat_map(|d| scene.drivers[d].kind.parts())
            {
                if !links.contains(l) {
                    links.push(*l);
                }
            }
        }
        // In numerical order: a block may be named in its guide only, after all other links.
        links.sort_by_key(|l| (scene.link_name(*l).parse::<u64>().unwrap_or(u64::MAX), *l));
        links
    }

    /// Returns the kind of a single step; for several steps the pairs of their two links, with the
    /// inner pair in the middle, or the kind of the step of the highest class.
    fn kind_of(&self, scene: &Scene, steps: &[&Group], links: &[LinkId]) -> String {
        if let [one] = steps {
            return one.kind();
        }
        if let Some(driven) = steps.iter().find(|g| g.class().is_none() && !g.is_carried()) {
            return driven.kind();
        }
        if let [a, b] = links[..] {
            let (mut inner, mut outer) = (Vec::new(), Vec::new());
            let mut pair = |letter: char, ends: [LinkId; 2]| match ends.map(|l| l == a || l == b) {
                [true, true] => inner.push(letter),
                [true, false] | [false, true] => outer.push(letter),
                [false, false] => {}
            };
            for (guide, on) in steps
                .iter()
                .flat_map(|g| &g.constraints)
                .filter_map(|c| self.constraints[*c].form().point_guide())
            {
                scene.guides[guide.0].slider.iter().for_each(|s| pair('P', [*s, on]));
            }
            for p in (0..scene.points.len()).map(PointId) {
                let on: Vec<LinkId> = scene.carriers(p).collect();
                on.windows(2).for_each(|w| pair('R', [w[0], w[1]]));
            }
            if let ([inner], [first, last]) = (&inner[..], &outer[..]) {
                // By convention a turning pair comes first.
                let ends = if first < last { [last, first] } else { [first, last] };
                return [ends[0], inner, ends[1]].into_iter().collect();
            }
        }
        let highest = ["IV or higher", "III", "II"]
            .into_iter()
            .find_map(|class| steps.iter().find(|g| g.class() == Some(class)));
        highest.map_or_else(String::new, |g| g.kind())
    }
}
