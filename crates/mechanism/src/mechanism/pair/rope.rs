//! A rope between a drum and the load that it pulls: it neither stretches nor slips.

use super::{Demands, PairKind};
use hodograph_base::diag::both;
use hodograph_scene::RollingKind;

pub(super) const ROPE: PairKind = PairKind {
    form: Demands::Rolling {
        kind: RollingKind::Rope,
        told: |load, drum| both!("a rope wound on drum {drum} draws {load}"),
    },
    words: |scene, load, drum| {
        both!("the rope between drum {1} and link {0}", load.name(scene), drum.name(scene))
    },
};
