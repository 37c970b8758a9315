//! `hodograph centres`: all instantaneous centres, the construction of each, and the quantities
//! that follow from them.

use super::{CommandResult, SceneInput, args, choices, files, pencil};
use crate::centres;
use crate::diag::Warned;
use crate::report::{centres as report, centres_json};
use std::process::ExitCode;

/// Runs the command.
pub fn run(a: args::CentresArgs) -> CommandResult {
    // A centre does not depend on the driver's speed.
    let mut input = SceneInput::read_at_rest(&a.common)?;
    let (lang, _) = choices(&input.scene, &a.common);
    if let Some(mm) = pencil(a.drafting.as_deref())? {
        input.scene.paper.pencil_mm = Some(mm);
    }
    let Warned { value, notes } = centres::centres(&input.scene).map_err(|f| input.failed(f))?;
    input.file.notes.extend(notes);
    let value = if a.drafting.is_some() { value.with_drafting() } else { value };
    if a.json {
        files::print(&format!("{:#}\n", centres_json::json(&value, &input.file.notes)))?;
        return Ok(ExitCode::SUCCESS);
    }
    files::print(&report::text(&value, lang))?;
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}
