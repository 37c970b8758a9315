//! `hodograph synth`: a synthesis file to candidates, as a table or JSON, and one of them as a
//! scene file.

use super::{CommandResult, Failure, InputFile, errors, files, lang, places};
use crate::diag::{Both, Diagnostic, both};
use crate::digits::significant;
use crate::problem::{self, Kind, Look, Options};
use crate::report::synthesis::course_csv;
use clap::Args as ClapArgs;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

/// The arguments of the command.
#[derive(ClapArgs, Debug)]
#[command(
    after_help = "Start: hodograph new time-ratio > wish.json && hodograph synth wish.json; the construction: hodograph draw wish.json -o out/; problem and solution: hodograph worksheet wish.json -o sheet.pdf"
)]
pub struct SynthArgs {
    /// The synthesis file; `-` reads standard input
    #[arg(value_name = "FILE")]
    pub file: String,
    /// Give a parameter of the file another value: NAME=VALUE; a bare number keeps the unit
    #[arg(long, value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// The candidate that is meant, counted from 1 in the order of the table
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub pick: Option<u64>,
    /// Write the scene of the candidate to this file or to `-`, standard output (default: of the
    /// first one)
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<String>,
    /// The candidates as JSON, in SI, with their scenes
    #[arg(long)]
    pub json: bool,
    /// The construction with ruler and paper too, step by step, with the lengths measured
    #[arg(long)]
    pub steps: bool,
    /// For a function: write the table of wanted and real angles to this file ending in .csv, or to
    /// `-`, standard output, in place of the candidates
    #[arg(long, value_name = "FILE", conflicts_with_all = ["json", "steps"])]
    pub table: Option<String>,
    /// For a search: its duration, and the positions evaluated per second (on standard error)
    #[arg(long)]
    pub speed: bool,
}

/// Runs the command.
pub fn run(a: SynthArgs) -> CommandResult {
    places::no_report_beside(a.output.as_deref(), a.json)?;
    let start = Instant::now();
    let mut file = InputFile::open(&a.file, &a.set)?;
    let problem = file.read(|bytes| problem::read_of(bytes, Kind::Task))?;
    let candidate = a.pick.map_or(0, |n| n as usize - 1);
    let solved = file.solve(&problem, &Options { candidate, ..Options::default() })?;
    let took = start.elapsed().as_secs_f64();
    let Some(design) = solved.design() else { return Ok(ExitCode::SUCCESS) };
    if a.speed {
        let evaluations = design.numbers.iter().find(|n| n.name == "evaluations").map(|n| n.value);
        let told = speed(evaluations, took);
        errors::tell_line(
            &Diagnostic::note("speed", told.clone()),
            &format!("{}\n", lang::of(&told)),
        );
    }
    if let Some(path) = &a.output {
        files::write(Path::new(path), design.candidates[candidate].scene_text().as_bytes())?;
    }
    if let Some(path) = &a.table {
        let Some(csv) = course_csv(&design.candidates[candidate]) else {
            return Err(Failure::argument("--table", path, no_course()));
        };
        files::write(Path::new(path), csv.as_bytes())?;
        if path != "-" {
            files::print_names(&format!("{path}\n"))?;
        }
        file.say_notes();
        return Ok(ExitCode::SUCCESS);
    }
    let look = Look { lang: lang::asked(), ..Look::default() };
    if a.json {
        files::print(&format!("{:#}\n", solved.json(&look, a.steps, &file.notes)))?;
    } else if let Some(path) = &a.output {
        files::print_names(&format!("{path}\n"))?;
    } else {
        files::print(&solved.text(&look, a.steps))?;
    }
    file.say_notes();
    Ok(ExitCode::SUCCESS)
}

fn no_course() -> Diagnostic {
    let message = both!("this task has no function to tabulate");
    Diagnostic::error("no-curve", message)
        .help(both!("leave --table out: it is of tasks with \"function\""))
}

/// Returns the speed of the search; other kinds have nothing to count.
fn speed(evaluations: Option<f64>, seconds: f64) -> Both {
    let took = significant(seconds, 3);
    match evaluations {
        Some(count) => both!(
            "{count} positions in {took} s: {} a second",
            significant(count / seconds.max(1e-9), 3)
        ),
        None => both!("solved in {took} s"),
    }
}
