//! Diagnostics as JSON, for editors and other programs.

use super::{Both, Diagnostic, Faults, Severity};
use serde_json::{Value, json};

/// The version of the document that [`document`] makes; `hodograph schema --diagnostics` describes
/// it.
pub const SCHEMA: &str = "hodograph/errors/1";

/// Returns the document of a run: its version and all diagnostics, as created by [`Faults::json`].
///
/// ```
/// use hodograph_base::diag::{self, Both, Diagnostic, Faults};
/// let message = Both::from(["no driver", "没有原动件"]);
/// let faults = Faults::from(Diagnostic::error("no-driver", message));
/// let told = diag::json::document(faults.json("", ""));
/// assert_eq!(told["schema"], "hodograph/errors/1");
/// assert_eq!(told["diagnostics"][0]["code"], "no-driver");
/// ```
pub fn document(diagnostics: Vec<Value>) -> Value {
    json!({"schema": SCHEMA, "diagnostics": diagnostics})
}

impl Severity {
    /// Returns the word in JSON: `note`, `warning`, `error`.
    pub fn word(self) -> &'static str {
        match self {
            Severity::Note => "note",
            Severity::Warning => "warning",
            Severity::Error => "error",
        }
    }
}

impl Both {
    /// Returns both languages: `{"en": ..., "zh": ...}`.
    pub fn json(&self) -> Value {
        json!({"en": self.en, "zh": self.zh})
    }
}

impl Diagnostic {
    /// Returns the diagnostic with its position in `source`, the text of `file`.
    ///
    /// Keys: `severity` (`note`, `warning`, `error`), `code`, `message` and `help` (in both
    /// languages; `help` may be null), `file` (null if the name is empty) and `place` (null without
    /// a span): `line`, `column`, `end_line`, `end_column` count from 1 in characters, `start` and
    /// `end` are byte offsets; the ends are exclusive.
    pub fn json(&self, file: &str, source: &str) -> Value {
        let place = self.span.map(|span| {
            let (span, [from, to]) = (span.within(source), span.lines(source));
            json!({
                "line": from.line, "column": from.column, "end_line": to.line, "end_column": to.column,
                "start": span.start, "end": span.end,
            })
        });
        json!({
            "severity": self.severity.word(),
            "code": self.code,
            "message": self.message.json(),
            "help": self.help.as_ref().map(Both::json),
            "file": Some(file).filter(|f| !f.is_empty()),
            "place": place,
        })
    }
}

impl Faults {
    /// Returns all diagnostics, in the form of [`Diagnostic::json`].
    pub fn json(&self, file: &str, source: &str) -> Vec<Value> {
        self.list.iter().map(|d| d.json(file, source)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Span, both};
    use super::*;

    #[test]
    fn a_diagnostic_has_both_languages_and_its_place() {
        let d = Diagnostic::warning("unused-parameter", both!("not used")).at(Span::new(6, 9));
        let told = d.json("a.json", "{\n 构: 1 }");
        assert_eq!(
            told,
            json!({
                "severity": "warning", "code": "unused-parameter", "message": {"en": "not used", "zh": "没有用到"}, "help": null,
                "file": "a.json", "place": {"line": 2, "column": 3, "end_line": 2, "end_column": 6, "start": 6, "end": 9},
            })
        );
        let bare = Diagnostic::note("x", both!("a")).help(both!("b")).json("", "");
        assert!(bare["file"].is_null() && bare["place"].is_null() && bare["help"]["zh"] == "乙");
    }

    #[test]
    fn diagnostics_are_errors_of_the_standard_library() {
        fn told(e: &dyn std::error::Error) -> String {
            e.to_string()
        }
        let d = Diagnostic::error("x", both!("no driver")).help(both!("add one"));
        assert_eq!(told(&d), "no driver (add one)");
        assert_eq!(
            told(&Faults { list: vec![d.clone(), d] }),
            "no driver (add one)\nno driver (add one)"
        );
    }
}
