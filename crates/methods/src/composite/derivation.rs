//! Two instants of a composite motion, from which v_a = v_e + v_r and a_a = a_e + a_r + a_k follow.
//!
//! In the time Δt the moving point goes from M to M₁, and the point of the frame that was at M goes
//! to m₁: Δr_a = Δr_e + Δr_r, with Δr_r from m₁ to M₁. The velocities of both instants differ by four
//! parts: v_e1 − v_e and v_r′ − v_r1, whose limits over Δt are a_e and a_r, and v_e′ − v_e1 and
//! v_r1 − v_r, whose limits are ω × v_r each. Here v_e1 is the velocity of m₁, and v_r1 is v_r turned
//! with the frame.

use super::{ChoiceSolution, ChoiceVerdict, ContactScene, FrameChoice, level};
use hodograph_base::diag::{Faults, Warned};
use hodograph_base::geom::{Point, Vec2};
use hodograph_board::construct::scale;
use hodograph_mechanism::answer::MotionSource;
use hodograph_mechanism::mechanism::Level;
use hodograph_mechanism::position::Configuration;
use hodograph_scene::quantity::{Frame, PointMotion, Rate, Turning};
use hodograph_scene::{Asked, Find, OnLink, Scene, Swept};
use hodograph_sweep::follow::PoseFollower;
use hodograph_worked::worked::{Scope, Worked, work, work_motion, work_placed};

/// A composite motion at an instant and Δt later.
#[derive(Clone, Debug)]
pub struct TwoInstants {
    /// The choice with its motion at the instant.
    pub solution: ChoiceSolution,
    /// The scene that is solved.
    pub scene: Scene,
    /// Its solution at the instant.
    pub worked: Worked,
    /// The pose Δt later.
    pub later: Configuration,
    /// Δt (s).
    pub dt: f64,
    /// The places M, m₁ and M₁ (m).
    pub places: [Point; 3],
    /// The velocities Δt later (m/s).
    pub velocities: LaterVelocities,
}

/// The velocities at the later instant (m/s).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaterVelocities {
    /// v_a′.
    pub absolute: Vec2,
    /// v_e′, of the point of the frame at M₁.
    pub transport: Vec2,
    /// v_e1, of the point m₁.
    pub carried: Vec2,
    /// v_r′.
    pub relative: Vec2,
    /// v_r1: v_r of the first instant, turned with the frame.
    pub turned: Vec2,
}

/// The way of the fastest part in Δt, as a part of the mechanism's size, and the turn of the frame
/// (rad).
const WAY: f64 = 0.18;
const TURN: f64 = 0.3;

/// Returns the two instants of the first choice that is shown and has a permanent point; `None` if
/// there is none or nothing moves.
///
/// # Errors
/// The faults of the scene.
pub fn two_instants(scene: &Scene) -> Result<Option<TwoInstants>, Faults> {
    let staged = ContactScene::new(scene);
    let permanent = |c: &FrameChoice| {
        matches!(c.verdict, ChoiceVerdict::Serves | ChoiceVerdict::PathUnknown)
            && staged.contacts.iter().all(|k| k.point != c.of.point)
    };
    let Some(choice) = staged.shown(scene, usize::MAX).into_iter().find(permanent) else {
        return Ok(None);
    };
    let Warned { value: (_, solved), .. } = staged.solved(&[choice], level(scene))?;
    let Some(solution) = solved.into_iter().next() else { return Ok(None) };
    let seat = choice.frame.transport_point(choice.of);
    let mut asking = scene.clone();
    let ask = |what: Asked| Find { what, text: String::new(), span: Default::default() };
    let velocity = |of: OnLink| ask(PointMotion { rate: Rate::Velocity, of }.into());
    asking.find = vec![velocity(choice.of), velocity(seat)];
    if let Frame::Link(of) = choice.frame {
        asking.find.push(ask(Turning { rate: Rate::Velocity, of, against: None }.into()));
    }
    let worked = work(&asking, Scope::Figure)?.value;
    let (scene, worked) = work_motion(&asking)?.unwrap_or((asking, worked));
    Ok(later(scene, worked, solution, seat))
}

fn later(
    scene: Scene,
    worked: Worked,
    solution: ChoiceSolution,
    seat: OnLink,
) -> Option<TwoInstants> {
    let choice = solution.choice;
    let fastest = solution.velocity.iter().map(|v| v.norm()).fold(0.0, f64::max);
    let turning = |motion: &Worked| match choice.frame {
        Frame::Link(l) => motion.solution.turning(Level::Velocity, l),
        Frame::Point(_) => Some(0.0),
    };
    let omega = turning(&worked)?.abs();
    let way = WAY * worked.configuration.extent() / fastest;
    let longest = if omega > 0.0 { way.min(TURN / omega) } else { way };
    if !(longest.is_finite() && longest > 0.0) {
        return None;
    }
    let dt = scale::finer(1.0, longest, 1.0);
    let at = &worked.configuration;
    let follower = PoseFollower::new(&scene, &worked.mechanism, &worked.demand, at, Swept::Time);
    let later = follower.at(at, dt)?;
    let there = work_placed(
        &follower.scene_at(&scene, dt),
        worked.mechanism.clone(),
        worked.demand.clone(),
        later.clone(),
    )
    .ok()?
    .value;
    let velocity = |of: OnLink| there.solution.vector(Level::Velocity, of.point, of.link);
    let (absolute, transport) = (velocity(choice.of)?, velocity(seat)?);
    let (from, to) = (at.points[choice.of.point.0]?, later.points[choice.of.point.0]?);
    let relative = solution.velocity[2];
    // The frame carries the point at M, and turns v_r.
    let (carried, turned) = match choice.frame {
        Frame::Link(l) => {
            let [before, after] = [at.poses[l.0]?, later.poses[l.0]?];
            let moved = |p: Point| after.to_world(before.to_local(p));
            (moved(from), moved(from + relative) - moved(from))
        }
        Frame::Point(p) => (from + (later.points[p.point.0]? - at.points[p.point.0]?), relative),
    };
    let of_carried = transport + (carried - to).perp() * turning(&there)?;
    let velocities = LaterVelocities {
        absolute,
        transport,
        carried: of_carried,
        relative: absolute - transport,
        turned,
    };
    let places = [from, carried, to];
    Some(TwoInstants { solution, scene, worked, later, dt, places, velocities })
}

#[cfg(test)]
mod tests {
    use super::*;
    use hodograph_scene::quantity::composite::CompositePart;
    use hodograph_scene::{read, templates};

    /// In the limit the quotients are velocities and accelerations: at a small Δt they differ by a
    /// few parts in a hundred.
    #[test]
    fn quotients_tend_to_the_parts_of_the_motion() {
        for name in ["slotted-lever", "lathe", "ships", "disc-on-rod", "curved-slot"] {
            let scene = read(templates::get(name).unwrap()).unwrap().value;
            let two = two_instants(&scene).unwrap().unwrap();
            let [from, carried, to] = two.places;
            let [absolute, transport, relative] = two.solution.velocity;
            let largest = absolute.norm().max(transport.norm()).max(relative.norm());
            for (way, v) in
                [(to - from, absolute), (carried - from, transport), (to - carried, relative)]
            {
                let off = (way * (1.0 / two.dt) - v).norm() / largest;
                assert!(off < 0.35, "{name}: {off}");
            }
            // The four changes are that of v_a.
            let later = two.velocities;
            let changes = (later.carried - transport)
                + (later.transport - later.carried)
                + (later.turned - relative)
                + (later.relative - later.turned);
            assert!((changes - (later.absolute - absolute)).norm() < 1e-12 * largest, "{name}");
            let coriolis = two
                .solution
                .acceleration
                .iter()
                .find(|(part, _)| *part == Some(CompositePart::Coriolis));
            let Some((_, coriolis)) = coriolis else { continue };
            // Both halves are ω × v_r; v_r turns with the frame, whose arc is longer than its chord.
            let halves = [later.transport - later.carried, later.turned - relative]
                .map(|v| v * (1.0 / two.dt));
            let sum = halves[0] + halves[1];
            let off = (sum - *coriolis).norm() / coriolis.norm();
            assert!(off < 0.5, "{name}: {off}");
        }
    }
}
