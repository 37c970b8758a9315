//! The decision on the Coriolis acceleration at a slide, in words.

use super::{CompositeWords, DIGITS, symbol};
use hodograph_base::digits::{inked, significant};
use hodograph_board::plan::names::name_label;
use hodograph_methods::composite::coriolis::{CoriolisVerdict, SlideCoriolis};
use hodograph_paper::paper::phrase::{Phrase, sense, tr};
use hodograph_scene::quantity::composite::CompositePart;
use hodograph_scene::{DiagramKind, Kind, Lang};

impl CompositeWords<'_> {
    /// Returns the name of a slide: `B along the guide of link 3`.
    pub fn slide(&self, s: &SlideCoriolis) -> Phrase {
        let (scene, guide) = (self.scene, &self.scene.guides[s.guide.0]);
        let on = scene.link_name(guide.on);
        let runner = match (guide.pin, guide.slider, self.lang) {
            (Some(pin), ..) => format!("${}$", name_label(scene.point_name(pin))),
            (None, Some(l), Lang::En) => format!("Link {}", scene.link_name(l)),
            (None, Some(l), Lang::Zh) => format!("构件 {} ", scene.link_name(l)),
            (None, None, _) => String::new(),
        };
        Phrase::new(&match self.lang {
            Lang::En => format!("{runner} along the guide of link {on}"),
            Lang::Zh => format!("{} 沿构件 {on} 的导路", runner.trim_end()),
        })
    }

    /// Returns the decision on a slide: the value of a_k, or zero with the reason; then the numbers
    /// and the direction.
    pub fn coriolis(&self, s: &SlideCoriolis) -> Vec<Phrase> {
        let (scene, lang) = (self.scene, self.lang);
        let a = symbol(Some(CompositePart::Coriolis), DiagramKind::Acceleration, self.notation);
        let v = symbol(Some(CompositePart::RelativeVelocity), DiagramKind::Velocity, self.notation);
        let on = scene.guides[s.guide.0].on;
        let omega = format!("\\omega_{{{}}}", name_label(scene.link_name(on)));
        let told = |kind: Kind, value: f64| {
            let number = inked(&significant(scene.book.value(kind, value), DIGITS));
            scene.book.label(kind, &number)
        };
        let none = |why: &str| vec![format!("${a} = 0${}{why}", tr(lang, ": ", "："))];
        let lines = match s.verdict {
            CoriolisVerdict::GuideFixed => none(tr(lang, "the guide is at rest", "导路固定不动")),
            CoriolisVerdict::GuideTranslates => {
                none(tr(lang, "the guide translates", "导路作平移，不转动"))
            }
            CoriolisVerdict::GuideDwells => none(&match lang {
                Lang::En => format!("${omega} = 0$ at this instant"),
                Lang::Zh => format!("该瞬时 ${omega} = 0$"),
            }),
            CoriolisVerdict::NoSliding => none(&match lang {
                Lang::En => format!("${v} = 0$ at this instant"),
                Lang::Zh => format!("该瞬时 ${v} = 0$"),
            }),
            CoriolisVerdict::Present => {
                let size = told(Kind::Acceleration, s.acceleration().norm());
                let numbers = format!(
                    "$|{omega}| = {}${} ${v} = {}$",
                    told(Kind::Omega, s.omega.abs()),
                    self.comma().trim_end(),
                    told(Kind::Velocity, s.relative.norm())
                );
                let turned = sense(lang, s.omega);
                let direction = match lang {
                    Lang::En => format!("direction: ${v}$ turned by 90° {turned}, as ${omega}$"),
                    Lang::Zh => format!("方向：${v}$ 顺 ${omega}$ 转向（{turned}）转过 90°"),
                };
                vec![format!("${a} = 2{omega} {v} = {size}$"), numbers, direction]
            }
        };
        lines.iter().map(|l| Phrase::new(l)).collect()
    }
}
