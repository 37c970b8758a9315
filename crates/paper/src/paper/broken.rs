//! Thin lines are broken where something written or hatched lies in their way.
//!
//! # Source
//! GB/T 4458.4 and ISO 129-1: no line goes through a figure; where that cannot be avoided the line is broken.

use std::f64::consts::TAU;

use crate::geom::Point;

use super::extent::{Rect, on_circle};
use super::item::{Item, Piece, Shape, Stroke};

/// Lines from this width on are drawn to be seen, and stay whole.
const THICK_MM: f64 = 0.33;
/// Air between letters and the ends of a broken line.
const AIR_MM: f64 = 0.3;
/// How finely breaks are measured.
const STEP_MM: f64 = 0.1;
/// Of a line of which less than this part is left one would not see what it joins: it stays whole.
const LEFT_PART: f64 = 0.5;

/// The parts of a way from 0 to 1 that nothing hides, in so many steps.
pub fn seen(steps: usize, hidden: impl Fn(f64) -> bool) -> Vec<[f64; 2]> {
    let at = |k: usize| k as f64 / steps as f64;
    let (mut runs, mut begin) = (Vec::new(), None);
    for k in 0..=steps {
        match (hidden(at(k)), begin) {
            (false, None) => begin = Some(at(k)),
            (true, Some(from)) => {
                runs.push([from, at(k - 1)]);
                begin = None;
            }
            (true, None) | (false, Some(_)) => {}
        }
    }
    runs.extend(begin.map(|from| [from, 1.0]));
    runs.retain(|[from, to]| to > from);
    runs
}

/// A line without an area.
enum Way {
    Straight(Point, Point),
    Bent { centre: Point, radius_mm: f64, from_rad: f64, sweep_rad: f64 },
}

impl Way {
    /// That of a thin item, and its stroke.
    fn thin(shape: &Shape) -> Option<(Way, Stroke)> {
        let (way, stroke) = match shape {
            Shape::Line { from, to, stroke } => (Way::Straight(*from, *to), *stroke),
            Shape::Arc { centre, radius_mm, from_rad, to_rad, stroke } => {
                (Way::Bent { centre: *centre, radius_mm: *radius_mm, from_rad: *from_rad, sweep_rad: to_rad - from_rad }, *stroke)
            }
            Shape::Circle { centre, radius_mm, stroke: Some(stroke), fill: None } => {
                (Way::Bent { centre: *centre, radius_mm: *radius_mm, from_rad: 0.0, sweep_rad: TAU }, *stroke)
            }
            Shape::Circle { .. }
            | Shape::Polyline { .. }
            | Shape::Path { .. }
            | Shape::Arrow { .. }
            | Shape::ArcArrow { .. }
            | Shape::Label { .. }
            | Shape::Turned { .. } => return None,
        };
        (stroke.width_mm < THICK_MM).then_some((way, stroke))
    }

    fn length_mm(&self) -> f64 {
        match self {
            Way::Straight(from, to) => from.distance(*to),
            Way::Bent { radius_mm, sweep_rad, .. } => radius_mm * sweep_rad.abs(),
        }
    }

    fn at(&self, t: f64) -> Point {
        match self {
            Way::Straight(from, to) => *from + (*to - *from) * t,
            Way::Bent { centre, radius_mm, from_rad, sweep_rad } => on_circle(*centre, *radius_mm, from_rad + sweep_rad * t),
        }
    }

    fn piece(&self, [from, to]: [f64; 2]) -> Piece {
        match self {
            Way::Straight(..) => Piece::Line(self.at(to)),
            Way::Bent { centre, radius_mm, from_rad, sweep_rad } => Piece::Arc {
                centre: *centre,
                radius_mm: *radius_mm,
                from_rad: from_rad + sweep_rad * from,
                to_rad: from_rad + sweep_rad * to,
            },
        }
    }
}

/// Breaks the thin lines among these items at the boxes of labels.
pub fn break_at(items: &mut [Item], labels: &[Rect]) {
    for item in items {
        let Some((way, stroke)) = Way::thin(&item.shape) else { continue };
        let Some(bounds) = item.bounds() else { continue };
        let near: Vec<Rect> = labels.iter().map(|r| r.grown(AIR_MM)).filter(|r| r.overlap_mm2(bounds) > 0.0).collect();
        if near.is_empty() {
            continue;
        }
        let inside = |r: &Rect, p: Point| p.x > r.min.x && p.x < r.max.x && p.y > r.min.y && p.y < r.max.y;
        let steps = (way.length_mm() / STEP_MM).ceil().max(1.0) as usize;
        let runs = seen(steps, |t| near.iter().any(|r| inside(r, way.at(t))));
        let left: f64 = runs.iter().map(|[from, to]| to - from).sum();
        if left > LEFT_PART && left < 1.0 {
            let start = way.at(runs[0][0]);
            let pieces = runs.iter().flat_map(|run| [Piece::Move(way.at(run[0])), way.piece(*run)]).skip(1).collect();
            item.shape = Shape::Path { start, pieces, closed: false, stroke: Some(stroke), fill: None };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thin_line_is_broken_at_a_label_and_a_thick_one_is_not() {
        let label = Rect::new(Point::new(4.0, -1.0), Point::new(6.0, 1.0));
        let line = |width| Item::new("", Shape::Line { from: Point::ORIGIN, to: Point::new(20.0, 0.0), stroke: Stroke::new(width) });
        let ring = Shape::Circle { centre: Point::new(5.0, 9.0), radius_mm: 9.0, stroke: Some(Stroke::new(0.2)), fill: None };
        let mut items = [line(0.2), line(0.4), Item::new("", ring)];
        break_at(&mut items, &[label]);
        let parts = |item: &Item| match &item.shape {
            Shape::Path { pieces, .. } => pieces.iter().filter(|p| !matches!(p, Piece::Move(_))).count(),
            _ => 0,
        };
        assert_eq!(items.each_ref().map(parts), [2, 0, 2]);
        let ends = [items[0].bounds().unwrap(), line(0.2).bounds().unwrap()];
        assert!(ends[0].min.distance(ends[1].min) < 1e-9 && ends[0].max.distance(ends[1].max) < 1e-9, "{ends:?}");
    }

    #[test]
    fn a_line_that_would_be_gone_stays() {
        let label = Rect::new(Point::new(1.0, -1.0), Point::new(9.0, 1.0));
        let shape = Shape::Line { from: Point::ORIGIN, to: Point::new(10.0, 0.0), stroke: Stroke::new(0.2) };
        let mut items = [Item::new("", shape.clone())];
        break_at(&mut items, &[label]);
        assert_eq!(items[0].shape, shape);
    }
}
