//! Variants of a problem for a class, and the marking of answers.

use crate::fault::{Refusal, notes};
use crate::look::{Named, look, unknown};
use crate::solved::Problem;
use crate::work::run;
use hodograph::diag::{Diagnostic, Warned, both};
use hodograph::figure::results::DIGITS;
use hodograph::homework::platforms::Platform;
use hodograph::homework::{self, HomeworkAdditions, HomeworkRequest, HomeworkVariant};
use hodograph::problem::range::{RangeFault, WrongValue};
use hodograph::problem::whole_page;
use hodograph::scene::Lang;
use pyo3::prelude::*;
use serde_json::json;

/// A variant: number, student, varied values, text of the scene, key as JSON.
type NamedVariant = (usize, Option<String>, Vec<(String, String)>, String, String);

/// The variants of a problem.
#[pyclass(frozen, module = "hodograph._native")]
pub struct Variants {
    all: Vec<HomeworkVariant>,
    notes: Vec<Diagnostic>,
    /// The name and the text of the problem.
    of: (String, String),
}

#[pymethods]
impl Variants {
    /// Makes variants of a problem: each of `vary` is `NAME=FROM..TO/STEP` or `NAME=FROM..TO:N`.
    #[new]
    #[pyo3(signature = (problem, vary, count, seed, students))]
    fn new(
        py: Python,
        problem: &Problem,
        vary: Vec<String>,
        count: Option<usize>,
        seed: u64,
        students: Vec<String>,
    ) -> PyResult<Variants> {
        let (name, text) = problem.text();
        let of = (name.to_owned(), text.to_owned());
        run(py, || {
            problem.scene()?;
            let count = homework::count(count, students.len(), !vary.is_empty())
                .map_err(|w| Refusal::values(vec![w]))?;
            let request = HomeworkRequest { vary: &vary, count, seed, students: &students };
            let Warned { value: all, notes: more } = homework::variants(text, &request)
                .map_err(|f| Refusal::range(f, (name, text), None))?;
            let notes = problem.remarks().iter().cloned().chain(more).collect();
            Ok(Variants { all, notes, of })
        })
    }

    /// The variants.
    #[getter]
    fn all(&self) -> Vec<NamedVariant> {
        let key = |v: &HomeworkVariant| {
            let mistake =
                |m: &homework::TypicalError| json!({"words": m.words().json(), "value": m.value});
            let one = |k: &homework::KeyEntry| {
                json!({
                    "question": k.question, "unit": k.unit, "value": k.value, "tolerance": k.tolerance,
                    "mistakes": k.mistakes.iter().map(mistake).collect::<Vec<_>>(),
                })
            };
            json!(v.key.iter().map(one).collect::<Vec<_>>()).to_string()
        };
        let one = |v: &HomeworkVariant| {
            (v.number, v.student.clone(), v.values.clone(), v.text.clone(), key(v))
        };
        self.all.iter().map(one).collect()
    }

    /// Remarks of reading and choosing, as JSON.
    #[getter(notes)]
    fn told(&self) -> String {
        notes(&self.notes, &self.of.0, &self.of.1)
    }

    /// Returns the files of the set: their paths in its folder, and their bytes.
    #[pyo3(signature = (platforms, frame, look_of))]
    fn files(
        &self,
        py: Python,
        platforms: Vec<String>,
        frame: Option<&str>,
        look_of: Named,
    ) -> PyResult<Vec<(String, Vec<u8>)>> {
        run(py, || {
            let look = look(look_of, DIGITS)?;
            let platforms: Vec<Platform> =
                platforms.iter().map(|name| platform(name)).collect::<Result<_, _>>()?;
            let frame = frame.map(whole_page).transpose().map_err(|w| Refusal::values(vec![w]))?;
            let wanted = HomeworkAdditions { platforms: &platforms, frame };
            let made = homework::files(&self.all, &wanted, &look);
            let made = made.map_err(|fault| Refusal::range(named(fault), self.text(), None))?;
            Ok(made.value.into_iter().map(|f| (f.path, f.bytes)).collect())
        })
    }
}

impl Variants {
    fn text(&self) -> (&str, &str) {
        (&self.of.0, &self.of.1)
    }
}

/// The faults with the argument of Python for the platforms.
fn named(fault: RangeFault) -> RangeFault {
    match fault {
        RangeFault::Values(all) => {
            let one = |w: WrongValue| WrongValue { of: "platforms", ..w };
            RangeFault::Values(all.into_iter().map(one).collect())
        }
        RangeFault::Scene(faults) => RangeFault::Scene(faults),
    }
}

/// Returns the learning platform of a name.
fn platform(name: &str) -> Result<Platform, Refusal> {
    let known = Platform::ALL.map(Platform::name);
    Platform::named(name).ok_or_else(|| unknown("platform", both!("platform"), name, &known))
}

/// Returns the names of students in a table.
///
/// # Errors
/// Faults of the table.
#[pyfunction]
pub fn roster(py: Python, text: &str) -> PyResult<Vec<String>> {
    run(py, || homework::names(text).map_err(|f| Refusal::in_text(f, "students", text)))
}

/// Marks the answers of a class by the key of its variants, both as CSV; returns the marks as CSV in
/// English and in Chinese.
///
/// # Errors
/// Faults of either table.
#[pyfunction]
pub fn mark(py: Python, answers: &str, keys: &str) -> PyResult<(String, String)> {
    run(py, || {
        let marks = homework::mark(answers, keys).map_err(|f| {
            let all = [(f.answers, "answers", answers), (f.keys, "keys", keys)];
            let wrong = all.into_iter().filter(|(faults, ..)| faults.has_errors());
            Refusal::all(wrong.map(|(faults, name, text)| Refusal::in_text(faults, name, text)))
        })?;
        Ok((marks.csv(Lang::En), marks.csv(Lang::Zh)))
    })
}
