//! Homework: variants of one problem for a class, their keys, the marking of answers, and exports
//! to learning platforms.
//!
//! [`variants()`] draws values of the parameters from grids of round numbers until it has enough
//! poses that a student can draw: not near a singular one, every reading well above the tolerance of
//! the pencil, answers unlike those of the other variants. Each variant is the text of the scene
//! with these values, read and solved anew. [`sheets`] sets all problems, or all solutions, with the
//! worksheet's writer; [`keys`] writes and reads the table of answers; [`mark()`] compares the
//! answers of a class with it. The values of typical wrong solutions ([`crate::attempts`]) are part
//! of the keys, so that a mark names the likely mistake. [`platforms`] writes the questions for
//! Moodle, QTI, Canvas and PrairieLearn; [`files()`] returns all files of a set.
//!
//! The bytes of all results depend on the scene, the request and the look alone.

mod choose;
mod csv;
mod grid;
pub mod keys;
mod mark;
pub mod platforms;
mod set;
pub mod sheets;

use crate::diag::{Both, Diagnostic, both};
use crate::problem::Solved;
use crate::problem::range::WrongValue;
use crate::scene::{Kind, Mistake};

pub use choose::variants;
pub use csv::names;
pub use mark::{MarkFaults, MarkList, MarkedAnswer, mark};
pub use set::{HomeworkAdditions, files};

/// Largest number of variants: each keeps its solution.
pub const MOST_VARIANTS: usize = 200;

/// The number of variants without names.
const USUAL: usize = 30;

/// Returns the number of variants: that which is `given`, else one for each student, else 30, or one
/// if nothing `varies`.
///
/// # Errors
/// `roster` for fewer variants than students, or more than [`MOST_VARIANTS`].
pub fn count(given: Option<usize>, students: usize, varies: bool) -> Result<usize, WrongValue> {
    let usual = match (students, varies) {
        (0, false) => 1,
        (0, true) => USUAL,
        (n, _) => n,
    };
    let count = given.unwrap_or(usual);
    if (students.max(1)..=MOST_VARIANTS).contains(&count) {
        return Ok(count);
    }
    let message =
        both!("{count} variants for {} names; there can be {} variants", students, MOST_VARIANTS);
    Err(WrongValue::new("count", &count.to_string(), Diagnostic::error("roster", message)))
}

/// A request for variants.
#[derive(Clone, Copy, Debug)]
pub struct HomeworkRequest<'a> {
    /// The parameters, each `NAME=FROM..TO/STEP` or `NAME=FROM..TO:N`; bare numbers have the
    /// scene's unit.
    pub vary: &'a [String],
    /// The number of variants.
    pub count: usize,
    /// The seed of the choice.
    pub seed: u64,
    /// The names of students, for the first variants in order.
    pub students: &'a [String],
}

/// A variant with its solution and its key.
#[derive(Debug)]
pub struct HomeworkVariant {
    /// Its number, from 1.
    pub number: usize,
    /// The student who gets it.
    pub student: Option<String>,
    /// The varied parameters with their values as written in the scene.
    pub values: Vec<(String, String)>,
    /// The text of its scene.
    pub text: String,
    /// Its solution.
    pub solved: Solved,
    /// The key, one entry for each number that is asked for.
    pub key: Vec<KeyEntry>,
}

/// A question of a variant with its answer, in the printed unit.
#[derive(Clone, Debug, PartialEq)]
pub struct KeyEntry {
    /// The question as the scene writes it; of a place, `.x` or `.y` is added.
    pub question: String,
    /// The kind of quantity.
    pub kind: Kind,
    /// The unit in ASCII: `m/s^2`.
    pub unit: String,
    /// The value: of a vector the magnitude; of a rotation positive counter-clockwise.
    pub value: f64,
    /// The tolerance of the pencil, in the unit.
    pub tolerance: f64,
    /// The values of typical wrong solutions that differ from the answer by more than the
    /// tolerance.
    pub mistakes: Vec<TypicalError>,
}

/// The value of a typical wrong solution.
#[derive(Clone, Debug, PartialEq)]
pub struct TypicalError {
    /// The mistake.
    pub mistake: Mistake,
    /// The point at which it is made, or the link.
    pub place: ErrorPlace,
    /// The value, in the unit of the key.
    pub value: f64,
}

/// The place of a mistake.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ErrorPlace {
    /// A point.
    Point(String),
    /// A link.
    Link(String),
}

impl TypicalError {
    /// Returns the mistake in words: `Coriolis acceleration left out, at A`.
    pub fn words(&self) -> Both {
        use crate::scene::Lang;
        let mistake = Both::from([Lang::En, Lang::Zh].map(|lang| self.mistake.title(lang)));
        match &self.place {
            ErrorPlace::Point(p) => {
                both!("{}, at {}", mistake, p)
            }
            ErrorPlace::Link(l) => {
                both!("{}, of link {}", mistake, l)
            }
        }
    }
}
