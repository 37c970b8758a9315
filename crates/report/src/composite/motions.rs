//! The three motions of a composite motion by name: absolute, relative, transport.

use super::CompositeWords;
use crate::writing::PointForm;
use hodograph_methods::composite::{FrameChoice, name_of};
use hodograph_paper::paper::phrase::{Phrase, tr};
use hodograph_scene::quantity::Frame;
use hodograph_scene::{Guide, GuidePath, Lang, LinkId, PointId};

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
        Phrase::new(&match self.lang {
            Lang::En => format!(
                "Absolute motion: {absolute}; relative motion: {relative}; transport motion: {transport}; transport point: {carried}"
            ),
            Lang::Zh => {
                format!(
                    "绝对运动：{absolute}；相对运动：{relative}；牵连运动：{transport}；牵连点：{carried}"
                )
            }
        })
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
            _ if straight => tr(lang, "a straight line", "直线运动").to_owned(),
            Some(centre) => match lang {
                Lang::En => format!("a circle about {centre}"),
                Lang::Zh => format!("绕 {centre} 的圆周运动"),
            },
            None => tr(lang, "a plane curve", "平面曲线运动").to_owned(),
        };
        let transport = match c.frame {
            Frame::Point(_) => tr(lang, "translation", "平移").to_owned(),
            Frame::Link(l) => match pivot(l) {
                Some(at) => match lang {
                    Lang::En => format!("rotation about {at}"),
                    Lang::Zh => format!("绕 {at} 的定轴转动"),
                },
                None if scene.guides.iter().any(|g| slides(g, Some(l), None)) => {
                    tr(lang, "translation", "平移").to_owned()
                }
                None => tr(lang, "plane motion", "平面运动").to_owned(),
            },
        };
        let relative = self.path(c, writing);
        let relative = relative.split_once([':', '：']).map_or_else(
            || tr(lang, "not known", "未知").to_owned(),
            |(_, path)| path.trim().to_owned(),
        );
        let point = writing.point(&name_of(scene, &c.of));
        let frame = self.frame(c.frame, writing);
        let carried = match lang {
            Lang::En => match c.frame {
                Frame::Link(_) => {
                    format!("the point of {frame} that coincides with {point}")
                }
                Frame::Point(_) => format!("any point of the frame, which is {frame}"),
            },
            Lang::Zh => match c.frame {
                Frame::Link(_) => format!("{frame}上与 {point} 重合的点"),
                Frame::Point(_) => "动系上任一点（动系作平移，各点运动相同）".to_owned(),
            },
        };
        ThreeMotions { absolute, relative, transport, carried }
    }
}
