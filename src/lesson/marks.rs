//! The points of the mechanism over all frames, with their velocities and accelerations. The page
//! uses them for paths, hodographs, vectors drawn at the points, and to judge a guess.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use serde_json::{Value, json};

use crate::geom::Point;
use crate::notation::Notation;
use crate::plan::text::PlanWriter;
use crate::plan::{VertexId, VertexPlace};
use crate::scene::quantity::Meaning;
use crate::scene::{DiagramKind, Lang};

use super::bank::Formulas;
use super::frames::{Frames, SolvedFrame};
use super::pack;
use super::scenery::stray;
use super::track::{UNIT, runs};

/// Data for the page, in mm of paper, y up.
///
/// * `seen`: the frames in which places, velocities and accelerations are known.
/// * `list`: each vertex's name, whether its place is given, whether it is a moving point of the
///   mechanism, whether a question asks for it, and the symbols of its vectors (−1 where it has
///   none).
/// * `columns`: for each vertex x and y of its place, its velocity and its acceleration.
pub fn marks(frames: &Frames, notation: &Notation, formulas: &mut Formulas) -> Value {
    let base = &frames.list[frames.base];
    let plan = &base.worked.plan;
    let w = PlanWriter { scene: &base.scene, plan, notation, lang: Lang::En };
    let alike = |f: &SolvedFrame| f.worked.plan.vertices == plan.vertices;
    let has = |f: &SolvedFrame, on: DiagramKind| {
        alike(f) && f.shown.contains(&on) && f.worked.construction.polygon(on).is_some()
    };
    let seen: [Vec<bool>; 3] = [
        frames.list.iter().map(alike).collect(),
        frames.list.iter().map(|f| has(f, DiagramKind::Velocity)).collect(),
        frames.list.iter().map(|f| has(f, DiagramKind::Acceleration)).collect(),
    ];
    let mut packed = CoordinateColumns::default();
    let mut list = Vec::new();
    for v in (0..plan.vertices.len()).map(VertexId) {
        let place = |f: &SolvedFrame| {
            f.worked.construction.diagram.spots[v.0].map(|p| p + stray(frames, f))
        };
        let placed = packed.points(frames, &seen[0], place);
        let fixed = plan.vertex(v).fixed;
        let symbols = [0, 1].map(|i| {
            let on = DiagramKind::POLYGONS[i];
            let image = |f: &SolvedFrame| f.worked.construction.polygon(on)?.images[v.0];
            if fixed || !seen[i + 1].contains(&true) || !packed.points(frames, &seen[i + 1], image)
            {
                return -1;
            }
            formulas.formula(&w.vector(on, v)) as i64
        });
        let moves = !fixed
            && plan.vertex(v).trial.is_none()
            && matches!(plan.vertex(v).spot, VertexPlace::Point(_));
        list.push(json!([
            formulas.formula(&w.name(v)),
            placed,
            placed && moves,
            asked(&w, v),
            symbols
        ]));
    }
    json!({"seen": seen.map(runs), "list": list, "columns": packed.text})
}

/// True if a question asks for a vector of the vertex.
fn asked(w: &PlanWriter, v: VertexId) -> bool {
    let VertexPlace::Point(point) = w.plan.vertex(v).spot else { return false };
    w.scene.find.iter().any(|f| match f.what.meaning(w.scene) {
        Some(Meaning::Vector(p)) => p.point == point,
        Some(
            Meaning::Place(_)
            | Meaning::Relative(..)
            | Meaning::Seen(..)
            | Meaning::Turning(..)
            | Meaning::Ratio(..),
        )
        | None => false,
    })
}

/// Columns one after the other; equal columns are stored once.
#[derive(Default)]
struct CoordinateColumns {
    text: String,
    told: HashMap<Vec<i64>, usize>,
}

impl CoordinateColumns {
    /// Adds a point over the frames in which it is seen. Returns `false` and adds nothing if some
    /// frame does not have it.
    fn points(
        &mut self,
        frames: &Frames,
        seen: &[bool],
        of: impl Fn(&SolvedFrame) -> Option<Point>,
    ) -> bool {
        let list: Option<Vec<Point>> =
            frames.list.iter().zip(seen).filter(|(_, s)| **s).map(|(f, _)| of(f)).collect();
        let Some(list) = list else { return false };
        for axis in [|p: &Point| p.x, |p: &Point| p.y] {
            let column: Vec<i64> = list.iter().map(|p| (axis(p) * UNIT).round() as i64).collect();
            let next = self.told.len();
            match self.told.entry(column) {
                Entry::Occupied(earlier) => pack::same(*earlier.get(), &mut self.text),
                Entry::Vacant(first) => {
                    pack::column(first.key(), &mut self.text);
                    first.insert(next);
                }
            }
        }
        true
    }
}
