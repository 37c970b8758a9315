//! The marks of a polygon, for programs that measure on the drawing.

use crate::construct::{Mark, Polygon};
use crate::geom::Point;
use crate::plan::VertexId;
use crate::plan::text::Writer;

/// All marks of a polygon between which something can be measured, each once: the pole, images, ends of parts.
pub(super) fn marks(w: &Writer, p: &Polygon) -> Vec<(Mark, Point)> {
    let images = p.images.iter().enumerate().filter_map(|(v, at)| Some((p.mark(w.plan, VertexId(v)), (*at)?)));
    let mut all = vec![(Mark::Pole, Point::ORIGIN)];
    for mark in p.edges.iter().flat_map(|e| [e.from, e.to]).chain(images) {
        if !all.iter().any(|m| m.0 == mark.0) {
            all.push(mark);
        }
    }
    all
}
