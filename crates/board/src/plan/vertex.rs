//! Points whose vectors are drawn: joints, points of links that coincide with them, special points, and their doubles in trial polygons.

use super::VertexId;
use hodograph_mechanism::mechanism::ConstraintLine;
use hodograph_scene::{LinkId, PointId, Scene};

/// The place of a vertex on the mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Spot {
    /// A point of the scene.
    Point(PointId),
    /// A special (Assur) point: an index into [`super::Plan::specials`].
    Special(usize),
}

/// A special (Assur) point of a link: where two lines cross along which it is held. As far as velocities go the link is pinned there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Special {
    /// The group.
    pub group: usize,
    /// The link.
    pub link: LinkId,
    /// The other link, for a point with one velocity on two links.
    pub with: Option<LinkId>,
    /// The two lines.
    pub lines: [SpecialLine; 2],
    /// The two legs of a triad, by their order in the core: it has another special point for each pair of them.
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

/// A point of a certain link whose vector is drawn from the pole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Vertex {
    /// Its place.
    pub spot: Spot,
    /// The link it belongs to where that is not the pin itself: the coincident point of a link that carries a guide.
    pub on: Option<LinkId>,
    /// The number that tells coincident points apart in figures, if any does.
    pub number: Option<LinkId>,
    /// Fixed points have their image in the pole.
    pub fixed: bool,
    /// The trial that it belongs to; `None` for a vertex of the polygon that is sought.
    pub trial: Option<Trial>,
}

/// A trial polygon: one unknown rate has a value that is chosen, and the last bar of the group is left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Trial {
    /// The first trial, with a rate of 0, or the second.
    pub run: u8,
    /// True for the point that the vertex would have to coincide with.
    pub mate: bool,
}

impl Vertex {
    /// Returns true for a vertex of the same point, of whatever trial.
    pub fn is_at(&self, other: &Vertex) -> bool {
        self.spot == other.spot && self.on == other.on
    }

    /// The link that a point belongs to: of a pin's links the first of the scene that moves.
    pub fn link(&self, scene: &Scene) -> Option<LinkId> {
        let pinned = || match self.spot {
            Spot::Point(p) => scene.mover(p),
            Spot::Special(_) => None,
        };
        self.on.or(self.number).or_else(pinned)
    }
}
