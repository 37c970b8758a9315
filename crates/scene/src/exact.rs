//! The given numbers of a scene as written, in any number type.
//!
//! `39.3 mm` is not an exact `f64`. A number type with an error bound takes the `f64` with the
//! bound from the reader; a longer one reads the text again, the parameters first, in the order of
//! the scene.

use super::eval::{DimensionedValue, evaluate};
use super::expr;
use super::model::{Angle, Driver, GivenQuantity, Scene};
use hodograph_base::number::{Ball, Big, Real, within};

/// Precisions in bits for reading a quantity again: numbers of a scene are between 1e-90 and 1e90,
/// so that sums and differences of them lose no digit in 768 bits.
const BITS: [usize; 3] = [192, 384, 768];

/// Largest acceptable relative error of a value, some hundred roundings. A larger error means that
/// the written form loses digits.
const LOST: f64 = 1e-13;

/// A difference of written numbers that is no larger than this in the longest number type is zero:
/// nonzero differences are larger.
const NOTHING: f64 = 1e-100;

/// Returns the value of a text and its value with an error bound. If the difference of large
/// numbers or the sine of a large angle loses digits in `f64`, they are computed in higher
/// precision and rounded once. `texts` gives the parameters that it depends on.
pub(super) fn settled<'a>(
    texts: impl FnOnce() -> Vec<(&'a str, &'a str)>,
    text: &str,
    value: DimensionedValue,
    ball: DimensionedValue<Ball<f64>>,
) -> (DimensionedValue, DimensionedValue<Ball<f64>>) {
    let off = distance(&value, ball);
    if off <= LOST * value.number.abs() {
        return (value, ball);
    }
    let texts = texts();
    let longer = BITS.into_iter().find_map(|bits| {
        within(bits, || {
            let read =
                Inputs::<Ball<Big>>::of_texts(&texts).read(text).filter(|v| v.dim == value.dim)?;
            rounded(in_unit_of(read, value.degrees))
        })
    });
    let Some((number, radius)) = longer else { return (value, ball) };
    (
        DimensionedValue { number, ..value },
        DimensionedValue {
            number: Ball::new(number, radius),
            dim: value.dim,
            degrees: value.degrees,
        },
    )
}

/// Returns a bound on the distance of a value from the true number in a ball.
pub(super) fn distance(value: &DimensionedValue, ball: DimensionedValue<Ball<f64>>) -> f64 {
    let number = in_unit_of(ball, value.degrees);
    (number.approx() - value.number).abs() + number.radius()
}

/// Returns true if an angle with this error bound (in its own unit) is as accurate as one within a
/// turn: a unit in the last place of a turn is 6e-14 degrees, and a mechanism magnifies it no more
/// than the rounding of its lengths.
pub(super) fn is_resolved(angle: Angle, off: f64) -> bool {
    match angle {
        Angle::Deg(number) => number.abs() <= 360.0 || off <= 1e-12,
        Angle::Rad(number) => number.abs() <= std::f64::consts::TAU || off <= 2e-14,
    }
}

/// Returns the angle of a text minus whole turns, and an error bound; in degrees, or in radians.
pub(super) fn less_turns(texts: &[(&str, &str)], text: &str, degrees: bool) -> Option<(f64, f64)> {
    BITS.into_iter().find_map(|bits| {
        within(bits, || {
            let mut rest = in_unit_of(Inputs::<Ball<Big>>::of_texts(texts).read(text)?, degrees);
            let turn: Ball<Big> =
                if degrees { Ball::from_f64(360.0) } else { Ball::pi() + Ball::pi() };
            // Each pass subtracts the remaining turns as far as an `f64` resolves them.
            for _ in 0..8 {
                let turns = libm::trunc(rest.approx() / turn.approx());
                if turns == 0.0 || !turns.is_finite() {
                    break;
                }
                rest = rest - turn * Ball::from_f64(turns);
            }
            rounded(rest)
        })
    })
}

/// Returns the whole turns between a text and a value derived from it (degrees): in parts, each an
/// `f64`.
pub(super) fn turns_taken(texts: &[(&str, &str)], text: &str, degrees: f64) -> Vec<f64> {
    let longest = BITS.into_iter().fold(0, usize::max);
    within(longest, || {
        let mut taken = Vec::new();
        let Some(read) = Inputs::<Ball<Big>>::of_texts(texts).read(text) else { return taken };
        let mut rest = in_unit_of(read, true) - Ball::from_f64(degrees);
        for _ in 0..8 {
            let turns = libm::rint(rest.approx() / 360.0);
            if turns == 0.0 || !turns.is_finite() {
                break;
            }
            rest = rest - Ball::from_f64(360.0) * Ball::from_f64(turns);
            taken.push(turns);
        }
        taken
    })
}

fn in_unit_of<N: Real>(v: DimensionedValue<N>, degrees: bool) -> N {
    match (v.degrees, degrees) {
        (true, true) => v.number,
        (false, true) => v.number * N::from_f64(180.0) / N::pi(),
        (_, false) => v.si(),
    }
}

/// Returns the nearest `f64` and a bound of its distance, if the number is accurate enough.
fn rounded(x: Ball<Big>) -> Option<(f64, f64)> {
    let (m, r) = (x.approx(), x.radius());
    if x.contains_zero() && r < NOTHING {
        return Some((0.0, m.abs() + r));
    }
    // Half a unit in the last place for the rounding of the midpoint.
    (r <= 0.25 * f64::EPSILON * m.abs()).then_some((m, r + 0.5 * f64::EPSILON * m.abs()))
}

/// A scene's quantities in one number type.
#[derive(Clone, Debug)]
pub struct Inputs<'a, N> {
    /// Names of the parameters; empty if the `f64` values of the reader are accurate enough.
    names: Vec<&'a str>,
    /// Their values.
    values: Vec<Option<DimensionedValue<N>>>,
    /// Time since the scene's instant (s), during which the drivers move.
    time: Option<N>,
}

impl<'a, N: Real> Inputs<'a, N> {
    /// Returns the quantities of a scene.
    pub fn of(scene: &'a Scene) -> Self {
        if N::from_bounded(0.0, 0.0).is_some() {
            return Inputs::of_texts(&[]);
        }
        let texts = scene.parameters.iter().map(|(name, given)| (&**name, &*given.text));
        Inputs::of_texts(&texts.collect::<Vec<_>>())
    }

    /// Returns the quantities of parameters given by name and text, each after those in its
    /// expression.
    pub(super) fn of_texts(texts: &[(&'a str, &str)]) -> Self {
        let mut inputs = Inputs { names: Vec::new(), values: Vec::new(), time: None };
        for (name, text) in texts {
            let value = inputs.read(text);
            inputs.names.push(name);
            inputs.values.push(value);
        }
        inputs
    }

    /// Returns a quantity in SI units. Without a text it is the double-precision value with its
    /// bound; if the text has no value in this number type, the result is undecided.
    pub fn number(&self, given: &GivenQuantity) -> N {
        let untold =
            || given.text.is_empty().then(|| N::from_f64(given.value).widened(given.radius));
        N::from_bounded(given.value, given.radius)
            .or_else(untold)
            .or_else(|| self.read(&given.text).map(DimensionedValue::si))
            .unwrap_or(N::from_f64(f64::NAN))
    }

    /// Returns (sin, cos) of an angle, reduced in degrees if it is written in degrees.
    pub fn sin_cos(&self, given: &GivenQuantity<Angle>) -> (N, N) {
        let nothing = N::from_f64(f64::NAN);
        let untold = |x: f64| given.text.is_empty().then(|| N::from_f64(x).widened(given.radius));
        match given.value {
            Angle::Deg(d) => {
                N::from_bounded(d, given.radius).or_else(|| untold(d)).map(Real::sin_cos_degrees)
            }
            Angle::Rad(r) => {
                N::from_bounded(r, given.radius).or_else(|| untold(r)).map(Real::sin_cos)
            }
        }
        .or_else(|| self.read(&given.text).map(DimensionedValue::sin_cos))
        .unwrap_or((nothing, nothing))
    }

    /// Returns an angle in degrees.
    pub fn degrees(&self, given: &GivenQuantity<Angle>) -> N {
        let known = |x: f64| {
            N::from_bounded(x, given.radius)
                .or_else(|| given.text.is_empty().then(|| N::from_f64(x).widened(given.radius)))
        };
        let in_degrees = |radians: N| radians * N::from_f64(180.0) / N::pi();
        match given.value {
            Angle::Deg(d) => known(d),
            Angle::Rad(r) => known(r).map(in_degrees),
        }
        .or_else(|| self.read(&given.text).map(|v| in_unit_of(v, true)))
        .unwrap_or(N::from_f64(f64::NAN))
    }

    /// Returns the same quantities at a time `t` (s) after the scene's instant.
    pub fn later(self, t: N) -> Self {
        Inputs { time: Some(t), ..self }
    }

    /// Returns the motion of a driver since the instant: rate · t + acceleration · t²/2.
    fn gone_on(&self, driver: &Driver) -> Option<N> {
        let t = self.time?;
        let way = self.number(&driver.rate) * t;
        Some(match &driver.acceleration {
            Some(a) => way + self.number(a) * t * t * N::from_f64(0.5),
            None => way,
        })
    }

    /// Returns the position of a sliding driver or the length of a cylinder (m).
    pub fn driven(&self, driver: &Driver, given: &GivenQuantity) -> N {
        let start = self.number(given);
        self.gone_on(driver).map_or(start, |way| start + way)
    }

    /// Returns (sin, cos) of the angle of a turning driver.
    pub fn driven_sin_cos(&self, driver: &Driver, given: &GivenQuantity<Angle>) -> (N, N) {
        let (s, c) = self.sin_cos(given);
        match self.gone_on(driver).map(Real::sin_cos) {
            None => (s, c),
            Some((ds, dc)) => (s * dc + c * ds, c * dc - s * ds),
        }
    }

    /// Returns the value of a text in SI units.
    pub(super) fn text(&self, text: &str) -> Option<N> {
        self.read(text).map(DimensionedValue::si).filter(|x| x.is_decided())
    }

    fn read(&self, text: &str) -> Option<DimensionedValue<N>> {
        let expr = expr::parse(text, &self.names).ok()?;
        let lookup = |name: &str| {
            self.names
                .iter()
                .position(|n| *n == name)
                .and_then(|place| self.values.get(place).copied()?)
        };
        evaluate(&expr, &lookup).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PointPlace, read, templates};
    use hodograph_base::number::decimal::Certain;
    use hodograph_base::number::{Ball, Big, Dd, within};

    /// Every given number of every template: the reader's value is within its error bound of the
    /// written one.
    #[test]
    fn values_are_within_their_radius_of_what_is_written() {
        let mut checked = 0;
        for template in templates::list() {
            let name = template.name;
            let text = templates::get(name).unwrap();
            let scene = read(text).unwrap_or_else(|f| panic!("{name}: {f}")).value;
            within(300, || {
                let (exact, double) =
                    (Inputs::<Ball<Big>>::of(&scene), Inputs::<Ball<Dd>>::of(&scene));
                let mut check = |given: &GivenQuantity| {
                    let (x, d) = (exact.number(given), double.number(given));
                    let off = (x - Real::from_f64(given.value)).approx().abs();
                    // The centre of curvature of a law needs some fifty operations, with a few
                    // differences of nearly equal numbers.
                    let [plain, exact] =
                        if given.text.contains("cam1_k") { [1e-12, 1e-25] } else { [1e-14, 0.0] };
                    assert!(
                        off <= given.radius && given.radius <= plain * given.value.abs(),
                        "{name}: {given:?} is off by {off:e}"
                    );
                    assert!(
                        d.enclosure().unwrap().meets(&x.enclosure().unwrap()),
                        "{name}: {given:?}"
                    );
                    // The law of a cam and a cosine need a dozen operations each; other written
                    // expressions need two or three.
                    let kept = if given.text.contains("cam1_")
                        || given.text.contains("cos(")
                        || given.text.contains("sin(")
                    {
                        2e-28
                    } else {
                        1e-29
                    };
                    let kept = exact.max(kept);
                    assert!(
                        d.radius() <= kept * given.value.abs(),
                        "{name}: {given:?} has a radius of {:e}",
                        d.radius()
                    );
                    checked += 1;
                };
                scene.lengths.iter().for_each(|l| check(&l.value));
                scene.drivers.iter().for_each(|d| check(&d.rate));
                for p in &scene.points {
                    if let PointPlace::At(xy) | PointPlace::InLink { xy, .. } = &p.place {
                        xy.iter().for_each(&mut check);
                    }
                }
            });
        }
        assert!(checked > 200, "{checked}");
    }

    /// Expressions with extreme numbers: the value is within its bound of the true value, the bound
    /// is small, and every precision encloses the true value.
    #[test]
    fn absurd_expressions_are_read_as_they_are_written() {
        let lost = [
            "1e20 mm + 5 mm - 1e20 mm",
            "(1e60 - 1e60 + 3)/7*1 m",
            "sin(1e22 deg + 30 deg)*1 m",
            "cos(1e25 rad)*1 m",
        ];
        let plain = [
            "(1.0000000001^1e10)*1 m",
            "2^0.5*1e-60 km",
            "sqrt(2)^60.5*1 mm",
            "atan(1e-40)*1 m",
            "(9.99^-60)*1 in",
            "x*1e-70*1 m",
        ];
        let more = [
            "(1 + 1e-70 - 1)*1e70*1 m",
            "0.1 m*3 - 0.3 m + 1e-30 m",
            "acos(1 - 1e-40)*1 m",
            "x - x + 7 mm*x/x",
            "tan(90 deg - 1e-20 deg)*1 m",
        ];
        for text in lost.into_iter().chain(plain).chain(more) {
            let scene = format!(
                r#"{{"parameters": {{"x": "1e80/3", "l": "{text}"}}, "units": {{"length": "m"}}, "links": {{"1": ["A", "B"], "2": ["A"]}}, "ground": "2",
                "points": {{"A": [0, 0]}}, "lengths": {{"AB": "abs(l) + 1 m"}}, "driver": {{"link": "1", "angle": "0 deg", "omega": "1 rad/s"}}, "find": ["v_B"]}}"#
            );
            // `x*…` is a pure number times a length only if x is one; a refused expression gives no
            // wrong number.
            let Ok(scene) = read(&scene) else { continue };
            let (_, given) = &scene.value.parameters[1];
            let truth =
                within(3000, || Inputs::<Ball<Big>>::of(&scene.value).number(given).enclosure());
            let Some(truth) = truth else { panic!("{text} has no value in 3000 bits") };
            let off = (truth.approx - given.value).abs();
            assert!(off <= given.radius + truth.radius, "{text}: {given:?}, it is {truth:?}");
            assert!(given.radius <= 1e-12 * given.value.abs(), "{text}: {given:?}");
            let seen = [
                Inputs::<Ball<f64>>::of(&scene.value).number(given).enclosure(),
                Inputs::<Ball<Dd>>::of(&scene.value).number(given).enclosure(),
                within(192, || Inputs::<Ball<Big>>::of(&scene.value).number(given).enclosure()),
                within(768, || Inputs::<Ball<Big>>::of(&scene.value).number(given).enclosure()),
            ];
            for (rung, seen) in seen.into_iter().enumerate() {
                assert!(
                    seen.as_ref().is_none_or(|s| s.meets(&truth)),
                    "{text}, rung {rung}: {seen:?}, it is {truth:?}"
                );
            }
        }
    }
}
