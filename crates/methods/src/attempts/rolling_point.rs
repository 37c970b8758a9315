//! The mistake of assuming that the contact point of a rolling wheel has no acceleration relative
//! to its track: the wheel's image is based on it, or a further point of the wheel is found from it
//! with the right angular velocity and acceleration. Both versions are printed; their numbers
//! differ.

use super::rewrite::{crossing, replace_crossing};
use super::{EquationPart, Missing, Site, SolutionSide, Topology};
use hodograph_base::diag::{Both, both};
use hodograph_board::plan::names::name_label;
use hodograph_board::plan::{
    Method, Plan, PlanStep, Term, TermChain, TermConnection, TermKind, TurningBody, VertexId,
    VertexPlace,
};
use hodograph_scene::{DiagramKind, LinkId, Normal, PointId, RollingId, Scene, Touch};

/// Returns the vertex found by the crossing for the wheel's point at a contact, with the crossing's
/// term along the normal.
fn found(plan: &Plan, pair: RollingId) -> Option<(usize, (VertexId, Term))> {
    crossing(plan, DiagramKind::Acceleration, |target, chains| {
        let rolls = |c: &&TermChain| matches!(c.unknown[..], [t] if t.kind == TermKind::Roll && t.by == TermConnection::Contact(pair));
        let other = chains.iter().find(|c| !rolls(c))?;
        let along = chains.iter().find(rolls).filter(|c| c.known.is_empty())?;
        (!other.unknown.iter().any(|t| t.kind == TermKind::Roll))
            .then_some((target, along.unknown[0]))
    })
}

/// Returns each contact with a point that is found by its normal.
pub fn sites(t: &Topology) -> Vec<Site> {
    let pairs = (0..t.scene.rolling.len())
        .map(RollingId)
        .filter(|r| t.scene.rolling[r.0].contact().is_some());
    pairs.filter(|r| found(t.plan, *r).is_some()).map(Site::RollingPointAZero).collect()
}

/// Returns the plan in which that point has the acceleration of the track.
pub fn as_track(plan: &Plan, pair: RollingId) -> Option<(Plan, EquationPart)> {
    let (_, (target, term)) = found(plan, pair)?;
    let shown =
        EquationPart::with(plan, DiagramKind::Acceleration, SolutionSide::Right, |t| t == &term)?;
    let mut wrong = plan.clone();
    let step = PlanStep::Equation {
        target,
        chains: vec![TermChain { start: term.to, known: vec![], unknown: vec![] }],
        method: Method::Coincident,
    };
    replace_crossing(&mut wrong, DiagramKind::Acceleration, target, &step);
    Some((wrong, shown))
}

/// Returns each further point of a wheel on a fixed track that the wheel's image gives.
pub fn bases(t: &Topology) -> Vec<Site> {
    let pairs = (0..t.scene.rolling.len()).map(RollingId);
    let of = |r: RollingId| {
        // The wheel's angular velocity and acceleration must be found before its further points.
        let turns = |l: &LinkId| {
            DiagramKind::POLYGONS.into_iter().all(|on| is_turning_found(t.plan, on, *l))
        };
        let wheel = wheel_on_ground(t.scene, r).filter(turns);
        let further = t.plan.steps(DiagramKind::Acceleration).iter().flat_map(|g| &g.further);
        let images = further.filter_map(move |step| imaged(t.plan, step, wheel?));
        images.map(move |(p, _)| Site::RollingPointAsBase(r, p))
    };
    let mut all: Vec<Site> = Vec::new();
    for site in pairs.flat_map(of) {
        if !all.contains(&site) {
            all.push(site);
        }
    }
    all
}

/// Returns the wheel of a pair with the ground.
fn wheel_on_ground(scene: &Scene, r: RollingId) -> Option<LinkId> {
    // A strand has two ends, and neither can be a base point.
    scene.rolling[r.0].contact()?;
    let [a, b] = scene.rolling[r.0].links;
    match (a == scene.ground, b == scene.ground) {
        (true, false) => Some(b),
        (false, true) => Some(a),
        (true, true) | (false, false) => None,
    }
}

/// True if a plan measures the rotation of a link in this polygon, or has it given.
fn is_turning_found(plan: &Plan, on: DiagramKind, link: LinkId) -> bool {
    plan.steps(on).iter().flat_map(|g| &g.rates).any(|(body, _)| *body == TurningBody::Link(link))
}

/// Returns the point that a step finds by the image of a link.
fn imaged(plan: &Plan, step: &PlanStep, wheel: LinkId) -> Option<(PointId, VertexId)> {
    let PlanStep::Image { link, target, .. } = *step else { return None };
    let vertex = plan.vertex(target);
    match vertex.spot {
        VertexPlace::Point(p) if link == wheel && vertex.on.is_none() => Some((p, target)),
        VertexPlace::Point(_) | VertexPlace::Special(_) => None,
    }
}

/// Returns the plan in which a point of the wheel has its normal and tangential parts relative to
/// the contact at rest.
pub fn as_base(
    scene: &Scene,
    plan: &Plan,
    pair: RollingId,
    point: PointId,
) -> Option<(Plan, EquationPart)> {
    let wheel = wheel_on_ground(scene, pair)?;
    let at = scene.rolling[pair.0].at[0];
    let contact = plan.find_vertex(scene, at, Some(wheel))?;
    let track = plan.find_vertex(scene, at, Some(scene.ground))?;
    let mut wrong = plan.clone();
    let mut shown = None;
    for group in wrong.steps_mut(DiagramKind::Acceleration) {
        for step in &mut group.further {
            let Some((_, target)) = imaged(plan, step, wheel).filter(|(p, _)| *p == point) else {
                continue;
            };
            let term = |kind| Term {
                kind,
                of: target,
                to: contact,
                by: TermConnection::Turning(TurningBody::Link(wheel)),
                known: true,
            };
            let known = vec![term(TermKind::Normal), term(TermKind::Tangential)];
            *step = PlanStep::Equation {
                target,
                chains: vec![TermChain { start: track, known, unknown: vec![] }],
                method: Method::SameLink,
            };
            let missing = Some(own_acceleration(scene, pair, wheel));
            shown = Some(EquationPart {
                on: DiagramKind::Acceleration,
                step: step.clone(),
                side: SolutionSide::Wrong,
                framed: Vec::new(),
                missing,
            });
        }
    }
    Some((wrong, shown?))
}

/// Returns the true acceleration of the contact: ω²r toward the centre of a wheel on a straight
/// track, ω²δ on a round one.
fn own_acceleration(scene: &Scene, pair: RollingId, wheel: LinkId) -> Missing {
    let rolling = &scene.rolling[pair.0];
    let (n, link) =
        (name_label(scene.point_name(rolling.at[0])), name_label(scene.link_name(wheel)));
    let (centre, straight) = match rolling.touch() {
        Touch::Point(Normal::Square { centre, .. }) => (centre, true),
        Touch::Point(Normal::Centres(centres)) | Touch::Strand { centres, .. } => {
            (if rolling.links[0] == wheel { centres[0] } else { centres[1] }, false)
        }
    };
    let centre = name_label(scene.point_name(centre));
    let size = if straight { format!("l_{{{centre}{n}}}") } else { "\\delta".to_owned() };
    Missing {
        symbol: format!("a_{{{n}{link}}}"),
        direction: format!("{n} \\to {centre}"),
        magnitude: format!("\\omega_{{{link}}}^2 {size}"),
    }
}

/// Explains why the contact has an acceleration.
pub fn why(scene: &Scene, r: RollingId) -> Both {
    let at = scene.point_name(scene.rolling[r.0].at[0]);
    both!(
        "At ${at}$ the velocities agree, and so do the tangential accelerations; along the normal the point of the wheel still has $\\Omega^2 \\rho_1 \\rho_2/(\\rho_1+\\rho_2)$ toward the centre of the wheel. Zero velocity does not mean zero acceleration."
    )
}
