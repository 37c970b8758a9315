//! Disc cams of a scene, and the pairs that stand for their contact 高副低代.
//!
//! A cam is replaced before the scene is resolved, so that everything after sees lower pairs only:
//! - a circle against a round end: the follower's point runs in a slot of the cam about the circle's centre; a line: in a straight slot;
//! - a circle against a flat face: its centre runs in a straight guide of the follower;
//! - a law: the follower is a driver of its own, whose place, rate and acceleration are s, s′ω, s″ω² + s′α.
//!
//! Right for velocity and acceleration at the instant, exact along circles and lines. Of a profile of several pieces the one that is touched in
//! the pose is taken; at a joint of two, that which follows in the driver's sense.
//!
//! [`decode`] reads the section, [`place`] finds where cam and follower are, [`expand`] writes the pairs in the words of the scene, so that
//! longer numbers read the same texts; [`motion`] carries them on beyond the instant.

mod by_law;
mod by_parts;
mod by_pose;
pub(super) mod decode;
pub(super) mod expand;
mod law;
mod motion;
mod pairs;
mod place;
pub(super) mod raw;

use super::model::{GuideId, LinkId, PointId};
use crate::cam::{Disc, Segment, Side};
use crate::diag::Span;

/// With what a follower touches its cam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Follows {
    /// A knife edge 尖顶: a point of the follower.
    Edge(PointId),
    /// A roller 滚子 about a point of the follower, with its radius (m).
    Roller(PointId, f64),
    /// A round end (mushroom) 曲面: the centre of its arc, a point of the follower, and its radius (m).
    Arc(PointId, f64),
    /// A flat face 平底 through a point of the follower, or parallel to the line through it.
    Face(PointId),
}

impl Follows {
    /// The point of the follower that is named.
    pub fn point(&self) -> PointId {
        match *self {
            Follows::Edge(p) | Follows::Roller(p, _) | Follows::Arc(p, _) | Follows::Face(p) => p,
        }
    }

    /// The radius of its end (m); 0 for an edge, nothing for a face.
    pub fn radius(&self) -> Option<f64> {
        match *self {
            Follows::Edge(_) => Some(0.0),
            Follows::Roller(_, r) | Follows::Arc(_, r) => Some(r),
            Follows::Face(_) => None,
        }
    }
}

/// A disc cam and its follower, as the scene gives them.
#[derive(Clone, Debug, PartialEq)]
pub struct Cam {
    /// The link that is the cam.
    pub cam: LinkId,
    /// The link that it moves.
    pub follower: LinkId,
    /// With what the follower touches.
    pub follows: Follows,
    /// The name of the contact, if it has one.
    pub at: Option<String>,
    /// A profile that is one circle: its centre and radius (m). It needs no pose.
    pub circle: Option<(PointId, f64)>,
    /// The cam on a pivot of the ground with its follower on the ground: what it does over a whole turn. `None` where either is carried by a
    /// moving link.
    pub disc: Option<Turning>,
    /// The pieces of a profile that the coordinates of the pose place: cam or follower is carried by a moving link.
    pub posed: Option<Pieces>,
    /// The guide that stands for the contact; a law has a driver instead.
    pub contact: Option<GuideId>,
    /// Where it is declared.
    pub span: Span,
}

/// A profile of several pieces on a link.
#[derive(Clone, Debug, PartialEq)]
pub struct Pieces {
    /// The points of the cam in whose frame the pieces are: origin in the first, x toward the second.
    pub frame: [PointId; 2],
    /// The pieces, counter-clockwise.
    pub segments: Vec<Segment>,
    /// The one that is touched in the pose.
    pub touched: usize,
}

/// A cam that turns about a pivot of the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Turning {
    /// The pivot.
    pub pivot: PointId,
    /// Its geometry. φ counts in the sense in which the cam turns.
    pub disc: Disc,
    /// φ at the instant (rad).
    pub phi: f64,
    /// The driver that turns the cam, index into the scene's list.
    pub driver: usize,
    /// For a law: the driver that stands for the contact.
    pub by_law: Option<usize>,
    /// The driver's angle (rad) at φ = 0.
    pub start: f64,
    /// The coordinate of the follower in its own guide, or its angle (m, rad), where [`Disc`] counts from.
    pub origin: f64,
    /// +1 where the two grow together, −1 otherwise.
    pub outward: f64,
    /// The pair that stands for the contact: the piece of the profile that is touched.
    pub touched: Option<usize>,
    /// On which side of a joint the instant is seen: as it goes on in the driver's sense.
    pub side: Side,
}
