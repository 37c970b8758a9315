//! A centre from the normals to two velocities: the graphical method for a stalled closure.

use super::{Centre, CentreMethod, CentrePlace, Centres};
use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::answer::MotionSource;
use hodograph_mechanism::mechanism::Level;
use hodograph_scene::PointId;

/// The smallest sine of the angle between two velocities whose normals are crossed.
const SQUARE: f64 = 0.02;

/// A point of the first link of a pair, its place (m), and its velocity relative to the second
/// (m/s).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VelocityNormal {
    /// The point.
    pub point: PointId,
    /// The place of the point (m).
    pub at: Point,
    /// The point's velocity relative to the other link (m/s); the centre lies on the line square to
    /// it.
    pub velocity: Vec2,
}

impl Centres {
    /// Returns the two points of one link whose velocities are nearest to square to one another,
    /// for a centre that the theorem does not find.
    pub fn normals(&self, c: &Centre) -> Option<[VelocityNormal; 2]> {
        if c.step.how != CentreMethod::Velocities || !matches!(c.place?, CentrePlace::At(_)) {
            return None;
        }
        let ground = self.scene.ground;
        let [moving, against] = if c.step.pair.i == ground {
            [c.step.pair.j, ground]
        } else {
            [c.step.pair.i, c.step.pair.j]
        };
        let place = |p: PointId| self.worked.configuration.points[p.0];
        let velocity = |p: PointId, l| self.worked.solution.vector(Level::Velocity, p, Some(l));
        let other = self.scene.links[against.0]
            .points
            .iter()
            .find_map(|p| Some((place(*p)?, velocity(*p, against)?)));
        let turning = self.worked.solution.turning(Level::Velocity, against).unwrap_or(0.0);
        let carried = |at: Point| match other {
            _ if against == ground => Some(Vec2::ZERO),
            Some((base, v)) => Some(v + (at - base).perp() * turning),
            None => None,
        };
        let of = |p: &PointId| {
            let at = place(*p)?;
            let velocity = velocity(*p, moving)? - carried(at)?;
            velocity.unit().map(|_| VelocityNormal { point: *p, at, velocity })
        };
        let all: Vec<VelocityNormal> =
            self.scene.links[moving.0].points.iter().filter_map(of).collect();
        let mut best: Option<(f64, [VelocityNormal; 2])> = None;
        for (k, a) in all.iter().enumerate() {
            for b in &all[..k] {
                let square =
                    a.velocity.cross(b.velocity).abs() / (a.velocity.norm() * b.velocity.norm());
                if square > best.map_or(SQUARE, |(most, _)| most) {
                    best = Some((square, [*b, *a]));
                }
            }
        }
        best.map(|(_, pair)| pair)
    }
}
