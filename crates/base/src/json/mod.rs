//! Parser from bytes to a tree of JSON values with spans, for everything that users write: scenes
//! and styles. [`fields`] decodes the tree.
//!
//! Strict JSON only: no comments, no trailing commas. Number literals keep their text, so that no
//! digit is lost before the precision is chosen. This module does not depend on the content of a
//! scene.

pub mod fields;

use std::collections::HashSet;

use jsonc_parser::{CollectOptions, ParseOptions, ast, errors::ParseErrorKind, parse_to_ast};

use crate::diag::{Both, Diagnostic, Faults, Span, both};

/// Larger input is refused. The largest scene within the limits of [`super::resolve`] is well under
/// 1 MB when written by hand; a larger file is not a scene, and reading it only costs memory.
const MAX_BYTES: usize = 2_000_000;

/// Deeper nesting is refused. A scene has four levels; the parser recurses, and the limit protects
/// the stack.
const MAX_DEPTH: usize = 32;

/// A text and its span. The span of a JSON string includes the quotation marks.
#[derive(Clone, Debug, PartialEq)]
pub struct Word {
    /// The text, with escapes resolved.
    pub text: String,
    /// The span.
    pub span: Span,
}

/// A JSON value and its span.
#[derive(Clone, Debug)]
pub struct Node {
    /// The value.
    pub kind: NodeKind,
    /// The span.
    pub span: Span,
}

/// A JSON value.
#[derive(Clone, Debug)]
pub enum NodeKind {
    /// A string, unescaped.
    Text(String),
    /// A number literal, as written.
    Number(String),
    /// `true` or `false`.
    Bool(bool),
    /// `null`.
    Null,
    /// A list.
    Array(Vec<Node>),
    /// Keys and values, in the order of the file.
    Object(Vec<(Word, Node)>),
}

impl Node {
    /// Returns a description of the value for a message: "a number".
    pub fn what(&self) -> Both {
        match self.kind {
            NodeKind::Text(_) => both!("a text"),
            NodeKind::Number(_) => both!("a number"),
            NodeKind::Bool(_) => both!("true or false"),
            NodeKind::Null => both!("null"),
            NodeKind::Array(_) => both!("a list"),
            NodeKind::Object(_) => both!("an object"),
        }
    }
}

impl Node {
    /// Returns the value as JSON text, with its numbers as written.
    pub fn text(&self) -> String {
        let quoted = |text: &str| serde_json::Value::from(text).to_string();
        match &self.kind {
            NodeKind::Text(text) => quoted(text),
            NodeKind::Number(literal) => literal.clone(),
            NodeKind::Bool(value) => value.to_string(),
            NodeKind::Null => "null".to_owned(),
            NodeKind::Array(items) => {
                format!("[{}]", items.iter().map(Node::text).collect::<Vec<_>>().join(", "))
            }
            NodeKind::Object(members) => {
                let all: Vec<String> = members
                    .iter()
                    .map(|(key, value)| format!("{}: {}", quoted(&key.text), value.text()))
                    .collect();
                format!("{{{}}}", all.join(", "))
            }
        }
    }
}

/// Reads one JSON value. Duplicate keys are reported to `faults` (the first one counts).
///
/// # Errors
/// Input from which no tree can be built.
pub fn parse<'a>(bytes: &'a [u8], faults: &mut Faults) -> Result<(&'a str, Node), Diagnostic> {
    if bytes.len() > MAX_BYTES {
        let message = both!(
            "the file has more than {MAX_BYTES} bytes; none that is written by hand is so long"
        );
        return Err(Diagnostic::error("too-large", message));
    }
    let source = std::str::from_utf8(bytes).map_err(|e| {
        let at = e.valid_up_to();
        Diagnostic::error("not-utf8", both!("byte {at} is not UTF-8 text"))
            .at(Span::new(at, at + e.error_len().unwrap_or(1)))
            .help(both!("save the file as UTF-8"))
    })?;
    check_depth(bytes)?;
    // Some editors begin UTF-8 files with a byte order mark; the parser does not accept it, and the
    // spans must count it.
    let base = if source.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
    let parsed =
        parse_to_ast(&source[base..], &CollectOptions::default(), &strict()).map_err(|e| {
            let range = e.range();
            let d = Diagnostic::error("json", both!("not valid JSON: {}", sentence(e.kind())));
            let d = d.at(Span::new(base + range.start, base + range.end));
            match advice(e.kind()) {
                Some(help) => d.help(help),
                None => d,
            }
        })?;
    let Some(value) = parsed.value else {
        return Err(Diagnostic::error("json", both!("the file is empty"))
            .help(both!("what is read here is one JSON object: {{ ... }}")));
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

/// Returns the parser's message as a clause for a diagnostic; the parser has English messages only.
fn sentence(kind: &ParseErrorKind) -> Both {
    use ParseErrorKind::*;
    let text = kind.to_string();
    let mut chars = text.chars();
    let en: std::string::String = match chars.next() {
        Some(first) => first.to_lowercase().chain(chars).collect(),
        None => text,
    };
    let zh = match kind {
        BareDecimalPointNumbersNotAllowed => "小数点前后都须有数字",
        CommentsNotAllowed => "不允许注释",
        ExpectedColonAfterObjectKey => "键后应有冒号",
        ExpectedObjectValue => "冒号后应有值",
        ExpectedDigit => "应有数字",
        ExpectedDigitFollowingNegativeSign => "负号后应有数字",
        ExpectedPlusMinusOrDigitInNumberLiteral => "数中应有正负号或数字",
        ExpectedStringObjectProperty => "对象的键应为带引号的文字",
        HexadecimalNumbersNotAllowed => "不允许十六进制数",
        ExpectedComma => "缺少逗号",
        MultipleRootJsonValues => "文件只能有一个 JSON 值",
        NonFiniteNumbersNotAllowed => "不允许 Infinity 和 NaN",
        SingleQuotedStringsNotAllowed => "不允许单引号",
        String(_) => "文字的引号或转义有误",
        TrailingCommasNotAllowed => "不允许末尾的逗号",
        UnaryPlusNumbersNotAllowed => "数前不允许正号",
        UnexpectedCloseBrace => "多余的 }",
        UnexpectedCloseBracket => "多余的 ]",
        UnexpectedColon => "多余的冒号",
        UnexpectedComma => "多余的逗号",
        UnexpectedToken => "不能识别的符号",
        UnexpectedTokenInObject => "对象中有不能识别的符号",
        UnexpectedWord => "不能识别的词",
        UnterminatedArray => "列表没有结束，缺少 ]",
        UnterminatedCommentBlock => "注释没有结束",
        UnterminatedObject => "对象没有结束，缺少 }",
        NestingDepthExceeded => "嵌套过深",
    };
    Both { en, zh: zh.to_owned() }
}

fn advice(kind: &ParseErrorKind) -> Option<Both> {
    Some(match kind {
        ParseErrorKind::TrailingCommasNotAllowed => {
            both!("take the last comma away")
        }
        ParseErrorKind::CommentsNotAllowed => {
            both!("JSON has no comments; a remark can stand in \"statement\"")
        }
        ParseErrorKind::SingleQuotedStringsNotAllowed => both!("write \"...\""),
        ParseErrorKind::ExpectedComma => both!("put a comma before this"),
        ParseErrorKind::UnexpectedWord | ParseErrorKind::ExpectedStringObjectProperty => {
            both!("put it in quotation marks: \"...\"")
        }
        ParseErrorKind::BareDecimalPointNumbersNotAllowed => {
            both!("write a digit on both sides of the point: 0.5")
        }
        _ => return None,
    })
}

/// Counts brackets outside strings. The parser reports wrong brackets.
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
            let message = both!(
                "brackets are nested more than {MAX_DEPTH} deep; four levels are all that is needed"
            );
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
            Node { kind: NodeKind::Text(text.text), span: text.span }
        }
        ast::Value::NumberLit(n) => {
            let span = place(n.range);
            if !is_json_number(n.value) {
                faults.push(
                    Diagnostic::error(
                        "json",
                        both!("not valid JSON: `{}` is not a JSON number", n.value),
                    )
                    .at(span),
                );
            }
            Node { kind: NodeKind::Number(n.value.to_owned()), span }
        }
        ast::Value::BooleanLit(b) => Node { kind: NodeKind::Bool(b.value), span: place(b.range) },
        ast::Value::NullKeyword(n) => Node { kind: NodeKind::Null, span: place(n.range) },
        ast::Value::Array(a) => {
            let span = place(a.range);
            let items = a.elements.into_iter().map(|v| convert(v, base, source, faults)).collect();
            Node { kind: NodeKind::Array(items), span }
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
                    let message = both!("`{}` stands here twice", key.text);
                    faults.push(
                        Diagnostic::error("duplicate-key", message)
                            .at(key.span)
                            .help(both!("keep one of the two")),
                    );
                }
            }
            Node { kind: NodeKind::Object(members), span }
        }
    }
}

/// Checks a string: the parser accepts control characters, but JSON does not (other programs would
/// refuse the file), and an escape may produce an unprintable character.
fn check_string(word: &Word, source: &str, faults: &mut Faults) {
    let raw = source.get(word.span.start..word.span.end).unwrap_or_default();
    if let Some(i) = raw.bytes().position(|b| b < 0x20) {
        let at = Span::new(word.span.start + i, word.span.start + i + 1);
        let message = both!("not valid JSON: a line break or control character inside a text");
        faults.push(
            Diagnostic::error("json", message).at(at).help(both!("write \\n for a line break")),
        );
    } else if let Some(d) = unprintable(word) {
        let place = unprintable_char(&word.text).and_then(|c| written(c, raw));
        let start = word.span.start;
        faults.push(place.map_or(d.clone(), |p| d.at(Span::new(start + p.start, start + p.end))));
    }
}

/// Returns the fault of a text with an unprintable character.
///
/// Control characters other than line break and tab are refused (a terminal obeys them, XML and
/// Typst do not accept them), as are the code points that Unicode reserves as non-characters, such
/// as U+FFFE (ill-formed in XML).
pub fn unprintable(word: &Word) -> Option<Diagnostic> {
    let c = unprintable_char(&word.text)?;
    let kind =
        if c.is_control() { both!("a control character") } else { both!("which is no character") };
    let d = Diagnostic::error(
        "text",
        both!("this text holds U+{1:04X}, {0}: no figure can show it", kind, u32::from(c)),
    );
    Some(d.at(word.span).help(both!("take it out; a line break is written \\n")))
}

fn unprintable_char(text: &str) -> Option<char> {
    let free =
        |c: char| (0xfdd0..=0xfdef).contains(&u32::from(c)) || u32::from(c) & 0xfffe == 0xfffe;
    text.chars().find(|c| c.is_control() && !matches!(c, '\n' | '\t') || free(*c))
}

/// Returns the span of a character in a JSON string, written as itself or as an escape.
fn written(c: char, raw: &str) -> Option<Span> {
    let short = match c {
        '\u{8}' => "\\b",
        '\u{c}' => "\\f",
        '\r' => "\\r",
        _ => "",
    };
    let long: String =
        c.encode_utf16(&mut [0; 2]).iter().map(|unit| format!("\\u{unit:04x}")).collect();
    let places = [
        (raw.find(c), c.len_utf8()),
        (raw.to_ascii_lowercase().find(&long), long.len()),
        (raw.find(short), short.len()),
    ];
    places
        .into_iter()
        .find_map(|(at, length)| at.filter(|_| length > 0).map(|at| Span::new(at, at + length)))
}

fn is_json_number(text: &str) -> bool {
    let digits = text.strip_prefix('-').unwrap_or(text);
    let leading_zero =
        digits.len() > 1 && digits.starts_with('0') && digits.as_bytes()[1].is_ascii_digit();
    digits.starts_with(|c: char| c.is_ascii_digit()) && !leading_zero && text.parse::<f64>().is_ok()
}
