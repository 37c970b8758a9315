//! A pursuit on the board: its integrated course, and velocities and acceleration at the instant.

use super::super::ask::ParticleQuantity;
use super::super::law::jet;
use super::super::pursuit::{Chase, PursuitEnd};
use super::super::solve::course;
use super::super::{ParticleMotion, ParticleProblem};
use super::{InstantLaws, MotionDrawing, ROOM_MM, Views, arrow, mm, most};
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_board::construct::scale::{choose_in, fitted};
use hodograph_scene as scene;

/// The space for the course (mm).
const COURSE_MM: [f64; 2] = [120.0, 75.0];
/// The number of lines of sight.
pub const SIGHTS: usize = 8;
/// The number of places between two lines of sight.
pub const FINE: usize = 12;
/// The drawn fraction of the time to the meeting: at the meeting itself the two points coincide.
const NEARLY: f64 = 1.0 - 1e-6;
/// The relative rounding error of a few operations: thirty-two units in the last place.
const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// The relative accuracy on which drawing and analysis agree: a reading with a larger error is
/// discarded.
const PROMISED: f64 = 1e-9;

/// A pursuit from its start to its end.
struct PursuitPaths {
    /// Pursuer and target at equal times (m).
    places: Vec<[Point; 2]>,
    until: f64,
    meets: bool,
}

impl PursuitPaths {
    fn of(chase: &Chase, now: f64) -> Result<PursuitPaths, Diagnostic> {
        let (until, meets) = match chase.end::<f64>() {
            Ok(PursuitEnd::Meet { time, .. }) => (time.approx(), true),
            // For a pursuit without an end, a sufficient time to show the course.
            Ok(PursuitEnd::Apart { .. }) | Err(_) => {
                let speed = jet(chase.speed, 0.0)?.0[0];
                ((2.0 * now).max(8.0 * chase.start::<f64>()?.distance() / speed), false)
            }
        };
        let (count, reach) = (SIGHTS * FINE, if meets { until * NEARLY } else { until });
        let times: Vec<f64> = (0..=count).map(|k| reach * k as f64 / count as f64).collect();
        let mut places: Vec<[Point; 2]> = Vec::new();
        for s in &course(chase, &times)? {
            let [x, y] = chase.target.at(s.t)?;
            let b = Point::new(x.0[0], y.0[0]);
            places.push([b - Vec2::new(s.d[0], s.d[1]), b]);
        }
        Ok(PursuitPaths { places, until, meets })
    }

    /// Returns the course of a drawing at another instant.
    fn again(drawn: &MotionDrawing) -> Option<PursuitPaths> {
        let Views::Chase { course, until, meets, .. } = &drawn.views else { return None };
        let places = course
            .iter()
            .map(|pair| pair.map(|p| (p.to_vec2() * drawn.mu[0]).to_point()))
            .collect();
        Some(PursuitPaths { places, until: *until, meets: *meets })
    }

    /// Returns the scale (m per mm) at which the course and the two points at the instant fit, a
    /// round number in a unit (m).
    fn scale(&self, now: [Point; 2], unit: f64) -> f64 {
        let all = || self.places.iter().flatten().copied().chain(now);
        let most = |f: fn(Point) -> f64| {
            all().map(f).fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(x), h.max(x)])
        };
        let ([x0, x1], [y0, y1]) = (most(|p| p.x), most(|p| p.y));
        choose_in(unit, [x1 - x0, y1 - y0], COURSE_MM)
    }
}

pub(super) fn draw(
    problem: &ParticleProblem,
    k: usize,
    m: &ParticleMotion,
    known: Option<&MotionDrawing>,
) -> Result<Option<MotionDrawing>, Diagnostic> {
    let Some((chase, target)) = problem.chase(m) else { return Ok(None) };
    let t = problem.instant();
    let Some(here) = course(&chase, &[t])?.pop() else { return Ok(None) };
    let laws = InstantLaws { time: &problem.time };
    let [x, y] = laws.way(chase.target)?;
    let speed = laws.law(chase.speed)?;
    let (b, v_b) = (Point::new(x[0], y[0]), Vec2::new(x[1], y[1]));
    let a = b - Vec2::new(here.d[0], here.d[1]);
    let run =
        known.and_then(PursuitPaths::again).map_or_else(|| PursuitPaths::of(&chase, t), Ok)?;
    let mu_l = problem.paper.scale(scene::Kind::Length, |unit| run.scale([a, b], unit));
    let (on_paper_a, on_paper_b) =
        ((a.to_vec2() * (1.0 / mu_l)).to_point(), (b.to_vec2() * (1.0 / mu_l)).to_point());
    let Some(along) = (on_paper_b - on_paper_a).unit() else { return Ok(None) };
    let mu_v =
        fitted(&problem.paper, scene::Kind::Velocity, most(&[v_b, along * speed[0]]), ROOM_MM);
    let (tip_a, tip_b) = (along * (speed[0] / mu_v), v_b * (1.0 / mu_v));
    // The perpendicular from b to the line of v_A.
    let foot = along * along.dot(tip_b);
    let across = tip_b - foot;
    let (arm, rate) = (on_paper_a.distance(on_paper_b), across.norm());
    // The direction of the line is as accurate as the rounding of the places.
    let blurred = (on_paper_a.to_vec2().norm() + on_paper_b.to_vec2().norm()) / arm;
    let lost = ROUNDING * tip_b.norm() * (1.0 + blurred);
    let seen = lost <= PROMISED * rate;
    let omega = rate * mu_v / (arm * mu_l) * if along.cross(tip_b) < 0.0 { -1.0 } else { 1.0 };
    let (a_t, a_n) = (speed[1], tip_a.norm() * mu_v * omega);
    let whole = along * a_t + along.perp() * a_n;
    let mu_a =
        fitted(&problem.paper, scene::Kind::Acceleration, most(&[whole, along * a_t]), ROOM_MM);
    let (tip_t, tip_n) = (along * (a_t / mu_a), along.perp() * (a_n / mu_a));
    let velocities = vec![
        arrow(&format!("v_{}", m.point), Point::ORIGIN, tip_a, true, 1),
        arrow(&format!("v_{target}"), Point::ORIGIN, tip_b, true, 1),
    ];
    let mut accelerations =
        vec![arrow(&format!("a_{}", m.point), Point::ORIGIN, tip_t + tip_n, true, 3)];
    if a_t != 0.0 {
        accelerations.push(arrow("a^t", Point::ORIGIN, tip_t, false, 3));
        accelerations.push(arrow("a^n", tip_t.to_point(), tip_n, false, 3));
    }
    let closing = (tip_a - foot).dot(along) * mu_v;
    let steps = vec![
        both!(
            "The course of {} is integrated; at the instant the line {}{target} measures {} mm",
            m.point,
            m.point,
            mm(arm)
        ),
        both!(
            "Lay off $v_{{{}}}$ along {}{target} from the pole, and $v_{{{target}}}$",
            m.point,
            m.point
        ),
        if seen {
            both!(
                "The perpendicular from the tip of $v_{{{target}}}$ on $v_{{{}}}$ measures {} mm: $\\omega_{{{}{target}}}$ = {} mm · $\\mu_v$ / ({} mm · $\\mu_l$) = {} rad/s; {}",
                m.point,
                mm(rate),
                m.point,
                mm(rate),
                mm(arm),
                mm(omega),
                if closing < 0.0 {
                    both!("the distance grows at {} m/s", mm(-closing))
                } else {
                    both!("the distance shrinks at {} m/s", mm(closing))
                }
            )
        } else {
            both!(
                "The tip of $v_{{{target}}}$ lies on the line of $v_{{{}}}$ as far as the paper tells: $\\omega_{{{}{target}}}$ is not read but calculated",
                m.point,
                m.point
            )
        },
        if a_t == 0.0 {
            both!(
                "Draw $a_{{{}}} = v\\omega$ perpendicular to the line, for $v$ is constant: it measures {} mm",
                m.point,
                mm((tip_t + tip_n).norm())
            )
        } else {
            both!(
                "Draw $a_{{{}}}$, of $v'$ along the line and $v\\omega$ square to it: it measures {} mm",
                m.point,
                mm((tip_t + tip_n).norm())
            )
        },
    ];
    let (v, acc) = (tip_a * mu_v, (tip_t + tip_n) * mu_a);
    let mut readings = vec![
        (ParticleQuantity::Distance(k), vec![arm * mu_l]),
        (ParticleQuantity::Velocity(k), vec![v.x, v.y]),
    ];
    if seen {
        readings.push((ParticleQuantity::LineOmega(k), vec![omega]));
        readings.push((ParticleQuantity::Curvature(k), vec![(tip_a.norm() * mu_v / omega).abs()]));
    }
    // For an acceleration along the line, an invisible rotation of the line does not change the
    // reading.
    let lost = tip_a.norm() * mu_v * (lost * mu_v / (arm * mu_l));
    if lost <= PROMISED * whole.norm() {
        readings.push((ParticleQuantity::Acceleration(k), vec![acc.x, acc.y]));
    }
    let unread = (!seen).then(|| nearly_straight(&m.point, target));
    let views = Views::Chase {
        course: run
            .places
            .iter()
            .map(|pair| pair.map(|p| (p.to_vec2() * (1.0 / mu_l)).to_point()))
            .collect(),
        until: run.until,
        meets: run.meets,
        places: [on_paper_a, on_paper_b],
        velocities,
        foot: foot.to_point(),
        accelerations,
    };
    let steps = steps.into_iter().map(Both::sentence).collect();
    Ok(Some(MotionDrawing {
        motion: k,
        mu: [mu_l, mu_v, mu_a],
        steps,
        readings,
        calculated: false,
        unread,
        views,
    }))
}

/// Returns the note for a target that moves along the line of sight, or deviates from it by less
/// than the paper shows.
fn nearly_straight(point: &str, target: &str) -> Diagnostic {
    let message = both!(
        "`{target}` moves along the line {point}{target}, or nearly so: the drawing does not show how that line turns; ω and what rests on it are those of the analysis alone"
    );
    let help = both!("choose an earlier instant to see them drawn");
    Diagnostic::note("nearly-straight", message).help(help)
}
