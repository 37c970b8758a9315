//! Numbers of teeth for a wanted ratio: pairs that fit a centre distance with spur or helical teeth,
//! and trains of several stages.
//!
//! A spur pair fits a distance a by its profile shifts: cos α′ = a₀ cos α/a gives x₁ + x₂. A helical
//! pair of normal module m_n fits it without shifts by its helix angle: cos β = m_n (z₁ + z₂)/2a.

use super::{Basic, GearPair, Mate, operating, standard, sum_of_shifts};

/// A wanted pair of external gears.
#[derive(Clone, Debug, PartialEq)]
pub struct WantedPair {
    /// The ratio i = z₂/z₁, at least 1.
    pub ratio: f64,
    /// The greatest relative deviation of the ratio.
    pub within: f64,
    /// The least and the greatest number of teeth.
    pub teeth: [u32; 2],
    /// The modules to try; for helical teeth they are normal modules.
    pub modules: Vec<f64>,
    /// Pressure angle (rad), addendum and clearance; its module is not used.
    pub basic: Basic,
    /// The centre distance, in the unit of the modules.
    pub distance: f64,
    /// The least and the greatest x₁ + x₂ of a spur pair.
    pub shifts: [f64; 2],
    /// The least and the greatest helix angle (rad).
    pub helix: [f64; 2],
}

/// The way in which a pair fits its centre distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PairFit {
    /// Spur teeth with profile shifts.
    Spur {
        /// x₁ + x₂.
        sum: f64,
        /// Operating pressure angle α′ (rad).
        operating: f64,
        /// Contact ratio with half of the sum on each gear; `None` if no teeth are left.
        contact: Option<f64>,
    },
    /// Helical teeth without shifts, with the helix angle β (rad).
    Helical(f64),
}

/// A pair that meets the wishes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundPair {
    /// The module, or normal module.
    pub module: f64,
    /// z₁ and z₂.
    pub teeth: [u32; 2],
    /// Its fit to the distance.
    pub fit: PairFit,
}

/// Returns z₂/z₁.
pub fn ratio_of([a, b]: [u32; 2]) -> f64 {
    f64::from(b) / f64::from(a)
}

/// Returns all numbers of teeth of a ratio within limits.
fn counts(ratio: f64, within: f64, [least, most]: [u32; 2]) -> Vec<[u32; 2]> {
    let of = |z: u32| {
        let wanted = ratio * f64::from(z);
        let from = libm::ceil(wanted * (1.0 - within) - 1e-9).max(f64::from(least));
        let to = libm::floor(wanted * (1.0 + within) + 1e-9).min(f64::from(most));
        (least..=most).filter(move |k| (from..=to).contains(&f64::from(*k))).map(move |k| [z, k])
    };
    (least..=most).flat_map(of).collect()
}

/// Returns all pairs that meet the wishes, the best ratio first, then the smaller module and the
/// smaller gears.
pub fn pairs(wish: &WantedPair) -> Vec<FoundPair> {
    let all = counts(wish.ratio, wish.within, wish.teeth);
    let mut found = Vec::new();
    for &module in &wish.modules {
        let basic = Basic { module, ..wish.basic };
        for &teeth in &all {
            let fits = [spur(&basic, teeth, wish), helical(&basic, teeth, wish)];
            found.extend(fits.into_iter().flatten().map(|fit| FoundPair { module, teeth, fit }));
        }
    }
    let off = |p: &FoundPair| (ratio_of(p.teeth) / wish.ratio - 1.0).abs();
    found.sort_by(|a, b| {
        let by_ratio = off(a).total_cmp(&off(b));
        by_ratio.then(a.module.total_cmp(&b.module)).then(a.teeth.cmp(&b.teeth))
    });
    found
}

fn spur(basic: &Basic, teeth: [u32; 2], wish: &WantedPair) -> Option<PairFit> {
    let [low, high] = wish.shifts;
    let operating = operating(basic, Mate::Gear, teeth, wish.distance)?;
    let sum = sum_of_shifts(basic, Mate::Gear, teeth, operating);
    // A pair at its standard distance has no shifts.
    let sum = if sum.abs() < 1e-12 { 0.0 } else { sum };
    if !(low..=high).contains(&sum) {
        return None;
    }
    let pair = GearPair::new(*basic, Mate::Gear, teeth, [0.5 * sum; 2], wish.distance);
    Some(PairFit::Spur { sum, operating, contact: pair.map(|p| p.contact_ratio()) })
}

fn helical(basic: &Basic, teeth: [u32; 2], wish: &WantedPair) -> Option<PairFit> {
    let cosine = standard(basic, Mate::Gear, teeth) / wish.distance;
    let [low, high] = wish.helix;
    let angle = (cosine < 1.0).then(|| libm::acos(cosine))?;
    (low..=high).contains(&angle).then_some(PairFit::Helical(angle))
}

/// A wanted train of stages in series, each a pair of external gears.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WantedTrain {
    /// The total ratio, the product of those of the stages.
    pub ratio: f64,
    /// The number of stages, within [`STAGES`].
    pub stages: usize,
    /// The ratio of a stage over that of the next slower one, within [`TAPER`].
    pub taper: f64,
    /// The least and the greatest number of teeth.
    pub teeth: [u32; 2],
    /// The greatest relative deviation of the total ratio.
    pub within: f64,
}

/// Least and greatest number of stages of a train.
pub const STAGES: [usize; 2] = [2, 4];
/// Least and greatest ratio of a stage over that of the next slower one.
pub const TAPER: [f64; 2] = [0.5, 2.0];

/// Pinions of a train have at most so many teeth more than the least.
const PINIONS: u32 = 8;
/// The ratio of a stage differs from its share by at most this part.
const SHARE: f64 = 0.05;
/// Greatest number of pairs that are tried for a stage of trains of 2, 3 and 4 stages.
const TRIED: [usize; STAGES[1] - STAGES[0] + 1] = [200, 60, 24];

/// Returns the share of each stage: i₁ = taper · i₂ = taper² · i₃ …, the fastest first.
pub fn shares(wish: &WantedTrain) -> Vec<f64> {
    let n = wish.stages as f64;
    let middle = libm::pow(wish.ratio, 1.0 / n);
    let of = |k: usize| middle * libm::pow(wish.taper, 0.5 * (n - 1.0) - k as f64);
    (0..wish.stages).map(of).collect()
}

/// Returns trains that meet the wishes, the best total ratio first, then those with fewer teeth.
/// The ratio of each stage is within 5 % of its share.
pub fn stages(wish: &WantedTrain) -> Vec<Vec<[u32; 2]>> {
    let [least, most] = wish.teeth;
    let tried = TRIED[wish.stages.clamp(STAGES[0], STAGES[1]) - STAGES[0]];
    let mut found: Vec<(Vec<[u32; 2]>, f64)> = vec![(Vec::new(), 1.0)];
    for share in shares(wish) {
        let mut all = counts(share, SHARE, [least, most]);
        all.retain(|[z, _]| *z <= least.saturating_add(PINIONS));
        all.sort_by(|a, b| {
            let off = |p: &[u32; 2]| (ratio_of(*p) / share - 1.0).abs();
            off(a).total_cmp(&off(b)).then(a.cmp(b))
        });
        all.truncate(tried);
        let with = |(train, ratio): &(Vec<[u32; 2]>, f64)| {
            let (train, ratio) = (train.clone(), *ratio);
            let longer = move |pair: &[u32; 2]| {
                (train.iter().copied().chain([*pair]).collect::<Vec<_>>(), ratio * ratio_of(*pair))
            };
            all.iter().map(longer).collect::<Vec<_>>()
        };
        found = found.iter().flat_map(with).collect();
    }
    let off = |ratio: f64| (ratio / wish.ratio - 1.0).abs();
    found.retain(|(_, ratio)| off(*ratio) <= wish.within);
    let count = |train: &[[u32; 2]]| train.iter().flatten().map(|z| u64::from(*z)).sum::<u64>();
    found.sort_by(|(a, p), (b, q)| {
        // Ratios that differ by rounding are one.
        let [p, q] = [p, q].map(|r| libm::round(off(*r) * 1e12));
        p.total_cmp(&q).then(count(a).cmp(&count(b))).then(a.cmp(b))
    });
    found.into_iter().map(|(train, _)| train).collect()
}
