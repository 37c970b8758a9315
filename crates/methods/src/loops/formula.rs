//! Formulas whose symbols carry their values: a printed formula is the computed one.

use libm::{asin, atan, atan2, cos, sin, sqrt};

/// A formula in SI units and radians.
#[derive(Clone, Debug, PartialEq)]
pub enum Formula {
    /// A named quantity: its symbol in the label language, and its value.
    Symbol(String, f64),
    /// A number that is written as it is: its digits, and its value.
    Number(String, f64),
    /// A sum; `true` marks a term that is subtracted.
    Sum(Vec<(bool, Formula)>),
    /// A product.
    Product(Vec<Formula>),
    /// A quotient.
    Quotient(Box<Formula>, Box<Formula>),
    /// A square root.
    Root(Box<Formula>),
    /// A square.
    Square(Box<Formula>),
    /// A function of one argument.
    Call(UnaryFunction, Box<Formula>),
    /// The angle of the vector (x, y): `arctan(y/x)` in the quadrant of the vector.
    Direction {
        /// The component x.
        x: Box<Formula>,
        /// The component y.
        y: Box<Formula>,
    },
}

/// The functions of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnaryFunction {
    /// The cosine.
    Cos,
    /// The sine.
    Sin,
    /// The arcsine, from −90° to 90°.
    Arcsin,
    /// The arctangent, from −90° to 90°.
    Arctan,
}

/// The precedence of a formula in writing.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Atom,
}

impl Formula {
    /// A named quantity.
    pub fn symbol(text: impl Into<String>, value: f64) -> Formula {
        Formula::Symbol(text.into(), value)
    }

    /// A whole number.
    pub fn whole(value: i32) -> Formula {
        Formula::Number(value.to_string(), f64::from(value))
    }

    /// The sum of terms, without those that are zero.
    pub fn sum(terms: impl IntoIterator<Item = (bool, Formula)>) -> Formula {
        let mut out = Vec::new();
        for (minus, term) in terms {
            match term {
                Formula::Number(_, 0.0) => {}
                Formula::Sum(inner) => out.extend(inner.into_iter().map(|(m, t)| (m != minus, t))),
                term => {
                    let (negative, term) = term.unsigned();
                    out.push((minus != negative, term));
                }
            }
        }
        match out.len() {
            0 => Formula::whole(0),
            1 if !out[0].0 => out.swap_remove(0).1,
            _ => Formula::Sum(out),
        }
    }

    /// The product of factors; zero if one of them is zero.
    pub fn product(factors: impl IntoIterator<Item = Formula>) -> Formula {
        let (mut out, mut minus) = (Vec::new(), false);
        for factor in factors {
            let (negative, factor) = factor.unsigned();
            minus ^= negative;
            match factor {
                Formula::Number(_, 0.0) => return Formula::whole(0),
                Formula::Number(_, 1.0) => {}
                Formula::Product(inner) => out.extend(inner),
                factor => out.push(factor),
            }
        }
        let product = match out.len() {
            0 => Formula::whole(1),
            1 => out.swap_remove(0),
            _ => Formula::Product(out),
        };
        if minus { product.negative() } else { product }
    }

    /// The quotient of two formulas.
    pub fn over(self, under: Formula) -> Formula {
        let ((a, over), (b, under)) = (self.unsigned(), under.unsigned());
        let quotient = match (&over, &under) {
            (Formula::Number(_, 0.0), _) | (_, Formula::Number(_, 1.0)) => over,
            _ => Formula::Quotient(Box::new(over), Box::new(under)),
        };
        match quotient {
            quotient if a == b => quotient,
            Formula::Quotient(over, under) if matches!(*over, Formula::Sum(_)) => {
                Formula::Quotient(Box::new(over.negative()), under)
            }
            quotient => quotient.negative(),
        }
    }

    /// The formula with the other sign.
    pub fn negative(self) -> Formula {
        match self {
            Formula::Number(_, 0.0) => self,
            Formula::Sum(terms) => {
                Formula::sum(terms.into_iter().map(|(m, t)| (!m, t)).collect::<Vec<_>>())
            }
            other => Formula::Sum(vec![(true, other)]),
        }
    }

    /// The square.
    pub fn squared(self) -> Formula {
        match self.unsigned().1 {
            zero @ Formula::Number(_, 0.0) => zero,
            other => Formula::Square(Box::new(other)),
        }
    }

    /// The square root.
    pub fn root(self) -> Formula {
        Formula::Root(Box::new(self))
    }

    /// A function of the formula.
    pub fn call(self, function: UnaryFunction) -> Formula {
        Formula::Call(function, Box::new(self))
    }

    /// The product of factors in one order: numbers, symbols, functions; equal ones as a square.
    pub(super) fn ordered(factors: impl IntoIterator<Item = Formula>) -> Formula {
        let (minus, product) = Formula::product(factors).unsigned();
        let Formula::Product(mut factors) = product else {
            return if minus { product.negative() } else { product };
        };
        let rank = |f: &Formula| match f {
            Formula::Number(..) => 0,
            Formula::Symbol(..) => 1,
            Formula::Square(_) => 2,
            Formula::Quotient(..) | Formula::Root(_) => 3,
            Formula::Sum(_) | Formula::Product(_) => 4,
            Formula::Call(..) | Formula::Direction { .. } => 5,
        };
        cancel(&mut factors);
        factors.sort_by_key(|f| (rank(f), f.text()));
        let mut out: Vec<Formula> = Vec::new();
        for f in factors {
            match out.last_mut() {
                Some(last) if *last == f && !matches!(f, Formula::Number(..)) => {
                    *last = Formula::Square(Box::new(f));
                }
                _ => out.push(f),
            }
        }
        let product = if out.len() == 1 { out.swap_remove(0) } else { Formula::Product(out) };
        if minus { product.negative() } else { product }
    }

    /// The sum of terms, with equal ones taken together.
    pub(super) fn collected(terms: impl IntoIterator<Item = (bool, Formula)>) -> Formula {
        let terms = match Formula::sum(terms) {
            Formula::Sum(terms) => terms,
            one => return one,
        };
        let mut counted: Vec<(i32, Formula)> = Vec::new();
        for (minus, term) in terms {
            let one = if minus { -1 } else { 1 };
            match counted.iter_mut().find(|(_, t)| *t == term) {
                Some((count, _)) => *count += one,
                None => counted.push((one, term)),
            }
        }
        Formula::sum(counted.into_iter().filter(|(count, _)| *count != 0).map(|(count, term)| {
            (count < 0, Formula::ordered([Formula::whole(count.abs()), term]))
        }))
    }

    /// The derivative by time; `rate` gives that of a symbol, `None` for a constant.
    pub(super) fn derivative(&self, rate: &impl Fn(&str) -> Option<Formula>) -> Formula {
        match self {
            Formula::Symbol(text, _) => rate(text).unwrap_or_else(|| Formula::whole(0)),
            Formula::Number(..) => Formula::whole(0),
            Formula::Sum(terms) => {
                Formula::collected(terms.iter().map(|(minus, t)| (*minus, t.derivative(rate))))
            }
            Formula::Product(factors) => {
                let with = |k: usize| {
                    let other = |(n, f): (usize, &Formula)| {
                        if n == k { f.derivative(rate) } else { f.clone() }
                    };
                    Formula::ordered(factors.iter().enumerate().map(other))
                };
                Formula::collected((0..factors.len()).map(|k| (false, with(k))))
            }
            Formula::Quotient(a, b) => {
                let (over, under) = (a.derivative(rate), b.derivative(rate));
                let first = over.over((**b).clone());
                let second = Formula::ordered([(**a).clone(), under]).over((**b).clone().squared());
                Formula::collected([(false, first), (true, second)])
            }
            Formula::Root(a) => {
                a.derivative(rate).over(Formula::ordered([Formula::whole(2), self.clone()]))
            }
            Formula::Square(a) => {
                Formula::ordered([Formula::whole(2), (**a).clone(), a.derivative(rate)])
            }
            Formula::Call(function, a) => {
                let one = || Formula::whole(1);
                let own = (**a).clone();
                let inner = a.derivative(rate);
                match function {
                    UnaryFunction::Cos => {
                        Formula::ordered([own.call(UnaryFunction::Sin), inner]).negative()
                    }
                    UnaryFunction::Sin => Formula::ordered([own.call(UnaryFunction::Cos), inner]),
                    UnaryFunction::Arcsin => {
                        inner.over(Formula::sum([(false, one()), (true, own.squared())]).root())
                    }
                    UnaryFunction::Arctan => {
                        inner.over(Formula::sum([(false, one()), (false, own.squared())]))
                    }
                }
            }
            Formula::Direction { x, y } => {
                let cross = Formula::collected([
                    (false, Formula::ordered([(**x).clone(), y.derivative(rate)])),
                    (true, Formula::ordered([(**y).clone(), x.derivative(rate)])),
                ]);
                let squares = [x, y].map(|f| (false, (**f).clone().squared()));
                cross.over(Formula::sum(squares))
            }
        }
    }

    /// Takes a minus sign from the whole formula.
    pub(super) fn unsigned(self) -> (bool, Formula) {
        match self {
            Formula::Sum(mut terms) if terms.len() == 1 => {
                let (minus, term) = terms.swap_remove(0);
                (minus, term)
            }
            other => (false, other),
        }
    }

    /// The value, from the values of the symbols.
    pub fn value(&self) -> f64 {
        match self {
            Formula::Symbol(_, value) | Formula::Number(_, value) => *value,
            Formula::Sum(terms) => {
                terms.iter().map(|(minus, t)| if *minus { -t.value() } else { t.value() }).sum()
            }
            Formula::Product(factors) => factors.iter().map(Formula::value).product(),
            Formula::Quotient(a, b) => a.value() / b.value(),
            // Rounding makes the root of a number that is zero one of a tiny negative number.
            Formula::Root(a) => sqrt(a.value().max(0.0)),
            Formula::Square(a) => a.value() * a.value(),
            Formula::Call(UnaryFunction::Cos, a) => cos(a.value()),
            Formula::Call(UnaryFunction::Sin, a) => sin(a.value()),
            Formula::Call(UnaryFunction::Arcsin, a) => asin(a.value().clamp(-1.0, 1.0)),
            Formula::Call(UnaryFunction::Arctan, a) => atan(a.value()),
            Formula::Direction { x, y } => atan2(y.value(), x.value()),
        }
    }

    /// The formula in the label language.
    pub fn text(&self) -> String {
        match self {
            Formula::Symbol(text, _) | Formula::Number(text, _) => text.clone(),
            Formula::Sum(terms) => {
                let mut out = String::new();
                // A sum begins with a term that is added, if it has one.
                let first = terms.iter().position(|(minus, _)| !minus).unwrap_or_default();
                let others = (0..terms.len()).filter(|k| *k != first);
                let ordered = std::iter::once(first).chain(others).map(|k| &terms[k]);
                for (k, (minus, term)) in ordered.enumerate() {
                    out += match (k, minus) {
                        (0, false) => "",
                        (0, true) => "−",
                        (_, false) => " + ",
                        (_, true) => " − ",
                    };
                    out += &term.within(Binding::Product);
                }
                out
            }
            Formula::Product(factors) => {
                factors.iter().map(|f| f.within(Binding::Atom)).collect::<Vec<_>>().join("\\,")
            }
            Formula::Quotient(a, b) => {
                format!("{}/{}", a.within(Binding::Atom), b.within_quotient())
            }
            Formula::Root(a) => format!("√({})", a.text()),
            Formula::Square(a) => match &**a {
                Formula::Call(f, argument) => {
                    format!("{}^2{}", f.name(), argument.argument())
                }
                Formula::Symbol(..) | Formula::Number(..) => format!("{}^2", a.text()),
                _ => format!("({})^2", a.text()),
            },
            Formula::Call(f, a) => format!("{}{}", f.name(), a.argument()),
            Formula::Direction { x, y } => {
                format!("\\arctan({}/{})", y.within(Binding::Atom), x.within_quotient())
            }
        }
    }

    fn argument(&self) -> String {
        match self {
            Formula::Symbol(text, _) => text.clone(),
            other => format!("({})", other.text()),
        }
    }

    fn binding(&self) -> Binding {
        match self {
            Formula::Sum(_) => Binding::Sum,
            Formula::Product(_) | Formula::Quotient(..) => Binding::Product,
            Formula::Symbol(..)
            | Formula::Number(..)
            | Formula::Root(_)
            | Formula::Square(_)
            | Formula::Call(..)
            | Formula::Direction { .. } => Binding::Atom,
        }
    }

    fn within(&self, least: Binding) -> String {
        if self.binding() < least { format!("({})", self.text()) } else { self.text() }
    }

    fn within_quotient(&self) -> String {
        match self {
            Formula::Symbol(..) | Formula::Number(..) => self.text(),
            other => format!("({})", other.text()),
        }
    }
}

/// Takes a factor and an equal divisor out of a product.
fn cancel(factors: &mut Vec<Formula>) {
    let divided = |f: &Formula| match f {
        Formula::Quotient(a, b) => Some(((**a).clone(), (**b).clone(), false)),
        Formula::Square(of) => match &**of {
            Formula::Quotient(a, b) => Some(((**a).clone(), (**b).clone(), true)),
            _ => None,
        },
        _ => None,
    };
    for k in 0..factors.len() {
        let Some((over, under, squared)) = divided(&factors[k]) else { continue };
        if let Some(other) = factors.iter().position(|f| *f == under) {
            factors[k] = if squared {
                Formula::Quotient(Box::new(over.squared()), Box::new(under))
            } else {
                over
            };
            factors.remove(other);
            return;
        }
    }
}

impl UnaryFunction {
    fn name(self) -> &'static str {
        match self {
            UnaryFunction::Cos => "\\cos",
            UnaryFunction::Sin => "\\sin",
            UnaryFunction::Arcsin => "\\arcsin",
            UnaryFunction::Arctan => "\\arctan",
        }
    }
}
