//! A pin on a link: each link at a pin has its own point there.

use super::{Demands, Form, Kind};
use hodograph_base::diag::both;

pub(super) const PIN: Kind = Kind {
    form: Demands::Pin(|pin, link| Some(Form::Meet { pin, link })),
    words: |scene, pin, link| both!("pin {} on link {}", "构件 {1} 上的销 {0}", pin.name(scene), link.name(scene)),
};
