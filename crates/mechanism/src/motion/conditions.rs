//! The conditions of pairs and drivers on the motion of one group, and their solution.
//!
//! The forms of pairs ([`PairForm`]) reduce to three: two points keep a distance; a point moves at
//! a given rate along a direction of a body; a body turns relative to another at a given rate. Each
//! is differentiated twice by hand. The same coefficients serve velocities, accelerations, and the
//! derivatives of the closure equations.
//!
//! Lengths are multiplied by a power of two near 1/(size of the group), so that the choice of
//! pivots depends neither on the unit nor on other placed groups: scaling a scene by 2^k changes no
//! digit, nor do further requests.

mod reactions;

pub(super) use reactions::{ActingForces, Reaction};

use super::{LinkMotion, MechanismMotion};
use crate::mechanism::{GraphNode, Group, Mechanism, PairForm, Runner};
use crate::position::kernel::power_of_two_scale;
use crate::position::{Configuration, Path};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_scene::exact::Inputs;
use hodograph_scene::{LinkId, PointId, RollingId, Scene, Touch};

/// A point of a body: of a body with known motion, or of an unknown of the group.
#[derive(Clone, Copy)]
enum ConditionPoint<N> {
    /// Motion of the point, rotation of its body, and the node of the body.
    Known(LinkMotion<N>, GraphNode),
    /// Unknowns (vx, vy, ω) from this index on, and the arm from the body's own point.
    Link(usize, Vec2<N>),
    /// Unknowns (vx, vy).
    Pin(usize),
}

impl<N: Real> ConditionPoint<N> {
    /// Adds ±k·v to a row; returns the sum of the known terms, which belong to the other side.
    fn add(&self, row: &mut [N], k: Vec2<N>) -> N {
        match *self {
            ConditionPoint::Known(m, _) => return -k.dot(m.v),
            ConditionPoint::Link(i, arm) => {
                row[i] = row[i] + k.x;
                row[i + 1] = row[i + 1] + k.y;
                row[i + 2] = row[i + 2] + k.dot(arm.perp());
            }
            ConditionPoint::Pin(i) => {
                row[i] = row[i] + k.x;
                row[i + 1] = row[i + 1] + k.y;
            }
        }
        N::from_f64(0.0)
    }

    fn omega(&self, q: &[N]) -> N {
        match *self {
            ConditionPoint::Known(m, _) => m.omega,
            ConditionPoint::Link(i, _) => q[i + 2],
            ConditionPoint::Pin(_) => N::from_f64(0.0),
        }
    }

    fn velocity(&self, q: &[N]) -> Vec2<N> {
        match *self {
            ConditionPoint::Known(m, _) => m.v,
            ConditionPoint::Link(i, arm) => Vec2::new(q[i], q[i + 1]) + arm.perp() * q[i + 2],
            ConditionPoint::Pin(i) => Vec2::new(q[i], q[i + 1]),
        }
    }

    /// Returns the part of the acceleration that is not linear in the unknown accelerations.
    fn bias(&self, q: &[N]) -> Vec2<N> {
        match *self {
            ConditionPoint::Known(m, _) => m.a,
            ConditionPoint::Link(i, arm) => arm * -(q[i + 2] * q[i + 2]),
            ConditionPoint::Pin(_) => Vec2::zero(),
        }
    }
}

/// One scalar condition.
enum MotionCondition<N> {
    /// k·(P relative to the body of Q, at the position of Q) changes at `rate`, `acceleration`; k
    /// is fixed in the body of Q, and P and Q coincide: k·(v_P − v_Q) = ṡ, k·(a_P − a_Q − 2ω_Q ×
    /// (v_P − v_Q)) = s̈.
    Along { p: ConditionPoint<N>, q: ConditionPoint<N>, k: Vec2<N>, rate: N, acceleration: N },
    /// The distance P − Q, times a weight w: u = w (P − Q), u·(v_P − v_Q) = w l l̇, u·(a_P − a_Q) +
    /// w |v_P − v_Q|² = w (l̇² + l l̈).
    Distance {
        p: ConditionPoint<N>,
        q: ConditionPoint<N>,
        u: Vec2<N>,
        weight: N,
        rate: N,
        acceleration: N,
    },
    /// The sum of the angular velocities of bodies, each multiplied by a constant factor.
    Turning { bodies: Vec<(ConditionPoint<N>, N)>, rate: N, acceleration: N },
}

impl<N: Real> MotionCondition<N> {
    /// Writes the coefficients into `row` and returns the right-hand side of the velocities.
    fn row(&self, row: &mut [N]) -> N {
        match self {
            MotionCondition::Along { p, q, k, rate, .. } => {
                *rate + p.add(row, *k) + q.add(row, -*k)
            }
            MotionCondition::Distance { p, q, u, rate, .. } => {
                *rate + p.add(row, *u) + q.add(row, -*u)
            }
            MotionCondition::Turning { bodies, rate, .. } => {
                let mut known = *rate;
                for (body, factor) in bodies {
                    match *body {
                        ConditionPoint::Known(m, _) => known = known - *factor * m.omega,
                        ConditionPoint::Link(i, _) => row[i + 2] = row[i + 2] + *factor,
                        ConditionPoint::Pin(_) => {}
                    }
                }
                known
            }
        }
    }

    /// Returns the right-hand side of the accelerations, with the velocities `x`.
    fn acceleration(&self, x: &[N]) -> N {
        match self {
            MotionCondition::Along { p, q, k, acceleration, .. } => {
                let relative = p.velocity(x) - q.velocity(x);
                let two = N::from_f64(2.0);
                *acceleration + two * q.omega(x) * k.dot(relative.perp())
                    - k.dot(p.bias(x) - q.bias(x))
            }
            MotionCondition::Distance { p, q, u, weight, acceleration, .. } => {
                let relative = p.velocity(x) - q.velocity(x);
                *acceleration - relative.norm2() * *weight - u.dot(p.bias(x) - q.bias(x))
            }
            MotionCondition::Turning { bodies, acceleration, .. } => {
                bodies.iter().fold(*acceleration, |sum, (body, factor)| match body {
                    ConditionPoint::Known(m, _) => sum - *factor * m.alpha,
                    ConditionPoint::Link(..) | ConditionPoint::Pin(_) => sum,
                })
            }
        }
    }
}

/// The system of one group.
pub(crate) struct Conditions<N> {
    links: Vec<(LinkId, Point<N>)>,
    pins: Vec<PointId>,
    list: Vec<MotionCondition<N>>,
    /// For each condition its constraint (index into [`Mechanism::constraints`]).
    of: Vec<usize>,
    /// Power of two that scales lengths to about one.
    scale: f64,
    unknowns: usize,
}

/// Builds the conditions of a group.
struct ConditionBuilder<'a, N> {
    scene: &'a Scene,
    at: &'a Configuration<N>,
    known: &'a MechanismMotion<N>,
    links: &'a [(LinkId, Point<N>)],
    pins: &'a [PointId],
    scale: N,
}

impl<N: Real> Conditions<N> {
    /// Creates the conditions of a group with known upstream motion.
    ///
    /// # Panics
    /// If the group or a part on which it depends is not placed; it is requested only where the
    /// demand places it.
    pub(super) fn of_group(
        scene: &Scene,
        m: &Mechanism,
        at: &Configuration<N>,
        inputs: &Inputs<N>,
        group: &Group,
        known: &MechanismMotion<N>,
    ) -> Conditions<N> {
        let links: Vec<(LinkId, Point<N>)> =
            group.links.iter().map(|&l| (l, own_point(scene, at, l))).collect();
        let pins = group.pins.clone();
        let scale = power_of_two_scale(extent(scene, m, at, group));
        let b = ConditionBuilder {
            scene,
            at,
            known,
            links: &links,
            pins: &pins,
            scale: N::from_f64(scale),
        };
        let (mut list, mut of) = (Vec::new(), Vec::new());
        for &c in &group.constraints {
            b.push(m.constraints[c].form(), inputs, &mut list);
            of.resize(list.len(), c);
        }
        let unknowns = 3 * links.len() + 2 * pins.len();
        Conditions { links, pins, list, of, scale, unknowns }
    }

    /// Returns velocities, and accelerations if requested; `None` if a pivot may be zero.
    pub(super) fn solve(&self, accelerations: bool) -> Option<(Vec<N>, Vec<N>)> {
        let n = self.unknowns;
        let zero = N::from_f64(0.0);
        if self.list.len() != n {
            return None;
        }
        let mut matrix = vec![zero; n * n];
        let mut rhs: Vec<N> =
            self.list.iter().zip(matrix.chunks_mut(n)).map(|(c, row)| c.row(row)).collect();
        let lu = Lu::of(matrix, n)?;
        lu.solve(&mut rhs);
        let second = if accelerations {
            let mut gamma: Vec<N> = self.list.iter().map(|c| c.acceleration(&rhs)).collect();
            lu.solve(&mut gamma);
            gamma
        } else {
            vec![zero; n]
        };
        Some((rhs, second))
    }

    /// Stores the solution for the groups that depend on this one.
    pub(super) fn store(&self, (v, a): &(Vec<N>, Vec<N>), motion: &mut MechanismMotion<N>) {
        let back = N::from_f64(1.0 / self.scale);
        let vec = |x: &[N], i: usize| Vec2::new(x[i], x[i + 1]) * back;
        for (i, &(l, at)) in self.links.iter().enumerate() {
            let i = 3 * i;
            motion.links[l.0] = Some(LinkMotion {
                at,
                v: vec(v, i),
                omega: v[i + 2],
                a: vec(a, i),
                alpha: a[i + 2],
            });
        }
        for (i, p) in self.pins.iter().enumerate() {
            let i = 3 * self.links.len() + 2 * i;
            motion.pins[p.0] = Some((vec(v, i), vec(a, i)));
        }
    }
}

/// Returns the largest distance of two points of the group (m), including those on which it
/// depends.
fn extent<N: Real>(scene: &Scene, m: &Mechanism, at: &Configuration<N>, group: &Group) -> f64 {
    let of_links = group.links.iter().flat_map(|l| scene.links[l.0].points.iter().copied());
    let of_pairs = group.constraints.iter().flat_map(|c| {
        let (a, b) = m.constraints[*c].ends();
        [a, b].into_iter().filter_map(|n| if let GraphNode::Pin(p) = n { Some(p) } else { None })
    });
    let (mut lo, mut hi) =
        (Vec2::new(f64::INFINITY, f64::INFINITY), Vec2::new(f64::NEG_INFINITY, f64::NEG_INFINITY));
    for p in of_links.chain(of_pairs).filter_map(|p| at.points[p.0]).map(|p| p.approx()) {
        lo = Vec2::new(lo.x.min(p.x), lo.y.min(p.y));
        hi = Vec2::new(hi.x.max(p.x), hi.y.max(p.y));
    }
    if lo.x > hi.x { 0.0 } else { (hi - lo).norm() }
}

/// Returns the reference point of a link's motion: one of its own points, so that arms are short
/// and an offset of all coordinates costs no digits.
fn own_point<N: Real>(scene: &Scene, at: &Configuration<N>, l: LinkId) -> Point<N> {
    let points = scene.links[l.0].points.iter().find_map(|p| at.points[p.0]);
    let guided = || scene.guides.iter().filter(|g| g.on == l).find_map(|g| at.points[g.pin?.0]);
    points
        .or_else(guided)
        .unwrap_or_else(|| at.poses[l.0].expect("a link of a solved group is placed").origin)
}

impl<N: Real> ConditionBuilder<'_, N> {
    /// Returns the point of a link at a position.
    fn body(&self, l: LinkId, place: Point<N>) -> ConditionPoint<N> {
        if let Some(i) = self.links.iter().position(|(k, _)| *k == l) {
            return ConditionPoint::Link(3 * i, (place - self.links[i].1) * self.scale);
        }
        let motion = self.known.links[l.0].expect("what a group rests on is solved");
        let (v, a) = (motion.velocity_at(place), motion.acceleration_at(place));
        ConditionPoint::Known(
            self.scaled(LinkMotion { at: place, v, a, ..motion }),
            GraphNode::Link(l),
        )
    }

    fn pin(&self, p: PointId) -> ConditionPoint<N> {
        if let Some(i) = self.pins.iter().position(|q| *q == p) {
            return ConditionPoint::Pin(3 * self.links.len() + 2 * i);
        }
        let (v, a) = self.known.at_point(p).expect("what a group rests on is solved");
        ConditionPoint::Known(
            self.scaled(LinkMotion { v, a, ..LinkMotion::rest(self.at.point(p)) }),
            GraphNode::Pin(p),
        )
    }

    fn scaled(&self, m: LinkMotion<N>) -> LinkMotion<N> {
        LinkMotion { v: m.v * self.scale, a: m.a * self.scale, ..m }
    }

    /// Adds both components of v_P = v_Q.
    fn together(
        &self,
        p: ConditionPoint<N>,
        q: ConditionPoint<N>,
        list: &mut Vec<MotionCondition<N>>,
    ) {
        let zero = N::from_f64(0.0);
        for k in [Vec2::unit_x(), Vec2::unit_x().perp()] {
            // P and Q stay coincident: no body moves relative to the other there, whatever turns.
            list.push(MotionCondition::Along { p, q, k, rate: zero, acceleration: zero });
        }
    }

    /// Returns the rotation of a link, multiplied by a factor.
    fn turns(&self, l: LinkId, factor: N) -> (ConditionPoint<N>, N) {
        (self.body(l, Point::origin()), factor)
    }

    /// Returns the condition of a rolling pair. Both points at a contact have equal velocities, and
    /// accelerations that differ along the normal only. Both wheels in a belt have equal rim speeds
    /// relative to the link that carries their centres.
    fn rolls(&self, pair: RollingId, links: [LinkId; 2]) -> MotionCondition<N> {
        let (rolling, zero) = (&self.scene.rolling[pair.0], N::from_f64(0.0));
        match rolling.touch() {
            Touch::Point(_) => {
                let (place, n) = (
                    self.at.point(rolling.at[0]),
                    self.at.normal(self.scene, pair).expect("a planned contact is placed"),
                );
                let [a, b] = links.map(|l| self.body(l, place));
                MotionCondition::Along { p: b, q: a, k: n.perp(), rate: zero, acceleration: zero }
            }
            Touch::Strand { arm, .. } => {
                let [a, b] = self.at.shapes.rolling[pair.0];
                let (ratio, one) = (a / b, N::from_f64(1.0));
                let bodies = vec![
                    self.turns(links[0], ratio),
                    self.turns(links[1], one),
                    self.turns(arm, -(ratio + one)),
                ];
                MotionCondition::Turning { bodies, rate: zero, acceleration: zero }
            }
        }
    }

    /// Returns the runner of a guide, and its position: its pin, or the slider itself.
    fn runner(&self, runner: Runner) -> (ConditionPoint<N>, Point<N>) {
        match runner {
            Runner::Pin(p) => (self.pin(p), self.at.point(p)),
            Runner::Link(slider) => {
                let place = own_point(self.scene, self.at, slider);
                (self.body(slider, place), place)
            }
        }
    }

    fn push(&self, form: PairForm, inputs: &Inputs<N>, list: &mut Vec<MotionCondition<N>>) {
        let zero = N::from_f64(0.0);
        let driven = |d: usize| {
            let driver = &self.scene.drivers[d];
            (
                inputs.number(&driver.rate),
                driver.acceleration.as_ref().map_or(zero, |a| inputs.number(a)),
            )
        };
        match form {
            PairForm::Meet { pin, link } => {
                let place = self.at.point(pin);
                self.together(self.body(link, place), self.pin(pin), list);
            }
            PairForm::OnPath { runner, guide, on } => {
                let (p, place) = self.runner(runner);
                list.push(match self.at.guide(guide) {
                    Path::Line { direction, .. } => MotionCondition::Along {
                        p,
                        q: self.body(on, place),
                        k: direction.perp(),
                        rate: zero,
                        acceleration: zero,
                    },
                    Path::Arc { centre, .. } => {
                        let u = (place - centre) * self.scale;
                        distance(p, self.body(on, centre), u, zero, zero)
                    }
                });
            }
            PairForm::AlongPath { runner, guide, on, driver } => {
                let (rate, acceleration) = driven(driver);
                let (p, place) = self.runner(runner);
                let q = self.body(on, place);
                let k = self.at.guide(guide).tangent_at(place);
                list.push(MotionCondition::Along {
                    p,
                    q,
                    k,
                    rate: rate * self.scale,
                    acceleration: acceleration * self.scale,
                });
            }
            PairForm::Related { pair, links } => list.push(self.rolls(pair, links)),
            PairForm::Angles { of, against, driver } => {
                let (rate, acceleration) = driver.map_or((zero, zero), driven);
                let one = N::from_f64(1.0);
                list.push(MotionCondition::Turning {
                    bodies: vec![self.turns(of, one), self.turns(against, -one)],
                    rate,
                    acceleration,
                });
            }
            PairForm::Distance { from, to, driver } => {
                let (rate, acceleration) = driven(driver);
                let (rate, acceleration) = (rate * self.scale, acceleration * self.scale);
                let u = (self.at.point(to) - self.at.point(from)) * self.scale;
                let l = u.norm();
                list.push(distance(
                    self.pin(to),
                    self.pin(from),
                    u,
                    l * rate,
                    rate * rate + l * acceleration,
                ));
            }
        }
    }
}

/// Returns the condition of a distance, weighted with a power of two that scales u to about one:
/// pivots are then comparable with those of other conditions in any unit, and nothing is rounded.
fn distance<N: Real>(
    p: ConditionPoint<N>,
    q: ConditionPoint<N>,
    u: Vec2<N>,
    rate: N,
    acceleration: N,
) -> MotionCondition<N> {
    let weight = N::from_f64(power_of_two_scale(u.approx().norm()));
    MotionCondition::Distance {
        p,
        q,
        u: u * weight,
        weight,
        rate: rate * weight,
        acceleration: acceleration * weight,
    }
}

/// A matrix decomposed with row pivots; exact zeros cost nothing and add no error.
struct Lu<N> {
    n: usize,
    a: Vec<N>,
    rows: Vec<usize>,
}

impl<N: Real> Lu<N> {
    /// Decomposes a matrix; `None` if a pivot may be zero.
    fn of(mut a: Vec<N>, n: usize) -> Option<Lu<N>> {
        let mut rows: Vec<usize> = (0..n).collect();
        for k in 0..n {
            let pivot = (k..n).max_by(|&i, &j| {
                let size = |i: usize| a[rows[i] * n + k].approx().abs();
                // Of equal pivots the first is taken: results do not depend on the order of a
                // search.
                size(i).total_cmp(&size(j)).then(j.cmp(&i))
            })?;
            rows.swap(k, pivot);
            let at = rows[k] * n;
            let d = a[at + k];
            if !d.is_decided() || d.approx().abs() <= d.radius() {
                return None;
            }
            for &row in &rows[k + 1..] {
                let i = row * n;
                if is_zero(a[i + k]) {
                    continue;
                }
                let f = a[i + k] / d;
                a[i + k] = f;
                for j in k + 1..n {
                    if !is_zero(a[at + j]) {
                        a[i + j] = a[i + j] - f * a[at + j];
                    }
                }
            }
        }
        Some(Lu { n, a, rows })
    }

    fn solve(&self, b: &mut Vec<N>) {
        let n = self.n;
        let mut x: Vec<N> = self.rows.iter().map(|&r| b[r]).collect();
        for i in 0..n {
            let row = self.rows[i] * n;
            for j in 0..i {
                if !is_zero(self.a[row + j]) {
                    x[i] = x[i] - self.a[row + j] * x[j];
                }
            }
        }
        for i in (0..n).rev() {
            let row = self.rows[i] * n;
            for j in i + 1..n {
                if !is_zero(self.a[row + j]) {
                    x[i] = x[i] - self.a[row + j] * x[j];
                }
            }
            x[i] = x[i] / self.a[row + i];
        }
        *b = x;
    }
}

/// Returns true if a coefficient is exactly zero.
fn is_zero<N: Real>(x: N) -> bool {
    x.approx() == 0.0 && x.radius() == 0.0
}
