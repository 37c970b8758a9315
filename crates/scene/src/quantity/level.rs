//! How deep a question asks, and what it asks for: places, velocities, accelerations of points and links.

use crate::kind::Kind;
use crate::model::{LinkId, PointId};

/// How deep a thing is asked for. Each level needs the ones before it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Level {
    /// Where it is.
    #[default]
    Position,
    /// How fast.
    Velocity,
    /// With which acceleration.
    Acceleration,
}

impl Level {
    /// All of them, each after those that it needs.
    pub const ALL: [Level; 3] = [Level::Position, Level::Velocity, Level::Acceleration];

    /// Those that have equations and a polygon.
    pub const RATES: [Level; 2] = [Level::Velocity, Level::Acceleration];

    /// What its vectors are: lengths on the diagram, velocities, accelerations.
    pub fn kind(self) -> Kind {
        match self {
            Level::Position => Kind::Length,
            Level::Velocity => Kind::Velocity,
            Level::Acceleration => Kind::Acceleration,
        }
    }

    /// What the turning of a link is.
    pub fn turning(self) -> Kind {
        match self {
            Level::Position => Kind::Angle,
            Level::Velocity => Kind::Omega,
            Level::Acceleration => Kind::Alpha,
        }
    }
}

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
}
