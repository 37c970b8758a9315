//! Kernels of the groups' velocities and accelerations: each leg gives one row n·v_P = c, and the
//! rows of a group are solved together.
//!
//! For a pin, P is its own place; for a link, P is the place where the leg holds it, r the arm to
//! it from the link's own point. The rows of accelerations have the same n. Two bars, the RRR dyad,
//! have kernels of their own that do both.

use super::kernel::{Kernel, Reg, RegPair};
use super::lane::Lane;
use hodograph_base::geom::Vec2;

/// The velocity row of a distance: P keeps a distance l from F that grows at a given rate, n = P −
/// F, c = n·v_F + l l̇.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distance {
    /// The vector P − F.
    pub n: RegPair,
    /// The velocity v_F.
    pub vf: RegPair,
    /// The distance l.
    pub l: Reg,
    /// The rate l̇.
    pub rate: f64,
}

impl Kernel<5, 1> for Distance {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 5] {
        [self.n.x, self.n.y, self.vf.x, self.vf.y, self.l]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [nx, ny, vx, vy, l]: [N; 5]) -> [N; 1] {
        [nx * vx + ny * vy + l * self.rate]
    }
}

/// The acceleration row of a distance: c = n·a_F − |v_P − v_F|² + l̇² + l l̈.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DistanceRate {
    /// The vector P − F.
    pub n: RegPair,
    /// The velocity v_P.
    pub vp: RegPair,
    /// The velocity v_F.
    pub vf: RegPair,
    /// The acceleration a_F.
    pub af: RegPair,
    /// The distance l.
    pub l: Reg,
    /// The rate l̇.
    pub rate: f64,
    /// The second derivative l̈.
    pub acceleration: f64,
}

impl Kernel<9, 1> for DistanceRate {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 9] {
        [
            self.n.x, self.n.y, self.vp.x, self.vp.y, self.vf.x, self.vf.y, self.af.x, self.af.y,
            self.l,
        ]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [nx, ny, px, py, fx, fy, ax, ay, l]: [N; 9]) -> [N; 1] {
        let v = Vec2::new(px - fx, py - fy);
        [nx * ax + ny * ay - v.norm2() + l * self.acceleration + self.rate * self.rate]
    }
}

/// The velocity row of a guide: P moves at a given rate along n, a direction of a body Q with the
/// angular velocity ω, c = n·(v_O + ω × r) + rate, with O a point of Q and r the arm from it to P.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guided {
    /// The direction n.
    pub n: RegPair,
    /// The arm r = P − O.
    pub r: RegPair,
    /// The velocity v_O.
    pub vo: RegPair,
    /// The angular velocity ω of the body.
    pub omega: Reg,
    /// The rate.
    pub rate: f64,
}

impl Kernel<7, 1> for Guided {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 7] {
        [self.n.x, self.n.y, self.r.x, self.r.y, self.vo.x, self.vo.y, self.omega]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [nx, ny, rx, ry, vx, vy, w]: [N; 7]) -> [N; 1] {
        [nx * (vx - w * ry) + ny * (vy + w * rx) + self.rate]
    }
}

/// The acceleration row of a guide: c = n·(a_O + α × r − ω² r) + 2 ω n·(v_r turned by 90°) +
/// acceleration, v_r = v_P − v_O − ω × r.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GuidedRate {
    /// The direction n.
    pub n: RegPair,
    /// The arm r = P − O.
    pub r: RegPair,
    /// The velocity v_P.
    pub vp: RegPair,
    /// The velocity v_O.
    pub vo: RegPair,
    /// The acceleration a_O.
    pub ao: RegPair,
    /// The angular velocity ω of the body.
    pub omega: Reg,
    /// The angular acceleration α of the body.
    pub alpha: Reg,
    /// The second derivative along n.
    pub acceleration: f64,
}

impl Kernel<12, 1> for GuidedRate {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 12] {
        let s = self;
        [
            s.n.x, s.n.y, s.r.x, s.r.y, s.vp.x, s.vp.y, s.vo.x, s.vo.y, s.ao.x, s.ao.y, s.omega,
            s.alpha,
        ]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [nx, ny, rx, ry, px, py, vx, vy, ax, ay, w, e]: [N; 12]) -> [N; 1] {
        let n = Vec2::new(nx, ny);
        let r = Vec2::new(rx, ry);
        let slip = Vec2::new(px - vx + w * ry, py - vy - w * rx);
        let carried = Vec2::new(ax, ay) + r.perp() * e - r * (w * w);
        [n.dot(carried) + w * n.dot(slip.perp()) * 2.0 + self.acceleration]
    }
}

/// The acceleration row of a slot: a slot of the link runs over a known point B, n is square to the
/// slot, r = B − O: c = n·a_B − 2 ω n·(v_r turned by 90°), v_r = v_B − v_O − ω × r. For velocities
/// c = n·v_B is a [`Distance`] at rate 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlotRate {
    /// The direction n, square to the slot.
    pub n: RegPair,
    /// The arm r = B − O.
    pub r: RegPair,
    /// The velocity v_B.
    pub vb: RegPair,
    /// The acceleration a_B.
    pub ab: RegPair,
    /// The velocity v_O of the link.
    pub vo: RegPair,
    /// The angular velocity ω of the link.
    pub omega: Reg,
}

impl Kernel<11, 1> for SlotRate {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 11] {
        let s = self;
        [s.n.x, s.n.y, s.r.x, s.r.y, s.vb.x, s.vb.y, s.ab.x, s.ab.y, s.vo.x, s.vo.y, s.omega]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [nx, ny, rx, ry, px, py, ax, ay, vx, vy, w]: [N; 11]) -> [N; 1] {
        let n = Vec2::new(nx, ny);
        let slip = Vec2::new(px - vx + w * ry, py - vy - w * rx);
        [n.dot(Vec2::new(ax, ay)) - w * n.dot(slip.perp()) * 2.0]
    }
}

/// The velocity row of a link's own point, for a known angular velocity: c' = c − ω n·(r turned by
/// 90°).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reduced {
    /// The normal n.
    pub n: RegPair,
    /// The arm r.
    pub r: RegPair,
    /// The right-hand side c.
    pub c: Reg,
    /// The angular velocity ω.
    pub omega: Reg,
}

impl Kernel<6, 1> for Reduced {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 6] {
        [self.n.x, self.n.y, self.r.x, self.r.y, self.c, self.omega]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [nx, ny, rx, ry, c, w]: [N; 6]) -> [N; 1] {
        [c - w * (ny * rx - nx * ry)]
    }
}

/// The acceleration row of a link's own point: c' = c + ω² n·r − α n·(r turned by 90°).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReducedRate {
    /// The normal n.
    pub n: RegPair,
    /// The arm r.
    pub r: RegPair,
    /// The right-hand side c.
    pub c: Reg,
    /// The angular velocity ω.
    pub omega: Reg,
    /// The angular acceleration α, or zero while it is unknown.
    pub alpha: Reg,
}

impl Kernel<7, 1> for ReducedRate {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 7] {
        [self.n.x, self.n.y, self.r.x, self.r.y, self.c, self.omega, self.alpha]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [nx, ny, rx, ry, c, w, e]: [N; 7]) -> [N; 1] {
        [c + w * w * (nx * rx + ny * ry) - e * (ny * rx - nx * ry)]
    }
}

/// Angular velocity of a link with the velocity v of its own point: ω = (c − n·v)/(n·(r turned by
/// 90°)). With a reduced row it gives α in the same way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurnOf {
    /// The normal n.
    pub n: RegPair,
    /// The arm r.
    pub r: RegPair,
    /// The right-hand side c.
    pub c: Reg,
    /// The velocity v of the link's own point.
    pub v: RegPair,
}

impl Kernel<7, 1> for TurnOf {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 7] {
        [self.n.x, self.n.y, self.r.x, self.r.y, self.c, self.v.x, self.v.y]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [nx, ny, rx, ry, c, vx, vy]: [N; 7]) -> [N; 1] {
        [(c - (nx * vx + ny * vy)) / (ny * rx - nx * ry)]
    }
}

/// The solution of two rows: v with n₁·v = c₁, n₂·v = c₂.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cross {
    /// The normal n₁.
    pub n1: RegPair,
    /// The right-hand side c₁.
    pub c1: Reg,
    /// The normal n₂.
    pub n2: RegPair,
    /// The right-hand side c₂.
    pub c2: Reg,
}

impl Kernel<6, 2> for Cross {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 6] {
        [self.n1.x, self.n1.y, self.c1, self.n2.x, self.n2.y, self.c2]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [ux, uy, p, wx, wy, q]: [N; 6]) -> [N; 2] {
        let det = ux * wy - uy * wx;
        [(p * wy - q * uy) / det, (q * ux - p * wx) / det]
    }
}

/// The solution of three rows: v and ω of a link with n·(v + ω × r) = c for each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Three {
    /// The n, r and c of the three rows.
    pub rows: [(RegPair, RegPair, Reg); 3],
}

impl Kernel<15, 3> for Three {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 15] {
        let [a, b, c] = self.rows.map(|(n, r, c)| [n.x, n.y, r.x, r.y, c]);
        [a[0], a[1], a[2], a[3], a[4], b[0], b[1], b[2], b[3], b[4], c[0], c[1], c[2], c[3], c[4]]
    }

    /// Cramer's rule on (n, τ) with τ = n·(r turned by 90°), the moment of the row about the link's
    /// own point.
    #[inline(always)]
    fn eval<N: Lane>(&self, x: [N; 15]) -> [N; 3] {
        let row =
            |i: usize| (Vec2::new(x[i], x[i + 1]), x[i + 1] * x[i + 2] - x[i] * x[i + 3], x[i + 4]);
        let ((na, ta, ca), (nb, tb, cb), (nc, tc, cc)) = (row(0), row(5), row(10));
        let (bc, ca_, ab) = (nb.cross(nc), nc.cross(na), na.cross(nb));
        let det = ta * bc + tb * ca_ + tc * ab;
        let omega = (ca * bc + cb * ca_ + cc * ab) / det;
        let pick = |fa: N, fb: N, fc: N| {
            // The formula Σ c_i (f_j τ_k − f_k τ_j), with f the other component of the normals.
            (ca * (fb * tc - fc * tb) + cb * (fc * ta - fa * tc) + cc * (fa * tb - fb * ta)) / det
        };
        [pick(na.y, nb.y, nc.y), -pick(na.x, nb.x, nc.x), omega]
    }
}

/// Velocity v_C of the pin of two bars A–C and B–C, and 1/det for the accelerations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bars {
    /// The pin C.
    pub c: RegPair,
    /// The end A.
    pub a: RegPair,
    /// The end B.
    pub b: RegPair,
    /// The velocity v_A.
    pub va: RegPair,
    /// The velocity v_B.
    pub vb: RegPair,
    /// The determinant (C − A) × (C − B).
    pub det: Reg,
}

impl Kernel<11, 3> for Bars {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 11] {
        let s = self;
        [s.c.x, s.c.y, s.a.x, s.a.y, s.b.x, s.b.y, s.va.x, s.va.y, s.vb.x, s.vb.y, s.det]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [cx, cy, ax, ay, bx, by, vax, vay, vbx, vby, det]: [N; 11]) -> [N; 3] {
        let (ux, uy, wx, wy) = (cx - ax, cy - ay, cx - bx, cy - by);
        let inverse = det.constant(1.0) / det;
        let p = (ux * vax + uy * vay) * inverse;
        let q = (wx * vbx + wy * vby) * inverse;
        [p * wy - q * uy, q * ux - p * wx, inverse]
    }
}

/// Acceleration of the pin of two bars.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BarsRate {
    /// The operation of the velocities.
    pub bars: Bars,
    /// The velocity v_C.
    pub vc: RegPair,
    /// The acceleration a_A.
    pub aa: RegPair,
    /// The acceleration a_B.
    pub ab: RegPair,
    /// The quotient 1/det.
    pub inverse: Reg,
}

impl Kernel<17, 2> for BarsRate {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 17] {
        let (s, b) = (self, &self.bars);
        [
            b.c.x, b.c.y, b.a.x, b.a.y, b.b.x, b.b.y, b.va.x, b.va.y, b.vb.x, b.vb.y, s.vc.x,
            s.vc.y, s.aa.x, s.aa.y, s.ab.x, s.ab.y, s.inverse,
        ]
    }

    #[inline(always)]
    fn eval<N: Lane>(
        &self,
        [cx, cy, ax, ay, bx, by, vax, vay, vbx, vby, vx, vy, aax, aay, abx, aby, inverse]: [N; 17],
    ) -> [N; 2] {
        let (ux, uy, wx, wy) = (cx - ax, cy - ay, cx - bx, cy - by);
        let (rx, ry, sx, sy) = (vx - vax, vy - vay, vx - vbx, vy - vby);
        let p = (ux * aax + uy * aay - (rx * rx + ry * ry)) * inverse;
        let q = (wx * abx + wy * aby - (sx * sx + sy * sy)) * inverse;
        [p * wy - q * uy, q * ux - p * wx]
    }
}
