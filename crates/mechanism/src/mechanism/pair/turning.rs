//! A rotary driver: a crank relative to ground or to another link.

use super::{Demands, DriverForm, PairForm, PairKind};
use hodograph_base::diag::both;

pub(super) const TURNING: PairKind = PairKind {
    form: Demands::Driver(DriverForm {
        form: |d, kind, _| {
            let (of, against) = kind.turned()?;
            Some(PairForm::Angles { of, against, driver: Some(d) })
        },
        mover: |scene, link, _| both!("driver link {}", link.name(scene)),
        moved: |scene, link, _| both!("link {}", link.name(scene)),
    }),
    words: |scene, link, _| both!("the driver of link {}", link.name(scene)),
};
