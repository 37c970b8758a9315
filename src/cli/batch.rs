//! `hodograph batch`: varied parameters, many mechanisms, written block by block into one file.
//!
//! The rows go to a part file beside the output ([`PartialTable`]), which is renamed when all are
//! written. An interrupted run leaves the part, and the same command continues from there. A file
//! that cannot be written completely is removed: an output file is always complete.

use super::args::BatchArgs as Args;
use super::part::PartialTable;
use super::sweep::{ask, stations, within};
use super::target::unwritable;
use super::values::BatchFormat;
use super::{
    CommandResult, Failure, SceneInput, SourceFaults, choices, errors, files, lang, long, places,
    stop, tables,
};
use crate::diag::{Diagnostic, Faults, Span, both};
use crate::mechanism::Mechanism;
use crate::problem::range::driver_of;
use crate::report::table::{GENERATOR, RowFormat, TableHead, TablePiece};
use crate::sweep::PlacedScene;
use crate::sweep::batch::{Batch, Block, ParameterChoice};
use crate::sweep::vary::Variation;
use std::io;
use std::path::Path;

/// Largest number of values of a parameter.
const MOST_VALUES: usize = 10_000_000;
/// Largest number of steps of each mechanism: all its rows are in memory at once, in each stage of
/// the work; a dozen columns take some ten megabytes.
const MOST_POSITIONS: usize = 100_000;

/// Approximate number of values in a block: some megabytes, in Parquet a row group of some 100 000
/// rows.
const BLOCK: usize = 1 << 20;

pub fn batch(a: Args) -> CommandResult {
    let mut input = SceneInput::read(&a.common)?;
    ask(&mut input, a.range.find.as_deref())?;
    let (format, output) = tables::place(&a.output, &a.format, BatchFormat::Csv)?;
    let mechanism = Mechanism::new(&input.scene).map_err(|f| input.failed(f))?.value;
    let batch = plan(&input, &mechanism, &a)?;
    let (lang, _) = choices(&input.scene, &a.common);
    let job = format!(
        "{GENERATOR} {} {lang:?} {:?} {:?} {:?} {:?} {:?} {:?}",
        places::ending(format),
        a.vary,
        a.random,
        a.seed,
        (&a.range.over, &a.range.from, &a.range.to, a.range.steps),
        a.range.find,
        input.file.source
    );
    let part =
        write(&batch, format, head(&batch, input.scene.title.get(lang)), Path::new(&output), &job)?;
    files::print(lang::of(&both!(
        "{}: {} mechanisms, {} rows, {} positions without one\n",
        "{}：{} 个机构，{} 行，{} 个位置没有数据行\n",
        output,
        part.done,
        part.rows,
        part.missing
    )))
}

/// The columns of a batch. The mechanism's number, its parameters and the driver's position repeat.
fn head(batch: &Batch, title: &str) -> TableHead {
    let mut head = TableHead::new(title, batch.columns()).in_language(lang::now());
    let leading = 2 + batch.values.len();
    head.columns.iter_mut().take(leading).for_each(|c| c.repeats = true);
    head.columns.iter_mut().take(1).for_each(|c| c.whole = true);
    head
}

/// # Errors
/// Arguments that cannot be read or do not fit the quantity of their parameter, each shown in its
/// own argument.
fn plan<'a>(
    input: &'a SceneInput,
    mechanism: &'a Mechanism,
    a: &Args,
) -> Result<Batch<'a>, Failure> {
    let scene = &input.scene;
    let mut ranges = Vec::new();
    let mut wrong = Vec::new();
    for text in &a.vary {
        let known = range(text).and_then(|r| {
            Variation::new(scene, &[r.name]).map(|_| r).map_err(|f| at(text, r.name, f))
        });
        match known {
            Ok(r) => ranges.push((text, r)),
            Err(faults) => wrong.push(SourceFaults::argument("--vary", text, faults)),
        }
    }
    if !wrong.is_empty() {
        return Err(Failure::Input(wrong));
    }
    let names: Vec<&str> = ranges.iter().map(|(_, r)| r.name).collect();
    let variation = Variation::new(scene, &names)
        .map_err(|f| Failure::argument("--vary", &a.vary.join(" --vary "), f))?;
    let mut values = Vec::new();
    for (text, r) in &ranges {
        let checked = |value: &str| {
            variation.value(scene, r.name, value).map(drop).map_err(|f| at(text, value, f))
        };
        let read = checked(r.from)
            .and_then(|()| checked(r.to))
            .and_then(|()| variation.range(scene, r.name, r.from, r.to, r.count - 1));
        match read {
            Ok(list) => values.push(list),
            Err(faults) => wrong.push(SourceFaults::argument("--vary", text, faults)),
        }
    }
    if !wrong.is_empty() {
        return Err(Failure::Input(wrong));
    }
    let driver = driver_of(scene, a.range.over.as_deref())?;
    let stations = match a.range.steps {
        None => None,
        Some(steps) => {
            let steps = within(steps, MOST_POSITIONS, both!("a batch", "批量计算"))?;
            let placed = PlacedScene::new(scene, mechanism).map_err(|f| input.failed(f))?;
            Some(stations(input, &placed, driver, &a.range, steps)?)
        }
    };
    let choice = a
        .random
        .map_or(ParameterChoice::Grid, |count| ParameterChoice::Random { count, seed: a.seed });
    Ok(Batch { scene, mechanism, variation, values, choice, driver, stations })
}

/// Returns the faults of a part of an argument, at the place of that part.
fn at(text: &str, part: &str, faults: Faults) -> Faults {
    let start = text.find(part).unwrap_or_default();
    let place = Span::new(start, start + part.len());
    Faults { list: faults.list.into_iter().map(|d| d.at(place)).collect() }
}

/// A parameter's values as given on the command line.
#[derive(Clone, Copy)]
struct ParameterValues<'a> {
    name: &'a str,
    from: &'a str,
    to: &'a str,
    count: usize,
}

/// `NAME=FROM..TO:N`, or `NAME=FROM..TO` for two values (the bounds of a random one).
fn range(text: &str) -> Result<ParameterValues<'_>, Faults> {
    let unread = || {
        let d = Diagnostic::error(
            "vary",
            both!("`--vary {text}` cannot be read", "无法识别 `--vary {text}`"),
        );
        Faults::from(d.help(both!(
            "write NAME=FROM..TO:N, such as --vary l_BC=80..120:100; N is 1 to 10000000",
            "请写 NAME=FROM..TO:N，如 --vary l_BC=80..120:100；N 为 1 到 10000000"
        )))
    };
    let (name, rest) = text.split_once('=').ok_or_else(unread)?;
    let (bounds, count) = match rest.rsplit_once(':') {
        Some((bounds, n)) => (
            bounds,
            n.trim().parse().ok().filter(|n| (1..=MOST_VALUES).contains(n)).ok_or_else(unread)?,
        ),
        None => (rest, 2),
    };
    // `60...120` could be read as `60..0.120`.
    if let Some(dots) = text.find("...") {
        let d = Diagnostic::error(
            "vary",
            both!(
                "two dots stand between the bounds of a range, here are three or more",
                "范围的两端之间是两个点，此处有三个或更多"
            ),
        );
        let d = d.at(Span::new(dots, text.len() - text[dots..].trim_start_matches('.').len()));
        return Err(d
            .help(both!(
                "write FROM..TO; before the point of a number write a digit, 0.5",
                "请写 FROM..TO；小数点前要有数字，如 0.5"
            ))
            .into());
    }
    let (from, to) = bounds.split_once("..").ok_or_else(unread)?;
    Ok(ParameterValues { name: name.trim(), from: from.trim(), to: to.trim(), count })
}

fn write(
    batch: &Batch,
    format: BatchFormat,
    head: TableHead,
    out: &Path,
    job: &str,
) -> Result<PartialTable, Failure> {
    let failed = |e: io::Error| unwritable(out, &e);
    let format = tables::by_rows(format, head).map_err(failed)?;
    let mut part = PartialTable::open(out, job, &*format)?;
    if part.changed > 0 {
        let words = both!(
            "the bytes of {} mechanisms are not those that were written: they are computed again",
            "有 {} 个机构的数据与写入时不同：重新计算",
            part.changed
        );
        errors::tell(&Diagnostic::warning("changed-bytes", words).into(), "", "");
    }
    stop::watch();
    let done = stream(batch, &*format, &mut part).and_then(|()| {
        if part.done < batch.mechanisms() {
            return Ok(());
        }
        let _naming = stop::undisturbed();
        part.finish(&*format, &notes(part.missing))
    });
    if let Err(e) = done {
        part.remove();
        return Err(failed(e));
    }
    if part.done < batch.mechanisms() {
        let (done, all) = (part.done, batch.mechanisms());
        let after = if part.stays() {
            both!("the same command goes on from there", "用同一命令可由此继续")
        } else {
            both!("what is written to a pipe begins anew", "写入管道的须从头开始")
        };
        return Err(Failure::Interrupted(both!(
            "{done} of {all} mechanisms are done; {}",
            "{all} 个机构已完成 {done} 个；{}",
            after
        )));
    }
    Ok(part)
}

fn notes(missing: u64) -> Vec<Diagnostic> {
    let note = |n| {
        Diagnostic::note(
            "no-position",
            both!(
                "{n} positions have no row: the mechanism cannot be assembled there",
                "有 {n} 个位置没有数据行：机构在该处不能装配"
            ),
        )
    };
    (missing > 0).then(|| note(missing)).into_iter().collect()
}

/// Returns the number of mechanisms in a block.
fn mechanisms_at_once(batch: &Batch) -> u64 {
    (BLOCK / (batch.positions() * batch.columns().len()).max(1)).max(1) as u64
}

/// Computes and writes block after block, in parallel: one block is computed while the one before
/// it is formatted and the one before that is written.
fn stream(batch: &Batch, format: &dyn RowFormat, part: &mut PartialTable) -> io::Result<()> {
    let (all, step) = (batch.mechanisms(), mechanisms_at_once(batch));
    let bar = long::bar(all, part.done, &both!("mechanisms", "个机构"));
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
    let form = |(to, block): &(u64, Block), used: Option<(u64, u64, TablePiece)>| {
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
