//! Path generation with prescribed timing: the crank turns by given angles from place to place.
//!
//! For given ratios of the lengths and a given first angle of the crank everything else is linear,
//! in complex numbers E = A + Z₁ p + Z₂ q (p the crank's direction from the frame, q that of the
//! coupler). Differential evolution therefore runs over four dimensions and the assembly, and each
//! of its steps solves the rest (variable projection, Golub and Pereyra). Gauss–Newton with
//! Levenberg's damping then refines all ten unknowns. The cognate whose crank turns with the crank
//! (Roberts) meets the same places at the same angles: both are returned.

use super::evolution::{Population, RandomStream, evolve};
use super::{CouplerLinkage, Fit, Search, extent, selected_places, stream, until_sure};
use hodograph_base::geom::{Point, Vec2};
use nalgebra::{SMatrix, SVector};
use std::f64::consts::TAU;

/// The number of linkages in a population, and of generations in a run: nine runs of ten end in the
/// best optimum of a known curve.
const POPULATION: usize = 60;
const GENERATIONS: usize = 120;
/// The ratios of coupler, rocker and frame to the crank at the beginning: those of textbook
/// drawings.
const RATIO: [f64; 2] = [1.1, 8.0];
/// Searches the best linkages; the same seed gives the same bytes. `turns` are the crank's angles
/// at the places (rad); only their differences count.
pub fn search(points: &[Point], turns: &[f64], seed: u64) -> Search {
    let (_, size) = extent(points);
    let same = |a: &Fit, b: &Fit| {
        (a.rms - b.rms).abs() <= 1e-9 * size.max(b.rms)
            && a.linkage
                .lengths
                .iter()
                .zip(b.linkage.lengths)
                .all(|(p, q)| (p - q).abs() <= 1e-6 * size)
    };
    let (some, at) = (selected_places(points), selected_places(turns));
    let mut found = until_sure(size, &same, |run| {
        TimedRun { points: &some, turns: &at, size }.alone(stream(seed, run))
    });
    if some.len() < points.len() {
        let all = TimedRun { points, turns, size };
        found = found.of_all(&same, |fit, evaluations| {
            all.refine((fit.linkage, *fit.cranks.first()?), evaluations)
        });
    }
    // Of the optima at the bound only one is kept.
    let mut grown = 0;
    found.fits.retain(|f| {
        grown += usize::from(f.linkage.at_bound(size));
        grown <= 1 || !f.linkage.at_bound(size)
    });
    // Along a flat valley steps end before its bottom: an optimum next to a better one is the same.
    let near = |a: &Fit, b: &Fit| {
        let longest = a.linkage.lengths.into_iter().fold(0.0, f64::max);
        b.rms <= 1.01 * a.rms
            && a.linkage
                .lengths
                .iter()
                .zip(b.linkage.lengths)
                .all(|(p, q)| (p - q).abs() <= 0.05 * longest)
    };
    let mut bottoms: Vec<Fit> = Vec::new();
    for fit in found.fits {
        if !bottoms.iter().any(|better| near(better, &fit)) {
            bottoms.push(fit);
        }
    }
    found.fits = bottoms;
    let twins: Vec<Fit> = found.fits.iter().filter_map(twin).collect();
    for twin in twins {
        if !found.fits.iter().any(|f| same(f, &twin)) {
            found.fits.push(twin);
        }
    }
    found
}

/// The cognate whose crank turns with the crank: its pivot F is similar to E, its coupler turns
/// with the follower, its follower with the coupler. `None` if E is the pin C, so that its crank
/// has no length.
fn twin(fit: &Fit) -> Option<Fit> {
    let l = &fit.linkage;
    let [a, b, c, d] = l.lengths;
    let lambda = l.e * (1.0 / b);
    let stretch = Vec2::new(1.0, 0.0) - lambda;
    let by = stretch.norm();
    if by < 1e-9 {
        return None;
    }
    let linkage = CouplerLinkage {
        a: l.a + (l.d() - l.a).rotate_by(lambda),
        lengths: [a * by, c * by, b * by, d * by],
        phi: l.phi + stretch.angle(),
        e: lambda.divide_by(stretch) * (-c * by),
        left: !l.left,
    };
    Some(Fit {
        linkage,
        cranks: fit.cranks.iter().map(|t| t + stretch.angle()).collect(),
        rms: fit.rms,
    })
}

struct TimedRun<'a> {
    points: &'a [Point],
    turns: &'a [f64],
    size: f64,
}

impl TimedRun<'_> {
    /// Makes one run; returns its optima and the number of positions evaluated.
    fn alone(&self, seed: u64) -> (Vec<Fit>, u64) {
        let mut evaluations = 0;
        let apart = |o: &[f64; 5], p: &[f64; 5]| {
            (0..4).any(|k| (o[k] - p[k]).abs() > 0.05) || (o[4] > 0.0) != (p[4] > 0.0)
        };
        let population = Population { count: POPULATION, generations: GENERATIONS, apart: &apart };
        let mut random = RandomStream::new(seed);
        let ranked =
            evolve(&population, born, |genes| self.cost(genes, &mut evaluations), &mut random);
        let fits = ranked
            .iter()
            .filter_map(|genes| self.refine(self.projected(genes)?.0, &mut evaluations))
            .collect();
        (fits, evaluations)
    }

    fn cost(&self, genes: &[f64; 5], evaluations: &mut u64) -> f64 {
        let fault = shape(genes).fault();
        if fault > 0.0 {
            return 1e6 * (1.0 + fault);
        }
        *evaluations += self.points.len() as u64;
        self.projected(genes)
            .map_or(1e6, |(_, sum)| sum / (self.points.len() as f64 * self.size * self.size))
    }

    /// The best linkage of a shape and first angle, and its sum of squares: linear least squares in
    /// three complex numbers.
    fn projected(&self, genes: &[f64; 5]) -> Option<((CouplerLinkage, f64), f64)> {
        let (shape, start) = (shape(genes), genes[3]);
        let at = |turn: f64| shape.place(start + turn - self.turns[0]);
        let rows: Option<Vec<[Vec2; 3]>> = self
            .points
            .iter()
            .zip(self.turns)
            .map(|(e, turn)| {
                let place = at(*turn)?;
                Some([place.b - Point::ORIGIN, (place.c - place.b).unit()?, *e - Point::ORIGIN])
            })
            .collect();
        let rows = rows?;
        let mean = rows
            .iter()
            .fold([Vec2::ZERO; 3], |m, r| [0, 1, 2].map(|i| m[i] + r[i]))
            .map(|v| v * (1.0 / rows.len() as f64));
        // The product conj(u) v, an entry of the normal equations.
        let inner = |u: Vec2, v: Vec2| Vec2::new(u.dot(v), u.cross(v));
        let [mut pp, mut qq] = [0.0; 2];
        let [mut pq, mut pe, mut qe] = [Vec2::ZERO; 3];
        for row in &rows {
            let [p, q, e] = [0, 1, 2].map(|i| row[i] - mean[i]);
            (pp, qq) = (pp + p.norm2(), qq + q.norm2());
            (pq, pe, qe) = (pq + inner(p, q), pe + inner(p, e), qe + inner(q, e));
        }
        let det = pp * qq - pq.norm2();
        // The coupler hardly turns relative to the crank, or not at all: the solution is not
        // unique.
        if det <= 1e-12 * pp * qq {
            return None;
        }
        let z1 = (pe * qq - qe.rotate_by(pq)) * (1.0 / det);
        let z2 = (qe * pp - pe.rotate_by(Vec2::new(pq.x, -pq.y))) * (1.0 / det);
        let sum = rows
            .iter()
            .map(|r| {
                (r[2] - mean[2] - (r[0] - mean[0]).rotate_by(z1) - (r[1] - mean[1]).rotate_by(z2))
                    .norm2()
            })
            .sum();
        let scale = z1.norm();
        // In the coupler's own frame E is at Z₂ less the rotation of the frame, which is that of
        // Z₁.
        let way = z1.unit()?;
        let a = Point::ORIGIN + mean[2] - mean[0].rotate_by(z1) - mean[1].rotate_by(z2);
        let linkage = CouplerLinkage {
            a,
            lengths: shape.lengths.map(|l| l * scale),
            phi: way.angle(),
            e: z2.divide_by(way),
            left: shape.left,
        };
        linkage.small(self.size).then(|| ((linkage, start + way.angle()), sum))
    }

    /// The crank's angles from its first.
    fn cranks(&self, start: f64) -> Vec<f64> {
        self.turns.iter().map(|t| start + t - self.turns[0]).collect()
    }

    fn sum(&self, l: &CouplerLinkage, start: f64) -> Option<f64> {
        self.cranks(start)
            .iter()
            .zip(self.points)
            .map(|(t, p)| Some((l.place(*t)?.e - *p).norm2()))
            .sum()
    }

    /// Refines all ten unknowns by Gauss–Newton with Levenberg's damping; `None` if it creeps along
    /// a valley without converging.
    fn refine(
        &self,
        (mut linkage, mut start): (CouplerLinkage, f64),
        evaluations: &mut u64,
    ) -> Option<Fit> {
        let mut best = self.sum(&linkage, start)?;
        let mut damping = 1e-3;
        let mut still = 0;
        for _ in 0..400 {
            let mut normal = SMatrix::<f64, 10, 10>::zeros();
            let mut right = SVector::<f64, 10>::zeros();
            *evaluations += self.points.len() as u64;
            for (t, p) in self.cranks(start).iter().zip(self.points) {
                let (e, slopes) = linkage.slopes(*t)?;
                for part in [|v: Vec2| v.x, |v: Vec2| v.y] {
                    let row = SVector::<f64, 10>::from_fn(|k, _| part(slopes[k]));
                    normal += row * row.transpose();
                    right -= row * part(e - *p);
                }
            }
            let mut taken = false;
            while damping < 1e12 {
                let mut damped = normal;
                for k in 0..10 {
                    damped[(k, k)] += damping * normal[(k, k)];
                }
                let Some(step) = damped.cholesky().map(|c| c.solve(&right)) else {
                    damping = (damping * 10.0).max(1e-15);
                    continue;
                };
                let (next, turned) =
                    (linkage.moved(&step.fixed_rows::<9>(0).into()), start + step[9]);
                *evaluations += self.points.len() as u64;
                if let Some(there) = self
                    .sum(&next, turned)
                    .filter(|s| *s <= best && next.fault() == 0.0 && next.small(self.size))
                {
                    still = if best - there <= 1e-13 * best { still + 1 } else { 0 };
                    (linkage, start, best, taken) = (next, turned, there, true);
                    damping = (damping * 0.1).max(1e-15);
                    break;
                }
                damping *= 10.0;
            }
            if !taken || still >= 3 {
                return Some(Fit {
                    linkage,
                    cranks: self.cranks(start),
                    rms: (best / self.points.len() as f64).sqrt(),
                });
            }
        }
        None
    }
}

/// A random shape to begin with.
fn born(random: &mut RandomStream) -> [f64; 5] {
    let mut ratio = || random.between(libm::log(RATIO[0]), libm::log(RATIO[1]));
    let [b, c, d] = [ratio(), ratio(), ratio()];
    [b, c, d, random.between(0.0, TAU), random.between(-1.0, 1.0)]
}

/// The linkage of a shape: a crank of length 1 at the origin, the frame along x; the genes are
/// logarithms of the other lengths, the crank's first angle, and the assembly.
fn shape(genes: &[f64; 5]) -> CouplerLinkage {
    let [b, c, d, _, side] = *genes;
    CouplerLinkage {
        a: Point::ORIGIN,
        lengths: [1.0, libm::exp(b), libm::exp(c), libm::exp(d)],
        phi: 0.0,
        e: Vec2::ZERO,
        left: side > 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_twin_meets_the_same_places_at_the_same_turns() {
        for left in [true, false] {
            let linkage = CouplerLinkage {
                a: Point::new(0.01, -0.02),
                lengths: [0.03, 0.08, 0.07, 0.09],
                phi: 0.3,
                e: Vec2::new(0.05, 0.04),
                left,
            };
            let cranks: Vec<f64> = (0..12).map(|k| 0.5 * f64::from(k)).collect();
            let other = twin(&Fit { linkage, cranks: cranks.clone(), rms: 0.0 }).unwrap();
            for (one, two) in cranks.iter().zip(&other.cranks) {
                let far =
                    linkage.place(*one).unwrap().e.distance(other.linkage.place(*two).unwrap().e);
                assert!(far < 1e-15, "{far}");
            }
        }
        let at_c = CouplerLinkage {
            a: Point::ORIGIN,
            lengths: [0.03, 0.08, 0.07, 0.09],
            phi: 0.0,
            e: Vec2::new(0.08, 0.0),
            left: true,
        };
        assert_eq!(twin(&Fit { linkage: at_c, cranks: vec![0.0], rms: 0.0 }), None);
    }
}
