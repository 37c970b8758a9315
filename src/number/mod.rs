//! Numbers of several precisions behind one small trait: one formula to review, run in every rung of the precision ladder.
//!
//! A formula that is written over [`Real`] runs in `f64` (figures, sweeps), in `f32` (to show what it costs), and in types
//! that know how wrong they are. What differs from one type to the next is decided here; what is computed is not.
//!
//! No comparison is in the trait: a ball has no order. Code decides by [`Real::approx`], the nearest `f64`, and says why
//! that suffices.

mod float;

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number that the formulas of positions and motions are written over.
///
/// Values are `Copy`, so that formulas read as on paper. An operation without a value (a root of what is surely negative,
/// a quotient by what may be zero) gives an *undecided* number, for which [`Real::is_decided`] is false and stays false.
pub trait Real:
    Copy + Debug + PartialEq + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
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

    /// The square root. Where the number may be zero or less by its rounding only, a root that encloses zero.
    fn sqrt(self) -> Self;

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

    /// π.
    fn pi() -> Self;
}
