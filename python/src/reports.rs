//! Reports on scenes: the limits of the motion, the analytic method.

use crate::fault::{Refusal, notes};
use crate::solved::Problem;
use crate::work::run;
use hodograph::diag::{Diagnostic, Warned};
use hodograph::loops;
use hodograph::mechanism::Mechanism;
use hodograph::problem::{range, whole, whole_motion};
use hodograph::report::{limits as of_limits, loops as of_loops};
use hodograph::scene::{Lang, Scene};
use hodograph::sweep::extreme;
use pyo3::prelude::*;
use serde_json::json;

/// A report: its JSON, its text in English and in Chinese, the remarks as JSON, the language of the
/// scene.
pub type NamedReport = (String, String, String, String, &'static str);

/// Returns the name of a scene's language.
pub fn spoken(scene: &Scene) -> &'static str {
    scene.language.unwrap_or_default().name()
}

/// Returns the notes of a problem and of a report.
pub fn all_notes(of: &Problem, more: Vec<Diagnostic>) -> String {
    let list: Vec<_> = of.remarks().iter().cloned().chain(more).collect();
    notes(&list, of.text().0, of.text().1)
}

/// Returns range, strokes, time ratio and transmission angles of the motion, with the balance of
/// energy of a scene with loads.
///
/// # Errors
/// Faults of the scene and of the arguments.
#[pyfunction]
#[pyo3(signature = (problem, over, flywheel))]
pub fn limits(
    py: Python,
    problem: &Problem,
    over: Option<&str>,
    flywheel: Option<&str>,
) -> PyResult<NamedReport> {
    run(py, || {
        let Warned { value: (scene, driver, limits), notes } = moved(problem, over)?;
        let energy = whole::balanced(&scene, problem.text().1, driver, flywheel)
            .map_err(|f| Refusal::range(f, problem.text(), None))?;
        let mut json = of_limits::json(&scene, driver, &limits);
        json["energy"] = energy.as_ref().map(|e| e.json()).into();
        let text = |lang| {
            let balance = energy.as_ref().map(|e| e.text(&scene, driver, &limits, lang));
            of_limits::text(&scene, driver, &limits, lang) + &balance.unwrap_or_default()
        };
        Ok((
            json.to_string(),
            text(Lang::En),
            text(Lang::Zh),
            all_notes(problem, notes),
            spoken(&scene),
        ))
    })
}

/// Returns the ranges of each length in which a four-bar keeps its type.
///
/// # Errors
/// Faults of the scene and of the arguments; a mechanism without such types.
#[pyfunction]
#[pyo3(signature = (problem, over))]
pub fn length_ranges(py: Python, problem: &Problem, over: Option<&str>) -> PyResult<NamedReport> {
    run(py, || {
        let Warned { value: (scene, _, limits), notes } = moved(problem, over)?;
        let all = of_limits::ranges::of(&limits).map_err(|d| problem.refused(d))?;
        let text = |lang| of_limits::ranges::text(&scene, &all, lang);
        let json = json!({ "ranges": of_limits::ranges::json(&all) }).to_string();
        Ok((json, text(Lang::En), text(Lang::Zh), all_notes(problem, notes), spoken(&scene)))
    })
}

/// Returns the analytic method: vector loops, formulas with their numbers.
///
/// # Errors
/// Faults of the scene; a mechanism without loops.
#[pyfunction]
pub fn vector_loops(py: Python, problem: &Problem) -> PyResult<NamedReport> {
    run(py, || {
        let scene = problem.scene()?;
        let Warned { value, notes } = loops::loops(&scene).map_err(|f| problem.refused(f))?;
        let text = |lang| of_loops::LoopWords::new(&scene, &value, lang).text();
        let json = of_loops::json(&scene, &value).to_string();
        Ok((json, text(Lang::En), text(Lang::Zh), all_notes(problem, notes), spoken(&scene)))
    })
}

/// Returns the scene over its whole motion with a driver and its limits.
fn moved(
    problem: &Problem,
    over: Option<&str>,
) -> Result<Warned<(Scene, usize, extreme::MotionLimits)>, Refusal> {
    let Warned { value: scene, notes } = whole_motion(problem.scene()?);
    let mechanism = Mechanism::new(&scene).map_err(|f| problem.refused(f))?.value;
    let driver = range::driver_of(&scene, over).map_err(|w| Refusal::values(vec![w]))?;
    let limits = extreme::limits(&scene, &mechanism, driver).map_err(|f| problem.refused(f))?;
    Ok(Warned { value: (scene, driver, limits), notes })
}
