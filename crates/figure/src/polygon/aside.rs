//! Vectors that lie over one another on paper are drawn side by side: one keeps its place, the others are moved square to themselves, and
//! thin lines join their ends to the points where they belong.
//!
//! Decided here: which vectors lie over one another, and how far each is moved. Lengths and directions stay true, and so do the marks;
//! a figure of a series is drawn without it, as vectors would jump from one figure to the next.

use hodograph_base::geom::{Point, Vec2};

use super::{Arrow, Draft, LABEL_ROOM_MM, SAME_MM, covers, is_one};

/// White between two vectors side by side: less, and they close up in print.
const AIR_MM: f64 = 0.7;
/// Nearer than so much white they are read as one.
const CLOSED_MM: f64 = 0.3;
/// Two vectors that lie over one another along less than this are told apart by their ends.
const OVER_MM: f64 = 3.0;
/// The same as a part of the shorter one.
const OVER_PART: f64 = 0.6;
/// To each side of the place that is true.
const LANES: i32 = 3;

/// A straight line on paper.
type Ends = (Point, Point);

impl Draft<'_> {
    /// Moves vectors aside that would lie over others: those from the pole and the long ones keep their places.
    pub(super) fn side_by_side(&mut self, width_mm: f64) {
        let length = |a: &Arrow| a.from.distance(a.to);
        let mut order: Vec<usize> = (0..self.arrows.len()).collect();
        let rank = |k: usize| (!is_one(self.arrows[k].from, Point::ORIGIN), -length(&self.arrows[k]));
        order.sort_by(|&i, &j| rank(i).0.cmp(&rank(j).0).then(rank(i).1.total_cmp(&rank(j).1)));
        let mut placed: Vec<Ends> = Vec::new();
        for k in order {
            self.arrows[k].aside = lane((self.arrows[k].from, self.arrows[k].to), &placed, width_mm);
            placed.push(self.arrows[k].drawn());
        }
    }
}

/// How far a line is moved square to itself so that it lies over none of the others.
pub(crate) fn lane(line: Ends, others: &[Ends], width_mm: f64) -> Vec2 {
    let over = |by: Vec2| others.iter().find_map(|other| lies_over((line.0 + by, line.1 + by), *other, width_mm));
    let (Some(left_mm), Some(along)) = (over(Vec2::ZERO), (line.1 - line.0).unit()) else { return Vec2::ZERO };
    // To the side on which it lies already.
    let side = along.perp() * if left_mm < -SAME_MM { -1.0 } else { 1.0 };
    let mut lanes = (1..=LANES).flat_map(|n| [n, -n]).map(|n| side * (f64::from(n) * (width_mm + AIR_MM)));
    lanes.find(|by| over(*by).is_none()).unwrap_or(Vec2::ZERO)
}

impl Arrow {
    /// The ends between which it is drawn.
    pub(super) fn drawn(&self) -> Ends {
        (self.from + self.aside, self.to + self.aside)
    }

    /// From the true ends to those drawn; none where they are the same.
    pub(super) fn joins(&self) -> Vec<Ends> {
        let ends = if self.aside == Vec2::ZERO { vec![] } else { vec![self.from, self.to] };
        ends.into_iter().map(|p| (p, p + self.aside)).collect()
    }
}

/// How far to the left of one line another lies over it; `None` where both are seen. One that begins where a longer one begins, and goes
/// the same way, is seen by its head.
fn lies_over(one: Ends, other: Ends, width_mm: f64) -> Option<f64> {
    let near = width_mm + CLOSED_MM;
    // Most are far apart, which is seen without a root.
    let apart = |a: f64, b: f64, c: f64, d: f64| a.max(b) + near < c.min(d) || c.max(d) + near < a.min(b);
    if apart(one.0.x, one.1.x, other.0.x, other.1.x) || apart(one.0.y, one.1.y, other.0.y, other.1.y) {
        return None;
    }
    // At an angle θ they are near to one another along 2 · near/sin θ at most.
    let (a, b) = (other.1 - other.0, one.1 - one.0);
    let enough2 = (OVER_MM * OVER_MM).max(OVER_PART * OVER_PART * a.norm2().min(b.norm2()));
    if a.cross(b) * a.cross(b) * enough2 > 4.0 * near * near * a.norm2() * b.norm2() {
        return None;
    }
    let u = a.unit()?;
    let reach = [a.norm(), b.norm()];
    let (short, long) = if reach[1] < reach[0] { (one, other) } else { (other, one) };
    let ways = b.dot(u);
    if ways > 0.0 && is_one(one.0, other.0) && covers(long, short.1) && short.1.distance(long.1) > LABEL_ROOM_MM {
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
    // How far it is off is linear along the other one.
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

    fn line(a: [f64; 2], b: [f64; 2]) -> Ends {
        (Point::new(a[0], a[1]), Point::new(b[0], b[1]))
    }

    #[test]
    fn lines_over_one_another() {
        let level = line([0.0, 0.0], [40.0, 0.0]);
        let over = |other: Ends| lies_over(other, level, 0.4);
        assert_eq!(over(line([40.0, 0.0], [0.0, 0.0])), Some(0.0), "back again");
        assert_eq!(over(line([40.0, 0.0], [0.0, 0.4])), Some(-0.2), "and a little to the right of the way back");
        assert_eq!(over(line([0.0, 0.0], [40.0, 0.4])), Some(0.2));
        assert_eq!(over(line([0.0, 0.0], [40.0, 4.0])), None, "apart at one end");
        assert_eq!(over(line([0.0, 2.0], [40.0, 2.0])), None, "apart");
        assert_eq!(over(line([38.0, 0.0], [60.0, 0.0])), None, "one after the other");
        assert_eq!(over(line([0.0, 0.0], [25.0, 0.0])), None, "its head is seen");
        assert_eq!(over(line([10.0, 0.0], [40.0, 0.0])), Some(0.0), "its head is not");
        assert_eq!(over(line([25.0, 0.0], [0.0, 0.0])), Some(0.0));
    }
}
