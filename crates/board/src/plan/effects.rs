//! The effects that a plan considers: whether each counts, and the reason.

use super::{Effect, Plan, PlanStep, Reason, TermConnection, TermKind};
use hodograph_mechanism::mechanism::{Demand, Level, Mechanism};
use hodograph_scene::{DiagramKind, GuideId, Scene};

/// Returns the effects considered, each with true if it counts, and the reason.
pub(super) fn considered(
    scene: &Scene,
    m: &Mechanism,
    demand: &Demand,
    plan: &Plan,
) -> Vec<(Effect, bool, Reason)> {
    let mut out = Vec::new();
    for (effect, level) in
        [(Effect::Velocities, Level::Velocity), (Effect::Accelerations, Level::Acceleration)]
    {
        let on = demand.level >= level;
        out.push((effect, on, if on { Reason::Asked } else { Reason::NotAsked }));
    }
    if demand.level >= Level::Velocity {
        let held = plan.rest.drivers.iter().enumerate().filter(|(_, held)| **held);
        out.extend(held.map(|(d, _)| (Effect::DriverRate(d), false, Reason::AtRest)));
    }
    if demand.level >= Level::Acceleration {
        for (i, driver) in scene.drivers.iter().enumerate() {
            let on = driver.acceleration.is_some();
            out.push((
                Effect::DriverAcceleration(i),
                on,
                if on { Reason::Accelerated } else { Reason::ConstantRate },
            ));
        }
        for (i, g) in scene.guides.iter().enumerate() {
            let id = GuideId(i);
            let steps = || {
                plan.steps(DiagramKind::Acceleration)
                    .iter()
                    .flat_map(|s| s.alternatives.iter().flatten().chain(&s.further))
            };
            let moves = |s: &PlanStep| {
                s.chains().iter().flat_map(|c| &c.known).any(|t| {
                    let here = matches!(t.by, TermConnection::Guide { guide, .. } if guide == id)
                        && t.kind == TermKind::Coriolis;
                    here && !plan.vanishes(scene, DiagramKind::Acceleration, t)
                })
            };
            let (on, reason) = if m.never_turns[g.on.0] {
                (false, Reason::GuideDoesNotTurn)
            } else if !steps().any(|s| s.slides_along(id)) {
                (false, Reason::GuideNotReached)
            } else if steps().any(moves) {
                (true, Reason::GuideTurns)
            } else {
                (false, Reason::AtRest)
            };
            out.push((Effect::Coriolis(id), on, reason));
        }
    }
    for (g, level) in demand.groups.iter().enumerate() {
        if level.is_none() && m.groups[g].class().is_some() {
            out.push((Effect::Group(g), false, Reason::NotAsked));
        }
    }
    out
}
