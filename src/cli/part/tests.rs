//! Damaged parts and journals: with any bytes, the result is the table or a refusal.

use super::*;
use crate::report::table::{Csv, TableHead};
use std::time::Instant;

/// Rows of a piece.
const ROWS: usize = 7;
const PIECES: usize = 6;

/// Splitmix64 (Steele, Lea, Flood 2014).
fn next(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

fn format() -> Csv {
    Csv::new(TableHead::new("", [("a".to_owned(), "m"), ("b".to_owned(), "")]))
}

/// The pieces from `done` on, one mechanism each.
fn go_on(part: &mut PartialTable, until: usize) {
    for k in part.done as usize..until {
        let columns: [Vec<f64>; 2] =
            [0, 1].map(|c| (0..ROWS).map(|r| (k * 100 + r * 10 + c) as f64 / 7.0).collect());
        let piece = format().piece_in(&[&columns[0], &columns[1]], TablePiece::default()).unwrap();
        part.add(&piece, k as u64 + 1, 1).unwrap();
    }
}

fn open(out: &Path) -> Result<PartialTable, String> {
    PartialTable::open(out, "job", &format()).map_err(|f| match f {
        Failure::Output(words) => words.en,
        _ => panic!("another failure"),
    })
}

/// Changes bytes as a faulty disk, an editor or an interrupted run might.
fn spoil(bytes: &mut Vec<u8>, state: &mut u64) {
    let mut below = |n: usize| (next(state) % n.max(1) as u64) as usize;
    let at = below(bytes.len());
    match below(6) {
        0 => bytes.truncate(at),
        1 if at < bytes.len() => bytes[at] ^= 1 << below(8),
        2 if at < bytes.len() => bytes[at] = below(256) as u8,
        3 => {
            let end = bytes.len().min(at + below(40));
            bytes.drain(at..end);
        }
        4 => {
            let end = bytes.len().min(at + below(200));
            let piece = bytes[at..end].to_vec();
            bytes.splice(at..at, piece);
        }
        _ => {
            // Replaces one line by another.
            let lines: Vec<Vec<u8>> =
                bytes.split_inclusive(|b| *b == b'\n').map(<[u8]>::to_vec).collect();
            if !lines.is_empty() {
                let (a, b) = (below(lines.len()), below(lines.len()));
                *bytes = lines
                    .iter()
                    .enumerate()
                    .flat_map(|(k, l)| if k == a { lines[b].clone() } else { l.clone() })
                    .collect();
            }
        }
    }
}

#[test]
fn fuzz_journals() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out.csv");
    let (path, journal) = (beside(&out, ".part"), beside(&out, ".part.journal"));
    let mut part = open(&out).unwrap();
    go_on(&mut part, PIECES - 2);
    drop(part);
    let left = [std::fs::read(&path).unwrap(), std::fs::read(&journal).unwrap()];
    let mut part = open(&out).unwrap();
    assert_eq!(
        (part.done, part.changed, part.rows),
        (PIECES as u64 - 2, 0, ((PIECES - 2) * ROWS) as u64)
    );
    go_on(&mut part, PIECES);
    part.finish(&format(), &[], JournalAfter::Removed).unwrap();
    drop(part);
    let whole = std::fs::read(&out).unwrap();

    let number = |key: &str| std::env::var(key).ok().and_then(|v| v.parse::<u64>().ok());
    let (seconds, seed) =
        (number("HODOGRAPH_FUZZ_SECONDS"), number("HODOGRAPH_FUZZ_SEED").unwrap_or(1));
    let most = 300 * number("HODOGRAPH_FUZZ_TIMES").unwrap_or(1);
    let begin = Instant::now();
    let (mut tried, mut refused, mut kept) = (0u64, 0, 0);
    while seconds.map_or(tried < most, |s| begin.elapsed().as_secs() < s) {
        let mut state = seed.wrapping_mul(0x9e37_79b9) ^ tried;
        let mut bytes = left.clone();
        for _ in 0..1 + next(&mut state) % 3 {
            let which = (next(&mut state) % 2) as usize;
            spoil(&mut bytes[which], &mut state);
        }
        std::fs::write(&path, &bytes[0]).unwrap();
        std::fs::write(&journal, &bytes[1]).unwrap();
        match open(&out) {
            Ok(mut part) => {
                kept += part.done;
                go_on(&mut part, PIECES);
                part.finish(&format(), &[], JournalAfter::Removed).unwrap();
                assert_eq!(
                    (part.rows, part.missing),
                    ((PIECES * ROWS) as u64, PIECES as u64),
                    "input {tried}"
                );
                drop(part);
                assert!(
                    std::fs::read(&out).unwrap() == whole,
                    "seed {seed}, input {tried}: another table came out"
                );
                assert!(!path.exists() && !journal.exists(), "input {tried}");
            }
            Err(words) => {
                refused += 1;
                assert!(words.contains("in the way"), "input {tried}: {words}");
                assert!(
                    std::fs::read(&path).unwrap() == bytes[0],
                    "input {tried}: a file that is not ours was changed"
                );
            }
        }
        tried += 1;
    }
    println!(
        "journals: {tried} inputs, {refused} of them refused, {kept} of {} pieces kept, {:.0?}",
        tried * (PIECES as u64 - 2),
        begin.elapsed()
    );
    assert!(kept > 0 && refused > 0);
}

/// The second of two simultaneous runs of one job is refused, whatever the first does.
#[test]
fn a_part_is_opened_once() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out.csv");
    let first = open(&out).unwrap();
    assert!(open(&out).err().unwrap().contains("another run is writing it"));
    drop(first);
    open(&out).unwrap();
}
