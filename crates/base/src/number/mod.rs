//! Numbers of several precisions behind one small trait: one formula to review, used on every level
//! of the precision ladder.
//!
//! A formula over [`Real`] runs in `f64` (figures, sweeps), in `f32` (to show the cost of short
//! numbers), and in types that know their error. This module contains the differences between the
//! types, and no formula of the computations.
//!
//! The trait has no comparison, since a ball has no order. Code decides by [`Real::approx`], the
//! nearest `f64`, and states why that suffices.

pub mod ball;
mod big;
mod dd;
pub mod decimal;
mod float;
pub mod jet;
mod taped;
#[cfg(test)]
mod turns;

pub use ball::Ball;
pub use big::{Big, RegionCopy, within};
pub use dd::Dd;
pub use jet::Jet;
pub use taped::{Slopes, Tape, Taped};

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A type with addition and multiplication: all that vectors need of their components.
pub trait Ring:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
}

impl<T: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>>
    Ring for T
{
}

/// A number for the formulas of positions and motions.
///
/// Values are `Copy`, so that formulas read as on paper. An operation without a value (a root of a
/// surely negative number, a quotient by a number that may be zero) gives an *undecided* number,
/// for which [`Real::is_decided`] is false and stays false.
pub trait Real: Ring + Debug + PartialEq + Div<Output = Self> {
    /// Converts a number exactly: every binary fraction is exact in every type but `f32`.
    fn from_f64(x: f64) -> Self;

    /// Returns a number from an `f64` value and a bound of its error; `None` if the type can do
    /// better and needs the number as written.
    fn from_bounded(value: f64, error: f64) -> Option<Self>;

    /// Returns the value of a decimal as written, such as `0.1`, `1e-3` or `12.`: the nearest value
    /// of the type, with the rounding error if the type keeps account of it. The grammar of scenes
    /// accepts the text as a number.
    fn from_decimal(text: &str) -> Self;

    /// Returns the nearest `f64`; NaN if undecided.
    fn approx(self) -> f64;

    /// Returns true if the number has a value: finite, and with a finite error if the type knows
    /// it.
    fn is_decided(self) -> bool;

    /// Returns true if the type keeps account of its own rounding.
    fn knows_its_error() -> bool {
        false
    }

    /// Returns true if the type holds more digits than `f64` or knows its error, so that an `f64`
    /// solution of an equation must be refined in it.
    fn refines() -> bool {
        true
    }

    /// Returns the number without its error.
    fn mid(self) -> Self {
        self
    }

    /// Returns a bound of the error; 0 if the type keeps no account of it.
    fn radius(self) -> f64 {
        0.0
    }

    /// Returns the number with its error increased by `by`; unchanged if the type keeps no account
    /// of it.
    fn widened(self, _by: f64) -> Self {
        self
    }

    /// Returns the square root. If rounding alone may make the number zero or negative, the result
    /// is a root that encloses zero.
    fn sqrt(self) -> Self;

    /// Returns the square root of a value that is negative by rounding at most: plain numbers take
    /// a negative value as zero.
    fn sqrt_or_zero(self) -> Self {
        self.sqrt()
    }

    /// Returns true if the number is negative whatever its rounding. Plain numbers are never sure.
    fn is_surely_negative(self) -> bool {
        false
    }

    /// Returns the number without the sign of its midpoint.
    fn magnitude(self) -> Self {
        if self.approx() < 0.0 { -self } else { self }
    }

    /// Returns √(x² + y²).
    fn hypot(self, y: Self) -> Self;

    /// Returns (sin, cos) of an angle in radians.
    fn sin_cos(self) -> (Self, Self);

    /// Returns (sin, cos) of an angle in degrees; exact at the multiples of 30° and 90° with an
    /// exact value.
    fn sin_cos_degrees(self) -> (Self, Self);

    /// Returns the angle of the vector (x, y) = (`x`, `self`), in (−π, π].
    fn atan2(self, x: Self) -> Self;

    /// Returns `self` to the power of `exponent`.
    fn pow(self, exponent: Self) -> Self;

    /// Returns the natural logarithm; undecided unless the number is surely positive.
    fn ln(self) -> Self;

    /// Returns e to this power.
    fn exp(self) -> Self;

    /// Returns π.
    fn pi() -> Self;
}

/// Returns (sin, cos) turned by quarter turns; zeros have no sign.
fn quarter_turns<N: Real>(quarters: f64, s: N, c: N) -> (N, N) {
    let plain = |x: N| if x.approx() == 0.0 && x.radius() == 0.0 { N::from_f64(0.0) } else { x };
    let (s, c) = match (quarters as i64).rem_euclid(4) {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    };
    (plain(s), plain(c))
}

/// Returns a power with a whole exponent of at most 64, by multiplication; `None` for other
/// exponents.
fn whole_power<N: Real>(base: N, exponent: N) -> Option<N> {
    let e = exponent.approx();
    if libm::rint(e) != e
        || e.abs() > 64.0
        || exponent.radius() != 0.0
        || exponent != N::from_f64(e)
    {
        return None;
    }
    let mut power = N::from_f64(1.0);
    for _ in 0..e.abs() as u32 {
        power = power * base;
    }
    Some(if e < 0.0 { N::from_f64(1.0) / power } else { power })
}
