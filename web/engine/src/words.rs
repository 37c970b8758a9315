//! Diagnostics and choices as the page writes and reads them.

use hodograph::diag::{Diagnostic, Faults, Span};
use hodograph::figure::results::DIGITS;
use hodograph::notation::Notation;
use hodograph::paper::style::Style;
use hodograph::problem::Look;
use hodograph::scene::Lang;
use serde_json::{Value as Json, json};

/// Offset in UTF-16 units of a byte offset.
fn units(text: &str, at: usize) -> usize {
    let mut end = at.min(text.len());
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    text[..end].encode_utf16().count()
}

/// Returns `{"from", "to"}` of a span in UTF-16 units, as editors count.
pub fn place(span: Span, text: &str) -> Json {
    let span = span.within(text);
    json!({"from": units(text, span.start), "to": units(text, span.end)})
}

/// Returns diagnostics with their places in UTF-16 units; `place` is null without a span.
pub fn diagnostics(list: &[Diagnostic], text: &str) -> Json {
    let one = |d: &Diagnostic| {
        json!({
            "severity": d.severity.word(),
            "code": d.code,
            "message": d.message.json(),
            "help": d.help.as_ref().map(hodograph::diag::Both::json),
            "place": d.span.map(|span| place(span, text)),
        })
    };
    list.iter().map(one).collect()
}

/// Returns the answer to a message that failed.
pub fn failed(faults: &Faults, text: &str) -> Json {
    json!({"ok": false, "diagnostics": diagnostics(&faults.list, text)})
}

/// Returns the look of figures and documents that a message asks for: `lang`, `notation`, `style`,
/// each of which may be missing.
pub fn look(message: &Json) -> Look {
    let word = |key: &str| message[key].as_str();
    Look {
        lang: word("lang").and_then(Lang::named),
        notation: word("notation").and_then(Notation::named),
        style: word("style").and_then(Style::named).unwrap_or_default(),
        digits: DIGITS,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_count_as_editors_do() {
        // é is two bytes and one unit, 杆 three and one, 𝛼 four and two.
        let text = "é杆𝛼x";
        assert_eq!(place(Span::new(9, 10), text), json!({"from": 4, "to": 5}));
        assert_eq!(place(Span::new(2, 99), text), json!({"from": 1, "to": 5}));
    }
}
