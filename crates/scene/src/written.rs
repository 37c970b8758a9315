//! Given quantities in the form for a reader: in the units of the book, else as the scene writes
//! them.

use super::book::BookUnit;
use super::expr::{self, Expr, ExprKind};
use super::model::{GivenQuantity, Scene};
use hodograph_base::kind::Kind;

/// A given quantity in the form for a reader.
#[derive(Clone, Debug, PartialEq)]
pub enum QuantityText {
    /// A number and a unit, as written.
    AsWritten(String, BookUnit),
    /// A computed value (`2*r`), or one written in another unit: its value in the unit.
    Computed(f64, BookUnit),
    /// No unit can be determined: zero, or a product of other quantities.
    Usual,
}

impl Scene {
    /// Returns the form of a quantity that the scene writes as `text`; `si` is its value in SI
    /// units.
    ///
    /// The unit is that of the book, else that of the text, else that of the first parameter in the
    /// text with a unit of the kind.
    pub fn told(&self, kind: Kind, text: &str, si: f64) -> QuantityText {
        let written = as_written(&self.parameters, kind, text, si);
        match (self.book.chosen(kind), written) {
            (Some(chosen), QuantityText::AsWritten(number, unit)) if unit == *chosen => {
                QuantityText::AsWritten(number, unit)
            }
            (Some(_), QuantityText::Usual) if si == 0.0 => QuantityText::Usual,
            (Some(chosen), _) => QuantityText::Computed(chosen.of(si), chosen.clone()),
            (None, written) => written,
        }
    }
}

/// Returns the form of a quantity in a scene with these parameters, independent of the units of
/// answers.
pub(super) fn as_written(
    parameters: &[(String, GivenQuantity)],
    kind: Kind,
    text: &str,
    si: f64,
) -> QuantityText {
    if let Some((number, unit)) = literal(text, kind) {
        return QuantityText::AsWritten(number, unit);
    }
    unit_in(parameters, text, kind)
        .map_or(QuantityText::Usual, |unit| QuantityText::Computed(unit.of(si), unit))
}

/// Returns the unit of a text that may contain these parameters.
fn unit_in(parameters: &[(String, GivenQuantity)], text: &str, kind: Kind) -> Option<BookUnit> {
    if let Some((_, unit)) = literal(text, kind) {
        return Some(unit);
    }
    let names: Vec<&str> = parameters.iter().map(|p| p.0.as_str()).collect();
    unit_of(parameters, &expr::parse(text, &names).ok()?, kind)
}

fn unit_of(parameters: &[(String, GivenQuantity)], expr: &Expr, kind: Kind) -> Option<BookUnit> {
    match &expr.kind {
        ExprKind::Number(_) | ExprKind::Pi => None,
        ExprKind::Unit(unit) => BookUnit::read(unit.name, kind).ok(),
        ExprKind::Parameter(name) => {
            // A parameter uses the ones before it.
            let at = parameters.iter().rposition(|p| p.0 == *name)?;
            unit_in(&parameters[..at], &parameters[at].1.text, kind)
        }
        ExprKind::Neg(a) | ExprKind::Call(_, a) => unit_of(parameters, a, kind),
        ExprKind::Binary(_, a, b) => {
            unit_of(parameters, a, kind).or_else(|| unit_of(parameters, b, kind))
        }
    }
}

/// Reads a text that is a number and a unit of the kind.
fn literal(text: &str, kind: Kind) -> Option<(String, BookUnit)> {
    let text = text.trim();
    let numeral = |(i, c): &(usize, char)| match c {
        '0'..='9' | '.' => true,
        // A sign is at the beginning or in an exponent, and an e is between digits.
        '-' => *i == 0 || text[..*i].ends_with(['e', 'E']),
        'e' | 'E' => text[i + 1..].starts_with(|c: char| c.is_ascii_digit() || c == '-'),
        _ => false,
    };
    let end = text.char_indices().find(|at| !numeral(at)).map_or(text.len(), |(i, _)| i);
    let (number, unit) = text.split_at(end);
    number.parse::<f64>().ok()?;
    Some((number.to_owned(), BookUnit::read(unit, kind).ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read;

    #[test]
    fn a_given_quantity_keeps_the_unit_in_which_it_is_written() {
        let scene = |answers: &str| {
            let text = format!(
                r#"{{"parameters": {{"r": "4.50 in", "n": "300 rpm", "b": "2*r", "phi": "0.5 rad"}}, {answers} "links": {{"1": ["A", "B"], "2": ["A"]}},
                "ground": "2", "lengths": {{"AB": "b"}}, "driver": {{"link": "1", "angle": "phi", "omega": "n"}}, "find": ["v_B"]}}"#
            );
            read(text).unwrap_or_else(|f| panic!("{f}")).value
        };
        let (plain, book) = (scene(""), scene(r#""answers": {"length": "cm", "omega": "rad/s"},"#));
        let unit = |text: &str, kind| BookUnit::read(text, kind).unwrap();
        let (inch, rpm) = (unit("in", Kind::Length), unit("rpm", Kind::Omega));
        for (kind, text, si, told) in [
            (Kind::Length, "4.50 in", 0.1143, QuantityText::AsWritten("4.50".into(), inch.clone())),
            (Kind::Length, "b + 1 mm", 0.254, QuantityText::Computed(10.0, inch.clone())),
            (Kind::Length, "1e-2 in", 0.000254, QuantityText::AsWritten("1e-2".into(), inch)),
            (Kind::Length, "0", 0.0, QuantityText::Usual),
            (Kind::Omega, "-300 rpm", -31.4, QuantityText::AsWritten("-300".into(), rpm.clone())),
            (Kind::Omega, "n", rpm.size() * 300.0, QuantityText::Computed(300.0, rpm)),
            (Kind::Velocity, "n*r", 3.6, QuantityText::Usual),
            (Kind::Angle, "phi", 0.5, QuantityText::Computed(0.5, unit("rad", Kind::Angle))),
        ] {
            match (plain.told(kind, text, si), told) {
                (QuantityText::Computed(a, u), QuantityText::Computed(b, w)) => {
                    assert!((a - b).abs() < 1e-12 && u == w, "{text}: {a} {b}")
                }
                (told, expected) => assert_eq!(told, expected, "{text}"),
            }
        }
        let cm = unit("cm", Kind::Length);
        assert_eq!(
            book.told(Kind::Length, "4.50 in", 0.25),
            QuantityText::Computed(25.0, cm.clone())
        );
        assert_eq!(book.told(Kind::Length, "30 cm", 0.3), QuantityText::AsWritten("30".into(), cm));
        assert_eq!(
            book.told(Kind::Omega, "300 rpm", 2.0),
            QuantityText::Computed(2.0, unit("rad/s", Kind::Omega))
        );
        assert_eq!(book.told(Kind::Length, "0", 0.0), QuantityText::Usual);
    }
}
