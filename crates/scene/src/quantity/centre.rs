//! `P_24`: the instantaneous centre of two links, from their velocities: P = Q + i (v_i − v_j)/(ω_i
//! − ω_j), v being the velocities of the links' points at Q.
//!
//! The module `centres` finds it independently, by the theorem of three centres.

use super::value::{fastest, vanishes};
use super::{
    AnswerValue, Entry, FormulaInputs, Level, Meaning, Need, Of, OverSign, Quantity, ValueForm,
};
use crate::model::{LinkId, OnLink, PointId, Scene};
use crate::resolve::Question;
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::geom::Vec2;
use hodograph_base::kind::Kind;
use hodograph_base::lang::each;
use hodograph_base::number::Real;

/// The instantaneous centre of two links.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InstantCentre {
    /// The two links, each with a point of its plane as reference for its motion, one of its own if
    /// it has any; the ground needs none.
    pub links: [(LinkId, Option<PointId>); 2],
}

impl Quantity for InstantCentre {
    const WRITTEN: &'static [Entry] =
        &[Entry::new("P", "P_13", Kind::Length, ValueForm::Point, each!("instantaneous centre"))
            .printed("P", OverSign::Nothing)
            .at_level(Level::Velocity)];

    fn read(question: &Question<'_>) -> Result<Option<InstantCentre>, Diagnostic> {
        if question.names().is_empty() {
            return Ok(None);
        }
        Self::of_links(question, question.two_links()?).map(Some)
    }

    fn entry(&self) -> &'static Entry {
        &Self::WRITTEN[0]
    }

    fn of(&self) -> Of {
        Of::Links(self.links[0].0, self.links[1].0)
    }

    fn meaning(&self, _scene: &Scene) -> Option<Meaning> {
        None
    }

    fn no_value(&self, scene: &Scene) -> Both {
        let [i, j] = self.links.map(|(l, _)| scene.link_name(l));
        both!("links {i} and {j} do not turn against one another")
    }

    fn needs(&self) -> Vec<(Need, Level)> {
        let moving = self.links.iter().filter_map(|(l, p)| Some((*l, (*p)?)));
        moving
            .flat_map(|(l, p)| [Need::Turning(l), Need::Point(p, Some(l))])
            .map(|need| (need, Level::Velocity))
            .collect()
    }

    fn value<N: Real, K: FormulaInputs<N>>(&self, known: &K) -> Option<AnswerValue<N>> {
        let zero = N::from_f64(0.0);
        let base = known.point(self.links.iter().find_map(|(_, p)| *p)?)?;
        // Velocity of the link's point at `base`, and ω.
        let motion = |(link, point): (LinkId, Option<PointId>)| {
            let Some(point) = point else { return Some((Vec2::zero(), zero)) };
            let omega = known.turning(Level::Velocity, link)?;
            let v = known.vector(Level::Velocity, &OnLink { point, link: Some(link) })?;
            Some((v + (base - known.point(point)?).perp() * omega, omega))
        };
        let ((v, a), (w, b)) = (motion(self.links[0])?, motion(self.links[1])?);
        // Two links without relative rotation have no centre at a finite place.
        if vanishes(a - b, fastest(known)) {
            return None;
        }
        let at = base + (v - w).perp() * (N::from_f64(1.0) / (a - b));
        at.is_finite().then_some(AnswerValue::Point(at))
    }
}

impl InstantCentre {
    /// Returns the centre of two links.
    ///
    /// # Errors
    /// A scene without points.
    pub(super) fn of_links(
        question: &Question<'_>,
        links: [LinkId; 2],
    ) -> Result<InstantCentre, Diagnostic> {
        // A link without a point, a slider or a rack, moves with its plane: any point of the scene
        // serves as a point of that plane.
        let own = links.map(|l| question.first_point(l));
        let other = own.into_iter().flatten().next().or_else(|| question.any_point());
        let mut of = [(links[0], None), (links[1], None)];
        for ((link, point), own) in of.iter_mut().zip(own) {
            if question.is_ground(*link) {
                continue;
            }
            *point = own.or(other);
            if point.is_none() {
                let message = both!("`{}`: the scene has no point", question.text());
                return Err(question
                    .fault(message)
                    .help(both!("`hodograph centres` tells all centres")));
            }
        }
        Ok(InstantCentre { links: of })
    }
}
