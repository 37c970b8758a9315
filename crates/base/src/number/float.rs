//! Plain floating-point numbers: `f64`, and `f32` as a measure of the cost of half the digits.
//!
//! All functions come from `libm`, so that golden files are equal on every platform.

use super::Real;
use crate::trig;
use crate::trig::Angle;

impl Real for f64 {
    fn from_f64(x: f64) -> f64 {
        x
    }

    fn from_bounded(value: f64, _error: f64) -> Option<f64> {
        Some(value)
    }

    fn from_decimal(text: &str) -> f64 {
        text.parse().unwrap_or(f64::NAN)
    }

    fn approx(self) -> f64 {
        self
    }

    fn is_decided(self) -> bool {
        self.is_finite()
    }

    fn refines() -> bool {
        false
    }

    fn sqrt(self) -> f64 {
        self.sqrt()
    }

    fn sqrt_or_zero(self) -> f64 {
        self.max(0.0).sqrt()
    }

    fn hypot(self, y: f64) -> f64 {
        libm::hypot(self, y)
    }

    fn sin_cos(self) -> (f64, f64) {
        (libm::sin(self), libm::cos(self))
    }

    fn sin_cos_degrees(self) -> (f64, f64) {
        trig::sin_cos(Angle::Deg(self))
    }

    fn atan2(self, x: f64) -> f64 {
        libm::atan2(self, x)
    }

    fn pow(self, exponent: f64) -> f64 {
        libm::pow(self, exponent)
    }

    fn ln(self) -> f64 {
        libm::log(self)
    }

    fn exp(self) -> f64 {
        libm::exp(self)
    }

    fn pi() -> f64 {
        std::f64::consts::PI
    }
}

impl Real for f32 {
    fn from_f64(x: f64) -> f32 {
        x as f32
    }

    fn from_bounded(value: f64, _error: f64) -> Option<f32> {
        Some(value as f32)
    }

    fn from_decimal(text: &str) -> f32 {
        text.parse().unwrap_or(f32::NAN)
    }

    fn approx(self) -> f64 {
        f64::from(self)
    }

    fn is_decided(self) -> bool {
        self.is_finite()
    }

    fn refines() -> bool {
        false
    }

    fn sqrt(self) -> f32 {
        self.sqrt()
    }

    fn sqrt_or_zero(self) -> f32 {
        self.max(0.0).sqrt()
    }

    fn hypot(self, y: f32) -> f32 {
        libm::hypotf(self, y)
    }

    fn sin_cos(self) -> (f32, f32) {
        (libm::sinf(self), libm::cosf(self))
    }

    fn sin_cos_degrees(self) -> (f32, f32) {
        let (s, c) = trig::sin_cos(Angle::Deg(f64::from(self)));
        (s as f32, c as f32)
    }

    fn atan2(self, x: f32) -> f32 {
        libm::atan2f(self, x)
    }

    fn pow(self, exponent: f32) -> f32 {
        libm::powf(self, exponent)
    }

    fn ln(self) -> f32 {
        libm::logf(self)
    }

    fn exp(self) -> f32 {
        libm::expf(self)
    }

    fn pi() -> f32 {
        std::f32::consts::PI
    }
}
