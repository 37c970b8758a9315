//! Draws motions without a mechanism: the course of a pursuit with its lines of sight, velocities
//! and accelerations at the instant; and a plate that turns in space in two views, perpendicular to
//! it and along its axis, with the components of velocity and acceleration at the point.
//!
//! The content comes from [`hodograph_methods::particle::board`]; this module chooses the scales of
//! the course, the captions and the arrangement.

mod chase;
mod plate;

use hodograph_base::diag::{Both, Diagnostic};
use hodograph_base::geom::Point;
use hodograph_base::notation::Notation;
use hodograph_methods::particle::board::{Arrow, MotionDrawing, Views};
use hodograph_methods::particle::{ParticleProblem, ParticleSolution};
use hodograph_paper::paper::phrase::Phrase;
use hodograph_report::amount::scale_formula;
use hodograph_report::answers::DIGITS;
use hodograph_report::particle as report;
use hodograph_scene::{Book, DiagramKind, Lang};

use super::arrange::Tree;
use super::scales::DrawingScales;
use super::sheet::{MARGIN_MM, painted, titled};
use hodograph_paper::paper::drawing::{Drawing, DrawingPart};
use hodograph_paper::paper::grid::{self, Cell, Row};
use hodograph_paper::paper::item::{
    Anchor, Colour, Figure, FigureItem, LineStroke, Shape, distinct,
};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::lines::wrapped;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::shown::ShownQuantity;
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::symbols as sym;

/// Width of the text below.
const TEXT_MM: f64 = 165.0;

/// The data common to all drawings.
pub struct ParticleDrafter<'a> {
    /// The problem.
    pub problem: &'a ParticleProblem,
    /// The solution: the end of a pursuit.
    pub solved: &'a ParticleSolution,
    /// Line widths, sizes and fonts.
    pub style: &'a Style,
    /// The language of the notation.
    pub lang: Lang,
    /// Places of other instants for which the two views of a plate leave space.
    pub also: &'a [Vec<Point>; 2],
}

/// No additional places.
pub const ALONE: [Vec<Point>; 2] = [Vec::new(), Vec::new()];

/// A view of a motion, in its own coordinates.
pub struct ParticleView {
    /// The drawing; items that a step of the construction adds have its number in their class
    /// (`step-2`).
    pub part: DrawingPart,
    /// The caption.
    pub caption: Both,
    /// The scales.
    pub scales: Vec<(DiagramKind, f64)>,
}

impl ParticleView {
    /// Returns the scales in a line, in the label language.
    pub fn scale(&self, book: &Book) -> String {
        let told: Vec<String> =
            self.scales.iter().map(|(on, mu)| scale_formula(book, *on, *mu)).collect();
        told.join(",\\quad ")
    }

    /// Returns the scales with their graphic scales.
    pub(super) fn with_bars(&self, book: &Book) -> DrawingScales {
        let all = self.scales.iter().map(|(on, mu)| DrawingScales::of(book, *on, *mu));
        all.reduce(DrawingScales::and).unwrap_or_default()
    }
}

/// Draws the figures, one for each motion with anything to draw, each with the word for its file
/// name.
///
/// # Errors
/// A law without a value during the motion.
pub fn figures(
    problem: &ParticleProblem,
    solved: &ParticleSolution,
    board: &[MotionDrawing],
    style: &Style,
    lang: Lang,
) -> Result<Vec<(String, Figure)>, Diagnostic> {
    let maker = ParticleDrafter { problem, solved, style, lang, also: &ALONE };
    let name = |d: &MotionDrawing| {
        if board.len() == 1 { String::new() } else { problem.motions[d.motion].point.clone() }
    };
    board.iter().map(|d| Ok((name(d), maker.figure(d, true)?))).collect()
}

/// Draws the figure of one motion without title and answers, for documents.
///
/// # Errors
/// A law without a value during the motion.
pub fn within_text(
    problem: &ParticleProblem,
    solved: &ParticleSolution,
    drawn: &MotionDrawing,
    style: &Style,
    lang: Lang,
) -> Result<Figure, Diagnostic> {
    ParticleDrafter { problem, solved, style, lang, also: &ALONE }.figure(drawn, false)
}

/// Draws the motion as a problem gives it, without any unknowns: the start of a pursuit with the
/// path of the target, or a plate in both views.
///
/// # Errors
/// A law without a value during the motion.
pub fn as_given(
    problem: &ParticleProblem,
    solved: &ParticleSolution,
    drawn: &MotionDrawing,
    style: &Style,
    lang: Lang,
) -> Result<Figure, Diagnostic> {
    let maker = ParticleDrafter { problem, solved, style, lang, also: &ALONE };
    let views = match &drawn.views {
        Views::Chase { .. } => maker.start(drawn).into_iter().collect(),
        Views::Plate { .. } => vec![
            maker.on_plate(drawn, DiagramKind::Plane, &[])?,
            maker.along_axis(drawn, DiagramKind::Plane, &[]),
        ],
    };
    let mut parts: Vec<DrawingPart> = views.into_iter().map(|v| maker.captioned(v)).collect();
    let tree = Tree::row((0..parts.len()).map(Tree::Leaf).collect());
    let size = tree.size(&parts);
    let page = [size[0] + 2.0 * MARGIN_MM, size[1] + 2.0 * MARGIN_MM];
    tree.put(&mut parts, Point::new(MARGIN_MM, page[1] - MARGIN_MM));
    let mut items: Vec<FigureItem> = parts.into_iter().flat_map(|p| p.items).collect();
    distinct(&mut items);
    let title = lang.of(&problem.title).to_owned();
    Ok(painted(style, lang, page, [title.clone(), title], items))
}

/// Returns the notation of a language with the marks of a style.
pub fn notation(style: &Style, lang: Lang) -> Notation {
    style.marks.over(&Notation::of_language(lang))
}

impl ParticleDrafter<'_> {
    fn notation(&self) -> Notation {
        notation(self.style, self.lang)
    }

    fn lines(&self) -> Vec<Phrase> {
        report::lines(self.problem, self.solved, DIGITS, self.lang, &self.notation())
    }

    /// Returns the views of a motion: for a pursuit the course, the velocities and the
    /// accelerations; for a plate both views with the velocities, then both with the accelerations.
    ///
    /// # Errors
    /// A law without a value during the motion.
    pub fn views(&self, d: &MotionDrawing) -> Result<Vec<ParticleView>, Diagnostic> {
        match &d.views {
            Views::Chase { .. } => {
                Ok(self.course(d, true).into_iter().chain(self.polygons(d)).collect())
            }
            Views::Plate { velocities, accelerations, .. } => {
                let mut all = Vec::new();
                for (on, views) in [
                    (DiagramKind::Velocity, velocities),
                    (DiagramKind::Acceleration, accelerations),
                ] {
                    all.extend([
                        self.on_plate(d, on, &views[0])?,
                        self.along_axis(d, on, &views[1]),
                    ]);
                }
                Ok(all)
            }
        }
    }

    fn figure(&self, d: &MotionDrawing, whole: bool) -> Result<Figure, Diagnostic> {
        let mut parts: Vec<DrawingPart> =
            self.views(d)?.into_iter().map(|v| self.captioned(v)).collect();
        // A pursuit: its course above the two polygons; a plate: both views in a row.
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
        let mut items: Vec<FigureItem> = parts.into_iter().flat_map(|p| p.items).collect();
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
        Ok(painted(self.style, self.lang, page, [title, desc], items))
    }

    fn words(&self, class: &str, at: Point, label: Label, size_mm: f64) -> FigureItem {
        let label = label.in_fonts(&self.style.fonts);
        FigureItem::new(
            class,
            Shape::Label { at, label, size_mm, anchor: Anchor::Middle, colour: Colour::BLACK },
        )
    }

    /// Adds the caption of a view, and its scales below.
    fn captioned(&self, view: ParticleView) -> DrawingPart {
        let scales = view.with_bars(&self.problem.book);
        let mut part = view.part;
        let on = view.scales.last().map_or(DiagramKind::Plane, |(on, _)| *on);
        // Ids of the same view with the velocities and with the accelerations must differ.
        if on != DiagramKind::Plane {
            part.items.iter_mut().for_each(|i| {
                i.id = format!("{}-{}", on.prefix(), i.id.trim_start_matches("polygon-"))
            });
        }
        let caption = Phrase::new(self.lang.of(&view.caption)).label();
        titled(self.style, part, caption, &scales, on.prefix())
    }

    fn text(&self) -> DrawingPart {
        let style = self.style;
        let lines = self.lines();
        let labels = lines.iter().flat_map(|l| wrapped(l, TEXT_MM, style.small_mm, &style.fonts));
        let row = |label: Label| Row {
            cells: vec![Some(Cell {
                label,
                size_mm: style.small_mm,
                anchor: Anchor::Start,
                class: "answer".into(),
                id: String::new(),
            })],
            height_mm: style.small_mm * 1.6,
        };
        DrawingPart::of(grid::set(&labels.map(row).collect::<Vec<_>>(), 0.0))
    }

    /// Draws a vector to a scale (SI units per mm); `on_plate` is the point of a plate to which the
    /// motion belongs.
    fn arrow(&self, d: &mut Drawing, a: &Arrow, mu: f64, on_plate: Option<&str>) {
        let style = self.style;
        let width_mm = if a.whole { style.vector.width_mm } else { style.vector.width_mm * 0.7 };
        if a.from.distance(a.to) <= 0.3 {
            return;
        }
        let stroke = LineStroke { width_mm, ..style.vector };
        let class = format!("vector {}", step(a.step));
        let id = match on_plate {
            Some(_) => a.symbol.replace(['_', '^'], "-").replace('\'', "-seen"),
            None => a.symbol.replace(['_', '^'], "-"),
        };
        let arrow = Shape::Arrow { from: a.from, to: a.to, stroke, head: style.head };
        let owner = match quantity(&a.symbol, on_plate) {
            Some(name) => {
                d.vector(&id, &class, arrow, ShownQuantity::vector(&name, a.from, a.to, mu))
            }
            None => d.shape(&id, &class, arrow),
        };
        let symbol = report::marked(&a.symbol, &self.notation());
        d.label(
            &id,
            &class,
            LabelRequest::along(Label::math(&symbol), style.label_mm, a.from, a.to, width_mm / 2.0)
                .owned(owner),
        );
    }

    /// Draws a line; its name is the first word of its class.
    fn line(&self, d: &mut Drawing, class: &str, points: Vec<Point>, stroke: LineStroke) {
        let name = class.split(' ').next().unwrap_or(class);
        d.shape(
            name,
            class,
            Shape::Polyline { points, closed: false, stroke: Some(stroke), fill: None },
        );
    }

    fn named(&self, d: &mut Drawing, name: &str, at: Point) {
        d.draw(name, "point", sym::dot(self.style, at));
        d.label_at(name, "point", name, at, self.style.dot_radius_mm, None);
    }

    fn scales(&self, drawn: &MotionDrawing, on: DiagramKind) -> Vec<(DiagramKind, f64)> {
        let shown = [DiagramKind::Plane, on];
        shown[usize::from(on == DiagramKind::Plane)..]
            .iter()
            .map(|on| (*on, drawn.scale(*on)))
            .collect()
    }
}

/// The name of a vector in the notation of `find`: `v_A` of a pursuit, `aen_M` of a point of a
/// plate. A projection has no name.
fn quantity(symbol: &str, on_plate: Option<&str>) -> Option<String> {
    let Some(point) = on_plate else { return Some(symbol.to_owned()) };
    let (letter, part) = symbol.split_once('_').filter(|_| !symbol.contains('\''))?;
    Some(format!("{letter}{}_{point}", part.replace('^', "")))
}

/// The class of the step that adds an item, counted from 0.
fn step(k: usize) -> String {
    format!("step-{k}")
}
