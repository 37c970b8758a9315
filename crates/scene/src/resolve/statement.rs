//! The section `statement`: words, mathematics between dollar signs, values of parameters in
//! braces.
//!
//! This module separates formulas from dollar signs and writes the values of parameters. The
//! typesetting modules check the formulas themselves.

use super::*;
use crate::book::Book;
use crate::expr::is_name;
use crate::statement::{Run, Statement};
use crate::written::{QuantityText, as_written};
use hodograph_base::kind::Kind;

pub(super) fn statement(
    raw: &RawScene,
    parameters: &[(String, GivenQuantity)],
    values: &Values,
    source: &str,
    faults: &mut Faults,
) -> Option<Statement> {
    let raw = raw.statement.as_ref()?;
    let mut read =
        |word: &Word| StatementReader { parameters, values, word, source, faults }.text();
    match (&raw.en, &raw.zh) {
        (Some(en), Some(zh)) if en.span == zh.span => {
            Some(read(en)).map(|both| Statement { en: both.clone(), zh: both })
        }
        (Some(en), Some(zh)) => Some(Statement { en: read(en), zh: read(zh) }),
        (Some(one), None) | (None, Some(one)) => {
            Some(read(one)).map(|both| Statement { en: both.clone(), zh: both })
        }
        (None, None) => None,
    }
}

/// Deepest nesting of braces: typesetting is recursive.
const DEEPEST: usize = 24;

/// Reader of one text.
struct StatementReader<'a, 'f> {
    parameters: &'a [(String, GivenQuantity)],
    values: &'a Values<'a>,
    word: &'a Word,
    source: &'a str,
    faults: &'f mut Faults,
}

impl<'a> StatementReader<'a, '_> {
    /// Returns its paragraphs, one per line.
    fn text(&mut self) -> Vec<Vec<Run>> {
        let text = &self.word.text;
        let mut from = 0;
        let mut paragraphs = Vec::new();
        for line in text.split_inclusive('\n') {
            paragraphs.push(self.line(from, from + line.trim_end().len()));
            from += line.len();
        }
        paragraphs.retain(|p| !p.is_empty());
        paragraphs
    }

    /// Returns the runs between two bytes of the text.
    fn line(&mut self, from: usize, to: usize) -> Vec<Run> {
        let line = &self.word.text[..to];
        let (mut runs, mut words) = (Vec::new(), String::new());
        let mut at = from;
        while let Some(c) = line[at..].chars().next() {
            let rest = &line[at..];
            let after = at + c.len_utf8();
            let (mut taken, mut plain) = (c.len_utf8(), c.to_string());
            let mut formula = None;
            match c {
                '\\' if rest[1..].starts_with('$') => (taken, plain) = (2, "$".into()),
                '{' if rest.starts_with("{{") => (taken, plain) = (2, "{".into()),
                '}' if rest.starts_with("}}") => (taken, plain) = (2, "}".into()),
                '$' => {
                    if let Some(end) = closing(&line[after..]) {
                        let place = (after, after + end);
                        formula = self
                            .shallow(place)
                            .map(|inner| (self.with_values(inner, after), place));
                        taken = end + 2;
                    }
                }
                '{' => {
                    if let Some(name) = braced(rest) {
                        taken = name.len() + 2;
                        let place = (at, at + taken);
                        match self.value(name) {
                            Some(value) => formula = Some((value, place)),
                            None => self.unknown(name, place),
                        }
                    }
                }
                _ => {}
            }
            at += taken;
            match formula {
                None => words += &plain,
                Some((formula, place)) => {
                    push_words(&mut runs, &mut words);
                    runs.push(Run::Formula(formula, self.place(place)));
                }
            }
        }
        push_words(&mut runs, &mut words);
        trimmed(runs)
    }

    /// Returns the formula at a place, if its braces are not nested too deeply.
    fn shallow(&mut self, place: (usize, usize)) -> Option<&'a str> {
        let word: &'a Word = self.word;
        let inner = &word.text[place.0..place.1];
        let mut depth = 0usize;
        for c in inner.chars() {
            match c {
                '{' => depth += 1,
                '}' => depth = depth.saturating_sub(1),
                _ => {}
            }
            if depth > DEEPEST {
                let message = both!("braces of a formula are nested more than {DEEPEST} deep");
                self.faults.push(Diagnostic::error("formula", message).at(self.place(place)));
                return None;
            }
        }
        Some(inner)
    }

    /// Returns a formula that begins at byte `from` of the text, with each parameter in braces
    /// replaced by its value.
    fn with_values(&mut self, formula: &str, from: usize) -> String {
        let mut out = String::new();
        let mut at = 0;
        while let Some(c) = formula[at..].chars().next() {
            match braced(&formula[at..]).filter(|_| stands_alone(&out)) {
                Some(name) => {
                    let to = at + name.len() + 2;
                    match self.value(name) {
                        Some(value) => out += &value,
                        None => self.unknown(name, (from + at, from + to)),
                    }
                    at = to;
                }
                None => {
                    out.push(c);
                    at += c.len_utf8();
                }
            }
        }
        out
    }

    /// Returns the value of a parameter as written, in the label language: `120 mm`, `60\degree`.
    fn value(&self, name: &str) -> Option<String> {
        let (_, given) = self.parameters.iter().rev().find(|p| p.0 == name)?;
        let dim = self.values.dim(name)?;
        let text = given.text.trim();
        let number =
            |value: f64| hodograph_base::digits::inked(&hodograph_base::digits::shortest(value));
        let Some(kind) =
            Kind::ALL.into_iter().find(|kind| dim == RequiredQuantity::of(*kind).dim())
        else {
            let bare = text.parse::<f64>().is_ok();
            return Some(match (bare, dim == RequiredQuantity::ScaleOfLengths.dim()) {
                (true, _) => hodograph_base::digits::inked(text),
                (false, true) => number(given.value),
                (false, false) => format!("\\text{{{}}}", text.replace(['{', '}'], "")),
            });
        };
        // As written, independent of the units of the answers.
        Some(match as_written(self.parameters, kind, text, given.value) {
            QuantityText::AsWritten(digits, unit) => {
                unit.label(&hodograph_base::digits::inked(&digits.replace('E', "e")))
            }
            QuantityText::Computed(value, unit) => unit.label(&number(rounded(value))),
            QuantityText::Usual => {
                let book = Book::default();
                book.label(kind, &number(rounded(book.value(kind, given.value))))
            }
        })
    }

    fn unknown(&mut self, name: &str, place: (usize, usize)) {
        // A parameter with a fault has already been reported.
        if self.values.has_name(name) {
            return;
        }
        let d = Diagnostic::error(
            "unknown-parameter",
            both!("`{{{name}}}` in the statement names no parameter"),
        )
        .at(self.place(place));
        let known = self.parameters.iter().map(|p| p.0.as_str());
        let there = if self.parameters.is_empty() {
            both!("the scene has no \"parameters\"")
        } else {
            suggest(name, known, both!("the parameters are"))
        };
        self.faults.push(
            d.help(both!("{}; braces that are to be printed are doubled: `{{{{{name}}}}}`", there)),
        );
    }

    /// Converts a place in the text to a place in the file; for a string with escapes, the place of
    /// the whole text.
    fn place(&self, (from, to): (usize, usize)) -> Span {
        let Span { start, end } = self.word.span;
        let in_step =
            self.source.get(start + 1..end.saturating_sub(1)) == Some(self.word.text.as_str());
        if in_step { Span::new(start + 1 + from, start + 1 + to) } else { self.word.span }
    }
}

/// Returns a computed value with the six digits that a reader needs.
fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// Returns true if braces after this part of a formula are not the argument of a script or a
/// command.
fn stands_alone(before: &str) -> bool {
    let before = before.trim_end();
    !before.ends_with(['_', '^'])
        && !before.trim_end_matches(|c: char| c.is_ascii_alphabetic()).ends_with('\\')
}

/// Returns the end of the formula that begins here: the next dollar sign in the line, provided that
/// it follows no space and precedes no digit. `None`: the opening dollar sign is an ordinary
/// character. These are the rules of Pandoc's Markdown, under which prices remain text.
fn closing(text: &str) -> Option<usize> {
    if text.starts_with(|c: char| c.is_whitespace() || c == '$') {
        return None;
    }
    let ends = |i: &usize| {
        let before = text[..*i].chars().next_back();
        let after = text[*i + 1..].chars().next();
        before.is_some_and(|c| !c.is_whitespace() && c != '\\')
            && !after.is_some_and(|c| c.is_ascii_digit())
    };
    text.find('$').filter(ends)
}

/// Returns the name in braces at the beginning of a text.
fn braced(text: &str) -> Option<&str> {
    let inner = text.strip_prefix('{')?;
    let name = &inner[..inner.find('}')?];
    is_name(name).then_some(name)
}

fn push_words(runs: &mut Vec<Run>, words: &mut String) {
    let text = std::mem::take(words);
    if text.is_empty() {
        return;
    }
    // A run of spaces counts as one.
    let mut one = String::with_capacity(text.len());
    for c in text.chars() {
        match (c.is_whitespace(), one.ends_with(' ')) {
            (true, true) => {}
            (true, false) => one.push(' '),
            (false, _) => one.push(c),
        }
    }
    runs.push(Run::Words(one));
}

/// Returns a paragraph without spaces at its ends.
fn trimmed(mut runs: Vec<Run>) -> Vec<Run> {
    if let Some(Run::Words(first)) = runs.first_mut() {
        *first = first.trim_start().to_owned();
    }
    if let Some(Run::Words(last)) = runs.last_mut() {
        *last = last.trim_end().to_owned();
    }
    runs.retain(|run| !matches!(run, Run::Words(words) if words.is_empty()));
    runs
}
