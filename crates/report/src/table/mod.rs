//! Tables of numbers as files: CSV, JSON, NumPy's `.npy`, Apache Parquet.
//!
//! A file is a beginning, pieces, and an end ([`Format`]). A piece is some whole rows and depends on nothing but their numbers: pieces
//! are made on any thread, while others are computed or written, and a file that was left half-way goes on behind its last piece
//! with the bytes it would have had anyway. JSON lists its columns one behind the other and has no pieces ([`json()`]).
//!
//! Columns have the same labels in CSV, `.npy` and Parquet: name and SI unit, `v_C.x [m/s]`.
//!
//! Not decided here: what the columns are ([`hodograph_sweep`]), and where the bytes go (the command line).

mod csv;
mod json;
mod npy;
mod parquet;

pub use self::csv::Csv;
pub use self::json::json;
pub use self::npy::Npy;
pub use self::parquet::Parquet;

use hodograph_base::diag::Diagnostic;
use hodograph_scene::Lang;
use hodograph_sweep::Table;
use std::collections::HashSet;
use std::io;

/// What program wrote a file.
pub const GENERATOR: &str = concat!("hodograph ", env!("CARGO_PKG_VERSION"));

/// A column's heading.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Heading {
    /// Its name, such as `v_C.x`; no other column has it.
    pub name: String,
    /// Its SI unit; empty for a pure number.
    pub unit: &'static str,
    /// Whole numbers, such as the number of a mechanism.
    pub whole: bool,
    /// Whether the same numbers come again and again, as parameters and positions of a driver do: where the format can, each is
    /// written once.
    pub repeats: bool,
}

impl Heading {
    /// Name and unit: `v_C.x [m/s]`.
    pub fn label(&self) -> String {
        if self.unit.is_empty() { self.name.clone() } else { format!("{} [{}]", self.name, self.unit) }
    }
}

/// What a table is, but for its numbers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Head {
    /// The scene's title; may be empty.
    pub title: String,
    /// The columns.
    pub columns: Vec<Heading>,
    /// The language of the notes, where the format has them for people.
    pub lang: Lang,
}

impl Head {
    /// A head of names and units. Of two columns of one name the later is told apart by a number, `phi_1 (2)`: readers find columns
    /// by their names.
    pub fn new(title: &str, columns: impl IntoIterator<Item = (String, &'static str)>) -> Head {
        let mut seen = HashSet::new();
        let mut columns: Vec<Heading> =
            columns.into_iter().map(|(name, unit)| Heading { name, unit, whole: false, repeats: false }).collect();
        for c in &mut columns {
            let own = c.name.clone();
            let mut count = 1;
            while !seen.insert(c.name.clone()) {
                count += 1;
                c.name = format!("{own} ({count})");
            }
        }
        Head { title: title.to_owned(), columns, lang: Lang::default() }
    }

    /// The same, with notes in a language.
    pub fn told_in(self, lang: Lang) -> Head {
        Head { lang, ..self }
    }

    /// The head of a sweep's table.
    pub fn of(title: &str, table: &Table) -> Head {
        Head::new(title, table.columns.iter().map(|c| (c.name.clone(), c.unit)))
    }

    /// The labels of the columns.
    pub fn labels(&self) -> impl Iterator<Item = String> + '_ {
        self.columns.iter().map(Heading::label)
    }
}

/// Some whole rows in a format.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Piece {
    /// What is written, one part after the other: as they were made, side by side, for joining them would move every byte once more.
    pub parts: Vec<Vec<u8>>,
    /// How many rows they hold.
    pub rows: u64,
    /// What the end of the file has to know of it; empty in most formats.
    pub index: Vec<u8>,
}

impl Piece {
    /// The memory of its parts, for so many others: empty, with what room they have.
    fn into_parts(self, count: usize) -> Vec<Vec<u8>> {
        let mut parts = self.parts;
        parts.iter_mut().for_each(Vec::clear);
        parts.resize_with(count, Vec::new);
        parts
    }

    /// Bytes of all parts.
    pub fn length(&self) -> u64 {
        self.parts.iter().map(|p| p.len() as u64).sum()
    }

    /// Writes all parts.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(&self, out: &mut dyn io::Write) -> io::Result<()> {
        self.parts.iter().try_for_each(|p| out.write_all(p))
    }
}

/// Where a piece stands in its file, and its index.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Standing {
    /// Of its first byte, from the beginning of the file.
    pub offset: u64,
    /// [`Piece::rows`].
    pub rows: u64,
    /// [`Piece::index`].
    pub index: Vec<u8>,
}

/// A format whose files are written row by row.
pub trait Format: Send + Sync {
    /// The bytes before the first row. Their number does not depend on `rows`: they may be written over when the rows are counted.
    fn begin(&self, rows: u64, notes: &[Diagnostic]) -> Vec<u8>;

    /// Rows, from columns of one length, in the memory of a piece that is no longer needed: fresh memory costs as much as the bytes in it.
    ///
    /// # Errors
    /// Those of the format's library.
    fn piece_in(&self, columns: &[&[f64]], used: Piece) -> io::Result<Piece>;

    /// The bytes after the last row, given all pieces that hold rows.
    ///
    /// # Errors
    /// Those of the format's library; an index that is none.
    fn end(&self, pieces: &[Standing], notes: &[Diagnostic]) -> io::Result<Vec<u8>>;
}
