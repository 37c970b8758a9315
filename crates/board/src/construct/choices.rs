//! Choices made before the drawing: the constraint lines of a triad that are crossed, and a scale
//! for the trial.

use super::board::ActWriter;
use super::givens::PosedInputs;
use super::layout::Layout;
use super::pencil::Exact;
use crate::construction::{self, LineId};
use crate::plan::Plan;
use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_base::geom::{Point, Vec2, cross_lines};
use hodograph_mechanism::mechanism::{Core, Mechanism};
use hodograph_mechanism::position::Configuration;
use hodograph_scene::{ByKind, DiagramKind, Scene};

/// The pairs of legs with a special point of a triad, in the order of the plan's alternatives.
pub(super) const SPECIAL_LEGS: [(usize, usize); 3] = [(0, 1), (0, 2), (1, 2)];

/// Returns the alternative of the steps for each group: for a triad, the pair of constraint lines
/// that cross most squarely and closest to the link.
///
/// # Errors
/// A triad with parallel legs.
pub(super) fn alternatives(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration,
    plan: &Plan,
    mu: f64,
) -> Result<Vec<usize>, Faults> {
    let mut chosen = vec![0; m.groups.len()];
    for steps in plan.steps(DiagramKind::Velocity).iter().filter(|s| s.alternatives.len() > 1) {
        chosen[steps.group] = best_alternative(scene, m, at, plan, mu, steps.group)?;
    }
    Ok(chosen)
}

fn best_alternative(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration,
    plan: &Plan,
    mu: f64,
    group: usize,
) -> Result<usize, Faults> {
    let Core::Link { legs, link } = &m.groups[group].core else { return Ok(0) };
    let mut board = ActWriter::new(scene, m, plan, &[]);
    let on = board.set_out_joints();
    let lines: Vec<Option<LineId>> =
        legs.iter().map(|l| l.line().map(|line| board.constraint_line(on, line))).collect();
    let scales = Layout { mu, scales: ByKind::default() }.all();
    let posed = PosedInputs::new(scene, at, &board.done.givens);
    let drawn = construction::draw(&board.done.construction, &posed, &scales, &mut Exact).ok();
    let line = |leg: usize| lines[leg].and_then(|id| drawn.as_ref()?.lines[id.index()]);
    let nears: Vec<Point> = (0..legs.len()).filter_map(line).map(|(p, _)| p).collect();
    let centre =
        nears.iter().fold(Vec2::ZERO, |s, p| s + p.to_vec2()) * (1.0 / nears.len().max(1) as f64);
    let size = nears.iter().map(|p| (p.to_vec2() - centre).norm()).fold(0.0, f64::max);
    let score = |(a, b): (usize, usize)| -> f64 {
        match line(a).zip(line(b)).map(|((p, u), (q, w))| cross_lines(p, u, q, w)) {
            Some(c) if c.at.is_finite() => {
                c.sine.abs() / (1.0 + (c.at.to_vec2() - centre).norm() / size)
            }
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
            scene.link_name(*link)
        ),
    )
    .at(scene.links[link.0].span)
    .into())
}

/// Returns a scale for the trial drawing, of the order of the vectors, so that no square overflows.
pub(super) fn trial_scale(scene: &Scene, at: &Configuration, on: DiagramKind) -> f64 {
    let rate = scene.drivers.iter().map(|d| d.rate.value.abs()).fold(0.0, f64::max);
    let size = at.extent().max(f64::MIN_POSITIVE);
    let v = scene.drivers.iter().fold(0.0f64, |v, d| {
        v.max(if d.kind.turns() { d.rate.value.abs() * size } else { d.rate.value.abs() })
    });
    let s = match on {
        DiagramKind::Acceleration => v * (v / size).max(rate),
        DiagramKind::Plane | DiagramKind::Velocity | DiagramKind::Force => v,
    };
    let s = s / 100.0;
    if s.is_normal() { s } else { 1.0 }
}
