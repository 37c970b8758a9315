//! Turns blocks into chunks: headings, paragraphs, lists in one or two columns, tables reduced in
//! size or cut, formulas beside their tables, drawings beside the text, below it or on a page of
//! their own.

use super::super::display::built;
use super::super::{DocumentTable, TableKind};
use super::{
    BOTTOM_MM, Chunk, FOOT_MM, FULL_MM, HEADED_PART, PAPER_MM, PageSetter, SIDE_MM, TEXT_MM,
    TOP_MM, line,
};
use crate::geom::{Point, Vec2};
use crate::paper::extent::{bounds, translate};
use crate::paper::grid::{self, Cell, Row};
use crate::paper::item::{Anchor, Colour, Figure, FigureItem, LineStroke, Shape};
use crate::paper::label::Label;
use crate::paper::lines::wrapped;
use crate::paper::phrase::Phrase;
use crate::paper::text;
use crate::render::math::Math;
use crate::render::pages::{Kind, Page, Part};

/// A formula beside its table begins here, so that the formulas of a page are aligned; and it keeps
/// at least this distance from its table.
const FORMULA_MM: f64 = 105.0;
const FORMULA_GAP_MM: f64 = 10.0;
/// Space above a drawing that does not fit from which text is placed there.
const FLOW_MM: f64 = 70.0;
/// The limit where pages are filled to the end: three lines.
const LINES_MM: f64 = 18.0;
/// Sizes of the headings, title first.
const HEADINGS_MM: [f64; 4] = [6.2, 5.2, 4.5, 4.1];
/// Space above headings, and between blocks, in em of the text.
const HEADING_AIR_EM: [f64; 4] = [0.0, 1.6, 1.2, 0.8];
const BLOCK_AIR_EM: f64 = 0.6;
/// Distance from the margin to the text of a list's member.
const INDENT_MM: f64 = 7.5;
/// The least number of members of a list in columns.
const COLUMNS_MIN: usize = 4;
/// Gaps between the columns of an equation and of a table.
const EQUATION_GAP_MM: f64 = 2.2;
const VALUES_GAP_MM: f64 = 5.0;
/// Rows of a table that fit on a page below a heading.
const ROWS_MAX: usize = 34;
/// The least number of rows in a part of a cut table, its head not counted.
const ROWS_MIN: usize = 3;
/// The least size of a table that is too wide, as a part of the text's size: 2.2 mm is the smallest
/// that prints.
const SMALLEST: f64 = 0.6;

impl PageSetter {
    pub(super) fn heading(&mut self, level: usize, words: &str) {
        // A section begins only after the drawings of the section before it.
        if !self.drawings.is_empty() && level <= 2 {
            self.break_page();
            while !self.drawings.is_empty() {
                self.break_page();
            }
        }
        let size = HEADINGS_MM[level.min(HEADINGS_MM.len() - 1)];
        let air = HEADING_AIR_EM[level.min(HEADING_AIR_EM.len() - 1)] * self.air();
        let width = self.width();
        for (k, label) in wrapped(&Phrase::new(&words.replace('$', "")), width, size, &self.fonts)
            .into_iter()
            .enumerate()
        {
            let title = if k == 0 { words.to_owned() } else { label.plain() };
            let (anchor, x) =
                if level == 0 { (Anchor::Middle, width / 2.0) } else { (Anchor::Start, 0.0) };
            let height_mm = size * 1.35;
            let item = line(&label, Point::new(x, -size), size, anchor);
            let kind = if k == 0 {
                Kind::Heading { level: level as u16 + 1, title }
            } else {
                Kind::Paragraph
            };
            self.waiting.push(Chunk {
                kind,
                items: vec![item],
                height_mm,
                air_mm: if k == 0 { air } else { 0.0 },
            });
        }
    }

    pub(super) fn paragraph(&mut self, phrase: &Phrase) {
        let air_mm = BLOCK_AIR_EM * self.air();
        if !phrase.plain().trim_end().ends_with([':', '：']) {
            return self.lines(phrase, 0.0, None, air_mm, false);
        }
        // A sentence that introduces a table or a formula stays with it.
        let step = self.setting.line_em * TEXT_MM;
        for (k, label) in wrapped(phrase, self.width(), TEXT_MM, &self.fonts).iter().enumerate() {
            let items = vec![line(label, Point::new(0.0, -TEXT_MM * 1.1), TEXT_MM, Anchor::Start)];
            let air_mm = if k == 0 { air_mm } else { 0.0 };
            self.waiting.push(Chunk { kind: Kind::Paragraph, items, height_mm: step, air_mm });
        }
    }

    pub(super) fn list(&mut self, numbered: bool, members: &[Phrase]) {
        if self.setting.columns && !numbered && self.columns(members) {
            return;
        }
        for (k, m) in members.iter().enumerate() {
            let air = if k == 0 { BLOCK_AIR_EM / 2.0 } else { 0.12 } * self.air();
            // No single member is left at the end or at the beginning of a page.
            let wait = k + 1 < members.len() && (k == 0 || k + 2 == members.len());
            self.lines(m, INDENT_MM, Some((k, numbered)), air, wait);
        }
    }

    /// Sets a list in two columns, filled one after the other: each is half of the text if its
    /// members fit. Returns false if no two columns fit.
    fn columns(&mut self, members: &[Phrase]) -> bool {
        let (width, step) = (self.width(), self.setting.line_em * TEXT_MM);
        let rows = members.len().div_ceil(2);
        let labels: Vec<Label> = members.iter().map(|m| m.label().in_fonts(&self.fonts)).collect();
        let wide = |some: &[Label]| {
            INDENT_MM + some.iter().map(|l| text::set(l).width_em * TEXT_MM).fold(0.0, f64::max)
        };
        let [first, second] = [wide(&labels[..rows]), wide(&labels[rows..])];
        let column =
            if first.max(second) <= width / 2.0 { width / 2.0 } else { first + VALUES_GAP_MM };
        if labels.len() < COLUMNS_MIN || column + second > width {
            return false;
        }
        let mut items = Vec::new();
        let members = (0..labels.len()).flat_map(|k| [k; 2]).collect();
        for (k, label) in labels.iter().enumerate() {
            let at = Point::new(
                (k / rows) as f64 * column + INDENT_MM,
                -((k % rows) as f64) * step - TEXT_MM * 1.1,
            );
            items.push(line(
                &Label::text("–").in_fonts(&self.fonts),
                at - Vec2::new(1.8, 0.0),
                TEXT_MM,
                Anchor::End,
            ));
            items.push(line(label, at, TEXT_MM, Anchor::Start));
        }
        let air_mm = BLOCK_AIR_EM / 2.0 * self.air();
        self.put(Chunk {
            kind: Kind::List { numbered: false, members },
            items,
            height_mm: rows as f64 * step,
            air_mm,
        });
        true
    }

    /// Lines of text or of a list's member; `member` is its index from 0 and true for a numbered
    /// list. The first two and the last two lines stay together. Lines that wait stay with the next
    /// block.
    fn lines(
        &mut self,
        phrase: &Phrase,
        indent: f64,
        member: Option<(usize, bool)>,
        air_mm: f64,
        wait: bool,
    ) {
        let labels = wrapped(phrase, self.width() - indent, TEXT_MM, &self.fonts);
        let count = labels.len();
        let step = self.setting.line_em * TEXT_MM;
        let mut group: Vec<FigureItem> = Vec::new();
        let (mut rows, mut first) = (0, true);
        for (k, label) in labels.iter().enumerate() {
            let y = -(rows as f64) * step - TEXT_MM * 1.1;
            if let (0, Some((place, numbered))) = (k, member) {
                let mark = if numbered { format!("{}.", place + 1) } else { "–".to_owned() };
                group.push(line(
                    &Label::text(mark).in_fonts(&self.fonts),
                    Point::new(indent - 1.8, y),
                    TEXT_MM,
                    Anchor::End,
                ));
            }
            group.push(line(label, Point::new(indent, y), TEXT_MM, Anchor::Start));
            rows += 1;
            let held = k == 0 && count > 1 || k + 2 == count;
            if !held {
                let air_mm = if first { air_mm } else { 0.0 };
                let items = std::mem::take(&mut group);
                let list =
                    |(place, numbered)| Kind::List { numbered, members: vec![place; items.len()] };
                let kind = member.map_or(Kind::Paragraph, list);
                let chunk = Chunk { kind, items, height_mm: rows as f64 * step, air_mm };
                if wait && k + 1 == count {
                    self.waiting.push(chunk);
                } else {
                    self.put(chunk);
                }
                (rows, first) = (0, false);
            }
        }
    }

    /// A table; one longer than a page continues with its head repeated.
    pub(super) fn table(&mut self, table: &DocumentTable) {
        if let Some((head, rows)) = table.rows.split_first()
            && rows.len() > ROWS_MAX
        {
            for some in rows.chunks(ROWS_MAX) {
                let rows = std::iter::once(head).chain(some).cloned().collect();
                self.table(&DocumentTable { kind: table.kind, rows });
            }
            return;
        }
        if let Some(fit) = self.fitting(table).filter(|_| self.setting.filled) {
            let (here, there) = table.rows.split_at(fit);
            let rest = table.rows[..1].iter().chain(there).cloned().collect();
            self.table(&DocumentTable { kind: table.kind, rows: here.to_vec() });
            self.break_page();
            return self.table(&DocumentTable { kind: table.kind, rows: rest });
        }
        let gap = if table.kind == TableKind::Equation { EQUATION_GAP_MM } else { VALUES_GAP_MM };
        let set = |setter: &PageSetter, scale: f64| {
            let rows: Vec<Row> = table
                .rows
                .iter()
                .enumerate()
                .map(|(r, row)| setter.cells(table.kind, r, row, TEXT_MM * scale))
                .collect();
            grid::set(&rows, gap * scale)
        };
        let mut items = set(self, 1.0);
        let wide = bounds(&items).map_or(0.0, |b| b.max.x);
        if wide > self.width() {
            self.clear();
        }
        let room = self.width();
        let scale = (room / wide).clamp(SMALLEST, 1.0);
        if scale < 1.0 {
            items = set(self, scale);
        }
        let step = self.setting.line_em * TEXT_MM * scale;
        if table.kind == TableKind::Values {
            // A thick line above and below, a thin one under the head.
            let to = bounds(&items).map_or(0.0, |b| b.max.x);
            let end = table.rows.len() as f64 + 0.4;
            for (rows, width_mm) in [(0.15, 0.35), (1.15, 0.2), (end, 0.35)] {
                let [from, to] = [0.0, to].map(|x| Point::new(x, -step * rows));
                let shape = Shape::Line { from, to, stroke: LineStroke::new(width_mm) };
                items.push(FigureItem::new("rule", shape));
            }
        } else if wide * scale < room - INDENT_MM {
            translate(&mut items, Vec2::new(INDENT_MM, 0.0));
        }
        let height_mm = table.rows.len() as f64 * step + 0.5 * step;
        let right = bounds(&items).map_or(0.0, |b| b.max.x);
        self.put(Chunk {
            kind: structure(table),
            items,
            height_mm,
            air_mm: BLOCK_AIR_EM * self.air(),
        });
        let middle = self.y + height_mm - (table.rows.len() + 1) as f64 / 2.0 * step;
        self.table = (table.kind == TableKind::Equation).then_some([room, right, middle]);
    }

    /// The number of rows of a table of values that fit on the rest of this page, if not all but
    /// enough rows do.
    fn fitting(&self, table: &DocumentTable) -> Option<usize> {
        let above: f64 = self.waiting.iter().map(|c| c.air_mm + c.height_mm).sum();
        let step = self.setting.line_em * TEXT_MM;
        // The head, and the space around the table, take the height of two rows.
        let fit = ((self.room() - above - BLOCK_AIR_EM * self.air()) / step) as usize;
        let (fit, all) = (fit.saturating_sub(1), table.rows.len());
        let enough = table.kind == TableKind::Values
            && fit > ROWS_MIN
            && fit + ROWS_MIN <= all
            && all <= ROWS_MAX;
        (enough && !self.fresh()).then_some(fit)
    }

    /// A row of a table.
    fn cells(&self, kind: TableKind, r: usize, row: &[Phrase], size_mm: f64) -> Row {
        let cell = |(c, phrase): (usize, &Phrase)| {
            let anchor = match kind {
                TableKind::Equation if c > 0 => Anchor::Middle,
                TableKind::Equation | TableKind::Values => Anchor::Start,
            };
            let label = phrase.label().in_fonts(&self.fonts);
            (!phrase.pieces().is_empty()).then(|| Cell {
                label,
                size_mm,
                anchor,
                class: "cell".into(),
                id: String::new(),
            })
        };
        // The second row keeps a distance from the rule below the head.
        let air = if kind == TableKind::Values && r == 1 { 1.2 } else { 1.0 };
        let height = if r == 0 { 0.9 } else { air };
        Row {
            cells: row.iter().enumerate().map(cell).collect(),
            height_mm: height * self.setting.line_em * size_mm,
        }
    }

    /// A formula: beside its table where that fits, else on a line of its own.
    pub(super) fn formula(&mut self, parts: &[Math]) {
        let built = built(parts, TEXT_MM, &self.fonts);
        let mut items = built.items;
        let words = parts.iter().map(Math::plain).collect::<Vec<_>>().join(" ");
        let wide = bounds(&items).map_or(0.0, |b| b.max.x);
        if let Some([room, right, y]) = self.table.take() {
            let x = FORMULA_MM.max(right + FORMULA_GAP_MM);
            if self.waiting.is_empty() && x + wide <= room && y - built.below >= self.y {
                translate(&mut items, Vec2::new(SIDE_MM + x, y));
                self.parts.push(Part { kind: Kind::Formula(words), items });
                return;
            }
        }
        if INDENT_MM * 2.0 + wide > self.width() {
            self.clear();
        }
        translate(&mut items, Vec2::new(INDENT_MM * 2.0, -built.above));
        let height_mm = built.above + built.below + BLOCK_AIR_EM / 2.0 * TEXT_MM;
        self.put(Chunk {
            kind: Kind::Formula(words),
            items,
            height_mm,
            air_mm: BLOCK_AIR_EM * self.air(),
        });
    }

    pub(super) fn figure(&mut self, figure: &Figure) {
        let mut items = figure.items.clone();
        // A white background is not drawn.
        if figure.paper != Colour::WHITE {
            let corners = [
                (0.0, 0.0),
                (figure.width_mm, 0.0),
                (figure.width_mm, figure.height_mm),
                (0.0, figure.height_mm),
            ];
            let points = corners.map(|(x, y)| Point::new(x, y)).to_vec();
            items.insert(
                0,
                FigureItem::new(
                    "paper",
                    Shape::Polyline {
                        points,
                        closed: true,
                        stroke: None,
                        fill: Some(figure.paper),
                    },
                ),
            );
        }
        let Some(ink) = bounds(&items) else { return };
        let (wide, high) = (ink.width_mm(), ink.height_mm());
        let kind = Kind::Figure(figure.desc.clone());
        if wide > FULL_MM || high > PAPER_MM[1] - TOP_MM - BOTTOM_MM {
            // The page number is below the drawing.
            translate(&mut items, Vec2::new(0.0, FOOT_MM));
            let parts = vec![Part { kind, items }];
            self.large.push(Page {
                width_mm: figure.width_mm,
                height_mm: figure.height_mm + FOOT_MM,
                parts,
            });
            return;
        }
        let air_mm = BLOCK_AIR_EM * 1.5 * self.air();
        self.clear();
        translate(&mut items, Vec2::new((FULL_MM - wide) / 2.0 - ink.min.x, -ink.max.y));
        let headed = if self.waiting.is_empty() { 0.0 } else { HEADED_PART };
        let beside = wide <= headed.max(self.setting.beside_part) * FULL_MM;
        // Below a drawing beside the text no space is needed.
        let height_mm = if beside { high } else { high + air_mm };
        let chunk = Chunk { kind, items, height_mm, air_mm };
        // With little space left, heading and drawing move to the next page together; with much,
        // text is placed before the drawing.
        let worth = if self.setting.filled { LINES_MM } else { FLOW_MM };
        if !self.holds(&chunk) && self.room() > worth {
            self.drawings.push_back(chunk);
        } else if beside {
            while !self.holds(&chunk) {
                self.break_page();
            }
            for heading in std::mem::take(&mut self.waiting) {
                self.place(heading);
            }
            self.place_beside(chunk);
        } else {
            self.put(chunk);
        }
    }
}

/// Structure of a table for readers of tagged PDF: an equation is read as a whole, in a table of
/// values each cell.
fn structure(table: &DocumentTable) -> Kind {
    match table.kind {
        TableKind::Equation => {
            let row = |r: &Vec<Phrase>| r.iter().map(Phrase::plain).collect::<Vec<_>>().join(" ");
            Kind::Formula(table.rows.iter().map(row).collect::<Vec<_>>().join("; "))
        }
        TableKind::Values => {
            let written = |row: &Vec<Phrase>| {
                row.iter()
                    .enumerate()
                    .filter(|(_, p)| !p.pieces().is_empty())
                    .map(|(c, _)| c)
                    .collect::<Vec<_>>()
            };
            let places =
                |(r, row): (usize, &Vec<Phrase>)| written(row).into_iter().map(move |c| [r, c]);
            Kind::Table(table.rows.iter().enumerate().flat_map(places).collect())
        }
    }
}
