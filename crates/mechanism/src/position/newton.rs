//! Newton's method on the constraint equations of a set of links, from a rough pose: for groups
//! without a closed form, and for small motions of a placed mechanism.
//!
//! The unknowns are the poses of the chosen links (x, y, angle each) and the positions of pins that
//! are on none of them. The equations of a group contain its own bodies and those of groups before
//! it: their matrix is block triangular, and a step on a chain of n groups costs n small systems.
//! The residuals and their derivatives are those of [`equations`], which the loop equations do not
//! use.

use super::equations::{self, FormMeasure, FormValue, PartPositions};
use super::rolling::{self, RollingPose, RollingRecord};
use super::{Configuration, Path, Pose, Shapes};
use crate::mechanism::{GraphNode, Group, Mechanism, PairForm, PairItem, constraints_of};
use hodograph_base::budget::spend;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::linear::RowFactors;
use hodograph_scene::{GuideId, LinkId, PointId, Rolling, RollingId, Scene};
use nalgebra::{DMatrix, DVector};
use std::ops::Range;

/// Poses of all links and positions of all points, as far as they are known.
pub type SolvedPoses = (Vec<Option<Pose>>, Vec<Option<Point>>);

/// The values of the drivers, in the order of the scene: radians from the pose in which the link
/// frames are defined, metres along the guide, metres of length.
#[derive(Clone, Debug, PartialEq)]
pub struct DriverValues(pub Vec<f64>);

/// The system of equations of some links and pins.
pub struct System<'a> {
    scene: &'a Scene,
    shapes: &'a Shapes,
    /// The links and pins, in the order of their unknowns.
    bodies: Vec<GraphNode>,
    /// Each form with its value at the start, unless a driver gives the value.
    forms: Vec<(PairForm, FormValue<f64>)>,
    blocks: Vec<GroupBlock>,
    /// The first unknown of each link and of each point, if it is in the system.
    firsts: (Vec<Option<usize>>, Vec<Option<usize>>),
    /// The rolling of each pair at the start.
    rolled: Vec<Option<RollingRecord>>,
    /// Deviation of each rolling pair from the phase in the scene at the start, as an angle of its
    /// second link.
    out_of_phase: Vec<f64>,
    /// Poses and points outside the system, which are constant.
    poses: Vec<Option<Pose>>,
    points: Vec<Option<Point>>,
    scale: f64,
}

/// The unknowns and equations of one group in a [`System`]: both are numbered through all groups, in
/// the order of solution.
struct GroupBlock {
    unknowns: Range<usize>,
    /// Indices into [`System::forms`].
    forms: Range<usize>,
}

impl<'a> System<'a> {
    /// Creates the equations of the given groups. Lock angles and glide offsets are those of
    /// `start`.
    pub fn new(
        scene: &'a Scene,
        mechanism: &'a Mechanism,
        shapes: &'a Shapes,
        start: &Configuration,
        groups: &[usize],
    ) -> System<'a> {
        let (mut bodies, mut forms, mut blocks) = (Vec::new(), Vec::new(), Vec::new());
        let mut firsts = (vec![None; scene.links.len()], vec![None; scene.points.len()]);
        let mut unknowns = 0;
        for &g in groups {
            let group = &mechanism.groups[g];
            let begin = (unknowns, forms.len());
            for &l in &group.links {
                firsts.0[l.0] = Some(unknowns);
                bodies.push(GraphNode::Link(l));
                unknowns += 3;
            }
            for &p in &group.pins {
                firsts.1[p.0] = Some(unknowns);
                bodies.push(GraphNode::Pin(p));
                unknowns += 2;
            }
            let of_group = group.constraints.iter().map(|&c| mechanism.constraints[c].form());
            forms.extend(of_group.map(|form| (form, FormValue::Nothing)));
            blocks.push(GroupBlock { unknowns: begin.0..unknowns, forms: begin.1..forms.len() });
        }
        let mut system = System {
            scene,
            shapes,
            bodies,
            forms,
            blocks,
            firsts,
            rolled: vec![None; scene.rolling.len()],
            out_of_phase: vec![0.0; scene.rolling.len()],
            poses: start.poses.clone(),
            points: start.points.clone(),
            scale: start.extent().max(f64::MIN_POSITIVE),
        };
        for i in 0..system.forms.len() {
            let (form, _) = system.forms[i];
            // The value of a driver is given with each solution.
            if form.driver().is_none() {
                let placed =
                    PlacedSystem { system: &system, poses: &system.poses, points: &system.points };
                system.forms[i].1 = equations::kept(form, &placed).unwrap_or(FormValue::Nothing);
            }
            if let PairForm::Related { pair, .. } = form {
                // A rough start has no record: it is the instant itself.
                let begin =
                    || system.seen(pair, &start.poses, &start.points).map(RollingRecord::begin);
                system.rolled[pair.0] = start.rolled.get(pair.0).cloned().flatten().or_else(begin);
            }
        }
        system
    }

    /// Converts the system to the scene's instant: the frames of sliders are parallel to the
    /// plane's, the origins of gliding links are on their guides, and gears have the given phase,
    /// however rough `start` is.
    pub fn at_instant(mut self) -> System<'a> {
        for r in (0..self.rolled.len()).filter(|r| self.rolled[*r].is_some()) {
            let now = self.seen(RollingId(r), &self.poses, &self.points);
            self.out_of_phase[r] = now
                .and_then(|now| rolling::out_of_phase(self.scene, self.shapes, RollingId(r), &now))
                .unwrap_or(0.0);
        }
        for (_, given) in &mut self.forms {
            *given = match *given {
                FormValue::Turned(_) | FormValue::InPlane(_) => {
                    FormValue::InPlane(Vec2::new(1.0, 0.0))
                }
                FormValue::Length(_) | FormValue::Nothing => FormValue::Nothing,
            };
        }
        self
    }

    /// Returns a rolling pair in a pose; `None` if it is not placed.
    fn seen(
        &self,
        r: RollingId,
        poses: &[Option<Pose>],
        points: &[Option<Point>],
    ) -> Option<RollingPose> {
        let pose = |l: LinkId| if l == self.scene.ground { Some(Pose::GROUND) } else { poses[l.0] };
        let place = |l: LinkId, p: PointId| {
            // A centre moves with its link, whose pose is varied.
            self.shapes.local(l, p).and_then(|local| Some(pose(l)?.to_world(local))).or(points[p.0])
        };
        rolling::seen(&self.scene.rolling[r.0], self.shapes, &pose, &place)
    }

    pub(super) fn unpack(&self, x: &DVector<f64>) -> SolvedPoses {
        let mut solved = (self.poses.clone(), self.points.clone());
        self.put(x, &mut solved);
        solved
    }

    /// Returns the unknowns in a configuration: two coordinates of each link and pin, and the angle
    /// of a link.
    pub(super) fn pack(&self, start: &Configuration) -> Option<DVector<f64>> {
        let mut x = Vec::new();
        for body in &self.bodies {
            let (place, angle) = match *body {
                GraphNode::Link(l) => {
                    let pose = start.poses[l.0]?;
                    (pose.origin, Some(pose.axis.angle()))
                }
                GraphNode::Pin(p) => (start.points[p.0]?, None),
            };
            x.extend([place.x / self.scale, place.y / self.scale].into_iter().chain(angle));
        }
        Some(DVector::from_vec(x))
    }

    /// Writes the poses and positions of all links and pins.
    fn put(&self, x: &DVector<f64>, to: &mut SolvedPoses) {
        let mut first = 0;
        for body in &self.bodies {
            let origin = Point::new(x[first] * self.scale, x[first + 1] * self.scale);
            match *body {
                GraphNode::Link(l) => {
                    to.0[l.0] = Some(Pose { origin, axis: Vec2::from_angle(x[first + 2]) });
                }
                GraphNode::Pin(p) => to.1[p.0] = Some(origin),
            }
            first += body.freedoms();
        }
    }

    /// Returns the residuals, each a length or an angle divided by the mechanism's size or one
    /// radian.
    pub(super) fn residuals(&self, at: &SolvedPoses, drivers: &DriverValues) -> DVector<f64> {
        let view = PlacedSystem { system: self, poses: &at.0, points: &at.1 };
        let s = 1.0 / self.scale;
        let mut r = Vec::with_capacity(2 * self.forms.len());
        for form in &self.forms {
            match equations::off(form.0, given(form, drivers), &view)
                .expect("all links and pins of a system are placed")
            {
                FormMeasure::Apart(d) => r.extend([d.x * s, d.y * s]),
                FormMeasure::Length(x) => r.push(x * s),
                FormMeasure::Angle(x) => r.push(x),
            }
        }
        DVector::from_vec(r)
    }

    /// Reports the derivatives of the residuals of some forms: equation (counted from the first of
    /// these forms), unknown, and the derivative, which is added to those of the same two.
    fn slopes(
        &self,
        forms: &[(PairForm, FormValue<f64>)],
        at: &SolvedPoses,
        drivers: &DriverValues,
        mut told: impl FnMut(usize, usize, f64),
    ) -> Option<()> {
        let view = PlacedSystem { system: self, poses: &at.0, points: &at.1 };
        let mut row = 0;
        for form in forms {
            let given = given(form, drivers);
            equations::slopes(form.0, given, &view, self.scale, |equation, body, by| {
                let first = match body {
                    GraphNode::Link(l) => self.firsts.0[l.0],
                    GraphNode::Pin(p) => self.firsts.1[p.0],
                };
                let Some(first) = first else { return };
                let by = by.into_iter().take(body.freedoms()).enumerate();
                by.for_each(|(k, by)| told(row + equation, first + k, by));
            })?;
            row += form.0.equations();
        }
        Some(())
    }

    /// Returns the derivatives of the residuals, a column for each unknown; `None` if there are not
    /// as many equations.
    pub(super) fn jacobian(
        &self,
        at: &SolvedPoses,
        drivers: &DriverValues,
    ) -> Option<DMatrix<f64>> {
        let rows = self.forms.iter().map(|(form, _)| form.equations()).sum();
        let unknowns = self.bodies.iter().map(|body| body.freedoms()).sum();
        let mut matrix = DMatrix::zeros(rows, unknowns);
        self.slopes(&self.forms, at, drivers, |row, k, by| matrix[(row, k)] += by)?;
        (rows == unknowns).then_some(matrix)
    }

    /// Returns the derivatives of the residuals by the value of a driver (1/rad or 1/m).
    pub(super) fn driver_column(&self, driver: usize) -> DVector<f64> {
        let mut column = Vec::new();
        for (form, _) in &self.forms {
            let by = match form {
                _ if form.driver() != Some(driver) => 0.0,
                PairForm::Angles { .. } => -1.0,
                PairForm::Meet { .. }
                | PairForm::OnPath { .. }
                | PairForm::AlongPath { .. }
                | PairForm::Distance { .. }
                | PairForm::Related { .. } => -1.0 / self.scale,
            };
            column.extend(std::iter::repeat_n(by, form.equations()));
        }
        DVector::from_vec(column)
    }

    /// Solves from the poses of `start` for the given driver values; `None` if Newton's method does
    /// not converge.
    ///
    /// The method has converged if the last correction is within rounding, or does not decrease
    /// further below 1e-9.
    pub fn solve(&self, start: &Configuration, drivers: &DriverValues) -> Option<SolvedPoses> {
        self.solve_to(start, drivers, 1e-15)
    }

    /// Solves like [`System::solve`], until the last correction is below `tolerance` (relative to
    /// the mechanism's size, or in radians).
    pub fn solve_to(
        &self,
        start: &Configuration,
        drivers: &DriverValues,
        tolerance: f64,
    ) -> Option<SolvedPoses> {
        let mut x = self.pack(start)?;
        let mut at = (start.poses.clone(), start.points.clone());
        self.put(&x, &mut at);
        let mut last = f64::INFINITY;
        for _ in 0..60 {
            spend();
            let r = self.residuals(&at, drivers);
            if r.len() != x.len() || r.iter().any(|v| !v.is_finite()) {
                return None;
            }
            let step = self.step(&r, &at, drivers)?;
            let size = step.amax();
            if !size.is_finite() {
                return None;
            }
            // A rough sketch may be far from the solution: a step of more than half a radian (or
            // half the mechanism) is shortened.
            let damp = if size > 0.5 { 0.5 / size } else { 1.0 };
            x += step * damp;
            self.put(&x, &mut at);
            if size < tolerance || (size < 1e-9 && size >= last) {
                return Some(at);
            }
            last = size;
        }
        (last < 1e-9).then_some(at)
    }

    /// Returns a step of Newton's method on all equations. Their matrix is block triangular: the
    /// step of a group follows from those of the groups before it.
    fn step(
        &self,
        r: &DVector<f64>,
        at: &SolvedPoses,
        drivers: &DriverValues,
    ) -> Option<DVector<f64>> {
        let mut step = -r;
        for GroupBlock { unknowns, forms } in &self.blocks {
            let (begin, n) = (unknowns.start, unknowns.len());
            let forms = &self.forms[forms.clone()];
            if forms.iter().map(|(form, _)| form.equations()).sum::<usize>() != n {
                return None;
            }
            let mut rows = vec![0.0; n * n];
            let (known, rest) = step.as_mut_slice().split_at_mut(begin);
            self.slopes(forms, at, drivers, |row, k, by| match k.checked_sub(begin) {
                Some(own) if own < n => rows[row * n + own] += by,
                Some(_) => {}
                None => rest[row] -= by * known[k],
            })?;
            RowFactors::new(n, rows).solve(&mut rest[..n])?;
        }
        Some(step)
    }

    /// Returns the unit of lengths (m): the mechanism's size.
    pub(super) fn scale(&self) -> f64 {
        self.scale
    }
}

/// Returns the value of a form that a driver gives, or that it keeps.
fn given((form, kept): &(PairForm, FormValue<f64>), drivers: &DriverValues) -> FormValue<f64> {
    match (form.driver(), form) {
        (Some(d), PairForm::Angles { .. }) => FormValue::Turned(Vec2::from_angle(drivers.0[d])),
        (Some(d), _) => FormValue::Length(drivers.0[d]),
        (None, _) => *kept,
    }
}

/// A system with its links and pins in a given pose.
struct PlacedSystem<'a> {
    system: &'a System<'a>,
    poses: &'a [Option<Pose>],
    points: &'a [Option<Point>],
}

impl PartPositions<f64> for PlacedSystem<'_> {
    fn pose(&self, l: LinkId) -> Option<Pose> {
        if l == self.system.scene.ground { Some(Pose::GROUND) } else { self.poses[l.0] }
    }

    fn point(&self, p: PointId) -> Option<Point> {
        self.points[p.0]
    }

    fn local(&self, l: LinkId, p: PointId) -> Option<Point> {
        self.system.shapes.local(l, p)
    }

    fn path(&self, g: GuideId) -> Option<Path> {
        self.system.shapes.guides[g.0]
    }

    /// A pair that is placed for the first time has not rolled.
    fn slip(&self, r: RollingId) -> Option<f64> {
        let system = self.system;
        let now = system.seen(r, self.poses, self.points);
        let then = system.rolled[r.0].as_ref();
        let slip = |(then, now): (&RollingRecord, RollingPose)| {
            then.slip(&system.scene.rolling[r.0], system.shapes.rolling[r.0], &now)
        };
        Some(then.zip(now).map_or(0.0, slip) + system.out_of_phase[r.0])
    }

    fn rolling(&self, r: RollingId) -> (&Rolling, [f64; 2]) {
        (&self.system.scene.rolling[r.0], self.system.shapes.rolling[r.0])
    }
}

/// Returns the values of the drivers in a configuration.
pub fn driver_values(scene: &Scene, at: &Configuration) -> DriverValues {
    let value = |form: PairForm| match equations::measured(form, &(scene, at))? {
        FormMeasure::Length(x) | FormMeasure::Angle(x) => Some(x),
        FormMeasure::Apart(_) => None,
    };
    let value = |d: usize| constraints_of(scene, PairItem::Driver(d)).find_map(|c| value(c.form()));
    DriverValues((0..scene.drivers.len()).map(|d| value(d).unwrap_or(0.0)).collect())
}

/// Returns the configuration at other driver values, followed from `start` (for small steps).
///
/// All groups that `start` places move at once; `None` if the iteration does not converge.
pub fn moved(
    scene: &Scene,
    mechanism: &Mechanism,
    start: &Configuration,
    drivers: &DriverValues,
) -> Option<Configuration> {
    moved_to(scene, mechanism, start, drivers, 1e-15)
}

/// Moves the mechanism like [`moved`], until the last correction is below `tolerance`: see
/// [`System::solve_to`].
pub fn moved_to(
    scene: &Scene,
    mechanism: &Mechanism,
    start: &Configuration,
    drivers: &DriverValues,
    tolerance: f64,
) -> Option<Configuration> {
    let system = System::new(scene, mechanism, &start.shapes, start, &placed(mechanism, start));
    let (poses, points) = system.solve_to(start, drivers, tolerance)?;
    Some(super::finish::complete(
        scene,
        mechanism,
        start.shapes.clone(),
        (poses, points),
        start.closures.clone(),
        &start.rolled,
    ))
}

/// Returns the groups that a configuration places.
pub(super) fn placed(mechanism: &Mechanism, at: &Configuration) -> Vec<usize> {
    let there = |g: &Group| {
        g.links.iter().all(|l| at.poses[l.0].is_some())
            && g.pins.iter().all(|p| at.points[p.0].is_some())
    };
    (0..mechanism.groups.len()).filter(|&g| there(&mechanism.groups[g])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanism::Demand;
    use crate::position::configure;
    use hodograph_scene::{self as scene, templates};

    /// In poses off the root, at the instant and after it; by the drivers' values too.
    #[test]
    fn derivatives_are_central_differences_of_the_residuals() {
        const STEP: f64 = 1e-5;
        let mut seen = 0;
        for t in templates::list() {
            let scene = scene::read(templates::get(t.name).expect("listed")).expect(t.name).value;
            let m = Mechanism::new(&scene).expect(t.name).value;
            let demand = Demand::of(&scene, &m).with_all_positions();
            let Ok(start) = configure(&scene, &m, &demand) else { continue };
            let start = start.value;
            let system = || System::new(&scene, &m, &start.shapes, &start, &placed(&m, &start));
            for system in [system(), system().at_instant()] {
                let drivers = driver_values(&scene, &start);
                let x = system.pack(&start).expect(t.name);
                let x =
                    DVector::from_fn(x.len(), |k, _| x[k] + 0.03 * libm::sin(1.0 + 2.3 * k as f64));
                let Some(slopes) = system.jacobian(&system.unpack(&x), &drivers) else {
                    panic!("{}: not as many equations as unknowns", t.name)
                };
                let check = |k, own: f64, slope: f64, by: &str| {
                    let off = (own - slope).abs();
                    assert!(
                        off < 1e-7 * (1.0 + slope.abs()),
                        "{}, equation {k} by {by}: {own}, {slope}",
                        t.name
                    );
                };
                for k in 0..x.len() {
                    let beside = |by: f64| {
                        let mut x = x.clone();
                        x[k] += by;
                        system.residuals(&system.unpack(&x), &drivers)
                    };
                    let slope = (beside(STEP) - beside(-STEP)) / (2.0 * STEP);
                    (0..x.len())
                        .for_each(|i| check(i, slopes[(i, k)], slope[i], &format!("unknown {k}")));
                }
                for d in 0..scene.drivers.len() {
                    let unit = if scene.drivers[d].kind.turns() { 1.0 } else { system.scale };
                    let beside = |by: f64| {
                        let mut drivers = drivers.clone();
                        drivers.0[d] += by * unit;
                        system.residuals(&system.unpack(&x), &drivers)
                    };
                    let slope = (beside(STEP) - beside(-STEP)) / (2.0 * STEP);
                    let own = system.driver_column(d) * unit;
                    (0..x.len()).for_each(|i| check(i, own[i], slope[i], &format!("driver {d}")));
                }
                seen += 1;
            }
        }
        assert!(seen > 100, "{seen}");
    }
}
