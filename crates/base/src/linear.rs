//! Linear systems: a square matrix with its factors, solved for many right-hand sides.
//!
//! It is in this crate because `hodograph-base` is optimised in development builds, too.

use nalgebra::{DMatrix, DVector};

/// The factors of a square matrix (partial pivoting). Zeros cost little: the rows of the equations of
/// a mechanism are nearly empty.
#[derive(Clone, Debug)]
pub struct RowFactors {
    /// Both factors, row after row: below the diagonal the multipliers of the elimination.
    rows: Vec<f64>,
    /// The row with which each row was exchanged when it became the row of a pivot.
    pivots: Vec<usize>,
}

impl RowFactors {
    /// Factors a square matrix with `n` rows, given row after row.
    pub fn new(n: usize, mut rows: Vec<f64>) -> RowFactors {
        let mut pivots = Vec::with_capacity(n);
        // The number of elements of each row up to its last that is not zero.
        let mut ends: Vec<usize> = rows
            .chunks_exact(n.max(1))
            .map(|row| row.iter().rposition(|c| *c != 0.0).map_or(0, |last| last + 1))
            .collect();
        for k in 0..n {
            let (mut pivot, mut largest) = (k, rows[k * n + k].abs());
            for row in k + 1..n {
                let size = rows[row * n + k].abs();
                if size > largest {
                    (pivot, largest) = (row, size);
                }
            }
            pivots.push(pivot);
            let (above, below) = rows.split_at_mut((k + 1) * n);
            let own = &mut above[k * n..];
            if let Some(other) = (pivot - k).checked_sub(1) {
                own.swap_with_slice(&mut below[other * n..][..n]);
                ends.swap(k, pivot);
            }
            if own[k] == 0.0 {
                continue;
            }
            let (inverse, end) = (1.0 / own[k], ends[k]);
            for (row, row_end) in below.chunks_exact_mut(n).zip(&mut ends[k + 1..]) {
                if row[k] != 0.0 {
                    let times = row[k] * inverse;
                    row[k] = times;
                    let rest = row[k + 1..end].iter_mut().zip(&own[k + 1..end]);
                    rest.for_each(|(r, o)| *r -= o * times);
                    *row_end = end.max(*row_end);
                }
            }
        }
        RowFactors { rows, pivots }
    }

    /// Returns the determinant.
    pub fn determinant(&self) -> f64 {
        let exchanged = self.pivots.iter().enumerate().filter(|(k, pivot)| k != *pivot).count();
        let sign = if exchanged.is_multiple_of(2) { 1.0 } else { -1.0 };
        self.rows.iter().step_by(self.pivots.len() + 1).product::<f64>() * sign
    }

    /// Replaces b by x with A x = b; `None` if the matrix is singular.
    pub fn solve(&self, x: &mut [f64]) -> Option<()> {
        let rows = || self.rows.chunks_exact(self.pivots.len().max(1)).enumerate();
        self.pivots.iter().enumerate().for_each(|(k, pivot)| x.swap(k, *pivot));
        for (i, row) in rows() {
            x[i] = row[..i].iter().zip(&x[..i]).fold(x[i], |rest, (c, x)| rest - c * x);
        }
        for (i, row) in rows().rev() {
            if row[i] == 0.0 {
                return None;
            }
            let known = row[i + 1..].iter().zip(&x[i + 1..]).rev();
            x[i] = known.fold(x[i], |rest, (c, x)| rest - c * x) / row[i];
        }
        Some(())
    }

    /// Replaces b by y with Aᵀ y = b; `None` if the matrix is singular.
    fn solve_transposed(&self, y: &mut [f64]) -> Option<()> {
        let n = self.pivots.len();
        for i in 0..n {
            let known = dot(i, |j| self.rows[j * n + i] * y[j]);
            if self.rows[i * n + i] == 0.0 {
                return None;
            }
            y[i] = (y[i] - known) / self.rows[i * n + i];
        }
        for i in (0..n).rev() {
            y[i] -= dot(n - 1 - i, |j| self.rows[(i + 1 + j) * n + i] * y[i + 1 + j]);
        }
        self.pivots.iter().enumerate().rev().for_each(|(k, pivot)| y.swap(k, *pivot));
        Some(())
    }
}

/// Returns the sum of `n` products. Eight interleaved sums are added, as nalgebra adds them, so that
/// results are equal to the last bit.
fn dot(n: usize, product: impl Fn(usize) -> f64) -> f64 {
    let mut sums = [0.0; 8];
    let whole = n - n % 8;
    (0..whole).for_each(|k| sums[k % 8] += product(k));
    let sum = (0..4).fold(0.0, |sum, k| sum + (sums[k] + sums[k + 4]));
    (whole..n).fold(sum, |sum, k| sum + product(k))
}

/// A square matrix and its factors.
#[derive(Clone, Debug)]
pub struct LinearSystem {
    matrix: DMatrix<f64>,
    factors: RowFactors,
}

impl LinearSystem {
    /// Factors a square matrix.
    pub fn new(matrix: DMatrix<f64>) -> LinearSystem {
        let n = matrix.nrows();
        let mut rows = vec![0.0; n * n];
        for (k, column) in matrix.as_slice().chunks_exact(n.max(1)).enumerate() {
            column.iter().enumerate().for_each(|(row, c)| rows[row * n + k] = *c);
        }
        LinearSystem { matrix, factors: RowFactors::new(n, rows) }
    }

    /// The matrix itself.
    pub fn matrix(&self) -> &DMatrix<f64> {
        &self.matrix
    }

    /// Returns the determinant.
    pub fn determinant(&self) -> f64 {
        self.factors.determinant()
    }

    /// Returns x with A x = b; `None` if the matrix is singular.
    pub fn solve(&self, b: &DVector<f64>) -> Option<DVector<f64>> {
        let mut x = b.clone();
        self.factors.solve(x.as_mut_slice())?;
        Some(x)
    }

    /// Returns y with Aᵀ y = b; `None` if the matrix is singular.
    pub fn solve_transposed(&self, b: &DVector<f64>) -> Option<DVector<f64>> {
        let mut y = b.clone();
        self.factors.solve_transposed(y.as_mut_slice())?;
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
        assert_eq!(
            LinearSystem::new(DMatrix::zeros(0, 0)).solve(&DVector::zeros(0)).unwrap().len(),
            0
        );
    }

    /// The elimination and the substitutions are those of a common library, operation by operation.
    #[test]
    fn solutions_are_those_of_nalgebra_to_the_last_bit() {
        for n in 1..40 {
            let entry = |i: usize, k: usize| {
                let v = libm::sin((i * 37 + k * 101 + i * k * n) as f64);
                if (i * 5 + k * 3 + n).is_multiple_of(4) { v } else { 0.0 }
            };
            let a = DMatrix::from_fn(n, n, |i, k| {
                entry(i, k) + if (i + n / 2) % n == k { 0.7 } else { 0.0 }
            });
            let b = DVector::from_fn(n, |i, _| libm::cos(3.0 * i as f64));
            let system = LinearSystem::new(a.clone());
            let own = system.solve(&b);
            let lu = a.lu();
            let other = lu.solve(&b);
            let bits = |x: Option<DVector<f64>>| {
                x.map(|x| x.iter().map(|v| (v + 0.0).to_bits()).collect::<Vec<_>>())
            };
            assert_eq!(bits(own), bits(other), "{n}");
            let own = system.solve_transposed(&b);
            let other = lu.u().tr_solve_upper_triangular(&b);
            let mut other = other.and_then(|z| lu.l().tr_solve_lower_triangular(&z));
            other.iter_mut().for_each(|y| lu.p().inv_permute_rows(y));
            assert_eq!(bits(own), bits(other), "{n}, transposed");
        }
    }
}
