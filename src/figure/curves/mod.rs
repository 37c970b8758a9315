//! Line diagrams: what a sweep found, against the position of the driver. One panel for each kind of quantity, all over one
//! another with the same axis below, extremes marked.
//!
//! Decided here: where panels, names and marks stand. [`diagram`] says what is shown, [`axis`] where the ticks are.

mod axis;
mod diagram;

pub use diagram::{Curve, Diagram, Panel};

use super::extent::Rect;
use super::item::{Anchor, Colour, Dash, Figure, Item, PLACED, Shape, Stroke};
use super::label::Label;
use super::place::{LabelRequest, Obstacles, place};
use super::results::number;
use super::style::Style;
use super::words::words;
use crate::geom::{Point, Vec2};
use crate::report::phrase::tr;
use crate::scene::{Lang, Scene};
use axis::Axis;
use diagram::DEGREE;

/// A panel's plot, in mm: three stand over one another on A4 upright.
const PLOT_MM: [f64; 2] = [150.0, 62.0];
/// Room for the numbers of the vertical axis, and right of the plot for names.
const LEFT_MM: f64 = 30.0;
const RIGHT_MM: f64 = 24.0;
/// Between panels, above the first and below the last.
const BETWEEN_MM: f64 = 12.0;
const ABOVE_MM: f64 = 18.0;
const BELOW_MM: f64 = 18.0;
/// Lines of one panel are told apart without colour.
const DASHES: [Dash; 4] = [Dash::Solid, Dash::Dashed, Dash::DashDot, Dash::Dotted];
/// Digits of the extremes: more than can be read off a diagram, and fewer than a sweep in `f64` has.
const DIGITS: usize = 4;

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
