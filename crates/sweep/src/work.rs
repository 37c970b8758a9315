//! Kernels of the power of loads. The drivers' power is the opposite; with one driver so is its
//! balancing moment or force.

use super::kernel::{Kernel, Reg, RegPair};
use super::lane::Lane;
use std::f64::consts::FRAC_1_PI;

/// The power of a link's weight and inertia added to others: before + G·v − m a·v − J α ω.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Massive {
    /// The velocity v of the centre of mass.
    pub v: RegPair,
    /// The acceleration a of the centre of mass.
    pub a: RegPair,
    /// The angular velocity ω.
    pub omega: Reg,
    /// The angular acceleration α.
    pub alpha: Reg,
    /// The power of the loads before (W).
    pub before: Reg,
    /// The mass m (kg).
    pub m: f64,
    /// The moment of inertia J about the centre of mass (kg·m²).
    pub j: f64,
    /// The weight G (N).
    pub weight: [f64; 2],
}

impl Kernel<7, 1> for Massive {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 7] {
        [self.v.x, self.v.y, self.a.x, self.a.y, self.omega, self.alpha, self.before]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [vx, vy, ax, ay, w, alpha, before]: [N; 7]) -> [N; 1] {
        let [gx, gy] = self.weight;
        let along = vx * (ax * -self.m + gx) + vy * (ay * -self.m + gy);
        [before + along + w * alpha * -self.j]
    }
}

/// A product added to another number: before + a b.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProductSum {
    /// The first factor.
    pub a: Reg,
    /// The second factor.
    pub b: Reg,
    /// The number before.
    pub before: Reg,
}

impl Kernel<3, 1> for ProductSum {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 3] {
        [self.a, self.b, self.before]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [a, b, before]: [N; 3]) -> [N; 1] {
        [before + a * b]
    }
}

/// The power of a spring added to others: before − k (l − l₀) dl/dt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringPower {
    /// The vector from one end to the other.
    pub d: RegPair,
    /// The rate of that vector.
    pub v: RegPair,
    /// The power of the loads before (W).
    pub before: Reg,
    /// The stiffness k (N/m).
    pub stiffness: f64,
    /// The free length l₀ (m).
    pub free: f64,
}

impl Kernel<5, 1> for SpringPower {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 5] {
        [self.d.x, self.d.y, self.v.x, self.v.y, self.before]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [x, y, vx, vy, before]: [N; 5]) -> [N; 1] {
        let l = (x * x + y * y).sqrt();
        [before - (l + -self.free) * (x * vx + y * vy) / l * self.stiffness]
    }
}

/// The angle of the driver (degrees), reduced by whole periods to the first that is `first` or
/// more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Repeated {
    /// The driver's angle in [`super::turns::Quarters`].
    pub quarters: RegPair,
    /// The least angle, less an allowance for rounding.
    pub first: f64,
    /// The period (degrees).
    pub period: f64,
}

impl Kernel<2, 1> for Repeated {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 2] {
        [self.quarters.x, self.quarters.y]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [k, r]: [N; 2]) -> [N; 1] {
        let angle = k * 90.0 + r * (180.0 * FRAC_1_PI);
        let periods = (angle + -self.first) * (1.0 / self.period);
        [angle + (periods + -0.5).nearest() * -self.period]
    }
}

/// The amount of a load along its course: the amount before, or from a place on a + b (x − origin).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ramp {
    /// The place x.
    pub at: Reg,
    /// The amount before.
    pub before: Reg,
    /// The place at which it begins.
    pub from: f64,
    /// The place from which the line counts.
    pub origin: f64,
    /// The amount a.
    pub amount: f64,
    /// The slope b.
    pub slope: f64,
}

impl Kernel<2, 1> for Ramp {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 2] {
        [self.at, self.before]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [x, before]: [N; 2]) -> [N; 1] {
        [x.past(self.from, (x + -self.origin) * self.slope + self.amount, before)]
    }
}

/// A number, if another is at least `from`, else zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forward {
    /// The number to compare.
    pub speed: Reg,
    /// The number to return.
    pub number: Reg,
    /// The least value of `speed`.
    pub from: f64,
}

impl Kernel<2, 1> for Forward {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 2] {
        [self.speed, self.number]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [speed, number]: [N; 2]) -> [N; 1] {
        [speed.past(self.from, number, speed.constant(0.0))]
    }
}
