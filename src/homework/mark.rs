//! The marks of a class: each answer against its key, with partial credit and the likely mistake.
//!
//! An answer within the tolerance of the pencil has the full mark. Half of it is left for the right
//! size with the wrong sense, for an inaccurate drawing (up to three tolerances), and for a factor
//! between units; a quarter for the value of a typical mistake, which is named.

use super::csv::{self, TableCell};
use super::keys::{self, ReadKey, ascii};
use super::{KeyEntry, TypicalError};
use crate::diag::{Both, Diagnostic, Faults, both};
use crate::digits::significant;
use crate::scene::Lang;
use crate::scene::book::BookUnit;
use std::collections::{BTreeMap, BTreeSet};

/// Marks in part.
pub(super) const HALF: f64 = 0.5;
const QUARTER: f64 = 0.25;
/// An inaccurate drawing: up to this number of tolerances.
pub(super) const INACCURATE: f64 = 3.0;
/// The rounding of a key and of an answer at the edge of the tolerance, as a part of it.
const EDGE: f64 = 1e-6;
/// Factors between units that are mixed up: prefixes; degrees and radians, revolutions and radians;
/// minutes and seconds.
const SLIPS: [f64; 5] = [1000.0, 100.0, 180.0 / std::f64::consts::PI, std::f64::consts::TAU, 60.0];

/// An answer with its mark.
#[derive(Clone, Debug, PartialEq)]
pub struct MarkedAnswer {
    /// The student.
    pub student: String,
    /// The variant.
    pub variant: usize,
    /// The question.
    pub question: String,
    /// The mark, from 0 to 1.
    pub mark: f64,
    /// The reason for a mark below 1.
    pub remark: Both,
}

/// The marks of a class, student by student, in the order of the answers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MarkList {
    /// The marks; questions without an answer have one too.
    pub marks: Vec<MarkedAnswer>,
}

/// Faults of the two tables, with places in the text of each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MarkFaults {
    /// Faults of the answers.
    pub answers: Faults,
    /// Faults of the keys.
    pub keys: Faults,
}

/// The keys of each variant.
type VariantKeys<'a> = BTreeMap<usize, Vec<&'a ReadKey>>;

/// Marks the answers of a class.
///
/// ```
/// use hodograph::homework::mark;
/// let keys = "variant,question,value,unit,tolerance,mistakes\n1,omega_3,2.5,rad/s,0.05,\n";
/// let answers = "student,variant,question,value,unit\nAda,1,omega_3,2.52 ccw,rad/s\n";
/// assert_eq!(mark(answers, keys).unwrap().marks[0].mark, 1.0);
/// ```
///
/// # Errors
/// `answers` and `keys`: rows that cannot be read or do not fit, all at once.
pub fn mark(answers: &str, keys: &str) -> Result<MarkList, MarkFaults> {
    let keys = keys::read(keys);
    let rows = csv::rows(answers);
    let (keys, rows) = match (keys, rows) {
        (Ok(keys), Ok(rows)) => (keys, rows),
        (keys, rows) => {
            return Err(MarkFaults {
                answers: rows.err().unwrap_or_default(),
                keys: keys.err().unwrap_or_default(),
            });
        }
    };
    let mut by_variant: VariantKeys = BTreeMap::new();
    for k in &keys {
        by_variant.entry(k.variant).or_default().push(k);
    }
    let given = given(&rows, &by_variant)
        .map_err(|answers| MarkFaults { answers, keys: Faults::default() })?;
    let (mut sheets, mut seen) = (Vec::new(), BTreeSet::new());
    let mut values: BTreeMap<(&str, usize, &str), Option<f64>> = BTreeMap::new();
    for g in &given {
        let sheet = (g.student.as_str(), g.variant);
        if seen.insert(sheet) {
            sheets.push(sheet);
        }
        values.insert((sheet.0, sheet.1, &g.question), g.value);
    }
    let mut marks = Vec::new();
    for (student, variant) in sheets {
        for k in by_variant.get(&variant).into_iter().flatten() {
            let answer = values.get(&(student, variant, k.entry.question.as_str()));
            let (mark, remark) = match answer.copied().flatten() {
                Some(value) => judged(value, &k.entry),
                None => (0.0, both!("no answer")),
            };
            let question = k.entry.question.clone();
            marks.push(MarkedAnswer {
                student: student.to_owned(),
                variant,
                question,
                mark,
                remark,
            });
        }
    }
    Ok(MarkList { marks })
}

impl MarkList {
    /// Writes the marks as a table, with a row `total` for each student.
    pub fn csv(&self, lang: Lang) -> String {
        let mut out = csv::line(&["student", "variant", "question", "mark", "remark"]);
        let sheet = |m: &MarkedAnswer| (m.student.clone(), m.variant);
        for marks in self.marks.chunk_by(|a, b| sheet(a) == sheet(b)) {
            let mut row = |m: &MarkedAnswer, question: &str, mark: f64, remark: &Both| {
                let (number, mark) = (m.variant.to_string(), keys::number(mark));
                let cells = [m.student.as_str(), &number, question, &mark, lang.of(remark)];
                out += &csv::line(&cells);
            };
            marks.iter().for_each(|m| row(m, &m.question, m.mark, &m.remark));
            let (sum, count) = (marks.iter().map(|m| m.mark).sum(), marks.len());
            if let Some(first) = marks.first() {
                row(first, "total", sum, &both!("of {count}"));
            }
        }
        out
    }
}

/// Returns the mark of a value, with the reason.
fn judged(value: f64, key: &KeyEntry) -> (f64, Both) {
    let within = key.tolerance * (1.0 + EDGE) + key.value.abs() * EDGE;
    // Angles in degrees are equal after a full turn.
    let off = |from: f64| match key.unit.as_str() {
        "deg" => {
            let turn = (value - from).rem_euclid(360.0);
            turn.min(360.0 - turn)
        }
        _ => (value - from).abs(),
    };
    let miss = off(key.value);
    if miss <= within {
        return (1.0, Both::default());
    }
    if off(-key.value) <= within {
        let words =
            if key.kind.turns() { both!("the sense is wrong") } else { both!("the sign is wrong") };
        return (HALF, words);
    }
    // With the sense of the mistake, then with the other one, which is a mistake more.
    let likely = [1.0, -1.0].into_iter().find_map(|sign| {
        let by = |m: &TypicalError| off(sign * m.value);
        let nearest = key.mistakes.iter().min_by(|a, b| by(a).total_cmp(&by(b)));
        nearest.filter(|m| by(m) <= within && by(m) < miss)
    });
    if let Some(m) = likely {
        return (QUARTER, both!("likely mistake: {}", m.words()));
    }
    if miss <= INACCURATE * within {
        let [miss, within] = [miss, key.tolerance].map(|v| significant(v, 2));
        return (HALF, both!("inaccurate: off by {miss}, allowed {within}"));
    }
    let part = key.tolerance / key.value.abs().max(f64::MIN_POSITIVE);
    let slip = |f: &&f64| {
        [value * **f, value / **f].iter().any(|v| (v.abs() / key.value.abs() - 1.0).abs() <= part)
    };
    match SLIPS.iter().find(slip) {
        Some(factor) => {
            let factor = significant(*factor, 3);
            let factor = if factor.contains('.') {
                factor.trim_end_matches('0').trim_end_matches('.').to_owned()
            } else {
                factor
            };
            (HALF, both!("unit mixed up: a factor of {factor}"))
        }
        None => (0.0, both!("wrong value")),
    }
}

/// A row of the answers; the value is in the unit of the key.
struct GivenAnswer {
    student: String,
    variant: usize,
    question: String,
    value: Option<f64>,
}

/// The columns of the answers, with their names in both languages.
const COLUMNS: [[&str; 3]; 5] = [
    ["student", "学生", "姓名"],
    ["variant", "题号", "变式"],
    ["question", "量", "问题"],
    ["value", "值", "数值"],
    ["unit", "单位", "单位"],
];

fn fault(message: Both, cell: &TableCell) -> Diagnostic {
    Diagnostic::error("answers", message).at(cell.at)
}

fn given(rows: &[Vec<TableCell>], keys: &VariantKeys) -> Result<Vec<GivenAnswer>, Faults> {
    let mut faults = Faults::default();
    let head = rows.first().map(Vec::as_slice).unwrap_or_default();
    let column = |names: &[&str; 3]| {
        head.iter().position(|c| names.contains(&c.text.to_lowercase().as_str()))
    };
    let places = COLUMNS.map(|names| column(&names));
    let missing: Vec<&str> = COLUMNS
        .iter()
        .zip(&places)
        .take(4)
        .filter(|(_, p)| p.is_none())
        .map(|(n, _)| n[0])
        .collect();
    if !missing.is_empty() {
        let message = both!("the answers have no column {}", Both::names(&missing));
        return Err(Diagnostic::error("answers", message)
            .help(both!("the first line names the columns: student,variant,question,value,unit"))
            .into());
    }
    let (mut all, mut seen): (Vec<GivenAnswer>, _) = (Vec::new(), BTreeSet::new());
    for row in rows.iter().skip(1) {
        let cells = places.map(|p| {
            p.and_then(|p| row.get(p)).cloned().unwrap_or_else(|| TableCell {
                at: row.last().map_or_else(Default::default, |c| c.at),
                ..TableCell::default()
            })
        });
        match answer(&cells, keys) {
            Ok(a) => {
                if !seen.insert((a.student.clone(), a.variant, a.question.clone())) {
                    let message = both!("{} answers {} twice", a.student, a.question);
                    faults.push(fault(message, &cells[2]));
                }
                all.push(a);
            }
            Err(list) => list.into_iter().for_each(|d| faults.push(d)),
        }
    }
    if faults.has_errors() { Err(faults) } else { Ok(all) }
}

fn answer(cells: &[TableCell; 5], keys: &VariantKeys) -> Result<GivenAnswer, Vec<Diagnostic>> {
    let [student, variant, question, value, unit] = cells;
    let mut faults = Vec::new();
    if student.text.is_empty() {
        faults.push(fault(both!("the row has no student"), student));
    }
    let number = variant.text.parse::<usize>().ok();
    let of_variant = number.and_then(|n| keys.get(&n)).map(Vec::as_slice).unwrap_or_default();
    let owner = of_variant.iter().find_map(|k| k.student.as_ref());
    if of_variant.is_empty() {
        let message = both!("there is no variant `{}`", variant.text);
        faults.push(fault(message, variant));
    } else if let Some(owner) = owner.filter(|o| **o != student.text) {
        let message = both!("variant {} is that of {owner}, not of {}", variant.text, student.text);
        faults.push(fault(message, variant));
    }
    let key = of_variant.iter().find(|k| k.entry.question == question.text);
    if key.is_none() && !of_variant.is_empty() {
        let names: Vec<&str> = of_variant.iter().map(|k| k.entry.question.as_str()).collect();
        let message = both!("the variant has no question `{}`", question.text);
        faults.push(
            fault(message, question).help(both!("its questions are {}", Both::names(&names))),
        );
    }
    let read = key.map(|k| in_unit_of(&k.entry, value, unit));
    let value = match read {
        Some(Ok(value)) => value,
        Some(Err(d)) => {
            faults.push(d);
            None
        }
        None => None,
    };
    if faults.is_empty() {
        Ok(GivenAnswer {
            student: student.text.clone(),
            variant: number.unwrap_or_default(),
            question: question.text.clone(),
            value,
        })
    } else {
        Err(faults)
    }
}

/// Words for a sense of rotation: clockwise first.
const CLOCKWISE: [&str; 5] = ["clockwise", "cw", "顺时针", "顺", "↻"];
const COUNTER: [&str; 9] = [
    "counter-clockwise",
    "counterclockwise",
    "anticlockwise",
    "anti-clockwise",
    "ccw",
    "acw",
    "逆时针",
    "逆",
    "↺",
];

/// Returns an answer in the unit of its key; `None` for an empty cell.
fn in_unit_of(
    key: &KeyEntry,
    value: &TableCell,
    unit: &TableCell,
) -> Result<Option<f64>, Diagnostic> {
    let text = value.text.trim().to_lowercase().replace('−', "-");
    if text.is_empty() {
        return Ok(None);
    }
    let strip = |words: &[&str]| {
        words.iter().find_map(|w| text.strip_suffix(w).or_else(|| text.strip_prefix(w)))
    };
    // `ccw` ends in `cw`, so that counter-clockwise is tried first.
    let (number, sense) = match strip(&COUNTER) {
        Some(rest) => (rest, Some(1.0)),
        None => match strip(&CLOCKWISE) {
            Some(rest) => (rest, Some(-1.0)),
            None => (text.as_str(), None),
        },
    };
    let Some(size) = number.trim().parse::<f64>().ok().filter(|v| v.is_finite()) else {
        let message = both!("`{}` is no number", value.text);
        let d = fault(message, value);
        return Err(if text.contains(',') {
            d.help(both!("write a decimal point: 12.3"))
        } else {
            d.help(both!("write a number such as -12.3 or 12.3 cw (clockwise)"))
        });
    };
    if sense.is_some() && !key.kind.turns() {
        let message = both!("{} has no sense of rotation", key.question);
        return Err(fault(message, value));
    }
    let signed = sense.map_or(size, |s| s * size.abs());
    if unit.text.is_empty() || ascii(&unit.text) == key.unit {
        return Ok(Some(signed));
    }
    let [from, to] = [&ascii(&unit.text), &key.unit].map(|u| BookUnit::read(u, key.kind));
    match (from, to) {
        (Ok(from), Ok(to)) => Ok(Some(signed * to.of(1.0) / from.of(1.0))),
        (Err(fitting), _) | (_, Err(fitting)) => {
            let message = both!("`{}` is no unit of {}", unit.text, key.question);
            let fitting: Vec<String> = fitting.into_iter().take(8).collect();
            let d = fault(message, unit);
            Err(d.help(both!("units are {}", Both::names(&fitting))))
        }
    }
}
