//! The section `find`: what is asked.

use super::*;

/// The quantities that can be asked, as they are written, with an example.
const QUANTITIES: [(&str, &str); 13] = [
    ("v", "v_E"),
    ("a", "a_E"),
    ("an", "an_CB"),
    ("at", "at_CB"),
    ("vr", "vr_B3B2"),
    ("ar", "ar_B3B2"),
    ("ak", "ak_B3B2"),
    ("omega", "omega_3"),
    ("alpha", "alpha_3"),
    ("x", "x_E"),
    ("y", "y_E"),
    ("phi", "phi_3"),
    ("l", "l_AB"),
];

pub(super) fn find(c: &Context, faults: &mut Faults) -> Vec<Find> {
    let mut out: Vec<Find> = Vec::new();
    let Some(words) = &c.raw.find else { return everything(c) };
    for word in words {
        let Some(what) = note(asked(c, word), faults) else { continue };
        if out.iter().any(|f| f.text == word.text) {
            let d = Diagnostic::warning("given-twice", both!("`{}` is asked twice", "`{}` 求了两次", word.text)).at(word.span);
            faults.push(d.help(both!("ask once", "请只求一次")));
            continue;
        }
        out.push(Find { what, text: word.text.clone(), span: word.span });
    }
    out
}

/// A scene that asks nothing in particular wants it all: every moving point's v and a, every moving link's ω and α.
fn everything(c: &Context) -> Vec<Find> {
    let (points, links) = (c.names.points, c.names.links);
    let mut out = Vec::new();
    let mut ask = |symbol: &str, name: &str, span, what| out.push(Find { what, text: format!("{symbol}_{name}"), span });
    for (i, p) in points.iter().enumerate() {
        let id = PointId(i);
        if !c.carries(c.ground, id) && !c.contacts.contains(&id) {
            let on = OnLink { point: id, link: None };
            ask("v", &p.name, p.span, Asked::Velocity(on));
            ask("a", &p.name, p.span, Asked::Acceleration(on));
        }
    }
    for (i, l) in links.iter().enumerate() {
        let id = LinkId(i);
        let carries_guide = c.raw.guides.iter().any(|g| g.on.as_ref().is_some_and(|w| w.text == l.name));
        let in_cylinder = c
            .raw
            .drivers
            .iter()
            .any(|d| matches!(&d.kind, RawDriverKind::Cylinder { links, .. } if links.iter().any(|w| w.text == l.name)));
        if id != c.ground && (l.points.len() >= 2 || carries_guide || in_cylinder || c.rolls(id)) {
            ask("omega", &l.name, l.span, Asked::Omega(id));
            ask("alpha", &l.name, l.span, Asked::Alpha(id));
        }
    }
    out
}

/// A symbol in Latin letters; the figures write Greek ones.
fn spelt(symbol: &str) -> &str {
    match symbol {
        "ω" => "omega",
        "α" => "alpha",
        "φ" => "phi",
        other => other,
    }
}

/// Whether a text begins as a question does: a quantity's symbol and `_`.
pub(in crate::scene) fn begins_a_question(text: &str) -> bool {
    text.split_once('_').is_some_and(|(symbol, _)| QUANTITIES.iter().any(|(s, _)| *s == spelt(symbol)))
}

fn asked(c: &Context, word: &Word) -> Result<Asked, Diagnostic> {
    let fault = |message: Both| Diagnostic::error("find", message).at(word.span);
    let Some((symbol, rest)) = word.text.split_once('_') else {
        let d = fault(both!("`{}` is not a quantity that can be asked", "`{}` 不是可求的量", word.text));
        return Err(d.help(both!(
            "write the symbol, _ and the points or links, such as v_E, a_CB, omega_3, ak_B3B2",
            "请写符号、_ 和点名或构件名，如 v_E、a_CB、omega_3、ak_B3B2"
        )));
    };
    let symbol = spelt(symbol);
    if !QUANTITIES.iter().any(|(s, _)| *s == symbol) {
        let d = fault(both!("`{symbol}` in `{}` is not a quantity that can be asked", "`{}` 中的 `{symbol}` 不是可求的量", word.text));
        return Err(d.help(suggest(symbol, QUANTITIES.iter().map(|q| q.0), both!("the quantities are", "量有"))));
    }
    Ok(match symbol {
        "omega" | "alpha" => return angular(c, word, symbol, rest),
        "phi" => {
            let link = c.names.link_in(rest, word)?;
            let guided = c.raw.guides.iter().any(|g| [&g.on, &g.slider].into_iter().flatten().any(|w| w.text == rest));
            if c.names.links[link.0].points.len() < 2 && !guided {
                return Err(fault(both!("link `{rest}` has no two points, so it has no angle", "构件 `{rest}` 没有两个点，因而没有角度")));
            }
            Asked::LinkAngle(link)
        }
        "l" => {
            let (a, b) = c.names.pair_in(rest, word)?;
            Asked::Distance(a, b)
        }
        _ if c.names.is_link_only(rest) => return Err(of_a_link(c, word, symbol, rest)),
        "x" | "y" => match c.names.on_links(rest, word)? {
            (OnLink { point, .. }, None) => {
                Asked::Coordinate(point, if symbol == "x" { crate::scene::Axis::X } else { crate::scene::Axis::Y })
            }
            _ => return Err(fault(both!("`{}` names two points; a coordinate has one", "`{}` 写了两个点；坐标只属于一个点", word.text))),
        },
        _ => match (symbol, c.names.on_links(rest, word)?) {
            ("v", (a, None)) => Asked::Velocity(a),
            ("a", (a, None)) => Asked::Acceleration(a),
            (_, (_, None)) => {
                let example = QUANTITIES.iter().find(|q| q.0 == symbol).map_or("", |q| q.1);
                return Err(fault(both!(
                    "`{}` names one point; `{symbol}` is of one point relative to another",
                    "`{}` 只写了一个点；`{symbol}` 是一点相对另一点的量",
                    word.text
                ))
                .help(both!("write for example {example}", "例如写 {example}")));
            }
            (_, (of, Some(to))) => relative(c, word, symbol, of, to)?,
        },
    })
}

/// A velocity is of a point: which points of a link can be asked, where a link is named.
fn of_a_link(c: &Context, word: &Word, symbol: &str, link: &str) -> Diagnostic {
    let d = Diagnostic::error(
        "find",
        both!("`{link}` in `{}` is a link; `{symbol}` is of a point", "`{}` 中的 `{link}` 是构件；`{symbol}` 是点的量", word.text),
    )
    .at(word.span);
    let own = c.names.links.iter().find(|l| l.name == link).map_or(&[][..], |l| &l.points);
    let own = own.iter().map(|p| format!("{symbol}_{}", c.point_name(*p)));
    // Where a pin runs in the link's guide, the link has a point at the same place.
    let pins = c.raw.guides.iter().filter(|g| g.on.as_ref().is_some_and(|on| on.text == link)).filter_map(|g| g.pin.as_ref());
    let pins = pins.map(|pin| format!("{symbol}_{}", c.names.run(&pin.text, link)));
    let all: Vec<String> = if symbol == "v" || symbol == "a" { own.chain(pins).collect() } else { own.collect() };
    d.help(if all.is_empty() { both!("name a point", "请写一个点") } else { super::super::names::written(&all) })
}

fn are_ends_of_a_cylinder(c: &Context, a: PointId, b: PointId) -> bool {
    c.raw.drivers.iter().any(|d| match &d.kind {
        RawDriverKind::Cylinder { ends, .. } => c.names.pair_in(&ends.text, ends).is_ok_and(|(p, q)| (p, q) == (a, b) || (q, p) == (a, b)),
        RawDriverKind::Turn { .. } | RawDriverKind::Slide { .. } => false,
    })
}

fn relative(c: &Context, word: &Word, symbol: &str, of: OnLink, to: OnLink) -> Result<Asked, Diagnostic> {
    let fault = |message: Both| Diagnostic::error("find", message).at(word.span);
    if of == to {
        return Err(fault(both!("`{}` is of a point relative to itself: zero", "`{}` 是一点相对自身的量，为零", word.text)));
    }
    let sliding = matches!(symbol, "vr" | "ar" | "ak");
    // The ends of a cylinder slide along their line; elsewhere sliding is at one place. There one of the two may be the pin itself:
    // vr_BB3 is the sliding of pin B on link 3.
    if sliding && of.point != to.point && !are_ends_of_a_cylinder(c, of.point, to.point) {
        let d = fault(both!("`{}`: sliding is between two links at one place", "`{}`：相对滑动是同一位置上两构件之间的", word.text));
        return Err(d.help(both!(
            "name the place twice, each time with its link: {symbol}_{0}3{0}2",
            "请两次写同一位置，各加构件名：{symbol}_{0}3{0}2",
            c.point_name(of.point)
        )));
    }
    if matches!(symbol, "an" | "at") && of.point == to.point {
        let d = fault(both!("`{}`: two links at one place have no line between them", "`{}`：重合点之间没有连线", word.text));
        return Err(d.help(both!("ask for ar_ or ak_ with {}", "请用 {} 求 ar_ 或 ak_", &word.text[3..])));
    }
    Ok(match symbol {
        "v" => Asked::RelativeVelocity(of, to),
        "a" => Asked::RelativeAcceleration(of, to),
        "an" => Asked::NormalAcceleration(of, to),
        "at" => Asked::TangentialAcceleration(of, to),
        "vr" => Asked::SlidingVelocity(of, to),
        "ar" => Asked::SlidingAcceleration(of, to),
        _ => Asked::Coriolis(of, to),
    })
}

fn angular(c: &Context, word: &Word, symbol: &str, rest: &str) -> Result<Asked, Diagnostic> {
    let fault = |message: Both| Diagnostic::error("find", message).at(word.span);
    let omega = symbol == "omega";
    if let Some((of, to)) = rest.split_once('/') {
        let (of, to) = (c.names.link_in(of.trim(), word)?, c.names.link_in(to.trim(), word)?);
        if of == to {
            return Err(fault(both!("`{}` is of a link against itself: zero", "`{}` 是构件相对自身的量，为零", word.text)));
        }
        return Ok(if omega { Asked::RelativeOmega(of, to) } else { Asked::RelativeAlpha(of, to) });
    }
    let link = c.names.link_in(rest, word)?;
    if link == c.ground {
        let d = fault(both!(
            "link `{rest}` is the ground: it does not turn, so `{}` is zero",
            "构件 `{rest}` 是机架，不转动，`{}` 为零",
            word.text
        ));
        return Err(d.help(both!("ask for a moving link", "请求活动构件的量")));
    }
    Ok(if omega { Asked::Omega(link) } else { Asked::Alpha(link) })
}
