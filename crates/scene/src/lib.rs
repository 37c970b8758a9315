//! The scene file that a person writes: raw mirror, validation, units, expressions, templates.
//!
//! Bytes → JSON tree with places (`json`) → `RawScene` (`decode`) → [`Scene`] (`resolve`). A
//! [`Scene`] leaves nothing for a later stage to interpret, and no stage depends on the rules of a
//! later one.

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// clippy.toml lists the functions of f64 whose last bit the platform decides; tests may use them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The module maps name private modules too; `cargo doc --document-private-items` follows those
// links.
#![allow(rustdoc::private_intra_doc_links)]

pub mod book;
pub mod build;
pub mod cams;
mod decode;
mod driver;
mod driver_at;
pub mod edit;
pub mod eval;
pub mod exact;
pub mod expr;
pub mod folded;
pub mod front;
mod keys;
mod law;
pub mod loads;
mod mistake;
pub mod model;
mod names;
mod page;
mod parameters;
pub mod quantity;
mod raw;
pub mod readings;
mod resolve;
pub mod rolling;
pub mod schema;
mod source;
pub mod statement;
mod swept;
pub mod templates;
#[cfg(test)]
mod tests;
pub mod units;
mod values;
mod words;
mod write;
mod written;

pub use book::Book;
pub use driver::{Position, PositionSlot};
pub use driver_at::{driver_position, with_driver_at};
pub use hodograph_base::diagram::DiagramKind;
pub use hodograph_base::kind::{ByKind, Kind};
pub use hodograph_base::lang::Lang;
pub use model::*;
pub use page::{PageFormat, SHEET_BORDER_MM, page, width};
pub use quantity::{Asked, Axis};
pub use rolling::{
    Contours, Flanks, Normal, Relation, Rolling, RollingId, RollingKind, Sizes, Touch,
};
pub use source::Source;
pub use swept::Swept;
pub use write::write;
pub use written::QuantityText;

use hodograph_base::diag::{Diagnostic, Faults, Severity, Span, Warned, both};
use hodograph_base::json;
use raw::RequiredData;

// Compiled again when its Chinese texts change.
const _: &str = include_str!("../po/zh.po");

/// Reads the pencil error in the form of `"paper": {"pencil": ...}`, such as `0.1 mm`; returns mm.
///
/// # Errors
/// Text that is not a length, is not greater than zero or exceeds 5 mm; places count in `text`.
///
/// ```
/// assert_eq!(hodograph_scene::pencil("1/4 * 1 mm").unwrap(), 0.25);
/// assert!(hodograph_scene::pencil("1 deg").is_err());
/// ```
pub fn pencil(text: &str) -> Result<f64, Faults> {
    let mut faults = Faults::default();
    let quantity =
        raw::RawQuantity { text: text.to_owned(), span: Span::new(0, text.len()), bare: true };
    let read = resolve::pencil(&quantity, text, &mut faults);
    read.filter(|_| !faults.has_errors()).ok_or(faults)
}

/// Returns true if the text begins as a question does: `v_`, `omega_`.
pub fn begins_a_question(text: &str) -> bool {
    resolve::begins_a_question(text)
}

/// Reads a scene file: JSON in UTF-8, in the format that `docs/scene.md` describes.
///
/// # Errors
/// All faults of the file in one list, each with its place as byte offsets into `source`; the list
/// includes warnings.
///
/// ```
/// let scene = hodograph_scene::read(r#"{
///   "links": {"1": ["A", "B"], "2": ["A"]}, "ground": "2", "lengths": {"AB": "100 mm"},
///   "driver": {"link": "1", "angle": "30 deg", "omega": "10 rad/s"}, "find": ["v_B"] }"#).unwrap().value;
/// assert_eq!(scene.lengths[0].value.value, 0.1);
/// ```
pub fn read(source: impl AsRef<[u8]>) -> Result<Warned<Scene>, Faults> {
    read_with(source.as_ref(), None)
}

/// First place in the questions of [`read_asking`]; smaller places are in the file, which is never
/// that long.
const ASKED: usize = usize::MAX / 2;

/// Reads a scene file with other questions than its own, such as `v_E, a_E`.
///
/// # Errors
/// As [`read`]. [`place_in_asked`] separates places in the questions from places in the file, in
/// these faults and in those of later stages.
///
/// ```
/// use hodograph_base::diag::Span;
/// use hodograph_scene as scene;
/// let text = scene::templates::get("crank-rocker").unwrap();
/// assert_eq!(scene::read_asking(text, "a_C, x_C").unwrap().value.find.len(), 2);
/// let faults = scene::read_asking(text, "a_C, x_Q").unwrap_err();
/// assert_eq!(faults.list[0].span.and_then(scene::place_in_asked), Some(Span::new(5, 8)));
/// ```
pub fn read_asking(source: impl AsRef<[u8]>, questions: &str) -> Result<Warned<Scene>, Faults> {
    read_with(source.as_ref(), Some(questions))
}

/// Returns the place within the questions of [`read_asking`], or `None` for a place in the file.
pub fn place_in_asked(span: Span) -> Option<Span> {
    Some(Span::new(span.start.checked_sub(ASKED)?, span.end.checked_sub(ASKED)?))
}

/// Returns the language that a scene names, if its JSON can be read that far; faults are reported
/// in this language.
pub fn language_of(source: &[u8]) -> Option<Lang> {
    let (_, root) = json::parse(source, &mut Faults::default()).ok()?;
    decode::language_of(&root)
}

/// Reads the links and pairs for a mobility count: a driver, its rate, the direction of a guide
/// or any length may be missing.
///
/// # Errors
/// As [`read`].
///
/// ```
/// let text = r#"{"links": {"1": ["A", "D"], "2": ["A", "B"], "3": ["B", "C"], "4": ["C", "D"]}, "ground": "1"}"#;
/// assert!(hodograph_scene::read_topology(text).unwrap().value.drivers.is_empty());
/// assert!(hodograph_scene::read(text).is_err());
/// ```
pub fn read_topology(source: impl AsRef<[u8]>) -> Result<Warned<Scene>, Faults> {
    read_as(source.as_ref(), None, RequiredData::Pairs)
}

/// Reads a mechanism in its pose: drivers and their rates may be missing. A missing rate counts as
/// one unit ([`Driver::rate_told`]).
///
/// # Errors
/// As [`read`].
///
/// ```
/// let text = r#"{"links": {"1": ["A", "D"], "2": ["A", "B"], "3": ["B", "C"], "4": ["C", "D"]}, "ground": "1",
///     "points": {"A": [0, 0], "B": ["30 mm", "40 mm"], "C": ["120 mm", "60 mm"], "D": ["100 mm", 0]}, "driver": {"link": "2"}}"#;
/// assert!(!hodograph_scene::read_pose(text).unwrap().value.drivers[0].rate_told);
/// assert!(hodograph_scene::read(text).is_err());
/// ```
pub fn read_pose(source: impl AsRef<[u8]>) -> Result<Warned<Scene>, Faults> {
    read_as(source.as_ref(), None, RequiredData::Pose)
}

/// Reads a scene for quantities that do not depend on rates. Missing rates are zero; without a
/// driver, the first link that can be driven is the driver.
///
/// # Errors
/// As [`read`].
///
/// ```
/// let text = r#"{"links": {"1": ["A", "D"], "2": ["A", "B"], "3": ["B", "C"], "4": ["C", "D"]}, "ground": "1",
///     "points": {"A": [0, 0], "B": ["30 mm", "40 mm"], "C": ["120 mm", "60 mm"], "D": ["100 mm", 0]}}"#;
/// assert_eq!(hodograph_scene::read_at_rest(text).unwrap().value.drivers[0].rate.value, 0.0);
/// ```
pub fn read_at_rest(source: impl AsRef<[u8]>) -> Result<Warned<Scene>, Faults> {
    read_as(source.as_ref(), None, RequiredData::Rest)
}

/// Reads a scene without a rate or without a driver. The missing rate is one unit where no question
/// depends on it, and a note says so.
///
/// # Errors
/// As [`read`]; a missing rate is a fault if a question depends on it.
///
/// ```
/// let text = r#"{"links": {"1": ["A", "D"], "2": ["A", "B"], "3": ["B", "C"], "4": ["C", "D"]}, "ground": "1",
///     "points": {"A": [0, 0], "B": ["30 mm", "40 mm"], "C": ["110 mm", "60 mm"], "D": ["100 mm", 0]}, "find": ["P_13", "i_24"]}"#;
/// assert!(!hodograph_scene::read_at_any_rate(text).unwrap().value.drivers[0].rate_told);
/// ```
pub fn read_at_any_rate(source: impl AsRef<[u8]>) -> Result<Warned<Scene>, Faults> {
    let told = read_as(source.as_ref(), None, RequiredData::Motion);
    let Err(faults) = told else { return told };
    // Friction depends on the senses of the velocities.
    let asks_no_rate = |f: &Find| {
        matches!(f.what.kind(), Kind::Length | Kind::Angle | Kind::Time | Kind::Number)
            && !matches!(f.what, Asked::Force(_))
    };
    let free = read_as(source.as_ref(), None, RequiredData::AnyRate)
        .ok()
        .filter(|read| read.value.find.iter().all(asks_no_rate));
    let mut read = free.ok_or(faults)?;
    let message =
        both!("no rate is given, and nothing asked depends on it: one unit of it is taken");
    read.notes.push(Diagnostic::note("free-rate", message));
    Ok(read)
}

fn read_with(source: &[u8], questions: Option<&str>) -> Result<Warned<Scene>, Faults> {
    read_as(source, questions, RequiredData::Motion)
}

fn read_as(
    source: &[u8],
    questions: Option<&str>,
    extent: RequiredData,
) -> Result<Warned<Scene>, Faults> {
    let mut faults = Faults::default();
    let (text, root) = json::parse(source, &mut faults)?;
    let raw = decode::scene(&root, extent, &mut faults).map(|raw| match questions {
        Some(questions) => raw::RawScene { find: Some(asked(questions, &mut faults)), ..raw },
        None => raw,
    });
    let scene = raw.and_then(|raw| resolve::resolve(&raw, text, &mut faults));
    match scene {
        Some(value) if !faults.has_errors() => Ok(Warned { value, notes: faults.list }),
        _ => {
            // Errors come first; within each severity the order is that of the file.
            faults
                .list
                .sort_by_key(|d| (d.severity != Severity::Error, d.span.map_or(0, |s| s.start)));
            Err(faults)
        }
    }
}

/// Splits a list of questions at its commas, with their places. A part that does not begin as a
/// question does (`v_`, `omega_`) belongs to the question before it.
fn asked(questions: &str, faults: &mut Faults) -> Vec<json::Word> {
    let mut words = Vec::new();
    let mut start = ASKED;
    for part in questions.split(',') {
        let from = start + part.len() - part.trim_start().len();
        let word = json::Word {
            text: part.trim().to_owned(),
            span: Span::new(from, from + part.trim().len()),
        };
        faults.list.extend(json::unprintable(&word));
        match words.last_mut() {
            _ if word.text.is_empty() => {}
            // A comma may also separate the names of points.
            Some(last) if !begins_a_question(&word.text) => {
                let last: &mut json::Word = last;
                last.text = format!("{},{}", last.text, word.text);
                last.span.end = word.span.end;
            }
            _ => words.push(word),
        }
        start += part.len() + 1;
    }
    words
}
