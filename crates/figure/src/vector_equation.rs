//! Draws a vector equation: the polygon with lines of known direction and arcs of known radius, the
//! table of magnitudes and directions above it, the answers below. A second solution is dashed.
//!
//! The content comes from [`hodograph_methods::equation::board`].

use super::arrange::Tree;
use super::particle::ParticleView;
use super::sheet::{MARGIN_MM, painted, titled};
use super::tables::set_table;
use hodograph_base::diag::{Both, both};
use hodograph_base::geom::Point;
use hodograph_base::notation::Notation;
use hodograph_methods::equation::board::{EquationDrawing, EquationLocus, START};
use hodograph_methods::equation::{EquationSolution, VectorEquation};
use hodograph_paper::paper::drawing::{Drawing, DrawingPart, id};
use hodograph_paper::paper::grid::{self, Cell, Row};
use hodograph_paper::paper::item::{
    Anchor, Colour, Dash, Figure, FigureItem, LineStroke, Shape, distinct,
};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::shown::ShownQuantity;
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::symbols as sym;
use hodograph_paper::paper::text;
use hodograph_paper::paper::words::words;
use hodograph_report::answers::DIGITS;
use hodograph_report::vector_equation as report;
use hodograph_scene::{DiagramKind, Lang};

/// The input of the drawing.
#[derive(Clone, Copy)]
pub struct EquationSheet<'a> {
    /// The equation.
    pub problem: &'a VectorEquation,
    /// Its solution.
    pub solved: &'a EquationSolution,
    /// Its drawing.
    pub drawn: &'a EquationDrawing,
    /// Line widths, sizes and fonts.
    pub style: &'a Style,
    /// The notation.
    pub notation: &'a Notation,
    /// The language.
    pub lang: Lang,
}

impl EquationSheet<'_> {
    /// Returns the figure; if `whole`, with title, table and answers, otherwise for a document that
    /// has them.
    pub fn figure(&self, whole: bool) -> Figure {
        let polygon = self.captioned(self.polygon());
        let mut parts = vec![polygon];
        let mut rows = vec![Tree::Leaf(0)];
        if whole {
            parts.push(self.table());
            parts.push(self.answers());
            rows = vec![Tree::Leaf(1), Tree::Leaf(0), Tree::Leaf(2)];
        }
        let tree = Tree::column(rows);
        let size = tree.size(&parts);
        let title = self.lang.of(&self.problem.title).to_owned();
        let heading = Label::text(title.as_str()).in_fonts(&self.style.fonts);
        let large = self.style.caption_mm * 1.15;
        let head = if whole { 12.0 } else { 0.0 };
        let wide = if whole { text::set(&heading).width_em * large } else { 0.0 };
        let page = [size[0].max(wide) + 2.0 * MARGIN_MM, size[1] + 2.0 * MARGIN_MM + head];
        let corner = Point::new((page[0] - size[0]) / 2.0, page[1] - MARGIN_MM - head);
        tree.put(&mut parts, corner);
        let mut items: Vec<FigureItem> = parts.into_iter().flat_map(|p| p.items).collect();
        if whole {
            let at = Point::new(page[0] / 2.0, page[1] - MARGIN_MM - 4.0);
            items.push(self.words("title", at, heading, large));
        }
        distinct(&mut items);
        let lines = report::lines(self.problem, self.solved, DIGITS);
        let desc = lines.iter().map(|l| l.plain()).collect::<Vec<_>>().join("; ");
        painted(self.style, self.lang, page, [title, desc], items)
    }

    fn words(&self, class: &str, at: Point, label: Label, size_mm: f64) -> FigureItem {
        let label = label.in_fonts(&self.style.fonts);
        let anchor = Anchor::Middle;
        FigureItem::new(class, Shape::Label { at, label, size_mm, anchor, colour: Colour::BLACK })
    }

    fn table(&self) -> DrawingPart {
        let columns = report::columns(&self.problem.terms, self.notation);
        let class = |what: &str| format!("{} table {what}", self.drawn.on.word());
        let name = id(self.drawn.on.word(), "equation");
        set_table(self.style, words(self.lang), self.notation, &name, (0, &columns), class)
    }

    fn answers(&self) -> DrawingPart {
        let last = self.drawn.steps.len().saturating_sub(1);
        let row = |label: Label| Row {
            cells: vec![Some(Cell {
                label: label.in_fonts(&self.style.fonts),
                size_mm: self.style.caption_mm,
                anchor: Anchor::Start,
                class: format!("answer step-{last}"),
                id: String::new(),
            })],
            height_mm: self.style.caption_mm * 1.6,
        };
        let lines = report::lines(self.problem, self.solved, DIGITS);
        DrawingPart::of(grid::set(&lines.iter().map(|l| row(l.label())).collect::<Vec<_>>(), 0.0))
    }

    /// Adds caption and scale below the polygon.
    fn captioned(&self, view: ParticleView) -> DrawingPart {
        let scales = view.with_bars(&self.problem.book);
        let caption = Label::text(self.lang.of(&view.caption));
        titled(self.style, view.part, caption, &scales, self.drawn.on.prefix())
    }

    /// Returns the polygon without its caption; each item has the class of its step.
    pub fn polygon(&self) -> ParticleView {
        let (drawn, style) = (self.drawn, self.style);
        let mut d = Drawing::new(drawn.on.word(), style.clone());
        for (locus, step) in &drawn.loci {
            let class = format!("locus step-{step}");
            let stroke = style.thin;
            match *locus {
                EquationLocus::Line(from, to) => {
                    d.shape("locus", &class, Shape::Line { from, to, stroke })
                }
                EquationLocus::Arc(centre, radius_mm, [from_rad, to_rad]) => d.shape(
                    "locus",
                    &class,
                    Shape::Arc { centre, radius_mm, from_rad, to_rad, stroke },
                ),
            };
        }
        for a in &drawn.arrows {
            let term = &self.problem.terms[a.term];
            let primes = a.root.map_or(0, |root| report::primes(self.solved, root));
            if a.from.distance(a.to) <= 0.3 {
                continue;
            }
            let class = format!("vector step-{}", a.step);
            let stroke = match a.root {
                Some(root) if root > 0 => style.vector.dashed(Dash::Dashed),
                Some(_) => style.vector,
                None => LineStroke { width_mm: style.vector.width_mm * 0.7, ..style.vector },
            };
            let name = match a.root {
                Some(root) => report::find(self.problem, self.solved, root, a.term),
                None => term.name.clone(),
            };
            let id = name.replace(['_', '^'], "-").replace('\'', "-solution");
            let arrow = Shape::Arrow { from: a.from, to: a.to, stroke, head: style.head };
            let shown = ShownQuantity::vector(&name, a.from, a.to, drawn.mu);
            let owner = d.vector(&id, &class, arrow, shown);
            let symbol = self.notation.vectors.write(term.symbol(primes));
            d.label_along(&id, &class, &symbol, (a.from, a.to), stroke.width_mm / 2.0, owner);
        }
        for (k, mark) in drawn.marks.iter().enumerate() {
            let class =
                if k == 0 { "pole".to_owned() } else { format!("point step-{}", mark.step) };
            let polygon = DiagramKind::POLYGONS.contains(&drawn.on);
            let name = match (k, polygon) {
                (0, true) => format!("{}{}", self.notation.pole, drawn.on.prime()),
                (0, false) => START.to_owned(),
                _ => mark.name.clone(),
            };
            let id = if k == 0 { "pole".to_owned() } else { name.replace(['_', '\''], "") };
            d.draw(&id, &class, sym::dot(style, mark.at));
            let near = drawn.marks[..k].iter().any(|m| m.at.distance(mark.at) < 0.3);
            if !near {
                d.label_at(&id, &class, &name, mark.at, style.dot_radius_mm, None);
            }
        }
        ParticleView {
            part: d.finish(),
            caption: caption(drawn.on),
            scales: vec![(drawn.on, drawn.mu)],
        }
    }
}

/// The name of the polygon.
fn caption(on: DiagramKind) -> Both {
    match on {
        DiagramKind::Plane => both!("Vector polygon"),
        DiagramKind::Velocity | DiagramKind::Acceleration | DiagramKind::Force => {
            let [en, zh] = [Lang::En, Lang::Zh].map(|lang| on.caption(lang).to_owned());
            Both { en, zh }
        }
    }
}
