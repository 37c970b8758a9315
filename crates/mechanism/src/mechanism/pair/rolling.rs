//! Rolling pairs: gears in mesh or on a rack, and a wheel on its track.

use super::{Demands, PairKind};
use hodograph_base::diag::both;
use hodograph_scene::RollingKind;

/// Two links with teeth; their rolling contours are pitch circles and pitch lines.
pub(super) const GEARS: PairKind = PairKind {
    form: Demands::Rolling { kind: RollingKind::Gears, told: |a, b| both!("{a} and {b} mesh") },
    words: |scene, a, b| both!("the gear pair of links {} and {}", a.name(scene), b.name(scene)),
};

/// A wheel without teeth that a separate guide keeps on the track.
pub(super) const WHEEL: PairKind = PairKind {
    form: Demands::Rolling {
        kind: RollingKind::Wheel,
        told: |track, wheel| both!("wheel {wheel} rolls on {track} without slip"),
    },
    words: |scene, track, wheel| {
        both!("the rolling of link {1} on link {0}", track.name(scene), wheel.name(scene))
    },
};
