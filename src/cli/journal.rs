//! The journal of a table in progress: the job, then one line for each piece that the part file
//! holds.
//!
//! A journal consists of a mark and of JSON lines, each after the CRC-32 of its text. A line is
//! added after its piece has been written. A run that ends at any moment, even in the middle of a
//! line, therefore loses only the current piece, and later changes of the files are detected.
//!
//! This module defines the bytes of a journal, not their place.

use serde::{Deserialize, Serialize};

/// The first bytes of every journal. A file with another beginning belongs to another program.
pub const MARK: &[u8] = b"hodograph journal 1\n";

/// The job.
#[derive(Serialize, Deserialize, Debug, PartialEq)]
pub struct Job {
    /// The description of the job; a different one starts anew.
    pub job: String,
    /// Length of the text before the first row.
    pub begin: u64,
}

/// A piece of the table.
#[derive(Serialize, Deserialize, Debug, PartialEq)]
pub struct JournalEntry {
    /// Number of mechanisms in the part after this piece.
    pub done: u64,
    /// Number of positions of the piece without a row.
    pub missing: u64,
    /// Length of the part after this piece.
    pub bytes: u64,
    /// CRC-32 of its own bytes.
    pub crc: u32,
    /// Number of its rows.
    pub rows: u64,
    /// The data that the end of the table needs from it.
    pub index: Vec<u8>,
}

/// Returns true if a file with this beginning is a journal; an empty one and one that ends within
/// its mark have just been begun.
pub fn is_journal(text: &[u8]) -> bool {
    text.starts_with(MARK) || MARK.starts_with(text)
}

/// Returns a line of a journal.
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

/// The complete lines of a journal.
pub struct Journal {
    pub job: Job,
    /// End of the job's line.
    pub begun: usize,
    /// The pieces, each with the end of its line.
    pub pieces: Vec<(JournalEntry, usize)>,
}

/// Reads a journal; `None` if even its job is incomplete.
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

/// Returns the text of a line with a correct checksum.
fn unwrapped(line: &[u8]) -> Option<&[u8]> {
    let (crc, text) = line.strip_suffix(b"\n")?.split_at_checked(9)?;
    let crc = std::str::from_utf8(crc.strip_suffix(b" ")?).ok()?;
    (u32::from_str_radix(crc, 16).ok()? == crc32fast::hash(text)).then_some(text)
}
