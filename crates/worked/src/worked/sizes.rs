//! The sizes against which small answers are judged.
//!
//! This module decides which size counts as large in a pose. The sizes are found once for a
//! construction, because a sheet may need thousands of answers.

use hodograph_board::construct::{self, PlanDrawing};
use hodograph_mechanism::answer::AnswerValue;
use hodograph_mechanism::mechanism::Level;
use hodograph_mechanism::position::Configuration;
use hodograph_scene::{DiagramKind, Driver, Scene};

/// The sizes of a pose and of its polygons.
pub(super) struct PoseSizes {
    /// The size of the mechanism (m).
    pub extent: f64,
    velocity: LevelSize,
    acceleration: LevelSize,
}

/// The sizes of a level, in SI.
struct LevelSize {
    vector: f64,
    turning: f64,
}

impl PoseSizes {
    /// Finds the sizes. That of vectors is the longest one of the polygon, or, if all vectors
    /// vanish, the effect of the drivers at the size of the mechanism. That of angular rates is the
    /// largest rate, or that vector divided by the shortest arm on which a rate was measured (ω of
    /// a short link is a small difference of vectors divided by a small length, and α may vanish
    /// where ω² l does not).
    pub fn of(scene: &Scene, paper: &PlanDrawing, at: &Configuration) -> PoseSizes {
        let extent = at.extent();
        // A driver that starts from rest has no speed yet; its speed after a radian, or after the
        // mechanism's size, is the measure.
        let driven = |d: &Driver| {
            let (rate, a) =
                (d.rate.value.abs(), d.acceleration.as_ref().map_or(0.0, |a| a.value.abs()));
            if d.kind.turns() { rate.max(a.sqrt()) * extent } else { rate.max((a * extent).sqrt()) }
        };
        let largest = |on| paper.polygon(on).map_or(0.0, construct::Polygon::largest);
        let speed = scene.drivers.iter().map(driven).fold(largest(DiagramKind::Velocity), f64::max);
        let acceleration = largest(DiagramKind::Acceleration);
        let acceleration =
            if extent > 0.0 { acceleration.max(speed * speed / extent) } else { acceleration };
        let size = |on, vector: f64| {
            let rates = paper.rates.iter().filter(|r| r.on == on);
            let largest = rates.clone().map(|r| r.value.abs()).fold(0.0, f64::max);
            let arm = rates.filter_map(|r| r.measured).map(|m| m.arm).fold(extent, f64::min);
            LevelSize {
                vector,
                turning: if arm > 0.0 { largest.max(vector / arm) } else { largest },
            }
        };
        PoseSizes {
            extent,
            velocity: size(DiagramKind::Velocity, speed),
            acceleration: size(DiagramKind::Acceleration, acceleration),
        }
    }

    /// Returns the reference size for an answer of a level.
    pub fn against(&self, level: Level, value: &AnswerValue) -> f64 {
        let size = if level == Level::Acceleration { &self.acceleration } else { &self.velocity };
        match value {
            AnswerValue::Point(_) => self.extent,
            AnswerValue::Vector(_) => size.vector,
            AnswerValue::Scalar(_) => size.turning,
        }
    }
}
