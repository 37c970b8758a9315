//! The crank-rockers of a time ratio and a swing, with β = ∠C₁C₂A as the free parameter; it makes
//! the least transmission angle greatest, or equal to a given one.

use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::{Dd, Real};
use std::f64::consts::PI;

/// The linkages of given θ and swing, with a rocker of length 1 and the parameter β = ∠C₁C₂A.
pub(super) struct Family {
    theta: Dd,
    swing: Dd,
}

/// The greatest K of a swing for which some linkage keeps the cosine of its transmission angle
/// below a bound, by bisection of θ.
pub(super) fn most_k(swing: f64, bound: f64) -> f64 {
    let (mut low, mut high) = (0.0, PI);
    for _ in 0..30 {
        let theta = (low + high) / 2.0;
        let found = Family::of(theta, swing).scanned(120).is_some_and(|(worst, ..)| worst <= bound);
        if found { low = theta } else { high = theta }
    }
    // Printed with four digits: rounded down, it still works.
    let k = (PI + low) / (PI - low);
    (k * 1e3).floor() / 1e3
}

impl Family {
    pub(super) fn of(theta: f64, swing: f64) -> Family {
        Family { theta: Dd::from_f64(theta), swing: Dd::from_f64(swing) }
    }

    /// The linkages with this cosine of the least transmission angle, by bisection between
    /// neighbours on either side of it: β, and whether A is on the side of D.
    pub(super) fn at(&self, cosine: f64, steps: usize) -> Vec<(f64, bool)> {
        let to = PI - self.theta.approx();
        let mut found = Vec::new();
        for side in [true, false] {
            let off = |beta: f64| Some(self.worst(Dd::from_f64(beta), side)?.approx() - cosine);
            let place = |i: usize| to * (i as f64 + 0.5) / steps as f64;
            for i in 1..steps {
                let (mut low, mut high) = (place(i - 1), place(i));
                let (Some(p), Some(q)) = (off(low), off(high)) else { continue };
                if (p > 0.0) == (q > 0.0) {
                    continue;
                }
                for _ in 0..80 {
                    let middle = (low + high) / 2.0;
                    if off(middle).is_some_and(|m| (m > 0.0) == (p > 0.0)) {
                        low = middle
                    } else {
                        high = middle
                    }
                }
                found.push(((low + high) / 2.0, side));
            }
        }
        found
    }

    /// The best of equally spaced linkages: the cosine of its least transmission angle, β, and
    /// whether A is on the side of D.
    pub(super) fn scanned(&self, steps: usize) -> Option<(f64, f64, bool)> {
        let to = PI - self.theta.approx();
        let sides = [true, false]
            .into_iter()
            .flat_map(|side| (0..steps).map(move |i| (to * (i as f64 + 0.5) / steps as f64, side)));
        let all = sides.filter_map(|(beta, side)| {
            Some((self.worst(Dd::from_f64(beta), side)?.approx(), beta, side))
        });
        all.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// True if C₁ and C₂ are on one side of AD; otherwise no motion joins them.
    fn joined(&self, beta: f64, toward_d: bool) -> bool {
        let (a, half) = (self.place(beta, toward_d, 1.0).to_vec2(), self.swing.approx() / 2.0);
        let c = [-1.0, 1.0].map(|s| a.cross(Vec2::new(s * libm::sin(half), libm::cos(half))));
        c[0] * c[1] > 0.0
    }

    /// The lengths a, b, d of a linkage.
    fn lengths(&self, beta: Dd, toward_d: bool) -> Option<[Dd; 3]> {
        let two = Dd::from_f64(2.0);
        let half = self.swing / two;
        let (sin_half, cos_half) = half.sin_cos();
        let chord = two * sin_half;
        let (sin_theta, _) = self.theta.sin_cos();
        let (sin_beta, cos_beta) = beta.sin_cos();
        let (sin_sum, _) = (beta + self.theta).sin_cos();
        let ac1 = chord * sin_beta / sin_theta;
        let ac2 = chord * sin_sum / sin_theta;
        let a = ((ac2 - ac1) / two).magnitude();
        let b = (ac1 + ac2) / two;
        // A in axes with C₂ at the origin and C₁ along x; D is below or above the midpoint of the
        // chord.
        let (x, y) = (ac2 * cos_beta - chord / two, ac2 * sin_beta);
        let down = if toward_d { y - cos_half } else { y + cos_half };
        let d = (x * x + down * down).sqrt();
        let crank = a.approx() < b.approx().min(1.0).min(d.approx())
            && a.approx() > 1e-6
            && self.joined(beta.approx(), toward_d);
        let longest = b.approx().max(1.0).max(d.approx());
        let rest = a.approx() + b.approx() + 1.0 + d.approx();
        (crank && 2.0 * (a.approx() + longest) < rest).then_some([a, b, d])
    }

    /// The cosine of the least transmission angle.
    fn worst(&self, beta: Dd, toward_d: bool) -> Option<Dd> {
        let [a, b, d] = self.lengths(beta, toward_d)?;
        let (one, two) = (Dd::from_f64(1.0), Dd::from_f64(2.0));
        let cosine = |e: Dd| (b * b + one - e * e) / (two * b);
        let (near, far) = (cosine(d - a).magnitude(), cosine(d + a).magnitude());
        Some(if near.approx() > far.approx() { near } else { far })
    }

    /// Golden-section search for the minimum of [`Family::worst`]: in double-double numbers its
    /// flat minimum is accurate to 1e-15.
    pub(super) fn golden(&self, low: f64, high: f64, toward_d: bool) -> Dd {
        let ratio = Dd::from_f64((5.0f64.sqrt() - 1.0) / 2.0);
        let (mut low, mut high) = (Dd::from_f64(low), Dd::from_f64(high));
        let value = |x: Dd| self.worst(x, toward_d);
        for _ in 0..90 {
            let (p, q) = (high - ratio * (high - low), low + ratio * (high - low));
            let lower = match (value(p), value(q)) {
                (Some(p), Some(q)) => (p - q).approx() < 0.0,
                (p, _) => p.is_some(),
            };
            if lower { high = q } else { low = p }
        }
        (low + high) / Dd::from_f64(2.0)
    }

    /// The place of A with D at the origin and the chord across the upward axis, for a rocker
    /// length.
    pub(super) fn place(&self, beta: f64, toward_d: bool, rocker: f64) -> Point {
        let (theta, half) = (self.theta.approx(), self.swing.approx() / 2.0);
        let chord = 2.0 * libm::sin(half);
        let ac2 = chord * libm::sin(beta + theta) / libm::sin(theta);
        // C₂ is the right end of the chord, C₁ the left.
        let c2 = Vec2::new(libm::sin(half), libm::cos(half));
        let y = ac2 * libm::sin(beta) * if toward_d { -1.0 } else { 1.0 };
        ((c2 + Vec2::new(-ac2 * libm::cos(beta), y)) * rocker).to_point()
    }
}
