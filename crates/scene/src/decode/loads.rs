//! The sections of forces: `gravity`, `masses`, `forces`, `springs`, `friction`, `balance`.

use super::super::keys;
use super::super::raw::*;
use super::{entries, items, place, quantity, two_quantities};
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::json::fields::{Fields, word};
use hodograph_base::json::{Node, NodeKind, Word};

/// Reads the sections. A centre of mass given by its place becomes a point of its link: `S` and the
/// link's name.
pub(super) fn loads(f: &Fields, raw: &mut RawScene, faults: &mut Faults) {
    raw.loads.gravity = f.get("gravity").and_then(|n| two_quantities(n, "\"gravity\"", faults));
    for (link, node) in entries(f.get("masses"), "\"masses\"", faults) {
        if let Some(mass) = mass(link, node, raw, faults) {
            raw.loads.masses.push(mass);
        }
    }
    for node in items(f.get("forces"), "\"forces\"", faults) {
        raw.loads.applied.extend(force(node, faults));
    }
    for node in items(f.get("springs"), "\"springs\"", faults) {
        raw.loads.springs.extend(spring(node, faults));
    }
    for node in items(f.get("friction"), "\"friction\"", faults) {
        raw.loads.friction.extend(friction(node, faults));
    }
    raw.loads.balance = f.get("balance").and_then(|n| balance(n, faults));
}

/// Returns an optional member; `None` if it cannot be read.
fn optional<T>(
    f: &Fields,
    key: &str,
    faults: &mut Faults,
    read: impl Fn(&Node, &str, &mut Faults) -> Option<T>,
) -> Option<Option<T>> {
    match f.get(key) {
        Some(node) => read(node, &format!("\"{key}\""), faults).map(Some),
        None => Some(None),
    }
}

fn amount(node: &Node, what: &str, faults: &mut Faults) -> Option<RawQuantity> {
    quantity(node, Both::same(what), faults)
}

fn name(node: &Node, what: &str, faults: &mut Faults) -> Option<Word> {
    word(node, &what.to_owned(), faults)
}

fn mass(link: &Word, node: &Node, raw: &mut RawScene, faults: &mut Faults) -> Option<RawMass> {
    let f = Fields::open(node, both!("the mass of link `{}`", link.text), keys::MASS, faults)?;
    let (m, weight) = (optional(&f, "m", faults, amount), optional(&f, "weight", faults, amount));
    let (j, k) = (optional(&f, "J", faults, amount), optional(&f, "k", faults, amount));
    let at = match f.get("at") {
        None => Some(None),
        Some(n @ Node { kind: NodeKind::Text(_), .. }) => name(n, "\"at\"", faults).map(Some),
        Some(n) => place(n, faults).map(|place| {
            let taken =
                |name: &str| raw.links.iter().any(|l| l.points.iter().any(|p| p.text == name));
            let name = ["S", "G"]
                .map(|letter| format!("{letter}{}", link.text))
                .into_iter()
                .find(|n| !taken(n));
            let point =
                Word { text: name.unwrap_or_else(|| format!("S,{}", link.text)), span: n.span };
            raw.links
                .iter_mut()
                .filter(|l| l.name.text == link.text)
                .for_each(|l| l.points.push(point.clone()));
            raw.points.push((point.clone(), place));
            Some(point)
        }),
    };
    let mass = RawMass {
        link: link.clone(),
        m: m?,
        weight: weight?,
        j: j?,
        k: k?,
        at: at?,
        span: node.span,
    };
    if let (Some(_), Some(weight)) = (&mass.m, &mass.weight) {
        let message = both!("link `{}` has a mass and a weight", link.text);
        faults.push(
            Diagnostic::error("given-twice", message)
                .at(weight.span)
                .help(both!("keep one of them")),
        );
    }
    if let (Some(_), Some(k)) = (&mass.j, &mass.k) {
        let message = both!("link `{}` has J and a radius of gyration", link.text);
        faults.push(
            Diagnostic::error("given-twice", message).at(k.span).help(both!("keep one of them")),
        );
    }
    Some(mass)
}

fn force(node: &Node, faults: &mut Faults) -> Option<RawApplied> {
    let f = Fields::open(node, both!("a force"), keys::FORCE, faults)?;
    let on = f
        .need("on", both!("\"3\", the link on which it acts"), faults)
        .and_then(|n| name(n, "\"on\"", faults));
    let at = optional(&f, "at", faults, name);
    let force = match f.get("F") {
        None => Some(None),
        Some(n) => match n.kind {
            NodeKind::Array(_) => {
                two_quantities(n, "\"F\"", faults).map(|xy| Some(RawSizeOfForce::Components(xy)))
            }
            _ => amount(n, "\"F\"", faults).map(|q| Some(RawSizeOfForce::Magnitude(q))),
        },
    };
    let (moment, angle) =
        (optional(&f, "M", faults, amount), optional(&f, "angle", faults, amount));
    let (line, against) =
        (optional(&f, "line", faults, name), optional(&f, "against", faults, name));
    let course = match (f.get("over"), f.get("diagram")) {
        (Some(_), Some(diagram)) => {
            let message = both!("a load has a diagram or a part of the motion, not both");
            let help = both!("the diagram ends where its points end: leave \"over\" out");
            faults.push(Diagnostic::error("given-twice", message).at(diagram.span).help(help));
            return None;
        }
        (Some(over), None) => Some(over_part(over, faults)?),
        (None, Some(n)) => Some(diagram(n, faults)?),
        (None, None) => None,
    };
    Some(RawApplied {
        on: on?,
        at: at?,
        force: force?,
        moment: moment?,
        angle: angle?,
        line: line?,
        against: against?,
        course,
        span: node.span,
    })
}

/// Decodes a part of a stroke, or of a turn.
fn over_part(node: &Node, faults: &mut Faults) -> Option<RawCourse> {
    let f = Fields::open(node, "\"over\"", keys::OVER, faults)?;
    let whole = |text: &str| RawQuantity { text: text.to_owned(), span: node.span, bare: true };
    let ends = match (f.get("stroke"), f.get("angles")) {
        (None, None) => [whole("0"), whole("1")],
        (Some(n), _) => two_quantities(n, "\"stroke\"", faults)?,
        (None, Some(n)) => two_quantities(n, "\"angles\"", faults)?,
    };
    course(&f, ends.map(|at| (at, None)).to_vec(), node, faults)
}

/// Decodes a diagram: amounts at places of a stroke or at angles.
fn diagram(node: &Node, faults: &mut Faults) -> Option<RawCourse> {
    let f = Fields::open(node, "\"diagram\"", keys::DIAGRAM, faults)?;
    let points = f.need("points", both!("[[0, \"0 N\"], [1, \"400 N\"]]"), faults)?;
    let points = items(Some(points), "\"points\"", faults).iter().map(|n| {
        let [at, amount] = two_quantities(n, both!("a point of the diagram"), faults)?;
        Some((at, Some(amount)))
    });
    let points = points.collect::<Option<Vec<_>>>()?;
    course(&f, points, node, faults)
}

fn course(
    f: &Fields,
    stations: Vec<(RawQuantity, Option<RawQuantity>)>,
    node: &Node,
    faults: &mut Faults,
) -> Option<RawCourse> {
    let (slide, turn) = (optional(f, "slide", faults, name), optional(f, "turn", faults, name));
    let toward = optional(f, "toward", faults, amount);
    let period =
        if f.get("points").is_some() { optional(f, "period", faults, amount) } else { Some(None) };
    Some(RawCourse {
        slide: slide?,
        toward: toward?,
        turn: turn?,
        period: period?,
        stations,
        span: node.span,
    })
}

fn spring(node: &Node, faults: &mut Faults) -> Option<RawSpring> {
    let f = Fields::open(node, both!("a spring"), keys::SPRING, faults)?;
    let mut end = |key: &str| {
        f.need(key, both!("\"B\", a point"), faults)
            .and_then(|n| name(n, &format!("\"{key}\""), faults))
    };
    let (from, to) = (end("from"), end("to"));
    let k = f.need("k", "\"40 N/m\"", faults).and_then(|n| amount(n, "\"k\"", faults));
    let free = f.need("free", "\"100 mm\"", faults).and_then(|n| amount(n, "\"free\"", faults));
    Some(RawSpring { from: from?, to: to?, k: k?, free: free?, span: node.span })
}

fn friction(node: &Node, faults: &mut Faults) -> Option<RawFriction> {
    let f = Fields::open(node, "\"friction\"", keys::FRICTION, faults)?;
    let pin = optional(&f, "pin", faults, name);
    let (slider, on) = (optional(&f, "slider", faults, name), optional(&f, "on", faults, name));
    let (circle, radius) =
        (optional(&f, "circle", faults, amount), optional(&f, "radius", faults, amount));
    let rough = optional(&f, "f", faults, amount);
    Some(RawFriction {
        pin: pin?,
        slider: slider?,
        on: on?,
        circle: circle?,
        radius: radius?,
        f: rough?,
        span: node.span,
    })
}

fn balance(node: &Node, faults: &mut Faults) -> Option<RawBalance> {
    let f = Fields::open(node, "\"balance\"", keys::BALANCE, faults)?;
    let (link, at) = (optional(&f, "link", faults, name), optional(&f, "at", faults, name));
    let angle = optional(&f, "angle", faults, amount);
    Some(RawBalance { link: link?, at: at?, angle: angle?, span: node.span })
}
