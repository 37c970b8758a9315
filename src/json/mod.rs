//! Bytes to a tree of JSON values with their places: the one door to the parser of what people write, scenes and styles;
//! [`fields`] takes the tree apart.
//!
//! Strict JSON only: no comments, no trailing commas. Number literals keep their text, so that no digit is lost before
//! somebody decides in which precision to read it. Nothing here knows what a scene is.

pub(crate) mod fields;

use std::collections::HashSet;

use jsonc_parser::{CollectOptions, ParseOptions, ast, errors::ParseErrorKind, parse_to_ast};

use crate::diag::{Diagnostic, Faults, Span};

/// Larger input is refused. The largest scene within the limits of [`super::resolve`] is well under 1 MB when written
/// by hand; a larger file is not a scene, and reading it would only cost memory.
const MAX_BYTES: usize = 2_000_000;

/// Deeper nesting is refused. A scene nests four deep; the parser recurses, so the bound keeps every input off the end of the stack.
const MAX_DEPTH: usize = 32;

/// A text and its place. For a JSON string the place includes the quotation marks.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Word {
    /// The text, escapes resolved.
    pub text: String,
    /// Its place.
    pub span: Span,
}

/// A JSON value and its place.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    pub kind: Kind,
    pub span: Span,
}

/// What a JSON value is.
#[derive(Clone, Debug)]
pub(crate) enum Kind {
    Text(String),
    /// A number literal, as written.
    Number(String),
    Bool,
    Null,
    Array(Vec<Node>),
    Object(Vec<(Word, Node)>),
}

impl Node {
    /// What the value is, for a message: "a number".
    pub fn what(&self) -> &'static str {
        match self.kind {
            Kind::Text(_) => "a text",
            Kind::Number(_) => "a number",
            Kind::Bool => "true or false",
            Kind::Null => "null",
            Kind::Array(_) => "a list",
            Kind::Object(_) => "an object",
        }
    }
}

/// Reads one JSON value. Duplicate keys go to `faults` (the first one counts); whatever leaves no tree at all is the error.
pub(crate) fn parse<'a>(bytes: &'a [u8], faults: &mut Faults) -> Result<(&'a str, Node), Diagnostic> {
    if bytes.len() > MAX_BYTES {
        let message = format!("the file has more than {MAX_BYTES} bytes; none that is written by hand is so long");
        return Err(Diagnostic::error("too-large", message));
    }
    let source = std::str::from_utf8(bytes).map_err(|e| {
        let at = e.valid_up_to();
        Diagnostic::error("not-utf8", format!("byte {at} is not UTF-8 text"))
            .at(Span::new(at, at + e.error_len().unwrap_or(1)))
            .help("save the file as UTF-8")
    })?;
    check_depth(bytes)?;
    // Some editors begin UTF-8 files with a byte order mark; the parser does not know it, and the places must count it.
    let base = if source.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
    let parsed = parse_to_ast(&source[base..], &CollectOptions::default(), &strict()).map_err(|e| {
        let range = e.range();
        let d = Diagnostic::error("json", format!("not valid JSON: {}", sentence(e.kind())));
        let d = d.at(Span::new(base + range.start, base + range.end));
        match advice(e.kind()) {
            Some(help) => d.help(help),
            None => d,
        }
    })?;
    let Some(value) = parsed.value else {
        return Err(Diagnostic::error("json", "the file is empty").help("what is read here is one JSON object: { ... }"));
    };
    let node = convert(value, base, source, faults);
    Ok((source, node))
}

fn strict() -> ParseOptions {
    ParseOptions {
        allow_comments: false,
        allow_loose_object_property_names: false,
        allow_trailing_commas: false,
        allow_missing_commas: false,
        allow_single_quoted_strings: false,
        allow_hexadecimal_numbers: false,
        allow_unary_plus_numbers: false,
        allow_bare_decimal_point_numbers: false,
        allow_non_finite_numbers: false,
        allow_extended_string_escapes: false,
    }
}

/// The parser's own sentence, fitted into ours.
fn sentence(kind: &ParseErrorKind) -> String {
    let text = kind.to_string();
    let mut chars = text.chars();
    match chars.next() {
        Some(first) => first.to_lowercase().chain(chars).collect(),
        None => text,
    }
}

fn advice(kind: &ParseErrorKind) -> Option<&'static str> {
    Some(match kind {
        ParseErrorKind::TrailingCommasNotAllowed => "take the last comma away",
        ParseErrorKind::CommentsNotAllowed => "JSON has no comments; a remark can stand in \"statement\"",
        ParseErrorKind::SingleQuotedStringsNotAllowed => "write \"...\"",
        ParseErrorKind::ExpectedComma => "put a comma before this",
        ParseErrorKind::UnexpectedWord | ParseErrorKind::ExpectedStringObjectProperty => "put it in quotation marks: \"...\"",
        ParseErrorKind::BareDecimalPointNumbersNotAllowed => "write a digit on both sides of the point: 0.5",
        _ => return None,
    })
}

/// Counts brackets outside strings. Wrong brackets are the parser's business.
fn check_depth(bytes: &[u8]) -> Result<(), Diagnostic> {
    let (mut depth, mut in_string, mut escaped) = (0usize, false, false);
    for (i, &b) in bytes.iter().enumerate() {
        if in_string {
            match b {
                _ if escaped => escaped = false,
                b'\\' => escaped = true,
                b'"' => in_string = false,
                _ => {}
            }
            continue;
        }
        match b {
            b'"' => in_string = true,
            b'{' | b'[' => depth += 1,
            b'}' | b']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth > MAX_DEPTH {
            let message = format!("brackets are nested more than {MAX_DEPTH} deep; four levels are all that is needed");
            return Err(Diagnostic::error("too-deep", message).at(Span::new(i, i + 1)));
        }
    }
    Ok(())
}

fn convert(value: ast::Value<'_>, base: usize, source: &str, faults: &mut Faults) -> Node {
    let place = |r: jsonc_parser::common::Range| Span::new(base + r.start, base + r.end);
    match value {
        ast::Value::StringLit(s) => {
            let text = Word { text: s.value.into_owned(), span: place(s.range) };
            check_string(&text, source, faults);
            Node { kind: Kind::Text(text.text), span: text.span }
        }
        ast::Value::NumberLit(n) => {
            let span = place(n.range);
            if !is_json_number(n.value) {
                faults.push(Diagnostic::error("json", format!("not valid JSON: `{}` is not a JSON number", n.value)).at(span));
            }
            Node { kind: Kind::Number(n.value.to_owned()), span }
        }
        ast::Value::BooleanLit(b) => Node { kind: Kind::Bool, span: place(b.range) },
        ast::Value::NullKeyword(n) => Node { kind: Kind::Null, span: place(n.range) },
        ast::Value::Array(a) => {
            let span = place(a.range);
            let items = a.elements.into_iter().map(|v| convert(v, base, source, faults)).collect();
            Node { kind: Kind::Array(items), span }
        }
        ast::Value::Object(o) => {
            let span = place(o.range);
            let mut members = Vec::with_capacity(o.properties.len());
            let mut known = HashSet::new();
            for property in o.properties {
                let (text, range) = match property.name {
                    ast::ObjectPropName::String(s) => (s.value.into_owned(), s.range),
                    ast::ObjectPropName::Word(w) => (w.value.to_owned(), w.range),
                };
                let key = Word { text, span: place(range) };
                check_string(&key, source, faults);
                let value = convert(property.value, base, source, faults);
                if known.insert(key.text.clone()) {
                    members.push((key, value));
                } else {
                    let message = format!("`{}` stands here twice", key.text);
                    faults.push(Diagnostic::error("duplicate-key", message).at(key.span).help("keep one of the two"));
                }
            }
            Node { kind: Kind::Object(members), span }
        }
    }
}

/// The parser lets control characters through, JSON does not (other programs would refuse the file); and what an escape stands for
/// may be no character to print either.
fn check_string(word: &Word, source: &str, faults: &mut Faults) {
    let raw = source.get(word.span.start..word.span.end).unwrap_or_default();
    if let Some(i) = raw.bytes().position(|b| b < 0x20) {
        let at = Span::new(word.span.start + i, word.span.start + i + 1);
        let message = "not valid JSON: a line break or control character inside a text";
        faults.push(Diagnostic::error("json", message).at(at).help("write \\n for a line break"));
    } else if let Some(d) = unprintable(word) {
        let place = unprintable_char(&word.text).and_then(|c| written(c, raw));
        let start = word.span.start;
        faults.push(place.map_or(d.clone(), |p| d.at(Span::new(start + p.start, start + p.end))));
    }
}

/// The fault of a text that holds a character which is none to print.
///
/// Refused are control characters but the line break and the tab (a terminal obeys them, XML and Typst do not take them) and the code
/// points that Unicode keeps free of characters, such as U+FFFE (ill-formed in XML).
pub(crate) fn unprintable(word: &Word) -> Option<Diagnostic> {
    let c = unprintable_char(&word.text)?;
    let kind = if c.is_control() { "a control character" } else { "which is no character" };
    let d = Diagnostic::error("text", format!("this text holds U+{:04X}, {kind}: no figure can show it", u32::from(c)));
    Some(d.at(word.span).help("take it out; a line break is written \\n"))
}

fn unprintable_char(text: &str) -> Option<char> {
    let free = |c: char| (0xfdd0..=0xfdef).contains(&u32::from(c)) || u32::from(c) & 0xfffe == 0xfffe;
    text.chars().find(|c| c.is_control() && !matches!(c, '\n' | '\t') || free(*c))
}

/// Where a character is written in a JSON string: as it stands, or as an escape.
fn written(c: char, raw: &str) -> Option<Span> {
    let short = match c {
        '\u{8}' => "\\b",
        '\u{c}' => "\\f",
        '\r' => "\\r",
        _ => "",
    };
    let long: String = c.encode_utf16(&mut [0; 2]).iter().map(|unit| format!("\\u{unit:04x}")).collect();
    let places = [(raw.find(c), c.len_utf8()), (raw.to_ascii_lowercase().find(&long), long.len()), (raw.find(short), short.len())];
    places.into_iter().find_map(|(at, length)| at.filter(|_| length > 0).map(|at| Span::new(at, at + length)))
}

fn is_json_number(text: &str) -> bool {
    let digits = text.strip_prefix('-').unwrap_or(text);
    let leading_zero = digits.len() > 1 && digits.starts_with('0') && digits.as_bytes()[1].is_ascii_digit();
    digits.starts_with(|c: char| c.is_ascii_digit()) && !leading_zero && text.parse::<f64>().is_ok()
}
