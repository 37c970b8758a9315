//! Working strokes of loads that act over a part of a stroke: their ends.

use crate::mechanism::{Demand, Level, Mechanism, Need};
use crate::position::{Configuration, Path, configure, recompute};
use hodograph_base::diag::{Diagnostic, both};
use hodograph_base::geom::Vec2;
use hodograph_base::trig::sin_cos;
use hodograph_scene::{
    Applied, GivenQuantity, GuideId, LoadCourse, LoadTravel, PointId, Scene, driver_position,
    with_driver_at,
};
use std::f64::consts::TAU;

/// Number of positions in a turn of the first driver.
const SAMPLES: usize = 360;

/// Greatest number of turns after which the motion repeats.
const TURNS: usize = 12;

/// Accuracy of an extreme position, relative to its coordinate and the stroke.
const TOLD: f64 = 1e-13;

/// Difference of crank angles, as a part of a turn, up to which two strokes are equally slow.
const EQUAL: f64 = 1e-9;

/// Relative distance, as a part of the mechanism's size, below which points have returned.
const BACK: f64 = 1e-9;

/// Returns the coordinates along the guide (m) at which the working stroke of a load begins and
/// ends, as the first driver turns; computed once for a scene and all scenes derived from it.
/// `None` for a load without a stroke.
///
/// # Errors
/// `stroke`: the point has no stroke, or the file does not determine which of its two strokes is
/// the working one.
pub fn ends<'a>(
    scene: &Scene,
    course: &'a LoadCourse,
) -> Option<&'a Result<[GivenQuantity; 2], Diagnostic>> {
    let LoadTravel::Stroke { point, guide, toward, ends } = &course.along else { return None };
    Some(ends.0.get_or_init(|| {
        let found =
            Stroke::of(scene, *point, *guide).ok_or_else(|| no_stroke(scene, *point, course))?;
        let upward = match toward {
            Some(toward) => {
                let (sin, cos) = sin_cos(toward.value);
                let along = found.direction.dot(Vec2::new(cos, sin));
                if along.abs() < BACK {
                    let name = scene.point_name(*point);
                    let message =
                        both!("the slider at {name} does not move in the direction of \"toward\"");
                    return Err(Diagnostic::error("stroke", message).at(toward.span));
                }
                along > 0.0
            }
            None => found
                .slower_is_upward(scene)
                .ok_or_else(|| ambiguous_stroke(scene, *point, course))?,
        };
        let [low, high] = [found.low.1, found.high.1];
        let error = TOLD * (high - low).max(low.abs()).max(high.abs());
        let given = |value: f64| GivenQuantity {
            value,
            radius: error,
            text: String::new(),
            span: course.span,
        };
        Ok(if upward { [given(low), given(high)] } else { [given(high), given(low)] })
    }))
}

/// Returns the faults of all strokes of a scene's loads.
pub fn faults_of_strokes(scene: &Scene) -> Vec<Diagnostic> {
    let fault = |a: &Applied| ends(scene, a.course.as_ref()?)?.as_ref().err().cloned();
    scene.loads.applied.iter().filter_map(fault).collect()
}

/// The extreme positions of a point in a guide: driver (rad) and coordinate along the guide (m).
struct Stroke {
    low: (f64, f64),
    high: (f64, f64),
    /// Positive sense of the guide.
    direction: Vec2,
    /// Rotation of the driver (rad) after which the motion repeats.
    period: f64,
}

impl Stroke {
    fn of(scene: &Scene, point: PointId, guide: GuideId) -> Option<Stroke> {
        let mechanism = Mechanism::new(scene).ok()?.value;
        let mut demand = Demand {
            groups: vec![None; mechanism.groups.len()],
            level: Level::Position,
            needs: Vec::new(),
        };
        demand.add(scene, &mechanism, Need::Point(point, None), Level::Position);
        let start = configure(scene, &mechanism, &demand).ok()?.value;
        if !scene.drivers[0].kind.turns() {
            return None;
        }
        let now = driver_position(scene, 0)?;
        let Path::Line { through, direction } = start.guides[guide.0]? else { return None };
        let coordinate = |at: &Configuration| Some((at.points[point.0]? - through).dot(direction));
        let at = |x: f64, near: &Configuration| {
            recompute::<f64>(&with_driver_at(scene, 0, x), &mechanism, &demand, near).ok()
        };
        let step = TAU / SAMPLES as f64;
        let mut all: Vec<(f64, f64, Configuration)> =
            vec![(now, coordinate(&start)?, start.clone())];
        let mut period = None;
        for k in 1..=TURNS * SAMPLES {
            let x = now + step * k as f64;
            let there = at(x, &all.last()?.2)?;
            if k % SAMPLES == 0 && is_back(&start, &there) {
                period = Some(x - now);
                break;
            }
            all.push((x, coordinate(&there)?, there));
        }
        let period = period?;
        let extreme = |sign: f64| {
            let (x, _, near) = all.iter().max_by(|a, b| (sign * a.1).total_cmp(&(sign * b.1)))?;
            let value = |x: f64| Some(sign * coordinate(&at(x, near)?)?);
            golden(x - step, x + step, value).map(|(x, s)| (x, sign * s))
        };
        let (low, high) = (extreme(-1.0)?, extreme(1.0)?);
        (high.1 - low.1 > BACK * start.extent()).then_some(Stroke { low, high, direction, period })
    }

    /// True if the stroke in the positive sense of the guide is the slower one; `None` if both are
    /// equally slow.
    fn slower_is_upward(&self, scene: &Scene) -> Option<bool> {
        let rate = scene.drivers[0].rate.value;
        let up = (self.high.0 - self.low.0).rem_euclid(self.period) / self.period;
        let slower = if rate < 0.0 { 0.5 - up } else { up - 0.5 };
        (rate != 0.0 && slower.abs() > EQUAL).then_some(slower > 0.0)
    }
}

/// True if all points have returned to their positions.
fn is_back(start: &Configuration, there: &Configuration) -> bool {
    let near = BACK * start.extent();
    start
        .points
        .iter()
        .zip(&there.points)
        .all(|(a, b)| a.zip(*b).is_none_or(|(a, b)| a.distance(b) <= near))
}

/// Returns the largest value of a function with one maximum in an interval, by golden section: its
/// abscissa and the value.
fn golden(mut a: f64, mut b: f64, value: impl Fn(f64) -> Option<f64>) -> Option<(f64, f64)> {
    let part = 0.5 * (5.0f64.sqrt() - 1.0);
    let (mut x, mut y) = (b - part * (b - a), a + part * (b - a));
    let (mut fx, mut fy) = (value(x)?, value(y)?);
    for _ in 0..64 {
        if fx >= fy {
            (b, y, fy) = (y, x, fx);
            x = b - part * (b - a);
            fx = value(x)?;
        } else {
            (a, x, fx) = (x, y, fy);
            y = a + part * (b - a);
            fy = value(y)?;
        }
    }
    Some(if fx >= fy { (x, fx) } else { (y, fy) })
}

fn ambiguous_stroke(scene: &Scene, point: PointId, course: &LoadCourse) -> Diagnostic {
    let name = scene.point_name(point);
    let message = both!("which of the two strokes of {name} is the working one is not told");
    let help = both!("add \"toward\": \"0 deg\", the direction of the working stroke");
    Diagnostic::error("stroke", message).at(course.span).help(help)
}

fn no_stroke(scene: &Scene, point: PointId, course: &LoadCourse) -> Diagnostic {
    let name = scene.point_name(point);
    let message = both!(
        "{name} has no stroke: the first driver, told by its angle, must turn fully while {name} goes to and fro"
    );
    let help =
        both!("tell the load without \"over\" and \"diagram\", or by the angle of a driven link");
    Diagnostic::error("stroke", message).at(course.span).help(help)
}
