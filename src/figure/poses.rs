//! The sheet of many poses: for each of them the mechanism with its velocity and acceleration polygon, all to one set of scales,
//! in the rows of a table, as in a course's design work.
//!
//! Decided here: which poses there are, what a row holds, and how many rows stand side by side. A drawing is that of any other
//! sheet; ground and poles stand at one place of their cells, so that neighbouring poses can be compared.

use crate::construct::Polygon;
use crate::construct::scale::Boxes;
use crate::diag::{Diagnostic, Faults, Warned};
use crate::geom::{Point, Vec2};
use crate::mechanism::Level;
use crate::plan::text::Writer;
use crate::quantity::{inked, shortest};
use crate::report::phrase::tr;
use crate::scene::{PointId, Scene};
use crate::sweep::follow::{Follower, Pose, scene_at};
use crate::sweep::points::{Motion, at_equal_steps, motion};
use crate::sweep::station::position_now;
use crate::worked::{Worked, work_placed};

use super::arrange::AIM_MM;
use super::course::courses;
use super::drawing::{Habits, Part};
use super::extent::Rect;
use super::hodograph::runs;
use super::item::{Anchor, Colour, Dash, Figure, Item, Shape, Stroke};
use super::label::Label;
use super::path::turned;
use super::series::{LEVELS, Scales};
use super::sheet::{MARGIN_MM, Maker, Options, Single, driver_symbol};
use super::style::Style;
use super::{mechanism, polygon};

/// Steps in which the mechanism is followed through a turn: 2°.
const STEPS: usize = 180;
/// Room for the drawings of one pose: a row of three is about as wide as A4 across, and twelve of them are A1.
const BOXES: Boxes = Boxes { diagram: [90.0, 80.0], polygon: [95.0, 80.0] };
/// Air around a drawing in its cell.
const AIR_MM: f64 = 3.5;
/// Width of the column that says which pose a row shows, and height of the table's head.
const NAME_MM: f64 = 26.0;
const HEAD_MM: f64 = 15.0;
/// Below the title.
const TITLE_MM: f64 = 14.0;
/// Curves behind polygons stand back.
const BEHIND: Colour = Colour::grey(150);

/// What is on the sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// So many poses at equal steps of the driver: from the scene's own through a full turn, or from one end of its travel to the
    /// other.
    pub count: usize,
    /// Which driver moves, from 0 on; the others stand at their places, with their rates.
    pub driver: usize,
    /// Points whose paths and hodographs lie behind the drawings.
    pub points: Vec<PointId>,
}

/// The sheet; several pages where the scene fixes the size of its paper.
///
/// # Errors
/// `no-motion` where the mechanism cannot be followed from its pose; `paper-too-small` where the paper does not hold one row.
///
/// ```
/// use hodograph::figure::{poses, sheet::Options};
/// use hodograph::scene::{self, Lang, templates};
/// use hodograph::worked::{Scope, work};
/// let scene = scene::read(templates::get("slider-crank").unwrap())?.value;
/// let worked = work(&scene, Scope::Figure)?.value;
/// let wanted = poses::Wanted { count: 4, driver: 0, points: Vec::new() };
/// let pages = poses::sheets(&scene, &worked, &Options::of_language(Lang::En), &wanted)?.value;
/// assert_eq!(pages.len(), 1);
/// # Ok::<(), hodograph::diag::Faults>(())
/// ```
pub fn sheets(scene: &Scene, worked: &Worked, options: &Options, wanted: &Wanted) -> Result<Warned<Vec<Figure>>, Faults> {
    let follower = Follower::new(scene, &worked.mechanism, &worked.demand, &worked.configuration, wanted.driver);
    let sweep = follower.sweep(STEPS);
    let poses = at_equal_steps(&follower, &sweep, wanted.count);
    let work = |scene: &Scene, pose: &Pose| {
        let (m, demand) = (worked.mechanism.clone(), worked.demand.clone());
        work_placed(scene, m, demand, pose.configuration.clone()).ok().map(|w| w.value)
    };
    // Their own scales first, to see how large everything is.
    let trials: Vec<(&Pose, Worked)> =
        poses.iter().filter_map(|p| Some((p, work(&scene_at(scene, wanted.driver, p.travel), p)?))).collect();
    let sized: Vec<(f64, &Worked)> = trials.iter().map(|(p, w)| (p.travel, w)).collect();
    let scales = Scales::of(&scene.paper, &sized, sweep.full, BOXES);
    let now = position_now(scene, &worked.configuration, wanted.driver);
    let rows: Vec<Row> = trials
        .iter()
        .filter_map(|(pose, trial)| {
            let end = sweep.limits.iter().flatten().any(|limit| *limit == pose.travel);
            let mut scene = scene_at(scene, wanted.driver, pose.travel);
            scales.fix(&mut scene.paper);
            let worked = work(&scene, pose)?;
            let shown = LEVELS.map(|level| scales.holds(trial, level));
            let driver = now + pose.travel;
            Some(Row { scene, worked, shown, end, driver })
        })
        .collect();
    // A table has at least one row.
    if rows.is_empty() || rows.len() < 2 && wanted.count > 1 {
        let d = Diagnostic::error("no-motion", "the mechanism cannot be followed from its pose");
        return Err(d.help("give another pose, or ask for the sheet of this one").into());
    }
    let moved = (!wanted.points.is_empty())
        .then(|| motion(scene, &worked.mechanism, &worked.demand, &worked.configuration, wanted.driver, &wanted.points, 0));
    let style = Style { label_mm: options.style.small_mm, ..options.style.clone() };
    let options = Options { style, ..options.clone() };
    let table = Table { options: &options, rows: &rows, full: sweep.full, driver: wanted.driver, moved, scales };
    let pages = table.pages(scene.paper.size_mm)?;
    let mut notes = Vec::new();
    if rows.len() < wanted.count {
        notes.push(Diagnostic::note("poses", format!("{} of {} poses can be drawn", rows.len(), wanted.count)));
    }
    if scene.drivers.len() > 1 {
        let text = "the scene has several drivers: one of them moves from pose to pose, the others hold their positions, with their rates";
        notes.push(Diagnostic::note("poses-driver", text));
    }
    Ok(Warned { value: pages, notes })
}

/// A pose to the common scales.
struct Row {
    scene: Scene,
    worked: Worked,
    shown: [bool; 2],
    /// Whether the driver can go no farther: then nothing but the driver has a vector, and that is no polygon.
    end: bool,
    /// Where the driver stands (rad or m).
    driver: f64,
}

impl Row {
    fn unbounded(&self) -> bool {
        self.end || !self.worked.solution.refused.is_empty()
    }
}

struct Table<'a> {
    options: &'a Options,
    rows: &'a [Row],
    full: bool,
    driver: usize,
    moved: Option<Motion>,
    scales: Scales,
}

/// What a column shows.
#[derive(Clone, Copy, PartialEq)]
enum Shows {
    Mechanism,
    Polygon(Level),
}

impl Shows {
    /// In one word, for names.
    fn word(self) -> &'static str {
        match self {
            Shows::Mechanism => "mechanism",
            Shows::Polygon(Level::Acceleration) => "acceleration",
            Shows::Polygon(_) => "velocity",
        }
    }
}

/// A column: a drawing for each row, and the box that holds each of them with ground or pole at one place.
struct Column {
    shows: Shows,
    parts: Vec<Part>,
    bounds: Rect,
}

impl Table<'_> {
    /// Titles and captions are those of any pose, and nothing of the results is shown.
    fn maker(&self) -> Maker<'_> {
        let first = &self.rows[0];
        Maker { scene: &first.scene, worked: &first.worked, options: self.options, certified: Vec::new() }
    }

    fn pages(&self, paper: Option<[f64; 2]>) -> Result<Vec<Figure>, Faults> {
        let columns = self.columns();
        let row_mm = columns.iter().map(|c| c.bounds.height_mm()).fold(0.0, f64::max) + 2.0 * AIR_MM;
        let width_mm = NAME_MM + columns.iter().map(|c| c.bounds.width_mm() + 2.0 * AIR_MM).sum::<f64>();
        let count = self.rows.len();
        let size = |across: usize, down: usize| {
            [across as f64 * width_mm + 2.0 * MARGIN_MM, TITLE_MM + HEAD_MM + down as f64 * row_mm + 2.0 * MARGIN_MM]
        };
        let (across, down, size_mm) = match paper {
            Some([w, h]) => {
                let [one_w, one_h] = size(1, 1);
                if one_w > w || one_h > h {
                    let d = Diagnostic::error(
                        "paper-too-small",
                        format!("a row of the sheet needs {one_w:.0} mm by {one_h:.0} mm, the paper has {w} by {h}"),
                    );
                    return Err(d.help("give a larger paper, leave its size to the sheet, or ask for less").into());
                }
                let across = ((w - 2.0 * MARGIN_MM) / width_mm) as usize;
                (across, ((h - one_h) / row_mm) as usize + 1, [w, h])
            }
            None => {
                // Of the format of all paper, upright or across, as nearly as may be.
                let larger = |across: &usize| {
                    let [w, h] = size(*across, count.div_ceil(*across));
                    (w.max(h) / AIM_MM[0]).max(w.min(h) / AIM_MM[1])
                };
                let across = (1..=count).min_by(|a, b| larger(a).total_cmp(&larger(b))).unwrap_or(1);
                let down = count.div_ceil(across);
                (across, down, size(across, down))
            }
        };
        let per_page = across * down;
        let pages = (0..count).step_by(per_page).map(|first| {
            let rows = first..count.min(first + per_page);
            let page = Page { table: self, columns: &columns, row_mm, width_mm, size_mm, across, down: down.min(rows.len()) };
            page.figure(rows, count.div_ceil(per_page))
        });
        Ok(pages.collect())
    }

    fn columns(&self) -> Vec<Column> {
        let levels = LEVELS.into_iter().zip(self.scales.mu).filter(|(_, mu)| mu.is_some());
        let shows = std::iter::once(Shows::Mechanism).chain(levels.map(|(level, _)| Shows::Polygon(level)));
        shows
            .map(|shows| {
                let parts = self.parts(shows);
                let all = parts.iter().filter(|p| !p.items.is_empty()).map(|p| p.bounds).reduce(Rect::union);
                Column { shows, parts, bounds: all.unwrap_or(Rect::new(Point::ORIGIN, Point::ORIGIN)) }
            })
            .collect()
    }

    /// A row's polygon, where it is on the paper, and who writes its letters.
    fn polygon<'a>(&'a self, row: &'a Row, shows: Shows) -> Option<(Writer<'a>, &'a Polygon)> {
        let Shows::Polygon(level) = shows else { return None };
        let shown = !row.unbounded() && row.shown[usize::from(level == Level::Acceleration)];
        let p = row.worked.construction.polygon(level).filter(|_| shown)?;
        let Options { notation, lang, .. } = self.options;
        Some((Writer { scene: &row.scene, plan: &row.worked.plan, notation, lang: *lang }, p))
    }

    fn parts(&self, shows: Shows) -> Vec<Part> {
        let Options { style, notation, .. } = self.options;
        let poses: Vec<(&Scene, &Worked)> = self.rows.iter().map(|r| (&r.scene, &r.worked)).collect();
        let courses = courses(&poses, style, notation);
        let behind = self.behind(shows);
        let full = self.rows.iter().filter_map(|row| self.polygon(row, shows)).any(|(w, p)| polygon::is_full(&w, p));
        let mut habits = Habits::new();
        let mut parts = Vec::new();
        for (k, row) in self.rows.iter().enumerate() {
            let mut part = match shows {
                Shows::Mechanism => {
                    let drawing = mechanism::drawing(style, &row.scene, &row.worked, notation, &courses[k]);
                    let mut part = drawing.finish_after(&mut habits);
                    // The diagram's origin may be a point that moves.
                    let (here, first) = (&row.worked.construction.diagram, &self.rows[0].worked.construction.diagram);
                    part.translate((here.origin - first.origin) * (1.0 / first.mu_l));
                    part
                }
                Shows::Polygon(_) => {
                    match self.polygon(row, shows) {
                        Some((w, p)) => {
                            // An inset would take more room than the pose.
                            polygon::drawing(style, &w, p, full).finish()
                        }
                        None => Part::of(self.absent(row)),
                    }
                }
            };
            if !behind.is_empty() {
                part = Part::of(behind.iter().cloned().chain(part.items).collect());
            }
            for item in &mut part.items {
                let word = if item.id == "absent" { format!("absent-{}", shows.word()) } else { item.id.clone() };
                item.id = format!("pose-{}-{word}", k + 1);
            }
            parts.push(part);
        }
        parts
    }

    /// What stands where there is no polygon.
    fn absent(&self, row: &Row) -> Vec<Item> {
        let lang = self.options.lang;
        let said = if row.unbounded() {
            tr(lang, "limit: unbounded", "极限位置：无穷大")
        } else {
            tr(lang, "too large for the paper", "超出图纸")
        };
        vec![text("absent", Point::ORIGIN, Label::text(said), self.options.style.small_mm, Anchor::Middle).with_id("absent")]
    }

    /// Paths behind the mechanism, hodographs behind the polygons: they are the same in all rows.
    fn behind(&self, shows: Shows) -> Vec<Item> {
        let (Some(moved), Some(first)) = (&self.moved, self.rows.first()) else { return Vec::new() };
        let stroke = Stroke { dash: Dash::Solid, ..self.options.style.thin.coloured(BEHIND) };
        let mut items = Vec::new();
        for (k, point) in moved.points.iter().enumerate() {
            let name = first.scene.point_name(*point);
            let lines: Vec<Vec<Point>> = match shows {
                Shows::Mechanism => {
                    let diagram = &first.worked.construction.diagram;
                    let paper = |p: Point| ((p - diagram.origin) * (1.0 / diagram.mu_l)).to_point();
                    let places = moved.moments.iter().chain(moved.moments.first().filter(|_| moved.full));
                    vec![places.filter_map(|m| m.configuration.points[point.0]).map(paper).collect()]
                }
                Shows::Polygon(level) => {
                    let l = usize::from(level == Level::Acceleration);
                    let Some(mu) = self.scales.mu[l] else { continue };
                    let curve: Vec<Option<Vec2>> = moved.moments.iter().map(|m| m.vectors[k][l]).collect();
                    let paper = |v: &Vec2| (*v * (1.0 / mu)).to_point();
                    // As far as the polygons reach.
                    let most = BOXES.polygon[0].hypot(BOXES.polygon[1]) * mu;
                    runs(&curve, moved.full, most).0.iter().map(|run| run.iter().map(paper).collect()).collect()
                }
            };
            for (n, points) in lines.into_iter().enumerate() {
                let shape = Shape::Polyline { points, closed: false, stroke: Some(stroke), fill: None };
                items.push(Item::new("curve", shape).with_id(format!("{}-curve-{name}-{n}", shows.word())));
            }
        }
        items
    }
}

/// A page in the making.
struct Page<'a> {
    table: &'a Table<'a>,
    columns: &'a [Column],
    row_mm: f64,
    width_mm: f64,
    size_mm: [f64; 2],
    across: usize,
    down: usize,
}

impl Page<'_> {
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
                    let wide = column.bounds.width_mm() + 2.0 * AIR_MM;
                    let mut part = column.parts[row].clone();
                    let middle = if part.items.iter().any(|i| i.class == "absent") { part.bounds.centre() } else { column.bounds.centre() };
                    part.translate(Point::new(edge + wide / 2.0, y) - middle);
                    items.extend(part.items);
                    edge += wide;
                }
            }
        }
        let mut figure = maker.figure(items, self.size_mm);
        if pages > 1 {
            let (first, last) = (rows.start + 1, rows.end);
            let positions = tr(lang, "positions", "位置");
            figure.title = format!("{} · {positions} {first}–{last}", figure.title);
        }
        let driver = driver_symbol(&table.rows[0].scene, table.driver).0;
        let words = tr(
            lang,
            "The mechanism with its velocity and acceleration polygons in {} positions at equal steps of {1}, all to the same scales.",
            "机构在 {1} 等间隔的 {} 个位置上的运动简图、速度多边形和加速度多边形，采用同一组比例尺。",
        );
        figure.desc = words.replace("{}", &table.rows.len().to_string()).replace("{1}", &crate::report::phrase::formula(&driver));
        figure
    }

    /// The rules and the head of a block of rows.
    fn head(&self, block: usize, x: f64, top: f64, rows: usize) -> Vec<Item> {
        let table = self.table;
        let (style, lang) = (&table.options.style, table.options.lang);
        let maker = table.maker();
        let bottom = top - HEAD_MM - rows as f64 * self.row_mm;
        let mut items = Vec::new();
        let mut line = |from: Point, to: Point, stroke: Stroke| {
            let id = format!("rule-{block}-{}", items.len());
            items.push(Item::new("rule", Shape::Line { from, to, stroke }).with_id(id));
        };
        let mut edges = vec![x, x + NAME_MM];
        for column in self.columns {
            edges.push(edges[edges.len() - 1] + column.bounds.width_mm() + 2.0 * AIR_MM);
        }
        for (k, edge) in edges.iter().enumerate() {
            let outer = k == 0 || k + 1 == edges.len();
            line(Point::new(*edge, top), Point::new(*edge, bottom), if outer { style.outline } else { style.thin });
        }
        let right = x + self.width_mm;
        for k in 0..=rows + 1 {
            let y = if k == 0 { top } else { top - HEAD_MM - (k - 1) as f64 * self.row_mm };
            let heavy = k < 2 || k == rows + 1;
            line(Point::new(x, y), Point::new(right, y), if heavy { style.outline } else { style.thin });
        }
        let (driver, unit) = driver_symbol(&table.rows[0].scene, table.driver);
        let first = Label::text(tr(lang, "Position", "位置"));
        let mut heads = vec![(first, format!("{driver},\\, {unit}"))];
        for column in self.columns {
            let which = match column.shows {
                Shows::Mechanism => Single::Mechanism,
                Shows::Polygon(level) => Single::Polygon(level),
            };
            let (words, mu) = maker.caption(which);
            // The first pose may have no polygon.
            let mu = match column.shows {
                Shows::Polygon(level) => {
                    super::sheet::of_level(level, table.scales.mu[usize::from(level == Level::Acceleration)].unwrap_or(1.0))
                }
                Shows::Mechanism => mu,
            };
            heads.push((Label::text(words), mu));
        }
        for (k, (words, mu)) in heads.into_iter().enumerate() {
            let middle = (edges[k] + edges[k + 1]) / 2.0;
            let id = |what: &str| format!("head-{what}-{block}-{k}");
            let name = text("head", Point::new(middle, top - 6.0), words, style.caption_mm, Anchor::Middle);
            items.push(name.with_id(id("name")));
            let scale = text("head", Point::new(middle, top - 12.0), Label::math(mu), style.small_mm, Anchor::Middle);
            items.push(scale.with_id(id("scale")));
        }
        items
    }

    /// Which pose a row shows.
    fn name(&self, row: usize, at: Point) -> Vec<Item> {
        let table = self.table;
        let style = &table.options.style;
        let (_, unit) = driver_symbol(&table.rows[0].scene, table.driver);
        let value = table.rows[row].driver;
        let shown = if unit == "\\degree" { turned(value.to_degrees(), table.full) } else { value * 1e3 };
        let shown = inked(&shortest((shown * 100.0).round() / 100.0));
        let value = if unit == "\\degree" { format!("{shown}{unit}") } else { format!("{shown}\\,{unit}") };
        vec![
            text("position", at + Vec2::new(0.0, 1.5), Label::math((row + 1).to_string()), style.caption_mm * 1.5, Anchor::Middle)
                .with_id(format!("position-{}", row + 1)),
            text("position", at - Vec2::new(0.0, 5.5), Label::math(value), style.small_mm, Anchor::Middle)
                .with_id(format!("position-{}-driver", row + 1)),
        ]
    }
}

fn text(class: &str, at: Point, label: Label, size_mm: f64, anchor: Anchor) -> Item {
    Item::new(class, Shape::Label { at, label, size_mm, anchor, colour: Colour::BLACK })
}
