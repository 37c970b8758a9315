//! Truncated power series in time: the number type in which a position equation gives its
//! derivatives of any order.

/// The series c₀ + c₁ t + c₂ t² + … up to its order; the n-th derivative is n! c_n.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct TaylorJet(Vec<f64>);

impl TaylorJet {
    /// Returns the constant `c` as a series up to t^`order`.
    pub fn constant(c: f64, order: usize) -> TaylorJet {
        let mut all = vec![0.0; order + 1];
        all[0] = c;
        TaylorJet(all)
    }

    /// Returns c₁ t + c₂ t² + …; missing terms are zero.
    pub fn from_rest(terms: impl Iterator<Item = f64>, order: usize) -> TaylorJet {
        let mut jet = TaylorJet::constant(0.0, order);
        for (c, term) in jet.0.iter_mut().skip(1).zip(terms) {
            *c = term;
        }
        jet
    }

    /// Returns the coefficient of t^n.
    pub fn term(&self, n: usize) -> f64 {
        self.0[n]
    }

    pub fn plus(&self, other: &TaylorJet) -> TaylorJet {
        TaylorJet(self.0.iter().zip(&other.0).map(|(a, b)| a + b).collect())
    }

    pub fn minus(&self, other: &TaylorJet) -> TaylorJet {
        TaylorJet(self.0.iter().zip(&other.0).map(|(a, b)| a - b).collect())
    }

    pub fn times(&self, other: &TaylorJet) -> TaylorJet {
        let term = |n: usize| (0..=n).map(|i| self.0[i] * other.0[n - i]).sum();
        TaylorJet((0..self.0.len()).map(term).collect())
    }

    pub fn scaled(&self, k: f64) -> TaylorJet {
        TaylorJet(self.0.iter().map(|c| c * k).collect())
    }

    /// Returns (cos, sin) of an angle that is zero at t = 0: (cos φ)˙ = −φ̇ sin φ, (sin φ)˙ = φ̇
    /// cos φ, term by term.
    pub fn cos_sin(&self) -> (TaylorJet, TaylorJet) {
        let order = self.0.len() - 1;
        let (mut c, mut s) = (TaylorJet::constant(1.0, order), TaylorJet::constant(0.0, order));
        for n in 1..=order {
            let sum = |of: &TaylorJet| {
                (1..=n).map(|i| i as f64 * self.0[i] * of.0[n - i]).sum::<f64>() / n as f64
            };
            let (cn, sn) = (-sum(&s), sum(&c));
            c.0[n] = cn;
            s.0[n] = sn;
        }
        (c, s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cosine_and_sine_of_2t() {
        let (c, s) = TaylorJet::from_rest([2.0].into_iter(), 5).cos_sin();
        assert_eq!(c, TaylorJet(vec![1.0, 0.0, -2.0, 0.0, 16.0 / 24.0, 0.0]));
        assert_eq!(s, TaylorJet(vec![0.0, 2.0, 0.0, -8.0 / 6.0, 0.0, 32.0 / 120.0]));
        let one = c.times(&c).plus(&s.times(&s));
        assert!((1..=5).all(|n| one.term(n).abs() < 1e-15) && one.term(0) == 1.0);
    }
}
