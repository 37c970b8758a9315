//! The vectors of a composite motion at the moving point: two components form a parallelogram with
//! the absolute vector as its diagonal.

use hodograph_base::geom::{Point, Vec2};
use hodograph_base::notation::Notation;
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::item::{Colour, Dash, LineStroke, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::shown::ShownQuantity;
use hodograph_paper::paper::style::Style;
use hodograph_scene::{PointId, Scene};
use hodograph_worked::worked::Worked;

use super::{MechanismDraft, SeriesFeatures};

/// Below this length a vector has neither a visible head nor a visible direction.
pub const SHORTEST_MM: f64 = 0.4;

/// Colour of bars in the background of the vectors.
pub(super) const BARS: Colour = Colour::grey(165);

/// A vector on paper.
#[derive(Clone, Debug, PartialEq)]
pub struct ComposedVector {
    /// The symbol in the label language.
    pub symbol: String,
    /// The key, for ids.
    pub key: String,
    /// The quantity that the vector shows.
    pub shown: ShownQuantity,
    /// The components (mm).
    pub mm: Vec2,
    /// True for the absolute vector, the sum of the others.
    pub absolute: bool,
    /// The step of the construction that draws it.
    pub step: Option<usize>,
}

/// The vectors at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Composed {
    /// The moving point; `None` without vectors.
    pub at: Option<PointId>,
    /// True for a drawing with the numbers of links in place of the special points.
    pub numbered: bool,
    /// The absolute vector and its components.
    pub vectors: Vec<ComposedVector>,
    /// True if dashed lines close the parallelogram of two components.
    pub parallelogram: bool,
    /// The places of the point's relative path (m), on its frame in the pose; may be empty.
    pub track: Vec<Point>,
}

/// Draws the mechanism with the vectors.
pub fn composed(
    style: &Style,
    scene: &Scene,
    worked: &Worked,
    notation: &Notation,
    what: &Composed,
) -> DrawingPart {
    let alone = SeriesFeatures::default();
    // A vector along a bar would be invisible on a dark bar.
    let style = &Style { link: style.link.coloured(BARS), ..style.clone() };
    let mut draft = MechanismDraft::new(style, scene, worked, notation, &alone);
    draft.constructed = !what.numbered;
    draft.everything();
    if what.numbered {
        draft.numbers();
    }
    draft.relative_path(&what.track);
    draft.vectors_at(what);
    draft.d.finish()
}

impl MechanismDraft<'_> {
    /// Draws a relative path, thin, behind the mechanism.
    pub(super) fn relative_path(&mut self, places: &[Point]) {
        if places.len() < 2 {
            return;
        }
        let points: Vec<Point> = places.iter().map(|p| self.paper(*p)).collect();
        let stroke = Some(self.style.thin.dashed(Dash::DashDot));
        let shape = Shape::Polyline { points, closed: false, stroke, fill: None };
        self.d.behind(|d| {
            d.shape("relative-path", "path", shape);
        });
    }

    fn vectors_at(&mut self, what: &Composed) {
        let (Some(from), style) = (what.at.and_then(|p| self.point(p)), self.style) else { return };
        let parts: Vec<&ComposedVector> = what.vectors.iter().filter(|v| !v.absolute).collect();
        if let (true, [a, b]) = (what.parallelogram, &parts[..]) {
            let stroke = style.thin.dashed(Dash::Dashed);
            self.d.at_step(what.vectors.iter().filter_map(|v| v.step).max());
            for (start, along) in [(a.mm, b.mm), (b.mm, a.mm)] {
                let (start, end) = (from + start, from + start + along);
                // Parallel vectors would be covered by the closing line.
                if along.norm() > SHORTEST_MM
                    && a.mm.cross(b.mm).abs() > SHORTEST_MM * a.mm.norm().max(b.mm.norm())
                {
                    self.d.shape(
                        "parallelogram",
                        "closing",
                        Shape::Line { from: start, to: end, stroke },
                    );
                }
            }
        }
        for v in what.vectors.iter().filter(|v| v.mm.norm() > SHORTEST_MM) {
            let to = from + v.mm;
            self.d.at_step(v.step);
            let stroke = if v.absolute {
                style.vector
            } else {
                LineStroke { width_mm: style.vector.width_mm * 0.7, ..style.vector }
            };
            let (name, class) =
                (format!("vector-{}", v.key), if v.absolute { "absolute" } else { "part" });
            let owner = self.d.vector(
                &name,
                class,
                Shape::Arrow { from, to, stroke, head: style.head },
                v.shown.clone(),
            );
            // Near its tip, where the vectors of one point are farthest apart.
            let request = LabelRequest::along(
                Label::math(&v.symbol),
                style.label_mm,
                from + v.mm * 0.5,
                to,
                stroke.width_mm / 2.0,
            );
            self.d.label(&name, class, request.owned(owner));
        }
    }
}
