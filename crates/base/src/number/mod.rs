//! Numbers of several precisions behind one small trait: one formula to review, run in every rung of the precision ladder.
//!
//! A formula that is written over [`Real`] runs in `f64` (figures, sweeps), in `f32` (to show what it costs), and in types
//! that know how wrong they are. What differs from one type to the next is decided here; what is computed is not.
//!
//! No comparison is in the trait: a ball has no order. Code decides by [`Real::approx`], the nearest `f64`, and says why
//! that suffices.

pub mod ball;
mod big;
mod dd;
pub mod decimal;
mod float;
pub mod jet;
#[cfg(test)]
mod turns;

pub use ball::Ball;
pub use big::{Big, Kept, within};
pub use dd::Dd;
pub use jet::Jet;

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// What can be added and multiplied: all that vectors need of their components.
pub trait Ring: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self> {}

impl<T: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>> Ring for T {}

/// A number that the formulas of positions and motions are written over.
///
/// Values are `Copy`, so that formulas read as on paper. An operation without a value (a root of what is surely negative,
/// a quotient by what may be zero) gives an *undecided* number, for which [`Real::is_decided`] is false and stays false.
pub trait Real: Ring + Debug + PartialEq + Div<Output = Self> {
    /// The number itself: every binary fraction is exact in every type but `f32`.
    fn from_f64(x: f64) -> Self;

    /// A number of which an `f64` value and a bound of its error are known; `None` where the type can do better and wants
    /// the number as it was written.
    fn from_bounded(value: f64, error: f64) -> Option<Self>;

    /// The decimal as written, such as `0.1`, `1e-3` or `12.`: the nearest value of the type, with its rounding where
    /// the type keeps account of it. The text is one that the scene's grammar takes as a number.
    fn from_decimal(text: &str) -> Self;

    /// The nearest `f64`; NaN where undecided.
    fn approx(self) -> f64;

    /// Whether the number has a value: finite, and, where the type knows, with a finite error.
    fn is_decided(self) -> bool;

    /// Whether the type keeps account of its own rounding.
    fn knows_its_error() -> bool {
        false
    }

    /// Whether the type holds more digits than `f64` or knows its error, so that an `f64` solution of an equation is to be
    /// refined in it.
    fn refines() -> bool {
        true
    }

    /// The number without its error.
    fn mid(self) -> Self {
        self
    }

    /// A bound of the error; 0 where the type keeps no account of it.
    fn radius(self) -> f64 {
        0.0
    }

    /// The number with `by` more of error; the same where the type keeps no account of it.
    fn widened(self, _by: f64) -> Self {
        self
    }

    /// The square root. Where the number may be zero or less by its rounding only, a root that encloses zero.
    fn sqrt(self) -> Self;

    /// The square root of a value that is negative by rounding at most: plain numbers take a negative value for zero.
    fn sqrt_or_zero(self) -> Self {
        self.sqrt()
    }

    /// Whether the number is less than zero whatever its rounding. Plain numbers are never sure.
    fn is_surely_negative(self) -> bool {
        false
    }

    /// The number without its sign, which is that of its middle.
    fn magnitude(self) -> Self {
        if self.approx() < 0.0 { -self } else { self }
    }

    /// √(x² + y²).
    fn hypot(self, y: Self) -> Self;

    /// (sin, cos) of an angle in radians.
    fn sin_cos(self) -> (Self, Self);

    /// (sin, cos) of an angle in degrees; exact at the multiples of 30° and 90° where the true value is.
    fn sin_cos_degrees(self) -> (Self, Self);

    /// Angle of the vector (x, y) = (`x`, `self`), in (−π, π].
    fn atan2(self, x: Self) -> Self;

    /// `self` to the power of `exponent`.
    fn pow(self, exponent: Self) -> Self;

    /// The natural logarithm; undecided where it is not surely greater than zero.
    fn ln(self) -> Self;

    /// e to this power.
    fn exp(self) -> Self;

    /// π.
    fn pi() -> Self;
}

/// (sin, cos) turned by quarters of a full turn; zeros come out without a sign.
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

/// A power with a whole exponent of at most 64, by multiplication; `None` for others.
fn whole_power<N: Real>(base: N, exponent: N) -> Option<N> {
    let e = exponent.approx();
    if libm::rint(e) != e || e.abs() > 64.0 || exponent.radius() != 0.0 || exponent != N::from_f64(e) {
        return None;
    }
    let mut power = N::from_f64(1.0);
    for _ in 0..e.abs() as u32 {
        power = power * base;
    }
    Some(if e < 0.0 { N::from_f64(1.0) / power } else { power })
}
