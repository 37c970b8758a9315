//! Laws of time: the exact derivative of an expression in `t`, as the text of another expression.
//!
//! Sum, product, quotient and chain rule on the tree of [`super::expr`]. A derivative that vanishes
//! for every t is `None`, so that its terms are not written. An angle inside sin, cos, tan is in
//! radians: its derivative is divided by 1 rad.

use super::expr::{Expr, ExprKind, Function, Operator};
use super::front::TIME;

/// The reason why a law has no derivative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NoDerivative {
    /// |u| has a corner.
    Corner,
    /// The exponent depends on time.
    Exponent,
}

/// Returns the time derivative of a law as the text of an expression; `None` if it vanishes for
/// every t.
///
/// # Errors
/// A corner, or an exponent that depends on time.
pub(super) fn derivative(e: &Expr) -> Result<Option<String>, NoDerivative> {
    Ok(match &e.kind {
        ExprKind::Number(_) | ExprKind::Pi | ExprKind::Unit(_) => None,
        ExprKind::Parameter(name) => (name == TIME).then(|| "1".to_owned()),
        ExprKind::Neg(u) => derivative(u)?.map(|d| format!("(-{d})")),
        ExprKind::Binary(op, a, b) => {
            let (da, db) = (derivative(a)?, derivative(b)?);
            let (a, b) = (text(a), text(b));
            match op {
                Operator::Add => joined(da, "+", db),
                Operator::Sub => joined(da, "-", db),
                Operator::Mul => joined(da.map(|d| times(&d, &b)), "+", db.map(|d| times(&d, &a))),
                Operator::Div => joined(
                    da.map(|d| format!("{d}/{b}")),
                    "-",
                    db.map(|d| format!("{a}*{d}/({b}*{b})")),
                ),
                Operator::Pow => match (da, db) {
                    (_, Some(_)) => return Err(NoDerivative::Exponent),
                    (Some(d), None) if b == "2" => Some(times(&d, &format!("(2*{a})"))),
                    (Some(d), None) => Some(times(&d, &format!("({b}*{a}^({b}-1))"))),
                    (None, None) => None,
                },
            }
        }
        ExprKind::Call(function, u) => {
            let Some(d) = derivative(u)? else { return Ok(None) };
            let u = text(u);
            Some(match function {
                Function::Sqrt => format!("({d}/(2*sqrt({u})))"),
                Function::Sin => format!("(cos({u})*{d}/(1 rad))"),
                Function::Cos => format!("(-sin({u})*{d}/(1 rad))"),
                Function::Tan => format!("({d}/(1 rad)/cos({u})^2)"),
                Function::Asin => format!("((1 rad)*{d}/sqrt(1-{u}^2))"),
                Function::Acos => format!("(-(1 rad)*{d}/sqrt(1-{u}^2))"),
                Function::Atan => format!("((1 rad)*{d}/(1+{u}^2))"),
                Function::Ln => format!("({d}/{u})"),
                Function::Log10 => format!("({d}/({u}*ln(10)))"),
                Function::Exp => format!("(exp({u})*{d})"),
                Function::Abs => return Err(NoDerivative::Corner),
            })
        }
    })
}

/// Returns a product; a factor 1 is not written.
fn times(d: &str, other: &str) -> String {
    if d == "1" { other.to_owned() } else { format!("({other}*{d})") }
}

fn joined(a: Option<String>, sign: &str, b: Option<String>) -> Option<String> {
    match (a, b) {
        (Some(a), Some(b)) => Some(format!("({a}{sign}{b})")),
        (Some(a), None) => Some(a),
        (None, Some(b)) if sign == "-" => Some(format!("(-{b})")),
        (None, Some(b)) => Some(b),
        (None, None) => None,
    }
}

/// Returns a tree as text, each operation in parentheses.
fn text(e: &Expr) -> String {
    match &e.kind {
        ExprKind::Number(n) => n.clone(),
        ExprKind::Pi => "pi".to_owned(),
        ExprKind::Unit(u) => format!("(1 {})", u.name),
        ExprKind::Parameter(name) => name.clone(),
        ExprKind::Neg(u) => format!("(-{})", text(u)),
        ExprKind::Binary(op, a, b) => {
            if let (Operator::Mul, ExprKind::Number(n), ExprKind::Unit(u)) = (op, &a.kind, &b.kind)
            {
                return format!("({n} {})", u.name);
            }
            let sign = match op {
                Operator::Add => "+",
                Operator::Sub => "-",
                Operator::Mul => "*",
                Operator::Div => "/",
                Operator::Pow => "^",
            };
            format!("({}{sign}{})", text(a), text(b))
        }
        ExprKind::Call(function, u) => format!("{}({})", function.name(), text(u)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::parse;

    fn of(law: &str) -> Option<String> {
        derivative(&parse(law, &["t", "b"]).unwrap()).unwrap()
    }

    #[test]
    fn rules() {
        assert_eq!(of("b + 3 m"), None);
        assert_eq!(of("t").as_deref(), Some("1"));
        assert_eq!(of("b - t").as_deref(), Some("(-1)"));
        assert_eq!(of("t*t").as_deref(), Some("(t+t)"));
        assert_eq!(of("sqrt(t)").as_deref(), Some("(1/(2*sqrt(t)))"));
        let corner = parse("abs(t)", &["t"]).unwrap();
        assert_eq!(derivative(&corner), Err(NoDerivative::Corner));
        let exponent = parse("2^t", &["t"]).unwrap();
        assert_eq!(derivative(&exponent), Err(NoDerivative::Exponent));
    }
}
