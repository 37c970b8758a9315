//! The positions at which a driver is looked at: its values, with the cosine and sine of each where it turns.

use super::compile::driver_positions;
use crate::position::{Configuration, Path};
use crate::scene::{Angle, DriverKind, Scene};
use crate::trig;

/// Values of a driver (rad or m), in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stations {
    /// Value of each.
    pub values: Vec<f64>,
    /// Cosine and sine of each as an angle; for a driver along an arc, of the angle that its way makes there.
    pub cosines: Vec<f64>,
    /// Sines.
    pub sines: Vec<f64>,
}

impl Stations {
    /// `steps` equal steps from one angle to another, both ends included; degrees are reduced exactly.
    pub fn turned(from: Angle, to: Angle, steps: usize) -> Stations {
        let angle = |i: usize| match (from, to) {
            (Angle::Deg(a), Angle::Deg(b)) => Angle::Deg(between(a, b, i, steps)),
            _ => Angle::Rad(between(from.radians(), to.radians(), i, steps)),
        };
        let mut s = Stations::default();
        for i in 0..=steps {
            let (sin, cos) = trig::sin_cos(angle(i));
            s.values.push(angle(i).radians());
            s.cosines.push(cos);
            s.sines.push(sin);
        }
        s
    }

    /// Given values, which mean angle·`per_value` for cosine and sine.
    pub fn of_values(values: Vec<f64>, per_value: f64) -> Stations {
        let (sines, cosines) = values.iter().map(|v| (libm::sin(v * per_value), libm::cos(v * per_value))).unzip();
        Stations { values, cosines, sines }
    }

    /// `steps` equal steps from one length to another, both ends included.
    pub fn slid(from: f64, to: f64, steps: usize, per_value: f64) -> Stations {
        Stations::of_values((0..=steps).map(|i| between(from, to, i, steps)).collect(), per_value)
    }

    /// Some of them.
    pub fn pick(&self, rows: &[usize]) -> Stations {
        let of = |values: &[f64]| rows.iter().map(|&i| values[i]).collect();
        Stations { values: of(&self.values), cosines: of(&self.cosines), sines: of(&self.sines) }
    }

    /// How many.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }
}

/// The `i`-th of `steps` equal steps; the ends are met exactly.
fn between(a: f64, b: f64, i: usize, steps: usize) -> f64 {
    match i {
        0 => a,
        i if i == steps => b,
        i => a + (b - a) * (i as f64 / steps as f64),
    }
}

/// The angle of a driver's motion by its value: 1 where it turns, 1/ρ along an arc, 0 where no angle is in it.
pub fn angle_per_value(scene: &Scene, at: &Configuration, driver: usize) -> f64 {
    match &scene.drivers[driver].kind {
        DriverKind::Turn { .. } => 1.0,
        DriverKind::Slide { guide, .. } => match at.shapes.guides[guide.0] {
            Some(Path::Arc { radius, .. }) => 1.0 / radius,
            _ => 0.0,
        },
        DriverKind::Cylinder { .. } => 0.0,
    }
}

/// Where a driver stands at the instant (rad or m).
pub fn position_now(scene: &Scene, at: &Configuration, driver: usize) -> f64 {
    driver_positions(scene, at)[driver]
}
