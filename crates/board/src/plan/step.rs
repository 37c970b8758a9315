//! Accessors of a step: its vertex, its chains, the guides along which its terms slide, the body whose turning makes its Coriolis part.

use super::{By, Chain, Plan, Step, VertexId};
use hodograph_scene::{DiagramKind, GuideId, LinkId, Scene};

impl Step {
    /// The vertex that it finds.
    pub fn target(&self) -> VertexId {
        match self {
            Step::Equation { target, .. } | Step::Image { target, .. } | Step::Trials { target, .. } | Step::Same { target, .. } => *target,
        }
    }

    /// The chains of an equation; none of other steps.
    pub fn chains(&self) -> &[Chain] {
        match self {
            Step::Equation { chains, .. } => chains,
            Step::Image { .. } | Step::Trials { .. } | Step::Same { .. } => &[],
        }
    }

    /// The vertices that it starts from.
    pub fn sources(&self) -> Vec<VertexId> {
        match self {
            Step::Equation { chains, .. } => chains.iter().map(|c| c.start).collect(),
            Step::Image { from: (a, b), .. } => vec![*a, *b],
            Step::Trials { images, mates, .. } => images.iter().chain(mates).copied().collect(),
            Step::Same { from, .. } => vec![*from],
        }
    }

    /// Whether a term of the step slides along a guide.
    pub fn slides_along(&self, guide: GuideId) -> bool {
        let mut terms = self.chains().iter().flat_map(|c| c.known.iter().chain(&c.unknown));
        terms.any(|t| matches!(t.by, By::Guide { guide: g, .. } if g == guide))
    }
}

impl Plan {
    /// The images of a vertex in two trials, and their mates.
    ///
    /// # Panics
    /// For a vertex that no trials give.
    pub fn trials(&self, on: DiagramKind, v: VertexId) -> [[VertexId; 2]; 2] {
        let steps = self.steps(on).iter().flat_map(|g| g.alternatives.iter().flatten());
        let mut found = steps.filter_map(|step| {
            let Step::Trials { target, images, mates } = step else { return None };
            (*target == v).then_some([*images, *mates])
        });
        found.next().expect("trials give the vertex")
    }

    /// The vertex of the polygon that is sought, for that of a trial.
    pub fn untried(&self, v: VertexId) -> VertexId {
        let tried = self.vertex(v);
        if tried.trial.is_none() {
            return v;
        }
        self.vertices.iter().position(|own| own.trial.is_none() && own.is_at(tried)).map_or(v, VertexId)
    }

    /// The link with whose turning the Coriolis acceleration at a guide is laid off: that which carries it.
    pub fn coriolis_link(&self, scene: &Scene, guide: GuideId) -> LinkId {
        match self.coriolis_by {
            Some((wrong, by)) if wrong == guide => by,
            Some(_) | None => scene.guides[guide.0].on,
        }
    }
}
