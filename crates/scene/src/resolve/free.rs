//! Places of gear centres that the data leave free. A gear train given by its numbers of teeth
//! alone has definite angular velocities without sizes and directions: if the scene asks only for
//! these, the centres are placed along the x axis, as in books.

use super::super::quantity::Asked;
use super::super::rolling::{Contours, Sizes};
use super::*;

/// Places free centres along the x axis, each at the distance that lengths or radii give, else at
/// that of teeth of 1 mm module.
pub(super) fn centres(
    c: &Context,
    (rolling, drivers, find): (&mut rolling::Resolved, &[Driver], &[Find]),
    places: &mut [PointPlace],
    lengths: &[Length],
    faults: &mut Faults,
) {
    let turning_only = |f: &Find| matches!(f.what, Asked::Turning(_) | Asked::Ratio(_));
    if find.is_empty() || !find.iter().all(turning_only) {
        return;
    }
    let mut laid: Vec<PointId> = Vec::new();
    // A chain of gears is placed from its first axis on; each pass may make further centres
    // reachable.
    loop {
        let before = (laid.len(), rolling.lengths.len());
        for i in 0..rolling.rolling.len() {
            let Some([a, b]) = rolling.rolling[i].round() else { continue };
            for (from, to) in [(a, b), (b, a)] {
                lay(c, (&mut *rolling, i, drivers), (from, to), places, lengths, &mut laid);
            }
        }
        if (laid.len(), rolling.lengths.len()) == before {
            break;
        }
    }
    if !laid.is_empty() {
        let names: Vec<&str> = laid.iter().map(|p| c.point_name(*p)).collect();
        let message = both!(
            "no place is given for {}, and no answer depends on it: drawn along the x axis",
            Both::names(&names)
        );
        let help = both!(
            "coordinates in \"points\", or a length and the driver's \"angle\", say otherwise"
        );
        faults.push(
            Diagnostic::note("free-centre", message).at(c.names.points[laid[0].0].span).help(help),
        );
    }
}

/// Places the centre `to` of a pair beside `from`, if `to` is free and `from` is placed. For an arm
/// with a given angle it adds only the length.
fn lay(
    c: &Context,
    (rolling, pair, drivers): (&mut rolling::Resolved, usize, &[Driver]),
    (from, to): (PointId, PointId),
    places: &mut [PointPlace],
    lengths: &[Length],
    laid: &mut Vec<PointId>,
) {
    let Some(arm) = c.common(from, to) else { return };
    let anchored = laid.contains(&from) || c.carries(c.ground, from) && anchor(c, from, places);
    if !anchored || !is_free(c, (arm, &*rolling, &*laid), (from, to), places, lengths) {
        return;
    }
    // A further centre of an arm that meshes with two others is placed by its distances from both.
    let placed = |q: &PointId| {
        c.carries(arm, *q) && (laid.contains(q) || matches!(places[q.0], PointPlace::At(_)))
    };
    if on_arm(c, arm).any(|p| laid.contains(&p))
        && neighbours(rolling, to).filter(placed).nth(1).is_some()
    {
        let given = |p: PointId, rolled: &[Length]| {
            lengths.iter().chain(rolled).any(|l| (l.a, l.b) == (p, to) || (l.b, l.a) == (p, to))
        };
        if !given(from, &rolling.lengths)
            && let Some(value) = by_teeth(c, rolling, pair)
        {
            rolling.lengths.push(Length { a: from, b: to, value });
        }
        return;
    }
    let between = |l: &Length| (l.a, l.b) == (from, to) || (l.b, l.a) == (from, to);
    let given =
        lengths.iter().chain(&rolling.lengths).find(|l| between(l)).map(|l| l.value.clone());
    let has_length = given.is_some();
    let Some(distance) = given.or_else(|| by_teeth(c, rolling, pair)) else { return };
    let turned = |d: &Driver| {
        d.kind.angle().is_some() && d.kind.turned().is_some_and(|(link, _)| link == arm)
    };
    if drivers.iter().any(turned) {
        if !has_length {
            rolling.lengths.push(Length { a: from, b: to, value: distance });
        }
        return;
    }
    let PointPlace::At([x, y]) = &places[from.0] else { return };
    let (x, y) = (x.clone(), y.clone());
    // A bare 0 has no dimension, so that no length can be added to it.
    let bare = x.text.trim().parse::<f64>().is_ok();
    let text = if bare {
        distance.text.clone()
    } else {
        summed(&x.text, &distance.text, laid.contains(&from))
    };
    let Some(x) = c.values.si(
        &RawQuantity { text, span: distance.span, bare: false },
        RequiredQuantity::Length,
        &mut Faults::default(),
    ) else {
        return;
    };
    places[to.0] = PointPlace::At([x, y]);
    // The coordinates replace this length.
    rolling.lengths.retain(|l| !between(l));
    laid.push(to);
}

/// Returns true if a fixed axis has a place. If no axis has one, the first is placed at the origin.
fn anchor(c: &Context, p: PointId, places: &mut [PointPlace]) -> bool {
    match places[p.0] {
        PointPlace::At(_) => true,
        PointPlace::InLink { .. } | PointPlace::Polar { .. } => false,
        PointPlace::Unknown => {
            let first = places.iter().all(|p| matches!(p, PointPlace::Unknown));
            if first {
                let span = c.names.points[p.0].span;
                places[p.0] = PointPlace::At([zero(span), zero(span)]);
            }
            first
        }
    }
}

/// Returns true if only the gear pairs place a centre: the arm or the ground carries it, and all
/// other links on it are plain wheels about it.
fn is_free(
    c: &Context,
    (arm, rolling, laid): (LinkId, &rolling::Resolved, &[PointId]),
    (from, to): (PointId, PointId),
    places: &[PointPlace],
    lengths: &[Length],
) -> bool {
    let unplaced = matches!(places[to.0], PointPlace::Unknown)
        && !c.raw.points.iter().any(|(w, _)| w.text == c.point_name(to));
    // True if an arm carries only centres of the train.
    let centre = |p: PointId| neighbours(rolling, p).next().is_some();
    let only_arm = arm == c.ground || on_arm(c, arm).all(centre);
    let wheels = (0..c.names.links.len())
        .map(LinkId)
        .filter(|l| *l != arm && c.carries(*l, to))
        // Another arm about it that carries only centres is as free as they are.
        .all(|l| l != c.ground && on_arm(c, l).all(|p| p == to || centre(p)) && !guided(c, l));
    // A length from the first centre of an arm to the next ones does not fix it, because the arm's
    // direction is free.
    let first = arm != c.ground && !on_arm(c, arm).any(|p| laid.contains(&p));
    let inner = |l: &Length| first && c.carries(arm, l.a) && c.carries(arm, l.b);
    let measured =
        lengths.iter().any(|l| (l.a == to || l.b == to) && l.a != from && l.b != from && !inner(l));
    let named = |w: &Word| w.text == c.point_name(to);
    let told =
        c.raw.sketch.iter().any(|(w, _)| named(w)) || c.raw.sides.iter().any(|(w, _)| named(w));
    let runs = c.raw.guides.iter().any(|g| g.pin.as_ref().is_some_and(named))
        || (arm != c.ground && guided(c, arm));
    let rammed = c.raw.drivers.iter().any(|d| match &d.kind {
        RawDriverKind::Cylinder { ends, .. } => {
            c.names.pair(ends).is_ok_and(|(a, b)| a == to || b == to)
        }
        RawDriverKind::Turn { .. } | RawDriverKind::Slide { .. } => false,
    });
    unplaced && only_arm && wheels && !measured && !told && !runs && !rammed
}

/// Returns the points of a link.
fn on_arm<'a>(c: &'a Context, arm: LinkId) -> impl Iterator<Item = PointId> + 'a {
    c.names.links[arm.0].points.iter().copied()
}

/// Returns the centres of the gears in mesh with those about `centre`.
fn neighbours(rolling: &rolling::Resolved, centre: PointId) -> impl Iterator<Item = PointId> + '_ {
    let found: std::collections::BTreeSet<usize> = rolling
        .rolling
        .iter()
        .filter_map(|r| match r.round()? {
            [a, b] if a == centre => Some(b.0),
            [a, b] if b == centre => Some(a.0),
            _ => None,
        })
        .collect();
    found.into_iter().map(PointId)
}

/// Returns true if a link carries a guide or slides in one.
fn guided(c: &Context, link: LinkId) -> bool {
    c.raw
        .guides
        .iter()
        .any(|g| [&g.on, &g.slider].into_iter().flatten().any(|w| w.text == c.link_name(link)))
}

/// Returns the text of a coordinate plus a length. Expressions are limited in depth and length, so
/// lengths of [`by_teeth`] are added as numbers, and the sum of a placed centre continues without
/// further parentheses.
fn summed(x: &str, distance: &str, is_sum: bool) -> String {
    let tenths = |text: &str| {
        let (whole, tenth) = text.strip_suffix(" mm")?.split_once('.')?;
        let digits = |t: &str| t.bytes().all(|b| b.is_ascii_digit());
        (digits(whole) && digits(tenth) && tenth.len() == 1)
            .then(|| format!("{whole}{tenth}").parse::<u64>().ok())?
    };
    match (tenths(x).zip(tenths(distance)).and_then(|(a, b)| a.checked_add(b)), is_sum) {
        (Some(sum), _) => format!("{}.{} mm", sum / 10, sum % 10),
        (None, true) => format!("{x}+({distance})"),
        (None, false) => format!("({x})+({distance})"),
    }
}

/// Returns the distance of the centres of two gears of 1 mm module; for two pulleys, whose distance
/// is free, twice the sum of the radii.
fn by_teeth(c: &Context, rolling: &rolling::Resolved, pair: usize) -> Option<GivenQuantity> {
    let text = match &rolling.rolling[pair].contours {
        Contours::Circles { sizes: Sizes::Teeth([a, b]), hollow, .. } => {
            let halves = if hollow.is_some() { a.abs_diff(*b) } else { a + b };
            format!("{}.{} mm", halves / 2, if halves % 2 == 0 { 0 } else { 5 })
        }
        Contours::Belt { radii: [a, b], .. } => format!("2*(({})+({}))", a.text, b.text),
        Contours::Circles { sizes: Sizes::Radii(_), .. } | Contours::Track { .. } => return None,
    };
    let span = rolling.rolling[pair].span;
    c.values.si(
        &RawQuantity { text, span, bare: false },
        RequiredQuantity::Length,
        &mut Faults::default(),
    )
}
