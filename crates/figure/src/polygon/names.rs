//! The names in a polygon: letters of points and names of vectors.
//!
//! This module decides which names share a place, and the sign between them. Two points that
//! coincide within the precision of the paper share their letters in the polygon, and are separate
//! in an inset that separates them.

use hodograph_base::geom::Point;
use hodograph_board::construct::{Edge, PolygonMark};
use hodograph_board::plan::text::PlanWriter;
use hodograph_board::plan::{Term, VertexId};
use hodograph_paper::paper::drawing::Drawing;
use hodograph_paper::paper::item::LineStroke;
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::shown::{ShownLength, ShownQuantity as Quantity};
use hodograph_paper::paper::style::Style;
use hodograph_report::construction::mark as mark_name;
use hodograph_scene::DiagramKind;

use super::marks;
use super::{LABEL_ROOM_MM, PolygonArrow, PolygonDraft, covers, is_one};

/// The name of a vector on paper and for programs.
#[derive(Clone)]
pub(super) struct VectorName {
    /// The name on paper, in the notation of the figure.
    pub symbol: String,
    /// The name in ids.
    pub key: String,
    /// The name in questions.
    pub quantity: String,
}

impl PartialEq for VectorName {
    /// One vector has one key, independent of the notation.
    fn eq(&self, other: &VectorName) -> bool {
        self.key == other.key
    }
}

impl VectorName {
    /// The name of a vector from the pole.
    pub fn whole(w: &PlanWriter, on: DiagramKind, v: VertexId) -> VectorName {
        VectorName {
            symbol: w.vector(on, v),
            key: w.vector_key(v),
            quantity: w.vector_quantity(on, v),
        }
    }

    /// The name of terms drawn as one.
    pub fn sum(w: &PlanWriter, on: DiagramKind, terms: &[Term]) -> VectorName {
        let all = |of: &dyn Fn(&Term) -> String, sign: &str| {
            terms.iter().map(of).collect::<Vec<_>>().join(sign)
        };
        VectorName {
            symbol: all(&|t| w.symbol(on, t), " + "),
            key: all(&|t| w.key(on, t), "-and-"),
            quantity: all(&|t| w.quantity(on, t), "+"),
        }
    }
}

/// A point to be marked.
pub(super) struct PointLetter {
    /// The position.
    pub at: Point,
    /// The letter.
    pub name: String,
    /// The key of its mark.
    pub key: String,
    step: usize,
}

/// All points that coincide in a drawing.
pub(super) struct LetterSpot<'a> {
    /// The position of the first one.
    pub at: Point,
    /// The letters.
    pub names: Vec<&'a str>,
    /// The keys.
    pub keys: Vec<&'a str>,
    step: usize,
}

impl LetterSpot<'_> {
    /// Returns the class of the spot, with the step that marks it; the first spot of a polygon is
    /// the pole.
    pub fn class(&self, index: usize) -> String {
        if index == 0 { "pole".to_owned() } else { format!("point step-{}", self.step) }
    }
}

/// The place where a vector is shown.
pub(super) struct VectorPlace {
    /// The part that carries the name.
    pub ends: (Point, Point),
    /// The owner of the line.
    pub owner: u32,
    /// The point that the name stays away from.
    pub middle: Point,
    /// Empty in the polygon, `inset` in an inset.
    pub within: &'static str,
}

impl PolygonDraft<'_> {
    /// Marks a point, once.
    pub(super) fn letter(&mut self, at: Point, mark: PolygonMark, step: usize) {
        let (name, key) =
            (mark_name(self.w, self.p.on, &mark), marks::key(self.w, self.p.on, &mark));
        if !self.letters.iter().any(|l| l.name == name && is_one(l.at, at)) {
            self.letters.push(PointLetter { at, name, key, step });
        }
    }

    /// Returns the marked points; points closer than `one_mm` are joined.
    pub(super) fn letters(&self, one_mm: f64) -> Vec<LetterSpot<'_>> {
        let mut spots: Vec<LetterSpot> = Vec::new();
        for PointLetter { at, name, key, step } in &self.letters {
            match spots.iter_mut().find(|s| s.at.distance(*at) < one_mm) {
                Some(s) => {
                    s.names.push(name);
                    s.keys.push(key);
                }
                None => spots.push(LetterSpot {
                    at: *at,
                    names: vec![name],
                    keys: vec![key],
                    step: *step,
                }),
            }
        }
        spots
    }

    /// The start of the part of a vector that no shorter one covers: the place of its name.
    pub(super) fn own_part(&self, a: &PolygonArrow) -> Point {
        let (from, to) = a.drawn();
        let inside = |b: &(Point, Point)| {
            is_one(b.0, from) && covers((from, to), b.1) && b.1.distance(to) > LABEL_ROOM_MM
        };
        let far = self
            .arrows
            .iter()
            .map(PolygonArrow::drawn)
            .filter(inside)
            .max_by(|b, c| from.distance(b.1).total_cmp(&from.distance(c.1)));
        far.map_or(from, |b| b.1)
    }

    /// Requests a vector's name along a line that shows it; the name may be left out if both ends
    /// are lettered.
    pub(super) fn name(
        &self,
        d: &mut Drawing,
        style: &Style,
        a: &PolygonArrow,
        shown: VectorPlace,
    ) -> String {
        let VectorPlace { ends: (from, to), owner, middle, within } = shown;
        let lettered = |p: Point| self.letters.iter().any(|l| is_one(l.at, p));
        let request = LabelRequest::along(
            Label::math(a.name()),
            style.label_mm,
            from,
            to,
            style.vector.width_mm / 2.0,
        );
        let outward = (from + (to - from) * 0.5) - middle;
        let request =
            request.owned(owner).towards(outward).optional(lettered(a.from) && lettered(a.to));
        let (key, class) = (a.key(), format!("{within} {}", a.classes()));
        d.label(
            &if within.is_empty() { key.to_owned() } else { format!("{within}-{key}") },
            class.trim_start(),
            request,
        )
    }
}

impl PolygonDraft<'_> {
    /// The class of a vector in a figure.
    pub(super) fn class_of(&self, edge: &Edge) -> &'static str {
        match (edge.known, edge.terms.iter().any(|t| self.w.plan.vertex(t.of).trial.is_some())) {
            (true, false) => "edge known",
            (false, false) => "edge unknown",
            (true, true) => "edge known trial",
            (false, true) => "edge unknown trial",
        }
    }
}

impl PolygonArrow {
    /// Returns true for a vector that only trial polygons contain.
    pub(super) fn is_tried(&self) -> bool {
        self.class.ends_with("trial")
    }

    /// The stroke of the vector; thin in a trial polygon.
    pub(super) fn stroke(&self, style: &Style) -> LineStroke {
        if self.is_tried() {
            LineStroke { width_mm: style.thin.width_mm, ..style.vector }
        } else {
            style.vector
        }
    }

    /// The key: that of the first name.
    pub(super) fn key(&self) -> &str {
        &self.symbols[0].key
    }

    /// The quantity of the vector, drawn `times` as large as in the polygon, which has the scale
    /// `mu`.
    pub(super) fn shown(&self, mu: f64, times: f64) -> Quantity {
        let mm = self.from.distance(self.to);
        let names = self.symbols.iter().map(|n| n.quantity.clone()).collect();
        Quantity { names, length: Some(ShownLength { mm: mm * times, si: mm * mu }) }
    }

    /// The names: one sign between names of the same vector, another one before those that coincide
    /// only within the precision of the paper.
    pub(super) fn name(&self) -> String {
        // A normal component that is the total vector has the name of the total vector, if there is
        // one.
        let symbols = || self.symbols.iter().map(|n| n.symbol.as_str());
        let whole = symbols().any(|s| !s.contains("^{n}"));
        let names: Vec<&str> = symbols().filter(|s| !whole || !s.contains("^{n}")).collect();
        let nearly = self.nearly.iter().map(|n| format!(" \\approx {}", n.symbol));
        names.join(" = ") + &nearly.collect::<String>()
    }
}
