//! `hodograph draw`: the sheet, single figures and the construction's steps, into the files that were asked for.

use super::args::{self, Format, Picture};
use super::{Failure, Input, Run, choices, files, verdict};
use crate::diag::{Diagnostic, Faults};
use crate::figure::item::Figure;
use crate::figure::sheet::{Options, Single, sheet, single};
use crate::figure::steps;
use crate::figure::style::{self, Style};
use crate::mechanism::Level;
use crate::render::{png, svg};
use crate::scene::Scene;
use crate::worked::{Scope, Worked};
use std::path::{Path, PathBuf};

/// Runs the command.
pub fn run(a: args::Draw) -> Run {
    let style = read_style(&a.style)?;
    let mut input = Input::read(&a.common.scene)?;
    let drafting = input.pencil(a.drafting.as_deref())?;
    let mut worked = input.work(Scope::Figure)?;
    if drafting {
        worked = worked.with_drafting(&input.scene);
    }
    let (lang, notation) = choices(&input.scene, &a.common);
    let options = Options { lang, notation: style.marks.over(&notation), digits: a.digits, style };
    let failed = |faults| Failure::Input(faults, input.name.clone(), input.source.clone());
    let figures = if a.steps {
        steps::figures(&input.scene, &worked, &options).into_iter().enumerate().map(|(k, f)| (format!("step-{:02}", k + 1), f)).collect()
    } else {
        pictures(&input.scene, &worked, &options, &a.figure).map_err(failed)?
    };
    let names = names(&a, &input.name, &figures).map_err(failed)?;
    for ((_, figure), targets) in figures.iter().zip(names) {
        write(figure, &targets, &a).map_err(|e| match e {
            Unwritten::Faults(faults) => failed(faults),
            Unwritten::File(f) => f,
        })?;
    }
    input.say_notes();
    Ok(verdict(&worked))
}

/// A bundled style by its name, or a style file.
fn read_style(name: &str) -> Result<Style, Failure> {
    if let Some(style) = Style::named(name) {
        return Ok(style);
    }
    if !name.ends_with(".json") {
        let d = Diagnostic::error("unknown-style", format!("there is no style `{name}`"));
        let known = Style::names().join(", ");
        return Err(Failure::Input(
            d.help(format!("the styles are {known}; a style of your own is a file ending in .json")).into(),
            name.into(),
            String::new(),
        ));
    }
    let (shown, bytes) = files::read(name).map_err(|d| Failure::Input(d.into(), name.into(), String::new()))?;
    style::read(&bytes).map_err(|faults| Failure::Input(faults, shown, String::from_utf8_lossy(&bytes).into_owned()))
}

/// The figures asked for, each with the word that its file is named after.
fn pictures(scene: &Scene, worked: &Worked, options: &Options, which: &[Picture]) -> Result<Vec<(String, Figure)>, Faults> {
    let mut out = Vec::new();
    let mut missing = Faults::default();
    for (k, p) in which.iter().enumerate() {
        if which[..k].contains(p) {
            continue;
        }
        let (word, figure) = match p {
            Picture::Sheet => ("", Some(sheet(scene, worked, options)?)),
            Picture::Mechanism => ("mechanism", single(scene, worked, options, Single::Mechanism)),
            Picture::Velocity => ("velocity", single(scene, worked, options, Single::Polygon(Level::Velocity))),
            Picture::Acceleration => ("acceleration", single(scene, worked, options, Single::Polygon(Level::Acceleration))),
            Picture::Equations => ("equations", single(scene, worked, options, Single::Equations)),
            Picture::Results => ("results", single(scene, worked, options, Single::Results)),
        };
        match figure {
            Some(f) => out.push((word.to_owned(), f)),
            None => {
                let d = Diagnostic::error("no-figure", format!("the scene's questions call for no figure `{word}`"));
                missing.push(d.help(format!("ask for one in \"find\", or leave `{word}` out of --figure")));
            }
        }
    }
    if missing.has_errors() { Err(missing) } else { Ok(out) }
}

/// The files of each figure: one file when the output ends in a format's name, else one for each format in a folder.
fn names(a: &args::Draw, scene: &str, figures: &[(String, Figure)]) -> Result<Vec<Vec<(Format, PathBuf)>>, Faults> {
    let out = Path::new(&a.output);
    let one = out.extension().and_then(|e| e.to_str()).and_then(Format::of);
    if let (Some(format), [_]) = (one, figures) {
        return Ok(vec![vec![(format, out.to_path_buf())]]);
    }
    if one.is_some() {
        let d = Diagnostic::error("output", format!("{} is one file; {} figures are asked for", a.output, figures.len()));
        return Err(d.help("name a folder, such as -o out/, or ask for one figure").into());
    }
    let stem = Path::new(scene).file_stem().and_then(|s| s.to_str()).filter(|_| scene != "standard input").unwrap_or("sheet");
    let file = |word: &str, f: Format| {
        let dash = if word.is_empty() { "" } else { "-" };
        out.join(format!("{stem}{dash}{word}.{}", f.ending()))
    };
    Ok(figures.iter().map(|(word, _)| a.format.iter().map(|f| (*f, file(word, *f))).collect()).collect())
}

enum Unwritten {
    Faults(Faults),
    File(Failure),
}

fn write(figure: &Figure, targets: &[(Format, PathBuf)], a: &args::Draw) -> Result<(), Unwritten> {
    let svg = svg::write(figure).map_err(Unwritten::Faults)?.value;
    for (format, path) in targets {
        let picture;
        let bytes = match format {
            Format::Svg => svg.as_bytes(),
            Format::Png => {
                picture = png::render(&svg, a.dpi).map_err(|d| Unwritten::Faults(d.into()))?;
                &picture
            }
        };
        files::write(path, bytes).map_err(Unwritten::File)?;
        files::print(&format!("{}\n", path.display())).map_err(Unwritten::File)?;
    }
    Ok(())
}
