//! Centres that the pairs give at once, and pairs that give only a line: from topology alone.
//!
//! Only this module defines what each kind of pair gives. A pair that rolls or meshes gives its
//! contact as a [`Primary`] of its own; a pair that only touches gives its common normal as a
//! [`SlotNormal`].

use hodograph_scene::exact::Inputs;
use hodograph_scene::{DriverKind, GuideId, GuidePath, LinkId, PointId, RollingId, Scene};

/// A centre that needs no line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Primary {
    /// Both links turn about the point: a pin, or the centre of a curved guide in which a block
    /// slides.
    Pin(PointId),
    /// One link slides along the straight guide of the other: the centre is at infinity, square to
    /// the guide.
    Slide(GuideId),
    /// Barrel and rod of a cylinder (index of the driver): the centre is at infinity, square to the
    /// cylinder's line.
    Cylinder(usize),
    /// One link rolls on the other: the centre is the point of contact, for gears the pitch point.
    Contact(RollingId),
    /// A belt or chain joins two wheels: the centre is the crossing of the strand with the line of
    /// centres, because it divides that line as a pitch point does. For an open strand between
    /// equal wheels it is at infinity along the strand.
    Strand(RollingId),
}

/// A bare pin in a slot: the centre of the two links lies on the normal of the slot at the pin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SlotNormal {
    /// The link that carries the pin.
    pub pin_of: LinkId,
    /// The link that carries the slot.
    pub slot_of: LinkId,
    /// The slot.
    pub guide: GuideId,
    /// The pin.
    pub pin: PointId,
}

/// Primary centres and normals that the pairs of a scene give.
pub(super) struct PairCentres {
    /// Two links and their centre; each pair of links occurs once.
    pub primary: Vec<(LinkId, LinkId, Primary)>,
    /// The normals of bare pins in slots.
    pub normals: Vec<SlotNormal>,
    /// For each link, the lowest index in the class of links that never turn relative to it.
    translates: Vec<usize>,
}

impl PairCentres {
    /// True if the pairs between two links keep them from turning relative to one another: their
    /// centre is at infinity.
    pub fn translate(&self, a: LinkId, b: LinkId) -> bool {
        self.translates[a.0] == self.translates[b.0]
    }
}

/// Returns the primary centres and normals that the pairs of a scene give.
pub(super) fn given(scene: &Scene) -> PairCentres {
    let mut primary: Vec<(LinkId, LinkId, Primary)> = Vec::new();
    let mut add = |a: LinkId, b: LinkId, what: Primary| {
        let there = primary.iter().any(|(c, d, _)| (*c, *d) == (a, b) || (*c, *d) == (b, a));
        if a != b && !there {
            primary.push((a, b, what));
        }
    };
    for p in (0..scene.points.len()).map(PointId) {
        let around = around(scene, p);
        for (k, a) in around.iter().enumerate() {
            around[k + 1..].iter().for_each(|b| add(*a, *b, Primary::Pin(p)));
        }
    }
    let mut slides: Vec<(LinkId, LinkId)> = Vec::new();
    for (g, guide) in scene.guides.iter().enumerate() {
        if let (Some(slider), GuidePath::Line { .. }) = (guide.slider, &guide.path) {
            add(slider, guide.on, Primary::Slide(GuideId(g)));
            slides.push((slider, guide.on));
        }
    }
    for (d, driver) in scene.drivers.iter().enumerate() {
        if let DriverKind::Cylinder { links, .. } = &driver.kind
            && let [barrel, rod] = links[..]
        {
            add(barrel, rod, Primary::Cylinder(d));
            slides.push((barrel, rod));
        }
    }
    let inputs = Inputs::<f64>::of(scene);
    for (r, rolling) in scene.rolling.iter().enumerate() {
        let [a, b] = rolling.links;
        let what = if rolling.contact().is_some() { Primary::Contact } else { Primary::Strand };
        add(a, b, what(RollingId(r)));
        // Equal wheels of an open belt turn equally, independent of their carriers.
        if rolling.contact().is_none() && rolling.sizes(&inputs).iter().sum::<f64>() == 0.0 {
            slides.push((a, b));
        }
    }
    let normals =
        scene.guides.iter().enumerate().filter(|(_, guide)| guide.slider.is_none()).flat_map(
            |(g, guide)| {
                let on = guide
                    .pin
                    .into_iter()
                    .flat_map(|p| around(scene, p).into_iter().map(move |l| (l, p)));
                let on = on.filter(|(l, _)| *l != guide.on);
                on.map(move |(pin_of, pin)| SlotNormal {
                    pin_of,
                    slot_of: guide.on,
                    guide: GuideId(g),
                    pin,
                })
            },
        );
    PairCentres {
        normals: normals.collect(),
        translates: classes(scene.links.len(), &slides),
        primary,
    }
}

/// Returns the links that turn about a point: those that carry it, the barrel or rod that ends
/// there, and the blocks in curved guides with their centre there.
fn around(scene: &Scene, p: PointId) -> Vec<LinkId> {
    let mut out: Vec<LinkId> = scene.carriers(p).collect();
    let ends = scene.drivers.iter().flat_map(|d| match &d.kind {
        DriverKind::Cylinder { a, b, links, .. } => [*a, *b]
            .into_iter()
            .zip(links)
            .filter(|(end, _)| *end == p)
            .map(|(_, l)| *l)
            .collect::<Vec<_>>(),
        DriverKind::Turn { .. } | DriverKind::Slide { .. } => Vec::new(),
    });
    let blocks = scene.guides.iter().filter_map(|g| match g.path {
        GuidePath::Arc { centre, .. } if centre == p => g.slider,
        GuidePath::Arc { .. } | GuidePath::Line { .. } => None,
    });
    for l in ends.chain(blocks) {
        if !out.contains(&l) {
            out.push(l);
        }
    }
    out
}

/// Returns for each of `n` items the lowest index in its class of joined items.
fn classes(n: usize, joined: &[(LinkId, LinkId)]) -> Vec<usize> {
    let mut class: Vec<usize> = (0..n).collect();
    for (a, b) in joined {
        let (keep, drop) = (class[a.0].min(class[b.0]), class[a.0].max(class[b.0]));
        class.iter_mut().filter(|c| **c == drop).for_each(|c| *c = keep);
    }
    class
}
