//! A table that is stored row by row and read column by column, for formats that write one column
//! after the other.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};

/// Pieces of columns in an unnamed file.
pub struct Spool {
    file: File,
    /// Offset and number of rows of each piece.
    pieces: Vec<(u64, usize)>,
    end: u64,
}

/// Bytes of a number.
const WIDTH: u64 = size_of::<f64>() as u64;

/// Encodes columns of one length, one after the other, into a buffer that is no longer needed.
pub fn bytes(columns: &[&[f64]], mut used: Vec<u8>) -> Vec<u8> {
    used.clear();
    columns.iter().copied().flatten().for_each(|v| used.extend_from_slice(&v.to_le_bytes()));
    used
}

impl Spool {
    /// An empty table in an empty file.
    pub fn new(file: File) -> Spool {
        Spool { file, pieces: Vec::new(), end: 0 }
    }

    /// Adds rows of this number of columns, encoded by [`bytes`].
    pub fn add(&mut self, bytes: &[u8], columns: usize) -> io::Result<()> {
        self.file.write_all(bytes)?;
        self.pieces.push((self.end, bytes.len() / (columns * size_of::<f64>()).max(1)));
        self.end += bytes.len() as u64;
        Ok(())
    }

    /// Reads one column, piece by piece.
    pub fn column(&self, column: usize) -> impl Iterator<Item = io::Result<Vec<f64>>> + '_ {
        self.pieces.iter().map(move |&(begin, rows)| {
            let mut bytes = vec![0; rows * size_of::<f64>()];
            let mut file = &self.file;
            file.seek(SeekFrom::Start(begin + column as u64 * rows as u64 * WIDTH))?;
            file.read_exact(&mut bytes)?;
            let number = |b: &[u8]| b.try_into().map(f64::from_le_bytes).map_err(io::Error::other);
            bytes.chunks_exact(size_of::<f64>()).map(number).collect()
        })
    }
}
