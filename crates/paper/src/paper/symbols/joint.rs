//! Revolute joints, supports and the ground.

use crate::paper::item::{Colour, FigureItem, PathPiece, Shape};
use crate::paper::style::Style;
use hodograph_base::geom::{Point, Vec2};

/// A revolute joint: a white circle over the links that it connects.
pub fn pin(style: &Style, at: Point) -> Vec<FigureItem> {
    let shape = Shape::Circle {
        centre: at,
        radius_mm: style.pin_radius_mm,
        stroke: Some(style.outline),
        fill: Some(Colour::WHITE),
    };
    vec![FigureItem::new("pin", shape)]
}

/// A filled dot: a pole, a point of a link.
pub fn dot(style: &Style, at: Point) -> Vec<FigureItem> {
    vec![FigureItem::new(
        "dot",
        Shape::Circle {
            centre: at,
            radius_mm: style.dot_radius_mm,
            stroke: None,
            fill: Some(Colour::BLACK),
        },
    )]
}

/// A ground line with hatching on its right-hand side, seen from `from` to `to`.
pub fn ground_line(style: &Style, from: Point, to: Point) -> Vec<FigureItem> {
    let Some(along) = (to - from).unit() else { return Vec::new() };
    let length = from.distance(to);
    let depth = along * -style.hatch_depth_mm + -along.perp() * style.hatch_depth_mm;
    // Whole strokes at an even pitch, starting below the end towards which they lean.
    let count = (length / style.hatch_pitch_mm).floor().max(1.0) as usize;
    let pitch = length / count as f64;
    let foot = |k: usize| from + along * (pitch * (k as f64 + 1.0));
    let pieces = (0..count)
        .flat_map(|k| [PathPiece::Move(foot(k)), PathPiece::Line(foot(k) + depth)])
        .skip(1)
        .collect();
    vec![
        FigureItem::new(
            "ground hatch",
            Shape::Path {
                start: foot(0),
                pieces,
                closed: false,
                stroke: Some(style.thin),
                fill: None,
            },
        ),
        FigureItem::new("ground line", Shape::Line { from, to, stroke: style.outline }),
    ]
}

/// A ground arc, hatched on the side away from its centre or towards it.
pub fn ground_arc(
    style: &Style,
    centre: Point,
    radius_mm: f64,
    [from_rad, to_rad]: [f64; 2],
    outside: bool,
) -> Vec<FigureItem> {
    let side = if outside { 1.0 } else { -1.0 };
    let count = ((to_rad - from_rad) * radius_mm / style.hatch_pitch_mm).floor().max(1.0);
    let stroke = |k: f64| {
        let out = Vec2::from_angle(from_rad + (to_rad - from_rad) * (k + 0.5) / count);
        let foot = centre + out * radius_mm;
        [
            PathPiece::Move(foot),
            PathPiece::Line(foot + (out * side + out.perp()) * style.hatch_depth_mm),
        ]
    };
    let start = centre + Vec2::from_angle(from_rad + (to_rad - from_rad) * 0.5 / count) * radius_mm;
    let pieces = (0..count as usize).flat_map(|k| stroke(k as f64)).skip(1).collect();
    vec![
        FigureItem::new(
            "ground hatch",
            Shape::Path { start, pieces, closed: false, stroke: Some(style.thin), fill: None },
        ),
        FigureItem::new(
            "ground line",
            Shape::Arc { centre, radius_mm, from_rad, to_rad, stroke: style.outline },
        ),
    ]
}

/// A revolute joint on the ground: triangle, hatched ground line and pin.
///
/// `towards` is the direction from the joint to the ground, usually down; a zero vector means down.
pub fn fixed_pivot(style: &Style, at: Point, towards: Vec2) -> Vec<FigureItem> {
    let down = towards.unit().unwrap_or(Vec2::new(0.0, -1.0));
    let right = down.perp();
    let foot = at + down * style.pivot_height_mm;
    let half = right * style.pivot_half_base_mm;
    let triangle = Shape::Polyline {
        points: vec![at, foot + half, foot - half],
        closed: true,
        stroke: Some(style.outline),
        fill: Some(Colour::WHITE),
    };
    let ground = right * style.ground_half_mm;
    let mut items = vec![FigureItem::new("ground pivot", triangle)];
    items.extend(ground_line(style, foot - ground, foot + ground));
    items.extend(pin(style, at));
    items
}

/// A knife edge: a wedge with its tip at `tip`, extending in the direction `away`.
pub fn wedge(style: &Style, tip: Point, away: Vec2) -> FigureItem {
    let (length, half) = (3.2 * style.pin_radius_mm, 1.1 * style.pin_radius_mm);
    let (back, side) = (tip + away * length, away.perp() * half);
    let points = vec![tip, back + side, back - side];
    FigureItem::new(
        "",
        Shape::Polyline {
            points,
            closed: true,
            stroke: Some(style.outline),
            fill: Some(Colour::WHITE),
        },
    )
}
