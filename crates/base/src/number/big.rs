//! Numbers of any number of bits, on `dashu-float`.
//!
//! A [`Big`] is a handle into a region of its thread, so it is `Copy` like every [`Real`]:
//! [`within`] opens a region of one precision, runs the computation in it and frees its memory at
//! the end. A handle has no meaning outside its region.

use super::Real;
use crate::budget::spend;
use dashu_float::round::mode::HalfEven;
use dashu_float::{Context, FBig};
use dashu_int::IBig;
use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The number type of the library that a region stores.
pub(super) type BigFloat = FBig<HalfEven, 2>;

/// A number of the open region; undecided if an operation has no value.
#[derive(Clone, Copy, Debug)]
pub struct Big(u32);

struct Region {
    bits: usize,
    numbers: Vec<BigFloat>,
    pi: Option<BigFloat>,
}

thread_local! {
    static REGION: RefCell<Region> = const { RefCell::new(Region { bits: 0, numbers: Vec::new(), pi: None }) };
}

const UNDECIDED: Big = Big(u32::MAX);

/// The largest count of numbers in a region (some hundreds of megabytes); further numbers are
/// undecided.
const MOST: usize = 4_000_000;

/// Runs `work` with numbers of `bits` bits. Within a nested region only that region counts: the
/// outer region is suspended and then resumed.
pub fn within<T>(bits: usize, work: impl FnOnce() -> T) -> T {
    /// Resumes the outer region, also when the work panics.
    struct OuterRegion(Option<Region>);
    impl Drop for OuterRegion {
        fn drop(&mut self) {
            if let Some(outer) = self.0.take() {
                REGION.with_borrow_mut(|r| *r = outer);
            }
        }
    }
    let fresh = Region { bits: bits.max(64), numbers: Vec::new(), pi: None };
    let _outer = OuterRegion(Some(REGION.with_borrow_mut(|r| std::mem::replace(r, fresh))));
    work()
}

/// Returns the number of bits of the open region.
pub(super) fn bits() -> usize {
    REGION.with_borrow(|r| r.bits)
}

fn push(r: &mut Region, x: BigFloat) -> Big {
    // A result that overflows is infinite.
    if r.numbers.len() >= MOST || !x.repr().is_finite() {
        return UNDECIDED;
    }
    r.numbers.push(x);
    Big((r.numbers.len() - 1) as u32)
}

fn is_zero(x: &BigFloat) -> bool {
    *x == BigFloat::ZERO
}

/// Returns the remainder of degrees after whole turns, in (−360, 360) and without rounding: the
/// number is significand · 2^e with whole numbers, so the remainder is computed in whole numbers
/// too, for any number of turns.
fn less_turns(degrees: &BigFloat, bits: usize) -> BigFloat {
    let (whole, exponent) = (degrees.repr().significand(), degrees.repr().exponent());
    let turn = IBig::from(360);
    let (rest, exponent) = match usize::try_from(exponent) {
        Ok(up) => ((whole << up) % turn, 0),
        Err(_) => (whole % (turn << exponent.unsigned_abs()), exponent),
    };
    BigFloat::from_parts(rest, exponent).with_precision(bits).value()
}

impl Big {
    /// Returns the number as stored; `None` if undecided.
    pub(super) fn long(self) -> Option<BigFloat> {
        REGION.with_borrow(|r| r.numbers.get(self.0 as usize).cloned())
    }

    fn unary(self, f: impl FnOnce(&BigFloat, usize) -> Option<BigFloat>) -> Big {
        REGION.with_borrow_mut(|r| {
            match r.numbers.get(self.0 as usize).and_then(|x| f(x, r.bits)) {
                Some(y) => push(r, y),
                None => UNDECIDED,
            }
        })
    }

    fn binary(
        self,
        o: Big,
        f: impl FnOnce(&BigFloat, &BigFloat, &Context<HalfEven>) -> Option<BigFloat>,
    ) -> Big {
        spend();
        REGION.with_borrow_mut(|r| {
            let (Some(a), Some(b)) = (r.numbers.get(self.0 as usize), r.numbers.get(o.0 as usize))
            else {
                return UNDECIDED;
            };
            match f(a, b, &Context::new(r.bits)) {
                Some(y) => push(r, y),
                None => UNDECIDED,
            }
        })
    }
}

/// A number copied out of its region.
#[derive(Clone, Debug)]
pub struct RegionCopy(BigFloat);

impl Big {
    /// Copies the number so that it outlives the region; `None` if undecided.
    pub fn keep(self) -> Option<RegionCopy> {
        self.long().map(RegionCopy)
    }
}

impl RegionCopy {
    /// Returns the number in the open region, rounded to its bits.
    pub fn take(&self) -> Big {
        REGION.with_borrow_mut(|r| {
            let x = self.0.clone().with_precision(r.bits).value();
            push(r, x)
        })
    }
}

impl PartialEq for Big {
    fn eq(&self, o: &Big) -> bool {
        matches!((self.long(), o.long()), (Some(a), Some(b)) if a == b)
    }
}

impl Add for Big {
    type Output = Big;
    fn add(self, o: Big) -> Big {
        self.binary(o, |a, b, _| Some(a + b))
    }
}
impl Sub for Big {
    type Output = Big;
    fn sub(self, o: Big) -> Big {
        self.binary(o, |a, b, _| Some(a - b))
    }
}
impl Mul for Big {
    type Output = Big;
    fn mul(self, o: Big) -> Big {
        self.binary(o, |a, b, _| Some(a * b))
    }
}
impl Div for Big {
    type Output = Big;
    fn div(self, o: Big) -> Big {
        self.binary(o, |a, b, _| (!is_zero(b)).then(|| a / b))
    }
}
impl Neg for Big {
    type Output = Big;
    fn neg(self) -> Big {
        self.unary(|x, _| Some(-x.clone()))
    }
}

impl Real for Big {
    fn from_f64(x: f64) -> Big {
        REGION.with_borrow_mut(|r| match BigFloat::try_from(x) {
            Ok(y) if x.is_finite() => {
                let bits = r.bits;
                push(r, y.with_precision(bits).value())
            }
            _ => UNDECIDED,
        })
    }

    fn from_bounded(_value: f64, _error: f64) -> Option<Big> {
        None
    }

    fn from_decimal(text: &str) -> Big {
        super::decimal::by_digits(text)
    }

    fn approx(self) -> f64 {
        self.long().map_or(f64::NAN, |x| x.to_f64().value())
    }

    fn is_decided(self) -> bool {
        self.0 != u32::MAX
    }

    fn sqrt(self) -> Big {
        self.unary(|x, _| (is_zero(x) || x.sign() == dashu_base::Sign::Positive).then(|| x.sqrt()))
    }

    fn sqrt_or_zero(self) -> Big {
        if self.approx() <= 0.0 { Big::from_f64(0.0) } else { self.sqrt() }
    }

    fn hypot(self, y: Big) -> Big {
        (self * self + y * y).sqrt()
    }

    fn sin_cos(self) -> (Big, Big) {
        let Some(x) = self.long() else { return (UNDECIDED, UNDECIDED) };
        let (s, c) = x.sin_cos();
        REGION.with_borrow_mut(|r| (push(r, s), push(r, c)))
    }

    fn sin_cos_degrees(self) -> (Big, Big) {
        let turn = self.unary(|x, bits| Some(less_turns(x, bits)));
        let quarter = libm::rint(turn.approx() / 90.0);
        let rest = turn - Big::from_f64(90.0 * quarter);
        let exactly = |d: f64| rest == Big::from_f64(d);
        let root = |x: f64| Big::from_f64(x).sqrt();
        let half = Big::from_f64(0.5);
        let (s, c) = if exactly(30.0) {
            (half, root(3.0) * half)
        } else if exactly(-30.0) {
            (-half, root(3.0) * half)
        } else if exactly(45.0) {
            (root(0.5), root(0.5))
        } else if exactly(-45.0) {
            (-root(0.5), root(0.5))
        } else {
            (rest * Big::pi() / Big::from_f64(180.0)).sin_cos()
        };
        super::quarter_turns(quarter, s, c)
    }

    fn atan2(self, x: Big) -> Big {
        let rough = libm::atan2(self.approx(), x.approx());
        if !rough.is_finite() || (self.approx() == 0.0 && x.approx() == 0.0) {
            return UNDECIDED;
        }
        // Turned back by the approximate angle the vector points along x within t ≈ 1e-16: atan t =
        // t − t³/3 + t⁵/5 − ...
        let (s, c) = Big::from_f64(rough).sin_cos();
        let t = (self * c - x * s) / (x * c + self * s);
        let (square, mut power, mut angle) = (t * t, t, Big::from_f64(rough));
        // Each term adds another 100 bits.
        for k in 0..=bits() / 100 {
            let term = power / Big::from_f64((2 * k + 1) as f64);
            angle = if k % 2 == 0 { angle + term } else { angle - term };
            power = power * square;
        }
        angle
    }

    fn pow(self, exponent: Big) -> Big {
        super::whole_power(self, exponent).unwrap_or_else(|| {
            self.binary(exponent, |x, y, _| {
                (x.sign() == dashu_base::Sign::Positive && !is_zero(x)).then(|| x.powf(y))
            })
        })
    }

    fn ln(self) -> Big {
        self.binary(self, |x, _, _| {
            (x.sign() == dashu_base::Sign::Positive && !is_zero(x)).then(|| x.ln())
        })
    }

    fn exp(self) -> Big {
        // Beyond this the result is no quantity of a mechanism, and its exponent is large.
        if self.approx().abs() > 700.0 {
            return UNDECIDED;
        }
        self.binary(self, |x, _, _| Some(x.exp()))
    }

    fn pi() -> Big {
        REGION.with_borrow_mut(|r| {
            let bits = r.bits;
            let pi = r.pi.get_or_insert_with(|| BigFloat::pi(bits)).clone();
            push(r, pi)
        })
    }
}
