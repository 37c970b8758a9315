//! The sections `gears` and `rolling`: rolling pairs, their guides, and the distances of their
//! centres.

use super::super::rolling::{Contours, Flanks, Rolling, RollingId, RollingKind, Sizes};
use super::*;

/// Largest number of teeth of a gear; larger numbers are typing errors.
const MOST_TEETH: u32 = 100_000;

/// The results of the sections.
#[derive(Default)]
pub(super) struct Resolved {
    pub rolling: Vec<Rolling>,
    /// Guides of the pairs, which follow those of the file.
    pub guides: Vec<Guide>,
    /// Distances of centres that follow from the sizes and are not in the file.
    pub lengths: Vec<Length>,
}

/// One side of a pair.
#[derive(Clone, Copy)]
struct PairSide {
    link: LinkId,
    centre: Option<PointId>,
}

/// Resolves the rolling pairs; `first_guide` is the index of the next guide.
pub(super) fn rolling(
    c: &Context,
    places: &[PointPlace],
    lengths: &[Length],
    first_guide: usize,
    faults: &mut Faults,
) -> Resolved {
    let mut out = Resolved::default();
    for (raw, at) in c.raw.rolling.iter().zip(c.contacts) {
        let mut found = Faults::default();
        let before = (out.guides.len(), out.lengths.len());
        if let Some(pair) = pair(c, raw, *at, (places, lengths), first_guide, &mut out, &mut found)
            && !found.has_errors()
        {
            out.rolling.push(pair);
        } else {
            // A guide or a length of a faulty pair would refer to a missing pair.
            out.guides.truncate(before.0);
            out.lengths.truncate(before.1);
        }
        faults.list.extend(found.list);
    }
    out
}

fn pair(
    c: &Context,
    raw: &RawRolling,
    at: [PointId; 2],
    (places, lengths): (&[PointPlace], &[Length]),
    first_guide: usize,
    out: &mut Resolved,
    faults: &mut Faults,
) -> Option<Rolling> {
    let sides: Vec<Option<PairSide>> = raw.sides.iter().map(|s| side(c, s, faults)).collect();
    // Whole turns of the phase count.
    let phase = raw.phase.as_ref().map(|q| c.values.angle_in_full(q, faults));
    let [Some(a), Some(b)] = sides[..] else { return None };
    if a.link == b.link {
        let message = both!("link `{}` cannot roll on itself", c.link_name(a.link));
        faults
            .push(Diagnostic::error("rolling", message).at(raw.span).help(both!("name two links")));
        return None;
    }
    let elsewhere = |at: &PointId| {
        !places.get(at.0).is_none_or(|p| matches!(p, PointPlace::Unknown))
            || c.names.links.iter().any(|l| l.points.contains(at))
    };
    if let Some(&at) = at.iter().find(|at| elsewhere(at)) {
        let message = both!(
            "`{}` is the point of contact: it is found from the centres, and no link carries it",
            c.point_name(at)
        );
        let help = both!(
            "give \"at\" a name of its own, or take `{0}` out of \"links\" and \"points\"",
            c.point_name(at)
        );
        faults.push(
            Diagnostic::error("contact-point", message)
                .at(raw.at.as_ref().map_or(raw.span, |w| w.span))
                .help(help),
        );
    }
    let flanks = flanks(c, raw, faults);
    let phase = transpose(phase)?;
    if raw.kind == RollingKind::Rope {
        belts::taut(c, raw, (a.link, b.centre?), faults)?;
    }
    if let Some(q) = &raw.phase
        && [a, b].iter().all(|side| angle_is_fixed(c, side.link, places))
    {
        let message =
            both!("`phase` is given, but coordinates or a driver say how both wheels stand");
        let d = Diagnostic::error("phase", message).at(q.span);
        faults.push(d.help(both!("leave the phase away, or what says how one of them stands")));
        return None;
    }
    let wheel = b.centre?;
    let common = a.centre.is_some_and(|p| {
        (0..c.names.links.len()).any(|l| c.carries(LinkId(l), p) && c.carries(LinkId(l), wheel))
    });
    let guide = GuideId(first_guide + out.guides.len());
    let (contours, flanks, path) = match (a.centre, &raw.strand) {
        (None, _) => {
            let (contours, path) = straight(c, raw, a.link, (wheel, places, guide), faults)?;
            (contours, flanks?, Some(path))
        }
        (Some(centre), None) => {
            let (contours, radius) =
                round(c, raw, [centre, wheel], (!common).then_some(guide), faults)?;
            if let (Contours::Circles { centres, sizes: Sizes::Radii([p, q]), hollow, .. }, true) =
                (&contours, common)
            {
                out.lengths.extend(distance(c, *centres, [p, q], *hollow, (places, lengths)));
            }
            (contours, flanks?, (!common).then_some(GuidePath::Arc { centre, radius }))
        }
        (Some(centre), Some(strand)) => {
            (belts::round(c, raw, strand, [a.link, b.link], [centre, wheel], faults)?, None, None)
        }
    };
    let id = RollingId(out.rolling.len());
    out.guides.extend(path.map(|path| Guide {
        pin: Some(wheel),
        slider: None,
        on: a.link,
        path,
        length: None,
        rolling: Some(id),
        span: raw.span,
    }));
    Some(Rolling {
        links: [a.link, b.link],
        contours,
        at,
        kind: raw.kind,
        phase,
        flanks,
        span: raw.span,
    })
}

/// Returns true if data other than the phase fix the angle of a link: it is the ground, two of its
/// points have coordinates, or a driver gives its angle.
fn angle_is_fixed(c: &Context, link: LinkId, places: &[PointPlace]) -> bool {
    let placed = c.names.links[link.0]
        .points
        .iter()
        .filter(|p| matches!(places[p.0], PointPlace::At(_)))
        .count();
    let turned = c.raw.drivers.iter().any(|d| match &d.kind {
        RawDriverKind::Turn { link: word, angle, .. } => {
            word.text == c.link_name(link) && angle.is_some()
        }
        RawDriverKind::Slide { .. } | RawDriverKind::Cylinder { .. } => false,
    });
    link == c.ground || placed >= 2 || turned
}

fn side(c: &Context, raw: &RawRollingSide, faults: &mut Faults) -> Option<PairSide> {
    let link = match &raw.link {
        Some(word) => note(c.names.link(word), faults)?,
        None => c.ground,
    };
    let centre = match &raw.centre {
        None => None,
        Some(word) => Some(c.centre_on(word, link, both!("which carries the circle"), faults)?),
    };
    Some(PairSide { link, centre })
}

/// Resolves a wheel on a straight track: its centre moves along the track.
fn straight(
    c: &Context,
    raw: &RawRolling,
    on: LinkId,
    (wheel, places, guide): (PointId, &[PointPlace], GuideId),
    faults: &mut Faults,
) -> Option<(Contours, GuidePath)> {
    let ends = raw.line.as_ref().map(|word| note(c.line_on(word, on), faults));
    let angle = raw.angle.as_ref().map(|q| c.values.angle(q, faults));
    let radius = match &raw.sizes {
        RawSizes::Radii(radii) => match &radii[..] {
            [r] => c.values.positive_length(r, both!("the radius of the wheel"), faults),
            _ => {
                let d = Diagnostic::error("wrong-count", both!("a gear on a rack has one radius"));
                faults.push(d.at(raw.span).help(both!("a rack has none: write that of the gear")));
                None
            }
        },
        RawSizes::Teeth(teeth, module) => match (&teeth[..], module) {
            ([z], Some(module)) => {
                let (z, module) = (
                    whole(c, z, faults)?,
                    c.values.positive_length(module, both!("the module"), faults)?,
                );
                let text = format!("({})*{z}/2", module.text);
                Some(GivenQuantity {
                    value: module.value * f64::from(z) / 2.0,
                    radius: module.radius * f64::from(z) + 1e-15 * module.value * f64::from(z),
                    text,
                    span: module.span,
                })
            }
            _ => {
                let d = Diagnostic::error(
                    "gear-size",
                    both!("a gear on a rack has one number of teeth and a `module`"),
                );
                faults.push(
                    d.at(raw.span).help(both!("give \"teeth\": [20] and \"module\", or \"radii\"")),
                );
                None
            }
        },
    };
    if let Some(q) = &raw.phase {
        let message = both!("a straight track has no `phase`");
        let d = Diagnostic::error("phase", message).at(q.span);
        faults.push(d.help(both!(
            "leave it away; coordinates of two points of the wheel say how it stands"
        )));
        return None;
    }
    let (ends, angle, radius) = (transpose(ends)?, transpose(angle)?, radius?);
    let direction = match (ends, angle) {
        (Some((a, b)), turned) => GuideDirection::Along(a, b, turned),
        (None, Some(angle)) => GuideDirection::Instant(angle),
        (None, None) if c.raw.extent.is_of_pairs() => {
            GuideDirection::Instant(sliding_angle(c, on, raw.span))
        }
        (None, None) => {
            let d = Diagnostic::error(
                "no-direction",
                match raw.kind.is_flexible() {
                    true => both!("the rope of load `{}` has no direction", c.link_name(on)),
                    false => {
                        both!("the straight track on link `{}` has no direction", c.link_name(on))
                    }
                },
            );
            faults.push(d.at(raw.span).help(both!(
                "add \"angle\": \"0 deg\" or \"line\", two points of that link; the wheel lies to the left, looking along it"
            )));
            return None;
        }
    };
    // The wheel's centre moves parallel to the track, at the distance of its radius.
    let (through, offset) = match &raw.through {
        Some(given) => (guides::through(c, on, given, faults)?, Some(radius.clone())),
        // A wheel with coordinates fixes the position of its track; else the track is the line
        // itself.
        None => match &direction {
            GuideDirection::Along(from, _, None)
                if matches!(places[wheel.0], PointPlace::Unknown) =>
            {
                (Through::Point(*from), Some(radius.clone()))
            }
            GuideDirection::Along(..)
            | GuideDirection::Instant(_)
            | GuideDirection::Own
            | GuideDirection::Slid(_) => (Through::Pin, None),
        },
    };
    Some((
        Contours::Track { centre: wheel, radius, guide },
        GuidePath::Line { through, direction, offset },
    ))
}

/// Returns the direction of a track without one, for a mobility count: that of the guide in
/// which its link slides.
fn sliding_angle(c: &Context, on: LinkId, span: Span) -> GivenQuantity<Angle> {
    let mine = |g: &&RawGuide| g.slider.as_ref().is_some_and(|w| w.text == c.link_name(on));
    let told = c
        .raw
        .guides
        .iter()
        .find(mine)
        .and_then(|g| g.angle.as_ref())
        .and_then(|q| c.values.angle(q, &mut Faults::default()));
    told.unwrap_or(GivenQuantity {
        value: Angle::Deg(0.0),
        radius: 0.0,
        text: "0 deg".into(),
        span,
    })
}

/// Resolves two circles, and the radius about the first centre of the path of the second, if it
/// follows from the sizes.
fn round(
    c: &Context,
    raw: &RawRolling,
    centres: [PointId; 2],
    guide: Option<GuideId>,
    faults: &mut Faults,
) -> Option<(Contours, Option<GivenQuantity>)> {
    let through = raw.through.as_ref().map(|t| match t {
        RawThrough::At(_, span) => *span,
        RawThrough::Point(word) => word.span,
    });
    let of_a_line = [
        ("line", raw.line.as_ref().map(|w| w.span)),
        ("angle", raw.angle.as_ref().map(|q| q.span)),
        ("through", through),
    ];
    for (key, given) in of_a_line {
        if let Some(span) = given {
            let message = both!("two circles have no `{key}`");
            faults.push(Diagnostic::error("rolling", message).at(span).help(
                if raw.kind == RollingKind::Gears {
                    both!("leave it away, or name the \"rack\"")
                } else {
                    both!("leave it away, or the \"track\" if it is straight")
                },
            ));
        }
    }
    let hollow = raw.sides.iter().position(|s| s.hollow);
    let (sizes, radius) = match &raw.sizes {
        RawSizes::Radii(radii) => {
            let [a, b] = &radii[..] else {
                let d = Diagnostic::error("wrong-count", both!("two gears have two pitch radii"))
                    .at(raw.span);
                faults.push(d.help(both!("write them in the order of the centres")));
                return None;
            };
            let what = || {
                if raw.kind == RollingKind::Gears {
                    both!("a pitch radius")
                } else {
                    both!("a radius")
                }
            };
            let (a, b) = (
                c.values.positive_length(a, what(), faults),
                c.values.positive_length(b, what(), faults),
            );
            let (a, b) = (a?, b?);
            larger(c, raw, hollow, [a.value, b.value], faults)?;
            let radius = sum(c, &a, &b, hollow);
            (Sizes::Radii([a, b]), radius)
        }
        RawSizes::Teeth(teeth, module) => {
            let [a, b] = &teeth[..] else {
                let d =
                    Diagnostic::error("wrong-count", both!("two gears have two numbers of teeth"))
                        .at(raw.span);
                faults.push(d.help(both!("write them in the order of the centres")));
                return None;
            };
            let (za, zb) = (whole(c, a, faults), whole(c, b, faults));
            let (za, zb) = (za?, zb?);
            larger(c, raw, hollow, [f64::from(za), f64::from(zb)], faults)?;
            match module {
                None => (Sizes::Teeth([za, zb]), None),
                // Shifted gears run at the given distance of their centres.
                Some(_) if raw.flanks.shift.is_some() => (Sizes::Teeth([za, zb]), None),
                Some(module) => {
                    c.values.positive_length(module, both!("the module"), faults)?;
                    let radius = |z: u32, q: &RawQuantity| {
                        let m = c.values.si(
                            module,
                            RequiredQuantity::Length,
                            &mut Faults::default(),
                        )?;
                        let text = RawQuantity {
                            text: format!("({})*{z}/2", m.text),
                            span: q.span,
                            bare: false,
                        };
                        c.values.si(&text, RequiredQuantity::Length, &mut Faults::default())
                    };
                    let (ra, rb) = (radius(za, a)?, radius(zb, b)?);
                    let distance = sum(c, &ra, &rb, hollow);
                    (Sizes::Radii([ra, rb]), distance)
                }
            }
        }
    };
    Some((Contours::Circles { centres, sizes, hollow, guide }, radius))
}

/// Checks that a hollow circle is the larger one.
fn larger(
    c: &Context,
    raw: &RawRolling,
    hollow: Option<usize>,
    sizes: [f64; 2],
    faults: &mut Faults,
) -> Option<()> {
    let Some(i) = hollow else { return Some(()) };
    if sizes[i] > sizes[1 - i] {
        return Some(());
    }
    let name = raw.sides[i].link.as_ref().map_or(c.link_name(c.ground), |w| &w.text);
    let d = Diagnostic::error(
        "ring-too-small",
        both!("link `{name}` is hollow, but not larger than what rolls inside it"),
    );
    faults
        .push(d.at(raw.span).help(both!("its radius (or number of teeth) must be the larger one")));
    None
}

/// Returns the distance of the centres from the radii.
fn sum(
    c: &Context,
    a: &GivenQuantity,
    b: &GivenQuantity,
    hollow: Option<usize>,
) -> Option<GivenQuantity> {
    let text = match hollow {
        None => format!("({})+({})", a.text, b.text),
        Some(0) => format!("({})-({})", a.text, b.text),
        Some(_) => format!("({})-({})", b.text, a.text),
    };
    c.values.si(
        &RawQuantity { text, span: a.span, bare: false },
        RequiredQuantity::Length,
        &mut Faults::default(),
    )
}

/// Returns the distance of two centres on one link, if neither coordinates nor a length give it.
fn distance(
    c: &Context,
    [p, q]: [PointId; 2],
    [a, b]: [&GivenQuantity; 2],
    hollow: Option<usize>,
    (places, lengths): (&[PointPlace], &[Length]),
) -> Option<Length> {
    let given = lengths.iter().any(|l| (l.a, l.b) == (p, q) || (l.a, l.b) == (q, p));
    let placed = [p, q].iter().all(|p| matches!(places[p.0], PointPlace::At(_)))
        || [p, q]
            .iter()
            .any(|p| matches!(places[p.0], PointPlace::InLink { .. } | PointPlace::Polar { .. }));
    if given || placed {
        return None;
    }
    Some(Length { a: p, b: q, value: sum(c, a, b, hollow)? })
}

/// Largest accepted pressure angle (rad): 20° is usual, 14.5° to 30° occur.
const STEEPEST_RAD: f64 = std::f64::consts::FRAC_PI_4;

/// Resolves the flanks of two gears, or of a gear on its rack; `None` if they have a fault,
/// `Some(None)` if there are none.
fn flanks(c: &Context, raw: &RawRolling, faults: &mut Faults) -> Option<Option<Flanks>> {
    let RawFlanks { pressure_angle, shift, addendum, clearance } = &raw.flanks;
    let any = [pressure_angle, addendum, clearance]
        .into_iter()
        .flatten()
        .chain(shift.iter().flatten())
        .next();
    let (teeth, module) = match &raw.sizes {
        RawSizes::Teeth(teeth, module)
            if teeth.len() == raw.sides.iter().filter(|s| s.centre.is_some()).count() =>
        {
            (teeth, module)
        }
        RawSizes::Teeth(..) | RawSizes::Radii(_) => {
            let Some(first) = any else { return Some(None) };
            let message = both!("flanks are given of a pair without `teeth`");
            faults.push(
                Diagnostic::error("gear-flanks", message)
                    .at(first.span)
                    .help(both!("give \"teeth\": [20, 40], or leave the flanks away")),
            );
            return None;
        }
    };
    let mut wrong = |q: &RawQuantity, what: Both| {
        faults.push(Diagnostic::error("gear-flanks", what).at(q.span));
        None::<f64>
    };
    let alpha = match pressure_angle {
        None => Some(20.0_f64.to_radians()),
        Some(q) => match c.values.angle(q, &mut Faults::default()).map(|a| a.value.radians()) {
            Some(a) if a > 0.0 && a <= STEEPEST_RAD => Some(a),
            _ => wrong(q, both!("`{}` is no pressure angle: above 0, at most 45 deg", q.text)),
        },
    };
    let number = |q: &RawQuantity| {
        // Plain numbers are not in the table of units, so the number is read in metres.
        let text = RawQuantity { text: format!("({})*(1 m)", q.text), span: q.span, bare: false };
        c.values
            .si(&text, RequiredQuantity::Length, &mut Faults::default())
            .map(|g| g.value)
            .filter(|x| x.is_finite())
    };
    let mut part = |q: &Option<RawQuantity>, usual: f64, least: f64| match q {
        None => Some(usual),
        Some(q) => number(q).filter(|x| *x >= least && *x <= 3.0).or_else(|| {
            wrong(q, both!("`{}` is no part of a module: a number from {least} to 3", q.text))
        }),
    };
    let (addendum, clearance) = (part(addendum, 1.0, 0.1), part(clearance, 0.25, 0.0));
    let shifts: Vec<Option<f64>> = shift
        .iter()
        .flatten()
        .map(|q| {
            number(q).filter(|x| x.abs() <= 5.0).or_else(|| {
                wrong(
                    q,
                    both!("`{}` is no profile shift: a number from −5 to 5, in modules", q.text),
                )
            })
        })
        .collect();
    let most = teeth.len();
    if let Some(extra) = shift.as_ref().and_then(|s| s.get(most)) {
        wrong(
            extra,
            if most == 1 {
                both!("a gear on a rack has one profile shift")
            } else {
                both!("two gears have two profile shifts")
            },
        );
    }
    // Faults of the numbers of teeth are reported where the sizes are read.
    let teeth: Vec<u32> =
        teeth.iter().filter_map(|z| whole(c, z, &mut Faults::default())).collect();
    let module = module
        .as_ref()
        .and_then(|q| c.values.si(q, RequiredQuantity::Length, &mut Faults::default()))
        .map(|g| g.value);
    let shifts = shifts.into_iter().collect::<Option<Vec<f64>>>()?;
    let teeth = match teeth[..] {
        // A straight contour comes first.
        [z] => [None, Some(z)],
        [y, z] => [Some(y), Some(z)],
        _ => return Some(None),
    };
    let (pressure_angle, addendum, clearance) = (alpha?, addendum?, clearance?);
    (shifts.len() <= most).then_some(Some(Flanks {
        teeth,
        module,
        pressure_angle,
        shifts,
        addendum,
        clearance,
    }))
}

/// Reads a number of teeth.
pub(super) fn whole(c: &Context, q: &RawQuantity, faults: &mut Faults) -> Option<u32> {
    let z = c.values.pure_number(q, faults)?;
    if z.fract() == 0.0 && (1.0..=f64::from(MOST_TEETH)).contains(&z) {
        return Some(z as u32);
    }
    let d = Diagnostic::error("teeth", both!("`{}` is no number of teeth", q.text)).at(q.span);
    faults.push(d.help(both!("write a whole number from 1 to {MOST_TEETH}")));
    None
}
