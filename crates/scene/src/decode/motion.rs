//! The sections `time` and `motions`: a point that moves on a link by a law of time becomes a guide
//! and a driver of its pin at the instant.

use super::super::front::TIME;
use super::super::keys;
use super::super::raw::*;
use super::law::differentiated;
use super::quantity;
use hodograph_base::diag::{Diagnostic, Faults, Span, both};
use hodograph_base::json::fields::{Fields, word};
use hodograph_base::json::{Node, Word};

/// Returns the instant, as a parameter.
pub(super) fn time(node: &Node, faults: &mut Faults) -> Option<(Word, RawQuantity)> {
    quantity(node, "\"time\"", faults).map(|q| (Word { text: TIME.to_owned(), span: node.span }, q))
}

/// Decodes one motion: adds its guide and its driver.
pub(super) fn motion(node: &Node, raw: &mut RawScene, faults: &mut Faults) -> Option<()> {
    let f = Fields::open(node, both!("a motion"), keys::MOTION, faults)?;
    let point = f.need("point", "\"M\"", faults).and_then(|n| word(n, "\"point\"", faults));
    let on = f
        .need("on", both!("\"2\", the link on which it moves"), faults)
        .and_then(|n| word(n, "\"on\"", faults));
    let way = way(&f, faults);
    let s = f.need("s", "\"6 cm/s*t\"", faults).and_then(|n| quantity(n, "\"s\"", faults));
    let (point, on, way, s) = (point?, on?, way?, s?);
    let names: Vec<&str> = raw.parameters.iter().map(|(name, _)| name.text.as_str()).collect();
    if !names.contains(&TIME) {
        let message = both!("a law of time needs the instant");
        faults.push(
            Diagnostic::error("missing-key", message)
                .at(node.span)
                .help(both!("add \"time\": \"1 s\"")),
        );
        return None;
    }
    let (rate, acceleration, law) = differentiated(&s, raw, faults)?.of_driver("m/s", node.span);
    let given = |text: String| RawQuantity { text, span: s.span, bare: false };
    let slider = Some(Word { text: free_name(raw), span: point.span });
    let blank = RawGuide { slider, ..RawGuide::of_pin(point.clone(), on, node.span) };
    let (guide, position) = match way {
        PathShape::Line(line) => {
            let through = first(raw, &line).map(RawThrough::Point);
            (RawGuide { line: Some(line), through, ..blank }, s.clone())
        }
        PathShape::Arc { centre, radius, from } => {
            // On an arc, the position is measured from the direction of the link that carries it.
            let position = match from {
                Some(from) => given(format!(
                    "({})+{}*{}",
                    s.text,
                    bracketed_text(raw, "length", &radius),
                    bracketed_text(raw, "angle", &from)
                )),
                None => s.clone(),
            };
            (RawGuide { centre: Some(centre), radius: Some(radius), ..blank }, position)
        }
    };
    raw.guides.push(guide);
    raw.drivers.push(RawDriver {
        kind: RawDriverKind::Slide { slide: point, position: Some(position) },
        rate,
        acceleration,
        law,
        span: node.span,
    });
    Some(())
}

/// The path of a moving point on its link.
enum PathShape {
    /// A straight line from one point of the link toward another.
    Line(Word),
    /// An arc about a point of the link, counter-clockwise, from this angle to the link's
    /// direction.
    Arc { centre: Word, radius: RawQuantity, from: Option<RawQuantity> },
}

fn way(f: &Fields, faults: &mut Faults) -> Option<PathShape> {
    let Some(centre) = f.get("centre") else {
        for key in ["radius", "angle"] {
            if let Some(node) = f.get(key) {
                let message = both!("only a motion on an arc about a `centre` has `{key}`");
                faults.push(
                    Diagnostic::error("motion", message)
                        .at(node.span)
                        .help(both!("add \"centre\": \"C\", or leave it away")),
                );
                return None;
            }
        }
        let example = both!("\"AB\", from which point toward which; or \"centre\" and \"radius\"");
        return f
            .need("line", example, faults)
            .and_then(|n| word(n, "\"line\"", faults))
            .map(PathShape::Line);
    };
    if let Some(line) = f.get("line") {
        let message = both!("a motion is along a `line` or about a `centre`, not both");
        faults.push(
            Diagnostic::error("motion", message).at(line.span).help(both!("keep one of the two")),
        );
        return None;
    }
    let centre = word(centre, "\"centre\"", faults);
    let radius =
        f.need("radius", "\"60 mm\"", faults).and_then(|n| quantity(n, "\"radius\"", faults));
    let from = match f.get("angle") {
        Some(node) => Some(quantity(node, "\"angle\"", faults)?),
        None => None,
    };
    Some(PathShape::Arc { centre: centre?, radius: radius?, from })
}

/// Returns the text of a quantity within a longer expression: a bare number gets the unit of its
/// kind.
fn bracketed_text(raw: &RawScene, kind: &str, q: &RawQuantity) -> String {
    let unit = raw
        .units
        .iter()
        .find(|(key, _)| key.text == kind && q.bare)
        .map_or("", |(_, unit)| unit.text.as_str());
    format!("({} {unit})", q.text)
}

/// Returns a number that no link has, for the link whose only point is the moving one.
fn free_name(raw: &RawScene) -> String {
    let sliders = raw.guides.iter().filter_map(|g| g.slider.as_ref()).map(|w| w.text.as_str());
    let taken: Vec<&str> = raw.links.iter().map(|l| l.name.text.as_str()).chain(sliders).collect();
    (2..).map(|n| n.to_string()).find(|n| !taken.contains(&n.as_str())).unwrap_or_default()
}

/// Returns the first point of a line, as far as the points of the links determine it: the position
/// is measured from there.
fn first(raw: &RawScene, line: &Word) -> Option<Word> {
    let points = raw.links.iter().flat_map(|l| &l.points);
    let begins =
        points.filter(|p| line.text.starts_with(p.text.as_str())).max_by_key(|p| p.text.len())?;
    Some(Word { text: begins.text.clone(), span: Span::new(line.span.start, line.span.end) })
}
