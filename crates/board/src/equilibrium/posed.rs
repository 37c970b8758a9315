//! The givens of a construction of forces.

use crate::construction::{Givens, Key, Track};
use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::force::{Load, pressure_angle, unit_balance};
use hodograph_mechanism::position::{Configuration, Path};
use hodograph_scene::{RollingId, Scene};

/// The places, loads, guides and lines of action.
pub(super) struct LoadedPose<'a> {
    pub scene: &'a Scene,
    pub at: &'a Configuration,
    pub loads: &'a [Load],
    /// The sense in which each rolling pair presses along its tangent.
    pub senses: &'a [f64],
    pub extent: f64,
}

impl Givens<f64> for LoadedPose<'_> {
    fn place(&self, key: Key) -> Option<Point> {
        self.at.points[key.index()]
    }

    fn number(&self, key: Key) -> f64 {
        self.loads[key.index()].wrench.couple
    }

    fn vector(&self, key: Key) -> Option<Vec2> {
        match key.index().checked_sub(self.loads.len()) {
            None => Some(self.loads[key.index()].wrench.force),
            Some(0) => Some(unit_balance(self.scene, self.at)?.wrench.force),
            Some(k) => {
                let rolling = RollingId(k - 1);
                let n = self.at.normal(self.scene, rolling)?;
                let angle = pressure_angle(&self.scene.rolling[rolling.0]);
                (n.perp() + n * (self.senses[rolling.0] * libm::tan(angle))).unit()
            }
        }
    }

    fn path(&self, key: Key) -> Option<Track<f64>> {
        Some(match self.at.guides[key.index()]? {
            Path::Line { direction, .. } => Track::Line(direction),
            Path::Arc { centre, radius } => Track::Arc { centre, radius },
        })
    }

    fn reach(&self, _: Key) -> f64 {
        self.extent
    }

    fn origin(&self) -> Point {
        let of_ground = self.scene.links[self.scene.ground.0].points.iter();
        let mut all = of_ground.chain(self.scene.links.iter().flat_map(|l| &l.points));
        all.find_map(|p| self.at.points[p.0]).unwrap_or(Point::ORIGIN)
    }

    fn extent(&self) -> f64 {
        self.extent
    }
}
