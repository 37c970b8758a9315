//! Followers of cams as kernels: where the cam stands, which piece holds the follower there, and the follower's place and rates.
//!
//! A piece of a profile is a circle or a line on which the follower's point runs in the cam: its pitch curve A|b|² − g·b + h = 0 with
//! |g|² − 4Ah = 1, where A = 1/2L for an arc (L = ρ + r, K its centre: g = K/L) and A = 0 for a line (−g its outward normal). One closed form then
//! serves arcs and lines alike, and positions side by side in a chunk may touch different pieces. Place and rates follow from the equation
//! and its derivatives by the angle θ by which the cam is turned, G = g turned by θ. Laws are polynomials and waves of the angle.

use super::kernel::{Kernel, Pair, Reg};
use super::lane::Lane;
use super::turns::{QUARTER, turned};
use hodograph_base::geom::Vec2;
use std::f64::consts::{FRAC_1_PI, TAU};

/// The angle of the cam from the beginning of its first stretch on, in its own sense (rad), in one turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phase {
    /// Where the driver stands, of [`super::turns::Quarters`].
    pub quarters: Pair,
    /// By how much the angle grows with the driver: ±1, or the ratio of the wheels between the two.
    pub sense: f64,
    /// The angle at which the first stretch begins (rad), less what is seen from one side of joints.
    pub start: f64,
}

impl Kernel<2, 1> for Phase {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 2] {
        [self.quarters.x, self.quarters.y]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [k, r]: [N; 2]) -> [N; 1] {
        let Phase { sense, start, .. } = *self;
        // Behind wheels a turn of the driver is none of the cam.
        let m = if sense.abs() == 1.0 { k + (k * 0.25).nearest() * -4.0 } else { k };
        let x = m * (sense * QUARTER[0]) + (m * (sense * QUARTER[1]) + (r * sense + -start));
        [x + (x * (0.5 * FRAC_1_PI) + -0.5).nearest() * -TAU]
    }
}

/// Four numbers of the piece that is touched: those of the stretches before, or those of one that begins at an angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// The angle of the cam.
    pub at: Reg,
    /// The numbers before.
    pub before: [Reg; 4],
    /// Where the stretch begins.
    pub from: f64,
    /// Its numbers.
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

/// A translating follower with a round end at P = w + q d in the axes of the carrying link, the cam's centre being the origin, d the direction of
/// the lift, w = −e d turned by 90°: 2Aq = G·d + S with S² = 1 − (G·d⊥ + 2Ae)².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lift {
    /// A, g, and h of the piece.
    pub piece: [Reg; 4],
    /// cos θ, sin θ.
    pub turn: Pair,
    /// +1, or −1 where θ is the opposite of that.
    pub way: f64,
    /// d.
    pub direction: Vec2,
    /// e.
    pub offset: f64,
    /// Where the follower's own coordinate stands at q = 0.
    pub origin: f64,
    /// +1 where that grows with q, else −1.
    pub out: f64,
}

impl Kernel<6, 5> for Lift {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 6] {
        let [a, x, y, h] = self.piece;
        [a, x, y, h, self.turn.x, self.turn.y]
    }

    /// The follower's coordinate, q, G, S.
    #[inline(always)]
    fn eval<N: Lane>(&self, [a, gx, gy, h, c, s]: [N; 6]) -> [N; 5] {
        let (d, e) = (self.direction, self.offset);
        let s = s * self.way;
        let (gx, gy) = (gx * c - gy * s, gx * s + gy * c);
        let along = gx * d.x + gy * d.y;
        let across = gy * d.x + gx * -d.y;
        let t = across + a * (2.0 * e);
        let root = ((t + 1.0) * (-t + 1.0)).sqrt();
        // The same root in two forms, neither of which takes nearly equal numbers from each other.
        let rest = h + across * e + a * (e * e);
        let (num, den) = (along.past(0.0, along + root, rest + rest), along.past(0.0, a + a, along - root));
        let q = num / den;
        [q * self.out + self.origin, q, gx, gy, root]
    }
}

/// Its rates: Sq′ = G⊥·P, Sq″ = 2q′ G⊥·d − G·P − 2Aq′², by the time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LiftRate {
    /// What [`Lift`] fills, from q on.
    pub lift: [Reg; 4],
    /// A.
    pub a: Reg,
    /// d.
    pub direction: Vec2,
    /// e.
    pub offset: f64,
    /// θ̇, θ̈.
    pub rates: [f64; 2],
    /// +1 where the follower's own coordinate grows with q, else −1.
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
        // G⊥·P and G·P of P = q d − e d⊥; G⊥·d = −across, G⊥·d⊥ = along.
        let q1 = (-(q * across) + along * -e) * inverse;
        let q2 = (q1 * across * -2.0 + (across * e - q * along) - a * q1 * q1 * 2.0) * inverse;
        [q1 * (self.out * w), q2 * (self.out * (w * w)) + q1 * (self.out * acceleration)]
    }
}

/// A translating follower with a flat face square to its guide: q = K·d + ρ, of which g = K and h = ρ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Faced {
    /// Nothing, K, ρ.
    pub piece: [Reg; 4],
    /// cos θ, sin θ.
    pub turn: Pair,
    /// +1, or −1 where θ is the opposite of that.
    pub way: f64,
    /// d.
    pub direction: Vec2,
    /// Where the follower's own coordinate stands at q = 0.
    pub origin: f64,
    /// θ̇, θ̈.
    pub rates: [f64; 2],
    /// +1 where the follower's own coordinate grows with q, else −1.
    pub out: f64,
}

impl Kernel<5, 3> for Faced {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 5] {
        let [_, x, y, h] = self.piece;
        [x, y, h, self.turn.x, self.turn.y]
    }

    /// The follower's coordinate and its rates.
    #[inline(always)]
    fn eval<N: Lane>(&self, [kx, ky, rho, c, s]: [N; 5]) -> [N; 3] {
        let (d, out, [w, acceleration]) = (self.direction, self.out, self.rates);
        let s = s * self.way;
        let (kx, ky) = (kx * c - ky * s, kx * s + ky * c);
        let (along, across) = (kx * d.x + ky * d.y, ky * d.x + kx * -d.y);
        [(along + rho) * out + self.origin, -across * (out * w), along * -(out * (w * w)) + across * -(out * acceleration)]
    }
}

/// An oscillating follower, whose arm has the direction u in the axes of the carrying link: M·u = c with M = A m + N, c = h + f N·P,
/// N = g turned by θ, P the pivot. With a round end on an arm l: m = 2lP, f = −1/l, of −l times the piece's g and its own h; a face: m = ±P⊥, f = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rock {
    /// A, g, h.
    pub piece: [Reg; 4],
    /// cos θ, sin θ.
    pub turn: Pair,
    /// +1, or −1 where θ is the opposite of that.
    pub way: f64,
    /// m.
    pub m: Vec2,
    /// f P.
    pub pivot: Vec2,
    /// Which of the two directions.
    pub sign: f64,
}

impl Kernel<6, 5> for Rock {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 6] {
        let [a, x, y, h] = self.piece;
        [a, x, y, h, self.turn.x, self.turn.y]
    }

    /// u, N, and M·u⊥.
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

/// Its rates: M·u⊥ ψ′ = f N⊥·P − N⊥·u, M·u⊥ ψ″ = −f N·P + N·u − 2ψ′ N⊥·u⊥ + c ψ′², by the time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RockRate {
    /// What [`Rock`] fills.
    pub rock: [Reg; 5],
    /// h.
    pub h: Reg,
    /// f P.
    pub pivot: Vec2,
    /// θ̇, θ̈.
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
        // N⊥·v = N × v.
        let (np, nxp) = (nx * p.x + ny * p.y, nx * p.y + ny * -p.x);
        let (nu, nxu) = (nx * ux + ny * uy, nx * uy - ny * ux);
        let q1 = (nxp - nxu) * inverse;
        let q2 = (nu - np - nu * q1 * 2.0 + (h + np) * q1 * q1) * inverse;
        [q1 * w, q2 * (w * w) + q1 * acceleration]
    }
}

/// A law at the angle of the cam: from the beginning of its stage u = φ − u₀, c₀ + c₁u + c₂u² and its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parabola {
    /// φ.
    pub at: Reg,
    /// u₀, c₀, c₁, c₂.
    pub numbers: [Reg; 4],
    /// By how much φ is ahead, so that it is seen from one side of joints (rad).
    pub ahead: f64,
}

impl Kernel<5, 4> for Parabola {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 5] {
        let [a, b, c, d] = self.numbers;
        [self.at, a, b, c, d]
    }

    /// s, s′, s″, u.
    #[inline(always)]
    fn eval<N: Lane>(&self, [at, start, c0, c1, c2]: [N; 5]) -> [N; 4] {
        let u = at + -self.ahead - start;
        let twice = c2 + c2;
        [(c2 * u + c1) * u + c0, twice * u + c1, twice, u]
    }
}

/// The same with a polynomial of the third degree times u³ added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Higher {
    /// s, s′, s″, u.
    pub low: Reg,
    /// c₃ to c₆.
    pub numbers: [Reg; 4],
    /// c₇.
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

/// The same with a wave A sin(ku + p) added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// s, s′, s″, u.
    pub low: Reg,
    /// A, k, p.
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

/// Rates by the time of what goes by an angle: s′ω, s″ω² + s′α.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ByAngle {
    /// s, s′, s″.
    pub low: Reg,
    /// ω, α of the angle.
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
