//! The givens of a construction of forces.

use crate::construct::givens::origin;
use crate::construction::{Givens, Key, Track};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_mechanism::force::{Load, pressure_angle, unit_balance};
use hodograph_mechanism::position::{Configuration, Path};
use hodograph_scene::{RollingId, Scene};

/// The places, loads, guides and lines of action.
pub(super) struct LoadedPose<'a, N> {
    pub scene: &'a Scene,
    pub at: &'a Configuration<N>,
    pub loads: &'a [Load<N>],
    /// The sense in which each rolling pair presses along its tangent.
    pub senses: &'a [f64],
    pub extent: f64,
}

impl<N: Real> Givens<N> for LoadedPose<'_, N> {
    fn place(&self, key: Key) -> Option<Point<N>> {
        self.at.points[key.index()]
    }

    fn number(&self, key: Key) -> N {
        self.loads[key.index()].wrench.couple
    }

    fn vector(&self, key: Key) -> Option<Vec2<N>> {
        match key.index().checked_sub(self.loads.len()) {
            None => Some(self.loads[key.index()].wrench.force),
            Some(0) => Some(unit_balance(self.scene, self.at)?.wrench.force),
            Some(k) => {
                let rolling = RollingId(k - 1);
                let n = self.at.normal(self.scene, rolling)?;
                let angle = pressure_angle(&self.scene.rolling[rolling.0]);
                (n.perp() + n * N::from_f64(self.senses[rolling.0] * libm::tan(angle))).unit()
            }
        }
    }

    fn path(&self, key: Key) -> Option<Track<N>> {
        Some(match self.at.guides[key.index()]? {
            Path::Line { direction, .. } => Track::Line(direction),
            Path::Arc { centre, radius } => Track::Arc { centre, radius },
        })
    }

    fn reach(&self, _: Key) -> f64 {
        self.extent
    }

    fn origin(&self) -> Point<N> {
        origin(self.scene, self.at)
    }

    fn extent(&self) -> f64 {
        self.extent
    }
}
