//! Files: read with a bound, written whole or not at all.

use super::values::{Format, Text};
use super::{Failure, stop};
use crate::diag::{Diagnostic, Faults, Warned};
use crate::figure::font::own;
use crate::figure::item::Figure;
use crate::render::{pdf, png, svg};
use std::io::{BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// A scene is a page of text; what is larger than this is not one, and is not read into memory. The reader itself says so
/// for files between its own limit and this one.
const LARGEST: u64 = 16 << 20;

/// Reads a file, or standard input for `-`. Returns the name to show.
pub fn read(path: &str) -> Result<(String, Vec<u8>), Diagnostic> {
    let mut bytes = Vec::new();
    let (name, result) = if path == "-" {
        ("standard input".to_string(), std::io::stdin().lock().take(LARGEST).read_to_end(&mut bytes))
    } else {
        (path.to_string(), std::fs::File::open(path).and_then(|f| f.take(LARGEST).read_to_end(&mut bytes)))
    };
    match result {
        Ok(_) => Ok((name, bytes)),
        Err(e) => Err(Diagnostic::error("cannot-read", format!("{path} cannot be read: {e}"))
            .help("name a scene file; `hodograph new crank-rocker -o scene.json` writes one")),
    }
}

/// Reads a font's file, bounded.
pub fn font(path: &Path) -> Result<Vec<u8>, Diagnostic> {
    let mut bytes = Vec::new();
    let reach = own::LARGEST as u64 + 1;
    match std::fs::File::open(path).and_then(|f| f.take(reach).read_to_end(&mut bytes)) {
        Ok(_) => Ok(bytes),
        Err(e) => {
            Err(Diagnostic::error("cannot-read", format!("{} cannot be read: {e}", path.display())).help("name a font file: .otf or .ttf"))
        }
    }
}

/// Prints; a reader that closed its end (`| head`) ends the run quietly.
pub fn print(text: &str) -> Result<ExitCode, Failure> {
    print_with(|out| out.write_all(text.as_bytes())).map(|()| ExitCode::SUCCESS)
}

/// Prints piece by piece.
pub fn print_with(fill: impl FnOnce(&mut dyn Write) -> std::io::Result<()>) -> Result<(), Failure> {
    match fill(&mut std::io::stdout().lock()) {
        Err(e) if e.kind() != std::io::ErrorKind::BrokenPipe => Err(Failure::Output(format!("standard output: {e}"))),
        _ => Ok(()),
    }
}

/// How a file's name ends, after its last dot.
pub fn ending(path: &str) -> Option<&str> {
    Path::new(path).extension().and_then(|e| e.to_str())
}

/// Writes a file whole: beside it first, then renamed.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    write_with(path, |out| out.write_all(bytes))
}

/// Writes a file piece by piece, whole or not at all: what fails or is interrupted leaves nothing behind.
pub fn write_with(path: &Path, fill: impl FnOnce(&mut Out) -> std::io::Result<()>) -> Result<(), Failure> {
    let fail = |e: std::io::Error| Failure::Output(format!("{} cannot be written: {e}", path.display()));
    let folder = match path.parent() {
        Some(p) if !p.as_os_str().is_empty() => p,
        _ => Path::new("."),
    };
    std::fs::create_dir_all(folder).map_err(fail)?;
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    {
        // A temporary file is private by default; a figure is as readable as any file the user writes.
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o644));
    }
    let file = builder.prefix(".hodograph-").tempfile_in(folder).map_err(fail)?;
    let copy = file.as_file().try_clone().map_err(fail)?;
    let mut out = Out { file: BufWriter::with_capacity(1 << 16, copy), folder: folder.to_owned() };
    let filled = fill(&mut out).and_then(|()| out.flush());
    if stop::asked() {
        return Err(Failure::Interrupted(format!("{} is not written", path.display())));
    }
    filled.map_err(fail)?;
    file.persist(path).map_err(|e| fail(e.error))?;
    Ok(())
}

/// A file under way, which takes nothing more once the user has asked to stop.
pub struct Out {
    file: BufWriter<std::fs::File>,
    folder: PathBuf,
}

impl Write for Out {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        // Not of the kind `Interrupted`: that one is tried again.
        if stop::asked() { Err(std::io::Error::other("interrupted")) } else { self.file.write(bytes) }
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.file.flush()
    }
}

impl Out {
    /// A file without a name in the same place, for what is not yet in its order.
    pub fn scratch(&self) -> std::io::Result<std::fs::File> {
        tempfile::tempfile_in(&self.folder)
    }

    /// Puts other bytes in the place of the first `old` ones; what stands behind them moves.
    pub fn replace_beginning(&mut self, old: u64, new: &[u8]) -> std::io::Result<()> {
        self.file.flush()?;
        if new.len() as u64 != old {
            let mut rest = self.scratch()?;
            let file = self.file.get_mut();
            file.seek(SeekFrom::Start(old))?;
            std::io::copy(file, &mut rest)?;
            rest.seek(SeekFrom::Start(0))?;
            file.set_len(0)?;
            file.seek(SeekFrom::Start(0))?;
            file.write_all(new)?;
            std::io::copy(&mut rest, file)?;
            return Ok(());
        }
        let file = self.file.get_mut();
        file.seek(SeekFrom::Start(0))?;
        file.write_all(new)
    }
}

/// The name of a scene file without folder and ending, for the files made from it.
pub fn stem<'a>(name: &'a str, otherwise: &'a str) -> &'a str {
    Path::new(name).file_stem().and_then(|s| s.to_str()).filter(|_| name != "standard input").unwrap_or(otherwise)
}

/// A figure in a format; what has no letters in the fonts is noted.
pub fn bytes(figure: &Figure, format: Format, text: Text, dpi: f64) -> Result<Warned<Vec<u8>>, Faults> {
    match format {
        Format::Pdf => pdf::pdf(std::slice::from_ref(figure)),
        Format::Svg => {
            let Warned { value, notes } = if text == Text::Editable { svg::write_editable(figure) } else { svg::write(figure) }?;
            Ok(Warned { value: value.into_bytes(), notes })
        }
        Format::Png => {
            let Warned { value, notes } = svg::write(figure)?;
            Ok(Warned { value: png::render(&value, dpi)?, notes })
        }
    }
}

/// Dots of a PNG in an inch, where nothing else is said.
const DPI: f64 = 200.0;

/// Writes one figure to a file ending in .svg, .png or .pdf. Returns the notes.
pub fn figure(figure: &Figure, path: &str) -> Result<Vec<Diagnostic>, Failure> {
    let input = |d: Faults| Failure::Input(d, path.to_string(), String::new());
    let Some(format) = ending(path).and_then(Format::of) else {
        let d = Diagnostic::error("output", format!("{path} is neither a .svg, nor a .png, nor a .pdf file"));
        return Err(input(d.help("write -o figure.svg, -o figure.png or -o figure.pdf").into()));
    };
    let Warned { value, notes } = bytes(figure, format, Text::Outlines, DPI).map_err(input)?;
    write(Path::new(path), &value)?;
    Ok(notes)
}
