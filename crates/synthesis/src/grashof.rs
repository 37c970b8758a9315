//! Ranges of one length of a four-bar for each of Grashof's types, the three others constant.
//!
//! Let p ≤ q ≤ r be the others. The linkage closes for r − p − q < x < p + q + r. Its type changes
//! where the shortest and the longest together equal the two others (x = p + q − r, x = p + r − q or
//! x = q + r − p, the change points), and where x becomes the shortest, x = p. Between two such
//! places the type is constant, so that a single length between them determines it.

use hodograph_base::diag::{Diagnostic, both};
use hodograph_base::digits::metres;
use hodograph_sweep::extreme::{Grashof, grashof_of};

/// The lengths of a four-bar, by their function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FourBarLength {
    /// The driven crank.
    Driver,
    /// The coupler.
    Coupler,
    /// The other crank.
    Output,
    /// The frame, between the fixed pivots.
    Frame,
}

impl FourBarLength {
    /// All lengths, in the order of the lengths of a four-bar.
    pub const ALL: [FourBarLength; 4] = [
        FourBarLength::Driver,
        FourBarLength::Coupler,
        FourBarLength::Output,
        FourBarLength::Frame,
    ];
}

/// A range of a length in which the linkage has one type; at its ends the type changes, or the
/// linkage does not close.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The type of the linkage.
    pub kind: Grashof,
    /// The start (m).
    pub from: f64,
    /// The end (m).
    pub to: f64,
    /// True if it ends in a change point.
    pub change_point: bool,
}

/// The ranges of one length in order, the three others constant; empty if they close with none.
///
/// ```
/// use hodograph_sweep::extreme::Grashof;
/// use hodograph_synthesis::grashof::{FourBarLength, ranges};
/// // A course problem: coupler 50, output 35, frame 30; for which cranks is it a crank-rocker?
/// let all = ranges([0.0, 0.050, 0.035, 0.030], FourBarLength::Driver)?;
/// assert_eq!(all[0].kind, Grashof::CrankRocker);
/// assert!((all[0].to - 0.015).abs() < 1e-15 && all[0].change_point);
/// # Ok::<(), hodograph_base::diag::Diagnostic>(())
/// ```
///
/// # Errors
/// A length that is not greater than zero.
pub fn ranges(lengths: [f64; 4], which: FourBarLength) -> Result<Vec<Range>, Diagnostic> {
    let k = which as usize;
    let mut others: Vec<f64> = (0..4).filter(|i| *i != k).map(|i| lengths[i]).collect();
    if let Some(bad) = others.iter().find(|l| !(**l > 0.0 && l.is_finite())) {
        let message = both!("a length of {} is none: all are greater than zero", metres(*bad));
        return Err(Diagnostic::error("not-positive", message));
    }
    others.sort_by(f64::total_cmp);
    let [p, q, r] = [others[0], others[1], others[2]];
    let (low, high) = ((r - p - q).max(0.0), p + q + r);
    let changes = [p + q - r, p + r - q, q + r - p];
    // Sums that differ by rounding are equal.
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-12 * high;
    let mut places: Vec<f64> =
        changes.into_iter().chain([p, low, high]).filter(|x| *x >= low && *x <= high).collect();
    places.sort_by(f64::total_cmp);
    places.dedup_by(|a, b| near(*a, *b));
    let mut out: Vec<Range> = Vec::new();
    for w in places.windows(2) {
        let mut all = lengths;
        all[k] = 0.5 * (w[0] + w[1]);
        let (kind, to) = (grashof_of(all), w[1]);
        let change_point = to < high && changes.iter().any(|c| near(*c, to));
        match out.last_mut() {
            // The type is the same, and no change point separates the ranges.
            Some(last) if last.kind == kind && !last.change_point => {
                (last.to, last.change_point) = (to, change_point)
            }
            _ => out.push(Range { kind, from: w[0], to, change_point }),
        }
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares with the rule itself, at lengths all over the range: Grashof's inequality written
    /// out, and the shortest link.
    #[test]
    fn every_length_has_the_type_of_its_range() {
        let mut seed = 7u64;
        let mut unit = move || {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1u64 << 53) as f64
        };
        for _ in 0..300 {
            let lengths = [0; 4].map(|_| 0.02 + 0.2 * unit());
            for which in FourBarLength::ALL {
                let all = ranges(lengths, which).unwrap();
                let rest: f64 = (0..4).filter(|i| *i != which as usize).map(|i| lengths[i]).sum();
                assert!((all.last().unwrap().to - rest).abs() < 1e-12);
                for w in all.windows(2) {
                    assert_eq!(w[0].to, w[1].from);
                    assert!(w[0].kind != w[1].kind || w[0].change_point);
                }
                for _ in 0..20 {
                    let mut l = lengths;
                    l[which as usize] = all[0].from + (rest - all[0].from) * unit();
                    let mut sorted = l;
                    sorted.sort_by(f64::total_cmp);
                    let turns = sorted[0] + sorted[3] < sorted[1] + sorted[2];
                    let shortest = (0..4).find(|i| l[*i] == sorted[0]).unwrap();
                    let wanted = match (turns, shortest) {
                        (false, _) => Grashof::TripleRocker,
                        (true, 0) => Grashof::CrankRocker,
                        (true, 1) => Grashof::DoubleRocker,
                        (true, 2) => Grashof::RockerCrank,
                        (true, _) => Grashof::DoubleCrank,
                    };
                    let x = l[which as usize];
                    let found = all.iter().find(|r| r.from <= x && x <= r.to).unwrap();
                    assert_eq!(found.kind, wanted, "{l:?} {which:?} {all:?}");
                }
            }
        }
    }

    #[test]
    fn a_length_that_is_none_is_refused() {
        assert_eq!(
            ranges([0.1, 0.2, -0.1, 0.2], FourBarLength::Driver).unwrap_err().code,
            "not-positive"
        );
        assert!(ranges([-0.1, 0.2, 0.1, 0.2], FourBarLength::Driver).is_ok());
    }
}
