//! Steps of a followed mechanism: the predicted pose, and the test whether the pose found was
//! followed or jumped to another assembly.
//!
//! These rules hold for everything that is followed as whole configurations. The predictor is the
//! secant through the last two poses. A pose that strays from it is refused, and so is one without
//! a smooth way to it; the caller then takes a shorter step. Links on three legs inside a program
//! have a stricter test, by their tangents and determinants ([`super::triad`]).

use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::position::{Configuration, Pose as Frame};

/// One pose.
#[derive(Clone, Debug)]
pub struct TravelPose {
    /// The driver's travel from the scene's position (rad or m), or the time (s).
    pub travel: f64,
    /// The configuration.
    pub configuration: Configuration,
}

/// The greatest distance of a joint from its predicted position, as a part of the mechanism's size:
/// a joint that strays farther has jumped to another assembly, or turns so fast that the step must
/// be smaller. (A crank as long as the mechanism strays by 0.008 in 5°.)
const STRAY: f64 = 0.03;

/// The greatest distance of a joint from its predicted position, as a part of the way that the
/// joints move, up to which a step is smooth without a look at its middle. (A circle strays by a
/// twentieth in 5°.)
const SMOOTH: f64 = 0.125;

/// The greatest distance of a joint from the middle of its way at half the step, as a part of the
/// way that the joints move. Toward a limit, where they move as the root of the distance, it is
/// 0.21; half-way to another assembly, joints are on either of the two, which is 0.5.
const BEND: f64 = 0.3;

/// A way of the joints, in sizes of the mechanism, below which poses differ by their rounding: at a
/// limit by some 1e-8.
pub(super) const SLIGHT: f64 = 1e-6;

/// The largest distance (m) of a joint in two poses.
pub(super) fn stray(a: &Configuration, b: &Configuration) -> f64 {
    a.points
        .iter()
        .zip(&b.points)
        .filter_map(|(a, b)| Some(a.as_ref()?.distance(*b.as_ref()?)))
        .fold(0.0, f64::max)
}

/// Returns true if the pose `found` was followed from the pose `from`: it is near the predicted one,
/// and half-way between the two, close to their mean, there is a pose too. Beyond a limit an
/// assembly may be so near to the last pose that its distance alone does not tell it.
///
/// `extent` is the size of the mechanism; `half_way` returns the pose at half the step that is
/// nearest to a guess.
pub(super) fn is_followed(
    [from, predicted, found]: [&Configuration; 3],
    extent: f64,
    half_way: impl FnOnce(&Configuration) -> Option<Configuration>,
) -> bool {
    let (off, moved) = (stray(found, predicted), stray(found, from));
    if off.is_nan() || off >= STRAY * extent {
        return false;
    }
    if off <= SMOOTH * moved || moved <= SLIGHT * extent {
        return true;
    }
    let mean = ahead(from, found, -0.5);
    half_way(&mean).is_some_and(|there| stray(&there, &mean) < BEND * moved)
}

/// The predicted pose: the secant through the last two poses, extrapolated in the ratio of the
/// travels.
pub(super) fn foretold(
    before: Option<&TravelPose>,
    now: &TravelPose,
    travel: f64,
) -> Configuration {
    let Some(before) = before else { return now.configuration.clone() };
    let ratio = (travel - now.travel) / (now.travel - before.travel);
    ahead(&before.configuration, &now.configuration, ratio)
}

/// The pose beyond `now` on the secant from `before`, in a ratio to the way between the two.
fn ahead(before: &Configuration, now: &Configuration, ratio: f64) -> Configuration {
    let mut guess = now.clone();
    let ahead = |old: Point, new: Point| new + (new - old) * ratio;
    for (p, old) in guess.points.iter_mut().zip(&before.points) {
        if let (Some(p), Some(old)) = (p, old) {
            *p = ahead(*old, *p);
        }
    }
    for (f, old) in guess.poses.iter_mut().zip(&before.poses) {
        if let (Some(f), Some(old)) = (f, old) {
            let turned = f.axis.divide_by(old.axis).angle();
            *f = Frame {
                origin: ahead(old.origin, f.origin),
                axis: f.axis.rotate_by(Vec2::from_angle(turned * ratio)),
            };
        }
    }
    guess
}
