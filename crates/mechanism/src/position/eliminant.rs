//! The eliminant of a link on three legs: a trigonometric polynomial in the link's angle that
//! vanishes at every assembly.
//!
//! Each leg is an equation q|p|² + 2g·p + h = 0 for the link's origin p, with q = 1 for a circle
//! and 0 for a line; g and h are of the first degree in cos φ and sin φ. The difference of two
//! circles is linear in p; two linear equations give p = N/D, and the third eliminates p. The
//! degree is three for three circles (six assemblies), four at most. The values at equally spaced
//! angles determine the coefficients (discrete Fourier transform), and with t = tan(φ/2) the result
//! is a polynomial with roots that are the eigenvalues of its companion matrix.
//!
//! # Source
//! The degree of three circles: coupler curves are tricircular sextics, so that a circle about a
//! fixed pivot meets one in six finite points at most (K. H. Hunt, *Kinematic Geometry of
//! Mechanisms*, §7). Roots by companion matrices: A. Edelman, H. Murakami, Math. Comp. 64 (1995).

use super::triad::TriadLeg;
use hodograph_base::geom::{Point, Vec2};
use nalgebra::{DMatrix, Schur};
use std::f64::consts::TAU;

/// The largest degree in the angle.
const DEGREE: usize = 4;
/// Number of coefficients, and of values, for that degree.
const VALUES: usize = 2 * DEGREE + 1;
/// Coefficients below this part of the largest are rounding: a polynomial of lower degree.
const ROUNDING: f64 = 1e-12;
/// Imaginary part up to which a root is tried: that of a real root is zero, that of two nearly
/// coincident roots is of the size of the square root of the rounding.
const NEARLY_REAL: f64 = 1e-3;
/// Greatest number of steps of the QR algorithm for each root; it takes two or three.
const PATIENCE: usize = 100;

/// q|p|² + 2g·p + h.
#[derive(Clone, Copy)]
struct Quadric {
    q: f64,
    g: Vec2,
    h: f64,
}

impl Quadric {
    /// Returns the equation of a leg at an angle of the link, with lengths divided by `scale`.
    fn of(leg: &TriadLeg, axis: Vec2, scale: f64) -> Quadric {
        let turned = |local: Point| local.to_vec2().rotate_by(axis);
        let line = |direction: Vec2, from: Vec2| Quadric {
            q: 0.0,
            g: direction.perp() * 0.5,
            h: direction.cross(from) / scale,
        };
        match *leg {
            TriadLeg::Circle { near, far, radius } => {
                let (g, r) = ((turned(near) - far.to_vec2()) * (1.0 / scale), radius / scale);
                Quadric { q: 1.0, g, h: g.norm2() - r * r }
            }
            TriadLeg::Line { near, through, direction } => {
                line(direction, turned(near) - through.to_vec2())
            }
            TriadLeg::Slot { through, direction, pin } => {
                line(direction.rotate_by(axis), turned(through) - pin.to_vec2())
            }
        }
    }

    fn less(self, other: Quadric) -> Quadric {
        Quadric { q: self.q - other.q, g: self.g - other.g, h: self.h - other.h }
    }
}

/// Returns the eliminant at an angle.
fn value(legs: &[TriadLeg; 3], angle: f64, scale: f64) -> f64 {
    let all = legs.each_ref().map(|leg| Quadric::of(leg, Vec2::from_angle(angle), scale));
    let base = all.iter().position(|e| e.q != 0.0).unwrap_or(2);
    let [a, b] =
        [1, 2].map(|k| all[(base + k) % 3]).map(|e| if e.q == 0.0 { e } else { e.less(all[base]) });
    let third = all[base];
    let (u, w) = (a.g * 2.0, b.g * 2.0);
    // Cramer's rule for u·p = −h_a, w·p = −h_b.
    let (n, d) = (Vec2::new(b.h * u.y - a.h * w.y, a.h * w.x - b.h * u.x), u.cross(w));
    third.q * n.norm2() + 2.0 * d * third.g.dot(n) + d * d * third.h
}

/// Returns all angles (rad) of the link at which the three legs may hold it.
pub(super) fn angles(legs: &[TriadLeg; 3], scale: f64) -> Vec<f64> {
    let step = TAU / VALUES as f64;
    let values: [f64; VALUES] = std::array::from_fn(|i| value(legs, i as f64 * step, scale));
    // The half-angle's tangent is put at infinity where the eliminant is largest.
    let largest =
        (0..VALUES).max_by(|&i, &k| values[i].abs().total_cmp(&values[k].abs())).unwrap_or(0);
    let infinite = largest as f64 * step;
    let cosines = |k: usize, part: fn(f64) -> f64| -> f64 {
        let sum: f64 = values
            .iter()
            .enumerate()
            .map(|(i, v)| v * part(k as f64 * (i as f64 * step - infinite - TAU / 2.0)))
            .sum();
        sum * if k == 0 { 1.0 } else { 2.0 } / VALUES as f64
    };
    let coefficients: Vec<(f64, f64)> =
        (0..=DEGREE).map(|k| (cosines(k, libm::cos), cosines(k, libm::sin))).collect();
    let bound = coefficients.iter().map(|(a, b)| a.abs().max(b.abs())).fold(0.0, f64::max);
    let degree = (0..=DEGREE)
        .rev()
        .find(|k| coefficients[*k].0.abs().max(coefficients[*k].1.abs()) > ROUNDING * bound)
        .unwrap_or(0);
    let turn = |t: f64| infinite + TAU / 2.0 + 2.0 * libm::atan(t);
    let mut found: Vec<f64> = real_roots(&in_half_tangents(&coefficients[..=degree]))
        .into_iter()
        .map(turn)
        .map(|a| a.rem_euclid(TAU))
        .collect();
    found.sort_by(f64::total_cmp);
    found
}

/// Returns Σ a_k cos kφ + b_k sin kφ times (1 + t²)ⁿ, as coefficients of 1, t, t², ...
///
/// With w = (1 + it)², of angle φ: cos kφ + i sin kφ = wᵏ/(1 + t²)ᵏ.
fn in_half_tangents(series: &[(f64, f64)]) -> Vec<f64> {
    let times = |a: &[f64], b: &[f64]| {
        let mut out = vec![0.0; a.len() + b.len() - 1];
        for (i, x) in a.iter().enumerate() {
            b.iter().enumerate().for_each(|(k, y)| out[i + k] += x * y);
        }
        out
    };
    let n = series.len() - 1;
    let mut sum = vec![0.0; 2 * n + 1];
    let (mut re, mut im) = (vec![1.0], vec![0.0]);
    for (k, (a, b)) in series.iter().enumerate() {
        let rest = (k..n).fold(vec![1.0], |p, _| times(&p, &[1.0, 0.0, 1.0]));
        for (part, factor) in [(&re, a), (&im, b)] {
            times(part, &rest).iter().zip(&mut sum).for_each(|(x, s)| *s += x * factor);
        }
        // Times 1 − t² + 2it.
        let (square, twice) = ([1.0, 0.0, -1.0], [0.0, 2.0]);
        let minus = |a: Vec<f64>, b: Vec<f64>| {
            (0..a.len().max(b.len())).map(|i| at(&a, i) - at(&b, i)).collect::<Vec<f64>>()
        };
        let plus = |a: Vec<f64>, b: Vec<f64>| {
            (0..a.len().max(b.len())).map(|i| at(&a, i) + at(&b, i)).collect::<Vec<f64>>()
        };
        (re, im) = (
            minus(times(&re, &square), times(&im, &twice)),
            plus(times(&re, &twice), times(&im, &square)),
        );
    }
    sum
}

fn at(p: &[f64], i: usize) -> f64 {
    p.get(i).copied().unwrap_or(0.0)
}

/// Returns the roots of a polynomial that are real, or nearly real.
fn real_roots(coefficients: &[f64]) -> Vec<f64> {
    let n = coefficients.len() - 1;
    let leading = coefficients[n];
    if n == 0 || !coefficients.iter().all(|c| (c / leading).is_finite()) {
        return Vec::new();
    }
    let companion = DMatrix::from_fn(n, n, |row, column| match column + 1 == n {
        true => -coefficients[row] / leading,
        false => f64::from(u8::from(row == column + 1)),
    });
    let Some(schur) = Schur::try_new(companion, f64::EPSILON, PATIENCE * n) else {
        return Vec::new();
    };
    let real = |z: &nalgebra::Complex<f64>| z.im.abs() <= NEARLY_REAL * (1.0 + z.re * z.re);
    schur.complex_eigenvalues().iter().filter(|z| real(z)).map(|z| z.re).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_tangents_are_the_series() {
        let series = [(0.3, 0.0), (-1.2, 0.7), (0.4, 0.1), (0.05, -0.6)];
        let polynomial = in_half_tangents(&series);
        for k in 0..20 {
            let angle = -3.0 + 0.3 * f64::from(k);
            let t = (angle / 2.0).tan();
            let direct: f64 = series
                .iter()
                .enumerate()
                .map(|(k, (a, b))| a * (k as f64 * angle).cos() + b * (k as f64 * angle).sin())
                .sum();
            let through: f64 =
                polynomial.iter().rev().fold(0.0, |sum, c| sum * t + c) / (1.0 + t * t).powi(3);
            assert!((direct - through).abs() < 1e-12, "{angle}: {direct}, {through}");
        }
    }

    /// For three circles the fourth coefficient vanishes: six assemblies at most.
    #[test]
    fn three_circles_are_of_the_third_degree() {
        let circle = |x: f64, y: f64, fx: f64, fy: f64, radius: f64| TriadLeg::Circle {
            near: Point::new(x, y),
            far: Point::new(fx, fy),
            radius,
        };
        let legs = [
            circle(0.0, 0.0, -1.0, 0.3, 1.4),
            circle(1.1, 0.1, 2.0, 0.0, 1.3),
            circle(0.4, 0.9, 0.6, 2.1, 1.2),
        ];
        let fourth: f64 = (0..9)
            .map(|i| f64::from(i) * TAU / 9.0)
            .map(|a| value(&legs, a, 1.0) * (4.0 * a).cos())
            .sum();
        assert!(fourth.abs() < 1e-10, "{fourth}");
        assert!(angles(&legs, 1.0).len() <= 6);
    }
}
