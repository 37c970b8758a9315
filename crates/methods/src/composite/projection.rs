//! The projection by which the unwanted unknown is left out: the equations on a line square to the relative path.

use super::Solved;
use crate::geom::Vec2;
use crate::mechanism::Level;
use crate::scene::quantity::RelativePath;
use crate::scene::quantity::composite::Part;

/// A part below this share of the largest stands square to the line, and has no part on it.
const SQUARE: f64 = 1e-9;

/// An equation on a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Projection {
    /// Of velocities or accelerations.
    pub level: Level,
    /// The direction of the line (unit vector), square to v_r.
    pub line: Vec2,
    /// Whether the point is at rest in the frame at the instant.
    pub rests: bool,
    /// The vectors that have a part on it, each with its angle from the line (rad, from 0 to π): that of the point first.
    pub terms: Vec<(Option<Part>, f64)>,
}

/// The projections of a choice; none where the path in the frame is not known, or the point rests in the frame for good.
pub fn projections(s: &Solved) -> Vec<Projection> {
    let [absolute, transport, relative] = s.velocity;
    let along = match s.slip {
        Some(slip) => Some(slip.normal.perp()),
        // A point at rest on a straight path tells its direction by its acceleration.
        None => relative.unit().or_else(|| tangential(s)?.unit()).filter(|_| !matches!(s.choice.path, RelativePath::Unknown)),
    };
    let Some(along) = along else { return Vec::new() };
    // The sense in which the velocity of the point counts as positive.
    let line = along.perp();
    let line = if absolute.dot(line) < -SQUARE * absolute.norm() { -line } else { line };
    let velocities = [(None, absolute), (Some(Part::TransportVelocity), transport)];
    let mut out = Vec::new();
    for (level, vectors) in [(Level::Velocity, velocities.to_vec()), (Level::Acceleration, s.acceleration.clone())] {
        let largest = vectors.iter().map(|v| v.1.norm()).fold(0.0, f64::max);
        let on_line = |(part, v): &(Option<Part>, Vec2)| {
            let u = v.unit()?;
            let share = u.dot(line);
            let angle = Vec2::new(share, u.cross(line).abs()).angle();
            (share.abs() * v.norm() > SQUARE * largest).then_some((*part, angle))
        };
        let terms: Vec<_> = vectors.iter().filter_map(on_line).collect();
        if terms.len() > 1 {
            out.push(Projection { level, line, rests: relative.norm() <= SQUARE * absolute.norm(), terms });
        }
    }
    out
}

/// a_rᵗ.
fn tangential(s: &Solved) -> Option<Vec2> {
    s.acceleration.iter().find(|(part, _)| *part == Some(Part::RelativeTangential)).map(|(_, v)| *v)
}
