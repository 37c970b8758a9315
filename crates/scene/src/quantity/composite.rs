//! `ve_A/2`, `vr_A/2`, `ak_A/2`: composite motion of a point. Moving point A is observed from frame
//! 2 (a link, or a point with which the frame translates): v_a = v_e + v_r, a_a = a_eⁿ + a_eᵗ +
//! a_rⁿ + a_rᵗ + a_k. `path_A/2` is the place of A in the axes of the frame.

use super::joined::name;
use super::{
    AnswerValue, Entry, FormulaInputs, Frame, Level, Meaning, Need, ObservedPart, Of, OverSign,
    Quantity, RelativeComponent, RelativePath, ValueForm, owns, relative_path,
};
use crate::model::{Find, OnLink, Scene};
use crate::resolve::Question;
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::geom::Point;
use hodograph_base::kind::Kind;
use hodograph_base::lang::each;
use hodograph_base::number::Real;

/// A part of the motion of a point that is observed from a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Composite {
    /// The part.
    pub part: CompositePart,
    /// The moving point.
    pub of: OnLink,
    /// The frame.
    pub frame: Frame,
}

/// The parts of a composite motion, in the order of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CompositePart {
    /// Transport velocity v_e.
    TransportVelocity,
    /// Relative velocity v_r.
    RelativeVelocity,
    /// Transport acceleration a_e.
    Transport,
    /// Normal part a_eⁿ.
    TransportNormal,
    /// Tangential part a_eᵗ.
    TransportTangential,
    /// Relative acceleration a_r.
    Relative,
    /// Normal part a_rⁿ.
    RelativeNormal,
    /// Tangential part a_rᵗ.
    RelativeTangential,
    /// Coriolis acceleration a_k.
    Coriolis,
    /// The place in the axes of the frame.
    Path,
}

impl CompositePart {
    /// All parts.
    pub const ALL: [CompositePart; 10] = [
        CompositePart::TransportVelocity,
        CompositePart::RelativeVelocity,
        CompositePart::Transport,
        CompositePart::TransportNormal,
        CompositePart::TransportTangential,
        CompositePart::Relative,
        CompositePart::RelativeNormal,
        CompositePart::RelativeTangential,
        CompositePart::Coriolis,
        CompositePart::Path,
    ];
}

impl Quantity for Composite {
    const WRITTEN: &'static [Entry] = &[
        Entry::new("ve", "ve_E/1", Kind::Velocity, ValueForm::Vector, each!("transport velocity"))
            .printed("v", OverSign::Sign("e")),
        Entry::new("vr", "vr_E/1", Kind::Velocity, ValueForm::Vector, each!("relative velocity"))
            .printed("v", OverSign::Sliding),
        Entry::new(
            "ae",
            "ae_E/1",
            Kind::Acceleration,
            ValueForm::Vector,
            each!("transport acceleration"),
        )
        .printed("a", OverSign::Sign("e")),
        Entry::new(
            "aen",
            "aen_E/1",
            Kind::Acceleration,
            ValueForm::Vector,
            each!("normal transport acceleration"),
        )
        .printed("a", OverSign::Sign("e\\,n")),
        Entry::new(
            "aet",
            "aet_E/1",
            Kind::Acceleration,
            ValueForm::Vector,
            each!("tangential transport acceleration"),
        )
        .printed("a", OverSign::Sign("e\\,t")),
        Entry::new(
            "ar",
            "ar_E/1",
            Kind::Acceleration,
            ValueForm::Vector,
            each!("relative acceleration"),
        )
        .printed("a", OverSign::Sliding),
        Entry::new(
            "arn",
            "arn_E/1",
            Kind::Acceleration,
            ValueForm::Vector,
            each!("normal relative acceleration"),
        )
        .printed("a", OverSign::SlidingPart("n")),
        Entry::new(
            "art",
            "art_E/1",
            Kind::Acceleration,
            ValueForm::Vector,
            each!("tangential relative acceleration"),
        )
        .printed("a", OverSign::SlidingPart("t")),
        Entry::new(
            "ak",
            "ak_E/1",
            Kind::Acceleration,
            ValueForm::Vector,
            each!("Coriolis acceleration"),
        )
        .printed("a", OverSign::Coriolis),
        Entry::new(
            "path",
            "path_E/1",
            Kind::Length,
            ValueForm::Point,
            each!("place on the relative path"),
        )
        .printed("r", OverSign::Sliding),
    ];

    fn read(question: &Question<'_>) -> Result<Option<Composite>, Diagnostic> {
        let Some((of, frame)) = question.point_and_frame()? else { return Ok(None) };
        Ok(Some(Composite { part: CompositePart::ALL[question.row(Self::WRITTEN)], of, frame }))
    }

    fn entry(&self) -> &'static Entry {
        &Self::WRITTEN[self.part as usize]
    }

    fn of(&self) -> Of {
        Of::Seen(self.of, self.frame)
    }

    fn meaning(&self, scene: &Scene) -> Option<Meaning> {
        let Composite { part, of, frame } = *self;
        let seat = frame.transport_point(of);
        let path = relative_path(scene, of, frame);
        let about = if let RelativePath::Circle(k) = path { Some(k) } else { None };
        let slides = matches!(path, RelativePath::Guide(_));
        let seen = |seen| Meaning::Seen(seen, of, frame, about);
        let relative = |split| Meaning::Relative(split, of, seat);
        Some(match (part, frame) {
            (CompositePart::TransportVelocity | CompositePart::Transport, _) => {
                Meaning::Vector(seat)
            }
            (CompositePart::RelativeVelocity, _) | (CompositePart::Relative, Frame::Point(_)) => {
                relative(RelativeComponent::Whole)
            }
            (CompositePart::Relative, Frame::Link(_)) if slides => {
                relative(RelativeComponent::Sliding)
            }
            (CompositePart::Relative, Frame::Link(_)) => seen(ObservedPart::Relative),
            (CompositePart::RelativeNormal, _) if slides => {
                relative(RelativeComponent::SlidingNormal)
            }
            (CompositePart::RelativeTangential, _) if slides => {
                relative(RelativeComponent::SlidingTangential)
            }
            (CompositePart::RelativeNormal, Frame::Point(c)) if on_one_link(scene, &of, &c) => {
                relative(RelativeComponent::Along)
            }
            (CompositePart::RelativeTangential, Frame::Point(c)) if on_one_link(scene, &of, &c) => {
                relative(RelativeComponent::Across)
            }
            (CompositePart::RelativeNormal, _) => seen(ObservedPart::RelativeNormal),
            (CompositePart::RelativeTangential, _) => seen(ObservedPart::RelativeTangential),
            (CompositePart::Coriolis, Frame::Link(_)) if slides => {
                relative(RelativeComponent::Coriolis)
            }
            (CompositePart::Coriolis, _) => seen(ObservedPart::Coriolis),
            (CompositePart::TransportNormal | CompositePart::TransportTangential, _) => {
                let normal = part == CompositePart::TransportNormal;
                match frame.axis(scene, of) {
                    Some(o) => {
                        let split = if normal {
                            RelativeComponent::Along
                        } else {
                            RelativeComponent::Across
                        };
                        Meaning::Relative(split, seat, OnLink { point: o, link: None })
                    }
                    None => seen(if normal {
                        ObservedPart::TransportNormal
                    } else {
                        ObservedPart::TransportTangential
                    }),
                }
            }
            (CompositePart::Path, _) => return None,
        })
    }

    fn no_value(&self, scene: &Scene) -> Both {
        let point = name(scene, &self.of);
        match self.part {
            CompositePart::TransportNormal | CompositePart::TransportTangential => both!(
                "the point of the frame at {point} stands still, so that nothing says what is along its path and what is square to it"
            ),
            CompositePart::RelativeNormal | CompositePart::RelativeTangential => both!(
                "{point} does not move in its frame, so that nothing says what is along its path and what is square to it"
            ),
            CompositePart::TransportVelocity
            | CompositePart::RelativeVelocity
            | CompositePart::Transport
            | CompositePart::Relative
            | CompositePart::Coriolis
            | CompositePart::Path => {
                both!("nothing defines it in this pose")
            }
        }
    }

    fn needs(&self) -> Vec<(Need, Level)> {
        use Level::{Acceleration, Position, Velocity};
        let seat = self.frame.transport_point(self.of);
        let at = |p: OnLink, level| (Need::Point(p.point, p.link), level);
        let turning = match self.frame {
            Frame::Link(l) => Some((Need::Turning(l), Velocity)),
            Frame::Point(_) => None,
        };
        let both = |level| [at(self.of, level), at(seat, level)];
        match self.part {
            CompositePart::TransportVelocity => vec![at(seat, Velocity)],
            CompositePart::RelativeVelocity => both(Velocity).to_vec(),
            CompositePart::Transport => vec![at(seat, Acceleration)],
            CompositePart::TransportNormal | CompositePart::TransportTangential => {
                [at(seat, Velocity), at(seat, Acceleration)].into_iter().chain(turning).collect()
            }
            CompositePart::Relative
            | CompositePart::RelativeNormal
            | CompositePart::RelativeTangential
            | CompositePart::Coriolis => {
                both(Velocity).into_iter().chain(both(Acceleration)).chain(turning).collect()
            }
            CompositePart::Path => match self.frame {
                Frame::Link(l) => {
                    vec![(Need::Point(self.of.point, None), Position), (Need::Turning(l), Position)]
                }
                Frame::Point(_) => vec![
                    (Need::Point(self.of.point, None), Position),
                    (Need::Point(seat.point, None), Position),
                ],
            },
        }
    }

    fn fault(&self, scene: &Scene, find: &Find) -> Option<Diagnostic> {
        unusable(scene, &self.of, self.frame, &find.text).map(|d| d.at(find.span))
    }

    fn value<N: Real, K: FormulaInputs<N>>(&self, known: &K) -> Option<AnswerValue<N>> {
        let scene = known.scene();
        if let Some(meaning) = self.meaning(scene) {
            return meaning.value(self.entry().level, known);
        }
        let at = known.point(self.of.point)?;
        Some(AnswerValue::Point(match self.frame {
            Frame::Point(c) => (at - known.point(c.point)?).to_point(),
            Frame::Link(l) => {
                let (origin, x) =
                    (known.point(*scene.links[l.0].points.first()?)?, known.direction(l)?.unit()?);
                Point { x: x.dot(at - origin), y: x.cross(at - origin) }
            }
        }))
    }
}

fn on_one_link(scene: &Scene, a: &OnLink, b: &OnLink) -> bool {
    scene.links.iter().enumerate().any(|(l, _)| {
        let l = crate::LinkId(l);
        owns(scene, l, a) && owns(scene, l, b)
    })
}

/// Returns the reason why a frame is unusable for a moving point.
pub(crate) fn unusable(scene: &Scene, of: &OnLink, frame: Frame, text: &str) -> Option<Diagnostic> {
    let point = name(scene, of);
    let own = match frame {
        Frame::Link(l) => scene.link_name(l).to_owned(),
        Frame::Point(c) => name(scene, &c),
    };
    let bare = |l: crate::LinkId| scene.links[l.0].points.is_empty();
    let message = match frame {
        _ if frame.is_fixed(scene) => {
            both!("`{text}`: {own} stands still; a frame that carries nothing parts no motion")
        }
        _ if frame.carries(scene, of) => {
            both!("`{text}`: {point} belongs to {own} for good, so it does not move in that frame")
        }
        Frame::Link(l) if text.starts_with("path") && bare(l) => {
            both!("`{text}`: link {own} has no point from which a place is counted")
        }
        Frame::Link(_) | Frame::Point(_) => return None,
    };
    let help = if !scene.guides.is_empty() {
        both!(
            "the moving point and the frame are on different moving bodies, such as a pin and the link in which it slides; `hodograph composite` lists those that serve"
        )
    } else {
        both!("`hodograph composite` lists the frames that serve")
    };
    Some(Diagnostic::error("frame-unusable", message).help(help))
}
