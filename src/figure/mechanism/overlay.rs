//! What can be drawn with the mechanism besides itself: vectors at its points, other positions behind it, paths of points.

use crate::construct::scale;
use crate::figure::drawing::Part;
use crate::figure::item::{Colour, Dash, Shape, Stroke};
use crate::figure::label::Label;
use crate::figure::place::LabelRequest;
use crate::figure::style::Style;
use crate::geom::{Point, Vec2};
use crate::mechanism::Level;
use crate::plan::text::Writer;
use crate::plan::{Spot, VertexId};
use crate::position::Configuration;
use crate::scene::{PointId, Scene};
use crate::worked::Worked;

use super::{Course, Draft};

/// Room for the longest vector: a third of the usual diagram.
const VECTOR_MM: f64 = 45.0;
/// A vector shorter than this has neither head nor direction for the eye.
const SHORTEST_MM: f64 = 0.4;
/// How far other positions and paths stand back.
const BEHIND: Colour = Colour::grey(150);

/// What is drawn besides the mechanism.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overlay {
    /// Vectors of this level at the points.
    pub vectors: Option<Level>,
    /// Other positions of everything.
    pub poses: Vec<Configuration>,
    /// Where points go (m), and whether they come back to where they began.
    pub paths: Vec<Track>,
}

/// The path of a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Whose path.
    pub point: PointId,
    /// Its places (m).
    pub places: Vec<Point>,
    /// Whether the last place is followed by the first.
    pub closed: bool,
}

impl Overlay {
    /// The scale of the vectors (SI per mm); `None` where none are drawn.
    pub fn mu(&self, worked: &Worked) -> Option<f64> {
        let p = worked.construction.polygon(self.vectors?)?;
        let most = shown(worked, self.vectors?).map(|(_, at)| at).fold([0.0_f64; 2], |[x, y], v| [x.max(v.x.abs()), y.max(v.y.abs())]);
        Some(scale::choose(most.map(|mm| mm * p.mu), [VECTOR_MM, VECTOR_MM]))
    }
}

/// The points of the mechanism that have a vector on paper, and the vector (mm of the polygon).
fn shown(worked: &Worked, level: Level) -> impl Iterator<Item = (VertexId, Vec2)> + '_ {
    let images = worked.construction.polygon(level).into_iter().flat_map(|p| p.images.iter().enumerate());
    images.filter_map(|(v, at)| {
        let vertex = worked.plan.vertex(VertexId(v));
        let own = !vertex.fixed && matches!(vertex.spot, Spot::Point(_));
        Some((VertexId(v), at.filter(|_| own)?.to_vec2()))
    })
}

/// The mechanism with what is drawn over and behind it.
pub fn overlaid(style: &Style, scene: &Scene, worked: &Worked, w: &Writer, overlay: &Overlay) -> Part {
    let alone = Course::default();
    let mut draft = Draft::new(style, scene, worked, w.notation, &alone);
    draft.behind(overlay);
    draft.everything();
    draft.vectors(w, overlay);
    draft.d.finish()
}

impl Draft<'_> {
    /// Other positions and paths, thin and grey.
    fn behind(&mut self, overlay: &Overlay) {
        let thin = self.style.thin.coloured(BEHIND);
        for (k, configuration) in overlay.poses.iter().enumerate() {
            let there = Worked { configuration: configuration.clone(), ..self.worked.clone() };
            let alone = Course::default();
            let other = Draft::new(self.style, self.scene, &there, self.notation, &alone);
            for (l, form) in other.forms.iter().enumerate() {
                let Some(form) = form else { continue };
                for (from, to) in form.segments() {
                    self.d.frame(&format!("pose-{k}-link-{l}"), "pose", Shape::Line { from, to, stroke: thin });
                }
            }
            for at in (0..self.scene.points.len()).map(PointId).filter(|p| other.is_pin(*p) && !other.is_fixed_pivot(*p)) {
                let Some(centre) = other.point(at) else { continue };
                let dot = Shape::Circle { centre, radius_mm: self.style.dot_radius_mm, stroke: None, fill: Some(BEHIND) };
                self.d.frame(&format!("pose-{k}-pin"), "pose", dot);
            }
        }
        for path in &overlay.paths {
            let points: Vec<Point> = path.places.iter().map(|p| self.paper(*p)).collect();
            let stroke = Stroke { width_mm: self.style.outline.width_mm, dash: Dash::DashDot, ..self.style.thin };
            let shape = Shape::Polyline { points, closed: path.closed, stroke: Some(stroke), fill: None };
            self.d.frame(&format!("path-{}", self.scene.point_name(path.point)), "path", shape);
        }
    }

    fn vectors(&mut self, w: &Writer, overlay: &Overlay) {
        let (Some(level), Some(mu)) = (overlay.vectors, overlay.mu(self.worked)) else { return };
        let Some(p) = self.worked.construction.polygon(level) else { return };
        let (worked, style) = (self.worked, self.style);
        for (v, vector) in shown(worked, level) {
            let vector = vector * (p.mu / mu);
            let Some(from) = worked.construction.diagram.spots[v.0].filter(|_| vector.norm() > SHORTEST_MM) else { continue };
            let to = from + vector;
            let symbol = w.vector(level, v);
            let vertex = worked.plan.vertex(v);
            let pinned = || match vertex.spot {
                Spot::Point(p) => self.scene.carriers(p).find(|l| *l != self.scene.ground),
                Spot::Special { .. } => None,
            };
            self.d.of_link(vertex.on.or(vertex.number).or_else(pinned).map(|l| l.0));
            let owner =
                self.d.shape(&format!("vector-{symbol}"), "vector", Shape::Arrow { from, to, stroke: style.vector, head: style.head });
            let request = LabelRequest::along(Label::math(&symbol), style.label_mm, from, to, style.vector.width_mm / 2.0);
            self.d.label(&format!("vector-{symbol}"), "vector", request.owned(owner));
        }
        self.d.of_link(None);
    }
}
