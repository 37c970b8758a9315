//! Rows that come piece by piece, for writers of tables, whatever is swept.

use super::chunks::SweepRows;
use super::compile::ask;
use super::general::{RowGap, gap_notes, infinite_note, runs};
use super::table::{Column, Table};
use hodograph_base::diag::{Diagnostic, Faults};
use hodograph_scene::{Find, Scene};
use std::collections::BTreeMap;
use std::ops::Range;

/// A function that returns `true` to stop; it is called again and again while a piece is made.
pub type StopSignal<'a> = &'a (dyn Fn() -> bool + Sync);

/// A [`StopSignal`] that never stops.
pub(super) fn never() -> bool {
    false
}

/// The rows of a sweep in progress, in their order.
pub trait SweepPieces: Send {
    /// Name and unit of each column, the swept quantity first.
    fn columns(&self) -> Vec<(String, &'static str)>;

    /// The number of rows, if none is missing.
    fn count(&self) -> usize;

    /// The number of rows of a piece that takes a moment.
    fn at_once(&self) -> usize;

    /// Returns the numbers of some rows, as far as they exist, column after column; `None` if
    /// `stop` asks to stop. Pieces are requested in order; their rows do not depend on how they are
    /// cut. `used` are columns of an earlier piece that are free to be reused, or none: fresh memory
    /// costs as much as the numbers in it.
    fn piece(
        &mut self,
        rows: Range<usize>,
        used: Vec<Vec<f64>>,
        stop: StopSignal,
    ) -> Option<Vec<Vec<f64>>>;

    /// Notes on the rows of all pieces so far, such as the missing ones.
    fn notes(&self) -> Vec<Diagnostic>;
}

/// The rows of a sweep in other units: each column times a factor, to thirteen significant digits,
/// so that `30°` is not 29.999999999999996.
pub struct ScaledPieces<'a> {
    /// The rows in SI units.
    pub rows: &'a mut dyn SweepPieces,
    /// The number of units in one SI unit, for each column.
    pub factors: Vec<f64>,
}

impl SweepPieces for ScaledPieces<'_> {
    fn columns(&self) -> Vec<(String, &'static str)> {
        self.rows.columns()
    }

    fn count(&self) -> usize {
        self.rows.count()
    }

    fn at_once(&self) -> usize {
        self.rows.at_once()
    }

    fn piece(
        &mut self,
        rows: Range<usize>,
        used: Vec<Vec<f64>>,
        stop: StopSignal,
    ) -> Option<Vec<Vec<f64>>> {
        let mut columns = self.rows.piece(rows, used, stop)?;
        for (column, factor) in columns.iter_mut().zip(&self.factors).filter(|(_, f)| **f != 1.0) {
            column.iter_mut().for_each(|v| *v = rounded(*v * factor));
        }
        Some(columns)
    }

    fn notes(&self) -> Vec<Diagnostic> {
        self.rows.notes()
    }
}

/// Returns a number to thirteen significant digits; numbers beyond powers of ten that are exact in
/// `f64` stay as they are.
fn rounded(value: f64) -> f64 {
    let digits = 12.0 - libm::floor(libm::log10(value.abs()));
    if !(0.0..=22.0).contains(&digits) {
        return value;
    }
    let power = libm::exp10(digits);
    libm::round(value * power) / power
}

/// Collects all rows in memory.
pub fn gather(pieces: &mut dyn SweepPieces) -> Table {
    let mut columns: Vec<Column> = pieces
        .columns()
        .into_iter()
        .map(|(name, unit)| Column { name, unit, values: Vec::new() })
        .collect();
    let (count, step) = (pieces.count(), pieces.at_once());
    let mut piece = Vec::new();
    for from in (0..count).step_by(step) {
        piece = pieces.piece(from..count.min(from + step), piece, &never).unwrap_or_default();
        columns.iter_mut().zip(&piece).for_each(|(c, p)| c.values.extend_from_slice(p));
    }
    Table { columns, notes: pieces.notes() }
}

/// The runs of rows so far that are missing, or in which an answer is infinite.
pub(super) struct Gaps {
    missing: Vec<RowGap>,
    infinite: Vec<Infinite>,
}

/// A column of answers that may be infinite, and the runs of rows in which they are.
struct Infinite {
    column: usize,
    name: String,
    runs: Vec<Range<usize>>,
}

impl Gaps {
    /// Starts without gaps for a sweep of this scene. Answers with a meaning have a number in every
    /// position, so that only the others are watched.
    pub fn of(scene: &Scene) -> Gaps {
        let columns = scene
            .find
            .iter()
            .flat_map(|f| ask::names(f).into_iter().map(move |(name, _)| (f, name)))
            .enumerate();
        let bounded = |f: &Find| f.what.meaning(scene).is_some();
        let infinite = columns
            .filter(|(_, (f, _))| !bounded(f))
            .map(|(column, (_, name))| Infinite { column, name, runs: Vec::new() });
        Gaps { missing: Vec::new(), infinite: infinite.collect() }
    }

    /// Records the infinite answers of a row.
    pub fn see(&mut self, row: usize, answer: impl Fn(usize) -> f64) {
        for of in self.infinite.iter_mut().filter(|of| answer(of.column).is_infinite()) {
            match of.runs.last_mut().filter(|run| run.end == row) {
                Some(run) => run.end = row + 1,
                None => of.runs.push(row..row + 1),
            }
        }
    }

    /// Records the gaps in all rows of a piece; `first` is the number of its first row.
    pub fn see_all(&mut self, rows: &SweepRows, first: usize) {
        self.add(&rows.missing, first);
        let count = if self.infinite.is_empty() { 0 } else { rows.columns[0].len() };
        (0..count)
            .filter(|i| !rows.missing.contains_key(i))
            .for_each(|i| self.see(first + i, |column| rows.columns[column][i]));
    }

    /// Records the missing rows of a piece; `first` is the number of its first row.
    pub fn add(&mut self, missing: &BTreeMap<usize, Faults>, first: usize) {
        for gap in runs(missing, first) {
            match self.missing.last_mut().filter(|g| g.rows.end == gap.rows.start) {
                Some(last) => last.rows.end = gap.rows.end,
                None => self.missing.push(gap),
            }
        }
    }

    /// Returns true if no row is missing.
    pub fn is_empty(&self) -> bool {
        self.missing.is_empty()
    }

    /// One note for each run; `words` names a row by its swept value.
    pub fn notes(&self, words: &dyn Fn(usize) -> String) -> Vec<Diagnostic> {
        let infinite = self
            .infinite
            .iter()
            .flat_map(|of| of.runs.iter().map(|run| infinite_note(words, &of.name, run)));
        gap_notes(words, &self.missing).into_iter().chain(infinite).collect()
    }
}
