//! Extremes over a turn: sampled between corners, each then solved as the zero of a derivative.

use super::survey::PhiExtreme;
use super::{Disc, PieceSide, in_turn};
use std::f64::consts::TAU;

/// Number of samples between two corners.
const SAMPLES: usize = 240;

/// An extreme with the side of a joint from which it is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// The angle of the cam (rad), from 0 on.
    pub phi: f64,
    /// At a joint, the side on which the value is taken.
    pub side: PieceSide,
    /// The value.
    pub value: f64,
}

impl Peak {
    /// Returns the extreme without the side.
    pub(super) fn extreme(self) -> PhiExtreme {
        (self.phi, self.value)
    }
}

/// A turn divided at its corners.
pub(super) struct DividedTurn {
    /// The angles of the corners.
    pub corners: Vec<f64>,
    /// The intervals between successive corners.
    pub spans: Vec<[f64; 2]>,
}

/// Returns angles through a span; the ends are seen from inside the span.
pub(super) fn sampled([from, to]: [f64; 2]) -> impl Iterator<Item = (f64, PieceSide)> {
    (0..=SAMPLES).map(move |k| match k {
        0 => (from, PieceSide::After),
        SAMPLES => (to, PieceSide::Before),
        k => (from + (to - from) * k as f64 / SAMPLES as f64, PieceSide::After),
    })
}

impl DividedTurn {
    /// Returns the turn of a disc.
    pub fn of(disc: &Disc) -> DividedTurn {
        let corners = disc.corners();
        let mut at = if corners.is_empty() { vec![0.0] } else { corners.clone() };
        at.dedup_by(|a, b| (*a - *b).abs() < 1e-10);
        let ends: Vec<f64> = at.iter().skip(1).copied().chain([at[0] + TAU]).collect();
        let spans =
            at.into_iter().zip(ends).map(|(a, b)| [a, b]).filter(|[a, b]| b - a > 1e-10).collect();
        DividedTurn { corners, spans }
    }

    /// Returns the greatest value of a function, given with its derivative by φ: at an end of a
    /// span, seen from inside, or between two samples where the derivative passes through zero from
    /// above.
    pub fn best(&self, f: impl Fn(f64, PieceSide) -> Option<[f64; 2]>) -> Option<Peak> {
        let mut most: Option<Peak> = None;
        let mut consider = |phi: f64, side: PieceSide, value: f64| {
            // Of equal values the first is taken.
            if most.is_none_or(|m| value > m.value + 1e-13 * m.value.abs()) {
                most = Some(Peak { phi: in_turn(phi), side, value });
            }
        };
        // Without corners the turn has no ends: the samples extend one step beyond its start.
        let round = self.corners.is_empty();
        for &[from, to] in &self.spans {
            let beyond = round.then(|| (to + (to - from) / SAMPLES as f64, PieceSide::After));
            let samples: Vec<(f64, PieceSide, Option<[f64; 2]>)> = sampled([from, to])
                .chain(beyond)
                .map(|(phi, side)| (phi, side, f(phi, side)))
                .collect();
            for (k, &(phi, side, here)) in samples.iter().enumerate() {
                let Some([value, slope]) = here else { continue };
                let end = k == 0 || k + 1 == samples.len();
                // Of a constant value the first angle is taken.
                if end && !round || k == 0 && slope == 0.0 {
                    consider(phi, side, value);
                }
                let Some(&(next, _, Some([_, then]))) = samples.get(k + 1) else { continue };
                if slope > 0.0 && then <= 0.0 {
                    let at = zero([phi, next], |phi| f(phi, PieceSide::After).map(|v| v[1]));
                    if let Some([value, _]) = f(at, PieceSide::After) {
                        consider(at, PieceSide::After, value);
                    }
                }
            }
        }
        most.or_else(|| {
            f(0.0, PieceSide::After).map(|[value, _]| Peak {
                phi: 0.0,
                side: PieceSide::After,
                value,
            })
        })
    }
}

/// Returns the zero of a function that is positive at the first end and not at the second, by
/// bisection, to rounding.
pub(super) fn zero([mut a, mut b]: [f64; 2], f: impl Fn(f64) -> Option<f64>) -> f64 {
    loop {
        let middle = 0.5 * (a + b);
        if middle <= a || middle >= b {
            return b;
        }
        match f(middle) {
            Some(v) if v > 0.0 => a = middle,
            Some(_) => b = middle,
            None => return middle,
        }
    }
}
