//! Destinations of outputs: through links to the file that they name, into standard output, pipes and devices as they stand, and never onto what the run
//! has read.

use super::Failure;
use crate::diag::{Diagnostic, both};
use std::fs::{File, Metadata, OpenOptions};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

/// The files that this run has read, by their full names.
static READ: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Remembers what has been read: no output may take its place.
pub fn has_read(path: &Path) {
    if let Ok(full) = path.canonicalize() {
        READ.lock().unwrap_or_else(PoisonError::into_inner).push(full);
    }
}

fn was_read(path: &Path) -> bool {
    path.canonicalize().is_ok_and(|full| READ.lock().unwrap_or_else(PoisonError::into_inner).contains(&full))
}

/// What an output is written to.
pub enum Target {
    /// A file, which is written beside itself and renamed; links have been followed.
    File(PathBuf),
    /// A pipe or a device, which takes the bytes as it stands.
    Stream(PathBuf),
    /// Standard output.
    Stdout,
}

/// True once a result has been written to standard output, which holds nothing else then.
static TAKEN: AtomicBool = AtomicBool::new(false);

/// Returns true if standard output holds a result: reports and names of files are not printed then.
pub fn stdout_is_taken() -> bool {
    TAKEN.load(Ordering::Relaxed)
}

/// Returns true for the names of standard output: `-`, and the files that systems have for it.
pub fn is_stdout(name: &str) -> bool {
    name == "-" || cfg!(unix) && ["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"].contains(&name)
}

/// Returns true if the name is no regular file: standard output, a pipe, a device.
pub fn is_stream(name: &str) -> bool {
    let path = Path::new(name);
    let open = |m: Metadata| !m.is_dir() && (!m.is_file() || matches!(followed(path), Ok(None)));
    is_stdout(name) || std::fs::metadata(path).is_ok_and(open)
}

/// More links one behind the other are a loop; so many does the system follow too.
const LINKS: usize = 40;

impl Target {
    /// Where an output of this name goes. Whether it may be written is seen here, before any work is written.
    ///
    /// # Errors
    /// A folder, a file that may not be written, a file that this run has read.
    pub fn of(path: &Path) -> Result<Target, Failure> {
        if path.to_str().is_some_and(is_stdout) {
            TAKEN.store(true, Ordering::Relaxed);
            return Ok(Target::Stdout);
        }
        let fail = |e: io::Error| unwritable(path, &e);
        // Before anything is asked of the name: `new/../scene.json` is another file once `new` is there.
        std::fs::create_dir_all(folder_of(path)).map_err(fail)?;
        match std::fs::metadata(path) {
            Ok(m) if m.is_dir() => return Err(fail(io::ErrorKind::IsADirectory.into())),
            Ok(m) if !m.is_file() => return Ok(Target::Stream(path.to_owned())),
            Err(e) if e.kind() != io::ErrorKind::NotFound => return Err(fail(e)),
            _ => {}
        }
        let Some(file) = followed(path).map_err(fail)? else { return Ok(Target::Stream(path.to_owned())) };
        std::fs::create_dir_all(folder_of(&file)).map_err(fail)?;
        if was_read(&file) {
            let d = Diagnostic::error(
                "output",
                both!("{} is what is read here: writing to it would destroy it", "{} 正被读取：写入会毁掉它", path.display()),
            );
            return Err(Failure::input(d.help(both!("name another file, such as -o out/", "请另写文件，如 -o out/")), "", ""));
        }
        if let Ok(known) = std::fs::metadata(&file) {
            // Renaming asks the folder alone: who protected the file is asked here.
            if known.permissions().readonly() {
                return Err(fail(io::ErrorKind::PermissionDenied.into()));
            }
            OpenOptions::new().append(true).open(&file).map_err(fail)?;
        }
        Ok(Target::File(file))
    }
}

impl Target {
    /// Copies a whole result to where it goes, if that is no file. A reader of standard output that closed its end has had enough.
    pub fn take(&self, from: &mut File) -> io::Result<()> {
        from.seek(SeekFrom::Start(0))?;
        match self {
            Target::File(_) => Ok(()),
            Target::Stream(path) => io::copy(from, &mut OpenOptions::new().append(true).open(path)?).map(drop),
            Target::Stdout => {
                let mut out = io::stdout().lock();
                match io::copy(from, &mut out).and_then(|_| out.flush()) {
                    Err(e) if e.kind() != io::ErrorKind::BrokenPipe => Err(e),
                    _ => Ok(()),
                }
            }
        }
    }
}

/// What is said of an output that cannot be written.
pub fn unwritable(path: &Path, e: &io::Error) -> Failure {
    Failure::Output(both!("{} cannot be written: {}", "不能写入 {}：{}", path.display(), super::files::reason(e)))
}

/// The file at the end of a chain of links; `None` where that is an open file of a process (`/dev/stdout`), which has no other name.
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
    Err(io::Error::other(super::files::Refused(both!("too many symbolic links", "符号链接过多"))))
}

/// The folder of a file.
pub fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(p) if !p.as_os_str().is_empty() => p,
        _ => Path::new("."),
    }
}

/// Gives a file that takes another's place the rights of that one, and its owner where that is allowed.
///
/// # Errors
/// The system refuses; a file that others could read by mistake is not to appear.
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
        // Only the superuser may give a file away; for all others it stays theirs.
        let _ = fchown(file, Some(before.uid()), Some(before.gid()));
    }
}

#[cfg(not(unix))]
fn owner(_: &File, _: &Metadata) {}

/// Whether an open file is the one that stands under a name, not one that a link there leads to, nor one that was there before.
#[cfg(unix)]
pub fn stands_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let id = |m: Metadata| (m.dev(), m.ino());
    file.metadata().ok().map(id).is_some_and(|f| std::fs::symlink_metadata(path).ok().map(id) == Some(f))
}

/// Whether an open file is the one that stands under a name.
#[cfg(not(unix))]
pub fn stands_at(_: &File, path: &Path) -> bool {
    std::fs::symlink_metadata(path).is_ok_and(|m| m.is_file())
}
