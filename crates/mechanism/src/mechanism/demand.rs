//! The groups that the requests of a scene need, each with its level: only these are solved.

use super::{GraphNode, Mechanism};
use hodograph_scene::quantity::{Level, Need};
use hodograph_scene::{Find, LinkId, PointId, Rub, Scene};

/// The demand of a set of requests.
#[derive(Clone, Debug, PartialEq)]
pub struct Demand {
    /// For each group the level up to which it is needed; `None` if it is not needed.
    pub groups: Vec<Option<Level>>,
    /// The highest requested level.
    pub level: Level,
    /// The individual needs, each with its level of motion, in order of the requests, without
    /// repetition.
    pub needs: Vec<(Need, Level)>,
}

impl Demand {
    /// Returns the demand of the scene's `find` list.
    pub fn of(scene: &Scene, m: &Mechanism) -> Demand {
        Demand::of_questions(scene, m, &scene.find)
    }

    /// Returns the demand of some requests.
    pub fn of_questions<'a>(
        scene: &Scene,
        m: &Mechanism,
        questions: impl IntoIterator<Item = &'a Find>,
    ) -> Demand {
        let mut d = Demand {
            groups: vec![None; m.groups.len()],
            level: Level::Position,
            needs: Vec::new(),
        };
        for f in questions {
            for (need, level) in f.what.needs() {
                d.add(scene, m, need, level);
            }
            for l in f.what.places(scene).into_iter().filter(|l| *l != scene.ground) {
                d.place(scene, m, l);
            }
        }
        d
    }

    /// Adds the position of a link, and everything upstream of it.
    fn place(&mut self, scene: &Scene, m: &Mechanism, l: LinkId) {
        for n in nodes_of(scene, m, Need::Turning(l)) {
            self.mark(m, group_of(m, n), Level::Position);
        }
    }

    /// Adds one need and everything upstream of it.
    pub fn add(&mut self, scene: &Scene, m: &Mechanism, need: Need, level: Level) {
        if !self.needs.contains(&(need, level)) {
            self.needs.push((need, level));
            if need == Need::Forces {
                self.loaded(scene, m);
            }
        }
        self.level = self.level.max(level);
        for n in nodes_of(scene, m, need) {
            self.mark(m, group_of(m, n), level);
        }
    }

    /// Adds the needs of the loads of a scene: the positions of loaded links, accelerations of
    /// links with mass, velocities of resisted motions.
    fn loaded(&mut self, scene: &Scene, m: &Mechanism) {
        let loads = &scene.loads;
        let springs = loads
            .springs
            .iter()
            .flat_map(|s| s.ends.map(|(_, link)| link))
            .filter(|l| *l != scene.ground);
        let links = loads
            .masses
            .iter()
            .map(|m| m.link)
            .chain(loads.applied.iter().map(|a| a.link))
            .chain(springs);
        for link in links.chain(loads.balance.as_ref().map(|b| b.link)) {
            self.place(scene, m, link);
        }
        for mass in loads.masses.iter().filter(|_| scene.has_inertia()) {
            if let (Some(_), Some(s)) = (&mass.m, mass.at) {
                self.add(scene, m, Need::Point(s, None), Level::Acceleration);
            }
            if mass.j.is_some() {
                self.add(scene, m, Need::Turning(mass.link), Level::Acceleration);
            }
        }
        for (point, _) in loads.applied.iter().filter_map(|a| a.stroke()) {
            self.add(scene, m, Need::Point(point, None), Level::Velocity);
        }
        for applied in loads.applied.iter().filter(|a| a.size.is_against_motion()) {
            match applied.at {
                Some(p) => self.add(scene, m, Need::Point(p, Some(applied.link)), Level::Velocity),
                None => self.add(scene, m, Need::Turning(applied.link), Level::Velocity),
            }
        }
        for friction in &loads.friction {
            match friction.at {
                Rub::Pin { point, .. } => {
                    for link in scene.carriers(point).filter(|l| *l != scene.ground) {
                        self.add(scene, m, Need::Turning(link), Level::Velocity);
                    }
                }
                Rub::Guide { guide, .. } => {
                    let Some((slider, point)) = scene.sliding_at(guide) else { continue };
                    for link in [slider, scene.guides[guide.0].on]
                        .into_iter()
                        .filter(|l| *l != scene.ground)
                    {
                        self.add(scene, m, Need::Point(point, Some(link)), Level::Velocity);
                    }
                }
            }
        }
        // The moment of a driver acts on the part that it drives.
        for constraint in m.constraints.iter().filter(|c| c.form().driver().is_some()) {
            let (a, b) = constraint.ends();
            for node in [a, b] {
                self.mark(m, group_of(m, node), Level::Position);
            }
        }
    }

    /// True if forces are requested.
    pub fn wants_forces(&self) -> bool {
        self.needs.iter().any(|(need, _)| *need == Need::Forces)
    }

    /// Marks a group and all groups on which it depends.
    fn mark(&mut self, m: &Mechanism, group: Option<usize>, level: Level) {
        let mut stack: Vec<usize> = group.into_iter().collect();
        while let Some(g) = stack.pop() {
            if self.groups[g].is_some_and(|l| l >= level) {
                continue;
            }
            self.groups[g] = Some(level);
            stack.extend(&m.groups[g].upstream);
        }
    }

    /// Adds the positions of all groups, for a drawing of the whole mechanism.
    pub fn with_all_positions(mut self) -> Demand {
        for g in &mut self.groups {
            g.get_or_insert(Level::Position);
        }
        self
    }

    /// Returns true if the position of a pin is requested.
    pub fn places(&self, m: &Mechanism, pin: PointId) -> bool {
        m.group_of_pin[pin.0].is_some_and(|g| self.groups[g].is_some())
    }

    /// Returns true if a group is needed at a level.
    pub fn wants(&self, group: usize, level: Level) -> bool {
        self.groups[group].is_some_and(|l| l >= level)
    }
}

fn group_of(m: &Mechanism, n: GraphNode) -> Option<usize> {
    match n {
        GraphNode::Link(l) => m.group_of_link[l.0],
        GraphNode::Pin(p) => m.group_of_pin[p.0],
    }
}

/// Returns the nodes that must be known for a need.
pub fn nodes_of(scene: &Scene, m: &Mechanism, need: Need) -> Vec<GraphNode> {
    let link_nodes =
        |l: LinkId| m.passive_carrier(scene, l).unwrap_or_else(|| vec![GraphNode::Link(l)]);
    match need {
        Need::Turning(l) => link_nodes(l),
        Need::Forces => Vec::new(),
        Need::Point(p, link) => {
            let mut nodes = match link {
                Some(l) => link_nodes(l),
                None => Vec::new(),
            };
            // The position of the cam determines the contact of a follower without a pair there.
            let led = scene
                .cams
                .iter()
                .filter(|c| c.is_on_course() && c.follows.point() == p)
                .map(|c| c.cam);
            nodes.extend(led.filter(|l| *l != scene.ground).flat_map(link_nodes));
            if m.pins.contains(&p) {
                nodes.push(GraphNode::Pin(p));
            } else {
                // The position of the point follows from its own link, even if the vector of
                // another link's point is requested; the position of a contact follows from both
                // links.
                nodes.extend(scene.carriers(p).next().map(link_nodes).unwrap_or_default());
                let rolling = scene.rolling.iter().filter(|r| r.at.contains(&p));
                let cams = scene
                    .cams
                    .iter()
                    .filter(|c| c.touch == Some(p))
                    .flat_map(|c| [c.cam, c.follower]);
                nodes.extend(
                    rolling
                        .flat_map(|r| r.links)
                        .chain(cams)
                        .filter(|l| *l != scene.ground)
                        .flat_map(link_nodes),
                );
            }
            nodes
        }
    }
}
