//! The motion as a power series in time, and the residual of each position equation for it, order by order.
//!
//! With c₁ = q̇ and c₂ = q̈/2, the orders t and t² repeat the equation's row and its γ. The higher
//! orders determine the motion if the Jacobian is singular.

use super::jet::Jet;
use super::relation::{Handle, Relation};
use hodograph_base::geom::Vec2;

/// For each unknown the known coefficients of t, t², …
pub(super) struct Motion {
    terms: Vec<Vec<f64>>,
}

/// A vector that changes with time.
struct Moving {
    x: Jet,
    y: Jet,
}

impl Moving {
    fn constant(v: Vec2, order: usize) -> Moving {
        Moving { x: Jet::constant(v.x, order), y: Jet::constant(v.y, order) }
    }

    /// Returns a vector turned by the angle (cos, sin).
    fn turned(v: Vec2, (c, s): &(Jet, Jet)) -> Moving {
        Moving { x: c.scaled(v.x).minus(&s.scaled(v.y)), y: s.scaled(v.x).plus(&c.scaled(v.y)) }
    }

    fn plus(&self, o: &Moving) -> Moving {
        Moving { x: self.x.plus(&o.x), y: self.y.plus(&o.y) }
    }

    fn minus(&self, o: &Moving) -> Moving {
        Moving { x: self.x.minus(&o.x), y: self.y.minus(&o.y) }
    }

    fn dot(&self, o: &Moving) -> Jet {
        self.x.times(&o.x).plus(&self.y.times(&o.y))
    }

    fn cross(&self, o: &Moving) -> Jet {
        self.x.times(&o.y).minus(&self.y.times(&o.x))
    }
}

impl Motion {
    /// Returns a motion of `unknowns` unknowns with no known terms.
    pub fn new(unknowns: usize) -> Motion {
        Motion { terms: vec![Vec::new(); unknowns] }
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

    fn unknown(&self, i: usize, order: usize) -> Jet {
        Jet::from_rest(self.terms[i].iter().copied(), order)
    }

    /// Returns the angle through which a body has turned.
    fn angle(&self, h: Handle, order: usize) -> Jet {
        match h.first {
            Some(i) if h.turns => self.unknown(i + 2, order),
            _ => Jet::constant(0.0, order),
        }
    }

    /// Returns the displacement of a point of a body.
    fn way(&self, h: Handle, order: usize) -> Moving {
        let Some(i) = h.first else { return Moving::constant(Vec2::ZERO, order) };
        let origin = Moving { x: self.unknown(i, order), y: self.unknown(i + 1, order) };
        if !h.turns {
            return origin;
        }
        let arm = Moving::turned(h.r, &self.angle(h, order).cos_sin());
        origin.plus(&arm.minus(&Moving::constant(h.r, order)))
    }

    /// Returns the residual of an equation in t^n, n from 1 on: the row times the terms c_n, plus
    /// the contributions of the lower terms and the drivers.
    pub fn residual(&self, relation: &Relation, n: usize) -> f64 {
        let driven = |drive: [f64; 2]| Jet::from_rest([drive[0], 0.5 * drive[1]].into_iter(), n);
        let from = |d: Vec2, p: Handle, q: Handle| Moving::constant(d, n).plus(&self.way(p, n).minus(&self.way(q, n)));
        let left = match *relation {
            Relation::Meet { p, q, k } => from(Vec2::ZERO, p, q).dot(&Moving::constant(k, n)),
            Relation::Turn { a, b, drive } => self.angle(a, n).minus(&self.angle(b, n)).minus(&driven(drive)),
            Relation::Along { p, q, k, arm, drive } => {
                let k = Moving::turned(k, &self.angle(q, n).cos_sin());
                from(arm, p, q).dot(&k).minus(&driven(drive))
            }
            Relation::Distance { p, q, d, drive } => {
                // (|P − Q|² − l(t)²) / 2l.
                let (now, l) = (from(d, p, q), d.norm());
                let length = Jet::constant(l, n).plus(&driven(drive));
                now.dot(&now).minus(&length.times(&length)).scaled(0.5 / l)
            }
            Relation::Roll { bodies: [a, b], weights: [u, w], p, q, d } => {
                let theta = self.angle(a, n).scaled(u / (u + w)).plus(&self.angle(b, n).scaled(w / (u + w)));
                let line = Moving::turned(d, &theta.cos_sin());
                line.cross(&from(d, p, q)).scaled(-(u + w) / d.norm2())
            }
            Relation::Track { body, rho, p, q, k, arm } => {
                let k = Moving::turned(k, &self.angle(q, n).cos_sin());
                from(arm, p, q).dot(&k).plus(&self.angle(body, n).minus(&self.angle(q, n)).scaled(rho))
            }
            Relation::Line { body, p, q, d, drive } => {
                let line = Moving::turned(d, &self.angle(body, n).plus(&driven(drive)).cos_sin());
                line.cross(&from(d, p, q)).scaled(1.0 / d.norm2())
            }
        };
        left.term(n)
    }
}

#[cfg(test)]
mod tests {
    use super::{Motion, Relation};
    use crate::rows::Layout;
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
            let layout = Layout::new(&scene, &m, &at, &demand, Level::Velocity);
            let mut motion = Motion::new(layout.unknowns);
            // Any rates and accelerations are suitable; these repeat after a prime number.
            let rate = |u: usize| ((7 * u + 3) % 13) as f64 / 13.0 - 0.5;
            let acceleration = |u: usize| ((5 * u + 1) % 11) as f64 / 11.0 - 0.4;
            for u in 0..layout.unknowns {
                motion.set(u, 1, rate(u));
                motion.set(u, 2, 0.5 * acceleration(u));
            }
            let rates = DVector::from_iterator(layout.unknowns, (0..layout.unknowns).map(rate));
            for row in layout.rows(&scene, &at) {
                let sum = |of: &dyn Fn(usize) -> f64| row.coefficients.iter().map(|(u, c)| c * of(*u)).sum::<f64>();
                let first = sum(&rate) - row.rate;
                let second = 0.5 * (sum(&acceleration) - row.acceleration(&rates));
                let [one, two] = [1, 2].map(|n| motion.residual(&row.relation, n));
                let size = 1.0 + first.abs() + second.abs() + row.rate.abs() + row.acceleration(&rates).abs();
                // Along a driven arc the hand-written γ omits d·v, which another row makes zero.
                let slides = matches!(row.relation, Relation::Line { drive, .. } if drive != [0.0; 2]);
                assert!((one - first).abs() < 1e-13 * size, "{}: {one} {first}", t.name);
                assert!(slides || (two - second).abs() < 1e-13 * size, "{}: {two} {second}", t.name);
                kinds[match row.relation {
                    Relation::Meet { .. } => 0,
                    Relation::Turn { .. } => 1,
                    Relation::Along { .. } => 2,
                    Relation::Distance { .. } => 3,
                    Relation::Line { .. } => 4,
                    Relation::Roll { .. } => 5,
                    Relation::Track { .. } => 6,
                }] += 1;
            }
        }
        assert!(kinds.iter().all(|n| *n > 0), "an equation that no template has: {kinds:?}");
    }
}
