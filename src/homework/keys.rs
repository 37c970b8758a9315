//! The table of answers: made from solutions, written and read again as CSV.
//!
//! Columns: variant, student, question, value, unit, tolerance, mistakes. The last one holds the
//! values of typical wrong solutions, as `no-normal@link 3=4.2; no-coriolis@A=0.7`.

use super::csv::{self, TableCell};
use super::{ErrorPlace, HomeworkVariant, KeyEntry, TypicalError};
use crate::answer::AnswerValue;
use crate::attempts::{self, AttemptAnswer, Site};
use crate::diag::{Diagnostic, Faults, both};
use crate::digits::significant;
use crate::scene::book::BookUnit;
use crate::scene::{Kind, Mistake, Scene};
use crate::worked::Worked;

/// The columns.
const HEAD: [&str; 7] =
    ["variant", "student", "question", "value", "unit", "tolerance", "mistakes"];
/// Digits of values, and of tolerances, which are estimates.
const DIGITS: usize = 6;
const TOLERANCE_DIGITS: usize = 2;
/// The tolerance, as a part of the answer, of a value that no pencil has drawn: that of three
/// digits.
const UNDRAWN: f64 = 0.01;

/// Largest number of typical mistakes that are tried: a chain of a hundred links has hundreds.
const MOST_MISTAKES: usize = 40;

/// Returns the key of a solved scene.
pub fn key(scene: &Scene, worked: &Worked) -> Vec<KeyEntry> {
    let by_hand = worked.by_hand(scene);
    // Each wrong solution is a whole drawing: only its answers are kept.
    let sites = attempts::sites(scene, worked).into_iter().take(MOST_MISTAKES);
    let wrong: Vec<(Site, Vec<AttemptAnswer>)> = sites
        .filter_map(|site| Some((site, attempts::solved(scene, worked, site, None)?.rows)))
        .collect();
    let mut all = Vec::new();
    for (k, r) in worked.results.iter().enumerate() {
        let find = &scene.find[r.find];
        let kind = find.what.kind();
        let (unit, per_si) = unit_of(scene, kind);
        let drawn = by_hand.tolerances.get(r.find).and_then(Option::as_ref);
        let drawn = drawn.map(|t| t.absolute * per_si).filter(|t| *t > 0.0);
        for (n, (suffix, si)) in parts(r.value()).into_iter().enumerate() {
            let value = rounded(si * per_si);
            let size = if value == 0.0 { r.scale * per_si } else { value.abs() };
            let tolerance = rounded_to(drawn.unwrap_or(UNDRAWN * size), TOLERANCE_DIGITS);
            let mut mistakes: Vec<TypicalError> = Vec::new();
            for (site, rows) in &wrong {
                let row = rows.iter().find(|row| row.result == k).and_then(|row| row.wrong);
                let Some((_, si)) = row.and_then(|w| parts(w).get(n).copied()) else { continue };
                let other = rounded(si * per_si);
                let known = |m: &TypicalError| (m.value - other).abs() <= tolerance;
                if (other - value).abs() > tolerance && !mistakes.iter().any(known) {
                    let place = match (site.point(scene), site.link(scene)) {
                        (Some(point), _) => ErrorPlace::Point(point),
                        (None, link) => {
                            ErrorPlace::Link(link.map_or("", |l| scene.link_name(l)).to_owned())
                        }
                    };
                    mistakes.push(TypicalError { mistake: site.mistake(), place, value: other });
                }
            }
            let question = format!("{}{suffix}", find.text);
            all.push(KeyEntry { question, kind, unit: unit.clone(), value, tolerance, mistakes });
        }
    }
    all
}

/// Returns the unit of a kind in ASCII, and the number of units in one SI unit; small lengths are
/// in millimetres.
fn unit_of(scene: &Scene, kind: Kind) -> (String, f64) {
    if kind == Kind::Length && scene.book.chosen(kind).is_none() {
        return ("mm".into(), 1e3);
    }
    (ascii(scene.book.name(kind)), scene.book.value(kind, 1.0))
}

/// Returns a unit in ASCII: `m/s²` as `m/s^2`, `°` as `deg`.
pub(super) fn ascii(unit: &str) -> String {
    let mut out = String::new();
    let mut raised = false;
    for c in unit.chars() {
        let power = "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|p| p == c).map(|d| d.to_string());
        let power = if c == '⁻' { Some("-".to_owned()) } else { power };
        match (&power, c) {
            (Some(digits), _) => {
                out += if raised { "" } else { "^" };
                out += digits;
            }
            (None, '°') => out += "deg",
            (None, '·') => out.push('*'),
            (None, c) => out.push(c),
        }
        raised = power.is_some();
    }
    out
}

/// Returns the numbers of an answer that are asked for, each with what is added to the question.
fn parts(value: AnswerValue) -> Vec<(&'static str, f64)> {
    match value {
        AnswerValue::Scalar(s) => vec![("", s)],
        AnswerValue::Vector(v) => vec![("", v.norm())],
        AnswerValue::Point(p) => vec![(".x", p.x), (".y", p.y)],
    }
}

fn rounded(value: f64) -> f64 {
    rounded_to(value, DIGITS)
}

/// Returns a value with a number of significant digits.
pub(super) fn rounded_to(value: f64, digits: usize) -> f64 {
    significant(value, digits).parse().unwrap_or(value)
}

/// Writes the keys of all variants.
pub fn csv(all: &[HomeworkVariant]) -> String {
    let mut out = csv::line(&HEAD);
    for v in all {
        for k in &v.key {
            let mistakes: Vec<String> = k.mistakes.iter().map(mistake).collect();
            out += &csv::line(&[
                v.number.to_string(),
                v.student.clone().unwrap_or_default(),
                k.question.clone(),
                number(k.value),
                k.unit.clone(),
                number(k.tolerance),
                mistakes.join("; "),
            ]);
        }
    }
    out
}

/// Writes the varied values of all variants.
pub fn values_csv(all: &[HomeworkVariant]) -> String {
    let names = all.first().map(|v| v.values.as_slice()).unwrap_or_default();
    let head = ["variant", "student"].into_iter().chain(names.iter().map(|(n, _)| n.as_str()));
    let mut out = csv::line(&head.collect::<Vec<_>>());
    for v in all {
        let (number, student) = (v.number.to_string(), v.student.clone().unwrap_or_default());
        let values = v.values.iter().map(|(_, value)| value.as_str());
        let row: Vec<&str> =
            [number.as_str(), student.as_str()].into_iter().chain(values).collect();
        out += &csv::line(&row);
    }
    out
}

/// Returns a number that Rust and spreadsheets read.
pub(super) fn number(value: f64) -> String {
    format!("{value}")
}

fn mistake(m: &TypicalError) -> String {
    let place = match &m.place {
        ErrorPlace::Point(p) => p.clone(),
        ErrorPlace::Link(l) => format!("link {l}"),
    };
    format!("{}@{place}={}", m.mistake.name(), number(m.value))
}

/// A key with its variant.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadKey {
    /// The number of the variant.
    pub variant: usize,
    /// The student of the variant, if there is one.
    pub student: Option<String>,
    /// The key.
    pub entry: KeyEntry,
}

/// Reads the keys that [`csv()`] writes; a teacher may have changed them.
///
/// # Errors
/// `keys`, at the place of each fault, all at once; `table`.
pub fn read(text: &str) -> Result<Vec<ReadKey>, Faults> {
    let rows = csv::rows(text)?;
    let mut faults = Faults::default();
    let head: Vec<String> =
        rows.first().map(|r| r.iter().map(|c| c.text.to_lowercase()).collect()).unwrap_or_default();
    let column = |name: &str| head.iter().position(|h| h == name);
    let missing: Vec<&str> =
        HEAD[2..6].iter().copied().chain(["variant"]).filter(|n| column(n).is_none()).collect();
    if !missing.is_empty() {
        let message = both!("the keys have no column {}", crate::diag::Both::names(&missing));
        return Err(Diagnostic::error("keys", message)
            .help(both!("name the answers.csv that `hodograph variants` has written"))
            .into());
    }
    let mut all = Vec::new();
    for row in rows.iter().skip(1) {
        let cell = |name: &str| {
            column(name).and_then(|k| row.get(k)).cloned().unwrap_or_else(|| TableCell {
                at: row.last().map_or_else(Default::default, |c| c.at),
                ..TableCell::default()
            })
        };
        match entry(&cell) {
            Ok(key) => all.push(key),
            Err(list) => list.into_iter().for_each(|d| faults.push(d)),
        }
    }
    if faults.has_errors() { Err(faults) } else { Ok(all) }
}

fn entry(cell: &impl Fn(&str) -> TableCell) -> Result<ReadKey, Vec<Diagnostic>> {
    let mut faults = Vec::new();
    let mut wrong = |name: &str| {
        let c = cell(name);
        let message = both!("`{}` is no {name}", c.text);
        faults.push(Diagnostic::error("keys", message).at(c.at));
    };
    let finite = |name: &str| cell(name).text.parse::<f64>().ok().filter(|v| v.is_finite());
    let variant = cell("variant").text.parse::<usize>().ok();
    let (value, tolerance) = (finite("value"), finite("tolerance").filter(|t| *t >= 0.0));
    let unit = cell("unit").text;
    let kind = kind_of(&unit);
    let question = cell("question").text;
    let mistakes: Option<Vec<TypicalError>> = cell("mistakes")
        .text
        .split(';')
        .filter(|m| !m.trim().is_empty())
        .map(read_mistake)
        .collect();
    for (bad, name) in [
        (variant.is_none(), "variant"),
        (value.is_none(), "value"),
        (tolerance.is_none(), "tolerance"),
        (kind.is_none(), "unit"),
        (question.is_empty(), "question"),
        (mistakes.is_none(), "mistakes"),
    ] {
        if bad {
            wrong(name);
        }
    }
    match (variant, value, tolerance, kind, mistakes) {
        (Some(variant), Some(value), Some(tolerance), Some(kind), Some(mistakes))
            if faults.is_empty() =>
        {
            let student = Some(cell("student").text).filter(|s| !s.is_empty());
            let entry = KeyEntry { question, kind, unit, value, tolerance, mistakes };
            Ok(ReadKey { variant, student, entry })
        }
        _ => Err(faults),
    }
}

fn read_mistake(text: &str) -> Option<TypicalError> {
    let (rest, value) = text.trim().rsplit_once('=')?;
    let (name, place) = rest.split_once('@')?;
    let mistake = Mistake::ALL.into_iter().find(|m| m.name() == name)?;
    let place = match place.strip_prefix("link ") {
        Some(link) => ErrorPlace::Link(link.to_owned()),
        None => ErrorPlace::Point(place.to_owned()),
    };
    Some(TypicalError { mistake, place, value: value.trim().parse().ok()? })
}

/// Returns the kind of quantity with a unit; numbers have none.
pub(super) fn kind_of(unit: &str) -> Option<Kind> {
    if unit.is_empty() {
        return Some(Kind::Number);
    }
    let mut kinds = Kind::ALL.into_iter().chain([Kind::Time]);
    kinds.find(|kind| BookUnit::read(&ascii(unit), *kind).is_ok())
}
