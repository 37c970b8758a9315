//! Tables of numbers as files: CSV, JSON, NumPy's `.npy`, Apache Parquet.
//!
//! A file consists of a beginning, pieces, and an end ([`RowFormat`]). A piece consists of whole
//! rows and depends only on their numbers: pieces are made on any thread while others are computed
//! or written, and an incomplete file continues after its last piece with the same bytes that an
//! uninterrupted run would give. JSON lists its columns one after the other and has no pieces
//! ([`json()`]).
//!
//! Columns have the same labels in CSV, `.npy` and Parquet: name and SI unit, `v_C.x [m/s]`.
//!
//! The columns are decided by [`hodograph_sweep`], the destination of the bytes by the command
//! line.

mod csv;
mod json;
mod npy;
#[cfg(feature = "tables")]
mod parquet;

pub use self::csv::Csv;
pub use self::json::json;
pub use self::npy::Npy;
#[cfg(feature = "tables")]
pub use self::parquet::Parquet;

use hodograph_base::diag::Diagnostic;
use hodograph_scene::Lang;
use hodograph_sweep::Table;
use std::borrow::Cow;
use std::collections::HashSet;
use std::io;

/// The program that writes the files, with its version.
pub const GENERATOR: &str = concat!("hodograph ", env!("CARGO_PKG_VERSION"));

/// A column's heading.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ColumnHeading {
    /// Name, such as `v_C.x`, unique in the table.
    pub name: String,
    /// Unit; empty for a pure number.
    pub unit: Cow<'static, str>,
    /// True for whole numbers, such as the number of a mechanism.
    pub whole: bool,
    /// True if the same numbers recur, as for parameters and positions of a driver: each is then
    /// written once if the format allows.
    pub repeats: bool,
}

impl ColumnHeading {
    /// Returns name and unit: `v_C.x [m/s]`.
    pub fn label(&self) -> String {
        if self.unit.is_empty() {
            self.name.clone()
        } else {
            format!("{} [{}]", self.name, self.unit)
        }
    }
}

/// The description of a table, without its numbers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TableHead {
    /// Title of the scene; may be empty.
    pub title: String,
    /// The columns.
    pub columns: Vec<ColumnHeading>,
    /// Language of the notes, if the format has notes for people.
    pub lang: Lang,
}

impl TableHead {
    /// Returns a head of names and units. Of two columns with one name the later gets a number,
    /// `phi_1 (2)`, because readers find columns by name.
    pub fn new(
        title: &str,
        columns: impl IntoIterator<Item = (String, &'static str)>,
    ) -> TableHead {
        let mut seen = HashSet::new();
        let mut columns: Vec<ColumnHeading> = columns
            .into_iter()
            .map(|(name, unit)| ColumnHeading {
                name,
                unit: unit.into(),
                whole: false,
                repeats: false,
            })
            .collect();
        for c in &mut columns {
            let own = c.name.clone();
            let mut count = 1;
            while !seen.insert(c.name.clone()) {
                count += 1;
                c.name = format!("{own} ({count})");
            }
        }
        TableHead { title: title.to_owned(), columns, lang: Lang::default() }
    }

    /// Returns the head with other units, one for each column.
    pub fn in_units(mut self, units: impl IntoIterator<Item = String>) -> TableHead {
        self.columns.iter_mut().zip(units).for_each(|(c, unit)| c.unit = unit.into());
        self
    }

    /// Returns the head with notes in a language.
    pub fn in_language(self, lang: Lang) -> TableHead {
        TableHead { lang, ..self }
    }

    /// Returns the head of a sweep's table.
    pub fn of(title: &str, table: &Table) -> TableHead {
        TableHead::new(title, table.columns.iter().map(|c| (c.name.clone(), c.unit)))
    }

    /// Returns the labels of the columns.
    pub fn labels(&self) -> impl Iterator<Item = String> + '_ {
        self.columns.iter().map(ColumnHeading::label)
    }
}

/// A number of whole rows in a format.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TablePiece {
    /// The bytes, in parts one after the other: the parts are kept as they were made, because
    /// joining them would copy every byte again.
    pub parts: Vec<Vec<u8>>,
    /// Number of rows.
    pub rows: u64,
    /// Data for the end of the file; empty in most formats.
    pub index: Vec<u8>,
}

impl TablePiece {
    /// Returns the buffers of its parts for reuse as `count` parts: empty, with their capacity.
    fn into_parts(self, count: usize) -> Vec<Vec<u8>> {
        let mut parts = self.parts;
        parts.iter_mut().for_each(Vec::clear);
        parts.resize_with(count, Vec::new);
        parts
    }

    /// Number of bytes of all parts.
    pub fn length(&self) -> u64 {
        self.parts.iter().map(|p| p.len() as u64).sum()
    }

    /// Writes all parts.
    ///
    /// # Errors
    /// The errors of the writer.
    pub fn write(&self, out: &mut dyn io::Write) -> io::Result<()> {
        self.parts.iter().try_for_each(|p| out.write_all(p))
    }
}

/// The position of a piece in its file, and its index.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PiecePlace {
    /// Offset of its first byte from the beginning of the file.
    pub offset: u64,
    /// Number of rows, as [`TablePiece::rows`].
    pub rows: u64,
    /// Data for the end of the file, as [`TablePiece::index`].
    pub index: Vec<u8>,
}

/// A format whose files are written row by row.
pub trait RowFormat: Send + Sync {
    /// Returns the bytes before the first row. Their number is independent of `rows`: they may be
    /// overwritten when the rows are counted.
    fn begin(&self, rows: u64, notes: &[Diagnostic]) -> Vec<u8>;

    /// Returns rows, from columns of equal length, in the buffers of a piece that is not needed any
    /// more: allocating fresh memory costs as much time as writing the bytes.
    ///
    /// # Errors
    /// The errors of the format's library.
    fn piece_in(&self, columns: &[&[f64]], used: TablePiece) -> io::Result<TablePiece>;

    /// Returns the bytes after the last row, given all pieces with rows.
    ///
    /// # Errors
    /// The errors of the format's library; an invalid index.
    fn end(&self, pieces: &[PiecePlace], notes: &[Diagnostic]) -> io::Result<Vec<u8>>;
}
