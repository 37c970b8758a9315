//! `hodograph export`, `hodograph import` and `hodograph mdbook`: files of other programs.

use super::draw::style_of;
use super::target::is_stream;
use super::values::{ExportFormat, ImportFormat};
use super::{CommandResult, Failure, InputFile, args, errors, files, look_of, places, verdict};
use crate::diag::{Diagnostic, Faults, both};
use crate::exchange::{self, Linkage, geogebra, mdbook, pmks, pptx, pylinkage};
use crate::figure::list::{Extras, FigureInput};
use crate::problem::{self, Kind, Look, Options, Pictures, Solved, Wish};
use crate::render::tikz;
use std::path::Path;
use std::process::ExitCode;

/// The formats by the endings of their files.
const ENDINGS: [(&str, ExportFormat); 8] = [
    ("dxf", ExportFormat::Dxf),
    ("ggb", ExportFormat::Ggb),
    ("tikz", ExportFormat::Tikz),
    ("pptx", ExportFormat::Pptx),
    ("py", ExportFormat::Pylinkage),
    ("json", ExportFormat::PylinkageJson),
    ("txt", ExportFormat::Pmks),
    ("csv", ExportFormat::Pmks),
];

/// Runs `export`.
pub fn export(a: args::ExportArgs) -> CommandResult {
    let format = format(&a)?;
    let style = style_of(&a.look)?;
    let mut file = InputFile::open(&a.common.scene, &a.common.set)?;
    file.fonts = style.fonts.clone();
    let of_linkage = !matches!(format, ExportFormat::Dxf | ExportFormat::Tikz);
    let problem = file.read(|bytes| {
        if of_linkage {
            Kind::of(bytes).grants(Wish::Mechanism)?;
        }
        problem::read(bytes)
    })?;
    let solved = file.solve(&problem, &Options::with_figures())?;
    let look = look_of(&a.common, style, Look::default().digits);
    let bytes = exported(&a, format, &solved, &look, &mut file)?;
    files::write(Path::new(&a.output), &bytes)?;
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
    let named = ENDINGS.iter().find(|(e, _)| ending.as_deref() == Some(*e)).map(|(_, f)| *f);
    match (named, a.to) {
        (Some(named), Some(asked)) if named != asked => {
            places::agrees(&a.output, named, &[asked]).map(|()| named)
        }
        (_, Some(asked)) => Ok(asked),
        (Some(named), None) => Ok(named),
        (None, None) => Err(places::no_format::<ExportFormat>(&a.output)),
    }
}

/// Returns the bytes of the file.
fn exported(
    a: &args::ExportArgs,
    format: ExportFormat,
    solved: &Solved,
    look: &Look,
    file: &mut InputFile,
) -> Result<Vec<u8>, Failure> {
    let drawn = matches!(format, ExportFormat::Dxf | ExportFormat::Tikz);
    match solved.mechanism() {
        Some((scene, worked)) if format == ExportFormat::Pptx => {
            let (options, extras) = (look.sheet_of(scene), Extras::default());
            let wanted = FigureInput { scene, worked, options: &options, extras: &extras };
            let made = pptx::pptx(&wanted).map_err(|f| file.failed(f))?;
            file.notes.extend(made.notes);
            Ok(made.value)
        }
        Some((scene, worked)) if !drawn => {
            let (lang, _) = look.of(scene.language, None);
            let linkage = Linkage::of(scene, worked, scene.title.get(lang).to_owned());
            let written = linkage.and_then(|linkage| match format {
                ExportFormat::Ggb => geogebra::ggb(&linkage),
                ExportFormat::Pylinkage => pylinkage::script(&linkage).map(String::into_bytes),
                ExportFormat::PylinkageJson => pylinkage::file(&linkage).map(String::into_bytes),
                ExportFormat::Pmks
                | ExportFormat::Dxf
                | ExportFormat::Tikz
                | ExportFormat::Pptx => Ok(pmks::text(&linkage).into_bytes()),
            });
            written.map_err(|f| file.failed(f))
        }
        Some((scene, worked)) if format == ExportFormat::Dxf && a.figure.name == "mechanism" => {
            let options = look.sheet_of(scene);
            let text = exchange::mechanism(scene, worked, &options.style, &options.notation);
            Ok(text.into_bytes())
        }
        Some(_) | None => {
            let pictures = Pictures { figures: &[a.figure], ..Pictures::default() };
            let made = solved.figures(&pictures, look).map_err(|f| file.failed(f))?;
            file.notes.extend(made.notes);
            let [(_, figure)] = made.value.as_slice() else {
                let d = Diagnostic::error(
                    "output",
                    both!(
                        "{} is one file; {} figures are asked for",
                        "{} 是一个文件，而要画 {} 个图",
                        a.output,
                        made.value.len()
                    ),
                );
                let d = d.help(both!(
                    "ask for one with --figure, such as --figure velocity",
                    "请用 --figure 只取一个图，如 --figure velocity"
                ));
                return Err(Failure::argument("-o", &a.output, d));
            };
            let text = match format {
                ExportFormat::Tikz => tikz::tikz(figure).map_err(|f| file.failed(f))?,
                ExportFormat::Dxf
                | ExportFormat::Ggb
                | ExportFormat::Pylinkage
                | ExportFormat::PylinkageJson
                | ExportFormat::Pmks
                | ExportFormat::Pptx => exchange::drawing(figure),
            };
            Ok(text.into_bytes())
        }
    }
}

/// Runs `import`.
pub fn import(a: &args::ImportArgs) -> CommandResult {
    let (name, bytes) = files::scene(&a.file).map_err(|d| Failure::input(d, &a.file, ""))?;
    let source = String::from_utf8_lossy(&bytes);
    let ending = files::ending(&a.file);
    let from = match (a.from, ending.as_deref()) {
        (Some(from), _) => from,
        (None, Some("json")) => ImportFormat::Pylinkage,
        (None, Some("txt" | "csv")) => ImportFormat::Pmks,
        (None, _) if source.trim_start().starts_with('{') => ImportFormat::Pylinkage,
        (None, _) => ImportFormat::Pmks,
    };
    let linkage = match from {
        ImportFormat::Pylinkage => pylinkage::read(&source),
        ImportFormat::Pmks => pmks::read(&source),
    }
    .map_err(|f| Failure::input(f, &name, &source))?;
    let scene = exchange::scene(&linkage);
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
            let d = Diagnostic::error(
                "import",
                both!("mdBook does not ask `{other}`", "mdBook 没有 `{other}` 这种询问"),
            );
            return Err(Failure::argument(
                "supports",
                other,
                d.help(both!("the book comes on standard input", "书由标准输入给出")),
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
