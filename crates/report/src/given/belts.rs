//! Belts and chains in the given data.

use super::GivenSentences;
use hodograph_base::lang::{say, tr};
use hodograph_scene::{Contours, Rolling};

impl GivenSentences<'_> {
    /// Returns the two wheels of a strand in words.
    pub(super) fn belt(&self, pair: &Rolling) -> String {
        let [a, b] = pair.links.map(|l| self.link(l));
        match pair.kind.is_toothed() {
            true => say!(self.lang(), "chain round sprockets {a} and {b}: "),
            false => say!(self.lang(), "belt round pulleys {a} and {b}: "),
        }
    }

    /// Returns whether a belt is open or crossed; `None` for other pairs, and for a chain unless it
    /// runs on its back.
    pub(super) fn crossing(&self, pair: &Rolling) -> Option<String> {
        let Contours::Belt { crossed, .. } = pair.contours else { return None };
        let words = match (crossed, pair.kind.is_toothed()) {
            (false, true) => return None,
            (false, false) => tr!(self.lang, "open"),
            (true, true) => tr!(self.lang, "turning in opposite senses"),
            (true, false) => tr!(self.lang, "crossed"),
        };
        Some(words.to_owned())
    }
}
