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

/// A square system of equations with one right-hand side, written row by row. Zeros cost nothing in
/// its elimination: the rows of many equations are nearly empty.
#[derive(Clone, Debug)]
pub struct EquationRows {
    /// The coefficients of each equation, and its right-hand side.
    rows: Vec<f64>,
    unknowns: usize,
}

impl EquationRows {
    /// Makes a system of so many unknowns and equations with zeros.
    pub fn new(unknowns: usize) -> EquationRows {
        EquationRows { rows: vec![0.0; unknowns * (unknowns + 1)], unknowns }
    }

    /// Sets all numbers to zero.
    pub fn clear(&mut self) {
        self.rows.fill(0.0);
    }

    /// Adds to the coefficient of an unknown in an equation.
    #[inline]
    pub fn add(&mut self, equation: usize, unknown: usize, by: f64) {
        self.rows[equation * (self.unknowns + 1) + unknown] += by;
    }

    /// Sets the right-hand side of an equation.
    pub fn set_right(&mut self, equation: usize, value: f64) {
        self.rows[equation * (self.unknowns + 1) + self.unknowns] = value;
    }

    /// Returns the largest magnitude of a right-hand side.
    pub fn largest_right(&self) -> f64 {
        self.rows
            .chunks_exact(self.unknowns + 1)
            .fold(0.0, |largest, row| row[self.unknowns].abs().max(largest))
    }

    /// Returns the unknowns, by elimination with partial pivoting; `None` if the system is singular
    /// or a number is not finite. The coefficients are lost.
    pub fn solve(&mut self) -> Option<Vec<f64>> {
        let (n, width) = (self.unknowns, self.unknowns + 1);
        for k in 0..n {
            let size = |row: &usize| self.rows[row * width + k].abs();
            let pivot = (k..n).reduce(|a, b| if size(&b) > size(&a) { b } else { a })?;
            if size(&pivot) == 0.0 {
                return None;
            }
            let (above, below) = self.rows.split_at_mut((k + 1) * width);
            let own = &mut above[k * width..];
            if let Some(other) = (pivot - k).checked_sub(1) {
                own.swap_with_slice(&mut below[other * width..][..width]);
            }
            let own = &own[k..];
            for row in below.chunks_exact_mut(width) {
                let row = &mut row[k..];
                if row[0] != 0.0 {
                    let times = row[0] / own[0];
                    row.iter_mut().zip(own).for_each(|(r, o)| *r -= times * o);
                }
            }
        }
        let mut x = vec![0.0; n];
        for k in (0..n).rev() {
            let row = &self.rows[k * width..][..width];
            let known: f64 = row[k + 1..n].iter().zip(&x[k + 1..]).map(|(a, x)| a * x).sum();
            x[k] = (row[n] - known) / row[k];
        }
        x.iter().all(|v| v.is_finite()).then_some(x)
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
        let mut rows = EquationRows::new(6);
        for i in 0..6 {
            (0..6).for_each(|k| rows.add(i, k, a[(i, k)]));
            rows.set_right(i, b[i]);
        }
        let x = DVector::from_vec(rows.solve().unwrap());
        assert!((&a * x - &b).amax() < 1e-13);
        assert!(EquationRows::new(2).solve().is_none());
    }
}
