//! Tables into files: which format a name calls for, and the rows written as they come, in the memory of a piece.

use super::{Failure, files, long, spool::Spool, stop};
use crate::diag::Diagnostic;
use crate::report::table::{self, Csv, Format, Head, Npy, Parquet, Standing};
use crate::sweep::pieces::Pieces;
use indicatif::ProgressBar;
use std::io::{self, Write};
use std::path::Path;

/// The formats that are written row by row, by the ending of their files.
pub const BY_ROWS: [&str; 3] = ["csv", "npy", "parquet"];

/// All formats of a sweep's table.
pub const ALL: [&str; 4] = ["csv", "json", "npy", "parquet"];

/// Rows of a piece: half a megabyte for each column.
const ROWS: usize = 1 << 16;

/// The ending of a file's name, one of those allowed.
pub fn ending(path: &str, allowed: &[&'static str]) -> Result<&'static str, Failure> {
    allowed.iter().copied().find(|e| files::ending(path) == Some(e)).ok_or_else(|| {
        let all: Vec<String> = allowed.iter().map(|e| format!(".{e}")).collect();
        let d = Diagnostic::error("output", format!("{path} does not end in {}", all.join(", ")));
        let help = format!("name the output table.{}, with the ending of the format that you want", allowed[0]);
        Failure::Input(d.help(help).into(), path.to_owned(), String::new())
    })
}

/// A format that is written row by row, by the ending of its files.
pub fn by_rows(ending: &str, head: Head) -> io::Result<Box<dyn Format>> {
    Ok(match ending {
        "npy" => Box::new(Npy::new(head)),
        "parquet" => Box::new(Parquet::new(head)?),
        _ => Box::new(Csv::new(head)),
    })
}

/// Writes a sweep, whole or not at all, in the format that the file's name calls for; one piece is computed while the one before it is
/// written.
pub fn write(sweep: &mut dyn Pieces, title: &str, path: &str) -> Result<(), Failure> {
    let ending = ending(path, &ALL)?;
    let head = Head::new(title, sweep.columns());
    stop::watch();
    files::write_with(Path::new(path), |out| match ending {
        "json" => by_columns(sweep, &head, out),
        _ => rows(sweep, &*by_rows(ending, head)?, out),
    })
}

/// A sweep as CSV to a place where nothing can be written over: its rows are counted, and its notes known, before the first is
/// written.
pub fn print(sweep: &mut dyn Pieces, out: &mut dyn Write) -> io::Result<()> {
    let format = Csv::new(Head::new("", sweep.columns()));
    let bar = ProgressBar::hidden();
    let columns: Vec<Vec<Vec<f64>>> = std::iter::from_fn(pieces(sweep, &bar, |columns| columns)).collect();
    let count = columns.iter().filter_map(|c| c.first()).map(|c| c.len() as u64).sum();
    out.write_all(&format.begin(count, &sweep.notes()))?;
    for piece in columns {
        format.piece(&piece.iter().map(Vec::as_slice).collect::<Vec<_>>())?.write(out)?;
    }
    Ok(())
}

/// The pieces of a sweep, in the form that `shape` gives them, one after the other until all are made or the user asks to stop.
fn pieces<'a, T>(
    sweep: &'a mut dyn Pieces,
    bar: &'a ProgressBar,
    shape: impl Fn(Vec<Vec<f64>>) -> T + 'a,
) -> impl FnMut() -> Option<T> + 'a {
    let (count, mut from) = (sweep.count(), 0);
    move || {
        let to = count.min(from + ROWS);
        let mut piece: Option<Vec<Vec<f64>>> = None;
        while from < to {
            let next = to.min(from + sweep.at_once());
            let rows = sweep.piece(from..next, &stop::asked)?;
            bar.inc((next - from) as u64);
            from = next;
            match &mut piece {
                Some(piece) => piece.iter_mut().zip(rows).for_each(|(c, r)| c.extend(r)),
                None => piece = Some(rows),
            }
        }
        piece.filter(|_| !stop::asked()).map(&shape)
    }
}

fn rows(sweep: &mut dyn Pieces, format: &dyn Format, out: &mut files::Out) -> io::Result<()> {
    let count = sweep.count() as u64;
    let bar = long::bar(count, 0, "positions");
    // What is known before: that all rows are there, unless it turns out otherwise.
    let begin = format.begin(count, &sweep.notes());
    out.write_all(&begin)?;
    let (mut offset, mut written) = (begin.len() as u64, 0);
    let mut standing = Vec::new();
    let shape = |columns: Vec<Vec<f64>>| format.piece(&columns.iter().map(Vec::as_slice).collect::<Vec<_>>());
    long::overlapped(pieces(sweep, &bar, shape), |piece| {
        let piece = piece?;
        piece.write(out)?;
        written += piece.rows;
        let length = piece.length();
        standing.push(Standing { offset, rows: piece.rows, index: piece.index });
        offset += length;
        Ok(())
    })?;
    bar.finish_and_clear();
    let notes = sweep.notes();
    out.write_all(&format.end(&standing, &notes)?)?;
    if written < count { out.replace_beginning(begin.len() as u64, &format.begin(written, &notes)) } else { Ok(()) }
}

fn by_columns(sweep: &mut dyn Pieces, head: &Head, out: &mut files::Out) -> io::Result<()> {
    let bar = long::bar(sweep.count() as u64, 0, "positions");
    let mut spool = Spool::new(out.scratch()?);
    long::overlapped(pieces(sweep, &bar, |columns| columns), |columns| spool.add(&columns))?;
    bar.finish_and_clear();
    table::json(head, |k| spool.column(k), &sweep.notes(), out)
}
