//! The position equations of forms, written once for every number type.
//!
//! This module computes the quantity that a form measures in a pose ([`measured`]), and its
//! deviation from the given value ([`off`]). Newton's method in `f64` takes differences of it; the
//! proofs in enclosures have separate coefficients ([`super::coupled`]); the value of a driver is
//! the measured quantity of its form. The given values, from drivers or from the pose at the
//! instant, come from the callers.

use super::{Configuration, Path, Pose};
use crate::mechanism::{Form, Runner};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_scene::{GuideId, LinkId, PointId, RollingId, Scene};

/// Positions of links and points, and their rigid shapes; `None` for parts that are not placed.
pub(super) trait View<N: Real> {
    /// Returns the pose of a link, or of the ground.
    fn pose(&self, l: LinkId) -> Option<Pose<N>>;
    /// Returns the position of a point in the plane.
    fn point(&self, p: PointId) -> Option<Point<N>>;
    /// Returns a point in the frame of a link.
    fn local(&self, l: LinkId, p: PointId) -> Option<Point<N>>;
    /// Returns a guide in the frame of its link.
    fn path(&self, g: GuideId) -> Option<Path<N>>;
    /// Returns the deviation of a pair from rolling without slip since its reference pose, as an
    /// angle of the second link.
    fn slip(&self, r: RollingId) -> Option<N>;

    /// Returns the position of the runner of a guide; for a link, the origin of its frame.
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

    /// A configuration has rolled without slip.
    fn slip(&self, _: RollingId) -> Option<N> {
        None
    }
}

/// The given value of a form, from a driver or from the pose at the instant.
#[derive(Clone, Copy, Debug)]
pub(super) enum Given<N> {
    /// Nothing: the measured quantity must be zero.
    Nothing,
    /// The direction of one link in the frame of the other.
    Turned(Vec2<N>),
    /// The direction of the link in the plane.
    InPlane(Vec2<N>),
    /// A length or a coordinate (m).
    Length(N),
}

/// The quantity that a form measures, or its deviation.
pub(super) enum Measured<N> {
    /// The vector from the required position of a pin to its actual position (m).
    Apart(Vec2<N>),
    /// A length or a coordinate (m).
    Length(N),
    /// An angle (rad).
    Angle(N),
}

/// Returns the quantity that a form measures.
pub(super) fn measured<N: Real>(form: Form, view: &impl View<N>) -> Option<Measured<N>> {
    off(form, Given::Nothing, view)
}

/// Returns the value that a pose gives of a form: the value of a driver, the direction or the
/// distance that a slider keeps. Quantities that are zero in every pose have no value.
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

/// Returns the deviation of a form from its given value.
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
