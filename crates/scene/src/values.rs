//! Quantities of the scene: parameters in order, the `units` table, and conversion of every number
//! to SI units with a check of its dimension.

use std::cell::RefCell;
use std::collections::{BTreeSet, HashMap, HashSet};

use super::eval::{DimensionedValue, NoValue, evaluate};
use super::exact;
use super::expr::{self, Expr};
use super::front::{self, Law};
use super::model::{Angle, GivenQuantity};
use super::parameters;
use super::raw::RawQuantity;
use super::units::{Dim, RequiredQuantity};
use hodograph_base::diag::{Both, Diagnostic, Faults, Span, both};
use hodograph_base::json::Word;
use hodograph_base::json::fields::suggest;
use hodograph_base::number::{Ball, Real};

/// An expression, its value, and its value with an error bound.
type Evaluated = (Expr, DimensionedValue, DimensionedValue<Ball<f64>>);

/// A parameter's value, without and with an error bound.
#[derive(Clone, Copy)]
struct ParameterValue {
    value: DimensionedValue,
    ball: DimensionedValue<Ball<f64>>,
}

/// The full text of a quantity, its value, and its value with an error bound.
type EvaluatedText = (String, DimensionedValue, DimensionedValue<Ball<f64>>);

/// Returns a bound on the distance of a value from the true number in a ball.
fn distance(value: f64, ball: Ball<f64>) -> f64 {
    (ball.approx() - value).abs() + ball.radius()
}

/// Parameters and units of a scene, for reading its quantities.
pub(super) struct Values<'a> {
    source: &'a str,
    /// Names in the order of the file, including parameters with a fault, which have no value.
    names: Vec<&'a str>,
    known: HashMap<&'a str, Option<ParameterValue>>,
    /// Names and texts of the parameters that have a value, each after those in its expression.
    texts: Vec<(&'a str, &'a str)>,
    /// Indices in `texts` of the parameters in the expression of each.
    inputs: Vec<Vec<usize>>,
    /// Index in `texts` of each name.
    places: HashMap<&'a str, usize>,
    units: HashMap<&'static str, String>,
    used: RefCell<HashSet<String>>,
}

impl<'a> Values<'a> {
    /// Reads the `units` table and the parameters, each after those in its expression; returns the
    /// parameters in this order.
    pub fn new(
        source: &'a str,
        units: &[(Word, Word)],
        parameters: &'a [(Word, RawQuantity)],
        faults: &mut Faults,
    ) -> (Self, Vec<(String, GivenQuantity)>) {
        let mut values = Values {
            source,
            names: Vec::new(),
            known: HashMap::new(),
            texts: Vec::new(),
            inputs: Vec::new(),
            places: HashMap::new(),
            units: HashMap::new(),
            used: RefCell::new(HashSet::new()),
        };
        for (key, unit) in units {
            values.unit(key, unit, faults);
        }
        let mut list = Vec::new();
        let (order, circular) = parameters::by_dependence(parameters);
        faults.list.extend(circular);
        for (name, quantity) in order.into_iter().map(|i| &parameters[i]) {
            let evaluated = match values.evaluate(quantity) {
                Ok((expr, value, ball)) => Some((expr, ParameterValue { value, ball })),
                Err(fault) => {
                    faults.list.extend(fault);
                    None
                }
            };
            let value = evaluated.as_ref().map(|(_, value)| *value);
            if !expr::is_name(&name.text) {
                let d = Diagnostic::error("name", both!("`{}` cannot name a parameter", name.text))
                    .at(name.span);
                faults.push(d.help(both!("a name is a letter followed by letters, digits or _")));
            } else if expr::is_reserved(&name.text) {
                let d = Diagnostic::error(
                    "name",
                    both!("`{}` is a unit or a function and cannot name a parameter", name.text),
                )
                .at(name.span);
                faults.push(d.help(both!("call it `{}0`", name.text)));
                // The name counts as declared: its uses are not reported again.
                values.names.push(&name.text);
                values.known.insert(&name.text, None);
            } else {
                values.names.push(&name.text);
                // Of two parameters of one name, a fault of its own, the first counts.
                values.known.entry(&name.text).or_insert(value);
            }
            if let Some((expr, ParameterValue { value, ball })) = evaluated {
                let given = GivenQuantity {
                    value: value.si(),
                    radius: distance(value.si(), ball.si()),
                    text: quantity.text.clone(),
                    span: quantity.span,
                };
                list.push((name.text.clone(), given));
                values.inputs.push(values.places_of(&expr));
                values.places.entry(&name.text).or_insert(values.texts.len());
                values.texts.push((&name.text, &quantity.text));
            }
        }
        (values, list)
    }

    fn unit(&mut self, key: &Word, unit: &Word, faults: &mut Faults) {
        let Some((name, wanted)) = RequiredQuantity::TABLE.iter().find(|(k, _)| *k == key.text)
        else {
            let d = Diagnostic::error(
                "unknown-key",
                both!("`{}` is not a quantity of \"units\"", key.text),
            )
            .at(key.span);
            faults.push(d.help(suggest(
                &key.text,
                RequiredQuantity::TABLE.iter().map(|(k, _)| *k),
                both!("the quantities are"),
            )));
            return;
        };
        let quantity = RawQuantity { text: unit.text.clone(), span: unit.span, bare: false };
        match self.evaluate(&quantity) {
            Ok((_, value, _)) if value.dim == wanted.dim() => {
                self.units.insert(name, unit.text.clone());
            }
            Ok(_) => {
                let d = Diagnostic::error(
                    "unit",
                    both!("`{}` is not a unit of {}", unit.text, wanted.describe()),
                )
                .at(unit.span);
                faults.push(d.help(both!("write \"{}\"", wanted.usual_unit())));
            }
            Err(fault) => faults.list.extend(fault),
        }
    }

    /// Returns warnings about unused parameters; to be called after everything has been read.
    pub fn unused(&self, parameters: &[(Word, RawQuantity)]) -> Vec<Diagnostic> {
        let used = self.used.borrow();
        parameters
            .iter()
            .filter(|(name, _)| !used.contains(&name.text))
            .map(|(name, _)| {
                Diagnostic::warning(
                    "unused-parameter",
                    both!("parameter `{}` is not used", name.text),
                )
                .at(name.span)
            })
            .collect()
    }

    /// Returns the parameters in use.
    pub fn used_names(&self) -> HashSet<String> {
        self.used.borrow().clone()
    }

    /// Returns the dimension of a parameter's value and marks the parameter as used; `None` if it
    /// does not exist or has a fault.
    pub fn dim(&self, name: &str) -> Option<Dim> {
        self.used.borrow_mut().insert(name.to_owned());
        self.known.get(name).copied().flatten().map(|k| k.value.dim)
    }

    /// Returns a function of one variable, over the parameters: the text is read immediately, the
    /// values are computed later.
    pub fn curve(
        &self,
        quantity: &RawQuantity,
        variable: &str,
    ) -> Result<super::front::Curve, Diagnostic> {
        let mut names = self.names.clone();
        names.push(variable);
        let expr = expr::parse(&quantity.text, &names).map_err(|d| self.locate(quantity, d))?;
        let known = |name: &&str| {
            Some(((*name).to_owned(), self.known.get(*name).copied().flatten()?.value))
        };
        let used = |name: &&str| quantity.text.contains(*name);
        self.used
            .borrow_mut()
            .extend(self.names.iter().filter(|n| used(n)).map(|n| (*n).to_owned()));
        let parameters = self.names.iter().filter(|n| **n != variable).filter_map(known).collect();
        Ok(super::front::Curve { expr, variable: variable.to_owned(), angle: None, parameters })
    }

    /// Returns a law of time; its dimension is checked where it is needed. Without the time in it,
    /// a bare number has the unit of the table.
    pub fn law(
        &self,
        quantity: &RawQuantity,
        wanted: RequiredQuantity,
        t: f64,
    ) -> Result<Law, Vec<Diagnostic>> {
        let located = |d: Diagnostic| vec![self.locate(quantity, d)];
        let law = self.unchecked_law(&quantity.text, quantity).map_err(located)?;
        if !law.depends_on_time() {
            let mut faults = Faults::default();
            let Some((text, ..)) = self.value(quantity, wanted, &mut faults) else {
                return Err(faults.list);
            };
            return self.unchecked_law(&text, quantity).map_err(located);
        }
        let value = law.at(t).map_err(located)?;
        if value.dim.serves(wanted.dim()) {
            return Ok(law);
        }
        let text = &quantity.text;
        let message =
            both!("{} is wanted here, `{text}` is {}", wanted.describe(), value.dim.describe());
        let d = Diagnostic::error("dimension", message).help(wanted.missing(value.dim, &law.expr));
        Err(vec![d.at(quantity.span)])
    }

    /// Returns a time of the file, as written.
    pub fn time(&self, quantity: &RawQuantity) -> Result<Law, Vec<Diagnostic>> {
        let located = |d: Diagnostic| vec![self.locate(quantity, d)];
        let law = self.unchecked_law(&quantity.text, quantity).map_err(located)?;
        let value = law.at(0.0).map_err(located)?;
        let zero = value.dim == Dim::NUMBER && value.number.0[0] == 0.0;
        if value.dim == Dim::TIME && !law.depends_on_time() || zero {
            return Ok(law);
        }
        let message =
            both!("a time is wanted here, `{}` is {}", quantity.text, value.dim.describe());
        let d = Diagnostic::error("dimension", message).help(both!("write it in s"));
        Err(vec![d.at(quantity.span)])
    }

    fn unchecked_law(&self, text: &str, quantity: &RawQuantity) -> Result<Law, Diagnostic> {
        let mut names = self.names.clone();
        if !names.contains(&front::TIME) {
            names.push(front::TIME);
        }
        let expr = expr::parse(text, &names)?;
        let used = |name: &&str| quantity.text.contains(*name);
        self.used
            .borrow_mut()
            .extend(self.names.iter().filter(|n| used(n)).map(|n| (*n).to_owned()));
        let known = |(k, (name, text)): (usize, &(&str, &str))| {
            let earlier: Vec<&str> = self.texts[..k].iter().map(|(n, _)| *n).collect();
            Some(((*name).to_owned(), expr::parse(text, &earlier).ok()?))
        };
        let parameters = self
            .texts
            .iter()
            .enumerate()
            .filter(|(_, (n, _))| *n != front::TIME)
            .filter_map(known)
            .collect();
        Ok(Law::new(text.to_owned(), expr, parameters))
    }

    /// Returns true if a parameter has this name.
    pub fn has_name(&self, name: &str) -> bool {
        self.names.contains(&name)
    }

    /// Returns true if the `units` table has a unit for bare numbers of a kind.
    pub fn has_unit(&self, wanted: RequiredQuantity) -> bool {
        wanted.key().is_some_and(|k| self.units.contains_key(k))
    }

    /// Returns the unit in the `units` table for bare numbers of a kind, as written.
    pub fn unit_of(&self, wanted: RequiredQuantity) -> Option<&str> {
        self.units.get(wanted.key()?).map(String::as_str)
    }

    /// Returns a quantity in SI units.
    pub fn si(
        &self,
        quantity: &RawQuantity,
        wanted: RequiredQuantity,
        faults: &mut Faults,
    ) -> Option<GivenQuantity> {
        let (text, value, ball) = self.value(quantity, wanted, faults)?;
        Some(GivenQuantity {
            value: value.si(),
            radius: distance(value.si(), ball.si()),
            text,
            span: quantity.span,
        })
    }

    /// Returns a length that must be greater than zero.
    pub fn positive_length(
        &self,
        quantity: &RawQuantity,
        what: Both,
        faults: &mut Faults,
    ) -> Option<GivenQuantity> {
        let given = self.si(quantity, RequiredQuantity::Length, faults)?;
        if given.value > 0.0 {
            return Some(given);
        }
        let d = Diagnostic::error(
            "not-positive",
            both!("{} is {}; it must be greater than zero", what, given.text),
        );
        faults.push(d.at(quantity.span));
        None
    }

    /// Returns a number without a dimension.
    pub fn pure_number(&self, quantity: &RawQuantity, faults: &mut Faults) -> Option<f64> {
        let fault = match self.evaluate(quantity) {
            Ok((_, value, _)) if value.dim == Dim::NUMBER => return Some(value.number),
            Ok((_, value, _)) => {
                let text = &quantity.text;
                let message =
                    both!("a number is wanted here, `{text}` is {}", value.dim.describe());
                Some(
                    Diagnostic::error("dimension", message)
                        .at(quantity.span)
                        .help(both!("write it without a unit")),
                )
            }
            Err(fault) => fault,
        };
        faults.list.extend(fault);
        None
    }

    /// Returns a number without a dimension, or an angle: its number as written, and for an angle
    /// true if it is in degrees.
    pub fn number_or_angle(
        &self,
        quantity: &RawQuantity,
        faults: &mut Faults,
    ) -> Option<(f64, Option<bool>)> {
        match self.evaluate(quantity) {
            Ok((_, value, _)) if value.dim == Dim::ANGLE => {
                Some((value.number, Some(value.degrees)))
            }
            Ok(_) | Err(_) => Some((self.pure_number(quantity, faults)?, None)),
        }
    }

    /// Returns an angle, in degrees if it is written in degrees.
    pub fn angle(
        &self,
        quantity: &RawQuantity,
        faults: &mut Faults,
    ) -> Option<GivenQuantity<Angle>> {
        let mut angle = self.angle_in_full(quantity, faults)?;
        let degrees = matches!(angle.value, Angle::Deg(_));
        // `f64` no longer resolves the place within the turn of an angle of so many turns: whole
        // turns are subtracted from the written expression.
        if !exact::is_resolved(angle.value, angle.radius)
            && let Some((number, radius)) =
                exact::less_turns(&self.texts_in(&angle.text), &angle.text, degrees)
        {
            (angle.value, angle.radius) =
                (if degrees { Angle::Deg(number) } else { Angle::Rad(number) }, radius);
        }
        Some(angle)
    }

    /// Returns an angle with all its turns.
    pub fn angle_in_full(
        &self,
        quantity: &RawQuantity,
        faults: &mut Faults,
    ) -> Option<GivenQuantity<Angle>> {
        let (text, value, ball) = self.value(quantity, RequiredQuantity::Angle, faults)?;
        // In the unit of the value: an angle that is only known to be close to a whole number of
        // degrees is in radians.
        let degrees = if ball.degrees {
            ball.number
        } else {
            ball.number * Ball::from_f64(180.0) / Ball::pi()
        };
        let number = if value.degrees { degrees } else { ball.si() };
        let radius = distance(value.number, number);
        Some(GivenQuantity { value: value.angle(), radius, text, span: quantity.span })
    }

    /// Returns the text of an angle minus the whole turns that were subtracted from its value, so
    /// that formulas with the text agree with computations with the value.
    pub fn text_of(&self, angle: &GivenQuantity<Angle>) -> String {
        let (texts, degrees) = (self.texts_in(&angle.text), angle.value.degrees());
        let turns = exact::turns_taken(&texts, &angle.text, degrees);
        // With a precision, all digits of a large number are printed, not only the shortest
        // representation.
        turns.into_iter().fold(angle.text.clone(), |text, n| format!("({text})-({n:.0}*360 deg)"))
    }

    /// Returns two coordinates in metres.
    pub fn two_lengths(
        &self,
        xy: &[RawQuantity; 2],
        faults: &mut Faults,
    ) -> Option<[GivenQuantity; 2]> {
        let x = self.si(&xy[0], RequiredQuantity::Length, faults);
        let y = self.si(&xy[1], RequiredQuantity::Length, faults);
        Some([x?, y?])
    }

    /// Returns the value with checked dimension, and its full text (a bare number gets the unit of
    /// the table).
    fn value(
        &self,
        quantity: &RawQuantity,
        wanted: RequiredQuantity,
        faults: &mut Faults,
    ) -> Option<EvaluatedText> {
        let result = self.evaluate(quantity).and_then(|(expr, value, ball)| {
            self.fit(quantity, &expr, (value, ball), wanted).map_err(Some)
        });
        match result {
            Ok(found) => Some(found),
            Err(fault) => {
                faults.list.extend(fault);
                None
            }
        }
    }

    fn fit(
        &self,
        quantity: &RawQuantity,
        expr: &Expr,
        (value, ball): (DimensionedValue, DimensionedValue<Ball<f64>>),
        wanted: RequiredQuantity,
    ) -> Result<EvaluatedText, Diagnostic> {
        let text = &quantity.text;
        // A scale such as m/mm has no dimension, yet a bare number in its place has no defined
        // unit.
        let is_number =
            if wanted.key().is_none() { expr::is_bare(expr) } else { value.dim == Dim::NUMBER };
        if !is_number {
            if value.dim.serves(wanted.dim()) {
                return Ok((text.clone(), value, ball));
            }
            let message =
                both!("{} is wanted here, `{text}` is {}", wanted.describe(), value.dim.describe());
            let d = Diagnostic::error("dimension", message).at(quantity.span);
            return Err(match expr::unit_in_divisor(text, expr) {
                Some(meant) => d.help(both!(
                    "a unit binds to the number before it and not to the quotient: write \"{meant}\""
                )),
                None => d.help(wanted.missing(value.dim, expr)),
            });
        }
        if value.number == 0.0 {
            let zero = DimensionedValue {
                number: 0.0,
                dim: wanted.dim(),
                degrees: wanted == RequiredQuantity::Angle,
            };
            // An expression may be zero by rounding only.
            return Ok((text.clone(), zero, DimensionedValue { degrees: zero.degrees, ..ball }));
        }
        let simple =
            text.strip_prefix('-').unwrap_or(text).bytes().all(|b| b.is_ascii_digit() || b == b'.');
        let with_unit = |unit: &str| match (simple, unit.bytes().all(|b| b.is_ascii_alphabetic())) {
            (true, true) => format!("{text} {unit}"),
            (true, false) => format!("{text} ({unit})"),
            (false, _) => format!("({text}) ({unit})"),
        };
        let Some(unit) = wanted.key().and_then(|k| self.units.get(k)) else {
            let d = Diagnostic::error(
                "no-unit",
                both!("{} is wanted here, `{text}` has no unit", wanted.describe()),
            )
            .at(quantity.span);
            let usual = wanted.usual_unit();
            let proposal =
                if simple { format!("{text} {usual}") } else { format!("({text}) * 1 {usual}") };
            return Err(match wanted.key() {
                Some(key) => d.help(both!(
                    "write \"{proposal}\", or give \"units\": {{\"{key}\": \"{usual}\"}} for all bare numbers"
                )),
                None => d.help(both!("write \"{proposal}\"")),
            });
        };
        let text = with_unit(unit);
        let full = RawQuantity { text: text.clone(), span: quantity.span, bare: true };
        match self.evaluate(&full) {
            Ok((_, value, ball)) => Ok((text, value, ball)),
            // Number and unit have been read separately; together they can only be too large.
            Err(fault) => Err(fault.unwrap_or_else(|| {
                Diagnostic::error("expression", both!("`{text}` has no value")).at(quantity.span)
            })),
        }
    }

    /// Parses and evaluates, with an error bound; in higher precision if `f64` loses digits of the
    /// written expression. The fault is `None` if it is that of a parameter, which has been
    /// reported there.
    fn evaluate(&self, quantity: &RawQuantity) -> Result<Evaluated, Option<Diagnostic>> {
        let expr =
            expr::parse(&quantity.text, &self.names).map_err(|d| Some(self.locate(quantity, d)))?;
        let lookup = |name: &str| {
            self.used.borrow_mut().insert(name.to_owned());
            self.known.get(name).copied().flatten().map(|k| k.value)
        };
        match evaluate(&expr, &lookup) {
            Ok(value) => {
                let ball = self.ball(&expr, value);
                let texts = || self.texts_of(&expr);
                let (value, ball) = exact::settled(texts, &quantity.text, value, ball);
                Ok((expr, value, ball))
            }
            Err(NoValue::Reported) => Err(None),
            Err(NoValue::Fault(d)) => Err(Some(self.locate(quantity, d))),
        }
    }

    /// Returns the indices in `texts` of the parameters in an expression.
    fn places_of(&self, expr: &Expr) -> Vec<usize> {
        expr.parameters().into_iter().filter_map(|name| self.places.get(name).copied()).collect()
    }

    /// Returns names and texts of the parameters that an expression depends on, directly or through
    /// others, each after those in its own expression: reading them again takes no longer with
    /// other parameters in the file.
    fn texts_of(&self, expr: &Expr) -> Vec<(&'a str, &'a str)> {
        let (mut needed, mut open) = (BTreeSet::new(), self.places_of(expr));
        while let Some(place) = open.pop() {
            if needed.insert(place) {
                open.extend(&self.inputs[place]);
            }
        }
        needed.into_iter().map(|place| self.texts[place]).collect()
    }

    /// Returns names and texts of the parameters that a text depends on.
    fn texts_in(&self, text: &str) -> Vec<(&'a str, &'a str)> {
        expr::parse(text, &self.names).map_or_else(|_| Vec::new(), |expr| self.texts_of(&expr))
    }

    /// Returns the value with an error bound; the bound is infinite if an operation may leave its
    /// domain by rounding.
    fn ball(&self, expr: &Expr, value: DimensionedValue) -> DimensionedValue<Ball<f64>> {
        let lookup = |name: &str| self.known.get(name).copied().flatten().map(|k| k.ball);
        let unknown = DimensionedValue {
            number: Ball::new(value.number, f64::INFINITY),
            dim: value.dim,
            degrees: value.degrees,
        };
        evaluate(expr, &lookup).unwrap_or(unknown)
    }

    /// Converts a place in the expression to a place in the file.
    fn locate(&self, quantity: &RawQuantity, d: Diagnostic) -> Diagnostic {
        let Span { start, end } = quantity.span;
        // For a string with escapes, places in the text do not correspond to places in the file;
        // then the whole value is the place.
        let in_step = !quantity.bare
            && self.source.get(start + 1..end.saturating_sub(1)) == Some(quantity.text.as_str());
        match d.span {
            Some(inner) if in_step => {
                d.at(Span::new(start + 1 + inner.start, start + 1 + inner.end))
            }
            _ => d.at(quantity.span),
        }
    }
}
