//! A law of time prepared for many evaluations (constant folding): in one number type, all parts
//! without the time (parameters, literals) are evaluated once. A pursuit evaluates a law a thousand
//! times at each step of its integration.

use super::eval::{DimensionedValue, NoValue, evaluate};
use super::expr::{Expr, ExprKind, Operator};
use super::front::{Law, TIME, mentions};
use super::units::Dim;
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::number::{Jet, Real};

/// A law in one number type.
#[derive(Clone, Debug)]
pub struct Folded<N> {
    text: String,
    /// The law, with a parameter for each part without the time.
    expr: Expr,
    /// Values of these parameters: the k-th has the name k, which no parameter of a file can have.
    known: Vec<(String, DimensionedValue<Jet<N>>)>,
    /// Sine and cosine of a constant angle.
    turn: Option<(Jet<N>, Jet<N>)>,
}

impl<N: Real> Folded<N> {
    pub(super) fn new(law: &Law) -> Result<Folded<N>, Diagnostic> {
        let mut parameters: Vec<(&str, DimensionedValue<N>)> = Vec::new();
        for (name, expr) in &law.parameters {
            let value = valued(expr, &|wanted| find(&parameters, wanted))?;
            parameters.push((name, value));
        }
        let mut folded = Folded {
            text: law.text.clone(),
            expr: law.expr.clone(),
            known: Vec::new(),
            turn: None,
        };
        folded.expr = folded.fold(&law.expr, &parameters)?;
        if let [(_, value)] = folded.known[..]
            && matches!(folded.expr.kind, ExprKind::Parameter(ref name) if name != TIME)
            && (value.dim == Dim::ANGLE || value.dim == Dim::NUMBER)
        {
            folded.turn = Some(DimensionedValue::sin_cos(value));
        }
        Ok(folded)
    }

    fn fold(
        &mut self,
        expr: &Expr,
        parameters: &[(&str, DimensionedValue<N>)],
    ) -> Result<Expr, Diagnostic> {
        if !mentions(expr, TIME) {
            let DimensionedValue { number, dim, degrees } =
                valued(expr, &|wanted| find(parameters, wanted))?;
            let name = self.known.len().to_string();
            self.known.push((
                name.clone(),
                DimensionedValue { number: Jet::constant(number), dim, degrees },
            ));
            return Ok(Expr { kind: ExprKind::Parameter(name), span: expr.span });
        }
        let mut part = |e: &Expr| self.fold(e, parameters).map(Box::new);
        let kind = match &expr.kind {
            ExprKind::Number(_) | ExprKind::Pi | ExprKind::Unit(_) | ExprKind::Parameter(_) => {
                expr.kind.clone()
            }
            ExprKind::Neg(a) => ExprKind::Neg(part(a)?),
            ExprKind::Call(f, a) => ExprKind::Call(*f, part(a)?),
            // A unit after its number is not a separate factor: number and unit are rounded
            // together.
            ExprKind::Binary(Operator::Mul, a, b) if matches!(b.kind, ExprKind::Unit(_)) => {
                ExprKind::Binary(Operator::Mul, part(a)?, b.clone())
            }
            ExprKind::Binary(op, a, b) => ExprKind::Binary(*op, part(a)?, part(b)?),
        };
        Ok(Expr { kind, span: expr.span })
    }

    /// Returns value, rate and second derivative (SI) at a time (s); an angle keeps its degrees.
    ///
    /// # Errors
    /// A time at which the law has no value or no derivative.
    pub fn at(&self, t: N) -> Result<DimensionedValue<Jet<N>>, Diagnostic> {
        let time = DimensionedValue { number: Jet::variable(t), dim: Dim::TIME, degrees: false };
        let value = valued(&self.expr, &|wanted| {
            if wanted == TIME { Some(time) } else { find(&self.known, wanted) }
        })?;
        // A value that the number type cannot decide is undecided as a whole; a longer number type
        // may decide it.
        if value.number.is_decided() || !value.number.0[0].is_decided() {
            return Ok(value);
        }
        let message: Both = both!("`{}` has no derivative at t = {} s", self.text, t.approx());
        Err(Diagnostic::error("law", message))
    }

    /// Returns sine and cosine of an angle, which may be written in degrees.
    ///
    /// # Errors
    /// As [`Folded::at`].
    pub fn sine_cosine(&self, t: N) -> Result<(Jet<N>, Jet<N>), Diagnostic> {
        self.turn.map_or_else(|| self.at(t).map(DimensionedValue::sin_cos), Ok)
    }
}

fn find<S: AsRef<str>, V: Copy>(known: &[(S, V)], wanted: &str) -> Option<V> {
    known.iter().find(|(name, _)| name.as_ref() == wanted).map(|(_, value)| *value)
}

fn valued<N: Real>(
    expr: &Expr,
    lookup: &dyn Fn(&str) -> Option<DimensionedValue<N>>,
) -> Result<DimensionedValue<N>, Diagnostic> {
    evaluate(expr, lookup).map_err(|e| match e {
        NoValue::Fault(d) => d,
        NoValue::Reported => Diagnostic::error("expression", both!("a parameter has no value")),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::parse;

    /// All parts without the time are evaluated, and the value is that of the expression as
    /// written.
    #[test]
    fn what_stays_is_evaluated_once() {
        let names = ["r", "w", TIME];
        for text in [
            "r*sin(w*t + 30 deg) + 5 mm*sqrt(4)",
            "(2 + 3)*r",
            "-t",
            "0.1*(t/(1 s))^2*(1 m)",
            "60 deg",
            "exp(-0.5*t/(1 s))*r*cos(90 deg)",
        ] {
            let parameters = vec![
                ("r".to_owned(), parse("200 mm/2", &[]).unwrap()),
                ("w".to_owned(), parse("2 rad/s", &[]).unwrap()),
            ];
            let expr = parse(text, &names).unwrap();
            let law = Law::new(text.to_owned(), expr.clone(), parameters.clone());
            let folded = law.folded::<f64>().unwrap();
            assert!(is_folded(&folded.expr), "{text}: {:?}", folded.expr);
            for t in [0.0, 0.3, 7.0] {
                let lookup = |name: &str| match name {
                    TIME => Some(DimensionedValue {
                        number: Jet::variable(t),
                        dim: Dim::TIME,
                        degrees: false,
                    }),
                    _ => evaluate(&parameters.iter().find(|p| p.0 == name)?.1, &|_| None).ok(),
                };
                let (one, other) = (folded.at(t).unwrap(), evaluate(&expr, &lookup).unwrap());
                assert_eq!((one.dim, one.degrees), (other.dim, other.degrees), "{text}");
                for k in 0..3 {
                    assert!(
                        (one.number.0[k] - other.number.0[k]).abs() <= 1e-15,
                        "{text}: {one:?} {other:?}"
                    );
                }
            }
        }
    }

    fn is_folded(e: &Expr) -> bool {
        match &e.kind {
            ExprKind::Parameter(_) | ExprKind::Unit(_) => true,
            ExprKind::Number(_) | ExprKind::Pi => false,
            ExprKind::Neg(u) | ExprKind::Call(_, u) => mentions(u, TIME) && is_folded(u),
            ExprKind::Binary(_, a, b) => {
                (mentions(a, TIME) || mentions(b, TIME)) && is_folded(a) && is_folded(b)
            }
        }
    }
}
