//! The position equations of forms, written once for every number type.
//!
//! This module computes the quantity that a form measures in a pose ([`measured`]), its deviation
//! from the given value ([`off`]), and the derivatives of the deviation ([`slopes`]). Newton's
//! method in `f64` and the proofs in enclosures use the same equations; the value of a driver is
//! the measured quantity of its form. The given values, from drivers or from the pose at the
//! instant, come from the callers.

use super::{Configuration, Path, Pose};
use crate::mechanism::{GraphNode, PairForm, Runner};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_scene::{GuideId, LinkId, PointId, Relation, Rolling, RollingId, Scene};

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
    /// Returns a rolling pair and the sizes of its contours.
    fn rolling(&self, r: RollingId) -> (&Rolling, [N; 2]);

    /// Returns the position of the runner of a guide; for a link, the origin of its frame.
    fn runner(&self, runner: Runner) -> Option<Point<N>> {
        match runner {
            Runner::Pin(p) => self.point(p),
            Runner::Link(l) => Some(self.pose(l)?.origin),
        }
    }

    /// Returns the position of the centre of a rolling link: it moves with its link; if the link
    /// has no such point, the centre's position in the plane is taken.
    fn centre(&self, link: LinkId, centre: PointId) -> Option<Point<N>> {
        match self.local(link, centre) {
            Some(local) => Some(self.pose(link)?.to_world(local)),
            None => self.point(centre),
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

    fn rolling(&self, r: RollingId) -> (&Rolling, [N; 2]) {
        (&self.0.rolling[r.0], self.1.shapes.rolling[r.0])
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

/// Reports the derivatives of a form's deviation, divided by the length `unit` if it is a length:
/// of which of its equations, by the motion of which link or pin, and the coefficients for its two
/// coordinates in units of this length and, for a link, for its angle (rad). A part may be reported
/// more than once: its coefficients are added.
///
/// Returns `None` if a part is not placed.
pub(super) fn slopes<N: Real>(
    form: PairForm,
    given: FormValue<N>,
    view: &impl PartPositions<N>,
    unit: N,
    told: impl FnMut(usize, GraphNode, [N; 3]),
) -> Option<()> {
    let zero = N::from_f64(0.0);
    let mut s = FormSlopes { view, unit, told };
    match form {
        PairForm::Meet { pin, link } => {
            let own = view.pose(link)?.to_world(view.local(link, pin)?);
            for (equation, k) in [Vec2::unit_x(), Vec2::unit_x().perp()].into_iter().enumerate() {
                s.pin(equation, pin, k);
                s.link(equation, link, own, -k)?;
            }
        }
        PairForm::OnPath { runner, guide, on } => {
            let place = view.runner(runner)?;
            let (k, foot) = match view.path(guide)?.to_world(&view.pose(on)?) {
                Path::Line { direction, .. } => (direction.perp(), place),
                Path::Arc { centre, .. } => (direction_from(centre, place), centre),
            };
            s.runner(runner, k);
            s.link(0, on, foot, -k)?;
        }
        PairForm::AlongPath { runner, guide, on, .. } => {
            let place = view.runner(runner)?;
            let k = match view.path(guide)?.to_world(&view.pose(on)?) {
                Path::Line { direction, .. } => direction,
                // The angle at the centre, in metres of arc.
                Path::Arc { centre, radius } => {
                    direction_from(centre, place).perp() * (radius / (place - centre).norm())
                }
            };
            s.runner(runner, k);
            s.link(0, on, place, -k)?;
        }
        PairForm::Distance { from, to, .. } => {
            let k = direction_from(view.point(from)?, view.point(to)?);
            s.pin(0, to, k);
            s.pin(0, from, -k);
        }
        PairForm::Angles { of, against, .. } => {
            (s.told)(0, GraphNode::Link(of), [zero, zero, N::from_f64(1.0)]);
            if !matches!(given, FormValue::InPlane(_)) {
                (s.told)(0, GraphNode::Link(against), [zero, zero, N::from_f64(-1.0)]);
            }
        }
        PairForm::Related { pair, .. } => {
            let (rolling, [r1, r2]) = view.rolling(pair);
            let [a, b] = rolling.links;
            match rolling.relation() {
                // (φ₂ − β) + (φ₁ − β) ρ₁/ρ₂.
                Relation::Turnings([p, q]) => {
                    let ratio = r1 / r2;
                    let d = view.centre(b, q)? - view.centre(a, p)?;
                    (s.told)(0, GraphNode::Link(a), [zero, zero, ratio]);
                    (s.told)(0, GraphNode::Link(b), [zero, zero, N::from_f64(1.0)]);
                    let k = d.perp() * (unit * (N::from_f64(1.0) + ratio) / d.norm2());
                    s.moved_centre(a, p, k)?;
                    s.moved_centre(b, q, -k)?;
                }
                // s/ρ + φ₂ − φ₁.
                Relation::Slide { centre, guide } => {
                    let Path::Line { direction, .. } = view.path(guide)? else { return None };
                    let at = view.centre(b, centre)?;
                    (s.told)(0, GraphNode::Link(a), [zero, zero, N::from_f64(-1.0)]);
                    (s.told)(0, GraphNode::Link(b), [zero, zero, N::from_f64(1.0)]);
                    let k = view.pose(a)?.turn(direction) * (unit / r2);
                    s.moved_centre(b, centre, k)?;
                    s.link(0, a, at, -k)?;
                }
            }
        }
    }
    Some(())
}

/// The derivatives of one form, see [`slopes`].
struct FormSlopes<'a, N, V, F> {
    view: &'a V,
    unit: N,
    told: F,
}

impl<N: Real, V: PartPositions<N>, F: FnMut(usize, GraphNode, [N; 3])> FormSlopes<'_, N, V, F> {
    /// Reports k·(motion of a pin).
    fn pin(&mut self, equation: usize, p: PointId, k: Vec2<N>) {
        (self.told)(equation, GraphNode::Pin(p), [k.x, k.y, N::from_f64(0.0)]);
    }

    /// Reports k·(motion of the point of a link at a position).
    fn link(&mut self, equation: usize, l: LinkId, place: Point<N>, k: Vec2<N>) -> Option<()> {
        let turn = k.dot((place - self.view.pose(l)?.origin).perp()) / self.unit;
        (self.told)(equation, GraphNode::Link(l), [k.x, k.y, turn]);
        Some(())
    }

    /// Reports k·(motion of a runner).
    fn runner(&mut self, runner: Runner, k: Vec2<N>) {
        match runner {
            Runner::Pin(p) => self.pin(0, p, k),
            Runner::Link(l) => (self.told)(0, GraphNode::Link(l), [k.x, k.y, N::from_f64(0.0)]),
        }
    }

    /// Reports k·(motion of a centre).
    fn moved_centre(&mut self, link: LinkId, centre: PointId, k: Vec2<N>) -> Option<()> {
        match self.view.local(link, centre) {
            Some(_) => {
                let place = self.view.centre(link, centre)?;
                self.link(0, link, place, k)?;
            }
            None => self.pin(0, centre, k),
        }
        Some(())
    }
}

/// Returns the unit vector from one point toward another.
fn direction_from<N: Real>(from: Point<N>, to: Point<N>) -> Vec2<N> {
    let d = to - from;
    d * (N::from_f64(1.0) / d.norm())
}
