//! A raster of the paper: small cells that ink, labels and areas fill.
//!
//! The time of a query is proportional to the number of cells in question, independent of the
//! amount of ink.

use crate::paper::extent::Rect;
use hodograph_base::geom::{Point, Vec2};

use super::cost;
use super::obstacle::Obstacles;

/// Side of a cell: a third of the smallest letter's height, or a line's width and the gap beside
/// it.
pub(super) const CELL_MM: f64 = 0.5;
/// Largest number of cells along a side; on a large paper the cells are larger.
const ACROSS: usize = 2000;
/// Flag of a cell with a line in it.
pub(super) const LINE: u8 = 1;
/// Flag of a cell with an arrowhead, a symbol or another label.
pub(super) const HEAVY: u8 = 2;
/// Flag of a cell of a plate or a wheel, which lines may cross.
const AREA: u8 = 4;

/// The contents of the paper's cells.
#[derive(Debug)]
pub struct InkRaster {
    corner: Point,
    cell_mm: f64,
    columns: usize,
    rows: usize,
    cells: Vec<u8>,
    /// Number of cells examined or filled.
    touched: usize,
}

impl InkRaster {
    fn new(paper: Rect) -> InkRaster {
        let side = paper.width_mm().max(paper.height_mm());
        let cell_mm = CELL_MM.max(side / ACROSS as f64);
        let count = |mm: f64| (mm / cell_mm).ceil().clamp(1.0, ACROSS as f64 + 1.0) as usize;
        let (columns, rows) = (count(paper.width_mm()), count(paper.height_mm()));
        InkRaster {
            corner: paper.min,
            cell_mm,
            columns,
            rows,
            cells: vec![0; columns * rows],
            touched: 0,
        }
    }

    /// Returns the raster of a paper with these obstacles.
    pub fn of(obstacles: &Obstacles, paper: Rect) -> InkRaster {
        let mut raster = InkRaster::new(paper);
        raster.add(obstacles);
        raster
    }

    /// Marks the cells that further obstacles cover.
    pub fn add(&mut self, obstacles: &Obstacles) {
        for bar in &obstacles.bars {
            self.fill_bar(bar.from, bar.to, bar.half_width_mm, LINE);
        }
        for head in &obstacles.heads {
            self.fill_bar(head.from, head.to, head.half_width_mm, HEAVY);
        }
        for disc in &obstacles.discs {
            self.fill(Rect::new(disc.centre, disc.centre).grown(disc.radius_mm), HEAVY);
        }
        for rect in &obstacles.rects {
            self.fill(*rect, HEAVY);
        }
    }

    /// Marks the inside of a convex outline.
    pub fn add_area(&mut self, corners: &[Point]) {
        for row in 0..self.rows {
            let y = self.corner.y + (row as f64 + 0.5) * self.cell_mm;
            let mut reach: Option<[f64; 2]> = None;
            for (k, a) in corners.iter().enumerate() {
                let b = corners[(k + 1) % corners.len()];
                if (a.y <= y) != (b.y <= y) {
                    let x = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
                    reach = Some(reach.map_or([x, x], |[low, high]| [low.min(x), high.max(x)]));
                }
            }
            if let Some([low, high]) = reach {
                self.fill(Rect::new(Point::new(low, y), Point::new(high, y)), AREA);
            }
        }
    }

    /// Marks the inside of a circle.
    pub fn add_disc(&mut self, centre: Point, radius_mm: f64) {
        let [_, _, low, high] = self.range(Rect::new(centre, centre).grown(radius_mm));
        for row in low..high {
            let y = self.corner.y + (row as f64 + 0.5) * self.cell_mm;
            let half = (radius_mm * radius_mm - (y - centre.y) * (y - centre.y)).max(0.0).sqrt();
            self.fill(
                Rect::new(Point::new(centre.x - half, y), Point::new(centre.x + half, y)),
                AREA,
            );
        }
    }

    /// Number of cells examined or filled so far, as a measure of work.
    pub fn touched(&self) -> usize {
        self.touched
    }

    pub(super) fn cell_mm(&self) -> f64 {
        self.cell_mm
    }

    /// Counts the cells of a box that contain only a line, and those that contain something heavy.
    pub(super) fn covered(&mut self, rect: Rect) -> (usize, usize) {
        let [from, to, low, high] = self.range(rect);
        let (mut lines, mut heavy) = (0usize, 0usize);
        for row in low..high {
            for cell in &self.cells[row * self.columns..][from.min(to)..to] {
                heavy += usize::from(cell & HEAVY != 0);
                lines += usize::from(*cell == LINE);
            }
            self.touched += to.saturating_sub(from);
        }
        (lines, heavy)
    }

    /// Returns the content of the cell at a point; empty off the paper.
    fn at(&mut self, p: Point) -> u8 {
        self.touched += 1;
        let d = p - self.corner;
        let (column, row) = ((d.x / self.cell_mm).floor(), (d.y / self.cell_mm).floor());
        let on_paper =
            column >= 0.0 && row >= 0.0 && column < self.columns as f64 && row < self.rows as f64;
        if on_paper { self.cells[row as usize * self.columns + column as usize] } else { 0 }
    }

    /// Returns true if a box in any direction, given by its corners in order, is empty.
    pub fn is_free(&mut self, [a, b, c, d]: [Point; 4]) -> bool {
        let steps = |p: Point, q: Point| (p.distance(q) / self.cell_mm).ceil().max(1.0);
        let (along, across) = (steps(a, b), steps(a, d));
        let part = |p: Point, q: Point, t: f64| p + (q - p) * t;
        (0..=along as usize).all(|i| {
            let (low, high) = (part(a, b, i as f64 / along), part(d, c, i as f64 / along));
            (0..=across as usize).all(|j| self.at(part(low, high, j as f64 / across)) == 0)
        })
    }

    /// Returns the number of times a line enters ink on its way, and whether it passes over an
    /// area.
    pub fn met_on(&mut self, from: Point, to: Point) -> (usize, bool) {
        let Some((from, to)) = cost::clipped(from, to, self.paper()) else { return (0, false) };
        let steps = (from.distance(to) / self.cell_mm).ceil().max(1.0);
        let (mut met, mut over, mut before) = (0, false, false);
        for k in 0..=steps as usize {
            let cell = self.at(from + (to - from) * (k as f64 / steps));
            let here = cell & (LINE | HEAVY) != 0;
            met += usize::from(here && !before);
            over |= cell & AREA != 0;
            before = here;
        }
        (met, over)
    }

    fn paper(&self) -> Rect {
        Rect {
            min: self.corner,
            max: self.corner + Vec2::new(self.columns as f64, self.rows as f64) * self.cell_mm,
        }
    }

    /// Returns the cells of a box that are on the paper: columns and rows, end exclusive.
    fn range(&self, rect: Rect) -> [usize; 4] {
        let index =
            |mm: f64, most: usize| (mm / self.cell_mm).floor().max(0.0).min(most as f64) as usize;
        let [a, b] = [rect.min, rect.max].map(|p| p - self.corner);
        let end = |mm: f64, most: usize| if mm < 0.0 { 0 } else { (index(mm, most) + 1).min(most) };
        [
            index(a.x, self.columns),
            end(b.x, self.columns),
            index(a.y, self.rows),
            end(b.y, self.rows),
        ]
    }

    pub(super) fn fill(&mut self, rect: Rect, with: u8) {
        let [from, to, low, high] = self.range(rect);
        for row in low..high {
            for cell in &mut self.cells[row * self.columns..][from.min(to)..to] {
                *cell |= with;
            }
            self.touched += to.saturating_sub(from);
        }
    }

    pub(super) fn fill_bar(&mut self, from: Point, to: Point, half_width_mm: f64, with: u8) {
        let Some((from, to)) = cost::clipped(from, to, self.paper()) else { return };
        let steps = (from.distance(to) / self.cell_mm).ceil().max(1.0);
        for k in 0..=steps as usize {
            let at = from + (to - from) * (k as f64 / steps);
            self.fill(Rect::new(at, at).grown(half_width_mm), with);
        }
    }
}
