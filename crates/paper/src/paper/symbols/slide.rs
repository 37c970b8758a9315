//! Sliding pairs: guides, blocks, slots, cylinders.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::paper::extent::on_circle;
use crate::paper::item::{Colour, Dash, FigureItem, LineStroke, PathPiece, Shape};
use crate::paper::style::Style;
use hodograph_base::geom::{Point, Vec2};

use super::joint::ground_line;

/// The form of a fixed guide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GuideForm {
    /// One hatched line, on the right-hand side of the direction.
    OneSided,
    /// A hatched line on each side.
    TwoSided,
}

/// A fixed guide of a slider's block: hatched ground along the block's sides.
pub fn guide(
    style: &Style,
    centre: Point,
    angle_rad: f64,
    length_mm: f64,
    kind: GuideForm,
) -> Vec<FigureItem> {
    let along = Vec2::from_angle(angle_rad) * (length_mm / 2.0);
    // The block's side and the guide's line coincide: two lines there would look like one thick
    // line.
    let off = Vec2::from_angle(angle_rad).perp() * (style.block_width_mm / 2.0);
    let mut items = ground_line(style, centre - along - off, centre + along - off);
    if kind == GuideForm::TwoSided {
        items.extend(ground_line(style, centre + along + off, centre - along + off));
    }
    items
}

/// A slider's block around a joint, with its long side along `angle_rad`.
///
/// With `through`, the link on which it slides is shown dashed inside. The caller draws the pin,
/// over the link that ends there.
pub fn block(style: &Style, at: Point, angle_rad: f64, through: bool) -> Vec<FigureItem> {
    let u = Vec2::from_angle(angle_rad) * (style.block_length_mm / 2.0);
    let n = Vec2::from_angle(angle_rad).perp() * (style.block_width_mm / 2.0);
    let points = vec![at + u + n, at - u + n, at - u - n, at + u - n];
    let outline = Shape::Polyline {
        points,
        closed: true,
        stroke: Some(style.outline),
        fill: Some(Colour::WHITE),
    };
    let mut items = vec![FigureItem::new("slider", outline)];
    if through {
        let hidden =
            Shape::Line { from: at - u, to: at + u, stroke: style.thin.dashed(Dash::Dashed) };
        items.push(FigureItem::new("slider hidden", hidden));
    }
    items
}

/// A straight slot with round ends: `from` and `to` are the outermost positions of the pin in it.
pub fn slot(style: &Style, from: Point, to: Point) -> Vec<FigureItem> {
    let r = style.slot_width_mm / 2.0;
    let u = (to - from).unit().unwrap_or(Vec2::new(1.0, 0.0));
    let (n, a) = (u.perp() * r, u.angle());
    let pieces = vec![
        PathPiece::Line(to - n),
        PathPiece::Arc { centre: to, radius_mm: r, from_rad: a - FRAC_PI_2, to_rad: a + FRAC_PI_2 },
        PathPiece::Line(from + n),
        PathPiece::Arc {
            centre: from,
            radius_mm: r,
            from_rad: a + FRAC_PI_2,
            to_rad: a + 3.0 * FRAC_PI_2,
        },
    ];
    vec![slot_item(style, from - n, pieces)]
}

/// A slot along an arc, with round ends; counter-clockwise if `to_rad` > `from_rad`. `radius_mm` is
/// the radius of its centre line and larger than half the slot's width.
pub fn slot_arc(
    style: &Style,
    centre: Point,
    radius_mm: f64,
    from_rad: f64,
    to_rad: f64,
) -> Vec<FigureItem> {
    let r = style.slot_width_mm / 2.0;
    let (a, b) = (from_rad.min(to_rad), from_rad.max(to_rad));
    let pieces = vec![
        PathPiece::Arc { centre, radius_mm: radius_mm + r, from_rad: a, to_rad: b },
        PathPiece::Arc {
            centre: on_circle(centre, radius_mm, b),
            radius_mm: r,
            from_rad: b,
            to_rad: b + PI,
        },
        PathPiece::Arc { centre, radius_mm: radius_mm - r, from_rad: b, to_rad: a },
        PathPiece::Arc {
            centre: on_circle(centre, radius_mm, a),
            radius_mm: r,
            from_rad: a + PI,
            to_rad: a + 2.0 * PI,
        },
    ];
    vec![slot_item(style, on_circle(centre, radius_mm + r, a), pieces)]
}

fn slot_item(style: &Style, start: Point, pieces: Vec<PathPiece>) -> FigureItem {
    FigureItem::new(
        "slot",
        Shape::Path {
            start,
            pieces,
            closed: true,
            stroke: Some(style.outline),
            fill: Some(Colour::WHITE),
        },
    )
}

/// A cylinder with its piston and rod, from the joint `base` of the barrel to the joint `tip` of
/// the rod.
///
/// The barrel is `barrel_mm` long; the piston position corresponds to a rod of the same length,
/// limited to the inside of the barrel.
pub fn cylinder(style: &Style, base: Point, tip: Point, barrel_mm: f64) -> Vec<FigureItem> {
    let Some(u) = (tip - base).unit() else { return Vec::new() };
    let n = u.perp() * (style.block_width_mm / 2.0);
    let line = |from: Point, to: Point, stroke: LineStroke, class: &str| {
        FigureItem::new(class, Shape::Line { from, to, stroke })
    };
    // The bar between the joint's circle and the barrel's bottom is as long as the circle is wide.
    let bottom = base + u * (3.0 * style.pin_radius_mm);
    let mouth = bottom + u * barrel_mm;
    let margin = style.pin_radius_mm;
    let stroke_mm = (tip.distance(bottom) - barrel_mm).min(barrel_mm - margin).max(margin);
    let piston = bottom + u * stroke_mm;
    let barrel = vec![bottom + n, mouth + n, mouth - n, bottom - n];
    vec![
        FigureItem::new(
            "cylinder",
            Shape::Polyline {
                points: barrel,
                closed: true,
                stroke: Some(style.outline),
                fill: Some(style.plate),
            },
        ),
        line(base, bottom, style.link, "cylinder link"),
        line(piston, tip, style.link, "cylinder rod link"),
        line(piston + n, piston - n, style.link.flat(), "cylinder piston link"),
    ]
}
