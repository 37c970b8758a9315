//! The answers, as text and as JSON.

use super::construction;
use super::drafting;
use hodograph_analytic::{Decided, RefusalReason as Refusal, SingularKind, Singularity};
use hodograph_base::diag::Diagnostic;
use hodograph_base::digits::{direction_degrees, legible, minus, shortest, significant};
use hodograph_base::lang::{say, tr};
use hodograph_base::notation::Notation;
use hodograph_board::construct::MeasuredDistance;
use hodograph_board::plan::text::PlanWriter;
use hodograph_mechanism::answer::AnswerValue;
use hodograph_paper::paper::phrase::{fill, formula, sense};
use hodograph_scene::{Book, DiagramKind, Find, Kind, Lang, Scene};
use hodograph_worked::certified::ladder::{
    AnswerPart, Certified, CertifiedNumber, MissingDigits, READING_DIGITS,
};
use hodograph_worked::worked::{InfiniteCentre, NoAnswer, Outcome, Unanswered, Worked};
use serde_json::{Value as Json, json};
use unicode_width::UnicodeWidthStr;

mod none;
mod other_figures;

pub use none::{reason, verdict};

/// Digits of the direction of a point at infinity.
const DIRECTION_DIGITS: usize = 5;
/// Default number of digits in text answers.
pub const DIGITS: usize = 6;

/// Returns the complete text output of `solve`: one line per question, each number to `digits`
/// significant digits as far as they are certain.
pub fn text(
    scene: &Scene,
    worked: &Worked,
    certified: &[Certified],
    digits: usize,
    lang: Lang,
) -> String {
    let notation = Notation::of_language(lang);
    let w = PlanWriter { scene, plan: &worked.plan, notation: &notation, lang };
    let mut rows: Vec<[String; 5]> = Vec::new();
    for line in lines(worked, certified) {
        let (r, c) = match line {
            AnswerLine::Answer(r, c) => (r, c),
            AnswerLine::InfiniteCentre(far) => {
                rows.push([
                    scene.find[far.find].text.clone(),
                    at_infinity(far, lang),
                    String::new(),
                    String::new(),
                    String::new(),
                ]);
                continue;
            }
            AnswerLine::None(u) => {
                let value = format!("{} ({})", verdict(u, lang), reason(scene, u, lang));
                rows.push([
                    scene.find[u.find].text.clone(),
                    value,
                    String::new(),
                    String::new(),
                    String::new(),
                ]);
                continue;
            }
        };
        let find = &scene.find[r.find];
        let tolerance = drafting::words(
            &scene.book,
            find,
            worked.drafting.as_ref().and_then(|d| d.tolerances[r.find].as_ref()),
        );
        let value = value_words(&scene.book, find, r.value(), c, digits, lang);
        let remarks = [certainty_words(c, digits, lang), agreement_words(r, lang)];
        let remarks: Vec<String> = remarks.into_iter().filter(|w| !w.is_empty()).collect();
        rows.push([
            find.text.clone(),
            value,
            tolerance,
            measured_words(&w, worked, find, r, c, digits),
            remarks.join("  "),
        ]);
    }
    // Lines without an answer do not affect the column widths.
    let width = |i: usize| {
        rows.iter()
            .filter(|r| i == 0 || !r[2..].iter().all(String::is_empty))
            .map(|r| r[i].width())
            .max()
            .unwrap_or(0)
    };
    let widths = [width(0), width(1), width(2), width(3)];
    let mut out = String::new();
    let title = lang.of(&scene.title);
    if !title.is_empty() {
        out.push_str(title);
        out.push('\n');
    }
    for r in &rows {
        let pad =
            |i: usize| format!("{}{}", r[i], " ".repeat(widths[i].saturating_sub(r[i].width())));
        let tolerance = if widths[2] > 0 { format!("  {}", pad(2)) } else { String::new() };
        out.push_str(
            format!("  {} = {}{tolerance}  {}  {}", pad(0), pad(1), pad(3), r[4]).trim_end(),
        );
        out.push('\n');
    }
    if let Some(worst) = worst(worked) {
        out.push_str(&format!(
            "{}\n",
            fill(
                tr!(lang, "greatest relative difference between drawing and analysis: {}"),
                &[("", &significant(worst, 1))],
            )
        ));
    }
    out
}

/// A question, with or without an answer.
pub enum AnswerLine<'a> {
    /// An answer with its certificate.
    Answer(&'a Outcome, &'a Certified),
    /// A question without an answer in the pose.
    None(&'a Unanswered),
    /// An instantaneous centre at infinity.
    InfiniteCentre(&'a InfiniteCentre),
}

/// Returns all questions in their order.
pub fn lines<'a>(worked: &'a Worked, certified: &'a [Certified]) -> Vec<AnswerLine<'a>> {
    let answered =
        worked.results.iter().zip(certified).map(|(r, c)| (r.find, AnswerLine::Answer(r, c)));
    let none = worked.unanswered.iter().map(|u| (u.find, AnswerLine::None(u)));
    let mut all: Vec<_> = answered
        .chain(none)
        .chain(worked.at_infinity.iter().map(|f| (f.find, AnswerLine::InfiniteCentre(f))))
        .collect();
    all.sort_by_key(|(find, _)| *find);
    all.into_iter().map(|(_, line)| line).collect()
}

/// Returns the direction of a centre at infinity: `at infinity, ∠ 35.00°`.
pub fn at_infinity(far: &InfiniteCentre, lang: Lang) -> String {
    match far.direction_deg {
        Some(degrees) => {
            fill(tr!(lang, "at infinity, ∠ {}°"), &[("", &legible(degrees, DIRECTION_DIGITS))])
        }
        None => tr!(lang, "everywhere: no relative motion").to_owned(),
    }
}

/// Returns the largest relative difference between drawing and analysis; `None` if nothing was
/// compared.
pub fn worst(worked: &Worked) -> Option<f64> {
    worked.results.iter().filter_map(|r| r.agreement).map(|a| a.difference).reduce(f64::max)
}

/// Returns a value with its unit and its sense or direction, to its certified digits; if none are
/// certain, the approximate value of the `f64` solution.
pub fn value_words(
    book: &Book,
    find: &Find,
    value: AnswerValue,
    c: &Certified,
    digits: usize,
    lang: Lang,
) -> String {
    let kind = find.what.kind();
    let number = |part: AnswerPart, digits: usize, rough: f64| match c
        .part(part)
        .and_then(|n| n.text(digits))
    {
        Some((text, _)) => minus(&text),
        None => match c.rough_digits(digits) {
            (known, true) => legible(rough, known),
            (known, false) => format!("≈ {}", legible(rough, known)),
        },
    };
    // The certified number in the unit in which it is printed.
    let printed = match book.chosen(kind) {
        Some(_) => AnswerPart::Printed,
        None if kind == Kind::Angle => AnswerPart::Degrees,
        None if matches!(value, AnswerValue::Vector(_)) => AnswerPart::Magnitude,
        None => AnswerPart::Scalar,
    };
    let amount = |si: f64, sign: &str| {
        book.text(kind, number(printed, digits, book.value(kind, si)).trim_start_matches(sign))
    };
    match value {
        AnswerValue::Vector(v) => {
            let direction = match c.part(AnswerPart::Direction) {
                None if v.norm() > 0.0 && matches!(c.why, Some(MissingDigits::NextOrder(_))) => {
                    format!(
                        " ∠ {}°",
                        number(
                            AnswerPart::Direction,
                            digits.saturating_sub(1).max(1),
                            direction_degrees(v.angle())
                        )
                    )
                }
                Some(_) => format!(
                    " ∠ {}°",
                    number(
                        AnswerPart::Direction,
                        digits.saturating_sub(1).max(1),
                        direction_degrees(v.angle())
                    )
                ),
                None => String::new(),
            };
            format!("{}{direction}", amount(v.norm(), ""))
        }
        AnswerValue::Scalar(s) if kind.turns() => {
            let sign = c.part(AnswerPart::Scalar).map_or(s, |n| n.sign());
            let sense = if sign == 0.0 { String::new() } else { format!(" {}", sense(lang, sign)) };
            format!("{}{sense}", amount(s, "−"))
        }
        AnswerValue::Scalar(s) => amount(s, ""),
        AnswerValue::Point(p) => {
            let [x, y] = if book.chosen(kind).is_some() {
                [AnswerPart::PrintedX, AnswerPart::PrintedY]
            } else {
                [AnswerPart::X, AnswerPart::Y]
            };
            let coordinate = |part: AnswerPart, si: f64| number(part, digits, book.value(kind, si));
            book.text(kind, &format!("({}, {})", coordinate(x, p.x), coordinate(y, p.y)))
        }
    }
}

/// Returns the reason why fewer digits than requested are printed; empty if all are certain.
fn certainty_words(c: &Certified, digits: usize, lang: Lang) -> String {
    let Some(why) = &c.why else { return String::new() };
    if let MissingDigits::NextOrder(known) = why {
        // The note on the pose states this once for all answers; it is repeated only where digits
        // are missing.
        return match *known >= digits {
            true => String::new(),
            false => say!(lang, "[{known} digits are true: {}]", why.words(lang)),
        };
    }
    let certain = c
        .parts
        .iter()
        .filter(|(p, _)| !matches!(p, AnswerPart::X | AnswerPart::Y) || c.prints(*p))
        .map(|(_, n)| n.text(digits).map_or(0, |t| t.1))
        .min();
    let why = why.words(lang);
    match certain {
        Some(k @ 1..) => say!(lang, "[{k} digits are certain: {why}]"),
        _ => say!(lang, "[not certified: {why}]"),
    }
}

fn measured_words(
    w: &PlanWriter,
    worked: &Worked,
    find: &Find,
    r: &Outcome,
    c: &Certified,
    digits: usize,
) -> String {
    let lang = w.lang;
    let others: Vec<String> =
        r.others.iter().map(|v| value_words(&w.scene.book, find, *v, c, digits, lang)).collect();
    match &r.drawn {
        None if !others.is_empty() => say!(
            lang,
            "(loop equations; on the other motion {})",
            others.join(lang.pick([", ", "，"]))
        ),
        None if r.longer.is_some() => tr!(lang, "(longer numbers)").into(),
        None => tr!(lang, "(loop equations)").into(),
        Some(a) => match &a.measured {
            // If nothing moves there is no polygon and no scale.
            Some(_) if worked.construction.is_empty(find.what.diagram()) => String::new(),
            Some(m) => {
                let certain = |n: Option<&CertifiedNumber>| {
                    n.and_then(|n| n.text(READING_DIGITS)).map(|t| t.0)
                };
                let book = &w.scene.book;
                let arm = certain(c.reading.as_ref().and_then(|r| r.arm.as_ref()));
                let rough = |l: f64| significant(book.value(Kind::Length, l), READING_DIGITS);
                let arm = m
                    .arm_m
                    .map(|l| {
                        format!(" / {}", book.text(Kind::Length, &arm.unwrap_or_else(|| rough(l))))
                    })
                    .unwrap_or_default();
                let length = if r.value().magnitude() == 0.0 { 0.0 } else { m.length_mm };
                let length = certain(c.reading.as_ref().map(|r| &r.length_mm))
                    .unwrap_or_else(|| significant(length, READING_DIGITS));
                let on = find.what.diagram();
                format!("({} {length} mm · μ {}{arm})", between(w, on, m), scale_words(book, on, m))
            }
            None => String::new(),
        },
    }
}

/// Returns a scale as a factor with its unit, in a form suitable for a product.
fn scale_words(book: &Book, on: DiagramKind, m: &MeasuredDistance) -> String {
    format!("{} {}", shortest(book.value(on.kind(), m.mu)), book.scale_name(on.kind()))
}

/// Returns the letters of the two marks at the ends of a length: `bc`, `n′_c–c′`.
fn between(w: &PlanWriter, on: DiagramKind, m: &MeasuredDistance) -> String {
    let [from, to] = m.marks.map(|(mark, _)| formula(&construction::mark(w, on, &mark)));
    // After a subscript the next letter would look like a part of it.
    let apart = if from.contains('_') { "–" } else { "" };
    format!("{from}{apart}{to}")
}

fn agreement_words(r: &Outcome, lang: Lang) -> String {
    match r.agreement {
        Some(a) if !a.holds() => {
            format!(
                "{} {}",
                tr!(lang, "DRAWING AND ANALYSIS DISAGREE:"),
                significant(a.difference, 2)
            )
        }
        _ => String::new(),
    }
}

/// Returns the answers as JSON: SI values, components, the measured length, the results of drawing
/// and analysis and their difference.
pub fn json(
    scene: &Scene,
    worked: &Worked,
    certified: &[Certified],
    digits: usize,
    notes: &[Diagnostic],
) -> Json {
    let notation = Notation::of_language(Lang::En);
    let w = PlanWriter { scene, plan: &worked.plan, notation: &notation, lang: Lang::En };
    let elsewhere = other_figures::drawn(scene, worked);
    let answers: Vec<Json> = lines(worked, certified)
        .into_iter()
        .map(|line| {
            let (r, c) = match line {
                AnswerLine::Answer(r, c) => (r, c),
                AnswerLine::None(u) => return unanswered(scene, worked, u),
                AnswerLine::InfiniteCentre(far) => return far_json(scene, far),
            };
            let find = &scene.find[r.find];
            let mut answer = json!({
                "find": find.text,
                "unit": find.what.kind().si(),
                "unbounded": false,
                "certified": certificate(c, digits),
                "value": value(r.value()),
                "in_unit": in_unit(&scene.book, find, r.value(), c, digits),
                "drawing": r.drawn.as_ref().map(|a| a.value).or(elsewhere[r.find]).map(value),
                "analysis": r.longer.is_none().then(|| value(r.computed)),
                "longer_numbers": r.longer.map(|rung| rung.name()),
                "measured_mm": r.drawn.as_ref().and_then(|a| a.measured.as_ref()).map(|m| m.length_mm),
                "measured_between": r.drawn.as_ref().and_then(|a| a.measured.as_ref()).map(|m| m.marks.map(|(mark, _)| formula(&construction::mark(&w, find.what.diagram(), &mark)))),
                "scale": r.drawn.as_ref().and_then(|a| a.measured.as_ref()).map(|m| m.mu),
                "difference": r.agreement.map(|a| a.difference),
                "agrees": r.agreement.map(|a| a.holds()),
                "others": r.others.iter().map(|v| value(*v)).collect::<Vec<_>>(),
                "why": null,
            });
            if let (Some(d), Json::Object(fields)) = (&worked.drafting, &mut answer) {
                let of = drafting::answer_fields(d.tolerances[r.find].as_ref());
                fields.extend(of.map(|(key, value)| (key.to_string(), value)));
            }
            answer
        })
        .collect();
    let mut all = json!({
        "title": {"en": scene.title.en, "zh": scene.title.zh},
        "answers": answers,
        // Infinite in a singular pose, which JSON writes as null.
        "condition": worked.solution.condition,
        "singular": worked.solution.singular.iter().map(|s| singularity(scene, s)).collect::<Vec<_>>(),
        "scales": scales(worked),
        "notes": notes.iter().map(diagnostic).collect::<Vec<_>>(),
    });
    if let Some(d) = &worked.drafting {
        all["drafting"] = drafting::json(scene, worked, d);
    }
    all
}

/// Returns the scales by their keys, with the scale of forces if forces are drawn.
fn scales(worked: &Worked) -> serde_json::Map<String, Json> {
    let key = |on: DiagramKind| on.kind().scale_key().map(str::to_owned);
    let usual = DiagramKind::OF_MOTION.into_iter();
    let mut all: serde_json::Map<String, Json> =
        usual.filter_map(|on| Some((key(on)?, json!(worked.construction.scale(on))))).collect();
    if let Some(of) = &worked.equilibrium {
        all.extend(key(DiagramKind::Force).map(|key| (key, json!(of.mu()))));
    }
    all
}

/// Returns a value in SI as JSON.
fn value(v: AnswerValue) -> Json {
    match v {
        AnswerValue::Vector(v) => {
            json!({"x": v.x, "y": v.y, "magnitude": v.norm(), "angle_deg": v.angle().to_degrees()})
        }
        AnswerValue::Scalar(s) => json!({"value": s}),
        AnswerValue::Point(p) => json!({"x": p.x, "y": p.y}),
    }
}

/// Returns the value in the unit that the scene requests, with its name; null if it requests none.
fn in_unit(book: &Book, find: &Find, value: AnswerValue, c: &Certified, digits: usize) -> Json {
    let kind = find.what.kind();
    let Some(unit) = book.chosen(kind) else { return Json::Null };
    let text = |part: AnswerPart| c.part(part).and_then(|n| n.text(digits)).map(|t| t.0);
    let one = |si: f64| json!({"unit": unit.name(), "value": unit.of(si), "text": text(AnswerPart::Printed)});
    match value {
        AnswerValue::Vector(v) => one(v.norm()),
        AnswerValue::Scalar(s) => one(s),
        AnswerValue::Point(p) => {
            let text = text(AnswerPart::PrintedX)
                .zip(text(AnswerPart::PrintedY))
                .map(|(x, y)| format!("({x}, {y})"));
            json!({"unit": unit.name(), "x": unit.of(p.x), "y": unit.of(p.y), "text": text})
        }
    }
}

/// Returns a centre at infinity as JSON: no value, but its direction. It has the keys of an answer.
fn far_json(scene: &Scene, far: &InfiniteCentre) -> Json {
    let find = &scene.find[far.find];
    let mut answer = json!({"find": find.text, "unit": find.what.kind().si(), "unbounded": false, "at_infinity": true, "direction_deg": far.direction_deg});
    for key in NO_ANSWER {
        answer[*key] = Json::Null;
    }
    answer
}

/// The keys of an answer that are null if there is none.
const NO_ANSWER: &[&str] = &[
    "certified",
    "value",
    "in_unit",
    "drawing",
    "analysis",
    "longer_numbers",
    "measured_between",
    "measured_mm",
    "scale",
    "difference",
    "agrees",
    "others",
    "why",
];

/// Returns a question without an answer as JSON: no value, a flag for unbounded growth, and the
/// collinear links.
///
/// It has the keys of an answer, so that all entries have the same keys.
fn unanswered(scene: &Scene, worked: &Worked, u: &Unanswered) -> Json {
    let (unbounded, code, links) = match &u.why {
        NoAnswer::NoMotion(r) => {
            (r.why == Refusal::DeadPoint, r.diagnostic.code, r.named.as_slice())
        }
        NoAnswer::NoValue(_) => (false, "not-defined", [].as_slice()),
        NoAnswer::Infinite(_) => (true, "infinite", [].as_slice()),
    };
    let mut answer = json!({
        "find": scene.find[u.find].text,
        "unit": scene.find[u.find].what.kind().si(),
        "unbounded": unbounded,
        "certified": null,
        "value": null,
        "in_unit": null,
        "drawing": null,
        "analysis": null,
        "longer_numbers": null,
        "measured_between": null,
        "measured_mm": null,
        "scale": null,
        "difference": null,
        "agrees": null,
        "others": null,
        "why": {
            "code": code,
            "words": reason(scene, u, Lang::En),
            "links": links.iter().map(|l| scene.link_name(*l)).collect::<Vec<_>>(),
        },
    });
    if let (Some(_), Json::Object(fields)) = (&worked.drafting, &mut answer) {
        fields.extend(drafting::answer_fields(None).map(|(key, value)| (key.to_string(), value)));
    }
    answer
}

/// Returns the certificate of an answer: for each of its numbers the centre and radius of an
/// interval that is guaranteed to contain it, and the digits that both ends have in common.
fn certificate(c: &Certified, digits: usize) -> Json {
    let numbers: serde_json::Map<String, Json> = c
        .parts
        .iter()
        .map(|(part, n)| {
            let (text, certain) = n.text(digits).map_or((None, 0), |(t, k)| (Some(t), k));
            let e = n.enclosure();
            (
                part.key().into(),
                json!({"value": e.approx, "radius": e.radius, "text": text, "digits": certain}),
            )
        })
        .collect();
    json!({"rung": c.rung.name(), "complete": c.why.is_none(), "why": c.why.as_ref().map(|w| w.words(Lang::En)), "numbers": numbers})
}

fn singularity(scene: &Scene, s: &Singularity) -> Json {
    json!({
        "kind": match s.kind {
            SingularKind::ChangePoint => "change-point",
            SingularKind::Limit => "driver-at-limit",
            SingularKind::Rest => "at-rest",
        },
        "links": s.named.iter().map(|l| scene.link_name(*l)).collect::<Vec<_>>(),
        "words": s.words.en,
        "decided": s.decided.map(|d| match d {
            Decided::Side => "side",
            Decided::Sketch => "sketch",
            Decided::Kind => "kind",
            Decided::Sense => "sense",
        }),
    })
}

/// Returns a diagnostic as JSON.
pub fn diagnostic(d: &Diagnostic) -> Json {
    json!({
        "severity": d.severity.word(),
        "code": d.code,
        "message": d.message.en,
        "help": d.help.as_ref().map(|h| &h.en),
        "span": d.span.map(|s| [s.start, s.end]),
    })
}

#[cfg(test)]
mod tests;
