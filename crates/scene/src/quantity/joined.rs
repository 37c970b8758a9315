//! The joint of two points with a relative quantity: a link that carries both, a cylinder between
//! them, a guide along which one slides on the other.
//!
//! Topology alone decides. aⁿ and aᵗ belong to a body that turns with the line of the two points;
//! v_r, aʳ and aᵏ belong to a guide or a cylinder. A question without its joint is a fault, because
//! the quantity is then not defined.

use crate::model::{Guide, GuideId, LinkId, OnLink, PointId, Scene};

/// The joint of two points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PointJoint {
    /// One link that carries both.
    Link(LinkId),
    /// A cylinder whose ends they are (index of its driver).
    Cylinder(usize),
    /// A guide: the points coincide, and one slides on the other along it.
    Guide(GuideId),
}

/// Returns the joint of two points; `None` if only their v and a are defined.
pub fn joined(scene: &Scene, a: &OnLink, b: &OnLink) -> Option<PointJoint> {
    if a.point == b.point {
        let slides = |g: &Guide| {
            (carries(scene, g, a) && runs(scene, g, b))
                || (carries(scene, g, b) && runs(scene, g, a))
        };
        return scene.guides.iter().position(slides).map(|g| PointJoint::Guide(GuideId(g)));
    }
    let own = |l: LinkId, p: &OnLink| {
        p.link.map_or_else(|| scene.links[l.0].points.contains(&p.point), |on| on == l)
    };
    let both = (0..scene.links.len()).map(LinkId).find(|l| own(*l, a) && own(*l, b));
    let ends = |[p, q]: [PointId; 2]| [(p, q), (q, p)].contains(&(a.point, b.point));
    both.map(PointJoint::Link).or_else(|| {
        scene.drivers.iter().position(|d| d.kind.ends().is_some_and(ends)).map(PointJoint::Cylinder)
    })
}

/// Returns true if a point is on the link that carries the guide.
fn carries(scene: &Scene, g: &Guide, p: &OnLink) -> bool {
    p.link.map_or_else(|| scene.links[g.on.0].points.contains(&p.point), |l| l == g.on)
}

/// Returns true if a point runs in the guide: its pin (as a point of any link that the pin joins),
/// or any point of its slider.
fn runs(scene: &Scene, g: &Guide, p: &OnLink) -> bool {
    let is_pin = g.pin == Some(p.point)
        && p.link.is_none_or(|l| l != g.on && scene.links[l.0].points.contains(&p.point));
    let of_slider =
        |s: LinkId| p.link.map_or_else(|| scene.links[s.0].points.contains(&p.point), |l| l == s);
    is_pin || g.slider.is_some_and(of_slider)
}

/// Returns the name of a point in a question: `B`, `B3`.
pub(super) fn name(scene: &Scene, p: &OnLink) -> String {
    format!("{}{}", scene.point_name(p.point), p.link.map_or("", |l| scene.link_name(l)))
}
