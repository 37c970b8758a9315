//! Apache Parquet: a row group for each piece, plain doubles, each number of a repeating column
//! once (dictionary). Title, units and notes are key-value metadata of the file.
//!
//! The footer of a Parquet file lists the position of every column of every row group. A piece is
//! made before its position is known: its index is such a list relative to its own first byte, and
//! the end of the file shifts all lists to their positions. Nothing is encoded twice, and an
//! incomplete file is continued without reading it.

use super::{ColumnHeading, GENERATOR, PiecePlace, RowFormat, TableHead, TablePiece};
use hodograph_base::diag::Diagnostic;
use parquet::basic::{Encoding, Repetition, Type as Physical};
use parquet::column::writer::{ColumnWriter, get_column_writer};
use parquet::errors::Result as ParquetResult;
use parquet::file::metadata::{
    ColumnChunkMetaData, FileMetaData, KeyValue, ParquetMetaData, ParquetMetaDataReader,
    ParquetMetaDataWriter, RowGroupMetaData,
};
use parquet::file::properties::{EnabledStatistics, WriterProperties, WriterPropertiesPtr};
use parquet::file::writer::{SerializedPageWriter, TrackedWrite};
use parquet::schema::types::{ColumnPath, SchemaDescPtr, SchemaDescriptor, Type};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::io;
use std::sync::Arc;

/// The Parquet format with a head.
pub struct Parquet {
    head: TableHead,
    schema: SchemaDescPtr,
    properties: WriterPropertiesPtr,
}

/// The four bytes at the beginning and the end of a Parquet file.
const MAGIC: &[u8; 4] = b"PAR1";

/// Length of the footer length and magic after the footer.
const AFTER_FOOTER: usize = 8;

/// Largest number of rows per page: a page of doubles, 128 KiB, is copied from a cache to the
/// file's bytes.
const PAGE: usize = 1 << 14;

impl Parquet {
    /// Returns the format for a table with this head.
    ///
    /// # Errors
    /// None that a head can cause.
    pub fn new(head: TableHead) -> io::Result<Parquet> {
        let fields = head.columns.iter().map(|h| {
            let kind = if h.whole { Physical::INT64 } else { Physical::DOUBLE };
            Type::primitive_type_builder(&h.label(), kind)
                .with_repetition(Repetition::REQUIRED)
                .build()
                .map(Arc::new)
        });
        let fields = fields.collect::<ParquetResult<Vec<_>>>()?;
        let root = Type::group_type_builder("schema").with_fields(fields).build()?;
        // Answers rarely repeat: a dictionary would cost more than it saves. Column statistics
        // would not help a reader to skip pages: each row group contains both fast and slow
        // mechanisms.
        let mut properties = WriterProperties::builder()
            .set_dictionary_enabled(false)
            .set_encoding(Encoding::PLAIN)
            .set_statistics_enabled(EnabledStatistics::None)
            .set_offset_index_disabled(true)
            .set_data_page_row_count_limit(PAGE)
            .set_created_by(created_by());
        for h in head.columns.iter().filter(|h| h.repeats) {
            let column = ColumnPath::from(vec![h.label()]);
            properties = properties
                .set_column_dictionary_enabled(column.clone(), true)
                .set_column_statistics_enabled(column, EnabledStatistics::Chunk);
        }
        Ok(Parquet {
            head,
            schema: Arc::new(SchemaDescriptor::new(Arc::new(root))),
            properties: Arc::new(properties.build()),
        })
    }

    /// Returns the bytes of one column of a row group, and its metadata relative to the first of
    /// them.
    fn column(
        &self,
        i: usize,
        heading: &ColumnHeading,
        values: &[f64],
        mut used: Vec<u8>,
    ) -> ParquetResult<(Vec<u8>, ColumnChunkMetaData)> {
        used.reserve(if heading.repeats { 0 } else { values.len() * 8 + 4096 });
        let mut sink = TrackedWrite::new(used);
        let pages = Box::new(SerializedPageWriter::new(&mut sink));
        let close =
            match get_column_writer(self.schema.column(i), Arc::clone(&self.properties), pages) {
                ColumnWriter::Int64ColumnWriter(mut w) if heading.whole => {
                    let whole: Vec<i64> = values.iter().map(|v| *v as i64).collect();
                    w.write_batch(&whole, None, None)?;
                    w.close()?
                }
                ColumnWriter::DoubleColumnWriter(mut w) => {
                    w.write_batch(values, None, None)?;
                    w.close()?
                }
                _ => {
                    return Err(parquet::errors::ParquetError::General(
                        "a column is neither whole nor double".into(),
                    ));
                }
            };
        Ok((sink.into_inner()?, close.metadata))
    }

    fn footer(
        &self,
        groups: Vec<RowGroupMetaData>,
        values: Vec<KeyValue>,
    ) -> ParquetResult<Vec<u8>> {
        let rows = groups.iter().map(RowGroupMetaData::num_rows).sum();
        let values = (!values.is_empty()).then_some(values);
        let file =
            FileMetaData::new(1, rows, Some(created_by()), values, Arc::clone(&self.schema), None);
        let mut out = Vec::new();
        ParquetMetaDataWriter::new(&mut out, &ParquetMetaData::new(file, groups)).finish()?;
        Ok(out)
    }

    /// Returns a row group's metadata, shifted to its position.
    fn group(&self, standing: &PiecePlace, ordinal: usize) -> ParquetResult<RowGroupMetaData> {
        let there = ParquetMetaDataReader::decode_metadata(&standing.index)?;
        let group = there.row_groups().first().ok_or_else(|| {
            parquet::errors::ParquetError::General("an index without rows".into())
        })?;
        let columns = group
            .columns()
            .iter()
            .map(|c| moved(c, standing.offset as i64))
            .collect::<ParquetResult<Vec<_>>>()?;
        group
            .clone()
            .into_builder()
            .set_column_metadata(columns)
            .set_ordinal(ordinal as i32)
            .set_file_offset(standing.offset as i64)
            .build()
    }
}

fn created_by() -> String {
    GENERATOR.replacen(' ', " version ", 1)
}

/// Returns a column's metadata with its positions shifted by `by`.
fn moved(column: &ColumnChunkMetaData, by: i64) -> ParquetResult<ColumnChunkMetaData> {
    let dictionary = column.dictionary_page_offset().map(|o| o + by);
    column
        .clone()
        .into_builder()
        .set_data_page_offset(column.data_page_offset() + by)
        .set_dictionary_page_offset(dictionary)
        .build()
}

impl RowFormat for Parquet {
    fn begin(&self, _rows: u64, _notes: &[Diagnostic]) -> Vec<u8> {
        MAGIC.to_vec()
    }

    fn piece_in(&self, columns: &[&[f64]], used: TablePiece) -> io::Result<TablePiece> {
        let rows = columns.first().map_or(0, |c| c.len());
        let memory = used.into_parts(columns.len());
        let all = columns.par_iter().zip(&self.head.columns).zip(memory).enumerate();
        let made = all.map(|(i, ((values, h), used))| self.column(i, h, values, used));
        let made = made.collect::<ParquetResult<Vec<_>>>()?;
        let (mut parts, mut chunks, mut length) =
            (Vec::with_capacity(made.len()), Vec::with_capacity(made.len()), 0);
        for (column, chunk) in made {
            chunks.push(moved(&chunk, length)?);
            length += column.len() as i64;
            parts.push(column);
        }
        let size = chunks.iter().map(ColumnChunkMetaData::uncompressed_size).sum();
        let group = RowGroupMetaData::builder(Arc::clone(&self.schema))
            .set_column_metadata(chunks)
            .set_total_byte_size(size)
            .set_num_rows(rows as i64)
            .build()?;
        let mut index = self.footer(vec![group], Vec::new())?;
        index.truncate(index.len().saturating_sub(AFTER_FOOTER));
        Ok(TablePiece { parts, rows: rows as u64, index })
    }

    fn end(&self, pieces: &[PiecePlace], notes: &[Diagnostic]) -> io::Result<Vec<u8>> {
        let groups =
            pieces.iter().filter(|p| p.rows > 0).enumerate().map(|(k, p)| self.group(p, k));
        let groups = groups.collect::<ParquetResult<Vec<_>>>()?;
        let units: BTreeMap<String, &str> =
            self.head.columns.iter().map(|h| (h.label(), h.unit.as_ref())).collect();
        let text = |v: serde_json::Result<String>| v.map_err(io::Error::other);
        let values = [
            ("title", self.head.title.clone()),
            ("generator", GENERATOR.to_owned()),
            ("units", text(serde_json::to_string(&units))?),
            ("notes", text(serde_json::to_string(&super::json::notes(notes)))?),
        ];
        Ok(self.footer(groups, values.map(|(k, v)| KeyValue::new(k.to_owned(), v)).to_vec())?)
    }
}
