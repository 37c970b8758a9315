//! Frames of reference for moving points, and the paths of the points in them, from topology alone.
//!
//! A moving point M is observed from a link (the axes turn with it) or from another point (the axes
//! translate with that). The point of the frame that coincides with M is the transport point; in a
//! frame that translates with C it moves as C does.

use super::{PointJoint, joined};
use crate::model::{GuideId, GuidePath, LinkId, OnLink, PointId, Scene};

/// The frame from which a moving point is observed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frame {
    /// A link: axes that turn with it.
    Link(LinkId),
    /// A point: axes that translate with it.
    Point(OnLink),
}

impl Frame {
    /// Returns the point of the frame that coincides with a moving point, or a point with the same
    /// motion.
    pub fn transport_point(self, of: OnLink) -> OnLink {
        match self {
            Frame::Link(l) => OnLink { point: of.point, link: Some(l) },
            Frame::Point(p) => p,
        }
    }

    /// Returns the fixed axis about which the frame turns, or about which the reference point of a
    /// translating frame moves.
    pub fn axis(self, scene: &Scene, of: OnLink) -> Option<PointId> {
        let fixed = |p: &PointId| scene.links[scene.ground.0].points.contains(p);
        let on = |l: LinkId, own: PointId| {
            scene.links[l.0].points.iter().copied().find(|p| fixed(p) && *p != own)
        };
        match self {
            Frame::Link(l) => on(l, of.point),
            Frame::Point(c) => carriers(scene, &c).find_map(|l| on(l, c.point)),
        }
    }

    /// Returns true if the frame is at rest, so that there is no transport motion.
    pub fn is_fixed(self, scene: &Scene) -> bool {
        match self {
            Frame::Link(l) => l == scene.ground,
            Frame::Point(p) => owns(scene, scene.ground, &p),
        }
    }

    /// Returns true if a point is permanently fixed in the frame.
    pub fn carries(self, scene: &Scene, of: &OnLink) -> bool {
        match self {
            Frame::Link(l) => owns(scene, l, of),
            Frame::Point(p) => {
                p.point == of.point && carriers(scene, of).any(|l| owns(scene, l, &p))
            }
        }
    }
}

/// The path of a moving point in a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RelativePath {
    /// Along a guide that turns with the frame.
    Guide(GuideId),
    /// A circle about a point of the frame.
    Circle(PointId),
    /// Not given by a pair.
    Unknown,
}

/// Returns true if a point is permanently fixed on a link.
pub fn owns(scene: &Scene, link: LinkId, p: &OnLink) -> bool {
    scene.links[link.0].points.contains(&p.point)
        && p.link.is_none_or(|l| l == link || scene.links[l.0].points.contains(&p.point))
        || p.link == Some(link)
}

/// Returns the links on which a point is permanently fixed.
fn carriers<'a>(scene: &'a Scene, p: &'a OnLink) -> impl Iterator<Item = LinkId> + 'a {
    (0..scene.links.len()).map(LinkId).filter(|l| owns(scene, *l, p))
}

/// Returns the path of a moving point in a frame, from the pairs of the scene.
pub fn relative_path(scene: &Scene, of: OnLink, frame: Frame) -> RelativePath {
    let seat = frame.transport_point(of);
    if let (Frame::Link(l), Some(PointJoint::Guide(g))) = (frame, joined(scene, &of, &seat)) {
        let guide = &scene.guides[g.0];
        let straight = matches!(guide.path, GuidePath::Line { .. });
        // Of a block on an arc only the pin follows the arc; the others move on circles about the
        // same centre.
        let runs = if straight {
            guide.on == l || guide.slider == Some(l)
        } else {
            guide.on == l && guide.pin == Some(of.point)
        };
        if runs {
            return RelativePath::Guide(g);
        }
    }
    let other = |p: &PointId| *p != of.point;
    let bar = |p: &PointId| carriers(scene, &of).any(|k| scene.links[k.0].points.contains(p));
    let centre = match frame {
        Frame::Link(l) => scene.links[l.0]
            .points
            .iter()
            .copied()
            .filter(other)
            .find(|p| bar(p) || arc_keeps(scene, &of, OnLink { point: *p, link: Some(l) })),
        Frame::Point(c) => {
            let kept = c.point != of.point
                && (carriers(scene, &of).any(|k| owns(scene, k, &c)) || arc_keeps(scene, &of, c));
            kept.then_some(c.point)
        }
    };
    centre.map_or(RelativePath::Unknown, RelativePath::Circle)
}

/// Returns true if a guide along an arc fixes the distance of two points: its centre, and the pin
/// that runs in it.
fn arc_keeps(scene: &Scene, a: &OnLink, b: OnLink) -> bool {
    let pair = |guide: &crate::model::Guide, centre: &OnLink, pin: &OnLink| {
        let GuidePath::Arc { centre: k, .. } = guide.path else { return false };
        k == centre.point
            && owns(scene, guide.on, centre)
            && guide.pin == Some(pin.point)
            && pin.link.is_none_or(|l| l != guide.on)
    };
    scene.guides.iter().any(|g| pair(g, a, &b) || pair(g, &b, a))
}
