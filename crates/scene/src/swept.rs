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
        if scene.has_laws_of_time() { Swept::Time } else { Swept::Driver(0) }
    }

    /// What a name means: a driver's position (`phi_1`, `s_B`, `l_BC`), or `driver`, `driver2`; or `t`, unless the scene has a parameter of that
    /// name that is not the instant of its laws.
    pub fn named(scene: &Scene, name: &str) -> Option<Swept> {
        let driver = |d: usize| name == scene.driver_name(d).0 || name == format!("driver{}", d + 1) || d == 0 && name == "driver";
        let is_time = || name == TIME && (scene.has_laws_of_time() || scene.parameters.iter().all(|(own, _)| own != TIME));
        (0..scene.drivers.len()).find(|d| driver(*d)).map(Swept::Driver).or_else(|| is_time().then_some(Swept::Time))
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
    /// Whether a driver moves by a law of time.
    pub fn has_laws_of_time(&self) -> bool {
        self.drivers.iter().any(|d| d.law.is_some())
    }

    /// The instant (s) of its laws of time; 0 where it has none.
    pub fn instant(&self) -> f64 {
        let t = self.parameters.iter().find(|(name, _)| name == TIME && self.has_laws_of_time());
        t.map_or(0.0, |(_, t)| t.value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{read, templates};

    #[test]
    fn t_is_the_time_unless_it_is_something_else() {
        let law = read(templates::get("plate-by-law").unwrap()).unwrap().value;
        assert_eq!((Swept::usual(&law), Swept::named(&law, "t"), law.instant()), (Swept::Time, Some(Swept::Time), 1.0));
        assert_eq!(Swept::named(&law, "phi_2"), Some(Swept::Driver(0)));
        let text = templates::get("five-bar").unwrap();
        let plain = read(text).unwrap().value;
        assert_eq!((Swept::usual(&plain), Swept::named(&plain, "t"), plain.instant()), (Swept::Driver(0), Some(Swept::Time), 0.0));
        assert_eq!((Swept::named(&plain, "driver2"), Swept::named(&plain, "l_AB")), (Some(Swept::Driver(1)), None));
        // A thickness, say.
        let own = read(text.replacen(r#""l_AB": "120 mm""#, r#""t": "120 mm", "l_AB": "t""#, 1)).unwrap().value;
        assert_eq!((Swept::named(&own, "t"), own.instant()), (None, 0.0));
    }
}
