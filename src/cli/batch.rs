//! The command `batch`: parameters varied, many mechanisms, into one file, block by block.
//!
//! The rows go to a part file beside the output ([`Part`]). When all are written it takes its name; a run that is interrupted leaves the
//! part, and the same command goes on from there. A file that cannot be written in full is removed: whoever finds the output
//! finds all of it.

use super::args::Batch as Args;
use super::part::Part;
use super::sweep::{ask, driver_of, stations, within};
use super::{Failure, Input, Run, choices, files, long, stop, tables};
use crate::diag::{Diagnostic, Faults};
use crate::mechanism::Mechanism;
use crate::report::table::{Format, GENERATOR, Head, Piece};
use crate::scene::Scene;
use crate::sweep::Placed;
use crate::sweep::batch::{Batch, Block, Choice};
use crate::sweep::vary::Variation;
use std::io;
use std::path::Path;

/// Most steps of each mechanism: all its rows are in memory at once, of a dozen columns some ten megabytes, in each stage of the work.
const MOST_POSITIONS: usize = 100_000;

/// Numbers of a block, about: some megabytes, a row group of some 100 000 rows in Parquet.
const BLOCK: usize = 1 << 20;

pub fn batch(a: Args) -> Run {
    let mut input = Input::read(&a.common.scene)?;
    ask(&mut input, a.range.find.as_deref())?;
    let failed = |faults: Faults| Failure::Input(faults, input.name.clone(), input.source.clone());
    let ending = tables::ending(&a.output, &tables::BY_ROWS)?;
    let mechanism = Mechanism::new(&input.scene).map_err(failed)?.value;
    let batch = plan(&input.scene, &mechanism, &a).map_err(failed)?;
    let (lang, _) = choices(&input.scene, &a.common);
    let job = format!(
        "{GENERATOR} {ending} {lang:?} {:?} {:?} {:?} {:?} {:?} {:?}",
        a.vary,
        a.random,
        a.seed,
        (&a.range.over, &a.range.from, &a.range.to, a.range.steps),
        a.range.find,
        input.source
    );
    let part = write(&batch, head(&batch, input.scene.title.get(lang)), Path::new(&a.output), &job)?;
    files::print(&format!("{}: {} mechanisms, {} rows, {} positions without one\n", a.output, part.done, part.rows, part.missing))
}

/// The columns of a batch: the mechanism's number, its parameters and the driver's position come again and again.
fn head(batch: &Batch, title: &str) -> Head {
    let mut head = Head::new(title, batch.columns());
    let leading = 2 + batch.values.len();
    head.columns.iter_mut().take(leading).for_each(|c| c.repeats = true);
    head.columns.iter_mut().take(1).for_each(|c| c.whole = true);
    head
}

fn plan<'a>(scene: &'a Scene, mechanism: &'a Mechanism, a: &Args) -> Result<Batch<'a>, Faults> {
    let mut names = Vec::new();
    let mut ranges = Vec::new();
    let mut faults = Faults::default();
    for text in &a.vary {
        match range(text) {
            Some((name, from, to, n)) => {
                names.push(name);
                ranges.push((from, to, n));
            }
            None => faults.push(
                Diagnostic::error("vary", format!("`--vary {text}` cannot be read"))
                    .help("write NAME=FROM..TO:N, such as --vary l_BC=80..120:100"),
            ),
        }
    }
    if faults.has_errors() {
        return Err(faults);
    }
    let variation = Variation::new(scene, &names)?;
    let mut values = Vec::new();
    for (name, (from, to, n)) in names.iter().zip(&ranges) {
        values.push(variation.range(scene, name, from, to, n.saturating_sub(1))?);
    }
    let driver = driver_of(scene, a.range.over.as_deref())?;
    let stations = match a.range.steps {
        None => None,
        Some(steps) => Some(stations(&Placed::new(scene, mechanism)?, driver, &a.range, within(steps, MOST_POSITIONS, "a batch")?)?),
    };
    let choice = a.random.map_or(Choice::Grid, |count| Choice::Random { count, seed: a.seed });
    Ok(Batch { scene, mechanism, variation, values, choice, driver, stations })
}

/// `NAME=FROM..TO:N`, or `NAME=FROM..TO` for two values (the bounds of a random one).
fn range(text: &str) -> Option<(&str, &str, &str, usize)> {
    let (name, rest) = text.split_once('=')?;
    let (bounds, n) = match rest.rsplit_once(':') {
        Some((bounds, n)) => (bounds, n.trim().parse().ok().filter(|n| (1..=10_000_000).contains(n))?),
        None => (rest, 2),
    };
    let (from, to) = bounds.split_once("..")?;
    Some((name.trim(), from.trim(), to.trim(), n))
}

fn write(batch: &Batch, head: Head, out: &Path, job: &str) -> Result<Part, Failure> {
    let failed = |e: io::Error| Failure::Output(format!("{} cannot be written: {e}", out.display()));
    let format = tables::by_rows(ending(out), head).map_err(failed)?;
    let mut part = Part::open(out, job, &*format).map_err(failed)?;
    stop::watch();
    let done = stream(batch, &*format, &mut part).and_then(|()| {
        if part.done < batch.mechanisms() {
            return Ok(());
        }
        let _naming = stop::undisturbed();
        part.finish(out, &*format, &notes(part.missing))
    });
    if let Err(e) = done {
        part.remove();
        return Err(failed(e));
    }
    if part.done < batch.mechanisms() {
        return Err(Failure::Interrupted(format!(
            "{} of {} mechanisms are done; the same command goes on from there",
            part.done,
            batch.mechanisms()
        )));
    }
    Ok(part)
}

fn ending(out: &Path) -> &str {
    out.extension().and_then(|e| e.to_str()).unwrap_or_default()
}

fn notes(missing: u64) -> Vec<Diagnostic> {
    let note = |n| Diagnostic::note("no-position", format!("{n} positions have no row: the mechanism cannot be assembled there"));
    (missing > 0).then(|| note(missing)).into_iter().collect()
}

/// Mechanisms of a block.
fn mechanisms_at_once(batch: &Batch) -> u64 {
    (BLOCK / (batch.positions() * batch.columns().len()).max(1)).max(1) as u64
}

/// Computes and writes block after block: one is computed while the one before it is given its form, and that before it is written.
fn stream(batch: &Batch, format: &dyn Format, part: &mut Part) -> io::Result<()> {
    let (all, step) = (batch.mechanisms(), mechanisms_at_once(batch));
    let bar = long::bar(all, part.done, "mechanisms");
    let mut from = part.done;
    let make = |used: Option<(u64, Block)>| {
        if from >= all || stop::asked() {
            return None;
        }
        let to = all.min(from + step);
        let block = batch.block_unless(from, to, used.unwrap_or_default().1, &stop::asked)?;
        from = to;
        Some((to, block))
    };
    let form = |(to, block): &(u64, Block), used: Option<(u64, u64, Piece)>| {
        let columns: Vec<&[f64]> = block.columns.iter().map(Vec::as_slice).collect();
        Ok((*to, block.missing, format.piece_in(&columns, used.unwrap_or_default().2)?))
    };
    long::pipeline(make, form, |(done, missing, piece)| {
        part.add(piece, *done, *missing)?;
        bar.set_position(*done);
        Ok(())
    })?;
    bar.finish_and_clear();
    Ok(())
}
