//! A slider without a pin, such as a yoke, keeps its distance from its guide.

use super::{Demands, PairForm, PairKind, Runner, lock};

pub(super) const GLIDE: PairKind = PairKind {
    form: Demands::Guide(|guide, g| match (g.pin, g.slider) {
        (None, Some(slider)) => {
            Some(PairForm::OnPath { runner: Runner::Link(slider), guide, on: g.on })
        }
        (Some(_), _) | (None, None) => None,
    }),
    // Lock and glide are one slider to a reader.
    words: lock::LOCK.words,
};
