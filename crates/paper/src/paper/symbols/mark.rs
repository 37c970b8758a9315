//! Marks beside the mechanism: sense of rotation, angles, dimensions, scales.

use crate::paper::item::{Anchor, Colour, FigureItem, Shape};
use crate::paper::label::Label;
use crate::paper::style::Style;
use hodograph_base::geom::{Point, Vec2};

/// The arrow of a rotation around `centre`, with its head at `to_rad`; counter-clockwise if
/// `to_rad` > `from_rad`.
pub fn rotation(
    style: &Style,
    centre: Point,
    radius_mm: f64,
    from_rad: f64,
    to_rad: f64,
) -> Vec<FigureItem> {
    vec![FigureItem::new(
        "rotation",
        Shape::ArcArrow {
            centre,
            radius_mm,
            from_rad,
            to_rad,
            stroke: style.vector,
            head: style.head,
        },
    )]
}

/// An angle at `centre` from a reference line, which is drawn, to an existing line; the head is at
/// the latter.
pub fn angle(
    style: &Style,
    centre: Point,
    radius_mm: f64,
    from_rad: f64,
    to_rad: f64,
) -> Vec<FigureItem> {
    // The reference line extends a third beyond the arc: an angle is legible only if the lines
    // cross.
    let along = Vec2::from_angle(from_rad);
    let (from, to) =
        (centre + along * style.pin_radius_mm, centre + along * (radius_mm * 4.0 / 3.0));
    vec![
        FigureItem::new("angle reference", Shape::Line { from, to, stroke: style.thin }),
        FigureItem::new(
            "angle",
            Shape::ArcArrow {
                centre,
                radius_mm,
                from_rad,
                to_rad,
                stroke: style.thin,
                head: style.thin_head,
            },
        ),
    ]
}

/// Returns the dimension line of [`dimension`], along which its label is placed.
pub fn dimension_line(from: Point, to: Point, offset_mm: f64) -> (Point, Point) {
    let n = (to - from).unit().unwrap_or(Vec2::new(1.0, 0.0)).perp() * offset_mm;
    (from + n, to + n)
}

/// A dimension from `from` to `to`, with its line `offset_mm` to the left of that direction (to the
/// right if negative).
pub fn dimension(style: &Style, from: Point, to: Point, offset_mm: f64) -> Vec<FigureItem> {
    let (a, b) = dimension_line(from, to, offset_mm);
    let (Some(out), Some(along)) = ((a - from).unit(), (b - a).unit()) else { return Vec::new() };
    let line = |from: Point, to: Point| Shape::Line { from, to, stroke: style.thin };
    // ISO 129-1: extension lines leave a gap at the object and extend slightly beyond the dimension
    // line.
    let (gap, past) = (out * (style.pin_radius_mm + 0.6), out * 1.2);
    let middle = a + along * (a.distance(b) / 2.0);
    let arrow =
        |to: Point| Shape::Arrow { from: middle, to, stroke: style.thin, head: style.thin_head };
    vec![
        FigureItem::new("dimension extension", line(from + gap, a + past)),
        FigureItem::new("dimension extension", line(to + gap, b + past)),
        FigureItem::new("dimension", arrow(a)),
        FigureItem::new("dimension", arrow(b)),
    ]
}

/// A graphic scale: a line of `length_mm` to the right of `from`, with a label at each end. It
/// stays true when the page is printed smaller or larger.
pub fn scale_bar(
    style: &Style,
    from: Point,
    length_mm: f64,
    [zero, end]: [Label; 2],
) -> Vec<FigureItem> {
    let to = from + Vec2::new(length_mm, 0.0);
    let tick = Vec2::new(0.0, style.small_mm * 0.3);
    let line = |from: Point, to: Point| {
        FigureItem::new("scale", Shape::Line { from, to, stroke: style.outline })
    };
    // Digits are about 0.66 em high: the line meets the middle of them.
    let beside = Vec2::new(style.small_mm * 0.3, 0.0);
    let below = Vec2::new(0.0, style.small_mm * 0.33);
    let text = |at: Point, label: Label, anchor: Anchor| {
        let size_mm = style.small_mm;
        let shape = Shape::Label { at: at - below, label, size_mm, anchor, colour: Colour::BLACK };
        FigureItem::new("scale label", shape)
    };
    vec![
        line(from, to),
        line(from - tick, from + tick),
        line(to - tick, to + tick),
        text(from - beside, zero, Anchor::End),
        text(to + beside, end, Anchor::Start),
    ]
}
