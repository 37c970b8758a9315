//! Groups higher than class III: those that special points draw, and the notes on them.

use crate::accuracy::crossings;
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_board::construct::PlanDrawing;
use hodograph_board::plan::{Plan, PlanStep, VertexId};
use hodograph_mechanism::mechanism::{Core, Group, Mechanism, PairItem};
use hodograph_scene::{DiagramKind, Scene};

/// The groups without a core that a plan draws.
pub(super) fn drawn(mechanism: &Mechanism, plan: &Plan) -> Vec<usize> {
    let higher = |g: &usize| {
        matches!(mechanism.groups[*g].core, Core::Higher) && !plan.undrawable.contains(g)
    };
    (0..mechanism.groups.len()).filter(higher).collect()
}

/// The sine of the flattest crossing in the drawing of a group; 0 for a drawing that cannot be
/// made.
pub(super) fn worst_sine(g: usize, plan: &Plan, drawing: &Result<PlanDrawing, Faults>) -> f64 {
    let Ok(drawing) = drawing else { return 0.0 };
    let steps: Vec<&PlanStep> = plan
        .steps(DiagramKind::Velocity)
        .iter()
        .filter(|s| s.group == g)
        .flat_map(|s| s.steps(0))
        .collect();
    let own = |v: VertexId| {
        plan.special(v).is_some_and(|s| s.group == g) || steps.iter().any(|s| s.target() == v)
    };
    crossings(drawing, 0.0)
        .iter()
        .filter(|c| own(c.target))
        .map(|c| c.sine.abs())
        .fold(1.0, f64::min)
}

/// The wheels of a group that roll on one another while neither is known.
fn contacts(scene: &Scene, mechanism: &Mechanism, group: &Group) -> Vec<Both> {
    let pairs = group.constraints.iter().filter_map(|c| match mechanism.constraints[*c].item() {
        PairItem::Rolling(r) => scene.rolling[r.0].contact().map(|_| scene.rolling[r.0].links),
        PairItem::Pin(..) | PairItem::Guide(_) | PairItem::Driver(_) => None,
    });
    let inner = pairs.filter(|links| links.iter().all(|l| group.links.contains(l)));
    inner.map(|[a, b]| both!("{} and {}", scene.link_name(a), scene.link_name(b))).collect()
}

/// The notes on the required groups higher than class III: the means of drawing them, or that they
/// are not drawn.
pub(super) fn notes(scene: &Scene, mechanism: &Mechanism, plan: &Plan) -> Vec<Diagnostic> {
    let planned = |g: usize| {
        plan.undrawable.contains(&g)
            || plan.steps(DiagramKind::Velocity).iter().any(|s| s.group == g)
    };
    let groups = mechanism
        .groups
        .iter()
        .enumerate()
        .filter(|(g, group)| matches!(group.core, Core::Higher) && planned(*g));
    let note = |(g, group): (usize, &Group)| {
        let names: Vec<_> = group.links.iter().map(|l| scene.link_name(*l)).collect();
        let names = Both::names(&names);
        let between = contacts(scene, mechanism, group);
        if plan.undrawable.contains(&g) && !between.is_empty() {
            let message = both!(
                "links {} form a group higher than class III: {} roll on one another, and no link of the group is held along two lines whose crossing would be the \
                 special point to begin with; it is answered from the loop equations and not drawn",
                names,
                Both::listed(&between)
            );
            return Diagnostic::note("higher-group", message).help(both!(
                "the contact is their instantaneous centre: `hodograph draw --figure centres` draws the velocities; with one of the wheels as the driver's, the group falls apart"
            ));
        }
        let message = if plan.undrawable.contains(&g) {
            both!(
                "links {} form a group higher than class III: it is answered from the loop equations and not drawn",
                names
            )
        } else {
            both!(
                "links {} form a group higher than class III: it is drawn by {}",
                names,
                if plan.is_tried(g) {
                    both!("trial polygons")
                } else {
                    both!("the special point method")
                }
            )
        };
        Diagnostic::note("higher-group", message)
    };
    groups.map(note).collect()
}
