//! Changes of a plan: terms left out, a crossing replaced by something else.

use super::Topology;
use hodograph_board::plan::{
    Between, GroupSteps, Plan, PlanStep, Term, TermChain, TermKind, VertexId,
};
use hodograph_scene::DiagramKind;

/// All steps of a group, in every alternative.
pub fn each(group: &GroupSteps) -> impl Iterator<Item = &PlanStep> {
    group.alternatives.iter().flatten().chain(&group.further)
}

/// The nonzero known terms of acceleration equations; with `crossings`, only of those that are
/// solved by crossing two lines.
pub fn known_terms<'a>(t: &'a Topology, crossings: bool) -> impl Iterator<Item = Term> + 'a {
    let chains = t
        .plan
        .steps(DiagramKind::Acceleration)
        .iter()
        .flat_map(each)
        .map(PlanStep::chains)
        .filter(move |c| !crossings || c.len() == 2);
    let known = chains.flatten().flat_map(|c| &c.known).copied();
    known.filter(|term| !t.plan.vanishes(t.scene, DiagramKind::Acceleration, term))
}

/// Removes known terms from the acceleration equations, and from the drawing between images.
pub fn leave_out(plan: &mut Plan, wrong: impl Fn(&Term) -> bool) {
    for group in plan.steps_mut(DiagramKind::Acceleration) {
        for step in group.alternatives.iter_mut().flatten().chain(&mut group.further) {
            if let PlanStep::Equation { chains, .. } = step {
                chains.iter_mut().for_each(|c| c.known.retain(|t| !wrong(t)));
            }
        }
        for between in &mut group.between {
            if let Between::LayOff { known, .. } = between {
                known.retain(|t| !wrong(t));
            }
        }
        group.between.retain(|b| !matches!(b, Between::LayOff { known, rest } if known.is_empty() && rest.is_empty()));
    }
}

/// Finds the first equation solved by crossing two lines for which `found` returns a value, and
/// returns the value with its group.
pub fn crossing<T>(
    plan: &Plan,
    on: DiagramKind,
    found: impl Fn(VertexId, &[TermChain]) -> Option<T>,
) -> Option<(usize, T)> {
    plan.steps(on).iter().find_map(|group| {
        let of = |step: &PlanStep| match step {
            PlanStep::Equation { target, chains, .. } if chains.len() == 2 => {
                found(*target, chains)
            }
            PlanStep::Equation { .. }
            | PlanStep::Image { .. }
            | PlanStep::Trials { .. }
            | PlanStep::Same { .. } => None,
        };
        each(group).find_map(of).map(|found| (group.group, found))
    })
}

/// Replaces the crossing that finds a vertex by another step. Angular quantities that were measured
/// on the edges of the crossing are measured on a perpendicular instead.
pub fn replace_crossing(plan: &mut Plan, on: DiagramKind, target: VertexId, by: &PlanStep) {
    for group in plan.steps_mut(on) {
        let mut tangential: Vec<Between> = Vec::new();
        for step in group.alternatives.iter_mut().flatten().chain(&mut group.further) {
            let PlanStep::Equation { target: own, chains, .. } = step else { continue };
            if *own != target || chains.len() != 2 {
                continue;
            }
            let turned =
                chains.iter().flat_map(|c| &c.unknown).filter(|t| t.kind == TermKind::Tangential);
            tangential.extend(turned.map(|t| Between::Perpendicular {
                normal: Term { kind: TermKind::Normal, known: true, ..*t },
                tangential: *t,
            }));
            *step = by.clone();
        }
        group.between.extend(tangential);
    }
}
