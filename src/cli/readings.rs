//! `hodograph readings`: the answers of each reading of a scene without its figure, and the reading
//! that gives the printed answers.

use super::{CommandResult, SceneInput, args, choices, files};
use crate::attempts::wanted;
use crate::diag::{Faults, both};
use crate::report::readings as report;
use crate::scene;
use crate::worked::{Scope, work};
use std::process::ExitCode;

/// Runs the command.
pub fn run(a: args::ReadingsArgs) -> CommandResult {
    let input = SceneInput::read(&a.common)?;
    let (lang, _) = choices(&input.scene, &a.common);
    let mut all = Vec::new();
    let mut faults = Faults::default();
    for reading in scene::readings::readings(&input.file.source).map_err(|f| input.failed(f))? {
        let read = || -> Result<report::SolvedReading, Faults> {
            let scene = scene::read(&reading.text)?.value;
            let worked = work(&scene, Scope::Figure)?.value;
            let named = if scene.attempts.is_empty() {
                Vec::new()
            } else {
                wanted(&scene, &worked, false)?
            };
            Ok(report::SolvedReading { name: reading.name.clone(), scene, worked, attempts: named })
        };
        match read() {
            Ok(read) => all.push(read),
            // Their places refer to a generated text: the reading is named instead.
            Err(f) => faults.list.extend(f.list.into_iter().map(|mut d| {
                d.message = both!("reading `{}`: {}", reading.name, d.message);
                d.span = None;
                d
            })),
        }
    }
    if faults.has_errors() {
        return Err(input.failed(faults));
    }
    if a.json {
        files::print(&format!("{:#}\n", report::json(&all)))?;
        input.file.say_notes_beside_json();
    } else {
        files::print(&report::text(&all, lang))?;
        input.file.say_notes();
    }
    Ok(ExitCode::SUCCESS)
}
