//! Numbers that carry their error: a midpoint and a radius that surely enclose the true number.
//!
//! Rounding is to nearest throughout. Every operation adds a bound of its own rounding error, and
//! the radius itself is inflated by a little more than its rounding error; an operation that may
//! leave its domain gives an undecided ball. The midpoint of a ball equals the plain computation in
//! its type, bit for bit, except for powers.
//!
//! # Source
//! A. Neumaier, *Interval Methods for Systems of Equations* (1990), ch. 1; J. van der Hoeven, *Ball
//! arithmetic* (2009).

use super::{Big, Dd, Real, big};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// All numbers within `radius` of `mid`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball<M> {
    mid: M,
    radius: f64,
}

/// A midpoint: a number type with bounded rounding errors.
pub trait Middle: Real {
    /// Returns a bound of the relative error of + − × ÷ √.
    fn unit() -> f64;
    /// Returns a bound of the relative error of sin, cos, atan2, hypot and fractional powers; for
    /// sin and cos also of the absolute error of reducing an angle of one radian.
    fn elementary() -> f64;
    /// Returns true if the number is exactly an integer multiple of `d` (a whole number).
    fn is_multiple_of(self, d: f64) -> bool;
}

impl Middle for f64 {
    fn unit() -> f64 {
        f64::EPSILON / 2.0
    }
    fn elementary() -> f64 {
        // libm's functions are within one unit in the last place (2u); the conversion of degrees to
        // radians before them rounds three times.
        4.0 * f64::EPSILON
    }
    fn is_multiple_of(self, d: f64) -> bool {
        libm::fmod(self, d) == 0.0
    }
}

impl Middle for Dd {
    fn unit() -> f64 {
        // The algorithms are proved to 15 u² at worst; doubled for the division, which is a
        // variant.
        32.0 * (f64::EPSILON / 2.0) * (f64::EPSILON / 2.0)
    }
    fn elementary() -> f64 {
        // Some fifty operations in the series, doubled four times: 4 000 u², and as much again in
        // reserve.
        8192.0 * (f64::EPSILON / 2.0) * (f64::EPSILON / 2.0)
    }
    fn is_multiple_of(self, d: f64) -> bool {
        let (hi, lo) = self.parts();
        lo == 0.0 && libm::fmod(hi, d) == 0.0
    }
}

impl Middle for Big {
    fn unit() -> f64 {
        libm::exp2(1.0 - big::bits() as f64)
    }
    fn elementary() -> f64 {
        libm::exp2(6.0 - big::bits() as f64)
    }
    fn is_multiple_of(self, d: f64) -> bool {
        self == Big::from_f64(self.approx()) && libm::fmod(self.approx(), d) == 0.0
    }
}

/// The largest `f64`: zero is the only multiple of it among the numbers of a scene.
const ONLY_ZERO: f64 = f64::MAX;

/// The radius is computed in `f64`: some ten operations, each with 2^-53, and as much again in
/// reserve.
const INFLATE: f64 = 1.0 + 4e-15;

/// More than any underflow of `f64` can lose, and large enough that products with it stay normal
/// numbers.
const TINY: f64 = 1e-290;

impl<M: Middle> Ball<M> {
    /// Returns the number itself, without error.
    pub fn exact(mid: M) -> Self {
        Ball { mid, radius: 0.0 }
    }

    /// Returns the ball of all numbers within `radius` of `mid`.
    pub fn new(mid: M, radius: f64) -> Self {
        Ball { mid, radius }
    }

    /// Returns the midpoint.
    pub fn middle(self) -> M {
        self.mid
    }

    fn undecided() -> Self {
        Ball { mid: M::from_f64(f64::NAN), radius: f64::INFINITY }
    }

    /// Returns true if the ball contains zero.
    pub fn contains_zero(self) -> bool {
        // Undecided balls contain everything.
        let surely_off = self.mid.approx().abs() * (1.0 - 1e-15) > self.radius;
        !surely_off
    }

    /// Returns true if the number is exactly zero: sums and products with it are exact.
    #[inline]
    fn is_nil(self) -> bool {
        self.radius == 0.0 && self.mid.approx() == 0.0
    }

    #[inline]
    fn rounded(mid: M, propagated: f64) -> Self {
        Ball { mid, radius: (propagated + mid.approx().abs() * M::unit()) * INFLATE + TINY }
    }

    fn elementary(mid: M, propagated: f64) -> Self {
        Ball { mid, radius: (propagated + mid.approx().abs() * M::elementary()) * INFLATE + TINY }
    }
}

impl<M: Middle> Add for Ball<M> {
    type Output = Self;
    #[inline]
    fn add(self, o: Self) -> Self {
        if o.is_nil() {
            return self;
        }
        if self.is_nil() {
            return o;
        }
        Self::rounded(self.mid + o.mid, self.radius + o.radius)
    }
}
impl<M: Middle> Sub for Ball<M> {
    type Output = Self;
    #[inline]
    fn sub(self, o: Self) -> Self {
        if o.is_nil() {
            return self;
        }
        if self.is_nil() {
            return -o;
        }
        Self::rounded(self.mid - o.mid, self.radius + o.radius)
    }
}
impl<M: Middle> Neg for Ball<M> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Ball { mid: -self.mid, radius: self.radius }
    }
}
impl<M: Middle> Mul for Ball<M> {
    type Output = Self;
    #[inline]
    fn mul(self, o: Self) -> Self {
        let (a, b) = (self.mid.approx().abs(), o.mid.approx().abs());
        if (self.is_nil() && o.is_decided()) || (o.is_nil() && self.is_decided()) {
            return Ball::exact(self.mid * o.mid);
        }
        Self::rounded(self.mid * o.mid, (a + self.radius) * o.radius + b * self.radius)
    }
}
impl<M: Middle> Div for Ball<M> {
    type Output = Self;
    #[inline]
    fn div(self, o: Self) -> Self {
        // |a/b − A/B| ≤ (ra + |A/B| rb) / (|B| − rb)
        let mid = self.mid / o.mid;
        let room = o.mid.approx().abs() * (1.0 - 1e-15) - o.radius;
        let propagated = (self.radius + mid.approx().abs() * o.radius) / room;
        if self.is_nil() && room > 0.0 && o.is_decided() {
            return Ball::exact(mid);
        }
        if room > 0.0 && propagated.is_finite() {
            Self::rounded(mid, propagated)
        } else {
            Self::undecided()
        }
    }
}

impl<M: Middle> Real for Ball<M> {
    fn from_f64(x: f64) -> Self {
        Ball { mid: M::from_f64(x), radius: 0.0 }
    }

    fn from_bounded(value: f64, error: f64) -> Option<Self> {
        M::from_bounded(value, error).map(|mid| Ball { mid, radius: error })
    }

    fn from_decimal(text: &str) -> Self {
        // The midpoint of an f64 ball is the nearest f64, which its parser finds; longer numbers
        // are read digit by digit.
        match M::from_bounded(0.0, 0.0) {
            Some(_) => {
                let mid = M::from_decimal(text);
                let whole = text.len() <= 15 && text.bytes().all(|b| b.is_ascii_digit());
                Ball {
                    mid,
                    radius: if whole {
                        0.0
                    } else {
                        mid.approx().abs() * M::unit() * INFLATE + TINY
                    },
                }
            }
            None => super::decimal::by_digits(text),
        }
    }

    fn approx(self) -> f64 {
        self.mid.approx()
    }

    fn is_decided(self) -> bool {
        self.mid.is_decided() && self.radius.is_finite()
    }

    fn knows_its_error() -> bool {
        true
    }

    fn is_surely_negative(self) -> bool {
        self.mid.approx() < 0.0 && !self.contains_zero()
    }

    fn mid(self) -> Self {
        Ball { radius: 0.0, ..self }
    }

    fn radius(self) -> f64 {
        self.radius
    }

    fn widened(self, by: f64) -> Self {
        Ball { radius: (self.radius + by) * INFLATE, ..self }
    }

    fn sqrt(self) -> Self {
        if self.is_nil() {
            return self;
        }
        let m = self.mid.approx();
        if self.contains_zero() {
            // All numbers from zero to the root of the upper end.
            let upper = (m + self.radius) * (1.0 + 1e-15);
            if upper.is_nan() || upper < 0.0 || upper.is_infinite() {
                return Self::undecided();
            }
            let half = upper.sqrt() * 0.5 * INFLATE;
            return Ball { mid: M::from_f64(half), radius: half * INFLATE + TINY };
        }
        if m < 0.0 {
            return Self::undecided();
        }
        // |√x − √m| = |x − m| / (√x + √m), and 1/(1 + √(1−t)) ≤ (1 + t)/2.
        let mid = self.mid.sqrt();
        let t = self.radius / m;
        Self::rounded(mid, self.radius / mid.approx() * 0.5 * (1.0 + t))
    }

    fn hypot(self, y: Self) -> Self {
        if self.is_nil() && y.is_nil() {
            return Ball::exact(M::from_f64(0.0));
        }
        Self::elementary(self.mid.hypot(y.mid), self.radius + y.radius)
    }

    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.mid.sin_cos();
        if self.radius == 0.0 && self.mid.is_multiple_of(ONLY_ZERO) {
            return (Ball::exact(s), Ball::exact(c));
        }
        // The reduction of a large angle loses digits in proportion to the angle.
        let propagated = self.radius + self.mid.approx().abs() * M::elementary();
        (Self::elementary(s, propagated), Self::elementary(c, propagated))
    }

    fn sin_cos_degrees(self) -> (Self, Self) {
        let (s, c) = self.mid.sin_cos_degrees();
        if self.radius == 0.0 && self.mid.is_multiple_of(90.0) {
            return (Ball::exact(s), Ball::exact(c));
        }
        let known = |x: M| {
            if self.radius == 0.0 && self.mid.is_multiple_of(30.0) && x.approx().abs() == 0.5 {
                0.0
            } else {
                1.0
            }
        };
        let propagated = self.radius * 0.017_453_292_519_943_3;
        let of = |x: M| {
            let ball = Self::elementary(x, propagated);
            Ball { radius: ball.radius * known(x), ..ball }
        };
        (of(s), of(c))
    }

    fn atan2(self, x: Self) -> Self {
        let room = libm::hypot(self.mid.approx(), x.mid.approx()) * (1.0 - 1e-14)
            - (self.radius + x.radius);
        if room.is_nan() || room <= 0.0 {
            return Self::undecided();
        }
        Self::elementary(self.mid.atan2(x.mid), (self.radius + x.radius) / room)
    }

    fn pow(self, exponent: Self) -> Self {
        if exponent.radius == 0.0
            && let Some(power) = super::whole_power(self, exponent)
        {
            return power;
        }
        let (m, e) = (self.mid.approx(), exponent.mid.approx());
        let mid = self.mid.pow(exponent.mid);
        let room = m - self.radius;
        if room.is_nan() || room <= 0.0 || !mid.is_decided() {
            return Self::undecided();
        }
        // d(x^y) = x^y (y dx/x + ln x dy); twice the first order covers the second order if the
        // relative change is small.
        let change = (e.abs() * self.radius + self.radius * exponent.radius) / room
            + libm::log(room).abs().max(libm::log(m).abs()) * exponent.radius;
        if change.is_nan() || change >= 0.1 {
            return Self::undecided();
        }
        Self::elementary(mid, 2.0 * change * mid.approx().abs())
    }

    fn ln(self) -> Self {
        let room = self.mid.approx() - self.radius;
        let mid = self.mid.ln();
        if room.is_nan() || room <= 0.0 || !mid.is_decided() {
            return Self::undecided();
        }
        Self::elementary(mid, self.radius / room)
    }

    fn exp(self) -> Self {
        let mid = self.mid.exp();
        if !mid.is_decided() || self.radius.is_nan() || self.radius >= 0.1 {
            return Self::undecided();
        }
        // e^r − 1 < 2r for these r.
        Self::elementary(mid, 2.0 * self.radius * mid.approx())
    }

    fn pi() -> Self {
        Self::rounded(M::pi(), 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A driver at rest surely moves nothing; an underflow is not surely zero.
    #[test]
    fn zeros_stay_exact() {
        let nil = Ball::<f64>::exact(0.0);
        let some = Ball::new(3.0, 1e-9);
        let zeros = [
            nil * some,
            some * nil,
            nil / some,
            nil.sqrt(),
            nil.hypot(nil),
            nil + nil,
            nil - nil,
            -nil,
        ];
        assert!(zeros.iter().all(|z| z.is_nil()), "{zeros:?}");
        assert_eq!((some + nil, nil - some), (some, -some));
        let tiny = Ball::exact(1e-200);
        assert!((tiny * tiny).contains_zero() && !(tiny * tiny).is_nil());
        assert!(
            !(nil * Ball::new(1.0, f64::INFINITY)).is_nil()
                && !(nil / Ball::new(0.0, 1.0)).is_decided()
        );
    }

    /// Every operation on random numbers, some of them nearly equal, encloses the result of 300-bit
    /// arithmetic.
    #[test]
    fn balls_contain_the_truth() {
        use crate::number::decimal::{Certain, Enclosure};
        use crate::number::within;

        fn all<N: Real>(a: f64, b: f64) -> Vec<N> {
            let (x, y) = (N::from_f64(a), N::from_f64(b));
            let (s, c) = x.sin_cos();
            let (sd, cd) = (x * N::from_f64(57.0)).sin_cos_degrees();
            let needle = (x + y) * (x + y) - (x * x + y * y);
            vec![
                x + y,
                x - y,
                x * y,
                x / y,
                (x * x).sqrt(),
                x.hypot(y),
                x.atan2(y),
                s,
                c,
                sd,
                cd,
                needle,
                x.pow(N::from_f64(3.0)),
                N::pi() * x,
            ]
        }
        fn enclosures<N: Certain>(a: f64, b: f64) -> Vec<Option<Enclosure>> {
            all::<N>(a, b).into_iter().map(Certain::enclosure).collect()
        }
        let mut state = 0x9e37_79b9_7f4a_7c15u64;
        let mut random = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 11) as f64 / (1u64 << 53) as f64 * 4.0 - 2.0
        };
        for i in 0..400 {
            let a = random();
            // Every other pair differs in its last bits only.
            let b = if i % 2 == 0 { random() } else { -a * (1.0 + 1e-13 * random()) };
            within(300, || {
                let truth = enclosures::<Ball<Big>>(a, b);
                for (kind, seen) in [
                    ("f64", enclosures::<Ball<f64>>(a, b)),
                    ("double-double", enclosures::<Ball<Dd>>(a, b)),
                ] {
                    for (k, (s, t)) in seen.iter().zip(&truth).enumerate() {
                        let (Some(s), Some(t)) = (s, t) else {
                            panic!("{kind}: operation {k} on {a:e}, {b:e} is undecided")
                        };
                        assert!(
                            s.meets(t),
                            "{kind}: operation {k} on {a:e}, {b:e}: {s:?} does not contain {t:?}"
                        );
                        assert!(
                            s.radius <= 1e-12 * (1.0 + s.approx.abs()),
                            "{kind}: operation {k} on {a:e}, {b:e} is wide: {s:?}"
                        );
                    }
                }
            });
        }
    }
}
