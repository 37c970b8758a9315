//! Bounding boxes of items, and their translation.

use hodograph_base::geom::{Point, Vec2};

use super::arrow;
use super::item::{Anchor, FigureItem, LineStroke, PathPiece, Shape};
use super::label::Label;
use super::text;

/// A rectangle with sides along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// Lower left corner.
    pub min: Point,
    /// Upper right corner.
    pub max: Point,
}

impl Rect {
    /// The rectangle between two opposite corners.
    pub fn new(a: Point, b: Point) -> Rect {
        Rect {
            min: Point::new(a.x.min(b.x), a.y.min(b.y)),
            max: Point::new(a.x.max(b.x), a.y.max(b.y)),
        }
    }

    /// The smallest rectangle that contains both.
    pub fn union(self, o: Rect) -> Rect {
        Rect {
            min: Point::new(self.min.x.min(o.min.x), self.min.y.min(o.min.y)),
            max: Point::new(self.max.x.max(o.max.x), self.max.y.max(o.max.y)),
        }
    }

    /// Returns the rectangle larger by `d_mm` on every side (smaller if negative).
    pub fn grown(self, d_mm: f64) -> Rect {
        Rect { min: self.min - Vec2::new(d_mm, d_mm), max: self.max + Vec2::new(d_mm, d_mm) }
    }

    /// Area common to both rectangles (mm²).
    pub fn overlap_mm2(self, o: Rect) -> f64 {
        let w = self.max.x.min(o.max.x) - self.min.x.max(o.min.x);
        let h = self.max.y.min(o.max.y) - self.min.y.max(o.min.y);
        w.max(0.0) * h.max(0.0)
    }

    /// Width of the rectangle.
    pub fn width_mm(self) -> f64 {
        self.max.x - self.min.x
    }

    /// Height of the rectangle.
    pub fn height_mm(self) -> f64 {
        self.max.y - self.min.y
    }

    /// Centre of the rectangle.
    pub fn centre(self) -> Point {
        Point::new((self.min.x + self.max.x) / 2.0, (self.min.y + self.max.y) / 2.0)
    }

    fn of_points(points: impl IntoIterator<Item = Point>) -> Option<Rect> {
        points.into_iter().map(|p| Rect::new(p, p)).reduce(Rect::union)
    }
}

/// Returns the point of a circle at an angle.
pub fn on_circle(centre: Point, radius_mm: f64, angle_rad: f64) -> Point {
    centre + Vec2::from_angle(angle_rad) * radius_mm
}

/// Points that determine the box around an arc: its ends and those of the four extremes that it
/// passes.
fn arc_points(centre: Point, radius_mm: f64, from_rad: f64, to_rad: f64) -> Vec<Point> {
    use std::f64::consts::FRAC_PI_2;
    let (lo, hi) = (from_rad.min(to_rad), from_rad.max(to_rad));
    let mut points = vec![on_circle(centre, radius_mm, lo), on_circle(centre, radius_mm, hi)];
    let first = (lo / FRAC_PI_2).ceil() as i64;
    points.extend(
        (first..first + 4)
            .map(|k| k as f64 * FRAC_PI_2)
            .filter(|&a| a <= hi)
            .map(|a| on_circle(centre, radius_mm, a)),
    );
    points
}

impl FigureItem {
    /// Returns true if every number of the item is finite. ([`FigureItem::bounds`] cannot show
    /// this: the smaller of NaN and 1 is 1.)
    pub fn is_finite(&self) -> bool {
        let all = |numbers: &[f64]| numbers.iter().all(|n| n.is_finite());
        match &self.shape {
            Shape::Line { from, to, .. } | Shape::Arrow { from, to, .. } => {
                from.is_finite() && to.is_finite()
            }
            Shape::Polyline { points, .. } => points.iter().all(|p| p.is_finite()),
            Shape::Path { start, pieces, .. } => {
                start.is_finite()
                    && pieces.iter().all(|p| match p {
                        PathPiece::Move(q) | PathPiece::Line(q) => q.is_finite(),
                        PathPiece::Arc { centre, radius_mm, from_rad, to_rad } => {
                            centre.is_finite() && all(&[*radius_mm, *from_rad, *to_rad])
                        }
                    })
            }
            Shape::Circle { centre, radius_mm, .. } => centre.is_finite() && radius_mm.is_finite(),
            Shape::Arc { centre, radius_mm, from_rad, to_rad, .. }
            | Shape::ArcArrow { centre, radius_mm, from_rad, to_rad, .. } => {
                centre.is_finite() && all(&[*radius_mm, *from_rad, *to_rad])
            }
            Shape::Label { at, size_mm, .. } => at.is_finite() && size_mm.is_finite(),
            Shape::Turned { at, size_mm, angle_rad, .. } => {
                at.is_finite() && all(&[*size_mm, *angle_rad])
            }
        }
    }

    /// Returns the bounding box of the item's ink; `None` for an item without ink, such as an empty
    /// label.
    pub fn bounds(&self) -> Option<Rect> {
        let half = |s: &Option<LineStroke>| s.map_or(0.0, |s| s.width_mm / 2.0);
        match &self.shape {
            Shape::Line { from, to, stroke } => {
                Some(Rect::new(*from, *to).grown(stroke.width_mm / 2.0))
            }
            Shape::Polyline { points, stroke, .. } => {
                Rect::of_points(points.iter().copied()).map(|r| r.grown(half(stroke)))
            }
            Shape::Path { start, pieces, stroke, .. } => {
                let mut points = vec![*start];
                for p in pieces {
                    match *p {
                        PathPiece::Move(q) | PathPiece::Line(q) => points.push(q),
                        PathPiece::Arc { centre, radius_mm, from_rad, to_rad } => {
                            points.extend(arc_points(centre, radius_mm, from_rad, to_rad));
                        }
                    }
                }
                Rect::of_points(points).map(|r| r.grown(half(stroke)))
            }
            Shape::Circle { centre, radius_mm, stroke, .. } => {
                Some(Rect::new(*centre, *centre).grown(radius_mm + half(stroke)))
            }
            Shape::Arc { centre, radius_mm, from_rad, to_rad, stroke } => {
                Rect::of_points(arc_points(*centre, *radius_mm, *from_rad, *to_rad))
                    .map(|r| r.grown(stroke.width_mm / 2.0))
            }
            Shape::Arrow { from, to, stroke, head } => {
                let shaft = Rect::new(*from, *to).grown(stroke.width_mm / 2.0);
                Some(
                    Rect::of_points(arrow::straight(*from, *to, *head).head)
                        .map_or(shaft, |h| shaft.union(h)),
                )
            }
            Shape::ArcArrow { centre, radius_mm, from_rad, to_rad, stroke, head } => {
                let arrow = arrow::bent(*centre, *radius_mm, *from_rad, *to_rad, *head);
                let mut points = arc_points(*centre, *radius_mm, *from_rad, *to_rad);
                points.extend(arrow.head);
                Rect::of_points(points).map(|r| r.grown(stroke.width_mm / 2.0))
            }
            Shape::Label { at, label, size_mm, anchor, .. } => {
                label_bounds(*at, label, *size_mm, *anchor)
            }
            Shape::Turned { at, angle_rad, label, size_mm, .. } => {
                Rect::of_points(turned_corners(*at, *angle_rad, label, *size_mm)?)
            }
        }
    }

    /// Moves the item.
    pub fn translate(&mut self, by: Vec2) {
        match &mut self.shape {
            Shape::Line { from, to, .. } | Shape::Arrow { from, to, .. } => {
                *from = *from + by;
                *to = *to + by;
            }
            Shape::Polyline { points, .. } => points.iter_mut().for_each(|p| *p = *p + by),
            Shape::Path { start, pieces, .. } => {
                *start = *start + by;
                for p in pieces {
                    match p {
                        PathPiece::Move(q) | PathPiece::Line(q) => *q = *q + by,
                        PathPiece::Arc { centre, .. } => *centre = *centre + by,
                    }
                }
            }
            Shape::Circle { centre, .. }
            | Shape::Arc { centre, .. }
            | Shape::ArcArrow { centre, .. } => *centre = *centre + by,
            Shape::Label { at, .. } | Shape::Turned { at, .. } => *at = *at + by,
        }
    }
}

/// Returns the box of a label's line (its advance by the height of its ink); `None` if it has no
/// ink.
pub fn label_bounds(at: Point, label: &Label, size_mm: f64, anchor: Anchor) -> Option<Rect> {
    let set = text::set(label);
    if !set.inked {
        return None;
    }
    let left = at.x - anchor_shift_em(anchor, set.width_em) * size_mm;
    Some(Rect {
        min: Point::new(left, at.y - set.descent_em * size_mm),
        max: Point::new(left + set.width_em * size_mm, at.y + set.ascent_em * size_mm),
    })
}

/// Returns the corners of the box of a turned label whose anchor (the middle of its baseline) is at
/// `at`, counter-clockwise from the start of the lower edge; `None` if it has no ink.
pub fn turned_corners(
    at: Point,
    angle_rad: f64,
    label: &Label,
    size_mm: f64,
) -> Option<[Point; 4]> {
    let level = label_bounds(Point::ORIGIN, label, size_mm, Anchor::Middle)?;
    let turn = Vec2::from_angle(angle_rad);
    let (lo, hi) = (level.min, level.max);
    Some(
        [(lo.x, lo.y), (hi.x, lo.y), (hi.x, hi.y), (lo.x, hi.y)]
            .map(|(x, y)| at + Vec2::new(x, y).rotate_by(turn)),
    )
}

/// Distance from the line's start to its anchor, in em.
pub fn anchor_shift_em(anchor: Anchor, width_em: f64) -> f64 {
    match anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => width_em / 2.0,
        Anchor::End => width_em,
    }
}

/// Moves a list of items.
pub fn translate(items: &mut [FigureItem], by: Vec2) {
    items.iter_mut().for_each(|item| item.translate(by));
}

/// Returns the bounding box of a list of items; `None` if none of them has ink.
pub fn bounds(items: &[FigureItem]) -> Option<Rect> {
    items.iter().filter_map(FigureItem::bounds).reduce(Rect::union)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paper::item::Colour;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn arc(from_rad: f64, to_rad: f64) -> FigureItem {
        let shape = Shape::Arc {
            centre: Point::new(1.0, 2.0),
            radius_mm: 3.0,
            from_rad,
            to_rad,
            stroke: LineStroke::new(0.2),
        };
        FigureItem::new("", shape)
    }

    #[test]
    fn box_of_an_arc_holds_the_extremes_it_passes() {
        let r = arc(-0.1, PI + 0.1).bounds().unwrap();
        assert!(
            (r.max.y - 5.1).abs() < 1e-9
                && (r.max.x - 4.1).abs() < 1e-9
                && (r.min.x + 2.1).abs() < 1e-9,
            "{r:?}"
        );
        let quarter = arc(FRAC_PI_2, 0.0).bounds().unwrap();
        assert!(
            (quarter.min.x - 0.9).abs() < 1e-9 && (quarter.min.y - 1.9).abs() < 1e-9,
            "{quarter:?}"
        );
    }

    #[test]
    fn translation_moves_the_box() {
        let path = Shape::Path {
            start: Point::ORIGIN,
            pieces: vec![
                PathPiece::Line(Point::new(4.0, 0.0)),
                PathPiece::Arc {
                    centre: Point::new(4.0, 1.0),
                    radius_mm: 1.0,
                    from_rad: -FRAC_PI_2,
                    to_rad: FRAC_PI_2,
                },
            ],
            closed: true,
            stroke: None,
            fill: Some(Colour::WHITE),
        };
        let label = Shape::Label {
            at: Point::ORIGIN,
            label: Label::math("v_B"),
            size_mm: 4.0,
            anchor: Anchor::Middle,
            colour: Colour::BLACK,
        };
        for mut item in [arc(0.0, 1.0), FigureItem::new("", path), FigureItem::new("", label)] {
            let before = item.bounds().unwrap();
            item.translate(Vec2::new(10.0, -5.0));
            let after = item.bounds().unwrap();
            assert!(
                (after.min.x - before.min.x - 10.0).abs() < 1e-9
                    && (after.max.y - before.max.y + 5.0).abs() < 1e-9
            );
        }
    }

    #[test]
    fn empty_label_has_no_box() {
        assert_eq!(label_bounds(Point::ORIGIN, &Label::text(""), 4.0, Anchor::Start), None);
    }
}
