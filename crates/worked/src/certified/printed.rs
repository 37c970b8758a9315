//! The numbers of an answer, and the ones to print: if the scene asks for a unit of the book, the
//! number in this unit, certified there and rounded once.

use super::ladder::{Certified, Number, Why};
use hodograph_base::number::decimal::Certain;
use hodograph_mechanism::answer::Value;
use hodograph_scene::{Asked, Book};

/// The kinds of numbers of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The length of a vector (SI).
    Magnitude,
    /// The direction of a vector, degrees in (−180, 180].
    Direction,
    /// The component to the right, or the coordinate of a place (SI).
    X,
    /// The upward component, or the coordinate of a place (SI).
    Y,
    /// A scalar in SI units (an angle in radians).
    Scalar,
    /// An angle in degrees.
    Degrees,
    /// The magnitude or the scalar in the unit that the scene asks for.
    Printed,
    /// The coordinate to the right of a place in that unit.
    PrintedX,
    /// The upward coordinate of a place in that unit.
    PrintedY,
}

impl Part {
    /// Returns the key for programs.
    pub fn key(self) -> &'static str {
        match self {
            Part::Magnitude => "magnitude",
            Part::Direction => "angle_deg",
            Part::X => "x",
            Part::Y => "y",
            Part::Scalar => "value",
            Part::Degrees => "value_deg",
            Part::Printed => "in_unit",
            Part::PrintedX => "in_unit_x",
            Part::PrintedY => "in_unit_y",
        }
    }
}

/// Adds an answer's magnitude, its coordinates, or the answer itself, in its chosen unit; adds
/// nothing if none is chosen. The number is zero if the SI number is.
///
/// # Errors
/// A value that the numbers at hand do not determine.
pub fn with_printed<N: Certain>(
    book: &Book,
    what: &Asked,
    value: Value<N>,
    mut list: Vec<(Part, Number)>,
) -> Result<Vec<(Part, Number)>, Why> {
    let Some(unit) = book.chosen(what.kind()) else { return Ok(list) };
    let mut add = |si: N, part: Part, printed: Part| {
        let zero = list.iter().any(|(p, n)| *p == part && n.zero);
        let number = Number::new(unit.of(si).enclosure().ok_or(Why::TooClose)?);
        list.push((printed, number.or_zero(zero)));
        Ok(())
    };
    match value {
        Value::Vector(v) => add(v.norm(), Part::Magnitude, Part::Printed)?,
        Value::Scalar(s) => add(s, Part::Scalar, Part::Printed)?,
        Value::Point(p) => {
            add(p.x, Part::X, Part::PrintedX)?;
            add(p.y, Part::Y, Part::PrintedY)?;
        }
    }
    Ok(list)
}

impl Certified {
    /// Returns true if a number of the answer is printed: a vector by magnitude and direction, a
    /// place by its coordinates, an angle in degrees, and all in the unit that the scene asks for.
    pub fn prints(&self, part: Part) -> bool {
        let has = |part| self.part(part).is_some();
        match part {
            Part::X | Part::Y => !has(Part::Magnitude) && !has(Part::PrintedX),
            Part::Scalar => !has(Part::Degrees) && !has(Part::Printed),
            Part::Magnitude | Part::Degrees => !has(Part::Printed),
            Part::Direction | Part::Printed | Part::PrintedX | Part::PrintedY => true,
        }
    }
}
