//! `P_13D`, also written `P13D`: the distance of a point from the instantaneous centre of two
//! links, to which velocities are proportional: v_D = ω₃ · P13D.

use super::{
    AnswerValue, Entry, FormulaInputs, InstantCentre, Level, Meaning, Need, Of, OverSign, Quantity,
    ValueForm,
};
use crate::model::{OnLink, PointId, Scene};
use crate::resolve::Question;
use hodograph_base::diag::{Both, Diagnostic};
use hodograph_base::kind::Kind;
use hodograph_base::lang::each;
use hodograph_base::number::Real;

/// The distance of a point from an instantaneous centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FromCentre {
    /// The centre.
    pub centre: InstantCentre,
    /// The point.
    pub point: PointId,
}

impl Quantity for FromCentre {
    const WRITTEN: &'static [Entry] = &[Entry::new(
        "P",
        "P_13D",
        Kind::Length,
        ValueForm::Scalar,
        each!("distance from the instantaneous centre"),
    )
    .printed("P", OverSign::Nothing)
    .at_level(Level::Velocity)];

    fn read(question: &Question<'_>) -> Result<Option<FromCentre>, Diagnostic> {
        let names = question.names();
        if question.two_links().is_ok() {
            return Ok(None);
        }
        // The last name is that of the point.
        let found = names.char_indices().skip(1).find_map(|(cut, _)| {
            let (links, point) = names.split_at(cut);
            let point = question.point(point.trim_start_matches([',', '/', ' ']))?;
            Some((
                InstantCentre::of_links(question, question.two_links_of(links.trim_end()).ok()?)
                    .ok()?,
                point,
            ))
        });
        Ok(found.map(|(centre, point)| FromCentre { centre, point }))
    }

    fn entry(&self) -> &'static Entry {
        &Self::WRITTEN[0]
    }

    fn of(&self) -> Of {
        Of::Point(OnLink { point: self.point, link: None })
    }

    fn meaning(&self, _scene: &Scene) -> Option<Meaning> {
        None
    }

    fn no_value(&self, scene: &Scene) -> Both {
        self.centre.no_value(scene)
    }

    fn needs(&self) -> Vec<(Need, Level)> {
        let place = (Need::Point(self.point, None), Level::Position);
        self.centre.needs().into_iter().chain([place]).collect()
    }

    fn value<N: Real, K: FormulaInputs<N>>(&self, known: &K) -> Option<AnswerValue<N>> {
        match self.centre.value(known)? {
            AnswerValue::Point(centre) => {
                Some(AnswerValue::Scalar(known.point(self.point)?.distance(centre)))
            }
            AnswerValue::Vector(_) | AnswerValue::Scalar(_) => None,
        }
    }
}
