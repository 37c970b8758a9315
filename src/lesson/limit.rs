//! Why a driver can go no farther, in words: which links lie in line.
//!
//! Decided here: what is said. The place was found by halving ([`crate::sweep::follow`]); there the two loci of a dyad's pin touch, so
//! that the two lines square to them fall together.

use crate::geom::Vec2;
use crate::mechanism::{Core, Leg, Mechanism};
use crate::position::Configuration;
use crate::scene::{Lang, PointId, Scene};

use super::words::word;

/// At the limit itself the sine is the root of the rounding (1e-8 for links of like length), elsewhere it is not small.
const IN_LINE: f64 = 1e-5;

/// A leg at the limit.
enum Side {
    Bar(String, PointId, PointId),
    Cylinder(PointId, PointId),
    Guide,
}

/// What stands at a limit; `None` for a pose in which no dyad's lines fall together.
pub fn words(scene: &Scene, m: &Mechanism, at: &Configuration, lang: Lang) -> Option<String> {
    m.groups.iter().find_map(|group| {
        let Core::Pin { pin, legs } = &group.core else { return None };
        let sides: Vec<(Side, Vec2)> = legs.iter().filter_map(|leg| side(scene, at, *pin, leg)).collect();
        let [(a, u), (b, v)] = &sides[..] else { return None };
        (u.cross(*v).abs() < IN_LINE).then(|| said(scene, [a, b], *pin, lang))?
    })
}

/// The leg, and the unit vector square to its locus.
fn side(scene: &Scene, at: &Configuration, pin: PointId, leg: &Leg) -> Option<(Side, Vec2)> {
    let along = |a: PointId, b: PointId| (at.points[a.0]? - at.points[b.0]?).unit();
    match *leg {
        Leg::Bar { link, near, far } => Some((Side::Bar(scene.link_name(link).to_owned(), near, far), along(near, far)?)),
        Leg::Cylinder { near, far, .. } => Some((Side::Cylinder(near, far), along(near, far)?)),
        Leg::OnGuide { guide, .. } => Some((Side::Guide, at.guides[guide.0]?.tangent_at(at.points[pin.0]?).perp())),
        _ => None,
    }
}

fn said(scene: &Scene, sides: [&Side; 2], pin: PointId, lang: Lang) -> Option<String> {
    // In the order of the scene, so that one line has one name: AB, never BA.
    let letters = |a: &PointId, b: &PointId| format!("{}{}", scene.point_name(*a.min(b)), scene.point_name(*a.max(b)));
    let name = |side: &Side| match side {
        Side::Bar(link, a, b) => Some(word("link", lang).replace("{}", link).replace("{1}", &letters(a, b))),
        Side::Cylinder(a, b) => Some(word("cylinder", lang).replace("{1}", &letters(a, b))),
        Side::Guide => None,
    };
    match sides.map(name) {
        [Some(a), Some(b)] => Some(word("limit_links", lang).replace("{}", &format!("{a}{}{b}", word("and", lang)))),
        [Some(bar), None] | [None, Some(bar)] => Some(word("limit_square", lang).replace("{}", &bar).replace("{1}", scene.point_name(pin))),
        [None, None] => None,
    }
}
