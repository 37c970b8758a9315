//! Differential evolution (Storn and Price, rand/1/bin, with a random pull towards the best):
//! searches genes of least cost.
//!
//! The last gene is a choice of two by its sign and is kept within −1 and 1. The same stream of
//! numbers gives the same bytes.

use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// The number of members of the last generation that are refined.
const REFINED: usize = 12;

/// A stream of random numbers from 0 to 1.
pub(super) struct RandomStream(Pcg64);

impl RandomStream {
    /// Returns the stream of a seed.
    pub fn new(seed: u64) -> RandomStream {
        RandomStream(Pcg64::seed_from_u64(seed))
    }

    /// Returns a number from 0 to 1.
    fn unit(&mut self) -> f64 {
        // 53 bits: all multiples of 2⁻⁵³ between 0 and 1.
        (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Returns a number between two bounds.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn below(&mut self, n: usize) -> usize {
        ((self.unit() * n as f64) as usize).min(n - 1)
    }
}

/// The size of a population, and the criterion by which its members differ.
pub(super) struct Population<'a, const N: usize> {
    /// The number of members.
    pub count: usize,
    /// The number of generations.
    pub generations: usize,
    /// True if two members differ enough to refine both.
    pub apart: &'a dyn Fn(&[f64; N], &[f64; N]) -> bool,
}

/// Runs the evolution; returns the best members that differ, in order of cost.
pub(super) fn evolve<const N: usize>(
    population: &Population<N>,
    born: impl Fn(&mut RandomStream) -> [f64; N],
    mut cost: impl FnMut(&[f64; N]) -> f64,
    random: &mut RandomStream,
) -> Vec<[f64; N]> {
    let count = population.count;
    let mut all: Vec<([f64; N], f64)> = Vec::with_capacity(count);
    while all.len() < count {
        let genes = born(random);
        let cost = cost(&genes);
        all.push((genes, cost));
    }
    for _ in 0..population.generations {
        for i in 0..count {
            let best = (0..count).min_by(|&p, &q| all[p].1.total_cmp(&all[q].1)).unwrap_or(0);
            let [p, q, r] = [0; 3].map(|_| random.below(count));
            let keep = random.below(N);
            let (scale, toward) =
                (random.between(0.4, 0.9), if random.unit() < 0.3 { 0.5 } else { 0.0 });
            let mut genes = all[i].0;
            for (k, gene) in genes.iter_mut().enumerate() {
                if k == keep || random.unit() < 0.85 {
                    let base = all[p].0[k] + toward * (all[best].0[k] - all[p].0[k]);
                    *gene = base + scale * (all[q].0[k] - all[r].0[k]);
                }
            }
            genes[N - 1] = genes[N - 1].clamp(-1.0, 1.0);
            let new = cost(&genes);
            if new <= all[i].1 {
                all[i] = (genes, new);
            }
        }
    }
    all.sort_by(|a, b| a.1.total_cmp(&b.1));
    let mut out: Vec<[f64; N]> = Vec::new();
    for (genes, _) in all {
        if out.iter().all(|o| (population.apart)(o, &genes)) {
            out.push(genes);
        }
        if out.len() == REFINED {
            break;
        }
    }
    out
}
