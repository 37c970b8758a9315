//! Positions, velocities and accelerations of points through the travel of one driver, or through
//! time (the vectors drawn from one pole are their hodographs).
//!
//! [`super::follow`] follows the mechanism, and the loop equations solve each pose. A single driver
//! in motion runs at the scene's rate, with the scene's acceleration, in every pose; through time
//! the rates are those of the time. Poses are added between the steps where a curve bends.

use super::follow::{PoseFollower, PoseSweep, TravelPose};
use super::station;
use hodograph_analytic as analytic;
use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::answer::AnswerValue;
use hodograph_mechanism::mechanism::{Demand, Mechanism};
use hodograph_mechanism::position::Configuration;
use hodograph_scene::quantity::{Level, PointMotion, Rate};
use hodograph_scene::{Asked, Find, GivenQuantity, LinkId, OnLink, PointId, Scene, Swept};

/// Steps through a turn: 1°, the resolution of a printed curve.
const STEPS: usize = 360;
/// The greatest distance of a curve from its chord, relative to its size: a tenth of a millimetre
/// on a drawing of 100 mm.
const BEND: f64 = 1e-3;
/// The number of rounds of halving: next to a limit everything varies as the root of the distance,
/// and steps become small quickly.
const ROUNDS: usize = 7;
/// The number of poses above which no more are added: a curve of the size of a page cannot show
/// them.
const MOST_MOMENTS: usize = 3000;
/// The ratio of a vector to the median above which it is off the paper: next to a limit vectors
/// grow beyond all bounds.
const OFF_PAPER: f64 = 2.5;

/// One pose, with the velocities and accelerations of the points.
#[derive(Clone, Debug)]
pub struct PointMoment {
    /// The travel of the driver, or the time, from the scene's pose (rad, m or s).
    pub travel: f64,
    /// The driver's position, or the time (rad, m or s).
    pub place: f64,
    /// The configuration.
    pub configuration: Configuration,
    /// Velocity (m/s) and acceleration (m/s²) of each point; `None` where they are unbounded or
    /// have no value.
    pub vectors: Vec<[Option<Vec2>; 2]>,
}

impl PointMoment {
    /// The velocity or the acceleration of a point; `None` for positions.
    pub fn vector(&self, point: usize, level: Level) -> Option<Vec2> {
        self.vectors[point][Level::RATES.iter().position(|rate| *rate == level)?]
    }
}

/// The motion of some points through a driver's travel.
#[derive(Clone, Debug)]
pub struct PathMotion {
    /// The points.
    pub points: Vec<PointId>,
    /// All poses, in the order of travel.
    pub moments: Vec<PointMoment>,
    /// Poses at equal steps of the driver or of the time; the ends of a bounded travel are among
    /// them.
    pub marks: Vec<PointMoment>,
    /// True if the mechanism returns to its first pose after a full turn.
    pub full: bool,
    /// True for the beginning, and for the end, if the mechanism can go no farther there.
    pub limits: [bool; 2],
}

/// The scene with all other drivers at rest, so that a velocity is tangent to the path.
pub fn alone(scene: &Scene, swept: Swept) -> Scene {
    let mut scene = scene.clone();
    let Swept::Driver(driver) = swept else { return scene };
    for (_, d) in scene.drivers.iter_mut().enumerate().filter(|(d, _)| *d != driver) {
        d.rate = GivenQuantity { value: 0.0, radius: 0.0, text: "0".into(), span: d.rate.span };
        d.acceleration = None;
    }
    scene
}

/// Returns the largest size that one paper holds: of a motion without limits the largest of all; of
/// another 2.5 times the median at most, but in any case the scene's `own`. `None` if there are no
/// sizes.
pub fn bounded(mut sizes: Vec<f64>, own: f64, unlimited: bool) -> Option<f64> {
    sizes.sort_by(f64::total_cmp);
    let largest = *sizes.last()?;
    Some(if unlimited {
        largest
    } else {
        largest.min((OFF_PAPER * sizes[sizes.len() / 2]).max(own))
    })
}

/// Returns the place (m) of a point as it is seen from a link, on the link as it is in `base`;
/// `None` if the link has no direction or the point no place.
pub fn seen_from(
    at: &Configuration,
    base: &Configuration,
    point: PointId,
    link: LinkId,
) -> Option<Point> {
    let local = at.poses[link.0]?.to_local(at.points[point.0]?);
    Some(base.poses[link.0]?.to_world(local))
}

/// Returns the pose of a motion at a travel; `None` if it has none there.
pub fn pose_at(follower: &PoseFollower, sweep: &PoseSweep, travel: f64) -> Option<TravelPose> {
    let off = |p: &TravelPose| (p.travel - travel).abs();
    let near = sweep.poses.iter().min_by(|a, b| off(a).total_cmp(&off(b)))?;
    let range = sweep.poses.last()?.travel - sweep.poses.first()?.travel;
    // A pose of the sweep within rounding is that pose: at a limit there is no pose beyond it.
    if off(near) <= 1e-9 * range {
        return Some(near.clone());
    }
    Some(TravelPose { travel, configuration: follower.at(&near.configuration, travel)? })
}

/// Returns `count` poses at equal steps of the driver, in the sense of its motion: from the scene's
/// own through a full turn, or from one end of the travel to the other.
pub fn at_equal_steps(follower: &PoseFollower, sweep: &PoseSweep, count: usize) -> Vec<TravelPose> {
    let (Some(first), Some(last)) = (sweep.poses.first(), sweep.poses.last()) else {
        return Vec::new();
    };
    let turn = sweep.period();
    let (from, step) = match (sweep.full, count) {
        (true, n) => (0.0, turn / n.max(1) as f64),
        (false, 1) => (0.0, 0.0),
        (false, n) => (first.travel, (last.travel - first.travel) / (n.max(2) - 1) as f64),
    };
    let pose = |k: usize| {
        let travel = if !sweep.full && count > 1 && k + 1 == count {
            last.travel
        } else {
            from + step * k as f64
        };
        pose_at(follower, sweep, travel)
    };
    let mut poses: Vec<TravelPose> = (0..count).filter_map(pose).collect();
    if follower.goes_back() {
        // A turn begins with the scene's own pose in either sense.
        poses[usize::from(sweep.full)..].reverse();
    }
    poses
}

struct Tracer<'a> {
    scene: Scene,
    mechanism: &'a Mechanism,
    demand: Demand,
    follower: &'a PoseFollower<'a>,
    /// The driver's position, or the time, in the scene's own pose.
    now: f64,
    points: &'a [PointId],
    unlimited: bool,
}

/// Follows the points of a placed scene through the travel of a driver, or through time, and marks
/// `marks` poses at equal steps of it.
///
/// The configuration was made for `demand`, which holds all positions. If one driver moves, the
/// others keep their positions, with their rates.
pub fn motion(
    scene: &Scene,
    mechanism: &Mechanism,
    demand: &Demand,
    at: &Configuration,
    swept: Swept,
    points: &[PointId],
    marks: usize,
) -> PathMotion {
    let asked: Vec<Find> = points.iter().flat_map(|p| questions(scene, *p)).collect();
    let scene = scene.clone();
    let wanted = Demand::of_questions(&scene, mechanism, &asked).with_all_positions();
    let follower = PoseFollower::new(&scene, mechanism, demand, at, swept);
    let sweep = follower.sweep(STEPS);
    let now = station::now(&scene, at, swept);
    let tracer = Tracer {
        scene,
        mechanism,
        demand: wanted,
        follower: &follower,
        now,
        points,
        unlimited: sweep.is_unlimited(),
    };
    let limits = [0, sweep.poses.len() - 1].map(|k| sweep.is_limit(k));
    let mut moments: Vec<PointMoment> = sweep.poses.iter().map(|p| tracer.moment(p)).collect();
    if sweep.full
        && let Some(first) = moments.first().cloned()
    {
        moments.push(PointMoment { travel: sweep.period(), ..first });
    }
    let marks = at_equal_steps(&follower, &sweep, marks).iter().map(|p| tracer.moment(p)).collect();
    for _ in 0..ROUNDS {
        if moments.len() > MOST_MOMENTS || !tracer.refine(&mut moments) {
            break;
        }
    }
    if sweep.full {
        moments.pop();
    }
    PathMotion { points: points.to_vec(), moments, marks, full: sweep.full, limits }
}

/// The questions for a point's velocity and acceleration.
pub fn questions(scene: &Scene, point: PointId) -> [Find; 2] {
    let of = OnLink { point, link: None };
    let name = scene.point_name(point);
    let span = scene.points[point.0].span;
    Rate::ALL.map(|rate| {
        let what = Asked::from(PointMotion { rate, of });
        Find { text: format!("{}_{name}", what.entry().symbol), what, span }
    })
}

impl Tracer<'_> {
    fn moment(&self, pose: &TravelPose) -> PointMoment {
        let scene = self.follower.scene_at(&self.scene, pose.travel);
        let at = &pose.configuration;
        let solution = analytic::solve(&scene, self.mechanism, at, &self.demand).ok();
        let vector = |find: &Find| match solution.as_ref()?.answer(&scene, at, &find.what)? {
            AnswerValue::Vector(v) => v.is_finite().then_some(v),
            AnswerValue::Scalar(_) | AnswerValue::Point(_) => None,
        };
        let vectors =
            self.points.iter().map(|p| questions(&scene, *p).each_ref().map(vector)).collect();
        PointMoment {
            travel: pose.travel,
            place: self.now + pose.travel,
            configuration: at.clone(),
            vectors,
        }
    }

    /// Adds poses where a curve is farther from its chord than print can show; returns `true` if
    /// there were any.
    fn refine(&self, moments: &mut Vec<PointMoment>) -> bool {
        let most = |of: &dyn Fn(&PointMoment) -> Option<f64>| {
            bounded(moments.iter().filter_map(of).collect(), 0.0, self.unlimited).unwrap_or(0.0)
        };
        let sizes: Vec<[f64; 3]> = (0..self.points.len())
            .map(|k| {
                let level = |l: usize| most(&|m: &PointMoment| m.vectors[k][l].map(Vec2::norm));
                let first = moments.first().and_then(|m| m.configuration.points[self.points[k].0]);
                [
                    most(&|m: &PointMoment| {
                        Some(m.configuration.points[self.points[k].0]?.distance(first?))
                    }),
                    level(0),
                    level(1),
                ]
            })
            .collect();
        let old = std::mem::take(moments);
        let count = old.len();
        let mut old = old.into_iter().peekable();
        while let Some(a) = old.next() {
            let between = old.peek().and_then(|b| self.between(&a, b, &sizes));
            moments.push(a);
            moments.extend(between);
        }
        moments.len() > count
    }

    /// The pose in the middle of two, if it is needed.
    fn between(&self, a: &PointMoment, b: &PointMoment, sizes: &[[f64; 3]]) -> Option<PointMoment> {
        // The middle of two poses of a smooth curve is off its chord by at most an eighth of the
        // change of the chord's direction: with near ends nothing needs to be examined.
        let parts = |m: &PointMoment, k: usize| {
            let place = m.configuration.points[self.points[k].0].map(|p| p.to_vec2());
            [place, m.vectors[k][0], m.vectors[k][1]]
        };
        let shown = |v: Option<Vec2>, level: usize, most: f64| {
            v.filter(|v| level == 0 || v.norm() <= most * (1.0 + BEND))
        };
        let apart = (0..sizes.len()).any(|k| {
            (0..3).any(|l| {
                match (shown(parts(a, k)[l], l, sizes[k][l]), shown(parts(b, k)[l], l, sizes[k][l]))
                {
                    (Some(p), Some(q)) => (p - q).norm() > 16.0 * BEND * sizes[k][l],
                    (None, None) => false,
                    // The curve leaves the paper between the two.
                    _ => true,
                }
            })
        });
        if !apart {
            return None;
        }
        let travel = 0.5 * (a.travel + b.travel);
        let configuration = self.follower.at(&a.configuration, travel)?;
        let middle = self.moment(&TravelPose { travel, configuration });
        let bends = (0..sizes.len()).any(|k| {
            let (p, q, m) = (parts(a, k), parts(b, k), parts(&middle, k));
            (0..3).any(|l| match (shown(p[l], l, sizes[k][l]), shown(q[l], l, sizes[k][l]), m[l]) {
                (Some(p), Some(q), Some(m)) => ((p + q) * 0.5 - m).norm() > BEND * sizes[k][l],
                (None, None, _) => false,
                _ => true,
            })
        });
        bends.then_some(middle)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_grows_beyond_all_bounds_is_not_on_the_paper() {
        let sizes = vec![1.0, 1.5, 90.0, 1.2, 2.0];
        assert_eq!(bounded(sizes.clone(), 1.0, true), Some(90.0));
        assert_eq!(bounded(sizes.clone(), 1.0, false), Some(3.75));
        assert_eq!(bounded(sizes, 8.0, false), Some(8.0));
        assert_eq!(bounded(vec![], 0.0, true), None);
    }
}
