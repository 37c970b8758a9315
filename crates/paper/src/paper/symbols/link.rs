//! Links: bars, plates, and the mark of a rigid corner.

use crate::paper::item::{Cap, Colour, Dash, FigureItem, LineStroke, PathPiece, Shape};
use crate::paper::style::Style;
use hodograph_base::geom::{Point, Vec2};

/// A link with two joints, or a bent one through several points.
pub fn link(style: &Style, points: &[Point]) -> Vec<FigureItem> {
    let shape = match *points {
        [from, to] => Shape::Line { from, to, stroke: style.link },
        _ => Shape::Polyline {
            points: points.to_vec(),
            closed: false,
            stroke: Some(style.link),
            fill: None,
        },
    };
    vec![FigureItem::new("link", shape)]
}

/// Returns the items drawn dashed, for a virtual (redundant) constraint.
pub fn dashed(items: Vec<FigureItem>) -> Vec<FigureItem> {
    let dashed = |stroke: LineStroke| LineStroke { cap: Cap::Butt, ..stroke.dashed(Dash::Dashed) };
    let change = |shape| match shape {
        Shape::Line { from, to, stroke } => Shape::Line { from, to, stroke: dashed(stroke) },
        Shape::Polyline { points, closed, stroke, fill } => {
            Shape::Polyline { points, closed, stroke: stroke.map(dashed), fill }
        }
        other @ (Shape::Path { .. }
        | Shape::Circle { .. }
        | Shape::Arc { .. }
        | Shape::Arrow { .. }
        | Shape::ArcArrow { .. }
        | Shape::Turned { .. }
        | Shape::Label { .. }) => other,
    };
    items.into_iter().map(|item| FigureItem { shape: change(item.shape), ..item }).collect()
}

/// A link with three or more joints: a plate filled with light grey.
pub fn plate(style: &Style, points: &[Point]) -> Vec<FigureItem> {
    let shape = Shape::Polyline {
        points: points.to_vec(),
        closed: true,
        stroke: Some(style.link),
        fill: Some(style.plate),
    };
    vec![FigureItem::new("link plate", shape)]
}

/// The outline of a round body, filled as a plate is; labels may be inside.
pub fn round_body(style: &Style, centre: Point, radius_mm: f64) -> Shape {
    let half = |from_rad: f64| PathPiece::Arc {
        centre,
        radius_mm,
        from_rad,
        to_rad: from_rad + std::f64::consts::PI,
    };
    Shape::Path {
        start: centre + Vec2::new(radius_mm, 0.0),
        pieces: vec![half(0.0), half(std::f64::consts::PI)],
        closed: true,
        stroke: Some(style.outline),
        fill: Some(style.plate),
    }
}

/// The mark of a rigid corner: the angle between two bars of one link, filled. Empty if the bars
/// have no direction or no angle between them.
pub fn weld(style: &Style, corner: Point, one: Point, other: Point) -> Vec<FigureItem> {
    let (Some(a), Some(b)) = ((one - corner).unit(), (other - corner).unit()) else {
        return Vec::new();
    };
    // The mark must extend well beyond the two thick lines to be visible.
    let leg = 3.2 * style.pin_radius_mm;
    let points = vec![corner, corner + a * leg, corner + b * leg];
    vec![FigureItem::new(
        "link weld",
        Shape::Polyline { points, closed: true, stroke: None, fill: Some(Colour::BLACK) },
    )]
}

/// Pitch of a spring's windings at its default length, and their half width.
const PITCH_MM: f64 = 2.4;
const HALF_WIDTH_MM: f64 = 1.8;
/// Fraction of a spring's length that is straight at each end.
const STRAIGHT: f64 = 0.2;

/// A coil spring between two points: a zigzag line.
pub fn spring(style: &Style, from: Point, to: Point) -> Vec<FigureItem> {
    let along = to - from;
    let Some(across) = along.unit().map(Vec2::perp) else { return Vec::new() };
    let coil = 1.0 - 2.0 * STRAIGHT;
    let corners = 2 * (along.norm() * coil / PITCH_MM).clamp(4.0, 12.0) as usize;
    let corner = |k: usize| {
        let side = if k.is_multiple_of(2) { HALF_WIDTH_MM } else { -HALF_WIDTH_MM };
        from + along * (STRAIGHT + coil * (k as f64 + 0.5) / corners as f64) + across * side
    };
    let points = [from, from + along * STRAIGHT]
        .into_iter()
        .chain((0..corners).map(corner))
        .chain([to + along * -STRAIGHT, to]);
    let shape = Shape::Polyline {
        points: points.collect(),
        closed: false,
        stroke: Some(style.thin),
        fill: None,
    };
    vec![FigureItem::new("spring", shape)]
}
