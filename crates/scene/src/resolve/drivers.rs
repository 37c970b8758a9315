//! The section `driver`.

use super::super::rolling::RollingKind;
use super::guides::Numbered;
use super::*;

pub(super) fn drivers(
    c: &Context,
    guides: &[Numbered],
    rolling: &rolling::Resolved,
    faults: &mut Faults,
) -> Vec<Driver> {
    let mut out: Vec<Driver> = Vec::new();
    for raw in &c.raw.drivers {
        let (rate, acceleration) = match raw.kind {
            RawDriverKind::Turn { .. } => (RequiredQuantity::Omega, RequiredQuantity::Alpha),
            RawDriverKind::Slide { .. } | RawDriverKind::Cylinder { .. } => {
                (RequiredQuantity::Velocity, RequiredQuantity::Acceleration)
            }
        };
        let kind = match &raw.kind {
            RawDriverKind::Turn { link, against, line, against_line, angle } => {
                turn(c, raw, guides, (link, against), [line, against_line], angle, faults)
            }
            RawDriverKind::Slide { slide, position } => {
                self::slide(c, (guides, rolling), slide, position, faults)
            }
            RawDriverKind::Cylinder { ends, length, links } => {
                cylinder(c, ends, length, links, faults)
            }
        };
        // A fault in a law is reported once, for the position.
        if raw.law.is_some() && kind.is_none() {
            continue;
        }
        let rate = match &raw.rate {
            Some(q) => c.values.si(q, rate, faults),
            None => c.raw.extent.is_at_rest().then(|| assumed_rate(raw, rate, c.raw.extent.rate())),
        };
        let acceleration = match &raw.acceleration {
            Some(q) => c.values.si(q, acceleration, faults).map(Some),
            None => Some(None),
        };
        let (Some(kind), Some(rate), Some(acceleration)) = (kind, rate, acceleration) else {
            continue;
        };
        if out.iter().any(|d| same_motion(&d.kind, &kind)) {
            let d = Diagnostic::error(
                "given-twice",
                both!("this motion is already given by another driver"),
            )
            .at(raw.span);
            faults.push(d.help(both!("keep one of the two")));
            continue;
        }
        out.push(Driver {
            kind,
            rate,
            acceleration,
            rate_told: raw.rate.is_some(),
            law: raw.law.clone(),
            span: raw.span,
        });
    }
    out
}

/// Returns the rate of a driver without one.
fn assumed_rate(raw: &RawDriver, rate: RequiredQuantity, value: f64) -> GivenQuantity {
    let unit = if rate == RequiredQuantity::Omega { "rad/s" } else { "m/s" };
    GivenQuantity { value, radius: 0.0, text: format!("{value} {unit}"), span: raw.span }
}

fn same_motion(a: &DriverKind, b: &DriverKind) -> bool {
    match (a, b) {
        (DriverKind::Turn { link, against, .. }, DriverKind::Turn { link: l, against: g, .. }) => {
            (link, against) == (l, g) || (link, against) == (g, l)
        }
        (DriverKind::Slide { guide: g, .. }, DriverKind::Slide { guide: h, .. }) => g == h,
        (DriverKind::Cylinder { a, b, .. }, DriverKind::Cylinder { a: p, b: q, .. }) => {
            (a, b) == (p, q) || (a, b) == (q, p)
        }
        _ => false,
    }
}

fn turn(
    c: &Context,
    raw: &RawDriver,
    guides: &[Numbered],
    (link, against): (&Word, &Option<Word>),
    lines: [&Option<Word>; 2],
    angle: &Option<RawQuantity>,
    faults: &mut Faults,
) -> Option<DriverKind> {
    let link = note(c.names.link(link), faults);
    let against = match against {
        Some(word) => note(c.names.link(word), faults),
        None => Some(c.ground),
    };
    // A wheel with another number of teeth does not return to its place after one turn of the
    // driver, so all whole turns count.
    let rolling = !c.raw.rolling.is_empty();
    let angle = match angle {
        Some(q) if rolling => Some(c.values.angle_in_full(q, faults)?),
        Some(q) => Some(c.values.angle(q, faults)?),
        None => None,
    };
    if let Some(angle) =
        angle.as_ref().filter(|a| rolling && a.value.degrees().abs() > MOST_DEGREES)
    {
        let message = both!(
            "the driver's angle {} is beyond 2⁵³ degrees, where double precision does not tell the places of wheels that roll",
            angle.text
        );
        let d = Diagnostic::error("out-of-range", message).at(angle.span);
        faults.push(d.help(both!("take off whole turns after which all wheels stand as before")));
        return None;
    }
    let (link, against) = (link?, against?);
    if link == against {
        let name = c.link_name(link);
        let d = if link == c.ground {
            Diagnostic::error("driver", both!("link `{name}` is the ground: it cannot be driven"))
                .help(both!("drive a moving link"))
        } else {
            Diagnostic::error("driver", both!("link `{name}` cannot turn against itself"))
                .help(both!("name another link in \"against\""))
        };
        faults.push(d.at(raw.span));
        return None;
    }
    let mut on = |word: &Option<Word>, link: LinkId| match word {
        Some(word) => note(c.line_on(word, link), faults).map(Some),
        None => Some(None),
    };
    let (line, against_line) = (on(lines[0], link)?, on(lines[1], against)?);
    // A link oriented by its guide has an angle without two points; a wheel's angle is measured by
    // a mark on it.
    let has_direction = |l: LinkId, line: Option<(PointId, PointId)>| {
        line.is_some()
            || c.rolls(l)
            || c.names.links[l.0].points.len() > 1
            || c.raw
                .guides
                .iter()
                .any(|g| [&g.on, &g.slider].into_iter().flatten().any(|w| w.text == c.link_name(l)))
    };
    if angle.is_some() {
        for (l, line) in [(link, line), (against, against_line)] {
            if (l != c.ground) && !has_direction(l, line) {
                let message =
                    both!("link `{}` has no line whose angle could be given", c.link_name(l));
                faults.push(Diagnostic::error("driver", message).at(raw.span).help(c.points_of(l)));
                return None;
            }
        }
    }
    let angle = if against == c.ground && line.is_none() && against_line.is_none() {
        guided(c, link, guides, angle, faults)?
    } else {
        angle
    };
    Some(DriverKind::Turn { link, against, line, against_line, angle })
}

/// Returns the angle of a driven link with one point and a guide. The angle is that of the guide:
/// if the guide gives it, the driver may omit it and must not give another.
fn guided(
    c: &Context,
    link: LinkId,
    guides: &[Numbered],
    angle: Option<GivenQuantity<Angle>>,
    faults: &mut Faults,
) -> Option<Option<GivenQuantity<Angle>>> {
    // For a mobility count, a guide without a direction has an arbitrary one.
    let stated =
        guides.iter().filter(|_| !c.raw.extent.is_of_pairs()).find_map(|(g, _)| match &g.path {
            GuidePath::Line { direction: GuideDirection::Instant(angle), .. } if g.on == link => {
                Some(angle)
            }
            GuidePath::Line { .. } | GuidePath::Arc { .. } => None,
        });
    let Some(stated) = stated.filter(|_| c.names.links[link.0].points.len() < 2) else {
        return Some(angle);
    };
    let Some(given) = angle else { return Some(Some(stated.clone())) };
    let (s, k) = libm::sincos(given.value.radians() - stated.value.radians());
    if s.abs() + (1.0 - k) <= ONE_ANGLE {
        return Some(Some(given));
    }
    let name = c.link_name(link);
    let message = both!(
        "the driver puts link `{name}` at {}, but its guide, which is its direction, is at {}",
        given.text,
        stated.text
    );
    let d = Diagnostic::error("contradictory-angle", message).at(given.span);
    faults.push(d.help(both!("leave one of the two angles out")));
    None
}

/// Largest angle of a driver in degrees: beyond 2⁵³, `f64` does not represent all whole degrees.
const MOST_DEGREES: f64 = 9_007_199_254_740_992.0;

/// Tolerance for two texts of the same angle, which may be rounded to nine digits.
const ONE_ANGLE: f64 = 1e-9;

fn slide(
    c: &Context,
    (guides, rolling): (&[Numbered], &rolling::Resolved),
    word: &Word,
    position: &Option<RawQuantity>,
    faults: &mut Faults,
) -> Option<DriverKind> {
    let position = match position {
        Some(q) => Some(c.values.si(q, RequiredQuantity::Length, faults)?),
        None => None,
    };
    let named = |w: &Option<Word>| w.as_ref().is_some_and(|w| w.text == word.text);
    let mut meant: Vec<usize> = (0..c.raw.guides.len())
        .filter(|i| named(&c.raw.guides[*i].pin) || named(&c.raw.guides[*i].slider))
        .collect();
    // The centre of a cam's circle, or a roller, also runs in the guide that replaces the contact;
    // the driver refers to its own guide.
    if meant.iter().any(|i| !c.raw.guides[*i].contact) {
        meant.retain(|i| !c.raw.guides[*i].contact);
    }
    match meant.as_slice() {
        // A guide dropped for its own fault is not reported as missing here.
        [one] => guides
            .iter()
            .position(|(_, i)| i == one)
            .map(|i| DriverKind::Slide { guide: GuideId(i), position }),
        [] => {
            // The centre of a wheel runs along its track.
            let wheel = |g: &Guide| {
                g.pin.is_some_and(|p| c.point_name(p) == word.text)
                    && g.rolling
                        .and_then(|r| rolling.rolling.get(r.0))
                        .is_some_and(|r| r.kind == RollingKind::Wheel)
            };
            if let Some(i) = rolling.guides.iter().position(wheel) {
                return Some(DriverKind::Slide { guide: GuideId(guides.len() + i), position });
            }
            let wheels = c
                .raw
                .rolling
                .iter()
                .filter(|p| p.kind == RollingKind::Wheel)
                .filter_map(|p| p.sides[1].centre.as_ref());
            // A wheel dropped for its own fault is not reported as missing here.
            if wheels.clone().any(|centre| centre.text == word.text) {
                return None;
            }
            let runners = c
                .raw
                .guides
                .iter()
                .flat_map(|g| [&g.pin, &g.slider])
                .flatten()
                .chain(wheels)
                .map(|w| w.text.as_str());
            let nothing = runners.clone().next().is_none();
            let d =
                Diagnostic::error("driver", both!("no guide has a pin or slider `{}`", word.text))
                    .at(word.span);
            faults.push(if nothing {
                d.help(both!("add \"guides\""))
            } else {
                d.help(suggest(&word.text, runners, both!("there are")))
            });
            None
        }
        _ => {
            let d = Diagnostic::error(
                "ambiguous",
                both!("`{}` runs in {} guides", word.text, meant.len()),
            )
            .at(word.span);
            let runners = |i: usize| {
                [&c.raw.guides[i].pin, &c.raw.guides[i].slider]
                    .into_iter()
                    .flatten()
                    .map(|w| w.text.as_str())
            };
            let alone = |name: &str| {
                (0..c.raw.guides.len()).filter(|i| runners(*i).any(|n| n == name)).count() == 1
            };
            let names: Vec<String> = meant
                .iter()
                .flat_map(|i| runners(*i))
                .filter(|n| alone(n))
                .map(|n| format!("\"{n}\""))
                .collect();
            faults.push(d.help(match names.as_slice() {
                [] => both!("name the sliders of these guides"),
                _ => both!("name what runs in one of them only: {}", Both::names(&names)),
            }));
            None
        }
    }
}

fn cylinder(
    c: &Context,
    ends: &Word,
    length: &Option<RawQuantity>,
    links: &[Word],
    faults: &mut Faults,
) -> Option<DriverKind> {
    let length = match length {
        Some(q) => {
            Some(c.values.positive_length(q, both!("the length of the cylinder"), faults)?)
        }
        None => None,
    };
    let (a, b) = note(c.names.pair(ends), faults)?;
    if let Some(link) = c.common(a, b) {
        let message = both!(
            "`{}` and `{}` are both on link `{}`, so no cylinder can move them",
            c.point_name(a),
            c.point_name(b),
            c.link_name(link)
        );
        faults.push(Diagnostic::error("driver", message).at(ends.span));
        return None;
    }
    let ids: Vec<LinkId> = links.iter().filter_map(|w| note(c.names.link(w), faults)).collect();
    let mut sound = ids.len() == links.len();
    if !matches!(ids.as_slice(), [] | [_, _]) || (ids.len() == 2 && ids[0] == ids[1]) {
        let d = Diagnostic::error(
            "driver",
            both!("\"links\" of a cylinder numbers two links, the barrel and the rod"),
        )
        .at(ends.span);
        faults.push(d.help(both!("write \"links\": [\"5\", \"6\"]")));
        sound = false;
    }
    for ((id, word), end) in ids.iter().zip(links).zip([a, b]) {
        if let Some(other) = c.names.links[id.0].points.iter().find(|p| **p != end) {
            let message = both!(
                "link `{}` of the cylinder has a further point `{}`",
                word.text,
                c.point_name(*other)
            );
            faults.push(
                Diagnostic::error("driver", message)
                    .at(word.span)
                    .help(both!("describe barrel and rod as links with a guide between them")),
            );
            sound = false;
        }
    }
    sound.then_some(DriverKind::Cylinder { a, b, length, links: ids })
}
