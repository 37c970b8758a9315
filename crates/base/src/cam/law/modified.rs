//! The modified laws: accelerations of a trapezoid and of two sines, with corners rounded by
//! quarter waves over an eighth of the travel.

use super::{LawCoefficient, LawPiece};

/// (πx − sin(4πx)/4)/(4 + π), then (2 + πx − (9/4) sin(4πx/3 + π/3))/(4 + π), then (4 + πx −
/// sin(4πx)/4)/(4 + π).
pub(super) const SINE: &[LawPiece] = &[
    LawPiece { end: 0.125, polynomial: &[NONE, SLOPE], wave: Some((QUARTER, 720.0, 0.0)) },
    LawPiece {
        end: 0.875,
        polynomial: &[of_sine([2.0, 0.0, 0.0], "2/(4+pi)"), SLOPE],
        wave: Some((of_sine([-2.25, 0.0, 0.0], "-9/4/(4+pi)"), 240.0, 60.0)),
    },
    LawPiece {
        end: 1.0,
        polynomial: &[of_sine([4.0, 0.0, 0.0], "4/(4+pi)"), SLOPE],
        wave: Some((QUARTER, 720.0, 0.0)),
    },
];
const NONE: LawCoefficient = LawCoefficient::plain(0.0, "0");
const SLOPE: LawCoefficient = of_sine([0.0, 1.0, 0.0], "pi/(4+pi)");
const QUARTER: LawCoefficient = of_sine([-0.25, 0.0, 0.0], "-1/4/(4+pi)");

const fn of_sine(over: [f64; 3], text: &'static str) -> LawCoefficient {
    LawCoefficient::of(over, [4.0, 1.0], text)
}

/// Over 2 + π: 2x − W; π/16 − 1/2π + (2 − π)x + 4πx²; −π/2 + (2 + 2π)x + W; 1/2π − 33π/16 + (2 +
/// 7π)x − 4πx²; π + 2x − W, with W = sin(4πx)/2π. The acceleration rises by a quarter wave, stays
/// constant, falls by half a wave, stays constant, and rises to zero.
pub(super) const TRAPEZOIDAL: &[LawPiece] = &[
    LawPiece { end: 0.125, polynomial: &[NONE, ENDS], wave: Some((FALL, 720.0, 0.0)) },
    LawPiece {
        end: 0.375,
        polynomial: &[
            of_trapezoid([0.0, 0.0625, -0.5], "(pi/16-1/(2*pi))/(2+pi)"),
            of_trapezoid([2.0, -1.0, 0.0], "(2-pi)/(2+pi)"),
            of_trapezoid([0.0, 4.0, 0.0], "4*pi/(2+pi)"),
        ],
        wave: None,
    },
    LawPiece {
        end: 0.625,
        polynomial: &[
            of_trapezoid([0.0, -0.5, 0.0], "-pi/2/(2+pi)"),
            of_trapezoid([2.0, 2.0, 0.0], "(2+2*pi)/(2+pi)"),
        ],
        wave: Some((of_trapezoid([0.0, 0.0, 0.5], "1/(2*pi)/(2+pi)"), 720.0, 0.0)),
    },
    LawPiece {
        end: 0.875,
        polynomial: &[
            of_trapezoid([0.0, -2.0625, 0.5], "(1/(2*pi)-33*pi/16)/(2+pi)"),
            of_trapezoid([2.0, 7.0, 0.0], "(2+7*pi)/(2+pi)"),
            of_trapezoid([0.0, -4.0, 0.0], "-4*pi/(2+pi)"),
        ],
        wave: None,
    },
    LawPiece {
        end: 1.0,
        polynomial: &[of_trapezoid([0.0, 1.0, 0.0], "pi/(2+pi)"), ENDS],
        wave: Some((FALL, 720.0, 0.0)),
    },
];
const ENDS: LawCoefficient = of_trapezoid([2.0, 0.0, 0.0], "2/(2+pi)");
const FALL: LawCoefficient = of_trapezoid([0.0, 0.0, -0.5], "-1/(2*pi)/(2+pi)");

const fn of_trapezoid(over: [f64; 3], text: &'static str) -> LawCoefficient {
    LawCoefficient::of(over, [2.0, 1.0], text)
}
