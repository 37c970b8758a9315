//! What a mechanism is moved by on its way: one of its drivers, or time.

use super::front::TIME;
use super::{Kind, Scene};

/// What goes on from pose to pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Swept {
    /// One driver (its number, from 0 on); the others stand at their places, with their rates.
    Driver(usize),
    /// Time: every driver goes on, by its law of time, else with the constant acceleration that it has at the instant.
    Time,
}

impl From<usize> for Swept {
    fn from(driver: usize) -> Swept {
        Swept::Driver(driver)
    }
}

impl Swept {
    /// Time where a driver moves by a law of it, else the first driver.
    pub fn usual(scene: &Scene) -> Swept {
        if scene.drivers.iter().any(|d| d.law.is_some()) { Swept::Time } else { Swept::Driver(0) }
    }

    /// What a name means: `t`, or a driver's position (`phi_1`, `s_B`, `l_BC`), or `driver`, `driver2`.
    pub fn named(scene: &Scene, name: &str) -> Option<Swept> {
        let driver = |d: usize| name == scene.driver_name(d).0 || name == format!("driver{}", d + 1) || d == 0 && name == "driver";
        (0..scene.drivers.len()).find(|d| driver(*d)).map(Swept::Driver).or_else(|| (name == TIME).then_some(Swept::Time))
    }

    /// The name of what goes on, and what it is: an angle, a length, a time.
    pub fn name(self, scene: &Scene) -> (String, Kind) {
        match self {
            Swept::Driver(d) => scene.driver_name(d),
            Swept::Time => (TIME.to_owned(), Kind::Time),
        }
    }

    /// Whether it is a driver that turns.
    pub fn turns(self, scene: &Scene) -> bool {
        matches!(self, Swept::Driver(d) if scene.drivers[d].kind.turns())
    }

    /// The driver by which the mechanism is taken hold of: of several that go on, the first that moves by itself.
    pub fn lead(self, scene: &Scene) -> usize {
        match self {
            Swept::Driver(d) => d,
            Swept::Time => {
                let moves = |d: &usize| !scene.is_led(*d) && (scene.drivers[*d].law.is_some() || scene.drivers[*d].rate.value != 0.0);
                (0..scene.drivers.len()).find(moves).unwrap_or(0)
            }
        }
    }
}

impl Scene {
    /// The instant (s) of its laws of time; 0 where it names none.
    pub fn instant(&self) -> f64 {
        self.parameters.iter().find(|(name, _)| name == TIME && self.drivers.iter().any(|d| d.law.is_some())).map_or(0.0, |(_, t)| t.value)
    }
}
