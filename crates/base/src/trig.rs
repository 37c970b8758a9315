//! Sine and cosine of angles as written: exact at the multiples of 30° and 90° with an exact value.
//!
//! On paper the cosine of 60° is one half; by way of radians it is 0.5000000000000001, and the
//! cosine of a right angle is 6e-17, which the figures would print. All functions come from `libm`,
//! so that golden files are equal on every platform.

use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};

/// An angle as written: whole degrees stay degrees, so that cos 60° is one half and cos 90° is
/// zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Angle {
    /// Degrees.
    Deg(f64),
    /// Radians.
    Rad(f64),
}

impl Angle {
    /// Returns the angle in radians.
    pub fn radians(self) -> f64 {
        match self {
            Angle::Deg(d) => radians(d),
            Angle::Rad(r) => r,
        }
    }

    /// Returns the angle in degrees.
    pub fn degrees(self) -> f64 {
        match self {
            Angle::Deg(d) => d,
            Angle::Rad(r) => r.to_degrees(),
        }
    }
}

/// Converts degrees to radians.
pub fn radians(degrees: f64) -> f64 {
    degrees * PI / 180.0
}

/// Returns the whole turns of an angle (rad) beyond half a turn in either sense. An angle closer
/// than 1e-9 to minus half a turn counts as half a turn: rounding would choose between the two, and
/// the positive one is taken.
pub fn turns_of(angle: f64) -> f64 {
    libm::ceil((angle - PI - 1e-9) / TAU)
}

/// Returns (sin, cos) of an angle.
///
/// Degrees are reduced exactly (the remainder of floating-point numbers is exact), so
/// `sin_cos(Angle::Deg(750.0))` is that of 30°: sine 0.5. A non-finite angle gives NaN.
///
/// ```
/// use hodograph_base::trig::{Angle, sin_cos};
/// assert_eq!(sin_cos(Angle::Deg(60.0)).1, 0.5);
/// assert_eq!(sin_cos(Angle::Deg(-90.0)), (-1.0, 0.0));
/// ```
pub fn sin_cos(angle: Angle) -> (f64, f64) {
    match angle {
        Angle::Rad(r) => (libm::sin(r), libm::cos(r)),
        Angle::Deg(d) => {
            let turn = libm::fmod(d, 360.0);
            let quarter = libm::rint(turn / 90.0);
            // Within [-45, 45]: exact, because the two numbers differ by less than a factor of two
            // (Sterbenz) or quarter is 0.
            let (s, c) = first_octants(turn - 90.0 * quarter);
            // -0.0 would print as "-0".
            match (quarter as i64).rem_euclid(4) {
                0 => (s + 0.0, c),
                1 => (c, 0.0 - s),
                2 => (0.0 - s, -c),
                _ => (-c, s + 0.0),
            }
        }
    }
}

/// Returns (sin, cos) of −45° … 45°.
fn first_octants(d: f64) -> (f64, f64) {
    if d.abs() == 30.0 {
        (0.5f64.copysign(d), 3f64.sqrt() / 2.0)
    } else if d.abs() == 45.0 {
        (FRAC_1_SQRT_2.copysign(d), FRAC_1_SQRT_2)
    } else {
        let r = d * PI / 180.0;
        (libm::sin(r), libm::cos(r))
    }
}

/// Returns the arc sine of `x`: in exact degrees for 0, ±1/2 and ±1, otherwise in radians; NaN
/// outside [−1, 1].
pub fn asin(x: f64) -> Angle {
    match x.abs() {
        0.0 => Angle::Deg(0.0),
        0.5 => Angle::Deg(30f64.copysign(x)),
        1.0 => Angle::Deg(90f64.copysign(x)),
        _ => Angle::Rad(libm::asin(x)),
    }
}

/// Returns the arc cosine of `x` in [0°, 180°]: in exact degrees for 0, ±1/2 and ±1, otherwise in
/// radians; NaN outside [−1, 1].
pub fn acos(x: f64) -> Angle {
    match asin(x) {
        Angle::Deg(d) => Angle::Deg(90.0 - d),
        Angle::Rad(_) => Angle::Rad(libm::acos(x)),
    }
}

/// Returns the arc tangent of `x` in (−90°, 90°): in exact degrees for 0 and ±1, otherwise in
/// radians.
pub fn atan(x: f64) -> Angle {
    match x.abs() {
        0.0 => Angle::Deg(0.0),
        1.0 => Angle::Deg(45f64.copysign(x)),
        _ => Angle::Rad(libm::atan(x)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn special_angles_are_exact() {
        let h = 3f64.sqrt() / 2.0;
        let expected = [
            (0.0, 0.0, 1.0),
            (30.0, 0.5, h),
            (60.0, h, 0.5),
            (90.0, 1.0, 0.0),
            (120.0, h, -0.5),
            (150.0, 0.5, -h),
            (180.0, 0.0, -1.0),
            (210.0, -0.5, -h),
            (240.0, -h, -0.5),
            (270.0, -1.0, 0.0),
            (300.0, -h, 0.5),
            (330.0, -0.5, h),
        ];
        for (d, s, c) in expected {
            for turns in [-2.0, -1.0, 0.0, 1.0, 1000.0] {
                let (gs, gc) = sin_cos(Angle::Deg(d + 360.0 * turns));
                assert_eq!((gs, gc), (s, c), "{d} degrees and {turns} turns");
                assert!(
                    [gs, gc].iter().all(|x| x.to_bits() != (-0.0f64).to_bits()),
                    "negative zero at {d}"
                );
            }
        }
    }

    #[test]
    fn ordinary_angles_agree_with_radians() {
        for k in -720..720 {
            let d = f64::from(k) + 0.25;
            let (s, c) = sin_cos(Angle::Deg(d));
            let r = d.to_radians();
            assert!((s - r.sin()).abs() < 2e-15 && (c - r.cos()).abs() < 2e-15, "{d}");
        }
    }

    #[test]
    fn inverse_functions_know_the_same_angles() {
        assert_eq!(asin(-0.5), Angle::Deg(-30.0));
        assert_eq!(acos(-0.5), Angle::Deg(120.0));
        assert_eq!(atan(-1.0), Angle::Deg(-45.0));
        assert_eq!(acos(0.25), Angle::Rad(0.25f64.acos()));
    }
}
