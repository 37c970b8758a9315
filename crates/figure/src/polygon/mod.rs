//! Draws a velocity or acceleration polygon from the actions of the drawing board.
//!
//! This module decides which vectors are drawn, each only once, which are thin, and how points and
//! vectors are marked. [`inset`] enlarges vectors too small for their names, [`key`] lists names
//! that find no place, [`aside`] draws overlapping vectors side by side, [`circles`] draws the images
//! of rolling circles, [`names`] writes the names, [`mod@plates`] splits a polygon of many vectors.
//! The positions are those of the board. Every item carries the class `step-N`, the index of the action that draws it, so that
//! a lesson can show the growing polygon.

pub(crate) mod aside;
mod circles;
mod inset;
mod key;
mod marks;
mod names;
mod plates;

use hodograph_base::geom::{Point, Vec2};
use hodograph_board::construct::{Action, Polygon, PolygonMark};
use hodograph_board::plan::text::PlanWriter;
use hodograph_board::plan::{
    PlanStep, Term, TermConnection, TermKind, TurningBody, VertexId, VertexPlace,
};

use hodograph_paper::paper::drawing::{Drawing, DrawingPart};
use hodograph_paper::paper::item::{Colour, Shape};
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::symbols as sym;
use inset::Inset;
pub use marks::mark_id;
use marks::{marks, shown_by};
use names::{PointLetter, VectorName, VectorPlace};
pub use plates::{GroupPlate, Share, is_full_share, plates, share_drawing, shares};

/// Below this length a vector has neither a visible head nor a visible direction: it is a dot with
/// a note that says zero.
const ZERO_MM: f64 = 0.05;
/// A vector this much shorter than the longest is a rounding error, not a small vector.
const ROUNDING: f64 = 1e-11;
/// Two ends closer than half a line width are one point on paper.
const SAME_MM: f64 = 0.1;
/// Extension of a construction line beyond its intersection: visible past an arrowhead's barbs.
const BEYOND_MM: f64 = 4.0;
/// A shorter part of a vector has no space for a name.
const LABEL_ROOM_MM: f64 = 5.0;

/// A vector to be drawn, with all its names.
struct PolygonArrow {
    from: Point,
    to: Point,
    /// All names; the last one is that of a total vector, if it is one.
    symbols: Vec<VectorName>,
    /// Names of vectors that coincide with it only within the precision of the paper.
    nearly: Vec<VectorName>,
    class: &'static str,
    /// The actions that draw it; two vectors at one place are one arrow.
    steps: Vec<usize>,
    /// The link of which it shows the motion.
    link: Option<usize>,
    /// Black; grey for a vector from which a plate only starts.
    colour: Colour,
    /// The displacement from its true place.
    aside: Vec2,
}

/// A vector of zero length: its place, its key, its note, the step.
struct Zero {
    at: Point,
    key: String,
    note: String,
    step: usize,
}

struct PolygonDraft<'a> {
    w: &'a PlanWriter<'a>,
    p: &'a Polygon,
    arrows: Vec<PolygonArrow>,
    letters: Vec<PointLetter>,
    zeros: Vec<Zero>,
    lines: Vec<(Point, Point, usize)>,
    copies: Vec<([VertexId; 3], usize)>,
    /// The arrows with names in the key.
    listed: Vec<usize>,
    /// Differences between numbers of this polygon up to this (mm) are rounding errors.
    rounding_mm: f64,
}

/// Above this number of arrows, vectors from the pole that nothing requests are left out, and the
/// names become smaller.
const MANY_ARROWS: usize = 16;

/// Draws a polygon with its pole at the origin. A cluster too small for its names gets an inset; a
/// polygon of many leader lines, a key, unless the drawing is then wider than `width_mm`.
pub fn polygon(style: &Style, w: &PlanWriter, p: &Polygon, width_mm: f64) -> DrawingPart {
    named(style, w, p, Some(width_mm))
}

/// Draws a polygon for a series that shows it step by step: without a key, which would take the
/// space of the drawing, unless it has too many vectors for anything else.
pub fn polygon_of_steps(style: &Style, w: &PlanWriter, p: &Polygon) -> DrawingPart {
    named(style, w, p, None)
}

/// Draws a polygon with all names; a key is allowed in a drawing of at most this width.
fn named(style: &Style, w: &PlanWriter, p: &Polygon, key_mm: Option<f64>) -> DrawingPart {
    let (mut draft, style) = PolygonDraft::new(style, w, p, false);
    draft.side_by_side(style.vector.width_mm);
    let finished = |mut drawing: Drawing| {
        marks(w, p).iter().for_each(|(mark, at)| {
            drawing.mark(&marks::key(w, p.on, mark), shown_by(w, p.on, mark), *at)
        });
        drawing.finish()
    };
    if style.memory.is_some() {
        // In a series, insets and keys would appear and disappear from figure to figure.
        return finished(draft.draw(&style, &[]).0);
    }
    draft.named(&style, key_mm, &finished)
}

/// Draws a polygon without insets and before its labels are placed, for series of drawings: with
/// `full` ([`is_full`] for any of the series) all are lettered alike.
pub fn drawing(style: &Style, w: &PlanWriter, p: &Polygon, full: bool) -> Drawing {
    let (draft, style) = PolygonDraft::new(style, w, p, full);
    draft.draw(&style, &[]).0
}

/// Returns true if a polygon has so many vectors that only some are named, in smaller type.
pub fn is_full(w: &PlanWriter, p: &Polygon) -> bool {
    PolygonDraft::of(w, p).arrows.len() > MANY_ARROWS
}

impl<'a> PolygonDraft<'a> {
    /// The elements of a polygon.
    fn of(w: &'a PlanWriter<'a>, p: &'a Polygon) -> PolygonDraft<'a> {
        let rounding_mm = ROUNDING * p.largest() / p.mu;
        let mut draft = PolygonDraft {
            w,
            p,
            arrows: vec![],
            letters: vec![],
            zeros: vec![],
            lines: vec![],
            copies: vec![],
            listed: vec![],
            rounding_mm,
        };
        draft.letter(Point::ORIGIN, PolygonMark::Pole, 0);
        draft.follow();
        draft
    }

    /// The elements of a polygon that are drawn, and the style that suits their number.
    fn new(
        style: &Style,
        w: &'a PlanWriter<'a>,
        p: &'a Polygon,
        full: bool,
    ) -> (PolygonDraft<'a>, Style) {
        let mut draft = PolygonDraft::of(w, p);
        let mut style = style.clone();
        if full || draft.arrows.len() > MANY_ARROWS {
            let needed = draft.needed();
            draft.arrows.retain(|a| {
                a.class != "absolute"
                    || a.symbols.iter().chain(&a.nearly).any(|n| needed.contains(&n.symbol))
            });
            style.label_mm = style.small_mm;
        }
        (draft, style)
    }
}

impl PolygonDraft<'_> {
    /// Symbols of the vectors from the pole that a question requests or that an equation starts
    /// with.
    fn needed(&self) -> Vec<String> {
        let (w, on) = (self.w, self.p.on);
        let asked = w.scene.find.iter().filter(|f| f.what.diagram() == on).filter_map(|f| {
            let p = f.what.meaning(w.scene)?.vector_of()?;
            w.plan.find_vertex(w.scene, p.point, p.link)
        });
        let steps =
            w.plan.steps(on).iter().flat_map(|g| g.alternatives.iter().flatten().chain(&g.further));
        let starts = steps.flat_map(PlanStep::chains).map(|c| c.start);
        asked.chain(starts).map(|v| w.vector(on, v)).collect()
    }

    /// Follows the actions of the board.
    fn follow(&mut self) {
        let p = self.p;
        let mut open: Vec<(Point, Vec2, usize)> = Vec::new();
        for (step, action) in p.actions.iter().enumerate() {
            match action {
                Action::LayOff(e) => self.edge(*e, step),
                Action::Line { through, direction, .. } => open.push((*through, *direction, step)),
                Action::Cross { target, edges, .. } => {
                    for ((through, direction, at), e) in open.drain(..).zip(edges) {
                        let end = p.edges[*e].to.1;
                        // For zero length the direction itself is shown, both ways.
                        let along =
                            (end - through).unit().filter(|_| end.distance(through) > ZERO_MM);
                        let (from, out) = along
                            .map_or((through - direction * BEYOND_MM, direction), |u| (through, u));
                        self.lines.push((from, end + out * BEYOND_MM, at));
                        self.edge(*e, step);
                    }
                    self.image(*target, step);
                }
                Action::Nothing { terms, at, target } => {
                    let symbols = terms.iter().map(|t| format!("{} = ", self.w.symbol(p.on, t)));
                    let note = format!("{}0", symbols.collect::<String>());
                    self.zeros.push(Zero {
                        at: *at,
                        key: VectorName::sum(self.w, p.on, terms).key,
                        note,
                        step,
                    });
                    target.iter().for_each(|v| self.image(*v, step));
                }
                Action::Trials { target, lines, .. } => {
                    self.image(*target, step);
                    let Some(at) = p.images[target.0] else { continue };
                    for (through, direction) in lines {
                        let out = (at - *through).unit().unwrap_or(*direction);
                        self.lines.push((*through, at + out * BEYOND_MM, step));
                    }
                }
                Action::Reach(v) | Action::Same { target: v, .. } => self.image(*v, step),
                Action::Copy { target, from } => {
                    self.image(*target, step);
                    self.copies.push(([from.0, from.1, *target], step));
                }
                Action::Join(e) => self.edge(*e, step),
                Action::Perpendicular { edges, direction } => {
                    // The line to which the perpendicular is dropped is extended beyond its foot.
                    let [along, _] = edges.map(|e| &p.edges[e]);
                    let out = (along.to.1 - along.from.1).unit().unwrap_or(*direction);
                    self.lines.push((along.from.1, along.to.1 + out * BEYOND_MM, step));
                    edges.iter().for_each(|e| self.edge(*e, step));
                }
                Action::Rate(_) => {}
            }
        }
    }

    fn edge(&mut self, index: usize, step: usize) {
        let edge = &self.p.edges[index];
        let name = VectorName::sum(self.w, self.p.on, &edge.terms);
        if edge.from.1.distance(edge.to.1) < ZERO_MM {
            let sign = self.zero_sign(edge.from.1.distance(edge.to.1));
            let note = format!("{} {sign} 0", name.symbol);
            self.zeros.push(Zero { at: edge.to.1, key: name.key, note, step });
        } else {
            let link = edge.terms.first().and_then(|t| self.link_of_term(t));
            self.arrow((edge.from.1, edge.to.1), name, self.class_of(edge), step, link);
        }
        match edge.to.0 {
            PolygonMark::Image(v) if edge.known => self.image(v, step),
            PolygonMark::Part(t) | PolygonMark::Again(t)
                if matches!(
                    t.kind,
                    TermKind::Normal | TermKind::SlideNormal | TermKind::Coriolis
                ) && edge.from.1.distance(edge.to.1) >= ZERO_MM =>
            {
                self.letter(edge.to.1, edge.to.0, step);
            }
            PolygonMark::Pole
            | PolygonMark::Image(_)
            | PolygonMark::Part(_)
            | PolygonMark::Again(_) => {}
        }
    }

    /// The link of which the rotation or sliding produces a vector.
    fn link_of_term(&self, term: &Term) -> Option<usize> {
        let scene = self.w.scene;
        match term.by {
            TermConnection::Turning(TurningBody::Link(l)) => Some(l.0),
            TermConnection::Turning(TurningBody::Cylinder(d)) | TermConnection::Cylinder(d) => {
                scene.drivers[d].kind.parts().first().map(|l| l.0)
            }
            TermConnection::Guide { guide, .. } => {
                let g = &scene.guides[guide.0];
                if g.on == scene.ground { g.slider.map(|l| l.0) } else { Some(g.on.0) }
            }
            TermConnection::Contact(_) => self.w.plan.vertex(term.of).on.map(|l| l.0),
            TermConnection::Frame { body: Some(TurningBody::Link(l)), .. } => Some(l.0),
            TermConnection::Frame { .. } | TermConnection::Apart => None,
        }
    }

    fn arrow(
        &mut self,
        (from, to): (Point, Point),
        name: VectorName,
        class: &'static str,
        step: usize,
        link: Option<usize>,
    ) {
        let rounding = self.rounding_mm;
        let same = |a: &&mut PolygonArrow| is_one(a.from, from) && is_one(a.to, to);
        match self.arrows.iter_mut().find(same) {
            Some(a) => {
                if !a.symbols.contains(&name) && !a.nearly.contains(&name) {
                    let exact = (to - from - (a.to - a.from)).norm() <= rounding;
                    if exact { &mut a.symbols } else { &mut a.nearly }.push(name);
                }
                if !a.steps.contains(&step) {
                    a.steps.push(step);
                }
                if a.is_tried() {
                    a.class = class;
                }
            }
            None => self.arrows.push(PolygonArrow {
                from,
                to,
                symbols: vec![name],
                nearly: vec![],
                class,
                steps: vec![step],
                link,
                colour: Colour::BLACK,
                aside: Vec2::ZERO,
            }),
        }
    }

    /// Marks an image point and draws its vector from the pole, if it is not there already.
    fn image(&mut self, v: VertexId, step: usize) {
        let vertex = self.w.plan.vertex(v);
        let Some(at) = self.p.images[v.0] else { return };
        if vertex.fixed {
            return;
        }
        self.letter(at, PolygonMark::Image(v), step);
        // The special point belongs to the construction: its vector answers no question.
        if matches!(vertex.spot, VertexPlace::Special(_)) || vertex.trial.is_some() {
            return;
        }
        let name = VectorName::whole(self.w, self.p.on, v);
        if at.distance(Point::ORIGIN) >= ZERO_MM {
            self.arrow(
                (Point::ORIGIN, at),
                name,
                "absolute",
                step,
                self.w.plan.vertex(v).link(self.w.scene).map(|l| l.0),
            );
        } else if !self.zeros.iter().any(|zero| zero.note.starts_with(&name.symbol)) {
            let sign = self.zero_sign(at.to_vec2().norm());
            let note = format!("{} {sign} 0", name.symbol);
            self.zeros.push(Zero { at, key: name.key, note, step });
        }
    }

    /// The sign before zero for a vector too short to be drawn: `=` within rounding, otherwise `≈`.
    fn zero_sign(&self, length_mm: f64) -> &'static str {
        if length_mm <= self.rounding_mm { "=" } else { "\\approx" }
    }

    /// Draws everything, and returns for each arrow the name of its label. Names in an inset are
    /// not repeated in the polygon.
    fn draw(&self, style: &Style, insets: &[Inset]) -> (Drawing, Vec<String>) {
        let kind = self.p.on.word();
        let mut d = Drawing::new(kind, style.clone());
        let middle = middle(self.letters.iter().map(|l| l.at));
        for (from, to, step) in &self.lines {
            d.shape(
                "line",
                &format!("construction step-{step}"),
                Shape::Line { from: *from, to: *to, stroke: style.thin },
            );
        }
        self.circles(&mut d, style);
        let mut drawn: Vec<(Point, Point)> = self.arrows.iter().map(|a| (a.from, a.to)).collect();
        for ([a, b, c], step) in &self.copies {
            let corners = [*a, *b, *c].map(|v| self.p.images[v.0]);
            let [Some(a), Some(b), Some(c)] = corners else { continue };
            for (from, to) in [(a, b), (b, c), (a, c)] {
                if from.distance(to) > SAME_MM
                    && !drawn.iter().any(|s| covers(*s, from) && covers(*s, to))
                {
                    d.shape(
                        "image",
                        &format!("image step-{step}"),
                        Shape::Line { from, to, stroke: style.thin },
                    );
                    drawn.push((from, to));
                }
            }
        }
        // Small vectors last, so that their heads are over the large ones.
        let mut order: Vec<usize> = (0..self.arrows.len()).collect();
        let length = |k: usize| self.arrows[k].from.distance(self.arrows[k].to);
        order.sort_by(|&a, &b| length(b).total_cmp(&length(a)));
        let mut names = vec![String::new(); self.arrows.len()];
        for k in order {
            let a = &self.arrows[k];
            d.of_link(a.link);
            let (from, to) = a.drawn();
            let shape = Shape::Arrow {
                from,
                to,
                stroke: a.stroke(style).coloured(a.colour),
                head: style.head,
            };
            let owner = d.vector(a.key(), &a.classes(), shape, a.shown(self.p.mu, 1.0));
            for (from, to) in a.joins() {
                let class = a.classes().replacen(a.class, "aside", 1);
                d.shape(
                    &format!("aside-{}", a.key()),
                    &class,
                    Shape::Line { from, to, stroke: style.thin.coloured(a.colour) },
                );
            }
            if !self.listed.contains(&k) && !insets.iter().any(|i| i.arrows.contains(&k)) {
                names[k] = self.name(
                    &mut d,
                    style,
                    a,
                    VectorPlace { ends: (self.own_part(a), to), owner, middle, within: "" },
                );
            }
        }
        d.of_link(None);
        // If all vectors are zero, the caption says so.
        let zeros = if self.p.is_empty() { &[][..] } else { &self.zeros };
        for Zero { at, key, note, step } in zeros {
            let class = format!("zero step-{step}");
            d.draw(&format!("zero-{key}"), &class, sym::dot(style, *at));
            d.label_at(&format!("zero-{key}"), &class, note, *at, style.dot_radius_mm, None);
        }
        for (k, l) in self.letters(SAME_MM).iter().enumerate() {
            let clear = if k == 0 { style.dot_radius_mm } else { 0.3 };
            if k == 0 {
                d.draw("pole", "pole", sym::dot(style, l.at));
            }
            if k == 0 || !insets.iter().any(|i| i.has_alone(self, l.at)) {
                d.label_at(
                    &format!("mark-{}", l.keys[0]),
                    &l.class(k),
                    &l.names.join(", "),
                    l.at,
                    clear,
                    (l.at - middle).unit(),
                );
            }
        }
        for inset in insets {
            self.inset(&mut d, style, inset);
        }
        (d, names)
    }
}

impl PolygonArrow {
    /// The class of the vector, with the steps that draw it.
    fn classes(&self) -> String {
        self.steps.iter().fold(self.class.to_owned(), |class, step| format!("{class} step-{step}"))
    }
}

fn middle(points: impl Iterator<Item = Point> + Clone) -> Point {
    let n = points.clone().count().max(1) as f64;
    points.fold(Point::ORIGIN, |m, p| m + p.to_vec2() * (1.0 / n))
}

/// True if two ends are one point on paper.
fn is_one(p: Point, q: Point) -> bool {
    // Most are far apart, which needs no square root to detect.
    (p.x - q.x).abs() < SAME_MM && (p.y - q.y).abs() < SAME_MM && p.distance(q) < SAME_MM
}

/// True if a point is on a segment.
fn covers((a, b): (Point, Point), p: Point) -> bool {
    let apart = |p: f64, a: f64, b: f64| p < a.min(b) - SAME_MM || p > a.max(b) + SAME_MM;
    if apart(p.x, a.x, b.x) || apart(p.y, a.y, b.y) {
        return false;
    }
    let d = b - a;
    let off = d.cross(p - a);
    if off * off > SAME_MM * SAME_MM * d.norm2() {
        return false;
    }
    let t = ((p - a).dot(d) / d.norm2()).clamp(0.0, 1.0);
    p.distance(a + d * t) < SAME_MM
}

#[cfg(test)]
mod tests {
    use super::*;
    use hodograph_base::notation::Notation;
    use hodograph_scene::{DiagramKind, Lang, read, templates};
    use hodograph_worked::worked::{Scope, work};

    fn drawn(name: &str, on: DiagramKind) -> Vec<(String, Shape)> {
        drawn_of(templates::get(name).unwrap(), on)
    }

    fn drawn_of(text: &str, on: DiagramKind) -> Vec<(String, Shape)> {
        let scene = read(text).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let notation = Notation::of_language(Lang::En);
        let w =
            PlanWriter { scene: &scene, plan: &worked.plan, notation: &notation, lang: Lang::En };
        let drawn = worked.construction.polygon(on).unwrap();
        let part = polygon(&Style::default(), &w, drawn, f64::INFINITY);
        part.items.into_iter().map(|i| (i.id, i.shape)).collect()
    }

    fn arrows(items: &[(String, Shape)]) -> Vec<&str> {
        items
            .iter()
            .filter(|(_, s)| matches!(s, Shape::Arrow { .. }))
            .map(|(id, _)| id.as_str())
            .collect()
    }

    #[test]
    fn a_vector_that_is_an_edge_is_drawn_once() {
        let mut names = drawn("offset-slider-crank", DiagramKind::Velocity);
        names.sort_by(|a, b| a.0.cmp(&b.0));
        // v_B and v_C are edges from the pole; v_S is found as an image point and has its arrow
        // from the pole.
        assert_eq!(arrows(&names), ["vel-abs-B", "vel-abs-C", "vel-abs-S", "vel-rel-C-B"]);
    }

    #[test]
    fn vectors_of_no_length_are_noted() {
        let items = drawn("parallelogram", DiagramKind::Velocity);
        let note =
            |s: &Shape| matches!(s, Shape::Label { label, .. } if label.source() == "v_{CB} = 0");
        assert!(items.iter().any(|(_, s)| note(s)));
        assert!(!arrows(&items).iter().any(|a| a.contains("C-B")));
        let dots = items.iter().filter(|(id, _)| id.starts_with("vel-zero")).count();
        assert_eq!(dots, 1);
    }

    #[test]
    fn a_mechanism_at_rest_has_its_pole_and_nothing_else() {
        let still = templates::instantiate("crank-rocker", &[("omega_1", "0 rad/s")]).unwrap();
        for (on, letters) in
            [(DiagramKind::Velocity, "o, b, c, e"), (DiagramKind::Acceleration, "o', b', c', e'")]
        {
            let items = drawn_of(&still, on);
            let labels: Vec<&str> = items
                .iter()
                .filter_map(|(_, s)| {
                    if let Shape::Label { label, .. } = s { Some(label.source()) } else { None }
                })
                .collect();
            assert_eq!(labels, [letters]);
            assert!(arrows(&items).is_empty());
        }
    }

    #[test]
    fn three_points_of_a_link_show_their_image() {
        let items = drawn("crank-rocker", DiagramKind::Velocity);
        // b–c is already an edge: the triangle needs two more lines.
        assert_eq!(items.iter().filter(|(id, _)| id.starts_with("vel-image")).count(), 2);
    }

    /// In place of leader lines, a crowded polygon lists vectors by the letters at their ends; one
    /// with space for its names, one that grows step by step, and one for a narrow page have no list.
    #[test]
    fn a_crowded_polygon_has_a_key() {
        let of = |name: &str, draw: fn(&Style, &PlanWriter, &Polygon) -> DrawingPart| {
            let scene = read(templates::get(name).unwrap()).unwrap().value;
            let worked = work(&scene, Scope::Figure).unwrap().value;
            let (notation, lang) = (Notation::of_language(Lang::En), Lang::En);
            let w = PlanWriter { scene: &scene, plan: &worked.plan, notation: &notation, lang };
            let p = worked.construction.polygon(DiagramKind::Acceleration).unwrap();
            let part = draw(&Style::default(), &w, p);
            let is_key = |id: &str| id.starts_with("acc-key-");
            let led = |id: &str| id.ends_with("-leader") && !id.contains("label-mark");
            let texts = part.items.iter().filter(|i| is_key(&i.id)).map(|i| match &i.shape {
                Shape::Label { label, .. } => label.source().to_owned(),
                _ => String::new(),
            });
            (texts.collect::<Vec<_>>(), part.items.iter().filter(|i| led(&i.id)).count())
        };
        fn wide(style: &Style, w: &PlanWriter, p: &Polygon) -> DrawingPart {
            polygon(style, w, p, f64::INFINITY)
        }
        fn narrow(style: &Style, w: &PlanWriter, p: &Polygon) -> DrawingPart {
            polygon(style, w, p, 50.0)
        }
        let (key, leaders) = of("stephenson-six-bar", wide);
        assert!(key.iter().any(|text| text == r"a_{H}:\quad o'h'"), "{key:?}");
        assert!(leaders < key::LEADERS, "{leaders}");
        for keyless in [polygon_of_steps, narrow] {
            let (none, leaders) = of("stephenson-six-bar", keyless);
            assert!(none.is_empty() && leaders >= key::LEADERS, "{none:?} {leaders}");
        }
        assert_eq!(of("shaper", wide).0, Vec::<String>::new());
    }
}
