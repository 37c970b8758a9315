//! The section `attempts`: wrong solutions to show beside the right one.

use super::super::keys;
use super::super::raw::RawAttempt;
use super::{entries, localized, quantity};
use hodograph_base::diag::{Faults, both};
use hodograph_base::json::fields::{Fields, word};
use hodograph_base::json::{Node, Word};

/// Decodes a wrong solution.
pub(super) fn attempt(node: &Node, faults: &mut Faults) -> Option<RawAttempt> {
    let f = Fields::open(node, both!("an attempt"), keys::ATTEMPT, faults)?;
    let mistake =
        f.need("mistake", "\"no-coriolis\"", faults).and_then(|n| word(n, "\"mistake\"", faults));
    let mut optional = |key: &'static str, told: &'static str| -> Option<Option<Word>> {
        match f.get(key) {
            Some(n) => word(n, told, faults).map(Some),
            None => Some(None),
        }
    };
    let (pair, link) = (optional("pair", "\"pair\""), optional("link", "\"link\""));
    let mut printed = Vec::new();
    for (key, node) in entries(f.get("printed"), "\"printed\"", faults) {
        printed.extend(
            quantity(node, both!("printed `{}`", key.text), faults).map(|q| (key.clone(), q)),
        );
    }
    let why = f.get("why").and_then(|n| localized(n, "\"why\"", 1000, faults));
    Some(RawAttempt { mistake: mistake?, pair: pair?, link: link?, printed, why, span: node.span })
}
