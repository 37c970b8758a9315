//! The mistakes with the Coriolis acceleration at a turning guide: left out, or with the angular
//! velocity of another link.

use super::rewrite::{known_terms, leave_out};
use super::{EquationPart, Site, SolutionSide, Topology};
use hodograph_base::diag::{Both, both};
use hodograph_board::plan::{Plan, Term, TermConnection, TermKind, TurningBody};
use hodograph_scene::{DiagramKind, GuideId, LinkId, Scene};

fn is_at(guide: GuideId) -> impl Fn(&Term) -> bool {
    move |t| {
        t.kind == TermKind::Coriolis
            && matches!(t.by, TermConnection::Guide { guide: g, .. } if g == guide)
    }
}

fn guides(t: &Topology) -> Vec<GuideId> {
    let mut all: Vec<GuideId> = Vec::new();
    for term in known_terms(t, true).filter(|term| term.kind == TermKind::Coriolis) {
        if let TermConnection::Guide { guide, .. } = term.by
            && !all.contains(&guide)
        {
            all.push(guide);
        }
    }
    all
}

/// Returns each guide with a Coriolis acceleration in an equation.
pub fn without(t: &Topology) -> Vec<Site> {
    guides(t).into_iter().map(Site::NoCoriolis).collect()
}

/// Returns each such guide with each link that carries its runner, turns, and has a known angular
/// velocity.
pub fn by_another(t: &Topology) -> Vec<Site> {
    let known = |l: &LinkId| {
        t.plan
            .steps(DiagramKind::Velocity)
            .iter()
            .flat_map(|g| &g.rates)
            .any(|(b, _)| *b == TurningBody::Link(*l))
    };
    let mut all = Vec::new();
    for g in guides(t) {
        let guide = &t.scene.guides[g.0];
        let Some(pin) = guide.pin else { continue };
        let other = |l: &LinkId| {
            *l != guide.on
                && Some(*l) != guide.slider
                && !t.mechanism.never_turns[l.0]
                && !t.plan.rest.links[l.0]
        };
        all.extend(
            t.scene
                .carriers(pin)
                .filter(|l| other(l) && known(l))
                .map(|l| Site::CoriolisWrongOmega(g, l)),
        );
    }
    all
}

/// Returns the plan without the term.
pub fn left_out(plan: &Plan, guide: GuideId) -> Option<(Plan, EquationPart)> {
    let shown =
        EquationPart::with(plan, DiagramKind::Acceleration, SolutionSide::Right, is_at(guide))?;
    let mut wrong = plan.clone();
    leave_out(&mut wrong, is_at(guide));
    Some((wrong, shown))
}

/// Returns the plan in which the term has another link's angular velocity.
pub fn turned_by(plan: &Plan, guide: GuideId, link: LinkId) -> Option<(Plan, EquationPart)> {
    let mut wrong = plan.clone();
    wrong.coriolis_by = Some((guide, link));
    let shown =
        EquationPart::with(&wrong, DiagramKind::Acceleration, SolutionSide::Wrong, is_at(guide))?;
    Some((wrong, shown))
}

/// Explains why the term is needed.
pub fn why_needed(scene: &Scene, g: GuideId) -> Both {
    let on = scene.link_name(scene.guides[g.0].on);
    both!(
        "The guide turns with link {on} while the point slides along it, so the relative velocity changes its direction as well: the Coriolis acceleration $2\\omega_{{{on}}} \\times v_r$ must be added."
    )
}

/// Explains why the term takes the angular velocity of the guide's link.
pub fn why_of_carrier(scene: &Scene, g: GuideId, other: LinkId) -> Both {
    let (on, other) = (scene.link_name(scene.guides[g.0].on), scene.link_name(other));
    both!(
        "The Coriolis acceleration takes the angular velocity of the moving frame, link {on}, which carries the guide: $2\\omega_{{{on}}} \\times v_r$; link {other} is not the frame."
    )
}
