//! The units of the book: the unit in which each kind of quantity is printed.
//!
//! This module alone defines the SI unit of each kind, the unit that a scene's `answers` choose,
//! and their written forms. All values of the program are in SI units; printing converts them once,
//! by [`Book`].

use super::expr::{self, Expr, ExprKind, Operator};
use super::units::{Dim, RequiredQuantity, UNITS, Unit};
use hodograph_base::kind::Kind;
use hodograph_base::number::Real;
use hodograph_base::trig::radians;

/// A unit of one kind: `up / down` SI units, or that many degrees.
#[derive(Clone, Debug, PartialEq)]
pub struct BookUnit {
    name: String,
    label: String,
    /// Two whole numbers, so that a conversion has no rounded factor.
    up: f64,
    down: f64,
    degrees: bool,
}

impl BookUnit {
    /// Reads a unit such as `in/s^2`.
    ///
    /// # Errors
    /// The units that fit, if the text is not a unit of this kind.
    pub fn read(text: &str, kind: Kind) -> Result<BookUnit, Vec<String>> {
        BookUnit::of_kind(text, kind).ok_or_else(|| fitting(kind))
    }

    fn of_kind(text: &str, kind: Kind) -> Option<BookUnit> {
        let word: String = text.split_whitespace().collect();
        // After a number `r/min` is a unit, and not a parameter divided by minutes.
        let expr = expr::parse(&format!("1 {word}"), &[]).ok()?;
        let mut made = UnitProduct { dim: Dim::NUMBER, up: 1.0, down: 1.0, degrees: 0 };
        made.multiply(&expr, 1)?;
        let whole = made.dim == RequiredQuantity::of(kind).dim() && (0..=1).contains(&made.degrees);
        whole.then(|| BookUnit {
            name: superscripts(&word),
            label: labelled(&word),
            up: made.up,
            down: made.down,
            degrees: made.degrees == 1,
        })
    }

    /// Returns a value in this unit; `si` is in SI units. Number types with an error bound keep it:
    /// ratios of units are whole numbers, and π is a ball.
    pub fn of<N: Real>(&self, si: N) -> N {
        let value = if self.degrees { si * N::from_f64(180.0) / N::pi() } else { si };
        // A factor of one is omitted: it would only add to the error bound.
        let value = if self.down == 1.0 { value } else { value * N::from_f64(self.down) };
        if self.up == 1.0 { value } else { value / N::from_f64(self.up) }
    }

    /// Returns one unit, in SI units.
    pub fn size(&self) -> f64 {
        let size = self.up / self.down;
        if self.degrees { radians(size) } else { size }
    }

    /// Returns its form in a text: `in/s²`.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns a number with the unit, for a text: `12.5 in/s²`, `60°`.
    pub fn text(&self, number: &str) -> String {
        if self.is_degree() { format!("{number}°") } else { format!("{number} {}", self.name) }
    }

    /// Returns a number with the unit in the label language: `12.5 in/s^2`, `60\degree`.
    pub fn label(&self, number: &str) -> String {
        if self.is_degree() {
            format!("{number}\\degree")
        } else {
            format!("{number} {}", self.label)
        }
    }

    /// Returns true for the degree, which follows its number without a space.
    pub fn is_degree(&self) -> bool {
        matches!(self.name.as_str(), "deg" | "°")
    }
}

/// Returns the units of a kind: those of a unit of length or angle and seconds, and those with
/// their own names.
fn fitting(kind: Kind) -> Vec<String> {
    let dim = RequiredQuantity::of(kind).dim();
    let per = match dim.time {
        0 => "",
        -1 => "/s",
        _ => "/s^2",
    };
    let base = Dim { time: 0, ..dim };
    let named = |wanted: RequiredQuantity| {
        UNITS.iter().filter(move |u| u.dim == wanted.dim()).map(|u| u.name)
    };
    let made =
        UNITS.iter().filter(|u| u.dim == base && u.name != "°").map(|u| format!("{}{per}", u.name));
    let moments = named(RequiredQuantity::Force)
        .flat_map(|force| named(RequiredQuantity::Length).map(move |arm| format!("{force}*{arm}")));
    let moments =
        moments.filter(|text| kind == Kind::Moment && BookUnit::of_kind(text, kind).is_some());
    made.chain(moments)
        .chain((kind == Kind::Power).then(|| "N*m/s".to_owned()))
        .chain(UNITS.iter().filter(|u| dim.time != 0 && u.dim == dim).map(|u| u.name.to_owned()))
        .collect()
}

/// A product of powers of units.
struct UnitProduct {
    dim: Dim,
    up: f64,
    down: f64,
    degrees: i32,
}

impl UnitProduct {
    /// Multiplies by the `k`-th power of an expression; returns `None` if it contains anything but
    /// units.
    fn multiply(&mut self, expr: &Expr, k: i32) -> Option<()> {
        match &expr.kind {
            ExprKind::Unit(unit) => self.unit(unit, k),
            ExprKind::Number(one) => (one == "1").then_some(()),
            ExprKind::Binary(Operator::Mul, a, b) => {
                self.multiply(a, k).and_then(|()| self.multiply(b, k))
            }
            ExprKind::Binary(Operator::Div, a, b) => {
                self.multiply(a, k).and_then(|()| self.multiply(b, -k))
            }
            ExprKind::Binary(Operator::Pow, a, n) => self.multiply(a, k * exponent(n)?),
            ExprKind::Binary(Operator::Add | Operator::Sub, ..)
            | ExprKind::Pi
            | ExprKind::Parameter(_)
            | ExprKind::Neg(_)
            | ExprKind::Call(..) => None,
        }
    }

    fn unit(&mut self, unit: &Unit, k: i32) -> Option<()> {
        // Quantities of kinematics contain no power of a unit above the second.
        if k.abs() > 4 {
            return None;
        }
        for _ in 0..k.abs() {
            let (up, down) = if k > 0 {
                (unit.numerator, unit.denominator)
            } else {
                (unit.denominator, unit.numerator)
            };
            // A ratio of whole numbers that are not rounded.
            let (common, other) = (divisor(self.up, down), divisor(up, self.down));
            (self.up, self.down) =
                (exact(self.up / common, up / other)?, exact(self.down / other, down / common)?);
            let common = divisor(self.up, self.down);
            (self.up, self.down) = (self.up / common, self.down / common);
        }
        self.dim = self.dim.times(unit.dim, k);
        self.degrees += if unit.degrees { k } else { 0 };
        Some(())
    }
}

/// Returns the product of two whole numbers; `None` if it is rounded.
fn exact(a: f64, b: f64) -> Option<f64> {
    let product = a * b;
    (product.is_finite() && libm::fma(a, b, -product) == 0.0).then_some(product)
}

/// Returns a whole exponent as written.
fn exponent(expr: &Expr) -> Option<i32> {
    match &expr.kind {
        ExprKind::Number(text) => text.parse().ok().filter(|k: &i32| k.abs() <= 4),
        ExprKind::Neg(inner) => exponent(inner).map(|k| -k),
        ExprKind::Pi
        | ExprKind::Unit(_)
        | ExprKind::Parameter(_)
        | ExprKind::Binary(..)
        | ExprKind::Call(..) => None,
    }
}

/// Returns the greatest common divisor of two whole numbers, by Euclid's algorithm.
fn divisor(a: f64, b: f64) -> f64 {
    if b == 0.0 { a } else { divisor(b, a % b) }
}

/// Returns a unit with superscripts for a text: `in/s^2` as `in/s²`.
fn superscripts(word: &str) -> String {
    let mut out = String::new();
    for (k, part) in word.replace('*', "·").split('^').enumerate() {
        let end = if k == 0 {
            0
        } else {
            part.find(|c: char| c != '-' && !c.is_ascii_digit()).unwrap_or(part.len())
        };
        out.extend(part[..end].chars().map(|c| match c {
            '-' => '⁻',
            c => "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(c as usize - '0' as usize).unwrap_or(c),
        }));
        out += &part[end..];
    }
    out
}

/// Returns a unit for the label language: exponents of more than one character are in braces.
fn labelled(word: &str) -> String {
    let mut out = String::new();
    for (k, part) in word.replace('*', "·").split('^').enumerate() {
        let end = if k == 0 {
            0
        } else {
            part.find(|c: char| c != '-' && !c.is_ascii_digit()).unwrap_or(part.len())
        };
        match end {
            0 => {}
            1 => out += &format!("^{}", &part[..1]),
            _ => out += &format!("^{{{}}}", &part[..end]),
        }
        out += &part[end..];
    }
    out
}

/// The unit in which each kind is printed: that of the scene's `answers`, else SI with angles in
/// degrees.
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

    /// Returns the unit that the scene chooses; `None`: the default.
    pub fn chosen(&self, kind: Kind) -> Option<&BookUnit> {
        self.units.get(kind as usize)?.as_ref()
    }

    /// Returns the units of a table from a list with commas. `book` stands for the units that the
    /// scene chooses, and mm, mm/s, mm/s² and degrees for kinds without one; without this word
    /// they are SI units. Every other word is a unit, which replaces that of its kind.
    ///
    /// # Errors
    /// The first word that is no unit of any kind.
    pub fn of_table(&self, list: &str) -> Result<Book, String> {
        let words: Vec<&str> = list.split(',').map(str::trim).collect();
        let mut table = Book::default();
        let usual: &[(Kind, &str)] = match words.contains(&"book") {
            true => &[
                (Kind::Length, "mm"),
                (Kind::Velocity, "mm/s"),
                (Kind::Acceleration, "mm/s^2"),
                (Kind::Angle, "deg"),
            ],
            false => &[(Kind::Angle, "rad")],
        };
        for (kind, word) in usual {
            BookUnit::of_kind(word, *kind).into_iter().for_each(|unit| table.set(*kind, unit));
        }
        if words.contains(&"book") {
            let chosen = Kind::ALL.into_iter().filter_map(|k| Some((k, self.chosen(k)?.clone())));
            chosen.for_each(|(kind, unit)| table.set(kind, unit));
        }
        for word in words.into_iter().filter(|w| *w != "book") {
            let units = Kind::ALL.map(|kind| (kind, BookUnit::of_kind(word, kind)));
            if units.iter().all(|(_, unit)| unit.is_none()) {
                return Err(word.to_owned());
            }
            units
                .into_iter()
                .for_each(|(kind, unit)| unit.into_iter().for_each(|u| table.set(kind, u)));
        }
        Ok(table)
    }

    /// Returns true if any of these kinds has a chosen unit.
    pub fn any(&self, kinds: &[Kind]) -> bool {
        kinds.iter().any(|k| self.chosen(*k).is_some())
    }

    /// Returns an SI value in the printed unit (for angles the default is degrees).
    pub fn value(&self, kind: Kind, si: f64) -> f64 {
        match self.chosen(kind) {
            Some(unit) => unit.of(si),
            None if kind == Kind::Angle => si.to_degrees(),
            None => si,
        }
    }

    /// Returns a value in any number type in the chosen unit, else in SI units.
    pub fn in_chosen<N: Real>(&self, kind: Kind, si: N) -> N {
        self.chosen(kind).map_or(si, |unit| unit.of(si))
    }

    /// Returns a number with its unit, for a text: `12.5 in/s²`, `60°`.
    pub fn text(&self, kind: Kind, number: &str) -> String {
        match self.name(kind) {
            "°" => format!("{number}°"),
            "" => number.to_owned(),
            name => format!("{number} {name}"),
        }
    }

    /// Returns a number with its unit in the label language: `12.5 in/s^2`, `60\degree`.
    pub fn label(&self, kind: Kind, number: &str) -> String {
        match self.label_name(kind) {
            "\\degree" => format!("{number}\\degree"),
            "" => number.to_owned(),
            name => format!("{number} {name}"),
        }
    }

    /// Returns the unit's name: `in/s²`, `°`.
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
            (
                None,
                Kind::Length
                | Kind::Velocity
                | Kind::Omega
                | Kind::Force
                | Kind::Moment
                | Kind::Power
                | Kind::Time
                | Kind::Number,
            ) => kind.si(),
        }
    }

    /// Returns the unit alone in the label language, upright without a number before it:
    /// `\text{in/s}^2`.
    pub fn upright(&self, kind: Kind) -> String {
        match self.label_name(kind) {
            "\\degree" => "\\degree".into(),
            name => upright(name),
        }
    }

    /// Returns the unit of a scale, for a text: `(in/s²)/mm`.
    pub fn scale_name(&self, kind: Kind) -> String {
        per_mm(self.name(kind))
    }

    /// Returns the unit of a scale in the label language.
    pub fn scale_label(&self, kind: Kind) -> String {
        per_mm(self.label_name(kind))
    }

    /// Returns the unit for small quantities, and its number per SI unit: the printed unit, but
    /// millimetres for lengths without a chosen unit. The unit is upright in the label language.
    pub fn fine(&self, kind: Kind) -> (String, f64) {
        match (self.chosen(kind), kind) {
            (None, Kind::Length) => (upright("mm"), 1e3),
            (Some(unit), _) => (self.upright(kind), unit.of(1.0)),
            (None, _) => (self.upright(kind), self.value(kind, 1.0)),
        }
    }

    /// Returns the number of parts of a unit in which a driver's position is given. It is `usual`
    /// for a degree or a millimetre, and equally fine, to a power of ten, for other units.
    pub fn parts(&self, kind: Kind, usual: f64) -> f64 {
        let (factor, plain) = (self.fine(kind).1, Book::default().fine(kind).1);
        if factor == plain {
            usual
        } else {
            libm::exp10(libm::round(libm::log10(usual * plain / factor))).max(1.0)
        }
    }

    /// Returns one chosen unit in SI units, because scales are round in it; 1 without a chosen
    /// unit.
    pub fn size(&self, kind: Kind) -> f64 {
        self.chosen(kind).map_or(1.0, BookUnit::size)
    }
}

/// Returns a unit in the label language, with upright letters if no number precedes them.
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
    if name.chars().all(char::is_alphabetic) {
        format!("{name}/mm")
    } else {
        format!("({name})/mm")
    }
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
            assert_eq!(
                (u.up, u.down, u.degrees, &*u.name, &*u.label),
                (up, down, degrees, name, label),
                "{text}"
            );
        }
    }

    #[test]
    fn what_is_no_unit_of_its_kind_is_told_those_that_are() {
        for (text, kind) in [
            ("mm", Kind::Velocity),
            ("2*mm", Kind::Length),
            ("furlong", Kind::Length),
            ("1/s", Kind::Omega),
            ("", Kind::Angle),
        ] {
            assert!(BookUnit::read(text, kind).is_err(), "{text}");
        }
        assert!(BookUnit::read(&format!("m{}", "/m*m".repeat(300)), Kind::Length).is_err());
        for kind in Kind::ALL {
            let fitting = BookUnit::read("?", kind).unwrap_err();
            assert!(
                fitting.len() > 2 && fitting.iter().all(|text| BookUnit::read(text, kind).is_ok()),
                "{fitting:?}"
            );
        }
        assert_eq!(
            BookUnit::read("?", Kind::Omega).unwrap_err(),
            ["deg/s", "rad/s", "rev/s", "rpm", "r/min"]
        );
    }

    #[test]
    fn values_and_their_bounds() {
        let ball = unit("rpm", Kind::Omega).of(Ball::<f64>::pi());
        assert!((ball.approx() - 30.0).abs() <= ball.radius() && ball.radius() < 1e-12);
        assert_eq!(unit("ft", Kind::Length).of(0.3048), 1.0);
        let usual = Book::default();
        assert_eq!(
            (usual.value(Kind::Angle, std::f64::consts::TAU), usual.value(Kind::Length, 2.0)),
            (360.0, 2.0)
        );
    }

    #[test]
    fn units_as_they_are_written() {
        let mut book = Book::default();
        assert_eq!(
            (book.upright(Kind::Alpha), book.scale_label(Kind::Acceleration)),
            ("\\text{rad/s}^2".into(), "(m/s^2)/mm".into())
        );
        assert_eq!(
            (book.scale_name(Kind::Length), book.fine(Kind::Length)),
            ("m/mm".into(), ("\\text{mm}".into(), 1e3))
        );
        assert_eq!([book.parts(Kind::Length, 100.0), book.parts(Kind::Angle, 10.0)], [100.0, 10.0]);
        book.set(Kind::Length, unit("km", Kind::Length));
        assert_eq!(book.parts(Kind::Length, 100.0), 1e8);
        book.set(Kind::Acceleration, unit("m*s^-2", Kind::Acceleration));
        book.set(Kind::Angle, unit("rad", Kind::Angle));
        assert_eq!(
            (book.upright(Kind::Acceleration), book.text(Kind::Angle, "1")),
            ("\\text{m·s}^{-2}".into(), "1 rad".into())
        );
        assert_eq!(book.label(Kind::Omega, "3"), "3 rad/s");
    }
}
