//! The work-precision figure: error against time of every way to the answer, and error against the distance from a toggle.
//! Both axes are logarithmic; a lower error for less time lies lower and farther left.

use super::extent::Rect;
use super::item::{Anchor, Colour, Dash, Figure, Item, Shape, Stroke};
use super::label::Label;
use super::place::{LabelRequest, Obstacles, place};
use super::style::Style;
use super::words::words;
use crate::accuracy::ladder::Rung;
use crate::accuracy::ways::{Measured, Near, Way};
use crate::geom::{Point, Vec2};
use crate::report::phrase::tr;
use crate::report::price::name;
use crate::scene::{Lang, Scene};
use std::sync::LazyLock;

/// A panel's plot, in mm.
const PLOT: [f64; 2] = [150.0, 110.0];
/// Room for the axes' numbers and titles at the left, and for the legend at the right.
const LEFT_MM: f64 = 24.0;
const RIGHT_MM: f64 = 62.0;
const ABOVE_MM: f64 = 14.0;
const BELOW_MM: f64 = 20.0;
/// Errors below are drawn on the lower edge: no figure needs to tell them apart.
const FLOOR: f64 = -42.0;
static STYLE: LazyLock<Style> = LazyLock::new(Style::default);

/// A family of ways: one symbol, one line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Family {
    Drawing,
    Closed,
    Loops,
    Differences,
    Certified,
}

impl Family {
    const ALL: [Family; 5] = [Family::Drawing, Family::Closed, Family::Certified, Family::Loops, Family::Differences];

    fn of(way: Way) -> Option<Family> {
        Some(match way {
            Way::Paper(_) => return None,
            Way::DrawingSingle | Way::Drawing => Family::Drawing,
            Way::ClosedSingle | Way::Closed | Way::ClosedDouble | Way::ClosedLong(_) => Family::Closed,
            Way::Loops(_) => Family::Loops,
            Way::Differences(_) => Family::Differences,
            Way::Certified(_) => Family::Certified,
        })
    }

    fn words(self, lang: Lang) -> &'static str {
        match self {
            Family::Drawing => tr(lang, "drawing board", "图解法"),
            Family::Closed => tr(lang, "closed form, group by group", "杆组法"),
            Family::Loops => tr(lang, "loop equations, Newton", "解析法，牛顿迭代"),
            Family::Differences => tr(lang, "finite differences", "有限差分"),
            Family::Certified => tr(lang, "certified (bound)", "可靠界"),
        }
    }

    /// Told apart by shape, so that a grey print keeps them.
    fn symbol(self, at: Point) -> Item {
        const R: f64 = 1.1;
        let line = Some(Stroke::new(0.35));
        let corners = |list: &[(f64, f64)], fill| Shape::Polyline {
            points: list.iter().map(|(x, y)| at + Vec2::new(x * R, y * R)).collect(),
            closed: true,
            stroke: line,
            fill: Some(fill),
        };
        let disc = |fill| Shape::Circle { centre: at, radius_mm: R, stroke: line, fill: Some(fill) };
        Item::new(
            "way",
            match self {
                Family::Drawing => disc(Colour::WHITE),
                Family::Closed => disc(Colour::BLACK),
                Family::Loops => corners(&[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)], Colour::WHITE),
                Family::Differences => corners(&[(-1.1, -0.8), (1.1, -0.8), (0.0, 1.2)], Colour::WHITE),
                Family::Certified => corners(&[(-1.2, 0.0), (0.0, -1.2), (1.2, 0.0), (0.0, 1.2)], Colour::grey(150)),
            },
        )
    }
}

/// What stands beside a point.
fn short(way: Way) -> Label {
    match way {
        Way::Paper(mm) => Label::text(format!("{mm} mm")),
        Way::DrawingSingle | Way::ClosedSingle => Label::text("f32"),
        Way::Drawing | Way::Closed | Way::Certified(Rung::Double) => Label::text("f64"),
        Way::ClosedDouble | Way::Certified(Rung::DoubleDouble) => Label::text("dd"),
        Way::ClosedLong(bits) | Way::Certified(Rung::Long(bits)) => Label::text(format!("{bits} bit")),
        Way::Loops(x) | Way::Differences(x) => Label::math(format!("10^{{−{}}}", -libm::log10(x).round() as i32)),
    }
}

/// A panel under way: items, lines that labels must keep off, labels.
struct Panel {
    origin: Point,
    x: [f64; 2],
    y: [f64; 2],
    items: Vec<Item>,
    labels: Vec<LabelRequest>,
}

impl Panel {
    /// Powers of ten at the ends of both axes; the first of `x` is at the left.
    fn new(origin: Point, x: [f64; 2], y: [f64; 2]) -> Panel {
        Panel { origin, x, y, items: Vec::new(), labels: Vec::new() }
    }

    fn at(&self, log_x: f64, log_y: f64) -> Point {
        let part = |v: f64, [a, b]: [f64; 2]| ((v - a) / (b - a)).clamp(0.0, 1.0);
        self.origin + Vec2::new(part(log_x, self.x) * PLOT[0], part(log_y, self.y) * PLOT[1])
    }

    fn words(&mut self, at: Point, label: Label, anchor: Anchor, class: &str) {
        let shape = Shape::Label { at, label, size_mm: STYLE.small_mm, anchor, colour: Colour::BLACK };
        self.items.push(Item::new(class, shape));
    }

    /// Frame, grid, numbers at every power (or every fifth), titles.
    fn axes(&mut self, x_title: &str, y_title: &str) {
        let thin = Stroke::new(0.12).coloured(Colour::grey(190));
        for (axis, [a, b]) in [(0, self.x), (1, self.y)] {
            let span = (b - a).abs();
            let step = if span > 12.0 { 5.0 } else { 1.0 };
            let (lo, hi) = (a.min(b), a.max(b));
            let mut k = libm::ceil(lo / step) * step;
            while k <= hi {
                let ends = if axis == 0 { [(k, self.y[0]), (k, self.y[1])] } else { [(self.x[0], k), (self.x[1], k)] };
                let [from, to] = ends.map(|(u, v)| self.at(u, v));
                self.items.push(Item::new("grid", Shape::Line { from, to, stroke: thin }));
                let label = Label::math(if k == 0.0 { "1".to_string() } else { format!("10^{{{}}}", format!("{k}").replace('-', "−")) });
                match axis {
                    0 => self.words(from - Vec2::new(0.0, 5.0), label, Anchor::Middle, "number"),
                    _ => self.words(from - Vec2::new(1.5, 1.2), label, Anchor::End, "number"),
                }
                k += step;
            }
        }
        let corner = |u: usize, v: usize| self.at(self.x[u], self.y[v]);
        let points = vec![corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
        self.items.push(Item::new("frame", Shape::Polyline { points, closed: true, stroke: Some(STYLE.thin), fill: None }));
        self.words(self.origin + Vec2::new(PLOT[0] / 2.0, -12.0), Label::text(x_title.to_string()), Anchor::Middle, "axis");
        self.words(self.origin + Vec2::new(-LEFT_MM + 8.0, PLOT[1] + 3.5), Label::text(y_title.to_string()), Anchor::Start, "axis");
    }

    fn curve(&mut self, points: &[Point], dash: Dash) {
        if points.len() > 1 {
            let stroke = Stroke::new(0.2).dashed(dash);
            self.items
                .push(Item::new("curve", Shape::Polyline { points: points.to_vec(), closed: false, stroke: Some(stroke), fill: None }));
        }
    }

    /// Places the labels and hands everything over.
    fn done(mut self) -> Vec<Item> {
        let bounds = Rect { min: self.origin, max: self.origin + Vec2::new(PLOT[0], PLOT[1]) };
        let drawn: Vec<Item> = self.items.iter().filter(|i| matches!(i.class.as_str(), "way" | "frame" | "paper")).cloned().collect();
        let placed = place(&self.labels, &Obstacles::of(&drawn), bounds);
        for (request, placement) in self.labels.iter().zip(&placed) {
            self.items.extend(placement.items(request, "label", Stroke::new(0.12)));
        }
        self.items
    }
}

/// The error shown: of the accelerations where they are asked for, else of the velocities.
fn shown(m: &Measured) -> Option<f64> {
    m.errors[1].or(m.errors[0]).filter(|e| e.is_finite())
}

fn log_error(e: f64) -> f64 {
    if e > 0.0 { libm::log10(e).clamp(FLOOR, 1.0) } else { FLOOR }
}

/// The figure of all ways, and below it that of the series of poses where there is one.
pub fn figure(scene: &Scene, ways: &[Measured], series: &[Near], lang: Lang) -> Figure {
    let panels = if series.iter().any(|n| !n.ways.is_empty()) { 2.0 } else { 1.0 };
    let panel_mm = PLOT[1] + ABOVE_MM + BELOW_MM;
    let heading_mm = 10.0;
    let height_mm = panels * panel_mm + heading_mm;
    let title = scene.title.get(lang);
    let subject =
        if ways.iter().any(|m| m.errors[1].is_some()) { tr(lang, "accelerations", "加速度") } else { tr(lang, "velocities", "速度") };
    let heading = match lang {
        Lang::En => format!("What accuracy costs{}{title}", if title.is_empty() { "" } else { ": " }),
        Lang::Zh => format!("精度的代价{}{title}", if title.is_empty() { "" } else { "：" }),
    };
    let mut items = vec![Item::new(
        "heading",
        Shape::Label {
            at: Point::new(LEFT_MM, height_mm - 8.0),
            label: Label::text(heading.clone()),
            size_mm: STYLE.caption_mm,
            anchor: Anchor::Start,
            colour: Colour::BLACK,
        },
    )];
    let origin = Point::new(LEFT_MM, height_mm - heading_mm - ABOVE_MM - PLOT[1]);
    items.extend(against_time(origin, ways, subject, lang));
    if panels > 1.0 {
        items.extend(against_distance(origin - Vec2::new(0.0, panel_mm), series, subject, lang));
    }
    let desc = match lang {
        Lang::En => format!("Relative error of the {subject} against time on logarithmic axes, for every way to the answer."),
        Lang::Zh => format!("各种求解方法的{subject}相对误差与用时（双对数坐标）。"),
    };
    Figure {
        width_mm: LEFT_MM + PLOT[0] + RIGHT_MM,
        height_mm,
        title: heading,
        desc,
        lang: words(lang).tag.into(),
        paper: Colour::WHITE,
        items,
    }
}

fn against_time(origin: Point, ways: &[Measured], subject: &str, lang: Lang) -> Vec<Item> {
    let logs = ways.iter().filter_map(|m| m.seconds).map(libm::log10);
    let (lo, hi) = logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), t| (a.min(t), b.max(t)));
    let least = ways.iter().filter_map(shown).map(log_error).fold(0.0, f64::min);
    let mut panel = Panel::new(origin, [libm::floor(lo), libm::ceil(hi)], [libm::floor(least), 1.0]);
    let y_title = match lang {
        Lang::En => format!("relative error of the {subject}"),
        Lang::Zh => format!("{subject}的相对误差"),
    };
    panel.axes(tr(lang, "time of a whole solution, s", "一次求解用时，s"), &y_title);
    let mut below = f64::INFINITY;
    for m in ways.iter().filter(|m| matches!(m.way, Way::Paper(_))) {
        let Some(e) = shown(m) else { continue };
        let y = log_error(e);
        let (from, to) = (panel.at(panel.x[0], y), panel.at(panel.x[1], y));
        panel.items.push(Item::new("paper", Shape::Line { from, to, stroke: Stroke::new(0.3).dashed(Dash::Dashed) }));
        // Names a line apart, each joined to its own.
        below = to.y.min(below - 5.0);
        let at = Point::new(to.x + 5.0, below);
        panel.items.push(Item::new("leader", Shape::Line { from: to, to: at, stroke: Stroke::new(0.12) }));
        panel.words(at + Vec2::new(1.0, -1.2), Label::text(name(m.way, lang)), Anchor::Start, "paper-name");
    }
    for family in Family::ALL {
        let points: Vec<(Point, Way)> = ways
            .iter()
            .filter(|m| Family::of(m.way) == Some(family))
            .filter_map(|m| Some((panel.at(libm::log10(m.seconds?), log_error(shown(m)?)), m.way)))
            .collect();
        panel.curve(&points.iter().map(|p| p.0).collect::<Vec<_>>(), Dash::Solid);
        for (at, way) in points {
            panel.items.push(family.symbol(at));
            panel.labels.push(LabelRequest::at_point(short(way), STYLE.small_mm * 0.85, at, 1.4));
        }
    }
    legend(&mut panel, lang);
    panel.done()
}

/// Below the names of the pencils, which stand at their lines.
fn legend(panel: &mut Panel, lang: Lang) {
    for (k, family) in Family::ALL.into_iter().enumerate() {
        let at = panel.origin + Vec2::new(PLOT[0] + 4.0, PLOT[1] * 0.55 - 7.0 * k as f64);
        panel.items.push(family.symbol(at));
        panel.words(at + Vec2::new(3.5, -1.2), Label::text(family.words(lang)), Anchor::Start, "legend");
    }
}

fn against_distance(origin: Point, series: &[Near], subject: &str, lang: Lang) -> Vec<Item> {
    let all = || series.iter().flat_map(|n| &n.ways).filter_map(shown).map(log_error);
    let logs: Vec<f64> = series.iter().map(|n| libm::log10(n.distance)).collect();
    let (far, near) = (logs.iter().copied().fold(f64::NEG_INFINITY, f64::max), logs.iter().copied().fold(f64::INFINITY, f64::min));
    let mut panel = Panel::new(origin, [far, near], [libm::floor(all().fold(0.0, f64::min)), 1.0]);
    let y_title = match lang {
        Lang::En => format!("relative error of the {subject}"),
        Lang::Zh => format!("{subject}的相对误差"),
    };
    panel.axes(tr(lang, "distance of the driver from its limit, rad (m)", "原动件距极限位置，rad（m）"), &y_title);
    let Some(first) = series.iter().find(|n| !n.ways.is_empty()) else { return panel.done() };
    let mut ends: Vec<(Point, String)> = Vec::new();
    for (k, way) in first.ways.iter().map(|m| m.way).enumerate() {
        let points: Vec<Point> =
            series.iter().filter_map(|n| Some(panel.at(libm::log10(n.distance), log_error(shown(n.ways.get(k)?)?)))).collect();
        let Some(family) = Family::of(way) else { continue };
        panel.curve(&points, Dash::Solid);
        for at in &points {
            panel.items.push(family.symbol(*at));
        }
        if let Some(last) = points.last() {
            ends.push((*last, name(way, lang)));
        }
    }
    // Names at the right, in the order of the curves' ends and at least a line apart.
    ends.sort_by(|a, b| b.0.y.total_cmp(&a.0.y));
    let mut y = f64::INFINITY;
    for (end, name) in ends {
        y = end.y.min(y - 5.0);
        let at = Point::new(panel.origin.x + PLOT[0] + 4.0, y);
        panel.items.push(Item::new("leader", Shape::Line { from: end, to: at, stroke: Stroke::new(0.12) }));
        panel.words(at + Vec2::new(1.0, -1.2), Label::text(name), Anchor::Start, "curve-name");
    }
    panel.done()
}
