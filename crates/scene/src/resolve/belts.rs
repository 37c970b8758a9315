//! The data of two neighbours in the sections `belts` and `chains`: the link that keeps their
//! distance, and their radii; the guide that keeps a rope taut.

use super::super::rolling::Contours;
use super::rolling::whole;
use super::*;

/// Resolves the two circles of a strand with known links and centres.
pub(super) fn round(
    c: &Context,
    raw: &RawRolling,
    strand: &RawStrand,
    links: [LinkId; 2],
    centres: [PointId; 2],
    faults: &mut Faults,
) -> Option<Contours> {
    let [p, q] = centres;
    let sizes = match &raw.sizes {
        RawSizes::Radii(radii) => {
            let radii: Vec<Option<GivenQuantity>> = radii
                .iter()
                .map(|r| c.values.positive_length(r, both!("the radius of a pulley"), faults))
                .collect();
            <[Option<GivenQuantity>; 2]>::try_from(radii).ok().map(|radii| (radii, None))
        }
        RawSizes::Teeth(teeth, pitch) => {
            let counts: Vec<Option<u32>> = teeth.iter().map(|z| whole(c, z, faults)).collect();
            let pitch = pitch
                .as_ref()
                .filter(|p| c.values.positive_length(p, both!("the pitch"), faults).is_some());
            let radius = |(q, z): (&RawQuantity, Option<u32>)| {
                // With z teeth on the sprocket and pitch p, the chain advances z p per revolution.
                let text = format!("({})*{}/(2*pi)", pitch?.text, z?);
                c.values.si(
                    &RawQuantity { text, span: q.span, bare: false },
                    RequiredQuantity::Length,
                    &mut Faults::default(),
                )
            };
            match (&teeth[..], &counts[..]) {
                ([a, b], &[y, z]) => {
                    Some(([radius((a, y)), radius((b, z))], y.zip(z).map(|(y, z)| [y, z])))
                }
                _ => None,
            }
        }
    };
    let arm = (0..c.names.links.len())
        .map(LinkId)
        .find(|l| !links.contains(l) && c.carries(*l, p) && c.carries(*l, q));
    if arm.is_none() {
        let message = both!(
            "no link carries both {} and {}: nothing keeps the belt tight",
            c.point_name(p),
            c.point_name(q)
        );
        faults.push(Diagnostic::error("belt-arm", message).at(raw.span).help(both!(
            "list both centres among the points of the ground, or of the arm that carries the wheels"
        )));
    }
    let ([a, b], teeth) = sizes?;
    let RawStrand { belt, crossed, right, .. } = *strand;
    Some(Contours::Belt { centres, radii: [a?, b?], teeth, crossed, right, arm: arm?, belt })
}

/// Checks that a rope stays taut and keeps its direction: its load must slide in a guide of a link
/// that carries the drum's axis.
pub(super) fn taut(
    c: &Context,
    raw: &RawRolling,
    (load, axis): (LinkId, PointId),
    faults: &mut Faults,
) -> Option<()> {
    let is = |word: &Option<Word>, link: LinkId| {
        word.as_ref().map_or(link == c.ground, |w| w.text == c.link_name(link))
    };
    let carriers = || (0..c.names.links.len()).map(LinkId).filter(|l| c.carries(*l, axis));
    let joins = |g: &RawGuide| {
        let slides =
            |of: LinkId, on: LinkId| g.slider.is_some() && is(&g.slider, of) && is(&g.on, on);
        carriers().any(|l| slides(load, l) || slides(l, load))
    };
    if c.raw.guides.iter().any(joins) {
        return Some(());
    }
    let (load, axis) = (c.link_name(load), c.point_name(axis));
    let message = both!(
        "the load `{load}` of a rope slides in no guide of a link that carries the drum's axis {axis}"
    );
    faults.push(Diagnostic::error("rope-load", message).at(raw.span).help(both!(
        "add a guide with \"slider\": \"{load}\" in the direction of the rope, on the ground or the link that carries {axis}"
    )));
    None
}
