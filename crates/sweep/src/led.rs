//! Kernels of cam followers: the cam's angle, the piece that holds the follower there, and the
//! follower's position and rates.
//!
//! A piece of a profile is a circle or a line on which the follower's point runs in the cam. Its
//! pitch curve is A|b|² − g·b + h = 0 with |g|² − 4Ah = 1, where A = 1/2L for an arc (L = ρ + r, K
//! its centre: g = K/L) and A = 0 for a line (−g its outward normal). One closed form then serves
//! arcs and lines alike, and positions side by side in a chunk may touch different pieces. Position
//! and rates follow from the equation and its derivatives by the angle θ by which the cam is
//! turned, G = g turned by θ. Laws are polynomials and waves of the angle.

use super::kernel::{Kernel, Reg, RegPair};
use super::lane::Lane;
use super::turns::{QUARTER, turned};
use hodograph_base::geom::Vec2;
use std::f64::consts::{FRAC_1_PI, TAU};

/// The angle of the cam from the beginning of its first stretch, in the cam's own sense, within one
/// turn (rad).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CamPhase {
    /// The driver's angle in [`super::turns::Quarters`].
    pub quarters: RegPair,
    /// The rate of the angle by the driver's angle: ±1, or the ratio of the wheels between the two.
    pub sense: f64,
    /// The angle at which the first stretch begins, less the shift to one side of junctions (rad).
    pub start: f64,
}

impl Kernel<2, 1> for CamPhase {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 2] {
        [self.quarters.x, self.quarters.y]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [k, r]: [N; 2]) -> [N; 1] {
        let CamPhase { sense, start, .. } = *self;
        // With wheels between them, a turn of the driver is not a turn of the cam.
        let m = if sense.abs() == 1.0 { k + (k * 0.25).nearest() * -4.0 } else { k };
        let x = m * (sense * QUARTER[0]) + (m * (sense * QUARTER[1]) + (r * sense + -start));
        [x + (x * (0.5 * FRAC_1_PI) + -0.5).nearest() * -TAU]
    }
}

/// Four numbers of the piece in contact: those of the stretches before, or from an angle on those
/// of this stretch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// The angle of the cam.
    pub at: Reg,
    /// The numbers of the stretches before.
    pub before: [Reg; 4],
    /// The angle at which this stretch begins.
    pub from: f64,
    /// The numbers of this stretch.
    pub numbers: [f64; 4],
}

impl Kernel<5, 4> for Stretch {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 5] {
        let [a, b, c, d] = self.before;
        [self.at, a, b, c, d]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [at, a, b, c, d]: [N; 5]) -> [N; 4] {
        let [p, q, r, s] = self.numbers;
        let from = self.from;
        let [p, q, r, s] = [at.constant(p), at.constant(q), at.constant(r), at.constant(s)];
        [at.past(from, p, a), at.past(from, q, b), at.past(from, r, c), at.past(from, s, d)]
    }
}

/// A translating follower with a round end at P = w + q d in the axes of the carrying link. The
/// origin is the cam's centre, d the direction of the lift, and w = −e d turned by 90°:
/// 2Aq = G·d + S with S² = 1 − (G·d⊥ + 2Ae)².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lift {
    /// The numbers A, g and h of the piece.
    pub piece: [Reg; 4],
    /// The components cos θ and sin θ.
    pub turn: RegPair,
    /// +1, or −1 if `turn` is that of −θ.
    pub way: f64,
    /// The direction d.
    pub direction: Vec2,
    /// The offset e.
    pub offset: f64,
    /// The follower's own coordinate at q = 0.
    pub origin: f64,
    /// +1 if that coordinate grows with q, else −1.
    pub out: f64,
}

impl Kernel<6, 5> for Lift {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 6] {
        let [a, x, y, h] = self.piece;
        [a, x, y, h, self.turn.x, self.turn.y]
    }

    /// Returns the follower's coordinate, q, G, S.
    #[inline(always)]
    fn eval<N: Lane>(&self, [a, gx, gy, h, c, s]: [N; 6]) -> [N; 5] {
        let (d, e) = (self.direction, self.offset);
        let s = s * self.way;
        let (gx, gy) = (gx * c - gy * s, gx * s + gy * c);
        let along = gx * d.x + gy * d.y;
        let across = gy * d.x + gx * -d.y;
        let t = across + a * (2.0 * e);
        let root = ((t + 1.0) * (-t + 1.0)).sqrt();
        // The root in two forms; neither subtracts nearly equal numbers.
        let rest = h + across * e + a * (e * e);
        let (num, den) =
            (along.past(0.0, along + root, rest + rest), along.past(0.0, a + a, along - root));
        let q = num / den;
        [q * self.out + self.origin, q, gx, gy, root]
    }
}

/// The rates of [`Lift`] by the time: Sq′ = G⊥·P, Sq″ = 2q′ G⊥·d − G·P − 2Aq′².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LiftRate {
    /// The results of [`Lift`], from q on.
    pub lift: [Reg; 4],
    /// The number A.
    pub a: Reg,
    /// The direction d.
    pub direction: Vec2,
    /// The offset e.
    pub offset: f64,
    /// The rates θ̇ and θ̈.
    pub rates: [f64; 2],
    /// +1 if the follower's own coordinate grows with q, else −1.
    pub out: f64,
}

impl Kernel<5, 2> for LiftRate {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 5] {
        let [q, x, y, s] = self.lift;
        [q, x, y, s, self.a]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [q, gx, gy, root, a]: [N; 5]) -> [N; 2] {
        let (d, e) = (self.direction, self.offset);
        let [w, acceleration] = self.rates;
        let along = gx * d.x + gy * d.y;
        let across = gy * d.x + gx * -d.y;
        let inverse = a.constant(1.0) / root;
        // For P = q d − e d⊥, this computes G⊥·P and G·P; G⊥·d = −across, G⊥·d⊥ = along.
        let q1 = (-(q * across) + along * -e) * inverse;
        let q2 = (q1 * across * -2.0 + (across * e - q * along) - a * q1 * q1 * 2.0) * inverse;
        [q1 * (self.out * w), q2 * (self.out * (w * w)) + q1 * (self.out * acceleration)]
    }
}

/// A translating follower with a flat face square to its guide: q = K·d + ρ, with g = K and h = ρ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Faced {
    /// An unused number, K and ρ.
    pub piece: [Reg; 4],
    /// The components cos θ and sin θ.
    pub turn: RegPair,
    /// +1, or −1 if `turn` is that of −θ.
    pub way: f64,
    /// The direction d.
    pub direction: Vec2,
    /// The follower's own coordinate at q = 0.
    pub origin: f64,
    /// The rates θ̇ and θ̈.
    pub rates: [f64; 2],
    /// +1 if the follower's own coordinate grows with q, else −1.
    pub out: f64,
}

impl Kernel<5, 3> for Faced {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 5] {
        let [_, x, y, h] = self.piece;
        [x, y, h, self.turn.x, self.turn.y]
    }

    /// Returns the follower's coordinate and its rates.
    #[inline(always)]
    fn eval<N: Lane>(&self, [kx, ky, rho, c, s]: [N; 5]) -> [N; 3] {
        let (d, out, [w, acceleration]) = (self.direction, self.out, self.rates);
        let s = s * self.way;
        let (kx, ky) = (kx * c - ky * s, kx * s + ky * c);
        let (along, across) = (kx * d.x + ky * d.y, ky * d.x + kx * -d.y);
        [
            (along + rho) * out + self.origin,
            -across * (out * w),
            along * -(out * (w * w)) + across * -(out * acceleration),
        ]
    }
}

/// An oscillating follower. Its arm has the direction u in the axes of the carrying link: M·u = c
/// with M = A m + N, c = h + f N·P, N = g turned by θ, P the pivot. A round end on an arm l has
/// m = 2lP, f = −1/l, with −l times the piece's g and its own h; a face has m = ±P⊥, f = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rock {
    /// The numbers A, g and h.
    pub piece: [Reg; 4],
    /// The components cos θ and sin θ.
    pub turn: RegPair,
    /// +1, or −1 if `turn` is that of −θ.
    pub way: f64,
    /// The vector m.
    pub m: Vec2,
    /// The vector f P.
    pub pivot: Vec2,
    /// The branch: the sign that selects one of the two directions.
    pub sign: f64,
}

impl Kernel<6, 5> for Rock {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 6] {
        let [a, x, y, h] = self.piece;
        [a, x, y, h, self.turn.x, self.turn.y]
    }

    /// Returns u, N and M·u⊥.
    #[inline(always)]
    fn eval<N: Lane>(&self, [a, gx, gy, h, c, s]: [N; 6]) -> [N; 5] {
        let (m, p) = (self.m, self.pivot);
        let s = s * self.way;
        let (nx, ny) = (gx * c - gy * s, gx * s + gy * c);
        let (mx, my) = (a * m.x + nx, a * m.y + ny);
        let rhs = h + nx * p.x + ny * p.y;
        let square = mx * mx + my * my;
        let across = (square - rhs * rhs).sqrt() * self.sign;
        let inverse = a.constant(1.0) / square;
        [(mx * rhs - my * across) * inverse, (my * rhs + mx * across) * inverse, nx, ny, -across]
    }
}

/// The rates of [`Rock`] by the time: M·u⊥ ψ′ = f N⊥·P − N⊥·u,
/// M·u⊥ ψ″ = −f N·P + N·u − 2ψ′ N⊥·u⊥ + c ψ′².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RockRate {
    /// The results of [`Rock`].
    pub rock: [Reg; 5],
    /// The number h.
    pub h: Reg,
    /// The vector f P.
    pub pivot: Vec2,
    /// The rates θ̇ and θ̈.
    pub rates: [f64; 2],
}

impl Kernel<6, 2> for RockRate {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 6] {
        let [x, y, nx, ny, d] = self.rock;
        [x, y, nx, ny, d, self.h]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [ux, uy, nx, ny, det, h]: [N; 6]) -> [N; 2] {
        let (p, [w, acceleration]) = (self.pivot, self.rates);
        let inverse = h.constant(1.0) / det;
        // For every v, N⊥·v = N × v.
        let (np, nxp) = (nx * p.x + ny * p.y, nx * p.y + ny * -p.x);
        let (nu, nxu) = (nx * ux + ny * uy, nx * uy - ny * ux);
        let q1 = (nxp - nxu) * inverse;
        let q2 = (nu - np - nu * q1 * 2.0 + (h + np) * q1 * q1) * inverse;
        [q1 * w, q2 * (w * w) + q1 * acceleration]
    }
}

/// A law of the cam's angle, c₀ + c₁u + c₂u² with its derivatives; u = φ − u₀ counts from the
/// beginning of the stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parabola {
    /// The angle φ.
    pub at: Reg,
    /// The numbers u₀, c₀, c₁ and c₂.
    pub numbers: [Reg; 4],
    /// The shift of φ ahead, so that it is on one side of junctions (rad).
    pub ahead: f64,
}

impl Kernel<5, 4> for Parabola {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 5] {
        let [a, b, c, d] = self.numbers;
        [self.at, a, b, c, d]
    }

    /// Returns s, s′, s″, u.
    #[inline(always)]
    fn eval<N: Lane>(&self, [at, start, c0, c1, c2]: [N; 5]) -> [N; 4] {
        let u = at + -self.ahead - start;
        let twice = c2 + c2;
        [(c2 * u + c1) * u + c0, twice * u + c1, twice, u]
    }
}

/// A law with a polynomial of the third degree times u³ added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Higher {
    /// The first register of s, s′, s″, u.
    pub low: Reg,
    /// The coefficients c₃ to c₆.
    pub numbers: [Reg; 4],
    /// The coefficient c₇.
    pub last: Reg,
}

impl Kernel<9, 4> for Higher {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 9] {
        let [a, b, c, d] = self.numbers;
        let l = self.low.0;
        [Reg(l), Reg(l + 1), Reg(l + 2), Reg(l + 3), a, b, c, d, self.last]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [s, s1, s2, u, c3, c4, c5, c6, c7]: [N; 9]) -> [N; 4] {
        let p = (((c7 * u + c6) * u + c5) * u + c4) * u + c3;
        let p1 = (((c7 * 7.0 * u + c6 * 6.0) * u + c5 * 5.0) * u + c4 * 4.0) * u + c3 * 3.0;
        let p2 = (((c7 * 42.0 * u + c6 * 30.0) * u + c5 * 20.0) * u + c4 * 12.0) * u + c3 * 6.0;
        let square = u * u;
        [s + p * square * u, s1 + p1 * square, s2 + p2 * u, u]
    }
}

/// A law with a wave A sin(ku + p) added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// The first register of s, s′, s″, u.
    pub low: Reg,
    /// The numbers A, k and p.
    pub numbers: [Reg; 3],
}

impl Kernel<7, 4> for Wave {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 7] {
        let ([a, b, c], l) = (self.numbers, self.low.0);
        [Reg(l), Reg(l + 1), Reg(l + 2), Reg(l + 3), a, b, c]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [s, s1, s2, u, amplitude, k, phase]: [N; 7]) -> [N; 4] {
        let [cos, sin] = turned(u.constant(0.0), k * u + phase);
        let rate = amplitude * k;
        [s + amplitude * sin, s1 + rate * cos, s2 - rate * k * sin, u]
    }
}

/// The rates by the time of a function of an angle: s′ω, s″ω² + s′α.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ByAngle {
    /// The first register of s, s′, s″.
    pub low: Reg,
    /// The rates ω and α of the angle.
    pub rates: [f64; 2],
}

impl Kernel<2, 2> for ByAngle {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 2] {
        [Reg(self.low.0 + 1), Reg(self.low.0 + 2)]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [s1, s2]: [N; 2]) -> [N; 2] {
        let [w, acceleration] = self.rates;
        [s1 * w, s2 * (w * w) + s1 * acceleration]
    }
}
