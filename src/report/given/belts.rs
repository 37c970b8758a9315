//! Belts and chains among what is given.

use super::Givens;
use crate::scene::{Contours, Lang, Rolling, RollingKind};

impl Givens<'_> {
    /// Round which two wheels a strand runs.
    pub(super) fn belt(&self, pair: &Rolling) -> String {
        let [a, b] = pair.links.map(|l| self.link(l));
        match (pair.kind, self.lang()) {
            (RollingKind::Chain, Lang::En) => format!("chain round sprockets {a} and {b}: "),
            (RollingKind::Chain, Lang::Zh) => format!("绕过链轮 {a} 与 {b} 的链条："),
            (RollingKind::Belt | RollingKind::Gears | RollingKind::Wheel, Lang::En) => format!("belt round pulleys {a} and {b}: "),
            (RollingKind::Belt | RollingKind::Gears | RollingKind::Wheel, Lang::Zh) => format!("绕过带轮 {a} 与 {b} 的传动带："),
        }
    }

    /// Whether the belt is open or crossed; nothing of other pairs, and of a chain only where it runs on its back.
    pub(super) fn crossing(&self, pair: &Rolling) -> Option<String> {
        let words = match (&pair.contours, pair.kind) {
            (Contours::Belt { crossed: false, .. }, RollingKind::Chain) => return None,
            (Contours::Belt { crossed: false, .. }, _) => self.tr("open", "开口传动"),
            (Contours::Belt { crossed: true, .. }, RollingKind::Chain) => self.tr("turning in opposite senses", "两轮转向相反"),
            (Contours::Belt { crossed: true, .. }, _) => self.tr("crossed", "交叉传动"),
            (Contours::Circles { .. } | Contours::Track { .. }, _) => return None,
        };
        Some(words.to_owned())
    }
}
