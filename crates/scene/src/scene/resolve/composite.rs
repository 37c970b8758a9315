//! The section `composite`: moving points and frames by their names.

use super::*;
use crate::scene::quantity::composite::unusable;

/// The moving points and frames. Whether they serve is not decided here.
pub(super) fn composite(c: &Context, faults: &mut Faults) -> Vec<Seen> {
    let mut out: Vec<Seen> = Vec::new();
    for raw in &c.raw.composite {
        let Some((of, frame)) = note(c.names.seen_from(&raw.point.text, &raw.frame.text, &raw.point), faults) else { continue };
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
        if out.iter().any(|s| s.of == of && s.frame == frame) {
            let text = format!("{}/{}", raw.point.text, raw.frame.text);
            faults.push(Diagnostic::warning("given-twice", both!("`{text}` is given twice", "`{text}` 写了两次")).at(raw.span));
            continue;
        }
        out.push(Seen { of, frame, span: raw.span });
    }
    out
}

/// The frames that are none for their moving points.
pub(super) fn judged(scene: &Scene, faults: &mut Faults) {
    for s in &scene.composite {
        let text = scene.point_name(s.of.point).to_owned();
        unusable(scene, &s.of, s.frame, &text).into_iter().for_each(|d| faults.push(d.at(s.span)));
    }
}
