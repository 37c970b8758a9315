//! Laws of one or two pieces: uniform, parabolic, harmonic, cycloidal.

use super::{Exact, Piece};

/// S = x.
pub(super) const UNIFORM: &[Piece] = &[Piece { end: 1.0, polynomial: &[Exact::plain(0.0, "0"), Exact::plain(1.0, "1")], wave: None }];

/// S = 2x², then 1 − 2(1 − x)².
pub(super) const PARABOLIC: &[Piece] = &[
    Piece { end: 0.5, polynomial: &[Exact::plain(0.0, "0"), Exact::plain(0.0, "0"), Exact::plain(2.0, "2")], wave: None },
    Piece { end: 1.0, polynomial: &[Exact::plain(-1.0, "-1"), Exact::plain(4.0, "4"), Exact::plain(-2.0, "-2")], wave: None },
];

/// S = (1 − cos πx)/2.
pub(super) const HARMONIC: &[Piece] =
    &[Piece { end: 1.0, polynomial: &[Exact::plain(0.5, "1/2")], wave: Some((Exact::plain(0.5, "1/2"), 180.0, 270.0)) }];

/// S = x − sin(2πx)/2π.
pub(super) const CYCLOIDAL: &[Piece] = &[Piece {
    end: 1.0,
    polynomial: &[Exact::plain(0.0, "0"), Exact::plain(1.0, "1")],
    wave: Some((Exact::of([0.0, 0.0, -0.5], [1.0, 0.0], "-1/(2*pi)"), 360.0, 0.0)),
}];
