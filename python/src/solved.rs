//! Files that have been read, and their solutions.

use crate::fault::{Refusal, notes};
use crate::look::{Named, look, unknown};
use crate::picture::{Picture, Sheet};
use crate::table::{Table, TableParts};
use crate::work::{run, watched};
use hodograph::answer::AnswerValue;
use hodograph::diag::{Diagnostic, Faults, Warned, both};
use hodograph::exchange::{self, ExportFormat, ImportFormat};
use hodograph::figure::frame::FramePage;
use hodograph::figure::list::{self, Extras, FigureEntry};
use hodograph::figure::results::DIGITS as SHEET_DIGITS;
use hodograph::figure::stepped::{ConstructionMethod, METHODS};
use hodograph::problem::batch::{self, BatchRequest};
use hodograph::problem::range::{self, SweptRange};
use hodograph::problem::turn::turn_table;
use hodograph::problem::{
    self, Additions, Extent, Kind, Lesson, Look, Options, Pictures, Verdict, Wish, whole,
    whole_page,
};
use hodograph::report::answers::DIGITS;
use hodograph::scene::{self, Scene, Swept, edit};
use hodograph::sweep::batch::{Block, ParameterChoice};
use hodograph::worksheet::{WorksheetSides, WorksheetTask};
use pyo3::prelude::*;
use serde_json::json;
use std::sync::atomic::Ordering;

/// A template: name, kind, both titles, parameters with their values.
type NamedTemplate = (String, &'static str, (String, String), Vec<(String, String)>);

/// Returns all templates.
#[pyfunction]
pub fn templates() -> Vec<NamedTemplate> {
    let one = |t: problem::templates::Template| {
        (t.name.to_owned(), t.kind.word(), (t.title.en, t.title.zh), t.parameters)
    };
    problem::templates::all().into_iter().map(one).collect()
}

/// Returns the text of a template.
///
/// # Errors
/// A template that does not exist.
#[pyfunction]
pub fn template(py: Python, name: &str) -> PyResult<String> {
    problem::templates::text(name, &[]).map_err(|f| Refusal::of(f).raised(py))
}

/// Returns a text with other values of its parameters.
///
/// # Errors
/// Unknown parameters; values that cannot be read.
#[pyfunction]
pub fn with_values(py: Python, text: &str, values: Vec<(String, String)>) -> PyResult<String> {
    let values: Vec<(&str, &str)> = values.iter().map(|(n, v)| (&**n, &**v)).collect();
    edit::with_parameters(text, &values).map_err(|f| Refusal::in_text(f, "set", "").raised(py))
}

/// Returns a text with the scene file that a design task names in its place; `read` returns the
/// bytes of a file.
///
/// # Errors
/// The errors of `read`.
#[pyfunction]
pub fn included(py: Python, source: Vec<u8>, read: &Bound<PyAny>) -> PyResult<Vec<u8>> {
    let mut thrown = None;
    let made = problem::included(source, |name| {
        let bytes = read.call1((name,)).and_then(|bytes| bytes.extract::<Vec<u8>>());
        bytes.map_err(|e| {
            thrown = Some(e);
            Diagnostic::error("cannot-read", both!("{name} cannot be read"))
        })
    });
    made.map_err(|faults| thrown.unwrap_or_else(|| Refusal::of(faults).raised(py)))
}

/// Returns the JSON Schema of a kind of file: `scene`, `task`, `motion` or `equation`.
#[pyfunction]
pub fn schema(kind: &str) -> Option<&'static str> {
    [Kind::Scene, Kind::Task, Kind::Motion, Kind::Equation]
        .into_iter()
        .find(|k| k.word() == kind)
        .map(problem::schema)
}

/// Returns the figures that can be requested: names, and contents in both languages.
#[pyfunction]
pub fn figures() -> Vec<(&'static str, &'static str, &'static str)> {
    list::LIST.iter().map(|e| (e.name, e.about[0], e.about[1])).collect()
}

/// Returns the kind of a text, judged by its keys: `scene`, `task`, `motion` or `equation`.
#[pyfunction]
pub fn kind_of(text: &str) -> &'static str {
    Kind::of(text.as_bytes()).word()
}

/// A file that has been read.
#[pyclass(frozen, module = "hodograph._native")]
pub struct Problem {
    name: String,
    source: String,
    extent: Extent,
    notes: Vec<Diagnostic>,
    problem: problem::Problem,
}

impl Problem {
    /// Returns the refusal for faults of the text.
    pub fn refused(&self, faults: impl Into<Faults>) -> Refusal {
        Refusal::in_text(faults, &self.name, &self.source)
    }

    fn granted(&self, wishes: &[(bool, Wish)]) -> Result<(), Refusal> {
        let kind = self.problem.kind();
        let mut asked = wishes.iter().filter(|(asked, _)| *asked);
        Ok(asked.try_for_each(|(_, wish)| kind.grants(*wish))?)
    }

    /// The problem, as its figures and documents need it.
    pub fn given(&self) -> &problem::Problem {
        &self.problem
    }

    /// Returns name and text.
    pub fn text(&self) -> (&str, &str) {
        (&self.name, &self.source)
    }

    /// Returns the remarks of reading.
    pub fn remarks(&self) -> &[Diagnostic] {
        &self.notes
    }

    /// Returns the scene.
    ///
    /// # Errors
    /// A file of another kind.
    pub fn scene(&self) -> Result<Scene, Refusal> {
        self.granted(&[(true, Wish::Mechanism)])?;
        self.problem.clone().into_scene().map_err(|d| self.refused(d))
    }

    /// Returns the scene with these questions, its own if none are given; with the notes.
    fn asking(&self, find: Option<&str>) -> Result<Warned<Scene>, Refusal> {
        self.granted(&[(true, Wish::Mechanism)])?;
        match find {
            Some(find) => scene::read_asking(&self.source, find)
                .map_err(|f| Refusal::asked(f, self.text(), Some(find))),
            None => Ok(Warned { value: self.scene()?, notes: Vec::new() }),
        }
    }
}

#[pymethods]
impl Problem {
    /// Reads a text; of a scene only the pose if it is `still`.
    #[new]
    #[pyo3(signature = (source, name="", still=false))]
    fn new(py: Python, source: String, name: &str, still: bool) -> PyResult<Problem> {
        let extent = if still { Extent::Pose } else { Extent::Motion };
        let Warned { value: problem, notes } = run(py, || {
            problem::read_as(&source, extent).map_err(|f| Refusal::in_text(f, name, &source))
        })?;
        Ok(Problem { name: name.to_owned(), source, extent, notes, problem })
    }

    /// The text.
    #[getter]
    fn source(&self) -> &str {
        &self.source
    }

    /// The kind: `scene`, `task`, `motion` or `equation`.
    #[getter]
    fn kind(&self) -> &'static str {
        self.problem.kind().word()
    }

    /// Names and texts of the parameters of a scene.
    #[getter]
    fn parameters(&self) -> Vec<(String, String)> {
        let Ok(scene) = self.problem.clone().into_scene() else { return Vec::new() };
        scene.parameters.into_iter().map(|(name, given)| (name, given.text)).collect()
    }

    /// Remarks of reading, as JSON.
    #[getter]
    fn notes(&self) -> String {
        notes(&self.notes, &self.name, &self.source)
    }

    /// Solves the problem.
    #[pyo3(signature = (figures=false, whole_motion=false, candidate=0, drafting=None))]
    fn solve(
        slf: Py<Self>,
        py: Python,
        figures: bool,
        whole_motion: bool,
        candidate: usize,
        drafting: Option<&str>,
    ) -> PyResult<Solved> {
        let of = slf.get();
        let solved = run(py, || {
            of.granted(&[(drafting.is_some(), Wish::Drafting), (candidate > 0, Wish::Candidate)])?;
            let pencil_mm = match drafting.filter(|text| !text.is_empty()) {
                Some(text) => {
                    Some(scene::pencil(text).map_err(|f| Refusal::in_text(f, "drafting", text))?)
                }
                None => None,
            };
            let drafting = drafting.is_some();
            let options = Options { figures, drafting, pencil_mm, whole_motion, candidate };
            problem::solve(&of.problem, &options).map_err(|f| of.refused(f))
        })?;
        Ok(Solved { problem: slf, solved })
    }

    /// Returns the table of a range: the answers for each value, in SI.
    #[pyo3(signature = (over, from_, to, steps, find, tell))]
    #[expect(clippy::too_many_arguments, reason = "each is an argument in Python")]
    fn sweep(
        &self,
        py: Python,
        over: Option<&str>,
        from_: Option<&str>,
        to: Option<&str>,
        steps: Option<usize>,
        find: Option<&str>,
        tell: Option<&Bound<PyAny>>,
    ) -> PyResult<Table> {
        let parts = watched(py, tell, |progress| {
            let Warned { value: scene, mut notes } = self.asking(find)?;
            let Warned { value: scene, notes: more } = whole::over_a_table(scene);
            notes.extend(more);
            let swept = SweptRange { over, from: from_, to, steps };
            let stop = || progress.stop.load(Ordering::Relaxed);
            let made = range::rows(&scene, &swept, |pieces| {
                let (count, step) = (pieces.count(), pieces.at_once());
                progress.all.store(count as u64, Ordering::Relaxed);
                let columns = pieces.columns();
                let mut values = vec![Vec::with_capacity(count); columns.len()];
                let mut piece = Vec::new();
                for from in (0..count).step_by(step) {
                    let to = count.min(from + step);
                    // Without a piece the work is stopped, and the rows are of no use.
                    piece = match pieces.piece(from..to, piece, &stop) {
                        Some(piece) => piece,
                        None => break,
                    };
                    values
                        .iter_mut()
                        .zip(&piece)
                        .for_each(|(all, part)| all.extend_from_slice(part));
                    progress.done.store(to as u64, Ordering::Relaxed);
                }
                notes.extend(pieces.notes());
                (columns, values)
            });
            let (columns, values) = made.map_err(|f| Refusal::range(f, self.text(), find))?;
            let book = range::book_units(&scene, &columns);
            let title = (scene.title.en, scene.title.zh);
            Ok(TableParts { title, heads: columns, book, values, notes })
        })?;
        Table::of(py, parts)
    }

    /// Returns the table of many mechanisms, whose parameters vary: each of `vary` is
    /// `NAME=FROM..TO:N`, or `NAME=FROM..TO` for the bounds of a random one. Of all mechanisms only
    /// those of `among`, from the first to before the second.
    #[pyo3(signature = (vary, random, seed, over, from_, to, steps, find, among, tell))]
    #[expect(clippy::too_many_arguments, reason = "each is an argument in Python")]
    fn batch(
        &self,
        py: Python,
        vary: Vec<String>,
        random: Option<u64>,
        seed: u64,
        over: Option<&str>,
        from_: Option<&str>,
        to: Option<&str>,
        steps: Option<usize>,
        find: Option<&str>,
        among: Option<(u64, u64)>,
        tell: Option<&Bound<PyAny>>,
    ) -> PyResult<Table> {
        let parts = watched(py, tell, |progress| {
            let Warned { value: scene, mut notes } = self.asking(find)?;
            let choice = random
                .map_or(ParameterChoice::Grid, |count| ParameterChoice::Random { count, seed });
            let range = SweptRange { over, from: from_, to, steps };
            let request = BatchRequest { vary: &vary, choice, range };
            let made = batch::planned(&scene, &request, |batch| {
                let (all, step) = (batch.mechanisms(), batch::block(batch));
                let (first, all) = among.map_or((0, all), |(first, last)| (first, last.min(all)));
                progress.all.store(all.saturating_sub(first), Ordering::Relaxed);
                let stop = || progress.stop.load(Ordering::Relaxed);
                let heads = batch.columns();
                let mut values = vec![Vec::new(); heads.len()];
                let (mut block, mut missing, mut from) = (Block::default(), 0, first);
                while from < all {
                    let to = all.min(from + step);
                    let Some(made) = batch.block_unless(from, to, block, &stop) else { break };
                    values.iter_mut().zip(&made.columns).for_each(|(all, part)| all.extend(part));
                    missing += made.missing;
                    (block, from) = (made, to);
                    progress.done.store(to - first, Ordering::Relaxed);
                }
                (heads, values, missing)
            });
            let (heads, values, missing) =
                made.map_err(|f| Refusal::range(f, self.text(), find))?;
            notes.extend(batch::notes(missing));
            let book = range::book_units(&scene, &heads);
            let title = (scene.title.en.clone(), scene.title.zh.clone());
            Ok(TableParts { title, heads, book, values, notes })
        })?;
        Table::of(py, parts)
    }

    /// Draws displacements, velocities and accelerations over the whole motion.
    fn curves(&self, py: Python, look_of: Named) -> PyResult<Vec<(String, Picture)>> {
        let pages = run(py, || {
            self.granted(&[(true, Wish::Mechanism)])?;
            let look = look(look_of, SHEET_DIGITS)?;
            whole::curves(self.source.as_bytes(), &look, false).map_err(|f| self.refused(f))
        })?;
        Ok(pages.value.into_iter().map(|(name, figure)| (name, Picture::of(figure))).collect())
    }
}

/// A problem with its answers.
#[pyclass(frozen, module = "hodograph._native")]
pub struct Solved {
    problem: Py<Problem>,
    solved: problem::Solved,
}

impl Solved {
    fn of(&self) -> &Problem {
        self.problem.get()
    }

    fn notes(&self) -> Vec<Diagnostic> {
        self.of().notes.iter().chain(&self.solved.notes).cloned().collect()
    }
}

#[pymethods]
impl Solved {
    /// The outcome: `answered`, `disagree` or `unanswered`.
    #[getter]
    fn verdict(&self) -> &'static str {
        match self.solved.verdict() {
            Verdict::Disagree => "disagree",
            Verdict::Unanswered => "unanswered",
            _ => "answered",
        }
    }

    /// Remarks of reading and solving, as JSON.
    #[getter(notes)]
    fn told(&self) -> String {
        notes(&self.notes(), &self.of().name, &self.of().source)
    }

    /// Returns the document that `hodograph solve --json` prints.
    #[pyo3(signature = (look_of, steps=false))]
    fn json(&self, py: Python, look_of: Named, steps: bool) -> PyResult<String> {
        run(py, || {
            let look = look(look_of, DIGITS)?;
            Ok(self.solved.json(&look, steps, &self.notes()).to_string())
        })
    }

    /// Returns the answers as JSON: question, symbol, unit, sense, value, text.
    fn answers(&self, py: Python, look_of: Named) -> PyResult<String> {
        run(py, || {
            let look = look(look_of, DIGITS)?;
            let parts = |value: &AnswerValue| match value {
                AnswerValue::Scalar(value) => json!(value),
                AnswerValue::Vector(v) => json!([v.x, v.y]),
                AnswerValue::Point(p) => json!([p.x, p.y]),
            };
            let one = |a: problem::Answer| {
                json!({
                    "find": a.find, "symbol": a.symbol, "unit": a.unit, "turns": a.turns,
                    "value": a.value.as_ref().map(parts), "text": a.text,
                    "drawn": a.drawn.as_ref().map(parts), "difference": a.difference,
                })
            };
            let all: Vec<_> = self.solved.answers(&look).into_iter().map(one).collect();
            Ok(json!(all).to_string())
        })
    }

    /// Returns the answers as text for people.
    #[pyo3(signature = (look_of, steps=false))]
    fn text(&self, py: Python, look_of: Named, steps: bool) -> PyResult<String> {
        run(py, || Ok(self.solved.text(&look(look_of, DIGITS)?, steps)))
    }

    /// Draws figures; each comes with the word for its file.
    #[pyo3(signature = (names, look_of, steps, width, page, vectors, dimensions, poses, path))]
    #[expect(clippy::too_many_arguments, reason = "each is an argument in Python")]
    fn figures(
        &self,
        py: Python,
        names: Vec<String>,
        look_of: Named,
        steps: bool,
        width: Option<&str>,
        page: Option<&str>,
        vectors: Option<&str>,
        dimensions: bool,
        poses: usize,
        path: Vec<String>,
    ) -> PyResult<Vec<(String, Picture)>> {
        let pages = run(py, || {
            let wishes = [
                (steps, Wish::Pictures),
                (poses > 0, Wish::Poses),
                (!path.is_empty(), Wish::Paths),
            ];
            self.of().granted(&wishes)?;
            let look = look(look_of, SHEET_DIGITS)?;
            let entries: Vec<&'static FigureEntry> =
                names.iter().map(|name| named(name)).collect::<Result<_, _>>()?;
            let page = match page {
                Some(text) => {
                    Some(scene::page(text).map_err(|f| Refusal::in_text(f, "page", text))?)
                }
                None => width_of(width)?.map(scene::PageFormat::column),
            };
            let wanted = Additions { vectors, dimensions, poses, path: &path };
            let extras = match self.solved.mechanism() {
                Some((scene, worked)) if !steps => {
                    problem::extras(scene, worked, &wanted).map_err(Refusal::values)?
                }
                Some(_) | None => Extras::default(),
            };
            let pictures = Pictures { figures: &entries, extras, steps, page };
            self.solved.figures(&pictures, &look).map_err(|f| self.of().refused(f))
        })?;
        Ok(pages.value.into_iter().map(|(name, figure)| (name, Picture::of(figure))).collect())
    }

    /// Returns problem and solution as a document; `sides`: `problem`, `solution` or `both`. With
    /// `table`, the results over the whole motion in so many steps are added.
    #[pyo3(signature = (sides, mistake, loops, questions, table, look_of))]
    #[expect(clippy::too_many_arguments, reason = "each is an argument in Python")]
    fn worksheet(
        &self,
        py: Python,
        sides: &str,
        mistake: Option<&str>,
        loops: bool,
        questions: bool,
        table: Option<usize>,
        look_of: Named,
    ) -> PyResult<Sheet> {
        run(py, || {
            let wishes = [
                (mistake.is_some(), Wish::Mistake),
                (loops, Wish::Loops),
                (questions, Wish::Questions),
                (table.is_some(), Wish::Table),
            ];
            self.of().granted(&wishes)?;
            let task = match mistake {
                Some(name) => WorksheetTask::Mistake(name),
                None if loops => WorksheetTask::Loops,
                None if questions => WorksheetTask::Questions,
                None => WorksheetTask::Polygons,
            };
            let sides = match sides {
                "problem" => WorksheetSides::Problem,
                "solution" => WorksheetSides::Solution,
                _ => WorksheetSides::Both,
            };
            let look = look(look_of, SHEET_DIGITS)?;
            let refused = |f| self.of().refused(f);
            let mut made = self.solved.worksheet(sides, task, &look).map_err(refused)?;
            if let Some(steps) = table {
                let table = turn_table(self.of().source.as_bytes(), steps, &look);
                made.blocks.extend(table.map_err(refused)?.value);
            }
            Ok(Sheet::of(made))
        })
    }

    /// Draws the sheet to draw on and its overlay, each with a page for each picture.
    #[pyo3(signature = (page, look_of))]
    fn frame(
        &self,
        py: Python,
        page: &str,
        look_of: Named,
    ) -> PyResult<(Vec<Picture>, Vec<Picture>)> {
        run(py, || {
            let look = look(look_of, SHEET_DIGITS)?;
            let page = whole_page(page).map_err(|w| Refusal::values(vec![w]))?;
            let pages = self.solved.frame(&page, &look).map_err(|f| self.of().refused(f))?;
            let both = |p: FramePage| (Picture::of(p.blank), Picture::of(p.overlay));
            Ok(pages.into_iter().map(both).unzip())
        })
    }

    /// Returns the file of another program in a format; of DXF and TikZ one figure.
    #[pyo3(signature = (format, name, look_of))]
    fn export(&self, py: Python, format: &str, name: &str, look_of: Named) -> PyResult<Vec<u8>> {
        run(py, || {
            let format = ExportFormat::named(format)
                .ok_or_else(|| unknown("format", both!("format"), format, &names_of_formats()))?;
            let look = look(look_of, Look::default().digits)?;
            let made = exchange::export(&self.solved, format, named(name)?, &look);
            Ok(made.map_err(|f| Refusal::range(f, self.of().text(), None))?.value)
        })
    }

    /// Writes a page with the construction step by step.
    #[pyo3(signature = (over, positions, reveal, width, method_name, look_of))]
    #[expect(clippy::too_many_arguments, reason = "each is an argument in Python")]
    fn lesson(
        &self,
        py: Python,
        over: Option<&str>,
        positions: Option<usize>,
        reveal: bool,
        width: Option<&str>,
        method_name: Option<&str>,
        look_of: Named,
    ) -> PyResult<String> {
        run(py, || {
            self.of().granted(&[(reveal, Wish::Reveal), (method_name.is_some(), Wish::Method)])?;
            let known = METHODS.map(|e| e.name);
            let method = |name| {
                ConstructionMethod::named(name)
                    .ok_or_else(|| unknown("method", both!("method"), name, &known))
            };
            let method = method_name.map(method).transpose()?;
            let swept = match self.solved.mechanism() {
                Some((scene, _)) => {
                    range::swept_of(scene, over).map_err(|w| Refusal::values(vec![w]))?
                }
                None => Swept::Driver(0),
            };
            let positions = positions.unwrap_or(Lesson::default().positions);
            let wanted = Lesson { positions, swept, reveal, width_mm: width_of(width)?, method };
            let look = look(look_of, Look::default().digits)?;
            let page = self.solved.lesson(&wanted, &look).map_err(|f| self.of().refused(f))?;
            Ok(page.value)
        })
    }

    /// The texts of the scenes of a design task's candidates.
    #[getter]
    fn candidates(&self) -> Vec<String> {
        let design = self.solved.design();
        design.map_or_else(Vec::new, |d| d.candidates.iter().map(|c| c.scene_text()).collect())
    }

    /// The names of the scene's points, drivers and links; empty without a mechanism.
    #[getter]
    fn names(&self) -> (Vec<String>, Vec<String>, Vec<String>) {
        let Some((scene, _)) = self.solved.mechanism() else { return Default::default() };
        (
            scene.points.iter().map(|p| p.name.clone()).collect(),
            (0..scene.drivers.len()).map(|d| scene.driver_name(d).0).collect(),
            scene.links.iter().map(|l| l.name.clone()).collect(),
        )
    }

    /// The places (m) of the scene's points; `None` for a point without one.
    #[getter]
    fn places(&self) -> Vec<Option<(f64, f64)>> {
        let Some((_, worked)) = self.solved.mechanism() else { return Vec::new() };
        worked.configuration.points.iter().map(|p| p.map(|p| (p.x, p.y))).collect()
    }

    /// True if the file was read for its pose only.
    #[getter]
    fn still(&self) -> bool {
        self.of().extent == Extent::Pose
    }
}

/// Returns the formats of other programs: each name with the endings of its files.
#[pyfunction]
pub fn export_formats() -> Vec<(&'static str, Vec<&'static str>)> {
    ExportFormat::ALL.into_iter().map(|f| (f.name(), f.endings().to_vec())).collect()
}

fn names_of_formats() -> Vec<&'static str> {
    ExportFormat::ALL.into_iter().map(ExportFormat::name).collect()
}

/// Returns the text of the scene of another program's linkage, and remarks as JSON. Without a
/// `format`, the ending of the file's name or else its text decides.
#[pyfunction]
#[pyo3(signature = (text, name, ending, format))]
pub fn import_linkage(
    py: Python,
    text: &str,
    name: &str,
    ending: Option<&str>,
    format: Option<&str>,
) -> PyResult<(String, String)> {
    run(py, || {
        let known = ImportFormat::ALL.map(ImportFormat::name);
        let format = match format {
            Some(name) => ImportFormat::named(name)
                .ok_or_else(|| unknown("format", both!("format"), name, &known))?,
            None => ImportFormat::of(ending, text),
        };
        let made = exchange::import(text, format).map_err(|f| Refusal::in_text(f, name, text))?;
        Ok((made.text, notes(&made.notes, name, "")))
    })
}

/// Returns the width (mm) that a text gives.
fn width_of(width: Option<&str>) -> Result<Option<f64>, Refusal> {
    let read = |text| scene::width(text).map_err(|f| Refusal::in_text(f, "width", text));
    width.map(read).transpose()
}

/// Returns a figure by its name.
pub fn named(name: &str) -> Result<&'static FigureEntry, Refusal> {
    list::named(name).ok_or_else(|| {
        let names: Vec<&str> = list::LIST.iter().map(|e| e.name).collect();
        let message = both!("there is no figure `{name}`");
        let help = both!("there are {}", hodograph::diag::Both::names(&names));
        Diagnostic::error("no-figure", message).help(help).into()
    })
}
