//! Checks of the force polygons in words: the equilibrium of all links together, and Zhukovsky's
//! lever.

use super::{ForceWriter, MomentSum, NO_ARM_MM};
use hodograph_base::digits::{direction_degrees, inked, significant};
use hodograph_base::geom::Vec2;
use hodograph_base::lang::{say, tr};
use hodograph_board::equilibrium::{ForceTerm, ForceTotals, Lever};
use hodograph_board::plan::names::name_label;
use hodograph_mechanism::position::Configuration;
use hodograph_paper::paper::phrase::Phrase;
use hodograph_scene::Kind;
use hodograph_scene::quantity::ROUNDING;

impl ForceWriter<'_> {
    /// Returns the checks as plain text.
    pub fn checks_text(&self, at: &Configuration, lever: Option<(&Lever, &str)>) -> String {
        let Some((heading, sentences)) = self.checks(at, lever) else { return String::new() };
        let lines = sentences
            .iter()
            .enumerate()
            .map(|(k, sentence)| format!("  {:>3}. {}\n", k + 1, sentence.plain()));
        format!("  {heading}\n") + &lines.collect::<String>()
    }

    /// Returns the checks with their heading: the forces on all links together, and the lever with
    /// the letter of its pole.
    pub fn checks(
        &self,
        at: &Configuration,
        lever: Option<(&Lever, &str)>,
    ) -> Option<(&'static str, Vec<Phrase>)> {
        let whole = ForceTotals::of(self.scene, at, self.of).map(|whole| self.whole(&whole));
        let by_lever = lever.map(|(lever, pole)| self.lever(lever, pole)).unwrap_or_default();
        let heading = match (whole.is_some(), by_lever.is_empty()) {
            (true, false) => tr!(self.lang, "Checks: all links together, Zhukovsky's lever"),
            (true, true) => tr!(self.lang, "Check: all links together"),
            (false, _) => tr!(self.lang, "Check by Zhukovsky's lever"),
        };
        let all: Vec<Phrase> = whole.into_iter().chain(by_lever).collect();
        (!all.is_empty()).then_some((heading, all))
    }

    /// Returns the sum of the loads beside that of the ground reactions.
    fn whole(&self, whole: &ForceTotals) -> Phrase {
        let largest = self.of.forces.largest;
        let sum = |v: Vec2| match v.unit().filter(|_| v.norm() > ROUNDING * largest) {
            Some(u) => format!(
                "${}$ ∠ ${}$°",
                self.amount(Kind::Force, v.norm()),
                inked(&significant(direction_degrees(u.angle()), super::DIGITS))
            ),
            None => format!("${}$", self.amount(Kind::Force, 0.0)),
        };
        let (loads, ground) = (sum(whole.loads), sum(whole.ground));
        Phrase::new(&say!(
            self.lang,
            "The loads of all links add up to {loads}, the reactions of the ground on the links to {ground}."
        ))
    }

    /// Returns the moments of all loads about the pole, with arms as measured, and the result.
    /// `pole` is the letter of the pole.
    pub fn lever(&self, lever: &Lever, pole: &str) -> Vec<Phrase> {
        let mut sum = MomentSum::default();
        for force in lever.forces.iter().filter(|f| f.arm_mm > NO_ARM_MM) {
            let arm = inked(&significant(force.arm_mm, super::DIGITS));
            sum.add(
                force.moment,
                format!("{}\\cdot {arm}\\,\\text{{mm}}", self.symbol(ForceTerm::Load(force.load))),
            );
        }
        for (load, moment) in &lever.couples {
            let link = name_label(self.scene.link_name(self.of.loads[*load].link));
            sum.add(
                *moment,
                format!("|{}\\,\\omega_{{{link}}}|/\\mu_v", self.couple(ForceTerm::Load(*load))),
            );
        }
        let moment = inked(&significant(lever.moment, super::DIGITS));
        let equation = format!(
            "$\\Sigma M_{{{pole}}} = {} = {moment}\\,\\text{{N·mm}}$",
            if sum.terms == 0 { "0" } else { &sum.text }
        );
        let total = say!(self.lang, "Moments of all loads about ${pole}$: {equation}.");
        // A balancing force at a point has its own arm on the lever.
        let balance = self.scene.loads.balance.as_ref();
        let by_lever =
            lever.balance(self.scene).filter(|_| balance.is_none_or(|b| b.force.is_none()));
        let (relation, beside) = match by_lever {
            Some(by_lever) => {
                let driver = &self.scene.drivers[0];
                let (symbol, kind, rate) = match driver.kind.turned() {
                    Some((link, against)) => {
                        let of = std::iter::once(link)
                            .chain((against != self.scene.ground).then_some(against));
                        let names: String =
                            of.map(|l| name_label(self.scene.link_name(l))).collect();
                        (self.balance(0), Kind::Moment, format!("\\omega_{{{names}}}"))
                    }
                    None => ("F_{b}".to_owned(), Kind::Force, "v".to_owned()),
                };
                let of_polygons = if balance.is_some() {
                    self.of.forces.balance
                } else {
                    self.of.forces.drivers.first().copied()
                };
                let relation = format!(
                    "${symbol} = -\\mu_v\\,\\Sigma M_{{{pole}}}/{rate} = {}$",
                    self.amount(kind, by_lever)
                );
                (relation, of_polygons.map(|value| self.amount(kind, value)))
            }
            None => {
                let power = self.amount(Kind::Power, -lever.moment * lever.mu);
                let of_polygons = Some(self.of.forces.power).filter(|power| power.is_finite());
                (
                    format!("$P = -\\mu_v\\,\\Sigma M_{{{pole}}} = {power}$"),
                    of_polygons.map(|value| self.amount(Kind::Power, value)),
                )
            }
        };
        let given = match beside {
            Some(value) => say!(self.lang, "{relation}; the force polygons give ${value}$."),
            None => format!("{relation}{}", self.lang.pick([".", "。"])),
        };
        [total, given].iter().map(|text| Phrase::new(text)).collect()
    }
}
