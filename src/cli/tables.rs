//! Tables into files: which format a name calls for, and a whole table written.

use super::{Failure, files, long, stop};
use crate::diag::Diagnostic;
use crate::report::table::{self, Csv, Format, Head, Npy, Parquet, Standing};
use crate::sweep::Table;
use crate::sweep::long::Long;
use std::io::{self, Write};
use std::path::Path;

/// The formats that are written row by row, by the ending of their files.
pub const BY_ROWS: [&str; 3] = ["csv", "npy", "parquet"];

/// All formats of a table that is in memory.
pub const WHOLE: [&str; 4] = ["csv", "json", "npy", "parquet"];

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

/// Writes a table whole or not at all, in the format that the file's name calls for.
pub fn write(table: &Table, title: &str, path: &str) -> Result<(), Failure> {
    let ending = ending(path, &WHOLE)?;
    let head = Head::of(title, table);
    stop::watch();
    files::write_with(Path::new(path), |out| match ending {
        "json" => table::json(&head, table, out),
        _ => rows(table, &*by_rows(ending, head)?, out),
    })
}

/// Writes a long sweep, whole or not at all, in the memory of a piece; one is computed while the one before it is written.
pub fn write_long(sweep: &mut Long, rows: usize, title: &str, path: &str) -> Result<(), Failure> {
    let format = by_rows(ending(path, &BY_ROWS)?, Head::new(title, sweep.columns()))
        .map_err(|e| Failure::Output(format!("{path} cannot be written: {e}")))?;
    let bar = long::bar(rows as u64, 0, "positions");
    stop::watch();
    files::write_with(Path::new(path), |out| {
        // What is known before: that all rows are there, unless it turns out otherwise.
        let begin = format.begin(rows as u64, &sweep.notes());
        out.write_all(&begin)?;
        let (mut offset, mut written, mut from) = (begin.len() as u64, 0, 0);
        let mut pieces = Vec::new();
        let make = || {
            let to = rows.min(from + ROWS);
            let piece = (from < to && !stop::asked()).then(|| {
                let columns = sweep.piece(from..to);
                format.piece(&columns.iter().map(Vec::as_slice).collect::<Vec<_>>())
            });
            from = to;
            piece
        };
        long::overlapped(make, |piece| {
            let piece = piece?;
            out.write_all(&piece.bytes)?;
            bar.inc(ROWS as u64);
            written += piece.rows;
            pieces.push(Standing { offset, rows: piece.rows, index: piece.index });
            offset += piece.bytes.len() as u64;
            Ok(())
        })?;
        bar.finish_and_clear();
        let notes = sweep.notes();
        out.write_all(&format.end(&pieces, &notes)?)?;
        if written < rows as u64 { out.replace_beginning(begin.len() as u64, &format.begin(written, &notes)) } else { Ok(()) }
    })
}

/// A table as CSV.
pub fn csv(table: &Table, out: &mut dyn Write) -> io::Result<()> {
    rows(table, &Csv::new(Head::of("", table)), out)
}

fn rows(table: &Table, format: &dyn Format, out: &mut dyn Write) -> io::Result<()> {
    let begin = format.begin(table.rows() as u64, &table.notes);
    out.write_all(&begin)?;
    let mut offset = begin.len() as u64;
    let mut pieces = Vec::new();
    for from in (0..table.rows()).step_by(ROWS) {
        let to = table.rows().min(from + ROWS);
        let columns: Vec<&[f64]> = table.columns.iter().map(|c| &c.values[from..to]).collect();
        let piece = format.piece(&columns)?;
        out.write_all(&piece.bytes)?;
        pieces.push(Standing { offset, rows: piece.rows, index: piece.index });
        offset += piece.bytes.len() as u64;
    }
    out.write_all(&format.end(&pieces, &table.notes)?)
}
