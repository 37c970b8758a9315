//! A contact with a known cam and follower only: enough for a mobility count.
//!
//! For every profile, a round end runs in a slot of the cam, and for a follower with a face, a
//! point of the cam (the centre of the arc in contact) runs in a guide of the follower: each
//! removes one degree of freedom. The places of slot and guide have no effect.

use super::super::raw::{RawGuide, RawLink, RawScene};
use super::expand::{CamReplacement, Pending};
use super::pairs::fresh;
use super::raw::RawFollows;
use hodograph_base::json::Word;

impl CamReplacement<'_> {
    /// Writes the pair that replaces the contact.
    pub(super) fn replace_for_count(&self, raw: &mut RawScene, pending: &mut Pending) {
        let word = |text: &str| Word { text: text.to_owned(), span: self.raw.span };
        let (cam, follower) = (word(&self.raw.cam.text), word(&self.raw.follower.text));
        let (pin, on) = match &self.raw.follows {
            RawFollows::Face(_) => {
                let centre = word(&fresh(raw, &["K", "F", "G", "H"]));
                match raw.links.iter_mut().find(|l| l.name.text == cam.text) {
                    Some(link) => link.points.push(centre.clone()),
                    None => raw.links.push(RawLink { name: cam, points: vec![centre.clone()] }),
                }
                (centre, follower)
            }
            RawFollows::Edge(pin)
            | RawFollows::Roller { pin, .. }
            | RawFollows::Arc { pin, .. } => (pin.clone(), cam),
        };
        pending.circle = None;
        pending.disc = None;
        pending.posed = None;
        pending.contact = Some(raw.guides.len());
        raw.guides.push(RawGuide { contact: true, ..RawGuide::of_pin(pin, on, self.raw.span) });
    }
}
