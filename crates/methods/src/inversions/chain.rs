//! The slider-crank chain: the role of each of its four links.

use hodograph_scene::{GuidePath, LinkId, Scene};

/// A link of the slider-crank chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChainLink {
    /// The link that carries the guide.
    Guide,
    /// The link that slides in the guide.
    Slider,
    /// The link pinned to the link with the guide.
    Crank,
    /// The link pinned to crank and slider.
    Coupler,
}

/// Returns the role of a link in the slider-crank chain; `None` in every other chain.
pub fn part(scene: &Scene, link: LinkId) -> Option<ChainLink> {
    let [guide] = &scene.guides[..] else { return None };
    let (GuidePath::Line { .. }, Some(slider)) = (&guide.path, guide.slider) else { return None };
    if scene.links.len() != 4 || !scene.rolling.is_empty() || !scene.cams.is_empty() {
        return None;
    }
    let points = |l: LinkId| &scene.links[l.0].points;
    let pinned = |a: LinkId, b: LinkId| points(a).iter().any(|p| points(b).contains(p));
    let on_slider =
        |l: LinkId| guide.pin.is_some_and(|p| points(l).contains(&p)) || pinned(l, slider);
    let mut others = (0..4).map(LinkId).filter(|l| *l != guide.on && *l != slider);
    let (a, b) = (others.next()?, others.next()?);
    let (crank, coupler) = if on_slider(b) { (a, b) } else { (b, a) };
    let closes = on_slider(coupler)
        && pinned(crank, coupler)
        && pinned(crank, guide.on)
        && !on_slider(crank);
    let of = |l: LinkId| match l {
        l if l == guide.on => ChainLink::Guide,
        l if l == slider => ChainLink::Slider,
        l if l == crank => ChainLink::Crank,
        _ => ChainLink::Coupler,
    };
    closes.then(|| of(link))
}
