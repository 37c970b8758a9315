//! The three motions of a composite motion by name: absolute, relative, transport.

use super::CompositeWords;
use crate::writing::PointForm;
use hodograph_methods::composite::FrameChoice;
use hodograph_paper::paper::phrase::{Phrase, tr};
use hodograph_scene::quantity::Frame;
use hodograph_scene::{Guide, GuidePath, Lang, LinkId, PointId};

impl CompositeWords<'_> {
    /// Returns the three motions by name:
    /// `Absolute motion: a circle about A. Relative motion: ... Transport motion: link 2 turns
    /// about C.`
    pub(super) fn three_motions(&self, c: &FrameChoice) -> Phrase {
        let (scene, lang) = (self.scene, self.lang);
        let ground = &scene.links[scene.ground.0].points;
        let pivot = |l: LinkId| {
            scene.links[l.0]
                .points
                .iter()
                .find(|p| ground.contains(p))
                .map(|p| PointForm::Marked.point(scene.point_name(*p)))
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
        let relative = self.path(c, PointForm::Marked);
        let relative = relative.split_once([':', '：']).map_or_else(
            || tr(lang, "not known", "未知").to_owned(),
            |(_, path)| path.trim().to_owned(),
        );
        Phrase::new(&match lang {
            Lang::En => format!(
                "Absolute motion: {absolute}; relative motion: {relative}; transport motion: {transport}"
            ),
            Lang::Zh => {
                format!("绝对运动：{absolute}；相对运动：{relative}；牵连运动：{transport}")
            }
        })
    }
}
