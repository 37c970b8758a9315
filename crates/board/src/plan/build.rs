//! Writes the equations of all groups in solving order, those of velocities before those of
//! accelerations.

use super::between::body_of;
use super::names::small_letters;
use super::tried::GroupTrial;
use super::{
    GroupSteps, Method, Plan, PlanStage, PlanStep, Rate, Rest, Special, TermChain, TurningBody,
    Vertex, VertexId, VertexPlace, VertexTrial, canonical, effects,
};
use hodograph_mechanism::mechanism::{Demand, Level, Mechanism, Need, Opened};
use hodograph_scene::{Guide, GuideId, LinkId, PointId, Scene};
use std::collections::{BTreeMap, HashMap, HashSet};

/// The choices for drawing the groups of a scene in a pose.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct GroupChoices {
    /// Groups that cannot be drawn: they, and the groups that depend on them, count as undrawable.
    pub left_out: Vec<usize>,
    /// The way of drawing for groups of higher class, if it is not the first in the order of
    /// [`Plan`]: special points, common points of two links, then trial polygons, each with a
    /// different assumed rate or a different removed bar.
    pub way: BTreeMap<usize, usize>,
}

/// Returns the plan of a scene's demand.
///
/// It needs no positions: the same topology with other lengths gives the same plan.
pub fn plan(scene: &Scene, m: &Mechanism, demand: &Demand) -> Plan {
    plan_with(scene, m, demand, &GroupChoices::default())
}

/// Returns the plan with the ways that a pose requires.
pub fn plan_with(scene: &Scene, m: &Mechanism, demand: &Demand, ways: &GroupChoices) -> Plan {
    built(scene, m, demand, ways, false).0
}

/// Returns a plan; if `trying`, with the trials of each group, whose points are among the vertices.
pub(super) fn built(
    scene: &Scene,
    m: &Mechanism,
    demand: &Demand,
    ways: &GroupChoices,
    trying: bool,
) -> (Plan, Vec<GroupTrial>) {
    let mut b = PlanBuilder {
        scene,
        m,
        demand,
        vertices: Vec::new(),
        specials: Vec::new(),
        stages: Vec::new(),
        interned: HashMap::new(),
        known: [HashSet::new(), HashSet::new()],
        sources: [Vec::new(), Vec::new()],
        pending: Vec::new(),
        undrawable: ways.left_out.clone(),
        way: &ways.way,
        due: vec![Vec::new(); m.groups.len()],
        tried: trying.then(Vec::new),
    };
    b.assign_needs();
    b.parts_first();
    for level in Level::RATES {
        if demand.level >= level {
            b.walk(level);
        }
    }
    // From the last level down: the acceleration terms may need an angular velocity of the velocity
    // level.
    for level in Level::RATES.into_iter().rev() {
        b.draw_between(level);
    }
    let mut plan = Plan {
        vertices: b.vertices,
        specials: b.specials,
        stages: b.stages.into_iter().filter(|s| !s.groups.is_empty()).collect(),
        still: m.never_turns.clone(),
        rest: Rest::of(scene, m),
        letters: small_letters(scene),
        level: demand.level,
        effects: Vec::new(),
        undrawable: b.undrawable,
        coriolis_by: None,
    };
    plan.effects = effects::considered(scene, m, demand, &plan);
    (plan, b.tried.unwrap_or_default())
}

pub(super) struct PlanBuilder<'a> {
    pub scene: &'a Scene,
    pub m: &'a Mechanism,
    pub(super) demand: &'a Demand,
    pub(super) vertices: Vec<Vertex>,
    specials: Vec<Special>,
    pub(super) stages: Vec<PlanStage>,
    /// The index of each vertex in the list.
    interned: HashMap<(VertexPlace, Option<LinkId>), VertexId>,
    /// The known vertices at each level.
    pub(super) known: [HashSet<VertexId>; 2],
    /// The source of each body's angular quantity at each level, once its group is done.
    pub(super) sources: [Vec<(TurningBody, Rate)>; 2],
    /// The steps of the group in progress.
    pub(super) pending: Vec<PlanStep>,
    undrawable: Vec<usize>,
    pub(super) way: &'a BTreeMap<usize, usize>,
    /// For each group, the demands that can be answered once it is done, with their level.
    pub(super) due: Vec<Vec<(Need, Level)>>,
    /// The trials of the groups so far; `None` if nothing is tried.
    tried: Option<Vec<GroupTrial>>,
}

pub(super) fn slot(level: Level) -> usize {
    match level {
        Level::Acceleration => 1,
        Level::Position | Level::Velocity => 0,
    }
}

impl PlanBuilder<'_> {
    /// Attempts to write steps; if the attempt fails, everything that it wrote is discarded.
    pub(super) fn attempt<T>(&mut self, write: impl FnOnce(&mut Self) -> Option<T>) -> Option<T> {
        let (vertices, specials) = (self.vertices.len(), self.specials.len());
        let (stages, known, sources, pending) =
            (self.stages.clone(), self.known.clone(), self.sources.clone(), self.pending.clone());
        let written = write(self);
        if written.is_none() {
            self.vertices.truncate(vertices);
            self.specials.truncate(specials);
            self.interned.retain(|_, v| v.0 < vertices);
            (self.stages, self.known, self.sources, self.pending) =
                (stages, known, sources, pending);
        }
        written
    }

    pub(super) fn intern(&mut self, spot: VertexPlace, on: Option<LinkId>) -> VertexId {
        if let Some(known) = self.interned.get(&(spot, on)) {
            return *known;
        }
        let ground = self.scene.ground;
        let (number, fixed) = match (spot, on) {
            (_, Some(l)) => (Some(l), l == ground),
            (VertexPlace::Point(p), None) => {
                let fixed = self.scene.links[ground.0].points.contains(&p);
                (self.number_of_pin(p), fixed)
            }
            (VertexPlace::Special(_), None) => (None, false),
        };
        let id = VertexId(self.vertices.len());
        self.vertices.push(Vertex { spot, on, number, fixed, trial: None });
        self.interned.insert((spot, on), id);
        id
    }

    /// Returns the vertex of a trial that represents another vertex.
    pub(super) fn tried(&mut self, v: VertexId, trial: VertexTrial) -> VertexId {
        let vertex = Vertex { fixed: false, trial: Some(trial), ..self.vertices[v.0] };
        let known = self.vertices.iter().position(|own| *own == vertex);
        VertexId(known.unwrap_or_else(|| {
            self.vertices.push(vertex);
            self.vertices.len() - 1
        }))
    }

    /// Returns the number of a pin: a pin has one if a moving link has a separate point at the same
    /// place.
    fn number_of_pin(&self, p: PointId) -> Option<LinkId> {
        let runs = |(i, g): &(usize, &Guide)| {
            g.pin == Some(p) && g.on != self.scene.ground && self.m.guide_holds(g, GuideId(*i))
        };
        let guides: Vec<_> =
            self.scene.guides.iter().enumerate().filter(runs).map(|(_, g)| g).collect();
        if guides.is_empty() {
            return None;
        }
        guides
            .iter()
            .find_map(|g| g.slider)
            .or_else(|| self.scene.carriers(p).find(|l| !self.m.is_passive(*l)))
    }

    /// Returns the vertex of a special point, the same at both levels.
    pub(super) fn special(&mut self, special: Special) -> VertexId {
        let known = self.specials.iter().position(|s| *s == special);
        let index = known.unwrap_or_else(|| {
            self.specials.push(special);
            self.specials.len() - 1
        });
        self.intern(VertexPlace::Special(index), None)
    }

    /// Returns the vertex of a pin, or of a point that belongs to one link.
    pub(super) fn pin(&mut self, p: PointId) -> VertexId {
        self.intern(VertexPlace::Point(p), None)
    }

    /// Returns the point of link `l` at the place of `p`.
    pub(super) fn coincident(&mut self, p: PointId, l: LinkId) -> VertexId {
        self.intern(VertexPlace::Point(p), canonical(self.scene, p, Some(l)))
    }

    /// Returns the point of link `l` at the place of another vertex.
    pub(super) fn on_link(&mut self, v: VertexId, l: LinkId) -> VertexId {
        match self.vertices[v.0].spot {
            VertexPlace::Point(p) => self.coincident(p, l),
            special @ VertexPlace::Special(_) => self.intern(special, Some(l)),
        }
    }

    pub(super) fn learn(&mut self, level: Level, v: VertexId) {
        if !self.is_known(level, v) {
            self.known[slot(level)].insert(v);
        }
    }

    /// Returns the first two known points of a link at a level: the link's own points first, then
    /// coincident ones. No construction needs more.
    pub(super) fn known_on(&self, level: Level, l: LinkId) -> Vec<VertexId> {
        let own =
            self.scene.links[l.0].points.iter().filter(|p| !self.m.is_opened(&Opened::Pin(**p, l)));
        let carried =
            own.filter_map(|p| self.interned.get(&(VertexPlace::Point(*p), None)).copied());
        let coincident = self
            .vertices
            .iter()
            .enumerate()
            .filter(|(_, v)| v.on == Some(l) && v.trial.is_none())
            .map(|(i, _)| VertexId(i));
        carried.chain(coincident).filter(|v| self.is_known(level, *v)).take(2).collect()
    }

    /// True if α of a body vanishes for topological reasons.
    pub(super) fn alpha_is_zero(&self, body: TurningBody) -> bool {
        let TurningBody::Link(l) = body else { return false };
        if self.m.never_turns[l.0] {
            return true;
        }
        match self.sources[1].iter().chain(&self.sources[0]).find(|(b, _)| *b == body) {
            Some((_, Rate::Given { driver, against })) => {
                self.scene.drivers[*driver].acceleration.is_none()
                    && self.alpha_is_zero(TurningBody::Link(*against))
            }
            Some((_, Rate::Same(other))) => self.alpha_is_zero(TurningBody::Link(*other)),
            _ => false,
        }
    }

    /// Requests ω of a body, for the terms of the acceleration level.
    pub(super) fn need_rate(&mut self, body: TurningBody) {
        self.need_rate_at(Level::Velocity, body);
    }

    /// Requests the angular quantity of a body at a level: the step is written after the group that
    /// gives it.
    pub(super) fn need_rate_at(&mut self, level: Level, body: TurningBody) {
        let source = if let TurningBody::Link(l) = body
            && self.m.never_turns[l.0]
        {
            Some(Rate::Zero)
        } else {
            self.sources[slot(level)].iter().find(|(b, _)| *b == body).map(|(_, r)| *r)
        };
        let Some(rate) = source else { return };
        match rate {
            Rate::Given { against, .. } if against != self.scene.ground => {
                self.need_rate_at(level, TurningBody::Link(against))
            }
            Rate::Same(other) => self.need_rate_at(level, TurningBody::Link(other)),
            Rate::Measured { .. } | Rate::Given { .. } | Rate::Zero => {}
        }
        let group = match body {
            // A passive link has no group: its angular quantity is read after those of its pins and
            // of the link that carries it.
            TurningBody::Link(l) if self.m.passive[l.0].is_some() => {
                let nodes =
                    hodograph_mechanism::mechanism::nodes_of(self.scene, self.m, Need::Turning(l));
                nodes.into_iter().filter_map(|n| self.m.group_of(n)).max()
            }
            TurningBody::Link(l) => self.m.group_of_link[l.0],
            TurningBody::Cylinder(d) => {
                let [a, b] = self.scene.drivers[d]
                    .kind
                    .ends()
                    .map(|ends| ends.map(|p| self.m.group_of_pin[p.0]))
                    .unwrap_or_default();
                a.max(b)
            }
        };
        let list = self.list(level);
        // The group in progress already has its entry; rates without a group (ground) belong to the
        // first.
        let entry = match group {
            Some(g) => list.iter_mut().find(|s| s.group == g),
            None => list.first_mut(),
        };
        if let Some(entry) = entry
            && !entry.rates.iter().any(|(b, _)| *b == body)
        {
            entry.rates.push((body, rate));
        }
    }

    /// True if a body's angular quantity follows from what is known so far.
    fn turning_is_known(&self, level: Level, body: TurningBody) -> bool {
        match self.sources[slot(level)].iter().find(|(b, _)| *b == body) {
            Some((_, Rate::Measured { of, to })) => {
                self.is_known(level, *of) && self.is_known(level, *to)
            }
            Some(_) => true,
            None => matches!(body, TurningBody::Link(l) if self.m.never_turns[l.0]),
        }
    }

    pub(super) fn source(&mut self, level: Level, body: TurningBody, rate: Rate) {
        let list = &mut self.sources[slot(level)];
        if !list.iter().any(|(b, _)| *b == body) {
            list.push((body, rate));
        }
    }

    /// Finds a vertex of a known link: by an image, by translation, or by the link's angular
    /// quantity.
    pub(super) fn ensure(&mut self, level: Level, v: VertexId) {
        if self.is_known(level, v) {
            return;
        }
        let vertex = self.vertices[v.0];
        let link = match (vertex.on, vertex.spot) {
            (Some(l), _) => l,
            (None, VertexPlace::Point(p)) => {
                // Two known points suffice for an image; one suffices if the link's angular
                // quantity is known without this point.
                let serves = |l: &LinkId| match self.known_on(level, *l).len() {
                    0 => 0,
                    1 => usize::from(self.turning_is_known(level, self.body(*l))),
                    _ => 2,
                };
                let carriers = self.scene.carriers(p).filter(|l| !self.m.is_passive(*l));
                match carriers.max_by_key(|l| (serves(l), std::cmp::Reverse(l.0))) {
                    Some(l) => l,
                    None => return,
                }
            }
            (None, VertexPlace::Special(_)) => return,
        };
        for p in self.scene.links[link.0].points.clone() {
            // Fixed pivots are known without a request.
            if self.scene.links[self.scene.ground.0].points.contains(&p) {
                self.pin(p);
            }
        }
        let known = self.known_on(level, link);
        let spots_differ =
            |a: VertexId, b: VertexId| self.vertices[a.0].spot != self.vertices[b.0].spot;
        let step = match known[..] {
            [] => return,
            [a, ..] if self.m.never_turns[link.0] || !spots_differ(a, v) => {
                PlanStep::Same { link, target: v, from: a }
            }
            [a, b, ..] => PlanStep::Image { link, target: v, from: (a, b) },
            [a] => {
                let body = self.body(link);
                self.source_of_follower(level, link);
                if !self.turning_is_known(level, body) {
                    // The link belongs to a group that is not drawn.
                    return;
                }
                if level == Level::Velocity || !self.alpha_is_zero(body) {
                    self.need_rate_at(level, body);
                }
                let (terms, _) = self.turning(level, body, v, a, true);
                PlanStep::Equation {
                    target: v,
                    chains: vec![TermChain { start: a, known: terms, unknown: vec![] }],
                    method: Method::Driven,
                }
            }
        };
        self.pending.push(step);
        self.learn(level, v);
    }

    fn walk(&mut self, level: Level) {
        for g in 0..self.m.groups.len() {
            if !self.demand.wants(g, level) {
                continue;
            }
            let group = &self.m.groups[g];
            let undrawable = |g: &usize| self.undrawable.contains(g);
            if undrawable(&g) || group.upstream.iter().any(undrawable) {
                if !self.undrawable.contains(&g) {
                    self.undrawable.push(g);
                }
                continue;
            }
            self.list(level).push(GroupSteps {
                group: g,
                alternatives: Vec::new(),
                between: Vec::new(),
                rates: Vec::new(),
                further: Vec::new(),
            });
            let trial = self.tried.is_some().then(|| self.try_points(level, g));
            let Some(alternatives) = self.group(level, g) else {
                self.list(level).pop();
                self.undrawable.push(g);
                continue;
            };
            if let (Some(all), Some(trial)) = (&mut self.tried, trial) {
                all.push(trial.with_first_of(&alternatives));
            }
            self.list(level).last_mut().expect("just pushed").alternatives = alternatives;
            self.answer_needs(level, g);
        }
    }

    /// Returns the body with which a link turns.
    fn body(&self, l: LinkId) -> TurningBody {
        body_of(self.scene, self.m, l)
    }

    /// Adds the source of a passive link's angular quantity: a block on a curved guide turns like a
    /// bar from the centre of curvature to its pin; a redundant link turns with its two pins.
    fn source_of_follower(&mut self, level: Level, l: LinkId) {
        let (of, to) = if let Some((pin, centre, on)) = self.m.curved_block(self.scene, l) {
            (self.pin(pin), self.coincident(centre, on))
        } else if let Some((a, b)) = self.m.held(l) {
            (self.pin(b), self.pin(a))
        } else {
            return;
        };
        self.ensure(level, of);
        self.ensure(level, to);
        self.source(level, TurningBody::Link(l), Rate::Measured { of, to });
    }

    /// Assigns each demand to the last group that it needs.
    fn assign_needs(&mut self) {
        for (need, level) in &self.demand.needs {
            let nodes = hodograph_mechanism::mechanism::nodes_of(self.scene, self.m, *need);
            if let Some(g) = nodes.into_iter().filter_map(|n| self.m.group_of(n)).max() {
                self.due[g].push((*need, *level));
                // A point of a block on a curved guide, other than its pin, is found by the block's
                // rotation: its acceleration needs the block's ω.
                if let (Need::Point(p, on), Level::Acceleration) = (*need, *level)
                    && let Some(l) = canonical(self.scene, p, on)
                    && self.m.curved_block(self.scene, l).is_some_and(|(pin, ..)| pin != p)
                {
                    self.due[g].push((Need::Turning(l), Level::Velocity));
                }
            }
        }
    }

    /// Finds the wanted points and angular quantities of this group.
    fn answer_needs(&mut self, level: Level, g: usize) {
        for i in 0..self.due[g].len() {
            let (need, wanted) = self.due[g][i];
            if wanted != level {
                continue;
            }
            match need {
                Need::Point(p, on) => {
                    let v = self.intern(VertexPlace::Point(p), canonical(self.scene, p, on));
                    self.ensure(level, v);
                }
                Need::Turning(l) => {
                    let body = self.body(l);
                    self.source_of_follower(level, l);
                    self.need_rate_at(level, body);
                }
                // Forces are not part of a velocity or acceleration polygon.
                Need::Forces => {}
            }
        }
        let steps = std::mem::take(&mut self.pending);
        self.list(level).last_mut().expect("called for a group under way").further = steps;
    }
}
