//! Newton's method on the constraint equations of a set of links, from a rough pose: for groups
//! without a closed form, and for small motions of a placed mechanism.
//!
//! The unknowns are the poses of the chosen links (x, y, angle each) and the positions of pins. The
//! equations of a group contain its own bodies and those of groups before it, so group after group is
//! solved, and a chain of n groups costs n small systems. The residuals are written for all kinds of
//! constraint. Their derivatives are written here for each form, independently of the loop equations;
//! those of rolling pairs are differences.

use super::equations::{self, FormMeasure, FormValue, PartPositions};
use super::rolling::{self, RollingPose, RollingRecord};
use super::{Configuration, Path, Pose, Shapes};
use crate::mechanism::{GraphNode, Group, Mechanism, PairForm, PairItem, constraints_of};
use hodograph_base::budget::spend;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::linear::EquationRows;
use hodograph_scene::{GuideId, LinkId, PointId, RollingId, Scene};
use nalgebra::{DMatrix, DVector};
use std::ops::Range;

/// Poses of all links and positions of all points, as far as they are known.
pub type SolvedPoses = (Vec<Option<Pose>>, Vec<Option<Point>>);

/// The values of the drivers, in the order of the scene: radians from the pose in which the link
/// frames are defined, metres along the guide, metres of length.
#[derive(Clone, Debug, PartialEq)]
pub struct DriverValues(pub Vec<f64>);

/// The step of central differences. The residuals are at worst quadratic near the solution, so that
/// the error of the derivative (about 1e-11) only slows the last step of the iteration and does not
/// change its result.
const STEP: f64 = 1.0 / 131_072.0;

/// The greatest number of steps of Newton's method on a group.
const MOST_STEPS: usize = 60;

/// Steps in sequence without a noticeably smaller correction, after which a small motion is taken to
/// have no solution.
const PATIENCE: usize = 4;

/// The largest correction of a small motion, in radians or sizes of the mechanism.
const FARTHEST: f64 = 2.0;

/// The largest residual that rounding may explain: residuals are relative to the mechanism's size.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The derivatives of a form's residuals: by end, equation and coordinate.
type FormSlopes = [[[f64; 3]; 2]; 2];

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
        let mut x = Vec::new();
        for (body, _) in self.bodies() {
            let own = self.coordinates(body, &start.poses, &start.points)?;
            x.extend(own.into_iter().take(self.unknowns(body)));
        }
        Some(DVector::from_vec(x))
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

    /// Returns the unknowns of a body in a pose: two coordinates and, of a link, an angle.
    fn coordinates(
        &self,
        body: usize,
        poses: &[Option<Pose>],
        points: &[Option<Point>],
    ) -> Option<[f64; 3]> {
        let scaled = |p: Point| [p.x / self.scale, p.y / self.scale];
        Some(match body.checked_sub(self.links.len()) {
            None => {
                let pose = poses[self.links[body].0]?;
                let [x, y] = scaled(pose.origin);
                [x, y, pose.axis.angle()]
            }
            Some(pin) => {
                let [x, y] = scaled(points[self.pins[pin].0]?);
                [x, y, 0.0]
            }
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
    /// further below 1e-9. A rough start has many steps before the corrections become smaller.
    pub fn solve(&self, start: &Configuration, drivers: &DriverValues) -> Option<SolvedPoses> {
        self.solve_to(start, drivers, 1e-15, MOST_STEPS)
    }

    /// Solves like [`System::solve`], until the last correction is below `tolerance` (relative to
    /// the mechanism's size, or in radians); gives up after `patience` steps in sequence without a
    /// noticeably smaller correction.
    fn solve_to(
        &self,
        start: &Configuration,
        drivers: &DriverValues,
        tolerance: f64,
        patience: usize,
    ) -> Option<SolvedPoses> {
        let mut at = (start.poses.clone(), start.points.clone());
        let solved = self.blocks.iter().all(|block| {
            self.solve_group(block, &mut at, drivers, (tolerance, patience)).is_some()
        });
        solved.then_some(at)
    }

    /// Solves the equations of one group, whose other links and pins have their final places in
    /// `at`. The last argument has the tolerance and the patience.
    fn solve_group(
        &self,
        block: &GroupBlock,
        at: &mut SolvedPoses,
        drivers: &DriverValues,
        (tolerance, patience): (f64, usize),
    ) -> Option<()> {
        // The unknowns of a pin are first: the equation that puts it on a link eliminates them
        // without fill.
        let pins = block.pins.clone().map(|pin| self.links.len() + pin);
        let (mut bodies, mut x) = (Vec::new(), Vec::new());
        for body in pins.chain(block.links.clone()) {
            bodies.push((body, x.len()));
            x.extend(self.coordinates(body, &at.0, &at.1)?.into_iter().take(self.unknowns(body)));
        }
        let forms = &self.forms[block.forms.clone()];
        let n = x.len();
        if forms.iter().map(|(form, _)| form.equations()).sum::<usize>() != n {
            return None;
        }
        let body = |node| bodies.iter().find(|(body, _)| self.node(*body) == node).copied();
        let ends: Vec<[Option<(usize, usize)>; 2]> = forms
            .iter()
            .map(|(form, _)| {
                let (one, other) = form.ends();
                [one, other].map(body)
            })
            .collect();
        bodies.iter().for_each(|(body, first)| self.put(*body, |k| x[first + k], at));
        let mut rows = EquationRows::new(n);
        let (mut last, mut least, mut waited) = (f64::INFINITY, f64::INFINITY, 0);
        for _ in 0..MOST_STEPS {
            spend();
            rows.clear();
            let mut row = 0;
            for (form, ends) in forms.iter().zip(&ends) {
                self.fill(form, ends, (&x, at), drivers, &mut rows, &mut row);
            }
            let off = rows.largest_right();
            let step = rows.solve()?;
            let size = step.iter().fold(0.0, |size, v| v.abs().max(size));
            // A rough sketch may be far from the solution: a step of more than half a radian (or
            // half the mechanism) is shortened.
            let damp = if size > 0.5 { 0.5 / size } else { 1.0 };
            // From a singular pose a small motion would wander to any other assembly.
            if size > FARTHEST && patience < MOST_STEPS {
                return None;
            }
            x.iter_mut().zip(&step).for_each(|(x, by)| *x += by * damp);
            bodies.iter().for_each(|(body, first)| self.put(*body, |k| x[first + k], at));
            if size < tolerance || (size < 1e-9 && size >= last) {
                return Some(());
            }
            last = size;
            // At a double root the steps halve. Without a root they become smaller up to a point,
            // and then change without a rule.
            waited = if size < 0.75 * least { 0 } else { waited + 1 };
            least = least.min(size);
            if waited >= patience {
                // Close to a limit the equations are satisfied before the corrections are small.
                return (off <= ROUNDING).then_some(());
            }
        }
        (last < 1e-9).then_some(())
    }

    /// Writes the equations of a form, and counts them in `row`: its derivatives by the unknowns of
    /// its ends in the group, and what they must add. `x` are the unknowns, which `at` contains as
    /// poses.
    fn fill(
        &self,
        form: &(PairForm, FormValue<f64>),
        ends: &[Option<(usize, usize)>; 2],
        (x, at): (&[f64], &mut SolvedPoses),
        drivers: &DriverValues,
        rows: &mut EquationRows,
        row: &mut usize,
    ) {
        let begin = *row;
        self.residual(form, at, drivers, |v| {
            rows.set_right(*row, -v);
            *row += 1;
        });
        let slopes = self.slopes_of(&form.0, at);
        for (end, place) in ends.iter().enumerate() {
            let Some((body, first)) = *place else { continue };
            if let Some(slopes) = &slopes {
                for (equation, row) in (begin..*row).enumerate() {
                    let slopes = slopes[end][equation].iter().take(self.unknowns(body));
                    slopes.enumerate().for_each(|(k, slope)| rows.add(row, first + k, *slope));
                }
                continue;
            }
            for k in 0..self.unknowns(body) {
                for (by, sign) in [(STEP, 0.5 / STEP), (-STEP, -0.5 / STEP)] {
                    self.put(body, |n| x[first + n] + if n == k { by } else { 0.0 }, at);
                    let mut row = begin;
                    self.residual(form, at, drivers, |v| {
                        rows.add(row, first + k, sign * v);
                        row += 1;
                    });
                }
            }
            self.put(body, |n| x[first + n], at);
        }
    }

    /// Returns the derivatives of a form's residuals by the coordinates of its two ends (two of a
    /// pin, then the angle of a link): by end, equation and coordinate. `None` for a rolling pair,
    /// whose derivatives are taken as differences.
    fn slopes_of(&self, form: &PairForm, (poses, points): &SolvedPoses) -> Option<FormSlopes> {
        let view = PlacedSystem { system: self, poses, points };
        let s = 1.0 / self.scale;
        let none = [0.0; 3];
        // The rates of a length that changes by `by` where the runner moves and the carrier rests.
        let relative = |by: Vec2, place: Point, carrier: Pose| {
            let arm = (place - carrier.origin).perp() * s;
            [[[by.x, by.y, 0.0], none], [[-by.x, -by.y, -by.dot(arm)], none]]
        };
        Some(match *form {
            PairForm::Meet { pin, link } => {
                let pose = view.pose(link)?;
                let arm = pose.turn(view.local(link, pin)?.to_vec2()).perp() * s;
                [[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [[-1.0, 0.0, -arm.x], [0.0, -1.0, -arm.y]]]
            }
            PairForm::Angles { .. } => [[[0.0, 0.0, 1.0], none], [[0.0, 0.0, -1.0], none]],
            PairForm::OnPath { runner, guide, on } => {
                let (place, carrier) = (view.runner(runner)?, view.pose(on)?);
                let by = match view.path(guide)?.to_world(&carrier) {
                    Path::Line { direction, .. } => direction.perp(),
                    Path::Arc { centre, .. } => (place - centre).unit()?,
                };
                relative(by, place, carrier)
            }
            PairForm::AlongPath { runner, guide, on, .. } => {
                let (place, carrier) = (view.runner(runner)?, view.pose(on)?);
                let by = match view.path(guide)?.to_world(&carrier) {
                    Path::Line { direction, .. } => direction,
                    Path::Arc { centre, radius } => {
                        let out = place - centre;
                        out.perp() * (radius / out.norm2())
                    }
                };
                relative(by, place, carrier)
            }
            PairForm::Distance { from, to, .. } => {
                let by = (view.point(to)? - view.point(from)?).unit()?;
                [[[-by.x, -by.y, 0.0], none], [[by.x, by.y, 0.0], none]]
            }
            PairForm::Related { .. } => return None,
        })
    }

    fn node(&self, body: usize) -> GraphNode {
        match body.checked_sub(self.links.len()) {
            None => GraphNode::Link(self.links[body]),
            Some(pin) => GraphNode::Pin(self.pins[pin]),
        }
    }

    /// Returns the unit of lengths (m): the mechanism's size.
    pub(super) fn scale(&self) -> f64 {
        self.scale
    }
}

/// Returns the derivatives of residuals, a column for each unknown: central differences.
pub(super) fn slopes(
    x: &DVector<f64>,
    residuals: &dyn Fn(&DVector<f64>) -> DVector<f64>,
) -> DMatrix<f64> {
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

/// Moves the mechanism like [`moved`], until the last correction is below `tolerance` (relative to
/// the mechanism's size, or in radians).
pub fn moved_to(
    scene: &Scene,
    mechanism: &Mechanism,
    start: &Configuration,
    drivers: &DriverValues,
    tolerance: f64,
) -> Option<Configuration> {
    let system = System::new(scene, mechanism, &start.shapes, start, &placed(mechanism, start));
    let (poses, points) = system.solve_to(start, drivers, tolerance, PATIENCE)?;
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
