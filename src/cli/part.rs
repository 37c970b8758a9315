//! A long table under way: the file beside the output that grows piece by piece, and its journal, by which a run that was
//! interrupted goes on where it was left.
//!
//! The journal is a file of lines of JSON: what was asked, then a line for each piece that is in the part. A line is added when
//! its piece has been written, so that a run that ends at any moment, in the middle of a line too, loses the piece under way only.

use crate::diag::Diagnostic;
use crate::report::table::{Format, Piece, Standing};
use serde::{Deserialize, Serialize};
use std::ffi::OsString;
use std::fs::{File, OpenOptions};
use std::io::{self, BufRead, BufReader, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// The first line of a journal.
#[derive(Serialize, Deserialize)]
struct Job {
    /// What was asked: another question begins anew.
    job: String,
    /// Length of what stands before the first row.
    begin: u64,
}

/// A further line: a piece of the table.
#[derive(Serialize, Deserialize)]
struct Entry {
    /// Mechanisms whose rows are in the file with it.
    done: u64,
    /// Positions of it that have no row.
    missing: u64,
    /// Length of the file with it.
    bytes: u64,
    rows: u64,
    index: Vec<u8>,
}

/// The table under way.
pub struct Part {
    path: PathBuf,
    file: File,
    journal: File,
    pieces: Vec<Standing>,
    bytes: u64,
    /// Mechanisms whose rows are in the file.
    pub done: u64,
    /// Rows in the file.
    pub rows: u64,
    /// Positions without a row so far.
    pub missing: u64,
}

impl Part {
    /// Opens the part of an output, and goes on where the same job was left.
    pub fn open(out: &Path, job: &str, format: &dyn Format) -> io::Result<Part> {
        if let Some(folder) = out.parent().filter(|p| !p.as_os_str().is_empty()) {
            std::fs::create_dir_all(folder)?;
        }
        let path = beside(out, ".part");
        let begin = format.begin(0, &[]);
        let open = |path: &Path| OpenOptions::new().create(true).truncate(false).read(true).write(true).open(path);
        let (file, mut journal) = (open(&path)?, open(&beside(&path, ".journal"))?);
        let first = Job { job: job.to_owned(), begin: begin.len() as u64 };
        let mut part =
            Part { path, file, journal: journal.try_clone()?, pieces: Vec::new(), bytes: first.begin, done: 0, rows: 0, missing: 0 };
        let kept = part.recall(&mut journal, &first)?;
        journal.set_len(kept)?;
        journal.seek(SeekFrom::Start(kept))?;
        part.file.set_len(if kept > 0 { part.bytes } else { 0 })?;
        part.file.seek(SeekFrom::Start(if kept > 0 { part.bytes } else { 0 }))?;
        if kept == 0
            && let Err(e) = part.file.write_all(&begin).and_then(|()| part.note(&first))
        {
            part.remove();
            return Err(e);
        }
        Ok(part)
    }

    /// Reads the journal as far as it is whole and its pieces are in the file; returns how long that much of it is.
    fn recall(&mut self, journal: &mut File, job: &Job) -> io::Result<u64> {
        let length = self.file.metadata()?.len();
        let mut lines = BufReader::new(journal);
        let (mut kept, mut line) = (0, Vec::new());
        while lines.read_until(b'\n', &mut line)? > 0 && line.ends_with(b"\n") {
            let known = if kept == 0 {
                serde_json::from_slice::<Job>(&line).is_ok_and(|j| j.job == job.job && j.begin == job.begin && length >= j.begin)
            } else {
                serde_json::from_slice::<Entry>(&line).is_ok_and(|e| e.bytes <= length && self.take(e))
            };
            if !known {
                break;
            }
            kept += line.len() as u64;
            line.clear();
        }
        Ok(kept)
    }

    /// Counts a piece in; not one that goes backward.
    fn take(&mut self, entry: Entry) -> bool {
        if entry.bytes < self.bytes || entry.done < self.done {
            return false;
        }
        if entry.rows > 0 {
            self.pieces.push(Standing { offset: self.bytes, rows: entry.rows, index: entry.index });
        }
        (self.bytes, self.done) = (entry.bytes, entry.done);
        self.rows += entry.rows;
        self.missing += entry.missing;
        true
    }

    fn note(&mut self, line: &impl Serialize) -> io::Result<()> {
        let mut text = serde_json::to_vec(line)?;
        text.push(b'\n');
        self.journal.write_all(&text)
    }

    /// Adds a piece, with which `done` mechanisms are in the file.
    pub fn add(&mut self, piece: &Piece, done: u64, missing: u64) -> io::Result<()> {
        if piece.rows > 0 {
            piece.write(&mut self.file)?;
        }
        let added = if piece.rows > 0 { piece.length() } else { 0 };
        let entry = Entry { done, missing, bytes: self.bytes + added, rows: piece.rows, index: piece.index.clone() };
        self.note(&entry)?;
        self.take(entry);
        Ok(())
    }

    /// Removes what is there. What cannot be removed is left; its name says what it is.
    pub fn remove(&self) {
        let _ = std::fs::remove_file(&self.path);
        let _ = std::fs::remove_file(beside(&self.path, ".journal"));
    }

    /// Ends the table and gives it its name.
    pub fn finish(&mut self, out: &Path, format: &dyn Format, notes: &[Diagnostic]) -> io::Result<()> {
        self.file.write_all(&format.end(&self.pieces, notes)?)?;
        self.file.seek(SeekFrom::Start(0))?;
        self.file.write_all(&format.begin(self.rows, &[]))?;
        self.file.sync_all()?;
        std::fs::rename(&self.path, out)?;
        let _ = std::fs::remove_file(beside(&self.path, ".journal"));
        Ok(())
    }
}

/// A name with more behind it.
fn beside(path: &Path, more: &str) -> PathBuf {
    let mut name = OsString::from(path);
    name.push(more);
    name.into()
}
