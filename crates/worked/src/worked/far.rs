//! Questions without a value: those that have none in the pose, and instantaneous centres at
//! infinity, which are given as directions.

use hodograph_analytic::{RefusedPart, Solution};
use hodograph_base::diag::Both;
use hodograph_base::digits::line_degrees;
use hodograph_base::geom::Vec2;
use hodograph_mechanism::answer::AnswerValue;
use hodograph_mechanism::position::Configuration;
use hodograph_scene::quantity::{Asked, PointMotion, Rate, Turning};
use hodograph_scene::{LinkId, OnLink, PointId, Scene};

/// The rounding of a relative velocity, as a part of the larger of the two velocities.
const ROUNDING: f64 = 1e-12;

/// The distance of a centre, in sizes of the mechanism, beyond which it is at infinity within
/// rounding: the angular velocities of the links agree to all but the last few digits.
const BEYOND: f64 = 1e12;

/// True if a centre's place is no more than rounding. A body with one point has no size for
/// comparison.
pub(super) fn is_nowhere(what: &Asked, value: &AnswerValue, extent_m: f64) -> bool {
    match (what, value) {
        (Asked::InstantCentre(_), AnswerValue::Point(p)) => {
            extent_m > 0.0 && p.to_vec2().norm() > BEYOND * extent_m
        }
        (_, AnswerValue::Point(_) | AnswerValue::Vector(_) | AnswerValue::Scalar(_)) => false,
    }
}

/// A question without an answer in the pose.
#[derive(Clone, Debug, PartialEq)]
pub struct Unanswered {
    /// Index into the scene's `find` list.
    pub find: usize,
    /// The reason.
    pub why: NoAnswer,
}

impl Unanswered {
    /// Returns the part of the mechanism that has no motion, if that is the reason.
    pub fn refused(&self) -> Option<&RefusedPart> {
        match &self.why {
            NoAnswer::NoMotion(refused) => Some(refused),
            NoAnswer::NoValue(_) | NoAnswer::Infinite(_) => None,
        }
    }
}

/// The reason why a question has no answer in the pose.
#[derive(Clone, Debug, PartialEq)]
pub enum NoAnswer {
    /// The answer depends on a part of the mechanism that has no motion.
    NoMotion(Box<RefusedPart>),
    /// The motion is known, and leaves the quantity undefined: the ratio to a link at rest, the
    /// radius of a straight path. In words.
    NoValue(Both),
    /// The quantity is infinite: the radius of a straight flank. In words.
    Infinite(Both),
}

/// A centre at infinity: the two links have the same angular velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InfiniteCentre {
    /// Index into the scene's `find` list.
    pub find: usize,
    /// The direction of the centre (degrees from the x axis, from 0 to 180: both ends of a line are
    /// one point at infinity), square to the relative velocity; `None` if the links do not move
    /// relative to one another, so that every point is a centre.
    pub direction_deg: Option<f64>,
}

/// The centre of a question, if it is at infinity.
pub(super) fn far(
    scene: &Scene,
    solution: &Solution,
    at: &Configuration,
    find: usize,
) -> Option<InfiniteCentre> {
    let Asked::InstantCentre(centre) = scene.find[find].what else { return None };
    let base = centre.links.iter().find_map(|(_, p)| at.points[(*p)?.0])?;
    let motion = |(link, point): (LinkId, Option<PointId>)| {
        let Some(point) = point else { return Some((Vec2::ZERO, 0.0)) };
        let of = OnLink {
            point,
            link: Some(link).filter(|l| !scene.links[l.0].points.contains(&point)),
        };
        let v = solution.answer(scene, at, &PointMotion { rate: Rate::Velocity, of }.into())?;
        let AnswerValue::Scalar(omega) = solution.answer(
            scene,
            at,
            &Turning { rate: Rate::Velocity, of: link, against: None }.into(),
        )?
        else {
            return None;
        };
        let AnswerValue::Vector(v) = v else { return None };
        Some((v + (base - at.points[point.0]?).perp() * omega, v.norm()))
    };
    let ((v, a), (w, b)) = (motion(centre.links[0])?, motion(centre.links[1])?);
    let relative = v - w;
    let moves = relative.norm() > ROUNDING * a.max(b);
    let square = || line_degrees(relative.perp().angle());
    Some(InfiniteCentre { find, direction_deg: moves.then(square) })
}
