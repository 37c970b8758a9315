//! The numbers of a compiled sweep: one position at a time, four side by side, or one with its
//! derivative.
//!
//! A kernel is written once over [`Lane`]. The four lanes of [`fearless_simd`] do the very
//! operations of `f64`, each rounded by itself and none fused, so that both give the same bits on
//! every machine. [`Dual`] carries the derivative by the driver along, for Newton's method on the
//! limits of a motion.

use fearless_simd::{Select, Simd, SimdBase, SimdFloat, f64x4};
use hodograph_base::number::Ring;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The number 1.5·2⁵²: adding and subtracting it removes all digits behind the point.
const WHOLE: f64 = 6_755_399_441_055_744.0;

/// A number of a sweep: one or several positions.
pub trait Lane:
    Ring + Div<Output = Self> + Mul<f64, Output = Self> + Add<f64, Output = Self>
{
    /// Returns a constant as a number of this type.
    fn constant(self, x: f64) -> Self;

    /// Returns the square root; NaN for negative numbers.
    fn sqrt(self) -> Self;

    /// Returns zero if the number is zero within rounding (|x| ≤ `slack`/4), NaN if it is less than
    /// −`slack`, else a number that is at least itself.
    ///
    /// By this rule [`hodograph_mechanism::position::kernel`] distinguishes a touch from a miss.
    fn touching(self, slack: Self) -> Self;

    /// Returns the number, or zero if it is negative; NaN stays.
    fn or_zero(self) -> Self;

    /// Returns the nearest whole number, for numbers below 2⁵¹; its derivative is zero.
    fn nearest(self) -> Self;

    /// Returns `after` if the number is at least `from`, else (and for NaN) `before`.
    fn past(self, from: f64, after: Self, before: Self) -> Self;

    /// Returns the smaller number; `other` if either is NaN.
    fn least(self, other: Self) -> Self;

    /// Returns the root of the radicand of a closure whose smaller factor is `least`: zero where
    /// that factor is zero within rounding, NaN where the loci miss each other, because the other
    /// factor is positive then. This is the rule of [`Lane::touching`] in fewer steps: the root
    /// need not wait for it.
    fn root_unless_touching(self, least: Self, slack: Self) -> Self;

    /// Returns the angle of the vector (x, y) = (`x`, `self`), in (−π, π].
    fn atan2(self, x: Self) -> Self;
}

impl Lane for f64 {
    #[inline(always)]
    fn constant(self, x: f64) -> f64 {
        x
    }

    #[inline(always)]
    fn sqrt(self) -> f64 {
        self.sqrt()
    }

    #[inline(always)]
    fn touching(self, slack: f64) -> f64 {
        let quarter = slack * 0.25;
        let near = if self <= quarter && self >= -quarter { 0.0 } else { self };
        if near < -slack { f64::NAN } else { near }
    }

    #[inline(always)]
    fn nearest(self) -> f64 {
        (self + WHOLE) - WHOLE
    }

    #[inline(always)]
    fn or_zero(self) -> f64 {
        if self < 0.0 { 0.0 } else { self }
    }

    #[inline(always)]
    fn past(self, from: f64, after: f64, before: f64) -> f64 {
        if self >= from { after } else { before }
    }

    #[inline(always)]
    fn least(self, other: f64) -> f64 {
        if self < other { self } else { other }
    }

    #[inline(always)]
    fn root_unless_touching(self, least: f64, slack: f64) -> f64 {
        if least <= slack * 0.25 && least >= -slack { 0.0 } else { self.sqrt() }
    }

    fn atan2(self, x: f64) -> f64 {
        libm::atan2(self, x)
    }
}

impl<S: Simd> Lane for f64x4<S> {
    #[inline(always)]
    fn constant(self, x: f64) -> Self {
        f64x4::splat(self.simd, x)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        SimdFloat::sqrt(self)
    }

    #[inline(always)]
    fn touching(self, slack: Self) -> Self {
        let quarter = slack * 0.25;
        let zero = f64x4::splat(self.simd, 0.0);
        let near = (self.simd_le(quarter) & self.simd_ge(-quarter)).select(zero, self);
        near.simd_lt(-slack).select(f64x4::splat(self.simd, f64::NAN), near)
    }

    #[inline(always)]
    fn nearest(self) -> Self {
        (self + WHOLE) + -WHOLE
    }

    #[inline(always)]
    fn or_zero(self) -> Self {
        let zero = f64x4::splat(self.simd, 0.0);
        self.simd_lt(zero).select(zero, self)
    }

    #[inline(always)]
    fn past(self, from: f64, after: Self, before: Self) -> Self {
        self.simd_ge(f64x4::splat(self.simd, from)).select(after, before)
    }

    #[inline(always)]
    fn least(self, other: Self) -> Self {
        self.simd_lt(other).select(self, other)
    }

    #[inline(always)]
    fn root_unless_touching(self, least: Self, slack: Self) -> Self {
        let touch = least.simd_le(slack * 0.25) & least.simd_ge(-slack);
        touch.select(f64x4::splat(self.simd, 0.0), SimdFloat::sqrt(self))
    }

    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        let (y, x) = (<[f64; 4]>::from(self), <[f64; 4]>::from(x));
        f64x4::from_slice(self.simd, &std::array::from_fn::<f64, 4, _>(|i| libm::atan2(y[i], x[i])))
    }
}

/// The form of the kernels to run; both give the same bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Width {
    /// Four positions at once if the machine can (AVX2, found at run time), else one.
    #[default]
    Widest,
    /// One position at a time.
    One,
}

impl Width {
    /// Returns four SIMD lanes of the machine, if they are wanted and available.
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    pub(super) fn four(self) -> Option<fearless_simd::Avx2> {
        if self == Width::Widest { fearless_simd::Level::new().as_avx2() } else { None }
    }

    /// Returns four SIMD lanes of the machine (two by two), if they are wanted and available.
    #[cfg(target_arch = "aarch64")]
    pub(super) fn four(self) -> Option<fearless_simd::Neon> {
        if self == Width::Widest { fearless_simd::Level::new().as_neon() } else { None }
    }

    /// Returns `None`: other machines run one position at a time.
    #[cfg(not(any(target_arch = "x86", target_arch = "x86_64", target_arch = "aarch64")))]
    pub(super) fn four(self) -> Option<fearless_simd::Fallback> {
        None
    }
}

/// A number and its derivative by the swept quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual {
    /// The value.
    pub value: f64,
    /// Its derivative.
    pub slope: f64,
}

impl Dual {
    /// Returns a number that does not change.
    pub fn fixed(value: f64) -> Dual {
        Dual { value, slope: 0.0 }
    }
}

impl Add for Dual {
    type Output = Dual;
    fn add(self, o: Dual) -> Dual {
        Dual { value: self.value + o.value, slope: self.slope + o.slope }
    }
}

impl Sub for Dual {
    type Output = Dual;
    fn sub(self, o: Dual) -> Dual {
        Dual { value: self.value - o.value, slope: self.slope - o.slope }
    }
}

impl Mul for Dual {
    type Output = Dual;
    fn mul(self, o: Dual) -> Dual {
        Dual { value: self.value * o.value, slope: self.slope * o.value + self.value * o.slope }
    }
}

impl Div for Dual {
    type Output = Dual;
    fn div(self, o: Dual) -> Dual {
        let value = self.value / o.value;
        Dual { value, slope: (self.slope - value * o.slope) / o.value }
    }
}

impl Neg for Dual {
    type Output = Dual;
    fn neg(self) -> Dual {
        Dual { value: -self.value, slope: -self.slope }
    }
}

impl Mul<f64> for Dual {
    type Output = Dual;
    fn mul(self, k: f64) -> Dual {
        Dual { value: self.value * k, slope: self.slope * k }
    }
}

impl Add<f64> for Dual {
    type Output = Dual;
    fn add(self, k: f64) -> Dual {
        Dual { value: self.value + k, ..self }
    }
}

impl Lane for Dual {
    fn constant(self, x: f64) -> Dual {
        Dual::fixed(x)
    }

    fn sqrt(self) -> Dual {
        let value = self.value.sqrt();
        Dual { value, slope: 0.5 * self.slope / value }
    }

    fn touching(self, slack: Dual) -> Dual {
        Dual { value: self.value.touching(slack.value), ..self }
    }

    fn nearest(self) -> Dual {
        Dual::fixed(self.value.nearest())
    }

    fn or_zero(self) -> Dual {
        Dual { value: self.value.or_zero(), ..self }
    }

    fn past(self, from: f64, after: Dual, before: Dual) -> Dual {
        if self.value >= from { after } else { before }
    }

    fn least(self, other: Dual) -> Dual {
        if self.value < other.value { self } else { other }
    }

    fn root_unless_touching(self, least: Dual, slack: Dual) -> Dual {
        Lane::sqrt(if least.value <= slack.value * 0.25 && least.value >= -slack.value {
            Dual::fixed(0.0)
        } else {
            self
        })
    }

    fn atan2(self, x: Dual) -> Dual {
        let r2 = x.value * x.value + self.value * self.value;
        Dual {
            value: libm::atan2(self.value, x.value),
            slope: (x.value * self.slope - self.value * x.slope) / r2,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_lanes_are_four_numbers() {
        let Some(simd) = Width::Widest.four() else { return };
        let xs = [
            f64::NAN,
            -1e-20,
            -1.0,
            2.0,
            0.0,
            -0.0,
            3e-17,
            5e-324,
            f64::INFINITY,
            -3e-16,
            1e300,
            0.1,
        ];
        for w in xs.windows(4) {
            let x: [f64; 4] = w.try_into().unwrap();
            let y = [1e-15, 1e-16, 0.7, -3.0];
            let (vx, vy) = (f64x4::from_slice(simd, &x), f64x4::from_slice(simd, &y));
            type One = fn(f64, f64) -> f64;
            let both: [(f64x4<_>, One); 10] = [
                ((vx * 3.7).nearest(), |x, _| (x * 3.7).nearest()),
                (vx.least(vy), |x, y| x.least(y)),
                (vx.past(0.0, vy, vx * 2.0), |x, y| x.past(0.0, y, x * 2.0)),
                (vy.root_unless_touching(vx, vy), |x, y| y.root_unless_touching(x, y)),
                (vx.touching(vy), |x, y| x.touching(y)),
                (vx.or_zero(), |x, _| x.or_zero()),
                (Lane::sqrt(vx), |x, _| x.sqrt()),
                (vx * vy + vx / vy, |x, y| x * y + x / y),
                (Lane::atan2(vx, vy), |x, y| libm::atan2(x, y)),
                (vx * 0.1 + 0.7, |x, _| x * 0.1 + 0.7),
            ];
            for (lanes, one) in both {
                let lanes = <[f64; 4]>::from(lanes);
                for i in 0..4 {
                    let expected = one(x[i], y[i]);
                    assert!(
                        lanes[i].to_bits() == expected.to_bits()
                            || lanes[i].is_nan() && expected.is_nan(),
                        "{x:?} {y:?} {i}"
                    );
                }
            }
        }
    }

    #[test]
    fn slopes_of_the_dual_numbers() {
        let x = Dual { value: 0.7, slope: 1.0 };
        let f = (x * x + 2.0) / Lane::sqrt(x);
        // f = x^1.5 + 2 x^-0.5
        assert!((f.slope - (1.5 * 0.7f64.sqrt() - 0.7f64.powf(-1.5))).abs() < 1e-14);
        assert!((x.atan2(x * x).slope + 1.0 / (1.0 + 0.49)).abs() < 1e-15);
    }
}
