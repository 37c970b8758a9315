//! What joins two points of which a relative quantity is asked: a link that carries both, a cylinder between them, a guide along
//! which one slides on the other.
//!
//! Decided from topology alone. aⁿ and aᵗ belong to a body that turns with the line of the two points; v_r, aʳ and aᵏ belong to a guide
//! or a cylinder. A question without its joint is a fault, for the quantity is not defined then.

use crate::model::{Guide, GuideId, LinkId, OnLink, PointId, Scene};

/// What joins two points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joined {
    /// One link carries both.
    Link(LinkId),
    /// They are the ends of a cylinder (index of its driver).
    Cylinder(usize),
    /// They coincide, and one slides on the other along a guide.
    Guide(GuideId),
}

/// What joins two points; `None`: nothing that a relative quantity other than v and a could belong to.
pub fn joined(scene: &Scene, a: &OnLink, b: &OnLink) -> Option<Joined> {
    if a.point == b.point {
        let slides = |g: &Guide| (carries(scene, g, a) && runs(scene, g, b)) || (carries(scene, g, b) && runs(scene, g, a));
        return scene.guides.iter().position(slides).map(|g| Joined::Guide(GuideId(g)));
    }
    let own = |l: LinkId, p: &OnLink| p.link.map_or_else(|| scene.links[l.0].points.contains(&p.point), |on| on == l);
    let both = (0..scene.links.len()).map(LinkId).find(|l| own(*l, a) && own(*l, b));
    let ends = |[p, q]: [PointId; 2]| [(p, q), (q, p)].contains(&(a.point, b.point));
    both.map(Joined::Link).or_else(|| scene.drivers.iter().position(|d| d.kind.ends().is_some_and(ends)).map(Joined::Cylinder))
}

/// Whether a point is one of the link that carries the guide.
fn carries(scene: &Scene, g: &Guide, p: &OnLink) -> bool {
    p.link.map_or_else(|| scene.links[g.on.0].points.contains(&p.point), |l| l == g.on)
}

/// Whether a point runs in the guide: its pin (of whichever link that the pin joins), or any point of its slider.
fn runs(scene: &Scene, g: &Guide, p: &OnLink) -> bool {
    let is_pin = g.pin == Some(p.point) && p.link.is_none_or(|l| l != g.on && scene.links[l.0].points.contains(&p.point));
    let of_slider = |s: LinkId| p.link.map_or_else(|| scene.links[s.0].points.contains(&p.point), |l| l == s);
    is_pin || g.slider.is_some_and(of_slider)
}

/// A point as a question names it: `B`, `B3`.
pub(super) fn name(scene: &Scene, p: &OnLink) -> String {
    format!("{}{}", scene.point_name(p.point), p.link.map_or("", |l| scene.link_name(l)))
}
