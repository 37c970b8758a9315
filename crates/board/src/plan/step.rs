//! Accessors of a step: its vertex, its chains, the guides along which its terms slide, the body whose turning makes its Coriolis part.

use super::{By, Chain, Plan, Step, VertexId};
use hodograph_scene::{GuideId, LinkId, Scene};

impl Step {
    /// The vertex that it finds.
    pub fn target(&self) -> VertexId {
        match self {
            Step::Equation { target, .. } | Step::Image { target, .. } | Step::Same { target, .. } => *target,
        }
    }

    /// The chains of an equation; none of other steps.
    pub fn chains(&self) -> &[Chain] {
        match self {
            Step::Equation { chains, .. } => chains,
            Step::Image { .. } | Step::Same { .. } => &[],
        }
    }

    /// Whether a term of the step slides along a guide.
    pub fn slides_along(&self, guide: GuideId) -> bool {
        let mut terms = self.chains().iter().flat_map(|c| c.known.iter().chain(&c.unknown));
        terms.any(|t| matches!(t.by, By::Guide { guide: g, .. } if g == guide))
    }
}

impl Plan {
    /// The link with whose turning the Coriolis acceleration at a guide is laid off: that which carries it.
    pub fn coriolis_link(&self, scene: &Scene, guide: GuideId) -> LinkId {
        match self.coriolis_by {
            Some((wrong, by)) if wrong == guide => by,
            Some(_) | None => scene.guides[guide.0].on,
        }
    }
}
