//! Line diagrams: what a sweep found, against the position of the driver. One panel for each kind of quantity, all over one
//! another with the same axis below, extremes marked.
//!
//! Decided here: panels, axes, ticks and marks. What is shown was computed by [`crate::sweep`].

use super::extent::Rect;
use super::item::{Anchor, Colour, Dash, Figure, Item, PLACED, Shape, Stroke};
use super::label::Label;
use super::place::{LabelRequest, Obstacles, place};
use super::results::{number, symbol};
use super::style::Style;
use super::words::words;
use crate::answer::level_of;
use crate::geom::{Point, Vec2};
use crate::mechanism::Level;
use crate::plan::notation::Notation;
use crate::report::phrase::tr;
use crate::scene::{Asked, Lang, Scene};
use crate::sweep::Table;

/// A panel's plot, in mm: three stand over one another on A4 upright.
const PLOT_MM: [f64; 2] = [150.0, 62.0];
/// Room for the numbers of the vertical axis, and right of the plot for names.
const LEFT_MM: f64 = 30.0;
const RIGHT_MM: f64 = 24.0;
/// Between panels, above the first and below the last.
const BETWEEN_MM: f64 = 12.0;
const ABOVE_MM: f64 = 18.0;
const BELOW_MM: f64 = 18.0;
/// Steps between the ticks of an axis that people read without thinking, of a power of ten; for degrees their own.
const STEPS: [f64; 4] = [1.0, 2.0, 2.5, 5.0];
const DEGREES: [f64; 8] = [1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 60.0];
/// Lines of one panel are told apart without colour.
const DASHES: [Dash; 4] = [Dash::Solid, Dash::Dashed, Dash::DashDot, Dash::Dotted];
/// Units of driver and panels, upright in the label language.
const DEGREE: &str = "\\degree";
const MM: &str = "\\text{mm}";
/// What is smaller than this part of a line's largest value is where it passes zero: a magnitude's kink is found to 1e-6 of a step.
const ZERO: f64 = 1e-6;
/// Digits of the extremes: more than can be read off a diagram, and fewer than a sweep in `f64` has.
const DIGITS: usize = 4;

/// One line of a diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Its symbol, in the label language.
    pub symbol: String,
    /// Its values in the unit of its panel, one for each place of the driver.
    pub values: Vec<f64>,
    /// Its highest and lowest point: place of the driver and value.
    pub extremes: Vec<(f64, f64)>,
    /// The link whose motion it shows.
    pub link: Option<usize>,
}

/// Lines of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// The unit, in the label language.
    pub unit: String,
    /// The lines.
    pub curves: Vec<Curve>,
}

/// Tells where a column is highest (`true`) or lowest in a range of the driver: its place and value, all in SI.
pub type Located<'a> = dyn Fn(&str, [f64; 2], bool) -> Option<(f64, f64)> + 'a;

/// What is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagram {
    /// The driver's symbol and unit, in the label language.
    pub driver: [String; 2],
    /// Its places, increasing; where a step is longer than the usual one nothing is known between.
    pub places: Vec<f64>,
    /// The panels, from top to bottom.
    pub panels: Vec<Panel>,
}

impl Diagram {
    /// The answers of a sweep of one driver: displacements, angles, velocities, turning rates, accelerations, their rates, a
    /// panel each. A vector along one axis all the time (a slider's) is shown with its sign, any other by its magnitude.
    ///
    /// `located` tells where between the stations a column is highest (`true`) or lowest: from a range of the driver (SI) to
    /// its place and value (SI).
    pub fn of(scene: &Scene, table: &Table, notation: &Notation, located: &Located) -> Diagram {
        let column = |name: &str| table.column(name).map(|c| c.values.clone());
        let first = table.columns.first();
        let turns = first.is_some_and(|c| c.unit == "rad");
        let name = first.map_or("", |c| c.name.as_str());
        let driver = match name.split_once('_') {
            Some(("phi", link)) => format!("\\varphi_{{{link}}}"),
            Some((letter, of)) => format!("{letter}_{{{of}}}"),
            None => name.to_owned(),
        };
        let factor = if turns { 1.0_f64.to_degrees() } else { 1e3 };
        let si: &[f64] = first.map_or(&[], |c| &c.values);
        let places = si.iter().map(|v| v * factor).collect();
        let mut panels: Vec<(usize, Panel)> = Vec::new();
        for find in &scene.find {
            let (order, unit, times) = kind(&find.what);
            let parts = [".x", ".y"].map(|part| format!("{}{part}", find.text));
            let name = match parts.each_ref().map(|p| column(p)) {
                [Some(x), Some(y)] if vanishes(&y, &x) => &parts[0],
                [Some(x), Some(y)] if vanishes(&x, &y) => &parts[1],
                _ => &find.text,
            };
            let Some(values) = column(name) else { continue };
            let most = values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
            let shown: Vec<f64> = values.iter().map(|v| v * times).collect();
            let shown = if unit == DEGREE { unwound(&shown) } else { shown };
            let mut extremes = Vec::new();
            for highest in [true, false] {
                let by = |a: &usize, b: &usize| if highest { shown[*a].total_cmp(&shown[*b]) } else { shown[*b].total_cmp(&shown[*a]) };
                let Some(k) = (0..shown.len()).max_by(by) else { continue };
                let around = [si[k.saturating_sub(1)], si[(k + 1).min(si.len() - 1)]];
                // An angle is sought on the turn on which the line has it, so not across its jump.
                let found = located(name, around, highest).filter(|(_, v)| unit != DEGREE || (v - values[k]).abs() < 1.0);
                let (at, value) = found.unwrap_or((si[k], values[k]));
                let value = if value.abs() < ZERO * most { 0.0 } else { value };
                extremes.push((at * factor, shown[k] + (value - values[k]) * times));
            }
            if extremes.len() == 2 && extremes[0].1 <= extremes[1].1 {
                extremes.pop();
            }
            let curve = Curve { symbol: symbol(find, notation), values: shown, extremes, link: link(scene, &find.what) };
            match panels.iter_mut().find(|(o, _)| *o == order) {
                Some((_, panel)) => panel.curves.push(curve),
                None => panels.push((order, Panel { unit: unit.to_owned(), curves: vec![curve] })),
            }
        }
        panels.sort_by_key(|p| p.0);
        let unit = if turns { DEGREE } else { MM };
        Diagram { driver: [driver, unit.to_owned()], places, panels: panels.into_iter().map(|p| p.1).collect() }
    }
}

/// Which panel a quantity belongs to, the unit there, and how many of them an SI unit has.
fn kind(what: &Asked) -> (usize, &'static str, f64) {
    match what {
        Asked::Coordinate(..) | Asked::Distance(..) => (0, MM, 1e3),
        Asked::LinkAngle(_) => (1, DEGREE, 1.0_f64.to_degrees()),
        Asked::Omega(_) | Asked::RelativeOmega(..) => (3, "\\text{rad/s}", 1.0),
        Asked::Alpha(_) | Asked::RelativeAlpha(..) => (5, "\\text{rad/s}^2", 1.0),
        _ if level_of(what) == Level::Acceleration => (4, "\\text{m/s}^2", 1.0),
        _ => (2, "\\text{m/s}", 1.0),
    }
}

/// The link whose motion it is: of a pin's links the first that moves.
fn link(scene: &Scene, what: &Asked) -> Option<usize> {
    match *what {
        Asked::LinkAngle(l) | Asked::Omega(l) | Asked::Alpha(l) => Some(l.0),
        Asked::Velocity(p) | Asked::Acceleration(p) => p.link.or_else(|| scene.carriers(p.point).find(|l| *l != scene.ground)).map(|l| l.0),
        Asked::Coordinate(p, _) => scene.carriers(p).find(|l| *l != scene.ground).map(|l| l.0),
        _ => None,
    }
}

/// Whether one component is nothing but rounding beside the other.
fn vanishes(small: &[f64], large: &[f64]) -> bool {
    let most = |v: &[f64]| v.iter().filter(|x| x.is_finite()).fold(0.0, |m: f64, x| m.max(x.abs()));
    most(small) <= 1e-9 * most(large)
}

/// Angles (degrees) without their jumps by a whole turn.
fn unwound(degrees: &[f64]) -> Vec<f64> {
    let mut out: Vec<f64> = Vec::with_capacity(degrees.len());
    for d in degrees {
        let before = out.last().copied().unwrap_or(*d);
        out.push(d - 360.0 * libm::round((d - before) / 360.0));
    }
    out
}

/// Draws a diagram.
pub fn figure(scene: &Scene, diagram: &Diagram, style: &Style, lang: Lang) -> Figure {
    let n = diagram.panels.len().max(1) as f64;
    let width_mm = LEFT_MM + PLOT_MM[0] + RIGHT_MM;
    let height_mm = ABOVE_MM + n * PLOT_MM[1] + (n - 1.0) * BETWEEN_MM + BELOW_MM;
    let x = Axis::of(&diagram.places, diagram.driver[1] == DEGREE, 12);
    let title = scene.title.get(lang);
    let heading = if title.is_empty() { tr(lang, "Motion", "运动线图").to_owned() } else { title.to_owned() };
    let mut items = Vec::new();
    items.push(text(
        "title",
        Point::new(width_mm / 2.0, height_mm - 10.0),
        Label::text(heading.as_str()),
        style.caption_mm * 4.0 / 3.0,
        Anchor::Middle,
    ));
    let mut said = Vec::new();
    for (k, panel) in diagram.panels.iter().enumerate() {
        let top = height_mm - ABOVE_MM - k as f64 * (PLOT_MM[1] + BETWEEN_MM);
        let origin = Point::new(LEFT_MM, top - PLOT_MM[1]);
        let mut plot = Plot::new(style, origin, &x, panel, k, &diagram.driver[1]);
        plot.axes(k + 1 == diagram.panels.len(), &diagram.driver);
        plot.curves(&diagram.places, &mut said);
        items.extend(plot.finish());
    }
    let desc = match lang {
        Lang::En => format!("Diagrams against the position of the driver. {}.", said.join("; ")),
        Lang::Zh => format!("随原动件位置变化的线图。{}。", said.join("；")),
    };
    let mut figure = Figure { width_mm, height_mm, title: heading, desc, lang: words(lang).tag.into(), paper: Colour::WHITE, items };
    style.palette.paint(&mut figure);
    figure
}

fn text(class: &str, at: Point, label: Label, size_mm: f64, anchor: Anchor) -> Item {
    Item::new(class, Shape::Label { at, label, size_mm, anchor, colour: Colour::BLACK })
}

/// A range with ticks.
#[derive(Clone, Debug, PartialEq)]
struct Axis {
    from: f64,
    to: f64,
    step: f64,
}

impl Axis {
    /// The range of these values, widened to ticks; at most `most` steps.
    fn of(values: &[f64], degrees: bool, most: usize) -> Axis {
        let lo = values.iter().copied().fold(f64::INFINITY, f64::min);
        let hi = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        // Nothing, or one value alone: a range around it.
        let (lo, hi) = if lo < hi {
            (lo, hi)
        } else if lo.is_finite() {
            (lo - 0.5 * lo.abs().max(1.0), lo + 0.5 * lo.abs().max(1.0))
        } else {
            (0.0, 1.0)
        };
        let least = (hi - lo) / most as f64;
        let round = |step: f64| step >= least * (1.0 - 1e-9);
        let own = degrees.then(|| DEGREES.into_iter().find(|s| round(*s))).flatten();
        let decade = libm::floor(libm::log10(least)) as i32;
        let steps = (decade..=decade + 1).flat_map(|e| STEPS.map(|s| s * libm::pow(10.0, f64::from(e))));
        let step = own.or_else(|| steps.into_iter().find(|s| round(*s))).unwrap_or(least);
        // A hair beyond a tick is at the tick: 360.00000000000006° ends at 360°.
        Axis { from: libm::floor(lo / step + 1e-9) * step, to: libm::ceil(hi / step - 1e-9) * step, step }
    }

    fn part(&self, value: f64) -> f64 {
        ((value - self.from) / (self.to - self.from)).clamp(0.0, 1.0)
    }

    fn ticks(&self) -> impl Iterator<Item = f64> + '_ {
        let first = libm::round(self.from / self.step);
        let count = libm::round((self.to - self.from) / self.step) as usize;
        (0..=count).map(move |k| (first + k as f64) * self.step)
    }

    /// A tick's number, with no more places than the step has.
    fn name(&self, tick: f64) -> String {
        let places = (-libm::floor(libm::log10(self.step)) + 1.0).clamp(0.0, 12.0) as usize;
        let tick = if tick.abs() < self.step * 1e-6 { 0.0 } else { tick };
        let large = self.from.abs().max(self.to.abs());
        if large >= 1e5 || self.step < 1e-5 {
            return number(tick, 3);
        }
        let text = format!("{tick:.places$}");
        let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
        text.replace('-', "−")
    }
}

struct Plot<'a> {
    style: &'a Style,
    origin: Point,
    x: &'a Axis,
    y: Axis,
    panel: &'a Panel,
    index: usize,
    driver_unit: &'a str,
    items: Vec<Item>,
    /// Labels that want a place, and the link of each.
    wanted: Vec<(LabelRequest, Option<usize>)>,
}

impl<'a> Plot<'a> {
    fn new(style: &'a Style, origin: Point, x: &'a Axis, panel: &'a Panel, index: usize, driver_unit: &'a str) -> Plot<'a> {
        // Zero belongs to the diagram where it is near: only then is seen what changes its sense.
        let values: Vec<f64> = panel.curves.iter().flat_map(|c| c.values.iter().copied()).filter(|v| v.is_finite()).chain([0.0]).collect();
        Plot {
            style,
            origin,
            x,
            y: Axis::of(&values, panel.unit == DEGREE, 6),
            panel,
            index,
            driver_unit,
            items: Vec::new(),
            wanted: Vec::new(),
        }
    }

    fn at(&self, x: f64, y: f64) -> Point {
        self.origin + Vec2::new(self.x.part(x) * PLOT_MM[0], self.y.part(y) * PLOT_MM[1])
    }

    fn push(&mut self, what: &str, item: Item, link: Option<usize>) {
        let id = format!("panel-{}-{what}-{}", self.index, self.items.len());
        self.items.push(Item { link, ..item.with_id(id) });
    }

    fn line(&mut self, what: &str, from: Point, to: Point, stroke: Stroke) {
        self.push(what, Item::new(what, Shape::Line { from, to, stroke }), None);
    }

    fn axes(&mut self, last: bool, driver: &[String; 2]) {
        let (style, grid) = (self.style, Stroke::new(0.12).coloured(Colour::grey(190)));
        let small = style.small_mm;
        let (x, y) = (self.x, self.y.clone());
        for tick in x.ticks() {
            let (low, high) = (self.at(tick, y.from), self.at(tick, y.to));
            self.line("grid", low, high, grid);
            if last {
                let label = Label::math(x.name(tick));
                self.push("number", text("number", low - Vec2::new(0.0, small + 1.6), label, small, Anchor::Middle), None);
            }
        }
        for tick in y.ticks() {
            let (left, right) = (self.at(x.from, tick), self.at(x.to, tick));
            self.line("grid", left, right, grid);
            let label = Label::math(y.name(tick));
            self.push("number", text("number", left - Vec2::new(1.6, small * 0.33), label, small, Anchor::End), None);
        }
        let corners = vec![self.at(x.from, y.from), self.at(x.to, y.from), self.at(x.to, y.to), self.at(x.from, y.to)];
        self.push(
            "frame",
            Item::new("frame", Shape::Polyline { points: corners, closed: true, stroke: Some(style.thin), fill: None }),
            None,
        );
        if y.from < 0.0 && y.to > 0.0 {
            self.line("zero", self.at(x.from, 0.0), self.at(x.to, 0.0), style.thin);
        }
        let unit = Label::math(self.panel.unit.as_str());
        let corner = self.at(x.from, y.to);
        self.push("unit", text("unit", corner + Vec2::new(-1.6, 2.2), unit, small, Anchor::End), None);
        if last {
            let below = self.origin + Vec2::new(PLOT_MM[0] / 2.0, -2.0 * small - 5.0);
            let name = Label::math(format!("{},\\quad {}", driver[0], driver[1]));
            self.push("axis", text("axis", below, name, style.caption_mm, Anchor::Middle), None);
        }
    }

    fn curves(&mut self, places: &[f64], said: &mut Vec<String>) {
        let panel = self.panel;
        let usual = places.windows(2).map(|w| w[1] - w[0]).fold(f64::INFINITY, f64::min);
        for (k, curve) in panel.curves.iter().enumerate() {
            let stroke = self.style.vector.dashed(DASHES[k % DASHES.len()]);
            let known: Vec<(f64, f64)> = places.iter().copied().zip(curve.values.iter().copied()).filter(|(_, v)| v.is_finite()).collect();
            let apart = |w: &(f64, f64), v: &(f64, f64)| v.0 - w.0 <= 1.5 * usual;
            for run in known.chunk_by(apart).filter(|r| r.len() > 1) {
                let points: Vec<Point> = run.iter().map(|(x, y)| self.at(*x, *y)).collect();
                let shape = Shape::Polyline { points, closed: false, stroke: Some(stroke), fill: None };
                self.push("curve", Item::new("curve", shape), curve.link);
            }
            let texts: Vec<String> = curve
                .extremes
                .iter()
                .map(|(x, y)| {
                    format!("{} = {}\\,{} ({}\\,{})", curve.symbol, number(*y, DIGITS), panel.unit, number(*x, DIGITS), self.driver_unit)
                })
                .collect();
            said.extend(texts.iter().map(|t| Label::math(t.as_str()).plain()));
            for &(x, y) in &curve.extremes {
                let at = self.at(x, y);
                let dot = Shape::Circle { centre: at, radius_mm: self.style.dot_radius_mm, stroke: None, fill: Some(Colour::BLACK) };
                self.push("extreme", Item::new("extreme", dot), curve.link);
                let label = Label::math(number(y, DIGITS));
                let request = LabelRequest::at_point(label, self.style.small_mm, at, self.style.dot_radius_mm);
                self.wanted.push((request, curve.link));
            }
            // The name beside the line's highest lobe, where it is read first.
            let name_at = known[known.len() / 5 + (k * known.len() / 7) % known.len().max(1) / 2];
            let request =
                LabelRequest::at_point(Label::math(curve.symbol.as_str()), self.style.label_mm, self.at(name_at.0, name_at.1), 0.4);
            self.wanted.push((request, curve.link));
        }
    }

    fn finish(mut self) -> Vec<Item> {
        let ink: Vec<Item> = self.items.iter().filter(|i| i.class != "grid").cloned().collect();
        let bounds =
            Rect::new(self.origin - Vec2::new(0.0, 1.0), self.origin + Vec2::new(PLOT_MM[0] + RIGHT_MM, PLOT_MM[1] + BETWEEN_MM / 2.0));
        let requests: Vec<LabelRequest> = self.wanted.iter().map(|w| w.0.clone()).collect();
        let placed = place(&requests, &Obstacles::of(&ink), bounds);
        let links: Vec<Option<usize>> = self.wanted.iter().map(|w| w.1).collect();
        for ((request, place), link) in requests.iter().zip(&placed).zip(links) {
            for item in place.items(request, PLACED, self.style.thin) {
                self.push("label", item, link);
            }
        }
        self.items
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_that_people_read() {
        let degrees = Axis::of(&[0.0, 360.000_000_000_000_06], true, 12);
        assert_eq!((degrees.from, degrees.to, degrees.step), (0.0, 360.0, 30.0));
        let y = Axis::of(&[-0.31, 0.58], false, 6);
        assert_eq!((y.name(y.from), y.name(y.to), y.ticks().count()), ("−0.4".into(), "0.6".into(), 6));
        assert_eq!(Axis::of(&[2.0], false, 6).ticks().count(), 5);
        assert!(Axis::of(&[], false, 6).ticks().all(f64::is_finite));
        assert_eq!(Axis::of(&[0.0, 1e-9], false, 5).name(4e-10), "4.00 \\times 10^{−10}");
    }
}
