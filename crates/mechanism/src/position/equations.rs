//! The position equations of forms, written once for every number type.
//!
//! This module computes the quantity that a form measures in a pose ([`measured`]), and its
//! deviation from the given value ([`off`]). Newton's method in `f64` takes differences of it; the
//! proofs in enclosures have separate coefficients ([`super::coupled`]); the value of a driver is
//! the measured quantity of its form. The given values, from drivers or from the pose at the
//! instant, come from the callers.

use super::{Configuration, Path, Pose};
use crate::mechanism::{PairForm, Runner};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_scene::{GuideId, LinkId, PointId, RollingId, Scene};

/// Positions of links and points, and their rigid shapes; `None` for parts that are not placed.
pub(super) trait PartPositions<N: Real> {
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

impl<N: Real> PartPositions<N> for (&Scene, &Configuration<N>) {
    fn pose(&self, l: LinkId) -> Option<Pose<N>> {
        if l == self.0.ground {
            Some(Pose { origin: Point::origin(), axis: Vec2::unit_x() })
        } else {
            self.1.poses[l.0]
        }
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
pub(super) enum FormValue<N> {
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
pub(super) enum FormMeasure<N> {
    /// The vector from the required position of a pin to its actual position (m).
    Apart(Vec2<N>),
    /// A length or a coordinate (m).
    Length(N),
    /// An angle (rad).
    Angle(N),
}

/// Returns the quantity that a form measures.
pub(super) fn measured<N: Real>(
    form: PairForm,
    view: &impl PartPositions<N>,
) -> Option<FormMeasure<N>> {
    off(form, FormValue::Nothing, view)
}

/// Returns the value that a pose gives of a form: the value of a driver, the direction or the
/// distance that a slider keeps. Quantities that are zero in every pose have no value.
pub(super) fn kept<N: Real>(form: PairForm, then: &impl PartPositions<N>) -> Option<FormValue<N>> {
    match form {
        PairForm::Angles { of, against, .. } => {
            Some(FormValue::Turned(then.pose(of)?.axis.divide_by(then.pose(against)?.axis)))
        }
        PairForm::OnPath { runner: Runner::Link(_), .. }
        | PairForm::AlongPath { .. }
        | PairForm::Distance { .. } => match measured(form, then)? {
            FormMeasure::Length(x) => Some(FormValue::Length(x)),
            FormMeasure::Apart(_) | FormMeasure::Angle(_) => None,
        },
        PairForm::Meet { .. }
        | PairForm::OnPath { runner: Runner::Pin(_), .. }
        | PairForm::Related { .. } => Some(FormValue::Nothing),
    }
}

/// Returns the deviation of a form from its given value.
pub(super) fn off<N: Real>(
    form: PairForm,
    given: FormValue<N>,
    view: &impl PartPositions<N>,
) -> Option<FormMeasure<N>> {
    let length = |x: N| match given {
        FormValue::Length(given) => x - given,
        FormValue::Nothing | FormValue::Turned(_) | FormValue::InPlane(_) => x,
    };
    Some(match form {
        PairForm::Meet { pin, link } => {
            FormMeasure::Apart(view.point(pin)? - view.pose(link)?.to_world(view.local(link, pin)?))
        }
        PairForm::Angles { of, against, .. } => {
            let axis = view.pose(of)?.axis;
            FormMeasure::Angle(match given {
                FormValue::InPlane(given) => axis.divide_by(given).angle(),
                FormValue::Turned(given) => {
                    axis.divide_by(view.pose(against)?.axis).divide_by(given).angle()
                }
                FormValue::Nothing | FormValue::Length(_) => {
                    axis.divide_by(view.pose(against)?.axis).angle()
                }
            })
        }
        PairForm::OnPath { runner, guide, on } => {
            let place = view.runner(runner)?;
            FormMeasure::Length(length(match view.path(guide)?.to_world(&view.pose(on)?) {
                Path::Line { through, direction } => direction.cross(place - through),
                Path::Arc { centre, radius } => (place - centre).norm() - radius,
            }))
        }
        PairForm::AlongPath { runner, guide, on, .. } => {
            let place = view.pose(on)?.to_local(view.runner(runner)?);
            FormMeasure::Length(length(view.path(guide)?.coordinate_of(place)))
        }
        PairForm::Distance { from, to, .. } => {
            FormMeasure::Length(length(view.point(from)?.distance(view.point(to)?)))
        }
        PairForm::Related { pair, .. } => FormMeasure::Angle(view.slip(pair)?),
    })
}
