//! `hodograph worksheet`: the problem and its solution as a document.

use super::draw::style_of;
use super::mobility::posed_scene;
use super::together::Together;
use super::{Failure, Input, Run, args, choices, files, ids, verdict};
use crate::attempts;
use crate::diag::{Diagnostic, Faults, both};
use crate::figure::sheet;
use crate::paper::style::Style;
use crate::paper::words::words;
use crate::render::pdf;
use crate::scene;
use crate::worked::{Scope, work};
use crate::worksheet::{
    Beside, Document, Options, Sides, find_the_mistake, html, markdown, mobility, mobility_of_pairs, pages, typst, worksheet,
};
use std::path::Path;
use std::process::ExitCode;

/// Runs the command.
pub fn run(a: args::Worksheet) -> Run {
    let write = writer(&a.output).map_err(|f| Failure::argument("-o", &a.output, f))?;
    let style = style_of(&a.look)?;
    let sides = match (a.problem_only, a.solution) {
        (true, _) => Sides::Problem,
        (_, true) => Sides::Solution,
        _ => Sides::Both,
    };
    if super::synth::is_task(&a.common.scene) {
        return super::synth::worksheet(&a, style, sides, write);
    }
    super::synth::no_pick(a.pick)?;
    if super::particle::is_problem(&a.common.scene) {
        return super::particle::worksheet(&a, style, sides, write);
    }
    if a.mobility {
        return counting(&a, style, sides, write);
    }
    let mut input = Input::read(&a.common)?.drawn_in(&style);
    let worked = input.work(Scope::Figure)?;
    let options = options(&input, &a, style, sides);
    let document = match &a.find_the_mistake {
        None => worksheet(&input.scene, &worked, &options),
        Some(name) => {
            let all = attempts::wanted(&input.scene, &worked, false).map_err(|f| input.failed(f))?;
            let wanted = all.iter().find(|a| name.is_empty() || a.site.mistake().name() == name.as_str());
            let Some(attempt) = wanted else { return Err(input.failed(none(name).into())) };
            find_the_mistake(&input.scene, &worked, attempt, &options)
        }
    };
    let written = write(&document, stem(&a.output)).map_err(|f| input.failed(f))?;
    input.notes.extend(written.appear(&a.output)?);
    input.notes.extend(document.remarks());
    input.say_notes();
    Ok(verdict(&worked))
}

fn options(input: &Input, a: &args::Worksheet, style: Style, sides: Sides) -> Options {
    let (lang, notation) = choices(&input.scene, &a.common);
    Options { sheet: sheet::Options { lang, notation: style.marks.over(&notation), digits: a.digits, style }, sides }
}

/// The sheet on mobility: links and pairs are enough for it, and the pose for its drawings.
fn counting(a: &args::Worksheet, style: Style, sides: Sides, write: Writer) -> Run {
    let mut input = Input::read_topology(&a.common)?.drawn_in(&style);
    let options = options(&input, a, style, sides);
    let posed = scene::read_pose(&input.source).ok().and_then(|read| {
        let scene = posed_scene(read.value);
        let worked = work(&scene, Scope::Figure).ok()?;
        Some((scene, worked))
    });
    let document = match posed {
        Some((scene, worked)) => {
            input.notes.extend(worked.notes);
            mobility(&scene, &worked.value, &options)
        }
        None => {
            input.notes.push(no_drawings());
            mobility_of_pairs(&input.scene, &options)
        }
    };
    let written = write(&document, stem(&a.output)).map_err(|f| input.failed(f))?;
    input.notes.extend(written.appear(&a.output)?);
    input.say_notes();
    Ok(ExitCode::SUCCESS)
}

fn no_drawings() -> Diagnostic {
    let message = both!(
        "the pose is not told in full: the sheet lists links and pairs, and has no drawings",
        "位置未完全给定：习题列出构件和运动副，不附图"
    );
    Diagnostic::note("no-pose", message).help(both!(
        "`hodograph mobility SCENE -o groups.pdf` says what is missing for drawings",
        "`hodograph mobility SCENE -o groups.pdf` 说明绘图还缺少哪些数据"
    ))
}

/// The stem of the names of a document's drawings.
pub(super) fn stem(output: &str) -> &str {
    Path::new(output).file_stem().and_then(|s| s.to_str()).unwrap_or("worksheet")
}

/// No wrong solution is to be had.
fn none(name: &str) -> Diagnostic {
    let message = match name {
        "" => both!("no known mistake changes an answer of this scene", "本题中没有会改变结果的典型错误"),
        name => both!("the mistake `{name}` cannot be made in this scene", "本题中不会出现错误 `{name}`"),
    };
    Diagnostic::error("attempt", message)
        .help(both!("`hodograph attempts --all` lists those that can", "`hodograph attempts --all` 列出可能的错误"))
}

/// A document as files, and what could not be written as it should.
#[derive(Default)]
pub(super) struct Written {
    bytes: Vec<u8>,
    beside: Vec<Beside>,
    notes: Vec<Diagnostic>,
}

impl Written {
    fn of((text, beside): (String, Vec<Beside>)) -> Written {
        Written { bytes: text.into_bytes(), beside, ..Written::default() }
    }

    /// Puts the files there, all or none, and says their names; what could not be written as it should.
    pub(super) fn appear(self, output: &str) -> Result<Vec<Diagnostic>, Failure> {
        let out = Path::new(output);
        let mut all = Together::default();
        let mut names = String::new();
        for picture in self.beside {
            let path = out.with_file_name(&picture.name);
            all.add(&path, ids::put_before(&picture.text).as_bytes())?;
            names += &format!("{}\n", path.display());
        }
        all.add(out, &self.bytes)?;
        all.appear()?;
        files::print_names(&format!("{names}{output}\n"))?;
        Ok(self.notes)
    }
}

/// What writes a document, given the stem of the names of its drawings.
pub(super) type Writer = fn(&Document, &str) -> Result<Written, Faults>;

/// What writes files that end so.
fn writer(output: &str) -> Result<Writer, Faults> {
    match files::ending(output).as_deref() {
        Some("pdf") => Ok(|d, _| {
            let file = pdf::document(&pages::pages(d), &d.title, words(d.lang).tag)?;
            Ok(Written { bytes: file.value, notes: file.notes, ..Written::default() })
        }),
        Some("html") => Ok(|d, _| Ok(Written::of((html::html(d)?, Vec::new())))),
        Some("md") => Ok(|d, stem| markdown::markdown(d, stem).map(Written::of)),
        Some("typ") => Ok(|d, stem| typst::typst(d, stem).map(Written::of)),
        _ => Err(Diagnostic::error(
            "output",
            both!("{output} ends in none of .pdf, .html, .md, .typ", "{output} 不以 .pdf、.html、.md 或 .typ 结尾"),
        )
        .help(both!("name the file after its format, such as -o sheet.pdf", "请按格式命名文件，如 -o sheet.pdf"))
        .into()),
    }
}
