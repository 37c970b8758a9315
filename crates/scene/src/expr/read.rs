//! The parser of expressions: a winnow parser for each rule of the grammar.
//!
//! The grammar. A unit directly after a value binds tighter than any operator (10 rad/s = (10
//! rad)/s), and so does a parenthesis (0.05 (m/s)/mm = (0.05*(m/s))/mm). After a quotient of
//! numbers, the unit belongs to the quotient (sqrt(3)/2 m = (sqrt(3)/2) m), except for a unit of
//! time, which is that of a period (2π/3 s = 2π/(3 s)):
//! ```text
//! sum      = product (("+" | "-") product)*
//! product  = signed (("*" | "/") signed)*
//! signed   = ("+" | "-")* power
//! power    = atom raised?
//! raised   = "^" ("+" | "-")* (number | pi | call | group | name) | "⁻"? ("⁰" | ... | "⁹")+
//! atom     = arc | (number pi? | pi | group) tail? | call unit? | parameter unit? | name | "°"
//! arc      = number ("°" | "deg") (number "′" (number "″")? | number "″")
//! tail     = (group | unit) raised?
//! call     = name "(" sum ")"
//! group    = "(" sum ")"
//! unit     = "°" | "r/min" | name
//! number   = (digit+ ("." digit*)? | "." digit+) (("e" | "E") ("+" | "-")? digit+)?
//! pi       = "pi" | "π"
//! name     = letter (letter | digit | "_" | "'")*
//! ```
//! Minutes of arc may be written ' or ’, seconds '' or " or ”. The minus sign − and the dots and
//! crosses · ⋅ × of products are read as `-` and `*`. The first token of a rule selects the rule; a
//! failure after it is a failure of the whole (`cut_err`), so that the fault is at the position of
//! the input.

use super::{Expr, ExprKind, FUNCTIONS, Function, Operator, is_bare};
use crate::units::{Dim, OF_ARC, UNITS, Unit, unit_named};
use hodograph_base::diag::{Both, Diagnostic, Span, both};
use hodograph_base::json::fields::suggest;
use winnow::ascii::{digit0, digit1};
use winnow::combinator::{alt, cut_err, eof, not, opt, peek, preceded, repeat, terminated};
use winnow::error::{EmptyError, ErrMode};
use winnow::stream::{LocatingSlice, Location, Stateful};
use winnow::token::{one_of, take_while};
use winnow::{ModalResult, Parser};

/// A text with the known names.
type ExpressionInput<'a> = Stateful<LocatingSlice<&'a str>, KnownNames<'a>>;
type ParseResult<O> = ModalResult<O, EmptyError>;

#[derive(Debug)]
struct KnownNames<'a> {
    parameters: &'a [&'a str],
    /// End of the last value with a unit.
    tailed: usize,
    /// Fault of the first unknown name; reported only for texts that fit the grammar.
    unknown: Option<Diagnostic>,
}

/// Reads a whole text.
pub(super) fn whole(text: &str, parameters: &[&str]) -> Result<Expr, Diagnostic> {
    let mut input = ExpressionInput {
        input: LocatingSlice::new(text),
        state: KnownNames { parameters, tailed: 0, unknown: None },
    };
    match terminated(sum, token(eof)).parse_next(&mut input) {
        Ok(tree) => input.state.unknown.map_or(Ok(tree), Err),
        Err(_) => Err(unreadable(text, input.current_token_start())),
    }
}

const SIGNS: [char; 3] = ['+', '-', '−'];
const FACTORS: [char; 5] = ['*', '·', '⋅', '×', '/'];
const SUPERSCRIPT: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

/// Returns the fault of a text that is not an expression from a byte on.
fn unreadable(text: &str, at: usize) -> Diagnostic {
    let fault = |message: Both| Diagnostic::error("expression", message);
    let rest = text.get(at..).unwrap_or_default();
    match rest.chars().next() {
        None => fault(both!("`{text}` ends too early")).at(Span::new(0, text.len())),
        // A comma between digits is a decimal comma: commas separate nothing here.
        Some(',') if decimal_comma(text, at) => {
            let d = fault(both!("`{text}` has a comma in a number")).at(Span::new(at, at + 1));
            d.help(both!("write the decimal point: \"{}.{}\"", &text[..at], &text[at + 1..]))
        }
        Some(',') => {
            let d =
                fault(both!("`{text}` has a comma between two values")).at(Span::new(at, at + 1));
            d.help(both!(
                "a function takes one value; the angle whose tangent is y/x is \"atan(y/x)\""
            ))
        }
        Some(c) => {
            let d = fault(both!("`{text}` cannot be read from `{rest}` on"))
                .at(Span::new(at, at + c.len_utf8()));
            let turns = |words: &[&str]| words.iter().any(|w| rest.starts_with(w));
            if turns(&["clockwise", "cw", "顺时针"]) {
                return d.help(both!("clockwise is a minus sign: \"-{}\"", text[..at].trim()));
            }
            if turns(&["counter", "anti", "ccw", "逆时针"]) {
                return d.help(both!("counter-clockwise is positive: \"{}\"", text[..at].trim()));
            }
            let before = text[..at].trim_end();
            if ["deg", "°"].iter().any(|d| before.ends_with(d)) && c.is_ascii_digit() {
                return d
                    .help(both!("minutes and seconds of arc: \"20°30′15″\", \"20 deg 30' 15''\""));
            }
            d.help(both!(
                "an expression is made of numbers, units, parameters, + - * / ^ ( ) and functions, such as \"2*r + 5 mm\""
            ))
        }
    }
}

/// Returns true if the comma at a byte of a text is between the two parts of one number: digits,
/// neither of which has a decimal point.
fn decimal_comma(text: &str, at: usize) -> bool {
    let (before, after) =
        (text[..at].trim_end_matches(|c: char| c.is_ascii_digit()), &text[at + 1..]);
    let left = at - before.len();
    let rest = after.trim_start_matches(|c: char| c.is_ascii_digit());
    left > 0 && rest.len() < after.len() && !before.ends_with('.') && !rest.starts_with('.')
}

fn binary(op: Operator, a: Expr, b: Expr) -> Expr {
    let span = Span::new(a.span.start, b.span.end);
    Expr { kind: ExprKind::Binary(op, Box::new(a), Box::new(b)), span }
}

/// Parses a token, with spaces before it; returns it with its place.
fn token<'a, O>(
    of: impl Parser<ExpressionInput<'a>, O, ErrMode<EmptyError>>,
) -> impl Parser<ExpressionInput<'a>, (O, Span), ErrMode<EmptyError>> {
    let spaces = take_while(0.., [' ', '\t']);
    preceded(spaces, of.with_span()).map(|(token, at)| (token, Span::new(at.start, at.end)))
}

/// Parses one of these characters.
fn sign<'a, const N: usize>(
    of: [char; N],
) -> impl Parser<ExpressionInput<'a>, char, ErrMode<EmptyError>> {
    token(one_of(of)).map(|(c, _)| c)
}

fn sum(i: &mut ExpressionInput) -> ParseResult<Expr> {
    let mut left = product(i)?;
    while let Some(sign) = opt(sign(SIGNS)).parse_next(i)? {
        left = binary(if sign == '+' { Operator::Add } else { Operator::Sub }, left, product(i)?);
    }
    Ok(left)
}

fn product(i: &mut ExpressionInput) -> ParseResult<Expr> {
    let mut left = signed(i, power)?;
    while let Some(sign) = opt(sign(FACTORS)).parse_next(i)? {
        let right = signed(i, power)?;
        left = match right.kind {
            ExprKind::Binary(Operator::Mul, value, unit)
                if sign == '/'
                    && i.state.tailed == i.current_token_start()
                    && is_bare(&left)
                    && is_bare(&value)
                    && !matches!(unit.kind, ExprKind::Unit(u) if u.dim == Dim::TIME) =>
            {
                binary(Operator::Mul, binary(Operator::Div, left, *value), *unit)
            }
            kind => binary(
                if sign == '/' { Operator::Div } else { Operator::Mul },
                left,
                Expr { kind, span: right.span },
            ),
        };
    }
    Ok(left)
}

/// Parses signs, then an operand.
fn signed(
    i: &mut ExpressionInput,
    operand: fn(&mut ExpressionInput) -> ParseResult<Expr>,
) -> ParseResult<Expr> {
    let (_, Span { start, .. }) = token("").parse_next(i)?;
    let negative = repeat(0.., sign(SIGNS))
        .fold(|| false, |negative, sign| negative ^ (sign != '+'))
        .parse_next(i)?;
    let inner = operand(i)?;
    let span = Span::new(start, i.current_token_start());
    Ok(if negative { Expr { kind: ExprKind::Neg(Box::new(inner)), span } } else { inner })
}

fn power(i: &mut ExpressionInput) -> ParseResult<Expr> {
    let base = atom(i)?;
    raised(i, base)
}

/// Returns `base` with the exponent that may follow.
fn raised(i: &mut ExpressionInput, base: Expr) -> ParseResult<Expr> {
    let caret = preceded(sign(['^']), cut_err(|i: &mut ExpressionInput| signed(i, exponent)));
    Ok(match opt(alt((caret, superscript))).parse_next(i)? {
        Some(exponent) => binary(Operator::Pow, base, exponent),
        None => base,
    })
}

fn superscript(i: &mut ExpressionInput) -> ParseResult<Expr> {
    let minus = opt(token('⁻')).parse_next(i)?;
    let digit = token(one_of(SUPERSCRIPT))
        .map(|(c, at)| (SUPERSCRIPT.iter().position(|d| *d == c).unwrap_or_default(), at));
    let digits: Vec<(usize, Span)> = match minus {
        Some(_) => cut_err(repeat(1.., digit)).parse_next(i)?,
        None => repeat(1.., digit).parse_next(i)?,
    };
    let (start, end) = (digits[0].1.start, i.current_token_start());
    let number = Expr {
        kind: ExprKind::Number(digits.iter().map(|(d, _)| d.to_string()).collect()),
        span: Span::new(start, end),
    };
    Ok(match minus {
        Some((_, at)) => {
            Expr { kind: ExprKind::Neg(Box::new(number)), span: Span::new(at.start, end) }
        }
        None => number,
    })
}

fn atom(i: &mut ExpressionInput) -> ParseResult<Expr> {
    token(alt((arc, with_unit, name, unit))).map(|(atom, _)| atom).parse_next(i)
}

/// Parses a value, and the unit that may follow it.
fn with_unit(i: &mut ExpressionInput) -> ParseResult<Expr> {
    let multiple = (number, opt(pi)).map(|(n, pi)| match pi {
        Some(pi) => binary(Operator::Mul, n, pi),
        None => n,
    });
    let value = (alt((multiple, pi, group)), opt(tail));
    let named = (alt((call, parameter)), opt(known_tail));
    let (value, tail) = alt((value, named)).parse_next(i)?;
    Ok(match tail {
        Some(tail) => {
            i.state.tailed = i.current_token_start();
            binary(Operator::Mul, value, tail)
        }
        None => value,
    })
}

/// Parses degrees with minutes, seconds, or both.
fn arc(i: &mut ExpressionInput) -> ParseResult<Expr> {
    // This attempt may meet another unit or none, so it reports no fault.
    let degree = token(alt(("°", word))).verify_map(|(name, span)| {
        let unit = unit_named(name).filter(|_| ["°", "deg"].contains(&name))?;
        Some(Expr { kind: ExprKind::Unit(unit), span })
    });
    let degrees = (number, terminated(degree, peek(number)));
    let minutes = |i: &mut ExpressionInput| part(i, &OF_ARC[0], &["′", "'", "’"]);
    let seconds =
        |i: &mut ExpressionInput| part(i, &OF_ARC[1], &["″", "\"", "”", "''", "′′", "’’"]);
    let ((whole, unit), smaller) = (
        degrees,
        alt((
            (seconds, "").map(|(s, _)| [Some(s), None]),
            (minutes, opt(seconds)).map(|(m, s)| [Some(m), s]),
        )),
    )
        .parse_next(i)?;
    Ok(smaller
        .into_iter()
        .flatten()
        .fold(binary(Operator::Mul, whole, unit), |sum, part| binary(Operator::Add, sum, part)))
}

/// Parses a number of sixtieths of a degree or of a minute, with one of their marks.
fn part(i: &mut ExpressionInput, unit: &'static Unit, marks: &[&'static str]) -> ParseResult<Expr> {
    let count = number(i)?;
    let mark = repeat(1.., one_of(['′', '\'', '’', '″', '"', '”']))
        .fold(|| (), |(), _| ())
        .take()
        .verify(|mark: &str| marks.contains(&mark));
    let (_, at) = token(mark).parse_next(i)?;
    let most =
        matches!(&count.kind, ExprKind::Number(n) if n.parse().is_ok_and(|n: f64| n >= 60.0));
    if most {
        let message = both!("a degree has 60 minutes and a minute 60 seconds of arc");
        let help = both!("write less than 60, and the rest before it");
        i.state.unknown.get_or_insert(
            Diagnostic::error("expression", message)
                .at(Span::new(count.span.start, at.end))
                .help(help),
        );
    }
    Ok(binary(Operator::Mul, count, Expr { kind: ExprKind::Unit(unit), span: at }))
}

/// Parses a factor that binds to a value without a sign.
fn tail(i: &mut ExpressionInput) -> ParseResult<Expr> {
    let factor = alt((group, unit)).parse_next(i)?;
    cut_err(|i: &mut ExpressionInput| raised(i, factor.clone())).parse_next(i)
}

/// Parses a unit after a value that is not a number; other words do not belong to the value.
fn known_tail(i: &mut ExpressionInput) -> ParseResult<Expr> {
    let turns = terminated("r/min", not(one_of(is_letter)));
    let known = token(alt(("°", turns, word)))
        .verify_map(|(name, span)| Some(Expr { kind: ExprKind::Unit(unit_named(name)?), span }));
    let unit = terminated(known, peek(not(token('(')))).parse_next(i)?;
    raised(i, unit)
}

fn exponent(i: &mut ExpressionInput) -> ParseResult<Expr> {
    token(alt((number, pi, group, call, name))).map(|(exponent, _)| exponent).parse_next(i)
}

fn number(i: &mut ExpressionInput) -> ParseResult<Expr> {
    let digits = alt(((digit1, opt(('.', digit0))).void(), ('.', digit1).void()));
    let power = (one_of(['e', 'E']), opt(one_of(['+', '-'])), digit1);
    let (text, span) = token((digits, opt(power)).take()).parse_next(i)?;
    Ok(Expr { kind: ExprKind::Number(text.to_owned()), span })
}

fn group(i: &mut ExpressionInput) -> ParseResult<Expr> {
    preceded(sign(['(']), cut_err(terminated(sum, sign([')'])))).parse_next(i)
}

fn word<'a>(i: &mut ExpressionInput<'a>) -> ParseResult<&'a str> {
    (one_of(char::is_alphabetic), take_while(0.., is_letter)).take().parse_next(i)
}

/// Parses the constant.
fn pi(i: &mut ExpressionInput) -> ParseResult<Expr> {
    token(word.verify(is_pi)).map(|(_, span)| Expr { kind: ExprKind::Pi, span }).parse_next(i)
}

/// Parses a unit directly after a value, or a degree sign.
fn unit(i: &mut ExpressionInput) -> ParseResult<Expr> {
    let turns = terminated("r/min", not(one_of(is_letter)));
    let (name, span) = token(alt(("°", turns, word))).parse_next(i)?;
    Ok(match unit_named(name).map(ExprKind::Unit) {
        Some(kind) => Expr { kind, span },
        None => {
            let why = not_a_unit(name, i.state.parameters);
            without_meaning(i, span, why)
        }
    })
}

/// Parses a function of a value in parentheses.
fn call(i: &mut ExpressionInput) -> ParseResult<Expr> {
    let (name, at) = terminated(token(word), peek(sign(['(']))).parse_next(i)?;
    let function = FUNCTIONS.iter().find(|(n, _)| *n == name).map(|(_, f)| *f);
    if function.is_none() {
        let why = not_a_function(name, i.state.parameters);
        without_meaning(i, at, why);
    }
    let argument = cut_err(group).parse_next(i)?;
    // Without a function there is a fault, and the tree is dropped.
    let kind = ExprKind::Call(function.unwrap_or(Function::Abs), Box::new(argument));
    Ok(Expr { kind, span: Span::new(at.start, i.current_token_start()) })
}

/// Parses a parameter.
fn parameter(i: &mut ExpressionInput) -> ParseResult<Expr> {
    let parameters = i.state.parameters;
    let known = |(name, span): (&str, Span)| {
        let kind = ExprKind::Parameter(name.to_owned());
        parameters.contains(&name).then_some(Expr { kind, span })
    };
    token(word).verify_map(known).parse_next(i)
}

/// Parses a single name: a parameter or a unit.
fn name(i: &mut ExpressionInput) -> ParseResult<Expr> {
    let (name, span) = token(word).parse_next(i)?;
    let parameter =
        i.state.parameters.contains(&name).then(|| ExprKind::Parameter(name.to_owned()));
    Ok(match parameter.or_else(|| unit_named(name).map(ExprKind::Unit)) {
        Some(kind) => Expr { kind, span },
        None => {
            let why = not_a_name(name, i.state.parameters);
            without_meaning(i, span, why)
        }
    })
}

/// Records a name without meaning; the returned expression replaces it until the text has been
/// read.
fn without_meaning(i: &mut ExpressionInput, span: Span, why: Diagnostic) -> Expr {
    i.state.unknown.get_or_insert(why.at(span));
    Expr { kind: ExprKind::Pi, span }
}

/// Returns true if a word is the constant.
pub(super) fn is_pi(word: &str) -> bool {
    word == "pi" || word == "π"
}

/// Returns true for a character that may follow the first letter of a name.
pub(super) fn is_letter(c: char) -> bool {
    c.is_alphabetic() || c.is_ascii_digit() || c == '_' || c == '\''
}

fn not_a_function(name: &str, parameters: &[&str]) -> Diagnostic {
    let d = Diagnostic::error("unknown-name", both!("`{name}` is not a function"));
    if parameters.contains(&name) || unit_named(name).is_some() {
        d.help(both!("for a product write `{name}*(...)`"))
    } else {
        d.help(suggest(name, FUNCTIONS.iter().map(|(n, _)| *n), both!("the functions are")))
    }
}

fn not_a_name(name: &str, parameters: &[&str]) -> Diagnostic {
    let d = Diagnostic::error("unknown-name", both!("`{name}` is neither a parameter nor a unit"));
    let known = parameters.iter().copied().chain(UNITS.iter().map(|u| u.name));
    if FUNCTIONS.iter().any(|(n, _)| *n == name) {
        d.help(both!("`{name}` is a function: write `{name}(...)`"))
    } else if parameters.is_empty() {
        let near = suggest(name, known, both!("the units are"));
        d.help(both!("{} (\"parameters\" of the scene name values)", near))
    } else {
        d.help(suggest(name, known, both!("there are")))
    }
}

fn not_a_unit(name: &str, parameters: &[&str]) -> Diagnostic {
    let d = Diagnostic::error("unknown-unit", both!("`{name}` is not a unit"));
    if parameters.contains(&name) || is_pi(name) {
        d.help(both!("for a product write `*{name}`"))
    } else {
        d.help(suggest(name, UNITS.iter().map(|u| u.name), both!("the units are")))
    }
}
