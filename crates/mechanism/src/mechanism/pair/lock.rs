//! A slider keeps its direction relative to the link that carries its guide.
//!
//! A block that only follows its pin is no node of the graph: its constraint is omitted with it. On
//! an arc there are only such blocks, which turn with the tangent.

use super::{Demands, PairForm, PairKind};
use hodograph_base::diag::both;
use hodograph_scene::GuidePath;

pub(super) const LOCK: PairKind = PairKind {
    form: Demands::Guide(|_, g| match g.path {
        GuidePath::Line { .. } => {
            Some(PairForm::Angles { of: g.slider?, against: g.on, driver: None })
        }
        GuidePath::Arc { .. } => None,
    }),
    words: |scene, slider, on| both!("slider {} on link {}", slider.name(scene), on.name(scene)),
};
