//! Kernels of a link's motion: images of its points, its arms and their rates, its angular velocity
//! and angular acceleration.
//!
//! A point of a link and an arm d between two of its points define the link; any other of its
//! points is the image of the arm, P = O + k d with a complex constant k. The velocities and
//! accelerations of the three points obey the same relation (影像).

use super::kernel::{Kernel, Reg, RegPair};
use super::lane::Lane;
use hodograph_base::geom::Vec2;

/// The image point O + k d, or its velocity or acceleration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Image {
    /// The link's reference point, or its velocity, or its acceleration.
    pub o: RegPair,
    /// The arm, or its rates.
    pub d: RegPair,
    /// Real and imaginary part of k.
    pub k: [f64; 2],
}

impl Kernel<4, 2> for Image {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 4] {
        [self.o.x, self.o.y, self.d.x, self.d.y]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [ox, oy, dx, dy]: [N; 4]) -> [N; 2] {
        let [p, q] = self.k;
        [ox + (dx * p + dy * -q), oy + (dx * q + dy * p)]
    }
}

/// The arm B − A.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arm {
    /// The start A.
    pub from: RegPair,
    /// The end B.
    pub to: RegPair,
}

impl Kernel<4, 2> for Arm {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 4] {
        [self.from.x, self.from.y, self.to.x, self.to.y]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [ax, ay, bx, by]: [N; 4]) -> [N; 2] {
        [bx - ax, by - ay]
    }
}

/// The product k d: an arm turned and stretched by a complex constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist {
    /// The arm.
    pub d: RegPair,
    /// Real and imaginary part of k.
    pub k: [f64; 2],
}

impl Kernel<2, 2> for Twist {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 2] {
        [self.d.x, self.d.y]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [dx, dy]: [N; 2]) -> [N; 2] {
        let [p, q] = self.k;
        [dx * p + dy * -q, dx * q + dy * p]
    }
}

/// The complex product of two vectors: `a` turned by the angle of `b` and stretched by its length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Product {
    /// The first factor.
    pub a: RegPair,
    /// The second factor.
    pub b: RegPair,
}

impl Kernel<4, 2> for Product {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 4] {
        [self.a.x, self.a.y, self.b.x, self.b.y]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [ax, ay, bx, by]: [N; 4]) -> [N; 2] {
        let v = Vec2::new(ax, ay).rotate_by(Vec2::new(bx, by));
        [v.x, v.y]
    }
}

/// The point Q + s t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointAlong {
    /// The start Q.
    pub q: RegPair,
    /// The direction t.
    pub t: RegPair,
    /// The distance s.
    pub s: Reg,
}

impl Kernel<5, 2> for PointAlong {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 5] {
        [self.q.x, self.q.y, self.t.x, self.t.y, self.s]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [qx, qy, tx, ty, s]: [N; 5]) -> [N; 2] {
        [qx + tx * s, qy + ty * s]
    }
}

/// v_P = v_O + ω × r, with the arm r from O to P.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArmSwing {
    /// v_O.
    pub v: RegPair,
    /// r.
    pub r: RegPair,
    /// ω.
    pub omega: Reg,
}

impl Kernel<5, 2> for ArmSwing {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 5] {
        [self.v.x, self.v.y, self.r.x, self.r.y, self.omega]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [vx, vy, rx, ry, w]: [N; 5]) -> [N; 2] {
        [vx - w * ry, vy + w * rx]
    }
}

/// a_P = a_O + α × r − ω² r.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SwingRate {
    /// a_O.
    pub a: RegPair,
    /// r.
    pub r: RegPair,
    /// ω.
    pub omega: Reg,
    /// α.
    pub alpha: Reg,
}

impl Kernel<6, 2> for SwingRate {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 6] {
        [self.a.x, self.a.y, self.r.x, self.r.y, self.omega, self.alpha]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [ax, ay, rx, ry, w, e]: [N; 6]) -> [N; 2] {
        let w2 = w * w;
        [ax - e * ry - w2 * rx, ay + e * rx - w2 * ry]
    }
}

/// Angular velocity ω of an arm d whose end has the velocity v relative to its start: d × v / d².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArmTurning {
    /// The arm.
    pub d: RegPair,
    /// Its rate.
    pub v: RegPair,
}

impl Kernel<4, 1> for ArmTurning {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 4] {
        [self.d.x, self.d.y, self.v.x, self.v.y]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [dx, dy, vx, vy]: [N; 4]) -> [N; 1] {
        let d = Vec2::new(dx, dy);
        [d.cross(Vec2::new(vx, vy)) / d.norm2()]
    }
}

/// Angular acceleration α of an arm: (d × a − 2 ω d·v)/d².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurningRate {
    /// The arm.
    pub d: RegPair,
    /// Its rate.
    pub v: RegPair,
    /// The arm's second derivative.
    pub a: RegPair,
    /// ω.
    pub omega: Reg,
}

impl Kernel<7, 1> for TurningRate {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 7] {
        [self.d.x, self.d.y, self.v.x, self.v.y, self.a.x, self.a.y, self.omega]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [dx, dy, vx, vy, ax, ay, w]: [N; 7]) -> [N; 1] {
        let d = Vec2::new(dx, dy);
        [(d.cross(Vec2::new(ax, ay)) - w * d.dot(Vec2::new(vx, vy)) * 2.0) / d.norm2()]
    }
}
