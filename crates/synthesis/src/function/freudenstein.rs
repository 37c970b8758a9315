//! Freudenstein's equation K₁ cos ψ − K₂ cos θ + K₃ = cos(θ − ψ) with K₁ = d/a, K₂ = d/c, K₃ = (a²
//! − b² + c² + d²)/2ac.
//!
//! The equation is linear in K: three pairs of angles determine K, more do so by least squares.
//! Unknown starting angles are solved for together with K by Newton's method from a grid of starts,
//! so that all real roots are found; α₀ + 180° with −a is the same linkage, so only half turns are
//! scanned. Deviations of the output angle are differentiated implicitly, for Gauss–Newton on the
//! angles and for the Remez exchange.

use nalgebra::{DMatrix, DVector, SVector};
use std::f64::consts::PI;

/// Pairs of input and output angle, counted from the starting angles (rad).
pub type Steps = Vec<[f64; 2]>;

/// A function generator: starting angles and K.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Generator {
    /// Starting angles of input and output (rad).
    pub start: [f64; 2],
    /// K₁, K₂, K₃.
    pub k: [f64; 3],
}

impl Generator {
    /// The lengths a, b, c for a frame of 1; a and c may be negative, for arms reversed by 180°.
    /// `None` where b is not real.
    pub fn lengths(&self) -> Option<[f64; 3]> {
        let [k1, k2, k3] = self.k;
        let (a, c) = (1.0 / k1, 1.0 / k2);
        let b2 = a * a + c * c + 1.0 - 2.0 * a * c * k3;
        (b2 > 0.0 && a.is_finite() && c.is_finite()).then(|| [a, b2.sqrt(), c])
    }

    /// The residual of the equation at a pair.
    pub fn rest(&self, step: [f64; 2]) -> f64 {
        let [t, p] = [self.start[0] + step[0], self.start[1] + step[1]];
        self.k[0] * libm::cos(p) - self.k[1] * libm::cos(t) + self.k[2] - libm::cos(t - p)
    }

    /// The actual output angle for an input angle, on the branch nearest to a wanted angle; `None`
    /// where the linkage does not close.
    pub fn output(&self, step: f64, near: f64) -> Option<f64> {
        let t = self.start[0] + step;
        let (x, y) = (self.k[0] - libm::cos(t), -libm::sin(t));
        let cosine = (self.k[1] * libm::cos(t) - self.k[2]) / (x * x + y * y).sqrt();
        if cosine.is_nan() || cosine.abs() > 1.0 {
            return None;
        }
        let (middle, half) = (libm::atan2(y, x), libm::acos(cosine));
        let nearest = |a: f64| a + 2.0 * PI * libm::rint((near - a) / (2.0 * PI));
        let both = [middle + half, middle - half].map(nearest);
        both.into_iter().min_by(|a, b| (a - near).abs().total_cmp(&(b - near).abs()))
    }

    /// The deviation at a pair: actual minus wanted output angle (rad).
    pub fn deviation(&self, step: [f64; 2]) -> Option<f64> {
        let wanted = self.start[1] + step[1];
        Some(self.output(step[0], wanted)? - wanted)
    }

    /// The deviation and its derivatives with respect to K₁, K₂, K₃, α₀, φ₀.
    fn slopes(&self, step: [f64; 2]) -> Option<(f64, [f64; 5])> {
        let t = self.start[0] + step[0];
        let p = self.output(step[0], self.start[1] + step[1])?;
        let by_output = -self.k[0] * libm::sin(p) - libm::sin(t - p);
        let by_input = self.k[1] * libm::sin(t) + libm::sin(t - p);
        let of = |d: f64| -d / by_output;
        Some((
            self.deviation(step)?,
            [of(libm::cos(p)), of(-libm::cos(t)), of(1.0), of(by_input), -1.0],
        ))
    }

    fn moved(&self, free: &[usize], by: &[f64]) -> Generator {
        let mut out = *self;
        for (place, d) in free.iter().zip(by) {
            if *place < 3 { out.k[*place] += d } else { out.start[*place - 3] += d }
        }
        out
    }

    /// The linkage with both arms positive: a negative arm is reversed by 180°. Starting angles are
    /// reduced to one turn.
    pub fn upright(mut self) -> Generator {
        for i in 0..2 {
            if self.k[i] < 0.0 {
                self.k[i] = -self.k[i];
                self.k[2] = -self.k[2];
                self.start[i] += PI;
            }
            self.start[i] = libm::atan2(libm::sin(self.start[i]), libm::cos(self.start[i]));
        }
        self
    }
}

/// K by linear least squares (exact for three pairs), for given starting angles.
pub fn linear(start: [f64; 2], steps: &Steps) -> Option<Generator> {
    let row = |s: &[f64; 2]| [start[0] + s[0], start[1] + s[1]];
    let m = DMatrix::from_fn(steps.len(), 3, |i, j| {
        let [t, p] = row(&steps[i]);
        [libm::cos(p), -libm::cos(t), 1.0][j]
    });
    let rhs = DVector::from_fn(steps.len(), |i, _| {
        let [t, p] = row(&steps[i]);
        libm::cos(t - p)
    });
    let qr = m.qr();
    let k = qr.r().solve_upper_triangular(&(qr.q().transpose() * rhs))?;
    let g = Generator { start, k: [k[0], k[1], k[2]] };
    g.k.iter().all(|k| k.is_finite() && k.abs() < 1e6).then_some(g)
}

/// Number of starts in a half turn.
const GRID: usize = 24;

/// All linkages through as many pairs as there are unknowns: three, and one more for each free
/// starting angle.
pub fn exact(start: [Option<f64>; 2], steps: &Steps) -> Vec<Generator> {
    let free: Vec<usize> = [3, 4].into_iter().filter(|p| start[p - 3].is_none()).collect();
    let grid = |given: Option<f64>| match given {
        Some(angle) => vec![angle],
        None => (0..GRID).map(|k| PI * (k as f64 + 0.37) / GRID as f64).collect(),
    };
    let mut found: Vec<Generator> = Vec::new();
    for alpha in grid(start[0]) {
        for phi in grid(start[1]) {
            let Some(g) = linear([alpha, phi], steps) else { continue };
            let Some(g) = newton(g, &free, steps) else { continue };
            // With given starting angles a negative arm is kept: its sign is reported.
            let upright = if free.is_empty() { g } else { g.upright() };
            let same = |f: &Generator| {
                (0..2).all(|i| libm::sin((f.start[i] - upright.start[i]) / 2.0).abs() < 1e-7)
            };
            if !found.iter().any(same) {
                found.push(upright);
            }
        }
    }
    found.sort_by(|a, b| a.start[0].total_cmp(&b.start[0]));
    found
}

/// Newton's method on the equations of all pairs.
fn newton(mut g: Generator, free: &[usize], steps: &Steps) -> Option<Generator> {
    if free.is_empty() {
        return Some(g);
    }
    let places: Vec<usize> = [0, 1, 2].iter().chain(free).copied().collect();
    let n = steps.len();
    let mut last = f64::INFINITY;
    for _ in 0..40 {
        let m = DMatrix::from_fn(n, n, |i, j| {
            let [t, p] = [g.start[0] + steps[i][0], g.start[1] + steps[i][1]];
            match places[j] {
                0 => libm::cos(p),
                1 => -libm::cos(t),
                2 => 1.0,
                3 => g.k[1] * libm::sin(t) + libm::sin(t - p),
                _ => -g.k[0] * libm::sin(p) - libm::sin(t - p),
            }
        });
        let rest = DVector::from_fn(n, |i, _| -g.rest(steps[i]));
        let step = m.lu().solve(&rest)?;
        // Long steps from a distant start are shortened: the angles' linearisation is meaningful
        // within a radian.
        let cut = (0.5 / step.rows(3, n - 3).amax().max(0.5)).min(1.0);
        g = g.moved(&places, (step.clone() * cut).as_slice());
        let now = step.amax();
        if !now.is_finite() || g.k.iter().any(|k| k.abs() > 1e4) {
            return None;
        }
        if now < 1e-15 || (now < 1e-11 && now >= last) {
            break;
        }
        last = now;
    }
    let left = steps.iter().map(|s| g.rest(*s).abs()).fold(0.0, f64::max);
    (left < 1e-12 * (1.0 + g.k.iter().map(|k| k.abs()).fold(0.0, f64::max))).then_some(g)
}

/// Gauss–Newton on the deviations of the output angle, from an initial guess.
pub fn least_squares(mut g: Generator, free_start: [bool; 2], steps: &Steps) -> Option<Generator> {
    let places: Vec<usize> = (0..5).filter(|p| *p < 3 || free_start[p - 3]).collect();
    let sum = |g: &Generator| {
        steps.iter().map(|s| Some(g.deviation(*s)?.powi_two())).sum::<Option<f64>>()
    };
    let mut best = sum(&g)?;
    for _ in 0..100 {
        let rows: Option<Vec<(f64, [f64; 5])>> = steps.iter().map(|s| g.slopes(*s)).collect();
        let rows = rows?;
        let m = DMatrix::from_fn(rows.len(), places.len(), |i, j| rows[i].1[places[j]]);
        let rest = DVector::from_fn(rows.len(), |i, _| -rows[i].0);
        let step = m.svd(true, true).solve(&rest, 1e-14).ok()?;
        let mut cut = 1.0;
        let next = loop {
            let next = g.moved(&places, (step.clone() * cut).as_slice());
            match sum(&next) {
                Some(s) if s <= best => break Some((next, s)),
                _ if cut < 1e-6 => break None,
                _ => cut /= 2.0,
            }
        };
        let Some((next, s)) = next else { break };
        let done = step.amax() * cut < 1e-14;
        (g, best) = (next, s);
        if done {
            break;
        }
    }
    Some(g)
}

/// Squares by multiplication.
trait Squared {
    fn powi_two(self) -> f64;
}

impl Squared for f64 {
    fn powi_two(self) -> f64 {
        self * self
    }
}

/// The Remez exchange: all five parameters, six equal deviations of alternating sign. `step_of`
/// gives the pair at a place of the range. Returns the linkage, the level, and the six places.
pub fn minimax(
    first: Generator,
    range: [f64; 2],
    step_of: &dyn Fn(f64) -> Option<[f64; 2]>,
) -> Option<(Generator, f64, Vec<f64>)> {
    let mut g = first;
    let mut places = extremes(&g, range, step_of);
    let mut last = f64::INFINITY;
    for _ in 0..40 {
        if places.len() != 6 {
            return None;
        }
        let first_sign = g.deviation(step_of(places[0])?)?.signum();
        let mut level = 0.0;
        // Newton's method for these six places.
        for _ in 0..30 {
            let mut m = nalgebra::SMatrix::<f64, 6, 6>::zeros();
            let mut rest = SVector::<f64, 6>::zeros();
            for (i, x) in places.iter().enumerate() {
                let (deviation, slopes) = g.slopes(step_of(*x)?)?;
                let sign = if i % 2 == 0 { first_sign } else { -first_sign };
                rest[i] = sign * level - deviation;
                for (j, s) in slopes.iter().enumerate() {
                    m[(i, j)] = *s;
                }
                m[(i, 5)] = -sign;
            }
            let step = m.lu().solve(&rest)?;
            g = g.moved(&[0, 1, 2, 3, 4], &step.as_slice()[..5]);
            level += step[5];
            if step.amax() < 1e-14 {
                break;
            }
        }
        let next = extremes(&g, range, step_of);
        let worst =
            next.iter().filter_map(|x| g.deviation(step_of(*x)?)).map(f64::abs).fold(0.0, f64::max);
        places = next;
        let gap = worst / level.abs() - 1.0;
        if gap < 1e-13 || (gap < 1e-9 && gap >= last) {
            return Some((g, level.abs(), places));
        }
        last = gap;
    }
    None
}

/// The places of the extreme deviations over a range, including its ends: sampled, then refined by
/// Newton's method on central differences.
pub fn extremes(
    g: &Generator,
    [from, to]: [f64; 2],
    step_of: &dyn Fn(f64) -> Option<[f64; 2]>,
) -> Vec<f64> {
    const SAMPLES: usize = 720;
    let at = |x: f64| step_of(x).and_then(|s| g.deviation(s));
    let place = |i: usize| from + (to - from) * i as f64 / SAMPLES as f64;
    let values: Vec<Option<f64>> = (0..=SAMPLES).map(|i| at(place(i))).collect();
    let mut found = vec![from];
    for i in 1..SAMPLES {
        if let (Some(a), Some(b), Some(c)) = (values[i - 1], values[i], values[i + 1])
            && (b - a) * (c - b) < 0.0
        {
            found.push(turning(&at, place(i), (to - from) / SAMPLES as f64));
        }
    }
    found.push(to);
    found
}

/// The place of an extreme next to a sample: the slope by Richardson's central differences, its
/// zero by the secant method.
fn turning(at: &dyn Fn(f64) -> Option<f64>, near: f64, step: f64) -> f64 {
    let h = step * 0.5;
    let slope = |x: f64| {
        let d = |h: f64| Some((at(x + h)? - at(x - h)?) / (2.0 * h));
        let (a, b, c) = (d(h)?, d(h / 2.0)?, d(h / 4.0)?);
        let (ab, bc) = ((4.0 * b - a) / 3.0, (4.0 * c - b) / 3.0);
        Some((16.0 * bc - ab) / 15.0)
    };
    let (mut low, mut high) = (near - step * 0.49, near + step * 0.49);
    let (Some(mut p), Some(mut q)) = (slope(low), slope(high)) else { return near };
    for _ in 0..60 {
        if p == q {
            break;
        }
        let next = high - q * (high - low) / (q - p);
        let Some(there) = slope(next).filter(|_| (next - near).abs() < 2.0 * step) else { break };
        (low, p, high, q) = (high, q, next, there);
        if (high - low).abs() < 1e-15 * near.abs().max(step) {
            break;
        }
    }
    high
}
