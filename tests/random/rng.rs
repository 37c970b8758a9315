//! A small random generator, so that a seed in a failure message gives the same mechanism
//! everywhere.

use crate::wide::every;

/// SplitMix64.
///
/// # Source
/// G. L. Steele, D. Lea, C. H. Flood, *Fast splittable pseudorandom number generators*, OOPSLA
/// 2014.
#[derive(Clone, Debug)]
pub struct Rng(pub u64);

impl Rng {
    pub fn new(seed: u64) -> Self {
        Rng(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5bd1_e995)
    }

    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number in [a, b).
    pub fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * ((self.next() >> 11) as f64 / (1u64 << 53) as f64)
    }

    /// A unit vector.
    pub fn direction(&mut self) -> hodograph::geom::Vec2 {
        hodograph::geom::Vec2::from_angle(self.between(-std::f64::consts::PI, std::f64::consts::PI))
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    pub fn chance(&mut self, p: f64) -> bool {
        self.between(0.0, 1.0) < p
    }

    pub fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())]
    }

    pub fn shuffle<T>(&mut self, of: &mut [T]) {
        for i in (1..of.len()).rev() {
            of.swap(i, self.below(i + 1));
        }
    }
}

/// The seeds of a test: `HODOGRAPH_SEEDS` times its own number for a long search, else its own
/// number or a part of it.
pub fn seeds(own: u64) -> std::ops::Range<u64> {
    match std::env::var("HODOGRAPH_SEEDS").ok().and_then(|n| n.parse::<u64>().ok()) {
        Some(times) => 0..own * times,
        None => 0..own.div_ceil(every(8) as u64),
    }
}
