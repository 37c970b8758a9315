//! Polynomials with derivatives that vanish at both ends: up to the second order (3-4-5), up to the
//! third (4-5-6-7).

use super::{Exact, Piece};

const NONE: Exact = Exact::plain(0.0, "0");

/// S = 10x³ − 15x⁴ + 6x⁵.
pub(super) const POLY_345: &[Piece] = &[Piece {
    end: 1.0,
    polynomial: &[NONE, NONE, NONE, Exact::plain(10.0, "10"), Exact::plain(-15.0, "-15"), Exact::plain(6.0, "6")],
    wave: None,
}];

/// S = 35x⁴ − 84x⁵ + 70x⁶ − 20x⁷.
pub(super) const POLY_4567: &[Piece] = &[Piece {
    end: 1.0,
    polynomial: &[
        NONE,
        NONE,
        NONE,
        NONE,
        Exact::plain(35.0, "35"),
        Exact::plain(-84.0, "-84"),
        Exact::plain(70.0, "70"),
        Exact::plain(-20.0, "-20"),
    ],
    wave: None,
}];
