//! Files that appear together or not at all: each is written in its folder under a unique temporary
//! name, and when all are complete they are renamed, one right after the other.
//!
//! A temporary name is `.hodograph-`, twelve letters or digits, `.tmp`, and its writer holds a lock
//! on it. Files of a killed run have no lock: the next run that writes to the folder removes them.

use super::target::{OutputTarget, as_before, folder_of, has_name, unwritable};
use super::{Failure, stop};
use crate::diag::both;
use std::fs::{File, OpenOptions};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

const PREFIX: &str = ".hodograph-";
const SUFFIX: &str = ".tmp";
const RANDOM: usize = 12;

/// Files in progress.
#[derive(Default)]
pub struct Together {
    files: Vec<StagedFile>,
    streams: Vec<(PathBuf, OutputTarget, File)>,
    cleared: Vec<PathBuf>,
}

/// A complete file under its temporary name.
struct StagedFile {
    temporary: NamedTempFile,
    place: PathBuf,
    /// The name that the user gave.
    name: PathBuf,
}

impl Together {
    /// Adds a whole file.
    pub fn add(&mut self, path: &Path, bytes: &[u8]) -> Result<(), Failure> {
        self.add_with(path, |out| out.write_all(bytes))
    }

    /// Adds a file that is written piece by piece.
    pub fn add_with(
        &mut self,
        path: &Path,
        fill: impl FnOnce(&mut OutputFile) -> io::Result<()>,
    ) -> Result<(), Failure> {
        stop::watch();
        let fail = |e: io::Error| unwritable(path, &e);
        let filled = |file: &File, folder: &Path| {
            let mut out = OutputFile {
                file: BufWriter::with_capacity(1 << 16, file.try_clone()?),
                folder: folder.to_owned(),
            };
            fill(&mut out).and_then(|()| out.flush())
        };
        match OutputTarget::of(path)? {
            target @ (OutputTarget::Stream(_) | OutputTarget::Stdout) => {
                let file = tempfile::tempfile().map_err(fail)?;
                unless_stopped(path, filled(&file, &std::env::temp_dir()))?;
                self.streams.push((path.to_owned(), target, file));
            }
            OutputTarget::File(place) => {
                let folder = folder_of(&place);
                self.clear(folder);
                let temporary = temporary(folder).map_err(fail)?;
                // Permissions are set before the first byte, so that a protected file is not
                // readable while it is written.
                as_before(temporary.as_file(), &place).map_err(fail)?;
                unless_stopped(path, filled(temporary.as_file(), folder))?;
                self.files.push(StagedFile { temporary, place, name: path.to_owned() });
            }
        }
        Ok(())
    }

    /// Removes files of killed runs from a folder.
    fn clear(&mut self, folder: &Path) {
        if self.cleared.iter().any(|f| f == folder) {
            return;
        }
        self.cleared.push(folder.to_owned());
        // A folder that cannot be listed is not cleared; it can still be written to.
        for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
            if is_temporary(&entry.file_name().to_string_lossy()) {
                clear_one(&entry.path());
            }
        }
    }

    /// Renames all files. If one cannot be renamed, those renamed before are put back.
    pub fn appear(self) -> Result<(), Failure> {
        if let Some(first) =
            self.files.iter().map(|f| &f.name).chain(self.streams.iter().map(|s| &s.0)).next()
        {
            unless_stopped(first, Ok(()))?;
        }
        let _naming = stop::undisturbed();
        // A single file needs no undo: renaming is atomic.
        let lone = self.files.len() + self.streams.len() == 1;
        let mut done = Undo::default();
        for staged in self.files {
            let fail = |e: &io::Error| unwritable(&staged.name, e);
            if !lone {
                done.keep(&staged.place).map_err(|e| fail(&e))?;
            }
            staged.temporary.persist(&staged.place).map_err(|e| fail(&e.error))?;
            if !lone {
                done.placed.push(staged.place);
            }
        }
        for (path, target, mut file) in self.streams {
            target.take(&mut file).map_err(|e| unwritable(&path, &e))?;
        }
        done.placed.clear();
        Ok(())
    }
}

/// The undo: dropped with files in `placed`, it restores the state before.
#[derive(Default)]
struct Undo {
    placed: Vec<PathBuf>,
    /// Earlier files of these places, kept under temporary names until all is done.
    before: Vec<(PathBuf, NamedTempFile)>,
}

impl Undo {
    /// Keeps the file of a place.
    fn keep(&mut self, place: &Path) -> io::Result<()> {
        match std::fs::File::open(place) {
            Ok(mut old) => {
                let mut kept = temporary(folder_of(place))?;
                as_before(kept.as_file(), place)?;
                io::copy(&mut old, &mut kept)?;
                self.before.push((place.to_owned(), kept));
                Ok(())
            }
            Err(e) if e.kind() == io::ErrorKind::NotFound => Ok(()),
            Err(e) => Err(e),
        }
    }
}

impl Drop for Undo {
    fn drop(&mut self) {
        for place in &self.placed {
            // The undo may fail too; nothing more can be done then.
            let _ = match self.before.iter().position(|(p, _)| p == place) {
                Some(k) => {
                    self.before.swap_remove(k).1.persist(place).map(drop).map_err(|e| e.error)
                }
                None => std::fs::remove_file(place),
            };
        }
    }
}

/// Creates a temporary file in a folder, locked, with the default permissions of the user's files.
fn temporary(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).suffix(SUFFIX).rand_bytes(RANDOM);
    #[cfg(unix)]
    {
        // Temporary files are private by default. The user's mask also applies here.
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    loop {
        let file = builder.tempfile_in(folder)?;
        // Another run that clears the folder may have removed the file before it was locked.
        match file.as_file().try_lock() {
            Ok(()) if has_name(file.as_file(), file.path()) => return Ok(file),
            Ok(()) | Err(std::fs::TryLockError::WouldBlock) => {}
            // On a file system without locks no files are cleared.
            Err(std::fs::TryLockError::Error(_)) => return Ok(file),
        }
    }
}

fn is_temporary(name: &str) -> bool {
    let random = name.strip_prefix(PREFIX).and_then(|n| n.strip_suffix(SUFFIX));
    random.is_some_and(|r| r.len() == RANDOM && r.bytes().all(|b| b.is_ascii_alphanumeric()))
}

fn clear_one(path: &Path) {
    if !std::fs::symlink_metadata(path).is_ok_and(|m| m.is_file()) {
        return;
    }
    if let Ok(file) = OpenOptions::new().append(true).open(path)
        && file.try_lock().is_ok()
        && has_name(&file, path)
    {
        // A file that cannot be removed stays.
        let _ = std::fs::remove_file(path);
    }
}

/// Returns the result of writing, or the interruption if the user has asked to stop.
fn unless_stopped(path: &Path, filled: io::Result<()>) -> Result<(), Failure> {
    if stop::asked() {
        return Err(Failure::Interrupted(both!("{} is not written", path.display())));
    }
    filled.map_err(|e| unwritable(path, &e))
}

/// A file in progress; it accepts no bytes once the user has asked to stop.
pub struct OutputFile {
    file: BufWriter<File>,
    folder: PathBuf,
}

impl Write for OutputFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        // Not of the kind `Interrupted`, which would be retried.
        if stop::asked() { Err(io::Error::other("interrupted")) } else { self.file.write(bytes) }
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl OutputFile {
    /// Creates an unnamed file in the same place, for rows that are not in their final order.
    pub fn scratch(&self) -> io::Result<File> {
        tempfile::tempfile_in(&self.folder)
    }

    /// Replaces the first `old` bytes; the bytes behind them move.
    pub fn replace_beginning(&mut self, old: u64, new: &[u8]) -> io::Result<()> {
        self.file.flush()?;
        if new.len() as u64 != old {
            let mut rest = self.scratch()?;
            let file = self.file.get_mut();
            file.seek(SeekFrom::Start(old))?;
            io::copy(file, &mut rest)?;
            rest.seek(SeekFrom::Start(0))?;
            file.set_len(0)?;
            file.seek(SeekFrom::Start(0))?;
            file.write_all(new)?;
            io::copy(&mut rest, file)?;
            return Ok(());
        }
        let file = self.file.get_mut();
        file.seek(SeekFrom::Start(0))?;
        file.write_all(new)
    }
}
