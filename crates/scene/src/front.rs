//! Data that other files share with scenes: title, units, parameters, units of answers, paper and
//! language, and the reading of quantities.
//!
//! This module has no rules of its own. A synthesis file is not a scene, yet `"2*r"` means the same
//! in both, a bare number has the unit of the same table, and faults have the same places and
//! wording.

use super::book::Book;
use super::decode;
use super::eval::{DimensionedValue, NoValue, evaluate};
use super::expr::{Expr, ExprKind};
use super::folded::Folded;
use super::model::{Lang, Paper};
use super::raw::{RawQuantity, RawScene};
use super::resolve;
use super::units::{Dim, RequiredQuantity};
use super::values::Values;
use hodograph_base::diag::{Both, Diagnostic, Faults, Span, both};
use hodograph_base::json::Node;
use hodograph_base::json::fields::FaultSubject;
use hodograph_base::number::{Jet, Real};

/// The keys of a front.
pub const KEYS: [&str; 7] =
    ["title", "parameters", "units", "answers", "paper", "language", "notation"];

/// The front of a file as written.
pub struct RawFront(RawScene);

impl RawFront {
    /// Decodes the keys of the front from an object; other readers decode its other keys.
    pub fn decode(root: &Node, faults: &mut Faults) -> RawFront {
        RawFront(decode::front(root, faults))
    }
}

/// The front of a file, for reading its quantities.
pub struct Front<'a> {
    raw: &'a RawScene,
    values: Values<'a>,
    /// The file's title, if it has one.
    pub title: Option<Both>,
    /// Its language, if it names one.
    pub language: Option<Lang>,
    /// Paper and scales.
    pub paper: Paper,
    /// The units of printed quantities.
    pub book: Book,
}

impl<'a> Front<'a> {
    /// Reads units and parameters, in order.
    pub fn new(raw: &'a RawFront, source: &'a str, faults: &mut Faults) -> Front<'a> {
        let raw = &raw.0;
        let (values, _) = Values::new(source, &raw.units, &raw.parameters, faults);
        let resolve::SceneHeader { title, language, paper, book } =
            resolve::front(raw, &values, faults);
        Front { raw, values, title, language, paper, book }
    }

    /// Returns a quantity in SI units.
    pub fn si(
        &self,
        node: &Node,
        wanted: RequiredQuantity,
        what: impl Into<FaultSubject>,
        faults: &mut Faults,
    ) -> Option<f64> {
        let quantity = decode::quantity(node, what, faults)?;
        Some(self.values.si(&quantity, wanted, faults)?.value)
    }

    /// Returns an angle in radians, rounded once from the written form.
    pub fn angle(
        &self,
        node: &Node,
        what: impl Into<FaultSubject>,
        faults: &mut Faults,
    ) -> Option<f64> {
        let quantity = decode::quantity(node, what, faults)?;
        Some(self.values.angle(&quantity, faults)?.value.radians())
    }

    /// Returns a number without a dimension.
    pub fn number(
        &self,
        node: &Node,
        what: impl Into<FaultSubject>,
        faults: &mut Faults,
    ) -> Option<f64> {
        let quantity: RawQuantity = decode::quantity(node, what, faults)?;
        self.values.pure_number(&quantity, faults)
    }

    /// Returns a number without a dimension, or an angle: its number as written, and for an angle
    /// true if it is in degrees.
    pub fn number_or_angle(
        &self,
        node: &Node,
        what: impl Into<FaultSubject>,
        faults: &mut Faults,
    ) -> Option<(f64, Option<bool>)> {
        let quantity: RawQuantity = decode::quantity(node, what, faults)?;
        self.values.number_or_angle(&quantity, faults)
    }

    /// Returns a function of a variable, such as `ln(x)`.
    pub fn curve(
        &self,
        node: &Node,
        variable: &str,
        what: impl Into<FaultSubject>,
        faults: &mut Faults,
    ) -> Option<Curve> {
        let quantity = decode::quantity(node, what, faults)?;
        self.values.curve(&quantity, variable).map_err(|d| faults.push(d)).ok()
    }

    /// Returns a law of time: an expression in `t` and the parameters, whose value at the instant
    /// `t` (s) is of the wanted kind.
    pub fn law(
        &self,
        node: &Node,
        wanted: RequiredQuantity,
        t: f64,
        what: impl Into<FaultSubject>,
        faults: &mut Faults,
    ) -> Option<Law> {
        let quantity = decode::quantity(node, what, faults)?;
        self.values
            .law(&quantity, wanted, t)
            .map_err(|d| d.into_iter().for_each(|d| faults.push(d)))
            .ok()
    }

    /// Returns a time: a law that does not depend on itself.
    pub fn time(
        &self,
        node: &Node,
        what: impl Into<FaultSubject>,
        faults: &mut Faults,
    ) -> Option<Law> {
        let quantity = decode::quantity(node, what, faults)?;
        self.values.time(&quantity).map_err(|d| d.into_iter().for_each(|d| faults.push(d))).ok()
    }

    /// Returns a text, or one in each language.
    pub fn localized(&self, node: &Node, what: &'static str, faults: &mut Faults) -> Option<Both> {
        resolve::localized(&decode::localized(node, what, decode::MAX_STATEMENT, faults))
    }

    /// Returns a problem statement with the values of the parameters inserted as written: `{r}` is
    /// the value of `r`.
    pub fn statement(&self, node: &Node, faults: &mut Faults) -> Option<Both> {
        let text = self.localized(node, "\"statement\"", faults)?;
        let shown = |value: &str| match value.strip_suffix(" deg") {
            Some(degrees) => format!("{degrees}°"),
            None => value.to_owned(),
        };
        let fill = |s: &str| {
            self.parameters().iter().fold(s.to_owned(), |s, (name, value)| {
                s.replace(&format!("{{{name}}}"), &shown(value))
            })
        };
        Some(Both { en: fill(&text.en), zh: fill(&text.zh) })
    }

    /// Returns the notation profile that the file names.
    pub fn notation(&self) -> Option<String> {
        self.raw.notation.as_ref().map(|name| name.text.clone())
    }

    /// Returns the parameters as written: name and value.
    pub fn parameters(&self) -> Vec<(String, String)> {
        self.raw.parameters.iter().map(|(name, q)| (name.text.clone(), q.text.clone())).collect()
    }

    /// Returns the units of answers as written: quantity and unit.
    pub fn answers(&self) -> Vec<(String, String)> {
        self.raw.answers.iter().map(|(key, unit)| (key.text.clone(), unit.text.clone())).collect()
    }

    /// Returns warnings about unused parameters; to be called after everything has been read.
    pub fn unused(&self) -> Vec<Diagnostic> {
        self.values.unused(&self.raw.parameters)
    }
}

/// A function of one variable: a pure number that depends on a pure number or on an angle.
#[derive(Clone, Debug)]
pub struct Curve {
    pub(super) expr: Expr,
    pub(super) variable: String,
    /// `None` if the variable is a pure number; for an angle, true if it is in degrees.
    pub(super) angle: Option<bool>,
    pub(super) parameters: Vec<(String, DimensionedValue)>,
}

impl Curve {
    /// Returns the same function of an angle, in degrees or in radians.
    #[must_use]
    pub fn of_angle(self, degrees: bool) -> Curve {
        Curve { angle: Some(degrees), ..self }
    }

    /// Returns its value.
    ///
    /// # Errors
    /// An argument without a value, or a value that is not a pure number.
    pub fn at(&self, x: f64) -> Result<f64, Diagnostic> {
        let dim = if self.angle.is_some() { Dim::ANGLE } else { Dim::NUMBER };
        let variable = DimensionedValue { number: x, dim, degrees: self.angle.unwrap_or(false) };
        let lookup = |name: &str| match name == self.variable {
            true => Some(variable),
            false => self.parameters.iter().find(|(n, _)| n == name).map(|(_, v)| *v),
        };
        match evaluate(&self.expr, &lookup) {
            Ok(value) if value.dim == Dim::NUMBER => Ok(value.number),
            Ok(value) => {
                let message =
                    both!("a function of numbers is wanted, this is {}", value.dim.describe());
                Err(Diagnostic::error("dimension", message))
            }
            Err(NoValue::Fault(d)) => Err(Diagnostic { span: None, ..d }),
            Err(NoValue::Reported) => {
                Err(Diagnostic::error("expression", both!("the function has no value")))
            }
        }
    }
}

/// The name of the time in laws.
pub const TIME: &str = "t";

/// A law of time over the parameters of its file, as written, with a value in any number type.
#[derive(Clone, Debug)]
pub struct Law {
    /// Text as written.
    pub text: String,
    pub(super) expr: Expr,
    /// Names and expressions of its parameters, in the order of the file: later ones use earlier
    /// ones.
    pub(super) parameters: Vec<(String, Expr)>,
}

impl Law {
    /// Returns a law with the parameters of the file that the expression uses, directly or through
    /// others.
    pub(super) fn new(text: String, expr: Expr, mut parameters: Vec<(String, Expr)>) -> Law {
        for k in (0..parameters.len()).rev() {
            let name = &parameters[k].0;
            if !mentions(&expr, name)
                && !parameters[k + 1..].iter().any(|(_, later)| mentions(later, name))
            {
                parameters.remove(k);
            }
        }
        Law { text, expr, parameters }
    }

    fn constant(text: &str, expr: Expr) -> Law {
        Law { text: text.to_owned(), expr, parameters: Vec::new() }
    }

    /// Returns the law zero.
    pub fn zero() -> Law {
        Law::constant("0", Expr { kind: ExprKind::Number("0".to_owned()), span: Span::new(0, 1) })
    }

    /// Returns a constant law (SI).
    pub fn number(value: f64) -> Law {
        // Rust writes the shortest digits that read back as the number, without an exponent.
        let expr = |kind| Expr { kind, span: Span::new(0, 1) };
        let size = expr(ExprKind::Number(format!("{}", value.abs())));
        let whole = if value < 0.0 { expr(ExprKind::Neg(Box::new(size))) } else { size };
        Law::constant(&format!("{value}"), whole)
    }

    /// Returns value, rate and second derivative (SI) at a time (s); an angle keeps its degrees.
    /// For many evaluations use [`Law::folded`] once.
    ///
    /// # Errors
    /// A time at which the law has no value or no derivative.
    pub fn at<N: Real>(&self, t: N) -> Result<DimensionedValue<Jet<N>>, Diagnostic> {
        self.folded()?.at(t)
    }

    /// Returns the law in one number type, with all parts that do not contain the time evaluated.
    ///
    /// # Errors
    /// A part without the time that has no value.
    pub fn folded<N: Real>(&self) -> Result<Folded<N>, Diagnostic> {
        Folded::new(self)
    }

    /// Returns true if the law contains the time.
    pub fn depends_on_time(&self) -> bool {
        mentions(&self.expr, TIME)
    }
}

/// Returns true if an expression contains a parameter, or the time.
pub(super) fn mentions(e: &Expr, wanted: &str) -> bool {
    match &e.kind {
        ExprKind::Number(_) | ExprKind::Pi | ExprKind::Unit(_) => false,
        ExprKind::Parameter(name) => name == wanted,
        ExprKind::Neg(u) | ExprKind::Call(_, u) => mentions(u, wanted),
        ExprKind::Binary(_, a, b) => mentions(a, wanted) || mentions(b, wanted),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::parse;

    #[test]
    fn a_law_keeps_the_parameters_that_it_uses() {
        let names = ["a", "b", "c", "d"];
        let parameters = ["1 m", "2*a", "3 m", "4*c"]
            .iter()
            .zip(names)
            .map(|(text, name)| (name.to_owned(), parse(text, &names).unwrap()));
        let law = Law::new(
            "b*t/(1 s)".to_owned(),
            parse("b*t/(1 s)", &["b", TIME]).unwrap(),
            parameters.collect(),
        );
        assert_eq!(
            law.parameters.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(),
            ["a", "b"]
        );
        assert_eq!(law.at(3.0).unwrap().number.0[0], 6.0);
    }
}
