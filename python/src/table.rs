//! Columns of numbers, shared with Python without a copy.

use crate::fault::notes;
use hodograph::diag::Diagnostic;
use hodograph::report::table::TableHead;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A column of a table. NumPy views its numbers where they are, and keeps the column alive.
#[pyclass(frozen, module = "hodograph._native")]
pub struct Column {
    values: Vec<f64>,
}

#[pymethods]
impl Column {
    fn __len__(&self) -> usize {
        self.values.len()
    }

    /// The address of the numbers, for NumPy: they cannot be changed.
    #[getter]
    fn __array_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let told = PyDict::new(py);
        told.set_item("version", 3)?;
        told.set_item("shape", (self.values.len(),))?;
        told.set_item("typestr", if cfg!(target_endian = "big") { ">f8" } else { "<f8" })?;
        told.set_item("data", (self.values.as_ptr().addr(), true))?;
        Ok(told)
    }
}

/// A table.
#[pyclass(frozen, module = "hodograph._native")]
pub struct Table {
    title: (String, String),
    heads: Vec<(String, &'static str)>,
    book: Vec<(String, f64)>,
    columns: Vec<Py<Column>>,
    notes: Vec<Diagnostic>,
}

/// The parts of a table before its columns are objects of Python.
pub struct TableParts {
    pub title: (String, String),
    pub heads: Vec<(String, &'static str)>,
    pub book: Vec<(String, f64)>,
    pub values: Vec<Vec<f64>>,
    pub notes: Vec<Diagnostic>,
}

impl Table {
    /// Returns the table of its parts.
    ///
    /// # Errors
    /// Python has no memory.
    pub fn of(py: Python, parts: TableParts) -> PyResult<Table> {
        let TableParts { title, heads, book, values, notes } = parts;
        let columns = values.into_iter().map(|values| Py::new(py, Column { values }));
        Ok(Table { title, heads, book, columns: columns.collect::<PyResult<_>>()?, notes })
    }
}

#[pymethods]
impl Table {
    /// The title in both languages.
    #[getter]
    fn title(&self) -> (&str, &str) {
        (&self.title.0, &self.title.1)
    }

    /// Name and SI unit of each column; names are unique.
    #[getter]
    fn heads(&self) -> Vec<(String, String)> {
        let head = TableHead::new("", self.heads.iter().cloned());
        head.columns.into_iter().map(|c| (c.name, c.unit.into_owned())).collect()
    }

    /// The scene's unit of each column, and the number of them in one SI unit.
    #[getter]
    fn book(&self) -> Vec<(String, f64)> {
        self.book.clone()
    }

    /// The columns.
    #[getter]
    fn columns(&self, py: Python) -> Vec<Py<Column>> {
        self.columns.iter().map(|c| c.clone_ref(py)).collect()
    }

    /// Remarks on missing rows and the like, as JSON.
    #[getter(notes)]
    fn told(&self) -> String {
        notes(&self.notes, "", "")
    }
}
