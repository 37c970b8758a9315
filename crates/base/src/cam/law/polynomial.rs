//! Polynomials whose derivatives vanish at both ends: to the second order (3-4-5), to the third (4-5-6-7).

use super::Piece;

const NONE: (f64, &str) = (0.0, "0");

/// S = 10x³ − 15x⁴ + 6x⁵.
pub(super) const POLY_345: &[Piece] =
    &[Piece { end: 1.0, polynomial: &[NONE, NONE, NONE, (10.0, "10"), (-15.0, "-15"), (6.0, "6")], wave: None }];

/// S = 35x⁴ − 84x⁵ + 70x⁶ − 20x⁷.
pub(super) const POLY_4567: &[Piece] =
    &[Piece { end: 1.0, polynomial: &[NONE, NONE, NONE, NONE, (35.0, "35"), (-84.0, "-84"), (70.0, "70"), (-20.0, "-20")], wave: None }];
