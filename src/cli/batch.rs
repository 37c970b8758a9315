//! `hodograph batch`: varied parameters, many mechanisms, written block by block into one file.
//!
//! The rows go to a part file beside the output ([`PartialTable`]), which is renamed when all are
//! written. An interrupted run leaves the part, and the same command continues from there. A file
//! that cannot be written completely is removed: an output file is always complete. With `--shard`
//! the batch is written as parts in a folder ([`shards`]).

use super::args::{BatchArgs, VariedArgs};
use super::part::{JournalAfter, PartialTable};
use super::sweep::{ask, within};
use super::target::unwritable;
use super::values::BatchFormat;
use super::{
    CommandResult, Failure, SceneInput, choices, errors, files, lang, long, places, shards, stop,
    tables,
};
use crate::diag::{Diagnostic, both};
use crate::problem::batch::{BatchRequest, MOST_POSITIONS, block, head, notes, planned};
use crate::report::table::{GENERATOR, RowFormat, TablePiece};
use crate::scene::Lang;
use crate::sweep::batch::{Batch, Block, ParameterChoice};
use crate::sweep::pieces::StopSignal;
use indicatif::ProgressBar;
use std::io;
use std::ops::Range;
use std::path::Path;

/// Runs the command `batch`.
pub fn batch(a: BatchArgs) -> CommandResult {
    let input = SceneInput::read(&a.common)?;
    let lang = choices(&input.scene, &a.common).0;
    if let Some(shard) = a.shard {
        let format = shards::format(&a.output, &a.format)?;
        let run = BatchRun::new(input, a.varied, format, lang)?;
        return shards::compute(run, shard, a.per_part, Path::new(&a.output));
    }
    let (format, output) = tables::place(&a.output, &a.format, BatchFormat::Csv)?;
    let run = BatchRun::new(input, a.varied, format, lang)?;
    let part = run.planned(|batch, format| {
        let all = 0..batch.mechanisms();
        let bar = bar(batch.mechanisms());
        stop::watch();
        let done = |more| bar.inc(more);
        let watch = WorkWatch { stop: &stop::asked, done: &done, changed: &changed };
        let place = (Path::new(&*output), &*run.job());
        written(batch, format, all, place, JournalAfter::Removed, &watch)
    })?;
    files::print(lang::of(&both!(
        "{}: {} mechanisms, {} rows, {} positions without one\n",
        output,
        part.done,
        part.rows,
        part.missing
    )))
}

/// Returns a progress bar of mechanisms.
pub fn bar(all: u64) -> ProgressBar {
    long::bar(all, 0, &both!("mechanisms"))
}

/// Warns of bytes of an earlier run that have been changed.
pub fn changed(mechanisms: u64) {
    let words = both!(
        "the bytes of {mechanisms} mechanisms are not those that were written: they are computed again"
    );
    errors::tell(&Diagnostic::warning("changed-bytes", words).into(), "", "");
}

/// The observer of a batch that is written.
#[derive(Clone, Copy)]
pub struct WorkWatch<'a> {
    /// Returns true if the work is to stop.
    pub stop: StopSignal<'a>,
    /// Takes the number of mechanisms that are done since the last call.
    pub done: &'a dyn Fn(u64),
    /// Takes the number of mechanisms with bytes that have been changed since an earlier run.
    pub changed: &'a dyn Fn(u64),
}

/// A batch to be written.
pub struct BatchRun {
    pub input: SceneInput,
    pub varied: VariedArgs,
    pub format: BatchFormat,
    pub lang: Lang,
}

impl BatchRun {
    /// # Errors
    /// Questions of the command line that the scene does not have.
    pub fn new(
        mut input: SceneInput,
        varied: VariedArgs,
        format: BatchFormat,
        lang: Lang,
    ) -> Result<BatchRun, Failure> {
        ask(&mut input, varied.range.find.as_deref())?;
        Ok(BatchRun { input, varied, format, lang })
    }

    /// Returns everything on which the bytes of the table depend.
    pub fn job(&self) -> String {
        let VariedArgs { vary, random, seed, range } = &self.varied;
        format!(
            "{GENERATOR} {} {:?} {vary:?} {random:?} {seed:?} {:?} {:?} {:?}",
            places::ending(self.format),
            self.lang,
            (&range.over, &range.from, &range.to, range.steps),
            range.find,
            self.input.file.source
        )
    }

    /// Plans the batch and does something with it and the format of its table.
    ///
    /// # Errors
    /// Arguments that cannot be read or do not fit the quantity of their parameter, each shown in
    /// its own argument; those of the work.
    pub fn planned<T>(
        &self,
        work: impl FnOnce(&Batch, &dyn RowFormat) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        let (input, VariedArgs { vary, random, seed, range }) = (&self.input, &self.varied);
        if let Some(steps) = range.steps {
            within(steps, MOST_POSITIONS, both!("a batch"))?;
        }
        let choice = random
            .map_or(ParameterChoice::Grid, |count| ParameterChoice::Random { count, seed: *seed });
        let request = BatchRequest { vary, choice, range: range.swept() };
        let worked = planned(&input.scene, &request, |batch| {
            let head = head(batch, self.lang.of(&input.scene.title), self.lang);
            let format =
                tables::by_rows(self.format, head).map_err(|e| unwritable(Path::new("-"), &e))?;
            work(batch, &*format)
        });
        worked.map_err(|f| input.out_of_range(f))?
    }
}

/// Writes the rows of some mechanisms as a table, from where an earlier run of the job was left.
///
/// # Errors
/// A file that cannot be written; a run that is interrupted before the last row.
pub fn written(
    batch: &Batch,
    format: &dyn RowFormat,
    mechanisms: Range<u64>,
    (out, job): (&Path, &str),
    after: JournalAfter,
    watch: &WorkWatch,
) -> Result<PartialTable, Failure> {
    let failed = |e: io::Error| unwritable(out, &e);
    let mut part = PartialTable::open(out, job, format)?;
    if part.changed > 0 {
        (watch.changed)(part.changed);
    }
    let all = mechanisms.end - mechanisms.start;
    let done = stream(batch, format, mechanisms, &mut part, watch).and_then(|()| {
        if part.done < all {
            return Ok(());
        }
        let _naming = stop::undisturbed();
        part.finish(format, &notes(part.missing), after)
    });
    if let Err(e) = done {
        part.remove();
        return Err(failed(e));
    }
    if part.done < all {
        let done = part.done;
        let after = if part.stays() {
            both!("the same command goes on from there")
        } else {
            both!("what is written to a pipe begins anew")
        };
        return Err(Failure::Interrupted(both!("{done} of {all} mechanisms are done; {}", after)));
    }
    Ok(part)
}

/// Computes and writes block after block, in parallel: one block is computed while the one before
/// it is formatted and the one before that is written.
fn stream(
    batch: &Batch,
    format: &dyn RowFormat,
    mechanisms: Range<u64>,
    part: &mut PartialTable,
    watch: &WorkWatch,
) -> io::Result<()> {
    let step = block(batch);
    (watch.done)(part.done);
    let stop = watch.stop;
    let mut from = mechanisms.start + part.done;
    let make = |used: Option<(u64, Block)>| {
        if from >= mechanisms.end || stop() {
            return None;
        }
        let to = mechanisms.end.min(from + step);
        let block = batch.block_unless(from, to, used.unwrap_or_default().1, stop)?;
        from = to;
        Some((to - mechanisms.start, block))
    };
    let form = |(done, block): &(u64, Block), used: Option<(u64, u64, TablePiece)>| {
        let columns: Vec<&[f64]> = block.columns.iter().map(Vec::as_slice).collect();
        Ok((*done, block.missing, format.piece_in(&columns, used.unwrap_or_default().2)?))
    };
    long::pipeline(make, form, |(done, missing, piece)| {
        (watch.done)(done - part.done);
        part.add(piece, *done, *missing)
    })
}
