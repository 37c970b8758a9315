//! Balancing moments, powers and inertia forces as columns. One driver does the opposite work of
//! all loads, so no reaction is needed: M_b ω = −Σ(F·v + M ω).

use super::ask::no_kernel;
use super::{Compiler, NoKernel};
use crate::carry::{Arm, Twist};
use crate::kernel::{Reg, RegPair};
use crate::reading::{Dot, VectorLength, WeightedSum};
use crate::work::{Forward, Massive, ProductSum, Ramp, Repeated, SpringPower};
use hodograph_base::geom::Vec2;
use hodograph_mechanism::force::{NEAR, ends, fastest};
use hodograph_mechanism::mechanism::Level;
use hodograph_mechanism::position::Path;
use hodograph_scene::quantity::{ByMotion, ROUNDING};
use hodograph_scene::{Abscissa, Applied, Find, LinkId, LoadCourse, LoadSize, LoadTravel, OnLink};

const P: Level = Level::Position;
const V: Level = Level::Velocity;
const A: Level = Level::Acceleration;

impl Compiler<'_> {
    /// Adds the columns of a force quantity that needs no reaction.
    pub(super) fn by_motion(&mut self, what: ByMotion, find: &Find) -> Result<(), NoKernel> {
        match what {
            ByMotion::Power => {
                let power = self.power(find)?;
                let driver = self.negative(power, 1.0);
                self.columns.push(driver);
            }
            ByMotion::Balance(d) => {
                let rate = self.scene.drivers.get(d).map_or(0.0, |driver| driver.rate.value);
                let power = self.power(find)?;
                let balance = self.negative(power, 1.0 / rate);
                self.columns.push(balance);
            }
            ByMotion::Inertia(l) => {
                let force = self.inertia(l, find)?;
                self.vector_columns(A, force);
            }
            ByMotion::InertiaCouple(l) => {
                let couple =
                    match self.scene.loads.mass_of(l).and_then(|m| m.j.as_ref()).map(|j| j.value) {
                        Some(j) if self.scene.has_inertia() => {
                            let alpha = self.turning(l, A)?;
                            self.negative(alpha, j)
                        }
                        _ => return Err(no_kernel(find)),
                    };
                self.columns.push(couple);
            }
            ByMotion::Shaking => {
                if !self.scene.has_inertia() {
                    return Err(no_kernel(find));
                }
                let mut sum = self.fixed(Vec2::ZERO);
                let links: Vec<LinkId> = self
                    .scene
                    .loads
                    .masses
                    .iter()
                    .filter(|m| m.m.is_some() && m.at.is_some())
                    .map(|m| m.link)
                    .collect();
                for l in links {
                    let force = self.inertia(l, find)?;
                    let add = |c: &mut Self, a, b| c.emit(A, WeightedSum { a, b, k: 1.0 }, 1);
                    sum = RegPair { x: add(self, sum.x, force.x), y: add(self, sum.y, force.y) };
                }
                self.vector_columns(A, sum);
            }
        }
        Ok(())
    }

    /// The inertia force −m a_S.
    fn inertia(&mut self, l: LinkId, find: &Find) -> Result<RegPair, NoKernel> {
        let mass = self.scene.loads.mass_of(l).filter(|_| self.scene.has_inertia());
        let Some((m, s)) = mass.and_then(|mass| Some((mass.m.as_ref()?.value, mass.at?))) else {
            return Err(no_kernel(find));
        };
        let a = self.point(s, A)?;
        Ok(RegPair { x: self.negative(a.x, m), y: self.negative(a.y, m) })
    }

    /// The product −k a.
    fn negative(&mut self, a: Reg, k: f64) -> Reg {
        let zero = self.zero();
        self.emit(A, WeightedSum { a: zero, b: a, k: -k }, 1)
    }

    /// The power of all loads, for a scene with one driver that moves.
    fn power(&mut self, find: &Find) -> Result<Reg, NoKernel> {
        let scene = self.scene;
        let loads = &scene.loads;
        let moves = matches!(&scene.drivers[..], [d] if d.rate.value != 0.0);
        if !moves || loads.balance.is_some() || !loads.friction.is_empty() {
            return Err(no_kernel(find));
        }
        let zero = self.zero();
        let still = RegPair { x: zero, y: zero };
        let mut power = zero;
        for mass in &loads.masses {
            let (m, j) = (mass.m.as_ref().filter(|_| mass.at.is_some()), mass.j.as_ref());
            let [m, j] = [m, j].map(|given| given.map_or(0.0, |g| g.value));
            let g = loads.gravity.as_ref().map_or(Vec2::ZERO, |[x, y]| Vec2::new(x.value, y.value));
            let inertia = scene.has_inertia();
            let (v, a) = match mass.at {
                Some(s) => (self.point(s, V)?, if inertia { self.point(s, A)? } else { still }),
                None => (still, still),
            };
            let (omega, alpha) = if inertia && j != 0.0 {
                (self.turning(mass.link, V)?, self.turning(mass.link, A)?)
            } else {
                (zero, zero)
            };
            let inert = if inertia { 1.0 } else { 0.0 };
            let massive = Massive {
                v,
                a,
                omega,
                alpha,
                before: power,
                m: m * inert,
                j: j * inert,
                weight: [g.x * m, g.y * m],
            };
            power = self.emit(A, massive, 1);
        }
        for applied in &loads.applied {
            power = self.of_load(applied, power, find)?;
        }
        for spring in &loads.springs {
            let [(p, a), (q, b)] = spring.ends;
            let at = |point, link| OnLink { point, link: Some(link) };
            let (from, to) = (self.point(p, P)?, self.point(q, P)?);
            let d = self.emit_pair(P, Arm { from, to });
            let (from, to) = (self.vector(&at(p, a), V)?, self.vector(&at(q, b), V)?);
            let v = self.emit_pair(V, Arm { from, to });
            power = self.emit(
                V,
                SpringPower {
                    d,
                    v,
                    before: power,
                    stiffness: spring.stiffness.value,
                    free: spring.free.value,
                },
                1,
            );
        }
        Ok(power)
    }

    /// The power of an applied load, added to others.
    fn of_load(&mut self, applied: &Applied, before: Reg, find: &Find) -> Result<Reg, NoKernel> {
        let velocity = |c: &mut Self| match applied.at {
            Some(point) => c.vector(&OnLink { point, link: Some(applied.link) }, V),
            None => Err(no_kernel(find)),
        };
        // The power of a load of 1 N or 1 N·m, and its amount; for components the whole power.
        let (unit, amount) = match &applied.size {
            LoadSize::Components([x, y]) => {
                let v = velocity(self)?;
                let u = self.fixed(Vec2::new(x.value, y.value));
                (self.emit(V, Dot { u, v }, 1), 1.0)
            }
            LoadSize::Directed { force, line, angle } => {
                let v = velocity(self)?;
                let turned =
                    angle.as_ref().map_or(Vec2::unit_x(), |a| Vec2::from_angle(a.value.radians()));
                let u = match line {
                    None => self.fixed(turned),
                    Some((a, b)) => {
                        // A line of a link keeps its length.
                        let carries = |l: &LinkId| {
                            self.at.shapes.local(*l, *a).is_some()
                                && self.at.shapes.local(*l, *b).is_some()
                        };
                        let l = (0..self.scene.links.len()).map(LinkId).find(carries);
                        let length = self.at.points[a.0]
                            .zip(self.at.points[b.0])
                            .map(|(a, b)| a.distance(b));
                        let (Some(_), Some(length)) = (l, length) else {
                            return Err(no_kernel(find));
                        };
                        let (from, to) = (self.point(*a, P)?, self.point(*b, P)?);
                        let d = self.emit_pair(P, Arm { from, to });
                        self.emit_pair(P, Twist { d, k: [turned.x / length, turned.y / length] })
                    }
                };
                (self.emit(V, Dot { u, v }, 1), force.value)
            }
            LoadSize::AgainstMotion(force) => {
                let v = velocity(self)?;
                let speed = self.emit(V, VectorLength { v }, 1);
                (self.negative(speed, 1.0), force.value)
            }
            LoadSize::Couple(couple) => (self.turning(applied.link, V)?, couple.value),
            LoadSize::AgainstTurning(couple) => {
                let v = RegPair { x: self.turning(applied.link, V)?, y: self.zero() };
                let speed = self.emit(V, VectorLength { v }, 1);
                (self.negative(speed, 1.0), couple.value)
            }
        };
        match &applied.course {
            None => Ok(self.emit(A, WeightedSum { a: before, b: unit, k: amount }, 1)),
            Some(course) => {
                let now = self.along_course(course, amount, find)?;
                Ok(self.emit(A, ProductSum { a: unit, b: now, before }, 1))
            }
        }
    }

    /// The amount of a load along its course; without a diagram `constant` within the course.
    fn along_course(
        &mut self,
        course: &LoadCourse,
        constant: f64,
        find: &Find,
    ) -> Result<Reg, NoKernel> {
        let (at, near, onward) = match &course.along {
            LoadTravel::Stroke { point, guide, .. } => {
                let (Some(Ok([start, end])), Some(Path::Line { through, direction })) =
                    (ends(self.scene, course).as_ref(), self.at.guides[guide.0])
                else {
                    return Err(no_kernel(find));
                };
                let length = (end.value - start.value).abs();
                let part = matches!(course.stations[0].at, Abscissa::Part(_));
                let (scale, near) = if part { (1.0 / length, NEAR) } else { (1.0, NEAR * length) };
                let way = direction * (end.value - start.value).signum();
                let (u, place) = (self.fixed(way), self.point(*point, P)?);
                let gone = self.emit(P, Dot { u, v: place }, 1);
                let begin =
                    through.to_vec2().dot(way) + start.value * (end.value - start.value).signum();
                let origin = self.constant(-begin * scale);
                let v = self.point(*point, V)?;
                let speed = self.emit(V, Dot { u, v }, 1);
                (self.emit(P, WeightedSum { a: origin, b: gone, k: scale }, 1), near, Some(speed))
            }
            LoadTravel::Turn { driver, period } => {
                if self.driver != Some(*driver) {
                    return Err(no_kernel(find));
                }
                let near = NEAR * 360.0;
                let (quarters, _) = self.quarters(*driver);
                let first = course.stations[0].at.value() - near;
                (
                    self.emit(P, Repeated { quarters, first, period: period.value.degrees() }, 1),
                    near,
                    None,
                )
            }
        };
        let mut amount = self.zero();
        let stations = &course.stations;
        let value = |k: usize| stations[k].amount.as_ref().map_or(constant, |a| a.value);
        for k in 0..stations.len() - 1 {
            let [from, to] = [stations[k].at.value(), stations[k + 1].at.value()];
            if from < to {
                let slope = (value(k + 1) - value(k)) / (to - from);
                let first = (0..k).all(|k| stations[k].at.value() >= stations[k + 1].at.value());
                let begin = if first { from - near } else { from };
                amount = self.emit(
                    P,
                    Ramp { at, before: amount, from: begin, origin: from, amount: value(k), slope },
                    1,
                );
            }
        }
        let last = stations[stations.len() - 1].at.value() + near;
        amount = self.emit(
            P,
            Ramp { at, before: amount, from: last.next_up(), origin: 0.0, amount: 0.0, slope: 0.0 },
            1,
        );
        // The load does not act on the return stroke.
        Ok(match onward {
            Some(speed) => self.emit(
                V,
                Forward { speed, number: amount, from: -ROUNDING * fastest(self.scene, self.at) },
                1,
            ),
            None => amount,
        })
    }
}
