//! `hodograph animate`: the mechanism with its polygons through the travel of a driver, as an
//! animation or as single frames.

use super::args::AnimateArgs;
use super::draw::style_of;
use super::places::{one_result, places};
use super::together::Together;
use super::values::MotionFormat;
use super::{CommandResult, Failure, SceneInput, choices, files, ids};
use crate::diag::{Diagnostic, Faults, Warned, both};
use crate::figure::poses::{PosesContent, turn};
use crate::figure::sheet::SheetOptions;
use crate::paper::item::Figure;
use crate::problem::range::swept_of;
use crate::render::{gif, moving, png, svg};
use crate::worked::Scope;
use rayon::prelude::*;
use std::path::Path;
use std::process::ExitCode;

/// Millimetres of an inch.
const INCH_MM: f64 = 25.4;

/// Runs the command.
pub fn run(a: AnimateArgs) -> CommandResult {
    let places = places(&a.output, &a.format, MotionFormat::Svg)?;
    if places.iter().any(|p| p.0 == MotionFormat::Png) {
        let one = both!("ask for one file that moves: --format svg or --format gif");
        one_result(&a.output, usize::from(a.frames), one)?;
    }
    let style = style_of(&a.look)?;
    let mut input = SceneInput::read(&a.common)?.drawn_in(&style);
    input.over_a_turn();
    let worked = input.work(Scope::Figure)?;
    let swept = swept_of(&input.scene, a.moves.over.as_deref())?;
    let (lang, notation) = choices(&input.scene, &a.common);
    let options = SheetOptions {
        notation: style.marks.over(&notation),
        style,
        ..SheetOptions::of_language(lang)
    };
    let wanted = PosesContent { count: usize::from(a.frames), swept, points: Vec::new() };
    let made = turn(&input.scene, &worked, &options, &wanted, INCH_MM / a.dpi)
        .map_err(|f| input.failed(f))?;
    let Warned { value, notes } = made;
    let period = value.period();
    let (mut all, mut names) = (Together::default(), String::new());
    for (format, path) in &places {
        let bytes = match format {
            MotionFormat::Gif => {
                gif::write(&written(&period)?, a.dpi, a.seconds).map_err(of_figure)?
            }
            MotionFormat::Svg => ids::put_before(
                &moving::write(&period, a.seconds).map_err(|f| Failure::input(f, "", ""))?,
            )
            .into_owned()
            .into_bytes(),
            MotionFormat::Png => {
                names += &frames(path, &written(&period)?, a.dpi, &mut all)?;
                continue;
            }
        };
        all.add(Path::new(path), &bytes)?;
        names += &format!("{path}\n");
    }
    all.appear()?;
    files::print_names(&names)?;
    input.file.notes.extend(notes);
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}

/// Writes the frames as SVG, each figure once.
fn written(period: &[&Figure]) -> Result<Vec<String>, Failure> {
    let all: Result<Vec<String>, Faults> =
        period.par_iter().map(|f| Ok(svg::write(f)?.value)).collect();
    all.map_err(|f| Failure::input(f, "", ""))
}

fn of_figure(d: Diagnostic) -> Failure {
    Failure::input(d, "", "")
}

/// Writes one picture per frame, with the frame's number after the requested name; returns the file
/// names.
fn frames(
    path: &str,
    all: &[String],
    dpi: f64,
    together: &mut Together,
) -> Result<String, Failure> {
    let pictures: Result<Vec<Vec<u8>>, Diagnostic> =
        all.par_iter().map(|svg| png::render(svg, dpi)).collect();
    let stem = Path::new(path).with_extension("");
    let mut names = String::new();
    for (k, bytes) in pictures.map_err(of_figure)?.iter().enumerate() {
        let name = format!("{}-{:03}.png", stem.display(), k + 1);
        together.add(Path::new(&name), bytes)?;
        names.push_str(&format!("{name}\n"));
    }
    Ok(names)
}
