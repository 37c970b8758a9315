//! Tables as files: CSV and JSON, each with its notes.

use super::{Failure, files};
use crate::diag::Diagnostic;
use crate::sweep::Table;
use serde_json::json;
use std::path::Path;

/// A format of tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Comma-separated values; notes are lines that begin with `#`.
    Csv,
    /// Columns by name, with units and notes.
    Json,
}

impl Kind {
    /// The format that a file's name calls for.
    pub fn of(path: &Path) -> Result<Kind, Failure> {
        match path.extension().and_then(|e| e.to_str()) {
            Some("csv") => Ok(Kind::Csv),
            Some("json") => Ok(Kind::Json),
            _ => {
                let d = Diagnostic::error("output", format!("{} is neither a .csv nor a .json file", path.display()));
                Err(Failure::Input(d.help("name the output curves.csv or curves.json").into(), path.display().to_string(), String::new()))
            }
        }
    }
}

/// Writes a table whole or not at all.
pub fn write(table: &Table, path: &Path) -> Result<(), Failure> {
    files::write(path, text(table, Kind::of(path)?).as_bytes())
}

/// A table as text.
pub fn text(table: &Table, kind: Kind) -> String {
    match kind {
        Kind::Csv => csv(table),
        Kind::Json => {
            let columns: Vec<_> = table.columns.iter().map(|c| json!({"name": c.name, "unit": c.unit, "values": c.values})).collect();
            let notes: Vec<_> = table.notes.iter().map(|n| json!({"code": n.code, "message": n.message})).collect();
            format!("{:#}\n", json!({"columns": columns, "notes": notes}))
        }
    }
}

fn csv(table: &Table) -> String {
    let mut out = String::new();
    for note in &table.notes {
        out.push_str(&format!("# {}\n", note.message.replace('\n', " ")));
    }
    let mut writer = csv::Writer::from_writer(Vec::new());
    let head = table.columns.iter().map(|c| if c.unit.is_empty() { c.name.clone() } else { format!("{} [{}]", c.name, c.unit) });
    // Writing to memory does not fail.
    let _ = writer.write_record(head);
    for i in 0..table.rows() {
        let _ = writer.serialize(table.columns.iter().map(|c| c.values[i]).collect::<Vec<f64>>());
    }
    out + &String::from_utf8(writer.into_inner().unwrap_or_default()).unwrap_or_default()
}
