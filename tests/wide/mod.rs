//! The extent of a test: with `HODOGRAPH_WIDE=1`, as in the gate, it covers all of its cases;
//! otherwise an even part of them, always the same, so that the tests of a fresh clone take minutes
//! of processor time.

/// Returns the number of cases of which one is examined: `most`, usually eight, or 1 in a wide run.
pub fn every(most: usize) -> usize {
    if std::env::var("HODOGRAPH_WIDE").is_ok_and(|v| v == "1") { 1 } else { most }
}
