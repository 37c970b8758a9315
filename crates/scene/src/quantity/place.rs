//! `x_E`, `y_E`, `phi_3`, `l_AB`, `s_F`: coordinates of a point, angle of a link from the x axis,
//! distance of two points, position of a pin or slider along its straight guide, at the instant.

use super::{
    AnswerValue, Entry, FormulaInputs, Level, Meaning, Need, Of, OverSign, Quantity, ValueForm,
};
use crate::model::{Find, GuideId, GuidePath, LinkId, OnLink, PointId, Scene, Through};
use crate::resolve::Question;
use hodograph_base::diag::{Diagnostic, both};
use hodograph_base::kind::Kind;
use hodograph_base::lang::each;
use hodograph_base::number::Real;

/// A quantity of position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// A coordinate of a point (m).
    Coordinate(PointId, Axis),
    /// Angle of the link's first two points from the x axis (rad).
    LinkAngle(LinkId),
    /// Distance of two points (m).
    Distance(PointId, PointId),
    /// Position of a point along a straight guide, from the zero of the guide's coordinate (m).
    Along(GuideId, PointId, Of),
}

/// An axis of the plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Axis {
    /// Horizontal, positive to the right.
    X,
    /// Vertical, positive upward.
    Y,
}

impl Axis {
    /// Both axes, in the order of the table.
    pub const ALL: [Axis; 2] = [Axis::X, Axis::Y];
}

/// Rows of the table after those of the two coordinates.
const ANGLE: usize = 2;
const DISTANCE: usize = 3;
const ALONG: usize = 4;

impl Quantity for Place {
    const WRITTEN: &'static [Entry] = &[
        Entry::new("x", "x_E", Kind::Length, ValueForm::Scalar, each!("coordinate $x$"))
            .counted_from_origin(),
        Entry::new("y", "y_E", Kind::Length, ValueForm::Scalar, each!("coordinate $y$"))
            .counted_from_origin(),
        Entry::new("phi", "phi_3", Kind::Angle, ValueForm::Scalar, each!("angle"))
            .printed("\\varphi", OverSign::Nothing)
            .counted_from_origin(),
        Entry::new("l", "l_AB", Kind::Length, ValueForm::Scalar, each!("distance")),
        Entry::new(
            "s",
            "s_F",
            Kind::Length,
            ValueForm::Scalar,
            each!("coordinate along the guide"),
        )
        .counted_from_origin(),
    ];

    fn read(question: &Question<'_>) -> Result<Option<Place>, Diagnostic> {
        Ok(Some(match question.row(Self::WRITTEN) {
            ANGLE => {
                let link = question.link(question.names())?;
                if !question.has_angle(link) {
                    return Err(question.fault(both!(
                        "link `{0}` has no two points, so it has no angle",
                        question.names()
                    )));
                }
                Place::LinkAngle(link)
            }
            DISTANCE => {
                let (a, b) = question.pair()?;
                Place::Distance(a, b)
            }
            ALONG => {
                let names = question.names();
                // The lift of a cam's follower, and a question with the name of another link, are
                // quantities of cams.
                if question.is_follower(names)
                    || question.guides_of(names).is_empty() && question.link(names).is_ok()
                {
                    return Ok(None);
                }
                let (guide, pin) = match question.guides_of(names)[..] {
                    [one] => one,
                    [] => {
                        let d = question.fault(both!(
                            "`{}`: `{names}` runs in no guide, and is no follower of a cam",
                            question.text()
                        ));
                        return Err(
                            d.help(both!("name a pin or slider that runs in a straight guide"))
                        );
                    }
                    [..] => {
                        return Err(question.fault(both!(
                            "`{}`: `{names}` runs in several guides",
                            question.text()
                        )));
                    }
                };
                if let Some(point) = pin {
                    return Ok(Some(Place::Along(
                        guide,
                        point,
                        Of::Point(OnLink { point, link: None }),
                    )));
                }
                let link = question.link(names)?;
                let Some(point) = question.first_point(link) else {
                    return Err(
                        question.fault(both!("`{}`: link `{names}` has no point", question.text()))
                    );
                };
                Place::Along(guide, point, Of::Link(link))
            }
            axis => match question.points()? {
                (OnLink { point, .. }, None) => Place::Coordinate(point, Axis::ALL[axis]),
                (_, Some(_)) => {
                    return Err(question.fault(both!(
                        "`{}` names two points; a coordinate has one",
                        question.text()
                    )));
                }
            },
        }))
    }

    fn entry(&self) -> &'static Entry {
        &Self::WRITTEN[match self {
            Place::Coordinate(_, axis) => *axis as usize,
            Place::LinkAngle(_) => ANGLE,
            Place::Distance(..) => DISTANCE,
            Place::Along(..) => ALONG,
        }]
    }

    fn of(&self) -> Of {
        match *self {
            Place::Coordinate(point, _) => Of::Point(OnLink { point, link: None }),
            Place::LinkAngle(l) => Of::Link(l),
            Place::Distance(a, b) => Of::Line(a, b),
            Place::Along(_, _, of) => of,
        }
    }

    fn needs(&self) -> Vec<(Need, Level)> {
        match *self {
            Place::Along(_, point, _) => vec![(Need::Point(point, None), Level::Position)],
            Place::Coordinate(..) | Place::LinkAngle(_) | Place::Distance(..) => {
                self.of().needs(Level::Position)
            }
        }
    }

    fn places(&self, scene: &Scene) -> Vec<LinkId> {
        match *self {
            Place::Along(guide, ..) => vec![scene.guides[guide.0].on],
            Place::Coordinate(..) | Place::LinkAngle(_) | Place::Distance(..) => Vec::new(),
        }
    }

    fn fault(&self, scene: &Scene, find: &Find) -> Option<Diagnostic> {
        let Place::Along(guide, ..) = *self else { return None };
        let d = match &scene.guides[guide.0].path {
            GuidePath::Arc { .. } => Diagnostic::error(
                "find",
                both!("`{}` runs along an arc: its coordinate is an angle", find.text),
            ),
            GuidePath::Line { through: Through::Pin, .. } => Diagnostic::error(
                "find",
                both!("`{}` counts from the `through` of its guide, which has none", find.text),
            )
            .help(both!("add \"through\", a point or a place that the guide passes")),
            GuidePath::Line { through: Through::Point(_) | Through::At(_), .. } => return None,
        };
        Some(d.at(find.span))
    }

    fn meaning(&self, _scene: &Scene) -> Option<Meaning> {
        Some(Meaning::Place(*self))
    }
}

impl Place {
    /// Returns its value from known places.
    pub(super) fn value<N: Real, K: FormulaInputs<N>>(self, known: &K) -> Option<AnswerValue<N>> {
        Some(AnswerValue::Scalar(match self {
            Place::Coordinate(p, Axis::X) => known.point(p)?.x,
            Place::Coordinate(p, Axis::Y) => known.point(p)?.y,
            Place::LinkAngle(l) => known.direction(l)?.angle(),
            Place::Distance(a, b) => known.point(a)?.distance(known.point(b)?),
            Place::Along(guide, point, _) => {
                let (through, direction) = known.guide(guide)?;
                direction.dot(known.point(point)? - through)
            }
        }))
    }
}
