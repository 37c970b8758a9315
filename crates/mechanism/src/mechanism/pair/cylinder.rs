//! A cylinder: a driver of the distance of two pins. Barrel and rod follow the line of the pins.

use super::{Demands, DriverForm, PairForm, PairKind};
use hodograph_base::diag::both;

pub(super) const CYLINDER: PairKind = PairKind {
    form: Demands::Driver(DriverForm {
        form: |driver, kind, _| {
            let [from, to] = kind.ends()?;
            Some(PairForm::Distance { from, to, driver })
        },
        mover: |scene, from, to| both!("cylinder {}{}", from.name(scene), to.name(scene)),
        moved: |scene, from, to| both!("at a sign" => "cylinder {}{}", from.name(scene), to.name(scene)),
    }),
    words: |scene, from, to| both!("the cylinder {}{}", from.name(scene), to.name(scene)),
};
