//! The equations of a polygon as written beside it: tables for equations with two chains, one line
//! for everything else.

use hodograph_worked::certified::CertifiedSteps;
use std::ops::Range;

use hodograph_base::digits::inked;
use hodograph_base::notation::Notation;
use hodograph_board::construct::{Action, PlanDrawing, Polygon};
use hodograph_board::plan::text::{EquationColumn, PlanWriter, vertex_name};
use hodograph_board::plan::{PlanStep, Special, SpecialLine, TermChain, VertexId};
use hodograph_mechanism::mechanism::ConstraintLine;
use hodograph_paper::paper::phrase::{Phrase, fill};
use hodograph_scene::{DiagramKind, PointId, Scene};

use super::results::DIGITS;
use hodograph_paper::paper::drawing::{DrawingPart, id};
use hodograph_paper::paper::grid::{self, Cell, Row};
use hodograph_paper::paper::item::{Anchor, FigureItem};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::lines::wrapped;
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::words::{Words, words};
use hodograph_report::amount::number;
use hodograph_report::equation::mate;

/// Distance from a symbol's baseline to the row below it, and between rows.
const ROW_MM: f64 = 7.2;
/// Distance from the top of a table to its symbols' baseline: the height of superscripts.
const TOP_MM: f64 = 5.6;
/// Space below the last baseline: the depth of subscripts.
const BOTTOM_MM: f64 = 1.8;
/// Gap between the columns of a table: the space of a binary operator.
const GAP_MM: f64 = 2.6;
/// Height of a statement in one line.
const LINE_MM: f64 = 6.6;

/// The input of the tables.
#[derive(Clone, Copy)]
pub struct Tables<'a> {
    /// The style.
    pub style: &'a Style,
    /// The writer of names and symbols.
    pub writer: &'a PlanWriter<'a>,
    /// The construction, with the alternatives that are drawn.
    pub construction: &'a PlanDrawing,
    /// The certified numbers of the steps.
    pub steps: &'a CertifiedSteps,
    /// The width of a column: longer equations continue in another table, longer statements in
    /// another line.
    pub width_mm: Option<f64>,
}

impl Tables<'_> {
    /// Returns one part for each step of a polygon, in solving order.
    pub fn parts(&self, on: DiagramKind) -> Vec<DrawingPart> {
        self.parts_of(on, |_| true)
    }

    /// Returns one part for each step of some groups, selected by their indices in the mechanism's
    /// list.
    pub fn parts_of(&self, on: DiagramKind, wanted: impl Fn(usize) -> bool) -> Vec<DrawingPart> {
        let Some(polygon) = self.construction.polygon(on) else { return Vec::new() };
        let mut parts = Vec::new();
        for group in self.writer.plan.steps(on).iter().filter(|g| wanted(g.group)) {
            let chosen = group.drawn(self.construction.acts.chosen[group.group]);
            for step in group.steps(chosen) {
                let step_class = step_class(polygon, step.target());
                match step {
                    PlanStep::Equation { target, chains, .. } => {
                        if let Some(special) = self.writer.plan.introduced(step) {
                            parts.push(self.special(on, *target, special, &step_class));
                        }
                        if let Some(text) = mate(self.writer, step) {
                            let name = id(kind(on), &format!("mate-{}", group.group));
                            parts.push(self.sentence_block(
                                &text,
                                name,
                                format!("{} statement special {step_class}", kind(on)),
                            ));
                        }
                        parts.extend(self.equation(on, *target, chains, &step_class));
                    }
                    PlanStep::Image { target, from, .. } => {
                        parts.push(self.image(on, *target, *from, &step_class))
                    }
                    PlanStep::Trials { target, images, mates } => {
                        let w = self.writer;
                        let [a, b] =
                            [images, mates].map(|pair| pair.map(|v| w.image(on, v)).concat());
                        let formula = format!("{} = {a} \\times {b}", w.image(on, *target));
                        parts.push(self.line(
                            on,
                            *target,
                            &formula,
                            Some(Label::text(self.words().trials)),
                            &step_class,
                        ));
                    }
                    PlanStep::Same { target, from, link } => {
                        let w = self.writer;
                        let formula =
                            format!("{} = {}", w.summand(on, *target), w.summand(on, *from));
                        let why = self.words().no_turning.replace("{}", w.scene.link_name(*link));
                        parts.push(self.line(
                            on,
                            *target,
                            &formula,
                            Some(Label::text(why)),
                            &step_class,
                        ));
                    }
                }
            }
        }
        parts
    }

    fn vertex(&self, v: VertexId) -> String {
        vertex_name(self.writer.scene, self.writer.plan, v)
    }

    fn words(&self) -> &'static Words {
        words(self.writer.lang)
    }

    fn cell(&self, label: Label, size_mm: f64, anchor: Anchor, id: String, class: &str) -> Cell {
        Cell { label: label.in_fonts(&self.style.fonts), size_mm, anchor, class: class.into(), id }
    }

    fn equation(
        &self,
        on: DiagramKind,
        target: VertexId,
        chains: &[TermChain],
        step: &str,
    ) -> Vec<DrawingPart> {
        let (w, book) = (self.writer, &self.writer.scene.book);
        if let [chain] = chains {
            let [term] = chain.known[..] else {
                // Nothing is added: the point moves like a known one.
                if chain.known.is_empty() {
                    let start = if w.plan.vertex(chain.start).fixed {
                        "0".to_owned()
                    } else {
                        w.summand(on, chain.start)
                    };
                    let formula = format!("{} = {start}", w.summand(on, target));
                    return (chain.start != target)
                        .then(|| self.line(on, target, &formula, None, step))
                        .into_iter()
                        .collect();
                }
                return self.table(on, target, chains, step);
            };
            if w.plan.vertex(chain.start).fixed {
                let (whole, part) = (w.vector(on, target), w.symbol(on, &term));
                // The drawing names the total vector.
                let head = if whole == part { whole } else { format!("{whole} = {part}") };
                // A value given by a driver is a number, not a formula.
                let magnitude = match (w.magnitude(on, &term), self.construction.vector(on, target))
                {
                    (known, Some(v)) if known == w.notation.known => {
                        let certain = self
                            .steps
                            .vector(on, target)
                            .and_then(|n| n.text(DIGITS))
                            .map(|(text, _)| inked(&text));
                        let rough =
                            || format!("\\approx {}", number(book.value(on.kind(), v.norm()), 1));
                        book.label(on.kind(), &certain.unwrap_or_else(rough))
                    }
                    (formula, _) => formula,
                };
                let formula = format!("{head} = {magnitude}");
                return vec![self.line(
                    on,
                    target,
                    &formula,
                    Some(Label::math(w.direction(&term))),
                    step,
                )];
            }
        }
        self.table(on, target, chains, step)
    }

    /// The table of an equation; in a column, as many tables as needed, each continued before a
    /// sign.
    fn table(
        &self,
        on: DiagramKind,
        target: VertexId,
        chains: &[TermChain],
        step: &str,
    ) -> Vec<DrawingPart> {
        let columns = self.writer.columns(on, target, chains);
        let set = |ends: Range<usize>| self.part_of_table(on, target, &columns, ends, step);
        let Some(width_mm) = self.width_mm else {
            // A table that would make the sheet wide continues in a second row, before a sign of
            // equality.
            let second = columns
                .iter()
                .rposition(|c| c.joint == "=")
                .filter(|k| columns.len() > MOST_COLUMNS && *k > 1);
            return second.map_or_else(
                || vec![set(0..columns.len())],
                |k| vec![set(0..k), set(k..columns.len())],
            );
        };
        let (mut parts, mut start) = (Vec::new(), 0);
        while start < columns.len() {
            let fits = |end: &usize| set(start..*end).bounds.width_mm() <= width_mm;
            let most = (start + 1..=columns.len()).rev().find(fits).unwrap_or(start + 1);
            // A sum of several terms is not broken: the table ends at the sign of equality, if the
            // rest fits.
            let at_equality = |k: &usize| {
                columns[*k].joint == "=" && set(*k..columns.len()).bounds.width_mm() <= width_mm
            };
            let end = if most < columns.len() {
                (start + 2..=most).rev().find(at_equality).unwrap_or(most)
            } else {
                most
            };
            parts.push(set(start..end));
            start = end;
        }
        parts
    }

    fn part_of_table(
        &self,
        on: DiagramKind,
        target: VertexId,
        columns: &[EquationColumn],
        ends: Range<usize>,
        step: &str,
    ) -> DrawingPart {
        let name = id(kind(on), &format!("equation-{}", self.vertex(target)));
        let class = |what: &str| format!("{} table {what} {step}", kind(on));
        let (start, columns) = (ends.start, columns.get(ends).unwrap_or_default());
        set_table(self.style, self.words(), self.writer.notation, &name, (start, columns), class)
    }

    fn line(
        &self,
        on: DiagramKind,
        target: VertexId,
        formula: &str,
        why: Option<Label>,
        step: &str,
    ) -> DrawingPart {
        let name = id(kind(on), &format!("statement-{}", self.vertex(target)));
        let class = format!("{} statement {step}", kind(on));
        let mut cells = vec![Some(self.cell(
            Label::math(formula),
            self.style.label_mm,
            Anchor::Start,
            name.clone(),
            &class,
        ))];
        if let Some(why) = why {
            // A quad separates formula and reason.
            cells.push(Some(self.cell(
                why,
                self.style.caption_mm,
                Anchor::Start,
                format!("{name}-why"),
                &class,
            )));
        }
        self.statement(vec![cells], self.style.label_mm)
    }

    /// Statements one below the other, with a gap between their cells.
    fn statement(&self, rows: Vec<Vec<Option<Cell>>>, gap_mm: f64) -> DrawingPart {
        let [top, line] = [TOP_MM, LINE_MM].map(|mm| self.style.leading(mm));
        let height = line * rows.len() as f64;
        let heights = std::iter::once(top).chain(std::iter::repeat(line));
        let rows: Vec<Row> = rows
            .into_iter()
            .zip(heights)
            .map(|(cells, height_mm)| Row { cells, height_mm })
            .collect();
        boxed(grid::set(&rows, gap_mm), height)
    }

    fn image(
        &self,
        on: DiagramKind,
        target: VertexId,
        from: (VertexId, VertexId),
        step: &str,
    ) -> DrawingPart {
        let w = self.writer;
        let images =
            format!("{}{}{}", w.image(on, from.0), w.image(on, from.1), w.image(on, target));
        let points = format!("{}{}{}", w.spot(from.0), w.spot(from.1), w.spot(target));
        // Three collinear points form no triangle: their image is a ratio.
        let in_line = self.construction.diagram.in_line([from.0, from.1, target]);
        let head = Label::math(format!("{}: \\quad", w.vector(on, target)));
        let similar = if in_line {
            let ratio = |[a, b, x]: [String; 3]| format!("{a}{b}/{a}{x}");
            let images = ratio([from.0, from.1, target].map(|v| w.image(on, v)));
            head.then(Label::math(format!(
                "{images} = {}",
                ratio([from.0, from.1, target].map(|v| w.spot(v)))
            )))
        } else {
            // No embedded font contains the sign △; a capital delta has its shape.
            let similar = Label::math(w.notation.similar.as_str());
            let sides = [
                Label::text("Δ"),
                Label::math(images),
                Label::text(" "),
                similar,
                Label::text(" Δ"),
                Label::math(points),
            ];
            sides.into_iter().fold(head, Label::then)
        };
        let name = id(kind(on), &format!("statement-{}", self.vertex(target)));
        let class = format!("{} statement image {step}", kind(on));
        let mut cells = vec![Some(self.cell(
            similar,
            self.style.label_mm,
            Anchor::Start,
            name.clone(),
            &class,
        ))];
        if !in_line {
            let why = Label::text(self.words().image);
            cells.push(Some(self.cell(
                why,
                self.style.caption_mm,
                Anchor::Start,
                format!("{name}-why"),
                &class,
            )));
        }
        self.statement(vec![cells], self.style.label_mm)
    }

    /// The statement that defines a special point.
    fn special(
        &self,
        on: DiagramKind,
        target: VertexId,
        special: &Special,
        step: &str,
    ) -> DrawingPart {
        let (text, link) = (
            special_words(self.writer, self.words(), target, special),
            self.writer.scene.link_name(special.link),
        );
        let name = match special.legs {
            Some(_) => format!("special-{}", special.group),
            None => format!("special-{}-{link}", special.group),
        };
        self.sentence_block(
            &text,
            id(kind(on), &name),
            format!("{} statement special {step}", kind(on)),
        )
    }

    /// A sentence, broken to the available width.
    fn sentence_block(&self, text: &str, id: String, class: String) -> DrawingPart {
        let size_mm = self.style.caption_mm;
        let told = Phrase::new(text);
        let lines = match self.width_mm {
            Some(width_mm) => wrapped(&told, width_mm, size_mm, &self.style.fonts),
            None => vec![told.label()],
        };
        let row = |(k, line): (usize, Label)| {
            let id = if k == 0 { id.clone() } else { format!("{id}-line-{}", k + 1) };
            vec![Some(self.cell(line, size_mm, Anchor::Start, id, &class))]
        };
        self.statement(lines.into_iter().enumerate().map(row).collect(), 0.0)
    }
}

/// Returns the words that introduce a special point.
pub fn special_words(w: &PlanWriter, words: &Words, target: VertexId, special: &Special) -> String {
    let [a, b] = special.lines.each_ref().map(|line| special_line(w, words, line));
    let [link, with] =
        [Some(special.link), special.with].map(|l| l.map_or("", |l| w.scene.link_name(l)));
    let form = if special.with.is_some() { words.common_point } else { words.special_point };
    fill(form, &[("S", &w.spot(target)), ("1", &a), ("2", &b), ("3", with), ("", link)])
}

/// A line along which a link is held, in words.
fn special_line(w: &PlanWriter, words: &Words, line: &SpecialLine) -> String {
    match *line {
        SpecialLine::Leg(line) => constraint_line(w.scene, words, line),
        SpecialLine::Through { pin, special } => {
            format!(
                "${}{}$",
                w.spot(special),
                hodograph_board::plan::text::point_label(w.scene.point_name(pin))
            )
        }
    }
}

/// The line on which a leg gives a locus for every point of its link, in words.
pub(crate) fn constraint_line(scene: &Scene, words: &Words, line: ConstraintLine) -> String {
    let name = |p: PointId| hodograph_board::plan::text::point_label(scene.point_name(p));
    match line {
        ConstraintLine::Along { near, far } => format!("${}{}$", name(far), name(near)),
        ConstraintLine::Normal { pin, .. } => fill(words.square_to_guide, &[("", &name(pin))]),
        ConstraintLine::Tangent { at, .. } => fill(words.tangent_at, &[("", &name(at))]),
    }
}

/// Maximum number of columns before a table has two rows.
const MOST_COLUMNS: usize = 12;

/// Returns the table of an equation: symbols, magnitudes and directions of some of its columns; the
/// first of them has this index in the equation. `class` makes the class of an item from its role.
pub(super) fn set_table(
    style: &Style,
    words: &Words,
    notation: &Notation,
    name: &str,
    (start, columns): (usize, &[EquationColumn]),
    class: impl Fn(&str) -> String,
) -> DrawingPart {
    let cell = |label: Label, size_mm: f64, anchor: Anchor, id: String, what: &str| {
        let label = label.in_fonts(&style.fonts);
        Some(Cell { label, size_mm, anchor, class: class(what), id })
    };
    let head = |word: &str, what: &str| {
        let id = if start == 0 {
            format!("{name}-{what}")
        } else {
            format!("{name}-{what}-from-{start}")
        };
        cell(heading(word), style.caption_mm, Anchor::End, id, "heading")
    };
    let mut symbols = vec![None];
    let mut magnitudes = vec![head(words.magnitude, "magnitude")];
    let mut directions = vec![head(words.direction, "direction")];
    for (k, c) in (start..).zip(columns) {
        let cell = |text: &str, size: f64, what: &str| {
            cell(Label::math(text), size, Anchor::Middle, format!("{name}-{what}-{k}"), what)
        };
        symbols.push(if c.joint.is_empty() {
            None
        } else {
            cell(c.joint, style.label_mm, "joint")
        });
        symbols.push(cell(&c.symbol, style.label_mm, "symbol"));
        magnitudes.extend([None, cell(&c.magnitude, style.caption_mm, "magnitude")]);
        directions.extend([None, cell(&c.direction, style.caption_mm, "direction")]);
    }
    let [top, row, bottom] = [TOP_MM, ROW_MM, BOTTOM_MM].map(|mm| style.leading(mm));
    let mut rows = vec![Row { cells: symbols, height_mm: top }];
    let both = if notation.first_row == "direction" {
        [directions, magnitudes]
    } else {
        [magnitudes, directions]
    };
    rows.extend(both.map(|cells| Row { cells, height_mm: row }));
    boxed(grid::set(&rows, style.leading(GAP_MM)), top + 2.0 * row + bottom)
}

/// A part with a box as high as its rows, independent of their content, so that stacked tables are
/// evenly spaced.
fn boxed(items: Vec<FigureItem>, height_mm: f64) -> DrawingPart {
    let mut part = DrawingPart::of(items);
    part.bounds.max.y = part.bounds.max.y.max(0.0);
    part.bounds.min.y = part.bounds.min.y.min(-height_mm);
    part
}

/// A row's heading, with the space before the first column.
fn heading(word: &str) -> Label {
    Label::text(word).then(Label::math("\\quad"))
}

fn kind(on: DiagramKind) -> &'static str {
    on.word()
}

/// The class of the action that finds a vertex.
fn step_class(p: &Polygon, v: VertexId) -> String {
    found_by(p, v).map(|n| format!("step-{n}")).unwrap_or_default()
}

/// Returns the index of the action of a polygon that finds a vertex.
pub fn found_by(p: &Polygon, v: VertexId) -> Option<usize> {
    let finds = |a: &Action| match a {
        Action::Cross { target, .. }
        | Action::Trials { target, .. }
        | Action::Copy { target, .. }
        | Action::Same { target, .. }
        | Action::Reach(target) => *target == v,
        Action::LayOff(e) => p.edges[*e].to.0 == hodograph_board::construct::PolygonMark::Image(v),
        Action::Nothing { target, .. } => *target == Some(v),
        Action::Line { .. } | Action::Join(_) | Action::Perpendicular { .. } | Action::Rate(_) => {
            false
        }
    };
    p.actions.iter().position(finds)
}
