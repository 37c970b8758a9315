//! Two neighbours in a belt or chain. The belt neither stretches nor slips, and a link keeps the
//! distance of the axes: relative to that link both turn as two wheels that roll on each other, in
//! an open belt as one inside the other.

use super::{Demands, PairKind};
use hodograph_base::diag::both;
use hodograph_scene::RollingKind;

pub(super) const BELT: PairKind = PairKind {
    form: Demands::Rolling {
        kind: RollingKind::Belt,
        told: |a, b| both!("a belt runs round {a} and {b}"),
    },
    words: |scene, a, b| both!("the belt between links {} and {}", a.name(scene), b.name(scene)),
};

pub(super) const CHAIN: PairKind = PairKind {
    form: Demands::Rolling {
        kind: RollingKind::Chain,
        told: |a, b| both!("a chain runs round {a} and {b}"),
    },
    words: |scene, a, b| both!("the chain between links {} and {}", a.name(scene), b.name(scene)),
};
