//! Searches the crank-rocker whose coupler curve passes nearest to many places: seeded differential
//! evolution over nine dimensions and the assembly, then Gauss–Newton with the crank angles free.
//!
//! The evolution works on distances to a sampled curve. A Gauss–Newton step eliminates the crank
//! angle of each place by projecting on the curve's normal, so that nine unknowns remain for any
//! number of places (Levenberg's damping guards the first steps). Runs follow one another, each
//! with a stream of its own, until the best optimum has been found three times or the places are
//! met; their number is bounded. Parallel runs form waves and are evaluated in order, and all
//! functions are libm's: the bytes are the same on any machine and number of threads.

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// clippy.toml lists the functions of f64 whose last bit depends on the platform; tests may use
// them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The maps link to private modules too; `cargo doc --document-private-items` resolves those links.
#![allow(rustdoc::private_intra_doc_links)]

mod evolution;
pub mod timed;

use evolution::{Population, RandomStream, evolve};
use hodograph_base::budget::here;
use hodograph_base::diag::{Diagnostic, both};
use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::position::kernel::crossing;
use nalgebra::{SMatrix, SVector};
use rayon::prelude::*;
use std::f64::consts::TAU;

// Compiled again when its Chinese texts change.
const _: &str = include_str!("../po/zh.po");

/// The number of samples of a coupler curve.
const SAMPLES: usize = 64;
/// The number of linkages in a population, and of generations in a run: with these nine runs of ten
/// end in the best optimum of a known curve.
const POPULATION: usize = 70;
const GENERATIONS: usize = 110;
/// The greatest and the least number of runs, and the number of times that the best optimum must be
/// found: an optimum that half of the runs miss is then missed once in sixteen thousand.
const RUNS: usize = 24;
const LEAST: usize = 14;
const HITS: usize = 3;
/// The number of runs made at once.
const WAVE: usize = 4;
/// The number of optima returned.
const TOLD: usize = 3;
/// The greatest length of a link, in sizes of the path: a linkage that would grow without end
/// approaches a slider-crank.
pub const LARGEST: f64 = 20.0;
/// The part of the bound from which a link counts as at the bound.
const AT_BOUND: f64 = 0.9;
/// The greatest slack of the Grashof sum, as a part of the lengths, at which a crank-rocker is
/// practically a change point.
const CHANGE: f64 = 1e-3;
/// The number of places that the runs use; of more places they use so many, evenly chosen, and the
/// results are then refined for all. This bounds the work of a search: sixteen places determine
/// nine unknowns, or ten, as well as hundreds between them.
const PLACES: usize = 16;

/// A crank-rocker with its coupler point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CouplerLinkage {
    /// The crank pivot.
    pub a: Point,
    /// The lengths AB, BC, CD, AD (m).
    pub lengths: [f64; 4],
    /// The direction of the frame from A to D (rad).
    pub phi: f64,
    /// The point E in the coupler's frame: along BC from B, and to the left.
    pub e: Vec2,
    /// True if C is to the left of BD.
    pub left: bool,
}

/// The points of a position.
#[derive(Clone, Copy, Debug)]
pub struct PositionPoints {
    /// The pin of the crank.
    pub b: Point,
    /// The pin of the follower.
    pub c: Point,
    /// The coupler point.
    pub e: Point,
}

/// An optimum: the linkage, the crank angles nearest to the places, the root mean square distance
/// (m).
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The linkage.
    pub linkage: CouplerLinkage,
    /// The crank's angle at each place (rad).
    pub cranks: Vec<f64>,
    /// The root mean square distance (m).
    pub rms: f64,
}

/// The result of a search, and its effort.
#[derive(Clone, Debug, Default)]
pub struct Search {
    /// The optima, the best first.
    pub fits: Vec<Fit>,
    /// The number of positions evaluated.
    pub evaluations: u64,
    /// The number of runs.
    pub runs: usize,
}

impl CouplerLinkage {
    fn of(genes: &[f64; 10]) -> CouplerLinkage {
        let [ax, ay, a, b, c, d, phi, u, v, side] = *genes;
        CouplerLinkage {
            a: Point::new(ax, ay),
            lengths: [a, b, c, d],
            phi,
            e: Vec2::new(u, v),
            left: side > 0.0,
        }
    }

    /// Returns the follower pivot.
    pub fn d(&self) -> Point {
        self.a + Vec2::from_angle(self.phi) * self.lengths[3]
    }

    /// Returns the deviation from a crank-rocker, relative to the sum of the lengths; 0 for a
    /// crank-rocker.
    fn fault(&self) -> f64 {
        let [a, b, c, d] = self.lengths;
        let least = b.min(c).min(d);
        let (sum, longest) = (a + b + c + d, b.max(c).max(d));
        let short = (a - least).max(0.0) + (2.0 * (a + longest) - sum).max(0.0);
        let positive = (-a).max(0.0) + (-least).max(0.0);
        (short + positive) / (a.abs() + b.abs() + c.abs() + d.abs())
    }

    /// Returns true if no length exceeds the bound for a path of this size (m).
    fn small(&self, size: f64) -> bool {
        self.lengths.iter().chain([&self.e.norm()]).all(|l| *l <= LARGEST * size)
    }

    /// Returns true if a link is at the bound.
    fn at_bound(&self, size: f64) -> bool {
        self.lengths.iter().any(|l| *l > AT_BOUND * LARGEST * size)
    }

    /// Returns its points at a crank angle (rad, in the plane); `None` if it does not close.
    pub fn place(&self, crank: f64) -> Option<PositionPoints> {
        let [a, bc, cd, _] = self.lengths;
        let b = self.a + Vec2::from_angle(crank) * a;
        let [on_left, on_right] = crossing(b, bc, self.d(), cd)?;
        let c = if self.left { on_left } else { on_right };
        let axis = (c - b) * (1.0 / bc);
        Some(PositionPoints { b, c, e: b + self.e.rotate_by(axis) })
    }

    fn moved(&self, by: &SVector<f64, 9>) -> CouplerLinkage {
        let mut lengths = self.lengths;
        lengths.iter_mut().enumerate().for_each(|(i, l)| *l += by[2 + i]);
        CouplerLinkage {
            a: Point::new(self.a.x + by[0], self.a.y + by[1]),
            lengths,
            phi: self.phi + by[6],
            e: Vec2::new(self.e.x + by[7], self.e.y + by[8]),
            left: self.left,
        }
    }

    /// Returns E with its derivatives by the nine parameters and by the crank angle.
    fn slopes(&self, crank: f64) -> Option<(Point, [Vec2; 10])> {
        let p = self.place(crank)?;
        let [a, bc, cd, ad] = self.lengths;
        let (w, z) = (p.c - p.b, p.c - self.d());
        let cross = w.cross(z);
        let (crank_way, frame_way) = (Vec2::from_angle(crank), Vec2::from_angle(self.phi));
        let arm = p.e - p.b;
        // Motions dB and dD of the pivots, and changes of the lengths, give w·(dC − dB) = b db and
        // z·(dC − dD) = c dc.
        let of = |db: Vec2, dd: Vec2, b: f64, c: f64, local: Vec2| {
            let (r, s) = (w.dot(db) + bc * b, z.dot(dd) + cd * c);
            let dc = Vec2::new(r * z.y - s * w.y, s * w.x - r * z.x) * (1.0 / cross);
            let turn = w.cross(dc - db) / (bc * bc);
            db + arm.perp() * turn + local.rotate_by(w * (1.0 / bc))
        };
        let (zero, x, y) = (Vec2::ZERO, Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0));
        let all = [
            of(x, x, 0.0, 0.0, zero),
            of(y, y, 0.0, 0.0, zero),
            of(crank_way, zero, 0.0, 0.0, zero),
            of(zero, zero, 1.0, 0.0, zero),
            of(zero, zero, 0.0, 1.0, zero),
            of(zero, frame_way, 0.0, 0.0, zero),
            of(zero, frame_way.perp() * ad, 0.0, 0.0, zero),
            of(zero, zero, 0.0, 0.0, x),
            of(zero, zero, 0.0, 0.0, y),
            of(crank_way.perp() * a, zero, 0.0, 0.0, zero),
        ];
        Some((p.e, all))
    }
}

/// Searches the best linkages; the same seed gives the same bytes.
pub fn search(points: &[Point], seed: u64) -> Search {
    let (middle, size) = extent(points);
    let same = |a: &Fit, b: &Fit| (a.rms - b.rms).abs() <= 1e-9 * size.max(b.rms);
    let few = selected_places(points);
    let found = until_sure(size, &same, |run| alone(&few, middle, size, stream(seed, run)));
    if few.len() == points.len() {
        return found;
    }
    found.of_all(&same, |fit, evaluations| {
        let cranks = nearest(&fit.linkage, points, evaluations)?;
        refine(fit.linkage, cranks, points, size, evaluations)
    })
}

/// Returns remarks on an optimum: it is as large as the search allows, or at the limit of
/// crank-rockers.
pub fn remarks(fit: &Fit, points: &[Point]) -> Vec<Diagnostic> {
    let linkage = &fit.linkage;
    let grown = || {
        let message = both!(
            "a link has grown to the bound of {} times the path: the places call for a slider-crank, or lie on one arc",
            LARGEST
        );
        let help = both!("spread the points over more of the path, or give more of them");
        Diagnostic::warning("pivot-far", message).help(help)
    };
    let at_border = || {
        let message = both!(
            "the best crank-rocker is all but a change point: shortest and longest link together are as long as the others"
        );
        let help = both!("give more places, or take another of the candidates");
        Diagnostic::warning("change-point", message).help(help)
    };
    let [a, b, c, d] = linkage.lengths;
    let slack = a + b + c + d - 2.0 * (a + b.max(c).max(d));
    let far = linkage.at_bound(extent(points).1).then(grown);
    far.into_iter().chain((slack < CHANGE * (a + b + c + d)).then(at_border)).collect()
}

/// The places that the runs use, the first place among them.
fn selected_places<T: Copy>(all: &[T]) -> Vec<T> {
    let count = all.len().min(PLACES);
    (0..count).map(|i| all[i * all.len() / count]).collect()
}

impl Search {
    /// Refines the results for some of the places for all of them.
    fn of_all(
        self,
        same: &dyn Fn(&Fit, &Fit) -> bool,
        refined: impl Fn(&Fit, &mut u64) -> Option<Fit>,
    ) -> Search {
        let mut out = Search { fits: Vec::new(), ..self };
        for fit in self.fits.iter().filter_map(|fit| refined(fit, &mut out.evaluations)) {
            if !out.fits.iter().any(|f| same(f, &fit)) {
                out.fits.push(fit);
            }
        }
        out.fits.sort_by(|a, b| a.rms.total_cmp(&b.rms));
        out
    }
}

/// The seed of a run's stream of numbers.
fn stream(seed: u64, run: usize) -> u64 {
    seed.wrapping_mul(1000).wrapping_add(run as u64)
}

/// Runs until the best optimum has been found often enough, or the places are met. Of optima that
/// are the `same` one is returned.
fn until_sure(
    size: f64,
    same: &(dyn Fn(&Fit, &Fit) -> bool + Sync),
    one: impl Fn(usize) -> (Vec<Fit>, u64) + Sync + Send,
) -> Search {
    let mut out = Search::default();
    let mut hits = 0;
    let waves = (0..RUNS).step_by(WAVE).map(|from| from..(from + WAVE).min(RUNS));
    // A wave runs at once and is evaluated in order: runs after the end do not count, for any
    // number of threads.
    let here = here();
    let all = waves.flat_map(|wave| {
        wave.into_par_iter().map(|run| here.enter(|| one(run))).collect::<Vec<_>>()
    });
    for (run, (fits, evaluations)) in all.enumerate() {
        out.runs = run + 1;
        out.evaluations += evaluations;
        let best = out.fits.first().map(|f| f.rms);
        let mut again_here = false;
        for fit in fits {
            again_here |= best.is_some_and(|best| (best - fit.rms).abs() <= 1e-9 * size);
            if !out.fits.iter().any(|f| same(f, &fit)) {
                out.fits.push(fit);
            }
        }
        out.fits.sort_by(|a, b| a.rms.total_cmp(&b.rms));
        let better =
            best.is_some_and(|b| out.fits.first().is_some_and(|f| f.rms < b - 1e-9 * size));
        hits = if better || best.is_none() { 1 } else { hits + usize::from(again_here) };
        if run + 1 >= LEAST && hits >= HITS
            || out.fits.first().is_some_and(|f| f.rms < 1e-10 * size)
        {
            break;
        }
    }
    out.fits.truncate(TOLD);
    out
}

/// Makes one run; returns its optima and the number of positions evaluated.
fn alone(points: &[Point], middle: Point, size: f64, seed: u64) -> (Vec<Fit>, u64) {
    let mut evaluations = 0;
    let apart = |o: &[f64; 10], p: &[f64; 10]| {
        (0..9).any(|k| (o[k] - p[k]).abs() > 0.05 * size) || (o[9] > 0.0) != (p[9] > 0.0)
    };
    let population = Population { count: POPULATION, generations: GENERATIONS, apart: &apart };
    let mut random = RandomStream::new(seed);
    let ranked = evolve(
        &population,
        |r| born(middle, size, r),
        |genes| cost(genes, points, size, &mut evaluations),
        &mut random,
    );
    let fits = ranked.iter().filter_map(|genes| {
        let linkage = CouplerLinkage::of(genes);
        let cranks = nearest(&linkage, points, &mut evaluations)?;
        refine(linkage, cranks, points, size, &mut evaluations)
    });
    let fits = fits.collect();
    (fits, evaluations)
}

/// Returns the middle and the size of the places.
pub fn extent(points: &[Point]) -> (Point, f64) {
    let of = |f: fn(&Point) -> f64| {
        let (low, high) = points
            .iter()
            .map(f)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        ((low + high) / 2.0, high - low)
    };
    let ((x, w), (y, h)) = (of(|p| p.x), of(|p| p.y));
    (Point::new(x, y), libm::hypot(w, h))
}

/// A random linkage around the places, to begin with.
fn born(middle: Point, size: f64, random: &mut RandomStream) -> [f64; 10] {
    let a = random.between(0.1, 0.8);
    let rest = [random.between(0.5, 3.0), random.between(0.5, 3.0), random.between(0.5, 3.0)];
    [
        middle.x + size * random.between(-1.5, 1.5),
        middle.y + size * random.between(-1.5, 1.5),
        a * size,
        rest[0] * size,
        rest[1] * size,
        rest[2] * size,
        random.between(0.0, TAU),
        size * random.between(-2.0, 2.0),
        size * random.between(-2.0, 2.0),
        random.between(-1.0, 1.0),
    ]
}

/// The mean square distance to the sampled curve, relative to the square of the size; other
/// linkages than crank-rockers cost more than any crank-rocker.
fn cost(genes: &[f64; 10], points: &[Point], size: f64, evaluations: &mut u64) -> f64 {
    let linkage = CouplerLinkage::of(genes);
    let fault = linkage.fault();
    if fault > 0.0 {
        return 1e6 * (1.0 + fault);
    }
    *evaluations += SAMPLES as u64;
    let curve = sampled(&linkage);
    if curve.len() < SAMPLES {
        return 1e6;
    }
    points
        .iter()
        .map(|p| curve.iter().map(|e| (*e - *p).norm2()).fold(f64::INFINITY, f64::min))
        .sum::<f64>()
        / (points.len() as f64 * size * size)
}

fn sampled(linkage: &CouplerLinkage) -> Vec<Point> {
    (0..SAMPLES).filter_map(|k| Some(linkage.place(TAU * k as f64 / SAMPLES as f64)?.e)).collect()
}

/// The crank angles nearest to the places, from finer samples.
fn nearest(linkage: &CouplerLinkage, points: &[Point], evaluations: &mut u64) -> Option<Vec<f64>> {
    const FINE: usize = 360;
    *evaluations += FINE as u64;
    let angle = |k: usize| TAU * k as f64 / FINE as f64;
    let curve: Option<Vec<Point>> = (0..FINE).map(|k| Some(linkage.place(angle(k))?.e)).collect();
    let curve = curve?;
    let near = |p: &Point| {
        (0..FINE)
            .min_by(|&i, &j| (curve[i] - *p).norm2().total_cmp(&(curve[j] - *p).norm2()))
            .map(angle)
    };
    points.iter().map(near).collect()
}

/// Refines a linkage by Gauss–Newton with Levenberg's damping; `None` if it leads away from
/// crank-rockers.
fn refine(
    mut linkage: CouplerLinkage,
    mut cranks: Vec<f64>,
    points: &[Point],
    size: f64,
    evaluations: &mut u64,
) -> Option<Fit> {
    let sum = |l: &CouplerLinkage, t: &[f64]| {
        points.iter().zip(t).map(|(p, t)| Some((l.place(*t)?.e - *p).norm2())).sum::<Option<f64>>()
    };
    let mut best = sum(&linkage, &cranks)?;
    let mut damping = 1e-3;
    let mut still = 0;
    for _ in 0..400 {
        let mut normal = SMatrix::<f64, 9, 9>::zeros();
        let mut right = SVector::<f64, 9>::zeros();
        let rows: Option<Vec<(Point, [Vec2; 10])>> =
            cranks.iter().map(|t| linkage.slopes(*t)).collect();
        let rows = rows?;
        *evaluations += rows.len() as u64;
        for ((e, slopes), p) in rows.iter().zip(points) {
            let tangent = slopes[9].unit()?;
            let row = SVector::<f64, 9>::from_fn(|k, _| tangent.cross(slopes[k]));
            normal += row * row.transpose();
            right += row * -tangent.cross(*e - *p);
        }
        let mut taken = false;
        while damping < 1e12 {
            let mut damped = normal;
            for k in 0..9 {
                damped[(k, k)] += damping * normal[(k, k)];
            }
            let Some(step) = damped.cholesky().map(|c| c.solve(&right)) else {
                damping = (damping * 10.0).max(1e-15);
                continue;
            };
            let next = linkage.moved(&step);
            let turned: Vec<f64> = rows
                .iter()
                .zip(points)
                .zip(&cranks)
                .map(|(((e, s), p), t)| {
                    let shift = (0..9).fold(*e - *p, |v, k| v + s[k] * step[k]);
                    t - (s[9].dot(shift) / s[9].norm2()).clamp(-0.3, 0.3)
                })
                .collect();
            *evaluations += points.len() as u64;
            if let Some(there) = sum(&next, &turned)
                .filter(|s| *s <= best && next.fault() == 0.0 && next.small(size))
            {
                let gain = best - there;
                still = if gain <= 1e-13 * best { still + 1 } else { 0 };
                (linkage, cranks, best, taken) = (next, turned, there, true);
                damping = (damping * 0.1).max(1e-15);
                break;
            }
            damping *= 10.0;
        }
        if !taken || still >= 3 {
            break;
        }
    }
    Some(Fit { linkage, cranks, rms: (best / points.len() as f64).sqrt() })
}
