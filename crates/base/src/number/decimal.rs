//! Decimal input and output: a literal to any number type, and a ball to its certain digits.

use super::ball::Ball;
use super::big::BigFloat;
use super::{Big, Dd, Real};
use dashu_base::{DivEuclid, RemEuclid, UnsignedAbs};
use dashu_int::{IBig, UBig};

/// Returns the value of a decimal literal, digit by digit: exact if the type can hold it, otherwise
/// rounded by the arithmetic of the type, which records the error.
pub(super) fn by_digits<N: Real>(text: &str) -> N {
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let Ok(mut exponent) = exponent.parse::<i32>() else { return N::from_f64(f64::NAN) };
    let ten = N::from_f64(10.0);
    let mut value = N::from_f64(0.0);
    // Six digits at a time: exact in every type, and a zero stays exactly zero.
    let mut block = (0u32, 0u32);
    let flush = |value: N, (digits, many): (u32, u32)| -> N {
        if value.approx() == 0.0 {
            N::from_f64(f64::from(digits))
        } else {
            value * N::from_f64(f64::from(10u32.pow(many))) + N::from_f64(f64::from(digits))
        }
    };
    let mut broken = false;
    for c in mantissa.chars() {
        match c.to_digit(10) {
            Some(d) => {
                block = (block.0 * 10 + d, block.1 + 1);
                exponent = exponent.saturating_sub(i32::from(broken));
                if block.1 == 6 {
                    value = flush(value, block);
                    block = (0, 0);
                }
            }
            None if c == '.' && !broken => broken = true,
            None => return N::from_f64(f64::NAN),
        }
    }
    value = flush(value, block);
    if value.approx() == 0.0 {
        return value;
    }
    // No number of a scene is beyond this limit; the power would only take time.
    if exponent.abs() > 5000 {
        return N::from_f64(f64::NAN);
    }
    let mut power = N::from_f64(1.0);
    let (mut base, mut left) = (ten, exponent.unsigned_abs());
    while left > 0 {
        if left % 2 == 1 {
            power = power * base;
        }
        left /= 2;
        if left > 0 {
            base = base * base;
        }
    }
    match exponent {
        0 => value,
        e if e > 0 => value * power,
        _ => value / power,
    }
}

/// An interval that surely contains a number, in a form that outlives the arithmetic of its
/// computation.
#[derive(Clone, Debug, PartialEq)]
pub struct Enclosure {
    ends: IntervalEnds,
    /// The midpoint, to `f64`.
    pub approx: f64,
    /// Half the width.
    pub radius: f64,
}

#[derive(Clone, Debug, PartialEq)]
enum IntervalEnds {
    Double(f64, f64),
    /// Both ends times 10^-exponent, the lower rounded down, the upper up.
    Long(Box<[IBig; 2]>, i32),
}

/// A ball of the precision ladder.
pub trait Certain: Real + 'static {
    /// Returns the ball as an independent interval; `None` if undecided.
    fn enclosure(self) -> Option<Enclosure>;
}

impl Certain for Ball<f64> {
    fn enclosure(self) -> Option<Enclosure> {
        let (m, r) = (self.middle(), self.radius());
        if !self.is_decided() {
            return None;
        }
        let ends = if r == 0.0 {
            IntervalEnds::Double(m, m)
        } else {
            IntervalEnds::Double((m - r).next_down(), (m + r).next_up())
        };
        Some(Enclosure { ends, approx: m, radius: r })
    }
}

impl Certain for Ball<Dd> {
    fn enclosure(self) -> Option<Enclosure> {
        let (hi, lo) = self.middle().parts();
        long_enclosure(exactly(hi)? + exactly(lo)?, self.approx(), self.radius())
    }
}

impl Certain for Ball<Big> {
    fn enclosure(self) -> Option<Enclosure> {
        long_enclosure(
            self.middle().long()?.with_precision(ALL_BITS).value(),
            self.approx(),
            self.radius(),
        )
    }
}

/// More bits than the range between the largest and the smallest `f64`: sums are exact.
const ALL_BITS: usize = 2200;

fn exactly(x: f64) -> Option<BigFloat> {
    Some(BigFloat::try_from(x).ok()?.with_precision(ALL_BITS).value())
}

/// Number of digits of the ends: twice the largest number that is requested. The ends are rounded
/// outward.
const KEPT: i32 = 64;

fn long_enclosure(mid: BigFloat, approx: f64, radius: f64) -> Option<Enclosure> {
    let r = exactly(radius)?;
    let largest = approx.abs() + radius;
    let exponent = if largest > 0.0 { libm::floor(libm::log10(largest)) as i32 - KEPT } else { 0 };
    let ends = Box::new([whole(&(&mid - &r), exponent, false), whole(&(mid + r), exponent, true)]);
    Some(Enclosure { ends: IntervalEnds::Long(ends, exponent), approx, radius })
}

/// Returns x · 10^-exponent as a whole number, rounded up or down.
fn whole(x: &BigFloat, exponent: i32, up: bool) -> IBig {
    let (mut over, mut under) = (x.repr().significand().clone(), IBig::ONE);
    let power = |n: i32| IBig::from(10).pow(n.unsigned_abs() as usize);
    if exponent < 0 {
        over *= power(exponent)
    } else {
        under *= power(exponent)
    }
    let binary = x.repr().exponent();
    if binary >= 0 {
        over <<= binary as usize
    } else {
        under <<= binary.unsigned_abs()
    }
    let (down, rest) = (over.clone().div_euclid(under.clone()), over.rem_euclid(under));
    if up && !rest.is_zero() { down + IBig::ONE } else { down }
}

impl Enclosure {
    /// Returns the number to `digits` significant digits, in e notation, if both ends round to the
    /// same digits.
    pub fn rounded(&self, digits: usize) -> Option<String> {
        let digits = digits.max(1);
        let (a, b) = match &self.ends {
            IntervalEnds::Double(a, b) => {
                (format!("{:.*e}", digits - 1, a), format!("{:.*e}", digits - 1, b))
            }
            IntervalEnds::Long(ends, exponent) => {
                (scientific(&ends[0], *exponent, digits), scientific(&ends[1], *exponent, digits))
            }
        };
        (a == b).then_some(a)
    }

    /// Returns true if both ends round to the same `digits` significant digits.
    pub fn holds(&self, digits: usize) -> bool {
        let [a, b] = match self.ends {
            IntervalEnds::Double(a, b) => [a, b],
            IntervalEnds::Long(..) => {
                [(self.approx - self.radius).next_down(), (self.approx + self.radius).next_up()]
            }
        };
        plainly_alike(a, b, digits.max(1)) || self.rounded(digits).is_some()
    }

    /// Returns true if the interval contains zero.
    pub fn contains_zero(&self) -> bool {
        match &self.ends {
            IntervalEnds::Double(a, b) => *a <= 0.0 && *b >= 0.0,
            IntervalEnds::Long(ends, _) => ends[0] <= IBig::ZERO && ends[1] >= IBig::ZERO,
        }
    }

    /// Returns the largest absolute value inside.
    pub fn largest(&self) -> f64 {
        (self.approx.abs() + self.radius) * (1.0 + 1e-15)
    }

    /// Returns true if two intervals have a number in common.
    pub fn meets(&self, other: &Enclosure) -> bool {
        // Both are scaled to one power of ten, below that of either.
        let exponent = |e: &Enclosure| match &e.ends {
            IntervalEnds::Double(..) => -400,
            IntervalEnds::Long(_, exponent) => *exponent,
        };
        let common = exponent(self).min(exponent(other));
        let ends = |e: &Enclosure| match &e.ends {
            IntervalEnds::Double(a, b) => {
                let end = |x: f64, up| exactly(x).map_or(IBig::ZERO, |x| whole(&x, common, up));
                [end(*a, false), end(*b, true)]
            }
            IntervalEnds::Long(ends, exponent) => {
                let up = IBig::from(10).pow((exponent - common).unsigned_abs() as usize);
                [&ends[0] * &up, &ends[1] * &up]
            }
        };
        let ([a, b], [c, d]) = (ends(self), ends(other));
        a <= d && c <= b
    }
}

/// Powers of ten that `f64` holds exactly.
const TENS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// Returns true if no rounding boundary is near an interval, by a few operations instead of writing
/// both ends: `true` is sure, `false` decides nothing.
fn plainly_alike(a: f64, b: f64, digits: usize) -> bool {
    // With more digits, half of the last digit is not far above the rounding errors of the sums
    // below.
    if digits > 12 || !(a > 0.0 || b < 0.0) {
        return false;
    }
    let [low, high] = if a > 0.0 { [a, b] } else { [-b, -a] };
    let shift = digits as i32 - 1 - libm::floor(libm::log10(high)) as i32;
    let Some(scale) = TENS.get(shift.unsigned_abs() as usize) else { return false };
    let [low, high] = [low, high].map(|x| if shift >= 0 { x * scale } else { x / scale });
    let slack = 2.0 * f64::EPSILON * high;
    let (low, high) = (low - slack, high + slack);
    let one_decade = low >= TENS[digits - 1] && high < TENS[digits];
    one_decade && libm::floor(low + 0.5) == libm::floor(high + 0.5)
}

/// Returns n · 10^exponent with `digits` significant digits, in the form of `{:e}`; halves to even.
fn scientific(n: &IBig, exponent: i32, digits: usize) -> String {
    if n.is_zero() {
        return format!("{:.*e}", digits - 1, 0.0);
    }
    let sign = if *n < IBig::ZERO { "-" } else { "" };
    let all = n.unsigned_abs().to_string();
    let mut exponent = exponent + all.len() as i32 - 1;
    let mut kept = format!("{:0<digits$}", &all[..all.len().min(digits)]);
    if let Some(rest) = all.get(digits..) {
        let (half, beyond) = (
            rest.as_bytes().first().copied().unwrap_or(b'0'),
            rest.bytes().skip(1).any(|b| b != b'0'),
        );
        let odd = kept.as_bytes()[digits - 1] % 2 == 1;
        if half > b'5' || (half == b'5' && (beyond || odd)) {
            let next = kept.parse::<UBig>().unwrap_or(UBig::ZERO) + UBig::ONE;
            kept = next.to_string();
            if kept.len() > digits {
                kept.pop();
                exponent += 1;
            }
        }
    }
    let (first, rest) = kept.split_at(1);
    let point = if rest.is_empty() { "" } else { "." };
    format!("{sign}{first}{point}{rest}e{exponent}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::within;

    fn digits<N: Certain>(x: N, digits: usize) -> Option<String> {
        x.enclosure().expect("decided").rounded(digits)
    }

    #[test]
    fn constants_to_thirty_digits() {
        fn check<N: Certain>(most: usize) {
            let number = |x: f64| N::from_f64(x);
            let third = number(1.0) / number(3.0);
            let (s, c) = N::from_decimal("39.3").sin_cos_degrees();
            for (x, text) in [
                (third, "3.33333333333333333333333333333"),
                (number(2.0).sqrt(), "1.41421356237309504880168872421"),
                (N::pi(), "3.14159265358979323846264338328"),
                (s, "6.3338087262755016203262119192353"),
                (c, "7.7384020972650618518999944537717"),
                (number(1.0).sin_cos().0, "8.4147098480789650665250232163030"),
                (number(-2.0).atan2(number(-3.0)), "-2.5535900500422256872170323026544"),
                (N::from_decimal("0.1"), "1.00000000000000000000000000000"),
            ] {
                let got = digits(x, most)
                    .unwrap_or_else(|| panic!("{text} is not certain to {most} digits: {x:?}"));
                let (mantissa, _) = got.split_once('e').unwrap();
                let negative = usize::from(text.starts_with('-'));
                // The last digit is rounded.
                let kept = most + negative;
                assert_eq!(&mantissa[..kept], &text[..kept], "{most} digits");
            }
        }
        check::<Ball<f64>>(12);
        check::<Ball<Dd>>(26);
        within(200, || check::<Ball<Big>>(29));
    }

    #[test]
    fn ends_that_round_apart_are_not_certain() {
        let ball = Ball::new(0.125, 1e-9);
        assert_eq!(digits(ball, 6).as_deref(), Some("1.25000e-1"));
        assert_eq!(digits(ball, 2), None, "a tie");
        assert_eq!(digits(Ball::<f64>::exact(0.125), 2).as_deref(), Some("1.2e-1"));
        assert_eq!(digits(Ball::new(1.0, 1e-3), 6), None);
        assert!(Ball::new(1.0, f64::INFINITY).enclosure().is_none());
        let e = Ball::new(1e-20, 1e-19).enclosure().unwrap();
        assert!(e.contains_zero() && e.meets(&Ball::new(-9e-20, 1e-21).enclosure().unwrap()));
        within(100, || {
            assert_eq!(
                digits(Ball::new(Big::from_f64(99.996), 1e-9), 4).as_deref(),
                Some("1.000e2")
            )
        });
    }

    #[test]
    fn a_quick_look_never_says_more_than_the_digits_do() {
        let (mut sure, mut alike, mut x) = (0, 0, 0.123_456_789_f64);
        for k in 0..40_000 {
            x = 3.99 * x * (1.0 - x);
            let near = [1.0, 1.000_5, 0.999_95, 9.999_5, 99.995, 0.012_35, x][k % 7] * TENS[k % 9];
            let mid = if k % 2 == 0 { near * (1.0 + 1e-9 * (x - 0.5)) } else { -near };
            let e = Ball::new(mid, near * 10f64.powi(-(4 + (k % 12) as i32))).enclosure().unwrap();
            for digits in 1..14 {
                let IntervalEnds::Double(a, b) = e.ends else { panic!() };
                let (quick, slow) = (plainly_alike(a, b, digits), e.rounded(digits).is_some());
                assert!(slow || !quick, "{e:?} to {digits} digits");
                (sure, alike) = (sure + u32::from(quick), alike + u32::from(slow));
            }
        }
        assert!(f64::from(sure) > 0.8 * f64::from(alike), "{sure} of {alike}");
    }
}
