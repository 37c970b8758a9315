//! Every kind of file through one call: a scene, a design task, motions without a mechanism, a
//! vector equation.
//!
//! [`read`] makes a [`Problem`] from a file's text, [`solve()`] solves it, and the methods of
//! [`Solved`] write the answers as text, JSON, figures, worksheets and lessons. The program, a page
//! and bindings call only these. No caller depends on the kind of file, except through
//! [`Kind::grants`].
//!
//! A [`Live`] figure is drawn again for each position while its drivers are dragged.
//!
//! A new kind of file needs one file here that implements [`Answered`], a variant of [`Problem`]
//! and [`Kind`], and a row in [`Kind::grants`].

pub mod batch;
pub mod cams;
pub mod compare;
pub mod cycle;
mod equation;
pub mod listed;
mod live;
mod motion;
mod pictures;
pub mod range;
mod scene;
mod task;
pub mod teeth;
pub mod templates;
pub mod turn;
pub mod whole;
mod wish;

use crate::answer::AnswerValue;
use crate::diag::{Diagnostic, Faults, Warned};
use crate::equation as vectors;
use crate::figure::frame::{FramePage, working_frame};
use crate::figure::list::{Extras, FigureEntry, FigureInput, Pages, USUAL};
use crate::figure::sheet;
use crate::figure::stepped::ConstructionMethod;
use crate::notation::Notation;
use crate::paper::style::Style;
use crate::particle;
use crate::report::statement;
use crate::scene::{Lang, PageFormat, Scene, Swept};
use crate::synthesis;
use crate::worked::{Worked, instant};
use crate::worksheet::{Document, WorksheetSides, WorksheetTask};
use serde_json::{Value as Json, json};

pub use equation::equation_plan;
pub use live::{Live, PageDelta};
pub use pictures::{Additions, extras, points_named, whole_page};
pub use scene::whole_motion;
pub use task::included;
pub use wish::{Kind, Wish};

/// A file that has been read.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Problem {
    /// A mechanism at an instant.
    Scene(Box<Scene>),
    /// A task of design.
    Task(Box<synthesis::Task>),
    /// Motions of points without a mechanism.
    Motion(Box<particle::ParticleProblem>),
    /// A vector equation on its own.
    Equation(Box<vectors::VectorEquation>),
}

/// The part of a scene that must be given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Extent {
    /// All data on which the questions depend.
    #[default]
    Motion,
    /// The pose: a missing rate counts as zero; where no driver is named, it is the first link that
    /// can be driven.
    Pose,
}

/// Reads a file of any kind: JSON in UTF-8.
///
/// At a joint of two pieces of a cam's profile, the scene uses the piece that follows; a note gives
/// both accelerations.
///
/// # Errors
/// All faults of the file, each with its place as byte offsets into `source`.
pub fn read(source: impl AsRef<[u8]>) -> Result<Warned<Problem>, Faults> {
    read_as(source, Extent::Motion)
}

/// Reads a file of any kind; of a scene only the given extent.
///
/// # Errors
/// As [`read`].
pub fn read_as(source: impl AsRef<[u8]>, extent: Extent) -> Result<Warned<Problem>, Faults> {
    let source = source.as_ref();
    read_kind(source, Kind::of(source), extent)
}

/// Reads a file that must be of a given kind.
///
/// # Errors
/// As [`read`]; a fault for another kind of file.
pub fn read_of(source: impl AsRef<[u8]>, kind: Kind) -> Result<Warned<Problem>, Faults> {
    read_kind(source.as_ref(), kind, Extent::Motion)
}

fn read_kind(source: &[u8], kind: Kind, extent: Extent) -> Result<Warned<Problem>, Faults> {
    match kind {
        Kind::Task => Ok(synthesis::read(source)?.map(|task| Problem::Task(Box::new(task)))),
        Kind::Motion => {
            Ok(particle::read(source)?.map(|problem| Problem::Motion(Box::new(problem))))
        }
        Kind::Equation => {
            Ok(vectors::read(source)?.map(|problem| Problem::Equation(Box::new(problem))))
        }
        Kind::Scene => {
            let Warned { value, mut notes } = match extent {
                Extent::Motion => crate::scene::read_at_any_rate(source),
                Extent::Pose => crate::scene::read_at_rest(source),
            }?;
            let faults = statement::faults(&value);
            if faults.has_errors() {
                return Err(faults);
            }
            let read = match extent {
                Extent::Motion => Problem::of_scene(value),
                Extent::Pose => {
                    Warned { value: Problem::Scene(Box::new(value)), notes: Vec::new() }
                }
            };
            notes.extend(read.notes);
            Ok(Warned { value: read.value, notes })
        }
    }
}

impl Problem {
    /// Returns the problem of a scene that was built, not read. At a joint of two pieces of a cam's
    /// profile, it uses the piece that follows.
    ///
    /// ```
    /// use hodograph::{problem::{Look, Options, Problem, solve}, scene::build::*};
    /// let scene = Builder::new()
    ///     .link("1", ["A", "B"]).link("2", ["B", "C"]).link("3", ["C", "D"]).link("4", ["A", "D"]).ground("4")
    ///     .length("AB", mm(100.0)).length("BC", mm(250.0)).length("CD", mm(200.0)).length("AD", mm(300.0))
    ///     .driver(Driver::turning("1").angle(deg(60.0)).omega(rad_per_s(10.0))).find(["v_C"]).build()?.value;
    /// let solved = solve(&Problem::of_scene(scene).value, &Options::default())?;
    /// assert!(solved.answer("v_C", &Look::default()).unwrap().difference.unwrap() < 1e-12);
    /// # Ok::<(), hodograph::diag::Faults>(())
    /// ```
    pub fn of_scene(scene: Scene) -> Warned<Problem> {
        instant(scene).map(|scene| Problem::Scene(Box::new(scene)))
    }

    /// The kind of the file.
    pub fn kind(&self) -> Kind {
        match self {
            Problem::Scene(_) => Kind::Scene,
            Problem::Task(_) => Kind::Task,
            Problem::Motion(_) => Kind::Motion,
            Problem::Equation(_) => Kind::Equation,
        }
    }

    /// Returns the scene.
    ///
    /// # Errors
    /// `not-a-scene` if the file is of another kind.
    pub fn into_scene(self) -> Result<Scene, Diagnostic> {
        match self {
            Problem::Scene(scene) => Ok(*scene),
            Problem::Task(_) | Problem::Motion(_) | Problem::Equation(_) => {
                Err(wish::no_mechanism(self.kind()))
            }
        }
    }
}

/// Results that are computed in addition to the answers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// Positions of all links, for figures and documents.
    pub figures: bool,
    /// Tolerances of drawing by hand.
    pub drafting: bool,
    /// Pencil error (mm); if `None`, that of the scene or the default.
    pub pencil_mm: Option<f64>,
    /// True if cams guide their followers over the whole turn, not only at the instant.
    pub whole_motion: bool,
    /// Index of the chosen candidate, from 0 in the order of the table.
    pub candidate: usize,
}

impl Options {
    /// Options for figures and documents.
    pub fn with_figures() -> Options {
        Options { figures: true, ..Options::default() }
    }
}

/// The version of the document that [`Solved::json`] makes; within a version, keys are only added.
const SCHEMA: &str = "hodograph/solved/1";

/// Solves a problem.
///
/// ```
/// use hodograph::{problem::{Look, Options, read, solve}, scene::templates};
/// let problem = read(templates::get("crank-rocker").unwrap())?.value;
/// let solved = solve(&problem, &Options::default())?;
/// assert!(solved.text(&Look::default(), false).contains("v_C"));
/// # Ok::<(), hodograph::diag::Faults>(())
/// ```
///
/// # Errors
/// The faults of the first stage that has any; `no-candidate` if the candidate does not exist.
pub fn solve(problem: &Problem, options: &Options) -> Result<Solved, Faults> {
    match problem {
        Problem::Scene(given) => scene::solve(given, options),
        Problem::Task(task) => task::solve(task, options),
        Problem::Motion(given) => motion::solve(given),
        Problem::Equation(given) => equation::solve(given),
    }
}

/// A problem with its answers.
#[derive(Debug)]
pub struct Solved {
    /// Remarks of all stages.
    pub notes: Vec<Diagnostic>,
    answered: Box<dyn Answered>,
}

/// Language, notation, digits and style of the output.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// The language; if `None`, that of the file or English.
    pub lang: Option<Lang>,
    /// The notation; if `None`, that of the file or of the language.
    pub notation: Option<Notation>,
    /// Weights, colours and fonts of figures.
    pub style: Style,
    /// Significant digits.
    pub digits: usize,
}

impl Default for Look {
    fn default() -> Look {
        Look {
            lang: None,
            notation: None,
            style: Style::default(),
            digits: crate::report::answers::DIGITS,
        }
    }
}

impl Look {
    /// Language and notation for a file that may name its own.
    pub fn of(&self, language: Option<Lang>, notation: Option<&str>) -> (Lang, Notation) {
        let lang = self.lang.or(language).unwrap_or_default();
        let named = || notation.and_then(Notation::named);
        (lang, self.notation.clone().or_else(named).unwrap_or_else(|| Notation::of_language(lang)))
    }

    /// Language and notation of the figures of a scene: those of [`Look::of`] with the marks of the
    /// style.
    pub fn marked(&self, scene: &Scene) -> (Lang, Notation) {
        let (lang, notation) = self.of(scene.language, scene.notation.as_deref());
        (lang, self.style.marks.over(&notation))
    }

    /// Returns the options of the sheet of a scene.
    pub(crate) fn sheet_of(&self, scene: &Scene) -> sheet::SheetOptions {
        let (lang, notation) = self.marked(scene);
        sheet::SheetOptions { lang, notation, digits: self.digits, style: self.style.clone() }
    }
}

/// The requested figures.
#[derive(Clone, Debug)]
pub struct Pictures<'a> {
    /// The figures by name, for scenes only.
    pub figures: &'a [&'static FigureEntry],
    /// Vectors, dimensions, positions and paths drawn with the mechanism.
    pub extras: Extras,
    /// True for one picture per step of the construction instead.
    pub steps: bool,
    /// The format of the pages; `None` for pages as large as their content.
    pub page: Option<PageFormat>,
}

impl Default for Pictures<'_> {
    fn default() -> Self {
        Pictures { figures: &[USUAL], extras: Extras::default(), steps: false, page: None }
    }
}

/// The requested lesson.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lesson {
    /// Positions through a full turn, or through the travel of a slider.
    pub positions: usize,
    /// The driver that moves; for motions without a mechanism, `Driver(k)` is the k-th motion.
    pub swept: Swept,
    /// True for a fragment for slides instead of a page.
    pub reveal: bool,
    /// Width of a fragment (mm).
    pub width_mm: Option<f64>,
    /// The method whose construction is shown, for scenes only; `None` for that of the questions.
    pub method: Option<ConstructionMethod>,
}

impl Default for Lesson {
    fn default() -> Lesson {
        Lesson {
            positions: crate::lesson::POSITIONS,
            swept: Swept::Driver(0),
            reveal: false,
            width_mm: None,
            method: None,
        }
    }
}

/// Returns the JSON Schema of a kind of file.
pub fn schema(kind: Kind) -> &'static str {
    match kind {
        Kind::Scene => crate::scene::schema::schema(),
        Kind::Task => synthesis::schema::schema(),
        Kind::Motion => particle::schema::schema(),
        Kind::Equation => vectors::schema::schema(),
    }
}

/// The outcome of a problem as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Verdict {
    /// Every question is answered, and drawing and analysis agree.
    Answered,
    /// Drawing and analysis disagree, which is an error of this program.
    Disagree,
    /// Some questions have no answer.
    Unanswered,
}

/// The answer to one question.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// The question as the file writes it.
    pub find: String,
    /// Symbol of the quantity in the label language, such as `a^{c}_{A3A2}`.
    pub symbol: String,
    /// The SI unit.
    pub unit: &'static str,
    /// True if the sign of the value is a sense of rotation, positive counter-clockwise.
    pub turns: bool,
    /// The value (SI); `None` if the question has no answer.
    pub value: Option<AnswerValue>,
    /// Text of the value with its certified digits, in the unit of the file, with sense or
    /// direction.
    pub text: String,
    /// The value read off the drawing (SI), if it was drawn.
    pub drawn: Option<AnswerValue>,
    /// Relative difference between drawing and analysis.
    pub difference: Option<f64>,
}

impl Solved {
    /// Returns the answers to the questions of the file, in their order; a design task has none.
    pub fn answers(&self, look: &Look) -> Vec<Answer> {
        self.answered.answers(look)
    }

    /// Returns the answer to a question, such as `v_B`.
    pub fn answer(&self, find: &str, look: &Look) -> Option<Answer> {
        self.answers(look).into_iter().find(|a| a.find == find)
    }

    /// Returns the answers as text for people; with `steps` the construction, too.
    pub fn text(&self, look: &Look, steps: bool) -> String {
        self.answered.text(look, steps)
    }

    /// Returns the answers for programs, in SI, with the remarks of reading and solving; for a
    /// design task with `steps` the construction, too.
    ///
    /// All kinds of file give one document, `hodograph/solved/1`; `hodograph schema --solved`
    /// describes it.
    pub fn json(&self, look: &Look, steps: bool, notes: &[Diagnostic]) -> Json {
        let mut all = json!({"schema": SCHEMA, "kind": self.answered.kind().word()});
        if let (Json::Object(all), Json::Object(told)) =
            (&mut all, self.answered.json(look, steps, notes))
        {
            all.extend(told);
        }
        all
    }

    /// Draws figures; each comes with the word after which its file is named.
    ///
    /// # Errors
    /// `no-figure` if the questions do not call for a figure; those of the drawings.
    pub fn figures(&self, pictures: &Pictures, look: &Look) -> Result<Warned<Pages>, Faults> {
        self.answered.figures(pictures, look)
    }

    /// Returns problem and solution as a document.
    ///
    /// # Errors
    /// `attempt` for a mistake that cannot be made in this scene; `loops` for pairs and poses of which
    /// no loops are written out; those of the drawings.
    pub fn worksheet(
        &self,
        sides: WorksheetSides,
        task: WorksheetTask,
        look: &Look,
    ) -> Result<Document, Faults> {
        self.answered.worksheet(sides, task, look)
    }

    /// Writes a page with the construction step by step.
    ///
    /// # Errors
    /// The file does not have the driver or motion to be moved; those of the drawings.
    pub fn lesson(&self, lesson: &Lesson, look: &Look) -> Result<Warned<String>, Faults> {
        self.answered.lesson(lesson, look)
    }

    /// Returns the overall outcome, which decides the exit code.
    pub fn verdict(&self) -> Verdict {
        self.answered.verdict()
    }

    /// Returns the scene with all stages of its solution, if the file is one.
    pub fn mechanism(&self) -> Option<(&Scene, &Worked)> {
        self.answered.mechanism()
    }

    /// The kind of the file.
    pub fn kind(&self) -> Kind {
        self.answered.kind()
    }

    /// Returns the scene with all stages of its solution.
    ///
    /// # Errors
    /// `not-a-scene` if the file is of another kind.
    pub fn needed_mechanism(&self) -> Result<(&Scene, &Worked), Diagnostic> {
        self.mechanism().ok_or_else(|| wish::no_mechanism(self.kind()))
    }

    /// Draws the sheet to draw on, and its solution to lay over it, on pages of a format.
    ///
    /// # Errors
    /// `not-a-scene`; those of [`working_frame`].
    pub fn frame(&self, page: &PageFormat, look: &Look) -> Result<Vec<FramePage>, Faults> {
        let (scene, worked) = self.needed_mechanism()?;
        let (options, extras) = (look.sheet_of(scene), Extras::default());
        working_frame(&FigureInput { scene, worked, options: &options, extras: &extras }, page)
    }

    /// Returns the candidates of a design task.
    pub fn design(&self) -> Option<&synthesis::Design> {
        self.answered.design()
    }
}

/// Writers of one kind of problem.
trait Answered: std::fmt::Debug + Send + Sync {
    fn answers(&self, look: &Look) -> Vec<Answer>;
    fn text(&self, look: &Look, steps: bool) -> String;
    fn kind(&self) -> Kind;
    fn json(&self, look: &Look, steps: bool, notes: &[Diagnostic]) -> Json;
    fn figures(&self, pictures: &Pictures, look: &Look) -> Result<Warned<Pages>, Faults>;
    fn worksheet(
        &self,
        sides: WorksheetSides,
        task: WorksheetTask,
        look: &Look,
    ) -> Result<Document, Faults>;
    fn lesson(&self, lesson: &Lesson, look: &Look) -> Result<Warned<String>, Faults>;

    fn verdict(&self) -> Verdict {
        Verdict::Answered
    }

    fn mechanism(&self) -> Option<(&Scene, &Worked)> {
        None
    }

    fn design(&self) -> Option<&synthesis::Design> {
        None
    }
}
