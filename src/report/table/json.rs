//! A whole table as JSON: title, columns by name with units, notes.

use super::{GENERATOR, Head};
use crate::diag::Diagnostic;
use crate::sweep::Table;
use serde::Serialize;
use std::io;

#[derive(Serialize)]
struct Document<'a> {
    title: &'a str,
    generator: &'a str,
    columns: Vec<Column<'a>>,
    notes: Vec<Note<'a>>,
}

#[derive(Serialize)]
struct Column<'a> {
    name: &'a str,
    unit: &'a str,
    values: &'a [f64],
}

#[derive(Serialize)]
pub(super) struct Note<'a> {
    code: &'a str,
    message: &'a str,
}

/// Notes by code and message.
pub(super) fn notes(notes: &[Diagnostic]) -> Vec<Note<'_>> {
    notes.iter().map(|n| Note { code: n.code, message: &n.message }).collect()
}

/// Writes a table as JSON, number by number: no text of it is kept.
///
/// # Errors
/// Those of `out`.
pub fn json(head: &Head, table: &Table, out: &mut dyn io::Write) -> io::Result<()> {
    let column = |(h, c)| -> Column {
        let (h, c): (&super::Heading, &crate::sweep::Column) = (h, c);
        Column { name: &h.name, unit: h.unit, values: &c.values }
    };
    let columns = head.columns.iter().zip(&table.columns).map(column).collect();
    let document = Document { title: &head.title, generator: GENERATOR, columns, notes: notes(&table.notes) };
    serde_json::to_writer_pretty(&mut *out, &document)?;
    out.write_all(b"\n")
}
