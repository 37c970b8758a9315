//! The file a person writes: raw mirror, validation, units, expressions, embedded templates.
//!
//! Bytes → JSON tree with places (`json`) → `RawScene` (`decode`) → [`Scene`] (`resolve`). A later stage finds
//! nothing in a [`Scene`] that it would have to interpret; an earlier one knows nothing of the rules of a later one.

mod decode;
pub mod edit;
pub mod eval;
pub mod exact;
pub mod expr;
mod keys;
pub mod model;
mod names;
mod raw;
mod resolve;
pub mod schema;
pub mod templates;
#[cfg(test)]
mod tests;
pub mod units;
mod values;

pub use model::*;

use crate::diag::{Faults, Severity, Span, Warned};
use crate::json;

/// Reads the error of a pencil as `"paper": {"pencil": ...}` would say it, such as `0.1 mm`; in mm.
///
/// # Errors
/// What is no length, not greater than zero, or more than 5 mm; places count in `text`.
///
/// ```
/// assert_eq!(hodograph::scene::pencil("1/4 * 1 mm").unwrap(), 0.25);
/// assert!(hodograph::scene::pencil("1 deg").is_err());
/// ```
pub fn pencil(text: &str) -> Result<f64, Faults> {
    let mut faults = Faults::default();
    let quantity = raw::RawQuantity { text: text.to_owned(), span: Span::new(0, text.len()), bare: true };
    let read = resolve::pencil(&quantity, text, &mut faults);
    read.filter(|_| !faults.has_errors()).ok_or(faults)
}

/// Whether a text begins as a question does: `v_`, `omega_`.
pub fn begins_a_question(text: &str) -> bool {
    resolve::begins_a_question(text)
}

/// Reads a scene file: JSON in UTF-8, in the format that `docs/scene.md` describes.
///
/// # Errors
/// All faults of the file in one list, each with its place as byte offsets into `source`; warnings are among them.
///
/// ```
/// let scene = hodograph::scene::read(r#"{
///   "links": {"1": ["A", "B"], "2": ["A"]}, "ground": "2", "lengths": {"AB": "100 mm"},
///   "driver": {"link": "1", "angle": "30 deg", "omega": "10 rad/s"}, "find": ["v_B"] }"#).unwrap().value;
/// assert_eq!(scene.lengths[0].value.value, 0.1);
/// ```
pub fn read(source: impl AsRef<[u8]>) -> Result<Warned<Scene>, Faults> {
    let mut faults = Faults::default();
    let (text, root) = json::parse(source.as_ref(), &mut faults)?;
    let scene = decode::scene(&root, &mut faults).and_then(|raw| resolve::resolve(&raw, text, &mut faults));
    match scene {
        Some(value) if !faults.has_errors() => Ok(Warned { value, notes: faults.list }),
        _ => {
            // Errors first; within each kind the order of the file, so that the list can be worked down from the top.
            faults.list.sort_by_key(|d| (d.severity != Severity::Error, d.span.map_or(0, |s| s.start)));
            Err(faults)
        }
    }
}
