//! `hodograph variants`: a problem with other numbers for each student, with keys.

use super::draw::style_of;
use super::together::Together;
use super::{CommandResult, Failure, SceneInput, args, files, look_of, places};
use crate::diag::{Diagnostic, Warned, both};
use crate::homework::{self, HomeworkAdditions, HomeworkRequest};
use crate::problem::whole_page;
use crate::zip::ArchiveFile;
use std::path::Path;
use std::process::ExitCode;

/// Runs the command.
pub fn run(a: args::VariantsArgs) -> CommandResult {
    let style = style_of(&a.look)?;
    let mut input = SceneInput::read(&a.common)?.drawn_in(&style);
    let folder = both!("name a folder: -o set/");
    places::one_result(&a.output, 4, folder)?;
    let students = match &a.roster {
        Some(path) => roster(path)?,
        None => Vec::new(),
    };
    let count = homework::count(a.count.map(usize::from), students.len(), !a.vary.is_empty())?;
    let request = HomeworkRequest { vary: &a.vary, count, seed: a.seed, students: &students };
    let Warned { value: all, notes } = homework::variants(&input.file.source, &request)
        .map_err(|fault| input.out_of_range(fault))?;
    input.file.notes.extend(notes);
    let look = look_of(&a.common, style, a.digits);
    // All bytes are made before the first file is begun: until then a signal ends the run at once.
    let platforms = places::once(&a.to);
    let frame = a.frame.then(|| whole_page(&a.page)).transpose()?;
    let wanted = HomeworkAdditions { platforms: &platforms, frame };
    let Warned { value: made, notes } =
        homework::files(&all, &wanted, &look).map_err(|fault| input.out_of_range(fault))?;
    input.file.notes.extend(notes);
    let (mut together, mut written) = (Together::default(), String::new());
    for ArchiveFile { path, bytes } in made {
        let path = Path::new(&a.output).join(path);
        together.add(&path, &bytes)?;
        written += &format!("{}\n", path.display());
    }
    together.appear()?;
    files::print_names(&written)?;
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}

fn roster(path: &str) -> Result<Vec<String>, Failure> {
    let (name, text) = table(path)?;
    homework::names(&text).map_err(|f| Failure::input(f, &name, &text))
}

/// Reads a table of a teacher; returns the name to show and the text.
pub(super) fn table(path: &str) -> Result<(String, String), Failure> {
    let (name, bytes) = files::table(path).map_err(|d| Failure::input(d, path, ""))?;
    match String::from_utf8(bytes) {
        Ok(text) => Ok((name, text)),
        Err(_) => {
            let message = both!("{name} is not UTF-8 text");
            let d =
                Diagnostic::error("table", message).help(both!("save the table as \"CSV UTF-8\""));
            Err(Failure::input(d, path, ""))
        }
    }
}
