//! Positions of a body: displacements from the first one, poles, and circles through the places of
//! a pin.

use hodograph_base::geom::{Point, Vec2};
use std::f64::consts::PI;

/// The position of the body's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyPose {
    /// Its origin (m).
    pub origin: Point,
    /// Its direction (rad).
    pub angle: f64,
}

impl BodyPose {
    /// The place of a point given in the body's frame.
    pub fn place(&self, local: Vec2) -> Point {
        self.origin + local.rotate_by(Vec2::from_angle(self.angle))
    }

    /// A place moved with the body from this position to another.
    pub fn carry(&self, to: &BodyPose, at: Point) -> Point {
        to.origin + (at - self.origin).rotate_by(Vec2::from_angle(to.angle - self.angle))
    }

    /// The pole of the displacement to another position: the fixed point; `None` where the body
    /// does not rotate.
    ///
    /// P = M + (o' − o)⊥ / (2 tan(δ/2)), M the midpoint of both origins, δ the rotation.
    pub fn pole(&self, to: &BodyPose) -> Option<Point> {
        let half = (to.angle - self.angle) / 2.0;
        // A rotation by full turns is none: the sine of its half shows that to rounding.
        if libm::sin(half).abs() < 1e-12 {
            return None;
        }
        let way = to.origin - self.origin;
        Some(self.origin + way * 0.5 + way.perp() * (0.5 * libm::cos(half) / libm::sin(half)))
    }
}

/// The centre of the circle through three points, and the angle under which the bisectors intersect
/// (rad); `None` where the points are collinear.
pub fn centre(p: Point, q: Point, r: Point) -> Option<(Point, f64)> {
    let (u, v) = (q - p, r - p);
    let cross = u.cross(v);
    let angle = libm::asin((cross.abs() / (u.norm() * v.norm())).min(1.0));
    // Below 1e-9 the centre is farther away than the pivots of any linkage, and rounding determines
    // its place.
    if !(angle > 1e-9 && u.norm() > 0.0 && v.norm() > 0.0) {
        return None;
    }
    let (a, b) = (u.norm2(), v.norm2());
    let at = Vec2::new(v.y * a - u.y * b, u.x * b - v.x * a) * (0.5 / cross);
    Some((p + at, angle.min(PI - angle)))
}
