//! Newton's method on the constraint equations of a set of links, from a rough pose: for groups
//! without a closed form, and for small motions of a placed mechanism.
//!
//! The unknowns are the poses of the chosen links (x, y, angle each) and the positions of pins that
//! are on none of them. The equations of a group contain its own bodies and those of groups before
//! it: their matrix is block triangular, and a step on a chain of n groups costs n small systems.
//! The residuals are written for all kinds of constraint. Their derivatives are differences, which
//! are independent of the analytic check; for each unknown they are taken only in the equations of
//! the constraints of its link or pin, since the other equations do not change.

use super::equations::{self, FormMeasure, FormValue, PartPositions};
use super::rolling::{self, RollingPose, RollingRecord};
use super::{Configuration, Path, Pose, Shapes};
use crate::mechanism::{GraphNode, Group, Mechanism, PairForm, PairItem, constraints_of};
use hodograph_base::budget::spend;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::linear::LinearSystem;
use hodograph_scene::{GuideId, LinkId, PointId, RollingId, Scene};
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
    links: Vec<LinkId>,
    pins: Vec<PointId>,
    /// Each form with its value at the start, unless a driver gives the value.
    forms: Vec<(PairForm, FormValue<f64>)>,
    blocks: Vec<GroupBlock>,
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

/// The unknowns and equations of one group in a [`System`].
struct GroupBlock {
    /// Indices into [`System::links`].
    links: Range<usize>,
    /// Indices into [`System::pins`].
    pins: Range<usize>,
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
        let mut links = Vec::new();
        let mut pins = Vec::new();
        let mut forms = Vec::new();
        let mut blocks = Vec::new();
        for &g in groups {
            let group = &mechanism.groups[g];
            let begin = [links.len(), pins.len(), forms.len()];
            links.extend(&group.links);
            pins.extend(&group.pins);
            let of_group = group.constraints.iter().map(|&c| mechanism.constraints[c].form());
            forms.extend(of_group.map(|form| (form, FormValue::Nothing)));
            blocks.push(GroupBlock {
                links: begin[0]..links.len(),
                pins: begin[1]..pins.len(),
                forms: begin[2]..forms.len(),
            });
        }
        let mut system = System {
            scene,
            shapes,
            links,
            pins,
            forms,
            blocks,
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
        for (body, first) in self.bodies() {
            self.put(body, |k| x[first + k], &mut solved);
        }
        solved
    }

    pub(super) fn pack(&self, start: &Configuration) -> Option<DVector<f64>> {
        let bodies = self.bodies().map(|(body, _)| self.coordinates(body, start));
        Some(DVector::from_vec(bodies.collect::<Option<Vec<_>>>()?.concat()))
    }

    /// Returns all bodies (a link by its index, a pin by its index after all links), each with the
    /// index of its first unknown in the whole system.
    fn bodies(&self) -> impl Iterator<Item = (usize, usize)> {
        let mut unknowns = 0;
        (0..self.links.len() + self.pins.len()).map(move |body| {
            let first = unknowns;
            unknowns += self.unknowns(body);
            (body, first)
        })
    }

    /// Returns the number of unknowns of a body.
    fn unknowns(&self, body: usize) -> usize {
        if body < self.links.len() { 3 } else { 2 }
    }

    /// Writes the pose or position of a body, whose k-th unknown is `x(k)`.
    fn put(&self, body: usize, x: impl Fn(usize) -> f64, to: &mut SolvedPoses) {
        let origin = Point::new(x(0) * self.scale, x(1) * self.scale);
        match body.checked_sub(self.links.len()) {
            None => to.0[self.links[body].0] = Some(Pose { origin, axis: Vec2::from_angle(x(2)) }),
            Some(pin) => to.1[self.pins[pin].0] = Some(origin),
        }
    }

    /// Returns the unknowns of a body in a configuration: two coordinates and, of a link, an angle.
    fn coordinates(&self, body: usize, at: &Configuration) -> Option<Vec<f64>> {
        let scaled = |p: Point| [p.x / self.scale, p.y / self.scale];
        Some(match body.checked_sub(self.links.len()) {
            None => {
                let pose = at.poses[self.links[body].0]?;
                let [x, y] = scaled(pose.origin);
                vec![x, y, pose.axis.angle()]
            }
            Some(pin) => scaled(at.points[self.pins[pin].0]?).to_vec(),
        })
    }

    /// Returns the residuals, each a length or an angle divided by the mechanism's size or one
    /// radian.
    pub(super) fn residuals(&self, at: &SolvedPoses, drivers: &DriverValues) -> DVector<f64> {
        let mut r = Vec::with_capacity(2 * self.forms.len());
        self.forms.iter().for_each(|f| self.residual(f, at, drivers, |v| r.push(v)));
        DVector::from_vec(r)
    }

    /// Reports the residuals of one form.
    fn residual(
        &self,
        (form, kept): &(PairForm, FormValue<f64>),
        (poses, points): &SolvedPoses,
        drivers: &DriverValues,
        mut told: impl FnMut(f64),
    ) {
        let given = match (form.driver(), form) {
            (Some(d), PairForm::Angles { .. }) => FormValue::Turned(Vec2::from_angle(drivers.0[d])),
            (Some(d), _) => FormValue::Length(drivers.0[d]),
            (None, _) => *kept,
        };
        let s = 1.0 / self.scale;
        match equations::off(*form, given, &PlacedSystem { system: self, poses, points })
            .expect("all links and pins of a system are placed")
        {
            FormMeasure::Apart(d) => {
                told(d.x * s);
                told(d.y * s);
            }
            FormMeasure::Length(x) => told(x * s),
            FormMeasure::Angle(x) => told(x),
        }
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
        let blocks = self.group_systems();
        let bodies = || blocks.iter().flat_map(|b| &b.bodies);
        let mut x = Vec::new();
        for b in bodies() {
            x.extend(self.coordinates(b.body, start)?);
        }
        let mut x = DVector::from_vec(x);
        let mut at = (start.poses.clone(), start.points.clone());
        let put_all = |x: &DVector<f64>, at: &mut SolvedPoses| {
            bodies().for_each(|b| self.put(b.body, |k| x[b.first + k], at));
        };
        put_all(&x, &mut at);
        let mut last = f64::INFINITY;
        for _ in 0..60 {
            spend();
            let r = self.residuals(&at, drivers);
            if r.len() != x.len() || r.iter().any(|v| !v.is_finite()) {
                return None;
            }
            let step = self.step(&x, &r, &mut at, &blocks, drivers)?;
            let size = step.amax();
            if !size.is_finite() {
                return None;
            }
            // A rough sketch may be far from the solution: a step of more than half a radian (or
            // half the mechanism) is shortened.
            let damp = if size > 0.5 { 0.5 / size } else { 1.0 };
            x += step * damp;
            put_all(&x, &mut at);
            if size < tolerance || (size < 1e-9 && size >= last) {
                return Some(at);
            }
            last = size;
        }
        (last < 1e-9).then_some(at)
    }

    /// Returns the unknowns and equations of each group. Both are numbered through all groups, in
    /// the order of solution.
    fn group_systems(&self) -> Vec<GroupSystem> {
        let mut unknowns = 0;
        let mut row = 0;
        let mut systems: Vec<GroupSystem> = Vec::with_capacity(self.blocks.len());
        for block in &self.blocks {
            let begin = [unknowns, row];
            let mut bodies = Vec::new();
            let pins = block.pins.clone().map(|pin| self.links.len() + pin);
            for body in block.links.clone().chain(pins) {
                bodies.push(GroupBody { body, first: unknowns, equations: Vec::new() });
                unknowns += self.unknowns(body);
            }
            systems.push(GroupSystem { bodies, unknowns: begin[0]..unknowns, rows: row..row });
            for form in block.forms.clone() {
                let (one, other) = self.forms[form].0.ends();
                for node in [one, other] {
                    let body = systems
                        .iter_mut()
                        .flat_map(|s| &mut s.bodies)
                        .find(|b| self.node(b.body) == node);
                    if let Some(body) = body {
                        body.equations.push((form, row));
                    }
                }
                row += self.forms[form].0.equations();
            }
            if let Some(system) = systems.last_mut() {
                system.rows = begin[1]..row;
            }
        }
        systems
    }

    fn node(&self, body: usize) -> GraphNode {
        match body.checked_sub(self.links.len()) {
            None => GraphNode::Link(self.links[body]),
            Some(pin) => GraphNode::Pin(self.pins[pin]),
        }
    }

    /// Returns a step of Newton's method on all equations. Their matrix is block triangular: the
    /// step of a group follows from those of the groups before it.
    ///
    /// The derivatives are central differences with a step of 2^-17: the residuals are at worst
    /// quadratic near the solution, so that the error of the derivative (about 1e-11) only slows
    /// the last step of the iteration and does not change its result. `at` contains the poses for
    /// `x`.
    fn step(
        &self,
        x: &DVector<f64>,
        r: &DVector<f64>,
        at: &mut SolvedPoses,
        systems: &[GroupSystem],
        drivers: &DriverValues,
    ) -> Option<DVector<f64>> {
        const STEP: f64 = 1.0 / 131_072.0;
        let mut step = DVector::zeros(x.len());
        let mut rest = -r;
        for GroupSystem { bodies, unknowns, rows } in systems {
            let n = unknowns.len();
            if rows.len() != n {
                return None;
            }
            let mut matrix = DMatrix::zeros(n, n);
            // Coefficients of the group's unknowns in the equations of later groups.
            let mut later: Vec<(usize, usize, f64)> = Vec::new();
            for GroupBody { body, first, equations } in bodies {
                for k in 0..self.unknowns(*body) {
                    for (by, sign) in [(STEP, 0.5 / STEP), (-STEP, -0.5 / STEP)] {
                        self.put(*body, |n| x[first + n] + if n == k { by } else { 0.0 }, at);
                        for &(form, row) in equations {
                            let mut row = row;
                            self.residual(&self.forms[form], at, drivers, |v| {
                                if rows.contains(&row) {
                                    matrix[(row - rows.start, first + k - unknowns.start)] +=
                                        sign * v;
                                } else {
                                    later.push((row, first + k, sign * v));
                                }
                                row += 1;
                            });
                        }
                    }
                }
                self.put(*body, |n| x[first + n], at);
            }
            let own = LinearSystem::new(matrix).solve(&rest.rows(rows.start, n).into_owned())?;
            step.rows_mut(unknowns.start, n).copy_from(&own);
            later.iter().for_each(|(row, k, c)| rest[*row] -= c * step[*k]);
        }
        Some(step)
    }

    /// Returns the unit of lengths (m): the mechanism's size.
    pub(super) fn scale(&self) -> f64 {
        self.scale
    }
}

/// Returns the derivatives of residuals, a column for each unknown: central differences with a step
/// of 2^-17, see [`System::solve`].
pub(super) fn slopes(
    x: &DVector<f64>,
    residuals: &dyn Fn(&DVector<f64>) -> DVector<f64>,
) -> DMatrix<f64> {
    const STEP: f64 = 1.0 / 131_072.0;
    let mut y = x.clone();
    let columns: Vec<DVector<f64>> = (0..x.len())
        .map(|k| {
            y[k] = x[k] + STEP;
            let hi = residuals(&y);
            y[k] = x[k] - STEP;
            let lo = residuals(&y);
            y[k] = x[k];
            (hi - lo) * (0.5 / STEP)
        })
        .collect();
    DMatrix::from_columns(&columns)
}

/// The unknowns and equations of a group, see [`System::group_systems`].
struct GroupSystem {
    bodies: Vec<GroupBody>,
    unknowns: Range<usize>,
    rows: Range<usize>,
}

/// A body of a group: a link by its index in the system, or a pin by its index after all links.
struct GroupBody {
    body: usize,
    /// Its first unknown.
    first: usize,
    /// The forms (index) in which it occurs, each with its first equation.
    equations: Vec<(usize, usize)>,
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
