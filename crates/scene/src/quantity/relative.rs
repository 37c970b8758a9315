//! `v_CB`, `a_CB`: motion of one point relative to another; `an_CB`, `at_CB`: its parts along and
//! perpendicular to their line, if a link or a cylinder turns with that line.

use super::joined::name;
use super::{
    Entry, Meaning, Of, OverSign, PointJoint, Quantity, RelativeComponent, ValueForm, joined,
};
use crate::model::{Find, OnLink, Scene};
use crate::resolve::Question;
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::kind::Kind;
use hodograph_base::lang::each;

/// The motion of a point relative to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relative {
    /// The part.
    pub part: RelativePart,
    /// The point.
    pub of: OnLink,
    /// The reference point.
    pub to: OnLink,
}

/// The parts of a relative motion, in the order of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RelativePart {
    /// The difference of the two velocities.
    Velocity,
    /// The difference of the two accelerations.
    Acceleration,
    /// aⁿ: along the line of the two points.
    Normal,
    /// aᵗ: perpendicular to it.
    Tangential,
}

impl RelativePart {
    /// All parts.
    pub const ALL: [RelativePart; 4] = [
        RelativePart::Velocity,
        RelativePart::Acceleration,
        RelativePart::Normal,
        RelativePart::Tangential,
    ];
}

impl Quantity for Relative {
    fn no_value(&self, scene: &Scene) -> Both {
        let [a, b] = [self.of, self.to].map(|p| scene.point_name(p.point));
        both!("{a} and {b} lie at one place and have no line between them")
    }

    const WRITTEN: &'static [Entry] = &[
        Entry::new("v", "v_CB", Kind::Velocity, ValueForm::Vector, each!("velocity")),
        Entry::new("a", "a_CB", Kind::Acceleration, ValueForm::Vector, each!("acceleration")),
        Entry::new(
            "an",
            "an_CB",
            Kind::Acceleration,
            ValueForm::Vector,
            each!("normal acceleration"),
        )
        .printed("a", OverSign::Sign("n")),
        Entry::new(
            "at",
            "at_CB",
            Kind::Acceleration,
            ValueForm::Vector,
            each!("tangential acceleration"),
        )
        .printed("a", OverSign::Sign("t")),
    ];

    fn read(question: &Question<'_>) -> Result<Option<Relative>, Diagnostic> {
        let (of, to) = question.two_points()?;
        let part = RelativePart::ALL[question.row(Self::WRITTEN)];
        if matches!(part, RelativePart::Normal | RelativePart::Tangential) && of.point == to.point {
            let d = question.fault(both!(
                "`{}`: two links at one place have no line between them",
                question.text()
            ));
            return Err(d.help(both!("ask for ar_ or ak_ with {}", question.names())));
        }
        Ok(Some(Relative { part, of, to }))
    }

    fn entry(&self) -> &'static Entry {
        &Self::WRITTEN[self.part as usize]
    }

    fn of(&self) -> Of {
        Of::Points(self.of, self.to)
    }

    fn meaning(&self, _scene: &Scene) -> Option<Meaning> {
        let split = match self.part {
            RelativePart::Velocity | RelativePart::Acceleration => RelativeComponent::Whole,
            RelativePart::Normal => RelativeComponent::Along,
            RelativePart::Tangential => RelativeComponent::Across,
        };
        Some(Meaning::Relative(split, self.of, self.to))
    }

    fn fault(&self, scene: &Scene, find: &Find) -> Option<Diagnostic> {
        match (self.part, joined(scene, &self.of, &self.to)) {
            (RelativePart::Velocity | RelativePart::Acceleration, _)
            | (_, Some(PointJoint::Link(_) | PointJoint::Cylinder(_))) => {
                return None;
            }
            (
                RelativePart::Normal | RelativePart::Tangential,
                Some(PointJoint::Guide(_)) | None,
            ) => {}
        }
        let (a, b) = (name(scene, &self.of), name(scene, &self.to));
        let message = both!(
            "`{}`: {a} and {b} are on no common link, so their relative acceleration has no normal and tangential part",
            find.text
        );
        Some(Diagnostic::error("find", message).at(find.span).help(both!(
            "ask a_{a}{b} for the whole, or name two points of one link or the ends of a cylinder"
        )))
    }
}
