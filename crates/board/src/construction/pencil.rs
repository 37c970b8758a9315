//! Pencils: the actual places of marks, and so the accuracy of a drawing.
//!
//! Every act of drawing uses a [`Pencil`]: setting out a joint, ending a vector, laying a ruler,
//! marking a crossing, reading a length. [`Exact`] puts every mark at its intended place at no
//! cost; [`Blunt`] adds the errors of a hand; [`Single`] keeps every drawn number in f32.

use hodograph_base::diagram::DiagramKind;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use std::cell::RefCell;
use std::collections::VecDeque;

/// The share of a normal error in the plane, independent in x and y, that is within the stated
/// pencil error.
pub const WITHIN: f64 = 0.95;

/// The usual pencil error (mm), with which textbooks and this project calculate by default: a fine
/// line is twice as wide.
pub const USUAL_MM: f64 = 0.1;

/// The radius in units of the standard deviation of x (and of y) that contains the share [`WITHIN`]
/// of the marks: √(−2 ln 0.05) = 2.448.
pub fn radius_in_deviations() -> f64 {
    (-2.0 * libm::log(1.0 - WITHIN)).sqrt()
}

/// A drawing instrument with its errors.
///
/// `on` is the kind of the diagram. All lengths are millimetres of paper.
pub trait Pencil<N: Real = f64> {
    /// True if every mark falls at its intended place: then no other method is called.
    const EXACT: bool;

    /// The mark for the intended place `at`.
    fn mark(&mut self, on: DiagramKind, at: Point<N>) -> Point<N>;

    /// A measured vector: reading its end has the error of a mark.
    fn read(&mut self, on: DiagramKind, v: Vec2<N>) -> Vec2<N> {
        self.mark(on, v.to_point()).to_vec2()
    }

    /// The unit direction of a ruler laid along two marks `apart_mm` apart in the direction of the
    /// unit vector `u`: it misses each of them independently.
    fn ruler(&mut self, on: DiagramKind, u: Vec2<N>, apart_mm: f64) -> Vec2<N> {
        let from = self.mark(on, Point::origin());
        let to = self.mark(on, (u * N::from_f64(apart_mm)).to_point());
        (to - from).unit().unwrap_or(u)
    }
}

/// The exact pencil: puts every mark at its intended place.
#[derive(Clone, Copy, Debug, Default)]
pub struct Exact;

impl<N: Real> Pencil<N> for Exact {
    const EXACT: bool = true;

    fn mark(&mut self, _: DiagramKind, at: Point<N>) -> Point<N> {
        at
    }

    fn read(&mut self, _: DiagramKind, v: Vec2<N>) -> Vec2<N> {
        v
    }

    fn ruler(&mut self, _: DiagramKind, u: Vec2<N>, _: f64) -> Vec2<N> {
        u
    }
}

/// The blunt pencil: every mark has an independent error in the plane.
///
/// The error is normal and equal in all directions, and the stated pencil error is the radius that
/// contains 95 % of the marks. It is normal because a miss is the sum of many small causes (width
/// of the line, seat of the compass, the eye) and has no sharp bound, unlike an error spread evenly
/// over a disc; and because sums of normal errors are normal, so that the effect of a chain of
/// steps can be derived as well as simulated. The same seed gives the same drawing on every
/// machine.
#[derive(Clone, Debug)]
pub struct Blunt {
    error_mm: f64,
    chance: Pcg64Mcg,
}

impl Blunt {
    /// Returns a pencil with a given error (mm, 95 %).
    pub fn new(error_mm: f64, seed: u64) -> Blunt {
        Blunt { error_mm, chance: Pcg64Mcg::seed_from_u64(seed) }
    }

    /// Uniform in (0, 1]: 53 bits, as many as a double holds.
    fn uniform(&mut self) -> f64 {
        ((self.chance.next_u64() >> 11) + 1) as f64 * (1.0 / (1u64 << 53) as f64)
    }
}

impl Pencil for Blunt {
    const EXACT: bool = false;

    fn mark(&mut self, _: DiagramKind, at: Point) -> Point {
        // The distance of a normal error has a Rayleigh distribution: P(r > R) = exp(−R²/2σ²),
        // which is 5 % at the stated error.
        let distance = self.error_mm * (libm::log(self.uniform()) / libm::log(1.0 - WITHIN)).sqrt();
        at + Vec2::from_angle(self.uniform() * std::f64::consts::TAU) * distance
    }
}

/// Number of repeated drawings: it gives the 95 % bound to about a tenth of itself.
const DRAWINGS: u64 = 200;

/// Draws a construction again and again with a pencil of an error (mm), and returns for each reading
/// the bound that contains the share [`WITHIN`] of its errors. `errors` draws once and returns the
/// error of each reading, `None` for a reading that fails. A bound is `None` if more readings fail
/// than it may leave out.
pub fn bounds(
    pencil_mm: f64,
    readings: usize,
    errors: impl Fn(Blunt) -> Vec<Option<f64>>,
) -> Vec<Option<f64>> {
    let all: Vec<_> = (1..=DRAWINGS).map(|seed| errors(Blunt::new(pencil_mm, seed))).collect();
    let bound = |reading: usize| {
        let error = |drawn: &Vec<Option<f64>>| drawn.get(reading).copied().flatten();
        let mut sorted: Vec<f64> =
            all.iter().map(|drawn| error(drawn).unwrap_or(f64::INFINITY)).collect();
        sorted.sort_by(f64::total_cmp);
        let within = (WITHIN * sorted.len() as f64).ceil() as usize - 1;
        Some(sorted[within]).filter(|v| v.is_finite())
    };
    (0..readings).map(bound).collect()
}

/// A hand that draws on the mechanism's paper: exactly, or with a pencil that misses. It marks
/// every given place and lays every given direction once, however often the construction uses them.
#[derive(Clone, Debug)]
pub struct Hand {
    /// Units of the drawing's places per millimetre of paper.
    per_mm: f64,
    pencil: RefCell<Option<Blunt>>,
    laid: RefCell<Vec<(Point, Point)>>,
    ruled: RefCell<Vec<(Vec2, Vec2)>>,
    /// The decisions of the exact drawing: those taken so far, or those that follow.
    decisions: RefCell<VecDeque<bool>>,
}

impl Default for Hand {
    /// Returns the exact hand.
    fn default() -> Hand {
        Hand {
            per_mm: 1.0,
            pencil: RefCell::default(),
            laid: RefCell::default(),
            ruled: RefCell::default(),
            decisions: RefCell::default(),
        }
    }
}

impl Hand {
    /// Returns a hand with a pencil; the places of the drawing have `per_mm` units per millimetre
    /// of paper.
    pub fn with(pencil: Blunt, per_mm: f64) -> Hand {
        Hand { per_mm, pencil: RefCell::new(Some(pencil)), ..Hand::default() }
    }

    /// Returns a hand with a pencil that repeats the drawing of the exact hand `self`, with its
    /// decisions.
    pub fn again(&self, pencil: Blunt, per_mm: f64) -> Hand {
        Hand { decisions: self.decisions.clone(), ..Hand::with(pencil, per_mm) }
    }

    /// Decides between two ways to continue a drawing. The exact hand decides by the numbers; a
    /// hand that repeats a drawing decides as the exact one did, so that its marks miss but its
    /// construction is the same.
    pub fn decide(&self, now: bool) -> bool {
        let mut decisions = self.decisions.borrow_mut();
        if self.misses() {
            return decisions.pop_front().unwrap_or(now);
        }
        decisions.push_back(now);
        now
    }

    /// True if its marks miss.
    pub fn misses(&self) -> bool {
        self.pencil.borrow().is_some()
    }

    /// Returns the mark for an intended place.
    pub fn mark(&self, at: Point) -> Point {
        match self.pencil.borrow_mut().as_mut() {
            Some(pencil) => {
                at + pencil.mark(DiagramKind::Plane, Point::ORIGIN).to_vec2() * self.per_mm
            }
            None => at,
        }
    }

    /// Returns the mark of a given place. A place that has a mark keeps it.
    pub fn given(&self, place: Point) -> Point {
        self.laid_off(place, place)
    }

    /// Returns the mark of a given place under another key: the place as it is written.
    pub fn laid_off(&self, key: Point, at: Point) -> Point {
        if let Some((_, mark)) = self.laid.borrow().iter().find(|(known, _)| *known == key) {
            return *mark;
        }
        let mark = self.mark(at);
        self.laid.borrow_mut().push((key, mark));
        mark
    }

    /// Returns the direction of a ruler along a given unit vector, laid at two marks `apart` apart.
    pub fn ruler(&self, u: Vec2, apart: f64) -> Vec2 {
        if let Some((_, ruled)) = self.ruled.borrow().iter().find(|(known, _)| *known == u) {
            return *ruled;
        }
        let ruled = self
            .pencil
            .borrow_mut()
            .as_mut()
            .map_or(u, |p| p.ruler(DiagramKind::Plane, u, apart / self.per_mm));
        self.ruled.borrow_mut().push((u, ruled));
        ruled
    }
}

/// The pencil of single precision: rounds every drawn number to f32.
#[derive(Clone, Copy, Debug, Default)]
pub struct Single;

impl Pencil for Single {
    const EXACT: bool = false;

    fn mark(&mut self, _: DiagramKind, at: Point) -> Point {
        Point::new(f64::from(at.x as f32), f64::from(at.y as f32))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nineteen_of_twenty_marks_fall_within_the_error() {
        let mut pencil = Blunt::new(0.1, 7);
        let marks: Vec<Vec2> = (0..20_000)
            .map(|_| {
                pencil.mark(DiagramKind::Velocity, Point::new(3.0, 4.0)) - Point::new(3.0, 4.0)
            })
            .collect();
        let within = marks.iter().filter(|m| m.norm() <= 0.1).count() as f64 / marks.len() as f64;
        // Three standard deviations of a share of 0.95 in 20 000: 0.005.
        assert!((within - WITHIN).abs() < 0.005, "{within}");
        let mean = marks.iter().fold(Vec2::ZERO, |s, m| s + *m) * (1.0 / marks.len() as f64);
        assert!(mean.norm() < 0.1 / radius_in_deviations() * 4.0 / 20_000f64.sqrt(), "{mean:?}");
    }

    #[test]
    fn the_same_seed_draws_the_same() {
        let draw = |seed| Blunt::new(0.5, seed).mark(DiagramKind::Plane, Point::ORIGIN);
        assert_eq!(draw(1), draw(1));
        assert_ne!(draw(1), draw(2));
        // A recorded value, so that a change of the generator or of its use shows.
        let at = draw(1);
        assert_eq!(
            (format!("{:.9}", at.x), format!("{:.9}", at.y)),
            ("0.073749692".into(), "0.086409678".into())
        );
    }

    #[test]
    fn a_ruler_between_far_marks_lies_truer() {
        let turn = |apart: f64| -> f64 {
            let mut pencil = Blunt::new(0.1, 3);
            (0..500)
                .map(|_| {
                    pencil.ruler(DiagramKind::Velocity, Vec2::new(1.0, 0.0), apart).angle().powi(2)
                })
                .sum::<f64>()
                .sqrt()
        };
        assert!((turn(10.0) / turn(100.0) - 10.0).abs() < 0.1);
    }
}
