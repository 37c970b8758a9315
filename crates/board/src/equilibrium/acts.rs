//! The steps in which the equilibrium of a group is drawn.

use super::{Equilibrium, ForceEdge, GroupForces, MomentResult};
use crate::construction::{MarkId, Op};
use hodograph_mechanism::force::Cause;

/// A step of a group's equilibrium: one sentence, with its part of the polygon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Act {
    /// The links are drawn as free bodies.
    Free,
    /// Friction follows from the reactions of the previous polygon.
    Friction,
    /// An equation of moments: its index in [`GroupForces::moments`].
    Moments(usize),
    /// A known force is laid off.
    Lay(ForceEdge),
    /// Two lines of known direction cross in a vertex.
    Cross(MarkId),
    /// An unknown force, a side or a diagonal, is measured.
    Read(ForceEdge),
}

impl Equilibrium {
    /// Returns the steps of a group: its links as free bodies, moments, the sides of the polygon,
    /// the measurements on it, moments that follow.
    pub fn acts(&self, group: &GroupForces) -> Vec<Act> {
        let mut out = vec![Act::Free];
        let rubs = |cause: Cause| matches!(cause, Cause::Friction(_));
        out.extend(
            self.loads
                .iter()
                .any(|l| rubs(l.cause) && group.links.contains(&l.link))
                .then_some(Act::Friction),
        );
        let moments = |after: bool| {
            let wanted = move |k: &usize| {
                matches!(group.moments[*k].gives, MomentResult::Offset(_)) == after
            };
            (0..group.moments.len()).filter(wanted).map(Act::Moments)
        };
        out.extend(moments(false));
        let steps = self.construction.steps.iter().filter(|s| s.on == group.diagram);
        out.extend(steps.flat_map(|s| self.construction.ops(s)).filter_map(|op| match op {
            Op::Lay { vector, .. } => {
                group.sides.iter().find(|s| s.vector == *vector).copied().map(Act::Lay)
            }
            Op::Meet { to, .. } => Some(Act::Cross(*to)),
            Op::Set(_)
            | Op::Path(_)
            | Op::Rule(_)
            | Op::Foot { .. }
            | Op::Image { .. }
            | Op::Same { .. }
            | Op::Number(_)
            | Op::Show(_)
            | Op::Omit { .. } => None,
        }));
        out.extend(self.measured(group).into_iter().map(Act::Read));
        out.extend(moments(true));
        out
    }

    /// Returns the unknown sides and diagonals of a group's polygon; of two opposite reactions only
    /// the first.
    pub fn measured(&self, group: &GroupForces) -> Vec<ForceEdge> {
        let unknown: Vec<ForceEdge> =
            group.sides.iter().filter(|s| !s.known).chain(&group.diagonals).copied().collect();
        let ends = |s: &ForceEdge| {
            let v = &self.construction.vectors[s.vector.index()];
            (v.from, v.to)
        };
        let told =
            |k: usize| !unknown[..k].iter().any(|s| (ends(s).1, ends(s).0) == ends(&unknown[k]));
        (0..unknown.len()).filter(|k| told(*k)).map(|k| unknown[k]).collect()
    }
}
