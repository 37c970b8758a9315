//! Kernels that compute a point's position, velocity and acceleration in one pass: the results of
//! one effect stay in the machine's registers for the next.
//!
//! `LEVELS` is the number of levels (1: position, 2: and velocity, 3: and acceleration); with
//! `LENGTHS` the lengths of the rates are results too. `GROUND`: the point that a bar or a link is
//! connected to is fixed; its rates do not even enter as factors. A vector is two numbers; a point
//! with its rates enters as `LEVELS` vectors, one after the other, and results in the same order,
//! with the lengths last.
//!
//! This module uses no closures and no array functions: code that is not inlined runs without SIMD
//! registers.

// The loops step through several arrays side by side; loops over numbers are certain to be
// unrolled.
#![allow(clippy::needless_range_loop)]

use super::super::closure::TOUCH;
use super::super::kernel::{Kernel, Reg, RegPair};
use super::super::lane::Lane;
use hodograph_base::geom::Vec2;

/// A position and its rates; those beyond a kernel's levels are not read.
pub type MotionRegisters = [RegPair; 3];

/// Two bars A–C and B–C of constant lengths: C, to the left (`sign` 1) or right (−1) of the line
/// from A to B.
///
/// # Source
/// [`super::super::closure::Circles`], [`super::super::rows::Bars`] and
/// [`super::super::rows::BarsRate`], with 2/√m for 1/(u × w).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dyad<const GROUND: bool, const LEVELS: usize, const LENGTHS: bool> {
    /// The point A.
    pub a: MotionRegisters,
    /// The point B, if it moves.
    pub b: MotionRegisters,
    /// The point B, if it is fixed.
    pub at: [f64; 2],
    /// The length |AC|.
    pub r: f64,
    /// The length |BC|.
    pub s: f64,
    /// The branch: 1 or −1.
    pub sign: f64,
}

/// A point on a link that turns about a fixed pivot by a given angle: P = O + k (cos, sin), at a
/// constant ω and α.
///
/// `EVEN`: k is real and α zero, as for a crank at constant angular velocity with the angle of its
/// arm; the terms that vanish are left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crank<const LEVELS: usize, const EVEN: bool> {
    /// Cosine and sine of the angle.
    pub turn: RegPair,
    /// The pivot O.
    pub o: [f64; 2],
    /// Real and imaginary part of k.
    pub k: [f64; 2],
    /// The angular velocity ω.
    pub omega: f64,
    /// The angular acceleration α.
    pub alpha: f64,
}

/// A point of a link by two others: P = O + k (N − O), and its rates in the same way (影像).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoupledPoint<const GROUND: bool, const LEVELS: usize, const LENGTHS: bool> {
    /// The point N.
    pub n: MotionRegisters,
    /// The point O, if it moves.
    pub o: MotionRegisters,
    /// The point O, if it is fixed.
    pub at: [f64; 2],
    /// Real and imaginary part of k.
    pub k: [f64; 2],
}

/// A point of a link by another and the arm: P = O + k d, and its rates in the same way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Images<const LEVELS: usize, const LENGTHS: bool> {
    /// The point O.
    pub o: MotionRegisters,
    /// The arm d.
    pub d: MotionRegisters,
    /// Real and imaginary part of k.
    pub k: [f64; 2],
}

/// A pin C at a constant distance from A, on a fixed straight guide: ahead (`sign` 1) of the foot
/// of A or behind it (−1).
///
/// The pin moves along the guide alone: with u = C − A, ṡ = u·v_A/(u·t) and s̈ = (u·a_A − |v_C −
/// v_A|²)/(u·t).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slider<const LEVELS: usize, const LENGTHS: bool> {
    /// The point A.
    pub a: MotionRegisters,
    /// The length |AC|.
    pub r: f64,
    /// A point of the guide.
    pub q: [f64; 2],
    /// Its unit direction.
    pub t: [f64; 2],
    /// The branch: 1 ahead, −1 behind.
    pub sign: f64,
}

/// Angular velocity ω of the line from O to N, and with three levels α.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineTurning<const GROUND: bool, const LEVELS: usize> {
    /// The point N.
    pub n: MotionRegisters,
    /// The point O, if it moves.
    pub o: MotionRegisters,
    /// The point O, if it is fixed.
    pub at: [f64; 2],
}

/// A lever on a fixed pivot A with a straight slot over a pin B: its arm with the rates, ω, and
/// with three levels α.
///
/// # Source
/// [`super::super::closure::SlotLever`] and [`super::super::rows::SlotRate`]: n·v_B = ω n·(r turned
/// by 90°), r = B − A, n square to the slot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlottedLever<const LEVELS: usize> {
    /// The pin B.
    pub b: MotionRegisters,
    /// The pivot A.
    pub at: [f64; 2],
    /// The offset of the slot.
    pub h: f64,
    /// 1 if the pin is ahead of the pivot, −1 if it is behind it.
    pub sign: f64,
    /// The complex factor from the slot's direction to the arm.
    pub k: [f64; 2],
    /// The complex factor from the arm to n.
    pub n: [f64; 2],
}

/// The registers of points with their rates, one point after the other.
fn wires<const IN: usize>(levels: usize, places: &[MotionRegisters]) -> [Reg; IN] {
    std::array::from_fn(|i| {
        let pair = places[i / (2 * levels)][i / 2 % levels];
        if i % 2 == 0 { pair.x } else { pair.y }
    })
}

/// The `i`-th vector of the input.
#[inline(always)]
fn vector<N: Lane, const IN: usize>(x: &[N; IN], i: usize) -> Vec2<N> {
    Vec2::new(x[2 * i], x[2 * i + 1])
}

/// A constant vector.
#[inline(always)]
fn fixed<N: Lane>(like: N, [x, y]: [f64; 2]) -> Vec2<N> {
    Vec2::new(like.constant(x), like.constant(y))
}

/// The product k v with a complex constant k.
#[inline(always)]
fn twisted<N: Lane>(v: Vec2<N>, [p, q]: [f64; 2]) -> Vec2<N> {
    Vec2::new(v.x * p + v.y * -q, v.x * q + v.y * p)
}

/// Returns v with u·v = p and w·v = q; p and q already contain the factor `inverse` of u × w.
#[inline(always)]
fn crossed<N: Lane>(u: Vec2<N>, w: Vec2<N>, p: N, q: N) -> Vec2<N> {
    Vec2::new(p * w.y - q * u.y, q * u.x - p * w.x)
}

/// Returns a point, its rates, and the lengths of these.
#[inline(always)]
fn put<N: Lane, const LEVELS: usize, const OUT: usize>(v: [Vec2<N>; LEVELS]) -> [N; OUT] {
    let mut out = [v[0].x; OUT];
    for i in 0..LEVELS {
        (out[2 * i], out[2 * i + 1]) = (v[i].x, v[i].y);
    }
    for i in 2 * LEVELS..OUT {
        out[i] = v[i + 1 - 2 * LEVELS].norm2().sqrt();
    }
    out
}

impl<const GROUND: bool, const LEVELS: usize, const LENGTHS: bool> Dyad<GROUND, LEVELS, LENGTHS> {
    /// Returns C, and 1/det of its bars.
    #[inline(always)]
    fn close<N: Lane>(&self, a: Vec2<N>, b: Vec2<N>) -> (Vec2<N>, N) {
        let (sum, difference) = (self.r + self.s, self.r - self.s);
        let d = b - a;
        let d2 = d.norm2();
        let (outer, inner) = (d2.constant(sum * sum) - d2, d2 + -(difference * difference));
        let slack = (d2 + (self.r * self.r + self.s * self.s)) * TOUCH;
        let root = (outer * inner).root_unless_touching(outer.least(inner), slack);
        // The sign is applied outside of the root, so that nothing waits for it.
        let half = d2.constant(0.5 * self.sign) / d2;
        let (f, h) = (half * (sum * difference * self.sign) + 0.5, root * half);
        (
            Vec2::new(a.x + d.x * f - d.y * h, a.y + d.y * f + d.x * h),
            d2.constant(2.0 * self.sign) / root,
        )
    }

    #[inline(always)]
    fn solve<N: Lane, const IN: usize, const OUT: usize>(&self, x: [N; IN]) -> [N; OUT] {
        let a = vector(&x, 0);
        let b = if GROUND { fixed(x[0], self.at) } else { vector(&x, LEVELS) };
        let (c, inverse) = self.close(a, b);
        let mut out = [c; LEVELS];
        let (u, w) = (c - a, c - b);
        if LEVELS > 1 {
            let va = vector(&x, 1);
            let p = u.dot(va) * inverse;
            // For a point on ground q is zero.
            out[1] = if GROUND {
                Vec2::new(p * w.y, -(p * w.x))
            } else {
                crossed(u, w, p, w.dot(vector(&x, LEVELS + 1)) * inverse)
            };
            if LEVELS > 2 {
                let v = out[1];
                let p = (u.dot(vector(&x, 2)) - (v - va).norm2()) * inverse;
                let q = if GROUND {
                    -(v.norm2() * inverse)
                } else {
                    (w.dot(vector(&x, LEVELS + 2)) - (v - vector(&x, LEVELS + 1)).norm2()) * inverse
                };
                out[2] = crossed(u, w, p, q);
            }
        }
        put(out)
    }
}

impl<const LEVELS: usize, const EVEN: bool> Crank<LEVELS, EVEN> {
    /// Returns the crank with other levels, or in the form for constant angular velocity.
    pub fn turned_to<const OTHER: usize, const NOW: bool>(self) -> Crank<OTHER, NOW> {
        Crank { turn: self.turn, o: self.o, k: self.k, omega: self.omega, alpha: self.alpha }
    }

    /// Returns true if the form `EVEN` applies.
    pub fn is_even(&self) -> bool {
        self.k[1] == 0.0 && self.alpha == 0.0
    }

    #[inline(always)]
    fn solve<N: Lane, const IN: usize, const OUT: usize>(&self, x: [N; IN]) -> [N; OUT] {
        let turn = vector(&x, 0);
        let arm = if EVEN { turn * turn.x.constant(self.k[0]) } else { twisted(turn, self.k) };
        let mut out = [Vec2::new(arm.x + self.o[0], arm.y + self.o[1]); LEVELS];
        if LEVELS > 1 {
            out[1] = Vec2::new(arm.y * -self.omega, arm.x * self.omega);
        }
        if LEVELS > 2 {
            let square = -(self.omega * self.omega);
            out[2] = if EVEN {
                arm * arm.x.constant(square)
            } else {
                twisted(arm, [square, self.alpha])
            };
        }
        put(out)
    }
}

impl<const GROUND: bool, const LEVELS: usize, const LENGTHS: bool>
    CoupledPoint<GROUND, LEVELS, LENGTHS>
{
    #[inline(always)]
    fn solve<N: Lane, const IN: usize, const OUT: usize>(&self, x: [N; IN]) -> [N; OUT] {
        let mut out = [vector(&x, 0); LEVELS];
        for i in 0..LEVELS {
            let n = vector(&x, i);
            out[i] = if !GROUND {
                let o = vector(&x, LEVELS + i);
                o + twisted(n - o, self.k)
            } else if i == 0 {
                let o = fixed(x[0], self.at);
                o + twisted(n - o, self.k)
            } else {
                twisted(n, self.k)
            };
        }
        put(out)
    }
}

impl<const LEVELS: usize, const LENGTHS: bool> Images<LEVELS, LENGTHS> {
    #[inline(always)]
    fn solve<N: Lane, const IN: usize, const OUT: usize>(&self, x: [N; IN]) -> [N; OUT] {
        let mut out = [vector(&x, 0); LEVELS];
        for i in 0..LEVELS {
            out[i] = vector(&x, i) + twisted(vector(&x, LEVELS + i), self.k);
        }
        put(out)
    }
}

impl<const LEVELS: usize, const LENGTHS: bool> Slider<LEVELS, LENGTHS> {
    #[inline(always)]
    fn solve<N: Lane, const IN: usize, const OUT: usize>(&self, x: [N; IN]) -> [N; OUT] {
        let (a, t) = (vector(&x, 0), self.t);
        let (qx, qy) = (-a.x + self.q[0], -a.y + self.q[1]);
        let (h, b) = (qy * t[0] + qx * -t[1], qx * t[0] + qy * t[1]);
        let (r, h2) = (self.r, h * h);
        let outer = (-h + r) * (h + r);
        let w = outer.root_unless_touching(outer, (h2 + r * r) * TOUCH) * self.sign;
        let way = w - b;
        let c = Vec2::new(way * t[0] + self.q[0], way * t[1] + self.q[1]);
        let mut out = [c; LEVELS];
        if LEVELS > 1 {
            let u = c - a;
            // The number w is u·t, the distance from the foot of A.
            let inverse = w.constant(1.0) / w;
            let (va, rate) = (vector(&x, 1), u.dot(vector(&x, 1)) * inverse);
            out[1] = Vec2::new(rate * t[0], rate * t[1]);
            if LEVELS > 2 {
                let rate = (u.dot(vector(&x, 2)) - (out[1] - va).norm2()) * inverse;
                out[2] = Vec2::new(rate * t[0], rate * t[1]);
            }
        }
        put(out)
    }
}

impl<const GROUND: bool, const LEVELS: usize> LineTurning<GROUND, LEVELS> {
    #[inline(always)]
    fn solve<N: Lane, const IN: usize, const OUT: usize>(&self, x: [N; IN]) -> [N; OUT] {
        let d = vector(&x, 0) - if GROUND { fixed(x[0], self.at) } else { vector(&x, LEVELS) };
        let inverse = d.x.constant(1.0) / d.norm2();
        let v = if GROUND { vector(&x, 1) } else { vector(&x, 1) - vector(&x, LEVELS + 1) };
        let omega = d.cross(v) * inverse;
        let mut out = [omega; OUT];
        if LEVELS > 2 {
            let a = if GROUND { vector(&x, 2) } else { vector(&x, 2) - vector(&x, LEVELS + 2) };
            out[1] = (d.cross(a) - omega * d.dot(v) * 2.0) * inverse;
        }
        out
    }
}

impl<const LEVELS: usize> SlottedLever<LEVELS> {
    #[inline(always)]
    fn solve<N: Lane, const IN: usize, const OUT: usize>(&self, x: [N; IN]) -> [N; OUT] {
        let r = vector(&x, 0) - fixed(x[0], self.at);
        let (r2, h2) = (r.norm2(), self.h * self.h);
        let outer = r2 + -h2;
        let w = outer.root_unless_touching(outer, (r2 + h2) * TOUCH) * self.sign;
        let inverse = r2.constant(1.0) / r2;
        let t = Vec2::new((r.x * w + r.y * self.h) * inverse, (r.y * w + r.x * -self.h) * inverse);
        let arm = twisted(t, self.k);
        let n = twisted(arm, self.n);
        let inverse = r2.constant(1.0) / n.dot(r.perp());
        let v = vector(&x, 1);
        let omega = n.dot(v) * inverse;
        let mut out = [omega; OUT];
        let rate = arm.perp() * omega;
        (out[0], out[1], out[2], out[3]) = (arm.x, arm.y, rate.x, rate.y);
        if LEVELS > 2 {
            let (slip, square) = (v - r.perp() * omega, omega * omega);
            let c = n.dot(vector(&x, 2)) - omega * n.dot(slip.perp()) * 2.0 + square * n.dot(r);
            let alpha = c * inverse;
            let rate = arm.perp() * alpha - arm * square;
            (out[4], out[5], out[OUT - 2], out[OUT - 1]) = (rate.x, rate.y, omega, alpha);
        }
        out
    }
}

/// Declares the kernels with their levels: the name of each, and the counts of inputs and results.
macro_rules! kernels {
    ($($name:ident = $kernel:ty: $levels:literal, $in:literal => $out:literal, $places:expr;)*) => {
        $(
            #[doc = concat!("[`", stringify!($kernel), "`].")]
            pub type $name = $kernel;

            impl Kernel<$in, $out> for $name {
                fn inputs(&self) -> [Reg; $in] {
                    let places: fn(&Self) -> [MotionRegisters; 2] = $places;
                    wires($levels, &places(self))
                }

                #[inline(always)]
                fn eval<N: Lane>(&self, x: [N; $in]) -> [N; $out] {
                    self.solve(x)
                }
            }
        )*
    };
}

kernels! {
    DyadP = Dyad<false, 1, false>: 1, 4 => 2, |k| [k.a, k.b];
    DyadV = Dyad<false, 2, false>: 2, 8 => 4, |k| [k.a, k.b];
    DyadA = Dyad<false, 3, false>: 3, 12 => 6, |k| [k.a, k.b];
    DyadVL = Dyad<false, 2, true>: 2, 8 => 5, |k| [k.a, k.b];
    DyadAL = Dyad<false, 3, true>: 3, 12 => 8, |k| [k.a, k.b];
    DyadGroundP = Dyad<true, 1, false>: 1, 2 => 2, |k| [k.a, k.a];
    DyadGroundV = Dyad<true, 2, false>: 2, 4 => 4, |k| [k.a, k.a];
    DyadGroundA = Dyad<true, 3, false>: 3, 6 => 6, |k| [k.a, k.a];
    DyadGroundVL = Dyad<true, 2, true>: 2, 4 => 5, |k| [k.a, k.a];
    DyadGroundAL = Dyad<true, 3, true>: 3, 6 => 8, |k| [k.a, k.a];
    CrankP = Crank<1, false>: 1, 2 => 2, |k| [[k.turn; 3]; 2];
    CrankV = Crank<2, false>: 1, 2 => 4, |k| [[k.turn; 3]; 2];
    CrankA = Crank<3, false>: 1, 2 => 6, |k| [[k.turn; 3]; 2];
    EvenP = Crank<1, true>: 1, 2 => 2, |k| [[k.turn; 3]; 2];
    EvenV = Crank<2, true>: 1, 2 => 4, |k| [[k.turn; 3]; 2];
    EvenA = Crank<3, true>: 1, 2 => 6, |k| [[k.turn; 3]; 2];
    CoupledP = CoupledPoint<false, 1, false>: 1, 4 => 2, |k| [k.n, k.o];
    CoupledV = CoupledPoint<false, 2, false>: 2, 8 => 4, |k| [k.n, k.o];
    CoupledA = CoupledPoint<false, 3, false>: 3, 12 => 6, |k| [k.n, k.o];
    CoupledVL = CoupledPoint<false, 2, true>: 2, 8 => 5, |k| [k.n, k.o];
    CoupledAL = CoupledPoint<false, 3, true>: 3, 12 => 8, |k| [k.n, k.o];
    CoupledGroundP = CoupledPoint<true, 1, false>: 1, 2 => 2, |k| [k.n, k.n];
    CoupledGroundV = CoupledPoint<true, 2, false>: 2, 4 => 4, |k| [k.n, k.n];
    CoupledGroundA = CoupledPoint<true, 3, false>: 3, 6 => 6, |k| [k.n, k.n];
    CoupledGroundVL = CoupledPoint<true, 2, true>: 2, 4 => 5, |k| [k.n, k.n];
    CoupledGroundAL = CoupledPoint<true, 3, true>: 3, 6 => 8, |k| [k.n, k.n];
    ImagesP = Images<1, false>: 1, 4 => 2, |k| [k.o, k.d];
    ImagesV = Images<2, false>: 2, 8 => 4, |k| [k.o, k.d];
    ImagesA = Images<3, false>: 3, 12 => 6, |k| [k.o, k.d];
    ImagesVL = Images<2, true>: 2, 8 => 5, |k| [k.o, k.d];
    ImagesAL = Images<3, true>: 3, 12 => 8, |k| [k.o, k.d];
    SliderP = Slider<1, false>: 1, 2 => 2, |k| [k.a, k.a];
    SliderV = Slider<2, false>: 2, 4 => 4, |k| [k.a, k.a];
    SliderA = Slider<3, false>: 3, 6 => 6, |k| [k.a, k.a];
    SliderVL = Slider<2, true>: 2, 4 => 5, |k| [k.a, k.a];
    SliderAL = Slider<3, true>: 3, 6 => 8, |k| [k.a, k.a];
    SlottedV = SlottedLever<2>: 2, 4 => 5, |k| [k.b, k.b];
    SlottedA = SlottedLever<3>: 3, 6 => 8, |k| [k.b, k.b];
    TurnedV = LineTurning<false, 2>: 2, 8 => 1, |k| [k.n, k.o];
    TurnedA = LineTurning<false, 3>: 3, 12 => 2, |k| [k.n, k.o];
    TurnedGroundV = LineTurning<true, 2>: 2, 4 => 1, |k| [k.n, k.n];
    TurnedGroundA = LineTurning<true, 3>: 3, 6 => 2, |k| [k.n, k.n];
}
