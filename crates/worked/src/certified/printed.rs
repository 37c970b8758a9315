//! The numbers of an answer, and the ones to print: if the scene asks for a unit of the book, the
//! number in this unit, certified there and rounded once.

use super::ladder::{Certified, CertifiedNumber, MissingDigits};
use hodograph_base::number::decimal::Certain;
use hodograph_mechanism::answer::AnswerValue;
use hodograph_scene::{Asked, Book};

/// The kinds of numbers of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnswerPart {
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

impl AnswerPart {
    /// Returns the key for programs.
    pub fn key(self) -> &'static str {
        match self {
            AnswerPart::Magnitude => "magnitude",
            AnswerPart::Direction => "angle_deg",
            AnswerPart::X => "x",
            AnswerPart::Y => "y",
            AnswerPart::Scalar => "value",
            AnswerPart::Degrees => "value_deg",
            AnswerPart::Printed => "in_unit",
            AnswerPart::PrintedX => "in_unit_x",
            AnswerPart::PrintedY => "in_unit_y",
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
    value: AnswerValue<N>,
    mut list: Vec<(AnswerPart, CertifiedNumber)>,
) -> Result<Vec<(AnswerPart, CertifiedNumber)>, MissingDigits> {
    let Some(unit) = book.chosen(what.kind()) else { return Ok(list) };
    let mut add = |si: N, part: AnswerPart, printed: AnswerPart| {
        let zero = list.iter().any(|(p, n)| *p == part && n.zero);
        let number = CertifiedNumber::new(unit.of(si).enclosure().ok_or(MissingDigits::TooClose)?);
        list.push((printed, number.or_zero(zero)));
        Ok(())
    };
    match value {
        AnswerValue::Vector(v) => add(v.norm(), AnswerPart::Magnitude, AnswerPart::Printed)?,
        AnswerValue::Scalar(s) => add(s, AnswerPart::Scalar, AnswerPart::Printed)?,
        AnswerValue::Point(p) => {
            add(p.x, AnswerPart::X, AnswerPart::PrintedX)?;
            add(p.y, AnswerPart::Y, AnswerPart::PrintedY)?;
        }
    }
    Ok(list)
}

impl Certified {
    /// Returns true if a number of the answer is printed: a vector by magnitude and direction, a
    /// place by its coordinates, an angle in degrees, and all in the unit that the scene asks for.
    pub fn prints(&self, part: AnswerPart) -> bool {
        let has = |part| self.part(part).is_some();
        match part {
            AnswerPart::X | AnswerPart::Y => {
                !has(AnswerPart::Magnitude) && !has(AnswerPart::PrintedX)
            }
            AnswerPart::Scalar => !has(AnswerPart::Degrees) && !has(AnswerPart::Printed),
            AnswerPart::Magnitude | AnswerPart::Degrees => !has(AnswerPart::Printed),
            AnswerPart::Direction
            | AnswerPart::Printed
            | AnswerPart::PrintedX
            | AnswerPart::PrintedY => true,
        }
    }
}
