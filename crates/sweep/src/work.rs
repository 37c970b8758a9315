//! The power of loads as kernels: that of the drivers is its opposite, and with one driver so is its balancing moment or force.

use super::kernel::{Kernel, Pair, Reg};
use super::lane::Lane;
use std::f64::consts::FRAC_1_PI;

/// The power of a link's weight and inertia on top of others: before + G·v − m a·v − J α ω.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Massive {
    /// Velocity of the centre of mass.
    pub v: Pair,
    /// Its acceleration.
    pub a: Pair,
    /// ω.
    pub omega: Reg,
    /// α.
    pub alpha: Reg,
    /// The power before (W).
    pub before: Reg,
    /// Mass (kg).
    pub m: f64,
    /// Moment of inertia about the centre of mass (kg·m²).
    pub j: f64,
    /// Weight (N).
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

/// A product on top of another number: before + a b.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Times {
    /// First factor.
    pub a: Reg,
    /// Second factor.
    pub b: Reg,
    /// The number before.
    pub before: Reg,
}

impl Kernel<3, 1> for Times {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 3] {
        [self.a, self.b, self.before]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [a, b, before]: [N; 3]) -> [N; 1] {
        [before + a * b]
    }
}

/// The power of a spring on top of others: before − k (l − l₀) dl/dt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring {
    /// From one end to the other.
    pub d: Pair,
    /// Its rate.
    pub v: Pair,
    /// The power before (W).
    pub before: Reg,
    /// Stiffness k (N/m).
    pub stiffness: f64,
    /// Free length l₀ (m).
    pub free: f64,
}

impl Kernel<5, 1> for Spring {
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

/// The angle of the driver (degrees), less whole periods so that it is `first` or more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Repeated {
    /// The driver's angle, of [`super::turns::Quarters`].
    pub quarters: Pair,
    /// The least angle, less what rounding may make of it.
    pub first: f64,
    /// The period.
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

/// The amount of a load along its course: that before, or from a place on a + b (x − from).
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
    /// a.
    pub amount: f64,
    /// b.
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

/// A number where another is at least `from`, else zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forward {
    /// The number that is compared.
    pub speed: Reg,
    /// The number.
    pub number: Reg,
    /// The least.
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
