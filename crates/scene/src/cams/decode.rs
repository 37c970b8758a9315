//! JSON to the raw section `cams`.

use super::super::decode::{items, quantity, two_quantities};
use super::super::keys;
use super::super::raw::{RawQuantity, RawThrough, RequiredData};
use super::raw::*;
use hodograph_base::cam::MotionLaw;
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::json::fields::{Fields, suggest, word, wrong};
use hodograph_base::json::{Node, NodeKind, Word};

/// Decodes one cam; a mobility count needs neither profile nor radius. Returns `None` if a
/// member could not be read, so that the remaining members are not judged alone.
pub(crate) fn cam(node: &Node, extent: RequiredData, faults: &mut Faults) -> Option<RawCam> {
    let before = faults.list.len();
    let f = Fields::open(node, both!("a cam"), keys::CAM, faults)?;
    let cam = f.need("cam", both!("\"2\", the link that is the cam"), faults);
    let follower = f.need("follower", both!("\"3\", the link that it moves"), faults);
    let counted = extent.is_of_pairs();
    let profile = if counted {
        f.get("profile")
    } else {
        f.need("profile", "{\"centre\": \"B\", \"radius\": \"30 mm\"}", faults)
    };
    let cam = cam.and_then(|n| word(n, "\"cam\"", faults));
    let follower = follower.and_then(|n| word(n, "\"follower\"", faults));
    let follows = follows(&f, counted, faults);
    let profile = match profile {
        Some(n) => self::profile(n, faults),
        None => counted.then_some(RawProfile::Untold),
    };
    let at = f.get("at").and_then(|n| word(n, "\"at\"", faults));
    let angle = f.get("angle").and_then(|n| quantity(n, "\"angle\"", faults));
    let whole = faults.list.len() == before;
    let cam = RawCam {
        cam: cam?,
        follower: follower?,
        follows: follows?,
        profile: profile?,
        at,
        angle,
        span: node.span,
    };
    whole.then_some(cam)
}

/// Decodes the contact element of the follower: one of four keys.
fn follows(f: &Fields, counted: bool, faults: &mut Faults) -> Option<RawFollows> {
    let kinds = ["edge", "roller", "arc", "face"];
    let given: Vec<&str> = kinds.into_iter().filter(|k| f.get(k).is_some()).collect();
    let [kind] = given.as_slice() else {
        let (message, help) = match given.is_empty() {
            true => (
                both!("nothing says with what the follower touches the cam"),
                both!(
                    "add \"edge\": \"B\", \"roller\": {{\"pin\": \"B\", \"radius\": \"10 mm\"}}, \"arc\" or \"face\""
                ),
            ),
            false => (
                both!(
                    "the follower touches the cam in {} ways: {}",
                    given.len(),
                    Both::names(&given)
                ),
                both!("keep one of them; each contact is a cam of its own in the list"),
            ),
        };
        faults.push(Diagnostic::error("cam-follower", message).at(f.span()).help(help));
        return None;
    };
    let node = f.get(kind)?;
    match *kind {
        "edge" => word(node, "\"edge\"", faults).map(RawFollows::Edge),
        "face" => face(node, faults).map(RawFollows::Face),
        _ => {
            let known = if *kind == "roller" { keys::ROLLER } else { keys::ARC };
            let f = Fields::open(node, format!("\"{kind}\"").as_str(), known, faults)?;
            let pin = f.need("pin", "\"B\"", faults).and_then(|n| word(n, "\"pin\"", faults));
            let radius =
                if counted { f.get("radius") } else { f.need("radius", "\"10 mm\"", faults) };
            let radius = match radius {
                Some(n) => Some(quantity(n, "\"radius\"", faults)?),
                None => None,
            };
            let link = f.get("link").and_then(|n| word(n, "\"link\"", faults));
            let pin = pin?;
            Some(if *kind == "roller" {
                RawFollows::Roller { pin, radius, link }
            } else {
                RawFollows::Arc { pin, radius }
            })
        }
    }
}

fn face(node: &Node, faults: &mut Faults) -> Option<RawFace> {
    let f = Fields::open(node, "\"face\"", keys::FACE, faults)?;
    let through = f.get("through").and_then(|n| match &n.kind {
        NodeKind::Array(_) => {
            two_quantities(n, "\"through\"", faults).map(|xy| RawThrough::At(xy, n.span))
        }
        _ => word(n, "\"through\"", faults).map(RawThrough::Point),
    });
    let line = f.get("line").and_then(|n| word(n, "\"line\"", faults));
    let mut value = |key: &str| f.get(key).and_then(|n| quantity(n, &format!("\"{key}\""), faults));
    let (angle, offset) = (value("angle"), value("offset"));
    let left = f
        .get("cam")
        .and_then(|n| word(n, "\"cam\"", faults))
        .and_then(|w| one_of(&w, ["left", "right"], faults))
        .map(|k| k == 0);
    Some(RawFace { through, line, angle, square: false, offset, left })
}

/// Returns the index of the word among two.
fn one_of(said: &Word, words: [&str; 2], faults: &mut Faults) -> Option<usize> {
    let found = words.iter().position(|w| *w == said.text);
    if found.is_none() {
        let d = Diagnostic::error("unknown-word", both!("`{}` is not understood here", said.text))
            .at(said.span);
        faults.push(d.help(both!("write \"{}\" or \"{}\"", words[0], words[1])));
    }
    found
}

fn profile(node: &Node, faults: &mut Faults) -> Option<RawProfile> {
    let law = matches!(&node.kind, NodeKind::Object(m) if m.iter().any(|(k, _)| k.text == "law" || k.text == "base"));
    if law {
        let f = Fields::open(node, both!("a profile by a law"), keys::CAM_LAW, faults)?;
        let base = f.need("base", both!("\"30 mm\", the radius of the base circle"), faults);
        let base = base.and_then(|n| quantity(n, "\"base\"", faults));
        let start = f.get("start").and_then(|n| quantity(n, "\"start\"", faults));
        let turns = f.get("turns").and_then(|n| word(n, "\"turns\"", faults));
        let clockwise = turns
            .and_then(|w| one_of(&w, ["counter-clockwise", "clockwise"], faults))
            .is_some_and(|k| k == 1);
        let list = f.need(
            "law",
            "[{\"rise\": \"20 mm\", \"over\": \"120 deg\", \"law\": \"cycloidal\"}, ...]",
            faults,
        );
        let stages =
            items(list, "\"law\"", faults).iter().filter_map(|n| stage(n, faults)).collect();
        return Some(RawProfile::Law { base: base?, start, clockwise, stages });
    }
    match &node.kind {
        NodeKind::Array(_) => Some(RawProfile::Parts(
            items(Some(node), "\"profile\"", faults)
                .iter()
                .filter_map(|n| part(n, faults))
                .collect(),
        )),
        NodeKind::Object(_) => part(node, faults).map(|p| RawProfile::Parts(vec![p])),
        NodeKind::Text(_) | NodeKind::Number(_) | NodeKind::Bool(_) | NodeKind::Null => wrong(
            node,
            "\"profile\"",
            both!("a circle, a list of arcs and lines, or a law"),
            faults,
        ),
    }
}

fn part(node: &Node, faults: &mut Faults) -> Option<RawPart> {
    if let NodeKind::Text(_) = node.kind {
        let said = word(node, "\"profile\"", faults)?;
        if said.text == "tangent" {
            return Some(RawPart::Tangent(said.span));
        }
        let d = Diagnostic::error("unknown-word", both!("`{}` is no part of a profile", said.text))
            .at(said.span);
        faults.push(d.help(both!(
            "write \"tangent\", {{\"centre\": \"Q\", \"radius\": ...}}, {{\"radius\": ...}} or {{\"corner\": \"P\"}}"
        )));
        return None;
    }
    let f = Fields::open(node, both!("a part of a profile"), keys::CAM_PART, faults)?;
    if let Some(corner) = f.get("corner") {
        return word(corner, "\"corner\"", faults).map(RawPart::Corner);
    }
    let centre = f.get("centre").map(|n| word(n, "\"centre\"", faults));
    let radius =
        f.need("radius", "\"30 mm\"", faults).and_then(|n| quantity(n, "\"radius\"", faults));
    match centre {
        None => radius.map(RawPart::Flank),
        Some(centre) => Some(RawPart::Circle { centre: centre?, radius: radius? }),
    }
}

fn stage(node: &Node, faults: &mut Faults) -> Option<RawStage> {
    let f = Fields::open(node, both!("a stage of the law"), keys::CAM_STAGE, faults)?;
    let kinds = ["rise", "dwell", "return"];
    let given: Vec<&str> = kinds.into_iter().filter(|k| f.get(k).is_some()).collect();
    let [kind] = given.as_slice() else {
        let message = both!("a stage is one of `rise`, `dwell`, `return`");
        let d = Diagnostic::error("cam-law", message).at(node.span);
        faults.push(d.help(both!(
            "write {{\"rise\": \"20 mm\", \"over\": \"120 deg\", \"law\": \"cycloidal\"}} or {{\"dwell\": \"60 deg\"}}"
        )));
        return None;
    };
    let value = f.get(kind).and_then(|n| quantity(n, format!("\"{kind}\"").as_str(), faults));
    if *kind == "dwell" {
        return Some(RawStage { way: RawWay::Dwell, over: value? });
    }
    let over = f.need("over", "\"120 deg\"", faults).and_then(|n| quantity(n, "\"over\"", faults));
    let law = f.need("law", "\"cycloidal\"", faults).and_then(|n| word(n, "\"law\"", faults));
    let law = law.and_then(|w| known_law(w, faults));
    let (value, over, law): (RawQuantity, RawQuantity, Word) = (value?, over?, law?);
    let way = if *kind == "rise" { RawWay::Rise(value, law) } else { RawWay::Return(value, law) };
    Some(RawStage { way, over })
}

fn known_law(said: Word, faults: &mut Faults) -> Option<Word> {
    if MotionLaw::named(&said.text).is_some() {
        return Some(said);
    }
    let otherwise: Both = both!("the laws are");
    let d =
        Diagnostic::error("unknown-law", both!("`{}` is no motion law", said.text)).at(said.span);
    faults.push(d.help(suggest(&said.text, MotionLaw::ALL.iter().map(|l| l.name()), otherwise)));
    None
}
