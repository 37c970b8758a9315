//! A position equation and its derivatives: the row, γ, and (in [`super::series`]) any higher
//! order.
//!
//! Each row: Σ c_k q̇_k = rate, and Σ c_k q̈_k = γ(q̇), where γ collects the terms of the second
//! derivative without q̈.

use hodograph_base::geom::Vec2;
use hodograph_scene::{GuideId, PointId, RollingId};
use nalgebra::DVector;

/// One equation.
pub(super) struct EquationRow {
    /// (unknown, coefficient); an unknown may occur twice.
    pub coefficients: Vec<(usize, f64)>,
    /// Right-hand side of the velocity equation.
    pub rate: f64,
    /// The position equation.
    pub relation: PositionEquation,
    /// The pair or driver to which the equation belongs.
    pub of: EquationPair,
}

impl EquationRow {
    pub fn acceleration(&self, rates: &DVector<f64>) -> f64 {
        self.relation.gamma(rates)
    }

    /// Returns the row with t² for t, for drivers that start from rest: they move by ½ s̈ t².
    pub fn started(&self) -> EquationRow {
        let mut relation = self.relation;
        if let Some(drive) = relation.drive_mut() {
            *drive = [0.5 * drive[1], 0.0];
        }
        EquationRow {
            coefficients: self.coefficients.clone(),
            rate: relation.drive()[0],
            relation,
            of: self.of,
        }
    }
}

/// The pair or driver that an equation belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum EquationPair {
    /// Two links, or a link and a bare pin, meet at a point.
    Pin(PointId),
    /// A runner and its guide.
    Guide(GuideId),
    /// A driver (index).
    Driver(usize),
    /// A rolling pair.
    Rolling(RollingId),
}

/// A position equation. Lengths are scaled; `drive` is the first and second derivative of the
/// driver's contribution.
#[derive(Clone, Copy)]
pub(super) enum PositionEquation {
    /// k·(P − Q) = 0 with k fixed in the plane.
    Meet { p: BodyPoint, q: BodyPoint, k: Vec2 },
    /// φ_a − φ_b is prescribed.
    Turn { a: BodyPoint, b: BodyPoint, drive: [f64; 2] },
    /// k·(P − Q) is prescribed, k fixed in the body of Q; `arm` is the present P − Q.
    Along { p: BodyPoint, q: BodyPoint, k: Vec2, arm: Vec2, drive: [f64; 2] },
    /// |P − Q| is prescribed; `d` is the present P − Q.
    Distance { p: BodyPoint, q: BodyPoint, d: Vec2, drive: [f64; 2] },
    /// The angle of P − Q, measured from `body`, is prescribed; `d` is the present P − Q.
    Line { body: BodyPoint, p: BodyPoint, q: BodyPoint, d: Vec2, drive: [f64; 2] },
    /// w₁(φ_a − β) + w₂(φ_b − β) is constant, β the angle of P − Q, and `d` the present P − Q: two
    /// circles roll.
    Roll { bodies: [BodyPoint; 2], weights: [f64; 2], p: BodyPoint, q: BodyPoint, d: Vec2 },
    /// k·(P − Q) + ρ(φ_b − φ_q) is constant, k fixed in the body of Q, and `arm` the present P − Q:
    /// a wheel rolls on a straight track.
    Track { body: BodyPoint, rho: f64, p: BodyPoint, q: BodyPoint, k: Vec2, arm: Vec2 },
}

impl PositionEquation {
    fn drive_mut(&mut self) -> Option<&mut [f64; 2]> {
        match self {
            PositionEquation::Meet { .. }
            | PositionEquation::Roll { .. }
            | PositionEquation::Track { .. } => None,
            PositionEquation::Turn { drive, .. }
            | PositionEquation::Along { drive, .. }
            | PositionEquation::Distance { drive, .. }
            | PositionEquation::Line { drive, .. } => Some(drive),
        }
    }

    /// Returns the first and second derivative of the driver's contribution.
    pub fn drive(mut self) -> [f64; 2] {
        self.drive_mut().copied().unwrap_or_default()
    }

    /// Returns the size of the coefficient of an unknown in the poses in which it is largest; a
    /// pose may reduce it to zero. 0 for an unknown that does not occur in the equation.
    pub fn reach(&self, unknown: usize) -> f64 {
        let of = |h: BodyPoint, arm: f64| match h.first {
            Some(i) if i == unknown || i + 1 == unknown => 1.0,
            Some(i) if h.turns && i + 2 == unknown => arm,
            _ => 0.0,
        };
        let turns = |h: BodyPoint| {
            if h.first.is_some_and(|i| h.turns && i + 2 == unknown) { 1.0 } else { 0.0f64 }
        };
        match *self {
            PositionEquation::Roll { bodies: [a, b], weights: [u, w], p, q, d } => {
                let line = (u + w).abs() * of(p, p.r.norm()).max(of(q, q.r.norm())) / d.norm();
                line.max(u.abs() * turns(a)).max(w.abs() * turns(b))
            }
            PositionEquation::Track { body, rho, p, q, arm, .. } => of(p, p.r.norm())
                .max(of(q, q.r.norm().max(arm.norm())))
                .max(rho.abs() * turns(body).max(turns(q))),
            PositionEquation::Meet { p, q, .. } | PositionEquation::Distance { p, q, .. } => {
                of(p, p.r.norm()).max(of(q, q.r.norm()))
            }
            PositionEquation::Turn { a, b, .. } => turns(a).max(turns(b)),
            PositionEquation::Along { p, q, arm, .. } => {
                of(p, p.r.norm()).max(of(q, q.r.norm().max(arm.norm())))
            }
            PositionEquation::Line { body, p, q, d, .. } => {
                let turned = if body.first.is_some_and(|i| i + 2 == unknown) { 1.0 } else { 0.0 };
                (of(p, p.r.norm()).max(of(q, q.r.norm())) / d.norm()).max(turned)
            }
        }
    }

    /// Returns the terms of the second derivative without the second derivatives of the unknowns,
    /// moved to the right-hand side.
    fn gamma(&self, x: &DVector<f64>) -> f64 {
        match *self {
            PositionEquation::Meet { p, q, k } => k.dot(q.bias(x) - p.bias(x)),
            PositionEquation::Turn { drive, .. } => drive[1],
            // d²/dt²: k·(a_P − a_Q) + α k⊥·(P − Q) + 2ω k⊥·(v_P − v_Q) − ω² k·(P − Q) = s̈.
            PositionEquation::Along { p, q, k, arm, drive } => {
                let w = q.omega(x);
                drive[1]
                    - k.dot(p.bias(x) - q.bias(x))
                    - 2.0 * w * k.perp().dot(p.velocity(x) - q.velocity(x))
                    + w * w * k.dot(arm)
            }
            // d·(a_P − a_Q) + |v_P − v_Q|² = l̇² + l l̈, divided by l.
            PositionEquation::Distance { p, q, d, drive } => {
                let l = d.norm();
                let u = d * (1.0 / l);
                let v = p.velocity(x) - q.velocity(x);
                drive[1] - u.dot(p.bias(x) - q.bias(x)) + (drive[0] * drive[0] - v.norm2()) / l
            }
            // The formula of a line that turns with θ = (w₁φ_a + w₂φ_b)/(w₁ + w₂).
            PositionEquation::Roll { bodies: [a, b], weights: [u, w], p, q, d } => {
                let l2 = d.norm2();
                let v = p.velocity(x) - q.velocity(x);
                let turned = u * a.omega(x) + w * b.omega(x);
                (u + w) * d.perp().dot(p.bias(x) - q.bias(x)) / l2 - 2.0 * turned * d.dot(v) / l2
            }
            PositionEquation::Track { p, q, k, arm, .. } => {
                PositionEquation::Along { p, q, k, arm, drive: [0.0; 2] }.gamma(x)
            }
            // α l² + 2 ω d·(v_P − v_Q) = d × (a_P − a_Q).
            PositionEquation::Line { body, p, q, d, drive } => {
                let l2 = d.norm2();
                let k = d.perp() * (1.0 / l2);
                let v = p.velocity(x) - q.velocity(x);
                2.0 * body.omega(x) * d.dot(v) / l2 - k.dot(p.bias(x) - q.bias(x)) + drive[1]
            }
        }
    }
}

/// A point of a body, as a function of the unknowns: v = v₀ + ω r⊥.
#[derive(Clone, Copy)]
pub(super) struct BodyPoint {
    /// First unknown of the body (vx, vy, ω), or of a bare pin (vx, vy); `None` for ground.
    pub first: Option<usize>,
    pub turns: bool,
    /// Vector from the origin of the body.
    pub r: Vec2,
}

impl BodyPoint {
    /// Adds k·v to a row.
    pub fn add(&self, row: &mut Vec<(usize, f64)>, k: Vec2) {
        let Some(i) = self.first else { return };
        row.push((i, k.x));
        row.push((i + 1, k.y));
        if self.turns {
            row.push((i + 2, k.dot(self.r.perp())));
        }
    }

    fn omega(&self, q: &DVector<f64>) -> f64 {
        match self.first {
            Some(i) if self.turns => q[i + 2],
            _ => 0.0,
        }
    }

    pub fn velocity(&self, q: &DVector<f64>) -> Vec2 {
        let Some(i) = self.first else { return Vec2::ZERO };
        Vec2::new(q[i], q[i + 1]) + self.r.perp() * self.omega(q)
    }

    /// Returns the part of the acceleration that is not linear in q̈: −ω² r.
    fn bias(&self, q: &DVector<f64>) -> Vec2 {
        let w = self.omega(q);
        self.r * -(w * w)
    }
}

/// k·(P − Q) = s(t) with k fixed in the body of Q: k·(v_P − v_Q) + ω k⊥·(P − Q) = ṡ.
pub(super) fn projection(
    p: BodyPoint,
    q: BodyPoint,
    k: Vec2,
    arm: Vec2,
    drive: [f64; 2],
    of: EquationPair,
) -> EquationRow {
    let mut c = Vec::new();
    p.add(&mut c, k);
    q.add(&mut c, -k);
    if let (Some(i), true) = (q.first, q.turns) {
        c.push((i + 2, k.perp().dot(arm)));
    }
    EquationRow {
        coefficients: c,
        rate: drive[0],
        relation: PositionEquation::Along { p, q, k, arm, drive },
        of,
    }
}

/// |P − Q|² = l(t)², halved: d·(v_P − v_Q) = l l̇; divided by l.
pub(super) fn distance(
    p: BodyPoint,
    q: BodyPoint,
    d: Vec2,
    drive: [f64; 2],
    of: EquationPair,
) -> EquationRow {
    let u = d * (1.0 / d.norm());
    let mut c = Vec::new();
    p.add(&mut c, u);
    q.add(&mut c, -u);
    EquationRow {
        coefficients: c,
        rate: drive[0],
        relation: PositionEquation::Distance { p, q, d, drive },
        of,
    }
}

/// Rotation of the line Q→P relative to a body, constant or with a prescribed rate ψ̇: (ω_body +
/// ψ̇) l² = d × (v_P − v_Q).
pub(super) fn along_line(
    body: BodyPoint,
    p: BodyPoint,
    q: BodyPoint,
    d: Vec2,
    drive: [f64; 2],
    of: EquationPair,
) -> EquationRow {
    let k = d.perp() * (1.0 / d.norm2());
    let mut c = Vec::new();
    p.add(&mut c, k);
    q.add(&mut c, -k);
    if let Some(i) = body.first {
        c.push((i + 2, -1.0));
    }
    EquationRow {
        coefficients: c,
        rate: drive[0],
        relation: PositionEquation::Line { body, p, q, d, drive },
        of,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three bodies; the third occurs in no equation.
    const UNKNOWNS: usize = 9;
    const STEP: f64 = 1e-5;

    fn turned(v: Vec2, by: f64) -> Vec2 {
        v.rotate_by(Vec2::from_angle(by))
    }

    /// The constant or prescribed quantity of an equation as a function of small motions of the
    /// bodies: by the definitions of [`PositionEquation`].
    fn kept(relation: &PositionEquation, x: &[f64; UNKNOWNS]) -> f64 {
        let turn = |h: &BodyPoint| h.first.filter(|_| h.turns).map_or(0.0, |i| x[i + 2]);
        let moved = |h: &BodyPoint| {
            let i = h.first.unwrap();
            Vec2::new(x[i], x[i + 1]) + turned(h.r, turn(h)) - h.r
        };
        let between = |p: &BodyPoint, q: &BodyPoint, d: Vec2| d + moved(p) - moved(q);
        // The angle through which a line has turned.
        let swung = |d: Vec2, now: Vec2| d.cross(now).atan2(d.dot(now));
        match relation {
            PositionEquation::Meet { p, q, k } => k.dot(moved(p) - moved(q)),
            PositionEquation::Turn { a, b, .. } => turn(a) - turn(b),
            PositionEquation::Along { p, q, k, arm, .. } => {
                turned(*k, turn(q)).dot(between(p, q, *arm))
            }
            PositionEquation::Distance { p, q, d, .. } => between(p, q, *d).norm(),
            PositionEquation::Line { body, p, q, d, .. } => {
                swung(*d, between(p, q, *d)) - turn(body)
            }
            PositionEquation::Roll { bodies: [a, b], weights: [u, w], p, q, d } => {
                let beta = swung(*d, between(p, q, *d));
                u * (turn(a) - beta) + w * (turn(b) - beta)
            }
            PositionEquation::Track { body, rho, p, q, k, arm } => {
                turned(*k, turn(q)).dot(between(p, q, *arm)) + rho * (turn(body) - turn(q))
            }
        }
    }

    /// A relation of each kind, with its bodies and lines turned to a given pose, and its unknowns.
    fn in_pose(pose: usize, size: f64) -> Vec<(PositionEquation, &'static [usize])> {
        let at = |k: f64| Vec2::from_angle(pose as f64 * k);
        let p = BodyPoint { first: Some(0), turns: true, r: at(2.4) * (0.7 * size) };
        let q = BodyPoint { first: Some(3), turns: true, r: at(3.9) * (1.9 * size) };
        let (d, k, drive) = (at(1.7) * (1.3 * size), at(5.1), [0.0; 2]);
        let pin = BodyPoint { turns: false, ..q };
        let mut all: Vec<(PositionEquation, &[usize])> = vec![
            (PositionEquation::Meet { p, q, k }, &[0, 1, 2, 3, 4, 5]),
            (PositionEquation::Meet { p, q: pin, k }, &[0, 1, 2, 3, 4]),
            (PositionEquation::Turn { a: p, b: q, drive }, &[2, 5]),
            (PositionEquation::Along { p, q, k, arm: d, drive }, &[0, 1, 2, 3, 4, 5]),
            (PositionEquation::Distance { p, q, d, drive }, &[0, 1, 2, 3, 4, 5]),
            (PositionEquation::Line { body: p, p, q, d, drive }, &[0, 1, 2, 3, 4, 5]),
        ];
        for sign in [1.0, -1.0] {
            all.push((
                PositionEquation::Roll { bodies: [p, q], weights: [1.0, sign * 0.25], p, q, d },
                &[0, 1, 2, 3, 4, 5],
            ));
            all.push((
                PositionEquation::Track { body: p, rho: sign * 2.9 * size, p, q, k, arm: d },
                &[0, 1, 2, 3, 4, 5],
            ));
        }
        all
    }

    /// [`PositionEquation::reach`] equals the largest coefficient in all poses, from finite
    /// differences, except for the sum of its up to four parts.
    #[test]
    fn coefficients_reach_as_far_as_is_said() {
        for size in [0.2, 1.0, 6.0] {
            for kind in 0..in_pose(0, size).len() {
                for unknown in 0..UNKNOWNS {
                    let (mut most, mut said) = (0.0f64, 0.0f64);
                    for pose in 0..300 {
                        let (relation, _) = in_pose(pose, size)[kind];
                        let [ahead, behind] = [STEP, -STEP].map(|by| {
                            let mut x = [0.0; UNKNOWNS];
                            x[unknown] = by;
                            kept(&relation, &x)
                        });
                        most = most.max((ahead - behind).abs() / (2.0 * STEP));
                        said = relation.reach(unknown);
                    }
                    let has = in_pose(0, size)[kind].1.contains(&unknown);
                    assert_eq!(
                        has,
                        said != 0.0,
                        "kind {kind}, size {size}, unknown {unknown}: {said}"
                    );
                    assert!(
                        most <= 4.0 * said + 1e-9 && said <= 1.5 * most + 1e-9,
                        "kind {kind}, size {size}, unknown {unknown}: the largest is {most}, {said} is said"
                    );
                }
            }
        }
    }
}
