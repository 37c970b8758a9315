//! The special point of a triad: where the constraint lines of the two legs meet that the drawing uses.

use super::super::item::{Dash, Shape};
use super::super::symbols as sym;
use super::Draft;
use crate::geom::Point;
use crate::mechanism::Core;
use crate::plan::Spot;
use crate::plan::names::{point_label, special_name};

/// A special point further from the mechanism than this part of its size is only told in words: drawn, it would make the
/// mechanism small.
const REACH: f64 = 0.8;

impl Draft<'_> {
    /// Draws every special point that the construction used, with its two lines.
    pub(super) fn special_points(&mut self) {
        let worked = self.worked;
        for (v, vertex) in worked.plan.vertices.iter().enumerate() {
            let (Spot::Special { group, legs }, Some(at)) = (vertex.spot, worked.construction.diagram.spots[v]) else { continue };
            let Core::Link { legs: all, .. } = &worked.mechanism.groups[group].core else { continue };
            let drawn = worked.construction.velocity.as_ref().is_some_and(|p| p.images[v].is_some());
            if vertex.on.is_some() || !drawn || !self.within_reach(at) {
                continue;
            }
            for leg in [&all[legs.0], &all[legs.1]] {
                if let Some(from) = leg.line().and_then(|line| self.point(line.pin())) {
                    let shape = Shape::Line { from, to: at, stroke: self.style.thin.dashed(Dash::DashDot) };
                    self.d.shape("constraint-line", "special construction", shape);
                }
            }
            let name = point_label(&special_name(self.scene, &worked.plan, group));
            self.d.draw("special-point", "special point", sym::dot(self.style, at));
            self.d.label_at("special-point-letter", "special letter", &name, at, self.style.dot_radius_mm, None);
        }
    }

    fn within_reach(&self, at: Point) -> bool {
        let placed: Vec<Point> = self.worked.configuration.points.iter().flatten().map(|p| self.paper(*p)).collect();
        let size = placed.iter().flat_map(|p| placed.iter().map(move |q| p.distance(*q))).fold(0.0, f64::max);
        placed.iter().any(|p| p.distance(at) <= REACH * size)
    }
}
