//! Velocities and accelerations of the groups as kernels: each leg gives one row n·v_P = c, the rows of a group are solved.
//!
//! For a pin P = its own place; for a link P is the place where the leg holds it, r the arm to it from the link's own
//! point. The rows of accelerations have the same n. Two bars, the RRR dyad, have kernels of their own that do both.

use super::kernel::{Kernel, Pair, Reg};
use super::lane::Lane;
use hodograph_base::geom::Vec2;

/// P keeps a distance l from F that grows at a given rate: n = P − F, c = n·v_F + l l̇.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distance {
    /// P − F.
    pub n: Pair,
    /// v_F.
    pub vf: Pair,
    /// l.
    pub l: Reg,
    /// l̇.
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

/// The same for accelerations: c = n·a_F − |v_P − v_F|² + l̇² + l l̈.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DistanceRate {
    /// P − F.
    pub n: Pair,
    /// v_P.
    pub vp: Pair,
    /// v_F.
    pub vf: Pair,
    /// a_F.
    pub af: Pair,
    /// l.
    pub l: Reg,
    /// l̇.
    pub rate: f64,
    /// l̈.
    pub acceleration: f64,
}

impl Kernel<9, 1> for DistanceRate {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 9] {
        [self.n.x, self.n.y, self.vp.x, self.vp.y, self.vf.x, self.vf.y, self.af.x, self.af.y, self.l]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [nx, ny, px, py, fx, fy, ax, ay, l]: [N; 9]) -> [N; 1] {
        let v = Vec2::new(px - fx, py - fy);
        [nx * ax + ny * ay - v.norm2() + l * self.acceleration + self.rate * self.rate]
    }
}

/// P moves at a given rate along n, a direction of a body Q that turns with ω: c = n·(v_O + ω × r) + rate, O a point
/// of Q and r the arm from it to P.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guided {
    /// Direction.
    pub n: Pair,
    /// P − O.
    pub r: Pair,
    /// v_O.
    pub vo: Pair,
    /// ω of the body.
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

/// The same for accelerations: c = n·(a_O + α × r − ω² r) + 2 ω n·(v_r turned by 90°) + acceleration, v_r = v_P − v_O − ω × r.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GuidedRate {
    /// Direction.
    pub n: Pair,
    /// P − O.
    pub r: Pair,
    /// v_P.
    pub vp: Pair,
    /// v_O.
    pub vo: Pair,
    /// a_O.
    pub ao: Pair,
    /// ω of the body.
    pub omega: Reg,
    /// α of the body.
    pub alpha: Reg,
    /// The rate of the rate.
    pub acceleration: f64,
}

impl Kernel<12, 1> for GuidedRate {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 12] {
        let s = self;
        [s.n.x, s.n.y, s.r.x, s.r.y, s.vp.x, s.vp.y, s.vo.x, s.vo.y, s.ao.x, s.ao.y, s.omega, s.alpha]
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

/// A slot of the link runs over a known point B; n is square to the slot, r = B − O. For accelerations
/// c = n·a_B − 2 ω n·(v_r turned by 90°), v_r = v_B − v_O − ω × r; for velocities c = n·v_B is a [`Distance`] at rate 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlotRate {
    /// Square to the slot.
    pub n: Pair,
    /// B − O.
    pub r: Pair,
    /// v_B.
    pub vb: Pair,
    /// a_B.
    pub ab: Pair,
    /// v_O of the link.
    pub vo: Pair,
    /// ω of the link.
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

/// The row of a link's own point, where the turning is known: c' = c − ω n·(r turned by 90°).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reduced {
    /// n.
    pub n: Pair,
    /// r.
    pub r: Pair,
    /// c.
    pub c: Reg,
    /// ω.
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

/// The same for accelerations: c' = c + ω² n·r − α n·(r turned by 90°).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReducedRate {
    /// n.
    pub n: Pair,
    /// r.
    pub r: Pair,
    /// c.
    pub c: Reg,
    /// ω.
    pub omega: Reg,
    /// α, or zero where it is still unknown.
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

/// The turning of a link whose own point moves by v: ω = (c − n·v)/(n·(r turned by 90°)). With a reduced row, α alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurnOf {
    /// n.
    pub n: Pair,
    /// r.
    pub r: Pair,
    /// c.
    pub c: Reg,
    /// v of the link's own point.
    pub v: Pair,
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

/// Two rows crossed: v with n₁·v = c₁, n₂·v = c₂.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cross {
    /// n₁.
    pub n1: Pair,
    /// c₁.
    pub c1: Reg,
    /// n₂.
    pub n2: Pair,
    /// c₂.
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

/// Three rows: v and ω of a link with n·(v + ω × r) = c for each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Three {
    /// n, r and c of the three.
    pub rows: [(Pair, Pair, Reg); 3],
}

impl Kernel<15, 3> for Three {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 15] {
        let [a, b, c] = self.rows.map(|(n, r, c)| [n.x, n.y, r.x, r.y, c]);
        [a[0], a[1], a[2], a[3], a[4], b[0], b[1], b[2], b[3], b[4], c[0], c[1], c[2], c[3], c[4]]
    }

    /// Cramer's rule on (n, τ) with τ = n·(r turned by 90°), the moment of the row about the link's own point.
    #[inline(always)]
    fn eval<N: Lane>(&self, x: [N; 15]) -> [N; 3] {
        let row = |i: usize| (Vec2::new(x[i], x[i + 1]), x[i + 1] * x[i + 2] - x[i] * x[i + 3], x[i + 4]);
        let ((na, ta, ca), (nb, tb, cb), (nc, tc, cc)) = (row(0), row(5), row(10));
        let (bc, ca_, ab) = (nb.cross(nc), nc.cross(na), na.cross(nb));
        let det = ta * bc + tb * ca_ + tc * ab;
        let omega = (ca * bc + cb * ca_ + cc * ab) / det;
        let pick = |fa: N, fb: N, fc: N| {
            // Σ c_i (f_j τ_k − f_k τ_j), f the other component of the normals.
            (ca * (fb * tc - fc * tb) + cb * (fc * ta - fa * tc) + cc * (fa * tb - fb * ta)) / det
        };
        [pick(na.y, nb.y, nc.y), -pick(na.x, nb.x, nc.x), omega]
    }
}

/// Two bars A–C, B–C: v_C, and 1/det for the accelerations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bars {
    /// C.
    pub c: Pair,
    /// A.
    pub a: Pair,
    /// B.
    pub b: Pair,
    /// v_A.
    pub va: Pair,
    /// v_B.
    pub vb: Pair,
    /// (C − A) × (C − B).
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

/// The same for accelerations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BarsRate {
    /// The velocities' operation.
    pub bars: Bars,
    /// v_C.
    pub vc: Pair,
    /// a_A.
    pub aa: Pair,
    /// a_B.
    pub ab: Pair,
    /// 1/det.
    pub inverse: Reg,
}

impl Kernel<17, 2> for BarsRate {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 17] {
        let (s, b) = (self, &self.bars);
        [
            b.c.x, b.c.y, b.a.x, b.a.y, b.b.x, b.b.y, b.va.x, b.va.y, b.vb.x, b.vb.y, s.vc.x, s.vc.y, s.aa.x, s.aa.y, s.ab.x, s.ab.y,
            s.inverse,
        ]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [cx, cy, ax, ay, bx, by, vax, vay, vbx, vby, vx, vy, aax, aay, abx, aby, inverse]: [N; 17]) -> [N; 2] {
        let (ux, uy, wx, wy) = (cx - ax, cy - ay, cx - bx, cy - by);
        let (rx, ry, sx, sy) = (vx - vax, vy - vay, vx - vbx, vy - vby);
        let p = (ux * aax + uy * aay - (rx * rx + ry * ry)) * inverse;
        let q = (wx * abx + wy * aby - (sx * sx + sy * sy)) * inverse;
        [p * wy - q * uy, q * ux - p * wx]
    }
}
