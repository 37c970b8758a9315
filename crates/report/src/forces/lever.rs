//! Zhukovsky's lever in words: its moments about the pole, the balance that they give, and that of the force polygons.

use super::{ForceWriter, NO_ARM_MM, Sum};
use hodograph_base::digits::{inked, significant};
use hodograph_board::equilibrium::{Lever, Term};
use hodograph_board::plan::names::name_label;
use hodograph_paper::paper::phrase::Phrase;
use hodograph_scene::{Kind, Lang};

impl ForceWriter<'_> {
    /// The moments of all loads about the pole, with arms as measured, and what they give. `pole` is the letter of the pole.
    pub fn lever(&self, lever: &Lever, pole: &str) -> Vec<Phrase> {
        let mut sum = Sum::default();
        for force in lever.forces.iter().filter(|f| f.arm_mm > NO_ARM_MM) {
            let arm = inked(&significant(force.arm_mm, super::DIGITS));
            sum.add(force.moment, format!("{}\\cdot {arm}\\,\\text{{mm}}", self.symbol(Term::Load(force.load))));
        }
        for (load, moment) in &lever.couples {
            let link = name_label(self.scene.link_name(self.of.loads[*load].link));
            sum.add(*moment, format!("|{}\\,\\omega_{{{link}}}|/\\mu_v", self.couple(Term::Load(*load))));
        }
        let moment = inked(&significant(lever.moment, super::DIGITS));
        let equation = format!("$\\Sigma M_{{{pole}}} = {} = {moment}\\,\\text{{N·mm}}$", if sum.terms == 0 { "0" } else { &sum.text });
        let total = match self.lang {
            Lang::En => format!("Moments of all loads about ${pole}$: {equation}."),
            Lang::Zh => format!("各载荷对 ${pole}$ 取矩：{equation}。"),
        };
        let given = lever.balance(self.scene).map(|by_lever| {
            let driver = &self.scene.drivers[0];
            let (symbol, kind, rate) = match driver.kind.turned() {
                Some((link, against)) => {
                    let of = std::iter::once(link).chain((against != self.scene.ground).then_some(against));
                    let names: String = of.map(|l| name_label(self.scene.link_name(l))).collect();
                    (self.balance(0), Kind::Moment, format!("\\omega_{{{names}}}"))
                }
                None => ("F_{b}".to_owned(), Kind::Force, "v".to_owned()),
            };
            let relation = format!("${symbol} = -\\mu_v\\,\\Sigma M_{{{pole}}}/{rate} = {}$", self.amount(kind, by_lever));
            let beside = self.of.forces.drivers.first().map(|value| self.amount(kind, *value));
            match (self.lang, beside) {
                (Lang::En, Some(value)) => format!("{relation}; the force polygons give ${value}$."),
                (Lang::Zh, Some(value)) => format!("{relation}；力多边形得 ${value}$。"),
                (Lang::En, None) => format!("{relation}."),
                (Lang::Zh, None) => format!("{relation}。"),
            }
        });
        std::iter::once(total).chain(given).map(|text| Phrase::new(&text)).collect()
    }
}
