//! Diagnostics as values: every fault of an input, with its position, collected in one run.
//!
//! A stage that finds faults pushes them into a [`Faults`] and continues as far as it can; only the
//! command line prints them. A [`Diagnostic`] states the fault, its position, the remedy (`help`)
//! and its severity.
//!
//! Every message is a [`Both`]: English and Chinese, created together by `both!`; the output code
//! chooses the language. A message without a Chinese text does not compile.

pub mod json;
mod place;

pub use place::LineColumn;
use std::fmt;

/// A position in the scene file: byte offsets, end exclusive.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Span {
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

impl Span {
    /// Returns the span of the bytes `start..end`.
    pub const fn new(start: usize, end: usize) -> Self {
        Span { start, end }
    }
}

/// A text in both languages.
///
/// There is no `Display`: the output code chooses the language.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Both {
    /// The English text.
    pub en: String,
    /// The Chinese text.
    pub zh: String,
}

impl Both {
    /// Returns a text that is the same in both languages: a name, a number, a word of the input.
    pub fn same(text: impl Into<String>) -> Both {
        let en = text.into();
        Both { zh: en.clone(), en }
    }

    /// Returns true if the text is empty.
    pub fn is_empty(&self) -> bool {
        self.en.is_empty() && self.zh.is_empty()
    }

    fn each(self, change: impl Fn(String) -> String) -> Both {
        Both { en: change(self.en), zh: change(self.zh) }
    }

    /// Joins several texts with a separator for each language.
    pub fn join<'a>(all: impl IntoIterator<Item = &'a Both>, [en, zh]: [&str; 2]) -> Both {
        let mut out = Both::default();
        for (i, one) in all.into_iter().enumerate() {
            if i > 0 {
                out.en.push_str(en);
                out.zh.push_str(zh);
            }
            out.en.push_str(&one.en);
            out.zh.push_str(&one.zh);
        }
        out
    }

    /// Joins names, numbers or words of the input: `a, b, c`, in Chinese `a、b、c`.
    pub fn names<T: AsRef<str>>(all: &[T]) -> Both {
        let joined = |mark: &str| all.iter().map(T::as_ref).collect::<Vec<_>>().join(mark);
        Both { en: joined(", "), zh: joined("、") }
    }

    /// Returns the text with the full stop of each language at its end, added if it is missing.
    pub fn sentence(self) -> Both {
        let stopped = |text: String, stop: &str| {
            if text.is_empty() || text.ends_with(['.', '。', ':', '：', '?', '？']) {
                text
            } else {
                text + stop
            }
        };
        Both { en: stopped(self.en, "."), zh: stopped(self.zh, "。") }
    }

    /// Returns an enumeration: `a`, `a and b`, `a, b and c`.
    pub fn listed(all: &[Both]) -> Both {
        match all {
            [] => Both::default(),
            [one] => one.clone(),
            [head @ .., last] => {
                let head = Both::join(head, [", ", "、"]);
                both!("{} and {}", head, last)
            }
        }
    }
}

/// Makes a text of its two languages, English first; see [`each!`](crate::each!).
impl<T: Into<String>> From<[T; 2]> for Both {
    fn from([en, zh]: [T; 2]) -> Both {
        Both { en: en.into(), zh: zh.into() }
    }
}

/// Tests of single stages do not check the Chinese text; the program itself cannot create a message
/// in one language only.
#[cfg(test)]
impl From<&str> for Both {
    fn from(text: &str) -> Both {
        Both::same(text)
    }
}

#[cfg(test)]
impl From<String> for Both {
    fn from(text: String) -> Both {
        Both::same(text)
    }
}

/// A value that `both!` inserts into its sentences: a [`Both`] in the language of the sentence, any
/// other value as it prints.
pub trait Piece {
    /// The type that is inserted.
    type Shown: ?Sized;
    /// Returns the value for an English sentence.
    fn en(&self) -> &Self::Shown;
    /// Returns the value for a Chinese sentence.
    fn zh(&self) -> &Self::Shown;
}

impl<T: fmt::Display + ?Sized> Piece for T {
    type Shown = T;
    fn en(&self) -> &T {
        self
    }
    fn zh(&self) -> &T {
        self
    }
}

impl Piece for Both {
    type Shown = str;
    fn en(&self) -> &str {
        &self.en
    }
    fn zh(&self) -> &str {
        &self.zh
    }
}

impl Piece for &Both {
    type Shown = str;
    fn en(&self) -> &str {
        &self.en
    }
    fn zh(&self) -> &str {
        &self.zh
    }
}

/// Creates a text in both languages, `both!("link {} is too long", name)`: two `format!` sentences
/// and the values of both. The Chinese sentence is that of `po/zh.po` of the crate.
///
/// The Chinese sentence may use the values in another order (`{1}`); a [`Both`] among them is
/// inserted in the language of the sentence. An ending that only English has (`link{}` with an `s`)
/// is dropped with `{1:.0}`. Each value is evaluated once for each language, so it must not be
/// consumed. `both!("cam" => "out")` gives the context of an English text with several translations.
#[macro_export]
macro_rules! both {
    ($context:literal => $en:literal $(, $value:expr)* $(,)?) => {
        $crate::diag::Both {
            en: format!($en $(, $crate::diag::Piece::en(&$value))*),
            zh: $crate::lang::zh_format!($context => $en $(, $crate::diag::Piece::zh(&$value))*),
        }
    };
    ($en:literal $(, $value:expr)* $(,)?) => {
        $crate::diag::Both {
            en: format!($en $(, $crate::diag::Piece::en(&$value))*),
            zh: $crate::lang::zh_format!($en $(, $crate::diag::Piece::zh(&$value))*),
        }
    };
}
pub use both;

/// The severity of a diagnostic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The result is valid; the note informs the reader.
    Note,
    /// The result is valid, but something in the scene is doubtful.
    Warning,
    /// There is no result.
    Error,
}

/// One fault or remark.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// The severity.
    pub severity: Severity,
    /// A stable word for programs, such as `unknown-key`, `dead-centre`, `cannot-assemble`.
    pub code: &'static str,
    /// The fault in one sentence, with the value.
    pub message: Both,
    /// The position in the file; `None` if the fault has no single position.
    pub span: Option<Span>,
    /// The remedy.
    pub help: Option<Both>,
}

impl Diagnostic {
    /// Creates an error.
    pub fn error(code: &'static str, message: impl Into<Both>) -> Self {
        Diagnostic {
            severity: Severity::Error,
            code,
            message: message.into().each(bounded),
            span: None,
            help: None,
        }
    }

    /// Creates a warning.
    pub fn warning(code: &'static str, message: impl Into<Both>) -> Self {
        Diagnostic { severity: Severity::Warning, ..Self::error(code, message) }
    }

    /// Creates a note.
    pub fn note(code: &'static str, message: impl Into<Both>) -> Self {
        Diagnostic { severity: Severity::Note, ..Self::error(code, message) }
    }

    /// Sets the position.
    pub fn at(mut self, span: Span) -> Self {
        self.span = Some(span);
        self
    }

    /// Sets the remedy.
    pub fn help(mut self, help: impl Into<Both>) -> Self {
        self.help = Some(help.into().each(bounded));
        self
    }
}

impl Diagnostic {
    /// Returns English that remains in the Chinese text of the message or of the help: two
    /// lower-case words side by side or an English comma outside quotation marks and brackets, or a
    /// message without a Chinese character. Tests require `None` for every diagnostic.
    pub fn english_in_chinese(&self) -> Option<String> {
        let told = self.message.zh.chars().any(|c| ('\u{4e00}'..='\u{9fff}').contains(&c));
        let all = [Some(&self.message), self.help.as_ref()];
        let left = all.into_iter().flatten().find_map(|text| english(&text.zh));
        left.or_else(|| (!told).then(|| self.message.zh.clone()))
    }
}

/// Returns two lower-case words of Latin letters side by side, outside quotations.
fn english(text: &str) -> Option<String> {
    let unquoted =
        |mark: char, text: &str| text.split(mark).step_by(2).collect::<Vec<_>>().join(" \u{b7} ");
    let text = unquoted('"', &unquoted('`', text));
    let words: Vec<&str> = text.split_whitespace().collect();
    let small = |w: &str| w.len() > 1 && w.bytes().all(|b| b.is_ascii_lowercase());
    let comma = || unbracketed(&text).find(", ").map(|at| unbracketed(&text)[at..].to_owned());
    words.windows(2).find(|w| w.iter().all(|w| small(w))).map(|w| w.join(" ")).or_else(comma)
}

/// Returns the text without bracketed parts: coordinates, lists of JSON.
fn unbracketed(text: &str) -> String {
    let mut depth = 0_usize;
    let mut kept = String::new();
    for c in text.chars() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth = depth.saturating_sub(1),
            _ if depth == 0 => kept.push(c),
            _ => {}
        }
    }
    kept
}

/// A sentence of at most this length (bytes) is not shortened.
const LONG: usize = 300;
/// A longer word between backticks is shortened to its beginning, its end and its length
/// (characters).
const LONGEST_WORD: usize = 80;
/// Number of characters kept from the beginning.
const HEAD: usize = 40;
/// Number of characters kept from the end.
const TAIL: usize = 20;
/// Greatest length of a sentence (characters).
const LONGEST: usize = 1200;

/// Returns a sentence with the long names of the input shortened: a file of two megabytes may
/// consist of one name, and thousands of faults may quote it.
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

/// Returns a long text shortened to its beginning, its end and its length.
pub fn shortened(text: &str) -> String {
    let count = if text.len() > LONGEST_WORD { text.chars().count() } else { 0 };
    if count <= LONGEST_WORD {
        return text.to_owned();
    }
    let head: String = text.chars().take(HEAD).collect();
    let tail: String = text.chars().skip(count - TAIL).collect();
    format!("{head}…{tail} ({count} characters)")
}

/// Writes the English text.
impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.message.en)?;
        if let Some(h) = &self.help {
            write!(f, " ({})", h.en)?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostic {}

/// The diagnostics of one run, in the order in which they were found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Faults {
    /// All diagnostics.
    pub list: Vec<Diagnostic>,
}

impl Faults {
    /// Adds a diagnostic.
    pub fn push(&mut self, d: Diagnostic) {
        self.list.push(d);
    }

    /// Returns true if any diagnostic is an error.
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

/// A value with the warnings and notes that belong to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Warned<T> {
    /// The value.
    pub value: T,
    /// Warnings and notes, never errors.
    pub notes: Vec<Diagnostic>,
}

impl<T> Warned<T> {
    /// Returns another value with the same notes.
    pub fn map<U>(self, change: impl FnOnce(T) -> U) -> Warned<U> {
        Warned { value: change(self.value), notes: self.notes }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_have_the_comma_of_their_language() {
        let told = |all: Both| {
            Diagnostic::error("x", both!("the points are {}", all)).english_in_chinese()
        };
        assert_eq!(told(Both::names(&["A", "B", "C"])), None);
        assert!(told(Both::same("A, B, C")).is_some());
        // English commas in coordinates and in quotations of the file are allowed.
        assert_eq!(told(Both::same("(1, 2)、`[1, 2]`、\"A, B\"")), None);
    }

    #[test]
    fn huge_names_are_told_by_their_ends() {
        let name = "x".repeat(200_000);
        let d = Diagnostic::error("name", format!("`{name}` cannot name a point, `B` can"))
            .help(format!("not `{name}`"));
        assert!(
            d.message.en.len() < 200
                && d.message.en.contains("(200000 characters)")
                && d.message.en.contains("`B` can"),
            "{}",
            d.message.en
        );
        assert!(d.help.is_some_and(|h| h.en.len() < 200));
        // Text without a pair of backticks is shortened too.
        for text in [name.clone(), format!("`{name}"), format!("é{name}`")] {
            assert!(Diagnostic::note("name", text).message.en.len() < 2 * LONGEST);
        }
        let usual = "`l_AB` is 100 mm".to_owned();
        assert_eq!(Diagnostic::error("x", usual.clone()).message.en, usual);
    }
}
