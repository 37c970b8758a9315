//! Belts and chains in the given data.

use super::GivenSentences;
use hodograph_scene::{Contours, Lang, Rolling};

impl GivenSentences<'_> {
    /// Returns the two wheels of a strand in words.
    pub(super) fn belt(&self, pair: &Rolling) -> String {
        let [a, b] = pair.links.map(|l| self.link(l));
        match (pair.kind.is_toothed(), self.lang()) {
            (true, Lang::En) => format!("chain round sprockets {a} and {b}: "),
            (true, Lang::Zh) => format!("绕过链轮 {a} 与 {b} 的链条："),
            (false, Lang::En) => format!("belt round pulleys {a} and {b}: "),
            (false, Lang::Zh) => format!("绕过带轮 {a} 与 {b} 的传动带："),
        }
    }

    /// Returns whether a belt is open or crossed; `None` for other pairs, and for a chain unless it
    /// runs on its back.
    pub(super) fn crossing(&self, pair: &Rolling) -> Option<String> {
        let Contours::Belt { crossed, .. } = pair.contours else { return None };
        let words = match (crossed, pair.kind.is_toothed()) {
            (false, true) => return None,
            (false, false) => self.tr("open", "开口传动"),
            (true, true) => self.tr("turning in opposite senses", "两轮转向相反"),
            (true, false) => self.tr("crossed", "交叉传动"),
        };
        Some(words.to_owned())
    }
}
