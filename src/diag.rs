//! Diagnostics as values: every fault of an input, with its place, collected in one run.
//!
//! A stage that finds faults pushes them into a [`Faults`] and goes on as long as it can; only the command line
//! prints them. A [`Diagnostic`] says what is wrong, where, what would be right (`help`), and how grave it is.

use std::fmt;

/// A place in the scene file: byte offsets, end exclusive.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Span {
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

impl Span {
    /// The bytes `start..end`.
    pub const fn new(start: usize, end: usize) -> Self {
        Span { start, end }
    }
}

/// How grave a diagnostic is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The result stands; the reader should know.
    Note,
    /// The result stands, but something in the scene is doubtful.
    Warning,
    /// There is no result.
    Error,
}

/// One fault or remark.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// How grave.
    pub severity: Severity,
    /// A stable word for programs, such as `unknown-key`, `dead-centre`, `cannot-assemble`.
    pub code: &'static str,
    /// What is wrong, in one sentence, with the value.
    pub message: String,
    /// Where in the file; `None` where the fault belongs to no single place.
    pub span: Option<Span>,
    /// What to do.
    pub help: Option<String>,
}

impl Diagnostic {
    /// An error.
    pub fn error(code: &'static str, message: impl Into<String>) -> Self {
        Diagnostic { severity: Severity::Error, code, message: bounded(message.into()), span: None, help: None }
    }

    /// A warning.
    pub fn warning(code: &'static str, message: impl Into<String>) -> Self {
        Diagnostic { severity: Severity::Warning, ..Self::error(code, message) }
    }

    /// A note.
    pub fn note(code: &'static str, message: impl Into<String>) -> Self {
        Diagnostic { severity: Severity::Note, ..Self::error(code, message) }
    }

    /// The same, at a place.
    pub fn at(mut self, span: Span) -> Self {
        self.span = Some(span);
        self
    }

    /// The same, with advice.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(bounded(help.into()));
        self
    }
}

/// A sentence shorter than this is told as it is.
const LONG: usize = 300;
/// A longer word between backticks is told by its beginning, its end and its length.
const LONGEST_WORD: usize = 80;
/// What remains of its beginning.
const HEAD: usize = 40;
/// The same of its end.
const TAIL: usize = 20;
/// Longest sentence, in characters.
const LONGEST: usize = 1200;

/// A sentence in which no name of the input is told whole that nobody would read whole: a file of two megabytes may be one name, and
/// thousands of faults may tell it.
fn bounded(text: String) -> String {
    if text.len() <= LONG {
        return text;
    }
    let count = text.split('`').count();
    let quoted = |k: usize| k % 2 == 1 && k + 1 < count;
    let word = |(k, part): (usize, &str)| if quoted(k) { shortened(part) } else { part.to_owned() };
    let text = text.split('`').enumerate().map(word).collect::<Vec<_>>().join("`");
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}… ({} characters)", &text[..end], text.chars().count()),
        None => text,
    }
}

/// A text by its beginning, its end and its length, where it is long.
pub fn shortened(text: &str) -> String {
    let count = if text.len() > LONGEST_WORD { text.chars().count() } else { 0 };
    if count <= LONGEST_WORD {
        return text.to_owned();
    }
    let head: String = text.chars().take(HEAD).collect();
    let tail: String = text.chars().skip(count - TAIL).collect();
    format!("{head}…{tail} ({count} characters)")
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.message)?;
        if let Some(h) = &self.help {
            write!(f, " ({h})")?;
        }
        Ok(())
    }
}

/// The diagnostics of one run, in the order in which they were found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Faults {
    /// All of them.
    pub list: Vec<Diagnostic>,
}

impl Faults {
    /// Adds one.
    pub fn push(&mut self, d: Diagnostic) {
        self.list.push(d);
    }

    /// Whether any is an error.
    pub fn has_errors(&self) -> bool {
        self.list.iter().any(|d| d.severity == Severity::Error)
    }
}

impl From<Diagnostic> for Faults {
    fn from(d: Diagnostic) -> Self {
        Faults { list: vec![d] }
    }
}

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, d) in self.list.iter().enumerate() {
            if i > 0 {
                writeln!(f)?;
            }
            write!(f, "{d}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Faults {}

/// A value with the warnings and notes that travel with it.
#[derive(Clone, Debug, PartialEq)]
pub struct Warned<T> {
    /// The value.
    pub value: T,
    /// Warnings and notes, never errors.
    pub notes: Vec<Diagnostic>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn huge_names_are_told_by_their_ends() {
        let name = "x".repeat(200_000);
        let d = Diagnostic::error("name", format!("`{name}` cannot name a point, `B` can")).help(format!("not `{name}`"));
        assert!(d.message.len() < 200 && d.message.contains("(200000 characters)") && d.message.contains("`B` can"), "{}", d.message);
        assert!(d.help.is_some_and(|h| h.len() < 200));
        // What has no backticks, or only one, is cut.
        for text in [name.clone(), format!("`{name}"), format!("é{name}`")] {
            assert!(Diagnostic::note("name", text).message.len() < 2 * LONGEST);
        }
        let usual = "`l_AB` is 100 mm".to_owned();
        assert_eq!(Diagnostic::error("x", usual.clone()).message, usual);
    }
}
