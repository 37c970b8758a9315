//! Chains of four links with one or two slides: the role of each link, from the order of the pairs
//! around the loop.

use hodograph_scene::{GuidePath, LinkId, Scene, Through};

/// A link of a chain of four links with slides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChainLink {
    /// Slider-crank chain: the link that carries the guide.
    Guide,
    /// Slider-crank chain: the link that slides in the guide.
    Slider,
    /// Slider-crank chain: the link pinned to the link with the guide.
    Crank,
    /// Slider-crank chain: the link pinned to crank and slider.
    Coupler,
    /// Double-slider chain: the link between the two slides.
    Cross,
    /// Double-slider chain: a link between a slide and a pin.
    Block,
    /// Double-slider chain: the link between the two pins.
    Connector,
    /// A link of the chain in which slides and pins alternate.
    Alternate,
}

/// A body of a chain: a link, or the block that a bare pin in a slot stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Body {
    Link(LinkId),
    Pin(usize),
}

/// A pair of a chain: its two bodies, and true for a slide; the first body of a slide has the guide.
type ChainPair = ([Body; 2], bool);

/// Returns the pairs of a chain; `None` with an arc, or a pin of three bodies.
fn pairs(scene: &Scene) -> Option<Vec<ChainPair>> {
    let mut out = Vec::new();
    let mut blocks = vec![None; scene.guides.len()];
    for (k, guide) in scene.guides.iter().enumerate() {
        let GuidePath::Line { .. } = &guide.path else { return None };
        let block = guide.slider.map_or(Body::Pin(k), Body::Link);
        blocks[k] = Some(block);
        out.push(([Body::Link(guide.on), block], true));
    }
    for p in 0..scene.points.len() {
        let mut bodies: Vec<Body> = (0..scene.links.len())
            .map(LinkId)
            .filter(|l| scene.links[l.0].points.iter().any(|q| q.0 == p))
            .map(Body::Link)
            .collect();
        for (guide, block) in scene.guides.iter().zip(&blocks) {
            // A pin on the link with its own guide is named there as the place of a block.
            if guide.pin.is_some_and(|q| q.0 == p) {
                bodies.retain(|b| *b != Body::Link(guide.on));
                bodies.extend(block.filter(|b| !bodies.contains(b)));
            }
        }
        match bodies[..] {
            [] | [_] => {}
            [a, b] => out.push(([a, b], false)),
            _ => return None,
        }
    }
    Some(out)
}

/// True if the guide is the bore of a block: a moving link with one joint, on the guide, for the rod
/// of another link. A link that a driver turns is a lever.
pub fn is_bore(scene: &Scene) -> bool {
    scene.guides.iter().any(|g| {
        let [joint] = scene.links[g.on.0].points[..] else { return false };
        let through =
            matches!(g.path, GuidePath::Line { through: Through::Point(p), .. } if p == joint);
        let turned = scene.drivers.iter().any(|d| d.kind.turns_link(g.on));
        g.on != scene.ground
            && !turned
            && through
            && g.slider.is_some()
            && g.pin.is_some_and(|p| p != joint)
    })
}

/// Returns the role of a link in a chain of four links with one or two slides; `None` in every
/// other chain.
pub fn part(scene: &Scene, link: LinkId) -> Option<ChainLink> {
    let plain = scene.rolling.is_empty() && scene.cams.is_empty();
    let pairs = pairs(scene).filter(|pairs| plain && pairs.len() == 4)?;
    let own = |b: Body| pairs.iter().filter(move |(bodies, _)| bodies.contains(&b));
    let bodies: Vec<Body> = (0..scene.links.len())
        .map(|l| Body::Link(LinkId(l)))
        .chain((0..scene.guides.len()).map(Body::Pin))
        .filter(|b| own(*b).count() > 0)
        .collect();
    if bodies.len() != 4 || bodies.iter().any(|b| own(*b).count() != 2) {
        return None;
    }
    let slides = |b: Body| own(b).filter(|(_, slide)| *slide).count();
    let beside = |b: Body| {
        own(b).flat_map(|(bodies, _)| *bodies).filter(|other| *other != b).collect::<Vec<_>>()
    };
    let body = Body::Link(link);
    match pairs.iter().filter(|(_, slide)| *slide).count() {
        1 => {
            let [mut guide, mut slider] = pairs.iter().find(|(_, slide)| *slide)?.0;
            if is_bore(scene) {
                (guide, slider) = (slider, guide);
            }
            Some(match body {
                b if b == guide => ChainLink::Guide,
                b if b == slider => ChainLink::Slider,
                b if beside(b).contains(&guide) => ChainLink::Crank,
                _ => ChainLink::Coupler,
            })
        }
        2 if bodies.iter().all(|b| slides(*b) == 1) => Some(ChainLink::Alternate),
        2 => Some(match slides(body) {
            2 => ChainLink::Cross,
            1 => ChainLink::Block,
            _ => ChainLink::Connector,
        }),
        _ => None,
    }
}
