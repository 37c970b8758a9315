//! What a law of time gives at the instant: rate and acceleration, as expressions, for the driver that it becomes.

use super::super::expr::{self, Expr};
use super::super::front::mentions;
use super::super::law::{NoDerivative, TIME, derivative};
use super::super::model::TimeLaw;
use super::super::raw::*;
use crate::diag::{Diagnostic, Faults, Span, both};

/// A law, differentiated twice.
pub(super) struct Differentiated {
    /// The first derivative; `None`: it vanishes for every t.
    rate: Option<RawQuantity>,
    /// The second one.
    second: Option<RawQuantity>,
    /// The law as it is written.
    law: TimeLaw,
}

impl Differentiated {
    /// Rate, acceleration and law of a driver; a rate that vanishes is written in its unit.
    pub(super) fn of_driver(self, unit: &str, span: Span) -> (Option<RawQuantity>, Option<RawQuantity>, Option<TimeLaw>) {
        let still = RawQuantity { text: format!("0 {unit}"), span, bare: false };
        (self.rate.or(Some(still)), self.second, Some(self.law))
    }
}

impl RawScene {
    /// Whether a quantity names the time, of a file that has an instant; one that cannot be read is told where its value is wanted.
    pub(super) fn moves_by(&self, q: &RawQuantity) -> bool {
        let names: Vec<&str> = self.parameters.iter().map(|(name, _)| name.text.as_str()).collect();
        self.is_timed && expr::parse(&q.text, &names).is_ok_and(|tree| mentions(&tree))
    }
}

/// Differentiates a law twice; parameters are known by name.
///
/// `None`: it cannot be parsed or differentiated, which has been told.
pub(super) fn differentiated(law: &RawQuantity, raw: &RawScene, faults: &mut Faults) -> Option<Differentiated> {
    let names: Vec<&str> = raw.parameters.iter().map(|(name, _)| name.text.as_str()).collect();
    let tree = expr::parse(&law.text, &names).map_err(|d| faults.push(d.at(law.span))).ok()?;
    let given = |text: String| RawQuantity { text, span: law.span, bare: false };
    let by_time = |tree: &Expr, faults: &mut Faults| -> Option<Option<String>> {
        match derivative(tree) {
            Ok(d) => Some(d),
            Err(why) => {
                let message = match why {
                    NoDerivative::Corner => both!("`{}`: abs has a corner, and no derivative there", "`{}`：abs 有尖点，不可导", law.text),
                    NoDerivative::Exponent => both!("`{}`: the exponent depends on time", "`{}`：指数随时间变化", law.text),
                };
                faults.push(Diagnostic::error("law", message).at(law.span));
                None
            }
        }
    };
    let rate = by_time(&tree, faults)?;
    let second = match &rate {
        Some(rate) => by_time(&expr::parse(rate, &names).map_err(|d| faults.push(d.at(law.span))).ok()?, faults)?,
        None => None,
    };
    let (used, all) = (tree.parameters(), &raw.parameters);
    // A parameter that is another one by name has that one's value.
    let value = |q: &RawQuantity| all.iter().find(|(name, _)| name.text == q.text).map_or(&q.text, |(_, q)| &q.text).clone();
    let named = |instant: bool| {
        let wanted = all.iter().filter(|(name, _)| (name.text == TIME) == instant && (instant || used.contains(&name.text.as_str())));
        wanted.map(|(name, q)| (name.text.clone(), value(q))).collect::<Vec<_>>()
    };
    let parameters = [named(false), named(true)].concat();
    let told = TimeLaw { text: law.text.clone(), parameters };
    Some(Differentiated { rate: rate.map(given), second: second.map(given), law: told })
}
