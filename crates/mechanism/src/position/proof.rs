//! Roots without a closed form, in any number type: an approximate root is refined by Newton's
//! method and, if the numbers know their error, its existence and local uniqueness are proved.
//!
//! The proof is a contraction: with Y an approximate inverse of the Jacobian, x ↦ x − Y f(x) maps
//! the box of half-width ρ about x₀ into itself and contracts there if |Y f(x₀)| ≤ (1 − q) ρ with q
//! ≥ |1 − Y J| over the whole box. The box then contains exactly one root.
//!
//! # Source
//! R. Krawczyk, *Newton-Algorithmen zur Bestimmung von Nullstellen mit Fehlerschranken*, Computing
//! 4 (1969); R. E. Moore, *A test for existence of solutions to nonlinear systems*, SIAM J. Numer.
//! Anal. 14 (1977).

use hodograph_base::budget::spend;
use hodograph_base::number::Real;
use nalgebra::DMatrix;

/// A system of as many equations as unknowns, with a state that can be moved.
pub(super) trait SquareSystem<N: Real> {
    /// The values of the unknowns.
    type State: Clone;

    /// Returns the residual of each equation.
    fn residuals(&self, at: &Self::State) -> Vec<N>;

    /// Returns the derivatives of the residuals by a step of each unknown, row after row.
    fn jacobian(&self, at: &Self::State) -> Vec<Vec<N>>;

    /// Returns the state after a step: positions are shifted, directions turned by [`turned`].
    fn moved(&self, at: &Self::State, step: &[N]) -> Self::State;

    /// Returns the unknowns that are angles, each with the length in which its steps are measured
    /// (1 for radians).
    fn angles(&self) -> Vec<(usize, f64)>;
}

/// The reason why a root is not found or not proved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unproven {
    /// The Jacobian is singular in `f64`, or Newton's method leads away.
    NoRoot,
    /// The box is too wide for the curvature: two roots may be close, or the number has too few
    /// digits.
    NotUnique,
    /// The equations of this kind of group are not available for a proof.
    NotWritten,
}

/// Greatest number of iteration steps: each gains some eight digits or more, and the longest
/// numbers have a few hundred.
const STEPS: usize = 60;

/// Longest permitted step: a root within rounding moves by little, and a step of a tenth of the
/// mechanism (or a tenth of a radian) leads elsewhere.
const LONGEST: f64 = 0.1;

/// Refines a root known in `f64`, and proves it if `N` knows its error; `scale` is the size of the
/// unknowns.
pub(super) fn root<N: Real, S: SquareSystem<N>>(
    system: &S,
    start: S::State,
    scale: f64,
) -> Result<S::State, Unproven> {
    let angles = system.angles();
    let inverse = approximate_inverse(&system.jacobian(&start)).ok_or(Unproven::NoRoot)?;
    let newton = |at: &S::State| -> Vec<N> {
        let r = system.residuals(at);
        (0..r.len())
            .map(|i| {
                r.iter()
                    .enumerate()
                    .fold(N::from_f64(0.0), |sum, (j, r)| sum - N::from_f64(inverse[(i, j)]) * *r)
            })
            .collect()
    };
    let mut at = start;
    let mut last = f64::INFINITY;
    for _ in 0..STEPS {
        spend();
        let step: Vec<N> = newton(&at).into_iter().map(Real::mid).collect();
        let size = step.iter().map(|s| s.approx().abs()).fold(0.0, f64::max);
        if !step.iter().all(|s| s.is_decided()) || size > LONGEST * scale {
            return Err(Unproven::NoRoot);
        }
        // Within rounding the steps do not decrease further.
        if size >= 0.25 * last {
            break;
        }
        at = system.moved(&at, &step);
        last = size;
        if size == 0.0 {
            break;
        }
    }
    if !N::knows_its_error() {
        return Ok(at);
    }
    let eta = largest(newton(&at).iter().map(|s| s.approx().abs() + s.radius()));
    // At least the smallest normal number: a box of no width proves nothing.
    let rho = (2.0 * eta).max(f64::MIN_POSITIVE);
    if !rho.is_finite() || rho > LONGEST * scale {
        return Err(Unproven::NoRoot);
    }
    let n = inverse.nrows();
    let wide: Vec<N> = vec![N::from_f64(0.0).widened(rho); n];
    let all = system.moved(&at, &wide);
    let mut jacobian = system.jacobian(&all);
    for (k, unit) in angles {
        // A step δ turns by 2 atan(δ/2), with the derivative 1/(1 + δ²/4).
        let half = wide[k] * N::from_f64(0.5 / unit);
        let slope = N::from_f64(1.0) / (N::from_f64(1.0) + half * half);
        for row in &mut jacobian {
            row[k] = row[k] * slope;
        }
    }
    let rows = (0..n).map(|i| {
        let entry = |j: usize| {
            let identity = N::from_f64(if i == j { 1.0 } else { 0.0 });
            jacobian
                .iter()
                .enumerate()
                .fold(identity, |s, (k, row)| s - N::from_f64(inverse[(i, k)]) * row[j])
        };
        (0..n).map(entry).map(|x| x.approx().abs() + x.radius()).sum::<f64>()
    });
    let contraction = largest(rows);
    // With q ≤ 0.49 the box of 2η is mapped into itself, including the rounding of these sums.
    if contraction <= 0.49 { Ok(all) } else { Err(Unproven::NotUnique) }
}

/// Returns the largest number; NaN if any is NaN: an undecided number proves nothing, and
/// `f64::max` would ignore it.
fn largest(all: impl Iterator<Item = f64>) -> f64 {
    all.fold(0.0, |most: f64, x| if most.is_nan() || x <= most { most } else { x })
}

/// Returns the unit vector `axis` turned by 2 atan(`step`/2): the angle of the step up to its cube,
/// and rational.
pub(super) fn turned<N: Real>(
    axis: hodograph_base::geom::Vec2<N>,
    step: N,
) -> hodograph_base::geom::Vec2<N> {
    let one = N::from_f64(1.0);
    let t = step * N::from_f64(0.5);
    let norm = one + t * t;
    axis.rotate_by(hodograph_base::geom::Vec2::new((one - t * t) / norm, (t + t) / norm))
}

fn approximate_inverse<N: Real>(jacobian: &[Vec<N>]) -> Option<DMatrix<f64>> {
    let n = jacobian.len();
    let inverse = DMatrix::from_fn(n, n, |i, j| jacobian[i][j].approx()).try_inverse()?;
    inverse.iter().all(|x| x.is_finite()).then_some(inverse)
}

#[cfg(test)]
mod tests {
    use super::*;
    use hodograph_base::number::Ball;

    /// x − 2 = 0 twice; in the second equation the slope, or the residual beside the root, is a
    /// ball of some width or undecided.
    struct RepeatedEquation {
        slope: bool,
        residual: bool,
    }

    /// Returns 0/0, an undecided ball.
    fn undecided() -> Ball<f64> {
        let [nought, none] = [0.0, 0.0].map(Ball::from_f64);
        nought / none
    }

    impl SquareSystem<Ball<f64>> for RepeatedEquation {
        type State = [Ball<f64>; 2];

        fn residuals(&self, at: &Self::State) -> Vec<Ball<f64>> {
            let off = at.map(|x| x - Ball::from_f64(2.0));
            vec![off[0], if self.residual || off[1].approx() != 0.0 { off[1] } else { undecided() }]
        }

        fn jacobian(&self, at: &Self::State) -> Vec<Vec<Ball<f64>>> {
            let (one, zero) = (Ball::from_f64(1.0), Ball::from_f64(0.0));
            let slope = if self.slope || at[1].radius() == 0.0 { one } else { undecided() };
            vec![vec![one, zero], vec![zero, slope]]
        }

        fn moved(&self, at: &Self::State, step: &[Ball<f64>]) -> Self::State {
            [at[0] + step[0], at[1] + step[1]]
        }

        fn angles(&self) -> Vec<(usize, f64)> {
            Vec::new()
        }
    }

    #[test]
    fn what_is_undecided_proves_nothing() {
        let start = || [Ball::from_f64(2.0 + 1e-9), Ball::from_f64(2.0 - 1e-9)];
        let proved = |slope, residual| root(&RepeatedEquation { slope, residual }, start(), 1.0);
        let two = proved(true, true).unwrap_or_else(|_| panic!("a linear system is solved"));
        assert!(
            two.iter().all(|x| (x.approx() - 2.0).abs() <= x.radius() && x.radius() < 1e-12),
            "{two:?}"
        );
        assert!(
            proved(false, true).is_err()
                && proved(true, false).is_err()
                && proved(false, false).is_err()
        );
    }
}
