//! A driver that slides a pin or a slider along its guide.

use super::{Demands, DriverForm, GraphNode, PairForm, PairKind, Runner};
use hodograph_base::diag::both;

pub(super) const SLIDING: PairKind = PairKind {
    form: Demands::Driver(DriverForm {
        form: |driver, kind, scene| {
            let (guide, g) = kind.guide().map(|g| (g, &scene.guides[g.0]))?;
            Some(PairForm::AlongPath { runner: Runner::of(g)?, guide, on: g.on, driver })
        },
        mover: |scene, runner, _| match runner {
            GraphNode::Pin(_) => both!("the drive of {}", runner.name(scene)),
            GraphNode::Link(_) => {
                both!("the drive of link {}", runner.name(scene))
            }
        },
        moved: |scene, runner, _| both!("slider {}", runner.name(scene)),
    }),
    words: |scene, runner, _| match runner {
        GraphNode::Pin(_) => {
            both!("the sliding driver at {}", runner.name(scene))
        }
        GraphNode::Link(_) => {
            both!("the sliding driver of link {}", runner.name(scene))
        }
    },
};
