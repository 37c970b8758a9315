//! Drivers: a link that turns, a pin or a block that slides, a cylinder.

use super::super::keys;
use super::super::raw::*;
use super::law::differentiated;
use super::{quantity, words};
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::json::Node;
use hodograph_base::json::fields::{Fields, object, suggest, word};
use hodograph_base::lang::each;

/// The three kinds of driver: the key that determines the kind, its name, all its keys.
const KINDS: [(&str, [&str; 2], &[&str]); 3] = [
    ("link", each!("a turning driver"), keys::TURN),
    ("slide", each!("a sliding driver"), keys::SLIDE),
    ("cylinder", each!("a cylinder"), keys::CYLINDER),
];

fn words_of([en, zh]: [&str; 2]) -> Both {
    Both { en: en.to_owned(), zh: zh.to_owned() }
}

pub(super) fn driver(node: &Node, raw: &RawScene, faults: &mut Faults) -> Option<RawDriver> {
    let extent = raw.extent;
    let members = object(node, both!("a driver"), faults)?;
    let present: Vec<_> =
        KINDS.iter().filter(|(mark, ..)| members.iter().any(|(k, _)| k.text == *mark)).collect();
    let (mark, what, known) = match present.as_slice() {
        [one] => **one,
        [] => {
            let d = Diagnostic::error(
                "driver-kind",
                both!("a driver says neither `link`, nor `slide`, nor `cylinder`"),
            )
            .at(node.span);
            let near = members
                .iter()
                .map(|(k, _)| suggest(&k.text, KINDS.iter().map(|k| k.0), Both::default()))
                .find(|s| s.en.starts_with("did"));
            faults.push(d.help(near.unwrap_or_else(|| {
                both!(
                    "name the turning \"link\", the pin that is to \"slide\", or the ends of the \"cylinder\""
                )
            })));
            return None;
        }
        many => {
            let marks: Vec<_> = many.iter().map(|(mark, ..)| format!("`{mark}`")).collect();
            let d = Diagnostic::error(
                "driver-kind",
                both!(
                    "one driver mixes {}",
                    Both { en: marks.join(" and "), zh: marks.join("、") }
                ),
            )
            .at(node.span);
            faults.push(d.help(both!(
                "give a list of drivers, one for each: \"driver\": [{{...}}, {{...}}]"
            )));
            return None;
        }
    };
    // A key of another kind is not a misspelling, so it gets its own message instead of the nearest
    // key.
    let mut mixed = false;
    for (key, _) in members {
        if known.contains(&key.text.as_str()) {
            continue;
        }
        if let Some(&(_, other, _)) =
            KINDS.iter().find(|(.., keys)| keys.contains(&key.text.as_str()))
        {
            let d = Diagnostic::error(
                "driver-kind",
                both!("`{}` belongs to {}, this is {}", key.text, words_of(other), words_of(what)),
            )
            .at(key.span);
            faults.push(d.help(both!("the keys of {} are {}", words_of(what), Both::names(known))));
            mixed = true;
        }
    }
    let all: Vec<&str> = KINDS.iter().flat_map(|(.., keys)| keys.iter().copied()).collect();
    let f = Fields::open(node, words_of(what), if mixed { &all } else { known }, faults)?;
    let (key, example) = match mark {
        "link" => ("omega", "\"10 rad/s\""),
        "slide" => ("velocity", "\"2 m/s\""),
        _ => ("rate", "\"50 mm/s\""),
    };
    let value = |key: &str, faults: &mut Faults| {
        f.get(key).and_then(|n| quantity(n, &format!("\"{key}\""), faults))
    };
    let second = if mark == "link" { "alpha" } else { "acceleration" };
    let mut acceleration = value(second, faults);
    let [angle, position, length] = ["angle", "position", "length"].map(|key| value(key, faults));
    let position_told = [&angle, &position, &length].into_iter().flatten().next();
    let (rate, law) = match position_told.filter(|q| f.get(key).is_none() && raw.moves_by(q)) {
        // A position that is a law of time gives the rates too, unless the file does.
        Some(q) => {
            if let Some(node) = f.get(second) {
                let message = both!("the position is a law of time, which says `{second}` already");
                let help = both!("leave `{second}` out, or add `{key}`");
                faults.push(Diagnostic::error("given-twice", message).at(node.span).help(help));
            }
            let (rate, of_law, law) = differentiated(q, raw, faults)?
                .of_driver(if mark == "link" { "rad/s" } else { "m/s" }, f.span());
            acceleration = of_law;
            (rate, law)
        }
        None => {
            let rate = if extent.is_at_rest() { f.get(key) } else { f.need(key, example, faults) };
            (rate.and_then(|n| quantity(n, both!("the rate of a driver"), faults)), None)
        }
    };
    // A name that could not be read does not count as absent.
    let before = faults.list.len();
    let mut name = |key: &str| f.get(key).and_then(|n| word(n, &format!("\"{key}\""), faults));
    let kind = match mark {
        "link" => {
            let (link, against, line, against_line) =
                (name("link"), name("against"), name("line"), name("against_line"));
            RawDriverKind::Turn { link: link?, against, line, against_line, angle }
        }
        "slide" => RawDriverKind::Slide { slide: name("slide")?, position },
        _ => RawDriverKind::Cylinder {
            ends: name("cylinder")?,
            length,
            links: words(f.get("links"), both!("\"links\" of a cylinder"), faults),
        },
    };
    (faults.list.len() == before).then_some(())?;
    Some(RawDriver { kind, rate, acceleration, law, span: f.span() })
}

/// Returns a driver for a scene without one: the first link with a pin on the ground, else the
/// first that slides on the ground.
pub(super) fn added(raw: &RawScene) -> Option<RawDriver> {
    let ground = raw.ground.as_ref()?;
    let fixed: Vec<&str> = raw
        .links
        .iter()
        .filter(|l| l.name.text == ground.text)
        .flat_map(|l| &l.points)
        .map(|p| p.text.as_str())
        .collect();
    let pinned = raw
        .links
        .iter()
        .filter(|l| l.name.text != ground.text)
        .find(|l| l.points.iter().any(|p| fixed.contains(&p.text.as_str())));
    let slides = || {
        let on_ground =
            raw.guides.iter().filter(|g| g.on.as_ref().is_none_or(|on| on.text == ground.text));
        on_ground.filter_map(|g| g.pin.as_ref().or(g.slider.as_ref())).next()
    };
    let kind = match pinned {
        Some(link) => RawDriverKind::Turn {
            link: link.name.clone(),
            against: None,
            line: None,
            against_line: None,
            angle: None,
        },
        None => RawDriverKind::Slide { slide: slides()?.clone(), position: None },
    };
    Some(RawDriver { kind, rate: None, acceleration: None, law: None, span: ground.span })
}
