//! The section `guides`: sliding pairs.

use super::*;

/// A guide with its index in the file: faulty guides are dropped, and a driver may name one of
/// them.
pub(super) type Numbered = (Guide, usize);

pub(super) fn guides(c: &Context, places: &[PointPlace], faults: &mut Faults) -> Vec<Numbered> {
    let mut out: Vec<Numbered> = Vec::with_capacity(c.raw.guides.len());
    for (i, raw) in c.raw.guides.iter().enumerate() {
        let Some(guide) = guide(c, raw, places, faults) else { continue };
        if out.iter().any(|(g, _)| {
            (g.pin, g.slider, g.on) == (guide.pin, guide.slider, guide.on) && guide.slider.is_some()
        }) {
            let message = both!("this slider already slides on link `{}`", c.link_name(guide.on));
            faults.push(
                Diagnostic::error("given-twice", message)
                    .at(raw.span)
                    .help(both!("one guide joins two links; a second one would stop them")),
            );
            continue;
        }
        out.push((guide, i));
    }
    out
}

fn guide(c: &Context, raw: &RawGuide, places: &[PointPlace], faults: &mut Faults) -> Option<Guide> {
    if raw.pin.is_none() && raw.slider.is_none() {
        let d = Diagnostic::error(
            "missing-key",
            both!("a guide has neither `pin` nor `slider`, so nothing runs in it"),
        )
        .at(raw.span);
        faults
            .push(d.help(both!("name the running \"pin\", the sliding link \"slider\", or both")));
        return None;
    }
    let on = match &raw.on {
        Some(word) => note(c.names.link(word), faults),
        None => Some(c.ground),
    };
    let pin = raw.pin.as_ref().map(|word| note(c.names.point(word), faults));
    let slider = raw.slider.as_ref().map(|word| note(c.names.link(word), faults));
    let (on, pin, slider) = (on?, transpose(pin)?, transpose(slider)?);
    let mut sound = true;
    let mut fault = |d: Diagnostic, faults: &mut Faults| {
        sound = false;
        faults.push(d);
    };
    if slider == Some(on) {
        let message = both!("link `{}` cannot slide on itself", c.link_name(on));
        fault(
            Diagnostic::error("guide", message)
                .at(raw.span)
                .help(both!("name another link in \"on\"")),
            faults,
        );
    }
    if let (Some(pin), Some(slider), Some(word)) = (pin, slider, &raw.pin)
        && !c.carries(slider, pin)
    {
        let message =
            both!("pin `{}` is not on slider `{}`", c.point_name(pin), c.link_name(slider));
        fault(
            Diagnostic::error("not-on-link", message).at(word.span).help(c.points_of(slider)),
            faults,
        );
    }
    if let (Some(pin), Some(word)) = (pin, &raw.pin)
        && c.carries(on, pin)
    {
        let message = both!(
            "pin `{}` is a point of link `{}`, which carries the guide: it cannot run in it",
            c.point_name(pin),
            c.link_name(on)
        );
        let d = Diagnostic::error("guide", message).at(word.span);
        fault(
            d.help(both!("the pin belongs to the link that runs, the guide to the link in \"on\"")),
            faults,
        );
    }
    let path = match &raw.centre {
        Some(centre) => arc(c, raw, on, centre, faults),
        None => line(c, raw, on, pin, places, faults),
    };
    let length = raw.length.as_ref().map(|q| {
        if slider.is_none() || raw.centre.is_some() {
            let message = both!("`length` is that of a slider in a straight guide");
            fault(
                Diagnostic::error("guide", message).at(q.span).help(both!("leave \"length\" away")),
                faults,
            );
        }
        c.values.positive_length(q, both!("the length"), faults)
    });
    let mut guide = Guide {
        pin,
        slider,
        on,
        path: path?,
        length: transpose(length)?,
        rolling: None,
        span: raw.span,
    };
    if !raw.contact {
        run_by_a_joint(c, &mut guide, places);
    }
    sound.then_some(guide)
}

/// Gives a slider without a pin one of its joints as a pin, so that the pair equals one written
/// with its pin. A slider keeps its distance from its guide, and so does every parallel to the
/// guide through a joint. A joint with coordinates gets the parallel through it; another joint is
/// on the guide as written.
fn run_by_a_joint(c: &Context, guide: &mut Guide, places: &[PointPlace]) {
    let (None, Some(slider), GuidePath::Line { through, offset, .. }) =
        (guide.pin, guide.slider, &mut guide.path)
    else {
        return;
    };
    let joins = |p: PointId, l: usize| l != slider.0 && c.names.links[l].points.contains(&p);
    let is_joint =
        |p: &PointId| !c.carries(guide.on, *p) && (0..c.names.links.len()).any(|l| joins(*p, l));
    let joints: Vec<PointId> =
        c.names.links[slider.0].points.iter().copied().filter(is_joint).collect();
    if let Some(placed) = joints.iter().find(|p| matches!(places[p.0], PointPlace::At(_))) {
        (guide.pin, *through, *offset) = (Some(*placed), Through::Pin, None);
    } else if let [only] = joints[..]
        && *through != Through::Pin
    {
        guide.pin = Some(only);
    }
}

fn arc(
    c: &Context,
    raw: &RawGuide,
    on: LinkId,
    word: &Word,
    faults: &mut Faults,
) -> Option<GuidePath> {
    let radius = match &raw.radius {
        Some(quantity) => Some(c.values.positive_length(quantity, both!("the radius"), faults)?),
        None => None,
    };
    let straight = [
        ("line", raw.line.is_some()),
        ("through", raw.through.is_some()),
        ("angle", raw.angle.is_some()),
        ("offset", raw.offset.is_some()),
    ];
    if let Some((key, _)) = straight.iter().find(|(_, given)| *given) {
        let d = Diagnostic::error(
            "guide",
            both!("a guide about a `centre` is curved and has no `{key}`"),
        )
        .at(raw.span);
        faults.push(d.help(both!("leave \"{key}\" or \"centre\" away")));
        return None;
    }
    let centre = c.centre_on(word, on, both!("which carries the guide"), faults)?;
    if raw.pin.is_none() {
        let d = Diagnostic::error("missing-key", both!("a curved guide has no `pin`")).at(raw.span);
        faults.push(d.help(both!("name the point that runs in it: \"pin\"")));
        return None;
    }
    Some(GuidePath::Arc { centre, radius })
}

fn line(
    c: &Context,
    raw: &RawGuide,
    on: LinkId,
    pin: Option<PointId>,
    places: &[PointPlace],
    faults: &mut Faults,
) -> Option<GuidePath> {
    if let Some(radius) = &raw.radius {
        let d = Diagnostic::error("missing-key", both!("a guide with a `radius` has no `centre`"))
            .at(radius.span);
        faults.push(d.help(both!("add \"centre\", a point of link `{}`", c.link_name(on))));
        return None;
    }
    let ends = raw.line.as_ref().map(|word| note(c.line_on(word, on), faults));
    let angle = raw.angle.as_ref().map(|q| c.values.angle(q, faults));
    let offset = raw.offset.as_ref().map(|q| c.values.si(q, RequiredQuantity::Length, faults));
    let through = raw.through.as_ref().map(|t| through(c, on, t, faults));
    let (ends, angle, offset, through) =
        (transpose(ends)?, transpose(angle)?, transpose(offset)?, transpose(through)?);
    let direction = match (ends, angle) {
        (Some((a, b)), turned) => GuideDirection::Along(a, b, turned),
        (None, Some(angle)) if raw.slid => GuideDirection::Slid(angle),
        (None, Some(angle)) => GuideDirection::Instant(angle),
        // For a mobility count, the direction has no effect.
        (None, None) if c.raw.extent.is_of_pairs() => GuideDirection::Instant(GivenQuantity {
            value: Angle::Deg(0.0),
            radius: 0.0,
            text: "0 deg".into(),
            span: raw.span,
        }),
        (None, None) => own(c, raw, on, pin, &through, places, faults)?,
    };
    let through = through.unwrap_or(match &direction {
        GuideDirection::Along(a, ..) => Through::Point(*a),
        GuideDirection::Instant(_) | GuideDirection::Own | GuideDirection::Slid(_) => Through::Pin,
    });
    Some(GuidePath::Line { through, direction, offset })
}

pub(super) fn through(
    c: &Context,
    on: LinkId,
    raw: &RawThrough,
    faults: &mut Faults,
) -> Option<Through> {
    match raw {
        RawThrough::At(xy, span) => {
            let xy = c.values.two_lengths(xy, faults);
            if on != c.ground {
                let d = Diagnostic::error(
                    "guide",
                    both!(
                        "a guide on the moving link `{}` cannot pass through coordinates",
                        c.link_name(on)
                    ),
                );
                faults.push(d.at(*span).help(both!("name a point: {}", c.points_of(on))));
                return None;
            }
            xy.map(Through::At)
        }
        RawThrough::Point(word) => {
            let point = note(c.names.point(word), faults)?;
            if !c.carries(on, point) {
                let message = both!(
                    "the guide passes through `{}`, which is not on link `{}`",
                    word.text,
                    c.link_name(on)
                );
                faults.push(
                    Diagnostic::error("not-on-link", message).at(word.span).help(c.points_of(on)),
                );
                return None;
            }
            Some(Through::Point(point))
        }
    }
}

/// Resolves a guide without a direction, which orients its link: a lever known by its pivot and its
/// slot only.
fn own(
    c: &Context,
    raw: &RawGuide,
    on: LinkId,
    pin: Option<PointId>,
    through: &Option<Through>,
    places: &[PointPlace],
    faults: &mut Faults,
) -> Option<GuideDirection> {
    let mut fault = |message: Both, help: Both| {
        faults.push(Diagnostic::error("no-direction", message).at(raw.span).help(help));
        None
    };
    if on == c.ground {
        return fault(
            both!("a guide on the ground has no direction"),
            both!(
                "add \"angle\": \"0 deg\" (from the x axis) or \"line\", two points of the ground"
            ),
        );
    }
    let (Some(Through::Point(point)), Some(pin)) = (through, pin) else {
        return fault(
            both!("the guide on link `{}` has no direction", c.link_name(on)),
            both!(
                "add \"line\", two points of that link, or \"angle\", or the point that it passes \"through\""
            ),
        );
    };
    let at = |p: PointId| matches!(places[p.0], PointPlace::At(_));
    if c.names.links[on.0].points.len() > 1 && !(at(*point) && at(pin)) {
        let message = both!(
            "link `{}` has further points, so its guide through `{}` needs a direction",
            c.link_name(on),
            c.point_name(*point)
        );
        return fault(
            message,
            both!(
                "add \"line\", two points of that link, and \"angle\" where the guide is turned from it"
            ),
        );
    }
    Some(GuideDirection::Own)
}
