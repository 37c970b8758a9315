//! Motions without a mechanism: the course of a pursuit with its lines of sight, velocities and accelerations at the instant; a plate that turns in space in
//! two views, square to it and along its axis, with the parts of velocity and acceleration at the point.
//!
//! What is drawn comes from [`hodograph_methods::particle::board`]; decided here are scales of the course, captions and where the parts stand.

mod chase;
mod plate;

use hodograph_base::diag::{Both, Diagnostic};
use hodograph_base::geom::Point;
use hodograph_base::notation::Notation;
use hodograph_methods::particle::board::{Arrow, Drawn, Views};
use hodograph_methods::particle::{Problem, Solved};
use hodograph_paper::paper::phrase::Phrase;
use hodograph_report::amount::scale_formula;
use hodograph_report::answers::DIGITS;
use hodograph_report::particle as report;
use hodograph_scene::{Book, DiagramKind, Lang};

use super::arrange::Tree;
use super::sheet::MARGIN_MM;
use hodograph_paper::paper::drawing::{Drawing, Part};
use hodograph_paper::paper::grid::{self, Cell, Row};
use hodograph_paper::paper::item::{Anchor, Colour, Figure, Item, Shape, Stroke, distinct};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::lines::wrapped;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::shown::Shown;
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::symbols as sym;
use hodograph_paper::paper::words::words;

/// Width of the text below.
const TEXT_MM: f64 = 165.0;
/// Below a drawing: its caption, then its scale.
const CAPTION_MM: f64 = 6.0;
const SCALE_MM: f64 = 5.6;

/// What all drawings need.
pub struct Maker<'a> {
    /// The file.
    pub problem: &'a Problem,
    /// Its answers: how a pursuit ends.
    pub solved: &'a Solved,
    /// Weights, sizes and fonts.
    pub style: &'a Style,
    /// The language of marks.
    pub lang: Lang,
    /// Places for which the two views of a plate leave room, beside what is drawn: of other instants.
    pub also: &'a [Vec<Point>; 2],
}

/// No places beside what is drawn.
pub const ALONE: [Vec<Point>; 2] = [Vec::new(), Vec::new()];

/// A view of a motion, in coordinates of its own.
pub struct View {
    /// What is drawn; what a step of the construction brings has its number in its class (`step-2`).
    pub part: Part,
    /// Its caption.
    pub caption: Both,
    /// Its scales.
    pub scales: Vec<(DiagramKind, f64)>,
}

impl View {
    /// The scales in a line, in the label language.
    pub fn scale(&self, book: &Book) -> String {
        let told: Vec<String> = self.scales.iter().map(|(on, mu)| scale_formula(book, *on, *mu)).collect();
        told.join(",\\quad ")
    }
}

/// The figures, one for each motion that has something to draw, each with the word that names its file.
///
/// # Errors
/// Laws without a value on the way.
pub fn figures(
    problem: &Problem,
    solved: &Solved,
    board: &[Drawn],
    style: &Style,
    lang: Lang,
) -> Result<Vec<(String, Figure)>, Diagnostic> {
    let maker = Maker { problem, solved, style, lang, also: &ALONE };
    let name = |d: &Drawn| if board.len() == 1 { String::new() } else { problem.motions[d.motion].point.clone() };
    board.iter().map(|d| Ok((name(d), maker.figure(d, true)?))).collect()
}

/// The figure of one motion without title and answers, for documents.
///
/// # Errors
/// Laws without a value on the way.
pub fn within_text(problem: &Problem, solved: &Solved, drawn: &Drawn, style: &Style, lang: Lang) -> Result<Figure, Diagnostic> {
    Maker { problem, solved, style, lang, also: &ALONE }.figure(drawn, false)
}

/// The motion as a problem gives it: where a pursuit begins and how the target goes on, a plate in both views, without anything that is wanted.
///
/// # Errors
/// Laws without a value on the way.
pub fn as_given(problem: &Problem, solved: &Solved, drawn: &Drawn, style: &Style, lang: Lang) -> Result<Figure, Diagnostic> {
    let maker = Maker { problem, solved, style, lang, also: &ALONE };
    let views = match &drawn.views {
        Views::Chase { .. } => maker.start(drawn).into_iter().collect(),
        Views::Plate { .. } => vec![maker.on_plate(drawn, DiagramKind::Plane, &[])?, maker.along_axis(drawn, DiagramKind::Plane, &[])],
    };
    let mut parts: Vec<Part> = views.into_iter().map(|v| maker.captioned(v)).collect();
    let tree = Tree::row((0..parts.len()).map(Tree::Leaf).collect());
    let size = tree.size(&parts);
    let page = [size[0] + 2.0 * MARGIN_MM, size[1] + 2.0 * MARGIN_MM];
    tree.put(&mut parts, Point::new(MARGIN_MM, page[1] - MARGIN_MM));
    let mut items: Vec<Item> = parts.into_iter().flat_map(|p| p.items).collect();
    distinct(&mut items);
    let title = lang.of(&problem.title).to_owned();
    let tag = words(lang).tag.into();
    let mut figure = Figure { width_mm: page[0], height_mm: page[1], desc: title.clone(), title, lang: tag, paper: Colour::WHITE, items };
    style.palette.paint(&mut figure);
    Ok(figure)
}

/// The notation of a language with the marks of a style.
pub fn notation(style: &Style, lang: Lang) -> Notation {
    style.marks.over(&Notation::of_language(lang))
}

impl Maker<'_> {
    fn notation(&self) -> Notation {
        notation(self.style, self.lang)
    }

    fn lines(&self) -> Vec<Phrase> {
        report::lines(self.problem, self.solved, DIGITS, self.lang, &self.notation())
    }

    /// The views of a motion: the course, the velocities, the accelerations of a pursuit; of a plate both views with the velocities, then
    /// with the accelerations.
    ///
    /// # Errors
    /// Laws without a value on the way.
    pub fn views(&self, d: &Drawn) -> Result<Vec<View>, Diagnostic> {
        match &d.views {
            Views::Chase { .. } => Ok(self.course(d, true).into_iter().chain(self.polygons(d)).collect()),
            Views::Plate { velocities, accelerations, .. } => {
                let mut all = Vec::new();
                for (on, views) in [(DiagramKind::Velocity, velocities), (DiagramKind::Acceleration, accelerations)] {
                    all.extend([self.on_plate(d, on, &views[0])?, self.along_axis(d, on, &views[1])]);
                }
                Ok(all)
            }
        }
    }

    fn figure(&self, d: &Drawn, whole: bool) -> Result<Figure, Diagnostic> {
        let mut parts: Vec<Part> = self.views(d)?.into_iter().map(|v| self.captioned(v)).collect();
        // A pursuit: its course over the two polygons; a plate: both views in a row.
        let first = if matches!(d.views, Views::Chase { .. }) { 1 } else { 2 };
        let row = |range: std::ops::Range<usize>| Tree::row(range.map(Tree::Leaf).collect());
        let mut rows = vec![row(0..first), row(first..parts.len())];
        if whole {
            parts.push(self.text());
            rows.push(Tree::Leaf(parts.len() - 1));
        }
        let tree = Tree::column(rows);
        let size = tree.size(&parts);
        let head = if whole { 12.0 } else { 0.0 };
        let page = [size[0] + 2.0 * MARGIN_MM, size[1] + 2.0 * MARGIN_MM + head];
        tree.put(&mut parts, Point::new(MARGIN_MM, page[1] - MARGIN_MM - head));
        let mut items: Vec<Item> = parts.into_iter().flat_map(|p| p.items).collect();
        let title = self.lang.of(&self.problem.title).to_owned();
        if whole {
            items.push(self.words(
                "title",
                Point::new(page[0] / 2.0, page[1] - MARGIN_MM - 4.0),
                Label::text(title.as_str()),
                self.style.caption_mm * 1.15,
            ));
        }
        distinct(&mut items);
        let desc = self.lines().iter().map(|l| l.plain()).collect::<Vec<_>>().join("; ");
        let lang = words(self.lang).tag.into();
        let mut figure = Figure { width_mm: page[0], height_mm: page[1], title, desc, lang, paper: Colour::WHITE, items };
        self.style.palette.paint(&mut figure);
        Ok(figure)
    }

    fn words(&self, class: &str, at: Point, label: Label, size_mm: f64) -> Item {
        let label = label.in_fonts(&self.style.fonts);
        Item::new(class, Shape::Label { at, label, size_mm, anchor: Anchor::Middle, colour: Colour::BLACK })
    }

    /// A view with its caption, and its scales below.
    fn captioned(&self, view: View) -> Part {
        let scale = view.scale(&self.problem.book);
        let part = view.part;
        let (x, y) = (part.bounds.centre().x, part.bounds.min.y - CAPTION_MM);
        let mut items = part.items;
        let on = view.scales.last().map_or(DiagramKind::Plane, |(on, _)| *on);
        // Views of one kind, with the velocities and with the accelerations, are told apart.
        if on != DiagramKind::Plane {
            items.iter_mut().for_each(|i| i.id = format!("{}-{}", on.prefix(), i.id.trim_start_matches("polygon-")));
        }
        let caption = Phrase::new(self.lang.of(&view.caption)).label();
        let below = [("caption", y, caption, self.style.caption_mm), ("scale", y - SCALE_MM, Label::math(scale), self.style.small_mm)];
        items.extend(
            below.map(|(what, y, label, size)| self.words(what, Point::new(x, y), label, size).with_id(format!("{what}-{}", on.prefix()))),
        );
        Part::of(items)
    }

    fn text(&self) -> Part {
        let style = self.style;
        let lines = self.lines();
        let labels = lines.iter().flat_map(|l| wrapped(l, TEXT_MM, style.small_mm, &style.fonts));
        let row = |label: Label| Row {
            cells: vec![Some(Cell { label, size_mm: style.small_mm, anchor: Anchor::Start, class: "answer".into(), id: String::new() })],
            height_mm: style.small_mm * 1.6,
        };
        Part::of(grid::set(&labels.map(row).collect::<Vec<_>>(), 0.0))
    }

    /// Draws a vector to a scale (SI per mm); `on_plate` is the point of a plate whose motion it is.
    fn arrow(&self, d: &mut Drawing, a: &Arrow, mu: f64, on_plate: Option<&str>) {
        let style = self.style;
        let width_mm = if a.whole { style.vector.width_mm } else { style.vector.width_mm * 0.7 };
        if a.from.distance(a.to) <= 0.3 {
            return;
        }
        let stroke = Stroke { width_mm, ..style.vector };
        let class = format!("vector {}", step(a.step));
        let id = match on_plate {
            Some(_) => a.symbol.replace(['_', '^'], "-").replace('\'', "-seen"),
            None => a.symbol.replace(['_', '^'], "-"),
        };
        let arrow = Shape::Arrow { from: a.from, to: a.to, stroke, head: style.head };
        let owner = match quantity(&a.symbol, on_plate) {
            Some(name) => d.vector(&id, &class, arrow, Shown::vector(&name, a.from, a.to, mu)),
            None => d.shape(&id, &class, arrow),
        };
        let symbol = report::marked(&a.symbol, &self.notation());
        d.label(&id, &class, LabelRequest::along(Label::math(&symbol), style.label_mm, a.from, a.to, width_mm / 2.0).owned(owner));
    }

    /// Draws a line, whose class begins with its name.
    fn line(&self, d: &mut Drawing, class: &str, points: Vec<Point>, stroke: Stroke) {
        let name = class.split(' ').next().unwrap_or(class);
        d.shape(name, class, Shape::Polyline { points, closed: false, stroke: Some(stroke), fill: None });
    }

    fn named(&self, d: &mut Drawing, name: &str, at: Point) {
        d.draw(name, "point", sym::dot(self.style, at));
        d.label_at(name, "point", name, at, self.style.dot_radius_mm, None);
    }

    fn scales(&self, drawn: &Drawn, on: DiagramKind) -> Vec<(DiagramKind, f64)> {
        let shown = [DiagramKind::Plane, on];
        shown[usize::from(on == DiagramKind::Plane)..].iter().map(|on| (*on, drawn.scale(*on))).collect()
    }
}

/// The name of a vector as `find` writes it: `v_A` of a pursuit, `aen_M` of a point of a plate. A projection has none.
fn quantity(symbol: &str, on_plate: Option<&str>) -> Option<String> {
    let Some(point) = on_plate else { return Some(symbol.to_owned()) };
    let (letter, part) = symbol.split_once('_').filter(|_| !symbol.contains('\''))?;
    Some(format!("{letter}{}_{point}", part.replace('^', "")))
}

/// The word by which an item says which step brings it, counted from 0.
fn step(k: usize) -> String {
    format!("step-{k}")
}
