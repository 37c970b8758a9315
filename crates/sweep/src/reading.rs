//! Kernels of answers other than points and rates: lengths, angles, components, the Coriolis term.

use super::kernel::{Kernel, Reg, RegPair};
use super::lane::Lane;
use hodograph_base::geom::Vec2;
use hodograph_scene::quantity::ROUNDING;

/// The length |v| of a vector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VectorLength {
    /// The vector.
    pub v: RegPair,
}

impl Kernel<2, 1> for VectorLength {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 2] {
        [self.v.x, self.v.y]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [x, y]: [N; 2]) -> [N; 1] {
        [(x * x + y * y).sqrt()]
    }
}

/// The angle of a vector from the x axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VectorDirection {
    /// The vector.
    pub v: RegPair,
}

impl Kernel<2, 1> for VectorDirection {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 2] {
        [self.v.x, self.v.y]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [x, y]: [N; 2]) -> [N; 1] {
        [y.atan2(x)]
    }
}

/// The component of v along u, for any length of u.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComponentAlong {
    /// The direction.
    pub u: RegPair,
    /// The vector.
    pub v: RegPair,
}

impl Kernel<4, 2> for ComponentAlong {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 4] {
        [self.u.x, self.u.y, self.v.x, self.v.y]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [ux, uy, vx, vy]: [N; 4]) -> [N; 2] {
        let u = Vec2::new(ux, uy);
        let k = u.dot(Vec2::new(vx, vy)) / u.norm2();
        [ux * k, uy * k]
    }
}

/// The dot product u·v.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dot {
    /// The direction.
    pub u: RegPair,
    /// The vector.
    pub v: RegPair,
}

impl Kernel<4, 1> for Dot {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 4] {
        [self.u.x, self.u.y, self.v.x, self.v.y]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [ux, uy, vx, vy]: [N; 4]) -> [N; 1] {
        [ux * vx + uy * vy]
    }
}

/// The Coriolis acceleration aᵏ = 2 ω × v_r.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coriolis {
    /// The relative velocity v_r.
    pub v: RegPair,
    /// The angular velocity ω of the link that carries the guide.
    pub omega: Reg,
}

impl Kernel<3, 2> for Coriolis {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 3] {
        [self.v.x, self.v.y, self.omega]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [x, y, w]: [N; 3]) -> [N; 2] {
        let twice = w + w;
        [-(y * twice), x * twice]
    }
}

/// The sum a + k b.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeightedSum {
    /// The first number, a.
    pub a: Reg,
    /// The second number, b.
    pub b: Reg,
    /// The factor k.
    pub k: f64,
}

impl Kernel<2, 1> for WeightedSum {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 2] {
        [self.a, self.b]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [a, b]: [N; 2]) -> [N; 1] {
        [a + b * self.k]
    }
}

/// The largest ratio of angular velocities: beyond it the divisor is zero within rounding.
const MOST: f64 = 1.0 / ROUNDING;

/// a / b; NaN if b is within rounding of zero relative to a or to the drivers' rates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RateRatio {
    /// Dividend.
    pub a: Reg,
    /// Divisor.
    pub b: Reg,
    /// The largest rate of a driver (rad/s; of one that slides, over the mechanism's size).
    pub driven: f64,
}

impl Kernel<2, 1> for RateRatio {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 2] {
        [self.a, self.b]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [a, b]: [N; 2]) -> [N; 1] {
        let (ratio, least) = (a / b, ROUNDING * self.driven);
        let none = ratio.constant(f64::NAN);
        let ratio = (ratio * ratio).past(MOST * MOST, none, ratio);
        [(b * b).past(least * least, ratio, none)]
    }
}

/// a / b as complex numbers: the turn and stretch that takes b to a.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quotient {
    /// Dividend.
    pub a: RegPair,
    /// Divisor.
    pub b: RegPair,
}

impl Kernel<4, 2> for Quotient {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 4] {
        [self.a.x, self.a.y, self.b.x, self.b.y]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [ax, ay, bx, by]: [N; 4]) -> [N; 2] {
        let (a, b) = (Vec2::new(ax, ay), Vec2::new(bx, by));
        let d = b.norm2();
        [a.dot(b) / d, b.cross(a) / d]
    }
}
