//! Rows that come piece by piece: what a writer of tables asks for, whatever is swept.

use super::general::{Gap, gap_notes, runs};
use super::table::{Column, Table};
use crate::diag::{Diagnostic, Faults};
use std::collections::BTreeMap;
use std::ops::Range;

/// Whether to stop, asked again and again while a piece is made.
pub type Stop<'a> = &'a (dyn Fn() -> bool + Sync);

/// Nobody asks.
pub(super) fn never() -> bool {
    false
}

/// The rows of a sweep under way, in their order.
pub trait Pieces: Send {
    /// Name and unit of each column, the swept quantity first.
    fn columns(&self) -> Vec<(String, &'static str)>;

    /// How many rows there are, if none is missing.
    fn count(&self) -> usize;

    /// Rows of a piece that is made in a moment.
    fn at_once(&self) -> usize;

    /// The numbers of some rows, as far as they are there, a column after the other; `None` when asked to stop. Pieces are asked for in
    /// order; their rows do not depend on how they are cut.
    fn piece(&mut self, rows: Range<usize>, stop: Stop) -> Option<Vec<Vec<f64>>>;

    /// What the rows cannot say, of all pieces so far.
    fn notes(&self) -> Vec<Diagnostic>;
}

/// All rows in memory.
pub fn gather(pieces: &mut dyn Pieces) -> Table {
    let mut columns: Vec<Column> = pieces.columns().into_iter().map(|(name, unit)| Column { name, unit, values: Vec::new() }).collect();
    let (count, step) = (pieces.count(), pieces.at_once());
    for from in (0..count).step_by(step) {
        let piece = pieces.piece(from..count.min(from + step), &never).unwrap_or_default();
        columns.iter_mut().zip(piece).for_each(|(c, p)| c.values.extend(p));
    }
    Table { columns, notes: pieces.notes() }
}

/// The runs of missing rows so far.
#[derive(Default)]
pub(super) struct Gaps(Vec<Gap>);

impl Gaps {
    /// Takes note of the rows of a piece, of which `first` is the first.
    pub fn add(&mut self, missing: &BTreeMap<usize, Faults>, first: usize) {
        for gap in runs(missing, first) {
            match self.0.last_mut().filter(|g| g.rows.end == gap.rows.start) {
                Some(last) => last.rows.end = gap.rows.end,
                None => self.0.push(gap),
            }
        }
    }

    /// Whether no row is missing.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// One note for each run; `words` names a row by its swept value.
    pub fn notes(&self, words: &dyn Fn(usize) -> String) -> Vec<Diagnostic> {
        gap_notes(words, &self.0)
    }
}
