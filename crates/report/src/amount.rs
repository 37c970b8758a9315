//! Answers, their symbols, and scales in the label language: `v_{C} = 0.8556 m/s`, `∠ 30°`,
//! `μ_v = 0.01 (m/s)/mm`.

use hodograph_base::digits::{direction_degrees, inked, shortest, significant};
use hodograph_base::notation::Notation;
use hodograph_board::plan::names::{name_label, point_label};
use hodograph_mechanism::answer::AnswerValue;
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::words::Words;
use hodograph_scene::quantity::combined::halves_of;
use hodograph_scene::quantity::{Asked, Of, OverSign};
use hodograph_scene::{Book, DiagramKind, Find, Kind, Scene};
use hodograph_worked::certified::ladder::{AnswerPart, Certified};

/// Returns the length unit of tables: the book's, else the scene's; its name, and the number of
/// units per metre.
pub(super) fn length_unit(scene: &Scene) -> (String, f64) {
    match scene.book.chosen(Kind::Length) {
        Some(unit) => (unit.name().to_owned(), unit.of(1.0)),
        None => {
            let unit = scene.length_unit;
            (unit.name.to_owned(), unit.denominator / unit.numerator)
        }
    }
}

/// Returns the symbol of a question: `vr_B2B3` → `v^{r}_{B2B3}`.
pub fn symbol(find: &Find, notation: &Notation) -> String {
    if let Asked::Combined(c) = find.what
        && let Some(halves) = halves_of(&c, &find.text)
    {
        let [a, b] = [0, 1].map(|k| {
            let half =
                Find { what: c.operands[k].asked(), text: halves[k].to_owned(), span: find.span };
            symbol(&half, notation)
        });
        return format!("{a}{}{b}", c.operation.sign());
    }
    // Names may be separated by a comma or a hyphen; a hyphen would be read as a minus. `P13D` has
    // no underscore.
    let sub = find
        .text
        .split_once('_')
        .map_or_else(|| find.text.strip_prefix('P').unwrap_or_default(), |(_, s)| s)
        .replace('-', ",");
    let entry = find.what.entry();
    // The notation has its own mark for tangential parts.
    let part = |sign: &str| match sign.strip_suffix('t') {
        Some(before) => format!("{before}{}", notation.tangential),
        None => sign.to_owned(),
    };
    let sup = match entry.over {
        OverSign::Nothing => String::new(),
        // The roller of a follower as a separate link: `omega_5`, written as for any link.
        OverSign::Sign(_) if !find.text.starts_with(entry.symbol) => String::new(),
        OverSign::Sign(sign) => part(sign),
        OverSign::Sliding => notation.sliding.clone(),
        OverSign::SlidingPart(sign) => format!("{}\\,{}", notation.sliding, part(sign)),
        OverSign::Coriolis => notation.coriolis.clone(),
    };
    // A coordinate belongs to the point itself, so the subscript is the point's label on the
    // diagram.
    let place = matches!((find.what.of(), entry.kind), (Of::Point(_), Kind::Length));
    let sub = if place { point_label(sub.trim()) } else { name_label(&sub) };
    // An index in the letter comes before that of the question: F_I and 2 give F_{I2}.
    let (letter, index) = entry.letter.split_once('_').unwrap_or((entry.letter, ""));
    let reaction = if matches!(find.what, Asked::Force(f) if f.is_reaction()) {
        notation.reaction.as_str()
    } else {
        ""
    };
    let sub = format!("{index}{reaction}{sub}");
    if sub.is_empty() {
        return letter.to_owned();
    }
    if sup.is_empty() {
        format!("{letter}_{{{sub}}}")
    } else {
        format!("{letter}^{{{sup}}}_{{{sub}}}")
    }
}

/// Returns a certified number multiplied by 10^`shift`; if no digit is certain, the approximate
/// value of the `f64` solution.
fn certain(c: &Certified, part: AnswerPart, digits: usize, shift: i32, rough: f64) -> String {
    match c.part(part).and_then(|n| n.text_scaled(digits, shift)) {
        Some((text, _)) => inked(&text),
        None => match c.rough_digits(digits) {
            (known, true) => number(rough, known),
            (known, false) => format!("\\approx {}", number(rough, known)),
        },
    }
}

/// Returns an answer's number with its unit, in the label language.
pub fn amount(
    book: &Book,
    find: &Find,
    value: AnswerValue,
    c: &Certified,
    digits: usize,
) -> String {
    let kind = find.what.kind();
    let chosen = book.chosen(kind).is_some();
    let number = match value {
        // Small lengths are given in millimetres.
        AnswerValue::Scalar(s) if kind == Kind::Length && !chosen && s.abs() < 10.0 => {
            return format!("{} mm", certain(c, AnswerPart::Scalar, digits, 3, s * 1e3));
        }
        AnswerValue::Scalar(s) => {
            let part = match (chosen, kind == Kind::Angle) {
                (true, _) => AnswerPart::Printed,
                (false, true) => AnswerPart::Degrees,
                (false, false) => AnswerPart::Scalar,
            };
            certain(c, part, digits, 0, book.value(kind, s))
        }
        AnswerValue::Point(p) if !chosen && p.x.abs().max(p.y.abs()) < 10.0 => {
            let coordinate = |part, si: f64| certain(c, part, digits, 3, si * 1e3);
            // A unit after a number is upright; after a parenthesis it must be marked as upright.
            return format!(
                "({}, {})\\,\\text{{mm}}",
                coordinate(AnswerPart::X, p.x),
                coordinate(AnswerPart::Y, p.y)
            );
        }
        AnswerValue::Point(p) => {
            let [x, y] = if chosen {
                [AnswerPart::PrintedX, AnswerPart::PrintedY]
            } else {
                [AnswerPart::X, AnswerPart::Y]
            };
            let coordinate = |part, si: f64| certain(c, part, digits, 0, book.value(kind, si));
            return format!(
                "({}, {})\\,{}",
                coordinate(x, p.x),
                coordinate(y, p.y),
                book.upright(kind)
            );
        }
        AnswerValue::Vector(v) => certain(
            c,
            if chosen { AnswerPart::Printed } else { AnswerPart::Magnitude },
            digits,
            0,
            book.value(kind, v.norm()),
        ),
    };
    // The sense of rotation is given in words.
    book.label(kind, if kind.turns() { number.trim_start_matches('−') } else { &number })
}

/// Returns an answer's direction, or its sense of rotation in words.
pub fn sense(
    find: &Find,
    value: AnswerValue,
    c: &Certified,
    words: &Words,
    digits: usize,
) -> Label {
    match value {
        AnswerValue::Vector(v)
            if c.part(AnswerPart::Direction).is_some()
                || (c.rough_digits(digits).1 && v.norm() > 0.0) =>
        {
            let degrees =
                certain(c, AnswerPart::Direction, digits, 0, direction_degrees(v.angle()));
            // A plain number is upright in the label language; only one with a power of ten needs
            // it.
            let number =
                if degrees.contains('\\') { Label::math(degrees) } else { Label::text(degrees) };
            Label::text("∠ ").then(number).then(Label::text("°"))
        }
        AnswerValue::Scalar(s) if find.what.kind().turns() => {
            Label::text(words.sense(c.part(AnswerPart::Scalar).map_or(s, |n| n.sign())))
        }
        AnswerValue::Vector(_) | AnswerValue::Scalar(_) | AnswerValue::Point(_) => Label::text(""),
    }
}

/// Returns a number in the label language: `12.35`, `1.5 \times 10^{9}`.
pub fn number(value: f64, digits: usize) -> String {
    inked(&significant(value, digits))
}

/// Returns the scale of a diagram: `\mu_v = 0.01 (m/s)/mm`.
pub fn scale_formula(book: &Book, on: DiagramKind, mu: f64) -> String {
    let kind = on.kind();
    format!("\\mu_{} = {} {}", on.letter(), scale(book.value(kind, mu)), book.scale_label(kind))
}

/// Returns a scale in the label language: `0.002`, `2 \times 10^{-6}`.
pub fn scale(mu: f64) -> String {
    inked(&shortest(mu))
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

    #[test]
    fn names_of_points_are_labels() {
        use hodograph_board::plan::names::{name_label, point_label};
        for name in ["B", "O21", "A'", "A1'", "A'1", "B_1", "B__", "O_'", "''3", "Ω3", "滑块2"] {
            for label in [point_label(name), format!("v_{{{}}}", name_label(name))] {
                assert_eq!(Label::math(label.as_str()).faults(), [], "{name}: {label}");
            }
        }
    }
}
