//! The section `composite`: moving points and frames by their names.

use super::*;
use crate::cams::raw::RawCam;
use crate::quantity::Frame;
use crate::quantity::composite::unusable;

/// Resolves the moving points and frames. [`judged`] checks later whether the frames are usable.
pub(super) fn composite(c: &Context, faults: &mut Faults) -> Vec<ObservedPoint> {
    let mut out: Vec<ObservedPoint> = Vec::new();
    for raw in &c.raw.composite {
        if let Some(cam) = contact(c, &raw.point.text) {
            out.extend(at_contact(c, raw, cam, faults));
            continue;
        }
        let Some((of, frame)) =
            note(c.names.seen_from(&raw.point.text, &raw.frame.text, &raw.point), faults)
        else {
            continue;
        };
        let link = raw.on.as_ref().map(|on| c.names.link(on));
        let link = match link {
            Some(link) => match note(link, faults) {
                Some(link) => Some(link),
                None => continue,
            },
            None => of.link,
        };
        // A point of a link that carries it is the pin itself.
        let of = OnLink { point: of.point, link: link.filter(|l| !c.carries(*l, of.point)) };
        let of = CompositePoint::Point(of);
        if out.iter().any(|s| s.of == of && s.frame == frame) {
            let text = format!("{}/{}", raw.point.text, raw.frame.text);
            faults.push(
                Diagnostic::warning("given-twice", both!("`{text}` is given twice")).at(raw.span),
            );
            continue;
        }
        out.push(ObservedPoint { of, frame, span: raw.span });
    }
    out
}

/// Returns the cam whose contact has this name; the contact is not a point of the scene.
fn contact(c: &Context, name: &str) -> Option<usize> {
    let named = |cam: &RawCam| cam.at.as_ref().is_some_and(|w| w.text == name);
    c.raw.cams.iter().position(named).filter(|_| !c.names.points.iter().any(|p| p.name == name))
}

/// Resolves the point of cam or follower at their contact; the default is the follower's point.
fn at_contact(
    c: &Context,
    raw: &RawComposite,
    cam: usize,
    faults: &mut Faults,
) -> Option<ObservedPoint> {
    let pair = &c.raw.cams[cam];
    let (own, follower) =
        (note(c.names.link(&pair.cam), faults)?, note(c.names.link(&pair.follower), faults)?);
    let frame = note(c.names.frame(&raw.frame.text, &raw.frame), faults)?;
    let on = match &raw.on {
        Some(word) => note(c.names.link(word), faults)?,
        None => follower,
    };
    if on != own && on != follower {
        let (e, a, b) = (&raw.point.text, &pair.cam.text, &pair.follower.text);
        let message = both!("links {a} and {b} touch at {e}; link {} does not", c.link_name(on));
        faults.push(
            Diagnostic::error("not-on-link", message)
                .at(raw.span)
                .help(both!("write \"on\": \"{b}\"")),
        );
        return None;
    }
    Some(ObservedPoint { of: CompositePoint::Contact { cam, on }, frame, span: raw.span })
}

/// Reports the frames that are unusable for their moving points.
pub(super) fn judged(scene: &Scene, faults: &mut Faults) {
    for s in &scene.composite {
        match s.of {
            CompositePoint::Point(of) => {
                let text = scene.point_name(of.point).to_owned();
                unusable(scene, &of, s.frame, &text)
                    .into_iter()
                    .for_each(|d| faults.push(d.at(s.span)));
            }
            // For every point of the link: a fixed frame gives no frame motion, and the point's own
            // link no relative motion.
            CompositePoint::Contact { on, .. }
                if s.frame.is_fixed(scene) || s.frame == Frame::Link(on) =>
            {
                let (text, link) = (
                    scene.link_name(on),
                    both!(
                        "link {0} itself, or a body at rest, parts no motion of link {0}",
                        scene.link_name(on)
                    ),
                );
                let help = both!("name the other link, or the centre of the profile");
                faults.push(
                    Diagnostic::error("frame-unusable", both!("`{text}`: {}", link))
                        .at(s.span)
                        .help(help),
                );
            }
            CompositePoint::Contact { .. } => {}
        }
    }
}
