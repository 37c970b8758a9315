//! `gamma_C`: the transmission angle at a pin that joins a rod and the link that it moves: the
//! acute angle between the two, for a slider that between the rod and the normal of its guide.

use super::along::along;
use super::{
    AnswerValue, Entry, FormulaInputs, Level, Meaning, Need, Of, OverSign, Quantity, ValueForm,
};
use crate::model::{Find, Guide, GuideId, GuidePath, LinkId, OnLink, PointId, Scene};
use crate::resolve::Question;
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::geom::Vec2;
use hodograph_base::kind::Kind;
use hodograph_base::lang::each;
use hodograph_base::number::Real;

/// A transmission angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transmission {
    /// The pin.
    pub at: PointId,
}

/// The form of one of the two links at the pin.
#[derive(Clone, Copy)]
enum PinLink {
    /// A bar to another joint.
    Bar(PointId),
    /// A slider in a straight guide.
    Slider(GuideId),
}

impl Quantity for Transmission {
    const WRITTEN: &'static [Entry] = &[Entry::new(
        "gamma",
        "gamma_C",
        Kind::Angle,
        ValueForm::Scalar,
        each!("transmission angle"),
    )
    .printed("\\gamma", OverSign::Nothing)
    .at_level(Level::Position)];

    fn read(question: &Question<'_>) -> Result<Option<Transmission>, Diagnostic> {
        match question.points()? {
            (OnLink { point, link: None }, None) => Ok(Some(Transmission { at: point })),
            _ => {
                let message = both!("`{}`: a transmission angle is at one pin", question.text());
                Err(question.fault(message).help(both!("write for example gamma_C")))
            }
        }
    }

    fn entry(&self) -> &'static Entry {
        &Self::WRITTEN[0]
    }

    fn of(&self) -> Of {
        Of::Point(OnLink { point: self.at, link: None })
    }

    fn meaning(&self, _scene: &Scene) -> Option<Meaning> {
        None
    }

    fn needs(&self) -> Vec<(Need, Level)> {
        vec![(Need::Point(self.at, None), Level::Position)]
    }

    fn places(&self, scene: &Scene) -> Vec<LinkId> {
        let guides = scene.guides.iter().filter(|g| g.pin == Some(self.at));
        scene.carriers(self.at).chain(guides.map(|g| g.on)).collect()
    }

    fn no_value(&self, scene: &Scene) -> Both {
        both!("a link at {} has no length", scene.point_name(self.at))
    }

    fn fault(&self, scene: &Scene, find: &Find) -> Option<Diagnostic> {
        if self.sides(scene).is_some() {
            return None;
        }
        let message = both!(
            "`{}`: at {} no rod meets the one link that it moves",
            find.text,
            scene.point_name(self.at)
        );
        Some(Diagnostic::error("find", message).at(find.span).help(both!(
            "name the pin at which the coupler drives the rocker, the slider or the next rod"
        )))
    }

    fn value<N: Real, K: FormulaInputs<N>>(&self, known: &K) -> Option<AnswerValue<N>> {
        let [a, b] = self.sides(known.scene())?;
        let direction = |side: PinLink| -> Option<Vec2<N>> {
            match side {
                PinLink::Bar(end) => (known.point(end)? - known.point(self.at)?).unit(),
                PinLink::Slider(guide) => {
                    along(known, &known.scene().guides[guide.0]).map(Vec2::perp)
                }
            }
        };
        let (a, b) = (direction(a)?, direction(b)?);
        // The acute one of the angle and its supplement.
        Some(AnswerValue::Scalar(
            Vec2 { x: a.dot(b).magnitude(), y: a.cross(b).magnitude() }.angle(),
        ))
    }
}

impl Transmission {
    /// Returns the two moving links at the pin; `None` if there are not two, or if one of them has
    /// no other joint.
    fn sides(&self, scene: &Scene) -> Option<[PinLink; 2]> {
        let joint = |p: PointId| {
            scene.carriers(p).count() > 1 || scene.guides.iter().any(|g| g.pin == Some(p))
        };
        let straight = |l: LinkId| {
            let runs = |g: &Guide| {
                g.slider == Some(l)
                    && g.pin == Some(self.at)
                    && matches!(g.path, GuidePath::Line { .. })
            };
            scene.guides.iter().position(runs).map(GuideId)
        };
        let side = |l: LinkId| {
            let end =
                || scene.links[l.0].points.iter().copied().find(|p| *p != self.at && joint(*p));
            straight(l).map(PinLink::Slider).or_else(|| end().map(PinLink::Bar))
        };
        let links: Vec<LinkId> = scene.carriers(self.at).collect();
        match links[..] {
            [a, b] if a != scene.ground && b != scene.ground => Some([side(a)?, side(b)?]),
            _ => None,
        }
    }
}
