//! Diagnostics for drawings that cannot be made.

use super::PolygonMark;
use super::acts::Acts;
use crate::construction::{MarkId, Stop, Why};
use crate::plan::text::{held_by, vertex_name};
use crate::plan::{Plan, Term, TermConnection, VertexId, VertexPlace};
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::lang::each;
use hodograph_scene::{DiagramKind, Scene};

/// Returns the diagnostic for numbers that cannot be drawn.
pub(super) fn overflow() -> Diagnostic {
    Diagnostic::error("overflow", both!("the numbers are too large or too small to be drawn"))
}

/// Returns the diagnostic for a construction that stops.
pub(super) fn refusal(acts: &Acts, scene: &Scene, plan: &Plan, stop: &Stop) -> Diagnostic {
    let construction = &acts.construction;
    let step = &construction.steps[stop.step];
    let found =
        |mark: MarkId| if let PolygonMark::Image(v) = acts.mark(mark) { Some(v) } else { None };
    let missing = if let Why::Missing(mark) = stop.why { found(mark) } else { None };
    match (stop.why, missing, step.ends) {
        (Why::Parallel(lines, to), ..) => {
            let open = lines.map(|l| acts.terms(&construction.lines[l.index()].carries));
            found(to).map_or_else(overflow, |target| {
                dead_centre(scene, plan, construction.diagrams[step.on.index()], target, &open)
            })
        }
        (_, Some(v), _) => {
            let name = vertex_name(scene, plan, v);
            Diagnostic::error(
                "dead-centre",
                both!("the lines that cross in {name} are parallel in this pose"),
            )
            .help(both!("choose another pose"))
        }
        (Why::Coincide | Why::Missing(_), None, Some(ends)) => {
            let [a, b] = ends.map(|k| vertex_name(scene, plan, VertexId(k.index())));
            Diagnostic::error(
                "coincident-points",
                both!("{a} and {b} coincide in this pose: their line has no direction"),
            )
            .help(both!("choose another pose, or other lengths"))
        }
        (Why::Coincide | Why::Missing(_), None, None) => overflow(),
    }
}

/// Returns the diagnostic for two parallel lines, each the direction of some terms.
fn dead_centre(
    scene: &Scene,
    plan: &Plan,
    on: DiagramKind,
    target: VertexId,
    open: &[Vec<Term>; 2],
) -> Diagnostic {
    let words: Vec<Both> =
        open.iter().filter_map(|terms| terms.first()).map(|t| held_by(scene, plan, t)).collect();
    let at = vertex_name(scene, plan, target);
    let lie = if open
        .iter()
        .flatten()
        .all(|t| matches!(t.by, TermConnection::Turning(_) | TermConnection::Cylinder(_)))
    {
        both!("lie in line")
    } else {
        both!("leave the same direction open")
    };
    let d = Diagnostic::error(
        "dead-centre",
        both!(
            "dead centre: {} {} at {at}, so that its {} is not determined",
            Both::join(&words, each!(" and ")),
            lie,
            on.vector()
        ),
    )
    .help(both!("choose another pose, or drive another link"));
    match plan.vertex(target).spot {
        VertexPlace::Point(p) => d.at(scene.points[p.0].span),
        VertexPlace::Special(_) => d,
    }
}
