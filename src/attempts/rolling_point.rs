//! The touching point of a rolling wheel taken to have no acceleration against its track.

use super::rewrite::{crossing, replace_crossing};
use super::{Shown, Side, Site, Topology};
use crate::diag::{Both, both};
use crate::mechanism::Level;
use crate::plan::{By, Chain, Method, Plan, Step, Term, TermKind, VertexId};
use crate::scene::{RollingId, Scene};

/// The crossing that finds the wheel's point at a contact, and the term along the normal in it.
fn found(plan: &Plan, pair: RollingId) -> Option<(usize, (VertexId, Term))> {
    crossing(plan, Level::Acceleration, |target, chains| {
        let rolls = |c: &&Chain| matches!(c.unknown[..], [t] if t.kind == TermKind::Roll && t.by == By::Contact(pair));
        let other = chains.iter().find(|c| !rolls(c))?;
        let along = chains.iter().find(rolls).filter(|c| c.known.is_empty())?;
        (!other.unknown.iter().any(|t| t.kind == TermKind::Roll)).then_some((target, along.unknown[0]))
    })
}

/// Each contact whose point is found by its normal.
pub fn sites(t: &Topology) -> Vec<Site> {
    let pairs = (0..t.scene.rolling.len()).map(RollingId).filter(|r| t.scene.rolling[r.0].contact().is_some());
    pairs.filter(|r| found(t.plan, *r).is_some()).map(Site::RollingPointAZero).collect()
}

/// The plan in which that point has the acceleration of the track.
pub fn as_track(plan: &Plan, pair: RollingId) -> Option<(Plan, Shown)> {
    let (_, (target, term)) = found(plan, pair)?;
    let shown = Shown::with(plan, Level::Acceleration, Side::Right, |t| t == &term)?;
    let mut wrong = plan.clone();
    let step =
        Step::Equation { target, chains: vec![Chain { start: term.to, known: vec![], unknown: vec![] }], method: Method::Coincident };
    replace_crossing(&mut wrong, Level::Acceleration, target, &step);
    Some((wrong, shown))
}

/// Why it has one.
pub fn why(scene: &Scene, r: RollingId) -> Both {
    let at = scene.point_name(scene.rolling[r.0].at[0]);
    both!(
        "At {at} the velocities agree, and so do the tangential accelerations; along the normal the point of the wheel has $\\Omega^2 \\rho_1 \\rho_2/(\\rho_1+\\rho_2)$ toward the wheel's centre. No velocity does not mean no acceleration.",
        "{at} 处两点速度相等，切向加速度也相等；但轮上接触点沿法线有指向轮心的加速度 $\\Omega^2 \\rho_1 \\rho_2/(\\rho_1+\\rho_2)$。速度为零并不意味着加速度为零。"
    )
}
