//! A pin on a link: each link at a pin has its own point there.

use super::{Demands, PairForm, PairKind};
use hodograph_base::diag::both;

pub(super) const PIN: PairKind = PairKind {
    form: Demands::Pin(|pin, link| Some(PairForm::Meet { pin, link })),
    words: |scene, pin, link| both!("pin {} on link {}", pin.name(scene), link.name(scene)),
};
