//! A group without a core, refined and proved from the pose that Newton's method found in `f64`.
//!
//! The unknowns are the poses of its links and the places of its pins. Residuals are lengths (an angle's times the size of
//! the mechanism), their derivatives are written by hand.

use super::assemble::Assembly;
use super::branch::Trial;
use super::proof::{self, Unproven};
use super::{Configuration, Path, Pose};
use crate::diag::Diagnostic;
use crate::geom::{Point, Vec2};
use crate::mechanism::{Constraint, Group, Node};
use crate::number::Real;
use crate::scene::{DriverKind, LinkId, PointId};

/// Poses of the group's links and places of its pins.
#[derive(Clone)]
struct State<N> {
    poses: Vec<Pose<N>>,
    pins: Vec<Point<N>>,
}

struct Coupled<'a, N> {
    assembly: &'a Assembly<'a, N>,
    links: &'a [LinkId],
    pins: &'a [PointId],
    constraints: Vec<Constraint>,
    scale: f64,
    aside: Option<Aside>,
}

/// A driver that stands elsewhere than at the instant: by so much (rad or m) farther on. The others hold what they held then.
#[derive(Clone, Copy, Debug)]
pub(super) struct Aside {
    pub driver: usize,
    pub by: f64,
}

/// One equation: what it is off by, and its coefficients.
struct Equation<N> {
    off: N,
    row: Vec<N>,
}

impl<N: Real> Assembly<'_, N> {
    pub(super) fn coupled_trial(&self, group: &Group, meant: &Configuration) -> Result<Trial<N>, Diagnostic> {
        self.coupled_aside(group, meant, None)
    }

    /// The same with a driver elsewhere than at the instant, whose configuration the assembly must know.
    pub(super) fn coupled_aside(&self, group: &Group, meant: &Configuration, aside: Option<Aside>) -> Result<Trial<N>, Diagnostic> {
        let unproven = |why| self.unproven(&group.links, why);
        let mut start = State { poses: Vec::new(), pins: Vec::new() };
        for l in &group.links {
            let pose = meant.poses[l.0].ok_or_else(|| unproven(Unproven::NoRoot))?.lift::<N>();
            // An axis that was rounded to f64 is a unit vector only to f64.
            let axis = if N::refines() { pose.axis.unit().ok_or_else(|| unproven(Unproven::NoRoot))? } else { pose.axis };
            start.poses.push(Pose { axis, ..pose });
        }
        for p in &group.pins {
            start.pins.push(meant.points[p.0].ok_or_else(|| unproven(Unproven::NoRoot))?.lift());
        }
        let constraints = group.constraints.iter().map(|&c| self.m.constraints[c]).collect();
        let scale = meant.extent();
        let system = Coupled { assembly: self, links: &group.links, pins: &group.pins, constraints, scale, aside };
        let root = if N::refines() {
            if system.equations(&start).is_none() {
                return Err(unproven(Unproven::NotWritten));
            }
            proof::root(&system, start, scale).map_err(unproven)?
        } else {
            start
        };
        let pins = group.pins.iter().copied().zip(root.pins).collect();
        Ok(self.trial(pins, group.links.iter().copied().zip(root.poses).collect()))
    }
}

impl<N: Real> Coupled<'_, N> {
    fn pose(&self, at: &State<N>, l: LinkId) -> Option<Pose<N>> {
        match self.links.iter().position(|k| *k == l) {
            Some(i) => Some(at.poses[i]),
            None => self.assembly.poses[l.0],
        }
    }

    fn point(&self, at: &State<N>, p: PointId) -> Option<Point<N>> {
        match self.pins.iter().position(|q| *q == p) {
            Some(i) => Some(at.pins[i]),
            None => self.assembly.points[p.0],
        }
    }

    fn zeros(&self) -> Vec<N> {
        vec![N::from_f64(0.0); 3 * self.links.len() + 2 * self.pins.len()]
    }

    /// Adds ±k·(motion of a pin).
    fn add_pin(&self, row: &mut [N], p: PointId, k: Vec2<N>) {
        if let Some(i) = self.pins.iter().position(|q| *q == p) {
            let i = 3 * self.links.len() + 2 * i;
            row[i] = row[i] + k.x;
            row[i + 1] = row[i + 1] + k.y;
        }
    }

    /// Adds ±k·(motion of a link's point at a place).
    fn add_link(&self, at: &State<N>, row: &mut [N], l: LinkId, place: Point<N>, k: Vec2<N>) {
        if let Some(i) = self.links.iter().position(|q| *q == l) {
            let turn = k.dot((place - at.poses[i].origin).perp()) / N::from_f64(self.scale);
            for (j, c) in [k.x, k.y, turn].into_iter().enumerate() {
                row[3 * i + j] = row[3 * i + j] + c;
            }
        }
    }

    /// Adds the turning of a link, in the length by which its step is counted.
    fn add_turn(&self, row: &mut [N], l: LinkId, k: N) {
        if let Some(i) = self.links.iter().position(|q| *q == l) {
            row[3 * i + 2] = row[3 * i + 2] + k;
        }
    }

    /// By how much a driver stands farther on than at the instant.
    fn by(&self, driver: usize) -> N {
        N::from_f64(self.aside.filter(|a| a.driver == driver).map_or(0.0, |a| a.by))
    }

    /// What a driver held at the instant and how much more it holds now, where it is one that stands elsewhere.
    fn held_aside(&self, c: Constraint) -> Option<N> {
        let a = self.assembly;
        let then = a.instant.filter(|_| self.aside.is_some())?;
        match c {
            Constraint::Slide(d, g) => {
                let guide = &a.scene.guides[g.0];
                let Path::Line { through, direction } = a.guides[g.0]?.to_world(&then.poses[guide.on.0]?) else { return None };
                Some(direction.dot(then.points[guide.pin?.0]? - through) + self.by(d))
            }
            Constraint::Cylinder(d) => {
                let DriverKind::Cylinder { a: from, b: to, .. } = a.scene.drivers[d].kind else { return None };
                Some(then.points[from.0]?.distance(then.points[to.0]?) + self.by(d))
            }
            Constraint::Pinned(..)
            | Constraint::Slot(..)
            | Constraint::Lock(_)
            | Constraint::Glide(_)
            | Constraint::Turn(_)
            | Constraint::Roll(_) => None,
        }
    }

    /// The equations at a state; `None` where one of them is of a kind that is not written.
    fn equations(&self, at: &State<N>) -> Option<Vec<Equation<N>>> {
        let a = self.assembly;
        let mut list = Vec::new();
        for &c in &self.constraints {
            match c {
                Constraint::Pinned(p, l) => {
                    let (place, pose) = (self.point(at, p)?, self.pose(at, l)?);
                    let own = pose.to_world(a.shapes[l.0].local(p)?);
                    let off = place - own;
                    for (off, k) in [(off.x, Vec2::unit_x()), (off.y, Vec2::unit_x().perp())] {
                        let mut row = self.zeros();
                        self.add_pin(&mut row, p, k);
                        self.add_link(at, &mut row, l, own, -k);
                        list.push(Equation { off, row });
                    }
                }
                Constraint::Slot(p, g) => {
                    let on = a.scene.guides[g.0].on;
                    let place = self.point(at, p)?;
                    let mut row = self.zeros();
                    let off = match a.guides[g.0]?.to_world(&self.pose(at, on)?) {
                        Path::Line { through, direction } => {
                            self.add_pin(&mut row, p, direction.perp());
                            self.add_link(at, &mut row, on, place, -direction.perp());
                            direction.cross(place - through)
                        }
                        Path::Arc { centre, radius } => {
                            let u = place - centre;
                            let l = u.norm();
                            let u = u * (N::from_f64(1.0) / l);
                            self.add_pin(&mut row, p, u);
                            self.add_link(at, &mut row, on, centre, -u);
                            l - radius
                        }
                    };
                    list.push(Equation { off, row });
                }
                Constraint::Slide(d, g) => {
                    let guide = &a.scene.guides[g.0];
                    let held = match (self.held_aside(c), &a.scene.drivers[d].kind) {
                        (Some(held), _) => held,
                        (None, DriverKind::Slide { position: Some(s), .. }) => a.inputs.driven(&a.scene.drivers[d], s),
                        (None, _) => return None,
                    };
                    let Path::Line { through, direction } = a.guides[g.0]?.to_world(&self.pose(at, guide.on)?) else { return None };
                    let p = guide.pin?;
                    let place = self.point(at, p)?;
                    let mut row = self.zeros();
                    self.add_pin(&mut row, p, direction);
                    self.add_link(at, &mut row, guide.on, place, -direction);
                    list.push(Equation { off: direction.dot(place - through) - held, row });
                }
                Constraint::Cylinder(d) => {
                    let DriverKind::Cylinder { a: from, b: to, length, .. } = &a.scene.drivers[d].kind else { return None };
                    let held = match (self.held_aside(c), length) {
                        (Some(held), _) => held,
                        (None, Some(length)) => a.inputs.driven(&a.scene.drivers[d], length),
                        (None, None) => return None,
                    };
                    let u = self.point(at, *to)? - self.point(at, *from)?;
                    let l = u.norm();
                    let u = u * (N::from_f64(1.0) / l);
                    let mut row = self.zeros();
                    self.add_pin(&mut row, *to, u);
                    self.add_pin(&mut row, *from, -u);
                    list.push(Equation { off: l - held, row });
                }
                Constraint::Turn(d) => {
                    let (Node::Link(link), Node::Link(against)) = a.m.ends(a.scene, c) else { return None };
                    let i = self.links.iter().position(|l| *l == link)?;
                    let axis = at.poses[i].axis;
                    let mut row = self.zeros();
                    let target = match a.instant.filter(|_| self.aside.is_some()) {
                        Some(then) => {
                            let stood = then.poses[link.0]?.axis.divide_by(then.poses[against.0]?.axis);
                            stood.rotate_by(Vec2::from_angle(self.by(d))).rotate_by(self.pose(at, against)?.axis)
                        }
                        None if self.links.contains(&against) => return None,
                        None => a.axis_of(link, against, Some(d)).ok()?,
                    };
                    self.add_turn(&mut row, against, -target.dot(axis));
                    self.add_turn(&mut row, link, target.dot(axis));
                    list.push(Equation { off: target.cross(axis) * N::from_f64(self.scale), row });
                }
                // Lengths and drivers do not tell how far one link has rolled on the other.
                Constraint::Roll(_) => return None,
                Constraint::Lock(g) => {
                    let guide = &a.scene.guides[g.0];
                    let slider = guide.slider?;
                    let own = self.pose(at, slider)?.axis;
                    let mut row = self.zeros();
                    // At the instant its frame lies as the plane's; later it stands against the other link as it stood then.
                    let target = match a.instant {
                        None => Vec2::unit_x(),
                        Some(then) => {
                            let stood = then.poses[slider.0]?.axis.divide_by(then.poses[guide.on.0]?.axis);
                            let target = stood.rotate_by(self.pose(at, guide.on)?.axis);
                            self.add_turn(&mut row, guide.on, -target.dot(own));
                            target
                        }
                    };
                    self.add_turn(&mut row, slider, target.dot(own));
                    list.push(Equation { off: target.cross(own) * N::from_f64(self.scale), row });
                }
                Constraint::Glide(g) => {
                    let guide = &a.scene.guides[g.0];
                    let slider = guide.slider?;
                    let Path::Line { through, direction } = a.guides[g.0]?.to_world(&self.pose(at, guide.on)?) else { return None };
                    // How far its origin lies beside the guide is nobody's concern: at the instant it lies on it, and stays there.
                    let origin = self.pose(at, slider)?.origin;
                    let mut row = self.zeros();
                    self.add_link(at, &mut row, slider, origin, direction.perp());
                    self.add_link(at, &mut row, guide.on, origin, -direction.perp());
                    list.push(Equation { off: direction.cross(origin - through), row });
                }
            }
        }
        (list.len() == self.zeros().len()).then_some(list)
    }
}

impl<N: Real> proof::System<N> for Coupled<'_, N> {
    type State = State<N>;

    fn residuals(&self, at: &State<N>) -> Vec<N> {
        self.equations(at).unwrap_or_default().into_iter().map(|e| e.off).collect()
    }

    fn jacobian(&self, at: &State<N>) -> Vec<Vec<N>> {
        self.equations(at).unwrap_or_default().into_iter().map(|e| e.row).collect()
    }

    fn moved(&self, at: &State<N>, step: &[N]) -> State<N> {
        let scale = N::from_f64(self.scale);
        let poses = at.poses.iter().enumerate().map(|(i, pose)| Pose {
            origin: pose.origin + Vec2::new(step[3 * i], step[3 * i + 1]),
            axis: proof::turned(pose.axis, step[3 * i + 2] / scale),
        });
        let first = 3 * self.links.len();
        let pins = at.pins.iter().enumerate().map(|(i, p)| *p + Vec2::new(step[first + 2 * i], step[first + 2 * i + 1]));
        State { poses: poses.collect(), pins: pins.collect() }
    }

    fn angles(&self) -> Vec<(usize, f64)> {
        (0..self.links.len()).map(|i| (3 * i + 2, self.scale)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::proof::System;
    use super::*;
    use crate::mechanism::{Demand, Mechanism};
    use crate::position::{configure, newton};
    use crate::scene::{self, templates};
    use std::collections::BTreeSet;

    fn kind(a: &Assembly<f64>, c: Constraint) -> &'static str {
        match c {
            Constraint::Pinned(..) => "pinned",
            Constraint::Slot(_, g) if matches!(a.guides[g.0], Some(Path::Arc { .. })) => "slot along an arc",
            Constraint::Slot(..) => "slot along a line",
            Constraint::Slide(..) => "slide",
            Constraint::Cylinder(_) => "cylinder",
            Constraint::Turn(_) => "turn",
            Constraint::Roll(_) => "roll",
            Constraint::Lock(_) => "lock",
            Constraint::Glide(_) => "glide",
        }
    }

    /// All groups of a scene as one, in a state a little off its root, at the instant and with a driver elsewhere.
    fn check(name: &str, text: &str, seen: &mut BTreeSet<(&'static str, bool)>) {
        let Some(scene) = scene::read(text).ok().map(|s| s.value) else { return };
        let Some(m) = Mechanism::new(&scene).ok().map(|m| m.value) else { return };
        let demand = Demand::of(&scene, &m).with_all_positions();
        let Some(at) = configure(&scene, &m, &demand).ok().map(|c| c.value) else { return };
        let mut assembly = Assembly::<f64>::new(&scene, &m, &demand, Some(&at));
        assembly.guides.clone_from(&at.shapes.guides);
        let groups: Vec<&Group> = newton::placed(&m, &at).into_iter().map(|g| &m.groups[g]).collect();
        let links: Vec<LinkId> = groups.iter().flat_map(|g| g.links.clone()).collect();
        let pins: Vec<PointId> = groups.iter().flat_map(|g| g.pins.clone()).collect();
        let constraints: Vec<Constraint> = groups.iter().flat_map(|g| &g.constraints).map(|&c| m.constraints[c]).collect();
        let scale = at.extent();
        for aside in [None, Some(Aside { driver: 0, by: 0.01 })] {
            assembly.instant = aside.map(|_| &at);
            let system = Coupled { assembly: &assembly, links: &links, pins: &pins, constraints: constraints.clone(), scale, aside };
            let state = State {
                poses: links.iter().map(|l| at.poses[l.0].expect("placed")).collect(),
                pins: pins.iter().map(|p| at.point(*p)).collect(),
            };
            let n = system.zeros().len();
            let off: Vec<f64> = (0..n).map(|k| 0.03 * scale * libm::sin(1.0 + 2.3 * k as f64)).collect();
            let state = system.moved(&state, &off);
            if system.equations(&state).is_none() {
                continue;
            }
            let jacobian = system.jacobian(&state);
            for k in 0..n {
                let beside = |h: f64| {
                    let mut step = vec![0.0; n];
                    step[k] = h * scale;
                    system.residuals(&system.moved(&state, &step))
                };
                let (up, down) = (beside(1e-5), beside(-1e-5));
                for (i, row) in jacobian.iter().enumerate() {
                    let slope = (up[i] - down[i]) / (2e-5 * scale);
                    assert!(
                        (row[k] - slope).abs() < 1e-7 * (1.0 + slope.abs()),
                        "{name}, aside {}: equation {i} by unknown {k} is {}, its slope {slope}",
                        aside.is_some(),
                        row[k]
                    );
                }
            }
            seen.extend(constraints.iter().map(|c| (kind(&assembly, *c), aside.is_some())));
        }
    }

    /// A root stays a root whatever the derivatives are, but what is proved of it does not.
    #[test]
    fn derivatives_are_the_slopes_of_the_equations() {
        let mut seen = BTreeSet::new();
        for t in templates::list() {
            check(t.name, templates::get(t.name).expect("its name is of the list"), &mut seen);
        }
        let all = ["pinned", "slot along an arc", "slot along a line", "slide", "cylinder", "turn", "lock", "glide"];
        for kind in all {
            for aside in [false, true] {
                assert!(seen.contains(&(kind, aside)), "no template has {kind}, aside {aside}: {seen:?}");
            }
        }
    }
}
