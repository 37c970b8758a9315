//! `hodograph draw`: the sheet, single figures and the construction's steps, into the files that were asked for.

use super::args;
use super::together::Together;
use super::values::{Format, Vectors};
use super::{Failure, Input, Run, Told, choices, files, ids, verdict};
use crate::diag::{Both, Diagnostic, Faults, Span, Warned, both};
use crate::figure::fit;
use crate::figure::list::{self, Entry, Extras, Pages, Wanted};
use crate::figure::sheet::Options;
use crate::figure::steps;
use crate::json::fields::suggest;
use crate::mechanism::Level;
use crate::paper::font::own::Fonts;
use crate::paper::item::Figure;
use crate::paper::style::{self, Style};
use crate::render::pdf;
use crate::scene::{self, PointId, Scene};
use crate::worked::{Scope, Worked};
use std::path::{Path, PathBuf};

/// Runs the command.
pub fn run(a: args::Draw) -> Run {
    output(&a.output).map_err(|f| Failure::argument("-o", &a.output, f))?;
    let style = style_of(&a.look)?;
    let width_mm = width(&a)?;
    if super::synth::is_task(&a.common.scene) {
        return super::synth::draw(&a, &style);
    }
    super::synth::no_pick(a.pick)?;
    if super::particle::is_problem(&a.common.scene) {
        return super::particle::draw(&a, &style);
    }
    let mut input = if needs_no_rate(&a) { Input::read_at_rest(&a.common) } else { Input::read(&a.common) }?.drawn_in(&style);
    let drafting = input.pencil(a.drafting.as_deref())?;
    if a.poses > 0 || !a.path.is_empty() {
        input.over_a_turn();
    }
    let mut worked = input.work(Scope::Figure)?;
    if drafting {
        worked = worked.with_drafting(&input.scene);
    }
    let (lang, notation) = choices(&input.scene, &a.common);
    let options = Options { lang, notation: style.marks.over(&notation), digits: a.digits, style };
    let figures = if a.steps {
        steps::figures(&input.scene, &worked, &options).into_iter().enumerate().map(|(k, f)| (format!("step-{:02}", k + 1), f)).collect()
    } else {
        let extras = extras(&input.scene, &worked, &a)?;
        let wanted = Wanted { scene: &input.scene, worked: &worked, options: &options, extras: &extras };
        let Warned { value, notes } = pictures(&wanted, asked(&a, &extras), width_mm).map_err(|f| input.failed(f))?;
        input.notes.extend(notes);
        value
    };
    let notes = put(&a, &input.name, figures, |f| input.failed(f))?;
    input.notes.extend(notes.into_iter().filter(|n| !input.notes.contains(n)).collect::<Vec<_>>());
    input.say_notes();
    Ok(verdict(&worked))
}

/// Writes figures, each with its name: a document with a page for each, or files in all formats asked for, all of them or none. Returns the
/// notes, each once: what has no letters in the embedded fonts is noted in whichever format.
pub(super) fn put(
    a: &args::Draw,
    name: &str,
    figures: Vec<(String, Figure)>,
    failed: impl Fn(Faults) -> Failure,
) -> Result<Vec<Diagnostic>, Failure> {
    if figures.is_empty() {
        let d = Diagnostic::error("no-figure", both!("there is nothing to draw", "没有可画的图"));
        return Err(failed(
            d.help(both!(
                "of what the scene asks no step is drawn: leave --steps out, or ask for velocities or accelerations in \"find\"",
                "所求各量没有作图步骤：请去掉 --steps，或在 \"find\" 中求速度或加速度"
            ))
            .into(),
        ));
    }
    if files::ending(&a.output).as_deref() == Some(Format::Pdf.ending()) {
        let pages: Vec<Figure> = figures.into_iter().map(|(_, f)| f).collect();
        let file = pdf::pdf(&pages).map_err(&failed)?;
        files::write(Path::new(&a.output), &file.value)?;
        files::print_names(&format!("{}\n", a.output))?;
        return Ok(file.notes);
    }
    let targets = names(a, name, &figures).map_err(|f| Failure::argument("-o", &a.output, f))?;
    let (mut all, mut written, mut notes) = (Together::default(), String::new(), Vec::new());
    for ((_, figure), targets) in figures.iter().zip(targets) {
        for (format, path) in targets {
            let Warned { value, notes: more } = files::bytes(figure, format, a.text, a.dpi).map_err(&failed)?;
            notes.extend(more.into_iter().filter(|n| !notes.contains(n)).collect::<Vec<_>>());
            all.add(&path, &value)?;
            written += &format!("{}\n", path.display());
        }
    }
    all.appear()?;
    files::print_names(&written)?;
    Ok(notes)
}

/// Whether all figures asked for are such as do not depend on how fast the driver goes.
fn needs_no_rate(a: &args::Draw) -> bool {
    let still = |e: &&'static Entry| matches!(e.name, "centres" | "curvature" | "centrodes" | "inversions");
    !a.figure.is_empty() && a.figure.iter().all(still) && a.path.is_empty() && a.poses == 0 && !a.steps
}

/// The width that is asked for (mm).
pub(super) fn width(a: &args::Draw) -> Result<Option<f64>, Failure> {
    let read = |text: &String| scene::width(text).map_err(|faults| Failure::argument("--width", text, faults));
    a.width.as_ref().map(read).transpose()
}

/// Refuses a file of a format that figures are not written in; it would become the name of a folder.
fn output(path: &str) -> Result<(), Faults> {
    let folder = path.ends_with(std::path::is_separator) || Path::new(path).is_dir();
    match files::ending(path) {
        Some(ending) if !folder && Format::of(&ending).is_none() => {
            let d = Diagnostic::error(
                "output",
                both!("{path} is neither a .svg, nor a .png, nor a .pdf file", "{path} 不是 .svg、.png 或 .pdf 文件"),
            );
            Err(d
                .help(both!(
                    "write -o figure.svg, -o figure.png or -o figure.pdf; a folder of that name is -o {path}/",
                    "请写 -o figure.svg、-o figure.png 或 -o figure.pdf；若是文件夹请指定 -o {path}/"
                ))
                .into())
        }
        _ => Ok(()),
    }
}

/// The style of a look, with the fonts of the command line before its own.
pub fn style_of(look: &args::Look) -> Result<Style, Failure> {
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

/// A bundled style by its name, or a style file.
fn read_style(name: &str) -> Result<Style, Failure> {
    if let Some(style) = Style::named(name) {
        return Ok(style);
    }
    if files::ending(name).as_deref() != Some("json") {
        let d = Diagnostic::error("unknown-style", both!("there is no style `{name}`", "没有样式 `{name}`"));
        return Err(Failure::argument(
            "--style",
            name,
            d.help(both!(
                "the styles are {}; a style of your own is a file ending in .json",
                "样式有 {}；自定义样式是以 .json 结尾的文件",
                Both::names(&Style::names())
            )),
        ));
    }
    let bytes = files::style(name).map_err(|d| Failure::argument("--style", name, d))?;
    // Fonts are named from where the style is.
    let folder = Path::new(name).parent().unwrap_or(Path::new(""));
    style::read_with(&bytes, &mut |font| files::font(&folder.join(font)))
        .map_err(|faults| Failure::input(faults, name, &String::from_utf8_lossy(&bytes)))
}

/// The figures asked for, each with the word that its file is named after.
fn pictures(wanted: &Wanted, asked: &[&'static Entry], width_mm: Option<f64>) -> Result<Warned<Pages>, Faults> {
    let mut out = Vec::new();
    let mut notes = Vec::new();
    let mut missing = Faults::default();
    for (k, entry) in asked.iter().enumerate() {
        if asked[..k].iter().any(|e| e.name == entry.name) {
            continue;
        }
        let pages = fit::drawn(entry, wanted, width_mm)?;
        notes.extend(pages.notes);
        if pages.value.is_empty() {
            let word = entry.name;
            let d = Diagnostic::error("no-figure", both!("the scene's questions call for no figure `{word}`", "所求的量用不到图 `{word}`"));
            missing.push(d.help(both!(
                "ask for one in \"find\", or leave `{word}` out of --figure",
                "请在 \"find\" 中求相应的量，或从 --figure 中去掉 `{word}`"
            )));
        }
        out.extend(pages.value);
    }
    if missing.has_errors() { Err(missing) } else { Ok(Warned { value: out, notes }) }
}

/// What is drawn with the mechanism.
///
/// # Errors
/// Vectors that the questions do not call for, points that the scene does not have.
fn extras(scene: &Scene, worked: &Worked, a: &args::Draw) -> Result<Extras, Failure> {
    let (vectors, word) = match a.vectors {
        Some(Vectors::Velocity) => (Some(Level::Velocity), "velocity"),
        Some(Vectors::Acceleration) => (Some(Level::Acceleration), "acceleration"),
        None => (None, ""),
    };
    let mut wrong = Vec::new();
    if let Some(level) = vectors.filter(|l| worked.construction.polygon(*l).is_none()) {
        let kind = if level == Level::Acceleration { both!("accelerations", "加速度") } else { both!("velocities", "速度") };
        let d = Diagnostic::error("no-figure", both!("the scene's questions call for no {}", "所求的量用不到{}", kind))
            .help(both!("ask for one in \"find\"", "请在 \"find\" 中求相应的量"));
        wrong.push(Told::argument("--vectors", word, d));
    }
    match points_named(scene, &a.path, "--path") {
        Ok(points) if wrong.is_empty() => Ok(Extras { vectors, dimensions: a.dimensions, poses: usize::from(a.poses), points }),
        Ok(_) => Err(Failure::Input(wrong)),
        Err(unknown) => {
            wrong.push(unknown);
            Err(Failure::Input(wrong))
        }
    }
}

/// The figures to draw: what goes with the mechanism alone asks for it.
fn asked<'a>(a: &'a args::Draw, extras: &Extras) -> &'a [&'static Entry] {
    let there = a.figure.iter().any(|e| e.name == list::MECHANISM.name);
    if extras.of_mechanism_alone() && !there { &[list::MECHANISM] } else { &a.figure }
}

/// The points with the names that an option lists.
///
/// # Errors
/// `unknown-point` for each name that the scene does not have.
pub fn points_named(scene: &Scene, names: &[String], option: &str) -> Result<Vec<PointId>, Told> {
    let mut faults = Faults::default();
    let mut points = Vec::new();
    let mut start = 0;
    for whole in names {
        let name = whole.trim();
        match (0..scene.points.len()).map(PointId).find(|p| scene.point_name(*p) == name) {
            Some(p) if points.contains(&p) => {}
            Some(p) => points.push(p),
            None => {
                let known = (0..scene.points.len()).map(|p| scene.point_name(PointId(p)));
                let d = Diagnostic::error("unknown-point", both!("the scene has no point `{name}`", "机构文件没有点 `{name}`"))
                    .at(Span::new(start, start + whole.len()));
                faults.push(d.help(suggest(name, known, both!("the points are", "点有"))));
            }
        }
        start += whole.len() + 1;
    }
    if faults.has_errors() { Err(Told::argument(option, &names.join(","), faults)) } else { Ok(points) }
}

/// The files of each figure: one file when the output ends in a format's name, else one for each format in a folder.
fn names(a: &args::Draw, scene: &str, figures: &[(String, Figure)]) -> Result<Vec<Vec<(Format, PathBuf)>>, Faults> {
    let out = Path::new(&a.output);
    let one = files::ending(&a.output).and_then(|e| Format::of(&e));
    if let (Some(format), [_]) = (one, figures) {
        return Ok(vec![vec![(format, out.to_path_buf())]]);
    }
    if one.is_some() {
        let d = Diagnostic::error(
            "output",
            both!("{} is one file; {} figures are asked for", "{} 是一个文件，而要画 {} 个图", a.output, figures.len()),
        );
        return Err(d
            .help(both!("name a folder, such as -o out/, or ask for one figure", "请指定文件夹，如 -o out/，或只画一个图"))
            .into());
    }
    let stem = files::stem(scene, "sheet");
    let file = |word: &str, f: Format| {
        let dash = if word.is_empty() { "" } else { "-" };
        out.join(format!("{stem}{dash}{word}.{}", f.ending()))
    };
    Ok(figures.iter().map(|(word, _)| a.format.iter().map(|f| (*f, file(word, *f))).collect()).collect())
}
