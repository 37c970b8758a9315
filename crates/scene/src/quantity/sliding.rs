//! `vr_B3B2`, `ar_B3B2`, `ak_B3B2`: sliding velocity, sliding and Coriolis acceleration of a point
//! relative to the link on which it slides, or of the ends of a cylinder.

use super::joined::name;
use super::{
    Entry, Level, Meaning, Need, Of, OverSign, PointJoint, Quantity, RelativeComponent, ValueForm,
    joined,
};
use crate::cams::Cam;
use crate::model::{Find, Guide, OnLink, Scene};
use crate::resolve::Question;
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::kind::Kind;
use hodograph_base::lang::each;

/// The sliding of a point on another link. Both points are at one place, or are the ends of a
/// cylinder; one may be the pin itself (`vr_BB3`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sliding {
    /// The part.
    pub part: SlidingTerm,
    /// The sliding point.
    pub of: OnLink,
    /// The point on which it slides.
    pub to: OnLink,
}

/// The parts of a sliding motion, in the order of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SlidingTerm {
    /// Sliding velocity v_r.
    Velocity,
    /// Sliding acceleration aʳ.
    Acceleration,
    /// Coriolis acceleration aᵏ = 2 ω × v_r.
    Coriolis,
}

impl SlidingTerm {
    /// All parts.
    pub const ALL: [SlidingTerm; 3] =
        [SlidingTerm::Velocity, SlidingTerm::Acceleration, SlidingTerm::Coriolis];
}

impl Quantity for Sliding {
    const WRITTEN: &'static [Entry] = &[
        Entry::new("vr", "vr_B3B2", Kind::Velocity, ValueForm::Vector, each!("sliding velocity"))
            .printed("v", OverSign::Sliding),
        Entry::new(
            "ar",
            "ar_B3B2",
            Kind::Acceleration,
            ValueForm::Vector,
            each!("sliding acceleration"),
        )
        .printed("a", OverSign::Sliding),
        Entry::new(
            "ak",
            "ak_B3B2",
            Kind::Acceleration,
            ValueForm::Vector,
            each!("Coriolis acceleration"),
        )
        .printed("a", OverSign::Coriolis),
    ];

    fn read(question: &Question<'_>) -> Result<Option<Sliding>, Diagnostic> {
        // A frame follows a slash.
        if question.names().contains('/') {
            return Ok(None);
        }
        let (of, to) = question.two_points()?;
        // The ends of a cylinder slide along their line; other sliding points coincide. One of the
        // two may be the pin itself: vr_BB3 is the sliding of pin B on link 3.
        if of.point != to.point && !question.are_ends_of_a_cylinder(of.point, to.point) {
            let d = question
                .fault(both!("`{}`: sliding is between two links at one place", question.text()));
            return Err(d.help(both!(
                "name the place twice, each time with its link: {1}_{0}3{0}2",
                question.point_name(of.point),
                question.symbol()
            )));
        }
        Ok(Some(Sliding { part: SlidingTerm::ALL[question.row(Self::WRITTEN)], of, to }))
    }

    fn entry(&self) -> &'static Entry {
        &Self::WRITTEN[self.part as usize]
    }

    fn of(&self) -> Of {
        Of::Points(self.of, self.to)
    }

    fn meaning(&self, scene: &Scene) -> Option<Meaning> {
        let split = match self.part {
            // At the contact of a cam the whole relative velocity is sliding.
            SlidingTerm::Velocity if self.at_a_cam(scene) => RelativeComponent::Whole,
            SlidingTerm::Velocity | SlidingTerm::Acceleration => RelativeComponent::Sliding,
            SlidingTerm::Coriolis => RelativeComponent::Coriolis,
        };
        Some(Meaning::Relative(split, self.of, self.to))
    }

    fn needs(&self) -> Vec<(Need, Level)> {
        let of = self.of();
        match self.part {
            SlidingTerm::Velocity => of.needs(Level::Velocity),
            // 2 ω × v_r follows from velocities.
            SlidingTerm::Acceleration | SlidingTerm::Coriolis => {
                [of.needs(Level::Velocity), of.needs(Level::Acceleration)].concat()
            }
        }
    }

    fn fault(&self, scene: &Scene, find: &Find) -> Option<Diagnostic> {
        if self.part == SlidingTerm::Velocity && self.at_a_cam(scene) {
            return None;
        }
        match joined(scene, &self.of, &self.to) {
            Some(PointJoint::Guide(_) | PointJoint::Cylinder(_)) => return None,
            Some(PointJoint::Link(_)) | None => {}
        }
        let (a, b) = (name(scene, &self.of), name(scene, &self.to));
        let message =
            both!("`{}`: no guide joins {a} and {b}, so neither slides along the other", find.text);
        Some(Diagnostic::error("find", message).at(find.span).help(both!(
            "ask v_{a}{b} or a_{a}{b}, or name the coincident points of a slider and the link that carries its guide{}",
            example(scene)
        )))
    }
}

impl Sliding {
    /// Returns true for the points of a follower and its cam at their contact.
    fn at_a_cam(&self, scene: &Scene) -> bool {
        let of = [self.of.link, self.to.link];
        let touch = |c: &Cam| {
            c.touch == Some(self.of.point)
                && [[c.cam, c.follower], [c.follower, c.cam]].iter().any(|l| l.map(Some) == of)
        };
        self.of.point == self.to.point && scene.cams.iter().any(touch)
    }
}

/// Returns a sliding pair of this scene in the form of a question: `, such as B3B2`.
fn example(scene: &Scene) -> Both {
    let pair = |g: &Guide| {
        let p = scene.point_name(g.pin?);
        let runner = g.slider.map_or("", |s| scene.link_name(s));
        Some(both!(", such as {p}{runner}{p}{}", scene.link_name(g.on)))
    };
    scene.guides.iter().find_map(pair).unwrap_or_default()
}
