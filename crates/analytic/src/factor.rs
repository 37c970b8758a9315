//! Rank-revealing factorization of a square block: QR with column pivoting.
//!
//! Columns are first scaled by powers of two: the rotation of a short link has small coefficients
//! in every pose.
//!
//! # Source
//! P. Businger, G. H. Golub, *Linear least squares solutions by Householder transformations*,
//! Numer. Math. 7 (1965).

use hodograph_mechanism::position::kernel::power_of_two_scale;
use nalgebra::{ColPivQR, DMatrix, DVector, Dyn};

/// The factorization A D P = Q R.
pub(super) struct Factor {
    qr: ColPivQR<f64, Dyn, Dyn>,
    /// D.
    scale: Vec<f64>,
    /// Greatest factor by which scaling may magnify the rounding of the coefficients.
    pub magnified: f64,
    /// The last pivot, relative to the first pivot or to its value in a good pose: near 0 if the
    /// block is nearly singular.
    pub ratio: f64,
}

impl Factor {
    /// Factors a square matrix of at least one column; `reach` is the size of the coefficients of
    /// each column in the poses in which they are largest.
    pub fn new(mut a: DMatrix<f64>, reach: &[f64]) -> Factor {
        let scale: Vec<f64> = reach.iter().map(|r| power_of_two_scale(*r)).collect();
        for (mut column, k) in a.column_iter_mut().zip(&scale) {
            column *= *k;
        }
        let magnified = scale.iter().copied().fold(1.0, f64::max);
        let qr = a.col_piv_qr();
        let pivots = qr.r().diagonal().abs();
        let ratio = pivots[pivots.len() - 1] / pivots[0].max(1.0);
        Factor { qr, scale, magnified, ratio }
    }

    /// Returns the number of pivots that are no larger than `bound`, relative as in
    /// [`Factor::ratio`].
    pub fn deficiency(&self, bound: f64) -> usize {
        let pivots = self.qr.r().diagonal().abs();
        pivots.iter().filter(|d| **d <= bound * pivots[0].max(1.0)).count()
    }

    fn unscaled(&self, mut y: DVector<f64>) -> DVector<f64> {
        self.qr.p().inv_permute_rows(&mut y);
        for (x, k) in y.iter_mut().zip(&self.scale) {
            *x *= k;
        }
        y
    }

    /// Returns x with A x = b. If `deficient`, the solution satisfies the independent equations
    /// only, with one unknown held at zero.
    pub fn solve(&self, b: &DVector<f64>, deficient: bool) -> Option<DVector<f64>> {
        let mut y = b.clone();
        self.qr.q_tr_mul(&mut y);
        let k = y.len() - usize::from(deficient);
        let r = self.qr.r();
        let head = r.view((0, 0), (k, k)).solve_upper_triangular(&y.rows(0, k))?;
        y.fill(0.0);
        y.rows_mut(0, k).copy_from(&head);
        let x = self.unscaled(y);
        x.iter().all(|v| v.is_finite()).then_some(x)
    }

    /// Returns the unit vector z with A z = 0 (approximately, if the last pivot is not quite zero).
    pub fn right(&self) -> Option<DVector<f64>> {
        let r = self.qr.r();
        let k = r.ncols() - 1;
        let head = r.view((0, 0), (k, k)).solve_upper_triangular(&(-r.view((0, k), (k, 1))))?;
        let mut y = DVector::zeros(k + 1);
        y.rows_mut(0, k).copy_from(&head.column(0));
        y[k] = 1.0;
        let z = self.unscaled(y);
        let norm = z.norm();
        (norm > 0.0 && norm.is_finite()).then(|| z / norm)
    }

    /// Returns the unit vector l with lᵀ A = 0: the linear dependence of the equations.
    pub fn left(&self) -> DVector<f64> {
        let q = self.qr.q();
        q.column(q.ncols() - 1).into_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn null_vectors_of_rank_one() {
        let a = DMatrix::from_row_slice(2, 2, &[3.0, 4.0, 6.0, 8.0]);
        let f = Factor::new(a.clone(), &[6.0, 8.0]);
        assert_eq!((f.deficiency(1e-15), f.deficiency(0.0) <= 1), (1, true));
        let (z, l) = (f.right().unwrap(), f.left());
        assert!((&a * &z).norm() < 1e-14 && (l.transpose() * &a).norm() < 1e-14);
        assert!((z.norm() - 1.0).abs() < 1e-15 && (l.norm() - 1.0).abs() < 1e-15);
        let b = DVector::from_vec(vec![1.0, 2.0]);
        assert!((a * f.solve(&b, true).unwrap() - b).norm() < 1e-15);
    }
}
