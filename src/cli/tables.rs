//! Writes tables into files: chooses the format by the name, and writes rows as they come, with the
//! memory of one piece.

use super::places::{self, OutputPlace, places};
use super::spool::{self, Spool};
use super::together::OutputFile;
use super::values::{BatchFormat, TableFormat};
use super::{Failure, files, long, stop};
use crate::diag::{Diagnostic, both};
use crate::report::table::{self, Csv, Npy, Parquet, PiecePlace, RowFormat, TableHead, TablePiece};
use crate::sweep::pieces::SweepPieces;
use clap::ValueEnum;
use indicatif::ProgressBar;
use std::io::{self, Seek, Write};
use std::path::Path;

/// Rows of a piece: half a megabyte for each column.
const ROWS: usize = 1 << 16;

/// Largest number of values in a piece: sixteen megabytes.
const NUMBERS: usize = 1 << 21;

/// Returns the place of a table: its rows come once, and are written in one format.
///
/// # Errors
/// The errors of [`places`], and `format` if several are requested.
pub fn place<F: ValueEnum + Copy + PartialEq>(
    output: &str,
    formats: &[F],
    usual: F,
) -> Result<OutputPlace<F>, Failure> {
    let mut all = places(output, formats, usual)?;
    if all.len() == 1 {
        return Ok(all.swap_remove(0));
    }
    let message = both!("a table is written in one format, and --format asks for {}", all.len());
    let help = both!("ask for one format: --format {}", places::ending(all[0].0));
    Err(Failure::argument("-o", output, Diagnostic::error("format", message).help(help)))
}

/// Returns a format that is written row by row.
pub fn by_rows(format: BatchFormat, head: TableHead) -> io::Result<Box<dyn RowFormat>> {
    Ok(match format {
        BatchFormat::Csv => Box::new(Csv::new(head)),
        BatchFormat::Npy => Box::new(Npy::new(head)),
        BatchFormat::Parquet => Box::new(Parquet::new(head)?),
    })
}

/// Writes a sweep, completely or not at all; one piece is computed while the one before it is
/// written.
pub fn write(
    sweep: &mut dyn SweepPieces,
    head: TableHead,
    (format, path): &OutputPlace<TableFormat>,
) -> Result<(), Failure> {
    stop::watch();
    let _looking = stop::Looking::begin();
    files::write_with(Path::new(path), |out| match format {
        TableFormat::Json => by_columns(sweep, &head, out),
        TableFormat::Csv => rows(sweep, &*by_rows(BatchFormat::Csv, head)?, out),
        TableFormat::Npy => rows(sweep, &*by_rows(BatchFormat::Npy, head)?, out),
        TableFormat::Parquet => rows(sweep, &*by_rows(BatchFormat::Parquet, head)?, out),
    })
}

/// Largest part of a sweep's rows that is kept in memory before printing; further rows are stored
/// on disk.
const KEPT: usize = 8 << 20;

/// Prints a sweep as CSV to a place where nothing can be overwritten: the notes come first, but are
/// known only with the last row.
pub fn print(sweep: &mut dyn SweepPieces, head: TableHead, out: &mut dyn Write) -> io::Result<()> {
    let format = Csv::new(head);
    let mut rows = tempfile::spooled_tempfile(KEPT);
    let mut count = 0;
    in_pieces(sweep, &ProgressBar::hidden(), formed(&format), |piece| {
        count += piece.rows;
        piece.write(&mut rows)
    })?;
    out.write_all(&format.begin(count, &sweep.notes()))?;
    rows.rewind()?;
    io::copy(&mut rows, out).map(drop)
}

/// Makes a sweep piece by piece until all are made or the user asks to stop; formats each piece and
/// takes it.
fn in_pieces<U: Send>(
    sweep: &mut dyn SweepPieces,
    bar: &ProgressBar,
    mut form: impl FnMut(&[&[f64]], Option<U>) -> io::Result<U> + Send,
    take: impl FnMut(&U) -> io::Result<()>,
) -> io::Result<()> {
    let (count, mut from) = (sweep.count(), 0);
    // With many columns the pieces are shorter, so that a piece has a few megabytes at most.
    let rows = ROWS.min((NUMBERS / sweep.columns().len().max(1)).max(1));
    let make = |used: Option<Vec<Vec<f64>>>| {
        let mut used = used.unwrap_or_default();
        let to = count.min(from + rows);
        let mut piece: Option<Vec<Vec<f64>>> = None;
        while from < to {
            let next = to.min(from + sweep.at_once().min(rows));
            let rows = sweep.piece(from..next, std::mem::take(&mut used), &stop::asked)?;
            bar.inc((next - from) as u64);
            from = next;
            match &mut piece {
                Some(piece) => piece.iter_mut().zip(rows).for_each(|(c, r)| c.extend(r)),
                None => piece = Some(rows),
            }
        }
        piece.filter(|_| !stop::asked())
    };
    long::pipeline(
        make,
        |columns, used| form(&columns.iter().map(Vec::as_slice).collect::<Vec<_>>(), used),
        take,
    )
}

/// Returns the function that formats pieces.
fn formed(
    format: &dyn RowFormat,
) -> impl FnMut(&[&[f64]], Option<TablePiece>) -> io::Result<TablePiece> + Send {
    |columns, used| format.piece_in(columns, used.unwrap_or_default())
}

fn rows(
    sweep: &mut dyn SweepPieces,
    format: &dyn RowFormat,
    out: &mut OutputFile,
) -> io::Result<()> {
    let count = sweep.count() as u64;
    let bar = long::bar(count, 0, &both!("positions"));
    // The beginning assumes that all rows exist and are finite; otherwise it is replaced.
    let begin = format.begin(count, &sweep.notes());
    out.write_all(&begin)?;
    let (mut offset, mut written) = (begin.len() as u64, 0);
    let mut standing = Vec::new();
    in_pieces(sweep, &bar, formed(format), |piece| {
        piece.write(out)?;
        written += piece.rows;
        standing.push(PiecePlace { offset, rows: piece.rows, index: piece.index.clone() });
        offset += piece.length();
        Ok(())
    })?;
    bar.finish_and_clear();
    let notes = sweep.notes();
    out.write_all(&format.end(&standing, &notes)?)?;
    let told = format.begin(written, &notes);
    if told == begin { Ok(()) } else { out.replace_beginning(begin.len() as u64, &told) }
}

fn by_columns(
    sweep: &mut dyn SweepPieces,
    head: &TableHead,
    out: &mut OutputFile,
) -> io::Result<()> {
    let bar = long::bar(sweep.count() as u64, 0, &both!("positions"));
    let mut spool = Spool::new(out.scratch()?);
    in_pieces(
        sweep,
        &bar,
        |columns, used| Ok(spool::bytes(columns, used.unwrap_or_default())),
        |bytes| spool.add(bytes, head.columns.len()),
    )?;
    bar.finish_and_clear();
    table::json(head, |k| spool.column(k), &sweep.notes(), out)
}
