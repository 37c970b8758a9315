//! Destinations of outputs: files, through links to the file that they name; standard output, pipes
//! and devices, written directly. No output replaces a file that the run has read.

use super::Failure;
use crate::diag::{Diagnostic, both};
use std::fs::{File, Metadata, OpenOptions};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

/// The files that this run has read, by their full names.
static READ: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Remembers a file that has been read: no output may replace it.
pub fn has_read(path: &Path) {
    if let Ok(full) = path.canonicalize() {
        READ.lock().unwrap_or_else(PoisonError::into_inner).push(full);
    }
}

fn was_read(path: &Path) -> bool {
    path.canonicalize()
        .is_ok_and(|full| READ.lock().unwrap_or_else(PoisonError::into_inner).contains(&full))
}

/// The destination of an output.
pub enum OutputTarget {
    /// A file, which is written under a temporary name in its folder and renamed; links have been
    /// followed.
    File(PathBuf),
    /// A pipe or a device, which is written directly.
    Stream(PathBuf),
    /// Standard output.
    Stdout,
}

/// True once a result has been written to standard output, which then holds nothing else.
static TAKEN: AtomicBool = AtomicBool::new(false);

/// Returns true if standard output holds a result; reports and names of files are then not printed.
pub fn stdout_is_taken() -> bool {
    TAKEN.load(Ordering::Relaxed)
}

/// Returns true for the names of standard output: `-`, and the names that systems have for it.
pub fn is_stdout(name: &str) -> bool {
    name == "-" || cfg!(unix) && ["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"].contains(&name)
}

/// Returns true if the name is not a regular file: standard output, a pipe, a device.
pub fn is_stream(name: &str) -> bool {
    let path = Path::new(name);
    let open = |m: Metadata| !m.is_dir() && (!m.is_file() || matches!(followed(path), Ok(None)));
    is_stdout(name) || std::fs::metadata(path).is_ok_and(open)
}

/// Largest number of links in a chain, as in the system; more count as a loop.
const LINKS: usize = 40;

impl OutputTarget {
    /// Returns the destination for an output's name. Write permission is checked here, before any
    /// work is done.
    ///
    /// # Errors
    /// A folder, a file that may not be written, a file that this run has read.
    pub fn of(path: &Path) -> Result<OutputTarget, Failure> {
        if path.to_str().is_some_and(is_stdout) {
            TAKEN.store(true, Ordering::Relaxed);
            return Ok(OutputTarget::Stdout);
        }
        let fail = |e: io::Error| unwritable(path, &e);
        // Folders are created first: `new/../scene.json` is another file once `new` exists.
        std::fs::create_dir_all(folder_of(path)).map_err(fail)?;
        match std::fs::metadata(path) {
            Ok(m) if m.is_dir() => return Err(fail(io::ErrorKind::IsADirectory.into())),
            Ok(m) if !m.is_file() => return Ok(OutputTarget::Stream(path.to_owned())),
            Err(e) if e.kind() != io::ErrorKind::NotFound => return Err(fail(e)),
            _ => {}
        }
        let Some(file) = followed(path).map_err(fail)? else {
            return Ok(OutputTarget::Stream(path.to_owned()));
        };
        std::fs::create_dir_all(folder_of(&file)).map_err(fail)?;
        if was_read(&file) {
            let d = Diagnostic::error(
                "output",
                both!("{} is what is read here: writing to it would destroy it", path.display()),
            );
            return Err(Failure::input(
                d.help(both!("name another file, such as -o out/")),
                "",
                "",
            ));
        }
        if let Ok(known) = std::fs::metadata(&file) {
            // Renaming needs only the folder's permission; a write-protected file is checked here.
            if known.permissions().readonly() {
                return Err(fail(io::ErrorKind::PermissionDenied.into()));
            }
            OpenOptions::new().append(true).open(&file).map_err(fail)?;
        }
        Ok(OutputTarget::File(file))
    }
}

impl OutputTarget {
    /// Copies a whole result to a destination that is not a file. A reader of standard output that
    /// closes its end causes no error.
    pub fn take(&self, from: &mut File) -> io::Result<()> {
        from.seek(SeekFrom::Start(0))?;
        match self {
            OutputTarget::File(_) => Ok(()),
            OutputTarget::Stream(path) => {
                io::copy(from, &mut OpenOptions::new().append(true).open(path)?).map(drop)
            }
            OutputTarget::Stdout => {
                let mut out = io::stdout().lock();
                match io::copy(from, &mut out).and_then(|_| out.flush()) {
                    Err(e) if e.kind() != io::ErrorKind::BrokenPipe => Err(e),
                    _ => Ok(()),
                }
            }
        }
    }
}

/// The failure of an output that cannot be written.
pub fn unwritable(path: &Path, e: &io::Error) -> Failure {
    Failure::Output(both!("{} cannot be written: {}", path.display(), super::files::reason(e)))
}

/// Returns the file at the end of a chain of links; `None` for an open file of a process
/// (`/dev/stdout`), which has no other name.
fn followed(path: &Path) -> io::Result<Option<PathBuf>> {
    let mut at = path.to_owned();
    for _ in 0..LINKS {
        if !std::fs::symlink_metadata(&at).is_ok_and(|m| m.is_symlink()) {
            return Ok(Some(at));
        }
        if at.starts_with("/proc") || at.starts_with("/dev/fd") {
            return Ok(None);
        }
        let to = std::fs::read_link(&at)?;
        at = at.parent().unwrap_or(Path::new("")).join(to);
    }
    Err(io::Error::other(super::files::FileRefusal(both!("too many symbolic links"))))
}

/// The folder of a file.
pub fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(p) if !p.as_os_str().is_empty() => p,
        _ => Path::new("."),
    }
}

/// Gives a file the permissions of the file that it replaces, and its owner if the system allows
/// that.
///
/// # Errors
/// The system refuses; the file is then not put in place, because others might be able to read it.
pub fn as_before(file: &File, place: &Path) -> io::Result<()> {
    match std::fs::metadata(place) {
        Ok(before) => {
            owner(file, &before);
            file.set_permissions(before.permissions())
        }
        Err(e) if e.kind() == io::ErrorKind::NotFound => Ok(()),
        Err(e) => Err(e),
    }
}

#[cfg(unix)]
fn owner(file: &File, before: &Metadata) {
    use std::os::unix::fs::{MetadataExt, fchown};
    if file.metadata().is_ok_and(|m| (m.uid(), m.gid()) != (before.uid(), before.gid())) {
        // Only the superuser may change the owner; otherwise the file keeps that of the user.
        let _ = fchown(file, Some(before.uid()), Some(before.gid()));
    }
}

#[cfg(not(unix))]
fn owner(_: &File, _: &Metadata) {}

/// Returns true if an open file has this name itself, not through a link, and has not been
/// replaced.
#[cfg(unix)]
pub fn has_name(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let id = |m: Metadata| (m.dev(), m.ino());
    file.metadata()
        .ok()
        .map(id)
        .is_some_and(|f| std::fs::symlink_metadata(path).ok().map(id) == Some(f))
}

/// Returns true if an open file has this name.
#[cfg(not(unix))]
pub fn has_name(_: &File, path: &Path) -> bool {
    std::fs::symlink_metadata(path).is_ok_and(|m| m.is_file())
}
