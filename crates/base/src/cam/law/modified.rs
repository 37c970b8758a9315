//! The modified laws: accelerations of a trapezoid and of two sines, their corners rounded by quarter waves of an eighth of the way.

use super::Piece;
use std::f64::consts::PI;

/// (πx − sin(4πx)/4)/(4 + π), then (2 + πx − (9/4) sin(4πx/3 + π/3))/(4 + π), then (4 + πx − sin(4πx)/4)/(4 + π).
pub(super) const SINE: &[Piece] = &[
    Piece { end: 0.125, polynomial: &[(0.0, "0"), SLOPE], wave: Some((QUARTER, 720.0, 0.0)) },
    Piece {
        end: 0.875,
        polynomial: &[(2.0 / (4.0 + PI), "2/(4+pi)"), SLOPE],
        wave: Some(((-2.25 / (4.0 + PI), "-9/4/(4+pi)"), 240.0, 60.0)),
    },
    Piece { end: 1.0, polynomial: &[(4.0 / (4.0 + PI), "4/(4+pi)"), SLOPE], wave: Some((QUARTER, 720.0, 0.0)) },
];
const SLOPE: (f64, &str) = (PI / (4.0 + PI), "pi/(4+pi)");
const QUARTER: (f64, &str) = (-0.25 / (4.0 + PI), "-1/4/(4+pi)");

/// Over 2 + π: 2x − W; π/16 − 1/2π + (2 − π)x + 4πx²; −π/2 + (2 + 2π)x + W; 1/2π − 33π/16 + (2 + 7π)x − 4πx²; π + 2x − W, with
/// W = sin(4πx)/2π. The acceleration rises by a quarter wave, stays, falls by half a wave, stays, and goes back.
pub(super) const TRAPEZOIDAL: &[Piece] = &[
    Piece { end: 0.125, polynomial: &[(0.0, "0"), ENDS], wave: Some((FALL, 720.0, 0.0)) },
    Piece {
        end: 0.375,
        polynomial: &[
            ((PI / 16.0 - 0.5 / PI) / (2.0 + PI), "(pi/16-1/(2*pi))/(2+pi)"),
            ((2.0 - PI) / (2.0 + PI), "(2-pi)/(2+pi)"),
            (4.0 * PI / (2.0 + PI), "4*pi/(2+pi)"),
        ],
        wave: None,
    },
    Piece {
        end: 0.625,
        polynomial: &[(-0.5 * PI / (2.0 + PI), "-pi/2/(2+pi)"), ((2.0 + 2.0 * PI) / (2.0 + PI), "(2+2*pi)/(2+pi)")],
        wave: Some(((0.5 / PI / (2.0 + PI), "1/(2*pi)/(2+pi)"), 720.0, 0.0)),
    },
    Piece {
        end: 0.875,
        polynomial: &[
            ((0.5 / PI - 33.0 * PI / 16.0) / (2.0 + PI), "(1/(2*pi)-33*pi/16)/(2+pi)"),
            ((2.0 + 7.0 * PI) / (2.0 + PI), "(2+7*pi)/(2+pi)"),
            (-4.0 * PI / (2.0 + PI), "-4*pi/(2+pi)"),
        ],
        wave: None,
    },
    Piece { end: 1.0, polynomial: &[(PI / (2.0 + PI), "pi/(2+pi)"), ENDS], wave: Some((FALL, 720.0, 0.0)) },
];
const ENDS: (f64, &str) = (2.0 / (2.0 + PI), "2/(2+pi)");
const FALL: (f64, &str) = (-0.5 / PI / (2.0 + PI), "-1/(2*pi)/(2+pi)");
