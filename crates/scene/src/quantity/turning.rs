//! `omega_3`, `alpha_3`: angular velocity and acceleration of a link, positive counter-clockwise;
//! `omega_3/2`: relative to link `2`.

use super::{Entry, Meaning, Of, OverSign, Quantity, Rate, ValueForm};
use crate::model::{LinkId, Scene};
use crate::resolve::Question;
use hodograph_base::diag::{Diagnostic, both};
use hodograph_base::kind::Kind;

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
        Entry::new(
            "omega",
            "omega_3",
            Kind::Omega,
            ValueForm::Scalar,
            ["angular velocity", "角速度"],
        )
        .printed("\\omega", OverSign::Nothing)
        .several_are(["angular velocities of the links", "各构件的角速度"]),
        Entry::new(
            "alpha",
            "alpha_3",
            Kind::Alpha,
            ValueForm::Scalar,
            ["angular acceleration", "角加速度"],
        )
        .printed("\\alpha", OverSign::Nothing)
        .several_are(["angular accelerations of the links", "各构件的角加速度"]),
    ];

    fn read(question: &Question<'_>) -> Result<Option<Turning>, Diagnostic> {
        let rate = Rate::ALL[question.row(Self::WRITTEN)];
        if let Some((of, to)) = question.names().split_once('/') {
            let (of, to) = (question.link(of.trim())?, question.link(to.trim())?);
            if of == to {
                return Err(question.fault(both!(
                    "`{}` is of a link against itself: zero",
                    "`{}` 是构件相对自身的量，为零",
                    question.text()
                )));
            }
            return Ok(Some(Turning { rate, of, against: Some(to) }));
        }
        let of = question.link(question.names())?;
        if question.is_ground(of) {
            let d = question.fault(both!(
                "link `{}` is the ground: it does not turn, so `{}` is zero",
                "构件 `{}` 是机架，不转动，`{}` 为零",
                question.names(),
                question.text()
            ));
            return Err(d.help(both!("ask for a moving link", "请求活动构件的量")));
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
