//! Implied data of a scene with cams: the second point of a turning cam, the line of a lever with a
//! face, the point of a sliding face.

use super::super::raw::{RawGuide, RawLink, RawQuantity, RawScene, RawThrough};
use super::pairs::fresh;
use super::raw::*;
use hodograph_base::json::Word;

/// Adds the implied data. A turning cam with one point gets a second one on its base circle, by
/// which its angle is measured; so does a lever with a flat face moved by a law. A face without a
/// place passes through the pin of the guide in which its follower slides.
pub(crate) fn marked(raw: &RawScene) -> RawScene {
    let mut out = raw.clone();
    (0..out.cams.len()).for_each(|i| slid(&mut out, i));
    for (i, cam) in raw.cams.iter().enumerate() {
        let radius = match &cam.profile {
            RawProfile::Law { base, .. } => Some(base),
            RawProfile::Parts(parts) => parts.iter().find_map(|p| match p {
                RawPart::Circle { radius, .. } => Some(radius),
                RawPart::Corner(_) | RawPart::Tangent(_) | RawPart::Flank(_) => None,
            }),
            RawProfile::Untold => None,
        };
        // A driver of the lever needs a line of it, and so does the side on which the lever touches
        // the cam.
        let driven = match &cam.profile {
            RawProfile::Law { .. } => true,
            RawProfile::Parts(_) => {
                matches!(&cam.follows, RawFollows::Face(f) if f.line.is_none() && f.angle.is_none())
            }
            RawProfile::Untold => false,
        };
        let lever = driven
            && matches!(cam.follows, RawFollows::Face(_))
            && !raw.guides.iter().any(|g| named(&g.slider, &cam.follower.text));
        // A sliding link has the direction of its guide.
        let still = named(&raw.ground, &cam.cam.text)
            || raw.guides.iter().any(|g| named(&g.slider, &cam.cam.text));
        for (link, proposed) in
            [(Some(&cam.cam).filter(|_| !still), "M"), (Some(&cam.follower).filter(|_| lever), "W")]
        {
            let (Some(link), Some(radius)) = (link, radius) else { continue };
            let name = fresh(&out, &[proposed]);
            let Some(found) =
                out.links.iter_mut().find(|l| l.name.text == link.text && l.points.len() == 1)
            else {
                continue;
            };
            let pair = format!("{},{name}", found.points[0].text);
            found.points.push(Word { text: name, span: cam.span });
            out.lengths.push((Word { text: pair.clone(), span: cam.span }, radius.clone()));
            if let (RawFollows::Face(face), "W") = (&mut out.cams[i].follows, proposed) {
                face.line.get_or_insert(Word { text: pair, span: cam.span });
            }
        }
    }
    out
}

/// Gives the face of a sliding follower its point, the pin of the follower's only guide, and its
/// direction, perpendicular to that guide. A guide without a pin gets one; without other data, its
/// line passes through the origin.
fn slid(raw: &mut RawScene, index: usize) {
    let cam = &raw.cams[index];
    let RawFollows::Face(face) = &cam.follows else { return };
    let named_point = face.through.is_some();
    if named_point && (face.line.is_some() || face.angle.is_some()) {
        return;
    }
    let mine = |g: &RawGuide| named(&g.slider, &cam.follower.text);
    let mut guides = raw.guides.iter().enumerate().filter(|(_, g)| mine(g));
    let (Some((i, guide)), None) = (guides.next(), guides.next()) else { return };
    let (span, follower) = (cam.span, cam.follower.clone());
    let pin = guide.pin.clone().unwrap_or_else(|| Word { text: fresh(raw, &["F"]), span });
    let guide = &mut raw.guides[i];
    let grounded =
        guide.on.as_ref().is_none_or(|on| raw.ground.as_ref().is_some_and(|g| g.text == on.text));
    // A bare number has the unit of the scene's angles, which a sum with degrees would lose.
    let unit = raw
        .units
        .iter()
        .find(|(key, _)| key.text == "angle")
        .map_or("", |(_, unit)| unit.text.as_str());
    let square = guide.angle.as_ref().map(|q| {
        let text = if q.bare {
            format!("({} {unit})+90 deg", q.text)
        } else {
            format!("({})+90 deg", q.text)
        };
        RawQuantity { text, span, bare: false }
    });
    if guide.pin.is_none() && !named_point {
        guide.pin = Some(pin.clone());
        if guide.through.is_none() && guide.line.is_none() && grounded {
            let zero = || RawQuantity { text: "0 m".into(), span, bare: false };
            guide.through = Some(RawThrough::At([zero(), zero()], span));
        }
        match raw.links.iter_mut().find(|l| l.name.text == follower.text) {
            Some(link) => link.points.push(pin.clone()),
            None => raw.links.push(RawLink { name: follower, points: vec![pin.clone()] }),
        }
    }
    if let RawFollows::Face(face) = &mut raw.cams[index].follows {
        if !named_point {
            face.through = Some(RawThrough::Point(pin));
        }
        if face.line.is_none() && face.angle.is_none() {
            // The positive sense of the guide is the rise: the cam is behind the face.
            face.square = !grounded;
            face.angle = square.filter(|_| grounded);
            face.left = face.left.or((face.square || face.angle.is_some()).then_some(true));
        }
    }
}

pub(super) fn named(word: &Option<Word>, text: &str) -> bool {
    word.as_ref().is_some_and(|w| w.text == text)
}
