//! The equations between positions that forms stand for, written once for every number type.
//!
//! Decided here: what a form measures in a pose ([`measured`]), and by how much that misses what is given ([`off`]). Newton's method in
//! `f64` takes differences of it, the proofs in enclosures have coefficients of their own ([`super::coupled`]), driver values are what a
//! form measures without anything given. Not decided here: what is given, by drivers or by the pose of the instant.

use super::{Configuration, Path, Pose};
use crate::mechanism::{Form, Runner};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_scene::{GuideId, LinkId, PointId, RollingId, Scene};

/// Where links and points are, and their rigid shapes; `None` for what is not placed.
pub(super) trait View<N: Real> {
    /// The pose of a link, ground among them.
    fn pose(&self, l: LinkId) -> Option<Pose<N>>;
    /// The place of a point in the plane.
    fn point(&self, p: PointId) -> Option<Point<N>>;
    /// A point in the frame of a link.
    fn local(&self, l: LinkId, p: PointId) -> Option<Point<N>>;
    /// A guide in the frame of its link.
    fn path(&self, g: GuideId) -> Option<Path<N>>;
    /// By how much a pair misses rolling without slip since the pose from which it counts, as an angle of the second link.
    fn slip(&self, r: RollingId) -> Option<N>;

    /// What runs in a guide: a link by the origin of its frame.
    fn runner(&self, runner: Runner) -> Option<Point<N>> {
        match runner {
            Runner::Pin(p) => self.point(p),
            Runner::Link(l) => Some(self.pose(l)?.origin),
        }
    }
}

impl<N: Real> View<N> for (&Scene, &Configuration<N>) {
    fn pose(&self, l: LinkId) -> Option<Pose<N>> {
        if l == self.0.ground { Some(Pose { origin: Point::origin(), axis: Vec2::unit_x() }) } else { self.1.poses[l.0] }
    }

    fn point(&self, p: PointId) -> Option<Point<N>> {
        self.1.points[p.0]
    }

    fn local(&self, l: LinkId, p: PointId) -> Option<Point<N>> {
        self.1.shapes.local(l, p)
    }

    fn path(&self, g: GuideId) -> Option<Path<N>> {
        self.1.shapes.guides[g.0]
    }

    /// What a configuration has rolled, it has rolled without slip.
    fn slip(&self, _: RollingId) -> Option<N> {
        None
    }
}

/// What is given of a form, by a driver or by the pose of the instant.
#[derive(Clone, Copy, Debug)]
pub(super) enum Given<N> {
    /// Nothing: what is measured is to be zero.
    Nothing,
    /// The direction of one link in the frame of the other.
    Turned(Vec2<N>),
    /// The direction of the link in the plane.
    InPlane(Vec2<N>),
    /// A length or a coordinate (m).
    Length(N),
}

/// What a form measures, and by how much it is off.
pub(super) enum Measured<N> {
    /// From the place where a pin should be to where it is (m).
    Apart(Vec2<N>),
    /// A length or a coordinate (m).
    Length(N),
    /// An angle (rad).
    Angle(N),
}

/// What a form measures.
pub(super) fn measured<N: Real>(form: Form, view: &impl View<N>) -> Option<Measured<N>> {
    off(form, Given::Nothing, view)
}

/// What a pose gives of a form to others: what a driver holds there, the direction and the distance that a slider keeps. Nothing of what
/// is zero in every pose.
pub(super) fn kept<N: Real>(form: Form, then: &impl View<N>) -> Option<Given<N>> {
    match form {
        Form::Angles { of, against, .. } => Some(Given::Turned(then.pose(of)?.axis.divide_by(then.pose(against)?.axis))),
        Form::OnPath { runner: Runner::Link(_), .. } | Form::AlongPath { .. } | Form::Distance { .. } => match measured(form, then)? {
            Measured::Length(x) => Some(Given::Length(x)),
            Measured::Apart(_) | Measured::Angle(_) => None,
        },
        Form::Meet { .. } | Form::OnPath { runner: Runner::Pin(_), .. } | Form::Related { .. } => Some(Given::Nothing),
    }
}

/// By how much a form is off what is given.
pub(super) fn off<N: Real>(form: Form, given: Given<N>, view: &impl View<N>) -> Option<Measured<N>> {
    let length = |x: N| match given {
        Given::Length(given) => x - given,
        Given::Nothing | Given::Turned(_) | Given::InPlane(_) => x,
    };
    Some(match form {
        Form::Meet { pin, link } => Measured::Apart(view.point(pin)? - view.pose(link)?.to_world(view.local(link, pin)?)),
        Form::Angles { of, against, .. } => {
            let axis = view.pose(of)?.axis;
            Measured::Angle(match given {
                Given::InPlane(given) => axis.divide_by(given).angle(),
                Given::Turned(given) => axis.divide_by(view.pose(against)?.axis).divide_by(given).angle(),
                Given::Nothing | Given::Length(_) => axis.divide_by(view.pose(against)?.axis).angle(),
            })
        }
        Form::OnPath { runner, guide, on } => {
            let place = view.runner(runner)?;
            Measured::Length(length(match view.path(guide)?.to_world(&view.pose(on)?) {
                Path::Line { through, direction } => direction.cross(place - through),
                Path::Arc { centre, radius } => (place - centre).norm() - radius,
            }))
        }
        Form::AlongPath { runner, guide, on, .. } => {
            let place = view.pose(on)?.to_local(view.runner(runner)?);
            Measured::Length(length(view.path(guide)?.coordinate_of(place)))
        }
        Form::Distance { from, to, .. } => Measured::Length(length(view.point(from)?.distance(view.point(to)?))),
        Form::Related { pair, .. } => Measured::Angle(view.slip(pair)?),
    })
}
