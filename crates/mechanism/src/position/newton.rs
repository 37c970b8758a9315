//! Newton's method on the constraint equations of a set of links, from a rough pose: for groups
//! without a closed form, and for small motions of a placed mechanism.
//!
//! The unknowns are the poses of the chosen links (x, y, angle each) and the positions of pins that
//! are on none of them. The residuals are written for all kinds of constraint. Their derivatives
//! are differences, which are independent of the analytic check; for each unknown they are taken
//! only in the equations of the constraints of its link or pin, since the other equations do not
//! change.

use super::equations::{self, FormMeasure, FormValue, PartPositions};
use super::rolling::{self, RollingPose, RollingRecord};
use super::{Configuration, Path, Pose, Shapes};
use crate::mechanism::{GraphNode, Group, Mechanism, PairForm, PairItem, constraints_of};
use hodograph_base::budget::spend;
use hodograph_base::geom::{Point, Vec2};
use hodograph_scene::{GuideId, LinkId, PointId, RollingId, Scene};
use nalgebra::{DMatrix, DVector};

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
        for &g in groups {
            links.extend(&mechanism.groups[g].links);
            pins.extend(&mechanism.groups[g].pins);
            forms.extend(
                mechanism.groups[g]
                    .constraints
                    .iter()
                    .map(|&c| (mechanism.constraints[c].form(), FormValue::Nothing)),
            );
        }
        let mut system = System {
            scene,
            shapes,
            links,
            pins,
            forms,
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
        for i in 0..self.links.len() + self.pins.len() {
            self.put(i, |k| x[k], &mut solved);
        }
        solved
    }

    /// Returns the index of the first unknown of a body (a link, or after all links a pin), and the
    /// number of its unknowns.
    fn unknowns(&self, body: usize) -> (usize, usize) {
        match body.checked_sub(self.links.len()) {
            None => (3 * body, 3),
            Some(pin) => (3 * self.links.len() + 2 * pin, 2),
        }
    }

    /// Writes the pose or position of a body.
    fn put(&self, body: usize, x: impl Fn(usize) -> f64, to: &mut SolvedPoses) {
        let (k, _) = self.unknowns(body);
        let origin = Point::new(x(k) * self.scale, x(k + 1) * self.scale);
        match body.checked_sub(self.links.len()) {
            None => {
                to.0[self.links[body].0] = Some(Pose { origin, axis: Vec2::from_angle(x(k + 2)) })
            }
            Some(pin) => to.1[self.pins[pin].0] = Some(origin),
        }
    }

    pub(super) fn pack(&self, start: &Configuration) -> Option<DVector<f64>> {
        let mut x = Vec::new();
        for l in &self.links {
            let p = start.poses[l.0]?;
            x.extend([p.origin.x / self.scale, p.origin.y / self.scale, p.axis.angle()]);
        }
        for p in &self.pins {
            let at = start.points[p.0]?;
            x.extend([at.x / self.scale, at.y / self.scale]);
        }
        Some(DVector::from_vec(x))
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

    /// Returns for each body (see [`System::unknowns`]) the forms (index) in which it occurs, with
    /// the index of the first of their equations.
    fn touching(&self) -> Vec<Vec<(usize, usize)>> {
        let mut touching = vec![Vec::new(); self.links.len() + self.pins.len()];
        let mut row = 0;
        for (i, (form, _)) in self.forms.iter().enumerate() {
            let (one, other) = form.ends();
            for node in [one, other] {
                let body = match node {
                    GraphNode::Link(l) => self.links.iter().position(|m| *m == l),
                    GraphNode::Pin(p) => {
                        self.pins.iter().position(|q| *q == p).map(|i| self.links.len() + i)
                    }
                };
                if let Some(body) = body {
                    touching[body].push((i, row));
                }
            }
            row += form.equations();
        }
        touching
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
        let mut at = self.unpack(&x);
        let touching = self.touching();
        let mut last = f64::INFINITY;
        for _ in 0..60 {
            spend();
            let r = self.residuals(&at, drivers);
            if r.len() != x.len() || r.iter().any(|v| !v.is_finite()) {
                return None;
            }
            let jacobian = self.jacobian(&x, &mut at, &touching, drivers);
            let step = jacobian.lu().solve(&(-r))?;
            let size = step.amax();
            if !size.is_finite() {
                return None;
            }
            // A rough sketch may be far from the solution: a step of more than half a radian (or
            // half the mechanism) is shortened.
            let damp = if size > 0.5 { 0.5 / size } else { 1.0 };
            x += step * damp;
            at = self.unpack(&x);
            if size < tolerance || (size < 1e-9 && size >= last) {
                return Some(at);
            }
            last = size;
        }
        (last < 1e-9).then_some(at)
    }

    /// Returns the Jacobian by central differences with a step of 2^-17: the residuals are at worst
    /// quadratic near the solution, so that the error of the derivative (about 1e-11) only slows
    /// the last step of the iteration and does not change its result. `at` contains the poses for
    /// `x`.
    fn jacobian(
        &self,
        x: &DVector<f64>,
        at: &mut SolvedPoses,
        touching: &[Vec<(usize, usize)>],
        drivers: &DriverValues,
    ) -> DMatrix<f64> {
        const STEP: f64 = 1.0 / 131_072.0;
        let mut j = DMatrix::zeros(x.len(), x.len());
        for (body, forms) in touching.iter().enumerate() {
            let (first, count) = self.unknowns(body);
            for k in first..first + count {
                for (step, sign) in [(STEP, 1.0), (-STEP, -1.0)] {
                    self.put(body, |n| if n == k { x[n] + step } else { x[n] }, at);
                    for &(form, row) in forms {
                        let mut row = row;
                        self.residual(&self.forms[form], at, drivers, |v| {
                            j[(row, k)] += sign * v;
                            row += 1;
                        });
                    }
                }
            }
            self.put(body, |n| x[n], at);
        }
        j *= 0.5 / STEP;
        j
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
