//! `omega_3`, `alpha_3`: angular velocity and acceleration of a link, positive counter-clockwise;
//! `omega_3/2`: relative to link `2`.

use super::{Entry, Meaning, Of, OverSign, Quantity, Rate, ValueForm};
use crate::model::{LinkId, Scene};
use crate::resolve::Question;
use hodograph_base::diag::{Diagnostic, both};
use hodograph_base::kind::Kind;
use hodograph_base::lang::each;

/// The rotation of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turning {
    /// ω or α.
    pub rate: Rate,
    /// The link.
    pub of: LinkId,
    /// The reference link; `None`: the ground.
    pub against: Option<LinkId>,
}

impl Quantity for Turning {
    const WRITTEN: &'static [Entry] = &[
        Entry::new("omega", "omega_3", Kind::Omega, ValueForm::Scalar, each!("angular velocity"))
            .printed("\\omega", OverSign::Nothing)
            .several_are(each!("angular velocities of the links")),
        Entry::new(
            "alpha",
            "alpha_3",
            Kind::Alpha,
            ValueForm::Scalar,
            each!("angular acceleration"),
        )
        .printed("\\alpha", OverSign::Nothing)
        .several_are(each!("angular accelerations of the links")),
    ];

    fn read(question: &Question<'_>) -> Result<Option<Turning>, Diagnostic> {
        let rate = Rate::ALL[question.row(Self::WRITTEN)];
        if let Some((of, to)) = question.names().split_once('/') {
            let (of, to) = (question.link(of.trim())?, question.link(to.trim())?);
            if of == to {
                return Err(question
                    .fault(both!("`{}` is of a link against itself: zero", question.text())));
            }
            return Ok(Some(Turning { rate, of, against: Some(to) }));
        }
        let of = question.link(question.names())?;
        if question.is_ground(of) {
            let d = question.fault(both!(
                "link `{}` is the ground: it does not turn, so `{}` is zero",
                question.names(),
                question.text()
            ));
            return Err(d.help(both!("ask for a moving link")));
        }
        Ok(Some(Turning { rate, of, against: None }))
    }

    fn entry(&self) -> &'static Entry {
        &Self::WRITTEN[self.rate as usize]
    }

    fn of(&self) -> Of {
        self.against.map_or(Of::Link(self.of), |to| Of::Links(self.of, to))
    }

    fn meaning(&self, _scene: &Scene) -> Option<Meaning> {
        Some(Meaning::Turning(self.of, self.against))
    }
}
