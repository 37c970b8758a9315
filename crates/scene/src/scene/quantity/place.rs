//! `x_E`, `y_E`, `phi_3`, `l_AB`: where a point is, the angle of a link from the x axis, the distance of two points at the instant.

use super::{Entry, Form, Known, Meaning, Of, Over, Quantity, Value};
use crate::diag::{Diagnostic, both};
use crate::number::Real;
use crate::scene::book::Kind;
use crate::scene::model::{LinkId, OnLink, PointId, Scene};
use crate::scene::resolve::Question;

/// Where something is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// A coordinate of a point (m).
    Coordinate(PointId, Axis),
    /// Angle of the link's first two points from the x axis (rad).
    LinkAngle(LinkId),
    /// Distance of two points (m).
    Distance(PointId, PointId),
}

/// An axis of the plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Axis {
    /// To the right.
    X,
    /// Up.
    Y,
}

impl Axis {
    /// Both, in the order of the table.
    pub const ALL: [Axis; 2] = [Axis::X, Axis::Y];
}

/// Lines of the table behind those of the two coordinates.
const ANGLE: usize = 2;
const DISTANCE: usize = 3;

impl Quantity for Place {
    const WRITTEN: &'static [Entry] = &[
        Entry::new("x", "x_E", Kind::Length, Form::Scalar, ["coordinate $x$", "坐标 $x$"]).counted_from_origin(),
        Entry::new("y", "y_E", Kind::Length, Form::Scalar, ["coordinate $y$", "坐标 $y$"]).counted_from_origin(),
        Entry::new("phi", "phi_3", Kind::Angle, Form::Scalar, ["angle", "位置角"]).printed("\\varphi", Over::Nothing).counted_from_origin(),
        Entry::new("l", "l_AB", Kind::Length, Form::Scalar, ["distance", "距离"]),
    ];

    fn read(question: &Question<'_>) -> Result<Option<Place>, Diagnostic> {
        Ok(Some(match question.row(Self::WRITTEN) {
            ANGLE => {
                let link = question.link(question.names())?;
                if !question.has_angle(link) {
                    return Err(question.fault(both!(
                        "link `{0}` has no two points, so it has no angle",
                        "构件 `{0}` 没有两个点，因而没有角度",
                        question.names()
                    )));
                }
                Place::LinkAngle(link)
            }
            DISTANCE => {
                let (a, b) = question.pair()?;
                Place::Distance(a, b)
            }
            axis => match question.points()? {
                (OnLink { point, .. }, None) => Place::Coordinate(point, Axis::ALL[axis]),
                (_, Some(_)) => {
                    return Err(question.fault(both!(
                        "`{}` names two points; a coordinate has one",
                        "`{}` 写了两个点；坐标只属于一个点",
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
        }]
    }

    fn of(&self) -> Of {
        match *self {
            Place::Coordinate(point, _) => Of::Point(OnLink { point, link: None }),
            Place::LinkAngle(l) => Of::Link(l),
            Place::Distance(a, b) => Of::Line(a, b),
        }
    }

    fn meaning(&self, _scene: &Scene) -> Option<Meaning> {
        Some(Meaning::Place(*self))
    }
}

impl Place {
    /// Its value where places are known.
    pub(super) fn value<N: Real, K: Known<N>>(self, known: &K) -> Option<Value<N>> {
        Some(Value::Scalar(match self {
            Place::Coordinate(p, Axis::X) => known.point(p)?.x,
            Place::Coordinate(p, Axis::Y) => known.point(p)?.y,
            Place::LinkAngle(l) => known.direction(l)?.angle(),
            Place::Distance(a, b) => known.point(a)?.distance(known.point(b)?),
        }))
    }
}
