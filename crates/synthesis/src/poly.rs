//! All real roots of polynomials in one unknown.
//!
//! Between two neighbouring roots of the derivative a polynomial has at most one root, which
//! bisection cannot miss; so the roots of the derivatives are found in order of degree, from the
//! linear one upward. The outer bounds are Cauchy's. Double roots are found if rounding leaves a
//! change of sign or a value that is zero to rounding.

use hodograph_base::number::{Dd, Real};

/// A polynomial: its coefficients from the constant upward.
#[derive(Clone, Debug, PartialEq)]
pub struct Poly(pub Vec<Dd>);

impl Poly {
    /// The value at x.
    pub fn at(&self, x: Dd) -> Dd {
        self.0.iter().rev().fold(Dd::from_f64(0.0), |sum, c| sum * x + *c)
    }

    /// The polynomial c₀ + c₁x.
    pub fn line(c0: Dd, c1: Dd) -> Poly {
        Poly(vec![c0, c1])
    }

    /// The product.
    pub fn times(&self, other: &Poly) -> Poly {
        let mut out = vec![Dd::from_f64(0.0); self.0.len() + other.0.len() - 1];
        for (i, a) in self.0.iter().enumerate() {
            for (j, b) in other.0.iter().enumerate() {
                out[i + j] = out[i + j] + *a * *b;
            }
        }
        Poly(out)
    }

    /// The sum with a multiple of another polynomial.
    pub fn plus(&self, other: &Poly, factor: f64) -> Poly {
        let zero = Dd::from_f64(0.0);
        let of = |p: &Poly, i: usize| p.0.get(i).copied().unwrap_or(zero);
        let count = self.0.len().max(other.0.len());
        Poly((0..count).map(|i| of(self, i) + of(other, i) * Dd::from_f64(factor)).collect())
    }

    /// The quotient by x − root, without the remainder.
    pub fn without(&self, root: Dd) -> Poly {
        let mut out = Vec::new();
        let mut carry = Dd::from_f64(0.0);
        for c in self.0.iter().rev() {
            carry = carry * root + *c;
            out.push(carry);
        }
        out.pop();
        out.reverse();
        Poly(out)
    }

    /// The polynomial of degree `xs.len() − 1` through given values (Newton's divided differences).
    pub fn through(xs: &[Dd], ys: &[Dd]) -> Poly {
        let n = xs.len();
        let mut d = ys.to_vec();
        for k in 1..n {
            for i in (k..n).rev() {
                d[i] = (d[i] - d[i - 1]) / (xs[i] - xs[i - k]);
            }
        }
        let mut out = Poly(vec![d[n - 1]]);
        for i in (0..n - 1).rev() {
            out = out.times(&Poly::line(-xs[i], Dd::from_f64(1.0))).plus(&Poly(vec![d[i]]), 1.0);
        }
        out
    }

    /// The real roots in order. Leading coefficients that are zero relative to the others are left
    /// out: double-double numbers leave 1e-20 of a term that cancels.
    pub fn real_roots(&self) -> Vec<Dd> {
        let size = self.0.iter().map(|c| c.approx().abs()).fold(0.0, f64::max);
        let mut c = self.0.clone();
        while c.last().is_some_and(|l| l.approx().abs() <= 1e-20 * size) {
            c.pop();
        }
        if c.len() < 2 {
            return Vec::new();
        }
        let top = c[c.len() - 1];
        if c.len() == 2 {
            return vec![-c[0] / top];
        }
        let bound = 1.0 + c.iter().map(|x| (*x / top).approx().abs()).fold(0.0, f64::max);
        let slope =
            Poly(c.iter().enumerate().skip(1).map(|(k, x)| *x * Dd::from_f64(k as f64)).collect());
        let mut ends = vec![Dd::from_f64(-bound)];
        ends.extend(slope.real_roots());
        ends.push(Dd::from_f64(bound));
        let p = Poly(c);
        let mut roots: Vec<Dd> = ends.windows(2).filter_map(|w| p.bisected(w[0], w[1])).collect();
        roots.dedup_by(|a, b| (*a - *b).approx() == 0.0);
        roots
    }

    /// The root between two places with values of different signs.
    fn bisected(&self, mut low: Dd, mut high: Dd) -> Option<Dd> {
        let (a, b) = (self.at(low).approx(), self.at(high).approx());
        if a == 0.0 {
            return Some(low);
        }
        if b == 0.0 {
            return Some(high);
        }
        if a.signum() == b.signum() {
            return None;
        }
        // As many halvings of the largest bound as a double-double number has digits.
        for _ in 0..220 {
            let middle = (low + high) / Dd::from_f64(2.0);
            let at = self.at(middle).approx();
            if at == 0.0 {
                return Some(middle);
            }
            if at.signum() == a.signum() {
                low = middle
            } else {
                high = middle
            }
            if (high - low).approx() == 0.0 {
                break;
            }
        }
        Some((low + high) / Dd::from_f64(2.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_real_roots_are_found() {
        for roots in [vec![-3.0, 0.5, 2.0, 1e3], vec![1.0, 1.001, 1.002], vec![-1e-3, 1e4]] {
            let product = roots.iter().fold(Poly(vec![Dd::from_f64(2.0)]), |p, r| {
                p.times(&Poly::line(Dd::from_f64(-*r), Dd::from_f64(1.0)))
            });
            let found: Vec<f64> = product.real_roots().into_iter().map(Real::approx).collect();
            assert_eq!(found.len(), roots.len(), "{roots:?}: {found:?}");
            found
                .iter()
                .zip(&roots)
                .for_each(|(f, r)| assert!((f - r).abs() <= 1e-14 * r.abs(), "{f} {r}"));
        }
        let none = Poly([1.0, 0.0, 1.0].map(Dd::from_f64).to_vec());
        assert_eq!(none.real_roots(), []);
    }

    #[test]
    fn a_polynomial_goes_through_its_points() {
        let xs: Vec<Dd> = (0..5).map(|k| Dd::from_f64(k as f64 - 2.0)).collect();
        let cube = |x: Dd| x * x * x - x;
        let ys: Vec<Dd> = xs.iter().map(|x| cube(*x)).collect();
        let p = Poly::through(&xs, &ys);
        assert!((p.at(Dd::from_f64(3.5)) - cube(Dd::from_f64(3.5))).approx().abs() < 1e-28);
        assert!((p.without(Dd::from_f64(1.0)).at(Dd::from_f64(3.0)).approx() - 12.0).abs() < 1e-14);
    }
}
