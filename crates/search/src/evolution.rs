//! Differential evolution (Storn and Price, rand/1/bin, now and then drawn towards the best): genes whose cost is least.
//!
//! The last gene is a choice of two by its sign and is kept within −1 and 1. The same stream of numbers gives the same bytes.

use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// How many of the last generation are handed on to be refined.
const REFINED: usize = 12;

/// Numbers from 0 to 1.
pub(super) struct Random(Pcg64);

impl Random {
    /// A stream of its own for each seed.
    pub fn new(seed: u64) -> Random {
        Random(Pcg64::seed_from_u64(seed))
    }

    /// From 0 to 1.
    fn unit(&mut self) -> f64 {
        // 53 bits: every double between 0 and 1 in steps of 2⁻⁵³.
        (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Between two bounds.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn below(&mut self, n: usize) -> usize {
        ((self.unit() * n as f64) as usize).min(n - 1)
    }
}

/// How large it is, and when two of its members are told apart.
pub(super) struct Population<'a, const N: usize> {
    /// Members.
    pub count: usize,
    /// Generations.
    pub generations: usize,
    /// Whether two members are worth refining both.
    pub apart: &'a dyn Fn(&[f64; N], &[f64; N]) -> bool,
}

/// Evolves; the best members that differ, in order.
pub(super) fn evolve<const N: usize>(
    population: &Population<N>,
    born: impl Fn(&mut Random) -> [f64; N],
    mut cost: impl FnMut(&[f64; N]) -> f64,
    random: &mut Random,
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
            let (scale, toward) = (random.between(0.4, 0.9), if random.unit() < 0.3 { 0.5 } else { 0.0 });
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
