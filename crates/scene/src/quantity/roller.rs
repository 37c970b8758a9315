//! `spin_3`: the angular velocity of the roller of follower 3, which rolls without slip on its cam:
//! v_B + ω × (E − B) is the velocity of the cam's point at the contact E. A roller's spin moves no
//! other link (局部自由度), so it is reported only if a question names it.

use super::{
    AnswerValue, Entry, FormulaInputs, Level, Meaning, Need, Of, OverSign, Quantity, ValueForm,
};
use crate::cams::{Cam, Follows};
use crate::model::{Find, LinkId, OnLink, PointId, Scene};
use crate::resolve::Question;
use hodograph_base::diag::{Diagnostic, both};
use hodograph_base::geom::Vec2;
use hodograph_base::kind::Kind;
use hodograph_base::lang::each;
use hodograph_base::number::Real;

/// The spin of a roller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollerSpin {
    /// The follower.
    pub follower: LinkId,
    /// The roller's centre, the cam and a point of it; `None` if the follower has no roller.
    on: Option<(PointId, LinkId, PointId)>,
}

impl Quantity for RollerSpin {
    const WRITTEN: &'static [Entry] = &[Entry::new(
        "spin",
        "spin_3",
        Kind::Omega,
        ValueForm::Scalar,
        each!("angular velocity of the roller"),
    )
    .printed("\\omega", OverSign::Sign("s"))];

    fn read(question: &Question<'_>) -> Result<Option<RollerSpin>, Diagnostic> {
        let follower = question.link(question.names())?;
        Ok(Some(RollerSpin { follower, on: question.roller(follower) }))
    }

    fn entry(&self) -> &'static Entry {
        &Self::WRITTEN[0]
    }

    fn of(&self) -> Of {
        Of::Link(self.follower)
    }

    fn meaning(&self, _scene: &Scene) -> Option<Meaning> {
        None
    }

    fn needs(&self) -> Vec<(Need, Level)> {
        let Some((centre, cam, point)) = self.on else { return Vec::new() };
        [Need::Point(centre, None), Need::Point(point, Some(cam)), Need::Turning(cam)]
            .map(|need| (need, Level::Velocity))
            .into()
    }

    fn fault(&self, _scene: &Scene, find: &Find) -> Option<Diagnostic> {
        if self.on.is_some() {
            return None;
        }
        let message = both!("`{}` needs a follower with a roller", find.text);
        Some(Diagnostic::error("no-cam", message).at(find.span).help(both!(
            "give the cam pair a \"roller\": {{\"pin\": \"B\", \"radius\": \"10 mm\"}}"
        )))
    }

    fn value<N: Real, K: FormulaInputs<N>>(&self, known: &K) -> Option<AnswerValue<N>> {
        let (centre, cam, point) = self.on?;
        let pair =
            known.scene().cams.iter().find(|c| c.cam == cam && c.follower == self.follower)?;
        let Follows::Roller(..) = pair.follows else { return None };
        let at = known.point(centre)?;
        let normal = normal(pair, known, at.to_vec2())?;
        let radius: N = pair.end_in(known.scene())?;
        let contact = at + normal * -radius;
        let of_cam = known.vector(Level::Velocity, &OnLink { point, link: Some(cam) })?
            + (contact - known.point(point)?).perp() * known.turning(Level::Velocity, cam)?;
        let of_centre = known.vector(Level::Velocity, &OnLink { point: centre, link: None })?;
        // The contact is at −r n from the centre.
        let spin = (of_cam - of_centre).dot(normal.perp()) / -radius;
        spin.is_decided().then_some(AnswerValue::Scalar(spin))
    }
}

/// Returns the normal of the profile at the contact, toward the roller.
fn normal<N: Real, K: FormulaInputs<N>>(pair: &Cam, known: &K, at: Vec2<N>) -> Option<Vec2<N>> {
    if let Some((k, _)) = pair.circle {
        return (at - known.point(k)?.to_vec2()).unit();
    }
    let turning = pair.disc.as_ref()?;
    let n = turning.contact_in::<N>(known.scene())?[1];
    match turning.axis(known.scene()) {
        Some([a, b]) => {
            Some(n.rotate_by((known.point(b)?.to_vec2() - known.point(a)?.to_vec2()).unit()?))
        }
        None => Some(n),
    }
}
