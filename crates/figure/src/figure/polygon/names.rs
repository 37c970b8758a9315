//! What is written at a polygon: the letters of its points and the names of its vectors.
//!
//! Decided here: which names share a place, and with which sign between them. Two points that only paper does not tell apart share
//! their letters in the polygon, and part in an inset that shows them apart.

use crate::geom::Point;
use crate::paper::drawing::Drawing;
use crate::paper::label::Label;
use crate::paper::place::LabelRequest;
use crate::paper::style::Style;

use super::{Arrow, Draft, LABEL_ROOM_MM, covers, is_one};

/// A point to be marked.
pub(super) struct Letter {
    /// Where it is.
    pub at: Point,
    name: String,
    step: usize,
}

/// All points that are one on a drawing.
pub(super) struct Spot<'a> {
    /// Where the first of them is.
    pub at: Point,
    /// Their letters.
    pub names: Vec<&'a str>,
    step: usize,
}

impl Spot<'_> {
    /// What it is, and the step that marks it; the first of a polygon is the pole.
    pub fn class(&self, index: usize) -> String {
        if index == 0 { "pole".to_owned() } else { format!("point step-{}", self.step) }
    }
}

/// Where a vector is shown.
pub(super) struct Shown {
    /// The part of it that bears its name.
    pub ends: (Point, Point),
    /// Whose line it is.
    pub owner: u32,
    /// What the name keeps away from.
    pub middle: Point,
    /// Nothing in the polygon, `inset` in an inset.
    pub within: &'static str,
}

impl Draft<'_> {
    /// Marks a point, once.
    pub(super) fn letter(&mut self, at: Point, name: String, step: usize) {
        if !self.letters.iter().any(|l| l.name == name && is_one(l.at, at)) {
            self.letters.push(Letter { at, name, step });
        }
    }

    /// The marked points, those together that are nearer than `one_mm`.
    pub(super) fn letters(&self, one_mm: f64) -> Vec<Spot<'_>> {
        let mut spots: Vec<Spot> = Vec::new();
        for Letter { at, name, step } in &self.letters {
            match spots.iter_mut().find(|s| s.at.distance(*at) < one_mm) {
                Some(s) => s.names.push(name),
                None => spots.push(Spot { at: *at, names: vec![name], step: *step }),
            }
        }
        spots
    }

    /// Where the part of a vector begins that no shorter one covers: there its name belongs.
    pub(super) fn own_part(&self, a: &Arrow) -> Point {
        let (from, to) = a.drawn();
        let inside = |b: &(Point, Point)| is_one(b.0, from) && covers((from, to), b.1) && b.1.distance(to) > LABEL_ROOM_MM;
        let far = self.arrows.iter().map(Arrow::drawn).filter(inside).max_by(|b, c| from.distance(b.1).total_cmp(&from.distance(c.1)));
        far.map_or(from, |b| b.1)
    }

    /// Asks for a vector's name along a line that shows it; it may be left out where both ends are lettered.
    pub(super) fn name(&self, d: &mut Drawing, style: &Style, a: &Arrow, shown: Shown) -> String {
        let Shown { ends: (from, to), owner, middle, within } = shown;
        let lettered = |p: Point| self.letters.iter().any(|l| is_one(l.at, p));
        let request = LabelRequest::along(Label::math(a.name()), style.label_mm, from, to, style.vector.width_mm / 2.0);
        let outward = (from + (to - from) * 0.5) - middle;
        let request = request.owned(owner).towards(outward).optional(lettered(a.from) && lettered(a.to));
        d.label(&a.symbols[0], format!("{within} {}", a.classes()).trim_start(), request)
    }
}

impl Arrow {
    /// Its names: one sign between those of one vector, another before those that only paper does not tell from it.
    fn name(&self) -> String {
        // A normal part that is all there is bears the name of the whole, where it has one.
        let whole = self.symbols.iter().any(|s| !s.contains("^{n}"));
        let names: Vec<&str> = self.symbols.iter().filter(|s| !whole || !s.contains("^{n}")).map(String::as_str).collect();
        let nearly = self.nearly.iter().map(|s| format!(" \\approx {s}"));
        names.join(" = ") + &nearly.collect::<String>()
    }
}
