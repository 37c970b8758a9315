//! `batch --shard` and `hodograph shards`: the commands for a batch as parts in a folder ([`parts`](super::parts)).
//!
//! Task I of N computes every N-th part, skips finished ones and continues those that were
//! interrupted.

use super::args::ShardsArgs;
use super::batch::{BatchRun, WorkWatch, bar, changed};
use super::parts::PartFolder;
use super::values::{BatchFormat, Shard, ShardsAction};
use super::{CommandResult, Failure, files, lang, places, stop};
use crate::diag::{Diagnostic, both};
use std::path::Path;
use std::process::ExitCode;

/// Returns the format of the parts in a folder.
///
/// # Errors
/// `format` for the name of a table, and for several formats.
pub fn format(output: &str, formats: &[BatchFormat]) -> Result<BatchFormat, Failure> {
    if places::of_name::<BatchFormat>(output).is_none() && output != "-" {
        // The folder's name carries no format: that of a stream is the one asked for.
        return places::in_stream("-", formats, BatchFormat::Parquet);
    }
    let message = both!("{output} is no name of a folder, and --shard writes parts into a folder");
    let help = both!(
        "write -o parts/ --format parquet; `hodograph shards compact parts/ -o table.parquet` joins them"
    );
    Err(Failure::argument("-o", output, Diagnostic::error("output", message).help(help)))
}

/// Computes the missing parts of a shard.
pub fn compute(run: BatchRun, shard: Shard, per_part: Option<u64>, folder: &Path) -> CommandResult {
    let parts = PartFolder::begun(folder, run, per_part)?;
    let step = shard.of.try_into().unwrap_or(usize::MAX);
    let own: Vec<u64> = (shard.number - 1..parts.count()).step_by(step).collect();
    let bar = bar(own.iter().map(|&k| parts.mechanisms(k)).sum());
    stop::watch();
    let done = |more| bar.inc(more);
    let count =
        parts.computed(&own, &WorkWatch { stop: &stop::asked, done: &done, changed: &changed })?;
    bar.finish_and_clear();
    files::print(lang::of(&both!(
        "{}: shard {} of {}, {} of {} parts: {} mechanisms, {} rows, {} positions without one\n",
        folder.display(),
        shard.number,
        shard.of,
        own.len(),
        parts.count(),
        count.mechanisms,
        count.rows,
        count.missing
    )))
}

/// Runs the command `shards`.
pub fn run(a: &ShardsArgs) -> CommandResult {
    let parts = PartFolder::opened(Path::new(&a.folder))?;
    match a.action {
        ShardsAction::Missing => missing(&parts, a.of),
        ShardsAction::Verify => verify(&parts, &a.folder, a.remove_damaged),
        ShardsAction::Compact => compact(&parts, a.output.as_deref().unwrap_or("-")),
    }
}

/// Prints the missing parts, or the shards of `of` that have some, counted from 1: `2,5-7`.
fn missing(parts: &PartFolder, of: Option<u64>) -> CommandResult {
    let mut numbers = parts.missing();
    if let Some(of) = of {
        numbers.iter_mut().for_each(|k| *k = *k % of + 1);
    }
    numbers.sort_unstable();
    numbers.dedup();
    let runs = numbers.chunk_by(|a, b| a + 1 == *b).filter_map(|run| match run {
        [one] => Some(one.to_string()),
        [first, .., last] => Some(format!("{first}-{last}")),
        [] => None,
    });
    let list = runs.collect::<Vec<_>>().join(",");
    files::print(&if list.is_empty() { list } else { list + "\n" })
}

/// Reads all parts; exit code 1 if some are missing or damaged.
fn verify(parts: &PartFolder, folder: &str, remove: bool) -> CommandResult {
    let told = parts.verified(remove)?;
    let mut text = String::new();
    for &k in &told.damaged {
        text += lang::of(&both!("{}: damaged\n", parts.path(k).display()));
    }
    let (absent, damaged) = (told.absent.len(), told.damaged.len());
    text += lang::of(&both!(
        "{folder}: {} parts, {absent} missing, {damaged} damaged; {} rows, {} positions without one, CRC-32 {:08x}\n",
        parts.count(),
        told.count.rows,
        told.count.missing,
        told.sum
    ));
    files::print_names(&text)?;
    Ok(if absent + damaged == 0 { ExitCode::SUCCESS } else { ExitCode::from(1) })
}

/// Joins all parts into one table.
fn compact(parts: &PartFolder, output: &str) -> CommandResult {
    let count = parts.joined(output)?;
    files::print(lang::of(&both!(
        "{output}: {} mechanisms, {} rows, {} positions without one\n",
        count.mechanisms,
        count.rows,
        count.missing
    )))
}
