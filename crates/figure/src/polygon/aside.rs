//! Draws overlapping vectors side by side: one keeps its place, the others are displaced
//! perpendicular to themselves, and thin lines join their ends to the true points.
//!
//! This module decides which vectors overlap, and how far each is displaced. Lengths, directions
//! and marks remain true. A figure of a series is drawn without displacement, because vectors would
//! jump from one figure to the next.

use hodograph_base::geom::{Point, Vec2};

use super::{LABEL_ROOM_MM, PolygonArrow, PolygonDraft, SAME_MM, covers, is_one};

/// Clear space between two vectors side by side: with less they merge in print.
const AIR_MM: f64 = 0.7;
/// Vectors with less clear space than this are read as one.
const CLOSED_MM: f64 = 0.3;
/// Two vectors that overlap along less than this are distinguished by their ends.
const OVER_MM: f64 = 3.0;
/// The overlap limit as a part of the shorter vector.
const OVER_PART: f64 = 0.6;
/// Number of lanes on either side of the true place.
const LANES: i32 = 3;

/// A straight line on paper.
type LineEnds = (Point, Point);

impl PolygonDraft<'_> {
    /// Displaces vectors that would cover others; those from the pole and the long ones keep their
    /// places.
    pub(super) fn side_by_side(&mut self, width_mm: f64) {
        let length = |a: &PolygonArrow| a.from.distance(a.to);
        let mut order: Vec<usize> = (0..self.arrows.len()).collect();
        let rank =
            |k: usize| (!is_one(self.arrows[k].from, Point::ORIGIN), -length(&self.arrows[k]));
        order.sort_by(|&i, &j| rank(i).0.cmp(&rank(j).0).then(rank(i).1.total_cmp(&rank(j).1)));
        let mut placed: Vec<LineEnds> = Vec::new();
        for k in order {
            self.arrows[k].aside =
                lane((self.arrows[k].from, self.arrows[k].to), &placed, width_mm);
            placed.push(self.arrows[k].drawn());
        }
    }
}

/// The perpendicular displacement of a line that makes it overlap none of the others.
pub(crate) fn lane(line: LineEnds, others: &[LineEnds], width_mm: f64) -> Vec2 {
    let over = |by: Vec2| {
        others.iter().find_map(|other| overlap_offset((line.0 + by, line.1 + by), *other, width_mm))
    };
    let (Some(left_mm), Some(along)) = (over(Vec2::ZERO), (line.1 - line.0).unit()) else {
        return Vec2::ZERO;
    };
    // Towards the side on which it already is.
    let side = along.perp() * if left_mm < -SAME_MM { -1.0 } else { 1.0 };
    let mut lanes =
        (1..=LANES).flat_map(|n| [n, -n]).map(|n| side * (f64::from(n) * (width_mm + AIR_MM)));
    lanes.find(|by| over(*by).is_none()).unwrap_or(Vec2::ZERO)
}

impl PolygonArrow {
    /// The ends between which the vector is drawn.
    pub(super) fn drawn(&self) -> LineEnds {
        (self.from + self.aside, self.to + self.aside)
    }

    /// The lines from the true ends to the drawn ones; empty if they coincide.
    pub(super) fn joins(&self) -> Vec<LineEnds> {
        let ends = if self.aside == Vec2::ZERO { vec![] } else { vec![self.from, self.to] };
        ends.into_iter().map(|p| (p, p + self.aside)).collect()
    }
}

/// The signed offset (mm, positive to the left in its own direction) of a line `one` that overlaps
/// `other`; `None` if both are visible. A line that starts where a longer one starts, and runs the
/// same way, is visible by its head.
fn overlap_offset(one: LineEnds, other: LineEnds, width_mm: f64) -> Option<f64> {
    let near = width_mm + CLOSED_MM;
    // Most are far apart, which needs no square root to detect.
    let apart =
        |a: f64, b: f64, c: f64, d: f64| a.max(b) + near < c.min(d) || c.max(d) + near < a.min(b);
    if apart(one.0.x, one.1.x, other.0.x, other.1.x)
        || apart(one.0.y, one.1.y, other.0.y, other.1.y)
    {
        return None;
    }
    // At an angle θ they are close along 2 · near/sin θ at most.
    let (a, b) = (other.1 - other.0, one.1 - one.0);
    let enough2 = (OVER_MM * OVER_MM).max(OVER_PART * OVER_PART * a.norm2().min(b.norm2()));
    if a.cross(b) * a.cross(b) * enough2 > 4.0 * near * near * a.norm2() * b.norm2() {
        return None;
    }
    let u = a.unit()?;
    let reach = [a.norm(), b.norm()];
    let (short, long) = if reach[1] < reach[0] { (one, other) } else { (other, one) };
    let ways = b.dot(u);
    if ways > 0.0
        && is_one(one.0, other.0)
        && covers(long, short.1)
        && short.1.distance(long.1) > LABEL_ROOM_MM
    {
        return None;
    }
    let [mut p, mut q] = [one.0, one.1].map(|e| ((e - other.0).dot(u), u.cross(e - other.0)));
    if p.0 > q.0 {
        std::mem::swap(&mut p, &mut q);
    }
    let (from, to) = (p.0.max(0.0), q.0.min(reach[0]));
    if to <= from {
        return None;
    }
    // The offset is linear along the other line.
    let slope = (q.1 - p.1) / (q.0 - p.0);
    let (mut lo, mut hi) = (from, to);
    if slope == 0.0 {
        hi = if p.1.abs() < near { hi } else { lo };
    } else {
        let at = |off: f64| p.0 + (off - p.1) / slope;
        let [a, b] = [at(-near), at(near)];
        (lo, hi) = (lo.max(a.min(b)), hi.min(a.max(b)));
    }
    let enough = OVER_MM.max(OVER_PART * reach[0].min(reach[1]));
    let left_mm = p.1 + slope * ((from + to) / 2.0 - p.0);
    (hi - lo >= enough).then_some(left_mm * ways.signum())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(a: [f64; 2], b: [f64; 2]) -> LineEnds {
        (Point::new(a[0], a[1]), Point::new(b[0], b[1]))
    }

    #[test]
    fn lines_over_one_another() {
        let level = line([0.0, 0.0], [40.0, 0.0]);
        let over = |other: LineEnds| overlap_offset(other, level, 0.4);
        assert_eq!(over(line([40.0, 0.0], [0.0, 0.0])), Some(0.0), "back again");
        assert_eq!(
            over(line([40.0, 0.0], [0.0, 0.4])),
            Some(-0.2),
            "and a little to the right of the way back"
        );
        assert_eq!(over(line([0.0, 0.0], [40.0, 0.4])), Some(0.2));
        assert_eq!(over(line([0.0, 0.0], [40.0, 4.0])), None, "apart at one end");
        assert_eq!(over(line([0.0, 2.0], [40.0, 2.0])), None, "apart");
        assert_eq!(over(line([38.0, 0.0], [60.0, 0.0])), None, "one after the other");
        assert_eq!(over(line([0.0, 0.0], [25.0, 0.0])), None, "its head is seen");
        assert_eq!(over(line([10.0, 0.0], [40.0, 0.0])), Some(0.0), "its head is not");
        assert_eq!(over(line([25.0, 0.0], [0.0, 0.0])), Some(0.0));
    }
}
