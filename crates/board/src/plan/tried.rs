//! The equations that the points of a group offer before the group is solved: which of them can be
//! solved, and which have too many unknowns (方程可解与不可解).
//!
//! When the planner comes to a group, each point of it that is not yet known is tried: the chains
//! are those that the known bodies give, written by the functions that write the plan. An equation
//! v_C = v_B + v_CB of one chain has the magnitude and the direction of v_C and the magnitude of
//! v_CB as unknowns. Where two chains lead to one point, the vector of the point is eliminated.
//! Nothing is kept: the trials do not change the plan.

use super::build::{PlanBuilder, built, slot};
use super::reduce::members;
use super::{GroupChoices, Plan, PlanStep, TermChain, TurningBody, VertexId, VertexPlace};
use hodograph_mechanism::mechanism::{Core, CoreLoci, Demand, Hold, Level, Mechanism, Strut};
use hodograph_scene::{DiagramKind, LinkId, Scene};

/// The trials of a group on a diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupTrial {
    /// The diagram.
    pub on: DiagramKind,
    /// The index of the group.
    pub group: usize,
    /// The points, in the order of trying.
    pub points: Vec<PointTrial>,
}

/// The equation that a point offers.
#[derive(Clone, Debug, PartialEq)]
pub struct PointTrial {
    /// The point.
    pub target: VertexId,
    /// The chains that lead to it from known points; empty if none does.
    pub chains: Vec<TermChain>,
}

/// A constraint by a known body, and the link that it holds; none for that of a pin.
type CoreHold = (Option<LinkId>, Hold);

/// Returns the number of unknowns of an equation for a point, and the number that it settles: its
/// own vector has two unless several chains lead to it, each chain one. A single chain from a fixed
/// point is the direction of the vector and no equation.
pub fn unknowns(plan: &Plan, chains: &[TermChain]) -> [usize; 2] {
    // All unknown terms of a chain are along one line: together they are one magnitude.
    let open = chains.iter().filter(|c| !c.unknown.is_empty()).count();
    match chains {
        [] => [2, 0],
        [one] if plan.vertex(one.start).fixed => [open, 0],
        [_] => [2 + open, 2],
        more => [open, 2 * (more.len() - 1)],
    }
}

impl GroupTrial {
    /// Returns the trials with the first equation that the planner writes for the group in place of
    /// the trial of its point: a link that translates or rolls has further chains.
    pub(super) fn with_first_of(mut self, alternatives: &[Vec<PlanStep>]) -> GroupTrial {
        let first = alternatives.first().into_iter().flatten().find_map(|step| match step {
            PlanStep::Equation { target, chains, .. } => Some((*target, chains)),
            PlanStep::Image { .. } | PlanStep::Same { .. } | PlanStep::Trials { .. } => None,
        });
        if let Some((target, chains)) = first {
            let of_target = self.points.iter_mut().filter(|p| p.target == target);
            of_target.for_each(|p| p.chains.clone_from(chains));
        }
        self
    }
}

impl PointTrial {
    /// Returns true if the equation has no more unknowns than it settles.
    pub fn is_solvable(&self, plan: &Plan) -> bool {
        let [open, settled] = unknowns(plan, &self.chains);
        open <= settled
    }
}

/// Returns a plan with the trials of each group. It has the steps of [`super::plan`]; its list of
/// vertices also contains the points tried.
pub fn plan_tried(scene: &Scene, m: &Mechanism, demand: &Demand) -> (Plan, Vec<GroupTrial>) {
    built(scene, m, demand, &GroupChoices::default(), true)
}

impl PlanBuilder<'_> {
    /// Tries the points of a group.
    pub(super) fn try_points(&mut self, level: Level, g: usize) -> GroupTrial {
        let before =
            (self.stages.clone(), self.known.clone(), self.sources.clone(), self.pending.clone());
        let (holds, turning) = self.holds_of(g);
        let mut targets: Vec<VertexId> = Vec::new();
        for (core, hold) in &holds {
            targets.extend(self.held(*core, hold));
        }
        // A driven link and a pin of a known link have no equation with unknowns.
        let links = if holds.is_empty() { Vec::new() } else { self.m.groups[g].links.clone() };
        for link in links {
            for p in self.scene.links[link.0].points.clone() {
                targets.push(self.pin(p));
            }
        }
        let mut points: Vec<PointTrial> = Vec::new();
        for target in targets {
            if self.is_known(level, target) || points.iter().any(|p| p.target == target) {
                continue;
            }
            let chains = self.chains_to(level, g, target, (&holds, turning));
            points.push(PointTrial { target, chains });
        }
        (self.stages, self.known, self.sources, self.pending) = before;
        GroupTrial { on: DiagramKind::of(level), group: g, points }
    }

    /// The constraints by known bodies, with the link that they hold; and the link whose direction
    /// a known link determines.
    fn holds_of(&self, g: usize) -> (Vec<CoreHold>, Option<LinkId>) {
        match &self.m.groups[g].core {
            Core::Pin { legs, .. } => {
                (CoreLoci::of(legs).holds.into_iter().map(|h| (None, h)).collect(), None)
            }
            Core::Link { link, legs } => {
                let CoreLoci { holds, angle, .. } = CoreLoci::of(legs);
                let turning = angle.map(|_| *link);
                (holds.into_iter().map(|h| (Some(*link), h)).collect(), turning)
            }
            Core::Higher => {
                let members = members(self.scene, self.m, g).unwrap_or_default();
                let holds = members
                    .into_iter()
                    .flat_map(|m| m.holds.into_iter().map(move |h| (Some(m.link), h)));
                (holds.collect(), None)
            }
        }
    }

    /// The point that a constraint holds.
    fn held(&mut self, core: Option<LinkId>, hold: &Hold) -> Option<VertexId> {
        match (core, *hold) {
            (Some(link), _) => self.near(link, hold),
            (None, Hold::Distance { near: pin, .. } | Hold::Guide { pin, .. }) => {
                Some(self.pin(pin))
            }
            (None, Hold::Slot { .. } | Hold::Rolls { .. } | Hold::Glide { .. }) => None,
        }
    }

    /// The chains from known points to a point of a group: by the constraints that hold it, and
    /// from a known point of each link that carries it.
    fn chains_to(
        &mut self,
        level: Level,
        g: usize,
        target: VertexId,
        (holds, turning): (&[CoreHold], Option<LinkId>),
    ) -> Vec<TermChain> {
        let mut chains = Vec::new();
        let mut written: Vec<LinkId> = Vec::new();
        for (core, hold) in holds {
            if self.held(*core, hold) != Some(target) {
                continue;
            }
            if let Hold::Distance { strut: Strut::Bar(link) | Strut::Ram { link, .. }, .. } = hold {
                written.push(*link);
            }
            chains.push(self.chain(level, *core, hold, None));
        }
        let vertex = self.vertices[target.0];
        let carriers: Vec<LinkId> = match (vertex.on, vertex.spot) {
            (Some(link), _) => vec![link],
            (None, VertexPlace::Point(p)) => self.scene.carriers(p).collect(),
            (None, VertexPlace::Special(_)) => Vec::new(),
        };
        for link in carriers {
            if written.contains(&link) || !self.m.groups[g].links.contains(&link) {
                continue;
            }
            let Some(&start) = self.known_on(level, link).first() else { continue };
            let body = TurningBody::Link(link);
            let known = self.sources[slot(level)].iter().any(|(b, _)| *b == body)
                || turning == Some(link)
                || self.m.never_turns[link.0];
            let (known, unknown) = self.turning(level, body, target, start, known);
            chains.push(TermChain { start, known, unknown });
        }
        // The chain from a fixed point comes first, as in the plan.
        chains.sort_by_key(|c| !self.vertices[c.start.0].fixed);
        chains
    }
}
