//! `hodograph cycle`: the motion cycle of a scene's outputs as a table and a diagram.

use super::args::CycleArgs;
use super::draw::style_of;
use super::places::{no_report_beside, places};
use super::values::FigureFormat;
use super::{CommandResult, SceneInput, choices, files};
use crate::diag::Warned;
use crate::problem::cycle::CycledScene;
use std::process::ExitCode;

/// Runs the command.
pub fn run(a: CycleArgs) -> CommandResult {
    no_report_beside(a.output.as_deref(), a.json)?;
    let places =
        a.output.as_deref().map(|o| places(o, &a.format, FigureFormat::Svg)).transpose()?;
    let style = style_of(&a.look)?;
    // Phases do not depend on the driver's speed, only on its sense.
    let mut input = SceneInput::read_at_rest(&a.common)?.drawn_in(&style);
    let (lang, _) = choices(&input.scene, &a.common);
    let names: Vec<&str> = a.find.iter().map(String::as_str).collect();
    let made = CycledScene::of(input.scene.clone(), a.over.as_deref(), &names);
    let Warned { value: of, notes } = made.map_err(|f| input.out_of_range(f))?;
    input.file.notes.extend(notes);
    if let Some(places) = &places {
        let drawn = of.figure(a.form, &style, lang);
        let written = files::figure(&drawn, places)?;
        input.file.notes.extend(written.notes);
        if !a.json {
            files::print_names(&written.value)?;
        }
    }
    if a.json {
        files::print(&format!("{:#}\n", of.cycle.json()))?;
    } else if places.is_none() {
        files::print(&of.text(lang))?;
    }
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}
