//! What joins two points of which a relative quantity is asked: a link that carries both, a cylinder between them, a guide along
//! which one slides on the other.
//!
//! Decided from topology alone. aⁿ and aᵗ belong to a body that turns with the line of the two points; v_r, aʳ and aᵏ belong to a guide
//! or a cylinder. A question without its joint is a fault ([`check`]), for the quantity is not defined then.

use crate::diag::{Both, Diagnostic, Faults, both};
use crate::scene::{Asked, DriverKind, Find, Guide, GuideId, LinkId, OnLink, Scene};

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
    let ends = |kind: &DriverKind| match kind {
        DriverKind::Cylinder { a: p, b: q, .. } => [(*p, *q), (*q, *p)].contains(&(a.point, b.point)),
        DriverKind::Turn { .. } | DriverKind::Slide { .. } => false,
    };
    both.map(Joined::Link).or_else(|| scene.drivers.iter().position(|d| ends(&d.kind)).map(Joined::Cylinder))
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

/// The faults of questions whose two points nothing joins as the quantity demands.
pub(super) fn check(scene: &Scene) -> Faults {
    let mut faults = Faults::default();
    scene.find.iter().filter_map(|f| fault(scene, f)).for_each(|d| faults.push(d));
    faults
}

fn fault(scene: &Scene, find: &Find) -> Option<Diagnostic> {
    let error = |message: Both, help: Both| Some(Diagnostic::error("find", message).at(find.span).help(help));
    let name = |p: &OnLink| match p.link {
        Some(l) => format!("{}{}", scene.point_name(p.point), scene.link_name(l)),
        None => scene.point_name(p.point).to_string(),
    };
    match &find.what {
        Asked::NormalAcceleration(a, b) | Asked::TangentialAcceleration(a, b) => match joined(scene, a, b) {
            Some(Joined::Link(_) | Joined::Cylinder(_)) => None,
            Some(Joined::Guide(_)) | None => {
                let (a, b) = (name(a), name(b));
                error(
                    both!(
                        "`{}`: {a} and {b} are on no common link, so their relative acceleration has no normal and tangential part",
                        "`{}`：{a} 与 {b} 不在同一构件上，其相对加速度没有法向和切向分量",
                        find.text
                    ),
                    both!(
                        "ask a_{a}{b} for the whole, or name two points of one link or the ends of a cylinder",
                        "请求总的 a_{a}{b}，或写同一构件上的两点或液压缸的两端"
                    ),
                )
            }
        },
        Asked::SlidingVelocity(a, b) | Asked::SlidingAcceleration(a, b) | Asked::Coriolis(a, b) => match joined(scene, a, b) {
            Some(Joined::Guide(_) | Joined::Cylinder(_)) => None,
            Some(Joined::Link(_)) | None => {
                let (a, b) = (name(a), name(b));
                error(
                    both!(
                        "`{}`: no guide joins {a} and {b}, so neither slides along the other",
                        "`{}`：{a} 与 {b} 之间没有导路，不存在相对滑动",
                        find.text
                    ),
                    both!(
                        "ask v_{a}{b} or a_{a}{b}, or name the coincident points of a slider and the link that carries its guide{}",
                        "请求 v_{a}{b} 或 a_{a}{b}，或写滑块与导路所在构件的重合点{}",
                        example(scene)
                    ),
                )
            }
        },
        Asked::Coordinate(..)
        | Asked::LinkAngle(_)
        | Asked::Distance(..)
        | Asked::Velocity(_)
        | Asked::Acceleration(_)
        | Asked::RelativeVelocity(..)
        | Asked::RelativeAcceleration(..)
        | Asked::Omega(_)
        | Asked::Alpha(_)
        | Asked::RelativeOmega(..)
        | Asked::RelativeAlpha(..) => None,
    }
}

/// A pair that slides in this scene, as a question names it: `, such as B3B2`.
fn example(scene: &Scene) -> Both {
    let pair = |g: &Guide| {
        let p = scene.point_name(g.pin?);
        let runner = g.slider.map_or("", |s| scene.link_name(s));
        Some(both!(", such as {p}{runner}{p}{}", "，如 {p}{runner}{p}{}", scene.link_name(g.on)))
    };
    scene.guides.iter().find_map(pair).unwrap_or_default()
}
