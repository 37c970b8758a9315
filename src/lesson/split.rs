//! Splits a polygon of many vectors over several drawings, so that each is legible from a distance.
//!
//! A polygon is split if in some pose its vectors cannot all be named in type of the usual size,
//! and only if all poses split alike and no part has nearly all of them. The parts are those of [`crate::figure::polygon::shares`].

use crate::figure::polygon::{Share, is_full, is_full_share, shares};
use crate::geom::Point;
use crate::notation::Notation;
use crate::paper::style::Style;
use crate::plan::text::PlanWriter;
use crate::scene::{DiagramKind, Lang, Scene};
use crate::worked::Worked;

/// The split of a polygon.
#[derive(Clone, Debug, PartialEq)]
pub struct PolygonSplit {
    of: Vec<usize>,
    parts: usize,
}

impl PolygonSplit {
    /// The number of parts, at least two.
    pub fn parts(&self) -> usize {
        self.parts
    }

    /// The part of an action; the pole, drawn before all actions, belongs to the first.
    pub fn part_of(&self, action: Option<usize>) -> usize {
        action.and_then(|k| self.of.get(k)).copied().unwrap_or(0)
    }

    /// One part.
    pub fn share(&self, part: usize) -> Share<'_> {
        Share { of: &self.of, part }
    }

    /// The ends of a part's vectors in a pose, seen from the pole (SI), in the same order in all
    /// poses.
    pub fn ends(&self, worked: &Worked, on: DiagramKind, part: usize) -> Vec<Option<Point>> {
        let Some(p) = worked.construction.polygon(on) else { return Vec::new() };
        self.share(part)
            .ends(p)
            .into_iter()
            .map(|end| end.map(|q| (q.to_vec2() * p.mu).to_point()))
            .collect()
    }
}

/// The most that one part may hold of all actions: with more, it would be as full as the whole.
const LARGEST: f64 = 0.75;

/// The split of a polygon over all poses, if it is split, and the type size of each of its drawings
/// (mm): small where there are many vectors.
pub fn split(
    poses: &[(&Scene, &Worked)],
    on: DiagramKind,
    style: &Style,
    notation: &Notation,
) -> (Option<PolygonSplit>, Vec<f64>) {
    let drawn = || {
        poses.iter().filter_map(|(scene, worked)| {
            let w = PlanWriter { scene, plan: &worked.plan, notation, lang: Lang::En };
            Some((w, *worked, worked.construction.polygon(on)?))
        })
    };
    let size = |many: bool| if many { style.small_mm } else { style.label_mm };
    if !drawn().any(|(w, _, p)| is_full(&w, p)) {
        return (None, vec![size(false)]);
    }
    let mut each = drawn().map(|(w, worked, p)| shares(&w, &worked.mechanism, p));
    let of = each.next().unwrap_or_default();
    let parts = of.iter().max().map_or(1, |last| last + 1);
    let acts = |part| of.iter().filter(|p| **p == part).count();
    let largest = (0..parts).map(acts).max().unwrap_or(0);
    if largest as f64 > LARGEST * of.len() as f64 || !each.all(|other| other == of) {
        return (None, vec![size(true)]);
    }
    let split = PolygonSplit { of, parts };
    let many = |part| drawn().any(|(w, _, p)| is_full_share(&w, p, split.share(part)));
    let sizes = (0..parts).map(|part| size(many(part))).collect();
    (Some(split), sizes)
}
