//! Centres by the theorem against centres by velocities, on random mechanisms.

use crate::emit::{Ask, Pose};
use crate::properties::{mechanism, seeds, solve, style};
use crate::wide::every;
use hodograph::answer::{AnswerValue, MotionSource};
use hodograph::centres::{
    Centre, CentreMethod, CentrePlace, Centres, Origin, centres, omega, velocity,
};
use hodograph::geom::{Point, Vec2};
use hodograph::mechanism::Level;
use hodograph::scene::{LinkId, PointId};

/// Velocity of a link's point at the first placed point, and ω: from the loop equations.
fn motion(found: &Centres, l: LinkId) -> Option<(Point, Vec2, f64)> {
    let (p, at) = found
        .worked
        .configuration
        .points
        .iter()
        .enumerate()
        .find_map(|(p, at)| Some((PointId(p), (*at)?)))?;
    let v = found.worked.solution.vector(Level::Velocity, p, Some(l))?;
    Some((at, v, found.worked.solution.turning(Level::Velocity, l)?))
}

/// The largest of ω and v/size.
fn largest(found: &Centres) -> f64 {
    let size = found.worked.configuration.extent();
    let links = (0..found.scene.links.len()).filter_map(|l| motion(found, LinkId(l)));
    links.map(|(_, v, omega)| omega.abs().max(v.norm() / size)).fold(0.0, f64::max)
}

/// Distance of a centre from P = Q + i (v_i − v_j)/(ω_i − ω_j), relative to the size of the
/// mechanism and the distance; `None` where the links have almost no relative motion.
fn off(found: &Centres, c: &Centre, place: Point) -> Option<f64> {
    let ((q, v, a), (_, w, b)) = (motion(found, c.step.pair.i)?, motion(found, c.step.pair.j)?);
    let size = found.worked.configuration.extent();
    let omega = a - b;
    let scale = largest(found);
    let by_velocities = q + (v - w).perp() * (1.0 / omega);
    let far = by_velocities.distance(q) + size;
    // The rounding error of the difference, with a reserve for links that turn slowly compared with
    // others.
    (omega.abs() > 1e-6 * scale && scale > 0.0 && far < 1e4 * size)
        .then(|| by_velocities.distance(place) / far)
}

/// True if two links have no relative motion.
fn rests(found: &Centres, c: &Centre) -> bool {
    let (Some((_, v, a)), Some((_, w, b))) =
        (motion(found, c.step.pair.i), motion(found, c.step.pair.j))
    else {
        return false;
    };
    (v - w).norm() / found.worked.configuration.extent() + (a - b).abs() < 1e-9 * largest(found)
}

#[test]
fn centres_by_lines_are_those_by_velocities() {
    let (mut by_lines, mut compared, mut worst, mut speeds, mut loose, mut stalled) =
        (0, 0, 0.0f64, 0, 0, 0);
    for seed in seeds(250) {
        let Some(m) = mechanism(seed) else { continue };
        if m.links.len() > 24 {
            continue;
        }
        let case = solve(
            seed,
            &m,
            &style(
                if m.coordinates_only { Pose::Coordinates } else { Pose::Mixed },
                Ask::Velocities,
                seed,
            ),
        );
        let found = centres(&case.scene)
            .unwrap_or_else(|f| panic!("seed {seed}: {f}\n{}", case.text))
            .value;
        let fail = |what: String| -> ! { panic!("seed {seed}: {what}\n{}", case.text) };
        assert_eq!(found.list.len(), hodograph::centres::count(case.scene.links.len()));
        // Links attached to one link form a rigid triangle with it: the centre of two of them is
        // not unique.
        let rigid = found.list.iter().any(|c| rests(&found, c));
        loose += usize::from(!rigid);
        for c in &found.list {
            let name = c.step.pair.name(&case.scene);
            // The two lines of a round are distinct in a general pose: lines that coincide by
            // topology are not counted twice.
            if !rigid
                && (c.why.is_some() && c.step.how != CentreMethod::Velocities
                    || c.round > c.step.round)
            {
                fail(format!("{name}: {:?} of {:?}", c.why, c.step.how));
            }
            let Some(place) = c.place else {
                if !rigid {
                    fail(format!("{name} has no place: {c:?}"));
                }
                continue;
            };
            by_lines += usize::from(matches!(c.origin, Some(Origin::Crossing(_))));
            let residual = c.residual.unwrap_or_else(|| fail(format!("{name} has no motion")));
            if residual > 1e-9 {
                fail(format!("{name}: at {place:?} the links differ by {residual:e}"));
            }
            let CentrePlace::At(at) = place else { continue };
            if let Some(off) = off(&found, c, at) {
                compared += 1;
                worst = worst.max(off);
                if off > 1e-6 {
                    fail(format!(
                        "{name} by {:?} of {:?} is {off:e} off that by velocities",
                        c.origin, c.step.how
                    ));
                }
            }
        }
        if found.worst_triple > 1e-8 {
            fail(format!("a triple spans {:e}", found.worst_triple));
        }
        // As in the single flier: a link held by three others that all move.
        stalled += usize::from(!rigid && found.closure.stalled());
        // Angular velocities and speeds by centres agree with the loop equations.
        let size = found.worked.configuration.extent();
        for t in &found.uses.links {
            let Some(AnswerValue::Scalar(omega)) = found.other_ways(&omega(t.link, None))[1] else {
                continue;
            };
            speeds += 1;
            if (omega - t.omega).abs() > 1e-6 * largest(&found) {
                fail(format!(
                    "ω of {} by centres {}, else {omega}",
                    case.scene.link_name(t.link),
                    t.omega
                ));
            }
        }
        for s in &found.uses.points {
            let Some(AnswerValue::Vector(v)) = found.other_ways(&velocity(s.point))[1] else {
                continue;
            };
            speeds += 1;
            if (v - s.velocity).norm() > 1e-6 * largest(&found) * size {
                fail(format!(
                    "v of {} by centres {:?}, else {v:?}",
                    case.scene.point_name(s.point),
                    s.velocity
                ));
            }
        }
    }
    println!(
        "{by_lines} centres by lines, {compared} compared with those by velocities: worst {worst:.1e}; {speeds} rates and speeds; {loose} mechanisms without rigid triangles, {stalled} of them stall"
    );
    assert!(
        by_lines > 5000 / every(8) && compared > 4000 / every(8) && speeds > 2000 / every(8),
        "{by_lines} {compared} {speeds}"
    );
    assert!(loose > 60 / every(8), "{loose}");
}
