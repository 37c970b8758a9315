//! `hodograph animate`: the mechanism with its polygons through the travel of a driver, as a moving picture or as its frames.

use super::args::Animate;
use super::draw::style_of;
use super::sweep::swept_of;
use super::together::Together;
use super::{Failure, Input, Run, choices, files, ids};
use crate::diag::{Diagnostic, Faults, Warned, both};
use crate::figure::poses::{Wanted, turn};
use crate::figure::sheet::Options;
use crate::paper::item::Figure;
use crate::render::{gif, moving, png, svg};
use crate::worked::Scope;
use rayon::prelude::*;
use std::path::Path;
use std::process::ExitCode;

/// Millimetres of an inch.
const INCH_MM: f64 = 25.4;

/// What is written.
enum Format {
    Gif,
    Svg,
    Frames,
}

/// Runs the command.
pub fn run(a: Animate) -> Run {
    let path = a.output.as_str();
    let format = match files::ending(path).as_deref() {
        Some("gif") => Format::Gif,
        Some("svg") => Format::Svg,
        Some("png") => Format::Frames,
        _ => {
            let d = Diagnostic::error(
                "output",
                both!("{path} is neither a .gif, nor a .svg, nor a .png file", "{path} 不是 .gif、.svg 或 .png 文件"),
            );
            let help = both!(
                "write -o turn.gif, -o turn.svg, or -o turn.png for frames turn-001.png, …",
                "请写 -o turn.gif、-o turn.svg，或 -o turn.png（得到各帧 turn-001.png……）"
            );
            return Err(Failure::argument("-o", path, d.help(help)));
        }
    };
    let style = style_of(&a.look)?;
    let mut input = Input::read(&a.common)?.drawn_in(&style);
    input.over_a_turn();
    let worked = input.work(Scope::Figure)?;
    let swept = swept_of(&input.scene, a.moves.over.as_deref())?;
    let (lang, notation) = choices(&input.scene, &a.common);
    let options = Options { notation: style.marks.over(&notation), style, ..Options::of_language(lang) };
    let wanted = Wanted { count: usize::from(a.frames), swept, points: Vec::new() };
    let made = turn(&input.scene, &worked, &options, &wanted, INCH_MM / a.dpi).map_err(|f| input.failed(f))?;
    let Warned { value, notes } = made;
    let period = value.period();
    let names = match format {
        Format::Gif => {
            let bytes = gif::write(&written(&period)?, a.dpi, a.seconds).map_err(of_figure)?;
            files::write(Path::new(path), &bytes)?;
            format!("{path}\n")
        }
        Format::Svg => {
            let text = moving::write(&period, a.seconds).map_err(|f| Failure::input(f, "", ""))?;
            files::write(Path::new(path), ids::put_before(&text).as_bytes())?;
            format!("{path}\n")
        }
        Format::Frames => frames(path, &written(&period)?, a.dpi)?,
    };
    files::print_names(&names)?;
    input.notes.extend(notes);
    input.say_notes();
    Ok(ExitCode::SUCCESS)
}

/// The frames as SVG, each figure once.
fn written(period: &[&Figure]) -> Result<Vec<String>, Failure> {
    let all: Result<Vec<String>, Faults> = period.par_iter().map(|f| Ok(svg::write(f)?.value)).collect();
    all.map_err(|f| Failure::input(f, "", ""))
}

fn of_figure(d: Diagnostic) -> Failure {
    Failure::input(d, "", "")
}

/// A picture for each frame, numbered behind the name that was asked for; returns their names.
fn frames(path: &str, all: &[String], dpi: f64) -> Result<String, Failure> {
    let pictures: Result<Vec<Vec<u8>>, Diagnostic> = all.par_iter().map(|svg| png::render(svg, dpi)).collect();
    let stem = Path::new(path).with_extension("");
    let (mut together, mut names) = (Together::default(), String::new());
    for (k, bytes) in pictures.map_err(of_figure)?.iter().enumerate() {
        let name = format!("{}-{:03}.png", stem.display(), k + 1);
        together.add(Path::new(&name), bytes)?;
        names.push_str(&format!("{name}\n"));
    }
    together.appear()?;
    Ok(names)
}
