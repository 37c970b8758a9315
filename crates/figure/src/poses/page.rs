//! Forms pages from the rows of a sheet of poses: the number of rows side by side, their rules,
//! heads and names.

use super::cells::PoseColumn;
use super::{PoseTable, text};
use crate::path::turned;
use crate::plot::over;
use crate::sheet::{MARGIN_MM, SheetDrafter, swept_symbol};
use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_base::digits::{inked, shortest};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::tr;
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::extent::Rect;
use hodograph_paper::paper::item::{Anchor, Figure, FigureItem, LineStroke, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::phrase::{Phrase, fill, formula};
use hodograph_report::amount::scale_formula;
use hodograph_scene::{DiagramKind, Kind};

/// Space around a drawing in its cell.
const AIR_MM: f64 = 3.5;
/// Width of the column that names the pose of a row, and height of the table's head.
const NAME_MM: f64 = 26.0;
const HEAD_MM: f64 = 15.0;
/// Paper sizes of a printer: A4 and A3.
const PAPERS: [[f64; 2]; 2] = [[210.0, 297.0], [297.0, 420.0]];
/// Minimum number of rows on a page of a table.
const ROWS_LEAST: usize = 2;
/// Space below the title.
const TITLE_MM: f64 = 14.0;
/// Space between the table and the key below it.
const KEYS_MM: f64 = 4.0;

impl PoseTable<'_> {
    /// Returns the place of the driver in a pose, with its unit.
    pub(super) fn position(&self, row: usize) -> String {
        let scene = &self.rows[0].scene;
        let (_, kind) = swept_symbol(scene, self.swept);
        let ((unit, factor), parts) = (scene.book.fine(kind), scene.book.parts(kind, 100.0));
        let value = self.rows[row].place;
        let shown =
            if kind == Kind::Angle { turned(value, factor, self.full) } else { value * factor };
        let shown = inked(&shortest((shown * parts).round() / parts));
        if unit == "\\degree" { format!("{shown}{unit}") } else { format!("{shown}\\,{unit}") }
    }

    /// Titles and captions are the same for all poses, and no results are shown.
    fn maker(&self) -> SheetDrafter<'_> {
        let first = &self.rows[0];
        SheetDrafter {
            scene: &first.scene,
            worked: &first.worked,
            options: self.options,
            certified: Vec::new(),
        }
    }

    /// The name and the scale above a column.
    fn head(&self, column: &PoseColumn) -> (Label, String) {
        let (maker, on) = (self.maker(), column.on);
        let (words, mu) = maker.caption(on);
        // The first pose may have no polygon.
        let mu = if on == DiagramKind::Plane {
            mu.text
        } else {
            scale_formula(&maker.scene.book, on, self.scales.mu.get(on.kind()).unwrap_or(1.0))
        };
        (Phrase::new(words).label(), mu)
    }

    /// The two lines of a head, below the middle of its upper edge.
    fn head_items(&self, (words, mu): (Label, String), top: Point) -> [FigureItem; 2] {
        let style = &self.options.style;
        let line = |down: f64, label, size_mm| {
            text("head", top - Vec2::new(0.0, down), label, size_mm, Anchor::Middle)
                .in_fonts(&style.fonts)
        };
        [line(6.0, words, style.caption_mm), line(12.0, Label::math(mu), style.small_mm)]
    }

    /// The width of a column: space for its drawings and its head.
    fn wide_mm(&self, column: &PoseColumn) -> f64 {
        let head = self
            .head_items(self.head(column), Point::ORIGIN)
            .iter()
            .filter_map(FigureItem::bounds)
            .map(Rect::width_mm)
            .fold(0.0, f64::max);
        column.bounds.width_mm().max(head) + 2.0 * AIR_MM
    }

    /// Draws the figures, one for each page.
    ///
    /// # Errors
    /// `paper-too-small` if the paper does not hold one row.
    pub(super) fn pages(&self, paper: Option<[f64; 2]>) -> Result<Vec<Figure>, Faults> {
        let columns = self.columns();
        let row_mm =
            columns.iter().map(|c| c.bounds.height_mm()).fold(0.0, f64::max) + 2.0 * AIR_MM;
        let width_mm = NAME_MM + columns.iter().map(|c| self.wide_mm(c)).sum::<f64>();
        let count = self.rows.len();
        let keys = self.keys(&columns, width_mm);
        let keys_mm = keys.as_ref().map_or(0.0, |keys| keys.bounds.height_mm() + KEYS_MM);
        let size = |across: usize, down: usize| {
            [
                across as f64 * width_mm + 2.0 * MARGIN_MM,
                TITLE_MM + HEAD_MM + down as f64 * row_mm + keys_mm + 2.0 * MARGIN_MM,
            ]
        };
        let (across, down, size_mm) = match paper {
            Some([w, h]) => {
                let [one_w, one_h] = size(1, 1);
                if one_w > w || one_h > h {
                    let d = Diagnostic::error(
                        "paper-too-small",
                        both!(
                            "a row of the sheet needs {one_w:.0} mm by {one_h:.0} mm, the paper has {w} by {h}"
                        ),
                    );
                    return Err(d
                        .help(both!(
                            "give a larger paper, leave its size to the sheet, or ask for less"
                        ))
                        .into());
                }
                let across = ((w - 2.0 * MARGIN_MM) / width_mm) as usize;
                (across, ((h - one_h) / row_mm) as usize + 1, [w, h])
            }
            None => {
                let (across, down, size_mm) = choose(&size, width_mm, row_mm, count);
                // A page that is not full is no larger than its content.
                if count > across * down {
                    (across, down, size_mm)
                } else {
                    (across.min(count), down, size(across.min(count), count.div_ceil(across)))
                }
            }
        };
        let per_page = across * down;
        let pages = (0..count).step_by(per_page).map(|first| {
            let rows = first..count.min(first + per_page);
            let page = PosePage {
                table: self,
                columns: &columns,
                keys: keys.as_ref(),
                row_mm,
                width_mm,
                size_mm,
                across,
                down: down.min(rows.len()),
            };
            page.figure(rows, count.div_ceil(per_page))
        });
        Ok(pages.collect())
    }
}

/// Chooses the numbers of rows side by side and one below the other on a printer's paper: the
/// smallest paper that holds several rows, in the orientation with fewer pages; or a sheet of one
/// row if even the largest paper is too small.
fn choose(
    size: &dyn Fn(usize, usize) -> [f64; 2],
    width_mm: f64,
    row_mm: f64,
    count: usize,
) -> (usize, usize, [f64; 2]) {
    let [one_w, one_h] = size(1, 1);
    let on = |[w, h]: [f64; 2]| {
        let (more_across, more_down) = ((w - one_w) / width_mm, (h - one_h) / row_mm);
        (more_across >= 0.0 && more_down >= 0.0)
            .then(|| (more_across as usize + 1, more_down as usize + 1, [w, h]))
    };
    let holds =
        |(across, down, _): &(usize, usize, [f64; 2])| across * down >= ROWS_LEAST.min(count);
    let formats = PAPERS.into_iter().filter_map(|[a, b]| {
        let ways = [[a, b], [b, a]].into_iter().filter_map(on).filter(holds);
        ways.min_by_key(|(across, down, _)| count.div_ceil(across * down))
    });
    formats.into_iter().next().unwrap_or((1, 1, [one_w, one_h]))
}

/// A page under construction.
struct PosePage<'a> {
    table: &'a PoseTable<'a>,
    columns: &'a [PoseColumn],
    /// The key below the table.
    keys: Option<&'a DrawingPart>,
    row_mm: f64,
    width_mm: f64,
    size_mm: [f64; 2],
    across: usize,
    down: usize,
}

impl PosePage<'_> {
    fn figure(&self, rows: std::ops::Range<usize>, pages: usize) -> Figure {
        let table = self.table;
        let maker = table.maker();
        let lang = table.options.lang;
        let across = self.across.min(rows.len().div_ceil(self.down));
        let left = (self.size_mm[0] - across as f64 * self.width_mm) / 2.0;
        let top = self.size_mm[1] - MARGIN_MM - TITLE_MM;
        let mut items = Vec::new();
        if let Some(mut title) = maker.title() {
            let x = (self.size_mm[0] - title.bounds.width_mm()) / 2.0;
            title.stand_at(Point::new(x, self.size_mm[1] - MARGIN_MM));
            items.extend(title.items);
        }
        for block in 0..across {
            let x = left + block as f64 * self.width_mm;
            let mine: Vec<usize> = rows.clone().skip(block * self.down).take(self.down).collect();
            items.extend(self.head(block, x, top, mine.len()));
            for (k, row) in mine.into_iter().enumerate() {
                let y = top - HEAD_MM - (k as f64 + 0.5) * self.row_mm;
                items.extend(self.name(row, Point::new(x + NAME_MM / 2.0, y)));
                let mut edge = x + NAME_MM;
                for column in self.columns {
                    let wide = table.wide_mm(column);
                    let mut part = column.parts[row].clone();
                    let middle = if part.items.iter().any(|i| i.class == "absent") {
                        part.bounds.centre()
                    } else {
                        column.bounds.centre()
                    };
                    part.translate(Point::new(edge + wide / 2.0, y) - middle);
                    items.extend(part.items);
                    edge += wide;
                }
            }
        }
        if let Some(mut keys) = self.keys.cloned() {
            let rows = self.down.min(rows.len()) as f64;
            keys.stand_at(Point::new(left, top - HEAD_MM - rows * self.row_mm - KEYS_MM));
            items.extend(keys.items);
        }
        let mut figure = maker.figure(items, self.size_mm);
        if pages > 1 {
            let (first, last) = (rows.start + 1, rows.end);
            let positions = tr!(lang, "positions");
            figure.title = format!("{} · {positions} {first}–{last}", figure.title);
        }
        let driver = swept_symbol(&table.rows[0].scene, table.swept).0;
        let words = tr!(
            lang,
            "The mechanism with its velocity and acceleration polygons in {} positions at equal steps of {1}, all to the same scales."
        );
        figure.desc = fill(words, &[("", &table.rows.len().to_string()), ("1", &formula(&driver))]);
        figure
    }

    /// The rules and the head of a block of rows.
    fn head(&self, block: usize, x: f64, top: f64, rows: usize) -> Vec<FigureItem> {
        let table = self.table;
        let (style, lang) = (&table.options.style, table.options.lang);
        let bottom = top - HEAD_MM - rows as f64 * self.row_mm;
        let mut items = Vec::new();
        let mut line = |from: Point, to: Point, stroke: LineStroke| {
            let id = format!("rule-{block}-{}", items.len());
            items.push(FigureItem::new("rule", Shape::Line { from, to, stroke }).with_id(id));
        };
        let mut edges = vec![x, x + NAME_MM];
        for column in self.columns {
            edges.push(edges[edges.len() - 1] + table.wide_mm(column));
        }
        for (k, edge) in edges.iter().enumerate() {
            let outer = k == 0 || k + 1 == edges.len();
            line(
                Point::new(*edge, top),
                Point::new(*edge, bottom),
                if outer { style.outline } else { style.thin },
            );
        }
        let right = x + self.width_mm;
        for k in 0..=rows + 1 {
            let y = if k == 0 { top } else { top - HEAD_MM - (k - 1) as f64 * self.row_mm };
            let heavy = k < 2 || k == rows + 1;
            line(
                Point::new(x, y),
                Point::new(right, y),
                if heavy { style.outline } else { style.thin },
            );
        }
        let scene = &table.rows[0].scene;
        let (driver, kind) = swept_symbol(scene, table.swept);
        let unit = scene.book.fine(kind).0;
        let first = Label::text(tr!(lang, "Position"));
        let mut heads = vec![(first, over(&driver, &unit))];
        heads.extend(self.columns.iter().map(|column| table.head(column)));
        for (k, head) in heads.into_iter().enumerate() {
            let middle = (edges[k] + edges[k + 1]) / 2.0;
            let named =
                table.head_items(head, Point::new(middle, top)).into_iter().zip(["name", "scale"]);
            items
                .extend(named.map(|(item, what)| item.with_id(format!("head-{what}-{block}-{k}"))));
        }
        items
    }

    /// The name of the pose in a row.
    fn name(&self, row: usize, at: Point) -> Vec<FigureItem> {
        let style = &self.table.options.style;
        let value = self.table.position(row);
        vec![
            text(
                "position",
                at + Vec2::new(0.0, 1.5),
                Label::math((row + 1).to_string()),
                style.caption_mm * 1.5,
                Anchor::Middle,
            )
            .with_id(format!("position-{}", row + 1))
            .in_fonts(&style.fonts),
            text(
                "position",
                at - Vec2::new(0.0, 5.5),
                Label::math(value),
                style.small_mm,
                Anchor::Middle,
            )
            .with_id(format!("position-{}-driver", row + 1))
            .in_fonts(&style.fonts),
        ]
    }
}
