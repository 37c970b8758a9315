//! Destinations and formats of results: `-o` and `--format` of all commands.
//!
//! The ending of `-o` decides. Without an ending `--format` does; it is a list with commas, or is
//! given several times. A single format is written to the name itself, several are each written to
//! the name with their ending. Standard output, a pipe and a device take one result in one format.

use super::target::is_stream;
use super::{Failure, files};
use crate::diag::{Both, Diagnostic, both};
use clap::ValueEnum;

/// A result's format and its file.
pub type OutputPlace<F> = (F, String);

/// An output's name in sentences.
pub fn shown(output: &str) -> Both {
    if output == "-" { both!("standard output") } else { Both::same(output) }
}

/// The ending of a format's files: its name on the command line.
pub fn ending<F: ValueEnum>(format: F) -> String {
    format.to_possible_value().map(|v| v.get_name().to_owned()).unwrap_or_default()
}

/// The format for a file's ending, if it is one of the command's formats.
pub fn of_name<F: ValueEnum + Copy>(path: &str) -> Option<F> {
    let named = files::ending(path)?;
    F::value_variants().iter().copied().find(|f| ending(*f) == named)
}

/// Returns the places of one result.
///
/// # Errors
/// `output` if neither the name nor `--format` gives a format; `format` if the two contradict each
/// other or a stream is to take several formats.
pub fn places<F: ValueEnum + Copy + PartialEq>(
    output: &str,
    formats: &[F],
    usual: F,
) -> Result<Vec<OutputPlace<F>>, Failure> {
    let formats = once(formats);
    if is_stream(output) {
        return Ok(vec![(in_stream(output, &formats, usual)?, output.to_owned())]);
    }
    if let Some(named) = of_name(output) {
        agrees(output, named, &formats)?;
        return Ok(vec![(named, output.to_owned())]);
    }
    if formats.is_empty() {
        return Err(no_format::<F>(output));
    }
    if output.ends_with(std::path::is_separator) || std::path::Path::new(output).is_dir() {
        let d = Diagnostic::error("output", both!("{output} is a folder, a file is wanted here"));
        let example = ending(formats[0]);
        return Err(Failure::argument("-o", output, d.help(both!("write -o name.{example}"))));
    }
    let name = |f: &F| {
        if formats.len() == 1 { output.to_owned() } else { format!("{output}.{}", ending(*f)) }
    };
    Ok(formats.iter().map(|f| (*f, name(f))).collect())
}

/// Returns each format once.
pub fn once<F: Copy + PartialEq>(formats: &[F]) -> Vec<F> {
    let mut all: Vec<F> = Vec::new();
    formats.iter().for_each(|f| {
        if !all.contains(f) {
            all.push(*f)
        }
    });
    all
}

/// Returns the format for a stream.
///
/// # Errors
/// `format` if several are requested.
pub fn in_stream<F: ValueEnum + Copy>(output: &str, formats: &[F], usual: F) -> Result<F, Failure> {
    match formats {
        [] => Ok(of_name(output).unwrap_or(usual)),
        [one] => Ok(*one),
        [first, ..] => {
            let message = both!(
                "{} takes one result, and --format asks for {}",
                shown(output),
                formats.len()
            );
            let first = ending(*first);
            let help = both!("ask for one format: --format {first}");
            Err(Failure::argument("-o", output, Diagnostic::error("format", message).help(help)))
        }
    }
}

/// Checks that `--format` agrees with the file's ending or is not given.
///
/// # Errors
/// `format` if it gives another.
pub fn agrees<F: ValueEnum + Copy + PartialEq>(
    output: &str,
    named: F,
    formats: &[F],
) -> Result<(), Failure> {
    if formats.iter().all(|f| *f == named) {
        return Ok(());
    }
    let asked: Vec<String> = formats.iter().map(|f| ending(*f)).collect();
    let message =
        both!("{output} ends in .{}, and --format says {}", ending(named), Both::names(&asked));
    let stem = std::path::Path::new(output).with_extension("");
    let help = both!(
        "leave --format out, or the ending: -o {} --format {}",
        stem.display(),
        asked.join(",")
    );
    Err(Failure::argument("-o", output, Diagnostic::error("format", message).help(help)))
}

/// The fault of a name without a format of the command.
pub fn no_format<F: ValueEnum + Copy>(output: &str) -> Failure {
    let all: Vec<String> = F::value_variants().iter().map(|f| format!(".{}", ending(*f))).collect();
    let message = both!("{output} ends in none of {}", Both::names(&all));
    let first = F::value_variants().first().copied().map(ending).unwrap_or_default();
    let help =
        both!("name the file after its format, such as -o name.{first}, or add --format {first}");
    Failure::argument("-o", output, Diagnostic::error("output", message).help(help))
}

/// Refuses several results for a stream.
///
/// # Errors
/// `output`, with advice on how to request one.
pub fn one_result(output: &str, count: usize, how: Both) -> Result<(), Failure> {
    if count == 1 || !is_stream(output) {
        return Ok(());
    }
    let message = both!("{} takes one result, and there are {count}", shown(output));
    Err(Failure::argument("-o", output, Diagnostic::error("output", message).help(how)))
}

/// Refuses two results for standard output: that of `-o` and the report as JSON.
///
/// # Errors
/// `output`.
pub fn no_report_beside(output: Option<&str>, json: bool) -> Result<(), Failure> {
    match output.filter(|o| json && super::target::is_stdout(o)) {
        None => Ok(()),
        Some(output) => {
            let message = both!("-o {output} and --json both write to standard output");
            let help = both!("name a file with -o, or leave --json out");
            Err(Failure::argument("-o", output, Diagnostic::error("output", message).help(help)))
        }
    }
}
