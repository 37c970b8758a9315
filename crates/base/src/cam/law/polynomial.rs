//! Polynomials with derivatives that vanish at both ends: up to the second order (3-4-5), up to the
//! third (4-5-6-7).

use super::{LawCoefficient, LawPiece};

const NONE: LawCoefficient = LawCoefficient::plain(0.0, "0");

/// S = 10x³ − 15x⁴ + 6x⁵.
pub(super) const POLY_345: &[LawPiece] = &[LawPiece {
    end: 1.0,
    polynomial: &[
        NONE,
        NONE,
        NONE,
        LawCoefficient::plain(10.0, "10"),
        LawCoefficient::plain(-15.0, "-15"),
        LawCoefficient::plain(6.0, "6"),
    ],
    wave: None,
}];

/// S = 35x⁴ − 84x⁵ + 70x⁶ − 20x⁷.
pub(super) const POLY_4567: &[LawPiece] = &[LawPiece {
    end: 1.0,
    polynomial: &[
        NONE,
        NONE,
        NONE,
        NONE,
        LawCoefficient::plain(35.0, "35"),
        LawCoefficient::plain(-84.0, "-84"),
        LawCoefficient::plain(70.0, "70"),
        LawCoefficient::plain(-20.0, "-20"),
    ],
    wave: None,
}];
