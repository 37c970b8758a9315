//! Expressions: parsing to a tree that keeps every number literal as written. [`super::eval`]
//! computes their values.
//!
//! The tree is public because the precision ladder evaluates it again with more digits. Places in
//! the tree are byte offsets into the expression's own text.

use super::units::{Unit, unit_named};
use hodograph_base::diag::{Both, Diagnostic, Span, both};

/// Longest expression in a file: parts of longer ones can be parameters.
pub const MAX_LENGTH: usize = 400;
/// Deepest nesting of parentheses in a file.
const MAX_PARENTHESES: usize = 24;

/// Longest expression made of a file's expressions, such as a derivative, which repeats its parts.
const MAX_MADE_LENGTH: usize = 16_000;
/// Deepest nesting of parentheses there: the parser is recursive.
const MAX_MADE_PARENTHESES: usize = 64;
/// Deepest tree: functions over the tree are recursive.
const MAX_DEPTH: usize = 400;

mod read;

/// An expression and its place in its own text.
#[derive(Clone, Debug, PartialEq)]
pub struct Expr {
    /// Its kind.
    pub kind: ExprKind,
    /// Range of bytes in its text.
    pub span: Span,
}

impl Expr {
    /// Returns the parameters in it, once for each occurrence.
    pub fn parameters(&self) -> Vec<&str> {
        match &self.kind {
            ExprKind::Number(_) | ExprKind::Pi | ExprKind::Unit(_) => Vec::new(),
            ExprKind::Parameter(name) => vec![name],
            ExprKind::Neg(u) | ExprKind::Call(_, u) => u.parameters(),
            ExprKind::Binary(_, a, b) => [a.parameters(), b.parameters()].concat(),
        }
    }
}

/// The kinds of expression.
#[derive(Clone, Debug, PartialEq)]
pub enum ExprKind {
    /// A number literal, exactly as written.
    Number(String),
    /// The ratio of a circle's circumference to its diameter.
    Pi,
    /// A unit, with the value one.
    Unit(&'static Unit),
    /// A parameter, by name.
    Parameter(String),
    /// The negative.
    Neg(Box<Expr>),
    /// Two operands.
    Binary(Operator, Box<Expr>, Box<Expr>),
    /// A function of one argument.
    Call(Function, Box<Expr>),
}

/// Operators.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
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
#[non_exhaustive]
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
    /// Returns its name in expressions.
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

/// Units whose names a parameter may have: `h` is the usual letter of a height, and no quantity of
/// a mechanism is given per hour; `g`, `N` and `W` are those of gravity, a normal force and a
/// weight. Directly after a number they are units.
const HIDEABLE: [&str; 15] =
    ["h", "min", "in", "ft", "kg", "g", "lb", "slug", "blob", "N", "kN", "kgf", "lbf", "W", "kW"];

/// Returns true if a name has a meaning in every expression (a unit, a function, pi) and cannot
/// name a parameter.
pub fn is_reserved(name: &str) -> bool {
    let unit = unit_named(name).is_some() && !HIDEABLE.contains(&name);
    read::is_pi(name) || unit || FUNCTIONS.iter().any(|(n, _)| *n == name)
}

/// Returns true if an expression is a single name that could name a parameter.
pub fn is_name(text: &str) -> bool {
    let mut chars = text.chars();
    chars.next().is_some_and(char::is_alphabetic) && chars.all(read::is_letter)
}

/// Checks the limits of written expressions.
///
/// # Errors
/// A diagnostic with its span from the beginning of `text`: too long, or parentheses too deep.
pub fn bounded(text: &str) -> Result<(), Diagnostic> {
    within(text, MAX_LENGTH, MAX_PARENTHESES)
}

fn within(text: &str, length: usize, parentheses: usize) -> Result<(), Diagnostic> {
    let fault = |message: Both| Diagnostic::error("expression", message);
    if text.len() > length {
        return Err(fault(both!(
            "an expression has at most {length} bytes, this has {}",
            text.len()
        ))
        .help(both!("name its parts in \"parameters\"")));
    }
    let mut depth = 0usize;
    for (i, c) in text.char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth > parentheses {
            return Err(fault(both!("parentheses are nested more than {parentheses} deep"))
                .at(Span::new(i, i + 1)));
        }
    }
    Ok(())
}

/// Parses an expression of a file, or one made of such expressions. `parameters` are the permitted
/// names besides units.
///
/// # Errors
/// A diagnostic with its span from the beginning of `text`: too long, too deep, not an expression,
/// an unknown name.
pub fn parse(text: &str, parameters: &[&str]) -> Result<Expr, Diagnostic> {
    within(text, MAX_MADE_LENGTH, MAX_MADE_PARENTHESES)?;
    let tree = read::whole(text, parameters)?;
    if text.len() > MAX_LENGTH && depth(&tree) > MAX_DEPTH {
        return Err(Diagnostic::error(
            "expression",
            both!("an expression has more than {MAX_DEPTH} levels"),
        ));
    }
    Ok(tree)
}

fn depth(expr: &Expr) -> usize {
    match &expr.kind {
        ExprKind::Number(_) | ExprKind::Pi | ExprKind::Unit(_) | ExprKind::Parameter(_) => 1,
        ExprKind::Neg(a) | ExprKind::Call(_, a) => 1 + depth(a),
        ExprKind::Binary(_, a, b) => 1 + depth(a).max(depth(b)),
    }
}

/// Returns true if the expression contains neither a unit nor a parameter.
pub fn is_bare(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Number(_) | ExprKind::Pi => true,
        ExprKind::Unit(_) | ExprKind::Parameter(_) => false,
        ExprKind::Neg(a) | ExprKind::Call(_, a) => is_bare(a),
        ExprKind::Binary(_, a, b) => is_bare(a) && is_bare(b),
    }
}

/// Returns a quotient with the unit outside, if the unit binds to the divisor: `(k/2) m` for
/// `k/2 m`, which is k/(2 m). Returns `None` for other expressions.
pub(super) fn unit_in_divisor(text: &str, expr: &Expr) -> Option<String> {
    let ExprKind::Binary(Operator::Div, _, divisor) = &expr.kind else { return None };
    let ExprKind::Binary(Operator::Mul, value, unit) = &divisor.kind else { return None };
    let (left, between) = (text.get(..value.span.end)?, text.get(value.span.end..unit.span.start)?);
    // A divisor in parentheses is intended.
    let meant =
        left.get(..value.span.start)?.trim_end().ends_with('(') || !between.trim().is_empty();
    (!meant).then(|| {
        format!("({}) {}", left.trim(), text.get(unit.span.start..).unwrap_or_default().trim())
    })
}
