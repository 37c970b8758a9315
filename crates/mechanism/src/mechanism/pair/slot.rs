//! A pin in a guide, straight or along an arc.

use super::{Demands, PairForm, PairKind, Runner};
use hodograph_base::diag::both;

pub(super) const SLOT: PairKind = PairKind {
    form: Demands::Guide(|guide, g| {
        Some(PairForm::OnPath { runner: Runner::Pin(g.pin?), guide, on: g.on })
    }),
    words: |scene, pin, on| {
        both!("pin {} in the guide on link {}", pin.name(scene), on.name(scene))
    },
};
