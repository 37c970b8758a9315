//! Values of a law of time at the instant: rate and acceleration, as expressions, for the driver
//! that the law describes.

use super::super::expr::{self, Expr};
use super::super::front::{TIME, mentions};
use super::super::law::{NoDerivative, derivative};
use super::super::model::TimeLaw;
use super::super::raw::*;
use hodograph_base::diag::{Diagnostic, Faults, Span, both};

/// A law, differentiated twice.
pub(super) struct Differentiated {
    /// The first derivative; `None` if it vanishes for every t.
    rate: Option<RawQuantity>,
    /// The second derivative.
    second: Option<RawQuantity>,
    /// The law as written.
    law: TimeLaw,
}

impl Differentiated {
    /// Returns rate, acceleration and law of a driver; a rate that vanishes is written as zero in
    /// its unit.
    pub(super) fn of_driver(
        self,
        unit: &str,
        span: Span,
    ) -> (Option<RawQuantity>, Option<RawQuantity>, Option<TimeLaw>) {
        let still = RawQuantity { text: format!("0 {unit}"), span, bare: false };
        (self.rate.or(Some(still)), self.second, Some(self.law))
    }
}

impl RawScene {
    /// True if the file has an instant and the quantity contains the time. The fault of a quantity
    /// that cannot be read is reported where its value is needed.
    pub(super) fn moves_by(&self, q: &RawQuantity) -> bool {
        let names: Vec<&str> = self.parameters.iter().map(|(name, _)| name.text.as_str()).collect();
        self.is_timed && expr::parse(&q.text, &names).is_ok_and(|tree| mentions(&tree, TIME))
    }
}

/// Differentiates a law twice; parameters are known by name.
///
/// Returns `None` if the law cannot be parsed or differentiated; the fault has then been reported.
pub(super) fn differentiated(
    law: &RawQuantity,
    raw: &RawScene,
    faults: &mut Faults,
) -> Option<Differentiated> {
    let names: Vec<&str> = raw.parameters.iter().map(|(name, _)| name.text.as_str()).collect();
    let tree = expr::parse(&law.text, &names).map_err(|d| faults.push(d.at(law.span))).ok()?;
    let given = |text: String| RawQuantity { text, span: law.span, bare: false };
    let by_time = |tree: &Expr, faults: &mut Faults| -> Option<Option<String>> {
        match derivative(tree) {
            Ok(d) => Some(d),
            Err(why) => {
                let message = match why {
                    NoDerivative::Corner => {
                        both!("`{}`: abs has a corner, and no derivative there", law.text)
                    }
                    NoDerivative::Exponent => both!("`{}`: the exponent depends on time", law.text),
                };
                faults.push(Diagnostic::error("law", message).at(law.span));
                None
            }
        }
    };
    let parsed = |text: &String, faults: &mut Faults| -> Option<Expr> {
        let involved = |_| {
            let message = both!("`{}` is too involved to be differentiated twice", law.text);
            let d = Diagnostic::error("law", message).at(law.span);
            faults.push(
                d.help(both!("write it with fewer products and powers of what depends on t")),
            );
        };
        expr::parse(text, &names).map_err(involved).ok()
    };
    let rate = by_time(&tree, faults)?;
    let second = match &rate {
        Some(rate) => by_time(&parsed(rate, faults)?, faults)?,
        None => None,
    };
    if let Some(second) = &second {
        parsed(second, faults)?;
    }
    let (used, all) = (tree.parameters(), &raw.parameters);
    // A parameter defined as another parameter has the value of that one.
    let value = |q: &RawQuantity| {
        all.iter().find(|(name, _)| name.text == q.text).map_or(&q.text, |(_, q)| &q.text).clone()
    };
    let named = |instant: bool| {
        let wanted = all.iter().filter(|(name, _)| {
            (name.text == TIME) == instant && (instant || used.contains(&name.text.as_str()))
        });
        wanted.map(|(name, q)| (name.text.clone(), value(q))).collect::<Vec<_>>()
    };
    let parameters = [named(false), named(true)].concat();
    let told = TimeLaw { text: law.text.clone(), parameters };
    Some(Differentiated { rate: rate.map(given), second: second.map(given), law: told })
}

#[cfg(test)]
mod tests {
    use crate::read;

    /// Angle (rad) and rates of a crank driven by a law, at an instant.
    fn crank(law: &str, t: f64) -> Result<[f64; 3], String> {
        let text = format!(
            r#"{{"links": {{"1": ["O"], "2": ["O", "A"]}}, "ground": "1", "points": {{"O": [0, 0]}}, "lengths": {{"OA": "50 mm"}},
            "time": "{t:?} s", "driver": {{"link": "2", "angle": "{law}"}}, "find": ["v_A"]}}"#
        );
        let scene = read(text).map_err(|f| f.list[0].message.en.clone())?.value;
        let driver = &scene.drivers[0];
        let angle =
            driver.kind.angle().expect("a turning driver by a law has an angle").value.radians();
        Ok([angle, driver.rate.value, driver.acceleration.as_ref().map_or(0.0, |a| a.value)])
    }

    /// The derivatives of a long law repeat its parts and exceed the length limit for written
    /// expressions by far.
    #[test]
    fn involved_laws_are_differentiated() {
        for law in [
            "(0.3 rad)*sin((2 rad/s)*t)*cos((3 rad/s)*t)",
            "(0.5 rad)*sqrt(1+(t/(1 s))^2)*sin((2 rad/s)*t+30 deg)*cos((1 rad/s)*t)",
            "0.3 rad*sin(2 rad/s*t)*t^2/(1 s^2)+0.1 rad*cos(3 rad/s*t)^3*t/(1 s)+(20 deg)*(t/(2 s))^5*(10-15*t/(2 s)+6*(t/(2 s))^2)",
        ] {
            let (t, h) = (0.7, 1e-4);
            let [before, now, after] =
                [t - h, t, t + h].map(|t| crank(law, t).unwrap_or_else(|e| panic!("{law}: {e}")));
            let [rate, second] =
                [(after[0] - before[0]) / (2.0 * h), (after[1] - before[1]) / (2.0 * h)];
            assert!(
                (rate - now[1]).abs() < 1e-6 * (1.0 + rate.abs()),
                "{law}: ω {} against {rate}",
                now[1]
            );
            assert!(
                (second - now[2]).abs() < 1e-6 * (1.0 + second.abs()),
                "{law}: α {} against {second}",
                now[2]
            );
        }
    }

    #[test]
    fn what_is_too_involved_is_told() {
        let law = format!("(1 rad)*{}t/(1 s){}", "(1+".repeat(22), ")*t/(1 s)".repeat(22));
        let said = crank(&law, 0.7).expect_err("its second derivative has too many levels");
        assert!(said.ends_with("is too involved to be differentiated twice"), "{said}");
    }
}
