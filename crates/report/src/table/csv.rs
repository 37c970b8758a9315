//! Comma-separated values (RFC 4180): notes are lines that start with `#`, then the labels, then a
//! line for each row. Numbers have the shortest form that reads back to the same `f64`; values that
//! are not finite are empty fields.

use super::{PiecePlace, RowFormat, TableHead, TablePiece};
use hodograph_base::diag::Diagnostic;
use rayon::prelude::*;
use std::io;

/// The CSV format with a head.
pub struct Csv {
    head: TableHead,
}

/// Number of rows that one thread writes at a time: some hundred kilobytes of text.
const ROWS: usize = 2048;

/// Typical number of characters of a number and its comma.
const WIDTH: usize = 20;

impl Csv {
    /// Returns the format for a table with this head.
    pub fn new(head: TableHead) -> Csv {
        Csv { head }
    }

    fn lines(&self, columns: &[&[f64]], rows: std::ops::Range<usize>, text: &mut Vec<u8>) {
        text.reserve(rows.len() * columns.len() * WIDTH);
        let (mut real, mut whole) = (zmij::Buffer::new(), itoa::Buffer::new());
        for i in rows {
            for (column, heading) in columns.iter().zip(&self.head.columns) {
                // A whole number of f64 is below 2^53. A value that is not finite, such as the
                // radius of a straight line, is an empty field.
                let number = match (heading.whole, column[i].is_finite()) {
                    (true, _) => whole.format(column[i] as i64),
                    (false, true) => real.format_finite(column[i]),
                    (false, false) => "",
                };
                text.extend_from_slice(number.as_bytes());
                text.push(b',');
            }
            if let Some(last) = text.last_mut() {
                *last = b'\n';
            }
        }
    }
}

impl RowFormat for Csv {
    fn begin(&self, _rows: u64, notes: &[Diagnostic]) -> Vec<u8> {
        let mut out = Vec::new();
        for note in notes {
            out.extend_from_slice(
                format!("# {}\n", self.head.lang.of(&note.message).replace('\n', " ")).as_bytes(),
            );
        }
        let mut writer = csv::Writer::from_writer(&mut out);
        // Writing to memory does not fail.
        let _ = writer.write_record(self.head.labels());
        drop(writer);
        out
    }

    fn piece_in(&self, columns: &[&[f64]], used: TablePiece) -> io::Result<TablePiece> {
        let rows = columns.first().map_or(0, |c| c.len());
        let cut = |k: usize| k * ROWS..rows.min((k + 1) * ROWS);
        let mut parts = used.into_parts(rows.div_ceil(ROWS));
        parts.par_iter_mut().enumerate().for_each(|(k, text)| self.lines(columns, cut(k), text));
        Ok(TablePiece { parts, rows: rows as u64, index: Vec::new() })
    }

    fn end(&self, _pieces: &[PiecePlace], _notes: &[Diagnostic]) -> io::Result<Vec<u8>> {
        Ok(Vec::new())
    }
}
