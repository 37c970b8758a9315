//! Synthesis: from a file that states the task of a linkage to scenes that fulfil it.
//!
//! A synthesis file has the front of a scene (title, units, parameters, paper) and a kind of task
//! ([`KINDS`], one file for each). [`read`] returns a [`Task`], [`solve`] its [`Design`]: all
//! solutions as [`DesignCandidate`]s, each with a scene that every other command accepts, judged by
//! sweeping that scene ([`judge`]). Numbers come from closed formulas; the construction with ruler
//! and paper is drawn from the same data by its own arithmetic and must agree with them.
//!
//! The motion of a scene is calculated elsewhere ([`hodograph_sweep`],
//! [`hodograph_mechanism::position`]).
//!
//! ```
//! let task = hodograph_synthesis::read(r#"{"synthesis": "time-ratio", "linkage": "crank-rocker", "K": 1.5,
//!     "rocker": "75 mm", "frame": "100 mm", "limit": "45 deg"}"#).unwrap().value;
//! let design = hodograph_synthesis::solve(&task).unwrap();
//! let best = &design.candidates[0];
//! assert!(best.judged.defects.is_empty());
//! assert!((best.judged.time_ratio.unwrap() - 1.5).abs() < 1e-9);
//! assert!(hodograph_scene::read(best.scene_text()).is_ok());
//! ```

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// clippy.toml lists the functions of f64 with platform-dependent last bits; tests may use them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The module lists name private modules too; `cargo doc --document-private-items` follows those
// links.
#![allow(rustdoc::private_intra_doc_links)]

#[doc(hidden)]
pub mod board;
pub mod body;
#[doc(hidden)]
pub mod by_hand;
pub mod candidate;
pub mod cognates;
pub(crate) mod form;
pub(crate) mod fourbar;
pub mod function;
pub mod grashof;
#[doc(hidden)]
pub mod judge;
mod laid;
pub(crate) mod limits;
pub(crate) mod nearest;
mod order;
pub mod path;
mod poly;
pub mod schema;
pub(crate) mod statement;
pub mod straight_line;
pub mod templates;
pub mod time_ratio;

pub use board::SynthesisBoard;
pub use candidate::{Compared, DesignCandidate, DesignNumber, Draft, WantedPosition};
pub use fourbar::{FourBar, Heading};
pub use statement::{Proof, Statement};

use form::TaskForm;
use hodograph_base::diag::{Both, Diagnostic, Faults, Warned, both};
use hodograph_base::json::fields::{Fields, suggest};
use hodograph_base::json::{self, Node, NodeKind};
use hodograph_scene::front::{self, Front, RawFront};
use hodograph_scene::{Book, Lang, Paper};
use std::cell::RefCell;
use std::fmt::Debug;
use std::sync::Arc;

// Compiled again when its Chinese texts change.
const _: &str = include_str!("../po/zh.po");

/// A task of one kind, as read from its file.
pub trait Wish: Debug + Send + Sync {
    /// The title if the file has none.
    fn title(&self) -> Both;

    /// The angular velocity of the driver (rad/s) if the file gives none.
    fn rate(&self) -> f64 {
        USUAL_OMEGA
    }

    /// Returns all designs, in any order, with remarks on the task as a whole.
    ///
    /// # Errors
    /// If there is no solution: the root that is not real, and the nearest feasible task.
    fn solve(&self, heading: &Heading) -> Result<TaskResult, Faults>;

    /// Draws the construction of a design on the board, from the givens; the formula's numbers
    /// serve for comparison only. Results of least squares, an exchange or a search are laid off,
    /// and their deviations are measured. `None` where the drawing does not close.
    fn construct(&self, draft: &Draft, board: &mut SynthesisBoard) -> Option<()>;

    /// The task as a problem: givens and unknowns.
    fn statement(&self) -> Statement;

    /// The closed formula with the numbers of a design.
    fn proof(&self, draft: &Draft) -> Vec<Proof>;
}

/// The result of solving a kind of task.
#[derive(Clone, Debug, Default)]
pub struct TaskResult {
    /// All designs.
    pub drafts: Vec<Draft>,
    /// Numbers of the task as a whole, such as precision points and poles.
    pub numbers: Vec<DesignNumber>,
    /// Remarks on the task as a whole.
    pub notes: Vec<Diagnostic>,
}

/// A kind of task: one file in this crate.
pub struct KindOfTask {
    /// The name, the value of `"synthesis"`.
    pub name: &'static str,
    /// The description in one line, English and Chinese.
    pub what: [&'static str; 2],
    /// The keys, in addition to those of the front and of every task.
    pub keys: &'static [&'static str],
    read: fn(&TaskForm) -> Option<Box<dyn Wish>>,
}

/// All kinds.
pub const KINDS: &[&KindOfTask] = &[
    &function::KIND,
    &time_ratio::KIND,
    &limits::KIND,
    &body::KIND,
    &path::KIND,
    &cognates::KIND,
    &straight_line::KIND,
];

/// The keys common to all tasks.
const COMMON: [&str; 3] = ["synthesis", "omega", "transmission"];

/// A synthesis file as read.
#[derive(Clone, Debug)]
pub struct Task {
    /// The name of the kind of task.
    pub kind: &'static str,
    /// The head and the driver of its scenes.
    pub heading: Heading,
    /// The language, if the file names one.
    pub language: Option<Lang>,
    /// The sheet and the scales.
    pub paper: Paper,
    /// The units of printed quantities.
    pub book: Book,
    /// The least acceptable transmission angle (rad).
    pub transmission: f64,
    wish: Arc<dyn Wish>,
}

impl Task {
    /// The task as a problem: givens and unknowns.
    pub fn statement(&self) -> Statement {
        self.wish.statement().written(&self.book)
    }

    /// The closed formula with the numbers of a design, the proof of its drawing.
    pub fn proof(&self, candidate: &DesignCandidate) -> Vec<Proof> {
        self.wish.proof(&candidate.draft).iter().map(|p| p.written(&self.book)).collect()
    }
}

/// The results of a task.
#[derive(Clone, Debug)]
pub struct Design {
    /// All solutions, the best first. They are ordered by: no defects, a crank that turns fully,
    /// the least error of an approximation, the greatest least transmission angle, the smallest
    /// size.
    pub candidates: Vec<DesignCandidate>,
    /// Numbers of the task as a whole, such as precision points and poles.
    pub numbers: Vec<DesignNumber>,
    /// Remarks on the task as a whole.
    pub notes: Vec<Diagnostic>,
}

/// The angular velocity of the driver if the task gives none (rad/s).
const USUAL_OMEGA: f64 = 10.0;

/// Returns true for a synthesis file.
pub fn is_task(source: &[u8]) -> bool {
    json::parse(source, &mut Faults::default()).is_ok_and(|(_, root)| form::is_task(&root))
}

/// Reads a synthesis file: JSON in UTF-8.
///
/// # Errors
/// All faults of the file in one list, each with its place as byte offsets into `source`.
pub fn read(source: impl AsRef<[u8]>) -> Result<Warned<Task>, Faults> {
    let mut faults = Faults::default();
    let (text, root) = json::parse(source.as_ref(), &mut faults)?;
    let faults = RefCell::new(faults);
    let task = of_kind(&root, text, &faults);
    let mut faults = faults.into_inner();
    match task {
        Some(value) if !faults.has_errors() => Ok(Warned { value, notes: faults.list }),
        _ => {
            faults.list.retain(|d| d.code != "unused-parameter");
            faults.list.sort_by_key(|d| d.span.map_or(0, |s| s.start));
            Err(faults)
        }
    }
}

fn of_kind(root: &Node, text: &str, faults: &RefCell<Faults>) -> Option<Task> {
    let kind = kind_of(root, &mut faults.borrow_mut())?;
    let keys: Vec<&str> = front::KEYS.iter().chain(&COMMON).chain(kind.keys).copied().collect();
    let fields = Fields::open(
        root,
        both!("a synthesis file of this kind"),
        &keys,
        &mut faults.borrow_mut(),
    )?;
    let raw = RawFront::decode(root, &mut faults.borrow_mut());
    let front = Front::new(&raw, text, &mut faults.borrow_mut());
    let form = TaskForm::new(fields, &front, faults);
    let wish = (kind.read)(&form);
    let omega = form.omega("omega");
    let transmission = form.angle("transmission").unwrap_or(judge::USUAL_GAMMA);
    faults.borrow_mut().list.extend(front.unused());
    let wish: Arc<dyn Wish> = wish?.into();
    let omega = omega.unwrap_or_else(|| wish.rate());
    let idle = form.idle(kind.keys);
    faults.borrow_mut().list.extend(idle);
    let title = front
        .title
        .as_ref()
        .map_or_else(|| wish.title(), |t| Both { en: t.en.clone(), zh: t.zh.clone() });
    let language = front.language.map(|l| if l == Lang::Zh { "zh" } else { "en" });
    let heading = Heading { title, language, omega, answers: front.answers() };
    Some(Task {
        kind: kind.name,
        heading,
        language: front.language,
        paper: front.paper,
        book: front.book,
        transmission,
        wish,
    })
}

/// The kind that the file names; reports a missing or unknown name.
fn kind_of(root: &Node, faults: &mut Faults) -> Option<&'static KindOfTask> {
    let NodeKind::Object(members) = &root.kind else {
        faults.push(
            Diagnostic::error("not-a-task", both!("a synthesis file is a JSON object"))
                .at(root.span),
        );
        return None;
    };
    let Some((_, node)) = members.iter().find(|(k, _)| k.text == "synthesis") else {
        let d = Diagnostic::error(
            "not-a-task",
            both!("this is no synthesis file: it has no key `synthesis`"),
        );
        faults.push(d.help(both!("a scene goes to `hodograph solve` or `hodograph draw`")));
        return None;
    };
    let name = json::fields::word(node, "\"synthesis\"", faults)?;
    let found = KINDS.iter().find(|k| k.name == name.text).copied();
    if found.is_none() {
        let d = Diagnostic::error(
            "unknown-kind",
            both!("there is no kind of synthesis `{}`", name.text),
        )
        .at(name.span);
        faults.push(d.help(suggest(
            &name.text,
            KINDS.iter().map(|k| k.name),
            both!("the kinds are"),
        )));
    }
    found
}

/// Solves a task: returns all solutions, judged by their scenes and sorted.
///
/// # Errors
/// If there is no solution: the root that is not real, and the nearest feasible task.
pub fn solve(task: &Task) -> Result<Design, Faults> {
    let TaskResult { drafts, numbers, notes } = task.wish.solve(&task.heading)?;
    let mut candidates = Vec::new();
    for draft in drafts {
        candidates.push(judge::judge(draft, task.transmission)?);
    }
    candidates.sort_by(|a, b| {
        let key = |c: &DesignCandidate| (c.judged.defects.len(), !c.judged.rotates);
        let gamma = |c: &DesignCandidate| c.judged.transmission.map_or(0.0, |t| t.0);
        key(a)
            .cmp(&key(b))
            .then(a.draft.error.total_cmp(&b.draft.error))
            .then(gamma(b).total_cmp(&gamma(a)))
            .then(a.judged.size_m.total_cmp(&b.judged.size_m))
    });
    Ok(Design { candidates, numbers, notes })
}

/// Draws the construction of a candidate with ruler and compasses, to a scale (metres per
/// millimetre of paper); `None` where it does not close on paper.
///
/// # Errors
/// Drawing and formula disagree, which is an error of this program.
pub fn construct(
    task: &Task,
    candidate: &DesignCandidate,
    mu_l: f64,
) -> Result<Option<SynthesisBoard>, Faults> {
    let mut board = SynthesisBoard::new(mu_l);
    let drawn = task.wish.construct(&candidate.draft, &mut board);
    if drawn.is_none() || board.steps.is_empty() {
        return Ok(None);
    }
    for reading in &board.readings {
        let Some(number) = candidate.number(&reading.name) else { continue };
        let off = (board.value(reading) - number.abs()).abs();
        if off
            > AGREEMENT
                * number.abs().max(if reading.angle { 1.0 } else { candidate.judged.size_m })
        {
            let message = both!(
                "{} is {} on the drawing and {} by the formula",
                reading.name,
                board.value(reading),
                number
            );
            return Err(Diagnostic::error("disagreement", message).into());
        }
    }
    Ok(Some(board))
}

/// Greatest relative difference of drawing and formula: both have double precision, and
/// intersections under small angles cost a few digits.
const AGREEMENT: f64 = 1e-7;
