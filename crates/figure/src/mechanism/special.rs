//! Draws special points: the intersections of two lines along which a link is held.

use super::MechanismDraft;
use hodograph_base::geom::Point;
use hodograph_board::construct::Polygon;
use hodograph_board::plan::names::{point_label, special_name};
use hodograph_board::plan::{SpecialLine, VertexPlace};
use hodograph_paper::paper::item::{Dash, Shape};
use hodograph_paper::paper::symbols as sym;
use hodograph_scene::DiagramKind;

/// Largest distance of a drawn special point from the mechanism, as a part of the mechanism's size.
/// A farther one is only described in words, because it would reduce the scale of the mechanism.
pub(crate) const REACH: f64 = 0.8;

impl MechanismDraft<'_> {
    /// Draws every special point that the construction used, with its two lines.
    pub(super) fn special_points(&mut self) {
        let worked = self.worked;
        for (v, vertex) in worked.plan.vertices.iter().enumerate() {
            let (VertexPlace::Special(k), Some(at)) =
                (vertex.spot, worked.construction.diagram.spots[v])
            else {
                continue;
            };
            let here = |v: &usize| worked.plan.vertices[*v].spot == vertex.spot;
            let drawn =
                |p: &Polygon| (0..p.images.len()).filter(here).any(|v| p.images[v].is_some());
            let drawn = worked.construction.polygon(DiagramKind::Velocity).is_some_and(drawn);
            if vertex.on.is_some() || vertex.trial.is_some() || !drawn || !self.within_reach(at) {
                continue;
            }
            for line in &worked.plan.specials[k].lines {
                let pin = match *line {
                    SpecialLine::Leg(line) => line.pin(),
                    SpecialLine::Through { pin, .. } => pin,
                };
                if let Some(from) = self.point(pin) {
                    let shape =
                        Shape::Line { from, to: at, stroke: self.style.thin.dashed(Dash::DashDot) };
                    self.d.shape("constraint-line", "special construction", shape);
                }
            }
            let name = point_label(&special_name(self.scene, &worked.plan, k));
            self.d.draw("special-point", "special point", sym::dot(self.style, at));
            self.d.label_at(
                "special-point-letter",
                "special letter",
                &name,
                at,
                self.style.dot_radius_mm,
                None,
            );
        }
    }

    fn within_reach(&self, at: Point) -> bool {
        let placed: Vec<Point> =
            self.worked.configuration.points.iter().flatten().map(|p| self.paper(*p)).collect();
        let size = placed
            .iter()
            .flat_map(|p| placed.iter().map(move |q| p.distance(*q)))
            .fold(0.0, f64::max);
        placed.iter().any(|p| p.distance(at) <= REACH * size)
    }
}
