//! The least base circle without undercut.
//!
//! The radii of curvature grow with the base circle, so each stretch of the law needs a base circle
//! of its own, and the largest of these is sought. The follower's motion does not depend on the
//! base circle: s, s′, s″ and s‴ of a survey serve for all of them.

use super::jet::CamJet;
use super::survey::sharpness;
use super::turn::{CamSample, DividedTurn, Ends, greatest};
use super::{CamMotion, Disc, FollowerTip, PreparedDisc};

/// Halvings of the interval in which a base circle is sought.
const HALVINGS: usize = 44;

/// Relative accuracy of the base circle.
const ACCURACY: f64 = 1e-13;

/// The greatest number of times that the given base circle is enlarged by half.
const LARGER: usize = 40;

/// Returns the radius of the least base circle without undercut. `None` if the profile is given, or
/// if no base circle avoids undercut.
pub fn least_base(disc: &Disc) -> Option<f64> {
    least_base_of(&DividedTurn::of(&PreparedDisc::of(disc)))
}

/// Returns [`least_base`] of a disc with the states of its turn.
pub(super) fn least_base_of(turn: &DividedTurn) -> Option<f64> {
    let disc = turn.disc.disc();
    let CamMotion::Law { base: given, .. } = disc.motion else { return None };
    let reaches = |base: f64| disc.rest(base).is_finite();
    if !reaches(given) {
        return None;
    }
    let least = match disc.touch {
        FollowerTip::Point { radius } => radius,
        FollowerTip::Flat { .. } => 0.0,
    };
    let of = |s: &_| sharpness(disc.touch, s);
    let good = |samples: &[CamSample], base: f64| {
        let there = turn.disc.on_base(base);
        let more = CamJet::constant(disc.rest(base) - disc.rest(given));
        let there_too = |&(phi, side, station): &CamSample| {
            (phi, side, station.map(|s| disc.station_of(s.q + more, phi)))
        };
        let samples: Vec<CamSample> = samples.iter().map(there_too).collect();
        greatest(&there, &samples, Ends::Apart, &of, None).is_none_or(|p| -p.value >= least)
    };
    // The sharpest stretch first: the others then are mostly good at once.
    let mut spans: Vec<(f64, &[CamSample])> = turn
        .spans
        .iter()
        .map(|(_, samples)| {
            let sharp = samples.iter().filter_map(|(.., s)| of(s.as_ref()?));
            (sharp.map(|[value, _]| value).fold(f64::NEG_INFINITY, f64::max), samples.as_slice())
        })
        .collect();
    spans.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut base = halved([0.0, given], &reaches);
    let mut largest = given;
    let mut times = 0;
    for (_, samples) in spans {
        if good(samples, base) {
            continue;
        }
        // Equal stretches differ by rounding only.
        let next = base * (1.0 + ACCURACY);
        if good(samples, next) {
            base = next;
            continue;
        }
        while !good(samples, largest) {
            times += 1;
            if times > LARGER {
                return None;
            }
            largest *= 1.5;
        }
        base = halved([base, largest], &|base| good(samples, base));
    }
    Some(base)
}

/// Returns the least number of an interval at which a condition holds; it holds at the end of the
/// interval and from the number on.
fn halved([mut low, mut high]: [f64; 2], holds: &dyn Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if holds(middle) { high = middle } else { low = middle }
    }
    high
}
