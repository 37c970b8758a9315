//! Reference for the sweeps: a hand-written loop for each mechanism, with everything fused and in
//! registers, the lengths of the links as constants, and without the sweep's guards for positions
//! that cannot be assembled.
//!
//! The loops fill the same columns as the sweep, velocities and accelerations with their
//! magnitudes, and are checked against its numbers before anything is timed.

use fearless_simd::{Level, Simd, SimdBase, SimdFloat, f64x4};
use hodograph::sweep::CHUNK;

/// A vector of four positions.
type Vector<S> = (f64x4<S>, f64x4<S>);

/// A point: place, velocity, acceleration.
#[derive(Clone, Copy)]
struct Motion<S: Simd> {
    p: Vector<S>,
    v: Vector<S>,
    a: Vector<S>,
}

#[inline(always)]
fn dot<S: Simd>(a: Vector<S>, b: Vector<S>) -> f64x4<S> {
    a.0 * b.0 + a.1 * b.1
}

#[inline(always)]
fn minus<S: Simd>(a: Vector<S>, b: Vector<S>) -> Vector<S> {
    (a.0 - b.0, a.1 - b.1)
}

/// Returns x with u·x = p and w·x = q.
#[inline(always)]
fn cross<S: Simd>(u: Vector<S>, w: Vector<S>, p: f64x4<S>, q: f64x4<S>) -> Vector<S> {
    (p * w.1 - q * u.1, q * u.0 - p * w.0)
}

/// Returns k d.
#[inline(always)]
fn turned<S: Simd>(d: Vector<S>, k: [f64; 2]) -> Vector<S> {
    (d.0 * k[0] - d.1 * k[1], d.0 * k[1] + d.1 * k[0])
}

/// Returns o + k (n − o).
#[inline(always)]
fn carried<S: Simd>(o: Vector<S>, n: Vector<S>, k: [f64; 2]) -> Vector<S> {
    let d = turned(minus(n, o), k);
    (o.0 + d.0, o.1 + d.1)
}

/// The end of a crank with its pivot in the origin.
#[inline(always)]
fn crank<S: Simd>(c: f64x4<S>, s: f64x4<S>, l: f64, w: f64) -> Motion<S> {
    let p = (c * l, s * l);
    Motion { p, v: (p.1 * -w, p.0 * w), a: (p.0 * (-w * w), p.1 * (-w * w)) }
}

/// The pin of two bars, on the side of `sign`, and 1/det.
#[inline(always)]
fn close<S: Simd>(a: Vector<S>, b: Vector<S>, r: f64, s: f64, sign: f64) -> (Vector<S>, f64x4<S>) {
    let simd = a.0.simd;
    let d = minus(b, a);
    let d2 = dot(d, d);
    let m = (-d2 + (r + s) * (r + s)) * (d2 - (r - s) * (r - s));
    let root = m.max(f64x4::splat(simd, 0.0)).sqrt() * sign;
    let half = f64x4::splat(simd, 0.5) / d2;
    let (f, h) = ((d2 + (r - s) * (r + s)) * half, root * half);
    ((a.0 + d.0 * f - d.1 * h, a.1 + d.1 * f + d.0 * h), f64x4::splat(simd, 2.0) / root)
}

/// Two bars, both on moving points.
#[inline(always)]
fn dyad<S: Simd>(a: Motion<S>, b: Motion<S>, r: f64, s: f64, sign: f64) -> Motion<S> {
    let (c, inverse) = close(a.p, b.p, r, s, sign);
    let (u, w) = (minus(c, a.p), minus(c, b.p));
    let v = cross(u, w, dot(u, a.v) * inverse, dot(w, b.v) * inverse);
    let (x, y) = (minus(v, a.v), minus(v, b.v));
    Motion {
        p: c,
        v,
        a: cross(u, w, (dot(u, a.a) - dot(x, x)) * inverse, (dot(w, b.a) - dot(y, y)) * inverse),
    }
}

/// Two bars, the second on ground.
#[inline(always)]
fn rocker<S: Simd>(a: Motion<S>, b: [f64; 2], r: f64, s: f64, sign: f64) -> Motion<S> {
    let b = (f64x4::splat(a.p.0.simd, b[0]), f64x4::splat(a.p.0.simd, b[1]));
    let (c, inverse) = close(a.p, b, r, s, sign);
    let (u, w) = (minus(c, a.p), minus(c, b));
    let p = dot(u, a.v) * inverse;
    let v = (p * w.1, -(p * w.0));
    let x = minus(v, a.v);
    let (p, q) = ((dot(u, a.a) - dot(x, x)) * inverse, -(dot(v, v) * inverse));
    Motion { p: c, v, a: cross(u, w, p, q) }
}

/// A third point of a link: the image of two others.
#[inline(always)]
fn image<S: Simd>(o: Motion<S>, n: Motion<S>, k: [f64; 2]) -> Motion<S> {
    Motion { p: carried(o.p, n.p, k), v: carried(o.v, n.v, k), a: carried(o.a, n.a, k) }
}

/// The image of a point whose first base point is on ground.
#[inline(always)]
fn image_on<S: Simd>(o: [f64; 2], n: Motion<S>, k: [f64; 2]) -> Motion<S> {
    let p = turned((n.p.0 - o[0], n.p.1 - o[1]), k);
    Motion { p: (p.0 + o[0], p.1 + o[1]), v: turned(n.v, k), a: turned(n.a, k) }
}

/// The factor k for the third point of a triangle with the sides o–n, o–p, n–p, to the left of o–n.
fn third(on: f64, op: f64, np: f64) -> [f64; 2] {
    let x = (on * on + op * op - np * np) / (2.0 * on * on);
    [x, ((op / on).powi(2) - x * x).sqrt()]
}

/// A loop and its columns.
pub struct ByHand {
    cos: Column,
    sin: Column,
    /// v.x, v.y, |v| of each requested point, then a.x, a.y, |a|.
    pub out: Vec<Column>,
    mechanism: Mechanism,
}

/// A column with the alignment of the sweep's columns.
#[derive(Clone)]
#[repr(align(64))]
pub struct Column(pub [f64; CHUNK]);

/// The mechanism of a loop.
#[derive(Clone, Copy)]
pub enum Mechanism {
    /// The template `crank-rocker`; point C.
    FourBar,
    /// The template `jansen-leg`; points C, D, E, F, G.
    Leg { third_e: [f64; 2], third_g: [f64; 2] },
}

impl Mechanism {
    /// The walking leg.
    pub fn leg() -> Mechanism {
        Mechanism::Leg {
            third_e: third(0.0415, 0.0401, 0.0558),
            third_g: third(0.0367, 0.049, 0.0657),
        }
    }
}

impl ByHand {
    pub fn new(mechanism: Mechanism, cos: &[f64], sin: &[f64]) -> ByHand {
        let points = if matches!(mechanism, Mechanism::FourBar) { 1 } else { 5 };
        let chunk = |x: &[f64]| Column(x.try_into().expect("a chunk"));
        ByHand {
            cos: chunk(cos),
            sin: chunk(sin),
            out: vec![Column([0.0; CHUNK]); 6 * points],
            mechanism,
        }
    }

    #[inline(always)]
    fn run<S: Simd, const POINTS: usize>(
        &mut self,
        simd: S,
        at: impl Fn(f64x4<S>, f64x4<S>) -> [Motion<S>; POINTS],
    ) {
        let (velocities, accelerations) = self.out.split_at_mut(3 * POINTS);
        for i in (0..CHUNK).step_by(4) {
            let c = f64x4::from_slice(simd, &self.cos.0[i..i + 4]);
            let s = f64x4::from_slice(simd, &self.sin.0[i..i + 4]);
            let points = at(c, s);
            for k in 0..POINTS {
                let (v, a) = (points[k].v, points[k].a);
                v.0.store_slice(&mut velocities[3 * k].0[i..i + 4]);
                v.1.store_slice(&mut velocities[3 * k + 1].0[i..i + 4]);
                dot(v, v).sqrt().store_slice(&mut velocities[3 * k + 2].0[i..i + 4]);
                a.0.store_slice(&mut accelerations[3 * k].0[i..i + 4]);
                a.1.store_slice(&mut accelerations[3 * k + 1].0[i..i + 4]);
                dot(a, a).sqrt().store_slice(&mut accelerations[3 * k + 2].0[i..i + 4]);
            }
        }
    }

    #[inline(always)]
    fn run_mechanism<S: Simd>(&mut self, simd: S) {
        match self.mechanism {
            Mechanism::FourBar => self.run(
                simd,
                #[inline(always)]
                |c, s| [rocker(crank(c, s, 0.1, 10.0), [0.3, 0.0], 0.25, 0.2, 1.0)],
            ),
            Mechanism::Leg { third_e, third_g } => self.run(
                simd,
                #[inline(always)]
                |c, s| {
                    let b = [-0.038, -0.0078];
                    let a = crank(c, s, 0.015, 4.0);
                    let pin_c = rocker(a, b, 0.05, 0.0415, -1.0);
                    let d = rocker(a, b, 0.0619, 0.0393, 1.0);
                    let e = image_on(b, pin_c, third_e);
                    let f = dyad(e, d, 0.0394, 0.0367, -1.0);
                    [pin_c, d, e, f, image(d, f, third_g)]
                },
            ),
        }
    }

    /// Computes one chunk, four lanes wide.
    pub fn call(&mut self) {
        match Level::new().as_avx2() {
            Some(simd) => simd.vectorize(
                #[inline(always)]
                || self.run_mechanism(simd),
            ),
            None => self
                .run_mechanism(Level::baseline().as_sse2().expect("the loops by hand are for x86")),
        }
    }
}
