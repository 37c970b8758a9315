//! The number of an answer that is printed where the scene asks for a unit of the book: certified there, and rounded once.

use super::ladder::{Number, Part, Why};
use crate::answer::Value;
use crate::number::decimal::Certain;
use crate::scene::{Asked, Book};

/// Adds an answer's magnitude, or the answer itself, in its chosen unit; nothing where none is chosen. It is zero where the SI number is.
///
/// # Errors
/// A value that the numbers at hand do not tell.
pub(super) fn with_printed<N: Certain>(
    book: &Book,
    what: &Asked,
    value: Value<N>,
    mut list: Vec<(Part, Number)>,
) -> Result<Vec<(Part, Number)>, Why> {
    let Some(unit) = book.chosen(what.kind()) else { return Ok(list) };
    let (si, part) = match value {
        Value::Vector(v) => (v.norm(), Part::Magnitude),
        Value::Scalar(s) => (s, Part::Scalar),
    };
    let zero = list.iter().any(|(p, n)| *p == part && n.zero);
    let number = Number::new(unit.of(si).enclosure().ok_or(Why::TooClose)?);
    list.push((Part::Printed, number.or_zero(zero)));
    Ok(list)
}
