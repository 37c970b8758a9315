//! Diagnostics as text for a terminal: the source line, a mark below the location, the advice.

use hodograph_base::lang::{tr, zh};
use std::borrow::Cow;

use miette::{
    GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteDiagnostic, MietteError,
    MietteSpanContents, NamedSource, Report, SourceCode, SourceSpan, SpanContents,
};
use textwrap::WordSplitter;

use hodograph_base::diag::{Diagnostic, Faults, LineColumn, Severity, Span, both};
use hodograph_scene::Lang;

/// Width of the text in columns, fixed for the tests: that of a printed listing, and no wider than
/// a terminal.
const WIDTH: usize = 100;

/// Longest line that is shown: a scene in one line of a megabyte would otherwise be printed in full
/// for every fault.
const MAX_LINE: usize = 400;

/// Largest number of diagnostics that are shown; further ones are only counted, because each copies
/// the source for its printer.
const MAX_SHOWN: usize = 100;

/// Returns all diagnostics (beyond the hundredth only their number), one after the other, without
/// colours. `source` is the text to which their spans refer.
///
/// A diagnostic with a line too long to show is printed in one line,
/// `name:line:column: error: ...`. Columns count characters. Control characters are shown as
/// visible signs ([`visible`]).
pub fn render(faults: &Faults, source_name: &str, source: &str) -> String {
    render_in(faults, source_name, source, Lang::En)
}

/// Returns the text of [`render`] in a language.
pub fn render_in(faults: &Faults, source_name: &str, source: &str, lang: Lang) -> String {
    let handler = GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor())
        .with_links(false)
        .with_width(WIDTH)
        // Names of links, templates and options are copied from messages: no line may break within
        // one.
        .with_word_splitter(WordSplitter::NoHyphenation);
    let (seen, source_name) = (visible(source), &*visible(source_name));
    let mut out = String::new();
    for d in faults.list.iter().take(MAX_SHOWN) {
        // The visible signs may be longer than the characters that they replace.
        let moved = |at: usize| if seen == source { at } else { visible(&source[..at]).len() };
        let span =
            d.span.map(|s| s.within(source)).map(|s| Span::new(moved(s.start), moved(s.end)));
        let shown = match span {
            Some(s) => line_length(s, &seen) <= MAX_LINE,
            None => true,
        };
        let mut text = String::new();
        let report = report(d, span, source_name, if shown { &seen } else { "" }, lang);
        if shown && handler.render_report(&mut text, report.as_ref()).is_ok() {
            let text = text.trim_start_matches('\n');
            match lang {
                Lang::En => out.push_str(text),
                // The printer has one built-in word, as wide as the Chinese one.
                Lang::Zh => out.push_str(&text.replace("\n  help: ", zh!("\n  help: "))),
            }
        } else {
            out.push_str(&plain(d, span, source_name, &seen, lang));
        }
    }
    if let Some(more) = faults.list.len().checked_sub(MAX_SHOWN).filter(|n| *n > 0) {
        out.push_str(lang.of(&both!("... and {more} more\n")));
    }
    out
}

/// Replaces each control character and each bidirectional override by a visible sign: `␛` for the
/// escape character, `�` if Unicode has no such sign. Line breaks and tabs are kept.
///
/// ```
/// assert_eq!(hodograph_report::diagnostics::visible("a\u{1b}[31m\n"), "a␛[31m\n");
/// ```
pub fn visible(text: &str) -> Cow<'_, str> {
    let sign = |c: char| match c {
        '\n' | '\t' => None,
        '\0'..='\u{1f}' => char::from_u32(0x2400 + u32::from(c)),
        '\u{7f}' => Some('␡'),
        // The second half of the control characters, and those that change the writing direction.
        '\u{80}'..='\u{9f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => Some('\u{fffd}'),
        _ => None,
    };
    // Windows line breaks are line breaks.
    let kept = |at: usize, c: char| c == '\r' && text[at + 1..].starts_with('\n');
    if !text.char_indices().any(|(at, c)| sign(c).is_some() && !kept(at, c)) {
        return Cow::Borrowed(text);
    }
    Cow::Owned(
        text.char_indices()
            .map(|(at, c)| if kept(at, c) { c } else { sign(c).unwrap_or(c) })
            .collect(),
    )
}

/// A source text with columns that count characters; the library counts bytes.
struct Characters(String);

impl SourceCode for Characters {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let found = self.0.read_span(span, before, after)?;
        // If lines precede it, the text returned starts at the beginning of its line.
        let column = if before == 0 {
            LineColumn::of(&self.0, span.offset()).column - 1
        } else {
            found.column()
        };
        Ok(Box::new(MietteSpanContents::new(
            found.data(),
            *found.span(),
            found.line(),
            column,
            found.line_count(),
        )))
    }
}

fn report(d: &Diagnostic, span: Option<Span>, name: &str, source: &str, lang: Lang) -> Report {
    let severity = match d.severity {
        Severity::Note => miette::Severity::Advice,
        Severity::Warning => miette::Severity::Warning,
        Severity::Error => miette::Severity::Error,
    };
    let mut shown = MietteDiagnostic::new(visible(lang.of(&d.message)))
        .with_code(d.code)
        .with_severity(severity);
    if let Some(help) = &d.help {
        shown = shown.with_help(visible(lang.of(help)));
    }
    if let Some(s) = span {
        shown = shown.with_label(LabeledSpan::at(s.start..s.end, tr!(lang, "here")));
        return Report::new(shown)
            .with_source_code(NamedSource::new(name, Characters(source.to_owned())));
    }
    Report::new(shown)
}

fn line_length(span: Span, source: &str) -> usize {
    let start = source[..span.start].rfind('\n').map_or(0, |i| i + 1);
    // An object that spans several lines: the longest of them counts, because all are shown.
    let end = source[span.end..].find('\n').map_or(source.len(), |i| span.end + i);
    source[start..end].split('\n').map(str::len).max().unwrap_or(0)
}

fn plain(d: &Diagnostic, span: Option<Span>, name: &str, source: &str, lang: Lang) -> String {
    let kind = match d.severity {
        Severity::Note => tr!(lang, "note"),
        Severity::Warning => tr!(lang, "warning"),
        Severity::Error => tr!(lang, "error"),
    };
    let place = span
        .map(|s| LineColumn::of(source, s.start))
        .map_or_else(String::new, |at| format!(":{}:{}", at.line, at.column));
    let help = d.help.as_ref().map_or_else(String::new, |h| match lang {
        Lang::En => format!(" ({})", h.en),
        Lang::Zh => format!("（{}）", h.zh),
    });
    visible(&format!("{name}{place}: {kind}[{}]: {}{help}\n", d.code, lang.of(&d.message)))
        .into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use hodograph_base::diag::Both;

    fn faults(span: Span) -> Faults {
        Diagnostic::error("no-unit", Both::same("a length is wanted here, `100` has no unit"))
            .at(span)
            .help(Both::same("write \"100 mm\""))
            .into()
    }

    #[test]
    fn shows_line_mark_and_advice() {
        let source = "{ \"lengths\": {\n  \"AB\": 100 } }\n";
        let start = source.find("100").unwrap();
        let text = render(&faults(Span::new(start, start + 3)), "scene.json", source);
        for part in [
            "no-unit",
            "a length is wanted here, `100` has no unit",
            "scene.json:2:9",
            "\"AB\": 100",
            "help: write \"100 mm\"",
        ] {
            assert!(text.contains(part), "no {part:?} in\n{text}");
        }
        assert!(!text.contains('\u{1b}'), "colours in\n{text}");
    }

    #[test]
    fn a_very_long_line_is_named_not_shown() {
        let source = format!("{{{}100}}", " ".repeat(5000));
        let text = render(&faults(Span::new(5001, 5004)), "scene.json", &source);
        assert_eq!(
            text,
            "scene.json:1:5002: error[no-unit]: a length is wanted here, `100` has no unit (write \"100 mm\")\n"
        );
    }

    #[test]
    fn thousands_are_counted() {
        let many = Faults {
            list: vec![
                Diagnostic::warning("given-twice", Both::same("`v_E` is asked twice"));
                1234
            ],
        };
        let text = render(&many, "scene.json", "{}");
        assert!(text.ends_with("\n... and 1134 more\n"), "{text}");
    }

    #[test]
    fn columns_count_characters_and_nothing_reaches_the_terminal_raw() {
        let source = "{\"title\": \"曲柄摇杆机构\", \"x\": 1, \u{1b}[31m \u{202e} \u{9b}}";
        for (what, column) in [("1,", 26), ("\u{202e}", 35)] {
            let start = source.find(what).unwrap();
            let d = Diagnostic::error("code", Both::same("a \u{1b}]0;\u{7} b\u{0}"))
                .at(Span::new(start, start + 1))
                .help(Both::same("\u{9b}2J"));
            for text in [
                render(&d.clone().into(), "s\u{1b}.json", source),
                render(&d.into(), "s\u{1b}.json", &source.replace('}', &" ".repeat(900))),
            ] {
                assert!(text.contains(&format!("s␛.json:1:{column}")), "{text}");
                assert!(text.contains("a ␛]0;␇ b␀"), "{text}");
                assert!(
                    !text.contains(|c: char| c.is_control() && c != '\n' || c == '\u{202e}'),
                    "{text:?}"
                );
            }
        }
        assert_eq!(visible("a\r\nb\rc"), "a\r\nb␍c");
    }

    #[test]
    fn a_place_outside_the_text_is_no_panic() {
        let text = render(&faults(Span::new(7, 900)), "scene.json", "é{é\u{feff}");
        assert!(text.contains("no-unit"), "{text}");
    }
}
