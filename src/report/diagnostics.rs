//! Diagnostics as text for a terminal: the line of the file, a mark under the place, the advice.

use miette::{GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteDiagnostic, NamedSource, Report};

use crate::diag::{Diagnostic, Faults, Severity, Span};

/// Width of the text in columns: that of a printed listing; terminals are at least this wide, and tests want it fixed.
const WIDTH: usize = 100;

/// Longer lines are not shown: a scene written in one line of a megabyte would be printed whole for every fault in it.
const MAX_LINE: usize = 400;

/// More diagnostics are only counted: nobody reads on, and each of them copies the source for its printer.
const MAX_SHOWN: usize = 100;

/// All diagnostics (beyond the hundredth only their number), one after the other, without colours. `source` is the text that their spans count in.
///
/// A diagnostic whose line is too long to show is printed in one line, `name:line:column: error: ...`.
pub fn render(faults: &Faults, source_name: &str, source: &str) -> String {
    let handler = GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor()).with_links(false).with_width(WIDTH);
    let mut out = String::new();
    for d in faults.list.iter().take(MAX_SHOWN) {
        let span = d.span.map(|s| clamp(s, source));
        let shown = match span {
            Some(s) => line_length(s, source) <= MAX_LINE,
            None => true,
        };
        let mut text = String::new();
        let report = report(d, span, source_name, if shown { source } else { "" });
        if shown && handler.render_report(&mut text, report.as_ref()).is_ok() {
            out.push_str(text.trim_start_matches('\n'));
        } else {
            out.push_str(&plain(d, span, source_name, source));
        }
    }
    if let Some(more) = faults.list.len().checked_sub(MAX_SHOWN).filter(|n| *n > 0) {
        out.push_str(&format!("... and {more} more\n"));
    }
    out
}

fn report(d: &Diagnostic, span: Option<Span>, name: &str, source: &str) -> Report {
    let severity = match d.severity {
        Severity::Note => miette::Severity::Advice,
        Severity::Warning => miette::Severity::Warning,
        Severity::Error => miette::Severity::Error,
    };
    let mut shown = MietteDiagnostic::new(&d.message).with_code(d.code).with_severity(severity);
    if let Some(help) = &d.help {
        shown = shown.with_help(help);
    }
    if let Some(s) = span {
        shown = shown.with_label(LabeledSpan::at(s.start..s.end, "here"));
        return Report::new(shown).with_source_code(NamedSource::new(name, source.to_owned()));
    }
    Report::new(shown)
}

/// A span within the text and between characters: the text may be a lossy reading of bytes that were not UTF-8.
fn clamp(span: Span, source: &str) -> Span {
    let floor = |mut i: usize| {
        i = i.min(source.len());
        while !source.is_char_boundary(i) {
            i -= 1;
        }
        i
    };
    let start = floor(span.start);
    Span::new(start, floor(span.end).max(start))
}

fn line_length(span: Span, source: &str) -> usize {
    let start = source[..span.start].rfind('\n').map_or(0, |i| i + 1);
    // An object that spans several lines: the longest of them counts, since all are shown.
    let end = source[span.end..].find('\n').map_or(source.len(), |i| span.end + i);
    source[start..end].split('\n').map(str::len).max().unwrap_or(0)
}

fn plain(d: &Diagnostic, span: Option<Span>, name: &str, source: &str) -> String {
    let kind = match d.severity {
        Severity::Note => "note",
        Severity::Warning => "warning",
        Severity::Error => "error",
    };
    let place = span.map_or_else(String::new, |s| {
        let before = &source[..s.start];
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        format!(":{}:{}", before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
    });
    let help = d.help.as_ref().map_or_else(String::new, |h| format!(" ({h})"));
    format!("{name}{place}: {kind}[{}]: {}{help}\n", d.code, d.message)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn faults(span: Span) -> Faults {
        Diagnostic::error("no-unit", "a length is wanted here, `100` has no unit").at(span).help("write \"100 mm\"").into()
    }

    #[test]
    fn shows_line_mark_and_advice() {
        let source = "{ \"lengths\": {\n  \"AB\": 100 } }\n";
        let start = source.find("100").unwrap();
        let text = render(&faults(Span::new(start, start + 3)), "scene.json", source);
        for part in ["no-unit", "a length is wanted here, `100` has no unit", "scene.json:2:9", "\"AB\": 100", "help: write \"100 mm\""] {
            assert!(text.contains(part), "no {part:?} in\n{text}");
        }
        assert!(!text.contains('\u{1b}'), "colours in\n{text}");
    }

    #[test]
    fn a_very_long_line_is_named_not_shown() {
        let source = format!("{{{}100}}", " ".repeat(5000));
        let text = render(&faults(Span::new(5001, 5004)), "scene.json", &source);
        assert_eq!(text, "scene.json:1:5002: error[no-unit]: a length is wanted here, `100` has no unit (write \"100 mm\")\n");
    }

    #[test]
    fn thousands_are_counted() {
        let many = Faults { list: vec![Diagnostic::warning("given-twice", "`v_E` is asked twice"); 1234] };
        let text = render(&many, "scene.json", "{}");
        assert!(text.ends_with("\n... and 1134 more\n"), "{text}");
    }

    #[test]
    fn a_place_outside_the_text_is_no_panic() {
        let text = render(&faults(Span::new(7, 900)), "scene.json", "é{é\u{feff}");
        assert!(text.contains("no-unit"), "{text}");
    }
}
