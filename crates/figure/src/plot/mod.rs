//! A plot: two axes with a frame and a grid, with lines and marks, and names that are placed
//! automatically or are on the right.
//!
//! This module contains the common features of all plots: the places of numbers, titles and names;
//! labels keep clear of everything except the grid. [`axis`] computes the ticks; the callers choose
//! the content.

mod axis;

pub(super) use axis::PlotAxis;

use hodograph_base::geom::{Point, Vec2};
use hodograph_paper::paper::extent::Rect;
use hodograph_paper::paper::item::{Anchor, Colour, FigureItem, LineStroke, PLACED, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::{LabelRequest, Obstacles, place};
use hodograph_paper::paper::style::Style;

/// Distance from the frame to its numbers.
const NUMBER_MM: f64 = 1.6;
/// Distance from the frame up to the baseline of the vertical axis's quantity: its descenders clear
/// the number at the corner.
const UNIT_MM: f64 = 3.0;
/// Space for the numbers of a vertical axis.
const NUMBERS_MM: f64 = 14.0;
/// Stroke of grid and leader lines.
const GRID: LineStroke = LineStroke::new(0.12);
/// Distance between the baselines of names on the right (em).
const NAME_EM: f64 = 1.4;
/// Distance from the frame to the names on its right: space for their leader lines.
const NAMES_MM: f64 = 4.0;

/// Returns a quantity over its unit, as written at axes and in tables: `v_C/(m/s)`, `s/mm` (ISO
/// 80000-1, GB/T 3101).
pub(super) fn over(symbol: &str, unit: &str) -> String {
    let composed = unit.contains(['/', '·', '^']) || unit == "\\degree";
    if composed { format!("{symbol}/({unit})") } else { format!("{symbol}/{unit}") }
}

/// A plot under construction.
pub(super) struct Plot<'a> {
    pub style: &'a Style,
    /// The frame.
    pub frame: Rect,
    /// The horizontal and the vertical axis.
    pub axes: [PlotAxis; 2],
    /// The first word of the items' ids.
    name: String,
    items: Vec<FigureItem>,
    /// Labels to be placed, and the link of each.
    wanted: Vec<(LabelRequest, Option<usize>)>,
}

impl<'a> Plot<'a> {
    pub fn new(name: String, style: &'a Style, frame: Rect, axes: [PlotAxis; 2]) -> Plot<'a> {
        Plot { style, frame, axes, name, items: Vec::new(), wanted: Vec::new() }
    }

    /// Returns the position of a pair of values.
    pub fn at(&self, x: f64, y: f64) -> Point {
        let [u, v] = [self.axes[0].part(x), self.axes[1].part(y)];
        self.frame.min + Vec2::new(u * self.frame.width_mm(), v * self.frame.height_mm())
    }

    /// Draws a shape for a link, or for none.
    pub fn draw(&mut self, class: &str, shape: Shape, link: Option<usize>) {
        let id = format!("{}-{class}-{}", self.name, self.items.len());
        let item = FigureItem { link, ..FigureItem::new(class, shape).with_id(id) };
        self.items.push(item.in_fonts(&self.style.fonts));
    }

    pub fn line(&mut self, class: &str, from: Point, to: Point, stroke: LineStroke) {
        self.draw(class, Shape::Line { from, to, stroke }, None);
    }

    /// Draws text at a given place.
    pub fn words(&mut self, class: &str, at: Point, label: Label, size_mm: f64, anchor: Anchor) {
        self.draw(class, Shape::Label { at, label, size_mm, anchor, colour: Colour::BLACK }, None);
    }

    /// Requests a label; it is placed when everything is drawn.
    pub fn label(&mut self, mut request: LabelRequest, link: Option<usize>) {
        request.label = request.label.in_fonts(&self.style.fonts);
        self.wanted.push((request, link));
    }

    /// Draws grid, frame, numbers and the zero line. Without a title the horizontal axis has no
    /// numbers, because it is shared with the plot below. The vertical axis is named above its
    /// numbers.
    pub fn axes(&mut self, below: Option<Label>, above: Label) {
        let (style, frame) = (self.style, self.frame);
        let small = style.small_mm;
        let [x, y] = self.axes.clone();
        let grid = GRID.coloured(Colour::grey(190));
        for tick in x.ticks() {
            let (low, high) = (self.at(tick, y.from), self.at(tick, y.to));
            self.line("grid", low, high, grid);
            if below.is_some() {
                let at = low - Vec2::new(0.0, small + NUMBER_MM);
                self.words("number", at, Label::math(x.name(tick)), small, Anchor::Middle);
            }
        }
        for tick in y.ticks() {
            let (left, right) = (self.at(x.from, tick), self.at(x.to, tick));
            self.line("grid", left, right, grid);
            // Vertically centred on the line.
            let at = left - Vec2::new(NUMBER_MM, small * 0.33);
            self.words("number", at, Label::math(y.name(tick)), small, Anchor::End);
        }
        let corners = vec![
            frame.min,
            Point::new(frame.max.x, frame.min.y),
            frame.max,
            Point::new(frame.min.x, frame.max.y),
        ];
        self.draw(
            "frame",
            Shape::Polyline { points: corners, closed: true, stroke: Some(style.thin), fill: None },
            None,
        );
        if y.holds(0.0) {
            self.line("zero", self.at(x.from, 0.0), self.at(x.to, 0.0), style.thin);
        }
        let corner = Point::new(frame.min.x, frame.max.y) + Vec2::new(-NUMBER_MM, UNIT_MM);
        // Text wider than the numbers would leave the paper: it starts where the numbers start.
        let wide = hodograph_paper::paper::text::set(&above.clone().in_fonts(&style.fonts))
            .width_em
            * small
            > NUMBERS_MM;
        let (back, anchor) = if wide { (NUMBERS_MM, Anchor::Start) } else { (0.0, Anchor::End) };
        self.words("unit", corner - Vec2::new(back, 0.0), above, small, anchor);
        if let Some(title) = below {
            let at = Point::new(frame.centre().x, frame.min.y - 2.0 * small - 5.0);
            self.words("axis", at, title, style.caption_mm, Anchor::Middle);
        }
    }

    /// Draws names on the right, each joined to its point by a thin line, in the order of the
    /// points and at least a line apart.
    pub fn names(&mut self, mut ends: Vec<(Point, Label)>) {
        let small = self.style.small_mm;
        // Points that are not visibly distinct keep their order.
        ends.sort_by_key(|e| (-100.0 * e.0.y).round() as i64);
        let mut y = f64::INFINITY;
        for (end, name) in ends {
            y = end.y.min(y - NAME_EM * small);
            let at = Point::new(self.frame.max.x + NAMES_MM, y);
            self.line("leader", end, at, GRID);
            self.words(
                "curve-name",
                at + Vec2::new(1.0, -small * 0.33),
                name,
                small,
                Anchor::Start,
            );
        }
    }

    /// Places the labels within `bounds` and returns all items.
    pub fn finish(mut self, bounds: Rect) -> Vec<FigureItem> {
        let ink: Vec<FigureItem> =
            self.items.iter().filter(|i| i.class != "grid").cloned().collect();
        let (requests, links): (Vec<LabelRequest>, Vec<Option<usize>>) =
            std::mem::take(&mut self.wanted).into_iter().unzip();
        let placed = place(&requests, &Obstacles::of(&ink), bounds);
        for ((request, place), link) in requests.iter().zip(&placed).zip(links) {
            for item in place.items(request, PLACED, self.style.thin) {
                let id = format!("{}-label-{}", self.name, self.items.len());
                self.items.push(FigureItem { link, ..item.with_id(id) });
            }
        }
        self.items
    }
}
