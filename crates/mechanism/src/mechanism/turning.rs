//! Locks of sliding pairs, each related to a known link instead of the next link in the chain.
//!
//! A block in the slots of two links (Oldham's coupling) is locked to both. Pair by pair, the
//! second link depends on the block and the block on the second link, which makes a group without a
//! core. Both turn with the first link; locked to the first link, the group separates into dyads.
//! The new equations are sums of the old ones, so the solutions are the same.

use super::{Constraint, Core, Mechanism};
use hodograph_scene::LinkId;

/// Returns the constraints with the locks of every group without a core applied relative to a link
/// that is known before the group; `None` if that changes nothing.
pub(super) fn from_known_links(m: &Mechanism) -> Option<Vec<Constraint>> {
    let mut constraints = m.constraints.clone();
    for group in m.groups.iter().filter(|g| g.core == Core::Higher) {
        let of_group = |l: LinkId| group.links.contains(&l);
        // For each link of the group that turns with a known link: the known link.
        let mut turns_as: Vec<(LinkId, LinkId)> = Vec::new();
        loop {
            let before = turns_as.len();
            for &i in &group.constraints {
                let Some((a, b)) = constraints[i].form().locks() else { continue };
                let known =
                    |l: LinkId| turns_as.iter().find(|(t, _)| *t == l).map(|(_, known)| *known);
                match (of_group(a), of_group(b), known(a), known(b)) {
                    (true, false, None, _) => turns_as.push((a, b)),
                    (false, true, _, None) => turns_as.push((b, a)),
                    (true, true, Some(k), None) => {
                        turns_as.push((b, k));
                        constraints[i] = constraints[i].locking(b, k);
                    }
                    (true, true, None, Some(k)) => {
                        turns_as.push((a, k));
                        constraints[i] = constraints[i].locking(a, k);
                    }
                    _ => {}
                }
            }
            if turns_as.len() == before {
                break;
            }
        }
    }
    (constraints != m.constraints).then_some(constraints)
}
