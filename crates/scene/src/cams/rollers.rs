//! Rollers that are links of the file.
//!
//! Books number the roller, count it with its local degree of freedom 局部自由度, and then solve the
//! mechanism with the roller fixed to the follower. Accordingly, the roller is a link in a mobility
//! count; otherwise it is not, and its angular velocity is that of rolling on the cam.

use super::super::raw::{RawDriverKind, RawLink, RawScene, RequiredData};
use super::marked::named;
use super::raw::RawFollows;
use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_base::json::Word;

/// Returns the roller that is named as a separate link: by the pair, or as a link whose only point
/// is the roller's pin.
fn link_of(raw: &RawScene, follows: &RawFollows) -> Option<Word> {
    let RawFollows::Roller { pin, link, .. } = follows else { return None };
    let alone = |l: &&RawLink| {
        matches!(&l.points[..], [p] if p.text == pin.text) && !is_used(raw, &l.name.text)
    };
    link.clone().or_else(|| raw.links.iter().find(alone).map(|l| l.name.clone()))
}

/// Returns true if a section other than the links names a link.
fn is_used(raw: &RawScene, link: &str) -> bool {
    let of = |w: &Option<Word>| named(w, link);
    of(&raw.ground)
        || raw.cams.iter().any(|c| c.cam.text == link || c.follower.text == link)
        || raw.guides.iter().any(|g| of(&g.slider) || of(&g.on))
        || raw.rolling.iter().any(|r| r.sides.iter().any(|s| of(&s.link)))
        || raw.drivers.iter().any(|d| match &d.kind {
            RawDriverKind::Turn { link: turned, against, .. } => turned.text == link || of(against),
            RawDriverKind::Slide { slide, .. } => slide.text == link,
            RawDriverKind::Cylinder { links, .. } => links.iter().any(|l| l.text == link),
        })
}

/// Returns the scene with the rollers as links for a mobility count. Otherwise the rollers are
/// removed, each cam has the name of its roller, and questions for their angular velocities become
/// questions for rollers.
pub(crate) fn settled(raw: &RawScene, faults: &mut Faults) -> RawScene {
    let mut out = raw.clone();
    for (i, cam) in raw.cams.iter().enumerate() {
        let (Some(name), Some(pin)) = (link_of(raw, &cam.follows), cam.follows.pin()) else {
            continue;
        };
        let declared = raw.links.iter().find(|l| l.name.text == name.text);
        if declared.is_some_and(|l| l.points.len() != 1 || l.points[0].text != pin.text)
            || is_used(raw, &name.text)
        {
            let d = Diagnostic::error("roller-link", both!("link `{}` is no roller", name.text))
                .at(name.span);
            faults.push(d.help(both!(
                "the link of a roller has its centre `{}` and no other point, and nothing else is said of it",
                pin.text
            )));
            continue;
        }
        if raw.extent == RequiredData::Pairs {
            if declared.is_none() {
                out.links.push(RawLink { name, points: vec![pin.clone()] });
            }
            continue;
        }
        out.links.retain(|l| l.name.text != name.text);
        if let RawFollows::Roller { link, .. } = &mut out.cams[i].follows {
            *link = Some(name.clone());
        }
        let asked = format!("omega_{}", name.text);
        for word in out.find.iter_mut().flatten().filter(|w| w.text == asked) {
            word.text = format!("spin_{}", cam.follower.text);
        }
    }
    out
}
