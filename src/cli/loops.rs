//! `hodograph loops`: the analytic method written out.

use super::{CommandResult, SceneInput, args, choices, files};
use crate::diag::Warned;
use crate::loops;
use crate::report::loops as report;
use std::process::ExitCode;

/// Runs the command.
pub fn run(a: &args::LoopsArgs) -> CommandResult {
    let mut input = SceneInput::read(&a.common)?;
    let (lang, _) = choices(&input.scene, &a.common);
    let Warned { value, notes } = loops::loops(&input.scene).map_err(|f| input.failed(f))?;
    input.file.notes.extend(notes);
    if a.json {
        files::print(&format!("{:#}\n", report::json(&input.scene, &value)))?;
        input.file.say_notes_beside_json();
        return Ok(ExitCode::SUCCESS);
    }
    files::print(&report::LoopWords::new(&input.scene, &value, lang).text())?;
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}
