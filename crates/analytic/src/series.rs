//! The motion as a power series in time, and the residual of each position equation for it, order
//! by order.
//!
//! With c₁ = q̇ and c₂ = q̈/2, the orders t and t² repeat the equation's row and its γ. The higher
//! orders determine the motion if the Jacobian is singular.

use super::jet::TaylorJet;
use super::relation::{BodyPoint, PositionEquation};
use hodograph_base::geom::Vec2;

/// For each unknown the known coefficients of t, t², …
pub(super) struct MotionSeries {
    terms: Vec<Vec<f64>>,
}

/// A vector that changes with time.
struct VectorSeries {
    x: TaylorJet,
    y: TaylorJet,
}

impl VectorSeries {
    fn constant(v: Vec2, order: usize) -> VectorSeries {
        VectorSeries { x: TaylorJet::constant(v.x, order), y: TaylorJet::constant(v.y, order) }
    }

    /// Returns a vector turned by the angle (cos, sin).
    fn turned(v: Vec2, (c, s): &(TaylorJet, TaylorJet)) -> VectorSeries {
        VectorSeries {
            x: c.scaled(v.x).minus(&s.scaled(v.y)),
            y: s.scaled(v.x).plus(&c.scaled(v.y)),
        }
    }

    fn plus(&self, o: &VectorSeries) -> VectorSeries {
        VectorSeries { x: self.x.plus(&o.x), y: self.y.plus(&o.y) }
    }

    fn minus(&self, o: &VectorSeries) -> VectorSeries {
        VectorSeries { x: self.x.minus(&o.x), y: self.y.minus(&o.y) }
    }

    fn dot(&self, o: &VectorSeries) -> TaylorJet {
        self.x.times(&o.x).plus(&self.y.times(&o.y))
    }

    fn cross(&self, o: &VectorSeries) -> TaylorJet {
        self.x.times(&o.y).minus(&self.y.times(&o.x))
    }
}

impl MotionSeries {
    /// Returns a motion of `unknowns` unknowns with no known terms.
    pub fn new(unknowns: usize) -> MotionSeries {
        MotionSeries { terms: vec![Vec::new(); unknowns] }
    }

    /// Returns the number of known terms of an unknown.
    pub fn order(&self, unknown: usize) -> usize {
        self.terms[unknown].len()
    }

    /// Returns the coefficient of t^n, n from 1 on; zero if it is not known.
    pub fn term(&self, unknown: usize, n: usize) -> f64 {
        self.terms[unknown].get(n - 1).copied().unwrap_or(0.0)
    }

    /// Sets the coefficient of t^n; all lower ones are already set.
    pub fn set(&mut self, unknown: usize, n: usize, value: f64) {
        self.terms[unknown].truncate(n - 1);
        self.terms[unknown].push(value);
    }

    /// Removes all terms of an unknown.
    pub fn forget(&mut self, unknown: usize) {
        self.terms[unknown].clear();
    }

    fn unknown(&self, i: usize, order: usize) -> TaylorJet {
        TaylorJet::from_rest(self.terms[i].iter().copied(), order)
    }

    /// Returns the angle through which a body has turned.
    fn angle(&self, h: BodyPoint, order: usize) -> TaylorJet {
        match h.first {
            Some(i) if h.turns => self.unknown(i + 2, order),
            _ => TaylorJet::constant(0.0, order),
        }
    }

    /// Returns the displacement of a point of a body.
    fn way(&self, h: BodyPoint, order: usize) -> VectorSeries {
        let Some(i) = h.first else { return VectorSeries::constant(Vec2::ZERO, order) };
        let origin = VectorSeries { x: self.unknown(i, order), y: self.unknown(i + 1, order) };
        if !h.turns {
            return origin;
        }
        let arm = VectorSeries::turned(h.r, &self.angle(h, order).cos_sin());
        origin.plus(&arm.minus(&VectorSeries::constant(h.r, order)))
    }

    /// Returns the residual of an equation in t^n, n from 1 on: the row times the terms c_n, plus
    /// the contributions of the lower terms and the drivers.
    pub fn residual(&self, relation: &PositionEquation, n: usize) -> f64 {
        let driven =
            |drive: [f64; 2]| TaylorJet::from_rest([drive[0], 0.5 * drive[1]].into_iter(), n);
        let from = |d: Vec2, p: BodyPoint, q: BodyPoint| {
            VectorSeries::constant(d, n).plus(&self.way(p, n).minus(&self.way(q, n)))
        };
        let left = match *relation {
            PositionEquation::Meet { p, q, k } => {
                from(Vec2::ZERO, p, q).dot(&VectorSeries::constant(k, n))
            }
            PositionEquation::Turn { a, b, drive } => {
                self.angle(a, n).minus(&self.angle(b, n)).minus(&driven(drive))
            }
            PositionEquation::Along { p, q, k, arm, drive } => {
                let k = VectorSeries::turned(k, &self.angle(q, n).cos_sin());
                from(arm, p, q).dot(&k).minus(&driven(drive))
            }
            PositionEquation::Distance { p, q, d, drive } => {
                // (|P − Q|² − l(t)²) / 2l.
                let (now, l) = (from(d, p, q), d.norm());
                let length = TaylorJet::constant(l, n).plus(&driven(drive));
                now.dot(&now).minus(&length.times(&length)).scaled(0.5 / l)
            }
            PositionEquation::Roll { bodies: [a, b], weights: [u, w], p, q, d } => {
                let theta = self
                    .angle(a, n)
                    .scaled(u / (u + w))
                    .plus(&self.angle(b, n).scaled(w / (u + w)));
                let line = VectorSeries::turned(d, &theta.cos_sin());
                line.cross(&from(d, p, q)).scaled(-(u + w) / d.norm2())
            }
            PositionEquation::Track { body, rho, p, q, k, arm } => {
                let k = VectorSeries::turned(k, &self.angle(q, n).cos_sin());
                from(arm, p, q)
                    .dot(&k)
                    .plus(&self.angle(body, n).minus(&self.angle(q, n)).scaled(rho))
            }
            PositionEquation::Line { body, p, q, d, drive } => {
                let line =
                    VectorSeries::turned(d, &self.angle(body, n).plus(&driven(drive)).cos_sin());
                line.cross(&from(d, p, q)).scaled(1.0 / d.norm2())
            }
        };
        left.term(n)
    }
}

#[cfg(test)]
mod tests {
    use super::{MotionSeries, PositionEquation};
    use crate::rows::UnknownLayout;
    use hodograph_mechanism::mechanism::{Demand, Level, Mechanism};
    use hodograph_scene::{read, templates};
    use nalgebra::DVector;

    /// The terms of t and t² equal the rows and their γ, which are differentiated by hand.
    #[test]
    fn the_first_two_terms_are_the_rows() {
        let mut kinds = [0; 7];
        for t in templates::list() {
            let scene = read(templates::get(t.name).unwrap()).unwrap().value;
            let m = Mechanism::new(&scene).unwrap().value;
            let demand = Demand::of(&scene, &m);
            let at = hodograph_mechanism::position::configure(&scene, &m, &demand).unwrap().value;
            let layout = UnknownLayout::new(&scene, &m, &at, &demand, Level::Velocity);
            let mut motion = MotionSeries::new(layout.unknowns);
            // Any rates and accelerations are suitable; these repeat after a prime number.
            let rate = |u: usize| ((7 * u + 3) % 13) as f64 / 13.0 - 0.5;
            let acceleration = |u: usize| ((5 * u + 1) % 11) as f64 / 11.0 - 0.4;
            for u in 0..layout.unknowns {
                motion.set(u, 1, rate(u));
                motion.set(u, 2, 0.5 * acceleration(u));
            }
            let rates = DVector::from_iterator(layout.unknowns, (0..layout.unknowns).map(rate));
            for row in layout.rows(&scene, &at) {
                let sum = |of: &dyn Fn(usize) -> f64| {
                    row.coefficients.iter().map(|(u, c)| c * of(*u)).sum::<f64>()
                };
                let first = sum(&rate) - row.rate;
                let second = 0.5 * (sum(&acceleration) - row.acceleration(&rates));
                let [one, two] = [1, 2].map(|n| motion.residual(&row.relation, n));
                let size = 1.0
                    + first.abs()
                    + second.abs()
                    + row.rate.abs()
                    + row.acceleration(&rates).abs();
                // Along a driven arc the hand-written γ omits d·v, which another row makes zero.
                let slides = matches!(row.relation, PositionEquation::Line { drive, .. } if drive != [0.0; 2]);
                assert!((one - first).abs() < 1e-13 * size, "{}: {one} {first}", t.name);
                assert!(
                    slides || (two - second).abs() < 1e-13 * size,
                    "{}: {two} {second}",
                    t.name
                );
                kinds[match row.relation {
                    PositionEquation::Meet { .. } => 0,
                    PositionEquation::Turn { .. } => 1,
                    PositionEquation::Along { .. } => 2,
                    PositionEquation::Distance { .. } => 3,
                    PositionEquation::Line { .. } => 4,
                    PositionEquation::Roll { .. } => 5,
                    PositionEquation::Track { .. } => 6,
                }] += 1;
            }
        }
        assert!(kinds.iter().all(|n| *n > 0), "an equation that no template has: {kinds:?}");
    }
}
