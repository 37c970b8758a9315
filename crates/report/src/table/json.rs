//! A whole table as JSON: title, columns by name with units, notes.

use super::{GENERATOR, TableHead};
use hodograph_base::diag::Diagnostic;
use serde::ser::{Error, SerializeSeq};
use serde::{Serialize, Serializer};
use std::cell::RefCell;
use std::io;

#[derive(Serialize)]
#[serde(bound = "")]
struct JsonTable<'a, I: Iterator<Item = io::Result<Vec<f64>>>> {
    title: &'a str,
    generator: &'a str,
    columns: Vec<JsonColumn<'a, I>>,
    notes: Vec<Note<'a>>,
}

#[derive(Serialize)]
#[serde(bound = "")]
struct JsonColumn<'a, I: Iterator<Item = io::Result<Vec<f64>>>> {
    name: &'a str,
    unit: &'a str,
    values: ColumnValues<I>,
}

/// The numbers of a column, which come in pieces and only once.
struct ColumnValues<I>(RefCell<I>);

impl<I: Iterator<Item = io::Result<Vec<f64>>>> Serialize for ColumnValues<I> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut all = serializer.serialize_seq(None)?;
        for piece in &mut *self.0.borrow_mut() {
            for number in piece.map_err(S::Error::custom)? {
                all.serialize_element(&number)?;
            }
        }
        all.end()
    }
}

#[derive(Serialize)]
pub(super) struct Note<'a> {
    code: &'a str,
    message: &'a str,
}

/// Returns the notes by code and message.
pub(super) fn notes(notes: &[Diagnostic]) -> Vec<Note<'_>> {
    notes.iter().map(|n| Note { code: n.code, message: &n.message.en }).collect()
}

/// Writes a table as JSON, number by number, without keeping the text in memory. `values` yields
/// the numbers of each column, in pieces of any size.
///
/// # Errors
/// The errors of `out` and of `values`.
pub fn json<I: Iterator<Item = io::Result<Vec<f64>>>>(
    head: &TableHead,
    values: impl Fn(usize) -> I,
    told: &[Diagnostic],
    out: &mut dyn io::Write,
) -> io::Result<()> {
    let columns = head.columns.iter().enumerate();
    let columns = columns
        .map(|(k, h)| JsonColumn {
            name: &h.name,
            unit: &h.unit,
            values: ColumnValues(RefCell::new(values(k))),
        })
        .collect();
    let document =
        JsonTable { title: &head.title, generator: GENERATOR, columns, notes: notes(told) };
    serde_json::to_writer_pretty(&mut *out, &document)?;
    out.write_all(b"\n")
}
