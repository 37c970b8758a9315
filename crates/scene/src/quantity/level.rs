//! Levels of motion, and the motions that a question needs: places, velocities, accelerations of
//! points and links.

use crate::model::{LinkId, PointId};

/// A time derivative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rate {
    /// The first derivative.
    Velocity,
    /// The second derivative.
    Acceleration,
}

impl Rate {
    /// Both derivatives, in order.
    pub const ALL: [Rate; 2] = [Rate::Velocity, Rate::Acceleration];
}

/// A needed motion: that of a point (of a certain link), or the rotation of a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Need {
    /// The vector of a point; with a link, of the coincident point of that link.
    Point(PointId, Option<LinkId>),
    /// The rotation of a link.
    Turning(LinkId),
    /// The forces of the scene: the places of the loads, and the motion of the masses.
    Forces,
}
