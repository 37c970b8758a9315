//! Solution of a large system block by block (block triangular form), each block after those on
//! which it depends.
//!
//! The cost of factoring grows with the number of blocks, not with the cube of the number of
//! unknowns.

use super::blocks::{EquationBlock, blocks};
use super::relation::EquationRow;
use hodograph_base::linear::LinearSystem;
use nalgebra::{DMatrix, DVector};

/// Number of unknowns (some fifty links) from which a system is solved in stages.
pub(super) const LARGE: usize = 150;

/// The factors of a system's blocks.
pub(super) struct StagedFactors {
    coefficients: Vec<Vec<(usize, f64)>>,
    parts: Vec<StagedBlock>,
}

/// A block and its factors.
struct StagedBlock {
    block: EquationBlock,
    system: LinearSystem,
}

impl StagedBlock {
    fn new(block: EquationBlock, coefficients: &[Vec<(usize, f64)>]) -> StagedBlock {
        let n = block.rows.len();
        let mut a = DMatrix::zeros(n, n);
        for (i, row) in block.rows.iter().enumerate() {
            for (k, c) in &coefficients[*row] {
                if let Ok(k) = block.unknowns.binary_search(k) {
                    a[(i, k)] += c;
                }
            }
        }
        StagedBlock { block, system: LinearSystem::new(a) }
    }

    fn has(&self, unknown: usize) -> bool {
        self.block.unknowns.binary_search(&unknown).is_ok()
    }
}

impl StagedFactors {
    /// Factors the equations of `n` unknowns, which must be `n` in number.
    pub fn new(rows: &[EquationRow], n: usize) -> StagedFactors {
        StagedFactors::of(rows.iter().map(|r| r.coefficients.clone()).collect(), blocks(rows, n))
    }

    /// Factors the given blocks.
    fn of(coefficients: Vec<Vec<(usize, f64)>>, blocks: Vec<EquationBlock>) -> StagedFactors {
        let parts =
            blocks.into_iter().map(|block| StagedBlock::new(block, &coefficients)).collect();
        StagedFactors { coefficients, parts }
    }

    /// Returns the largest column sum of magnitudes.
    pub fn one_norm(&self) -> f64 {
        let mut sums = vec![0.0; self.coefficients.len()];
        for (k, c) in self.coefficients.iter().flatten() {
            sums[*k] += c.abs();
        }
        sums.into_iter().fold(0.0, f64::max)
    }

    /// x with A x = b.
    pub fn solve(&self, b: &DVector<f64>) -> Option<DVector<f64>> {
        let mut x = DVector::zeros(b.len());
        for part in &self.parts {
            // Unknowns outside the block are solved before it.
            let known = |row: usize| {
                self.coefficients[row]
                    .iter()
                    .filter(|(k, _)| !part.has(*k))
                    .map(|(k, c)| c * x[*k])
                    .sum::<f64>()
            };
            let rhs = DVector::from_iterator(
                part.block.rows.len(),
                part.block.rows.iter().map(|row| b[*row] - known(*row)),
            );
            let found = part.system.solve(&rhs)?;
            part.block.unknowns.iter().zip(found.iter()).for_each(|(k, v)| x[*k] = *v);
        }
        Some(x)
    }

    /// Returns y with Aᵀ y = c: the blocks in reverse order.
    pub fn solve_transposed(&self, c: &DVector<f64>) -> Option<DVector<f64>> {
        let (mut rest, mut y) = (c.clone(), DVector::zeros(c.len()));
        for part in self.parts.iter().rev() {
            let rhs = DVector::from_iterator(
                part.block.unknowns.len(),
                part.block.unknowns.iter().map(|k| rest[*k]),
            );
            let found = part.system.solve_transposed(&rhs)?;
            for (row, v) in part.block.rows.iter().zip(found.iter()) {
                y[*row] = *v;
                self.coefficients[*row]
                    .iter()
                    .filter(|(k, _)| !part.has(*k))
                    .for_each(|(k, c)| rest[*k] -= c * v);
            }
        }
        Some(y)
    }

    /// b − A x.
    pub fn residual(&self, x: &DVector<f64>, b: &DVector<f64>) -> DVector<f64> {
        let product = |row: &Vec<(usize, f64)>| row.iter().map(|(k, c)| c * x[*k]).sum::<f64>();
        DVector::from_iterator(
            b.len(),
            self.coefficients.iter().zip(b.iter()).map(|(row, b)| b - product(row)),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::super::blocks::of_lists;
    use super::*;

    /// Blocks of three, each dependent on the one before it, with shuffled equations and unknowns.
    fn chain(blocks: usize) -> Vec<Vec<(usize, f64)>> {
        let n = 3 * blocks;
        // Strides coprime to every number of unknowns here.
        let (unknown, row) = (|k: usize| (k * 7 + 5) % n, |i: usize| (i * 11 + 2) % n);
        let mut rows = vec![Vec::new(); n];
        for i in 0..n {
            let first = (i / 3 * 3).saturating_sub(3);
            rows[row(i)] = (first..i / 3 * 3 + 3)
                .map(|k| {
                    (
                        unknown(k),
                        0.3 * (((i * 5 + k * 3) % 13) as f64 - 6.5)
                            + if i == k { 20.0 } else { 0.0 },
                    )
                })
                .collect();
        }
        rows
    }

    #[test]
    fn blocks_give_what_the_whole_gives() {
        for count in [1, 2, 10, 40, 100] {
            let coefficients = chain(count);
            let n = coefficients.len();
            let lists: Vec<Vec<usize>> =
                coefficients.iter().map(|row| row.iter().map(|c| c.0).collect()).collect();
            let staged = StagedFactors::of(coefficients.clone(), of_lists(&lists, n));
            // The work is that of this many small blocks.
            assert!(
                staged.parts.len() == count && staged.parts.iter().all(|p| p.block.rows.len() == 3)
            );
            let mut whole = DMatrix::<f64>::zeros(n, n);
            for (i, row) in coefficients.iter().enumerate() {
                row.iter().for_each(|(k, c)| whole[(i, *k)] += c);
            }
            let b = DVector::from_fn(n, |i, _| (i % 17) as f64 - 8.0);
            let (x, y) = (staged.solve(&b).unwrap(), staged.solve_transposed(&b).unwrap());
            assert!(
                (&whole * &x - &b).amax() < 1e-10 && (whole.transpose() * &y - &b).amax() < 1e-10,
                "{count} blocks"
            );
            assert!((staged.residual(&y, &b) - (&b - &whole * &y)).amax() < 1e-10);
            let sums = whole
                .column_iter()
                .map(|c| c.iter().map(|v| v.abs()).sum::<f64>())
                .fold(0.0, f64::max);
            assert!((staged.one_norm() - sums).abs() < 1e-9);
        }
    }
}
