//! Burmester's pairs: pins of a body that lie on one circle in four or five positions, with the
//! centres of those circles.
//!
//! A pin W (in position 1) stays at one distance from M if, for each position j, W·a_j(M) = c_j(M),
//! with the displacement W_j = R_j W + t_j: a_j = R_jᵀ(t_j − M) + M and c_j = M·t_j − |t_j|²/2,
//! both linear in M. Three positions beyond the first are consistent where det(a_j, c_j) = 0: the
//! centre-point curve, a circular cubic. On a line it has up to three roots. The cubics of 1234 and
//! of 1235 meet in nine points: two are the circular points at infinity, three the poles P₁₂, P₁₃,
//! P₂₃ at which rows 2 and 3 are dependent, four are Burmester's (0, 2 or 4 of them real). They are
//! eliminated by Sylvester's resultant in double-double numbers, of degree 7 in one coordinate; the
//! poles are divided out, and each pair is refined by Newton's method on the four equations.
//!
//! *Source*: Burmester; O. Bottema and B. Roth, Theoretical Kinematics, ch. VIII.

use super::pose::BodyPose;
use crate::poly::Poly;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::{Dd, Real};
use nalgebra::{Matrix4, Vector4};

/// A pin of the body and the centre of its circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BurmesterPair {
    /// The place of the pin in position 1.
    pub pin: Point,
    /// The fixed pivot.
    pub centre: Point,
}

/// A displacement from position 1, in scaled coordinates.
#[derive(Clone, Copy)]
struct Move {
    r: Vec2,
    t: Vec2,
}

/// Positions in coordinates with a suitable origin and unit, so that the numbers of the elimination
/// are of one magnitude. The axes are turned by an arbitrary angle, so that no two roots have equal
/// first coordinates by symmetry.
struct ScaledPositions {
    origin: Point,
    unit: f64,
    axis: Vec2,
    moves: Vec<Move>,
}

/// A rotation of the axes that is no simple fraction of a full turn.
const ASKEW: f64 = 0.739_085_133_215_160_6;

impl ScaledPositions {
    fn of(positions: &[BodyPose]) -> Option<ScaledPositions> {
        let origin = positions.first()?.origin;
        let far = positions.iter().map(|p| p.origin.distance(origin)).fold(0.0, f64::max);
        let poles = positions[1..]
            .iter()
            .filter_map(|p| positions[0].pole(p))
            .map(|p| p.distance(origin))
            .fold(0.0, f64::max);
        let unit = if far > 0.0 { far } else { poles };
        if unit <= 0.0 {
            return None;
        }
        let mut frame =
            ScaledPositions { origin, unit, axis: Vec2::from_angle(ASKEW), moves: Vec::new() };
        let first = positions[0];
        frame.moves = positions[1..]
            .iter()
            .map(|p| Move {
                r: Vec2::from_angle(p.angle - first.angle),
                t: frame.inward(first.carry(p, origin)),
            })
            .collect();
        Some(frame)
    }

    fn inward(&self, at: Point) -> Vec2 {
        let v = (at - self.origin) * (1.0 / self.unit);
        Vec2::new(self.axis.dot(v), self.axis.cross(v))
    }

    fn outward(&self, v: Vec2) -> Point {
        self.origin + v.rotate_by(self.axis) * self.unit
    }

    /// The row (a_x, a_y, c) of a displacement, each linear in s on M = p + s q.
    fn row(&self, j: usize, p: [Dd; 2], q: [Dd; 2]) -> [Poly; 3] {
        let Move { r, t } = self.moves[j];
        let d = Dd::from_f64;
        let (rc, rs, tx, ty) = (d(r.x), d(r.y), d(t.x), d(t.y));
        let one = d(1.0);
        // Rᵀ v = (c v_x + s v_y, −s v_x + c v_y).
        let ax = |m: [Dd; 2], t: [Dd; 2]| rc * (t[0] - m[0]) + rs * (t[1] - m[1]) + m[0];
        let ay = |m: [Dd; 2], t: [Dd; 2]| -(rs * (t[0] - m[0])) + rc * (t[1] - m[1]) + m[1];
        let zero = [d(0.0), d(0.0)];
        let c0 = p[0] * tx + p[1] * ty - (tx * tx + ty * ty) * (one / d(2.0));
        let c1 = q[0] * tx + q[1] * ty;
        [
            Poly::line(ax(p, [tx, ty]), ax(q, zero)),
            Poly::line(ay(p, [tx, ty]), ay(q, zero)),
            Poly::line(c0, c1),
        ]
    }

    /// The centre-point cubic along a line M = p + s q, for position 1 and three displacements.
    fn cubic(&self, rows: [usize; 3], p: [Dd; 2], q: [Dd; 2]) -> Poly {
        let [a, b, c] = rows.map(|j| self.row(j, p, q));
        let minor = |x: &Poly, y: &Poly, z: &Poly, w: &Poly| x.times(w).plus(&y.times(z), -1.0);
        let first = a[0].times(&minor(&b[1], &b[2], &c[1], &c[2]));
        let second = a[1].times(&minor(&b[0], &b[2], &c[0], &c[2]));
        let third = a[2].times(&minor(&b[0], &b[1], &c[0], &c[1]));
        first.plus(&second, -1.0).plus(&third, 1.0)
    }

    /// The pin of a centre: least squares over the rows, by the normal equations in two unknowns.
    fn pin(&self, m: Vec2) -> Option<Vec2> {
        let (mut xx, mut xy, mut yy, mut xc, mut yc) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for Move { r, t } in &self.moves {
            let back = Vec2::new(r.x, -r.y);
            let a = (*t - m).rotate_by(back) + m;
            let c = m.dot(*t) - t.norm2() / 2.0;
            xx += a.x * a.x;
            xy += a.x * a.y;
            yy += a.y * a.y;
            xc += a.x * c;
            yc += a.y * c;
        }
        let det = xx * yy - xy * xy;
        (det > 1e-18 * (xx + yy) * (xx + yy))
            .then(|| Vec2::new((xc * yy - yc * xy) / det, (yc * xx - xc * xy) / det))
    }

    fn pair(&self, m: Vec2) -> Option<BurmesterPair> {
        let w = self.pin(m)?;
        Some(BurmesterPair { pin: self.outward(w), centre: self.outward(m) })
    }
}

/// The centre points of four positions on a line, with their pins: up to three, in the direction of
/// the line.
pub fn on_line(positions: &[BodyPose], through: Point, direction: Vec2) -> Vec<BurmesterPair> {
    let Some(frame) = ScaledPositions::of(positions) else { return Vec::new() };
    let p = frame.inward(through);
    let q = direction.rotate_by(Vec2::new(frame.axis.x, -frame.axis.y));
    let lift = |v: Vec2| [Dd::from_f64(v.x), Dd::from_f64(v.y)];
    let roots = frame.cubic([0, 1, 2], lift(p), lift(q)).real_roots();
    roots.into_iter().filter_map(|s| frame.pair(p + q * s.approx())).collect()
}

/// The determinant of a square matrix, by Gaussian elimination with pivoting.
fn determinant<const N: usize>(mut m: [[Dd; N]; N]) -> Dd {
    let mut det = Dd::from_f64(1.0);
    for k in 0..N {
        let pivot = (k..N)
            .max_by(|&a, &b| m[a][k].approx().abs().total_cmp(&m[b][k].approx().abs()))
            .unwrap_or(k);
        if m[pivot][k].approx() == 0.0 {
            return Dd::from_f64(0.0);
        }
        if pivot != k {
            m.swap(pivot, k);
            det = -det;
        }
        det = det * m[k][k];
        let row = m[k];
        for below in &mut m[k + 1..] {
            let factor = below[k] / row[k];
            for (x, r) in below.iter_mut().zip(&row).skip(k) {
                *x = *x - factor * *r;
            }
        }
    }
    det
}

/// Sylvester's resultant of two cubics.
fn resultant(f: &Poly, g: &Poly) -> Dd {
    let zero = Dd::from_f64(0.0);
    let mut m = [[zero; 6]; 6];
    for k in 0..3 {
        for i in 0..4 {
            m[k][k + i] = f.0.get(3 - i).copied().unwrap_or(zero);
            m[k + 3][k + i] = g.0.get(3 - i).copied().unwrap_or(zero);
        }
    }
    determinant(m)
}

/// All Burmester pairs of five positions.
pub fn of_five(positions: &[BodyPose]) -> Vec<BurmesterPair> {
    let Some(frame) = ScaledPositions::of(positions) else { return Vec::new() };
    let d = Dd::from_f64;
    let along_y = |x: Dd, last: usize| frame.cubic([0, 1, last], [x, d(0.0)], [d(0.0), d(1.0)]);
    // Eight values determine a polynomial of degree seven; Chebyshev points distribute them well.
    let xs: Vec<Dd> = (0..8)
        .map(|k| d(2.0 * libm::cos(std::f64::consts::PI * (2 * k + 1) as f64 / 16.0)))
        .collect();
    let ys: Vec<Dd> = xs.iter().map(|x| resultant(&along_y(*x, 2), &along_y(*x, 3))).collect();
    let mut p = Poly::through(&xs, &ys);
    let pairs = [(0, 1), (0, 2), (1, 2)];
    for pole in pairs.iter().filter_map(|&(i, j)| positions[i].pole(&positions[j])) {
        p = p.without(d(frame.inward(pole).x));
    }
    let at = |x: Dd| {
        let (f, g) = (along_y(x, 2), along_y(x, 3));
        let near = |y: &Dd| g.at(*y).approx().abs();
        let y = f.real_roots().into_iter().min_by(|a, b| near(a).total_cmp(&near(b)))?;
        let m = Vec2::new(x.approx(), y.approx());
        frame.refined(m, frame.pin(m)?)
    };
    let mut found: Vec<BurmesterPair> = Vec::new();
    for pair in p.real_roots().into_iter().filter_map(at) {
        if found.iter().all(|f| f.centre.distance(pair.centre) > 1e-9 * frame.unit) {
            found.push(pair);
        }
    }
    found
}

impl ScaledPositions {
    /// Newton's method on the four equations in pin and centre; `None` where it diverges.
    fn refined(&self, m: Vec2, w: Vec2) -> Option<BurmesterPair> {
        let mut x = Vector4::new(m.x, m.y, w.x, w.y);
        let mut size = f64::INFINITY;
        for _ in 0..30 {
            let (m, w) = (Vec2::new(x[0], x[1]), Vec2::new(x[2], x[3]));
            let mut jacobian = Matrix4::zeros();
            let mut rest = Vector4::zeros();
            for (j, Move { r, t }) in self.moves.iter().enumerate() {
                let a = (*t - m).rotate_by(Vec2::new(r.x, -r.y)) + m;
                rest[j] = w.dot(a) - m.dot(*t) + t.norm2() / 2.0;
                // d(W·a)/dM = W − R W.
                let by_m = w - w.rotate_by(*r) - *t;
                for (k, v) in [by_m.x, by_m.y, a.x, a.y].into_iter().enumerate() {
                    jacobian[(j, k)] = v;
                }
            }
            let step = jacobian.lu().solve(&rest)?;
            x -= step;
            let now = step.norm() / (1.0 + x.norm());
            let before = std::mem::replace(&mut size, now);
            if now <= 1e-15 || (now < 1e-11 && now >= before) {
                break;
            }
        }
        // A pole solves three of the equations; there the steps do not converge.
        (size < 1e-8).then(|| BurmesterPair {
            pin: self.outward(Vec2::new(x[2], x[3])),
            centre: self.outward(Vec2::new(x[0], x[1])),
        })
    }
}
