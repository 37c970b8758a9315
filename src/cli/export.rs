//! `hodograph export`, `hodograph import` and `hodograph mdbook`: files of other programs.

use super::draw::style_of;
use super::target::is_stream;
use super::{CommandResult, Failure, InputFile, args, errors, files, look_of, places, verdict};
use crate::diag::{Diagnostic, Faults, both};
use crate::exchange::{self, ExportFormat, ImportFormat, mdbook};
use crate::problem::range::RangeFault;
use crate::problem::{self, Kind, Look, Options};
use std::path::Path;
use std::process::ExitCode;

/// Runs `export`.
pub fn export(a: args::ExportArgs) -> CommandResult {
    let format = format(&a)?;
    let style = style_of(&a.look)?;
    let mut file = InputFile::open(&a.common.scene, &a.common.set)?;
    file.fonts = style.fonts.clone();
    let problem = file.read(|bytes| {
        format.granted(Kind::of(bytes))?;
        problem::read(bytes)
    })?;
    let solved = file.solve(&problem, &Options::with_figures())?;
    let look = look_of(&a.common, style, Look::default().digits);
    let made = exchange::export(&solved, format, a.figure, &look).map_err(|fault| match fault {
        RangeFault::Scene(faults) => file.failed(faults),
        fault @ RangeFault::Values(_) => Failure::argument("-o", &a.output, fault),
    })?;
    file.notes.extend(made.notes);
    files::write(Path::new(&a.output), &made.value)?;
    files::print_names(&format!("{}\n", a.output))?;
    file.say_notes();
    Ok(verdict(solved.verdict()))
}

/// Returns the format of the file.
///
/// # Errors
/// `output` if neither the name nor `--to` gives one; `format` if they contradict each other.
fn format(a: &args::ExportArgs) -> Result<ExportFormat, Failure> {
    let ending = files::ending(&a.output).filter(|_| !is_stream(&a.output));
    let named = ending.as_deref().and_then(ExportFormat::of_ending);
    match (named, a.to) {
        (Some(named), Some(asked)) if named != asked => {
            places::agrees(&a.output, named, &[asked]).map(|()| named)
        }
        (_, Some(asked)) => Ok(asked),
        (Some(named), None) => Ok(named),
        (None, None) => Err(places::no_format::<ExportFormat>(&a.output)),
    }
}

/// Runs `import`.
pub fn import(a: &args::ImportArgs) -> CommandResult {
    let (name, bytes) = files::scene(&a.file).map_err(|d| Failure::input(d, &a.file, ""))?;
    let source = String::from_utf8_lossy(&bytes);
    let ending = files::ending(&a.file);
    let from = a.from.unwrap_or_else(|| ImportFormat::of(ending.as_deref(), &source));
    let scene = exchange::import(&source, from).map_err(|f| Failure::input(f, &name, &source))?;
    files::write(Path::new(&a.output), scene.text.as_bytes())?;
    if a.output != "-" {
        files::print_names(&format!("{}\n", a.output))?;
    }
    errors::tell(&Faults { list: scene.notes }, &name, "");
    Ok(ExitCode::SUCCESS)
}

/// Runs `mdbook`: the answer to `supports` is the exit code; drawings are SVG in HTML.
pub fn mdbook(asked: Option<&str>, renderer: Option<&str>) -> CommandResult {
    match (asked, renderer) {
        (Some("supports"), renderer) => {
            return Ok(if renderer == Some("html") {
                ExitCode::SUCCESS
            } else {
                ExitCode::from(1)
            });
        }
        (Some(other), _) => {
            let d = Diagnostic::error("import", both!("mdBook does not ask `{other}`"));
            return Err(Failure::argument(
                "supports",
                other,
                d.help(both!("the book comes on standard input")),
            ));
        }
        (None, _) => {}
    }
    let (name, bytes) = files::scene("-").map_err(|d| Failure::input(d, "-", ""))?;
    let text = String::from_utf8_lossy(&bytes);
    // mdBook runs its preprocessors in the folder of the book.
    let mut beside = |chapter: &str, file: &str| {
        let source = Path::new("src").join(chapter).with_file_name(file);
        let path = source.to_string_lossy().into_owned();
        let (_, bytes) = files::scene(&path)?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    };
    let book = mdbook::book(&text, &mut beside).map_err(|f| Failure::input(f, &name, ""))?;
    files::print(&book)
}
