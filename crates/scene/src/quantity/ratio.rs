//! `i_24`: the transmission ratio of two links, i = ω₂/ω₄, negative if they turn in opposite
//! senses; `i_24/3` in the frame of the arm 3, (ω₂ − ω₃)/(ω₄ − ω₃), which for a gear train depends
//! on its numbers of teeth alone (Willis).

use super::{Entry, Level, Meaning, Need, Of, OverSign, Quantity, ValueForm};
use crate::model::{LinkId, Scene};
use crate::resolve::Question;
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::kind::Kind;
use hodograph_base::lang::each;

/// A transmission ratio.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ratio {
    /// The links of dividend and divisor.
    pub links: [LinkId; 2],
    /// The arm from which both are observed; `None`: the ground.
    pub arm: Option<LinkId>,
}

impl Quantity for Ratio {
    const WRITTEN: &'static [Entry] =
        &[Entry::new("i", "i_23", Kind::Number, ValueForm::Scalar, each!("transmission ratio"))
            .printed("i", OverSign::Nothing)
            .at_level(Level::Velocity)];

    fn read(question: &Question<'_>) -> Result<Option<Ratio>, Diagnostic> {
        let (links, arm) = match question.names().split_once('/') {
            // `2/4` are two links, as in other questions; `24/3` and `2,4/3` have an arm.
            Some((names, arm)) if question.link(names.trim()).is_err() => {
                (question.two_links_of(names)?, Some(question.link(arm.trim())?))
            }
            Some(_) | None => (question.two_links()?, None),
        };
        let arm = arm.filter(|l| !question.is_ground(*l));
        if arm.is_none() && links.iter().any(|l| question.is_ground(*l)) {
            let d = question.fault(both!(
                "`{}` is a ratio with the ground, which does not turn",
                question.text()
            ));
            return Err(d.help(both!(
                "name two moving links, or an arm behind /, such as i_24/3: then all are seen from it"
            )));
        }
        if arm.is_some_and(|a| links.contains(&a)) {
            let d = question
                .fault(both!("`{}`: the arm does not turn against itself", question.text()));
            return Err(d.help(both!("name two links other than the arm")));
        }
        Ok(Some(Ratio { links, arm }))
    }

    fn entry(&self) -> &'static Entry {
        &Self::WRITTEN[0]
    }

    fn of(&self) -> Of {
        Of::Links(self.links[0], self.links[1])
    }

    fn meaning(&self, _scene: &Scene) -> Option<Meaning> {
        Some(Meaning::Ratio(self.links, self.arm))
    }

    fn no_value(&self, scene: &Scene) -> Both {
        let of = scene.link_name(self.links[1]);
        match self.arm {
            None => both!("link {of} does not turn, and a ratio over its angular velocity is none"),
            Some(arm) => {
                let arm = scene.link_name(arm);
                both!(
                    "link {of} does not turn against the arm {arm}, and a ratio over that angular velocity is none"
                )
            }
        }
    }

    fn needs(&self) -> Vec<(Need, Level)> {
        self.links
            .into_iter()
            .chain(self.arm)
            .map(|l| (Need::Turning(l), Level::Velocity))
            .collect()
    }
}
