//! The mistake of taking accelerations from the instantaneous centre of velocity as if it had no
//! acceleration: the link's image has this point at the pole.

use super::rewrite::{crossing, replace_crossing};
use super::{EquationPart, Site, SolutionSide, Topology};
use hodograph_base::diag::{Both, both};
use hodograph_board::plan::{
    Plan, PlanStep, Special, SpecialLine, TermChain, TermConnection, TermKind, TurningBody, Vertex,
    VertexId, VertexPlace,
};
use hodograph_mechanism::mechanism::ConstraintLine;
use hodograph_scene::{DiagramKind, GuidePath, LinkId, PointId, Scene};

/// The vertices and lines needed to build the image.
struct ImageVertices {
    target: VertexId,
    known: VertexId,
    lines: [ConstraintLine; 2],
}

fn point(plan: &Plan, v: VertexId) -> Option<PointId> {
    match plan.vertex(v) {
        Vertex { spot: VertexPlace::Point(p), on: None, .. } => Some(*p),
        Vertex { .. } => None,
    }
}

/// Returns the line square to the velocity of a pin that another link guides about a fixed pivot,
/// or a fixed straight guide guides.
fn normal_line(scene: &Scene, link: LinkId, pin: PointId) -> Option<ConstraintLine> {
    let fixed = |q: &&PointId| **q != pin && scene.links[scene.ground.0].points.contains(q);
    let turning = scene
        .carriers(pin)
        .filter(|l| *l != link && *l != scene.ground)
        .find_map(|l| scene.links[l.0].points.iter().find(fixed));
    if let Some(far) = turning {
        return Some(ConstraintLine::Along { near: pin, far: *far });
    }
    let leads = |g: &&hodograph_scene::Guide| {
        g.pin == Some(pin) && g.on == scene.ground && matches!(g.path, GuidePath::Line { .. })
    };
    let guide = scene.guides.iter().position(|g| leads(&g))?;
    Some(ConstraintLine::Normal { pin, guide: hodograph_scene::GuideId(guide) })
}

/// Finds the crossing that gives one end of a link from the other, if the velocities of both ends
/// have known directions.
fn found(scene: &Scene, plan: &Plan, link: LinkId) -> Option<(usize, ImageVertices)> {
    crossing(plan, DiagramKind::Acceleration, |target, chains| {
        let turns = |c: &&TermChain| matches!(c.unknown[..], [t] if t.kind == TermKind::Tangential && t.by == TermConnection::Turning(TurningBody::Link(link)));
        let chain = chains.iter().find(turns)?;
        let from = chain.start;
        if plan.vertex(from).fixed {
            return None;
        }
        let lines = [
            normal_line(scene, link, point(plan, target)?)?,
            normal_line(scene, link, point(plan, from)?)?,
        ];
        Some(ImageVertices { target, known: from, lines })
    })
}

/// Returns each link between two points guided about fixed pivots or in fixed guides.
pub fn sites(t: &Topology) -> Vec<Site> {
    let links = (0..t.scene.links.len())
        .map(LinkId)
        .filter(|l| *l != t.scene.ground && !t.plan.rest.links[l.0]);
    links.filter(|l| found(t.scene, t.plan, *l).is_some()).map(Site::AccelerationByCentre).collect()
}

/// Returns the plan in which the second end follows from the first by an image on the pole.
pub fn hung_on_pole(scene: &Scene, plan: &Plan, link: LinkId) -> Option<(Plan, EquationPart)> {
    let (group, f) = found(scene, plan, link)?;
    let mut wrong = plan.clone();
    wrong.specials.push(Special {
        group,
        link,
        with: None,
        lines: f.lines.map(SpecialLine::Leg),
        legs: None,
    });
    let spot = VertexPlace::Special(wrong.specials.len() - 1);
    wrong.vertices.push(Vertex { spot, on: None, number: None, fixed: true, trial: None });
    let centre = VertexId(wrong.vertices.len() - 1);
    let step = PlanStep::Image { link, target: f.target, from: (centre, f.known) };
    replace_crossing(&mut wrong, DiagramKind::Acceleration, f.target, &step);
    let shown = EquationPart {
        on: DiagramKind::Acceleration,
        step,
        side: SolutionSide::Wrong,
        framed: Vec::new(),
        missing: None,
    };
    Some((wrong, shown))
}

/// Explains why the centre gives no accelerations.
pub fn why(scene: &Scene, l: LinkId) -> Both {
    let l = scene.link_name(l);
    both!(
        "The instantaneous centre of link {l} has zero velocity at this instant, but its acceleration is not zero: the accelerations are not those of a rotation about it."
    )
}
