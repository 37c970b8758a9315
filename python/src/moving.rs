//! Figures that are drawn again while their drivers are dragged.

use crate::fault::Refusal;
use crate::look::{Named, look};
use crate::solved::{Problem, named};
use crate::work::run;
use hodograph::figure::results::DIGITS as SHEET_DIGITS;
use hodograph::problem::{Live, Options, Pictures, range, whole};
use hodograph::scene::Swept;
use pyo3::prelude::*;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Figures that move with the drivers.
#[pyclass(frozen, module = "hodograph._native")]
pub struct Moving {
    live: Mutex<Live>,
    swept: Swept,
    problem: Py<Problem>,
}

impl Moving {
    fn live(&self) -> MutexGuard<'_, Live> {
        self.live.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Changes the figures; returns the documents of all pages by name.
    fn shown(
        &self,
        py: Python,
        change: impl FnOnce(&mut Live) -> Result<Vec<String>, Refusal> + Send,
    ) -> PyResult<Vec<(String, String)>> {
        run(py, || {
            let mut live = self.live();
            let names = change(&mut live)?;
            Ok(names.into_iter().filter_map(|n| live.svg(&n).map(|svg| (n, svg))).collect())
        })
    }
}

#[pymethods]
impl Moving {
    /// Prepares figures; with `reserve` their paper has space for the whole motion.
    #[new]
    #[pyo3(signature = (problem, names, over, reserve, look_of))]
    fn new(
        py: Python,
        problem: Py<Problem>,
        names: Vec<String>,
        over: Option<&str>,
        reserve: bool,
        look_of: Named,
    ) -> PyResult<Moving> {
        let of = problem.get();
        let (live, swept) = run(py, || {
            let refused = |faults| Refusal::in_text(faults, of.text().0, of.text().1);
            let scene = of.given().clone().into_scene()?;
            let swept = match over {
                None => whole::usual(&scene)?,
                over => range::swept_of(&scene, over).map_err(|w| Refusal::values(vec![w]))?,
            };
            let look = look(look_of, SHEET_DIGITS)?;
            let figures = names.iter().map(|name| named(name)).collect::<Result<Vec<_>, _>>()?;
            let pictures = Pictures { figures: &figures, ..Pictures::default() };
            let made = Live::new(of.given(), &Options::default(), &pictures, &look);
            let mut live = made.map_err(refused)?;
            if reserve {
                live.reserve(swept).map_err(refused)?;
            }
            Ok((live, swept))
        })?;
        Ok(Moving { live: Mutex::new(live), swept, problem })
    }

    /// The positions of the drivers (rad or m).
    #[getter]
    fn values(&self) -> Vec<f64> {
        self.live().values().to_vec()
    }

    /// Draws the figures at positions of the drivers (rad or m).
    fn redraw(&self, py: Python, values: Vec<f64>) -> PyResult<Vec<(String, String)>> {
        let refused = |faults| {
            Refusal::in_text(faults, self.problem.get().text().0, self.problem.get().text().1)
        };
        self.shown(py, |live| {
            let changes = live.redraw(&values).map_err(refused)?;
            Ok(changes.into_iter().map(|c| c.name).collect())
        })
    }

    /// Draws the figures after a travel (rad, m or s) from the scene's own pose.
    fn redraw_after(&self, py: Python, travel: f64) -> PyResult<Vec<(String, String)>> {
        let refused = |faults| {
            Refusal::in_text(faults, self.problem.get().text().0, self.problem.get().text().1)
        };
        self.shown(py, |live| {
            let changes = live.redraw_after(self.swept, travel).map_err(refused)?;
            Ok(changes.into_iter().map(|c| c.name).collect())
        })
    }

    /// Returns the answers in the pose of the figures: question and text.
    fn answers(&self, py: Python, look_of: Named) -> PyResult<Vec<(String, String)>> {
        run(py, || {
            let look = look(look_of, hodograph::report::answers::DIGITS)?;
            let all = self.live().solved().answers(&look);
            Ok(all.into_iter().map(|a| (a.find, a.text)).collect())
        })
    }
}
