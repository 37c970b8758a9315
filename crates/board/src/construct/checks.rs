//! Checks of the drawing by redundant links (virtual constraints). Such a link has two pins at a
//! fixed distance, so that along their line the relative velocity is zero and the relative
//! acceleration is aⁿ. No crossing uses it, so it checks the drawing.

use super::{PlanDrawing, Polygon};
use crate::plan::Plan;
use hodograph_base::geom::Point;
use hodograph_mechanism::mechanism::Mechanism;
use hodograph_mechanism::position::Configuration;
use hodograph_scene::{DiagramKind, PointId, Scene};

/// A condition of an opened link, and the error of the drawing in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Condition {
    /// Index into [`Mechanism::redundant`].
    pub index: usize,
    /// The two pins.
    pub pins: (PointId, PointId),
    /// The polygon: velocities or accelerations.
    pub on: DiagramKind,
    /// The error (mm of paper).
    pub off_mm: f64,
}

/// Returns the conditions of all opened links with both pins' images on the paper.
pub fn conditions(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration,
    plan: &Plan,
    paper: &PlanDrawing,
) -> Vec<Condition> {
    let mut out = Vec::new();
    for (index, redundant) in m.redundant.iter().enumerate() {
        let hodograph_mechanism::mechanism::Opened::Link(l) = redundant.opened else { continue };
        let Some(pins) = m.held(l) else { continue };
        for on in DiagramKind::POLYGONS {
            let off = off_mm(scene, at, plan, paper, pins, on);
            out.extend(off.map(|off_mm| Condition { index, pins, on, off_mm }));
        }
    }
    out
}

fn off_mm(
    scene: &Scene,
    at: &Configuration,
    plan: &Plan,
    paper: &PlanDrawing,
    (a, b): (PointId, PointId),
    on: DiagramKind,
) -> Option<f64> {
    let line = at.points[b.0]? - at.points[a.0]?;
    let along = line.unit()?;
    let apart = |polygon: &Polygon| {
        let image = |p: PointId| {
            let fixed = scene.links[scene.ground.0].points.contains(&p);
            if fixed {
                Some(Point::ORIGIN)
            } else {
                polygon.images[plan.find_vertex(scene, p, None)?.0]
            }
        };
        Some(image(b)? - image(a)?)
    };
    let velocities = paper.polygon(DiagramKind::Velocity)?;
    let v = apart(velocities)?;
    if on == DiagramKind::Velocity {
        return Some(v.dot(along).abs());
    }
    let accelerations = paper.polygon(on)?;
    // aⁿ = v²/l, with the component of v square to the drawn line.
    let across = v.dot(along.perp()) * velocities.mu;
    let normal = across * across / line.norm() / accelerations.mu;
    Some((apart(accelerations)?.dot(along) + normal).abs())
}
