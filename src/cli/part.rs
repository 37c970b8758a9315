//! A long table in progress: the file beside the output that grows piece by piece, and its
//! [`journal`], from which an interrupted run continues.
//!
//! The journal is locked during a run, so that two runs never write one table. Both files are
//! opened by their own names, never through a link, and only if a journal of this program shows
//! that they belong to it.

use super::Failure;
use super::files::FileRefusal;
use super::journal::{self, Job, JournalEntry};
use super::target::{OutputTarget, as_before, has_name, unwritable};
use crate::diag::{Both, Diagnostic, both};
use crate::report::table::{PiecePlace, RowFormat, TablePiece};
use std::ffi::OsString;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// The table in progress.
pub struct PartialTable {
    target: OutputTarget,
    path: PathBuf,
    file: File,
    journal: File,
    /// Folder of the part for a pipe or a device; it is removed at the end of the run.
    _folder: Option<TempDir>,
    pieces: Vec<PiecePlace>,
    bytes: u64,
    /// Number of mechanisms in the file.
    pub done: u64,
    /// Number of rows in the file.
    pub rows: u64,
    /// Number of positions without a row.
    pub missing: u64,
    /// Number of mechanisms of an earlier run with bytes that have been changed since.
    pub changed: u64,
}

impl PartialTable {
    /// Opens the part of an output, and continues where the same job was left.
    pub fn open(out: &Path, job: &str, format: &dyn RowFormat) -> Result<PartialTable, Failure> {
        let target = OutputTarget::of(out)?;
        PartialTable::opened(out, target, job, format).map_err(|e| unwritable(out, &e))
    }

    fn opened(
        out: &Path,
        target: OutputTarget,
        job: &str,
        format: &dyn RowFormat,
    ) -> io::Result<PartialTable> {
        let (path, folder) = match &target {
            OutputTarget::File(file) => (beside(file, ".part"), None),
            OutputTarget::Stream(_) | OutputTarget::Stdout => {
                let folder = tempfile::tempdir()?;
                (folder.path().join("table.part"), Some(folder))
            }
        };
        let mut journal = claimed(&beside(&path, ".journal"))?;
        let mut text = Vec::new();
        journal.read_to_end(&mut text)?;
        let begin = format.begin(0, &[]);
        let job = Job { job: job.to_owned(), begin: begin.len() as u64 };
        let begun = text.len() >= journal::MARK.len();
        let found = own(&path).and_then(|file| match file {
            Some(_) if !begun => Err(stranger(&path, both!("no journal tells of it"))),
            found => Ok(found),
        });
        let file = match found {
            Ok(Some(file)) => file,
            Ok(None) => {
                let made = begun_anew((!begun).then_some(&mut journal), &path, out);
                if !begun {
                    text = journal::MARK.to_vec();
                    if made.is_err() {
                        let _ = std::fs::remove_file(beside(&path, ".journal"));
                    }
                }
                made?
            }
            Err(e) => {
                if !begun {
                    let _ = std::fs::remove_file(beside(&path, ".journal"));
                }
                return Err(e);
            }
        };
        let bytes = job.begin;
        let mut part = PartialTable {
            target,
            path,
            file,
            journal,
            _folder: folder,
            pieces: Vec::new(),
            bytes,
            done: 0,
            rows: 0,
            missing: 0,
            changed: 0,
        };
        if let Err(e) = part.go_on(&job, &begin, &text) {
            part.remove();
            return Err(e);
        }
        Ok(part)
    }

    /// Keeps the valid pieces of an earlier run of the same job, and truncates both files behind
    /// them.
    fn go_on(&mut self, job: &Job, begin: &[u8], text: &[u8]) -> io::Result<()> {
        let kept = match journal::read(text) {
            Some(known) if known.job == *job => self.recall(known.begun, known.pieces)?,
            _ => journal::MARK.len(),
        };
        self.journal.set_len(kept as u64)?;
        self.journal.seek(SeekFrom::Start(kept as u64))?;
        if kept == journal::MARK.len() {
            self.journal.write_all(&journal::line(job)?)?;
        }
        // The text before the rows is known without reading it; a run that ended while it wrote the
        // number of rows may have changed it.
        self.file.set_len(self.bytes)?;
        self.file.seek(SeekFrom::Start(0))?;
        self.file.write_all(begin)?;
        self.file.seek(SeekFrom::Start(self.bytes))?;
        Ok(())
    }

    /// Counts the pieces with unchanged bytes; returns their length in the journal.
    fn recall(&mut self, begun: usize, entries: Vec<(JournalEntry, usize)>) -> io::Result<usize> {
        let mut kept = begun;
        let all = entries.last().map_or(0, |(e, _)| e.done);
        let mut file = io::BufReader::with_capacity(1 << 20, self.file.try_clone()?);
        file.seek(SeekFrom::Start(self.bytes))?;
        for (entry, end) in entries {
            let forward = entry.bytes >= self.bytes && entry.done > self.done;
            if !forward || crc_of(&mut file, entry.bytes - self.bytes)? != Some(entry.crc) {
                break;
            }
            self.take(entry);
            kept = end;
        }
        self.changed = all.saturating_sub(self.done);
        Ok(kept)
    }

    /// Counts a piece.
    fn take(&mut self, entry: JournalEntry) {
        if entry.rows > 0 {
            self.pieces.push(PiecePlace {
                offset: self.bytes,
                rows: entry.rows,
                index: entry.index,
            });
        }
        (self.bytes, self.done) = (entry.bytes, entry.done);
        self.rows += entry.rows;
        self.missing += entry.missing;
    }

    /// Adds a piece, after which the file holds `done` mechanisms.
    pub fn add(&mut self, piece: &TablePiece, done: u64, missing: u64) -> io::Result<()> {
        let mut entry = JournalEntry {
            done,
            missing,
            bytes: self.bytes,
            crc: 0,
            rows: piece.rows,
            index: piece.index.clone(),
        };
        if piece.rows > 0 {
            piece.write(&mut self.file)?;
            let mut crc = crc32fast::Hasher::new();
            piece.parts.iter().for_each(|p| crc.update(p));
            (entry.bytes, entry.crc) = (self.bytes + piece.length(), crc.finalize());
        }
        self.journal.write_all(&journal::line(&entry)?)?;
        self.take(entry);
        Ok(())
    }

    /// Returns true if the same command can continue from here in a later run.
    pub fn stays(&self) -> bool {
        matches!(self.target, OutputTarget::File(_))
    }

    /// Removes part and journal. A file that cannot be removed stays; its name identifies it.
    pub fn remove(&self) {
        let _ = std::fs::remove_file(&self.path);
        let _ = std::fs::remove_file(beside(&self.path, ".journal"));
    }

    /// Ends the table and gives it its final name. The journal is removed, or keeps the table's
    /// record beside it ([`FinishedTable`]).
    pub fn finish(
        &mut self,
        format: &dyn RowFormat,
        notes: &[Diagnostic],
        after: JournalAfter,
    ) -> io::Result<()> {
        self.file.write_all(&format.end(&self.pieces, notes)?)?;
        self.file.seek(SeekFrom::Start(0))?;
        self.file.write_all(&format.begin(self.rows, &[]))?;
        match &self.target {
            OutputTarget::File(out) => {
                self.file.sync_all()?;
                as_before(&self.file, out)?;
                std::fs::rename(&self.path, out)?;
                let journal = beside(&self.path, ".journal");
                match after {
                    JournalAfter::Removed => drop(std::fs::remove_file(journal)),
                    JournalAfter::Kept => {
                        self.journal.sync_all()?;
                        std::fs::rename(journal, beside(out, ".journal"))?;
                    }
                }
            }
            target => target.take(&mut self.file)?,
        }
        Ok(())
    }
}

/// The journal of a finished table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JournalAfter {
    Removed,
    /// It stays beside the table, under the table's name with `.journal`.
    Kept,
}

/// A finished table with the journal that was kept of it.
pub struct FinishedTable {
    file: File,
    begin: u64,
    entries: Vec<JournalEntry>,
}

impl FinishedTable {
    /// Opens a table of `mechanisms` mechanisms that a run of this job has finished; `None` without
    /// one.
    pub fn open(out: &Path, job: &str, mechanisms: u64) -> Option<FinishedTable> {
        let journal = journal::read(&std::fs::read(beside(out, ".journal")).ok()?)?;
        let file = File::open(out).ok()?;
        let entries: Vec<JournalEntry> = journal.pieces.into_iter().map(|(e, _)| e).collect();
        let last = entries.last()?;
        let whole = journal.job.job == job
            && last.done == mechanisms
            && file.metadata().ok()?.len() >= last.bytes;
        whole.then_some(FinishedTable { file, begin: journal.job.begin, entries })
    }

    /// Removes a table and its journal, if they exist.
    pub fn remove(out: &Path) -> io::Result<()> {
        for path in [out.to_owned(), beside(out, ".journal")] {
            match std::fs::remove_file(path) {
                Err(e) if e.kind() != io::ErrorKind::NotFound => return Err(e),
                _ => {}
            }
        }
        Ok(())
    }

    /// The number of rows.
    pub fn rows(&self) -> u64 {
        self.entries.iter().map(|e| e.rows).sum()
    }

    /// The number of positions without a row.
    pub fn missing(&self) -> u64 {
        self.entries.iter().map(|e| e.missing).sum()
    }

    /// Adds the checksum of all rows to that of the tables before.
    pub fn add_checksum(&self, sum: &mut crc32fast::Hasher) {
        let mut at = self.begin;
        for e in self.entries.iter().filter(|e| e.rows > 0) {
            sum.combine(&crc32fast::Hasher::new_with_initial_len(e.crc, e.bytes - at));
            at = e.bytes;
        }
    }

    /// Copies the pieces to the end of a table and adds their places. Returns false at the first
    /// piece whose bytes have changed.
    pub fn copy(
        &mut self,
        out: &mut dyn Write,
        places: &mut Vec<PiecePlace>,
        end: &mut u64,
    ) -> io::Result<bool> {
        let mut at = self.begin;
        let mut file = io::BufReader::with_capacity(1 << 16, &self.file);
        file.seek(SeekFrom::Start(at))?;
        for e in self.entries.iter().filter(|e| e.rows > 0) {
            let mut bytes = Vec::new();
            let length = e.bytes.saturating_sub(at);
            Read::by_ref(&mut file).take(length).read_to_end(&mut bytes)?;
            if bytes.len() as u64 != length || crc32fast::hash(&bytes) != e.crc {
                return Ok(false);
            }
            out.write_all(&bytes)?;
            places.push(PiecePlace { offset: *end, rows: e.rows, index: e.index.clone() });
            (at, *end) = (e.bytes, *end + length);
        }
        Ok(true)
    }

    /// Returns true if every byte is as it was written.
    pub fn is_sound(&mut self, format: &dyn RowFormat, notes: &[Diagnostic]) -> io::Result<bool> {
        let begin = format.begin(self.rows(), &[]);
        let (mut places, mut length) = (Vec::new(), self.begin);
        if !self.copy(&mut io::sink(), &mut places, &mut length)? {
            return Ok(false);
        }
        let end = format.end(&places, notes)?;
        let (mut first, mut last) = (Vec::new(), Vec::new());
        self.file.seek(SeekFrom::Start(0))?;
        (&self.file).take(self.begin).read_to_end(&mut first)?;
        self.file.seek(SeekFrom::Start(length))?;
        (&self.file).take(end.len() as u64 + 1).read_to_end(&mut last)?;
        Ok(first == begin && last == end)
    }
}

/// Starts a new part. The journal is begun first if necessary: a part without one belongs to
/// another program.
fn begun_anew(journal: Option<&mut File>, path: &Path, out: &Path) -> io::Result<File> {
    if let Some(journal) = journal {
        journal.seek(SeekFrom::Start(0))?;
        journal.write_all(journal::MARK)?;
    }
    let file = created(path)?;
    // Permissions are set before the first byte, so that a protected file is not readable while it
    // is written.
    if let Err(e) = as_before(&file, out) {
        let _ = std::fs::remove_file(path);
        return Err(e);
    }
    Ok(file)
}

/// Returns the CRC-32 of the next bytes; `None` if there are fewer.
fn crc_of(file: &mut impl Read, length: u64) -> io::Result<Option<u32>> {
    let mut crc = crc32fast::Hasher::new();
    let mut buffer = [0; 1 << 16];
    let mut left = length;
    while left > 0 {
        let want = buffer.len().min(usize::try_from(left).unwrap_or(usize::MAX));
        match file.read(&mut buffer[..want])? {
            0 => return Ok(None),
            n => {
                crc.update(&buffer[..n]);
                left -= n as u64;
            }
        }
    }
    Ok(Some(crc.finalize()))
}

/// Opens the journal of this name, creates it if missing, and locks it for this run.
fn claimed(path: &Path) -> io::Result<File> {
    loop {
        let file = match own(path)? {
            Some(file) => file,
            None => match created(path) {
                Err(e) if e.kind() == io::ErrorKind::AlreadyExists => continue,
                made => made?,
            },
        };
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                return Err(io::Error::other(FileRefusal(both!("another run is writing it"))));
            }
            // On a file system without locks, the user must not start two runs at once.
            Err(TryLockError::Error(e)) if e.kind() == io::ErrorKind::Unsupported => {}
            Err(TryLockError::Error(e)) => return Err(e),
        }
        // The run that held the lock may have ended and removed the file between opening and
        // locking.
        if !has_name(&file, path) {
            continue;
        }
        let mut first = Vec::new();
        (&file).take(journal::MARK.len() as u64).read_to_end(&mut first)?;
        (&file).seek(SeekFrom::Start(0))?;
        return if journal::is_journal(&first) {
            Ok(file)
        } else {
            Err(stranger(path, both!("it is no journal of a batch")))
        };
    }
}

/// Opens the file of this name, if it exists, without changing it.
///
/// # Errors
/// A link, a folder, a device, or a file that also has other names.
fn own(path: &Path) -> io::Result<Option<File>> {
    match std::fs::symlink_metadata(path) {
        Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(e) => return Err(e),
        Ok(m) if !m.is_file() || names(&m) > 1 => {
            return Err(stranger(path, both!("it is a link or no plain file")));
        }
        Ok(_) => {}
    }
    match OpenOptions::new().read(true).write(true).open(path) {
        Err(e) if e.kind() == io::ErrorKind::NotFound => Ok(None),
        // The name may have become a link in the meantime, or the run that owned the file has
        // removed it.
        Ok(file) if has_name(&file, path) => Ok(Some(file)),
        Ok(_) if std::fs::symlink_metadata(path).is_err() => Ok(None),
        Ok(_) => Err(stranger(path, both!("it is a link or no plain file"))),
        Err(e) => Err(e),
    }
}

/// Returns the number of names (hard links) of a file.
#[cfg(unix)]
fn names(m: &std::fs::Metadata) -> u64 {
    std::os::unix::fs::MetadataExt::nlink(m)
}

#[cfg(not(unix))]
fn names(_: &std::fs::Metadata) -> u64 {
    1
}

/// Creates a new file; no link is followed.
fn created(path: &Path) -> io::Result<File> {
    OpenOptions::new().create_new(true).read(true).write(true).open(path)
}

fn stranger(path: &Path, why: Both) -> io::Error {
    io::Error::other(FileRefusal(both!(
        "{} is in the way ({}): move it away, or name another output",
        path.display(),
        why
    )))
}

/// Returns a name with an addition at its end.
fn beside(path: &Path, more: &str) -> PathBuf {
    let mut name = OsString::from(path);
    name.push(more);
    name.into()
}

#[cfg(test)]
mod tests;
