//! Reads files up to a size limit, prints, and writes figures in their formats.

use super::places::OutputPlace;
use super::target::{has_read, stdout_is_taken};
use super::together::{OutputFile, Together};
use super::values::{FigureFormat, TextFormat};
use super::{Failure, ids};
use crate::diag::{Both, Diagnostic, Faults, Warned, both};
use crate::paper::font::own;
use crate::paper::item::Figure;
use crate::render::{pdf, png, svg, tikz};
use crate::report::diagnostics;
use std::collections::BTreeMap;
use std::io::{self, Read, Write};
use std::path::Path;
use std::process::ExitCode;
use std::sync::{Mutex, PoisonError};

/// Largest file that is read into memory. A scene is a page of text; the scene reader itself
/// reports files between its own limit and this one.
pub const LARGEST: u64 = 16 << 20;

/// The name by which standard input is shown.
pub const STDIN: &str = "standard input";

/// Scenes that were read, by their paths: a pipe or standard input can be read only once.
static READ: Mutex<BTreeMap<String, Vec<u8>>> = Mutex::new(BTreeMap::new());

/// Reads a scene, from standard input for `-`. Returns the name to show. A second call returns the
/// same bytes.
pub fn scene(path: &str) -> Result<(String, Vec<u8>), Diagnostic> {
    let name = if path == "-" { STDIN } else { path }.to_owned();
    let mut read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(bytes) = read.get(path) {
        return Ok((name, bytes.clone()));
    }
    let bytes = if path == "-" { from_stdin()? } else { from_file(path)? };
    read.insert(path.to_owned(), bytes.clone());
    Ok((name, bytes))
}

fn from_file(path: &str) -> Result<Vec<u8>, Diagnostic> {
    let help = both!("name a scene file; `hodograph new crank-rocker -o scene.json` writes one");
    bounded(Path::new(path), LARGEST, help)
}

fn from_stdin() -> Result<Vec<u8>, Diagnostic> {
    let mut bytes = Vec::new();
    // Standard input may be a file, which must not be overwritten either.
    has_read(Path::new("/dev/stdin"));
    match io::stdin().lock().take(LARGEST).read_to_end(&mut bytes) {
        Ok(_) => Ok(bytes),
        Err(e) => {
            Err(Diagnostic::error("cannot-read", both!("{STDIN} cannot be read: {}", reason(&e))))
        }
    }
}

/// Reads a table of answers, of keys or of names; from standard input for `-`. Returns the name to
/// show.
pub fn table(path: &str) -> Result<(String, Vec<u8>), Diagnostic> {
    if path == "-" {
        return Ok((STDIN.to_owned(), from_stdin()?));
    }
    let help = both!("name a table in CSV");
    Ok((path.to_owned(), bounded(Path::new(path), LARGEST, help)?))
}

/// Reads a style file.
pub fn style(path: &str) -> Result<Vec<u8>, Diagnostic> {
    bounded(
        Path::new(path),
        LARGEST,
        both!("name a style file, or one of the styles print, slides, dark"),
    )
}

/// Reads a figure's file.
pub fn picture(path: &str) -> Result<Vec<u8>, Diagnostic> {
    let bytes = bounded(Path::new(path), LARGEST + 1, both!("name an SVG or a PNG"))?;
    if bytes.len() as u64 > LARGEST {
        let most = LARGEST >> 20;
        return Err(Diagnostic::error("diff-input", both!("{path} has more than {most} MiB")));
    }
    Ok(bytes)
}

/// Reads a font's file.
pub fn font(path: &Path) -> Result<Vec<u8>, Diagnostic> {
    bounded(path, own::LARGEST as u64 + 1, both!("name a font file: .otf or .ttf"))
}

fn bounded(path: &Path, most: u64, help: Both) -> Result<Vec<u8>, Diagnostic> {
    let bytes = limited(path, most).map_err(|e| unreadable(path, &e).help(help))?;
    has_read(path);
    Ok(bytes)
}

fn limited(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    std::fs::File::open(path)?.take(most).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Reads a file as it is at the moment, for a run that also writes it; `None` if there is none.
pub fn read_now(path: &Path) -> Result<Option<Vec<u8>>, Diagnostic> {
    match limited(path, LARGEST) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(e) if e.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(e) => Err(unreadable(path, &e)),
    }
}

/// The fault of a file that cannot be read.
pub fn unreadable(path: &Path, e: &io::Error) -> Diagnostic {
    Diagnostic::error("cannot-read", both!("{} cannot be read: {}", path.display(), reason(e)))
}

/// A refusal by this program, in place of an error of the system.
#[derive(Debug)]
pub struct FileRefusal(pub Both);

impl std::fmt::Display for FileRefusal {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0.en)
    }
}

impl std::error::Error for FileRefusal {}

/// The reason of a system error: in the system's words, and in Chinese for common errors.
pub fn reason(e: &io::Error) -> Both {
    if let Some(FileRefusal(words)) = e.get_ref().and_then(|e| e.downcast_ref()) {
        return words.clone();
    }
    match e.kind() {
        io::ErrorKind::NotFound => both!("file not found" => "{e}"),
        io::ErrorKind::PermissionDenied => both!("permission denied" => "{e}"),
        io::ErrorKind::IsADirectory => both!("is a directory" => "{e}"),
        io::ErrorKind::NotADirectory => both!("not a directory" => "{e}"),
        io::ErrorKind::AlreadyExists => both!("file exists" => "{e}"),
        io::ErrorKind::StorageFull => both!("storage full" => "{e}"),
        io::ErrorKind::ReadOnlyFilesystem => both!("read-only file system" => "{e}"),
        _ => both!("other fault of the system" => "{e}"),
    }
}

/// Prints a text; a reader that closes its end (`| head`) ends the run without error.
pub fn print(text: &str) -> Result<ExitCode, Failure> {
    print_with(|out| out.write_all(text.as_bytes())).map(|()| ExitCode::SUCCESS)
}

/// Prints names of files; control characters are made visible.
pub fn print_names(names: &str) -> Result<ExitCode, Failure> {
    print(&diagnostics::visible(names))
}

/// Prints piece by piece; prints nothing if a result has gone to standard output (`-o -`).
pub fn print_with(fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Failure> {
    if stdout_is_taken() {
        return Ok(());
    }
    let mut out = io::stdout().lock();
    match fill(&mut out).and_then(|()| out.flush()) {
        Err(e) if e.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure::Output(both!("standard output: {}", reason(&e))))
        }
        _ => Ok(()),
    }
}

/// Writes to standard error. A failure to write is ignored: the exit code still gives the outcome.
pub fn write_stderr(text: &str) {
    let _ = io::stderr().lock().write_all(diagnostics::visible(text).as_bytes());
}

/// Returns the ending of a file name, after its last dot, in lower case: `x.SVG` is an SVG too.
pub fn ending(path: &str) -> Option<String> {
    Path::new(path).extension().and_then(|e| e.to_str()).map(str::to_lowercase)
}

/// Writes a whole file.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    write_with(path, |out| out.write_all(bytes))
}

/// Writes a file piece by piece, completely or not at all: a failed or interrupted run leaves
/// nothing behind.
pub fn write_with(
    path: &Path,
    fill: impl FnOnce(&mut OutputFile) -> io::Result<()>,
) -> Result<(), Failure> {
    let mut one = Together::default();
    one.add_with(path, fill)?;
    one.appear()
}

/// Returns the name of a scene file without folder and ending, for the files made from it.
pub fn stem<'a>(name: &'a str, otherwise: &'a str) -> &'a str {
    Path::new(name)
        .file_stem()
        .and_then(|s| s.to_str())
        .filter(|_| name != STDIN)
        .unwrap_or(otherwise)
}

/// Writes a figure in a format; letters that the fonts lack are noted.
pub fn bytes(
    figure: &Figure,
    format: FigureFormat,
    text: TextFormat,
    dpi: f64,
) -> Result<Warned<Vec<u8>>, Faults> {
    match format {
        FigureFormat::Pdf => pdf::pdf(std::slice::from_ref(figure)),
        FigureFormat::Svg => {
            let Warned { value, notes } = if text == TextFormat::Editable {
                svg::write_editable(figure)
            } else {
                svg::write(figure)
            }?;
            Ok(Warned { value: ids::put_before(&value).into_owned().into_bytes(), notes })
        }
        FigureFormat::Png => {
            let Warned { value, notes } = svg::write(figure)?;
            Ok(Warned { value: png::render(&value, dpi)?, notes })
        }
        FigureFormat::Tikz => {
            Ok(Warned { value: tikz::tikz(figure)?.into_bytes(), notes: figure.remarks() })
        }
    }
}

/// Default resolution of a PNG (dots per inch).
const DPI: f64 = 200.0;

/// Writes one figure to its places. Returns the file names, one per line, and the notes.
pub fn figure(
    figure: &Figure,
    places: &[OutputPlace<FigureFormat>],
) -> Result<Warned<String>, Failure> {
    figure_or_pages(|| figure.clone(), || vec![figure.clone()], places)
}

/// Writes a result to its places, all of them or none: a single figure, or pages in a document of
/// pages. Returns the file names, one per line, and the notes.
pub fn figure_or_pages(
    one: impl Fn() -> Figure,
    pages: impl Fn() -> Vec<Figure>,
    places: &[OutputPlace<FigureFormat>],
) -> Result<Warned<String>, Failure> {
    let (mut all, mut names, mut notes) = (Together::default(), String::new(), Vec::new());
    for (format, path) in places {
        let made = match format {
            FigureFormat::Pdf => pdf::pdf(&pages()),
            FigureFormat::Svg | FigureFormat::Png | FigureFormat::Tikz => {
                bytes(&one(), *format, TextFormat::Outlines, DPI)
            }
        };
        let Warned { value, notes: more } = made.map_err(|f| Failure::input(f, "", ""))?;
        notes.extend(more.into_iter().filter(|n| !notes.contains(n)).collect::<Vec<_>>());
        all.add(Path::new(path), &value)?;
        names += &format!("{path}\n");
    }
    all.appear()?;
    Ok(Warned { value: names, notes })
}
