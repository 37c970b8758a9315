//! Steps of a followed mechanism: the predicted pose, and the test whether the pose found was
//! followed or jumped to another assembly.
//!
//! These rules hold for everything that is followed as whole configurations. The predictor is the
//! secant through the last two poses. A pose that strays from it is refused; the caller then takes
//! a shorter step. Links on three legs inside a program have a stricter test, by their tangents and
//! determinants ([`super::triad`]).

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
pub(super) const STRAY: f64 = 0.03;

/// The largest distance (m) of a joint in two poses.
pub(super) fn stray(a: &Configuration, b: &Configuration) -> f64 {
    a.points
        .iter()
        .zip(&b.points)
        .filter_map(|(a, b)| Some(a.as_ref()?.distance(*b.as_ref()?)))
        .fold(0.0, f64::max)
}

/// The predicted pose: the secant through the last two poses, extrapolated in the ratio of the
/// travels.
pub(super) fn foretold(
    before: Option<&TravelPose>,
    now: &TravelPose,
    travel: f64,
) -> Configuration {
    let mut guess = now.configuration.clone();
    let Some(before) = before else { return guess };
    let ratio = (travel - now.travel) / (now.travel - before.travel);
    let ahead = |old: Point, new: Point| new + (new - old) * ratio;
    for (p, old) in guess.points.iter_mut().zip(&before.configuration.points) {
        if let (Some(p), Some(old)) = (p, old) {
            *p = ahead(*old, *p);
        }
    }
    for (f, old) in guess.poses.iter_mut().zip(&before.configuration.poses) {
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
