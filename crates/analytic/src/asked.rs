//! The answers of the analytic solution to the quantities that a scene requests: vectors and rates
//! are unknowns of the solution; the parts of a relative motion are derivatives of position
//! equations.
//!
//! Each part has its own coordinate: the position of a point along and across a line of the
//! carrying link ([`Along`](super::relation::PositionEquation::Along)), the length of the line
//! between two points ([`Distance`](super::relation::PositionEquation::Distance)), the rotation of
//! that line ([`Line`](super::relation::PositionEquation::Line)). The first and second derivatives
//! of these coordinates at the solution are v_r, aʳ, aⁿ and aᵗ; the Coriolis part is the total less
//! these parts.

use super::Solution;
use super::relation::{BodyPoint, EquationPair, EquationRow, along_line, distance, projection};
use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::answer::{AnswerValue, MotionSource, evaluate};
use hodograph_mechanism::mechanism::{Level, PointJoint, joined};
use hodograph_mechanism::position::{Configuration, Path};
use hodograph_scene::quantity::{
    Frame, Meaning, ObservedPart, RelativeComponent, heading, ratio, split,
};
use hodograph_scene::{Asked, GuideId, LinkId, OnLink, PointId, Scene};
use nalgebra::DVector;

/// Unknowns of a small separate system: three of a body that turns, two of a point, two of another
/// point.
type Unknowns = [f64; 7];
const BODY: BodyPoint = BodyPoint { first: Some(0), turns: true, r: Vec2::ZERO };
const POINT: BodyPoint = BodyPoint { first: Some(3), turns: false, r: Vec2::ZERO };
const OTHER: BodyPoint = BodyPoint { first: Some(5), turns: false, r: Vec2::ZERO };

/// Returns the first derivative of the coordinate of a row, with no value prescribed for it.
fn first(row: &EquationRow, x: &Unknowns) -> f64 {
    row.coefficients.iter().map(|(k, c)| c * x[*k]).sum()
}

/// Returns the second derivative of the coordinate of a row.
fn second(row: &EquationRow, x: &Unknowns, xx: &Unknowns) -> f64 {
    first(row, xx) - row.acceleration(&DVector::from_column_slice(x))
}

/// The parts of the motion of one end of a line relative to the other.
struct RelativeMotionParts {
    normal: Vec2,
    tangential: Vec2,
    sliding: [Vec2; 2],
    coriolis: Vec2,
}

impl Solution {
    /// Returns the answer of the loop equations to a requested quantity; `None` if they have none.
    pub fn answer(&self, scene: &Scene, at: &Configuration, what: &Asked) -> Option<AnswerValue> {
        let level = what.level();
        let vector = |p: &OnLink| self.vector(level, p.point, p.link);
        match what.meaning(scene) {
            Some(Meaning::Vector(p)) => vector(&p).map(AnswerValue::Vector),
            Some(Meaning::Relative(split, a, b)) => {
                let parts = || self.parts(scene, at, &a, &b);
                Some(AnswerValue::Vector(match (split, level) {
                    (RelativeComponent::Whole, _) => vector(&a)? - vector(&b)?,
                    (RelativeComponent::Along, _) => parts()?.normal,
                    (RelativeComponent::Across, _) => parts()?.tangential,
                    (RelativeComponent::Sliding, Level::Acceleration) => parts()?.sliding[1],
                    (RelativeComponent::Sliding, Level::Position | Level::Velocity) => {
                        self.sliding_velocity(scene, at, &a, &b)?
                    }
                    (RelativeComponent::SlidingNormal, _) => {
                        self.along_guide(scene, at, &a, &b, parts()?.sliding[1])?[1]
                    }
                    (RelativeComponent::SlidingTangential, _) => {
                        self.along_guide(scene, at, &a, &b, parts()?.sliding[1])?[0]
                    }
                    (RelativeComponent::Coriolis, _) => parts()?.coriolis,
                }))
            }
            Some(Meaning::Seen(seen, of, frame, about)) => {
                self.seen(at, seen, &of, frame, about).map(AnswerValue::Vector)
            }
            Some(Meaning::Turning(l, None)) => self.turning(level, l).map(AnswerValue::Scalar),
            Some(Meaning::Turning(l, Some(against))) => {
                Some(AnswerValue::Scalar(self.turning(level, l)? - self.turning(level, against)?))
            }
            Some(Meaning::Ratio(links, arm)) => {
                let of = |l| self.turning(level, l);
                let arm = arm.map_or(Some(0.0), of)?;
                let [turning, moving] =
                    [true, false].map(|turning| self.largest(Level::Velocity, turning));
                let fastest =
                    if at.extent() > 0.0 { turning.max(moving / at.extent()) } else { turning };
                ratio([of(links[0])?, of(links[1])?], arm, fastest).map(AnswerValue::Scalar)
            }
            // No row determines this quantity: its own formula applies, with the positions of the
            // pose and the vectors and rates of the solution.
            Some(Meaning::Place(_)) | None => evaluate(scene, at, self, what),
        }
    }

    /// Returns v_r alone, which needs no acceleration.
    fn sliding_velocity(
        &self,
        scene: &Scene,
        at: &Configuration,
        a: &OnLink,
        b: &OnLink,
    ) -> Option<Vec2> {
        match joined(scene, a, b)? {
            PointJoint::Guide(g) => {
                Some(self.seen_from_guide(scene, at, g, a, b, Level::Velocity)?[0])
            }
            PointJoint::Cylinder(_) => Some(self.along_line(at, a, b, Level::Velocity)?.sliding[0]),
            PointJoint::Link(_) => None,
        }
    }

    fn parts(
        &self,
        scene: &Scene,
        at: &Configuration,
        a: &OnLink,
        b: &OnLink,
    ) -> Option<RelativeMotionParts> {
        match joined(scene, a, b)? {
            PointJoint::Guide(g) => {
                let sliding = self.seen_from_guide(scene, at, g, a, b, Level::Acceleration)?;
                let whole = self.vector(Level::Acceleration, a.point, a.link)?
                    - self.vector(Level::Acceleration, b.point, b.link)?;
                Some(RelativeMotionParts {
                    normal: Vec2::ZERO,
                    tangential: Vec2::ZERO,
                    sliding,
                    coriolis: whole - sliding[1],
                })
            }
            PointJoint::Link(_) | PointJoint::Cylinder(_) => {
                self.along_line(at, a, b, Level::Acceleration)
            }
        }
    }

    /// Returns velocity and acceleration of one coincident point relative to the other, in the
    /// frame of the link that carries the guide: the derivatives of two coordinates in that link.
    fn seen_from_guide(
        &self,
        scene: &Scene,
        at: &Configuration,
        g: GuideId,
        a: &OnLink,
        b: &OnLink,
        level: Level,
    ) -> Option<[Vec2; 2]> {
        let carrier = scene.guides[g.0].on;
        let (through, along) = match at.guides[g.0]? {
            Path::Line { through, direction } => (through, direction),
            Path::Arc { centre, .. } => (centre, Vec2::new(1.0, 0.0)),
        };
        let of_carrier = |p: &OnLink| {
            p.link
                .map_or_else(|| scene.links[carrier.0].points.contains(&p.point), |l| l == carrier)
        };
        let (runner, sign) = if of_carrier(b) { (a, 1.0) } else { (b, -1.0) };
        let seen = self.seen_from(at, carrier, (through, along), runner, level)?;
        Some(seen.map(|v| v * sign))
    }

    /// Returns velocity and acceleration of a point relative to a link: the derivatives of two
    /// coordinates in that link, measured from one of its points along a direction and square to
    /// it.
    fn seen_from(
        &self,
        at: &Configuration,
        carrier: LinkId,
        (through, along): (Point, Vec2),
        runner: &OnLink,
        level: Level,
    ) -> Option<[Vec2; 2]> {
        let place = at.points[runner.point.0]?;
        // The origin of the carrier is at `through`, so its arm is zero.
        let unknowns = |level| -> Option<Unknowns> {
            let (q, turning) =
                (self.at_place(level, carrier, through)?, self.turning(level, carrier)?);
            let p = self.vector(level, runner.point, runner.link)?;
            Some([q.x, q.y, turning, p.x, p.y, 0.0, 0.0])
        };
        let x = unknowns(Level::Velocity)?;
        let xx = if level == Level::Acceleration { unknowns(level)? } else { Unknowns::default() };
        let mut seen = [Vec2::ZERO; 2];
        for k in [along, along.perp()] {
            let row = projection(
                POINT,
                BODY,
                k,
                place - through,
                [0.0; 2],
                EquationPair::Pin(runner.point),
            );
            seen[0] += k * first(&row, &x);
            seen[1] += k * second(&row, &x, &xx);
        }
        Some(seen)
    }

    /// Splits an acceleration at a guide into the part along the guide and the part square to it.
    fn along_guide(
        &self,
        scene: &Scene,
        at: &Configuration,
        a: &OnLink,
        b: &OnLink,
        whole: Vec2,
    ) -> Option<[Vec2; 2]> {
        let PointJoint::Guide(g) = joined(scene, a, b)? else { return None };
        Some(match at.guides[g.0]? {
            Path::Line { .. } => [whole, Vec2::ZERO],
            Path::Arc { centre, .. } => {
                split((centre - at.points[a.point.0]?).perp().unit(), whole)
            }
        })
    }

    /// Returns a part of the motion of a point relative to a frame.
    fn seen(
        &self,
        at: &Configuration,
        part: ObservedPart,
        of: &OnLink,
        frame: Frame,
        about: Option<PointId>,
    ) -> Option<Vec2> {
        use Level::{Acceleration, Velocity};
        let seat = frame.transport_point(*of);
        let vector = |level, p: &OnLink| self.vector(level, p.point, p.link);
        let relative = |level| Some(vector(level, of)? - vector(level, &seat)?);
        let place = at.points[of.point.0]?;
        let seen = || match frame {
            Frame::Link(l) => {
                Some(self.seen_from(at, l, (place, Vec2::new(1.0, 0.0)), of, Acceleration)?[1])
            }
            Frame::Point(_) => relative(Acceleration),
        };
        let heading = |v: Vec2| heading(v, self.largest(Velocity, false));
        let path = || match about {
            Some(k) => Some((at.points[k.0]? - place).perp().unit()),
            None => Some(heading(relative(Velocity)?)),
        };
        let carried =
            || Some(split(heading(vector(Velocity, &seat)?), vector(Acceleration, &seat)?));
        Some(match part {
            ObservedPart::Relative => seen()?,
            ObservedPart::Coriolis => relative(Acceleration)? - seen()?,
            ObservedPart::RelativeNormal => split(path()?, seen()?)[1],
            ObservedPart::RelativeTangential => split(path()?, seen()?)[0],
            ObservedPart::TransportNormal => carried()?[1],
            ObservedPart::TransportTangential => carried()?[0],
        })
    }

    /// Returns the motion of one end of a line relative to the other, split along and across the
    /// line: its length and its direction are the coordinates.
    fn along_line(
        &self,
        at: &Configuration,
        a: &OnLink,
        b: &OnLink,
        level: Level,
    ) -> Option<RelativeMotionParts> {
        let d = at.points[a.point.0]? - at.points[b.point.0]?;
        let u = d.unit()?;
        let unknowns = |level| -> Option<Unknowns> {
            let (q, p) =
                (self.vector(level, b.point, b.link)?, self.vector(level, a.point, a.link)?);
            Some([0.0, 0.0, 0.0, p.x, p.y, q.x, q.y])
        };
        let mut x = unknowns(Level::Velocity)?;
        let xx = if level == Level::Acceleration { unknowns(level)? } else { Unknowns::default() };
        let pair = EquationPair::Pin(a.point);
        // A body that turns with the line, so that the line keeps its angle to the body; and a
        // length with the same rate of change as the line.
        let turning = along_line(BODY, POINT, OTHER, d, [0.0; 2], pair);
        x[2] = first(&turning, &x);
        let stretch = first(&distance(POINT, OTHER, d, [0.0; 2], pair), &x);
        let length = distance(POINT, OTHER, d, [stretch, 0.0], pair);
        let sliding = [u * stretch, u * second(&length, &x, &xx)];
        let (normal, tangential) = (d * -(x[2] * x[2]), d.perp() * second(&turning, &x, &xx));
        let whole = Vec2::new(xx[3] - xx[5], xx[4] - xx[6]);
        Some(RelativeMotionParts {
            normal,
            tangential,
            sliding,
            coriolis: whole - sliding[1] - normal - tangential,
        })
    }

    /// Returns the vector of the point of a link at a position.
    fn at_place(&self, level: Level, link: LinkId, place: Point) -> Option<Vec2> {
        if link == self.ground {
            return Some(Vec2::ZERO);
        }
        self.of_place(level, link, place)
    }
}
