//! A piece of a profile as a pair: a slot about the centre of a circle, a straight slot, or a guide
//! of the follower for a circle's centre.

use super::super::raw::{RawGuide, RawPlace, RawQuantity, RawScene};
use super::place::NumberText;
use super::raw::{RawFace, RawFollows};
use hodograph_base::cam::outline::ProfilePart;
use hodograph_base::diag::Span;
use hodograph_base::json::Word;

/// A part of the profile with its texts.
#[derive(Clone, Debug)]
pub(super) enum Worded {
    /// A circle about a point of the cam (a corner has the radius 0).
    Circle { centre: String, radius: NumberText },
    /// A common tangent of its neighbours, with their distance.
    Tangent { apart: NumberText },
    /// An arc tangent to its neighbours.
    Flank { radius: NumberText },
}

impl Worded {
    /// Returns its radius; a tangent has none.
    pub fn radius(&self) -> Option<&NumberText> {
        match self {
            Worded::Circle { radius, .. } | Worded::Flank { radius } => Some(radius),
            Worded::Tangent { .. } => None,
        }
    }
}

/// The data of the pair.
pub(super) struct CamPair<'a> {
    pub cam: &'a str,
    pub follower: &'a str,
    pub follows: &'a RawFollows,
    /// Radius of the round end.
    pub end: Option<NumberText>,
    /// Offset of a face, as a complete text.
    pub offset: Option<NumberText>,
    pub span: Span,
}

impl CamPair<'_> {
    fn word(&self, text: &str) -> Word {
        Word { text: text.to_owned(), span: self.span }
    }

    fn quantity(&self, text: String) -> RawQuantity {
        RawQuantity { text, span: self.span, bare: false }
    }

    fn blank(&self) -> RawGuide {
        RawGuide {
            pin: None,
            on: None,
            contact: true,
            ..RawGuide::of_pin(self.word(""), self.word(""), self.span)
        }
    }

    /// Returns the slot for a round end against a circle.
    fn slot(&self, pin: &Word, centre: &str, radius: &NumberText, end: &NumberText) -> RawGuide {
        // In a hollow, the distance of the centres is the difference of the radii.
        let text = match (radius.value < 0.0, end.value == 0.0) {
            (true, _) => format!("-({})-({})", radius.text, end.text),
            (false, true) => radius.text.clone(),
            (false, false) => format!("({})+({})", radius.text, end.text),
        };
        RawGuide {
            pin: Some(pin.clone()),
            on: Some(self.word(self.cam)),
            centre: Some(self.word(centre)),
            radius: Some(self.quantity(text)),
            ..self.blank()
        }
    }

    /// Returns the guide for a face against a circle.
    fn face(&self, face: &RawFace, centre: &str, radius: &NumberText) -> RawGuide {
        let sign = if face.left.unwrap_or(true) { "" } else { "-" };
        let text = match &self.offset {
            Some(offset) if offset.value != 0.0 => {
                format!(
                    "({}){}({})",
                    offset.text,
                    if sign.is_empty() { "+" } else { "-" },
                    radius.text
                )
            }
            Some(_) | None => format!("{sign}({})", radius.text),
        };
        RawGuide {
            pin: Some(self.word(centre)),
            on: Some(self.word(self.follower)),
            line: face.line.clone(),
            through: face.through.clone(),
            angle: if face.square {
                Some(self.quantity("90 deg".into()))
            } else {
                face.angle.clone()
            },
            slid: face.square,
            offset: Some(self.quantity(text)),
            ..self.blank()
        }
    }

    /// Writes the pair of an arc whose centre is a new point of the cam at `place`, or its pivot:
    /// the centre of a round end moves about it at this radius, or a face keeps this distance from
    /// it.
    pub fn about(
        &self,
        raw: &mut RawScene,
        place: Option<RawPlace>,
        pivot: &str,
        radius: &NumberText,
    ) -> Option<()> {
        let centre =
            if place.is_some() { fresh(raw, &["K", "F", "G", "H"]) } else { pivot.to_owned() };
        let none = NumberText { value: 0.0, text: "0 mm".into() };
        let guide = match self.follows {
            RawFollows::Face(face) => self.face(face, &centre, radius),
            RawFollows::Edge(_) | RawFollows::Roller { .. } | RawFollows::Arc { .. } => {
                self.slot(self.follows.pin()?, &centre, radius, &none)
            }
        };
        if let Some(place) = place {
            raw.points.push((self.word(&centre), place));
            raw.links.iter_mut().find(|l| l.name.text == self.cam)?.points.push(self.word(&centre));
        }
        raw.guides.push(guide);
        Some(())
    }

    /// Writes the pair of one part of the profile into the scene. Returns `None` for a face on a
    /// line.
    pub fn write(&self, raw: &mut RawScene, parts: &[Worded], i: usize) -> Option<()> {
        let n = parts.len();
        let neighbour = |k: usize| match &parts[k % n] {
            Worded::Circle { centre, radius } => Some((centre.clone(), radius.clone())),
            Worded::Tangent { .. } | Worded::Flank { .. } => None,
        };
        let end = self.end.clone().unwrap_or(NumberText { value: 0.0, text: "0 mm".into() });
        let pin = self.follows.pin();
        let guide = match (&parts[i], self.follows) {
            (Worded::Circle { centre, radius }, RawFollows::Face(face)) => {
                self.face(face, centre, radius)
            }
            (Worded::Circle { centre, radius }, _) => self.slot(pin?, centre, radius, &end),
            (Worded::Tangent { .. }, RawFollows::Face(_)) => return None,
            (Worded::Tangent { apart }, _) => {
                let ((a, ra), (b, rb)) = (neighbour(i + n - 1)?, neighbour(i + 1)?);
                RawGuide {
                    pin: Some(pin?.clone()),
                    on: Some(self.word(self.cam)),
                    line: Some(self.word(&format!("{a},{b}"))),
                    angle: Some(
                        self.quantity(format!(
                            "asin((({})-({}))/({}))",
                            ra.text, rb.text, apart.text
                        )),
                    ),
                    offset: Some(self.quantity(format!("-(({})+({}))", ra.text, end.text))),
                    ..self.blank()
                }
            }
            (Worded::Flank { radius }, _) => {
                let ((a, ra), (b, rb)) = (neighbour(i + n - 1)?, neighbour(i + 1)?);
                let centre = fresh(raw, &["K", "F", "G", "H"]);
                let hollow = radius.value < 0.0;
                for (of, r) in [(&a, &ra), (&b, &rb)] {
                    let text = if hollow {
                        format!("({})-({})", r.text, radius.text)
                    } else {
                        format!("({})-({})", radius.text, r.text)
                    };
                    raw.lengths.push((self.word(&format!("{of},{centre}")), self.quantity(text)));
                }
                let side = if hollow { "right" } else { "left" };
                raw.sides.push((self.word(&centre), self.word(&format!("{side} of {a},{b}"))));
                let link = raw.links.iter_mut().find(|l| l.name.text == self.cam)?;
                link.points.push(self.word(&centre));
                match self.follows {
                    RawFollows::Face(face) => self.face(face, &centre, radius),
                    RawFollows::Edge(_) | RawFollows::Roller { .. } | RawFollows::Arc { .. } => {
                        self.slot(pin?, &centre, radius, &end)
                    }
                }
            }
        };
        raw.guides.push(guide);
        Some(())
    }
}

/// Returns a name that no point of the scene has: one of the proposed names, else a numbered one.
pub(super) fn fresh(raw: &RawScene, proposed: &[&str]) -> String {
    let taken = |name: &str| {
        raw.links.iter().flat_map(|l| &l.points).any(|w| w.text == name)
            || raw.guides.iter().filter_map(|g| g.pin.as_ref()).any(|w| w.text == name)
            || raw.cams.iter().filter_map(|c| c.at.as_ref()).any(|w| w.text == name)
    };
    let first = proposed.first().copied().unwrap_or("M");
    let numbered = (1..).map(|k| format!("{first}{k}'"));
    proposed
        .iter()
        .map(|n| (*n).to_owned())
        .chain(numbered)
        .find(|n| !taken(n))
        .unwrap_or_else(|| first.to_owned())
}

/// Returns the part as numbers, with its centre in the frame of the cam.
pub(super) fn numbers(
    part: &Worded,
    local: impl Fn(&str) -> Option<hodograph_base::geom::Vec2>,
) -> Option<ProfilePart> {
    Some(match part {
        Worded::Circle { centre, radius } => ProfilePart::Circle(local(centre)?, radius.value),
        Worded::Tangent { .. } => ProfilePart::Tangent,
        Worded::Flank { radius } => ProfilePart::Flank(radius.value),
    })
}
