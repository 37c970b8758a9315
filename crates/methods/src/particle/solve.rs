//! The answers, with intervals that contain them.
//!
//! Quantities that follow from laws alone are evaluated in balls of `f64`, or of 256 bits if those
//! leave fewer digits than wanted. Quantities of a pursuit start from the integrated place with its
//! error bound.

use super::ask::{Mutual, ParticleQuantity};
use super::plate::PlateState;
use super::pursuit::{self, Chase, PursuitEnd};
use super::{ParticleMotion, ParticleMotionKind, ParticleProblem};
use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_base::number::decimal::{Certain, Enclosure};
use hodograph_base::number::{Ball, Big, Dd, Real, within};

/// Bits of the longer numbers.
const BITS: usize = 256;

/// An answer.
#[derive(Clone, Debug)]
pub struct ParticleAnswer {
    /// The index of the question.
    pub find: usize,
    /// The value, or the reason for which there is none.
    pub value: ParticleValue,
}

/// A value (SI).
#[derive(Clone, Debug)]
pub enum ParticleValue {
    /// A vector or place by x, y and, in space, z; then its magnitude.
    Vector(Vec<Enclosure>, Enclosure),
    /// A number.
    Scalar(Enclosure),
    /// No value, with the reason.
    None(Diagnostic),
}

impl ParticleValue {
    /// Returns the number, to `f64`.
    pub fn scalar(&self) -> Option<f64> {
        match self {
            ParticleValue::Scalar(e) => Some(e.approx),
            ParticleValue::Vector(..) | ParticleValue::None(_) => None,
        }
    }

    /// Returns the components, to `f64`.
    pub fn vector(&self) -> Option<Vec<f64>> {
        match self {
            ParticleValue::Vector(all, _) => Some(all.iter().map(|e| e.approx).collect()),
            ParticleValue::Scalar(_) | ParticleValue::None(_) => None,
        }
    }
}

/// The answers of a problem.
#[derive(Clone, Debug)]
pub struct ParticleSolution {
    /// The answers, one for each question, in order.
    pub answers: Vec<ParticleAnswer>,
    /// The end of each pursuit, with the index of its motion in the list.
    pub ends: Vec<(usize, PursuitEnd)>,
}

/// Solves a problem.
///
/// # Errors
/// Laws without a value at the instant, pursuits that cannot be followed, an instant after the
/// meeting.
pub fn solve(problem: &ParticleProblem) -> Result<ParticleSolution, Faults> {
    let mut ends = Vec::new();
    let (mut chases, mut lost) = (Vec::new(), Vec::new());
    for (k, m) in problem.motions.iter().enumerate() {
        let Some((chase, target)) = problem.chase(m) else { continue };
        // Answers at the instant are possible even if the end of a pursuit is not found.
        match ended(&chase) {
            Ok(end) => ends.push((k, end)),
            Err(d) if d.code == pursuit::LOST => lost.push((k, d)),
            Err(d) => return Err(d.into()),
        }
        let end = ends.iter().find(|e| e.0 == k).map(|e| &e.1);
        chases.push((k, caught(problem, &chase, m, target, end, longer(&chase)?)?));
    }
    Ok(ParticleSolution { answers: answered(problem, &chases, &ends, &lost)?, ends })
}

/// Solves a problem at another instant: ends of pursuits are known, and courses are followed in
/// `f64`, with fewer certain digits and in a hundredth of the time.
///
/// # Errors
/// The errors of [`solve`].
pub fn solve_again(
    problem: &ParticleProblem,
    known: &ParticleSolution,
) -> Result<ParticleSolution, Faults> {
    let mut chases = Vec::new();
    for (k, end) in &known.ends {
        let m = &problem.motions[*k];
        let Some((chase, target)) = problem.chase(m) else { continue };
        chases.push((*k, caught(problem, &chase, m, target, Some(end), false)?));
    }
    Ok(ParticleSolution {
        answers: answered(problem, &chases, &known.ends, &[])?,
        ends: known.ends.clone(),
    })
}

fn answered(
    problem: &ParticleProblem,
    chases: &[(usize, PursuitVector)],
    ends: &[(usize, PursuitEnd)],
    lost: &[(usize, Diagnostic)],
) -> Result<Vec<ParticleAnswer>, Diagnostic> {
    let answer = |(find, question): (usize, &super::ParticleQuestion)| {
        let gone =
            |k: usize| lost.iter().find(|l| l.0 == k).map(|l| ParticleValue::None(l.1.clone()));
        let value = match question.what {
            ParticleQuantity::MeetingTime(k) | ParticleQuantity::MeetingPlace(k)
                if gone(k).is_some() =>
            {
                gone(k).unwrap_or_else(|| ParticleValue::None(undecided()))
            }
            ParticleQuantity::MeetingTime(k) => meeting(problem, k, ends, |time, _| scalar(time)),
            ParticleQuantity::MeetingPlace(k) => {
                meeting(problem, k, ends, |_, place| vector(&place))
            }
            ParticleQuantity::Distance(k) | ParticleQuantity::LineOmega(k) => {
                of_chase(problem, k, chases, question.what)?
            }
            ParticleQuantity::Place(k)
            | ParticleQuantity::Velocity(k)
            | ParticleQuantity::Acceleration(k)
            | ParticleQuantity::Curvature(k) => match problem.motions[k].kind {
                ParticleMotionKind::Toward { .. } => of_chase(problem, k, chases, question.what)?,
                ParticleMotionKind::Fixed(_) | ParticleMotionKind::OnPlate(..) => {
                    by_law(problem, k, question.what)?
                }
            },
            ParticleQuantity::Part(k, _) => by_law(problem, k, question.what)?,
            ParticleQuantity::Between(two, m) => between(problem, two, m, chases)?,
        };
        Ok(ParticleAnswer { find, value })
    };
    problem.find.iter().enumerate().map(answer).collect()
}

/// Returns the end of a pursuit, in the longest numbers in which its laws have values. `f64`
/// decides whether there is an end: a pursuit that circles behind a faster target for ever, or for
/// a long time before the meeting, is not followed in numbers that take fifty times as long.
fn ended(chase: &Chase) -> Result<PursuitEnd, Diagnostic> {
    let mut steps = 0;
    match chase.end_seen::<f64>(&mut |_| steps += 1)? {
        PursuitEnd::Meet { .. } if longer(chase)? && steps <= pursuit::MOST_LONGER => {
            chase.end::<Dd>()
        }
        end @ (PursuitEnd::Meet { .. } | PursuitEnd::Apart { .. }) => Ok(end),
    }
}

/// True if the laws have values in double-double numbers.
fn longer(chase: &Chase) -> Result<bool, Diagnostic> {
    let start = chase.start::<Dd>()?;
    Ok(start.d.iter().all(|x| x.is_decided())
        && chase.target.at(start.t)?.iter().all(|j| j.is_decided()))
}

type PursuitVector = [Ball<Dd>; 2];

/// Returns the vector from pursuer to target at the instant.
fn caught(
    problem: &ParticleProblem,
    chase: &Chase,
    m: &ParticleMotion,
    target: &str,
    end: Option<&PursuitEnd>,
    long: bool,
) -> Result<PursuitVector, Faults> {
    let now = problem.instant();
    if let Some(PursuitEnd::Meet { time, .. }) = end
        && now >= time.approx() - time.radius()
    {
        let d = Diagnostic::error(
            "pursuit",
            both!(
                "{} has caught {target} at {} s, before the instant of {now} s",
                m.point,
                time.approx()
            ),
        );
        return Err(d.help(both!("take a \"time\" before that")).into());
    }
    Ok(if long { at_instant::<Dd>(problem, chase)? } else { at_instant::<f64>(problem, chase)? })
}

fn at_instant<N: Real + Into<Dd>>(
    problem: &ParticleProblem,
    chase: &Chase,
) -> Result<PursuitVector, Diagnostic> {
    let t = problem.time.at(N::from_f64(0.0))?.number.0[0];
    let (state, _) = chase.follow(chase.start::<N>()?, Some(t), &mut |_| {})?;
    Ok(state.enclosed())
}

/// Returns the states of a pursuit at times in ascending order, for figures.
///
/// # Errors
/// The errors of [`Chase::follow`].
pub fn course(chase: &Chase, times: &[f64]) -> Result<Vec<pursuit::PursuitState<f64>>, Diagnostic> {
    let mut here = chase.start::<f64>()?;
    let mut out = Vec::new();
    for t in times {
        here = chase.follow(here, Some(*t), &mut |_| {})?.0;
        out.push(here);
    }
    Ok(out)
}

fn undecided() -> Diagnostic {
    Diagnostic::error("undecided", both!("its digits cannot be told apart from zero"))
}

fn scalar<N: Certain>(x: N) -> ParticleValue {
    x.enclosure().map_or_else(|| ParticleValue::None(undecided()), ParticleValue::Scalar)
}

fn vector<N: Certain>(all: &[N]) -> ParticleValue {
    let zero = N::from_f64(0.0);
    let size = all.iter().fold(zero, |s, x| s + *x * *x);
    // The root of a value that is zero to rounding would lose half of the digits.
    let size =
        if all.iter().all(|x| x.approx() == 0.0 && x.radius() == 0.0) { zero } else { size.sqrt() };
    let parts: Option<Vec<Enclosure>> = all.iter().map(|x| x.enclosure()).collect();
    match (parts, size.enclosure()) {
        (Some(parts), Some(size)) => ParticleValue::Vector(parts, size),
        _ => ParticleValue::None(undecided()),
    }
}

/// Returns the answer from time and place of a meeting.
fn meeting(
    problem: &ParticleProblem,
    k: usize,
    ends: &[(usize, PursuitEnd)],
    tell: impl Fn(Ball<Dd>, [Ball<Dd>; 2]) -> ParticleValue,
) -> ParticleValue {
    let m = &problem.motions[k];
    let target = problem.chase(m).map_or("", |c| c.1);
    match ends.iter().find(|e| e.0 == k).map(|e| e.1) {
        Some(PursuitEnd::Meet { time, place }) => tell(time, place),
        Some(PursuitEnd::Apart { until, distance }) => ParticleValue::None(Diagnostic::error(
            "never-meets",
            both!(
                "{} does not catch {target}: at {until:.4e} s they are {distance:.4e} m apart",
                m.point
            ),
        )),
        None => ParticleValue::None(undecided()),
    }
}

fn cross<N: Real>(a: [N; 2], b: [N; 2]) -> N {
    a[0] * b[1] - a[1] * b[0]
}

/// The state of a pursuer at the instant.
struct Pursuer<N> {
    /// The length of the line to the target, and its angular velocity.
    line: [N; 2],
    /// Place, velocity and acceleration.
    state: [[N; 2]; 3],
    speed: N,
}

/// Returns the quantities that follow from the vector from pursuer to target at the instant: v
/// along it, its ω, and a = v′ along it and vω square to it.
fn pursuer(
    problem: &ParticleProblem,
    k: usize,
    chases: &[(usize, PursuitVector)],
) -> Result<Option<Pursuer<Ball<Dd>>>, Diagnostic> {
    type N = Ball<Dd>;
    let m = &problem.motions[k];
    let (Some((chase, _)), Some((_, d))) = (problem.chase(m), chases.iter().find(|c| c.0 == k))
    else {
        return Ok(None);
    };
    let t = problem.time.at(N::from_f64(0.0))?.number.0[0];
    // If the laws have no values in the longer numbers, f64 with its error bound is used.
    let short = |x: Ball<f64>| Ball::new(Dd::from_f64(x.middle()), x.radius());
    let [x, y] = chase.target.at(t)?;
    let [x, y] = if x.is_decided() && y.is_decided() {
        [x.0, y.0]
    } else {
        chase
            .target
            .at(problem.time.at(Ball::<f64>::from_f64(0.0))?.number.0[0])?
            .map(|j| j.0.map(short))
    };
    let speed = super::law::jet(chase.speed, t)?.0;
    let l = d[0].hypot(d[1]);
    let e = [d[0] / l, d[1] / l];
    let square = [-e[1], e[0]];
    let omega = cross(e, [x[1], y[1]]) / l;
    let across = speed[0] * omega;
    let place = [x[0] - d[0], y[0] - d[1]];
    let (v, a) = (e.map(|c| c * speed[0]), [0, 1].map(|c| e[c] * speed[1] + square[c] * across));
    Ok(Some(Pursuer { line: [l, omega], state: [place, v, a], speed: speed[0] }))
}

fn of_chase(
    problem: &ParticleProblem,
    k: usize,
    chases: &[(usize, PursuitVector)],
    what: ParticleQuantity,
) -> Result<ParticleValue, Diagnostic> {
    let Some(Pursuer { line: [l, omega], state: [place, v, a], speed }) =
        pursuer(problem, k, chases)?
    else {
        return Ok(ParticleValue::None(undecided()));
    };
    Ok(match what {
        ParticleQuantity::Distance(_) => scalar(l),
        ParticleQuantity::LineOmega(_) => scalar(omega),
        ParticleQuantity::Place(_) => vector(&place),
        ParticleQuantity::Velocity(_) => vector(&v),
        ParticleQuantity::Acceleration(_) => vector(&a),
        ParticleQuantity::Curvature(_) if omega.contains_zero() => {
            ParticleValue::None(straight(&problem.motions[k].point))
        }
        ParticleQuantity::Curvature(_) => {
            scalar(if omega.approx() < 0.0 { -(speed / omega) } else { speed / omega })
        }
        ParticleQuantity::MeetingTime(_)
        | ParticleQuantity::MeetingPlace(_)
        | ParticleQuantity::Part(..)
        | ParticleQuantity::Between(..) => ParticleValue::None(undecided()),
    })
}

/// Returns a quantity of two points: from their laws in long numbers, or with a pursuer in the
/// numbers of its course.
fn between(
    problem: &ParticleProblem,
    two: [usize; 2],
    m: Mutual,
    chases: &[(usize, PursuitVector)],
) -> Result<ParticleValue, Diagnostic> {
    let pursues = |k: usize| matches!(problem.motions[k].kind, ParticleMotionKind::Toward { .. });
    if two.into_iter().any(pursues) {
        let mut states = Vec::new();
        for k in two {
            let found = if pursues(k) {
                pursuer(problem, k, chases)?.map(|p| p.state)
            } else {
                by_way::<Ball<Dd>>(problem, k)?
            };
            states.extend(found);
        }
        return Ok(<[_; 2]>::try_from(states)
            .map_or_else(|_| ParticleValue::None(undecided()), |[a, b]| mutual(a, b, m)));
    }
    let fine = within(BITS, || mutual_by_laws::<Ball<Big>>(problem, two, m))?;
    match fine {
        ParticleValue::None(d) if d.code == "undecided" => {
            mutual_by_laws::<Ball<f64>>(problem, two, m)
        }
        other => Ok(other),
    }
}

fn mutual_by_laws<N: Certain>(
    problem: &ParticleProblem,
    [a, b]: [usize; 2],
    m: Mutual,
) -> Result<ParticleValue, Diagnostic> {
    let (Some(a), Some(b)) = (by_way::<N>(problem, a)?, by_way::<N>(problem, b)?) else {
        return Ok(ParticleValue::None(undecided()));
    };
    Ok(mutual(a, b, m))
}

/// Returns place, velocity and acceleration of a point that moves in the plane by a law.
fn by_way<N: Real>(problem: &ParticleProblem, k: usize) -> Result<Option<[[N; 2]; 3]>, Diagnostic> {
    let ParticleMotionKind::Fixed(way) = &problem.motions[k].kind else { return Ok(None) };
    let [x, y] = way.at(problem.time.at(N::from_f64(0.0))?.number.0[0])?;
    Ok(Some([0, 1, 2].map(|order| [x.0[order], y.0[order]])))
}

fn mutual<N: Certain>(a: [[N; 2]; 3], b: [[N; 2]; 3], m: Mutual) -> ParticleValue {
    let off = |order: usize| [0, 1].map(|c| a[order][c] - b[order][c]);
    let d = off(0);
    let square = d[0] * d[0] + d[1] * d[1];
    match m {
        Mutual::Distance | Mutual::Turning if square.approx() == 0.0 => ParticleValue::None(
            Diagnostic::error("straight", both!("the two points are in one place")),
        ),
        Mutual::Distance => scalar(square.sqrt()),
        Mutual::Turning => scalar(cross(d, off(1)) / square),
        Mutual::Velocity => vector(&off(1)),
        Mutual::Acceleration => vector(&off(2)),
    }
}

fn straight(point: &str) -> Diagnostic {
    Diagnostic::error("straight", both!("the path of {point} does not bend at the instant"))
}

/// Returns an answer from laws alone: in `f64` with its error bound, or in longer numbers if that
/// leaves too few digits.
fn by_law(
    problem: &ParticleProblem,
    k: usize,
    what: ParticleQuantity,
) -> Result<ParticleValue, Diagnostic> {
    let fine = within(BITS, || in_numbers::<Ball<Big>>(problem, k, what))?;
    match fine {
        ParticleValue::None(d) if d.code == "undecided" => {
            in_numbers::<Ball<f64>>(problem, k, what)
        }
        other @ (ParticleValue::Vector(..) | ParticleValue::Scalar(_) | ParticleValue::None(_)) => {
            Ok(other)
        }
    }
}

fn in_numbers<N: Certain>(
    problem: &ParticleProblem,
    k: usize,
    what: ParticleQuantity,
) -> Result<ParticleValue, Diagnostic> {
    let t = problem.time.at(N::from_f64(0.0))?.number.0[0];
    let m = &problem.motions[k];
    let [place, v, a] = match &m.kind {
        ParticleMotionKind::Fixed(way) => {
            let [x, y] = way.at(t)?;
            [0, 1, 2].map(|order| vec![x.0[order], y.0[order]])
        }
        ParticleMotionKind::OnPlate(..) => {
            let Some(state) = PlateState::of(problem, m, t)? else {
                return Ok(ParticleValue::None(undecided()));
            };
            if let ParticleQuantity::Part(_, part) = what {
                return Ok(vector(&state.part(part)));
            }
            state.absolute().map(|v| v.to_vec())
        }
        ParticleMotionKind::Toward { .. } => return Ok(ParticleValue::None(undecided())),
    };
    Ok(match what {
        ParticleQuantity::Place(_) => vector(&place),
        ParticleQuantity::Velocity(_) => vector(&v),
        ParticleQuantity::Acceleration(_) => vector(&a),
        ParticleQuantity::Curvature(_) => curvature(&m.point, &v, &a),
        ParticleQuantity::MeetingTime(_)
        | ParticleQuantity::MeetingPlace(_)
        | ParticleQuantity::Distance(_)
        | ParticleQuantity::LineOmega(_)
        | ParticleQuantity::Part(..)
        | ParticleQuantity::Between(..) => ParticleValue::None(undecided()),
    })
}

/// Returns the radius of curvature |v|³ / |v × a|.
fn curvature<N: Certain>(point: &str, v: &[N], a: &[N]) -> ParticleValue {
    let zero = N::from_f64(0.0);
    let at = |v: &[N], k: usize| v.get(k).copied().unwrap_or(zero);
    let turned = |i: usize, j: usize| at(v, i) * at(a, j) - at(v, j) * at(a, i);
    let c = [turned(1, 2), turned(2, 0), turned(0, 1)];
    let bend = c.iter().fold(zero, |s, x| s + *x * *x);
    let v2 = v.iter().fold(zero, |s, x| s + *x * *x);
    if bend.approx() <= 2.0 * bend.radius()
        || bend.approx()
            <= 1e-60 * v2.approx() * a.iter().fold(0.0, |s, x| s + x.approx() * x.approx())
    {
        return ParticleValue::None(straight(point));
    }
    scalar(v2 * v2.sqrt() / bend.sqrt())
}
