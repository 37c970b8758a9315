//! Every kind of file through one call: a scene, a design task, motions without a mechanism.
//!
//! [`read`] makes a [`Problem`] of a file's text, [`solve()`] answers it, and the methods of [`Solved`] write what is made of the answers: text, JSON,
//! figures, worksheets, lessons. The program, a page and bindings call these and nothing else; none of them asks what kind of file it is, except by
//! [`Kind::grants`].
//!
//! A new kind of file is one file here that implements [`Answered`], its variant of [`Problem`] and [`Kind`], and its row in [`Kind::grants`].

mod motion;
mod scene;
mod task;
pub mod templates;
mod wish;

use crate::answer::Value;
use crate::diag::{Diagnostic, Faults, Warned};
use crate::figure::list::{Entry, Extras, Pages, USUAL};
use crate::figure::sheet;
use crate::notation::Notation;
use crate::paper::style::Style;
use crate::particle;
use crate::report::statement;
use crate::scene::{Lang, Scene, Swept};
use crate::synthesis;
use crate::worked::{Worked, instant};
use crate::worksheet::{Document, Sides};
use serde_json::{Value as Json, json};

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
    Motion(Box<particle::Problem>),
}

/// The part of a scene that has to be given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Extent {
    /// Everything on which its questions depend.
    #[default]
    Motion,
    /// The pose: a rate that is not told is zero, and where no driver is named the first link that can be driven is.
    Pose,
}

/// Reads a file of any kind: JSON in UTF-8.
///
/// A scene at a joint of two pieces of a cam's profile goes on with the piece that follows; a note tells both accelerations.
///
/// # Errors
/// All faults of the file, each with its place as byte offsets into `source`.
pub fn read(source: impl AsRef<[u8]>) -> Result<Warned<Problem>, Faults> {
    read_as(source, Extent::Motion)
}

/// Reads a file of any kind; of a scene as much as is wanted.
///
/// # Errors
/// As [`read`].
pub fn read_as(source: impl AsRef<[u8]>, extent: Extent) -> Result<Warned<Problem>, Faults> {
    let source = source.as_ref();
    read_kind(source, Kind::of(source), extent)
}

/// Reads a file that is to be of a kind.
///
/// # Errors
/// As [`read`]; of another kind of file what it lacks.
pub fn read_of(source: impl AsRef<[u8]>, kind: Kind) -> Result<Warned<Problem>, Faults> {
    read_kind(source.as_ref(), kind, Extent::Motion)
}

fn read_kind(source: &[u8], kind: Kind, extent: Extent) -> Result<Warned<Problem>, Faults> {
    match kind {
        Kind::Task => Ok(synthesis::read(source)?.map(|task| Problem::Task(Box::new(task)))),
        Kind::Motion => Ok(particle::read(source)?.map(|problem| Problem::Motion(Box::new(problem)))),
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
                Extent::Pose => Warned { value: Problem::Scene(Box::new(value)), notes: Vec::new() },
            };
            notes.extend(read.notes);
            Ok(Warned { value: read.value, notes })
        }
    }
}

impl Problem {
    /// The problem of a scene that was built, not read; at a joint of two pieces of a cam's profile it goes on with the piece that follows.
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
        }
    }

    /// The scene.
    ///
    /// # Errors
    /// `not-a-scene` for other kinds of file.
    pub fn into_scene(self) -> Result<Scene, Diagnostic> {
        match self {
            Problem::Scene(scene) => Ok(*scene),
            Problem::Task(_) | Problem::Motion(_) => Err(wish::no_mechanism(self.kind())),
        }
    }
}

/// Results that are wanted beside the answers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// Positions of all links, for figures and documents.
    pub figures: bool,
    /// Tolerances of drawing by hand.
    pub drafting: bool,
    /// Pencil error (mm); that of the scene, or the usual one, if `None`.
    pub pencil_mm: Option<f64>,
    /// A cam leads its follower over the whole turn, not only at the instant.
    pub whole_motion: bool,
    /// The candidate that is meant, counted from 0 in the order of the table.
    pub candidate: usize,
}

impl Options {
    /// For figures and documents.
    pub fn with_figures() -> Options {
        Options { figures: true, ..Options::default() }
    }
}

/// The version of the document that [`Solved::json`] makes; keys are only added within one.
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
/// The faults of the first stage that has any; `no-candidate` for a candidate that is not there.
pub fn solve(problem: &Problem, options: &Options) -> Result<Solved, Faults> {
    match problem {
        Problem::Scene(given) => scene::solve(given, options),
        Problem::Task(task) => task::solve(task, options),
        Problem::Motion(given) => motion::solve(given),
    }
}

/// A problem with its answers.
#[derive(Debug)]
pub struct Solved {
    /// Remarks of all stages.
    pub notes: Vec<Diagnostic>,
    answered: Box<dyn Answered>,
}

/// Language, marks, digits and style of what is written.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// The language; that of the file, or English, if `None`.
    pub lang: Option<Lang>,
    /// Marks; those of the file, or of the language, if `None`.
    pub notation: Option<Notation>,
    /// Weights, colours and fonts of figures.
    pub style: Style,
    /// Significant digits.
    pub digits: usize,
}

impl Default for Look {
    fn default() -> Look {
        Look { lang: None, notation: None, style: Style::default(), digits: crate::report::answers::DIGITS }
    }
}

impl Look {
    /// Language and marks for a file that may name its own.
    pub fn of(&self, language: Option<Lang>, notation: Option<&str>) -> (Lang, Notation) {
        let lang = self.lang.or(language).unwrap_or_default();
        let named = || notation.and_then(Notation::named);
        (lang, self.notation.clone().or_else(named).unwrap_or_else(|| Notation::of_language(lang)))
    }

    fn sheet(&self, lang: Lang, notation: &Notation) -> sheet::Options {
        sheet::Options { lang, notation: self.style.marks.over(notation), digits: self.digits, style: self.style.clone() }
    }
}

/// Figures that are asked for.
#[derive(Clone, Debug)]
pub struct Pictures<'a> {
    /// The figures by name; those of a scene only.
    pub figures: &'a [&'static Entry],
    /// Vectors, dimensions, positions and paths drawn with the mechanism.
    pub extras: Extras,
    /// A picture for each step of the construction instead.
    pub steps: bool,
    /// Width of a page (mm).
    pub width_mm: Option<f64>,
}

impl Default for Pictures<'_> {
    fn default() -> Self {
        Pictures { figures: &[USUAL], extras: Extras::default(), steps: false, width_mm: None }
    }
}

/// The lesson that is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lesson {
    /// Positions through a full turn, or through the travel of a slider.
    pub positions: usize,
    /// The driver that moves; of motions without a mechanism, `Driver(k)` is the k-th motion.
    pub swept: Swept,
    /// A fragment for slides instead of a page.
    pub reveal: bool,
    /// Width of a fragment (mm).
    pub width_mm: Option<f64>,
}

impl Default for Lesson {
    fn default() -> Lesson {
        Lesson { positions: crate::lesson::POSITIONS, swept: Swept::Driver(0), reveal: false, width_mm: None }
    }
}

/// JSON Schema of a kind of file.
pub fn schema(kind: Kind) -> &'static str {
    match kind {
        Kind::Scene => crate::scene::schema::schema(),
        Kind::Task => synthesis::schema::schema(),
        Kind::Motion => particle::schema::schema(),
    }
}

/// The outcome of a problem as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Verdict {
    /// Every question is answered, and drawing and analysis agree.
    Answered,
    /// Drawing and analysis disagree, which is an error of ours.
    Disagree,
    /// Some questions have no answer.
    Unanswered,
}

/// The answer to one question.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// The question, as the file writes it.
    pub find: String,
    /// The SI unit.
    pub unit: &'static str,
    /// The value (SI); `None` where the question has none.
    pub value: Option<Value>,
    /// Certified digits: text of the value in the unit of the file, with sense or direction.
    pub text: String,
    /// The value read off the paper (SI), where it was drawn.
    pub drawn: Option<Value>,
    /// Relative difference between drawing and analysis.
    pub difference: Option<f64>,
}

impl Solved {
    /// The answers to the questions of the file, in their order; of a design task there are none.
    pub fn answers(&self, look: &Look) -> Vec<Answer> {
        self.answered.answers(look)
    }

    /// The answer to a question, such as `v_B`.
    pub fn answer(&self, find: &str, look: &Look) -> Option<Answer> {
        self.answers(look).into_iter().find(|a| a.find == find)
    }

    /// The answers as text for people; with `steps` the construction too.
    pub fn text(&self, look: &Look, steps: bool) -> String {
        self.answered.text(look, steps)
    }

    /// The answers for programs, in SI, with remarks of reading and solving; of a design task with `steps` the construction too.
    ///
    /// One document for all kinds of file, `hodograph/solved/1`; `hodograph schema --solved` describes it.
    pub fn json(&self, look: &Look, steps: bool, notes: &[Diagnostic]) -> Json {
        let mut all = json!({"schema": SCHEMA, "kind": self.answered.kind().word()});
        if let (Json::Object(all), Json::Object(told)) = (&mut all, self.answered.json(look, steps, notes)) {
            all.extend(told);
        }
        all
    }

    /// Figures, each with the word that its file is named after.
    ///
    /// # Errors
    /// `no-figure` where the questions call for no such figure; those of the drawings.
    pub fn figures(&self, pictures: &Pictures, look: &Look) -> Result<Warned<Pages>, Faults> {
        self.answered.figures(pictures, look)
    }

    /// Problem and solution as a document; with a `mistake` a wrong solution is the problem, the first that can be made if it has no name.
    ///
    /// # Errors
    /// `attempt` for a mistake that cannot be made; those of the drawings.
    pub fn worksheet(&self, sides: Sides, mistake: Option<&str>, look: &Look) -> Result<Document, Faults> {
        self.answered.worksheet(sides, mistake, look)
    }

    /// A page with the construction step by step.
    ///
    /// # Errors
    /// Something to be moved that the file does not have; those of the drawings.
    pub fn lesson(&self, lesson: &Lesson, look: &Look) -> Result<Warned<String>, Faults> {
        self.answered.lesson(lesson, look)
    }

    /// The outcome as a whole: exit codes tell it.
    pub fn verdict(&self) -> Verdict {
        self.answered.verdict()
    }

    /// The scene with all stages of its solution, where the file is one.
    pub fn mechanism(&self) -> Option<(&Scene, &Worked)> {
        self.answered.mechanism()
    }

    /// The candidates of a design task.
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
    fn worksheet(&self, sides: Sides, mistake: Option<&str>, look: &Look) -> Result<Document, Faults>;
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
