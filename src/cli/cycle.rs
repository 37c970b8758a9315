//! `hodograph cycle`: the motion cycle of a scene's outputs as a table and a diagram.

use super::args::CycleArgs;
use super::draw::style_of;
use super::places::{no_report_beside, places};
use super::values::FigureFormat;
use super::{CommandResult, Failure, SceneInput, choices, files};
use crate::figure::cycle::figure;
use crate::mechanism::Mechanism;
use crate::problem::range::driver_of;
use crate::report::cycle::MotionCycle;
use crate::sweep::extreme;
use std::process::ExitCode;

/// Runs the command.
pub fn run(a: CycleArgs) -> CommandResult {
    no_report_beside(a.output.as_deref(), a.json)?;
    let places =
        a.output.as_deref().map(|o| places(o, &a.format, FigureFormat::Svg)).transpose()?;
    let style = style_of(&a.look)?;
    // Phases do not depend on the driver's speed, only on its sense.
    let mut input = SceneInput::read_at_rest(&a.common)?.drawn_in(&style);
    input.over_a_turn();
    let (lang, _) = choices(&input.scene, &a.common);
    let driver = driver_of(&input.scene, a.over.as_deref())?;
    let mechanism = Mechanism::new(&input.scene).map_err(|f| input.failed(f))?.value;
    let limits = extreme::limits(&input.scene, &mechanism, driver).map_err(|f| input.failed(f))?;
    let mut cycle = MotionCycle::of(&input.scene, driver, &limits);
    if !a.find.is_empty() {
        let names: Vec<&str> = a.find.iter().map(String::as_str).collect();
        cycle.choose(&names).map_err(|d| Failure::argument("--find", &a.find.join(","), d))?;
    }
    if let Some(places) = &places {
        let drawn = figure(&input.scene, driver, &cycle, a.form.of_figure(), &style, lang);
        let written = files::figure(&drawn, places)?;
        input.file.notes.extend(written.notes);
        if !a.json {
            files::print_names(&written.value)?;
        }
    }
    if a.json {
        files::print(&format!("{:#}\n", cycle.json()))?;
    } else if places.is_none() {
        files::print(&cycle.text(&input.scene, lang))?;
    }
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}
