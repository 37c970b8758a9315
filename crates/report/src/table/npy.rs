//! NumPy's `.npy`: one structured array with a field for each column, named by its label;
//! `numpy.load(f)["v_C.x [m/s]"]` is a column and `pandas.DataFrame(numpy.load(f))` the table. The
//! format has no place for a title or notes.
//!
//! # Source
//! NumPy Enhancement Proposal 1 and `numpy.lib.format`: magic, version, length of the header, a
//! Python literal padded with spaces to a multiple of 64 bytes, then the records without gaps.

use super::{PiecePlace, RowFormat, TableHead, TablePiece};
use hodograph_base::diag::Diagnostic;
use rayon::prelude::*;
use std::io;

/// The `.npy` format with a head.
pub struct Npy {
    head: TableHead,
}

/// Alignment of the records, so that they are aligned when the file is mapped into memory: the
/// length of the header is a multiple of it.
const ALIGN: usize = 64;

/// Length of magic bytes, version and, in version 2, the length of the header.
const BEFORE_HEADER: usize = 12;

/// Number of records that one thread writes at a time, column after column: they stay in the
/// processor's cache meanwhile.
const ROWS: usize = 256;

impl Npy {
    /// Returns the format for a table with this head.
    pub fn new(head: TableHead) -> Npy {
        Npy { head }
    }
}

/// Returns a string as a Python literal in plain ASCII.
fn literal(text: &str) -> String {
    let mut out = String::from("'");
    for c in text.chars() {
        match c {
            '\'' | '\\' => out.extend(['\\', c]),
            ' '..='~' => out.push(c),
            c if (c as u32) < 0x10000 => out.push_str(&format!("\\u{:04x}", c as u32)),
            c => out.push_str(&format!("\\U{:08x}", c as u32)),
        }
    }
    out.push('\'');
    out
}

impl RowFormat for Npy {
    fn begin(&self, rows: u64, _notes: &[Diagnostic]) -> Vec<u8> {
        let field = |h: &super::ColumnHeading| {
            format!("({}, '{}'), ", literal(&h.label()), if h.whole { "<i8" } else { "<f8" })
        };
        let fields: String = self.head.columns.iter().map(field).collect();
        // The header has the same length for all numbers of rows, because twenty places hold each
        // of them.
        let count = rows.to_string();
        let header = format!(
            "{{'descr': [{fields}], 'fortran_order': False, 'shape': ({count},), }}{:w$}",
            "",
            w = 20 - count.len()
        );
        let whole = (BEFORE_HEADER + header.len() + 1).next_multiple_of(ALIGN);
        let mut out = b"\x93NUMPY\x02\x00".to_vec();
        out.extend_from_slice(&((whole - BEFORE_HEADER) as u32).to_le_bytes());
        out.extend_from_slice(header.as_bytes());
        out.resize(whole - 1, b' ');
        out.push(b'\n');
        out
    }

    fn piece_in(&self, columns: &[&[f64]], used: TablePiece) -> io::Result<TablePiece> {
        let rows = columns.first().map_or(0, |c| c.len());
        // The old bytes are kept: all are overwritten.
        let mut parts = used.parts;
        parts.resize_with(1, Vec::new);
        let width = columns.len() * 8;
        let bytes = &mut parts[0];
        bytes.resize(rows * width, 0);
        bytes.par_chunks_mut((ROWS * width).max(1)).enumerate().for_each(|(k, records)| {
            let first = k * ROWS;
            for (c, (column, heading)) in columns.iter().zip(&self.head.columns).enumerate() {
                for (record, number) in records.chunks_exact_mut(width).zip(&column[first..]) {
                    record[8 * c..][..8].copy_from_slice(&match heading.whole {
                        true => (*number as i64).to_le_bytes(),
                        false => number.to_le_bytes(),
                    });
                }
            }
        });
        Ok(TablePiece { parts, rows: rows as u64, index: Vec::new() })
    }

    fn end(&self, _pieces: &[PiecePlace], _notes: &[Diagnostic]) -> io::Result<Vec<u8>> {
        Ok(Vec::new())
    }
}
