//! Other positions of the mechanism, dashed, with the letters of their pins, and angles and lengths
//! between positions.

use hodograph_base::geom::{Point, Vec2};
use hodograph_base::notation::Notation;
use hodograph_board::plan::names::point_label;
use hodograph_mechanism::position::Path;
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::item::{Dash, FigureItem, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::symbols as sym;
use hodograph_scene::{GuideId, PointId, Scene};
use hodograph_worked::worked::Worked;

use super::composed::BARS;
use super::looped::LoopArrow;
use super::{MechanismDraft, SeriesFeatures};

/// Distance of a dimension line from the pins.
const OFF_MM: f64 = 13.0;
/// An arc shorter than this has no arrowheads.
const HEADS_MM: f64 = 7.0;

/// A position of the mechanism beside its own.
pub struct OtherPosition {
    /// The mechanism there.
    pub worked: Worked,
    /// The features that it shares with the other positions.
    pub course: SeriesFeatures,
    /// The mark that its letters bear, such as `1` in `C_1`.
    pub mark: String,
}

/// An angle between two directions.
pub struct MarkedAngle {
    /// The name, for ids.
    pub key: String,
    /// The symbol, with its value if it is written there, in the label language.
    pub label: String,
    /// The vertex (m).
    pub centre: Point,
    /// The directions of its sides (rad).
    pub sides: [f64; 2],
    /// The radius of the arc.
    pub radius_mm: f64,
    /// The lengths of the lines drawn as its sides; 0 for a side along a link.
    pub lines_mm: [f64; 2],
}

/// A distance between two places.
pub struct MarkedLength {
    /// The name, for ids.
    pub key: String,
    /// The symbol with its value, in the label language.
    pub label: String,
    /// The places (m).
    pub places: [Point; 2],
}

/// The marks of a drawing of several positions.
#[derive(Default)]
pub struct PositionMarks {
    /// The other positions.
    pub poses: Vec<OtherPosition>,
    /// Angles.
    pub angles: Vec<MarkedAngle>,
    /// Lengths.
    pub lengths: Vec<MarkedLength>,
    /// Vectors between places.
    pub arrows: Vec<LoopArrow>,
    /// A path that a point describes on a link (m); may be empty.
    pub track: Vec<Point>,
    /// A further place (m) with its letter.
    pub place: Option<(Point, String)>,
    /// True if the mechanism's own position is in the background.
    pub light: bool,
}

/// Draws the mechanism with other positions behind it and angles and lengths over it.
pub fn positions(
    style: &Style,
    (scene, worked): (&Scene, &Worked),
    notation: &Notation,
    course: &SeriesFeatures,
    marks: &PositionMarks,
) -> DrawingPart {
    let faded = Style { link: style.link.coloured(BARS), ..style.clone() };
    let style = if marks.light { &faded } else { style };
    let mut draft = MechanismDraft::new(style, scene, worked, notation, course);
    draft.constructed = false;
    let others: Vec<MechanismDraft> = marks
        .poses
        .iter()
        .map(|p| MechanismDraft::new(style, scene, &p.worked, notation, &p.course))
        .collect();
    let dashed = style.thin.dashed(Dash::Dashed);
    for (k, other) in others.iter().enumerate() {
        draft.blocks_of(k, other);
        draft.other(k, other, dashed);
    }
    draft.everything();
    draft.numbers();
    for (pose, other) in marks.poses.iter().zip(&others) {
        draft.letters_of(&pose.mark, other);
    }
    marks.angles.iter().for_each(|a| draft.marked_angle(a));
    marks.lengths.iter().for_each(|l| draft.marked_length(l));
    draft.relative_path(&marks.track);
    marks.arrows.iter().for_each(|a| draft.closed_vector(a));
    if let Some((place, letter)) = &marks.place {
        let at = draft.paper(*place);
        draft.d.draw("place", "place", sym::dot(style, at));
        let label = Label::math(letter);
        draft.d.label(
            "place",
            "place",
            LabelRequest::at_point(label, style.small_mm, at, style.dot_radius_mm),
        );
    }
    draft.d.finish()
}

/// Returns the label of a point in a marked position: `C_1`, `B_{2,1}`.
pub(super) fn marked(name: &str, mark: &str) -> String {
    let label = point_label(name);
    match label.strip_suffix('}') {
        Some(before) if before.contains('_') => format!("{before},{mark}}}"),
        _ if label.contains('_') => format!("{label}^{{{mark}}}"),
        _ => format!("{label}_{{{mark}}}"),
    }
}

impl MechanismDraft<'_> {
    /// Draws the blocks of another position on guides of the ground.
    fn blocks_of(&mut self, k: usize, other: &MechanismDraft) {
        for g in (0..self.scene.guides.len()).map(GuideId) {
            let guide = &self.scene.guides[g.0];
            let (Some(Path::Line { direction, .. }), Some(at)) =
                (other.guide(g), guide.pin.and_then(|p| other.point(p)))
            else {
                continue;
            };
            // The guide of a cam's follower is drawn away from its pin.
            let follows = self.scene.cams.iter().any(|c| Some(c.follower) == guide.slider);
            if guide.on == self.scene.ground && guide.slider.is_some() && !follows {
                let block = sym::block(self.style, at, direction.angle(), true);
                self.d.draw(&format!("pose-{k}-block"), "pose", sym::dashed(block));
            }
        }
    }

    fn letters_of(&mut self, mark: &str, other: &MechanismDraft) {
        let moves = |p: &PointId| other.is_pin(*p) && !other.is_fixed_pivot(*p);
        for p in (0..self.scene.points.len()).map(PointId).filter(moves) {
            let Some(at) = other.point(p) else { continue };
            let name = self.scene.point_name(p);
            let label = Label::math(marked(name, mark));
            let request =
                LabelRequest::at_point(label, self.style.small_mm, at, self.style.dot_radius_mm);
            self.d.label(&format!("{name}-{mark}"), "position", request.optional(true));
        }
    }

    fn marked_angle(&mut self, a: &MarkedAngle) {
        let (style, centre, radius_mm) = (self.style, self.paper(a.centre), a.radius_mm);
        for (side, length) in a.sides.iter().zip(a.lines_mm).filter(|(_, length)| *length > 0.0) {
            let to = centre + Vec2::from_angle(*side) * length;
            let line = Shape::Line { from: centre, to, stroke: style.thin };
            self.d.shape(&format!("{}-side", a.key), "side", line);
        }
        let [from_rad, to_rad] = a.sides;
        let middle = 0.5 * (from_rad + to_rad);
        let stroke = style.thin;
        let arcs = if (to_rad - from_rad).abs() * radius_mm < HEADS_MM {
            vec![Shape::Arc { centre, radius_mm, from_rad, to_rad, stroke }]
        } else {
            let half = |to_rad: f64| Shape::ArcArrow {
                centre,
                radius_mm,
                from_rad: middle,
                to_rad,
                stroke,
                head: style.thin_head,
            };
            vec![half(from_rad), half(to_rad)]
        };
        let items = arcs.into_iter().map(|shape| FigureItem::new("", shape)).collect();
        let owner = self.d.draw(&a.key, "angle", items);
        let request = LabelRequest::along_arc(
            Label::math(&a.label),
            style.small_mm,
            centre,
            radius_mm,
            a.sides,
            stroke.width_mm / 2.0,
        );
        self.d.label(&a.key, "angle", request.owned(owner));
    }

    fn marked_length(&mut self, l: &MarkedLength) {
        let style = self.style;
        let [from, to] = l.places.map(|p| self.paper(p));
        let crossed = |d: &Self, off: f64| d.d.met_by(&sym::dimension(style, from, to, off), 1.0);
        // On the side where the lines cross less.
        let offset = if crossed(self, OFF_MM) < crossed(self, -OFF_MM) { OFF_MM } else { -OFF_MM };
        let owner = self.d.draw(&l.key, "dimension", sym::dimension(style, from, to, offset));
        let (a, b) = sym::dimension_line(from, to, offset);
        let clear = style.thin.width_mm / 2.0;
        let request = LabelRequest::along(Label::math(&l.label), style.small_mm, a, b, clear);
        self.d.label(&l.key, "dimension", request.owned(owner));
    }
}
