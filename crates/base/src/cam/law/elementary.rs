//! Laws of one or two pieces: uniform, parabolic, harmonic, cycloidal.

use super::{LawCoefficient, LawPiece};

/// S = x.
pub(super) const UNIFORM: &[LawPiece] = &[LawPiece {
    end: 1.0,
    polynomial: &[LawCoefficient::plain(0.0, "0"), LawCoefficient::plain(1.0, "1")],
    wave: None,
}];

/// S = 2x², then 1 − 2(1 − x)².
pub(super) const PARABOLIC: &[LawPiece] = &[
    LawPiece {
        end: 0.5,
        polynomial: &[
            LawCoefficient::plain(0.0, "0"),
            LawCoefficient::plain(0.0, "0"),
            LawCoefficient::plain(2.0, "2"),
        ],
        wave: None,
    },
    LawPiece {
        end: 1.0,
        polynomial: &[
            LawCoefficient::plain(-1.0, "-1"),
            LawCoefficient::plain(4.0, "4"),
            LawCoefficient::plain(-2.0, "-2"),
        ],
        wave: None,
    },
];

/// S = (1 − cos πx)/2.
pub(super) const HARMONIC: &[LawPiece] = &[LawPiece {
    end: 1.0,
    polynomial: &[LawCoefficient::plain(0.5, "1/2")],
    wave: Some((LawCoefficient::plain(0.5, "1/2"), 180.0, 270.0)),
}];

/// S = x − sin(2πx)/2π.
pub(super) const CYCLOIDAL: &[LawPiece] = &[LawPiece {
    end: 1.0,
    polynomial: &[LawCoefficient::plain(0.0, "0"), LawCoefficient::plain(1.0, "1")],
    wave: Some((LawCoefficient::of([0.0, 0.0, -0.5], [1.0, 0.0], "-1/(2*pi)"), 360.0, 0.0)),
}];
