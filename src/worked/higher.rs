//! Groups higher than class III: which of them the special points draw, and what is said of them.

use crate::diag::{Diagnostic, both};
use crate::mechanism::{Core, Group, Mechanism};
use crate::plan::Plan;
use crate::scene::Scene;

/// The groups without a core that a plan draws.
pub(super) fn drawn_by_special_points(mechanism: &Mechanism, plan: &Plan) -> Vec<usize> {
    let higher = |g: &usize| matches!(mechanism.groups[*g].core, Core::Higher) && !plan.undrawable.contains(g);
    (0..mechanism.groups.len()).filter(higher).collect()
}

/// What is said of the groups higher than class III that are called for: by what they are drawn, or that they are not.
pub(super) fn notes(scene: &Scene, mechanism: &Mechanism, plan: &Plan) -> Vec<Diagnostic> {
    let planned = |g: usize| plan.undrawable.contains(&g) || plan.velocity.iter().any(|s| s.group == g);
    let groups = mechanism.groups.iter().enumerate().filter(|(g, group)| matches!(group.core, Core::Higher) && planned(*g));
    let note = |(g, group): (usize, &Group)| {
        let names: Vec<_> = group.links.iter().map(|l| scene.link_name(*l)).collect();
        let names = names.join(", ");
        let message = if plan.undrawable.contains(&g) {
            both!(
                "links {names} form a group higher than class III: it is answered from the loop equations and not drawn",
                "构件 {names} 组成高于Ⅲ级的杆组：由回路方程求解，不作图"
            )
        } else {
            both!(
                "links {names} form a group higher than class III: it is drawn by special points",
                "构件 {names} 组成高于Ⅲ级的杆组：用特殊点作图"
            )
        };
        Diagnostic::note("higher-group", message)
    };
    groups.map(note).collect()
}
