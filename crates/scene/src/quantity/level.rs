//! How deep a question asks, and what it asks for: places, velocities, accelerations of points and links.

use crate::model::{LinkId, PointId};

/// A derivative by time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rate {
    /// The first.
    Velocity,
    /// The second.
    Acceleration,
}

impl Rate {
    /// Both, in order.
    pub const ALL: [Rate; 2] = [Rate::Velocity, Rate::Acceleration];
}

/// A thing asked for: the motion of a point (of a certain link) or the turning of a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Need {
    /// The vector of a point; with a link, of the point of that link that lies there.
    Point(PointId, Option<LinkId>),
    /// The turning of a link.
    Turning(LinkId),
    /// The forces of the scene: the places of what is loaded, and the motion of what has mass.
    Forces,
}
