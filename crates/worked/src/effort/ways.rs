//! The ways to the answer, each with its error relative to the truth and its time: the cost of
//! accuracy.
//!
//! Every way does the whole work from positions to answers, except for reading the scene. Errors
//! are those of the worst answer of a level, relative to the answer (or to a thousandth of the
//! largest vector of its kind). The truth is 512-bit arithmetic with a bound of its error.

use super::truth::Differences;
use crate::accuracy::Rung;
use crate::accuracy::{DrawingErrors, simulate};
use crate::worked::{Scope, Worked, work};
use hodograph_analytic as analytic;
use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_base::number::{Ball, Big, Dd, Real, RegionCopy, within};
use hodograph_board::construct::pencil::Single;
use hodograph_board::construct::scale::Boxes;
use hodograph_board::construct::{self, Layout};
use hodograph_mechanism::answer::{AnswerValue, MotionSource, evaluate};
use hodograph_mechanism::mechanism::Level;
use hodograph_mechanism::position::{Configuration, newton};
use hodograph_mechanism::{motion, position};
use hodograph_scene::{Scene, driver_position, with_driver_at};
use hodograph_sweep::extreme::ends;
use std::hint::black_box;
use std::time::Duration;

/// A way to the answers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnswerMethod {
    /// On paper with a pencil of this error (mm): the median, and the error that 95 % of the
    /// drawings stay within.
    Paper(f64),
    /// On the drawing board with each drawn number rounded to `f32`.
    DrawingSingle,
    /// On the drawing board in `f64`.
    Drawing,
    /// Group by group in `f32`.
    ClosedSingle,
    /// Group by group in `f64`.
    Closed,
    /// Group by group in double-double.
    ClosedDouble,
    /// Group by group in numbers of this many bits.
    ClosedLong(usize),
    /// By all loop equations, with positions by Newton's method from a pose 2° off until the last
    /// correction is below this.
    Loops(f64),
    /// By differences of positions over this turn of the driver (rad).
    Differences(f64),
    /// By a rung of the ladder: the error is the bound that it certifies.
    Certified(Rung),
}

/// The measurement of one way.
#[derive(Clone, Debug, PartialEq)]
pub struct MethodMeasurement {
    /// The way.
    pub way: AnswerMethod,
    /// The worst relative error of the requested velocities and accelerations; `None` if nothing of
    /// that level is requested, infinite if the way failed.
    pub errors: [Option<f64>; 2],
    /// The errors that 95 % of the drawings stay within, on paper.
    pub within_95: [Option<f64>; 2],
    /// The median time (s); `None` on paper: the minutes of a human are left out.
    pub seconds: Option<f64>,
}

/// All ways, in the order of the table.
const WAYS: [AnswerMethod; 31] = {
    use AnswerMethod::*;
    [
        Paper(0.5),
        Paper(0.1),
        Paper(0.02),
        DrawingSingle,
        Drawing,
        ClosedSingle,
        Closed,
        ClosedDouble,
        ClosedLong(128),
        ClosedLong(192),
        ClosedLong(256),
        ClosedLong(384),
        Loops(1e-4),
        Loops(1e-6),
        Loops(1e-8),
        Loops(1e-10),
        Loops(1e-12),
        Loops(1e-14),
        Differences(1e-1),
        Differences(1e-2),
        Differences(1e-3),
        Differences(1e-4),
        Differences(1e-5),
        Differences(1e-6),
        Differences(1e-7),
        Differences(1e-8),
        Differences(1e-9),
        Certified(Rung::Double),
        Certified(Rung::DoubleDouble),
        Certified(Rung::Long(192)),
        Certified(Rung::Long(384)),
    ]
};

/// The bits of the truth: 200 and more remain in any pose that is written with twenty decimals.
const TRUTH_BITS: usize = 512;

/// An answer to more digits than an `f64` holds: one or two components.
type LongAnswer = Vec<RegionCopy>;

/// The number of drawings simulated for each pencil.
const DRAWINGS: usize = 400;

/// The clock, and the time for which each way is repeated.
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    /// The time since some moment; it never goes back. (`Instant` is not available everywhere, for
    /// example in a browser.)
    pub now: &'a dyn Fn() -> Duration,
    /// The approximate time for which each way is repeated.
    pub patience: Duration,
}

/// Measures every way on a worked scene; the time is the median over its runs.
///
/// ```
/// use hodograph_worked::effort::ways::{Watch, measure};
/// use hodograph_scene as scene;
/// use hodograph_worked::worked::{Scope, work};
/// use std::time::{Duration, Instant};
///
/// let scene = scene::read(scene::templates::get("crank-rocker").unwrap())?.value;
/// let worked = work(&scene, Scope::Questions)?.value;
/// let start = Instant::now();
/// let measured = measure(&scene, &worked, Watch { now: &|| start.elapsed(), patience: Duration::from_millis(1) })?;
/// assert!(measured.iter().all(|m| m.seconds.is_none_or(|s| s >= 0.0)));
/// # Ok::<(), hodograph_base::diag::Faults>(())
/// ```
///
/// # Errors
/// A pose without a truth: it is singular as written, or a group is not proved.
pub fn measure(
    scene: &Scene,
    worked: &Worked,
    watch: Watch,
) -> Result<Vec<MethodMeasurement>, Faults> {
    of_ways(scene, worked, &WAYS, watch)
}

/// The ways that a series of poses compares.
const SERIES: [AnswerMethod; 7] = {
    use AnswerMethod::*;
    [
        Drawing,
        Loops(1e-8),
        Differences(1e-5),
        Closed,
        Certified(Rung::Double),
        ClosedDouble,
        Certified(Rung::DoubleDouble),
    ]
};

/// One pose of a series.
#[derive(Clone, Debug, PartialEq)]
pub struct TogglePose {
    /// The distance before the toggle (rad, or m for sliders and cylinders).
    pub distance: f64,
    /// The driver's position in the pose (rad or m).
    pub position: f64,
    /// The measurements; empty if the pose has no truth.
    pub ways: Vec<MethodMeasurement>,
}

/// Measures some ways on poses that approach the toggle of the first driver: a tenth before it, a
/// hundredth, down to 1e-12 radians (or of its travel), on the scene's side.
///
/// # Errors
/// Nothing stops the driver, or the pose is given by coordinates.
pub fn toward_toggle(scene: &Scene, watch: Watch) -> Result<Vec<TogglePose>, Faults> {
    let start = driver_position(scene, 0);
    let ends = ends(scene, 0)?.into_iter().flatten();
    let nearest = start.and_then(|s| ends.min_by(|a, b| (a - s).abs().total_cmp(&(b - s).abs())));
    let (Some(start), Some(limit)) = (start, nearest) else {
        let why = if start.is_none() {
            both!("the pose is given by coordinates")
        } else {
            both!("the driver turns fully, nothing stops it")
        };
        return Err(Diagnostic::error(
            "no-toggle",
            both!("there is no toggle to approach: {}", why),
        )
        .help(both!(
            "drive another link, for instance the rocker of a crank-rocker, and give its angle"
        ))
        .into());
    };
    let unit = if scene.drivers[0].kind.turns() { 1.0 } else { (start - limit).abs() };
    let mut series = Vec::new();
    for k in 1..=12 {
        let distance = libm::exp10(f64::from(-k)) * unit;
        let position = limit + distance.copysign(start - limit);
        let there = with_driver_at(scene, 0, position);
        let ways = match work(&there, Scope::Questions) {
            Ok(worked) => of_ways(&there, &worked.value, &SERIES, watch).unwrap_or_default(),
            Err(_) => Vec::new(),
        };
        series.push(TogglePose { distance, position, ways });
    }
    Ok(series)
}

fn of_ways(
    scene: &Scene,
    worked: &Worked,
    ways: &[AnswerMethod],
    watch: Watch,
) -> Result<Vec<MethodMeasurement>, Faults> {
    let truth = truth(scene, worked)?;
    if truth.iter().all(Option::is_none) {
        return Err(
            Diagnostic::error("no-truth", both!("no answer has a value in this pose")).into()
        );
    }
    Ok(ways.iter().map(|way| one(scene, worked, &truth, *way, watch)).collect())
}

fn truth(scene: &Scene, worked: &Worked) -> Result<Vec<Option<LongAnswer>>, Faults> {
    within(TRUTH_BITS, || {
        let answers = closed::<Ball<Big>>(scene, worked)?;
        let plain = |x: Ball<Big>| x.is_decided().then(|| x.middle());
        Ok(answers
            .into_iter()
            .map(|a| {
                let (x, y) = a?.numbers();
                std::iter::once(x).chain(y).map(|x| plain(x)?.keep()).collect()
            })
            .collect())
    })
}

fn kept(value: AnswerValue<Big>) -> Option<LongAnswer> {
    let (x, y) = value.numbers();
    std::iter::once(x).chain(y).map(|x| x.keep()).collect()
}

type AnswerValues<N> = Vec<Option<AnswerValue<N>>>;

/// Positions, motions and answers group by group.
fn closed<N: motion::MotionNumber>(
    scene: &Scene,
    worked: &Worked,
) -> Result<AnswerValues<N>, Faults> {
    let at =
        position::recompute::<N>(scene, &worked.mechanism, &worked.demand, &worked.configuration)?;
    let motion = motion::solve(scene, &worked.mechanism, &at, &worked.demand);
    Ok(asked(scene, worked, &at, &motion))
}

fn asked<N: Real>(
    scene: &Scene,
    worked: &Worked,
    at: &Configuration<N>,
    source: &impl MotionSource<N>,
) -> AnswerValues<N> {
    worked.results.iter().map(|r| evaluate(scene, at, source, &scene.find[r.find].what)).collect()
}

/// The values read for the questions that have an answer in the pose.
fn of_results(worked: &Worked, read: AnswerValues<f64>) -> AnswerValues<f64> {
    worked.results.iter().map(|r| read[r.find]).collect()
}

/// Repeats a way for the watch's time and takes the median of the times of its runs.
fn timed<T>(watch: Watch, mut run: impl FnMut() -> T) -> (T, f64) {
    let begin = (watch.now)();
    let since = |start: Duration| (watch.now)().saturating_sub(start);
    let mut last = run();
    let mut times = vec![since(begin)];
    while since(begin) < watch.patience && times.len() < 10_000 {
        let start = (watch.now)();
        last = black_box(run());
        times.push(since(start));
    }
    times.sort();
    (last, times[times.len() / 2].as_secs_f64())
}

fn one(
    scene: &Scene,
    worked: &Worked,
    truth: &[Option<LongAnswer>],
    way: AnswerMethod,
    watch: Watch,
) -> MethodMeasurement {
    let lift = |answers: Option<AnswerValues<f64>>| {
        answers.map(|list| list.into_iter().map(lifted).collect::<Vec<_>>())
    };
    let mut within_95 = [None, None];
    let in_double = |f: &dyn Fn() -> Option<AnswerValues<f64>>| {
        let (answers, seconds) = timed(watch, f);
        (worst(scene, worked, truth, within(TRUTH_BITS, || lift(answers))), Some(seconds))
    };
    let (errors, seconds) = match way {
        AnswerMethod::Paper(mm) => {
            let drawn = worked.drawn(scene);
            let errors = simulate(&drawn, mm, DRAWINGS, 1);
            let of = |pick: fn(&DrawingErrors) -> f64| {
                by_level(scene, worked, |i| {
                    errors[worked.results[i].find]
                        .as_ref()
                        .map(|e| pick(e) / size(worked, i))
                        .unwrap_or(f64::INFINITY)
                })
            };
            within_95 = of(|e| e.within_95);
            (of(|e| e.median), None)
        }
        AnswerMethod::DrawingSingle => {
            let drawn = worked.drawn(scene);
            in_double(&|| {
                Some(of_results(
                    worked,
                    drawn.read_with(&Layout::of(&worked.construction), &mut Single).ok()?,
                ))
            })
        }
        AnswerMethod::Drawing => in_double(&|| {
            let at = position::recompute::<f64>(
                scene,
                &worked.mechanism,
                &worked.demand,
                &worked.configuration,
            )
            .ok()?;
            let boxes = Boxes::of(&scene.paper, &worked.plan);
            let paper =
                construct::construct(scene, &worked.mechanism, &at, &worked.plan, &boxes).ok()?;
            let read = construct::read(scene, &worked.mechanism, &at, &worked.plan, &paper);
            Some(of_results(worked, read.into_iter().map(|a| a.map(|a| a.value)).collect()))
        }),
        AnswerMethod::ClosedSingle => {
            let (answers, seconds) = timed(watch, || closed::<f32>(scene, worked).ok());
            let wide = |v: AnswerValue<f32>| v.map(f64::from);
            let answers = answers.map(|l| l.into_iter().map(|v| v.map(wide)).collect());
            (worst(scene, worked, truth, within(TRUTH_BITS, || lift(answers))), Some(seconds))
        }
        AnswerMethod::Closed => in_double(&|| closed::<f64>(scene, worked).ok()),
        AnswerMethod::ClosedDouble => {
            let (answers, seconds) = timed(watch, || closed::<Dd>(scene, worked).ok());
            let long = |x: Dd| Big::from_f64(x.parts().0) + Big::from_f64(x.parts().1);
            let answers = within(TRUTH_BITS, || {
                answers.map(|l| {
                    l.into_iter().map(|v| v.and_then(|v| kept(v.map(long)))).collect::<Vec<_>>()
                })
            });
            (worst(scene, worked, truth, answers), Some(seconds))
        }
        AnswerMethod::ClosedLong(bits) => {
            let (answers, seconds) = timed(watch, || {
                within(bits, || {
                    closed::<Big>(scene, worked)
                        .ok()
                        .map(|l| l.into_iter().map(|v| v.and_then(kept)).collect::<Vec<_>>())
                })
            });
            (worst(scene, worked, truth, answers), Some(seconds))
        }
        AnswerMethod::Loops(tolerance) => match off(scene, worked, -OFF) {
            Some(start) => in_double(&|| {
                let drivers = newton::driver_values(scene, &worked.configuration);
                let at = newton::moved_to(scene, &worked.mechanism, &start, &drivers, tolerance)?;
                let solution =
                    analytic::solve(scene, &worked.mechanism, &at, &worked.demand).ok()?;
                Some(asked(scene, worked, &at, &solution))
            }),
            None => (by_level(scene, worked, |_| f64::INFINITY), None),
        },
        AnswerMethod::Differences(h) => in_double(&|| {
            let [before, after] = [off(scene, worked, -h)?, off(scene, worked, h)?];
            let source = Differences {
                before,
                now: worked.configuration.clone(),
                after,
                step: h / pace(scene, worked)?,
            };
            Some(asked(scene, worked, &source.now, &source))
        }),
        AnswerMethod::Certified(rung) => {
            let mut bounds: Vec<Option<f64>> = Vec::new();
            let (_, seconds) = timed(watch, || bounds = certified(scene, worked, rung));
            let bound = |i: usize| {
                bounds.get(i).copied().flatten().map_or(f64::INFINITY, |b| b / size(worked, i))
            };
            (by_level(scene, worked, bound), Some(seconds))
        }
    };
    MethodMeasurement { way, errors, within_95, seconds }
}

/// The radius of each answer in one rung.
fn certified(scene: &Scene, worked: &Worked, rung: Rung) -> Vec<Option<f64>> {
    fn radii<M: hodograph_base::number::ball::Middle>(
        scene: &Scene,
        worked: &Worked,
    ) -> Vec<Option<f64>>
    where
        Ball<M>: motion::MotionNumber,
    {
        let radius = |v: AnswerValue<Ball<M>>| match v.numbers() {
            (s, None) => s.radius(),
            (x, Some(y)) => libm::hypot(x.radius(), y.radius()),
        };
        closed::<Ball<M>>(scene, worked)
            .map(|l| l.into_iter().map(|v| v.map(radius)).collect())
            .unwrap_or_default()
    }
    match rung {
        Rung::Double => radii::<f64>(scene, worked),
        Rung::DoubleDouble => radii::<Dd>(scene, worked),
        Rung::Long(bits) => within(bits, || radii::<Big>(scene, worked)),
    }
}

/// The distance of the pose at which the loop equations start: radians of the driver, or sizes of
/// the mechanism.
const OFF: f64 = 0.035;

/// The rate of the first driver that moves, in radians or sizes of the mechanism per second.
fn pace(scene: &Scene, worked: &Worked) -> Option<f64> {
    let first = scene.drivers.iter().find(|d| d.rate.value != 0.0)?;
    let unit = if first.kind.turns() { 1.0 } else { worked.configuration.extent() };
    Some(first.rate.value.abs() / unit)
}

/// The configuration after the first moving driver has advanced by `h`, and the others with it.
fn off(scene: &Scene, worked: &Worked, h: f64) -> Option<Configuration> {
    let t = h / pace(scene, worked)?;
    let mut drivers = newton::driver_values(scene, &worked.configuration);
    for (value, d) in drivers.0.iter_mut().zip(&scene.drivers) {
        *value += d.rate.value * t + 0.5 * d.acceleration.as_ref().map_or(0.0, |a| a.value) * t * t;
    }
    newton::moved(scene, &worked.mechanism, &worked.configuration, &drivers)
}

fn lifted(v: Option<AnswerValue>) -> Option<LongAnswer> {
    kept(v?.map(Big::from_f64))
}

/// The reference size of an answer's error.
fn size(worked: &Worked, i: usize) -> f64 {
    let r = &worked.results[i];
    let size = r.computed.magnitude().max(1e-3 * r.scale);
    if size > 0.0 { size } else { 1.0 }
}

/// The worst error of each level; `None` if no question is of the level.
fn by_level(scene: &Scene, worked: &Worked, error: impl Fn(usize) -> f64) -> [Option<f64>; 2] {
    Level::RATES.map(|level| {
        let of_level = (0..worked.results.len())
            .filter(|&i| scene.find[worked.results[i].find].what.level() == level);
        of_level.map(&error).map(|e| if e.is_nan() { f64::INFINITY } else { e }).reduce(f64::max)
    })
}

fn worst(
    scene: &Scene,
    worked: &Worked,
    truth: &[Option<LongAnswer>],
    answers: Option<Vec<Option<LongAnswer>>>,
) -> [Option<f64>; 2] {
    let answers = answers.unwrap_or_default();
    within(TRUTH_BITS, || {
        by_level(scene, worked, |i| {
            let (Some(Some(a)), Some(t)) = (answers.get(i), &truth[i]) else {
                return f64::INFINITY;
            };
            let difference = a
                .iter()
                .zip(t)
                .map(|(a, t)| (a.take() - t.take()).approx().abs())
                .fold(0.0, libm::hypot);
            difference / size(worked, i)
        })
    })
}
