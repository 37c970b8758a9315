//! Draws the motion of points as one figure: their paths on the mechanism, the hodographs of their
//! velocities and accelerations, and a table of the positions, which are numbered alike in all of
//! them.
//!
//! This module chooses scales, captions and the arrangement. [`super::hodograph`] draws one
//! hodograph, [`super::mechanism`] the mechanism with its overlay, [`hodograph_sweep::points`]
//! follows the points.

use hodograph_base::diag::{Both, Diagnostic, Faults, Warned, both};
use hodograph_base::digits::direction_degrees;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::{say, tr};
use hodograph_board::construct::scale::{self, Boxes};
use hodograph_board::plan::names::point_label;
use hodograph_paper::paper::phrase::{Phrase, capital, fill};
use hodograph_scene::{DiagramKind, Kind, LinkId, PointId, Scene, Swept};
use hodograph_sweep::points::{
    PathMotion, PointMoment, alone, at_equal_steps, bounded, motion, questions, seen_from,
};
use hodograph_worked::worked::{Worked, work_motion};

use super::arrange::{AIM_MM, Tree};
use super::hodograph::{Hodograph, hodograph, runs};
use super::mechanism::{Overlay, PointTrack, overlaid};
use super::placed::fitted;
use super::plot::over;
use super::relative;
use super::sheet::{MARGIN_MM, SheetDrafter, SheetOptions, swept_symbol};
use crate::scales::DrawingScales;
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::grid::{self, Cell, Row};
use hodograph_paper::paper::item::{Anchor, Figure, FigureItem};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::shown::escaped;
use hodograph_report::amount::{number, symbol};
use hodograph_sweep::follow::PoseFollower;

/// Default number of numbered positions: 12, common in textbooks' course work.
pub const MARKS: usize = 12;
/// Maximum number of numbered positions: every 5° of a turn.
pub const MOST_MARKS: usize = 72;
/// Digits in the table, the same as in a line diagram.
const DIGITS: usize = 4;
/// Positions in one row of the table: as many as fit side by side on A4.
const IN_ROW: usize = 12;
/// Distance of the table's baselines, and gap between its columns.
const ROW_MM: f64 = 6.0;
const COLUMN_MM: f64 = 3.2;

/// The content of the figure of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct PathContent {
    /// The points with their paths drawn.
    pub points: Vec<PointId>,
    /// The moving driver, or time; other drivers are at rest.
    pub swept: Swept,
    /// Number of numbered positions, at equal steps of the driver.
    pub marks: usize,
    /// Number of superimposed positions of the mechanism.
    pub poses: usize,
}

/// Draws the figure; notes name the parts of the motion that it does not show.
///
/// # Errors
/// `no-driver`, `no-path` (a fixed point), `no-motion` if the mechanism cannot be followed from its
/// pose.
///
/// ```
/// use hodograph_figure::{path, sheet::SheetOptions};
/// use hodograph_scene::{self as scene, Lang, Swept, PointId, templates};
/// use hodograph_worked::worked::{Scope, work};
/// let scene = scene::read(templates::get("crank-rocker").unwrap())?.value;
/// let worked = work(&scene, Scope::Figure)?.value;
/// let e = PointId(scene.points.iter().position(|p| p.name == "E").unwrap());
/// let wanted = path::PathContent { points: vec![e], swept: Swept::Driver(0), marks: 12, poses: 0 };
/// let figure = path::figure(&scene, &worked, &SheetOptions::of_language(Lang::En), &wanted)?.value;
/// assert!(figure.title.starts_with("Crank-rocker"));
/// # Ok::<(), hodograph_base::diag::Faults>(())
/// ```
pub fn figure(
    scene: &Scene,
    worked: &Worked,
    options: &SheetOptions,
    wanted: &PathContent,
) -> Result<Warned<Figure>, Faults> {
    check(scene, wanted)?;
    drawn(scene, worked, options, wanted, None)
}

/// Draws the paths of points as they are seen from a moving link (相对运动轨迹), on that link in the
/// pose of the scene. A motion by laws of time goes on for a turn of the slowest turning driver.
///
/// # Errors
/// The errors of [`figure`]; `no-path` also for a point of the link.
pub fn seen(
    scene: &Scene,
    worked: &Worked,
    options: &SheetOptions,
    wanted: &PathContent,
    link: LinkId,
) -> Result<Warned<Figure>, Faults> {
    relative::check(scene, wanted, link)?;
    drawn(scene, worked, options, wanted, Some(link))
}

fn drawn(
    scene: &Scene,
    worked: &Worked,
    options: &SheetOptions,
    wanted: &PathContent,
    against: Option<LinkId>,
) -> Result<Warned<Figure>, Faults> {
    let motion_of_cams = work_motion(scene)?;
    let (scene, worked) =
        motion_of_cams.as_ref().map_or((scene, worked), |(scene, worked)| (scene, worked));
    // Each velocity is then tangent to the drawn path.
    let alone = alone(scene, wanted.swept);
    let most = wanted.marks.clamp(1, MOST_MARKS);
    let mut moved = match against {
        Some(_) => relative::travelled(&alone, worked, wanted, most),
        None => motion(
            &alone,
            &worked.mechanism,
            &worked.demand,
            &worked.configuration,
            wanted.swept,
            &wanted.points,
            most,
        ),
    };
    let follower = PoseFollower::new(
        scene,
        &worked.mechanism,
        &worked.demand,
        &worked.configuration,
        wanted.swept,
    );
    let shortened = follower.shortened();
    follower.proved(moved.moments.iter().chain(&moved.marks).map(|m| &m.configuration))?;
    if moved.moments.len() < 2 {
        let d = Diagnostic::error(
            "no-motion",
            both!("the mechanism cannot be followed from its pose: there is no path"),
        );
        return Err(d.help(both!("give another pose, or move another driver with --over")).into());
    }
    if let Some(link) = against {
        let base = &worked.configuration;
        for m in moved.moments.iter_mut().chain(&mut moved.marks) {
            let at = m.configuration.clone();
            for p in &wanted.points {
                m.configuration.points[p.0] = seen_from(&at, base, *p, link);
            }
        }
    }
    let poses = poses(scene, worked, wanted);
    let places = moved
        .moments
        .iter()
        .flat_map(|m| moved.points.iter().filter_map(|p| m.configuration.points[p.0]));
    let boxes = Boxes::of(&scene.paper, &worked.plan);
    let (fitted, worked) = &fitted(scene, worked, &poses, places)?;
    let maker = SheetDrafter { scene: fitted, worked, options, certified: Vec::new() };
    let mut page = PathPage { maker, moved: &moved, swept: wanted.swept, against, cut: false };

    let mut drawings = vec![page.mechanism(poses)];
    drawings.extend(page.hodographs(&boxes));
    let text = page.text();
    let mut notes = Vec::from_iter(shortened);
    if scene.own_drivers() > 1 && wanted.swept != Swept::Time {
        notes.push(Diagnostic::note(
            "path-driver",
            both!("the scene has several drivers: one of them moves, the others stand still here"),
        ));
    }
    let (items, size) = stand(page.maker.title(), drawings, text);
    let mut figure = page.maker.figure(items, size);
    figure.desc = page.described();
    Ok(Warned { value: figure, notes })
}

fn check(scene: &Scene, wanted: &PathContent) -> Result<(), Faults> {
    let mut faults = Faults::default();
    if let Swept::Driver(driver) = wanted.swept
        && driver >= scene.drivers.len()
    {
        faults
            .push(Diagnostic::error("no-driver", both!("the scene has no driver {}", driver + 1)));
    }
    if wanted.points.is_empty() {
        faults.push(
            Diagnostic::error("no-path", both!("no point is named"))
                .help(both!("name one with --point")),
        );
    }
    let stands =
        |p: &&PointId| scene.mover(**p).is_none() || scene.links[scene.ground.0].points.contains(p);
    for p in wanted.points.iter().filter(stands) {
        let d = Diagnostic::error(
            "no-path",
            both!("point {} stands still: it has no path", scene.point_name(*p)),
        );
        faults.push(d.at(scene.points[p.0].span).help(both!("name a point that moves")));
    }
    if faults.has_errors() { Err(faults) } else { Ok(()) }
}

/// The mechanism in other positions.
fn poses(
    scene: &Scene,
    worked: &Worked,
    wanted: &PathContent,
) -> Vec<hodograph_mechanism::position::Configuration> {
    if wanted.poses == 0 {
        return Vec::new();
    }
    let follower = PoseFollower::new(
        scene,
        &worked.mechanism,
        &worked.demand,
        &worked.configuration,
        wanted.swept,
    );
    let sweep = follower.sweep(MOST_MARKS);
    at_equal_steps(&follower, &sweep, wanted.poses.min(MOST_MARKS))
        .into_iter()
        .map(|p| p.configuration)
        .collect()
}

/// The figure under construction.
struct PathPage<'a> {
    maker: SheetDrafter<'a>,
    moved: &'a PathMotion,
    swept: Swept,
    /// The link from which the paths are seen, if it is not the ground.
    against: Option<LinkId>,
    /// True if a hodograph leaves the paper.
    cut: bool,
}

impl PathPage<'_> {
    fn scene(&self) -> &Scene {
        self.maker.scene
    }

    fn mechanism(&self, poses: Vec<hodograph_mechanism::position::Configuration>) -> DrawingPart {
        let places = |moments: &[PointMoment], p: PointId| {
            moments.iter().filter_map(|m| m.configuration.points[p.0]).collect()
        };
        let track = |&point: &PointId| PointTrack {
            point,
            places: places(&self.moved.moments, point),
            closed: self.moved.full,
            marks: places(&self.moved.marks, point),
        };
        let overlay = Overlay {
            poses,
            paths: self.moved.points.iter().map(track).collect(),
            ..Overlay::default()
        };
        let maker = &self.maker;
        let part =
            overlaid(&maker.options.style, maker.scene, maker.worked, &maker.writer(), &overlay);
        let names: Vec<String> = self
            .moved
            .points
            .iter()
            .map(|p| format!("${}$", point_label(self.scene().point_name(*p))))
            .collect();
        let seen = self.against.map(|l| self.scene().link_name(l));
        let lang = self.maker.options.lang;
        let all = names.join(lang.comma());
        let words = match (names.len(), seen) {
            (1, None) => say!(lang, "Path of {all}"),
            (_, None) => say!(lang, "Paths of {all}"),
            (1, Some(link)) => say!(lang, "Path of {all} seen from link {link}"),
            (_, Some(link)) => say!(lang, "Paths of {all} seen from link {link}"),
        };
        let (_, mu) = maker.caption(DiagramKind::Plane);
        maker.titled(part, Phrase::new(&words).label(), &mu, "mechanism")
    }

    /// Velocity and acceleration hodograph of each point; all of one kind are to one scale.
    fn hodographs(&mut self, boxes: &Boxes) -> Vec<DrawingPart> {
        let paper = self.scene().paper.clone();
        let mut parts = Vec::new();
        for (l, on) in DiagramKind::POLYGONS.into_iter().enumerate() {
            let of = |moments: &[PointMoment], k: usize| -> Vec<Option<Vec2>> {
                moments.iter().map(|m| m.vector(k, on.level())).collect()
            };
            let curves: Vec<Vec<Option<Vec2>>> =
                (0..self.moved.points.len()).map(|k| of(&self.moved.moments, k)).collect();
            let sizes = curves.iter().flatten().flatten().map(|v| v.norm()).collect();
            let own = self.moved.moments.iter().find(|m| m.travel == 0.0);
            let own = own
                .into_iter()
                .flat_map(|m| m.vectors.iter().filter_map(|v| v[l]))
                .map(Vec2::norm)
                .fold(0.0, f64::max);
            let Some(most) = bounded(sizes, own, self.moved.limits == [false, false]) else {
                continue;
            };
            let shown: Vec<_> = curves.iter().map(|c| runs(c, self.moved.full, most)).collect();
            self.cut |= shown.iter().any(|s| s.1);
            let ends = shown.iter().flat_map(|s| s.0.iter().flatten()).map(|v| v.to_point());
            let kind = on.kind();
            let mu = scale::fitted(
                &paper,
                kind,
                scale::extent(ends.chain([Point::ORIGIN])),
                boxes.polygon,
            );
            for (k, &point) in self.moved.points.iter().enumerate() {
                let find = &questions(self.scene(), point)[l];
                let h = Hodograph {
                    on,
                    quantity: &find.text,
                    pole: &self.maker.writer().pole(on),
                    link: self.scene().mover(point).map(|l| l.0),
                    curve: &curves[k],
                    closed: self.moved.full,
                    marks: &of(&self.moved.marks, k),
                    most,
                    mu,
                    book: &self.scene().book,
                };
                let part = hodograph(&self.maker.options.style, &h);
                let name = self.scene().point_name(point);
                // Several points have captions with the same scale.
                let id = format!("{}-hodograph-{}", on.prefix(), escaped(name));
                let (vector, point) = (on.vector(), point_label(name));
                let vector = Both { en: capital(&vector.en), ..vector };
                let words = say!(self.maker.options.lang, "{} hodograph of ${}$", vector, point);
                parts.push(self.maker.titled(
                    part,
                    Phrase::new(&words).label(),
                    &DrawingScales::of(&self.scene().book, on, mu),
                    &id,
                ));
            }
        }
        parts
    }

    /// The table of numbered positions: the place of the driver, the magnitudes of the vectors; and
    /// remarks.
    fn text(&self) -> DrawingPart {
        let (style, lang) = (&self.maker.options.style, self.maker.options.lang);
        let book = &self.scene().book;
        let (driver, kind) = swept_symbol(self.scene(), self.swept);
        let ((unit, factor), parts) = (book.fine(kind), book.parts(kind, 100.0));
        let mut rows = Vec::new();
        for (block, marks) in self.moved.marks.chunks(IN_ROW).enumerate() {
            let cell = |text: Label, anchor, row: &str, k: usize| {
                let id = format!("position-{row}-{}", block * IN_ROW + k);
                Some(Cell {
                    label: text.in_fonts(&style.fonts),
                    size_mm: style.small_mm,
                    anchor,
                    class: "positions".into(),
                    id,
                })
            };
            let mut row = |name: &str, head: Label, text: &dyn Fn(usize) -> Label| {
                let first = cell(head, Anchor::Start, name, 0);
                let rest = (0..marks.len()).map(|k| cell(text(k), Anchor::End, name, k + 1));
                let height_mm = if name == "number" && block > 0 { ROW_MM * 1.6 } else { ROW_MM };
                rows.push(Row { cells: std::iter::once(first).chain(rest).collect(), height_mm });
            };
            row("number", Label::text(tr!(lang, "Position")), &|k| {
                Label::math((block * IN_ROW + k + 1).to_string())
            });
            row("driver", Label::math(over(&driver, &unit)), &|k| {
                let value = marks[k].place;
                let shown = if kind == Kind::Angle {
                    turned(value, factor, self.moved.full)
                } else {
                    value * factor
                };
                Label::math(hodograph_base::digits::inked(&hodograph_base::digits::shortest(
                    (shown * parts).round() / parts,
                )))
            });
            let rates = self.moved.points.iter().enumerate().filter(|_| self.against.is_none());
            for (p, point) in rates {
                for (l, find) in questions(self.scene(), *point).iter().enumerate() {
                    let unit = book.upright(find.what.kind());
                    let symbol = symbol(find, &self.maker.options.notation);
                    row(&find.text, Label::math(over(&symbol, &unit)), &|k| match marks[k].vectors
                        [p][l]
                    {
                        Some(v) => {
                            Label::math(number(book.value(find.what.kind(), v.norm()), DIGITS))
                        }
                        None => Label::text("—"),
                    });
                }
            }
        }
        let width = rows.len();
        let mut items = grid::set(&rows, COLUMN_MM);
        let y = -rows[..width].iter().map(|r| r.height_mm).sum::<f64>();
        for (k, said) in self.remarks().into_iter().enumerate() {
            let at = Point::new(0.0, y - ROW_MM * (k as f64 + 1.2));
            let shape = hodograph_paper::paper::item::Shape::Label {
                at,
                label: Label::text(said).in_fonts(&style.fonts),
                size_mm: style.small_mm,
                anchor: Anchor::Start,
                colour: hodograph_paper::paper::item::Colour::BLACK,
            };
            items.push(FigureItem::new("remark", shape).with_id(format!("remark-{k}")));
        }
        DrawingPart::of(items)
    }

    fn remarks(&self) -> Vec<&'static str> {
        let lang = self.maker.options.lang;
        let cut = tr!(
            lang,
            "Next to a limit the vectors grow beyond all bounds; there the hodographs leave the paper."
        );
        let alone = tr!(lang, "One driver moves, the others stand still.");
        let mut said = Vec::new();
        said.extend(self.cut.then_some(cut));
        let several = self.scene().own_drivers() > 1;
        said.extend((several && self.swept != Swept::Time).then_some(alone));
        said
    }

    /// The description of the figure, in words.
    fn described(&self) -> String {
        let lang = self.maker.options.lang;
        if let Some(link) = self.against.map(|l| self.scene().link_name(l)) {
            let points: Vec<&str> =
                self.moved.points.iter().map(|p| self.scene().point_name(*p)).collect();
            return say!(lang, "Path of {} seen from link {link}.", points.join(lang.comma()));
        }
        let mut said = Vec::new();
        for (k, point) in self.moved.points.iter().enumerate() {
            let name = self.scene().point_name(*point);
            let speeds = self.moved.moments.iter().filter_map(|m| m.vectors[k][0]);
            let [slow, fast] = speeds
                .fold([f64::INFINITY, 0.0_f64], |[lo, hi], v| [lo.min(v.norm()), hi.max(v.norm())]);
            let first = self
                .moved
                .marks
                .first()
                .and_then(|m| m.vectors[k][0])
                .map(|v| direction_degrees(v.angle()));
            let words = tr!(
                lang,
                "Path of point {}, its velocity and its acceleration drawn from one pole through {travel}: speed from {slow} to {fast} {unit}, at position 1 towards {first}°."
            );
            let travel = match (self.moved.full, self.moved.limits) {
                (true, _) => tr!(lang, "a full turn"),
                (_, [true, true]) => {
                    tr!(lang, "the travel between its limits")
                }
                _ => tr!(lang, "the travel"),
            };
            let plain = |v: f64| hodograph_base::digits::significant(v, 3);
            let book = &self.scene().book;
            let speed = |v: f64| plain(book.value(Kind::Velocity, v));
            let fast = if self.cut { "∞".to_owned() } else { speed(fast) };
            let first = first.map_or("—".to_owned(), plain);
            said.push(fill(
                words,
                &[
                    ("", name),
                    ("travel", travel),
                    ("slow", &speed(if slow.is_finite() { slow } else { f64::NAN })),
                    ("fast", &fast),
                    ("unit", book.name(Kind::Velocity)),
                    ("first", &first),
                ],
            ));
        }
        said.join(" ")
    }
}

/// An angle as written beside a crank, in a unit with `factor` units per radian; from zero to less
/// than a turn if the crank turns fully.
pub(super) fn turned(radians: f64, factor: f64, full: bool) -> f64 {
    let shown = (radians * factor * 1e8).round() / 1e8;
    if full { shown.rem_euclid(std::f64::consts::TAU * factor) } else { shown }
}

/// Arranges title, drawings and table on the page: the mechanism beside the hodographs, with one
/// row or one column for each kind, whichever is closer to A4.
fn stand(
    title: Option<DrawingPart>,
    drawings: Vec<DrawingPart>,
    text: DrawingPart,
) -> (Vec<FigureItem>, [f64; 2]) {
    let per_level = drawings.len().saturating_sub(1) / 2;
    let mut parts = drawings;
    let leaves =
        |from: usize, count: usize| (from..from + count).map(Tree::Leaf).collect::<Vec<_>>();
    let (table, heading) = (parts.len(), title.is_some().then_some(parts.len() + 1));
    let levels = parts.len().saturating_sub(1).div_ceil(per_level.max(1));
    parts.push(text);
    parts.extend(title);
    let drawn = |k: usize| leaves(1 + k * per_level, per_level);
    // Kinds side by side, the points of each one below the other; or the other way round.
    let rows = || Tree::row((0..levels).map(|k| Tree::column(drawn(k))).collect());
    let columns = || Tree::column((0..levels).map(|k| Tree::row(drawn(k))).collect());
    let layouts = [rows(), columns()].map(|right| {
        let body = Tree::row(vec![Tree::Leaf(0), right]);
        Tree::column(heading.map(Tree::Leaf).into_iter().chain([body, Tree::Leaf(table)]).collect())
    });
    let scale = |t: &Tree| {
        let [w, h] = t.size(&parts);
        (w / AIM_MM[0]).max(h / AIM_MM[1])
    };
    let best =
        layouts.into_iter().min_by(|a, b| scale(a).total_cmp(&scale(b))).unwrap_or(Tree::Leaf(0));
    let [w, h] = best.size(&parts);
    let size = [w + 2.0 * MARGIN_MM, h + 2.0 * MARGIN_MM];
    best.put(&mut parts, Point::new(MARGIN_MM, size[1] - MARGIN_MM));
    (parts.into_iter().flat_map(|p| p.items).collect(), size)
}
