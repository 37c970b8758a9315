//! Numbers that record the operations from which they come, so that the derivatives of a result by
//! all variables follow in one pass backwards through the record (reverse accumulation).
//!
//! Values are those of `f64`, to the last bit; decisions depend on the value alone. A [`Jet`] has
//! the derivatives by one variable; the cost of a [`Taped`] number does not depend on the number of
//! variables.
//!
//! [`Jet`]: super::Jet
//!
//! # Source
//! A. Griewank, A. Walther, *Evaluating Derivatives*, 2nd ed., ch. 3.

use super::Real;
use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The record of a computation.
#[derive(Debug, Default)]
pub struct Tape(RefCell<Vec<TapeStep>>);

/// Up to two earlier numbers that a number depends on, by their place on the tape, each with the
/// derivative by it; a derivative of zero stands for no number.
type TapeStep = [(usize, f64); 2];

const NO_NUMBER: (usize, f64) = (0, 0.0);

impl Tape {
    /// Returns a new variable.
    pub fn variable(&self, value: f64) -> Taped<'_> {
        self.recorded(value, [NO_NUMBER; 2])
    }

    fn recorded(&self, value: f64, step: TapeStep) -> Taped<'_> {
        let mut steps = self.0.borrow_mut();
        steps.push(step);
        Taped { value, origin: Some((self, steps.len() - 1)) }
    }
}

/// A number computed from the variables of a tape, or a constant.
#[derive(Clone, Copy, Debug)]
pub struct Taped<'a> {
    value: f64,
    /// The tape and the place on it; `None` for a constant.
    origin: Option<(&'a Tape, usize)>,
}

/// The derivatives of a number by all numbers of its tape.
#[derive(Clone, Debug)]
pub struct Slopes(Vec<f64>);

impl Slopes {
    /// Returns the derivative by a number of the same tape; zero by a constant.
    pub fn by(&self, x: Taped) -> f64 {
        x.origin.and_then(|(_, place)| self.0.get(place)).copied().unwrap_or(0.0)
    }
}

impl<'a> Taped<'a> {
    fn constant(value: f64) -> Self {
        Taped { value, origin: None }
    }

    /// Returns a function of one number: its value, and its derivative there.
    fn of(self, value: f64, slope: f64) -> Self {
        match self.origin {
            Some((tape, x)) => tape.recorded(value, [(x, slope), NO_NUMBER]),
            None => Taped::constant(value),
        }
    }

    /// Returns a function of two numbers: its value, and its derivatives there.
    fn with(self, o: Self, value: f64, slopes: [f64; 2]) -> Self {
        match (self.origin, o.origin) {
            (Some((tape, x)), Some((_, y))) => {
                tape.recorded(value, [(x, slopes[0]), (y, slopes[1])])
            }
            (Some(_), None) => self.of(value, slopes[0]),
            (None, _) => o.of(value, slopes[1]),
        }
    }

    /// Returns the derivatives by all numbers of the tape.
    pub fn slopes(self) -> Slopes {
        let Some((tape, last)) = self.origin else { return Slopes(Vec::new()) };
        let mut all = vec![0.0; last + 1];
        all[last] = 1.0;
        for (place, step) in tape.0.borrow()[..=last].iter().enumerate().rev() {
            let here = all[place];
            if here != 0.0 {
                for (x, slope) in step.iter().filter(|(_, slope)| *slope != 0.0) {
                    all[*x] += here * slope;
                }
            }
        }
        Slopes(all)
    }
}

impl PartialEq for Taped<'_> {
    fn eq(&self, o: &Self) -> bool {
        self.value == o.value
    }
}

impl Add for Taped<'_> {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        self.with(o, self.value + o.value, [1.0, 1.0])
    }
}

impl Sub for Taped<'_> {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        self.with(o, self.value - o.value, [1.0, -1.0])
    }
}

impl Neg for Taped<'_> {
    type Output = Self;
    fn neg(self) -> Self {
        self.of(-self.value, -1.0)
    }
}

impl Mul for Taped<'_> {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        self.with(o, self.value * o.value, [o.value, self.value])
    }
}

impl Div for Taped<'_> {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let quotient = self.value / o.value;
        self.with(o, quotient, [1.0 / o.value, -quotient / o.value])
    }
}

impl Real for Taped<'_> {
    fn from_f64(x: f64) -> Self {
        Taped::constant(x)
    }

    fn from_bounded(value: f64, error: f64) -> Option<Self> {
        f64::from_bounded(value, error).map(Taped::constant)
    }

    fn from_decimal(text: &str) -> Self {
        Taped::constant(f64::from_decimal(text))
    }

    fn approx(self) -> f64 {
        self.value
    }

    fn is_decided(self) -> bool {
        self.value.is_decided()
    }

    fn refines() -> bool {
        f64::refines()
    }

    fn sqrt(self) -> Self {
        let root = Real::sqrt(self.value);
        self.of(root, 0.5 / root)
    }

    fn sqrt_or_zero(self) -> Self {
        if self.value > 0.0 { self.sqrt() } else { Taped::constant(0.0) }
    }

    /// At the origin the derivatives are zero, the mean of those on opposite sides.
    fn hypot(self, y: Self) -> Self {
        let length = Real::hypot(self.value, y.value);
        let part = |x: f64| if length == 0.0 { 0.0 } else { x / length };
        self.with(y, length, [part(self.value), part(y.value)])
    }

    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = Real::sin_cos(self.value);
        (self.of(s, c), self.of(c, -s))
    }

    fn sin_cos_degrees(self) -> (Self, Self) {
        let (s, c) = self.value.sin_cos_degrees();
        let one = f64::pi() / 180.0;
        (self.of(s, c * one), self.of(c, -s * one))
    }

    fn atan2(self, x: Self) -> Self {
        let square = self.value * self.value + x.value * x.value;
        self.with(x, Real::atan2(self.value, x.value), [x.value / square, -self.value / square])
    }

    fn pow(self, exponent: Self) -> Self {
        let power = self.value.pow(exponent.value);
        let by_base = if exponent.value == 0.0 {
            0.0
        } else {
            exponent.value * self.value.pow(exponent.value - 1.0)
        };
        let by_exponent = if power == 0.0 { 0.0 } else { power * Real::ln(self.value) };
        self.with(exponent, power, [by_base, by_exponent])
    }

    fn ln(self) -> Self {
        self.of(Real::ln(self.value), 1.0 / self.value)
    }

    fn exp(self) -> Self {
        let power = Real::exp(self.value);
        self.of(power, power)
    }

    fn pi() -> Self {
        Taped::constant(f64::pi())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Jet;

    type F<N> = fn(N, N) -> N;

    fn all<N: Real>() -> [F<N>; 14] {
        [
            |x, y| x * y + x,
            |x, y| x - N::from_f64(2.0) / y + y * N::from_f64(3.0),
            |x, y| -(x * x / y),
            |x, y| (x + y).sqrt(),
            |x, y| (x * y).sqrt_or_zero(),
            |x, y| x.hypot(y * x),
            |x, _| x.hypot(N::from_f64(1.5)),
            |x, y| (x * y).sin_cos().0,
            |x, y| (x - y).sin_cos().1,
            |x, y| (x * N::from_f64(20.0)).sin_cos_degrees().0 * y.sin_cos_degrees().1,
            |x, y| x.atan2(y * y),
            |x, y| x.pow(N::from_f64(-3.0)) + y.pow(N::from_f64(2.0)) + (x * y).ln(),
            |x, y| x.pow(y),
            |x, y| x.exp() * N::pi() + N::from_decimal("0.5") * y,
        ]
    }

    /// Jets differentiate by other rules, by one variable at a time.
    #[test]
    fn slopes_are_those_of_jets() {
        let tape = Tape::default();
        for (k, ((taped, jet), plain)) in
            all::<Taped>().iter().zip(all::<Jet<f64>>()).zip(all::<f64>()).enumerate()
        {
            let (x, y) = (tape.variable(0.7), tape.variable(0.9));
            let value = taped(x, y);
            assert_eq!(value.approx(), plain(0.7, 0.9), "{k}");
            let slopes = value.slopes();
            let (constant, variable) = (Jet::<f64>::from_f64, Jet::<f64>::variable);
            let by_x = jet(variable(0.7), constant(0.9)).0[1];
            let by_y = jet(constant(0.7), variable(0.9)).0[1];
            assert!((slopes.by(x) - by_x).abs() < 1e-13 * (1.0 + by_x.abs()), "{k}: x {by_x}");
            assert!((slopes.by(y) - by_y).abs() < 1e-13 * (1.0 + by_y.abs()), "{k}: y {by_y}");
        }
    }

    #[test]
    fn constants_have_no_slopes() {
        let tape = Tape::default();
        let (x, two) = (tape.variable(3.0), Taped::from_f64(2.0));
        assert_eq!((x * two).slopes().by(two), 0.0);
        assert_eq!((two * two).slopes().by(x), 0.0);
        // Two ways from the variable to the result: x and x². A later number has no part in it.
        let sum = x + x * x;
        let later = sum * x;
        assert_eq!((sum.slopes().by(x), sum.slopes().by(later)), (7.0, 0.0));
    }

    #[test]
    fn a_length_of_zero_has_no_direction() {
        let tape = Tape::default();
        let (x, y) = (tape.variable(0.0), tape.variable(0.0));
        let slopes = x.hypot(y).slopes();
        assert_eq!([slopes.by(x), slopes.by(y)], [0.0, 0.0]);
    }
}
