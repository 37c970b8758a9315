//! The sections `points`, `sketch` and `side`, and the rules for ground pivots without coordinates.

use super::lengths::same;
use super::*;

/// Returns the place of every point, in the order of the points.
pub(super) fn places(
    c: &Context,
    ground: Option<LinkId>,
    lengths: &[Length],
    faults: &mut Faults,
) -> Vec<PointPlace> {
    let mut places = vec![PointPlace::Unknown; c.names.points.len()];
    for (word, raw) in &c.raw.points {
        let point = note(c.names.point(word), faults);
        let place = place(c, point, raw, faults);
        if let (Some(point), Some(place)) = (point, place) {
            places[point.0] = place;
        }
    }
    circular(c, &mut places, faults);
    if let Some(ground) = ground {
        pivots(c, ground, lengths, &mut places);
    }
    contradictions(c, lengths, &places, faults);
    places
}

fn place(
    c: &Context,
    point: Option<PointId>,
    raw: &RawPlace,
    faults: &mut Faults,
) -> Option<PointPlace> {
    match raw {
        RawPlace::At(xy) => c.values.two_lengths(xy, faults).map(PointPlace::At),
        RawPlace::InLink { base, xy } => {
            let base = self_or_base(c, point, base, faults);
            let xy = c.values.two_lengths(xy, faults);
            Some(PointPlace::InLink { base: base?, xy: xy? })
        }
        RawPlace::Polar { base, length, angle } => {
            let base = self_or_base(c, point, base, faults);
            let length = c.values.positive_length(length, both!("the length"), faults);
            let angle = c.values.angle(angle, faults);
            Some(PointPlace::Polar { base: base?, length: length?, angle: angle? })
        }
    }
}

/// Returns the base of a place in a link: two other points of a link that also carries the point.
fn self_or_base(
    c: &Context,
    point: Option<PointId>,
    word: &Word,
    faults: &mut Faults,
) -> Option<(PointId, PointId)> {
    let (a, b) = note(c.names.pair(word), faults)?;
    let point = point?;
    if point == a || point == b {
        let d = Diagnostic::error(
            "same-point",
            both!("`{}` cannot be its own base", c.point_name(point)),
        )
        .at(word.span);
        faults.push(d.help(both!("name two other points of its link")));
        return None;
    }
    let link = (0..c.names.links.len())
        .map(LinkId)
        .find(|l| [a, b, point].iter().all(|p| c.carries(*l, *p)));
    if link.is_none() {
        let message = both!(
            "no link has all of `{}`, `{}` and `{}`",
            c.point_name(a),
            c.point_name(b),
            c.point_name(point)
        );
        faults.push(Diagnostic::error("not-on-link", message).at(word.span));
        return None;
    }
    Some((a, b))
}

/// Reports places with circular bases: D by the base AC and C by the base AD.
fn circular(c: &Context, places: &mut [PointPlace], faults: &mut Faults) {
    // 0: not seen, 1: on the path, 2: done.
    let mut state = vec![0u8; places.len()];
    for start in 0..places.len() {
        // An explicit stack: a chain of bases can be as long as the list of points.
        let mut stack = vec![(start, false)];
        while let Some((p, leaving)) = stack.pop() {
            if leaving {
                state[p] = 2;
                continue;
            }
            if state[p] == 2 {
                continue;
            }
            if state[p] == 1 {
                let span = c.names.points[p].span;
                let span = c
                    .raw
                    .points
                    .iter()
                    .find(|(w, _)| w.text == c.names.points[p].name)
                    .map_or(span, |(w, _)| w.span);
                let message =
                    both!("the place of `{}` is given by way of itself", c.point_name(PointId(p)));
                faults.push(
                    Diagnostic::error("circular", message)
                        .at(span)
                        .help(both!("take a base of points that are known without it")),
                );
                // Each circle is reported once; without this place it is open.
                places[p] = PointPlace::Unknown;
                state[p] = 2;
                continue;
            }
            state[p] = 1;
            stack.push((p, true));
            if let PointPlace::InLink { base, .. } | PointPlace::Polar { base, .. } = &places[p] {
                stack.push((base.0.0, false));
                stack.push((base.1.0, false));
            }
        }
    }
}

/// Places ground pivots without coordinates: two with a length between them on the x axis, the
/// first at the origin; a single one at the origin. If any point has coordinates, they already
/// define the coordinate system.
pub(super) fn pivots(c: &Context, ground: LinkId, lengths: &[Length], places: &mut [PointPlace]) {
    if places.iter().any(|p| matches!(p, PointPlace::At(_))) {
        return;
    }
    let pivots = &c.names.links[ground.0].points;
    let span = c.raw.ground.as_ref().map_or(c.names.links[ground.0].span, |w| w.span);
    if let [only] = pivots.as_slice() {
        places[only.0] = PointPlace::At([zero(span), zero(span)]);
        return;
    }
    for (i, &first) in pivots.iter().enumerate() {
        for &second in &pivots[i + 1..] {
            let between = lengths
                .iter()
                .find(|l| (l.a, l.b) == (first, second) || (l.b, l.a) == (first, second));
            let free = [first, second].iter().all(|p| matches!(places[p.0], PointPlace::Unknown));
            if let (Some(length), true) = (between, free) {
                places[first.0] =
                    PointPlace::At([zero(length.value.span), zero(length.value.span)]);
                places[second.0] = PointPlace::At([length.value.clone(), zero(length.value.span)]);
                return;
            }
        }
    }
}

/// Reports lengths that contradict the places of their ends.
fn contradictions(c: &Context, lengths: &[Length], places: &[PointPlace], faults: &mut Faults) {
    for length in lengths {
        let distance = match (&places[length.a.0], &places[length.b.0]) {
            (PointPlace::At(p), PointPlace::At(q)) => {
                libm::hypot(q[0].value - p[0].value, q[1].value - p[1].value)
            }
            (PointPlace::InLink { base, xy }, _) if base.0 == length.b => {
                libm::hypot(xy[0].value, xy[1].value)
            }
            (_, PointPlace::InLink { base, xy }) if base.0 == length.a => {
                libm::hypot(xy[0].value, xy[1].value)
            }
            (PointPlace::Polar { base, length: l, .. }, _) if base.0 == length.b => l.value,
            (_, PointPlace::Polar { base, length: l, .. }) if base.0 == length.a => l.value,
            _ => continue,
        };
        if !same(distance, length.value.value) {
            let (a, b) = (c.point_name(length.a), c.point_name(length.b));
            let unit = super::lengths::unit(c);
            let apart = short(distance * unit.denominator / unit.numerator);
            let message = both!(
                "{a} and {b} lie {apart} {} apart by their coordinates, but {} is given",
                unit.name,
                length.value.text
            );
            let d = Diagnostic::error("contradiction", message).at(length.value.span);
            faults.push(d.help(both!("leave the length or the coordinates away")));
        }
    }
}

/// Rounds a number to six digits for a message.
fn short(x: f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(x)
}

/// Returns the rough coordinates of every point.
pub(super) fn sketch(c: &Context, faults: &mut Faults) -> Vec<Option<[f64; 2]>> {
    let mut out = vec![None; c.names.points.len()];
    for (word, xy) in &c.raw.sketch {
        let point = note(c.names.point(word), faults);
        // A sketch is rough: its bare numbers need no unit.
        let rough = |q: &RawQuantity| match (q.bare, c.values.has_unit(RequiredQuantity::Length)) {
            (true, false) => RawQuantity {
                text: format!(
                    "{} {}",
                    q.text,
                    super::lengths::unit_shown(c).map_or("m", |u| u.name)
                ),
                ..q.clone()
            },
            _ => q.clone(),
        };
        let xy = c.values.two_lengths(&[rough(&xy[0]), rough(&xy[1])], faults);
        if let (Some(point), Some([x, y])) = (point, xy) {
            out[point.0] = Some([x.value, y.value]);
        }
    }
    out
}

/// Resolves sides: `"C": "left of BD"`.
pub(super) fn sides(c: &Context, faults: &mut Faults) -> Vec<Side> {
    let mut out = Vec::new();
    for (word, said) in &c.raw.sides {
        let point = note(c.names.point(word), faults);
        let text = said.text.trim();
        let parts = ["left", "right"].into_iter().find_map(|side| {
            let line = text.strip_prefix(side)?.trim_start().strip_prefix("of ")?;
            Some((side == "left", line.trim()))
        });
        let Some((left, line)) = parts else {
            let d = Diagnostic::error("side", both!("`{text}` does not say a side")).at(said.span);
            faults.push(d.help(both!(
                "write \"left of BD\" or \"right of BD\", as seen looking from B to D"
            )));
            continue;
        };
        let (Some((from, to)), Some(point)) = (note(c.names.pair_in(line, said), faults), point)
        else {
            continue;
        };
        if point == from || point == to {
            let d = Diagnostic::error(
                "side",
                both!("`{}` lies on the line `{line}` itself", word.text),
            )
            .at(said.span);
            faults.push(d.help(both!("name a line through two other points")));
            continue;
        }
        out.push(Side { point, left, from, to, span: said.span });
    }
    out
}
