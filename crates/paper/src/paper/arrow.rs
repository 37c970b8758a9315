//! The geometry of arrows: a slim head with a hollow back, and the end of the shaft.
//!
//! Heads are drawn as shapes, not as SVG markers: a marker is ignored in bounding boxes, its colour
//! does not follow the line in every program, and PDF has no markers.

use hodograph_base::geom::{Point, Vec2};

use super::extent::on_circle;

/// The shape of an arrowhead.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "wire", derive(serde::Serialize, serde::Deserialize))]
pub struct ArrowHead {
    /// Length from the tip to the barbs, along the shaft.
    pub length_mm: f64,
    /// Width from barb to barb.
    pub width_mm: f64,
    /// Depth of the hollow back, as a fraction of the length.
    pub notch: f64,
}

/// Largest length of a head as a fraction of its vector's length.
///
/// With a larger fraction the shaft vanishes in the hollow back; with a smaller one the head of a
/// vector of 2 mm is no wider than its shaft.
pub const HEAD_PART_MAX: f64 = 0.7;

impl ArrowHead {
    /// Head of vectors in polygons and on the mechanism: three times as long as wide, as in
    /// textbooks.
    pub const VECTOR: ArrowHead = ArrowHead { length_mm: 3.0, width_mm: 1.0, notch: 0.25 };
    /// Head of the arrows of angles and dimensions.
    pub const THIN: ArrowHead = ArrowHead { length_mm: 2.2, width_mm: 0.75, notch: 0.2 };

    pub(super) fn limited(self, length_mm: f64) -> ArrowHead {
        let k = (length_mm * HEAD_PART_MAX / self.length_mm).min(1.0);
        // A short head is blunter than a long one (√k > k): the shaft keeps its width, and the head
        // must be visible beside it.
        ArrowHead { length_mm: self.length_mm * k, width_mm: self.width_mm * k.sqrt(), ..self }
    }

    fn polygon(self, tip: Point, along: Vec2) -> [Point; 4] {
        let back = tip - along * self.length_mm;
        let side = along.perp() * (self.width_mm / 2.0);
        [tip, back + side, tip - along * (self.length_mm * (1.0 - self.notch)), back - side]
    }
}

/// The parts of a straight arrow.
#[derive(Clone, Debug, PartialEq)]
pub struct Straight {
    /// End of the shaft, inside the head.
    pub shaft_end: Point,
    /// Corners of the head, tip first; empty for a vector of length zero, which has no direction.
    pub head: Vec<Point>,
}

/// Splits a straight arrow into shaft and head.
pub fn straight(from: Point, to: Point, head: ArrowHead) -> Straight {
    let Some(along) = (to - from).unit() else {
        return Straight { shaft_end: to, head: Vec::new() };
    };
    let corners = head.limited(from.distance(to)).polygon(to, along);
    Straight { shaft_end: corners[2], head: corners.to_vec() }
}

/// The parts of a bent arrow.
#[derive(Clone, Debug, PartialEq)]
pub struct BentArrow {
    /// Angle at the end of the shaft, inside the head.
    pub shaft_end_rad: f64,
    /// Corners of the head, tip first; empty for an arc of length zero.
    pub head: Vec<Point>,
}

/// Splits a bent arrow into shaft and head. The head lies along the chord of its own length, so
/// that it follows the bend.
pub fn bent(
    centre: Point,
    radius_mm: f64,
    from_rad: f64,
    to_rad: f64,
    head: ArrowHead,
) -> BentArrow {
    let sweep = to_rad - from_rad;
    let head = head.limited(sweep.abs() * radius_mm);
    let tip = on_circle(centre, radius_mm, to_rad);
    let back = on_circle(centre, radius_mm, to_rad - sweep.signum() * head.length_mm / radius_mm);
    let Some(along) = (tip - back).unit() else {
        return BentArrow { shaft_end_rad: to_rad, head: Vec::new() };
    };
    let shaft_end_rad = to_rad - sweep.signum() * head.length_mm * (1.0 - head.notch) / radius_mm;
    BentArrow { shaft_end_rad, head: head.polygon(tip, along).to_vec() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn head_points_at_the_end_and_shrinks() {
        let long = straight(Point::ORIGIN, Point::new(30.0, 0.0), ArrowHead::VECTOR);
        assert_eq!(long.head[0], Point::new(30.0, 0.0));
        assert_eq!(long.head[1], Point::new(27.0, 0.5));
        let short = straight(Point::ORIGIN, Point::new(2.0, 0.0), ArrowHead::VECTOR);
        assert!((short.head[1].x - 0.6).abs() < 1e-12, "70 % of 2 mm");
        assert!(
            (0.25..0.5).contains(&short.head[1].y),
            "narrower than a full head, wider than the 0.4 mm shaft"
        );
        assert!(straight(Point::ORIGIN, Point::ORIGIN, ArrowHead::VECTOR).head.is_empty());
    }

    #[test]
    fn bent_arrow_points_the_way_it_turns() {
        for (from, to, down) in [
            (0.0, std::f64::consts::PI, true),
            (std::f64::consts::PI, 0.0, true),
            (-1.5, 0.0, false),
        ] {
            let a = bent(Point::ORIGIN, 10.0, from, to, ArrowHead::VECTOR);
            let back = a.head[2];
            assert_eq!(back.y > a.head[0].y, down, "{from} to {to}: {a:?}");
        }
    }
}
