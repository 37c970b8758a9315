//! `v_E`, `a_E`: velocity and acceleration of a point; `v_B3`: of the point of link 3 that
//! coincides with B.

use super::{Entry, Meaning, Of, Quantity, Rate, ValueForm};
use crate::model::{OnLink, Scene};
use crate::resolve::Question;
use hodograph_base::diag::Diagnostic;
use hodograph_base::kind::Kind;
use hodograph_base::lang::each;

/// The motion of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointMotion {
    /// Velocity or acceleration.
    pub rate: Rate,
    /// The point.
    pub of: OnLink,
}

impl PointMotion {
    /// Returns true if the symbol of a question is one of these.
    pub(crate) fn takes(question: &Question<'_>) -> bool {
        question.is_among(Self::WRITTEN)
    }
}

impl Quantity for PointMotion {
    const WRITTEN: &'static [Entry] = &[
        Entry::new("v", "v_E", Kind::Velocity, ValueForm::Vector, each!("velocity"))
            .several_are(each!("velocities")),
        Entry::new("a", "a_E", Kind::Acceleration, ValueForm::Vector, each!("acceleration"))
            .several_are(each!("accelerations")),
    ];

    fn read(question: &Question<'_>) -> Result<Option<PointMotion>, Diagnostic> {
        let (of, to) = question.points()?;
        Ok(to.is_none().then(|| PointMotion { rate: Rate::ALL[question.row(Self::WRITTEN)], of }))
    }

    fn entry(&self) -> &'static Entry {
        &Self::WRITTEN[self.rate as usize]
    }

    fn of(&self) -> Of {
        Of::Point(self.of)
    }

    fn meaning(&self, _scene: &Scene) -> Option<Meaning> {
        Some(Meaning::Vector(self.of))
    }
}
