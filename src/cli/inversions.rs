//! `hodograph inversions`: each link of the chain as ground in turn, in words and as scene files.

use super::together::Together;
use super::{CommandResult, Failure, SceneInput, args, choices, files, places};
use crate::diag::{Diagnostic, Warned, both};
use crate::inversions::inversions;
use crate::report::inversions as report;
use hodograph_base::json::fields::suggest;
use std::path::Path;
use std::process::ExitCode;

/// Runs the command.
pub fn run(a: args::InversionsArgs) -> CommandResult {
    if a.pick.is_none() {
        places::no_report_beside(a.output.as_deref(), a.json)?;
    }
    // The rotation of links does not depend on the driver's speed.
    let mut input = SceneInput::read_at_rest(&a.common)?;
    let (lang, _) = choices(&input.scene, &a.common);
    let Warned { value: all, notes } = inversions(&input.scene).map_err(|f| input.failed(f))?;
    input.file.notes.extend(notes);
    if let Some(name) = &a.pick {
        let known = || all.iter().map(|i| i.scene.link_name(i.scene.ground));
        let Some(picked) = all.iter().find(|i| i.scene.link_name(i.scene.ground) == name) else {
            let d = Diagnostic::error(
                "unknown-link",
                both!("there is no inversion with link `{name}` as ground"),
            );
            return Err(Failure::argument(
                "--pick",
                name,
                d.help(suggest(name, known(), both!("the grounds are"))),
            ));
        };
        match &a.output {
            Some(path) => {
                files::write(Path::new(path), picked.text.as_bytes())?;
                files::print_names(&format!("{path}\n"))?;
            }
            None => {
                files::print(&picked.text)?;
            }
        }
        return Ok(ExitCode::SUCCESS);
    }
    if let Some(folder) = &a.output {
        let one = both!("choose one: --pick {}", input.scene.link_name(input.scene.ground));
        places::one_result(folder, all.len().max(2), one)?;
        let stem = files::stem(&input.file.name, "scene");
        let mut together = Together::default();
        let mut written = String::new();
        for i in &all {
            let path = Path::new(folder)
                .join(format!("{stem}-{}-fixed.json", i.scene.link_name(i.scene.ground)));
            together.add(&path, i.text.as_bytes())?;
            written += &format!("{}\n", path.display());
        }
        together.appear()?;
        files::print_names(&written)?;
    }
    if a.json {
        files::print(&format!("{:#}\n", report::json(&input.scene, &all, &input.file.notes)))?;
        input.file.say_notes_beside_json();
        return Ok(ExitCode::SUCCESS);
    }
    if a.output.is_none() {
        files::print(&report::text(&input.scene, &all, lang))?;
    }
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}
