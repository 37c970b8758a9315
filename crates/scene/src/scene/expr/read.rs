//! The parser of expressions: recursive descent with one token of lookahead.
//!
//! The grammar, in which a unit directly after a number binds tighter than any operator (10 rad/s = (10 rad)/s), and so does a
//! parenthesis (0.05 (m/s)/mm = (0.05*(m/s))/mm):
//! ```text
//! sum      = product (("+" | "-") product)*
//! product  = signed (("*" | "/") signed)*
//! signed   = ("+" | "-")* power
//! power    = atom raised?
//! raised   = "^" ("+" | "-")* (number | pi | call | group | name) | "⁻"? ("⁰" | ... | "⁹")+
//! atom     = (number pi? | pi | group) tail? | call | name | "°"
//! tail     = (group | unit) raised?
//! call     = name "(" sum ")"
//! group    = "(" sum ")"
//! unit     = "°" | "r/min" | name
//! number   = (digit+ ("." digit*)? | "." digit+) (("e" | "E") ("+" | "-")? digit+)?
//! pi       = "pi" | "π"
//! name     = letter (letter | digit | "_" | "'")*
//! ```
//! The minus sign − and the dots and crosses · ⋅ × of products are read as `-` and `*`.
//! The grammar is too small to earn a parser generator, whose macros take longer to build than all that reads a scene.

use super::{Expr, ExprKind, FUNCTIONS, Function, Op};
use crate::diag::{Both, Diagnostic, Span, both};
use crate::json::fields::suggest;
use crate::scene::units::{UNITS, unit_named};

/// Reads a whole text.
pub(super) fn whole(text: &str, parameters: &[&str]) -> Result<Expr, Diagnostic> {
    let mut reader = Reader { text, at: 0, end: 0, parameters, unknown: None };
    let Some(tree) = reader.sum().filter(|_| reader.peek().is_none()) else {
        return Err(unreadable(text, reader.at));
    };
    reader.unknown.map_or(Ok(tree), Err)
}

const SIGNS: [char; 3] = ['+', '-', '−'];
const TIMES: [char; 4] = ['*', '·', '⋅', '×'];

const SUPERSCRIPT: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

/// What is said of a text that is no expression from a byte on.
fn unreadable(text: &str, at: usize) -> Diagnostic {
    let fault = |message: Both| Diagnostic::error("expression", message);
    let rest = text.get(at..).unwrap_or_default();
    match rest.chars().next() {
        None => fault(both!("`{text}` ends too early", "`{text}` 不完整")).at(Span::new(0, text.len())),
        // A comma between digits is a decimal comma: nothing else is parted by commas here.
        Some(',') if decimal_comma(text, at) => {
            let d = fault(both!("`{text}` has a comma in a number", "`{text}` 的数中有逗号")).at(Span::new(at, at + 1));
            d.help(both!("write the decimal point: \"{}.{}\"", "请用小数点：\"{}.{}\"", &text[..at], &text[at + 1..]))
        }
        Some(',') => {
            let d = fault(both!("`{text}` has a comma between two values", "`{text}` 的两个值之间有逗号")).at(Span::new(at, at + 1));
            d.help(both!(
                "a function takes one value; the angle whose tangent is y/x is \"atan(y/x)\"",
                "函数只取一个值；正切为 y/x 的角写作 \"atan(y/x)\""
            ))
        }
        Some(c) => {
            let d = fault(both!("`{text}` cannot be read from `{rest}` on", "`{text}` 从 `{rest}` 起无法识别"))
                .at(Span::new(at, at + c.len_utf8()));
            let turns = |words: &[&str]| words.iter().any(|w| rest.starts_with(w));
            if turns(&["clockwise", "cw", "顺时针"]) {
                return d.help(both!("clockwise is a minus sign: \"-{}\"", "顺时针用负号：\"-{}\"", text[..at].trim()));
            }
            if turns(&["counter", "anti", "ccw", "逆时针"]) {
                return d.help(both!("counter-clockwise is positive: \"{}\"", "逆时针为正：\"{}\"", text[..at].trim()));
            }
            d.help(both!(
                "an expression is made of numbers, units, parameters, + - * / ^ ( ) and functions, such as \"2*r + 5 mm\"",
                "表达式由数、单位、参数、+ - * / ^ ( ) 和函数组成，如 \"2*r + 5 mm\""
            ))
        }
    }
}

/// Whether the comma at a byte of a text stands between the two halves of one number: digits, none of which has a point already.
fn decimal_comma(text: &str, at: usize) -> bool {
    let (before, after) = (text[..at].trim_end_matches(|c: char| c.is_ascii_digit()), &text[at + 1..]);
    let left = at - before.len();
    let rest = after.trim_start_matches(|c: char| c.is_ascii_digit());
    left > 0 && rest.len() < after.len() && !before.ends_with('.') && !rest.starts_with('.')
}

fn binary(op: Op, a: Expr, b: Expr) -> Expr {
    let span = Span::new(a.span.start, b.span.end);
    Expr { kind: ExprKind::Binary(op, Box::new(a), Box::new(b)), span }
}

/// Reads the text from left to right. Its methods are the rules of the grammar; `None` says that the text breaks it at `at`.
struct Reader<'a> {
    text: &'a str,
    at: usize,
    /// Where the last token ends; spaces may follow it.
    end: usize,
    parameters: &'a [&'a str],
    /// The first name without a meaning: told only of texts that keep to the grammar.
    unknown: Option<Diagnostic>,
}

impl<'a> Reader<'a> {
    /// The next character that is not a space.
    fn peek(&mut self) -> Option<char> {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start_matches([' ', '\t']).len();
        self.text[self.at..].chars().next()
    }

    /// Takes the next character where it is one of these.
    fn take(&mut self, of: &[char]) -> Option<char> {
        let c = self.peek().filter(|c| of.contains(c))?;
        self.token(c.len_utf8());
        Some(c)
    }

    /// Takes as many bytes.
    fn token(&mut self, length: usize) -> Span {
        let span = Span::new(self.at, self.at + length);
        (self.at, self.end) = (span.end, span.end);
        span
    }

    fn sum(&mut self) -> Option<Expr> {
        let mut left = self.product()?;
        while let Some(sign) = self.take(&SIGNS) {
            let op = if sign == '+' { Op::Add } else { Op::Sub };
            left = binary(op, left, self.product()?);
        }
        Some(left)
    }

    fn product(&mut self) -> Option<Expr> {
        let mut left = self.signed(Reader::power)?;
        while let Some(sign) = self.take(&TIMES).or_else(|| self.take(&['/'])) {
            let op = if sign == '/' { Op::Div } else { Op::Mul };
            left = binary(op, left, self.signed(Reader::power)?);
        }
        Some(left)
    }

    /// Signs, then an operand.
    fn signed(&mut self, operand: fn(&mut Self) -> Option<Expr>) -> Option<Expr> {
        self.peek();
        let start = self.at;
        let mut negative = false;
        while let Some(sign) = self.take(&SIGNS) {
            negative ^= sign != '+';
        }
        let inner = operand(self)?;
        let span = Span::new(start, self.end);
        Some(if negative { Expr { kind: ExprKind::Neg(Box::new(inner)), span } } else { inner })
    }

    fn power(&mut self) -> Option<Expr> {
        let base = self.atom()?;
        self.raised(base)
    }

    /// `base` and the exponent that may follow.
    fn raised(&mut self, base: Expr) -> Option<Expr> {
        if self.take(&['^']).is_some() {
            return Some(binary(Op::Pow, base, self.signed(Reader::exponent)?));
        }
        let start = self.at;
        let negative = self.take(&['⁻']).is_some();
        let digits = self.at;
        let mut number = String::new();
        while let Some(digit) = self.take(&SUPERSCRIPT) {
            number.extend(SUPERSCRIPT.iter().position(|c| *c == digit).and_then(|d| char::from_digit(d as u32, 10)));
        }
        if number.is_empty() {
            return if negative { None } else { Some(base) };
        }
        let value = Expr { kind: ExprKind::Number(number), span: Span::new(digits, self.end) };
        let span = Span::new(start, self.end);
        let exponent = if negative { Expr { kind: ExprKind::Neg(Box::new(value)), span } } else { value };
        Some(binary(Op::Pow, base, exponent))
    }

    fn atom(&mut self) -> Option<Expr> {
        let value = match self.peek()? {
            '°' => return self.unit(),
            c if c.is_alphabetic() => match self.pi() {
                Some(pi) => pi,
                None => return self.name_or_call(),
            },
            '(' => self.group()?,
            _ => {
                let number = self.number()?;
                self.peek();
                match self.pi() {
                    Some(pi) => binary(Op::Mul, number, pi),
                    None => number,
                }
            }
        };
        let tail = match self.peek() {
            Some('(') => self.group()?,
            Some(c) if c == '°' || c.is_alphabetic() => self.unit()?,
            _ => return Some(value),
        };
        let tail = self.raised(tail)?;
        Some(binary(Op::Mul, value, tail))
    }

    fn exponent(&mut self) -> Option<Expr> {
        match self.peek()? {
            '(' => self.group(),
            c if c.is_alphabetic() => self.pi().or_else(|| self.name_or_call()),
            _ => self.number(),
        }
    }

    /// The constant, where it stands here.
    fn pi(&mut self) -> Option<Expr> {
        let word = self.ahead();
        is_pi(self.spelt(word)).then(|| Expr { kind: ExprKind::Pi, span: self.token(word.end - word.start) })
    }

    fn number(&mut self) -> Option<Expr> {
        let span = self.token(number_length(&self.text[self.at..])?);
        Some(Expr { kind: ExprKind::Number(self.spelt(span).to_owned()), span })
    }

    fn group(&mut self) -> Option<Expr> {
        self.take(&['('])?;
        let inner = self.sum()?;
        self.take(&[')'])?;
        Some(inner)
    }

    /// The name that begins here; empty where there is none.
    fn ahead(&self) -> Span {
        let rest = &self.text[self.at..];
        let length = rest.find(|c: char| !is_letter(c)).unwrap_or(rest.len());
        Span::new(self.at, self.at + length)
    }

    fn spelt(&self, span: Span) -> &'a str {
        &self.text[span.start..span.end]
    }

    /// A unit directly after a value, or a degree sign.
    fn unit(&mut self) -> Option<Expr> {
        let rest = &self.text[self.at..];
        let sign = ["°", "r/min"]
            .into_iter()
            .find(|sign| rest.strip_prefix(sign).is_some_and(|after| *sign == "°" || !after.starts_with(is_letter)));
        let span = match sign {
            Some(sign) => self.token(sign.len()),
            None => self.token(self.ahead().end - self.at),
        };
        let name = self.spelt(span);
        Some(match unit_named(name) {
            Some(unit) => Expr { kind: ExprKind::Unit(unit), span },
            None => self.without_meaning(span, not_a_unit(name, self.parameters)),
        })
    }

    /// What a name is: a function before a parenthesis, else a parameter or a unit.
    fn name_or_call(&mut self) -> Option<Expr> {
        let word = self.token(self.ahead().end - self.at);
        let name = self.spelt(word);
        if self.peek() != Some('(') {
            return Some(if self.parameters.contains(&name) {
                Expr { kind: ExprKind::Parameter(name.to_owned()), span: word }
            } else if let Some(unit) = unit_named(name) {
                Expr { kind: ExprKind::Unit(unit), span: word }
            } else {
                self.without_meaning(word, not_a_name(name, self.parameters))
            });
        }
        let function = FUNCTIONS.iter().find(|(n, _)| *n == name).map(|(_, f)| *f);
        if function.is_none() {
            self.without_meaning(word, not_a_function(name, self.parameters));
        }
        let argument = self.group()?;
        // Without a function there is a diagnosis, and the tree is dropped.
        let function = function.unwrap_or(Function::Abs);
        Some(Expr { kind: ExprKind::Call(function, Box::new(argument)), span: Span::new(word.start, self.end) })
    }

    /// Notes a name without meaning; what is returned takes its place until the text has been read to its end.
    fn without_meaning(&mut self, span: Span, why: Diagnostic) -> Expr {
        self.unknown.get_or_insert(why.at(span));
        Expr { kind: ExprKind::Pi, span }
    }
}

/// Whether a word is the constant.
pub(super) fn is_pi(word: &str) -> bool {
    word == "pi" || word == "π"
}

/// What a name is made of after its first letter.
pub(super) fn is_letter(c: char) -> bool {
    c.is_alphabetic() || c.is_ascii_digit() || c == '_' || c == '\''
}

/// How many bytes of a text are the number that it begins with; `None` where it begins with none.
fn number_length(text: &str) -> Option<usize> {
    let digits = |from: usize| text[from..].bytes().take_while(u8::is_ascii_digit).count();
    let whole = digits(0);
    let mut end = whole;
    if text[end..].starts_with('.') {
        let after = digits(end + 1);
        if whole + after == 0 {
            return None;
        }
        end += 1 + after;
    } else if whole == 0 {
        return None;
    }
    if let Some(power) = text[end..].strip_prefix(['e', 'E']) {
        let sign = usize::from(power.starts_with(['+', '-']));
        let after = digits(end + 1 + sign);
        if after > 0 {
            end += 1 + sign + after;
        }
    }
    Some(end)
}

fn not_a_function(name: &str, parameters: &[&str]) -> Diagnostic {
    let d = Diagnostic::error("unknown-name", both!("`{name}` is not a function", "`{name}` 不是函数"));
    if parameters.contains(&name) || unit_named(name).is_some() {
        d.help(both!("for a product write `{name}*(...)`", "乘积请写 `{name}*(...)`"))
    } else {
        d.help(suggest(name, FUNCTIONS.iter().map(|(n, _)| *n), both!("the functions are", "函数有")))
    }
}

fn not_a_name(name: &str, parameters: &[&str]) -> Diagnostic {
    let d = Diagnostic::error("unknown-name", both!("`{name}` is neither a parameter nor a unit", "`{name}` 既不是参数也不是单位"));
    let known = parameters.iter().copied().chain(UNITS.iter().map(|u| u.name));
    if FUNCTIONS.iter().any(|(n, _)| *n == name) {
        d.help(both!("`{name}` is a function: write `{name}(...)`", "`{name}` 是函数：请写 `{name}(...)`"))
    } else if parameters.is_empty() {
        let near = suggest(name, known, both!("the units are", "单位有"));
        d.help(both!("{} (\"parameters\" of the scene name values)", "{}（数值可在 \"parameters\" 中命名）", near))
    } else {
        d.help(suggest(name, known, both!("there are", "有")))
    }
}

fn not_a_unit(name: &str, parameters: &[&str]) -> Diagnostic {
    let d = Diagnostic::error("unknown-unit", both!("`{name}` is not a unit", "`{name}` 不是单位"));
    if parameters.contains(&name) || is_pi(name) {
        d.help(both!("for a product write `*{name}`", "乘积请写 `*{name}`"))
    } else {
        d.help(suggest(name, UNITS.iter().map(|u| u.name), both!("the units are", "单位有")))
    }
}
