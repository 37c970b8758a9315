//! `hodograph attempts`: the wrong solutions that the scene names, or all typical mistakes that are
//! possible in it.

use super::{CommandResult, SceneInput, args, choices, files};
use crate::attempts;
use crate::certified::certify;
use crate::report::answers::DIGITS;
use crate::report::attempts as report;
use crate::worked::Scope;
use std::process::ExitCode;

/// Runs the command.
pub fn run(a: args::AttemptsArgs) -> CommandResult {
    let mut input = SceneInput::read(&a.common)?;
    let worked = input.work(Scope::Figure)?;
    let (lang, notation) = choices(&input.scene, &a.common);
    let all = attempts::wanted(&input.scene, &worked, a.all).map_err(|f| input.failed(f))?;
    let certified = certify(&input.scene, &worked, DIGITS);
    let words = report::AttemptWords {
        scene: &input.scene,
        worked: &worked,
        certified: &certified,
        notation: &notation,
        lang,
        digits: DIGITS,
    };
    if a.json {
        files::print(&format!("{:#}\n", report::json(&words, &all)))?;
        return Ok(ExitCode::SUCCESS);
    }
    files::print(&report::text(&words, &all))?;
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}
