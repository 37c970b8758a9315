//! A turning driver: a crank against ground or against another link.

use super::{Demands, Form, Kind};
use crate::diag::both;

pub(super) const TURNING: Kind = Kind {
    form: Demands::OfDriver(|d, kind, _| {
        let (of, against) = kind.turned()?;
        Some(Form::Angles { of, against, driver: Some(d) })
    }),
    words: |scene, link, _| both!("the driver of link {}", "构件 {} 的原动件", link.name(scene)),
};
