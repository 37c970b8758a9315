//! The mistake of leaving the normal acceleration of a link out of a crossing.

use super::rewrite::{known_terms, leave_out};
use super::{EquationPart, Site, SolutionSide, Topology};
use hodograph_base::diag::{Both, both};
use hodograph_board::plan::{Plan, Term, TermConnection, TermKind, TurningBody};
use hodograph_scene::{DiagramKind, LinkId, Scene};

fn is_of(link: LinkId) -> impl Fn(&Term) -> bool {
    move |t| t.kind == TermKind::Normal && t.by == TermConnection::Turning(TurningBody::Link(link))
}

/// Returns each link with a normal acceleration that is laid off before two lines cross.
pub fn sites(t: &Topology) -> Vec<Site> {
    let mut all: Vec<Site> = Vec::new();
    for term in known_terms(t, true).filter(|term| term.kind == TermKind::Normal) {
        if let TermConnection::Turning(TurningBody::Link(l)) = term.by
            && !t.plan.rest.links[l.0]
            && !all.contains(&Site::NoNormal(l))
        {
            all.push(Site::NoNormal(l));
        }
    }
    all
}

/// Returns the plan without the normal acceleration of a link.
pub fn left_out(plan: &Plan, link: LinkId) -> Option<(Plan, EquationPart)> {
    let shown =
        EquationPart::with(plan, DiagramKind::Acceleration, SolutionSide::Right, is_of(link))?;
    let mut wrong = plan.clone();
    leave_out(&mut wrong, is_of(link));
    Some((wrong, shown))
}

/// Explains why the term is needed.
pub fn why(scene: &Scene, l: LinkId) -> Both {
    let l = scene.link_name(l);
    both!(
        "Link {l} turns at this instant: the relative acceleration of any two of its points has the normal component $l\\omega_{{{l}}}^2$ along the line joining them, whether or not $\\omega_{{{l}}}$ changes."
    )
}
