//! Whole motions of outputs, of cams and of several designs: reports with figures.

use crate::fault::Refusal;
use crate::look::{Named, look, unknown};
use crate::picture::Picture;
use crate::reports::{NamedReport, all_notes, spoken};
use crate::solved::Problem;
use crate::work::run;
use hodograph::cam::AllowedPressure;
use hodograph::diag::{Diagnostic, Warned, both};
use hodograph::figure::curves;
use hodograph::figure::cycle::CycleForm;
use hodograph::figure::results::DIGITS as SHEET_DIGITS;
use hodograph::notation::Notation;
use hodograph::problem::Look;
use hodograph::problem::cams::{self, SurveyedCam};
use hodograph::problem::compare::{ComparedScene, compare};
use hodograph::problem::cycle::CycledScene;
use hodograph::problem::range::RangeFault;
use hodograph::problem::teeth::{TeethList, TeethRequest};
use hodograph::problem::whole;
use hodograph::scene::{Lang, Scene};
use pyo3::prelude::*;

/// The motion cycle of a scene's outputs.
#[pyclass(frozen, module = "hodograph._native")]
pub struct Cycle {
    of: CycledScene,
    report: NamedReport,
}

#[pymethods]
impl Cycle {
    /// Finds the phases of all outputs, or of those in `find`.
    #[new]
    #[pyo3(signature = (problem, over, find))]
    fn new(
        py: Python,
        problem: &Problem,
        over: Option<&str>,
        find: Vec<String>,
    ) -> PyResult<Cycle> {
        run(py, || {
            let names: Vec<&str> = find.iter().map(String::as_str).collect();
            let Warned { value: of, notes } = CycledScene::of(problem.scene()?, over, &names)
                .map_err(|f| Refusal::range(f, problem.text(), None))?;
            let report = (
                of.cycle.json().to_string(),
                of.text(Lang::En),
                of.text(Lang::Zh),
                all_notes(problem, notes),
                spoken(&of.scene),
            );
            Ok(Cycle { of, report })
        })
    }

    /// The report.
    #[getter]
    fn report(&self) -> NamedReport {
        self.report.clone()
    }

    /// Draws the cycle in a form: `bars`, `straight` or `polar`.
    #[pyo3(signature = (form, look_of))]
    fn figure(&self, py: Python, form: &str, look_of: Named) -> PyResult<Picture> {
        run(py, || {
            let form = CycleForm::named(form).ok_or_else(|| {
                unknown("form", both!("form"), form, &CycleForm::ALL.map(CycleForm::name))
            })?;
            let look = look(look_of, SHEET_DIGITS)?;
            let (lang, _) = look.marked(&self.of.scene);
            Ok(Picture::of(self.of.figure(form, &look.style, lang)))
        })
    }
}

/// Several designs side by side.
#[pyclass(frozen, module = "hodograph._native")]
pub struct Comparison {
    scenes: Vec<ComparedScene>,
    /// Names and texts of the scenes.
    texts: Vec<(String, String)>,
    over: Option<String>,
    find: Option<String>,
    notes: String,
}

impl Comparison {
    /// Compares; a fault is that of the scene at which it is found.
    fn made(
        &self,
        (lang, notation): (Lang, Notation),
    ) -> Result<(hodograph::report::comparison::Comparison, curves::CurveDiagram), Refusal> {
        let over = self.over.as_deref();
        compare(&self.scenes, over, lang, &notation).map_err(|(k, fault)| self.refused(k, fault))
    }

    fn refused(&self, k: usize, fault: RangeFault) -> Refusal {
        let (name, text) = &self.texts[k];
        Refusal::range(fault, (name, text), self.find.as_deref())
    }
}

#[pymethods]
impl Comparison {
    /// Reads scenes for their whole motion, with the questions `find` or their own.
    #[new]
    #[pyo3(signature = (problems, names, over, find))]
    fn new(
        py: Python,
        problems: Vec<Py<Problem>>,
        names: Vec<String>,
        over: Option<String>,
        find: Option<String>,
    ) -> PyResult<Comparison> {
        run(py, || {
            let (mut scenes, mut texts, mut all) = (Vec::new(), Vec::new(), Vec::new());
            for (problem, file) in problems.iter().zip(names) {
                let problem = problem.get();
                problem.scene()?;
                let (name, text) = problem.text();
                let read = whole::asking_for_motion(text.as_bytes(), find.as_deref())
                    .map_err(|f| Refusal::asked(f, (name, text), find.as_deref()))?;
                all.extend(read.notes);
                texts.push((name.to_owned(), text.to_owned()));
                scenes.push(ComparedScene { file, scene: read.value });
            }
            let notes = crate::fault::notes(&all, "", "");
            let of = Comparison { scenes, texts, over, find, notes };
            Ok(of)
        })
    }

    /// Returns the table as a report.
    fn report(&self, py: Python) -> PyResult<NamedReport> {
        run(py, || {
            let Some(first) = self.scenes.first() else { return Err(no_scene()) };
            let of = |lang| {
                let look = Look { lang: Some(lang), ..Look::default() };
                Ok::<_, Refusal>(self.made(look.marked(&first.scene))?.0)
            };
            let own = first.scene.language.unwrap_or_default();
            let (en, zh) = (of(Lang::En)?, of(Lang::Zh)?);
            let json = if own == Lang::Zh { zh.json() } else { en.json() };
            let texts = (en.text(Lang::En), zh.text(Lang::Zh));
            Ok((json.to_string(), texts.0, texts.1, self.notes.clone(), spoken(&first.scene)))
        })
    }

    /// Returns the table as CSV.
    #[pyo3(signature = (look_of))]
    fn csv(&self, py: Python, look_of: Named) -> PyResult<String> {
        run(py, || {
            let Some(first) = self.scenes.first() else { return Err(no_scene()) };
            let look = look(look_of, SHEET_DIGITS)?;
            Ok(self.made(look.marked(&first.scene))?.0.csv())
        })
    }

    /// Draws the quantities of all designs, each over the motion of the driver.
    #[pyo3(signature = (look_of))]
    fn figure(&self, py: Python, look_of: Named) -> PyResult<Picture> {
        run(py, || {
            let Some(first) = self.scenes.first() else { return Err(no_scene()) };
            let look = look(look_of, SHEET_DIGITS)?;
            let (lang, notation) = look.marked(&first.scene);
            let (_, diagram) = self.made((lang, notation))?;
            if diagram.is_empty() {
                return Err(self.refused(0, RangeFault::Scene(whole::no_curve().into())));
            }
            Ok(Picture::of(curves::figure(&first.scene, &diagram, &look.style, lang)))
        })
    }
}

fn no_scene() -> Refusal {
    Refusal::of(Diagnostic::error("too-few", both!("no scene is given")))
}

/// Reads the allowed pressure angles.
fn allowed(alpha: Option<&str>, back: Option<&str>) -> Result<Option<AllowedPressure>, Refusal> {
    alpha.map(|rise| cams::allowed(rise, back)).transpose().map_err(|w| Refusal::values(vec![w]))
}

/// Applies `take` to the only cam of a scene, or the one with a number from 1.
fn with_cam<T>(
    problem: &Problem,
    number: Option<usize>,
    allowed: Option<AllowedPressure>,
    take: impl FnOnce(&Scene, &SurveyedCam) -> T,
) -> Result<T, Refusal> {
    let scene = problem.scene()?;
    let all = cams::survey(&scene, number, allowed).map_err(|f| problem.refused(f))?;
    let [one] = all.as_slice() else {
        let message = both!("the scene has {} cams", all.len());
        let help = both!("say which: number=1");
        return Err(Diagnostic::error("which-cam", message).help(help).into());
    };
    Ok(take(&scene, one))
}

/// Returns the report of a cam over a whole turn, with the least cams for allowed pressure angles.
///
/// # Errors
/// Faults of the scene and of the angles.
#[pyfunction]
#[pyo3(signature = (problem, number, alpha, alpha_back))]
pub fn cam(
    py: Python,
    problem: &Problem,
    number: Option<usize>,
    alpha: Option<&str>,
    alpha_back: Option<&str>,
) -> PyResult<NamedReport> {
    run(py, || {
        with_cam(problem, number, allowed(alpha, alpha_back)?, |scene, cam| {
            let notes = all_notes(problem, cam.report.faults());
            (cam.json().to_string(), cam.text(Lang::En), cam.text(Lang::Zh), notes, spoken(scene))
        })
    })
}

/// Draws the figures of a cam; each comes with the word for its file.
///
/// # Errors
/// As [`cam`].
#[pyfunction]
#[pyo3(signature = (problem, number, alpha, alpha_back, look_of))]
pub fn cam_figures(
    py: Python,
    problem: &Problem,
    number: Option<usize>,
    alpha: Option<&str>,
    alpha_back: Option<&str>,
    look_of: Named,
) -> PyResult<Vec<(String, Picture)>> {
    run(py, || {
        let look = look(look_of, SHEET_DIGITS)?;
        with_cam(problem, number, allowed(alpha, alpha_back)?, |scene, cam| {
            let (lang, _) = look.marked(scene);
            let all = cam.figures(&look.style, lang).into_iter();
            all.map(|(word, figure)| (word.to_owned(), Picture::of(figure))).collect()
        })
    })
}

/// Returns the profile of a cam in a number of steps of a turn, as a drawing (DXF) or as CSV.
///
/// # Errors
/// As [`cam`].
#[pyfunction]
#[pyo3(signature = (problem, number, steps, drawing))]
pub fn cam_profile(
    py: Python,
    problem: &Problem,
    number: Option<usize>,
    steps: usize,
    drawing: bool,
) -> PyResult<Vec<u8>> {
    run(py, || {
        with_cam(problem, number, None, |_, cam| match drawing {
            true => cam.profile_dxf(steps).into_bytes(),
            false => cam.profile_csv(steps),
        })
    })
}

/// Returns numbers of teeth for a ratio.
///
/// # Errors
/// Values that cannot be read or are out of bounds.
#[pyfunction]
#[pyo3(signature = (ratio, within, teeth, distance, modules, shifts, helix, stages, taper, count))]
#[expect(clippy::too_many_arguments, reason = "each is an argument in Python")]
pub fn teeth(
    py: Python,
    ratio: &str,
    within: &str,
    teeth: &str,
    distance: Option<&str>,
    modules: Vec<f64>,
    shifts: &str,
    helix: &str,
    stages: Option<usize>,
    taper: f64,
    count: usize,
) -> PyResult<NamedReport> {
    let modules = &modules;
    let wanted = TeethRequest {
        ratio,
        within,
        teeth,
        distance,
        modules,
        shifts,
        helix,
        stages,
        taper,
        count,
    };
    run(py, || {
        let found = TeethList::of(&wanted).map_err(|w| Refusal::values(vec![w]))?;
        let [en, zh] = [Lang::En, Lang::Zh].map(|lang| found.text(lang));
        let notes = crate::fault::notes(&[], "", "");
        Ok((found.json().to_string(), en, zh, notes, Lang::En.name()))
    })
}
