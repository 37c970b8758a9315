//! The decision on the Coriolis acceleration at a slide, in words.

use super::{CompositeWords, symbol};
use hodograph_base::lang::{say, tr};
use hodograph_board::plan::names::name_label;
use hodograph_methods::composite::coriolis::{CoriolisVerdict, SlideCoriolis};
use hodograph_paper::paper::phrase::{Phrase, sense};
use hodograph_scene::quantity::composite::CompositePart;
use hodograph_scene::{DiagramKind, Kind};

impl CompositeWords<'_> {
    /// Returns the name of a slide: `B along the guide of link 3`.
    pub fn slide(&self, s: &SlideCoriolis) -> Phrase {
        let (scene, guide) = (self.scene, &self.scene.guides[s.guide.0]);
        let on = scene.link_name(guide.on);
        let runner = match (guide.pin, guide.slider) {
            (Some(pin), _) => format!("${}$", name_label(scene.point_name(pin))),
            (None, Some(l)) => say!(self.lang, "Link {}", scene.link_name(l)),
            (None, None) => String::new(),
        };
        Phrase::new(&say!(self.lang, "{runner} along the guide of link {on}"))
    }

    /// Returns the decision on a slide: the value of a_k, or zero with the reason; then the numbers
    /// and the direction.
    pub fn coriolis(&self, s: &SlideCoriolis) -> Vec<Phrase> {
        let (scene, lang) = (self.scene, self.lang);
        let a = symbol(Some(CompositePart::Coriolis), DiagramKind::Acceleration, self.notation);
        let v = symbol(Some(CompositePart::RelativeVelocity), DiagramKind::Velocity, self.notation);
        let on = scene.guides[s.guide.0].on;
        let omega = format!("\\omega_{{{}}}", name_label(scene.link_name(on)));
        let none = |why: &str| vec![format!("${a} = 0${}{why}", tr!(lang, ": "))];
        let lines = match s.verdict {
            CoriolisVerdict::GuideFixed => none(tr!(lang, "the guide is at rest")),
            CoriolisVerdict::GuideTranslates => none(tr!(lang, "the guide translates")),
            CoriolisVerdict::GuideDwells => none(&say!(lang, "${omega} = 0$ at this instant")),
            CoriolisVerdict::NoSliding => none(&say!(lang, "${v} = 0$ at this instant")),
            CoriolisVerdict::Present => {
                let size = self.amount(Kind::Acceleration, s.acceleration().norm());
                let numbers = format!(
                    "$|{omega}| = {}${} ${v} = {}$",
                    self.amount(Kind::Omega, s.omega.abs()),
                    self.comma().trim_end(),
                    self.amount(Kind::Velocity, s.relative.norm())
                );
                let turned = sense(lang, s.omega);
                let direction = say!(lang, "direction: ${v}$ turned by 90° {turned}, as ${omega}$");
                vec![format!("${a} = 2{omega} {v} = {size}$"), numbers, direction]
            }
        };
        lines.iter().map(|l| Phrase::new(l)).collect()
    }
}
