//! Additions to the drawing of the mechanism: vectors at its points, other positions behind it,
//! paths of points.

use hodograph_base::geom::{Point, Vec2};
use hodograph_board::construct::scale;
use hodograph_board::plan::text::PlanWriter;
use hodograph_board::plan::{VertexId, VertexPlace};
use hodograph_mechanism::position::Configuration;
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::item::{Colour, Dash, LineStroke, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::shown::ShownQuantity;
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::symbols as sym;
use hodograph_scene::{DiagramKind, PointId, Scene};
use hodograph_sweep::follow::PoseFollower;
use hodograph_sweep::points::at_equal_steps;
use hodograph_worked::worked::{Worked, work_motion};

use super::{MechanismDraft, SeriesFeatures};

/// Positions along a path: for a full circle a chord then deviates by less than a thousandth of the
/// radius.
const PATH_STEPS: usize = 180;
/// Space for the longest vector: a third of the usual diagram.
const VECTOR_MM: f64 = 45.0;
/// Below this length a vector has neither a visible head nor a visible direction.
const SHORTEST_MM: f64 = 0.4;
/// Colour of other positions and paths in the background.
const BEHIND: Colour = Colour::grey(150);

/// Additions to the drawing of the mechanism.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overlay {
    /// The polygon with its vectors drawn at the points, if any.
    pub vectors: Option<DiagramKind>,
    /// Other positions of the whole mechanism.
    pub poses: Vec<Configuration>,
    /// True if the given lengths are drawn as dimensions.
    pub dimensions: bool,
    /// Paths of points (m).
    pub paths: Vec<PointTrack>,
}

/// The path of a point.
#[derive(Clone, Debug, PartialEq)]
pub struct PointTrack {
    /// The point.
    pub point: PointId,
    /// The places on the path (m).
    pub places: Vec<Point>,
    /// True if the first place follows the last one.
    pub closed: bool,
    /// Places to be numbered from 1. A path with such places is the subject of its figure; any
    /// other is in the background of the mechanism.
    pub marks: Vec<Point>,
}

impl Overlay {
    /// Adds `poses` positions through the travel of the first driver, and the paths of these
    /// points.
    pub fn with_motion(
        mut self,
        scene: &Scene,
        worked: &Worked,
        poses: usize,
        points: &[PointId],
    ) -> Overlay {
        let motion_of_cams = work_motion(scene).ok().flatten();
        let (scene, worked) =
            motion_of_cams.as_ref().map_or((scene, worked), |(scene, worked)| (scene, worked));
        let follower =
            PoseFollower::new(scene, &worked.mechanism, &worked.demand, &worked.configuration, 0);
        let sweep = follower.sweep(PATH_STEPS);
        self.poses = at_equal_steps(&follower, &sweep, poses)
            .into_iter()
            .map(|pose| pose.configuration)
            .collect();
        let places = |p: PointId| {
            sweep.poses.iter().filter_map(|pose| pose.configuration.points[p.0]).collect()
        };
        let track = |&point: &PointId| PointTrack {
            point,
            places: places(point),
            closed: sweep.full,
            marks: Vec::new(),
        };
        self.paths = points.iter().map(track).collect();
        self
    }

    /// Returns the scale of the vectors (SI units per mm); `None` if no vectors are drawn.
    pub fn mu(&self, scene: &Scene, worked: &Worked) -> Option<f64> {
        let p = worked.construction.polygon(self.vectors?)?;
        let most = shown(worked, self.vectors?)
            .map(|(_, at)| at)
            .fold([0.0_f64; 2], |[x, y], v| [x.max(v.x.abs()), y.max(v.y.abs())]);
        Some(scale::choose_in(
            scene.paper.unit(p.on.kind()),
            most.map(|mm| mm * p.mu),
            [VECTOR_MM, VECTOR_MM],
        ))
    }
}

/// The points of the mechanism that have a vector on paper, with the vector (mm of the polygon).
fn shown(worked: &Worked, on: DiagramKind) -> impl Iterator<Item = (VertexId, Vec2)> + '_ {
    let images =
        worked.construction.polygon(on).into_iter().flat_map(|p| p.images.iter().enumerate());
    images.filter_map(|(v, at)| {
        let vertex = worked.plan.vertex(VertexId(v));
        let own =
            !vertex.fixed && vertex.trial.is_none() && matches!(vertex.spot, VertexPlace::Point(_));
        Some((VertexId(v), at.filter(|_| own)?.to_vec2()))
    })
}

/// Draws the mechanism with the additions over and behind it.
pub fn overlaid(
    style: &Style,
    scene: &Scene,
    worked: &Worked,
    w: &PlanWriter,
    overlay: &Overlay,
) -> DrawingPart {
    let alone = SeriesFeatures::default();
    let mut draft = MechanismDraft::new(style, scene, worked, w.notation, &alone);
    // Numbers of positions and numbers of links would be confused.
    draft.constructed = overlay.paths.iter().all(|path| path.marks.is_empty());
    draft.dimensioned = overlay.dimensions;
    draft.behind(overlay);
    draft.everything();
    draft.vectors(w, overlay);
    draft.marks(overlay);
    if overlay.dimensions {
        draft.dimensions();
    }
    draft.d.finish()
}

impl MechanismDraft<'_> {
    /// Draws other positions and paths, thin and grey.
    fn behind(&mut self, overlay: &Overlay) {
        let thin = self.style.thin.coloured(BEHIND);
        for (k, configuration) in overlay.poses.iter().enumerate() {
            let there = Worked { configuration: configuration.clone(), ..self.worked.clone() };
            let alone = SeriesFeatures::default();
            let other = MechanismDraft::new(self.style, self.scene, &there, self.notation, &alone);
            self.other(k, &other, thin);
        }
        overlay.paths.iter().filter(|path| path.marks.is_empty()).for_each(|path| self.path(path));
    }

    /// Draws the links of another position as lines, and its moving pins as dots.
    pub(super) fn other(&mut self, k: usize, other: &MechanismDraft, stroke: LineStroke) {
        for (l, form) in other.forms.iter().enumerate() {
            let Some(form) = form else { continue };
            for (from, to) in form.segments() {
                let line = Shape::Line { from, to, stroke };
                self.d.shape(&format!("pose-{k}-link-{l}"), "pose", line);
            }
        }
        for at in (0..self.scene.points.len())
            .map(PointId)
            .filter(|p| other.is_pin(*p) && !other.is_fixed_pivot(*p))
        {
            let Some(centre) = other.point(at) else { continue };
            let dot = Shape::Circle {
                centre,
                radius_mm: self.style.dot_radius_mm,
                stroke: None,
                fill: Some(stroke.colour),
            };
            self.d.shape(&format!("pose-{k}-pin"), "pose", dot);
        }
    }

    /// Draws a path: thin behind the mechanism, or thick over it as the subject of the figure.
    fn path(&mut self, path: &PointTrack) {
        let behind = path.marks.is_empty();
        let points: Vec<Point> = path.places.iter().map(|p| self.paper(*p)).collect();
        let thin = LineStroke {
            width_mm: self.style.outline.width_mm,
            dash: Dash::DashDot,
            ..self.style.thin
        };
        let stroke = if behind { thin } else { self.style.vector };
        self.d.of_link(self.scene.mover(path.point).map(|l| l.0).filter(|_| !behind));
        let shape =
            Shape::Polyline { points, closed: path.closed, stroke: Some(stroke), fill: None };
        self.d.shape(&format!("path-{}", self.scene.point_name(path.point)), "path", shape);
        self.d.of_link(None);
    }

    /// Draws the numbered places of paths.
    fn marks(&mut self, overlay: &Overlay) {
        for path in overlay.paths.iter().filter(|path| !path.marks.is_empty()) {
            self.path(path);
            self.d.of_link(self.scene.mover(path.point).map(|l| l.0));
            for (k, at) in path.marks.iter().enumerate() {
                let (at, name) = (
                    self.paper(*at),
                    format!("path-{}-{}", self.scene.point_name(path.point), k + 1),
                );
                self.d.draw(&name, "position", sym::dot(self.style, at));
                let request = LabelRequest::at_point(
                    Label::math((k + 1).to_string()),
                    self.style.small_mm,
                    at,
                    self.style.dot_radius_mm,
                );
                self.d.label(&name, "position", request);
            }
        }
        self.d.of_link(None);
    }

    fn vectors(&mut self, w: &PlanWriter, overlay: &Overlay) {
        let (Some(on), Some(mu)) = (overlay.vectors, overlay.mu(self.scene, self.worked)) else {
            return;
        };
        let Some(p) = self.worked.construction.polygon(on) else { return };
        let (worked, style) = (self.worked, self.style);
        for (v, vector) in shown(worked, on) {
            let vector = vector * (p.mu / mu);
            let Some(from) =
                worked.construction.diagram.spots[v.0].filter(|_| vector.norm() > SHORTEST_MM)
            else {
                continue;
            };
            let to = from + vector;
            let symbol = w.vector(on, v);
            let key = format!("{}-{}", on.prefix(), w.vector_key(v));
            let shown = ShownQuantity::vector(w.vector_quantity(on, v), from, to, mu);
            self.d.of_link(worked.plan.vertex(v).link(self.scene).map(|l| l.0));
            let owner = self.d.vector(
                &key,
                "vector",
                Shape::Arrow { from, to, stroke: style.vector, head: style.head },
                shown,
            );
            let request = LabelRequest::along(
                Label::math(&symbol),
                style.label_mm,
                from,
                to,
                style.vector.width_mm / 2.0,
            );
            self.d.label(&key, "vector", request.owned(owner));
        }
        self.d.of_link(None);
    }
}
