//! Crank-rockers by K, the chord C₁C₂ and the crank or the coupler: from A both limits of C appear
//! under θ, at the sum and the difference of the two bars.
//!
//! By the law of cosines L² = AC₁² + AC₂² − 2 AC₁ AC₂ cos θ with AC = BC ± AB and the chord L =
//! C₁C₂: 2 AB² (1 + cos θ) + 2 BC² (1 − cos θ) = L².

use crate::board::{PaperLine, SynthesisBoard, Weight};
use crate::statement::length;
use hodograph_base::diag::{Both, both};
use hodograph_base::digits::significant;
use hodograph_base::geom::Point;
use std::f64::consts::FRAC_PI_2;

/// The given bar (m).
#[derive(Clone, Copy, Debug)]
pub(super) enum GivenBar {
    /// AB.
    Crank(f64),
    /// BC.
    Coupler(f64),
}

impl GivenBar {
    /// The bar's key in the file.
    pub(super) fn key(self) -> &'static str {
        match self {
            GivenBar::Crank(_) => "crank",
            GivenBar::Coupler(_) => "coupler",
        }
    }

    pub(super) fn length(self) -> f64 {
        match self {
            GivenBar::Crank(l) | GivenBar::Coupler(l) => l,
        }
    }

    /// The bar with another length (mm).
    pub(super) fn with(self, mm: f64) -> GivenBar {
        match self {
            GivenBar::Crank(_) => GivenBar::Crank(mm * 1e-3),
            GivenBar::Coupler(_) => GivenBar::Coupler(mm * 1e-3),
        }
    }

    pub(super) fn told(self) -> Both {
        match self {
            GivenBar::Crank(l) => both!("crank $l_{{AB}} = {}$", length(l)),
            GivenBar::Coupler(l) => {
                both!("coupler $l_{{BC}} = {}$", length(l))
            }
        }
    }

    /// The name of the other bar, and its formula.
    pub(super) fn formula(self) -> [&'static str; 2] {
        match self {
            GivenBar::Crank(_) => [
                "BC",
                "l_{BC}^2 = \\frac{l_{C_1C_2}^2 − 2\\,l_{AB}^2(1 + \\cos\\theta)}{2(1 − \\cos\\theta)}",
            ],
            GivenBar::Coupler(_) => [
                "AB",
                "l_{AB}^2 = \\frac{l_{C_1C_2}^2 − 2\\,l_{BC}^2(1 − \\cos\\theta)}{2(1 + \\cos\\theta)}",
            ],
        }
    }

    /// The letter of a point on the line AC₁, F or H, that is twice the bar away from C₁, and the
    /// angle under which the chord appears from it (rad).
    fn seen(self, theta: f64) -> (&'static str, f64) {
        match self {
            GivenBar::Crank(_) => ("F", FRAC_PI_2 + theta / 2.0),
            GivenBar::Coupler(_) => ("H", theta / 2.0),
        }
    }

    /// Crank and coupler for a chord (m); `None` if there are none.
    pub(super) fn both(self, chord: f64, cosine: f64) -> Option<[f64; 2]> {
        let (plus, minus) = (2.0 * (1.0 + cosine), 2.0 * (1.0 - cosine));
        // With θ = 0 the crank is half the chord for any coupler.
        let [ab2, bc2] = match self {
            GivenBar::Crank(l) => [l * l, (chord * chord - l * l * plus) / minus],
            GivenBar::Coupler(l) => [(chord * chord - l * l * minus) / plus, l * l],
        };
        (cosine < 1.0 && bc2.is_finite() && ab2 > 0.0 && bc2 > ab2)
            .then(|| [ab2.sqrt(), bc2.sqrt()])
    }

    /// A by ruler and compasses on the circle over C₁C₂ with the inscribed angle θ, on one side of
    /// the chord.
    pub(super) fn place(
        self,
        board: &mut SynthesisBoard,
        [c1, c2]: [Point; 2],
        (theta, side): (f64, bool),
        (centre, radius): (Point, f64),
        k: usize,
    ) -> Option<Point> {
        let (letter, seen) = self.seen(theta);
        let told = significant(seen.to_degrees(), 5);
        board.step(match self {
            GivenBar::Crank(_) => both!(
                "AF = AC2 on AC1 leaves C1F = 2 AB, and C1C2 is seen from F under 90° + θ/2 = {told}°: the circle with that inscribed angle, cut by the opening 2 AB about C1, gives F"
            ),
            GivenBar::Coupler(_) => both!(
                "AH = AC2 beyond A on C1A makes C1H = 2 BC, and C1C2 is seen from H under θ/2 = {told}°: the circle with that inscribed angle, cut by the opening 2 BC about C1, gives H"
            ),
        });
        let (other, wide) = board.inscribed(c1, c2, seen, side)?;
        let opening = board.mm(2.0 * self.length());
        board.circle(c1, opening, Weight::Thin);
        let h = board.circles(c1, opening, other, wide)?[k];
        board.mark(letter, h);
        board.step(both!("The line C1{} meets the first circle again at A", letter));
        let crossings = board.cut(&PaperLine::through(c1, h)?, centre, radius)?;
        crossings.into_iter().max_by(|p, q| p.distance(c1).total_cmp(&q.distance(c1)))
    }
}
