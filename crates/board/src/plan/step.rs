//! Accessors of a step: its vertex, its chains, the guides along which its terms slide, the link
//! that gives the angular velocity of its Coriolis part.

use super::{Plan, PlanStep, TermChain, TermConnection, VertexId};
use hodograph_scene::{DiagramKind, GuideId, LinkId, Scene};

impl PlanStep {
    /// Returns the vertex that the step finds.
    pub fn target(&self) -> VertexId {
        match self {
            PlanStep::Equation { target, .. }
            | PlanStep::Image { target, .. }
            | PlanStep::Trials { target, .. }
            | PlanStep::Same { target, .. } => *target,
        }
    }

    /// Returns the chains of an equation; empty for other steps.
    pub fn chains(&self) -> &[TermChain] {
        match self {
            PlanStep::Equation { chains, .. } => chains,
            PlanStep::Image { .. } | PlanStep::Trials { .. } | PlanStep::Same { .. } => &[],
        }
    }

    /// Returns the vertices from which the step starts.
    pub fn sources(&self) -> Vec<VertexId> {
        match self {
            PlanStep::Equation { chains, .. } => chains.iter().map(|c| c.start).collect(),
            PlanStep::Image { from: (a, b), .. } => vec![*a, *b],
            PlanStep::Trials { images, mates, .. } => images.iter().chain(mates).copied().collect(),
            PlanStep::Same { from, .. } => vec![*from],
        }
    }

    /// True if a term of the step slides along a guide.
    pub fn slides_along(&self, guide: GuideId) -> bool {
        let mut terms = self.chains().iter().flat_map(|c| c.known.iter().chain(&c.unknown));
        terms.any(|t| matches!(t.by, TermConnection::Guide { guide: g, .. } if g == guide))
    }
}

impl Plan {
    /// Returns the images of a vertex in two trials, and their mates.
    ///
    /// # Panics
    /// If the vertex is not found by trials.
    pub fn trials(&self, on: DiagramKind, v: VertexId) -> [[VertexId; 2]; 2] {
        let steps = self.steps(on).iter().flat_map(|g| g.alternatives.iter().flatten());
        let mut found = steps.filter_map(|step| {
            let PlanStep::Trials { target, images, mates } = step else { return None };
            (*target == v).then_some([*images, *mates])
        });
        found.next().expect("trials give the vertex")
    }

    /// Returns the vertex of the final polygon that corresponds to a trial's vertex.
    pub fn untried(&self, v: VertexId) -> VertexId {
        let tried = self.vertex(v);
        if tried.trial.is_none() {
            return v;
        }
        self.vertices
            .iter()
            .position(|own| own.trial.is_none() && own.is_at(tried))
            .map_or(v, VertexId)
    }

    /// Returns the link with the angular velocity that the Coriolis acceleration at a guide uses:
    /// the guide's carrier, or the link that a wrong solution uses instead.
    pub fn coriolis_link(&self, scene: &Scene, guide: GuideId) -> LinkId {
        match self.coriolis_by {
            Some((wrong, by)) if wrong == guide => by,
            Some(_) | None => scene.guides[guide.0].on,
        }
    }
}
