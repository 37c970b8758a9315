//! Extremes over a turn: sampled between corners, each then solved as the zero of a derivative.

use super::survey::PhiExtreme;
use super::{CamStation, PieceSide, PreparedDisc, in_turn};
use std::borrow::Cow;
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

/// An angle of the cam, the side from which it is seen, and the state there; `None` if the follower
/// touches nothing.
pub(super) type CamSample = (f64, PieceSide, Option<CamStation>);

/// A turn divided at its corners, with the states at angles through each part.
pub(super) struct DividedTurn<'a> {
    /// The disc.
    pub disc: &'a PreparedDisc<'a>,
    /// The angles of the corners.
    pub corners: Vec<f64>,
    /// The intervals between successive corners, with their samples.
    pub spans: Vec<([f64; 2], Vec<CamSample>)>,
}

/// A quantity of a state, with its derivative by φ.
pub(super) type OfStation<'f> = dyn Fn(&CamStation) -> Option<[f64; 2]> + 'f;

/// Returns the states through a span; its ends are seen from inside the span.
fn sampled(disc: &PreparedDisc, [from, to]: [f64; 2]) -> Vec<CamSample> {
    let at = |k: usize| match k {
        0 => (from, PieceSide::After),
        SAMPLES => (to, PieceSide::Before),
        k => (from + (to - from) * k as f64 / SAMPLES as f64, PieceSide::After),
    };
    (0..=SAMPLES).map(at).map(|(phi, side)| (phi, side, disc.station(phi, side))).collect()
}

impl<'a> DividedTurn<'a> {
    /// Returns the turn of a disc.
    pub fn of(disc: &'a PreparedDisc<'a>) -> Self {
        let corners = disc.corners();
        let mut at = if corners.is_empty() { vec![0.0] } else { corners.clone() };
        at.dedup_by(|a, b| (*a - *b).abs() < 1e-10);
        let ends: Vec<f64> = at.iter().skip(1).copied().chain([at[0] + TAU]).collect();
        let spans = at
            .into_iter()
            .zip(ends)
            .filter(|(a, b)| b - a > 1e-10)
            .map(|(a, b)| ([a, b], sampled(disc, [a, b])))
            .collect();
        DividedTurn { disc, corners, spans }
    }

    /// Returns all samples, in order.
    pub fn samples(&self) -> impl Iterator<Item = &CamSample> {
        self.spans.iter().flat_map(|(_, samples)| samples)
    }

    /// Returns the samples of a span, which is a span of this turn or another one.
    pub fn samples_of(&self, span: [f64; 2]) -> Cow<'_, [CamSample]> {
        let k = self.spans.partition_point(|([from, _], _)| *from < span[0]);
        match self.spans.get(k) {
            Some((own, samples)) if *own == span => Cow::Borrowed(samples),
            Some(_) | None => Cow::Owned(sampled(self.disc, span)),
        }
    }

    /// Returns the greatest value of a quantity over the turn.
    pub fn best(&self, f: &OfStation) -> Option<Peak> {
        let mut most = None;
        // Without corners the turn has no ends: the samples extend one step beyond its start.
        if self.corners.is_empty() {
            for ([from, to], samples) in &self.spans {
                let beyond = to + (to - from) / SAMPLES as f64;
                let last = (beyond, PieceSide::After, self.disc.station(beyond, PieceSide::After));
                let samples: Vec<CamSample> = samples.iter().copied().chain([last]).collect();
                most = greatest(self.disc, &samples, Ends::Joined, f, most);
            }
        } else {
            for (_, samples) in &self.spans {
                most = greatest(self.disc, samples, Ends::Apart, f, most);
            }
        }
        most.or_else(|| self.first(f))
    }

    /// Returns the value of a quantity at the start of the turn.
    pub fn first(&self, f: &OfStation) -> Option<Peak> {
        let [value, _] = f(&self.disc.station(0.0, PieceSide::After)?)?;
        Some(Peak { phi: 0.0, side: PieceSide::After, value })
    }
}

/// The relation between the ends of some samples.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Ends {
    /// The samples go once round and one step farther.
    Joined,
    /// The samples begin and end at corners.
    Apart,
}

/// Returns the greatest value of a quantity, if it is greater than a known one, else that: at an
/// end of the samples, or between two of them where the derivative passes through zero from above.
pub(super) fn greatest(
    disc: &PreparedDisc,
    samples: &[CamSample],
    ends: Ends,
    f: &OfStation,
    mut most: Option<Peak>,
) -> Option<Peak> {
    let mut consider = |phi: f64, side: PieceSide, value: f64| {
        // Of equal values the first is taken.
        if most.is_none_or(|m| value > m.value + 1e-13 * m.value.abs()) {
            most = Some(Peak { phi: in_turn(phi), side, value });
        }
    };
    let at = |phi: f64| disc.station(phi, PieceSide::After).as_ref().and_then(f);
    let mut samples =
        samples.iter().map(|(phi, side, s)| (*phi, *side, s.as_ref().and_then(f))).peekable();
    let mut start = true;
    while let Some((phi, side, here)) = samples.next() {
        let next = samples.peek();
        let end = start || next.is_none();
        if let Some([value, slope]) = here {
            // Of a constant value the first angle is taken.
            if end && ends == Ends::Apart || start && slope == 0.0 {
                consider(phi, side, value);
            }
            if let Some(&(next, _, Some([_, then]))) = next
                && slope > 0.0
                && then <= 0.0
            {
                let at_zero = zero([phi, next], |phi| at(phi).map(|v| v[1]));
                if let Some([value, _]) = at(at_zero) {
                    consider(at_zero, PieceSide::After, value);
                }
            }
        }
        start = false;
    }
    most
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
