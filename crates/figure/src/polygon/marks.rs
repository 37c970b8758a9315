//! The marks of a polygon, for programs that measure on the drawing.

use hodograph_base::geom::Point;
use hodograph_board::construct::{Polygon, PolygonMark};
use hodograph_board::plan::VertexId;
use hodograph_board::plan::text::PlanWriter;
use hodograph_paper::paper::drawing::id;
use hodograph_paper::paper::shown::ShownQuantity;
use hodograph_scene::DiagramKind;

/// Returns all marks of a polygon for measurements, each once: the pole, image points, ends of
/// components.
pub(super) fn marks(w: &PlanWriter, p: &Polygon) -> Vec<(PolygonMark, Point)> {
    let images = p
        .images
        .iter()
        .enumerate()
        .filter_map(|(v, at)| Some((p.mark(w.plan, VertexId(v)), (*at)?)));
    let mut all = vec![(PolygonMark::Pole, Point::ORIGIN)];
    for mark in p.edges.iter().flat_map(|e| [e.from, e.to]).chain(images) {
        if !all.iter().any(|m| m.0 == mark.0) {
            all.push(mark);
        }
    }
    all
}

/// Returns the key of a mark: `pole`, `image-B`, `normal-C-B`.
pub(super) fn key(w: &PlanWriter, on: DiagramKind, mark: &PolygonMark) -> String {
    match mark {
        PolygonMark::Pole => "pole".into(),
        PolygonMark::Image(v) if w.plan.vertex(*v).fixed => "pole".into(),
        PolygonMark::Image(v) => w.vector_key(*v).replacen("abs", "image", 1),
        PolygonMark::Part(t) => w.key(on, t),
        PolygonMark::Again(t) => format!("again-{}", w.key(on, t)),
    }
}

/// Returns the quantity of a mark: the vector that ends there.
pub(super) fn shown_by(w: &PlanWriter, on: DiagramKind, mark: &PolygonMark) -> ShownQuantity {
    let pole = || format!("pole-{}", on.letter());
    ShownQuantity::mark(match mark {
        PolygonMark::Pole => pole(),
        PolygonMark::Image(v) if w.plan.vertex(*v).fixed => pole(),
        PolygonMark::Image(v) => w.vector_quantity(on, *v),
        PolygonMark::Part(t) => w.quantity(on, t),
        PolygonMark::Again(t) => format!("{}-again", w.quantity(on, t)),
    })
}

/// Returns the id of a mark's element in the SVG: `acc-mark-normal-C-B`.
pub fn mark_id(w: &PlanWriter, on: DiagramKind, mark: &PolygonMark) -> String {
    let kind = on.word();
    id(kind, &format!("mark-{}", key(w, on, mark)))
}
