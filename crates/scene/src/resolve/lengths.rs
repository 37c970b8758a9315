//! The section `lengths`: distances between points of one link.

use std::collections::HashMap;

use super::super::units::{Unit, unit_named};
use super::*;

pub(super) fn lengths(c: &Context, faults: &mut Faults) -> Vec<Length> {
    let mut out: Vec<Length> = Vec::with_capacity(c.raw.lengths.len());
    let mut known: HashMap<(PointId, PointId), usize> = HashMap::new();
    for (word, quantity) in &c.raw.lengths {
        let value = c.values.positive_length(quantity, both!("the length `{}`", word.text), faults);
        let Some((a, b)) = note(c.names.pair(word), faults) else { continue };
        if c.common(a, b).is_none() {
            let message = both!(
                "`{}` and `{}` are not on one link, so their distance changes",
                c.point_name(a),
                c.point_name(b)
            );
            let d = Diagnostic::error("not-on-link", message).at(word.span);
            faults.push(
                d.help(both!("a length that a cylinder sets belongs to its driver: \"length\"")),
            );
            continue;
        }
        let Some(value) = value else { continue };
        let ends = (a.min(b), a.max(b));
        if let Some(&first) = known.get(&ends) {
            let first: &Length = &out[first];
            let d = if same(first.value.value, value.value) {
                Diagnostic::warning(
                    "given-twice",
                    both!("the length `{}` is given twice", word.text),
                )
                .help(both!("keep one of the two"))
            } else {
                let message = both!(
                    "the length `{}` is {} here and {} before",
                    word.text,
                    value.text,
                    first.value.text
                );
                Diagnostic::error("contradiction", message).help(both!("keep the right one"))
            };
            faults.push(d.at(word.span));
            continue;
        }
        known.insert(ends, out.len());
        out.push(Length { a, b, value });
    }
    out
}

/// Returns true if two lengths given in two ways agree. Coordinates are often written to six or
/// seven digits, so a tighter bound would report contradictions; a millionth of a length is far
/// below what paper shows, and differences above the bound change the fifth digit of an answer.
pub(super) fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-6 * a.abs().max(b.abs())
}

/// Returns the unit in which the file writes its lengths: that of the `units` table, else that of
/// the first length, parameter or coordinate with a unit, else millimetres.
pub(super) fn unit(c: &Context) -> &'static Unit {
    let coordinates = c.raw.points.iter().flat_map(|(_, place)| match place {
        RawPlace::At(xy) | RawPlace::InLink { xy, .. } => xy.as_slice(),
        RawPlace::Polar { length, .. } => std::slice::from_ref(length),
    });
    let table = c.values.unit_of(RequiredQuantity::Length).and_then(unit_named);
    let usual = || {
        unit_named(RequiredQuantity::Length.usual_unit())
            .expect("the usual unit of lengths is a unit")
    };
    table
        .or_else(|| unit_shown(c))
        .or_else(|| coordinates.clone().find_map(unit_in))
        .unwrap_or_else(usual)
}

/// Returns the unit of the first length (or parameter) with a unit.
pub(super) fn unit_shown(c: &Context) -> Option<&'static Unit> {
    c.raw.lengths.iter().chain(&c.raw.parameters).find_map(|(_, q)| unit_in(q))
}

/// Returns the unit of length at the end of a quantity.
fn unit_in(q: &RawQuantity) -> Option<&'static Unit> {
    let word = q.text.trim_end().rsplit(|c: char| !c.is_ascii_alphabetic()).next()?;
    unit_named(word).filter(|u| u.dim == RequiredQuantity::Length.dim())
}
