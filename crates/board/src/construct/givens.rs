//! The givens of a scene in a pose.

use super::acts::GivenNumber;
use crate::construction::{Givens, Key, Track};
use hodograph_base::geom::Point;
use hodograph_base::number::Real;
use hodograph_mechanism::position::{Configuration, Path};
use hodograph_scene::exact::Inputs;
use hodograph_scene::{DiagramKind, Driver, Scene};

/// A scene in a pose.
pub(super) struct PosedInputs<'a, N> {
    scene: &'a Scene,
    at: &'a Configuration<N>,
    numbers: &'a [GivenNumber],
    inputs: Inputs<'a, N>,
    origin: Point<N>,
    extent: f64,
}

impl<'a, N: Real> PosedInputs<'a, N> {
    /// Returns a rate (rad/s, or rad/s²) of the order of those of the drivers. Any value but 0
    /// gives the same polygon.
    fn handy(&self, on: DiagramKind) -> f64 {
        let rate = |d: &Driver, value: f64| {
            value.abs() / if d.kind.turns() { 1.0 } else { self.extent.max(f64::MIN_POSITIVE) }
        };
        let largest =
            |of: &dyn Fn(&Driver) -> f64| self.scene.drivers.iter().map(of).fold(0.0, f64::max);
        let omega = largest(&|d| rate(d, d.rate.value));
        let value = match on {
            DiagramKind::Acceleration => {
                omega * omega
                    + largest(&|d| rate(d, d.acceleration.as_ref().map_or(0.0, |a| a.value)))
            }
            DiagramKind::Plane | DiagramKind::Velocity | DiagramKind::Force => omega,
        };
        if value > 0.0 && value.is_finite() { value } else { 1.0 }
    }

    pub(super) fn new(
        scene: &'a Scene,
        at: &'a Configuration<N>,
        numbers: &'a [GivenNumber],
    ) -> Self {
        PosedInputs {
            scene,
            at,
            numbers,
            inputs: Inputs::of(scene),
            origin: origin(scene, at),
            extent: at.extent(),
        }
    }
}

/// Returns the place (m) at the origin of the mechanism's drawing: the first placed joint of the
/// ground, otherwise of any link.
pub(crate) fn origin<N: Real>(scene: &Scene, at: &Configuration<N>) -> Point<N> {
    let of_ground = scene.links[scene.ground.0].points.iter();
    let first =
        of_ground.chain(scene.links.iter().flat_map(|l| &l.points)).find_map(|p| at.points[p.0]);
    first.unwrap_or(Point::origin())
}

impl<N: Real> Givens<N> for PosedInputs<'_, N> {
    fn place(&self, key: Key) -> Option<Point<N>> {
        self.at.points[key.index()]
    }

    fn number(&self, key: Key) -> N {
        match self.numbers[key.index()] {
            GivenNumber::Rate(driver) => self.inputs.number(&self.scene.drivers[driver].rate),
            GivenNumber::Acceleration(driver) => self.scene.drivers[driver]
                .acceleration
                .as_ref()
                .map_or(N::from_f64(0.0), |a| self.inputs.number(a)),
            GivenNumber::Size(pair, which) => self.scene.rolling[pair.0].sizes(&self.inputs)[which],
            GivenNumber::Trial(on) => N::from_f64(self.handy(on)),
        }
    }

    fn path(&self, key: Key) -> Option<Track<N>> {
        Some(match self.at.guides[key.index()]? {
            Path::Line { direction, .. } => Track::Line(direction),
            Path::Arc { centre, radius } => Track::Arc { centre, radius },
        })
    }

    /// Returns the distance (m) from the runner to the farthest joint of the carrying link, or the
    /// mechanism's size if there is none; for an arc, its radius.
    fn reach(&self, path: Key) -> f64 {
        let Some(track) = self.at.guides[path.index()] else { return self.extent };
        if let Path::Arc { radius, .. } = track {
            return radius.approx();
        }
        let guide = &self.scene.guides[path.index()];
        let runner = match (guide.pin, guide.slider) {
            (Some(p), _) => self.at.points[p.0],
            (None, Some(s)) => self.at.poses[s.0].map(|pose| pose.origin),
            (None, None) => None,
        };
        let joints = self.scene.links[guide.on.0]
            .points
            .iter()
            .filter_map(|p| self.at.points[p.0])
            .map(Point::approx);
        let farthest = runner
            .map(Point::approx)
            .map_or(0.0, |r| joints.map(|j| j.distance(r)).fold(0.0, f64::max));
        if farthest > 0.0 { farthest } else { self.extent }
    }

    fn origin(&self) -> Point<N> {
        self.origin
    }

    fn extent(&self) -> f64 {
        self.extent
    }
}
