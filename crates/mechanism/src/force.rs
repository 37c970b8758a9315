//! Loads at an instant: given forces and couples, weights, springs, inertia.
//!
//! Inertia is F_I = −m a_S at the centre of mass and M_I = −J_S α. The accelerations come from the
//! caller: each way of solution uses its own.

mod friction;
mod strokes;

pub use friction::{Rubbed, Rubbing, is_determined, rubbing, settled, with_friction};
pub use strokes::{ends, faults_of_strokes};

use crate::answer::MotionSource;
use crate::mechanism::Level;
use crate::position::{Configuration, Path};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_scene::exact::Inputs;
use hodograph_scene::quantity::{Forces, ROUNDING, Wrench};
use hodograph_scene::{
    Abscissa, Angle, GivenQuantity, LinkId, LoadCourse, LoadSize, LoadTravel, PointId, Position,
    Rolling, RollingId, Scene, Touch,
};

/// Cause of a load.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// An applied force or couple: its index in the scene.
    Applied(usize),
    /// The weight of a link.
    Weight,
    /// The inertia of a link.
    Inertia,
    /// A spring: its index in the scene.
    Spring(usize),
    /// The balancing force or moment that the scene requests.
    Balance,
    /// The force that presses the teeth of a pair apart.
    Teeth(RollingId),
    /// Friction: its index in the scene.
    Friction(usize),
}

/// A load on a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load<N = f64> {
    /// The cause.
    pub cause: Cause,
    /// The link.
    pub link: LinkId,
    /// Point of application; `None` for a couple.
    pub at: Option<PointId>,
    /// Position of the point of application; arbitrary for a couple.
    pub place: Point<N>,
    /// Force, and couple about the position.
    pub wrench: Wrench<N>,
}

impl Load {
    /// Converts the load to another number type.
    pub fn lift<N: Real>(&self) -> Load<N> {
        let Load { cause, link, at, place, wrench } = *self;
        Load { cause, link, at, place: place.lift(), wrench: wrench.lift() }
    }
}

/// Returns all loads at an instant, in the order weight, inertia, applied, springs. Inertia uses
/// the accelerations of `motion`.
///
/// `None` if a position or a motion that a load needs is not known.
pub fn loads<N: Real>(
    scene: &Scene,
    at: &Configuration<N>,
    motion: &impl MotionSource<N>,
) -> Option<Vec<Load<N>>> {
    let inputs = Inputs::of(scene);
    let zero = N::from_f64(0.0);
    let number = |given: &GivenQuantity| inputs.number(given);
    let mut out = Vec::new();
    for mass in &scene.loads.masses {
        let (Some(m), Some(s), Some(gravity)) = (&mass.m, mass.at, &scene.loads.gravity) else {
            continue;
        };
        let g = Vec2::new(number(&gravity[0]), number(&gravity[1]));
        let wrench = Wrench { force: g * number(m), couple: zero };
        out.push(Load {
            cause: Cause::Weight,
            link: mass.link,
            at: Some(s),
            place: at.points[s.0]?,
            wrench,
        });
    }
    for mass in scene.loads.masses.iter().filter(|_| scene.has_inertia()) {
        let force = match (&mass.m, mass.at) {
            (Some(m), Some(s)) => motion.vector(Level::Acceleration, s, None)? * -number(m),
            _ => Vec2::zero(),
        };
        let couple = match &mass.j {
            Some(j) => -(number(j) * motion.turning(Level::Acceleration, mass.link)?),
            None => zero,
        };
        let place = match mass.at {
            Some(s) => at.points[s.0]?,
            None => Point::origin(),
        };
        out.push(Load {
            cause: Cause::Inertia,
            link: mass.link,
            at: mass.at,
            place,
            wrench: Wrench { force, couple },
        });
    }
    for (k, applied) in scene.loads.applied.iter().enumerate() {
        let place = match applied.at {
            Some(p) => at.points[p.0]?,
            None => Point::origin(),
        };
        let turned = |angle: &GivenQuantity<Angle>| {
            let (sin, cos) = inputs.sin_cos(angle);
            Vec2::new(cos, sin)
        };
        let here = match &applied.course {
            Some(course) => here(course, scene, at, motion)?,
            None => CourseLoad::Constant,
        };
        let number = |given: &GivenQuantity| match here {
            CourseLoad::Constant => number(given),
            CourseLoad::Outside => zero,
            CourseLoad::Amount(amount) => amount,
        };
        let wrench = match &applied.size {
            LoadSize::Components([x, y]) => {
                Wrench { force: Vec2::new(number(x), number(y)), couple: zero }
            }
            LoadSize::Directed { force, line, angle } => {
                let base = match line {
                    Some((a, b)) => (at.points[b.0]? - at.points[a.0]?).unit()?,
                    None => Vec2::unit_x(),
                };
                let direction = angle.as_ref().map_or(base, |angle| base.rotate_by(turned(angle)));
                Wrench { force: direction * number(force), couple: zero }
            }
            LoadSize::AgainstMotion(force) => {
                let v = motion.vector(Level::Velocity, applied.at?, Some(applied.link))?;
                let still = v.norm().approx() <= ROUNDING * fastest(scene, at);
                let direction = if still { Vec2::zero() } else { -v.unit()? };
                Wrench { force: direction * number(force), couple: zero }
            }
            LoadSize::Couple(couple) => Wrench { force: Vec2::zero(), couple: number(couple) },
            LoadSize::AgainstTurning(couple) => {
                let omega = motion.turning(Level::Velocity, applied.link)?;
                let still = omega.approx().abs() * at.extent() <= ROUNDING * fastest(scene, at);
                let sense = if still { 0.0 } else { -omega.approx().signum() };
                Wrench { force: Vec2::zero(), couple: number(couple) * N::from_f64(sense) }
            }
        };
        out.push(Load {
            cause: Cause::Applied(k),
            link: applied.link,
            at: applied.at,
            place,
            wrench,
        });
    }
    for (k, spring) in scene.loads.springs.iter().enumerate() {
        let [(p, a), (q, b)] = spring.ends;
        let (from, to) = (at.points[p.0]?, at.points[q.0]?);
        let line = to - from;
        let pull =
            line.unit()? * (number(&spring.stiffness) * (line.norm() - number(&spring.free)));
        for (point, link, place, force) in [(p, a, from, pull), (q, b, to, -pull)] {
            if link != scene.ground {
                out.push(Load {
                    cause: Cause::Spring(k),
                    link,
                    at: Some(point),
                    place,
                    wrench: Wrench { force, couple: zero },
                });
            }
        }
    }
    Some(out)
}

/// Relative distance (of a stroke or a turn) below which a position counts as the end of a course.
pub const NEAR: f64 = 1e-12;

/// Returns the stretches of the loads in a pose: for each applied load the index of the stretch of
/// its course, −1 outside the course, and the sense of the motion that it resists. Between poses
/// with different stretches some load begins, ends, has a corner or changes its sense.
///
/// `None` if a position or a motion that a load needs is not known.
pub fn stretches(
    scene: &Scene,
    at: &Configuration,
    motion: &impl MotionSource,
) -> Option<Vec<i32>> {
    let mut out = Vec::new();
    for applied in &scene.loads.applied {
        out.push(match &applied.course {
            Some(course) => segment(course, scene, at, motion)?
                .map_or(-1, |(k, _)| i32::try_from(k).unwrap_or(i32::MAX)),
            None => 0,
        });
        let sense = match &applied.size {
            // Projection on a fixed direction that no guide has.
            LoadSize::AgainstMotion(_) => motion
                .vector(Level::Velocity, applied.at?, Some(applied.link))?
                .dot(Vec2::new(1.0, 0.618)),
            LoadSize::AgainstTurning(_) => motion.turning(Level::Velocity, applied.link)?,
            LoadSize::Components(_) | LoadSize::Directed { .. } | LoadSize::Couple(_) => 1.0,
        };
        out.push(if sense < 0.0 { -1 } else { 1 });
    }
    Some(out)
}

/// The load of a course at an instant.
enum CourseLoad<N> {
    /// Constant, as given.
    Constant,
    /// Zero: the pose is outside the course.
    Outside,
    /// An interpolated amount (N or N·m).
    Amount(N),
}

/// Returns the load of a course in a pose; `None` if the ends of its stroke, a position or a
/// velocity are not known.
fn here<N: Real>(
    course: &LoadCourse,
    scene: &Scene,
    at: &Configuration<N>,
    motion: &impl MotionSource<N>,
) -> Option<CourseLoad<N>> {
    let Some((k, x)) = segment(course, scene, at, motion)? else {
        return Some(CourseLoad::Outside);
    };
    let [before, after] = &course.stations[k..k + 2] else { return None };
    let (Some(a), Some(b)) = (&before.amount, &after.amount) else {
        return Some(CourseLoad::Constant);
    };
    let inputs = Inputs::<N>::of(scene);
    let place = |x: &Abscissa| match x {
        Abscissa::Part(x) | Abscissa::Way(x) => inputs.number(x),
        Abscissa::Angle(a) => inputs.degrees(a),
    };
    let (a, b, from, to) =
        (inputs.number(a), inputs.number(b), place(&before.at), place(&after.at));
    Some(CourseLoad::Amount(a + (b - a) * ((x - from) / (to - from))))
}

/// Returns the stretch of a course between two stations that contains a pose, with the abscissa of
/// the pose; `Some(None)` outside the course.
fn segment<N: Real>(
    course: &LoadCourse,
    scene: &Scene,
    at: &Configuration<N>,
    motion: &impl MotionSource<N>,
) -> Option<Option<(usize, N)>> {
    let inputs = Inputs::<N>::of(scene);
    let [first, .., last] = &course.stations[..] else { return None };
    let (x, near) = match &course.along {
        LoadTravel::Stroke { point, guide, .. } => {
            let [start, end] = ends(scene, course)?.as_ref().ok()?;
            let Path::Line { through, direction } = at.guides[guide.0]? else { return None };
            let sense = (end.value - start.value).signum();
            let way = direction * N::from_f64(sense);
            let speed = motion.vector(Level::Velocity, *point, None)?.dot(way).approx();
            if speed < -ROUNDING * fastest(scene, at) {
                return Some(None);
            }
            let stroke: N = (inputs.number(end) - inputs.number(start)).magnitude();
            let gone = (at.points[point.0]? - through).dot(way)
                - inputs.number(start) * N::from_f64(sense);
            match first.at {
                Abscissa::Part(_) => (gone / stroke, NEAR),
                Abscissa::Way(_) | Abscissa::Angle(_) => (gone, NEAR * stroke.approx()),
            }
        }
        LoadTravel::Turn { driver, period } => {
            let Position::Angle(angle) = scene.drivers[*driver].kind.position()? else {
                return None;
            };
            let near = NEAR * 360.0;
            let x: N = inputs.degrees(angle);
            let periods =
                libm::floor((x.approx() - first.at.value() + near) / period.value.degrees());
            (x - inputs.degrees(period) * N::from_f64(periods), near)
        }
    };
    let place = x.approx();
    if place < first.at.value() - near || place > last.at.value() + near {
        return Some(None);
    }
    // The load jumps where two stations coincide: the following stretch counts.
    let long = |k: &usize| course.stations[*k].at.value() < course.stations[k + 1].at.value();
    let k = (0..course.stations.len() - 1)
        .filter(long)
        .rfind(|k| course.stations[*k].at.value() <= place)
        .or_else(|| (0..course.stations.len() - 1).find(long))?;
    Some(Some((k, x)))
}

/// Returns the balancing force of 1 N or moment of 1 N·m at the point or link given in the scene;
/// `None` if the scene gives none.
pub fn unit_balance<N: Real>(scene: &Scene, at: &Configuration<N>) -> Option<Load<N>> {
    let balance = scene.loads.balance.as_ref()?;
    let (zero, one) = (N::from_f64(0.0), N::from_f64(1.0));
    let (point, place, wrench) = match &balance.force {
        Some((p, angle)) => {
            let (sin, cos) = Inputs::of(scene).sin_cos(angle);
            (Some(*p), at.points[p.0]?, Wrench { force: Vec2::new(cos, sin), couple: zero })
        }
        None => (None, Point::origin(), Wrench { force: Vec2::zero(), couple: one }),
    };
    Some(Load { cause: Cause::Balance, link: balance.link, at: point, place, wrench })
}

/// The pressure angle (rad) of gears without a given one.
const PRESSURE_ANGLE: f64 = 20.0 * std::f64::consts::PI / 180.0;

/// Returns the forces by which teeth press gears apart, from the forces along the common tangent:
/// |F_t| tan α along the normal, so that the total force of the teeth is on the line of action.
/// They do no work.
pub fn between_teeth<N: Real>(
    scene: &Scene,
    at: &Configuration<N>,
    tangential: &[(RollingId, Vec2<N>)],
) -> Vec<Load<N>> {
    let mut out = Vec::new();
    for (r, force) in tangential {
        let pair = &scene.rolling[r.0];
        let (Touch::Point(_), true) = (pair.touch(), pair.kind.is_toothed()) else { continue };
        let (Some(n), Some(place)) = (at.normal(scene, *r), at.points[pair.at[0].0]) else {
            continue;
        };
        let apart = n * (force.norm() * N::from_f64(libm::tan(pressure_angle(pair))));
        for (link, force) in [(pair.links[0], -apart), (pair.links[1], apart)] {
            if link != scene.ground {
                out.push(Load {
                    cause: Cause::Teeth(*r),
                    link,
                    at: None,
                    place,
                    wrench: Wrench { force, couple: N::from_f64(0.0) },
                });
            }
        }
    }
    out
}

/// Returns the force by which the teeth of a pair press its second link away from the first, from
/// the loads of [`between_teeth`].
pub fn pressed_apart<N: Real>(scene: &Scene, teeth: &[Load<N>], pair: RollingId) -> Vec2<N> {
    let second = scene.rolling[pair.0].links[1];
    // A fixed gear has no loads: only the opposite force is in the list.
    let of_pair = teeth.iter().find(|l| l.cause == Cause::Teeth(pair));
    of_pair
        .map_or(Vec2::zero(), |l| if l.link == second { l.wrench.force } else { -l.wrench.force })
}

/// Returns the angle (rad) between the common tangent of a pair with point contact and the line of
/// action of its force; 0 without teeth.
pub fn pressure_angle(pair: &Rolling) -> f64 {
    if pair.kind.is_toothed() {
        pair.flanks.as_ref().map_or(PRESSURE_ANGLE, |f| f.pressure_angle)
    } else {
        0.0
    }
}

/// Completes reactions with the inertia forces and the reference sizes below which a quantity is
/// rounding.
pub fn completed<N: Real>(
    scene: &Scene,
    at: &Configuration<N>,
    loads: &[Load<N>],
    reactions: Forces<N>,
) -> Forces<N> {
    let Forces { pins, guides, drivers, .. } = &reactions;
    let forces = loads
        .iter()
        .map(|l| l.wrench.force)
        .chain(pins.iter().map(|p| p.2))
        .chain(guides.iter().map(|g| g.1.force));
    let largest = forces.map(|f| f.norm().approx()).fold(inertia_of_rounding(scene, at), f64::max);
    let turned = scene
        .drivers
        .iter()
        .zip(drivers)
        .filter(|(d, _)| d.kind.turns())
        .map(|(_, moment)| *moment);
    let couples = loads
        .iter()
        .map(|l| l.wrench.couple)
        .chain(guides.iter().map(|g| g.1.couple))
        .chain(turned);
    let largest_moment = couples.map(|c| c.approx().abs()).fold(largest * at.extent(), f64::max);
    let inertia =
        loads.iter().filter(|l| l.cause == Cause::Inertia).map(|l| (l.link, l.wrench)).collect();
    Forces {
        inertia,
        largest,
        largest_moment,
        largest_power: largest * fastest(scene, at),
        ..reactions
    }
}

/// Returns the inertia force (N) that rounding produces without acceleration; a force up to this
/// size is zero.
fn inertia_of_rounding<N: Real>(scene: &Scene, at: &Configuration<N>) -> f64 {
    let heaviest =
        scene.loads.masses.iter().filter_map(|m| m.m.as_ref()).map(|m| m.value).fold(0.0, f64::max);
    let speed = fastest(scene, at);
    ROUNDING * heaviest * speed * speed / at.extent().max(f64::MIN_POSITIVE)
}

/// Returns the speed (m/s) relative to which a velocity is judged to be rounding: that of the
/// drivers at the size of the mechanism.
pub fn fastest<N: Real>(scene: &Scene, at: &Configuration<N>) -> f64 {
    let extent = at.extent();
    let of = |d: &hodograph_scene::Driver| {
        d.rate.value.abs() * if d.kind.turns() { extent } else { 1.0 }
    };
    scene.drivers.iter().map(of).fold(0.0, f64::max)
}
