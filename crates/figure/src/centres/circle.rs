//! The circle diagram (瞬心多边形): links as points on a circle, a chord for each centre. Chords of the
//! pairs are solid; those of the other centres are dashed and numbered in the order in which the
//! centres are found. A list beside the circle gives the lines that find them.

use crate::list::FigureInput;
use hodograph_base::geom::{Point, Vec2};
use hodograph_board::plan::names::name_label;
use hodograph_methods::centres::{Centre, CentreMethod, Centres};
use hodograph_paper::paper::drawing::{Drawing, DrawingPart};
use hodograph_paper::paper::extent::{Rect, bounds, on_circle};
use hodograph_paper::paper::item::{Anchor, Colour, Dash, FigureItem, Shape, tag};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::symbols as sym;
use hodograph_report::centres::CentreWords;
use std::f64::consts::{FRAC_PI_2, TAU};

use super::symbol;

/// Radius of the circle per link: leaves space for the numbers on the chords.
const RADIUS_PER_LINK_MM: f64 = 5.2;
/// The least and the greatest radius of the circle.
const RADIUS_MM: [f64; 2] = [22.0, 75.0];
/// Gap between circle and list, and between two columns of the list.
const GAP_MM: f64 = 8.0;
/// Maximum number of rows in one column.
const ROWS: usize = 22;
/// Size of the order numbers as a part of the small type: the disc of a two-digit number is no
/// taller than a line of the list.
const NUMBER_PART: f64 = 0.85;
/// Candidate places of a number on its chord, in fiftieths of the chord: not at the ends, where
/// chords converge.
const STATIONS: std::ops::RangeInclusive<usize> = 8..=42;

/// Draws the diagram with its list.
pub fn part(w: &FigureInput, found: &Centres) -> DrawingPart {
    drawn(w, found, false)
}

/// Draws the diagram with its list; each item of a centre has the centre's place in the order of
/// finding as its step.
pub fn stepped(w: &FigureInput, found: &Centres) -> DrawingPart {
    drawn(w, found, true)
}

fn drawn(w: &FigureInput, found: &Centres, stepped: bool) -> DrawingPart {
    let diagram = chords(w, found, stepped);
    let mut items = diagram.items;
    let right = diagram.bounds.max.x + GAP_MM;
    items.extend(list(w, found, Point::new(right, diagram.bounds.max.y), stepped));
    DrawingPart {
        placements: diagram.placements,
        left_out: diagram.left_out,
        ..DrawingPart::of(items)
    }
}

/// The centres that are not of a pair, numbered from 1, each with its index in the order of
/// finding.
fn numbered(found: &Centres) -> impl Iterator<Item = (usize, (usize, &Centre))> {
    let later = found
        .list
        .iter()
        .enumerate()
        .filter(|(_, c)| !matches!(c.step.how, CentreMethod::Primary(_)));
    later.enumerate().map(|(k, (place, c))| (place, (k + 1, c)))
}

/// The class of an item drawn for a centre.
fn class(word: &str, stepped: bool, place: usize) -> String {
    if stepped { format!("{word} step-{place}") } else { word.to_owned() }
}

/// A number in a disc.
fn badge(style: &Style, at: Point, k: usize) -> Vec<FigureItem> {
    let size_mm = style.small_mm * NUMBER_PART;
    let disc = Shape::Circle {
        centre: at,
        radius_mm: radius_of_badge(style),
        stroke: Some(style.thin),
        fill: Some(Colour::WHITE),
    };
    // Digits are about two thirds of their em tall.
    let label = Label::math(k.to_string()).in_fonts(&style.fonts);
    let at = Point::new(at.x, at.y - size_mm / 3.0);
    let number = Shape::Label { at, label, size_mm, anchor: Anchor::Middle, colour: Colour::BLACK };
    vec![FigureItem::new("order", disc), FigureItem::new("order number", number)]
}

fn radius_of_badge(style: &Style) -> f64 {
    style.small_mm * NUMBER_PART * 0.72
}

/// Distance of a point from a segment.
fn distance(p: Point, (a, b): (Point, Point)) -> f64 {
    let u = b - a;
    let t = (u.dot(p - a) / u.norm2()).clamp(0.0, 1.0);
    (a + u * t).distance(p)
}

/// For each numbered chord (an index) the place of its number: as far as possible from other chords
/// and from the numbers already placed; among equals the one nearer to the middle.
fn stations(chords: &[(Point, Point)], numbered: &[usize], disc_mm: f64) -> Vec<Point> {
    let mut placed: Vec<Point> = Vec::new();
    for k in numbered {
        let (a, b) = chords[*k];
        let worth = |p: Point| {
            let others =
                chords.iter().enumerate().filter(|(l, _)| l != k).map(|(_, c)| distance(p, *c));
            let numbers = placed.iter().map(|q| (p.distance(*q) - disc_mm) / 1.5);
            // A distance of one and a half discs from all others is enough.
            others.chain(numbers).fold(1.5 * disc_mm, f64::min)
        };
        let at = |t: usize| a + (b - a) * (t as f64 / 50.0);
        let cost = |t: &usize| 0.02 * (*t as f64 - 25.0).abs() - worth(at(*t));
        let best = STATIONS.min_by(|s, t| cost(s).total_cmp(&cost(t))).unwrap_or(25);
        placed.push(at(best));
    }
    placed
}

fn chords(w: &FigureInput, found: &Centres, stepped: bool) -> DrawingPart {
    let style = &w.options.style;
    let links = &found.closure.links;
    let n = links.len().max(2) as f64;
    let radius = (RADIUS_PER_LINK_MM * n).clamp(RADIUS_MM[0], RADIUS_MM[1]);
    // The first link at the top, the others clockwise.
    let at = |l| {
        let k = links.iter().position(|m| *m == l).unwrap_or(0);
        on_circle(Point::ORIGIN, radius, FRAC_PI_2 - TAU * k as f64 / n)
    };
    let mut d = Drawing::new("circle", style.clone());
    let outline = Shape::Circle {
        centre: Point::ORIGIN,
        radius_mm: radius,
        stroke: Some(style.thin.coloured(Colour::grey(170))),
        fill: None,
    };
    d.frame("circle", "circle", outline);
    let chord = |c: &Centre| (at(c.step.pair.i), at(c.step.pair.j));
    for (place, c) in found.list.iter().enumerate() {
        let (from, to) = chord(c);
        let (word, stroke) = match c.step.how {
            CentreMethod::Primary(_) => ("chord primary", style.outline),
            CentreMethod::Lines(_) => ("chord found", style.thin.dashed(Dash::Dashed)),
            CentreMethod::Velocities => ("chord velocities", style.thin.dashed(Dash::DashDot)),
        };
        d.shape(
            &format!("chord-{}", c.step.pair.name(w.scene)),
            &class(word, stepped, place),
            Shape::Line { from, to, stroke },
        );
    }
    let chords: Vec<(Point, Point)> = found.list.iter().map(chord).collect();
    let later: Vec<usize> = (0..chords.len())
        .filter(|k| !matches!(found.list[*k].step.how, CentreMethod::Primary(_)))
        .collect();
    for ((k, at), place) in
        stations(&chords, &later, radius_of_badge(style)).into_iter().enumerate().zip(&later)
    {
        d.draw(
            &format!("order-{}", k + 1),
            class("", stepped, *place).trim(),
            badge(style, at, k + 1),
        );
    }
    for l in links {
        let place = at(*l);
        let name = w.scene.link_name(*l);
        d.draw(&format!("node-{name}"), "node", sym::dot(style, place));
        let text = name_label(name);
        let outward: Vec2 = place - Point::ORIGIN;
        d.label_at(
            &format!("node-{name}"),
            "node",
            &text,
            place,
            style.dot_radius_mm,
            Some(outward),
        );
    }
    d.finish()
}

/// The list, with a row for each numbered centre and its upper left corner at `corner`.
fn list(w: &FigureInput, found: &Centres, corner: Point, stepped: bool) -> Vec<FigureItem> {
    let style = &w.options.style;
    let words = CentreWords::new(found, w.options.lang);
    let line = style.small_mm * 1.8;
    let rows = numbered(found).count();
    let per_column = if rows > ROWS { rows.div_ceil(2) } else { rows };
    let mut items: Vec<FigureItem> = Vec::new();
    let mut left = corner.x;
    let mut column = 0;
    for (place, (k, c)) in numbered(found) {
        if per_column > 0 && (k - 1) / per_column > column {
            column = (k - 1) / per_column;
            left = bounds(&items).map_or(left, |b: Rect| b.max.x + GAP_MM);
        }
        let row = (k - 1) % per_column.max(1);
        let by = if c.step.how == CentreMethod::Velocities { ": " } else { " = " };
        let text = Label::math(symbol(w.scene, c.step.pair))
            .then(Label::text(by))
            .then(words.found_by(c).label());
        let base = Point::new(left, corner.y - line * (row as f64 + 1.0));
        let disc = radius_of_badge(style);
        let mut number = badge(style, base + Vec2::new(disc, style.small_mm * 0.25), k);
        number
            .iter_mut()
            .enumerate()
            .for_each(|(part, item)| item.id = format!("circle-list-{k}-number-{part}"));
        if stepped {
            tag(&mut number, &format!("step-{place}"));
        }
        items.extend(number);
        let shape = Shape::Label {
            at: base + Vec2::new(2.0 * disc + style.small_mm * 0.5, 0.0),
            label: text.in_fonts(&style.fonts),
            size_mm: style.small_mm,
            anchor: Anchor::Start,
            colour: Colour::BLACK,
        };
        items.push(
            FigureItem::new(class("circle list", stepped, place), shape)
                .with_id(format!("circle-list-{k}")),
        );
    }
    let below = Shape::Label {
        at: Point::new(corner.x, corner.y - line * (per_column as f64 + 1.5)),
        label: words.absolute().label().in_fonts(&style.fonts),
        size_mm: style.small_mm,
        anchor: Anchor::Start,
        colour: Colour::BLACK,
    };
    items.push(FigureItem::new("circle list", below).with_id("circle-list-absolute"));
    items
}
