//! K, rocker and swing with the crank or the coupler: both limits of C lie under θ as seen from A, at the sum and the difference of the two bars.
//!
//! By the law of cosines L² = AC₁² + AC₂² − 2 AC₁ AC₂ cos θ with AC = BC ± AB and the chord L = C₁C₂:
//! 2 AB² (1 + cos θ) + 2 BC² (1 − cos θ) = L².

use super::{CrankRocker, Limits};
use crate::diag::{Both, both};
use crate::geom::Point;
use crate::synthesis::board::cross_circles;
use crate::synthesis::told::length;
use std::f64::consts::FRAC_PI_2;

/// The bar that is given (m).
#[derive(Clone, Copy, Debug)]
pub(super) enum Bar {
    /// AB.
    Crank(f64),
    /// BC.
    Coupler(f64),
}

impl Bar {
    /// Its key in the file.
    pub(super) fn key(self) -> &'static str {
        match self {
            Bar::Crank(_) => "crank",
            Bar::Coupler(_) => "coupler",
        }
    }

    pub(super) fn length(self) -> f64 {
        match self {
            Bar::Crank(l) | Bar::Coupler(l) => l,
        }
    }

    /// The same bar of another length (mm).
    pub(super) fn with(self, mm: f64) -> Bar {
        match self {
            Bar::Crank(_) => Bar::Crank(mm * 1e-3),
            Bar::Coupler(_) => Bar::Coupler(mm * 1e-3),
        }
    }

    pub(super) fn told(self) -> Both {
        match self {
            Bar::Crank(l) => both!("crank $l_{{AB}} = {}$", "曲柄 $l_{{AB}} = {}$", length(l)),
            Bar::Coupler(l) => both!("coupler $l_{{BC}} = {}$", "连杆 $l_{{BC}} = {}$", length(l)),
        }
    }

    /// The other bar as a formula of this one.
    pub(super) fn formula(self) -> [&'static str; 2] {
        match self {
            Bar::Crank(_) => ["BC", "l_{BC}^2 = \\frac{l_{C_1C_2}^2 − 2\\,l_{AB}^2(1 + \\cos\\theta)}{2(1 − \\cos\\theta)}"],
            Bar::Coupler(_) => ["AB", "l_{AB}^2 = \\frac{l_{C_1C_2}^2 − 2\\,l_{BC}^2(1 − \\cos\\theta)}{2(1 + \\cos\\theta)}"],
        }
    }

    /// On the line AC₁ a point H or G whose distance from C₁ is twice the bar, and under which angle the chord is seen from it.
    pub(super) fn seen(self, theta: f64) -> (&'static str, f64) {
        match self {
            Bar::Crank(_) => ("H", FRAC_PI_2 + theta / 2.0),
            Bar::Coupler(_) => ("G", theta / 2.0),
        }
    }

    /// Crank and coupler over the chord; `None` where there are none.
    fn both(self, chord: f64, cosine: f64) -> Option<[f64; 2]> {
        let (plus, minus) = (2.0 * (1.0 + cosine), 2.0 * (1.0 - cosine));
        // With θ = 0 the crank is half the chord, whatever the coupler.
        let [ab2, bc2] = match self {
            Bar::Crank(l) => [l * l, (chord * chord - l * l * plus) / minus],
            Bar::Coupler(l) => [(chord * chord - l * l * minus) / plus, l * l],
        };
        (cosine < 1.0 && bc2.is_finite() && ab2 > 0.0 && bc2 > ab2).then(|| [ab2.sqrt(), bc2.sqrt()])
    }
}

impl CrankRocker {
    /// A where AC₁ and AC₂ are sum and difference of the two bars.
    pub(super) fn by_bar(&self, swing: f64, bar: Bar) -> Vec<Limits> {
        let c = self.swung(swing);
        let Some([crank, coupler]) = bar.both(c[0].distance(c[1]), libm::cos(self.ratio.theta)) else { return Vec::new() };
        let Some(both_sides) = cross_circles(c[0], coupler + crank, c[1], coupler - crank) else { return Vec::new() };
        let middle = self.rocker * libm::cos(swing / 2.0);
        let named = |a: Point| {
            let which = if a.y > middle {
                both!("A on the arc beyond C1C2", "A 在 C1C2 之外的圆弧上")
            } else {
                both!("A on the arc on the side of D", "A 在 D 一侧的圆弧上")
            };
            self.laid(which, a, c)
        };
        both_sides.into_iter().map(named).collect()
    }
}
