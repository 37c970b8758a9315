//! The section `ropes`: a rope that winds on a drum and pulls a load along a straight path.

use super::super::keys;
use super::super::raw::*;
use super::super::rolling::RollingKind;
use super::quantity;
use super::rolling::side;
use hodograph_base::diag::{Faults, both};
use hodograph_base::json::Node;
use hodograph_base::json::fields::{Fields, word};

/// Decodes a drum, its load, and the direction of the rope, which has the drum on its left.
pub(super) fn rope(node: &Node, faults: &mut Faults) -> Option<RawRolling> {
    let f = Fields::open(node, both!("a rope"), keys::ROPE, faults)?;
    let drum = f.need("drum", "\"2\"", faults).and_then(|n| word(n, "\"drum\"", faults));
    let centre = f.need("centre", "\"O\"", faults).and_then(|n| word(n, "\"centre\"", faults));
    let load = f.need("load", "\"3\"", faults).and_then(|n| word(n, "\"load\"", faults));
    let radius =
        f.need("radius", "\"0.2 m\"", faults).and_then(|n| quantity(n, "\"radius\"", faults));
    let mut name = |key: &str| f.get(key).and_then(|n| word(n, &format!("\"{key}\""), faults));
    let (line, at) = (name("line"), name("at"));
    let angle = f.get("angle").and_then(|n| quantity(n, "\"angle\"", faults));
    let (drum, centre, load, radius) = (drum?, centre?, load?, radius?);
    Some(RawRolling {
        sides: [side(&load, None, false), side(&drum, Some(&centre), false)],
        sizes: RawSizes::Radii(vec![radius]),
        kind: RollingKind::Rope,
        strand: None,
        line,
        through: None,
        angle,
        at,
        phase: None,
        flanks: RawFlanks::default(),
        span: node.span,
    })
}
