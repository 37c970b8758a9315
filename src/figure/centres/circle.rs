//! The circle diagram (点元法): links on a circle, a chord for each centre, solid for those of the pairs, dashed and numbered in the order
//! of finding for the others; beside it the list of the lines that find them.

use crate::centres::{Centres, How};
use crate::figure::drawing::{Drawing, Part};
use crate::figure::extent::{Rect, bounds, on_circle};
use crate::figure::item::{Anchor, Colour, Dash, Item, Shape};
use crate::figure::label::Label;
use crate::figure::list::Wanted;
use crate::figure::place::LabelRequest;
use crate::figure::symbols as sym;
use crate::geom::{Point, Vec2};
use crate::plan::names::name_label;
use crate::report::centres::Words;
use std::f64::consts::{FRAC_PI_2, TAU};

use super::symbol;

/// Radius of the circle: chords between neighbours keep this length.
const SIDE_MM: f64 = 22.0;
/// The smallest and the largest circle.
const RADIUS_MM: [f64; 2] = [22.0, 75.0];
/// Between the circle and the list, and between two columns of it.
const GAP_MM: f64 = 8.0;
/// More rows than this make two columns.
const ROWS: usize = 22;
/// Up to here numbers have circles in the fonts.
const CIRCLED: usize = 20;

/// The diagram with its list.
pub fn part(w: &Wanted, found: &Centres) -> Part {
    let diagram = chords(w, found);
    let mut items = diagram.items;
    let right = diagram.bounds.max.x + GAP_MM;
    items.extend(list(w, found, Point::new(right, diagram.bounds.max.y)));
    Part { placements: diagram.placements, left_out: diagram.left_out, ..Part::of(items) }
}

/// The centres that are not of a pair, numbered from 1 on.
fn numbered(found: &Centres) -> impl Iterator<Item = (usize, &crate::centres::Centre)> {
    let later = found.list.iter().filter(|c| !matches!(c.step.how, How::Primary(_)));
    later.enumerate().map(|(k, c)| (k + 1, c))
}

fn number(k: usize) -> String {
    if k <= CIRCLED { format!("\\circled{{{k}}}") } else { format!("({k})") }
}

fn chords(w: &Wanted, found: &Centres) -> Part {
    let style = &w.options.style;
    let links = &found.closure.links;
    let n = links.len().max(2) as f64;
    let radius = (SIDE_MM / 2.0 / libm::sin(std::f64::consts::PI / n)).clamp(RADIUS_MM[0], RADIUS_MM[1]);
    // The first link at the top, the others clockwise.
    let at = |l| {
        let k = links.iter().position(|m| *m == l).unwrap_or(0);
        on_circle(Point::ORIGIN, radius, FRAC_PI_2 - TAU * k as f64 / n)
    };
    let mut d = Drawing::new("circle", style.clone());
    let outline = Shape::Circle { centre: Point::ORIGIN, radius_mm: radius, stroke: Some(style.thin.coloured(Colour::grey(170))), fill: None };
    d.frame("circle", "circle", outline);
    let mut owners = vec![0; found.list.len()];
    for (k, c) in found.list.iter().enumerate() {
        let (from, to) = (at(c.step.pair.i), at(c.step.pair.j));
        let (class, stroke) = match c.step.how {
            How::Primary(_) => ("chord primary", style.outline),
            How::Lines(_) => ("chord found", style.thin.dashed(Dash::Dashed)),
            How::Velocities => ("chord velocities", style.thin.dashed(Dash::DashDot)),
        };
        owners[k] = d.shape(&format!("chord-{}", c.step.pair.name(w.scene)), class, Shape::Line { from, to, stroke });
    }
    let primary = found.list.iter().filter(|c| matches!(c.step.how, How::Primary(_))).count();
    for (k, c) in numbered(found) {
        let (from, to) = (at(c.step.pair.i), at(c.step.pair.j));
        // Near the ends chords run together.
        let (from, to) = (from + (to - from) * 0.14, to + (from - to) * 0.14);
        let request = LabelRequest::along(Label::math(number(k)), style.small_mm, from, to, style.thin.width_mm / 2.0);
        d.label(&format!("order-{k}"), "order", request.owned(owners[primary + k - 1]));
    }
    for l in links {
        let place = at(*l);
        let name = w.scene.link_name(*l);
        d.draw(&format!("node-{name}"), "node", sym::dot(style, place));
        let text = name_label(name);
        let outward: Vec2 = place - Point::ORIGIN;
        d.label_at(&format!("node-{name}"), "node", &text, place, style.dot_radius_mm, Some(outward));
    }
    d.finish()
}

/// The list: a row for each numbered centre; its upper left corner stands at `corner`.
fn list(w: &Wanted, found: &Centres, corner: Point) -> Vec<Item> {
    let style = &w.options.style;
    let words = Words::new(found, w.options.lang);
    let line = style.small_mm * 1.7;
    let rows = numbered(found).count();
    let per_column = if rows > ROWS { rows.div_ceil(2) } else { rows };
    let mut items: Vec<Item> = Vec::new();
    let mut left = corner.x;
    let mut column = 0;
    for (k, c) in numbered(found) {
        if per_column > 0 && (k - 1) / per_column > column {
            column = (k - 1) / per_column;
            left = bounds(&items).map_or(left, |b: Rect| b.max.x + GAP_MM);
        }
        let row = (k - 1) % per_column.max(1);
        let by = if c.step.how == How::Velocities { ": " } else { " = " };
        let text = Label::math(format!("{}\\,\\, {}", number(k), symbol(w.scene, c.step.pair))).then(Label::text(format!("{by}{}", words.found_by(c))));
        let shape = Shape::Label {
            at: Point::new(left, corner.y - line * (row as f64 + 1.0)),
            label: text.in_fonts(&style.fonts),
            size_mm: style.small_mm,
            anchor: Anchor::Start,
            colour: Colour::BLACK,
        };
        items.push(Item::new("circle list", shape).with_id(format!("circle-list-{k}")));
    }
    items
}
