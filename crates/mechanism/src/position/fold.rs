//! The limit of a mechanism that Newton's method follows: the fold of its equations, by
//! pseudo-arclength continuation.
//!
//! Poses and driver value together move along a curve that is smooth through the limit: there the
//! driver value is extreme, while the links continue to move. The curve is therefore parametrized
//! by its length along a tangent, and the zero of the driver's derivative with respect to this
//! length is solved. The equations are those of [`newton`]; [`super::toggle`] describes the links
//! that hold the mechanism there.
//!
//! # Source
//! H. B. Keller, *Numerical solution of bifurcation and nonlinear eigenvalue problems*, in:
//! Applications of Bifurcation Theory (1977).

use super::newton::{self, DriverValues, SolvedPoses, System};
use super::{Configuration, finish};
use crate::mechanism::Mechanism;
use hodograph_base::linear::LinearSystem;
use hodograph_scene::Scene;
use nalgebra::{DMatrix, DVector};

/// Greatest number of corrections of a point on the curve, and of the zero on it: close to the fold
/// both converge in less than ten.
const PATIENCE: usize = 30;

/// The first step along the curve (radians, parts of the mechanism's size): large compared with the
/// rounding of a rate (1e-10), small compared with the curve's bends.
const FIRST: f64 = 1.0 / 1024.0;

/// A fold farther away than this along the curve is not the limit that stops the mechanism.
const NEAR: f64 = 0.25;

/// Steps along the curve below this are rounding: the derivative of the rate is a difference.
const SLIGHT: f64 = 1e-10;

/// The curve of all poses near one of them, intersected by planes square to its direction there.
struct PoseCurve<'a> {
    system: System<'a>,
    drivers: DriverValues,
    driver: usize,
    /// Unit of the driver's value: a radian, or the mechanism's size (m).
    unit: f64,
    base: DVector<f64>,
    along: DVector<f64>,
}

impl PoseCurve<'_> {
    /// Returns the residuals; `z` contains the unknowns of the system, and the driver's value after
    /// them.
    fn residuals(&self, z: &DVector<f64>) -> DVector<f64> {
        let (at, drivers) = self.pose(z);
        self.system.residuals(&at, &drivers)
    }

    /// Returns the derivatives of the residuals, a column for each element of `z`.
    fn slopes(&self, z: &DVector<f64>) -> Option<DMatrix<f64>> {
        let (at, drivers) = self.pose(z);
        let n = z.len() - 1;
        let mut slopes = self.system.jacobian(&at, &drivers)?.insert_column(n, 0.0);
        slopes.set_column(n, &(self.system.driver_column(self.driver) * self.unit));
        Some(slopes)
    }

    fn pose(&self, z: &DVector<f64>) -> (SolvedPoses, DriverValues) {
        let n = z.len() - 1;
        let mut drivers = self.drivers.clone();
        drivers.0[self.driver] = z[n] * self.unit;
        (self.system.unpack(&z.rows(0, n).into_owned()), drivers)
    }

    /// Returns the point on the curve in the plane at a distance from the base, and the driver's
    /// rate with respect to that distance.
    fn at(&self, guess: &DVector<f64>, distance: f64) -> Option<(DVector<f64>, f64)> {
        let n = guess.len() - 1;
        let mut z = guess.clone();
        let mut last = f64::INFINITY;
        for _ in 0..PATIENCE {
            let mut square = self.slopes(&z)?.insert_row(n, 0.0);
            square.set_row(n, &self.along.transpose());
            let mut miss = self.residuals(&z).insert_row(n, 0.0);
            miss[n] = self.along.dot(&(&z - &self.base)) - distance;
            let solve = LinearSystem::new(square);
            let step = solve.solve(&-miss)?;
            let size = step.amax();
            if !size.is_finite() || size > NEAR {
                return None;
            }
            z += step;
            // The correction is within rounding.
            if size < 4.0 * f64::EPSILON || (size < 1e-9 && size >= last) {
                let mut one = DVector::zeros(n + 1);
                one[n] = 1.0;
                let rate = solve.solve(&one)?[n];
                return Some((z, rate));
            }
            last = size;
        }
        None
    }
}

/// Returns the fold close to a pose: the value of a driver there, measured like
/// [`newton::driver_values`], and the pose.
///
/// The value is exact to second order in the pose: it is as accurate as the rounding of the
/// equations. `None` if the driver's rate has no simple zero nearby on the curve.
pub fn fold(
    scene: &Scene,
    mechanism: &Mechanism,
    near: &Configuration,
    drivers: &DriverValues,
    driver: usize,
) -> Option<(f64, Configuration)> {
    let system =
        System::new(scene, mechanism, &near.shapes, near, &newton::placed(mechanism, near));
    let unit = if scene.drivers[driver].kind.turns() { 1.0 } else { system.scale() };
    let x = system.pack(near)?;
    let n = x.len();
    let base = x.insert_row(n, drivers.0[driver] / unit);
    let mut curve = PoseCurve {
        system,
        drivers: drivers.clone(),
        driver,
        unit,
        along: DVector::zeros(n + 1),
        base,
    };
    let slopes = curve.slopes(&curve.base).filter(|s| s.iter().all(|v| v.is_finite()))?;
    // The direction with zero residuals: with a row of zeros it belongs to the smallest singular
    // value.
    let svd = slopes.insert_row(n, 0.0).svd(false, true);
    let smallest = svd.singular_values.imin();
    curve.along = svd.v_t?.row(smallest).transpose();
    let (mut old, mut s) = ((0.0, curve.along[n]), FIRST);
    let mut z = curve.base.clone();
    for _ in 0..PATIENCE {
        let (there, rate) = curve.at(&z, s)?;
        let next = s - rate * (s - old.0) / (rate - old.1);
        let step = (next - s).abs();
        if step < SLIGHT || rate == 0.0 {
            let (poses, points) = curve.system.unpack(&there.rows(0, n).into_owned());
            let at = finish::complete(
                scene,
                mechanism,
                near.shapes.clone(),
                (poses, points),
                near.closures.clone(),
                &near.rolled,
            );
            return Some((there[n] * unit, at));
        }
        if !next.is_finite() || next.abs() > NEAR {
            return None;
        }
        (old, s, z) = ((s, rate), next, there);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanism::Demand;
    use crate::position::{configure, newton};
    use hodograph_scene as scene;

    /// A crank-rocker (AB, BC, CD, AD) driven by its rocker, with an angle that is inside the
    /// limit, at which crank and coupler are stretched out (1) or fold (−1), by `inside` (rad), and
    /// at a distance `off` (m) from the origin. Returns the fold that is found, and the limit by
    /// the cosine law.
    fn found([a, b, c, d]: [f64; 4], sense: f64, inside: f64, off: f64) -> (Option<f64>, f64) {
        let reach = b + sense * a;
        let limit =
            std::f64::consts::PI - libm::acos((c * c + d * d - reach * reach) / (2.0 * c * d));
        let angle = limit + sense * inside;
        let text = format!(
            r#"{{"links": {{"1": ["A", "B"], "2": ["B", "C"], "3": ["D", "C"], "0": ["A", "D"]}}, "ground": "0", "side": {{"B": "left of AC"}},
            "points": {{"A": ["{off} m", "{off} m"], "D": ["{off} m + {d} m", "{off} m"]}}, "lengths": {{"AB": "{a} m", "BC": "{b} m", "CD": "{c} m"}},
            "driver": {{"link": "3", "angle": "{angle:?} rad", "omega": "1 rad/s"}}, "find": ["omega_1"]}}"#
        );
        let scene = scene::read(&text).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
        let m = Mechanism::new(&scene).unwrap().value;
        let at = configure(&scene, &m, &Demand::of(&scene, &m).with_all_positions())
            .unwrap_or_else(|f| panic!("{f}\n{text}"))
            .value;
        let drivers = newton::driver_values(&scene, &at);
        let fold = fold(&scene, &m, &at, &drivers, 0);
        (
            fold.map(|(value, there)| {
                let [p, q, r] = ["A", "B", "C"].map(|n| {
                    there.points[scene.points.iter().position(|p| p.name == n).unwrap()].unwrap()
                });
                assert!(
                    (q - p).cross(r - q).abs() < 1e-6 * a * b,
                    "A, B, C are not in line\n{text}"
                );
                angle + (value - drivers.0[0])
            }),
            limit,
        )
    }

    /// Close to a limit the fold is found to the rounding of the equations; far from it the result
    /// is the fold or `None`.
    #[test]
    fn the_fold_is_the_limit_by_the_cosine_law() {
        let (mut near, mut far, mut shifted) = (0, 0, 0);
        for (size, off) in [(1e-3, 0.0), (1.0, 0.0), (1.0, 60.0), (1e3, 0.0), (1e3, 2e5)] {
            for lengths in [
                [1.0, 2.5, 2.0, 3.0],
                [0.5, 3.0, 1.7, 3.1],
                [0.9, 1.4, 1.6, 1.5],
                [0.05, 2.0, 1.3, 2.2],
            ] {
                for sense in [1.0, -1.0] {
                    for inside in [1e-9, 1e-6, 1e-4, 1e-3, 3e-3, 0.01, 0.03, 0.1, 0.2, 0.4] {
                        // Half of the swing is as close to the other limit.
                        if inside > 0.4 * lengths[0] {
                            continue;
                        }
                        let (fold, limit) = found(lengths.map(|l| l * size), sense, inside, off);
                        // Far from the origin the rate, which is a difference, is not always
                        // accurate enough.
                        assert!(
                            fold.is_some() || off > 0.0 || inside > 1e-3 * lengths[0],
                            "{lengths:?} {sense}: none from {inside} rad"
                        );
                        let Some(value) = fold else { continue };
                        match (off > 0.0, inside > 1e-3) {
                            (true, _) => shifted += 1,
                            (_, true) => far += 1,
                            _ => near += 1,
                        }
                        let rounding = 1e-13 + 4e-15 * off / size;
                        assert!(
                            (value - limit).abs() < rounding,
                            "{lengths:?} {sense}, from {inside} rad, {off} m off: {value}, not {limit}"
                        );
                    }
                }
            }
        }
        assert!(near > 50 && far > 10 && shifted > 30, "{near} {far} {shifted}");
    }
}
