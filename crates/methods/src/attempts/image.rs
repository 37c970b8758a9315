//! The mistake of building an image on points of two links: a triangle of points that do not belong
//! to one link is not rigid.

use super::rewrite::each;
use super::{EquationPart, Site, SolutionSide, Topology};
use hodograph_base::diag::{Both, both};
use hodograph_board::plan::{Plan, PlanStep, VertexId, VertexPlace};
use hodograph_scene::{DiagramKind, LinkId, PointId, Scene};

/// Finds a point that an image of its link gives, another link on a pin of that link, and this pin
/// with a fixed point of the other link.
fn across(
    scene: &Scene,
    plan: &Plan,
    step: &PlanStep,
) -> Option<(PointId, LinkId, LinkId, [VertexId; 2])> {
    let PlanStep::Image { link, target, from } = step else { return None };
    let VertexPlace::Point(point) = plan.vertex(*target).spot else { return None };
    let pin_of = |v: VertexId| match plan.vertex(v).spot {
        VertexPlace::Point(p) => {
            Some(p).filter(|_| plan.vertex(v).on.is_none() && !plan.vertex(v).fixed)
        }
        VertexPlace::Special(_) => None,
    };
    [from.1, from.0].into_iter().find_map(|v| {
        let pin = pin_of(v)?;
        let other = |l: &LinkId| l != link && *l != scene.ground;
        scene.carriers(pin).filter(other).find_map(|l| {
            let fixed = |q: &&PointId| scene.links[scene.ground.0].points.contains(q);
            let pivot = scene.links[l.0].points.iter().find(fixed)?;
            Some((point, *link, l, [v, plan.find_vertex(scene, *pivot, None)?]))
        })
    })
}

/// Returns each point found by an image whose link is joined to another link with a fixed pivot.
pub fn sites(t: &Topology) -> Vec<Site> {
    let mut all: Vec<Site> = Vec::new();
    for step in t.plan.steps(DiagramKind::Velocity).iter().flat_map(each) {
        if let Some((p, own, other, _)) = across(t.scene, t.plan, step)
            && !all
                .iter()
                .any(|a| matches!(a, Site::ImageAcrossLinks(q, l, _) if (*q, *l) == (p, own)))
        {
            all.push(Site::ImageAcrossLinks(p, own, other));
        }
    }
    all
}

/// Returns the plan with the image on the points of the other link, in both polygons.
pub fn on_points_of(scene: &Scene, plan: &Plan, point: PointId) -> Option<(Plan, EquationPart)> {
    let mut wrong = plan.clone();
    let mut shown = None;
    for on in DiagramKind::POLYGONS {
        for group in wrong.steps_mut(on) {
            for step in group.alternatives.iter_mut().flatten().chain(&mut group.further) {
                let Some((p, link, _, [pin, pivot])) = across(scene, plan, step) else { continue };
                let PlanStep::Image { target, .. } = *step else { continue };
                if p == point {
                    *step = PlanStep::Image { link, target, from: (pin, pivot) };
                    shown = Some(EquationPart {
                        on,
                        step: step.clone(),
                        side: SolutionSide::Wrong,
                        framed: Vec::new(),
                        missing: None,
                    });
                }
            }
        }
    }
    Some((wrong, shown?))
}

/// Explains why there is no such image.
pub fn why(scene: &Scene, p: PointId, own: LinkId, other: LinkId) -> Both {
    let (p, own, other) = (scene.point_name(p), scene.link_name(own), scene.link_name(other));
    both!(
        "Velocity and acceleration images are similar to figures of one rigid link only: ${p}$ belongs to link {own}, the side on which its image is constructed to link {other}, and the angle between the two links changes."
    )
}
