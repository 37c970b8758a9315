//! `hodograph mobility`: the degree of freedom as text or JSON, and the groups drawn apart.

use super::draw::style_of;
use super::values::FigureFormat;
use super::{CommandResult, SceneInput, args, choices, files, places};
use crate::figure::groups;
use crate::report::mobility as report;
use crate::scene::{self, Scene};
use crate::worked::{Scope, work};
use std::process::ExitCode;

/// Returns a scene of which only the pose matters; if it has no drivers, with drivers that move it.
pub(super) fn posed_scene(scene: Scene) -> Scene {
    let chosen = || report::surveyed(&scene).0.choices.into_iter().next().map(|c| c.scene.drivers);
    let drivers =
        if scene.drivers.is_empty() { chosen().unwrap_or_default() } else { scene.drivers.clone() };
    Scene { find: Vec::new(), drivers, ..scene }
}

/// Runs the command.
pub fn run(a: args::MobilityArgs) -> CommandResult {
    places::no_report_beside(a.output.as_deref(), a.json)?;
    let places = a
        .output
        .as_deref()
        .map(|output| places::places(output, &a.format, FigureFormat::Svg))
        .transpose()?;
    let style = style_of(&a.look)?;
    let mut input = SceneInput::read_topology(&a.common)?.drawn_in(&style);
    let (lang, notation) = choices(&input.scene, &a.common);
    let (survey, checked) = report::surveyed(&input.scene);
    if let Some(places) = &places {
        // A drawing needs the pose; missing data are reported as in other commands.
        let posed = scene::read_pose(&input.file.source).map_err(|f| input.failed(f))?;
        let asked = posed_scene(posed.value);
        let worked = work(&asked, Scope::Figure).map_err(|f| input.failed(f))?;
        let notation = style.marks.over(&notation);
        let figure = groups::figure(&asked, &worked.value, &style, &notation, lang)
            .map_err(|f| input.failed(f))?;
        input.file.notes.extend(files::figure(&figure, places)?.notes);
        input.file.notes.extend(worked.notes);
    }
    if a.json {
        files::print(&format!("{:#}\n", report::json(&input.scene, &survey, &checked)))?;
    } else {
        files::print(&report::text(&input.scene, &survey, &checked, lang))?;
    }
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}
