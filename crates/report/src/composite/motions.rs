//! The three motions of a composite motion by name: absolute, relative, transport.

use super::CompositeWords;
use crate::writing::PointForm;
use hodograph_base::lang::{say, tr};
use hodograph_methods::composite::{FrameChoice, name_of};
use hodograph_paper::paper::phrase::Phrase;
use hodograph_scene::quantity::Frame;
use hodograph_scene::{Guide, GuidePath, LinkId, PointId};

/// The three motions of a choice in words, and the point of the frame at the moving point.
pub(super) struct ThreeMotions {
    /// The motion of the point, seen from the ground.
    pub absolute: String,
    /// The motion of the point, seen from the frame.
    pub relative: String,
    /// The motion of the frame.
    pub transport: String,
    /// The point of the frame that coincides with the moving point.
    pub carried: String,
}

impl CompositeWords<'_> {
    /// Returns the three motions by name:
    /// `Absolute motion: a circle about A; relative motion: ...; transport motion: rotation about C;
    /// transport point: ...`.
    pub fn three_motions(&self, c: &FrameChoice) -> Phrase {
        let ThreeMotions { absolute, relative, transport, carried } =
            self.motions(c, PointForm::Marked);
        Phrase::new(&say!(
            self.lang,
            "Absolute motion: {absolute}; relative motion: {relative}; transport motion: {transport}; transport point: {carried}"
        ))
    }

    /// Returns the motions of a choice in words.
    pub(super) fn motions(&self, c: &FrameChoice, writing: PointForm) -> ThreeMotions {
        let (scene, lang) = (self.scene, self.lang);
        let ground = &scene.links[scene.ground.0].points;
        let pivot = |l: LinkId| {
            scene.links[l.0]
                .points
                .iter()
                .find(|p| ground.contains(p))
                .map(|p| writing.point(scene.point_name(*p)))
        };
        let slides = |g: &Guide, l: Option<LinkId>, p: Option<PointId>| {
            g.on == scene.ground
                && matches!(g.path, GuidePath::Line { .. })
                && (l.is_some() && g.slider == l || p.is_some() && g.pin == p)
        };
        let own = c.of.link.or_else(|| scene.mover(c.of.point));
        let straight = scene.guides.iter().any(|g| slides(g, own, Some(c.of.point)));
        let absolute = match own.and_then(pivot) {
            _ if straight => tr!(lang, "a straight line").to_owned(),
            Some(centre) => say!(lang, "a circle about {centre}"),
            None => tr!(lang, "a plane curve").to_owned(),
        };
        let transport = match c.frame {
            Frame::Point(_) => tr!(lang, "translation").to_owned(),
            Frame::Link(l) => match pivot(l) {
                Some(at) => say!(lang, "rotation about {at}"),
                None if scene.guides.iter().any(|g| slides(g, Some(l), None)) => {
                    tr!(lang, "translation").to_owned()
                }
                None => tr!(lang, "plane motion").to_owned(),
            },
        };
        let relative = self.path(c, writing);
        let relative = relative
            .split_once([':', '：'])
            .map_or_else(|| tr!(lang, "not known").to_owned(), |(_, path)| path.trim().to_owned());
        let point = writing.point(&name_of(scene, &c.of));
        let frame = self.frame(c.frame, writing);
        let carried = match c.frame {
            Frame::Link(_) => say!(lang, "the point of {frame} that coincides with {point}"),
            Frame::Point(_) => say!(lang, "any point of the frame, which is {frame}"),
        };
        ThreeMotions { absolute, relative, transport, carried }
    }
}
