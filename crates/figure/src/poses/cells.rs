//! Fills the cells of a sheet of poses: each cell has a drawing, as on any other sheet, with ground
//! or pole at the same place of its cell, so that neighbouring poses can be compared. In a table
//! only the first drawing of a column with enough space has all its names; the others have the
//! letters of their points. If no polygon has the space, a key below the table lists the names.

use super::{PoseRow, PoseTable, text};
use crate::arrange::{Tree, put_together};
use crate::course::courses;
use crate::hodograph::runs;
use crate::sheet::SheetOptions;
use crate::{mechanism, polygon};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::tr;
use hodograph_board::construct::Polygon;
use hodograph_board::plan::text::PlanWriter;
use hodograph_paper::paper::drawing::{DrawingPart, Habits};
use hodograph_paper::paper::extent::Rect;
use hodograph_paper::paper::item::{Anchor, Colour, Dash, FigureItem, LineStroke, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::shown::escaped;
use hodograph_scene::{DiagramKind, Scene};
use hodograph_worked::worked::Worked;

/// Colour of curves behind polygons.
const BEHIND: Colour = Colour::grey(150);

/// A column: a diagram for each row, and the box that holds each of them with ground or pole at the
/// same place.
pub(super) struct PoseColumn {
    pub on: DiagramKind,
    pub parts: Vec<DrawingPart>,
    pub bounds: Rect,
    /// True if one drawing has all its names.
    pub named: bool,
}

impl PoseTable<'_> {
    /// The columns that the scales allow.
    pub(super) fn columns(&self) -> Vec<PoseColumn> {
        let drawn =
            DiagramKind::OF_MOTION.into_iter().filter(|on| self.scales.mu.get(on.kind()).is_some());
        drawn
            .map(|on| {
                let (parts, named) = self.parts(on);
                let all = parts
                    .iter()
                    .filter(|p| !p.items.is_empty())
                    .map(|p| p.bounds)
                    .reduce(Rect::union);
                PoseColumn {
                    on,
                    parts,
                    bounds: all.unwrap_or(Rect::new(Point::ORIGIN, Point::ORIGIN)),
                    named,
                }
            })
            .collect()
    }

    /// A row's polygon, if it is on the paper, and the writer of its letters.
    fn polygon<'a>(
        &'a self,
        row: &'a PoseRow,
        on: DiagramKind,
    ) -> Option<(PlanWriter<'a>, &'a Polygon)> {
        let shown = !row.unbounded() && row.shown.contains(&on);
        let p = row.worked.construction.polygon(on).filter(|_| shown)?;
        let SheetOptions { notation, lang, .. } = self.options;
        Some((PlanWriter { scene: &row.scene, plan: &row.worked.plan, notation, lang: *lang }, p))
    }

    /// The names of the vectors of all polygons that have no space for them, below one another.
    pub(super) fn keys(&self, columns: &[PoseColumn], width_mm: f64) -> Option<DrawingPart> {
        let crowded = columns.iter().filter(|column| !column.named && !self.still);
        let key = |column: &PoseColumn| {
            let polygons = self.rows.iter().filter_map(|row| self.polygon(row, column.on));
            polygon::series_key(&self.options.style, polygons, width_mm)
        };
        let keys: Vec<DrawingPart> = crowded.filter_map(key).collect();
        let tree = Tree::text_column((0..keys.len()).map(Tree::Leaf).collect());
        (!keys.is_empty()).then(|| put_together(tree, keys))
    }

    /// The drawings of all rows, and true if one of them has all its names.
    fn parts(&self, on: DiagramKind) -> (Vec<DrawingPart>, bool) {
        let SheetOptions { style, notation, .. } = self.options;
        let poses: Vec<(&Scene, &Worked)> =
            self.rows.iter().map(|r| (&r.scene, &r.worked)).collect();
        let courses = courses(&poses, style, notation);
        let behind = self.behind(on);
        let full = self
            .rows
            .iter()
            .filter_map(|row| self.polygon(row, on))
            .any(|(w, p)| polygon::is_full(&w, p));
        let (mut habits, mut of_polygon) = (Habits::new(), Habits::new());
        let mut parts = Vec::new();
        let mut named = false;
        for (k, row) in self.rows.iter().enumerate() {
            let mut part = match on {
                DiagramKind::Plane => {
                    let mut drawing =
                        mechanism::drawing(style, &row.scene, &row.worked, notation, &courses[k]);
                    if named && !self.still {
                        drawing.letters_only();
                    }
                    named = true;
                    let mut part = drawing.finish_after(&mut habits);
                    // The diagram's origin may be a moving point.
                    let (here, first) = (
                        &row.worked.construction.diagram,
                        &self.rows[0].worked.construction.diagram,
                    );
                    part.translate((here.origin - first.origin) * (1.0 / first.mu));
                    part
                }
                DiagramKind::Velocity | DiagramKind::Acceleration | DiagramKind::Force => {
                    match self.polygon(row, on) {
                        // An inset would take more space than the pose.
                        Some((w, p)) if self.still => {
                            polygon::drawing(style, &w, p, full).finish_after(&mut of_polygon)
                        }
                        Some((w, p)) => {
                            let drawing = || polygon::drawing(style, &w, p, full);
                            let whole = (!named && fits_names(p)).then(|| drawing().finish());
                            let whole = whole.filter(|part| !polygon::is_crowded(part));
                            named |= whole.is_some();
                            whole.unwrap_or_else(|| {
                                let mut drawing = drawing();
                                drawing.letters_only();
                                drawing.finish()
                            })
                        }
                        None => DrawingPart::of(self.absent(row)),
                    }
                }
            };
            if !behind.is_empty() {
                part = DrawingPart::of(behind.iter().cloned().chain(part.items).collect());
            }
            for item in &mut part.items {
                let word = if item.id == "absent" {
                    format!("absent-{}", on.word())
                } else {
                    item.id.clone()
                };
                item.id = format!("pose-{}-{word}", k + 1);
            }
            parts.push(part);
        }
        (parts, named)
    }

    /// The text in place of a missing polygon.
    fn absent(&self, row: &PoseRow) -> Vec<FigureItem> {
        let lang = self.options.lang;
        let said = if row.unbounded() {
            tr!(lang, "limit: unbounded")
        } else {
            tr!(lang, "too large for the paper")
        };
        let style = &self.options.style;
        let said = text("absent", Point::ORIGIN, Label::text(said), style.small_mm, Anchor::Middle)
            .with_id("absent");
        vec![said.in_fonts(&style.fonts)]
    }

    /// Paths behind the mechanism, hodographs behind the polygons; they are the same in all rows.
    fn behind(&self, on: DiagramKind) -> Vec<FigureItem> {
        let (Some(moved), Some(first)) = (self.moved, self.rows.first()) else { return Vec::new() };
        let stroke = LineStroke { dash: Dash::Solid, ..self.options.style.thin.coloured(BEHIND) };
        let mut items = Vec::new();
        for (k, point) in moved.points.iter().enumerate() {
            let name = first.scene.point_name(*point);
            let lines: Vec<Vec<Point>> = match on {
                DiagramKind::Plane => {
                    let diagram = &first.worked.construction.diagram;
                    let paper = |p: Point| ((p - diagram.origin) * (1.0 / diagram.mu)).to_point();
                    let places =
                        moved.moments.iter().chain(moved.moments.first().filter(|_| moved.full));
                    vec![
                        places.filter_map(|m| m.configuration.points[point.0]).map(paper).collect(),
                    ]
                }
                DiagramKind::Velocity | DiagramKind::Acceleration | DiagramKind::Force => {
                    let Some(mu) = self.scales.mu.get(on.kind()) else { continue };
                    let curve: Vec<Option<Vec2>> =
                        moved.moments.iter().map(|m| m.vector(k, on.level())).collect();
                    let paper = |v: &Vec2| (*v * (1.0 / mu)).to_point();
                    // As far as the polygons extend.
                    let most = self.scales.longest_mm() * mu;
                    runs(&curve, moved.full, most)
                        .0
                        .iter()
                        .map(|run| run.iter().map(paper).collect())
                        .collect()
                }
            };
            for (n, points) in lines.into_iter().enumerate() {
                let shape =
                    Shape::Polyline { points, closed: false, stroke: Some(stroke), fill: None };
                items.push(FigureItem::new("curve", shape).with_id(format!(
                    "{}-curve-{}-{n}",
                    on.prefix(),
                    escaped(name)
                )));
            }
        }
        items
    }
}

/// True if the vectors of a polygon are long enough for their names.
fn fits_names(p: &Polygon) -> bool {
    let lengths = p.edges.iter().map(|e| e.from.1.distance(e.to.1));
    lengths.sum::<f64>() >= NAMED_MM * p.edges.len() as f64
}

/// Mean length of vectors that have their names beside them.
const NAMED_MM: f64 = 12.0;
