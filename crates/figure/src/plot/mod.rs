//! A plot: two axes with a frame and a grid, lines and marks in it, names that find their places or stand at the right.
//!
//! Decided here: what all plots have in common: where numbers, titles and names stand, and that labels keep off everything but
//! the grid. [`axis`] says where the ticks are; what is plotted is decided by who draws it.

mod axis;

pub(super) use axis::Axis;

use hodograph_base::geom::{Point, Vec2};
use hodograph_paper::paper::extent::Rect;
use hodograph_paper::paper::item::{Anchor, Colour, Item, PLACED, Shape, Stroke};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::{LabelRequest, Obstacles, place};
use hodograph_paper::paper::style::Style;

/// From the frame to the numbers at it.
const NUMBER_MM: f64 = 1.6;
/// From the frame up to the baseline of what the vertical axis tells: its descenders clear the number at the corner.
const UNIT_MM: f64 = 3.0;
/// Room that the numbers of a vertical axis take.
const NUMBERS_MM: f64 = 14.0;
/// Grid, leader lines.
const GRID: Stroke = Stroke::new(0.12);
/// Between the baselines of names at the right, in em.
const NAME_EM: f64 = 1.4;
/// From the frame to the names at its right: room for their leader lines.
const NAMES_MM: f64 = 4.0;

/// A quantity over its unit, as numbers at axes and in tables are told: `v_C/(m/s)`, `s/mm` (ISO 80000-1, GB/T 3101).
pub(super) fn over(symbol: &str, unit: &str) -> String {
    let composed = unit.contains(['/', '·', '^']) || unit == "\\degree";
    if composed { format!("{symbol}/({unit})") } else { format!("{symbol}/{unit}") }
}

/// A plot in the making.
pub(super) struct Plot<'a> {
    pub style: &'a Style,
    /// The frame.
    pub frame: Rect,
    /// Horizontal and vertical.
    pub axes: [Axis; 2],
    /// The first word of its items' names.
    name: String,
    items: Vec<Item>,
    /// Labels that want a place, and the link of each.
    wanted: Vec<(LabelRequest, Option<usize>)>,
}

impl<'a> Plot<'a> {
    pub fn new(name: String, style: &'a Style, frame: Rect, axes: [Axis; 2]) -> Plot<'a> {
        Plot { style, frame, axes, name, items: Vec::new(), wanted: Vec::new() }
    }

    /// Where a pair of values stands.
    pub fn at(&self, x: f64, y: f64) -> Point {
        let [u, v] = [self.axes[0].part(x), self.axes[1].part(y)];
        self.frame.min + Vec2::new(u * self.frame.width_mm(), v * self.frame.height_mm())
    }

    /// Draws a thing of a link, or of none.
    pub fn draw(&mut self, class: &str, shape: Shape, link: Option<usize>) {
        let id = format!("{}-{class}-{}", self.name, self.items.len());
        let item = Item { link, ..Item::new(class, shape).with_id(id) };
        self.items.push(item.in_fonts(&self.style.fonts));
    }

    pub fn line(&mut self, class: &str, from: Point, to: Point, stroke: Stroke) {
        self.draw(class, Shape::Line { from, to, stroke }, None);
    }

    /// Words whose place is given.
    pub fn words(&mut self, class: &str, at: Point, label: Label, size_mm: f64, anchor: Anchor) {
        self.draw(class, Shape::Label { at, label, size_mm, anchor, colour: Colour::BLACK }, None);
    }

    /// Asks for a label; it is placed when all is drawn.
    pub fn label(&mut self, mut request: LabelRequest, link: Option<usize>) {
        request.label = request.label.in_fonts(&self.style.fonts);
        self.wanted.push((request, link));
    }

    /// Grid, frame, numbers, the line of zero; the horizontal axis without numbers where it has no title, as it is then that of the
    /// plot below. The vertical one is named above its numbers.
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
            // Its middle at the line.
            let at = left - Vec2::new(NUMBER_MM, small * 0.33);
            self.words("number", at, Label::math(y.name(tick)), small, Anchor::End);
        }
        let corners = vec![frame.min, Point::new(frame.max.x, frame.min.y), frame.max, Point::new(frame.min.x, frame.max.y)];
        self.draw("frame", Shape::Polyline { points: corners, closed: true, stroke: Some(style.thin), fill: None }, None);
        if y.holds(0.0) {
            self.line("zero", self.at(x.from, 0.0), self.at(x.to, 0.0), style.thin);
        }
        let corner = Point::new(frame.min.x, frame.max.y) + Vec2::new(-NUMBER_MM, UNIT_MM);
        // Words wider than the numbers would leave the paper: they begin where those do.
        let wide = hodograph_paper::paper::text::set(&above.clone().in_fonts(&style.fonts)).width_em * small > NUMBERS_MM;
        let (back, anchor) = if wide { (NUMBERS_MM, Anchor::Start) } else { (0.0, Anchor::End) };
        self.words("unit", corner - Vec2::new(back, 0.0), above, small, anchor);
        if let Some(title) = below {
            let at = Point::new(frame.centre().x, frame.min.y - 2.0 * small - 5.0);
            self.words("axis", at, title, style.caption_mm, Anchor::Middle);
        }
    }

    /// Names at the right, each joined to its point by a thin line, in the order of the points and no nearer than a line.
    pub fn names(&mut self, mut ends: Vec<(Point, Label)>) {
        let small = self.style.small_mm;
        // Points that no one tells apart keep their order.
        ends.sort_by_key(|e| (-100.0 * e.0.y).round() as i64);
        let mut y = f64::INFINITY;
        for (end, name) in ends {
            y = end.y.min(y - NAME_EM * small);
            let at = Point::new(self.frame.max.x + NAMES_MM, y);
            self.line("leader", end, at, GRID);
            self.words("curve-name", at + Vec2::new(1.0, -small * 0.33), name, small, Anchor::Start);
        }
    }

    /// Places the labels within `bounds` and hands everything over.
    pub fn finish(mut self, bounds: Rect) -> Vec<Item> {
        let ink: Vec<Item> = self.items.iter().filter(|i| i.class != "grid").cloned().collect();
        let (requests, links): (Vec<LabelRequest>, Vec<Option<usize>>) = std::mem::take(&mut self.wanted).into_iter().unzip();
        let placed = place(&requests, &Obstacles::of(&ink), bounds);
        for ((request, place), link) in requests.iter().zip(&placed).zip(links) {
            for item in place.items(request, PLACED, self.style.thin) {
                let id = format!("{}-label-{}", self.name, self.items.len());
                self.items.push(Item { link, ..item.with_id(id) });
            }
        }
        self.items
    }
}
