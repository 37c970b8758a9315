//! How much a test looks at: with `HODOGRAPH_WIDE=1`, as in the gate, at all of its cases; else at an even part of them, always the same, so that
//! the tests of a fresh clone take minutes of the processor.

/// Of how many cases one is looked at: as many as are told, eight where nothing speaks for fewer.
pub fn every(most: usize) -> usize {
    if std::env::var("HODOGRAPH_WIDE").is_ok_and(|v| v == "1") { 1 } else { most }
}
