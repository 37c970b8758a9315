//! The section `composite`: moving points and the frames from which they are observed.

use super::super::keys;
use super::super::raw::RawComposite;
use hodograph_base::diag::{Faults, both};
use hodograph_base::json::Node;
use hodograph_base::json::fields::{Fields, word};

/// Decodes a moving point and a frame.
pub(super) fn composite(node: &Node, faults: &mut Faults) -> Option<RawComposite> {
    let f = Fields::open(node, both!("a composite motion"), keys::COMPOSITE, faults)?;
    let point = f.need("point", "\"A\"", faults).and_then(|n| word(n, "\"point\"", faults));
    let frame = f
        .need("frame", both!("\"2\", a link or a point"), faults)
        .and_then(|n| word(n, "\"frame\"", faults));
    let on = f.get("on").map(|n| word(n, "\"on\"", faults));
    Some(RawComposite {
        point: point?,
        frame: frame?,
        on: match on {
            Some(word) => Some(word?),
            None => None,
        },
        span: node.span,
    })
}
