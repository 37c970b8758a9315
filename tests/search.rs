//! The search for a path: known linkages are found from their own curves, with the same bytes on
//! any number of threads.

mod wide;

use hodograph::geom::Point;
use hodograph::geom::Vec2;
use hodograph::search::{CouplerLinkage, Search, search};
use std::time::{Duration, Instant};
use wide::every;

/// Number of places of a known linkage's coupler point at equal rotations of its crank.
const PLACES: usize = 12;
/// Number of seeds for each linkage.
const SEEDS: u64 = 20;
/// Time limit of all searches of one linkage: some seconds when optimised, a few minutes on one
/// slow core without optimisation.
const BOUND: Duration = Duration::from_secs(600);

fn known() -> [CouplerLinkage; 3] {
    let linkage = |lengths: [f64; 4], phi: f64, e: [f64; 2], left: bool| CouplerLinkage {
        a: Point::new(0.01, -0.02),
        lengths,
        phi,
        e: Vec2::new(e[0], e[1]),
        left,
    };
    [
        linkage([0.030, 0.080, 0.070, 0.090], 0.3, [0.050, 0.040], true),
        linkage([0.025, 0.060, 0.065, 0.075], -0.4, [0.020, 0.055], true),
        linkage([0.040, 0.110, 0.090, 0.120], 1.1, [0.060, -0.030], false),
    ]
}

fn places(l: &CouplerLinkage) -> Vec<Point> {
    (0..PLACES)
        .map(|k| l.place(std::f64::consts::TAU * k as f64 / PLACES as f64).unwrap().e)
        .collect()
}

/// Asserts that every seed finds a curve through all places. (The linkage itself and its cognates
/// have the same curve.)
fn found_by_every_seed(l: &CouplerLinkage) {
    let (start, points) = (Instant::now(), places(l));
    for seed in (1..=SEEDS).step_by(every(8)) {
        let found = search(&points, seed);
        assert!(
            found.fits[0].rms < 1e-9,
            "{l:?}, seed {seed}: {} after {} runs",
            found.fits[0].rms,
            found.runs
        );
        assert!(start.elapsed() < BOUND, "{SEEDS} seeds take more than {BOUND:?}");
    }
}

#[test]
fn a_known_linkage_is_found_by_every_seed() {
    found_by_every_seed(&known()[0]);
}

#[test]
fn a_linkage_with_a_high_coupler_point_is_found_by_every_seed() {
    found_by_every_seed(&known()[1]);
}

#[test]
fn a_crossed_linkage_is_found_by_every_seed() {
    found_by_every_seed(&known()[2]);
}

/// True if two searches agree bit for bit, including evaluations and runs.
fn same(a: &Search, b: &Search) -> bool {
    let bits = |s: &Search| {
        s.fits
            .iter()
            .flat_map(|f| f.linkage.lengths.into_iter().chain([f.rms]))
            .map(f64::to_bits)
            .collect::<Vec<_>>()
    };
    bits(a) == bits(b) && a.evaluations == b.evaluations && a.runs == b.runs
}

#[test]
fn any_number_of_threads_finds_the_same_bytes() {
    let points = places(&known()[0]);
    let on = |threads: usize| {
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap()
            .install(|| search(&points, 3))
    };
    let alone = on(1);
    for threads in [2, 3, 8] {
        assert!(same(&alone, &on(threads)), "{threads} threads");
    }
}
