//! Double-double: an unevaluated sum of two `f64`, 106 bits.
//!
//! No fused multiply-add: products are split, so that every machine gives the same bits.
//!
//! # Source
//! M. Joldes, J.-M. Muller, V. Popescu, *Tight and rigorous error bounds for basic building blocks
//! of double-word arithmetic*, ACM TOMS 44 (2017): algorithms 6, 11, 18; T. J. Dekker, Numer. Math.
//! 18 (1971) for the split product.

use super::Real;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// hi + lo with |lo| at most half a unit in the last place of hi.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dd {
    hi: f64,
    lo: f64,
}

/// a + b = s + e exactly.
#[inline]
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let t = s - a;
    (s, (a - (s - t)) + (b - t))
}

/// Returns a + b exactly, for |a| ≥ |b|.
#[inline]
fn fast_two_sum(a: f64, b: f64) -> Dd {
    let s = a + b;
    Dd { hi: s, lo: b - (s - a) }
}

/// Splits a number into its upper 26 bits and the rest (Veltkamp).
#[inline]
fn split(a: f64) -> (f64, f64) {
    const SPLITTER: f64 = 134_217_729.0; // 2^27 + 1
    let t = SPLITTER * a;
    let hi = t - (t - a);
    (hi, a - hi)
}

/// a b = p + e exactly.
#[inline]
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    let ((ah, al), (bh, bl)) = (split(a), split(b));
    (p, ((ah * bh - p) + ah * bl + al * bh) + al * bl)
}

impl Dd {
    /// Returns a + b, exactly.
    pub fn sum(a: f64, b: f64) -> Dd {
        let (hi, lo) = two_sum(a, b);
        Dd { hi, lo }
    }

    /// Returns the two parts, the larger first; their sum is the number.
    pub fn parts(self) -> (f64, f64) {
        (self.hi, self.lo)
    }

    const fn of(hi: f64, lo: f64) -> Dd {
        Dd { hi, lo }
    }

    /// Returns sin and cos of |x| ≤ π/4: the series at x/16, doubled four times.
    fn first_octants(x: Dd) -> (Dd, Dd) {
        let x = x * Dd::from_f64(0.0625);
        let x2 = x * x;
        let one = Dd::from_f64(1.0);
        // The next term, (π/64)^22/22!, is below 2^-170.
        let (mut sine, mut versine) = (one, Dd::from_f64(0.0));
        for k in (1..=10).rev() {
            sine = one - sine * x2 / Dd::from_f64(f64::from(2 * k * (2 * k + 1)));
        }
        for k in (1..=10).rev() {
            // 1 − cos x, without the 1: doubling keeps its digits.
            versine = (one - versine) * x2 / Dd::from_f64(f64::from(2 * k * (2 * k - 1)));
        }
        let mut s = x * sine;
        let mut v = versine;
        let two = Dd::from_f64(2.0);
        for _ in 0..4 {
            // sin 2x = 2 sin x cos x, 1 − cos 2x = 2 sin² x.
            (s, v) = (two * s * (one - v), two * s * s);
        }
        (s, one - v)
    }
}

impl From<f64> for Dd {
    fn from(x: f64) -> Dd {
        Dd::of(x, 0.0)
    }
}

impl Add for Dd {
    type Output = Dd;
    #[inline]
    fn add(self, o: Dd) -> Dd {
        let (sh, sl) = two_sum(self.hi, o.hi);
        let (th, tl) = two_sum(self.lo, o.lo);
        let v = fast_two_sum(sh, sl + th);
        fast_two_sum(v.hi, tl + v.lo)
    }
}
impl Neg for Dd {
    type Output = Dd;
    #[inline]
    fn neg(self) -> Dd {
        Dd::of(-self.hi, -self.lo)
    }
}
impl Sub for Dd {
    type Output = Dd;
    #[inline]
    fn sub(self, o: Dd) -> Dd {
        self + -o
    }
}
impl Mul for Dd {
    type Output = Dd;
    #[inline]
    fn mul(self, o: Dd) -> Dd {
        let (ch, cl) = two_product(self.hi, o.hi);
        let t = self.lo * o.lo;
        fast_two_sum(ch, cl + (t + self.hi * o.lo + self.lo * o.hi))
    }
}
impl Div for Dd {
    type Output = Dd;
    #[inline]
    fn div(self, o: Dd) -> Dd {
        let q = self.hi / o.hi;
        if !q.is_finite() {
            return Dd::of(f64::NAN, f64::NAN);
        }
        let rest = self - o * Dd::from_f64(q);
        fast_two_sum(q, rest.hi / o.hi)
    }
}

const PI: Dd = Dd::of(std::f64::consts::PI, 1.224_646_799_147_353_2e-16);
const HALF_PI: Dd = Dd::of(std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17);

/// Beyond 2^50 quarter turns (some 1e15 rad) the rounding error of x/(π/2), relative 2^-52,
/// approaches half a quarter.
const MOST_QUARTERS: f64 = 1_125_899_906_842_624.0;

impl Real for Dd {
    fn from_f64(x: f64) -> Dd {
        Dd::of(x, 0.0)
    }

    fn from_bounded(_value: f64, _error: f64) -> Option<Dd> {
        None
    }

    fn from_decimal(text: &str) -> Dd {
        super::decimal::by_digits(text)
    }

    fn approx(self) -> f64 {
        self.hi
    }

    fn is_decided(self) -> bool {
        self.hi.is_finite() && self.lo.is_finite()
    }

    fn sqrt(self) -> Dd {
        if self.hi == 0.0 {
            return self;
        }
        let s = self.hi.sqrt();
        let (p, e) = two_product(s, s);
        let rest = ((self.hi - p) - e) + self.lo;
        fast_two_sum(s, rest / (2.0 * s))
    }

    fn sqrt_or_zero(self) -> Dd {
        if self.hi <= 0.0 { Dd::from_f64(0.0) } else { self.sqrt() }
    }

    fn hypot(self, y: Dd) -> Dd {
        (self * self + y * y).sqrt()
    }

    fn sin_cos(self) -> (Dd, Dd) {
        let quarter = libm::rint(self.hi / HALF_PI.hi);
        // For more quarters the quotient does not determine the last ones.
        if quarter.abs() > MOST_QUARTERS {
            let nothing = Dd::of(f64::NAN, f64::NAN);
            return (nothing, nothing);
        }
        let (s, c) = Dd::first_octants(self - HALF_PI * Dd::from_f64(quarter));
        super::quarter_turns(quarter, s, c)
    }

    fn sin_cos_degrees(self) -> (Dd, Dd) {
        // Both remainders are exact, and so is their sum.
        let turn = Dd::sum(libm::fmod(self.hi, 360.0), libm::fmod(self.lo, 360.0));
        let quarter = libm::rint(turn.hi / 90.0);
        let rest = turn - Dd::from_f64(90.0 * quarter);
        let half = Dd::from_f64(0.5);
        let (s, c) = if rest.lo == 0.0 && rest.hi.abs() == 30.0 {
            (Dd::from_f64(0.5f64.copysign(rest.hi)), Dd::from_f64(3.0).sqrt() * half)
        } else if rest.lo == 0.0 && rest.hi.abs() == 45.0 {
            let root = Dd::from_f64(0.5).sqrt();
            (if rest.hi < 0.0 { -root } else { root }, root)
        } else {
            Dd::first_octants(rest * PI / Dd::from_f64(180.0))
        };
        super::quarter_turns(quarter, s, c)
    }

    fn atan2(self, x: Dd) -> Dd {
        let rough = libm::atan2(self.hi, x.hi);
        if !rough.is_finite() || (self.hi == 0.0 && x.hi == 0.0) {
            return Dd::of(f64::NAN, f64::NAN);
        }
        // The vector turned back by the approximate angle points along x within some 1e-16, where
        // tan t = t + t³/3.
        let (s, c) = Dd::from_f64(rough).sin_cos();
        let rest = (self * c - x * s) / (x * c + self * s);
        Dd::from_f64(rough) + rest - rest * rest * rest / Dd::from_f64(3.0)
    }

    fn pow(self, exponent: Dd) -> Dd {
        super::whole_power(self, exponent).unwrap_or(Dd::of(f64::NAN, f64::NAN))
    }

    // Undecided, as fractional powers are: a computation that needs the digits goes on to the next
    // level of the precision ladder.
    fn ln(self) -> Dd {
        Dd::of(f64::NAN, f64::NAN)
    }

    fn exp(self) -> Dd {
        Dd::of(f64::NAN, f64::NAN)
    }

    fn pi() -> Dd {
        PI
    }
}
