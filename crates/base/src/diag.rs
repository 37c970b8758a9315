//! Diagnostics as values: every fault of an input, with its place, collected in one run.
//!
//! A stage that finds faults pushes them into a [`Faults`] and goes on as long as it can; only the command line
//! prints them. A [`Diagnostic`] says what is wrong, where, what would be right (`help`), and how grave it is.
//!
//! What it says is a [`Both`]: English and Chinese, made at once by `both!`; whoever shows it chooses. A plain text is none, so that
//! the compiler finds a message without its Chinese.

pub mod json;
mod place;

pub use place::LineColumn;
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

/// A text in both languages.
///
/// It has no `Display`: whoever shows it says in which language.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Both {
    /// English.
    pub en: String,
    /// Chinese.
    pub zh: String,
}

impl Both {
    /// A text that is the same in both languages: a name, a number, a word of the input.
    pub fn same(text: impl Into<String>) -> Both {
        let en = text.into();
        Both { zh: en.clone(), en }
    }

    /// Whether it says nothing.
    pub fn is_empty(&self) -> bool {
        self.en.is_empty() && self.zh.is_empty()
    }

    fn each(self, change: impl Fn(String) -> String) -> Both {
        Both { en: change(self.en), zh: change(self.zh) }
    }

    /// Several, one after the other, with a mark between them in each language.
    pub fn join<'a>(all: impl IntoIterator<Item = &'a Both>, en: &str, zh: &str) -> Both {
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

    /// Names, numbers, words of the input one after the other: `a, b, c`, in Chinese `a、b、c`.
    pub fn names<T: AsRef<str>>(all: &[T]) -> Both {
        let joined = |mark: &str| all.iter().map(T::as_ref).collect::<Vec<_>>().join(mark);
        Both { en: joined(", "), zh: joined("、") }
    }

    /// With the stop of its language at the end, where it has none.
    pub fn sentence(self) -> Both {
        let stopped = |text: String, stop: &str| {
            if text.is_empty() || text.ends_with(['.', '。', ':', '：', '?', '？']) { text } else { text + stop }
        };
        Both { en: stopped(self.en, "."), zh: stopped(self.zh, "。") }
    }

    /// An enumeration: `a`, `a and b`, `a, b and c`.
    pub fn listed(all: &[Both]) -> Both {
        match all {
            [] => Both::default(),
            [one] => one.clone(),
            [head @ .., last] => {
                let head = Both::join(head, ", ", "、");
                Both { en: format!("{} and {}", head.en, last.en), zh: format!("{}和{}", head.zh, last.zh) }
            }
        }
    }
}

/// In tests of single stages the Chinese is not looked at; what the program itself says cannot be made of one language.
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

/// What `both!` writes into its sentences: a [`Both`] in the sentence's language, all else as it prints.
pub trait Piece {
    /// What is written.
    type Shown: ?Sized;
    /// It in an English sentence.
    fn en(&self) -> &Self::Shown;
    /// It in a Chinese sentence.
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

/// A text in both languages, `both!("link {} is too long", "构件 {} 过长", name)`: two sentences of `format!` and the values of both.
///
/// The values may stand in another order in the second (`{1}`); a [`Both`] among them is written in the sentence's language. An ending
/// that only English has (`link{}` with an `s`) is swallowed by `{1:.0}`. A value is taken once for each language: it must not be used up.
#[macro_export]
macro_rules! both {
    ($en:literal, $zh:literal $(, $value:expr)* $(,)?) => {
        $crate::diag::Both { en: format!($en $(, $crate::diag::Piece::en(&$value))*), zh: format!($zh $(, $crate::diag::Piece::zh(&$value))*) }
    };
}
pub use both;

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
    pub message: Both,
    /// Where in the file; `None` where the fault belongs to no single place.
    pub span: Option<Span>,
    /// What to do.
    pub help: Option<Both>,
}

impl Diagnostic {
    /// An error.
    pub fn error(code: &'static str, message: impl Into<Both>) -> Self {
        Diagnostic { severity: Severity::Error, code, message: message.into().each(bounded), span: None, help: None }
    }

    /// A warning.
    pub fn warning(code: &'static str, message: impl Into<Both>) -> Self {
        Diagnostic { severity: Severity::Warning, ..Self::error(code, message) }
    }

    /// A note.
    pub fn note(code: &'static str, message: impl Into<Both>) -> Self {
        Diagnostic { severity: Severity::Note, ..Self::error(code, message) }
    }

    /// The same, at a place.
    pub fn at(mut self, span: Span) -> Self {
        self.span = Some(span);
        self
    }

    /// The same, with advice.
    pub fn help(mut self, help: impl Into<Both>) -> Self {
        self.help = Some(help.into().each(bounded));
        self
    }
}

impl Diagnostic {
    /// What is left of English in the Chinese of the message or of the help: two small words side by side or an English comma outside of
    /// quotation marks and brackets, or a message without a Chinese character. What a user reads in Chinese has none; tests ask for it.
    pub fn english_in_chinese(&self) -> Option<String> {
        let told = self.message.zh.chars().any(|c| ('\u{4e00}'..='\u{9fff}').contains(&c));
        let all = [Some(&self.message), self.help.as_ref()];
        let left = all.into_iter().flatten().find_map(|text| english(&text.zh));
        left.or_else(|| (!told).then(|| self.message.zh.clone()))
    }
}

/// Two small words of Latin letters side by side, outside of what is quoted.
fn english(text: &str) -> Option<String> {
    let unquoted = |mark: char, text: &str| text.split(mark).step_by(2).collect::<Vec<_>>().join(" \u{b7} ");
    let text = unquoted('"', &unquoted('`', text));
    let words: Vec<&str> = text.split_whitespace().collect();
    let small = |w: &str| w.len() > 1 && w.bytes().all(|b| b.is_ascii_lowercase());
    let comma = || unbracketed(&text).find(", ").map(|at| unbracketed(&text)[at..].to_owned());
    words.windows(2).find(|w| w.iter().all(|w| small(w))).map(|w| w.join(" ")).or_else(comma)
}

/// A text without what stands in brackets: coordinates, lists of JSON.
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

/// A sentence with the long names of the input cut short: a file of two megabytes may be one name, and thousands of faults may quote it.
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

/// In English.
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

impl<T> Warned<T> {
    /// Another value with the same notes.
    pub fn map<U>(self, change: impl FnOnce(T) -> U) -> Warned<U> {
        Warned { value: change(self.value), notes: self.notes }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_have_the_comma_of_their_language() {
        let told = |all: Both| Diagnostic::error("x", both!("the points are {}", "点有 {}", all)).english_in_chinese();
        assert_eq!(told(Both::names(&["A", "B", "C"])), None);
        assert!(told(Both::same("A, B, C")).is_some());
        // Coordinates and what is quoted of the file keep theirs.
        assert_eq!(told(Both::same("(1, 2)、`[1, 2]`、\"A, B\"")), None);
    }

    #[test]
    fn huge_names_are_told_by_their_ends() {
        let name = "x".repeat(200_000);
        let d = Diagnostic::error("name", format!("`{name}` cannot name a point, `B` can")).help(format!("not `{name}`"));
        assert!(
            d.message.en.len() < 200 && d.message.en.contains("(200000 characters)") && d.message.en.contains("`B` can"),
            "{}",
            d.message.en
        );
        assert!(d.help.is_some_and(|h| h.en.len() < 200));
        // What has no backticks, or only one, is cut.
        for text in [name.clone(), format!("`{name}"), format!("é{name}`")] {
            assert!(Diagnostic::note("name", text).message.en.len() < 2 * LONGEST);
        }
        let usual = "`l_AB` is 100 mm".to_owned();
        assert_eq!(Diagnostic::error("x", usual.clone()).message.en, usual);
    }
}
