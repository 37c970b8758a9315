//! Expressions: parsing to a tree that keeps every number literal as written, and evaluation to `f64` with a dimension.
//!
//! The tree is public because the precision ladder evaluates it again with more digits. Places in the tree are byte
//! offsets into the expression's own text.

use super::units::{Dim, UNITS, Unit, radians, unit_named};
use crate::diag::{Diagnostic, Span};
use crate::trig;
use crate::{scene::Angle, scene::fields::suggest};

/// Longer expressions are refused: nobody writes them by hand, and the tree's depth is bounded by the length.
pub const MAX_LENGTH: usize = 400;

/// Deeper parentheses are refused: the parser recurses.
const MAX_PARENTHESES: usize = 24;

/// Larger or (unless zero) smaller values are refused. Squares and products of three values of this size still are
/// finite in `f64`; a mechanism of a nanometre or a light year is far inside.
const HUGE: f64 = 1e90;

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
}

const FUNCTIONS: [(&str, Function); 8] = [
    ("sqrt", Function::Sqrt),
    ("sin", Function::Sin),
    ("cos", Function::Cos),
    ("tan", Function::Tan),
    ("asin", Function::Asin),
    ("acos", Function::Acos),
    ("atan", Function::Atan),
    ("abs", Function::Abs),
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
    let fault = |message: String| Diagnostic::error("expression", message);
    if text.len() > MAX_LENGTH {
        return Err(fault(format!("an expression has at most {MAX_LENGTH} bytes, this has {}", text.len()))
            .help("name its parts in \"parameters\""));
    }
    let mut depth = 0usize;
    for (i, c) in text.char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth > MAX_PARENTHESES {
            return Err(fault(format!("parentheses are nested more than {MAX_PARENTHESES} deep")).at(Span::new(i, i + 1)));
        }
    }
    let mut pairs = Grammar::parse(Rule::whole, text).map_err(|e| {
        let at = match e.location {
            pest::error::InputLocation::Pos(p) | pest::error::InputLocation::Span((p, _)) => p,
        };
        let rest = text.get(at..).unwrap_or_default();
        match rest.chars().next() {
            None => fault(format!("`{text}` ends too early")).at(Span::new(0, text.len())),
            Some(c) => {
                let d = fault(format!("`{text}` cannot be read from `{rest}` on")).at(Span::new(at, at + c.len_utf8()));
                d.help("an expression is made of numbers, units, parameters, + - * / ^ ( ) and functions, such as \"2*r + 5 mm\"")
            }
        }
    })?;
    let sum = pairs.next().and_then(|whole| whole.into_inner().next());
    let sum = sum.ok_or_else(|| fault("the expression is empty".to_owned()))?;
    Builder { parameters }.chain(sum)
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
            let d = Diagnostic::error("unknown-name", format!("`{}` is not a function", name.as_str())).at(place(&name));
            let known = FUNCTIONS.iter().map(|(n, _)| *n);
            let times = self.parameters.contains(&name.as_str()) || unit_named(name.as_str()).is_some();
            return Err(if times {
                d.help(format!("for a product write `{}*(...)`", name.as_str()))
            } else {
                d.help(suggest(name.as_str(), known, "the functions are"))
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
        let d = Diagnostic::error("unknown-name", format!("`{name}` is neither a parameter nor a unit")).at(span);
        let known = self.parameters.iter().copied().chain(UNITS.iter().map(|u| u.name));
        Err(if FUNCTIONS.iter().any(|(n, _)| *n == name) {
            d.help(format!("`{name}` is a function: write `{name}(...)`"))
        } else if self.parameters.is_empty() {
            d.help(format!("{} (\"parameters\" of the scene name values)", suggest(name, known, "the units are")))
        } else {
            d.help(suggest(name, known, "there are"))
        })
    }

    fn not_a_unit(&self, name: &str, span: Span) -> Diagnostic {
        let d = Diagnostic::error("unknown-unit", format!("`{name}` is not a unit")).at(span);
        if self.parameters.contains(&name) || name == "pi" {
            d.help(format!("for a product write `*{name}`"))
        } else {
            d.help(suggest(name, UNITS.iter().map(|u| u.name), "the units are"))
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
    Diagnostic::error("expression", "a value is missing in the expression")
}

/// A number with its dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value {
    /// In SI units (metres, seconds, radians), or in degrees to the first power where `degrees` says so.
    pub number: f64,
    /// Its dimension.
    pub dim: Dim,
    /// Whether one angle in the dimension is counted in degrees: `60 deg` stays 60, `300 rpm` is 1800 per second.
    pub degrees: bool,
}

impl Value {
    const fn number(number: f64) -> Value {
        Value { number, dim: Dim::NUMBER, degrees: false }
    }

    /// The SI value (radians).
    pub fn si(self) -> f64 {
        if self.degrees { radians(self.number) } else { self.number }
    }

    /// The same in SI units throughout.
    fn plain(self) -> Value {
        Value { number: self.si(), degrees: false, ..self }
    }

    /// As an angle; meaningful where `dim` is that of an angle.
    pub fn angle(self) -> Angle {
        if self.degrees { Angle::Deg(self.number) } else { Angle::Rad(self.number) }
    }
}

impl From<Angle> for Value {
    fn from(angle: Angle) -> Value {
        match angle {
            Angle::Deg(number) => Value { number, dim: Dim::ANGLE, degrees: true },
            Angle::Rad(number) => Value { number, dim: Dim::ANGLE, degrees: false },
        }
    }
}

/// Why an expression has no value.
#[derive(Clone, Debug, PartialEq)]
pub enum NoValue {
    /// A fault, its span counted from the beginning of the expression.
    Fault(Diagnostic),
    /// It uses a parameter whose own fault has been reported already.
    Reported,
}

/// Evaluates an expression; `lookup` gives the value of a parameter, `None` where its own fault has been reported.
///
/// # Errors
/// Dimensions that do not fit, functions outside their domain, values that are not finite or beyond all measure.
pub fn evaluate(expr: &Expr, lookup: &dyn Fn(&str) -> Option<Value>) -> Result<Value, NoValue> {
    let of = |e: &Expr| evaluate(e, lookup);
    let fault = |message: String| NoValue::Fault(Diagnostic::error("expression", message).at(expr.span));
    let value = match &expr.kind {
        ExprKind::Number(text) => Value::number(literal(text).map_err(fault)?),
        ExprKind::Pi => Value::number(std::f64::consts::PI),
        ExprKind::Unit(unit) => in_unit(Value::number(1.0), unit),
        ExprKind::Parameter(name) => lookup(name).ok_or(NoValue::Reported)?,
        ExprKind::Neg(a) => {
            let a = of(a)?;
            Value { number: -a.number, ..a }
        }
        // A number with its unit is rounded once: 250 mm is 250/1000, not 250 * 0.001.
        ExprKind::Binary(Op::Mul, a, b) if matches!(b.kind, ExprKind::Unit(_)) => match &b.kind {
            ExprKind::Unit(unit) => in_unit(of(a)?, unit),
            _ => multiply(of(a)?, of(b)?, 1),
        },
        ExprKind::Binary(op, a, b) => {
            let (a, b) = (of(a)?, of(b)?);
            match op {
                Op::Add => add(a, b, 1.0).map_err(fault)?,
                Op::Sub => add(a, b, -1.0).map_err(fault)?,
                Op::Mul => multiply(a, b, 1),
                Op::Div if b.number == 0.0 => return Err(fault("division by zero".to_owned())),
                Op::Div => multiply(a, b, -1),
                Op::Pow => power(a, b).map_err(fault)?,
            }
        }
        ExprKind::Call(f, a) => call(*f, of(a)?).map_err(fault)?,
    };
    let size = value.number.abs();
    // Twenty: no quantity of kinematics comes near, and the exponents' own arithmetic stays small.
    if [value.dim.length, value.dim.time, value.dim.angle].iter().any(|k| k.abs() > 20) {
        return Err(fault("the powers of the units are beyond all measure".to_owned()));
    }
    if !size.is_finite() || size > HUGE || (size != 0.0 && size < 1.0 / HUGE) {
        return Err(fault(format!("the value {:e} is beyond all measure (1e-90 to 1e90)", value.number)));
    }
    Ok(value)
}

fn literal(text: &str) -> Result<f64, String> {
    let number: f64 = text.parse().map_err(|e| format!("`{text}` is not a number: {e}"))?;
    let mantissa = text.split(['e', 'E']).next().unwrap_or_default();
    if number == 0.0 && mantissa.bytes().any(|b| (b'1'..=b'9').contains(&b)) {
        return Err(format!("`{text}` is too small for a number"));
    }
    Ok(number)
}

fn in_unit(a: Value, unit: &Unit) -> Value {
    // Only one factor can be kept in degrees.
    let a = if unit.degrees { a.plain() } else { a };
    Value { number: a.number * unit.numerator / unit.denominator, dim: a.dim.times(unit.dim, 1), degrees: a.degrees || unit.degrees }
}

fn multiply(a: Value, b: Value, k: i32) -> Value {
    let dim = a.dim.times(b.dim, k);
    let (a, b, degrees) = match (a.degrees, b.degrees) {
        // The degrees of a ratio cancel exactly.
        (true, true) if k < 0 => (a.number, b.number, false),
        (true, true) => (a.si(), b.number, true),
        (false, true) if k < 0 => (a.number, b.si(), false),
        _ => (a.number, b.number, a.degrees || b.degrees),
    };
    Value { number: if k < 0 { a / b } else { a * b }, dim, degrees }
}

fn add(a: Value, b: Value, sign: f64) -> Result<Value, String> {
    if a.dim != b.dim && !(a.dim.serves(b.dim) && b.dim.serves(a.dim)) {
        let verb = if sign > 0.0 { "be added to" } else { "be subtracted from" };
        let (first, second) = if sign > 0.0 { (a.dim, b.dim) } else { (b.dim, a.dim) };
        return Err(format!("{} cannot {verb} {}", first.describe(), second.describe()));
    }
    // A length in metres and an arc in metres times radians: the radians are pure numbers there.
    let dim = if a.dim.angle == 0 { a.dim } else { b.dim };
    let (a, b) = if a.degrees == b.degrees && a.dim == b.dim { (a, b) } else { (a.plain(), b.plain()) };
    Ok(Value { number: a.number + sign * b.number, dim, degrees: a.degrees })
}

fn power(a: Value, b: Value) -> Result<Value, String> {
    if b.dim != Dim::NUMBER {
        return Err(format!("an exponent is a pure number, this is {}", b.dim.describe()));
    }
    let whole = libm::rint(b.number);
    if a.dim == Dim::NUMBER {
        if a.number < 0.0 && whole != b.number {
            return Err("a negative number has no broken power".to_owned());
        }
        return Ok(Value::number(libm::pow(a.number, b.number)));
    }
    if whole != b.number || whole.abs() > 6.0 {
        return Err("the exponent of a quantity with a unit is a whole number from -6 to 6".to_owned());
    }
    let k = whole as i32;
    if k == 1 {
        return Ok(a);
    }
    let a = a.plain();
    Ok(Value { number: libm::pow(a.number, whole), dim: Dim::NUMBER.times(a.dim, k), degrees: false })
}

fn call(f: Function, a: Value) -> Result<Value, String> {
    let wants = |dim: Dim, name: &str| match a.dim == dim {
        true => Ok(()),
        false if dim == Dim::ANGLE && a.dim == Dim::NUMBER && a.number == 0.0 => Ok(()),
        false if dim == Dim::ANGLE && a.dim == Dim::NUMBER => {
            Err(format!("{name} wants an angle, this is a pure number: write `deg` or `rad` after it"))
        }
        false => Err(format!("{name} wants {}, this is {}", dim.describe(), a.dim.describe())),
    };
    let inverse = |name: &str, g: fn(f64) -> Angle| {
        wants(Dim::NUMBER, name)?;
        let angle = g(a.number);
        match Value::from(angle).number.is_nan() {
            true => Err(format!("{name} has no value at {}", a.number)),
            false => Ok(Value::from(angle)),
        }
    };
    Ok(match f {
        Function::Abs => Value { number: a.number.abs(), ..a },
        Function::Sqrt => {
            if a.number < 0.0 {
                return Err(format!("sqrt of the negative value {}", a.number));
            }
            let d = a.dim;
            if [d.length, d.time, d.angle].iter().any(|k| k % 2 != 0) {
                return Err(format!("sqrt of {}: its unit is no square", d.describe()));
            }
            Value { number: a.si().sqrt(), dim: Dim { length: d.length / 2, time: d.time / 2, angle: d.angle / 2 }, degrees: false }
        }
        Function::Sin => {
            wants(Dim::ANGLE, "sin")?;
            Value::number(trig::sin_cos(a.angle()).0)
        }
        Function::Cos => {
            wants(Dim::ANGLE, "cos")?;
            Value::number(trig::sin_cos(a.angle()).1)
        }
        Function::Tan => {
            wants(Dim::ANGLE, "tan")?;
            let (s, c) = trig::sin_cos(a.angle());
            if c == 0.0 {
                return Err("tan of a right angle".to_owned());
            }
            Value::number(s / c)
        }
        Function::Asin => inverse("asin", trig::asin)?,
        Function::Acos => inverse("acos", trig::acos)?,
        Function::Atan => inverse("atan", trig::atan)?,
    })
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The value of an expression with r = 100 mm, phi = 30°, k = 2.
    fn value(text: &str) -> Result<Value, String> {
        let length = value_of("100 mm").expect("a length");
        let lookup = |name: &str| match name {
            "r" => Some(length),
            "phi" => Some(Value::from(Angle::Deg(30.0))),
            "k" => Some(Value::number(2.0)),
            _ => None,
        };
        let expr = parse(text, &["r", "phi", "k", "broken"]).map_err(|d| d.to_string())?;
        evaluate(&expr, &lookup).map_err(|e| match e {
            NoValue::Fault(d) => d.to_string(),
            NoValue::Reported => "reported".to_owned(),
        })
    }

    fn value_of(text: &str) -> Option<Value> {
        evaluate(&parse(text, &[]).ok()?, &|_| None).ok()
    }

    #[test]
    fn values() {
        let rpm = radians(6.0);
        for (text, number, what) in [
            ("250 mm", 0.25, "a length"),
            ("0.1mm", 0.0001, "a length"),
            ("3 ft", 0.9144, "a length"),
            ("1 in", 0.0254, "a length"),
            ("10 rad/s", 10.0, "an angular velocity"),
            ("60 rev/min", radians(360.0), "an angular velocity"),
            ("300 rpm", 300.0 * rpm, "an angular velocity"),
            ("2 rad/s^2", 2.0, "an angular acceleration"),
            ("9.81 m/s^2", 9.81, "an acceleration"),
            ("0.05 (m/s)/mm", 50.0, "a quantity in 1/s"),
            ("1 (m/s^2)/mm", 1000.0, "a quantity in 1/s^2"),
            ("0.002 m/mm", 2.0, "a pure number"),
            ("2 (m/s)^2", 2.0, "a quantity in m^2/s^2"),
            ("k*r + 5 mm", 0.2 + 0.005, "a length"),
            ("r/3 + 5 mm", 0.1 / 3.0 + 0.005, "a length"),
            ("sqrt(4)*r", 0.2, "a length"),
            ("sqrt(r^2)", 0.1, "a length"),
            ("r*sin(phi)", 0.05, "a length"),
            ("r*cos(2*phi)", 0.05, "a length"),
            ("(k + 1) mm", 0.003, "a length"),
            ("-k^2", -4.0, "a pure number"),
            ("--k - -1", 3.0, "a pure number"),
            ("2^-1", 0.5, "a pure number"),
            ("3 + 1e-6", 3.000001, "a pure number"),
            (".5", 0.5, "a pure number"),
            ("1e-3", 0.001, "a pure number"),
            ("abs(-r)", 0.1, "a length"),
            ("90 deg/phi", 3.0, "a pure number"),
            ("10 rad/s*r", 1.0, "a velocity"),
            ("pi rad/2", std::f64::consts::FRAC_PI_2, "an angle"),
            ("atan(1) + 15 deg", radians(60.0), "an angle"),
            ("tan(45 deg)", 1.0, "a pure number"),
            ("60 s + 1 min", 120.0, "a time"),
        ] {
            let v = value(text).unwrap_or_else(|e| panic!("{text}: {e}"));
            let dim = if v.dim.length != 0 { Dim { angle: 0, ..v.dim } } else { v.dim };
            assert_eq!((v.si(), dim.describe().as_str()), (number, what), "{text}");
        }
    }

    #[test]
    fn degrees_stay_degrees() {
        for (text, angle) in [
            ("60 deg", Angle::Deg(60.0)),
            ("60°", Angle::Deg(60.0)),
            ("2*phi", Angle::Deg(60.0)),
            ("phi*k - 10 deg", Angle::Deg(50.0)),
            ("-phi/3", Angle::Deg(-10.0)),
            ("0.5 rev", Angle::Deg(180.0)),
            ("asin(0.5)", Angle::Deg(30.0)),
            ("90 deg - acos(1/2)", Angle::Deg(30.0)),
            ("1 rad", Angle::Rad(1.0)),
        ] {
            let v = value(text).unwrap_or_else(|e| panic!("{text}: {e}"));
            assert_eq!((v.dim, v.angle()), (Dim::ANGLE, angle), "{text}");
        }
    }

    #[test]
    fn number_literals_keep_their_text() {
        let Expr { kind: ExprKind::Binary(Op::Mul, number, unit), span } = parse(" 0.10000000000000000001 mm", &[]).unwrap() else {
            panic!("no product")
        };
        assert_eq!(number.kind, ExprKind::Number("0.10000000000000000001".to_owned()));
        assert!(matches!(unit.kind, ExprKind::Unit(u) if u.name == "mm"));
        assert_eq!(span, Span::new(1, 26));
    }

    #[test]
    fn what_has_no_value() {
        for (text, said) in [
            ("", "`` ends too early"),
            ("2*", "`2*` ends too early"),
            ("2 $ 3", "`2 $ 3` cannot be read from `$ 3` on"),
            ("2 r", "`r` is not a unit (for a product write `*r`)"),
            ("2 pi", "`pi` is not a unit (for a product write `*pi`)"),
            ("5 milimeters", "`milimeters` is not a unit"),
            ("R", "`R` is neither a parameter nor a unit (did you mean `r`?)"),
            ("sine(phi)", "`sine` is not a function (did you mean `sin`?)"),
            ("r(2)", "`r` is not a function (for a product write `r*(...)`)"),
            ("sin", "`sin` is neither a parameter nor a unit (`sin` is a function: write `sin(...)`)"),
            ("1/0", "division by zero"),
            ("r + phi", "a length cannot be added to an angle"),
            ("r - 1", "a pure number cannot be subtracted from a length"),
            ("sin(30)", "sin wants an angle, this is a pure number: write `deg` or `rad` after it"),
            ("sin(r)", "sin wants an angle, this is a length"),
            ("asin(2)", "asin has no value at 2"),
            ("asin(phi)", "asin wants a pure number, this is an angle"),
            ("tan(90 deg)", "tan of a right angle"),
            ("sqrt(-1)", "sqrt of the negative value -1"),
            ("sqrt(r)", "sqrt of a length: its unit is no square"),
            ("2^r", "an exponent is a pure number, this is a length"),
            ("r^0.5", "the exponent of a quantity with a unit is a whole number from -6 to 6"),
            ("(-8)^(1/3)", "a negative number has no broken power"),
            ("10^99", "the value 1e99 is beyond all measure (1e-90 to 1e90)"),
            ("1e999", "the value inf is beyond all measure (1e-90 to 1e90)"),
            ("1e-999", "`1e-999` is too small for a number"),
            ("2^2^2", "`2^2^2` cannot be read from `^2` on"),
            ("broken + 1", "reported"),
        ] {
            let e = value(text).expect_err(text);
            assert!(e.starts_with(said), "{text}: {e}");
        }
        assert!(value(&"(".repeat(25)).unwrap_err().starts_with("parentheses are nested more than 24 deep"));
        assert!(value(&"1+".repeat(201)).unwrap_err().starts_with("an expression has at most 400 bytes, this has 402"));
        // The deepest trees that the limits let through.
        assert_eq!(value(&format!("{}1", "1+".repeat(199))).unwrap().number, 200.0);
        assert_eq!(value(&format!("{}1", "-".repeat(399))).unwrap().number, -1.0);
        assert_eq!(value(&format!("{}1{}", "(".repeat(24), ")".repeat(24))).unwrap().number, 1.0);
    }
}
