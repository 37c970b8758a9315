//! The sections `gears` and `rolling`: both become rolling pairs, distinguished by their teeth.

use super::super::keys;
use super::super::raw::*;
use super::super::rolling::RollingKind;
use super::{flag, quantity, through, words};
use hodograph_base::diag::{Diagnostic, Faults, Span, both};
use hodograph_base::json::fields::{Fields, list, word};
use hodograph_base::json::{Node, Word};

/// Decodes a gear pair, or a gear and its rack; a mobility count needs no sizes.
pub(super) fn gear(node: &Node, extent: RequiredData, faults: &mut Faults) -> Option<RawRolling> {
    let f = Fields::open(node, both!("a gear pair"), keys::GEAR, faults)?;
    let before = faults.list.len();
    let links = f
        .need("links", "[\"2\", \"4\"]", faults)
        .map(|n| words(Some(n), "\"links\"", faults))
        .unwrap_or_default();
    let centres = f
        .need("centres", "[\"O\", \"Q\"]", faults)
        .map(|n| words(Some(n), "\"centres\"", faults))
        .unwrap_or_default();
    let mut name = |key: &str| f.get(key).and_then(|n| word(n, &format!("\"{key}\""), faults));
    let (ring, rack, line, at) = (name("ring"), name("rack"), name("line"), name("at"));
    let mut value = |key: &str| f.get(key).and_then(|n| quantity(n, &format!("\"{key}\""), faults));
    let (module, angle, phase) = (value("module"), value("angle"), value("phase"));
    let (pressure_angle, addendum, clearance) =
        (value("pressure_angle"), value("addendum"), value("clearance"));
    let mut values = |key: &str| f.get(key).map(|n| quantities(n, key, faults));
    let (radii, teeth, shift) = (values("radii"), values("teeth"), values("shift"));
    let through = through(&f, faults);
    let flanks = RawFlanks { pressure_angle, shift, addendum, clearance };
    if faults.list.len() > before {
        return None;
    }
    let mut fault = |d: Diagnostic| faults.push(d.at(node.span));
    let sizes = match (radii, teeth, module) {
        (Some(radii), None, None) => RawSizes::Radii(radii),
        (None, Some(teeth), module) => RawSizes::Teeth(teeth, module),
        (Some(_), Some(_), _) | (Some(_), None, Some(_)) => {
            let d =
                Diagnostic::error("two-sizes", both!("a gear pair has both `radii` and `teeth`"));
            fault(d.help(both!("keep \"radii\", or \"teeth\" and \"module\"")));
            return None;
        }
        (None, None, module) if extent.is_of_pairs() => {
            some_teeth(&links, (&ring, &rack), module, node.span)
        }
        (None, None, _) => {
            let d = Diagnostic::error(
                "missing-key",
                both!("a gear pair has neither `radii` nor `teeth`"),
            );
            fault(d.help(both!(
                "give the pitch radii, \"radii\": [\"30 mm\", \"60 mm\"], or the numbers of teeth, \"teeth\": [20, 40]"
            )));
            return None;
        }
    };
    let [a, b] = &links[..] else {
        let d = Diagnostic::error("wrong-count", both!("\"links\" of a gear pair names two links"));
        fault(d.help(both!("write \"links\": [\"2\", \"4\"]; three gears in mesh are two pairs")));
        return None;
    };
    let among = |w: &Option<Word>| w.as_ref().map(|w| links.iter().position(|l| l.text == w.text));
    let (hollow, flat) = (among(&ring), among(&rack));
    for (given, place, what) in
        [(&ring, hollow, both!("the ring")), (&rack, flat, both!("the rack"))]
    {
        if let (Some(word), Some(None)) = (given, place) {
            let message = both!("{} `{}` is not one of the two links", what, word.text);
            let names = both!("they are {}, {}", a.text, b.text);
            faults.push(Diagnostic::error("unknown-link", message).at(word.span).help(names));
            return None;
        }
    }
    if let (Some(word), Some(_)) = (&ring, &rack) {
        let d =
            Diagnostic::error("ring-and-rack", both!("a gear pair has both a `ring` and a `rack`"));
        faults
            .push(d.at(word.span).help(both!("a gear runs inside a ring, or on a rack: keep one")));
        return None;
    }
    let sides = match (flat.flatten(), &centres[..]) {
        (Some(i), [c]) => [side(&links[i], None, false), side(&links[1 - i], Some(c), false)],
        (None, [c, d]) => [
            side(a, Some(c), hollow.flatten() == Some(0)),
            side(b, Some(d), hollow.flatten() == Some(1)),
        ],
        (Some(_), _) => {
            let d = Diagnostic::error("wrong-count", both!("a gear on a rack has one centre"));
            fault(d.help(both!("write \"centres\": [\"C\"], the centre of the gear")));
            return None;
        }
        (None, _) => {
            let d = Diagnostic::error(
                "wrong-count",
                both!("a gear pair has two centres, one on each link"),
            );
            fault(d.help(both!("name the \"rack\" if one of them is straight")));
            return None;
        }
    };
    Some(RawRolling {
        sides,
        sizes,
        kind: RollingKind::Gears,
        strand: None,
        line,
        through,
        angle,
        at,
        phase,
        flanks,
        span: node.span,
    })
}

/// Decodes a wheel that rolls without slip on a straight or round track; a mobility count needs
/// no radius.
pub(super) fn wheel(node: &Node, extent: RequiredData, faults: &mut Faults) -> Option<RawRolling> {
    let f = Fields::open(node, both!("a rolling wheel"), keys::ROLLING, faults)?;
    let before = faults.list.len();
    let link = f.need("wheel", "\"4\"", faults).and_then(|n| word(n, "\"wheel\"", faults));
    let centre = f.need("centre", "\"B\"", faults).and_then(|n| word(n, "\"centre\"", faults));
    let counted = extent
        .is_of_pairs()
        .then(|| written("10 mm", node.span))
        .filter(|_| f.get("radius").is_none());
    let radius = match counted {
        Some(radius) => Some(radius),
        None => {
            f.need("radius", "\"0.2 m\"", faults).and_then(|n| quantity(n, "\"radius\"", faults))
        }
    };
    let mut name = |key: &str| f.get(key).and_then(|n| word(n, &format!("\"{key}\""), faults));
    let (on, line, track, at) = (name("on"), name("line"), name("track"), name("at"));
    let mut value = |key: &str| f.get(key).and_then(|n| quantity(n, &format!("\"{key}\""), faults));
    let (angle, track_radius, phase) = (value("angle"), value("track_radius"), value("phase"));
    let through = through(&f, faults);
    let inside = f.get("inside").and_then(|n| flag(n, "inside", faults));
    let (link, centre, radius) = (link?, centre?, radius?);
    if faults.list.len() > before {
        return None;
    }
    let mut fault = |message, help| {
        faults.push(Diagnostic::error("track", message).at(node.span).help(help));
        None
    };
    let mut radii = vec![radius];
    match (&track, track_radius, inside) {
        (Some(_), Some(r), _) => radii.insert(0, r),
        (None, None, None) => {}
        (Some(_), None, _) if extent.is_of_pairs() => radii.insert(0, written("100 mm", node.span)),
        (Some(_), None, _) => {
            return fault(
                both!("a round track has no `track_radius`"),
                both!("give the radius of the track's own circle"),
            );
        }
        (None, Some(_), _) | (None, None, Some(_)) => {
            return fault(
                both!(
                    "`track_radius` and `inside` belong to a round track, whose centre is not named"
                ),
                both!("name its centre, \"track\", a point of the link that carries it"),
            );
        }
    }
    let of_track = RawRollingSide { link: on, centre: track, hollow: inside == Some(true) };
    let sides =
        [of_track, RawRollingSide { link: Some(link), centre: Some(centre), hollow: false }];
    Some(RawRolling {
        sides,
        sizes: RawSizes::Radii(radii),
        kind: RollingKind::Wheel,
        strand: None,
        line,
        through,
        angle,
        at,
        phase,
        flanks: RawFlanks::default(),
        span: node.span,
    })
}

/// Returns sizes for a mobility count. Their values have no effect, except that a ring must be
/// the larger one: with a planet between a sun of equal size and the ring, the ring has three times
/// their teeth.
fn some_teeth(
    links: &[Word],
    (ring, rack): (&Option<Word>, &Option<Word>),
    module: Option<RawQuantity>,
    span: Span,
) -> RawSizes {
    let of = |link: &Word| match ring {
        Some(ring) if ring.text == link.text => written("60", span),
        Some(_) | None => written("20", span),
    };
    let geared = links.iter().filter(|l| rack.as_ref().is_none_or(|r| r.text != l.text));
    let module = module.or_else(|| rack.as_ref().map(|_| written("1 mm", span)));
    RawSizes::Teeth(geared.map(of).collect(), module)
}

/// A quantity that is not in the file.
fn written(text: &str, span: Span) -> RawQuantity {
    RawQuantity { text: text.to_owned(), span, bare: false }
}

pub(super) fn side(link: &Word, centre: Option<&Word>, hollow: bool) -> RawRollingSide {
    RawRollingSide { link: Some(link.clone()), centre: centre.cloned(), hollow }
}

pub(super) fn quantities(node: &Node, key: &str, faults: &mut Faults) -> Vec<RawQuantity> {
    let what = format!("\"{key}\"");
    list(node, &what, faults)
        .unwrap_or_default()
        .iter()
        .filter_map(|n| quantity(n, &what, faults))
        .collect()
}
