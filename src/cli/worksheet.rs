//! `hodograph worksheet`: the problem and its solution as a document.

use super::draw::style_of;
use super::mobility::posed_scene;
use super::places::{OutputPlace, of_name, one_result, places, shown};
use super::target::is_stream;
use super::together::Together;
use super::values::SheetFormat;
use super::{
    CommandResult, Failure, InputFile, SceneInput, args, choices, files, granted, ids, look_of,
    verdict,
};
use crate::diag::{Diagnostic, Faults, both};
use crate::figure::sheet;
use crate::paper::style::Style;
use crate::paper::words::words;
use crate::problem::turn::turn_table;
use crate::problem::{self, Kind, Wish, whole_page};
use crate::render::pdf;
use crate::scene;
use crate::worked::{Scope, work};
use crate::worksheet::{
    CompanionFile, Document, WorksheetOptions, WorksheetSides, WorksheetTask, html, markdown,
    mobility, mobility_of_pairs, pages, typst,
};
use std::path::Path;
use std::process::ExitCode;

/// Runs the command.
pub fn run(a: args::WorksheetArgs) -> CommandResult {
    if a.frame {
        return frame(&a);
    }
    let files = Files::of(&a)?;
    let style = style_of(&a.look)?;
    let sides = match (a.problem_only, a.solution) {
        (true, _) => WorksheetSides::Problem,
        (_, true) => WorksheetSides::Solution,
        _ => WorksheetSides::Both,
    };
    let mut file = InputFile::open(&a.common.scene, &a.common.set)?;
    file.fonts = style.fonts.clone();
    let wishes = [
        (a.pick.map(|n| n.to_string()), Wish::Candidate),
        (a.find_the_mistake.clone(), Wish::Mistake),
        (a.mobility.then(String::new), Wish::Mobility),
        (a.loops.then(String::new), Wish::Loops),
        (a.table.map(|n| n.to_string()), Wish::Table),
        (a.questions.then(String::new), Wish::Questions),
    ];
    granted(Kind::of(file.source.as_bytes()), &wishes)?;
    if a.mobility {
        return counting(&a, style, sides, &files);
    }
    let problem = file.read(|bytes| problem::read(bytes))?;
    let options = problem::Options {
        candidate: a.pick.map_or(0, |n| n as usize - 1),
        ..problem::Options::with_figures()
    };
    let solved = file.solve(&problem, &options)?;
    let look = look_of(&a.common, style, a.digits);
    let task = match a.find_the_mistake.as_deref() {
        Some(name) => WorksheetTask::Mistake(name),
        None if a.loops => WorksheetTask::Loops,
        None if a.questions => WorksheetTask::Questions,
        None => WorksheetTask::Polygons,
    };
    let mut document = solved.worksheet(sides, task, &look).map_err(|f| file.failed(f))?;
    if let Some(steps) = a.table {
        let table = turn_table(file.source.as_bytes(), usize::from(steps), &look);
        document.blocks.extend(table.map_err(|f| file.failed(f))?.value);
    }
    let notes = files.write(&document, |f| file.failed(f))?;
    file.notes.extend(notes);
    file.notes.extend(document.remarks());
    file.say_notes();
    Ok(verdict(solved.verdict()))
}

/// Writes the sheet to draw on and its overlay.
fn frame(a: &args::WorksheetArgs) -> CommandResult {
    let page = whole_page(&a.page)?;
    let path = Path::new(&a.output);
    if is_stream(&a.output) || of_name(&a.output) != Some(SheetFormat::Pdf) {
        let d = Diagnostic::error("output", both!("{} is not a .pdf file", shown(&a.output)))
            .help(both!("write -o frame.pdf"));
        return Err(Failure::argument("-o", &a.output, d));
    }
    let style = style_of(&a.look)?;
    let mut file = InputFile::open(&a.common.scene, &a.common.set)?;
    file.fonts = style.fonts.clone();
    let problem = file.read(|bytes| {
        Kind::of(bytes).grants(Wish::Mechanism)?;
        problem::read(bytes)
    })?;
    let solved = file.solve(&problem, &problem::Options::with_figures())?;
    let look = look_of(&a.common, style, a.digits);
    let pages = solved.frame(&page, &look).map_err(|f| file.failed(f))?;
    let (blanks, overlays): (Vec<_>, Vec<_>) =
        pages.into_iter().map(|page| (page.blank, page.overlay)).unzip();
    let stem = path.file_stem().and_then(|s| s.to_str()).unwrap_or("frame");
    let beside = path.with_file_name(format!("{stem}-overlay.pdf"));
    let (mut all, mut names) = (Together::default(), String::new());
    for (path, figures) in [(path, blanks), (&beside, overlays)] {
        let made = pdf::pdf(&figures).map_err(|f| file.failed(f))?;
        let new = |n: &Diagnostic| !file.notes.contains(n);
        let notes: Vec<_> = made.notes.into_iter().filter(new).collect();
        file.notes.extend(notes);
        all.add(path, &made.value)?;
        names += &format!("{}\n", path.display());
    }
    all.appear()?;
    files::print_names(&names)?;
    file.say_notes();
    Ok(ExitCode::SUCCESS)
}

fn options(
    input: &SceneInput,
    a: &args::WorksheetArgs,
    style: Style,
    sides: WorksheetSides,
) -> WorksheetOptions {
    let (lang, notation) = choices(&input.scene, &a.common);
    WorksheetOptions {
        sheet: sheet::SheetOptions {
            lang,
            notation: style.marks.over(&notation),
            digits: a.digits,
            style,
        },
        sides,
    }
}

/// Runs the worksheet on mobility: it needs links and pairs, and the pose only for its drawings.
fn counting(
    a: &args::WorksheetArgs,
    style: Style,
    sides: WorksheetSides,
    files: &Files,
) -> CommandResult {
    let mut input = SceneInput::read_topology(&a.common)?.drawn_in(&style);
    let options = options(&input, a, style, sides);
    let posed = scene::read_pose(&input.file.source).ok().and_then(|read| {
        let scene = posed_scene(read.value);
        let worked = work(&scene, Scope::Figure).ok()?;
        Some((scene, worked))
    });
    let document = match posed {
        Some((scene, worked)) => {
            input.file.notes.extend(worked.notes);
            mobility(&scene, &worked.value, &options)
        }
        None => {
            input.file.notes.push(no_drawings());
            mobility_of_pairs(&input.scene, &options)
        }
    };
    let notes = files.write(&document, |f| input.failed(f))?;
    input.file.notes.extend(notes);
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}

fn no_drawings() -> Diagnostic {
    let message =
        both!("the pose is not told in full: the sheet lists links and pairs, and has no drawings");
    Diagnostic::note("no-pose", message)
        .help(both!("`hodograph mobility SCENE -o groups.pdf` says what is missing for drawings"))
}

/// The files of a document.
struct Files {
    output: String,
    places: Vec<OutputPlace<SheetFormat>>,
}

impl Files {
    fn of(a: &args::WorksheetArgs) -> Result<Files, Failure> {
        Ok(Files {
            output: a.output.clone(),
            places: places(&a.output, &a.format, SheetFormat::Html)?,
        })
    }

    /// Writes the files and their drawings, all or none, and prints their names. Returns the
    /// diagnostics of parts that could not be written faithfully.
    fn write(
        &self,
        document: &Document,
        failed: impl Fn(Faults) -> Failure,
    ) -> Result<Vec<Diagnostic>, Failure> {
        let (mut all, mut names, mut notes): (_, Vec<String>, _) =
            (Together::default(), Vec::new(), Vec::new());
        for (format, path) in &self.places {
            let out = Path::new(path);
            let stem = out.file_stem().and_then(|s| s.to_str()).unwrap_or("worksheet");
            let written = written(document, *format, stem).map_err(&failed)?;
            let one =
                both!("a document with its drawings in one file: --format html or --format pdf");
            one_result(&self.output, 1 + written.beside.len(), one)?;
            for picture in written.beside {
                let path = out.with_file_name(&picture.name);
                let name = path.display().to_string();
                // Markdown and Typst share the drawings.
                if !names.contains(&name) {
                    all.add(&path, ids::put_before(&picture.text).as_bytes())?;
                    names.push(name);
                }
            }
            all.add(out, &written.bytes)?;
            names.push(path.clone());
            notes.extend(written.notes);
        }
        all.appear()?;
        files::print_names(&names.iter().map(|n| format!("{n}\n")).collect::<String>())?;
        Ok(notes)
    }
}

/// A document in a format, with the diagnostics of parts that could not be written faithfully.
#[derive(Default)]
struct FormattedSheet {
    bytes: Vec<u8>,
    beside: Vec<CompanionFile>,
    notes: Vec<Diagnostic>,
}

/// Returns the document in a format; the names of its drawings begin with `stem`.
fn written(document: &Document, format: SheetFormat, stem: &str) -> Result<FormattedSheet, Faults> {
    let text = |(text, beside): (String, Vec<CompanionFile>)| FormattedSheet {
        bytes: text.into_bytes(),
        beside,
        ..FormattedSheet::default()
    };
    Ok(match format {
        SheetFormat::Pdf => {
            let file =
                pdf::document(&pages::pages(document), &document.title, words(document.lang).tag)?;
            FormattedSheet { bytes: file.value, notes: file.notes, ..FormattedSheet::default() }
        }
        SheetFormat::Html => text((html::html(document)?, Vec::new())),
        SheetFormat::Md => text(markdown::markdown(document, stem)?),
        SheetFormat::Typ => text(typst::typst(document, stem)?),
    })
}
