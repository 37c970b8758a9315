//! The units of the book: in which unit each kind of quantity is printed.
//!
//! Decided here, and nowhere else: the SI unit of each kind, the unit that a scene's `answers` asks for, and how
//! either is written. All values of the program stay SI; what is printed goes through [`Book`] once, at the end.

use super::expr::{self, Expr, ExprKind, Op};
use super::units::{Dim, UNITS, Unit, Wanted};
use hodograph_base::kind::Kind;
use hodograph_base::number::Real;
use hodograph_base::trig::radians;

/// A unit of one kind: `up / down` SI units, or that many degrees.
#[derive(Clone, Debug, PartialEq)]
pub struct BookUnit {
    name: String,
    label: String,
    /// Two whole numbers, so that a value is converted without a rounded factor.
    up: f64,
    down: f64,
    degrees: bool,
}

impl BookUnit {
    /// Reads a unit such as `in/s^2`.
    ///
    /// # Errors
    /// The units that fit, where the text is none of this kind.
    pub fn read(text: &str, kind: Kind) -> Result<BookUnit, Vec<String>> {
        BookUnit::of_kind(text, kind).ok_or_else(|| fitting(kind))
    }

    fn of_kind(text: &str, kind: Kind) -> Option<BookUnit> {
        let word: String = text.split_whitespace().collect();
        // Behind a number `r/min` is a unit, and not a parameter over minutes.
        let expr = expr::parse(&format!("1 {word}"), &[]).ok()?;
        let mut made = Made { dim: Dim::NUMBER, up: 1.0, down: 1.0, degrees: 0 };
        made.multiply(&expr, 1)?;
        let whole = made.dim == Wanted::of(kind).dim() && (0..=1).contains(&made.degrees);
        whole.then(|| BookUnit {
            name: superscripts(&word),
            label: labelled(&word),
            up: made.up,
            down: made.down,
            degrees: made.degrees == 1,
        })
    }

    /// A value in this unit; `si` in SI units. In numbers that know their error the result knows it too: ratios of units are
    /// whole numbers, and π is a ball.
    pub fn of<N: Real>(&self, si: N) -> N {
        let value = if self.degrees { si * N::from_f64(180.0) / N::pi() } else { si };
        // A factor of one is left out: it would only add to the bound of the error.
        let value = if self.down == 1.0 { value } else { value * N::from_f64(self.down) };
        if self.up == 1.0 { value } else { value / N::from_f64(self.up) }
    }

    /// One of the unit, in SI units.
    pub fn size(&self) -> f64 {
        let size = self.up / self.down;
        if self.degrees { radians(size) } else { size }
    }

    /// As a text says it: `in/s²`.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// A number with the unit, for a text: `12.5 in/s²`, `60°`.
    pub fn text(&self, number: &str) -> String {
        if self.is_degree() { format!("{number}°") } else { format!("{number} {}", self.name) }
    }

    /// The same in the label language: `12.5 in/s^2`, `60\degree`.
    pub fn label(&self, number: &str) -> String {
        if self.is_degree() { format!("{number}\\degree") } else { format!("{number} {}", self.label) }
    }

    /// Whether it is the degree, which stands at its number without a space.
    pub fn is_degree(&self) -> bool {
        matches!(self.name.as_str(), "deg" | "°")
    }
}

/// The units of a kind that consist of a unit of length or angle and seconds, and those with a name of their own.
fn fitting(kind: Kind) -> Vec<String> {
    let dim = Wanted::of(kind).dim();
    let per = match dim.time {
        0 => "",
        -1 => "/s",
        _ => "/s^2",
    };
    let base = Dim { time: 0, ..dim };
    let named = |wanted: Wanted| UNITS.iter().filter(move |u| u.dim == wanted.dim()).map(|u| u.name);
    let made = UNITS.iter().filter(|u| u.dim == base && u.name != "°").map(|u| format!("{}{per}", u.name));
    let moments = named(Wanted::Force).flat_map(|force| named(Wanted::Length).map(move |arm| format!("{force}*{arm}")));
    let moments = moments.filter(|text| kind == Kind::Moment && BookUnit::of_kind(text, kind).is_some());
    made.chain(moments)
        .chain((kind == Kind::Power).then(|| "N*m/s".to_owned()))
        .chain(UNITS.iter().filter(|u| dim.time != 0 && u.dim == dim).map(|u| u.name.to_owned()))
        .collect()
}

/// A product of powers of units.
struct Made {
    dim: Dim,
    up: f64,
    down: f64,
    degrees: i32,
}

impl Made {
    /// Multiplies by the `k`-th power of an expression; `None` where it holds anything but units.
    fn multiply(&mut self, expr: &Expr, k: i32) -> Option<()> {
        match &expr.kind {
            ExprKind::Unit(unit) => self.unit(unit, k),
            ExprKind::Number(one) => (one == "1").then_some(()),
            ExprKind::Binary(Op::Mul, a, b) => self.multiply(a, k).and_then(|()| self.multiply(b, k)),
            ExprKind::Binary(Op::Div, a, b) => self.multiply(a, k).and_then(|()| self.multiply(b, -k)),
            ExprKind::Binary(Op::Pow, a, n) => self.multiply(a, k * exponent(n)?),
            ExprKind::Binary(Op::Add | Op::Sub, ..) | ExprKind::Pi | ExprKind::Parameter(_) | ExprKind::Neg(_) | ExprKind::Call(..) => None,
        }
    }

    fn unit(&mut self, unit: &Unit, k: i32) -> Option<()> {
        // No quantity of kinematics has a higher power of a unit than the second.
        if k.abs() > 4 {
            return None;
        }
        for _ in 0..k.abs() {
            let (up, down) = if k > 0 { (unit.numerator, unit.denominator) } else { (unit.denominator, unit.numerator) };
            // A ratio of whole numbers that are not rounded.
            let (common, other) = (divisor(self.up, down), divisor(up, self.down));
            (self.up, self.down) = (exact(self.up / common, up / other)?, exact(self.down / other, down / common)?);
            let common = divisor(self.up, self.down);
            (self.up, self.down) = (self.up / common, self.down / common);
        }
        self.dim = self.dim.times(unit.dim, k);
        self.degrees += if unit.degrees { k } else { 0 };
        Some(())
    }
}

/// The product of two whole numbers; `None` where it is rounded.
fn exact(a: f64, b: f64) -> Option<f64> {
    let product = a * b;
    (product.is_finite() && libm::fma(a, b, -product) == 0.0).then_some(product)
}

/// A whole exponent as it is written.
fn exponent(expr: &Expr) -> Option<i32> {
    match &expr.kind {
        ExprKind::Number(text) => text.parse().ok().filter(|k: &i32| k.abs() <= 4),
        ExprKind::Neg(inner) => exponent(inner).map(|k| -k),
        ExprKind::Pi | ExprKind::Unit(_) | ExprKind::Parameter(_) | ExprKind::Binary(..) | ExprKind::Call(..) => None,
    }
}

/// The greatest common divisor of two whole numbers, by Euclid's algorithm.
fn divisor(a: f64, b: f64) -> f64 {
    if b == 0.0 { a } else { divisor(b, a % b) }
}

/// A unit's powers for a text: `in/s^2` as `in/s²`.
fn superscripts(word: &str) -> String {
    let mut out = String::new();
    for (k, part) in word.replace('*', "·").split('^').enumerate() {
        let end = if k == 0 { 0 } else { part.find(|c: char| c != '-' && !c.is_ascii_digit()).unwrap_or(part.len()) };
        out.extend(part[..end].chars().map(|c| match c {
            '-' => '⁻',
            c => "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(c as usize - '0' as usize).unwrap_or(c),
        }));
        out += &part[end..];
    }
    out
}

/// The same for the label language: an exponent of more than one character stands in braces.
fn labelled(word: &str) -> String {
    let mut out = String::new();
    for (k, part) in word.replace('*', "·").split('^').enumerate() {
        let end = if k == 0 { 0 } else { part.find(|c: char| c != '-' && !c.is_ascii_digit()).unwrap_or(part.len()) };
        match end {
            0 => {}
            1 => out += &format!("^{}", &part[..1]),
            _ => out += &format!("^{{{}}}", &part[..end]),
        }
        out += &part[end..];
    }
    out
}

/// In which unit each kind is printed: what the scene's `answers` say, else SI with angles in degrees.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Book {
    units: [Option<BookUnit>; Kind::ALL.len()],
}

impl Book {
    pub(super) fn set(&mut self, kind: Kind, unit: BookUnit) {
        if let Some(place) = self.units.get_mut(kind as usize) {
            *place = Some(unit);
        }
    }

    /// The unit that the scene asks for; `None`: the usual one.
    pub fn chosen(&self, kind: Kind) -> Option<&BookUnit> {
        self.units.get(kind as usize)?.as_ref()
    }

    /// Whether any of these kinds has a unit of the book.
    pub fn any(&self, kinds: &[Kind]) -> bool {
        kinds.iter().any(|k| self.chosen(*k).is_some())
    }

    /// An SI value in the unit that is printed (angles, unless others are asked for, in degrees).
    pub fn value(&self, kind: Kind, si: f64) -> f64 {
        match self.chosen(kind) {
            Some(unit) => unit.of(si),
            None if kind == Kind::Angle => si.to_degrees(),
            None => si,
        }
    }

    /// The same in any number, where a unit is chosen; else SI as it is.
    pub fn in_chosen<N: Real>(&self, kind: Kind, si: N) -> N {
        self.chosen(kind).map_or(si, |unit| unit.of(si))
    }

    /// A number with its unit, for a text: `12.5 in/s²`, `60°`.
    pub fn text(&self, kind: Kind, number: &str) -> String {
        match self.name(kind) {
            "°" => format!("{number}°"),
            "" => number.to_owned(),
            name => format!("{number} {name}"),
        }
    }

    /// A number with its unit in the label language: `12.5 in/s^2`, `60\degree`.
    pub fn label(&self, kind: Kind, number: &str) -> String {
        match self.label_name(kind) {
            "\\degree" => format!("{number}\\degree"),
            "" => number.to_owned(),
            name => format!("{number} {name}"),
        }
    }

    /// The unit's name: `in/s²`, `°`.
    pub fn name(&self, kind: Kind) -> &str {
        match self.chosen(kind) {
            Some(unit) if unit.is_degree() => "°",
            Some(unit) => &unit.name,
            None if kind == Kind::Angle => "°",
            None => kind.si(),
        }
    }

    fn label_name(&self, kind: Kind) -> &str {
        match (self.chosen(kind), kind) {
            (Some(unit), _) if unit.is_degree() => "\\degree",
            (Some(unit), _) => &unit.label,
            (None, Kind::Angle) => "\\degree",
            (None, Kind::Acceleration) => "m/s^2",
            (None, Kind::Alpha) => "rad/s^2",
            (None, Kind::Length | Kind::Velocity | Kind::Omega | Kind::Force | Kind::Moment | Kind::Power | Kind::Time | Kind::Number) => {
                kind.si()
            }
        }
    }

    /// The unit alone in the label language, upright though no number stands before it: `\text{in/s}^2`.
    pub fn upright(&self, kind: Kind) -> String {
        match self.label_name(kind) {
            "\\degree" => "\\degree".into(),
            name => upright(name),
        }
    }

    /// The unit of a scale, for a text: `(in/s²)/mm`.
    pub fn scale_name(&self, kind: Kind) -> String {
        per_mm(self.name(kind))
    }

    /// The same in the label language.
    pub fn scale_label(&self, kind: Kind) -> String {
        per_mm(self.label_name(kind))
    }

    /// The unit of small things, and how many of it an SI unit has: as elsewhere, but lengths, unless another unit is asked for,
    /// in millimetres. The unit is upright in the label language.
    pub fn fine(&self, kind: Kind) -> (String, f64) {
        match (self.chosen(kind), kind) {
            (None, Kind::Length) => (upright("mm"), 1e3),
            (Some(unit), _) => (self.upright(kind), unit.of(1.0)),
            (None, _) => (self.upright(kind), self.value(kind, 1.0)),
        }
    }

    /// In how many parts of its unit a driver's position is told, where that is `usual` of a degree or a millimetre: as finely, to a
    /// power of ten, in any other unit.
    pub fn parts(&self, kind: Kind, usual: f64) -> f64 {
        let (factor, plain) = (self.fine(kind).1, Book::default().fine(kind).1);
        if factor == plain { usual } else { libm::exp10(libm::round(libm::log10(usual * plain / factor))).max(1.0) }
    }

    /// One of the unit in SI units, where one is chosen: scales are round in it. Else 1.
    pub fn size(&self, kind: Kind) -> f64 {
        self.chosen(kind).map_or(1.0, BookUnit::size)
    }
}

/// A unit in the label language, its letters upright where no number stands before them.
fn upright(name: &str) -> String {
    let mut out = String::new();
    for (k, part) in name.split('^').enumerate() {
        let end = match (k, part.strip_prefix('{').and_then(|p| p.find('}'))) {
            (0, _) => 0,
            (_, Some(close)) => close + 2,
            (_, None) => 1,
        };
        if k > 0 {
            out += &format!("^{}", &part[..end]);
        }
        if end < part.len() {
            out += &format!("\\text{{{}}}", &part[end..]);
        }
    }
    out
}

fn per_mm(name: &str) -> String {
    if name.chars().all(char::is_alphabetic) { format!("{name}/mm") } else { format!("({name})/mm") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hodograph_base::number::Ball;

    fn unit(text: &str, kind: Kind) -> BookUnit {
        BookUnit::read(text, kind).unwrap_or_else(|fitting| panic!("{text}: {fitting:?}"))
    }

    #[test]
    fn units_are_ratios_of_whole_numbers() {
        for (text, kind, up, down, degrees, name, label) in [
            ("ft", Kind::Length, 381.0, 1250.0, false, "ft", "ft"),
            ("in/s^2", Kind::Acceleration, 127.0, 5000.0, false, "in/s²", "in/s^2"),
            ("mm / min", Kind::Velocity, 1.0, 60000.0, false, "mm/min", "mm/min"),
            ("r/min", Kind::Omega, 6.0, 1.0, true, "r/min", "r/min"),
            ("rev/min^2", Kind::Alpha, 1.0, 10.0, true, "rev/min²", "rev/min^2"),
            ("m*s^-2", Kind::Acceleration, 1.0, 1.0, false, "m·s⁻²", "m·s^{-2}"),
            ("(ft/s)/s", Kind::Acceleration, 381.0, 1250.0, false, "(ft/s)/s", "(ft/s)/s"),
            ("°", Kind::Angle, 1.0, 1.0, true, "°", "°"),
        ] {
            let u = unit(text, kind);
            assert_eq!((u.up, u.down, u.degrees, &*u.name, &*u.label), (up, down, degrees, name, label), "{text}");
        }
    }

    #[test]
    fn what_is_no_unit_of_its_kind_is_told_those_that_are() {
        for (text, kind) in
            [("mm", Kind::Velocity), ("2*mm", Kind::Length), ("furlong", Kind::Length), ("1/s", Kind::Omega), ("", Kind::Angle)]
        {
            assert!(BookUnit::read(text, kind).is_err(), "{text}");
        }
        assert!(BookUnit::read(&format!("m{}", "/m*m".repeat(300)), Kind::Length).is_err());
        for kind in Kind::ALL {
            let fitting = BookUnit::read("?", kind).unwrap_err();
            assert!(fitting.len() > 2 && fitting.iter().all(|text| BookUnit::read(text, kind).is_ok()), "{fitting:?}");
        }
        assert_eq!(BookUnit::read("?", Kind::Omega).unwrap_err(), ["deg/s", "rad/s", "rev/s", "rpm", "r/min"]);
    }

    #[test]
    fn values_and_their_bounds() {
        let ball = unit("rpm", Kind::Omega).of(Ball::<f64>::pi());
        assert!((ball.approx() - 30.0).abs() <= ball.radius() && ball.radius() < 1e-12);
        assert_eq!(unit("ft", Kind::Length).of(0.3048), 1.0);
        let usual = Book::default();
        assert_eq!((usual.value(Kind::Angle, std::f64::consts::TAU), usual.value(Kind::Length, 2.0)), (360.0, 2.0));
    }

    #[test]
    fn units_as_they_are_written() {
        let mut book = Book::default();
        assert_eq!((book.upright(Kind::Alpha), book.scale_label(Kind::Acceleration)), ("\\text{rad/s}^2".into(), "(m/s^2)/mm".into()));
        assert_eq!((book.scale_name(Kind::Length), book.fine(Kind::Length)), ("m/mm".into(), ("\\text{mm}".into(), 1e3)));
        assert_eq!([book.parts(Kind::Length, 100.0), book.parts(Kind::Angle, 10.0)], [100.0, 10.0]);
        book.set(Kind::Length, unit("km", Kind::Length));
        assert_eq!(book.parts(Kind::Length, 100.0), 1e8);
        book.set(Kind::Acceleration, unit("m*s^-2", Kind::Acceleration));
        book.set(Kind::Angle, unit("rad", Kind::Angle));
        assert_eq!((book.upright(Kind::Acceleration), book.text(Kind::Angle, "1")), ("\\text{m·s}^{-2}".into(), "1 rad".into()));
        assert_eq!(book.label(Kind::Omega, "3"), "3 rad/s");
    }
}
