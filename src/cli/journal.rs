//! The journal of a table under way: what was asked, then a line for each piece that is in the part.
//!
//! A mark, then lines of JSON, each behind the CRC-32 of its text. A line is added when its piece has been written, so that a run that
//! ends at any moment, in the middle of a line too, loses the piece under way only; and what has been changed since is found.
//!
//! Decided here: what the bytes of a journal say. Not decided here: where they are.

use serde::{Deserialize, Serialize};

/// How every journal begins. A file that begins otherwise is somebody else's.
pub const MARK: &[u8] = b"hodograph journal 1\n";

/// What was asked.
#[derive(Serialize, Deserialize, Debug, PartialEq)]
pub struct Job {
    /// Another question begins anew.
    pub job: String,
    /// Length of what stands before the first row.
    pub begin: u64,
}

/// A piece of the table.
#[derive(Serialize, Deserialize, Debug, PartialEq)]
pub struct Entry {
    /// Mechanisms whose rows are in the part with it.
    pub done: u64,
    /// Positions of it that have no row.
    pub missing: u64,
    /// Length of the part with it.
    pub bytes: u64,
    /// CRC-32 of its own bytes.
    pub crc: u32,
    /// Its rows.
    pub rows: u64,
    /// What the end of the table has to know of it.
    pub index: Vec<u8>,
}

/// Whether a file that begins so is a journal: an empty one and one that ends within its mark are journals that were just begun.
pub fn is_journal(text: &[u8]) -> bool {
    text.starts_with(MARK) || MARK.starts_with(text)
}

/// A line of a journal.
///
/// # Errors
/// Those of the JSON writer.
pub fn line(of: &impl Serialize) -> serde_json::Result<Vec<u8>> {
    let text = serde_json::to_vec(of)?;
    let mut line = format!("{:08x} ", crc32fast::hash(&text)).into_bytes();
    line.extend(text);
    line.push(b'\n');
    Ok(line)
}

/// What a journal says, as far as it is whole.
pub struct Journal {
    pub job: Job,
    /// Where the job's line ends.
    pub begun: usize,
    /// The pieces, each with the place at which its line ends.
    pub pieces: Vec<(Entry, usize)>,
}

/// Reads a journal; `None` where not even its job is whole.
pub fn read(text: &[u8]) -> Option<Journal> {
    let mut at = MARK.len();
    let mut rest = text.strip_prefix(MARK)?;
    let mut next = || {
        let (line, behind) = rest.split_at_checked(rest.iter().position(|b| *b == b'\n')? + 1)?;
        (rest, at) = (behind, at + line.len());
        Some((unwrapped(line)?, at))
    };
    let (first, begun) = next()?;
    let job = serde_json::from_slice(first).ok()?;
    let mut pieces = Vec::new();
    while let Some((line, end)) = next() {
        let Ok(entry) = serde_json::from_slice(line) else { break };
        pieces.push((entry, end));
    }
    Some(Journal { job, begun, pieces })
}

/// The text of a line whose checksum is right.
fn unwrapped(line: &[u8]) -> Option<&[u8]> {
    let (crc, text) = line.strip_suffix(b"\n")?.split_at_checked(9)?;
    let crc = std::str::from_utf8(crc.strip_suffix(b" ")?).ok()?;
    (u32::from_str_radix(crc, 16).ok()? == crc32fast::hash(text)).then_some(text)
}
