//! The results: for each question the length measured, the scale, the value with unit and sense; then how far drawing
//! and loop equations are apart.

use crate::analytic::SingularKind;
use crate::answer::{Value, level_of};
use crate::mechanism::Level;
use crate::plan::notation::Notation;
use crate::plan::text::point_label;
use crate::quantity::{direction_degrees, significant};
use crate::report::answers::worst;
use crate::report::phrase::Phrase;
use crate::scene::{Asked, Axis, Find, Scene};
use crate::worked::{Outcome, Worked};

use super::drawing::Part;
use super::grid::{self, Cell, Row};
use super::item::Anchor;
use super::label::Label;
use super::style::Style;
use super::words::Words;

/// Distance of the rows' baselines: scripts of one must not touch those of the next.
const ROW_MM: f64 = 6.4;
/// From the first row up to the heading.
const HEADING_MM: f64 = 2.2;
/// Distance of the baselines of the remarks below.
const REMARK_MM: f64 = 5.2;
/// Between columns.
const GAP_MM: f64 = 1.8;
/// Digits shown: one more than a ruler gives, so that rounding is not mistaken for the drawing's error.
pub(super) const DIGITS: usize = 4;

/// The block of results.
pub fn results(style: &Style, scene: &Scene, worked: &Worked, notation: &Notation, words: &Words) -> Part {
    let heading = Cell {
        label: Label::text(words.results),
        size_mm: style.caption_mm,
        anchor: Anchor::Start,
        class: "result heading".into(),
        id: "heading-results".into(),
    };
    let mut rows = Vec::new();
    for r in &worked.results {
        let find = &scene.find[r.find];
        let id = format!("result-{}", find.text);
        let cell = |text: Label, anchor, what: &str| {
            Some(Cell { label: text, size_mm: style.caption_mm, anchor, class: "result".into(), id: format!("{id}-{what}") })
        };
        let sign = |what: &str| cell(Label::math("="), Anchor::Middle, what);
        let value = r.value();
        let measured = measured(r, find, words);
        let [from, equals] = match measured {
            Some(m) => [cell(m, Anchor::Start, "measured"), sign("equals")],
            None => [None, None],
        };
        // Without a measurement the value follows the first sign, so that the column of values stays in line.
        let first = if from.is_some() { sign("is") } else { None };
        let second = equals.or_else(|| sign("is"));
        rows.push(Row {
            cells: vec![
                cell(Label::math(symbol(find, notation)), Anchor::Start, "symbol"),
                first,
                from,
                second,
                cell(Label::math(amount(find, value)), Anchor::Start, "value"),
                cell(sense(find, value, words), Anchor::Start, "sense"),
            ],
            height_mm: ROW_MM,
        });
    }
    let mut items = grid::set(&rows, GAP_MM);
    items.extend(grid::set(&[Row { cells: vec![Some(heading)], height_mm: -HEADING_MM }], 0.0));
    let mut below = rows.len() as f64 * ROW_MM + 1.1 * ROW_MM;
    for (id, text) in remarks(scene, worked, notation, words) {
        let cell =
            Cell { label: Phrase::new(&text).label(), size_mm: style.small_mm, anchor: Anchor::Start, class: id.into(), id: id.into() };
        items.extend(grid::set(&[Row { cells: vec![Some(cell)], height_mm: below }], 0.0));
        below += REMARK_MM;
    }
    Part::of(items)
}

/// What stands below the results, with the name of each line: how far drawing and analysis are apart, and what is singular
/// in the pose.
fn remarks(scene: &Scene, worked: &Worked, notation: &Notation, words: &Words) -> Vec<(&'static str, String)> {
    let mut out = Vec::new();
    if let Some(worst) = worst(worked) {
        out.push(("agreement", words.agreement.replace("{}", &number(worst.max(f64::EPSILON / 2.0), 1))));
    }
    for s in &worked.solution.singular {
        let links: Vec<&str> = s.named.iter().map(|l| scene.link_name(*l)).collect();
        let text = match s.kind {
            SingularKind::ChangePoint => words.change_point,
            SingularKind::Limit => words.driver_at_limit,
            SingularKind::Rest => words.at_rest,
        };
        out.push(("singular", text.replace("{}", &links.join(words.comma))));
    }
    // Only the answers that differ, and of those only the first: the whole list is in `solve`.
    let differs = |r: &&Outcome| r.others.first().is_some_and(|v| *v != r.value());
    if let Some((r, other)) = worked.results.iter().find(differs).and_then(|r| Some((r, *r.others.first()?))) {
        let find = &scene.find[r.find];
        let sense = sense(find, other, words).plain();
        let value = format!("${} = {}$ {sense}", symbol(find, notation), amount(find, other));
        out.push(("other-motion", words.other_motion.replace("{}", value.trim_end())));
    }
    out
}

/// All results in one sentence, for readers who do not see the figure.
pub fn sentence(scene: &Scene, worked: &Worked, notation: &Notation, words: &Words) -> String {
    let each = worked.results.iter().map(|r| {
        let find = &scene.find[r.find];
        let value = r.value();
        let plain = format!("{} = {} ", symbol(find, notation), amount(find, value));
        let text = Label::math(plain).then(Label::text(" ")).then(sense(find, value, words)).plain();
        text.split_whitespace().collect::<Vec<_>>().join(" ")
    });
    each.collect::<Vec<_>>().join("; ")
}

/// A question's symbol: `vr_B2B3` → `v^{r}_{B2B3}`.
pub fn symbol(find: &Find, notation: &Notation) -> String {
    let sub = find.text.split_once('_').map_or("", |(_, s)| s);
    let (letter, sup) = match find.what {
        Asked::Coordinate(_, Axis::X) => ("x", ""),
        Asked::Coordinate(_, Axis::Y) => ("y", ""),
        Asked::LinkAngle(_) => ("\\varphi", ""),
        Asked::Distance(..) => ("l", ""),
        Asked::Velocity(_) | Asked::RelativeVelocity(..) => ("v", ""),
        Asked::Acceleration(_) | Asked::RelativeAcceleration(..) => ("a", ""),
        Asked::NormalAcceleration(..) => ("a", "n"),
        Asked::TangentialAcceleration(..) => ("a", "t"),
        Asked::SlidingVelocity(..) => ("v", notation.sliding.as_str()),
        Asked::SlidingAcceleration(..) => ("a", notation.sliding.as_str()),
        Asked::Coriolis(..) => ("a", notation.coriolis.as_str()),
        Asked::Omega(_) | Asked::RelativeOmega(..) => ("\\omega", ""),
        Asked::Alpha(_) | Asked::RelativeAlpha(..) => ("\\alpha", ""),
    };
    let sub = if matches!(find.what, Asked::Coordinate(..)) { point_label(sub) } else { sub.to_owned() };
    if sup.is_empty() { format!("{letter}_{{{sub}}}") } else { format!("{letter}^{{{sup}}}_{{{sub}}}") }
}

/// What the ruler gave: `48.32 mm · μ_v`, for turning rates over the link's length.
fn measured(r: &Outcome, find: &Find, words: &Words) -> Option<Label> {
    let level = level_of(&find.what);
    if level == Level::Position {
        return None;
    }
    let Some(drawn) = &r.drawn else { return Some(Label::text(words.computed)) };
    let measured = drawn.measured?;
    let mm = measured.length_mm;
    let scale = if level == Level::Acceleration { "\\mu_a" } else { "\\mu_v" };
    // Less than a thousandth of a millimetre is nothing that a ruler gives.
    let mm_text = if mm < 1e-3 { "0".to_owned() } else { number(mm, DIGITS) };
    let read = format!("{mm_text} mm \\cdot {scale}");
    Some(Label::math(match measured.arm_m {
        Some(length) => format!("{read} / {} m", number(length, DIGITS)),
        None => read,
    }))
}

fn amount(find: &Find, value: Value) -> String {
    match (find.what, value) {
        (Asked::LinkAngle(_), Value::Scalar(s)) => format!("{}\\degree", number(s.to_degrees(), DIGITS)),
        (Asked::Coordinate(..) | Asked::Distance(..), Value::Scalar(s)) if s.abs() < 10.0 => format!("{} mm", number(s * 1e3, DIGITS)),
        (_, Value::Vector(v)) => format!("{} {}", number(v.norm(), DIGITS), unit(find)),
        (Asked::Coordinate(..) | Asked::Distance(..), Value::Scalar(s)) => format!("{} m", number(s, DIGITS)),
        (_, Value::Scalar(s)) => format!("{} {}", number(s.abs(), DIGITS), unit(find)),
    }
}

fn unit(find: &Find) -> &'static str {
    match find.what {
        Asked::Omega(_) | Asked::RelativeOmega(..) => "rad/s",
        Asked::Alpha(_) | Asked::RelativeAlpha(..) => "rad/s^2",
        ref what if level_of(what) == Level::Acceleration => "m/s^2",
        _ => "m/s",
    }
}

fn sense(find: &Find, value: Value, words: &Words) -> Label {
    match (find.what, value) {
        (_, Value::Vector(v)) if v.norm() > 0.0 => Label::text(format!("∠ {}°", number(direction_degrees(v.angle()), DIGITS))),
        (Asked::Omega(_) | Asked::RelativeOmega(..) | Asked::Alpha(_) | Asked::RelativeAlpha(..), Value::Scalar(s)) => {
            Label::text(words.sense(s))
        }
        _ => Label::text(""),
    }
}

/// A number in the label language: `12.35`, `1.5 \times 10^{9}`.
pub fn number(value: f64, digits: usize) -> String {
    let text = significant(value, digits);
    let text = match text.split_once('e') {
        // The power closes with a brace, and the unit after it begins with a space.
        Some((mantissa, exponent)) => format!("{mantissa} \\times 10^{{{exponent}}}"),
        None => text,
    };
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_for_people() {
        assert_eq!(number(3.0e-15, 1), "3 \\times 10^{−15}");
        assert_eq!(number(-12.3456, 4), "−12.35");
        assert_eq!(Label::math(number(-1.5e9, 4)).faults(), []);
    }
}
