//! The command `centres`: all instantaneous centres, how each is found, and what they tell.

use super::{Input, Run, args, choices, files};
use crate::centres;
use crate::diag::Warned;
use crate::report::{centres as report, centres_json};
use std::process::ExitCode;

/// Runs the command.
pub fn run(a: args::Centres) -> Run {
    // A centre does not depend on how fast the driver goes.
    let mut input = Input::read_at_rest(&a.common)?;
    let (lang, _) = choices(&input.scene, &a.common);
    let Warned { value, notes } = centres::centres(&input.scene).map_err(|f| input.failed(f))?;
    input.file.notes.extend(notes);
    if a.json {
        files::print(&format!("{:#}\n", centres_json::json(&value, &input.file.notes)))?;
        return Ok(ExitCode::SUCCESS);
    }
    files::print(&report::text(&value, lang))?;
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}
