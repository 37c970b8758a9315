//! Points with vectors in the drawing: joints, points of links that coincide with them, special
//! points, and their doubles in trial polygons.

use super::VertexId;
use hodograph_mechanism::mechanism::ConstraintLine;
use hodograph_scene::{LinkId, PointId, Scene};

/// The place of a vertex on the mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum VertexPlace {
    /// A point of the scene.
    Point(PointId),
    /// A special (Assur) point: an index into [`super::Plan::specials`].
    Special(usize),
}

/// A special (Assur) point of a link: the crossing of two lines along which it is held. For
/// velocities, the link moves as if pinned there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Special {
    /// The group.
    pub group: usize,
    /// The link.
    pub link: LinkId,
    /// The other link, for a point with the same velocity on two links.
    pub with: Option<LinkId>,
    /// The two lines.
    pub lines: [SpecialLine; 2],
    /// The two legs of a triad, by their order in the core; each pair of legs has a special point.
    pub legs: Option<(usize, usize)>,
}

/// A line along which a link is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpecialLine {
    /// The constraint line of a leg.
    Leg(ConstraintLine),
    /// Through a pin and the special point of the link at the pin's other side.
    Through {
        /// The pin.
        pin: PointId,
        /// The special point.
        special: VertexId,
    },
}

/// A point of a certain link with a vector drawn from the pole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Vertex {
    /// The place.
    pub spot: VertexPlace,
    /// The link of a coincident point (of a link that carries a guide); `None` for the pin itself.
    pub on: Option<LinkId>,
    /// The number that distinguishes coincident points in figures, if there is one.
    pub number: Option<LinkId>,
    /// True for a fixed point, with its image at the pole.
    pub fixed: bool,
    /// The trial to which it belongs; `None` for a vertex of the final polygon.
    pub trial: Option<VertexTrial>,
}

/// A trial polygon: one unknown rate has an assumed value, and one bar of the group is removed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct VertexTrial {
    /// The first trial, with a rate of 0, or the second.
    pub run: u8,
    /// True for the mate: the point with which the vertex must coincide.
    pub mate: bool,
}

impl Vertex {
    /// Returns true for a vertex of the same point, in any trial.
    pub fn is_at(&self, other: &Vertex) -> bool {
        self.spot == other.spot && self.on == other.on
    }

    /// Returns the link of a point: for a pin, the first moving link of the scene that carries it.
    pub fn link(&self, scene: &Scene) -> Option<LinkId> {
        let pinned = || match self.spot {
            VertexPlace::Point(p) => scene.mover(p),
            VertexPlace::Special(_) => None,
        };
        self.on.or(self.number).or_else(pinned)
    }
}
