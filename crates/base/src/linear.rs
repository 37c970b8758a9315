//! Linear systems: a square matrix with its factors, solved for many right-hand sides.
//!
//! It is in this crate because generic code is compiled, and optimised, where it is used.

use nalgebra::{DMatrix, DVector, Dyn, LU};
use std::cell::OnceCell;

/// A square matrix and its factors (partial pivoting).
#[derive(Clone, Debug)]
pub struct LinearSystem {
    matrix: DMatrix<f64>,
    lu: LU<f64, Dyn, Dyn>,
    /// The lower and the upper factor, unpacked for the transposed system.
    triangles: OnceCell<[DMatrix<f64>; 2]>,
}

impl LinearSystem {
    /// Factors a square matrix.
    pub fn new(matrix: DMatrix<f64>) -> LinearSystem {
        let lu = matrix.clone().lu();
        LinearSystem { matrix, lu, triangles: OnceCell::new() }
    }

    /// The matrix itself.
    pub fn matrix(&self) -> &DMatrix<f64> {
        &self.matrix
    }

    /// Returns x with A x = b; `None` if the matrix is singular.
    pub fn solve(&self, b: &DVector<f64>) -> Option<DVector<f64>> {
        self.lu.solve(b)
    }

    /// Returns y with Aᵀ y = b; `None` if the matrix is singular.
    pub fn solve_transposed(&self, b: &DVector<f64>) -> Option<DVector<f64>> {
        let [lower, upper] = self.triangles.get_or_init(|| [self.lu.l(), self.lu.u()]);
        let mut y =
            upper.tr_solve_upper_triangular(b).and_then(|z| lower.tr_solve_lower_triangular(&z))?;
        self.lu.p().inv_permute_rows(&mut y);
        Some(y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_solutions_satisfy_their_equations() {
        let entry = |i: usize, k: usize| ((i * 7 + k * 5 + i * k) % 11) as f64 - 5.0;
        let a = DMatrix::from_fn(6, 6, |i, k| entry(i, k) + if i == 5 - k { 9.0 } else { 0.0 });
        let b = DVector::from_fn(6, |i, _| i as f64 - 2.5);
        let system = LinearSystem::new(a.clone());
        assert!((&a * system.solve(&b).unwrap() - &b).amax() < 1e-13);
        assert!((a.tr_mul(&system.solve_transposed(&b).unwrap()) - &b).amax() < 1e-13);
        assert!(LinearSystem::new(DMatrix::zeros(2, 2)).solve(&DVector::zeros(2)).is_none());
    }
}
