//! `hodograph draw`: the sheet, single figures and the construction's steps, in the requested
//! formats.

use super::args;
use super::places::{agrees, in_stream, of_name, once, one_result};
use super::target::is_stream;
use super::together::Together;
use super::values::{FigureFormat, PointVectors};
use super::{CommandResult, Failure, InputFile, files, granted, ids, look_of, pencil, verdict};
use crate::diag::{Both, Diagnostic, Faults, Warned, both};
use crate::figure::list::Extras;
use crate::figure::steps::StepFigures;
use crate::paper::font::own::Fonts;
use crate::paper::item::Figure;
use crate::paper::style::{self, Style};
use crate::problem::{self, Additions, Extent, Pictures, Wish, extras};
use crate::render::pdf;
use crate::scene::{self, PageFormat};
use std::path::{Path, PathBuf};

/// Default formats in a folder.
pub const FORMATS: [FigureFormat; 2] = [FigureFormat::Svg, FigureFormat::Png];

/// Runs the command.
pub fn run(a: args::DrawArgs) -> CommandResult {
    output(&a.output).map_err(|f| Failure::argument("-o", &a.output, f))?;
    formats(&a)?;
    let style = style_of(&a.look)?;
    let page = page(&a)?;
    let pencil_mm = pencil(a.drafting.as_deref())?;
    let mut file = InputFile::open(&a.common.scene, &a.common.set)?;
    file.fonts = style.fonts.clone();
    let moves = a.steps || a.poses > 0 || !a.path.is_empty();
    let extent = if moves { Extent::Motion } else { Extent::of(&a.figure) };
    let problem = file.read(|bytes| problem::read_as(bytes, extent))?;
    let wishes = [
        (a.pick.map(|n| n.to_string()), Wish::Candidate),
        (a.steps.then(String::new), Wish::Pictures),
        (a.drafting.clone(), Wish::Drafting),
        ((a.poses > 0).then(String::new), Wish::Poses),
        ((!a.path.is_empty()).then(String::new), Wish::Paths),
    ];
    granted(problem.kind(), &wishes)?;
    let options = problem::Options {
        drafting: a.drafting.is_some(),
        pencil_mm,
        whole_motion: a.poses > 0 || !a.path.is_empty(),
        candidate: a.pick.map_or(0, |n| n as usize - 1),
        ..problem::Options::with_figures()
    };
    let solved = file.solve(&problem, &options)?;
    let extras = match solved.mechanism() {
        Some((scene, worked)) if !a.steps => {
            extras(scene, worked, &added(&a)).map_err(Failure::of_values)?
        }
        Some(_) | None => Extras::default(),
    };
    let look = look_of(&a.common, style, a.digits);
    let options = solved.mechanism().map(|(scene, _)| look.sheet_of(scene));
    // Each is written before the next is drawn: a figure of a late step repeats all earlier ones.
    let steps = match (solved.mechanism(), &options) {
        (Some((scene, worked)), Some(options)) if a.steps && page.is_none() => {
            Some(StepFigures::of(scene, worked, options, None)).filter(|s| !s.words().is_empty())
        }
        _ => None,
    };
    let notes = match steps {
        Some(steps) => put(&a, &file.name, &steps.words(), steps.figures(), |f| file.failed(f))?,
        None => {
            let pictures = Pictures { figures: &a.figure, extras, steps: a.steps, page };
            let made = solved.figures(&pictures, &look).map_err(|f| file.failed(f))?;
            file.notes.extend(made.notes);
            let (words, figures): (Vec<_>, Vec<_>) = made.value.into_iter().unzip();
            put(&a, &file.name, &words, figures.into_iter(), |f| file.failed(f))?
        }
    };
    file.notes.extend(notes.into_iter().filter(|n| !file.notes.contains(n)).collect::<Vec<_>>());
    file.say_notes();
    Ok(verdict(solved.verdict()))
}

/// Writes figures with these names: a document with one page each, or files in all requested
/// formats, all of them or none. Returns the notes, each once; letters that the embedded fonts lack
/// are noted for any format.
fn put(
    a: &args::DrawArgs,
    name: &str,
    words: &[String],
    figures: impl Iterator<Item = Figure>,
    failed: impl Fn(Faults) -> Failure,
) -> Result<Vec<Diagnostic>, Failure> {
    let formats = formats(a)?;
    if formats == [FigureFormat::Pdf]
        && (is_stream(&a.output) || of_name(&a.output) == Some(FigureFormat::Pdf))
    {
        let file = pdf::pdf(&figures.collect::<Vec<_>>()).map_err(&failed)?;
        files::write(Path::new(&a.output), &file.value)?;
        files::print_names(&format!("{}\n", a.output))?;
        return Ok(file.notes);
    }
    let one = both!("ask for one with --figure, or for a document of pages: --format pdf");
    one_result(&a.output, words.len(), one)?;
    let targets =
        names(a, name, words, &formats).map_err(|f| Failure::argument("-o", &a.output, f))?;
    let (mut all, mut written, mut notes) = (Together::default(), String::new(), Vec::new());
    for (figure, targets) in figures.zip(targets) {
        for (format, path) in targets {
            let Warned { value, notes: more } =
                files::bytes(&figure, format, a.text, a.dpi).map_err(&failed)?;
            notes.extend(more.into_iter().filter(|n| !notes.contains(n)).collect::<Vec<_>>());
            all.add(&path, &value)?;
            written += &format!("{}\n", path.display());
        }
    }
    all.appear()?;
    files::print_names(&written)?;
    Ok(notes)
}

/// Returns the requested format of the pages.
fn page(a: &args::DrawArgs) -> Result<Option<PageFormat>, Failure> {
    let Some(text) = &a.page else { return Ok(width(a.width.as_deref())?.map(PageFormat::column)) };
    scene::page(text).map(Some).map_err(|faults| Failure::argument("--page", text, faults))
}

/// Returns the requested width (mm).
pub(super) fn width(given: Option<&str>) -> Result<Option<f64>, Failure> {
    let read = |text: &str| {
        scene::width(text).map_err(|faults| Failure::argument("--width", text, faults))
    };
    given.map(read).transpose()
}

/// Returns the formats to write: that of the file's ending, else those of `--format`; by default
/// SVG in a stream, SVG and PNG in a folder.
///
/// # Errors
/// `format` if the ending and `--format` contradict each other, or several formats are requested
/// for one stream.
fn formats(a: &args::DrawArgs) -> Result<Vec<FigureFormat>, Failure> {
    let asked = once(&a.format);
    if is_stream(&a.output) {
        return Ok(vec![in_stream(&a.output, &asked, FigureFormat::Svg)?]);
    }
    match of_name::<FigureFormat>(&a.output).filter(|_| !Path::new(&a.output).is_dir()) {
        Some(named) => agrees(&a.output, named, &asked).map(|()| vec![named]),
        None if asked.is_empty() => Ok(FORMATS.to_vec()),
        None => Ok(asked),
    }
}

/// Refuses a file name with the ending of another format: it would become the name of a folder.
fn output(path: &str) -> Result<(), Faults> {
    let folder =
        path.ends_with(std::path::is_separator) || Path::new(path).is_dir() || is_stream(path);
    match files::ending(path) {
        Some(ending) if !folder && FigureFormat::of(&ending).is_none() => {
            let d = Diagnostic::error(
                "output",
                both!("{path} is not a .svg, .png, .pdf or .tikz file"),
            );
            Err(d
                .help(both!(
                    "write -o figure.svg, figure.png, figure.pdf or figure.tikz; a folder of that name is -o {path}/"
                ))
                .into())
        }
        _ => Ok(()),
    }
}

/// Returns the style of a look, with the fonts of the command line before its own.
pub fn style_of(look: &args::LookArgs) -> Result<Style, Failure> {
    ids::take(&look.id_prefix)?;
    let mut style = read_style(&look.style)?;
    let mut fonts = Fonts::default();
    for name in &look.font {
        let read = files::font(Path::new(name)).and_then(|bytes| fonts.with(name, bytes));
        fonts = read.map_err(|d| Failure::argument("--font", name, d))?;
    }
    style.fonts = fonts.over(&style.fonts);
    Ok(style)
}

/// Reads a bundled style by its name, or a style file.
fn read_style(name: &str) -> Result<Style, Failure> {
    if let Some(style) = Style::named(name) {
        return Ok(style);
    }
    if files::ending(name).as_deref() != Some("json") {
        let d = Diagnostic::error("unknown-style", both!("there is no style `{name}`"));
        return Err(Failure::argument(
            "--style",
            name,
            d.help(both!(
                "the styles are {}; a style of your own is a file ending in .json",
                Both::names(&Style::names())
            )),
        ));
    }
    let bytes = files::style(name).map_err(|d| Failure::argument("--style", name, d))?;
    // Paths of fonts are relative to the style file.
    let folder = Path::new(name).parent().unwrap_or(Path::new(""));
    style::read_with(&bytes, &mut |font| files::font(&folder.join(font)))
        .map_err(|faults| Failure::input(faults, name, &String::from_utf8_lossy(&bytes)))
}

/// Returns the additions to the mechanism.
fn added(a: &args::DrawArgs) -> Additions<'_> {
    Additions {
        vectors: a.vectors.map(|of| match of {
            PointVectors::Velocity => "velocity",
            PointVectors::Acceleration => "acceleration",
        }),
        dimensions: a.dimensions,
        poses: usize::from(a.poses),
        path: &a.path,
    }
}

/// Returns the files of each figure: one file if the output has a format's ending, else one for
/// each format in a folder.
fn names(
    a: &args::DrawArgs,
    scene: &str,
    words: &[String],
    formats: &[FigureFormat],
) -> Result<Vec<Vec<(FigureFormat, PathBuf)>>, Faults> {
    let out = Path::new(&a.output);
    let one = is_stream(&a.output) || of_name::<FigureFormat>(&a.output).is_some() && !out.is_dir();
    if let (true, [format], [_]) = (one, formats, words) {
        return Ok(vec![vec![(*format, out.to_path_buf())]]);
    }
    if one {
        let d = Diagnostic::error(
            "output",
            both!("{} is one file; {} figures are asked for", a.output, words.len()),
        );
        return Err(d.help(both!("name a folder, such as -o out/, or ask for one figure")).into());
    }
    let stem = files::stem(scene, "sheet");
    let file = |word: &str, f: FigureFormat| {
        let dash = if word.is_empty() { "" } else { "-" };
        out.join(format!("{stem}{dash}{word}.{}", f.ending()))
    };
    Ok(words.iter().map(|word| formats.iter().map(|f| (*f, file(word, *f))).collect()).collect())
}
