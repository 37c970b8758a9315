//! The section `lengths`: distances between points of one link.

use std::collections::HashMap;

use super::*;

pub(super) fn lengths(c: &Context, faults: &mut Faults) -> Vec<Length> {
    let mut out: Vec<Length> = Vec::with_capacity(c.raw.lengths.len());
    let mut known: HashMap<(PointId, PointId), usize> = HashMap::new();
    for (word, quantity) in &c.raw.lengths {
        let value = c.values.positive_length(quantity, &format!("the length `{}`", word.text), faults);
        let Some((a, b)) = note(c.names.pair(word), faults) else { continue };
        if c.common(a, b).is_none() {
            let message = format!("`{}` and `{}` are not on one link, so their distance changes", c.point_name(a), c.point_name(b));
            let d = Diagnostic::error("not-on-link", message).at(word.span);
            faults.push(d.help("a length that a cylinder sets belongs to its driver: \"length\""));
            continue;
        }
        let Some(value) = value else { continue };
        let ends = (a.min(b), a.max(b));
        if let Some(&first) = known.get(&ends) {
            let first: &Length = &out[first];
            let d = if same(first.value.value, value.value) {
                Diagnostic::warning("given-twice", format!("the length `{}` is given twice", word.text)).help("keep one of the two")
            } else {
                let message = format!("the length `{}` is {} here and {} before", word.text, value.text, first.value.text);
                Diagnostic::error("contradiction", message).help("keep the right one")
            };
            faults.push(d.at(word.span));
            continue;
        }
        known.insert(ends, out.len());
        out.push(Length { a, b, value });
    }
    out
}

/// Whether two lengths that are given in two ways mean the same. Coordinates are often written to six or seven digits, so a
/// tighter bound would call them contradictory; a millionth of a length is far below what paper shows, and what a larger bound
/// would let through changes the fifth digit of an answer.
pub(super) fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-6 * a.abs().max(b.abs())
}
