//! Expressions: parsing to a tree that keeps every number literal as written. Their values are the business of [`super::eval`].
//!
//! The tree is public because the precision ladder evaluates it again with more digits. Places in the tree are byte
//! offsets into the expression's own text.

use super::units::{UNITS, Unit, unit_named};
use crate::diag::{Both, Diagnostic, Span, both};
use crate::json::fields::suggest;

/// Longer expressions are refused: the depth of the syntax tree is bounded by the length.
pub const MAX_LENGTH: usize = 400;

/// Deeper parentheses are refused: the parser recurses.
const MAX_PARENTHESES: usize = 24;

mod grammar {
    /// The parser that `expr.pest` describes.
    #[derive(pest_derive::Parser)]
    #[grammar = "scene/expr.pest"]
    pub struct Grammar;
}
use grammar::{Grammar, Rule};
use pest::{Parser, iterators::Pair};

/// An expression and its place in its own text.
#[derive(Clone, Debug, PartialEq)]
pub struct Expr {
    /// What it is.
    pub kind: ExprKind,
    /// Bytes of the text it was parsed from.
    pub span: Span,
}

/// The kinds of expression.
#[derive(Clone, Debug, PartialEq)]
pub enum ExprKind {
    /// A number literal, exactly as written.
    Number(String),
    /// The ratio of a circle's circumference to its diameter.
    Pi,
    /// One of a unit.
    Unit(&'static Unit),
    /// A parameter, by name.
    Parameter(String),
    /// The negative.
    Neg(Box<Expr>),
    /// Two operands.
    Binary(Op, Box<Expr>, Box<Expr>),
    /// A function of one argument.
    Call(Function, Box<Expr>),
}

/// Operators.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Op {
    /// `+`
    Add,
    /// `-`
    Sub,
    /// `*`, or nothing between a number and its unit.
    Mul,
    /// `/`
    Div,
    /// `^`
    Pow,
}

/// Functions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    /// Square root.
    Sqrt,
    /// Sine of an angle.
    Sin,
    /// Cosine of an angle.
    Cos,
    /// Tangent of an angle.
    Tan,
    /// Angle of a sine.
    Asin,
    /// Angle of a cosine.
    Acos,
    /// Angle of a tangent.
    Atan,
    /// Absolute value.
    Abs,
    /// Natural logarithm.
    Ln,
    /// Logarithm to the base ten.
    Log10,
    /// e to a power.
    Exp,
}

impl Function {
    /// Its name in expressions.
    pub fn name(self) -> &'static str {
        FUNCTIONS.iter().find(|(_, f)| *f == self).map_or("", |(name, _)| name)
    }
}

const FUNCTIONS: [(&str, Function); 11] = [
    ("sqrt", Function::Sqrt),
    ("sin", Function::Sin),
    ("cos", Function::Cos),
    ("tan", Function::Tan),
    ("asin", Function::Asin),
    ("acos", Function::Acos),
    ("atan", Function::Atan),
    ("abs", Function::Abs),
    ("ln", Function::Ln),
    ("log10", Function::Log10),
    ("exp", Function::Exp),
];

/// Units that a parameter may hide: `h` is the usual letter of a height, and no quantity of a mechanism is given per hour.
/// Directly after a number they still are units.
const HIDEABLE: [&str; 4] = ["h", "min", "in", "ft"];

/// Whether a name means something in every expression (a unit, a function, pi) and cannot name a parameter.
pub fn is_reserved(name: &str) -> bool {
    let unit = unit_named(name).is_some() && !HIDEABLE.contains(&name);
    name == "pi" || unit || FUNCTIONS.iter().any(|(n, _)| *n == name)
}

/// Whether an expression consists of a single name that could name a parameter.
pub fn is_name(text: &str) -> bool {
    let mut chars = text.chars();
    chars.next().is_some_and(char::is_alphabetic) && chars.all(|c| c.is_alphanumeric() || c == '_' || c == '\'')
}

/// Parses an expression. `parameters` are the names that may be used besides units.
///
/// # Errors
/// A diagnostic whose span counts from the beginning of `text`: too long, too deep, not an expression, an unknown name.
pub fn parse(text: &str, parameters: &[&str]) -> Result<Expr, Diagnostic> {
    let fault = |message: Both| Diagnostic::error("expression", message);
    if text.len() > MAX_LENGTH {
        return Err(fault(both!(
            "an expression has at most {MAX_LENGTH} bytes, this has {}",
            "表达式至多 {MAX_LENGTH} 字节，此处有 {} 字节",
            text.len()
        ))
        .help(both!("name its parts in \"parameters\"", "请在 \"parameters\" 中给各部分命名")));
    }
    let mut depth = 0usize;
    for (i, c) in text.char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth > MAX_PARENTHESES {
            return Err(fault(both!("parentheses are nested more than {MAX_PARENTHESES} deep", "括号嵌套超过 {MAX_PARENTHESES} 层"))
                .at(Span::new(i, i + 1)));
        }
    }
    let mut pairs = Grammar::parse(Rule::whole, text).map_err(|e| {
        let at = match e.location {
            pest::error::InputLocation::Pos(p) | pest::error::InputLocation::Span((p, _)) => p,
        };
        let rest = text.get(at..).unwrap_or_default();
        match rest.chars().next() {
            None => fault(both!("`{text}` ends too early", "`{text}` 不完整")).at(Span::new(0, text.len())),
            // A comma between digits is a decimal comma: nothing else is parted by commas here.
            Some(',') if decimal_comma(text, at) => {
                let d = fault(both!("`{text}` has a comma in a number", "`{text}` 的数中有逗号")).at(Span::new(at, at + 1));
                d.help(both!("write the decimal point: \"{}.{}\"", "请用小数点：\"{}.{}\"", &text[..at], &text[at + 1..]))
            }
            Some(c) => {
                let d = fault(both!("`{text}` cannot be read from `{rest}` on", "`{text}` 从 `{rest}` 起无法识别"))
                    .at(Span::new(at, at + c.len_utf8()));
                d.help(both!(
                    "an expression is made of numbers, units, parameters, + - * / ^ ( ) and functions, such as \"2*r + 5 mm\"",
                    "表达式由数、单位、参数、+ - * / ^ ( ) 和函数组成，如 \"2*r + 5 mm\""
                ))
            }
        }
    })?;
    let sum = pairs.next().and_then(|whole| whole.into_inner().next());
    let sum = sum.ok_or_else(|| fault(both!("the expression is empty", "表达式是空的")))?;
    Builder { parameters }.chain(sum)
}

/// Whether the comma at a byte of a text stands between two digits.
fn decimal_comma(text: &str, at: usize) -> bool {
    let digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    digit(text[..at].chars().next_back()) && digit(text[at + 1..].chars().next())
}

/// Turns the parser's pairs into the tree.
struct Builder<'a> {
    parameters: &'a [&'a str],
}

fn place(pair: &Pair<'_, Rule>) -> Span {
    Span::new(pair.as_span().start(), pair.as_span().end())
}

fn binary(op: Op, a: Expr, b: Expr) -> Expr {
    let span = Span::new(a.span.start, b.span.end);
    Expr { kind: ExprKind::Binary(op, Box::new(a), Box::new(b)), span }
}

impl Builder<'_> {
    /// `sum` and `product`: operands and operators in turn, from the left.
    fn chain(&self, pair: Pair<'_, Rule>) -> Result<Expr, Diagnostic> {
        let mut left: Option<Expr> = None;
        let mut op = Op::Mul;
        for part in pair.into_inner() {
            match part.as_rule() {
                Rule::add | Rule::mul => {
                    op = match part.as_str() {
                        "+" => Op::Add,
                        "-" => Op::Sub,
                        "*" => Op::Mul,
                        _ => Op::Div,
                    }
                }
                Rule::product => left = Some(join(left, op, self.chain(part)?)),
                _ => left = Some(join(left, op, self.signed(part)?)),
            }
        }
        left.ok_or_else(nothing)
    }

    /// `signed` and `exponent`: signs, then one operand.
    fn signed(&self, pair: Pair<'_, Rule>) -> Result<Expr, Diagnostic> {
        let span = place(&pair);
        let mut negative = false;
        for part in pair.into_inner() {
            if part.as_rule() == Rule::sign {
                negative ^= part.as_str() == "-";
                continue;
            }
            let inner = self.operand(part)?;
            return Ok(if negative { Expr { kind: ExprKind::Neg(Box::new(inner)), span } } else { inner });
        }
        Err(nothing())
    }

    fn operand(&self, pair: Pair<'_, Rule>) -> Result<Expr, Diagnostic> {
        let span = place(&pair);
        match pair.as_rule() {
            Rule::sum => self.chain(pair),
            Rule::number => Ok(Expr { kind: ExprKind::Number(pair.as_str().to_owned()), span }),
            Rule::constant => Ok(Expr { kind: ExprKind::Pi, span }),
            Rule::name => self.name(pair.as_str(), span),
            Rule::unit => match unit_named(pair.as_str()) {
                Some(u) => Ok(Expr { kind: ExprKind::Unit(u), span }),
                None => Err(self.not_a_unit(pair.as_str(), span)),
            },
            Rule::call => self.call(pair),
            Rule::quantity => {
                let mut inner = pair.into_inner();
                let value = self.operand(inner.next().ok_or_else(nothing)?)?;
                match inner.next() {
                    Some(tail) => Ok(binary(Op::Mul, value, self.power(tail)?)),
                    None => Ok(value),
                }
            }
            Rule::power => self.power(pair),
            // atom and group hold exactly one thing.
            _ => self.operand(pair.into_inner().next().ok_or_else(nothing)?),
        }
    }

    /// `power` and `tail`: an operand and perhaps an exponent.
    fn power(&self, pair: Pair<'_, Rule>) -> Result<Expr, Diagnostic> {
        let mut inner = pair.into_inner();
        let base = self.operand(inner.next().ok_or_else(nothing)?)?;
        match inner.next() {
            Some(exponent) => Ok(binary(Op::Pow, base, self.signed(exponent)?)),
            None => Ok(base),
        }
    }

    fn call(&self, pair: Pair<'_, Rule>) -> Result<Expr, Diagnostic> {
        let span = place(&pair);
        let mut inner = pair.into_inner();
        let (name, argument) = (inner.next().ok_or_else(nothing)?, inner.next().ok_or_else(nothing)?);
        let Some((_, function)) = FUNCTIONS.iter().find(|(n, _)| *n == name.as_str()) else {
            let d = Diagnostic::error("unknown-name", both!("`{}` is not a function", "`{}` 不是函数", name.as_str())).at(place(&name));
            let known = FUNCTIONS.iter().map(|(n, _)| *n);
            let times = self.parameters.contains(&name.as_str()) || unit_named(name.as_str()).is_some();
            return Err(if times {
                d.help(both!("for a product write `{}*(...)`", "乘积请写 `{}*(...)`", name.as_str()))
            } else {
                d.help(suggest(name.as_str(), known, both!("the functions are", "函数有")))
            });
        };
        Ok(Expr { kind: ExprKind::Call(*function, Box::new(self.chain(argument)?)), span })
    }

    fn name(&self, name: &str, span: Span) -> Result<Expr, Diagnostic> {
        if self.parameters.contains(&name) {
            return Ok(Expr { kind: ExprKind::Parameter(name.to_owned()), span });
        }
        if let Some(unit) = unit_named(name) {
            return Ok(Expr { kind: ExprKind::Unit(unit), span });
        }
        let d = Diagnostic::error("unknown-name", both!("`{name}` is neither a parameter nor a unit", "`{name}` 既不是参数也不是单位"))
            .at(span);
        let known = self.parameters.iter().copied().chain(UNITS.iter().map(|u| u.name));
        Err(if FUNCTIONS.iter().any(|(n, _)| *n == name) {
            d.help(both!("`{name}` is a function: write `{name}(...)`", "`{name}` 是函数：请写 `{name}(...)`"))
        } else if self.parameters.is_empty() {
            let near = suggest(name, known, both!("the units are", "单位有"));
            d.help(both!("{} (\"parameters\" of the scene name values)", "{}（数值可在 \"parameters\" 中命名）", near))
        } else {
            d.help(suggest(name, known, both!("there are", "有")))
        })
    }

    fn not_a_unit(&self, name: &str, span: Span) -> Diagnostic {
        let d = Diagnostic::error("unknown-unit", both!("`{name}` is not a unit", "`{name}` 不是单位")).at(span);
        if self.parameters.contains(&name) || name == "pi" {
            d.help(both!("for a product write `*{name}`", "乘积请写 `*{name}`"))
        } else {
            d.help(suggest(name, UNITS.iter().map(|u| u.name), both!("the units are", "单位有")))
        }
    }
}

fn join(left: Option<Expr>, op: Op, right: Expr) -> Expr {
    match left {
        Some(left) => binary(op, left, right),
        None => right,
    }
}

/// The grammar has an operand at every such place; should it ever be changed, this is the answer instead of a panic.
fn nothing() -> Diagnostic {
    Diagnostic::error("expression", both!("a value is missing in the expression", "表达式中缺少数值"))
}

/// Whether any unit or parameter occurs: whether more than a bare number was written.
pub fn is_bare(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Number(_) | ExprKind::Pi => true,
        ExprKind::Unit(_) | ExprKind::Parameter(_) => false,
        ExprKind::Neg(a) | ExprKind::Call(_, a) => is_bare(a),
        ExprKind::Binary(_, a, b) => is_bare(a) && is_bare(b),
    }
}
