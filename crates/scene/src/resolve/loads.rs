//! The sections of forces: masses, applied forces, springs, balance.

use super::applied::GuidesAndDrivers;
use super::*;

pub(super) fn loads(c: &Context, moving: GuidesAndDrivers, faults: &mut Faults) -> Loads {
    let raw = &c.raw.loads;
    let gravity = raw.gravity.as_ref().and_then(|[x, y]| {
        let (x, y) = (
            c.values.si(x, RequiredQuantity::Acceleration, faults),
            c.values.si(y, RequiredQuantity::Acceleration, faults),
        );
        Some([x?, y?])
    });
    let mut masses: Vec<Mass> = Vec::new();
    for raw in &raw.masses {
        masses.extend(mass(c, raw, gravity.as_ref(), faults));
    }
    Loads {
        masses,
        applied: raw
            .applied
            .iter()
            .filter_map(|a| super::applied::applied(c, moving, a, faults))
            .collect(),
        springs: raw.springs.iter().filter_map(|s| spring(c, s, faults)).collect(),
        friction: raw
            .friction
            .iter()
            .flat_map(|f| super::friction::friction(c, moving.0, f, faults))
            .collect(),
        balance: raw.balance.as_ref().and_then(|b| balance(c, b, faults)),
        gravity,
    }
}

/// Returns a link that can be loaded. Loads on the ground have no effect, which a note says.
pub(super) fn loaded(c: &Context, word: &Word, faults: &mut Faults) -> Option<LinkId> {
    let link = note(c.names.link(word), faults)?;
    if link != c.ground {
        return Some(link);
    }
    let message =
        both!("link `{}` is the ground: a load on it moves nothing and is left out", word.text);
    faults.push(Diagnostic::note("load-on-ground", message).at(word.span));
    None
}

pub(super) fn positive(
    given: GivenQuantity,
    what: Both,
    faults: &mut Faults,
) -> Option<GivenQuantity> {
    if given.value >= 0.0 {
        return Some(given);
    }
    let message = both!("{} is {}; it must not be negative", what, given.text);
    faults.push(Diagnostic::error("not-positive", message).at(given.span));
    None
}

/// Resolves an optional quantity; `None` if it has a fault.
fn optional(
    c: &Context,
    raw: Option<&RawQuantity>,
    wanted: RequiredQuantity,
    faults: &mut Faults,
) -> Option<Option<GivenQuantity>> {
    transpose(raw.map(|q| {
        c.values.si(q, wanted, faults).and_then(|given| positive(given, wanted.describe(), faults))
    }))
}

/// Resolves a quantity that is computed from others of the file.
pub(super) fn computed(
    c: &Context,
    text: String,
    span: Span,
    wanted: RequiredQuantity,
    faults: &mut Faults,
) -> Option<GivenQuantity> {
    c.values.si(&RawQuantity { text, span, bare: true }, wanted, faults)
}

fn mass(
    c: &Context,
    raw: &RawMass,
    gravity: Option<&[GivenQuantity; 2]>,
    faults: &mut Faults,
) -> Option<Mass> {
    let link = loaded(c, &raw.link, faults)?;
    let name = &raw.link.text;
    let mut m = optional(c, raw.m.as_ref(), RequiredQuantity::Mass, faults)?;
    let weight = optional(c, raw.weight.as_ref(), RequiredQuantity::Force, faults)?;
    if let Some(weight) = &weight {
        let Some([x, y]) = gravity else {
            let message = both!("link `{name}` has a weight, but the scene has no gravity");
            let help = both!("add \"gravity\": [\"0\", \"-9.81 m/s^2\"]");
            faults.push(
                Diagnostic::error("weight-without-gravity", message).at(weight.span).help(help),
            );
            return None;
        };
        let g = match (x.value == 0.0, y.value == 0.0) {
            (true, false) => format!("abs({})", y.text),
            (false, true) => format!("abs({})", x.text),
            (false, false) => format!("sqrt(({})^2 + ({})^2)", x.text, y.text),
            (true, true) => {
                let message = both!("link `{name}` has a weight, but gravity is zero");
                let help = both!("give its mass \"m\", or another \"gravity\"");
                faults.push(
                    Diagnostic::error("weight-without-gravity", message).at(weight.span).help(help),
                );
                return None;
            }
        };
        m = Some(computed(
            c,
            format!("({})/({g})", weight.text),
            weight.span,
            RequiredQuantity::Mass,
            faults,
        )?);
    }
    let mut j = optional(c, raw.j.as_ref(), RequiredQuantity::Inertia, faults)?;
    if let Some(k) = optional(c, raw.k.as_ref(), RequiredQuantity::Length, faults)? {
        let Some(m) = &m else {
            let message = both!("link `{name}` has a radius of gyration, but no mass");
            faults.push(
                Diagnostic::error("force", message)
                    .at(k.span)
                    .help(both!("give \"m\" or \"weight\"")),
            );
            return None;
        };
        j = Some(computed(
            c,
            format!("({})*({})^2", m.text, k.text),
            k.span,
            RequiredQuantity::Inertia,
            faults,
        )?);
    }
    if m.is_none() && j.is_none() {
        let message = both!("link `{name}` has neither a mass nor a moment of inertia");
        let help = both!("give \"m\", \"weight\" or \"J\"");
        faults.push(Diagnostic::error("force", message).at(raw.span).help(help));
        return None;
    }
    let at = match (&raw.at, &c.names.links[link.0].points[..]) {
        (Some(word), _) => Some(on_link(c, word, link, faults)?),
        (None, _) if m.as_ref().is_none_or(|m| m.value == 0.0) => None,
        (None, [one]) => Some(*one),
        (None, points) => {
            let message = both!("the centre of mass of link `{name}` is not told");
            let base: String =
                points.iter().take(2).map(|p| c.point_name(*p)).collect::<Vec<_>>().join(",");
            let help = both!(
                "name a point of the link, or give a place in it: \"at\": {{\"base\": \"{base}\", \"x\": \"50 mm\", \"y\": \"0 mm\"}}"
            );
            faults.push(Diagnostic::error("mass-without-point", message).at(raw.span).help(help));
            return None;
        }
    };
    Some(Mass { link, m, weight, j, at, span: raw.span })
}

/// Returns a point that the link carries.
pub(super) fn on_link(
    c: &Context,
    word: &Word,
    link: LinkId,
    faults: &mut Faults,
) -> Option<PointId> {
    let point = note(c.names.point(word), faults)?;
    if c.carries(link, point) {
        return Some(point);
    }
    let message = both!("point `{}` is not on link `{}`", word.text, c.link_name(link));
    faults.push(Diagnostic::error("not-on-link", message).at(word.span).help(c.points_of(link)));
    None
}

/// Returns the link on which a spring acts at a point: the only one that carries it, or else a
/// moving one.
fn carrier(c: &Context, point: PointId) -> Option<LinkId> {
    let mut on = (0..c.names.links.len()).map(LinkId).filter(|l| c.carries(*l, point));
    let first = on.next()?;
    Some(if first == c.ground { on.next().unwrap_or(first) } else { first })
}

fn spring(c: &Context, raw: &RawSpring, faults: &mut Faults) -> Option<Spring> {
    let mut end = |word: &Word| {
        let point = note(c.names.point(word), faults)?;
        match carrier(c, point) {
            Some(link) => Some((point, link)),
            None => {
                let message = both!("point `{}` is on no link: no spring can act there", word.text);
                faults.push(Diagnostic::error("not-on-link", message).at(word.span));
                None
            }
        }
    };
    let (from, to) = (end(&raw.from), end(&raw.to));
    let stiffness = c
        .values
        .si(&raw.k, RequiredQuantity::Stiffness, faults)
        .and_then(|k| positive(k, both!("the stiffness"), faults));
    let free = c
        .values
        .si(&raw.free, RequiredQuantity::Length, faults)
        .and_then(|l| positive(l, both!("the free length"), faults));
    let ends = [from?, to?];
    if ends[0].0 == ends[1].0 {
        let message = both!("both ends of the spring are `{}`", raw.from.text);
        faults.push(Diagnostic::error("same-point", message).at(raw.span));
        return None;
    }
    Some(Spring { ends, stiffness: stiffness?, free: free?, span: raw.span })
}

fn balance(c: &Context, raw: &RawBalance, faults: &mut Faults) -> Option<Balance> {
    let point = transpose(raw.at.as_ref().map(|word| note(c.names.point(word), faults)))?;
    let angle = transpose(raw.angle.as_ref().map(|q| c.values.angle(q, faults)))?;
    let link = transpose(raw.link.as_ref().map(|word| note(c.names.link(word), faults)))?;
    let link = link.or_else(|| point.and_then(|p| carrier(c, p)));
    let fault = |message: Both, help: Both, faults: &mut Faults| {
        faults.push(Diagnostic::error("balance", message).at(raw.span).help(help));
        None
    };
    if c.raw.drivers.len() > 1 {
        let message = both!("with several drivers each has a balancing moment of its own");
        return fault(message, both!("leave \"balance\" out"), faults);
    }
    let Some(link) = link.filter(|l| *l != c.ground) else {
        let message = both!("\"balance\" names no moving link");
        let help = both!(
            "write {{\"link\": \"1\"}} for a moment, or {{\"at\": \"B\", \"angle\": \"-30 deg\"}} for a force"
        );
        return fault(message, help, faults);
    };
    match (point, angle) {
        (None, None) => Some(Balance { link, force: None, span: raw.span }),
        (Some(point), Some(angle)) if c.carries(link, point) => {
            Some(Balance { link, force: Some((point, angle)), span: raw.span })
        }
        (Some(point), Some(_)) => {
            let message =
                both!("point `{}` is not on link `{}`", c.point_name(point), c.link_name(link));
            fault(message, c.points_of(link), faults)
        }
        (None, Some(_)) | (Some(_), None) => {
            let message = both!("a balancing force has a point \"at\" and a direction \"angle\"");
            fault(message, both!("give both, or neither for a moment"), faults)
        }
    }
}
