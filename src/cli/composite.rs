//! `hodograph composite`: the suitable moving points and frames, and the parts of the motion for
//! those that the scene names.

use super::{CommandResult, SceneInput, args, choices, files};
use crate::composite;
use crate::diag::Warned;
use crate::mechanism::Mechanism;
use crate::report::composite as report;
use std::process::ExitCode;

/// Largest number of choices that are worked out if the scene names none.
const MOST: usize = 3;

/// Runs the command.
pub fn run(a: args::CompositeArgs) -> CommandResult {
    let mut input = SceneInput::read(&a.common)?;
    let (lang, notation) = choices(&input.scene, &a.common);
    Mechanism::new(&input.scene).map_err(|f| input.failed(f))?;
    let staged = composite::ContactScene::new(&input.scene);
    let all = staged.choices(&input.scene);
    let shown = staged.shown(&input.scene, MOST);
    let Warned { value, notes } = staged
        .solved_with_second(&input.scene, &shown, composite::level(&input.scene))
        .map_err(|f| input.failed(f))?;
    input.file.notes.extend(notes);
    let (_, solved) = value;
    if a.json {
        files::print(&format!("{:#}\n", report::json(&staged, &all, &solved, &input.file.notes)))?;
        return Ok(ExitCode::SUCCESS);
    }
    files::print(&report::text(&staged.scene, &all, &solved, lang, &notation))?;
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}
