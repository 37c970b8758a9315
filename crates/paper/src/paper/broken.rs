//! Breaks thin lines at the boxes of labels.
//!
//! # Source
//! GB/T 4458.4 and ISO 129-1: no line passes through a dimension figure; where this cannot be
//! avoided, the line is broken.

use std::f64::consts::TAU;

use hodograph_base::geom::Point;

use super::extent::{Rect, on_circle};
use super::item::{FigureItem, LineStroke, PathPiece, Shape};

/// Smallest width of lines that are never broken.
const THICK_MM: f64 = 0.33;
/// Gap between letters and the ends of a broken line.
const AIR_MM: f64 = 0.3;
/// Step at which the hidden parts of a line are sampled.
const STEP_MM: f64 = 0.1;
/// A line is broken only if more than this fraction of it remains; otherwise the reader could not
/// see what it joins.
const LEFT_PART: f64 = 0.5;

/// Returns the visible runs of a line, as intervals of its parameter from 0 to 1, sampled in
/// `steps` steps.
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

/// The course of a line without an area.
enum LineCourse {
    /// A chain of straight lines: its corners, each with the length of the line up to it (mm).
    Straight(Vec<(Point, f64)>),
    Bent {
        centre: Point,
        radius_mm: f64,
        from_rad: f64,
        sweep_rad: f64,
    },
}

impl LineCourse {
    fn through(corners: impl IntoIterator<Item = Point>) -> LineCourse {
        let mut way: Vec<(Point, f64)> = Vec::new();
        for p in corners {
            let length = way.last().map_or(0.0, |(last, length)| length + last.distance(p));
            way.push((p, length));
        }
        LineCourse::Straight(way)
    }

    /// Returns the course and the stroke of a thin item; `None` for areas, labels and thick lines.
    fn thin(shape: &Shape) -> Option<(LineCourse, LineStroke)> {
        let (way, stroke) = match shape {
            Shape::Line { from, to, stroke } => (LineCourse::through([*from, *to]), *stroke),
            Shape::Arrow { from, to, stroke, .. } => (LineCourse::through([*from, *to]), *stroke),
            Shape::Polyline { points, closed, stroke: Some(stroke), fill: None }
                if points.len() > 1 =>
            {
                let back = points.first().copied().filter(|_| *closed);
                (LineCourse::through(points.iter().copied().chain(back)), *stroke)
            }
            Shape::Arc { centre, radius_mm, from_rad, to_rad, stroke }
            | Shape::ArcArrow { centre, radius_mm, from_rad, to_rad, stroke, .. } => (
                LineCourse::Bent {
                    centre: *centre,
                    radius_mm: *radius_mm,
                    from_rad: *from_rad,
                    sweep_rad: to_rad - from_rad,
                },
                *stroke,
            ),
            Shape::Circle { centre, radius_mm, stroke: Some(stroke), fill: None } => (
                LineCourse::Bent {
                    centre: *centre,
                    radius_mm: *radius_mm,
                    from_rad: 0.0,
                    sweep_rad: TAU,
                },
                *stroke,
            ),
            Shape::Circle { .. }
            | Shape::Polyline { .. }
            | Shape::Path { .. }
            | Shape::Label { .. }
            | Shape::Turned { .. } => return None,
        };
        (stroke.width_mm < THICK_MM).then_some((way, stroke))
    }

    fn length_mm(&self) -> f64 {
        match self {
            LineCourse::Straight(corners) => corners.last().map_or(0.0, |c| c.1),
            LineCourse::Bent { radius_mm, sweep_rad, .. } => radius_mm * sweep_rad.abs(),
        }
    }

    fn at(&self, t: f64) -> Point {
        match self {
            LineCourse::Straight(corners) => {
                let wanted = t * self.length_mm();
                let k = corners
                    .partition_point(|c| c.1 < wanted)
                    .min(corners.len().saturating_sub(1))
                    .max(1);
                let (Some((from, before)), Some((to, length))) =
                    (corners.get(k - 1).copied(), corners.get(k).copied())
                else {
                    return corners.first().map_or(Point::ORIGIN, |c| c.0);
                };
                if length > before {
                    from + (to - from) * ((wanted - before) / (length - before))
                } else {
                    to
                }
            }
            LineCourse::Bent { centre, radius_mm, from_rad, sweep_rad } => {
                on_circle(*centre, *radius_mm, from_rad + sweep_rad * t)
            }
        }
    }

    fn pieces(&self, [from, to]: [f64; 2]) -> Vec<PathPiece> {
        match self {
            LineCourse::Straight(corners) => {
                let whole = self.length_mm();
                let between = corners
                    .iter()
                    .filter(|c| from * whole < c.1 && c.1 < to * whole)
                    .map(|c| PathPiece::Line(c.0));
                between.chain([PathPiece::Line(self.at(to))]).collect()
            }
            LineCourse::Bent { centre, radius_mm, from_rad, sweep_rad } => vec![PathPiece::Arc {
                centre: *centre,
                radius_mm: *radius_mm,
                from_rad: from_rad + sweep_rad * from,
                to_rad: from_rad + sweep_rad * to,
            }],
        }
    }

    /// Returns the shape of one item that draws these runs of the line.
    fn path(&self, runs: &[[f64; 2]], stroke: LineStroke) -> Shape {
        let pieces = runs
            .iter()
            .flat_map(|run| {
                std::iter::once(PathPiece::Move(self.at(run[0]))).chain(self.pieces(*run))
            })
            .skip(1)
            .collect();
        Shape::Path {
            start: self.at(runs[0][0]),
            pieces,
            closed: false,
            stroke: Some(stroke),
            fill: None,
        }
    }
}

/// Returns the last run of a broken arrow, which keeps the head; `None` if the head itself would be
/// broken or made smaller.
fn with_head(shape: &Shape, way: &LineCourse, last: [f64; 2]) -> Option<Shape> {
    let mut shape = shape.clone();
    let head = match &mut shape {
        Shape::Arrow { from, head, .. } => {
            *from = way.at(last[0]);
            head
        }
        Shape::ArcArrow { from_rad, to_rad, head, .. } => {
            *from_rad += (*to_rad - *from_rad) * last[0];
            head
        }
        _ => return None,
    };
    let full = head.limited(way.length_mm()).length_mm;
    let whole = last[1] == 1.0 && head.limited((1.0 - last[0]) * way.length_mm()).length_mm == full;
    whole.then_some(shape)
}

/// Breaks the thin lines among these items at the boxes of labels.
///
/// The part of an arrow before its last break becomes an item of its own at the end of the list.
pub fn break_at(items: &mut Vec<FigureItem>, labels: &[Rect]) {
    let mut before = Vec::new();
    for item in items.iter_mut() {
        let Some((way, stroke)) = LineCourse::thin(&item.shape) else { continue };
        let Some(bounds) = item.bounds() else { continue };
        let near: Vec<Rect> = labels
            .iter()
            .map(|r| r.grown(AIR_MM))
            .filter(|r| r.overlap_mm2(bounds) > 0.0)
            .collect();
        if near.is_empty() {
            continue;
        }
        let inside =
            |r: &Rect, p: Point| p.x > r.min.x && p.x < r.max.x && p.y > r.min.y && p.y < r.max.y;
        let steps = (way.length_mm() / STEP_MM).ceil().max(1.0) as usize;
        let runs = seen(steps, |t| near.iter().any(|r| inside(r, way.at(t))));
        let left: f64 = runs.iter().map(|[from, to]| to - from).sum();
        if left > LEFT_PART && left < 1.0 {
            if !matches!(item.shape, Shape::Arrow { .. } | Shape::ArcArrow { .. }) {
                item.shape = way.path(&runs, stroke);
            } else if let [shaft @ .., last] = &runs[..]
                && let Some(headed) = with_head(&item.shape, &way, *last)
            {
                item.shape = headed;
                if !shaft.is_empty() {
                    let id = if item.id.is_empty() {
                        String::new()
                    } else {
                        format!("{}-shaft", item.id)
                    };
                    before.push(FigureItem {
                        id,
                        shown: None,
                        shape: way.path(shaft, stroke),
                        ..item.clone()
                    });
                }
            }
        }
    }
    items.append(&mut before);
}

#[cfg(test)]
mod tests {
    use super::super::arrow::ArrowHead;
    use super::*;

    #[test]
    fn a_thin_line_is_broken_at_a_label_and_a_thick_one_is_not() {
        let label = Rect::new(Point::new(4.0, -1.0), Point::new(6.0, 1.0));
        let line = |width| {
            FigureItem::new(
                "",
                Shape::Line {
                    from: Point::ORIGIN,
                    to: Point::new(20.0, 0.0),
                    stroke: LineStroke::new(width),
                },
            )
        };
        let ring = Shape::Circle {
            centre: Point::new(5.0, 9.0),
            radius_mm: 9.0,
            stroke: Some(LineStroke::new(0.2)),
            fill: None,
        };
        let angle = Shape::ArcArrow {
            centre: Point::new(5.0, 9.0),
            radius_mm: 9.0,
            from_rad: 3.0,
            to_rad: 9.0,
            stroke: LineStroke::new(0.2),
            head: ArrowHead::VECTOR,
        };
        let mut items = vec![
            line(0.2),
            line(0.4),
            FigureItem::new("", ring),
            FigureItem::new("angle", angle.clone()),
        ];
        break_at(&mut items, &[label]);
        let parts = |item: &FigureItem| match &item.shape {
            Shape::Path { pieces, .. } => {
                pieces.iter().filter(|p| !matches!(p, PathPiece::Move(_))).count()
            }
            _ => 0,
        };
        assert_eq!(items.iter().map(parts).collect::<Vec<_>>(), [2, 0, 2, 0, 1]);
        // The head stays with the last part; the first part is a separate item.
        let ends = |shape: &Shape| match shape {
            Shape::ArcArrow { from_rad, to_rad, .. } => [*from_rad, *to_rad],
            _ => [f64::NAN; 2],
        };
        assert!(
            ends(&items[3].shape)[0] > 3.0
                && ends(&items[3].shape)[1] == 9.0
                && items[4].class == "angle"
        );
        let ends = [items[0].bounds().unwrap(), line(0.2).bounds().unwrap()];
        assert!(
            ends[0].min.distance(ends[1].min) < 1e-9 && ends[0].max.distance(ends[1].max) < 1e-9,
            "{ends:?}"
        );
    }

    #[test]
    fn a_line_that_would_be_gone_stays() {
        let label = Rect::new(Point::new(1.0, -1.0), Point::new(9.0, 1.0));
        let shape = Shape::Line {
            from: Point::ORIGIN,
            to: Point::new(10.0, 0.0),
            stroke: LineStroke::new(0.2),
        };
        let mut items = vec![FigureItem::new("", shape.clone())];
        break_at(&mut items, &[label]);
        assert_eq!(items[0].shape, shape);
    }
}
