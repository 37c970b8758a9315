//! Places where links press on each other.

use crate::model::{Guide, GuideId, LinkId, PointId, Scene};
use crate::rolling::{RollingId, Touch};

/// A place where two links press on each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contact {
    /// In a pin that joins no others.
    Pin(PointId),
    /// In a guide; `true` where the second link carries it.
    Guide(GuideId, bool),
    /// The contact of a rolling pair; `true` where the second link is the first of the pair.
    Rolling(RollingId, bool),
}

/// The number of parties that press on a pin: links, bare guides in which it runs, cylinders of which no numbered part carries it.
/// The line of a rope holds no pin.
pub fn parties(scene: &Scene, p: PointId) -> usize {
    let rope = |g: &Guide| g.rolling.is_some_and(|r| scene.rolling[r.0].kind.is_flexible());
    let slots = scene.guides.iter().filter(|g| g.pin == Some(p) && g.slider.is_none() && !rope(g)).count();
    let carried = |l: &LinkId| scene.links[l.0].points.contains(&p);
    let cylinders =
        scene.drivers.iter().filter(|d| d.kind.ends().is_some_and(|ends| ends.contains(&p)) && !d.kind.parts().iter().any(carried));
    scene.carriers(p).count() + slots + cylinders.count()
}

/// Points at which a link is met: its own, then the pins that run in its guides, then its places of contact.
pub fn met_at(scene: &Scene, l: LinkId) -> impl Iterator<Item = PointId> + '_ {
    let own = scene.links[l.0].points.iter().copied();
    let pins = scene.guides.iter().filter(move |g| g.on == l).filter_map(|g| g.pin);
    let contacts = scene.rolling.iter().filter_map(move |r| r.links.iter().position(|own| *own == l).map(|k| r.at[k]));
    own.chain(pins).chain(contacts)
}

/// The places where two links press on each other, with nothing between them.
pub fn contacts(scene: &Scene, i: LinkId, j: LinkId) -> Vec<Contact> {
    let mut out = Vec::new();
    let both_carry = |p: &PointId| scene.links[i.0].points.contains(p) && scene.links[j.0].points.contains(p);
    let pins = (0..scene.points.len()).map(PointId).filter(both_carry).filter(|p| parties(scene, *p) == 2);
    out.extend(pins.map(Contact::Pin));
    for (g, guide) in scene.guides.iter().enumerate() {
        // A guide that keeps two wheels in touch is a part of their rolling pair.
        if guide.rolling.is_some() {
            continue;
        }
        let runs = |l: LinkId| match (guide.slider, guide.pin) {
            (Some(slider), _) => slider == l,
            (None, Some(p)) => parties(scene, p) == 2 && scene.carriers(p).eq([l]),
            (None, None) => false,
        };
        if guide.on == i && runs(j) {
            out.push(Contact::Guide(GuideId(g), false));
        } else if guide.on == j && runs(i) {
            out.push(Contact::Guide(GuideId(g), true));
        }
    }
    for (r, pair) in scene.rolling.iter().enumerate() {
        if !matches!(pair.touch(), Touch::Point(_)) {
            continue;
        }
        if pair.links == [i, j] || pair.links == [j, i] {
            out.push(Contact::Rolling(RollingId(r), pair.links == [j, i]));
        }
    }
    out
}

/// The next joint of a link beside a pin: where another link or a guide holds it.
pub fn bar(scene: &Scene, pin: PointId, link: LinkId) -> Option<PointId> {
    scene.links[link.0].points.iter().copied().find(|p| *p != pin && parties(scene, *p) > 1)
}
