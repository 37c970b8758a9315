//! What is chosen before anything is drawn, in `f64` whatever the numbers of the drawing: which constraint lines of a triad
//! are crossed, and a scale for the first trial.

use super::board::Board;
use super::pencil::Pencil;
use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_base::geom::{Point, Vec2, cross_lines};
use hodograph_mechanism::mechanism::Core;
use hodograph_scene::DiagramKind;

/// The pairs of legs on which the special point of a triad may lie, in the order of the plan's alternatives.
pub(super) const SPECIAL_LEGS: [(usize, usize); 3] = [(0, 1), (0, 2), (1, 2)];

impl<P: Pencil> Board<'_, f64, P> {
    /// The pair of constraint lines that cross most squarely and closest to the link.
    pub(super) fn best_alternative(&self, group: usize) -> Result<usize, Faults> {
        let Core::Link { legs, link } = &self.m.groups[group].core else { return Ok(0) };
        let nears: Vec<Point> = legs.iter().filter_map(|l| self.constraint_line(l)).map(|(p, _)| p).collect();
        let centre = nears.iter().fold(Vec2::ZERO, |s, p| s + p.to_vec2()) * (1.0 / nears.len().max(1) as f64);
        let size = nears.iter().map(|p| (p.to_vec2() - centre).norm()).fold(0.0, f64::max);
        let score = |pair: (usize, usize)| -> f64 {
            match self.constraint_lines(group, pair).map(|((p, u), (q, w))| cross_lines(p, u, q, w)) {
                Some(c) if c.at.is_finite() => c.sine.abs() / (1.0 + (c.at.to_vec2() - centre).norm() / size),
                _ => 0.0,
            }
        };
        let scores = SPECIAL_LEGS.map(score);
        let best = (0..3).fold(0, |b, i| if scores[i] > scores[b] { i } else { b });
        if scores[best] > 0.0 {
            return Ok(best);
        }
        Err(Diagnostic::error(
            "dead-centre",
            both!(
                "the three legs of link {} are parallel: it is at a dead centre",
                "构件 {} 的三条支链平行：处于死点",
                self.scene.link_name(*link)
            ),
        )
        .at(self.scene.links[link.0].span)
        .into())
    }

    /// A scale for the trial drawing: of the order of the vectors, so that no square overflows.
    pub(super) fn trial_scale(&self, on: DiagramKind) -> f64 {
        let rate = self.scene.drivers.iter().map(|d| d.rate.value.abs()).fold(0.0, f64::max);
        let size = self.at.extent().max(f64::MIN_POSITIVE);
        let v = self
            .scene
            .drivers
            .iter()
            .fold(0.0f64, |v, d| v.max(if d.kind.turns() { d.rate.value.abs() * size } else { d.rate.value.abs() }));
        let s = match on {
            DiagramKind::Acceleration => v * (v / size).max(rate),
            DiagramKind::Plane | DiagramKind::Velocity => v,
        };
        let s = s / 100.0;
        if s.is_normal() { s } else { 1.0 }
    }
}
