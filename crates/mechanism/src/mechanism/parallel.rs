//! Parallel guides that hold a distance twice. The count of freedoms does not show the repetition,
//! because it does not use directions.
//!
//! Perpendicular to a straight guide, the runner keeps its distance from the link that carries the
//! guide. If such guides of one direction join non-rotating links and pins in a circuit, they hold
//! one distance twice, and another freedom is open in every pose. Of several pairs that could be
//! opened, those are opened that leave no such circuit. A rack that slides along its own pitch line
//! is such a circuit by itself: its gear need not hold it.

use super::{Constraint, GraphNode, PairForm};
use hodograph_scene::{Guide, GuideDirection, GuidePath, LinkId, Scene};
use petgraph::unionfind::UnionFind;
use std::f64::consts::PI;

/// Tolerance of equal directions, as a part of a turn: values that are given twice differ by
/// rounding.
const SAME: f64 = 1e-9;

/// Returns the number of equations that repeat a distance across parallel guides.
pub(super) fn circles(scene: &Scene, constraints: &[Constraint], still: &[bool]) -> usize {
    let mut directions: Vec<f64> = Vec::new();
    for angle in constraints.iter().filter_map(|c| across(scene, still, c.form())) {
        if !directions.iter().any(|d| parallel(*d, angle)) {
            directions.push(angle);
        }
    }
    directions.into_iter().map(|d| circles_across(scene, (constraints, still), d)).sum()
}

fn circles_across(
    scene: &Scene,
    (constraints, still): (&[Constraint], &[bool]),
    direction: f64,
) -> usize {
    let index = |n: GraphNode| match n {
        GraphNode::Link(l) => l.0,
        GraphNode::Pin(p) => scene.links.len() + p.0,
    };
    let mut joined = UnionFind::new(scene.links.len() + scene.points.len());
    let holds = |form: PairForm| match form.meets() {
        // A pin of a link that never turns keeps its position across the guide.
        Some((_, link)) => still[link.0],
        None => across(scene, still, form).is_some_and(|angle| parallel(angle, direction)),
    };
    let forms = constraints.iter().map(|c| c.form()).filter(|f| holds(*f));
    forms.map(|f| f.ends()).filter(|(a, b)| !joined.union(index(*a), index(*b))).count()
}

/// Returns the direction of a straight guide on a link that never turns.
fn across(scene: &Scene, still: &[bool], form: PairForm) -> Option<f64> {
    let (guide, on) = form.point_guide()?;
    direction(&scene.guides[guide.0]).filter(|_| still[on.0])
}

/// Returns true if a rack slides along its own pitch line in the link that carries the axis of its
/// gear: then it keeps its distance, whatever drives the two.
pub(super) fn runs_along(scene: &Scene, pitch: &Guide) -> bool {
    let along = |g: &Guide| direction(g).zip(direction(pitch)).is_some_and(|(a, b)| parallel(a, b));
    let carries = |l: LinkId| pitch.pin.is_some_and(|axis| scene.links[l.0].points.contains(&axis));
    scene
        .guides
        .iter()
        .any(|g| g.rolling.is_none() && g.slider == Some(pitch.on) && carries(g.on) && along(g))
}

/// Returns the direction of a straight guide (rad), if it is given at the instant.
fn direction(guide: &Guide) -> Option<f64> {
    match &guide.path {
        GuidePath::Line { direction: GuideDirection::Instant(angle), .. } => {
            Some(angle.value.radians())
        }
        GuidePath::Line { .. } | GuidePath::Arc { .. } => None,
    }
}

fn parallel(a: f64, b: f64) -> bool {
    let turned = ((a - b) / PI).abs();
    (turned - turned.round()).abs() < SAME
}
