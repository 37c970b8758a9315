//! JSON tree to [`RawScene`]: checks shapes and keys, not the meaning of the words.

mod attempts;
mod belts;
mod composite;
mod driver;
mod law;
mod loads;
mod motion;
mod rolling;
mod ropes;

use super::front::TIME;
use super::model::Lang;
use super::raw::*;
use super::{cams, expr, keys};
use hodograph_base::diag::{Diagnostic, Faults, Span, both};
use hodograph_base::json::fields::{self, FaultSubject, Fields, list, object, word, wrong};
use hodograph_base::json::{Node, NodeKind, Word};

/// Largest number of links. A textbook mechanism has a dozen; the solvers' matrices grow with the
/// square of the number of links and their time with its cube, so these bounds keep a run under a
/// few seconds.
pub(super) const MAX_LINKS: usize = 500;
/// Largest number of points.
pub(super) const MAX_POINTS: usize = 2000;
/// Largest number of entries in every other list of the file.
const MAX_ENTRIES: usize = 5000;
/// Longest title, in characters: it is one line of a figure, and 500 letters make a line of two
/// metres.
const MAX_TITLE: usize = 500;
/// Longest statement, in characters: some pages, broken into lines word by word.
pub(super) const MAX_STATEMENT: usize = 10_000;

/// Decodes a whole file; it must give the data that `extent` demands. Faults are collected, and the
/// readable parts are returned so that later stages find their faults too.
pub(super) fn scene(root: &Node, extent: RequiredData, faults: &mut Faults) -> Option<RawScene> {
    let f = Fields::open(root, both!("a scene"), keys::SCENE, faults)?;
    let mut raw = RawScene { extent, ..RawScene::default() };
    if let Some(node) = f.get("title") {
        raw.title = localized(node, "\"title\"", MAX_TITLE, faults);
    }
    if let Some(node) = f.get("statement") {
        raw.statement = localized(node, "\"statement\"", MAX_STATEMENT, faults);
    }
    for (key, node) in entries(f.get("parameters"), "\"parameters\"", faults) {
        raw.parameters.extend(
            quantity(node, both!("parameter `{}`", key.text), faults).map(|q| (key.clone(), q)),
        );
    }
    if let Some(node) = f.get("time") {
        raw.is_timed = true;
        if let Some((name, _)) = raw.parameters.iter().find(|(name, _)| name.text == TIME) {
            let d = Diagnostic::error(
                "given-twice",
                both!("\"time\" and the parameter `t` both give the instant"),
            );
            faults.push(
                d.at(name.span)
                    .help(both!("leave one of them out, or give the parameter another name")),
            );
        }
        raw.parameters.extend(motion::time(node, faults));
    }
    for (key, node) in entries(f.get("units"), "\"units\"", faults) {
        raw.units
            .extend(word(node, both!("unit of `{}`", key.text), faults).map(|w| (key.clone(), w)));
    }
    for (key, node) in entries(f.get("answers"), "\"answers\"", faults) {
        raw.answers.extend(
            word(node, &format!("unit of `{}`", key.text), faults).map(|w| (key.clone(), w)),
        );
    }
    let before = faults.list.len();
    let links = f.need("links", "{\"1\": [\"A\", \"B\"], ...}", faults);
    for (key, node) in entries(links, "\"links\"", faults) {
        let points = words(Some(node), both!("link `{}`", key.text), faults);
        raw.links.push(RawLink { name: key.clone(), points });
    }
    raw.links_sound = faults.list.len() == before;
    raw.ground = f
        .need("ground", both!("\"4\", the name of the fixed link"), faults)
        .and_then(|n| word(n, "\"ground\"", faults));
    for (key, node) in entries(f.get("points"), "\"points\"", faults) {
        raw.points.extend(place(node, faults).map(|p| (key.clone(), p)));
    }
    for (key, node) in entries(f.get("lengths"), "\"lengths\"", faults) {
        raw.lengths.extend(
            quantity(node, both!("length `{}`", key.text), faults).map(|q| (key.clone(), q)),
        );
    }
    for node in items(f.get("guides"), "\"guides\"", faults) {
        raw.guides.extend(guide(node, faults));
    }
    for node in items(f.get("cams"), "\"cams\"", faults) {
        raw.cams.extend(cams::decode::cam(node, extent, faults));
    }
    for node in items(f.get("gears"), "\"gears\"", faults) {
        raw.rolling.extend(rolling::gear(node, extent, faults));
    }
    for node in items(f.get("rolling"), "\"rolling\"", faults) {
        raw.rolling.extend(rolling::wheel(node, extent, faults));
    }
    belts::belts(&f, &mut raw, faults);
    for node in items(f.get("ropes"), "\"ropes\"", faults) {
        raw.rolling.extend(ropes::rope(node, faults));
    }
    // Points that move by laws of time are drivers themselves.
    let drivers = match extent.is_at_rest() || f.get("motions").is_some() {
        true => f.get("driver"),
        false => f.need(
            "driver",
            "{\"link\": \"1\", \"angle\": \"60 deg\", \"omega\": \"10 rad/s\"}",
            faults,
        ),
    };
    match drivers {
        Some(Node { kind: NodeKind::Array(list), span })
            if list.is_empty() && !extent.is_at_rest() =>
        {
            faults.push(
                Diagnostic::error(
                    "empty",
                    both!("\"driver\" is empty: nothing drives the mechanism"),
                )
                .at(*span),
            );
        }
        Some(Node { kind: NodeKind::Array(_), .. }) => {
            for node in items(drivers, "\"driver\"", faults) {
                raw.drivers.extend(driver::driver(node, &raw, faults));
            }
        }
        Some(node) => raw.drivers.extend(driver::driver(node, &raw, faults)),
        None if extent.is_driven() => raw.drivers.extend(driver::added(&raw)),
        None => {}
    }
    for node in items(f.get("motions"), "\"motions\"", faults) {
        motion::motion(node, &mut raw, faults);
    }
    loads::loads(&f, &mut raw, faults);
    for (key, node) in entries(f.get("sketch"), "\"sketch\"", faults) {
        raw.sketch.extend(
            two_quantities(node, both!("sketch of `{}`", key.text), faults)
                .map(|q| (key.clone(), q)),
        );
    }
    for (key, node) in entries(f.get("side"), "\"side\"", faults) {
        raw.sides
            .extend(word(node, both!("side of `{}`", key.text), faults).map(|w| (key.clone(), w)));
    }
    raw.find = f.get("find").map(|n| words(Some(n), "\"find\"", faults));
    for node in items(f.get("composite"), "\"composite\"", faults) {
        raw.composite.extend(composite::composite(node, faults));
    }
    for node in items(f.get("attempts"), "\"attempts\"", faults) {
        raw.attempts.extend(attempts::attempt(node, faults));
    }
    for (key, node) in entries(f.get("readings"), "\"readings\"", faults) {
        if object(node, both!("reading `{}`", key.text), faults).is_some() {
            raw.readings.push(key.clone());
        }
    }
    if let Some(node) = f.get("paper") {
        raw.paper = paper(node, faults);
    }
    raw.language = f.get("language").and_then(|n| word(n, "\"language\"", faults));
    raw.notation = f.get("notation").and_then(|n| word(n, "\"notation\"", faults));
    Some(raw)
}

/// Decodes the keys that a scene shares with other files; the readers of those files decode all
/// other keys.
pub(super) fn front(root: &Node, faults: &mut Faults) -> RawScene {
    let mut raw = RawScene::default();
    let get = |key: &str| match &root.kind {
        NodeKind::Object(members) => {
            members.iter().find(|(k, _)| k.text == key).map(|(_, node)| node)
        }
        NodeKind::Text(_)
        | NodeKind::Number(_)
        | NodeKind::Bool(_)
        | NodeKind::Null
        | NodeKind::Array(_) => None,
    };
    raw.title = get("title").and_then(|node| localized(node, "\"title\"", MAX_TITLE, faults));
    for (key, node) in entries(get("parameters"), "\"parameters\"", faults) {
        raw.parameters.extend(
            quantity(node, both!("parameter `{}`", key.text), faults).map(|q| (key.clone(), q)),
        );
    }
    for (key, node) in entries(get("units"), "\"units\"", faults) {
        raw.units
            .extend(word(node, both!("unit of `{}`", key.text), faults).map(|w| (key.clone(), w)));
    }
    for (key, node) in entries(get("answers"), "\"answers\"", faults) {
        raw.answers.extend(
            word(node, &format!("unit of `{}`", key.text), faults).map(|w| (key.clone(), w)),
        );
    }
    if let Some(node) = get("paper") {
        raw.paper = paper(node, faults);
    }
    raw.language = get("language").and_then(|n| word(n, "\"language\"", faults));
    raw.notation = get("notation").and_then(|n| word(n, "\"notation\"", faults));
    raw
}

/// Returns the members of an optional object, up to the limit.
fn entries<'a>(
    node: Option<&'a Node>,
    what: impl Into<FaultSubject>,
    faults: &mut Faults,
) -> &'a [(Word, Node)] {
    let what = what.into();
    let limit = if what.is("\"links\"") { MAX_LINKS } else { MAX_ENTRIES };
    let members = node.and_then(|n| object(n, &what, faults)).unwrap_or_default();
    within(members, limit, &what, faults, |(key, _)| key.span)
}

/// Returns the items of an optional list, up to the limit.
pub(super) fn items<'a>(
    node: Option<&'a Node>,
    what: impl Into<FaultSubject>,
    faults: &mut Faults,
) -> &'a [Node] {
    let what = what.into();
    let items = node.and_then(|n| list(n, &what, faults)).unwrap_or_default();
    within(items, MAX_ENTRIES, &what, faults, |n| n.span)
}

fn within<'a, T>(
    all: &'a [T],
    limit: usize,
    what: &FaultSubject,
    faults: &mut Faults,
    span: impl Fn(&T) -> hodograph_base::diag::Span,
) -> &'a [T] {
    match all.get(limit) {
        None => all,
        Some(first) => {
            let message = both!("{} has {} entries; at most {limit} are allowed", *what, all.len());
            faults.push(Diagnostic::error("too-many", message).at(span(first)));
            &all[..limit]
        }
    }
}

/// Reads true or false.
fn flag(node: &Node, key: &str, faults: &mut Faults) -> Option<bool> {
    match node.kind {
        NodeKind::Bool(value) => Some(value),
        NodeKind::Text(_)
        | NodeKind::Number(_)
        | NodeKind::Null
        | NodeKind::Array(_)
        | NodeKind::Object(_) => {
            let message = both!("\"{key}\" is {}, not true or false", node.what());
            faults.push(Diagnostic::error("wrong-type", message).at(node.span));
            None
        }
    }
}

fn words(node: Option<&Node>, what: impl Into<FaultSubject>, faults: &mut Faults) -> Vec<Word> {
    let what = what.into();
    items(node, &what, faults)
        .iter()
        .filter_map(|n| word(n, both!("an entry of {}", what), faults))
        .collect()
}

pub(super) fn localized(
    node: &Node,
    what: &'static str,
    most: usize,
    faults: &mut Faults,
) -> Option<RawLocalized> {
    let [en, zh] = fields::localized(node, what, most, faults)?;
    Some(RawLocalized { en, zh })
}

fn place(node: &Node, faults: &mut Faults) -> Option<RawPlace> {
    if let NodeKind::Array(_) = node.kind {
        return two_quantities(node, both!("a place"), faults).map(RawPlace::At);
    }
    let has = |key: &str| matches!(&node.kind, NodeKind::Object(m) if m.iter().any(|(k, _)| k.text == key));
    let (xy, polar) = (has("x") || has("y"), has("length") || has("angle"));
    if xy && polar {
        let d = Diagnostic::error(
            "two-places",
            both!("the place is given in two ways, by x and y and by length and angle"),
        );
        faults
            .push(d.at(node.span).help(both!("keep \"x\" and \"y\", or \"length\" and \"angle\"")));
        return None;
    }
    let example = "\"100 mm\"";
    if polar {
        let f = Fields::open(node, both!("a place"), keys::PLACE_POLAR, faults)?;
        let base = f
            .need("base", both!("\"BC\", two points of the link"), faults)
            .and_then(|n| word(n, "\"base\"", faults));
        let length =
            f.need("length", example, faults).and_then(|n| quantity(n, "\"length\"", faults));
        let angle =
            f.need("angle", "\"30 deg\"", faults).and_then(|n| quantity(n, "\"angle\"", faults));
        return Some(RawPlace::Polar { base: base?, length: length?, angle: angle? });
    }
    let f = Fields::open(node, both!("a place"), keys::PLACE_XY, faults)?;
    let base = f
        .need("base", both!("\"BC\", two points of the link"), faults)
        .and_then(|n| word(n, "\"base\"", faults));
    let x = f.need("x", example, faults).and_then(|n| quantity(n, "\"x\"", faults));
    let y = f.need("y", example, faults).and_then(|n| quantity(n, "\"y\"", faults));
    Some(RawPlace::InLink { base: base?, xy: [x?, y?] })
}

fn guide(node: &Node, faults: &mut Faults) -> Option<RawGuide> {
    let f = Fields::open(node, both!("a guide"), keys::GUIDE, faults)?;
    let before = faults.list.len();
    let mut name = |key: &str| f.get(key).and_then(|n| word(n, &format!("\"{key}\""), faults));
    let (pin, slider, on, line, centre) =
        (name("pin"), name("slider"), name("on"), name("line"), name("centre"));
    let mut value = |key: &str| f.get(key).and_then(|n| quantity(n, &format!("\"{key}\""), faults));
    let (angle, offset, radius, length) =
        (value("angle"), value("offset"), value("radius"), value("length"));
    let through = through(&f, faults);
    // A guide with an unreadable member is dropped, so that its remaining members are not judged
    // alone.
    (faults.list.len() == before).then_some(RawGuide {
        pin,
        slider,
        on,
        line,
        through,
        angle,
        slid: false,
        offset,
        centre,
        radius,
        length,
        contact: false,
        span: node.span,
    })
}

/// Reads a point by its name or by coordinates.
fn through(f: &Fields, faults: &mut Faults) -> Option<RawThrough> {
    f.get("through").and_then(|n| match &n.kind {
        NodeKind::Array(_) => {
            two_quantities(n, "\"through\"", faults).map(|xy| RawThrough::At(xy, n.span))
        }
        NodeKind::Text(_)
        | NodeKind::Number(_)
        | NodeKind::Bool(_)
        | NodeKind::Null
        | NodeKind::Object(_) => word(n, "\"through\"", faults).map(RawThrough::Point),
    })
}

fn paper(node: &Node, faults: &mut Faults) -> RawPaper {
    let Some(f) = Fields::open(node, "\"paper\"", keys::PAPER, faults) else {
        return RawPaper::default();
    };
    let size = f.get("size").and_then(|n| match &n.kind {
        NodeKind::Array(_) => two_quantities(n, "\"size\"", faults).map(RawSize::Sides),
        _ => word(n, "\"size\"", faults).map(RawSize::Named),
    });
    let mut value = |key: &str| f.get(key).and_then(|n| quantity(n, &format!("\"{key}\""), faults));
    RawPaper {
        size,
        mu_l: value("mu_l"),
        mu_v: value("mu_v"),
        mu_a: value("mu_a"),
        mu_f: value("mu_F"),
        pencil: value("pencil"),
    }
}

/// Returns the members of one section, undecoded; empty if there is no such object.
pub(super) fn members_of<'a>(root: &'a Node, section: &str) -> &'a [(Word, Node)] {
    let NodeKind::Object(members) = &root.kind else { return &[] };
    match members.iter().find(|(key, _)| key.text == section) {
        Some((_, Node { kind: NodeKind::Object(inner), .. })) => inner,
        _ => &[],
    }
}

/// Returns the language that the scene names, if it is a known one.
pub(super) fn language_of(root: &Node) -> Option<Lang> {
    let NodeKind::Object(members) = &root.kind else { return None };
    match &members.iter().find(|(key, _)| key.text == "language")?.1.kind {
        NodeKind::Text(name) => Lang::named(name),
        NodeKind::Number(_)
        | NodeKind::Bool(_)
        | NodeKind::Null
        | NodeKind::Array(_)
        | NodeKind::Object(_) => None,
    }
}

/// Reads a number or an expression in quotation marks.
pub(super) fn quantity(
    node: &Node,
    what: impl Into<FaultSubject>,
    faults: &mut Faults,
) -> Option<RawQuantity> {
    let (text, bare) = match &node.kind {
        NodeKind::Number(text) => (text.clone(), true),
        NodeKind::Text(_) => (written(node, what, faults)?, false),
        _ => {
            return wrong(node, what, both!("a quantity such as \"100 mm\""), faults);
        }
    };
    Some(RawQuantity { text, span: node.span, bare })
}

/// Returns the text of an expression within the limit of length.
fn written(node: &Node, what: impl Into<FaultSubject>, faults: &mut Faults) -> Option<String> {
    let text = word(node, what, faults)?.text;
    let Err(d) = expr::bounded(&text) else { return Some(text) };
    let Span { start, end } = node.span;
    // Places count from after the quotation mark; a string with escapes has no such correspondence.
    let inner = d
        .span
        .filter(|_| end - start == text.len() + 2)
        .map(|s| Span::new(start + 1 + s.start, start + 1 + s.end));
    faults.push(d.at(inner.unwrap_or(node.span)));
    None
}

/// Reads two quantities, such as coordinates.
pub(super) fn two_quantities(
    node: &Node,
    what: impl Into<FaultSubject>,
    faults: &mut Faults,
) -> Option<[RawQuantity; 2]> {
    let what = what.into();
    match list(node, &what, faults)? {
        [a, b] => {
            let (a, b) = (quantity(a, &what, faults), quantity(b, &what, faults));
            Some([a?, b?])
        }
        items => {
            let d = Diagnostic::error(
                "wrong-count",
                both!("{} has two values, this has {}", what, items.len()),
            )
            .at(node.span);
            faults.push(d.help(both!("write [x, y]")));
            None
        }
    }
}
