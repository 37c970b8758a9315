//! Rolling pairs: gears in mesh or on a rack, and a wheel on its track.

use super::{Demands, Form, Kind};
use crate::diag::both;
use crate::scene::RollingKind;

/// Two links with teeth; their rolling contours are pitch circles and pitch lines.
pub(super) const GEARS: Kind = Kind {
    form: Demands::Rolling(|pair, p| (p.kind == RollingKind::Gears).then_some(Form::Related { pair, links: p.links })),
    words: |scene, a, b| both!("the gear pair of links {} and {}", "构件 {} 与 {} 的齿轮副", a.name(scene), b.name(scene)),
};

/// A wheel without teeth, which a guide of its own keeps on the track.
pub(super) const WHEEL: Kind = Kind {
    form: Demands::Rolling(|pair, p| (p.kind == RollingKind::Wheel).then_some(Form::Related { pair, links: p.links })),
    words: |scene, track, wheel| {
        both!("the rolling of link {1} on link {0}", "构件 {1} 在构件 {0} 上的滚动", track.name(scene), wheel.name(scene))
    },
};
