//! `hodograph mark`: the answers of a class against the keys of its variants.

use super::variants::table;
use super::{CommandResult, Failure, SourceFaults, args, files, lang};
use crate::homework::mark;
use crate::scene::Lang;
use std::path::Path;
use std::process::ExitCode;

/// Runs the command.
pub fn run(a: &args::MarkArgs) -> CommandResult {
    let (answers, keys) = (table(&a.answers)?, table(&a.keys)?);
    let marks = mark(&answers.1, &keys.1).map_err(|f| {
        let all = [(f.answers, answers), (f.keys, keys)];
        let of = |(faults, (name, source))| SourceFaults { faults, name, source };
        Failure::Input(all.into_iter().map(of).filter(|t| t.faults.has_errors()).collect())
    })?;
    let text = marks.csv(lang::asked().unwrap_or(Lang::En));
    files::write(Path::new(&a.output), text.as_bytes())?;
    if a.output != "-" {
        files::print_names(&format!("{}\n", a.output))?;
    }
    Ok(ExitCode::SUCCESS)
}
