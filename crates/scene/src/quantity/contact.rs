//! Places at which links press on each other.

use crate::model::{Guide, GuideId, LinkId, PointId, Scene};
use crate::rolling::{RollingId, Touch};

/// A place at which two links press on each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contact {
    /// A pin that joins only the two links.
    Pin(PointId),
    /// A guide; `true` if the second link carries it.
    Guide(GuideId, bool),
    /// The contact of a rolling pair; `true` if the second link is the first of the pair.
    Rolling(RollingId, bool),
}

/// Returns the number of bodies that press on a pin: links, bare guides in which it runs, and
/// cylinders without a numbered part that carries it. The guide of a rope does not hold the pin.
pub fn parties(scene: &Scene, p: PointId) -> usize {
    let rope = |g: &Guide| g.rolling.is_some_and(|r| scene.rolling[r.0].kind.is_flexible());
    let slots =
        scene.guides.iter().filter(|g| g.pin == Some(p) && g.slider.is_none() && !rope(g)).count();
    let carried = |l: &LinkId| scene.links[l.0].points.contains(&p);
    let cylinders = scene.drivers.iter().filter(|d| {
        d.kind.ends().is_some_and(|ends| ends.contains(&p)) && !d.kind.parts().iter().any(carried)
    });
    scene.carriers(p).count() + slots + cylinders.count()
}

/// Returns the points at which other bodies meet a link: its own, then the pins that run in its
/// guides, then its places of contact.
pub fn met_at(scene: &Scene, l: LinkId) -> impl Iterator<Item = PointId> + '_ {
    let own = scene.links[l.0].points.iter().copied();
    let pins = scene.guides.iter().filter(move |g| g.on == l).filter_map(|g| g.pin);
    let contacts = scene
        .rolling
        .iter()
        .filter_map(move |r| r.links.iter().position(|own| *own == l).map(|k| r.at[k]));
    own.chain(pins).chain(contacts)
}

/// Returns the places at which two links press directly on each other.
pub fn contacts(scene: &Scene, i: LinkId, j: LinkId) -> Vec<Contact> {
    let mut out = Vec::new();
    let both_carry =
        |p: &PointId| scene.links[i.0].points.contains(p) && scene.links[j.0].points.contains(p);
    let pins =
        (0..scene.points.len()).map(PointId).filter(both_carry).filter(|p| parties(scene, *p) == 2);
    out.extend(pins.map(Contact::Pin));
    for (g, guide) in scene.guides.iter().enumerate() {
        // A guide that keeps two wheels in touch belongs to their rolling pair.
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

/// Returns the next joint of a link besides a pin: a point at which another link or a guide holds
/// it.
pub fn bar(scene: &Scene, pin: PointId, link: LinkId) -> Option<PointId> {
    scene.links[link.0].points.iter().copied().find(|p| *p != pin && parties(scene, *p) > 1)
}
