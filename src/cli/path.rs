//! `hodograph path`: paths of points over the mechanism, and the hodographs of their velocities and
//! accelerations.

use super::args::PathArgs;
use super::curvature::links_named;
use super::draw::style_of;
use super::places::{once, places};
use super::values::FigureFormat;
use super::{CommandResult, Failure, SceneInput, choices, files};
use crate::diag::Warned;
use crate::figure::path::{MARKS, PathContent, figure, seen};
use crate::figure::sheet::SheetOptions;
use crate::problem::points_named;
use crate::problem::range::swept_of;
use crate::worked::Scope;
use std::process::ExitCode;

/// Runs the command.
pub fn run(a: PathArgs) -> CommandResult {
    let named = a
        .output
        .as_deref()
        .map(|output| places(output, &a.format, FigureFormat::Svg))
        .transpose()?;
    let style = style_of(&a.look)?;
    let mut input = SceneInput::read(&a.common)?.drawn_in(&style);
    input.over_a_turn();
    let worked = input.work(Scope::Figure)?;
    let swept = swept_of(&input.scene, a.moves.over.as_deref())?;
    let points = points_named(&input.scene, &a.point, "point")?;
    let (lang, notation) = choices(&input.scene, &a.common);
    let options = SheetOptions {
        notation: style.marks.over(&notation),
        style,
        ..SheetOptions::of_language(lang)
    };
    let poses = usize::from(a.poses);
    let marks = a.marks.map_or(if poses > 0 { poses } else { MARKS }, usize::from);
    let wanted = PathContent { points, swept, marks, poses };
    let against = links_named(&input.scene, a.against.as_slice(), "--against")
        .map_err(|fault| Failure::Input(vec![fault]))?;
    let Warned { value, notes } = match against[..] {
        [link, ..] => seen(&input.scene, &worked, &options, &wanted, link),
        [] => figure(&input.scene, &worked, &options, &wanted),
    }
    .map_err(|f| input.failed(f))?;
    let places = named.unwrap_or_else(|| {
        let formats = if a.format.is_empty() { vec![FigureFormat::Svg] } else { once(&a.format) };
        formats
            .into_iter()
            .map(|f| (f, format!("{}-path.{}", files::stem(&input.file.name, "scene"), f.ending())))
            .collect()
    });
    let Warned { value: names, notes: more } = files::figure(&value, &places)?;
    input.file.notes.extend(more);
    files::print_names(&names)?;
    input.file.notes.extend(notes);
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}
