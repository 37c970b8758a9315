//! The table of readings: for each interpretation of the problem the answers, correct and by the
//! wrong equations that the scene names, compared with the printed values.

use hodograph_base::digits::{direction_degrees, legible};
use hodograph_base::lang::{say, tr};
use hodograph_mechanism::answer::AnswerValue;
use hodograph_methods::attempts::Attempt;
use hodograph_scene::{Find, Lang, Scene};
use hodograph_worked::worked::Worked;
use serde_json::{Value as Json, json};
use unicode_width::UnicodeWidthStr;

/// Digits of the table.
const DIGITS: usize = 5;
/// Largest relative difference at which a printed number, rounded to two or three digits, is
/// attributed to a reading.
const GIVES: f64 = 0.006;

/// One reading with its solution.
pub struct SolvedReading {
    /// Name of the reading; empty for the unchanged file.
    pub name: String,
    /// Scene of the reading.
    pub scene: Scene,
    /// Solution of the scene.
    pub worked: Worked,
    /// The wrong solutions named in the scene.
    pub attempts: Vec<Attempt>,
}

/// One line: a question, the way it is answered, the answer, and a flag if it equals the printed
/// value.
struct ReadingLine {
    find: Find,
    by: Option<&'static str>,
    value: AnswerValue,
    gives: Option<bool>,
}

fn lines(r: &SolvedReading) -> Vec<ReadingLine> {
    let printed = |text: &str| {
        r.scene
            .attempts
            .iter()
            .flat_map(|a| &a.printed)
            .find(|(f, _)| f.text == text)
            .map(|(_, v)| v.value)
    };
    let line = |find: &Find, by, value: AnswerValue| ReadingLine {
        find: find.clone(),
        by,
        value,
        gives: printed(&find.text).map(|p| gives(p, value)),
    };
    let right = r.worked.results.iter().map(|o| line(&r.scene.find[o.find], None, o.value()));
    let wrong = r.attempts.iter().flat_map(|a| {
        let row = |row: &hodograph_methods::attempts::AttemptAnswer| {
            Some(line(
                &r.scene.find[r.worked.results[row.result].find],
                Some(a.site.mistake().name()),
                row.wrong?,
            ))
        };
        a.rows.iter().filter_map(row).collect::<Vec<_>>()
    });
    right.chain(wrong).collect()
}

fn gives(printed: f64, value: AnswerValue) -> bool {
    let value = match value {
        AnswerValue::Scalar(s) => s,
        AnswerValue::Vector(v) => v.norm(),
        AnswerValue::Point(_) => return false,
    };
    (printed - value).abs() <= GIVES * printed.abs()
}

fn value_words(scene: &Scene, find: &Find, value: AnswerValue) -> String {
    let (kind, book) = (find.what.kind(), &scene.book);
    match value {
        AnswerValue::Scalar(s) => book.text(kind, &legible(book.value(kind, s), DIGITS)),
        AnswerValue::Vector(v) => {
            let size = book.text(kind, &legible(book.value(kind, v.norm()), DIGITS));
            if v.norm() == 0.0 {
                size
            } else {
                format!("{size} ∠ {}°", legible(direction_degrees(v.angle()), DIGITS))
            }
        }
        AnswerValue::Point(p) => {
            let number = |c: f64| legible(book.value(kind, c), DIGITS);
            book.text(kind, &format!("({}, {})", number(p.x), number(p.y)))
        }
    }
}

/// Returns the table as text: a column for each reading; a star marks values that agree with print.
pub fn text(all: &[SolvedReading], lang: Lang) -> String {
    let name = |r: &SolvedReading| match r.name.as_str() {
        "" => tr!(lang, "as given").to_owned(),
        name => say!(lang, "reading {name}"),
    };
    let mut rows: Vec<Vec<String>> =
        vec![std::iter::once(String::new()).chain(all.iter().map(name)).collect()];
    let each: Vec<Vec<ReadingLine>> = all.iter().map(lines).collect();
    let mut keys: Vec<(String, Option<&'static str>)> = Vec::new();
    for line in each.iter().flatten() {
        let key = (line.find.text.clone(), line.by);
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    let mut starred = false;
    for (find, by) in keys {
        let head = by.map_or(find.clone(), |by| format!("{find} ({by})"));
        let mut row = vec![head];
        for (r, lines) in all.iter().zip(&each) {
            let found = lines.iter().find(|l| l.find.text == find && l.by == by);
            let star = found.is_some_and(|l| l.gives == Some(true));
            starred |= star;
            row.push(found.map_or("–".to_owned(), |l| {
                format!(
                    "{}{}",
                    value_words(&r.scene, &l.find, l.value),
                    if star { " *" } else { "" }
                )
            }));
        }
        rows.push(row);
    }
    let many = rows[0].len();
    let widths: Vec<usize> =
        (0..many).map(|k| rows.iter().map(|r| r[k].width()).max().unwrap_or(0)).collect();
    let cell = |(k, text): (usize, &String)| {
        format!("{text}{}", " ".repeat(widths[k].saturating_sub(text.width())))
    };
    let line = |row: &Vec<String>| {
        format!("{}\n", row.iter().enumerate().map(cell).collect::<Vec<_>>().join("  ").trim_end())
    };
    let title = all.first().map_or("", |r| lang.of(&r.scene.title));
    let mut out = if title.is_empty() { String::new() } else { format!("{title}\n") };
    out.extend(rows.iter().map(line));
    out +=
        match (starred, all.iter().any(|r| r.scene.attempts.iter().any(|a| !a.printed.is_empty())))
        {
            (true, _) => tr!(lang, "* what was printed\n"),
            (false, true) => {
                tr!(lang, "no reading gives what was printed\n")
            }
            (false, false) => "",
        };
    out
}

/// Returns the table as JSON, in SI.
pub fn json(all: &[SolvedReading]) -> Json {
    let value = |v: AnswerValue| match v {
        AnswerValue::Scalar(s) => json!(s),
        AnswerValue::Vector(v) => json!([v.x, v.y]),
        AnswerValue::Point(p) => json!([p.x, p.y]),
    };
    let line = |l: &ReadingLine| json!({"find": l.find.text, "by": l.by, "value": value(l.value), "gives_printed": l.gives});
    let one = |r: &SolvedReading| json!({"reading": r.name, "answers": lines(r).iter().map(line).collect::<Vec<_>>()});
    json!({"schema": "hodograph/readings/1", "readings": all.iter().map(one).collect::<Vec<_>>()})
}
