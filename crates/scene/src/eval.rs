//! The value of an expression in any number type, with its dimension; angles remain in degrees as
//! long as possible.
//!
//! Decisions (domains, whole exponents, sizes) use the nearest `f64`.

use super::expr::{Expr, ExprKind, Function, Operator};
use super::model::Angle;
use super::units::{Dim, Unit};
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::number::Real;
use hodograph_base::trig;

/// Limit of values: larger ones, and nonzero ones below its reciprocal, are refused. Squares and
/// products of three values of this size are still finite in `f64`; mechanisms from a nanometre to
/// a light year are far inside.
const HUGE: f64 = 1e90;

/// A number with its dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DimensionedValue<N = f64> {
    /// In SI units (metres, seconds, radians); if `degrees` is true, one angle in it is in degrees.
    pub number: N,
    /// Its dimension.
    pub dim: Dim,
    /// True if one angle in the dimension is in degrees: `60 deg` stays 60, `300 rpm` is 1800 per
    /// second.
    pub degrees: bool,
}

impl<N: Real> DimensionedValue<N> {
    fn number(number: N) -> Self {
        DimensionedValue { number, dim: Dim::NUMBER, degrees: false }
    }

    /// Returns the SI value (radians).
    pub fn si(self) -> N {
        if self.degrees { self.number * N::pi() / N::from_f64(180.0) } else { self.number }
    }

    /// Returns the value in SI units throughout.
    fn plain(self) -> Self {
        DimensionedValue { number: self.si(), degrees: false, ..self }
    }

    /// Returns (sin, cos); meaningful if `dim` is that of an angle.
    pub fn sin_cos(self) -> (N, N) {
        if self.degrees { self.number.sin_cos_degrees() } else { self.number.sin_cos() }
    }

    /// An angle in degrees.
    fn deg(number: N) -> Self {
        DimensionedValue { number, dim: Dim::ANGLE, degrees: true }
    }
}

impl DimensionedValue {
    /// Returns the value as an angle; meaningful if `dim` is that of an angle.
    pub fn angle(self) -> Angle {
        if self.degrees { Angle::Deg(self.number) } else { Angle::Rad(self.number) }
    }
}

/// The reason why an expression has no value.
#[derive(Clone, Debug, PartialEq)]
pub enum NoValue {
    /// A fault; its span counts from the beginning of the expression.
    Fault(Diagnostic),
    /// A parameter whose own fault has been reported.
    Reported,
}

/// Evaluates an expression; `lookup` returns the value of a parameter, or `None` if its own fault
/// has been reported.
///
/// # Errors
/// Dimensions that do not fit, functions outside their domain, values that are not finite or are
/// out of range.
pub fn evaluate<N: Real>(
    expr: &Expr,
    lookup: &dyn Fn(&str) -> Option<DimensionedValue<N>>,
) -> Result<DimensionedValue<N>, NoValue> {
    let of = |e: &Expr| evaluate(e, lookup);
    let fault =
        |message: Both| NoValue::Fault(Diagnostic::error("expression", message).at(expr.span));
    let value = match &expr.kind {
        ExprKind::Number(text) => DimensionedValue::number(literal(text).map_err(fault)?),
        ExprKind::Pi => DimensionedValue::number(N::pi()),
        ExprKind::Unit(unit) => in_unit(DimensionedValue::number(N::from_f64(1.0)), unit),
        ExprKind::Parameter(name) => lookup(name).ok_or(NoValue::Reported)?,
        ExprKind::Neg(a) => {
            let a = of(a)?;
            DimensionedValue { number: -a.number, ..a }
        }
        // A number with its unit is rounded once: 250 mm is 250/1000, not 250 * 0.001.
        ExprKind::Binary(Operator::Mul, a, b) if matches!(b.kind, ExprKind::Unit(_)) => {
            match &b.kind {
                ExprKind::Unit(unit) => in_unit(of(a)?, unit),
                _ => multiply(of(a)?, of(b)?, 1),
            }
        }
        ExprKind::Binary(op, a, b) => {
            let (a, b) = (of(a)?, of(b)?);
            match op {
                Operator::Add => add(a, b, false).map_err(fault)?,
                Operator::Sub => add(a, b, true).map_err(fault)?,
                Operator::Mul => multiply(a, b, 1),
                Operator::Div if b.number.approx() == 0.0 => {
                    return Err(fault(both!("division by zero")));
                }
                Operator::Div => multiply(a, b, -1),
                Operator::Pow => power(a, b).map_err(fault)?,
            }
        }
        ExprKind::Call(f, a) => call(*f, of(a)?).map_err(fault)?,
    };
    let size = value.number.approx().abs();
    // Quantities of kinematics have far smaller exponents than 20, and the arithmetic of exponents
    // remains small.
    if value.dim.exponents().iter().any(|k| k.abs() > 20) {
        return Err(fault(both!("the powers of the units are beyond all measure")));
    }
    if !size.is_finite() || size > HUGE || (size != 0.0 && size < 1.0 / HUGE) {
        return Err(fault(both!(
            "the value {:e} is beyond all measure (1e-90 to 1e90)",
            value.number.approx()
        )));
    }
    Ok(value)
}

fn literal<N: Real>(text: &str) -> Result<N, Both> {
    let number: f64 = text.parse().map_err(|e| both!("`{text}` is not a number: {e}"))?;
    let mantissa = text.split(['e', 'E']).next().unwrap_or_default();
    if number == 0.0 && mantissa.bytes().any(|b| (b'1'..=b'9').contains(&b)) {
        return Err(both!("`{text}` is too small for a number"));
    }
    // Values that are too large are refused later, so their decimals need no conversion.
    Ok(if number == 0.0 || number.abs() > HUGE {
        N::from_f64(number)
    } else {
        N::from_decimal(text)
    })
}

fn in_unit<N: Real>(a: DimensionedValue<N>, unit: &Unit) -> DimensionedValue<N> {
    // Only one factor can be kept in degrees.
    let a = if unit.degrees { a.plain() } else { a };
    let (up, down) = (N::from_f64(unit.numerator), N::from_f64(unit.denominator));
    // A factor of one is omitted: it would only add to the error bound.
    let number = if unit.numerator == 1.0 { a.number } else { a.number * up };
    let number = if unit.denominator == 1.0 { number } else { number / down };
    DimensionedValue { number, dim: a.dim.times(unit.dim, 1), degrees: a.degrees || unit.degrees }
}

fn multiply<N: Real>(
    a: DimensionedValue<N>,
    b: DimensionedValue<N>,
    k: i32,
) -> DimensionedValue<N> {
    let dim = a.dim.times(b.dim, k);
    let (a, b, degrees) = match (a.degrees, b.degrees) {
        // The degrees of a ratio cancel exactly.
        (true, true) if k < 0 => (a.number, b.number, false),
        (true, true) => (a.si(), b.number, true),
        (false, true) if k < 0 => (a.number, b.si(), false),
        _ => (a.number, b.number, a.degrees || b.degrees),
    };
    DimensionedValue { number: if k < 0 { a / b } else { a * b }, dim, degrees }
}

fn add<N: Real>(
    a: DimensionedValue<N>,
    b: DimensionedValue<N>,
    minus: bool,
) -> Result<DimensionedValue<N>, Both> {
    if a.dim != b.dim && !(a.dim.serves(b.dim) || b.dim.serves(a.dim)) {
        let (first, second) = if minus { (b.dim, a.dim) } else { (a.dim, b.dim) };
        let [first, second] = [first.describe(), second.describe()];
        return Err(match minus {
            true => both!("{} cannot be subtracted from {}", first, second),
            false => both!("{} cannot be added to {}", first, second),
        });
    }
    // A length in metres and an arc in metres times radians, v/r and ω: in these sums radians are
    // pure numbers.
    let plain = |d: Dim| if d.length == 0 && d.time != 0 { d.angle == 1 } else { d.angle == 0 };
    let dim = if plain(a.dim) { a.dim } else { b.dim };
    let (a, b) =
        if a.degrees == b.degrees && a.dim == b.dim { (a, b) } else { (a.plain(), b.plain()) };
    let number = if minus { a.number - b.number } else { a.number + b.number };
    Ok(DimensionedValue { number, dim, degrees: a.degrees })
}

fn power<N: Real>(
    a: DimensionedValue<N>,
    b: DimensionedValue<N>,
) -> Result<DimensionedValue<N>, Both> {
    if b.dim != Dim::NUMBER {
        return Err(both!("an exponent is a pure number, this is {}", b.dim.describe()));
    }
    let exponent = b.number.approx();
    let whole = libm::rint(exponent);
    if a.dim == Dim::NUMBER {
        if a.number.approx() < 0.0 && whole != exponent {
            return Err(both!("a negative number has no broken power"));
        }
        return Ok(DimensionedValue::number(a.number.pow(b.number)));
    }
    if whole != exponent || whole.abs() > 6.0 {
        return Err(both!("the exponent of a quantity with a unit is a whole number from -6 to 6"));
    }
    let k = whole as i32;
    if k == 1 {
        return Ok(a);
    }
    let a = a.plain();
    Ok(DimensionedValue {
        number: a.number.pow(N::from_f64(whole)),
        dim: Dim::NUMBER.times(a.dim, k),
        degrees: false,
    })
}

fn call<N: Real>(f: Function, a: DimensionedValue<N>) -> Result<DimensionedValue<N>, Both> {
    let wants = |dim: Dim, name: &str| match a.dim == dim {
        true => Ok(()),
        false if dim == Dim::ANGLE && a.dim == Dim::NUMBER && a.number.approx() == 0.0 => Ok(()),
        false if dim == Dim::ANGLE && a.dim == Dim::NUMBER => Err(both!(
            "{name} wants an angle, this is a pure number: write `deg` or `rad` after it"
        )),
        false => Err(both!("{name} wants {}, this is {}", dim.describe(), a.dim.describe())),
    };
    let inverse = |name: &str, known: fn(f64) -> Angle, g: &dyn Fn(N) -> DimensionedValue<N>| {
        wants(Dim::NUMBER, name)?;
        let x = a.number.approx();
        match known(x) {
            Angle::Rad(r) if r.is_nan() => Err(both!("{name} has no value at {x}")),
            // The angle in degrees is exact only if the number equals its `f64`.
            Angle::Deg(d) if a.number == N::from_f64(x) => {
                Ok(DimensionedValue::deg(N::from_f64(d)))
            }
            _ => Ok(g(a.number)),
        }
    };
    let rad = |number: N| DimensionedValue { number, dim: Dim::ANGLE, degrees: false };
    // The other leg of a right triangle with hypotenuse one.
    let leg = |x: N| ((N::from_f64(1.0) - x) * (N::from_f64(1.0) + x)).sqrt_or_zero();
    Ok(match f {
        Function::Abs => DimensionedValue { number: a.number.magnitude(), ..a },
        Function::Sqrt => {
            if a.number.approx() < 0.0 {
                return Err(both!("sqrt of the negative value {}", a.number.approx()));
            }
            let d = a.dim;
            if d.exponents().iter().any(|k| k % 2 != 0) {
                return Err(both!("sqrt of {}: its unit is no square", d.describe()));
            }
            let dim = Dim {
                length: d.length / 2,
                time: d.time / 2,
                angle: d.angle / 2,
                mass: d.mass / 2,
            };
            DimensionedValue { number: a.si().sqrt(), dim, degrees: false }
        }
        Function::Sin => {
            wants(Dim::ANGLE, "sin")?;
            DimensionedValue::number(a.sin_cos().0)
        }
        Function::Cos => {
            wants(Dim::ANGLE, "cos")?;
            DimensionedValue::number(a.sin_cos().1)
        }
        Function::Tan => {
            wants(Dim::ANGLE, "tan")?;
            let (s, c) = a.sin_cos();
            if c.approx() == 0.0 {
                return Err(both!("tan of a right angle"));
            }
            DimensionedValue::number(s / c)
        }
        Function::Ln | Function::Log10 => {
            wants(Dim::NUMBER, f.name())?;
            if a.number.approx() <= 0.0 {
                return Err(both!("{} has no value at {}", f.name(), a.number.approx()));
            }
            let ln = a.number.ln();
            DimensionedValue::number(if f == Function::Ln {
                ln
            } else {
                ln / N::from_f64(10.0).ln()
            })
        }
        Function::Exp => {
            wants(Dim::NUMBER, "exp")?;
            DimensionedValue::number(a.number.exp())
        }
        Function::Asin => inverse("asin", trig::asin, &|x| rad(x.atan2(leg(x))))?,
        Function::Acos => inverse("acos", trig::acos, &|x| rad(leg(x).atan2(x)))?,
        Function::Atan => inverse("atan", trig::atan, &|x| rad(x.atan2(N::from_f64(1.0))))?,
    })
}

#[cfg(test)]
mod tests {
    use super::super::expr::{bounded, parse};
    use super::*;
    use hodograph_base::diag::Span;
    use hodograph_base::trig::radians;

    /// Returns the value of an expression with r = 100 mm, phi = 30°, k = 2.
    fn value(text: &str) -> Result<DimensionedValue, String> {
        let length = value_of("100 mm").expect("a length");
        let lookup = |name: &str| match name {
            "r" => Some(length),
            "phi" => Some(DimensionedValue::deg(30.0)),
            "k" => Some(DimensionedValue::number(2.0)),
            _ => None,
        };
        let expr = parse(text, &["r", "phi", "k", "broken"]).map_err(|d| d.to_string())?;
        evaluate(&expr, &lookup).map_err(|e| match e {
            NoValue::Fault(d) => d.to_string(),
            NoValue::Reported => "reported".to_owned(),
        })
    }

    fn value_of(text: &str) -> Option<DimensionedValue> {
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
            ("1 m/s/r + 5 rad/s", 15.0, "an angular velocity"),
            ("(1 m/s/r)^2 - 10 rad/s^2", 90.0, "an angular acceleration"),
            ("-2 m/s/r", -20.0, "a quantity in 1/s"),
            ("pi rad/2", std::f64::consts::FRAC_PI_2, "an angle"),
            ("atan(1) + 15 deg", radians(60.0), "an angle"),
            ("tan(45 deg)", 1.0, "a pure number"),
            ("ln(exp(k))", 2.0, "a pure number"),
            ("log10(100)", 2.0, "a pure number"),
            ("60 s + 1 min", 120.0, "a time"),
        ] {
            let v = value(text).unwrap_or_else(|e| panic!("{text}: {e}"));
            let dim = if v.dim.length != 0 { Dim { angle: 0, ..v.dim } } else { v.dim };
            assert_eq!((v.si(), dim.describe().en.as_str()), (number, what), "{text}");
        }
    }

    /// Minutes and seconds of arc, as in books and on keyboards.
    #[test]
    fn minutes_and_seconds_of_arc() {
        let degrees = |text: &str| {
            let value: DimensionedValue<f64> =
                evaluate(&parse(text, &["a"]).unwrap_or_else(|d| panic!("{text}: {d}")), &|_| None)
                    .unwrap();
            assert!(value.degrees && value.dim == Dim::ANGLE, "{text}");
            value.number
        };
        for text in [
            "20°30'",
            "20 deg 30'",
            "20° 30′",
            "20deg 30’",
            "20°29'60\"".replace("60", "59.9999999999999").as_str(),
        ] {
            assert!((degrees(text) - 20.5).abs() < 1e-12, "{text}");
        }
        for text in ["20°30′15″", "20 deg 30' 15''", "20°30'15\"", "20 ° 30 ′ 15 ″"] {
            assert_eq!(degrees(text), 20.0 + 30.0 / 60.0 + 15.0 / 3600.0, "{text}");
        }
        assert_eq!(degrees("-14°2'10\""), -(14.0 + 2.0 / 60.0 + 10.0 / 3600.0));
        assert_eq!(degrees("90° - 14°2'"), 90.0 - (14.0 + 2.0 / 60.0));
        assert_eq!(degrees("2*14°15′"), 28.5);
        assert_eq!(degrees("5°12″"), 5.0 + 12.0 / 3600.0);
        for text in ["30'", "20°60'", "20°30'75″", "20°30", "20°30″15′", "20 rad 30'", "(20°)30'"]
        {
            assert!(parse(text, &[]).is_err(), "{text}");
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
        let Expr { kind: ExprKind::Binary(Operator::Mul, number, unit), span } =
            parse(" 0.10000000000000000001 mm", &[]).unwrap()
        else {
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
            (
                "100,5 mm",
                "`100,5 mm` has a comma in a number (write the decimal point: \"100.5 mm\")",
            ),
            ("2 $ 3", "`2 $ 3` cannot be read from `$ 3` on"),
            ("2 r", "`r` is not a unit (for a product write `*r`)"),
            ("(2) pi", "`pi` is not a unit (for a product write `*pi`)"),
            ("5 milimeters", "`milimeters` is not a unit"),
            ("R", "`R` is neither a parameter nor a unit (did you mean `r`?)"),
            ("sine(phi)", "`sine` is not a function (did you mean `sin`?)"),
            ("r(2)", "`r` is not a function (for a product write `r*(...)`)"),
            (
                "sin",
                "`sin` is neither a parameter nor a unit (`sin` is a function: write `sin(...)`)",
            ),
            ("1/0", "division by zero"),
            ("r + phi", "a length cannot be added to an angle"),
            ("1 m/s/r + 1 (m/s)/s", "a quantity in 1/s cannot be added to an acceleration"),
            ("r - 1", "a pure number cannot be subtracted from a length"),
            ("sin(30)", "sin wants an angle, this is a pure number: write `deg` or `rad` after it"),
            ("sin(r)", "sin wants an angle, this is a length"),
            ("asin(2)", "asin has no value at 2"),
            ("ln(-1)", "ln has no value at -1"),
            ("exp(r)", "exp wants a pure number, this is a length"),
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
        assert!(
            value(&"(".repeat(65))
                .unwrap_err()
                .starts_with("parentheses are nested more than 64 deep")
        );
        let said = |text: &str| bounded(text).unwrap_err().message.en;
        assert!(said(&"(".repeat(25)).starts_with("parentheses are nested more than 24 deep"));
        assert!(
            said(&"1+".repeat(201))
                .starts_with("an expression has at most 400 bytes, this has 402")
        );
        assert_eq!(
            value(&format!("{}1", "1+".repeat(400))).unwrap_err(),
            "an expression has more than 400 levels"
        );
        // The deepest trees within the limits.
        assert_eq!(value(&format!("{}1", "1+".repeat(199))).unwrap().number, 200.0);
        assert_eq!(value(&format!("{}1", "-".repeat(399))).unwrap().number, -1.0);
        assert_eq!(value(&format!("{}1{}", "(".repeat(24), ")".repeat(24))).unwrap().number, 1.0);
    }
}
