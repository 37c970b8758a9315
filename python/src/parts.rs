//! Batches as parts in a folder.

use crate::fault::Refusal;
use crate::solved::Problem;
use crate::work::{run, watched};
use hodograph::parts::{PartFault, PartFolder, PartRequest, RowCount};
use hodograph::problem::range::SweptRange;
use pyo3::prelude::*;
use std::cell::Cell;
use std::path::PathBuf;
use std::sync::atomic::Ordering;

/// Mechanisms, rows, and positions without a row.
type NamedCount = (u64, u64, u64);

fn named(count: RowCount) -> NamedCount {
    (count.mechanisms, count.rows, count.missing)
}

/// Returns the refusal with the names of the arguments in Python.
fn refused(all: Vec<PartFault>) -> Refusal {
    Refusal::all(all.into_iter().map(|f| {
        let name = match &*f.name {
            "FOLDER" => "folder",
            "o" => "output",
            other => other,
        };
        Refusal::in_text(f.faults, name, &f.text)
    }))
}

/// A folder with the parts of a batch.
#[pyclass(frozen, module = "hodograph._native")]
pub struct Parts {
    parts: PartFolder,
}

#[pymethods]
impl Parts {
    /// Opens a folder with the batch that it describes.
    #[new]
    fn new(py: Python, folder: PathBuf) -> PyResult<Parts> {
        let parts = run(py, || PartFolder::open(&folder).map_err(refused))?;
        Ok(Parts { parts })
    }

    /// Describes a batch in a folder, or compares the folder's description with it.
    #[staticmethod]
    #[pyo3(signature = (folder, problem, vary, random, seed, over, from_, to, steps, find, format, per_part))]
    #[expect(clippy::too_many_arguments, reason = "each is an argument in Python")]
    fn begin(
        py: Python,
        folder: PathBuf,
        problem: &Problem,
        vary: Vec<String>,
        random: Option<u64>,
        seed: u64,
        over: Option<&str>,
        from_: Option<&str>,
        to: Option<&str>,
        steps: Option<usize>,
        find: Option<&str>,
        format: &str,
        per_part: Option<u64>,
    ) -> PyResult<Parts> {
        let range = SweptRange { over, from: from_, to, steps };
        let scene = problem.text();
        let request =
            PartRequest { scene, vary: &vary, random, seed, range, find, format, per_part };
        let parts = run(py, || PartFolder::begin(&folder, &request).map_err(refused))?;
        Ok(Parts { parts })
    }

    /// The number of parts.
    #[getter]
    fn count(&self) -> u64 {
        self.parts.count()
    }

    /// Returns the numbers of the missing parts.
    fn missing(&self, py: Python) -> PyResult<Vec<u64>> {
        run(py, || Ok(self.parts.missing()))
    }

    /// Returns the file of a part.
    fn path(&self, part: u64) -> PathBuf {
        self.parts.path(part)
    }

    /// Computes parts that are missing, and counts the others.
    #[pyo3(signature = (parts, tell))]
    fn compute(
        &self,
        py: Python,
        parts: Vec<u64>,
        tell: Option<&Bound<PyAny>>,
    ) -> PyResult<NamedCount> {
        watched(py, tell, |progress| {
            let all = parts.iter().map(|&k| self.parts.mechanisms(k)).sum();
            progress.all.store(all, Ordering::Relaxed);
            let (stop, sum) = (|| progress.is_over(), Cell::new(0));
            let done = |more| {
                sum.set(sum.get() + more);
                progress.done.store(sum.get(), Ordering::Relaxed);
            };
            self.parts.compute(&parts, &stop, &done).map(named).map_err(refused)
        })
    }

    /// Reads all parts: missing ones, damaged ones, the rows and their CRC-32.
    #[pyo3(signature = (remove_damaged))]
    fn verify(
        &self,
        py: Python,
        remove_damaged: bool,
    ) -> PyResult<(Vec<u64>, Vec<u64>, NamedCount, u32)> {
        run(py, || {
            let told = self.parts.verify(remove_damaged).map_err(refused)?;
            Ok((told.absent, told.damaged, named(told.count), told.sum))
        })
    }

    /// Joins all parts into one table.
    fn compact(&self, py: Python, output: &str) -> PyResult<NamedCount> {
        run(py, || self.parts.compact(output).map(named).map_err(refused))
    }
}
